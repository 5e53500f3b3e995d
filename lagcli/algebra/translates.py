"""The least period of formulas in a length x, such as pi a of tan(x/a): one root of each class.

An angle has one turn as its period, whatever the formulas.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import sympy
from sympy import Expr, Symbol, igcd, ilcm

from lagcli.algebra.build import CIRCULAR, free_of
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import is_zero, simplify

#: cos(x/a)^4 - sin(x/a)^4 and the like: the n of which the n-th part of a turn is tried.
_PARTS = (8, 4, 3, 2)


def recur(formulas: Iterable[Expr], x: Symbol, shift: Expr = 2 * sympy.pi) -> bool:
    """Whether f(x + shift) = f(x) of all, by a turn if nothing else is said."""
    return all(is_zero(f.xreplace({x: x + shift}) - f) is True for f in formulas)


def least_period(formulas: Sequence[Expr], x: Symbol) -> Expr | None:
    """The least P > 0 with f(x + P) = f(x); None where x is an angle or occurs outside of sines."""
    whole = common_period(formulas, x, [x])
    angle = whole is None or (whole / sympy.pi).is_Rational
    return None if angle or whole is None else least_part(formulas, x, whole)


def common_period(formulas: Sequence[Expr], x: Symbol, state: Sequence[Symbol]) -> Expr | None:
    """That of all sines of r x + …, if the rates r are commensurable and free of the state."""
    nodes = {node for f in formulas for node in f.atoms(*CIRCULAR) if not free_of(node, [x])}
    hidden: dict[Expr, Expr] = {node: sympy.Dummy() for node in nodes}
    if not nodes or any(not free_of(f.xreplace(hidden), [x]) for f in formulas):
        return None
    slopes = [simplify(node.args[0].diff(x)) for node in nodes]
    ratios = [simplify(slope / slopes[0]) for slope in slopes]
    if not free_of(slopes[0], state) or not all(ratio.is_Rational for ratio in ratios):
        return None
    # 1/3 of 1, 2 and 1/3, where sympy.gcd_list gives 1 in this order
    measure = sympy.Rational(igcd(*(r.p for r in ratios), 0), ilcm(*(r.q for r in ratios), 1))
    rate = slopes[0] * measure
    return simplify(2 * sympy.pi * (-1 if sign(rate) == -1 else 1) / rate)


def least_part(formulas: Sequence[Expr], x: Symbol, whole: Expr) -> Expr:
    """The least part of a period that is one: half of it for sin(x)^2 and tan(x)."""
    return next((whole / n for n in _PARTS if recur(formulas, x, whole / n)), whole)


def one_of_each(values: Iterable[Expr], period: Expr) -> list[Expr]:
    """The shortest of the values that differ by whole periods."""
    kept: dict[Expr, Expr] = {}
    for value in sorted(values, key=_length):
        plain = value.replace(_is_of_negative, lambda f: sympy.pi - sympy.acos(-f.args[0]))
        gaps = (simplify((plain - other) / period) for other in kept.values())
        if not any(gap.is_Integer for gap in gaps):
            kept[value] = plain
    return list(kept)


def _length(value: Expr) -> tuple[int, int, str]:
    return sympy.count_ops(value), sum(1 for _ in sympy.preorder_traversal(value)), str(value)


def _is_of_negative(node: Expr) -> bool:
    return isinstance(node, sympy.acos) and node.args[0].could_extract_minus_sign()
