"""A function that has one sign is 0 only at its extrema, and all zeros are found there."""

from __future__ import annotations

import random

import pytest
import sympy

from lagcli.algebra.systems import solve_system

x, y, z = sympy.symbols("x y z", real=True)


@pytest.mark.parametrize("seed", range(12))
def test_a_force_towards_a_point_that_grows_with_a_power_vanishes_there_alone(seed):
    """F = grad Q^n with a definite Q of the displacement: made from a triangular matrix."""
    source = random.Random(seed)
    unknowns = (x, y, z)[: source.choice([2, 3])]
    place = {u: sympy.Rational(source.randint(-4, 4), source.choice([1, 2])) for u in unknowns}
    left = sympy.Integer(0)
    for i, u in enumerate(unknowns):
        row = (u - place[u]) * source.randint(1, 3)
        row += sum(source.randint(-2, 2) * (v - place[v]) for v in unknowns[i + 1 :])
        left += source.randint(1, 3) * row**2
    power = source.choice([1, 2])
    forces = [sympy.expand(sympy.diff(left ** (power + 1), u)) for u in unknowns]
    found = solve_system(forces, unknowns)
    assert found.complete
    assert [solution.values for solution in found.solutions] == [place]


def test_what_changes_its_sign_is_not_taken_for_an_extremum():
    """A circle, a hyperbola and a line that is counted twice have more than one point."""
    for equation in (x**2 + y**2 - 1, x**2 - 3 * y**2 + 1):
        found = solve_system([equation], (x, y))
        assert not found.complete or any(len(s.values) < 2 for s in found.solutions)
    [double] = solve_system([sympy.expand((x - 2 * y) ** 2)], (x, y)).solutions
    assert double.values == {x: 2 * y}


def test_waves_that_add_up_to_their_greatest_value():
    found = solve_system([2 - sympy.cos(x) - sympy.cos(y)], (x, y))
    assert found.complete
    assert [solution.values for solution in found.solutions] == [{x: 0, y: 0}]
