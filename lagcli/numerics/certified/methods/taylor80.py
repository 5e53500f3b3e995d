"""Power series in machine code of 80 bits."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.numerics.certified.prepared import Prepared
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup


def _prepare(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_extended

    return prepared_extended(simulation, modes)


METHOD = MethodEntry(
    name="taylor80",
    place=20,
    order=None,
    properties=("explicit", "smooth", "compiled"),
    reason="power series in machine code of 80 bits: the accuracy lies within the "
    "rounding of doubles",
    prepare=_prepare,
)
