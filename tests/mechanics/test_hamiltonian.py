"""The Legendre transform, also where L is not quadratic in the velocities."""

from __future__ import annotations

import pytest
import sympy as sp

from lagcli.algebra import is_zero
from lagcli.reader import parse_text, read_problem
from tests.solved import solve

from .derived import derive, same

CASES = {
    # Landau, Lifshitz, Fields, 4th ed., section 9: H = c sqrt(p^2 + m^2 c^2)
    "relativistic": (
        (
            "coordinates: [x]\nparameters: {m: {assume: positive}, c: {assume: positive}}\n"
            "L: -m*c^2*sqrt(1 - x'^2/c^2)"
        ),
        "c*sqrt(p_x^2 + m^2*c^2)",
    ),
    "relativistic in two dimensions with a potential": (
        (
            "coordinates: [x, y]\nparameters: {m: {assume: positive}, c: {assume: positive}}\n"
            "functions: {U: [x, y]}\nL: -m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2) - U(x, y)"
        ),
        "c*sqrt(p_x^2 + p_y^2 + m^2*c^2) + U(x, y)",
    ),
    # Landau, Lifshitz, Fields, 4th ed., section 16: p -> p - q A/c
    "charge in a magnetic field, Landau gauge": (
        (
            "coordinates: [x, y]\nparameters: {m: {assume: positive}, B: {}, q: {}}\n"
            "L: m*(x'^2 + y'^2)/2 + q*B*x*y'"
        ),
        "p_x^2/(2*m) + (p_y - q*B*x)^2/(2*m)",
    ),
    "a rotating frame": (
        (
            "coordinates: [x, y]\nparameters: {m: {assume: positive}, w: {}}\n"
            "T: m*((x' - w*y)^2 + (y' + w*x)^2)/2"
        ),
        "(p_x^2 + p_y^2)/(2*m) + w*(y*p_x - x*p_y)",
    ),
    "quartic in the velocity": (
        "coordinates: [x]\nparameters: {a: {assume: positive}}\nL: a*x'^4/4",
        "3*abs(p_x)^(4/3)/(4*a^(1/3))",
    ),
    "spherical coordinates": (
        (
            "coordinates: {r: {assume: positive}, theta: {}, phi: {}}\nparameters: {m: {assume: positive}}\n"
            "functions: {U: [r]}\nT: m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2\nV: U(r)"
        ),
        "(p_r^2 + p_theta^2/r^2 + p_phi^2/(r^2*sin(theta)^2))/(2*m) + U(r)",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_hamiltonian(name: str):
    text, expected = CASES[name]
    d = derive(text)
    assert d.hamiltonian.function is not None
    # the same function at 50 digits where the normal form does not decide about roots
    difference = d.hamiltonian.function - d.system.build(_parsed(expected))
    import mpmath

    from lagcli.algebra.numeric import Evaluator

    symbols = sorted(difference.free_symbols, key=str)
    with mpmath.workdps(50):
        point = {s: mpmath.mpf(7 + 3 * i) / 11 for i, s in enumerate(symbols)}
        [value] = Evaluator([difference], 50)(point)
        assert abs(value) < mpmath.mpf(10) ** -40


def _parsed(text: str):
    from lagcli.reader import parse_text

    return parse_text(text)


def test_canonical_equations_carry_multipliers_forces_and_dissipation():
    d = derive(
        "coordinates: [x, y]\nparameters: {m: {assume: positive}, b: {}, g: {}, F: {}}\n"
        "T: m*(x'^2+y'^2)/2\nV: m*g*y\ndissipation: b*x'^2/2\nforces: {x: F}\n"
        "constraints: {ramp: y = 2*x}"
    )
    assert d.hamiltonian.canonical_equations is not None
    (xq, xp), (yq, yp) = d.hamiltonian.canonical_equations
    assert same(d, xq, "p_x/m")
    assert same(d, yq, "p_y/m")
    assert same(d, xp, "F - b*p_x/m - 2*lambda_ramp")
    assert same(d, yp, "-m*g + lambda_ramp")


def test_a_singular_lagrangian_has_no_hamiltonian_and_says_why():
    d = derive("coordinates: [x, y]\nL: x*y' - y*x'")
    assert d.hamiltonian.function is None
    assert "singular" in d.hamiltonian.reason


ARM = """coordinates: [q1, q2, q3]
parameters: [m1, m2, m3, l1, l2, l3, I1, I2, I3, tau1]
definitions:
  x2: l1*cos(q1) + l2/2*cos(q1 + q2)
  y2: l1*sin(q1) + l2/2*sin(q1 + q2)
  x3: l1*cos(q1) + l2*cos(q1 + q2) + l3/2*cos(q1 + q2 + q3)
  y3: l1*sin(q1) + l2*sin(q1 + q2) + l3/2*sin(q1 + q2 + q3)
T: (m1*l1^2*q1'^2/4 + m2*(x2'^2 + y2'^2) + m3*(x3'^2 + y3'^2) + I1*q1'^2
  + I2*(q1' + q2')^2 + I3*(q1' + q2' + q3')^2)/2
forces: {q1: tau1}
"""


@pytest.mark.long
def test_canonical_equations_of_a_three_link_arm() -> None:
    """What has more terms than a shape is worth is written as it was differentiated."""
    derivation = derive(ARM)
    system = derivation.system
    pairs = derivation.hamiltonian.canonical_equations
    assert pairs is not None
    # p' = dL/dq + Q at a random state, q' from p = dL/dq'
    state = {
        s: sp.Rational(k * k + 3, 7 + k) for k, s in enumerate((*system.parameters, *system.q))
    }
    rates = {v: sp.Rational(k + 1, 3) for k, v in enumerate(system.qdot)}
    momenta = {
        p: system.L.diff(v).xreplace({**state, **rates}).evalf(30)
        for p, v in zip(system.momenta, system.qdot, strict=True)
    }
    for (velocity, growth), q, v, force in zip(
        pairs, system.q, system.qdot, system.applied_forces, strict=True
    ):
        expected = (system.L.diff(q) + force).xreplace({**state, **rates}).evalf(30)
        found = growth.xreplace({**state, **momenta}).evalf(30)
        assert abs(found - expected) < 1e-20 * (1 + abs(expected))
        assert abs(velocity.xreplace({**state, **momenta}).evalf(30) - rates[v]) < 1e-20


@pytest.mark.parametrize("power", [3, 4, 5, 6])
def test_a_lagrangian_that_folds_has_several_branches(power):
    """Henneaux, Teitelboim, Zanelli, Phys. Rev. A 36 (1987) 4417: multivalued Hamiltonians."""
    found = derive(f"""
coordinates: [x]
parameters: {{a: {{assume: positive}}, k: {{assume: positive}}}}
L: x'^{power}/{power} - a*x'^2/2 - k*x^2/2
""").hamiltonian
    assert found.function is None
    assert "several branches" in found.reason


def test_a_lagrangian_that_does_not_fold_is_only_not_solved():
    found = derive("{coordinates: [x], L: x'^8/8 + x'^4/4 + x'^2/2 + x'^3/30}").hamiltonian
    assert "several branches" not in found.reason


@pytest.mark.parametrize(
    ("lagrangian", "velocity", "hamiltonian"),
    [
        ("m*abs(a*x')^3/3 - a*x", "s*sqrt(n/(m*a^3))", "2*n^(3/2)/(3*a*sqrt(a*m)) + a*x"),
        ("m*x'^3*sign(x')/3", "s*sqrt(n/m)", "2*n^(3/2)/(3*sqrt(m))"),
        ("m*abs(x')^(3/2)", "4*s*n^2/(9*m^2)", "4*n^3/(27*m^2)"),
        ("m*abs(x' + 1)^3/3", "s*sqrt(n/m) - 1", "2*n^(3/2)/(3*sqrt(m)) - s*n"),
    ],
)
def test_an_odd_momentum_is_inverted_on_both_sides(lagrangian, velocity, hamiltonian):
    """With n = |p| and s = sign(p): p = m u |u| has u = s sqrt(n/m); not one side for both."""
    d = derive(
        "coordinates: [x]\nparameters: {m: {assume: positive}, a: {assume: positive}}\n"
        f'L: "{lagrangian}"'
    )
    [p] = d.system.momenta
    build = d.system.build.knowing({"n": sp.Abs(p), "s": sp.sign(p)})
    assert d.hamiltonian.canonical_equations is not None
    for text, found in (
        (velocity, d.hamiltonian.canonical_equations[0][0]),
        (hamiltonian, d.hamiltonian.function),
    ):
        assert is_zero(found - build(parse_text(text))) is True


@pytest.mark.parametrize("kinked", ["a*abs(x')", "a*abs(x' - 1)", "a*abs(x')*x' - a*abs(x' + 2)"])
def test_a_momentum_that_jumps_is_not_inverted(kinked):
    """Values of p between the sides belong to one velocity; no single formula is p's inverse."""
    d = derive(
        "coordinates: [x]\nparameters: {m: {assume: positive}, a: {assume: positive}}\n"
        f'L: "m*x\'^2/2 + {kinked}"'
    )
    assert d.hamiltonian.canonical_equations is None


@pytest.mark.parametrize("L", ["m/(x'^2 + x^2*y'^2)/2 + k*x^2*y'", "m/(x'^2 + y'^2 + k)"])
def test_velocities_that_are_known_by_cases_only_are_not_found(L):
    """Roots of a quartic, which SymPy has by cases."""
    file = f"coordinates: [x, y]\nparameters: {{m: {{}}, k: {{}}}}\nL: {L}\n"
    found = solve(read_problem("t.yaml", file.encode()).checked(), ["reduction"])
    assert not any("bug" in warning for warning in found.warnings)
