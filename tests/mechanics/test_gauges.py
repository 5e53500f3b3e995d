"""Whether a boundary term exists is decided, whatever its antiderivative; random families.

L has terms that are total derivatives, transported along symmetries of the rest.  The gauge
that is printed is checked against the action: dG/dt along a random path is d/de of
L(q + e Dq, q' + e d(Dq)/dt, t), by finite differences.
"""

from __future__ import annotations

import random
import re

import mpmath
import pytest
from mpmath import mpf

from lagcli.algebra import shape
from lagcli.algebra.build import TIME
from lagcli.algebra.numeric import Evaluator
from lagcli.formatters.grammar import to_grammar
from lagcli.reader import parse_text

from .derived import charge, derive, same

FREE = "m*(x'^2 + y'^2)/2"
SHIFTS = ("{x: 1}", "{y: 1}", "{x: 2, y: -1}", "{x: -y, y: x}", "{x: t}", "{x: 1 + t, y: -2*t}")
#: F of the term dF/dt of L.
POTENTIALS = (
    "exp(-x^2)", "x*exp(-x^2)", "x*sin(y^2)", "cos(x)/(1 + y^2)", "log(1 + x^2*y^2)", "U(x)*y",
    "x^3*y/(1 + x^2 + y^2)", "atan(x*y)*x", "sqrt(1 + x^2)*y", "exp(x*y)*cos(t)", "W(x, y)",
    "t^2*U(x*y)", "tanh(x)/(2 + cos(y))",
)  # fmt: skip
#: g of a term whose change under the translation along y has no elementary gauge.
WITHOUT_ANTIDERIVATIVE = (
    "exp(-x^2)",
    "sin(x^2)",
    "U(x)",
    "x*U(x)",
    "exp(-x^2)*U(x)",
    "1/(1 + U(x)^2)",
)


def _problem(lagrangian: str, change: str):
    return derive(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}}\n"
        "functions: {U: [s], W: [a, b]}\n"
        f'L: "{lagrangian}"\nsymmetries: {{s: {change}}}'
    )


def gauge_is_right(d, found) -> bool:
    system = d.system
    printed = system.build(parse_text(to_grammar(shape(found.gauge, system.order))))
    G, L = Evaluator([printed], 30), Evaluator([system.L], 30)
    changes = Evaluator([*found.transformation.changes], 30)
    rates_of_changes = Evaluator([*map(system.total_derivative, found.transformation.changes)], 30)
    path = [lambda t: mpf("0.4") + t / 3 - t**2 / 5, lambda t: mpf("0.7") - t / 4 + t**3 / 3]
    speed = [lambda t: mpf(1) / 3 - 2 * t / 5, lambda t: t**2 - mpf(1) / 4]
    still = {p: mpf("1.3") for p in system.parameters}

    names = (*system.q, *system.qdot, TIME)

    def at(t):
        return {**still, **dict(zip(names, [f(t) for f in (*path, *speed)] + [t], strict=True))}

    def action(t, e):
        state = at(t)
        by = [*changes(state), *rates_of_changes(state), 0]
        return L(state | {x: state[x] + e * d for x, d in zip(names, by, strict=True)})[0]

    def gauge(t):
        return G(at(t))[0]

    with mpmath.workdps(30):
        t = mpf("0.6")
        by_action = mpmath.diff(lambda e: action(t, e), 0)
        return abs(mpmath.diff(gauge, t) - by_action) < mpf(10) ** -8 * (1 + abs(by_action))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(14))
def test_a_total_derivative_in_l_breaks_no_symmetry(seed):
    source = random.Random(seed)
    F = " + ".join(source.sample(POTENTIALS, source.choice((1, 1, 2))))
    d = derive(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}}\n"
        "functions: {U: [s], W: [a, b]}\n"
        f'definitions: {{F: "{F}"}}\n'
        f'L: "{FREE} + F\'"\nsymmetries: {{s: {source.choice(SHIFTS)}}}'
    )
    found = charge(d, "s")
    assert found.conserved is True
    assert found.gauge is not None
    assert gauge_is_right(d, found)


@pytest.mark.long
@pytest.mark.parametrize("g", WITHOUT_ANTIDERIVATIVE)
def test_a_gauge_that_is_not_elementary_is_an_integral(g):
    of_t, of_y = (re.sub(r"\bx\b", name, g) for name in ("t", "y"))
    for lagrangian, change in (
        (f"{FREE} + y*({g})*x'", "{y: 1}"),
        (f"{FREE} + y*({of_t})", "{y: 1}"),
        (f"{FREE} + (y - x)*({g})*x' + t*({of_y})*y'", "{x: 1, y: 1}"),
    ):
        d = _problem(lagrangian, change)
        found = charge(d, "s")
        if change == "{y: 1}":
            assert found.conserved is True
            assert gauge_is_right(d, found)
        else:  # dK is not 0
            assert found.conserved is False


@pytest.mark.long
def test_a_closed_form_in_two_variables_without_antiderivative_is_integrated_along_a_path():
    """K = d/dt of the integral of exp(-s^2) U(s) from 0 to x + y."""
    g = "exp(-(x + y)^2)*U(x + y)"
    d = _problem(f"{FREE} + (x - y)*({g})*(x' + y')/2", "{x: 1, y: -1}")
    found = charge(d, "s")
    assert found.conserved is True
    assert gauge_is_right(d, found)


@pytest.mark.parametrize("field", ["x'*exp(-y^2)", "x^2*y'", "U(x)*y'", "x'*sin(x*y)"])
def test_a_magnetic_field_that_varies_breaks_the_translation(field):
    d = _problem(f"{FREE} + {field}", "{x: 1, y: 1}")
    assert charge(d, "s").conserved is False


def test_the_gauge_of_a_rational_transformation():
    """The square of the plane: z^2/2 moves freely, and 1/z is a translation of it."""
    d = _problem(
        "m*((x*x' - y*y')^2 + (x*y' + y*x')^2)/2 + x'*x^3",
        "{x: y/(x^2 + y^2), y: x/(x^2 + y^2)}",
    )
    found = charge(d, "s")
    assert found.conserved is True
    assert gauge_is_right(d, found)


def test_an_answer_with_an_integral_can_be_expected():
    derive(
        "coordinates: [x]\nfunctions: {f: [t]}\nL: x'^2/2 + x*f(t)\nsymmetries: {s: {x: 1}}\n"
        'expect: {charges: {s: "x\' - integral(f(t), t, 0, t)"}}'
    )


@pytest.mark.parametrize("change", ["{x: 1, z: y}", "{x: y, z: y^2}", "{x: 1 + y, z: y + y^2}"])
def test_a_change_that_is_quadratic_in_the_allowed_velocities_has_no_gauge(change):
    """On z' = y x' the change is m (… x' y'), which is no dG(q, t)/dt."""
    d = derive(
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}}\n"
        "T: m*(x'^2 + y'^2 + z'^2)/2\nconstraints: {c: z' = y*x'}\n"
        f"symmetries: {{s: {change}}}"
    )
    assert charge(d, "s").conserved is False


@pytest.mark.parametrize("seed", range(4))
def test_a_force_that_jumps_has_no_boundary_term(seed):
    """L = x'²/2 - F |u|, u = x - a: K = -F sign(u) of dx = 1 is no dG/dt, as G has no x in it."""
    source = random.Random(f"kink {seed}")
    a, F = source.randint(-9, 9), source.choice(["2", "F", "F/3"])
    u, side = (f"x - ({a})", 1) if seed % 2 else (f"3*x + 2*y - ({a})", 3)
    d = derive(
        "{coordinates: [x, y], parameters: {F: {assume: positive}}, "
        f'T: "(x\'^2 + y\'^2)/2", V: "{F}*abs({u})", '
        "symmetries: {shift: {x: 1}, boost: {x: t}, along: {x: 2, y: -3}}}"
    )
    rates = {"shift": f"-{side}*{F}*sign({u})", "boost": f"x' - {side}*{F}*t*sign({u})"}
    for name, rate in rates.items():
        found = charge(d, name)
        assert found.conserved is False
        assert same(d, found.rate, rate)
    assert charge(d, "along").conserved is (seed % 2 == 0)
