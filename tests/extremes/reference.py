"""Motions computed without lagcli: extrapolation of the midpoint rule in many digits.

Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.9.
"""

from fractions import Fraction

from flint import arb, ctx

_COLUMNS = 12


def solution(rate, state, span, steps, digits=40):
    """y(span) of y' = rate(y), y(0) = state (balls), by equal steps of order 24."""
    before = ctx.dps
    ctx.dps = digits
    try:
        y, h = [number(x) for x in state], number(span) / steps
        for _ in range(steps):
            y = [x.mid() for x in _step(rate, y, h)]
        return [float(x) for x in y]
    finally:
        ctx.dps = before


def number(x):
    """A rational as a ball: 1, '5/2', '1e-12'."""
    exact = Fraction(x)
    return arb(exact.numerator) / exact.denominator


def _step(rate, y, h):
    row = []
    for k in range(1, _COLUMNS + 1):
        above, row = row, [_midpoint(rate, y, h, 2 * k)]
        for j, other in enumerate(above):
            weight = 1 / (arb(k * k) / (k - 1 - j) ** 2 - 1)
            row.append([a + (a - b) * weight for a, b in zip(row[j], other, strict=True)])
    return row[-1]


def _midpoint(rate, y, h, n):
    d = h / n
    before, now = y, [a + d * b for a, b in zip(y, rate(y), strict=True)]
    for _ in range(n - 1):
        before, now = now, [a + 2 * d * b for a, b in zip(before, rate(now), strict=True)]
    return now
