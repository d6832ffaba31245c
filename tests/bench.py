"""All that has a limit, as one table behind the benches' own: `make bench`, with exit 1 where a limit is passed.

Cycles of the 8080 are exact, and so are the host's instructions where valgrind counts them. Seconds of `skg cut` are
the processor's and have no limit; but it takes no longer than viaConstructor, where `make bench-peer` has that.

    PYTHONPATH=tests python tests/bench.py [--exact | --page]

--exact: the cycles alone, in some 20 seconds (CI). --page: these, written into docs/firmware.md, too (`make docs`).
"""

from __future__ import annotations

import argparse
import importlib.util
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from measured import Measured, judge

TESTS = Path(__file__).resolve().parent
ROOT = TESTS.parent
MIX, BENCH = ROOT / "build" / "emu" / "mix.com", ROOT / "build" / "emu" / "bench"
#: The core carries out an instruction of the 8080 in so many times fewer of the host's than superzazu's 8080 (79.4 of
#: them, gcc 12, -O2, in mix.asm), which tests/emu/plain8080.c stands for: that takes 100.7.
TIMES_FEWER, PLAIN_FOR_PEER = 6.5, 79.4 / 100.7
#: The table of the page: what is measured, by its words there.
PAGE = ROOT / "docs" / "firmware.md"
STATED = {
    "a block of the examples": "a block, mean of the examples",
    "a node of FIT, in the part where it is most": "a node of FIT, in the part where it is most",
    "a line that LOAD takes": "a line that LOAD takes",
    "sine of −180 to 180 degrees": "FSIN, mean",
}
#: Cycles of two runs, of which the difference counts.
SHORT, LONG = 10_000_000, 30_000_000


def benches(*names: str) -> list[Measured]:
    """The rows of some folders' benches, behind their own tables."""
    rows: list[Measured] = []
    for name in names:
        print(f"tests/{name}/bench.py\n")
        rows += _main_of(TESTS / name / "bench.py")()
        print()
    return rows


def _main_of(path: Path) -> Callable[[], list[Measured]]:
    """`main` of a bench: its folder has helpers of its own, so it is on the path."""
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location(f"{path.parent.name}_bench", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.main


def emulator() -> list[Measured]:
    """How many times fewer instructions of the host the core takes for the same of the 8080; none without valgrind."""
    if not shutil.which("valgrind"):
        print("No valgrind: the emulator's instructions are not counted.")
        return []
    ours, plain = (_instructions(core) for core in ("ours", "plain"))
    return [
        Measured("host instructions for one of the 8080", ours, None),
        Measured("times fewer than superzazu's 8080", plain * PLAIN_FOR_PEER / ours, TIMES_FEWER, at_least=True),
    ]


def _instructions(core: str) -> float:
    """The host's for one of the 8080, start and end left out."""
    counts = []
    for cycles in (SHORT, LONG):
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", BENCH, MIX, core, str(cycles)]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        found = re.search(r"Collected : (\d+)", run.stderr)
        assert found, run.stderr
        counts.append((int(found[1]), int(run.stdout)))
    (host, guest), (host2, guest2) = counts
    return (host2 - host) / (guest2 - guest)


def write(rows: list[Measured]) -> None:
    """The table of the page, as it is now."""
    text, measured = PAGE.read_text(), {row.what: row for row in rows}
    for words, what in STATED.items():
        row = f"| {words} | {measured[what].value:,.0f} | {measured[what].limit:,} |"
        text, count = re.subn(rf"^\| {re.escape(words)} \|.*$", row, text, flags=re.M)
        assert count == 1, words
    PAGE.write_text(text)


def main() -> int:
    """The exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--exact", action="store_true", help="cycles of the 8080 alone")
    parser.add_argument("--page", action="store_true", help="these, and into docs/firmware.md")
    options = parser.parse_args()
    rows = benches("floats", "rom", "drive")
    if options.page:
        write(rows)
    elif not options.exact:
        rows += [*emulator(), *benches("tools")]
    return judge(rows)


if __name__ == "__main__":
    raise SystemExit(main())
