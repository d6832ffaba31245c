"""Moves of G-code that do not cut: beam, spindle or pen off, or the tool up.

What a program says of them is gathered while it is read; only then it is known which moves with G1 to G3 do not cut,
and it is read again with that.
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal

from skg.messages.finding import Finding, Phrase
from skg.tape.gcode_program import several

#: Beams (or spindles), and the M words that turn them on and off: those of controls; those of a fan's output and of
#: any pin, to which small lasers are connected on boards for printers; LinuxCNC's outputs.
_BEAM, _FAN, _PIN, _OUTPUT = "beam", "fan", "pin", "output"
#: The words that turn each off, as messages name them.
OFF_WORDS: dict[str, Phrase | str] = {
    _BEAM: Phrase("one-or-other", first="M5", other="S0"),
    _FAN: Phrase("one-or-other", first="M107", other="S0"),
    _PIN: "M42 S0",
    _OUTPUT: Phrase("one-or-other", first="M63", other="M65"),
}
_SWITCHES = {_BEAM: ({3, 4}, {5}), _FAN: ({106}, {107}), _PIN: ({42}, set()), _OUTPUT: ({62, 64}, {63, 65})}
#: M words of which a line has one at most.
TURNS = set.union(*_SWITCHES[_BEAM])
#: An S in a line with an M word that is none of these is that word's.
_PLAIN = {*range(10), 30, 48, 49}
#: The M word that turns a spindle, or moves a pen that is connected instead.
_TURN = Decimal(3)
#: M words that turn a servo, to a place that is their S.
_SERVOS = {280, 300}
#: M words whose P names an output.
OUTPUTS = set.union(*_SWITCHES[_OUTPUT])
#: A pen's two S, both not 0, are told from two powers of a laser by how often they change.
_CHANGES = 3


@dataclass(frozen=True)
class Idle:
    """Conditions under which G1 to G3 do not cut: while the beam that is switched by `beam` (one of `_SWITCHES`,
    empty: none) is off; at the height `above` (µm) and over it (None: nowhere)."""

    beam: str = ""
    above: Decimal | None = None


class Tool:
    """Beam, spindle or pen of a program that is being read, and the heights (µm) of its moves."""

    def __init__(self, idle: Idle) -> None:
        self.idle = idle
        # Beam or spindle: its S; by what turns it: in which line first, whether it is on, how many moves found it off.
        self.power: Decimal | None = None
        self.turned_on: dict[str, int] = {}
        self.is_on = dict.fromkeys(_SWITCHES, False)
        self.dark = dict.fromkeys(_SWITCHES, 0)
        # LinuxCNC's outputs that are switched: with several it is not known which one is a beam's.
        self.outputs: set[Decimal] = set()
        # Words that may lift a pen: the S of a servo's M word, or else that of M3 and M4; its changes between moves.
        self.servo: tuple[Decimal, Decimal] | None = None
        self.lifts: dict[tuple[Decimal, Decimal | None], None] = {}
        self.lift: tuple[Decimal, Decimal | None] | None = None
        self.lift_changes = 0
        # Moves with G1 to G3, those that do not cut; their heights, how often these change, and those of the rapids.
        self.feeds = self.idled = self.feed_changes = 0
        self.feed_height: Decimal | None = None
        self.feed_heights: set[Decimal] = set()
        self.rapid_heights: set[Decimal] = set()

    def turn(self, line: int, codes: list[Decimal], power: Decimal | None, dwells: bool) -> None:
        """On or off, as the M words of a line and its S say; it counts for the move in this line, too."""
        for name, (on, off) in _SWITCHES.items():
            for code in (on | off).intersection(codes):
                self.is_on[name] = code in on and (name == _BEAM or power != 0)
        for name in filter(self.is_on.get, self.is_on):
            self.turned_on.setdefault(name, line)
        for code in _SERVOS.intersection(codes):
            if power is not None:
                self.servo = Decimal(code), power
        if power is not None and not dwells and _PLAIN.issuperset(codes):
            self.power = power

    def is_idle(self, height: Decimal | None) -> bool:
        """Tell whether a move with G1 to G3, no lower than `height`, does not cut; counts it."""
        self.feeds += 1
        for name in filter(self.is_dark, self.is_on):
            self.dark[name] += 1
        lift = self.servo or (_TURN, self.power)
        if lift != self.lift:
            self.lift_changes += self.lift is not None
            self.lift = lift
            self.lifts[lift] = None
        if height is not None:
            self.feed_changes += self.feed_height not in (None, height)
            self.feed_height = height
            self.feed_heights.add(height)
        is_dark = bool(self.idle.beam) and self.is_dark(self.idle.beam)
        is_up = self.idle.above is not None and height is not None and height >= self.idle.above
        self.idled += is_dark or is_up
        return is_dark or is_up

    def is_dark(self, beam: str) -> bool:
        """Tell whether a beam is off."""
        return not self.is_on[beam] or (beam == _BEAM and self.power == 0)

    @property
    def always_off(self) -> dict[str, int]:
        """Beams that each move with G1 to G3 finds off, and in which line each is turned on first."""
        return {beam: line for beam, line in self.turned_on.items() if 0 < self.dark[beam] == self.feeds}

    def idle_in_all(self) -> Idle:
        """Return the conditions under which G1 to G3 do not cut in a program that has been read through.

        A beam that some of them find on and others off. The height of the rapids, when all other heights are lower;
        without rapids in the plane the upper one of two heights, above 0, when it goes up and down between them.
        """
        beam = next((name for name in self.is_on if name in self.turned_on), "")
        if beam == _OUTPUT and len(self.outputs) > 1:
            beam = ""
        rapids = self.rapid_heights
        if not rapids and not beam and len(self.feed_heights) == 2 and self.feed_changes > 1:
            rapids = {height for height in (max(self.feed_heights),) if height > 0}
        above = max(rapids, default=None)
        lower = {height for height in self.feed_heights if above is not None and height < above}
        is_up = lower and len(lower) < len(self.feed_heights) and max(lower) < min(rapids)
        return Idle(beam if beam and 0 < self.dark[beam] < self.feeds else "", above if is_up else None)

    def notes(self) -> tuple[Finding, ...]:
        """The moves with G1 to G3 that do not cut."""
        off = Phrase("beam-is-off", beam=OFF_WORDS[self.idle.beam]) if self.idle.beam else None
        up = None if self.idle.above is None else Phrase("tool-is-up", height=several([self.idle.above]))
        why = Phrase("off-or-up", first=off, other=up) if off and up else off or up
        note = Finding("moves-idle", idle=self.idled, moves=self.feeds, why=why) if self.idled else None
        return tuple(filter(None, [note, self._note_on_outputs(), self._note_on_pen()]))

    def _note_on_outputs(self) -> Finding | None:
        """Note that an output may be a beam's, and that it is not known when the beam is off."""
        lit = self.feeds - self.dark[_OUTPUT]
        if self.idle.beam == _OUTPUT or not 0 < lit < self.feeds:
            return None
        return Finding("outputs-unknown", lit=lit, moves=self.feeds)

    def _note_on_pen(self) -> Finding | None:
        """Note that there may be a pen, and that it is not known when it is up."""
        # (in a program with a servo the S of M3 lifts nothing)
        turns = [lift for lift in self.lifts if lift[1] is not None and (self.servo is None or lift[0] in _SERVOS)]
        if len(turns) != 2 or self.lift_changes < (1 if self.servo else _CHANGES):
            return None
        (code, first), (_, second) = turns
        if not self.servo and not (first and second):
            return None
        return Finding("pen-unknown", first=f"S{first:f}", second=f"S{second:f}", word=f"M{code:f}")
