"""The milling chapter of docs/manual.md: each program's tape is the one printed, by the reference and by the ROM.

A fence ```mill holds a program, ```iso behind it the tape. Run as a program, this writes the tapes anew. A fence
```handshake is a session with the ROM that waits for a machine: what is typed stands behind the prompt, and the machine
answers as GRBL does.
"""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from playedhelp import OK, Played

from skg.ref import mill

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "manual.md"
ROM = ROOT / "roms" / "skg-mill.bin"
SKG80 = ROOT / "build" / "skg80"

FENCE = re.compile(r"^```mill\n(?P<program>(?:(?!```).*\n)*)```\n\n```iso\n(?P<tape>(?:(?!```).*\n)*)```$", re.M)
SESSION = re.compile(r"^```handshake\n((?:(?!```).*\n)*)```$", re.M)
EXAMPLES = list(FENCE.finditer(PAGE.read_text()))

examples = pytest.mark.parametrize("example", EXAMPLES, ids=lambda match: match["program"].split("\n")[0])


def tape_of(program: str) -> str:
    """The reference's tape of a program that must not fail."""
    result = mill.run(program)
    assert (result.error, result.paper) == (None, "")
    return result.tape.decode("ascii").replace("\r\n", "\n")


def test_every_statement_has_an_example() -> None:
    used = {word for example in EXAMPLES for word in re.findall(r"^\d+ ([A-Z]+)", example["program"], re.M)}
    assert used >= {"F", "Z", "M", "G", "HOLE", "RECUT", "FROM", "CUT", "BACK"}
    table = PAGE.read_text().split("## 14. Milling")[1].split("## Appendix A")[0]
    assert set(re.findall(r"^\| `([A-Z]+)", table, re.M)) == {"F", "Z", "M", "G", "HOLE"}


@examples
def test_example(example: re.Match[str]) -> None:
    assert tape_of(example["program"]) == example["tape"]


@pytest.mark.skipif(not ROM.exists(), reason="there is no roms/skg-mill.bin")
@examples
def test_example_on_the_board(example: re.Match[str], tmp_path: Path) -> None:
    part = tmp_path / "part.skg"
    part.write_text(example["program"])
    done = subprocess.run([SKG80, "--rom", ROM, part], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.decode().replace("\r\n", "\n") == example["tape"]


def grbl(block: str, _number: int) -> bytes:
    """GRBL's answer to a block: it has no tool changer."""
    return b"error:20\r\n" if "M6" in block else OK


def test_handshake() -> None:
    session = SESSION.findall(PAGE.read_text())
    assert session and all("error:" in text and "M30" in text for text in session)
    for text in session:
        board, paper = Played(), ""
        for line in re.findall(r"^>(.*)$", text, re.M):
            board.clear()
            paper += "".join(f"{said}\n" for said in [f">{line}", *board.driven(line, grbl)])
        assert paper == text


if __name__ == "__main__":
    PAGE.write_text(
        FENCE.sub(lambda m: f"```mill\n{m['program']}```\n\n```iso\n{tape_of(m['program'])}```", PAGE.read_text())
    )
