"""What was asked for on the command line, with all of its mistakes at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from lagcli.answers import SECTIONS
from lagcli.diagnostics import ProblemError
from lagcli.expression import Expression, Name
from lagcli.formatters.registry import UnknownFormatter, find_formatter
from lagcli.pipeline import Request
from lagcli.reader import parse_text
from lagcli.reader.suggest import did_you_mean


@dataclass(frozen=True, slots=True)
class Asked:
    """A request, and sentences on whatever is wrong with it."""

    request: Request
    mistakes: tuple[str, ...]


def asked(
    format_name: str, show: Sequence[str], settings: Sequence[str], *, numeric: bool
) -> Asked:
    """Read the options; a mistake in one hides none in another."""
    mistakes: list[str] = []
    formatter = find_formatter(format_name)
    if isinstance(formatter, UnknownFormatter):
        mistakes.append(f"--format: {formatter.message}")
    request = Request(
        sections=_sections(show, mistakes), values=_values(settings, mistakes), numeric=numeric
    )
    return Asked(request, tuple(mistakes))


def _sections(show: Sequence[str], mistakes: list[str]) -> tuple[str, ...] | None:
    if not show:
        return None
    names = [word.strip() for words in show for word in words.split(",")]
    for name in names:
        if name not in SECTIONS:
            advice = did_you_mean(name, SECTIONS) or f"there are {', '.join(SECTIONS)}"
            mistakes.append(f"--show: unknown section '{name}': {advice}")
    return tuple(name for name in SECTIONS if name in names)


def _values(settings: Sequence[str], mistakes: list[str]) -> dict[str, Expression]:
    values: dict[str, Expression] = {}
    for setting in settings:
        word, equals, text = setting.partition("=")
        if not (equals and word.strip() and text.strip()):
            mistakes.append(f"--set: '{setting}' is not of the form name=value")
            continue
        name = _parsed(word, setting, mistakes)
        value = _parsed(text, setting, mistakes)
        if name is None or value is None:
            continue
        if not isinstance(name, Name) or name.primes:
            mistakes.append(f"--set: '{word.strip()}' in '{setting}' is not a parameter's name")
        elif name.name in values:
            mistakes.append(f"--set: '{name.name}' is given twice")
        else:
            values[name.name] = value
    return values


def _parsed(text: str, setting: str, mistakes: list[str]) -> Expression | None:
    try:
        return parse_text(text.strip(), "--set")
    except ProblemError as error:
        said = "; ".join(
            d.message + (f" ({d.hint})" if d.hint else "") for d in error.diagnostics
        )
        mistakes.append(f"--set: in '{setting}': {said}")
        return None
