"""What G-code does in the plane: the program that `skg.tape.gcode_reader` reads, as routes, as a 3B tape, in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal
from math import hypot

from skg.errors import UserError
from skg.tape.block import Block, Stop, Tape, line_block
from skg.tape.gcode import Spot, grid, millimetres, minus
from skg.tape.placed import Placed, PlacedRoute

#: The end of a 3B block's arc may lie so far off the circle through its start, µm: both are rounded, and so is the
#: centre.
OFF_BLOCK = 2


@dataclass(frozen=True)
class Drilled:
    """A hole: down and up again at a place, µm; its depth, if the program's heights are known."""

    place: Spot
    depth: Decimal | None = None


@dataclass(frozen=True)
class Move:
    """A move in the plane that does not cut: a rapid; any with the beam off or the tool up."""

    placed: Placed


@dataclass(frozen=True)
class GcodeProgram:
    """What G-code does in the plane, in order: cuts, moves, holes, stops; `home` (µm) is where it begins.

    `depths` and `travels`: the heights (µm) at which it cuts and at which it is moved, each once, in the order in which
    they come; empty where no height is known. `guesses`: how it is read where it does not say. `notes`: what of G1 to
    G3 is no cut, and why.
    """

    name: str
    items: tuple[Placed | Move | Drilled | Stop, ...]
    home: Spot = (0, 0)
    depths: tuple[Decimal, ...] = ()
    travels: tuple[Decimal, ...] = ()
    guesses: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def holes(self) -> list[Spot]:
        """Where it drills, each place once."""
        return list(dict.fromkeys(item.place for item in self.items if isinstance(item, Drilled)))

    @property
    def stop_places(self) -> list[Spot]:
        """Where it stops, each place once."""
        at, found = self.home, []
        for item in self.items:
            if isinstance(item, Stop):
                found.append(at)
            else:
                at = item.place if isinstance(item, Drilled) else grid(_placed(item).end)
        return list(dict.fromkeys(found))

    def routes(self) -> list[PlacedRoute]:
        """What is cut and how it is moved between, as `skg.tape.placed.place` has it."""
        found: list[tuple[bool, list[Placed]]] = []
        for item in self.items:
            if isinstance(item, Stop | Drilled):
                found.append((False, []))
                continue
            is_move = isinstance(item, Move)
            if not found or found[-1][0] != is_move:
                found.append((is_move, []))
            found[-1][1].append(_placed(item))
        return [PlacedRoute(tuple(blocks), is_move) for is_move, blocks in found if blocks]

    def heights(self) -> str:
        """What there is to say of the heights of cuts, holes and moves; empty where none is known."""
        holes = [item.depth for item in self.items if isinstance(item, Drilled)]
        deep = list(dict.fromkeys(depth for depth in holes if depth is not None))
        said = [
            f"cuts at {several(self.depths)}" if self.depths else "",
            f"{_counted_holes(len(holes))} down to {several(deep)}" if deep else "",
            f"travels at {several(self.travels)}" if self.travels else "",
        ]
        return ", ".join(filter(None, said))

    def left_out(self) -> tuple[str, ...]:
        """What a 3B tape of the same path has no word for, to be said."""
        holes = sum(isinstance(item, Drilled) for item in self.items)
        said = [
            _counted_holes(holes) if holes else "",
            f"the heights of its cuts, {several(self.depths)}" if self.depths else "",
        ]
        return (f"left out, as 3B has no word for it: {' and '.join(filter(None, said))}",) if any(said) else ()

    def tape(self) -> Tape:
        """The 3B tape of the same path: a move goes straight, between two stops; holes have no blocks.

        An arc whose end is farther off its circle than a block can be is a `UserError`.
        """
        items: list[Block | Stop] = []
        at, moved_from = self.home, None
        for item in self.items:
            if isinstance(item, Drilled):
                continue
            if isinstance(item, Move):
                if moved_from is None:
                    moved_from = at
                    if not items or isinstance(items[-1], Block):
                        items.append(Stop(len(items)))
                at = grid(item.placed.end)
                continue
            if moved_from is not None:
                items += _between(moved_from, at)
                if not isinstance(item, Stop):
                    items.append(Stop(len(items)))
                moved_from = None
            if isinstance(item, Stop):
                items.append(item)
                continue
            off = 0 if item.is_line else abs(hypot(*minus(item.end, item.centre)) - item.radius)
            if off > OFF_BLOCK:
                raise UserError(f"{self.name}: block {item.block.number}: the arc's end is {off:.0f} µm off its circle")
            items.append(item.block)
            at = grid(item.end)
        if moved_from is not None:
            items += _between(moved_from, at)
        return Tape.of(self.name, _counted(items), drift=True)


def _counted_holes(number: int) -> str:
    return f"{number} hole{'s' * (number > 1)}"


def several(heights: Sequence[Decimal]) -> str:
    """Some heights, or the first and the last of many."""
    words = [f"Z{millimetres(rounded_one(height))}" for height in heights]
    return ", ".join(words) if len(words) <= 3 else f"{words[0]} … {words[-1]} ({len(words)} heights)"


def _between(start: Spot, end: Spot) -> list[Block]:
    return [] if start == end else [line_block(*minus(end, start))]


def _placed(item: Placed | Move) -> Placed:
    return item.placed if isinstance(item, Move) else item


def _counted(items: Iterable[Block | Stop]) -> Iterator[Block | Stop]:
    """Blocks and stops with the numbers that they have on a tape."""
    number = 0
    for item in items:
        if isinstance(item, Stop):
            yield Stop(number)
        else:
            number += 1
            yield Block(item.x, item.y, item.j, item.axis, item.code, number)


def rounded_one(value: Decimal) -> int:
    """Whole µm, halves away from zero."""
    return int(value.quantize(Decimal(1), ROUND_HALF_UP))
