"""Phase portraits of motions whose energy is not conserved."""

from math import asin, pi, sqrt

import pytest

from lagcli.expression import signed
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pictures.drawing import Curve, Marks
from lagcli.pictures.flow import Flow, reversed_in_time
from lagcli.pictures.labels import Labels
from lagcli.pictures.portrait import portrait
from lagcli.pictures.run import run_with
from lagcli.reader.columns import Column
from lagcli.record import replace
from tests.pictures.problems import problem_of

PENDULUM = """
coordinates: {theta: {unit: rad}}
parameters: {c: {value: 0.8}, M: {value: 2}, g: {value: 9.81}}
T: theta'^2/2
V: -g*cos(theta)
dissipation: c*theta'^2/2
forces: {theta: M}
initial: {theta: 2, theta': 1}
"""
SADDLE = "coordinates: [x]\nT: x'^2/2\nV: -x^2/2\ndissipation: x'^2/2\ninitial: {x: 0.5}\n"
RATES = ((sqrt(5) - 1) / 2, -(sqrt(5) + 1) / 2)
STATES = RunRequest(until=0.0, accuracy=1e-9, samples=2, columns=(Column("t", None),))


def marks(picture, role):
    return [
        x for i in picture.panels[0].items if isinstance(i, Marks) and i.role == role
        for x, _ in i.points
    ]  # fmt: skip


def test_the_equilibria_of_a_pendulum_with_a_torque():
    problem = problem_of(PENDULUM)
    rests = Flow(problem, Labels(problem)).rests()
    rest = asin(2 / 9.81)
    assert [r.q for r in rests if r.stable] == pytest.approx([rest], abs=1e-9)
    assert [r.q for r in rests if r.saddle] == pytest.approx([pi - rest], abs=1e-9)


def test_the_manifolds_of_a_saddle_are_its_straight_lines():
    picture, _ = portrait(problem_of(SADDLE), STATES)  # x'' = x - x': l^2 + l = 1
    assert marks(picture, "unstable") == pytest.approx([0], abs=1e-12)
    slopes = []
    for item in picture.panels[0].items:
        if isinstance(item, Curve) and item.role == "separatrix":
            for x, v in item.pieces[0]:
                assert min(abs(v - rate * x) for rate in RATES) < 1e-4 * max(1, abs(x))
            x, v = item.pieces[0][20]
            slopes.append(v / x)
    assert sorted(slopes) == pytest.approx([RATES[1]] * 2 + [RATES[0]] * 2, rel=1e-3)


def test_with_the_time_reversed_a_motion_runs_back():
    problem = problem_of(PENDULUM)
    asked = RunRequest(until=1.5, accuracy=1e-10, samples=31, columns=())
    columns = [Column(str(name), name) for name in problem.initial]
    there = run_with(problem, asked, columns).result.rows
    names = list(problem.initial)
    end = dict(zip(names, (signed(there[-1][1]), signed(-there[-1][2])), strict=True))
    back = run_with(replace(reversed_in_time(problem), initial=end), asked, columns).result.rows
    for row, other in zip(there, reversed(back), strict=True):
        assert other[1:] == pytest.approx((row[1], -row[2]), abs=1e-8)


def test_a_driven_motion_has_no_portrait_but_a_sentence():
    from lagcli.pictures.drawing import CannotDraw

    with pytest.raises(CannotDraw, match="--kind poincare cuts it"):
        portrait(problem_of("coordinates: [x]\nT: x'^2\nV: x^2*cos(t)"), STATES)
