"""`skg cut`: a drawing as a tape, checked before it is written."""

from __future__ import annotations

import codecs
import json
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from os.path import realpath
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from click.core import ParameterSource

from skg.commands.options import (
    COORDINATES,
    Degrees,
    FiniteRange,
    Millimetres,
    RomName,
    feed_option,
    kept_setups,
    machine_option,
    numbers_in,
    offset_option,
    output_option,
    picture_format,
    refuse_onto,
    unmarked,
)
from skg.errors import UserError
from skg.files import binary_output, read_bytes, write_bytes
from skg.geometry.plane import XY
from skg.job import file as job_files
from skg.job import values
from skg.job.job import Job
from skg.job.machine import INTO, ROMS, SMALL
from skg.job.placing import MIRRORS
from skg.job.read_options import OPEN, START, UNITS
from skg.job.values import MOST_OFFSET
from skg.job.wanted import CLEARANCE_ON, LEAD, LEAD_SHAPES, SIDES
from skg.messages.finding import Finding, Phrase
from skg.messages.render import Medium, Speech, data, line, speech
from skg.reading.read import ReadOptions, layer_lines
from skg.tape.dialect import GcodeDialect
from skg.tape.gcode import is_gcode
from skg.tape.styles import STYLES, to_style
from skg.terminal import remark, show, tell

if TYPE_CHECKING:
    from skg.cutting.ladder import CutResult
    from skg.pipeline.steps import CutDrawing


class JobValue(click.ParamType):
    """A value that a function of `skg.job.values` takes."""

    def __init__(self, name: str, check: Callable[[object], object]) -> None:
        self.name, self.check = name, check

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> object:
        """Return the value as the function has it."""
        try:
            return self.check(value)
        except values.Wrong as wrong:
            return self.fail(str(Phrase("value-wrong", value=repr(value), why=wrong.why)), param, ctx)


def _of_numbers(check: Callable[[object], object]) -> Callable[[object], object]:
    """The check of numbers with commas between them."""
    return lambda value: check(value if isinstance(value, tuple) else numbers_in(value))


#: Numbers with commas between them, none below 0, such as 0.06,0.02,0.
PASSES = JobValue("MM,MM,...", _of_numbers(values.passes))
#: The same for cuts that come on top.
MORE_PASSES = JobValue("MM,MM,...", _of_numbers(values.more_passes))
#: X,Y or a word for a place of the part's box.
ORIGIN = JobValue("X,Y|WORD", lambda value: values.origin(numbers_in(value) or value))
#: A number for each pass; further passes are as the last.
RATES = JobValue("N,N,...", _of_numbers(values.by_pass(is_open=True)))
PRICES = JobValue("N,N,...", _of_numbers(values.by_pass()))
#: A text of one line.
WORDS = JobValue("text", values.text)


class Encoding(click.ParamType):
    """The name of an encoding of text."""

    name = "NAME"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name as Python has it."""
        try:
            return codecs.lookup(str(value)).name
        except LookupError:
            self.fail(str(Phrase("no-encoding", value=repr(value))), param, ctx)


#: Options allowed beside a job file: files to write, and how much to print.
_BESIDE_A_JOB = (
    "file",
    "output",
    "dialect",
    "list_layers",
    "program",
    "sheet",
    "holes",
    "save_job",
    "setup",
    "quiet",
    "in_json",
)


@click.command(name="cut")
@click.argument("file", type=click.Path(allow_dash=True))
@output_option("Tape to write, - for the standard output.")
@click.option("--list-layers", is_flag=True, help="List the layers and their entities; cut nothing.")
@click.option("--program", metavar="FILE", type=click.Path(allow_dash=True), help="Also write the SKG program.")
@click.option("--sheet", metavar="FILE", type=click.Path(), help="Also write the setup sheet: .pdf, .svg or .png.")
@click.option(
    "--holes",
    metavar="FILE",
    type=click.Path(),
    help="Also write the start holes, to be drilled: .csv, a list, or .nc, a drilling program (G81).",
)
@click.option("--wire", type=Millimetres(0, 2 * MOST_OFFSET, min_open=True), help="Diameter of the wire.")
@click.option(
    "--gap",
    type=Millimetres(0, MOST_OFFSET),
    help="Spark gap on each side of the wire.",
)
@offset_option(
    "The wire's distance from the contour, R, instead of --wire and --gap: half the wire plus the gap. Default: 0."
)
@click.option("--layer", "layers", multiple=True, metavar="NAME", help="Take only this layer; may be given again.")
@click.option("--units", type=click.Choice(tuple(UNITS)), help="Units of the drawing, instead of the file's.")
@click.option(
    "--tolerance",
    default=0.005,
    type=Millimetres(0, min_open=True),
    help="Join ends up to this far apart.",
)
@click.option(
    "--open",
    type=click.Choice(OPEN),
    help="Cut, leave or refuse open contours; all: cut every line as drawn. Default: cut without an offset, "
    "refuse with one.",
)
@click.option(
    "--encoding",
    type=Encoding(),
    help="Encoding of a DXF file's names, such as GBK. Default: the file's, else guessed.",
)
@click.option(
    "--side",
    default="auto",
    type=click.Choice(SIDES),
    help="Side of the wire. auto: outside of outlines, inside of openings.",
)
@click.option("--reverse", is_flag=True, help="Cut in the other direction.")
@click.option(
    "--start",
    "starts",
    multiple=True,
    type=COORDINATES,
    help="Start hole, mm; may be given again. Default: points on the layer START, else chosen.",
)
@click.option("--start-layer", default=START, metavar="NAME", help="Layer of the points for start holes.")
@click.option(
    "--lead",
    default=LEAD,
    type=Millimetres(0, min_open=True),
    help="Distance from a chosen start hole to the contour, room permitting.",
)
@click.option(
    "--origin",
    type=ORIGIN,
    help="What is 0,0 on the machine: a place of the drawing, or of the box around the part as it lies then: centre, "
    "lower-left, lower-right, upper-left, upper-right. Default: the drawing's 0,0.",
)
@click.option(
    "--turn", default=0.0, show_default=False, type=Degrees(-360, 360), help="Turn the part, counter-clockwise."
)
@click.option(
    "--mirror",
    type=click.Choice(MIRRORS),
    help="Mirror the part, before it is turned: x swaps left and right, y above and below.",
)
@click.option(
    "--scale",
    default=1.0,
    show_default=False,
    metavar="TIMES",
    type=FiniteRange(1 / values.MOST_SCALE, values.MOST_SCALE),
    help="Scale the part by this factor; the report says so. Wire, leads and tabs keep their size.",
)
@click.option(
    "--clearance",
    type=Millimetres(0, MOST_OFFSET),
    help="Cut a punch and its die, two tapes, NAME-punch and NAME-die, with this between them on each side.",
)
@click.option(
    "--clearance-on",
    default="punch",
    type=click.Choice(CLEARANCE_ON),
    help="Which of the two takes the clearance: a smaller punch, or a larger die; the other is to size.",
)
@click.option("--columns", default=1, metavar="N", type=click.IntRange(1), help="Number of copies side by side.")
@click.option("--rows", default=1, metavar="N", type=click.IntRange(1), help="Number of rows of copies.")
@click.option("--step", type=COORDINATES, help="Step from one copy to the next, mm: to the right, and up.")
@click.option("--around", default=1, metavar="N", type=click.IntRange(1), help="Number of copies around a place.")
@click.option("--about", type=COORDINATES, help="Centre of the copies: a place of the drawing.")
@click.option(
    "--every",
    type=Degrees(-360, 360),
    help="Turn from one copy around a place to the next. Default: evenly, all around.",
)
@click.option(
    "--fit-tolerance",
    default=0.0002,
    type=Millimetres(values.LEAST_FIT),
    help="Largest distance of FIT from splines and ellipses.",
)
@click.option(
    "--lead-shape",
    default="perpendicular",
    type=click.Choice(LEAD_SHAPES),
    help="arc: a quarter of a circle about the start hole touches the contour.",
)
@click.option(
    "--passes",
    metavar="MM,MM,...",
    type=PASSES,
    help="Stock that each pass leaves, mm: 0.06,0.02,0 is three passes. Every second one runs backwards.",
)
@click.option(
    "--tab",
    default=0.0,
    show_default=False,
    type=Millimetres(0),
    help="Length of the tab, a bridge that keeps a part in the stock; the machine stops, the last cut frees the part.",
)
@click.option(
    "--slug-tab", default=0.0, show_default=False, type=Millimetres(0), help="The same for the slug of an opening."
)
@click.option(
    "--tabs",
    default=1,
    metavar="N",
    type=click.IntRange(1, values.MOST_TABS),
    help="Number of tabs on a contour; a start hole follows each.",
)
@click.option(
    "--tab-passes",
    metavar="MM,MM,...",
    type=MORE_PASSES,
    help="Stock that further cuts of a tab leave, mm; its first cut leaves as much as the first pass. Default: none.",
)
@click.option(
    "--overlap",
    default=0.0,
    show_default=False,
    type=Millimetres(0),
    help="Cut this far past the start of a closed contour, and past both ends of a tab.",
)
@click.option(
    "--small",
    default="refuse",
    type=click.Choice(SMALL),
    help="Refuse or skip closed contours that are too small or narrow for the wire, or too short for the tab.",
)
@click.option(
    "--into",
    default="refuse",
    type=click.Choice(INTO),
    help="Refuse or cut closed contours whose wire would gouge another one.",
)
@click.option(
    "--rom",
    default="no-drift",
    type=RomName(ROMS),
    help="The ROM that makes the tape. On a standard tape the misses of the arcs add up.",
)
@click.option("--ram", default=8, metavar="KIB", type=click.IntRange(*values.RAM), help="The board's RAM, KiB.")
@feed_option
@click.option("--material", metavar="TEXT", type=WORDS, help="Material of the stock, for the setup sheet.")
@click.option(
    "--thickness", type=Millimetres(0, min_open=True), help="Thickness of the stock, for time, price and setup sheet."
)
@click.option(
    "--rates",
    metavar="N,N,...",
    type=RATES,
    help="Cutting rate of each pass, mm²/min: with --thickness the time goes by these, not by --feed.",
)
@click.option("--per-area", metavar="N,N,...", type=PRICES, help="Price per mm², for each pass.")
@click.option("--per-hole", metavar="N", type=FiniteRange(0, values.MOST_MONEY), help="Price of a start hole.")
@click.option(
    "--per-pass", metavar="N", type=FiniteRange(0, values.MOST_MONEY), help="Price of a pass along a contour."
)
@click.option("--currency", metavar="TEXT", type=WORDS, help="Currency, printed after each sum.")
@click.option(
    "--style",
    type=click.Choice(list(STYLES)),
    default="punch",
    help="Style of the tape's blocks, as `skg tape` has them.",
)
@click.option(
    "--short-name", is_flag=True, help="Refuse a name for the tape other than .3b with at most eight letters."
)
@click.option("--setup", metavar="NAME", help="Saved setup, for all settings that are not given (docs/tools.md).")
@click.option(
    "--save-job", metavar="FILE", type=click.Path(), help="Also write the settings, as a job file: .job.toml."
)
@machine_option(
    "Write G-code for this machine instead of 3B: one that comes with skg (docs/machines.md), or a file .toml."
)
@click.option("--quiet", is_flag=True, help="Print only warnings, guesses, the setup, and what is not cut.")
@click.option("--json", "in_json", is_flag=True, help="Print the report, or the refusal, as JSON for other programs.")
@click.pass_context
def command(
    context: click.Context,
    file: str,
    output: str,
    list_layers: bool,
    program: str | None,
    sheet: str | None,
    holes: str | None,
    setup: str | None,
    save_job: str | None,
    dialect: GcodeDialect | None,
    quiet: bool,
    in_json: bool,
    **options: Any,  # noqa: ANN401 (as click has them)
) -> None:
    """Cut a drawing: FILE (.dxf, .svg, or a job: .job.toml) becomes a 3B tape.

    Lines, arcs, circles, polylines, ellipses and splines are chained into contours. Openings are cut before the outline
    around them, each from a start hole of its own. The program runs on the board in this process, and the tape is
    followed with the controller's simulation and compared with the drawing before it is written. The report goes to
    standard error. FILE - is the standard input.
    """
    from skg.pipeline.pairing import named

    audience = Speech(speech.language, Medium.JOB if is_job_file(file) else Medium.COMMAND)
    try:
        kept = kept_setups().kept(setup) if setup is not None else {}
        files = _Files(output, program, sheet, holes, save_job)
        if is_job_file(file):
            job, path = _loaded(file, context, kept)
            refuse_onto(files.names, [path])
        else:
            job, path = _asked(context, file, kept, **options), file
        if list_layers:
            _list_layers(job, path, in_json)
            return
        _refuse_names(context, job, files, dialect)
        if save_job:
            _refuse_elsewhere(save_job, path)
        report = _cut(job, [path, file], files, dialect)
        if setup is not None:
            report[0][1][:0] = _used(setup, kept, job)
    except UserError as error:
        error.audience = audience
        raise
    if in_json:
        told = {cut.member: _in_json(cut, more, audience) for cut, more in report}
        click.echo(json.dumps(told.get("", told)), err=True)
        return
    for cut, more in report:
        for finding in (*cut.findings, *more):
            if finding.severity.is_kept or not quiet:
                tell(line(finding.within(named(cut.member)) if cut.member else finding, audience))


def _in_json(cut: CutDrawing, more: list[Finding], audience: Speech) -> dict[str, object]:
    """The report as plain data; lengths in mm."""
    result = cut.result
    return {
        "findings": [data(finding, audience) for finding in (*cut.findings, *more)],
        "blocks": len(result.tape.blocks),
        "stops": len(result.tape.stops),
        "length": round(result.cut_length, 4),
        "seconds": round(result.seconds, 1),
        "off_um": round(1000 * result.checked.off, 3),
        **cut.cost.data(),
        "starts": [list(hole) for planned in result.contours for hole in planned.holes],
    }


def _list_layers(job: Job, path: str, in_json: bool) -> None:
    """Show the drawing's layers."""
    layers, notes = layer_lines(read_bytes(path), path, ReadOptions(encoding=job.read.encoding))
    if in_json:
        click.echo(json.dumps({"layers": list(map(data, layers)), "findings": list(map(data, notes))}))
        return
    for layer in layers:
        show(str(layer))
    for note in notes:
        remark(note.within(path))


def _refuse_names(context: click.Context, job: Job, files: _Files, dialect: GcodeDialect | None) -> None:
    """Refuse names of files that do not fit what is written."""
    from skg.cutting.holes import refuse_name

    if files.sheet:
        picture_format(files.sheet, None)
    if files.holes:
        refuse_name(files.holes)
    if is_gcode(files.output) and not dialect:
        raise UserError(Finding("tape-named-gcode").within(files.output))
    if not dialect and files.output != "-":
        job.tape.refuse_name(Path(files.output).name)
    elif dialect and (given := _given(context, job_files.TAPE)):
        raise UserError(Finding("tape-of-machine", option=f"--{given[0].replace('_', '-')}"))


def _cut(
    job: Job, inputs: list[str], files: _Files, dialect: GcodeDialect | None
) -> list[tuple[CutDrawing, list[Finding]]]:
    """Cut the drawing, the first of the `inputs`, and write the files: each result, and what there is to say of its
    files."""
    from skg.cutting import holes as holes_files
    from skg.dialects.compensated import to_be_set
    from skg.pipeline.placing import told_as_drawn
    from skg.pipeline.steps import cut_all, open_drawing, written

    path = inputs[0]
    opened = open_drawing(job, read_bytes(path), path)
    cuts = [(cut, files.of(cut.member, job.tape.short_name)) for cut in cut_all(job, opened)]
    if len(cuts) > 1:
        # (the job is that of both)
        names = [name for _, own in cuts for name in own[:4] if name]
        refuse_onto(names, [*inputs, *filter(None, [files.job])])
    thick, tapes, others = job.setup.thickness, [], []
    for cut, own in cuts:
        if not dialect and own.output != "-":
            job.tape.refuse_name(Path(own.output).name)
        with told_as_drawn(cut.placement):
            items = cut.result.tape.items
            made = _for_machine(cut.result, dialect, own.output) if dialect else to_style(items, job.tape.style)
        tapes.append((own.output, made))
        if own.program:
            others.append((own.program, cut.result.program.encode("ascii")))
        if own.holes:
            others.append((own.holes, holes_files.holes_file(cut.result.contours, thick, own.holes)))
    for beside, content in others:
        write_bytes(beside, content)
    for cut, own in cuts:
        if own.sheet:
            _write_sheet(job, cut, path, own)
    if files.job:
        write_bytes(files.job, job_files.encoded(written(job, opened)))
    # (last: no tape where something else, or another tape, could not be written)
    with ExitStack() as stack:
        for stream, made in [(stack.enter_context(binary_output(name)), made) for name, made in tapes]:
            stream.write(made)
    report = []
    for cut, own in cuts:
        contours = cut.result.contours
        more = holes_files.findings(contours, thick, own.holes) if own.holes else []
        more += to_be_set(contours, dialect) if dialect else unmarked(own.output, cut.result.tape, job.board.rom)
        report.append((cut, more))
    return report


def _write_sheet(job: Job, cut: CutDrawing, path: str, files: _Files) -> None:
    """Write the setup sheet of a tape."""
    from skg.pictures.sheet import Facts, write_sheet
    from skg.pipeline.pairing import named

    assert files.sheet is not None, "it is asked for"
    drawing, tape = (Path(name).name if name != "-" else "-" for name in (path, files.output))
    whose = f"{drawing}: {named(cut.member)}" if cut.member else drawing
    facts = Facts(whose, tape, cut.account.units, job.place.scale, tuple(cut.cost.figures()))
    write_sheet(cut.result, facts, files.sheet, picture_format(files.sheet, None))


class _Files(NamedTuple):
    """Names of the files to be written; `output`: the tape, or the machine's G-code."""

    output: str
    program: str | None
    sheet: str | None
    holes: str | None
    job: str | None

    @property
    def names(self) -> list[str]:
        """Those that are asked for."""
        return [name for name in self if name]

    def of(self, member: str, is_short: bool) -> _Files:
        """Those of a punch, or of a die: NAME-punch; with a tape of a short name NAME-P. What is no file stays."""
        if not member:
            return self
        if "-" in (self.output, self.program, self.sheet, self.holes):
            raise UserError(Finding("pair-on-stdout"))
        from skg.pipeline.pairing import ending_of

        ending = ending_of(member, is_short)
        own = {kind: _of_member(name, ending) for kind, name in self._asdict().items() if name and kind != "job"}
        return self._replace(**own)


def _of_member(name: str, ending: str) -> str:
    from skg.pipeline.pairing import file_name

    path = Path(name)
    if path.exists() and not path.is_file():
        return name
    return str(path.with_name(file_name(path.name, ending)))


def _for_machine(result: CutResult, dialect: GcodeDialect, output: str) -> bytes:
    """The same cuts as G-code."""
    from skg.dialects.written import machine_program

    positions = "machine" if result.board.is_without_drift else "programmed"
    return machine_program(result.contours, result.tape, positions, result.setup.feed, dialect, output).encode()


def is_job_file(name: str) -> bool:
    """Tell whether a file is a job, by its name."""
    return name.lower().endswith(".toml")


def _given(context: click.Context, names: Iterable[str]) -> list[str]:
    """The options, by their names as fields, that stand on the command line."""
    return [name for name in names if context.get_parameter_source(name) is ParameterSource.COMMANDLINE]


def _asked(context: click.Context, file: str, kept: job_files.Tables, starts: tuple[XY, ...], **options: Any) -> Job:  # noqa: ANN401 (as click has them)
    """The job that the options ask for: they are named as the fields of its parts. `kept`: a setup's tables."""
    given = {
        table: {name: options[name] for name in _given(context, options) if name in keys}
        for table, keys in job_files.TABLES.items()
    }
    # (the wire's distance is the machine's)
    tables = job_files.over(given, kept)
    return Job("standard input" if file == "-" else Path(file).name, starts=starts, **job_files.made(tables))


def _used(name: str, kept: job_files.Tables, job: Job) -> list[Finding]:
    """The setup's name, with what it has set."""
    parts = {table: job_files.table_of(job, table) for table in kept}
    used = job_files.pairs(
        {key: value for table, keys in kept.items() for key, value in keys.items() if parts[table][key] == value}
    )
    return [Finding("setup-used", name=name, settings=tuple(used) or Phrase("setup-beaten"))]


def _loaded(file: str, context: click.Context, kept: job_files.Tables) -> tuple[Job, str]:
    """The job of a file, and where its drawing is; an option beside it that says what is wanted is a `UserError`."""
    for parameter in context.command.params:
        is_given = context.get_parameter_source(parameter.name or "") is ParameterSource.COMMANDLINE
        if is_given and parameter.name not in _BESIDE_A_JOB:
            raise UserError(Finding("option-in-job", option=parameter.opts[0]).within(file))
    job = job_files.decoded(read_bytes(file), file, kept)
    path = Path(file).parent / job.drawing
    if not path.is_file():
        raise UserError(Finding("drawing-not-there", drawing=job.drawing).within(file))
    return job, str(path)


def _refuse_elsewhere(save_job: str, path: str) -> None:
    """A job names its drawing, which lies beside it."""
    if not is_job_file(save_job):
        raise UserError(Finding("not-job-name").within(save_job))
    if path == "-" or Path(realpath(save_job)).parent != Path(realpath(path)).parent:
        raise UserError(Finding("job-elsewhere", drawing=path).within(save_job))
