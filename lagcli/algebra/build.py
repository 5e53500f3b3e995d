"""From the reader's trees to SymPy objects, built node by node: no text is ever run.

Every quantity is a plain real symbol named as the grammar writes it: `x`, its velocity
`x'`, its acceleration `x''`, a multiplier `lambda_rod`, a momentum `p_x`.  An
unspecified function is an applied function `U(r)`; its derivatives are functions of
their own, `U'(r)` or `diff(Phi, 1, 2)(a, b)`, so no unevaluated derivative ever occurs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import Any

import sympy
from sympy import Expr, Rational, Symbol
from sympy.core.function import AppliedUndef, ArgumentIndexError, UndefinedFunction

from lagcli.algebra.integral import integral
from lagcli.expression import (
    FUNCTIONS,
    Call,
    Diff,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
)

TIME = Symbol("t", real=True)

#: The functions that return after a turn.
CIRCULAR = (sympy.sin, sympy.cos, sympy.tan, sympy.cot, sympy.sec, sympy.csc)
HYPERBOLIC = (sympy.sinh, sympy.cosh, sympy.tanh, sympy.coth)

_SYMPY_FUNCTIONS: dict[str, Callable[..., Expr]] = {
    **{name: getattr(sympy, {"abs": "Abs"}.get(name, name)) for name in FUNCTIONS},
    "integral": integral,
}

#: The functions that an answer may hold.
ELEMENTARY = frozenset(_SYMPY_FUNCTIONS.values())

_ASSUMPTIONS: dict[str, dict[str, bool]] = {
    "real": {"real": True},
    "positive": {"positive": True},
    "nonnegative": {"nonnegative": True},
    "nonzero": {"real": True, "nonzero": True},
    "negative": {"negative": True},
}


def symbol(name: str, assume: str = "real", *, integer: bool = False) -> Symbol:
    """The SymPy symbol of a quantity with what the file assumes of it."""
    assumptions = dict(_ASSUMPTIONS[assume])
    if integer:
        assumptions["integer"] = True
    return Symbol(name, **assumptions)


def _derivative_name(name: str, arity: int, indices: tuple[int, ...]) -> str:
    if not indices:
        return name
    if arity == 1:
        return name + "'" * len(indices)
    return f"diff({name}, {', '.join(map(str, indices))})"


@cache
def unspecified(name: str, arity: int, indices: tuple[int, ...] = ()) -> UndefinedFunction:
    """An unspecified function, or its partial derivative by the arguments `indices` (from 1)."""

    def fdiff(self: AppliedUndef, argindex: int = 1) -> Expr:
        if not 1 <= argindex <= arity:
            raise ArgumentIndexError(self, argindex)
        raised = tuple(sorted((*indices, argindex)))
        return unspecified(name, arity, raised)(*self.args)

    members = {"fdiff": fdiff, "base_name": name, "arity": arity, "indices": indices}
    return UndefinedFunction(_derivative_name(name, arity, indices), __dict__=members, real=True)


class Builder:
    """Turns trees into SymPy expressions, given what each name stands for.

    Parameters
    ----------
    names
        Name without primes -> its expression: a symbol, or a definition's formula.
    functions
        Unspecified function -> number of its arguments.
    derivative
        The total time derivative, for a prime on a name.
    refused
        The exception for a node that has no real value, such as sqrt(-1).
    """

    def __init__(
        self,
        names: Mapping[str, Expr],
        functions: Mapping[str, int],
        derivative: Callable[[Expr], Expr],
        refused: Callable[[Expression], Exception] = ArithmeticError,
    ) -> None:
        self.names = dict(names)
        self.functions = dict(functions)
        self._refused = refused
        self._derivative = derivative

    def knowing(self, names: Mapping[str, Expr]) -> Builder:
        """The same for formulas with other names beside these."""
        return Builder({**self.names, **names}, self.functions, self._derivative, self._refused)

    def __call__(self, node: Expression) -> Expr:
        """The SymPy expression of a tree."""
        match node:
            case Number(value=value):
                return Rational(value.numerator, value.denominator)
            case Name(name=name, primes=primes):
                return self._name(name, primes)
            case Negative(operand=operand):
                return -self(operand)
            case Sum(terms=terms):
                return sympy.Add(*map(self, terms))
            case Product(factors=factors):
                return sympy.Mul(*map(self, factors))
            case Quotient(numerator=numerator, denominator=denominator):
                return self._real(node, self(numerator) / self(denominator))
            case Power(base=base, exponent=exponent):
                return self._real(node, sympy.Pow(self(base), self(exponent)))
            case Call(function=function, arguments=arguments, primes=primes):
                value = self._call(function, [self(a) for a in arguments], (1,) * primes)
                return self._real(node, value)
            case PartialCall(function=function, indices=indices, arguments=arguments):
                return self._call(function, [self(a) for a in arguments], tuple(sorted(indices)))
            case Diff(operand=operand, variable=variable):
                return without_jumps(self(operand).diff(self._name(variable.name, variable.primes)))
        raise TypeError(f"not an expression: {node!r}")

    def _real(self, node: Expression, value: Expr) -> Expr:
        unreal = value.is_number and value.is_extended_real is False
        if unreal or value.has(sympy.I, sympy.zoo, sympy.nan):
            raise self._refused(node)
        return value

    def _name(self, name: str, primes: int) -> Expr:
        if name == "pi":
            return sympy.pi
        if name == "t":
            return TIME
        value = self.names[name]
        for _ in range(primes):
            value = self._derivative(value)
        return value

    def _call(self, function: str, arguments: list[Expr], indices: tuple[int, ...]) -> Expr:
        if function in self.functions:
            return unspecified(function, self.functions[function], indices)(*arguments)
        return _SYMPY_FUNCTIONS[function](*arguments)


#: What SymPy's derivatives of |u| and sign(u) hold where it does not know u to be real.
UNREAL = (sympy.Derivative, sympy.re, sympy.im, sympy.conjugate)


def without_jumps(expression: Expr) -> Expr:
    """A derivative by SymPy beside the places where a sign changes: that of the sign is 0 there.

    All is real, though SymPy does not know it of x/y, x^n and log(cos(x)^2).
    """
    if not expression.has(sympy.DiracDelta, *UNREAL):
        return expression
    real = expression.replace(sympy.im, lambda _: sympy.S.Zero)
    for function in (sympy.re, sympy.conjugate):
        real = real.replace(function, lambda u: u)
    real = real.replace(_is_jump, lambda _: sympy.S.Zero)
    return real.doit() if real.has(sympy.Derivative) else real


def _is_jump(node: Expr) -> bool:
    """Whether it is the derivative of a sign; SymPy leaves that of sign(x/y) as it is."""
    if isinstance(node, sympy.Derivative):
        return isinstance(node.expr, sympy.sign)
    return isinstance(node, sympy.DiracDelta)


def free_of(expression: Expr, symbols: Iterable[Symbol]) -> bool:
    """Whether none of the symbols occurs."""
    return not (expression.free_symbols & set(symbols))


def as_expr(value: Any) -> Expr:
    """A SymPy number for a Python int, anything else unchanged."""
    return sympy.Integer(value) if isinstance(value, int) else value
