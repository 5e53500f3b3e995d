"""The account of a derivation: its formulas against finite differences, its sentences."""

from __future__ import annotations

import math
import random
import re
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
import sympy

from lagcli import load
from lagcli.algebra.build import Builder
from lagcli.document import Bracket, Equations, Heading, Items, Label, Paragraph
from lagcli.expression import Diff, Expression, Name, Number, Power, Rate, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.explaining import further
from lagcli.pipeline import derive, explain
from lagcli.platform.effort import OutOfWork
from lagcli.rewriting import parts_in, rebuilt
from lagcli.statements.registry import explained_in_order

from .derived import derive as derive_text
from .formulas import formula, normal

PROBLEMS = Path(__file__).parents[2] / "problems"

SMOOTH = (
    "hoop",
    "pendulums/pendulum-with-rod",
    "pendulums/double-pendulum",
    "nonholonomic/chaplygin-sleigh",
    "driven/driven-damped-oscillator",
    "relativity/lorentz-boost",
    "rigid/heavy-symmetric-top",
    "pulleys/double-atwood-tension",
)


def told(name):
    return explain(derive(load(PROBLEMS / f"{name}.yaml")))


def told_text(text):
    return explain(derive_text(text))


def rows(explanation, title=None):
    return [
        row
        for step in explanation.steps
        if title in {None, step.title}
        for block in step.blocks
        if isinstance(block, Equations)
        for row in block.rows
    ]


def words(explanation, title=None):
    """The sentences, names as the grammar writes them."""
    found = []
    for step in explanation.steps:
        if title not in {None, step.title}:
            continue
        for block in step.blocks:
            sentences = []
            if isinstance(block, Paragraph):
                sentences = [block.parts]
            elif isinstance(block, Items):
                sentences = block.items
            for parts in sentences:
                shown = (part if isinstance(part, (str, Name)) else "…" for part in parts)
                found.append("".join(map(str, shown)))
    return " ".join(found)


def value(tree, at):
    """A number for a tree, with SymPy's evaluation beside the derivation's algebra."""
    flat = _flat(tree)
    names = {n.name: sympy.Symbol(n.name) for n in walk(flat) if isinstance(n, Name)}
    built = Builder(names, {}, lambda expression: expression)(flat)
    return float(built.subs({symbol: at[symbol.name] for symbol in built.free_symbols}))


def _flat(tree):
    """Velocities as plain names, so that nothing is differentiated."""
    if isinstance(tree, Name):
        return Name(tree.name + "_d" * tree.primes)
    return rebuilt(tree, _flat)


def moment(explanation, seed):
    source = random.Random(seed)
    at = {name: source.uniform(0.3, 0.6) for name in (*explanation.parameters, "t")}
    if "c" in at:
        at["c"] = 3.0
    for name in explanation.coordinates:
        for primes in range(3):
            at[name + "_d" * primes] = source.uniform(0.2, 0.9)
    return at


def slope(tree, at, along):
    """The directional derivative of a tree by central differences."""
    step = 1e-5
    before = {name: x - step * along.get(name, 0.0) for name, x in at.items()}
    after = {name: x + step * along.get(name, 0.0) for name, x in at.items()}
    return (value(tree, after) - value(tree, before)) / (2 * step)


@pytest.mark.long
@pytest.mark.parametrize("name", SMOOTH)
def test_every_derivative_is_that_of_the_formula_before_it(name):
    explanation = told(name)
    shown = {row.left: row.right for row in rows(explanation) if isinstance(row.left, Expression)}
    checked = 0
    for seed in range(2):
        at = moment(explanation, seed)
        flow = {"t": 1.0}
        for coordinate in explanation.coordinates:
            for primes in range(2):
                flow[coordinate + "_d" * primes] = at[coordinate + "_d" * (primes + 1)]
        for left, right in shown.items():
            match left:
                case Diff(operand=Name() as function, variable=variable) if function in shown:
                    expected = slope(
                        shown[function], at, {variable.name + "_d" * variable.primes: 1.0}
                    )
                case Rate(operand=inner):
                    expected = slope(shown[inner], at, flow)
                case _:
                    continue
            checked += 1
            assert math.isclose(value(right, at), expected, rel_tol=1e-6, abs_tol=1e-7), left
    assert checked >= 4


@pytest.mark.parametrize(
    ("name", "multipliers"),
    [
        # Goldstein, Poole, Safko, 3rd ed., section 2.4: the hoop on the incline
        ("hoop", {"lambda_rolling": "-M*g*sin(alpha)/2"}),
        # m l theta'^2 + m g cos(theta) pulls inwards, along -r
        ("pendulums/pendulum-with-rod", {"lambda_rod": "-m*(l*theta'^2 + g*cos(theta))"}),
    ],
)
def test_the_multipliers_are_the_textbooks(name, multipliers):
    found = {
        row.left.name: normal(row.right)
        for row in rows(told(name), "The multipliers are eliminated")
        if isinstance(row.left, Name) and not row.left.primes
    }
    assert found == {symbol: formula(text) for symbol, text in multipliers.items()}


def test_a_hoop_from_the_constraint_to_the_force():
    explanation = told("hoop")
    titles = [step.title for step in explanation.steps]
    assert titles == [
        "The system",
        "The Lagrangian",
        "Lagrange's equations",
        "The multipliers are eliminated",
        "The verification",
        "What the multipliers mean",
        "The energy",
        "Conserved quantities",
    ]
    assert "'rolling' contains no velocity, it is holonomic" in words(explanation)
    assert "2 − 1 = 1, so the system has one degree of freedom." in words(explanation)
    assert "it simplifies to 0 exactly" in words(explanation, "The verification")
    assert explanation.complete


KINDS = """
title: Kinds
coordinates: [x, y, z, phi]
parameters: [w]
T: (x'^2 + y'^2 + z'^2 + phi'^2)/2
constraints:
  blade: x'*sin(phi) = y'*cos(phi)
  lift: z = w*t
"""


def test_each_constraint_is_called_what_it_is():
    text = words(told_text(KINDS), "The system")
    assert "'blade' relates velocities" in text
    assert "nonholonomic" in text
    assert "'lift' contains no velocity, it is holonomic" in text
    assert text.count("so the constraint itself moves and its force can do work") == 1
    assert "4 − 2 = 2" in text


def test_an_integrable_constraint_is_no_nonholonomic_one():
    text = words(told("nonholonomic/circle-as-velocity-constraint"), "The system")
    assert "yet it can be integrated" in text
    assert "nonholonomic" not in text


def test_redundant_multipliers_are_not_made_up():
    explanation = told("nonholonomic/doubled-rolling-constraint")
    text = words(explanation, "The multipliers are eliminated")
    assert "lambda_rolling and lambda_no_slip are not unique" in text
    lefts = [row.left for row in rows(explanation, "The multipliers are eliminated")]
    assert Name("lambda_no_slip") not in lefts
    assert explanation.complete


def test_a_singular_lagrangian_is_not_solved():
    explanation = told_text(
        "title: Singular\ncoordinates: [x, y]\nparameters: [k]\nL: x'^2/2 + x*y - k*y^2/2\n"
    )
    assert "has no inverse along y" in words(explanation)
    assert "The verification" not in [step.title for step in explanation.steps]
    assert "Hamiltonian" not in words(explanation)
    assert not explanation.complete


@pytest.mark.parametrize(
    ("energy", "sentence"),
    [
        ("T: m*x'^2/2\nV: k*x^2/2", "and V contains none, so h is the total energy"),
        ("T: m*x'^2/2", "V is 0 and h equals T."),
        (
            "T: m*(x' + k*t)^2/2\nV: k*x",
            "T is not homogeneous of degree two in the velocities, so h does not equal T + V.",
        ),
        (
            "T: m*x'^2/2\nV: k*x*x'",
            "The terms of V linear in the velocities drop out: h equals T plus the rest of V.",
        ),
        ("L: m*x'^2/2 - k*x^2/2", "Only L is given, so it is not compared with T + V."),
        ("T: m*x'^2/2\nforces: {x: k*x'}", "the applied forces do work"),
        ("T: m*x'^2/2\ndissipation: k*x'^2/2", "the dissipation takes energy"),
        ("T: m*x'^2/2\nV: k*x*t", "L depends on t explicitly"),
    ],
)
def test_the_energy_is_told_for_what_it_is(energy, sentence):
    text = f"title: Energy\ncoordinates: [x]\nparameters: [m, k]\n{energy}\n"
    assert sentence in words(told_text(text), "The energy")


def test_letters_of_the_file_are_left_to_it():
    explanation = told_text(
        "title: Rod\ncoordinates: [q]\nparameters: [L, T, m]\nT: m*L^2*q'^2/2\nV: T*q^2/2\n"
    )
    assert "L and T mean something else in this file" in words(explanation)
    shown = {row.left: row.right for row in rows(explanation)}
    assert Name("L_sys") in shown
    assert Name("L") not in shown


@pytest.mark.parametrize(
    ("kinetic", "told"),
    [
        ("m*(a - q)*q'^2/2", True),
        ("m*(a^2 + q^2)*q'^2/2", False),
        ("m*(q'^2 + s'^2*sin(q)^2)/2", True),
        ("m*q'^2/2 + m*exp(q)*s'^2/2", False),
    ],
)
def test_an_equation_is_not_divided_by_a_coefficient_that_vanishes(kinetic, told):
    coordinates = "[q, s]" if "s'" in kinetic else "[q]"
    explanation = told_text(
        f"title: Bead\ncoordinates: {coordinates}\nparameters: {{m: {{assume: positive}}, "
        f"a: {{assume: positive}}}}\nT: {kinetic}\nV: m*a*q\n"
    )
    assert (", where that is not 0," in words(explanation, "The accelerations")) is told


@pytest.mark.parametrize(("friction", "told"), [("", False), ("dissipation: c*q'^2/2\n", True)])
def test_no_word_is_lost_on_a_letter_that_does_not_occur(friction, told):
    """D is the depth of a well; that a dissipation function would be D_sys matters with one."""
    explanation = told_text(
        "title: Well\ncoordinates: [q]\nparameters: [D, c, m]\nT: m*q'^2/2\nV: D*q^4\n" + friction
    )
    assert ("means something else" in words(explanation)) is told


@pytest.mark.parametrize(
    ("letters", "pair"), [("[k, m]", "AB"), ("[A, m]", "fg"), ("[B, m]", "fg"), ("[A, f]", "uv")]
)
def test_any_two_functions_have_letters_that_the_file_leaves_free(letters, pair):
    constant = letters[1]
    text = f"coordinates: [q]\nparameters: {letters}\nT: q'^2/2\nV: {constant}*q^2\n"
    explanation = explain(derive_text(text), ("brackets",))
    step = next(each for each in explanation.steps if each.title == "Poisson brackets")
    bracket = next(part for part in parts_in(step, Bracket))
    assert (bracket.left, bracket.right) == (Name(pair[0]), Name(pair[1]))


def test_the_energy_calls_the_lagrangian_by_its_letter():
    explanation = told_text(
        "title: Cart\ncoordinates: [q]\nparameters: [L, m]\nT: m*q'^2/2\nV: L*q*t\n"
    )
    sentence = words(explanation, "The energy")
    assert "L_sys depends on t explicitly" in sentence
    assert " L depends" not in sentence


def also(name, *sections):
    return explain(derive(load(PROBLEMS / f"{name}.yaml")), sections)


@pytest.mark.long
def test_the_further_steps_are_told_only_when_asked_for():
    titles = [step.title for step in told("pendulums/plane-pendulum").steps]
    more = also("pendulums/plane-pendulum", *(each.name for each in explained_in_order()))
    added = [step.title for step in more.steps if step.title not in titles]
    assert added == [
        "Questions",
        "Equilibria",
        "Small oscillations",
        "The reduction",
        "Steady motions",
        "Canonical equations",
        "Poisson brackets",
        "Canonical transformations",
        "The Hamilton-Jacobi equation",
        "Discovered symmetries",
        "The algebra of the symmetries",
        "Forces",
        "The model of a numerical run",
        "Units",
    ]


def test_small_oscillations_go_from_the_matrices_to_the_textbooks_frequency():
    """Goldstein, section 6.2: K - omega^2 M is singular."""
    explanation = also("pendulums/plane-pendulum", "equilibria", "modes")
    shown = {row.left: row.right for row in rows(explanation, "Small oscillations")}
    K, M = shown[Label("K", matrix=True)], shown[Label("M", matrix=True)]
    assert normal(shown[Name("omega")]) ** 2 == normal(K) / normal(M)
    assert "Stable: … has a strict minimum" in words(explanation, "Equilibria")
    assert "decreases to second order" in words(explanation, "Equilibria")


@pytest.mark.long
def test_a_steady_motion_goes_from_its_condition_to_its_frequency():
    """Goldstein, chapter 3, and Landau and Lifshitz, section 14: the conical pendulum."""
    explanation = also("steady/conical-pendulum", "steady_motions")
    told = words(explanation, "Steady motions")
    assert "the cyclic ones have constant velocities" in told
    assert "Stable: " in told
    shown = list(rows(explanation, "Steady motions"))
    assert to_grammar(shown[1].right) == "sqrt(g/(l*cos(theta)))"
    square = Power(Name("omega"), Number(Fraction(2)))
    assert "g*(1 + 3*cos(theta)^2)/(l*cos(theta))" in {
        to_grammar(row.right) for row in shown if row.left == square
    }


@pytest.mark.long
def test_the_action_is_told_with_its_cases():
    explanation = also("hamilton-jacobi/kepler-polar", "canonical_equations", "hamilton_jacobi")
    assert "Levi-Civita" in words(explanation, "The Hamilton-Jacobi equation")
    lefts = [row.left for row in rows(explanation, "The Hamilton-Jacobi equation")]
    assert lefts.count(Label("W", ("r",))) == 3
    pairs = {row.left: row.right for row in rows(explanation, "Canonical equations")}
    assert to_grammar(pairs[Name("p_phi", 1)]) == "0"


@pytest.mark.long
def test_the_reduction_ends_at_the_effective_potential():
    """Goldstein, section 3.2, and Landau and Lifshitz, section 14."""
    explanation = also("reduction/kepler-radial-motion", "reduction")
    shown = {row.left: row.right for row in rows(explanation, "The reduction")}
    assert normal(shown[Label("U", ("eff",))]) == formula("p_phi^2/(2*m*r^2) - k/r")
    assert normal(shown[Name("phi", 1)]) == formula("p_phi/(m*r^2)")


@pytest.mark.long
def test_a_question_is_told_with_what_is_put_in():
    explanation = also("contact/car-in-loop", "find")
    shown = {row.left: row.right for row in rows(explanation, "Questions")}
    assert normal(shown[Name("N")]) == formula("m*v0^2/R + m*g*(3*cos(theta) - 2)")
    assert "For which v0 is N ≥ … at all times?" in words(explanation, "Questions")
    assert explanation.complete


def test_a_further_step_that_takes_too_much_is_left_out_alone(monkeypatch):
    blocks = further._blocks

    def limited(explainer, statements, name, explained):
        if name == "discovered":
            raise OutOfWork
        return blocks(explainer, statements, name, explained)

    monkeypatch.setattr(further, "_blocks", limited)
    account = explain(derive(load("hoop")), ("discovered", "equilibria"))
    assert [step.title for step in account.steps][-2:] == ["Discovered symmetries", "Equilibria"]
    assert not account.complete
    assert any("'discovered' was not explained: it takes more work" in w for w in account.warnings)
    assert len(account.steps[-1].blocks) > 2


def test_what_is_not_found_makes_the_account_incomplete():
    explanation = also("driven/kapitza-pendulum", "steady_motions")
    assert not explanation.complete
    assert any("steady motions" in warning for warning in explanation.warnings)


def chain(n):
    links = range(n)
    coordinates = ", ".join(f"a{i}" for i in links)
    x = [" + ".join(f"l*sin(a{j})" for j in range(i + 1)) for i in links]
    y = [" - ".join(["0", *(f"l*cos(a{j})" for j in range(i + 1))]) for i in links]
    points = "".join(f"  p{i}: {{position: ['{x[i]}', '{y[i]}'], mass: m}}\n" for i in links)
    potential = " + ".join(f"m*g*({each})" for each in y)
    return told_text(
        f"title: Chain\ncoordinates: [{coordinates}]\nparameters: [m, l, g]\n"
        f"points:\n{points}V: {potential}\n"
    )


@pytest.mark.long
def test_a_system_of_more_than_a_page_stays_in_matrix_form():
    explanation = chain(14)
    assert "the system stays in this matrix form" in words(explanation)
    assert "14 degrees of freedom" in words(explanation)
    assert not explanation.complete


@pytest.mark.long
def test_a_large_system_is_solved_by_elimination_with_its_steps_named():
    explanation = chain(6)
    assert "six degrees of freedom" in words(explanation)
    assert "Gauss's elimination solves them" in words(explanation)
    assert explanation.complete


@pytest.mark.long
def test_sentences_end_and_no_word_stands_twice():
    for name in SMOOTH:
        explanation = told(name)
        for step in explanation.steps:
            assert step.blocks
            for before, after in pairwise(step.blocks):
                two = isinstance(before, Heading) and isinstance(after, Heading)
                assert not two
        assert not re.search(r"\b(\w+) \1\b", words(explanation))
        assert not any(
            isinstance(row.left, Label) and not row.left.index and not row.left.change
            for row in rows(explanation)
        )
