"""Limits of a drawing that is read: what a few kilobytes can grow to is counted before it is made, and refused."""

from __future__ import annotations

from skg.errors import UserError
from skg.messages.finding import Finding, Phrase

#: Entities of a drawing, those of a block as often as it is shown; so many take some 20 seconds.
MOST_ENTITIES = 250_000
#: Vertices of one entity.
MOST_VERTICES = 100_000
#: Bytes of a packed drawing, unpacked.
MOST_BYTES = 64 * 2**20
#: Tries of a style sheet's rules at elements.
MOST_TRIES = 20_000_000
#: Pairs of edges that come near to each other.
MOST_PAIRS = 25_000_000


def check_entities(count: int) -> None:
    """Refuse a drawing of too many entities."""
    _check(count, MOST_ENTITIES, Phrase("things-entities"))


def check_vertices(count: int, kind: str) -> None:
    """Refuse an entity of too many vertices."""
    _check(count, MOST_VERTICES, Phrase("things-vertices", kind=kind))


def check_bytes(count: int) -> None:
    """Refuse a packed drawing that unpacks to too much."""
    _check(count, MOST_BYTES, Phrase("things-bytes"))


def check_tries(count: int) -> None:
    """Refuse a style sheet of too many rules for its elements."""
    _check(count, MOST_TRIES, Phrase("things-tries"))


def check_pairs(count: int) -> None:
    """Refuse a drawing in which too many edges come near to each other."""
    _check(count, MOST_PAIRS, Phrase("things-pairs"))


def _check(count: int, most: int, things: Phrase) -> None:
    if count > most:
        raise UserError(Finding("over-budget", most=most, things=things))
