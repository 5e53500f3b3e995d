"""Warnings of angles that are meant in degrees: sin(30), a value or a state of 45 inside a sine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import partial

from lagcli.diagnostics import Diagnostic
from lagcli.expression import Call, Expression, Name, Negative, name_nodes, terms_of, walk
from lagcli.problem_data import Problem
from lagcli.reader.constants import rational_value

_CIRCULAR = frozenset("sin cos tan cot sec csc".split())
_LEAST = 10  # degrees; 2 π is 6.3
_MOST = 720
_warning = partial(Diagnostic, severity="warning")


def degrees_meant(problem: Problem, known: Mapping[str, Fraction]) -> Iterator[Diagnostic]:
    """A warning for each; `known` are the rational values of the parameters."""
    formulas = [*_formulas(problem)]
    waves = [
        node
        for formula in formulas
        for node in walk(formula)
        if isinstance(node, Call) and node.function in _CIRCULAR and len(node.arguments) == 1
    ]
    for node in waves:
        number = rational_value(node.arguments[0], {})
        if number is not None and _is_degrees(number):
            message = f"{node.function}({number}) is that of {number} radians"
            hint = f"angles are in radians: write {node.function}({number}*pi/180)"
            yield _warning(message, node.span, hint)
    parts = [term for node in waves for term in terms_of(node.arguments[0])]
    plain = [part.operand if isinstance(part, Negative) else part for part in parts]
    inside = [part.name for part in plain if isinstance(part, Name) and not part.primes]
    all_names = [node.name for node in name_nodes(*formulas) if not node.primes]
    angles = {name for name in inside if inside.count(name) == all_names.count(name)}
    values = {p.name: p.value for p in problem.parameters if p.value is not None}
    values |= {x.name: value for x, value in problem.initial.items() if not x.primes}
    for name, value in values.items():
        number = rational_value(value, known)
        if name in angles and number is not None and _is_degrees(number):
            hint = f"angles are in radians: write {number}*pi/180"
            yield _warning(f"the angle '{name}' is {number} radians", value.span, hint)


def _is_degrees(number: Fraction) -> bool:
    """Whether it is a number of degrees as people give it: 22.5, 30, -90."""
    return _LEAST <= abs(number) <= _MOST and number % Fraction(5, 2) == 0


def _formulas(problem: Problem) -> Iterator[Expression]:
    yield from (*problem.formulas, *problem.forces.values())
    equations = [one.equation for one in problem.constraints]
    for equation in (*equations, *(one.equation for one in problem.contacts)):
        yield from (equation.left, equation.right)
    for point in problem.points:
        yield from point.force or ()
