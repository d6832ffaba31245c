"""Findings: a code, its values, and the contour and place that it is about."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Self, TypeVar

from skg.messages.severity import Severity, severity_of

#: A function of places, mm.
_Move = Callable[[tuple[float, float]], tuple[float, float]]
#: Names of values that are a place, of those that are places, and of pairs that are a place.
_PLACE, _PLACES, _PAIRS = frozenset({"place", "start", "end"}), "places", (("x", "y"), ("u", "v"))

#: What writes a phrase in this process's language: `render` puts it here, which the package imports.
written: list[Callable[[Phrase], str]] = []


@dataclass(frozen=True, init=False)
class Phrase:
    """A part of a sentence that has its own entry in the catalogues, such as a reason or a noun with its number.

    `values`: numbers, texts, places, other phrases, or tuples of these; None is nothing.
    """

    code: str
    values: tuple[tuple[str, Any], ...]

    def __init__(self, code: str, /, **values: object) -> None:
        object.__setattr__(self, "code", code)
        object.__setattr__(self, "values", tuple(values.items()))

    def __str__(self) -> str:
        """The sentence in this process's language; a finding's with its source."""
        return written[0](self)

    def __getitem__(self, name: str) -> Any:  # noqa: ANN401
        """A value by its name."""
        return dict(self.values)[name]

    def moved(self, to: _Move) -> Self:
        """The same with all its places elsewhere, those of its parts too."""
        values = {name: _moved(name, value, to) for name, value in self.values}
        for x, y in _PAIRS:
            if x in values and y in values:
                values[x], values[y] = to((values[x], values[y]))
        return _replaced(self, values=tuple(values.items()))


@dataclass(frozen=True, init=False)
class Finding(Phrase):
    """A message. `contour`: the number (from 0) of the contour, among those that were read, that it is about; `place`:
    where, mm. `source`: file, section and line that it stands in, as far as these are known."""

    contour: int | None = None
    place: tuple[float, float] | None = None
    source: tuple[str | Phrase, ...] = ()

    def __init__(
        self,
        code: str,
        /,
        *,
        contour: int | None = None,
        place: tuple[float, float] | None = None,
        **values: object,
    ) -> None:
        super().__init__(code, **values)
        object.__setattr__(self, "contour", contour)
        object.__setattr__(self, "place", place)
        object.__setattr__(self, "source", ())

    @property
    def severity(self) -> Severity:
        """The severity of its code."""
        return severity_of(self.code)

    def within(self, *source: str | Phrase) -> Finding:
        """The same, in a file or a part of one: these come before the sources that it has."""
        return _replaced(self, source=(*source, *self.source))

    def about(self, contour: int) -> Finding:
        """The same, about a contour."""
        return _replaced(self, contour=contour)

    def moved(self, to: _Move) -> Self:
        """The same with all its places elsewhere, those of its parts too."""
        return _replaced(super().moved(to), place=self.place and to(self.place))


def beyond(shown: int, entries: Sequence, code: str) -> list[Finding]:
    """The count of the entries behind those that are shown with a line each; no finding where there are none."""
    more = len(entries) - shown
    return [Finding(code, count=more)] if more > 0 else []


_P = TypeVar("_P", bound=Phrase)


def _replaced(phrase: _P, **fields: object) -> _P:
    made = object.__new__(type(phrase))
    for name, value in (vars(phrase) | fields).items():
        object.__setattr__(made, name, value)
    return made


def _moved(name: str, value: Any, to: _Move) -> Any:  # noqa: ANN401
    if isinstance(value, Phrase):
        return value.moved(to)
    if not isinstance(value, tuple):
        return value
    if name in _PLACE:
        return to(value)
    return tuple(map(to, value)) if name == _PLACES else tuple(_moved("", item, to) for item in value)
