"""The forced motion of linear equations with a drive.

Landau, Lifshitz, *Mechanics*, 3rd ed., sections 22 and 26.
"""

from __future__ import annotations

import random

import pytest
import sympy

from lagcli.mechanics.oscillations.forced import amplitude, forced
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

T = sympy.Symbol("t", real=True)
DRIVES = ["cos(w*t)", "sin(w*t) + 2", "exp(-w*t)", "t^2 - t", "exp(-w*t)*cos(2*t)", "t + sin(3*t)"]


def _text(n, m, c, k, drives):
    """M = diag(m), damping and stiffness matrices c and k, a drive of each coordinate."""
    q = [f"x{j}" for j in range(n)]
    pairs = [(i, j) for i in range(n) for j in range(n)]
    kinetic = " + ".join(f"{m[j]}*{q[j]}'^2/2" for j in range(n))
    V = " + ".join(f"({k[i][j]})*{q[i]}*{q[j]}/2" for i, j in pairs)
    D = " + ".join(f"({c[i][j]})*{q[i]}'*{q[j]}'/2" for i, j in pairs)
    forces = ", ".join(f"{x}: {drive}" for x, drive in zip(q, drives, strict=True))
    return (
        f"{{coordinates: [{', '.join(q)}], parameters: {{w: {{assume: positive}}}}, "
        f"T: {kinetic}, V: {V}, dissipation: {D}, forces: {{{forces}}}}}"
    )


def _symmetric(given, n, low, high):
    a = [[given.randint(low, high) for _ in range(n)] for _ in range(n)]
    return [[a[i][j] + a[j][i] + 4 * n * (i == j) for j in range(n)] for i in range(n)]


@pytest.mark.parametrize("seed", range(6))
def test_it_solves_the_equations_of_random_driven_chains(seed):
    """M x'' + C x' + K x = F(t), with the matrices of the test, at random times."""
    given = random.Random(seed)
    n = 1 + seed % 3
    m = [given.randint(1, 5) for _ in range(n)]
    c, k = _symmetric(given, n, 0, 2), _symmetric(given, n, -2, 2)
    drives = given.sample(DRIVES, n)
    derivation = derive(_text(n, m, c, k, drives))
    found = forced(derivation)
    assert found is not None
    x = [sympy.sympify(str(f), locals={"t": T, "w": sympy.Rational(7, 5)}) for f in found.values()]
    F = [sympy.sympify(d.replace("^", "**"), locals={"t": T, "w": sympy.Rational(7, 5)})
         for d in drives]  # fmt: skip
    for i in range(n):
        left = m[i] * x[i].diff(T, 2)
        left += sum(c[i][j] * x[j].diff(T) + k[i][j] * x[j] for j in range(n))
        for _ in range(3):
            here = {T: sympy.Rational(given.randint(1, 40), 7)}
            assert abs(sympy.N((left - F[i]).subs(here), 30)) < 1e-20


@pytest.mark.parametrize("seed", range(3))
def test_the_amplitude_of_a_damped_oscillator(seed):
    """b = f/(m sqrt((w0^2 - g^2)^2 + 4 l^2 g^2)), equation 26.3."""
    given = random.Random(seed)
    m, c, k, f = (given.randint(1, 9) for _ in range(4))
    derivation = derive(_text(1, [m], [[c]], [[k]], [f"{f}*cos(w*t)"]))
    found = forced(derivation)
    size = amplitude(list(found.values()), derivation.system.t)
    [w] = size.free_symbols
    for rate in (0.3, 1.7, 4.0):
        rate_of_decay, w0 = c / (2 * m), (k / m) ** 0.5
        expected = f / (m * ((w0**2 - rate**2) ** 2 + 4 * rate_of_decay**2 * rate**2) ** 0.5)
        assert abs(float(size.subs(w, rate)) / expected - 1) < 1e-12
    told = words(explain(derivation, ("modes",)), "Small oscillations")
    assert "Its amplitude is" in told


def test_at_resonance_it_grows_in_proportion_to_the_time():
    """x = f t sin(w t)/(2 m w), equation 22.5."""
    text = (
        "{coordinates: [x], parameters: {m: {assume: positive}, w: {assume: positive}, f: {}}, "
        "T: m*x'^2/2, V: m*w^2*x^2/2, forces: {x: f*cos(w*t)}}"
    )
    [x] = forced(derive(text)).values()
    m, w, f, t = (next(s for s in x.free_symbols if s.name == name) for name in "mwft")
    assert sympy.simplify(x - f * t * sympy.sin(w * t) / (2 * m * w)) == 0


@pytest.mark.parametrize(
    "rest",
    [
        "V: cos(x), forces: {x: cos(t)}",  # not linear
        "V: (2 + cos(t))*x^2/2, forces: {x: cos(t)}",  # coefficients change
        "V: x^2/2, forces: {x: 3}",  # no drive
        "functions: {F: [s]}, V: x^2/2, forces: {x: F(t)}",  # not known
        "V: x^2/2, forces: {x: exp(-t^2)}",  # no elementary solution
    ],
)
def test_of_no_other_equations_is_one_stated(rest):
    """By the shape of the equations alone."""
    assert forced(derive(f"{{coordinates: [x], T: x'^2/2, {rest}}}")) is None
