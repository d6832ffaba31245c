"""Every image: which files it is made of. No source file has an IF: what differs is a file of its own.

What differs has a seam, a field of Image. The board: **map**, where things lie; **ports**, their addresses, chips, the
teletype; **punch**, with the reader and /RTS, what is done when a block is complete and after an error; **start**,
reset and the prompt. CP/M fills these with files of its own. **post**: what becomes of a line and an arc in whole um.
**spans**: whether those of a curve are held back. **more**: what some images have besides. Words that not every image
has are a set in words.txt.

A file stands in asm/ itself when every machine has it; in asm/boards/ what there is of a machine (memory, ports, chips,
teletype, punch, reader, handshake, reset, CP/M); in asm/variants/ what takes the place of a part of the language or of
the tape. An image names files alone: no two have the same name.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

#: The folders of the sources, below asm/.
FOLDERS = (".", "boards", "variants")


@dataclass(frozen=True)
class Image:
    """The files that fill the seams, and the sets of words (words.txt) besides the words of all.

    An image without `restarts` leaves them to whom page 0 belongs: the build writes CALLs. `forms` are the files that
    it is written to: the padded ROM and its Intel hex (.bin, .hex), hex without the filling (.hex alone), or .com.
    """

    map: str = "map_rom"
    restarts: bool = True
    ports: tuple[str, ...] = ("ports_2sio", "io_6850", "io_held", "io_tape")
    punch: tuple[str, ...] = ("rts", "hold_line", "hold", "io_punch", "io_ended")
    start: tuple[str, ...] = ("reset", "keep")
    post: tuple[str, ...] = ("round", "arc_3b", "tape")
    spans: tuple[str, ...] = ("tol",)
    more: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    forms: tuple[str, ...] = (".bin", ".hex")

    def files(self) -> list[str]:
        """All source files in the order in which they stand in the ROM; the first ones only name things."""
        return [
            self.map, "equ", "start", "ops", "consts", *self.ports, "io", *self.punch, "calc", "float",
            "decimal", "value", "geom", "parser", *self.post, "route", "corner", "cut", "ends", "repeat", "fit",
            *self.spans, "lexer", "program", "data", "run", *self.more, "monitor", *self.start, "words",
        ]  # fmt: skip

    def for_cpm(self, tape: str) -> Image:
        """The same firmware as a program of CP/M; `tape` says of what type a tape's file is."""
        return replace(
            self, map="map_cpm", restarts=False, ports=("io_cpm",), punch=("nohold", "letgo", "io_disk"),
            start=("cpm",), more=(*self.more, tape), words=(*self.words, "cpm"), forms=(".com",),
        )  # fmt: skip


#: The image that all others are variants of: it alone has a table of symbols, and its bytes are printed file by file.
STANDARD = "skg"
#: No handshake, where room is short.
UNHELD = {
    "ports": ("ports_2sio", "io_6850", "io_port"),
    "punch": ("nohold", "letgo", "io_punch", "io_reader", "io_ended"),
}


def one_line(addresses: str, chip: str = "io_6850") -> dict[str, tuple[str, ...]]:
    """One line, which is the teletype, its punch and its reader: the file of its addresses, that of its chip."""
    return {"ports": (addresses, chip, "io_held", "io_key"), "punch": ("rts", "hold_key", "hold", "io_tty")}


MILL = Image(
    **UNHELD,
    post=("io_send", "round", "arc_iso", "iso"),
    more=("mill",),
    words=("mill",),
)
IMAGES = {
    STANDARD: Image(),
    "skg-8251": Image(ports=("ports_8251", "io_8251", "io_held", "io_tape")),
    "skg-tty": Image(
        ports=("ports_2sio", "io_6850", "io_held", "io_key"), punch=("rts", "hold_line", "hold", "io_tty")
    ),
    "skg-rc2014": Image(map="map_rc2014", **one_line("ports_rc2014")),
    "skg-rc2014-sio": Image(
        map="map_rc2014",
        ports=("ports_sio", "io_sio", "io_held", "io_tape"),
        punch=("rts_sio", "hold_key", "hold", "io_punch", "io_ended"),
    ),
    "skg-rc2014-ram": Image(map="map_rc2014_ram", restarts=False, forms=(".hex",), **one_line("ports_rc2014")),
    "skg-minimax8085": Image(map="map_rc2014", **one_line("ports_minimax8085", "io_8251")),
    "skg-rcbus8085": Image(map="map_rc2014", **one_line("ports_rcbus8085")),
    "skg-8085": Image(map="map_rc2014", ports=("ports_sid", "io_sid"), punch=("hold_sid", "io_tty")),
    "skg-nodrift": Image(post=("round", "arc_nodrift", "tape")),
    "skg-mill": MILL,
    "skg-grbl": replace(MILL, post=("io_ok", *MILL.post[1:]), start=("reset", "keep_none")),
    "skg-drive": Image(
        ports=UNHELD["ports"],
        punch=("nohold", "io_punch", "io_reader"),
        spans=("notol",),
        more=("drive",),
        words=("drive",),
        start=("reset",),
    ),
    "skg-ram": Image(forms=(".hex",)),
    "skg.com": Image().for_cpm("type_3b"),
    "skgmill.com": MILL.for_cpm("type_nc"),
}


def place(file: str) -> str:
    """A source's path below asm/, without .asm: io_held is boards/io_held. ValueError when there is not just one."""
    paths = [Path(folder, file) for folder in FOLDERS]
    known = [path for path in paths if Path(__file__).parent.joinpath(path).with_suffix(".asm").exists()]
    if len(known) != 1:
        raise ValueError(f"{file}.asm: {len(known)} of them in asm/ and its folders {', '.join(FOLDERS[1:])}")
    return known[0].as_posix()


#: The seams whose files others call; those of `map` define names for all.
SEAMS = ("ports", "punch", "start", "post", "spans", "more")


def seams(images: Mapping[str, Image] = IMAGES) -> dict[str, str]:
    """The seam of each file that fills one; a file that all images have fills none."""
    common = set.intersection(*(set(image.files()) for image in images.values()))
    return {
        file: seam for image in images.values() for seam in SEAMS for file in getattr(image, seam) if file not in common
    }
