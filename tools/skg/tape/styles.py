"""3B as other people write it: read with a note of what is different, and written.

What CAM packages, textbooks and controllers' keyboards have in common is the block, B x B y B J G Z. Around it they put
blanks, numbers, headers, comments and words of their own for stops and the end; docs/tools.md, section "skg tape", has
the list.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from skg.errors import UserError
from skg.file_type import TAPE, refuse_others
from skg.files import without_mark
from skg.messages.finding import Finding, Phrase
from skg.tape.block import MAX_DIGITS, Block, Stop, Tape, line_block, start_quadrant

#: Words for the end of the tape. All others are stops.
ENDS = ("DD", "FF", "E", "END", "MJ", "M2", "M02", "M30")
#: In the block's own line, so that no header's last number is one.
#: (possessive: a long row of digits or blanks that is no number is left in one step)
_NUMBER = r"(?:N[^\S\n]*+(\d++)|(\d++))?(?:(?<=\d)[^\S\n]*+[:.,)、]?[^\S\n]*+)?"
_BLOCK = re.compile(
    _NUMBER + r"(B[\s,]*(\d*)[\s,]*B[\s,]*(\d*)[\s,]*B[\s,]*(\d*)[\s,]*G\s*([XY])[\s,]*(L|[NS]R)\s*([1-4]))", re.I
)
_WORD = re.compile(
    _NUMBER + r"(DD|FF|MJ|END|STOP|PAUSE|M[^\S\n]*(?:0?[0-2]|30)(?!\d)|[DAE])(?=[BN]\s*\d|[^A-Z]|$)", re.I
)
_BLANK = re.compile(r"[\s,\0\x7f]*")
_SOMETHING = re.compile(r"\w+|.")
_COMMENT = re.compile(r"\([^()\n]*\)|(?:;|//|#)[^\n]*")
_START = re.compile(r"START\s+POINT\s*=\s*([-+]?[\d.]+)\s*,\s*([-+]?[\d.]+)", re.I)
#: Full-width characters, as Chinese editors write them, and what they mean.
_FULL_WIDTH = {0x3000: " "} | {0xFF00 + code: chr(0x20 + code) for code in range(1, 0x5F)}
#: A line that is, or is meant to be, a block.
_LIKE_A_BLOCK = re.compile(r"^\s*+(?:N?\s*+\d++\s*+[:.]?\s*+)?B\s*\d|G\s*[XY]\s*(?:L|[NS]R)\s*\d", re.I | re.M)
_FOUR = re.compile(r"B\s*\d+\s*B\s*\d+\s*B\s*\d+\s*B\s*\d+\s*G|G\s*[XY]\s*DD?\s*(?:L|[NS]R)\s*[1-4]", re.I)


def read_any(data: bytes, name: str = "-") -> Tape:
    """Return the tape in `data`, whatever its style; `Tape.notes` tells the differences from the punch's own.

    What cannot be read, or cannot be right, is a `UserError` with line and column. A tape in the punch's own style must
    be whole; of any other it is noted where no word ends it.
    """
    refuse_others(data, name, TAPE)
    text = _decoded(without_mark(data)).strip("\0\x1a\x7f")
    bare_ends = "\r" in text and "\n" not in text
    text = re.sub("\r\n?", "\n", text)
    return _StyleReader(name, text.translate(_FULL_WIDTH), text, Counter({Phrase("style-bare-cr"): bare_ends})).read()


def _decoded(data: bytes) -> str:
    """The text of a tape: headers and comments are in UTF-8 or in GBK, if not in ASCII."""
    for encoding in ("utf-8", "gb18030"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    return data.decode("latin-1")


@dataclass
class _StyleReader:
    """A tape that is being read, and as it was before full-width characters became others; `seen` is what was
    different, with how often."""

    name: str
    text: str
    written: str
    seen: Counter[Phrase] = field(default_factory=Counter)
    items: list[Block | Stop] = field(default_factory=list)
    numbers: list[int] = field(default_factory=list)
    blocks: int = 0

    def error(self, index: int, why: Finding) -> UserError:
        """The error at a place of the text."""
        line = self.text.count("\n", 0, index) + 1
        column = index - (self.text.rfind("\n", 0, index) + 1) + 1
        return UserError(why.within(self.name, Phrase("at-column", line=line, column=column)))

    def read(self) -> Tape:
        start = _START.search(self.text)
        # Comments give way to blanks: places stay what they are.
        bare = _COMMENT.sub(lambda comment: " " * len(comment[0]), self.text)
        self.seen[Phrase("style-comments")] += bare != self.text
        self.seen[Phrase("style-blank-tape")] += "\0" in bare or "\x7f" in bare
        index = self._header(bare)
        end, behind = None, 0
        while (index := _behind(_BLANK, bare, index)) < len(bare):
            if block := _BLOCK.match(bare, index):
                self._block(block)
                self._note(not re.search(r"[\r\n]", bare[behind:index]) and behind > 0, Phrase("style-several"))
                index = behind = block.end()
            elif word := _WORD.match(bare, index):
                index = word.end()
                self._number(word)
                name = "".join(word[3].upper().split())
                if name in ENDS:
                    end = name
                    break
                self._note(word[3] != "D", Phrase("style-stop", word=name))
                self._note("\n" not in bare[behind:index] and behind > 0, Phrase("style-stop-beside"))
                self.items.append(Stop(self.blocks))
            else:
                raise self.error(index, Finding("no-block-no-word", found=_found(bare, index)))
        self._trailer(bare, index, end)
        place = (float(start[1]), float(start[2])) if start else (0.0, 0.0)
        return Tape.of(self.name, self.items, notes=self._notes(), start=place)

    def _note(self, is_so: bool, note: Phrase) -> None:
        self.seen[note] += is_so

    def _header(self, bare: str) -> int:
        """Pass by what stands before the first block."""
        if four := _FOUR.search(bare):
            raise self.error(four.start(), Finding("tape-4b"))
        first = _BLOCK.search(bare)
        if not first:
            like = _LIKE_A_BLOCK.search(bare)
            raise self.error(like.start(), Finding("no-block")) if like else self.error(0, Finding("no-block-at-all"))
        header = bare[: first.start()]
        if like := _LIKE_A_BLOCK.search(header):
            raise self.error(like.start() + len(like[0]) - len(like[0].lstrip()), Finding("no-block"))
        index = 0
        while word := _WORD.match(bare, _behind(_BLANK, bare, index)):
            index = word.end()
        if _behind(_BLANK, bare, index) >= first.start():
            # Nothing but stops: no header.
            return 0
        lines = sum(bool(line.strip()) for line in header.split("\n"))
        self.seen[Phrase("style-header", count=lines)] += 1
        return first.start()

    def _trailer(self, bare: str, index: int, end: str | None) -> None:
        """Look at what stands after the last word."""
        index = _behind(_BLANK, bare, index)
        if _BLOCK.search(bare, index):
            raise self.error(index, Finding("nothing-after", end=end, found=Phrase("a-block")))
        if like := _LIKE_A_BLOCK.search(bare, index):
            raise self.error(index, Finding("nothing-after", end=end, found=_found(bare, like.start())))
        self._note(end not in ("DD", None), Phrase("style-end", word=end))
        lines = sum(bool(line.strip()) for line in bare[index:].split("\n"))
        if lines and not self.styled():
            raise self.error(index, Finding("nothing-after", end="DD", found=_found(bare, index)))
        self._note(lines > 0, Phrase("style-trailer", count=lines))
        if end is None and not self.styled():
            raise self.error(len(bare), Finding("expected-found", expected="DD", found=Phrase("end-of-tape")))
        self._note(end is None, Phrase("style-no-end"))

    def styled(self) -> bool:
        """Tell whether the tape is in another style than the punch's own."""
        return any(self.seen.values())

    def _number(self, match: re.Match[str]) -> None:
        if number := match[1] or match[2]:
            self.numbers.append(int(number))
            self.seen[Phrase("style-numbers")] += 1

    def _block(self, match: re.Match[str]) -> None:
        self._number(match)
        self.blocks += 1
        written, digits = match[3], match.group(4, 5, 6)
        for name, number in zip("xyJ", digits, strict=True):
            if len(number.lstrip("0")) > MAX_DIGITS:
                why = Finding("too-many-digits", name=name, digits=len(number), most=MAX_DIGITS)
                raise self.error(match.start(3), why)
        self._note(any(number[:1] == "0" and len(number) > 1 for number in digits), Phrase("style-zeros"))
        self._note(self.written[match.start() : match.end()] != match[0], Phrase("style-full-width"))
        self._note("" in digits, Phrase("style-no-zeros"))
        self._note(bool(re.search(r"[\s,]", written)), Phrase("style-blanks"))
        self._note(written != written.upper(), Phrase("style-small"))
        x, y, j = (int(number or 0) for number in digits)
        given = Block(x, y, j, match[7].upper(), (match[8] + match[9]).upper(), self.blocks)
        block = self._line(given) if given.is_line else self._arc(given)
        if problems := block.problems():
            raise self.error(match.start(3), problems[0].within(Phrase("block-number", block=self.blocks)))
        self.items.append(block)

    def _line(self, given: Block) -> Block:
        """A line as the punch has it."""
        # An axis names the direction, when x and y do not.
        along_x, right = given.quadrant % 2 == 1, given.quadrant in (1, 4)
        x, y, j = given.x, given.y, given.j
        if (x, y) == (0, 0) and j and along_x == (given.axis == "X"):
            self.seen[Phrase("style-j-alone")] += 1
            x, y = (j, 0) if along_x else (0, j)
        count = x if given.axis == "X" else y
        if count and j > count and j % count == 0 and j != max(x, y):
            self.seen[Phrase("style-slope")] += 1
            x, y = x * j // count, y * j // count
        elif count != j:
            return given
        if (x, y) == (0, 0):
            return given
        made = line_block(x if right else -x, y if given.quadrant < 3 else -y)
        self._note(made.axis != given.axis, Phrase("style-other-g"))
        self._note(made.code != given.code, Phrase("style-line-quadrant"))
        return Block(made.x, made.y, made.j, made.axis, made.code, given.number)

    def _arc(self, given: Block) -> Block:
        """An arc as the punch has it: one that starts on an axis is named by the quadrant that it moves into."""
        if (given.x, given.y) == (0, 0):
            return given
        quadrant = start_quadrant(*given.start, given.sense)
        self._note(quadrant != given.quadrant, Phrase("style-arc-quadrant"))
        return Block(given.x, given.y, given.j, given.axis, f"{given.code[:2]}{quadrant}", given.number)

    def _notes(self) -> tuple[Finding, ...]:
        notes = [note for note, count in self.seen.items() if count]
        steps = {later - earlier for earlier, later in zip(self.numbers, self.numbers[1:], strict=False)}
        if len(steps) > 1:
            notes.append(Phrase("style-uneven"))
        return (Finding("other-style", notes=tuple(notes)),) if notes else ()


def _behind(pattern: re.Pattern[str], text: str, index: int) -> int:
    """The place behind what a pattern takes at a place; the same where it takes nothing."""
    match = pattern.match(text, index)
    return match.end() if match else index


def _found(text: str, index: int) -> str | Phrase:
    """Quote the text at a place, for a message."""
    if index >= len(text):
        return Phrase("end-of-tape")
    word = text[index : _behind(_SOMETHING, text, index)][:20]
    return repr(word) if word.isprintable() else Phrase("byte", byte=ord(word[0]))


# Writing --------------------------------------------------------------------------------------------------


_SPACED = "B {x} B {y} B {j} G{axis} {code}\r\n"
#: Name -> how a block is written, and a word; `number` counts both, from 1.
STYLES = {
    "punch": ("B{x}B{y}B{j}G{axis}{code}\r\n", "{word}\r\n"),
    "spaced": (_SPACED, "{word}\r\n"),
    "numbered": (f"N{{number:4}}: {_SPACED}", "N{number:4}: {word}\r\n"),
    "padded": ("B{x:06}B{y:06}B{j:06}G{axis}{code}\r\n", "{word}\r\n"),
    "joined": ("B {x}B {y}B {j} G{axis} {code} ", "{word} "),
}


def to_style(items: Iterable[Block | Stop], style: str) -> bytes:
    """Return a tape in one of `STYLES`, its end included. A number of more than 8 digits does not fit: `UserError`."""
    block_form, word_form = STYLES[style]
    texts: list[str] = []
    for number, item in enumerate(items, 1):
        if isinstance(item, Stop):
            texts.append(word_form.format(number=number, word="D"))
            continue
        x, y, j = item.x, item.y, item.j
        if max(x, y, j) >= 10**MAX_DIGITS:
            why = Finding("number-too-long", item=str(item), most=MAX_DIGITS)
            raise UserError(why.within(Phrase("line-number", line=number)))
        texts.append(block_form.format(number=number, x=x, y=y, j=j, axis=item.axis, code=item.code))
    texts.append(word_form.format(number=len(texts) + 1, word="DD"))
    return "".join(texts).encode("ascii")
