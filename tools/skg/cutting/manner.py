"""The manners in which contours are cut, and what the machine stops for: each contour by its number."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from skg.planning.route import PlannedContour
from skg.wording import short

#: Runs of numbers that a line names.
_RUNS = 8


@dataclass(frozen=True)
class Manner:
    """The way a contour is cut. `kind`: closed or open; `side`: the wire's; `passes`: distance beside it, mm, in each
    pass; `tab`: length of the bridge that the last cut takes off, mm."""

    kind: str
    side: str
    passes: tuple[float, ...]
    tab: float

    @classmethod
    def of(cls, route: PlannedContour) -> Manner:
        """The manner of a planned contour."""
        passes = route.passes or (route.offset,)
        return cls(route.kind, _side(route), tuple(round(abs(r), 9) for r in passes), route.tab)

    @property
    def told(self) -> str:
        """The manner in words."""
        count = len(self.passes)
        beside = f", {', '.join(map(short, self.passes))} mm beside" if any(self.passes) else ""
        often = f" in {count} passes, every second one backwards" if count > 1 else ""
        return f"wire {self.side}{beside}{often}" + f"; tab {short(self.tab)} mm" * bool(self.tab)


def _side(route: PlannedContour) -> str:
    if not any(route.passes or (route.offset,)):
        return "on the line"
    if route.contour.is_closed:
        return "outside" if route.is_outside else "inside"
    return "right of the cut" if route.offset > 0 else "left of the cut"


def manners(routes: Sequence[PlannedContour]) -> dict[Manner, list[int]]:
    """The manners, in the order of cutting, with the numbers of their contours."""
    alike: dict[Manner, list[int]] = {}
    for route in routes:
        alike.setdefault(Manner.of(route), []).append(route.turn)
    return alike


def stops(routes: Sequence[PlannedContour]) -> Iterator[str]:
    """Reasons for stops of the machine, each with the contours; each takes two stops, wire off and wire threaded."""
    twice = [route for route in routes if route.contour.is_closed and len(route.passes) > 1 and not route.tab]
    for group, template in (
        (routes[1:], "before {}"),
        ([route for route in twice if route.is_opening], "to take the slug out of {}"),
        ([route for route in twice if not route.is_opening], "with the part of {} free"),
        ([route for route in routes if route.tab], "to hold the part before the tab of {} is cut"),
    ):
        if group:
            yield template.format(numbered(route.turn for route in group))


def numbered(numbers: Iterable[int]) -> str:
    """Contours by their numbers, which rise."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1][1:] = [number]
        else:
            runs.append([number])
    noun = "contour" if len(runs) == 1 and len(runs[0]) == 1 else "contours"
    spans = [" to ".join(map(str, run)) if run[-1] - run[0] > 1 else ", ".join(map(str, run)) for run in runs[:_RUNS]]
    return f"{noun} {', '.join(spans)}" + " …" * (len(runs) > _RUNS)
