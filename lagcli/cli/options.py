"""Options that several commands have."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, TypeVar

import typer

from lagcli.cli.choices import complete_study
from lagcli.cli.files import STANDARD

Wish = TypeVar("Wish")


def _to_file(output: Path | None) -> Path | None:
    """None for standard output, which is also called `-`."""
    return None if output is None or str(output) == STANDARD else output


def gathered(options: type[Wish], given: Mapping[str, Any], **others: Any) -> Wish:
    """The options of a command, from its parameters of the same names; without one, its default."""
    fields = (name for kind in options.__mro__ for name in vars(kind).get("__annotations__", ()))
    values = {name: given[name] for name in fields if given.get(name) is not None}
    lists = {name: tuple(value) for name, value in values.items() if isinstance(value, list)}
    return options(**values | lists | others)


def format_option(names: str, complete: Callable[[str], list[str]]) -> Any:
    """`--format`, one of these names."""
    return typer.Option("--format", "-f", metavar="NAME", help=names, autocompletion=complete)


def samples_option(what: str, most: int = 1_000_000) -> Any:
    """`--samples`, the number of these."""
    return typer.Option("--samples", metavar="N", min=2, max=most, help=what)


def limit_option(of_what: str) -> Any:
    """`--limit`, the processor time of one part of a study."""
    return typer.Option("--limit", metavar="SECONDS", min=0.1, help=f"Processor time of {of_what}.")


#: The end of the help of an option `--format` whose file says it as well.
BY_ENDING = "  [default: by the ending of -o, else {}]"
Jobs = Annotated[
    int | None,
    typer.Option("--jobs", "-j", metavar="N", min=1, help="Processes.  [default: one per core]"),
]
Output = Annotated[
    Path | None,
    typer.Option(
        "--output", "-o", metavar="PATH", help="Write to a file instead.", callback=_to_file
    ),
]
State = Annotated[
    list[str] | None,
    typer.Option("--at", metavar="X=VALUE", help='Begin elsewhere or faster: --at "x\'=1".'),
]
Latex = Annotated[
    list[str] | None,
    typer.Option(
        "--latex",
        metavar="A,B",
        help="Of LaTeX and PDF: labels or labels=PREFIX, equation (instead of align), varphi, "
        "varepsilon, vartheta, varrho, varpi, varsigma.",
    ),
]
WithMotion = Annotated[
    bool,
    typer.Option("--with-motion", help="Of HTML: plot and animation, where the file has an end."),
]
StudyFormat = Annotated[
    str | None, format_option("text, json or csv." + BY_ENDING.format("text"), complete_study)
]
