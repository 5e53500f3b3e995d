"""`lagcli show`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.choices import problems
from lagcli.cli.options import argument

Name = Annotated[str, argument("NAME", "See: lagcli list.", problems)]


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
