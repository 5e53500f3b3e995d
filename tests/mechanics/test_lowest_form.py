"""Equilibria whose V has no definite second derivatives: its terms of lowest degree decide."""

from __future__ import annotations

import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria

from .derived import derive


def verdict_of(V: str, more: str = ""):
    text = f"{{coordinates: [x, y], parameters: {{c: {{}}}}, T: x'^2 + x'*y' + y'^2, V: {V}{more}}}"
    found = equilibria(derive(text).dynamics).equilibria or ()
    return next(e.verdict for e in found if [to_grammar(v) for v in e.at.values()] == ["0", "0"])


def lowest_on_curves(V: str, weights: tuple[int, int]) -> float:
    """The lowest V(p s^w_1, q s^w_2)/s over directions (p, q), close to the equilibrium."""
    f = eval(f"lambda x, y: {V.replace('^', '**')}")
    source = random.Random(0)
    lowest = 1.0
    for _ in range(3000):
        p, q = source.uniform(-1, 1), source.uniform(-1, 1)
        s = 1e-6
        x, y = p * s ** (1 / weights[0]), q * s ** (1 / weights[1])
        size = max(abs(p) ** weights[0], abs(q) ** weights[1])
        lowest = min(lowest, f(x, y) / (s * size))
    return lowest


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_a_minimum_and_what_is_none_are_told_apart(seed):
    """V of random degrees, mixed terms and higher ones, against its values close by."""
    source = random.Random(seed)
    d1, d2 = source.choice([(2, 4), (4, 4), (4, 2), (6, 6), (2, 6)])
    a, b, c = source.randint(1, 3), source.randint(1, 3), source.choice([-7, -5, -1, 1, 5, 7])
    V = f"{a}*x^{d1} + {b}*y^{d2} + ({c})*x^{d1 // 2}*y^{d2 // 2} + 2*x^{d1}*y"
    told = verdict_of(V)
    assert told.stable is (lowest_on_curves(V, (d1, d2)) > 0)
    assert verdict_of(V, ", dissipation: x'^2 + y'^2").asymptotic is bool(told.stable)


@pytest.mark.parametrize("seed", range(8))
def test_curved_coordinates_in_which_V_is_a_sum_of_powers_change_nothing(seed):
    """V = b Y² + a X^d at X = 0 + ..., Y = 0 + ...: of d even and a > 0 alone a minimum."""
    source = random.Random(seed)
    a, b, d = source.choice([-2, -1, 1, 3]), source.randint(1, 3), source.choice([3, 4, 4, 6])
    p, q, r, s = (source.randint(-2, 2) for _ in range(4))
    X, Y = f"(x + ({p})*x*y)", f"(y + ({q})*x + ({r})*x^2 + ({s})*x*y)"
    told = verdict_of(f"{b}*{Y}^2 + ({a})*{X}^{d}")
    assert told.stable is (d % 2 == 0 and a > 0)


NEUTRAL = {"x^4 - x^2*y^2 + y^4": True, "x^4 - 3*x^2*y^2 + y^4": False, "x*y*z + x^4 + y^4": True}


@pytest.mark.parametrize(("more", "stable"), NEUTRAL.items())
def test_two_neutral_directions_beside_a_stiff_one(more, stable):
    """x⁴ + y⁴ + c x² y² is positive for c > -2; the last one is lowest at z = x y/2."""
    text = f"{{coordinates: [x, y, z], T: x'^2 + y'^2 + z'^2, V: (z - x*y)^2 + {more}}}"
    found = equilibria(derive(text).dynamics).equilibria or ()
    assert [e.verdict.stable for e in found if {*map(to_grammar, e.at.values())} == {"0"}] == [
        stable
    ]


@pytest.mark.parametrize("V", ["x^3 - 3*x*y^2", "x^2*y + y^4 + x^4", "x^4 - y^4", "y^2 - x^5"])
def test_what_takes_lower_values_leaves(V):
    told = verdict_of(V)
    assert told.stable is False
    assert "Kozlov" in told.reason


def test_two_degrees_without_a_minimum_are_left_open():
    """Kozlov's theorem is about one form: x⁴ - y⁶ is none, and its x⁴ is nowhere negative."""
    assert verdict_of("x^4 - y^6").stable is None


def test_gyroscopic_terms_are_no_hypothesis_of_the_theorem():
    text = "{coordinates: [x, y], L: (x'^2 + y'^2)/2 + x*y' - y*x' - x^4 + y^4}"
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    assert rest.verdict.stable is None


def test_a_sign_that_is_open_is_the_condition():
    told = verdict_of("(x^4 + y^4)/4 + c*x^2*y^2/2")
    [stable], [reversed_] = told.minimum or (), told.unstable
    assert (stable.left, stable.right) == (reversed_.right, reversed_.left)


@pytest.mark.parametrize("seed", range(4))
def test_a_quadratic_direction_of_open_sign_decides(seed):
    """V = a x⁴ + b y⁶ + c z²/2, also with friction along x alone, which takes no stability."""
    source = random.Random(seed)
    a, b = source.randint(1, 5), source.randint(1, 5)
    degree, friction = source.choice((4, 6)), source.choice(("0", "x'^2"))
    text = (
        "{coordinates: [x, y, z], parameters: {c: {}}, T: x'^2 + y'^2 + z'^2 + x'*z',"
        f" V: {a}*x^4 + {b}*y^{degree} + c*z^2/2 + x^2*y*z, dissipation: {friction}}}"
    )
    found = equilibria(derive(text).dynamics).equilibria or ()
    [told] = [e.verdict for e in found if {to_grammar(v) for v in e.at.values()} == {"0"}]
    assert [(to_grammar(e.left), to_grammar(e.right)) for e in told.minimum or ()] == [("c", "0")]
    assert told.stable is None
    assert not told.asymptotic


FRICTION = {
    "forces: {x: -x'^3 - x'*y'^2, y: -y'^5 - x'^2*y'}": True,
    "forces: {x: -abs(x')*x', y: -3*y'^3}": True,
    "forces: {x: -sqrt(1 + x^2)*x'*(x'^2 + y'^2), y: -y'*(x'^2 + y'^2)}": True,
    "forces: {x: -x'^3}": False,
    "forces: {x: -x^2*x'^3, y: -y'^3}": False,
    "forces: {x: -(x' - y')^3, y: (x' - y')^3}": False,
}


@pytest.mark.parametrize(("forces", "every"), FRICTION.items())
def test_friction_beyond_first_order_takes_energy_out_of_every_motion(forces, every):
    """Where it does, a minimum is approached (LaSalle), and what is none is left."""
    told = verdict_of("2*x^2 + x*y + y^2 + x^4", f", {forces}")
    assert told.stable
    assert told.asymptotic is every
    told = verdict_of("x^4 - y^4", f", {forces}")
    assert told.stable is (False if every else None)
    assert ("LaSalle" in told.reason) is every
    assert "Kozlov" not in told.reason
