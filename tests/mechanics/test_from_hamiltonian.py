"""A file that gives H: its Lagrangian, and what is left where there is none."""

from __future__ import annotations

import random

import pytest

from lagcli.diagnostics import ProblemError
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.legendre import LegendreTransform
from lagcli.pipeline import Request, explain, state, with_lagrangian
from lagcli.reader import read_problem

from .derived import derive, same
from .test_explanation import words

FREE = "coordinates: [x, y]\nparameters: {m: {assume: positive}, c: {assume: positive}, w: {}}\n"

POLAR = (
    "coordinates: {r: {assume: positive}, phi: {}}\nparameters: {m: {assume: positive}, k: {}}\n"
)

CASES = {
    # Goldstein 3rd ed., (8.44) and section 8.1
    "central force": (
        POLAR + "H: p_r^2/(2*m) + p_phi^2/(2*m*r^2) - k/r",
        "m*(r'^2 + r^2*phi'^2)/2 + k/r",
    ),
    # Landau, Lifshitz, Fields, 4th ed., section 9
    "relativistic": (
        FREE + "functions: {U: [x, y]}\nH: c*sqrt(p_x^2 + p_y^2 + m^2*c^2) + U(x, y)",
        "-m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2) - U(x, y)",
    ),
    # Landau, Lifshitz, Mechanics, 3rd ed., section 39: a rotating frame
    "linear in the momenta": (
        FREE + "H: (p_x^2 + p_y^2)/(2*m) + w*(y*p_x - x*p_y)",
        "m*((x' - w*y)^2 + (y' + w*x)^2)/2",
    ),
    # p = asinh(x'), and cosh(asinh(v)) = sqrt(1 + v^2)
    "hyperbolic": (FREE + "H: cosh(p_x) + p_y^2/2", "x'*asinh(x') - sqrt(1 + x'^2) + y'^2/2"),
    # x' = e^(p_x) - y', y' = e^(p_y - p_x)
    "exponentials": (
        FREE + "H: exp(p_x) + exp(p_y - p_x) + c*x^2",
        "(x' + y')*log(x' + y') + y'*log(y') - x' - 2*y' - c*x^2",
    ),
    "an exponential of both momenta": (
        FREE + "H: exp(p_x + p_y) + p_x^2/(2*m)",
        "m*(x' - y')^2/2 + y'*log(y') - y'",
    ),
    "coupled": (
        FREE + "H: (p_x^2 + p_y^2 - p_x*p_y)/m + t*x*p_x",
        "m*((x' - t*x)^2 + (x' - t*x)*y' + y'^2)/3",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_lagrangian(name: str):
    text, expected = CASES[name]
    d = derive(text)
    assert same(d, d.system.L, expected)


#: Of which the way back has no closed form that is found.
ONE_WAY = {"relativistic", "an exponential of both momenta"}


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name in CASES if name not in ONE_WAY])
def test_back_and_forth(name: str):
    """The Hamiltonian of the Lagrangian is the one of the file, and so are its equations."""
    d = derive(CASES[name][0])
    transform = LegendreTransform(d.dynamics)
    work = sum(p * v for p, v in zip(d.system.momenta, d.system.qdot, strict=True))
    assert d.system.H is not None
    assert (transform.put_into(work - d.system.L) - d.system.H).equals(0)
    lagrangian = Derivation(with_lagrangian(d.given))
    assert lagrangian.dynamics.motion is not None
    flow = dict(zip(d.system.qdot, d.hamiltonian.velocities, strict=True))
    for p, (_, growth) in zip(
        d.dynamics.lagrange.momenta, d.hamiltonian.canonical_equations, strict=True
    ):
        motion = dict(zip(d.system.qddot, d.dynamics.motion.accelerations, strict=True))
        rate = d.system.total_derivative(p).xreplace(motion).xreplace(flow)
        assert (rate - growth).equals(0)


def test_forces_and_dissipation_act():
    d = derive(
        "coordinates: [x]\nparameters: {m: {assume: positive}, b: {}, F: {}}\n"
        "H: p_x^2/(2*m)\nforces: {x: F}\ndissipation: b*x'^2/2"
    )
    [(velocity, growth)] = d.hamiltonian.canonical_equations
    assert same(d, velocity, "p_x/m")
    assert same(d, growth, "F - b*p_x/m")
    assert same(d, d.dynamics.motion.accelerations[0], "(F - b*x')/m")


def test_multipliers_of_constraints():
    d = derive(
        "coordinates: {r: {assume: positive}, theta: {}}\n"
        "parameters: {m: {assume: positive}, g: {}, l: {assume: positive}}\n"
        "H: (p_r^2 + p_theta^2/r^2)/(2*m) - m*g*r*cos(theta)\nconstraints: {rod: r = l}"
    )
    on_rod = d.dynamics.shapes.simplify(d.dynamics.motion.multipliers[0])
    assert same(d, on_rod, "-m*(l*theta'^2 + g*cos(theta))")


SINGULAR = FREE + "H: c*sqrt(p_x^2 + p_y^2)"


def test_canonical_equations_without_lagrangian():
    """A ray of light (Landau, Lifshitz, Fields, section 53): its speed is c."""
    d = derive(SINGULAR)
    assert "singular" in d.no_lagrangian
    answers = state(d, Request())
    assert list(answers.sections) == ["lagrangian", "hamiltonian", "canonical_equations"]
    assert answers.sections["lagrangian"].lagrangian is None
    assert not answers.complete
    (u, _), (v, _) = d.hamiltonian.canonical_equations
    c = next(p for p in d.hamiltonian.system.parameters if p.name == "c")
    assert (u**2 + v**2 - c**2).equals(0)


@pytest.mark.long
@pytest.mark.parametrize("text", [SINGULAR, "coordinates: [x]\nH: p_x^2/2 + p_x^7 + sin(p_x)"])
def test_no_lagrangian_is_told_at_its_place(text: str):
    problem = read_problem("test.yaml", text.encode()).checked()
    with pytest.raises(ProblemError) as raised:
        with_lagrangian(problem)
    [mistake] = raised.value.diagnostics
    assert mistake.span.line == text[: text.index("H:")].count("\n") + 1
    assert mistake.span.column == 4


@pytest.mark.parametrize("H", ["(p_x^2 + p_y^2)/2 + p_x^3/3", "p_y^2/2 - p_x^2/2 + p_x^4/4"])
def test_velocities_of_several_momenta_give_no_lagrangian(H: str):
    """p + p^2 and p^3 - p have the same values twice, and thrice."""
    d = derive("{coordinates: [x, y], H: '" + H + "'}")
    assert "takes both signs" in d.no_lagrangian


@pytest.mark.parametrize(
    ("function", "several"),
    [
        ("-a*cos(p_x)", True),
        ("a*sin(p_x - x)", True),
        ("a*atan(p_x)", True),
        ("a*p_x^2/(1 + p_x^2)", True),
        ("a*log(1 + p_x^2)", True),
        ("a*exp(-p_x^2)", True),
        ("a*cosh(p_x)", False),
        ("a*sqrt(1 + p_x^2)", False),
        ("a*(exp(p_x) - p_x)", False),
        ("a*abs(p_x)^(3/2)", False),
        ("-a*log(cosh(p_x))", False),
    ],
)
def test_a_gradient_with_the_same_value_twice_has_no_inverse(function: str, several: bool):
    """dH/dp at two momenta, and dL/dq' at two velocities, by the second derivative's sign."""
    file = "coordinates: [x]\nparameters: {a: {assume: positive}}\n"
    given = derive(f"{file}H: {function} + x^2/2\n")
    assert ("takes both signs" in given.no_lagrangian) is several
    of_velocity = function.replace("p_x", "x'")
    found = derive(f"{file}L: {of_velocity} - x^2/2\n").hamiltonian
    assert ("several branches" in found.reason) is several


def test_constraints_need_a_lagrangian():
    d = derive(SINGULAR + "\nconstraints: {line: x = y}")
    with pytest.raises(ProblemError) as raised:
        state(d, Request())
    [mistake] = raised.value.diagnostics
    assert "constraint 'line'" in mistake.message
    assert mistake.span.line == 4


@pytest.mark.parametrize("seed", range(3))
def test_an_h_without_a_lagrangian_is_explained_by_its_canonical_equations(seed):
    """Of first degree in the momenta, as of a ray: Landau and Lifshitz, *Fields*, section 53."""
    given = random.Random(seed)
    a, b, c = (given.randint(1, 9) for _ in range(3))
    still = given.choice("xy")
    other = "xy".replace(still, "")
    timed = seed == 1
    H = f"{a}*sqrt(p_x^2 + {b}*p_y^2)*(1 + {c}*{other}^2{'*cos(t)' if timed else ''})"
    account = explain(derive(f'{{coordinates: [x, y], H: "{H}"}}'), ("equilibria",))
    assert [step.title for step in account.steps] == [
        "The Hamiltonian",
        "Canonical equations",
        "Conserved quantities",
    ]
    told = " ".join(words(account, step.title) for step in account.steps)
    assert "homogeneous of first degree" in told
    assert ("So it is conserved." in told) is not timed
    assert told.count("is constant.") == 1
    assert any("from a Lagrangian" in warning for warning in account.warnings)


def test_an_h_of_another_degree_is_not_called_homogeneous():
    """H = x p + 1 is linear in p, and p q' - H is -1."""
    account = explain(derive("{coordinates: [x], H: x*p_x + 1}"))
    assert "homogeneous" not in words(account, "The Hamiltonian")
