"""Roots within an interval, to rounding, wherever the interval lies."""

import math
import random

import pytest

from lagcli.numerics.hybrid.extrema import crossing


@pytest.mark.parametrize("seed", range(40))
def test_a_crossing_is_found_to_rounding_from_any_interval(seed):
    random.seed(seed)
    root = random.choice([0.0, math.pi, -math.pi, 1e3 * random.random(), random.gauss(0, 1)])
    width = 10.0 ** random.uniform(-6, 1)
    good = root - width * random.random()
    bad = root + width * random.random()
    sharp = random.choice([0.0, 1.0, 30.0])

    def f(x):
        return math.sin((root - x) / 20) * (1 + sharp * (x - root) ** 2)

    found = crossing(f, good, bad, f(good), f(bad))
    allowed = 4e-15 * max(width, abs(root))
    assert abs(found - root) <= allowed
    mirrored = crossing(lambda x: f(-x), -good, -bad, f(good), f(bad))
    assert abs(mirrored + root) <= allowed


def test_where_the_sine_passes_pi():
    # where f is 0 to rounding at one end of the bracket, the other end is still to come near
    found = crossing(math.sin, 3.1, 3.2, math.sin(3.1), math.sin(3.2))
    assert found == pytest.approx(math.pi, abs=4e-15)
