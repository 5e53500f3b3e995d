"""Gauss-Legendre of order 8."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry, without_switches
from lagcli.numerics.certified.prepared import Prepared, in_doubles
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup


def _prepare(setup: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.gauss8 import gauss8

    return without_switches(setup) or in_doubles(gauss8, setup, modes)


METHOD = MethodEntry(
    name="gauss8",
    place=70,
    order=8,
    properties=("implicit", "symplectic", "fixed step"),
    reason="implicit, symplectic, of order 8: keeps charges for long times",
    prepare=_prepare,
)
