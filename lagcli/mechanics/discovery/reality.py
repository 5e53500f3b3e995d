"""Where a charge is real and finite: roots and differences of parameters, roots of the time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.factors import factors_of
from lagcli.algebra.positivity import weak_sign
from lagcli.algebra.real_roots import not_negative_where_real
from lagcli.algebra.signs import sign
from lagcli.expression import Expression, Quotient, Sum, walk
from lagcli.mechanics.conditions import conditions
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System
from lagcli.notation.ordering import bases
from lagcli.statements.motions import Above


def real_where(
    charge: NoetherCharge, system: System, values: Sequence[Expr] = ()
) -> tuple[Above, ...]:
    """What must be positive for the transformation, gauge and charge to be real where L is.

    And where special values of the parameters are.

    What is even in sqrt(k) is real for k < 0, too: cos(sqrt(k) t) is then cosh(sqrt(-k) t).
    """
    given, t = charge.transformation, system.t
    formulas = [*given.changes, given.time, charge.charge, charge.gauge or sympy.S.Zero]
    bounds = dict.fromkeys(bound for formula in formulas for bound in _bounds(formula))
    positive = t in bounds
    if positive:  # sqrt(k/t) is then sqrt(k)/sqrt(t)
        formulas = [f.xreplace({t: sympy.Symbol(t.name, positive=True)}) for f in formulas]
        bounds = dict.fromkeys(bound for formula in formulas for bound in _bounds(formula))
    moving = {*system.q, *system.qdot}
    constant = [b for b in bounds if not b.free_symbols & moving and weak_sign(b) != 1]
    constant = [b for b in constant if not all(_is_even(formula, b) for formula in formulas)]
    given_real = [bound for f in (system.L, *values) for bound in not_negative_where_real(f)]
    wanted = [*([t] if positive else []), *sorted(constant, key=_by_length)]
    return conditions(wanted, system.order, given_real)


def finite_where(
    formulas: Iterable[Expression], system: System, values: Sequence[Expr] = ()
) -> tuple[Above, ...]:
    """Where no divisor is 0 that may be so for positive parameters, nor one of L or of values."""
    quotients = (node for tree in formulas for node in walk(tree) if isinstance(node, Quotient))
    sums = dict.fromkeys(b for node in quotients for b in bases(node.denominator))
    divisors = [system.build(each) for each in sums if isinstance(each, Sum)]
    constant = [d for d in divisors if d.free_symbols <= {*system.parameters}]
    positive = {p: sympy.Dummy(positive=True) for p in system.parameters}
    powers = sympy.Tuple(system.L, *values).atoms(sympy.Pow)
    own = {f for p in powers if p.exp.is_negative for f, _ in factors_of(p.base)}
    wanted = [
        f**2 for divisor in constant for f, _ in factors_of(divisor)
        if sign(f) is None and sign(f.xreplace(positive)) is None and not {f, -f} & own
    ]  # fmt: skip
    return conditions(wanted, system.order)


def _bounds(formula: Expr) -> Iterator[Expr]:
    """What must not be negative in roots and logarithms."""
    yield from not_negative_where_real(formula)
    yield from (node.args[0] for node in formula.atoms(sympy.log))


def _is_even(formula: Expr, radicand: Expr) -> bool:
    """Whether the other sign of the square root of the radicand gives the same."""
    roots = (p for p in formula.atoms(sympy.Pow) if p.exp.is_Rational and p.exp.q == 2)
    turned = {p: -p for p in roots if sign(simplify(p.base / radicand)) == 1}
    return is_zero(formula.xreplace(turned) - formula) is True


def _by_length(bound: Expr) -> tuple[int, object]:
    return int(bound.count_ops()), sympy.default_sort_key(bound)
