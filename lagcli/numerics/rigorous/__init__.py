"""Validated integration: enclosures in which the exact motion of the exact problem lies."""

from __future__ import annotations

from lagcli.numerics.rigorous.proof import prove
from lagcli.numerics.rigorous.result import Proof
from lagcli.numerics.rigorous.shadowing import Shadowing

__all__ = ["Proof", "Shadowing", "prove"]
