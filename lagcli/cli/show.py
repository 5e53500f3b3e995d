"""`lagcli show`."""

from __future__ import annotations

from typing import Annotated

import typer

from lagcli.cli.choices import complete_problem

Name = Annotated[
    str,
    typer.Argument(metavar="NAME", help="See: lagcli list.", autocompletion=complete_problem),
]


def show(name: Name) -> int:
    """Print the file of a problem of the library, to read or to change.

    \b
    Examples:
      lagcli show kepler
      lagcli show kepler > mine.yaml
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.error_output import report_line
    from lagcli.cli.files import print_result, reason
    from lagcli.cli.status import Status
    from lagcli.library import NotInLibrary, find_problem

    try:
        print_result(find_problem(name).read_bytes())
    except NotInLibrary as error:
        report_line(f"{name}: error: {reason(error)}")
        return Status.USAGE
    return Status.WELL
