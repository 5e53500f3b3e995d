"""Formatters by name: the built-in ones, and those that other packages bring.

All of them are entry points of the group `lagcli.formatters`.  A built-in name is
resolved without looking at what is installed: that is quick, and nobody else can take it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, cast

from lagcli.formatters.options import Formatter
from lagcli.record import record

if TYPE_CHECKING:
    from collections.abc import Iterable
    from importlib.metadata import EntryPoint

GROUP = "lagcli.formatters"

#: The built-in formatters in the order in which they are listed, each with what it says
#: of itself: the list imports none of them.
BUILT_IN: dict[str, str] = {
    "text": "Aligned equations for reading in a terminal.",
    "json": "JSON for machines: a stable contract.",
    "latex": r"LaTeX with amsmath: a fragment for \input, or a whole document.",
    "markdown": "Markdown for GitHub and Pandoc, with LaTeX in $$ blocks.",
    "html": "HTML with MathML: a fragment, or a whole page.",
}


@record
class UnknownFormatter:
    """A name that no formatter has, or whose plug-in does not load."""

    name: str
    message: str
    suggestion: str | None = None


@record
class ListedFormatter:
    """One line of the list; `problem` says why a plug-in cannot be used."""

    name: str
    distribution: str
    description: str
    problem: str | None = None


def find_formatter(name: str) -> Formatter | UnknownFormatter:
    """Find the formatter of that name; only its own module is imported."""
    if name in BUILT_IN:
        return cast(Formatter, import_module(f"lagcli.formatters.{name}").render)
    plug_ins = [point for point in _plug_ins() if point.name == name]
    if plug_ins:
        return _loaded(plug_ins[0])
    return _unknown(name)


def list_formatters() -> tuple[ListedFormatter, ...]:
    """List every formatter with its origin and what it says of itself."""
    built_in = [ListedFormatter(name, "lagcli", told) for name, told in BUILT_IN.items()]
    others: list[ListedFormatter] = []
    for point in _plug_ins():
        origin = point.dist.name if point.dist else "unknown"
        taken = point.name in BUILT_IN or any(point.name == other.name for other in others)
        if taken:
            problem = f"the name {point.name!r} is taken"
            others.append(ListedFormatter(point.name, origin, "", problem))
        else:
            others.append(_listed(point.name, origin, _loaded(point)))
    return (*built_in, *others)


def entry_points(*, group: str) -> Iterable[EntryPoint]:
    """The entry points of a group; the scanner costs half of typer to import."""
    from importlib.metadata import entry_points as installed

    return installed(group=group)


def _plug_ins() -> list[EntryPoint]:
    """Scan for the formatters of other packages, by name and then by package."""
    points = [point for point in entry_points(group=GROUP) if not _ours(point)]
    return sorted(points, key=lambda point: (point.name, point.dist.name if point.dist else ""))


def _ours(point: EntryPoint) -> bool:
    return point.name in BUILT_IN and point.value == f"{__package__}.{point.name}:render"


def _loaded(point: EntryPoint) -> Formatter | UnknownFormatter:
    try:
        loaded = point.load()
    except Exception as error:  # noqa: BLE001 - whatever a plug-in does wrong is reported
        problem = f"formatter {point.name!r} does not load: {type(error).__name__}: {error}"
        return UnknownFormatter(point.name, problem)
    if not callable(loaded):
        return UnknownFormatter(point.name, f"formatter {point.name!r} is not a function")
    return cast(Formatter, loaded)


def _listed(name: str, origin: str, found: Formatter | UnknownFormatter) -> ListedFormatter:
    if isinstance(found, UnknownFormatter):
        return ListedFormatter(name, origin, "", found.message)
    description = (found.__doc__ or "").strip().partition("\n")[0]
    return ListedFormatter(name, origin, description)


def _unknown(name: str) -> UnknownFormatter:
    known = [*BUILT_IN, *(point.name for point in _plug_ins())]
    from difflib import get_close_matches

    close = get_close_matches(name.lower(), known, n=1)
    message = f"unknown format {name!r}"
    if close:
        return UnknownFormatter(name, f"{message}: did you mean {close[0]!r}?", close[0])
    return UnknownFormatter(name, f"{message}: there are {', '.join(known)}")
