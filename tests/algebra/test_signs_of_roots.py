"""Roots of quantities of either sign: what is simplified has the same values where it is real."""

import math
from itertools import product
from random import Random

import pytest
import sympy

from lagcli.algebra import simplify
from lagcli.algebra.decimals import written
from lagcli.algebra.positivity import deciding, sign_of, weak_sign
from lagcli.algebra.signs import sign
from lagcli.expression import Call, walk
from lagcli.formatters.grammar import to_grammar

k, m, g, w = sympy.symbols("k m g w", real=True)
p = sympy.Symbol("p", positive=True)
root = sympy.sqrt
FORMULAS = [
    root(k * m) / m,
    root(k * m) / k,
    m / root(k * m),
    root(k / m),
    m * root(k / m),
    m * root(k / m) - root(k * m),
    root(k / m) * root(k * m),
    root(k / m) / root(k * m),
    root(p * k * m) / m,
    root(k * m / p) * m,
    root(k * m * g * w) / (m * g),
    root(k * m**3) / m,
    root(k * (k + m)) / k,
    root(k * (k**2 + m**2)) / k,
    root(m * (k**2 + m**2) / k) * k,
    sympy.cos(root(k * m) * w / m) - sympy.cos(root(k / m) * w),
    sympy.sin(root(k * m) * w / m) - sympy.sin(root(k / m) * w),
]


@pytest.mark.parametrize("formula", FORMULAS, ids=str)
def test_the_sign_stays(formula):
    shaped = simplify(formula)
    compared = 0
    for signs in product((1, -1), repeat=4):
        values = {x: s * v for x, s, v in zip((k, m, g, w), signs, (2, 3, 5, 7), strict=True)}
        values[p] = sympy.Integer(11)
        before = formula.subs(values)
        if before.is_real:
            assert abs(sympy.N(before - shaped.subs(values))) < 1e-12, (values, shaped)
            compared += 1
    assert compared


@pytest.mark.parametrize("seed", range(6))
def test_a_product_of_what_is_positive_is_positive(seed):
    """Of e_1, e_2, e_3 > 0, any product over squares that divide it, and no factor is 0."""
    rng = Random(seed)
    x, y, z = sympy.symbols("x y z", real=True)
    factors = rng.sample([x, y, x - y, x + 2 * z, x * y - z**2, z - 1], 4)
    positive = [sympy.Mul(*rng.sample(factors, 2)) for _ in range(3)]
    chosen = sympy.Mul(*rng.sample(positive, rng.randint(1, 3)))
    shared = [f for f, power in sympy.factor_list(chosen)[1] if power == 2]
    side = rng.choice([1, -1])
    assert sign(sympy.expand(side * chosen / sympy.Mul(*shared) ** 2), positive) == side
    for factor in {f for each in positive for f, _ in sympy.factor_list(each)[1]}:
        assert sign(sympy.expand(factor**2), positive) == 1


@pytest.mark.parametrize("seed", range(8))
def test_what_is_divided_by_a_root_has_one_sign(seed):
    # a root is positive where it is divided by, whatever the sign of its radicand elsewhere
    source = Random(seed)
    a, b = sympy.symbols("a b", positive=True)
    radicands = [a - source.randint(2, 9) * b, a**2 - source.randint(2, 9) * b**2, b - a * p]
    chosen = source.sample(radicands, source.randint(1, 3))
    below = [root(r) ** source.choice((1, 3, 5)) for r in chosen]
    expected = source.choice((1, -1))
    assert sign(expected * p * (a - b) ** 2 / sympy.Mul(*below, (a - b) ** 2)) == expected
    assert sign((a - b) / sympy.Mul(*below)) is None


@pytest.mark.parametrize("seed", range(6))
def test_powers_of_one_modulus_are_one_power(seed):
    source = Random(seed)
    u = source.choice((k, k - m, sympy.cos(k)))
    odd, even = source.choice((1, -1)), source.choice((-4, -2, 2, 4))
    tree = written(simplify(g * abs(u) ** odd * u**even), ["k", "m", "g"])
    shown = [node for node in walk(tree) if isinstance(node, Call) and node.function == "abs"]
    assert len(shown) == 1
    (inner,) = shown[0].arguments
    assert sum(node == inner for node in walk(tree)) == 1  # no power of it apart from the modulus
    back = sympy.sympify(to_grammar(tree).replace("^", "**"), {"k": k, "m": m, "g": g})
    assert sympy.simplify((back - g * abs(u) ** odd * u**even).subs({k: 3, m: 5})) == 0


@pytest.mark.parametrize("seed", range(8))
def test_between_two_roots_of_a_square_root_the_sign_is_known(seed):
    # (b - √c) (√c - a) multiplied out, where c > a² and b > √c are given in other shapes
    source = Random(seed)
    a, b, c, d = sympy.symbols("a b c d", positive=True)
    root_c = root(c) if source.random() < 0.5 else root(c / d)
    whole = sympy.expand((b - root_c) * (root_c - a) * source.choice((1, d, c)))
    given = [sympy.expand(root_c**2 - a**2) * source.choice((1, d)), b * root_c - root_c**2]
    assert sign_of(whole, given) == 1
    assert sign_of(-whole, given) == -1
    assert sign_of(whole, given[:1]) is None


@pytest.mark.parametrize("seed", range(8))
def test_a_root_with_a_factor_of_either_sign_is_outweighed_or_not(seed):
    """Of a x² + b p ± c x √(x² + d p) at 401 places; squared, all terms have one sign or not."""
    rng = Random(seed)
    a, b, c, d = (sympy.Rational(rng.randint(1, 6), rng.randint(1, 2)) for _ in range(4))
    formula = a * k**2 + b * p + rng.choice((1, -1)) * c * k * root(k**2 + d * p)
    values = sympy.lambdify(k, formula.subs(p, 1), "math")
    least = min(values(x * (1 + abs(x) / 20) / 20) for x in range(-200, 201))
    known = sign(formula)
    assert known in (None, 1)
    assert known is None or least > 0
    assert known == 1 or a**2 < c**2 or 2 * a * b < c**2 * d


@pytest.mark.parametrize("seed", range(4))
def test_a_root_of_a_sum_of_squares_is_not_negative(seed):
    """a + b and a root of (a - b)² + c x², expanded: of two coupled circuits."""
    rng = Random(seed)
    a, b, c = sympy.symbols("a b c", positive=True)
    x = sympy.Symbol("x", real=True)
    i, j, n = (rng.randint(1, 9) for _ in range(3))
    inside = sympy.expand((i * a * b - j * c) ** 2 + n * b * c * x**2)
    assert sign(a * c + j * b + root(inside)) == 1
    assert sign(a * c - j * b + root(inside)) is None


@pytest.mark.parametrize("seed", range(12))
def test_beyond_a_bound_a_polynomial_has_the_sign_of_its_terms_in_the_distance(seed):
    """R = a + d with d > 0: of c (R - a) Q(R, a) + P(R, a), and of no polynomial with both signs."""
    rng = Random(seed)
    a, b, R = sympy.symbols("a b R", positive=True)
    coefficients = [rng.randint(-4, 6) for _ in range(4)]
    whole = sympy.expand(sum(c * R**k * a ** (3 - k) for k, c in enumerate(coefficients)) + b)
    given = rng.choice((R - a, (R - a) * (R + a), b * R / a - b, R**2 - 2 * a * R + R * a))
    known = sign(whole, [given])
    values = sympy.lambdify((R, a, b), whole, "math")
    draws = [(10 ** rng.uniform(-2, 2), 10 ** rng.uniform(-2, 2)) for _ in range(300)]
    found = {values(1 + d, 1, b_) > 0 for d, b_ in draws}
    assert known is None or found == {known == 1}
    in_distance = sympy.Poly(whole.subs(R, a + sympy.Symbol("d", positive=True)))
    if all(c > 0 for c in in_distance.coeffs()):
        assert known == 1


@pytest.mark.parametrize("x", ["sin(a)", "cos(2*a)", "a", "a - p", "tan(a)"])
def test_a_modulus_is_positive_where_its_square_is(x):
    a, c = sympy.Symbol("a", real=True), sympy.Symbol("c", positive=True)
    x = sympy.sympify(x, locals={"a": a, "p": p})
    assert sign(-c * abs(x), [c * x**2]) == -1
    assert sign(c * abs(x) ** 3 / p, [x**2]) == 1
    assert sign(c * abs(x), [(a + 3) ** 2]) is None


@pytest.mark.parametrize("seed", range(8))
def test_a_root_outweighs_a_difference_of_either_sign(seed):
    """i x - j y ± √(j² y² + n x²) has the sign of the root where n >= i², else both signs."""
    rng = Random(seed)
    x, y = sympy.symbols("x y", positive=True)
    i, j, n = rng.randint(1, 4), rng.randint(1, 4), rng.randint(1, 20)
    side = rng.choice((1, -1))
    whole = i * x - j * y + side * root(j**2 * y**2 + n * x**2)
    values = sympy.lambdify((x, y), whole, "math")
    found = {math.copysign(1, values(10 ** rng.uniform(-2, 2), 1)) for _ in range(200)}
    known = sign(whole)
    assert known in (None, side)
    assert known is None or found == {known}
    assert known is not None or (side == -1 and n < i**2)


@pytest.mark.parametrize("seed", range(4))
def test_a_sum_of_squares_is_positive_where_one_is_not_zero(seed):
    rng = Random(seed)
    v, c, x = sympy.symbols("v c x", real=True)
    whole = rng.randint(1, 5) * v ** rng.choice([2, 4]) + rng.randint(1, 5) * c**2
    assert sign(whole, [v**2]) == sign(-whole, [v**2, x]) * -1 == 1
    assert sign(whole, [x**2]) is None
    assert sign(whole - 7 * c * v, [v**2]) is None


@pytest.mark.parametrize("inside", [k, k / 3 - p, sympy.sin(k)])
def test_an_arc_whose_cosine_is_given_is_never_negative(inside):
    assert weak_sign(sympy.acos(inside)) == weak_sign(p * sympy.acos(inside) ** 3) == 1
    assert weak_sign(sympy.asin(inside)) is None
    assert sign(sympy.acos(inside)) is None  # it is 0 where the cosine is 1


@pytest.mark.parametrize("side", [1, -1])
def test_beside_a_sine_one_plus_a_cosine_has_one_sign(side):
    a, b = sympy.symbols("a b", real=True)
    sin, cos = sympy.sin, sympy.cos
    assert deciding((1 + side * cos(a)) * sin(a) * b) == sin(a) * b
    assert deciding((1 + side * sin(a)) * cos(a)) == cos(a)
    assert deciding((cos(a) - 1) * sin(a)) == -sin(a)
    assert deciding((1 + cos(a)) * sin(b)).has(cos)
    assert deciding((1 + cos(a)) * b) == (1 + cos(a)) * b


@pytest.mark.parametrize("power", [1, 2, 3])
def test_a_sine_keeps_its_odd_power_beside_its_square(power):
    """1 - cos² is sin²: with a factor sin beside it, the sign is that of sin."""
    a, b = sympy.symbols("a b", real=True)
    sin, cos = sympy.sin, sympy.cos
    square = (1 - cos(a)) * (1 + cos(a))
    for expression in (sin(a) ** power * square * b, sin(a) ** (power + 2) * b):
        kept = sin(a) if power % 2 else sin(a) ** 2
        assert deciding(expression) == kept * b
        rest = deciding(expression, [sin(a) ** 2])
        assert rest == (sin(a) * b if power % 2 else b)
