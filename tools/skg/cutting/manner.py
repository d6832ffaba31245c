"""The manners in which contours are cut, and what the machine stops for: each contour by its number."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from skg.messages.finding import Phrase
from skg.planning.planned import PlannedContour

#: Runs of numbers that a line names.
_RUNS = 8


@dataclass(frozen=True)
class Manner:
    """The way a contour is cut. `kind`: closed or open; `side`: the wire's, as its phrase's code ends; `passes`:
    distance beside it in each pass, mm; `tab`: length of the `tabs` that the last cuts take off, mm, `tab_passes`: the
    distances of these, mm; `overlap`: mm."""

    kind: str
    side: str
    passes: tuple[float, ...]
    tab: float
    tabs: int
    tab_passes: tuple[float, ...]
    overlap: float

    @classmethod
    def of(cls, planned: PlannedContour) -> Manner:
        """The manner of a planned contour."""
        tabs = planned.tabs
        asides = [tuple(round(abs(r), 9) for r in some) for some in (planned.passes, tabs.passes)]
        overlap = planned.overlap if planned.contour.is_closed else 0.0
        return cls(planned.kind, _side(planned), asides[0], tabs.length, len(tabs.each), asides[1], overlap)

    @property
    def phrase(self) -> Phrase:
        """The manner in words."""
        count = len(self.passes)
        return Phrase(
            "manner",
            side=Phrase(f"side-{self.side}"),
            beside=Phrase("beside", offsets=self.passes) if any(self.passes) else None,
            passes=Phrase("in-passes", count=count) if count > 1 else None,
            tab=Phrase("with-tab", count=self.tabs, tab=self.tab) if self.tabs else None,
            cut=Phrase("tab-cut", offsets=self.tab_passes) if self.has_other_cuts else None,
            overlap=Phrase("with-overlap", overlap=self.overlap) if self.overlap else None,
        )

    @property
    def has_other_cuts(self) -> bool:
        """Tell whether the tabs are cut otherwise than the rest."""
        return self.tabs > 0 and self.tab_passes != self.passes


def _side(planned: PlannedContour) -> str:
    if not any(planned.passes):
        return "on"
    if planned.contour.is_closed:
        return "outside" if planned.is_outside else "inside"
    return "right" if planned.offset > 0 else "left"


def manners(contours: Sequence[PlannedContour]) -> dict[Manner, list[int]]:
    """The manners, in the order of cutting, with the numbers of their contours."""
    alike: dict[Manner, list[int]] = {}
    for planned in contours:
        alike.setdefault(Manner.of(planned), []).append(planned.turn)
    return alike


def stops(contours: Sequence[PlannedContour]) -> Iterator[Phrase]:
    """Reasons for stops of the machine, each with the contours; each takes two stops, wire off and wire threaded."""
    twice = [
        planned
        for planned in contours
        if planned.contour.is_closed and len(planned.passes) > 1 and not planned.tabs.each
    ]
    held = {
        name: [planned for planned in contours if planned.tabs.each and planned.frees == name]
        for name in ("part", "slug")
    }
    many = [planned for planned in contours if len(planned.tabs.each) > 1]
    for group, code in (
        (contours[1:], "stop-before"),
        ([planned for planned in twice if planned.frees == "slug"], "stop-slug"),
        ([planned for planned in twice if planned.frees == "part"], "stop-free"),
        (many, "stop-further-hole"),
        (many, "stop-each-tab"),
        (held["part"], "stop-tab"),
        (held["slug"], "stop-slug-tab"),
        ([planned for planned in held["slug"] if len(planned.tabs.passes) > 1], "stop-slug-out"),
    ):
        if group:
            yield Phrase(code, contours=numbered(planned.turn for planned in group))


def numbered(numbers: Iterable[int]) -> Phrase:
    """Contours by their numbers, which rise."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1][1:] = [number]
        else:
            runs.append([number])
    spans: list[int | Phrase] = []
    for run in runs[:_RUNS]:
        spans += [Phrase("number-span", first=run[0], last=run[1])] if run[-1] - run[0] > 1 else run
    count = 1 if len(runs) == 1 and len(runs[0]) == 1 else 2
    return Phrase("contour-numbers", count=count, numbers=tuple(spans), rest=" …" * (len(runs) > _RUNS))
