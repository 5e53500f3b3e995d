"""The options of `solve` and `explain` that pick and change sections, with all mistakes at once."""

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
class SectionOptions:
    """A request, and sentences on whatever is wrong with it."""

    request: Request
    mistakes: tuple[str, ...]


def read_section_options(
    show: Sequence[str],
    settings: Sequence[str],
    *,
    numeric: bool,
    expand: bool = False,
    named: bool = False,
    mistakes: list[str],
    option: str = "--show",
    known: Known = in_order,
) -> SectionOptions:
    """Read the options; a mistake in one hides none in another, nor those already found."""
    sections = _sections(show, mistakes, option, known)
    request = Request(
        sections=sections,
        settings=tuple(settings),
        numeric=numeric,
        expand=expand,
        abbreviate=not expand,
        named=named and not (expand or numeric),
    )
    return SectionOptions(request, tuple(mistakes))


def _sections(
    show: Sequence[str], mistakes: list[str], option: str, known: Known
) -> tuple[str, ...] | None:
    if not show:
        return None
    names = [word.strip() for words in show for word in words.split(",")]
    picked = [each.name for each in known(names)]
    mistakes += [f"{option}: {_unknown(name, known)}" for name in names if name not in picked]
    return tuple(picked)


def _unknown(name: str, known: Known) -> str:
    try:
        section = find_section(name)
    except BrokenSection as broken:
        return str(broken)
    except LookupError:
        section = None
    every = known(None)
    names = [each.name for each in every]
    if section is not None and name not in names:
        in_all = "what applies of it is in every explanation"
        return f"'{name}' is not added, {in_all}: there are {', '.join(names)}"
    plural = f"did you mean '{name}s'?" if f"{name}s" in names else ""
    advice = plural or _headed(name, every) or did_you_mean(name, names) or _topic(name)
    return f"unknown section '{name}': {advice or 'there are ' + ', '.join(names)}"


def _initials(heading: str) -> str:
    """`eom` for Equations of motion."""
    return "".join(each[0] for each in heading.casefold().split())


def _headed(word: str, sections: Sequence[Declaration]) -> str:
    """The section whose heading has the words or their initials, first one that begins so."""
    wanted = word.casefold().replace("_", " ")
    held = [one for one in sections if wanted in {one.heading.casefold(), _initials(one.heading)}]
    held = held or [one for one in sections if wanted in one.heading.casefold()]
    held.sort(key=lambda one: not one.heading.casefold().startswith(wanted))
    return f"'{held[0].heading}' is the section {held[0].name}" if held and len(word) > 2 else ""


def _topic(word: str) -> str:
    """The page of the manual about a word that is a topic of it."""
    from lagcli.manual import find_page

    return f"see lagcli help {word}" if find_page(word) else ""
