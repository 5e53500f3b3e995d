"""Equilibria at the poles of coordinates: those of the body are kept, those of the chart are not."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

import lagcli
from lagcli.evaluation import finite_value
from lagcli.expression import ZERO
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.reader import parse_text
from lagcli.record import replace
from lagcli.verification import verified

from .derived import derive


def found(text: str):
    states = equilibria(derive(text.replace("POSITIVE", "{assume: positive}")).dynamics).equilibria
    assert states is not None
    return {(*map(to_grammar, e.at.values()),): e for e in states}


SPHERE = """
coordinates: [theta, phi]
T: (theta'^2 + sin(theta)^2*phi'^2)/2
V: POTENTIAL
"""


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_the_poles_of_a_sphere(seed):
    """V = a cos + b cos^2: the poles are equilibria, stable where V'' > 0 along the meridians."""
    source = random.Random(seed)
    a, b = source.choice([-3, -2, -1, 1, 2, 3]), source.choice([-5, -4, 0, 0, 4, 5])
    states = found(SPHERE.replace("POTENTIAL", f"{a}*cos(theta) + ({b})*cos(theta)^2"))
    assert states[("0",)].verdict.stable is (-a - 2 * b > 0)
    assert states[("pi",)].verdict.stable is (a - 2 * b > 0)
    assert states[("0",)].indeterminate == ("phi",)
    assert states[("0",)].free == ()


@pytest.mark.parametrize("seed", range(4))
def test_the_modes_at_a_pole_are_those_of_cartesian_coordinates(seed):
    """A plane oscillator in a magnetic field, x = f(r) cos(phi), y = f(r) sin(phi), beside z."""
    source = random.Random(seed)
    A, b, k, m, c = source.randint(1, 4), 2 * (seed % 2), *(source.randint(1, 9) for _ in "kmc")
    f, slope = source.choice([("sin(r)", "cos(r)"), ("r", "1"), ("(r + r^3)", "(1 + 3*r^2)")])
    problem = lagcli.loads(f"""
coordinates: [z, r, phi]
L: "{A}*({slope}^2*r'^2 + {f}^2*phi'^2)/2 + {b}*{f}^2*phi'/2 - {k}*{f}^2/2 + {m}*z'^2/2 - {c}*z^2/2"
""")
    modes = lagcli.solve(problem, "modes")._answers.sections["modes"].modes
    found = [
        finite_value(mode.frequency)
        for mode in modes
        if mode.at["r"] == ZERO
        for _ in range(mode.multiplicity)
    ]
    larmor = b / (2 * A)
    root = (k / A + larmor**2) ** 0.5
    assert sorted(found) == pytest.approx(sorted([root - larmor, root + larmor, (c / m) ** 0.5]))


@pytest.mark.parametrize("seed", range(4))
def test_the_azimuth_of_a_pole_may_stand_in_the_positions_of_the_points(seed):
    """A bead in a bowl of revolution z = k s²/2, s = f(r), by positions: ω² = k g, twice."""
    source = random.Random(seed)
    m, g, k = (source.randint(1, 9) for _ in "mgk")
    f, turned = source.choice(["r", "sin(r)", "(r + r^3)"]), source.choice(["phi", "(1 - phi)"])
    problem = lagcli.loads(f"""
coordinates: [r, phi]
points:
  bead: {{position: ["{f}*cos({turned})", "{f}*sin({turned})", "{k}*{f}^2/2"], mass: {m}}}
V: {m * g * k}*{f}^2/2
""")
    [mode] = lagcli.solve(problem, "modes")._answers.sections["modes"].modes[:1]
    assert finite_value(mode.frequency) ** 2 == pytest.approx(k * g)
    assert mode.multiplicity == 2


@pytest.mark.parametrize("seed", range(4))
def test_the_modes_at_a_pole_of_a_bowl_that_a_constraint_gives(seed):
    """On the sphere r = R, with other coordinates that constraints fix or leave alone."""
    source = random.Random(seed)
    m, g, R, c = (source.randint(1, 9) for _ in "mgRc")
    radius = source.choice(["r = R", "R - r = 0", "2*r = 2*R"]).replace("R", str(R))
    held = source.choice(["", ", hold: z = 1"])
    problem = lagcli.loads(f"""
coordinates: [z, r, theta, phi]
T: {m}*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2 + z'^2)/2
V: {-m * g}*r*cos(theta) + {m * c}*z^2/2
constraints: {{sphere: {radius}{held}}}
""")
    modes = lagcli.solve(problem, "modes")._answers.sections["modes"].modes
    assert modes is not None
    low = [mode for mode in modes if mode.at["theta"] == ZERO]
    found = sorted(
        finite_value(mode.frequency) ** 2 for mode in low for _ in range(mode.multiplicity)
    )
    assert found == pytest.approx(sorted([g / R, g / R, *([] if held else [c])]))


SURFACE = """
coordinates: [z, r, theta, phi]
T: (r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2 + z'^2)/2
V: -{g}*r*cos(theta) + z^2/2
constraints: {{surface: {bends}}}
"""


@pytest.mark.parametrize("bends", ["r = 2 + theta^2*cos(phi)^2", "r = 2 + theta", "r = 2 + z"])
def test_a_surface_that_is_no_disk_about_a_pole_is_left_alone(bends):
    problem = lagcli.loads(SURFACE.format(g=3, bends=bends))
    modes = lagcli.solve(problem, "modes")._answers.sections["modes"].modes
    assert not [mode for mode in modes or () if mode.at["theta"] == ZERO and mode.pole]


@pytest.mark.parametrize(("g", "k"), [(3, -1), (2, "-1/2"), (5, "3/4")])
def test_a_surface_of_revolution_has_the_frequency_of_its_curvature(g, k):
    """r = 2 + k th²/2: V = -g r cos(th) = -2 g + g (2 - k) th²/2, T = 2 (th'² + th² phi'²)."""
    problem = lagcli.loads(SURFACE.format(g=g, bends=f"r = 2 + {k}*(1 - cos(theta))"))
    modes = lagcli.solve(problem, "modes")._answers.sections["modes"].modes
    low = [mode for mode in modes if mode.at["theta"] == ZERO]
    found = sorted(
        finite_value(mode.frequency) ** 2 for mode in low for _ in range(mode.multiplicity)
    )
    assert found == pytest.approx(sorted([g * (2 - float(Fraction(k))) / 4] * 2 + [1]))


@pytest.mark.parametrize("seed", range(3))
def test_an_upright_top_swings_as_a_pendulum_in_two_directions(seed):
    """Precession and spin have one axis there; without a spin the top is a spherical pendulum."""
    source = random.Random(seed)
    A, C, w = (source.randint(1, 9) for _ in "ACw")
    up = source.choice([1, -1])
    problem = lagcli.loads(f"""
coordinates: [phi, psi, theta]
T: {A}*(theta'^2 + sin(theta)^2*phi'^2)/2 + {C}*(psi' + phi'*cos(theta))^2/2
V: {up * w}*cos(theta)
""")
    found = lagcli.solve(problem, "modes")._answers.sections["modes"].modes
    values = {round(finite_value(mode.frequency), 9): mode.multiplicity for mode in found}
    assert values == {0: 1, round((w / A) ** 0.5, 9): 2}


def test_frequencies_at_a_pole_are_refuted_where_they_are_wrong():
    problem = lagcli.loads(SPHERE.replace("POTENTIAL", "3*cos(theta)"))
    answers = lagcli.solve(problem, "modes")._answers
    section = answers.sections["modes"]
    for frequency in ("sqrt(3)/2", "-sqrt(3)", "3"):
        [mode] = section.modes
        wrong = replace(section, modes=(replace(mode, frequency=parse_text(frequency)),))
        again = verified(problem, replace(answers, sections={"modes": wrong}))
        assert again.sections["modes"].modes is None
    assert verified(problem, answers).sections["modes"].modes == section.modes


@pytest.mark.parametrize("potential", ["sin(theta)*cos(phi)", "2*sin(theta)*sin(phi)"])
def test_a_pole_is_no_equilibrium_where_a_force_acts(potential):
    """At theta = 0 both derivatives vanish for some phi; the force along the sphere does not."""
    places = set(found(SPHERE.replace("POTENTIAL", potential)))
    assert not any(place[0] in {"0", "pi"} for place in places)


def test_the_origin_of_polar_coordinates():
    states = found("""
coordinates: {r: {assume: nonnegative}, phi: {}}
parameters: {k: POSITIVE}
T: (r'^2 + r^2*phi'^2)/2
V: k*r^2/2
""")
    assert states[("0",)].verdict.stable is True


def test_a_ball_that_rolls_has_no_equilibria_in_the_singularities_of_its_angles():
    states = found("""
coordinates: [x, alpha, beta, gamma]
parameters: {g: POSITIVE}
T: x'^2/2 + (beta'^2 + alpha'^2 + gamma'^2 + 2*alpha'*gamma'*cos(beta))/5
V: -g*x
constraints: {rolling: x' = beta'*cos(alpha) + gamma'*sin(beta)*sin(alpha)}
""")
    assert not states


def test_a_family_that_is_real_in_a_point_only_is_none():
    """Calogero and Moser: x^2 + y^2 - x y = 0 where all three meet."""
    assert not found("""
coordinates: [x, y]
T: x'^2/2 + y'^2/2
V: 1/x^2 + 1/y^2 + 1/(x - y)^2
""")
