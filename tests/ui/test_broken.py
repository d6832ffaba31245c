"""Breakdowns: a killed process, a cancelled cut, a full disk, drawings made to exhaust the machine."""

from __future__ import annotations

import errno
import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.process import BaseProcess
from pathlib import Path
from threading import Thread
from urllib.parse import quote

import pytest
from facthelp import says
from uihelp import Json, Page, circles, english, plate, until

from skg.messages.finding import Phrase
from skg.ui import worker
from skg.ui.server import Server
from skg.ui.session import CutRun

SKG = Path(sys.executable).with_name("skg")


def process_of(server: Server) -> int:
    return server.session._worker._process.pid


@pytest.fixture
def server(serve: Callable[[], Server]) -> Server:
    return serve()


def test_killed_between_calls(server: Server, tmp_path: Path) -> None:
    """The next call begins a new process, which has what the one before it had."""
    page = Page(server)
    state = page.open(plate(tmp_path))
    state |= page.put(state, machine={"offset": 0.1})
    os.kill(process_of(server), signal.SIGKILL)
    time.sleep(0.2)
    ways = page.done("POST", "/api/ways", {"rev": state["rev"], "ids": [0]})["ways"]
    assert ways["0"][0][0][3] == -0.1
    assert page.cut(state["rev"])[1]["state"] == "done"


def test_killed_in_a_call(server: Server, tmp_path: Path) -> None:
    """That call fails in one line, and the next one works."""
    page = Page(server)
    page.open(plate(tmp_path))
    answers = []
    reading = Thread(target=lambda: answers.append(page.open(circles(tmp_path, 20_000))))
    before = process_of(server)
    reading.start()
    until(lambda: server.session._is_long)
    time.sleep(0.3)
    os.kill(before, signal.SIGKILL)
    reading.join()
    assert "SIGKILL" in english(answers[0]["error"]) and answers[0]["contours"] == []
    assert len(page.open(plate(tmp_path))["contours"]) == 3
    assert process_of(server) != before


def test_killed_in_the_first_reading(server: Server, tmp_path: Path) -> None:
    """There is no job to save, and that is said."""
    page, answers = Page(server), []
    reading = Thread(target=lambda: answers.append(page.open(circles(tmp_path, 20_000))))
    reading.start()
    until(lambda: server.session._is_long)
    time.sleep(0.3)
    os.kill(process_of(server), signal.SIGKILL)
    reading.join()
    assert answers[0]["job"] is None
    answer = page.get("/api/job")
    assert answer.status == 400 and says(answer.message, Phrase("no-job-yet"))


def test_no_process_can_begin(server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Reading and cutting end with the system's reason, and go on as soon as it begins one."""

    def refuse(_process: BaseProcess) -> None:
        raise OSError(errno.EAGAIN, os.strerror(errno.EAGAIN))

    def ended() -> None:
        until(lambda: server.session._worker._process)
        os.kill(process_of(server), signal.SIGKILL)
        until(lambda: not server.session._worker._process.is_alive())

    page, path = Page(server), plate(tmp_path)
    ended()
    with monkeypatch.context() as patch:
        patch.setattr(BaseProcess, "start", refuse)
        server.session.begin(path)
        state = page.state()
        assert (state["name"], state["error"]["code"]) == (path.name, "no-process")
    state = page.open(path)
    assert len(state["contours"]) == 3
    ended()
    with monkeypatch.context() as patch:
        patch.setattr(BaseProcess, "start", refuse)
        run = page.cut(state["rev"])[1]
        assert run["state"] == "failed" and run["error"]["code"] == "no-process"
    assert page.cut(state["rev"])[1]["state"] == "done"


def test_killed_in_a_cut(server: Server, tmp_path: Path) -> None:
    page = Page(server)
    state = page.open(circles(tmp_path, 2000))
    # (halted, it cannot be done before it is killed)
    os.kill(process_of(server), signal.SIGSTOP)
    number = page.done("POST", "/api/cut", {"rev": state["rev"]})["run"]
    os.kill(process_of(server), signal.SIGKILL)
    run = page.wait(number)
    assert run["state"] == "failed" and "SIGKILL" in english(run["error"])
    assert page.call("GET", f"/api/run/{number}/tape").status == 400
    assert page.cut(state["rev"])[1]["state"] == "done"


def test_sheet_of_a_process_that_is_gone(server: Server, tmp_path: Path) -> None:
    page = Page(server)
    number, run = page.cut(page.open(plate(tmp_path))["rev"])
    assert run["state"] == "done"
    os.kill(process_of(server), signal.SIGKILL)
    time.sleep(0.2)
    assert says(page.call("GET", f"/api/run/{number}/sheet").message, Phrase("page-sheet-gone"))
    assert page.get(f"/api/run/{number}/tape").status == 200


def test_progress(server: Server, tmp_path: Path) -> None:
    """The steps are told, and how many contours are done."""
    page = Page(server)
    number = page.done("POST", "/api/cut", {"rev": page.open(circles(tmp_path, 4000))["rev"]})["run"]
    run = page.done("GET", f"/api/run/{number}")
    told = []
    while run["state"] == "running":
        told.append((run["stage"], run["done"], run["of"]))
        run = page.done("GET", f"/api/run/{number}?after={run['k']}")
    assert run["state"] == "done"
    stages = list(dict.fromkeys(stage for stage, _, _ in told))
    assert stages == [one for one in ("plan", "board", "check") if one in stages] and "board" in stages
    assert any(stage == "board" and 0 < done < of == 4000 for stage, done, of in told), told


def test_cancel(server: Server, tmp_path: Path) -> None:
    """Back within a second, whatever the process does; the next cut is another one."""
    page = Page(server)
    state = page.open(circles(tmp_path, 4000))
    number = page.done("POST", "/api/cut", {"rev": state["rev"]})["run"]
    assert page.call("POST", "/api/cut", {"rev": state["rev"]}).status == 409
    until(lambda: page.done("GET", f"/api/run/{number}")["stage"] != "plan")
    began = time.monotonic()
    assert page.done("DELETE", f"/api/run/{number}")["state"] == "cancelled"
    assert page.done("GET", f"/api/run/{number}?after=0")["state"] == "cancelled"
    assert time.monotonic() - began < 1.0
    assert page.call("GET", f"/api/run/{number}/tape").status == 400
    # (at once: the process of the cancelled one may not have ended yet)
    later, run = page.cut(state["rev"])
    assert run["state"] == "done" and later > number


@pytest.mark.parametrize("stage", ["plan", "board", "check"])
def test_cancel_in_each_stage(server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stage: str) -> None:
    """The answer comes before the work ends: its process is halted in that stage, and gone behind the answer."""
    page = Page(server)
    state = page.open(circles(tmp_path, 300))
    process, tell = server.session._worker._process, server.session._tell

    def halting(run: CutRun, **news: object) -> None:
        if news.get("stage") == stage:
            os.kill(process.pid, signal.SIGSTOP)
        tell(run, **news)

    monkeypatch.setattr(server.session, "_tell", halting)
    number = page.done("POST", "/api/cut", {"rev": state["rev"]})["run"]
    after = 0
    while (run := page.done("GET", f"/api/run/{number}?after={after}"))["stage"] != stage:
        after = run["k"]
    assert run["state"] == "running" and process.is_alive()
    assert page.done("DELETE", f"/api/run/{number}")["state"] == "cancelled"
    monkeypatch.undo()
    until(lambda: not process.is_alive())
    assert page.cut(state["rev"])[1]["state"] == "done"


def test_cancel_of_a_reading(server: Server, tmp_path: Path) -> None:
    """Another drawing ends the reading of one, wherever that is."""
    page, answers = Page(server), []
    page.open(plate(tmp_path))
    process = server.session._worker._process
    data = circles(tmp_path, 2000).read_bytes()
    reading = Thread(target=lambda: answers.append(page.call("POST", "/api/open", data, X_Name="many.dxf")))
    os.kill(process.pid, signal.SIGSTOP)
    reading.start()
    until(lambda: server.session._is_long)
    assert len(page.open(plate(tmp_path))["contours"]) == 3
    reading.join()
    assert answers[0].status == 400 and not process.is_alive()


def test_another_drawing_takes_the_place_of_a_cut(server: Server, tmp_path: Path) -> None:
    page = Page(server)
    state = page.open(circles(tmp_path, 4000))
    number = page.done("POST", "/api/cut", {"rev": state["rev"]})["run"]
    new = page.open(plate(tmp_path))
    assert len(new["contours"]) == 3
    assert page.done("GET", f"/api/run/{number}")["state"] == "cancelled"
    assert page.cut(new["rev"])[1]["state"] == "done"


def test_client_that_goes_away(server: Server) -> None:
    """A question for news that nobody waits for any more is given up, and leaves room for others."""
    page = Page(server)
    rev = page.done("GET", "/api/state")["rev"]
    host, port = page.host.split(":")
    for _ in range(40):
        with socket.create_connection((host, int(port))) as connection:
            text = f"GET /api/state?after={rev} HTTP/1.1\r\nHost: {page.host}\r\nAuthorization: Bearer {page.token}\r\n"
            connection.sendall(f"{text}\r\n".encode())
    until(lambda: server._free._value >= 63)


@pytest.fixture
def small_disk(tmp_path: Path) -> Path:
    """A disk of 64 KiB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(folder)], capture_output=True)
    if done.returncode:
        pytest.skip("no file system may be mounted")
    yield folder
    subprocess.run(["umount", "-l", str(folder)], check=True)


def test_full_disk(serve: Callable[[Path], Server], small_disk: Path) -> None:
    """One line, nothing half written, and what was there before is there still."""
    page = Page(serve(plate(small_disk)))
    number, run = page.cut(page.state()["rev"])
    assert run["state"] == "done"
    (small_disk / "plate.nodrift.3b").write_bytes(b"old")
    filler = small_disk / "filler"
    with pytest.raises(OSError), filler.open("wb", buffering=0) as file:
        while True:
            file.write(bytes(4096))
    body = {"run": number, "what": ["tape", "program", "job", "sheet"], "overwrite": True}
    answer = page.call("POST", "/api/save", body)
    assert answer.status == 400 and says(answer.message, Phrase("system-full"))
    assert (small_disk / "plate.nodrift.3b").read_bytes() == b"old"
    assert {path.name for path in small_disk.iterdir()} == {"filler", "plate.dxf", "plate.nodrift.3b"}
    filler.unlink()
    assert len(page.done("POST", "/api/save", body)["written"]) == 4


def test_folder_that_takes_nothing(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    folder = tmp_path / "away"
    folder.mkdir()
    page = Page(serve(plate(folder)))
    number, _ = page.cut(page.state()["rev"])
    folder.rename(tmp_path / "elsewhere")
    answer = page.call("POST", "/api/save", {"run": number, "what": ["tape"], "overwrite": True})
    assert answer.status == 400 and "plate.nodrift.3b" in answer.message
    assert not folder.exists()


def entities(*some: str, blocks: str = "") -> bytes:
    """A DXF file."""
    head = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n"
    blocks = f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n"
    return f"{head}{blocks}0\nSECTION\n2\nENTITIES\n{''.join(some)}0\nENDSEC\n0\nEOF\n".encode()


CIRCLE = "0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n3\n"


def block(name: str, inside: str) -> str:
    return f"0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n3\n{name}\n{inside}0\nENDBLK\n8\n0\n"


def insert(name: str, x: float = 0, more: str = "") -> str:
    return f"0\nINSERT\n8\n0\n2\n{name}\n10\n{x}\n20\n0\n{more}"


def nested(levels: int) -> bytes:
    """A block of ten of a block of ten …"""
    blocks = [block("B0", CIRCLE)]
    blocks += [block(f"B{k}", "".join(insert(f"B{k - 1}", x * 10**k) for x in range(10))) for k in range(1, levels)]
    return entities(insert(f"B{levels - 1}"), blocks="".join(blocks))


SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9">'
HOSTILE = {
    "grid.dxf": entities(insert("A", more="70\n32767\n71\n32767\n44\n9\n45\n9\n"), blocks=block("A", CIRCLE)),
    "nested.dxf": nested(12),
    "itself.dxf": entities(insert("A"), blocks=block("A", CIRCLE + insert("A", 1))),
    "count.dxf": entities("0\nLWPOLYLINE\n8\n0\n90\n2147483647\n70\n1\n10\n0\n20\n0\n10\n5\n20\n0\n10\n5\n20\n5\n"),
    "digits.dxf": entities(f"0\nLWPOLYLINE\n8\n0\n70\n{'9' * 100_000}\n10\n0\n20\n0\n"),
    "far.dxf": entities("0\nCIRCLE\n8\n0\n10\n1e300\n20\n0\n40\n1e300\n"),
    "zeros.dxf": bytes(4 << 20),
    "entities.svg": b'<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">'
    + b"".join(b'<!ENTITY %c "%s">' % (98 + k, b"&%c;" % (97 + k) * 10) for k in range(10))
    + f"]>{SVG}<text>&k;</text></svg>".encode(),
    "use.svg": (
        f'{SVG}<defs><g id="g0"><circle r="3"/></g>'
        + "".join(f'<g id="g{k}">' + 10 * f'<use href="#g{k - 1}"/>' + "</g>" for k in range(1, 11))
        + '</defs><use href="#g10"/></svg>'
    ).encode(),
}


#: Those that only the limit of time ends.
ENDLESS = ("nested.dxf", "use.svg")


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_drawing(server: Server, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """It is refused in one line, by its content or by the limits, or is a small drawing; then all is as before."""
    if name in ENDLESS:
        monkeypatch.setattr(worker, "SECONDS", 2.0)
    page = Page(server)
    state = page.done("POST", "/api/open", HOSTILE[name], X_Name=quote(name))
    if state.get("error"):
        assert english(state["error"]) and "\n" not in english(state["error"]) and not state["contours"]
    else:
        assert name in ("itself.dxf", "count.dxf") and len(state["contours"]) == 1
    monkeypatch.undo()
    assert page.done("POST", "/api/open", entities(CIRCLE), X_Name="circle.dxf")["contours"]


def test_time_is_limited(server: Server, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = Page(server)
    page.open(plate(tmp_path))
    monkeypatch.setattr(worker, "SECONDS", 0.05)
    state = page.open(circles(tmp_path, 3000))
    assert state["error"]["code"] == "page-too-long"
    monkeypatch.undo()
    assert len(page.open(plate(tmp_path))["contours"]) == 3


def test_memory_is_limited(server: Server, tmp_path: Path) -> None:
    """The process has the limit of the system, and what is refused for it is told in a line."""
    resource = pytest.importorskip("resource")
    page = Page(server)
    page.open(plate(tmp_path))
    assert resource.prlimit(process_of(server), resource.RLIMIT_AS)[0] == worker.MEMORY
    used = int(Path(f"/proc/{process_of(server)}/statm").read_text().split()[0]) * resource.getpagesize()
    resource.prlimit(process_of(server), resource.RLIMIT_AS, (used + (8 << 20), worker.MEMORY))
    state = page.open(circles(tmp_path, 8000))
    assert state["error"]["code"] in ("no-memory", "process-ended")
    assert len(page.open(plate(tmp_path))["contours"]) == 3


def _heed_interrupts() -> None:
    """Heed ctrl-C in a process whose parent, a shell in the background, does not."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.fixture
def begin() -> Callable[..., tuple[subprocess.Popen[str], str]]:
    """Begin `skg ui` as a shell does: the process, and the address that it prints."""
    processes = []

    def call(*words: object) -> tuple[subprocess.Popen[str], str]:
        process = subprocess.Popen(
            [SKG, "ui", "--no-browser", *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            start_new_session=True, preexec_fn=_heed_interrupts,
        )  # fmt: skip
        processes.append(process)
        return process, process.stdout.readline().strip()

    yield call
    for process in processes:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


class Shell(Page):
    """A page at an address."""

    def __init__(self, url: str) -> None:
        self.host, self.token = re.fullmatch(r"http://(127\.0\.0\.1:\d+)/#token=([\w-]{32})", url).groups()


def workers_of(pid: int) -> list[int]:
    """The processes that another one began."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            if int(stat.read_text().rpartition(")")[2].split()[1]) == pid:
                found.append(int(stat.parent.name))
    return found


def test_command(begin: Callable, tmp_path: Path) -> None:
    """The drawing is there; ctrl-C, which goes to all processes of the terminal, ends it without a word."""
    process, url = begin(plate(tmp_path))
    page = Shell(url)
    state = page.state()
    assert page.cut(state["rev"])[1]["state"] == "done"
    children = workers_of(process.pid)
    assert children
    os.killpg(process.pid, signal.SIGINT)
    assert process.wait() == 0
    assert process.stderr.read() == "" and process.stdout.read().strip() == ""
    until(lambda: not any(is_running(pid) for pid in children))


def test_command_that_is_killed(begin: Callable, tmp_path: Path) -> None:
    """The process behind it ends with it."""
    process, url = begin(plate(tmp_path))
    Shell(url).state()
    children = workers_of(process.pid)
    assert children
    process.kill()
    until(lambda: not any(is_running(pid) for pid in children))


def test_command_ends_with_its_input(tmp_path: Path) -> None:
    """What was set and not saved is in a job file beside the drawing, over none that is there."""
    path, mine = plate(tmp_path), tmp_path / "plate.unsaved.job.toml"
    mine.write_text("mine")
    words = [SKG, "ui", "--no-browser", "--until-eof", str(path)]
    process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    page = Shell(process.stdout.readline().strip())
    page.put(page.state(), machine={"wire": 0.2})
    _, said = process.communicate()
    assert process.returncode == 0 and "plate.unsaved-2.job.toml" in said
    assert mine.read_text() == "mine" and "wire = 0.2" in (tmp_path / "plate.unsaved-2.job.toml").read_text()


def is_running(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize(
    ("words", "fact"),
    [(["nothing.dxf"], "nothing.dxf"), (["."], "."), (["bad.job.toml"], "bad.job.toml"), (["--port", "70000"], "70000"),
     (["lost.job.toml"], "gone.dxf")],
)  # fmt: skip
def test_command_refuses(tmp_path: Path, words: list[str], fact: str) -> None:
    (tmp_path / "bad.job.toml").write_text("tab = 1")
    (tmp_path / "lost.job.toml").write_text('schema = 1\ndrawing = "gone.dxf"')
    done = subprocess.run([SKG, "ui", *words], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.count("\n") == 1 and fact in done.stderr and "Traceback" not in done.stderr


def test_port_that_is_taken(begin: Callable, tmp_path: Path) -> None:
    _, url = begin()
    port = re.search(r":(\d+)/", url)[1]
    done = subprocess.run([SKG, "ui", "--no-browser", "--port", port], capture_output=True, text=True)
    assert done.returncode == 2 and says(done.stderr, Phrase("port-failed", port=port)) and done.stderr.count("\n") == 1


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="the browser is not given its address as a word there")
def test_browser_is_opened(tmp_path: Path) -> None:
    """With a file that leads to the page: nobody else can read it, its name tells nothing, and it goes when the page is
    there."""
    program, home = tmp_path / "browser", tmp_path / "home"
    home.mkdir()
    program.write_text(f'#!/bin/sh\necho "$1" > {tmp_path}/new && mv {tmp_path}/new {tmp_path}/address\n')
    program.chmod(0o755)
    left = home / "skg-ui-abcdefgh.html"
    left.touch()
    os.utime(left, (0, 0))
    process = subprocess.Popen(
        [SKG, "ui"],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"BROWSER": str(program), "HOME": str(home)},
        preexec_fn=_heed_interrupts,
    )
    page = Shell(process.stdout.readline().strip())
    until((tmp_path / "address").exists)
    address = (tmp_path / "address").read_text().strip()
    assert page.token not in address and address.startswith("file://")
    (path,) = home.iterdir()
    assert path.as_uri() == address and path.stat().st_mode & 0o777 == 0o600
    assert f'url=http://{page.host}/#token={page.token}"' in path.read_text()
    page.done("GET", "/api/state")
    until(lambda: not path.exists())
    process.send_signal(signal.SIGINT)
    assert process.wait() == 0
    process.stdout.close()


def test_two_pages_share_one_drawing(server: Server, tmp_path: Path) -> None:
    one, other = Page(server), Page(server)
    state = one.open(plate(tmp_path))
    news: list[Json] = []
    asking = Thread(target=lambda: news.append(other.done("GET", f"/api/state?after={state['rev']}")))
    asking.start()
    one.put(state, machine={"offset": 0.1})
    asking.join()
    assert news[0]["job"]["machine"] == {"offset": 0.1}
