"""Messages about contours that cannot be cut, and a tape that is not the drawing: place, reason, remedy."""

from __future__ import annotations

from collections.abc import Mapping
from math import floor, inf
from typing import Any

from skg.checking.check import Checked
from skg.checking.gouges import Crossing
from skg.checking.wire_path import LIMIT, Misfit
from skg.errors import UserError
from skg.geometry.offset import NoRoom
from skg.job.job import Job
from skg.job.machine import BoardOptions, Policy
from skg.messages.finding import Finding, Phrase
from skg.planning.planned import PlannedContour
from skg.planning.room import tightest

#: Errors of a route (language.md, section 6) that have a sentence of their own.
_ERRORS = (5, 6, 7, 9, 10)


def meaning(error: int) -> Finding:
    """An error of the ROM in a route, and what to do."""
    return Finding(f"error-{error}") if error in _ERRORS else Finding("error-other", number=error)


def too_short(fit: float) -> Phrase:
    """The reason why a tab does not fit a contour; `fit`: the longest that does, mm."""
    return Phrase("too-short-for-tab", fit=floor(fit * 1000 - 1e-6) / 1000)


def without_tab(contours: Mapping[int, PlannedContour], fits: dict[int, float], policy: Policy) -> UserError:
    """Report contours that their tab does not fit: the shortest one."""
    number = min(fits, key=fits.__getitem__)
    planned = contours[number]
    more = Phrase("more-without-tab", count=len(fits) - 1) if len(fits) > 1 else None
    sentence: dict[str, Any] = {
        "name": planned.name,
        "why": too_short(fits[number]),
        "more": more,
        "leave": _or_leave(policy),
    }
    return UserError(Finding("tab-too-long", contour=planned.number, place=planned.entry, **sentence))


def without_room(contours: Mapping[int, PlannedContour], none: dict[int, NoRoom], policy: Policy) -> UserError:
    """Report contours that the wire does not get around: the tightest one."""
    number, fit = tightest(contours, none)
    planned, no_room = contours[number], none[number]
    more = Phrase("more-without-room", count=len(none) - 1) if len(none) > 1 else None
    sentence: dict[str, Any] = {"name": planned.name, "why": no_room.why, "more": more, "leave": _or_leave(policy)}
    about: dict[str, Any] = {"contour": planned.number, "place": no_room.place}
    if no_room.is_crossing:
        return UserError(Finding("no-room-crossing", **about, **sentence))
    return UserError(Finding("no-room", r=abs(planned.widest), fit=_fit(planned, fit), **about, **sentence))


def _fit(planned: PlannedContour, fit: float | None) -> Phrase | None:
    """The largest offset that fits, with the last pass's where it belongs to another one; None: not looked for."""
    if not fit:
        return None if fit is None else Phrase("fits-nothing")
    more = abs(planned.widest) - abs(planned.passes[-1])
    if not more:
        return Phrase("fits-at-most", fit=fit)
    return Phrase("fits-in-passes", fit=fit, last=fit - more) if fit > more else Phrase("fits-no-pass", fit=fit)


def _or_leave(policy: Policy) -> Phrase | None:
    return Phrase("or-leave") if policy.small else None


def why_no_room(fault: Misfit) -> Phrase | None:
    """The reason why the wire does not fit; None when something else is wrong."""
    if fault.is_into:
        return Phrase("would-cut-into", depth=fault.off, place=fault.place)
    return Phrase("room-slot", place=fault.place) if fault.is_missed else None


def off_drawing(faults: list[Misfit], planned: PlannedContour, job: Job) -> UserError:
    """Report where a contour's wire is not where the drawing has it: first where it comes into the contour."""
    fault = min(faults, key=lambda fault: not fault.is_into)
    about: dict[str, Any] = {"name": planned.name, "contour": planned.number, "place": fault.place}
    if why := why_no_room(fault):
        return UserError(Finding("into-itself", why=why, r=abs(planned.widest), leave=_or_leave(job.policy), **about))
    advice = _advice(fault, planned, job.board)
    if fault.off < inf:
        return UserError(Finding("off-drawing", off=1000 * fault.off, limit=1000 * LIMIT, advice=advice, **about))
    return UserError(Finding("far-off-drawing", advice=advice, **about))


def refuse(checked: Checked, contours: list[PlannedContour], job: Job) -> None:
    """Raise what is wrong with a tape, if anything is, as a `UserError`."""
    if checked.faults:
        first = min(checked.faults, key=lambda fault: (not fault.is_into, fault.contour)).contour
        faults = [fault for fault in checked.faults if fault.contour == first]
        raise off_drawing(faults, contours[first], job)
    for cut in checked.cuts:
        planned = contours[cut.contour]
        if planned.contour.is_closed and not planned.tabs.each and cut.gap != (0, 0):
            dx, dy = cut.gap
            where: dict[str, Any] = {"contour": planned.number, "place": planned.entry}
            raise UserError(Finding("not-closed", name=planned.name, dx=dx, dy=dy, **where))
    for number, place in checked.fallen[:1]:
        planned = contours[number]
        values: dict[str, Any] = {"name": planned.name, "tab": planned.tabs.length, "aside": abs(planned.widest)}
        code = "tab-holds-no-part" if planned.frees == "part" else "tab-holds-no-slug"
        raise UserError(Finding(code, contour=planned.number, place=place, **values))
    spoilt = [
        crossing
        for crossing in checked.crossings
        if all(contours[number].contour.is_closed for number in (crossing.contour, crossing.other))
    ]
    if spoilt and job.policy.into != "cut":
        raise _spoilt(spoilt, contours, job.policy)


def _spoilt(spoilt: list[Crossing], contours: list[PlannedContour], policy: Policy) -> UserError:
    """Report gouges: the deepest one."""
    worst = max(spoilt, key=lambda crossing: (crossing.is_through, crossing.depth))
    return UserError(
        Finding(
            "would-gouge",
            name=contours[worst.contour].name,
            other=contours[worst.other].name,
            depth=depth(worst),
            more=Phrase("more-would-gouge", count=len(spoilt) - 1) if len(spoilt) > 1 else None,
            cut=Phrase("or-cut-anyway") if policy.into else None,
            contour=contours[worst.contour].number,
            place=worst.place,
        )
    )


def depth(crossing: Crossing) -> Phrase:
    """A gouge's depth in words."""
    return Phrase("depth-or-more" if crossing.is_through else "depth", depth=crossing.depth)


def _advice(fault: Misfit, planned: PlannedContour, board: BoardOptions) -> Phrase:
    """Remedies for a wire that is off the drawing."""
    if not board.is_without_drift:
        return Phrase("advice-no-drift")
    edge = min(planned.contour.edges, key=lambda edge: edge.far(fault.place))
    noun = Phrase("edge-curve" if edge.nodes else "edge-arc" if edge.centre else "edge-line")
    code = "advice-redraw-or" if any(planned.passes) else "advice-redraw"
    return Phrase(code, edge=noun, start=edge.start, end=edge.end, length=edge.length)
