"""From planned contours to a tape that was checked: program, board, controller; why one is refused."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import tee
from math import copysign, floor, inf

from skg.cutting.check import LIMIT, Checked, Misfit, check
from skg.cutting.crossing import Crossing
from skg.drawing.account import counted, short, shown
from skg.drawing.contour import Contour
from skg.drawing.entry import longest_tab
from skg.drawing.parallel import NoRoom, widest, wire_way
from skg.drawing.planned import PlannedContour
from skg.drawing.write import Program, Step
from skg.errors import UserError
from skg.machine.board import ErrorLine
from skg.machine.feeding import MEMORY_FULL, Fed, feed, feed_lines, feed_routes
from skg.plane import XY
from skg.tape import text as tapes
from skg.tape.block import Tape

#: No contour takes fewer bytes of the board's memory: the lines of its REM, FROM and CUT.
_LEAST_STORED = 24
#: What the errors of a route mean (language.md, section 6), and what to do.
_MEANING = {
    5: ("a number is out of range", "is a radius or a place in the drawing absurdly small or large?"),
    6: (
        "the contour cannot be cut as it is drawn",
        "with an offset a short edge or corner has vanished: try a smaller --offset, another --side or --start; "
        "without one look for edges that nearly touch there",
    ),
    7: ("the offset is larger than the radius of an inner arc", "a thinner wire or a smaller --offset"),
    9: ("the board's memory is full", "a larger --ram"),
    10: ("a move is too long for a tape", "is the drawing in the right --units? a tape ends at 100 m"),
}
#: Of a contour with more edges than this the largest offset that fits is not looked for.
_MANY = 2000


@dataclass(frozen=True)
class Settings:
    """The board: its ROM ("no-drift", "standard") and RAM (KiB); the feed, mm/min; `small`: whether to "refuse" or to
    "leave" contours that the wire has no room beside; `into`: whether to "refuse" or to "cut" those whose wire comes
    into another closed contour. Both are empty where nobody is asked."""

    rom: str = "no-drift"
    ram_kib: int = 8
    feed: float = 5.0
    small: str = ""
    into: str = ""

    @property
    def is_without_drift(self) -> bool:
        """Whether blocks start where the controller stands."""
        return self.rom == "no-drift"


@dataclass(frozen=True)
class Left:
    """A contour that is not cut, since the wire has no room: its number among those planned, what it is, and why."""

    number: int
    name: str
    why: str


@dataclass(frozen=True)
class Job:
    """A tape that was checked, the program that made it, how it went into the board; `left`: what it does not cut."""

    routes: list[PlannedContour]
    program: str
    is_stored: bool
    cycles: int
    data: bytes
    tape: Tape
    checked: Checked
    settings: Settings
    left: tuple[Left, ...] = ()

    @property
    def cut_length(self) -> float:
        """What the wire travels while it cuts, mm."""
        return sum(cut.length for cut in self.checked.cuts)

    @property
    def seconds(self) -> float:
        """How long it cuts, s."""
        return self.cut_length / self.settings.feed * 60


def make(
    routes: list[PlannedContour],
    title: str,
    factor: float,
    settings: Settings,
    fillets: bool = True,
    left: tuple[Left, ...] = (),
) -> Job:
    """Write the program that cuts the routes, let the board run it, check the tape.

    Where a contour has edges that the wire cannot follow, the program has the wire's own way along it. `factor`: mm in
    a unit of the file, for the places that a `UserError` names. `left`: what is left out already. Nothing is returned
    that is wrong: a contour that cannot be cut, or that is not cut as it is drawn, is a `UserError`.
    """
    if short_ones := {at: longest_tab(route.contour) for at, route in enumerate(routes) if route.is_short}:
        if settings.small != "leave":
            raise UserError(_no_tab(routes, short_ones, factor, settings))
        routes, more = _without(routes, {at: _too_short(fit) for at, fit in short_ones.items()}, factor)
        left += more
    if not routes:
        raise UserError(f"no contour is left to cut: {left[0].name}: {left[0].why}")
    program = Program(routes, title, fillets)
    text, is_stored, fed = _through(program, settings)
    if fed.error and (one_by_one := _one_by_one(routes)):
        # A tooth may be too much for the board's memory of a route, which REP needs.
        return make(one_by_one, title, factor, settings, fillets, left)
    if fed.error and fillets:
        # A rounded corner without room to round it may still go as an arc.
        return make(routes, title, factor, settings, False, left)
    if fed.error:
        helped, more = _helped(routes, _refused(program, settings), factor, settings)
        if helped == routes:
            raise UserError(_located(program, fed.error, factor, settings))
        return make(helped, title, factor, settings, False, left + more)
    tape = tapes.parse(fed.tape, title)
    checked = check(tape, routes, settings.is_without_drift)
    if checked.faults and (one_by_one := _one_by_one(routes)):
        return make(one_by_one, title, factor, settings, fillets, left)
    if checked.faults:
        helped, more = _helped(routes, {fault.route for fault in checked.faults}, factor, settings)
        if helped == routes and settings.small == "leave":
            no_room = {fault.route: why for fault in checked.faults if (why := _why(fault, factor))}
            helped, more = _without(routes, no_room, factor)
        if helped == routes:
            helped = _in_chords(routes, checked.faults)
        if helped != routes:
            return make(helped, title, factor, settings, fillets, left + more)
    _refuse(checked, routes, factor, settings)
    return Job(routes, text, is_stored, fed.cycles, fed.tape, tape, checked, settings, left)


def _no_tab(routes: list[PlannedContour], fits: dict[int, float], factor: float, settings: Settings) -> str:
    """What to say of outlines that have no room for their tab: of the shortest one."""
    at = min(fits, key=lambda one: fits[one])
    message = f"{_named(routes[at], at, factor)}: {_too_short(fits[at])}"
    if len(fits) > 1:
        message += f"; {counted(len(fits) - 1, 'more contour')} without room for the tab"
    return f"{message}: take a shorter --tab{_or_leave(settings)}"


def _too_short(fit: float) -> str:
    return f"it is too short for the tab, at most {short(floor(fit * 1000 - 1e-6) / 1000)} mm fits"


def _one_by_one(routes: list[PlannedContour]) -> list[PlannedContour]:
    """The routes with every copy of a tooth written out; none where there are no copies."""
    if all(route.contour.copies == 1 for route in routes):
        return []
    return [route.one_by_one() for route in routes]


def _refused(program: Program, settings: Settings) -> set[int]:
    """The routes that the ROM refuses; behind one of these a new board goes on."""
    _, *routes, _ = program.unnumbered()
    refused: set[int] = set()
    at = 0
    while at < len(routes):
        fed, done = feed_lines(map(_text, routes[at:]), settings.rom, settings.ram_kib)
        at += done
        if fed.error:
            refused.add(at)
        at += 1
    return refused


def _helped(
    routes: list[PlannedContour], which: set[int], factor: float, settings: Settings
) -> tuple[list[PlannedContour], tuple[Left, ...]]:
    """The routes, some with a straight lead or with the wire's own way, and those that are left out; the same routes
    where none of these can be helped.

    A contour that the wire does not get around is a `UserError`, or it is left out.
    """
    found = list(routes)
    none: dict[int, NoRoom] = {}
    for at in sorted(which):
        route = routes[at]
        if route.is_arc and route.contour.is_closed:
            # (an arc that comes to the contour takes more room than a line)
            found[at] = replace(route, is_arc=False, is_cramped=True)
        elif route.contour.is_closed and all(route.passes) and not route.traced:
            try:
                found[at] = route.with_wire_ways()
            except NoRoom as no_room:
                none[at] = no_room
    if none and settings.small != "leave":
        raise UserError(_no_room(routes, none, factor, settings))
    return _without(found, {at: f"{no_room} {in_file(no_room.place, factor)}" for at, no_room in none.items()}, factor)


def _in_chords(routes: list[PlannedContour], faults: list[Misfit]) -> list[PlannedContour]:
    """The routes; those without an offset that the controller is a little off are cut along chords of their arcs and
    curves. The same routes where there are none of these."""
    off = {fault.route for fault in faults if fault.off < inf and not fault.is_into and not fault.is_missed}
    return [
        route.in_chords() if at in off and not any(route.passes) and not route.traced and _is_bent(route) else route
        for at, route in enumerate(routes)
    ]


def _is_bent(route: PlannedContour) -> bool:
    return any(not edge.is_line for edge in route.contour.edges)


def _without(
    routes: list[PlannedContour], why: dict[int, str], factor: float
) -> tuple[list[PlannedContour], tuple[Left, ...]]:
    """The routes without some, and these with the reason."""
    left = tuple(Left(routes[at].number, _called(routes[at], factor), reason) for at, reason in why.items())
    return [route for at, route in enumerate(routes) if at not in why], left


def _no_room(routes: list[PlannedContour], none: dict[int, NoRoom], factor: float, settings: Settings) -> str:
    """What to say of contours that the wire does not get around: of the tightest one."""
    at, fit = _tightest(routes, none)
    route = routes[at]
    message = f"{_named(route, at, factor)}: {none[at]} {in_file(none[at].place, factor)}"
    if none[at].is_crossing:
        message += ", there is no way beside it for the wire"
        help_ = "mend it in the drawing"
    else:
        message += f", {short(abs(route.widest))} mm beside it"
        if fit is not None:
            message += f"; at most {short(fit)} mm fits" if fit else "; no offset fits"
            message += _in_passes(route, fit) if fit else ""
        help_ = "take a smaller offset or a thinner wire"
    if len(none) > 1:
        message += f"; {counted(len(none) - 1, 'more contour')} without room for the wire"
    return f"{message}: {help_}{_or_leave(settings)}"


def _in_passes(route: PlannedContour, fit: float) -> str:
    """What the largest offset that fits is in the last pass, where another one has it."""
    more = abs(route.widest) - abs(route.passes[-1])
    if not more:
        return ""
    return (
        f" in the widest pass, {short(fit - more)} in the last" if fit > more else ", less than these passes take off"
    )


def _tightest(routes: list[PlannedContour], none: dict[int, NoRoom]) -> tuple[int, float | None]:
    """The contour with the least room of some that the wire does not get around, and how far the wire may be beside
    it, mm; None when that is not looked for."""
    found: tuple[int, float] | None = None
    for at, no_room in none.items():
        if found and not found[1]:
            break
        if no_room.is_crossing:
            return at, 0.0
        contour, r = routes[at].contour, routes[at].widest
        if len(contour.edges) <= _MANY and (found is None or not _fits(contour, copysign(found[1], r))):
            found = at, widest(contour, r)
    return found or (next(iter(none)), None)


def _fits(contour: Contour, r: float) -> bool:
    """Whether the wire gets around a closed contour, R (mm) to the right of it."""
    with suppress(NoRoom):
        return bool(wire_way(contour, r))
    return False


def _or_leave(settings: Settings) -> str:
    return ", or leave such contours out with --small leave" if settings.small else ""


def _through(program: Program, settings: Settings) -> tuple[str, bool, Fed]:
    """The program's text, whether it is stored, and what the board made of it: with line numbers where it fits."""
    text = ""
    if _LEAST_STORED * len(program.routes) <= 1024 * settings.ram_kib:
        with suppress(UserError):
            text = program.numbered()
    if text:
        fed = feed(text, settings.rom, settings.ram_kib)
        if fed.error is None or fed.error.number != MEMORY_FULL:
            return text, True, fed
    parts, written = tee(map(_text, program.unnumbered()))
    fed = feed_routes(parts, settings.rom, settings.ram_kib)
    return "".join(written), False, fed


def _text(statements: list[Step]) -> str:
    return "".join(f"{statement.text}\n" for statement in statements)


def _located(program: Program, error: ErrorLine, factor: float, settings: Settings) -> str:
    """An error of the ROM as a contour and its place: route by route, then statement by statement."""
    _, *routes, _ = program.unnumbered()
    fed, at = feed_lines(map(_text, routes), settings.rom, settings.ram_kib)
    found = fed.error or error
    what, then = _MEANING.get(found.number, ("the board refuses it", "see language.md, section 6"))
    message = f"ERR {found.number:02d}, {what}: {then}"
    if fed.error is None:
        return message
    _, done = feed_lines([_text([one]) for one in routes[at]], settings.rom, settings.ram_kib)
    route = program.routes[at]
    places = [one.place for one in routes[at][: done + 1] if one.place] or [route.entry]
    return f"{_named(route, at, factor)}, near {in_file(places[-1], factor)}: {message}"


def in_file(place: XY, factor: float) -> str:
    """A place as the drawing's file has it; `factor`: mm in a unit of the file."""
    return shown((place[0] / factor, place[1] / factor))


def kind(route: PlannedContour) -> str:
    """What a contour is."""
    if not route.contour.is_closed:
        return "open contour"
    return "opening" if route.is_opening else "outline"


def _called(route: PlannedContour, factor: float) -> str:
    layers = f", layer {', '.join(route.contour.layers)}" if route.contour.layers else ""
    return f"{kind(route)} from {in_file(route.contour.edges[0].start, factor)}{layers}"


def _named(route: PlannedContour, number: int, factor: float) -> str:
    return f"contour {number + 1} ({_called(route, factor)})"


def _why(fault: Misfit, factor: float) -> str:
    """Why there is no room for the wire; empty when it is something else that is wrong."""
    place = in_file(fault.place, factor)
    if fault.is_into:
        return f"the wire would cut {short(fault.off)} mm into it at {place}"
    return f"the wire does not come to {place}" if fault.is_missed else ""


def _refuse(checked: Checked, routes: list[PlannedContour], factor: float, settings: Settings) -> None:
    """Raise what is wrong with a tape."""
    for fault in sorted(checked.faults, key=lambda fault: (not fault.is_into, fault.route)):
        route = routes[fault.route]
        named = _named(route, fault.route, factor)
        if why := _why(fault, factor):
            raise UserError(
                f"{named}: {why}, {short(abs(route.widest))} mm beside it: there is no room for this offset, "
                f"take a smaller one or a thinner wire{_or_leave(settings)}"
            )
        place, off = in_file(fault.place, factor), f"{short(1000 * fault.off)} µm off the drawing"
        where = (
            f"{off} at {place}, more than {1000 * LIMIT:g}" if fault.off < inf else f"far off the drawing at {place}"
        )
        raise UserError(
            f"{named}: the wire would be {where}: nothing was written; {_advice(fault, route, factor, settings)}"
        )
    for cut in checked.cuts:
        route = routes[cut.route]
        if route.contour.is_closed and not route.tab and cut.gap != (0, 0):
            raise UserError(
                f"{_named(route, cut.route, factor)}: does not close, open by {cut.gap[0]}, {cut.gap[1]} µm on the "
                "controller"
            )
    spoilt = [one for one in checked.crossings if all(routes[at].contour.is_closed for at in (one.route, one.other))]
    if spoilt and settings.into != "cut":
        raise UserError(_spoilt(spoilt, routes, factor, settings))


def _spoilt(spoilt: list[Crossing], routes: list[PlannedContour], factor: float, settings: Settings) -> str:
    """What to say of contours whose wire comes into others: of the one that comes deepest."""
    worst = max(spoilt, key=lambda one: (one.is_through, one.depth))
    message = (
        f"{_named(routes[worst.route], worst.route, factor)}: its wire would come {into(worst)} "
        f"{_named(routes[worst.other], worst.other, factor)} at {in_file(worst.place, factor)}"
    )
    if len(spoilt) > 1:
        message += f"; {counted(len(spoilt) - 1, 'more cut')} into other contours"
    return (
        f"{message}: these cross, or lie nearer to each other than the wire is wide; move them apart, take a thinner "
        f"wire or some of the layers{', or cut them all the same with --into cut' * bool(settings.into)}"
    )


def into(crossing: Crossing) -> str:
    """How deep a wire comes into another contour."""
    return f"{short(crossing.depth)} mm{' or more' * crossing.is_through} into"


def _advice(fault: Misfit, route: PlannedContour, factor: float, settings: Settings) -> str:
    """What a person can do about a wire that is off the drawing."""
    if not settings.is_without_drift:
        return "--rom no-drift is nearer"
    edge = min(route.contour.edges, key=lambda edge: edge.far(fault.place))
    ends = " to ".join(in_file(end, factor) for end in (edge.start, edge.end))
    what = "curve" if edge.nodes else "arc" if edge.centre else "line"
    others = "another --offset, --start or --side may do, or " if any(route.passes) else ""
    return f"{others}draw the {what} from {ends} anew, {short(edge.length / factor)} long, or what meets it"
