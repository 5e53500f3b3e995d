"""Two roots of a quadratic equation are one formula with ±, whatever its coefficients."""

from __future__ import annotations

import random

import pytest
from sympy import Symbol, sqrt

from lagcli.algebra.conjugate_roots import written_alike
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
