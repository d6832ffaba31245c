"""The programs that all tests run, built once; node of the virtual environment; one line about what was skipped."""

from __future__ import annotations

import fcntl
import gc
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import coded
import kept
import prose
import pytest
from hypothesis import HealthCheck, settings

# A machine that stands still for some seconds says nothing about what is tested. The same sources are tried on the
# same examples, so that a failure is the change's; `make hunt` throws others.
settings.register_profile(
    "same", max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True
)
settings.register_profile("hunt", settings.get_profile("same"), max_examples=500, derandomize=False)
settings.load_profile("same")

ROOT = Path(__file__).resolve().parents[1]

# (as the command line does)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# The messages are those of the English catalogue, whatever this machine speaks.
os.environ["LC_ALL"] = "C.UTF-8"

# The setups of whoever runs the tests are not theirs.
os.environ["XDG_CONFIG_HOME"] = str(ROOT / "build" / "config")

# Each time that garbage is looked for costs what all tests and modules are that are alive.
gc.set_threshold(100_000)

# Node, where it came out of a Python package (make).
os.environ["PATH"] += os.pathsep + str(Path(sys.executable).parent)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--kept", action="store_true", help="leave out what passed before, all that it reads as it is now")
    parser.addoption("--keys", action="store_true", help="no test opens what is not in its key (tests/kept.py)")
    parser.addoption(
        "--codes", action="store_true", help="messages are codes and values; tests of wording are left out"
    )


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "wording: a test of sentences, of the catalogues or of the pages that show them")
    prose.watch()
    if config.getoption("--codes"):
        coded.replace()
        os.environ["PYTHONPATH"] = os.pathsep.join(
            filter(None, [str(Path(__file__).with_name("coded_processes")), os.environ.get("PYTHONPATH")])
        )
    # (who says SKG_SEED or another ROM wants other tests)
    if config.getoption("--kept") and not any(name.startswith("SKG_") for name in os.environ):
        config.pluginmanager.register(kept.Plugin(config, ROOT))
    if config.getoption("--keys"):
        config.pluginmanager.register(kept.Watch(ROOT))


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """With --codes, leave out what tests wording: what is left must hold facts, so that a sentence can be reworded."""
    if config.getoption("--codes"):
        of_wording = [item for item in items if item.get_closest_marker("wording")]
        config.hook.pytest_deselected(items=of_wording)
        items[:] = [item for item in items if not item.get_closest_marker("wording")]


def pytest_sessionfinish() -> None:
    """Leave thousands of tests out of what pytest looks through for garbage, five times at the end: a second each."""
    gc.freeze()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print one line: how many tests were skipped for want of what, which their reasons say."""
    reports = terminalreporter.stats.get("skipped", [])
    reasons = Counter(str(report.longrepr[2]).removeprefix("Skipped: ") for report in reports)
    if reasons:
        terminalreporter.write_line(
            "Skipped: " + "; ".join(f"{count}: {why}" for why, count in sorted(reasons.items()))
        )


@pytest.fixture(autouse=True)
def chinese_values() -> Iterator[None]:
    """No message that a test makes has an English sentence among its values."""
    prose.found.clear()
    yield
    assert not prose.found, f"English on a Chinese screen: {prose.found[:3]}"


@pytest.fixture(scope="session")
def build() -> Callable[..., None]:
    """Call it with make's targets (and options); one of several test processes builds, the others wait."""

    def make(*targets: str) -> None:
        (ROOT / "build").mkdir(exist_ok=True)
        with (ROOT / "build" / "emu.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            done = subprocess.run(["make", "-s", *targets], cwd=ROOT, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr

    return make
