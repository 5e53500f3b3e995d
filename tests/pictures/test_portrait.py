"""Phase portraits and effective potentials against closed forms."""

from math import acos, cos, pi, sqrt

import pytest

import lagcli
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pictures.drawing import CannotDraw, Curve, Marks
from lagcli.pictures.one_freedom import RemainingFreedom
from lagcli.pictures.portrait import plane, portrait
from lagcli.pictures.potential import potential
from lagcli.reader.columns import Column
from tests.pictures.problems import problem_of

PENDULUM = """
coordinates: {theta: {unit: rad}}
parameters: {m: {value: 2}, g: {value: 9.81}, l: {value: 0.7}}
T: m*l^2*theta'^2/2
V: -m*g*l*cos(theta)
initial: {theta: 1, theta': 0}
"""
KEPLER = """
coordinates: {r: {assume: positive}, phi: }
parameters: {m: {value: 1}, k: {value: 1}}
T: m*(r'^2 + r^2*phi'^2)/2
V: -k/r
initial: {r: 1, r': 0, phi: 0, phi': 1.2}
"""
HOOP = """
coordinates: {theta: {unit: rad}}
parameters: {m: {value: 1}, g: {value: 9.81}, R: {value: 1}, omega: {value: 4}}
T: m*R^2*(theta'^2 + omega^2*sin(theta)^2)/2
V: -m*g*R*cos(theta)
initial: {theta: 1}
"""
STATES = RunRequest(until=0.0, accuracy=1e-9, samples=2, columns=(Column("t", None),))
MOTION = RunRequest(until=10.0, accuracy=1e-9, samples=101, columns=(Column("t", None),))


def curves(picture, role):
    return [i for i in picture.panels[0].items if isinstance(i, Curve) and i.role == role]


def marks(picture, role):
    return [
        x for i in picture.panels[0].items if isinstance(i, Marks) and i.role == role
        for x, _ in i.points
    ]  # fmt: skip


@pytest.mark.long
def test_the_separatrix_of_the_pendulum():
    picture, _ = portrait(problem_of(PENDULUM), STATES)
    [separatrix] = curves(picture, "separatrix")
    points = [point for piece in separatrix.pieces for point in piece]
    omega = sqrt(9.81 / 0.7)
    assert len(points) > 400
    for theta, rate in points:  # theta' = 2 omega cos(theta/2): Landau, Lifshitz, section 11
        assert abs(abs(rate) - 2 * omega * cos(theta / 2)) < 1e-6
    assert max(abs(rate) for _, rate in points) == pytest.approx(2 * omega, abs=1e-3)


@pytest.mark.long
def test_the_equilibria_of_the_pendulum_with_their_kinds():
    picture, _ = portrait(problem_of(PENDULUM), STATES)
    assert marks(picture, "stable") == pytest.approx([0], abs=1e-12)
    assert marks(picture, "unstable") == pytest.approx([-pi, pi], abs=1e-12)


@pytest.mark.long
def test_every_corner_of_a_level_has_the_energy_of_the_level():
    problem = problem_of(PENDULUM)
    energy = RemainingFreedom(problem).energy
    picture, _ = portrait(problem, STATES)
    levels = curves(picture, "level")
    assert len(levels) >= 7
    for level in levels:
        values = [energy(*point) for piece in level.pieces for point in piece]
        assert max(values) - min(values) < 1e-9 * 30


@pytest.mark.long
def test_a_bead_on_a_fast_hoop_has_two_minima_and_two_separatrices():
    picture, _ = portrait(problem_of(HOOP), MOTION)
    theta = acos(9.81 / 16)  # Goldstein, exercise 2.18
    assert marks(picture, "stable") == pytest.approx([-theta, theta], abs=1e-12)
    assert marks(picture, "unstable") == pytest.approx([-pi, 0, pi], abs=1e-12)
    assert len(curves(picture, "separatrix")) == 2
    assert len(curves(picture, "motion")) == 1


@pytest.mark.long
def test_the_motion_of_a_pendulum_that_turns_stays_within_one_turn():
    turning = PENDULUM.replace("theta': 0", "theta': 9")
    picture, _ = portrait(problem_of(turning), MOTION)
    [motion] = curves(picture, "motion")
    assert len(motion.pieces) > 5
    assert all(abs(theta) <= 1.5 * pi for piece in motion.pieces for theta, _ in piece)


@pytest.mark.parametrize(
    ("physics", "name"),
    [
        ("T: m*x'^2/2, V: k*x^2/2", "V"),
        ("T: m*(x'^2 + w^2*x^2)/2, V: k*x^2/2", "V_eff"),
        ("L: m*x'^2/2 - k*x^2/2", "V_eff"),
    ],
)
def test_the_potential_has_the_name_that_the_reduction_gives_it(physics, name):
    head = "coordinates: [x], parameters: {m: {value: 1}, k: {value: 3}, w: {value: 1}}"
    problem = lagcli.loads(f"{{{head}, {physics}, initial: {{x: 1}}}}")
    picture, _ = potential(problem, STATES)
    assert picture.panels[0].items[0].label.plain == name
    shown = str(lagcli.solve(problem, "reduction"))
    assert f"{name} = " in shown or name == "V"


def test_the_turning_points_of_keplers_effective_potential():
    picture, _ = potential(problem_of(KEPLER), STATES)
    energy, momentum = 0.72 - 1, 1.2
    a, e = -1 / (2 * energy), sqrt(1 + 2 * energy * momentum**2)
    found = marks(picture, "turning")  # Landau, Lifshitz, section 15: a (1 ± e)
    assert found == pytest.approx([a * (1 - e), a * (1 + e)], rel=1e-12)
    assert marks(picture, "stable") == pytest.approx([momentum**2], rel=1e-12)
    assert picture.notes == ("For the constant momenta of the initial state: p_φ = 1.2.",)


@pytest.mark.long
def test_a_constraint_leaves_one_degree_of_freedom():
    on_rod = """
coordinates: [r, theta]
parameters: {m: {value: 1}, g: {value: 9.81}, l: {value: 2}}
T: m*(r'^2 + r^2*theta'^2)/2
V: -m*g*r*cos(theta)
constraints: {rod: r = l}
initial: {theta: 1}
"""
    picture, _ = portrait(problem_of(on_rod), STATES)
    [separatrix] = curves(picture, "separatrix")
    for theta, rate in separatrix.pieces[0]:
        assert abs(abs(rate) - 2 * sqrt(9.81 / 2) * cos(theta / 2)) < 1e-6


@pytest.mark.parametrize(
    ("problem", "sentence"),
    [
        ("coordinates: [x, y]\nT: x'^2 + y'^2\nV: x^2*y^2 + x", "x, y are left"),
        ("coordinates: [x]\nT: x'^2\nV: x^2*cos(t)", "the energy is not conserved"),
        ("coordinates: [x, y]\nT: x'^2 + y'^2", "every coordinate is cyclic"),
        ("coordinates: [x]\nfunctions: {U: [x]}\nT: x'^2\nV: U(x)", "'U' is left unspecified"),
    ],
)
def test_what_has_no_portrait_is_a_sentence(problem, sentence):
    with pytest.raises(CannotDraw, match=sentence):
        portrait(problem_of(problem), STATES)


def test_a_plane_of_columns_has_the_motion_alone():
    problem = problem_of(PENDULUM)
    from lagcli.expression import Name

    chosen = RunRequest(
        until=3.0, accuracy=1e-9, samples=31,
        columns=(Column("t", None), Column("theta", Name("theta"))),
    )  # fmt: skip
    picture, _ = plane(problem, chosen)
    [motion] = curves(picture, "motion")
    assert motion.pieces[0][0] == (1.0, 0.0)
    with pytest.raises(CannotDraw, match="draws one column over another, and 0 are given"):
        plane(problem, MOTION)
