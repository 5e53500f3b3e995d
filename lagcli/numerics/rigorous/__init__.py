"""Validated integration: enclosures in which the exact motion of the exact problem lies."""

from __future__ import annotations

from lagcli.numerics.rigorous.proof import Proof, prove

__all__ = ["Proof", "prove"]
