"""Positions that the constraints of a linkage determine without a closed form."""

import math
import random
import re

import pytest

from lagcli.numerics.equations.refusal import Refusal

from .running import simulated

FOUR_BAR = """
coordinates: [q1, q2, q3]
T: (q1'^2 + q2'^2 + q3'^2)/2
constraints:
  loop_x: %(a)r*cos(q1) + %(b)r*cos(q2) - %(c)r*cos(q3) - %(d)r = 0
  loop_y: %(a)r*sin(q1) + %(b)r*sin(q2) - %(c)r*sin(q3) = 0
initial: {q1: %(q1)r, q1': 1}
"""


def _four_bar(seed):
    """A crank-rocker (Grashof: the crank is the shortest, shortest + longest < the others)."""
    draw = random.Random(seed).uniform
    a, b, c = draw(0.5, 1), draw(2.5, 3), draw(2.5, 3)
    d = draw(max(b, c) - 0.9, min(b + c - a - 0.1, 3))
    return {"a": a, "b": b, "c": c, "d": d, "q1": draw(-3, 3)}


def _assembled(bar):
    """Both assemblies by Freudenstein's way: the diagonal from the crank's end to the rocker's pivot."""
    a, b, c, d, q1 = (bar[name] for name in ("a", "b", "c", "d", "q1"))
    x, y = d - a * math.cos(q1), -a * math.sin(q1)
    diagonal, direction = math.hypot(x, y), math.atan2(y, x)
    opening = math.acos((b**2 + diagonal**2 - c**2) / (2 * b * diagonal))
    found = []
    for side in (1, -1):
        q2 = direction + side * opening
        end = a * math.cos(q1) + b * math.cos(q2) - d, a * math.sin(q1) + b * math.sin(q2)
        found.append((q2, math.atan2(end[1], end[0])))
    return found


def _is_near(one, other):
    return all(abs(math.remainder(a - b, math.tau)) < 1e-9 for a, b in zip(one, other, strict=True))


@pytest.mark.parametrize("seed", range(12))
def test_both_assemblies_of_a_four_bar_linkage_are_listed(seed):
    bar = _four_bar(seed)
    with pytest.raises(Refusal, match="in several ways") as caught:
        simulated(FOUR_BAR % bar, 0.1)
    told = re.findall(r"q2: (\S+), q3: (\S+)}", caught.value.diagnostics[0].message)
    found = [tuple(map(float, pair)) for pair in told]
    assert len(found) == 2
    for expected in _assembled(bar):
        assert any(_is_near(expected, each) for each in found)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(12))
def test_what_is_listed_is_a_start(seed):
    bar = _four_bar(seed)
    for q2, q3 in _assembled(bar):
        text = (FOUR_BAR % bar).replace("q1': 1", f"q2: {q2!r}, q3: {q3!r}, q1': 1")
        assert simulated(text, 0.01).rows[0][1:4] == pytest.approx((bar["q1"], q2, q3))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_an_assumption_leaves_one_assembly(seed):
    bar = _four_bar(seed) | {"q1": 1.0}
    q2, q3 = max(_assembled(bar))
    text = (FOUR_BAR % bar).replace(
        "[q1, q2, q3]", "{q1: , q2: {assume: %s}, q3: }" % ("positive" if q2 > 0 else "negative")
    )
    alone = [pair for pair in _assembled(bar) if math.copysign(1, pair[0]) == math.copysign(1, q2)]
    if len(alone) == 1:
        assert simulated(text, 0.01).rows[0][2:4] == pytest.approx((q2, q3))
    else:
        with pytest.raises(Refusal, match="in several ways"):
            simulated(text, 0.01)


@pytest.mark.parametrize("seed", range(10))
def test_one_transcendental_equation(seed):
    """Kepler's equation u - e sin u = M has one root."""
    draw = random.Random(seed).uniform
    e, m = draw(0.05, 0.9), draw(0.3, 3)
    text = "{coordinates: [u, x], L: u'^2/2 + x'^2/2, constraints: {kepler: u - %r*sin(u) = x}, initial: {x: %r}}"
    [_, u, *_] = simulated(text % (e, m), 0.01).rows[0]
    assert u - e * math.sin(u) == pytest.approx(m, abs=1e-12)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(4))
def test_a_linkage_that_cannot_be_put_together_is_refused(seed):
    bar = _four_bar(seed) | {"d": 9.0}
    with pytest.raises(Refusal):
        simulated(FOUR_BAR % bar, 0.01)


def test_where_zero_is_a_root_it_is_taken():
    """A parallelogram that is flat at q1 = 0: as for one unknown, 0 satisfies the constraints."""
    bar = {"a": 1.0, "b": 2.0, "c": 1.0, "d": 2.0, "q1": 0.0}
    text = (FOUR_BAR % bar).replace("q1': 1", "q1': 0")
    assert simulated(text, 0.01).rows[0][1:4] == (0, 0, 0)
