"""Yoshida's composition of order 8."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry, without_switches
from lagcli.numerics.certified.prepared import Prepared, in_doubles
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup


def _prepare(setup: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.yoshida8 import separates, yoshida8

    if not separates(setup.equations) or setup.contacts:
        return "it does not separate: it needs a constant M, forces of q and t, no constraints"
    return without_switches(setup) or in_doubles(yoshida8, setup, modes)


METHOD = MethodEntry(
    name="yoshida8",
    place=80,
    order=8,
    properties=("explicit", "symplectic", "fixed step"),
    reason="explicit, symplectic, of order 8: keeps charges for long times",
    prepare=_prepare,
)
