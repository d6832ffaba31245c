"""SKG's expressions as text, with parentheses where its priorities need them (language.md, section 2)."""

from __future__ import annotations

from dataclasses import dataclass

from skg.rivals.plane import ExactCircle, ExactElement, ExactLine, ExactPoint, Real, mp

#: Priorities; higher binds tighter, same operator left to right.
LEVELS = {"#": 0o45, ":": 0o46, "+": 0o47, "-": 0o50, "*": 0o51, "/": 0o52}
FUNCTION, UNARY, ATOM = 0o54, 0o55, 0o60
#: Decimals of numbers that a translator has computed.
DECIMALS = 14


@dataclass(frozen=True)
class SkgText:
    """An expression and the priority of its outermost operator."""

    text: str
    level: int = ATOM

    def __str__(self) -> str:
        return self.text

    def inside(self, level: int) -> str:
        """As an operand: in parentheses unless it binds at least as tightly as `level`."""
        return self.text if self.level >= level else f"({self.text})"


def join(left: SkgText, operator: str, right: SkgText) -> SkgText:
    """Two operands of a two-place operator."""
    level = LEVELS[operator]
    return SkgText(f"{left.inside(level)}{operator}{right.inside(level + 1)}", level)


def minus(operand: SkgText) -> SkgText:
    """Negated; a minus that is there is taken away."""
    if operand.level == UNARY:
        return SkgText(operand.text[1:])
    return SkgText(f"-{operand.inside(ATOM)}", UNARY)


def call(name: str, operand: SkgText) -> SkgText:
    """A function of an operand."""
    return SkgText(f"{name} {operand.inside(ATOM)}", FUNCTION)


def pair(x: SkgText, y: SkgText) -> SkgText:
    """A point, a distance or an angle in parentheses."""
    return SkgText(f"({x},{y})")


def decimal(value: Real) -> SkgText:
    """A computed number, rounded to `DECIMALS`."""
    digits = f"{int(mp.nint(abs(value) * 10**DECIMALS)):0{DECIMALS + 1}d}"
    text = f"{digits[:-DECIMALS]}.{digits[-DECIMALS:]}".rstrip("0").rstrip(".")
    return SkgText(f"-{text}", UNARY) if value < 0 and text != "0" else SkgText(text)


X_AXIS = SkgText("X")


def centre_text(circle: SkgText) -> SkgText:
    """A circle's centre."""
    return pair(call("K1", circle), call("K2", circle))


def sloping(angle: SkgText) -> SkgText:
    """A line at a direction angle."""
    return join(X_AXIS, "#", angle)


def literal(value: ExactElement | Real) -> SkgText:
    """An element, or a number, in computed numbers."""
    match value:
        case ExactPoint(x, y):
            return pair(decimal(x), decimal(y))
        case ExactCircle(centre, r):
            return join(literal(centre), ":", decimal(r))
        case ExactLine(point, way):
            return join(sloping(decimal(mp.degrees(mp.atan2(way.y, way.x)))), ":", literal(point))
    return decimal(value)
