"""What JSON is made of, and the version of the contract about its keys."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

#: The version of the contract.
SCHEMA = 1

Value = None | bool | int | str | Sequence["Value"] | Mapping[str, "Value"]
Object = dict[str, Value]
