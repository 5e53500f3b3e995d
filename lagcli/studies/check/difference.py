"""Whether two problem files mean the same physics.

They do where they have the same coordinates, the same accelerations and the same constraint
forces at every state, and the same constraints.  Lagrangians may differ by a total derivative,
and formulas by their shape.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal

from lagcli.expression import Expression, Negative, Sum
from lagcli.mechanics.derivation import Derivation
from lagcli.pipeline import Request, derive, state
from lagcli.problem_data import Problem
from lagcli.record import record
from lagcli.studies.check.comparison import Comparison

Verdict = Literal["differs", "undecided"]


@record
class Difference:
    """One thing that is not the same in both files, or was not decided.

    Attributes
    ----------
    subject : str
        Such as `accelerations.x`.
    old, new : str
        What the two files say; empty where one says nothing.
    verdict : str
    """

    subject: str
    old: str
    new: str
    verdict: Verdict = "differs"


_SECTIONS = ("accelerations", "multipliers", "constraint_forces")


def differences(old: Problem, new: Problem) -> list[Difference]:
    """What differs between two problems, names first.

    Raises
    ------
    ProblemError
        When the constraints of one of them cannot be used.
    """
    found = list(_names(old, new))
    if found:
        return found
    first, second = derive(old), derive(new)
    before, after = (state(each, Request(sections=_SECTIONS)) for each in (first, second))
    comparison = Comparison(second)
    found += _constraints(first, second)
    found += _formulas(before.sections, after.sections, comparison)
    return found or list(_numbers(old, new))


def _names(old: Problem, new: Problem) -> Iterator[Difference]:
    for subject, take in (
        ("coordinates", lambda p: {one.name: one.assume for one in p.coordinates}),
        ("parameters", lambda p: {one.name: one.assume for one in p.parameters}),
        ("constraints", lambda p: dict.fromkeys((one.name for one in p.constraints), "given")),
        ("contacts", lambda p: dict.fromkeys((one.name for one in p.contacts), "given")),
    ):
        before, after = take(old), take(new)
        for name in sorted({*before, *after}):
            if before.get(name) != after.get(name):
                yield Difference(f"{subject}.{name}", before.get(name, ""), after.get(name, ""))


def _constraints(first: Derivation, second: Derivation) -> Iterator[Difference]:
    """Each holonomic constraint of either must hold where those of the other do."""
    for a, b in ((first, second), (second, first)):
        comparison = Comparison(b)
        for one in a.problem.constraints:
            formula = Sum((one.equation.left, Negative(one.equation.right)))
            verdict = _decided(lambda f=formula, c=comparison: c.vanishes(c.build(f)))
            if verdict is not True:
                written = _equation(one.equation)
                other = {each.name: each for each in b.problem.constraints}[one.name]
                pair = (written, _equation(other.equation))
                old, new = pair if a is first else pair[::-1]
                kind: Verdict = "undecided" if verdict is None else "differs"
                yield Difference(f"constraints.{one.name}", old, new, kind)
                return


def _formulas(before: Any, after: Any, comparison: Comparison) -> Iterator[Difference]:
    pairs = [("accelerations", before["accelerations"].accelerations,
              after["accelerations"].accelerations),
             ("multipliers", _values(before), _values(after))]  # fmt: skip
    for subject, one, other in pairs:
        if one is None or other is None:
            if one is not other:
                yield Difference(subject, _there(one), _there(other), "undecided")
            continue
        for name, formula in one.items():
            yield from _formula(f"{subject}.{name}", formula, other.get(name), comparison)


def _formula(
    subject: str, old: Expression | None, new: Expression | None, comparison: Comparison
) -> Iterator[Difference]:
    from lagcli.formatters.grammar import to_grammar

    if old is None or new is None:
        if old is not new:
            yield Difference(subject, _there(old), _there(new), "undecided")
        return
    verdict = _decided(lambda: comparison.equal(old, new))
    if verdict is not True:
        kind: Verdict = "undecided" if verdict is None else "differs"
        yield Difference(subject, to_grammar(old), to_grammar(new), kind)


def _numbers(old: Problem, new: Problem) -> Iterator[Difference]:
    """Values and the initial state, where the formulas are the same."""
    for subject, take in (
        ("parameters", lambda p: {one.name: one.value for one in p.parameters}),
        ("initial", lambda p: {str(name): value for name, value in p.initial.items()}),
    ):
        before, after = take(old), take(new)
        for name in sorted({*before, *after}):
            one, other = before.get(name), after.get(name)
            if one != other:
                yield Difference(f"{subject}.{name}", _written(old, one), _written(new, other))


def _written(problem: Problem, value: Expression | None) -> str:
    """A value as the file has it."""
    if value is None:
        return ""
    place = value.span
    lines = problem.source.text.splitlines()[max(0, place.line - 1) : place.line]
    return "".join(line[place.column - 1 : place.end_column - 1] for line in lines)


def _decided(question: Any) -> bool | None:
    try:
        answer: bool | None = question()
    except (ArithmeticError, ValueError, KeyError, TypeError):
        return None
    return answer


def _values(sections: Any) -> dict[str, Expression | None]:
    return {name: one.value for name, one in sections["multipliers"].multipliers.items()}


def _there(value: object) -> str:
    return "" if value is None else "found"


def _equation(equation: Any) -> str:
    from lagcli.formatters.grammar import equation_to_grammar

    return equation_to_grammar(equation)
