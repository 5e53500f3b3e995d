"""Two roots of a quadratic equation are one formula with ±, whatever its coefficients."""

from __future__ import annotations

import random

import pytest
from sympy import Symbol, sqrt

from lagcli.algebra.conjugate_roots import with_number_turned, written_alike
from lagcli.algebra.equations import solve_for
from lagcli.expression import PlusMinus, walk
from lagcli.statements.plus_minus import single
from tests.mechanics.formulas import normal

E, k, m, p = (Symbol(n, positive=True) for n in "E k m p".split())
r = Symbol("r", positive=True)


@pytest.mark.parametrize("seed", range(12))
def test_a_quadratic_has_one_formula(seed):
    source = random.Random(seed)
    a, b, c = (
        source.choice((1, -1, 2)) * source.choice(given)
        for given in ((E, m * E, 1 / m), (k, k * m, 2 * k / E), (p**2 / m, p**2 - E, E + k))
    )
    found = solve_for(a * r**2 + b * r + c, r)
    assert found is not None
    trees = written_alike(found.values, ["m", "k", "p", "E"])
    [both] = single(trees)
    assert any(isinstance(node, PlusMinus) for node in walk(both))
    values = {m: 2, k: 7, p: 3, E: 5}
    for root, tree in zip(found.values, trees, strict=True):
        assert abs(complex(root.subs(values)) - complex(normal(tree).subs(values))) < 1e-12


def test_roots_of_different_equations_stay_apart():
    trees = written_alike([k + sqrt(m), k - sqrt(p), m], ["k", "m", "p"])
    assert len(single(trees)) == 3


@pytest.mark.parametrize("number", [2, 3, 5])
def test_roots_within_which_a_number_stands_do_not_turn_into_each_other(number):
    """Of the sqrt(2) of sqrt(2 m) no sign can be changed alone; of 2 ± sqrt(2) it can."""
    inside = sqrt(number * m) * p
    pair = sqrt(k + m - 2 * inside), sqrt(k + m + 2 * inside)
    assert with_number_turned(*pair, ["m", "k", "p", "E"]) is None
    apart = sqrt(m + 7 * k - sqrt(number) * k), sqrt(m + 7 * k + sqrt(number) * k)
    one, other = with_number_turned(*apart, ["m", "k", "p", "E"])
    values = {m: 2, k: 7, p: 3, E: 5}
    for tree, root in zip((one, other), apart, strict=True):
        assert abs(float(normal(tree).subs(values)) - float(root.subs(values))) < 1e-12
