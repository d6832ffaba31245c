"""The work of the process behind the page: a drawing read and matched, its job planned, a tape cut from it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from skg.cutting import holes as holes_files
from skg.cutting.progress import Progress
from skg.errors import UserError
from skg.geometry.placement import Placement
from skg.job import file as job_files
from skg.job.job import Chosen, Job
from skg.job.matching import Match
from skg.job.placing import Copies, Place
from skg.job.wanted import Overrides
from skg.messages.finding import Finding, Phrase
from skg.messages.render import speech
from skg.pipeline.pairing import named
from skg.pipeline.placing import as_drawn, told_as_drawn
from skg.pipeline.steps import (
    CutDrawing,
    OpenedDrawing,
    cut_all,
    open_drawing,
    plan_placed,
    read_options_of,
    refuse_lost,
    wanted_of,
    written,
)
from skg.planning.nesting import Nesting
from skg.planning.plan import Asked
from skg.planning.planned import PlannedContour
from skg.ui import shown
from skg.ui.json_text import EARLY, encoded, told

#: The page's name in messages on its requests.
_PAGE = Phrase("the-page")
#: Refusals of a drawing that can be read with its open lines.
_OF_OPEN = ("open-refused", "outline-lost", "no-outline-gap", "no-outline-junctions")
#: A drawing of so many contours is told of before it is planned.
_MANY = 1000
#: So many contours that cannot be planned are told one by one.
_MOST_ERRORS = 20


class Desk:
    """A drawing, its job, and what came of them. The methods are what the server calls; they return plain data,
    and JSON where there is much of them."""

    def __init__(self, progress: Progress, early: Callable[[dict], None] = lambda _: None) -> None:
        self._progress, self._early = progress, early
        self._data = b""
        self._job: Job | None = None
        self._opened: OpenedDrawing | None = None
        #: The drawing as it could be read last, which the page still shows.
        self._seen: OpenedDrawing | None = None
        self._planned: dict[int, PlannedContour] = {}
        #: The drawing's plan before, and its form for the page.
        self._before: dict[int, tuple[Asked, PlannedContour]] = {}
        self._plans = shown.Plans()
        #: The placement of that plan: where the drawing lies on the machine.
        self._placement = Placement()
        self._nesting: Nesting | None = None
        #: Contours that were found again too far from where they were, without their settings, and how far, mm.
        self._doubts: dict[Chosen, float] = {}
        #: The error while no drawing is open.
        self._why = UserError(Finding("page-no-drawing"))
        self._cut: tuple[int, Job, list[CutDrawing]] | None = None

    def drawing_of(self, text: bytes, name: str) -> str:
        """The drawing that a job file is for."""
        return job_files.decoded(text, name).drawing

    def open(
        self,
        data: bytes,
        name: str,
        job: bytes | dict | None,
        is_known: bool = False,
        setup: job_files.Tables | None = None,
    ) -> dict[str, Any]:
        """Take up a drawing, with a job from a file or from the page, or none: that of a setup then. `is_known`: it was
        open before."""
        if isinstance(job, bytes):
            made = job_files.decoded(job, name)
        else:
            made = job_files.from_data(job, _PAGE) if job else Job(name, **job_files.made(setup or {}))
        self._data, self._doubts = data, {}
        if not is_known:
            self._seen = None
        return self._read(replace(made, drawing=name), is_known)

    def plan(self, data: dict) -> dict[str, Any]:
        """Plan a job; read the drawing anew where it asks for that."""
        job = job_files.from_data(data, _PAGE)
        if self._job is None or job.drawing != self._job.drawing:
            raise UserError(Finding("page-not-open", drawing=job.drawing[:100]))
        if self._opened is None or not self._opened.reading.is_same(read_options_of(self._job), read_options_of(job)):
            return self._read(job)
        self._job = job
        self._opened = replace(self._opened, matches=self._opened.known.find(job.contours, job.box))
        return {"drawing": None} | self._state()

    def ways(self, numbers: list[int]) -> bytes:
        """The ways of the wire along some contours, as JSON."""
        opened = self._present()
        for number in numbers:
            if not 0 <= number < len(opened.contours):
                raise UserError(Finding("page-no-contour", number=number))
        paths = {
            str(number): shown.ways(self._planned[number], self._placement)
            for number in numbers
            if number in self._planned
        }
        return encoded(paths)

    def job(self) -> bytes:
        """The job as a file."""
        return job_files.encoded(self._asked())

    def cut(self, number: int) -> tuple[dict[str, Any], dict[str, bytes]]:
        """Make the tape of a run: what is told of it, and its files."""
        job = self._asked()
        cuts = cut_all(job, self._present(), self._progress)
        self._cut = number, job, cuts
        files = {"job": self.job()}
        for cut in cuts:
            own = f"{cut.member}/" if cut is not cuts[0] else ""
            thick, contours = job.setup.thickness, cut.result.contours
            files |= {f"{own}tape": cut.result.data, f"{own}program": cut.result.program.encode("ascii")}
            files[f"{own}holes"] = holes_files.table(contours)
            if thick is not None:
                files[f"{own}drill"] = holes_files.drilled(contours, thick, "drill")
        return shown.results(cuts), files

    def sheet(self, number: int, tape: str, form: str, language: str, member: str) -> bytes:
        """The setup sheet of a run, of one of a pair, in a language; none: that of this process."""
        if self._cut is None or self._cut[0] != number:
            raise UserError(Finding("page-sheet-gone"))
        try:
            from skg.pictures.sheet import Facts, write_sheet
        except ModuleNotFoundError:
            raise UserError(Finding("needs-matplotlib")) from None
        _, job, cuts = self._cut
        cut = next((cut for cut in cuts if cut.member == member), cuts[0])
        with TemporaryDirectory(prefix="skg-") as folder:
            path = str(Path(folder) / f"sheet.{form}")
            before, speech.language = speech.language, language or speech.language
            try:
                whose = f"{job.drawing}: {named(cut.member)}" if cut.member else job.drawing
                facts = Facts(whose, tape, cut.account.units, job.place.scale, tuple(cut.cost.figures()))
                write_sheet(cut.result, facts, path, form)
            finally:
                speech.language = before
            return Path(path).read_bytes()

    def _asked(self) -> Job:
        """The job; a `UserError` where there is none."""
        if self._job is None:
            raise self._why
        return self._job

    def _present(self) -> OpenedDrawing:
        """The drawing; a `UserError` where there is none."""
        if self._opened is None:
            raise self._why
        return self._opened

    def _read(self, job: Job, is_known: bool = True) -> dict[str, Any]:
        """Read the drawing. One that cannot be read is told of with the job that asked for it; of one that is not known
        yet, and large, the drawing is told of before its plan."""
        self._job, self._opened, self._planned, self._cut = job, None, {}, None
        self._before, self._plans = {}, shown.Plans()
        try:
            self._opened = open_drawing(job, self._data)
        except UserError as error:
            self._why = error
            drawing: dict[str, Any] = {}
            if error.finding.code in _OF_OPEN:
                # (with its open lines, for who looks where they are: a repair may have closed some)
                with suppress(UserError):
                    self._seen = open_drawing(replace(job, read=replace(job.read, open="cut")), self._data)
                    drawing = shown.drawing(self._seen)
            matches = []
            if self._seen:
                matches = self._matches(self._seen.known.find(job.contours, job.box).found)
                # (it has places of the file, which the page shows moved near)
                error.finding = as_drawn(error.finding, Placement(origin=self._seen.reading.noted.by))
            state: dict[str, Any] = {"name": job.drawing, "job": job_files.to_data(job), "matches": matches}
            return {"drawing": drawing, "state": state | {"plan": None, "error": told(error)}}
        self._job = written(job, self._opened)
        for chosen, match in zip(self._job.contours, self._opened.matches.found, strict=True):
            if match.is_doubtful:
                self._doubts[replace(chosen, overrides=Overrides())] = match.moved
        self._opened = replace(self._opened, matches=self._opened.known.find(self._job.contours, self._job.box))
        self._seen = self._opened
        drawing = shown.drawing(self._opened)
        if is_known or len(self._opened.contours) < _MANY:
            return {"drawing": drawing} | self._state()
        # (planned it will be some seconds later)
        matches = self._matches(self._opened.matches.found)
        state = {"name": job.drawing, "job": job_files.to_data(self._job), "matches": matches, "plan": None}
        self._early({"drawing": drawing, "state": state})
        return {"drawing": EARLY} | self._state()

    def _state(self) -> dict[str, Any]:
        """The part of the state that changes with the job, and the plan of those contours that it changes."""
        job, matches = self._asked(), self._matches(self._present().matches.found)
        plan, changed = self._plan(job, self._present())
        state = {"name": job.drawing, "job": job_files.to_data(job), "matches": matches, "plan": plan}
        return {"state": state, "changed": changed}

    def _matches(self, found: Sequence[Match]) -> list[dict[str, Any]]:
        """The contours of the drawing that those of the job are, as the page is told of it."""
        matches = []
        for index, (chosen, match) in enumerate(zip(self._asked().contours, found, strict=True)):
            doubt = self._doubts.get(replace(chosen, overrides=Overrides()))
            moved = round(doubt or match.moved, 4)
            matches.append({"chosen": index, "id": match.number, "moved": moved, "confirm": doubt is not None})
        return matches

    def _plan(self, asked: Job, opened: OpenedDrawing) -> tuple[bytes, bytes]:
        """The plan: of all contours that can be planned, with what is wrong with the others; and as it has changed."""
        wanted = wanted_of(asked, opened)
        tried = list(wanted)
        contours: list[PlannedContour] = []
        errors: list[UserError] = []
        with _noted(errors):
            refuse_lost(asked, opened)
        job, placement, nesting = asked, Placement(), opened.nesting
        with _noted(errors), told_as_drawn(Placement(), *opened.source):
            placement, nesting = opened.placement(job), opened.placed(job)
        if nesting is opened.nesting:
            # (what cannot be placed is shown as it is drawn)
            job, placement = replace(job, place=Place(), copies=Copies()), Placement()
        if nesting is not self._nesting:
            self._placement, self._nesting, self._before, self._plans = placement, nesting, {}, shown.Plans()
        while not contours and len(errors) < _MOST_ERRORS:
            with _noted(errors):
                contours = plan_placed(job, opened, tried, self._before)
                break
            number = errors[-1].contour
            if number is None:
                break
            # (without the places that somebody gave, or else not at all)
            free = replace(tried[number], start=None, entry=None, order=None)
            tried[number] = free if free != tried[number] else replace(free, cut=False)
        self._planned = {planned.number: planned for planned in contours}
        pattern = opened.pattern(job)
        return self._plans.written(contours, wanted, errors, placement, pattern)


@contextmanager
def _noted(errors: list[UserError]) -> Iterator[None]:
    """Note an error, and go on."""
    try:
        yield
    except UserError as error:
        errors.append(error)
