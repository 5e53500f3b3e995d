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
    show: Sequence[str],
    settings: Sequence[str],
    *,
    numeric: bool,
    expand: bool = False,
    mistakes: list[str],
    option: str = "--show",
    known: Sequence[str] = SECTIONS,
) -> Asked:
    """Read the options; a mistake in one hides none in another, nor those already found."""
    sections = _sections(show, mistakes, option, known)
    request = Request(
        sections=sections,
        settings=tuple(settings),
        numeric=numeric,
        expand=expand,
        abbreviate=not expand,
    )
    return Asked(request, tuple(mistakes))


def _sections(
    show: Sequence[str], mistakes: list[str], option: str, known: Sequence[str]
) -> tuple[str, ...] | None:
    if not show:
        return None
    names = [word.strip() for words in show for word in words.split(",")]
    for name in names:
        if name not in known:
            advice = did_you_mean(name, known) or f"there are {', '.join(known)}"
            mistakes.append(f"{option}: unknown section '{name}': {advice}")
    return tuple(name for name in known if name in names)
