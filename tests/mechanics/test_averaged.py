"""The potential of a motion averaged over a rapid drive, in several coordinates.

Landau, Lifshitz, *Mechanics*, 3rd ed., section 30; Paul, Rev. Mod. Phys. 62 (1990) 531.
"""

from __future__ import annotations

import random

import mpmath
import pytest

from lagcli.mechanics.averaged import averaged
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

STEPS = 200


def _slow_frequency(k, f, w):
    """Of x'' = -(k + f cos(w t)) x: the Floquet exponent, by fourth order in 200 steps a period."""
    h = 2 * mpmath.pi / w / STEPS

    def rate(t, y):
        return [y[1], -(k + f * mpmath.cos(w * t)) * y[0]]

    def step(t, y):
        a = rate(t, y)
        b = rate(t + h / 2, [u + h / 2 * v for u, v in zip(y, a, strict=True)])
        c = rate(t + h / 2, [u + h / 2 * v for u, v in zip(y, b, strict=True)])
        d = rate(t + h, [u + h * v for u, v in zip(y, c, strict=True)])
        return [
            u + h / 6 * (p + 2 * q + 2 * r + s) for u, p, q, r, s in zip(y, a, b, c, d, strict=True)
        ]

    trace = 0
    for start in ([1, 0], [0, 1]):
        y = [mpmath.mpf(x) for x in start]
        for n in range(STEPS):
            y = step(n * h, y)
        trace += y[start.index(1)]
    return mpmath.acos(trace / 2) * w / (2 * mpmath.pi)


@pytest.mark.parametrize("seed", range(4))
def test_it_gives_the_slow_frequencies_of_a_driven_saddle(seed):
    """V = (U + W cos(w t)) (x^2/2 - y^2) at a large w, in a plane that is turned."""
    given = random.Random(seed)
    m, U, w = given.randint(1, 4), given.choice([0, 1, 2]), given.randint(60, 80)
    W = given.randint(100, 200) * m
    saddle = given.choice(["x^2/2 - y^2", "(x + y)^2/4 - (x - y)^2/2"])
    text = (
        f"{{coordinates: [x, y], T: \"{m}*(x'^2 + y'^2)/2\", V: ({U} + {W}*cos({w}*t))*({saddle})}}"
    )
    derivation = derive(text)
    V, (x, y) = averaged(derivation.dynamics).potential, derivation.system.q
    a, b, c = (float(V.diff(*pair)) for pair in ((x, x), (x, y), (y, y)))
    middle, half = (a + c) / 2, (((a - c) / 2) ** 2 + b**2) ** 0.5
    found = sorted(((middle - half) / m) ** 0.5 if s < 0 else ((middle + half) / m) ** 0.5
                   for s in (-1, 1))  # fmt: skip
    expected = sorted(float(_slow_frequency(s * U / m, s * W / m, w)) for s in (1, -2))
    assert found == pytest.approx(expected, rel=0.03)


def test_a_paul_trap_is_held_where_both_curvatures_are_positive():
    """q^2 W^2 (r^2 + 4 z^2)/(4 m w^2 d^4) of the quadrupole q W cos(w t) (r^2 - 2 z^2)/(2 d^2)."""
    text = (
        "{coordinates: [x, y, z], parameters: {m: {assume: positive}, W: {assume: positive}, "
        "w: {assume: positive}, U: {%s}}, T: \"m*(x'^2 + y'^2 + z'^2)/2\", "
        "V: (U + W*cos(w*t))*(x^2 + y^2 - 2*z^2)/2}"
    )
    derivation = derive(text % "assume: positive")
    found, (x, _, z) = averaged(derivation.dynamics), derivation.system.q
    values = {s: {"m": 2, "W": 3, "w": 5, "U": 7}[s.name]
              for s in found.potential.free_symbols if s not in derivation.system.q}  # fmt: skip
    for q, own, size in ((x, 7, 1), (z, -14, 4)):
        assert float(found.potential.diff(q, 2).subs(values)) == pytest.approx(
            own + size * 9 / (2 * 2 * 25)
        )
    told = words(explain(derivation, ("equilibria",)), "Equilibria")
    assert "a minimum of" in told
    assert "Stability undecided" not in told
