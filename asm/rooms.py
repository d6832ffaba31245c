#!/usr/bin/env python3
"""Dependencies of the firmware's source files: read from the sources, and written into their headers.

    asm/rooms.py                prints the graph, each file above those that it leans on, and what goes the other way
    asm/rooms.py FILE           what one file offers, and to whom; what it uses, and of whom
    asm/rooms.py --headers      writes the lines Offers: and Uses: of every header anew
    asm/rooms.py --check        says which headers are not as they should be (tests/rom/test_rooms.py does), and which
                                routines are entered in the middle without a comment there

A name belongs to the file that defines it, as a label or by EQU. A file uses another one when it names something of
it in an instruction, a DB, DW or EQU. An operation of the calculator (`QCRS`) belongs to the file of its routine
(`XCRS`), which OPTAB tells; a restart's byte (`DB CALC,...`) to start.asm. What equ.asm and words.asm define belongs to
all. Each file leans on those below it alone, but for calc and float, which are one thing in two files, and for HOOKS.
The line Room: says how many bytes a file may have. Uses: has the seam of a file that fills one (asm/images.py), in
brackets: so another board, with files of its own, changes no header but theirs.
"""

from __future__ import annotations

import re
import signal
import sys
import textwrap
from collections import defaultdict
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from images import place, seams

ASM = Path(__file__).resolve().parent
#: Belong to everybody: names, the operations of the calculator and the words with their routines (words.py).
COMMON = ("equ", "map_rom", "map_rc2014", "map_rc2014_ram", "map_cpm", "ops", "words")
#: Names that a file calls upwards, each at one place that says so. Who is called there depends on the image, or is
#: somebody who could not be below.
HOOKS = {
    "BDINIT": "restart 0 goes to the board",
    "RESET": "its ports are ready",
    "BDREST": "the serial ports are ready: what else the board has",
    "ERR": "restart 1 goes to the monitor",
    "TYPECH": "restart 2 goes to the teletype",
    "CALC0": "restart 5 goes to the calculator",
    "CHKED": "restart 7: the monitor stores the line or carries it out",
    "BDPUN": "the teletype's characters go to the punch too: the board's",
    "BDRDY": "the prompt is there: the board's",
    "LETGO": "a line of the program begins: the board's, which may still be following a block",
    "KEEP": "reset: what it leaves of program and variables",
    "ERLOST": "a line has lost a character: the monitor says so",
    "READY": "the reader has stopped: the prompt",
    "PUNOFF": "a block is complete: the board's, which may follow it",
    "BDOFF": "after an error: the board's",
    "HOLD": "a span of a curve is there: it goes out, or is held back",
    "FLUSH": "a curve ends: what is held back goes out",
    "FITEND": "an item of the route ends a curve",
}
#: The seam of each file that fills one.
SEAMS = seams()
#: Files that may lean on each other.
ONE = ("calc", "float")

DEFINITION = re.compile(r"^(\w+)(?::|\s+EQU\b)")
LABEL = re.compile(r"^(\w+):")
#: A jump, a call, or a jump of the byte-code.
GOES = re.compile(r"\b(?:CALL|JMP|[JC](?:N?[ZC]|P|M)|DB)\s+(\w+)(?:$|-\$)")
#: What says itself why it is gone to.
ERROR = re.compile(r"\bDB\s+ERROR,")
#: An instruction or directive, then its operands.
STATEMENT = re.compile(r"^(?:\w+:)?\s*(?:\w+\s+EQU|\w+)\s+(.*)")
WORD = re.compile(r"(?<![\w&])[A-Z][A-Z0-9]*\b")
TEXT = re.compile(r'"[^"]*"')
OPERATION = re.compile(r"^(Q\w+)\s+EQU\s+(\w+)H\b")
TABLE = re.compile(r"(?:OPTAB:)?\s+DW\s+(.*)")
#: A header's line, with those that go on with it, further in.
OFFERS = re.compile(r"^; Offers:.*\n(?:;  +.*\n)*", re.M)
ROOM = re.compile(r"^; Room: +(\d+) bytes$", re.M)
USES = re.compile(r"^; Uses:.*\n(?:;  +.*\n)*", re.M)


@dataclass
class Room:
    """One source file: its lines, the names that it defines, and what it uses: names by the file they belong to."""

    name: str
    lines: list[str]
    defines: list[str] = field(default_factory=list)
    uses: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))


def code(line: str) -> str:
    """A line without its comment and texts."""
    return TEXT.sub("", line).split(";")[0].rstrip()


def operations(rooms: dict[str, Room]) -> dict[str, str]:
    """Routine by operation of the calculator, from the numbers of the one and the order of OPTAB."""
    numbers: dict[str, int] = {}
    routines: list[str] = []
    for room in rooms.values():
        in_table = False
        for line in room.lines:
            if found := OPERATION.match(line):
                numbers[found[1]] = int(found[2], 16)
            in_table = in_table or line.startswith("OPTAB:")
            if in_table and (table := TABLE.match(code(line))):
                routines += [name.strip() for name in table[1].split(",")]
    return {name: routines[n] for name, n in numbers.items() if 0 < n < len(routines)}


def read(texts: Mapping[str, str]) -> dict[str, Room]:
    """The rooms of an image, from its sources' texts by name, in the order of the ROM."""
    rooms = {name: Room(name, text.splitlines()) for name, text in texts.items()}
    owner: dict[str, str] = {}
    for room in rooms.values():
        room.defines = [found[1] for line in room.lines if (found := DEFINITION.match(line))]
        owner |= dict.fromkeys(room.defines, room.name)
    routines = operations(rooms)
    for room in rooms.values():
        for line in map(code, room.lines):
            operands = STATEMENT.match(line)
            for name in WORD.findall(operands[1]) if operands else ():
                home = owner.get(routines.get(name, name)) or owner.get(name, COMMON[0])
                if home not in (room.name, *COMMON):
                    room.uses[home].add(name)
    return rooms


def leans(rooms: dict[str, Room], hooks: Collection[str] = HOOKS) -> dict[str, list[str]]:
    """The files that each file leans on; what is named in `hooks` does not count."""
    return {room.name: [other for other, names in room.uses.items() if names - set(hooks)] for room in rooms.values()}


def knots(edges: dict[str, list[str]]) -> list[list[str]]:
    """Files that lean on each other round about, in one group; the groups from the lowest up (Tarjan)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in edges[name]:
            if other not in index:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], index[other])
        if low[name] == index[name]:
            at = stack.index(name)
            found.append(sorted(stack[at:]))
            del stack[at:]

    for name in edges:
        if name not in index:
            visit(name)
    return found


def offered(rooms: dict[str, Room], room: Room) -> dict[str, set[str]]:
    """Names that other files use of a file, by file."""
    return {other.name: other.uses[room.name] for other in rooms.values() if room.name in other.uses}


def header(rooms: dict[str, Room], room: Room, seams: Mapping[str, str]) -> tuple[str, str]:
    """The lines Offers: and Uses: as they should be."""
    wanted: set[str] = set().union(*offered(rooms, room).values()) if room.name not in COMMON else set()
    names = [name for name in dict.fromkeys(room.defines) if name in wanted]
    used = sorted({f"[{seams[other]}]" if other in seams else other for other in room.uses})

    def lines(word: str, items: list[str]) -> str:
        text = " ".join(items) or "nothing"
        return textwrap.fill(text, 100, initial_indent=f"; {word:8}", subsequent_indent=";         ") + "\n"

    return lines("Offers:", ["names for all"] if room.name in COMMON else names), lines("Uses:", used)


def room_of(room: Room) -> int | None:
    """Bytes that a header gives its file; None when it does not say so once."""
    found = ROOM.findall("\n".join(room.lines))
    return int(found[0]) if len(found) == 1 else None


def tangled(rooms: dict[str, Room]) -> list[str]:
    """Files that lean on each other round about and may not, a line each."""
    groups = [group for group in knots(leans(rooms)) if len(group) > 1 and group != sorted(ONE)]
    return [f"{' '.join(group)} lean on each other" for group in groups]


def idle_hooks(rooms: dict[str, Room]) -> list[str]:
    """Hooks that nobody needs, a line each."""
    used = set().union(*(names for room in rooms.values() for names in room.uses.values()))
    return [f"{name} is a hook that nobody calls" for name in HOOKS if name not in used]


def wrong_headers(rooms: dict[str, Room], seams: Mapping[str, str] = SEAMS) -> list[str]:
    """Errors in the lines Offers: and Uses:, one line each; and headers that have no Room:."""
    wrong = []
    for room in rooms.values():
        if room.name == "words":
            continue
        text = "\n".join(room.lines) + "\n"
        for shape, line in zip((OFFERS, USES), header(rooms, room, seams), strict=True):
            word = line.split()[1]
            if room.name in COMMON and word == "Uses:":
                continue
            said = shape.findall(text)
            if len(said) != 1:
                wrong.append(f"{room.name}.asm: {len(said)} lines {word}")
            elif said[0] != line:
                have, want = set(said[0].split()), set(line.split())
                lacks, too_much = " ".join(sorted(want - have)), " ".join(sorted(have - want))
                wrong.append(
                    f"{room.name}.asm: {word} lacks [{lacks}], has too much [{too_much}]"
                    if lacks or too_much
                    else f"{room.name}.asm: {word} is written in another way"
                )
        if room.name not in COMMON and room_of(room) is None:
            wrong.append(f"{room.name}.asm: no line Room: N bytes")
    return wrong


def routines_of(room: Room) -> list[str]:
    """The routine that each line of a file belongs to: the first label under a comment begins one."""
    found = []
    routine, before = room.name, ""
    for line in room.lines:
        if before.startswith(";") and (label := LABEL.match(line)):
            routine = label[1]
        found.append(routine)
        before = line
    return found


def silent_entries(rooms: dict[str, Room]) -> list[str]:
    """Places in the middle of a routine that another one goes to, and no comment says so: one line each.

    The comment stands behind the label, right above it, or in the file under the label's name. Labels of the routine
    that goes there have its name, or its beginning, and a number.
    """
    users: dict[str, set[str]] = defaultdict(set)
    for room in rooms.values():
        for line, routine in zip(map(code, room.lines), routines_of(room), strict=True):
            if room.name not in COMMON and (there := GOES.search(line)):
                users[there[1]].add(routine)
    silent = []
    for room in (room for room in rooms.values() if room.name not in COMMON):
        remarks = OFFERS.sub("", "\n".join(line for line in room.lines if line.startswith(";")) + "\n")
        named = set(WORD.findall(remarks))
        above = ["", *room.lines]
        for before, line, routine in zip(above, room.lines, routines_of(room), strict=False):
            label = LABEL.match(line)
            if not label or label[1] in named or ";" in before + line or ERROR.search(line):
                continue
            stem = label[1].rstrip("0123456789")
            if others := sorted(
                name for name in users[label[1]] - {routine} if not name.startswith(stem) and not stem.startswith(name)
            ):
                silent.append(f"{room.name}.asm: {label[1]} is entered by {' '.join(others)}, and no comment says so")
    return silent


def every() -> dict[str, dict[str, Room]]:
    """The rooms of each image, by its name."""
    from build import sources_of
    from images import IMAGES

    return {name: read(sources_of(name)) for name in IMAGES}


def merged(images: dict[str, dict[str, Room]]) -> dict[str, Room]:
    """The rooms of all images in one: what a file offers and uses in any of them."""
    rooms: dict[str, Room] = {}
    for image in images.values():
        for name, room in image.items():
            known = rooms.setdefault(name, Room(name, room.lines, room.defines))
            for other, names in room.uses.items():
                known.uses[other] |= names
    return rooms


def main() -> None:
    """Command line."""
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # `rooms.py | head` ends quietly
    images = every()
    rooms = merged(images)
    if sys.argv[1:] == ["--headers"]:
        for room in rooms.values():
            if room.name == "words":
                continue
            path = ASM / f"{place(room.name)}.asm"
            text = path.read_text()
            for shape, line in zip((OFFERS, USES), header(rooms, room, SEAMS), strict=True):
                text = shape.sub(lambda _, line=line: line, text, count=1)
            path.write_text(text)
    elif sys.argv[1:] == ["--check"]:
        if wrong := wrong_headers(rooms):
            wrong.append("asm/rooms.py --headers writes Offers: and Uses: anew")
        if wrong := wrong + silent_entries(rooms):
            sys.exit("\n".join(wrong))
    elif len(sys.argv) > 1:
        room = rooms[sys.argv[1].removesuffix(".asm")]
        for other, names in offered(rooms, room).items():
            print(f"  for {other:10} {' '.join(sorted(names))}")
        for other, names in room.uses.items():
            print(f"  of  {other:10} {' '.join(sorted(names))}")
    else:
        for name, image in images.items():
            print(f"{name}:")
            for group in knots(leans(image)):
                print("  " + " ".join(group))
        print(f"hooks: {' '.join(HOOKS)}")


if __name__ == "__main__":
    main()
