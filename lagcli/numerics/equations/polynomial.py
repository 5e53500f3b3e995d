"""Real roots of a small polynomial in doubles, for initial values that are left out."""

from __future__ import annotations

import cmath
from collections.abc import Sequence

_ROUNDS = 200
_SAME = 1e-7


def real_roots(coefficients: Sequence[float]) -> list[float]:
    """The distinct real roots of c0 + c1 x + c2 x^2 + …, in order.

    References
    ----------
    Durand-Kerner's simultaneous iteration: Press et al., *Numerical Recipes*, 3rd ed., 9.5.
    """
    size = max(map(abs, coefficients), default=0.0)
    c = list(coefficients)
    while c and abs(c[-1]) <= 1e-14 * size:
        c.pop()
    if len(c) < 2:
        return []
    if len(c) == 2:
        return [-c[0] / c[1]]
    if len(c) == 3:
        return _quadratic(c)
    degree = len(c) - 1
    monic = [x / c[-1] for x in c]
    radius = 1 + max(abs(x) for x in monic[:-1])
    guesses = [radius * cmath.exp(2j * cmath.pi * (k + 0.25) / degree) for k in range(degree)]
    for _ in range(_ROUNDS):
        moved = 0.0
        for k, x in enumerate(guesses):
            value = 0j
            for coefficient in reversed(monic):
                value = value * x + coefficient
            spread = 1 + 0j
            for other, y in enumerate(guesses):
                if other != k:
                    spread *= x - y
            if spread:
                guesses[k] = x - value / spread
                moved = max(moved, abs(value / spread))
        if moved <= 1e-15 * radius:
            break
    scale = max(map(abs, guesses))
    real = sorted(x.real for x in guesses if abs(x.imag) <= _SAME * scale)
    return _distinct(real, scale)


def _quadratic(c: Sequence[float]) -> list[float]:
    below, half = c[2], c[1] / 2
    discriminant = half * half - c[0] * below
    if discriminant < -1e-15 * (half * half + abs(c[0] * below)):
        return []
    root = max(discriminant, 0.0) ** 0.5
    larger = -(half + root if half >= 0 else half - root)
    if not larger:
        return [0.0]
    found = sorted((larger / below, c[0] / larger))
    return _distinct(found, max(map(abs, found)))


def _distinct(roots: Sequence[float], scale: float) -> list[float]:
    kept: list[float] = []
    for root in roots:
        if not kept or root - kept[-1] > _SAME * scale:
            kept.append(root)
    return kept
