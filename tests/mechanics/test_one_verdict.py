"""One verdict for a place in every section, and no step that its own verification retracts."""

from __future__ import annotations

import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

_M = "m: {assume: positive}, k: {assume: positive}"


@pytest.mark.parametrize("V", ["k*abs(x)", "k*abs(x) + m*x^2", "2*k*abs(x - 1)"])
def test_rest_at_a_kink_has_one_verdict_as_a_steady_motion_too(V):
    derivation = derive(f"{{coordinates: [x], parameters: {{{_M}}}, T: m*x'^2/2, V: {V}}}")
    [rest] = equilibria(derivation.dynamics).equilibria or ()
    [motion] = steady_motions(derivation)[0].motions or ()
    assert (rest.verdict.stable, rest.verdict.reason) == (True, motion.verdict.reason)
    assert motion.verdict.stable
    assert not motion.frequencies_squared


def test_two_equilibria_with_the_same_linear_motion_have_one_text():
    text = f"{{coordinates: [x], parameters: {{{_M}}}, T: m*x'^2/2, V: k*(x^2 - 1)^2/4}}"
    told = words(explain(derive(text), ["modes"]), "Small oscillations")
    assert told.count("To first order") == told.count("and from the equilibrium") == 1


def test_roots_that_are_not_real_are_called_so():
    text = (
        f"{{coordinates: [x, y, z], parameters: {{{_M}, c: {{assume: positive}}}}, "
        "T: m*(x'^2 + y'^2 + z'^2)/2, V: k*(x^2 + y^2 + z^2)/2, forces: {x: c*y, y: -c*x}}"
    )
    told = words(explain(derive(text), ["modes"]), "Small oscillations")
    assert "No other root is real and positive" in told
    found = modes(derive(text).dynamics).modes or ()
    assert [m.frequency and to_grammar(m.frequency) for m in found] == ["sqrt(k/m)", None]


def test_the_hamiltonian_of_what_a_constraint_leaves_is_confirmed():
    text = (
        f"{{coordinates: [a, b, c], parameters: {{{_M}}}, T: (a'^2 + b'^2 + c'^2)/2, "
        "V: k*((a - b)^2 + (b - c)^2 + (c - a)^2)/2, constraints: {s: a + b + c = 0}}"
    )
    told = words(explain(derive(text), ["hamilton_jacobi"]), "The Hamilton-Jacobi equation")
    assert "used to eliminate" in told
    assert "left out" not in told


def test_a_condition_is_short_where_another_one_holds():
    """Stable where q² B² > 4 m k, unstable for the opposite inequality alone."""
    text = (
        "{coordinates: [x, y, z], parameters: {m: {assume: positive}, q: {}, "
        "B: {assume: positive}, k: {assume: positive}}, L: m*(x'^2 + y'^2 + z'^2)/2 "
        "+ q*B*(x*y' - y*x')/2 - k*(2*z^2 - x^2 - y^2)/2}"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    [opposite] = rest.verdict.unstable
    assert (to_grammar(opposite.left), to_grammar(opposite.right)) == ("4*m*k", "q^2*B^2")


@pytest.mark.parametrize("V", ["abs(x*y)", "abs(x^2 - y^2)", "2*abs(x*y) + x^2*y^2"])
def test_nothing_is_called_stable_along_lines_that_cross(V):
    """Motion along x = 0 comes to where V restores nothing across it, and may leave along y = 0."""
    found = equilibria(derive(f"coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: \"{V}\"").dynamics)
    assert all(each.verdict.stable is not True for each in found.equilibria or ())


@pytest.mark.parametrize("force", ["b", "2*m*b/7"])
def test_rest_among_motions_at_constant_velocities_has_the_verdict_of_equilibria(force):
    """Circles about any point: a ball on a turntable, a charge in a field given as a force."""
    derivation = derive(
        "{coordinates: [x, y], parameters: {m: {assume: positive}, b: {assume: positive}}, "
        f"T: m*(x'^2 + y'^2)/2, forces: {{x: -{force}*y', y: {force}*x'}}}}"
    )
    [rest] = equilibria(derivation.dynamics).equilibria or ()
    [motion] = steady_motions(derivation)[0].motions or ()
    assert (motion.verdict.stable, motion.verdict.reason) == (True, rest.verdict.reason)
    told = words(explain(derivation, ["steady_motions"]), "Steady motions")
    assert "first order" not in told


@pytest.mark.parametrize(
    ("potential", "stable"), [("x^4", True), ("x^3", False), ("-x^4", False), ("x^6 + x^8", True)]
)
@pytest.mark.parametrize("constraint", ["x = 2*u", "u = x + x^3", "u = x^2"])
def test_a_constraint_that_is_solved_leaves_the_verdict_of_the_reduced_motion(
    potential, stable, constraint
):
    """V has its order along what the constraint allows: Lagrange and Dirichlet, one freedom."""
    text = (
        f"{{coordinates: [x, u], T: (x'^2 + u'^2)/2, V: {potential}, "
        f"constraints: {{c: {constraint}}}}}"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    assert rest.verdict.stable is stable


@pytest.mark.parametrize("drag", ["c*x'", "c*x'^3", "c*(x' - 1)", "2*c*x' + x'^3"])
def test_a_terminal_velocity_is_confirmed(drag):
    """m x'' = F - f(x') with f' > 0: it is stable, and no force pushes along x."""
    text = (
        f"{{coordinates: [x], parameters: {{{_M}, c: {{assume: positive}}}}, T: m*x'^2/2, V: 0, "
        f'forces: {{x: "k - {drag}"}}}}'
    )
    assert "left out" not in words(explain(derive(text), ["steady_motions"]), "Steady motions")


def test_a_contact_on_which_nothing_presses_has_one_verdict():
    """A rod upright against a wall falls along it; hanging below the floor it may leave both."""
    text = (
        f"{{coordinates: [x, y, u], parameters: {{{_M}}}, V: m*y, "
        "T: m*(x'^2 + y'^2)/2 + k*u'^2/2, constraints: {"
        "wall: {equation: x = sin(u), multiplier: N, holds_while: N >= 0}, "
        "floor: {equation: y = cos(u), multiplier: F, holds_while: F >= 0}}}"
    )
    derivation = derive(text)
    places = equilibria(derivation.dynamics).equilibria or ()
    motions = steady_motions(derivation)[0].motions or ()
    for found in (places, motions):
        assert {to_grammar(x.at["u"]): x.verdict.stable for x in found} == {"0": False, "pi": None}


@pytest.mark.parametrize("seed", range(4))
def test_a_constant_force_is_one_whether_it_stands_in_V_or_among_the_forces(seed):
    """What falls with drag, with a spring or without: the same steady motions and verdicts."""
    source = random.Random(f"falling {seed}")
    spring, drag = source.choice(("", " - k*x")), source.choice(("c*x'", "c*x'*abs(x')"))
    weight = f"{source.randint(1, 4)}*m*g"
    head = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, g: {assume: positive}, "
        "c: {assume: positive}, k: {assume: positive}}\nT: m*x'^2/2\n"
    )
    told = [
        steady_motions(derive(head + each))[0].motions
        for each in (
            f"V: -{weight}*x\nforces: {{x: -{drag}{spring}}}\n",
            f"forces: {{x: {weight} - {drag}{spring}}}\n",
        )
    ]
    assert told[0] == told[1]
    assert [not motion.free for motion in told[0]] == [True]


@pytest.mark.parametrize("seed", range(3))
def test_damping_along_a_family_has_one_verdict_at_rest_and_among_steady_motions(seed):
    """A pendulum below a cart that is damped: it comes to rest, wherever the cart then is."""
    a, b = (random.Random(f"cart {seed}").randint(1, 5) for _ in range(2))
    derivation = derive(
        "coordinates: [x, theta]\nparameters: {m: {assume: positive}, g: {assume: positive}, "
        "l: {assume: positive}, c: {assume: positive}}\n"
        f"T: {a + 1}*m*x'^2/2 + m*l*x'*theta'*cos(theta) + m*l^2*theta'^2/2\n"
        f"V: -m*g*l*cos(theta)\ndissipation: {b}*c*x'^2/2\n"
    )
    rest = [e.verdict for e in equilibria(derivation.dynamics).equilibria]
    steady = [motion.verdict for motion in steady_motions(derivation)[0].motions]
    assert [(v.stable, v.asymptotic) for v in rest] == [(True, True), (False, False)]
    assert [(v.stable, v.asymptotic) for v in steady] == [(v.stable, v.asymptotic) for v in rest]


def test_friction_between_two_bodies_does_not_deny_rest_as_a_steady_motion():
    derivation = derive(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
        "f: {assume: positive}}\nT: m*(x'^2 + y'^2)/2\nV: k*x^2/2\n"
        "forces: {x: -f*sign(x' - y'), y: f*sign(x' - y')}\n"
    )
    section, missing = steady_motions(derivation)
    assert section.motions is None
    assert "static friction" in missing[0][1]


@pytest.mark.parametrize("power", [4, 6])
def test_a_lagrangian_without_squares_of_velocities_is_not_singular_by_its_coordinates(power):
    [rest] = equilibria(
        derive(f"coordinates: [x]\nL: x'^{power}/{power} - x^4/4\n").dynamics
    ).equilibria
    assert "Hessian" in rest.verdict.reason


@pytest.mark.parametrize("seed", range(3))
def test_at_a_pole_nothing_is_said_of_damping_that_turning_escapes(seed):
    """Drag along r alone: circles about the centre are not damped."""
    source = random.Random(f"circles {seed}")
    k, c, power = source.randint(1, 4), source.randint(1, 4), source.choice(("", "*(1 + r^2)"))
    [rest] = equilibria(
        derive(
            "coordinates: [r, phi]\nparameters: {m: {assume: positive}, a: {assume: positive}}\n"
            f"T: m*(r'^2 + r^2*phi'^2)/2\nV: {k}*a*r^2/2\ndissipation: {c}*a*r'^2{power}/2\n"
        ).dynamics
    ).equilibria
    assert rest.verdict.stable
    assert not rest.verdict.asymptotic
    assert "damped" not in rest.verdict.reason


@pytest.mark.parametrize("along", ["", " - c*x'", " + 2*m*g - c*x'"])
def test_what_falls_with_drag_onto_a_floor_has_no_terminal_velocity(along):
    section, _ = steady_motions(
        derive(
            "coordinates: [x, y]\nparameters: {m: {assume: positive}, g: {assume: positive}, "
            "c: {assume: positive}, k: {assume: positive}}\nT: m*(x'^2 + y'^2)/2\n"
            f"V: m*g*y\nforces: {{x: -k*x{along}, y: -c*y'}}\n"
            "contacts: {floor: {gap: y >= 0, restitution: 0}}\n"
        )
    )
    assert not any((motion.rates or {}).get("y") for motion in section.motions or ())
    assert section.motions is None or section.where or not section.complete


def test_steady_motions_at_singular_coordinates_are_not_denied_by_silence():
    """A bob that a turning fluid drags round: at the bottom, in the axis, the azimuth fails."""
    section, _ = steady_motions(
        derive(
            "coordinates: [theta, phi]\nparameters: {m: {assume: positive}, l: {assume: positive}, "
            "g: {assume: positive}, c: {assume: positive}, w: {assume: positive}}\n"
            "T: m*l^2*(theta'^2 + sin(theta)^2*phi'^2)/2\nV: -m*g*l*cos(theta)\n"
            "dissipation: c*(phi' - w)^2/2\n"
        )
    )
    assert section.motions
    assert not section.complete


@pytest.mark.parametrize("push", ["F*r", "F*r^2", "F*G*r"])
def test_a_push_that_may_be_0_denies_no_steady_motion_in_general(push):
    """A mass on a spring that is pushed round: for F = 0 it circles steadily."""
    section, _ = steady_motions(
        derive(
            "coordinates: [r, phi]\nparameters: {m: {assume: positive}, k: {assume: positive}, "
            "l: {assume: positive}, F: , G: }\nT: m*(r'^2 + r^2*phi'^2)/2\nV: k*(r - l)^2/2\n"
            f"forces: {{phi: {push}}}\n"
        )
    )
    assert section.motions == ()
    assert section.unless != ()


@pytest.mark.parametrize("seed", range(3))
def test_rest_at_a_pole_has_its_verdict_among_steady_motions_too(seed):
    """Where drag acts along the azimuth alone, the linear equations fail at the pole."""
    c = random.Random(f"pole {seed}").randint(1, 5)
    derivation = derive(
        "coordinates: [theta, phi]\nparameters: {m: {assume: positive}, l: {assume: positive}, "
        "g: {assume: positive}}\nT: m*l^2*(theta'^2 + sin(theta)^2*phi'^2)/2\n"
        f"V: -m*g*l*cos(theta)\ndissipation: {c}*m*l^2*sin(theta)^2*phi'^2/2\n"
    )
    rest = [e.verdict.stable for e in equilibria(derivation.dynamics).equilibria]
    assert rest == [True, False]
    assert [motion.verdict.stable for motion in steady_motions(derivation)[0].motions] == rest
