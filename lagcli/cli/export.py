"""`lagcli export`."""

from __future__ import annotations

from typing import Annotated

import typer

from lagcli.cli.choices import LANGUAGES
from lagcli.cli.options import Output, option
from lagcli.cli.simulate import File, Set

To = Annotated[
    str | None,
    option(
        "--to",
        "LANGUAGE",
        "python, c, julia, fortran, matlab, modelica, sympy or mathematica.  "
        "[default: by the ending of -o]",
        LANGUAGES,
    ),
]


def export(file: File, to: To = None, output: Output = None, settings: Set = None) -> int:
    """Write the equations of motion as code in another language.

    The right-hand side and its Jacobian, the mass matrix, the constraint matrices, the
    multipliers, the energy and the conserved charges, each a function of the time t, the
    state y (coordinates, then velocities) and the parameters p in the order of the file.

    \b
    Examples:
      lagcli export double-pendulum -o pendulum.c
      lagcli export kepler --to julia
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import format_of
    from lagcli.cli.exporting import export_file
    from lagcli.export import LANGUAGES

    # of the two that write .py, the first
    endings = {ending: name for name, (ending, _) in reversed(LANGUAGES.items())}
    language = format_of(to, output, endings, "", "--to")
    if not language:
        raise typer.BadParameter(f"give one of {', '.join(LANGUAGES)}", param_hint="--to")
    return export_file(file, language, output, tuple(settings or ()))
