"""The job: from options, from a file, of a contour, a layer, all; what is wrong with one is a line with its place."""

from __future__ import annotations

import json
import re
import shlex
import shutil
from dataclasses import fields, replace
from pathlib import Path

import pytest
from cuthelp import choose, drawing, polygon, run_failing, saved, start_holes
from facthelp import CARE, pattern, says
from hypothesis import given
from hypothesis import strategies as st
from test_docs import EXAMPLE, ROOT
from toolhelp import Run

from skg.errors import UserError
from skg.geometry.plane import XY
from skg.job.file import _CONTOUR, _OFTEN, decoded, dump, encoded, from_data, load, to_data
from skg.job.job import KINDS, Chosen, Job, Price, TapeForm
from skg.job.machine import INTO, ROMS, SMALL, BoardOptions, Policy, Setup
from skg.job.read_options import OPEN, UNITS, ReadOptions
from skg.job.wanted import CLEARANCE_ON, LEAD_SHAPES, SIDES, CutSettings, Overrides
from skg.messages.finding import Phrase
from skg.pipeline.steps import cut_drawing, open_drawing, plan_drawing, wanted_of, written
from skg.tape.styles import STYLES

DOCS = ROOT / "docs"

LENGTHS = st.floats(0, 1000)
OFFSETS = st.floats(0, 5)
PLACES = st.tuples(st.floats(-1e5, 1e5), st.floats(-1e5, 1e5))
NAMES = st.text(min_size=1, max_size=20)
WORDS = st.text("abc ü零", min_size=1, max_size=9).filter(str.strip)


def maybe(one: st.SearchStrategy) -> st.SearchStrategy:
    return st.none() | one


OFTEN = {
    "cut": maybe(st.booleans()),
    "side": maybe(st.sampled_from(SIDES)),
    "reverse": maybe(st.booleans()),
    "passes": maybe(st.lists(OFFSETS, min_size=1, max_size=4).map(lambda some: tuple(sorted(some, reverse=True)))),
    "tab": maybe(LENGTHS),
    "slug_tab": maybe(LENGTHS),
    "tabs": maybe(st.integers(1, 50)),
    "tab_passes": maybe(st.lists(OFFSETS, max_size=3).map(lambda some: tuple(sorted(some, reverse=True)))),
    "overlap": maybe(LENGTHS),
    "lead": maybe(st.floats(1e-3, 1000)),
    "lead_shape": maybe(st.sampled_from(LEAD_SHAPES)),
    "clearance": maybe(OFFSETS),
    "clearance_on": maybe(st.sampled_from(CLEARANCE_ON)),
}
LAYER = OFTEN | {"offset": maybe(OFFSETS)}
CONTOUR = {key: value for key, value in LAYER.items() if key != "slug_tab"} | {
    "tabs": maybe(st.integers(1, 50) | st.lists(PLACES, min_size=1, max_size=3).map(tuple)),
    "start": maybe(PLACES),
    "entry": maybe(PLACES),
    "order": maybe(st.integers(1, 99)),
}
CHOSEN = st.builds(
    Chosen,
    st.text(max_size=9),
    st.sampled_from(KINDS),
    PLACES,
    st.tuples(LENGTHS, LENGTHS),
    st.builds(Overrides, **CONTOUR),
)
SETUPS = st.builds(
    Setup,
    wire=maybe(st.floats(0.01, 0.4)),
    offset=st.none(),
    feed=st.floats(0.001, 500),
    material=st.just("") | WORDS,
    thickness=maybe(st.floats(1e-3, 1000)),
    rates=st.lists(st.floats(1e-3, 1e6), max_size=3).map(tuple),
)
JOBS = st.builds(
    Job,
    NAMES.filter(lambda name: not set(name) & set("/\\:\0") and name not in (".", "..")),
    sha256=st.just("") | st.text("0123456789abcdef", min_size=64, max_size=64),
    box=maybe(st.tuples(*[st.floats(-1e5, 1e5)] * 4)),
    read=st.builds(
        ReadOptions,
        layers=st.lists(NAMES, max_size=3).map(tuple),
        start_layer=NAMES,
        units=maybe(st.sampled_from(sorted(UNITS))),
        tolerance=st.floats(1e-6, 10),
        fit_tolerance=st.floats(1e-5, 10),
        open=maybe(st.sampled_from(OPEN)),
        encoding=maybe(WORDS),
    ),
    setup=SETUPS,
    board=st.builds(BoardOptions, st.sampled_from(ROMS), st.integers(2, 56)),
    policy=st.builds(Policy, st.sampled_from(SMALL), st.sampled_from(INTO)),
    price=st.builds(Price, st.lists(st.floats(0, 1e6), max_size=3).map(tuple), LENGTHS, LENGTHS, st.just("") | WORDS),
    tape=st.builds(TapeForm, st.sampled_from(sorted(STYLES)), st.booleans()),
    starts=st.lists(PLACES, max_size=3).map(tuple),
    default=st.builds(Overrides, **OFTEN),
    layers=st.dictionaries(NAMES, st.builds(Overrides, **LAYER), max_size=3).filter(
        lambda layers: len({name.lower() for name in layers}) == len(layers)
    ),
    contours=st.lists(CHOSEN, max_size=3, unique_by=lambda one: (one.layer, one.kind, one.place, one.size)).map(tuple),
)


@given(JOBS)
def test_a_job_comes_back(job: Job) -> None:
    """From its text, its bytes and its data; what was written once is written again so."""
    text = dump(job)
    assert load(text, "job") == job
    assert from_data(to_data(job), "job") == job
    assert dump(load(text, "job")) == text
    assert decoded(encoded(job), "job") == job


def test_all_places_have_all_settings_of_a_contour() -> None:
    names = {field.name for field in fields(CutSettings)}
    page = (ROOT / "web" / "src" / "ui" / "fields.ts").read_text()
    plans = page[page.index("const PLANS") : page.index("export class")]
    places = {
        "Overrides": {field.name for field in fields(Overrides)},
        "job/file.py": _OFTEN.keys() | _CONTOUR.keys() - {"layer", "kind", "at", "size"},
        "PLANS of fields.ts": set(re.findall(r'\bkey: "(\w+)"', plans)),
    }
    for place, those in places.items():
        assert names - those == those - names == set(), place


def test_names_that_are_no_text() -> None:
    """A layer's name with bytes that are no UTF-8, and one with all that ASCII has."""
    for name in ("bad\udcff", "".join(map(chr, range(1, 128))), ""):
        job = Job("a.dxf", contours=(Chosen(name, "open", (0.0, 0.0), (1.0, 1.0)),))
        assert decoded(encoded(job), "job") == job


PART = """schema = 1
drawing = "a.dxf"
[machine]
wire = 0.2
[[layer]]
name = "P"
cut = false
[[contour]]
layer = "P"
kind = "outline"
at = [1, 2]
size = [3, 4.5]
passes = [0.1, 0]
order = 3
"""


def wrong(key: str, value: str, why: str, **values: object) -> Phrase:
    """A key whose value is wrong, and what would be right."""
    return Phrase("wrong-value", key=key, value=value, wrong=Phrase(why, **values))


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("schema = 1", "schema = 2", [wrong("schema", "2", "value-whole", low=1, high=1)]),
        ("schema = 1", "", [Phrase("schema-missing", schema=1)]),
        ('drawing = "a.dxf"', "", [Phrase("key-missing", key="drawing")]),
        ("a.dxf", "../a.dxf", [wrong("drawing", "'../a.dxf'", "value-file-name")]),
        ("a.dxf", "/a.dxf", [wrong("drawing", "'/a.dxf'", "value-file-name")]),
        ("a.dxf", "..", [wrong("drawing", "'..'", "value-file-name")]),
        ("wire", "wier", ["[machine]", Phrase("unknown-key-near", key="wier", near="wire")]),
        ("[machine]", "[machin]", [Phrase("unknown-key-near", key="machin", near="machine")]),
        ("cut = false", "cat = false", ["[[layer]] 1", Phrase("unknown-key-near", key="cat", near="cut")]),
        ("cut = false", "cut = 0", ["[[layer]] 1", wrong("cut", "0", "value-flag")]),
        ("order", "start_hole", ["[[contour]] 1", Phrase("unknown-key-near", key="start_hole", near="start")]),
        ("order = 3", "order = 0", ["[[contour]] 1", wrong("order", "0", "value-whole", low=1, high=1000000)]),
        ("order = 3", "order = true", ["[[contour]] 1", wrong("order", "true", "value-whole", low=1, high=1000000)]),
        ("order = 3", "order = 3.0", ["[[contour]] 1", wrong("order", "3.0", "value-whole", low=1, high=1000000)]),
        ("order = 3", "order = 1" + "0" * 5000, [Phrase("not-toml")]),
        ("0.2", "nan", ["[machine]", wrong("wire", "nan", "value-above-to", low=0, high=10)]),
        ("0.2", "inf", ["[machine]", wrong("wire", "inf", "value-above-to", low=0, high=10)]),
        ("0.2", "-0.2", ["[machine]", wrong("wire", "-0.2", "value-above-to", low=0, high=10)]),
        ("0.2", "11", ["[machine]", wrong("wire", "11", "value-above-to", low=0, high=10)]),
        ("0.2", "0.2\noffset = 0.1", ["[machine]", Phrase("offset-and-wire")]),
        ("wire = 0.2", "gap = 0.1", ["[machine]", Phrase("gap-without-wire")]),
        ("0.2", '"0.2"', ["[machine]", wrong("wire", "'0.2'", "value-above-to", low=0, high=10)]),
        (
            "0.2",
            '0.2\nthickness = "20 mm"',
            ["[machine]", wrong("thickness", "'20 mm'", "value-above-to", low=0, high=100000)],
        ),
        ("0.2", "0.2\nrates = [80, 0]", ["[machine]", wrong("rates", "[80, 0]", "value-above-to", low=0, high=1e8)]),
        ("0.2", "0.2\nrates = []", ["[machine]", wrong("rates", "[]", "value-by-pass")]),
        ("0.2", "0.2\n[price]\nper_hole = -1", ["[price]", wrong("per_hole", "-1", "value-from-to", low=0, high=1e8)]),
        ("0.1, 0", "0, 0.1", ["[[contour]] 1", wrong("passes", "[0, 0.1]", "value-rising")]),
        ("[0.1, 0]", "[]", ["[[contour]] 1", wrong("passes", "[]", "value-lengths")]),
        ("[0.1, 0]", '"0.1"', ["[[contour]] 1", wrong("passes", "'0.1'", "value-lengths")]),
        ("[3, 4.5]", "[3, -4.5]", ["[[contour]] 1", wrong("size", "[3, -4.5]", "value-size")]),
        ("[3, 4.5]", "[3]", ["[[contour]] 1", wrong("size", "[3]", "value-size")]),
        ("[1, 2]", "[1e9, 2]", ["[[contour]] 1", wrong("at", "[1000000000.0, 2]", "value-place")]),
        (
            '"outline"',
            '"outlin"',
            ["[[contour]] 1", wrong("kind", "'outlin'", "value-among", words=("outline", "opening", "open"))],
        ),
        ('layer = "P"\n', "", ["[[contour]] 1", Phrase("key-missing", key="layer")]),
        ('name = "P"', "", ["[[layer]] 1", Phrase("key-missing", key="name")]),
        ('name = "P"', 'name = "p"\n[[layer]]\nname = "P"', ["[[layer]] 2", Phrase("layer-twice", layer="P")]),
        ("[[layer]]", "[layer]", [Phrase("expected-tables", key="layer")]),
        ("[machine]", "[[machine]]", ["[machine]", Phrase("expected-table")]),
        ("order = 3", PART[PART.index("[[contour]]") :], ["[[contour]] 2", Phrase("contour-twice", first=1)]),
        ("schema = 1", "a = " + "[" * 100_000, [Phrase("not-toml")]),
        ("schema = 1", "schema = 1 1", [Phrase("not-toml")]),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_file(old: str, new: str, told: list[str]) -> None:
    """One line that has the file, the place in it, and what is expected."""
    load(PART, "a.job.toml")
    assert old in PART
    with pytest.raises(UserError) as failed:
        load(PART.replace(old, new), "a.job.toml")
    message = str(failed.value)
    assert message.startswith("a.job.toml: ") and "\n" not in message and len(message) < 300
    assert says(message, *told), message


def test_contour_beats_layer_beats_default() -> None:
    job = Job(
        "a.dxf",
        setup=Setup(wire=0.2, gap=0.01),
        default=Overrides(tab=1.0, lead=2.0),
        layers={"Second": Overrides(tab=2.0, offset=0.3), "first": Overrides(tab=3.0)},
    )
    assert job.of(["0"]) == CutSettings(offset=0.11, tab=1.0, lead=2.0)
    assert job.of(["FIRST"]).tab == 3.0 and job.of(["FIRST"]).offset == 0.11
    # (of two layers the one that comes first in the job)
    assert job.of(["first", "second"]) == CutSettings(offset=0.3, tab=2.0, lead=2.0)
    chosen = Chosen("first", "outline", (0.0, 0.0), (1.0, 1.0), Overrides(tab=0.0, cut=False))
    assert job.of(["first"], chosen) == CutSettings(cut=False, offset=0.11, lead=2.0)


def plate(folder: Path) -> Path:
    """An outline with three openings, on layers."""
    page = drawing()
    polygon([(0, 0), (60, 0), (60, 30), (0, 30)], page, layer="PLATE")
    for at in range(3):
        x = 5 + 18 * at
        polygon([(x, 8), (x + 12, 8), (x + 12, 20), (x, 20)], page, layer="HOLES")
    return saved(page, folder)


EXAMPLES = [
    words
    for name in ("tools.md", "shop.md")
    for example in EXAMPLE.finditer((DOCS / name).read_text())
    # (of some the pages show the last lines alone)
    if (words := shlex.split(example["command"].partition(" 2>&1")[0]))[:2] == ["skg", "cut"]
    and words[2].startswith("docs/")
    and not {"|", "4.2", "--list-layers", "--clearance"} & set(words)
]
#: Other options than those of the pages.
MORE = [
    "--side outside --offset 0.05 --into cut",
    "--side on --open all",
    "--lead 1.5 --lead-shape arc --reverse --wire 0.2",
    "--start 12,15 --start 30,15 --wire 0.25 --feed 3.5 --ram 16",
    "--layer PART --units mm --tolerance 0.01 --fit-tolerance 0.001 --offset 0.3 --small leave",
    "--offset 0.1 --tab 2 --slug-tab 1 --tabs 2 --passes 0.1,0.05 --tab-passes 0.06 --overlap 0.3 --lead 1",
    "--rom standard --offset 0.1 --tab 2 --passes 0.1,0.05 --material '1.2379' --thickness 20 --style padded",
    "--thickness 20 --rates 80,120 --per-area 0.01 --per-hole 5 --per-pass 2 --currency 元",
]


@pytest.mark.parametrize("words", [*EXAMPLES, *(["", "", "bracket.dxf", *shlex.split(more)] for more in MORE)])
def test_every_example_as_a_job(run: Run, tmp_path: Path, words: list[str]) -> None:
    """The tape of the job that is saved is the command line's, byte by byte; the program, too."""
    part = tmp_path / Path(words[2]).name
    shutil.copy(DOCS / "pictures" / part.name, part)
    kept = []
    options = iter(words[3:])
    for word in options:
        if word in ("-o", "--program", "--sheet"):
            next(options)
        elif word != "--quiet":
            kept.append(word)
    job, made = tmp_path / "a.job.toml", [tmp_path / name for name in ("a.3b", "b.3b", "a.skg", "b.skg")]
    one = run("cut", part, *kept, "-o", made[0], "--program", made[2], "--save-job", job, "--json")
    other = run("cut", job, "-o", made[1], "--program", made[3], "--json")
    assert one.exit_code == other.exit_code == 0
    assert made[0].read_bytes() == made[1].read_bytes() and made[2].read_bytes() == made[3].read_bytes()
    # (advice is in the words of each)
    reports = [re.sub(r'"text": "(\\.|[^"\\])*"|[ab]\.3b', "", done.stderr) for done in (one, other)]
    assert reports[0] == reports[1] and len(json.loads(one.stderr)["findings"]) > 5
    # (saved once more it is the same)
    again = tmp_path / "again.job.toml"
    run("cut", job, "-o", made[1], "--save-job", again)
    assert again.read_bytes() == job.read_bytes()


def test_examples_are_there() -> None:
    assert len(EXAMPLES) >= 6


def test_settings_of_contours(run: Run, tmp_path: Path) -> None:
    """One is left, one is cut first with an offset of its own, one has its start hole and entry: the report says so."""
    path = plate(tmp_path)
    job = Job("part.dxf", setup=Setup(offset=0.1), layers={"plate": Overrides(tab=1.5, passes=(0.05, 0.0))})
    opened = open_drawing(job, path.read_bytes())
    numbers = {tuple(opened.known.boxes[number, :2].tolist()): number for number in range(4)}
    contours = (
        choose(opened, numbers[5.0, 8.0], cut=False),
        choose(opened, numbers[41.0, 8.0], order=1, offset=0.2),
        choose(opened, numbers[23.0, 8.0], start=(29.0, 14.0), entry=(23.0, 15.0)),
    )
    (tmp_path / "part.job.toml").write_bytes(encoded(replace(job, contours=contours)))
    told = run("cut", tmp_path / "part.job.toml", "-o", tmp_path / "a.3b", "--program", "-").stderr
    assert says(
        told,
        Phrase("contour-numbers", count=1, numbers=(1,)),
        Phrase("kind-opening", count=1),
        Phrase("side-inside"),
        Phrase("beside", offsets=(0.2,)),
    ), told
    assert says(
        told,
        Phrase("contour-numbers", numbers=(2,)),
        Phrase("kind-opening"),
        Phrase("side-inside"),
        Phrase("beside", offsets=(0.1,)),
    ), told
    assert says(
        told,
        Phrase("contour-numbers", numbers=(3,)),
        Phrase("kind-outline"),
        Phrase("side-outside"),
        Phrase("beside", offsets=(0.15, 0.1)),
        Phrase("tab-cut", offsets=(0.15,)),
        Phrase("in-passes", count=2),
        Phrase("with-tab", tab=1.5),
    ), told
    assert says(told, Phrase("order-of-cutting"), Phrase("count-holes", count=3), re.compile(r"\(4.*, \(29, 14\), ")), (
        told
    )
    assert says(
        told,
        Phrase("two-stops"),
        Phrase("contour-numbers", count=2, numbers=(2, 3)),
        Phrase("contour-numbers", numbers=(3,)),
    ), told


def test_an_outline_is_not_cut_before_what_lies_in_it(run: Run, tmp_path: Path) -> None:
    job = Job("part.dxf", setup=Setup(offset=0.1))
    opened = open_drawing(job, plate(tmp_path).read_bytes())
    outline = opened.known.kinds.tolist().index("outline")
    job = replace(job, contours=(choose(opened, outline, order=2),))
    (tmp_path / "part.job.toml").write_bytes(encoded(job))
    message = run_failing(run, "cut", tmp_path / "part.job.toml", "-o", tmp_path / "a.3b")
    layers = {name: Phrase("on-layers", layers=(name,)) for name in ("PLATE", "HOLES")}
    outer = Phrase("contour-name", turn=2, kind=Phrase("kind-outline", count=1), layers=layers["PLATE"])
    inner = Phrase("contour-name", kind=Phrase("kind-opening", count=1), layers=layers["HOLES"])
    assert says(message, Phrase("outer-first", outer=outer, inner=inner)), message
    assert not (tmp_path / "a.3b").exists()
    with pytest.raises(UserError) as failed:
        plan_drawing(job, open_drawing(job, (tmp_path / "part.dxf").read_bytes()))
    assert failed.value.contour == outline and failed.value.place


def test_a_drawing_that_has_changed(run: Run, tmp_path: Path) -> None:
    """Moved: start holes and entries move with it, which is said; a contour that is gone is refused, and named."""
    path, file = plate(tmp_path), tmp_path / "part.job.toml"
    job = Job("part.dxf", setup=Setup(offset=0.1), starts=((30.0, -5.0),))
    opened = open_drawing(job, path.read_bytes())
    opening = opened.known.kinds.tolist().index("opening")
    x, y = opened.known.boxes[opening, :2].tolist()
    job = replace(job, contours=(choose(opened, opening, start=(x + 5, y + 5), entry=(x + 5, y)),))
    job = written(job, open_drawing(job, path.read_bytes()))
    file.write_bytes(encoded(job))
    before = run("cut", file, "-o", tmp_path / "a.3b").stderr
    assert not says(before, CARE)
    page = drawing()
    for left, low, wide, high, layer in (
        (0, 0, 60, 30, "PLATE"),
        *((5 + 18 * at, 8, 12, 12, "HOLES") for at in range(3)),
    ):
        corners = [(left, low), (left + wide, low), (left + wide, low + high), (left, low + high)]
        polygon([(100 + u, 50 + v) for u, v in corners], page, layer=layer)
    saved(page, tmp_path)
    after = run("cut", file, "-o", tmp_path / "b.3b").stderr
    assert says(after, CARE, Phrase("drawing-moved", drawing="part.dxf", by=(100, 50))), after
    assert (tmp_path / "a.3b").read_bytes() == (tmp_path / "b.3b").read_bytes()
    page = drawing()
    polygon([(0, 0), (60, 0), (60, 30), (0, 30)], page, layer="PLATE")
    saved(page, tmp_path)
    message = run_failing(run, "cut", file, "-o", tmp_path / "c.3b")
    assert says(
        message,
        Phrase("contour-lost", index=1),
        Phrase("chosen-name", width=12, height=12, layer="HOLES"),
        Phrase("kind-opening"),
    ), message
    path.unlink()
    assert says(
        run_failing(run, "cut", file, "-o", tmp_path / "c.3b"),
        file.name,
        Phrase("drawing-not-there", drawing="part.dxf"),
    )
    assert not (tmp_path / "c.3b").exists()


@pytest.mark.parametrize(
    ("start", "entry", "side"),
    [
        ((20.0, 20.0), (20.0, 30.0), "inside"),
        ((24.0, 24.0), (14.0, 28.0), "inside"),
        ((20.0, 28.0), (20.0, 30.0), "inside"),
        ((33.0, 20.0), (28.0, 26.0), "outside"),
        ((33.0, 20.0), (20.0, 30.0), "outside"),
    ],
)
def test_a_circle_is_entered_where_that_is_asked(tmp_path: Path, start: XY, entry: XY, side: str) -> None:
    """Also beside its start hole's radius; but not through the circle, which is refused before anything is cut."""
    page = drawing()
    page.modelspace().add_circle((20, 20), 10)
    data = saved(page, tmp_path).read_bytes()
    job = Job("part.dxf", setup=Setup(offset=0.1))
    settings = choose(open_drawing(job, data), 0, start=start, entry=entry, side=side)
    job = replace(job, contours=(settings,))
    opened = open_drawing(job, data)
    if start[0] == 33 and entry[0] == 20:
        with pytest.raises(UserError) as failed:
            plan_drawing(job, opened)
        finding = failed.value.finding
        assert (finding.code, finding.contour, finding["start"]) == ("entry-behind", 0, start)
        return
    cut = cut_drawing(job, opened).result
    x, y = entry[0] - 20, entry[1] - 20
    reach = 10 / (x * x + y * y) ** 0.5
    assert cut.contours[0].entry == pytest.approx((20 + reach * x, 20 + reach * y), abs=2e-3)


def test_a_contour_that_moved_is_said(run: Run, tmp_path: Path) -> None:
    path, file = plate(tmp_path), tmp_path / "part.job.toml"
    job = Job("part.dxf", setup=Setup(offset=0.1))
    opened = open_drawing(job, path.read_bytes())
    outline = opened.known.kinds.tolist().index("outline")
    job = replace(job, contours=(choose(opened, outline, tab=1.0),))
    file.write_bytes(encoded(written(job, open_drawing(job, path.read_bytes()))))
    page = drawing()
    polygon([(0, -2), (60, -2), (60, 30), (0, 30)], page, layer="PLATE")
    saved(page, tmp_path)
    told = run("cut", file, "-o", tmp_path / "a.3b", "--quiet").stderr
    name = Phrase("chosen-name", kind=Phrase("kind-outline"), width=60, height=30)
    assert any(says(told, CARE, Phrase("matched-far", name=name, moved=moved)) for moved in (2, 4)), told


@pytest.mark.parametrize(
    ("words", "facts"),
    [
        (["part.job.toml", "--offset", 0.1], [Phrase("option-in-job", option="--offset")]),
        (["part.job.toml", "--quiet", "--layer", "0"], [Phrase("option-in-job", option="--layer")]),
        (["part.job.toml", "-o", "part.dxf"], ["part.dxf: ", Phrase("written-twice")]),
        (["part.job.toml", "-o", "part.job.toml"], ["part.job.toml: ", Phrase("written-twice")]),
        (["part.job.toml", "--save-job", "part.job.toml"], ["part.job.toml: ", Phrase("written-twice")]),
        (["part.dxf", "--save-job", "part.dxf"], ["part.dxf: ", Phrase("written-twice")]),
        (["part.dxf", "--save-job", "part.txt"], ["part.txt: ", Phrase("not-job-name")]),
        (["part.dxf", "--save-job", "other/part.job.toml"], [Phrase("job-elsewhere")]),
        (["part.dxf", "--material", "a\nb"], [Phrase("value-text")]),
        (["none.job.toml"], ["none.job.toml"]),
    ],
)
def test_files_and_options(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[object], facts: list[str]
) -> None:
    """A job's options stand in its file; nothing that is read is written; a job lies beside its drawing."""
    monkeypatch.chdir(tmp_path)
    plate(tmp_path)
    Path("other").mkdir()
    Path("part.job.toml").write_bytes(encoded(Job("part.dxf", setup=Setup(offset=0.1))))
    kept = {name: Path(name).read_bytes() for name in ("part.dxf", "part.job.toml")}
    with pytest.raises(Exception, match=pattern(*facts)):
        failed = run("cut", *words, *([] if "-o" in words else ["-o", "a.3b"]))
        raise AssertionError(failed.stderr)
    assert not Path("a.3b").exists() and kept == {name: Path(name).read_bytes() for name in kept}


def test_places_of_the_report_are_taken(run: Run, tmp_path: Path) -> None:
    """On a drawing in inches too: a start hole as the report has it, given back, makes the same tape."""
    page = drawing()
    page.units = 1
    polygon([(0, 0), (2, 0), (2, 1), (0, 1)], page)
    page.modelspace().add_circle((0.7, 0.5), 0.25)
    path = saved(page, tmp_path)
    told = run("cut", path, "-o", tmp_path / "a.3b", "--offset", 0.1).stderr
    assert says(
        told, Phrase("size-read", width=50.8, height=25.4, units="inch"), Phrase("places-in-mm", factor=25.4)
    ) and says(told, Phrase("size-read"), Phrase("places-in-mm")), told
    holes = start_holes(told)
    words = [word for hole in holes for word in ("--start", ",".join(hole))]
    assert len(holes) == 2 and float(holes[0][0]) > 12
    again = run("cut", path, "-o", tmp_path / "b.3b", "--offset", 0.1, *words).stderr
    assert start_holes(again) == holes
    assert (tmp_path / "b.3b").read_bytes() == (tmp_path / "a.3b").read_bytes()


def test_numbers_stay_when_some_are_left_out(run: Run, tmp_path: Path) -> None:
    """In the report, the program and what was left out a contour has its place in the whole order."""
    page = drawing()
    polygon([(0, 0), (60, 0), (60, 30), (0, 30)], page)
    for at in range(4):
        page.modelspace().add_circle((8 + 12 * at, 15), 0.05 if at == 1 else 3)
    program = tmp_path / "a.skg"
    words = ["--offset", 0.1, "--small", "leave", "--program", program, "--sheet", tmp_path / "a.svg"]
    told = run("cut", saved(page, tmp_path), "-o", tmp_path / "a.3b", *words).stderr
    name = Phrase("contour-name", turn=2, kind=Phrase("kind-opening", count=1))
    assert says(told, CARE, Phrase("contour-not-cut", name=name)), told
    numbers = re.findall(r"REM (\d)\. O", program.read_text())
    assert sorted([*numbers, "2"]) == list("12345") and numbers[-1] == "5"
    assert says(told, Phrase("contour-numbers", numbers=(5,)), Phrase("kind-outline", count=1)), told
    sheet = (tmp_path / "a.svg").read_text()
    assert all(f">{number}<" in sheet for number in numbers)


def listed(layer: str, count: int) -> str:
    """A layer with polylines as `--list-layers` shows it."""
    return f"{Phrase('layer-list', layer=layer, kinds=(Phrase('count-kind', count=count, kind='LWPOLYLINE'),))}\n"


def test_layers_and_what_is_odd_in_them(run: Run, tmp_path: Path) -> None:
    """The lines are on standard output, the findings of the reading on standard error."""
    page = drawing()
    page.modelspace().add_lwpolyline([(0, 0), (9, 0), (9, 9)], close=True, dxfattribs={"const_width": 0.5})
    done = run("cut", saved(page, tmp_path), "--list-layers")
    assert done.stdout == listed("0", 1) and says(done.stderr, "part.dxf", Phrase("seen-with-width"))


def test_layers_of_a_job(run: Run, tmp_path: Path) -> None:
    plate(tmp_path)
    (tmp_path / "part.job.toml").write_bytes(encoded(Job("part.dxf")))
    told = run("cut", tmp_path / "part.job.toml", "--list-layers").stdout
    assert told == run("cut", tmp_path / "part.dxf", "--list-layers").stdout == listed("HOLES", 3) + listed("PLATE", 1)


def test_progress_and_wanted(tmp_path: Path) -> None:
    """The page gets the steps of a run and the settings of each contour."""
    job = Job("part.dxf", setup=Setup(offset=0.1), layers={"holes": Overrides(cut=False)})
    opened = open_drawing(job, plate(tmp_path).read_bytes())
    assert [want.cut for want in wanted_of(job, opened)].count(True) == 1
    steps: list[str] = []
    done = cut_drawing(job, opened, lambda stage, done, of: steps.append(stage))
    assert len(done.result.contours) == 1 and steps[0] == "plan"
    assert any(line.severity.value == "care" for line in done.findings) is False
    holes, plates = (finding for finding in done.findings if finding.code == "layer-sum")
    assert (holes["layer"], holes["entities"]["count"], holes["parts"]) == (
        "HOLES",
        3,
        (Phrase("layer-left", count=3),),
    )
    (why,) = holes["reasons"]["reasons"]
    assert (why["reason"], why["kinds"]) == (
        Phrase("reason-unwanted"),
        (Phrase("count-kind", count=3, kind="LWPOLYLINE"),),
    )
    assert (plates["layer"], plates["parts"], plates["reasons"]) == ("PLATE", (Phrase("layer-cut", count=1),), None)
    assert says(done.findings[3], Phrase("contours-read", count=1, kinds=(Phrase("count-closed", count=1),)))
