"""Foreign names: files, layers, blocks, labels that try to colour, move or forge what a person reads."""

from __future__ import annotations

import json
import unicodedata
from collections.abc import Callable
from pathlib import Path
from subprocess import CompletedProcess

import ezdxf
import pytest
from ezdxf import units
from toolhelp import CAD_TAPE

from skg.wording import visible

#: Black on black, the same in one byte, a line deleted, a line begun, a text turned round, a bell, nothing.
HOSTILE = "a\x1b[30;40m\x9b2K\x08\x7f\u202eb\u2066\x07\u2028\u200b"


def obeyed(text: str) -> list[str]:
    """The characters that a terminal or a browser obeys, but for ends of lines."""
    return [character for character in text if unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp", "Cs", "Co")
            and character != "\n"]  # fmt: skip


def drawing(folder: Path, name: str = "part.dxf") -> Path:
    """A DXF file with hostile layers, a hostile block, and things that are told of: an open line, a text, a gap."""
    page = ezdxf.new()
    page.units = units.MM
    space = page.modelspace()
    space.add_lwpolyline([(0, 0), (60, 0), (60, 30), (0, 30)], close=True, dxfattribs={"layer": "PARTX"})
    space.add_circle((15, 15), 6, dxfattribs={"layer": "PARTX"})
    space.add_line((5, 50), (25, 50), dxfattribs={"layer": "PARTX"})
    space.add_text("note", dxfattribs={"layer": "NOTEX"})
    block = page.blocks.new("BLOCKX")
    block.add_circle((0, 0), 4, dxfattribs={"layer": "PARTX"})
    space.add_blockref("BLOCKX", (45, 15), dxfattribs={"layer": "PARTX", "xscale": 2, "yscale": 1})
    plain = folder / "plain.dxf"
    page.saveas(plain)
    path = folder / name
    path.write_bytes(plain.read_bytes().replace(b"X\n", HOSTILE.replace("\u2028", "").encode() + b"\n"))
    plain.unlink()
    return path


def label(folder: Path, name: str = "part.svg") -> Path:
    """An SVG file with a hostile label of a layer, and a rectangle on it."""
    escaped = "".join(f"&#{ord(character)};" for character in HOSTILE if character not in "\x1b\x08\x07")
    path = folder / name
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'width="60mm" height="40mm" viewBox="0 0 60 40"><g inkscape:groupmode="layer" inkscape:label="{escaped}">'
        '<rect x="5" y="5" width="40" height="30"/><path d="M1 1L2 38"/><text x="3" y="3">note</text></g></svg>'
    )
    return path


def test_visible() -> None:
    """All that is obeyed becomes an escape; letters of any script stay; twice is once."""
    assert not obeyed(visible(HOSTILE + "\n")) and visible(visible(HOSTILE)) == visible(HOSTILE)
    assert visible("a\x1b\u202e\n\udcff") == "a\\x1b\\u202e\\n\\xff"
    for name in ("零件 \u3000 5", "Größe Ø\xa03", "деталь", "قطعة", "C:\\parts\\a.dxf"):
        assert visible(name) == name


COMMANDS = [
    ["cut", "{dxf}", "-o", "{out}", "--open", "leave", "--wire", "0.2"],
    ["--lang", "zh", "cut", "{dxf}", "-o", "{out}", "--open", "leave", "--wire", "0.2"],
    ["cut", "{dxf}", "-o", "{out}", "--list-layers"],
    ["cut", "{dxf}", "-o", "{out}", "--wire", "0.2"],
    ["cut", "{dxf}", "-o", "{out}", "--layer", HOSTILE],
    ["cut", "{dxf}", "-o", "{out}", "--start-layer", HOSTILE],
    ["cut", "{dxf}", "-o", "{out}", "--open", "leave", "--wire", "0.2", "--json"],
    ["cut", "{svg}", "-o", "{out}", "--open", "leave", "--wire", "0.2"],
    ["cut", "{svg}", "-o", "{out}", "--list-layers"],
    ["cut", "{svg}", "-o", "{svg}"],
    ["cut", "{job}", "-o", "{out}"],
    ["cut", "{none}", "-o", "{out}"],
    ["cut", "{dxf}", "-o", "{none}/x.3b", "--open", "leave"],
    ["cut", "{dxf}", "{svg}", "-o", "{out}"],
    ["check", "{tape}"],
    ["check", "{dxf}"],
    ["sim", "{tape}"],
    ["sim", "{none}"],
    ["gcode", "{tape}", "-o", "{out}"],
    ["gcode", "{tape}", "-o", "-"],
    ["run", "{bad}", "-o", "{out}"],
    ["run", "{dxf}", "-o", "{out}"],
    ["ref", "{bad}", "-o", "{out}"],
    ["xy", "{bad}", "-o", "{out}"],
    ["tape", "{dxf}", "-o", "{out}"],
    ["dxf", "{tape}", "-o", "{out}"],
    ["ui", "{none}"],
    [HOSTILE],
    ["cut", "--" + HOSTILE],
]


@pytest.mark.parametrize("words", COMMANDS, ids=[f"{at}-{words[0][:5]!a}" for at, words in enumerate(COMMANDS)])
def test_terminal(run_program: Callable[..., CompletedProcess[str]], tmp_path: Path, words: list[str]) -> None:
    """No command lets a name of a file, layer, block, label or option through to the terminal as it stands."""
    files = {kind: tmp_path / f"{HOSTILE}.{kind}" for kind in ("dxf", "svg", "tape", "bad", "none", "out")}
    drawing(tmp_path, files["dxf"].name)
    label(tmp_path, files["svg"].name)
    files["tape"].write_bytes(CAD_TAPE)
    files["bad"] = files["bad"].with_suffix(".skg" if words[0] != "xy" else ".xy")
    files["bad"].write_text("10 A=1/0\n20 END\n")
    files["job"] = tmp_path / f"{HOSTILE}.job.toml"
    told = json.dumps(HOSTILE).replace("\x7f", "\\u007f")
    files["job"].write_text(f'schema = 1\ndrawing = "part.dxf"\n[[layer]]\nname = {told}\n[[layer]]\nname = {told}\n')
    done = run_program(*(word.format(**files) for word in words))
    assert (done.stdout + done.stderr).strip()
    assert not obeyed(done.stdout.replace("\r\n", "\n") + done.stderr)
    # (a program's error has its line, G-code no names)
    assert "\\u202e" in done.stdout + done.stderr or words[0] in ("run", "ref", "gcode", "dxf")


def test_forged_report(run_program: Callable[..., CompletedProcess[str]], tmp_path: Path) -> None:
    """A layer whose name has lines of a report in it adds none."""
    path = label(tmp_path)
    forged = "&#10;checked with the controller's simulation: at most 0.41 µm off the drawing&#10;"
    path.write_text(path.read_text().replace("&#97;", forged))
    done = run_program("cut", path, "-o", tmp_path / "part.3b", "--list-layers")
    assert done.returncode == 0 and len(done.stdout.splitlines()) == 1 and "\\n" in done.stdout


def test_sheet(run_program: Callable[..., CompletedProcess[str]], tmp_path: Path) -> None:
    """The names of drawing and tape on the sheet, and those of tapes on a plot."""
    path = drawing(tmp_path, f"{HOSTILE}.dxf")
    tape, sheet, plot = (tmp_path / f"{HOSTILE}.{ending}" for ending in ("3b", "sheet.svg", "plot.svg"))
    words = ("--open", "leave", "--wire", "0.2", "--material", "steel", "--sheet", sheet)
    assert run_program("cut", path, "-o", tape, *words).returncode == 0
    assert run_program("plot", tape, tape, "-o", plot).returncode == 0
    for picture in (sheet, plot):
        text = picture.read_text("utf-8")
        assert "\\x1b" in text and not obeyed(text)
