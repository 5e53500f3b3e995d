"""Where a smooth function of one variable passes through 0, and where it is least."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

Function = Callable[[float], float]

_WIDTH = 1e-15  # of the place: some four units of its last digit
_ROUNDS = 120  # twice the bits of a double: half of the steps may only halve
_NODES = 9


def crossing(f: Function, good: float, bad: float, above: float, below: float) -> float:
    """The place beyond which f is negative, to rounding: f(good) = above >= 0 > f(bad) = below.

    Either of the two places may be the larger one.

    References
    ----------
    The Illinois form of regula falsi with a bisection now and then: Dahlquist, Björck,
    *Numerical Methods in Scientific Computing* I, section 6.2.2.
    """
    side, least = 0, _WIDTH * abs(bad - good)
    for count in range(_ROUNDS):
        width = bad - good
        nearest = max(least, _WIDTH * abs(bad))
        if abs(width) <= nearest:
            break
        x = (good + bad) / 2
        if count % 3 != 2:
            x = bad - below * width / (below - above)
            # a little beyond the root, so that it is enclosed from both sides
            low, high = sorted((good, bad))
            x = min(max(x, low + nearest / 2), high - nearest / 2)
        if not min(good, bad) < x < max(good, bad):
            break
        value = f(x)
        if value < 0:
            bad, below = x, value
            above = above / 2 if side < 0 else above
            side = -1
        else:
            good, above = x, value
            below = below / 2 if side > 0 else below
            side = 1
    return bad


def lowest_of(places: Sequence[float], values: Sequence[float]) -> float:
    """Where the polynomial through the points is least, to 1/32 of their span."""
    low, span = places[0], places[-1] - places[0]
    tried = [low + span * k / 32 for k in range(33)]
    return min(tried, key=polynomial(places, values))


def least(f: Function, low: float, high: float) -> tuple[float, float]:
    """The place and the value of the least f between low and high, where it is smooth.

    The derivative of the polynomial through Chebyshev's points has its root where f is
    least to much more than half of the digits, which comparing values would give.

    References
    ----------
    Berrut, Trefethen, "Barycentric Lagrange interpolation", SIAM Review 46 (2004), section 9.
    """
    middle, half = (low + high) / 2, (high - low) / 2
    places = [middle - half * math.cos(math.pi * k / (_NODES - 1)) for k in range(_NODES)]
    values = [f(x) for x in places]
    weights = _barycentric(places)

    slopes = [
        sum(
            weights[j] / weights[i] * (values[j] - values[i]) / (places[i] - places[j])
            for j in range(_NODES)
            if j != i
        )
        for i in range(_NODES)
    ]

    slope = polynomial(places, slopes)
    start = lowest_of(places, values)
    step = (high - low) / 32
    left, right = max(low, start - step), min(high, start + step)
    if not slope(left) < 0 < slope(right):
        x = left if slope(left) >= 0 else right
        return x, f(x)
    x = crossing(lambda y: -slope(y), left, right, -slope(left), -slope(right))
    return x, f(x)


def _barycentric(places: Sequence[float]) -> list[float]:
    weights = []
    for i, x in enumerate(places):
        weight = 1.0
        for j, y in enumerate(places):
            if j != i:
                weight /= x - y
        weights.append(weight)
    return weights


def polynomial(places: Sequence[float], values: Sequence[float]) -> Function:
    """The polynomial through some points."""
    points = list(zip(places, values, _barycentric(places), strict=True))

    def at(x: float) -> float:
        above = below = 0.0
        for place, value, weight in points:
            if x == place:
                return value
            part = weight / (x - place)
            above += part * value
            below += part
        return above / below

    return at
