"""The note that says where a root is real says it for what can be worked out there."""

from __future__ import annotations

import operator
import random

import pytest
import sympy

from lagcli.mechanics.finding.remarks import real_where

a, b = sympy.symbols("a b", positive=True)
c, d = sympy.symbols("c d", real=True)
_COMPARE = {" < ": operator.lt, " ≤ ": operator.le, " ≠ ": operator.ne}
_SIZES = (0, sympy.Rational(1, 2), 1, 2)


def holds(remark, values):
    """Whether `real for x < y, u ≠ v` holds: parts are words and formulas in turn."""
    sides = [part for part in remark if not isinstance(part, str) or part in _COMPARE]
    said = []
    while sides:
        left, how, right, *sides = sides
        left, right = (sympy.sympify(e).subs(values) for e in (left, right))
        said.append(_COMPARE[how](left, right))
    return all(map(bool, said))


@pytest.mark.parametrize("seed", range(30))
def test_a_root_is_real_and_finite_just_where_the_note_says_so(seed):
    source = random.Random(seed)
    forms = [a - b, a * b - c, a + d, c - a, a**2 - b, c * a + b * d]
    over, under = source.sample(forms, 2)
    root = source.choice(
        [
            sympy.sqrt(a / under),
            a / sympy.sqrt(under),
            sympy.sqrt(over / under),
            b * sympy.sqrt(over) / under,
        ]
    )
    remarks = list(real_where([root]))
    assert remarks
    for _ in range(40):
        values = {s: source.choice(_SIZES[1:]) for s in (a, b)}
        values |= {s: source.choice(_SIZES) * source.choice([1, -1]) for s in (c, d)}
        if under.subs(values) == 0 and (
            over.subs(values) == 0 or root == b * sympy.sqrt(over) / under
        ):
            continue  # 0/0, or a divisor of the formula itself, which is said elsewhere
        value = root.subs(values)
        assert bool(value.is_real and value.is_finite) is all(holds(r, values) for r in remarks)


def test_what_is_real_everywhere_is_not_remarked():
    """sqrt(c² + a d²/b): squares over what is positive."""
    assert not list(real_where([sympy.sqrt(c**2 + a * d**2 / b)]))
