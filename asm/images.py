"""Every image: which files it is made of. No source file has an IF: what differs is a file of its own.

Two seams. The **board**: where things lie (`map_rom`), ports and their setting up (`io_6850`, `io_8251`), the teletype
(`io_port`), punch and reader (`io_punch`, `io_tty`), what is done at reset and at the prompt (`reset`). The
**post-processor**: what becomes of a line and an arc in whole micrometres (`tape`, and `arc_3b` or `arc_nodrift`).
Words that not every image has are a set in words.txt.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Image:
    """The files that fill the seams, and the sets of words (words.txt) besides the words of all."""

    map: str = "map_rom"
    ports: tuple[str, ...] = ("io_6850", "io_port")
    punch: str = "io_punch"
    start: str = "reset"
    post: tuple[str, ...] = ("arc_3b", "tape")
    more: tuple[str, ...] = ()
    words: tuple[str, ...] = ()

    def files(self) -> list[str]:
        """All source files in the order in which they stand in the ROM; the first ones only name things."""
        return [
            self.map, "equ", "start", "ops", *self.ports, "io", self.punch, "calc", "consts", "float",
            "decimal", "value", "geom", "parser", *self.post, "cut", "repeat", "fit", "lexer", "program", *self.more,
            "monitor", self.start, "words",
        ]  # fmt: skip


#: The image that all others are variants of: it alone has a table of symbols, and its bytes are printed file by file.
STANDARD = "skg"
IMAGES = {
    STANDARD: Image(),
    "skg-8251": Image(ports=("io_8251", "io_port")),
    "skg-tty": Image(punch="io_tty"),
    "skg-nodrift": Image(post=("arc_nodrift", "tape")),
}
