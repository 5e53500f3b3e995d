"""Hamiltonians, energies and constraints as textbooks print them, and equal to their definition."""

from __future__ import annotations

import random

import pytest
import sympy

import lagcli
from lagcli.expression import Quotient, Sum, factors_of, opposite, walk
from lagcli.reader.expressions import parse_text

TOP = "I1*(theta'^2 + phi'^2*sin(theta)^2)/2 + I3*(psi' + phi'*cos(theta))^2/2"


SECTIONS = ("hamiltonian", "energy", "equations", "accelerations")


def solved(coordinates, lagrangian="", positive="m", others="", sections=SECTIONS, **keys):
    letters = [f"{x}: {{assume: positive}}" for x in positive.split()] + [
        f"{x}: {{}}" for x in others.split()
    ]
    lines = [f"coordinates: [{coordinates}]", f"parameters: {{{', '.join(letters)}}}"]
    lines += [f'L: "{lagrangian}"'] if lagrangian else []
    lines += [f'{key}: "{text}"' for key, text in keys.items() if key != "constraints"]
    lines += [f"constraints: {keys['constraints']}"] if "constraints" in keys else []
    return lagcli.solve(lagcli.loads("\n".join(lines) + "\n"), sections=[*sections])


def formula(found):
    return found.grammar


@pytest.mark.parametrize(
    ("given", "book"),
    [
        # Goldstein, Poole, Safko, 3rd ed., equation 8.27: (p - q A)²/2m + q phi
        (
            {
                "coordinates": "x, y, z",
                "lagrangian": "m*(x'^2+y'^2+z'^2)/2 + q*B*(x*y' - y*x')/2 + q*E*z",
                "others": "q B E",
            },
            "((p_x + q*B*y/2)^2 + (p_y - q*B*x/2)^2 + p_z^2)/(2*m) - q*E*z",
        ),
        # the restricted problem of three bodies in the turning frame, ibid. section 3.12
        (
            {
                "coordinates": "x, y",
                "lagrangian": "(x'^2+y'^2)/2 + w*(x*y' - y*x') + w^2*(x^2+y^2)/2 - U(x,y)",
                "positive": "w",
                "functions": "",
            },
            "(p_x^2 + p_y^2)/2 + w*(y*p_x - x*p_y) + U(x, y)",
        ),
        # the heavy top, ibid. equation 8.50 without its angle
        (
            {"coordinates": "theta, phi, psi", "positive": "I1 I3 M g h", "T": TOP,
             "V": "M*g*h*cos(theta)"},
            ("p_theta^2/(2*I1) + (p_phi - p_psi*cos(theta))^2/(2*I1*sin(theta)^2) + p_psi^2/(2*I3)"
            " + M*g*h*cos(theta)"),
        ),
        # a block on a movable wedge
        (
            {"coordinates": "X, x", "positive": "M m g", "others": "alpha",
             "T": "M*X'^2/2 + m*((X' + x'*cos(alpha))^2 + x'^2*sin(alpha)^2)/2",
             "V": "-m*g*x*sin(alpha)"},
            "(p_X - p_x*cos(alpha))^2/(2*(M + m*sin(alpha)^2)) + p_x^2/(2*m) - m*g*x*sin(alpha)",
        ),
        # Landau, Lifshitz, The Classical Theory of Fields, 4th ed., section 39
        (
            {"coordinates": "r, phi", "positive": "m c", "others": "k",
             "lagrangian": "-m*c^2*sqrt(1 - (r'^2 + r^2*phi'^2)/c^2) + k/r"},
            "c*sqrt(p_r^2 + p_phi^2/r^2 + m^2*c^2) - k/r",
        ),
        # a particle in a scalar potential, its rest energy: Jose and Saletan, section 5.1
        (
            {"coordinates": "x", "positive": "m c k",
             "lagrangian": "-(m*c^2 + k*x^2/2)*sqrt(1 - x'^2/c^2)"},
            "sqrt(c^2*p_x^2 + (m*c^2 + k*x^2/2)^2)",
        ),
        # Goldstein 8.1: a pendulum whose support is accelerated
        (
            {"coordinates": "theta", "positive": "m l g a",
             "T": "m*(l^2*theta'^2 + 2*a*t*l*theta'*cos(theta) + a^2*t^2)/2",
             "V": "-m*g*l*cos(theta)"},
            "(p_theta - m*a*l*t*cos(theta))^2/(2*m*l^2) - m*g*l*cos(theta) - m*a^2*t^2/2",
        ),
    ],
    ids=["field", "turning", "top", "wedge", "relativity", "scalar", "accelerated"],
)  # fmt: skip
def test_the_hamiltonian_is_that_of_the_book(given, book):
    given = dict(given)
    if "functions" in given:
        text = (
            "coordinates: [x, y]\nparameters: {w: {assume: positive}}\nfunctions: {U: [x, y]}\n"
            f'L: "{given["lagrangian"]}"\n'
        )
        found = lagcli.solve(lagcli.loads(text), sections=["hamiltonian"])
    else:
        found = solved(**given)
    assert formula(found["hamiltonian"].hamiltonian) == book


@pytest.mark.parametrize("members", [2, pytest.param(6, marks=pytest.mark.long)])
def test_random_quadratic_systems_have_their_energies_apart(members):
    """H = sum p q' - L at random states; no potential energy within a fraction of momenta."""
    draw = random.Random(11)
    for _ in range(members):
        a, b, c, d = (draw.randrange(1, 4) for _ in range(4))
        kinetic = f"m*({a}*x'^2 + {b}*(x'*cos({c}*y) + l*y')^2)/2 + m*l*{d}*w*x*y'"
        potential = draw.choice(["k*x^2/2 - m*g*l*cos(y)", "m*g*x*sin(y)", "k*(x - l)^2/2"])
        found = solved("x, y", positive="m l g k w", T=kinetic, V=potential)
        tree = parse_text(formula(found["hamiltonian"].hamiltonian))
        for part in walk(tree):
            if isinstance(part, Quotient) and isinstance(part.numerator, Sum):
                assert "g" not in {getattr(n, "name", "") for n in walk(part)} or "p_" not in str(
                    part
                )
        q, v, p = sympy.symbols("x y", real=True), sympy.symbols("u v"), sympy.symbols("p_x p_y")
        m, length, g, k, w = sympy.symbols("m l g k w", positive=True)
        names = {"x": q[0], "y": q[1], "m": m, "l": length, "g": g, "k": k, "w": w}
        read = {"sin": sympy.sin, "cos": sympy.cos}
        speeds = {"x_": v[0], "y_": v[1]}

        def value(text, extra, names=names, read=read):
            text = text.replace("'", "_").replace("^", "**")
            return sympy.parse_expr(text, local_dict={**names, **read, **extra})

        lagrangian = value(kinetic, speeds) - value(potential, {})
        momenta = [lagrangian.diff(u) for u in v]
        energy = sum(u * x for u, x in zip(v, momenta, strict=True)) - lagrangian
        printed = value(formula(found["hamiltonian"].hamiltonian), {"p_x": p[0], "p_y": p[1]})
        difference = printed.subs(dict(zip(p, momenta, strict=True)), simultaneous=True) - energy
        at = {s: sympy.Rational(draw.randrange(1, 9), 7) for s in difference.free_symbols}
        assert abs(difference.evalf(30, subs=at)) < 1e-20


def test_terms_follow_the_file():
    found = solved(
        "x, y, phi, psi", positive="I J m g", T="m*(x'^2+y'^2)/2 + I*psi'^2/2 + J*phi'^2/2"
    )
    assert formula(found["energy"].function) == "m*(x'^2 + y'^2)/2 + I*psi'^2/2 + J*phi'^2/2"


def test_a_potential_of_one_term_is_written_as_in_the_file():
    found = solved("u", positive="m g a", T="m*a^2*u'^2/2", V="m*g*(a*cos(u) + a*u*sin(u))")
    book = "p_u^2/(2*m*a^2) + m*g*(a*cos(u) + a*u*sin(u))"
    assert formula(found["hamiltonian"].hamiltonian) == book


def test_a_constraint_stands_as_in_the_file():
    found = solved(
        "theta, psi", positive="m r R g",
        T="m*(R-r)^2*theta'^2/2 + m*r^2*psi'^2/4", V="-m*g*(R-r)*cos(theta)",
        constraints='{roll: "r*psi = (R - r)*theta"}',
    )  # fmt: skip
    assert "r ψ = (R − r) θ" in str(found)


def test_denominators_are_positive_and_numbers_stay_in_the_fraction():
    """Two masses on two wedges, and the double Atwood machine (Taylor, problem 7.27 in letters)."""
    wedge = solved("theta", positive="m R g",
                   T="(m*R^2*(3/2 - 8*cos(theta)/(3*pi)))*theta'^2/2",
                   V="-4*m*g*R*cos(theta)/(3*pi)")  # fmt: skip
    assert formula(wedge["accelerations"].accelerations["theta"]) == (
        "-8*(R*theta'^2 + g)*sin(theta)/(R*(9*pi - 16*cos(theta)))"
    )
    atwood = solved("x, y", positive="m1 m2 m3 g",
                    T="m1*x'^2/2 + m2*(y' - x')^2/2 + m3*(x' + y')^2/2",
                    V="-m1*g*x - m2*g*(y - x) + m3*g*(x + y)")  # fmt: skip
    assert formula(atwood["accelerations"].accelerations["x"]) == (
        "(m1*m2 + m1*m3 - 4*m2*m3)*g/(m1*m2 + m1*m3 + 4*m2*m3)"
    )


@pytest.mark.parametrize(
    "given",
    [
        {
            "coordinates": "x, y",
            "positive": "a b k l g",
            "T": "(a + b)*k^2*x'^2/2 + b*l^2*y'^2/2 + b*k*l*x'*y'*cos(x - y)",
            "V": "-(a + b)*g*k*cos(x) - b*g*l*cos(y)",
        },
        {
            "coordinates": "x, theta",
            "positive": "M m l J g",
            "T": "M*x'^2/2 + m*(x'^2 + 2*l*x'*theta'*cos(theta) + l^2*theta'^2)/2 + J*theta'^2/2",
            "V": "m*g*l*cos(theta)",
        },
        {
            "coordinates": "x, u, v",
            "positive": "M m n k l g",
            "T": "M*x'^2/2 + m*(x'^2 + k^2*u'^2 + 2*k*x'*u'*cos(u))/2"
            " + n*(x'^2 + l^2*v'^2 + 2*l*x'*v'*cos(v))/2",
            "V": "-m*g*k*cos(u) - n*g*l*cos(v)",
        },
    ],
)
def test_the_brackets_of_the_velocities_stand_in_the_rates_of_the_momenta(given):
    """p1' = -A B sin(x - y)/(...)^2 - ... with the A of x' and the B of y', for two pendulums."""
    section = solved(**given, sections=["canonical_equations"])["canonical_equations"]
    pairs = section.equations.values()
    velocities, rates = ({*brackets(getattr(pair, side) for pair in pairs)} for side in "qp")
    assert velocities & rates
    assert not {opposite_terms(each) for each in velocities} & rates


@pytest.mark.parametrize(
    ("lagrangian", "momentum", "rate"),
    [
        # a charge in a uniform field: Goldstein, Poole, Safko, 3rd ed., section 8.1
        ("m*(x'^2 + y'^2)/2 + q*B*(x*y' - y*x')/2", "x", "q*B*(p_y - q*B*x/2)/(2*m)"),
        # a coil that is drawn in, Woodson and Melcher, chapter 2
        ("m*(x'^2 + y'^2)/2 + B*y'*x - q*x^2/2", "x", "B*(p_y - B*x)/m - q*x"),
    ],
)
def test_the_velocity_stands_in_the_rate_of_a_momentum(lagrangian, momentum, rate):
    found = solved("x, y", lagrangian, others="q B", sections=["canonical_equations"])
    assert formula(found["canonical_equations"].equations[momentum].p) == rate


def brackets(formulas):
    """The sums above fraction bars, as sets of their terms."""
    for part in (part for each in formulas for part in walk(parse_text(formula(each)))):
        for factor in factors_of(part.numerator) if isinstance(part, Quotient) else ():
            if isinstance(factor, Sum):
                yield frozenset(factor.terms)


def opposite_terms(bracket):
    return frozenset(map(opposite, bracket))
