"""`skg xy`: an XY program made an SKG program."""

from __future__ import annotations

from skg.commands.rival import translator

command = translator("xy", ".xy", "XY, the language of Beijing, 1979")
