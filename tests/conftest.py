"""What all tests share: the programs that they run are built once."""

from __future__ import annotations

import fcntl
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# A machine that stands still for some seconds says nothing about what is tested. The same sources are tried on the
# same examples, so that a failure is the change's; `make hunt` throws others.
settings.register_profile("same", deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True)
settings.register_profile("hunt", settings.get_profile("same"), derandomize=False)
settings.load_profile("same")

ROOT = Path(__file__).resolve().parents[1]


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
