"""A plain command line of `simulate`, read without click and typer.

They take 60 ms to be imported, a third of a short run.  What is not plain (help, mistakes,
abbreviations, values that begin with a dash) is left to them.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from lagcli.cli.status import Status

#: option -> the field of the wish, and of whole numbers the least and the largest
VALUES: dict[str, tuple[str, tuple[int, int] | None]] = {
    "--until": ("until", None),
    "--accuracy": ("accuracy", None),
    "--samples": ("samples", (2, 10**9)),
    "--format": ("format_name", None),
    "-f": ("format_name", None),
    "--output": ("output", None),
    "-o": ("output", None),
    "--precision": ("precision", (20, 1000)),
    "--method": ("method", None),
    "--stop-when": ("stop_when", None),
}
_DIGITS = 12
LISTS = {"--set": "settings", "--show": "show"}
FLAGS = {"--project": "project", "--whole-model": "whole"}


def run_plainly(arguments: Sequence[str]) -> Status | None:
    """The exit status of `simulate` with these arguments; None where they are not plain."""
    if arguments[:1] != ["simulate"] or "_LAGCLI_COMPLETE" in os.environ:
        return None
    fields = fields_of(arguments[1:])
    if fields is None:
        return None
    from pathlib import Path

    from lagcli.cli.simulating import Wish, simulate_file

    output = fields.pop("output", None)
    return simulate_file(Wish(**fields, output=None if output is None else Path(output)))


def fields_of(arguments: Sequence[str]) -> dict[str, Any] | None:
    """Those of the wish that are given; None where the arguments are not plain."""
    fields: dict[str, Any] = {}
    rest = iter(arguments)
    for word in rest:
        found = _flag_or_file(word) or _with_value(word, next(rest, "-"), fields)
        if found is None or (found[0] in fields and word not in LISTS):
            return None
        fields[found[0]] = found[1]
    return fields if "file" in fields else None


def _flag_or_file(word: str) -> tuple[str, Any] | None:
    if word in FLAGS:
        return FLAGS[word], True
    return ("file", word) if word[:1] not in {"-", ""} else None


def _with_value(word: str, value: str, fields: dict[str, Any]) -> tuple[str, Any] | None:
    if word not in {*VALUES, *LISTS} or value[:1] in {"-", ""}:
        return None
    if word in LISTS:
        return LISTS[word], (*fields.get(LISTS[word], ()), value)
    field, between = VALUES[word]
    if between is None:
        return field, value
    least, largest = between
    if not (value.isascii() and value.isdigit() and len(value) < _DIGITS):
        return None
    if not least <= int(value) <= largest:
        return None
    return field, int(value)
