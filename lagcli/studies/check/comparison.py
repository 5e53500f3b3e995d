"""When two answers are the same: as mathematics on the constraints."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property

import mpmath
from mpmath import mpf
from sympy import Expr

from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.expression import Expression, Negative, Number
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.states import Contradiction, RandomStates
from lagcli.problem_data import Parameter, Problem
from lagcli.rewriting import substituted
from lagcli.values import with_values_of

_STATES = 5
_EQUAL = mpf(10) ** -(DIGITS - 15)


class Comparison:
    """Comparisons of answers for one problem: each True, False, or None when undecided."""

    def __init__(self, derivation: Derivation) -> None:
        self.derivation = derivation
        self.build = derivation.system.build
        self.verifier = derivation.dynamics.verifier

    def equal(self, a: Expression, b: Expression) -> bool | None:
        """Whether a = b wherever the constraints hold."""
        return self.vanishes(self.build(a) - self.build(b))

    def vanishes(self, formula: Expr) -> bool | None:
        """Whether a formula is 0 wherever the constraints hold."""
        return self.verifier.is_zero(formula).holds

    def same_set(self, found: Sequence[Expression], expected: Sequence[Expression]) -> bool | None:
        """Whether each of either list has its own equal in the other."""
        if len(found) != len(expected):
            return False
        left = list(found)
        undecided = False
        for one in expected:
            verdicts = [self.equal(one, other) for other in left]
            if True in verdicts:
                del left[verdicts.index(True)]
            elif None in verdicts:
                undecided = True
            else:
                return False
        return None if undecided else True

    # -- charges -----------------------------------------------------------------------

    def same_charge(self, found: Expression, expected: Expression) -> bool | None:
        """Whether expected = c * found + d, with c (not 0) and d constant.

        Both are evaluated at several states with the same parameters: two states give c
        and d, the others decide.
        """
        if self.equal(found, expected) is True:
            return True
        try:
            pairs = self._values_at_states(found, expected)
        except (ArithmeticError, ValueError, TypeError, Contradiction):
            return None
        with mpmath.workdps(DIGITS):
            return _is_affine(pairs)

    @cached_property
    def _numbers(self) -> Derivation:
        """The same system with numbers in place of its parameters."""
        return Derivation(_with_numbers(self.derivation.problem))

    def _values_at_states(self, a: Expression, b: Expression) -> list[tuple[mpf, mpf]]:
        system = self._numbers.system
        dynamics = self._numbers.dynamics
        values = _some_values(self.derivation.problem.parameters)
        one, other = substituted((a, b), values)
        evaluate = Evaluator([system.build(one), system.build(other)], DIGITS + 10)
        states = RandomStates(system, dynamics.constraints)
        pairs = []
        for count in range(1, 4 * _STATES):
            first, second = evaluate(states.take(count)[-1])
            if isinstance(first, mpf) and isinstance(second, mpf):
                pairs.append((first, second))
            if len(pairs) == _STATES:
                return pairs
        raise ValueError("too few states at which both charges are real")


def _is_affine(pairs: Sequence[tuple[mpf, mpf]]) -> bool:
    """Whether all pairs (a, b) lie on one line b = c a + d that is neither level nor steep."""
    (a0, b0), *others = pairs
    scale = max(abs(x) for pair in pairs for x in pair) + 1
    a1, b1 = max(others, key=lambda pair: abs(pair[0] - a0))
    if abs(a1 - a0) <= _EQUAL * scale:  # found is a constant; is expected?
        return all(abs(b - b0) <= _EQUAL * scale for _, b in others)
    c = (b1 - b0) / (a1 - a0)
    if abs(c) <= _EQUAL:
        return False
    return all(abs(b - b0 - c * (a - a0)) <= _EQUAL * scale * (1 + abs(c)) for a, b in others)


def _some_values(parameters: Sequence[Parameter]) -> dict[str, Expression]:
    """A number for each parameter, of the sign that is assumed, no two alike."""
    values: dict[str, Expression] = {}
    for place, parameter in enumerate(parameters):
        size = Fraction(place + 2) if parameter.integer else Fraction(1009 + 137 * place, 907)
        number = Number(size)
        values[parameter.name] = Negative(number) if parameter.assume == "negative" else number
    return values


def _with_numbers(problem: Problem) -> Problem:
    values = _some_values(problem.parameters)
    numbered, mistakes = with_values_of(problem.with_values(values).bare, values)
    if mistakes:
        raise ValueError(mistakes[0].message)
    return numbered
