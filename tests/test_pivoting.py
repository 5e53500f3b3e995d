"""Full pivoting against the rank and the reduced echelon form of exact matrices."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
import sympy

from lagcli.pivoting import reduced


@pytest.mark.parametrize("seed", range(12))
def test_pivots_are_as_many_as_the_rank_and_the_rows_have_the_same_solutions(seed):
    draw = random.Random(seed)
    rows, columns, rank = draw.randint(1, 5), draw.randint(1, 5), draw.randint(0, 3)
    left = sympy.Matrix(rows, rank, lambda *_: draw.randint(-4, 4))
    given = left * sympy.Matrix(rank, columns, lambda *_: draw.randint(-4, 4))
    work = [[Fraction(int(given[i, j])) for j in range(columns)] for i in range(rows)]
    pivots = reduced(work, columns, 0)
    assert len(pivots) == given.rank()
    assert all(work[i][j] == int(k == i) for k, j in pivots for i in range(rows))
    made = sympy.Matrix(rows, columns, lambda i, j: sympy.Rational(*work[i][j].as_integer_ratio()))
    assert made.rref()[0] == given.rref()[0]


def test_a_column_of_less_weight_is_taken_later():
    assert reduced([[1.0, 2.0], [3.0, 4.0]], 2, 0.0)[0] == (1, 1)
    assert reduced([[1.0, 2.0], [3.0, 4.0]], 2, 0.0, [1.0, 0.1])[0] == (1, 0)
