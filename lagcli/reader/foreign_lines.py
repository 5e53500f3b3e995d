"""Lines that are none of the file: those of a merge conflict, and comments of other languages."""

from __future__ import annotations

import re
from functools import partial

from lagcli.diagnostics import Diagnostic, Span
from lagcli.reader.habits import COMMENT
from lagcli.reader.regex import regex

#: Two versions, and between them that of their ancestor.
_CONFLICT = regex(
    r"^<{7} .*\n(?P<first>(?:.*\n)*?)(?:^\|{7}.*\n(?:.*\n)*?)?"
    r"^={7}\n(?P<second>(?:.*\n)*?)^>{7}.*$",
    re.MULTILINE,
)
#: What is left of a conflict, or a comment that begins its line: `! a`, `// a`, `/* a */`.
_NO_LINE = regex(
    r"^(?:(?:<{7} |={7}$|>{7} |\|{7} ).*$"
    r"|(?P<comment>/\*(?:[^*]|\*(?!/))*\*/[^\S\n]*$|(?://|!\s|--\s|/\*).*$))",
    re.MULTILINE,
)
_KEY = regex(r"^[^\W\d]\w*:(?:\s|$)", re.MULTILINE)


def without_foreign_lines(text: str) -> tuple[list[Diagnostic], list[str]]:
    """What is wrong with such lines, and the texts without them: one for each version.

    Their lines are those of the file.  Nothing is wrong with a text that has no such line, or
    no key of a problem.
    """
    if not _KEY.search(text):
        return [], []
    found, lines = [], text.split("\n")
    for each in _CONFLICT.finditer(text):
        versions = (_lines(each, name) for name in ("first", "second") if each[name])
        hint = f"keep {' or '.join(versions)}, and leave out the other lines of it"
        found.append(_in_line(each, lines, "a merge conflict is not resolved", hint))
    for each in _NO_LINE.finditer(_CONFLICT.sub(_blank, text)):
        hint = COMMENT if each["comment"] else "leave it out"
        found.append(_in_line(each, lines, "this line is none of the file", hint))
    texts = [_CONFLICT.sub(partial(_version, name=name), text) for name in ("first", "second")]
    return found, [_NO_LINE.sub(_blank, each) for each in dict.fromkeys(texts)]


def _blank(found: re.Match[str]) -> str:
    return "\n" * found[0].count("\n")


def _version(found: re.Match[str], name: str) -> str:
    """One of both versions, in its lines."""
    above = found.string.count("\n", found.start(), found.start(name))
    return (
        "\n" * above + found[name] + "\n" * found.string.count("\n", found.end(name), found.end())
    )


def _lines(found: re.Match[str], name: str) -> str:
    first = found.string.count("\n", 0, found.start(name)) + 1
    last = first + found[name].count("\n") - 1
    return f"lines {first} to {last}" if last > first else f"line {first}"


def _in_line(found: re.Match[str], lines: list[str], message: str, hint: str) -> Diagnostic:
    line = found.string.count("\n", 0, found.start()) + 1
    return Diagnostic(message, Span(line, 1, line, len(lines[line - 1]) + 1), hint)
