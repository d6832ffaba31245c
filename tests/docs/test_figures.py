"""The pictures of docs/firmware.md and docs/spec/language.md: drawn here, from what ROM and reference say.

python tests/docs/test_figures.py     draws them anew (make docs does that)
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import escape

import pytest

from skg import Board
from skg.board.emulator import symbols
from skg.ref.interpreter import run
from skg.ref.route import Segment

ROOT = Path(__file__).parents[2]
PICTURES = ROOT / "docs" / "pictures"
PAGES = [ROOT / "docs" / "firmware.md", ROOT / "docs" / "spec" / "language.md"]
ROM = ROOT / "roms" / "skg.bin"
Place = tuple[float, float]

STYLE = """text { font: 13px sans-serif; fill: #222 } .small { font-size: 11px } .code { font-family: monospace }
path, line, rect, circle { fill: none; stroke: #222; stroke-width: 1 } .paper { fill: #fff; stroke: none }
.drawn { stroke: #888; stroke-width: 1.5 } .wire { stroke: #c02; stroke-width: 2.5 }
.help { stroke: #999; stroke-dasharray: 4 3 } .dot { fill: #222; stroke: none }
.arrow { stroke: #06c; stroke-width: 1.5 } polygon.arrow { fill: #06c } polygon.wire { fill: #c02 }
.rom { fill: #dbe8f6 } .cells { fill: #fbe9c9 } .program { fill: #dff0d8 } .sign { fill: #f6d5d5 }"""


class Figure:
    """An SVG picture: places are in its own unit, y upwards, at `scale` pixels; `left` and `top` are its corner's."""

    def __init__(self, width: float, height: float, scale: float = 1, left: float = 0, top: float = 0) -> None:
        self.size = width, height
        self.scale, self.left, self.top = scale, left, top
        self.parts: list[str] = []

    def at(self, place: Place) -> Place:
        """A place in pixels."""
        return (place[0] - self.left) * self.scale, (self.top - place[1]) * self.scale

    def line(self, start: Place, end: Place, kind: str = "") -> None:
        """A straight line."""
        (x1, y1), (x2, y2) = self.at(start), self.at(end)
        self.parts.append(f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"/>')

    def arc(self, start: Place, end: Place, radius: float, sweep: float, kind: str = "") -> None:
        """An arc of less than a full turn; `sweep`, in radians, is positive counter-clockwise."""
        (x1, y1), (x2, y2) = self.at(start), self.at(end)
        flags = f"{int(abs(sweep) > math.pi)} {int(sweep < 0)}"
        pixels = abs(radius) * self.scale
        self.parts.append(
            f'<path class="{kind}" d="M{x1:.1f} {y1:.1f}A{pixels:.1f} {pixels:.1f} 0 {flags} {x2:.1f} {y2:.1f}"/>'
        )

    def circle(self, centre: Place, radius: float, kind: str = "") -> None:
        """A whole circle."""
        x, y = self.at(centre)
        self.parts.append(f'<circle class="{kind}" cx="{x:.1f}" cy="{y:.1f}" r="{radius * self.scale:.1f}"/>')

    def box(self, corner: Place, width: float, height: float, kind: str = "") -> None:
        """A rectangle, from its upper left corner, its size in pixels."""
        x, y = self.at(corner)
        self.parts.append(f'<rect class="{kind}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"/>')

    def arrow(self, start: Place, end: Place, kind: str = "arrow") -> None:
        """A line with a head."""
        self.line(start, end, kind)
        (x1, y1), (x2, y2) = self.at(start), self.at(end)
        angle = math.atan2(y2 - y1, x2 - x1)
        corners = [(x2 - 9 * math.cos(angle + turn), y2 - 9 * math.sin(angle + turn)) for turn in (-0.35, 0.35)]
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in [(x2, y2), *corners])
        self.parts.append(f'<polygon class="{kind}" points="{points}"/>')

    def dot(self, place: Place) -> None:
        """A point."""
        x, y = self.at(place)
        self.parts.append(f'<circle class="dot" cx="{x:.1f}" cy="{y:.1f}" r="3.5"/>')

    def text(self, place: Place, text: str, shift: Place = (0, 0), kind: str = "", anchor: str = "start") -> None:
        """Words; `shift` in pixels, to the right and down."""
        x, y = self.at(place)
        where = f'x="{x + shift[0]:.1f}" y="{y + shift[1]:.1f}"'
        self.parts.append(f'<text class="{kind}" {where} text-anchor="{anchor}">{escape(text)}</text>')

    def svg(self) -> str:
        """The file's text."""
        width, height = self.size
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
        )
        paper = f'<rect class="paper" width="{width}" height="{height}"/>'
        return "\n".join([head, f"<style>{STYLE}</style>", paper, *self.parts, "</svg>", ""])


def path(program: str, *roles: str) -> list[Segment]:
    """The segments of a program's wire that have one of some roles."""
    result = run(program)
    assert result.error is None, result
    return [segment for segment in result.path if segment.role in roles]


def place(point: object) -> Place:
    """A point of the reference as two floats."""
    return float(point.x), float(point.y)  # type: ignore[attr-defined]


def beyond(start: Place, end: Place, by: float) -> Place:
    """The place behind the end of a line, that much further on."""
    length = math.dist(start, end)
    return end[0] + (end[0] - start[0]) * by / length, end[1] + (end[1] - start[1]) * by / length


def travelled(figure: Figure, segment: Segment, kind: str) -> None:
    """A segment as the wire goes it."""
    if segment.is_arc:
        sweep = math.copysign(float(segment.sweep), float(segment.radius))
        figure.arc(place(segment.start), place(segment.end), float(segment.radius), sweep, kind)
    else:
        figure.line(place(segment.start), place(segment.end), kind)


def memory() -> str:
    """ROM and RAM to scale, and once more, larger, the RAM below the program."""
    names = symbols(ROM.with_suffix(".sym").read_text())
    files: dict[str, int] = {}
    for line in ROM.with_suffix(".sym").read_text().splitlines():
        value, _, *file = line.split()
        if file and file[0] not in ("map_rom", "words"):
            files[file[0]] = min(files.get(file[0], 0x2000), int(value, 16))
    files["words"] = names["KEYTAB"]
    used = len(ROM.read_bytes().rstrip(b"\xff"))
    figure = Figure(960, 580)
    top, scale = -40, 16

    def column(x: float, first: int, last: int, per_pixel: float) -> Callable[[int], float]:
        for end, label in ((first, f"{first:04X}"), (last, f"{last - 1:04X}")):
            figure.text((x, top - (end - first) / per_pixel), label, (-6, 4), "small code", "end")
        return lambda address: top - (address - first) / per_pixel

    def part(x: float, rows: Callable[[int], float], first: int, last: int, kind: str) -> None:
        figure.box((x, rows(first)), 90, rows(first) - rows(last), kind)

    def labels(x: float, rows: Callable[[int], float], named: list[tuple[int, int, str]]) -> None:
        low = math.inf
        for first, last, label in named:
            middle = (rows(first) + rows(last)) / 2
            low = min(middle, low - 13)
            figure.line((x, middle), (x + 12, low), "help")
            figure.text((x + 14, low), label, (0, 4), "small")

    figure.text((60, top), "ROM", (0, -14))
    rom = column(60, 0, 0x2000, scale)
    ends = [*list(files.values())[1:], used]
    for first, last in zip(files.values(), ends, strict=True):
        part(60, rom, first, last, "rom")
    part(60, rom, used, 0x2000, "free")
    large = [
        (first, last, file) for (file, first), last in zip(files.items(), ends, strict=True) if last - first >= 180
    ]
    labels(150, rom, [*large, (used, 0x2000, f"free: {0x2000 - used} bytes")])

    figure.text((340, top), "RAM, 8 KiB, the same scale", (0, -14))
    ram = column(340, 0x2000, 0x4000, scale)
    part(340, ram, 0x2000, names["PROG"], "cells")
    part(340, ram, names["PROG"], 0x4000, "program")
    figure.text((345, ram(0x2340)), "firmware's")
    figure.text((345, ram(0x2800)), "program ↓", (0, 4))
    figure.text((345, ram(0x2B00)), "route buffer ↓", (0, 4))
    figure.text((345, ram(0x3F00)), "variables ↑", (0, 4))

    per_pixel = (names["PROG"] - 0x2000) / 512
    figure.text((600, top), "2000 to PROG, once more", (0, -14))
    cells = column(600, 0x2000, names["PROG"], per_pixel)
    for corner in (0x2000, names["PROG"]):
        figure.line((430, ram(corner)), (600, cells(corner)), "help")
    told = {
        "FSTK": "16 floats", "CWORK": "cells: parser, geom, route, tape", "FWORK": "cells: float, calc",
        "MWORK": "cells: monitor, lexer, io", "KEPT": "a node of FIT", "MREG": "64 registers", "LINBUF": "the line",
        "TOKS": "its tokens", "STKLOW": "8080 stack ↑", "STKTOP": "GOSUB", "HELD": "places of FIT",
    }  # fmt: skip
    marks = [*told, "PROG"]
    rows = [(names[a], names[b], f"{a}  {told[a]}") for a, b in zip(marks, marks[1:], strict=False)]
    for first, last, _ in rows:
        part(600, cells, first, last, "cells")
    labels(690, cells, rows)
    return figure.svg()


def float_bytes() -> str:
    """A float worked out in its bytes, as the board keeps it."""
    value = -12.5
    board = Board()
    board.load(f"10 A={value}\n")
    board.run()
    names = symbols(ROM.with_suffix(".sym").read_text())
    variable = board.machine.peek(board.machine.peek16(names["VBOT"]), 7)
    data = variable[2:]
    exponent, sign = data[0] - 128, data[1] >> 7
    mantissa = (int.from_bytes(data[1:], "big") | 1 << 31) / 2**32
    assert (-1) ** sign * mantissa * 2.0**exponent == value
    figure = Figure(720, 160)
    for n, byte in enumerate(data):
        x = 20 + 136 * n
        figure.text((x, -30), f"{byte:02X}", (64, 0), "code", "middle")
        for bit in range(8):
            kind = "cells" if n == 0 else "sign" if (n, bit) == (1, 0) else "rom"
            figure.box((x + 16 * bit, -40), 16, 22, kind)
            figure.text((x + 16 * bit, -40), str(byte >> 7 - bit & 1), (8, 15), "small code", "middle")
    figure.text((20, -40), f"{data[0]} − 128 = {exponent}", (0, 40))
    figure.text((156, -40), f"sign {sign}: {'−' if sign else '+'}", (0, 40))
    bits = "".join(f"{byte:08b}" for byte in data[1:])[1:].rstrip("0")
    figure.text((236, -40), f"31 bits, behind a 1 that is not kept: 0.1{bits} (binary) = {mantissa}", (0, 40))
    figure.text((20, -40), f"{'−' if sign else ''}{mantissa} · 2^{exponent} = {value:g}".replace("-", "−"), (0, 76))
    figure.text((20, -40), "An exponent byte of 0 is the number zero, whatever follows.", (0, 104), "small")
    return figure.svg()


def corner() -> str:
    """The corner between C and N, as drawn and as offset."""
    drawn = [(0.0, 0.0), (9.0, 1.5), (13.0, 9.0)]
    items = ",".join(f"({x:g},{y:g})" for x, y in drawn)
    wire = path(f"10 R=1.6\n20 CUT {items}\n30 END\n", "cut")
    assert len(wire) == 2
    figure = Figure(620, 410, 34, -1.2, 10)
    for start, end in zip(drawn, drawn[1:], strict=False):
        figure.line(start, end, "drawn")
    for segment in wire:
        travelled(figure, segment, "wire")
    entry, turn = place(wire[0].start), place(wire[0].end)
    for point, told, shift in (
        (drawn[0], "D: where C is entered as drawn", (-20, -40)), (drawn[1], "P: the corner as drawn", (-150, -8)),
        (entry, "A: where the wire has entered C", (8, 16)), (turn, "K: the corner of the wire's path", (10, 14)),
    ):  # fmt: skip
        figure.dot(point)
        figure.text(point, told, shift)
    figure.line(drawn[0], entry, "help")
    figure.text(entry, "R", (4, -26))
    middle = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in zip(drawn, drawn[1:], strict=False)]
    figure.text(middle[0], "C: the current element", (40, 66))
    figure.text(middle[1], "N: the next one", (-106, 0))
    for segment in wire:
        start, end = place(segment.start), place(segment.end)
        figure.arrow(start, beyond(end, start, -0.55 * math.dist(start, end)), "wire")
    return figure.svg()


def fillet() -> str:
    """A fillet: parallels at its radius cross in its centre."""
    drawn, radius = [(0.0, 0.0), (10.0, 1.0), (13.0, 9.0)], 3.0
    items = "{},{},{:g},{}".format(
        *(f"({x:g},{y:g})" for x, y in drawn[:2]), radius, f"({drawn[2][0]:g},{drawn[2][1]:g})"
    )
    wire = path(f"10 CUT {items}\n20 END\n", "cut", "fillet")
    [arc] = [segment for segment in wire if segment.is_arc]
    assert arc.centre is not None
    centre, touch, leave = place(arc.centre), place(arc.start), place(arc.end)
    assert math.isclose(math.dist(centre, touch), radius)
    figure = Figure(560, 370, 36, -1.2, 9.4)
    for start, end in zip(drawn, drawn[1:], strict=False):
        figure.line(start, end, "drawn")
    for start, end in ((drawn[0], drawn[1]), (drawn[1], drawn[2])):
        length = math.dist(start, end)
        normal = (start[1] - end[1]) / length * radius, (end[0] - start[0]) / length * radius
        figure.line((start[0] + normal[0], start[1] + normal[1]), (end[0] + normal[0], end[1] + normal[1]), "help")
    for segment in wire:
        travelled(figure, segment, "wire")
    for point in (touch, leave):
        figure.line(centre, point, "help")
    for point, told, shift in (
        (centre, "centre: the crossing of both parallels", (-236, -8)), (touch, "touching point", (-40, 20)),
        (leave, "", (0, 0)), (drawn[1], "the corner, P", (8, 12)),
    ):  # fmt: skip
        figure.dot(point)
        figure.text(point, told, shift)
    figure.text(((centre[0] + touch[0]) / 2, (centre[1] + touch[1]) / 2), "FI", (-20, 4))
    figure.text((4, 0.4), "C", (0, 18))
    figure.text((12, 6.3), "N", (8, 0))
    return figure.svg()


def biarc() -> str:
    """A span of FIT: chord, tangents, the joint, and w from the node to it."""
    nodes, angles = [(0.0, 0.0), (10.0, 1.5)], [65.0, -25.0]
    fits = [f"{n}0 FIT ({x:g},{y:g}),{angle:g}" for n, ((x, y), angle) in enumerate(zip(nodes, angles, strict=True), 1)]
    wire = path("\n".join([*fits, "90 END", ""]), "cut")
    assert len(wire) == 2
    assert all(segment.is_arc for segment in wire)
    joint = place(wire[0].end)
    figure = Figure(620, 260, 44, -1.5, 4.6)
    figure.arrow(*nodes)
    figure.text(((nodes[0][0] + nodes[1][0]) / 2, (nodes[0][1] + nodes[1][1]) / 2), "v = Q − P", (10, 18))
    for node, angle, name in zip(nodes, angles, "tu", strict=True):
        turn = math.radians(angle)
        tip = node[0] + 2.4 * math.cos(turn), node[1] + 2.4 * math.sin(turn)
        figure.arrow(node, tip)
        figure.text(tip, name, (6, -2))
    for segment in wire:
        travelled(figure, segment, "wire")
    figure.arrow(nodes[0], joint)
    figure.text((joint[0] / 2, joint[1] / 2), "w = M − P", (12, 8))
    for point, told, shift in (
        (nodes[0], "P, node 1", (-20, 20)),
        (nodes[1], "Q, node 2", (-40, 22)),
        (joint, "M, the joint", (-20, -12)),
    ):
        figure.dot(point)
        figure.text(point, told, shift)
    return figure.svg()


def travel() -> str:
    """F, the travel counted along the axis since (r, 0), and J of an arc, its difference."""
    radius, start, end = 10, (8, 6), (-6, -8)
    result = run(f"10 CUT {start},O:{radius},{end}\n20 END\n")
    assert result.error is None
    block = re.search(r"B\d+B\d+B(\d+)GXNR\d", result.tape.decode())
    assert block

    def counted(point: Place) -> float:
        u, v = point
        return radius - u if v >= 0 else 3 * radius + u

    difference = counted(end) - counted(start)
    assert difference * 1000 == int(block[1])
    figure = Figure(800, 380, 14, -13.5, 13.5)
    figure.line((-12.5, 0), (12.5, 0), "help")
    figure.line((0, -12.5), (0, 12.5), "help")
    figure.circle((0, 0), radius, "drawn")
    sweep = math.atan2(end[1], end[0]) - math.atan2(start[1], start[0]) + math.tau
    figure.arc(start, end, radius, sweep, "wire")
    figure.text((12, 0), "u", (4, 14))
    figure.text((0, 12.5), "v", (6, 8))
    for point, told, shift in ((start, "start", (8, -6)), (end, "end", (-36, 14))):
        figure.dot(point)
        figure.text(point, told, shift)
    left, foot, wide, high = 20.0, -10.0, 22.0, 20.0
    figure.line((left, foot), (left + wide, foot))
    figure.line((left, foot), (left, foot + high + 1))
    figure.text((left, foot + high + 1), "F", (-6, -6), "", "end")

    def shown(angle: float) -> Place:
        u = radius * math.cos(angle)
        value = radius - u if angle <= math.pi else 3 * radius + u
        return left + wide * angle / math.tau, foot + high * value / (4 * radius)

    curve = [shown(math.tau * n / 90) for n in range(91)]
    for first, last in zip(curve, curve[1:], strict=False):
        figure.line(first, last, "drawn")
    for turn, label in ((0.0, "(r,0)"), (math.pi, "(−r,0)"), (math.tau, "(r,0)")):
        figure.text((left + wide * turn / math.tau, foot), label, (0, 18), "small", "middle")
    for value in (2, 4):
        figure.text((left, foot + high * value / 4), f"{value}r", (-6, 4), "small", "end")
        figure.line((left, foot + high * value / 4), (left + wide, foot + high * value / 4), "help")
    first, last = (shown(math.atan2(point[1], point[0]) % math.tau) for point in (start, end))
    for point, told in ((first, "start"), (last, "end")):
        figure.dot(point)
        figure.text(point, told, (8, 14), "small")
    figure.line(first, (last[0], first[1]), "help")
    figure.arrow((last[0], first[1]), last)
    figure.text((last[0], (first[1] + last[1]) / 2), f"J = {difference:g}", (8, 0))
    return figure.svg()


FIGURES: dict[str, Callable[[], str]] = {
    "firmware-memory": memory,
    "firmware-float": float_bytes,
    "firmware-corner": corner,
    "firmware-travel": travel,
    "language-fillet": fillet,
    "language-biarc": biarc,
}


#: Changes with every byte of the firmware: its numbers are not compared.
MOVING = "firmware-memory"


@pytest.mark.parametrize("name", FIGURES)
def test_figure(name: str) -> None:
    kept, drawn = (PICTURES / f"{name}.svg").read_text(), FIGURES[name]()
    if name == MOVING:
        kept, drawn = (re.sub(r"\d+", "0", text) for text in (kept, drawn))
    assert kept == drawn, "make docs draws it anew"


def test_every_figure_is_shown() -> None:
    shown = {name for page in PAGES for name in re.findall(r"pictures/([\w-]+)\.svg\)", page.read_text())}
    assert set(FIGURES) <= shown
    assert {path.stem for path in PICTURES.glob("firmware-*.svg")} | {
        path.stem for path in PICTURES.glob("language-*.svg")
    } == set(FIGURES)


if __name__ == "__main__":
    for name, draw in FIGURES.items():
        (PICTURES / f"{name}.svg").write_text(draw())
