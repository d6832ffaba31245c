"""Damaged files of every kind: read as they are, or refused in one line; no traceback, no success without a file.
`make hunt` tries others."""

from __future__ import annotations

import random
from pathlib import Path

import click
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from toolhelp import CAD_TAPE, ROOT

from skg.cli import cli
from skg.errors import UserError

EXAMPLES = ROOT / "examples"
_LINE = "0\nLINE\n8\n0\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n"
_CORNERS = [(0, 0), (30, 0), (30, 20), (0, 20), (0, 0)]
DXF = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
DXF += "".join(_LINE.format(*a, *b) for a, b in zip(_CORNERS, _CORNERS[1:], strict=False))
DXF += "0\nCIRCLE\n8\nHOLE\n10\n9\n20\n9\n40\n4\n0\nENDSEC\n0\nEOF\n"
SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">'
    '<style>.a{fill:none}</style><g transform="translate(1,2) scale(1)">'
    '<path class="a" d="M5 5h40v30h-40z m9 9c1 2 3 4 5 0l-2 3z"/>'
    '<circle cx="20" cy="20" r="5"/></g></svg>'
)
JOB = 'schema = 1\ndrawing = "in.dxf"\n[machine]\nwire = 0.2\n[[layer]]\nname = "HOLE"\ntab = 0.5\n'
#: What is damaged, under which name, and the commands that read it.
KINDS: dict[str, tuple[bytes, list[list[str]]]] = {
    "in.dxf": (
        DXF.encode(),
        [["cut", "in.dxf", "-o", "out", "--wire", "0.2"], ["cut", "in.dxf", "-o", "out", "--list-layers"]],
    ),
    "in.svg": (SVG.encode(), [["cut", "in.svg", "-o", "out", "--wire", "0.2"]]),
    "in.job.toml": (JOB.encode(), [["cut", "in.job.toml", "-o", "out"]]),
    "in.3b": (
        CAD_TAPE,
        [
            ["check", "in.3b"],
            ["sim", "in.3b"],
            ["gcode", "in.3b", "-o", "out"],
            ["tape", "in.3b", "-o", "out"],
            ["dxf", "in.3b", "-o", "out"],
        ],
    ),
    "in.nc": ((EXAMPLES / "mill/tag.nc").read_bytes(), [["gcode", "--back", "in.nc", "-o", "out"]]),
    "in.skg": (
        b"10 P1=(5,0)\n20 CUT O,P1,(5,5)\n30 FOR\n40 BACK\n50 END\n",
        [["ref", "in.skg", "-o", "out"], ["run", "in.skg", "-o", "out"]],
    ),
    "in.xy": ((EXAMPLES / "xy-book-2-hexagon.xy").read_bytes(), [["xy", "in.xy", "-o", "out"]]),
    "in.tkh": ((EXAMPLES / "tkh-pointer.tkh").read_bytes(), [["tekhtran", "in.tkh", "-o", "out"]]),
    "machine.toml": (
        (ROOT / "tools/skg/dialects/linuxcnc-wire.toml").read_bytes(),
        [["gcode", "in.3b", "-o", "out", "--machine", "machine.toml"]],
    ),
}
#: What is put into the middle of a file.
ODD = [
    b"\0",
    b"\xff\xfe",
    b"\x1a",
    b"\x1b[2K",
    b"-",
    b"1e309",
    b"nan",
    b"inf",
    b"9" * 400,
    b"\n",
    b"<",
    b"&#0;",
    b"(",
    b"]" * 50,
    "\u202e−，".encode(),
    b"{}",
    b"%n",
]


def damaged(data: bytes, seed: int) -> bytes:
    """Some bytes of a file changed, taken away, doubled, or put elsewhere; or the file cut off."""
    chance = random.Random(seed)
    made = bytearray(data)
    for _ in range(chance.randint(1, 4)):
        at, length = chance.randrange(len(made) + 1), chance.randint(1, 12)
        piece = bytes(made[at : at + length])
        kind = chance.randrange(6)
        if kind == 0 and at < len(made):
            made[at] ^= 1 << chance.randrange(8)
        elif kind == 1:
            del made[at : at + length]
        elif kind == 2:
            made[at:at] = chance.choice(ODD)
        elif kind == 3:
            made[at:at] = piece * chance.randint(1, 40)
        elif kind == 4:
            del made[at:]
        else:
            other = chance.randrange(len(made) + 1)
            made[other:other] = piece
    return bytes(made)


@given(st.sampled_from([(name, at) for name, (_, commands) in KINDS.items() for at in range(len(commands))]),
       st.integers(0, 2**32))  # fmt: skip
@settings(max_examples=max(300, settings().max_examples), deadline=None)
def test_damaged(which: tuple[str, int], seed: int) -> None:
    name, at = which
    runner = CliRunner(mix_stderr=False)
    with runner.isolated_filesystem():
        for other, (data, _) in KINDS.items():
            Path(other).write_bytes(data)
        Path(name).write_bytes(damaged(KINDS[name][0], seed))
        words = KINDS[name][1][at]
        result = runner.invoke(cli, words, standalone_mode=False)
        error = result.exception
        is_refused = isinstance(error, UserError | OSError | click.ClickException)
        if is_refused:
            assert "\n" not in str(error) and len(str(error)) < 2000
        elif error is not None and not isinstance(error, SystemExit):
            raise error
        # (a run that ends in an error leaves its tape so far, and exit code 1)
        if "-o" in words and "--list-layers" not in words and (is_refused or result.exit_code != 1):
            assert Path("out").exists() != is_refused, (words, seed, error)
