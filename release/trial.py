"""Tries an installed skg: cuts all examples, and calls every command as people do. Runs in that package's Python.

    trial.py [FOLDER] [--skg PROGRAM]

Without a folder in one of its own, and the tapes are compared with examples/. With a folder, which has the examples and
a drawing, what the commands write, print and end with goes into it. PROGRAM is `skg` itself: else this Python runs it.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

#: Name -> a call of skg; `_` stands for a file of that name that the call writes.
CALLS = {
    "version": ["--version"],
    "help": ["--help"],
    "cut": ["cut", "bracket.dxf", "-o", "_bracket.3b", "--wire", "0.18", "--gap", "0.01", "--program", "_bracket.skg"],
    "again": ["cut", "bracket.dxf", "-o", "_bracket.3b", "--wire", "0.2", "--gap", "0.01"],
    "sheet": ["cut", "bracket.dxf", "-o", "_sheet.3b", "--wire", "0.18", "--sheet", "_sheet.pdf"],
    "chinese": ["cut", "\u652f\u67b6.dxf", "-o", "_\u652f\u67b6.3b", "--wire", "0.18"],
    "refused": ["cut", "wrench.3b", "-o", "_nothing.3b"],
    "nothing": ["run", "not-there.skg"],
    "check": ["check", "wrench.3b", "fit-gear.3b"],
    "sim": ["sim", "wrench.3b"],
    "json": ["sim", "--json", "wrench.3b"],
    "plot": ["plot", "wrench.3b", "-o", "_wrench.svg"],
    "picture": ["plot", "xy-star.skg", "-o", "_star.png"],
    "gcode": ["gcode", "wrench.3b"],
    "style": ["tape", "wrench.3b", "--style", "spaced"],
    "dxf": ["dxf", "wrench.3b", "-o", "_wrench.dxf"],
    "ref": ["ref", "fit-gear.skg"],
    "run": ["run", "fit-gear.skg"],
    "xy": ["xy", "xy-book-star.xy"],
    "tekhtran": ["tekhtran", "tkh-maltese.tkh"],
    "gear": ["gear", "--module", "2", "--teeth", "17"],
    "cam": ["cam", "--base", "20", "--lift", "8"],
    "term": ["term", "NO-PORT", "--batch"],
}


#: Calls that must be refused.
REFUSED = {"refused", "nothing", "term"}


def fill(folder: Path) -> None:
    """Copy the examples, a drawing, and it again under a Chinese name."""
    for file in (ROOT / "examples").iterdir():
        if file.is_file():
            shutil.copy(file, folder)
    for drawing in ("bracket.dxf", "\u652f\u67b6.dxf"):
        shutil.copy(ROOT / "docs" / "pictures" / "bracket.dxf", folder / drawing)


def judged(folder: Path) -> str:
    """Counts the right tapes, as a message; a wrong tape, or an unexpected exit code, is an error."""
    out = folder / "out"
    tapes = {part.with_suffix(".3b").name for part in (ROOT / "examples").glob("*.skg")}
    wrong = [name for name in sorted(tapes) if (out / name).read_bytes() != (ROOT / "examples" / name).read_bytes()]
    wrong += [name for name in CALLS if (out / f"{name}.code").read_text() != ("2" if name in REFUSED else "0")]
    wrong += [name for name in ("ui.html", "ui.js", "ui.3b") if not (out / name).stat().st_size]
    if wrong or len(tapes) < 40:
        raise SystemExit(f"not as they should be: {', '.join(wrong)}")
    return f"{len(tapes)} of {len(tapes)} examples, {len(CALLS)} calls, a tape by skg ui"


def cut_examples(out: Path) -> None:
    """Cut every example by the installed board, in this process."""
    import click

    from skg.cli import cli

    for part in sorted(Path.cwd().glob("*.skg")):
        paper = io.StringIO()
        try:
            with contextlib.redirect_stderr(paper):
                code = cli.main(["run", part.name, "-o", str(out / f"{part.stem}.3b")], standalone_mode=False)
        except (SystemExit, click.ClickException) as error:
            code = getattr(error, "code", 2)
        if code:
            print(f"{part.name}: exit {code}\n{paper.getvalue()}", file=sys.stderr)


def cut_on_screen(out: Path, skg: list[str]) -> None:
    """Cut the drawing as the page of `skg ui` does, and ask for the page."""
    command = [*skg, "ui", "--no-browser", "\u652f\u67b6.dxf"]
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE) as process:
        try:
            address, _, token = process.stdout.readline().decode().strip().partition("#token=")

            def ask(path: str, body: dict | None = None) -> bytes:
                data = json.dumps(body).encode() if body else None
                request = urllib.request.Request(address + path, data, {"Authorization": f"Bearer {token}"})
                with urllib.request.urlopen(request, timeout=600) as answer:
                    return answer.read()

            (out / "ui.html").write_bytes(ask(""))
            (out / "ui.js").write_bytes(ask("ui.js"))
            state = json.loads(ask("api/state"))
            while state["name"] is None:
                # (empty: nothing new for a while)
                state = json.loads(ask(f"api/state?after={state['rev']}") or "null") or state
            number = json.loads(ask("api/cut", {"rev": state["rev"]}))["run"]
            while (run := json.loads(ask(f"api/run/{number}")))["state"] == "running":
                ask(f"api/run/{number}?after={run['k']}")
            if run["state"] != "done":
                raise SystemExit(f"skg ui: {run}")
            (out / "ui.3b").write_bytes(ask(f"api/run/{number}/tape"))
        finally:
            process.kill()


def main(folder: Path, skg: list[str]) -> None:
    """Cut and call; each call in a process of its own, its output through pipes."""
    os.chdir(folder)
    out = folder / "out"
    out.mkdir()
    cut_examples(out)
    for name, call in CALLS.items():
        words = [str(out / word[1:]) if word.startswith("_") else word for word in call]
        done = subprocess.run([*skg, *words], stdin=subprocess.DEVNULL, capture_output=True)
        (out / f"{name}.stdout").write_bytes(done.stdout)
        (out / f"{name}.stderr").write_bytes(done.stderr)
        (out / f"{name}.code").write_text(str(done.returncode))
    cut_on_screen(out, skg)


if __name__ == "__main__":
    options = argparse.ArgumentParser(description="Try an installed skg.")
    options.add_argument("folder", nargs="?", type=lambda name: Path(name).resolve())
    options.add_argument("--skg", type=lambda name: [str(Path(name).resolve())], default=[sys.executable, "-m", "skg"])
    chosen = options.parse_args()
    if chosen.folder:
        main(chosen.folder, chosen.skg)
    else:
        with tempfile.TemporaryDirectory(prefix="skg-trial-") as own:
            fill(Path(own).resolve())
            main(Path(own).resolve(), chosen.skg)
            print(f"Python {platform.python_version()}, {platform.platform()}: {judged(Path(own).resolve())}")
            os.chdir(ROOT)
