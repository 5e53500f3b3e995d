"""Square roots whose value a constraint gives: sqrt(x² + z²) = a.

The root is replaced by its value, and the constraint by its square x² + z² = a².  That has
more solutions than the constraint; what is found with it is verified on the constraint.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sympy import Dummy, Expr, Pow, Symbol, together

from lagcli.algebra import simplify


def roots_on_surface(constraints: Iterable[Expr], moving: Iterable[Symbol]) -> dict[Expr, Expr]:
    """Radicand R -> the value of its square root, of constraints linear in one root."""
    found: dict[Expr, Expr] = {}
    coordinates = set(moving)
    for f in constraints:
        radicands = {p.base for p in f.atoms(Pow) if _is_root(p) and p.free_symbols & coordinates}
        if len(radicands) != 1:
            continue
        [radicand] = radicands
        root = Dummy("root", positive=True)
        linear = together(with_roots(f, {radicand: root})).as_numer_denom()[0].expand()
        slope = linear.coeff(root, 1)
        rest = linear.coeff(root, 0)
        if slope == 0 or slope.free_symbols & coordinates or (linear - slope * root - rest) != 0:
            continue
        found.setdefault(radicand, simplify(-rest / slope))
    return found


def with_roots(expression: Expr, values: Mapping[Expr, Expr]) -> Expr:
    """The expression with the values of the roots put in."""
    powers = [p for p in expression.atoms(Pow) if p.base in values and _is_root(p)]
    return expression.xreplace({p: values[p.base] ** (2 * p.exp) for p in powers})


def without_roots(constraint: Expr, values: Mapping[Expr, Expr]) -> Expr:
    """R - value² for the constraint that gives a root its value; any other as it is."""
    radicands = [p.base for p in constraint.atoms(Pow) if p.base in values and _is_root(p)]
    if radicands and simplify(with_roots(constraint, values)) == 0:
        return radicands[0] - values[radicands[0]] ** 2
    return with_roots(constraint, values)


def _is_root(power: Pow) -> bool:
    return bool(power.exp.is_Rational and power.exp.q == 2)
