"""Signs that are not ASCII, on their way into the board.

Word processors, web pages and Chinese keyboards write a minus, a quote or a bracket that the board has in another form:
it becomes the ASCII sign. The board would take any other byte above 127 without its bit 7, as a sign that nobody typed:
it is refused. emu/signs.c and web/src/signs.ts have the same table; a test compares them.
"""

from __future__ import annotations

import codecs
import re

from skg.messages.finding import Finding

#: ASCII sign -> its other forms, beside the full-width ones.
_ROWS = {
    " ": "\u00a0\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200a\u202f\u205f\u3000",
    "-": "\u2010\u2011\u2012\u2013\u2014\u2015\u2212",
    "*": "\u00d7\u2217",
    "/": "\u00f7\u2044\u2215",
    ":": "\u2236",
    ".": "\u3002",
    '"': "\u201c\u201d\u201e\u201f\u2033",
    "'": "\u2018\u2019\u201a\u201b\u2032",
}
#: The full-width forms of ! to ~ begin here.
_WIDE = 0xFF01
_TABLE = {ord(other): sign for sign, others in _ROWS.items() for other in others} | {
    _WIDE + index: chr(ord("!") + index) for index in range(ord("~") - ord("!") + 1)
}
_STRANGE = re.compile(r"[^\x00-\x7f]")
_CTRL_U = "\x15"
#: Keys that end a line, drop it, drop its last sign, or hold the paper and let it go on.
_ENDS, _DROPS, _RUBS, _HOLDS = "\r\n", "\x03\x15", "\x08\x7f", "\x11\x13"


def with_signs(text: str) -> str:
    """Return a text with the ASCII sign for each of its other forms; what else is not ASCII stays."""
    return text if text.isascii() else text.translate(_TABLE)


def decoded(data: bytes) -> str:
    """Return a text in UTF-8 with ASCII signs; a byte that is no UTF-8 becomes U+DC80 to U+DCFF."""
    return with_signs(data.decode("utf-8", "surrogateescape"))


def strange(text: str) -> re.Match[str] | None:
    """The first character of a text that the board has no sign for."""
    return _STRANGE.search(text)


def shown(character: str) -> str:
    """A strange character for a message: itself, its number where it would not be seen, or its byte."""
    number = ord(character)
    if 0xDC80 <= number <= 0xDCFF:
        return f"byte {number - 0xDC00:02X}H"
    return f"'{character}'" if character.isprintable() else f"U+{number:04X}"


class Keys:
    """Keys on their way to the board, whenever they come: the same signs, and a line with a strange one is dropped.

    What the board has of that line is taken back by ctrl-U; the rest, up to RETURN, ctrl-U or ctrl-C, is not sent.
    `column`: signs typed in the present line.
    """

    def __init__(self) -> None:
        self.column = 0
        self._is_dropped = False
        self._decoder = codecs.getincrementaldecoder("utf-8")("surrogateescape")

    def feed(self, data: bytes) -> tuple[bytes, list[Finding]]:
        """Return what goes to the board, and a finding for each line that is dropped."""
        sent, refused = "", list[Finding]()
        for sign in with_signs(self._decoder.decode(data)):
            if not sign.isascii():
                if not self._is_dropped:
                    refused.append(Finding("line-dropped", column=self.column + 1, character=shown(sign)))
                    sent += _CTRL_U if self.column else ""
                self._is_dropped = True
            elif self._is_dropped and sign not in _HOLDS:
                if sign in _ENDS or sign in _DROPS:
                    self._is_dropped, self.column = False, 0
                    sent += "" if sign in _ENDS else sign
            else:
                sent += sign
                self._count(sign)
        return sent.encode("ascii"), refused

    def _count(self, sign: str) -> None:
        if sign in _ENDS or sign in _DROPS:
            self.column = 0
        elif sign in _RUBS:
            self.column = max(0, self.column - 1)
        elif sign >= " ":
            self.column += 1
