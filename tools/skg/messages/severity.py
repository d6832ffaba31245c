"""The severity of what a report says, by its code."""

from __future__ import annotations

from enum import Enum


class Severity(Enum):
    """The severity of a finding in a report. What is raised as a `UserError` is an error, whatever its code."""

    #: Somebody should decide.
    CARE = "care"
    #: Something of the drawing is not cut.
    LOST = "lost"
    #: Nobody told it: it was guessed.
    GUESS = "guess"
    #: Settings come from elsewhere than the command line or the job.
    USED = "used"
    #: All else.
    NOTE = "note"

    @property
    def is_kept(self) -> bool:
        """Tell whether --quiet keeps it."""
        return self is not Severity.NOTE


_CARE = frozenset(
    {
        "repair-lost",
        "page-in-dots",
        "contour-not-cut",
        "drawing-changed",
        "drawing-moved",
        "drift",
        "gouge",
        "last-pass-leaves",
        "loops",
        "matched-far",
        "more-gouges",
        "named-without-drift",
        "encoding-doubtful",
        "line-around",
        "lines-around",
        "lines-between",
        "much-left",
        "narrow-corners",
        "no-eof",
        "no-start-points",
        "size-huge",
        "size-large",
        "size-odd",
        "size-small",
        "no-part-has-tab",
        "no-slug-has-tab",
        "on-the-line",
        "open-on-line",
        "offsets-to-be-set",
        "openings-in-part",
        "outlines-in-frame",
        "outlines-in-open-line",
        "part-in-pieces",
        "parts-free",
        "route-given-up",
        "scaled",
        "side-of-openings",
        "tabs-proud",
        "thin-wall",
        "side-of-outlines",
        "whiskers",
        "size-in-dots",
        "size-in-other-units",
    }
)
_LOST = frozenset(
    {
        "edge-too-short",
        "more-not-cut",
        "entity-not-cut",
        "of-no-outline",
    }
)
_GUESS = frozenset(
    {
        "ends-joined",
        "drilled",
        "more-joined",
        "no-thickness",
        "size-guessed",
    }
)
_USED = frozenset({"setup-used"})


def severity_of(code: str) -> Severity:
    """Return a code's severity."""
    if code in _USED:
        return Severity.USED
    if code in _CARE:
        return Severity.CARE
    if code in _LOST:
        return Severity.LOST
    return Severity.GUESS if code in _GUESS else Severity.NOTE
