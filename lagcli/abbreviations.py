"""Abbreviations written out: the answers with every name replaced by what it stands for."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.answers import Answers
from lagcli.expression import Expression, Name, children, postorder
from lagcli.record import replace
from lagcli.rewriting import rebuilt, rewritten

#: Operations beyond which a formula is not written out: it would fill some thirty pages.
MOST_OPERATIONS = 100_000


def written_out(answers: Answers) -> Answers:
    """The answers without abbreviations; with them and a warning where that would fill books."""
    if not answers.where:
        return answers
    sizes: dict[str, int] = {}
    for name, node in answers.where.items():
        sizes[name] = _size(node, sizes)
    total = 0

    def count(node: Expression) -> Expression:
        nonlocal total
        total += _size(node, sizes)
        return node

    rewritten(answers.sections, count)
    if total > MOST_OPERATIONS:
        sentence = f"written out, the formulas would show {total:,} operations: abbreviated"
        return replace(answers, warnings=(*answers.warnings, sentence))
    whole: dict[str, Expression] = {}
    for name, node in answers.where.items():
        whole[name] = _put_in(node, whole)
    sections = rewritten(answers.sections, lambda node: _put_in(node, whole))
    return replace(answers, sections=sections, where={})


def _size(node: Expression, sizes: Mapping[str, int]) -> int:
    """The operations of a formula that is written out."""
    return sum(
        sizes.get(part.name, 0) if isinstance(part, Name) else max(len(children(part)) - 1, 1)
        for part in postorder(node)
    )


def _put_in(node: Expression, whole: Mapping[str, Expression]) -> Expression:
    if isinstance(node, Name) and not node.primes and node.name in whole:
        return whole[node.name]
    return rebuilt(node, lambda part: _put_in(part, whole))
