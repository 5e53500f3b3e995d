"""Options that several commands have."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lagcli.cli.choices import complete_study
from lagcli.cli.files import STANDARD


def _to_file(output: Path | None) -> Path | None:
    """None for standard output, which is also called `-`."""
    return None if output is None or str(output) == STANDARD else output


Output = Annotated[
    Path | None,
    typer.Option(
        "--output", "-o", metavar="PATH", help="Write to a file instead.", callback=_to_file
    ),
]
State = Annotated[
    list[str] | None,
    typer.Option(
        "--at", metavar="X=VALUE", help='Begin with another coordinate or velocity: --at "x\'=1".'
    ),
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
    str | None,
    typer.Option(
        "--format",
        "-f",
        metavar="NAME",
        help="text, json or csv.  [default: by the ending of -o, else text]",
        autocompletion=complete_study,
    ),
]
