"""Draws the wiring of docs/pico.md: docs/pictures/pico.svg.

pico/wiring.py
"""

from __future__ import annotations

from html import escape
from pathlib import Path

PICTURE = Path(__file__).resolve().parents[1] / "docs" / "pictures" / "pico.svg"
#: The Pico's pins in use: number, name, height of its row.
PINS = {
    "GP2": (4, 60), "GP3": (5, 85), "GP4": (6, 170), "GP5": (7, 195), "GP6": (9, 280), "GP7": (10, 330),
    "GP8": (11, 380), "GP9": (12, 430), "GND": (3, 480), "VBUS": (40, 530),
}  # fmt: skip
PICO_RIGHT, BOX_LEFT, BOX_WIDTH = 190, 380, 250
#: Box: title, top, height, and (pin of the Pico, name at the box).
BOXES = [
    ("X driver (A4988, TMC2209)", 40, 100, [("GP2", "STEP"), ("GP3", "DIR")]),
    ("Y driver", 150, 100, [("GP4", "STEP"), ("GP5", "DIR")]),
    ("transistor: relay, magnet, laser", 262, 38, [("GP6", "1 = cutting")]),
    ("stop button, limit switches", 312, 38, [("GP7", "closed, to ground")]),
    ("feed clock from outside", 362, 38, [("GP8", "each rising edge a step")]),
    ("servo: lifts the pen", 412, 38, [("GP9", "signal")]),
    ("ground of all", 462, 38, [("GND", "drivers, servo, supply")]),
    ("5 V of the servo", 512, 38, [("VBUS", "+")]),
]


def text(x: float, y: float, words: str, options: str = "") -> str:
    """Words at a place."""
    return f'<text x="{x}" y="{y}" {options}>{escape(words)}</text>'


def picture() -> str:
    """The SVG."""
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 900 580" font-family="sans-serif" font-size="14">',
        '<rect width="900" height="580" fill="white"/>',
        f'<rect x="40" y="30" width="{PICO_RIGHT - 40}" height="520" rx="8" fill="#e8f4ea" stroke="#276738"/>',
        text(52, 20, "Raspberry Pi Pico", 'font-weight="bold"'),
    ]
    for name, (number, y) in PINS.items():
        lines.append(text(PICO_RIGHT - 10, y + 5, f"{name}  (pin {number})", 'text-anchor="end"'))
        lines.append(f'<circle cx="{PICO_RIGHT}" cy="{y}" r="4" fill="#c9a227"/>')
    for title, top, height, wires in BOXES:
        box = f'x="{BOX_LEFT}" y="{top}" width="{BOX_WIDTH}" height="{height}"'
        lines.append(f'<rect {box} rx="4" fill="#f4f4f4" stroke="#444"/>')
        lines.append(text(BOX_LEFT + BOX_WIDTH + 12, top + 24, title, 'font-weight="bold"'))
        for pin, name in wires:
            y = PINS[pin][1]
            lines.append(f'<path d="M{PICO_RIGHT} {y}H{BOX_LEFT}" stroke="#b03030" stroke-width="2"/>')
            lines.append(text(BOX_LEFT + 10, y + 5, name))
    for top, axis in ((40, "X"), (150, "Y")):
        lines.append(text(BOX_LEFT + 110, top + 80, f"1A 1B 2A 2B: {axis} motor"))
        lines.append(text(BOX_LEFT + BOX_WIDTH + 12, top + 46, "VMOT 12 V, 100 µF beside it"))
        lines.append(text(BOX_LEFT + BOX_WIDTH + 12, top + 66, "VDD, MS1 to MS3: 3V3 (pin 36)"))
        lines.append(text(BOX_LEFT + BOX_WIDTH + 12, top + 86, "ENABLE: ground"))
    return "\n".join([*lines, "</svg>", ""])


if __name__ == "__main__":
    PICTURE.write_text(picture())
