"""Power series with any number of digits."""

from __future__ import annotations

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.numerics.certified.precise import prepared

METHOD = MethodEntry(
    name="taylor",
    place=40,
    order=None,
    properties=("explicit", "smooth", "any precision"),
    reason="power series with more digits than doubles: the accuracy lies within their rounding",
    prepare=prepared,
)
