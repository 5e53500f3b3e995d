"""Whatever goes in, what comes out is equal to it, and zero is recognized."""

from __future__ import annotations

import mpmath
import pytest
import sympy as sp
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import Relations, is_zero, shape, simplify, solve_linear, to_expression
from lagcli.algebra.build import Builder, symbol, unspecified
from lagcli.algebra.numeric import Evaluator

A, B = (Symbol(n, real=True) for n in ("a", "b"))
M, R = (Symbol(n, positive=True) for n in ("m", "r"))
V = Symbol("a'", real=True)
SYMBOLS = (A, B, M, R, V)
U = unspecified("U", 1)
POINT = {s: mpf(v) for s, v in zip(SYMBOLS, ("0.71", "-0.43", "1.37", "0.89", "0.57"), strict=True)}

numbers = st.builds(sp.Rational, st.integers(-4, 4), st.integers(1, 3))
leaves = st.one_of(st.sampled_from(SYMBOLS), st.sampled_from(SYMBOLS), numbers)
angles = st.builds(
    lambda p, q, i, j: sp.Rational(p, 2) * i + q * j,
    st.integers(-3, 3), st.integers(-2, 2), st.sampled_from((A, B)), st.sampled_from((A, B)),
)  # fmt: skip


def _power(base: Expr, exponent: int) -> Expr:
    return base if base == 0 else base**exponent


def _root(base: Expr) -> Expr:
    return sp.sqrt(base**2 + R**2)


expressions = st.recursive(
    st.one_of(leaves, angles.map(sp.sin), angles.map(sp.cos), angles.map(sp.tan)),
    lambda inner: st.one_of(
        st.builds(sp.Add, inner, inner),
        st.builds(sp.Mul, inner, inner),
        st.builds(_power, inner, st.sampled_from((-2, -1, 2, 3))),
        st.builds(_root, inner),
        st.builds(sp.exp, st.sampled_from((A, -A, A / 2 - B, 2 * B, -R))),
        st.builds(
            sp.Pow, st.sampled_from((M, R)), st.sampled_from((A, A - 1, sp.Rational(3, 2), -A))
        ),
        st.builds(lambda e: sp.sqrt(M * R) * e + sp.sqrt(M) * sp.sqrt(2), inner),
        st.builds(U, st.sampled_from((A, R, A - B, M * R))),
        st.builds(sp.Abs, inner),
    ),
    max_leaves=9,
)
quick = settings(
    max_examples=60, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True
)


def value(expression: Expr, digits: int = 60) -> mpf | None:
    try:
        found = Evaluator([expression], digits)(POINT)[0]
    except (ArithmeticError, KeyError, ValueError):
        return None
    return found if mpmath.isfinite(found) and abs(found) < mpf(10) ** 15 else None


def close(left: mpf, right: mpf) -> bool:
    with mpmath.workdps(60):
        return bool(abs(left - right) <= mpf(10) ** -25 * (1 + abs(left)))


def rebuilt(expression: Expr) -> Expr:
    names = {s.name: s for s in SYMBOLS if "'" not in s.name}
    build = Builder(names, {"U": 1}, lambda e: V if e == A else symbol("unknown"))
    return build(to_expression(expression))


@pytest.mark.long
@quick
@given(expressions)
def test_simplify_gives_something_equal(expression: Expr) -> None:
    before = value(expression)
    if before is not None:
        after = value(simplify(expression))
        assert after is not None
        assert close(before, after)


@pytest.mark.long
@quick
@given(expressions)
def test_the_printed_tree_reads_back_as_something_equal(expression: Expr) -> None:
    before = value(expression)
    if before is not None:
        after = value(rebuilt(expression))
        assert after is not None
        assert close(before, after)


@pytest.mark.long
@quick
@given(expressions)
def test_the_shape_reads_back_as_something_equal(expression: Expr) -> None:
    names = {s.name: s for s in SYMBOLS if "'" not in s.name}
    build = Builder(names, {"U": 1}, lambda e: V if e == A else symbol("unknown"))
    before = value(expression)
    if before is not None:
        after = value(build(shape(expression, ["m", "r", "b", "a"])))
        assert after is not None
        assert close(before, after)


@pytest.mark.long
@quick
@given(expressions)
def test_what_expands_to_nothing_is_zero(expression: Expr) -> None:
    if value(expression) is not None:
        assert is_zero(sp.expand(expression * (A + 1)) - A * expression - expression) is not False


@quick
@given(expressions, expressions)
def test_what_is_certainly_not_zero_has_a_value(left: Expr, right: Expr) -> None:
    difference = left - right
    number = value(difference)
    if number is not None:
        verdict = is_zero(difference)
        if verdict is True:
            assert abs(number) < mpf(10) ** -25
        if verdict is False:
            assert abs(number) > mpf(10) ** -40


@pytest.mark.long
@quick
@given(expressions)
def test_relations_keep_the_value_on_them(expression: Expr) -> None:
    """On b = 3*m (solved) and a² + a'² = r² (reduced)."""
    relations = Relations([B - 3 * M, A**2 + V**2 - R**2], eliminate=[B, A, V])
    with mpmath.workdps(60):
        point = {**POINT, B: 3 * POINT[M], R: mpmath.sqrt(POINT[A] ** 2 + POINT[V] ** 2)}
    try:
        before = Evaluator([expression], 60)(point)[0]
    except (ArithmeticError, ValueError):
        return
    after = Evaluator([simplify(expression, relations)], 60)(point)[0]
    assert close(before, after)


@pytest.mark.long
@settings(max_examples=40, deadline=None, derandomize=True)
@given(st.lists(st.one_of(leaves, angles.map(sp.cos)), min_size=12, max_size=12))
def test_solutions_satisfy_their_equations(entries: list[Expr]) -> None:
    A_, b_ = [entries[0:3], entries[3:6], entries[6:9]], entries[9:12]
    solution = solve_linear(A_, b_)
    assert solution is not None
    if not solution.singular:
        for row, right in zip(A_, b_, strict=True):
            terms = [a * x for a, x in zip(row, solution.values, strict=True)]
            assert is_zero(sp.Add(*terms) - right) is True


@pytest.mark.parametrize("function", [sp.exp, sp.sin, sp.tanh])
def test_a_number_that_would_take_all_memory_is_none(function):
    x = Symbol("x", real=True)
    with pytest.raises(OverflowError):
        Evaluator([function(x ** (2**20))], 50)({x: 3})
