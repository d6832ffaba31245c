"""The page in web/: its WebAssembly, its types, and its own code in node, against the tools in Python.

What a browser shows is tested in browsers: `make test-web`.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import ezdxf
import pytest
from ezdxf.entities import DXFEntity
from tapedrawing import drawn

from skg.signs import with_signs
from skg.tape import gcode, text
from skg.tape.layout import CUT, WAY_BACK, WAY_IN, PlacedRoute, place, stop_places
from skg.tape.simulation import simulate

ROOT = Path(__file__).parents[2]
WEB = ROOT / "web"
BIN = WEB / "node_modules" / ".bin"
TAPES = {path.stem: text.read(str(path)) for path in sorted((ROOT / "examples").glob("*.3b"))}


def run(*command: str | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command,
        cwd=ROOT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.skipif(
    not (shutil.which("clang-14") and shutil.which("wasm-ld-14") and Path("/usr/include/wasm32-wasi").is_dir()),
    reason="not all of clang and lld 14, wasi-libc: make web-tools",
)
def test_wasm_is_what_its_sources_give(tmp_path: Path) -> None:
    made = run("sh", WEB / "wasm" / "build.sh", tmp_path)
    assert made.returncode == 0, made.stderr
    for name in ("board.wasm", "walk.wasm", "inside.wasm"):
        assert (tmp_path / name).read_bytes() == (WEB / "wasm" / name).read_bytes(), f"{name}: run make web-wasm"


def test_page_of_skg_ui_is_what_its_sources_give(tmp_path: Path) -> None:
    built = run("make", "-s", "web/build/ui.mjs")
    assert built.returncode == 0, built.stderr
    made = run("node", WEB / "build" / "ui.mjs", tmp_path)
    assert made.returncode == 0, made.stderr
    assets = ROOT / "tools" / "skg" / "ui" / "assets"
    assert {path.name for path in assets.iterdir()} == {path.name for path in tmp_path.iterdir()}
    for path in tmp_path.iterdir():
        assert path.read_bytes() == (assets / path.name).read_bytes(), f"{path.name}: run make ui-page"


def test_types() -> None:
    made = run(BIN / "tsc", "-p", WEB)
    assert made.returncode == 0, made.stdout


def roles(routes: list[PlacedRoute]) -> list[str]:
    """The purpose of each block, in the page's words."""
    words = {WAY_IN: "in", CUT: "cut", WAY_BACK: "back"}
    return [
        "move" if route.is_move else words[part] for route in routes for part, blocks in route.parts() for _ in blocks
    ]


def golden(name: str) -> dict[str, object]:
    tape = TAPES[name]
    routes = place(tape, (0, 0), "programmed")
    blocks = [placed for route in routes for placed in route.blocks]
    report = simulate(tape, positions="programmed")
    each = [{"steps": one.steps, "really": one.really, "gap": report.gap} for one in report.each]
    return {
        "tape": (ROOT / "examples" / f"{name}.3b").read_bytes().decode("ascii"),
        "iso": gcode.write(tape, positions="programmed"),
        "ends": [placed.end for placed in blocks],
        "sweeps": [placed.sweep for placed in blocks],
        "roles": roles(routes),
        "offPath": report.off_path,
        "simulated": each,
    }


#: Where the debugger is asked: in machine code and in byte-code.
STOPS = ("SCUT", "ARC5", "ARC7")
ROM_BYTES = 0x2000


def debugger(stop: str) -> dict[str, object]:
    """The output of `skg80 --debug` at the wrench's second stop: floats, registers; at one of STOPS the ROM's code."""
    skg80, part = ROOT / "build" / "skg80", ROOT / "examples" / "wrench.skg"
    listings = [f"list {address:X} 1" for address in range(ROM_BYTES)] if stop == STOPS[0] else []
    commands = ["continue", "floats", "m", *listings]
    done = subprocess.run(
        [skg80, "--break", stop, part, "--punch", os.devnull],
        cwd=ROOT,
        input="\n".join([*commands, "quit", ""]),
        capture_output=True,
        text=True,
        check=True,
    )
    answers = [answer.partition("\n")[2] for answer in done.stderr.split("debug> ")[2:]]
    said = dict(zip(commands[1:], answers, strict=False))
    return {
        "stop": stop,
        "floats": said["floats"].strip("| \n"),
        "registers": said["m"].splitlines(),
        "listings": [said[command] for command in listings],
    }


def shape(entity: DXFEntity) -> tuple[object, ...]:
    """An entity's type and place, to a nanometre; a line or an arc by its ends in either order."""

    def at(point: object) -> tuple[float, float]:
        return round(point[0], 6) + 0.0, round(point[1], 6) + 0.0

    kind, layer = entity.dxftype(), entity.dxf.layer
    match kind:
        case "LINE":
            return kind, layer, at(entity.dxf.start), at(entity.dxf.end)
        case "ARC":
            return (
                kind,
                layer,
                at(entity.dxf.center),
                round(entity.dxf.radius, 6),
                at(entity.start_point),
                at(entity.end_point),
            )
        case "CIRCLE":
            return kind, layer, at(entity.dxf.center), round(entity.dxf.radius, 6)
        case _:
            return kind, layer, at(entity.dxf.location)


def near(one: object, other: object) -> bool:
    """The same, numbers to two nanometres."""
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(near, one, other))
    return abs(one - other) < 2.1e-6 if isinstance(one, float) else one == other


def failures(report: str) -> str:
    """What failed in a TAP report of node: each test's name, and its error."""
    failed = re.findall(r"^(?: *not ok .*\n)(?:(?! *(?:not )?ok |# ).*\n)*", report, re.M)
    return "".join(failed)[-6000:] or report[-6000:]


def test_units_in_node(tmp_path: Path) -> None:
    """The tests of web/test in node; then the drawings that they wrote are compared with those of `skg dxf`."""
    (tmp_path / "golden.json").write_text(json.dumps({name: golden(name) for name in TAPES}))
    (tmp_path / "signs.json").write_text(json.dumps([with_signs(chr(code)) for code in range(0xD800)]))
    (tmp_path / "debugger.json").write_text(json.dumps([debugger(stop) for stop in STOPS]))
    sources = sorted(WEB.glob("test/*.test.ts"))
    built = run(
        BIN / "esbuild",
        *sources,
        "--bundle",
        "--platform=node",
        "--format=esm",
        "--target=node20",
        "--log-level=warning",
        f"--outdir={tmp_path}",
        "--out-extension:.js=.mjs",
    )
    assert built.returncode == 0, built.stderr
    done = run("node", "--test", "--test-reporter=tap", *sorted(tmp_path.glob("*.mjs")), PAGE_TEST=str(tmp_path))
    assert done.returncode == 0, failures(done.stdout)
    for name, tape in TAPES.items():
        drawing = ezdxf.readfile(tmp_path / f"{name}.dxf")
        assert not drawing.audit().errors
        routes = place(tape, (0, 0), "programmed")
        wanted = drawn(routes, stop_places(tape, routes, (0, 0)))
        ours, theirs = (sorted(map(shape, one.modelspace()), key=str) for one in (drawing, wanted))
        assert len(ours) == len(theirs), name
        left = list(theirs)
        for one in ours:
            match = next((other for other in left if near(one, other)), None)
            assert match, (name, one)
            left.remove(match)
