"""`skg sim --steps`: every step of the port, against a plain controller."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from facthelp import each_says, says
from follower import CUTTING, X_MINUS, X_STEP, Y_MINUS, Y_STEP, follow, random_tape
from oneblock import run_block

from skg.cli import cli
from skg.tape.block import Block, Stop, Tape
from skg.tape.controller import drive_steps
from skg.tape.text import read

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.3b"))


def sim(*arguments: str | Path, stdin: str = "") -> Result:
    """Run `skg sim`."""
    result = CliRunner(mix_stderr=False).invoke(cli, ["sim", *map(str, arguments)], input=stdin)
    assert result.exit_code == 0, result.exception
    return result


def test_random_tapes(tmp_path: Path) -> None:
    """All kinds, quadrants and axes, thousands of steps: the same bytes."""
    kinds, steps = set(), 0
    for seed in range(30):
        text = random_tape(seed)
        port = b"".join(drive_steps(Tape.of("", map(item, text.split()[:-1]))))
        assert port == follow(text), text
        kinds |= {line.split("G")[1] for line in text.split() if line[0] == "B"}
        steps += len(port)
    assert len(kinds) == 24
    assert steps > 100_000


def item(line: str) -> Block | Stop:
    """A line of a tape, sound or not."""
    if line == "D":
        return Stop(0)
    x, y, j, code = line[1:].replace("G", "B").split("B")
    return Block(int(x), int(y), int(j), code[0], code[1:])


def test_examples() -> None:
    """As many steps as the controller takes, and in all of them the places that it comes to."""
    assert len(EXAMPLES) > 20
    for path in EXAMPLES:
        tape = read(str(path))
        port, outcomes = b"".join(drive_steps(tape)), [run_block(block) for block in tape.blocks]
        assert len(port) == sum(outcome.steps for outcome in outcomes)
        count = {value: port.count(value) for value in set(port)}
        for at, (step, minus) in enumerate(((X_STEP, X_MINUS), (Y_STEP, Y_MINUS))):
            way = sum(count[v] * (-1 if v & minus else 1) for v in count if v & step)
            assert way == sum(outcome.move[at] for outcome in outcomes)


def test_an_example_to_its_end() -> None:
    """The wrench, step by step; the report stands on the standard output where a file takes the steps."""
    tape = ROOT / "examples" / "wrench.3b"
    assert sim(tape, "--steps", "-").stdout_bytes == follow(tape.read_text())


def test_report_beside_a_file(tmp_path: Path) -> None:
    """The figures are those without --steps; several tapes follow one another, each cut from its start."""
    (tmp_path / "a.3b").write_text("B3B1B3GXL1\r\nD\r\nD\r\nDD\r\n")
    (tmp_path / "b.3b").write_text("B0B2B2GYL4\r\nD\r\nB2B0B2GXL3\r\nD\r\nDD\r\n")
    both = tmp_path / "a.3b", tmp_path / "b.3b"
    done = sim(*both, "--steps", tmp_path / "steps")
    assert done.stdout == sim(*both).stdout
    assert (tmp_path / "steps").read_bytes() == bytes((0x81, 0x84, 0x81, 0x81, 0x8C, 0x8C, 0x0B, 0x0B))


@pytest.mark.parametrize(
    "lines",
    [
        "B9B0B9GXL1 D B0B9B9GYL2 D B9B0B9GXL3",
        "B9B0B9GXL1 D D B9B0B9GXL3",
        "B9B0B9GXL1 B0B9B9GYL2 D",
        # (the way home, at last)
        "B9B0B9GXL1 B0B9B9GYL2 D B9B0B9GXL3",
    ],
)
def test_stops_around_moves(tmp_path: Path, lines: str) -> None:
    """Bit 7 turns over at each stop, and is off where the tape moves."""
    text = "\r\n".join([*lines.split(), "DD", ""])
    done = sim("-", "--steps", tmp_path / "steps", stdin=text)
    assert done.stderr == ""
    port = (tmp_path / "steps").read_bytes()
    assert port == follow(text)
    assert port[0] & CUTTING


@pytest.mark.parametrize(
    ("lines", "stops", "block"),
    [
        ("B9B0B9GXL1 D B9B0B9GXL3 B0B9B9GYL2", 1, 2),
        ("B9B0B9GXL1 D D B0B9B9GYL2 D B5B0B20GXNR1", 3, 3),
        ("B9B0B9GXL1 D B0B9B9GYL2 B9B0B9GXL1 D B9B0B9GXL3", 1, 2),
    ],
)
def test_a_cut_behind_an_odd_number_of_stops_is_refused(tmp_path: Path, lines: str, stops: int, block: int) -> None:
    """A run that was broken off, and another one behind it: a drive would cut its moves, and not what it cuts."""
    path = tmp_path / "a.3b"
    path.write_text("\r\n".join([*lines.split(), "DD", ""]))
    run = CliRunner(mix_stderr=False).invoke
    done = run(cli, ["sim", str(path), "--steps", str(tmp_path / "s")])
    assert done.exception.finding.code == "odd-stops" and done.exception.finding["count"] == stops
    assert not (tmp_path / "s").exists()
    done = run(cli, ["sim", str(path)])
    assert done.exit_code == 1 and "travel" in done.stdout and says(done.stderr, path.name, "stop", stops, block)
    done = run(cli, ["check", str(path)])
    assert done.exit_code == 1 and says(done.stdout, f"block {block}", "stop", stops)


def test_a_block_that_never_ends(tmp_path: Path) -> None:
    """One line, exit 2, and no file of half a tape."""
    result = CliRunner(mix_stderr=False).invoke(
        cli, ["sim", "-", "--steps", str(tmp_path / "s")], input="B1B0B4GYNR1\nDD\n"
    )
    assert each_says(str(result.exception), "B1B0B4GYNR1")
    assert not (tmp_path / "s").exists()
