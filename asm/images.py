"""Every image of the ROM: which files it is made of. No source file has an IF: what differs is a file of its own.

Two seams. The **board**: ports and their setting up (`io_6850`, `io_8251`), punch and reader (`io_punch`, `io_tty`).
The **post-processor**: what becomes of a line and an arc in whole micrometres (`tape`, and `arc_3b` or `arc_nodrift`).
Words that not every image has are a set in words.txt.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Image:
    """The files that fill the seams, and the sets of words (words.txt) besides the words of all."""

    ports: str = "io_6850"
    punch: str = "io_punch"
    post: tuple[str, ...] = ("arc_3b", "tape")
    more: tuple[str, ...] = ()
    words: tuple[str, ...] = ()

    def files(self) -> list[str]:
        """All source files in the order in which they stand in the ROM; equ first, since it only names things."""
        return [
            "equ", "start", self.ports, "io", self.punch, "calc", "ops", "consts", "float", "decimal", "value",
            "geom", "parser", *self.post, "cut", "repeat", "fit", "lexer", "program", *self.more, "monitor", "words",
        ]  # fmt: skip


#: The image that all others are variants of: it alone has a table of symbols, and its bytes are printed file by file.
STANDARD = "skg"
IMAGES = {
    STANDARD: Image(),
    "skg-8251": Image(ports="io_8251"),
    "skg-tty": Image(punch="io_tty"),
    "skg-nodrift": Image(post=("arc_nodrift", "tape")),
}
