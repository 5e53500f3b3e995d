"""The old variables from the new ones: Q(q, p) = Q, P(q, p) = P solved, one after another.

A variable is solved for where an equation can be peeled: what stands around it is undone
step by step, and the rest is solved as an equation in it.  Every branch of a root is a
candidate, so whoever uses one has to test it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

import sympy
from sympy import Expr, Pow, Symbol

from lagcli.algebra import simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import solve_for

_MOST_CANDIDATES = 16
_MOST_OPERATIONS = 300  # measured: at most 16

_INVERSES = {
    sympy.sin: sympy.asin,
    sympy.cos: sympy.acos,
    sympy.tan: sympy.atan,
    sympy.cot: lambda value: sympy.atan(1 / value),
    sympy.asin: sympy.sin,
    sympy.acos: sympy.cos,
    sympy.atan: sympy.tan,
    sympy.sinh: sympy.asinh,
    sympy.cosh: sympy.acosh,
    sympy.tanh: sympy.atanh,
    sympy.asinh: sympy.sinh,
    sympy.acosh: sympy.cosh,
    sympy.atanh: sympy.tanh,
    sympy.exp: sympy.log,
    sympy.log: sympy.exp,
}

#: (a function of the unknowns, its value)
Known = tuple[Expr, Expr]


def candidates(
    equations: Sequence[Known], unknowns: Sequence[Symbol]
) -> Iterator[Mapping[Symbol, Expr]]:
    """Solutions for the unknowns, some of which may belong to other branches."""
    yield from islice(_solutions(list(equations), list(unknowns)), _MOST_CANDIDATES)


def _solutions(equations: list[Known], unknowns: list[Symbol]) -> Iterator[dict[Symbol, Expr]]:
    if not unknowns:
        yield {}
        return
    for place, unknown, roots in _steps(equations, unknowns):
        others = [each for i, each in enumerate(equations) if i != place]
        left = [u for u in unknowns if u != unknown]
        for root in roots:
            put_in = {**_root_of(unknown, root), unknown: root}
            reduced = [(_tangents(simplify(f.xreplace(put_in))), value) for f, value in others]
            if any(sympy.count_ops(f) > _MOST_OPERATIONS for f, _ in reduced):
                continue
            for solution in _solutions(reduced, left):
                yield {**solution, unknown: simplify(root.xreplace(solution))}
        return


def _root_of(unknown: Symbol, value: Expr) -> dict[Expr, Expr]:
    """{sqrt(x): y} where x = y^2, without the modulus: another branch has the other sign."""
    halves = []
    for factor in sympy.Mul.make_args(value):
        base, exponent = factor.as_base_exp()
        if factor.is_positive:
            halves.append(sympy.sqrt(factor))
        elif exponent.is_Integer and exponent % 2 == 0:
            halves.append(base ** (exponent / 2))
        else:
            return {}
    return {sympy.sqrt(unknown): sympy.Mul(*halves)}


def _tangents(expression: Expr) -> Expr:
    """With tan for sin/cos where no other sine or cosine of the angle is left."""
    for sine in expression.atoms(sympy.sin):
        angle = sine.args[0]
        found = expression.xreplace({sine: sympy.tan(angle) * sympy.cos(angle)})
        if not found.has(sine, sympy.cos(angle)):
            expression = found
    return expression


def _steps(
    equations: list[Known], unknowns: list[Symbol]
) -> Iterator[tuple[int, Symbol, list[Expr]]]:
    """An equation with an unknown it can be solved for: one unknown and one root first."""
    found = []
    for place, (f, value) in enumerate(equations):
        present = [u for u in unknowns if not free_of(f, [u])]
        for unknown in present:
            roots = undone(f, unknown, value)
            if roots:
                found.append((len(present), len(roots), place, unknown, roots))
    found.sort(key=lambda step: (step[0] > 1, step[1], step[0], step[2]))
    for _, _, place, unknown, roots in found:
        yield place, unknown, roots


def undone(expression: Expr, x: Symbol, value: Expr) -> list[Expr]:
    """The x with expression = value that peeling gives; none where it does not end."""
    if expression == x:
        return [value]
    if expression.is_Add or expression.is_Mul:
        apart, within = expression.as_independent(x, as_Add=expression.is_Add)
        if not (within.is_Add and expression.is_Add) and not (within.is_Mul and expression.is_Mul):
            rest = value - apart if expression.is_Add else value / apart
            return undone(within, x, rest)
        found = solve_for(expression - value, x)
        return list(found.values) if found else []
    if isinstance(expression, Pow) and free_of(expression.exp, [x]):
        root = value ** (1 / expression.exp)
        even = expression.exp.is_Integer and expression.exp % 2 == 0
        signs = (1, -1) if even else (1,)
        return [x0 for sign in signs for x0 in undone(expression.base, x, sign * root)]
    inverse = _INVERSES.get(expression.func)
    if inverse is None or len(expression.args) != 1:
        return []
    return undone(expression.args[0], x, inverse(value))
