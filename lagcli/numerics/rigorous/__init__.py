"""Validated integration: enclosures in which the exact motion of the exact problem lies."""

from __future__ import annotations

from lagcli.numerics.rigorous.proof import Proof, prove
from lagcli.numerics.rigorous.shadowing import Shadowing

__all__ = ["Proof", "Shadowing", "prove"]
