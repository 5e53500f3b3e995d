"""What was asked for on the command line, with all of its mistakes at once."""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.answers import SECTIONS
from lagcli.pipeline import Request
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record


@record
class Asked:
    """A request, and sentences on whatever is wrong with it."""

    request: Request
    mistakes: tuple[str, ...]


def asked(
    show: Sequence[str], settings: Sequence[str], *, numeric: bool, mistakes: list[str]
) -> Asked:
    """Read the options; a mistake in one hides none in another, nor those already found."""
    request = Request(sections=_sections(show, mistakes), settings=tuple(settings), numeric=numeric)
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
