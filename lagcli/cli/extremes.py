"""`lagcli extremes`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.options import Output, State, StudyFormat, gathered, option
from lagcli.cli.simulate import Accuracy, File, Set

Until = Annotated[
    str | None,
    option(
        "--until",
        "T",
        "The longest span of a run.  [default: the file's; short where it moves quickly]",
    ),
]
Cases = Annotated[
    str | None,
    option(
        "--cases",
        "A,B,C",
        "Only these: given, ratios, angles, singular, separatrix, light, zero, spans, or "
        "names with * for anything.  [default: all]",
    ),
]
Limit = Annotated[float, option("--limit", "SECONDS", "Processor time of one case.", min=0.1)]


def extremes(
    file: File,
    until: Until = None,
    settings: Set = None,
    state: State = None,
    cases: Cases = None,
    accuracy: Accuracy = None,
    limit: Limit = 10.0,
    format_name: StudyFormat = None,
    output: Output = None,
) -> int:
    """Take a problem to where it breaks.

    The cases follow from the problem: ratios of its parameters, angles near 0, pi/2 and pi,
    zeros of the mass matrix, the energy of an unstable equilibrium, the speed of light, zero
    masses and forces, a long span.  Each is reported with the digits that the printed formulas
    lose in doubles, before and after they are rewritten, the condition of the mass matrix, and
    the outcome of a certified run, confirmed with more digits.

    The exit status is 0 when every case is right or refused with its reason; 1 when one is
    wrong or undecided; 2 when the command line or the file is wrong.

    \b
    Examples:
      lagcli extremes plane-pendulum
      lagcli extremes kepler --cases 'k = 0' -f csv
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.endings import STUDIES, format_of
    from lagcli.cli.extremes_run import ExtremesOptions, stretch_file

    form = format_of(format_name, output, STUDIES, "text")
    return stretch_file(gathered(ExtremesOptions, locals(), format_name=form))
