"""Inequalities in words."""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.document import Formula
from lagcli.expression import ZERO
from lagcli.motions import Above


def conditions(where: Sequence[Above]) -> list[str | Formula]:
    """Inequalities within a sentence."""
    parts: list[str | Formula] = []
    for position, each in enumerate(where):
        sides: list[str | Formula] = (
            [each.right, " < ", each.left] if each.left == ZERO else [each.left, " > ", each.right]
        )
        parts += [" and " if position else "", *sides]
    return parts
