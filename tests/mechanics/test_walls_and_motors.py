"""Rest and steady motions beside walls that may move, and under motors along constraints."""

from __future__ import annotations

import random

import pytest
import sympy

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.reduction.statement import reduction
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

_UP = "{assume: positive}"


@pytest.mark.parametrize("seed", range(4))
def test_a_motor_against_drag_turns_what_rolls_at_a_constant_rate(seed):
    """The power of the motor is that of the drags: τ Ω = (a R² + b) Ω²."""
    source = random.Random(seed)
    R, a, b = (source.randint(1, 5) for _ in range(3))
    first, second = source.sample(["x", "th"], 2)
    text = (
        f"{{coordinates: [{first}, {second}], parameters: {{tau: {_UP}}}, "
        f"T: x'^2/2 + th'^2, constraints: {{r: x = {R}*th}}, "
        f"forces: {{x: -{a}*x', th: tau - {b}*th'}}}}"
    )
    section, _ = steady_motions(derive(text))
    [motion] = section.motions or ()
    [(name, rate)] = (motion.rates or {}).items()
    slow, by = a * R**2 + b, R if name == "x" else 1
    expected = {f"tau/{slow}", "tau"} if by == 1 else {f"{by}*tau/{slow}", f"tau/{slow // by}"}
    assert to_grammar(rate) in expected
    assert motion.verdict.asymptotic


@pytest.mark.parametrize("seed", range(4))
def test_at_a_minimum_a_wall_that_is_touched_only_is_no_danger(seed):
    source = random.Random(seed)
    a, b, s = source.randint(1, 5), source.randint(1, 5), source.choice([-1, 1])
    text = (
        f"{{coordinates: [x, y], T: x'^2 + x'*y'/2 + y'^2, V: {a}*x^2 + {s}*x*y + {b}*y^4 + y^2, "
        "contacts: {w: {gap: x >= 0, restitution: 1/2}}}"
    )
    found = equilibria(derive(text).dynamics).equilibria or ()
    assert [e.verdict.stable for e in found] == [True]


def test_beside_a_saddle_it_stays_undecided():
    text = (
        "{coordinates: [x, y], T: x'^2 + y'^2, V: x^2 - y^2 - y^3*x, "
        "contacts: {w: {gap: x >= 0, restitution: 1/2}}}"
    )
    found = equilibria(derive(text).dynamics).equilibria or ()
    touching = [e.verdict.stable for e in found if e.touching]
    assert touching
    assert True not in touching


@pytest.mark.parametrize("side", ["y >= 0", "x >= 0"])
def test_a_slope_may_lie_flat(side):
    """On y = 0 a body rests where sin(a) = 0: it is not that sin(a) and cos(a) must vanish."""
    text = (
        f"{{coordinates: [x, y], parameters: {{g: {_UP}, a: {{}}}}, T: (x'^2 + y'^2)/2, "
        f"V: g*(y*cos(a) - x*sin(a)), contacts: {{w: {{gap: {side}, restitution: 0}}}}}}"
    )
    told = words(explain(derive(text), ["equilibria", "steady_motions"]), "Equilibria")
    assert "unless" not in told
    assert equilibria(derive(text).dynamics).unless is None
    section, _ = steady_motions(derive(text))
    assert section.unless == ()


def test_the_period_beside_a_wall_that_moves_is_left_out():
    text = (
        "{coordinates: [x], parameters: {w: {}}, T: x'^2/2, V: x^2/2, "
        "contacts: {w1: {gap: x >= sin(w*t), restitution: 1}}}"
    )
    told = explain(derive(text), ["reduction"])
    assert words(told, "The reduction")
    assert told.warnings == ()


@pytest.mark.parametrize("seed", range(4))
def test_charges_in_crossed_fields_drift_whatever_the_gauge(seed):
    """The drift balances the forces: q E + q v × B - c v = 0."""
    source = random.Random(seed)
    E, F, B, g = (source.randint(1, 5) for _ in range(4))
    c = source.randint(0, 3)
    text = (
        f"{{coordinates: [x, y], L: (x'^2 + y'^2)/2 + {B}*(x*y' - y*x')/2 + {E}*x + {F}*y "
        f"+ {g}*(x'*y + y'*x), dissipation: {c}*(x'^2 + y'^2)/2}}"
    )
    section, _ = steady_motions(derive(text))
    [motion] = section.motions or ()
    u, v = (float(sympy.sympify(to_grammar(x))) for x in (motion.rates or {}).values())
    assert [E + B * v - c * u, F - B * u - c * v] == pytest.approx([0, 0], abs=1e-12)
    assert motion.verdict.asymptotic if c else motion.verdict.spectrum == ()


def test_two_discs_that_turn_together_are_not_denied():
    text = "{coordinates: [u, v], T: (u'^2 + v'^2)/2, V: (u - v)^2/2, forces: {u: 1, v: -v'}}"
    section, _ = steady_motions(derive(text))
    assert section.motions == ()
    assert section.sought == " in these coordinates"


@pytest.mark.parametrize("damping", [0, 1, 3])
def test_what_rests_everywhere_stays_with_damping_too(damping):
    """A wheel upright on a plane: one direction of rolling is damped, or none."""
    text = (
        "{coordinates: [x, y, th, ph], T: (x'^2 + y'^2 + th'^2 + ph'^2)/2, "
        "constraints: {a: x' = ph'*cos(th), b: y' = ph'*sin(th)}, "
        f"forces: {{ph: -{damping}*ph'}}}}"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    assert rest.verdict.stable
    assert rest.verdict.across


@pytest.mark.parametrize("slope", [0, 1, 2])
@pytest.mark.parametrize("restitution", ["1/2", "1"])
def test_momenta_and_energy_between_impacts(slope, restitution):
    """An impulse along the gradient (-slope, 1): p_x stays where that has no part along x."""
    text = (
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: y, "
        f"contacts: {{floor: {{gap: y >= {slope}*x, restitution: {restitution}}}}}}}"
    )
    section, _ = reduction(derive(text))
    assert ("x" in section.when) is (slope != 0)
    assert section.one_freedom is not None
    assert bool(section.one_freedom.when) is (restitution != "1")


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_a_linkage_rests_where_an_angle_carries_no_mass(seed):
    """A slider-crank with a light rod: M is singular, but not along the constraints."""
    a, m = (random.Random(seed).randint(1, 4) for _ in range(2))
    text = (
        f"{{coordinates: [th, ph, x], T: {m}*th'^2 + x'^2, "
        f"constraints: {{h: {a}*sin(th) = 5*sin(ph), s: x = {a}*cos(th) + 5*cos(ph)}}}}"
    )
    section, missing = steady_motions(derive(text))
    assert not missing
    assert section.motions


@pytest.mark.parametrize("power", [3, 5])
def test_no_period_as_a_series_where_a_derivative_jumps(power):
    text = f"{{coordinates: [x], T: x'^2/2, V: x^2 + abs(x - 1 + 1)^{power}}}"
    section, missing = reduction(derive(text))
    assert not missing
    assert section.one_freedom is not None
    assert section.one_freedom.periods == ()
    assert "jumps" in section.one_freedom.reason


def test_a_driven_sled_goes_straight_on():
    """Thrust F along the blade against the drag x' = F cos th: a steady motion in any direction."""
    text = (
        f"{{coordinates: [x, y, th], parameters: {{F: {_UP}}}, T: (x'^2 + y'^2 + th'^2)/2, "
        "constraints: {s: x'*sin(th) = y'*cos(th)}, "
        "forces: {x: F*cos(th) - x', y: F*sin(th) - y', th: -th'}}"
    )
    section, _ = steady_motions(derive(text))
    (motion,) = section.motions
    assert motion.free == ("th",)
    assert {name: to_grammar(rate) for name, rate in motion.rates.items()} == {"x": "F*cos(th)"}


@pytest.mark.parametrize("V", ["exp(th) - th^3", "exp(x) - x^3 + th*sin(th)"])
def test_under_velocity_constraints_conditions_of_rest_are_called_so(V):
    """Conditions without a closed solution are those of rest, where the forces must vanish."""
    text = (
        f"{{coordinates: [x, y, th], parameters: {{F: {_UP}}}, T: (x'^2 + y'^2 + th'^2)/2, "
        f"V: {V}, constraints: {{s: x'*sin(th) = y'*cos(th)}}, "
        "forces: {x: F*cos(th) - x', y: F*sin(th) - y', th: -th'}}"
    )
    section, _ = steady_motions(derive(text))
    assert section.motions is None
    assert section.resting


@pytest.mark.parametrize("V", ["1/(x - y)^2", "exp(x - y)"])
def test_what_repels_does_not_drift(V):
    """Nothing balances: the equations contain every coordinate, and none may grow evenly."""
    section, _ = steady_motions(derive(f"{{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: {V}}}"))
    assert section.motions == ()


def test_two_parameters_may_vanish_together():
    text = "{coordinates: [x, y], parameters: {A: {}, B: {}}, T: (x'^2 + y'^2)/2, V: A*x + B*y}"
    assert len(equilibria(derive(text).dynamics).unless or ()) == 2


@pytest.mark.parametrize(
    ("coupling", "stable"),
    [("x*(y + z)", False), ("x*(y - z)", None), ("x^2*y + x*z", None), ("x*(z - 2*y)", None)],
)
def test_where_nothing_presses_a_motion_may_leave_along_the_contacts(coupling, stable):
    """On x = e exp(t) the contacts press by dV/dy and dV/dz: both to one side, or nowhere."""
    text = (
        "coordinates: [x, y, z]\nT: (x'^2 + y'^2 + z'^2)/2\n"
        f"V: -x^2/2 + {coupling}\nconstraints:\n"
        "  first: {equation: y = 0, multiplier: N1, holds_while: N1 >= 0}\n"
        "  second: {equation: z = 0, multiplier: N2, holds_while: N2 >= 0}\n"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    [motion] = steady_motions(derive(text))[0].motions or ()
    assert (rest.verdict.stable, motion.verdict.stable) == (stable, stable)


@pytest.mark.parametrize("inertia", ["/24", "/30", "/7"])
def test_a_ladder_that_stands_at_the_wall_falls(inertia):
    """The foot slides out while both contacts press: N_w = 3 m g sin(theta)/4 + … at first."""
    ladder = (
        "coordinates: [x, y, b]\n"
        "parameters: {m: {assume: positive}, g: {assume: positive}, l: {assume: positive}}\n"
        f"T: m*(x'^2 + y'^2)/2 + m*l^2*b'^2{inertia}\nV: m*g*y\nconstraints:\n"
        "  wall: {equation: x = l*sin(b)/2, multiplier: N, holds_while: N >= 0}\n"
        "  floor: {equation: y = l*cos(b)/2, multiplier: F, holds_while: F >= 0}\n"
    )
    verdicts = {
        to_grammar(e.at["b"]): e.verdict.stable
        for e in equilibria(derive(ladder).dynamics).equilibria
    }
    assert verdicts == {"0": False, "pi": None}


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("outside", [True, False])
def test_what_turns_with_a_drive_keeps_to_a_surface_that_can_only_push(seed, outside):
    """N = m (g cos θ - R w² sin²θ) outside of a sphere, the opposite inside of it.

    w² cos θ = -g/R or sin θ = 0: outside only the top is left, inside all but the top.
    """
    source = random.Random(seed)
    R, g = source.randint(1, 4), source.randint(1, 9)
    w = source.randint(g, g + 3)
    side = "r" if outside else "-r"
    text = (
        f"{{coordinates: {{r: {_UP}, theta: {{assume: nonnegative}}, phi: {{}}}}, "
        f"T: (r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2, V: {g}*r*cos(theta), "
        f"constraints: {{s: {{equation: {side} = {R if outside else -R}, multiplier: N, "
        f"holds_while: N >= 0}}, d: phi' = {w}}}}}"
    )
    section, _ = steady_motions(derive(text))
    found = {to_grammar(value) for each in section.motions or () for value in each.at.values()}
    expected = {0} if outside else {sympy.pi, sympy.acos(-sympy.Rational(g, R * w**2))}
    assert {sympy.sympify(x) for x in found} == expected


def test_what_rolls_off_a_cylinder_has_no_steady_motion_below_it():
    text = (
        "{coordinates: {r: {assume: positive}, theta: {}, phi: {}}, "
        "T: r'^2 + r^2*theta'^2 + phi'^2, V: r*cos(theta), constraints: "
        "{s: {equation: r = 3, multiplier: N, holds_while: N >= 0}, roll: phi' = 3*theta'}}"
    )
    section, _ = steady_motions(derive(text))
    assert [to_grammar(each.at["theta"]) for each in section.motions or ()] == ["0"]
