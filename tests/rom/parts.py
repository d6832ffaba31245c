"""Random parts: whole programs of the kind that people write, made so that most of them can be cut.

Each family makes the statements of one route or of one piece of arithmetic; `session` puts some of them together
with FROM, BACK and END. A share is then spoilt on purpose, so that errors and what they leave on the tape are
compared too.

Among the statements of a family `*L5` is a mark, to which `GOTO L5`, `GOSUB L5` and `RESTORE L5` lead (to
`*LOOP`, of which there may be several, a `GOTO LOOP` behind it), and `? 3` an answer that the operator has ready for an
INPUT.
"""

from __future__ import annotations

import math
import re
from random import Random

Statements = list[str]

#: Where a drawing lies: all coordinates stay below this, in mm.
SIZE = 100


def decimal(rng: Random, low: float, high: float, digits: int = 3) -> str:
    """A constant as people type it."""
    text = f"{rng.uniform(low, high):.{rng.randint(0, digits)}f}"
    return "0" if float(text) == 0 else text


def signed(rng: Random, low: float, high: float) -> str:
    """A constant of either sign, its size between two bounds."""
    return rng.choice(["", "-"]) + decimal(rng, low, high)


def point(x: float, y: float) -> str:
    """A point literal on the grid of a micrometre."""
    return f"({x:.3f},{y:.3f})"


def around(rng: Random, count: int, centre: tuple[float, float], least: float, most: float) -> list[str]:
    """Corners of a star-shaped polygon, counter-clockwise, as point literals."""
    step = 2 * math.pi / count
    turn = rng.uniform(0, step)
    corners = []
    for n in range(count):
        angle = turn + (n + rng.uniform(-0.25, 0.25)) * step
        radius = rng.uniform(least, most)
        corners.append(point(centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)))
    return corners


def somewhere(rng: Random) -> tuple[float, float]:
    """The middle of a route."""
    return rng.uniform(-50, 50), rng.uniform(-50, 50)


def offset(rng: Random) -> Statements:
    """The wire's offset, if any."""
    return rng.choice([[], [], [f"R={signed(rng, 0.01, 0.3)}"], ["R=0.09"], ["R=-0.1"], ["R=0"]])


def separator(rng: Random) -> str:
    """Left or right."""
    return rng.choice(",,;")


def split(rng: Random, items: list[str]) -> Statements:
    """A route's items, each with its separator in front, as one CUT or several."""
    lines, line = [], ""
    for n, item in enumerate(items):
        body = item if n == 0 else item[1:] if not line and item[0] == "," else item
        if len(line) + len(body) > 60 or (line and rng.random() < 0.15):
            lines.append(line)
            line = item[1:] if item[0] == "," else item
        else:
            line += body
    return [f"CUT {text}" for text in [*lines, line]]


def points(rng: Random) -> Statements:
    """A polygon by its corners, some rounded, entered in the middle of an edge."""
    count = rng.randint(3, 9)
    corners = around(rng, count, somewhere(rng), 8, 40)
    if rng.random() < 0.5:
        corners.reverse()
    lines = [f"P{n}={corner}" for n, corner in enumerate(corners, start=1)]
    lines.append(f"V1=P{count}+(P1-P{count})*0.{rng.randint(3, 7)}")
    items = ["V1"]
    for n in range(1, count + 1):
        items.append(f",P{n}")
        if rng.random() < 0.35:
            items.append(f"{separator(rng)}{rng.uniform(0.2, 2):.{rng.randint(1, 3)}f}")
    if items[-1][1] != "P" and rng.random() < 0.5:
        items.pop()
    if rng.random() < 0.3:
        items.append(",V1")
    return lines + offset(rng) + split(rng, items) + ["BACK"]


def open_points(rng: Random) -> Statements:
    """An open line of points that ends at one; the next FROM or END ends it."""
    corners = around(rng, rng.randint(2, 7), somewhere(rng), 5, 40)
    return offset(rng) + split(rng, [corners[0], *(f",{corner}" for corner in corners[1:])])


def arcs(rng: Random) -> Statements:
    """A polygon with arcs for some of its edges, each through both its corners."""
    count = rng.randint(3, 7)
    corners = around(rng, count, somewhere(rng), 10, 40)
    lines = [f"P{n}={corner}" for n, corner in enumerate(corners, start=1)]
    items: list[str] = []
    for n in range(1, count + 1):
        m = n % count + 1
        items.append(f",P{n}")
        if rng.random() < 0.6:
            lines += [
                f"P20=(P{n}+P{m})*0.5",
                f"O[{20 + n}]=P20+((P{m}-P{n})#90)*{rng.choice(['', '-'])}{rng.uniform(0.2, 3):.3f}",
                f"C{n}={rng.choice(['', '-'])}(O{20 + n}/P{n})",
            ]
            items.append(f",C{n}")
    items[0] = items[0][1:]
    items.append(",P1")
    return lines + offset(rng) + split(rng, items) + ["BACK"]


def belt(rng: Random) -> Statements:
    """Belt lines around circles of either sense, tangent at every corner."""
    count = rng.randint(2, 6)
    centres = around(rng, count, somewhere(rng), 18, 40)
    lines = []
    for n, centre in enumerate(centres, start=1):
        sign = "-" if rng.random() < 0.25 else ""
        lines += [f"P{n}={centre}", f"C{n}=P{n}:{sign}{rng.uniform(0.5, 5):.3f}"]
    for n in range(1, count + 1):
        lines.append(f"S{n}=C{n}:C{n % count + 1}")
    items: list[str] = []
    for n in range(1, count + 1):
        items += [f"{separator(rng)}S{n}", f"{separator(rng)}C{n % count + 1}"]
    items[0] = items[0][1:]
    if rng.random() < 0.3:
        items.append(f"{separator(rng)}S1")
    return lines + offset(rng) + ["FROM (P1+P2)/2"] + split(rng, items) + ["BACK"]


def notched(rng: Random) -> Statements:
    """A polygon of lines with a circle across some of its corners, joined by turns to either side."""
    count = rng.randint(3, 7)
    corners = around(rng, count, somewhere(rng), 25, 40)
    lines = [f"P{n}={corner}" for n, corner in enumerate(corners, start=1)]
    lines += [f"S{n}=P{n}:P{n % count + 1}" for n in range(1, count + 1)]
    items = ["S1"]
    for n in range(2, count + 2):
        m = (n - 1) % count + 1
        if rng.random() < 0.6:
            ball = rng.random() < 0.5  # ears are walked counter-clockwise, notches clockwise
            lines.append(f"C{m}=P{m}:{'' if ball else '-'}{rng.uniform(0.5, 5):.3f}")
            # Into an ear the path turns right, out of it right again; a notch turns left.
            turn = ";" if ball else ","
            if rng.random() < 0.1:
                turn = separator(rng)
            items += [f"{turn}C{m}", f"{turn}S{m}"]
        else:
            items += rng.choice([[], [f"{separator(rng)}{rng.uniform(0.3, 3):.2f}"]])
            items.append(f"{separator(rng)}S{m}")
    if rng.random() < 0.5 and items[-2][0] != ";":  # BACK's own corner turns left
        items.pop()
    return lines + offset(rng) + [f"FROM P1+(P2-P1)*0.{rng.randint(4, 6)}"] + split(rng, items) + ["BACK"]


def whole_circle(rng: Random) -> Statements:
    """A single circle, in every way of writing it."""
    x, y = somewhere(rng)
    text = f"C={point(x, y)}:{signed(rng, 1, 30)}"
    cut = rng.choice([["CUT C", "BACK"], ["CUT C,C", "BACK"], ["CUT C:1", "BACK"], ["CUT -C", "BACK"]])
    return [text, *offset(rng), *cut]


def mark(rng: Random) -> str:
    """A name for a place in the program that no other has."""
    return f"L{rng.randrange(10**9)}"


def wheel(rng: Random) -> Statements:
    """A toothed wheel by a loop of computed points, names or turns."""
    loop = mark(rng)
    count = rng.choice([3, 4, 5, 6, 8, 9, 10, 12])
    outer, inner = rng.uniform(25, 45), rng.uniform(12, 22)
    lines = [*offset(rng), f"I={rng.choice(['0', '1'])}", f"J=I+{count}"]
    kind = rng.randrange(4)
    if kind == 0:
        body = [f"A=I*{360 / count:.9g}", f"CUT {outer:.2f}#A,{inner:.2f}#(A+{180 / count:.6g})"]
    elif kind == 1:
        body = [f"P[I]={outer:.3f}#(I*360/{count})", "CUT P[I]"]
        body.append(f"CUT P[I]*0.{rng.randint(6, 9)}#{120 / count:.6f}")
    elif kind == 2:
        body = [
            f"A=I/{count}*360",
            f"CUT ({outer:.2f},-1)#A,({outer:.2f},1)#A,({inner:.2f},1.5)#A",
            "REM tooth",
        ]
    else:
        body = [
            f"A=I*360/{count}",
            f"P[I+1]={outer:.1f}#A",
            f"CUT P[I+1]#(-1:O),{rng.uniform(0.1, 0.6):.2f},P[I+1],P[I+1]#(A:O)#-A",
        ]
    relation = rng.choice(["<", "<>", "<"])
    return [*lines, f"*{loop}", *body, "I=I+1", f"IF I{relation}J GOTO {loop}", "BACK"]


def slots(rng: Random) -> Statements:
    """A slot of two half circles, by belt lines or by parallels, now and then mirrored or turned."""
    x, y = somewhere(rng)
    r = f"{rng.uniform(0.8, 4):.2f}"
    lines = [
        f"P1={point(x, y)}",
        f"P2=P1+({rng.uniform(6, 30):.2f}#{signed(rng, 1, 180)})",
        f"C1=P1:{r}",
        f"C2=P2:{r}",
    ]
    if rng.random() < 0.4:
        lines += [f"S9=P1:({x + 3:.1f},{y + 7:.1f})", "C1=C1/S9", "C2=C2/S9", "P2=P2/S9"]
    elif rng.random() < 0.4:
        lines += ["C2=C2#(33:P1)", "P2=P2#33:P1"]
    lines += ["S1=C1:C2", rng.choice(["S2=C2:C1", f"S2=-S1:-2*{r}", "S2=S1#(180:(P1+P2)/2)"])]
    return lines + offset(rng) + [f"FROM (P1+P2)*0.{rng.randint(3, 7)}", "CUT S1,C2,S2,C1", "BACK"]


def crossings(rng: Random) -> Statements:
    """Points found by crossings of lines and circles of either kind of turn, then cut as a polygon."""
    x, y = somewhere(rng)
    lines = [
        f"C1={point(x, y)}:{signed(rng, 8, 25)}",
        f"C2={point(x + rng.uniform(4, 9), y + rng.uniform(-5, 5))}:{signed(rng, 8, 15)}",
        f"S1={point(x - 30, y + rng.uniform(-4, 4))}:{point(x + 30, y + rng.uniform(-4, 4))}",
        f"S2=S1#({rng.uniform(40, 140):.1f}:{point(x, y)})",
        f"P1=C1*{rng.choice(['', '-'])}C2",
        f"P2=S1*{rng.choice(['', '-'])}C1",
        f"P3={rng.choice(['', '-'])}C2*S2",
        "P4=S1*S2",
        f"P5=P1#{rng.choice(['S1', 'S2'])}",
        "P6=P4/(P1#P2)",
    ]
    names = [f"P{n}" for n in range(1, 7)]
    rng.shuffle(names)
    return [*lines, "PRINT " + ",".join(names), "R=0", "CUT " + ",".join(names[:5]), "BACK"]


def copied(rng: Random) -> Statements:
    """A wheel by REP: one tooth of points, lines or an arc, at times a fillet that waits for the join."""
    count = rng.randint(2, 9)
    outer, inner = rng.uniform(25, 45), rng.uniform(14, 22)
    half = 180 / count
    x, y = rng.choice([(0.0, 0.0), somewhere(rng)])
    about = f":{point(x, y)}" if (x, y) != (0, 0) else rng.choice(["", ":O"])
    tooth = [f"P1={point(x, y)}+({outer:.2f}#0)", f"P2={point(x, y)}+({inner:.2f}#{half:.6g})"]
    if rng.random() < 0.4:
        tooth += [f"P3={point(x, y)}+({outer:.2f}#{half / 2:.6g})", f"C1={point(x, y)}/P1"]
        items = ["P1", ",C1", ",P3", ",P2"]
    else:
        items = ["P1", ",P2"]
    if rng.random() < 0.4:
        items.append(f",{rng.uniform(0.2, 0.9):.2f}")
    step = f"360/{count}" if rng.random() < 0.5 else f"{360 / count:.9g}"
    return [*tooth, *offset(rng), *split(rng, items), f"REP {count},{step}{about}", *rng.choice(AGAIN)]


def mirrored(rng: Random) -> Statements:
    """Half a contour by points, some of them rounded, and its image by SYM; entered on the mirror."""
    x, y = somewhere(rng)
    count = rng.randint(1, 4)
    step = 40 / count
    corners = [point(x + rng.uniform(4, 30), y + step * (n + rng.uniform(0.2, 0.8))) for n in range(count)]
    items = [point(x, y), f",{point(x + rng.uniform(5, 30), y)}"]
    for corner in corners:
        items.append(f",{corner}")
        if rng.random() < 0.3:
            items.append(f",{rng.uniform(0.2, 1.5):.2f}")
    items.append(f",{point(x, y + 45)}")
    mirror = rng.choice([f"SYM {point(x, y + 50)}:{point(x, y)}", f"SYM Y:{x:.3f}"])
    return [*offset(rng), *split(rng, items), mirror, *rng.choice(AGAIN)]


#: The route is closed, and cut again by some.
AGAIN = [["BACK"], ["BACK"], ["BACK", "R=0.05", "RECUT"], ["BACK", "R=0", "RECUT", "RECUT"]]


def scaled(rng: Random) -> Statements:
    """Another route, enlarged or made smaller, then the scale set back."""
    factor = rng.choice(["2", "0.5", "1.02", decimal(rng, 0.6, 1.5)])
    route = rng.choice([points, arcs, slots, whole_circle, called, tabled, copied, mirrored])(rng)
    return [f"SCALE {factor}", *route, "SCALE 1"]


def skimmed(rng: Random) -> Statements:
    """A route cut again and again in a loop, with less offset each time."""
    route = rng.choice([points, slots, copied, mirrored, whole_circle])(rng)
    again = mark(rng)
    passes = rng.randint(1, 4)
    body = [f"*{again}", rng.choice(["R=R*0.5", "R=R-0.01", f"R={passes}*0.1-I*0.07"]), "RECUT", "I=I+1"]
    return [*route, "I=0", "R=0.2", *body, f"IF I<{passes} GOTO {again}"]


def called(rng: Random) -> Statements:
    """Holes cut by a subroutine: called one by one or in a loop, with a subroutine of its own or not."""
    hole, inner, go, loop = (mark(rng) for _ in range(4))
    x, y = somewhere(rng)
    shape = rng.choice(
        [
            ["C=P:D", "CUT C", "BACK"],
            ["CUT P+(-D,-D),P+(D,-D),P+(D,D),P+(-D,D),P+(-D,-D)"],
            ["CUT P+(D#0),P+(D#120),P+(D#240)", "BACK"],
            ["S1=X:K2 P-D", "S2=Y:-(K1 P+D)", "P9=S1*S2", "CUT P9,P,P9+(D,D)", "BACK"],
        ]
    )
    sub = [f"*{hole}", "FROM P", *shape]
    if rng.random() < 0.4:
        sub += [f"GOSUB {inner}"]
        sub += [f"GOTO {go}R", f"*{inner}", "D=D*1.03", *rng.choice([[], ["PRINT D,P"]]), "RETURN", f"*{go}R"]
    lines = [*offset(rng), f"D={decimal(rng, 1, 4)}", f"GOTO {go}", *sub, "RETURN", f"*{go}"]
    if rng.random() < 0.5:
        for _ in range(rng.randint(1, 4)):
            lines += [f"P={point(*somewhere(rng))}", f"GOSUB {hole}"]
        return lines
    step = f"({rng.uniform(5, 12):.2f}#{rng.randint(0, 359)})"
    lines += ["I=0", f"P={point(x, y)}", f"*{loop}", f"GOSUB {hole}", f"P=P+{step}", "I=I+1"]
    return [*lines, f"IF I<{rng.randint(2, 6)} GOTO {loop}"]


def nested(rng: Random) -> Statements:
    """Points of an open route from a subroutine that calls itself, at times deeper than there are levels."""
    sub, out, go = (mark(rng) for _ in range(3))
    x, y = somewhere(rng)
    deepest = rng.choice([1, 2, 4, 7, 8, 8, 9, 12])
    body = [f"*{sub}", "J=J+1", f"CUT {point(x, y)}+({rng.uniform(5, 30):.2f}*J#{rng.randint(10, 50)}*J)"]
    body += [f"IF J>={deepest} GOTO {out}", f"GOSUB {sub}", f"*{out}", "J1=J1+J", "RETURN"]
    return [*offset(rng), "J=0", "J1=0", f"GOTO {go}", *body, f"*{go}", f"GOSUB {sub}", "PRINT J,J1"]


def tabled(rng: Random) -> Statements:
    """A polygon from DATA, with radii or not, read in a loop; at times read twice, or past the end."""
    table, loop, done = (mark(rng) for _ in range(3))
    count = rng.randint(3, 9)
    corners = around(rng, count, somewhere(rng), 10, 40)
    radii = rng.random() < 0.4
    items = [f"{count if rng.random() < 0.95 else count + 3}"]
    for corner in corners:
        items.append(rng.choice([corner, f"{corner}+O", f"P0+{corner}", f"{corner}#(360:O)", f"-(-{corner})"]))
        if radii:
            items.append(rng.choice([f"{rng.uniform(0.2, 1.5):.2f}", "A/2", "0.25*2"]))
    data, line = [], ""
    for item in items:
        if line and (len(line) + len(item) > 70 or rng.random() < 0.2):
            data.append(f"DATA {line}")
            line = ""
        line += f",{item}" if line else item
    data.append(f"DATA {line}")
    data.insert(rng.randrange(1, len(data) + 1), "REM between")
    cut = "CUT P,D" if radii else "CUT P"
    # Entered in the middle of the last edge, so that every corner can be rounded.
    enter = [f"P8={corners[-1]}", f"P9={corners[0]}", "CUT P8+(P9-P8)*0.5"]
    reads = [f"*{loop}", rng.choice(["READ P,D", "READ P", "READ P,D"]) if not radii else "READ P,D", cut]
    if not radii:
        reads[1] = "READ P"
    body = [f"RESTORE {table}", "READ J", *enter, "I=0", *reads, "I=I+1", f"IF I<J GOTO {loop}", "BACK"]
    if rng.random() < 0.2:
        body += ["RESTORE", f"RESTORE {table}", "READ J,P", "PRINT J,P"]
    lines = [*offset(rng), "A=1", "P0=(0,0)"]
    return [*lines, *data_around(rng, table, data, body, done)]


def data_around(rng: Random, table: str, data: Statements, body: Statements, done: str) -> Statements:
    """DATA before the statements that read it, or behind."""
    rows = [f"*{table}", *data]
    return [*rows, *body] if rng.random() < 0.5 else [*body, f"GOTO {done}", *rows, f"*{done}"]


def asked(rng: Random) -> Statements:
    """A route by the numbers, points and circle that the operator gives, some only after wrong answers."""
    x, y = somewhere(rng)

    def answers(right: str, *more: str) -> Statements:
        """Wrong answers, at times, and then the right one."""
        wrong = ["", "1/0", "Z", "P77", "(1,2,3)", "SQR -1", "1+", '"A"', "10 END", "X*X", "1E99", "A[1.5]", "=", *more]
        tries = [rng.choice(wrong) for _ in range(rng.choice([0, 0, 1, 3]))]
        return [f"? {answer}" for answer in [*tries, rng.choice([right, f" {right} ", right.lower()])]]

    lines = ["INPUT D,P1", *answers(decimal(rng, 4, 9), "(1,2)", "X"), *answers(point(x, y), "3", "C7")]
    lines += ["INPUT C1", *answers(f"P1:{decimal(rng, 12, 20)}", "P1", "7")]
    lines += ["I=2", "INPUT P[I],A", *answers("P1+(D,0)", "D")]
    lines += answers(rng.choice(["45", "-30", "ATG 1", "D*10"]), "P1")
    lines += ["PRINT D,P1,C1,P2,A"]
    lines += rng.choice([["CUT C1", "BACK"], ["CUT P1,P2,P2#(A:P1)", "BACK"], ["CUT P1,P2#(A:P1),P2,P1"]])
    return lines[: len(lines) - rng.choice([0, 0, 0, 1])]


def decided(rng: Random) -> Statements:
    """Sums that come near a number, and every relation of them, told by what is printed and cut."""
    step = rng.choice(["0.1", "1/3", "0.7", "SQR 2", "1.1"])
    times = rng.randint(2, 12)
    loop = mark(rng)
    lines = ["A=0", "I=0", f"*{loop}", f"A=A+{step}", "I=I+1", f"IF I<{times} GOTO {loop}", f"D=({step})*{times}"]
    for relation in rng.sample(["=", "<>", "<", ">", "<=", ">="], rng.randint(2, 6)):
        yes = mark(rng)
        other = rng.choice(["D", "D", f"{times}", "D+1E-5", "D-0.001", "INT D", "INT(A+0.5)"])
        lines += [f"IF A{relation}{other} GOTO {yes}", f'PRINT "NOT {relation}",INT A', f"*{yes}"]
    return [*lines, *rng.choice([points, whole_circle])(rng)]


#: The families, the more telling ones twice.
ROUTES = [points, arcs, notched] * 2 + [open_points, belt, whole_circle, wheel, slots, crossings]
ROUTES += [copied, mirrored, scaled, skimmed, called, nested, tabled, tabled, asked, decided]

# ---- Arithmetic ----

NUMBERS, POINTS, CIRCLES, LINES = "ADIJ", "PV", "CBT", "S"


def expression(rng: Random, kind: str, depth: int) -> str:
    """A random expression of a kind (D P C S) by the rows of language.md, section 2.1, in all parentheses or none."""

    def e(wanted: str) -> str:
        return expression(rng, wanted, depth - 1)

    if depth == 0:
        match kind:
            case "D":
                return rng.choice(["A", "D", "I", "J1", signed(rng, 0.5, 20), "30", "-45", "1.5E1"])
            case "P":
                return rng.choice(["P1", "P2", "V", "O", "P[I]", "P[I+1]", f"({signed(rng, 0, 40)},7)"])
            case "C":
                return rng.choice(["C1", "C2", "B", "T5", "C[I]"])
            case _:
                return rng.choice(["S1", "S2", "X", "Y", "S[I+1]"])
    n, p, c, s = "D", "P", "C", "S"
    rows = {
        "D": [
            lambda: f"({e(p)},{e(p)})", lambda: f"({e(p)},{e(s)})", lambda: f"({e(s)},{e(p)})",
            lambda: f"({e(s)},{e(s)})", lambda: f"{e(n)}*{e(n)}", lambda: f"{e(p)}*{e(p)}",
            lambda: f"{e(n)}/{e(n)}", lambda: f"({e(n)}+{e(n)})", lambda: f"({e(n)}-{e(n)})",
            lambda: f"-{e(n)}", lambda: f"SQR(ABS({e(n)}))", lambda: f"SIN({e(n)})",
            lambda: f"COS({e(n)})", lambda: f"TG({e(n)})", lambda: f"ATG({e(n)})", lambda: f"INT({e(n)})",
            lambda: f"K{rng.randint(1, 2)} {e(p)}", lambda: f"K{rng.randint(1, 3)}({e(c)})",
            lambda: f"K{rng.randint(1, 3)}({e(s)})",
        ],
        "P": [
            lambda: f"({e(n)},{e(n)})", lambda: f"({e(n)}#{e(n)})", lambda: f"({e(p)}#{e(n)})",
            lambda: f"({e(p)}#({e(n)}:{e(p)}))", lambda: f"({e(p)}#{e(s)})", lambda: f"{e(s)}*{e(s)}",
            lambda: f"({e(s)})*({e(c)})", lambda: f"({e(c)})*({e(s)})", lambda: f"({e(c)})*-({e(c)})",
            lambda: f"({e(p)}*{e(n)})", lambda: f"({e(n)}*{e(p)})", lambda: f"({e(p)}/{e(n)})",
            lambda: f"({e(p)}/({e(s)}))", lambda: f"({e(p)}+{e(p)})", lambda: f"({e(p)}-{e(p)})",
            lambda: f"-{e(p)}",
        ],
        "C": [
            lambda: f"({e(p)}:{e(n)})", lambda: f"({e(c)}:{e(n)})", lambda: f"({e(c)}#{e(n)})",
            lambda: f"({e(c)}#({e(n)}:{e(p)}))", lambda: f"(({e(c)})/({e(s)}))", lambda: f"({e(p)}/{e(p)})",
            lambda: f"-({e(c)})",
        ],
        "S": [
            lambda: f"({e(s)}:{e(n)})", lambda: f"({e(s)}:{e(p)})", lambda: f"({e(s)}:{e(c)})",
            lambda: f"({e(p)}:{e(p)})", lambda: f"({e(c)}:{e(c)})", lambda: f"({e(c)}:{e(p)})",
            lambda: f"({e(p)}:{e(c)})", lambda: f"({e(s)}#{e(n)})", lambda: f"({e(s)}#({e(n)}:{e(p)}))",
            lambda: f"({e(p)}#{e(p)})", lambda: f"(({e(s)})/({e(s)}))", lambda: f"-({e(s)})",
        ],
    }  # fmt: skip
    return rng.choice(rows[kind])()


def givens(rng: Random) -> Statements:
    """Values for the names that `expression` uses."""
    x, y = somewhere(rng)
    return [
        "I=1",
        f"A={signed(rng, 1, 90)}",
        f"D={signed(rng, 1, 30)}",
        f"J1={decimal(rng, 1, 9)}",
        f"P1={point(x, y)}",
        f"P2={point(y - 9, x + 4)}",
        f"V={point(x / 2, -y)}",
        f"C1=P1:{signed(rng, 5, 30)}",
        f"C2=P2:{signed(rng, 5, 30)}",
        f"B=V:{signed(rng, 5, 40)}",
        f"T5=C1:{decimal(rng, 0.5, 3)}",
        "S1=P1:P2",
        f"S2=X:{signed(rng, 0, 20)}#{signed(rng, 5, 170)}",
    ]


def arithmetic(rng: Random) -> Statements:
    """One PRINT of a random expression of any kind."""
    kind = rng.choice("DPCS")
    text = expression(rng, kind, rng.choice([1, 1, 2, 2, 3]))
    name = {"D": "D7", "P": "V3", "C": "B2", "S": "S[I+5]"}[kind]
    return [f"{name}={text}", f"PRINT {name}"] if rng.random() < 0.5 else [f"PRINT {text}"]


# ---- Whole programs ----


def numbered(statements: Statements) -> str:
    """The program's text: line numbers, marks resolved, answers left out."""
    lines: list[str] = []
    marks: dict[str, int] = {}
    loop = ""
    for statement in statements:
        number = 10 * (len(lines) + 1)
        if statement[0] == "*":
            marks[statement[1:]] = number
            loop = f"GOTO {number}"
        elif statement[0] != "?":
            lines.append(f"{number} {statement.replace('GOTO LOOP', loop)}")
    if statements[-1][0] == "*":
        lines.append(f"{10 * (len(lines) + 1)} REM the end")
    text = "\n".join([*lines, ""])
    return re.sub(r"\bL\d{2,}R?\b", lambda name: str(marks[name[0]]), text)


def spoilt(rng: Random, program: str) -> str:
    """A program with something wrong in it: a line lost, a constant changed, a turn the other way.

    What counts a loop's turns stays as it is, so that every program ends.
    """
    lines = program.splitlines()
    at = rng.choice([n for n, line in enumerate(lines) if not re.match(r"\d+ [IJ]=", line)])
    match rng.randrange(5):
        case 0:
            del lines[at]
        case 1:
            lines[at] = re.sub(r"(?<=[=:,(])\d+(\.\d+)?", signed(rng, 0, 200), lines[at], count=1)
        case 2:
            cuts = [n for n, line in enumerate(lines) if " CUT " in line] or [at]
            at = rng.choice(cuts)
            lines[at] = lines[at].replace(*rng.choice([",;", ";,"]), 1)
        case 3:
            lines.insert(at, f"{lines[at].split()[0][:-1]}5 R={signed(rng, 0, 9)}")
        case _:
            number, _, statement = lines[at].partition(" ")
            if "=" in statement:
                lines[at] = f"{number} {statement}+{rng.choice(['P', '1', 'S', 'C'])}"
    return "\n".join(lines) + "\n"


def session(rng: Random) -> tuple[str, tuple[str, ...]]:
    """A program of one to three routes, and the operator's answers to its INPUTs."""
    statements: Statements = []
    if rng.random() < 0.8:
        statements.append(f"FROM {point(*somewhere(rng))}")
    for n in range(rng.choice([1, 1, 1, 2, 3])):
        if n and rng.random() < 0.6:
            statements.append(f"FROM {point(*somewhere(rng))}")
        statements += rng.choice(ROUTES)(rng)
        if statements[-1] != "BACK":
            statements.append(f"FROM {point(*somewhere(rng))}")
    if rng.random() < 0.7:
        statements.append("END")
    program = numbered(statements)
    answers = tuple(statement[2:] for statement in statements if statement[0] == "?")
    return spoilt(rng, program) if rng.random() < 0.12 else program, answers


def part(rng: Random) -> str:
    """A program that asks nothing."""
    while True:
        program, answers = session(rng)
        if not answers:
            return program
