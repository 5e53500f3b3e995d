"""Is K(t, q, q', q'') a total time derivative dG/dt, and of what G?

If K = dG(t, q, q')/dt then K is linear in q'' with coefficients dG/dq', what is left is
linear in q' with coefficients dG/dq, and the rest is dG/dt: G is found by integrating one
variable after the other and subtracting.  K is no total derivative when something is left.
"""

from __future__ import annotations

import sympy
from sympy import Add, Expr, Mul, Pow, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import TIME, free_of, unspecified
from lagcli.mechanics.system import System


def boundary_term(expression: Expr, system: System) -> Expr | None:
    """G with dG/dt = expression identically, or None where none was found."""
    rest = expression
    found = sympy.S.Zero
    for rates, variables in ((system.qddot, system.qdot), (system.qdot, system.q)):
        waiting = list(zip(rates, variables, strict=True))
        while waiting:
            # any order will do: what cannot be integrated by x is often easy by y
            for rate, variable in waiting:
                part = _part(rest, rate, variable, rates)
                if part is not None:
                    break
            else:
                return None
            waiting.remove((rate, variable))
            if part != 0:
                found += part
                rest = simplify(rest - system.total_derivative(part))
    if is_zero(rest) is True:
        return found
    if not free_of(rest, [*system.q, *system.qdot, *system.qddot]):
        return None
    part = antiderivative(rest, TIME)
    return None if part is None else found + part


def _part(rest: Expr, rate: Symbol, variable: Symbol, rates: tuple[Symbol, ...]) -> Expr | None:
    """The antiderivative by a variable of what multiplies its rate; None where not found."""
    coefficient = rest.diff(rate) if rate in rest.free_symbols else sympy.S.Zero
    if is_zero(coefficient) is True:
        return sympy.S.Zero
    coefficient = simplify(coefficient)
    return None if coefficient.has(*rates) else antiderivative(coefficient, variable)


def antiderivative(expression: Expr, variable: Symbol) -> Expr | None:
    """An elementary antiderivative, verified by differentiation, or None.

    Powers, products of polynomials with exp, sin, cos, sinh, cosh of linear arguments, and
    unspecified derivatives U'(x) are done term by term; the rest is left to SymPy's rules.
    """
    terms = []
    for term in Add.make_args(sympy.expand(expression)):
        part = _term(term, variable)
        if part is None:
            whole = _by_rules(expression, variable)
            return whole if whole is not None and _checks(whole, expression, variable) else None
        terms.append(part)
    total = Add(*terms)
    return total if _checks(total, expression, variable) else None


def _checks(candidate: Expr, expression: Expr, variable: Symbol) -> bool:
    return is_zero(candidate.diff(variable) - expression) is True


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
        return None if power.is_number is False else constant * x ** (power + 1) / (power + 1)
    if len(others) > 1:
        return None
    [factor] = others
    if isinstance(factor, AppliedUndef):
        integral = _of_unspecified(factor, x)
        return constant * integral if integral is not None and power == 0 else None
    if power.is_Integer and power >= 0:
        return _by_parts(constant, int(power), factor, x)
    return None


def _by_parts(constant: Expr, power: int, factor: Expr, x: Symbol) -> Expr | None:
    """Integral of x^n f(a x + b): repeated integration of f, tabular by parts."""
    total, polynomial, integral, sign = sympy.S.Zero, x**power, factor, 1
    while polynomial != 0:
        step = _of_elementary(integral, x)
        if step is None:
            return None
        integral = step
        total += sign * polynomial * integral
        polynomial, sign = polynomial.diff(x), -sign
    return constant * total


def _of_elementary(factor: Expr, x: Symbol) -> Expr | None:
    """Integral of exp, sin, cos, sinh or cosh of an argument linear in x, with a constant."""
    constant, function = factor.as_independent(x, as_Add=False)
    table = {
        sympy.exp: sympy.exp,
        sympy.cos: sympy.sin,
        sympy.sin: lambda u: -sympy.cos(u),
        sympy.cosh: sympy.sinh,
        sympy.sinh: sympy.cosh,
    }
    rule = table.get(function.func)
    if rule is None:
        return None
    argument = function.args[0]
    slope = argument.diff(x)
    if slope == 0 or not free_of(slope, [x]):
        return None
    return constant * rule(argument) / slope


def _of_unspecified(factor: AppliedUndef, x: Symbol) -> Expr | None:
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


def _by_rules(expression: Expr, x: Symbol) -> Expr | None:
    """SymPy's table of rules, on formulas short enough for it."""
    from sympy.integrals.manualintegrate import manualintegrate

    # a sum with radicals branches without end: 33 operations took 47 s
    radicals = any(power.exp.is_Rational and power.exp.q > 1 for power in expression.atoms(Pow))
    if expression.atoms(AppliedUndef) or sympy.count_ops(expression) > (20 if radicals else 100):
        return None
    try:
        result = manualintegrate(expression, x)
    except (NotImplementedError, ValueError, RecursionError):
        return None
    return None if result.has(sympy.Integral) or result.has(sympy.Piecewise) else result
