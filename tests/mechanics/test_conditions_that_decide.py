"""Conditions with parameters of any sign: they decide, and are left out where all values obey."""

from __future__ import annotations

import random

import pytest
import sympy

from lagcli.algebra.build import Builder, symbol
from lagcli.evaluation import evaluated
from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.conditions import above, conditions, opposites
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import explain
from lagcli.reader import parse_text
from lagcli.statements.wording import conditions as worded

from .derived import derive
from .test_explanation import words


def coupled(source: random.Random, field: int) -> str:
    """Two masses on a line with a force between them alone, in skew coordinates, and a field."""
    a, b, c, d = 1, *(source.randint(-2, 2) for _ in range(3))
    if b * c == a * d:
        d += 1
    first, second = f"({a}*u + {b}*v)", f"({c}*u + {d}*v)"
    rates = [each.replace("u", "u'").replace("v", "v'") for each in (first, second)]
    stretch = f"({first} - {second})"
    turning = f" + {field}*{stretch}*({rates[0]} + {rates[1]})"
    V = source.choice((f"k*{stretch}^2/2", f"-k*cos({stretch})"))
    return (
        "coordinates: [u, v]\nparameters: {m: {assume: positive}, M: {assume: positive}, k: }\n"
        f"L: m*{rates[0]}^2/2 + M*{rates[1]}^2/2{turning} - ({V})\n"
    )


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("field", [0, 1])
def test_the_sign_of_one_stiffness_decides_across_a_family(seed, field):
    text = coupled(random.Random(f"coupled {seed}"), field)
    rest, *_ = equilibria(derive(text).dynamics).equilibria
    steady, *_ = steady_motions(derive(text))[0].motions
    assert rest.verdict.across == bool(rest.free)
    for verdict in (rest.verdict, steady.verdict):
        for k in (-1.5, 0.7):
            known = {"k": k, "m": 1.3, "M": 0.4}
            stable, unstable = (
                [evaluated(c.left, known, {}) > evaluated(c.right, known, {}) for c in each]
                for each in (verdict.minimum, verdict.unstable)
            )
            if field and k < 0:  # it may stabilise, and at given momenta it does
                continue
            assert (all(stable), any(unstable)) == (k > 0, k < 0), text


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("leaning", [True, False])
def test_a_bound_that_every_momentum_obeys_is_not_stated(seed, leaning):
    """A C of p(u) = A u + B + C/u: V grows with θ upright to lying, or falls."""
    source = random.Random(f"bound {seed}")
    c, n = source.randint(1, 5), source.choice((1, 3))
    V = f"m*g*a*cos(theta)*{c}" if leaning else f"{c}*m*g*a*sin(theta)^{n}"
    text = (
        "coordinates: [phi, theta, psi]\nparameters: {m: {assume: positive}, "
        "g: {assume: positive}, a: {assume: positive}}\n"
        "T: m*a^2*(theta'^2 + sin(theta)^2*phi'^2)/2 + m*a^2*(psi' + cos(theta)*phi')^2/2\n"
        f"V: {V}\n"
    )
    told = words(explain(derive(text), ["steady_motions"]), "Steady motions")
    assert ("with real roots for" in told) == leaning


@pytest.mark.parametrize("seed", range(3))
def test_a_condition_says_along_which_coordinates_nothing_restores(seed):
    """A bob and a wheel beside it that nothing holds: at every angle of the wheel."""
    source = random.Random(f"beside {seed}")
    q, p = source.sample(["u", "v"], 2)
    text = (
        f"coordinates: [u, v]\nparameters: {{m: {{assume: positive}}, k: }}\n"
        f"T: m*({q}'^2 + {source.randint(1, 4)}*{p}'^2)/2\nV: {source.randint(1, 3)}*k*{q}^2/2\n"
    )
    told = words(explain(derive(text), ["equilibria"]), "Equilibria")
    assert f"Stable up to displacements of {p} where" in told


@pytest.mark.parametrize("seed", range(6))
def test_what_existence_implies_is_no_condition(seed):
    """Of k/d > 0, d is known to be positive: neither d > 0 nor d s² < 0 is said."""
    source = random.Random(seed)
    k, a, b = (sympy.Symbol(name, positive=True) for name in "kab")
    u = sympy.Symbol("u", real=True)
    d = (source.randint(1, 4) * a - source.randint(1, 4) * b) * sympy.cos(u)
    s = source.randint(1, 4) * a - b * source.choice([u, u**2])
    order = ["u", "a", "b", "k"]
    [left] = conditions([d * s**2], order, [k / d])
    assert to_grammar(left.right) == "0"
    assert conditions([d], order, [k / d]) == ()
    assert opposites([d * s**2, d], order, [k / d]) == ()
    assert opposites([-d], order, [k]) != ()


@pytest.mark.parametrize("seed", range(4))
def test_a_square_of_a_sine_is_compared_as_it_stands(seed):
    """k > n m w² sin², not k + n m w² cos² > n m w²: every symbol once in what is printed."""
    m, k, w = sympy.symbols("m k w", positive=True)
    a = sympy.Symbol("a", real=True)
    source = random.Random(seed)
    circular = source.choice([sympy.sin, sympy.cos])
    positive = k - source.randint(1, 9) * m * w**2 * circular(a) ** 2
    [found] = conditions([positive], ["k", "m", "w", "a"])
    printed = to_grammar(found.left) + to_grammar(found.right)
    assert all(printed.count(each) == 1 for each in ("k", "m", "w", circular.__name__))


@pytest.mark.parametrize("seed", range(6))
def test_a_number_stands_alone_and_on_the_right(seed):
    """C n + c > 0 is n > -c/C; 1 > C n (1 - n) is C n (1 - n) < 1 (Danby, section 8.5)."""
    source = random.Random(seed)
    n = sympy.Symbol("n", real=True)
    C, c = source.randint(1, 30), source.randint(1, 9)
    for expression in (C * n + c, 1 - C * n + C * n**2):
        for forms, sign in ((conditions, 1), (opposites, -1)):
            [each] = forms([expression], ["n"])
            left, _, right = worded([each])[1:]
            assert "n" in to_grammar(left)
            assert "n" not in to_grammar(right)
            for value in (-3.7, -0.4, 0.3, 0.97, 5.1):
                held = evaluated(each.left, {"n": value}, {}) > evaluated(
                    each.right, {"n": value}, {}
                )
                assert held == bool(sign * expression.subs(n, value) > 0)


@pytest.mark.parametrize(("p", "q"), [(0, 1), (1, 0), (0, -1)])
def test_a_plumb_line_is_stable_where_its_cosine_is_positive(p, q):
    """V = -k cos(y - p a) - b sin(y - q a): the sign of one sum decides, not that of a product.

    It is stable where V'' > 0; k² + b² + 2 k b sin(…) under its root has one sign.
    """
    V = f"-k*cos(y - {p}*a) - b*sin(y - ({q})*a)"
    text = (
        "{coordinates: [y], parameters: {k: {assume: positive}, b: {assume: positive}, a: {}}, "
        f"T: y'^2/2, V: {V}}}"
    )
    found = equilibria(derive(text).dynamics).equilibria
    assert len(found) == 2
    source = random.Random(p)
    second = sympy.sympify(V).diff("y", 2)
    for each in found:
        [condition] = each.verdict.minimum
        difference = f"{to_grammar(condition.left)} - ({to_grammar(condition.right)})"
        formula = sympy.sympify(difference.replace("^", "**"))
        assert not any(e.exp > 1 for e in formula.atoms(sympy.Pow))
        place = sympy.sympify(to_grammar(each.at["y"]).replace("^", "**"))
        for _ in range(20):
            values = {x: source.uniform(0.2, 3) for x in "kb"} | {"a": source.uniform(-3, 3)}
            known = second.subs("y", place.subs(values)).subs(values)
            assert bool(formula.subs(values) > 0) == bool(known > 0)


def by_numbers(stated, known: dict[str, float]) -> list[bool]:
    return [
        all(evaluated(e.left, known, {}) > evaluated(e.right, known, {}) for e in (c, *c.besides))
        for c in stated
    ]


@pytest.mark.parametrize("seed", range(3))
def test_where_a_factor_is_0_nothing_is_said_to_be_unstable(seed):
    """(C - A) b² q²/2: reversed it is A > C and b not 0."""
    source = random.Random(f"beside {seed}")
    i, factor = source.randint(1, 4), ["b^2", "(b - c)^2", "b^2*c^2"][seed]
    text = (
        "coordinates: [q]\nparameters: {A: {assume: positive}, C: {assume: positive}, b: , c: }\n"
        f"T: A*q'^2/2\nV: {i}*(C - A)*{factor}*q^2/2\n"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria
    [unstable] = rest.verdict.unstable
    assert (to_grammar(unstable.left), to_grammar(unstable.right)) == ("A", "C")
    for _ in range(20):
        known = {name: source.uniform(0.1, 1.4) for name in ("A", "C", "b", "c")}
        assert by_numbers([unstable], known) == [known["A"] > known["C"]]
    assert by_numbers([unstable], {"A": 2, "C": 1, "b": 0, "c": 0}) == [False]


def test_the_gyrocompass_turns_away_from_north_where_its_disk_is_long():
    """Klein and Sommerfeld: the axle of the greater moment seeks the meridian, but at a pole."""
    text = (
        "coordinates: [phi, psi]\nparameters: {A: {assume: positive}, C: {assume: positive}, "
        "W: {assume: positive}, beta: }\ndefinitions: {axial: psi' + W*cos(beta)*cos(phi)}\n"
        "T: C*axial^2/2 + A*(W^2*cos(beta)^2*sin(phi)^2 + (phi' + W*sin(beta))^2)/2\n"
    )
    north = next(e for e in equilibria(derive(text).dynamics).equilibria if e.verdict.unstable)
    [condition] = north.verdict.unstable
    told = (
        to_grammar(part) if isinstance(part, Expression) else part for part in worded([condition])
    )
    assert "".join(told) == "A > C and cos(beta) ≠ 0"


@pytest.mark.parametrize("seed", range(4))
def test_a_symmetric_chain_is_stable_where_both_springs_are(seed):
    """(k x² + c (x - y)²) on both sides of y: definite just for k > 0 and c > 0."""
    source = random.Random(f"chain {seed}")
    i, j = source.randint(1, 4), source.randint(1, 4)
    text = (
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, k: , c: }\n"
        "T: m*(x'^2 + y'^2 + z'^2)/2\n"
        f"V: {i}*k*(x^2 + z^2)/2 + {j}*c*((x - y)^2 + (y - z)^2)/2\n"
    )
    [rest] = equilibria(derive(text).dynamics).equilibria
    assert len(rest.verdict.minimum) == len(rest.verdict.unstable) == 2
    for _ in range(40):
        known = {"k": source.uniform(-1, 1), "c": source.uniform(-1, 1), "m": 1.1}
        both = known["k"] > 0 and known["c"] > 0
        assert all(by_numbers(rest.verdict.minimum, known)) == both
        assert any(by_numbers(rest.verdict.unstable, known)) == (not both)


@pytest.mark.parametrize("seed", range(2))
def test_a_condition_is_short_where_existence_knows_the_rest(seed):
    """V = b cos + k sin²/2 has minima aside just for k < 0, where they exist."""
    source = random.Random(f"aside {seed}")
    i, wave = source.randint(1, 4), source.choice(["cos(theta)", "-cos(theta)"])
    text = (
        "coordinates: [theta]\nparameters: {m: {assume: positive}, b: {assume: positive}, k: }\n"
        f"T: m*theta'^2/2\nV: {i}*b*{wave} + k*sin(theta)^2/2\n"
    )
    aside = next(e for e in equilibria(derive(text).dynamics).equilibria if e.where)
    assert conditions_of(aside.verdict.minimum) == ["k < 0"]
    assert conditions_of(aside.verdict.unstable) == ["k > 0"]


def conditions_of(stated) -> list[str]:
    return [
        f"{to_grammar(c.left)} > {to_grammar(c.right)}".replace("0 > k", "k < 0") for c in stated
    ]


@pytest.mark.parametrize(
    ("positive", "shown"),
    [  # the conditions of a gyroscope in gimbals: Magnus, Kreisel, section 5
        ("-w*((A + B - C)*w + p)", "0 > (p + (A + B - C)*w)*w"),
        ("w*(C*w + p - (A + B)*w)", "(p - (A + B - C)*w)*w > 0"),
        ("-(p + w)*(A*p + B*w)", "0 > (A*p + B*w)*(p + w)"),
        ("(A + B - C)^2*p^2 - (A + B)^2*w^2", "(A + B - C)^2*p^2 > (A + B)^2*w^2"),
        ("(A + B + D)*w^2 - (A + B - C)*p^2", "(A + B + D)*w^2 > (A + B - C)*p^2"),
        ("w*(A - C)", "(A - C)*w > 0"),
        ("A*p - B*w^2", "A*p > B*w^2"),
    ],
)
def test_a_condition_keeps_its_factors_and_its_squares(positive: str, shown: str) -> None:
    """In the shape of the squared frequency whose sign it is, and with that sign at random."""
    names = {n: symbol(n, "positive") for n in "ABCD"} | {n: symbol(n) for n in "pw"}
    expression = Builder(names, {}, lambda e: e)(parse_text(positive))
    found = above(expression, list(names))
    assert found is not None
    assert f"{to_grammar(found.left)} > {to_grammar(found.right)}" == shown
    chance = random.Random(11)
    for _ in range(20):
        values = {s: chance.uniform(0.3, 2) * (1 if s.is_positive else chance.choice((-1, 1)))
                  for s in names.values()}  # fmt: skip
        left, right = (
            Builder(names, {}, lambda e: e)(side).subs(values) for side in (found.left, found.right)
        )
        assert (left > right) == (expression.subs(values) > 0)
