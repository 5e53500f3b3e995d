"""A derivation as a teacher writes it: steps of sentences and displayed formulas.

Every formula is a plain tree of `lagcli.expression`, taken from the derivation itself.
"""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.document import Block
from lagcli.record import field, record


@record
class ExplanationStep:
    """One step: what it is about, and what is said there."""

    title: str
    blocks: tuple[Block, ...]


@record(kw_only=True)
class Explanation:
    """Everything that `lagcli explain` has to say of one file.

    `symbols` gives LaTeX for names whose file sets `symbol`.  `complete` is False where the
    motion was not solved: exit status 1.
    """

    title: str
    coordinates: tuple[str, ...]
    parameters: tuple[str, ...]
    degrees_of_freedom: int
    steps: tuple[ExplanationStep, ...]
    symbols: Mapping[str, str] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    complete: bool = True
