"""skg80 --debug and --trace on the firmware: names, byte-code, numbers, steps; checked by other means."""

from __future__ import annotations

import functools
import re
import subprocess
from fractions import Fraction
from pathlib import Path

import pytest
from romhelp import ROM, ROOT, labels
from test_build import OPCODES, listed, walked

SKG80 = ROOT / "build" / "skg80"
PROMPT = "debug> "
EXAMPLE = ROOT / "examples" / "plate-fillets.skg"
#: Names of byte-code in the sources: an operation or a constant, a load, a store; the distance of a jump.
CODE = re.compile(r"(?!SKIP)[QLS]\w+(?:\+QRET)?")
DISTANCE = re.compile(r"(\w+)-\$")


def debugged(part: Path, *commands: str) -> list[str]:
    """The answer to each command, in one session for all of them."""
    done = subprocess.run([SKG80, "--rom", ROM, "--debug", part], input="\n".join([*commands, ""]),
                          capture_output=True, text=True)  # fmt: skip
    assert done.returncode == 0
    text = done.stderr.replace("\r\n", "\n")
    answers = []
    for command in commands:
        said, echo, text = text.partition(f"{PROMPT}{command}\n")
        assert echo, f"{command} was never asked for: {said[-300:]}"
        answers.append(said)
    return [*answers[1:], text.partition(PROMPT)[0]]


#: In one process with test_build.py, whose listing this reads.
pytestmark = pytest.mark.xdist_group("images")


@pytest.fixture(scope="module")
def nothing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A part that does nothing."""
    path = tmp_path_factory.mktemp("part") / "empty.skg"
    path.write_text("10 END\n\x1a")
    return path


@functools.cache
def source_lines() -> tuple[list[tuple[int, int, list[str]]], dict[int, str]]:
    """Every line of the sources that is byte-code: address, bytes, operations. And the label behind each jump, by the
    address of its distance."""
    code, jumps = [], {}
    for line in listed("skg"):
        operands = [text.strip() for text in line.operands.split(",")]
        at = line.at
        if operands[0] == "CALC":
            at, operands = at + 1, operands[1:]  # the restart
        if line.mnemonic == "DB" and all(CODE.fullmatch(text) or DISTANCE.fullmatch(text) for text in operands):
            jumps |= {at + n: found[1] for n, text in enumerate(operands) if (found := DISTANCE.fullmatch(text))}
            if named := [text for text in operands if not DISTANCE.fullmatch(text)]:
                code.append((at, len(operands), named))
    return code, jumps


def test_byte_code_reads_as_in_the_sources(nothing: Path) -> None:
    """Every line of byte-code, operation for operation and jump for jump."""
    wanted, jumps = source_lines()
    names = labels()
    answers = debugged(nothing, *(f"code {at:X} {length}" for at, length, _ in wanted))
    compared = jumped = 0
    for (_, _, operations), answer in zip(wanted, answers, strict=True):
        for operation, shown in zip(operations, answer.splitlines(), strict=False):
            found = re.fullmatch(r"([0-9A-F]{4}) (\S+) +(\S+)(?: (\S+))?", shown)
            assert found and operation in found[3].split("/"), f"{shown}, not {operation}"
            assert found[2] == "0000" or address(names, found[2]) == int(found[1], 16)
            compared += 1
            if operation.startswith("QJ"):
                assert address(names, found[4]) == names[jumps[int(found[1], 16) + 1]], shown
                jumped += 1
        assert len(answer.splitlines()) >= len(operations)
    assert compared > 1200 and jumped == len(jumps) > 50


def test_byte_code_behind_a_routines_name(nothing: Path) -> None:
    """A routine that begins with DB CALC: its name asks for what stands behind the restart."""
    by_name, behind = debugged(nothing, "code FILLET 5", f"code {labels()['FILLET'] + 1:X} 5")
    assert by_name == behind
    assert by_name.split()[1:3] == ["FILLET+1", "QPTOK"]


def address(names: dict[str, int], place: str) -> int:
    """LABEL or LABEL+distance."""
    label, _, distance = place.partition("+")
    return names[label] + int(distance or 0)


def test_every_code_that_the_rom_uses_has_a_name(nothing: Path) -> None:
    """Whatever can be reached by walking through the image."""
    walk = walked("skg")
    one_of_each = {walk.image[at]: at for at in sorted(walk.bytecode, reverse=True)}
    answers = debugged(nothing, *(f"code {at:X} 1" for at in one_of_each.values()))
    assert len(one_of_each) > 100
    for (code, at), answer in zip(one_of_each.items(), answers, strict=True):
        assert re.match(rf"{at:04X} \S+ +[QLS]", answer), f"{code:02X}: {answer}"


def test_constants_and_registers_have_their_values_and_places(nothing: Path) -> None:
    """Constants as the sources' comments give them, registers in the places of equ.asm's comments."""
    constants = (ROOT / "asm" / "consts.asm").read_text()
    rows = re.findall(r"^(?:CONTAB:)?[ \t]+DB[ \t]+\S+(?:[ \t]+; (\S+))?", constants, re.M)
    values = [float(Fraction(text or "0")) for text in rows]
    numbers = dict(re.findall(r"^(Q\w+)\s+EQU\s+(0[C-F][0-9A-F]H)", constants, re.M))
    equates = (ROOT / "asm" / "equ.asm").read_text()
    places = re.findall(r"^L(\w+)\s+EQU\s+\w+\nS\1\s+EQU\s+\w+\s+; (M\d+)", equates, re.M)
    assert len(values) > 12 and len(numbers) > 12 and len(places) > 50
    names = labels()
    # A byte-code is shown wherever it stands; every constant stands somewhere in the ROM.
    image = ROM.read_bytes()
    wanted = {name: image.index(bytes([int(code[:-1], 16)])) for name, code in numbers.items()}
    shown = debugged(nothing, *(f"code {at:X} 1" for at in wanted.values()), *(f"m {name}" for name, _ in places))
    for (name, _), answer in zip(wanted.items(), shown, strict=False):
        index = names[name] - 0xC0
        found = re.search(r"\s(\S+) \((\S+)\)", answer)
        assert found and name in found[1].split("/"), answer
        assert float(found[2]) == pytest.approx(values[index], rel=1e-8)
    for (name, place), answer in zip(places, shown[len(wanted) :], strict=True):
        assert re.match(rf"{place} +(\S+/)?{name}(/\S+)? ", answer), answer


@pytest.fixture(scope="module")
def traced(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[str], str]:
    """The trace of an example, line by line, and what --stats says; the tape is what it should be."""
    path = tmp_path_factory.mktemp("trace") / "trace"
    done = subprocess.run([SKG80, "--rom", ROM, "--stats", "--trace", path, EXAMPLE], capture_output=True)
    assert done.returncode == 0
    assert done.stdout == EXAMPLE.with_suffix(".3b").read_bytes()
    return path.read_text().splitlines(), done.stderr.decode()


LINE = re.compile(r"(\d+) ([0-9A-F]{4}) (\S+) +(.+?) +A=(..) F=(\S+) BC=(....) DE=(....) HL=(....) SP=(....)")
OPERATION = re.compile(r"; ([0-9A-F]{4}) (\S+) +(\S+)(?: (\S+))? *\|(.*)")


def test_trace_has_every_instruction(traced: tuple[list[str], str]) -> None:
    """As many as --stats counts; each is what stands at its address, and its label is that address's."""
    lines, stats = traced
    instructions = [line for line in lines if not line.startswith(";")]
    assert len(instructions) == int(re.search(r"instructions +(\d+)", stats)[1]) > 1_000_000
    image, names = ROM.read_bytes(), labels()
    before = None
    for line in instructions[:: len(instructions) // 50_000]:
        found = LINE.fullmatch(line)
        assert found, line
        cycles, at = int(found[1]), int(found[2], 16)
        mnemonic, length = OPCODES[image[at]]
        assert found[4].startswith(mnemonic.split(" ")[0]), found[0]
        if length == 1 and not mnemonic.startswith("RST"):
            assert found[4] == mnemonic
        assert at < names["CHECK"] or address(names, found[3]) == at
        assert before is None or before < cycles
        before = cycles


def test_trace_follows_the_floats(traced: tuple[list[str], str]) -> None:
    """The stack behind an operation is what it does to the stack in front of it."""
    does = {
        "QADD": lambda *s: (*s[:-2], s[-2] + s[-1]),
        "QSUB": lambda *s: (*s[:-2], s[-2] - s[-1]),
        "QMUL": lambda *s: (*s[:-2], s[-2] * s[-1]),
        "QDIV": lambda *s: (*s[:-2], s[-2] / s[-1]),
        "QNEG": lambda *s: (*s[:-1], -s[-1]),
        "QABS": lambda *s: (*s[:-1], abs(s[-1])),
        "QDUP": lambda *s: (*s, s[-1]),
        "QSWP": lambda *s: (*s[:-2], s[-1], s[-2]),
        "QOVR": lambda *s: (*s, s[-2]),
        "QSQ": lambda *s: (*s[:-1], s[-1] * s[-1]),
    }
    operations = [OPERATION.fullmatch(line) for line in traced[0] if line.startswith(";")]
    assert all(operations)
    seen = dict.fromkeys([*does, "load", "store", "constant"], 0)
    for one, after in zip(operations, operations[1:], strict=False):
        name, stack, then = (
            re.split(r"[/+]", one[3])[0],
            tuple(map(float, one[5].split())),
            tuple(map(float, after[5].split())),
        )
        value = float(one[4].strip("()")) if one[4] and one[4].startswith("(") else None
        expected = None
        if name in does:
            expected = does[name](*stack)
        elif value is not None:
            expected = (*stack, value)
            name = "load" if name.startswith("L") else "constant"
        elif name.startswith("S"):
            expected, name = stack[:-1], "store"
        if expected is not None:
            # Nine digits are shown, and a difference of two has them no more.
            size = max((abs(number) for number in stack), default=0) + 1e-30
            assert then == pytest.approx(expected, rel=1e-7, abs=size * 1e-8), f"{one[0]} -> {after[0]}"
            seen[name] += 1
    assert all(count > 10 for count in seen.values()), seen


def test_steps(nothing: Path, tmp_path: Path, traced: tuple[list[str], str]) -> None:
    """By instruction and by operation: the lines of the trace, so many further on."""
    lines, _ = traced
    code = [line for line in lines if not line.startswith(";")]
    first, second, third, fourth = debugged(EXAMPLE, "step", "step 99", "operation", "operation 40")
    assert first.strip() == code[1]
    assert second.strip() == code[100]
    behind = lines[lines.index(code[100]) :]
    operations = [line for line in behind if line.startswith(";")]
    assert third.strip() == operations[0]
    assert fourth.strip().splitlines()[-1] == operations[40]


def test_next_and_up(nothing: Path) -> None:
    """A call as one step, and back to where the routine was called; one that does not call is one instruction."""
    start = labels()["RESET"]
    image = ROM.read_bytes()
    # RESET begins with LXI SP and CALL CALINI.
    assert [OPCODES[image[start]], OPCODES[image[start + 3]]] == [("LXI SP", 3), ("CALL", 3)]
    at_reset = ["break RESET", "continue", "delete"]
    answers = debugged(nothing, *at_reset, "next", "next", "break CALINI", "delete", "continue")
    assert [re.match(r"\d+ \S+ (\S+)", answers[n])[1] for n in (1, 3, 4)] == ["RESET", "RESET+3", "RESET+6"]
    inside, back = debugged(nothing, "break CALINI", "continue", "up")[1:3]
    assert re.match(r"\d+ \S+ CALINI ", inside)
    assert re.match(r"\d+ \S+ RESET\+6 ", back)


def test_breakpoints_by_label_distance_and_address(nothing: Path) -> None:
    """Also in byte-code; lists them, deletes them, and stops at none that is gone."""
    names = labels()
    at = names["RUNINI"]
    answers = debugged(
        EXAMPLE,
        "break runini",
        f"break {at + 1:x}",
        "break RUNINI+1",
        "break",
        "continue",
        "continue",
        "delete RUNINI",
        "break",
        "delete",
        "break",
        "break MOVE1",
        "continue",
        "continue",
        "code 0",
    )
    assert answers[:3] == ["", "", ""]
    assert answers[3] == f"{at:04X} RUNINI\n{at + 1:04X} RUNINI+1\n"
    assert f" {at:04X} RUNINI " in answers[4]
    assert answers[5].strip().startswith(f"; {at + 1:04X} RUNINI+1"), "the operation behind RST 5"
    assert answers[7] == f"{at + 1:04X} RUNINI+1\n"
    assert answers[9] == ""
    assert all(f"; {names['MOVE1']:04X} MOVE1 " in answer for answer in answers[11:13])


def test_all_breakpoints_of_a_run_are_reached(traced: tuple[list[str], str]) -> None:
    """As often as the trace comes there, at full speed, and the tape is the same."""
    wanted = sum(bool(re.match(r"\d+ \S+ PUTB1 ", line)) for line in traced[0])
    assert wanted == 3 * EXAMPLE.with_suffix(".3b").read_text().count("G"), "x, y and J of every block"
    done = subprocess.run([SKG80, "--rom", ROM, "--break", "PUTB1", EXAMPLE], input="continue\n" * (wanted + 5),
                          capture_output=True, text=True)  # fmt: skip
    assert len(re.findall(r"^\d+ \S+ PUTB1 ", done.stderr, re.M)) == wanted
    assert done.stdout.replace("\n", "\r\n").encode() == EXAMPLE.with_suffix(".3b").read_bytes()


def test_registers_are_the_reference_s_numbers(tmp_path: Path) -> None:
    """A line through (0,0) and (3,4) in its canonical numbers, the corner that the third point names, the block."""
    part = tmp_path / "part.skg"
    part.write_text("CUT (0,0),(3,4),(3,0)\n")
    answers = debugged(part, "break CORNER", "continue", "m N0 N1", "m kx LKY", "break PUTB1", "continue", "m BX M59",
                       "m BJ")  # fmt: skip
    assert re.findall(r" (-?[\d.]+)$", answers[2], re.M) == ["-1", "0"]
    assert re.findall(r" (-?[\d.]+)$", answers[3], re.M) == ["3", "4"]
    assert re.findall(r" (-?[\d.]+)$", answers[6] + answers[7], re.M) == ["3000", "4000", "4000"]
