"""Poincaré sections of motions in closed form."""

from math import cos, pi, remainder, sin, sqrt

import pytest

from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pictures.drawing import CannotDraw, Marks
from lagcli.pictures.section import section
from lagcli.pictures.starts import other_starts
from lagcli.reader.columns import Column
from tests.pictures.problems import problem_of

TWO = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: x^2/2 + y^2
initial: {x: 0.3, x': 1.1, y: 0.7, y': -0.2}
"""
DRIVEN = """
coordinates: [x]
parameters: {w: {value: 3}}
T: x'^2/2
V: x^2/2
forces: {x: cos(w*t)}
"""
TURNING = """
coordinates: {theta: {unit: rad}, phi: {unit: rad}}
T: (theta'^2 + phi'^2)/2
initial: {theta: 0.5, theta': 1, phi: 0, phi': 0.3}
"""


def motion(until, samples=50):
    return RunRequest(until=until, accuracy=1e-10, samples=samples, columns=(Column("t", None),))


def dots(picture):
    [panel] = picture.panels
    return [item.points for item in panel.items if isinstance(item, Marks)]


def test_the_section_of_two_oscillators():
    picture, refusal = section(problem_of(TWO), motion(200.0), None)
    assert refusal == ""
    [points] = dots(picture)
    # x = a sin(t + b) passes 0 upwards at t + b = 2 pi k
    from math import atan2

    b = atan2(0.3, 1.1)
    w = sqrt(2)
    assert len(points) == int((200 + b) / (2 * pi))
    for k, (y, rate) in enumerate(points, start=1):
        t = 2 * pi * k - b
        assert y == pytest.approx(0.7 * cos(w * t) - 0.2 / w * sin(w * t), abs=1e-9)
        assert rate == pytest.approx(-0.7 * w * sin(w * t) - 0.2 * cos(w * t), abs=1e-9)


@pytest.mark.parametrize("where", ["y = 0.5", "y^2 + y = 0.75"])
def test_a_section_anywhere(where):
    picture, _ = section(problem_of(TWO), motion(60.0), where)
    [points] = dots(picture)
    for x, rate in points:  # the energy of x alone is conserved
        assert x * x + rate * rate == pytest.approx(0.3**2 + 1.1**2, abs=1e-9)
    assert len(points) > 10


def test_states_at_every_period_of_the_drive():
    picture, _ = section(problem_of(DRIVEN), motion(40.0), "t = 2*pi/w")
    [points] = dots(picture)
    for k, (x, rate) in enumerate(points):
        t = 2 * pi * k / 3
        assert x == pytest.approx((cos(t) - cos(3 * t)) / 8, abs=1e-9)
        assert rate == pytest.approx((3 * sin(3 * t) - sin(t)) / 8, abs=1e-9)


def test_an_angle_is_within_one_turn():
    picture, _ = section(problem_of(TURNING), motion(100.0), "sin(theta)")
    [points] = dots(picture)
    for k, (theta, _) in enumerate(points):
        assert theta == pytest.approx(remainder(2 * pi * (k + 1), 2 * pi), abs=1e-9)


def test_other_motions_have_the_same_energy():
    picture, _ = section(problem_of(TWO), motion(60.0), "x", 5)
    assert len(dots(picture)) == 5
    energy = (0.3**2 + 1.1**2 + 0.2**2) / 2 + 0.7**2
    columns = [(str(n), n) for n in problem_names("y")]
    for other in other_starts(problem_of(TWO), "x", dots(picture)[0], columns, 20):
        state = {str(name): value for name, value in map(number_of, other.initial.items())}
        found = (state["x'"] ** 2 + state["y'"] ** 2 + state["x"] ** 2) / 2 + state["y"] ** 2
        assert found == pytest.approx(energy, rel=1e-12)
        assert state["x"] == 0 < state["x'"]


def problem_names(name):
    from lagcli.expression import Name

    return [Name(name), Name(name, 1)]


def number_of(entry):
    from lagcli.evaluation import value_of

    return entry[0], float(value_of(entry[1]))


@pytest.mark.parametrize(
    ("problem", "where", "orbits", "sentence"),
    [
        (TWO, "x = 9", 1, "does not pass x = 9 upwards"),
        (DRIVEN, None, 1, "is cut at the period of what drives it: --section t=2"),
        (DRIVEN, "t = -1", 1, "the period must be a time after 0"),
        (TWO, "x + y", 3, "--orbits needs a section where one coordinate is 0"),
    ],
)
def test_what_has_no_section_is_a_sentence(problem, where, orbits, sentence):
    with pytest.raises(CannotDraw, match=sentence):
        section(problem_of(problem), motion(10.0), where, orbits)
