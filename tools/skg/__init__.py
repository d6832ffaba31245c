"""SKG, the numerical-control language of an 8080 board: its host tools, and the board itself.

    >>> import skg
    >>> board = skg.Board()
    >>> board.type("PRINT SQR 2")
    ['1.4142136']

`Board` is what programs may rely on; everything else is the command line's own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from skg.board.board import Board, BoardStopped, ErrorLine

__all__ = ["Board", "BoardStopped", "ErrorLine"]


def __getattr__(name: str) -> object:
    """The public names, imported when they are asked for: `skg --help` needs no board."""
    if name in __all__:
        from skg.board import board

        return getattr(board, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
