"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, TypeVar

import typer

from lagcli.cli.choices import STUDIES
from lagcli.cli.files import STANDARD

Wish = TypeVar("Wish")

#: Words that the shell completes, or what looks them up.
Names = tuple[str, ...] | Callable[[], Iterable[str]]


def _to_file(output: Path | None) -> Path | None:
    """None for standard output, which is also called `-`."""
    return None if output is None or str(output) == STANDARD else output


def gathered(options: type[Wish], given: Mapping[str, Any], **others: Any) -> Wish:
    """The options of a command, from its parameters of the same names; without one, its default."""
    fields = (name for kind in options.__mro__ for name in vars(kind).get("__annotations__", ()))
    values = {name: given[name] for name in fields if given.get(name) is not None}
    lists = {name: tuple(value) for name, value in values.items() if isinstance(value, list)}
    return options(**values | lists | others)


def argument(metavar: str, text: str, names: Names = ()) -> Any:
    """What is given without a name, one of these."""
    return typer.Argument(metavar=metavar, help=text, autocompletion=_completion(names))


def flag(name: str, text: str) -> Any:
    """What is set or not."""
    return typer.Option(name, help=text)


def option(option_names: str, metavar: str, text: str, names: Names = (), **more: Any) -> Any:
    """What takes a value, one of these names, or several with commas."""
    completion = _completion(names, listed="," in metavar)
    return typer.Option(
        *option_names.split(), metavar=metavar, help=text, autocompletion=completion, **more
    )


def _completion(names: Names, *, listed: bool = False) -> Callable[[str], list[str]] | None:
    """What the shell asks: the names that begin so; `listed`: the last word of `a,b,c`."""

    def complete(incomplete: str) -> list[str]:
        before, comma, word = incomplete.rpartition(",") if listed else ("", "", incomplete)
        known = names() if callable(names) else names
        return [before + comma + name for name in known if name.startswith(word)]

    return complete if names else None


#: The end of the help of an option `--format` whose file says it as well.
BY_ENDING = "  [default: by the ending of -o, else {}]"
Jobs = Annotated[int | None, option("--jobs -j", "N", "Processes.  [default: one per core]", min=1)]
Output = Annotated[
    Path | None, option("--output -o", "PATH", "Write to a file instead.", callback=_to_file)
]
State = Annotated[
    list[str] | None, option("--at", "X=VALUE", 'Begin elsewhere or faster: --at "x\'=1".')
]
Latex = Annotated[
    list[str] | None,
    option(
        "--latex",
        "A,B",
        "Of LaTeX and PDF: labels or labels=PREFIX, equation (instead of align), varphi, "
        "varepsilon, vartheta, varrho, varpi, varsigma.",
    ),
]
WithMotion = Annotated[
    bool, flag("--with-motion", "Of HTML: plot and animation, where the file has an end.")
]
StudyFormat = Annotated[
    str | None,
    option("--format -f", "NAME", "text, json or csv." + BY_ENDING.format("text"), STUDIES),
]
