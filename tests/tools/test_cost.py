"""Time by rates, area and price of a cut: by hand, by pass, and as money adds up."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import pytest
from cuthelp import drawing, polygon, saved
from toolhelp import Run

from skg.cutting.cost import Cost
from skg.job.job import Price
from skg.job.machine import Setup


def part(folder: Path, hole: bool = False) -> Path:
    page = drawing()
    polygon([(0, 0), (30, 0), (30, 20), (0, 20)], page, layer="PART")
    if hole:
        polygon([(10, 5), (20, 5), (20, 15), (10, 15)], page, layer="PART")
    return saved(page, folder)


def report(run: Run, *words: object) -> dict:
    done = run("cut", *words, "-o", "-", "--json")
    assert done.exit_code == 0, done.stderr
    return json.loads(done.stderr)


def codes(told: dict) -> set[str]:
    return {finding["code"] for finding in told["findings"]}


def test_a_square_by_hand(run: Run, tmp_path: Path) -> None:
    """100 mm around and 3 mm of lead forth and back, in stock of 10 mm: 1,060 mm², of which 80 are cut in a minute."""
    path = part(tmp_path)
    told = report(
        run, path, "--thickness", 10, "--rates", 80, "--per-area", 0.015, "--per-hole", 2.5, "--currency", "元"
    )
    assert (told["length"], told["area"], told["areas"], told["holes"], told["passes"]) == (106.0, 1060, [1060], 1, 1)
    assert told["seconds"] == 1060 / 80 * 60
    assert told["price"] == {"area": 15.9, "holes": 2.5, "passes": 0.0, "total": 18.4, "currency": "元"}
    (price,) = (one["values"] for one in told["findings"] if one["code"] == "price")
    assert price["price"] == "18.40 元" and len(price["parts"]) == 2
    # (without a thickness the feed is what there is, and that is said whatever is not)
    quiet = run("cut", path, "-o", "-", "--rates", 80, "--per-area", 0.015, "--quiet").stderr
    assert "--thickness" in quiet
    told = report(run, path, "--rates", 80, "--per-area", 0.015, "--per-hole", 2)
    assert told["seconds"] == round(106 / 5 * 60, 1) and told["price"] is told["area"] is None
    assert "no-thickness" in codes(told) and not {"area", "price"} & codes(told)
    # (a price of holes wants none)
    assert report(run, path, "--per-hole", 2)["price"]["total"] == 2


def test_each_pass_has_its_rate_and_its_price(run: Run, tmp_path: Path) -> None:
    """Passes beside a contour, and cuts of a tab, which begin anew with the first one's."""
    options = (
        "--offset",
        0.1,
        "--passes",
        "0.05,0.02,0",
        "--thickness",
        20,
        "--rates",
        "60,100",
        "--per-area",
        "1,0.5",
    )
    path = part(tmp_path, hole=True)
    told = report(run, path, *options, "--per-pass", 3)
    assert len(told["areas"]) == 3 and sum(told["areas"]) == told["area"]
    assert abs(told["length"] * 20 - told["area"]) < 2
    first, second, third = told["areas"]
    # (around the outline it is 0.15, 0.12 and 0.1 mm beside, around the opening as much within)
    assert abs(first - second) < 40 and abs(second - third) < 40 and abs(first / 20 - (140 + 12)) < 2
    assert told["seconds"] == pytest.approx(60 * (first / 60 + (second + third) / 100), rel=1e-3)
    assert told["price"] | {"currency": ""} == {
        "area": first + (second + third) / 2,
        "holes": 0.0,
        "passes": 18.0,
        "total": 18 + first + (second + third) / 2,
        "currency": "",
    }
    tab = report(run, path, *options, "--tab", 2, "--tab-passes", "0")
    # (the outline without its tab three times, the tab twice: with its leads)
    assert tab["areas"][0] - tab["areas"][2] > 20 and len(tab["areas"]) == 3
    assert abs(tab["length"] * 20 - tab["area"]) < 2


def test_money_is_rounded_once_and_adds_up() -> None:
    """Half a cent goes up, whatever binary makes of it; the sum is that of the parts as they are printed."""
    # (two contours that are cut from one hole: it is drilled once)
    contours = [SimpleNamespace(passes=(0.0,), holes=[(max(0, at), 0)]) for at in range(-1, 5)]
    result = SimpleNamespace(
        setup=Setup(thickness=1.0), contours=contours, checked=SimpleNamespace(lengths=(100.4, 35.0))
    )
    cost = Cost.of(result, Price(per_area=(0.01005, 0.0), per_hole=0.201, per_pass=0.001))
    assert cost.areas == (100, 35) and list(map(str, cost.parts)) == ["1.01", "1.01", "0.01"] and cost.price == "2.03"
    assert Cost.of(result, Price()).price == "" and list(Cost.of(result, Price()).findings())[0].code == "area"
