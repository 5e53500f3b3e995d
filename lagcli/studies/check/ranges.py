"""The ranges of a parameter that are expected against those that were found."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.verify import conjunction
from lagcli.problem_data import Inequality
from lagcli.statements.questions import Range

Equal = Callable[[Expression, Expression], bool | None]


def same_ranges(
    found: Sequence[Range], expected: Sequence[Sequence[Inequality]], equal: Equal
) -> bool | None:
    """Whether they are the same ranges in the same order, with the same ends included."""
    if len(found) != len(expected):
        return False
    pairs = zip(found, expected, strict=True)
    return conjunction(_same(one.bounds, other, equal) for one, other in pairs)


def _same(
    found: Sequence[tuple[str, Expression]], expected: Sequence[Inequality], equal: Equal
) -> bool | None:
    if [comparison for comparison, _ in found] != [each.comparison for each in expected]:
        return False
    pairs = zip(found, expected, strict=True)
    return conjunction(equal(bound, each.right) for (_, bound), each in pairs)


def in_words(bounds: Sequence[Sequence[tuple[str, Expression]]]) -> str:
    """The ranges in words."""
    texts = [" and ".join(f"{how} {to_grammar(bound)}" for how, bound in each) for each in bounds]
    return ", or ".join(text or "any value" for text in texts) or "no value"
