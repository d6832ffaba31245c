"""Named setups in a folder of the user's: what a shop keeps for one machine and wire, in the words of a job.

setups = Setups(folder)
setups.keep("fine", tables)
tables = setups.kept("fine")
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from skg.errors import UserError
from skg.files import read_bytes, write_bytes
from skg.job.file import Tables, decoded_setup, encoded_setup
from skg.messages.finding import Finding

_ENDING = ".toml"
#: A name has no more letters.
_LONGEST = 60
#: No file's name has these on some system, nor one of these names.
_ODD = frozenset('/\\:*?"<>|')
_DEVICES = frozenset({"con", "prn", "aux", "nul", *(f"{port}{at}" for port in ("com", "lpt") for at in range(1, 10))})


@dataclass(frozen=True)
class Setups:
    """The setups in a folder, which may not be there yet. A name that none can have is a `UserError`."""

    folder: Path

    def names(self) -> list[str]:
        """The setups that there are."""
        with suppress(OSError):
            files = [path.name for path in self.folder.iterdir() if path.name.endswith(_ENDING)]
            return sorted(name for name in (file.removesuffix(_ENDING) for file in files) if _is_name(name))
        return []

    def kept(self, name: str) -> Tables:
        """The tables of a setup; a `UserError` where there is none of the name, or its file is damaged."""
        path = self._path(name)
        if not path.exists():
            known = self.names()
            if near := get_close_matches(name, known, 1, 0.5):
                raise UserError(Finding("no-setup-near", name=name, near=near[0]))
            none = Finding("no-setup-at-all", name=name, folder=str(self.folder))
            some = Finding("no-setup", name=name, folder=str(self.folder), names=tuple(known))
            raise UserError(some if known else none)
        return decoded_setup(read_bytes(str(path)), str(path))

    def is_kept(self, name: str) -> bool:
        """Tell whether there is a setup of a name."""
        return self._path(name).exists()

    def keep(self, name: str, tables: Tables) -> None:
        """Write a setup, whole or not at all."""
        path = self._path(name)
        self.folder.mkdir(parents=True, exist_ok=True)
        write_bytes(str(path), encoded_setup(tables))

    def drop(self, name: str) -> None:
        """Remove a setup."""
        self._path(name).unlink(missing_ok=True)
        if self.last() == name:
            self.note_last("")

    def last(self) -> str:
        """The name of the setup that was chosen last, nothing where there is none."""
        name = ""
        with suppress(OSError, UnicodeDecodeError):
            name = self._last.read_bytes().decode().strip()
        return name if _is_name(name) else ""

    def note_last(self, name: str) -> None:
        """Note the setup that was chosen last, or that none is."""
        if name:
            _refuse_name(name)
            self.folder.mkdir(parents=True, exist_ok=True)
            write_bytes(str(self._last), f"{name}\n".encode())
        else:
            self._last.unlink(missing_ok=True)

    @property
    def _last(self) -> Path:
        return self.folder / "last"

    def _path(self, name: str) -> Path:
        _refuse_name(name)
        return self.folder / f"{name}{_ENDING}"


def _is_name(name: str) -> bool:
    """Tell whether a file of every system may have the name."""
    return (
        0 < len(name) <= _LONGEST
        and name.isprintable()
        and not set(name) & _ODD
        and name == name.strip(" .")
        and name.partition(".")[0].strip().lower() not in _DEVICES
    )


def _refuse_name(name: str) -> None:
    if not _is_name(name):
        raise UserError(Finding("bad-setup-name", name=name[:_LONGEST], most=_LONGEST))
