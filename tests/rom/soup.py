"""Small-integer soup: random statements over few names and small whole coordinates.

Curves touch here, coincide, run through each other and through the place where the wire enters; parts that people
draw do so now and then, smooth random numbers never. Every statement of the language is thrown, and every kind of
mistake: wrong kinds, names without a value, tokens lost or doubled, jumps to nowhere, wrong answers, expressions in
deep parentheses. `soup` makes a program from its number; the same seed and number give the same program again.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random


@dataclass(frozen=True)
class Bowl:
    """A program and the operator's answers to its INPUTs."""

    program: str
    answers: tuple[str, ...] = ()

    def __str__(self) -> str:
        """As a file of tests/rom/regressions/ has it."""
        return self.program + "".join(f"? {answer}\n" for answer in self.answers)


#: Names of each kind; O, X and Y stand among them as often as any.
NAMES = {
    "D": ["A", "D", "I", "J", "D1", "A[I]", "R1"],
    "P": ["P", "P1", "P2", "O", "V", "O5", "P[I]", "P[D+1]"],
    "C": ["C", "C1", "C2", "B", "T", "C[I]"],
    "S": ["S", "S1", "S2", "X", "Y", "X2", "S[I]"],
}
PREDEFINED = ("O", "X", "Y")
KINDS = "DPCS"

SMALL = ["0", "1", "2", "3", "4", "5", "6", "8", "10"]
#: Coordinates: mostly whole; halves of a micrometre, and places just inside and outside of one.
COORDINATES = SMALL * 4 + ["-1", "-2", "-3", "-4", "-5", "-6", "-8", "-10"] * 4
COORDINATES += [
    "0.5",
    "-2.5",
    "7.5",
    "0.0005",
    "5.0005",
    "-3.0005",
    "0.0004",
    "4.9994",
    "0.0015",
    "13",
    "-12",
    "20",
]
RADII = [
    "1",
    "2",
    "3",
    "4",
    "5",
    "5",
    "5",
    "10",
    "13",
    "0.5",
    "2.5",
    "-1",
    "-2",
    "-3",
    "-5",
    "-5",
    "-10",
    "0",
]
FILLETS = ["1", "1", "2", "3", "5", "0.5", "0.5", "0.1", "10", "0.0005", "0", "-1"]
OFFSETS = [
    "1",
    "-1",
    "0.5",
    "-0.5",
    "0.1",
    "-0.1",
    "2",
    "-2",
    "5",
    "-5",
    "0",
    "0.0005",
    "10",
]
ANGLES = [
    "0", "30", "45", "60", "90", "90", "120", "135", "180", "180", "270", "360", "-45", "-90", "-180", "450", "36",
]  # fmt: skip
#: Vectors from a circle's middle to points on it, and its radius.
TRIPLES = [
    ((5, 0), 5), ((0, 5), 5), ((3, 4), 5), ((4, 3), 5), ((-3, 4), 5), ((-4, -3), 5), ((0, -5), 5), ((1, 0), 1),
    ((0, 2), 2), ((6, 8), 10), ((-10, 0), 10), ((5, 12), 13),
]  # fmt: skip

#: Every operation of the language by the kind of its result; `{P}` is an operand of that kind.
ROWS = {
    "D": [
        "({P},{P})", "({P},{S})", "({S},{P})", "({S},{S})", "{D}*{D}", "{P}*{P}", "{D}/{D}", "{D}+{D}", "{D}-{D}",
        "-{D}", "+{D}",
        "SQR {D}", "SQR({D})", "SIN {D}", "COS {D}", "TG {D}", "ATG {D}", "ABS {D}", "INT {D}", "INT({D}/{D})",
        "K1 {P}", "K2 {P}", "K1 {C}", "K2 {C}", "K3 {C}", "K1 {S}", "K2 {S}", "K3 {S}", "({D})", "({P}#{D},{P})",
    ],
    "P": [
        "({D},{D})", "({D},{D})", "({D},{D})", "{D}#{D}", "{P}#{D}", "{P}#{D}:{P}", "{P}#({D}:{P})", "{P}#{S}",
        "{S}*{S}", "{S}*{C}", "{S}*-{C}", "{C}*{S}", "{C}*-{S}", "{C}*{C}", "{C}*-{C}", "{P}*{D}", "{D}*{P}",
        "{P}/{D}", "{P}/{S}", "{P}+{P}", "{P}-{P}", "-{P}", "+{P}", "({P}+{P})/2",
    ],
    "C": [
        "{P}:{D}", "{P}:{D}", "{P}:{D}", "{C}:{D}", "{C}#{D}", "{C}#({D}:{P})", "{C}/{S}", "{P}/{P}", "{P}/{P}",
        "-{C}", "+{C}",
    ],
    "S": [
        "{S}:{D}", "{S}:{P}", "{S}:{C}", "{P}:{P}", "{P}:{P}", "{P}:{P}", "{C}:{C}", "{C}:{P}", "{P}:{C}", "{S}#{D}",
        "{S}#({D}:{P})", "{P}#{P}", "{S}/{S}", "-{S}", "+{S}",
    ],
}  # fmt: skip

WRONG_ANSWERS = [
    "", "1/0", "Z", "P77", "(1,2,3)", "SQR -1", "1+", '"A"', "10 END", "X*X", "A[1.5]", "=", "3", "(1,2)", "X", "O:5",
    "R", "CUT X", "1,2", "O:0",
]  # fmt: skip
JUNK = [
    "(", ")", ",", ";", ":", "#", "*", "/", "+", "-", "=", "<", "[", "]", '"', ".", "E", "1", "0", "9999", "10000",
    "P", "X", "R", "Q", "CUT", "SQR ", "K1 ", "TO", "?", "1000", "A1000", "%", "\t", " ", "1E99", "1E-100", "2.",
]  # fmt: skip

TOKEN = re.compile(r'"[^"]*"?|[0-9]+\.?[0-9]*|[A-Z]+ ?|.', re.S)


@dataclass
class _Cook:
    """One program on its way."""

    rng: Random
    known: dict[str, list[str]] = field(default_factory=lambda: {"D": [], "P": ["O"], "C": [], "S": ["X", "Y"]})
    answers: list[str] = field(default_factory=list)

    # Expressions ----------------------------------------------------------------------------------------

    def name(self, kind: str) -> str:
        """A name of a kind, nearly always one that has a value."""
        rng = self.rng
        if self.known[kind] and rng.random() < 0.98:
            return rng.choice(self.known[kind])
        return rng.choice(NAMES[kind])

    def target(self, kind: str) -> str:
        """A name that is given a value: O, X and Y seldom, a computed subscript when it can be had."""
        rng = self.rng
        name = rng.choice(NAMES[kind])
        needs = re.search(r"\[(\w)", name)
        if (name in PREDEFINED or (needs and needs[1] not in self.known["D"])) and rng.random() < 0.97:
            name = NAMES[kind][0]
        return name

    def learn(self, kind: str, name: str) -> None:
        """A name has a value from here on."""
        if name not in self.known[kind]:
            self.known[kind].append(name)

    def number(self) -> str:
        rng = self.rng
        return rng.choice(rng.choice([SMALL, SMALL, COORDINATES, RADII, ANGLES]))

    def point(self) -> str:
        return f"({self.rng.choice(COORDINATES)},{self.rng.choice(COORDINATES)})"

    def leaf(self, kind: str) -> str:
        """A name, or the shortest thing of a kind."""
        rng = self.rng
        if kind == "P" and rng.random() < 0.55:
            return self.point()
        if kind == "D" and (not self.known["D"] or rng.random() < 0.75):
            return self.number()
        if self.known[kind] and rng.random() < 0.75:
            return self.name(kind)
        match kind:
            case "C":
                return f"({rng.choice([self.name('P'), self.point()])}:{rng.choice(RADII)})"
            case "S":
                return f"({self.leaf('P')}:{self.leaf('P')})"
        return self.name(kind)

    def expression(self, kind: str, depth: int) -> str:
        """An expression of a kind (D, P, C, S), at times of another one."""
        rng = self.rng
        if rng.random() < 0.012:
            kind = rng.choice(KINDS)
        if depth == 0:
            return self.leaf(kind)

        def operand(hole: re.Match[str]) -> str:
            text = self.expression(hole[1], rng.randrange(depth))
            whole = re.fullmatch(r"\w+|\(.*\)", text)
            return text if whole or rng.random() < 0.25 else f"({text})"

        return re.sub(r"\{([DPCS])\}", operand, rng.choice(ROWS[kind]))

    def value(self, kind: str) -> str:
        """An expression for an assignment or a statement."""
        return self.expression(kind, self.rng.choice([0, 1, 1, 1, 2]))

    # Statements -----------------------------------------------------------------------------------------

    def assign(self, kind: str | None = None) -> str:
        rng = self.rng
        kind = kind or rng.choice("DPPCCSS")
        name = self.target(kind)
        value = self.value(kind) if rng.random() < 0.7 else self.leaf(kind)
        self.learn(kind, name)
        return f"{name}={value}"

    def offset(self) -> str:
        return f"R={self.rng.choice(OFFSETS)}"

    def item(self, kind: str) -> str:
        return self.leaf(kind) if self.rng.random() < 0.75 else self.value(kind)

    def fillet(self) -> str:
        return self.rng.choice(FILLETS) if self.rng.random() < 0.95 else self.leaf("D")

    def circle_through(self, x: int, y: int) -> str:
        """A circle of either sense through a point of whole coordinates."""
        (dx, dy), r = self.rng.choice(TRIPLES)
        if self.rng.random() < 0.5:
            return f"({x - dx},{y - dy}):{self.rng.choice(['', '-'])}{r}"
        return f"{self.rng.choice(['', '-'])}(({x - dx},{y - dy})/({x},{y}))"

    def corners(self) -> list[str]:
        """Points, with a curve through two neighbours here and there, and fillets."""
        rng = self.rng
        x, y = rng.choice([0, 0, 3, 5, -4, 10]), rng.choice([0, 0, 4, 5, -3])
        items = [f"({x},{y})"]
        for _ in range(rng.choice([1, 2, 2, 3, 3, 4])):
            dx, dy = rng.choice(
                [
                    (5, 0), (0, 5), (-5, 0), (0, -5), (10, 0), (0, 10), (-10, 0), (3, 4), (-4, 3), (6, -8), (1, 1),
                    (2, 4), (-6, 2), (0, 0),
                ]  # fmt: skip
            )  # fmt: skip
            if rng.random() < 0.35:
                match rng.randrange(4):
                    case 0:
                        items.append(f"({x},{y}):({x + dx},{y + dy})")
                    case 1:  # half round
                        items.append(f"{rng.choice(['', '-'])}(({x + dx / 2:g},{y + dy / 2:g})/({x},{y}))")
                    case 2:  # a quarter round
                        middle = f"({x + (dx - dy) / 2:g},{y + (dy + dx) / 2:g})"
                        items.append(f"{rng.choice(['', '-'])}({middle}/({x},{y}))")
                    case _:
                        items.append(self.circle_through(x, y))
            if rng.random() < 0.93:
                x, y = x + dx, y + dy
                items.append(f"({x},{y})")
            if rng.random() < 0.2:
                items.append(self.fillet())
        return items

    def sides(self) -> list[str]:
        """Lines along the axes and circles that touch them or not, with fillets."""
        rng = self.rng
        items = []
        across = rng.choice([0, 1])
        for _ in range(rng.choice([2, 3, 4, 4, 5])):
            side = f"{rng.choice(['', '-'])}{'XY'[across]}"
            place = rng.choice(["", ":5", ":-5", ":10", ":-10", ":3", ":20"])
            items.append(side + place)
            across = 1 - across if rng.random() < 0.85 else across
            if rng.random() < 0.3:
                items.append(self.fillet())
            elif rng.random() < 0.35:
                items.append(
                    f"({rng.choice(['0', '5', '-5', '10', '3'])},{rng.choice(['0', '5', '-5', '10'])}):"
                    f"{rng.choice(['5', '-5', '3', '10', '-10', '2'])}"
                )
        return items

    def mixed(self) -> list[str]:
        """Anything beside anything."""
        rng = self.rng
        items: list[str] = []
        kinds = rng.choice(["P", "PC", "PS", "CS", "CS", "PCS", "PCS", "DPCS", "S", "C"])
        for _ in range(rng.choice([1, 1, 2, 2, 3, 3, 4])):
            kind = rng.choice(kinds)
            if items and rng.random() < 0.12:
                items.append(self.fillet())
            if items and rng.random() < 0.12:
                items.append(rng.choice(items))
            items.append(self.item(kind) if kind != "D" else self.fillet())
        return items

    def cut(self) -> str:
        rng = self.rng
        items = rng.choice([self.corners, self.corners, self.sides, self.mixed])()
        if rng.random() < 0.15:
            items.append(items[0])
        if rng.random() < 0.06:
            items.append(self.fillet())
        if rng.random() < 0.08:
            rng.shuffle(items)
        right = rng.choice([0, 0.1, 0.35, 0.6])
        text = rng.choice(["", "", "", "", ";"])
        for n, item in enumerate(items):
            text += ("" if n == 0 else ";" if rng.random() < right else ",") + item
        return f"CUT {text}"

    def fit(self) -> list[str]:
        """A run of nodes."""
        rng = self.rng
        nodes = [self.leaf("P") for _ in range(rng.choice([1, 2, 3, 3, 4, 5]))]
        if rng.random() < 0.2:
            nodes.append(nodes[0])
        return [f"FIT {node}" + (f",{rng.choice(ANGLES)}" if rng.random() < 0.25 else "") for node in nodes]

    def behind(self) -> list[str]:
        """Nodes close together behind a sharp corner, nearer to it than the wire is thick."""
        rng = self.rng
        side = rng.choice([1, -1])
        away = 90 * side
        nodes = [
            f"(10,0),{away - rng.choice([0, 2, 10])}",
            f"(10,{side * rng.choice([1, 2])}),{away + rng.choice([2, 0, 10])}",
        ]
        nodes += [rng.choice([f"(9,{10 * side})", f"(10,{10 * side})", f"(5,{5 * side})"])] * (rng.random() < 0.8)
        return [
            f"R={rng.choice(['2', '-2', '1', '-1', '0.5', '-0.5', '5'])}",
            rng.choice(["CUT (0,0)", "CUT (0,0),(10,0)", "CUT (20,0)", f"CUT (0,{5 * side})"]),
            *(f"FIT {node}" for node in nodes),
        ]

    def rep(self) -> str:
        rng = self.rng
        count = rng.choice(["2", "2", "3", "4", "4", "5", "6", "8", "1", "0", "-1", "2.5", "I", "D/2"])
        about = rng.choice(["", "", ":O", f":{self.leaf('P')}"])
        return f"REP {rng.choice(['', '', ';'])}{count},{rng.choice(ANGLES)}{about}"

    def sym(self) -> str:
        mirror = self.rng.choice([self.leaf("S"), "X", "Y", self.value("S")])
        return f"SYM {self.rng.choice(['', '', ';'])}{mirror}"

    def shown(self) -> str:
        rng = self.rng
        items = [self.value(rng.choice(KINDS)) for _ in range(rng.choice([1, 1, 2, 3]))]
        if rng.random() < 0.2:
            items.insert(rng.randrange(len(items) + 1), '"IT"')
        return f"PRINT {','.join(items)}" if rng.random() < 0.97 else "PRINT"

    def read(self) -> list[str]:
        """DATA and READ, of which there may be more than DATA."""
        rng = self.rng
        kinds = [rng.choice("DPCS") for _ in range(rng.choice([1, 2, 3]))]
        data = [f"DATA {','.join(self.value(kind) for kind in kinds)}"]
        names = [self.target(kind) for kind in kinds]
        for kind, name in zip(kinds, names, strict=True):
            self.learn(kind, name)
        if rng.random() < 0.25:
            names.append(rng.choice(NAMES[rng.choice(KINDS)]))
        reads = [f"READ {','.join(names)}"]
        if rng.random() < 0.25:
            reads += [
                rng.choice(["RESTORE", "RESTORE 20", "RESTORE 9999", "RESTORE 0"]),
                f"READ {names[0]}",
            ]
        return data + reads if rng.random() < 0.7 else reads[:1] + data + reads[1:]

    def asked(self) -> str:
        """INPUT, with wrong answers, and now and then none."""
        rng = self.rng
        names = []
        for kind in rng.choices(KINDS, k=rng.choice([1, 1, 2])):
            name = self.target(kind)
            names.append(name)
            self.answers += rng.sample(WRONG_ANSWERS, rng.choice([0, 0, 1, 2]))
            if rng.random() < 0.95:
                self.answers.append(self.value(kind))
                self.learn(kind, name)
        return f"INPUT {','.join(names)}"

    def condition(self) -> str:
        rng = self.rng
        relation = rng.choice(["=", "<>", "<", ">", "<=", ">="])
        return f"IF {self.value('D')}{relation}{self.value('D')} GOTO {{jump}}"

    def route(self) -> list[str]:
        """Statements that may well make one whole route."""
        rng = self.rng
        lines = []
        if rng.random() < 0.5:
            lines.append(self.offset())
        if rng.random() < 0.5:
            lines.append(f"FROM {self.leaf('P')}")
        if rng.random() < 0.06:
            lines.append(f"SCALE {rng.choice(['2', '0.5', '10', '3', '0', '-1', '0.1'])}")
        if rng.random() < 0.14:
            if rng.random() < 0.3:
                lines.append(f"TOL {rng.choice(['0.01', '0.1', '1', '0', '0.5', '-1'])}")
            lines += self.behind() if rng.random() < 0.3 else self.fit()
            if rng.random() < 0.4:
                lines.append(self.cut())
        else:
            lines.append(self.cut())
        for _ in range(rng.choice([0, 0, 0, 1, 2])):
            lines.append(
                rng.choice(
                    [
                        self.offset,
                        self.cut,
                        self.sym,
                        self.rep,
                        self.cut,
                        self.rep,
                        self.sym,
                    ]
                )()
            )
        lines += rng.choice(
            [
                ["BACK"], ["BACK"], ["BACK"], [], ["END"], ["BACK", "RECUT"], [f"FROM {self.leaf('P')}"],
                ["BACK", self.offset(), "RECUT"],
            ]  # fmt: skip
        )  # fmt: skip
        return lines

    def anything(self) -> list[str]:
        """One statement, or a few that belong together."""
        rng = self.rng
        one: list[Callable[[], str]] = [
            self.assign, self.assign, self.cut, self.cut, self.offset, self.rep, self.sym, self.shown, self.shown,
            self.asked, self.condition, lambda: f"FROM {self.value('P')}", lambda: "BACK", lambda: "BACK",
            lambda: "RECUT", lambda: "END", lambda: "GOTO {jump}", lambda: "GOSUB {jump}", lambda: "RETURN",
            lambda: f"SCALE {self.leaf('D')}", lambda: f"TOL {self.leaf('D')}", lambda: "REM A,B;",
        ]  # fmt: skip
        many = [self.fit, self.read, self.route]
        n = rng.randrange(len(one) + len(many))
        return [one[n]()] if n < len(one) else many[n - len(one)]()

    # The program ----------------------------------------------------------------------------------------

    def statements(self) -> list[str]:
        rng = self.rng
        lines = []
        if rng.random() < 0.3:
            lines.append(f"I={rng.choice(SMALL)}")
            self.known["D"].append("I")
        lines += [self.assign(rng.choice("PCCSS")) for _ in range(rng.choice([0, 1, 2, 2, 3, 4]))]
        if rng.random() < 0.75:
            for _ in range(rng.choice([1, 1, 1, 2])):
                lines += self.route()
            if rng.random() < 0.15:
                lines[rng.randrange(len(lines)) : 0] = self.anything()
        else:
            for _ in range(rng.choice([1, 2, 3, 4])):
                lines += self.anything()
        if rng.random() < 0.04 and lines:  # a loop
            at = rng.randrange(len(lines))
            lines.insert(0, "J9=0")
            lines[at + 1 :] = [
                *lines[at + 1 :],
                "J9=J9+1",
                f"IF J9<{rng.choice('23')} GOTO {{loop{at}}}",
            ]
        if rng.random() < 0.02:
            deep = rng.randint(1, 40)
            lines.append(
                rng.choice(
                    [
                        f"PRINT {'(' * deep}1{')' * deep}",
                        f"PRINT {'-' * deep}1",
                        f"PRINT {'SQR(' * (deep // 3)}1{')' * (deep // 3)}",
                    ]
                )
            )
        return lines

    def spoilt(self, line: str) -> str:
        """A line with a token lost, doubled, put in, or exchanged with the next one."""
        rng = self.rng
        tokens = TOKEN.findall(line)
        at = rng.randrange(len(tokens))
        match rng.randrange(4):
            case 0:
                del tokens[at]
            case 1:
                tokens.insert(at, tokens[at])
            case 2:
                tokens.insert(at, rng.choice(JUNK))
            case _:
                tokens[at : at + 2] = reversed(tokens[at : at + 2])
        return "".join(tokens)

    def program(self) -> str:
        rng = self.rng
        lines = self.statements()
        direct = rng.choice([0, 0, 0, 0, 0, 0.15, 1])  # share of lines that are carried out at once
        numbers = [10 * (n + 1) for n in range(len(lines))]
        out = []
        for number, line in zip(numbers, lines, strict=True):
            jump = rng.choice([n for n in numbers if n > number] or [number + 10])
            if rng.random() < 0.05:
                jump = rng.choice([0, 5, 9999, 10000, *numbers])
            line = line.replace("{jump}", str(jump))
            line = re.sub(r"\{loop(\d+)\}", lambda at: str(10 * (int(at[1]) + 2)), line)
            if rng.random() < 0.015:
                line = self.spoilt(line)
            line = line if rng.random() < direct else f"{number} {line}"
            out.append(line)
        if rng.random() < 0.03:
            out.append(str(rng.choice(numbers)))  # a line taken out again
        if rng.random() < 0.03:
            rng.shuffle(out)
        if rng.random() < 0.04:
            out = [line.lower() if rng.random() < 0.5 else line.replace("=", " = ").replace(",", " ,") for line in out]
        return "\n".join(out) + "\n"


def soup(seed: str, number: int) -> Bowl:
    """The program of a number, by a seed."""
    cook = _Cook(Random(f"{seed} {number}"))
    program = cook.program()
    return Bowl(program, tuple(cook.answers))
