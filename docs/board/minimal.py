"""The smallest board for roms/skg-tty.bin as a netlist, looked through by SKiDL's electrical rules.

    docs/board/minimal.py           writes minimal.net beside itself (KiCad's form); exit 1 when a rule is broken

Pins are numbered as in the makers' data sheets, packages with two rows.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from skidl import ERC, KICAD8, SKIDL, TEMPLATE, Net, Part, Pin, erc_logger, generate_netlist

HERE = Path(__file__).resolve().parent
OUTPUT, INPUT, BOTH, TRISTATE, PASSIVE, POWER = (
    Pin.types.OUTPUT, Pin.types.INPUT, Pin.types.BIDIR, Pin.types.TRISTATE, Pin.types.PASSIVE, Pin.types.PWRIN,
)  # fmt: skip


def kind(name: str, ref: str, footprint: str, pins: str) -> Part:
    """A part of which others are made. `pins`: number, name and one letter for what it is, from pin 1 on."""
    types = {"o": OUTPUT, "i": INPUT, "b": BOTH, "t": TRISTATE, "p": PASSIVE, "w": POWER, "n": Pin.types.NOCONNECT}
    made = [Pin(num=str(at), name=word[:-2], func=types[word[-1]]) for at, word in enumerate(pins.split(), start=1)]
    return Part(name=name, ref_prefix=ref, footprint=footprint, tool=SKIDL, dest=TEMPLATE, pins=made)


Z80 = kind(
    "Z84C0004PEC", "U", "Package_DIP:DIP-40_W15.24mm",
    "A11:o A12:o A13:o A14:o A15:o CLK:i D4:b D3:b D5:b D6:b VCC:w D2:b D7:b D0:b D1:b /INT:i /NMI:i /HALT:o /MREQ:o "
    "/IORQ:o /RD:o /WR:o /BUSAK:o /WAIT:i /BUSRQ:i /RESET:i /M1:o /RFSH:o GND:w "
    "A0:o A1:o A2:o A3:o A4:o A5:o A6:o A7:o A8:o A9:o A10:o",
)  # fmt: skip
EPROM = kind(
    "27C64", "U", "Package_DIP:DIP-28_W15.24mm",
    "VPP:i A12:i A7:i A6:i A5:i A4:i A3:i A2:i A1:i A0:i D0:t D1:t D2:t GND:w "
    "D3:t D4:t D5:t D6:t D7:t /CE:i A10:i /OE:i A11:i A9:i A8:i NC:n /PGM:i VCC:w",
)  # fmt: skip
SRAM = kind(
    "6264", "U", "Package_DIP:DIP-28_W15.24mm",
    "NC:n A12:i A7:i A6:i A5:i A4:i A3:i A2:i A1:i A0:i D0:b D1:b D2:b GND:w "
    "D3:b D4:b D5:b D6:b D7:b /CE1:i A10:i /OE:i A11:i A9:i A8:i CE2:i /WE:i VCC:w",
)  # fmt: skip
ACIA = kind(
    "68B50", "U", "Package_DIP:DIP-24_W15.24mm",
    "GND:w RXD:i RXCLK:i TXCLK:i /RTS:o TXD:o /IRQ:n CS0:i /CS2:i CS1:i RS:i VCC:w "
    "R/W:i E:i D7:b D6:b D5:b D4:b D3:b D2:b D1:b D0:b /DCD:i /CTS:i",
)  # fmt: skip
DECODER = kind(
    "74HC138", "U", "Package_DIP:DIP-16_W7.62mm",
    "A:i B:i C:i /G2A:i /G2B:i G1:i Y7:o GND:w Y6:o Y5:o Y4:o Y3:o Y2:o Y1:o Y0:o VCC:w",
)  # fmt: skip
INVERTER = kind(
    "74HC14", "U", "Package_DIP:DIP-14_W7.62mm",
    "1A:i 1Y:o 2A:i 2Y:o 3A:i 3Y:o GND:w 4Y:o 4A:i 5Y:o 5A:i 6Y:o 6A:i VCC:w",
)  # fmt: skip
COUNTER = kind(
    "74HC161", "U", "Package_DIP:DIP-16_W7.62mm",
    "/CLR:i CLK:i A:i B:i C:i D:i ENP:i GND:w /LOAD:i ENT:i QD:o QC:o QB:o QA:o RCO:o VCC:w",
)  # fmt: skip
OSCILLATOR = kind("2.4576 MHz", "X", "Oscillator:Oscillator_DIP-8", "EN:n GND:w OUT:o VCC:w")
RESISTOR = kind("R", "R", "Resistor_THT:R_Axial_DIN0207_L6.3mm_D2.5mm_P7.62mm_Horizontal", "1:p 2:p")
CAPACITOR = kind("C", "C", "Capacitor_THT:C_Disc_D5.0mm_W2.5mm_P5.00mm", "1:p 2:p")
DIODE = kind("1N4148", "D", "Diode_THT:D_DO-35_SOD27_P7.62mm_Horizontal", "K:p A:p")
BUTTON = kind("reset", "SW", "Button_Switch_THT:SW_PUSH_6mm", "1:p 2:p")
HEADER = kind(
    "USB-serial adaptor, 5 V", "J", "Connector_PinHeader_2.54mm:PinHeader_1x06_P2.54mm_Vertical",
    "GND:p CTS:p VCC:p TXD:p RXD:p RTS:n",
)  # fmt: skip


def part(kind: Part, ref: str, value: str | None = None) -> Part:
    """A part of a kind; its tag is its name, so that the netlist is the same each time."""
    made = kind(ref=ref, tag=ref)
    made.value = value or kind.name
    return made


def build() -> None:
    """Put the parts together."""
    plus, ground = Net("+5V"), Net("GND")
    plus.drive = ground.drive = Pin.drives.POWER
    cpu, rom, ram, acia = part(Z80, "U1"), part(EPROM, "U2"), part(SRAM, "U3"), part(ACIA, "U4")
    decoder, inverter, counter, clock = (
        part(DECODER, "U5"),
        part(INVERTER, "U6"),
        part(COUNTER, "U7"),
        part(OSCILLATOR, "X1"),
    )
    adaptor = part(HEADER, "J1")
    chips = [cpu, rom, ram, acia, decoder, inverter, counter, clock]
    for chip in chips:
        chip["VCC"] += plus
        chip["GND"] += ground
    plus += adaptor["VCC"]
    ground += adaptor["GND"]

    for bit in range(8):
        Net(f"D{bit}").connect(cpu[f"D{bit}"], rom[f"D{bit}"], ram[f"D{bit}"], acia[f"D{bit}"])
    for bit in range(13):
        Net(f"A{bit}").connect(cpu[f"A{bit}"], rom[f"A{bit}"], ram[f"A{bit}"])
    # 8 KiB each: 0000 the ROM, 2000 the RAM. While memory is refreshed neither is chosen.
    for select, address in zip("ABC", ("A13", "A14", "A15"), strict=True):
        Net(address).connect(cpu[address], decoder[select])
    Net("/MREQ").connect(cpu["/MREQ"], decoder["/G2A"])
    Net("/RFSH").connect(cpu["/RFSH"], decoder["G1"])
    ground += decoder["/G2B"]
    Net("/ROM").connect(decoder["Y0"], rom["/CE"])
    Net("/RAM").connect(decoder["Y1"], ram["/CE1"])
    Net("/RD").connect(cpu["/RD"], rom["/OE"], ram["/OE"], inverter["3A"])
    Net("/WR").connect(cpu["/WR"], ram["/WE"])
    plus += ram["CE2"], rom["VPP"], rom["/PGM"]

    # The 6850 is chosen by addresses alone, which stand long before E rises; so does R/W in an output cycle. /M1: not
    # while an interrupt is acknowledged (there is none).
    cpu["A4"] += acia["CS0"]
    cpu["A7"] += acia["/CS2"]
    cpu["A0"] += acia["RS"]
    Net("/M1").connect(cpu["/M1"], acia["CS1"])
    Net("/IORQ").connect(cpu["/IORQ"], inverter["4A"])
    Net("E").connect(inverter["4Y"], acia["E"])
    Net("R/W").connect(inverter["3Y"], acia["R/W"])
    ground += acia["/DCD"], acia["/CTS"]
    Net("TXD").connect(acia["TXD"], adaptor["RXD"])
    Net("RXD").connect(adaptor["TXD"], acia["RXD"])
    Net("/RTS").connect(acia["/RTS"], adaptor["CTS"])

    # 2.4576 MHz; a sixteenth of it is 16 times 9,600 baud.
    Net("CLK").connect(clock["OUT"], cpu["CLK"], counter["CLK"])
    Net("BAUD").connect(counter["QD"], acia["RXCLK"], acia["TXCLK"])
    plus += counter["/CLR"], counter["/LOAD"], counter["ENP"], counter["ENT"]
    ground += counter["A"], counter["B"], counter["C"], counter["D"]

    # Reset: 10 kOhm and 10 uF, through two Schmitt triggers; the diode empties the capacitor when the power goes.
    slow, charge, diode, button = (
        part(RESISTOR, "R1", "10k"),
        part(CAPACITOR, "C1", "10u"),
        part(DIODE, "D1"),
        part(BUTTON, "SW1"),
    )
    Net("POWER ON").connect(slow[2], charge[1], button[1], diode["A"], inverter["1A"])
    plus += slow[1], diode["K"]
    ground += charge[2], button[2]
    Net("RESET").connect(inverter["1Y"], inverter["2A"])
    Net("/RESET").connect(inverter["2Y"], cpu["/RESET"])
    ground += inverter["5A"], inverter["6A"]
    for count, pin in enumerate(("/INT", "/NMI", "/WAIT", "/BUSRQ"), start=2):
        pull = part(RESISTOR, f"R{count}", "4k7")
        plus += pull[1]
        Net(pin).connect(pull[2], cpu[pin])
    for count, _ in enumerate(chips, start=2):
        block = part(CAPACITOR, f"C{count}", "100n")
        plus += block[1]
        ground += block[2]
    unused = {cpu: "/HALT /BUSAK", decoder: "Y2 Y3 Y4 Y5 Y6 Y7", inverter: "5Y 6Y", counter: "QA QB QC RCO"}
    for chip, outputs in unused.items():
        for output in outputs.split():
            chip[output].do_erc = False


def main() -> None:
    """Build it, ask the rules, write the netlist."""
    build()
    ERC()
    faults = erc_logger.error.count + erc_logger.warning.count
    text = generate_netlist(tool=KICAD8, do_backup=False, file_=str(HERE / "minimal.net"))
    # (the date and the folder of who made it are no part of the board)
    text = re.sub(r'\n\s*\((?:date|source|tool) "[^"]*"\)', "", text)
    (HERE / "minimal.net").write_text(text)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
