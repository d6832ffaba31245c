"""A punch and its die from one contour: which contours are cut for each, on which side, and who takes the clearance."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import shapely

from skg.errors import UserError
from skg.geometry.contour import Contour
from skg.geometry.offset import NoRoom, wire_path
from skg.geometry.plane import XY
from skg.job.wanted import CutSettings
from skg.messages.finding import Finding, Phrase
from skg.planning.nesting import Nesting

PUNCH, DIE = "punch", "die"
#: The reason of a contour that is cut for the other one alone.
OTHER = Phrase("reason-other-of-pair")
#: Findings on sides and tabs that a punch, or a die, has on purpose.
_MEANT = {
    PUNCH: {"side-of-openings", "side-of-outlines", "no-slug-has-tab"},
    DIE: {"side-of-openings", "side-of-outlines", "no-part-has-tab"},
}

#: An edge is no further from that beside it than this many times the difference in size: a rounded corner may be gone.
_BESIDE = 1.5


def named(member: str) -> Phrase:
    """The name of one of both, before a message on it."""
    return Phrase("member-punch" if member == PUNCH else "member-die")


def ending_of(member: str, is_short: bool) -> str:
    """The suffix of its files' names, before their endings; `is_short`: where these have eight letters."""
    return f"-{member[0].upper() if is_short else member}" if member else ""


def file_name(name: str, ending: str) -> str:
    """The name of a file, which has no folder, with something before its own ending."""
    rest = re.search(r"((\.nodrift)?\.3b|\.\w+)?$", name, re.IGNORECASE)
    at = rest.start() if rest and rest.start() else len(name)
    return name[:at] + ending + name[at:]


def members(wanted: Sequence[CutSettings], nesting: Nesting) -> tuple[str, ...]:
    """The members of a drawing: a punch and its die, where a closed contour has a clearance; else "", the part. A
    clearance without such a contour is a `UserError`."""
    asked = [number for number, want in enumerate(wanted) if want.cut and want.clearance is not None]
    if not asked:
        return ("",)
    if not any(nesting.contours[number].is_closed for number in asked):
        raise UserError(Finding("clearance-of-open"))
    return PUNCH, DIE


def pair_wanted(wanted: Sequence[CutSettings], nesting: Nesting, member: str) -> list[CutSettings]:
    """Settings for the punch or for the die.

    A contour with a clearance that lies in no other such contour is cut outside for the punch, inside for the die. What
    lies in it goes with the punch, all else with the die.
    """
    mates, around = _mates(wanted, nesting)
    result = []
    for number, want in enumerate(wanted):
        within = [outer for outer in around[number] if outer != number]
        mate = number if number in mates else next((outer for outer in within if outer in mates), None)
        if not want.cut or (mate is None or mate != number) and (mate is None) == (member == PUNCH):
            result.append(replace(want, cut=False))
        elif mate == number:
            result.append(_mated(number, want, nesting, member))
        elif mate is not None and want.side == "auto" and nesting.contours[number].is_closed:
            # (how deep it lies in the punch, whatever this lies in)
            depth = sum(outer == mate or mate in around[outer] for outer in within)
            result.append(replace(want, side="inside" if depth % 2 else "outside"))
        else:
            result.append(want)
    return result


def sized(wanted: Sequence[CutSettings], nesting: Nesting, member: str) -> dict[int, Contour]:
    """The contours, by their numbers, that one of both has in a size of its own: those with a clearance that is no
    smaller than the wire's distance, with which the wire would be on the other side of what is drawn. A contour that is
    not whole in that size is a `UserError`."""
    result = {}
    for number in sorted(_mates(wanted, nesting)[0]):
        want, contour = wanted[number], nesting.contours[number]
        size = growth(want, member)
        if abs(size) < want.offset or not size:
            continue
        lost: XY | None
        try:
            made = replace(contour, edges=wire_path(contour, size if contour.area > 0 else -size))
            lost = _lost(contour, made, abs(size))
        except NoRoom as why:
            lost = why.place
        if lost:
            raise UserError(Finding("clearance-too-large", clearance=want.clearance, contour=number, place=lost))
        result[number] = made
    return result


def _lost(drawn: Contour, made: Contour, size: float) -> XY | None:
    """The middle of a drawn edge that has nothing beside it in a contour of another size: a slot has closed, or what
    was between two edges is gone; None: there is none."""
    places = [edge.at(0.5) for edge in drawn.edges]
    far = shapely.distance(shapely.points(places), shapely.LineString(made.points()))
    return places[int(far.argmax())] if far.max() > _BESIDE * size else None


def growth(want: CutSettings, member: str) -> float:
    """The growth of one of both on each side over the drawing, mm; smaller: negative."""
    if want.clearance_on != member:
        return 0.0
    return -(want.clearance or 0.0) if member == PUNCH else want.clearance or 0.0


def pair_starts(starts: Sequence[XY], wanted: Sequence[CutSettings], nesting: Nesting, member: str) -> list[XY]:
    """The start holes of one of both. Those in a contour of the pair are the die's, those in what lies in it the
    punch's; so are those beside it, but in openings of a plate that it lies in, and outside of this."""
    mates, _ = _mates(wanted, nesting)
    depths = nesting.depths
    has_plate = any(depths[number] for number in mates)
    result = []
    for start, holders in zip(starts, nesting.holding.around(starts), strict=True):
        inner = max(holders, key=depths.__getitem__, default=None)
        if inner is None:
            is_of_die = has_plate
        else:
            is_of_die = inner in mates or not mates & set(holders) and depths[inner] % 2 == 1
        if is_of_die == (member == DIE):
            result.append(start)
    return result


def pair_findings(wanted: Sequence[CutSettings], nesting: Nesting, member: str, report: list[Finding]) -> list[Finding]:
    """The report on one of both: begun with what it is, without what is meant so. `wanted`: settings for the part."""
    mates, _ = _mates(wanted, nesting)
    sizes = dict.fromkeys(_size(wanted[number], member) for number in sorted(mates))
    first = Finding("pair-punch" if member == PUNCH else "pair-die", sizes=tuple(sizes))
    return [first, *(finding for finding in report if finding.code not in _MEANT[member])]


def _size(want: CutSettings, member: str) -> Phrase:
    if want.clearance_on != member or not want.clearance:
        return Phrase("pair-to-size")
    return Phrase("pair-smaller" if member == PUNCH else "pair-larger", clearance=want.clearance)


def _mates(wanted: Sequence[CutSettings], nesting: Nesting) -> tuple[set[int], list[list[int]]]:
    """The contours that punch and die share, and the closed contours around each contour, by their numbers."""
    around = nesting.holding.around([contour.edges[0].at(0.5) for contour in nesting.contours])
    asked = {
        number
        for number, want in enumerate(wanted)
        if want.cut and want.clearance is not None and nesting.contours[number].is_closed
    }
    return {number for number in asked if not asked & set(around[number]) - {number}}, around


def _mated(number: int, want: CutSettings, nesting: Nesting, member: str) -> CutSettings:
    """Settings for a contour that both share."""
    # (a smaller one brings the wire nearer; for the others there is a contour of that size)
    takes = want.clearance if want.clearance_on == member else None
    offset = want.offset - takes if takes and takes < want.offset else want.offset
    start = want.start
    if start is not None and (number in nesting.holding.around([start])[0]) != (member == DIE):
        start = None
    return replace(want, side="outside" if member == PUNCH else "inside", offset=offset, start=start)
