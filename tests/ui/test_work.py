"""The page's calls as a page makes them: open, plan, ways, cut, save; and the tape is the command line's."""

from __future__ import annotations

import os
import random
import re
import shutil
import signal
from collections.abc import Callable
from pathlib import Path
from threading import Thread, Timer

import ezdxf
import pytest
from click.testing import CliRunner
from ezdxf import transform, units
from facthelp import says
from uihelp import Json, Page, circles, english, plate, until

from skg.cli import cli
from skg.ui.server import Server

ROOT = Path(__file__).parents[2]


def skg(*words: object) -> str:
    """Run a command that must end well; what it says."""
    result = CliRunner(mix_stderr=False).invoke(cli, [str(word) for word in words], catch_exceptions=False)
    assert result.exit_code == 0, result.stderr
    return result.stderr


def test_nothing_is_open(page: Page) -> None:
    state = page.done("GET", "/api/state")
    assert (state["name"], state["can_save"]) == (None, False)
    for method, path, body in (
        ("PUT", "/api/job", {"rev": state["rev"], "job": {"schema": 1, "drawing": "x.dxf"}}),
        ("POST", "/api/ways", {"rev": state["rev"], "ids": [0]}),
        ("GET", "/api/job", None),
        ("GET", "/api/run/1", None),
        ("DELETE", "/api/run/1", None),
        ("GET", "/api/run/1/tape", None),
        ("POST", "/api/save", {"run": 1, "what": ["tape"]}),
    ):
        answer = page.call(method, path, body)
        assert answer.status == 400 and answer.message, path
    run = page.cut(state["rev"])[1]
    assert run["state"] == "failed" and run["error"]["code"] == "page-no-drawing"


def test_drawing(page: Page, tmp_path: Path) -> None:
    state = page.open(plate(tmp_path))
    assert (state["name"], state["size"], state["low"], state["units"]) == ("plate.dxf", [60, 30], [0, 0], "mm")
    assert [(layer["name"], layer["contours"]) for layer in state["layers"]] == [("HOLES", [1, 2]), ("PART", [0])]
    assert [(one["id"], one["kind"], one["depth"], one["size"]) for one in state["contours"]] == [
        (0, "outline", 0, [60, 30]),
        (1, "opening", 1, [12, 12]),
        (2, "opening", 1, [12, 12]),
    ]
    assert state["contours"][0]["edges"][0] == [0, 0, 60, 0]
    (circle,) = state["contours"][1]["edges"]
    assert circle[4:6] == [15, 15] and abs(circle[6]) == pytest.approx(6.283185)
    assert page.state() == state


def test_plan_and_ways(page: Page, tmp_path: Path) -> None:
    state = page.open(plate(tmp_path))
    state |= page.put(state, machine={"wire": 0.18, "gap": 0.01}, default={"passes": [0.05, 0], "tab": 4})
    assert state["plan"]["order"][-1] == 0
    outline = state["plan"]["contours"]["0"]
    assert (outline["number"], outline["passes"], outline["radius"]) == (3, [0.15, 0.1], 0.1)
    assert outline["values"]["tab"] == 4 and outline["tab"] and len(outline["tabs"]) == 1
    ways = page.done("POST", "/api/ways", {"rev": state["rev"], "ids": [0, 1]})["ways"]
    # (two passes and the tab; two passes)
    assert [len(ways[name]) for name in ("0", "1")] == [3, 2]
    for way, aside in zip(ways["0"][:2], (0.15, 0.1), strict=True):
        assert {round(-aside, 4), round(30 + aside, 4)} <= {edge[1] for edge in way if edge[1] == edge[3]}
    for way in ways["0"]:
        assert way[0][:2] in (outline["hole"], outline["tabs"][0][2])
        assert all(before[2:4] == after[0:2] for before, after in zip(way, way[1:], strict=False))


def test_contour_by_itself(page: Page, tmp_path: Path) -> None:
    """A contour's settings override its layer's, and those the job's."""
    state = page.open(plate(tmp_path))
    first, second = ({key: one[key] for key in ("layer", "kind", "at", "size")} for one in state["contours"][1:])
    state |= page.put(
        state,
        machine={"offset": 0.1},
        layer=[{"name": "HOLES", "offset": 0.2, "side": "inside"}],
        contour=[second | {"cut": False}, first | {"start": [16, 15], "entry": [15, 21], "offset": 0.3}],
    )
    assert state["plan"]["order"] == [1, 0] and not state["plan"]["error"]
    contours = state["plan"]["contours"]
    assert contours["2"]["cut"] is False and contours["2"]["values"]["offset"] == 0.2
    assert contours["1"]["hole"] == [16, 15] and contours["1"]["entry"] == [15, 21]
    assert [contours[name]["values"]["offset"] for name in "012"] == [pytest.approx(0.1), 0.3, 0.2]
    assert [(one["chosen"], one["id"]) for one in state["matches"]] == [(0, 2), (1, 1)]


def test_what_has_changed_alone_is_told(page: Page, tmp_path: Path) -> None:
    """Edits at random: the plan that the page puts together is the whole one, and most answers are shorter."""
    dice = random.Random(26)
    state, shorter = page.open(circles(tmp_path, 30)), 0
    for _ in range(40):
        some = dice.sample(state["contours"], dice.randint(0, 4))
        chosen = []
        for contour in some:
            x, y = contour["at"]
            wish = dice.choice([{"cut": False}, {"start": [x - 3, y + dice.random()]}, {"tab": 1}, {"order": 3}])
            chosen.append({name: contour[name] for name in ("layer", "kind", "at", "size")} | wish)
        job = {"machine": dice.choice([{}, {}, {"offset": 0.1}]), "contour": chosen}
        answer = page.done("PUT", "/api/job", {"rev": state["rev"], "job": state["job"] | job})
        told = answer["plan"]["contours"]
        shorter += len(told) < 30
        answer["plan"]["contours"] = state["plan"]["contours"] | told
        state |= answer
        assert state["plan"] == page.state()["plan"]
    assert shorter > 20


def test_wire_without_open_lines(page: Page, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A drawing that has no open lines is not read anew because these would be refused beside a wire."""
    for name, more, is_same in (("closed.dxf", (), True), ("open.dxf", ((5, 50), (25, 50)), False)):
        path = plate(tmp_path, name)
        if more:
            document = ezdxf.readfile(path)
            document.modelspace().add_line(*more)
            document.saveas(path)
        state = page.open(path)
        put = page.put(state, machine={"offset": 0.1})
        assert ("contours" not in put) == is_same and bool(put.get("error")) != is_same


def test_large_drawing_is_told_of_before_its_plan(
    serve: Callable[[], Server], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is there once, and what was set of it meanwhile is no conflict with its plan."""
    session = (server := serve()).session
    page, path, answers = Page(server), circles(tmp_path, 1200), []
    rev, take = page.done("GET", "/api/state")["rev"], session._take_early

    def halting(*found: object) -> None:
        os.kill(session._worker._process.pid, signal.SIGSTOP)
        take(*found)

    monkeypatch.setattr(session, "_take_early", halting)
    opening = Thread(target=lambda: answers.append(page.open(path)))
    opening.start()
    early = page.done("GET", f"/api/state?after={rev}")
    assert early["plan"] is None and not early.get("error") and len(early["contours"]) == 1200
    os.kill(session._worker._process.pid, signal.SIGCONT)
    body = {"rev": early["rev"], "job": early["job"] | {"machine": {"offset": 0.1}}}
    put = page.done("PUT", "/api/job", body)
    opening.join()
    (opened,) = answers
    assert opened["drawn"] == early["drawn"] and len(opened["plan"]["contours"]) == 1200
    assert "contours" not in put and put["job"]["machine"]["offset"] == 0.1
    assert page.call("PUT", "/api/job", body).status == 409


def test_thin_wall_is_told_of_before_the_cut(page: Page, tmp_path: Path) -> None:
    """Its line is that of the cut: who has decided on it is not asked again."""
    path = plate(tmp_path)
    document = ezdxf.readfile(path)
    document.modelspace().add_circle((27.3, 15), 6, dxfattribs={"layer": "HOLES"})
    document.saveas(path)
    state = page.open(path)
    assert not [said for said in state["plan"]["said"] if said["code"] == "thin-wall"]
    put = page.put(state, machine={"wire": 0.2})
    (wall,) = [said for said in put["plan"]["said"] if said["code"] == "thin-wall"]
    assert wall["care"] and wall["place"] == pytest.approx([21.15, 15], abs=0.01) and wall["contour"] in (1, 3)
    _, run = page.cut(put["rev"])
    assert [said for said in run["result"]["lines"] if said["code"] == "thin-wall"] == [wall]


def test_what_is_left_is_shown(page: Page, tmp_path: Path) -> None:
    """Lines and texts of dimensions, the edge of a hatch, texts of SVG; none of them is cut."""
    path = plate(tmp_path)
    document = ezdxf.readfile(path)
    space = document.modelspace()
    space.add_linear_dim((30, 45), (0, 30), (60, 30), dxfattribs={"layer": "NOTES"}).render()
    space.add_hatch(dxfattribs={"layer": "NOTES"}).paths.add_polyline_path([(2, 2), (8, 2), (8, 8)])
    document.saveas(path)
    state = page.open(path)
    left = state["left"]
    assert len(state["contours"]) == 3 and "60" in "".join(note["text"] for note in left["notes"])
    lines = [{tuple(edge[:2]), tuple(edge[2:])} for edge in left["edges"] if len(edge) == 4]
    assert all({end, after} in lines for end, after in (((2, 2), (8, 2)), ((8, 2), (8, 8)), ((8, 8), (2, 2))))
    assert any(max(y for _, y in line) == pytest.approx(45) for line in lines)
    path = tmp_path / "note.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm" viewBox="0 0 90 90">'
        '<rect x="5" y="5" width="50" height="40"/><g transform="translate(10 20)" style="font-size:6px">'
        '<text x="1" y="2">Part <tspan>A1</tspan><tspan x="1" dy="7">second</tspan></text></g></svg>'
    )
    notes = page.open(path)["left"]["notes"]
    assert [(note["text"], note["place"]) for note in notes] == [("Part A1", [11, 68]), ("second", [11, 61])]
    assert notes[0]["up"] == [0, 4.2]


def test_errors_of_a_contour(page: Page, tmp_path: Path) -> None:
    """An error in one contour is reported with its number, and the others are planned all the same."""
    state = page.open(plate(tmp_path))
    which = {key: state["contours"][0][key] for key in ("layer", "kind", "at", "size")}
    state |= page.put(state, machine={"offset": 0.1}, contour=[which | {"start": [30, 28]}])
    plan = state["plan"]
    assert plan["error"]["contour"] == 0 and plan["contours"]["0"]["error"] == plan["error"]
    assert sorted(plan["order"]) == [0, 1, 2]
    run = page.cut(state["rev"])[1]
    assert run["state"] == "failed" and run["error"]["contour"] == 0


def test_bad_jobs(page: Page, tmp_path: Path) -> None:
    state = page.open(plate(tmp_path))
    for job, fact in (
        ({"tabb": 1}, "tabb"),
        ({"default": {"tabb": 1}}, "tab"),
        ({"machine": {"wire": -1}}, "wire"),
        ({"machine": {"wire": "thick"}}, "wire"),
        ({"drawing": "other.dxf"}, "other.dxf"),
        ({"drawing": "../plate.dxf"}, "drawing"),
        ({"contour": [{"layer": "PART"}]}, "kind"),
        ({"schema": 99}, "schema"),
    ):
        answer = page.call("PUT", "/api/job", {"rev": state["rev"], "job": state["job"] | job})
        assert answer.status == 400 and fact in answer.message
    assert page.state()["rev"] == state["rev"]


def test_other_units(page: Page, tmp_path: Path) -> None:
    """With other units in the job the drawing is read again."""
    state = page.open(plate(tmp_path))
    answer = page.put(state, read={"units": "inch"})
    assert answer["size"] == [60 * 25.4, 30 * 25.4] and answer["drawn"] > state["drawn"]
    back = page.put(answer, read={})
    assert back["size"] == [60, 30]


@pytest.mark.parametrize("far", [0, 1_000_000])
def test_drawing_that_cannot_be_read(page: Page, tmp_path: Path, far: int) -> None:
    """It is open, and says what is wrong, and where the page shows it; other options of reading may do."""
    path = plate(tmp_path)
    document = ezdxf.readfile(path)
    document.header["$INSUNITS"] = units.MM
    document.modelspace().add_line((100, 0), (120, 0))
    transform.translate(document.modelspace(), (far, 0, 0))
    document.saveas(path)
    state = page.open(path)
    answer = page.put(state, machine={"offset": 0.1})
    assert answer["error"]["place"] == [100, 0]
    assert "open" in english(answer["error"]) and answer["contours"] == state["contours"]
    run = page.cut(answer["rev"])[1]
    assert english(run["error"]) == english(answer["error"])
    assert page.call("POST", "/api/ways", {"rev": answer["rev"], "ids": [0]}).status == 400
    answer = page.put(answer, read={"open": "leave"})
    assert len(answer["contours"]) == 3 and not answer.get("error")
    for data in (b"", b"no drawing", bytes(1000), b"\xff" * 1000):
        state = page.done("POST", "/api/open", data, X_Name="x.dxf")
        assert english(state["error"]) and state["contours"] == [] and state["name"] == "x.dxf"


def test_two_tabs(page: Page, tmp_path: Path) -> None:
    """The second one's change is refused, and it is told what is now."""
    state = page.open(plate(tmp_path))
    new = page.put(state, machine={"offset": 0.1})
    for method, path, body in (
        ("PUT", "/api/job", {"job": state["job"]}),
        ("POST", "/api/ways", {"ids": [0]}),
        ("POST", "/api/cut", {}),
    ):
        answer = page.call(method, path, body | {"rev": state["rev"]})
        assert answer.status == 409 and answer.json["state"]["rev"] == new["rev"]
        assert answer.json["state"]["job"]["machine"] == {"offset": 0.1}


def test_news(page: Page, tmp_path: Path) -> None:
    """A request for news is answered when they come; the drawing is sent only when it has changed."""
    state = page.open(plate(tmp_path))
    Timer(0.5, page.put, (state,), {"machine": {"offset": 0.1}}).start()
    news = page.done("GET", f"/api/state?after={state['rev']}&drawn={state['drawn']}")
    assert news["rev"] > state["rev"] and news["job"]["machine"] == {"offset": 0.1}
    assert news["drawn"] != state["drawn"] or "contours" not in news
    state = page.state()
    Timer(0.5, page.put, (state,), {"default": {"lead": 2}}).start()
    news = page.done("GET", f"/api/state?after={state['rev']}&drawn={state['drawn']}")
    assert news["drawn"] == state["drawn"] and "contours" not in news and news["plan"]
    assert "contours" in page.done("GET", f"/api/state?after=0&drawn={state['drawn'] - 1}")


def test_no_news(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    from skg.ui import server

    monkeypatch.setattr(server, "PATIENCE", 0.5)
    monkeypatch.setattr(server, "GLANCE", 0.1)
    rev = page.done("GET", "/api/state")["rev"]
    answer = page.call("GET", f"/api/state?after={rev}")
    assert (answer.status, answer.body) == (204, b"")


@pytest.mark.wording
def test_cut(page: Page, tmp_path: Path) -> None:
    """The tape and what belongs to it, as `skg cut` makes them."""
    path = plate(tmp_path)
    state = page.open(path)
    rev = page.put(state, machine={"wire": 0.18, "gap": 0.01})["rev"]
    number, run = page.cut(rev)
    assert run["state"] == "done", run
    tape, program = tmp_path / "one.nodrift.3b", tmp_path / "one.skg"
    said = skg("cut", path, "--wire", 0.18, "--gap", 0.01, "-o", tape, "--program", program).splitlines()
    assert page.get(f"/api/run/{number}/tape").body == tape.read_bytes()
    assert page.get(f"/api/run/{number}/program").body == program.read_bytes()
    assert [english(line) for line in run["result"]["lines"]] == said
    blocks = tape.read_bytes().count(b"G")
    texts = {line["code"]: line["text"] for line in run["result"]["lines"]}
    for language, figures in enumerate(run["result"]["figures"]):
        off, *others = figures.split(" · ")
        assert re.search(r"[\d.]+ µm", off)[0] in texts["checked"][language]
        assert str(blocks) in others[0] and len(others) == 4
        assert all(figure in texts["cut-length"][language] for figure in others), (others, texts["cut-length"])
    assert run["result"]["tape_name"] == "plate.nodrift.3b"
    assert page.get(f"/api/run/{number}/sheet").body.startswith(b"%PDF")
    assert b"<svg" in page.get(f"/api/run/{number}/sheet.svg").body
    (tmp_path / "plate.job.toml").write_bytes(page.get(f"/api/run/{number}/job").body)
    skg("cut", tmp_path / "plate.job.toml", "-o", tmp_path / "two.nodrift.3b")
    assert (tmp_path / "two.nodrift.3b").read_bytes() == tape.read_bytes()
    state = page.state()
    assert (state["run"], state["run_rev"]) == (number, rev)


def test_runs_that_are_over(page: Page, tmp_path: Path) -> None:
    state = page.open(plate(tmp_path))
    first, _ = page.cut(state["rev"])
    second, run = page.cut(state["rev"])
    assert second > first
    assert page.call("GET", f"/api/run/{first}").status == 400
    assert page.done("GET", f"/api/run/{second}?after={run['k']}")["state"] == "done"
    assert page.done("DELETE", f"/api/run/{second}")["state"] == "done"
    assert page.get(f"/api/run/{second}/tape").status == 200


def test_dropped_is_not_saved(page: Page, tmp_path: Path) -> None:
    state = page.open(plate(tmp_path))
    number, _ = page.cut(state["rev"])
    answer = page.call("POST", "/api/save", {"run": number, "what": ["tape"], "overwrite": True})
    assert answer.status == 400 and not list(tmp_path.glob("*.3b"))


@pytest.fixture
def saving(serve: Callable[[Path], Server], tmp_path: Path) -> tuple[Page, Json, int]:
    """A page of a drawing that was named on the command line, its state, and a run that is done."""
    page = Page(serve(plate(tmp_path)))
    state = page.state()
    assert state["can_save"]
    return page, state, page.cut(state["rev"])[0]


def test_save(saving: tuple[Page, Json, int], tmp_path: Path) -> None:
    page, _, number = saving
    every = {"run": number, "what": ["tape", "program", "sheet", "job"], "overwrite": False}
    names = page.done("POST", "/api/save", every)["written"]
    assert sorted(names) == ["plate.job.toml", "plate.nodrift.3b", "plate.pdf", "plate.skg"]
    for name, what in (("plate.nodrift.3b", "tape"), ("plate.skg", "program"), ("plate.job.toml", "job")):
        assert (tmp_path / name).read_bytes() == page.get(f"/api/run/{number}/{what}").body
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*names, "plate.dxf"])


def test_a_punch_and_its_die(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    """A clearance: a run has both, each with files of its own, which are saved together, or none where one is there."""
    page = Page(serve(plate(tmp_path)))
    state = page.state()
    state |= page.put(state, machine={"offset": 0.1}, default={"clearance": 0.02, "clearance_on": "die"})
    number, run = page.cut(state["rev"])
    result = run["result"]
    assert (result["tape_name"], result["mate"]["tape_name"]) == ("plate-punch.nodrift.3b", "plate-die.nodrift.3b")
    codes = [line["code"] for line in result["lines"]]
    assert codes.index("pair-punch") < codes.index("pair-die")
    (tmp_path / "plate-die.nodrift.3b").write_text("mine")
    body = {"run": number, "what": ["tape", "job", "holes"], "overwrite": False}
    assert page.call("POST", "/api/save", body).json["exists"] == ["plate-die.nodrift.3b"]
    assert not (tmp_path / "plate-punch.nodrift.3b").exists()
    names = page.done("POST", "/api/save", body | {"overwrite": True})["written"]
    assert len(names) == 5 and names[-2:] == ["plate-punch.nodrift.3b", "plate-die.nodrift.3b"]
    skg("cut", tmp_path / "plate.job.toml", "-o", tmp_path / "own.nodrift.3b")
    for member in ("punch", "die"):
        tape = (tmp_path / f"plate-{member}.nodrift.3b").read_bytes()
        assert tape == (tmp_path / f"own-{member}.nodrift.3b").read_bytes()
        assert page.get(f"/api/run/{number}/tape?member={member}").body == tape
    short = body | {"overwrite": True, "what": ["tape"], "short": True}
    assert page.done("POST", "/api/save", short | {"name": "TOOL"})["written"] == ["TOOL-P.3b", "TOOL-D.3b"]
    assert page.call("POST", "/api/save", short | {"name": "TOOLTOOL"}).status == 400


def test_save_asks(saving: tuple[Page, Json, int], tmp_path: Path) -> None:
    """Nothing is written over what is there unless it is said, and then all of it takes the old one's place."""
    page, _, number = saving
    (tmp_path / "plate.skg").write_text("mine")
    (tmp_path / "plate.nodrift.3b").mkdir()
    body = {"run": number, "what": ["tape", "program"], "overwrite": False}
    answer = page.call("POST", "/api/save", body)
    assert answer.status == 409 and sorted(answer.json["exists"]) == ["plate.nodrift.3b", "plate.skg"]
    for false in (None, 0, "yes", 1, [True]):
        assert page.call("POST", "/api/save", body | {"overwrite": false}).status == 409
    assert (tmp_path / "plate.skg").read_text() == "mine"
    answer = page.call("POST", "/api/save", body | {"overwrite": True})
    # (the tape is a folder: that is seen before anything is written)
    assert answer.status == 400 and says(answer.message, "plate.nodrift.3b")
    assert (tmp_path / "plate.skg").read_text() == "mine"
    (tmp_path / "plate.nodrift.3b").rmdir()
    assert page.done("POST", "/api/save", body | {"overwrite": True})["written"] == ["plate.skg", "plate.nodrift.3b"]
    for what in (["exe"], [None], [["tape"]], [7], ["tape", "../x"]):
        assert page.call("POST", "/api/save", body | {"what": what}).status == 400


def test_save_of_the_job_alone(saving: tuple[Page, Json, int], tmp_path: Path) -> None:
    page, state, _ = saving
    page.put(state, default={"lead": 2})
    assert page.done("POST", "/api/save", {"run": None, "what": ["job"]})["written"] == ["plate.job.toml"]
    assert "lead = 2" in (tmp_path / "plate.job.toml").read_text()
    assert page.get("/api/job").body == (tmp_path / "plate.job.toml").read_bytes()
    assert page.call("POST", "/api/save", {"run": None, "what": ["tape"]}).status == 400


def test_standard_rom_has_another_name(saving: tuple[Page, Json, int]) -> None:
    page, state, _ = saving
    rev = page.put(state, machine={"rom": "standard"})["rev"]
    assert page.cut(rev)[1]["result"]["tape_name"] == "plate.3b"


def test_job_file(serve: Callable[[Path], Server], tmp_path: Path, page: Page) -> None:
    """A job file from the command line, and one that is dropped on its drawing."""
    drawing = plate(tmp_path)
    job = tmp_path / "mine.job.toml"
    job.write_text('schema = 1\ndrawing = "plate.dxf"\n[machine]\nwire = 0.2\n')
    state = Page(serve(job)).state()
    assert (state["name"], state["job"]["machine"], state["can_save"]) == ("plate.dxf", {"wire": 0.2}, True)
    one = Page(serve(job))
    one.state()
    assert one.call("POST", "/api/save", {"run": None, "what": ["job"]}).json["exists"] == ["mine.job.toml"]
    assert page.call("POST", "/api/open", job.read_bytes(), X_Name="mine.job.toml").status == 400
    page.open(drawing)
    assert page.open(job)["job"]["machine"] == {"wire": 0.2}
    for text in (
        "schema = 1",
        "[[[",
        'schema = 1\ndrawing = "x.dxf"',
        "\0",
        'schema = 1\ndrawing = "plate.dxf"\ntab=1',
    ):
        answer = page.call("POST", "/api/open", text.encode(), X_Name="mine.job.toml")
        assert answer.status == 400 and answer.message
    assert page.state()["job"]["machine"] == {"wire": 0.2}


def test_saved_again(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    """A changed drawing is read again, and its contours are found in it."""
    page = Page(serve(plate(tmp_path)))
    state = page.state()
    which = {key: state["contours"][1][key] for key in ("layer", "kind", "at", "size")}
    state |= page.put(state, contour=[which | {"cut": False}])
    assert state["plan"]["order"] == [2, 0]
    plate(tmp_path, holes=1)
    new = page.done("GET", f"/api/state?after={state['rev']}")
    assert len(new["contours"]) == 2 and new["drawn"] > state["drawn"] and new["sha256"] != state["sha256"]
    assert new["matches"] == [{"chosen": 0, "id": 1, "moved": 0, "confirm": False}]
    assert new["plan"]["order"] == [0] and new["job"]["contour"][0]["cut"] is False
    # (the page of before is told)
    assert page.call("POST", "/api/cut", {"rev": state["rev"]}).status == 409


def test_saved_again_without_a_contour(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    page = Page(serve(plate(tmp_path)))
    state = page.state()
    which = {key: state["contours"][2][key] for key in ("layer", "kind", "at", "size")}
    state |= page.put(state, contour=[which | {"cut": False}])
    plate(tmp_path, holes=1)
    new = page.done("GET", f"/api/state?after={state['rev']}")
    assert new["matches"][0]["id"] is None and new["plan"]["error"]["code"] == "contour-lost"
    assert new["plan"]["order"] == [1, 0] and len(new["job"]["contour"]) == 1
    assert page.cut(new["rev"])[1]["state"] == "failed"
    del new["job"]["contour"]
    assert page.cut(page.put(new)["rev"])[1]["state"] == "done"


def test_saved_again_with_a_contour_elsewhere(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    """A contour found at another place is to be confirmed, until somebody chooses it again."""
    page = Page(serve(plate(tmp_path)))
    state = page.state()
    which = {key: state["contours"][1][key] for key in ("layer", "kind", "at", "size")}
    state |= page.put(state, contour=[which | {"tab": 1}])
    document = ezdxf.readfile(tmp_path / "plate.dxf")
    document.modelspace().query("CIRCLE")[0].translate(1.2, 0, 0)
    document.saveas(tmp_path / "plate.dxf")
    new = page.done("GET", f"/api/state?after={state['rev']}")
    assert [(one["id"], one["confirm"]) for one in new["matches"]] == [(1, True)]
    assert new["matches"][0]["moved"] > 0.5
    assert new["job"]["contour"][0]["at"] == new["contours"][1]["at"]
    new |= page.put(new, machine={"offset": 0.1}, default={"lead": 2})
    assert new["matches"][0]["confirm"] is True
    chosen = {key: new["contours"][2][key] for key in ("layer", "kind", "at", "size")}
    new |= page.put(new, contour=[chosen])
    assert [(one["id"], one["confirm"]) for one in new["matches"]] == [(2, False)]


def test_saved_again_and_not_to_be_read(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    """What was read before stays, with the error beside it and the contours that the job is about, whatever becomes of
    the file; nothing is cut; and all is well when it can be read again."""
    path = plate(tmp_path)
    page = Page(serve(path))
    state = page.state()
    which = {key: state["contours"][1][key] for key in ("layer", "kind", "at", "size")}
    state |= page.put(state, contour=[which | {"tab": 1}], machine={"offset": 0.1})
    whole = path.read_bytes()
    path.write_bytes(b"no drawing")
    bad = page.done("GET", f"/api/state?after={state['rev']}")
    same = ("drawn", "sha256", "contours", "matches", "report")
    assert bad["error"] and bad["plan"] is None and [bad[key] for key in same] == [state[key] for key in same]
    _, run = page.cut(bad["rev"])
    assert run["state"] == "failed" and english(run["error"]) == english(bad["error"])
    # (another job for it, and the file taken away and brought back)
    bad |= page.put({**bad, "plan": {"contours": {}}}, default={"lead": 2}) | {"plan": None}
    assert bad["error"] and [bad[key] for key in same] == [state[key] for key in same]
    away = path.rename(tmp_path / "away.dxf")
    gone = page.done("GET", f"/api/state?after={bad['rev']}")
    assert gone["error"] != bad["error"]
    away.rename(path)
    os.utime(path)
    back = page.done("GET", f"/api/state?after={gone['rev']}")
    assert back["error"] == bad["error"] and back["contours"] == state["contours"]
    path.write_bytes(whole)
    new = page.done("GET", f"/api/state?after={back['rev']}")
    assert not new.get("error") and new["sha256"] == state["sha256"] and new["matches"] == state["matches"]
    assert new["job"]["default"]["lead"] == 2 and page.cut(new["rev"])[1]["state"] == "done"


def test_file_is_gone(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    """It says so, what was read is still there, and all is well when the file is back."""
    path = plate(tmp_path)
    page = Page(serve(path))
    state = page.state()
    away = path.rename(tmp_path / "away.dxf")
    gone = page.done("GET", f"/api/state?after={state['rev']}")
    assert "plate.dxf" in english(gone["error"]) and len(gone["contours"]) == 3
    assert page.cut(gone["rev"])[1]["state"] == "done"
    shutil.copy(away, path)
    back = page.done("GET", f"/api/state?after={gone['rev']}")
    assert not back["error"] and len(back["contours"]) == 3
    path.unlink()
    path.write_text("no drawing")
    until(lambda: "no drawing" not in str(page.state()) and page.state()["error"])
    assert len(page.state()["contours"]) == 3
    shutil.copy(away, path)
    until(lambda: len(page.state()["contours"]) == 3)


def test_save_onto_what_is_no_plain_file(saving: tuple[Page, Json, int], tmp_path: Path) -> None:
    """A link to nothing is asked about; a pipe is refused, and does not keep the page waiting."""
    page, _, number = saving
    body = {"run": number, "what": ["tape"], "overwrite": False}
    (tmp_path / "plate.nodrift.3b").symlink_to(tmp_path / "elsewhere")
    assert page.call("POST", "/api/save", body).json["exists"] == ["plate.nodrift.3b"]
    assert not (tmp_path / "elsewhere").exists()
    (tmp_path / "plate.nodrift.3b").unlink()
    os.mkfifo(tmp_path / "plate.nodrift.3b")
    assert page.call("POST", "/api/save", body).status == 409
    assert page.call("POST", "/api/save", body | {"overwrite": True}).status == 400


def test_it_ends_behind_its_last_page(
    serve: Callable[[Path], Server], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not before there was one, nor while one waits for news."""
    server, other = serve(plate(tmp_path)), serve(plate(tmp_path, "other.dxf"))
    page = Page(server)
    state = page.state()
    asking = Thread(target=page.done, args=("GET", f"/api/state?after={state['rev']}"))
    asking.start()
    until(lambda: server._asked)
    monkeypatch.setattr("skg.ui.server.ALONE", 0.2)
    assert not server.ending.wait(1.0)
    page.put(state, machine={"wire": 0.2})
    until(server.ending.is_set)
    asking.join()
    assert server.session.keep() == "plate.unsaved.job.toml"
    assert server.session.keep() == "plate.unsaved.job.toml", "the same is not written twice"
    assert "wire = 0.2" in (tmp_path / "plate.unsaved.job.toml").read_text()
    assert not other.ending.is_set()


def test_it_stays_with_what_nobody_could_save(
    serve: Callable[[], Server], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Settings of a drawing out of the browser have no folder: until they are downloaded they keep the server."""
    server = serve()
    page = Page(server)
    page.put(page.open(plate(tmp_path)), machine={"wire": 0.2})
    monkeypatch.setattr("skg.ui.server.ALONE", 0.2)
    assert not server.ending.wait(1.0)
    page.get("/api/job")
    until(server.ending.is_set)


def test_what_is_saved_is_not_kept(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    server = serve(plate(tmp_path))
    page = Page(server)
    page.put(page.state(), default={"lead": 2})
    (tmp_path / "plate.job.toml").write_text("mine")
    job = {"run": None, "what": ["job"]}
    assert page.call("POST", "/api/save", job).status == 409 and server.session.keep()
    page.done("POST", "/api/save", job | {"overwrite": True})
    assert server.session.keep() is None


def test_kept_and_offered(serve: Callable[[Path], Server], tmp_path: Path) -> None:
    """What is set is in a file a moment later, and offered when the drawing is opened again; saved, it is gone."""
    path, kept = plate(tmp_path), tmp_path / "plate.unsaved.job.toml"
    server = serve(path)
    page = Page(server)
    state = page.state()
    assert state["offers"] == []
    state |= page.put(state, machine={"wire": 0.2})
    until(lambda: kept.exists() and "wire = 0.2" in kept.read_text())
    # (the server ends without a word)
    server.session.close()
    page = Page(serve(path))
    state = page.state()
    assert state["offers"] == [kept.name] and "machine" not in state["job"]
    assert page.call("POST", "/api/take", {"name": "other.toml", "take": True}).status == 400
    state = page.done("POST", "/api/take", {"name": kept.name, "take": True})
    assert state["job"]["machine"] == {"wire": 0.2} and state["offers"] == []
    assert page.done("POST", "/api/save", {"run": None, "what": ["job"]})["written"] == ["plate.job.toml"]
    assert not kept.exists()
    # the job beside the drawing
    page = Page(serve(path))
    assert page.state()["offers"] == ["plate.job.toml"]
    state = page.done("POST", "/api/take", {"name": "plate.job.toml", "take": False})
    assert state["offers"] == [] and "machine" not in state["job"] and (tmp_path / "plate.job.toml").exists()


@pytest.mark.wording
def test_name_and_style_of_what_is_saved(saving: tuple[Page, Json, int], tmp_path: Path) -> None:
    page, state, _ = saving
    number, run = page.cut(state["rev"])
    tape = page.get(f"/api/run/{number}/tape").body
    body = {"run": number, "what": ["tape", "job"], "name": "DIE-1", "style": "numbered"}
    written = page.done("POST", "/api/save", body)["written"]
    assert written == ["plate.job.toml", "DIE-1.nodrift.3b"]
    styled = tmp_path / "DIE-1.nodrift.3b"
    assert styled.read_bytes().startswith(b"N   1: B") and skg_style(styled) == tape
    for language, is_chinese in (("en", False), ("zh", True)):
        sheet = page.get(f"/api/run/{number}/sheet.svg?language={language}").body.decode()
        assert bool(re.search("[\u4e00-\u9fff]", sheet)) is is_chinese, "the sheet is in the page's language"
    for bad in ({"name": "../x"}, {"name": ".x"}, {"style": "none"}):
        assert page.call("POST", "/api/save", body | bad | {"overwrite": True}).status == 400
    # the rest of the tape, from a block on
    lines = tape.split(b"\r\n")
    begins = [at for at, line in enumerate(lines) if line.startswith(b"B")]
    rest = page.get(f"/api/run/{number}/from/5").body
    assert rest.split(b"\r\n") == lines[begins[4] :]
    for block in (0, len(begins) + 1):
        assert page.get(f"/api/run/{number}/from/{block}").status == 400


def skg_style(path: Path) -> bytes:
    """A tape as the board punches it."""
    skg("tape", path, "-o", path.with_name("punch.3b"), "--style", "punch")
    return path.with_name("punch.3b").read_bytes()


def test_setups(serve: Callable[[], Server], tmp_path: Path) -> None:
    """What is kept is the next drawing's; nothing is kept over another without a question; a damaged one is told of."""
    server = serve()
    page, folder = Page(server), server.session.kept_setups.folder
    known = page.done("GET", "/api/setups")
    assert (known["setups"], known["last"]) == ([], "") and "wire" in known["keys"]["machine"]
    # (as a job has it: what is usual is not said)
    tables = {"machine": {"wire": 0.2, "feed": 5}, "default": {"passes": [0.05, 0]}, "tape": {"style": "spaced"}}
    tables["price"] = {"per_hole": 2.5}
    known = page.done("PUT", "/api/setups", {"name": "细丝", "tables": tables})
    tables["machine"].pop("feed")
    assert known["setups"] == [{"name": "细丝", "tables": tables}] and known["last"] == "细丝"
    answer = page.call("PUT", "/api/setups", {"name": "细丝", "tables": {}})
    assert (answer.status, answer.json["exists"]) == (409, ["细丝"])
    for name, odd in (("../x", {}), ("a", {"machine": {"wire": -1}}), ("a", {"read": {}}), ("a", {"machine": 1})):
        assert page.call("PUT", "/api/setups", {"name": name, "tables": odd}).status == 400
    job = page.open(plate(tmp_path))["job"]
    assert {table: job[table] for table in tables} == tables
    (folder / "bad.toml").write_text("[machine")
    bad, _ = page.done("GET", "/api/setups")["setups"]
    assert bad["name"] == "bad" and bad["error"]["code"] == "not-toml"
    assert page.call("POST", "/api/setups", {"name": "bad"}).status == 400
    assert page.done("POST", "/api/setups", {"name": ""})["last"] == ""
    assert "machine" not in page.open(plate(tmp_path))["job"]
    assert [one["name"] for one in page.done("DELETE", "/api/setups", {"name": "细丝"})["setups"]] == ["bad"]


def test_start_holes_are_saved(serve: Callable[[], Server], tmp_path: Path) -> None:
    """As a list, and as a drilling program where the thickness is known; nothing is saved where it is not."""
    page = Page(serve(plate(tmp_path)))
    state = page.state()
    number, _ = page.cut(state["rev"])
    answer = page.call("POST", "/api/save", {"run": number, "what": ["tape", "drill"]})
    assert answer.status == 400 and not list(tmp_path.glob("*.3b"))
    state = page.put(page.state(), machine={"thickness": 10})
    number, _ = page.cut(state["rev"])
    written = page.done("POST", "/api/save", {"run": number, "what": ["holes", "drill"], "name": "teil"})["written"]
    assert written == ["teil-holes.csv", "teil-holes.nc"]
    assert (tmp_path / "teil-holes.csv").read_text().count("opening") == 2
    assert (tmp_path / "teil-holes.nc").read_bytes() == page.get(f"/api/run/{number}/drill").body
    assert b"G81" in page.get(f"/api/run/{number}/drill").body
