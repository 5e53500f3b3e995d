"""Roots a + b sqrt(c) and a - b sqrt(c) written alike, to be read as a ± b sqrt(c)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra.decimals import written
from lagcli.algebra.positivity import sign_of
from lagcli.algebra.signs import sign
from lagcli.algebra.simplification import shape, simplify
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Quotient,
    Sum,
    factors_of,
    opposite,
    walk,
)
from lagcli.notation.ordering import negative_of
from lagcli.rewriting import put_in, rebuilt

_ROOT = "sqrt"  # the place of the root; no name of a file, since it is a function's
_INSIDE = Name("acos")  # the place of what the function of an angle has inside


def written_alike(roots: Sequence[Expr], order: Sequence[str]) -> list[Expression]:
    """The readable shapes of roots, those of one quadratic equation with one outline."""
    found: list[Expression | None] = [None] * len(roots)
    for k, first in enumerate(roots):
        for j in range(k + 1, len(roots)):
            if found[k] is None and found[j] is None:
                found[k], found[j] = _pair(first, roots[j], order) or (None, None)
    return [
        written(x, order) if tree is None else tree for x, tree in zip(roots, found, strict=True)
    ]


def _pair(first: Expr, second: Expr, order: Sequence[str]) -> tuple[Expression, Expression] | None:
    (outer, inside), (other, inside_other) = map(_opened, (first, second))
    if outer == other and inside is not None and inside_other is not None:
        within = _pair(inside, inside_other, order)
        tree = shape(outer, order)
        return within and (put_in(tree, {_INSIDE: within[0]}), put_in(tree, {_INSIDE: within[1]}))
    middle, half = simplify((first + second) / 2), simplify((first - second) / 2)
    roots = [f for f in sympy.Mul.make_args(half) if f.is_Pow and abs(f.exp) == sympy.S.Half]
    root = sympy.Mul(*roots)
    if middle == 0 or not roots or not simplify(half / root).is_rational_function():
        return None
    if any(middle.has(f) for f in roots):
        return None
    place, mark = Name(_ROOT), Symbol(_ROOT, real=True)
    # (b + root)/(c - a) for (-b - root)/(a - c)
    trees = [shape(middle + sign * half / root * mark, order) for sign in (1, -1)]
    sign, tree = min(zip((1, -1), trees, strict=True), key=lambda each: _minus_signs(each[1]))
    if sum(node == place for node in walk(tree)) != 1:
        return None
    whole: dict[Expression, Expression] = {place: shape(root, order)}
    one, other = put_in(tree, whole), put_in(_turned(tree, place), whole)
    return (one, other) if sign == 1 else (other, one)


def _opened(root: Expr) -> tuple[Expr, Expr | None]:
    """c acos(place) and u of c acos(u), or of asin and atan; no place where there is none."""
    found = root.atoms(sympy.acos, sympy.asin, sympy.atan)
    if len(found) != 1:
        return root, None
    [angle] = found
    place = angle.func(Symbol(_INSIDE.name, real=True))
    return root.xreplace({angle: place}), angle.args[0]


def _minus_signs(tree: Expression) -> int:
    return sum(isinstance(node, Negative) for node in walk(tree))


def with_number_turned(
    first: Expr, second: Expr, order: Sequence[str]
) -> tuple[Expression, Expression] | None:
    """Both shapes, where the second has -sqrt(n) for the sqrt(n) of the first: (2 ± sqrt(2)) k."""
    numbers = {p for p in first.atoms(sympy.Pow) if p.is_number and p.exp == sympy.S.Half}
    if len(numbers) != 1:
        return None
    [root] = numbers
    other = first.xreplace({root: -root})
    if simplify(other**2 - second**2) != 0 or sign(other) == -1:
        return None
    tree, place = shape(first, order), shape(root, order)
    terms = [t for node in walk(tree) if isinstance(node, Sum) for t in node.terms]
    single = [t for t in terms if sum(n == place for n in walk(t)) == 1 and not _has_sum(t)]
    if not single or len(single) != sum(node == place for node in walk(tree)):
        return None  # also where the root is within another, as in sqrt(2*g*a)
    return tree, _turned(tree, place)


def _has_sum(tree: Expression) -> bool:
    return any(isinstance(node, Sum) for node in walk(tree))


def _turned(node: Expression, place: Expression) -> Expression:
    """The same with the opposite sign of the term in which the root stands."""

    def within(part: Expression) -> bool:
        return any(each == place for each in walk(part))

    if isinstance(node, Sum) and not any(
        isinstance(p, Sum) and within(p) for p in walk(node) if p is not node
    ):
        return Sum(tuple(opposite(term) if within(term) else term for term in node.terms))
    return rebuilt(node, lambda part: _turned(part, place))


def without_root_below(value: Expr) -> Expr:
    """(a - sqrt(b)) c/(a² - b) of c/(a + sqrt(b)); anything else as it is."""
    above, below = sympy.fraction(sympy.together(value))
    roots = [power for power in below.atoms(sympy.Pow) if power.exp == sympy.S.Half]
    if len(roots) != 1:
        return value
    [root], place = roots, sympy.Dummy()
    hidden = below.xreplace({root: place})
    if not hidden.is_polynomial(place) or sympy.degree(hidden, place) != 1:
        return value
    slope, rest = hidden.coeff(place, 1), hidden.coeff(place, 0)
    return simplify(above * (rest - slope * root) / simplify(rest**2 - slope**2 * root.base))


def with_positive_factors(
    tree: Expression, build: Callable[[Expression], Expr], positive: Sequence[Expr]
) -> Expression:
    """sqrt((a - b)/(c - d)) for sqrt((b - a)/(d - c)), where these are negative."""
    for node in walk(tree):
        if isinstance(node, Call) and isinstance(quotient := node.arguments[0], Quotient):
            parts = (quotient.numerator, quotient.denominator)
            sums = [x for part in parts for x in factors_of(part) if isinstance(x, Sum)]
            negative = [x for x in sums if sign_of(build(x), positive) == -1]
            if len(negative) == 2:
                turned: dict[Expression, Expression] = {x: negative_of(x) for x in negative}
                tree = put_in(tree, {node: put_in(node, turned)})
    return tree
