"""Formulas of systems that are in no library, as the books print them."""

from __future__ import annotations

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.pipeline import Request, derive, explain, read, state
from lagcli.statements.answers import (
    CanonicalSection,
    EnergySection,
    EquationsSection,
    HamiltonianSection,
    ReductionSection,
)
from lagcli.statements.motions import SteadySection

# (coordinates, parameters, physics, {path: formula}, source)
BOOK = [
    (
        "[q1, q2]", "L1 L2 M C1 C2",
        "T: L1*q1'^2/2 + L2*q2'^2/2 + M*q1'*q2'\nV: q1^2/(2*C1) + q2^2/(2*C2)",
        {
            "accelerations.q1": "(M*C1*q2 - L2*C2*q1)/((L1*L2 - M^2)*C1*C2)",
            "hamiltonian": "(L2*p_q1^2 - 2*M*p_q1*p_q2 + L1*p_q2^2)/(2*(L1*L2 - M^2)) "
            "+ q1^2/(2*C1) + q2^2/(2*C2)",
        },
    ),
    (
        "[phi1, phi2]", "m1 m2 l1 l2 g",  # Landau and Lifshitz, Mechanics, section 5, problem 1
        "T: (m1 + m2)*l1^2*phi1'^2/2 + m2*l2^2*phi2'^2/2 + m2*l1*l2*phi1'*phi2'*cos(phi1 - phi2)",
        {
            "hamiltonian": "(m2*l2^2*p_phi1^2 - 2*m2*l1*l2*p_phi1*p_phi2*cos(phi1 - phi2) "
            "+ (m1 + m2)*l1^2*p_phi2^2)/(2*m2*l1^2*l2^2*(m1 + m2*sin(phi1 - phi2)^2))",
        },
    ),
    (
        "[x, y]", "m1 m2 m3 g",  # Marion and Thornton, example 7.8
        "T: m1*x'^2/2 + m2*(y' - x')^2/2 + m3*(x' + y')^2/2\nV: -m1*g*x + m2*g*(x - y) + m3*g*(x + y)",
        {
            "accelerations.x": "(m1*m2 + m1*m3 - 4*m2*m3)*g/(m1*m2 + m1*m3 + 4*m2*m3)",
        },
    ),
    (
        "{r: {assume: positive}, theta: }", "m k",
        "T: m*(r'^2 + r^2*theta'^2)/2\nV: -k/r",
        {"hamiltonian": "(p_r^2 + p_theta^2/r^2)/(2*m) - k/r"},  # Goldstein, section 8.1
    ),
    (
        "{r: {assume: positive}, theta: }", "m p",
        "T: m*(r'^2 + r^2*theta'^2)/2\nV: p*cos(theta)/r^2",
        {"accelerations.theta": "p*sin(theta)/(m*r^4) - 2*r'*theta'/r"},
    ),
    (
        "{r: {assume: positive}, s: }", "M",  # Misner, Thorne, Wheeler, Gravitation, section 25.3
        "L: -(1 - 2*M/r)*s'^2/2 + r'^2/(2*(1 - 2*M/r))",
        {
            "accelerations.r": "M*r'^2/(r*(r - 2*M)) - M*(1 - 2*M/r)*s'^2/r^2",
            "momenta.s": "-(1 - 2*M/r)*s'",
        },
    ),
    (
        "[y, theta]", "M m l k g",
        "T: (M + m)*y'^2/2 + m*l^2*theta'^2/2 - m*l*y'*theta'*sin(theta)\nV: k*y^2/2 - m*g*l*cos(theta)",
        {
            "accelerations.y": "(m*l*theta'^2*cos(theta) - k*y - m*g*sin(theta)^2)"
            "/(M + m*cos(theta)^2)",
        },
    ),
    (
        "[X, x1, x2]", "M m1 m2 F",  # two cylinders on a plank, Lagrange's reduction to squares
        "T: M*X'^2/2 + m1*x1'^2/2 + m1*(x1' - X')^2/4 + m2*x2'^2/2 + m2*(x2' - X')^2/4\nV: -F*X",
        {
            "hamiltonian": "(3*p_X + p_x1 + p_x2)^2/(6*(3*M + m1 + m2)) "
            "+ p_x1^2/(3*m1) + p_x2^2/(3*m2) - F*X",
        },
    ),
    (
        "[x, a, b]", "M m l g",  # two pendulums on one support that slides
        """T: M*x'^2/2 + m*(x'^2 + 2*l*x'*a'*cos(a) + l^2*a'^2)/2 + m*(x'^2 + 2*l*x'*b'*cos(b) + l^2*b'^2)/2
V: -m*g*l*cos(a) - m*g*l*cos(b)""",
        {
            "hamiltonian": "(l*p_x - p_a*cos(a) - p_b*cos(b))^2"
            "/(2*l^2*(M + m*(sin(a)^2 + sin(b)^2))) + p_a^2/(2*m*l^2) + p_b^2/(2*m*l^2) "
            "- m*g*l*cos(a) - m*g*l*cos(b)",
        },
    ),
    (
        "[theta]", "m l R g",  # a rod in a bowl: its moment of inertia about the centre as a sum
        "T: m*(R^2 - l^2/4 + l^2/12)*theta'^2/2\nV: -m*g*sqrt(R^2 - l^2/4)*cos(theta)",
        {"accelerations.theta": "-3*g*sqrt(4*R^2 - l^2)*sin(theta)/(6*R^2 - l^2)"},
    ),
    (
        "[a, b]", "m l g",  # two rods: the heights have a term in common
        """T: m*l^2*(4*a'^2 + 3*a'*b'*cos(a - b) + b'^2)/6
definitions: {y1: -l*cos(a)/2, y2: -l*cos(a) - l*cos(b)/2}
V: m*g*y1 + m*g*y2""",
        {
            "energy": "m*l^2*(4*a'^2 + 3*a'*b'*cos(a - b) + b'^2)/6 - 3*m*g*l*cos(a)/2 "
            "- m*g*l*cos(b)/2",
        },
    ),
    (
        "[phi]", "m a I g",  # Goldstein, section 5.1: I + M R²
        "T: (m*a^2 + I)*phi'^2/2 + m*a^2*phi'^2*cos(phi)^2/2\nV: m*g*phi",
        {"momenta.phi": "(I + m*a^2*(1 + cos(phi)^2))*phi'"},
    ),
    (
        "{r: {assume: positive}, phi: , theta: }", "m1 m2 g l",  # a swinging mass below a table
        """T: m1*(r'^2 + r^2*phi'^2)/2 + m2*(r'^2 + (l - r)^2*theta'^2)/2
V: -m2*g*(l - r)*cos(theta)""",
        {
            "accelerations.r": "(m1*r*phi'^2 - m2*(l - r)*theta'^2 - m2*g*cos(theta))/(m1 + m2)",
        },
    ),
    (
        "[u, v]", "J",
        "T: J*(u'^2 + v'^2)/2\nV: 0",
        {"energy": "J*(u'^2 + v'^2)/2"},
    ),
    (
        "[theta, phi, psi]", "A C",  # Goldstein, 3rd ed., equation 5.53
        "T: A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2",
        {"momenta.phi": "(A*sin(theta)^2 + C*cos(theta)^2)*phi' + C*psi'*cos(theta)"},
    ),
    (
        "[y, z]", "m M k K l b g",  # two springs below one another, as free-body diagrams give it
        "T: m*y'^2/2 + M*z'^2/2\nV: k*(y - l)^2/2 + K*(z - y - b)^2/2 - m*g*y - M*g*z",
        {
            "equations.y": "m*y'' - m*g + k*(y - l) - K*(z - y - b)",
            "canonical_equations.y": "m*g - k*(y - l) + K*(z - y - b)",
        },
    ),
    (
        "[theta, phi]", "m l g k",  # French, Vibrations and Waves, chapter 5, with a torsion spring
        "T: m*l^2*(theta'^2 + phi'^2)/2\nV: k*(theta - phi)^2/2 - m*g*l*(cos(theta) + cos(phi))",
        {"accelerations.theta": "-k*(theta - phi)/(m*l^2) - g*sin(theta)/l"},
    ),
    (
        "[theta, phi]", "m l g",  # two rods: p' = dL/dtheta, with the velocities in p
        (
            "T: m*l^2*(4*theta'^2 + phi'^2 + 3*theta'*phi'*cos(theta - phi))/6\n"
            "V: -m*g*l*(3*cos(theta) + cos(phi))/2"
        ),
        {
            "momenta.phi": "m*l^2*(3*theta'*cos(theta - phi) + 2*phi')/6",
            # the brackets of theta' and phi', as the books have these
            "canonical_equations.phi": "18*(2*p_theta - 3*p_phi*cos(theta - phi))"
            "*(8*p_phi - 3*p_theta*cos(theta - phi))*sin(theta - phi)"
            "/(m*l^2*(7 + 9*sin(theta - phi)^2)^2) - m*g*l*sin(phi)/2",
        },
    ),
    (
        "{r: {assume: positive}, phi: }", "m e B U a b",  # Landau and Lifshitz, Mechanics, sect. 15
        "L: m*(r'^2 + r^2*phi'^2)/2 + e*B*r^2*phi'/2 - e*U*log(r/a)/log(b/a)",
        {"U_eff": "(p_phi - e*B*r^2/2)^2/(2*m*r^2) + e*U*log(r/a)/log(b/a)"},
    ),
    (
        "[y, theta]", "M m l g",  # Landau and Lifshitz, Mechanics, section 5, problem 3, from below
        (
            "T: M*y'^2/2 + m*((y' - l*theta'*sin(theta))^2 + (l*theta'*cos(theta))^2)/2\n"
            "V: -M*g*y - m*g*(y + l*cos(theta))"
        ),
        {
            "equations.theta": "m*l^2*theta'' - m*l*y''*sin(theta) + m*g*l*sin(theta)",
            "steady_motions.1": "sin(theta)",
        },
    ),
    (
        "{r: {assume: positive}, phi: }", "m e B U R0",  # as in Goldstein, exercise 8.23
        "L: m*(r'^2 + r^2*phi'^2)/2 - e*B*r^2*phi'/2 + e*U*log(r/R0)",
        {"hamiltonian": "p_r^2/(2*m) + (p_phi + e*B*r^2/2)^2/(2*m*r^2) - e*U*log(r/R0)"},
    ),
    (
        "[r, a]", "M l m k b g",  # V as the file has it, also where it begins with a minus
        (
            "T: M*l^2*a'^2/6 + m*(r'^2 + r^2*a'^2)/2\n"
            "V: -M*g*l*cos(a)/2 - m*g*r*cos(a) + k*(r - b)^2/2"
        ),
        {
            "hamiltonian": "p_r^2/(2*m) + 3*p_a^2/(2*(3*m*r^2 + M*l^2)) - M*g*l*cos(a)/2 "
            "- m*g*r*cos(a) + k*(r - b)^2/2",
        },
    ),
    (
        "[a]", "m R l g",  # a rod in a bowl: 3 R² − 2 l² is its moment of inertia
        (
            "definitions: {d: sqrt(R^2 - l^2)}\nT: m*d^2*a'^2/2 + m*l^2*a'^2/6\nV: -m*g*d*cos(a)"
        ),
        {"accelerations.a": "-3*g*sqrt(R^2 - l^2)*sin(a)/(3*R^2 - 2*l^2)"},
    ),
    (
        "[x]", "m k c",  # Goldstein, section 7.9; kinetic energy first
        "L: -m*c^2*sqrt(1 - x'^2/c^2) - k*x^2/2",
        {"hamiltonian": "c*sqrt(p_x^2 + m^2*c^2) + k*x^2/2"},
    ),
    (
        "[x, y]", "M m k K r0 w",  # Goldstein, exercise 2.21
        (
            "T: M*(x'^2 + w^2*x^2)/2 + m*((x' - w*y)^2 + (y' + w*x)^2)/2\n"
            "V: K*(x - r0)^2/2 + k*y^2/2"
        ),
        {
            "hamiltonian": "(p_y - m*w*x)^2/(2*m) + (p_x + m*w*y)^2/(2*(M + m)) + K*(x - r0)^2/2 "
            "+ k*y^2/2 - M*w^2*x^2/2 - m*w^2*(x^2 + y^2)/2",
        },
    ),
    (
        "[a, b]", "m l g",
        "definitions: {x: -l*cos(a), y: -l*cos(b)}\nT: m*l^2*(a'^2 + b'^2)/2\nV: m*g*(x + y)",
        {"energy": "m*l^2*(a'^2 + b'^2)/2 - m*g*l*(cos(a) + cos(b))"},
    ),
    (
        "[a, b]", "m l g",  # the heights of two bobs as the file has them
        "T: m*l^2*(a'^2 + b'^2)/2\nV: m*g*(-l*cos(a) - l*cos(b))",
        {"energy": "m*l^2*(a'^2 + b'^2)/2 - m*g*(l*cos(a) + l*cos(b))"},
    ),
]  # fmt: skip


PLACES = {"U_eff": "reduction"}


def problem_of(coordinates, parameters, physics):
    """The problem of a row, its parameters positive."""
    positive = ", ".join(f"{name}: {{assume: positive}}" for name in parameters.split())
    text = f"title: t\ncoordinates: {coordinates}\nparameters: {{{positive}}}\n{physics}\n"
    return read("t.yaml", text.encode()).problem


def named(row):
    """The row as a case; the period of a magnetron's motion takes 5 s."""
    slow = [pytest.mark.long] if "log(b/a)" in row[2] else []
    return pytest.param(row, id=row[2].split("\n")[0][:40], marks=slow)


@pytest.mark.parametrize("row", [*map(named, BOOK)])
def test_the_book_s_form_is_printed(row):
    *file, wanted = row
    sections = dict.fromkeys(PLACES.get(path, path.split(".")[0]) for path in wanted)
    found = state(derive(problem_of(*file)), Request(sections=tuple(sections))).sections
    printed = {}
    for path in wanted:
        section, _, name = path.partition(".")
        match found[PLACES.get(section, section)]:
            case EquationsSection(equations=rows):
                printed[path] = next(row.left for row in rows if row.coordinate == name)
            case CanonicalSection(equations=pairs):
                printed[path] = pairs[name].p
            case SteadySection(conditions=rows):
                printed[path] = rows[name]
            case EnergySection(function=formula) | HamiltonianSection(hamiltonian=formula):
                printed[path] = formula
            case ReductionSection(effective_potential=formula):
                printed[path] = formula
            case rows:
                printed[path] = getattr(rows, section)[name]
    assert {name: to_grammar(printed[name]) for name in wanted} == wanted


@pytest.mark.long
def test_abbreviations_reach_an_explanation_and_the_reduction():
    file = (
        "[x, a, b]", "M m1 m2 l1 l2 g",
        (
            "T: M*x'^2/2 + m1*(x'^2 + 2*l1*x'*a'*cos(a) + l1^2*a'^2)/2 + m2*(x'^2 + l1^2*a'^2 "
            "+ l2^2*b'^2 + 2*x'*(l1*a'*cos(a) + l2*b'*cos(b)) + 2*l1*l2*a'*b'*cos(a - b))/2\n"
            "V: -(m1 + m2)*g*l1*cos(a) - m2*g*l2*cos(b)"
        ),
    )  # fmt: skip
    derivation = derive(problem_of(*file))
    answers = state(derivation, Request(sections=("reduction",), abbreviate=True))
    assert answers.where
    told = repr(explain(derivation, ("reduction",)).steps)
    assert told.count("With the abbreviation") == 2  # in the accelerations and the reduction


@pytest.mark.parametrize(
    ("text", "section", "bounds"),
    [
        # Goldstein 3.19 (b): circular orbits in a Yukawa potential are stable for r < 1.618 a
        (
            """
coordinates: {r: POSITIVE, phi: }
parameters: {m: POSITIVE, k: POSITIVE, a: POSITIVE}
T: m*(r'^2 + r^2*phi'^2)/2
V: -k*exp(-r/a)/r
""",
            "steady_motions",
            ["(1 + sqrt(5))*a > 2*r"],
        ),
        # Bolotin, Nonconservative Problems of the Theory of Elastic Stability: 2.086 c/l
        (
            """
coordinates: [u, v]
parameters: {m: POSITIVE, P: POSITIVE, l: POSITIVE, c: POSITIVE}
T: m*l^2*(3*u'^2 + v'^2 + 2*u'*v'*cos(u - v))/2
V: c*u^2/2 + c*(v - u)^2/2
forces: {u: P*l*sin(u - v)}
""",
            "equilibria",
            ["(7 - 2*sqrt(2))*c > 2*P*l"],
        ),
    ],
)
def test_conditions_in_one_ratio_are_bounds_on_it(text, section, bounds):
    text = text.replace("POSITIVE", "{assume: positive}")
    problem = read("t.yaml", text.encode()).problem
    answer = state(derive(problem), Request(sections=(section,))).sections[section]
    [verdict] = [each.verdict for each in getattr(answer, section.removeprefix("steady_"))]
    found = verdict.spectrum or verdict.minimum
    assert [f"{to_grammar(each.left)} > {to_grammar(each.right)}" for each in found] == bounds
    assert [(each.right, each.left) for each in found] == [
        (each.left, each.right) for each in verdict.unstable
    ]


@pytest.mark.parametrize("V", ["0", "k*x^2/2", "-F*x"])
def test_a_relativistic_lagrangian_is_written_as_in_goldstein(V: str):
    """L = -m c² sqrt(1 - v²/c²) - V (3rd ed., equation 7.136), and so is what reduces nothing."""
    given = "-m*c^2*sqrt(1 - x'^2/c^2)"
    text = (
        "{coordinates: [x], parameters: {m: {assume: positive}, c: {assume: positive}, k: {}, "
        f'F: {{}}}}, L: "{given} - ({V})"}}'
    )
    problem = read("t.yaml", text.encode()).problem
    found = state(derive(problem), Request(sections=("lagrangian", "reduction"))).sections
    L, R = found["lagrangian"].lagrangian, found["reduction"].routhian
    assert given.lstrip("-") in to_grammar(L)
    assert R is None or to_grammar(R) == to_grammar(L)


def test_a_coordinate_that_no_constraint_touches_rests_under_its_own_force():
    """A torque F on a blade: 0 = F, not 0 = sin θ and 0 = cos θ, which never hold together."""
    text = """
coordinates: [x, y, theta]
parameters: {m: POSITIVE, J: POSITIVE, F: POSITIVE}
T: m*(x'^2 + y'^2)/2 + J*theta'^2/2
forces: {theta: F}
constraints: {blade: "x'*sin(theta) - y'*cos(theta) = 0"}
""".replace("POSITIVE", "{assume: positive}")
    problem = read("blade.yaml", text.encode()).problem
    section = state(derive(problem), Request(sections=("steady_motions",))).sections[
        "steady_motions"
    ]
    assert [to_grammar(each) for each in section.conditions.values()] == ["F"]


def test_a_denominator_is_positive_where_the_condition_of_the_answer_holds():
    """Two beads on a ring that turns freely: their period, where g I² > R p²."""
    T = "I*phi'^2/2 + m*R^2*(theta'^2 + phi'^2*sin(theta)^2)"
    file = ("[phi, theta]", "m R g I", f"T: {T}\nV: 2*m*g*R*cos(theta)")
    found = state(derive(problem_of(*file)), Request(sections=("reduction",))).sections["reduction"]
    assert isinstance(found, ReductionSection)
    assert found.one_freedom is not None
    [series] = found.one_freedom.periods
    [where] = series.where
    difference = f"{to_grammar(where.left)} - {to_grammar(where.right)}"
    assert f"/(16*I*({difference}))" in to_grammar(series.period)
