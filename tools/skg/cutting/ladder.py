"""From planned contours to a tape that was checked: program, board, controller; remedies, contour by contour."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import tee
from math import inf

from skg.board.board import ErrorLine
from skg.board.feeding import MEMORY_FULL, Fed, feed, feed_lines, feed_routes, refused_routes
from skg.checking.check import Checked, check
from skg.checking.wire_path import Misfit
from skg.cutting import refusal
from skg.cutting.program import Program, Step, writes_fillets
from skg.cutting.progress import Progress, in_silence
from skg.errors import UserError
from skg.geometry.offset import NoRoom
from skg.job.job import Job
from skg.job.machine import BoardOptions, Setup
from skg.messages.finding import Finding, Phrase
from skg.planning.copies import Pattern
from skg.planning.islands import islands
from skg.planning.planned import LeadShape, PlannedContour, Reason
from skg.tape import text as tapes
from skg.tape.block import Tape

#: No contour takes fewer bytes of the board's memory: the lines of its REM, FROM and CUT.
_LEAST_STORED = 24
#: Past a tip from which the wire would run on by more R than this it is not tried.
_WILD = 1000.0


@dataclass(frozen=True)
class Skipped:
    """A contour that is not cut, since the wire has no room: its number among those planned, what it is, and why.

    `is_within`: it lies in an opening that is not cut.
    """

    number: int
    name: Phrase
    why: Phrase
    is_within: bool = False


@dataclass(frozen=True)
class CutResult:
    """A tape that was checked, the program that made it, how it went into the board; `skipped`: contours that it does
    not cut."""

    contours: list[PlannedContour]
    program: str
    is_stored: bool
    data: bytes
    tape: Tape
    checked: Checked
    setup: Setup
    board: BoardOptions
    skipped: tuple[Skipped, ...] = ()

    @property
    def cut_length(self) -> float:
        """Length that the wire cuts, mm."""
        return sum(cut.length for cut in self.checked.cuts)

    @property
    def seconds(self) -> float:
        """Time of cutting, s."""
        return sum(length / self.setup.pace(turn) for turn, length in enumerate(self.checked.lengths)) * 60


#: Why a contour does not go through: an error of the ROM, or what the check finds wrong.
_Trouble = ErrorLine | list[Misfit]


def make(
    contours: list[PlannedContour], job: Job, progress: Progress = in_silence, pattern: Pattern | None = None
) -> CutResult:
    """Write the program that cuts the contours of a job, let the board run it, check the tape.

    Each contour is written as it is drawn, unless the ROM or the check refuses that; then the remedies of `_RUNGS`
    follow, for this contour alone. Nothing is returned that is wrong: a contour that cannot be cut, or that is not cut
    as it is drawn, is a `UserError`. `pattern`: copies of all contours, which are cut instead.
    """
    first = _made(_Ladder(contours, job, progress))
    if not pattern:
        return first
    # (what is wrong with the part is told of once)
    result = _made(_Ladder(pattern.all_of(first.contours), job, progress, pattern))
    return replace(result, skipped=first.skipped + result.skipped)


def _made(ladder: _Ladder) -> CutResult:
    """The tape of contours that have climbed as far as they must."""
    ladder.leave_short()
    ladder.tame()
    result = ladder.around_tips(ladder.through())
    refusal.refuse(result.checked, result.contours, ladder.job)
    return replace(result, skipped=tuple(ladder.skipped))


def run(program: Program, job: Job) -> CutResult:
    """Let the board run a program, check the tape; one that is refused, or wrong, is a `UserError`."""
    result = _tried(program, job, in_silence)
    if isinstance(result, ErrorLine):
        raise UserError(refusal.meaning(result.number))
    refusal.refuse(result.checked, result.contours, job)
    return result


def _arcs_for_fillets(planned: PlannedContour, trouble: _Trouble) -> PlannedContour | None:
    """A rounded corner without room to round it may still go as an arc."""
    if isinstance(trouble, ErrorLine) and writes_fillets(planned):
        return planned.on_rung(has_fillets=False)
    return None


def _straight_lead(planned: PlannedContour, _trouble: _Trouble) -> PlannedContour | None:
    """An arc that comes to the contour takes more room than a line."""
    if planned.is_arc and planned.contour.is_closed:
        return planned.on_rung(lead=LeadShape.CRAMPED)
    return None


def _own_path(planned: PlannedContour, _trouble: _Trouble) -> PlannedContour | None:
    """The wire's own path, without R; `NoRoom` where there is none."""
    return planned.along_wire() if _may_be_traced(planned) else None


def _in_chords(planned: PlannedContour, trouble: _Trouble) -> PlannedContour | None:
    """Chords of arcs and curves that the controller is a little off, without an offset."""
    is_off = not isinstance(trouble, ErrorLine) and any(
        fault.off < inf and not fault.is_into and not fault.is_missed for fault in trouble
    )
    is_bent = any(not edge.is_line for edge in planned.contour.edges)
    return planned.in_chords() if is_off and is_bent and not any(planned.passes) and not planned.rung.wire else None


#: The remedies, in the order in which they are tried: each returns the contour on another rung, or None where it does
#: not help, or has been tried.
_RUNGS = (_arcs_for_fillets, _straight_lead, _own_path, _in_chords)


class _Ladder:
    """The contours, each on a rung of its own. `contours`: by their numbers in the order of cutting; `skipped`: those
    that are not cut; `pattern`: the copies that they are."""

    def __init__(
        self, contours: list[PlannedContour], job: Job, progress: Progress, pattern: Pattern | None = None
    ) -> None:
        self.contours = dict(enumerate(contours))
        self.skipped: list[Skipped] = []
        self.job, self.progress, self.pattern = job, progress, pattern

    def leave_short(self) -> None:
        """Leave contours that are too short for their tab; a `UserError` where they are refused."""
        longest = {number: planned.remarks.longest_tab for number, planned in self.contours.items()}
        fits = {number: length for number, length in longest.items() if length is not None}
        if fits and self.job.policy.small != "leave":
            raise refusal.without_tab(self.contours, fits, self.job.policy)
        self._leave({number: refusal.too_short(fit) for number, fit in fits.items()})

    def tame(self) -> None:
        """Give those their own path whose wire would run off for a thousand R and more: it would be followed and
        compared first."""
        no_room: dict[int, NoRoom] = {}
        for number, planned in self.contours.items():
            if not (_may_be_traced(planned) and planned.has_spike(_WILD)):
                continue
            why = _no_room(planned)
            if why is None:
                self.contours[number] = (_straight_lead(planned, []) or planned).along_wire()
            elif why.is_crossing:
                no_room[number] = why
        self._leave_without_room(no_room, self.contours)

    def through(self) -> CutResult:
        """Try all contours, and those by themselves that did not go through, until all do."""
        numbers = list(self.contours)
        while True:
            tried = self._try({number: self.contours[number] for number in numbers})
            again: list[int] = []
            if not isinstance(tried, CutResult):
                self._climb(tried)
                again = [number for number in self.contours if number in tried]
            elif len(numbers) == len(self.contours):
                return tried
            numbers = again if 0 < 2 * len(again) < len(self.contours) else list(self.contours)

    def around_tips(self, result: CutResult) -> CutResult:
        """The tape of which the wire goes around the tips that it would run far past, with its own path, where that is
        right; else the one that there is."""
        around: dict[int, PlannedContour] = {}
        for number, planned in self.contours.items():
            with suppress(NoRoom):
                if _may_be_traced(planned) and planned.has_spike():
                    around[number] = planned.along_wire(Reason.TIPS)
        while around:
            tried = self._try(self.contours | around)
            if isinstance(tried, CutResult):
                with suppress(UserError):
                    refusal.refuse(tried.checked, tried.contours, self.job)
                    return tried
                break
            around = {number: planned for number, planned in around.items() if number not in tried}
        return result

    def _try(self, contours: dict[int, PlannedContour]) -> CutResult | Mapping[int, _Trouble]:
        """Cut some contours: what comes of it, or which do not go through."""
        numbers, program = list(contours), Program(list(contours.values()), self.job.drawing, pattern=self.pattern)
        result = _tried(program, self.job, self.progress)
        if isinstance(result, ErrorLine):
            refused = _refused(program, self.job.board) or dict.fromkeys(range(len(numbers)), result)
            return {numbers[index]: error for index, error in refused.items()}
        misfits: dict[int, list[Misfit]] = defaultdict(list)
        for fault in result.checked.faults:
            misfits[numbers[fault.contour]].append(fault)
        return misfits or result

    def _climb(self, troubles: Mapping[int, _Trouble]) -> None:
        """Put each contour on the next rung that helps; one that has none is left or a `UserError`."""
        no_room: dict[int, NoRoom] = {}
        stuck: dict[int, Phrase] = {}
        lost: list[int] = []
        for number in sorted(troubles):
            planned, trouble = self.contours[number], troubles[number]
            try:
                helped = next(filter(None, (rung(planned, trouble) for rung in _RUNGS)), None)
            except NoRoom as why:
                no_room[number] = why
                continue
            if helped:
                self.contours[number] = helped
            elif reason := self._reason(trouble):
                stuck[number] = reason
            else:
                lost.append(number)
        self._leave_without_room(no_room, troubles)
        if lost:
            number = min(lost, key=lambda number: not _is_into(troubles[number]))
            raise self._lost(number, troubles[number])
        self._leave(stuck)

    def _reason(self, trouble: _Trouble) -> Phrase | None:
        """The reason why a contour that nothing helps is left; None where it may not be."""
        if self.job.policy.small != "leave" or isinstance(trouble, ErrorLine):
            return None
        return next(filter(None, (refusal.why_no_room(fault) for fault in trouble)), None)

    def _lost(self, number: int, trouble: _Trouble) -> UserError:
        """Report a contour that nothing helps."""
        planned = self.contours[number]
        if not isinstance(trouble, ErrorLine):
            return refusal.off_drawing(trouble, planned, self.job)
        _, steps, _ = Program([planned], "").unnumbered()
        fed, done = feed_lines([_text([step]) for step in steps], self.job.board.rom, self.job.board.ram)
        if not fed.error:
            return UserError(refusal.meaning(trouble.number).about(planned.number))
        place = [planned.entry, *(step.place for step in steps[: done + 1] if step.place)][-1]
        error = refusal.meaning(fed.error.number)
        return UserError(Finding("refused-near", name=planned.name, error=error, contour=planned.number, place=place))

    def _leave_without_room(self, no_room: dict[int, NoRoom], among: Iterable[int]) -> None:
        """Leave contours that the wire does not get around; where they are refused, a `UserError` on all that there are
        among some."""
        if no_room and self.job.policy.small != "leave":
            no_room = {number: why for number in among if (why := _no_room(self.contours[number]))}
            raise refusal.without_room(self.contours, no_room, self.job.policy)
        self._leave({number: no_room[number].why for number in no_room})

    def _leave(self, reasons: dict[int, Phrase]) -> None:
        """Leave contours, and what lies in those that are openings."""
        names = {number: self.contours[number].name for number in reasons}
        within = islands(self.contours, reasons)
        for number, reason in reasons.items():
            self.skipped.append(Skipped(self.contours.pop(number).number, names[number], reason))
        for number, opening in within.items():
            planned = self.contours.pop(number)
            reason = Phrase("lies-in-not-cut", name=names[opening])
            self.skipped.append(Skipped(planned.number, planned.name, reason, is_within=True))
        if not self.contours:
            raise UserError(Finding("nothing-left", name=self.skipped[0].name, why=self.skipped[0].why))


def _may_be_traced(planned: PlannedContour) -> bool:
    return planned.contour.is_closed and all(planned.passes) and not planned.rung.wire


def _is_into(trouble: _Trouble) -> bool:
    """Tell whether the wire would come into its own contour."""
    return not isinstance(trouble, ErrorLine) and any(fault.is_into for fault in trouble)


def _no_room(planned: PlannedContour) -> NoRoom | None:
    """Return why the wire has no path of its own around a contour; None where it has one."""
    try:
        _own_path(planned, [])
    except NoRoom as why:
        return why
    return None


def _tried(program: Program, job: Job, progress: Progress) -> CutResult | ErrorLine:
    """Let the board run a program, and check the tape; the error where the ROM refuses it."""
    count = len(program.contours)
    progress("board", 0, count)
    text, is_stored, fed = _through(program, job.board, lambda done: progress("board", done, count))
    if fed.error:
        return fed.error
    progress("check", 0, count)
    tape = tapes.parse(fed.tape, program.title)
    checked = check(tape, program.contours, job.board.is_without_drift)
    return CutResult(program.contours, text, is_stored, fed.tape, tape, checked, job.setup, job.board)


def _refused(program: Program, board: BoardOptions) -> dict[int, ErrorLine]:
    """The contours, by their numbers, whose routes the ROM refuses."""
    _, *routes, _ = map(_text, program.unnumbered())
    return refused_routes(routes, board.rom, board.ram)


def _through(program: Program, board: BoardOptions, on_done: Callable[[int], None]) -> tuple[str, bool, Fed]:
    """The program's text, whether it is stored, and what the board made of it: with line numbers where it fits."""
    text = ""
    copies = program.pattern.copies.count if program.pattern else 1
    if _LEAST_STORED * len(program.contours) <= 1024 * board.ram * copies:
        with suppress(UserError):
            text = program.numbered()
    if text:
        fed = feed(text, board.rom, board.ram)
        if fed.error is None or fed.error.number != MEMORY_FULL:
            return text, True, fed
    parts, written = tee(map(_text, program.unnumbered()))
    fed = feed_routes(parts, board.rom, board.ram, on_done)
    return "".join(written), False, fed


def _text(statements: list[Step]) -> str:
    return "".join(f"{statement.text}\n" for statement in statements)
