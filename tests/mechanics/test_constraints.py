"""Constraints: sign, kind, redundancy, contradiction; each test's input is the YAML in it."""

from __future__ import annotations

import pytest
import sympy

from lagcli.diagnostics import ProblemError
from tests.solved import solve

from .derived import derive, same

COIN = """
coordinates: [x, y, theta, phi]
parameters: {m: {assume: positive}, R: {assume: positive}}
T: m*(x'^2 + y'^2)/2 + m*R^2*theta'^2/4 + m*R^2*phi'^2/8
constraints:
  along: x' = R*theta'*cos(phi)
  across: y' = R*theta'*sin(phi)
"""


def test_the_multiplier_of_a_floor_is_the_normal_force_upwards():
    """N = m g for f = y: d/dt(dL/dy') - dL/dy = m y'' + m g = N."""
    d = derive(
        "coordinates: [y]\nparameters: [m, g]\nT: m*y'^2/2\nV: m*g*y\nconstraints: {floor: y}"
    )
    assert d.dynamics.motion is not None
    assert same(d, d.dynamics.motion.multipliers[0], "m*g")


def test_the_same_constraint_written_the_other_way_has_the_other_sign():
    d = derive(
        "coordinates: [y]\nparameters: [m, g]\nT: m*y'^2/2\nV: m*g*y\nconstraints: {floor: 0 = y}"
    )
    assert d.dynamics.motion is not None
    assert same(d, d.dynamics.motion.multipliers[0], "-m*g")


def test_a_rolling_coin_is_nonholonomic():
    """Goldstein, 3rd ed., section 1.3, the vertical rolling disk."""
    kinds = derive(COIN).dynamics.constraints.kinds
    assert kinds == {"along": "nonholonomic", "across": "nonholonomic"}


def test_a_coin_that_rolls_straight_ahead_is_integrable():
    """With phi' = 0 as well, x - R theta cos phi is constant: the same forms, integrable."""
    kinds = derive(COIN + "  straight: phi' = 0\n").dynamics.constraints.kinds
    assert set(kinds.values()) == {"integrable"}


@pytest.mark.parametrize(
    ("constraint", "kind"),
    [
        ("y*x' + x*y' = 0", "integrable"),  # d(x y)
        ("x' + x*y'/y = 0", "integrable"),  # with the integrating factor y
        ("z' = y*x'", "nonholonomic"),  # dz - y dx, the contact form
        ("z' = x*x' + y*y'", "integrable"),
        ("x' = t*y' + 1", "nonholonomic"),  # dx - t dy - dt, in (x, y, t)
        ("x' = 2*t*y + t^2*y'", "integrable"),  # d(x - t^2 y)
    ],
)
def test_frobenius(constraint: str, kind: str):
    d = derive(
        f"coordinates: [x, y, z]\nT: (x'^2+y'^2+z'^2)/2\nconstraints: {{c: \"{constraint}\"}}"
    )
    assert d.dynamics.constraints.kinds == {"c": kind}


def test_one_of_two_velocity_constraints_may_be_integrable():
    """The derived system of {dz - y dx, dw - dx} keeps dw - dx alone."""
    d = derive(
        "coordinates: [x, y, z, w]\nT: (x'^2+y'^2+z'^2+w'^2)/2\n"
        "constraints: {contact: \"z' = y*x'\", tied: \"w' = x'\"}"
    )
    assert d.dynamics.constraints.kinds == {"contact": "nonholonomic", "tied": "integrable"}


def test_a_constraint_given_twice_is_named_and_the_motion_stays():
    d = derive(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, g: {}, l: {assume: positive}}\n"
        "T: m*(x'^2+y'^2)/2\nV: m*g*y\n"
        "constraints: {rod: x^2 + y^2 = l^2, again: 2*x^2 + 2*y^2 = 2*l^2}"
    )
    dynamics = d.dynamics
    assert dynamics.redundant == ("again",)
    assert dynamics.degrees_of_freedom == 1
    assert dynamics.motion is not None
    assert dynamics.motion.multipliers == (None, None)
    assert dynamics.total_constraint_force is not None


def test_of_three_multipliers_the_one_that_is_unique_is_given():
    """A block in a corner held by two equal walls: the floor's force is unique, theirs is not."""
    d = derive(
        "coordinates: [x, y]\nparameters: [m, g, F]\nT: m*(x'^2+y'^2)/2\nV: m*g*y + F*x\n"
        "constraints: {wall: x, other_wall: 3*x, floor: y}"
    )
    assert d.dynamics.motion is not None
    wall, other, floor = d.dynamics.motion.multipliers
    assert (wall, other) == (None, None)
    assert same(d, floor, "m*g")


@pytest.mark.parametrize(
    "constraint",
    [
        "1/(2*x) = 9", "1/x = 50", "1/x + y = 50", "log(x) = 5", "log(x) + log(y) = 9",
        "tan(x) = 300", "4*cosh(b) = 1/(2*x)",
    ],
)  # fmt: skip
def test_a_constraint_on_which_full_newton_steps_diverge_is_satisfied(constraint: str):
    """Residual halving (damped Newton) arrives; a pole lies between the start and the surface."""
    text = (
        "coordinates: [x, y]\nparameters: {b: {assume: positive}}\nT: (x'^2 + y'^2)/2\n"
        f"constraints: {{c: {constraint}}}"
    )
    d = derive(text)
    assert d.dynamics.independent_constraints == (0,)
    assert not solve(d.problem, ["accelerations", "multipliers"]).warnings


@pytest.mark.parametrize(
    "constraints",
    [
        "{a: x^2 + y^2 = l^2, b: x^2 + y^2 = 2*l^2}",
        "{a: x' = 1, b: x' = 2}",
        "{a: x = t, b: x' = 2}",
    ],
)
def test_contradictory_constraints_are_an_error_that_names_one(constraints: str):
    text = f"coordinates: [x, y]\nparameters: {{l: {{assume: positive}}}}\nT: (x'^2+y'^2)/2\nconstraints: {constraints}"
    with pytest.raises(ProblemError) as caught:
        _ = derive(text).dynamics.independent_constraints
    [diagnostic] = caught.value.diagnostics
    assert "cannot be satisfied" in diagnostic.message
    assert diagnostic.span.line == 4


@pytest.mark.long
def test_a_constraint_without_an_equation_says_what_it_means():
    text = "coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nconstraints: {rod: 1 + x^2 + y^2}"
    with pytest.raises(ProblemError, match="without '=' it means = 0"):
        _ = derive(text).dynamics.independent_constraints


@pytest.mark.parametrize("constraint", ["x'^2 + y'^2 = 1", "x'*y' = 0", "sqrt(1 + x'^2) = 2"])
def test_a_constraint_that_is_not_linear_in_the_velocities_is_refused(constraint: str):
    text = f"coordinates: [x, y]\nT: (x'^2+y'^2)/2\nconstraints: {{c: \"{constraint}\"}}"
    with pytest.raises(ProblemError) as caught:
        _ = derive(text).dynamics
    assert "not linear in the velocities" in caught.value.diagnostics[0].message


def test_squares_that_cancel_leave_a_linear_constraint():
    d = derive(
        "coordinates: [x, y]\nT: (x'^2+y'^2)/2\nconstraints: {c: \"(x' + y)^2 - x'^2 - y^2 = 0\"}"
    )
    assert d.dynamics.constraints.kinds == {"c": "integrable"}  # 2 y x' = 0


def test_massless_coordinates_are_solved_by_their_constraints():
    """A massless pulley coordinate s with s = x - y: the Hessian is singular, the motion is not."""
    d = derive(
        "coordinates: [x, s]\nparameters: [m, g]\nT: m*x'^2/2\nV: m*g*x\nconstraints: {tie: s = 2*x}"
    )
    assert d.dynamics.motion is not None
    assert same(d, d.dynamics.motion.accelerations[1], "-2*g")


def test_a_lagrangian_linear_in_the_velocities_is_singular_along_all_coordinates():
    d = derive("coordinates: [x, y]\nL: x*y' - y*x' - x^2 - y^2")
    assert d.dynamics.motion is None
    assert d.dynamics.degenerate == (0, 1)


def test_a_lagrangian_of_a_difference_is_singular():
    """L = (x' - y')^2/2 has the gauge freedom x, y -> x + f(t), y + f(t)."""
    d = derive("coordinates: [x, y]\nL: (x' - y')^2/2")
    assert d.dynamics.motion is None
    assert d.dynamics.degenerate == (0, 1)


@pytest.mark.parametrize(
    ("text", "demanded"),
    [
        ("{coordinates: [x], L: x}", "-1"),
        ("{coordinates: [x, y], parameters: [k], L: x'^2/2 + k*y}", "-k"),
        ("{coordinates: [x, y], L: x*y' - y*x' - x^2 - y^2}", None),
        ("{coordinates: [x], L: x*x'}", None),
    ],
)
def test_equations_without_a_solution_are_told_from_those_with_too_many(text, demanded):
    d = derive(text)
    found = d.dynamics.contradiction
    assert (found is None) if demanded is None else same(d, found, demanded)


@pytest.mark.long
def test_the_square_of_a_constraint_is_told_from_a_contradiction():
    text = "coordinates: [x, y]\nT: (x'^2+y'^2)/2\nconstraints: {a: (x - y)^2/x = 0}"
    with pytest.raises(ProblemError) as caught:
        _ = derive(text).dynamics.independent_constraints
    [diagnostic] = caught.value.diagnostics
    assert diagnostic.message == "the derivatives of constraint 'a' vanish where it holds"
    assert diagnostic.hint == "write it without the power"


LINKAGE = """
coordinates: [q1, q2, q3]
parameters: [g]
points:
  one: {{position: [{first}], mass: 2}}
  two: {{position: [{second}], mass: 3}}
constraints:
  across: {across} = 4
  up: {up} = 0
"""


@pytest.mark.parametrize("relative", [False, True])
@pytest.mark.parametrize("where", [1, 2])
def test_constraints_determine_the_motion_of_a_massless_link(relative, where):
    """The third link has no mass: M is singular, M and A together are not."""
    angles = ("q1", "q1 + q2", "q1 + q2 + q3") if relative else ("q1", "q2", "q3")
    lengths = (1, 2, 3)

    def end(function, count):
        return " + ".join(
            f"{length}*{function}({angle})"
            for length, angle in zip(lengths[:count], angles[:count], strict=True)
        )

    first, second = (f"{end('cos', k)}, {end('sin', k)}" for k in (min(where, 1), 2))
    d = derive(LINKAGE.format(first=first, second=second, across=end("cos", 3), up=end("sin", 3)))
    assert d.dynamics.degenerate == (2,)
    assert d.dynamics.undetermined == ()


def test_a_coordinate_that_nothing_determines_is_named():
    d = derive("coordinates: [x, y, z]\nT: x'^2/2\nV: x + y\nconstraints: {c: y = x^2}")
    assert 2 in d.dynamics.undetermined
    assert d.dynamics.motion is None


@pytest.mark.long
def test_points_on_a_triangle_of_rods_accelerate_like_each_other():
    """At a spin w about the centre of mass r'' = -w² (r - r_c), with no coordinate below."""
    rods = "".join(
        f"  {a}{b}: (x{a} - x{b})^2 + (y{a} - y{b})^2 = a^2\n" for a, b in ("12", "23", "31")
    )
    d = derive(
        "coordinates: [x1, y1, x2, y2, x3, y3]\nparameters: [m, a]\n"
        f"T: m*({' + '.join(f'x{k}' + chr(39) + f'^2 + y{k}' + chr(39) + '^2' for k in '123')})/2\n"
        f"constraints:\n{rods}"
    )
    assert d.dynamics.motion is not None
    w, a = sympy.symbols("w a")
    height = sympy.sqrt(3) * a / 6
    places = [-a / 2, -height, a / 2, -height, 0, 2 * height]
    rates = [w * (-places[i + 1] if i % 2 == 0 else places[i - 1]) for i in range(6)]
    values = dict(zip((s.name for s in d.system.q), places, strict=True))
    values |= dict(zip((s.name for s in d.system.qdot), rates, strict=True)) | {"a": a}
    for place, value in zip(places, d.dynamics.motion.accelerations, strict=True):
        put = value.xreplace({s: values[s.name] for s in value.free_symbols if s.name in values})
        assert sympy.simplify(put + w**2 * place) == 0
        assert not sympy.denom(sympy.together(value)).free_symbols & {*d.system.q}
