"""The report on a tape that has been made and checked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import suppress

from skg.checking.follow import Threading
from skg.checking.wire_path import LIMIT
from skg.cutting.job import CutResult
from skg.cutting.manner import manners, numbered, stops
from skg.cutting.refusal import into
from skg.geometry.offset import NoRoom, sharpest, uncut, wire_way
from skg.geometry.plane import XY
from skg.messages.finding import Finding
from skg.planning.nesting import said
from skg.planning.route import PlannedContour
from skg.tape.simulation import duration
from skg.wording import counted, report_line, short, shown

#: Places that a line of the report names before it says how many more there are.
_PLACES = 5
#: Manners of cutting that have a line each.
_MANNERS = 20
#: So many pairs of contours it names of which one is cut into by the other's wire.
_PAIRS = 100


def report(job: CutResult, offset: float = 0.0) -> list[Finding]:
    """Return the report on a tape, line by line. `offset`: as asked for, mm."""
    routes = job.routes
    return [
        *map(report_line, _facts(job, offset)),
        *(report_line(f"not cut: {contour.name}: {contour.why}", contour.number) for contour in job.left[:_PLACES]),
        *_more(job.left, "more contour left out", "more contours left out"),
        *map(report_line, said((route.turn, route.around) for route in routes)),
        *_corners(routes),
        *_crossings(job),
    ]


def _facts(job: CutResult, offset: float) -> Iterator[str]:
    """Order, manners, length, how the tape was made and what the check found."""
    machine, routes = job.machine, job.routes
    kinds = Counter(route.kind for route in routes)
    holes = [shown(route.start) for route in routes]
    yield (
        f"cut in this order: {', '.join(counted(count, kind) for kind, count in kinds.items())}; "
        f"{counted(len(holes), 'start hole')}: {', '.join(holes[:_PLACES])}"
        + (f" and {len(holes) - _PLACES} more" if len(holes) > _PLACES else "")
    )
    yield from _manners(routes, offset)
    yield (
        f"cut length {job.cut_length:.1f} mm, {duration(job.seconds)} at {machine.feed:g} mm/min; "
        f"{counted(len(job.tape.blocks), 'block')}, {counted(len(job.tape.stops), 'stop')}"
    )
    if reasons := "; ".join(stops(routes)):
        yield f"two stops each time, wire off and wire threaded: {reasons}"
    how = (
        "a stored program"
        if job.is_stored
        else "lines without numbers, carried out as they are loaded: stored it would not fit"
    )
    yield f"made by the {machine.rom} ROM with {machine.ram} KiB of RAM from {how}"
    checked = f"checked with the controller's simulation: at most {1000 * job.checked.off:.2f} µm off the drawing"
    if drift := job.checked.drift:
        yield checked
        yield (
            f"take care: the misses of arcs add up on the machine, to {1000 * drift:.2f} µm beside that: "
            "--rom no-drift makes a tape without"
        )
    else:
        yield checked + _closing(job.checked.cuts, routes)


def _crossings(job: CutResult) -> Iterator[Finding]:
    """Cuts that come into other contours."""
    routes, crossings = job.routes, job.checked.crossings
    for gouge in crossings[:_PLACES]:
        route = routes[gouge.route]
        text = f"contour {route.turn} comes {into(gouge)} contour {routes[gouge.other].turn} at {shown(gouge.place)}"
        yield report_line(f"take care: the cut of {text}", route.number, gouge.place)
    if more := crossings[_PLACES:]:
        pairs = (f"{routes[gouge.route].turn} into {routes[gouge.other].turn}" for gouge in more[:_PAIRS])
        yield report_line(
            f"take care: {counted(len(more), 'more cut')} into other contours: {', '.join(pairs)}"
            + " …" * (len(more) > _PAIRS)
        )


def _manners(routes: list[PlannedContour], offset: float) -> Iterator[str]:
    """The way contours are cut, those alike in one line."""
    alike = manners(routes)
    for manner, numbers in list(alike.items())[:_MANNERS]:
        nouns = manner.kind + "s" * (len(numbers) > 1)
        yield f"{numbered(numbers)}, {nouns}: {manner.told}"
    if more := [number for numbers in list(alike.values())[_MANNERS:] for number in numbers]:
        yield f"and {counted(len(more), 'contour')} more, each in its own manner: the sheet and the program have them"
    if not any(any(manner.passes) for manner in alike):
        if not offset and any(route.contour.is_closed for route in routes):
            yield (
                "take care: the wire's middle runs on the contours: no --wire and no --offset, outlines come out "
                "smaller by half a kerf all around"
            )
        return
    free = [
        route.turn
        for route in routes
        if route.contour.is_closed and len(route.passes) > 1 and not route.tab and not route.is_opening
    ]
    if free:
        yield (
            f"take care: {counted(len(free), 'part')} free after the first pass {_contours(free)}: --tab keeps a bridge"
        )
    yield from _sides(routes)
    if on := sum(not route.contour.is_closed and not any(route.passes) for route in routes):
        yield f"take care: the wire's middle runs on {counted(on, 'open contour')}: offset not applied"


def _sides(routes: list[PlannedContour]) -> Iterator[str]:
    """Contours that the wire runs beside on the side that --side says, not on that of a part with openings."""
    closed = [route for route in routes if route.contour.is_closed and route.passes[-1]]
    if not any(route.depth for route in closed):
        return
    for is_opening, side, noun, than in (
        (True, "outside", "opening", "wider"),
        (False, "inside", "outline", "smaller"),
    ):
        affected = [route for route in closed if route.is_opening is is_opening is route.is_outside]
        if affected:
            wide = " or ".join(dict.fromkeys(short(2 * abs(route.passes[-1])) for route in affected))
            yield (
                f"take care: the wire runs {side} of {counted(len(affected), noun)} "
                f"{_contours([route.turn for route in affected])}: {wide} mm {than} than drawn, because of --side"
            )


def _contours(numbers: list[int]) -> str:
    """Some contours, the first ones by their numbers."""
    return f"(contour {', '.join(map(str, numbers[:_PLACES]))}{' …' * (len(numbers) > _PLACES)})"


def _corners(routes: list[PlannedContour]) -> list[Finding]:
    """Contours that the wire cannot follow everywhere: those that it stays off most first."""
    straight, around, chords, loops, whiskers = [], [], [], [], []
    off = _in_sharp_ones(routes)
    for route in routes:
        for lines, places, noun, what in (
            (loops, route.loops, "loop", "smaller than the wire"),
            (whiskers, route.whiskers, "line", "that it runs along and back"),
        ):
            if places:
                many, place = counted(len(places), noun), places[0].place
                longest = short(max(trim.length for trim in places))
                text = f"take care: contour {route.turn} has {many} {what}, as at {shown(place)}"
                text += f", up to {longest} mm long: not cut"
                lines.append(report_line(text, route.number, place))
        if route.is_cramped:
            why = "has no room" if route.is_square else "has a start hole that is not square to its edge, no place"
            straight.append(_about(route, f"{why} for a lead along an arc: it is straight"))
        if route.is_around:
            around.append(_about(route, "has sharp tips: the wire goes along an arc around them"))
        if not route.traced or route.is_around:
            continue
        if not any(route.passes):
            text = "is cut along chords: a controller would leave one of its arcs or curves too far"
            chords.append(_about(route, text))
            continue
        far, place = uncut(route.contour, route.traced[-1], route.passes[-1])
        if far > LIMIT:
            off.append((far, place, route))
    narrow = [
        report_line(
            f"take care: contour {route.turn} has corners that are too narrow for the wire, as at {shown(place)}: "
            f"it stays {short(far)} mm off",
            route.number,
            place,
        )
        for far, place, route in sorted(off, key=lambda corner: -corner[0])
    ]
    return [line for lines in (straight, around, chords, loops, whiskers, narrow) for line in _first(lines)]


def _about(route: PlannedContour, text: str) -> report_line:
    return report_line(f"contour {route.turn} {text}", route.number, route.entry)


def _in_sharp_ones(routes: list[PlannedContour]) -> list[tuple[float, XY, PlannedContour]]:
    """Distance (mm) of the wire from the sharp inner corners of contours that are cut as they are, the place, and of
    which contour: the worst first, and those that may be named as measured."""
    corners = []
    for route in routes:
        is_beside = route.contour.is_closed and route.passes and route.passes[-1]
        if (
            is_beside
            and (route.is_around or not route.traced)
            and (corner := sharpest(route.contour, route.passes[-1]))
        ):
            corners.append((*corner, route))
    corners.sort(key=lambda corner: -corner[0])
    for number, (_, _, route) in enumerate(corners[:_PLACES]):
        with suppress(NoRoom):
            wire = route.traced[-1] if route.traced else wire_way(route.contour, route.passes[-1])
            corners[number] = *uncut(route.contour, wire, route.passes[-1]), route
    return corners


def _first(lines: list[Finding]) -> list[Finding]:
    """The first lines of a kind, one for each contour, and how many more there are."""
    return [*lines[:_PLACES], *_more(lines, "more such contour")]


def _more(every: Sequence, noun: str, nouns: str = "") -> list[Finding]:
    """Number of entries left out of a list with a line each."""
    more = len(every) - _PLACES
    return [report_line(f"and {counted(more, noun, nouns)}")] * (more > 0)


def _closing(cuts: list[Threading], routes: list[PlannedContour]) -> str:
    closed = {cut.route for cut in cuts if routes[cut.route].contour.is_closed and not routes[cut.route].tab}
    if not closed:
        return ""
    end = "ends where it begins" if len(closed) == 1 else "end where they begin"
    return f"; {counted(len(closed), 'closed contour')} {end}"
