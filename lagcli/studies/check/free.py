"""Comparisons of functions in which coordinates, momenta, constants and t are free.

Two such functions agree when they agree everywhere.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

from lagcli.expression import Name, Number, Power, sum_of
from lagcli.mechanics.derivation import Derivation
from lagcli.problem_data import Parameter, Problem
from lagcli.reader.shapes import CONSTANT_NAMES
from lagcli.studies.check.comparison import Comparison


def of_phase_space(problem: Problem) -> Comparison:
    """Of functions of the old and the new variables of a file."""
    old = [q.name for q in problem.coordinates]
    taken = {*old, *(p.name for p in problem.parameters), *problem.functions}
    names = dict.fromkeys(f"p_{name}" for name in old)
    for each in problem.canonical_transformations:
        for name in each.coordinates:
            names.update({name: None, f"p_{name}": None})
    return _free(problem, [name for name in names if name not in taken])


def of_reductions(problem: Problem) -> Comparison:
    """Of functions of the momenta and of the constants that answers name."""
    declared = {q.name for q in (*problem.coordinates, *problem.parameters)} | {*problem.functions}
    momenta = [f"p_{q.name}" for q in problem.coordinates]
    return _free(problem, [*momenta, *(n for n in CONSTANT_NAMES if n not in declared)])


def _free(problem: Problem, names: Iterable[str]) -> Comparison:
    """The comparisons of a system of the same names, and more, whose motion is free."""
    two = Number(Fraction(2))
    squares = [Power(Name(q.name, 1), two) for q in problem.coordinates]
    return Comparison(
        Derivation(
            Problem(
                source=problem.source,
                title=problem.title,
                coordinates=problem.coordinates,
                parameters=(*problem.parameters, *(Parameter(name=n) for n in names)),
                functions=problem.functions,
                definitions=problem.definitions,
                lagrangian=sum_of(squares),
            )
        )
    )
