"""Answers as they are derived, and with one formula made wrong."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from lagcli import load
from lagcli.expression import Expression, Number, Product, Sum
from lagcli.pipeline import _statements as statements
from lagcli.pipeline import derive
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.rewriting import rewritten
from lagcli.statements.answers import Answers

LIBRARY = Path(__file__).parents[2] / "problems"


def derived(name: str, sections: Sequence[str] | None) -> tuple[Problem, Answers]:
    """A problem of the library and what is derived from it, not yet verified."""
    derivation = derive(load(LIBRARY / f"{name}.yaml"))
    return derivation.problem, statements(derivation).answers(sections)


def count(answers: Answers, section: str) -> int:
    """The number of formulas in a section."""
    seen: list[Expression] = []
    rewritten(answers.sections[section], lambda each: seen.append(each) or each)
    return len(seen)


def spoiled(answers: Answers, section: str, place: int) -> Answers:
    """The answers with one formula of a section changed: 7/5 of it, plus 1/1000."""
    places = iter(range(10_000))

    def change(node: Expression) -> Expression:
        if next(places) != place:
            return node
        return Sum((Product((number(7, 5), node)), number(1, 1000)))

    parts = {**answers.sections, section: rewritten(answers.sections[section], change)}
    return replace(answers, sections=parts)


def number(above: int, below: int) -> Number:
    """A rational number."""
    from fractions import Fraction

    return Number(Fraction(above, below))


def each_spoiled(answers: Answers, section: str) -> Iterator[tuple[int, Answers]]:
    """Every formula of a section changed in its turn."""
    for place in range(count(answers, section)):
        yield place, spoiled(answers, section, place)
