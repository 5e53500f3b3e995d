"""Verdicts where the linearised equations have the root 0 alone, or the constraints an apex."""

from __future__ import annotations

import random

import pytest
import sympy

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

_POINT = "m: {assume: positive}, g: {assume: positive}, a: {assume: positive}"


def cone(power: int, sign: str) -> str:
    return (
        f"{{coordinates: [x, y, z], parameters: {{{_POINT}}}, T: m*(x'^2 + y'^2 + z'^2)/2, "
        f"V: {sign}m*g*z, constraints: {{cone: z^{power} = a^2*(x^2 + y^2)}}}}"
    )


@pytest.mark.long
@pytest.mark.parametrize("sign", ["", "-"])
def test_nothing_is_claimed_of_the_apex_of_a_cone(sign):
    text = cone(2, sign)
    found = equilibria(derive(text).dynamics)
    assert found.equilibria == ()
    assert found.where
    told = words(explain(derive(text), ["equilibria", "steady_motions"]), "Equilibria")
    assert "no solution where the gradient of the constraint is not 0" in told
    assert "no solution:" not in told


@pytest.mark.parametrize("sign", ["", "-"])
def test_the_bottom_of_a_paraboloid_is_no_apex(sign):
    [rest] = equilibria(derive(cone(1, sign)).dynamics).equilibria or ()
    assert rest.verdict.stable is (sign == "")


@pytest.mark.parametrize("seed", range(4))
def test_all_forces_on_a_quadric_are_along_its_gradient(seed):
    """Of a x² + b y² + c z² = 1 in uniform gravity along z: the two poles, and no other place."""
    a, b, c = (random.Random(seed).randint(1, 5) for _ in range(3))
    text = (
        f"{{coordinates: [x, y, z], parameters: {{{_POINT}}}, T: m*(x'^2 + y'^2 + z'^2)/2, "
        f"V: m*g*z, constraints: {{s: {a}*x^2 + {b}*y^2 + {c}*z^2 = 1}}}}"
    )
    found = equilibria(derive(text).dynamics)
    assert found.complete
    assert not found.where
    assert [(to_grammar(e.at["x"]), to_grammar(e.at["y"])) for e in found.equilibria or ()] == [
        ("0", "0")
    ] * 2
    assert {e.verdict.stable for e in found.equilibria or ()} == {True, False}


@pytest.mark.long
@pytest.mark.parametrize("velocity", ["phi' = w", "phi' - w = 0", "2*phi' = 2*w"])
def test_a_driven_hoop_has_the_verdict_of_the_hoop_with_its_angle_put_in(velocity):
    parameters = f"parameters: {{{_POINT}, w: {{assume: positive}}}}"
    driven = (
        f"{{coordinates: [u, phi], {parameters}, T: m*a^2*(u'^2 + sin(u)^2*phi'^2)/2, "
        f'V: -m*g*a*cos(u), constraints: {{drive: "{velocity}"}}}}'
    )
    put_in = f"{{coordinates: [u], {parameters}, L: m*a^2*(u'^2 + sin(u)^2*w^2)/2 + m*g*a*cos(u)}}"
    first, second = (
        {str(sorted((n, to_grammar(v)) for n, v in motion.at.items())): motion.verdict
         for motion in steady_motions(derive(text))[0].motions or ()}
        for text in (driven, put_in)
    )  # fmt: skip
    assert first.keys() == second.keys()
    for place, verdict in first.items():
        other = second[place]
        assert (verdict.stable, verdict.minimum) == (other.stable, other.minimum)
        assert (verdict.theorem, verdict.unstable) == (other.theorem, other.unstable)


@pytest.mark.parametrize("seed", range(3))
def test_a_blade_turned_from_across_the_slope_slides_faster_and_faster(seed):
    """With phi' = 0 its acceleration along itself is g cos(phi) at any speed."""
    m, J = (random.Random(seed).randint(1, 9) for _ in range(2))
    text = (
        "{coordinates: [x, y, phi], parameters: {g: {assume: positive}}, "
        f"T: {m}*(x'^2 + y'^2)/2 + {J}*phi'^2/2, V: -{m}*g*x, "
        "constraints: {blade: x'*sin(phi) = y'*cos(phi)}}"
    )
    derivation = derive(text)
    verdicts = {e.verdict.stable for e in equilibria(derivation.dynamics).equilibria or ()}
    steady = {motion.verdict.stable for motion in steady_motions(derivation)[0].motions or ()}
    assert verdicts == steady == {False}
    system, motion = derivation.system, derivation.dynamics.motion
    phi, turning = system.q[2], system.qdot[2]
    along = motion.accelerations[0] * sympy.cos(phi) + motion.accelerations[1] * sympy.sin(phi)
    g = next(s for s in along.free_symbols if s.name == "g")
    assert sympy.simplify(along.xreplace({turning: sympy.S.Zero}) - g * sympy.cos(phi)) == 0
    assert motion.accelerations[2] == 0


@pytest.mark.parametrize(
    "T",
    [
        "m*(x'^2 + y'^2)/2",
        "m*((1 + x^2)*x'^2 + y'^2)/2",
        "m*(x'^2 + x'*y' + y'^2)",
        "m*(x'^2*(2 + cos(y)) + y'^2)/2",
    ],
)
@pytest.mark.parametrize("field", ["", " + x*y'"])
def test_where_every_position_is_an_equilibrium_velocities_stay_small(T, field):
    text = f"{{coordinates: [x, y], parameters: {{m: {{assume: positive}}}}, L: {T}{field}}}"
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    assert rest.verdict.stable is True
    assert field or rest.verdict.across


def test_at_given_momenta_flatness_proves_nothing():
    """U_eff = (p - x)²/2 - x²/2 is 0 at p = 0, and at other p a uniform force."""
    text = "{coordinates: [x, y], L: x'^2/2 + y'^2/2 + x*y' + x^2/2}"
    section = steady_motions(derive(text))[0]
    assert all(motion.verdict.stable is not True for motion in section.motions or ())


@pytest.mark.parametrize("seed", range(3))
def test_a_body_of_any_moments_at_rest_has_a_definite_kinetic_energy(seed):
    moments = [f"I{k}" for k in (1, 2, 3)]
    random.Random(seed).shuffle(moments)
    A, B, C = moments
    text = (
        "{coordinates: [phi, theta, psi], parameters: {I1: {assume: positive}, "
        "I2: {assume: positive}, I3: {assume: positive}}, T: "
        f"({A}*(phi'*sin(theta)*sin(psi) + theta'*cos(psi))^2 + "
        f"{B}*(phi'*sin(theta)*cos(psi) - theta'*sin(psi))^2 + {C}*(phi'*cos(theta) + psi')^2)/2}}"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria or ()
    assert rest.verdict.stable is True
