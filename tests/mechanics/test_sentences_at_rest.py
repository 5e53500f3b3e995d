"""Sentences about rest and small displacements: floors, skates, turntables, special values."""

from __future__ import annotations

import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.mechanics.reduction.statement import reduction
from lagcli.pipeline import explain

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
    assert all(v.stable is None and "power of t" in v.reason for v in verdicts)
    assert "no force" not in said(text, "Equilibria", "equilibria")


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
    assert section.unless is None
    assert "general values" in said(text, "Equilibria", "equilibria")


# -- forces on points that are guided -------------------------------------------------------------


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
