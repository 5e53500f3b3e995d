"""Separation of the Hamilton-Jacobi equation against textbooks and numbers."""

from __future__ import annotations

import random

import mpmath
import pytest
from sympy import Float, Symbol, diff, lambdify, symbols

from lagcli.algebra import is_zero
from lagcli.algebra.build import Builder, symbol
from lagcli.expression import Call, terms_of, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.reduction.separation import Separation
from lagcli.mechanics.reduction.separation_statement import hamilton_jacobi
from lagcli.pipeline import explain
from lagcli.reader import parse_text
from tests.solved import solve

from .derived import derive
from .test_explanation import words

KEPLER = """
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, k: POSITIVE}
T: m*(r'^2 + r^2*phi'^2)/2
V: -k/r
"""


def section(text: str):
    return hamilton_jacobi(derive(text.replace("POSITIVE", "{assume: positive}")))


def test_the_derivative_of_S_by_a_constant_is_the_orbit():
    """Jacobi: dW/dp_phi = const is the ellipse r = p²/(m k)/(1 + e cos phi)."""
    found, missing = section(KEPLER)
    assert not missing
    assert found.constants == ("E", "p_phi")
    names = {n: symbol(n) for n in ("m", "k", "E", "p_phi", "r")}
    radial = Builder(names, {}, lambda e: e)(found.derivatives["r"])
    m, k, E, p = 1.3, 0.8, -0.2, 0.9
    numbers = {"m": m, "k": k, "E": E, "p_phi": p}
    slope = diff(radial, names["p_phi"]).subs({names[n]: v for n, v in numbers.items()})
    e = mpmath.sqrt(1 + 2 * E * p**2 / (m * k**2))
    orbit = [p**2 / (m * k) / (1 + e * mpmath.cos(phi)) for phi in (0.4, 1.1)]
    swept = mpmath.quad(lambdify(names["r"], slope, "mpmath"), orbit)
    assert abs(-swept - 0.7) < 1e-8


def test_a_cyclic_momentum_is_the_energy_of_a_free_particle():
    found, missing = section("{coordinates: [x], parameters: {m: POSITIVE}, T: m*x'^2/2}")
    assert not missing
    assert found.equations == {}
    assert found.constants == ("p_x",)


@pytest.mark.parametrize(
    "text",
    [
        "{coordinates: [x, y], L: (x'^2 + y'^2)/2 - (x - y)^4}",
        "{coordinates: [x, y], L: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)}",
        "{coordinates: [a, b], L: a'^2 + b'^2/2 + a'*b'*cos(a - b) + 2*cos(a) + cos(b)}",
    ],
)
def test_what_does_not_separate_has_its_obstacle(text):
    found, missing = section(text)
    assert not missing
    assert found.separable is False
    assert len(found.obstacle) == 2
    assert found.derivatives is None


@pytest.mark.parametrize(
    ("lagrangian", "special"),
    [
        ("(x'^2 + y'^2)/2 - (x^2 + y^2)^n", "1"),
        ("(x'^2 + y'^2)/2 - x^2 - n*x*y", "0"),
        ("(x'^2 + y'^2)/2 + n*(x*y' - y*x')/2 - x^2/2", "0"),
        ("(x'^2 + y'^2)/2 + (n - 3)*x'*y'/4 - x^4 - y^4", "3"),
        ("(x'^2 + y'^2)/2 - (x + y)^n", "0"),
    ],
)
def test_what_fails_only_in_general_separates_for_a_special_value(lagrangian, special):
    text = "{{coordinates: [x, y], {} L: {}}}"
    general, _ = section(text.format("parameters: [n],", lagrangian))
    assert (general.separable, general.in_general) == (False, True)
    found, _ = section(text.format("", lagrangian.replace("n", special)))
    assert found.separable is True


def test_a_double_pendulum_separates_for_no_masses_and_lengths():
    found, _ = section(
        "{coordinates: [a, b], parameters: {m: POSITIVE, M: POSITIVE, l: POSITIVE, r: POSITIVE},"
        " L: (m + M)*l^2*a'^2/2 + M*r^2*b'^2/2 + M*l*r*a'*b'*cos(a - b) + M*r*cos(b)}"
    )
    assert (found.separable, found.in_general) == (False, False)


def test_rotated_by_an_eighth_of_a_turn_the_coupled_oscillators_separate():
    found, _ = section("{coordinates: [u, v], L: (u'^2 + v'^2)/2 - u^2/2 - 3*v^2/2 - v^4}")
    assert found.separable is True
    assert found.constants == ("E", "alpha_1")


def test_a_system_of_liouville_with_unspecified_functions():
    """Whittaker, section 43: (f1 + f2)(q1'² + q2'²)/2 - (g1 + g2)/(f1 + f2)."""
    found, missing = section("""
coordinates: [x, y]
functions: {f: [x], g: [y], a: [x], b: [y]}
L: (f(x) + g(y))*(x'^2 + y'^2)/2 - (a(x) + b(y))/(f(x) + g(y))
""")
    assert not missing
    assert found.separable is True
    assert set(found.derivatives) == {"x", "y"}


def test_a_coupling_by_the_momenta_separates_beside_a_cyclic_coordinate():
    separation = Separation(derive("{coordinates: [x, y], L: x'^2/2 + y'^2/2 + y*x'*y'}"))
    assert separation.separable is True
    assert separation.separated is not None


def test_a_frequency_that_changes_with_the_time_is_not_tried():
    found, missing = section("{coordinates: [x], parameters: [w], L: x'^2/2 - x^2*cos(w*t)}")
    assert found.separable is None
    assert missing[0][1] == "H depends on the time and is not linear in the coordinates"


@pytest.mark.parametrize("force", ["m*A*t", "F*cos(w*t)", "F*t*exp(-w*t)"])
def test_a_force_of_the_time_gives_the_motion_by_the_derivative_of_S(force):
    """dS/dalpha = const is a motion with m x'' = F(t); Goldstein, 3rd ed., ch. 10, exercises."""
    found, missing = section(f"""
coordinates: [x]
parameters: {{m: POSITIVE, A: POSITIVE, F: POSITIVE, w: POSITIVE}}
L: m*x'^2/2 + ({force})*x
""")
    assert not missing
    names = {n: symbol(n) for n in ("m", "A", "F", "w", "t", "alpha_1")}
    build = Builder(names, {}, lambda e: Symbol(e.name + "'"))
    alpha, t = names["alpha_1"], names["t"]
    assert build(found.derivatives["x"]).diff(alpha) == 1
    motion = -build(found.of_time).diff(alpha)
    pushed = build(parse_text(force))
    assert is_zero(names["m"] * motion.diff(t, 2) - pushed) is True
    assert is_zero(build(found.time_rate) - build(found.of_time).diff(t)) is True
    kinetic = [build(term) for term in terms_of(found.of_time) if build(term).diff(alpha, 2) != 0]
    assert kinetic == [-(alpha**2) * t / (2 * names["m"])]  # by itself, not in a bracket over 120


def test_a_force_without_a_closed_integral_stays_one():
    found, _ = section("{coordinates: [x], functions: {F: [t]}, L: x'^2/2 + x*F(t)}")
    assert to_grammar(found.derivatives["x"]) == "alpha_1 + I_x"
    assert {n: to_grammar(e) for n, e in found.integrals.items()} == {"I_x": "F(t)"}
    assert found.of_time is None


def test_a_force_without_a_potential_has_no_action():
    _, missing = section("{coordinates: [x], parameters: [b], L: x'^2/2, dissipation: b*x'^2/2}")
    assert missing[0][1] == "a force that is not in L acts"


def test_constants_get_names_that_are_free():
    found, _ = section("""
coordinates: [x, y]
parameters: {alpha_1: POSITIVE, E: POSITIVE}
L: (x'^2 + y'^2)/2 - alpha_1*x^2 - E*y^2
""")
    assert found.constants == ("h", "beta_1")


@pytest.mark.long
def test_the_spherical_action_solves_the_equation_at_numbers():
    found, _ = section("""
coordinates: {r: POSITIVE, theta: {}, phi: {}}
parameters: {m: POSITIVE, k: POSITIVE}
T: m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2
V: k*r^2/2
""")
    names = {n: symbol(n) for n in ("m", "k", "E", "alpha_1", "p_phi", "r", "theta")}
    build = Builder(names, {}, lambda e: Symbol(e.name + "'"))
    values = dict(zip(names, (1.1, 0.7, 4.0, 1.9, 0.8, 1.3, 0.9), strict=True))
    at = {names[n]: v for n, v in values.items()}
    p = {n: build(found.derivatives[n]).subs(at) for n in ("r", "theta", "phi")}
    m, k, r, theta = (values[n] for n in ("m", "k", "r", "theta"))
    angular = p["theta"] ** 2 + p["phi"] ** 2 / mpmath.sin(theta) ** 2
    energy = (p["r"] ** 2 + angular / r**2) / (2 * m) + k * r**2 / 2
    assert abs(energy - values["E"]) < 1e-12
    assert symbols("x") not in energy.free_symbols


def test_elementary_actions_have_their_derivative_at_numbers():
    """A field along x, an oscillator, an inverted one: dW/dq by differences against W'."""
    found, _ = section("""
coordinates: [x, y, z]
parameters: {m: POSITIVE, f: POSITIVE, k: POSITIVE}
T: m*(x'^2 + y'^2 + z'^2)/2
V: f*x + k*y^2/2 - k*z^2/2
""")
    assert set(found.functions) == {"x", "y", "z"}
    values = {"m": 1.1, "f": 0.3, "k": 0.7, "E": 4.0, "alpha_1": 5.0, "alpha_2": 2.0}
    values |= {"x": 0.4, "y": 0.6, "z": 0.5}
    names = {n: symbol(n) for n in values}
    build = Builder(names, {}, lambda e: Symbol(e.name + "'"))
    for name in "xyz":
        W, slope = build(found.functions[name]), build(found.derivatives[name])

        def at(step, formula=W, name=name):
            given = {**values, name: values[name] + step}
            return complex(formula.subs({names[n]: v for n, v in given.items()}))

        difference = (at(1e-5) - at(-1e-5)) / 2e-5
        assert abs(difference - at(0, slope)) < 1e-7
        assert abs(difference) > 0.1


def numbers_of(tree, values):
    names = {n: symbol(n, "positive" if n in ("m", "k", "r", "D", "a") else "real") for n in values}
    formula = Builder(names, {}, lambda e: e)(tree)

    def value(**more):
        put_in = {names[n]: Float(str(v), 50) for n, v in (values | more).items()}
        return mpmath.mpmathify(formula.subs(put_in).evalf(40))

    return value


def grown(part, values, name, ends):
    """What W grows by between two turning points; it is real there."""
    W = numbers_of(part, values | {name: 1})
    first, last = ends
    near = mpmath.mpf("1e-24") * (last - first)
    growth = W(**{name: last - near}) - W(**{name: first + near})
    assert isinstance(growth, mpmath.mpf)
    return growth


@pytest.mark.long
@mpmath.workdps(50)
def test_the_radial_action_of_kepler_is_that_of_sommerfeld():
    """Goldstein, section 10.8: J_r = 2 pi (k sqrt(m/(-2 E)) - L)."""
    found, _ = section(KEPLER)
    bound, free = found.cases["r"]
    m, k, E, p = (mpmath.mpf(x) for x in ("1.3", "0.8", "-0.2", "0.9"))
    values = {"m": m, "k": k, "E": E, "p_phi": p}
    root = mpmath.sqrt(k**2 + 2 * E * p**2 / m)
    ends = sorted(((-k + root) / (2 * E), (-k - root) / (2 * E)))
    J = 2 * grown(bound.function, values, "r", ends)
    assert abs(J - 2 * mpmath.pi * (k * mpmath.sqrt(m / (-2 * E)) - p)) < 1e-10
    unbound = numbers_of(free.function, values | {"E": 0.3, "r": 2})
    slope = (unbound(r=3 + 1e-8) - unbound(r=3 - 1e-8)) / 2e-8
    assert abs(slope - mpmath.sqrt(2 * m * (0.3 + k / 3) - p**2 / 9)) < 1e-7


@pytest.mark.long
@mpmath.workdps(50)
def test_the_action_of_morse_gives_his_levels():
    """Morse, Phys. Rev. 34 (1929) 57: J = 2 pi sqrt(2 m) (sqrt(D) - sqrt(D - E))/a."""
    found, _ = section("""
coordinates: [x]
parameters: {m: POSITIVE, D: POSITIVE, a: POSITIVE}
T: m*x'^2/2
V: D*(1 - exp(-a*x))^2
""")
    m, D, a, E = (mpmath.mpf(x) for x in ("1.3", "2.1", "0.7", "1.2"))
    ends = [-mpmath.log(1 + s * mpmath.sqrt(E / D)) / a for s in (1, -1)]
    values = {"m": m, "D": D, "a": a, "E": E}
    J = 2 * grown(found.cases["x"][0].function, values, "x", ends)
    exact = 2 * mpmath.pi * mpmath.sqrt(2 * m) * (mpmath.sqrt(D) - mpmath.sqrt(D - E)) / a
    assert abs(J - exact) < 1e-10


@pytest.mark.long
@mpmath.workdps(50)
def test_the_relativistic_orbit_closes_after_more_than_a_turn():
    """Landau, Lifshitz, Fields, section 39: between perihelia 2 pi/sqrt(1 - k²/(c p)²)."""
    found, missing = section("""
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, k: POSITIVE, c: POSITIVE}
L: -m*c^2*sqrt(1 - (r'^2 + r^2*phi'^2)/c^2) + k/r
""")
    assert not missing
    bound = found.cases["r"][0].function
    m, k, c, p, E = (mpmath.mpf(x) for x in ("1.3", "0.8", "1.9", "0.9", "4.5"))
    values = {"m": m, "k": k, "c": c, "E": E}
    a, b, C = E**2 / c**2 - m**2 * c**2, 2 * E * k / c**2, k**2 / c**2
    step = mpmath.mpf("1e-9")

    def action(momentum):
        root = mpmath.sqrt(b**2 - 4 * a * (C - momentum**2))
        ends = sorted(((-b + root) / (2 * a), (-b - root) / (2 * a)))
        return 2 * grown(bound, values | {"p_phi": momentum}, "r", ends)

    swept = -(action(p + step) - action(p - step)) / (2 * step)
    assert abs(swept - 2 * mpmath.pi / mpmath.sqrt(1 - k**2 / (c * p) ** 2)) < 1e-5


def test_an_open_interval_of_the_angle_is_told():
    found, _ = section("""
coordinates: {theta: {}, phi: {}}
parameters: {I: POSITIVE}
T: I*(theta'^2 + sin(theta)^2*phi'^2)/2
""")
    [part] = found.cases["theta"]
    [condition] = part.where
    assert (to_grammar(condition.left), to_grammar(condition.right)) == ("sin(theta)", "0")


@pytest.mark.parametrize("seed", range(2))
def test_a_constant_that_an_integral_is_divided_by_does_not_vanish(seed):
    """The centrifugal term p²/(2 m r²) may be 0, that with a further b/r² may not."""
    random.seed(seed)
    a, b = (random.randint(1, 9) for _ in range(2))
    plain, _ = section(KEPLER.replace("-k/r", f"-{a}*k/r"))
    raised, _ = section(KEPLER.replace("-k/r", f"-{a}*k/r + {b}/r^2"))
    for found, divided in ((plain, True), (raised, False)):
        for part in found.cases["r"]:
            sides = [(to_grammar(each.left), to_grammar(each.right)) for each in part.where]
            assert (("p_phi^2", "0") in sides) is divided
            assert len(sides) == 1 + divided


def test_a_pendulum_stays_an_integral():
    found, _ = section("{coordinates: [x], parameters: {g: POSITIVE}, L: x'^2/2 + g*cos(x)}")
    assert not found.functions
    assert not found.cases


@pytest.mark.parametrize("V", ["-k/r + k*m/r^2", "-2*k*(1/r - m/(2*r^2))", "k*(r - m)^2/2"])
def test_the_equation_of_one_coordinate_is_the_equation_itself(V):
    found, _ = section(KEPLER.replace("-k/r", V))
    assert list(found.equations) == ["r"]
    shown = to_grammar(found.equations["r"])
    assert shown == to_grammar(found.hamiltonian) + " - E"


@pytest.mark.parametrize(
    ("constraints", "why"),
    [
        (["x'*sin(a) - y'*cos(a) = 0"], "there is a constraint on the velocities"),
        (["x' = a'*cos(b)", "y' = a'*sin(b)"], "there are constraints on the velocities"),
        (["x^2 + y^2 = (1 + t)^2"], "a constraint depends explicitly on the time"),
        (["x^2 + y^2 = (1 + t)^2", "a^2 + a*b^3 = t"], "constraints depend explicitly on the time"),
        (["x^2 + x*y^3 = 1"], "the constraint is not solved for a coordinate"),
        (["x^2 + x*y^3 = 1", "a^2 + a*b^3 = 1"], "the constraints are not solved for coordinates"),
    ],
)
def test_why_constraints_leave_no_equation(constraints, why):
    named = ", ".join(f'c{k}: "{each}"' for k, each in enumerate(constraints))
    derivation = derive(
        f"coordinates: [x, y, a, b]\nL: (x'^2 + y'^2 + a'^2 + b'^2)/2\nconstraints: {{{named}}}\n"
    )
    separation = Separation(derivation)
    assert separation.hamiltonian is None
    assert separation.reason == why


@pytest.mark.parametrize(
    ("L", "said"),
    [
        ("x'^2/2 - x^2*cos(w*t)", "The sum of H and the derivative of … with respect to t is 0"),
        ("x'^2/2 - x*cos(w*t)", " is linear in the coordinates"),
    ],
)
def test_the_equation_of_a_hamiltonian_of_the_time_is_stated(L, said):
    """Goldstein, Poole, Safko, 3rd ed., equation 10.3: it has the term dS/dt, whatever H is."""
    told = explain(derive(f'{{coordinates: [x], parameters: [w], L: "{L}"}}'), ["hamilton_jacobi"])
    assert said in words(told, "The Hamilton-Jacobi equation")


def test_a_logarithm_has_no_constant_factor():
    """ln(F x + E + sqrt(Q)) for ln(F (F x + E + sqrt(Q))): a constant more in W."""
    text = (
        "coordinates: {x: {}}\nparameters: {m: {assume: positive}, F: {}}\n"
        "H: sqrt(m^2 + p_x^2) - F*x\n"
    )
    found, _ = hamilton_jacobi(derive(text))
    forms = [form for each in found.cases.values() for form in each]
    inside = [
        to_grammar(part.arguments[0])
        for form in forms
        for part in walk(form.function)
        if isinstance(part, Call) and part.function == "log"
    ]
    assert inside
    assert not any(each.startswith(("abs(F*(", "F*(")) for each in inside)


@pytest.mark.long
def test_a_pendulum_of_two_rods_in_space_does_not_separate_and_says_so_in_time():
    """Marsden, Scheurle, Z. angew. Math. Phys. 44 (1993) 17: E and the vertical momentum."""
    rods = "sin({0})*cos({1}) sin({0})*sin({1}) -cos({0})"
    first = rods.format("a", "u").split()
    second = [f"{x} + {y}" for x, y in zip(first, rods.format("b", "v").split(), strict=True)]
    names = [f"{x}{n}" for n in (1, 2) for x in "xyz"]
    definitions = "".join(
        f"  {name}: {formula}\n" for name, formula in zip(names, [*first, *second], strict=True)
    )
    T = " + ".join(f"{name}'^2/2" for name in names)
    text = (
        f"coordinates: [a, u, b, v]\nparameters: [g]\ndefinitions:\n{definitions}T: {T}\n"
        "V: g*(z1 + z2)\n"
    )
    found = solve(derive(text).problem, ["algebra"]).sections["algebra"]
    assert (found.independent, found.in_involution, found.integrable) == (2, 2, None)
