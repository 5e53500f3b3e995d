"""Asking for a longer span never gives less, and what is certified is right beyond a horizon."""

import math
import random
from itertools import pairwise

import pytest

from .running import column, simulated

#: x = exp(-k t): what rounding adds grows as exp(k t) until nothing is known of x.
FALLING = "{coordinates: [x], L: x'^2/2 + (%r)^2*x^2/2, initial: {x: 1, x': -(%r)}}"
PENDULUMS = """
coordinates: [a, b]
L: a'^2 + b'^2/2 + a'*b'*cos(a - b) + 9.81*(2*cos(a) + cos(b))
initial: {a: %r, b: %r}
"""
#: What two spans on the grid may differ by: their runs end at rows that lie between others.
_SLACK = 0.93


def _rate(seed):
    """A growth rate that doubles round."""
    return round(random.Random(seed).uniform(0.1, 9), 3)


#: Each takes ten seconds: one is for `make check-all`, the others by `-m hours`.
SEEDS = [pytest.param(k, marks=pytest.mark.hours if k else pytest.mark.long) for k in range(6)]


@pytest.mark.parametrize("method", ["auto", "taylor64"])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_longer_span_never_holds_for_less(seed, method):
    k = _rate(seed)
    text, far = FALLING % (k, k), random.Random(seed)
    held = 0.0
    for factor in (20, 33, 60, 90, far.uniform(100, 300), far.uniform(1e3, 1e5)):
        result = simulated(text, factor / k, 1e-9, samples=11, show="x", method=method)
        assert result.certificate.holds_until >= _SLACK * held
        held = max(held, result.certificate.holds_until)
        assert result.rows[-1][0] == result.certificate.holds_until
        for t, x in result.rows:
            assert x == pytest.approx(math.exp(-k * t), abs=1e-9)
    assert k * held > 12  # doubles lose exp(-k t) beside 1 where 1e-16 exp(k t) = 1e-9


def test_nothing_that_grew_out_of_rounding_is_the_scale_of_what_is_certified():
    """One row in ten: held against exp(k t) at the end of the span, it was 3.8e12, not 2e-29."""
    result = simulated(FALLING % (0.37, 0.37), 243, 1e-9, samples=11, show="x", furthest=False)
    assert all(x == pytest.approx(math.exp(-0.37 * t), abs=1e-9) for t, x in result.rows)


@pytest.mark.long
def test_a_stop_long_after_the_accuracy_is_lost_is_not_one_of_the_motion():
    result = simulated(FALLING % (0.37, 0.37), 8000, 1e-9, samples=11, show="x")
    assert "stops" not in result.refusal
    assert "holds until" in result.refusal
    assert not result.events


@pytest.mark.parametrize("seed", SEEDS)
def test_chaos_holds_no_shorter_over_a_longer_span(seed):
    angles = random.Random(seed)
    text = PENDULUMS % (angles.uniform(1.5, 3), angles.uniform(1.5, 3))
    holds = []
    near = sorted(angles.uniform(6, 14) for _ in range(12))
    for until in (5, *near, 25, 100, 1000):
        result = simulated(text, until, 1e-9, samples=101, method="taylor64")
        holds.append(result.certificate.holds_until)
        assert column(result, "t") == sorted(set(column(result, "t")))
        if not result.certificate.reached:
            assert f"not reached until t = {until:g}" in result.refusal
    assert all(b >= a * (1 - 1e-12) for a, b in pairwise(holds))


@pytest.mark.long
def test_the_rows_stay_where_they_were_asked_for():
    times = (0.0, 3.0, 4.5, 20.0, 70.0)
    text = PENDULUMS % (2.0, 2.5)
    found = simulated(text, 70, 1e-9, samples=5, times=times, method="taylor64")
    at = column(found, "t")
    assert at[:-1] == pytest.approx([t for t in times if t < at[-1]])
    assert at[-1] == found.certificate.holds_until > 4.5


@pytest.mark.long
def test_the_double_pendulum_of_a_thousand_seconds_holds_as_long_as_one_of_thirty():
    """Over t = 1000 it held until 0, over t = 50 in doubles until 8.4; 128 bits hold until 34."""
    found = simulated(PENDULUMS % (2.0, 2.5), 1000, 1e-9, samples=101)
    assert found.method == "taylor128"
    assert found.certificate.holds_until > 32
    whole = simulated(PENDULUMS % (2.0, 2.5), 30, 1e-9, samples=4)
    assert whole.certificate.reached
    for row, other in zip(found.rows, whole.rows, strict=False):
        assert row == pytest.approx(other, abs=1e-8)
