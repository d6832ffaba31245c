"""A DXF file's bytes as records: its entities as they stand in the file, its blocks, layers and units.

ezdxf reads a file whole or not at all, and what it mends it may lose: entities whose handles repeat, all that follows a
section without its end, a polyline without its subclass. So the file is cut into records here, and ezdxf makes an
entity of one by itself (`skg.reading.slow_dxf`), where it is needed: one that it cannot read is named, and costs no
other.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from skg.errors import UserError
from skg.file_type import kind_of
from skg.messages.finding import Finding, Phrase
from skg.reading.curves import is_number
from skg.reading.dxf_record import Group, Record, unescaped
from skg.reading.unread import what_of

#: $INSUNITS -> the name of the units, and mm in one.
UNITS = {
    1: ("inch", 25.4), 2: ("foot", 304.8), 3: ("mile", 1_609_344.0), 4: ("mm", 1.0), 5: ("cm", 10.0), 6: ("m", 1000.0),
    7: ("km", 1e6), 8: ("microinch", 2.54e-5), 9: ("mil", 0.0254), 10: ("yard", 914.4), 11: ("angstrom", 1e-7),
    12: ("nm", 1e-6), 13: ("um", 0.001), 14: ("dm", 100.0), 15: ("dam", 1e4), 16: ("hm", 1e5), 17: ("Gm", 1e12),
    21: ("US survey foot", 1200 / 3937 * 1000), 22: ("US survey inch", 100 / 3937 * 1000),
    23: ("US survey yard", 3600 / 3937 * 1000), 24: ("US survey mile", 6_336_000 / 3937 * 1000),
}  # fmt: skip
_BINARY, _IS_BINARY = b"AutoCAD Binary DXF\r\n\x1a\x00", b"AutoCAD Binary DXF"
#: A number with a comma, as some programs write it where that is the custom.
_COMMA = re.compile(r"\s*[+-]?\d*,\d*(?:[eE][+-]?\d+)?\s*")
#: Kinds that belong to the entity before them.
_PARTS = ("VERTEX", "ATTRIB", "SEQEND")
#: Flags of a block definition whose content is in another file.
_EXTERNAL = 4 | 8 | 16


@dataclass
class Definition:
    """A block as it is defined: what each reference to it shows. `base`: None where the file does not tell it."""

    base: tuple[float, float, float] | None
    is_external: bool
    records: list[Record] = field(default_factory=list)


@dataclass
class DxfFile:
    """The content of a DXF file. `units`: name and mm in one, None when it does not tell; `is_imperial`: it asks
    for the hatches and line types of a country with inches. Names of layers and blocks are
    in lower case as keys. `states`: "off" or "frozen" of layers that are not seen; `dashed`: the line types that are
    not drawn through, in upper case; `dashed_layers`: that of each layer that has one. `notes`: what was mended."""

    units: tuple[str, float] | None = None
    is_imperial: bool = False
    layers: dict[str, str] = field(default_factory=dict)
    states: dict[str, str] = field(default_factory=dict)
    dashed: set[str] = field(default_factory=set)
    dashed_layers: dict[str, str] = field(default_factory=dict)
    multiline_styles: dict[str, Record] = field(default_factory=dict)
    blocks: dict[str, Definition] = field(default_factory=dict)
    model: list[Record] = field(default_factory=list)
    paper: list[Record] = field(default_factory=list)
    notes: list[Finding] = field(default_factory=list)


def load(data: bytes, encoding: str | None = None) -> DxfFile:
    """Read a DXF file's bytes, text or binary; what is none is a `UserError`. `encoding`: of a text, None: as the file
    says, else guessed."""
    file = DxfFile()
    section = kind = ""
    block: Definition | None = None
    for record in _records(_groups(data, encoding, file.notes)):
        kind = record.kind
        if kind == "SECTION":
            section, block = record.value(2).strip().upper(), None
            if section == "HEADER":
                file.units = _units(record.groups)
                file.is_imperial = _variable(record.groups, "$MEASUREMENT") == "0"
        elif kind in ("ENDSEC", "EOF"):
            section = ""
        elif section == "BLOCKS":
            block = _of_blocks(file, block, record)
        elif section == "ENTITIES":
            _add(file.paper if record.whole(67) else file.model, record)
        else:
            _of_tables(file, section, record)
    _refuse_cut_off(kind, file.notes)
    file.dashed_layers = {name: kind for name, kind in file.dashed_layers.items() if kind in file.dashed}
    for name, block in file.blocks.items():
        if name.startswith(("*paper_space", "$paper_space")):
            file.paper += block.records
    return file


def _refuse_cut_off(last: str, notes: list[Finding]) -> None:
    """Refuse a file that ends within a section, by its last record; one that ends behind a section is said."""
    if last == "EOF":
        return
    if last != "ENDSEC":
        raise UserError(Finding("cut-off"))
    notes.append(Finding("no-eof"))


def _groups(data: bytes, encoding: str | None, notes: list[Finding]) -> Iterator[Group]:
    """A file's groups, told by its first bytes what kind it is; what is odd about it goes to `notes`."""
    if data[:4] == b"AC10" and data[4:6].isdigit():
        raise UserError(Finding("dwg"))
    if data.startswith(_BINARY):
        return _of_binary(data)
    if data.startswith(_IS_BINARY):
        raise UserError(Finding("binary-changed"))
    if b"SECTION" not in data and b"S\0E\0C\0T\0I" not in data:
        kind = kind_of(data)
        raise UserError(Finding("not-a-drawing", kind=kind) if kind else Finding("no-section"))
    return _of_text(_decoded(data, encoding, notes), notes)


def _of_tables(file: DxfFile, section: str, record: Record) -> None:
    """Read line types, layers and multiline styles from tables and objects."""
    match section, record.kind:
        case "TABLES", "LTYPE":
            if record.whole(73):
                file.dashed.add(record.value(2).strip().upper())
        case "TABLES", "LAYER":
            _layer(file, record)
        case "OBJECTS", "MLINESTYLE":
            file.multiline_styles[record.value(2).strip().upper()] = record


def _of_blocks(file: DxfFile, block: Definition | None, record: Record) -> Definition | None:
    """Take one record of the section of blocks; returns the block that is open behind it."""
    if record.kind == "ENDBLK":
        return None
    if record.kind == "BLOCK":
        block = _block(record)
        file.blocks[record.value(2).strip().lower()] = block
    elif block is not None:
        _add(block.records, record)
    return block


def _add(records: list[Record], record: Record) -> None:
    if record.kind in _PARTS and records:
        records[-1].parts.append(record)
    else:
        records.append(record)


def _records(groups: Iterable[Group]) -> Iterator[Record]:
    """Groups from each code 0 up to the next."""
    record: list[Group] = []
    for group in groups:
        if group[0] == 0:
            if record:
                yield Record(record)
            record = [group]
        elif record:
            record.append(group)
    if record:
        yield Record(record)


def _of_text(text: str, notes: list[Finding]) -> Iterator[Group]:
    """The groups of a text file."""
    text = text.replace("\r\n", "\n")
    lines = re.split("\r*\n|\r", text) if "\r" in text else text.split("\n")
    index = 0
    while index < len(lines) and not lines[index].strip():
        index += 1
    value = ""
    may_have_commas, has_commas, has_blanks = "," in text, False, False
    while index < len(lines) - 1:
        try:
            code = int(lines[index])
        except ValueError:
            if lines[index].strip():
                finding = Finding("no-group-code", text=lines[index].strip()[:20])
                raise UserError(finding.within(Phrase("line-number", line=index + 1))) from None
            if not has_blanks:
                notes.append(Finding("empty-lines"))
            has_blanks = True
            index += 1
            continue
        value = lines[index + 1]
        index += 2
        if may_have_commas and "," in value and _is_real(code) and _COMMA.fullmatch(value):
            value = value.replace(",", ".")
            if not has_commas:
                notes.append(Finding("decimal-commas"))
            has_commas = True
        yield code, value
        if code == 0 and value.strip() == "EOF":
            return


def _is_real(code: int) -> bool:
    """Tell whether a group's value is a number with decimals."""
    return 10 <= code < 60 or 110 <= code < 150 or 210 <= code < 240 or 460 <= code < 470


def _of_binary(data: bytes) -> Iterator[Group]:
    """The groups of a binary file, as text."""
    from skg.reading import slow_dxf  # (slow to import, and seldom needed)

    try:
        yield from slow_dxf.binary_groups(data)
    except (IndexError, ValueError) as error:
        raise UserError(Finding("not-binary-dxf", what=what_of(error))) from None


def _decoded(data: bytes, encoding: str | None, notes: list[Finding]) -> str:
    """The text of a file: in an encoding, else UTF-8 where it is that, else in the code page that it tells or that is
    guessed."""
    if encoding:
        try:
            return data.decode(encoding)
        except UnicodeDecodeError as error:
            line = data.count(b"\n", 0, error.start) + 1
            finding = Finding("not-in-encoding", encoding=encoding)
            raise UserError(finding.within(Phrase("line-number", line=line))) from None
    for mark, encoding in ((b"\xff\xfe", "utf-16"), (b"\xfe\xff", "utf-16"), (b"\xef\xbb\xbf", "utf-8-sig")):
        if data.startswith(mark):
            return data.decode(encoding, "replace")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        page = re.search(rb"\$DWGCODEPAGE\s+3\s+(\S+)", data)
        if not page:
            guess = "gbk" if _is_chinese(data) else "cp1252"
            name = {"gbk": "GBK", "cp1252": "Windows-1252"}[guess]
            notes.append(Finding("encoding-guessed", name=name))
            return data.decode(guess, "replace")
        from skg.reading import slow_dxf  # (as above)

        told = page[1].decode("ascii", "replace")
        encoding = slow_dxf.encoding(told)
        if encoding != "gbk" and _is_chinese(data):
            notes.append(Finding("encoding-doubtful", name=told))
        return data.decode("cp1252" if encoding == "utf8" else encoding, "replace")


def _is_chinese(data: bytes) -> bool:
    """Tell whether what is not ASCII in a text is Chinese: pairs of bytes, most of them usual characters. (A western
    letter and what follows it are a pair, too, but of a rare one.)"""
    try:
        codes = [character.encode("gbk") for character in data.decode("gbk") if character > "\x7f"]
    except UnicodeDecodeError:
        return False
    usual = sum(0xB0 <= first <= 0xD7 and second >= 0xA1 for first, second in codes)
    return 2 * usual > len(codes)


def _variable(header: list[Group], wanted: str) -> str:
    """A variable of the header, empty when it is not there."""
    for (code, name), (_, value) in zip(header, header[1:], strict=False):
        if code == 9 and name.strip() == wanted:
            return value.strip()
    return ""


def _units(header: list[Group]) -> tuple[str, float] | None:
    """Return the units by $INSUNITS."""
    value = _variable(header, "$INSUNITS")
    return UNITS.get(int(value)) if value.isdigit() else None


def _layer(file: DxfFile, record: Record) -> None:
    name = unescaped(record.value(2).strip())
    file.layers[name.lower()] = name
    file.dashed_layers[name.lower()] = record.value(6).strip().upper()
    if record.whole(70) & 1:
        file.states[name.lower()] = "frozen"
    elif record.whole(62) < 0:
        file.states[name.lower()] = "off"


def _block(record: Record) -> Definition:
    x, y, z = record.real(10), record.real(20), record.real(30) if 30 in record.first else 0.0
    return Definition(
        (x, y, z) if is_number(x) and is_number(y) and is_number(z) else None, bool(record.whole(70) & _EXTERNAL)
    )
