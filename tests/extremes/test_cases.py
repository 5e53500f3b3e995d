"""What is extreme in a problem follows from its formulas."""

import math
from itertools import product
from math import prod
from pathlib import Path

import pytest

from lagcli import load
from lagcli.pipeline import read
from lagcli.studies.extremes.cases import cases_of
from lagcli.studies.extremes.roles import (
    alike,
    angles_of,
    light_speeds,
    singular_positions,
    unstable_rest,
)
from lagcli.studies.extremes.scene import ExtremeScene, with_all_values


def scene_of(text):
    found = read("case.yaml", text.encode())
    assert found.problem is not None, found.diagnostics
    return ExtremeScene(with_all_values(found.problem)[0])


def cases(text, kind):
    scene = scene_of(text)
    return {case.name: ExtremeScene(case.problem) for case in cases_of(scene) if case.kind == kind}


PENDULUM = """
coordinates: [th]
parameters: {m: 2, g: 9.81, l: 0.5, d: 3}
T: (m + d)*l^2*th'^2/2
V: -(m + d)*g*l*cos(th)
initial: {th: 1}
"""


def test_parameters_of_one_dimension_are_compared():
    scene = scene_of(PENDULUM)
    assert alike(scene) == [["m", "d"], ["g"], ["l"]]
    found = cases(PENDULUM, "ratios")
    assert {name for name in found if "/" in name} == {"m/d = 1e12", "m/d = 1e-12"}
    for power in (12, -12):
        other = found[f"m/d = 1e{power}"]
        assert other.value("m") / other.value("d") == pytest.approx(10.0**power)
    assert found["l times 1e12"].value("l") == 5e11


def test_an_exponent_an_angle_and_a_whole_number_have_no_ratio():
    scene = scene_of("""
coordinates: [x]
parameters: {m: 1, k: 1, p: 3, n: {value: 2, integer: true}, alpha: 0.5}
T: m*x'^2/2
V: k*n*x^p/p - m*x*sin(alpha)
initial: {x: 1}
""")
    assert [name for group in alike(scene) for name in group] == ["m", "k"]
    assert [angle.factors for angle in angles_of(scene)] == [(("alpha", 1),)]


def test_angles_next_to_zero_and_right_angles():
    found = cases(PENDULUM, "angles")
    assert {name: scene.q[0] for name, scene in found.items()} == {
        "th = 1e-9": 1e-9,
        "th = pi/2 - 1e-9": pytest.approx(math.pi / 2 - 1e-9, abs=1e-15),
        "th = pi - 1e-9": pytest.approx(math.pi - 1e-9, abs=1e-15),
    }


def test_the_state_stays_on_the_constraints():
    text = """
coordinates: [x, y, th]
parameters: {l: 2}
T: (x'^2 + y'^2)/2
V: y
constraints: {across: x = l*sin(th), along: y = -l*cos(th)}
initial: {th: 1, th': 1, x': 2*cos(1), y': 2*sin(1), x: 2*sin(1), y: -2*cos(1)}
"""
    found = cases(text, "angles")
    assert len(found) == 3
    for scene in found.values():
        x, y, th = scene.q
        u, v, w = scene.v
        assert (x, y) == pytest.approx((2 * math.sin(th), -2 * math.cos(th)), abs=1e-14)
        assert (u, v) == pytest.approx((2 * w * math.cos(th), 2 * w * math.sin(th)), abs=1e-14)
    longer = cases(text, "ratios")["l times 1e12"]
    assert math.hypot(*longer.q[:2]) == pytest.approx(2e12)


def test_zeros_of_the_mass_matrix():
    """sin(th)^2 at 0 and pi; (3 cos(th) - 1)^2 at acos(1/3); r^2 at 0."""
    scene = scene_of("""
coordinates: [th, ph, r]
T: (3*cos(th) - 1)^2*th'^2/2 + sin(th)^2*ph'^2/2 + r^2*r'^2/2
initial: {th: 1, r: 1}
""")
    found = {(root.coordinate, round(root.value, 9)) for root in singular_positions(scene)}
    third = round(math.acos(1 / 3), 9)
    assert found == {(0, 0.0), (0, round(math.pi, 9)), (0, third), (0, -third), (2, 0.0)}


def test_a_matrix_that_is_never_singular():
    scene = scene_of(PENDULUM)
    assert list(singular_positions(scene)) == []


def test_the_separatrix_of_a_pendulum():
    """th = pi, left at the rate sqrt(g/l); from th0 with th'^2 = 2 g/l (1 + cos(th0))."""
    scene = scene_of(PENDULUM)
    [(rest, direction, rate)] = unstable_rest(scene)
    assert rest == pytest.approx([math.pi])
    assert rate == pytest.approx(math.sqrt(9.81 / 0.5))
    assert len(direction) == 1
    found = cases(PENDULUM, "separatrix")
    for side in (1, -1):
        case = found[f"E = E(th = pi) {'-+'[side > 0]} 1e-12"]
        exact = 2 * 9.81 / 0.5 * (1 + math.cos(1))
        assert case.v[0] ** 2 / exact - 1 == pytest.approx(side * 1e-12, abs=4e-16)


def test_a_potential_with_two_hills():
    """x^2/2 - x^4/4: unstable at 1 and -1, where V'' = -2."""
    scene = scene_of("{coordinates: [x], L: x'^2/2 - x^2/2 + x^4/4, initial: {x: 0.6}}")
    found = sorted(rest[0] for rest, _, _ in unstable_rest(scene))
    assert found == pytest.approx([1.0]) or found == pytest.approx([-1.0, 1.0])
    assert {round(rate, 9) for _, _, rate in unstable_rest(scene)} == {round(math.sqrt(2), 9)}


def test_an_equilibrium_whole_turns_away_is_not_listed():
    """An elastic pendulum is unstable upright alone; Newton's steps find it at 983 pi too."""
    scene = scene_of("""{coordinates: [r, a], parameters: {k: 1e4, g: 9.81}, initial: {r: 1.01, a: 0.5},
      T: (r'^2 + r^2*a'^2)/2, V: k*(r - 1)^2/2 - g*r*cos(a)}""")
    [(rest, _, _)] = unstable_rest(scene)
    assert [rest[0], abs(rest[1])] == pytest.approx([1 - 9.81e-4, math.pi])


def test_the_speed_of_light():
    text = """
coordinates: [x, y]
parameters: {m: 1, c: 5}
L: -m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2)
initial: {x': 0.3, y': 0.4}
"""
    [(direction, factor)] = light_speeds(scene_of(text))
    assert direction == [0.3, 0.4]
    assert factor == pytest.approx(10)
    found = cases(text, "light")
    speeds = sorted(math.hypot(*scene.v) for scene in found.values())
    assert speeds == pytest.approx([5e-9, 5 * (1 - 1e-12), 5], rel=1e-15)


def test_zero_is_tried_in_spite_of_an_assumption():
    text = """
coordinates: [x]
parameters: {m: {assume: positive, value: 2}, k: {assume: positive, value: 3}}
L: m*x'^2/2 - k*x^2/2
initial: {x: 1}
"""
    found = cases(text, "zero")
    assert {name: (s.value("m"), s.value("k")) for name, s in found.items()} == {
        "m = 0": (0, 3),
        "k = 0": (2, 0),
    }


@pytest.mark.parametrize(
    "name", ["classics/spherical-pendulum", "rolling/vertical-coin", "chains/slider-crank"]
)
def test_a_library_problem_has_cases(name):
    """Without values and without a state: 1, and a state in which nothing is special."""
    path = Path(__file__).parents[2] / "problems" / f"{name}.yaml"
    found = cases_of(ExtremeScene(with_all_values(load(path))[0]))
    names = [case.name for case in found]
    assert names[0] == "as given"
    assert len(names) == len(set(names))


@pytest.mark.parametrize("count", range(2, 6))
def test_values_that_are_taken_are_not_special(count):
    """No product of powers of them is 1, as g/(R w^2) of a hoop is where its bead starts to rise."""
    names = [f"p{k}" for k in range(count)]
    text = f"coordinates: [x]\nparameters: [{', '.join(names)}]\nL: x'^2\n"
    taken = with_all_values(read("x.yaml", text.encode()).problem)[1]
    assert list(taken) == names
    powers = [p for p in product(range(-2, 3), repeat=count) if any(p)]
    for each in powers:
        value = prod(taken[name] ** e for name, e in zip(names, each, strict=True))
        assert abs(value - 1) > 1e-5


def test_values_that_are_taken_are_as_assumed():
    text = "coordinates: [x]\nparameters: {a: {assume: negative}, n: {integer: true}}\nL: x'^2\n"
    taken = with_all_values(read("x.yaml", text.encode()).problem)[1]
    assert taken["a"] < 0
    assert taken["n"].denominator == 1
