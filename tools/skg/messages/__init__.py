"""The messages of `skg`: facts with a code, and their sentences in English and Chinese.

The code that finds something out makes a `Finding` of it, and composes no sentence:

    raise UserError(Finding("layer-twice", layer=name).within(file, "[[layer]] 2"))
    findings.append(Finding("no-tab-here", contour=planned.number, place=planned.entry, length=planned.tab))

`en.po` and `zh.po` have one whole sentence for each code, with the values by their names:

    msgid "layer-twice"
    msgstr "layer {layer} is there twice"

A message is added like this:

1. A `Finding` with a code of its own: what is the matter, in two to four words. Its values are facts (numbers in mm,
   places, names), not words. A word that depends on a fact is a `Phrase`: `Phrase("outline")` has its own entry in the
   catalogues. What a library or the system says is the value `detail`: it is English, and no Chinese sentence has it;
   beside it stands what tells it apart (`errors.of_library`, `errors.of_system`). `contour` (from 0) and `place` (mm)
   let the page show where; a template may use them too.
2. An entry in `en.po` and in `zh.po`, in the section of the package. A text with a number of things is an entry with
   `msgid_plural`: the value `count` decides. The form of a value follows its type: a length has up to four decimals, a
   tuple is a list with commas; `{place:xy}` is a place, `{drift:.2f}` as Python formats it. Advice names a setting as
   the command line does, `{--tab}`, `{--small=leave}`, `{--tolerance=$gap}` (a value): beside a job file it is said
   in the file's words, on the page in the page's (`settings`).
3. The severity, in `severity`: what a report has is a note unless its code stands there; what is raised is an error.

Tests hold the catalogues complete, their values the same, and each code that is used known; each test that makes a
message looks for an English sentence among its values (tests/prose.py). No code reads a sentence; a
test looks at `error.finding.code` and its values.

The catalogues are GNU gettext's, so that every editor for translations reads them, and Python's own gettext loads what
the build compiles in 2 ms. Project Fluent was tried on the same messages: 130 ms for its import and 36 MB of Babel,
beside 460 ms that `skg cut` takes for a bracket.
"""

import skg.messages.render  # noqa: F401  (a phrase is written by it)
