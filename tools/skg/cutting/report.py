"""The report on a tape that has been made and checked."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import suppress

from skg.checking.follow import Threading
from skg.checking.wire_path import LIMIT
from skg.cutting.job import CutResult
from skg.cutting.refusal import into, kind, told_in_file
from skg.geometry.offset import NoRoom, sharpest, uncut, wire_way
from skg.geometry.plane import XY
from skg.planning.nesting import said
from skg.planning.route import PlannedContour
from skg.tape.simulation import duration
from skg.wording import counted, short

#: Places that a line of the report names before it says how many more there are.
_PLACES = 5
#: So many pairs of contours it names of which one is cut into by the other's wire.
_PAIRS = 100


def report(job: CutResult, factor: float, offset: float = 0.0) -> list[str]:
    """Return the report on a tape, line by line. `offset`: as asked for, mm."""
    settings, routes = job.settings, job.routes
    kinds = Counter(kind(route) for route in routes)
    order = ", ".join(counted(count, one) for one, count in kinds.items())
    holes = [route.start for route in routes]
    lines = [
        f"cut in this order: {order}; {counted(len(holes), 'start hole')}: "
        + ", ".join(told_in_file(hole, factor) for hole in holes[:_PLACES])
        + (f" and {len(holes) - _PLACES} more" if len(holes) > _PLACES else "")
    ]
    lines += _offsets(routes, offset)
    lines += [
        f"cut length {job.cut_length:.1f} mm, {duration(job.seconds)} at {settings.feed:g} mm/min; "
        f"{counted(len(job.tape.blocks), 'block')}, {counted(len(job.tape.stops), 'stop')}",
        _how(job),
        f"checked with the controller's simulation: at most {1000 * job.checked.off:.2f} µm off the drawing"
        + (_closing(job.checked.cuts, routes) if not job.checked.drift else ""),
    ]
    if drift := job.checked.drift:
        lines.append(
            f"take care: the misses of arcs add up on the machine, to {1000 * drift:.2f} µm beside that: "
            "--rom no-drift makes a tape without"
        )
    lines += [f"take care, left out: {one.name}: {one.why}" for one in job.left[:_PLACES]]
    if len(job.left) > _PLACES:
        lines.append(f"and {counted(len(job.left) - _PLACES, 'more contour')} left out")
    lines += said(route.around for route in routes)
    lines += _corners(routes, factor)
    for crossing in job.checked.crossings[:_PLACES]:
        lines.append(
            f"take care: the cut of contour {crossing.route + 1} comes {into(crossing)} contour {crossing.other + 1} "
            f"at {told_in_file(crossing.place, factor)}"
        )
    if more := job.checked.crossings[_PLACES:]:
        lines.append(
            f"take care: {counted(len(more), 'more cut')} into other contours: "
            + ", ".join(f"{one.route + 1} into {one.other + 1}" for one in more[:_PAIRS])
            + " …" * (len(more) > _PAIRS)
        )
    return lines


def _offsets(routes: list[PlannedContour], offset: float) -> list[str]:
    passes = next((route.passes for route in routes if any(route.passes)), ())
    on = sum(not any(route.passes) for route in routes)
    if not passes:
        is_any_closed = any(route.contour.is_closed for route in routes)
        often = max(len(route.passes) for route in routes)
        line = f"the wire's middle runs on the contours{_passes(often)}: "
        if offset or not is_any_closed:
            return [line + ("--side on" if is_any_closed else "they are open")]
        return [f"take care: {line}no --wire and no --offset, outlines come out smaller by half a kerf all around"]
    lines = [f"the wire runs {', '.join(short(abs(r)) for r in passes)} mm beside the contours{_passes(len(passes))}"]
    if len(passes) > 1:
        free = [at + 1 for at, route in enumerate(routes) if route.contour.is_closed and not route.tab]
        outer = [at for at in free if not routes[at - 1].is_opening]
        if outer:
            lines.append(
                f"take care: {counted(len(outer), 'part')} free after the first pass "
                f"{_contours(outer)}: --tab keeps a bridge"
            )
    lines += _sides(routes)
    if on:
        lines.append(f"take care: the wire's middle runs on {counted(on, 'open contour')}: offset not applied")
    return lines


def _passes(count: int) -> str:
    return f" in {count} passes, every second one backwards" if count > 1 else ""


def _sides(routes: list[PlannedContour]) -> Iterator[str]:
    """Contours that the wire runs beside on the side that --side says, not on that of a part with openings."""
    closed = [(at + 1, route) for at, route in enumerate(routes) if route.contour.is_closed and route.passes[-1]]
    if not any(route.depth for _, route in closed):
        return
    wide = short(2 * abs(closed[0][1].passes[-1]))
    for is_opening, side, noun, than in (
        (True, "outside", "opening", "wider"),
        (False, "inside", "outline", "smaller"),
    ):
        some = [at for at, route in closed if route.is_opening is is_opening is route.is_outside]
        if some:
            yield (
                f"take care: the wire runs {side} of {counted(len(some), noun)} {_contours(some)}: "
                f"{wide} mm {than} than drawn, because of --side"
            )


def _contours(numbers: list[int]) -> str:
    """Some contours, the first ones by their numbers."""
    return f"(contour {', '.join(map(str, numbers[:_PLACES]))}{' …' * (len(numbers) > _PLACES)})"


def _corners(routes: list[PlannedContour], factor: float) -> list[str]:
    """Contours that the wire cannot follow everywhere: those that it stays off most first."""
    straight, around, chords, off = [], [], [], _in_sharp_ones(routes)
    for at, route in enumerate(routes):
        if route.is_cramped:
            why = "has no room" if route.is_square else "has a start hole that is not square to its edge, no place"
            straight.append(f"contour {at + 1} {why} for a lead along an arc: it is straight")
        if route.is_around:
            around.append(f"contour {at + 1} has sharp tips: the wire goes along an arc around them")
        if not route.traced or route.is_around:
            continue
        if not any(route.passes):
            chords.append(
                f"contour {at + 1} is cut along chords: a controller would leave one of its arcs or curves too far"
            )
            continue
        far, place = uncut(route.contour, route.traced[-1], route.passes[-1])
        if far > LIMIT:
            off.append((far, place, at))
    narrow = [
        f"take care: contour {at + 1} has corners that are too narrow for the wire, as at "
        f"{told_in_file(place, factor)}: it stays {short(far)} mm off"
        for far, place, at in sorted(off, key=lambda one: -one[0])
    ]
    return [line for lines in (straight, around, chords, narrow) for line in _first(lines)]


def _in_sharp_ones(routes: list[PlannedContour]) -> list[tuple[float, XY, int]]:
    """Distance (mm) of the wire from the sharp inner corners of contours that are cut as they are, the place, and of
    which contour: the worst first, and those that may be named as measured."""
    found = []
    for at, route in enumerate(routes):
        is_beside = route.contour.is_closed and route.passes and route.passes[-1]
        if is_beside and (route.is_around or not route.traced) and (one := sharpest(route.contour, route.passes[-1])):
            found.append((*one, at))
    found.sort(key=lambda one: -one[0])
    for number, (_, _, at) in enumerate(found[:_PLACES]):
        route = routes[at]
        with suppress(NoRoom):
            way = route.traced[-1] if route.traced else wire_way(route.contour, route.passes[-1])
            found[number] = *uncut(route.contour, way, route.passes[-1]), at
    return found


def _first(lines: list[str]) -> list[str]:
    """The first lines of a kind, one for each contour, and how many more there are."""
    more = len(lines) - _PLACES
    return lines[:_PLACES] + [f"and {counted(more, 'more such contour')}"] * (more > 0)


def _how(job: CutResult) -> str:
    how = (
        "a stored program"
        if job.is_stored
        else "lines without numbers, carried out as they are loaded: stored it would not fit"
    )
    return f"made by the {job.settings.rom} ROM with {job.settings.ram_kib} KiB of RAM from {how}"


def _closing(cuts: list[Threading], routes: list[PlannedContour]) -> str:
    closed = {cut.route for cut in cuts if routes[cut.route].contour.is_closed and not routes[cut.route].tab}
    if not closed:
        return ""
    end = "ends where it begins" if len(closed) == 1 else "end where they begin"
    return f"; {counted(len(closed), 'closed contour')} {end}"
