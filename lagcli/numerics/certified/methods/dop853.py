"""DOP853 of Dormand and Prince."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.numerics.certified.prepared import Prepared, in_doubles
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup

#: Steps err by far less than such a tolerance.
_ROUNDED = 1e-14


def _prepare(setup: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.dop853 import dop853

    return in_doubles(dop853, setup, modes, _ROUNDED)


METHOD = MethodEntry(
    name="dop853",
    place=50,
    order=8,
    properties=("explicit",),
    reason="explicit, of order 8: the cheapest that reaches the accuracy without stiffness",
    prepare=_prepare,
)
