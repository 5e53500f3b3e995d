"""A run that leaves the sign which the file assumes of a coordinate says so."""

from __future__ import annotations

import math
import re

import pytest

from .running import simulated


def warned(assume: str, start: str, until: float, centre: str = "0", shown: str = "x") -> list[str]:
    """The warnings of an oscillator, x = c + (x0 - c) cos(t)."""
    text = (
        f"{{coordinates: {{x: {{assume: {assume}}}, y: }}, "
        f"L: (x'^2 + y'^2)/2 - (x - {centre})^2/2, initial: {{x: {start}, y': 1}}}}"
    )
    return list(simulated(text, until, show=(shown,)).warnings)


@pytest.mark.parametrize(
    ("assume", "start", "holds"),
    [
        ("positive", "2", "for x > 0"),
        ("nonnegative", "3", "for x >= 0"),
        ("negative", "-2", "for x < 0"),
        ("nonzero", "-1", "on one side of x = 0"),
        ("nonzero", "1", "on one side of x = 0"),
    ],
)
def test_the_first_row_beyond_0_is_reported(assume: str, start: str, holds: str) -> None:
    (warning,) = warned(assume, start, 3.0)
    x, t = map(float, re.findall(r"-?\d+\.\d+", warning))
    assert math.pi / 2 < t < math.pi / 2 + 0.04
    assert x == pytest.approx(float(start) * math.cos(t), rel=1e-3)
    assert f"the file assumes it {assume}" in warning
    assert f"{holds} only" in warning


@pytest.mark.parametrize(
    ("assume", "start", "until", "centre"),
    [
        ("positive", "2", 1.5, "0"),  # stops before
        ("real", "2", 3.0, "0"),
        ("nonnegative", "2", 7.0, "1"),  # touches 0
        ("negative", "-1", 7.0, "-3"),
    ],
)
def test_nothing_is_reported_of_a_run_that_keeps_the_sign(
    assume: str, start: str, until: float, centre: str
) -> None:
    assert warned(assume, start, until, centre) == []


@pytest.mark.parametrize(("relation", "other"), [(">=", "<="), ("<=", ">=")])
def test_a_condition_that_the_initial_state_breaks_is_told_with_the_force(relation, other):
    # a string of length l pulls with m (l theta'^2 + g cos theta) against r
    speed = {">=": 5, "<=": 0}[relation]
    angle = {">=": 0.0, "<=": 3.0}[relation]
    text = (
        "{coordinates: {r: {assume: positive}, theta: }, parameters: {m: 2, g: 9.81, l: 1}, "
        "T: m*(r'^2 + r^2*theta'^2)/2, V: -m*g*r*cos(theta), constraints: {string: "
        f"{{equation: r = l, multiplier: S, holds_while: S {relation} 0}}}}, "
        f"initial: {{r: l, theta: {angle}, r': 0, theta': {speed}}}}}"
    )
    (warning,) = simulated(text, 1.0, show=("theta",)).warnings
    force = -2 * (speed**2 + 9.81 * math.cos(angle))
    assert float(re.findall(r"S = (-?[\d.]+)", warning)[0]) == pytest.approx(force, rel=1e-4)
    assert warning.endswith(f"write holds_while: S {other} 0")
    kept = text.replace(f"S {relation} 0", f"S {other} 0")
    assert not simulated(kept, 0.1, show=("theta",)).warnings
