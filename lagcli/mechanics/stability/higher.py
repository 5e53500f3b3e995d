"""A potential of one coordinate whose second derivative vanishes: the next ones decide.

A strict minimum, where the first derivative that does not vanish is of even order and positive, is
stable (Lagrange and Dirichlet).  Elsewhere the force drives the system away on one side, so it is
unstable, with damping, too.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 21.
Merkin, *Introduction to the Theory of Stability*, section 3.3.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import solve_for
from lagcli.algebra.factors import factors_of
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of
from lagcli.mechanics.rest.linearization import Linearization

#: Of the potential; a higher one is taken only where all up to it are 0, as of x^8 and x^20.
HIGHEST, _HIGHEST_OF_ALL = 6, 24


def potential_derivatives(linear: Linearization) -> list[Expr]:
    """V'', V''', … there, of a system with one coordinate and no constraints; empty of others.

    Empty at a corner of V as well, and at one of its derivatives: |x|³ has one at 0.  Where any
    place is one of rest at some momenta, these are put in after the derivatives.
    """
    if len(linear.system.q) != 1 or linear.dynamics.constraints.equations:
        return []
    [q], [force], point = linear.system.q, linear.forces_at_rest, linear.point
    if bent_there(linear) or (point.free and not any(p.has(q) for p in point.values.values())):
        return []
    found: list[Expr] = []
    while len(found) < HIGHEST - 1 or (found[-1] == 0 and len(found) < _HIGHEST_OF_ALL - 1):
        force = force.diff(q)
        found.append(simplify(-at(force, linear.point.values)))
    return found


def bent_there(linear: Linearization) -> bool:
    """Whether a modulus or a sign in the forces may change there: V has not all derivatives."""
    bent = {n for f in linear.forces_at_rest for n in f.atoms(sympy.Abs, sympy.sign)}
    return any(is_zero(at(n.args[0], linear.point.values)) is not False for n in bent)


def order_of_minimum(derivatives: Sequence[Expr], positive: Sequence[Expr]) -> int | None:
    """The order of the first derivative that is not 0, negative where there is no minimum.

    An even one is that of a maximum then.  The first of the derivatives is the second one.  None
    where it is not known.
    """
    for order, derivative in enumerate(derivatives, 2):
        sign = sign_of(derivative, positive)
        if sign is None:
            odd = order % 2 and sign_of(derivative**2, positive) == 1
            return -order if odd else None
        if sign:
            return order if sign == 1 and order % 2 == 0 else -order
    return None


def order_at_critical_values(
    derivatives: Sequence[Expr],
    positive: Sequence[Expr],
    is_free: Callable[[Mapping[Symbol, Expr]], bool] = lambda _: False,
    mass: Expr = S.One,
) -> int | None:
    """The same where a condition makes the second derivative vanish: one symbol is solved for.

    0 where no force acts anywhere then (`is_free`), unless the `mass` vanishes.  Of a product
    only one factor may vanish where it is there at all: others would vanish at other values.
    """
    curvature = _open_factor(derivatives[0], positive) if derivatives else None
    for symbol in sorted(curvature.free_symbols, key=str) if curvature is not None else ():
        roots = solve_for(curvature, symbol)
        if roots is None or len(roots.values) != 1 or not free_of(roots.values[0], [symbol]):
            continue
        [root] = roots.values
        known = [root] if symbol.is_positive else []
        if {sign_of(x, positive) for x in known} & {0, -1}:
            continue
        there, others, inertia = (
            [each.xreplace({symbol: root}) for each in group]
            for group in (positive, derivatives, [mass])
        )
        if any(e.has(S.ComplexInfinity, S.NaN, S.Infinity) for e in (*there, *others, *inertia)):
            continue  # the place goes to infinity
        if {sign_of(p, positive) for p in there} & {0, -1} or is_zero(inertia[0]) is not False:
            continue
        if is_free({symbol: root}):
            return 0
        order = order_of_minimum([simplify(each) for each in others], [*there, *known])
        if order is not None:
            return order
    return None


def _open_factor(expression: Expr, positive: Sequence[Expr]) -> Expr | None:
    """The one factor without a known sign, to its first power; None of several."""
    pairs = factors_of(simplify(expression))
    found = [f for f, _ in pairs if f.free_symbols and not sign_of(f, positive)]
    return found[0] if len(found) == 1 else None
