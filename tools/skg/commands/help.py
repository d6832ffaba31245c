"""The words of the command line in another language than English: the help of commands and options, and click's.

The English stands in the commands and in click itself; `help.po` has the Chinese of it, sentence by sentence. A test
holds it complete.
"""

from __future__ import annotations

from copy import copy
from gettext import NullTranslations
from inspect import cleandoc

import click
from click import core, decorators, exceptions, formatting, parser, types

from skg.messages.catalogue import catalogue


def translations(language: str) -> NullTranslations:
    """The sentences of the help by their English ones."""
    return NullTranslations() if language == "en" else catalogue("help")


def speak(language: str) -> None:
    """Let click speak a language. (Its modules keep gettext's functions under these names.)"""
    words = translations(language)
    for module in (core, decorators, exceptions, formatting, parser, types):
        for name, function in (("_", words.gettext), ("ngettext", words.ngettext)):
            if hasattr(module, name):
                setattr(module, name, function)


def translated(command: click.Command, language: str) -> click.Command:
    """A command with its help in a language."""
    if language == "en":
        return command
    words = translations(language)
    command = copy(command)
    command.help = words.gettext(cleandoc(command.help or ""))
    command.params = [_translated(parameter, words) for parameter in command.params]
    return command


def _translated(parameter: click.Parameter, words: NullTranslations) -> click.Parameter:
    if not isinstance(parameter, click.Option) or not parameter.help:
        return parameter
    parameter = copy(parameter)
    parameter.help = words.gettext(parameter.help or "")
    return parameter
