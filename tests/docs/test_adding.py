"""The steps of docs/firmware.md to add a statement and a board work, in a copy of asm/."""

from __future__ import annotations

import ast
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from skg import Board
from skg.ref.interpreter import run

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "firmware.md"
#: Indented lines behind an empty one: what is to be typed.
BLOCK = re.compile(r"(?:^ {8}.*\n|^\n+(?= {8}))+", re.M)


def blocks(heading: str, until: str) -> list[str]:
    """The code blocks between two places of the page."""
    text = PAGE.read_text()
    begin = text.index(heading)
    found = BLOCK.findall(text[begin : text.index(until, begin)])
    return [textwrap.dedent(block).strip("\n") + "\n" for block in found]


def replaced(path: Path, old: str, new: str) -> None:
    """Put something else into a source, at the one place where it says so."""
    text = path.read_text()
    assert text.count(old) == 1, (path.name, old)
    path.write_text(text.replace(old, new))


def source(name: str, text: str, room: int) -> str:
    """A source file, with a header whose lists are still to be written."""
    return f"; {name}.asm - from the page\n; Offers: nothing\n; Uses:   nothing\n; Room:   {room} bytes\n\n{text}"


@pytest.fixture
def asm(tmp_path: Path) -> Path:
    """A copy of asm/, with its assembler; of a tree in which nobody follows the page."""
    if re.search(r'"skg-(rot|mine)":', (ROOT / "asm" / "images.py").read_text()):
        pytest.skip("asm/ has the page's own image")
    copy = tmp_path / "asm"
    shutil.copytree(ROOT / "asm", copy, ignore=shutil.ignore_patterns("node_modules", "__pycache__"))
    (copy / "node_modules").symlink_to(ROOT / "asm" / "node_modules")
    return copy


def tool(asm: Path, *arguments: str) -> str:
    """Run a program of the copy's."""
    done = subprocess.run([sys.executable, *arguments], cwd=asm, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def image(asm: Path, name: str) -> bytes:
    """The image, built in the copy."""
    tool(asm, "build.py", "--image", name, name)
    return (asm / name).with_suffix(".bin").read_bytes()


def test_a_statement(asm: Path) -> None:
    """ROT, an image of its own; the standard one stays as it is."""
    word, statement, none, placed, hook, row, grammar, reference, test = blocks(
        "## Adding a statement", "6. **For everybody**"
    )
    images = asm / "images.py"
    scale = next(line for line in (asm / "words.txt").read_text().splitlines() if " SCALE " in line) + "\n"
    replaced(asm / "words.txt", scale, scale + word)
    field = re.search(r"`(turn: .*?)`, named in `files\(\)` and `SEAMS`", PAGE.read_text())
    assert field
    replaced(images, "    more: tuple", f"    {field[1]}\n    more: tuple")
    replaced(images, "*self.spans, ", "*self.spans, *self.turn, ")
    replaced(images, '"spans", "more")', '"spans", "turn", "more")')
    replaced(images, "IMAGES = {\n", f"IMAGES = {{\n    {row}")
    replaced(asm / "rooms.py", "HOOKS = {\n", f"HOOKS = {{\n    {hook}")
    replaced(asm / "cut.asm", "        CALL    SCALED\n; ITEMT", "        CALL    PLACED\n; ITEMT")
    replaced(asm / "ends.asm", "CALL    SCALED", "CALL    PLACED")
    replaced(asm / "run.asm", "CALL    RUNINI", "CALL    RUNBEG")
    variants = asm / "variants"
    (variants / "rot.asm").write_text(source("rot", statement + "\n" + placed, 60))
    (variants / "norot.asm").write_text(source("norot", none, 0))
    tool(asm, "rooms.py", "--headers")
    assert "; Offers: SROT PLACED RUNBEG\n" in (variants / "rot.asm").read_text()
    tangled = (
        "import build, rooms; print([rooms.tangled(rooms.every()[name]) for name in ('skg', 'skg-rot', 'skg-mill')])"
    )
    assert tool(asm, "-c", tangled) == "[[], [], []]\n"
    rom = image(asm, "skg-rot")
    assert image(asm, "skg") == (ROOT / "roms" / "skg.bin").read_bytes()

    board = Board(rom)
    assert board.load("10 ROT 30\n20 FROM (9,1)\n30 CUT (0,0),(10,0),2,(10,8)\n40 END\n") == []
    board.run()
    turned = "10 FROM (9,1)#30\n20 CUT (0,0)#30,(10,0)#30,2,(10,8)#30\n30 END\n"
    assert board.tape == run(turned).tape
    assert board.type("CUT (0,0)") == []
    assert board.type("ROT 5")[-1] == "ERR 06"

    # The reference and the test that holds the ROM beside it, in a copy of the tools.
    top = asm.parent
    shutil.copytree(ROOT / "tools" / "skg", top / "tools" / "skg", ignore=shutil.ignore_patterns("__pycache__"))
    (top / "build").symlink_to(ROOT / "build")
    (top / "tools" / "skg" / "ref" / "rot.lark").write_text(grammar)
    (top / "tools" / "skg" / "ref" / "rot.py").write_text(reference)
    (top / "tests").mkdir()
    shutil.copy(ROOT / "tests" / "rom" / "romhelp.py", top / "tests")
    (top / "tests" / "test_rot.py").write_text(test)
    style = ("ruff", "check", "-q", "--config", str(ROOT / "tools" / "pyproject.toml"))
    tool(top, "-m", *style, "tools/skg/ref/rot.py", "tests/test_rot.py")
    shutil.copytree(ROOT / "roms", top / "roms")
    (top / "roms" / "skg-rot.bin").write_bytes(rom)
    places = {"PYTHONPATH": str(top / "tools"), "SKG_ROM": str(top / "roms" / "skg.bin")}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_rot.py"]
    done = subprocess.run(command, cwd=top, env=os.environ | places, capture_output=True, text=True)
    assert done.returncode == 0 and "3 passed" in done.stdout, done.stdout + done.stderr
    # (a reference that forgets the turn of CUT is told from the ROM)
    replaced(
        top / "tools" / "skg" / "ref" / "rot.py", "element(turned(value, self.angle)", "element(turned(value, ZERO)"
    )
    done = subprocess.run(command, cwd=top, env=os.environ | places, capture_output=True, text=True)
    assert "2 failed, 1 passed" in done.stdout, done.stdout


def test_a_board(asm: Path) -> None:
    """6850s at other ports: no other header changes, and the image runs where the page says."""
    ports, rows, command = blocks("For a board of your own", "4. To give it to others")
    row, known, option = rows.split("\n\n")
    before = {path: path.read_text() for path in asm.rglob("*.asm")}
    (asm / "boards" / "ports_mine.asm").write_text(ports)
    replaced(asm / "images.py", "IMAGES = {\n", f"IMAGES = {{\n    {row}")
    tool(asm, "rooms.py", "--headers")
    rom = image(asm, "skg-mine")
    assert [path for path, text in before.items() if path.read_text() != text] == []
    program, *arguments = command.split()
    option = ast.literal_eval(f"{{{option}}}")["skg-mine"]
    assert arguments[:3] == [*option, "--rom"]
    part = ROOT / arguments[-1]
    done = subprocess.run([ROOT / program, *option, "--rom", asm / "skg-mine.bin", part], capture_output=True)
    assert done.stdout == part.with_suffix(".3b").read_bytes()
    board = Board(rom, **ast.literal_eval(f"{{{known}}}")["skg-mine"])
    board.load(part.read_text())
    board.run()
    assert board.tape == done.stdout
