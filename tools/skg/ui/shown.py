"""Contours, plans and tapes as plain data for the page: mm with four decimals."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import lru_cache
from itertools import islice, pairwise, zip_longest
from typing import Any
from zlib import crc32

import numpy as np
import shapely

from skg.cutting.report import figures
from skg.errors import UserError
from skg.geometry.contour import Edge
from skg.geometry.offset import NoRoom
from skg.geometry.placement import Placement
from skg.geometry.plane import XY
from skg.job.job import Chosen
from skg.job.wanted import CutSettings
from skg.messages.catalogue import LANGUAGES, template
from skg.messages.finding import Finding, Phrase
from skg.messages.render import Medium, Speech, text
from skg.messages.severity import Severity
from skg.pipeline.pairing import named
from skg.pipeline.placing import as_drawn
from skg.pipeline.steps import CutDrawing, OpenedDrawing
from skg.planning import walls
from skg.planning.copies import Pattern
from skg.planning.nesting import findings
from skg.planning.planned import PlannedContour
from skg.planning.runs import Lead, Run
from skg.reading.account import Account
from skg.ui.json_text import each_in_json, encoded, facts, in_json, said, told
from skg.wording import visible

#: Decimals of a length, mm; of a direction, radians.
_LENGTH, _ANGLE = 4, 6
#: A curve is shown by chords that leave it by no more, mm.
_CURVE = 0.0005
#: So many repairs of a kind are offered.
_MOST_REPAIRS = 200
#: So many edges of what is nothing to cut, and so many texts, are shown.
_MOST_NOTED = 50_000
_MOST_TEXTS = 2000
#: The plan of a contour that is not cut.
_LEFT: dict[str, Any] = {
    "cut": False,
    "passes": [],
    "tabs": [],
    **dict.fromkeys(("hole", "entry", "tab", "direction", "radius", "lead_arc")),
}

#: One that is not cut.
_NO_TURN: tuple[int | None, PlannedContour | None] = (None, None)


def place(point: XY) -> list[float]:
    """A place."""
    return [round(point[0], _LENGTH), round(point[1], _LENGTH)]


def edges(pieces: Iterable[Edge]) -> list[list[Any]]:
    """Lines, arcs and curves."""
    return [_edge(edge) for edge in pieces]


def _edge(edge: Edge) -> list[Any]:
    if edge.nodes:
        line = shapely.LineString(edge.samples).simplify(_CURVE)
        return ["c", *np.round(shapely.get_coordinates(line), _LENGTH).ravel().tolist()]
    ordinates = [*place(edge.start), *place(edge.end)]
    return ordinates if edge.centre is None else [*ordinates, *place(edge.centre), round(edge.sweep, _ANGLE)]


def line(entry: Finding, member: str = "") -> dict[str, Any]:
    """A line of a report, on one of a pair."""
    audiences = [Speech(language, Medium.PAGE) for language in LANGUAGES]
    texts = [text(entry, audience) for audience in audiences]
    if member:
        separators = (template("source-separator", language) for language in LANGUAGES)
        names = (text(named(member), audience) for audience in audiences)
        texts = ["".join(parts) for parts in zip(names, separators, texts, strict=True)]
    told_line = {"text": texts, "care": entry.severity is Severity.CARE} | facts(entry)
    # (who has decided on it is not asked again while its values are the same)
    return told_line | ({"key": crc32(repr(entry).encode())} if told_line["care"] else {})


def drawing(opened: OpenedDrawing) -> dict[str, Any]:
    """The drawing."""
    report = opened.reading.report
    on = defaultdict(list)
    for number, contour in enumerate(opened.contours):
        for layer in dict.fromkeys(contour.layers):
            on[layer].append(number)
    layers = [
        {
            "name": layer.layer,
            "contours": on[layer.layer],
            "left": layer.skipped,
            "why": said(Phrase("list", items=tuple(layer.why))),
        }
        for layer in report.layers
    ]
    return {
        "sha256": opened.sha256,
        "size": place(report.size),
        "low": place(report.low),
        "units": report.units,
        "units_from": said(report.told),
        "layers": layers,
        "contours": in_json([_contour(opened, *numbered) for numbered in enumerate(opened.known.choose_all())]),
        "starts": [place(start) for start in opened.reading.starts],
        "left": in_json(_left(opened)),
        "repairs": _repairs(report),
        "report": [line(entry) for entry in report.report()],
    }


def _repairs(report: Account) -> list[dict[str, Any]]:
    """The repairs that may be asked for, the smallest of each kind first; `asked`: as the job has it."""
    count: Counter[str] = Counter()
    repairs = []
    for repair in report.repairs:
        count[repair.kind] += 1
        if count[repair.kind] <= _MOST_REPAIRS:
            asked, places = [round(value, _LENGTH) for value in repair.asked], [place(each) for each in repair.places]
            repairs.append({"kind": repair.kind, "places": places, "asked": asked, "size": round(repair.size, _LENGTH)})
    return repairs


def _left(opened: OpenedDrawing) -> dict[str, Any]:
    """What is not cut: edges of entities that are not cut whole, and texts."""
    reading = opened.reading
    left = [edge for edge in reading.nominal if edge.entity not in reading.report.whole]
    return {
        "edges": edges([*left, *reading.unasked, *islice(reading.noted.every(), _MOST_NOTED)]),
        "notes": [
            {"text": _plain(written.text), "place": place(written.place), "up": place(written.up)}
            for written in reading.written[:_MOST_TEXTS]
        ],
    }


def _plain(text_of_file: str) -> str:
    """A text of a DXF file without its codes."""
    if "\\" not in text_of_file and "%%" not in text_of_file:
        return visible(text_of_file)
    from ezdxf.tools.text import fast_plain_mtext, plain_text

    return "\n".join(map(visible, fast_plain_mtext(plain_text(text_of_file), split=True)))


def _contour(opened: OpenedDrawing, number: int, chosen: Chosen) -> dict[str, Any]:
    contour = opened.contours[number]
    return {
        "id": number,
        "name": f"contour {number + 1}",
        "layer": chosen.layer,
        "layers": list(dict.fromkeys(contour.layers)),
        "kind": chosen.kind,
        "depth": opened.nesting.depths[number],
        "closed": contour.is_closed,
        "at": list(chosen.place),
        "size": list(chosen.size),
        "edges": edges(contour.edges),
    }


#: A contour as it is planned, the wishes for it, and what is wrong with it.
_Planned = tuple[PlannedContour | None, CutSettings, dict | None]


class Plans:
    """The plans of a drawing's contours as JSON: what has not changed since the last one is not written anew."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[_Planned, str]] = {}
        self._told: list[str] = []
        self._walls = walls.Walls()

    def written(
        self,
        contours: Sequence[PlannedContour],
        wanted: Sequence[CutSettings],
        errors: Sequence[UserError],
        placement: Placement,
        pattern: Pattern | None,
    ) -> tuple[bytes, bytes]:
        """The plan of all contours, and the same with those alone that were told otherwise the last time. `placement`:
        where the drawing lies on the machine, `pattern`: its copies; all is told in its own places."""
        turns = {planned.number: (turn, planned) for turn, planned in enumerate(contours, 1)}
        why = {error.contour: told(error) for error in errors if error.contour is not None}
        self._write(
            {number: (turns.get(number, _NO_TURN)[1], want, why.get(number)) for number, want in enumerate(wanted)},
            placement,
        )
        plans = [
            f'"{number}":{{"number":{turns.get(number, _NO_TURN)[0] or "null"},{self._known[number][1]}'
            for number in range(len(wanted))
        ]
        changed = [contour for contour, before in zip_longest(plans, self._told) if contour and contour != before]
        self._told = plans
        data = {
            "order": [planned.number for planned in contours],
            "said": [
                line(as_drawn(entry, placement))
                for entry in (
                    *findings((planned.turn, planned.remarks.around) for planned in contours),
                    *walls.findings(contours, self._walls),
                )
            ],
            "error": told(errors[0]) if errors else None,
            "lying": in_json(lying(placement, pattern)),
        }
        whole, part = (
            encoded(data | {"contours": f"{{{','.join(entries)}}}".encode()}) for entries in (plans, changed)
        )
        return whole, part

    def _write(self, plans: dict[int, _Planned], placement: Placement) -> None:
        """Write the plans of contours that are not known, each without its place in the order, and without the brace
        before it."""
        new = {
            number: plan
            for number, plan in plans.items()
            if not (known := self._known.get(number)) or known[0][0] is not plan[0] or known[0][1:] != plan[1:]
        }
        told_plans = [
            (plan_of(planned, placement) if planned else _LEFT) | {"error": wrong} for planned, _, wrong in new.values()
        ]
        for (number, plan), as_json in zip(new.items(), each_in_json(told_plans), strict=True):
            planned, want, _ = plan
            is_slug = planned is not None and planned.contour.is_closed and planned.frees == "slug"
            self._known[number] = plan, f'{as_json[1:-1]},"values":{_values(want, is_slug)}}}'


@lru_cache
def _values(want: CutSettings, is_slug: bool) -> str:
    """The settings for a contour, those of layer and default included, as JSON; `is_slug`: its tab keeps a slug."""
    names = ("cut", "side", "offset", "overlap", "lead", "lead_shape", "reverse", "order", "clearance_on")
    values: dict[str, Any] = {name: getattr(want, name) for name in names}
    values |= {name: list(getattr(want, name)) for name in ("passes", "tab_passes")}
    if want.clearance is not None:
        values["clearance"] = want.clearance
    tabs = want.tabs if isinstance(want.tabs, int) else list(map(list, want.tabs))
    return in_json(values | {"tab": want.slug_tab if is_slug else want.tab, "tabs": tabs}).decode()


def lying(placement: Placement, pattern: Pattern | None) -> dict[str, Any]:
    """The part on the machine, in the places of the drawing: `zero`, what is 0, 0, and the ways that x and y run there;
    `copies`: of each but the first one the matrix (a, b, c, d, x, y) that takes the part there."""
    back = placement.back
    zero = back.place((0.0, 0.0))
    ends = back.place((1.0, 0.0)), back.place((0.0, 1.0))
    corner, *axes = (placement.place(point) for point in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
    copies = []
    for to in pattern.placements[1:] if pattern else []:
        (x, y), (a, b), (c, d) = (back.place(to.place(point)) for point in (corner, *axes))
        copies.append([round(value, 9) for value in (a - x, b - y, c - x, d - y, x, y)])
    return {
        "zero": None if placement.is_nothing else place(zero),
        "axes": [[round(x - zero[0], 6), round(y - zero[1], 6)] for x, y in ends],
        "copies": copies,
    }


def plan_of(planned: PlannedContour, placement: Placement) -> dict[str, Any]:
    """The plan of a contour, without the settings for it, in the places of the drawing."""
    back = placement.back
    # (R is to the right of the way, and its distance that of the drawing)
    times = (-1 if back.is_mirror else 1) * back.scale
    edge = back.edge(planned.chain[0])
    tabs = [
        [place(back.place(p)) for p in (edges[0].start, edges[-1].end, tab.before, tab.behind)]
        for (_, edges), tab in zip(planned.spans, planned.tabs.each, strict=True)
    ]
    return {
        "cut": True,
        "hole": place(back.place(planned.start)),
        "entry": place(back.place(planned.entry)),
        "tab": tabs[-1][0] if tabs else None,
        "tabs": tabs,
        "direction": round(edge.direction(), _ANGLE),
        "radius": round(times * planned.offset, _LENGTH),
        "passes": [round(times * r, _LENGTH) for r in planned.passes],
        "lead_arc": planned.is_arc and planned.is_square,
    }


def ways(planned: PlannedContour, placement: Placement) -> list[list[list[Any]]]:
    """The ways of the wire's middle along a contour, with those from its start holes and to them, in the places of the
    drawing; none where the wire does not get around it."""
    if planned.contour.is_closed and any(planned.passes) and not planned.rung.wire:
        with suppress(NoRoom):
            return ways(planned.along_wire(), placement)
        return []
    return [edges(map(placement.back.edge, _wire(run, planned))) for run in planned.runs()]


def _wire(run: Run, planned: PlannedContour) -> Iterator[Edge]:
    """The wire's middle along a way."""
    along = run.edges if not run.offset else _beside(run)
    if not planned.contour.is_closed:
        yield from along
        return
    first, last = along[0].start, along[-1].end
    yield from _lead(run.into, planned.start, first, True)
    yield from along
    yield from _lead(run.out, planned.start, last, False)


def _lead(lead: Lead | None, hole: XY, entry: XY, is_in: bool) -> Iterator[Edge]:
    """The way from a start hole to the contour, or from there to it."""
    hole = lead.hole if lead else hole
    places, arc = [hole, entry], None
    if lead and lead.is_arc:
        arc = lead.arc(is_in)
        places = [hole, arc.start if is_in else arc.end]
    if lead and lead.home:
        places.insert(0, lead.home)
    straight = [Edge(start, end) for start, end in pairwise(places if is_in else places[::-1])]
    arcs = [arc] if arc else []
    yield from [*straight, *arcs] if is_in else [*arcs, *straight]


def _beside(run: Run) -> list[Edge]:
    """The wire's middle beside an open contour, as chords."""
    points = [point for edge in run.edges for point in edge.points()]
    line = shapely.offset_curve(shapely.LineString(points), -run.offset, join_style="mitre")
    corners = shapely.get_coordinates(line).tolist()
    return [Edge((x, y), (u, v)) for (x, y), (u, v) in pairwise(corners)]


def results(cuts: Sequence[CutDrawing]) -> dict[str, Any]:
    """The result of a run: of a punch, `mate` is that of its die, and all lines are in one list."""
    first, *others = map(result, cuts)
    if not others:
        return first
    (mate,) = others
    return first | {"mate": mate, "lines": first["lines"] + mate.pop("lines")}


def result(cut: CutDrawing) -> dict[str, Any]:
    """The result of a cut. `back`: the way from the machine to the drawing: a matrix's rows, what goes to what, mm."""
    made, back = cut.result, cut.placement.back
    return {
        "lines": [line(entry, cut.member) for entry in cut.findings],
        "figures": said(figures(made, cut.cost)),
        "start": place(made.contours[0].start),
        "back": [*back.matrix, *back.origin, *back.at],
    }
