"""What was asked for on the command line, with all of its mistakes at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from lagcli.pipeline import Request
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record
from lagcli.statements.declaration import Declaration
from lagcli.statements.registry import BrokenSection, find_section, in_order

#: Picks the sections of these names (all of them), in order.
Known = Callable[[Iterable[str] | None], list[Declaration]]


@record
class AskedSections:
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
    known: Known = in_order,
) -> AskedSections:
    """Read the options; a mistake in one hides none in another, nor those already found."""
    sections = _sections(show, mistakes, option, known)
    request = Request(
        sections=sections,
        settings=tuple(settings),
        numeric=numeric,
        expand=expand,
        abbreviate=not expand,
    )
    return AskedSections(request, tuple(mistakes))


def _sections(
    show: Sequence[str],
    mistakes: list[str],
    option: str,
    known: Known,
) -> tuple[str, ...] | None:
    if not show:
        return None
    names = [word.strip() for words in show for word in words.split(",")]
    picked = [each.name for each in known(names)]
    mistakes += [f"{option}: {_unknown(name, known)}" for name in names if name not in picked]
    return tuple(picked)


def _unknown(name: str, known: Known) -> str:
    try:
        find_section(name)
    except BrokenSection as broken:
        return str(broken)
    except LookupError:
        pass
    every = [each.name for each in known(None)]
    advice = did_you_mean(name, every) or f"there are {', '.join(every)}"
    return f"unknown section '{name}': {advice}"
