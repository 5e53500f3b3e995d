"""Formulas come out the way a textbook writes them."""

from __future__ import annotations

import subprocess
import sys
from fractions import Fraction
from random import Random

import pytest
import sympy as sp
from sympy import Expr, Symbol, cos, exp, sin, sqrt, tan

from lagcli.algebra import shape, simplify, to_expression
from lagcli.algebra.build import unspecified
from lagcli.algebra.writing import Writer
from lagcli.expression import Call, Power, Quotient, Sum, operation_count, walk
from lagcli.formatters.grammar import to_grammar
from lagcli.reader import parse_text

ORDER = "M m m1 m2 I1 I3 l l1 l2 R g k c alpha t x y r theta phi psi theta1 theta2".split()
I1, I3, M, m, m1, m2, l1, l2, R, g, k, c, r, x0 = (
    Symbol(n, positive=True) for n in "I1 I3 M m m1 m2 l1 l2 R g k c r x0".split()
)
alpha, t, x, y, theta, phi, u, v = (
    Symbol(n, real=True) for n in "alpha t x y theta phi theta1 theta2".split()
)
dx, dy, dtheta, dphi, du, dv = (
    Symbol(n + "'", real=True) for n in "x y theta phi theta1 theta2".split()
)

NEAR = (x - R * cos(t)) ** 2 + (y - R * sin(t)) ** 2

TEXTBOOK: list[tuple[Expr, str]] = [
    (M * g * R * t * sin(alpha), "M*R*g*t*sin(alpha)"),
    (m * l1**2 * dtheta**2 / 2, "m*l1^2*theta'^2/2"),
    (-M * g * sin(alpha) / 2, "-M*g*sin(alpha)/2"),
    (g - k * x / m, "g - k*x/m"),
    (sin(u) * cos(v) - cos(u) * sin(v), "sin(theta1 - theta2)"),
    (cos(u) * cos(v) + sin(u) * sin(v), "cos(theta1 - theta2)"),
    (1 - cos(theta) ** 2, "sin(theta)^2"),
    (m1 + m2 - m2 * cos(u - v) ** 2, "m1 + m2*sin(theta1 - theta2)^2"),
    (sin(theta) ** 2 / (1 + cos(theta)), "1 - cos(theta)"),
    ((1 + cos(theta)) / sin(theta) + sin(theta) / (1 + cos(theta)), "2/sin(theta)"),
    (-2 * dtheta * dphi * cos(theta) / sin(theta), "-2*theta'*phi'/tan(theta)"),
    ((sin(u) * cos(v) - cos(u) * sin(v)) / sin(2 * u - 2 * v), "1/(2*cos(theta1 - theta2))"),
    (-k * x / (m * sqrt(x**2 + y**2) ** 3), "-k*x/(m*(x^2 + y^2)^(3/2))"),
    (sqrt(g) / sqrt(l1), "sqrt(g/l1)"),
    (sqrt(2) * sqrt(k) / sqrt(m) / 2, "sqrt(k/(2*m))"),
    (m * c**2 / sqrt(1 - dx**2 / c**2), "m*c^2/sqrt(1 - x'^2/c^2)"),
    (1 / (sqrt(r) + 1) - (sqrt(r) - 1) / (r - 1), "0"),
    (
        sqrt(m) * (sqrt(m) * alpha * x - sqrt(35 * k) * y) * dx,
        "(m*alpha*x - sqrt(35*m*k)*y)*x'",
    ),  # Q of an oscillator in a turning frame
    (sqrt(m) * (sqrt(m) * alpha + sqrt(k)) * (x + dx), "(m*alpha + sqrt(m*k))*(x' + x)"),
    (exp(x - y) * exp(y), "exp(x)"),
    (M**x / M ** (x - 1), "M"),
    (tan(theta) * cos(theta), "sin(theta)"),
    (sin(theta / 2) * cos(theta / 2) * 2, "sin(theta)"),
    (sp.cosh(x) ** 2 - sp.sinh(x) ** 2, "1"),
    (sp.Abs(x) ** 2, "x^2"),
    (unspecified("U", 1)(r + 0) * 2, "2*U(r)"),
    (unspecified("F", 2, (1, 2))(x, t), "diff(F, 1, 2)(x, t)"),
    ((x + y) ** 3, "(x + y)^3"),
    # a bracket that stands in several terms: double Atwood machine, Thornton and Marion, ch. 7
    (g / ((m1 + M) * (m2 + m) + 4 * m2 * m), "g/((M + m1)*(m + m2) + 4*m*m2)"),
    # the distance from a point that moves along a circle, as it was given
    (
        (x - R * cos(t)) * sqrt(NEAR) / sp.expand(NEAR**2),
        "(x - R*cos(t))/((x - R*cos(t))^2 + (y - R*sin(t))^2)^(3/2)",
    ),
    (
        k * (sqrt(NEAR) - l1) * sp.expand(NEAR.diff(y)) / (2 * sqrt(NEAR)),
        "l1*k*(R*sin(t) - y)/sqrt((x - R*cos(t))^2 + (y - R*sin(t))^2) + k*(y - R*sin(t))",
    ),
    # what is in front stays in front: axle of a physical pendulum, Landau and Lifshitz, sect. 32
    (
        -m * l1 * sin(theta) * (dtheta**2 + m * g * l1 * cos(theta) / (M + m * l1**2)),
        "-m*l1*(theta'^2 + m*l1*g*cos(theta)/(M + m*l1^2))*sin(theta)",
    ),
    # N/D = Q + R/D with as many terms: bead in a groove, Goldstein, sect. 2.4
    (
        2 * k * (dx**2 - 2 * g * k * x**2) / (4 * k**2 * x**2 + 1),
        "(2*k*x'^2 + g)/(1 + 4*k^2*x^2) - g",
    ),
    # signs: each holds at x = 0 too, where sign(x)^2 is 0
    (sp.sign(x) * sp.Abs(x), "x"),
    (x * sp.sign(x), "abs(x)"),
    (sp.sign(x) ** 3 - 2 * sp.sign(-x), "3*sign(x)"),
    (sp.sign(x) ** 2, "sign(x)^2"),
    (
        (x - sp.Abs(x) * sp.sign(x) ** 3 / 4) * sp.cbrt(sp.Abs(x)) * sp.sign(x),
        "3*abs(x)^(4/3)/4",
    ),
    # the tangent of a parameter, but of no coordinate: it is infinite where nothing happens
    ((g * cos(alpha) + k * sin(alpha)) * cos(alpha), "(g + k*tan(alpha))*cos(alpha)^2"),
    ((g * cos(theta) + k * sin(theta)) * cos(theta), "(g*cos(theta) + k*sin(theta))*cos(theta)"),
    (sp.sqrt(sp.sqrt(k**2 + m * g) / (m * M)), "sqrt(sqrt(m*g + k^2)/(M*m))"),
]


@pytest.mark.parametrize(("expression", "text"), TEXTBOOK, ids=[text for _, text in TEXTBOOK])
def test_shape(expression: Expr, text: str) -> None:
    assert to_grammar(shape(expression, ORDER)) == text


def test_the_double_pendulum_is_shorter_than_in_the_books() -> None:
    """Printed in many places with sin(θ1 − 2θ2) and cos(2θ1 − 2θ2)."""
    book = (
        -g * (2 * m1 + m2) * sin(u)
        - m2 * g * sin(u - 2 * v)
        - 2 * sin(u - v) * m2 * (dv**2 * l2 + du**2 * l1 * cos(u - v))
    ) / (l1 * (2 * m1 + m2 - m2 * cos(2 * u - 2 * v)))
    assert operation_count(shape(book, ORDER)) == 30
    assert operation_count(to_expression(book, ORDER)) > 30


@pytest.mark.parametrize("number", [1, 2, 3])
def test_a_common_sine_stays_in_front_of_a_sum(number: int) -> None:
    """The other angle of the double pendulum: not 2 (…) sin δ + m2 l2 θ2'² sin(2 δ) over 2."""
    inside = (number * m1 + m2) * (l1 * du**2 + g * cos(u)) + m2 * l2 * dv**2 * cos(u - v)
    other = sp.expand_trig(inside * sin(u - v)).expand() / (l2 * (m1 + m2 * sin(u - v) ** 2))
    text = to_grammar(shape(other, ORDER))
    assert "sin(2*" not in text
    assert ")*sin(theta1 - theta2)/(l2*(m1 + " in text


def test_no_shape_is_longer_than_what_was_given() -> None:
    for expression, _ in TEXTBOOK:
        given = operation_count(to_expression(expression, ORDER))
        assert operation_count(shape(expression, ORDER)) <= given


def test_simplify_leaves_what_it_does_not_know() -> None:
    piecewise = sp.Piecewise((x, x > 0), (0, True))
    assert simplify(piecewise) == piecewise
    assert simplify(sp.zoo) == sp.zoo
    assert simplify(piecewise * sin(x) ** 2 + piecewise * cos(x) ** 2) == piecewise


def test_a_root_of_a_quotient_keeps_its_sign() -> None:
    """sqrt(1 + y²/x²) is sqrt(x² + y²)/|x|, and x may be negative."""
    slope = sp.atan(y / x)
    expression = sin(slope) + cos(slope) / (x * sp.sqrt(1 + y**2 / x**2))
    at = {x: -2, y: 3}
    assert abs(sp.N((simplify(expression) - expression).subs(at))) < 1e-12


SCRIPT = """
import sympy as sp
from lagcli.algebra import shape, simplify
names = "m1 m2 l1 l2 g theta1 theta2 x y".split()
m1, m2, l1, l2, g, u, v, x, y = (sp.Symbol(n, real=True) for n in names)
e = (m1*sp.sin(u)*g + m2*sp.sin(u-v)*(l1*sp.cos(u-v)+l2))/(m1+m2-m2*sp.cos(u-v)**2) \
    + sp.sqrt(x**2+y**2)*sp.exp(x-y)/(x*y+1) + abs(x)*sp.log(y**2+1)
print(shape(e, names), simplify(e))
"""


@pytest.mark.long
def test_the_hash_seed_does_not_matter() -> None:
    outputs = {
        subprocess.run(
            [sys.executable, "-c", SCRIPT],
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(sys.path)},
            capture_output=True, text=True, check=True,
        ).stdout
        for seed in ("0", "1", "2")
    }  # fmt: skip
    assert len(outputs) == 1


@pytest.mark.parametrize("rate", [c * t / m, -c * t / m, 2 * x, y - x])
def test_an_exponential_that_all_terms_have_stands_behind_one_bracket(rate: Expr) -> None:
    from lagcli.algebra import terms

    row = (m * dx**2 / 2 + k * x**2 / 2) * exp(rate)
    written = to_grammar(terms(sp.expand(row), ORDER, ["x'"]))
    assert written == f"(m*x'^2/2 + k*x^2/2)*{to_grammar(shape(exp(rate), ORDER))}"
    apart = to_grammar(terms(sp.expand(row + k * exp(rate / 2)), ORDER, ["x'"]))
    assert "(m*x'^2" not in apart


@pytest.mark.parametrize(
    ("charge", "written"),
    [
        (m * x * dy - m * y * dx, "m*(x*y' - y*x')"),
        (m * x * dy - m * y * dx + c * (x**2 + y**2) / 2, "m*(x*y' - y*x') + c*(x^2 + y^2)/2"),
        (
            m1 * (x * dy - y * dx) + m2 * (u * dv - v * du),
            "m1*(x*y' - y*x') + m2*(theta1*theta2' - theta2*theta1')",
        ),
        (m1 * t * dx + m2 * t * dy, "m1*t*x' + m2*t*y'"),
        (
            m * R * (dx * cos(phi) + dy * sin(phi)) + k * dphi,
            "m*R*(x'*cos(phi) + y'*sin(phi)) + k*phi'",
        ),
    ],
)
def test_what_is_linear_in_the_velocities_shares_a_bracket(charge: Expr, written: str) -> None:
    from lagcli.algebra import terms

    velocities = [s.name for s in (dx, dy, du, dv, dtheta, dphi)]
    assert to_grammar(terms(sp.expand(charge), ORDER, velocities)) == written


@pytest.mark.parametrize("function", [cos, sin, exp, sp.cosh])
@pytest.mark.parametrize(
    "square",
    [
        (g + l1 * k**2 * sin(alpha) ** 2) / l1,
        (m1 + m2) * (4 * m1 * m2 * k - (m1 + m2) * c**2),
        g - l1 * k**2 * cos(alpha) ** 2,
    ],
)
def test_a_radicand_has_one_shape_within_a_function_and_beside_it(function, square) -> None:
    found = simplify(x * sqrt(square) * function(2 * sqrt(square) * t) + function(sqrt(square) * t))
    functions = {f for f in found.atoms(function) if f.has(t)}
    within = {p for f in functions for p in f.args[0].atoms(sp.Pow) if p.exp.q == 2}
    beside = found.xreplace(dict.fromkeys(functions, sp.S.One)).atoms(sp.Pow)
    assert within == {p for p in beside if p.exp.q == 2}


@pytest.mark.parametrize(
    ("factors", "written"),
    [
        (("exp(2)", "exp(1)"), "exp(3)"),
        (("exp(2*x + y)", "x", "exp(3*x)"), "x*exp(5*x + y)"),
        (("exp(x)", "exp(-x)", "m"), "m"),
        (("k^(x + 1)", "k^(2*x)", "k"), "k^(2 + 3*x)"),
        (("k^x", "m", "k^(-x)"), "m"),
    ],
)
def test_like_terms_of_exponents_are_added(factors: tuple[str, ...], written: str) -> None:
    pairs = [(parse_text(each), Fraction(1)) for each in factors]
    assert to_grammar(Writer(ORDER).product(Fraction(1), pairs)) == written


@pytest.mark.parametrize(("a", "b"), [(1, 1), (2, 1), (3, -1), (4, -3)])
def test_a_denominator_is_written_alike_with_and_without_other_factors(a, b):
    below = a + b * cos(theta) ** 2
    alone, beside = (to_grammar(shape(sin(theta) / d)) for d in (below, m * below))
    assert alone.split("/", 1)[1].strip("()") in beside


def test_the_moments_of_a_top_stand_by_the_squares_of_sine_and_cosine():
    """I1 sin² + I3 cos² (Goldstein, 3rd ed., equation 5.53), also where it is divided by."""
    p = (I1 * sin(theta) ** 2 + I3 * cos(theta) ** 2) * dphi + I3 * x * cos(theta)
    assert to_grammar(shape(sp.diff(p, dphi))) == "I1*sin(theta)^2 + I3*cos(theta)^2"
    assert to_grammar(shape(1 / sp.diff(p, dphi))) == "1/(I1*sin(theta)^2 + I3*cos(theta)^2)"


@pytest.mark.parametrize("function", [sp.sin, sp.cos])
@pytest.mark.parametrize("root", [sp.sqrt, sp.S])
def test_an_angle_over_a_difference_has_no_sign_before_it(function, root):
    angle = root(k) * t / root(M + m - m * sp.cos(theta) ** 2)
    assert "(-" not in to_grammar(shape(function(angle)))


@pytest.mark.parametrize("below", [M - m, m - M])
def test_a_sine_of_what_is_written_with_a_minus_is_turned(below):
    angle = sp.sqrt(k * below) * t / below
    for value in (sp.sin(angle), k * sp.sin(angle) ** 3, sp.cos(angle) + k):
        written = to_grammar(shape(value))
        assert "(-" not in written
        at = {k: 3, t: 2, M: 1 + 4 * (below == M - m), m: 1 + 4 * (below != M - m)}
        read = sp.sympify(written.replace("^", "**"), {str(s): s for s in at})
        assert abs((value - read).xreplace(at).evalf()) < 1e-12


@pytest.mark.parametrize("function", [sin, sp.sinh])
@pytest.mark.parametrize("power", [-4, -2, 2, 6])
@pytest.mark.parametrize("below", [cos(alpha), cos(alpha) - sin(alpha) / 3, k - cos(alpha)])
def test_the_root_of_a_square_of_a_sine_is_its_modulus(function, power, below):
    """A bead in a cone turns with p = m r sqrt(g r cos) |sin|, not sqrt(cos/sin²) sin²."""
    expression = m * function(alpha) ** 2 * sqrt(g * below * function(alpha) ** power / r)
    written = shape(expression)
    inside = [e.arguments[0] for e in walk(written) if isinstance(e, Call) and e.function == "sqrt"]
    assert not any(isinstance(e, Power) for each in inside for e in walk(each))
    for value in (0.7, -0.4):
        at = {alpha: value, m: 2, g: 3, r: 5, k: 7}
        assert abs((expression - simplify(expression)).xreplace(at).evalf()) < 1e-12


@pytest.mark.parametrize("split", [r**2 - 1, r**2 - k**2, r**2 - 4 * k**2])
@pytest.mark.parametrize("other", [1 - x**2, x - y, 3 - cos(theta)])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_root_above_a_factor_of_its_own_has_no_fraction_inside(split, other, sign):
    """sqrt((r² - 1) (1 - x²))/(r² - 1), not sqrt((r - 1) (1 - x²)/(r + 1))/(r - 1)."""
    expression = sign * m * r * dx * sqrt(split * other) / split
    written = shape(expression)
    [inside] = [
        e.arguments[0] for e in walk(written) if isinstance(e, Call) and e.function == "sqrt"
    ]
    assert not any(isinstance(e, Quotient) for e in walk(inside))
    for below in (2.5, 3.5):
        at = {r: below, k: 1.2, x: 0.7, y: 0.2, theta: 0.4, m: 2, dx: 5}
        assert abs((expression - simplify(expression)).xreplace(at).evalf()) < 1e-12


@pytest.mark.parametrize("seed", range(6))
def test_pair_potentials_stay_apart(seed):
    """Of f (a/(x − y)² + b/(y − z)² + …) no pole is brought over the others' denominators."""
    rng = Random(seed)
    x, y, z, w = (Symbol(n, real=True) for n in "xyzw")
    pairs = [(x, y), (y, z), (z, x), (x + y, w), (w, 2 * z)][: rng.randint(2, 4)]
    above = [rng.choice([1, 1, x + y, y * z, x - z]) for _ in pairs]
    poles = sum(
        rng.randint(1, 3) * n / (p - q) ** 2 for n, (p, q) in zip(above, pairs, strict=True)
    )
    front = rng.choice([1, g, g * cos(t), g * (x + y + z) * sin(t)])
    whole = simplify(sp.together(poles * front))
    shown = to_expression(whole)
    below = [node.denominator for node in walk(shown) if isinstance(node, Quotient)]
    bases = [each.base if isinstance(each, Power) else each for each in below]
    assert len(bases) >= len(pairs)
    assert all(isinstance(base, Sum) for base in bases), shown
