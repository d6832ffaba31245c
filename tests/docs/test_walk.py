"""The debugger's sessions in docs/firmware.md are true; run as a program, this updates them.

A fence ```part holds a part, the fences ```debug after it one session with `skg80 --debug`: commands behind `debug> `
and what comes of them. Cycles, addresses and the bytes that are free change with every byte of the firmware: they are
not compared.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "firmware.md"
SKG80 = ROOT / "build" / "skg80"
FENCE = re.compile(r"^```(?P<kind>part|debug)\n(?P<body>(?:(?!```).*\n)*)```$", re.M)
PROMPT = "debug> "
#: What the firmware's bytes decide: cycles in front of an instruction, addresses, the processor's registers.
PLACES = re.compile(r"^\d+ (?=[0-9A-F]{4} )|\b[0-9A-F]{4}\b|(?<=SKG )\d+|(?<=[AF]=)\S+", re.M)


def session(part: str, commands: list[str]) -> list[str]:
    """The answer to each command, without its echo; the first one is the text before any command."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "one.skg"
        path.write_text(part)
        done = subprocess.run([SKG80, "--debug", path], input="\n".join([*commands, ""]),
                              capture_output=True, text=True)  # fmt: skip
    text = done.stderr.replace("\r\n", "\n").replace("\r", "")
    answers = []
    for command in commands:
        said, echo, text = text.partition(f"{PROMPT}{command}\n")
        assert echo, f"{command} was never asked for: {said}"
        answers.append(said)
    return [*answers, text.partition(PROMPT)[0]]


def sessions(page: str) -> list[tuple[str, list[str]]]:
    """Each part, and the bodies of its session's fences."""
    found: list[tuple[str, list[str]]] = []
    for match in FENCE.finditer(page):
        if match["kind"] == "part":
            found.append((match["body"], []))
        else:
            found[-1][1].append(match["body"])
    return found


def commands(body: str) -> list[str]:
    """The commands of a fence, as it is shown or as it was first written: commands alone."""
    lines = body.splitlines()
    shown = [line.removeprefix(PROMPT) for line in lines if line.startswith(PROMPT)]
    return shown or lines


def written_anew(page: str) -> str:
    """The page with what the debugger says today."""
    texts = []
    for part, bodies in sessions(page):
        asked = [commands(body) for body in bodies]
        answers = session(part, [command for each in asked for command in each])[1:]
        for each in asked:
            said = [f"{PROMPT}{command}\n{answers.pop(0)}" for command in each]
            texts.append("".join(said).rstrip("\n") + "\n")
    return FENCE.sub(lambda match: f"```debug\n{texts.pop(0)}```" if match["kind"] == "debug" else match[0], page)


@pytest.fixture(scope="module", autouse=True)
def built(build) -> None:  # noqa: ANN001
    """The emulator."""
    build("emu")


def test_the_walk_is_what_the_debugger_says() -> None:
    page = PAGE.read_text()
    first, walk = [bodies for _, bodies in sessions(page)]
    assert len([command for body in first for command in commands(body)]) > 5
    assert len([command for body in walk for command in commands(body)]) > 30
    assert all(body.startswith(PROMPT) for body in first + walk)
    shown, true = (PLACES.sub("...", text) for text in (page, written_anew(page)))
    assert shown == true, "python tests/docs/test_walk.py writes the walk anew"


def test_the_walk_ends_in_the_block() -> None:
    """And shows the numbers that the block is made of."""
    _, bodies = sessions(PAGE.read_text())[-1]
    assert "B3000B4000B4000GYL1" in bodies[-1]
    assert re.search(r"M58 BX/DX +3000\nM59 BY/DY +4000\n", bodies[-1])
    assert re.search(r"M30 N0 +0\.8\nM31 N1 +-0\.6\n", "".join(bodies))


if __name__ == "__main__":
    PAGE.write_text(written_anew(PAGE.read_text()))
