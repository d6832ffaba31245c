"""The catalogues: the sentences of a language by their codes."""

from __future__ import annotations

from functools import cache
from gettext import GNUTranslations
from io import BytesIO
from pathlib import Path

#: The languages, as their catalogues are called.
LANGUAGES = ("en", "zh")
_FOLDER = Path(__file__).parent


@cache
def catalogue(language: str) -> GNUTranslations:
    """The catalogue of a language: as the build of a package compiled it; in the project's tree out of its source."""
    compiled = _FOLDER / f"{language}.mo"
    if compiled.exists():
        with compiled.open("rb") as file:
            return GNUTranslations(file)
    from polib import pofile

    return GNUTranslations(BytesIO(pofile(str(_FOLDER / f"{language}.po")).to_binary()))


def template(code: str, language: str, count: int | None = None) -> str:
    """The sentence of a code with the names of its values; `count`: decides between singular and plural."""
    entries = catalogue(language)
    text = entries.ngettext(code, code, count) if count is not None else code
    return entries.gettext(code) if text == code else text
