"""Power series in machine code of 128 bits."""

from __future__ import annotations

from lagcli.numerics.certified.machine_code import prepared_quadruple
from lagcli.numerics.certified.method_entry import MethodEntry

METHOD = MethodEntry(
    name="taylor128",
    place=30,
    order=None,
    properties=("explicit", "smooth", "compiled"),
    reason="power series in machine code of 128 bits: the accuracy lies within the "
    "rounding of 80 bits",
    prepare=prepared_quadruple,
)
