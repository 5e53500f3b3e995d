"""Where V has no definite second derivatives: its terms of lowest degree decide.

About the equilibrium V is a polynomial in the displacements u and terms of higher degree.  The
displacements w along which the second derivatives are definite are given by the others, z, as
those of the lowest V at z (the splitting lemma): V(z, w(z)) decides.  With
weights 1/d_i, u_i^(d_i) the first pure power of u_i, the terms of weight 1 decide on a strict
minimum where no term weighs less: those that weigh more are small beside them.

Where V takes negative values as near as one likes, it is unstable

- where every motion loses energy: of an analytic V all equilibria near it have its value 0, and
  motions with less energy cannot end at one, nor stay (LaSalle's invariance);
- without dissipation and gyroscopic terms where the form of lowest degree takes negative values
  (Kozlov: a motion leaves it).

References
----------
Kozlov, J. Appl. Math. Mech. 50 (1986) 719; Bolotin, Kozlov, Izv. Math. 81 (2017) 669.
Merkin, *Introduction to the Theory of Stability*, section 3.3.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Poly, S, Symbol

from lagcli.algebra import dot, nullspace, simplify, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of
from lagcli.mechanics.rest.singular import complement
from lagcli.mechanics.stability.higher import HIGHEST, bent_there
from lagcli.mechanics.stability.near import Near, positive_definite
from lagcli.mechanics.stability.verdict import Stability, unstable
from lagcli.mechanics.theorems import KOZLOV, LAGRANGE_DIRICHLET, LASALLE

_Terms = dict[tuple[int, ...], Expr]
_LOWER = "{V} takes lower values as near to it as one likes"
_MINIMUM = "{V} has a strict minimum there by its terms of lowest degree"


def by_lowest_form(near: Near) -> Stability | None:
    """Of several coordinates without constraints; None: not known."""
    terms = {} if near.hypotheses.lacking else _terms(near)
    if not terms:
        return None
    first = _first_powers(terms)
    if first is None or min(_weight(e, first) for e in terms) < 1:
        degree = min(map(sum, terms))
        form = {e: c for e, c in terms.items() if sum(e) == degree}
        return _without_minimum(near, _negative_somewhere(near, form), kozlov=degree > 2)
    form = {e: c for e, c in terms.items() if _weight(e, first) == 1}
    of_one_degree = len({*first} - {2}) == 1
    if _negative_somewhere(near, form):
        return _without_minimum(near, True, kozlov=of_one_degree)
    if (found := _definite(form, first)) is None:
        return None
    signs = near.signs(found)
    if not {-1, 0}.isdisjoint(signs):
        return _without_minimum(near, 0 not in signs, kozlov=of_one_degree)
    by = LASALLE if near.decays else LAGRANGE_DIRICHLET
    left = tuple(c for c, known in zip(found, signs, strict=True) if known is None)
    damped = ", and all motions are damped" * near.decays
    return Stability(
        stable=None if left else True,
        reason="" if left else f"{_MINIMUM}{damped} ({by.name})",
        by=by,
        asymptotic=near.decays,
        minimum=left,
        reverses=near.decays or (of_one_degree and _conservative(near)),
    )


def _without_minimum(near: Near, negative: bool, *, kozlov: bool) -> Stability | None:
    """Unstable where V takes negative values, by LaSalle or (`kozlov`: of that form) by Kozlov."""
    if not negative or not (near.decays or (kozlov and _conservative(near))):
        return None
    return unstable(f"{_LOWER} ({(LASALLE if near.decays else KOZLOV).name})")


def _conservative(near: Near) -> bool:
    """Kozlov's hypothesis: neither dissipation, also beyond first order, nor gyroscopic terms."""
    return near.linear.rest.energy_is_kept and not near.linear.gyroscopic


def _negative_somewhere(near: Near, form: _Terms) -> bool:
    """Whether a coefficient says so: of an odd form any, of any other one of a pure power."""
    odd = all(sum(e) % 2 for e in form)
    decisive = {1, -1} if odd else {-1}
    chosen = [c for e, c in form.items() if odd or _is_pure(e)]
    odd_powers = [c for e, c in form.items() if _is_pure(e) and sum(e) % 2]
    return not decisive.isdisjoint(near.signs(chosen)) or not {1, -1}.isdisjoint(
        near.signs(odd_powers)
    )


def _terms(near: Near) -> _Terms:
    """V about the equilibrium to the degree `HIGHEST`, by exponents of the displacements."""
    linear = near.linear
    q, forces, values = linear.system.q, linear.forces_at_rest, linear.point.values
    if len(q) < 2 or linear.point.free or linear.dynamics.constraints.equations:
        return {}
    if bent_there(linear):
        return {}
    s, u = Symbol("#s", real=True), [Symbol(f"#u{k}", real=True) for k in range(len(q))]
    along = {x: x + s * du for x, du in zip(q, u, strict=True)}
    power = dot(u, [force.xreplace(along) for force in forces])
    found: _Terms = {}
    for degree in range(2, HIGHEST + 1):
        power = power.diff(s)
        there = at(power.xreplace({s: S.Zero}), values)
        if not free_of(there, q) or there.has(sympy.nan, sympy.zoo, sympy.oo):
            return {}
        found |= _powers(-there / sympy.factorial(degree), u, degree)
    return _at_lowest(found, near)


def _at_lowest(terms: _Terms, near: Near) -> _Terms:
    """V(z, w(z)) by exponents of z, where the second derivatives with respect to w are definite."""
    K = near.linear.K
    null, n = nullspace(K), len(K)
    across = complement([[S(int(i == j)) for j in range(n)] for i in range(n)], null)
    second = [[dot(a, [dot(row, b) for row in K]) for b in across] for a in across]
    if not (null and across and positive_definite(second, near.positive)):
        return terms
    z = [Symbol(f"#z{k}", real=True) for k in range(len(null))]
    w = [Symbol(f"#w{k}", real=True) for k in range(len(across))]
    u = [sympy.Add(*(x * v[i] for x, v in zip([*z, *w], [*null, *across], strict=True)))
         for i in range(n)]  # fmt: skip
    V = _polynomial(terms, u)
    lowest = dict.fromkeys(w, S.Zero)
    for _ in range(HIGHEST // 2 - 1):  # Newton: errors of degree k in w are of 2 k in V
        solution = solve_linear(second, [V.diff(x).xreplace(lowest) for x in w])
        assert solution is not None
        steps = zip(w, solution.values, strict=True)
        lowest = {x: _polynomial(_powers(lowest[x] - s, z, HIGHEST // 2), z) for x, s in steps}
    return _powers(V.xreplace(lowest), z, HIGHEST)


def _polynomial(terms: _Terms, u: Sequence[Expr]) -> Expr:
    return sympy.Add(*(c * sympy.Mul(*map(sympy.Pow, u, e)) for e, c in terms.items()))


def _powers(f: Expr, z: Sequence[Symbol], highest: int) -> _Terms:
    """A polynomial by exponents, to a degree."""
    terms = ((e, simplify(c)) for e, c in Poly(f, *z).terms() if sum(e) <= highest)
    return {e: c for e, c in terms if c != 0}


def _is_pure(exponents: Sequence[int]) -> bool:
    """Whether it is a power of one displacement."""
    return sum(map(bool, exponents)) == 1


def _first_powers(terms: _Terms) -> list[int] | None:
    pure = [[sum(e) for e in terms if e[i] == sum(e)] for i in range(len(min(terms)))]
    return [min(powers) for powers in pure] if all(pure) else None


def _weight(exponents: Sequence[int], first: Sequence[int]) -> Expr:
    return sympy.Add(*(sympy.Rational(e, d) for e, d in zip(exponents, first, strict=True)))


def _definite(lowest: _Terms, first: Sequence[int]) -> list[Expr] | None:
    """What is positive just where these terms are, beside u = 0; None: not known.

    Of squares of the u_i^(d_i/2) it is enough that no coefficient is negative; a form
    a x² + b x y + c y² of two of them, x and y of one sign where both are even powers.
    """
    pure = [c for e, c in lowest.items() if _is_pure(e)]
    mixed = {e: c for e, c in lowest.items() if not _is_pure(e)}
    if all(k % 2 == 0 for e in mixed for k in e) and all(
        sign_of(c, ()) == 1 for c in mixed.values()
    ):
        return pure
    half = tuple(d // 2 for d in first)
    if set(mixed) != {half} or any(d % 2 for d in first):
        return None
    a, b = (lowest[tuple(d if i == j else 0 for j, d in enumerate(first))] for i in range(2))
    bound = 2 * sympy.sqrt(a * b)
    signs = (1,) if all(k % 2 == 0 for k in half) else (1, -1)
    return [*pure, *(simplify(bound + side * mixed[half]) for side in signs)]
