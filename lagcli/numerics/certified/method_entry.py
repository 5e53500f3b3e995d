"""A method as it is known before any problem."""

from __future__ import annotations

from collections.abc import Callable

from lagcli.numerics.certified.prepared import Prepared
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup
from lagcli.record import record

#: Makes a method ready, or says why it is not for this problem.
Prepare = Callable[[Setup, Modes], Prepared | str]


@record(kw_only=True)
class MethodEntry:
    """A method as it is known before any problem.

    Attributes
    ----------
    name
        That of `--method`, and of the module that declares it.
    place
        In the order in which methods are listed.
    order
        Of its global error in the step; None where it follows from the tolerance.
    properties : tuple of str
        Out of explicit, implicit, stiff, symplectic, fixed step, smooth (needs analytic
        equations), compiled, any precision.
    reason
        What it is taken for.
    prepare : Prepare
        Makes it ready.
    """

    name: str
    place: int
    order: int | None
    properties: tuple[str, ...]
    reason: str
    prepare: Prepare


def without_switches(setup: Setup) -> str:
    """Why a method that does not stop at switching functions is not for this problem, or ""."""
    return (
        "it does not stop at the zeros of switching functions (abs, sign)"
        if setup.equations.kinks
        else ""
    )
