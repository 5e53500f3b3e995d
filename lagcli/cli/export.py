"""`lagcli export`."""

from __future__ import annotations

from typing import Annotated

import typer

from lagcli.cli.choices import complete_language
from lagcli.cli.options import Output
from lagcli.cli.simulate import File, Set

To = Annotated[
    str,
    typer.Option(
        "--to",
        metavar="LANGUAGE",
        help="python, c, julia, fortran, matlab, modelica, sympy or mathematica.",
        autocompletion=complete_language,
    ),
]


def export(file: File, to: To, output: Output = None, settings: Set = None) -> int:
    """Write the equations of motion as code in another language.

    The right-hand side and its Jacobian, the mass matrix, the constraint matrices, the
    multipliers, the energy and the conserved charges, each a function of the time t, the
    state y (coordinates, then velocities) and the parameters p in the order of the file.

    \b
    Examples:
      lagcli export double-pendulum --to c -o pendulum.c
      lagcli export kepler --to julia
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.exporting import export_file

    return export_file(file, to, output, tuple(settings or ()))
