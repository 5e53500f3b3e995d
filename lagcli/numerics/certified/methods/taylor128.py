"""Power series in machine code of 128 bits."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.numerics.certified.prepared import Prepared
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup


def _prepare(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_quadruple

    return prepared_quadruple(simulation, modes)


METHOD = MethodEntry(
    name="taylor128",
    place=30,
    order=None,
    properties=("explicit", "smooth", "compiled"),
    reason="power series in machine code of 128 bits: the accuracy lies within the "
    "rounding of 80 bits",
    prepare=_prepare,
)
