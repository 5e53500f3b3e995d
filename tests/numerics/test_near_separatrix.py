"""What passes a saddle enlarges rounding by some 1e6: the bound holds it."""

from __future__ import annotations

import random

import pytest

from .running import simulated

DRAW = random.Random(4)
SPEEDS = [f"{2 - 10 ** DRAW.uniform(-8, -4):.12f}" for _ in range(24)]
PENDULUM = """
coordinates: [x]
T: x'^2/2
V: -cos(x)
initial: {{x: 0, x': {speed}}}
"""


def angles(speed: str, times: list[float]) -> list[float]:
    """2 asin(k sn(t, k)) with k = x'(0)/2, DLMF 22.19(i), from 40 digits."""
    from mpmath import asin, ellipfun, mpf, workdps

    with workdps(40):
        k = mpf(speed) / 2
        return [float(2 * asin(k * ellipfun("sn", mpf(t), k=k))) for t in times]


@pytest.mark.long
@pytest.mark.parametrize("accuracy", [1e-7, 1e-8, 1e-10])
def test_the_bound_holds_beyond_a_saddle(accuracy: float) -> None:
    beyond = []
    for speed in SPEEDS:
        result = simulated(PENDULUM.format(speed=speed), 16, accuracy, samples=9)
        times, found, _ = zip(*(row[:3] for row in result.rows), strict=True)
        pairs = zip(found, angles(speed, list(times)), strict=True)
        error = max(abs(a - b) for a, b in pairs)
        bound = result.certificate.global_error["x"] * max(map(abs, found))
        beyond.append(error / (bound + 1e-15))
    assert max(beyond) <= 1
