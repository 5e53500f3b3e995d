"""Power series in machine code of 80 bits."""

from __future__ import annotations

from lagcli.numerics.certified.machine_code import prepared_extended
from lagcli.numerics.certified.method_entry import MethodEntry

METHOD = MethodEntry(
    name="taylor80",
    place=20,
    order=None,
    properties=("explicit", "smooth", "compiled"),
    reason="power series in machine code of 80 bits: the accuracy lies within the "
    "rounding of doubles",
    prepare=prepared_extended,
)
