"""Poisson brackets and canonical transformations against their own laws."""

from __future__ import annotations

import re

import pytest
import sympy

from lagcli.mechanics.canonical.inverse import undone
from lagcli.mechanics.canonical.poisson import poisson, rate
from lagcli.mechanics.canonical.transformation import CanonicalTest
from lagcli.mechanics.derivation import Derivation
from lagcli.pipeline import Request, state
from lagcli.reader import parse_text
from lagcli.statements.phase_space import (
    BracketsSection,
    ExaminedTransformation,
    TransformationsSection,
)

from .derived import derive

PLANE = "coordinates: [x, y]\nparameters: {m: {assume: positive}, k: {}}\n"
LINE = "coordinates: [x]\nparameters: {m: {assume: positive}, w: {assume: positive}}\n"
OSCILLATOR = LINE + "H: p_x^2/(2*m) + m*w^2*x^2/2\n"


def built(d: Derivation, *formulas: str) -> list[sympy.Expr]:
    return [d.system.build(parse_text(formula)) for formula in formulas]


def transformed(text: str) -> ExaminedTransformation:
    section = state(derive(text), Request(sections=("canonical",))).sections["canonical"]
    assert isinstance(section, TransformationsSection)
    [found] = section.transformations
    return found


def bracket_section(text: str) -> BracketsSection:
    section = state(derive(text), Request(sections=("brackets",))).sections["brackets"]
    assert isinstance(section, BracketsSection)
    return section


# -- brackets ------------------------------------------------------------------------------


def test_sign_convention():
    d = derive(PLANE + "T: m*(x'^2 + y'^2)/2")
    x, y, p = built(d, "x", "y", "p_x")
    assert poisson(x, p, d.system) == 1
    assert poisson(p, x, d.system) == -1
    assert poisson(y, p, d.system) == 0


@pytest.mark.long
def test_jacobi_leibniz_and_antisymmetry():
    d = derive(PLANE + "T: m*(x'^2 + y'^2)/2")
    f, g, h = built(d, "x^2*p_y + sin(y)*t", "exp(x)*p_x*p_y", "p_x^2/(1 + y^2) + x*y")

    def bracket(a: sympy.Expr, b: sympy.Expr) -> sympy.Expr:
        return poisson(a, b, d.system)

    cyclic = bracket(f, bracket(g, h)) + bracket(g, bracket(h, f)) + bracket(h, bracket(f, g))
    assert cyclic.equals(0)
    assert (bracket(f, g) + bracket(g, f)).equals(0)
    assert (bracket(f * g, h) - f * bracket(g, h) - bracket(f, h) * g).equals(0)


def test_rate_is_the_total_derivative_on_the_motion():
    d = derive(PLANE + "H: (p_x^2 + p_y^2)/(2*m) + k*x^2*y + t*x")
    [f] = built(d, "x*p_y^2 + t^2*y + p_x")
    flow = dict(zip(d.system.momenta, d.dynamics.lagrange.momenta, strict=True))
    motion = dict(zip(d.system.qddot, d.dynamics.motion.accelerations, strict=True))
    along = d.system.total_derivative(f.xreplace(flow)).xreplace(motion)
    assert d.system.H is not None
    assert (rate(f, d.system.H, d.system).xreplace(flow) - along).equals(0)


def test_charges_by_name_and_named_values():
    """Goldstein 3rd ed., (9.128): the brackets of two components give the third."""
    section = bracket_section(
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}}\nfunctions: {U: [s]}\n"
        "T: m*(x'^2 + y'^2 + z'^2)/2\nV: U(x^2 + y^2 + z^2)\nsymmetries:\n"
        "  about_x: {y: -z, z: y}\n  about_y: {z: -x, x: z}\n  about_z: {x: -y, y: x}\n"
        "brackets: {a: [about_x, about_y], b: [about_z, H]}"
    )
    one, other = section.brackets
    assert str(one.named) == "about_z"
    assert other.value == parse_text("0")


def test_pairs_of_observables_are_shown_unasked():
    section = bracket_section(OSCILLATOR + "observables: {A: x^2, B: p_x, C: A*B}")
    assert [each.name for each in section.brackets] == ["A, B", "A, C", "B, C"]
    assert section.rates is not None
    assert section.rates["B"] == parse_text("-m*w^2*x")


def test_no_rates_where_forces_act():
    section = bracket_section(OSCILLATOR + "observables: {A: x}\ndissipation: x'^2")
    assert section.rates is None
    assert "dissipation" in section.reason


# -- transformations --------------------------------------------------------------------------

KINDS = {
    # one sign, one factor, one derivative wrong: each must be seen
    "Q: x, p_Q: p_x": "canonical",
    "Q: p_x, p_Q: -x": "canonical",
    "Q: p_x, p_Q: x": "extended canonical",
    "Q: x^2, p_Q: p_x/(2*x)": "canonical",
    "Q: x^2, p_Q: p_x": "not canonical",
    "Q: x + t*p_x, p_Q: p_x": "canonical",
    "Q: x*exp(t), p_Q: p_x": "not canonical",  # c = exp(t) is no constant
    "Q: x, p_Q: p_x + sign(x)": "canonical",
    "Q: x, p_Q: x": "not canonical",
    "Q: 3*x, p_Q: p_x": "extended canonical",
}


@pytest.mark.parametrize("formulas", KINDS)
def test_kind(formulas: str):
    found = transformed(OSCILLATOR + f"canonical_transformations: {{a: {{{formulas}}}}}")
    assert found.kind == KINDS[formulas]
    assert bool(found.failing) == (found.kind == "not canonical")


#: Formulas with parameters, the kind in general, and values for which it is canonical, if any
WITH_PARAMETERS = {
    "Q: m*x, p_Q: w*p_x": ("extended canonical", {"m": "2", "w": "1/2"}),
    "Q: w^2*x, p_Q: p_x": ("extended canonical", {"w": "1"}),
    "Q: x + (w - 2)*x^2, p_Q: p_x": ("not canonical", {"w": "2"}),
    "Q: -m*x, p_Q: p_x": ("extended canonical", None),  # m > 0
    "Q: x^2, p_Q: p_x": ("not canonical", None),
    "Q: m*x, p_Q: p_x/m": ("canonical", {"m": "7"}),
    "Q: 3*x, p_Q: p_x": ("extended canonical", None),
}


@pytest.mark.parametrize("formulas", WITH_PARAMETERS)
def test_a_kind_that_values_of_the_parameters_change_is_so_in_general(formulas: str):
    kind, values = WITH_PARAMETERS[formulas]
    text = OSCILLATOR + f"canonical_transformations: {{a: {{{formulas}}}}}"
    found = transformed(text)
    assert found.kind == kind
    assert found.in_general is (kind != "canonical" and values is not None)
    for name, value in (values or {}).items():
        formulas = re.sub(rf"\b{name}\b", f"({value})", formulas)
    if values is not None:
        there = transformed(OSCILLATOR + f"canonical_transformations: {{a: {{{formulas}}}}}")
        assert there.kind == "canonical"


def test_the_failing_brackets_are_named():
    found = transformed(
        PLANE + "H: p_x^2 + p_y^2\ncanonical_transformations:\n"
        "  a: {X: x, p_X: p_x + y, Y: y, p_Y: p_y}"
    )
    [bracket] = found.failing
    assert (bracket.left, bracket.right) == ("p_X", "p_Y")
    assert bracket.value == parse_text("1")


@pytest.mark.parametrize(
    "generating",
    ["F1: x*Q", "F4: p_x*p_Q"],
)
def test_exchange_is_generated(generating: str):
    """Goldstein 3rd ed., table 9.1."""
    found = transformed(
        OSCILLATOR + f"canonical_transformations: {{a: {{Q: p_x, p_Q: -x, {generating}}}}}"
    )
    assert found.generator is not None
    assert found.generator.generates is True


@pytest.mark.parametrize("generating", ["F2: x*p_Q", "F3: -p_x*Q"])
def test_identity_is_generated(generating: str):
    """Goldstein 3rd ed., table 9.1."""
    found = transformed(
        OSCILLATOR + f"canonical_transformations: {{a: {{Q: x, p_Q: p_x, {generating}}}}}"
    )
    assert found.generator is not None
    assert found.generator.generates is True


@pytest.mark.parametrize("generating", ["F1: -x*Q", "F2: x*p_Q", "F3: p_x*Q", "F4: -p_x*p_Q"])
def test_a_wrong_generating_function_is_refused(generating: str):
    found = transformed(
        OSCILLATOR + f"canonical_transformations: {{a: {{Q: p_x, p_Q: -x, {generating}}}}}"
    )
    assert found.kind == "canonical"
    assert found.generator is not None
    assert found.generator.generates is False
    assert found.generator.failing


def test_the_function_that_is_found_has_the_differential():
    """c p dq - P dQ = dF at constant t."""
    d = derive(OSCILLATOR + "canonical_transformations: {a: {Q: x*p_x^2, p_Q: -3/p_x}}")
    test = CanonicalTest(d.system, d.problem.canonical_transformations[0])
    Q, P = test.functions
    (x,), (p,) = d.system.q, d.system.momenta
    F, c = test.action_form, test.valence
    assert F is not None
    assert (F.diff(x) - (c * p - P * Q.diff(x))).equals(0)
    assert (F.diff(p) + P * Q.diff(p)).equals(0)


def test_new_hamiltonian_gives_the_old_motion():
    """dQ/dt = dK/dP and dP/dt = -dK/dQ agree with the motion, with time and valence in it."""
    d = derive(
        OSCILLATOR + "canonical_transformations: {a: {Q: 2*x + t^2*p_x, p_Q: 3*p_x - m*t*t^2}}"
    )
    test = CanonicalTest(d.system, d.problem.canonical_transformations[0])
    assert d.system.H is not None
    found = test.new_hamiltonian(d.system.H)
    assert found is not None
    K, how = found
    assert how == "exact"
    for f, derivative in zip(test.functions, (K.diff(test.P[0]), -K.diff(test.Q[0])), strict=True):
        along = rate(f, d.system.H, d.system)
        assert (along - derivative.xreplace(test.put_in)).equals(0)


def test_without_lagrangian_there_are_brackets_and_transformations():
    """A ray of light: H = c |p| (Landau, Lifshitz, Fields, section 53)."""
    d = derive(
        "coordinates: [x]\nparameters: {c: {assume: positive}}\nH: c*p_x\n"
        "observables: {A: x*p_x}\ncanonical_transformations: {a: {Q: x - c*t, p_Q: p_x}}"
    )
    sections = state(d, Request(sections=("brackets", "canonical"))).sections
    brackets, canonical = sections["brackets"], sections["canonical"]
    assert isinstance(brackets, BracketsSection)
    assert isinstance(canonical, TransformationsSection)
    assert brackets.rates == {"A": parse_text("c*p_x")}
    assert canonical.transformations[0].hamiltonian == parse_text("0")


@pytest.mark.parametrize(
    "text", ["sqrt(x)*y", "2*x^2 - y*x + 1", "exp(atan(x)/y) + 1", "y/(1 + x^3)", "log(sin(x)/y)"]
)
def test_undone(text: str):
    """Some root, put back, gives the value."""
    x, y = sympy.symbols("x y", positive=True)
    f = sympy.sympify(text, locals={"x": x, "y": y})
    at = {x: sympy.Rational(3, 7), y: sympy.Rational(5, 3)}
    value = sympy.N(f.subs(at), 30)
    roots = [sympy.N(r.subs(at), 30) for r in undone(f, x, value)]
    assert any(abs(root - sympy.Rational(3, 7)) < 1e-20 for root in roots)


def test_a_new_momentum_belongs_to_its_coordinate_by_name():
    found = transformed("""
coordinates: [x, y]
L: (x'^2 + y'^2)/2
canonical_transformations:
  same: {Q: x, R: y, p_R: p_y, p_Q: p_x}
""")
    assert found.kind == "canonical"
