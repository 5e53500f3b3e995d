"""Elementary antiderivatives of the formulas that mechanics has, each verified.

Derivatives of unspecified functions are integrated by parts until none is left; powers,
and polynomials times exp, sin, cos, sinh, cosh of linear arguments, go term by term; of
rational functions the rational part comes first; the rest is left to SymPy's rules.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import sympy
from sympy import Add, Expr, Mul, Pow, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra.build import ELEMENTARY, free_of, unspecified
from lagcli.algebra.simplification import is_zero
from lagcli.platform.effort import OutOfWork
from lagcli.platform.limited import limited

_MOST_PARTS = 60
_LONGEST = 1000  # operations while integrating by parts
_MOST_RULES = 60  # integrands; what succeeded in the library took 23
_MOST_TERMS = 3  # of a sum that has no antiderivative as a whole
# One rule may take minutes: 85 s on a sum with sqrt(1 + x^2 + y^2), which then had none.
_UNITS, _SECONDS = 2e6, 8.0


def antiderivative(expression: Expr, variable: Symbol, *, rules: bool = True) -> Expr | None:
    """An F with dF/dvariable = expression, or None where none was found.

    Without `rules` only what goes term by term is integrated, which takes little time.

    Parameters of a formula are general: the integral of t^n is t^(n+1)/(n+1), that of
    sin(a t) cos(b t) has a - b in a denominator.
    """
    by_parts, rest = _unspecified_by_parts(sympy.expand(expression), variable)
    terms = [by_parts]
    for term in Add.make_args(rest):
        part = _term(term, variable)
        if part is None:
            left = expression if by_parts == 0 else rest
            whole = _of_whole(left, variable) if rules else None
            if whole is None:
                return None
            terms = [by_parts, whole]
            break
        terms.append(part)
    total = Add(*terms)
    return total if is_zero(total.diff(variable) - expression) is True else None


# -- unspecified functions ----------------------------------------------------------------


def _unspecified_by_parts(expression: Expr, x: Symbol) -> tuple[Expr, Expr]:
    """(F, rest) with expression = dF/dx + rest: the highest derivatives first.

    g f_x = (g f)_x - g_x f, and f^k f_x = (f^(k+1)/(k+1))_x; what is subtracted meets the
    other terms of a total derivative and cancels.
    """
    found, rest = sympy.S.Zero, expression
    for _ in range(_MOST_PARTS):
        choices = [
            (_order(factor), term, factor)
            for term in Add.make_args(rest)
            for factor in Mul.make_args(term)
            if isinstance(factor, AppliedUndef) and _integral_of(factor, x) is not None
        ]
        if not choices or sympy.count_ops(rest) > _LONGEST:
            break
        _, term, factor = max(choices, key=lambda choice: choice[0])
        integral = _integral_of(factor, x)
        assert integral is not None
        lowered = integral.func(*integral.args) if isinstance(integral, AppliedUndef) else None
        others = term / factor
        k = sum(
            b.as_base_exp()[1]
            for b in Mul.make_args(others)
            if lowered is not None and b.as_base_exp()[0] == lowered
        )
        part = others * integral / (k + 1)
        found += part
        rest = sympy.expand(rest - part.diff(x))
    return found, rest


def _order(factor: AppliedUndef) -> int:
    return len(getattr(factor.func, "indices", ()))


def _integral_of(factor: AppliedUndef, x: Symbol) -> Expr | None:
    """Integral of U'(a x + b) by x: U(a x + b) / a; of a partial derivative likewise."""
    head = factor.func
    indices = getattr(head, "indices", ())
    within = [i for i, a in enumerate(factor.args, start=1) if not free_of(a, [x])]
    if len(within) != 1 or within[0] not in indices:
        return None
    slope = factor.args[within[0] - 1].diff(x)
    if not free_of(slope, [x]):
        return None
    lowered = list(indices)
    lowered.remove(within[0])
    return unspecified(head.base_name, head.arity, tuple(lowered))(*factor.args) / slope


# -- elementary functions -----------------------------------------------------------------


def _term(term: Expr, x: Symbol) -> Expr | None:
    constant, function = term.as_independent(x, as_Add=False)
    if function == 1:
        return constant * x
    power, others = sympy.S.Zero, []
    for factor in Mul.make_args(function):
        base, exponent = factor.as_base_exp()
        if base == x and free_of(exponent, [x]):
            power += exponent
        else:
            others.append(factor)
    if not others:
        if power == -1:
            return constant * sympy.log(x if x.is_positive else sympy.Abs(x))
        return constant * x ** (power + 1) / (power + 1)
    u = sympy.Dummy("u", real=True)
    of_log = Mul(*others).xreplace({sympy.log(x): u})
    if u in of_log.free_symbols and free_of(of_log, [x]):
        # x^n f(log(x)) dx = exp((n + 1) u) f(u) du
        found = antiderivative(sympy.exp(sympy.expand((power + 1) * u)) * of_log, u, rules=False)
        return None if found is None else constant * _at_log(found, u, x)
    if not (power.is_Integer and power >= 0):
        return None
    powers = [f for f in others if isinstance(f, sympy.exp)]
    waves = [f for f in others if f not in powers]
    wave = Mul(*others)
    if _are_waves(waves, x):
        growth = sympy.exp(Add(*(f.args[0] for f in powers)))
        wave = Add(*(growth * f for f in Add.make_args(_summed(Mul(*waves)))))
    parts = [_by_parts(constant, int(power), factor, x) for factor in Add.make_args(wave)]
    return None if any(part is None for part in parts) else Add(*parts)


def _at_log(f: Expr, u: Symbol, x: Symbol) -> Expr:
    """With u = log(x), and exp(c u) as x^c."""
    f = f.replace(
        lambda e: isinstance(e, sympy.exp) and free_of(e.args[0].diff(u), [u]),
        lambda e: x ** e.args[0].diff(u) * sympy.exp(e.args[0].xreplace({u: sympy.S.Zero})),
    )
    return f.xreplace({u: sympy.log(x)})


def _are_waves(factors: list[Expr], x: Symbol) -> bool:
    bases = [factor.as_base_exp() for factor in factors]
    return all(
        isinstance(base, sympy.sin | sympy.cos)
        and exponent.is_Integer
        and exponent > 0
        and free_of(base.args[0].diff(x), [x])
        for base, exponent in bases
    )


def _by_parts(constant: Expr, power: int, factor: Expr, x: Symbol) -> Expr | None:
    """Integral of x^n f(a x + b): repeated integration of f, tabular by parts."""
    total, polynomial, integral, sign = sympy.S.Zero, x**power, factor, 1
    while polynomial != 0:
        steps = [_of_elementary(term, x) for term in Add.make_args(integral)]
        if any(step is None for step in steps):
            return None
        integral = Add(*steps)
        total += sign * polynomial * integral
        polynomial, sign = polynomial.diff(x), -sign
    return constant * total


#: Of functions of x by x.
_INTEGRALS: dict[type[Expr], Callable[[Expr], Expr]] = {
    sympy.exp: sympy.exp,
    sympy.cos: sympy.sin,
    sympy.sin: lambda u: -sympy.cos(u),
    sympy.cosh: sympy.sinh,
    sympy.sinh: sympy.cosh,
}


def _of_elementary(factor: Expr, x: Symbol) -> Expr | None:
    """Of exp, sin, cos, sinh, cosh, a root of an argument linear in x, or exp times a wave."""
    constant, function = factor.as_independent(x, as_Add=False)
    if function == 1:
        return factor * x
    base, exponent = function.as_base_exp()
    if function.is_Mul and len(function.args) == 2:
        return _of_growing_wave(constant, function, x)
    if exponent.is_Rational and exponent not in (-1, 1):
        argument, integral = base, base ** (exponent + 1) / (exponent + 1)
    elif (rule := _INTEGRALS.get(function.func)) is not None:
        argument = function.args[0]
        integral = rule(argument)
    else:
        return None
    slope = argument.diff(x)
    if slope == 0 or not free_of(slope, [x]):
        return None
    return constant * integral / slope


def _of_growing_wave(constant: Expr, function: Expr, x: Symbol) -> Expr | None:
    """Of exp(a x) f, f'' = -b^2 f: exp(a x) (a f - f')/(a^2 + b^2), as a sum."""
    growth, f = sorted(function.args, key=lambda e: not isinstance(e, sympy.exp))
    if not (isinstance(growth, sympy.exp) and isinstance(f, sympy.sin | sympy.cos)):
        return None
    a, b = growth.args[0].diff(x), f.args[0].diff(x)
    if not free_of(a, [x]) or not free_of(b, [x]):
        return None
    constant *= growth / (a**2 + b**2)
    return constant * a * f - constant * f.diff(x)


def _of_whole(expression: Expr, x: Symbol) -> Expr | None:
    """By Hermite's reduction of a rational function, then by rules, or by rules for each term."""
    rational, rest = _reduced(expression, x)
    parts = [_term(rest, x) if rest != 0 else rest]
    if parts == [None]:
        parts = [_by_rules(rest, x)]
    terms = Add.make_args(sympy.expand(rest))
    if parts == [None] and 1 < len(terms) <= _MOST_TERMS:
        parts = [_by_rules(term, x) for term in terms]
    return None if any(part is None for part in parts) else Add(rational, *parts)


def _by_rules(expression: Expr, x: Symbol) -> Expr | None:
    """SymPy's table of rules, on formulas short enough for it."""
    from sympy.integrals import manualintegrate

    # a sum with radicals branches without end: 33 operations took 47 s
    radicals = any(power.exp.is_Rational and power.exp.q > 1 for power in expression.atoms(Pow))
    if expression.atoms(AppliedUndef) or sympy.count_ops(expression) > (20 if radicals else 100):
        return None
    try:
        with _at_most(_MOST_RULES):
            result = limited(
                lambda: manualintegrate.manualintegrate(expression, x), _UNITS, _SECONDS
            )
    except (NotImplementedError, ValueError, RecursionError, OutOfWork):
        return None
    known = all(type(f) in ELEMENTARY for f in result.atoms(sympy.Function))
    return result if known and not result.has(sympy.Integral) else None


def _reduced(expression: Expr, x: Symbol) -> tuple[Expr, Expr]:
    """(R, h) with expression = R' + h; of a rational function h has simple poles.

    Hermite: R is all of its antiderivative except the logarithms and arctangents, those of h.
    """
    from sympy.integrals.rationaltools import ratint_ratpart

    def reduced() -> tuple[Expr, Expr]:
        above, below = sympy.fraction(sympy.cancel(sympy.together(expression)))
        whole, above = sympy.div(above, below, x)
        rational, rest = ratint_ratpart(above, below, x)
        return sympy.integrate(whole, x) + rational, sympy.apart(rest, x)

    unchanged = sympy.S.Zero, expression
    if expression.atoms(AppliedUndef) or not expression.is_rational_function(x):
        return unchanged
    try:
        rational, rest = limited(reduced, _UNITS, _SECONDS)
    except (NotImplementedError, sympy.PolynomialError, OutOfWork):
        return unchanged
    return unchanged if rational == 0 else (rational, rest)


@contextmanager
def _at_most(count: int) -> Iterator[None]:
    """Let the rules be tried on a number of integrands; then NotImplementedError."""
    from sympy.integrals import manualintegrate

    steps, tried = manualintegrate.integral_steps, 0

    def counted(*arguments: Any, **options: Any) -> Any:
        nonlocal tried
        tried += 1
        if tried > count:
            raise NotImplementedError
        return steps(*arguments, **options)

    manualintegrate.integral_steps = counted
    try:
        yield
    finally:
        manualintegrate.integral_steps = steps
        manualintegrate._integral_cache.clear()  # noqa: SLF001 - marks of what was under way


def _summed(waves: Expr) -> Expr:
    """A product of sines and cosines as a sum of them."""
    from sympy.simplify.fu import TR8

    return sympy.expand(TR8(waves))
