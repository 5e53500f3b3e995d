"""`lagcli diff`."""

from __future__ import annotations

from typing import Annotated

from lagcli.cli.options import argument

Old = Annotated[str, argument("OLD", "A problem, or its name in the library.")]
New = Annotated[str, argument("NEW", "Another one.")]


def diff(old: Old, new: New) -> int:
    """Say whether two files mean the same physics.

    They do with the same coordinates, accelerations, constraints and multipliers at every
    state; formulas may have another shape, Lagrangians may differ by a total derivative.
    Values of parameters and the initial state are compared as well.

    The exit status is 0 when they mean the same, 1 when something differs or was not
    decided, and 2 when a file is wrong.

    Example: lagcli diff before.yaml after.yaml
    """
    from lagcli.cli.comparing import compare_files

    return compare_files(old, new)
