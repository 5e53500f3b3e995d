"""Sentences about rest and small displacements: floors, skates, turntables, special values."""

from __future__ import annotations

import math
import random
import re

import mpmath
import pytest
import sympy

from lagcli.algebra.signs import sign
from lagcli.document import Paragraph
from lagcli.expression import Name
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.explaining.recurring import recurrences
from lagcli.mechanics.oscillations.small_oscillations import (
    SmallOscillations,
    equilibria,
    modes,
)
from lagcli.mechanics.reduction.statement import reduction
from lagcli.mechanics.rest.equilibria import _finite_where
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import Request, explain, state
from tests.marks import mostly_long

from .derived import derive
from .test_explanation import words


def said(text, title, *also):
    return words(explain(derive(text), also), title)


def one_freedom(text):
    motion = reduction(derive(text))[0].one_freedom
    assert motion is not None
    return motion


# -- one-sided constraints ------------------------------------------------------------------------

TRACK = (
    "{{coordinates: [r, u], parameters: {{m: {{assume: positive}}, g: {{assume: positive}}, "
    "R: {{assume: positive}}}}, T: m*(r'^2 + r^2*u'^2)/2, V: m*g*r*cos(u - {turned}), "
    "constraints: {{track: {{equation: '{equation}', multiplier: N, holds_while: N >= 0}}}}}}"
)


@pytest.mark.parametrize("turned", [0, "pi", "-pi/2"])
def test_a_period_about_a_minimum_needs_a_contact_that_pushes(turned):
    """On top of a sphere there is none below it; in a loop, the track carries at its lowest point.

    A condition on E excludes turning points at which the contact would have to pull.
    """
    outside = one_freedom(TRACK.format(turned=turned, equation="r = R"))
    assert outside.periods == ()
    inside = one_freedom(TRACK.format(turned=turned, equation="R = r"))
    assert len(inside.periods) == 1
    [[above]], [[below]] = ({*motion.turning_where} for motion in (outside, inside))
    assert (to_grammar(above.left), to_grammar(above.right)) == ("E", "0")
    assert (to_grammar(below.left), to_grammar(below.right)) == ("0", "E")


def test_the_sign_assumed_of_an_eliminated_coordinate_excludes_a_minimum():
    rod = (
        "{{coordinates: {{y: {{{assume}}}, th: {{}}}}, parameters: {{m: {{assume: positive}}, "
        "g: {{assume: positive}}, a: {{assume: positive}}}}, T: m*y'^2/2 + m*a^2*th'^2/6, "
        "V: m*g*y, constraints: {{floor: 'y = a*cos(th)'}}}}"
    )
    assert len(one_freedom(rod.format(assume="")).periods) == 1
    assert one_freedom(rod.format(assume="assume: nonnegative")).periods == ()


@pytest.mark.long
def test_no_modes_are_given_where_a_contact_may_open():
    text = (
        "{coordinates: [x, y, th], parameters: {m: {assume: positive}, g: {assume: positive}, "
        "a: {assume: positive}}, T: m*(x'^2 + y'^2)/2 + m*a^2*th'^2/6, V: m*g*y, constraints: "
        "{wall: {equation: x = a*sin(th), multiplier: N, holds_while: N >= 0}, "
        "floor: {equation: y = a*cos(th), multiplier: K, holds_while: K >= 0}}}"
    )
    assert modes(derive(text).dynamics).modes == ()
    assert "may open" in said(text, "Small oscillations", "modes")


# -- what is neutral ------------------------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("seed", range(4))
def test_a_blade_across_the_slope_is_not_without_a_force(seed):
    """m s'' = m g sin(alpha) cos(phi) along it: a turn about pi/2 lets it slide, as t^2."""
    source = random.Random(seed)
    mass, turn = source.randint(1, 5), source.randint(1, 3)
    text = (
        f"{{coordinates: [x, y, phi], parameters: {{g: {{assume: positive}}}}, "
        f"T: {mass}*(x'^2 + y'^2)/2 + phi'^2/2, V: -{mass}*g*x, "
        f"constraints: {{blade: x'*sin({turn}*phi) = y'*cos({turn}*phi)}}}}"
    )
    verdicts = [each.verdict for each in equilibria(derive(text).dynamics).equilibria or ()]
    assert verdicts
    assert all(v.stable is False and "constant acceleration" in v.reason for v in verdicts)
    assert "no force" not in said(text, "Equilibria", "equilibria")


@pytest.mark.parametrize("f", ["y", "2*y - y^3", "sin(y)", "y^2"])
def test_a_level_wire_that_may_be_tilted_is_no_rest_without_a_force(f):
    """(1 + f^2) x'' = -g f on z' = f(y) x' with y' = 0: K is 0 on the surface y = 0 alone."""
    text = (
        "{coordinates: [x, y, z], parameters: {g: {assume: positive}}, "
        "T: (x'^2 + y'^2 + z'^2)/2, V: g*z, "
        f"constraints: {{along: z' = ({f})*x', level: y' = 0}}}}"
    )
    verdicts = [each.verdict for each in equilibria(derive(text).dynamics).equilibria or ()]
    assert verdicts
    assert all(v.stable is False and "constant acceleration" in v.reason for v in verdicts)


@pytest.mark.parametrize("n", random.Random(31).sample(range(1, 9), 2))
@pytest.mark.parametrize(
    ("q", "constraint", "height"),
    [
        ("[x, y]", "x*y' = y*x'", "y"),  # a ray: r'' = -g sin(angle)
        ("[x, y]", "(x + {n}*y)*y' = y*(x' + {n}*y')", "y"),
        ("[x, y, z]", "y*z' = z*y'", "z"),  # a plane through an axis
    ],
)
def test_a_slope_on_the_surfaces_beside_it_moves_away(q, constraint, height, n):
    """Of integrable velocity constraints: it may be moved to another ray or plane."""
    T = " + ".join(f"{name}'^2/2" for name in q.strip("[]").split(", "))
    given = f"coordinates: {q}, T: {T}, constraints: {{c: {constraint.format(n=n)}}}"
    told = said(f"{{{given}, V: {n}*{height}}}", "Equilibria", "equilibria")
    assert "Unstable: near it, on other surfaces that are allowed, a force moves" in told
    free = said(f"{{{given}}}", "Equilibria", "equilibria")
    assert "Neutral: every possible position near it is an equilibrium." in free
    assert "table" not in free


@pytest.mark.parametrize("field", ["B", "-B", "2*B*k"])
def test_where_all_solutions_are_bounded_it_is_stable_without_a_reservation(field):
    """A charge in a uniform field is bound to a circle, Jackson, 3rd ed., section 12.2; a free one
    drifts away."""
    text = (
        "{coordinates: [x, y], parameters: {m: {assume: positive}, B: {assume: positive}, "
        "k: {assume: positive}}, "
        "L: \"m*(x'^2 + y'^2)/2 + (%s)*x*y'\"}"
    )
    assert "Stable: the equations" in said(text % field, "Equilibria", "equilibria")
    assert "Neutral: every" in said(text % "0", "Equilibria", "equilibria")


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("polar", [False, True])
def test_a_field_holds_what_is_across_it_and_nothing_along_it(seed, polar):
    """The drift is along the field alone, Jackson, 3rd ed., section 12.2; in polar coordinates
    the momentum of the azimuth holds the distance, and the azimuth may drift by its unit."""
    given = random.Random(seed)
    names = given.sample("xyzuvw", 3)
    a, b, along = names
    m, B = given.sample(range(1, 9), 2)
    sign = given.choice("+-")
    T = f"{m}*({a}'^2 + {b}'^2 + {along}'^2)/2 {sign} {B}*k*({a}*{b}' - {b}*{a}')"
    if polar:
        T = f"{m}*({a}'^2 + {a}^2*{b}'^2)/2 {sign} {B}*k*{a}^2*{b}'"
        names, along = [a, b], b
    kinds = ", ".join(f"{x}: {{assume: positive}}" if x == a and polar else x for x in names)
    q = f"{{{kinds}}}" if polar else f"[{kinds}]"
    q = q.replace(f", {b}}}", f", {b}: {{}}}}")
    text = f'{{coordinates: {q}, parameters: {{k: {{assume: positive}}}}, L: "{T}"}}'
    told = said(text, "Equilibria", "equilibria")
    assert f"Stable up to displacements of {along}" in told
    assert f"displacements of {along}," not in told


@pytest.mark.parametrize("inertia", random.Random(17).sample(range(1, 9), 2))
@pytest.mark.parametrize(
    ("F", "where"), [("sin(b)", "where … ≠ 0"), ("g*b", "where b ≠ 0"), ("g + b^2", "")]
)
def test_a_slope_that_may_be_level_makes_a_blade_leave_where_there_is_one(F, where, inertia):
    """s'' = F cos(phi) with F of the parameters alone: for F = 0 the blade is at rest anywhere."""
    text = (
        "{coordinates: [x, y, phi], parameters: {g: {assume: positive}, b: {}}, "
        f"T: (x'^2 + y'^2)/2 + {inertia}*phi'^2/2, V: -x*({F}), "
        "constraints: {blade: x'*sin(phi) = y'*cos(phi)}}"
    )
    told = said(text, "Equilibria", "equilibria")
    verdict = f"Unstable {where}. Near" if where else "Unstable: near"
    assert f"{verdict} it there are motions with a constant acceleration." in told
    block = f"and {where} it has fewer" if where else "and has fewer"
    assert f"The root is multiple{', ' if where else ' '}{block}" in said(
        text, "Small oscillations", "modes"
    )


@pytest.mark.parametrize("rate", ["W*x", "W*sin(x)", "W*x + W*y"])
def test_a_constraint_that_moves_with_the_place_is_not_linearised(rate):
    """On y' = W x the velocities allowed depend on the displacement: K - w^2 M is not the motion."""
    text = (
        "{coordinates: [x, y, z], parameters: {W: {assume: positive}}, "
        f"T: (x'^2 + y'^2 + z'^2)/2, constraints: {{belt: y' - x*z' = {rate}}}}}"
    )
    dynamics = derive(text).dynamics
    assert modes(dynamics).modes is None
    assert all(each.verdict.stable is None for each in equilibria(dynamics).equilibria or ())


def test_rest_everywhere_needs_no_equation():
    text = "{coordinates: [x, phi], T: x'^2/2 + phi'^2/2, constraints: {c: x'*sin(phi) = 0}}"
    assert "which they do everywhere" in said(text, "Equilibria", "equilibria")


def test_a_negative_square_is_no_oscillation_for_any_values():
    text = "{coordinates: [x], parameters: {k: {assume: positive}}, T: x'^2/2, V: -k*x^2/2}"
    assert "grows exponentially" in said(text, "Small oscillations", "modes")
    open_ = text.replace("positive", "real")
    assert "grows exponentially" not in said(open_, "Small oscillations", "modes")


# -- special values -------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_equal_weights_balance(seed):
    """M - m cos(th) with sin(th) = 0: there is an equilibrium for M = m, which is not denied."""
    factor = random.Random(seed).randint(1, 4)
    text = (
        "{coordinates: {r: {assume: positive}, th: {}}, parameters: {m: {assume: positive}, "
        "M: {assume: positive}, g: {assume: positive}}, T: (m + M)*r'^2/2 + m*r^2*th'^2/2, "
        f"V: g*r*(M - {factor}*m*cos(th))}}"
    )
    section = equilibria(derive(text).dynamics)
    assert section.equilibria == ()
    [condition] = section.unless or ()
    m, M = sympy.symbols("m M")
    assert sympy.solve(sympy.sympify(to_grammar(condition)), M) == [factor * m]
    assert "unless" in said(text, "Equilibria", "equilibria")


@pytest.mark.parametrize("seed", range(4))
def test_a_force_along_a_well_is_balanced_for_special_values_only(seed):
    """V = F x - k x cos(n (y - a)): F = ± k at cos = ± 1, where k x sin(n (y - a)) vanishes."""
    draw = random.Random(seed)
    n, a = draw.randint(1, 4), draw.randint(0, 3)
    text = (
        "{coordinates: {x: {assume: positive}, y: {}}, parameters: {k: {assume: positive}, F: {}}, "
        f"T: x'^2/2 + y'^2/2, V: F*x - k*x*cos({n}*(y - {a}))}}"
    )
    section = equilibria(derive(text).dynamics)
    assert section.equilibria == ()
    [condition] = section.unless or ()
    k, F = sympy.symbols("k F")
    assert set(sympy.solve(sympy.sympify(to_grammar(condition).replace("^", "**")), F)) == {k, -k}


@pytest.mark.parametrize(
    ("parameters", "V", "product"),
    [
        ("w: ", "g*cos(x) + 2*a*sin(x - w*t)", "w"),
        ("w: {assume: positive}", "g*cos(x) + 2*a*sin(x - w*t)", ""),
        ("A: , w: ", "g*cos(x) + A*x*cos(w*t)", "A*w"),
        ("A: , w: ", "A*sin(w*t - x) - g*cos(x)", "A*w"),
    ],
)
def test_without_its_drive_a_system_can_be_at_rest(parameters, V, product):
    """A rate or an amplitude that may be 0 leaves the equilibria of the system that is not driven.

    The conditions themselves need not have it as a factor, their rates of change have.
    """
    text = (
        f"{{coordinates: [x], parameters: {{g: {{assume: positive}}, a: {{assume: positive}}, "
        f"{parameters}}}, T: x'^2/2, V: '{V}'}}"
    )
    section = equilibria(derive(text).dynamics)
    assert section.equilibria == ()
    assert [to_grammar(each) for each in section.unless or ()] == [product] * bool(product)


def test_two_open_coefficients_that_must_both_vanish_are_not_denied():
    """k/(x + y)² and c/(x - y)² exclude each other, but for k = c = 0 the system rests anywhere."""
    text = (
        "{coordinates: {x: {assume: positive}, y: {}}, parameters: {k: , c: }, "
        "T: x'^2/2 + y'^2/2, V: k/(x + y) + c/(x - y)}"
    )
    assert equilibria(derive(text).dynamics).unless is None


def test_what_is_assumed_not_to_vanish_is_no_exception():
    """A force A t with A assumed nonzero: "unless A = 0" is void."""
    text = "{coordinates: [x], parameters: {A: {assume: nonzero}}, T: x'^2/2, V: -A*t*x}"
    section = equilibria(derive(text).dynamics)
    assert section.equilibria == ()
    assert section.unless == ()
    assert "unless" not in said(text, "Equilibria", "equilibria")


# -- forces on points that are guided -------------------------------------------------------------


@pytest.mark.long
@pytest.mark.parametrize("axis", [0, 1])
def test_a_force_across_the_path_of_a_guided_point_is_not_called_0(axis):
    """The rod of a pendulum pushes its support down, too, which the rail bears."""
    place = ["x", "0"] if axis == 0 else ["0", "x"]
    text = (
        "{coordinates: [x, u, v], parameters: {m: {assume: positive}, l: {assume: positive}}, "
        f"points: {{support: {{position: [{', '.join(place)}], mass: m}}, "
        "bob: {position: [u, v], mass: m}}, V: m*v, "
        f"constraints: {{rod: (u - {place[0]})^2 + (v - {place[1]})^2 = l^2}}}}"
    )
    fixed = "yx"[axis]
    told = said(text, "What the multipliers mean")
    assert f"support cannot move along {fixed}" in told
    assert "cannot move" in said(text, "Forces", "forces")


# -- rest under a drive ---------------------------------------------------------------------------


@pytest.mark.parametrize("factor", ["cos(w*t)", "(1 + exp(-w*t))", "(2 + sin(w*t))/t^2", "F(t)"])
def test_rest_at_all_times_is_rest(factor):
    """A factor of t in the force leaves its zeros where they are, a force of t alone has none."""
    head = (
        "{coordinates: [x, y], parameters: {w: {assume: positive}}, functions: {F: [t]}, "
        "T: (x'^2 + y'^2)/2, V: "
    )
    stands = equilibria(derive(f"{head}'{factor}*(x^2/2 - 2*x + y^2)'}}").dynamics)
    assert stands.at_all_times
    assert [[to_grammar(e) for e in each.at.values()] for each in stands.equilibria] == [["2", "0"]]
    assert stands.equilibria[0].verdict.stable is None
    pushed = derive(f"{head}'x^2/2 + y^2 - x*{factor}'}}").dynamics
    assert equilibria(pushed).equilibria == ()


def test_a_rest_of_a_family_at_each_time_is_found():
    """x cos t = y sin t is a line that turns: only its centre rests."""
    text = "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: (x*cos(t) - y*sin(t))^2/2}"
    found = equilibria(derive(text).dynamics)
    assert [[to_grammar(e) for e in each.at.values()] for each in found.equilibria] == [["0", "0"]]


@pytest.mark.parametrize("seed", range(3))
def test_kapitzas_pendulum_stands_where_the_averaged_potential_says_so(seed):
    """Landau, Lifshitz, Mechanics, 3rd ed., section 30, problem 1: upright for a^2 w^2 > 2 g l.

    The motion itself, with a drive of small amplitude, keeps to what is said of the average.
    """
    source = random.Random(seed)
    length, shift = source.choice([1, 2]), source.choice(["0", "pi/2", "1"])
    text = (
        (
            "{coordinates: [u], parameters: {g: {assume: positive}, a: {assume: positive}, "
            f"w: {{assume: positive}}}}, definitions: {{q: u + {shift}}}, "
            f"L: '{length}^2*u'^2/2 + {length}*a*w*u'*sin(q)*sin(w*t) + g*{length}*cos(q)'}}"
        )
        .replace("'*sin(q)", "''*sin(q)")
        .replace("^2*u'^2", "^2*u''^2")
    )
    derivation = derive(text)
    found = equilibria(derivation.dynamics).equilibria
    up = [each for each in found if each.verdict.unstable]
    assert len(found) == 2
    assert len(up) == 1
    system, [motion] = derivation.system, derivation.dynamics.motion.accelerations
    [where] = up[0].verdict.minimum
    build = system.build
    for speed, stands in ((2.5, True), (0.6, False)):  # a w over sqrt(g l)
        w = 60.0
        values = {"g": 1.0, "w": w, "a": speed * length**0.5 / w}
        put_in = {p: values[p.name] for p in system.parameters}
        difference = (build(where.left) - build(where.right)).xreplace(put_in)
        assert (difference > 0) == stands
        start = float(build(next(iter(up[0].at.values())))) + 0.02
        force = sympy.lambdify(
            (system.q[0], system.qdot[0], system.t), motion.xreplace(put_in), "math"
        )
        assert (_leaves(force, start) < 0.3) == stands


def _leaves(force, start):
    x, v, h, far = start, 0.0, 2 * math.pi / 60 / 24, 0.0
    for k in range(3600):  # 15 units of time, many periods of the slow motion
        a = force(x, v, k * h)
        middle = force(x + h * v / 2, v + h * a / 2, (k + 0.5) * h)
        x, v = x + h * (v + h * a / 2), v + h * middle
        far = max(far, abs(x - start))
    return far


# -- where coordinates end ------------------------------------------------------------------------


@pytest.mark.parametrize("power", ["r^2/2", "r^4", "r^2 + r^4"])
def test_no_equilibrium_is_denied_where_polar_coordinates_end(power):
    """The oscillator rests in the centre, which r > 0 does not reach; a falling body nowhere."""
    head = "{coordinates: {r: {assume: positive}, u: {}}, T: (r'^2 + r^2*u'^2)/2, V: "
    assert "with r > 0" in said(head + f"{power}}}", "Equilibria", "equilibria").replace("…", "r")
    for V in (f"{power} + 2*r", "-1/r"):
        assert "with" not in said(head + f"'{V}'}}", "Equilibria", "equilibria").split("unless")[0]


@pytest.mark.parametrize("seed", range(4))
def test_rest_of_a_charge_has_one_verdict_in_all_coordinates(seed):
    """In a magnetic field it stays: by linear equations, and by Routh's theorem in polar ones."""
    source = random.Random(seed)
    field, mass = source.choice([-3, -1, 2, 5]), source.randint(1, 4)
    plane = f"{{coordinates: [x, y], L: {mass}*(x'^2 + y'^2)/2 + {field}*(x*y' - y*x')/2}}"
    landau = f"{{coordinates: [x, y], L: {mass}*(x'^2 + y'^2)/2 + {field}*x*y'}}"
    polar = (
        "{coordinates: {r: {assume: positive}, u: {}}, "
        f"L: {mass}*(r'^2 + r^2*u'^2)/2 + {field}*r^2*u'/2}}"
    )
    for text in (plane, landau, polar):
        [found] = equilibria(derive(text).dynamics).equilibria
        assert found.verdict.stable is True


def test_static_friction_holds_at_its_limit():
    text = (
        "{coordinates: [x], parameters: {mu: {assume: positive}, a: {}}, T: x'^2/2, "
        "V: -a*x, forces: {x: -mu*sign(x')}}"
    )
    assert "At equality it rests" in said(text, "Equilibria", "equilibria")


# -- kinks of the potential -----------------------------------------------------------------------


def _lowest(V, spread=6.0, steps=40001):
    points = [-spread + 2 * spread * k / (steps - 1) for k in range(steps)]
    return min(points, key=V)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(8))
def test_rest_at_a_kink_is_the_minimum_of_a_convex_potential(seed):
    """c |x - a| + d |x - b| + k x^2/2 + f x has one minimum; it is found, at a kink or between."""
    source = random.Random(seed)
    c, d, k = (source.randint(1, 5) for _ in range(3))
    a, b, f = source.randint(-2, 0), source.randint(1, 2), source.randint(-9, 9)
    text = (
        f"{{coordinates: [x], T: x'^2/2, V: '{c}*abs(x - ({a})) + {d}*abs(x - {b}) + "
        f"{k}*x^2/2 + ({f})*x'}}"
    )
    derivation = derive(text)
    section = equilibria(derivation.dynamics)
    found = {float(derivation.system.build(each.at["x"])): each for each in section.equilibria}
    low = _lowest(lambda x: c * abs(x - a) + d * abs(x - b) + k * x * x / 2 + f * x)
    assert len(found) == 1
    [(place, each)] = found.items()
    assert abs(place - low) < 1e-3
    assert each.verdict.stable is True or "limit" in each.verdict.reason


@pytest.mark.parametrize("turn", ["x", "x + y", "2*x - y"])
def test_a_kink_holds_what_its_force_suffices_for(turn):
    """Two coordinates: along the kink the motion is free, across it V has a minimum."""
    text = (
        "{coordinates: [x, y], parameters: {c: {assume: positive}, F: {}}, T: (x'^2 + y'^2)/2, "
        f"V: 'c*abs({turn}) + (x^2 + y^2)/2 + F*({turn})'}}"
    )
    [each] = [e for e in equilibria(derive(text).dynamics).equilibria if e.kinked]
    assert {to_grammar(e) for e in each.at.values()} == {"0"}
    assert each.verdict.stable is True
    assert len(each.where) == 2


@pytest.mark.parametrize("inertia", ["1", "1 + abs(x)", "2 + abs(y)", "2 + abs(x - 1)*abs(y)"])
def test_a_kink_of_the_kinetic_energy_leaves_those_of_the_potential(inertia):
    """At rest T has no force: the minima of c |sin x| + y^2 hold, whatever the inertia of y."""
    text = (
        "coordinates: [x, y]\nparameters: {c: {assume: positive}}\n"
        f"T: x'^2/2 + y'^2*({inertia})/2\nV: c*abs(sin(x)) + y^2\n"
    )
    found = [e for e in equilibria(derive(text).dynamics).equilibria if e.kinked]
    assert {to_grammar(e.at["x"]) for e in found} == {"0", "pi"}
    assert all(each.verdict.stable for each in found)


@pytest.mark.parametrize(
    ("V", "period"),
    [
        ("cos(k*x)", "2*pi/k"),
        ("cos(3*k*x) + cos(2*k*x - 1)*0", "2*pi/(3*k)"),
        ("cos(k*x/2)^2 + sin(3*k*x)", "2*pi/k"),
        ("sin(2*pi*x/k)", "k"),
        ("cos(k*x) + k*x/3", None),  # a tilted washboard: the force repeats, V does not
        ("cos(k*x) + k^2*x^2", ""),
        ("cos(3*x)", ""),  # all in (-pi, pi] are listed
    ],
)
def test_places_of_rest_in_a_wave_repeat(V, period):
    """Of the shortest period of the force, as that of dV/dx in numbers."""
    text = f"{{coordinates: [x], parameters: {{k: {{assume: positive}}}}, T: x'^2/2, V: '{V}'}}"
    period = "2*pi/k" if period is None else period
    said = equilibria(derive(text).dynamics).periods
    assert {name: to_grammar(each) for name, each in said.items()} == (
        {"x": period} if period else {}
    )
    if period:
        k, place = sympy.symbols("k x")
        force = sympy.sympify(V.replace("^", "**")).diff(place).subs(k, sympy.Rational(7, 5))
        step = sympy.sympify(period).subs(k, sympy.Rational(7, 5))
        for here in (0.3, 1.7):
            moved = force.subs(place, here + step)
            assert abs(complex(moved - force.subs(place, here))) < 1e-9


# -- forces that are 0/0 at rest ------------------------------------------------------------------


@pytest.mark.parametrize(
    "system",
    [
        "coordinates: [x, y], T: m*(x'^2 + y'^2)/2, V: x^2 + y^2, dissipation: c*sqrt(x'^2 + y'^2)",
        "coordinates: [r, u], T: m*(r'^2 + r^2*u'^2)/2, dissipation: c*sqrt(r'^2 + r^2*u'^2)",
        (
            "coordinates: [x, y], T: m*(x'^2 + y'^2)/2, constraints: {line: 'y = 2*x'}, "
            "forces: {x: -c*x'/sqrt(x'^2 + y'^2), y: -c*y'/sqrt(x'^2 + y'^2)}"
        ),
    ],
    ids=["plane", "polar", "line"],
)
def test_nothing_is_concluded_from_a_force_without_a_value_at_rest(system):
    """Dry friction in a plane: -c v/|v| is 0/0 at rest, where it takes whatever is needed."""
    parameters = "parameters: {m: {assume: positive}, c: {assume: positive}}"
    text = f"{{{parameters}, {system}}}"
    assert equilibria(derive(text).dynamics).equilibria is None
    for also in ("equilibria", "steady_motions"):
        steps = explain(derive(text), [also]).steps
        assert "no value at rest" in str(steps[-1])


@pytest.mark.parametrize(("a", "b"), [(1, 1), (2, 3), (3, 1)])
def test_modes_are_missing_where_no_square_of_a_frequency_is_real(a, b):
    """T = m (a x'^2 - b y'^2)/2 and V = x y: m^2 a b W^2 + 1 = 0, at every value of m."""
    text = (
        "{coordinates: [x, y], parameters: {m: {assume: positive}}, "
        f"T: m*({a}*x'^2 - {b}*y'^2)/2, V: x*y}}"
    )
    section = modes(derive(text).dynamics)
    assert not section.modes
    assert "is real" in section.reason


@pytest.mark.parametrize(
    ("c", "case"),
    [("1/2", "weak"), ("3/4", "weak"), ("1", "critical"), ("3/2", "strong"), ("8", "strong")],
)
def test_damping_in_numbers_is_one_of_three_cases(c, case):
    """x'' + 2 c x' + x = 0: c < 1, c = 1, c > 1 (Landau and Lifshitz, 3rd ed., section 25)."""
    text = f"{{coordinates: [x], T: x'^2/2, V: x^2/2, dissipation: '({c})*x''^2'}}"
    steps = str(explain(derive(text), ["modes"]).steps[-1])
    assert [name for name in ("weak", "critical", "strong") if f"({name} damping)" in steps] == [
        case
    ]


# -- what is denied, and what is not ----------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_rest_on_the_axis_of_polar_coordinates_is_not_denied(seed):
    """V has its minimum at R = z = 0, where R and phi are no coordinates (R > 0 is assumed)."""
    a, b = random.Random(seed).choices(range(1, 9), k=2)
    text = (
        "{coordinates: {R: {assume: positive}, phi: {}, z: {}}, "
        f"T: (R'^2 + R^2*phi'^2 + z'^2)/2, V: log({a} + R^2 + {b}*z^2)}}"
    )
    assert "no equilibrium with R > 0" in said(text, "Equilibria", "equilibria")


@pytest.mark.parametrize("force", ["F(t)", "m*X''(t)"])
def test_rest_is_not_denied_for_each_function_of_time(force):
    """A support with a constant acceleration has its plumb line: only in general there is none."""
    name = force.strip("m*(t)'")
    text = (
        "{coordinates: [th], parameters: {m: {assume: positive}, g: {assume: positive}}, "
        f"functions: {{{name}: [t]}}, T: m*th'^2/2, "
        f'V: "-m*g*cos(th) - ({force})*sin(th)"}}'
    )
    none = "In general this has no solution that holds at all times: there is no equilibrium."
    assert none in said(text, "Equilibria", "equilibria")


@pytest.mark.parametrize("one", ["m1", "k"])
@pytest.mark.parametrize("other", ["m2", "b"])
def test_an_equality_of_two_parameters_begins_with_the_first(one, other):
    """Atwood's machine: there is no equilibrium unless m1 = m2, whichever stands first in V."""
    first, second = sorted((one, other))
    for left, right in ((one, other), (other, one)):
        text = (
            f"coordinates: [x]\nparameters: {{{left}: , {right}: , g: {{assume: positive}}}}\n"
            f"T: x'^2/2\nV: g*({left} - {right})*x\n"
        )
        told = said(text, "Equilibria", "equilibria")
        assert f"there is no equilibrium unless {first} = {second}." in told


@pytest.mark.parametrize("size", ["8*m", "m/2", "m*a^2"])
def test_the_arc_length_is_proportional_to_a_function_without_a_number(size):
    """Of a cycloid, 4 a cos(phi/2): Landau and Lifshitz, section 21, problem."""
    text = (
        "{coordinates: [phi], parameters: {m: {assume: positive}, a: {assume: positive}}, "
        f"T: {size}*(1 - cos(phi))*phi'^2, V: m*a*cos(phi)}}"
    )
    blocks = [b for s in explain(derive(text), ["discovered"]).steps for b in s.blocks]
    said_of = [b.parts for b in blocks if "The arc length" in str(getattr(b, "parts", ""))]
    assert said_of
    assert all(to_grammar(parts[1]) == "cos(phi/2)" for parts in said_of)


@pytest.mark.parametrize(
    ("forces", "lead"),
    [
        ("u*F(0)", "In general this has no"),  # x'' = F(0) rests for each F with F(0) = 0
        ("u*F(0) + v", "In general these have no"),
        ("{a}*u", "This has no"),
        ("{a}*u + {a}*v", "This has no"),  # the same condition twice
        ("u + {a}*v^3", "These have no"),
    ],
)
def test_no_solution_is_said_in_the_number_of_the_conditions(forces, lead):
    forces = forces.format(a=random.Random(forces).randint(2, 9))
    text = f"{{coordinates: [u, v], functions: {{F: [d]}}, L: \"(u'^2 + v'^2)/2 + {forces}\"}}"
    assert f"{lead} solution: there is no equilibrium" in said(text, "Equilibria", "equilibria")
    assert f"{lead} solution: there is no" in said(text, "Steady motions", "steady_motions")


@pytest.mark.parametrize(
    ("constraint", "exceptions"),
    [
        ("x = z*tan(a)", []),
        ("x*cos(a) = z*sin(a)", ["cos(a)"]),
        ("z = x/tan(a)", ["cos(a)"]),
        ("z = x*tan(a)", ["sin(a)"]),
    ],
)
def test_an_exception_needs_a_value_of_the_parameter_that_the_file_allows(constraint, exceptions):
    """On a line at the angle a to the vertical a weight rests for cos(a) = 0: tan(a) is infinite."""
    text = (
        "{coordinates: [x, z], parameters: {m: {assume: positive}, g: {assume: positive}, a: {}}, "
        f'T: "m*(x\'^2 + z\'^2)/2", V: m*g*z, constraints: {{line: "{constraint}"}}}}'
    )
    found = state(derive(text), Request(sections=("equilibria", "steady_motions")))
    for name in ("equilibria", "steady_motions"):
        assert list(map(to_grammar, found.sections[name].unless)) == exceptions
    several = "there is no equilibrium" + (" unless" if exceptions else ".")
    assert several in said(text, "Equilibria", "equilibria")


@pytest.mark.parametrize(("g", "verdict"), [("{}", None), ("{assume: positive}", True)])
def test_rest_of_a_mass_that_grows_with_time(g, verdict):
    """m e^(g t) (x'' + g x' + w^2 x) = 0: damped for g > 0, growing for g < 0 (Caldirola, Kanai)."""
    text = (
        f"{{coordinates: [x], parameters: {{w: {{assume: positive}}, g: {g}}}, "
        "L: exp(g*t)*(x'^2 - w^2*x^2)/2}"
    )
    asked = Request(sections=("equilibria",))
    [rest] = state(derive(text), asked).sections["equilibria"].equilibria
    assert rest.verdict is not None
    assert rest.verdict.stable is verdict
    assert bool(rest.verdict.unstable) is (verdict is None)


# -- conditions -------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
def test_a_condition_that_another_implies_is_left_out(seed):
    """b + a cos(th) > 0 where cos(th) > 0, a > 0 and b > 0: one of the two is enough."""
    a, b = sympy.symbols("a b", positive=True)
    c = sympy.cos(sympy.Symbol("th", real=True))
    both = [c * (a * c + b), a * c + b]
    random.Random(seed).shuffle(both)
    [bound] = conditions(both, ["a", "b", "th"])
    assert (to_grammar(bound.left), to_grammar(bound.right)) == ("cos(th)", "0")


@pytest.mark.parametrize("seed", range(5))
def test_the_sign_of_a_number_less_a_root(seed):
    """k a - sqrt(k^2 a^2 - b^2) > 0, and k a - sqrt(k^2 a^2 + b^2) < 0."""
    a, b = sympy.symbols("a b", positive=True)
    k = random.Random(seed).randint(1, 9)
    real = k**2 * a**2 - b**2
    assert sign(k * a - sympy.sqrt(real), [real]) == 1
    assert sign(k * a - sympy.sqrt(k**2 * a**2 + b**2)) == -1
    assert sign(k * a - sympy.sqrt(a**2 + b**2)) == (-1 if k == 1 else None)


@pytest.mark.long
def test_a_top_on_a_floor_does_not_spin_below_it():
    """z = l cos(th) >= 0: with its axis downwards, th = pi, the centre would be below the floor."""
    text = (
        "{coordinates: {z: {assume: nonnegative}, phi: {}, th: {}, psi: {}}, parameters: {m: {assume: "
        "positive}, g: {assume: positive}, l: {assume: positive}, A: {assume: positive}, "
        "C: {assume: positive}}, T: m*z'^2/2 + A*(th'^2 + phi'^2*sin(th)^2)/2 + C*(psi' + "
        "phi'*cos(th))^2/2, V: m*g*z, constraints: {floor: z = l*cos(th)}}"
    )
    asked = Request(sections=("steady_motions",))
    motions = state(derive(text), asked).sections["steady_motions"].motions
    assert len(motions) == 2
    assert "pi" not in {to_grammar(x) for each in motions for x in each.at.values()}


@pytest.mark.parametrize(
    ("power", "verdict"),
    [(3, (False, False)), (4, (True, True)), (5, (False, False)), (6, (True, True))],
)
def test_damped_rest_in_a_flat_potential(power, verdict):
    """V = k x^n: asymptotically stable for even n (Merkin, section 3.3), its roots 0 and -c/m."""
    text = (
        "{coordinates: [x], parameters: {m: {assume: positive}, k: {assume: positive}, "
        f"c: {{assume: positive}}}}, T: m*x'^2/2, V: k*x^{power}, dissipation: c*x'^2/2}}"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria
    assert (rest.verdict.stable, rest.verdict.asymptotic) == verdict
    assert "Its roots are 0 and" in said(text, "Small oscillations", "modes")


@pytest.mark.parametrize(("a", "said_there"), [("U(x)", "Where"), ("a", ""), ("-3", "no Hamil")])
def test_where_the_momenta_do_not_determine_the_velocities(a, said_there):
    """p = v^3 + a v grows with v for a >= 0 only: below there are three velocities for some p."""
    text = (
        "{coordinates: [x], parameters: {a: {assume: positive}}, functions: {U: [x]}, "
        f"L: x'^4/4 + ({a})*x'^2/2 - x^2/2}}"
    )
    words = said(text, "Canonical equations", "canonical_equations")
    assert ("several branches" in words) is bool(said_there)
    assert said_there in words


@pytest.mark.parametrize("potential", ["(x^2 + y^2)^(n/2)", "(x^2 + y^2 + x*y)^n", "(x^2)^n + y^2"])
def test_rest_is_not_denied_at_0_to_an_open_power(potential):
    """grad V is 0 at 0 for large n, and has no value there for others."""
    text = f"{{coordinates: [x, y], parameters: [n], T: (x'^2 + y'^2)/2, V: '{potential}'}}"
    assert "there is no equ" not in said(text, "Equilibria", "equilibria")
    assert "there is no st" not in said(text, "Steady motions", "steady_motions")


@pytest.mark.parametrize("seed", range(3))
def test_a_frequency_that_may_not_be_real_is_said_to_be_one_only_where_it_is(seed):
    """Of the two of V = a x^2/2 + b y^2/2 those whose factor has no known sign."""
    signs = [("positive", "real"), ("real", "positive"), ("real", "real")][seed]
    text = (
        f"{{coordinates: [x, y], parameters: {{a: {{assume: {signs[0]}}}, b: {{assume: {signs[1]}}}"
        "}, T: (x'^2 + 3*y'^2)/2, V: a*x^2/2 + b*y^2/2}"
    )
    told = said(text, "Small oscillations", "modes")
    assert told.count("oscillates only where this is real") == signs.count("real")


@pytest.mark.parametrize("gap", ["x >= v*t", "x >= sin(v*t)", "y >= x + v*t", "x + y >= -v*t^2"])
def test_nothing_is_called_stable_that_a_moving_contact_may_reach(gap):
    """A wall that comes nearer throws away what rests before it."""
    text = "{coordinates: [x, y], parameters: [v], T: (x'^2 + y'^2)/2, contacts: {c: {gap: G}}}"
    for contact, stable in ((gap, False), (gap.replace("t", "1"), True)):
        told = said(text.replace("G", contact), "Equilibria", "equilibria")
        assert ("Neutral: " in told, "a contact moves" in told) == (stable, not stable)


@pytest.mark.long
@pytest.mark.parametrize("bowl", ["(x^2 + z^2)^2", "(x^2 + x*z + z^2)^3", "(2*x^2 + z^2)^2"])
def test_rest_at_the_bottom_of_a_flat_bowl_is_not_denied(bowl):
    """The gradient has a factor whose zeros are complex but for the bottom."""
    text = f"{{coordinates: [x, y, z], T: (x'^2 + y'^2 + z'^2)/2, V: y, constraints: {{b: y = {bowl}}}}}"
    assert "there is no equ" not in said(text, "Equilibria", "equilibria")


@pytest.mark.parametrize(
    ("T", "V", "reached"),
    [
        ("s'^2/(4*s) + s*p'^2", "s", True),
        ("s'^2/(4*s) + s*p'^2", "1/s", False),
        ("4*s^2*s'^2 + s^4*p'^2", "s^4", True),
        ("s'^2 + s^2*p'^2", "s^n", True),
        ("s'^2 + s^2*p'^2", "s", False),
    ],
)
def test_rest_at_the_origin_is_not_denied_by_powers_of_the_distance(T, V, reached):
    """r = sqrt(s), s^2 and s: the oscillator rests at 0, V = 1/r and r do not."""
    text = f"{{coordinates: {{s: {{assume: positive}}, p: {{}}}}, parameters: [n], T: {T}, V: {V}}}"
    assert ("with s > 0" in said(text, "Equilibria", "equilibria")) is reached


def test_conditions_stand_in_an_order_that_no_hash_decides():
    letters = sympy.symbols("b:h", real=True)
    found = list(_finite_where([1 / sympy.Mul(*letters)]))
    assert found == [letter**2 for letter in letters]


@pytest.mark.parametrize("constraint", ["y = v*t", "y' = v", "x - 2*y = v*t"])
def test_a_constraint_that_moves_with_the_body_is_not_said_to_do_work(constraint):
    """A free body that a guide accompanies at a constant velocity keeps its energy."""
    text = (
        "{coordinates: [x, y], parameters: [v], T: (x'^2 + y'^2)/2, "
        f'constraints: {{guide: "{constraint}"}}}}'
    )
    told = said(text, "The energy")
    assert "is conserved" in told
    assert "does work" not in told


HELD_TWICE = "{coordinates: [x, y], L: (x'^2 + y'^2)/2 - x^2, constraints: {a: %s, b: %s}}"


@pytest.mark.parametrize(
    "text",
    [
        "{coordinates: [x], H: p_x^4/4 + x^2/2}",
        HELD_TWICE % ("x*(y - 2*x) = 0", "(x^2 + 1)*(y - 2*x) = 0"),
    ],
)
def test_where_the_equations_have_no_linear_form_rest_is_undecided(text):
    """L grows as x'^(4/3) there; the rows of both constraints vanish, or are one."""
    dynamics = derive(text).dynamics
    assert all(e.verdict.stable is None for e in equilibria(dynamics).equilibria)
    assert "singular" in modes(dynamics).reason


@pytest.mark.parametrize("pull", ["x", "y"])
def test_the_azimuth_decides_nothing_at_a_pole(pull):
    """V of a saddle k x² - 2 k y² at the pole of a sphere: no minimum for any azimuth."""
    wave = {"x": "cos(b)^2", "y": "sin(b)^2"}[pull]
    text = (
        "coordinates: [a, b]\nparameters: {k: {assume: positive}, W: {}, n: {assume: positive}}\n"
        f"T: (a'^2 + (b' + W)^2*cos(a)^2)/2\nV: W^2*cos(a)^2/2 + (3*k*{wave} - n)*cos(a)^2/2\n"
    )
    poles = [e for e in equilibria(derive(text).dynamics).equilibria or () if e.indeterminate]
    assert poles
    assert all(e.verdict.minimum is None and e.verdict.stable is None for e in poles)
    assert all("b" not in e.at for e in poles)


# -- the order of the sentences -------------------------------------------------------------------


@pytest.mark.parametrize("power", random.Random(12).sample(range(1, 6), 2))
def test_no_solution_is_stated_of_the_conditions_not_of_polar_coordinates(power):
    """The conditions, what solves them, and then that steady rotations need other coordinates."""
    text = "{{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: -1/(x^2 + y^2)^({}/2)}}"
    told = said(text.format(power), "Steady motions", "steady_motions")
    assert told.index("These have no solution") < told.index("rotations of")


@pytest.mark.parametrize("strength", ["B", "B*(1 + x^2 + y^2)"])
def test_no_sentence_announces_conditions_that_vanish_everywhere(strength):
    text = (
        f"{{coordinates: [x, y], parameters: [B], L: (x'^2 + y'^2)/2 + {strength}*(x*y' - y*x')/2}}"
    )
    told = said(text, "Steady motions", "steady_motions")
    assert "the steady motions are the equilibria." in told
    assert "everywhere" not in told


@pytest.mark.parametrize("a", random.Random(12).sample(range(1, 9), 2))
def test_conditions_of_a_constraint_that_opens_are_said_to_be_of_its_contact(a):
    """A ladder upright away from the wall does not satisfy the wall's equation, and rests."""
    text = (
        "{coordinates: {x: , y: {assume: nonnegative}, th: }, V: m*g*y, "
        "parameters: {m: {assume: positive}, g: {assume: positive}}, "
        f"T: m*(x'^2 + y'^2)/2 + m*{a}*th'^2/6, constraints: {{wall: {{equation: 'x = {a}*sin(th)', "
        "multiplier: N, holds_while: N >= 0, on_loss: release}, "
        f"floor: {{equation: 'y = {a}*cos(th)', multiplier: K, holds_while: K >= 0}}}}}}"
    )
    told = said(text, "Equilibria", "equilibria")
    assert "'wall' is open here" in told
    assert re.findall("In contact: ([^.]*)[.]", told) == ["floor", "wall, floor"]
    assert "Each contact is either closed, and pushes, or open, and there is no force." in told
    told = said(text, "Small oscillations", "modes")
    allowed = "the displacements that the constraint allows, in terms of those of x and th"
    assert f"{allowed}, while the contact 'wall' is open." in told


@pytest.mark.parametrize(("V", "length"), [
    ("tan(a*x)^2", "pi/a"), ("1/sin(a*x)^2 - cos(2*a*x)", "pi/a"), ("cos(a*x)", "2*pi/a"),
    ("cos(a*x) + cos(3*a*x)^2", "2*pi/a"), ("sin(a*x)^2*cos(a*x)^2", "pi/2/a"),
])  # fmt: skip
def test_states_recur_after_the_least_length(V, length):
    """Of V = U tan(a x)^2 the minimum at pi/a is one, too, and 2 pi/a would pass it by."""
    text = f"{{coordinates: [x], parameters: {{a: {{assume: positive}}}}, T: x'^2/2, V: '{V}'}}"
    [period] = recurrences(derive(text).dynamics).values()
    assert str(period) == str(sympy.sympify(length))


@pytest.mark.parametrize("power", random.Random(13).sample(range(1, 5), 2))
def test_a_steady_motion_is_not_stated_where_its_rates_divide_by_zero(power):
    """The drift E/B of crossed fields needs B: without it the charge is accelerated."""
    text = f"{{coordinates: [x, y], parameters: [B, E, q], L: (x'^2 + y'^2)/2 - q*B^{power}*y*x' + q*E*y}}"
    told = said(text, "Steady motions", "steady_motions")
    assert "It is possible for B ≠ 0." in told


@pytest.mark.parametrize("seed", mostly_long(range(3), 2))
def test_a_rate_that_a_sum_in_a_product_divides_by_is_not_0(seed):
    """psi' = -(phi' + V'/(c phi'))/s: no value of psi' makes phi' = 0 steady where V' is not 0."""
    source = random.Random(seed)
    a, b = source.randint(1, 4), source.randint(1, 4)
    text = (
        "{coordinates: [phi, th, psi], parameters: {g: {assume: positive}}, "
        f"T: {a}*th'^2/2 + {b}*phi'^2*sin(th)^2/2 + (psi' + phi'*cos(th))^2/2, V: g*sin(th)}}"
    )
    told = said(text, "Steady motions", "steady_motions")
    assert "phi' ≠ 0" in told


@pytest.mark.parametrize("seed", range(4))
def test_matrices_under_constraints_are_those_of_the_named_displacements(seed):
    """The Hessian of T with the others eliminated by a . q = 0, for random a and T."""
    source = random.Random(seed)
    names = ["x", "y", "z"]
    q = dict(zip(names, sympy.symbols(names), strict=True))
    a = [source.choice([-3, -2, 2, 3]) for _ in names]
    m = [source.randint(1, 5) for _ in names]
    T = " + ".join(f"{k}*{name}'^2/2" for k, name in zip(m, names, strict=True))
    V = " + ".join(f"{name}^2/2" for name in names)
    row = " + ".join(f"({k})*{name}" for k, name in zip(a, names, strict=True))
    text = f"{{coordinates: [x, y, z], T: {T}, V: {V}, constraints: {{c: {row} = 0}}}}"
    [place] = SmallOscillations(derive(text).dynamics).places
    chosen = [q[s.name] for s in place.near.independent]
    [bound] = set(q.values()) - set(chosen)
    solved = {bound: sympy.solve(sum(k * v for k, v in zip(a, q.values(), strict=True)), bound)[0]}
    form = sum(k * v**2 for k, v in zip(m, q.values(), strict=True)).subs(solved) / 2
    assert sympy.Matrix(place.near.M) == sympy.hessian(form, chosen)
    told = said(text, "Small oscillations", "modes")
    assert f"in terms of those of {chosen[0]} and {chosen[1]}." in told


@pytest.mark.parametrize("n", random.Random(13).sample(range(1, 9), 2))
def test_an_instability_by_two_frequencies_that_agree_has_its_reason(n):
    """A free particle in a turning frame moves off uniformly, and no root shows it."""
    text = f"{{coordinates: [x, y], parameters: [w], T: ((x' - {n}*w*y)^2 + (y' + {n}*w*x)^2)/2}}"
    told = said(text, "Equilibria", "equilibria")
    assert "Unstable where w ≠ 0. Two frequencies coincide, and the amplitude at that" in told


@pytest.mark.parametrize("seed", range(3))
def test_a_multiple_frequency_says_whether_amplitudes_grow(seed):
    """Free in a turning frame, x = (a + b t) exp(-i w t); with a spring to rest, w ± sqrt(k)."""
    source = random.Random(seed)
    a, b, c, d = source.choice([(1, 2, 0, 1), (1, 1, -1, 2), (2, -1, 1, 1)])
    u, v = f"({a}*x + {b}*y)", f"({c}*x + {d}*y)"
    du, dv = f"({a}*x' + {b}*y')", f"({c}*x' + {d}*y')"
    T = f"(({du} - w*{v})^2 + ({dv} + w*{u})^2)/2"
    given = f"coordinates: [x, y], parameters: {{w, k: {{assume: positive}}}}, T: {T}"
    growing = "The root is multiple, and where w ≠ 0 it has fewer independent shapes: to first"
    assert growing in said(f"{{{given}}}", "Small oscillations", "modes")
    held = f"{{{given}, V: k*({u}^2 + {v}^2)/2}}"
    assert "fewer independent" not in said(held, "Small oscillations", "modes")


def test_equal_frequencies_of_separate_motions_do_not_grow():
    """Two charges in one field: each turns with q B/m."""
    terms = (f"{x}'^2/2 + {y}'^2/2 + W*({x}*{y}' - {y}*{x}')/2" for x, y in ("xy", "uv"))
    text = f"{{coordinates: [x, y, u, v], parameters: [W], L: {' + '.join(terms)}}}"
    told = said(text, "Small oscillations", "modes")
    assert "fewer independent" not in told
    assert "where W ≠ 0 what is displaced stays displaced." in told


@pytest.mark.parametrize(
    ("V", "kept"), [("x^4", True), ("3*x^6 - x^7", True), ("x^3", False), ("-x^4", False)]
)
def test_a_drift_to_first_order_is_held_by_a_minimum_of_higher_order(V, kept):
    told = said(f"{{coordinates: [x], T: x'^2/2, V: '{V}'}}", "Small oscillations", "modes")
    assert "a uniform drift" in told
    assert ("terms of higher order keep it near" in told) is kept


def test_answers_without_constraints_do_not_speak_of_multipliers():
    free = (
        "{coordinates: {x: {}}, parameters: {a: {assume: positive}}, T: x'^2/2, V: x^2/2, "
        "initial: {x: a}, find: {speed: {value: x'^2, in_terms_of: [x]}}}"
    )
    assert "The solved accelerations are substituted, and every" in said(free, "Questions", "find")


@pytest.mark.parametrize("n", random.Random(29).sample(range(1, 9), 2))
def test_what_cancels_below_a_damped_frequency_is_not_written(n):
    """Of z'' + (c + i s) z' = 0 the root is -c - i s: it turns with s and decays with c."""
    text = (
        "{coordinates: [x, y], parameters: {c: {assume: positive}, s: {assume: positive}}, "
        f"L: (x'^2 + y'^2)/2 + {n}*s*(x*y' - y*x')/2, dissipation: c*(x'^2 + y'^2)/2}}"
    )
    [turning] = [mode for mode in modes(derive(text).dynamics).modes if mode.decay is not None]
    assert to_grammar(turning.frequency) == ("s" if n == 1 else f"{n}*s")
    assert to_grammar(turning.decay) == "c"


POISSON = "act, so the bracket of two constants of the motion need not be constant"


@pytest.mark.parametrize(
    ("more", "act"),
    [
        ("", ""),
        ("constraints: {c: x = y}, ", "Forces of constraints that are not in H "),
        ("constraints: {c: x' = z*y'}, ", "Forces of constraints that are not in H "),
        ("dissipation: x'^2/2, ", "Forces that are not in H "),
        ("forces: {y: -y'}, constraints: {c: x = z}, ", "Forces of constraints and others that "),
    ],
)
def test_poisson_s_theorem_is_about_the_motion_by_the_hamiltonian(more, act):
    """m W^2 x, the bracket of two constants of a ball on a turntable, is not constant."""
    shifts = "{one: {x: 1}, two: {x: t}}"
    text = f"{{coordinates: [x, y, z], {more}T: (x'^2 + y'^2 + z'^2)/2, symmetries: {shifts}}}"
    told = said(text, "Poisson brackets", "brackets")
    assert "For the Q of the transformations of the file" in told
    assert (POISSON in told) is bool(act)
    assert act in told


def test_one_function_is_not_called_none():
    text = "{coordinates: [x], T: x'^2/2, symmetries: {one: {x: 1}}}"
    assert "The file names no two functions." in said(text, "Poisson brackets", "brackets")


# -- displacements that are written by others -----------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_what_is_divided_by_in_matrices_and_amplitudes_does_not_vanish(seed):
    """A skate moves along (cos w, sin w): x by y where sin w is not 0, y by x where cos w is not.

    On a plane without a skate nothing is divided by.
    """
    random.seed(seed)
    k = random.choice([2, 3, 5, 7])
    plane = (
        "coordinates: [x, y, u]\nparameters: {m: {assume: positive}, J: {assume: positive}, c: {}}"
        "\nT: m*(x'^2 + y'^2)/2 + J*u'^2/2\n"
    )
    skate = f"constraints: {{skate: x'*sin(u + {k}*c) = y'*cos(u + {k}*c)}}\n"
    told = said(plane + skate, "Small oscillations", "modes")
    assert "in terms of those of y and u, for …" in told
    [[sliding]] = {mode.shaped_where for mode in modes(derive(plane + skate).dynamics).modes}
    u, c = (sympy.Symbol(name) for name in "uc")
    left, right = (sympy.sympify(to_grammar(side)) for side in (sliding.left, sliding.right))
    for turns, there in ((0.5, False), (0.25, True), (1, True)):  # of w = π turns
        values = {u: turns * math.pi - 3 * k, c: 3}
        assert (float((left - right).subs(values)) > 1e-9) is there
    assert "≠" not in said(plane, "Small oscillations", "modes")


@pytest.mark.parametrize("seed", range(2))
def test_a_swing_through_a_pole_is_one_along_each_meridian(seed):
    random.seed(seed)
    a, b = (random.randint(1, 9) for _ in range(2))
    bowl = (
        "{{coordinates: [{q}], parameters: {{m: {{assume: positive}}}}, "
        "T: m*({T})/2, V: {a}*m*(1 - cos(u)) + {b}*m*sin(u)^2}}"
    )
    round_ = bowl.format(q="u, w", T="u'^2 + w'^2*sin(u)^2", a=a, b=b)
    assert "in the direction of any w." in said(round_, "Small oscillations", "modes")
    flat = bowl.format(q="u", T="u'^2", a=a, b=b)
    assert "direction of any" not in said(flat, "Small oscillations", "modes")


@pytest.mark.parametrize("seed", range(2))
def test_a_circular_orbit_of_no_speed_is_a_state_of_rest(seed):
    """About a centre without a force at r = a; a conical pendulum is infinitely fast at 90°."""
    random.seed(seed)
    b = random.randint(1, 9)
    orbit = (
        "{{coordinates: {{r: {{assume: positive}}, u: {{}}}}, parameters: {{m: {{assume: positive}}"
        ", a: {{assume: positive}}}}, T: m*({T})/2, V: '{V}'}}"
    )
    plane = orbit.format(T="r'^2 + r^2*u'^2", V=f"{b}*(r - a)^2")
    assert "At equality it is a state of rest;" in said(plane, "Steady motions", "steady_motions")
    sphere = orbit.format(T="r'^2 + sin(r)^2*u'^2", V=f"-{b}*cos(r)")
    told = said(sphere, "Steady motions", "steady_motions")
    assert "It is possible for" in told
    assert "At equality" not in told


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("floors", [1, 2])
def test_linear_equations_with_closed_contacts_keep_them_closed(seed, floors):
    """A body that lies on a floor, or in a corner, beside a spring: without the contact it falls."""
    source = random.Random(seed)
    k, x = source.randint(1, 5), source.choice(["x^2", "sin(x)^2"])
    names = ["floor", "wall"][:floors]
    gaps = dict(zip(names, ("y >= 0", "z >= 0"), strict=False))
    contacts = ", ".join(f"{name}: {{gap: {gap}, restitution: 0}}" for name, gap in gaps.items())
    text = (
        "{coordinates: [x, y, z], T: (x'^2 + y'^2 + z'^2)/2, "
        f"V: '{k}*{x} + 3*y + {'2*z' if floors == 2 else 'z^2'}', contacts: {{{contacts}}}}}"
    )
    told = said(text, "Small oscillations", "modes")
    closed = "the contact 'floor'" if floors == 1 else "the contacts 'floor' and 'wall'"
    assert f"restricted to the displacements that keep {closed} closed" in told
    assert f"come only from {closed}, while closed" in said(text, "Forces", "forces")


@pytest.mark.parametrize("gap", ["y >= 0", "y >= x^2", "y >= x"])
@pytest.mark.parametrize(
    ("rest", "beside"),
    [
        ("T: 3*(x'^2 + y'^2)/2", True),
        ("L: (x'^2 + y'^2)/2 + x*y' - y*x'", True),  # a magnetic field does no work
        ("T: x'^2 + y'^2, V: x^2 + y^2", False),  # nothing rests near it
        ("T: x'^2 + y'^2, V: -y^3", False),
        ("T: x'^2 + y'^2, forces: {x: x'}", False),  # the kinetic energy grows
    ],
)
def test_without_a_force_what_touches_a_wall_rests_beside_it_too(rest, beside, gap):
    """A wall gives back a part of the speed across it, or all of it, and no more."""
    e = random.Random(gap).choice(["0", "1/2", "1", "e"])
    told = said(
        f"{{coordinates: [x, y], parameters: {{e: {{}}}}, {rest}, "
        f"contacts: {{wall: {{gap: '{gap}', restitution: {e}}}}}}}",
        "Equilibria",
        "equilibria",
    )
    _, closed, *_ = told.split("In contact: wall. ")
    assert closed.startswith("Neutral: every possible position near it") is beside


@pytest.mark.parametrize(
    ("lagrangian", "functions", "named"),
    [
        ("x'^2/2 - U(x)", "U: [d]", "the function U is not specified"),
        ("L0(x, x')", "L0: [q, v]", "the function L0 is not specified"),
        ("x'^2/2 - U(x) - W(x)*x", "U: [d], W: [d]", "the functions U and W are not specified"),
        ("x'^2/2 - exp(x) - x^2", "U: [d]", "no closed solution of the conditions of equilibrium"),
    ],
)
def test_what_is_not_specified_is_named(lagrangian, functions, named):
    text = f'{{coordinates: [x], functions: {{{functions}}}, L: "{lagrangian}"}}'
    assert equilibria(derive(text).dynamics).reason.startswith(named)


@pytest.mark.parametrize("V", ["U(sqrt(x^2 + y^2))", "x*W(0) + U(sqrt(x^2 + 2*y^2))"])
def test_a_function_that_is_not_specified_is_named_before_its_kink(V):
    functions = ", ".join(f"{name}: [d]" for name in "UW" if f"{name}(" in V)
    text = f'{{coordinates: [x, y], functions: {{{functions}}}, T: "(x\'^2 + y\'^2)/2", V: "{V}"}}'
    reason = equilibria(derive(text).dynamics).reason
    assert reason.startswith("the function")
    assert reason.endswith("not specified")


def test_an_orbit_on_a_kink_may_be_one_more_steady_motion():
    """V = k |r - a|: circles with r > a have omega^2 = 3 k/(m r), and that on r = a is left open."""
    section = steady_motions(
        derive(
            "coordinates: {r: {assume: positive}, phi: {}}\n"
            "parameters: {m: {assume: positive}, k: {assume: positive}, a: {assume: positive}}\n"
            "T: m*(r'^2 + r^2*phi'^2)/2\nV: k*abs(r - a)\n"
        )
    )[0]
    [motion] = section.motions or ()
    [square] = motion.frequencies_squared
    assert to_grammar(square) == "3*k/(m*r)"
    assert not section.complete


@pytest.mark.parametrize("seed", range(3))
def test_steady_motions_that_differ_in_their_place_stand_together(seed):
    """At u = 0 and at u = pi all is the same but the sign of the gyroscopic terms k cos(u)."""
    given = random.Random(seed)
    a, b, k = (given.randint(1, 9) for _ in range(3))
    text = (
        f"{{coordinates: [u, v], L: \"{a}*(u'^2 + v'^2)/2 + {k}*sin(u)*v' + {b}*cos(2*u)"
        f' - {b}*v^2/2"}}'
    )
    told = said(text, "Steady motions", "steady_motions")
    assert told.count("or, with the opposite sign of") == told.count("Stable: ") == 1
    told = said(text.replace("sin(u)*v'", "sin(2*u)*v'"), "Steady motions", "steady_motions")
    assert "or at" in told
    assert "opposite" not in told
    assert told.count("Stable: ") == 1


@pytest.mark.parametrize("seed", range(4))
def test_where_a_contact_would_have_to_pull_is_said(seed):
    """Inside of a loop the track carries at the bottom alone, outside of a sphere at the top."""
    given = random.Random(seed)
    side, turned = given.choice([1, -1]), given.choice(["0", "pi", "pi/2"])
    equation = "R = r" if side > 0 else "r = R"
    text = (
        "{coordinates: [r, u], parameters: {m: {assume: positive}, g: {assume: positive}, "
        f"R: {{assume: positive}}}}, T: m*(r'^2 + r^2*u'^2)/2, V: m*g*r*cos(u - {turned}), "
        f"constraints: {{c: {{equation: '{equation}', multiplier: N%s}}}}}}"
    )
    alone = said(text % ", holds_while: N >= 0", "Equilibria", "equilibria")
    both = said(text % "", "Equilibria", "equilibria")
    pulls = "The forces balance, but a one-sided constraint would not hold, at"
    assert (alone.count(pulls), both.count(pulls)) == (1, 0)
    assert alone.count("Stable:") == (side > 0)
    assert alone.count("Unstable:") == (side < 0)
    assert (both.count("Stable:"), both.count("Unstable:")) == (1, 1)


def _norm_of_motion(m, c, k, t):
    """|exp(A t)| of M x'' + C x' + K x = 0 in the plane, with C = c (0, -1; 1, 0), K = diag(k)."""
    A = mpmath.matrix(
        [[0, 0, 1, 0], [0, 0, 0, 1], [-k[0] / m, 0, 0, c / m], [0, -k[1] / m, -c / m, 0]]
    )
    return mpmath.norm(mpmath.expm(A * t))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("trap", ["saddle", "top"])
def test_on_the_edge_of_bounded_motion_it_is_unstable_where_roots_coincide(seed, trap):
    """A turning saddle is left at k = m w^2, a hill in a field at c^2 = 4 m k: |exp(A t)| ~ t."""
    given = random.Random(seed)
    a, b, s = given.randint(1, 9), given.randint(1, 9), given.choice(["w", "v", "e"])
    if trap == "saddle":
        L = f"{a}*((x' - {s}*y)^2 + (y' + {s}*x)^2)/2 - {b}*k*(x^2 - y^2)/2"
        w = (b / a) ** 0.5  # at k = 1
        edge = (a, 2 * a * w, (b - a * w**2, -(b + a * w**2)))
    else:
        L = f"{a}*(x'^2 + y'^2)/2 + {s}*(x*y' - y*x')/2 + {b}*k*(x^2 + y^2)/2"
        edge = (a, (4 * a * b) ** 0.5, (-b, -b))
    text = (
        f"{{coordinates: [x, y], parameters: {{{s}: {{assume: positive}}, k: {{assume: positive}}}}"
        f', L: "{L}"}}'
    )
    told = said(text, "Equilibria", "equilibria")
    assert "it is unstable, too: roots coincide" in told
    ratio = _norm_of_motion(*edge, 800) / _norm_of_motion(*edge, 400)
    assert 1.9 < ratio < 2.1
    inside = (edge[0], edge[1] * 1.2, edge[2] if trap == "top" else (-0.44 * b, -2.44 * b))
    assert _norm_of_motion(*inside, 800) < 100


@pytest.mark.parametrize("seed", range(3))
def test_a_body_on_a_floor_rests_where_it_touches_and_not_above(seed):
    """Positions above the floor are possible, and no equilibria."""
    k = random.Random(seed).randint(1, 4)
    floor = "contacts: {floor: {gap: y >= 0, restitution: 1/2}}"
    text = f"{{coordinates: [x, y], T: {k}*x'^2/2 + y'^2/2, V: {k}*y, {floor}}}"
    told = said(text, "Equilibria", "equilibria")
    assert "In contact: floor. Neutral: every possible position near it with the same" in told


def test_rest_everywhere_is_no_line_of_its_own():
    """And a steady motion whose stability is open for phi' = 0 is not said to be for phi'^2 = 0."""
    sphere = "{coordinates: [theta, phi], T: (theta'^2 + sin(theta)^2*phi'^2)/2}"
    assert "from rest the equations of motion are" in said(sphere, "Small oscillations", "modes")
    told = said(sphere, "Steady motions", "steady_motions")
    assert "For … = … every position is a steady motion" in told or "For phi' = …" in told
    steps = explain(derive(sphere), ("steady_motions",)).steps
    blocks = [block for step in steps if step.title == "Steady motions" for block in step.blocks]
    parts = [part for block in blocks if isinstance(block, Paragraph) for part in block.parts]
    at = [parts[k + 1] for k, part in enumerate(parts) if str(part).endswith("For ")]
    assert Name("phi", 1) in at
