"""The boundary term of a point symmetry: G(t, q) with dG/dt = K, by undetermined coefficients.

K is linear in the velocities, K = G,t + sum G,q_i q_i'.  Each term of G,q_i suggests that
term times q_i; each term of G,t suggests the finitely many functions that its derivatives
by t are made of (t^n, exp, sin, cos of linear arguments are closed under d/dt).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations_with_replacement

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.place import NO_VALUE
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.relation import with_gradient
from lagcli.mechanics.discovery.tree import Tree
from lagcli.mechanics.system import System
from lagcli.mechanics.total_derivative import boundary_integral, boundary_term, euler_operator

_MOST_CANDIDATES = 120  # measured: up to 243
_POINTS = 3  # modulo a prime of 61 bits: one would do, unless it lies on a root
_OF_DERIVATIVE = 3000  # units of work of SymPy
_OF_EXPANSION = 100_000
_OF_TIME = (sympy.exp, sympy.sin, sympy.cos, sympy.sinh, sympy.cosh)


def gauge_of(
    change: Expr, system: System, allowed: Allowance, lengths: Sequence[Expr] = ()
) -> Expr | None:
    """G with dG/dt = change, or None where none was found; that of a boost has the `lengths` X."""
    t, q, v = system.t, system.q, system.qdot
    if _vanishes(change, (t, *q, *v, *system.qddot), allowed):
        return sympy.S.Zero
    allowed.spend(_OF_EXPANSION * len(q))
    still = dict.fromkeys(v, sympy.S.Zero)
    if change.xreplace(still).has(*NO_VALUE):  # (x'^2 + y'^2)^(-1/3) may cancel
        change = simplify(change)
    by_q = [sympy.expand(change.diff(x).xreplace(still)) for x in v]
    by_t = sympy.expand(change.xreplace(still))
    if any(p.exp.is_negative and p.base.is_Add for p in by_t.atoms(sympy.Pow)):
        by_t = sympy.expand(simplify(by_t))  # b/r^2 may cancel, in terms x^2 b/r^4 it does not
    candidates = _candidates(by_t, by_q, t, q)
    times = {term.as_independent(*q, as_Add=False)[0].as_independent(t)[1]
             for slope in by_q for term in sympy.Add.make_args(slope) if lengths}  # fmt: skip
    products = [X * Y for X, Y in combinations_with_replacement(lengths, 2)]
    candidates += [T * X for T in sorted(times, key=str) for X in (*lengths, *products)]
    allowed.spend(_OF_DERIVATIVE * (1 + len(q)) * len(candidates))
    if 0 < len(candidates) <= _MOST_CANDIDATES:
        found = with_gradient([by_t, *by_q], candidates, (t, *q), allowed)
        if found is not None:
            return simplify(found)
    change = simplify(change)
    timed = any(not free_of(f, [t]) for f in change.atoms(*_OF_TIME))
    found = None if timed else boundary_term(change, system)
    if found is None and all(is_zero(e) is True for e in euler_operator(change, system)):
        return boundary_integral(change, system)
    return found


def _vanishes(change: Expr, variables: Sequence[Symbol], allowed: Allowance) -> bool:
    """Whether it is 0 modulo a prime at some points: the charge is proved afterwards."""
    if change == 0:
        return True
    try:
        return not any(map(any, Tree([change], variables, allowed).rows([[change]], _POINTS)))
    except (NoPoint, ZeroDivisionError):
        return is_zero(change) is True


def _candidates(by_t: Expr, by_q: Sequence[Expr], t: Symbol, q: Sequence[Symbol]) -> list[Expr]:
    found = {x * term: None for x, slope in zip(q, by_q, strict=True)
             for term in _functions(slope, t, q)}  # fmt: skip
    for x, slope in zip(q, by_q, strict=True):  # exp(x) is its own integral, cos(x) that of -sin(x)
        terms = (term for term in _functions(slope, t, q) if not _is_power(term, x))
        found |= {f: None for term in terms for f in _functions(term.diff(x), t, q)}
    by_slopes = list(found)
    left = list(_functions(by_t, t, q))
    seen: set[Expr] = set()
    made: set[Expr] = set()
    while left and len(seen) <= _MOST_CANDIDATES:
        term = left.pop()
        if term in seen:
            continue
        seen.add(term)
        if _divides_by(term, t):  # no derivative of it brings one back
            continue
        left += _functions(sympy.expand(term.diff(t)), t, q)
        # the integral of t log(u) has t log(u), and t where u is linear
        left += [term / f for f in term.atoms(sympy.log) if not free_of(f, [t])]
        if not term.has(*_OF_TIME) or free_of(term, [t]):
            made.add(t * term)
        else:
            made |= _means(term, t)
    found.update(dict.fromkeys(sorted(seen | made, key=sympy.default_sort_key)))
    found.pop(sympy.S.One, None)
    # products of many sines and cosines of t have too many derivatives; G = x G,x + f(t)
    return list(found) if len(found) <= _MOST_CANDIDATES else by_slopes


def _is_power(term: Expr, x: Symbol) -> bool:
    """Whether it has none of the functions of x that are closed under d/dx."""
    return all(free_of(f, [x]) for f in term.atoms(*_OF_TIME))


def _means(term: Expr, t: Symbol) -> set[Expr]:
    """T f for f sin^k cos^l(w t), which has a mean: at resonance a charge grows with the time."""
    waves = {f for f in term.atoms(sympy.sin, sympy.cos) if t in f.free_symbols}
    still = term.xreplace(dict.fromkeys(waves, sympy.S.One))
    return {t * still} if waves and still.is_polynomial(t) else set()


def _divides_by(term: Expr, t: Symbol) -> bool:
    """Whether the time stands in a denominator, as in 1/(x + a t²)."""
    return any(p.exp.is_negative and p.base.has(t) for p in term.atoms(sympy.Pow))


def _functions(expression: Expr, t: Symbol, q: Iterable[Symbol]) -> list[Expr]:
    """The terms without their constant factors."""
    return [
        term.as_independent(t, *q, as_Add=False)[1]
        for term in sympy.Add.make_args(expression)
        if term != 0
    ]
