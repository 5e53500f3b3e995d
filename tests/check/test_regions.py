"""Conditions are compared by where they hold, however they are written."""

from __future__ import annotations

import pytest
import sympy

from lagcli.algebra.generic_rank import has_full_rank
from lagcli.studies.check.regions import same_region

a, b = sympy.symbols("a b", positive=True)
x = sympy.Symbol("x", real=True)


@pytest.mark.parametrize(
    ("found", "expected", "same"),
    [
        ([a - sympy.sqrt(2) * b], [a**2 - 2 * b**2], True),
        ([a - sympy.sqrt(2) * b], [10**10 * a**2 - (2 * 10**10 + 1) * b**2], False),
        ([a * (7 - 2 * sympy.sqrt(2)) - b], [7 * a - b, (7 * a - b) ** 2 - 8 * a**2], True),
        ([a * (7 - 2 * sympy.sqrt(2)) - b], [(7 * a - b) ** 2 - 8 * a**2], False),
        ([1 - x, 1 + x], [1 - x**2], True),
        ([1 - x], [1 - x**2], False),
        ([a], [b], False),
    ],
)
def test_regions(found: list[sympy.Expr], expected: list[sympy.Expr], *, same: bool) -> None:
    assert same_region(found, expected) is same


def test_a_rank_where_a_root_is_imaginary() -> None:
    root = sympy.sqrt(x**2 - 100)
    assert has_full_rank([[root, x], [x, -root]])
    assert not has_full_rank([[root, x], [-x * root, -(x**2)]])
