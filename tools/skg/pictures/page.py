"""Common parts of plots and setup sheets: foreign text, and writing a page."""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any

import matplotlib as mpl
from matplotlib import font_manager
from matplotlib.figure import Figure

from skg.files import binary_output
from skg.wording import visible

#: The font that matplotlib brings along, and others that have what it has not, where they are installed.
_FONT = "DejaVu Sans"
_MORE_FONTS = (
    "Noto Sans CJK SC",
    "Noto Sans CJK JP",
    "Source Han Sans SC",
    "WenQuanYi Zen Hei",
    "WenQuanYi Micro Hei",
    "Microsoft YaHei",
    "SimHei",
    "PingFang SC",
    "Hiragino Sans",
    "Arial Unicode MS",
    "Droid Sans Fallback",
)


def as_it_stands(text: str) -> dict[str, Any]:
    """Escape a file's name or a title for matplotlib: no formula between dollars, in a font that has
    its letters."""
    shown = visible(text)
    options: dict[str, Any] = {"s": shown, "parse_math": False}
    letters = font_manager.get_font(font_manager.findfont(_FONT))
    if not all(letters.get_char_index(ord(character)) for character in shown):
        options["fontfamily"] = [_FONT, *installed()]
    return options


@cache
def installed() -> tuple[str, ...]:
    """The installed fonts that have Chinese and Japanese letters."""
    known = {font.name for font in font_manager.fontManager.ttflist}
    return tuple(name for name in _MORE_FONTS if name in known)


def save(figure: Figure, output: str, form: str, dpi: int, metadata: dict[str, str] | None = None) -> None:
    """Write a page as "svg", "png" or "pdf"; text in an SVG stays text. The same page always gives the same bytes."""
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(form, {})
    settings = {"svg.hashsalt": "skg", "svg.fonttype": "none", "path.simplify": False}
    with binary_output(output) as stream, mpl.rc_context(settings), warnings.catch_warnings():
        # (a letter that no font has is an empty box)
        warnings.filterwarnings("ignore", "Glyph")
        figure.savefig(stream, format=form, dpi=dpi, metadata=undated | (metadata or {}), facecolor="white")
