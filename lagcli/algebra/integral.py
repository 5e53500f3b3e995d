"""Integrals that are not elementary, as the grammar writes them: `integral(f, x, a, b)`.

The variable of integration is a symbol of its own, written as the variable that it runs for.
"""

from __future__ import annotations

from typing import Any

import sympy
from sympy import Expr, Symbol

_MARK = "~"  # of the variable of integration; no name of a file has it


class DefiniteIntegral(sympy.Function):  # type: ignore[misc]
    """The integral of f(s) from s = a to s = b; its arguments are f, s, a, b."""

    nargs = 4
    is_real = True

    @property
    def free_symbols(self) -> set[Any]:
        """Those of the value: the variable of integration is none."""
        integrand, variable, start, end = self.args
        inside: set[Any] = integrand.free_symbols - {variable}
        return inside.union(start.free_symbols, end.free_symbols)

    def _eval_derivative(self, symbol: Symbol) -> Expr:
        """Leibniz's rule."""
        f, s, a, b = self.args
        at_ends = f.xreplace({s: b}) * b.diff(symbol) - f.xreplace({s: a}) * a.diff(symbol)
        inside = f.diff(symbol)
        return at_ends if inside == 0 else at_ends + DefiniteIntegral(inside, s, a, b)


def integral(integrand: Expr, variable: Symbol, start: Expr, end: Expr) -> Expr:
    """The integral by a variable, which may stand in its own limit: F(x) = integral to x."""
    inner = Symbol(variable.name + _MARK, **variable.assumptions0)
    return DefiniteIntegral(integrand.xreplace({variable: inner}), inner, start, end)


def written_arguments(node: Expr) -> tuple[Expr, ...]:
    """The arguments of a function; of an integral with a variable that the grammar can name."""
    if not isinstance(node, DefiniteIntegral):
        return tuple(node.args)
    integrand, inner, start, end = node.args
    for name in (inner.name.rstrip(_MARK), "t"):
        variable = Symbol(name, **inner.assumptions0)
        if variable not in integrand.free_symbols:
            return integrand.xreplace({inner: variable}), variable, start, end
    raise TypeError(f"no name for the variable of {node!r}")
