"""Files that commands write: never onto what they read, whole or not at all, whatever ends them or fills the disk."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from toolhelp import CAD_TAPE, Run

from skg.errors import UserError
from skg.files import binary_output, is_same_file, write_bytes

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
#: Commands that write a file, each to {out}.
WRITING = {
    "cut": ["cut", ROOT / "docs/pictures/bracket.dxf", "--wire", "0.2", "-o", "{out}"],
    "run": ["run", EXAMPLES / "die.skg", "-o", "{out}"],
    "ref": ["ref", EXAMPLES / "die.skg", "-o", "{out}"],
    "xy": ["xy", EXAMPLES / "xy-book-2-hexagon.xy", "-o", "{out}"],
    "tekhtran": ["tekhtran", EXAMPLES / "tkh-cam.tkh", "-o", "{out}"],
    "gear": ["gear", "--module", "2", "--teeth", "20", "-o", "{out}"],
    "cam": ["cam", "--base", "20", "--lift", "8", "--rise", "120", "--dwell", "60", "--fall", "120", "-o", "{out}"],
    "gcode": ["gcode", EXAMPLES / "die.3b", "-o", "{out}"],
    "tape": ["tape", EXAMPLES / "die.3b", "-o", "{out}"],
    "dxf": ["dxf", EXAMPLES / "die.3b", "-o", "{out}"],
    "plot": ["plot", EXAMPLES / "die.3b", "-o", "{out}"],
    "sim": ["sim", EXAMPLES / "die.3b", "--steps", "{out}"],
}
#: The process ends here as if the current went: all is written, and has not been given its name yet.
KILLED = (
    "import os, signal; os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL); from skg.cli import main; main()"
)


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


@pytest.mark.parametrize("command", WRITING)
def test_killed_in_the_middle(command: str, tmp_path: Path) -> None:
    """What was there is there still."""
    out = tmp_path / "out.svg"
    out.write_bytes(b"old")
    words = [str(word).format(out=out) for word in WRITING[command]]
    done = subprocess.run([sys.executable, "-c", KILLED, *words], capture_output=True)
    assert done.returncode == -9 and out.read_bytes() == b"old", done.stderr


def test_what_a_killed_run_has_left_goes(tmp_path: Path) -> None:
    """With the next run, when it is at rest and nobody writes it any more; what has another name stays."""
    out, mine, fresh = (
        tmp_path / "out.3b",
        tmp_path / ".skg-settings",
        tmp_path / ".skg-abcdefgh.part",
    )
    mine.write_text("mine")
    subprocess.run(
        [sys.executable, "-c", KILLED, "run", EXAMPLES / "die.skg", "-o", out],
        capture_output=True,
    )
    (left,) = names(tmp_path) - {mine.name}
    for path in (tmp_path / left, mine):
        os.utime(path, (0, 0))
    fresh.touch()
    with binary_output(str(tmp_path / "another")) as stream:
        stream.write(b"1")
        (writing,) = names(tmp_path) - {mine.name, fresh.name, left}
        os.utime(tmp_path / writing, (0, 0))
        write_bytes(str(out), b"2")
        assert names(tmp_path) == {mine.name, fresh.name, writing, "out.3b"}
    assert names(tmp_path) == {mine.name, fresh.name, "another", "out.3b"}


@pytest.fixture
def full_disk(tmp_path: Path) -> Iterator[tuple[Path, Callable[[], None]]]:
    """A disk of 64 KiB, and what fills it."""
    folder = tmp_path / "disk"
    folder.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", folder], capture_output=True).returncode:
        pytest.skip("no file system may be mounted")

    def fill() -> None:
        with suppress(OSError), (folder / "filler").open("wb", buffering=0) as file:
            while True:
                file.write(bytes(4096))

    yield folder, fill
    subprocess.run(["umount", "-l", folder], check=True)


@pytest.mark.parametrize("links", [1, 2])
def test_full_disk(full_disk: tuple[Path, Callable], run: Run, links: int) -> None:
    """An old file is as it was, one that is written where it is, too; and there is no other."""
    folder, fill = full_disk
    tape = folder / "tape.3b"
    tape.write_bytes(old := b"old" * 100)
    if links > 1:
        (folder / "second.3b").hardlink_to(tape)
    fill()
    before = names(folder)
    with pytest.raises(OSError) as failed:
        run("run", EXAMPLES / "fit-gear.skg", "-o", tape)
    assert failed.value.filename == str(tape)
    assert tape.read_bytes() == old and names(folder) == before
    (folder / "filler").unlink()
    assert run("run", EXAMPLES / "fit-gear.skg", "-o", tape).exit_code == 0
    assert tape.read_bytes() == (EXAMPLES / "fit-gear.3b").read_bytes() and tape.stat().st_nlink == links


def test_several_names_stay_one_file(tmp_path: Path) -> None:
    """A link of either kind is followed, a file that is shorter than the old one ends where it ends."""
    one, hard, soft = (tmp_path / name for name in ("one", "hard", "soft"))
    one.write_bytes(b"long and old")
    hard.hardlink_to(one)
    soft.symlink_to(one)
    for data, name in ((b"new", one), (b"newer", soft), (b"x", hard)):
        write_bytes(str(name), data)
        assert one.read_bytes() == hard.read_bytes() == data and soft.is_symlink()


def test_same_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one, hard, soft, lost, new = (tmp_path / name for name in ("one", "hard", "soft", "lost", "new"))
    one.touch()
    hard.hardlink_to(one)
    soft.symlink_to(one)
    lost.symlink_to(new)
    for name, is_same in (
        (one, True),
        (hard, True),
        (soft, True),
        (lost, False),
        (new, False),
        ("-", False),
    ):
        assert is_same_file(str(one), str(name)) == is_same
    assert is_same_file(str(lost), str(new)) and is_same_file(str(new), f"{tmp_path}/./new")
    assert not is_same_file("-", "-") and not is_same_file(str(new), str(tmp_path / "NEW"))
    monkeypatch.setattr(sys, "platform", "darwin")
    assert is_same_file(str(new), str(tmp_path / "NEW"))


@pytest.mark.parametrize(
    "words",
    [
        ["cut", "in.dxf", "-o", "link"],
        ["cut", "in.dxf", "-o", "x.3b", "--program", "link"],
        ["cut", "in.dxf", "-o", "x.3b", "--program", "./x.3b"],
        ["cut", "part.job.toml", "-o", "link"],
        ["cut", "in.dxf", "-o", "machine.toml", "--machine", "machine.toml"],
        ["sim", "in.3b", "--steps", "link"],
        ["gcode", "in.3b", "-o", "link"],
        ["run", "in.skg", "-o", "x.3b", "--input", "./x.3b"],
        ["plot", "in.3b", "-o", "link", "--format", "svg"],
    ],
)
def test_never_onto_what_is_read(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str]) -> None:
    """By another name of it neither: nothing is written at all."""
    monkeypatch.chdir(tmp_path)
    Path("in.dxf").write_bytes((ROOT / "docs/pictures/bracket.dxf").read_bytes())
    Path("in.3b").write_bytes(CAD_TAPE)
    Path("in.skg").write_text("10 END\n")
    Path("part.job.toml").write_text('schema = 1\ndrawing = "in.dxf"\n')
    Path("machine.toml").write_bytes((ROOT / "tools/skg/dialects/linuxcnc-wire.toml").read_bytes())
    if "--input" in words:
        Path("x.3b").write_text("1\n")
    source = "in.dxf" if words[1] == "part.job.toml" else words[1]
    Path("link").hardlink_to(source)
    before = {path: path.read_bytes() for path in Path().iterdir()}
    with pytest.raises(UserError) as refused:
        run(*words)
    assert refused.value.finding.code == "written-twice"
    assert {path: path.read_bytes() for path in Path().iterdir()} == before
