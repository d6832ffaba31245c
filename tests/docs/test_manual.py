"""The sessions in docs/manual.md and the README are true; run as a program, this updates them.

A fence ```skg holds a program; the fences ```paper and ```tape after it what it prints and punches. A word
behind ```skg names its picture, `input=` what the operator answers. A fence ```prompt holds lines that begin
with the prompt and what is said to them, by firmware and reference. A fence ```board has commands too, which the
firmware alone knows; ```saved after it is what it punched, without blocks, and is in the reader for a fence
```board loaded. The tables of operations and errors carry examples too.
"""

from __future__ import annotations

import re
import runpy
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from click.testing import CliRunner

from skg.board import symbols
from skg.cli import cli
from skg.ref import Result, run
from skg.ref.operations import OPERATIONS
from skg.ref.values import C, D, P, S, T

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "manual.md"
README = ROOT / "README.md"
BOARDS = ROOT / "docs" / "boards.md"
FIRMWARE = ROOT / "docs" / "firmware.md"
PICTURES = ROOT / "docs" / "pictures"
ROM = ROOT / "roms" / "skg.bin"
SKG80 = ROOT / "build" / "skg80"

FENCE = re.compile(r"^```(?P<kind>skg|paper|tape|prompt|board|saved)(?P<rest>.*)\n(?P<body>(?:(?!```).*\n)*)```$", re.M)
#: A row of the table of operations: form, result, meaning, example, what PRINT says, source.
OPERATION = re.compile(r"^\| `(?P<form>[^`]+)` \| \S+ \| [^|]+ \| `(?P<example>[^`]+)` \| `(?P<result>[^`]*)` \|", re.M)
#: A row of the table of errors: number, meaning, statements that end in it.
ERROR = re.compile(r"^\| (?P<number>\d\d) \| [^|]+ \| (?P<example>`[^|]+`) \|", re.M)
#: A block as the teletype lists it.
BLOCK = re.compile(r"\d{4} (B|D)")


@dataclass
class Example:
    """A program of the page with what stands behind it; None where no such fence stands."""

    line: int
    source: str
    picture: str | None
    answers: list[str]
    paper: str | None = None
    tape: str | None = None


def examples() -> list[Example]:
    page = PAGE.read_text()
    found: list[Example] = []
    for fence in FENCE.finditer(page):
        if fence["kind"] == "skg":
            options = re.fullmatch(r"(?: (?P<picture>[a-z-]+))?(?: input=(?P<answers>\S+))?", fence["rest"])
            assert options, fence[0]
            line = page.count("\n", 0, fence.start()) + 1
            answers = (options["answers"] or "").split("/") if options["answers"] else []
            found.append(Example(line, fence["body"], options["picture"], answers))
        elif fence["kind"] in ("paper", "tape"):
            setattr(found[-1], fence["kind"], fence["body"])
    return found


def test_heads() -> None:
    """A fence ```head shows how an example of examples/circles begins."""
    heads = re.findall(r"^```head (\S+)\n((?:(?!```).*\n)+)```$", PAGE.read_text(), re.M)
    assert heads
    for name, body in heads:
        assert (ROOT / "examples" / "circles" / f"{name}.skg").read_text().startswith(body)


def text_of(result: Result) -> str:
    return result.tape.decode("ascii").replace("\r\n", "\n")


def fences(kind: str) -> list[re.Match[str]]:
    return [fence for fence in rows(FENCE) if fence["kind"] == kind]


def rows(pattern: re.Pattern[str]) -> Iterator[re.Match[str]]:
    return pattern.finditer(PAGE.read_text())


def by_line(example: Example) -> str:
    return f"line {example.line}"


@pytest.mark.parametrize("example", examples(), ids=by_line)
def test_example(example: Example) -> None:
    result = run(example.source, example.answers)
    assert result.paper == (example.paper or "")
    if example.tape is not None or text_of(result) not in ("", "DD\n"):
        assert text_of(result) == example.tape


@pytest.mark.parametrize("fence", fences("prompt"), ids=lambda fence: fence["body"][:20])
def test_prompt(fence: re.Match[str]) -> None:
    lines = fence["body"].splitlines()
    typed = "\n".join(line[1:] for line in lines if line.startswith(">"))
    assert run(typed).paper.splitlines() == [line for line in lines if not line.startswith(">")]


@pytest.mark.parametrize("row", rows(OPERATION), ids=lambda row: row["form"])
def test_operation(row: re.Match[str]) -> None:
    assert run(f"PRINT {row['example']}").paper == row["result"] + "\n"


@pytest.mark.parametrize("row", rows(ERROR), ids=lambda row: row["number"])
def test_error(row: re.Match[str]) -> None:
    assert error_of(row["example"]) == int(row["number"])


def program_of(cell: str) -> str:
    """The quoted statements as a program."""
    return "".join(f"{10 * n} {text}\n" for n, text in enumerate(re.findall(r"`([^`]+)`", cell), 1))


def error_of(cell: str) -> int | None:
    """Number of the error in which the quoted statements end."""
    error = run(program_of(cell)).error
    return error[0] if error else None


def test_errors_are_complete() -> None:
    assert [int(row["number"]) for row in rows(ERROR)] == list(range(1, 11))


def test_operations_are_complete() -> None:
    """Every pair that the reference knows has its row, and no row is too much."""
    kinds = {"P": P, "C": C, "S": S, "D": D, "A": D, "(A:P)": T}
    shown = set()
    for row in rows(OPERATION):
        if form := re.fullmatch(r"([DAPCS])(\W)([DAPCS]|\(A:P\))", row["form"]):
            shown.add((kinds[form[1]], form[2], kinds[form[3]]))
    # A turn shows only at the right of `#`, which its row writes out; it is no value by itself.
    assert shown | {(D, ":", P)} == set(OPERATIONS)


def test_statements_are_complete() -> None:
    """Every word of the grammar stands in the appendix of statements, and in an example."""
    grammar = (ROOT / "tools" / "skg" / "ref" / "skg.lark").read_text()
    words = set(re.findall(r"^_([A-Z]+)\.2", grammar, re.M))
    assert len(words) > 15
    appendix = PAGE.read_text().split("## Appendix A")[1].split("## Appendix B")[0]
    shown = set(re.findall(r"^\| `([A-Z]+)", appendix, re.M))
    assert words <= shown
    used = {word for example in examples() for word in re.findall(r"^\d+ ([A-Z]+)", example.source, re.M)}
    used |= {word for fence in fences("prompt") for word in re.findall(r"^>([A-Z]+)", fence["body"], re.M)}
    assert words <= used


def pictures() -> list[Example]:
    return [example for example in examples() if example.picture]


def draw(example: Example, folder: Path) -> bytes:
    """The picture of an example."""
    part, picture = folder / "part.skg", folder / "part.svg"
    part.write_text(example.source)
    done = CliRunner().invoke(cli, ["plot", str(part), "--skg80", "reference", "-o", str(picture)])
    assert done.exit_code == 0, done.output
    return picture.read_bytes()


@pytest.mark.parametrize("example", pictures(), ids=by_line)
def test_picture(example: Example, tmp_path: Path) -> None:
    name = f"manual-{example.picture}.svg"
    assert f"](pictures/{name})" in PAGE.read_text()
    assert draw(example, tmp_path) == (PICTURES / name).read_bytes()


def test_every_picture_is_used() -> None:
    assert {f"manual-{e.picture}.svg" for e in pictures()} == {p.name for p in PICTURES.glob("manual-*.svg")}


# The same on the firmware


def on_the_board(source: str, answers: list[str], folder: Path) -> tuple[str, str]:
    """Paper (without the listing of blocks) and tape of a program on the firmware."""
    (folder / "part.skg").write_text(source)
    (folder / "answers").write_text("".join(f"{answer}\n" for answer in answers))
    done = subprocess.run(
        [SKG80, "--rom", ROM, "--input", folder / "answers", folder / "part.skg"],
        capture_output=True,
        check=False,
    )
    said = done.stderr.decode().replace("\r", "").partition(">RUN\n")[2]
    lines = [line for line in said.splitlines() if line not in (">", "D", "DD") and not BLOCK.match(line)]
    return "".join(f"{line}\n" for line in lines), done.stdout.decode().replace("\r\n", "\n")


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
@pytest.mark.parametrize("example", examples(), ids=by_line)
def test_example_on_the_board(example: Example, tmp_path: Path) -> None:
    paper, tape = on_the_board(example.source, example.answers, tmp_path)
    assert paper == (example.paper or "")
    assert example.tape is None or tape == example.tape


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
def test_operations_on_the_board(tmp_path: Path) -> None:
    """All examples of the table of operations, in one program."""
    table = list(rows(OPERATION))
    source = "".join(f"{n} PRINT {row['example']}\n" for n, row in enumerate(table, 1))
    paper, _ = on_the_board(source, [], tmp_path)
    assert paper.splitlines() == [row["result"] for row in table]


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
@pytest.mark.parametrize("row", rows(ERROR), ids=lambda row: row["number"])
def test_error_on_the_board(row: re.Match[str], tmp_path: Path) -> None:
    """The examples of the table of errors, as a program; what error 1 refuses it refuses when it is loaded."""
    (tmp_path / "part.skg").write_text(program_of(row["example"]))
    done = subprocess.run([SKG80, "--rom", ROM, tmp_path / "part.skg"], capture_output=True, check=False)
    assert done.returncode == 1
    errors = re.findall(r"^ERR (\d\d)", done.stderr.decode(), re.M)
    assert errors == [row["number"]]


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
@pytest.mark.parametrize("fence", fences("prompt"), ids=lambda fence: fence["body"][:20])
def test_prompt_on_the_board(fence: re.Match[str]) -> None:
    assert said_by_the_board(fence["body"]) == fence["body"]


def said_by_the_board(session: str, reader: str = "", punched: list[str] | None = None) -> str:
    """A session as the board's paper shows it, from the first prompt on, when these lines are typed.

    The tape `reader` is in the reader; the lines that are punched, but for blocks, are added to `punched`.
    """
    typed = "".join(f"{line[1:]}\r" for line in session.splitlines() if line.startswith(">"))
    with tempfile.TemporaryDirectory() as scratch:
        tape, punch = Path(scratch) / "tape", Path(scratch) / "punch"
        tape.write_bytes(reader.replace("\n", "\r\n").encode() + b"\x1a")
        done = subprocess.run(
            [SKG80, "--rom", ROM, "--tape", tape, "--punch", punch],
            input=typed.encode(),
            capture_output=True,
            check=False,
        )
        if punched is not None:
            # (what has no end of a tape is a part)
            parts = [path.read_text() for path in (punch, punch.with_name("punch.part")) if path.exists()]
            lines = "".join(parts).replace("\0", "").rstrip("\x1a").splitlines()
            punched.append("".join(f"{line}\n" for line in lines if line and not re.match("[BD]", line)))
    paper = done.stdout.decode().translate(dict.fromkeys(b"\r\0\x1a"))
    return paper[paper.index(">") :].removesuffix(">")


def boards() -> Iterator[tuple[re.Match[str], str, str]]:
    """Every session with the firmware, what it says and what it punches."""
    saved = ""
    for fence in rows(FENCE):
        if fence["kind"] == "board":
            punched: list[str] = []
            said = said_by_the_board(fence["body"], saved if fence["rest"] == " loaded" else "", punched)
            saved = punched[0] or saved
            yield fence, said, saved


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
def test_sessions_on_the_board() -> None:
    """The board's answers to commands, and the tape that SAVE punches, are those of the manual."""
    sessions = list(boards())
    assert len(sessions) >= 2
    for fence, said, _ in sessions:
        assert said == fence["body"]
    assert [fence["body"] for fence in fences("saved")] == [sessions[0][2]]
    words = {word for fence, _, _ in sessions for word in re.findall(r"^>([A-Z]+)", fence["body"], re.M)}
    assert words >= {"RUN", "LIST", "NEW", "LOAD", "SAVE", "FREE"}


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
def test_readme_session() -> None:
    session = next(fence["body"] for fence in FENCE.finditer(README.read_text()) if fence["kind"] == "prompt")
    assert said_by_the_board(session) == session


@pytest.mark.skipif(not (ROM.exists() and SKG80.exists()), reason="needs roms/skg.bin and build/skg80")
def test_first_light() -> None:
    """The free bytes that docs/boards.md promises."""
    done = subprocess.run([SKG80, "--rom", ROM], input=b"", capture_output=True, check=False)
    free = re.search(rb"SKG (\d+)", done.stdout)
    assert free
    assert f"the board says `SKG` and the free bytes ({free[1].decode()} with 8 KiB of RAM)" in BOARDS.read_text()


# The firmware's page


def byte_table() -> list[tuple[str, int]]:
    """Files and bytes of docs/firmware.md."""
    body = FIRMWARE.read_text().split("```bytes\n")[1].split("```")[0]
    return [(name, int(count)) for name, count in re.findall(r"^ *(\S+) +(\d+)", body, re.M)]


def test_bytes_add_up() -> None:
    """Every source file of the ROM has its row, and the sum is right."""
    build = runpy.run_path(str(ROOT / "asm" / "build.py"))
    *files, (used, total) = byte_table()
    assert [name for name, _ in files] == [f"{name}.asm" for name in build["IMAGES"]["skg"].files()]
    assert used == "used"
    assert sum(count for _, count in files) == total <= build["ROM_SIZE"]


def test_memory_map() -> None:
    """The addresses of the page are those of the sources."""
    equates = symbols((ROOT / "roms" / "skg.sym").read_text())
    shown = re.findall(r"^\| ([0-9A-F]{4}) \| [^|]+ \| `(\w+)` \|", FIRMWARE.read_text(), re.M)
    assert len(shown) > 8
    assert [(place, name) for place, name in shown if equates[name] != int(place, 16)] == []


# Writing the pages anew


def rewritten(page: str) -> str:
    """The page with every result in its place."""
    last: Result | None = None

    def fence(match: re.Match[str]) -> str:
        nonlocal last
        kind = match["kind"]
        if kind == "prompt":
            typed = [line for line in match["body"].splitlines() if line.startswith(">")]
            body = ""
            for n, line in enumerate(typed, 1):
                said = run("\n".join(each[1:] for each in typed[:n])).paper.splitlines()
                before = run("\n".join(each[1:] for each in typed[: n - 1])).paper.splitlines()
                body += "".join(f"{each}\n" for each in [line, *said[len(before) :]])
            return f"```prompt\n{body}```"
        if kind in ("board", "saved"):
            return match[0]
        if kind == "skg":
            answers = re.search(r"input=(\S+)", match["rest"])
            last = run(match["body"], answers[1].split("/") if answers else [])
            return match[0]
        assert last
        return f"```{kind}\n{last.paper if kind == 'paper' else text_of(last)}```"

    sessions = boards()
    saved = ""

    def board(match: re.Match[str]) -> str:
        nonlocal saved
        if match["kind"] == "board":
            _, said, saved = next(sessions)
            return f"```board{match['rest']}\n{said}```"
        return f"```saved\n{saved}```" if match["kind"] == "saved" else match[0]

    page = FENCE.sub(board, FENCE.sub(fence, page))

    def row(match: re.Match[str]) -> str:
        said = run(f"PRINT {match['example']}").paper.strip()
        return match[0].removesuffix(f"`{match['result']}` |") + f"`{said}` |"

    return OPERATION.sub(row, page)


if __name__ == "__main__":
    PAGE.write_text(rewritten(PAGE.read_text()))
    if ROM.exists() and SKG80.exists():
        README.write_text(
            FENCE.sub(lambda fence: f"```prompt\n{said_by_the_board(fence['body'])}```", README.read_text())
        )
    with tempfile.TemporaryDirectory() as scratch:
        built = subprocess.run(
            [sys.executable, ROOT / "asm" / "build.py", Path(scratch) / "table"],
            capture_output=True,
            text=True,
            check=False,
        )
    if built.returncode:
        print(f"{FIRMWARE}: bytes not written anew: {built.stderr.strip()}", file=sys.stderr)
    else:
        FIRMWARE.write_text(re.sub(r"```bytes\n[^`]*```", f"```bytes\n{built.stdout}```", FIRMWARE.read_text()))
    for number in rows(ERROR):
        if error_of(number["example"]) != int(number["number"]):
            sys.exit(f"{PAGE}: example of error {number['number']} ends in {error_of(number['example'])}")
    for each in pictures():
        with tempfile.TemporaryDirectory() as scratch:
            (PICTURES / f"manual-{each.picture}.svg").write_bytes(draw(each, Path(scratch)))
