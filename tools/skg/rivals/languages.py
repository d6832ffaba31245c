"""Languages by the endings of files' names."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from skg.errors import UserError
from skg.file_type import refuse_others
from skg.files import read_bytes, without_filling
from skg.messages.finding import Finding, Phrase

#: A rival's ending -> its language, and the module that makes SKG of it, loaded when it is needed: its `translate`
#: takes the text and the file's name.
RIVALS = {".xy": ("XY", "skg.rivals.xy"), ".tkh": ("TEKHTRAN", "skg.rivals.tekhtran")}


class RivalFault(Exception):
    """An error in a rival's program: a finding, and its line and column, both from 1."""

    def __init__(self, line: int, column: int, finding: Finding) -> None:
        super().__init__(finding)
        self.place = f"{line}:{column}"
        self.finding = finding

    def __str__(self) -> str:
        return str(self.finding.within(self.place))


def is_program(name: str) -> bool:
    """True if a file is a program, SKG's or a rival's, by its ending."""
    return Path(name).suffix.lower() == ".skg" or is_rival(name)


def translated(name: str, ending: str | None = None) -> str:
    """The SKG program for a rival's in a file (`-`: the standard input); bad input is a `UserError`.

    `ending` says which rival's, where the name does not.
    """
    language, module = RIVALS[ending or Path(name).suffix.lower()]
    expected = Phrase("file-program-in", language=language)
    data = without_filling(read_bytes(name))
    refuse_others(data, name, expected)
    if not data.strip():
        raise UserError(Finding("empty-program", expected=expected).within(name))
    try:
        return import_module(module).translate(data.decode("utf-8-sig"), Path(name).name)
    except UnicodeDecodeError as error:
        good = data[: error.start].decode("utf-8-sig")
        column = len(good) - good.rfind("\n")
        raise UserError(Finding("not-in-utf-8").within(f"{name}:{good.count(chr(10)) + 1}:{column}")) from None
    except RivalFault as fault:
        raise UserError(fault.finding.within(f"{name}:{fault.place}")) from None


def is_rival(name: str) -> bool:
    """True if a file is a rival's program."""
    return Path(name).suffix.lower() in RIVALS
