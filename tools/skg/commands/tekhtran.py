"""`skg tekhtran`: a TEKHTRAN program made an SKG program."""

from __future__ import annotations

from skg.commands.rival import translator

command = translator("tekhtran", ".tkh", "TEKHTRAN, a Soviet language for NC machines")
