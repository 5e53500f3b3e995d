"""What makes a root real."""

from __future__ import annotations

from collections.abc import Iterator

from sympy import Expr, Pow, acos, acosh, asin, atanh, preorder_traversal


def not_negative_where_real(root: Expr) -> Iterator[Expr]:
    """What must not be negative: k in sqrt(k), 1 - k² in acos(k), k - 1 in acosh(k)."""
    for node in preorder_traversal(root):
        if isinstance(node, (acos, asin, atanh)):
            yield 1 - node.args[0] ** 2
        elif isinstance(node, Pow) and node.exp.is_Rational and node.exp.q % 2 == 0:
            yield node.base
        elif isinstance(node, acosh):
            yield node.args[0] - 1
