"""The report on a tape that has been made and checked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from skg.checking.follow import Stretch
from skg.checking.wire_path import LIMIT
from skg.cutting.cost import Cost
from skg.cutting.holes import holes_of
from skg.cutting.ladder import CutResult
from skg.cutting.manner import manners, numbered, stops
from skg.cutting.refusal import depth
from skg.job.machine import Setup
from skg.messages.finding import Finding, Phrase, beyond
from skg.planning import nesting, walls
from skg.planning.nesting import in_brackets
from skg.planning.planned import LeadShape, PlannedContour, Reason, kind_of
from skg.planning.room import corners
from skg.tape.simulation import duration

#: Places that a line of the report names before it says how many more there are.
_PLACES = 5
#: Manners of cutting that have a line each.
_MANNERS = 20
#: A tab that stands less proud is flush, mm.
_FLUSH = 1e-6
#: So many pairs of contours it names of which one is cut into by the other's wire.
_PAIRS = 100


def findings(result: CutResult, offset: float = 0.0) -> list[Finding]:
    """Return the report on a tape. `offset`: as asked for, mm."""
    contours = result.contours
    return [
        *_facts(result, offset),
        *(
            Finding("contour-not-cut", name=skipped.name, why=skipped.why, contour=skipped.number)
            for skipped in result.skipped[:_PLACES]
        ),
        *beyond(_PLACES, result.skipped, "more-not-cut"),
        *nesting.findings((planned.turn, planned.remarks.around) for planned in contours),
        *_corners(contours),
        *_crossings(result),
        *walls.findings(contours),
    ]


def _facts(result: CutResult, offset: float) -> Iterator[Finding]:
    """Order, manners, length, how the tape was made and what the check found."""
    contours, board = result.contours, result.board
    kinds = Counter(planned.kind for planned in contours)
    holes = [hole for hole, _ in holes_of(contours)]
    more = len(holes) - _PLACES
    yield Finding(
        "order-of-cutting",
        kinds=tuple(Phrase(f"count-{kind.replace(' ', '-')}", count=count) for kind, count in kinds.items()),
        holes=Phrase("count-holes", count=len(holes)),
        places=tuple(holes[:_PLACES]),
        more=Phrase("and-more", count=more) if more > 0 else None,
    )
    yield from _manners(contours, offset)
    yield Finding(
        "cut-length",
        length=result.cut_length,
        time=duration(result.seconds),
        pace=pace(result.setup),
        blocks=Phrase("count-blocks", count=len(result.tape.blocks)),
        stops=Phrase("count-stops", count=len(result.tape.stops)),
    )
    if reasons := tuple(stops(contours)):
        yield Finding("two-stops", reasons=reasons)
    yield Finding("made-stored" if result.is_stored else "made-loading", rom=board.rom, ram=board.ram)
    drift = result.checked.drift
    closing = None if drift else _closing(result.checked.cuts, contours)
    yield Finding("checked", off=1000 * result.checked.off, closing=closing)
    if drift:
        yield Finding("drift", drift=1000 * drift)


def figures(result: CutResult, cost: Cost) -> Phrase:
    """The figures of the report in one line."""
    return Phrase(
        "outcome",
        off=1000 * result.checked.off,
        blocks=Phrase("count-blocks", count=len(result.tape.blocks)),
        stops=Phrase("count-stops", count=len(result.tape.stops)),
        length=result.cut_length,
        time=duration(result.seconds),
        area=Phrase("outcome-area", area=cost.area) if cost.area else None,
        price=Phrase("outcome-price", price=cost.price) if cost.price else None,
    )


def pace(setup: Setup) -> Phrase:
    """The feed that the time goes by, or the rates."""
    return Phrase("at-rates", rates=setup.rates) if setup.has_rates else Phrase("at-feed", feed=setup.feed)


def _crossings(result: CutResult) -> Iterator[Finding]:
    """Cuts that come into other contours."""
    contours, crossings = result.contours, result.checked.crossings
    for gouge in crossings[:_PLACES]:
        planned = contours[gouge.contour]
        turns = {"turn": planned.turn, "other": contours[gouge.other].turn}
        yield Finding("gouge", depth=depth(gouge), contour=planned.number, place=gouge.place, **turns)
    if more := crossings[_PLACES:]:
        pairs = (
            Phrase("pair-into", turn=contours[gouge.contour].turn, other=contours[gouge.other].turn)
            for gouge in more[:_PAIRS]
        )
        yield Finding("more-gouges", count=len(more), pairs=tuple(pairs), rest=" …" * (len(more) > _PAIRS))


def _manners(contours: list[PlannedContour], offset: float) -> Iterator[Finding]:
    """The way contours are cut, those alike in one line."""
    alike = manners(contours)
    for manner, numbers in list(alike.items())[:_MANNERS]:
        kind = kind_of(manner.kind, len(numbers))
        yield Finding("manner-of", contours=numbered(numbers), kind=kind, manner=manner.phrase)
    if more := sum(len(numbers) for numbers in list(alike.values())[_MANNERS:]):
        yield Finding("more-manners", count=more)
    if not any(any(manner.passes) for manner in alike):
        if not offset and any(planned.contour.is_closed for planned in contours):
            yield Finding("on-the-line")
        return
    free = [
        planned.turn
        for planned in contours
        if planned.contour.is_closed and len(planned.passes) > 1 and not planned.tabs.each and planned.frees == "part"
    ]
    if free:
        yield Finding("parts-free", count=len(free), contours=in_brackets(free))
    yield from _proud(contours)
    yield from _sides(contours)
    if on := sum(not planned.contour.is_closed and not any(planned.passes) for planned in contours):
        yield Finding("open-on-line", count=on)


def _proud(contours: list[PlannedContour]) -> Iterator[Finding]:
    """Tabs that leave more than the last pass, those of a height together."""
    heights: dict[float, list[int]] = {}
    for planned in contours:
        if planned.proud > _FLUSH:
            heights.setdefault(round(planned.proud, 6), []).append(planned.turn)
    for height, turns in heights.items():
        yield Finding("tabs-proud", count=len(turns), height=height, contours=in_brackets(turns))


def _sides(contours: list[PlannedContour]) -> Iterator[Finding]:
    """Contours that the wire runs beside on the side that --side says, not on that of a part with openings."""
    closed = [planned for planned in contours if planned.contour.is_closed and planned.passes[-1]]
    if not any(planned.depth for planned in closed):
        return
    for is_opening in (True, False):
        affected = [planned for planned in closed if planned.is_opening is is_opening is planned.is_outside]
        if affected:
            first, *others = dict.fromkeys(2 * abs(planned.passes[-1]) for planned in affected)
            wide: float | Phrase = first
            for other in others:
                wide = Phrase("one-or-other", first=wide, other=other)
            code = "side-of-openings" if is_opening else "side-of-outlines"
            turns = in_brackets([planned.turn for planned in affected])
            yield Finding(code, count=len(affected), contours=turns, wide=wide)


def _corners(contours: list[PlannedContour]) -> list[Finding]:
    """Contours that the wire cannot follow everywhere: those that it stays off most first."""
    kinds: list[list[Finding]] = [[] for _ in range(5)]
    straight, around, chords, loops, whiskers = kinds
    for planned in contours:
        about = {"turn": planned.turn, "contour": planned.number}
        for code, kind, trims in (
            ("loops", loops, planned.remarks.loops),
            ("whiskers", whiskers, planned.remarks.whiskers),
        ):
            if trims:
                longest = max(trim.length for trim in trims)
                kind.append(Finding(code, count=len(trims), length=longest, place=trims[0].place, **about))
        if planned.rung.lead is LeadShape.CRAMPED:
            code = "straight-lead" if planned.is_square else "straight-lead-aslant"
            straight.append(Finding(code, place=planned.entry, **about))
        reason = planned.rung.wire and planned.rung.wire.reason
        if reason is Reason.TIPS:
            around.append(Finding("around-tips", place=planned.entry, **about))
        elif reason is Reason.CHORDS:
            chords.append(Finding("in-chords", place=planned.entry, **about))
    narrow = [
        Finding("narrow-corners", turn=planned.turn, far=far, contour=planned.number, place=place)
        for far, place, planned in sorted(corners(contours), key=lambda corner: -corner.far)
        if far > LIMIT
    ]
    return [finding for kind in (*kinds, narrow) for finding in _first(kind)]


def _first(kind: list[Finding]) -> list[Finding]:
    """The first findings of a kind, one for each contour, and how many more there are."""
    return [*kind[:_PLACES], *beyond(_PLACES, kind, "more-such-contours")]


def _closing(cuts: list[Stretch], contours: list[PlannedContour]) -> Phrase | None:
    closed = {
        cut.contour for cut in cuts if contours[cut.contour].contour.is_closed and not contours[cut.contour].tabs.each
    }
    return Phrase("closing", count=len(closed)) if closed else None
