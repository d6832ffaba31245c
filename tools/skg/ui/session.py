"""The drawing that is open, its job and its run: what the page is told, and what it may do."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from threading import Condition, Event, Lock, Thread
from typing import overload

from skg.errors import UserError, of_system
from skg.files import is_same_file, read_bytes, write_bytes
from skg.job import file as job_files
from skg.job.job import Job, TapeForm
from skg.job.machine import ROMS
from skg.job.setups import Setups
from skg.messages.finding import Finding, Phrase
from skg.pipeline.pairing import DIE, PUNCH, ending_of, file_name
from skg.tape.block import Block
from skg.tape.positions import WITHOUT_DRIFT
from skg.tape.styles import STYLES, read_any, to_style
from skg.ui.json_text import EARLY, said, told
from skg.ui.worker import Ended, Worker

#: The drawing's file is looked at so often, s.
_LOOK = 0.5
#: The ways of no more contours are asked for at once.
MOST_WAYS = 200
#: Files that can be saved, in the order of writing: no tape if another file fails.
SAVED = ("program", "job", "sheet", "holes", "drill", "tape")
#: Endings of the files of start holes, behind the name without its own.
HOLES = {"holes": "-holes.csv", "drill": "-holes.nc"}
#: The drawing, as the page is told of it, of a file that could never be read.
NOTHING: dict = {
    **{name: [] for name in ("layers", "contours", "starts", "repairs", "report")},
    **{name: [0.0, 0.0] for name in ("size", "low")},
    **{name: "" for name in ("sha256", "units", "units_from")},
    "left": {"edges": [], "notes": []},
}
#: Job files end so; that of what nobody has saved has this before.
JOB, UNSAVED = ".job.toml", ".unsaved"
#: What is set is kept when nothing else was set for so long, s.
_MOMENT = 1.0
#: A name without its ending has no more letters.
MOST_STEM = 200


class Conflict(UserError):
    """Something that the page must decide on, or did not know of yet: `data` says of what."""

    def __init__(self, why: Finding, **data: object) -> None:
        super().__init__(why)
        self.data = data


@dataclass
class CutRun:
    """A tape in the making, or made, of the job of a drawing at a revision. `changes`: count of changes since it began;
    `files`: those that are made."""

    number: int
    drawing: str
    rev: int
    state: str = "running"
    changes: int = 0
    stage: str = "plan"
    done: int = 0
    total: int = 0
    error: dict | None = None
    result: dict | None = None
    files: dict[str, bytes] = field(default_factory=dict)

    def data(self) -> dict:
        """The run as the page is told of it."""
        data = {"state": self.state, "k": self.changes, "stage": self.stage, "done": self.done, "of": self.total}
        return data | {name: value for name in ("error", "result") if (value := getattr(self, name)) is not None}


class Session:
    """The open job, drawing and plan of one `skg ui`."""

    def __init__(self, setups: Setups) -> None:
        self.kept_setups = setups
        self._worker = Worker()
        #: Lock for calls of the worker: one change, one cut at a time. `_is_long`: the call may take its time, and
        #: ends if another takes its place.
        self._turn = Lock()
        self._is_long = False
        #: The state and the run, and news of these. `_drawn` goes up when the contours are new.
        self._news = Condition()
        self._rev = self._drawn = 0
        #: The revision of a drawing that was told of before it was planned, and that of its plan: they are one.
        self._planned = -1, -1
        self._is_early = False
        #: The page's state, and the drawing, which stays as long as the contours are the same.
        self._state: dict = {"name": None}
        self._drawing: dict = {}
        #: The reason why the drawing could not be read, as the page is told of it; it has ended the process.
        self._unread: dict | None = None
        self._is_unsafe = False
        self._run: CutRun | None = None
        self._runs = 0
        self._data = b""
        #: The drawing's file and the job's, where these were named on the command line; the first as it was read.
        self._path: Path | None = None
        self._job_path: Path | None = None
        self._stamp: tuple[int, ...] | None = None
        #: The job as a file has it, or as it was before the page changed it; None before there is one.
        self._saved: dict | None = None
        self._closed = Event()
        #: The file of this session's own that has what nobody has saved; jobs beside the drawing that were not looked
        #: at, by their names.
        self._kept: Path | None = None
        self._keeping = Lock()
        self._offers: list[str] = []

    def begin(self, path: Path | None) -> None:
        """Open a drawing or a job file, if one is named, and watch the drawing."""
        if path is None:
            Thread(target=self._warm, daemon=True).start()
            return
        job = None
        if path.name.lower().endswith(".toml"):
            job, self._job_path = read_bytes(str(path)), path
            path = path.with_name(self._worker.call("drawing_of", job, str(path)))
        self._path, self._stamp = path, _stamp(path)
        data = read_bytes(str(path))
        Thread(target=self._watch, args=(data, job), daemon=True).start()
        Thread(target=self._keep_always, daemon=True).start()

    def may_end(self) -> bool:
        """Whether nobody is kept waiting and nothing is lost when all ends now."""
        return not self._is_long and (self._path is not None or not self._has_changes())

    def keep(self) -> str | None:
        """Write what the page has set and nobody has saved beside the drawing, over nothing: the job file's name."""
        if self._path is None or not self._has_changes():
            return None
        if self._run:
            self.cancel(self._run.number)
        return self._keep().name

    def _keep(self) -> Path:
        """Write the job as it is now into a file of this session's own, beside the drawing."""
        drawing = self._path
        if self._is_unsafe or drawing is None:
            raise UserError(Finding("no-job-yet"))
        with self._keeping:
            data = job_files.encoded(job_files.from_data(self._state["job"], self._state["name"]))
            name = self._names()["job"].removesuffix(JOB)
            path, number = self._kept or drawing.with_name(f"{name}{UNSAVED}{JOB}"), 1
            try:
                while not self._kept and path.exists() and path.read_bytes() != data:
                    number += 1
                    path = drawing.with_name(f"{name}{UNSAVED}-{number}{JOB}")
                if not path.exists() or path.read_bytes() != data:
                    write_bytes(str(path), data)
            except OSError as error:
                raise UserError(Finding("page-not-kept", file=path.name, why=of_system(error))) from None
            self._kept = path
            return path

    def _keep_always(self) -> None:
        """Keep the job a moment after each change; what is saved is not kept beside that."""
        before = None
        while not self._closed.wait(_MOMENT) and self._path:
            with self._news:
                now, is_whole = self._state.get("job"), not self._is_unsafe
            if now is not None and now == before and is_whole:
                # (a folder that takes nothing is told of at the end)
                with suppress(UserError):
                    if self._has_changes():
                        self._keep()
                    else:
                        self._forget_kept()
            before = now

    def _forget_kept(self) -> None:
        with self._keeping:
            kept, self._kept = self._kept, None
            if kept:
                with suppress(OSError):
                    kept.unlink()

    def _find_offers(self) -> None:
        """Find jobs beside the drawing: the last one that nobody has saved, and the drawing's own."""
        if self._path is None:
            return
        job = self._path.with_name(self._names()["job"])
        stem, folder = job.name.removesuffix(JOB), self._path.parent
        known = {f"{stem}{UNSAVED}{JOB}", *(f"{stem}{UNSAVED}-{number}{JOB}" for number in range(2, 100))}
        with suppress(OSError):
            unsaved = [entry for entry in folder.iterdir() if entry.name in known and entry.is_file()]
            newest = sorted(unsaved, key=lambda entry: entry.stat().st_mtime_ns)[-1:]
            own = [job] if self._job_path is None and job.is_file() else []
            self._offers = [entry.name for entry in (*newest, *own)]

    def take(self, name: str, is_wanted: bool) -> dict:
        """Take a job that is offered, or leave it: the state."""
        if name not in self._offers or self._path is None:
            raise UserError(Finding("bad-request", detail="name: not offered"))
        path = self._path.with_name(name)
        is_unsaved = UNSAVED in name.removesuffix(JOB)
        if is_wanted:
            data = read_bytes(str(path))
            with self._called():
                answer = self._worker.call("open", self._data, self._state["name"], data, True)
                if is_unsaved:
                    self._kept = path
                else:
                    self._job_path = path
                self._take(answer, is_saved=not is_unsaved)
        with self._news:
            self._offers = [] if is_wanted else [other for other in self._offers if other != name]
            self._rev += not is_wanted
            self._news.notify_all()
        return self.state()

    def _has_changes(self) -> bool:
        return self._state.get("job") is not None and self._state["job"] != self._saved

    def close(self) -> None:
        """End all that is on."""
        self._closed.set()
        self._worker.end()
        with self._news:
            self._news.notify_all()

    # The state.

    @overload
    def state(self) -> dict: ...
    @overload
    def state(self, after: int | None, patience: float = 0.0, drawn: int | None = None) -> dict | None: ...
    def state(self, after: int | None = None, patience: float = 0.0, drawn: int | None = None) -> dict | None:
        """The state; after some revision the next one, None when there is none for so long (s).

        Without the drawing where the page has it already: its number is `drawn`.
        """
        with self._news:
            if not self._news.wait_for(lambda: self._rev != after or self._closed.is_set(), patience):
                return None
            run = self._run if self._run and self._run.drawing == self._state["name"] else None
            state = {
                "rev": self._rev,
                "drawn": self._drawn,
                "can_save": self._path is not None,
                "offers": self._offers,
                "run": run and run.number,
                "run_rev": run and run.rev,
                **self._state,
            }
            return state if drawn == self._drawn else state | self._drawing

    def open(self, data: bytes, name: str) -> dict:
        """Open a drawing that the page sent, or a job for the drawing that is open: the state."""
        if not name.lower().endswith(".toml"):
            self._path = self._job_path = self._kept = None
            self._offers = []
            self._load(data, name, None)
            return self.state()
        with self._called():
            drawing = self._worker.call("drawing_of", data, name)
            if drawing != self._state["name"]:
                raise UserError(Finding("job-of-other", name=name, drawing=drawing))
            self._take(self._worker.call("open", self._data, drawing, data, True), is_saved=True)
        return self.state()

    def plan(self, rev: int, job: dict) -> dict:
        """Plan a job as the page has it; the whole state where the drawing is read anew for it, else of the plan's
        contours those alone that have changed."""
        with self._called(rev):
            answer = self._worker.call("plan", job)
            self._take(answer)
            if answer["drawing"] is not None:
                return self.state()
            job, matches = answer["state"]["job"], answer["state"]["matches"]
            return {"rev": self._rev, "job": job, "matches": matches, "plan": answer["changed"]}

    def ways(self, rev: int, ids: list[int]) -> dict:
        """The ways of the wire along some contours."""
        if len(ids) > MOST_WAYS:
            raise UserError(Finding("bad-request", detail=f"ids: at most {MOST_WAYS} contours at once"))
        with self._called(rev):
            return {"rev": rev, "ways": self._worker.call("ways", ids)}

    def job(self) -> bytes:
        """The job as a file, which the page has then."""
        data = self._job_file()
        self._note_saved(None)
        return data

    def _job_file(self) -> bytes:
        with self._called():
            if self._state.get("job") is None or self._is_unsafe:
                raise UserError(Finding("no-job-yet"))
            return self._worker.call("job")

    @contextmanager
    def _called(self, rev: int | None = None) -> Iterator[None]:
        """Have the turn; where the page knows an older revision than the present one, that is a `Conflict`."""
        with self._turn:
            self._expect(rev)
            yield

    def _expect(self, rev: int | None) -> None:
        if rev is not None and rev != self._rev and (rev, self._rev) != self._planned:
            raise Conflict(Finding("changed-meanwhile"), state=self.state())

    def _load(self, data: bytes, name: str, job: bytes | dict | None, path: Path | None = None) -> None:
        """Read a drawing, of a file unless the page sent it; nothing is done where the page has sent another meanwhile.

        One that cannot be read is open all the same, with the error: its job may be at fault. Where it is a file that
        was saved anew, the page goes on to show what was read before.
        """
        self._end_what_is_long(path)
        with self._called():
            if path != self._path:
                return
            self._is_long = True
            self._worker.first = None
            is_known = path is not None and bool(self._drawing)
            try:
                setup = None if job else self._last_setup()
                early = None if is_known else partial(self._take_early, data, not isinstance(job, dict))
                answer = self._worker.call("open", data, name, job, is_known, setup, early=early)
            except Ended as ended:
                if ended.is_wanted:
                    raise
                answer = self._refused(name, ended, is_known)
            except UserError as error:
                answer = self._refused(name, error, is_known)
            finally:
                with self._news:
                    self._is_long = self._is_early = False
            self._data = data
            # (read anew with what the page has set: that is saved no more than before)
            is_saved = not isinstance(job, dict) or not self._has_changes()
            self._take(answer, not is_known, is_saved)

    def _take_early(self, data: bytes, is_saved: bool, answer: dict) -> None:
        """Take a drawing that is read and not planned yet."""
        with self._news:
            self._rev += 1
            self._data, self._state = data, answer["state"]
            if is_saved:
                self._saved = self._state["job"]
            self._unread, self._is_unsafe = None, False
            self._drawn, self._drawing = self._rev, NOTHING | answer["drawing"]
            self._is_early = True
            self._news.notify_all()

    def _refused(self, name: str, error: UserError, is_known: bool) -> dict:
        """The answer for a drawing that ended the process that read it, or kept it too long."""
        kept = {key: self._state[key] for key in ("job", "matches")} if is_known else {"job": None, "matches": []}
        return {"state": {"name": name, "error": told(error), "plan": None} | kept, "drawing": {}, "is_unsafe": True}

    def _end_what_is_long(self, path: Path | None) -> None:
        """End a cut or the reading of another drawing: the drawing of a file, or of the page, takes its place."""
        with self._news:
            if path != self._path:
                return
            if self._run:
                self._tell(self._run, state="cancelled")
            if self._is_long:
                self._worker.end()

    def _take(self, answer: dict, is_other: bool = False, is_saved: bool = False) -> None:
        """Take what the worker found for the state; of a drawing that it could not read, what was read before stays.

        `is_saved`: the job is a file's, or nobody has set anything.
        """
        with self._news:
            self._rev += 1
            self._state, drawing = answer["state"], answer["drawing"]
            if is_saved:
                self._saved = self._state["job"]
            if drawing is not None:
                self._unread, self._is_unsafe = self._state.get("error"), answer.get("is_unsafe", False)
            if drawing == EARLY:
                self._planned = self._drawn, self._rev
            else:
                if is_other:
                    self._drawing = {}
                if drawing or drawing is not None and not self._drawing:
                    self._drawn, self._drawing = self._rev, NOTHING | drawing
            job = self._state["job"]
            # (a drawing that ended the process is not read once more by the next one)
            is_known = job is not None and not self._is_unsafe
            self._worker.first = ("open", (self._data, self._state["name"], job, True)) if is_known else None
            self._news.notify_all()

    def _warm(self) -> None:
        """Begin the worker, so that it is there when it is needed."""
        with self._called(), suppress(UserError):
            self._worker.call("drawing_of", b"", "")

    # The drawing's file.

    def _watch(self, data: bytes, job: bytes | None) -> None:
        """Read the drawing, and again whenever its file has changed and is at rest."""
        path, before = self._path, self._stamp
        assert path is not None, "it begins with a drawing"
        self._find_offers()
        with suppress(Ended):
            self._load(data, path.name, job, path)
        while not self._closed.wait(_LOOK) and self._path:
            now = _stamp(path)
            is_new, before = now == before and now != self._stamp, now
            if not is_new:
                continue
            self._stamp = now
            try:
                data = path.read_bytes()
            except OSError as error:
                self._say(Finding("shown-is-older", why=of_system(error)).within(path.name))
                continue
            if data == self._data:
                self._say(None)
            else:
                with suppress(Ended):
                    self._load(data, path.name, self._state["job"] or job, path)

    def _say(self, finding: Finding | None) -> None:
        """Say what is wrong with the drawing's file; None: it is as it was read."""
        error = {"message": said(finding)} if finding else self._unread
        with self._called():
            self._take({"state": self._state | {"error": error}, "drawing": None})

    # The run.

    def cut(self, rev: int) -> int:
        """Begin to make the tape: the run's number."""
        # (one that was cancelled is over, if its process has not ended yet: its turn is waited for)
        # (and so is the plan of a drawing that is there already)
        is_over = self._is_early or self._run is not None and self._run.state == "cancelled"
        if self._is_long and not is_over:
            raise Conflict(Finding("busy"))
        # (the turn is given back by the thread)
        self._turn.acquire()
        try:
            self._expect(rev)
            self._is_long = True
            with self._news:
                self._runs += 1
                run = self._run = CutRun(self._runs, self._state["name"], self._rev)
            Thread(target=self._make, args=(run,), daemon=True).start()
        except BaseException:
            self._is_long = False
            self._turn.release()
            raise
        return run.number

    def _make(self, run: CutRun) -> None:
        def progress(stage: str, done: int, total: int) -> None:
            self._tell(run, stage=stage, done=done, total=total)

        try:
            result, files = self._worker.call("cut", run.number, progress=progress)
            name = self._names()["tape"]
            if mate := result.get("mate"):
                mate["tape_name"] = file_name(name, ending_of(DIE, False))
                name = file_name(name, ending_of(PUNCH, False))
            self._tell(run, state="done", files=files, result=result | {"tape_name": name})
        except UserError as error:
            self._tell(run, state="failed", error=told(error))
        finally:
            with self._news:
                self._is_long = False
            if run.state == "cancelled" and not self._closed.is_set():
                with suppress(UserError):
                    self._worker.begin()
            self._turn.release()

    def _tell(self, run: CutRun, **news: object) -> None:
        """Change a run that is on, and tell of it."""
        with self._news:
            if run.state == "running":
                for name, value in news.items():
                    setattr(run, name, value)
                run.changes += 1
                self._news.notify_all()

    def _known(self, number: int) -> CutRun:
        if self._run is None or self._run.number != number:
            raise UserError(Finding("no-run", number=number))
        return self._run

    @overload
    def run(self, number: int) -> dict: ...
    @overload
    def run(self, number: int, after: int | None, patience: float = 0.0) -> dict | None: ...
    def run(self, number: int, after: int | None = None, patience: float = 0.0) -> dict | None:
        """Progress of a run: the news behind what was told last, None when there is none for so long (s)."""
        with self._news:
            run = self._known(number)
            is_news = self._news.wait_for(
                lambda: run.changes != after or run.state != "running" or self._closed.is_set(), patience
            )
            return run.data() if is_news else None

    def cancel(self, number: int) -> dict:
        """Cancel a run, if it is on."""
        with self._news:
            run = self._known(number)
            if run.state == "running":
                # (it cannot end now and leave the process to another call)
                self._tell(run, state="cancelled")
                self._worker.end()
            return run.data()

    def file(self, number: int, kind: str, language: str = "", tape: str = "", member: str = "") -> bytes:
        """A file of a run, of one of a pair; the sheet is drawn when it is asked for, in a language, with the name of
        the tape."""
        run = self._known(number)
        if run.state != "done":
            raise UserError(Finding("run-without-tape", number=number))
        result = run.result or {}
        is_mate = member == DIE and "mate" in result and kind != "job"
        known = f"{DIE}/{kind}" if is_mate else kind
        if known in run.files:
            return run.files[known]
        if kind == "drill":
            raise UserError(Finding("drill-without-thickness"))
        tape = tape or (result["mate"] if is_mate else result)["tape_name"]
        key = f"{known} {language} {tape}"
        if key not in run.files:
            form = kind.partition(".")[2] or "pdf"
            with self._called():
                run.files[key] = self._worker.call("sheet", number, tape, form, language, member)
        return run.files[key]

    # Saving.

    def _names(self) -> dict[str, str]:
        """The names of what can be saved."""
        name = self._state["name"] or (self._path.name if self._path else "")
        stem = name[: -len(Path(name).suffix)] if Path(name).suffix else name
        job = self._job_path.name if self._job_path else stem + JOB
        rom = (self._state.get("job") or {}).get("machine", {}).get("rom", ROMS[0])
        tape = stem + (WITHOUT_DRIFT if rom == ROMS[0] else ".3b")
        holes = {kind: stem + ending for kind, ending in HOLES.items()}
        return {"program": f"{stem}.skg", "job": job, "sheet": f"{stem}.pdf", "tape": tape} | holes

    def styled(self, number: int, style: str, first: int = 1, member: str = "") -> bytes:
        """The tape of a run, of one of a pair, in a style, from a block on (from 1)."""
        data = self.file(number, "tape", member=member)
        if style not in STYLES:
            raise UserError(Finding("bad-request", detail=f"style: expected one of {', '.join(STYLES)}"))
        if style == "punch" and first == 1:
            return data
        items = list(read_any(data).items)
        begins = [at for at, item in enumerate(items) if isinstance(item, Block)]
        if not 1 <= first <= len(begins):
            raise UserError(Finding("bad-request", detail=f"block: expected from 1 to {len(begins)}"))
        return to_style(items[begins[first - 1] :], style)

    def job_in_form(self, number: int, form: TapeForm) -> bytes:
        """The job of a run with the form in which its tape is saved."""
        data = self.file(number, "job")
        job = job_files.decoded(data, self._names()["job"])
        return data if job.tape == form else job_files.encoded(replace(job, tape=form))

    def named(self, name: str, is_short: bool) -> dict[str, str]:
        """The names of files, all of them after a given one, but for the job: it is the drawing's. `is_short`: that of
        the tape has eight letters and three, and does not tell whether it is without drift."""
        names = self._names()
        if not name:
            return names
        if len(name) > MOST_STEM or Path(name).name != name or not name.isprintable() or name.startswith("."):
            raise UserError(Finding("bad-request", detail="name: expected that of a file, without a folder"))
        ending = ".3b" if is_short else names["tape"][len(names["program"]) - len(".skg") :]
        names |= {kind: name + ending for kind, ending in HOLES.items()}
        return names | {"program": f"{name}.skg", "sheet": f"{name}.pdf", "tape": name + ending}

    def _files_of(
        self, number: int, kinds: list[str], names: dict[str, str], form: TapeForm, language: str
    ) -> dict[str, bytes]:
        """Files of a run by their names, in the order of writing: of a pair both of each kind. Without a name for the
        tape it has the run's."""
        result = self._known(number).result or {}
        files = {}
        for kind in (kind for kind in SAVED if kind in kinds):
            if kind == "job":
                files[names[kind]] = self.job_in_form(number, form)
                continue
            for member in (PUNCH, DIE) if "mate" in result else ("",):
                ending = ending_of(member, form.short_name)
                tape = file_name(names["tape"], ending)
                if not names["tape"]:
                    tape = (result["mate"] if member == DIE else result)["tape_name"]
                elif member:
                    form.refuse_name(tape)
                if kind == "tape":
                    files[tape] = self.styled(number, form.style, member=member)
                else:
                    files[file_name(names[kind], ending)] = self.file(number, kind, language, tape, member)
        return files

    def save(
        self, number: int | None, kinds: list[str], is_over: bool, name: str, form: TapeForm, language: str
    ) -> list[str]:
        """Write files of a run beside the drawing: their names. Some that are there are a `Conflict`.

        `name`: that of the files, without endings, else the drawing's; `form`: of the tape; `language`: of the sheet.
        """
        if self._path is None:
            raise UserError(Finding("no-folder"))
        if unknown := [kind for kind in kinds if kind not in SAVED]:
            detail = f"what: unknown {unknown[0]!r}, expected some of {', '.join(SAVED)}"
            raise UserError(Finding("bad-request", detail=detail))
        if number is None and kinds != ["job"]:
            raise UserError(Finding("bad-request", detail="run: expected a number, for what is made by a run"))
        names, folder = self.named(name, form.short_name), self._path.parent
        if number is not None:
            names |= {} if name else {"tape": ""}
            files = self._files_of(number, kinds, names, form, language)
        else:
            files = {names["job"]: self._job_file()}
        # (a link to nothing is there too: its target would be written)
        if not is_over and (exists := [name for name in files if os.path.lexists(folder / name)]):
            raise Conflict(Finding("already-there", names=tuple(exists)), exists=exists)
        for name in files:
            if is_same_file(str(folder / name), str(self._path)):
                raise UserError(Finding("written-twice").within(name))
            if (folder / name).exists() and not (folder / name).is_file():
                raise UserError(Finding("no-plain-file").within(name))
        written: list[str] = []
        for name, data in files.items():
            try:
                write_bytes(str(folder / name), data)
            except OSError as error:
                done = Phrase("already-written", names=tuple(written)) if written else None
                raise UserError(Finding("not-written", why=of_system(error), done=done).within(name)) from None
            written.append(name)
        if "job" in kinds:
            self._note_saved(number)
            if not self._has_changes():
                self._forget_kept()
        return written

    # Setups.

    def setups(self) -> dict:
        """The setups that are kept, as a job has their keys, with the one that was chosen last, and all keys."""
        every = []
        for name in self.kept_setups.names():
            try:
                tables = job_files.to_data(Job("", **job_files.made(self.kept_setups.kept(name))))
                every.append({"name": name, "tables": {key: tables.get(key, {}) for key in job_files.SETUP}})
            except UserError as error:
                every.append({"name": name, "error": told(error)})
            except OSError as error:
                every.append({"name": name, "error": told(UserError(of_system(error).within(name)))})
        return {"setups": every, "last": self.kept_setups.last(), "keys": job_files.SETUP}

    def _last_setup(self) -> job_files.Tables | None:
        """The setup that was chosen last; a damaged one is told of where setups are listed."""
        name = self.kept_setups.last()
        with suppress(UserError, OSError):
            return self.kept_setups.kept(name) if name else None
        return None

    def use_setup(self, name: str) -> dict:
        """Note the setup that was chosen last, or that none is: it is the next drawing's."""
        if name:
            self.kept_setups.kept(name)
        with _writing(self.kept_setups.folder):
            self.kept_setups.note_last(name)
        return self.setups()

    def keep_setup(self, name: str, tables: dict, is_over: bool) -> dict:
        """Keep a setup. One that is there is a `Conflict`."""
        checked = job_files.setup_from_data(tables, name)
        if self.kept_setups.is_kept(name) and not is_over:
            raise Conflict(Finding("already-there", names=(name,)), exists=[name])
        with _writing(self.kept_setups.folder):
            self.kept_setups.keep(name, checked)
            self.kept_setups.note_last(name)
        return self.setups()

    def drop_setup(self, name: str) -> dict:
        """Remove a setup."""
        with _writing(self.kept_setups.folder):
            self.kept_setups.drop(name)
        return self.setups()

    def _note_saved(self, number: int | None) -> None:
        """Note that the job of a run, or that of now, is in a file."""
        with self._news:
            if number is None or self._run and (self._run.number, self._run.rev) == (number, self._rev):
                self._saved = self._state["job"]


@contextmanager
def _writing(folder: Path) -> Iterator[None]:
    """An error in writing there is the user's."""
    try:
        yield
    except OSError as error:
        raise UserError(Finding("not-written", why=of_system(error), done=None).within(str(folder))) from None


def _stamp(path: Path) -> tuple[int, ...] | None:
    """A mark that changes when a file is written; None when it is not there."""
    with suppress(OSError):
        status = path.stat()
        return status.st_mtime_ns, status.st_size, status.st_ino
    return None
