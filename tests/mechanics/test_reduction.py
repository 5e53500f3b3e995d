"""Reduction by cyclic coordinates, and the period of one degree of freedom."""

from __future__ import annotations

import random
from fractions import Fraction

import mpmath
import pytest
import sympy
from mpmath import mpf
from sympy import Expr, Rational, S, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.build import Builder, symbol
from lagcli.expression import Call, Expression, Name, Number, Power, Sum, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.reduction.ratio_series import ratio_series
from lagcli.mechanics.reduction.statement import Missing, reduction
from lagcli.reader import parse_text
from lagcli.statements.answers import ReductionSection

from .derived import derive
from .formulas import formula, normal


def reduced(text: str) -> tuple[ReductionSection, Missing]:
    return reduction(derive(text.replace("POSITIVE", "{assume: positive}")))


def same(tree: Expression | None, expected: str) -> bool:
    """Equality with every name real."""
    assert tree is not None
    other = parse_text(expected)
    names = {n.name: symbol(n.name) for e in (tree, other) for n in walk(e) if isinstance(n, Name)}
    flow = {s: symbol(name + "'") for name, s in names.items()}
    build = Builder(names, {}, lambda e: flow[e])
    return is_zero(build(tree) - build(other)) is True


def test_a_linear_coupling_leaves_gyroscopic_terms():
    """Whittaker, section 38: the terms linear in the velocities do not go away."""
    section, missing = reduced("""
coordinates: [x, y, phi]
parameters: {m: POSITIVE, J: POSITIVE, k: POSITIVE}
L: m*(x'^2 + y'^2)/2 + J*(phi' + x*y' - y*x')^2/2 - k*(x^2 + y^2)/2
""")
    assert not missing
    assert same(section.reconstruction["phi"], "p_phi/J - x*y' + y*x'")
    assert same(section.effective_potential, "p_phi^2/(2*J) + k*(x^2 + y^2)/2")
    assert same(section.gyroscopic["x"], "-p_phi*y")
    assert same(section.gyroscopic["y"], "p_phi*x")
    assert section.gyroscopic_forces
    assert section.one_freedom is None


def test_a_total_derivative_is_no_force():
    section, _ = reduced("""
coordinates: [x, phi]
parameters: {J: POSITIVE, k: POSITIVE}
L: x'^2/2 + J*(phi' + x^2*x')^2/2 - k*x^2/2
""")
    assert same(section.gyroscopic["x"], "p_phi*x^2")
    assert not section.gyroscopic_forces
    assert section.one_freedom is not None
    assert normal(section.one_freedom.periods[0].period) == formula("2*pi/sqrt(k)")


def test_a_force_along_a_coordinate_that_L_does_not_have_keeps_it():
    section, _ = reduced("""
coordinates: [x, y]
parameters: [m, F]
T: m*(x'^2 + y'^2)/2
forces: {x: F}
""")
    assert list(section.momenta) == ["y"]


def test_a_drag_on_what_is_left_stays_in_the_equations_and_spoils_the_energy():
    section, missing = reduced("""
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, k: POSITIVE, b: POSITIVE}
T: m*(r'^2 + r^2*phi'^2)/2
V: k*r^2/2
dissipation: b*r'^2/2
""")
    assert not missing
    assert to_grammar(section.equations[0].right) == "-b*r'"
    assert section.one_freedom is None


def test_a_constraint_that_gives_a_coordinate_is_put_in():
    section, _ = reduced("""
coordinates: {r: POSITIVE, theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*(r'^2 + r^2*theta'^2)/2
V: -m*g*r*cos(theta)
constraints: {rod: r = l}
""")
    assert same(section.routhian, "m*l^2*theta'^2/2 + m*g*l*cos(theta)")


@pytest.mark.parametrize(("eccentricity", "put_in"), [("3/8", True), ("1/2", True), ("2", False)])
def test_a_height_that_is_assumed_positive_is_put_in_where_it_is(eccentricity, put_in):
    """A round body on a smooth floor: the height of its centre of mass, R (1 - e cos(theta))."""
    section, _ = reduced(f"""
coordinates: {{z: POSITIVE, theta: }}
parameters: {{m: POSITIVE, g: POSITIVE, R: POSITIVE}}
T: m*(z'^2 + R^2*theta'^2/4)/2
V: m*g*z
constraints: {{floor: z = R - {eccentricity}*R*cos(theta)}}
""")
    assert (section.eliminated == ("z",)) is put_in
    assert (section.one_freedom is not None) is put_in


@pytest.mark.parametrize("order", ["phi, psi", "psi, phi"])
@pytest.mark.parametrize("sign", ["", "-"])
def test_a_rolling_constraint_is_put_in_by_its_velocities(order, sign):
    """A disc in a cylinder, as with φ = n ψ: Landau and Lifshitz, section 32, problem 5."""
    text = f"""
coordinates: [{order}]
parameters: {{m: POSITIVE, g: POSITIVE, d: POSITIVE, r: POSITIVE}}
T: m*d^2*phi'^2/2 + m*r^2*psi'^2/4
V: -m*g*d*cos(phi)
constraints: {{rolling: "d*phi' = {sign}r*psi'"}}
"""
    section, missing = reduced(text)
    assert not missing
    assert section.eliminated == ("psi",)
    assert same(section.routhian, "3*m*d^2*phi'^2/4 + m*g*d*cos(phi)")
    assert section.one_freedom is not None
    [period] = section.one_freedom.periods
    assert same(period.period, "2*pi*sqrt(3*d/(2*g))*(1 + a^2/16 + 11*a^4/3072)")
    turned, _ = reduced(text.replace("V:", "forces: {psi: m*g*r*psi'}\nV:"))
    assert turned.eliminated == ("psi",)
    assert turned.one_freedom is None


@pytest.mark.parametrize("power", ["n", "n + 1", "2*n", "3"])
def test_a_power_law_has_oscillations_about_every_circle(power):
    """r0^(n + 2) = p^2/(m k) and T = 2 pi m r0^2/(|p| sqrt(n + 2)): Landau, Lifshitz, section 14."""
    section, _ = reduced(f"""
coordinates: {{r: POSITIVE, phi: {{}}}}
parameters: {{m: POSITIVE, k: POSITIVE, n: POSITIVE}}
T: m*(r'^2 + r^2*phi'^2)/2
V: k*r^({power})/({power})
""")
    assert section.one_freedom is not None
    [period] = section.one_freedom.periods
    [where] = period.where
    assert same(where.left, "p_phi^2")
    assert same(where.right, "0")


@pytest.mark.parametrize("inertia", ["1", "2/5", "1/2"])
def test_a_rolling_constraint_is_put_in_beside_a_contact(inertia):
    """A body rolls off a cylinder: Goldstein, Poole, Safko, chapter 2, problem 14."""
    section, missing = reduced(f"""
coordinates: [theta, psi, r]
parameters: {{m: POSITIVE, g: POSITIVE, R: POSITIVE, a: POSITIVE}}
T: m*(r'^2 + r^2*theta'^2)/2 + {inertia}*m*a^2*psi'^2/2
V: m*g*r*cos(theta)
constraints:
  touch: {{equation: r = R + a, multiplier: N, holds_while: N >= 0}}
  roll: {{equation: "a*psi' = (R + a)*theta'", multiplier: F}}
""")
    assert not missing
    assert section.eliminated == ("psi", "r")
    assert same(
        section.routhian, f"m*(1 + {inertia})*(R + a)^2*theta'^2/2 - m*g*(R + a)*cos(theta)"
    )
    assert section.one_freedom is not None


def test_a_constraint_that_does_not_touch_the_cyclic_coordinate_stays():
    section, _ = reduced("""
coordinates: [x, y, z]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE}
T: m*(x'^2 + y'^2 + z'^2)/2
V: m*g*y
constraints: {rod: x^2 + y^2 = l^2}
""")
    assert list(section.momenta) == ["z"]
    assert same(section.constraints["rod"][0], "x^2 + y^2 - l^2")
    assert section.one_freedom is None


def test_what_is_cyclic_altogether_leaves_nothing():
    section, missing = reduced("{coordinates: [x, y], parameters: [m], T: m*(x'^2 + y'^2)/2}")
    assert section.routhian is None
    assert missing == [("the reduction", "every coordinate is cyclic")]


def test_a_momentum_that_does_not_give_the_velocity():
    section, missing = reduced("{coordinates: [x, y], parameters: [m], L: m*x'^2/2 + x*y'}")
    assert section.routhian is None
    assert missing


@pytest.mark.long
def test_a_relativistic_reduction():
    """Landau and Lifshitz, *The Classical Theory of Fields*, section 39: p_phi = gamma m r² phi'."""
    section, _ = reduced("""
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, c: POSITIVE, k: POSITIVE}
L: -m*c^2*sqrt(1 - (r'^2 + r^2*phi'^2)/c^2) + k/r
""")
    assert same(section.effective_potential, "c*sqrt(p_phi^2 + m^2*c^2*r^2)/r - k/r")
    r, v, p, m, c = (mpf(x) for x in ("1.3", "0.2", "0.4", "0.9", "1.7"))
    names = {n: symbol(n) for n in ("r", "p_phi", "m", "c")}
    build = Builder(names, {}, lambda e: Symbol(e.name + "'", real=True))
    values = {"r": r, "r'": v, "p_phi": p, "m": m, "c": c}
    found = build(section.reconstruction["phi"])
    rate = mpf(str(found.evalf(30, subs={s: values[s.name] for s in found.free_symbols})))
    gamma = 1 / mpmath.sqrt(1 - (v**2 + r**2 * rate**2) / c**2)
    assert abs(gamma * m * r**2 * rate - p) < 1e-12


@pytest.mark.parametrize(("V", "force"), [("x^2/2", lambda x: x), ("x^4/4", lambda x: x**3)])
@pytest.mark.parametrize("a", [0.5, 2.0])
def test_the_time_of_a_relativistic_oscillation(V, force, a):
    """m = c = 1, x'' = -F (1 - x'²)^(3/2): a quarter of the period by Runge and Kutta."""
    section, missing = reduced(f"coordinates: [x]\nL: -sqrt(1 - x'^2) - {V}")
    assert not missing
    one = section.one_freedom
    assert one is not None
    x, E = symbol("x"), symbol(one.constant)
    build = Builder({"x": x, one.constant: E}, {}, lambda e: Symbol(e.name + "'"))
    energy = 1 + float(build(parse_text(V)).subs(x, a))
    turning = [sympy.N(build(each).subs(E, energy)) for each in one.turning_points or ()]
    assert any(abs(each - a) < 1e-9 for each in turning)
    rate = sympy.lambdify(x, build(one.rate).subs(E, energy), "mpmath")

    def turned(s: mpf) -> mpf:
        return rate(a * mpmath.sin(s)) * a * mpmath.cos(s)

    quarter = mpmath.quad(turned, [0, mpmath.pi / 2], method="gauss-legendre")

    def slopes(y: float, v: float) -> tuple[float, float]:
        return v, -force(y) * (1 - v * v) ** 1.5

    y, v, t, h = a, 0.0, 0.0, 1e-3
    while y > 0:
        before = y, v
        k1 = slopes(y, v)
        k2 = slopes(y + h / 2 * k1[0], v + h / 2 * k1[1])
        k3 = slopes(y + h / 2 * k2[0], v + h / 2 * k2[1])
        k4 = slopes(y + h * k3[0], v + h * k3[1])
        y, v = (
            u + h / 6 * (p + 2 * q + 2 * r + s)
            for u, p, q, r, s in zip((y, v), k1, k2, k3, k4, strict=True)
        )
        t += h
    t -= h * y / (y - before[0])
    assert abs(quarter - t) < 1e-5


def test_the_time_where_the_rest_energy_changes():
    """E = (m c² + k x²/2) gamma, solved for x'."""
    section, _ = reduced("""
coordinates: [x]
parameters: {m: POSITIVE, c: POSITIVE, k: POSITIVE}
L: -(m*c^2 + k*x^2/2)*sqrt(1 - x'^2/c^2)
""")
    one = section.one_freedom
    names = {n: symbol(n) for n in ("x", "m", "c", "k", one.constant)}
    rate = Builder(names, {}, lambda e: Symbol(e.name + "'"))(one.rate)
    m, c, k, x, v = (sympy.Rational(n, 17) for n in (15, 29, 22, 7, 11))
    energy = (m * c**2 + k * x**2 / 2) / sympy.sqrt(1 - v**2 / c**2)
    values = {"m": m, "c": c, "k": k, "x": x, one.constant: energy}
    assert abs(rate.evalf(30, subs={names[n]: values[n] for n in names}) - 1 / v) < 1e-25
    roots = [p for p in walk(one.rate) if isinstance(p, Call) and p.function == "sqrt"]
    assert all(isinstance(each.arguments[0], Sum) for each in roots)  # no product of two factors


def test_the_period_of_a_relativistic_oscillation():
    """Goldstein, *Classical Mechanics*, 3rd ed., (7.158) for the term with a²."""
    section, missing = reduced("""
coordinates: [x]
parameters: {m: POSITIVE, k: POSITIVE, c: POSITIVE}
L: -m*c^2*sqrt(1 - x'^2/c^2) - k*x^2/2
""")
    assert not missing
    assert section.one_freedom is not None
    [found] = section.one_freedom.periods
    expected = "2*pi*sqrt(m/k)*(1 + 3*k*a^2/(16*m*c^2) - 15*k^2*a^4/(1024*m^2*c^4))"
    assert same(found.period, expected)


@pytest.mark.long
def test_a_relativistic_period_is_the_integral():
    """m = c = 1, V = x²/2 + x³/3: dt = (E - V)/sqrt((E - V)² - 1) dx at 30 digits."""
    section, _ = reduced("coordinates: [x]\nL: -sqrt(1 - x'^2) - x^2/2 - x^3/3")
    assert section.one_freedom is not None
    [found] = section.one_freedom.periods
    amplitude = symbol("a")
    period = Builder({"a": amplitude}, {}, lambda e: Symbol(e.name))(found.period)
    with mpmath.workdps(60):
        low, errors = mpf(-1) / 1000, []
        for b in (low, low / 2):
            turn = mpmath.polyroots(
                [mpf(1) / 3, mpf(1) / 2, 0, -(b**2) / 2 - b**3 / 3], maxsteps=200, extraprec=200
            )
            high = min((mpmath.re(z) for z in turn if mpmath.re(z) > 0), key=abs)
            a, middle, E = (high - b) / 2, (high + b) / 2, 1 + b**2 / 2 + b**3 / 3
            total = mpf(0)
            for k in range(24):
                s = (k + mpf(1) / 2) * mpmath.pi / 24 - mpmath.pi / 2
                x = middle + a * mpmath.sin(s)
                e = E - x**2 / 2 - x**3 / 3
                total += e / mpmath.sqrt(e**2 - 1) * a * mpmath.cos(s)
            T = 2 * total * mpmath.pi / 24
            errors.append(abs(mpf(str(sympy.N(period.subs(amplitude, a), 50))) / T - 1))
    assert errors[0] < 1e-15
    assert 50 < errors[0] / errors[1] < 80  # a^6


@pytest.mark.long
@pytest.mark.parametrize(
    ("rest", "expected"),
    [
        # T = 2 pi k/(1 - E²)^(3/2) from the action (Born, *The Mechanics of the Atom*,
        # section 33), with a² (1 - E²)² = k² E² - (1 - E²) (p² - k²)
        ("k/r", "2*pi*abs(p_phi)^3/k^2*(1 + 3*k^2*a^2/(2*p_phi^4))"),
        # a circle of radius a about a point that is not the origin, T = 2 pi E/k
        ("k*r^2*phi'/2", "2*pi/k*(1 + k^2*a^2/2 - k^4*a^4/8)"),
    ],
)
def test_the_period_of_a_relativistic_orbit(rest, expected):
    """m = c = 1: (dr/dt)² is a quotient in which E - U_eff is a factor behind a root."""
    section, missing = reduced(f"""
coordinates: {{r: POSITIVE, phi: {{}}}}
parameters: {{k: POSITIVE}}
L: -sqrt(1 - r'^2 - r^2*phi'^2) + {rest}
""")
    assert not missing
    assert section.one_freedom is not None
    assert section.one_freedom.periods
    assert all(same(found.period, expected) for found in section.one_freedom.periods)


def test_the_kinetic_energy_is_one_fraction():
    """Two masses tied over a movable wedge: what the momentum of the wedge leaves of T."""
    section, _ = reduced("""
coordinates: [X, s]
parameters: {M: POSITIVE, m1: POSITIVE, m2: POSITIVE, g: POSITIVE, a: {}, b: {}}
T: M*X'^2/2 + m1*(X'^2 + s'^2 - 2*X'*s'*cos(a))/2 + m2*(X'^2 + s'^2 - 2*X'*s'*cos(b))/2
V: m1*g*s*sin(a) - m2*g*s*sin(b)
""")
    assert section.routhian is not None
    assert to_grammar(section.routhian).startswith(
        "((M + m1 + m2)*(m1 + m2) - (m1*cos(a) + m2*cos(b))^2)*s'^2/(2*(M + m1 + m2))"
    )


def test_names_that_are_taken_get_others():
    section, _ = reduced("""
coordinates: [x]
parameters: {E: POSITIVE, a: POSITIVE}
T: x'^2/2
V: a*(x^2/2 + E*x^4)
""")
    motion = section.one_freedom
    assert motion is not None
    assert motion.constant == "h"
    assert [p.amplitude for p in motion.periods] == ["A"]


@pytest.mark.long
def test_what_the_assumptions_rule_out_is_not_listed():
    """A charge about a field line: one radius for either sign of q B p, no negative ones.

    U = (p^2/r^2 - b p + b^2 r^2/4)/(2 m) has its minimum at r^2 = 2 |p/b|, with U'' = b^2/m.
    """
    section, missing = reduced("""
coordinates: {r: POSITIVE, phi: {}}
parameters: {m: POSITIVE, b: {assume: nonzero}}
L: m*(r'^2 + r^2*phi'^2)/2 + b*r^2*phi'/2
""")
    assert not missing
    motion = section.one_freedom
    assert motion is not None
    [period] = motion.periods
    assert [to_grammar(w.left) for w in period.where] == ["p_phi^2"]
    assert to_grammar(period.at["r"]) == "sqrt(2*abs(p_phi/b))"
    assert to_grammar(period.period) == "2*pi*m/abs(b)"
    assert len(motion.turning_points or ()) == 2
    assert all(not to_grammar(x).startswith("-") for x in motion.turning_points or ())


def test_a_hill_has_no_period():
    section, missing = reduced("{coordinates: [r], parameters: {w: {}}, L: r'^2/2 + w^2*r^2/2}")
    assert not missing
    assert section.one_freedom is not None
    assert section.one_freedom.periods == ()


def test_a_free_motion_turns_nowhere():
    section, missing = reduced(
        "{coordinates: [x, y], parameters: [m], L: m*x'^2*(1 + y^2)/2 + y'^2}"
    )
    assert not missing
    motion = section.one_freedom
    assert motion is not None
    assert motion.periods
    section, _ = reduced(
        "{coordinates: [x], parameters: {m: POSITIVE, F: {}}, L: m*x'^2/2 + F*t*x}"
    )
    assert section.one_freedom is None


def series(U: Expr, M: Expr) -> list[Expr]:
    x = Symbol("x")
    second = U.diff(x, 2).subs(x, 0)
    alpha = [2 * U.diff(x, k + 2).subs(x, 0) / sympy.factorial(k + 2) / second for k in range(5)]
    beta = [M.diff(x, k).subs(x, 0) / sympy.factorial(k) / M.subs(x, 0) for k in range(5)]
    return ratio_series(alpha, [beta])


@pytest.mark.long
@pytest.mark.parametrize(
    ("U", "M"),
    [
        ("1 - cos(x)", "1"),
        ("x**2/2 + x**3/5 + x**4/7 - x**5/3 + x**6/11", "1 + x/2 - x**2/3 + x**3/5 + x**4/9"),
        ("(exp(-x) - 1)**2/2", "1"),
        ("x**2/2", "1/(1 + x)"),
    ],
)
def test_the_series_is_the_integral_at_30_digits(U: str, M: str):
    """Quadrature of 2 dq sqrt(M/(2 (E - U))) at two amplitudes: the error falls as a^6."""
    x = Symbol("x")
    potential, mass = sympy.sympify(U, locals={"x": x}), sympy.sympify(M, locals={"x": x})
    c2, c4 = (mpf(c.p) / c.q for c in map(Rational, series(potential, mass)[1::2]))
    u, w = sympy.lambdify(x, potential, "mpmath"), sympy.lambdify(x, mass, "mpmath")
    errors = []
    with mpmath.workdps(60):
        T0 = 2 * mpmath.pi
        for a in (mpf(1) / 50, mpf(1) / 100):
            left = mpmath.findroot(lambda m, a=a: u(m + a) - u(m - a), (-a * a, a * a))
            E = u(left + a)

            def integrand(s, left=left, a=a, E=E):
                q = left + a * mpmath.sin(s)
                return mpmath.sqrt(w(q) / (2 * (E - u(q)))) * a * mpmath.cos(s)

            T = 2 * mpmath.quad(integrand, mpmath.linspace(-mpmath.pi / 2, mpmath.pi / 2, 5))
            errors.append(abs(T / T0 - 1 - c2 * a**2 - c4 * a**4))
    assert errors[0] < 1e-8
    if errors[0] > 1e-25:
        assert 55 < errors[0] / errors[1] < 75


def test_the_harmonic_period_does_not_depend_on_the_amplitude():
    assert series(Symbol("x") ** 2 / 2, S.One) == [0, 0, 0, 0]


def test_the_morse_potential():
    """Landau and Lifshitz, section 11 (method): T = 2 pi/sqrt(1 - 2 E) for m = alpha = 1, D = 1/2.

    With tanh(a) = sqrt(2 E) for half the distance a of the turning points, T = 2 pi cosh(a).
    """
    x = Symbol("x")
    assert series((sympy.exp(-x) - 1) ** 2 / 2, S.One) == [0, Rational(1, 2), 0, Rational(1, 24)]


@pytest.mark.parametrize(("k", "strength"), [("k", 0.7), ("k^2", 0.49), ("2*k", 1.4)])
def test_a_minimum_for_either_sign_of_a_momentum_is_one(k, strength):
    """r² = |p|/√(m k) of the plane oscillator, not √p for p > 0 and √(-p) for p < 0."""
    motion = reduced(
        "{coordinates: {r: POSITIVE, u: {}}, parameters: {m: POSITIVE, k: POSITIVE}, "
        f"T: m*(r'^2 + r^2*u'^2)/2, V: '{k}*r^2/2'}}"
    )[0].one_freedom
    assert motion is not None
    [period] = motion.periods
    values = {"m": 1.3, "k": 0.7, "p_u": -0.9}
    names = {name: sympy.Float(value) for name, value in values.items()}
    place = Builder(names, {}, lambda _: S.Zero)(period.at["r"])
    assert float(place) ** 4 == pytest.approx(0.81 / (1.3 * strength))
    [condition] = period.where
    assert {part.name for part in walk(condition.left) if isinstance(part, Name)} == {"p_u"}


def test_a_period_has_one_number():
    """A cycloid: 4 pi sqrt(a/g), and not 2 pi times 2."""
    section, _ = reduced("""
coordinates: [phi]
parameters: {a: {assume: positive}, g: {assume: positive}}
L: a^2*(1 - cos(phi))*phi'^2 - g*a*cos(phi)
""")
    assert section.one_freedom is not None
    assert [to_grammar(each.period) for each in section.one_freedom.periods] == ["4*pi*sqrt(a/g)"]


@pytest.mark.parametrize("inertia", ["m", "m*(1 + a^2*x^2)", "m*(M + m*sin(x)^2)/(M + m)"])
@pytest.mark.parametrize("V", ["k*x^2/2 + b*x", "b*x - k*cos(x)", "b*x - k/(1 + x^2)"])
def test_the_time_integral_has_the_potential_as_it_is_printed(inertia: str, V: str):
    """sqrt(M/(2 (E - U))), term by term and without a modulus (Landau, Lifshitz, section 11)."""
    section, _ = reduced(
        "{coordinates: [x], parameters: {m: POSITIVE, M: POSITIVE, a: {}, b: {}, k: {}}, "
        f"T: {inertia}*x'^2/2, V: {V}}}"
    )
    assert section.one_freedom is not None
    rate = section.one_freedom.rate
    assert "abs" not in to_grammar(rate)
    assert "b*x" in to_grammar(rate)
    assert same(Power(rate, Number(Fraction(2))), f"({inertia})/(2*(E - ({V})))")


@pytest.mark.parametrize(("V", "to_and_fro"), [("-k*x^2", False), ("b*x", False), ("k*x^4", True),
                                              ("k*abs(x)", True), ("k*x^4 - k*x^2", True),
                                              ("b*x - k*sin(a)^2*x^2", False),
                                              ("b*x + k*sin(a)^2*x^2", True)])  # fmt: skip
def test_a_period_is_stated_where_the_motion_may_come_back_twice(V: str, to_and_fro: bool):
    parameters = "{k: POSITIVE, b: POSITIVE, a: }"
    text = f"{{coordinates: [x], parameters: {parameters}, T: x'^2/2, V: {V}}}"
    one = reduced(text)[0].one_freedom
    assert one is not None
    assert one.oscillates is to_and_fro


@pytest.mark.parametrize("drive", ["a*t^2/2", "l*cos(a*t)"])
def test_one_coordinate_has_no_gyroscopic_force(drive: str):
    """-dg/dt of a support that is driven is a force, but none across the velocity."""
    section, _ = reduced(
        f"{{coordinates: [phi], parameters: {{l: POSITIVE, a: POSITIVE}}, "
        f"definitions: {{X: l*sin(phi) + {drive}, Y: l*cos(phi)}}, T: (X'^2 + Y'^2)/2}}"
    )
    assert section.gyroscopic_change
    assert not section.gyroscopic_forces


@pytest.mark.parametrize("b", ["1/2", "2"])
def test_the_time_of_a_relativistic_charge_in_polar_coordinates(b):
    """m = c = 1 in a magnetic field: (dr/dt)² = 1 - ((p_φ - b r²)²/r² + 1)/E²."""
    section, missing = reduced(f"""
coordinates: {{r: POSITIVE, phi: {{}}}}
L: -sqrt(1 - r'^2 - r^2*phi'^2) + {b}*r^2*phi'
""")
    assert not missing
    one = section.one_freedom
    names = {"r": symbol("r"), "p_phi": symbol("p_phi"), one.constant: symbol(one.constant)}
    rate = Builder(names, {}, lambda e: Symbol(e.name + "'"))(one.rate)
    for r, p, E in ((0.8, 0.7, 1.9), (1.1, -0.4, 3.7)):
        found = rate.subs(dict(zip(names.values(), (r, p, E), strict=True)))
        away = (p - float(sympy.Rational(b)) * r**2) / r
        assert float(found) ** -2 == pytest.approx(1 - (away**2 + 1) / E**2)


@pytest.mark.parametrize(
    ("inertia", "V", "alike"),
    [
        ("cosh(x)^2", "k*sinh(x)^2/2", True),  # s = sinh x
        ("(1 + cos(x))", "-k*cos(x)", True),  # a cycloid
        ("exp(2*x)", "k*(exp(x) - 3)^2", True),
        ("1", "-k*cos(x)", False),
        ("(1 + x^2)", "k*x^2/2", False),
    ],
)
def test_a_motion_that_is_harmonic_in_the_arc_is_isochronous(inertia, V, alike):
    section, _ = reduced(f"""
coordinates: [x]
parameters: {{m: POSITIVE, k: POSITIVE}}
T: m*{inertia}*x'^2/2
V: {V}
""")
    assert section.one_freedom.periods
    assert all(each.isochronous == alike for each in section.one_freedom.periods)


@pytest.mark.parametrize(
    ("inertia", "V", "alike"),
    [
        ("1", "k*(x^2 + B/x^2)", True),
        ("cosh(x)^2", "k*(sinh(x)^2 + B/sinh(x)^2)", True),
        ("x^2", "k*(x^4 + B/x^4)", True),  # s = x^2/2
        ("1", "k*(x^4 + B/x^4)", False),
        ("1", "k*(x^2 + B/x^4)", False),
    ],
)
def test_where_the_square_of_the_arc_is_harmonic_the_period_is_the_same(inertia, V, alike):
    """Of A s^2 + B/s^2, as for the distance of an isotropic oscillator: (s^2)'' + 8 A s^2 = 4 E."""
    section, _ = reduced(f"""
coordinates: [x]
parameters: {{m: POSITIVE, k: POSITIVE, B: POSITIVE}}
T: m*{inertia}*x'^2/2
V: {V}
""")
    assert section.one_freedom.periods
    assert all(each.squared == each.isochronous == alike for each in section.one_freedom.periods)


#: V, T, energies, and where the well is for m = 1.3, k = 1, b = 0.8.
BY_ENERGY = (
    # Landau, Lifshitz, Mechanics, 3rd ed., section 11, problem 2 (b), (c); section 15 for the last
    ("-k/cosh(b*x)^2", "pi*sqrt(2*m)/(b*sqrt(-E))", (-0.2, -0.7), (-9, 0, 9)),
    ("k*tan(b*x)^2", "pi*sqrt(2*m)/(b*sqrt(E + k))", (0.3, 4), (-1.9, 0, 1.9)),
    ("k*(1 - exp(-b*x))^2", "pi*sqrt(2*m)/(b*sqrt(k - E))", (0.2, 0.8), (-3, 0, 20)),
    ("k/sin(b*x)^2", "pi*sqrt(2*m)/(b*sqrt(E))", (2, 5), (0.01, 1.9, 3.9)),
    ("b/x^2 - k/x", "pi*k*sqrt(m/2)/(-E)^(3/2)", (-0.1, -0.2), (0.2, 1.6, 90)),
)


@pytest.mark.parametrize(("V", "expected", "energies", "well"), BY_ENERGY)
def test_the_period_by_the_energy_is_the_integral(V, expected, energies, well):
    section, _ = reduced(f"""
coordinates: {{x: {"POSITIVE" if well[0] > 0 else "{}"}}}
parameters: {{m: POSITIVE, k: POSITIVE, b: POSITIVE}}
T: m*x'^2/2
V: {V}
""")
    [period] = section.one_freedom.periods
    known = {"m": 1.3, "k": 1, "b": 0.8}

    def of(text, **more):
        read = sympy.sympify(text.replace("^", "**"), locals={"E": Symbol("E")})
        return float(read.subs({**known, **more}))

    for E in energies:
        given = of(to_grammar(period.by_energy), E=E)
        assert given == pytest.approx(of(expected, E=E), rel=1e-12)
        rise = sympy.lambdify("x", sympy.sympify(V.replace("^", "**")).subs(known) - E, "mpmath")
        low, high = (
            mpmath.findroot(rise, (well[1], end), solver="anderson") for end in (well[0], well[2])
        )
        half = (high - low) / 2

        def pace(s, low=low, half=half, rise=rise):
            below = abs(rise(low + half * (1 + mpmath.sin(s))))
            return half * mpmath.cos(s) * mpmath.sqrt(2 * 1.3 / below)

        angles = [mpmath.pi * (k + 0.5) / 200 - mpmath.pi / 2 for k in range(200)]
        integral = sum(map(pace, angles)) * mpmath.pi / 200
        assert given == pytest.approx(float(integral), rel=1e-6)


@pytest.mark.parametrize("V", ["-k*cos(x)", "k*(x^2 + x^4)", "k*cosh(x)"])
def test_no_function_of_the_energy_where_the_action_is_not_elementary(V):
    section, _ = reduced(
        f"coordinates: [x]\nparameters: {{m: POSITIVE, k: POSITIVE}}\nT: m*x'^2/2\nV: {V}\n"
    )
    assert all(each.by_energy is None for each in section.one_freedom.periods)


@pytest.mark.parametrize(
    ("V", "turning", "energies"),
    [
        ("U*sin(x/a)^2", ["a*asin(sqrt(E/U))"], [("0", "U")]),
        ("U*tan(x/a)^2", ["a*atan(sqrt(E/U))"], []),
        ("-U*cos(pi*x/a)^2", ["a*acos(sqrt(-E/U))/pi"], [("-U", "0")]),
        ("U/cos(x/a)^2", ["a*acos(sqrt(U/E))"], []),
    ],
)
def test_a_length_has_the_turning_points_of_one_period(V, turning, energies):
    """Pöschl and Teller's well and a crystal: by the function that makes them shortest."""
    section, _ = reduced(f"""
coordinates: [x]
parameters: {{m: POSITIVE, U: POSITIVE, a: POSITIVE}}
T: m*x'^2/2
V: {V}
""")
    found = [to_grammar(each) for each in section.one_freedom.turning_points]
    assert sorted(found) == sorted([*turning, *(f"-{each}" for each in turning)])
    ends = [tuple(map(to_grammar, pair)) for pair in section.one_freedom.turning_energies]
    assert ends == energies
    assert to_grammar(section.one_freedom.turning_period) == ("a" if "cos(pi" in V else "pi*a")
    assert len(section.one_freedom.periods) == 1


@pytest.mark.parametrize(
    ("V", "turning"),
    [
        ("k*abs(x)", "E/k"),
        ("k*abs(x)^3", "(E/k)^(1/3)"),
        ("k*abs(x)^5", "(E/k)^(1/5)"),
        ("k*x^2 + k*abs(x)", None),
    ],
)
def test_a_potential_of_the_distance_turns_on_both_sides(V, turning):
    """Landau and Lifshitz, section 11, problem 2: V = A |x|^n."""
    section, missing = reduced(f"""
coordinates: [x]
parameters: {{m: POSITIVE, k: POSITIVE}}
T: m*x'^2/2
V: {V}
""")
    assert not missing
    found = [to_grammar(each) for each in section.one_freedom.turning_points or ()]
    if turning is not None:
        assert sorted(found) == sorted([turning, f"-{turning}"])
    else:
        assert len(found) in (0, 2)


@pytest.mark.parametrize("seed", range(4))
def test_turning_points_that_move_to_infinity_are_given_for_other_energies_only(seed):
    """Of V = V_0 - a/r + b/r^2, one of the two roots is at infinity for E = V_0 alone."""
    rng = random.Random(seed)
    a, b, at = (rng.randint(1, 9) for _ in range(3))
    section, _ = reduced(f"""
coordinates: {{r: POSITIVE}}
parameters: {{m: POSITIVE}}
T: m*r'^2/2
V: {at} - {a}/r + {b}/r^2
""")
    motion = section.one_freedom
    [finite] = motion.turning_finite
    side = Builder({"E": (E := symbol("E"))}, {}, lambda e: e)
    assert sympy.solve(side(finite.left) - side(finite.right), E) == [at]
    above, _ = reduced("""
coordinates: [x]
parameters: {m: POSITIVE, k: POSITIVE, p: {}}
T: m*x'^2/2
V: k*x^2/2 + p^2/2
""")
    assert above.one_freedom.turning_finite == ()


@pytest.mark.parametrize("seed", range(3))
def test_the_only_turning_point_of_a_distance_has_its_energies(seed):
    """Of V = V_0 - k/r the fall from rest begins at k/(V_0 - E): E < V_0; of V_0 + F r, E > V_0."""
    rng = random.Random(seed)
    k, at = rng.randint(1, 9), rng.randint(1, 9)
    for potential, bound in ((f"{at} - {k}/r", True), (f"{at} + {k}*r", False)):
        section, _ = reduced(f"""
coordinates: {{r: POSITIVE}}
parameters: {{m: POSITIVE}}
T: m*r'^2/2
V: {potential}
""")
        [holds] = section.one_freedom.turning_finite
        side = Builder({"E": (E := symbol("E"))}, {}, lambda e: e)
        margin = side(holds.left) - side(holds.right)
        assert margin.subs(E, at) == 0
        assert bool(margin.subs(E, at - 1) > 0) is bound


BOWL = """
coordinates: {r: POSITIVE, phi: {}, z: {}}
parameters: {m: POSITIVE, g: POSITIVE, b: POSITIVE, c: POSITIVE, F: POSITIVE}
T: m*(r'^2 + r^2*phi'^2 + z'^2)/2
V: %s
constraints: {bowl: {equation: %s, holds_while: lambda_bowl >= 0}}
"""


@pytest.mark.parametrize("seed", range(4))
def test_a_period_has_no_condition_that_holds_where_the_slope_vanishes(seed):
    """In a bowl N = m g at every circle, however steep it is; with a lift N = m g - F."""
    draw = random.Random(seed)
    low = draw.randint(2, 4)
    shape = f"z = b*r^{low} + c*r^{low + draw.randint(1, 3)}"
    for V in ("m*g*z", f"m*g*z - F*r^{draw.randint(1, 4)}", "(m*g - F)*z"):
        section, _ = reduced(BOWL % (V, shape))
        [period] = section.one_freedom.periods
        assert period.root_of is not None
        assert not period.where


def test_a_period_keeps_the_condition_that_a_contact_presses():
    """Inside a sphere, drawn to its centre: N = p²/(m R³ sin²) + m g cos - k R may vanish."""
    section, _ = reduced("""
coordinates: {r: POSITIVE, theta: {}, phi: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, k: POSITIVE}
T: m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2
V: -m*g*r*cos(theta) + k*r^2/2
constraints: {sphere: {equation: r = R, multiplier: N, holds_while: N <= 0}}
""")
    [period] = section.one_freedom.periods
    [[left, right]] = [(each.left, each.right) for each in period.where]
    names = {name: symbol(name) for name in ("m", "g", "R", "k", "theta", "p_phi")}
    excess = Builder(names, {}, lambda e: e)(left) - Builder(names, {}, lambda e: e)(right)
    for theta, p in (0.5, 1.0), (1.0, 0.3), (0.4, 0.1), (1.4, 0.9):
        values = dict(zip(names.values(), (1, 1, 1, 1, theta, p), strict=True))
        N = p**2 / sympy.sin(theta) ** 2 + sympy.cos(theta) - 1
        assert (excess.subs(values) > 0) == (N > 0)
