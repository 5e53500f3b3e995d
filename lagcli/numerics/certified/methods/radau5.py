"""Radau IIA of order 5."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry, without_switches
from lagcli.numerics.certified.prepared import Prepared, in_doubles
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup


def _prepare(setup: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.integrators.radau5 import radau5

    return without_switches(setup) or in_doubles(radau5, setup, modes)


METHOD = MethodEntry(
    name="radau5",
    place=60,
    order=5,
    properties=("implicit", "stiff"),
    reason="implicit, of order 5: something dies away so quickly that explicit methods "
    "would need more steps than it costs",
    prepare=_prepare,
)
