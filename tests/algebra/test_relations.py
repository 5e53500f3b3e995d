"""Relations are solved and substituted, or reduce what they can."""

from __future__ import annotations

import sympy as sp
from sympy import Expr, Symbol, cos, sin

from lagcli.algebra import Relations, is_zero, shape, simplify
from lagcli.algebra.entry import Field
from lagcli.formatters.grammar import to_grammar

R, R1, R2, length, m, g = (Symbol(n, positive=True) for n in "R R1 R2 l m g".split())
x, y, r, theta = (Symbol(n, real=True) for n in "x y r theta".split())
dx, dy, dr, dtheta = (Symbol(n + "'", real=True) for n in "x y r theta".split())


def test_rolling_is_solved_for_the_coordinate_that_leaves_no_fraction() -> None:
    relations = Relations([x - R * theta, dx - R * dtheta])
    assert relations.solved == {x: R * theta, dx: R * dtheta}
    assert relations.remaining == []
    assert relations.substitute(dx**2) == R**2 * dtheta**2


def test_a_velocity_is_solved_for_where_its_slope_is_the_denominator_of_the_relation() -> None:
    rho = sp.sqrt(x**2 + r**2)  # on the cone y = rho; its derivative has no value where rho = 0
    relations = Relations([y - rho, dy - (x * dx + r * dr) / rho], moving=[x, y, r, dx, dy, dr])
    assert relations.remaining == []
    assert sp.simplify(relations.solved[dy] - (x * dx + r * dr) / rho) == 0


def test_a_constant_distance_is_solved_for() -> None:
    assert Relations([r - R1 - R2, dr]).solved == {r: R1 + R2, dr: 0}


def test_a_chain_of_solutions_is_resolved() -> None:
    relations = Relations([y - x, x - R * theta, dy - dx, dx - R * dtheta])
    assert relations.substitute(y + dy) == R * theta + R * dtheta


def test_preferred_symbols_come_first() -> None:
    assert Relations([x + y - length], eliminate=[x, y]).solved == {x: length - y}
    assert Relations([x + y - length], eliminate=[y, x]).solved == {y: length - x}


def circle() -> Relations:
    return Relations([x**2 + y**2 - length**2, x * dx + y * dy])


def test_a_circle_shortens_denominators() -> None:
    assert simplify(m / (x**2 + y**2), circle()) == m / length**2
    assert simplify((x**2 + y**2) ** 2 + 3 * length**4, circle()) == 4 * length**4


def test_membership_in_the_ideal_is_exact() -> None:
    relations = circle()
    assert is_zero(x**2 + y**2 - length**2, relations) is True
    assert is_zero(dx * length**2 - dx * y**2 + x * y * dy, relations) is True
    assert is_zero(x, relations) is not True


def test_relations_through_angles() -> None:
    relations = Relations([x - length * sin(theta), y + length * cos(theta), dx, dy])
    assert is_zero(x**2 + y**2 - length**2, relations) is True


def test_the_pendulum_in_cartesian_coordinates() -> None:
    """x'' = −x (v² − g y)/l², the constraint being x² + y² = l²."""
    value: Expr = -x * (dx**2 + dy**2 - g * y) / (x**2 + y**2)
    text = to_grammar(shape(value, "m g l t x y".split(), circle()))
    assert text == "-x*(x'^2 + y'^2 - g*y)/l^2"


def test_contradictions_and_nothing_are_harmless() -> None:
    assert not Relations([])
    assert not Relations([sp.S.Zero])
    assert simplify(x + 1, Relations([x - x])) == x + 1


def test_a_velocity_is_read_instead_of_its_solution() -> None:
    """x'' = -2 W y'/7 of the ball on a turntable: no textbook prints the solution for y'."""
    w, u, a, b = (Symbol(n, real=True) for n in "W u a b".split())
    relations = Relations([dy + R * (u * cos(a) + b) - w * x], [dy], moving=[x, dy, u, a, b])
    assert simplify(-2 * w * dy / 7, relations) == -2 * w * dy / 7


def test_a_single_velocity_is_not_read_instead_of_another() -> None:
    spin = Symbol("phi'", real=True)
    relations = Relations([(R1 + R2) * dtheta - R2 * spin], [spin], moving=[dtheta, spin])
    assert simplify(R2 * spin * dtheta, relations) == (R1 + R2) * dtheta**2


def test_an_ideal_outlives_the_ring_that_grows() -> None:
    field = Field([x, y, length])
    relations = Relations([x**2 + y**2 - length**2])
    poly = field(x**2 + y**2).numerator
    assert relations.shorter(field, poly) == field(length**2).numerator
    before = field.ring.capacity
    field(sum(Symbol(f"u{k}", real=True) for k in range(2 * before)))
    assert field.ring.capacity > before
    u = Symbol("u0", real=True)
    shorter = relations.shorter(field, field((x**2 + y**2) * u).numerator)
    assert field.polynomial_to_sympy(shorter) == length**2 * u
