"""Answers to `find`, against textbooks; each test's input is the YAML in it."""

from __future__ import annotations

import time
from random import Random

import pytest

from lagcli.diagnostics import ProblemError
from lagcli.mechanics.finding import find
from lagcli.statements.questions import Rewritten, Solutions

from .formulas import formula, formulas
from .questions import answers, roots, value

BARRELS = """
coordinates: {r: POSITIVE, theta: {unit: rad}, phi: {unit: rad}}
parameters: {m: POSITIVE, g: POSITIVE, R1: POSITIVE, R2: POSITIVE}
T: m*(r'^2 + r^2*theta'^2)/2 + m*R2^2*phi'^2/4
V: m*g*r*cos(theta)
constraints:
  surface: {equation: r = R1 + R2, multiplier: N, holds_while: N >= 0}
  rolling: (R1 + R2)*theta = R2*phi
initial: {theta: 0, theta': 0}
find:
  asked: {where: N = 0, for: theta}
  tension: {value: N, in_terms_of: [theta]}
"""


def test_a_solid_barrel_leaves_another_at_cos_four_sevenths():
    """Goldstein, chapter 2, exercise 14, with the inertia of a solid cylinder."""
    assert roots(BARRELS) == formulas("acos(4/7)")


def test_mirror_images_are_listed_once_and_the_note_says_so():
    note = answers(BARRELS)["asked"].note
    assert "equilibrium" in note
    assert "mirror images" in note


@pytest.mark.parametrize(("assume", "departures"), [(", assume: nonnegative", 1), ("", 2)])
def test_an_angle_of_one_sign_has_one_departure_from_rest(assume, departures):
    given = BARRELS.replace("theta: {unit: rad", f"theta: {{unit: rad{assume}")
    note = answers(given)["asked"].note
    assert ("both departures" in note) is (departures == 2)
    assert ("mirror images" in note) is (departures == 2)
    assert roots(given) == formulas("acos(4/7)")


def test_the_normal_force_between_barrels():
    assert value(BARRELS, "tension") == formula("m*g*(7*cos(theta) - 4)/3")


SPHERE = """
coordinates: {r: POSITIVE, theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, w: POSITIVE}
T: m*(r'^2 + r^2*theta'^2)/2
V: m*g*r*cos(theta)
constraints:
  surface: {equation: r = R, multiplier: N, holds_while: N >= 0}
initial: {theta: 0, theta': RATE}
find:
  asked: {where: N = 0, for: theta}
  rate: {where: theta = pi/6, for: theta'}
"""


@pytest.mark.long
def test_a_mass_leaves_a_sphere_at_cos_two_thirds():
    """Thornton and Marion, 5th ed., example 7.10."""
    assert roots(SPHERE.replace("RATE", "0")) == formulas("acos(2/3)")


@pytest.mark.long
def test_a_mass_pushed_to_one_side_leaves_a_sphere_on_that_side_only():
    assert roots(SPHERE.replace("RATE", "w")) == formulas("acos((2*g + R*w^2)/(3*g))")
    assert roots(SPHERE.replace("RATE", "-w")) == formulas("-acos((2*g + R*w^2)/(3*g))")


@pytest.mark.long
def test_a_velocity_that_would_come_only_after_the_contact_is_lost_is_not_listed():
    assert roots(SPHERE.replace("RATE", "w"), "rate") == formulas("sqrt(g*(2 - sqrt(3))/R + w^2)")


LOOP = """
coordinates: {r: POSITIVE, theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, v0: SPEED, tilt: {value: 0.1}}
points:
  bead: {position: [r*sin(theta), -r*cos(theta)], mass: m}
V: -m*g*r*cos(theta)
constraints:
  track: {equation: R = r, multiplier: N, holds_while: N >= 0}
initial: {theta: START, theta': v0/R}
find:
  asked: {where: N = 0, for: v0}
  leaves: {where: N = 0, for: theta}
  turns: {where: theta' = 0, for: theta}
  square: {value: theta'^2, in_terms_of: [theta]}
  rate: {value: theta', in_terms_of: [theta]}
"""


@pytest.mark.long
def test_the_least_speed_at_the_top_of_a_loop_is_sqrt_g_R():
    """Morin, *Introduction to Classical Mechanics*, section 5.1: N = 0 for v^2 = g R."""
    text = LOOP.replace("SPEED", "POSITIVE").replace("START", "pi")
    in_general = LOOP.replace("SPEED", "POSITIVE").replace("START", "0")
    assert roots(in_general) == formulas("sqrt(g*R*(2 - 3*cos(theta)))")
    assert roots(text) == formulas("sqrt(g*R)")


@pytest.mark.long
def test_a_bead_leaves_the_loop_on_the_way_up_and_not_before():
    """m v^2/R = -m g cos(theta) with the energy gives 3 cos(theta) = 2 - v0^2/(g R)."""
    text = LOOP.replace("SPEED", "POSITIVE").replace("START", "0")
    assert roots(text, "leaves") == formulas("acos((2*g*R - v0^2)/(3*g*R))")


@pytest.mark.long
@pytest.mark.parametrize(
    ("speed", "leaves", "turns"),
    [(1, 0, 2), (3, 1, 0), (5, 0, 0)],
    ids=["swings", "leaves the track", "goes round"],
)
def test_the_values_of_the_file_decide_what_is_reached(speed, leaves, turns):
    """With g = R = 1: v0^2 < 2 swings, 2 < v0^2 < 5 leaves, v0^2 > 5 goes round."""
    text = LOOP.replace("SPEED", f"{{assume: positive, value: {speed}/2 + 1/100}}")
    text = text.replace("START", "0").replace("R: POSITIVE", "R: {assume: positive, value: 1}")
    for name in "mg":
        text = text.replace(f"{name}: POSITIVE", f"{name}: {{assume: positive, value: 1}}")
    assert len(roots(text, "leaves") or []) == leaves
    assert len(roots(text, "turns") or []) == turns


@pytest.mark.long
def test_a_velocity_whose_sign_nothing_tells_is_given_by_both_roots():
    text = LOOP.replace("SPEED", "POSITIVE").replace("START", "0")
    found = answers(text)
    assert isinstance(found["rate"], Rewritten)
    assert found["rate"].value is None
    assert len(found["rate"].values) == 2
    assert "determined up to its sign" in found["rate"].note
    assert value(text, "square") == formula("(2*g*R*(cos(theta) - 1) + v0^2)/R^2")


PENDULUM = """
coordinates: {x: {}, y: {}}
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
points:
  bob: {position: [x, y], mass: m}
V: m*g*y
constraints: {CONSTRAINT}
initial: {x: l, y: 0}
find:
  asked: {value: lambda_rod, in_terms_of: [y]}
"""


def test_the_tension_of_a_pendulum_is_three_weights_at_the_bottom():
    """Released horizontally: 2 l |lambda| = 3 m g at y = -l."""
    text = PENDULUM.replace("CONSTRAINT", "rod: x^2 + y^2 = l^2")
    assert value(text) == formula("3*m*g*y/(2*l^2)")


def test_a_velocity_constraint_that_is_a_derivative_is_used_as_its_integral():
    """x x' + y y' = 0 keeps x^2 + y^2 = l^2 from the initial state."""
    assert value(PENDULUM.replace("CONSTRAINT", "rod: x*x' + y*y' = 0")) == formula("3*m*g*y/l^2")


def test_the_tension_of_a_pendulum_released_at_theta0():
    """Morin, section 6.3 (method): T = m g (3 cos theta - 2 cos theta0)."""
    text = """
coordinates: {r: POSITIVE, theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, theta0: POSITIVE}
T: m*(r'^2 + r^2*theta'^2)/2
V: -m*g*r*cos(theta)
constraints: {rod: r = l}
initial: {theta: theta0}
find:
  asked: {value: -lambda_rod, in_terms_of: [theta]}
"""
    assert value(text) == formula("m*g*(3*cos(theta) - 2*cos(theta0))")


@pytest.mark.long
def test_turning_points_of_the_spherical_pendulum():
    """Landau and Lifshitz, section 14, problem 1, started horizontally with phi' = w."""
    text = """
coordinates: {theta: {}, phi: {}}
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, w: POSITIVE}
T: m*l^2*(theta'^2 + sin(theta)^2*phi'^2)/2
V: -m*g*l*cos(theta)
initial: {theta: pi/2, phi: 0, theta': 0, phi': w}
find:
  asked: {where: theta' = 0, for: theta}
  rate: {value: phi', in_terms_of: [theta]}
"""
    assert roots(text) == formulas("acos((sqrt(16*g^2 + l^2*w^4) - l*w^2)/(4*g))", "pi/2")
    assert value(text, "rate") == formula("w/sin(theta)^2")


PROJECTILE = """
coordinates: {x: {}, z: {}}
parameters: {m: POSITIVE, g: POSITIVE, u: POSITIVE, w: POSITIVE}
T: m*(x'^2 + z'^2)/2
V: m*g*z
initial: {x': u, z': w}
find:
  asked: {where: z' = 0, for: z}
  range: {where: z = 0, for: x}
  path: {value: z, in_terms_of: [x]}
  velocity: {value: z', in_terms_of: [t]}
  height: {value: z, in_terms_of: [t]}
  flight: {where: z = 0, for: t}
"""


def test_a_projectile():
    assert roots(PROJECTILE) == formulas("w^2/(2*g)")
    assert roots(PROJECTILE, "range") == formulas("0", "2*u*w/g")
    assert value(PROJECTILE, "path") == formula("w*x/u - g*x^2/(2*u^2)")
    assert value(PROJECTILE, "velocity") == formula("w - g*t")
    assert value(PROJECTILE, "height") == formula("w*t - g*t^2/2")
    assert roots(PROJECTILE, "flight") == formulas("0", "2*w/g")


@pytest.mark.parametrize("seed", range(3))
def test_accelerations_that_depend_on_the_time_and_on_the_velocity(seed):
    """x'' = sum a_k t^k - k x' + driving: the velocity, and without drag the place."""
    rng = Random(seed)
    a, b, n = rng.randint(1, 9), rng.randint(1, 9), rng.randint(1, 3)
    drag = rng.choice(["0", "k"])
    text = f"""
coordinates: [x]
parameters: {{m: POSITIVE, k: POSITIVE, F: {{}}, w: POSITIVE, v: {{}}, c: {{}}}}
T: m*x'^2/2
dissipation: m*({drag})*x'^2/2
forces: {{x: m*({a}*t^{n} - {b} + F*cos(w*t))}}
initial: {{x: c, x': v}}
find:
  velocity: {{value: x', in_terms_of: [x, t]}}
  place: {{value: x, in_terms_of: [t]}}
"""
    gained = f"{a}*t^{n + 1}/{n + 1} - {b}*t + F*sin(w*t)/w"
    assert value(text, "velocity") == formula(f"v + {gained} - ({drag})*(x - c)")
    if drag == "0":
        covered = f"{a}*t^{n + 2}/{(n + 1) * (n + 2)} - {b}*t^2/2 + F*(1 - cos(w*t))/w^2"
        assert value(text, "place") == formula(f"c + v*t + {covered}")


def test_times_before_the_start_are_left_out():
    text = """
coordinates: [s]
parameters: {m: POSITIVE, g: POSITIVE, h: POSITIVE, u: POSITIVE}
T: m*s'^2/2
V: m*g*s
initial: {s: h, s': u}
find:
  asked: {where: s = 0, for: t}
"""
    assert roots(text) == formulas("(u + sqrt(u^2 + 2*g*h))/g")


def test_a_time_that_no_formula_gives_is_left_to_a_run():
    text = """
coordinates: [theta]
parameters: {g: POSITIVE}
L: theta'^2/2 + g*cos(theta)
initial: {theta: 1}
find:
  asked: {where: theta = 0, for: t}
"""
    assert roots(text) is None
    assert "simulate --stop-when" in answers(text)["asked"].note


STOPPED = """
coordinates: [x]
parameters: {m: POSITIVE, k: POSITIVE, v: POSITIVE}
T: m*x'^2/2
dissipation: m*k*x'^2/2
initial: {x': v}
find:
  asked: {where: x' = 0, for: x}
"""


def test_where_linear_drag_stops_a_body_it_comes_only_in_the_limit():
    assert roots(STOPPED) == formulas("v/k")
    assert answers(STOPPED)["asked"].note == "v/k is approached as t → ∞"


STATIC = """
coordinates: {theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, w: POSITIVE}
T: m*R^2*(theta'^2 + w^2*sin(theta)^2)/2
V: -m*g*R*cos(theta)
find:
  asked: {where: EQUATION, for: theta}
"""


@pytest.mark.parametrize(
    ("equation", "expected"),
    [
        ("theta'' = 0", ["-acos(g/(R*w^2))", "0", "acos(g/(R*w^2))", "pi"]),
        ("sin(theta) = 1/2", ["pi/6", "5*pi/6"]),
        ("sin(2*theta) = 0", ["-pi/2", "0", "pi/2", "pi"]),
        ("sin(theta) = 2", []),
        ("w*sin(theta) = g*cos(theta)", ["atan(g/w) - pi", "atan(g/w)"]),
        ("cos(theta)^2 + theta = 0", None),
    ],
)
def test_without_an_initial_state_all_angles_are_listed(equation, expected):
    expected = None if expected is None else formulas(*expected)
    assert roots(STATIC.replace("EQUATION", equation)) == expected


def test_numbers_are_given_where_radicals_do_not_serve():
    found = answers(STATIC.replace("EQUATION", "cos(theta)^3 + sin(theta) = 1/3"))["asked"]
    assert isinstance(found, Solutions)
    assert found.solutions is not None
    assert len(found.solutions) == 2


CONTRADICTION = """
coordinates: {x: {}, y: {}}
parameters: {m: POSITIVE, l: {assume: positive, value: 1}}
T: m*(x'^2 + y'^2)/2
constraints: {rod: x^2 + y^2 = l^2}
initial: {STATE}
find:
  asked: {value: x'^2 + y'^2, in_terms_of: []}
"""


@pytest.mark.parametrize(
    ("state", "message"),
    [
        ("x: 2*l, y: 0", "does not satisfy constraint 'rod'"),
        ("x: 0.6, y: 0.7", "does not satisfy constraint 'rod'"),
        ("x: 0", "several values of 'y'"),
        ("x: 0, y: l, y': 1", "does not satisfy constraint 'rod'"),
    ],
)
def test_an_initial_state_that_no_constraint_allows_is_an_error(state, message):
    with pytest.raises(ProblemError) as caught:
        answers(CONTRADICTION.replace("STATE", state))
    [diagnostic] = caught.value.diagnostics
    assert message in diagnostic.message
    assert diagnostic.span.line == 6


def test_a_parameter_that_no_law_gives_for_the_whole_motion_is_that_of_the_start():
    """Landau and Lifshitz, section 14, problem 1: the conical pendulum, w^2 = g/(l cos)."""
    text = """
coordinates: {theta: {}, phi: {}}
parameters: {m: POSITIVE, l: POSITIVE, g: POSITIVE, theta0: {}, w: POSITIVE}
T: m*l^2*(theta'^2 + sin(theta)^2*phi'^2)/2
V: -m*g*l*cos(theta)
initial: {theta: theta0, phi': w}
find:
  asked: {where: theta'' = 0, for: w}
"""
    assert roots(text) == formulas("sqrt(g/(l*cos(theta0)))")
    assert "initial state" in answers(text)["asked"].note


def test_a_total_momentum_that_the_constraints_conserve_is_used_with_its_centre_of_mass():
    """M X' + m x' = 0 and M X + m x = 0, of a block that slides down a movable wedge."""
    text = """
coordinates: {X: {}, x: {}, y: {}}
parameters: {M: POSITIVE, m: POSITIVE, alpha: POSITIVE, g: POSITIVE}
T: M*X'^2/2 + m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {contact: {equation: y = (X - x)*tan(alpha), multiplier: N}}
initial: {X: 0, x: 0}
find:
  asked: {value: X'^2, in_terms_of: [X]}
"""
    assert value(text) == formula("-2*m*g*X*sin(alpha)*cos(alpha)/(M + m*sin(alpha)^2)")


def test_the_total_momentum_of_masses_that_attract_each_other_is_used():
    """Two masses on a spring, m1 struck: V of the relative motion, mu = m1 m2/(m1 + m2)."""
    text = """
coordinates: {x: {}, y: {}}
parameters: {m: POSITIVE, M: POSITIVE, k: POSITIVE, v: POSITIVE}
T: (m*x'^2 + M*y'^2)/2
V: k*(x - y)^2/2
initial: {x': v}
find:
  asked: {value: x', in_terms_of: [y']}
"""
    assert value(text) == formula("v - M*y'/m")


def test_what_initial_leaves_out_follows_from_the_constraints():
    assert value(CONTRADICTION.replace("STATE", "x: 0, y: l, x': 3")) == formula("9")


def test_what_several_constraints_determine_together_is_filled_in():
    text = """
coordinates: [x, y, z]
parameters: {m: POSITIVE, g: POSITIVE, a: POSITIVE, w: POSITIVE}
T: m*(x'^2 + y'^2 + z'^2)/2
V: m*g*z
constraints: {sum: x + y = 2*z, difference: x - 2*y = a}
initial: {z: a, z': w}
find:
  asked: {value: x'^2, in_terms_of: [z]}
"""
    # x' = 4 z'/3, y' = 2 z'/3, so 29 (z'^2 - w^2)/18 = g (a - z)
    assert value(text) == formula("(4/3)^2*(w^2 + 18*g*(a - z)/29)")


@pytest.mark.long
def test_a_state_that_is_allowed_for_the_values_of_the_file_only_is_told():
    found = answers(CONTRADICTION.replace("STATE", "x: 0.6, y: 0.8"))["asked"]
    assert "values of the file only" in found.note


KEPLER = """
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, w: POSITIVE, a: POSITIVE, k: POSITIVE}
T: m*(r'^2 + r^2*phi'^2)/2
V: -k/r
initial: {r: a, phi: 0, phi': w}
find:
  asked: {where: r' = 0, for: r}
  speed: {where: r = 2*a, for: r'}
  momentum: {value: m*r^2*phi', in_terms_of: [p_phi]}
"""


@pytest.mark.long
def test_the_apsides_of_a_kepler_ellipse():
    """Landau and Lifshitz, section 15: the other apsis of an orbit that starts at one."""
    assert roots(KEPLER) == formulas("m*w^2*a^4/(2*k - m*w^2*a^3)", "a")


@pytest.mark.long
def test_a_bound_orbit_passes_each_distance_outwards_and_inwards():
    root = "sqrt(3*w^2*a^2/4 - k/(m*a))"
    assert roots(KEPLER, "speed") == formulas(f"-{root}", root)


@pytest.mark.long
def test_momenta_may_stay_in_an_answer():
    assert value(KEPLER, "momentum") == formula("p_phi")


def test_what_is_left_open_does_not_depend_on_the_machine(monkeypatch):
    """The limit is a count: a slower clock stops at the same place."""
    monkeypatch.setattr(find, "UNITS", 20_000)
    found = []
    for seconds in (0.0, 1e6):
        monkeypatch.setattr(time, "process_time", lambda seconds=seconds: seconds)
        found.append(answers(BARRELS))
    assert found[0] == found[1]
    assert found[0]["tension"].value is None
    assert "too much work" in found[0]["tension"].note


DRIVEN = """
coordinates: {r: POSITIVE, phi: {}, z: {}}
parameters: {m: POSITIVE, w: POSITIVE, b: POSITIVE, g: POSITIVE, a: POSITIVE}
T: m*(r'^2 + r^2*phi'^2 + z'^2)/2
V: m*g*z
constraints: {turning: "%s", wire: "%s"}
initial: {r: b, r': 0}
find: {asked: {value: r'^2, in_terms_of: [r]}}
"""


@pytest.mark.parametrize("turning", ["phi = w*t", "w*t - phi = 0", "2*phi = 2*w*t + pi"])
@pytest.mark.parametrize(
    ("wire", "known"),
    [
        ("z = 0", "w^2*(r^2 - b^2)"),
        ("z = a*r", "(w^2*(r^2 - b^2) - 2*g*a*(r - b))/(1 + a^2)"),
        ("z = a*r^2", "(w^2 - 2*g*a)*(r^2 - b^2)/(1 + 4*a^2*r^2)"),
    ],
)
def test_a_bead_on_a_turning_wire_keeps_the_energy_in_the_turning_frame(turning, wire, known):
    """h - w p_phi (Jacobi): neither h nor p_phi is constant (Goldstein, section 2.7)."""
    assert value(DRIVEN % (turning, wire)) == formula(known)


def test_a_root_says_where_it_is_real():
    """A ball struck at the top of a sphere leaves at once beyond v0^2 = g R."""
    text = """
coordinates: {r: {assume: positive}, a: {assume: nonnegative}}
parameters: {m: {assume: positive}, g: {assume: positive}, R: {assume: positive}, v0: {assume: positive}}
T: m*(r'^2 + r^2*a'^2)/2
V: m*g*r*cos(a)
constraints: {surface: {equation: r = R, multiplier: N, holds_while: N >= 0}}
initial: {r: R, a: 0, a': v0/R}
find: {leaves: {where: N = 0, for: a}}
"""
    assert "real for v0^2 ≤ " in answers(text)["leaves"].note


@pytest.mark.parametrize("order", ["r, phi", "phi, r"])
def test_the_other_turning_point_has_its_condition(order):
    """Kepler: from r0 with v0 across, r = m r0² v0²/(2 k - m r0 v0²) is there for v0 below escape."""
    text = f"""
coordinates: {{{order.replace("r", "r: POSITIVE").replace("phi", "phi: ")}}}
parameters: {{m: POSITIVE, k: POSITIVE, r0: POSITIVE, v0: POSITIVE}}
T: m*(r'^2 + r^2*phi'^2)/2
V: -k/r
initial: {{r: r0, phi: 0, phi': v0/r0}}
find: {{asked: {{where: r' = 0, for: r}}}}
"""
    assert set(roots(text)) == {formula("r0"), formula("m*r0^2*v0^2/(2*k - m*r0*v0^2)")}
    assert answers(text)["asked"].note == "positive for m*r0*v0^2 < 2*k"
