"""Numbers, places and foreign names as a message has them."""

from __future__ import annotations

#: Blanks that names have, beside the space: the fixed one, and that of Chinese and Japanese texts.
_BLANKS = "\xa0\u3000"


def visible(text: str) -> str:
    r"""A text in which foreign names stand (files, layers, blocks, labels) as it is shown.

    Characters that a screen obeys instead of showing them become escapes, such as \x1b and \u202e: controls, marks of
    direction, line breaks, and bytes of a file's name that are no text. So a name cannot colour, move or add lines.
    """
    if text.isprintable():
        return text
    return "".join(map(_visible, text))


def _visible(character: str) -> str:
    if character.isprintable() or character in _BLANKS:
        return character
    byte = ord(character) - 0xDC00
    # (Python keeps a byte that is no text as one of these)
    return f"\\x{byte:02x}" if 0x80 <= byte <= 0xFF else character.encode("unicode_escape").decode("ascii")


def short(value: float) -> str:
    """A length as a person writes it: at most four decimals."""
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def shown(place: tuple[float, float]) -> str:
    """A place as a person writes it."""
    return f"({short(place[0])}, {short(place[1])})"
