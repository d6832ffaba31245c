"""From planned contours to a tape that was checked: program, board, controller; what is tried when one is refused."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import tee
from math import inf

from skg.checking.check import Checked, check
from skg.checking.wire_path import Misfit
from skg.cutting import refusal
from skg.cutting.program import Program, Step, writes_fillets
from skg.cutting.settings import Settings
from skg.errors import UserError
from skg.geometry.offset import NoRoom, has_spike
from skg.machine.board import ErrorLine
from skg.machine.feeding import MEMORY_FULL, Fed, feed, feed_lines, feed_routes
from skg.planning.entries import longest_tab
from skg.planning.islands import islands
from skg.planning.route import PlannedContour
from skg.tape import text as tapes
from skg.tape.block import Tape

#: No contour takes fewer bytes of the board's memory: the lines of its REM, FROM and CUT.
_LEAST_STORED = 24
#: Past a tip from which the wire would run on by more R than this it is not tried.
_WILD = 1000.0


@dataclass(frozen=True)
class Left:
    """A contour that is not cut, since the wire has no room: its number among those planned, what it is, and why.

    `is_within`: it lies in an opening that is not cut.
    """

    number: int
    name: str
    why: str
    is_within: bool = False


@dataclass(frozen=True)
class CutResult:
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
        """Length that the wire cuts, mm."""
        return sum(cut.length for cut in self.checked.cuts)

    @property
    def seconds(self) -> float:
        """Time of cutting, s."""
        return self.cut_length / self.settings.feed * 60


def make(
    routes: list[PlannedContour],
    title: str,
    factor: float,
    settings: Settings,
    left: tuple[Left, ...] = (),
) -> CutResult:
    """Write the program that cuts the routes, let the board run it, check the tape.

    Where a contour has edges that the wire cannot follow, the program has the wire's own way along it. `factor`: mm in
    a unit of the file, for the places that a `UserError` names. `left`: what is left out already. Nothing is returned
    that is wrong: a contour that cannot be cut, or that is not cut as it is drawn, is a `UserError`.
    """
    if short_ones := {at: longest_tab(route.contour) for at, route in enumerate(routes) if route.is_short}:
        if settings.small != "leave":
            raise UserError(refusal.without_tab(routes, short_ones, factor, settings))
        routes, more = _without(routes, {at: refusal.too_short(fit) for at, fit in short_ones.items()}, factor)
        left += more
    if not routes:
        raise UserError(f"no contour is left to cut: {left[0].name}: {left[0].why}")
    if wild := _wild(routes):
        # (a wire that runs off for metres would be followed and compared first)
        try:
            helped, more = _helped(routes, wild, factor, settings)
        except UserError:
            # (all that have no way are said at once)
            helped, more = _helped(routes, set(range(len(routes))), factor, settings)
        return make(helped, title, factor, settings, left + more)
    program = Program(routes, title)
    text, is_stored, fed = _through(program, settings)
    if fed.error:
        refused = _refused(program, settings) or set(range(len(routes)))
        if (simpler := _simpler(routes, refused)) != routes:
            return make(simpler, title, factor, settings, left)
        helped, more = _helped(routes, refused, factor, settings)
        if helped == routes:
            raise UserError(_located(program, fed.error, factor, settings))
        return make(helped, title, factor, settings, left + more)
    tape = tapes.parse(fed.tape, title)
    checked = check(tape, routes, settings.is_without_drift)
    if checked.faults:
        faulty = {fault.route for fault in checked.faults}
        if (one_by_one := _one_by_one(routes, faulty)) != routes:
            return make(one_by_one, title, factor, settings, left)
        helped, more = _helped(routes, faulty, factor, settings)
        if helped == routes and settings.small == "leave":
            no_room = {fault.route: why for fault in checked.faults if (why := refusal.why_no_room(fault, factor))}
            helped, more = _without(routes, no_room, factor)
        if helped == routes:
            helped = _in_chords(routes, checked.faults)
        if helped != routes:
            return make(helped, title, factor, settings, left + more)
    if not checked.faults and (around := _around_spikes(routes)) != routes:
        with suppress(UserError):
            job = make(around, title, factor, settings, left)
            if job.left == left:
                return job
    refusal.refuse(checked, routes, factor, settings)
    return CutResult(routes, text, is_stored, fed.cycles, fed.tape, tape, checked, settings, left)


def _simpler(routes: list[PlannedContour], which: set[int]) -> list[PlannedContour]:
    """The routes, some written in a simpler way: a tooth may be too much for the board's memory of a route, which REP
    needs; a rounded corner without room to round it may still go as an arc."""
    if (one_by_one := _one_by_one(routes, which)) != routes:
        return one_by_one
    return [
        replace(route, has_fillets=False) if at in which and writes_fillets(route) else route
        for at, route in enumerate(routes)
    ]


def _one_by_one(routes: list[PlannedContour], which: set[int]) -> list[PlannedContour]:
    """The routes, some with every copy of a tooth written out."""
    return [
        route.one_by_one() if at in which and route.contour.copies > 1 else route for at, route in enumerate(routes)
    ]


def _around_spikes(routes: list[PlannedContour]) -> list[PlannedContour]:
    """The routes; those whose wire would run far past a tip go around it, with the wire's own way."""
    found = list(routes)
    for at, route in enumerate(routes):
        with suppress(NoRoom):
            if _may_be_traced(route) and has_spike(route.contour, route.offset):
                found[at] = replace(route.with_wire_ways(), is_around=True)
    return found


def _wild(routes: list[PlannedContour]) -> set[int]:
    """The routes whose wire would run off for a thousand R and more, where it has a way of its own, or none at all."""
    found: set[int] = set()
    for at, route in enumerate(routes):
        if _may_be_traced(route) and has_spike(route.contour, route.offset, _WILD):
            try:
                route.with_wire_ways()
            except NoRoom as no_room:
                if not no_room.is_crossing:
                    continue
            found.add(at)
    return found


def _may_be_traced(route: PlannedContour) -> bool:
    return route.contour.is_closed and route.contour.copies == 1 and all(route.passes) and not route.traced


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
        raise UserError(refusal.without_room(routes, none, factor, settings))
    return _without(
        found, {at: f"{no_room} {refusal.told_in_file(no_room.place, factor)}" for at, no_room in none.items()}, factor
    )


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
    """The routes without some, and without what lies in those that are openings; these with the reason."""
    left = [Left(routes[at].number, refusal.called(routes[at], factor), reason) for at, reason in why.items()]
    within = islands(routes, why)
    for at, opening in within.items():
        reason = f"it lies in the {refusal.called(routes[opening], factor)}, which is left out"
        left.append(Left(routes[at].number, refusal.called(routes[at], factor), reason, is_within=True))
    return [route for at, route in enumerate(routes) if at not in why and at not in within], tuple(left)


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
    message = refusal.meaning((fed.error or error).number)
    if fed.error is None:
        return message
    _, done = feed_lines([_text([one]) for one in routes[at]], settings.rom, settings.ram_kib)
    route = program.routes[at]
    places = [one.place for one in routes[at][: done + 1] if one.place] or [route.entry]
    return f"{refusal.named(route, at, factor)}, near {refusal.told_in_file(places[-1], factor)}: {message}"
