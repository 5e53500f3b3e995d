"""Diagnostics on standard error, in colour where that is a terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from lagcli.cli.status import Status

if TYPE_CHECKING:
    from lagcli.diagnostics import Diagnostic, Source
    from lagcli.numerics.equations.refusal import Refusal

_COLUMNS = 80


def report(source: Source, diagnostics: Sequence[Diagnostic]) -> str:
    """Show the mistakes (and warnings) of one file, and give the text that was shown."""
    if not diagnostics:
        return ""
    from lagcli.diagnostics import render

    text = render(source, diagnostics)
    report_text(text)
    return text


def report_refusal(source: Source, refusal: Refusal) -> Status:
    """Show why there is no motion, and give the exit status."""
    report(source, refusal.diagnostics)
    return Status.USAGE if refusal.mistake else Status.NOT_FOUND


def report_text(text: str) -> None:
    """Show diagnostics that are a text already."""
    if sys.stderr.isatty():
        _report_in_colour(text)
    else:
        sys.stderr.write(text if text.endswith("\n") else text + "\n")
    sys.stderr.flush()


def report_line(line: str) -> None:
    """Show one sentence that has no place in a file."""
    from lagcli.diagnostics import printable

    sys.stderr.write(within_a_terminal(printable(line)) + "\n")
    sys.stderr.flush()


def within_a_terminal(line: str) -> str:
    """A sentence on lines of 80 columns where a person reads it; a program gets one line."""
    if len(line) <= _COLUMNS or not sys.stderr.isatty():
        return line
    from textwrap import fill

    return fill(
        line, _COLUMNS, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
    )


def _report_in_colour(text: str) -> None:
    """The same characters; rich knows what this terminal can do, and NO_COLOR."""
    from rich.console import Console
    from rich.text import Text

    shown = Text(text.rstrip("\n"))
    shown.highlight_regex(r"(?<=: )error(?=: )", "bold red")
    shown.highlight_regex(r"(?<=: )warning(?=: )", "bold yellow")
    shown.highlight_regex(r"(?m)^ +\| +\^+.*$", "cyan")
    Console(stderr=True, soft_wrap=True, highlight=False, markup=False).print(shown)
