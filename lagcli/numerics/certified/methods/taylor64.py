"""Power series in machine code, in doubles."""

from __future__ import annotations

from lagcli.numerics.certified.machine_code import prepared_doubles
from lagcli.numerics.certified.method_entry import MethodEntry

METHOD = MethodEntry(
    name="taylor64",
    place=10,
    order=None,
    properties=("explicit", "smooth", "compiled"),
    reason="power series in machine code: the cheapest of any order where it is compiled",
    prepare=prepared_doubles,
)
