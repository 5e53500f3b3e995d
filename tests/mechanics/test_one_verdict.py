"""One verdict for a place in every section, and no step that its own verification retracts."""

from __future__ import annotations

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.mechanics.reduction.steady_statement import steady_motions
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
    assert "No other root is real" in told
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
    """A rod upright against a wall: where the wall may be left, the guided motion says nothing."""
    text = (
        f"{{coordinates: [x, y, u], parameters: {{{_M}}}, V: m*y, "
        "T: m*(x'^2 + y'^2)/2 + k*u'^2/2, constraints: {"
        "wall: {equation: x = sin(u), multiplier: N, holds_while: N >= 0}, "
        "floor: {equation: y = cos(u), multiplier: F, holds_while: F >= 0}}}"
    )
    derivation = derive(text)
    places = equilibria(derivation.dynamics).equilibria or ()
    for each in (*places, *(steady_motions(derivation)[0].motions or ())):
        verdict = each.verdict
        assert (verdict.stable, verdict.reason) == (None, places[0].verdict.reason)
