"""A job, step by step: its drawing is read, its contours are found in it, planned, and cut.

    opened = open_drawing(job, data)
    plan_drawing(job, opened)
    result = cut_drawing(job, opened)

The command line and the page make a `Job` and call these.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from hashlib import sha256
from typing import Any

from skg.checking.as_drawn import as_drawn
from skg.checking.check_drawn import NEAR, Named, off_drawn, off_size
from skg.cutting.cost import Cost
from skg.cutting.ladder import CutResult, Skipped, make
from skg.cutting.progress import Progress, in_silence
from skg.cutting.report import findings
from skg.errors import UserError
from skg.geometry.contour import Contour
from skg.geometry.placement import Placement
from skg.geometry.plane import XY, shifted
from skg.job.job import Chosen, Job
from skg.job.matching import Known, Matches
from skg.job.placing import Copies, Place
from skg.job.read_options import ReadOptions
from skg.job.values import LEAST_FIT
from skg.job.wanted import CutSettings
from skg.messages.finding import Finding, Phrase
from skg.pipeline import pairing, placing
from skg.planning.copies import Pattern, refuse_near
from skg.planning.nesting import Nesting
from skg.planning.plan import Asked, plan_nested
from skg.planning.planned import PlannedContour
from skg.reading.account import Account
from skg.reading.read import Reading, read
from skg.reading.selection import SMALL, TOO_SHORT, UNWANTED, WITHIN


@dataclass(frozen=True)
class OpenedDrawing:
    """A job's drawing, read, with what lies in what, and where the contours that the job has settings for are.

    `name`: what messages call it. `member`: which of a pair is cut of it, see `skg.pipeline.pairing`; "": the part.
    `sized`: the contours, by their numbers, that this one has in a size of its own.
    """

    name: str
    data: bytes
    reading: Reading
    nesting: Nesting
    known: Known
    matches: Matches
    member: str = ""
    sized: Mapping[int, Contour] = field(default_factory=dict)
    #: The nesting as it lies on the machine, where that was asked for last.
    _placed: dict[tuple, Nesting] = field(default_factory=dict, compare=False)

    @property
    def contours(self) -> list[Contour]:
        """The contours, by their numbers."""
        return self.reading.contours

    @property
    def source(self) -> tuple[str | Phrase, ...]:
        """The source of messages on it: its name, and its move near, as the places in them are moved."""
        by = self.reading.noted.by
        return (self.name,) if by == (0.0, 0.0) else (self.name, Phrase("moved-by", by=by))

    @property
    def whole(self) -> OpenedDrawing:
        """The drawing as the part, of which it may be a member."""
        return replace(self, member="") if self.member else self

    @cached_property
    def sha256(self) -> str:
        """The sum of the file's bytes."""
        return sha256(self.data).hexdigest()

    @cached_property
    def cut_nesting(self) -> Nesting:
        """The contours as they are cut, where they are drawn: what lies in what is as it is drawn."""
        if not self.sized:
            return self.nesting
        contours = [self.sized.get(number, contour) for number, contour in enumerate(self.contours)]
        return Nesting(contours, self.nesting.depths, self.nesting.around)

    def chosen(self, job: Job) -> dict[int, Chosen]:
        """The job's settings by the numbers of contours; places are where the drawing is now."""
        return {
            match.number: _moved(chosen, match.shift)
            for chosen, match in zip(job.contours, self.matches.found, strict=True)
            if match.number is not None
        }

    def placement(self, job: Job) -> Placement:
        """The placement of the drawing on the machine; a `UserError` where it would lie too far away."""
        # (most drawings lie where they are drawn, and nobody waits to hear which contours these are)
        cut = [] if job.place == Place() else self._cut(job)
        return placing.placement_of(job.place, cut, self.matches.shift)

    def pattern(self, job: Job) -> Pattern | None:
        """The copies of it on the machine, None: it is alone; a `UserError` where they are too far away."""
        if job.copies.count == 1:
            return None
        return placing.pattern_of(self.copies(job), self.placement(job), self._cut(job))

    def copies(self, job: Job) -> Copies:
        """The copies that the job asks for; places are where the drawing is now."""
        about = job.copies.about
        return replace(job.copies, about=about and shifted(about, self.matches.shift))

    def _cut(self, job: Job) -> list[Contour]:
        """The contours that are cut."""
        contours = self.cut_nesting.contours
        return [contour for contour, want in zip(contours, wanted_of(job, self), strict=True) if want.cut]

    def placed(self, job: Job) -> Nesting:
        """The contours on the machine; a `UserError` where they, or their copies, are too far away, or
        these too near to each other."""
        placement, pattern = self.placement(job), self.pattern(job)
        if placement.is_nothing and not pattern:
            return self.cut_nesting
        wanted = [want for want in wanted_of(job, self) if want.cut]
        reach = max((2 * (want.lead + want.widest) for want in wanted), default=0.0)
        kerf = 2 * max((want.widest for want in wanted), default=0.0)
        key = placement, pattern, reach, kerf, job.policy.into
        if key not in self._placed:
            self._placed.clear()
            if pattern:
                with placing.told_as_drawn(placement):
                    cut = [placement.contour(contour) for contour in self._cut(job)]
                    refuse_near(pattern, cut, kerf, job.policy.into == "cut")
            self._placed[key] = placing.placed_nesting(self.cut_nesting, placement, pattern, reach)
        return self._placed[key]


def _moved(chosen: Chosen, by: XY) -> Chosen:
    """A chosen contour with its start hole, its entry and its tabs elsewhere."""
    settings = chosen.overrides.set_fields()
    places: dict[str, Any] = {key: shifted(settings[key], by) for key in ("start", "entry") if key in settings}
    if isinstance(tabs := settings.get("tabs"), tuple):
        places["tabs"] = tuple(shifted(tab, by) for tab in tabs)
    return replace(chosen, overrides=replace(chosen.overrides, **places))


@dataclass(frozen=True)
class CutDrawing:
    """A checked tape with its report, and its cost. `account`: that of the drawing, with what was left out among what
    is not cut; `placement`: where the drawing lies on the machine; `member`: which of a pair it is, if of one."""

    result: CutResult
    account: Account
    cost: Cost
    findings: list[Finding]
    placement: Placement = Placement()
    member: str = ""


def open_drawing(job: Job, data: bytes, name: str = "") -> OpenedDrawing:
    """Read a job's drawing and find the contours that it has settings for. `name`: what messages call the drawing."""
    name = name or job.drawing
    reading = read(data, name, read_options_of(job))
    nesting = Nesting.of(reading.contours, reading.others, reading.opened)
    known = Known(reading.contours, [nesting.kind(number) for number in range(len(reading.contours))])
    return OpenedDrawing(name, data, reading, nesting, known, known.find(job.contours, job.box))


def read_options_of(job: Job) -> ReadOptions:
    """Options for reading the drawing: open contours are refused by default where the wire runs beside contours, and
    curves that grow are fitted so much nearer."""
    fit = max(job.read.fit_tolerance / max(1.0, job.place.scale), LEAST_FIT)
    return replace(job.read, open=job.read.open or ("refuse" if job.is_beside else "cut"), fit_tolerance=fit)


def wanted_of(job: Job, opened: OpenedDrawing) -> list[CutSettings]:
    """Settings for each contour; places are where the drawing is now."""
    layers = {layers: job.of(layers) for layers in {contour.layers for contour in opened.contours}}
    wanted = [layers[contour.layers] for contour in opened.contours]
    for number, chosen in opened.chosen(job).items():
        wanted[number] = job.of(opened.contours[number].layers, chosen)
    return pairing.pair_wanted(wanted, opened.nesting, opened.member) if opened.member else wanted


def members_of(job: Job, opened: OpenedDrawing) -> list[OpenedDrawing]:
    """The drawing as the part, or once as the punch and once as the die."""
    with placing.told_as_drawn(Placement(), *opened.source):
        wanted = wanted_of(job, opened)
        members = pairing.members(wanted, opened.nesting)
    return [_member(member, wanted, opened) for member in members] if any(members) else [opened]


def _member(member: str, wanted: list[CutSettings], opened: OpenedDrawing) -> OpenedDrawing:
    """The drawing as one of a pair. `wanted`: settings for the part."""
    try:
        with placing.told_as_drawn(Placement(), *opened.source):
            sized = pairing.sized(wanted, opened.nesting, member)
    except UserError as error:
        raise error.within(pairing.named(member)) from None
    return replace(opened, member=member, sized=sized, _placed={})


def plan_drawing(job: Job, opened: OpenedDrawing) -> list[PlannedContour]:
    """The contours in the order in which they are cut. A contour that is lost, or that cannot be planned, is a
    `UserError`."""
    refuse_lost(job, opened)
    with placing.told_as_drawn(Placement(), *opened.source):
        wanted = wanted_of(job, opened)
    return plan_placed(job, opened, wanted)


def plan_placed(
    job: Job,
    opened: OpenedDrawing,
    wanted: list[CutSettings],
    before: dict[int, tuple[Asked, PlannedContour]] | None = None,
) -> list[PlannedContour]:
    """Plan contours on the machine; see `plan_nested`. `wanted`: settings for each, with places of the drawing."""
    with placing.told_as_drawn(Placement(), *opened.source):
        placement, nesting = opened.placement(job), opened.placed(job)
    on_machine = [
        placing.placed_wanted(want, contour.is_closed, placement)
        for contour, want in zip(opened.contours, wanted, strict=True)
    ]
    starts = [placement.place(start) for start in starts_of(job, opened)]
    with placing.told_as_drawn(placement, *opened.source):
        return plan_nested(nesting, starts, on_machine, before)


def starts_of(job: Job, opened: OpenedDrawing) -> list[XY]:
    """The start holes, where the drawing is now."""
    starts = [shifted(start, opened.matches.shift) for start in job.starts] or opened.reading.starts
    if not opened.member:
        return starts
    return pairing.pair_starts(starts, wanted_of(job, opened.whole), opened.nesting, opened.member)


def refuse_lost(job: Job, opened: OpenedDrawing) -> None:
    """Refuse a job with settings for a contour that is not there."""
    lost = opened.matches.lost
    for index in lost:
        more = Phrase("nor-others", count=len(lost) - 1) if len(lost) > 1 else None
        finding = Finding("contour-lost", index=index + 1, name=job.contours[index].name, more=more)
        raise UserError(finding.within(*opened.source))


def cut_all(job: Job, opened: OpenedDrawing, progress: Progress = in_silence) -> list[CutDrawing]:
    """Make the tape, or that of a punch and that of its die; nothing is returned where one of both is refused."""
    cuts = []
    for each in members_of(job, opened):
        try:
            cuts.append(cut_drawing(job, each, progress))
        except UserError as error:
            raise (error.within(pairing.named(each.member)) if each.member else error) from None
    return cuts


def cut_drawing(job: Job, opened: OpenedDrawing, progress: Progress = in_silence) -> CutDrawing:
    """Make the tape and check it; nothing is returned that is wrong."""
    progress("plan", 0, len(opened.contours))
    contours = plan_drawing(job, opened)
    placement = opened.placement(job)
    opened.placed(job).release()
    with placing.told_as_drawn(placement, *opened.source):
        pattern = opened.pattern(job)
        result = make(contours, job, progress, pattern)
    skipped = {number: UNWANTED for number, want in enumerate(wanted_of(job, opened)) if not want.cut}
    if opened.member:
        others = enumerate(wanted_of(job, opened.whole))
        skipped |= {number: pairing.OTHER for number, want in others if want.cut and number in skipped}
    skipped |= {contour.number: _reason(contour) for contour in result.skipped}
    account = opened.reading.account(skipped) if skipped else opened.reading.report
    result = _beside_file(result, job, opened, account, placement)
    cost = Cost.of(result, job.price)
    report = [*_findings(job, opened, account, result, placement, pattern), *cost.findings()]
    return CutDrawing(result, account, cost, report, placement, opened.member)


def _reason(contour: Skipped) -> Phrase:
    """The reason why a contour is not cut, in the account of the drawing."""
    if contour.is_within:
        return WITHIN
    return TOO_SHORT if contour.why.code == "too-short-for-tab" else SMALL


def _beside_file(
    result: CutResult, job: Job, opened: OpenedDrawing, account: Account, placement: Placement
) -> CutResult:
    """The tape compared with the lines of the file, too: it is as far off as its contours are at most, and these. Where
    these differ and no line of the report names the place, a `UserError`."""
    scale = job.place.scale
    named = [Named(mend.place, mend.size) for mend in account.mends]
    copies = opened.copies(job)
    count = len(result.contours) // copies.count
    # (those of the first copy are where the drawing has them)
    for planned in result.contours[:count]:
        trims = (*planned.remarks.loops, *planned.remarks.whiskers)
        named += [Named(placement.back.place(trim.place), trim.length / scale) for trim in trims]
    wanted = wanted_of(job, opened.whole) if opened.sized else []
    worst = 0.0
    for number in range(copies.count):
        copy = result.contours[number * count : (number + 1) * count]
        offs, nominal = [], []
        contours = as_drawn([planned.contour for planned in copy], job.place, placement.origin, copies, number)
        for own, contour in zip((planned.number for planned in copy), contours, strict=True):
            if own in opened.sized:
                growth = pairing.growth(wanted[own], opened.member)
                offs.append(off_size(contour, opened.contours[own], growth))
            nominal.append(opened.contours[own] if own in opened.sized else contour)
        offs.append(off_drawn(nominal, opened.reading.nominal, account.whole, named))
        off, place = max(offs)
        if off > NEAR:
            raise UserError(Finding("off-the-file", place=place, off=1000 * off).within(*opened.source))
        worst = max(worst, off)
    return replace(result, checked=replace(result.checked, off=result.checked.off + scale * worst))


def _findings(
    job: Job, opened: OpenedDrawing, account: Account, result: CutResult, placement: Placement, pattern: Pattern | None
) -> list[Finding]:
    """The report."""
    report = [*account.report(), *_matched(job, opened)]
    report += placing.placed_findings(job.place, placement, pattern, account.size)
    # (start holes are drilled on the machine)
    report += [
        finding if finding.code == "order-of-cutting" else placing.as_drawn(finding, placement)
        for finding in findings(result, job.setup.distance)
    ]
    wanted = wanted_of(job, opened)
    if stock := max((want.passes[-1] for want in wanted if want.cut), default=0.0):
        report.append(Finding("last-pass-leaves", stock=stock))
    # (a contour with a tab of its own is what it is)
    own = {number for number, chosen in opened.chosen(job).items() if chosen.overrides.tab is not None}
    others = [want for number, want in enumerate(wanted) if want.cut and number not in own]
    for is_asked, frees in (
        (any(want.tab for want in others), "part"),
        (any(want.slug_tab for want in others), "slug"),
    ):
        if is_asked and not any(planned.tabs.each for planned in result.contours if planned.frees == frees):
            report.append(Finding(f"no-{frees}-has-tab"))
    if any(overlap.kind != "drawn twice" for overlap in account.overlaps):
        from skg.checking import split_parts

        report += [placing.as_drawn(finding, placement) for finding in split_parts.findings(result.contours)]
    if not opened.member:
        return report
    return pairing.pair_findings(wanted_of(job, opened.whole), opened.nesting, opened.member, report)


def _matched(job: Job, opened: OpenedDrawing) -> list[Finding]:
    """Tell how contours were found in a drawing that has changed."""
    if not job.sha256 or job.sha256 == opened.sha256:
        return []
    by = opened.matches.shift
    is_moved = by != (0.0, 0.0)
    changed = Finding("drawing-moved", drawing=job.drawing, by=by) if is_moved else None
    report = [changed or Finding("drawing-changed", drawing=job.drawing)]
    for chosen, match in zip(job.contours, opened.matches.found, strict=True):
        if match.is_doubtful:
            assert match.number is not None, "what is lost is not doubtful"
            about: dict[str, Any] = {"contour": match.number, "place": opened.contours[match.number].edges[0].start}
            report.append(Finding("matched-far", name=chosen.name, moved=match.moved, **about))
    return report


def written(job: Job, opened: OpenedDrawing) -> Job:
    """The job as a file has it: with the drawing's sum and box, its contours as they are now (but those that are
    lost)."""
    chosen = opened.chosen(job)
    contours = tuple(
        contour if match.number is None else opened.known.choose(match.number, chosen[match.number].overrides)
        for contour, match in zip(job.contours, opened.matches.found, strict=True)
    )
    left, low, right, top = (round(bound, 6) + 0.0 for bound in opened.known.box)
    starts = tuple(shifted(start, opened.matches.shift) for start in job.starts)
    place = job.place
    if isinstance(place.origin, tuple):
        place = replace(place, origin=shifted(place.origin, opened.matches.shift))
    return replace(
        job,
        sha256=opened.sha256,
        box=(left, low, right, top),
        place=place,
        copies=opened.copies(job),
        starts=starts,
        contours=contours,
    )
