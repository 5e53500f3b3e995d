"""Formatters by name: the built-in ones, and those that other packages bring.

A built-in formatter is a module of `lagcli.formatters.built_in`; another package declares one as
an entry point of the group `lagcli.formatters`.  A built-in name is resolved without looking at
what is installed: that is quick, and nobody else can take it.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from lagcli.formatters.options import Formatter
from lagcli.platform.plug_ins import plug_ins
from lagcli.platform.rooms import modules_in
from lagcli.record import record

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "lagcli.formatters"

_FOLDER = Path(__file__).parent / "built_in"


@record
class UnknownFormatter:
    """A name that no formatter has, or whose plug-in does not load."""

    name: str
    message: str


@record
class ListedFormatter:
    """One line of the list; `problem` says why a plug-in cannot be used."""

    name: str
    distribution: str
    description: str
    problem: str | None = None


@cache
def built_in() -> tuple[str, ...]:
    """The names of the built-in formatters; nothing of them is imported."""
    return tuple(modules_in(_FOLDER))


def _built_in(name: str) -> Formatter:
    return cast(Formatter, import_module(f"{GROUP}.built_in.{name}").render)


def find_formatter(name: str) -> Formatter | UnknownFormatter:
    """Find the formatter of that name; only its own module is imported."""
    if name in built_in():
        return _built_in(name)
    for point in plug_ins(GROUP):
        if point.name == name:
            return _loaded(point)
    return _unknown(name)


def list_formatters() -> tuple[ListedFormatter, ...]:
    """List every formatter with its origin and what it says of itself."""
    ours = [_listed(name, "lagcli", _built_in(name)) for name in built_in()]
    others: list[ListedFormatter] = []
    for point in plug_ins(GROUP):
        origin = point.dist.name if point.dist else "unknown"
        taken = point.name in built_in() or any(point.name == other.name for other in others)
        if taken:
            problem = f"the name {point.name!r} is taken"
            others.append(ListedFormatter(point.name, origin, "", problem))
        else:
            others.append(_listed(point.name, origin, _loaded(point)))
    return (*ours, *others)


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


#: Formats by what they are called elsewhere.
_OTHER_NAMES = {
    "latex": "tex amsmath mathjax",
    "text": "txt plain ascii unicode pretty console",
    "markdown": "md github",
    "html": "htm web mathml xhtml",
    "json": "js",
}


def _unknown(name: str) -> UnknownFormatter:
    known = [*built_in(), *(point.name for point in plug_ins(GROUP))]
    from difflib import get_close_matches

    close = [x for x, words in _OTHER_NAMES.items() if name.lower() in words.split()]
    close = close or get_close_matches(name.lower(), known, n=1)
    message = f"unknown format {name!r}"
    if close:
        return UnknownFormatter(name, f"{message}: did you mean {close[0]!r}?")
    return UnknownFormatter(name, f"{message}: there are {', '.join(known)}")
