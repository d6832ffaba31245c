"""docs/board.md: its tables are those of the netlist, and the netlist is a board for roms/skg-tty.bin.

    tests/docs/test_minimal_board.py            writes the tables (make docs)

`make board` looks the netlist through by SKiDL's rules; here it is read without that.
"""

from __future__ import annotations

import re
from collections import defaultdict
from pathlib import Path

from skg.board import symbols

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "board.md"
NETLIST = (ROOT / "docs" / "board" / "minimal.net").read_text()
#: The nets of the two supplies.
HIGH, LOW = "+5V", "GND"


def parts() -> dict[str, str]:
    """Each part's value."""
    return dict(re.findall(r'\(comp\s+\(ref "(\w+)"\)\s+\(value "([^"]*)"\)', NETLIST))


def nets() -> dict[str, list[tuple[str, str]]]:
    """What each net joins: part and pin."""
    found: dict[str, list[tuple[str, str]]] = {}
    for net in re.split(r"\(net\b", NETLIST.partition("(nets")[2])[1:]:
        name = re.search(r'\(name "([^"]*)"\)', net)
        assert name
        found[name[1]] = re.findall(r'\(node\s+\(ref "(\w+)"\)\s+\(pin "(\w+)"\)', net)
    return found


def at(part: str, pin: int) -> str:
    """The net at a pin."""
    return next(name for name, nodes in nets().items() if (part, str(pin)) in nodes)


def tables() -> str:
    """Bill of materials and wiring, for the page."""
    same: dict[str, list[str]] = defaultdict(list)
    for ref, value in sorted(parts().items(), key=lambda item: (item[0][0], int(re.sub(r"\D", "", item[0])))):
        same[value].append(ref)
    rows = ["| part | count | on the board |", "|---|---|---|"]
    rows += [f"| {value} | {len(refs)} | {', '.join(refs)} |" for value, refs in same.items()]
    rows += ["", "| net | joins (part.pin) |", "|---|---|"]
    for name, nodes in sorted(nets().items()):
        if name not in (HIGH, LOW):
            rows.append(f"| {name} | {', '.join(f'{part}.{pin}' for part, pin in nodes)} |")
    return "\n".join(rows)


def page() -> str:
    """The page with these tables."""
    text = PAGE.read_text()
    return re.sub(r"(?s)(<!-- netlist -->\n).*(\n<!-- end -->)", lambda m: f"{m[1]}{tables()}{m[2]}", text)


def test_the_page_has_the_netlist() -> None:
    assert page() == PAGE.read_text(), "make docs"


def test_every_chip_has_power_and_its_capacitor() -> None:
    chips = {ref for ref in parts() if ref[0] in "UX"}
    joined = nets()
    for supply in (HIGH, LOW):
        assert chips <= {part for part, _ in joined[supply]}
    blocking = [ref for ref, value in parts().items() if value == "100n"]
    assert len(blocking) >= len(chips)
    assert all({(ref, "1")} <= {*joined[HIGH]} and {(ref, "2")} <= {*joined[LOW]} for ref in blocking)


def test_memory_and_ports_are_the_image_s() -> None:
    """By the decoder's truth table: Y0 is low for 000, Y1 for 001 of C B A."""
    assert [at("U5", pin) for pin in (1, 2, 3)] == ["A13", "A14", "A15"]
    assert (at("U5", 15), at("U5", 14)) == (at("U2", 20), at("U3", 20)), "the ROM is at 0000, the RAM at 2000"
    assert (at("U5", 4), at("U5", 5), at("U5", 6)) == ("/MREQ", LOW, "/RFSH")
    names = symbols((ROOT / "roms" / "skg.sym").read_text())
    tty, data = names["TTYST"], names["TTYDT"]
    assert (tty, data) == (0x10, 0x11)
    # CS0 high and /CS2 low at these ports, CS1 high but where an interrupt is acknowledged; RS is what differs.
    assert [at("U4", pin) for pin in (8, 9, 10, 11)] == ["A4", "A7", "/M1", "A0"]
    for port in (tty, data):
        assert port >> 4 & 1 and not port >> 7 & 1
    assert (tty & 1, data & 1) == (0, 1)


def test_the_z80_s_buses_reach_each_chip_in_order() -> None:
    address = {0: 30, 1: 31, 2: 32, 3: 33, 4: 34, 5: 35, 6: 36, 7: 37, 8: 38, 9: 39, 10: 40, 11: 1, 12: 2}
    memory = {0: 10, 1: 9, 2: 8, 3: 7, 4: 6, 5: 5, 6: 4, 7: 3, 8: 25, 9: 24, 10: 21, 11: 23, 12: 2}
    data = {0: 14, 1: 15, 2: 12, 3: 8, 4: 7, 5: 9, 6: 10, 7: 13}
    for bit, pin in address.items():
        assert at("U1", pin) == at("U2", memory[bit]) == at("U3", memory[bit]), bit
    for bit, pin in data.items():
        eprom = (11, 12, 13, 15, 16, 17, 18, 19)[bit]
        assert at("U1", pin) == at("U2", eprom) == at("U3", eprom) == at("U4", 22 - bit), bit


def test_the_rate_is_the_image_s() -> None:
    """The clock's sixteenth, sixteen times 9,600 baud."""
    clock = re.search(r"([\d.]+) MHz", parts()["X1"])
    assert clock and float(clock[1]) * 1e6 / 16 / 16 == 9600
    assert at("U7", 11) == at("U4", 3) == at("U4", 4)
    assert "9,600 baud" in PAGE.read_text()


if __name__ == "__main__":
    PAGE.write_text(page())
