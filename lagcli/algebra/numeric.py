"""Numbers for SymPy expressions with mpmath, at any number of digits.

A list of expressions is compiled once to a plan in which equal parts are computed once;
the plan is a flat list of operations, run at as many points as wanted.  Unspecified
functions stand for concrete smooth ones whose derivatives agree with each other.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from functools import cache, reduce
from math import prod
from operator import add, mul
from typing import Any

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra.build import UNREAL, without_jumps
from lagcli.algebra.integral import DefiniteIntegral
from lagcli.expression import FUNCTIONS

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(mpmath, name) for name in FUNCTIONS if hasattr(mpmath, name)},
    "coth": mpmath.coth,
    "Abs": mpmath.fabs,
}


#: Decimal digits of the numbers that decide whether something is 0: of its terms rounding leaves
#: some 1e-48, and each threshold lies between that and what was measured of those that are not 0.
DIGITS = 50
#: Where double roots are told from two: a double root is known to half of the digits.
FINE_DIGITS = 90
_SAMPLES = 12  # states that are drawn: 6 real ones are enough, 2 where there is no modulus
#: Binary digits before the point beyond which a function takes all memory: of the exponent of
#: exp(x), of the multiples of pi in x.
_LARGEST = dict.fromkeys(("exp", "sinh", "cosh", "tanh", "coth"), 64)
_LARGEST |= dict.fromkeys(("sin", "cos", "tan", "cot", "sec", "csc"), 4096)


class ConcreteFunction:
    """f(x_1, …, x_n) = 2 + sum_k a_k prod_j exp(b_kj x_j), and its partial derivatives.

    The coefficients follow from the name, so that U, U' and U'' belong to one function;
    it is positive and increasing in every argument.
    """

    def __init__(self, name: str, arity: int) -> None:
        source = random.Random(f"lagcli {name}/{arity}")
        self._terms = [
            (source.randint(200, 900), [source.randint(150, 800) for _ in range(arity)])
            for _ in range(3)
        ]

    def __call__(self, arguments: Sequence[Any], indices: Sequence[int] = ()) -> Any:
        """The partial derivative by the arguments `indices` (from 1) at a point."""
        total = mpf(0) if indices else mpf(2)
        for weight, rates in self._terms:
            exponent = sum(mpf(r) * x for r, x in zip(rates, arguments, strict=True)) / 1000
            factor = prod(rates[i - 1] for i in indices) / mpf(1000) ** len(indices)
            total += mpf(weight) / 1000 * factor * mpmath.exp(exponent)
        return total


@cache
def concrete_function(name: str, arity: int) -> ConcreteFunction:
    """The concrete function that stands for an unspecified one."""
    return ConcreteFunction(name, arity)


class Evaluator:
    """A plan for the values of several expressions.

    Parameters
    ----------
    expressions
        What to evaluate; common parts are computed once.
    digits
        Decimal digits of the arithmetic.
    functions
        Concrete functions for unspecified ones, name -> f(arguments, indices), where
        `indices` are the arguments (from 1) it is differentiated by.

    Examples
    --------
    >>> x = Symbol("x")
    >>> Evaluator([x**2, sympy.sin(x)])({x: mpf(0)})
    [mpf('0.0'), mpf('0.0')]
    """

    def __init__(
        self,
        expressions: Sequence[Expr],
        digits: int = DIGITS,
        functions: Mapping[str, Callable[..., Any]] | None = None,
    ) -> None:
        self.digits = digits
        self._functions = functions or {}
        self._slots: dict[Expr, int] = {}
        self._symbols: list[tuple[Symbol, int]] = []
        self._constants: list[tuple[Expr, int]] = []
        self._plan: list[tuple[int, Callable[[list[Any]], Any], list[int]]] = []
        self._results = [self._slot(e) for e in expressions]

    def __call__(self, values: Mapping[Symbol, Any]) -> list[Any]:
        """The values at a point; KeyError for a symbol without a value.

        Raises
        ------
        ArithmeticError, ValueError
            Where an expression is not defined, as 1/0 or log(0).
        """
        with mpmath.workdps(self.digits):
            slots: list[Any] = [None] * len(self._slots)
            for symbol, slot in self._symbols:
                slots[slot] = mpmath.mpmathify(values[symbol])
            for constant, slot in self._constants:
                slots[slot] = _constant(constant)
            for slot, operation, sources in self._plan:
                slots[slot] = operation([slots[i] for i in sources])
            return [slots[i] for i in self._results]

    def where_defined(self, values: Mapping[Symbol, Any]) -> list[Any] | None:
        """The values at a point; None where an expression has none."""
        try:
            return self(values)
        except (ArithmeticError, ValueError):
            return None

    def _slot(self, root: Expr) -> int:
        """The slot of an expression, with all that it needs planned before it."""
        stack = [(root, False)]
        while stack:
            node, ready = stack.pop()
            if node in self._slots:
                continue
            if not node.args:
                self._slots[node] = len(self._slots)
                pairs: list[Any] = self._symbols if node.is_Symbol else self._constants
                pairs.append((node, self._slots[node]))
            elif ready:
                operation, parts = self._operation(node)
                sources = [self._slots[part] for part in parts]
                self._slots[node] = len(self._slots)
                self._plan.append((self._slots[node], operation, sources))
            else:
                stack.append((node, True))
                _, parts = self._operation(node)
                stack.extend((part, False) for part in reversed(parts))
        return self._slots[root]

    def _operation(self, node: Expr) -> tuple[Callable[[list[Any]], Any], tuple[Expr, ...]]:
        if node.is_Add:
            return (lambda v: reduce(add, v)), node.args
        if node.is_Mul:
            return (lambda v: reduce(mul, v)), node.args
        if node.is_Pow:
            if node.exp.is_Integer:
                exponent = int(node.exp)
                return (lambda v: v[0] ** exponent), (node.base,)
            if node.exp == sympy.S.Half:
                return (lambda v: mpmath.sqrt(v[0])), (node.base,)
            return (lambda v: mpmath.power(v[0], v[1])), (node.base, node.exp)
        if isinstance(node, AppliedUndef):
            kind = type(node)
            base = getattr(kind, "base_name", kind.__name__)
            indices = getattr(kind, "indices", ())
            concrete = self._functions.get(base) or concrete_function(base, len(node.args))
            return (lambda v: concrete(v, indices)), node.args
        if isinstance(node, DefiniteIntegral):
            return self._quadrature(node)
        if isinstance(node, (sympy.DiracDelta, *UNREAL)):
            return (lambda v: v[0]), (without_jumps(node),)
        name = type(node).__name__
        function = _FUNCTIONS.get(name)
        if function is None:
            raise TypeError(f"no numeric value for {node!r}")
        largest = _LARGEST.get(name)
        if largest is not None:
            return (lambda v: function(_bounded(v[0], largest))), node.args
        return (lambda v: function(*v)), node.args

    def _quadrature(
        self, node: DefiniteIntegral
    ) -> tuple[Callable[[list[Any]], Any], tuple[Expr, ...]]:
        """By tanh-sinh or Gauss's rule of mpmath, at the precision that is set."""
        integrand, variable, start, end = node.args
        others = sorted(integrand.free_symbols - {variable}, key=lambda s: s.name)
        inner = Evaluator([integrand], self.digits, self._functions)

        def value(v: list[Any]) -> Any:
            given = dict(zip(others, v[2:], strict=True))
            return mpmath.quad(lambda x: inner({**given, variable: x})[0], [v[0], v[1]])

        return value, (start, end, *others)


def _bounded(x: Any, largest: int) -> Any:
    if mpmath.mag(x) > largest:
        raise OverflowError
    return x


def _constant(node: Expr) -> Any:
    if node.is_Rational:
        return mpf(int(node.p)) / int(node.q)
    if node is sympy.pi:
        return +mpmath.pi
    if node is sympy.E:
        return +mpmath.e
    if node is sympy.I:
        return mpmath.mpc(0, 1)
    if node.is_Float:
        return mpf(str(node))
    raise ZeroDivisionError(f"no finite value for {node!r}")


def with_assumed_sign(
    source: random.Random, symbol: Symbol, size: mpf, positive: float = 0.5
) -> mpf:
    """The size with the sign of the symbol; with this chance it is positive where none is known."""
    if symbol.is_negative:
        return -size
    return size if symbol.is_nonnegative or source.random() < positive else -size


def vanishes_at_random(expression: Expr) -> bool:
    """Whether `zero_at_random` says so."""
    return zero_at_random(expression) is True


def zero_at_random(expression: Expr) -> bool | None:
    """Whether an expression is 0 at random values of its symbols; None where it is not real.

    To 25 digits beside its terms, or to 9 where it has a rounded number in it.  Moduli and signs
    are tried with letters of both signs.
    """
    source, both = random.Random("values"), expression.has(sympy.Abs, sympy.sign)
    symbols = sorted(expression.free_symbols, key=lambda s: s.name)
    evaluator = Evaluator(sympy.Add.make_args(expression))
    decimals = any(len(str(r.q)) > 7 for r in expression.atoms(sympy.Rational))
    found: list[bool] = []
    for _ in range(_SAMPLES):
        sizes = {s: mpf(source.randint(100, 3000)) / 1009 for s in symbols}
        chance = 0.5 if both else 1
        values = {s: with_assumed_sign(source, s, v, chance) for s, v in sizes.items()}
        try:
            parts = evaluator(values)
        except (ArithmeticError, ValueError, TypeError):
            continue
        if not all(isinstance(part, mpf) and mpmath.isfinite(part) for part in parts):
            continue
        with mpmath.workdps(DIGITS):
            scale = max(mpf(1), *map(abs, parts))
            found.append(abs(sum(parts)) < scale * mpf(10) ** (-9 if decimals else -25))
        if not found[-1] or len(found) == ((6 if both else 2) if symbols else 1):
            break
    return all(found) if found else None
