"""The further steps of an explanation: symmetries, phase space, forces, units, the model."""

from __future__ import annotations

import random

import pytest

from lagcli.document import Bracket, Label
from lagcli.expression import Diff, Expression, Name, terms_of, walk
from lagcli.formatters import explaining
from lagcli.formatters.display_width import display_width
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.options import Options
from lagcli.pipeline import explain
from lagcli.statements.registry import explained_in_order

from .derived import derive
from .formulas import formula, normal
from .test_explanation import also, rows, slope, value, words

CANONICAL = "Canonical transformations"
DISCOVERED = "Discovered symmetries"
ALGEBRA = "The algebra of the symmetries"
FORCES = "Forces"
UNITS = "Units"


def test_the_slopes_of_new_variables_are_those_of_the_formulas_before_them():
    told = also("hamiltonian/oscillator-by-generating-function", "canonical")
    source = random.Random(1)
    at = {name: source.uniform(0.3, 0.9) for name in ("x", "p_x", "m", "w", "t")}
    shown, checked = {}, 0
    for row in rows(told, CANONICAL):
        match row.left:
            case Diff():
                of, by = row.left.operand, row.left.variable
                expected = slope(shown[of], at, {by.name: 1.0})
                assert value(row.right, at) == pytest.approx(expected, abs=1e-7)
                checked += 1
            case Name():
                shown[row.left] = row.right
    assert checked == 8


def test_the_relations_of_a_generating_function_are_goldsteins():
    """Goldstein, 3rd ed., eqs. (9.35) to (9.42): F1 of the oscillator, and its K."""
    told = also("hamiltonian/oscillator-by-generating-function", "canonical")
    shown = [(row.left, to_grammar(row.right)) for row in rows(told, CANONICAL)
             if isinstance(row.right, Expression)]  # fmt: skip
    assert (Name("p_x"), "m*w*x*cot(Q)") in shown
    assert (Name("p_Q"), "m*w*x^2/(2*sin(Q)^2)") in shown
    assert (Label("K"), "w*p_Q") in shown
    assert "F generates" not in words(told, CANONICAL)
    assert "Q does not occur in it, so p_Q is constant." in words(told, CANONICAL)


@pytest.mark.parametrize("frequency", ["1 + g^2", "1 + t^2"])
def test_a_new_hamiltonian_without_the_time_is_constant(frequency):
    """x exp(g t/2), p exp(-g t/2) make the damped oscillator of Caldirola and Kanai autonomous."""
    text = (
        "{coordinates: [x], parameters: {g: {}}, "
        f"H: 'p_x^2*exp(-g*t)/2 + ({frequency})*x^2*exp(g*t)/2', canonical_transformations: "
        "{scaled: {Q: x*exp(g*t/2), p_Q: p_x*exp(-g*t/2)}}}"
    )
    told = words(explain(derive(text), ["canonical"]), CANONICAL)
    constant = "It does not depend on t explicitly, so … is constant." in told
    assert constant is ("t" not in frequency)


def test_a_bracket_that_is_wrong_is_shown_with_what_it_should_be():
    told = also("hamiltonian/exchange-of-coordinates-and-momenta", "canonical")
    notes = {
        (row.left.left, row.left.right): (to_grammar(row.right), row.note)
        for row in rows(told, CANONICAL)
        if isinstance(row.left, Bracket) and row.note
    }
    assert notes == {(Name("Y"), Name("p_Y")): ("nu", "should be 1")}


@pytest.mark.long
def test_the_brackets_of_the_charges_of_kepler():
    """Goldstein, 3rd ed., section 9.7: {A_x, A_y} = -2 m E L_z."""
    told = also("central/kepler", "discovered", "algebra")
    found = {
        (row.left.left.name, row.left.right.name): normal(row.right)
        for row in rows(told, ALGEBRA)
        if isinstance(row.left, Bracket)
    }
    assert found == {
        ("L_z", "runge_lenz_x"): formula("runge_lenz_y"),
        ("L_z", "runge_lenz_y"): formula("-runge_lenz_x"),
        ("runge_lenz_x", "runge_lenz_y"): formula("-2*m*energy*L_z"),
    }
    assert "All others are 0." in words(told, ALGEBRA)
    assert "Here their number is 2, with 2 degrees of freedom: it is integrable." in words(
        told, ALGEBRA
    )
    assert "Nothing outside of the ansatz was searched." in words(told, DISCOVERED)


def test_a_bracket_that_is_a_sum_of_charges_is_shown_as_one():
    """{h, D} is the derivative of a constant D by t at constant x and p.  By hand, with
    D = 2 m x p + 3 F t^2 p - 2 t p^2 - 2 m F t x - F^2 t^3:  -2 p^2 - 2 m F x + 6 F t p - 3 F^2 t^2.
    """
    text = "{coordinates: [x], parameters: {m: {assume: positive}, F: {}}, L: m*x'^2/2 + F*x}"
    told = explain(derive(text), ("discovered", "algebra"))
    found = {
        (row.left.left.name, row.left.right.name): normal(row.right)
        for row in rows(told, ALGEBRA)
        if isinstance(row.left, Bracket)
    }
    assert found["energy", "dilation"] == formula("-4*energy*m + 6*F*boost_x")
    assert "multiple of one of them" not in words(told, ALGEBRA)
    told = also("particles/oscillator-one-to-two", "algebra")
    assert "5 other brackets are neither 0 nor a multiple of one of them." in words(told, ALGEBRA)


@pytest.mark.parametrize("k", ["k", "3*k", "1 + k"])
def test_brackets_of_charges_that_have_no_value_at_time_0(k):
    """x'' = -k x/t^2 has the solutions sqrt(t) cos(c ln(t)/2) with c^2 = 4 k - 1 (Euler, Cauchy).

    Stretching t by e^(2 s) moves c ln(t)/2 by c s, so it turns the cosine into the sine.
    """
    text = (
        "{coordinates: [x], parameters: {m: {assume: positive}, k: {assume: positive}}, "
        f'T: "m*x\'^2/2", V: "m*({k})*x^2/(2*t^2)"}}'
    )
    told = explain(derive(text), ("algebra",))
    found = {
        (row.left.left.name, row.left.right.name): normal(row.right)
        for row in rows(told, ALGEBRA)
        if isinstance(row.left, Bracket)
    }
    c = f"sqrt(4*({k}) - 1)"
    assert found["dilation", "translation_x_cos"] == formula(f"{c}*translation_x_sin")
    assert found["dilation", "translation_x_sin"] == formula(f"-{c}*translation_x_cos")
    assert "other bracket" not in words(told, ALGEBRA)


@pytest.mark.long
def test_a_momentum_equation_is_told_with_its_rate():
    told = also("nonholonomic/chaplygin-sleigh", "discovered")
    assert Name("Q", 1) in {row.left for row in rows(told, DISCOVERED)}
    assert "The momentum is not constant: it has this rate." in words(told, DISCOVERED)


def test_the_friction_that_a_disk_needs_goes_from_multipliers_to_forces():
    """Goldstein, 3rd ed., section 2.4: m g sin(alpha)/3 for the disk."""
    told = also("rolling/disk-on-incline-with-contact", "forces")
    shown = rows(told, FORCES)
    assert (Label("F", ("disk", "x")), "-F") in {(r.left, to_grammar(r.right)) for r in shown}
    magnitudes = [to_grammar(r.right) for r in shown if r.left == Label("F", ("disk",))]
    assert magnitudes == ["m*g*cos(alpha)", "m*g*sin(alpha)/3"]
    assert to_grammar(shown[-1].right) == "tan(alpha)/3"
    assert "The contact is one-sided: it holds while … ≥ 0." in words(told, FORCES)


def test_units_go_from_those_given_to_those_of_momenta_and_forces():
    told = also("rolling/disk-on-incline-with-contact", "dimensions", "model")
    shown = {row.left: row.right for row in rows(told, UNITS)}
    assert str(shown[Label("p_theta", unit=True)]) == "kg m^2/s"
    assert str(shown[Label("Q", ("theta",), unit=True)]) == "N m"
    assert str(shown[Label("F", unit=True)]) == "N"
    assert "It integrates x, y and theta." in words(told, "The model of a numerical run")


@pytest.mark.long
@pytest.mark.parametrize("name", ["central/kepler", "contact/car-in-loop"])
def test_every_further_step_is_set_in_every_format(name):
    told = [also(name, *(each.name for each in explained_in_order()))]
    for line in explaining.render(told, "text", Options(width=80)).splitlines():
        assert display_width(line) <= 80, line
    for format_name in ("markdown", "html", "json", "latex"):
        assert explaining.render(told, format_name, Options())


@pytest.mark.long
def test_a_hoop_that_rolls_straight_on_has_the_frequency_that_its_stability_is_read_from():
    told = also("steady/rolling-hoop", "steady_motions")
    title = "Steady motions"
    shown = [to_grammar(row.right) for row in rows(told, title) if row.left != Name("psi", 1)]
    assert "8*psi'^2/3 - 2*g/(3*R)" in shown
    assert "The constraints give x' and y' in terms of the other velocities" in words(told, title)
    assert "cyclic" not in words(told, title)


@pytest.mark.parametrize("motion", [" + v*t", ""])
def test_the_momenta_of_the_hamilton_jacobi_equation_are_of_what_the_constraint_leaves(motion):
    """p_x of T = m (x'² + y'²)/2 on y = x + v t is not m x', also where H depends on the time."""
    text = (
        "{coordinates: [x, y], parameters: {m: {assume: positive}, g: {assume: positive}, "
        "v: {assume: positive}}, T: m*(x'^2 + y'^2)/2, V: m*g*y, "
        f"constraints: {{table: y = x{motion}}}}}"
    )
    told = words(explain(derive(text), ("hamilton_jacobi",)), "The Hamilton-Jacobi equation")
    assert "The constraint is used to eliminate y, and the momenta are those of the" in told


@pytest.mark.long
@pytest.mark.parametrize(
    "file",
    ["driven/oscillator-fading-as-inverse-square-of-time", "impact/block-on-shaking-table"],
)
def test_a_bracket_has_each_charge_once(file):
    """(1 - 4 k) Q/2, not (Q - 4 k Q)/2; -4 E - 6 g K, not -2 (2 E + 3 g K)."""
    charges = [*rows(also(file, "algebra"), ALGEBRA)]
    assert charges
    names = {part for row in charges for part in (row.left.left, row.left.right)}
    for row in charges:
        found = [part for part in walk(row.right) if part in names]
        assert len(found) == len({*found})
        for term in terms_of(row.right):
            assert sum(part in names for part in walk(term)) <= 1
