"""The 8080 board of `emu/` in Python: run the firmware, type, read paper and punch, call its subroutines.

    m = Machine(Path("roms/skg.bin"))
    m.run()                                  # to the first prompt
    m.type("PRINT 2*3\\r")
    assert m.run() == "prompt"
    print(m.tty)

Addresses and cycles are plain integers; a cycle is 0.5 microseconds on the 2 MHz board.
"""

from __future__ import annotations

import ctypes
import os
from array import array
from collections.abc import Iterable
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from skg.errors import UserError, of_system
from skg.messages.finding import Finding
from skg.native import load

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np
    from numpy.typing import NDArray

#: Results of `run`, in the order of `board_reason` (emu/board.h).
REASONS = ("cycles", "prompt", "input", "wait", "halt", "break", "nobody")
#: Ends of a call, in the order of `machine_end` (emu/machine.h).
ENDS = ("returned", "cycles", "stop", "halt", "wait")
BOARDS = {"6850": 0, "8251": 1, "rc2014": 2, "rc2014-sio": 3, "minimax8085": 4, "rcbus8085": 5}

ROM_SIZE = 0x2000
#: Bytes that a file with an image may have: IMAGE_FILE_LIMIT of emu/image.h.
_ROM_FILE = 1 << 20

#: The registers, as `machine_registers` lays them out, and how numpy names their sizes.
REGISTERS = {"a": "u1", "f": "u1", "bc": "u2", "de": "u2", "hl": "u2", "sp": "u2", "pc": "u2"}


class _Registers(ctypes.Structure):
    _fields_ = [(name, ctypes.c_uint8 if size == "u1" else ctypes.c_uint16) for name, size in REGISTERS.items()]


class _Counts(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_uint64) for name in ("cycles", "instructions", "fetches_outside")),
        *((name, ctypes.c_uint32) for name in ("lowest_sp", "first_outside", "error_lines")),
    ]


class _Job(ctypes.Structure):
    _fields_ = [
        ("registers", _Registers),
        *((name, ctypes.c_uint32) for name in ("max_cycles", "in_length", "out_length")),
        *((name, ctypes.c_uint16) for name in ("in_address", "out_address")),
    ]


#: The faults of an image, in the order of enum image_fault (emu/image.h).
_IMAGE_FAULTS = (
    "image-length",
    "image-no-text",
    "image-no-record",
    "image-record-length",
    "image-checksum",
    "image-past-rom",
    "image-past-ffff",
    "image-kind",
    "image-after-end",
    "image-no-end",
)


def read_rom(path: str) -> tuple[bytes, list[int]]:
    """The 8,192 bytes of an image, .bin or Intel .hex, and the addresses that it leaves out.

    One that cannot be read, or is not that long, is a `UserError`.
    """
    try:
        with open(path, "rb") as file:  # noqa: PTH123  (a Path forgets a "/" at the end)
            data = file.read(_ROM_FILE + 1)
    except OSError as error:
        raise UserError(of_system(error).within(path)) from None
    if len(data) > _ROM_FILE:
        raise UserError(Finding("rom-too-large", most=_ROM_FILE).within(path))
    rom, given = (ctypes.create_string_buffer(ROM_SIZE) for _ in range(2))
    text, line = ctypes.create_string_buffer(data), ctypes.c_int()
    if fault := _library().image_rom_of(os.fsencode(path), text, len(data), rom, given, ROM_SIZE, line):
        values: dict[str, Any] = {"length": len(data), "expected": ROM_SIZE} if fault == 1 else {}
        place = f"{path}:{line.value}" if line.value else path
        raise UserError(Finding(_IMAGE_FAULTS[fault - 1], **values).within(place))
    return rom.raw, [address for address, is_given in enumerate(given.raw) if not is_given]


def symbols(text: str) -> dict[str, int]:
    """Values by name, out of a .sym file's text (asm/build.py).

    Its lines hold a hexadecimal value, a name and, of a label, its source file.
    """
    return {name: int(value, 16) for value, name, *_ in map(str.split, text.splitlines())}


@cache
def _library() -> ctypes.CDLL:
    """The board's library, its functions declared."""
    lib = load("skg80")
    address, size, flag, pointer = ctypes.c_uint16, ctypes.c_size_t, ctypes.c_bool, ctypes.c_void_p
    signatures: dict[str, tuple[object, list[object]]] = {
        "machine_new": (
            pointer,
            [ctypes.c_char_p, size, ctypes.c_uint, ctypes.c_int, flag, ctypes.c_uint],
        ),
        "machine_free": (None, [pointer]),
        "machine_ports": (None, [pointer, ctypes.c_uint8, ctypes.c_uint8]),
        "board_ram_end": (ctypes.c_uint, [ctypes.c_int, ctypes.c_uint]),
        "machine_board": (pointer, [pointer]),
        "machine_output": (size, [pointer, flag, ctypes.POINTER(pointer)]),
        "machine_clear": (None, [pointer]),
        "machine_sender": (None, [pointer, flag, ctypes.c_double, ctypes.c_int]),
        "machine_lost": (ctypes.c_uint64, [pointer]),
        "machine_feed": (None, [pointer, ctypes.c_double]),
        "machine_stop_at": (None, [pointer, ctypes.c_uint64, flag]),
        "machine_drive": (ctypes.c_uint8, [pointer]),
        "machine_hasty_steps": (ctypes.c_uint64, [pointer]),
        "machine_steps": (size, [pointer, ctypes.POINTER(pointer), ctypes.POINTER(pointer)]),
        "machine_peek": (None, [pointer, address, pointer, size]),
        "machine_poke": (None, [pointer, address, ctypes.c_char_p, size]),
        "machine_is_translated": (flag, [pointer]),
        "machine_get": (None, [pointer, ctypes.POINTER(_Registers)]),
        "machine_set": (None, [pointer, ctypes.POINTER(_Registers)]),
        "machine_count": (None, [pointer, ctypes.POINTER(_Counts)]),
        "machine_watch": (None, [pointer, flag, address, address]),
        "machine_interrupt": (None, [pointer, ctypes.c_char_p]),
        "machine_break": (None, [pointer, address, flag]),
        "machine_batch": (
            size,
            [pointer, ctypes.POINTER(_Job), size, ctypes.c_char_p, pointer, pointer, pointer, pointer],
        ),
        "board_reset": (None, [pointer]),
        "board_type": (flag, [pointer, ctypes.c_char_p, size]),
        "board_press": (flag, [pointer, ctypes.c_uint8]),
        "board_tape": (flag, [pointer, ctypes.c_char_p, size]),
        "board_take_tape": (None, [pointer]),
        "board_reader": (None, [pointer, flag]),
        "image_rom_of": (
            ctypes.c_int,
            [*[ctypes.c_char_p] * 2, size, *[ctypes.c_char_p] * 2, size, ctypes.POINTER(ctypes.c_int)],
        ),
        "machine_nobody": (ctypes.c_uint8, [pointer, ctypes.POINTER(flag)]),
        "board_reader_silence": (ctypes.c_uint64, [pointer]),
        "board_run": (ctypes.c_int, [pointer, ctypes.c_uint64]),
    }
    for name, (result, arguments) in signatures.items():
        function = getattr(lib, name)
        function.restype = result
        function.argtypes = arguments
    return lib


@dataclass(frozen=True)
class Batch:
    """Results of n calls by `Machine.batch`.

    `outputs`: n * out_len bytes. `cycles`: n of uint32. `ends`: n of uint8, indices into `ENDS`
    (0 = returned).
    `registers`: n records with fields a, f, bc, de, hl, sp, pc, as they were when the call ended.
    """

    outputs: bytes
    cycles: NDArray[np.uint32]
    ends: NDArray[np.uint8]
    registers: NDArray[np.void]

    @property
    def failures(self) -> list[int]:
        """Numbers of the calls that did not return."""
        return [i for i, end in enumerate(self.ends) if end]


class Machine:
    """One board with its operator.

    `rom` is an image of at most 8,192 bytes or the path of one; `ram_kib` 2 to 56; `board` "6850" or "8251";
    `ports` the lower one of the teletype's ports and of the punch's, where they are others than that board's;
    `punch_tty` a board with a teletype alone; `baud` paces the teletype's line at 2 MHz (0: no time at all).
    """

    def __init__(
        self,
        rom: bytes | Path,
        ram_kib: int = 8,
        *,
        board: str = "6850",
        ports: tuple[int, int] | None = None,
        punch_tty: bool = False,
        baud: int = 0,
    ) -> None:
        image = rom.read_bytes() if isinstance(rom, Path) else bytes(rom)
        if len(image) > ROM_SIZE:
            raise ValueError(f"ROM image has {len(image)} bytes, more than {ROM_SIZE}")
        if not 2 <= ram_kib <= 56:
            raise ValueError(f"RAM of {ram_kib} KiB: not between 2 and 56")
        self._lib = _library()
        self._machine = self._lib.machine_new(image, len(image), ram_kib, BOARDS[board], punch_tty, baud)
        if not self._machine:
            raise MemoryError
        if ports:
            self._lib.machine_ports(self._machine, *ports)
        self._board = self._lib.machine_board(self._machine)
        #: First address past the RAM.
        self.ram_end = self._lib.board_ram_end(BOARDS[board], ram_kib)

    def __del__(self) -> None:
        if getattr(self, "_machine", None):
            self._lib.machine_free(self._machine)

    # The operator

    def type(self, text: str | bytes) -> None:
        """Text that the operator types, each character when the board waits for one; CR ends a line."""
        data = text.encode("ascii") if isinstance(text, str) else text
        if not self._lib.board_type(self._board, data, len(data)):
            raise MemoryError

    def press(self, key: int | str) -> None:
        """Press a key now, whatever the board is doing (ctrl-C: 3)."""
        if not self._lib.board_press(self._board, ord(key) if isinstance(key, str) else key):
            raise MemoryError

    def tape(self, data: str | bytes) -> None:
        """Put a tape into the reader, behind what is left of the one before."""
        raw = data.encode("ascii") if isinstance(data, str) else data
        if not self._lib.board_tape(self._board, raw, len(raw)):
            raise MemoryError

    def take_tape(self) -> None:
        """Take what is left of the tape out of the reader."""
        self._lib.board_take_tape(self._board)

    def reader(self, on: bool) -> None:
        """Move the lever of the teletype's own reader (boards with `punch_tty` only)."""
        self._lib.board_reader(self._board, on)

    def reader_cps(self, cps: float, cts: int | None = None) -> None:
        """Let the reader send `cps` characters a second whether the board is ready or not; 0: each one waits until the
        board looks for it.

        It stops `cts` characters after /RTS has risen; None: it does not look at /RTS, or at once when it waits.
        """
        self._lib.machine_sender(self._machine, False, cps, -1 if cts is None else cts)

    def keyboard_cps(self, cps: float, cts: int | None = None) -> None:
        """Let what is typed come like that."""
        self._lib.machine_sender(self._machine, True, cps, -1 if cts is None else cts)

    @property
    def lost(self) -> int:
        """Characters for which a receiver had no place, since power-on."""
        return self._lib.machine_lost(self._machine)

    def feed(self, hz: float) -> None:
        """The drive's feed clock, a square wave of so many Hz of the board's time; 0: full speed."""
        self._lib.machine_feed(self._machine, hz)

    def stop_at(self, step: int, stays: bool = False) -> None:
        """Raise the drive's stop line with the pulse of a step, counted from 1 since power-on; 0: never.

        It is down until then, and falls when the board takes the operator's next key, unless it `stays`.
        """
        self._lib.machine_stop_at(self._machine, step, stays)

    def reset(self) -> None:
        """The reset button; memory stays."""
        self._lib.board_reset(self._board)

    def interrupt(self, *code: int) -> None:
        """Raise the interrupt line; the device will put these one to three bytes on the bus."""
        self._lib.machine_interrupt(self._machine, bytes(code).ljust(3, b"\0"))

    def run(self, max_cycles: int = 1_000_000_000, patience: int = 0) -> str:
        """Run until the board waits for the operator and nothing typed is left, or until something else.

        Returns "prompt" (the paper's last line is `>`), "input" (it ends in `? `), "wait" (for a key anywhere
        else), "cycles" (max_cycles used up), "halt", "break" (at a breakpoint) or "nobody" (it has read a port
        without a chip). A board that waits for a key only for some time goes on by itself: "wait" is then
        returned after `patience` cycles of waiting.
        """
        # (a board that looks for a key now and then comes back each time: what it has done is asked once)
        now, printed = self.cycles, self._output_length
        end = now + max_cycles
        patient_until = min(end, now + patience)
        while True:
            reason = REASONS[self._lib.board_run(self._board, max(0, end - now))]
            if reason != "wait" or (now := self.cycles) >= patient_until:
                return reason
            if (length := self._output_length) != printed:
                printed, patient_until = length, min(end, now + patience)

    # Output

    @property
    def _output_length(self) -> int:
        output, start = self._lib.machine_output, ctypes.byref(ctypes.c_void_p())
        return output(self._machine, False, start) + output(self._machine, True, start)

    def _output(self, punch: bool, first: int = 0) -> bytes:
        start = ctypes.c_void_p()
        length = self._lib.machine_output(self._machine, punch, ctypes.byref(start))
        # (a pointer to nothing has no value, and then there is no length)
        return ctypes.string_at((start.value or 0) + first, length - first) if length > first else b""

    @property
    def printed(self) -> int:
        """Number of characters on the paper."""
        return self._lib.machine_output(self._machine, False, ctypes.byref(ctypes.c_void_p()))

    def paper_from(self, first: int) -> str:
        """The paper's text behind its first so many characters."""
        return self._output(False, first).decode("ascii")

    @property
    def tty(self) -> str:
        """Everything on the teletype's paper since the start or `clear` (7-bit characters)."""
        return self._output(False).decode("ascii")

    @property
    def punch(self) -> bytes:
        """Everything punched since the start or `clear`."""
        return self._output(True)

    def _steps(self) -> tuple[int, ctypes.c_void_p, ctypes.c_void_p]:
        values, cycles = ctypes.c_void_p(), ctypes.c_void_p()
        return (
            self._lib.machine_steps(self._machine, ctypes.byref(values), ctypes.byref(cycles)),
            values,
            cycles,
        )

    @property
    def steps(self) -> bytes:
        """The drive's steps since the start or `clear`: the port's value with the pulse up, a byte each."""
        count, values, _ = self._steps()
        return ctypes.string_at(values, count) if count else b""

    @property
    def step_cycles(self) -> array[int]:
        """The cycles at which each of `steps` rose."""
        count, _, cycles = self._steps()
        return array("Q", ctypes.string_at(cycles, 8 * count) if count else b"")

    @property
    def drive(self) -> int:
        """The byte that was written to the drive's port last (bit 7: cutting)."""
        return self._lib.machine_drive(self._machine)

    @property
    def hasty_steps(self) -> int:
        """Steps since power-on that came together with their direction, or whose direction changed under the pulse."""
        return self._lib.machine_hasty_steps(self._machine)

    def clear(self) -> None:
        """Tear off paper and punch tape, and forget the drive's steps."""
        self._lib.machine_clear(self._machine)

    @property
    def nobody(self) -> tuple[int, bool]:
        """After "nobody": the port that was read, and whether a chip is there, which has never been readied."""
        chip = ctypes.c_bool()
        return self._lib.machine_nobody(self._machine, ctypes.byref(chip)), chip.value

    @property
    def reader_silence(self) -> int:
        """For how many cycles the reader has been asked for a character, and had none."""
        return self._lib.board_reader_silence(self._board)

    # Inside

    @property
    def _counts(self) -> _Counts:
        counts = _Counts()
        self._lib.machine_count(self._machine, ctypes.byref(counts))
        return counts

    @property
    def cycles(self) -> int:
        """Cycles since power-on."""
        return self._counts.cycles

    @property
    def instructions(self) -> int:
        """Instructions since power-on."""
        return self._counts.instructions

    @property
    def error_lines(self) -> int:
        """Lines on the paper that begin with `ERR `, since power-on."""
        return self._counts.error_lines

    def watch(self, on: bool = True, first: int = 0, last: int = ROM_SIZE - 1) -> None:
        """Start or stop watching marks and instruction fetches outside first..last. Starting clears them."""
        self._lib.machine_watch(self._machine, on, first, last)

    @property
    def lowest_sp(self) -> int | None:
        """Lowest stack pointer after a push or call while watched; None without one."""
        value = self._counts.lowest_sp
        return None if value == 0xFFFF else value

    @property
    def fetches_outside(self) -> int:
        """Instructions fetched outside the watched range."""
        return self._counts.fetches_outside

    @property
    def first_outside(self) -> int | None:
        """Address of the first instruction fetched outside the watched range; None without one."""
        counts = self._counts
        return counts.first_outside if counts.fetches_outside else None

    def peek(self, address: int, length: int = 1) -> bytes:
        """Bytes of memory; nothing is disturbed."""
        buffer = ctypes.create_string_buffer(length)
        self._lib.machine_peek(self._machine, address, buffer, length)
        return buffer.raw

    def poke(self, address: int, data: bytes) -> None:
        """Write memory, the ROM too; nothing happens on an open bus."""
        self._lib.machine_poke(self._machine, address, data, len(data))

    @property
    def is_translated(self) -> bool:
        """Tell whether the ROM runs as its translation into C, up to its first change or breakpoint."""
        return self._lib.machine_is_translated(self._machine)

    def peek16(self, address: int) -> int:
        """A word, low byte first."""
        return int.from_bytes(self.peek(address, 2), "little")

    @property
    def registers(self) -> dict[str, int]:
        """a, f, bc, de, hl, sp and pc."""
        r = _Registers()
        self._lib.machine_get(self._machine, ctypes.byref(r))
        return {name: getattr(r, name) for name in REGISTERS}

    def set_registers(self, **values: int) -> None:
        """Set any of a, f, bc, de, hl, sp and pc; the others stay."""
        r = _Registers(**(self.registers | values))
        self._lib.machine_set(self._machine, ctypes.byref(r))

    def set_break(self, address: int, on: bool = True) -> None:
        """Set a breakpoint before the instruction at `address`, or take it away."""
        self._lib.machine_break(self._machine, address, on)

    @contextmanager
    def _breaks(self, addresses: Iterable[int]) -> Iterator[None]:
        addresses = list(addresses)
        for address in addresses:
            self.set_break(address)
        try:
            yield
        finally:
            for address in addresses:
                self.set_break(address, False)

    def call(
        self,
        address: int,
        max_cycles: int = 10_000_000,
        stops: Iterable[int] = (),
        **registers: int,
    ) -> str:
        """Call a subroutine and come back when it returns: "returned", "cycles", "stop", "halt" or "wait".

        `registers` as in `set_registers`; without `sp` the stack begins at the end of the RAM. Results are in
        `registers` and memory. "stop": it came to one of the addresses `stops` (the error exit, say).
        """
        outcome = self.batch(address, 1, b"", 0, 0, 0, max_cycles=max_cycles, stops=stops, **registers)
        return ENDS[outcome.ends[0]]

    def batch(
        self,
        address: int,
        n: int,
        inputs: bytes,
        in_addr: int,
        out_addr: int,
        out_len: int,
        *,
        max_cycles: int = 10_000_000,
        stops: Iterable[int] = (),
        **registers: int,
    ) -> Batch:
        """Call a subroutine n times, at the core's full speed.

        Before each call the next k = len(inputs) / n bytes go to `in_addr` and the registers are set (those
        not given as they are now; sp: the end of the RAM); after it out_len bytes are taken from `out_addr`.
        A call may take `max_cycles`. The rest of the memory stays from call to call. Raises ValueError when n
        does not divide len(inputs).
        """
        if n < 1 or len(inputs) % n:
            raise ValueError(f"{len(inputs)} input bytes for {n} calls")
        import numpy as np  # (slow to import, and needed here alone)

        start = _Registers(**(self.registers | {"sp": self.ram_end & 0xFFFF} | registers | {"pc": address}))
        job = _Job(start, max_cycles, len(inputs) // n, out_len, in_addr, out_addr)
        outputs = ctypes.create_string_buffer(max(1, n * out_len))
        cycles = np.zeros(n, np.uint32)
        ends = np.zeros(n, np.uint8)
        records = np.zeros(n, list(REGISTERS.items()))
        with self._breaks(stops):
            self._lib.machine_batch(
                self._machine,
                ctypes.byref(job),
                n,
                inputs,
                outputs,
                cycles.ctypes.data,
                ends.ctypes.data,
                records.ctypes.data,
            )
        return Batch(outputs.raw[: n * out_len], cycles, ends, records)
