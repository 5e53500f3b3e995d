"""`lagcli list`."""

from __future__ import annotations

import sys
from shutil import get_terminal_size
from typing import Annotated

from lagcli.cli.options import argument

Words = Annotated[list[str] | None, argument("[WORD...]", "Only problems with these words.")]


def list(words: Words = None) -> int:  # noqa: A001 - the command's name
    """List the problems of the library that comes with lagcli.

    A word may stand in the name of a problem, its folder or its title.

    \b
    Examples:
      lagcli list
      lagcli list pendulum rod
    """  # noqa: D301 - click reads the control character \b
    from lagcli.cli.error_output import report_line
    from lagcli.cli.status import Status
    from lagcli.library import entries

    wanted = [word.casefold() for word in words or ()]
    named = [(entry.name, entry.title) for entry in entries()]
    found = [
        (name, title)
        for name, title in named
        if all(word in f"{name} {title}".casefold() for word in wanted)
    ]
    if not found:
        report_line(f"no problem of the library has: {' '.join(words or ())}")
        return Status.NOT_FOUND
    width = max(len(name) for name, _ in found)
    most = get_terminal_size().columns if sys.stdout.isatty() else sys.maxsize
    for name, title in found:
        line = f"{name:{width}}  {title}"
        sys.stdout.write(line if len(line) <= most else f"{line[: most - 1]}…")
        sys.stdout.write("\n")
    return Status.WELL
