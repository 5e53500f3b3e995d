"""Exact solutions, ranks and null spaces."""

from __future__ import annotations

import pytest
import sympy as sp
from sympy import Symbol, cos, sin

from lagcli.algebra import (
    Relations,
    is_zero,
    left_nullspace,
    nullspace,
    rank,
    simplify,
    solve_linear,
)

m, length, g = (Symbol(n, positive=True) for n in "m l g".split())
a, b, x, y = (Symbol(n, real=True) for n in "a b x y".split())
ZERO, ONE = sp.S.Zero, sp.S.One


def test_two_unknowns() -> None:
    solution = solve_linear(
        [[m, m * length * cos(a)], [m * length * cos(a), m * length**2]], [ZERO, -g * sin(a)]
    )
    assert solution is not None
    assert solution.values == [g / (length * m * sp.tan(a)), -g / (length**2 * m * sin(a))]
    assert solution.determinant == length**2 * m**2 * sin(a) ** 2
    assert solution.rank == 2


def test_several_right_hand_sides_give_the_inverse() -> None:
    solution = solve_linear([[cos(a), sin(a)], [-sin(a), cos(a)]], [[1, 0], [0, 1]])
    assert solution is not None
    assert solution.values == [[cos(a), -sin(a)], [sin(a), cos(a)]]
    assert solution.determinant == 1


def test_a_singular_matrix_tells_its_rank() -> None:
    solution = solve_linear([[1, sin(a) ** 2], [2, 2 - 2 * cos(a) ** 2]], [ONE, ONE])
    assert solution is not None
    assert solution.singular
    assert solution.rank == 1
    assert solution.determinant is None


def test_the_sign_of_a_determinant_follows_the_rows() -> None:
    for rows, sign in (((0, 1, 2), 1), ((1, 0, 2), -1), ((1, 2, 0), 1), ((2, 1, 0), -1)):
        unit = [[ONE if j == i else ZERO for j in range(3)] for i in rows]
        solution = solve_linear(unit, [ONE, ONE, ONE])
        assert solution is not None
        assert solution.determinant == sign


def test_rank_and_null_vectors_know_trigonometry() -> None:
    matrix = [[ONE, cos(a) ** 2], [ONE, 1 - sin(a) ** 2]]
    assert rank(matrix) == 1
    assert nullspace(matrix) == [[-(cos(a) ** 2), 1]]
    assert left_nullspace(matrix) == [[-1, 1]]


def test_rank_on_a_circle() -> None:
    relations = Relations([x**2 + y**2 - length**2], eliminate=[x, y])
    matrix = [[x, y], [length**2 - y**2, x * y]]
    assert rank(matrix) == 2
    assert rank(matrix, relations) == 1


def test_the_work_is_bounded_by_a_count() -> None:
    n = 6
    symbols = sp.symbols(f"a:{n * n}", real=True)
    matrix = [list(symbols[i * n : (i + 1) * n]) for i in range(n)]
    assert solve_linear(matrix, [ONE] * n, budget=1_000) is None


@pytest.mark.parametrize("n", [2, 5, 9])
def test_sparse_systems_of_any_size(n: int) -> None:
    """A chain of springs: tridiagonal, det = n + 1 for unit springs."""
    matrix = [
        [2 * ONE if i == j else -ONE if abs(i - j) == 1 else ZERO for j in range(n)]
        for i in range(n)
    ]
    right = [sin(a) if i == 0 else ZERO for i in range(n)]
    solution = solve_linear(matrix, right)
    assert solution is not None
    assert solution.determinant == n + 1
    assert solution.values[-1] == simplify(sin(a) / (n + 1))


def test_nullspace_is_annihilated() -> None:
    matrix = [[sin(a), cos(a), b], [sin(2 * a), 2 * cos(a) ** 2, 2 * b * cos(a)]]
    for vector in nullspace(matrix):
        for row in matrix:
            terms = [p * q for p, q in zip(row, vector, strict=True)]
            assert is_zero(sp.Add(*terms)) is True
