"""Power series in machine code, in doubles."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.numerics.certified.prepared import Prepared
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.setup import Setup


def _prepare(simulation: Setup, modes: Modes) -> Prepared | str:
    from lagcli.numerics.certified.machine_code import prepared_doubles

    return prepared_doubles(simulation, modes)


METHOD = MethodEntry(
    name="taylor64",
    place=10,
    order=None,
    properties=("explicit", "smooth", "compiled"),
    reason="power series in machine code: the cheapest of any order where it is compiled",
    prepare=_prepare,
)
