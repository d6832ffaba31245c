"""Reading a drawing file: its contours in millimetres, and a report in which every entity is accounted for.

    reading = read(data, "part.dxf", ReadOptions(units="inch"))
    for contour in reading.contours: ...        # Contour: edges (lines, arcs, curves), is_closed, layers
    print(*reading.report.report(), sep="\\n")

`read` is the one door for the commands; what it raises is a `UserError` that says what a person can do.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import floor
from typing import Any

from skg.errors import UserError
from skg.geometry.contour import Contour, Edge
from skg.geometry.edge_arrays import boxes_of
from skg.geometry.plane import XY, shifted
from skg.job.read_options import OPEN, START, UNITS, ReadOptions
from skg.messages.finding import Finding, Phrase

# (all of these at once: what a library drops while it is loaded keeps alive all that those hold who called for it; what
# reads SVG is loaded for that alone)
from skg.reading import dxf_entities, dxf_file
from skg.reading.account import ASKED, NOT_TOLD, NOTE, ODD_METRES, TOLD, Account, Content, Noted, Written, listed
from skg.reading.chain import merged
from skg.reading.selection import Fates, Selection

__all__ = ["OPEN", "UNITS", "ReadOptions", "Reading", "layer_lines", "read"]

#: The larger side of a usual part, mm.
USUAL = 3.0, 10_000.0
#: A drawing that does not tell its units and whose larger side is shorter than this, mm, may be in inches.
DOUBTED = 25.4
#: A larger part hardly lies on a wire machine, mm.
LARGE = 1000.0
#: A part that is larger is said unless its units were asked for, mm.
HUGE = 2000.0
#: No drawing that is cut has a larger side, mm.
FARTHEST = 50_000.0
#: The units that a drawing may be in. (In mil write programs for boards that do not tell it)
GUESSED = ("mm", "inch", "cm", "mil")
#: A size this near to whole millimetres is one, mm. (A file in inches has four decimals)
_WHOLE = 0.003
#: Sheets of paper, mm, and the dots in an inch that drawings are in.
_PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0)}
_DOTS = (300, 150, 96, 72)
#: Beginning of a DXF text file, remarks before it.
_DXF = re.compile(rb"\s*(?:999\s*\n[^\n]*\n\s*)*0\s+SECTION\s")
#: Entities that fill an area, without lines around it.
AREAS = ("HATCH", "MPOLYGON", "SOLID", "TRACE", "3DFACE", "MESH")


@dataclass(frozen=True)
class Reading:
    """A drawing that was read: contours in the order of the file (mm), start holes (mm); `others`: the closed contours
    that are left because of their layers; `opened`: the open lines, cut or not, on any layer. `begun`: the report but
    for what becomes of the entities, `fates` has that; `drawn`: the contours as the entities have their edges;
    `nominal`: the edges of the file, before anything was mended; `unasked`: those of layers that are not cut;
    `written`: its texts; `noted`: lines of what is nothing to cut.
    """

    contours: list[Contour]
    starts: list[XY]
    others: list[Contour]
    opened: list[Contour]
    begun: Account
    fates: Fates
    drawn: list[Contour]
    nominal: list[Edge]
    unasked: list[Edge]
    written: list[Written]
    noted: Noted

    def is_same(self, options: ReadOptions, others: ReadOptions) -> bool:
        """Tell whether options other than those that it was read by give the same: what becomes of open lines does not
        matter where there are none."""
        is_about_open = not self.opened and "all" not in (options.open, others.open)
        return options == (replace(others, open=options.open) if is_about_open else others)

    @cached_property
    def report(self) -> Account:
        """The report on all contours."""
        return self.account({})

    def account(self, skipped: Mapping[int, Phrase]) -> Account:
        """The report where some contours (by their numbers) are skipped, and why."""
        report = self.fates.account(self.drawn, skipped, self.begun)
        cut = [contour for number, contour in enumerate(self.contours) if number not in skipped]
        report.closed = sum(contour.is_closed for contour in cut)
        report.open = len(cut) - report.closed
        report.length = sum(edge.length for contour in cut for edge in contour.edges)
        return report


def read(data: bytes, name: str, options: ReadOptions | None = None) -> Reading:
    """Read a drawing file's bytes; `name` is the file's name, for messages and for its ending.

    A drawing without anything to cut, or one that is refused, is a `UserError` that begins with the name.
    """
    options = options or ReadOptions()
    try:
        return _read(data, name, options)
    except UserError as error:
        raise error.within(name) from None


def _read(data: bytes, name: str, options: ReadOptions) -> Reading:
    content, report = _content(data, name, options)
    if not content.edges:
        raise UserError(_nothing(content, options))
    if options.start_layer != START and not content.starts:
        report.findings.append(Finding("no-start-points", layer=options.start_layer))
    selection = Selection(content, options, report)
    contours = selection.contours()
    if contours and _is_in_odd_metres(contours, report):
        # (in mm more ends meet, and the small ones are counted so)
        width, height = (side / UNITS["m"] for side in report.size)
        reading = _read(data, name, replace(options, units="mm"))
        reading.begun.units_from = ODD_METRES
        reading.begun.units_values = {"width": width, "height": height}
        return reading
    drawn, fates = selection.without_open(contours), selection.fates
    if not drawn:
        raise UserError(_no_outline(fates.account([], {}, report)))
    _measure(drawn, report)
    _check_size(report)
    contours = [replace(merged(contour), layers=fates.layers(contour)) for contour in drawn]
    others, opened = selection.others()
    seen = content.edges, content.others, content.written, content.noted
    return _near_origin(Reading(contours, content.starts, others, opened, report, fates, drawn, *seen))


def _is_in_odd_metres(contours: list[Contour], report: Account) -> bool:
    """Tell whether a file says metres and cannot mean it: programs write so that were not told any units."""
    if report.units != "m" or report.units_from != TOLD:
        return False
    _measure(contours, report)
    return max(report.size) > USUAL[1]


def _near_origin(reading: Reading) -> Reading:
    """A drawing with a map's coordinates is moved by whole millimetres: the ROM has no places that far."""
    report = reading.begun
    if max(map(abs, (*report.low, *report.high))) < FARTHEST:
        return reading
    by = -floor(report.low[0]), -floor(report.low[1])
    report.findings = [
        *(finding.moved(lambda place: shifted(place, by)) for finding in report.findings),
        Finding("moved-near", by=by),
    ]
    report.overlaps = [replace(overlap, place=shifted(overlap.place, by)) for overlap in report.overlaps]
    reading.fates.by = by
    for entity in reading.fates.entities:
        entity.place = shifted(entity.place, by)
    report.low, report.high = shifted(report.low, by), shifted(report.high, by)
    contours, others, opened = (
        [contour.shifted(by) for contour in group] for group in (reading.contours, reading.others, reading.opened)
    )
    starts = [shifted(start, by) for start in reading.starts]
    nominal, unasked = ([edge.shifted(by) for edge in group] for group in (reading.nominal, reading.unasked))
    written = [replace(text, place=shifted(text.place, by)) for text in reading.written]
    report.mends = [replace(mend, place=shifted(mend.place, by)) for mend in report.mends]
    report.open_ends = [
        replace(end, place=shifted(end.place, by), other=end.other and shifted(end.other, by))
        for end in report.open_ends
    ]
    report.repairs = [
        replace(repair, places=(shifted(repair.places[0], by), shifted(repair.places[1], by)))
        for repair in report.repairs
    ]
    seen: dict[str, Any] = {
        "nominal": nominal,
        "unasked": unasked,
        "written": written,
        "noted": replace(reading.noted, by=by),
    }
    return replace(reading, contours=contours, starts=starts, others=others, opened=opened, **seen)


def layer_lines(data: bytes, name: str, options: ReadOptions) -> tuple[list[Phrase], list[Finding]]:
    """List the entities of each layer of a drawing file; and what was guessed or mended to read it."""
    try:
        content, report = _content(data, name, options)
    except UserError as error:
        raise error.within(name) from None
    kinds: dict[str, Counter[str]] = defaultdict(Counter)
    for entity in content.entities:
        kinds[entity.layer][entity.kind] += 1
    return [Phrase("layer-list", layer=layer, kinds=listed(kinds[layer])) for layer in sorted(kinds)], report.findings


def _is_svg(data: bytes, name: str) -> bool:
    """Tell whether a file is SVG: by its ending, unless its first lines are those of DXF; else by its first lines."""
    begin = data[:4096]
    return b"<svg" in begin or name.lower().endswith((".svg", ".svgz")) and _DXF.match(begin) is None


def _content(data: bytes, name: str, options: ReadOptions) -> tuple[Content, Account]:
    """Return a file's content, and an account that has its units."""
    if _is_svg(data, name):
        if options.encoding:
            raise UserError(Finding("encoding-for-dxf"))
        return _svg_content(data, name, options)
    file = dxf_file.load(data, options.encoding)
    units = (*file.units, TOLD) if file.units else ("mm", 1.0, NOT_TOLD)
    more = Phrase("units-inches") if file.is_imperial and not file.units else None
    if options.units:
        units, more = (options.units, UNITS[options.units], ASKED), None
    report = Account(name, units[0], units[2], units[1], more, findings=file.notes)
    return dxf_entities.collect(file, options, units[1]), report


def _svg_content(data: bytes, name: str, options: ReadOptions) -> tuple[Content, Account]:
    """The same of an SVG file: its shapes are in pixels, its page may tell how large one is."""
    from skg.reading import svg_file, svg_shapes  # (slow to import, and no DXF drawing needs them)

    page = svg_file.SvgFile(data)
    declared, px = page.units, page.px
    more = None if declared and px == svg_file.PX else Phrase(page.guessed)
    units = (*declared, TOLD) if declared else ("px", px, NOT_TOLD)
    if options.units:
        more = None
        # Without a page in mm or inches a pixel is one of the units asked for.
        units = options.units, UNITS[options.units], ASKED
        px = UNITS[options.units] * (px / declared[1] if declared else 1.0)
    content = svg_shapes.collect(page, px, options)
    dots = page.page.size if page.page and not declared and not options.units else None
    return content, Account(name, units[0], units[2], units[1], more, findings=list(content.notes), page=dots)


def _nothing(content: Content, options: ReadOptions) -> Finding:
    """Explain why there is nothing to cut."""
    reasons = Counter((entity.kind, entity.reason) for entity in content.entities)
    summary = tuple(
        Phrase("kind-and-reason", count=count, kind=kind, reason=reason)
        for (kind, reason), count in reasons.most_common(5)
    )
    advice = None
    unseen = sorted({entity.layer for entity in content.entities if options.is_hidden(entity.reason)})
    if unseen and not options.layers:
        advice = Phrase("take-that-layer", layer=unseen[0])
    elif any(entity.kind in AREAS for entity in content.entities):
        advice = Phrase("draw-outlines")
    where = Phrase("on-some-layers", layers=options.layers) if options.layers else None
    return Finding(
        "nothing-to-cut", where=where, summary=Phrase("in-sum", reasons=summary) if summary else None, advice=advice
    )


def _no_outline(report: Account) -> Finding:
    """Explain why no contour remains."""
    if not report.rest and not report.open_ends:
        reasons = dict.fromkeys(reason for layer in report.layers for reason in layer.why if reason != NOTE)
        return Finding("nothing-in-units", units=report.units, reasons=tuple(reasons))
    if not report.rest:
        return Finding("no-outline-gap", gap=report.first_gap())
    places = tuple(entity.place for entity in report.rest[:3])
    return Finding("no-outline-junctions", count=len(report.rest), places=places, place=places[0])


def _measure(contours: list[Contour], report: Account) -> None:
    """The box around the contours."""
    boxes, _ = boxes_of(contours)
    report.low, report.high = (tuple(place.tolist()) for place in (boxes[:, :2].min(0), boxes[:, 2:].max(0)))


def _check_size(report: Account) -> None:
    """Refuse an implausible size with unconfirmed units, and a drawing too large for a tape; say what units it may be
    in."""
    before = len(report.findings)
    (width, height), largest = report.size, max(report.size)
    size: dict[str, Any] = {"width": width, "height": height}
    is_told = report.units_from != NOT_TOLD
    if not is_told and not USUAL[0] <= largest <= USUAL[1]:
        other = _in_other_units(report, units=GUESSED)
        raise UserError(Finding("size-implausible", units=tuple(UNITS), other=other, **size))
    if largest >= FARTHEST:
        other = _in_other_units(report) or _in_other_units(report, FARTHEST)
        raise UserError(Finding("size-too-far", units=report.units, most=FARTHEST / 1000, other=other, **size))
    other = _in_other_units(report, LARGE) or (_in_other_units(report) if largest > USUAL[1] else None)
    is_odd = report.units_from == TOLD and other and not USUAL[0] <= largest <= LARGE
    if is_odd:
        # (programs write the units that they were last set to)
        report.findings.append(Finding("size-odd", other=other, **size))
    if not is_told and other and largest < DOUBTED:
        report.findings.append(Finding("size-small", other=other, **size))
    other = _in_other_units(report, LARGE, GUESSED)
    if not is_told and other and largest > LARGE:
        report.findings.append(Finding("size-large", other=other, **size))
    elif largest > HUGE and not is_odd and report.units_from != ASKED:
        report.findings.append(Finding("size-huge", limit=HUGE / 1000, **size))
    if len(report.findings) == before and report.units_from != ASKED:
        report.findings += _likely(report)


def _likely(report: Account) -> Iterator[Finding]:
    """Report units in which the size is whole millimetres, where it is not as it was read; of a page in dots also how
    many of them are an inch if it is a sheet of paper."""
    read = report.size
    dots = UNITS["inch"] / report.factor
    if report.page and not _paper(report.page, dots):
        for inch in _DOTS:
            if name := _paper(report.page, inch):
                size = read[0] * dots / inch, read[1] * dots / inch
                yield _sized("page-in-dots", read, size, paper=name, dots=inch, were=round(dots))
                return
    if _is_whole(read):
        return
    if report.page or report.units == "px":
        others = {} if report.page and _paper(report.page, dots) else {str(inch): dots / inch for inch in _DOTS}
    else:
        others = {"mm": {"inch": 25.4}, "inch": {"mm": 1 / 25.4}}.get(report.units, {})
    for name, times in others.items():
        size = read[0] * times, read[1] * times
        if _is_whole(size) and max(size) >= USUAL[0]:
            code = "size-in-dots" if name.isdigit() else "size-in-other-units"
            yield _sized(code, read, size, units=name)
            return


def _sized(code: str, read: XY, other: XY, **values: Any) -> Finding:  # noqa: ANN401
    """A finding with the size as it was read, and as it may be, mm."""
    return Finding(code, width=read[0], height=read[1], wide=other[0], high=other[1], **values)


def _is_whole(size: XY) -> bool:
    """Tell whether width and height are whole millimetres, as inches with four decimals are."""
    return all(round(side) >= 1 and abs(side - round(side)) <= _WHOLE for side in size)


def _paper(page: XY, inch: int | float) -> str:
    """The sheet of paper that a page is, in dots of which so many are an inch; empty if it is none."""
    sides = sorted(side / inch * UNITS["inch"] for side in page)
    for name, paper in _PAPERS.items():
        if all(abs(side - whole) <= UNITS["inch"] / inch for side, whole in zip(sides, paper, strict=True)):
            return name
    return ""


def _in_other_units(report: Account, most: float = USUAL[1], units: tuple[str, ...] = GUESSED[:3]) -> Phrase | None:
    """The size that a drawing has in units that make it a usual one, of `most` mm."""
    sizes = []
    for name in units:
        width, height = (side / report.factor * UNITS[name] for side in report.size)
        if name != report.units and USUAL[0] <= max(width, height) <= most:
            sizes.append(Phrase("size-in-units", width=width, height=height, units=name))
    return Phrase("would-be", sizes=tuple(sizes)) if sizes else None
