"""Setups that are kept under a name: what they say, what beats them, what is wrong with one."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from cuthelp import drawing, polygon, saved
from toolhelp import Run

from skg.commands.cut import command
from skg.commands.options import kept_setups
from skg.errors import UserError
from skg.job import file as job_files
from skg.job.job import Job, TapeForm
from skg.job.setups import Setups
from skg.job.wanted import CutSettings

SETUP = """[machine]
wire = 0.2
gap = 0.01
feed = 8
[default]
passes = [0.05, 0]
[tape]
style = "numbered"
"""


@pytest.fixture
def setups(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Setups:
    """The setups of a user who has one."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    setups = kept_setups()
    assert setups.folder.is_relative_to(tmp_path)
    setups.keep("细丝 0.2", job_files.decoded_setup(SETUP.encode(), "a"))
    return setups


def part(folder: Path) -> Path:
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page, layer="PART")
    return saved(page, folder)


def findings(run: Run, *words: object) -> dict[str, dict]:
    done = run("cut", *words, "--json")
    assert done.exit_code == 0, done.stderr
    return {finding["code"]: finding["values"] for finding in json.loads(done.stderr)["findings"]}


def test_a_setup_comes_back(setups: Setups) -> None:
    kept = setups.kept("细丝 0.2")
    assert kept["machine"] == {"wire": 0.2, "gap": 0.01, "feed": 8.0} and kept["default"] == {"passes": (0.05, 0.0)}
    assert job_files.decoded_setup(job_files.encoded_setup(kept), "a") == kept
    assert setups.names() == ["细丝 0.2"] and setups.last() == ""
    setups.note_last("细丝 0.2")
    assert setups.last() == "细丝 0.2"
    setups.drop("细丝 0.2")
    assert setups.names() == [] and setups.last() == ""


def test_the_command_line_and_the_job_beat_it(run: Run, tmp_path: Path, setups: Setups) -> None:
    """The tape is that of the same options; what is given beats the setup, which the report names, with what it set."""
    path, made, other, job = part(tmp_path), tmp_path / "a.3b", tmp_path / "b.3b", tmp_path / "a.job.toml"
    told = findings(run, path, "-o", made, "--setup", "细丝 0.2", "--feed", "5", "--save-job", job)
    assert told["setup-used"]["name"] == "细丝 0.2" and told["cut-length"]["pace"]["values"] == {"feed": 5}
    assert not any("feed" in text for text in told["setup-used"]["settings"])
    findings(run, path, "-o", other, "--wire", 0.2, "--gap", 0.01, "--passes", "0.05,0", "--style", "numbered")
    assert made.read_bytes() == other.read_bytes() and made.read_bytes().startswith(b"N   1: B ")
    # (saved, the job has all of it)
    assert "setup-used" not in findings(run, job, "-o", other) and made.read_bytes() == other.read_bytes()
    job.write_text('schema = 1\ndrawing = "part.dxf"\n[machine]\noffset = 0.3\nfeed = 5\n[default]\npasses = [0]\n')
    told = findings(run, job, "-o", made, "--setup", "细丝 0.2")
    assert told["setup-used"]["settings"] == ['style = "numbered"'] and told["cut-length"]["pace"]["values"] == {
        "feed": 5
    }
    findings(run, path, "-o", other, "--offset", 0.3, "--style", "numbered")
    assert made.read_bytes() == other.read_bytes()
    assert "细丝 0.2" in run("cut", path, "-o", made, "--setup", "细丝 0.2", "--quiet").stderr


@pytest.mark.parametrize(
    "name", ["", ".", "../a", "a/b", "a\\b", "NUL", "con.x", "a ", ".a", "a\n", "a\x1b[2J", "x" * 61]
)
def test_names_that_no_file_has(name: str, setups: Setups) -> None:
    for call in (setups.kept, setups.is_kept, setups.drop, lambda name: setups.keep(name, {})):
        with pytest.raises(UserError) as failed:
            call(name)
        assert failed.value.finding.code == "bad-setup-name"
    assert [path.name for path in setups.folder.iterdir()] == ["细丝 0.2.toml"]


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"[machine", "not-toml"),
        (b"\xff", "not-toml"),
        (b"wire = 0.2", "unknown-key"),
        (b"[machine]\nthickness = 3", "unknown-key"),
        (b"[machine]\nwire = -1", "wrong-value"),
        (b"[machine]\nwire = 0.2\noffset = 0.1", "offset-and-wire"),
        (b"[tape]\nstyle = 'none'", "wrong-value"),
    ],
)
def test_damaged_files(run: Run, tmp_path: Path, setups: Setups, data: bytes, code: str) -> None:
    (setups.folder / "bad.toml").write_bytes(data)
    made = tmp_path / "a.3b"
    done = run("cut", part(tmp_path), "-o", made, "--setup", "bad", "--json")
    error = json.loads(done.stderr)["error"]
    assert error["severity"] == "error"
    assert done.exit_code == 2 and error["code"] == code and str(setups.folder / "bad.toml") in str(error["source"])
    assert not made.exists()


def test_an_unknown_setup(run: Run, tmp_path: Path, setups: Setups) -> None:
    for name, code in (("细丝", "no-setup-near"), ("nix", "no-setup")):
        done = run("cut", part(tmp_path), "--setup", name, "--json")
        assert done.exit_code == 2 and json.loads(done.stderr)["error"]["code"] == code
    (setups.folder / "dir.toml").mkdir()
    with pytest.raises(IsADirectoryError):
        setups.kept("dir")


def test_the_form_of_the_tape(run: Run, tmp_path: Path) -> None:
    """A control with names of eight letters, and a machine that reads no 3B at all."""
    path = part(tmp_path)
    for name, code in (("too-long-9.3b", "name-not-short"), ("零件.3b", "name-not-short"), ("PART-1.3b", "")):
        done = run("cut", path, "-o", tmp_path / name, "--short-name", "--json")
        assert json.loads(done.stderr).get("error", {}).get("code", "") == code
        assert (tmp_path / name).exists() == (not code)
    done = run("cut", path, "-o", tmp_path / "a.nc", "--machine", "wire-iso", "--style", "spaced", "--json")
    assert json.loads(done.stderr)["error"]["code"] == "tape-of-machine"


def test_a_setting_that_is_not_given_is_the_jobs_default() -> None:
    """Options that nobody gives are left to the job: it has their defaults."""
    job = Job("a.dxf")
    parts = (job.read, job.setup, job.board, job.policy, TapeForm(), CutSettings())
    usual = {name: value for part in parts for name, value in vars(part).items()}
    both = {
        one.name: one.default
        for one in command.params
        if one.name in usual and isinstance(one.default, str | int | float)
    }
    assert len(both) > 15 and both == {name: usual[name] for name in both}
