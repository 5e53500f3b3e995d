"""Noether's theorem: charges, boundary terms, and what breaks a symmetry."""

from __future__ import annotations

import pytest

from lagcli.document import Equations
from lagcli.expression import Name, Negative, walk
from lagcli.pipeline import Request, explain, state
from lagcli.statements.wording import CHANGE_OF_L

from .derived import charge, derive, same
from .test_explanation import words

FREE = "coordinates: [x, y]\nparameters: {m: {assume: positive}, k: {}, c: {assume: positive}}\n"


def listed(text: str):
    """The symmetries as they are printed."""
    answers = state(derive(text), Request(sections=("charges",)))
    assert not answers.warnings
    return answers.sections["charges"].charges


def symmetry(text: str, change: str):
    d = derive(FREE + text + f"\nsymmetries: {{s: {{{change}}}}}")
    return d, charge(d, "s")


@pytest.mark.parametrize(
    ("lagrangian", "change", "expected"),
    [
        # Goldstein, 3rd ed., section 13.7, and Levy-Leblond, Am. J. Phys. 39 (1971) 502
        ("T: m*(x'^2+y'^2)/2", "x: 1", "m*x'"),
        ("T: m*(x'^2+y'^2)/2", "x: t", "m*x'*t - m*x"),
        ("T: m*(x'^2+y'^2)/2", "x: -y, y: x", "m*(x*y' - y*x')"),
        ("T: m*(x'^2+y'^2)/2", "t: 1", "-m*(x'^2+y'^2)/2"),
        # dilation and conformal time of the inverse square: Jackiw, Physics Today 25 (1972) 23
        (
            "T: m*x'^2/2\nV: k/x^2 - m*y'^2/2",
            "t: 2*t, x: x, y: y",
            "m*(x*x'+y*y') - 2*t*(m*(x'^2+y'^2)/2 + k/x^2)",
        ),
        (
            "T: m*x'^2/2\nV: k/x^2 - m*y'^2/2",
            "t: t^2, x: t*x, y: t*y",
            "m*t*(x*x'+y*y') - t^2*(m*(x'^2+y'^2)/2 + k/x^2) - m*(x^2+y^2)/2",
        ),
        # Runge-Lenz: Goldstein, 3rd ed., section 3.9
        (
            "T: m*(x'^2+y'^2)/2\nV: -k/sqrt(x^2+y^2)",
            "x: -y*y', y: 2*x*y' - y*x'",
            "m*y'*(x*y' - y*x') - k*x/sqrt(x^2+y^2)",
        ),
        # a boost along x of a relativistic particle: Landau, Lifshitz, Fields, section 14
        (
            "L: -m*c^2*sqrt(1 - (x'^2+y'^2)/c^2)",
            "t: x/c^2, x: t",
            "m*(t*x' - x)/sqrt(1 - (x'^2+y'^2)/c^2)",
        ),
        # oscillator: q -> q + e sin(w t), Lutzky, J. Phys. A 11 (1978) 249
        (
            "T: m*(x'^2+y'^2)/2\nV: m*k^2*(x^2+y^2)/2",
            "x: sin(k*t)",
            "m*x'*sin(k*t) - m*k*x*cos(k*t)",
        ),
        # magnetic translation: uniform field in the symmetric gauge
        ("L: m*(x'^2+y'^2)/2 + k*(x*y' - y*x')/2", "x: 1", "m*x' - k*y"),
    ],
)
def test_charges(lagrangian: str, change: str, expected: str):
    d, found = symmetry(lagrangian, change)
    assert found.conserved is True
    assert same(d, found.charge, expected)


@pytest.mark.parametrize(
    ("lagrangian", "change", "rate", "culprit"),
    [
        ("T: m*(x'^2+y'^2)/2\nV: k*x^2/2", "x: 1", "-k*x", CHANGE_OF_L),
        ("T: m*(x'^2+y'^2)/2\ndissipation: k*x'^2/2", "x: 1", "-k*x'", "the dissipation"),
        ("T: m*(x'^2+y'^2)/2\nforces: {x: k}", "x: 1", "k", "the applied forces"),
        (
            "T: m*(x'^2+y'^2)/2\nV: m*k*y\nconstraints: {ramp: y = x}",
            "x: 1",
            "-m*k/2",
            "the constraint 'ramp'",
        ),
        ("T: m*(x'^2+y'^2)/2\ndissipation: k*x'^2/2", "t: 1", "k*x'^2", "the dissipation"),
    ],
)
def test_what_breaks_a_symmetry(lagrangian: str, change: str, rate: str, culprit: str):
    d, found = symmetry(lagrangian, change)
    assert found.conserved is False
    assert same(d, found.rate, rate)
    assert found.broken_by == culprit


def test_a_wrong_gauge_is_not_a_symmetry():
    d, found = symmetry("T: m*(x'^2+y'^2)/2", "x: t, gauge: 2*m*x")
    assert found.conserved is False
    assert same(d, found.rate, "-m*x'")


def test_a_symmetry_along_a_constraint_with_its_boundary_term():
    """The contract's example: a hoop on an incline slides by (R, 1)."""
    d = derive(
        "coordinates: [x, theta]\nparameters: [M, R, alpha, g, l]\n"
        "T: M*x'^2/2 + M*R^2*theta'^2/2\nV: M*g*(l - x)*sin(alpha)\n"
        "constraints: {rolling: x - R*theta}\nsymmetries: {slide: {x: R, theta: 1}}"
    )
    slide = charge(d, "slide")
    assert slide.conserved is True
    assert same(d, slide.gauge, "M*R*g*t*sin(alpha)")
    assert same(d, slide.charge, "M*R*x' + M*R^2*theta' - M*R*g*t*sin(alpha)")


def test_an_evident_charge_that_a_candidate_gives_is_not_listed_twice():
    d = derive(FREE + "T: m*(x'^2+y'^2)/2\nsymmetries: {push: {x: 3}, time: {t: 1}}")
    assert [c.name for c in d.noether.charges] == ["push", "time", "p_y"]


@pytest.mark.parametrize(
    "candidate",
    ["{x: 0}", "{x: x' - x'}", "{t: 0}", "{x: 0, gauge: 5}", "{y: 1, gauge: m*y'}",
     "{x: y, y: -x, gauge: m*(y*x' - x*y')}"],
)  # fmt: skip
@pytest.mark.parametrize("held", ["", "\nconstraints: {c: y = 2*x}"])
def test_a_candidate_whose_charge_is_constant_whatever_the_motion_conserves_nothing(
    candidate, held
):
    text = FREE + "T: m*(x'^2 + y'^2)/2\nsymmetries: {nothing: " + candidate + "}" + held
    found = listed(text)[0]
    assert (found.trivial, found.charge) == (True, None)


def test_a_candidate_that_the_constraints_alone_keep_constant_conserves_nothing():
    text = (
        FREE + "T: m*(x'^2 + y'^2)/2\nconstraints: {c: x^2 + y^2 = 1}\n"
        "symmetries: {out: {x: x, y: y}, round: {x: -y, y: x}}"
    )
    out, round_ = listed(text)[:2]
    assert (out.trivial, out.charge, round_.trivial) == (True, None, False)


DRAGGED = (  # x' and y' are prescribed, z is free
    "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, k: {}, w: {}, a: {}, b: {}}\n"
    "T: m*(x'^2 + y'^2 + z'^2)/2 + m*x'*y'/2\nV: POTENTIAL\n"
    "constraints: {c: x' = a*y' + b, d: y' = w}\n"
)


@pytest.mark.parametrize("V", ["k*exp(x/2) + k*y^2", "k*cos(x)", "k*cos(x*y)", "k*x^3*y"])
def test_momenta_that_the_constraints_prescribe_conserve_nothing_in_a_potential(V):
    text = DRAGGED.replace("POTENTIAL", V) + "symmetries: {push: {x: 1, y: 1}}"
    push, p_z, *_ = listed(text)
    assert (push.trivial, push.charge) == (True, None)
    assert (p_z.name, p_z.conserved) == ("p_z", True)


@pytest.mark.parametrize("V", ["k*exp(x/2) + k*y^2", "k*cos(x*y)", "k*x^3*y"])
def test_a_rate_without_a_formula_of_the_boundary_term_is_that_of_Q_minus_G(V):
    """Of Q = x p_y - y p_x: dQ/dt = m (x'^2 - y'^2)/2 + 0 as x'' = y'' = 0, dG/dt = K."""
    text = DRAGGED.replace("POTENTIAL", V) + "symmetries: {turn: {x: -y, y: x}}"
    d = derive(text)
    turn = charge(d, "turn")
    assert (turn.gauge, turn.complete, turn.conserved) == (None, False, False)
    assert same(d, turn.rate, f"diff({V}, y)*x - diff({V}, x)*y")
    told = explain(d)
    assert "boundary term G, for which no formula was found" in words(told)
    blocks = [block for step in told.steps for block in step.blocks]
    rows = [row for block in blocks if isinstance(block, Equations) for row in block.rows]
    assert any(Negative(Name("G")) in walk(row.right) for row in rows if row.note)


def test_nonholonomic_momentum_of_a_coin_is_conserved_where_it_does_no_work():
    """Turning about the vertical is free: p_phi; rolling on is not, unless it is tangent."""
    d = derive(
        "coordinates: [x, y, theta, phi]\nparameters: {m: {assume: positive}, R: {assume: positive}}\n"
        "T: m*(x'^2 + y'^2)/2 + m*R^2*theta'^2/4 + m*R^2*phi'^2/8\n"
        "constraints: {along: x' = R*theta'*cos(phi), across: y' = R*theta'*sin(phi)}\n"
        "symmetries: {roll: {theta: 1, x: R*cos(phi), y: R*sin(phi)}}"
    )
    assert charge(d, "p_phi").conserved is True
    assert charge(d, "p_x").conserved is False
    assert charge(d, "roll").conserved is True


def test_a_general_lagrangian_conserves_its_energy_function():
    d = derive("coordinates: [q]\nfunctions: {F: [q, v]}\nL: F(q, q')")
    energy = charge(d, "energy")
    assert energy.conserved is True
    assert same(d, energy.charge, "q'*diff(F, 2)(q, q') - F(q, q')")


@pytest.mark.parametrize(
    ("change", "cause"),
    [
        ("x: t, gauge: m*x", ""),
        ("x: t, gauge: -m*x", "the gauge that the file gives (without it the right one is found)"),
        ("t: x, gauge: m*x", CHANGE_OF_L),
    ],
)
def test_a_wrong_gauge_is_told_from_a_transformation_that_is_no_symmetry(change: str, cause: str):
    _, found = symmetry("T: m*(x'^2+y'^2)/2", change)
    assert found.conserved is (not cause)
    assert found.broken_by == cause
