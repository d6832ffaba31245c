"""Messages about contours that cannot be cut, and a tape that is not the drawing: place, reason, remedy."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from math import copysign, floor, inf

from skg.checking.check import Checked
from skg.checking.gouges import Crossing
from skg.checking.wire_path import LIMIT, Misfit
from skg.errors import UserError
from skg.geometry.contour import Contour
from skg.geometry.offset import NoRoom, widest, wire_way
from skg.job.job import MachineSetup
from skg.planning.route import PlannedContour
from skg.wording import counted, short, shown

#: Meanings of the errors of a route (language.md, section 6), and advice.
_MEANING = {
    5: ("a number is out of range", "is a radius or a place in the drawing absurdly small or large?"),
    6: (
        "the contour cannot be cut as it is drawn",
        "with an offset a short edge or corner has vanished: try a smaller --offset, another --side or --start; "
        "without one look for edges that nearly touch there",
    ),
    7: ("the offset leaves nothing of an arc's radius", "a thinner wire or a smaller --offset"),
    9: ("the board's memory is full", "a larger --ram"),
    10: ("a move is too long for a tape", "is the drawing in the right --units? a tape ends at 100 m"),
}
#: Of a contour with more edges than this the largest offset that fits is not looked for.
_MANY = 2000


def meaning(error: int) -> str:
    """An error of the ROM in a route, and what to do."""
    cause, then = _MEANING.get(error, ("the board refuses it", "see language.md, section 6"))
    return f"ERR {error:02d}, {cause}: {then}"


def too_short(fit: float) -> str:
    """Explain why a tab does not fit an outline; `fit`: the longest that does, mm."""
    return f"it is too short for the tab, at most {short(floor(fit * 1000 - 1e-6) / 1000)} mm fits"


def without_tab(routes: Mapping[int, PlannedContour], fits: dict[int, float], machine: MachineSetup) -> UserError:
    """Report outlines that their tab does not fit: the shortest one."""
    number = min(fits, key=fits.__getitem__)
    route = routes[number]
    message = f"{route.name}: {too_short(fits[number])}"
    if len(fits) > 1:
        message += f"; {counted(len(fits) - 1, 'more contour')} without room for the tab"
    return UserError(f"{message}: take a shorter --tab{_or_leave(machine)}", route.number, route.entry)


def without_room(routes: Mapping[int, PlannedContour], none: dict[int, NoRoom], machine: MachineSetup) -> UserError:
    """Report contours that the wire does not get around: the tightest one."""
    number, fit = _tightest(routes, none)
    route = routes[number]
    message = f"{route.name}: {none[number]} {shown(none[number].place)}"
    if none[number].is_crossing:
        message += ", the wire does not fit beside it"
        help_ = "redraw it"
    else:
        message += f", {short(abs(route.widest))} mm beside it"
        if fit is not None:
            message += f"; at most {short(fit)} mm fits" if fit else "; no offset fits"
            message += _in_passes(route, fit) if fit else ""
        help_ = "take a smaller offset or a thinner wire"
    if len(none) > 1:
        message += f"; {counted(len(none) - 1, 'more contour')} without room for the wire"
    return UserError(f"{message}: {help_}{_or_leave(machine)}", route.number, none[number].place)


def _in_passes(route: PlannedContour, fit: float) -> str:
    """Return the last pass's offset where the largest that fits belongs to another pass."""
    more = abs(route.widest) - abs(route.passes[-1])
    if not more:
        return ""
    return (
        f" in the widest pass, {short(fit - more)} in the last" if fit > more else ", less than these passes take off"
    )


def _tightest(routes: Mapping[int, PlannedContour], none: dict[int, NoRoom]) -> tuple[int, float | None]:
    """The contour with the least room of some that the wire does not get around, and how far the wire may be beside
    it, mm; None when that is not looked for."""
    tightest: tuple[int, float] | None = None
    for number, no_room in none.items():
        if tightest and not tightest[1]:
            break
        if no_room.is_crossing:
            return number, 0.0
        contour, r = routes[number].contour, routes[number].widest
        if len(contour.edges) <= _MANY and (tightest is None or not _fits(contour, copysign(tightest[1], r))):
            tightest = number, widest(contour, r)
    return tightest or (next(iter(none)), None)


def _fits(contour: Contour, r: float) -> bool:
    """Tell whether the wire gets around a closed contour, R (mm) to the right of it."""
    with suppress(NoRoom):
        return bool(wire_way(contour, r))
    return False


def _or_leave(machine: MachineSetup) -> str:
    return ", or leave such contours out with --small leave" if machine.small else ""


def why_no_room(fault: Misfit) -> str:
    """Explain why the wire does not fit; empty when something else is wrong."""
    place = shown(fault.place)
    if fault.is_into:
        return f"the wire would cut {short(fault.off)} mm into it at {place}"
    return f"the wire does not come to {place}" if fault.is_missed else ""


def off_drawing(faults: list[Misfit], route: PlannedContour, machine: MachineSetup) -> UserError:
    """Report where a contour's wire is not where the drawing has it: first where it comes into the contour."""
    fault = min(faults, key=lambda fault: not fault.is_into)
    if why := why_no_room(fault):
        message = (
            f"{why}, {short(abs(route.widest))} mm beside it: there is no room for this offset, "
            f"take a smaller one or a thinner wire{_or_leave(machine)}"
        )
    else:
        place, off = shown(fault.place), f"{short(1000 * fault.off)} µm off the drawing"
        where = (
            f"{off} at {place}, more than {1000 * LIMIT:g}" if fault.off < inf else f"far off the drawing at {place}"
        )
        message = f"the wire would be {where}: nothing was written; {_advice(fault, route, machine)}"
    return UserError(f"{route.name}: {message}", route.number, fault.place)


def refuse(checked: Checked, routes: list[PlannedContour], machine: MachineSetup) -> None:
    """Raise what is wrong with a tape, if anything is, as a `UserError`."""
    if checked.faults:
        first = min(checked.faults, key=lambda fault: (not fault.is_into, fault.route)).route
        faults = [fault for fault in checked.faults if fault.route == first]
        raise off_drawing(faults, routes[first], machine)
    for cut in checked.cuts:
        route = routes[cut.route]
        if route.contour.is_closed and not route.tab and cut.gap != (0, 0):
            raise UserError(
                f"{route.name}: does not close, open by {cut.gap[0]}, {cut.gap[1]} µm on the "
                "controller: draw its longest arc as two",
                route.number,
                route.entry,
            )
    spoilt = [
        crossing
        for crossing in checked.crossings
        if all(routes[number].contour.is_closed for number in (crossing.route, crossing.other))
    ]
    if spoilt and machine.into != "cut":
        raise _spoilt(spoilt, routes, machine)


def _spoilt(spoilt: list[Crossing], routes: list[PlannedContour], machine: MachineSetup) -> UserError:
    """Report gouges: the deepest one."""
    worst = max(spoilt, key=lambda crossing: (crossing.is_through, crossing.depth))
    message = (
        f"{routes[worst.route].name}: its wire would gouge {into(worst)} "
        f"{routes[worst.other].name} at {shown(worst.place)}"
    )
    if len(spoilt) > 1:
        message += f"; {counted(len(spoilt) - 1, 'more cut')} into other contours"
    message += (
        ": these cross, or lie nearer to each other than the wire is wide; move them apart, take a thinner "
        f"wire or some of the layers{', or cut them all the same with --into cut' * bool(machine.into)}"
    )
    return UserError(message, routes[worst.route].number, worst.place)


def into(crossing: Crossing) -> str:
    """Return a gouge's depth in words."""
    return f"{short(crossing.depth)} mm{' or more' * crossing.is_through} into"


def _advice(fault: Misfit, route: PlannedContour, machine: MachineSetup) -> str:
    """Return remedies for a wire that is off the drawing."""
    if not machine.is_without_drift:
        return "--rom no-drift is nearer"
    edge = min(route.contour.edges, key=lambda edge: edge.far(fault.place))
    ends = " to ".join(shown(end) for end in (edge.start, edge.end))
    noun = "curve" if edge.nodes else "arc" if edge.centre else "line"
    others = "another --offset, --start or --side may do, or " if any(route.passes) else ""
    return f"{others}redraw the {noun} from {ends}, {short(edge.length)} long, or its neighbour"
