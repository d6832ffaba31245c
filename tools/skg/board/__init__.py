"""The 8080 board and its teletype."""

from skg.board.board import Board, BoardStopped, ErrorLine
from skg.board.emulator import BOARDS, ENDS, Batch, Machine, symbols

__all__ = ["BOARDS", "ENDS", "Batch", "Board", "BoardStopped", "ErrorLine", "Machine", "symbols"]
