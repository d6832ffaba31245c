"""CP/M for the tests: Digital Research's own CCP and BDOS, on an 8080 and a Z80, with disks in memory (PyPI `cpm80`).

What is typed waits in the console until it is asked for; a machine runs until it asks for a key in vain.
"""

from __future__ import annotations

import functools
import os
from pathlib import Path

import cpm80

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "roms" / "skg.com"
EXAMPLES = sorted((ROOT / "examples").glob("*.skg"))
#: Those that run from a file to a file: each so-many-th, all in `make hunt`.
SOME_EXAMPLES = EXAMPLES[:: int(os.environ.get("SKG_EVERY", "3"))]
RECORD, CTRL_Z = 128, b"\x1a"
#: What the paper ends with when a line is awaited: by SKG, by INPUT.
PROMPTS = (b"\r\n>", b"\r\n? ")
#: Looks at the keyboard, and characters printed, after which a machine that still runs hangs.
PATIENCE = 200_000
SMALL = cpm80.DiskFormat(num_blocks=24, block_size=1024, num_dir_entries=32)


class Waits(Exception):
    """A key is asked for, and there is none."""


class Console:
    """Keyboard and paper. `after` types keys once the paper ends with something."""

    def __init__(self) -> None:
        self.keys, self.paper = bytearray(), bytearray()
        self.after: list[tuple[bytes, bytes]] = []
        self.patience = PATIENCE

    def _used(self) -> None:
        self.patience -= 1
        assert self.patience > 0, bytes(self.paper[-300:])

    def input(self) -> int:
        """The next key (BIOS CONIN)."""
        if not self.keys:
            raise Waits
        return self.keys.pop(0)

    def ready(self) -> bool:
        """Is there one (BIOS CONST)?"""
        self._used()
        if not self.keys and self.paper.endswith(PROMPTS):
            raise Waits
        return bool(self.keys)

    def output(self, character: int) -> None:
        """Print a character (BIOS CONOUT)."""
        self._used()
        self.paper.append(character)
        if self.after and self.paper.endswith(self.after[0][0]):
            self.keys += self.after.pop(0)[1]


class Drive(cpm80.DiskDrive):
    """A drive whose disk can be made unwritable, or taken out, by hand: the BIOS says that a sector is bad."""

    broken = is_empty = False

    def read_sector(self) -> bytes:
        """Read, or fail."""
        if self.is_empty:
            raise cpm80.Error("no disk")
        return super().read_sector()

    def write_sector(self, data: bytes | bytearray | memoryview) -> None:
        """Write, or fail."""
        if self.broken or self.is_empty:
            raise cpm80.Error("bad sector")
        super().write_sector(data)


class Mixin:
    """Adds interrupts to both machines; they use the stack of the running program."""

    interrupts = 0
    _place, _bytes = -1, 0

    def interrupted_at(self, place: int, stack: int) -> None:
        """Whenever the processor comes to a place an interrupt takes so many bytes of the stack."""
        self._place, self._bytes = place, stack
        self.set_breakpoint(place)

    def on_breakpoint(self) -> None:
        """The interrupt; what the BIOS does."""
        if self.pc == self._place:
            self.interrupts += 1
            for at in range(self.sp - self._bytes, self.sp):
                self.memory[at] = 0xA5
        super().on_breakpoint()


class Machine8080(Mixin, cpm80.I8080CPMMachine):
    """An 8080."""


class MachineZ80(Mixin, cpm80.Z80CPMMachine):
    """A Z80."""


PROCESSORS = {"8080": Machine8080, "Z80": MachineZ80}


@functools.cache
def _formatted(form: cpm80.DiskFormat, program: Path) -> bytes:
    """A disk with SKG.COM alone."""
    image = cpm80.DiskImage(form)
    cpm80.FileSystem(image).write("SKG.COM", program.read_bytes())
    return bytes(image.data)


def text(source: str) -> bytes:
    """A text as an editor of CP/M leaves it."""
    return source.replace("\n", "\r\n").encode() + CTRL_Z


class Cpm:
    """A machine with two drives at CP/M's prompt; A: has SKG.COM and the given files, or is a `disk`; B: is empty."""

    def __init__(
        self,
        processor: str = "8080",
        files: dict[str, bytes] | None = None,
        form: cpm80.DiskFormat | None = None,
        program: Path = PROGRAM,
        disk: bytes | None = None,
    ) -> None:
        form = form or cpm80.DISK_FORMATS["default"]
        first = cpm80.DiskImage(form, data=disk or _formatted(form, program), store_format=False)
        self.drives = [Drive(first), Drive(cpm80.DiskImage(cpm80.DISK_FORMATS["default"]))]
        self.console = Console()
        for name, data in (files or {}).items():
            self.write(name, data)
        self.machine = PROCESSORS[processor](
            drives=self.drives, console_reader=self.console, console_writer=self.console
        )
        self.type("")

    def write(self, name: str, data: bytes, drive: int = 0) -> None:
        """Put a file on a disk, whole records."""
        cpm80.FileSystem(self.drives[drive].image).write(name, data.ljust(-(-len(data) // RECORD) * RECORD, CTRL_Z))

    def names(self, drive: int = 0) -> list[str]:
        """The files of a disk."""
        return sorted(cpm80.FileSystem(self.drives[drive].image).names())

    def read(self, name: str, drive: int = 0) -> bytes:
        """A file's text; what stands behind the first ctrl-Z are ctrl-Zs up to the end of the record."""
        whole = cpm80.FileSystem(self.drives[drive].image).read(name)
        data, mark, rest = whole.partition(CTRL_Z)
        assert mark and len(rest) < RECORD and not rest.strip(CTRL_Z), f"{name}: {whole[-RECORD:]!r}"
        return data

    def type(self, keys: str, end: str = "\r") -> str:
        """Types keys and returns the output from the line's end on (not its echo), up to the next wait for a key."""
        start = len(self.console.paper)
        self.console.patience = PATIENCE
        self.console.keys += (keys + end if keys else "").encode()
        while True:
            try:
                self.machine.run()
            except Waits:
                break
        return self.console.paper[start:].decode().removeprefix(keys)

    def said(self, line: str) -> list[str]:
        """Types a line and returns the lines that SKG prints up to its prompt."""
        return self.type(line).removesuffix(">").split("\r\n")[1:-1]

    def skg(self, tail: str = "") -> list[str]:
        """Start SKG: what it prints behind its name and the free bytes."""
        first, *rest = self.said(f"SKG{tail and ' ' + tail}")[1:]
        assert first.startswith("SKG ") and first[4:].isdigit(), first
        return rest

    @property
    def at_cpm(self) -> bool:
        """Is this CP/M's prompt?"""
        return self.console.paper.endswith((b"\r\nA>", b"\r\nB>"))


__all__ = ["EXAMPLES", "PROCESSORS", "SMALL", "SOME_EXAMPLES", "Cpm", "text"]
