"""First integrals of second, third and fourth degree in the velocities, of L = T - V.

With Killing vectors A of T, d/dt A.p = -A.grad V, so that of

    Q = sum c_A..D (A.p)...(D.p) + sum g(q) (A.p)...(B.p) + S(q),

with N factors in the first sum and N - 2 > 0 in the second, the rate has the degrees N - 1 and
N - 3 in the velocities.  The first vanishes; so does the second for N = 3, where there is no S.
For even N it is -dS/dt, so it has no curl.  All is linear in the constants c and in the functions
g, which are sought among the terms of V and of A.grad V times monomials.  Where T has constant
curvature those of second degree are all there are.  For any other T(q, q') with n Killing
vectors, as that of a top, the lower sum has g(q) q_i' q_j'.

For T = w(q) T0 with Killing vectors of T0, w H = T0 + w V in the momenta p.  With the S[f] that the
first sum has in a potential f, an integral of second degree is

    Q = sum c_AB (A.p)(B.p) + S[w V] - H S[w].

References
----------
Hietarinta, Phys. Rep. 147 (1987) 87, sections 3 and 4 (Holt, Fokas and Lagerstrom, Toda; 1:16).
Henon, Phys. Rev. B 9 (1974) 1921 (Toda's lattice).
Kowalevski, Acta Math. 12 (1889) 177 (the top with A = B = 2 C).
Hietarinta, Grammaticos, Dorizzi, Ramani, Phys. Rev. Lett. 53 (1984) 1707 (exchange of H and w).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import derivative, dot, simplify
from lagcli.mechanics.discovery.ansatz import products_of_two
from lagcli.mechanics.discovery.constant_curvature import Vector
from lagcli.mechanics.discovery.hidden import expanded, potential, roots_in
from lagcli.mechanics.discovery.killing import KillingFrame
from lagcli.mechanics.discovery.limits import Allowance, TooMuchWork
from lagcli.mechanics.discovery.products import integral_of
from lagcli.mechanics.discovery.relation import Relation, with_gradient
from lagcli.mechanics.discovery.scaling import bare_terms, scaled
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.noether import Noether, NoetherCharge
from lagcli.mechanics.total_derivative import boundary_term

_MOST_UNKNOWNS = 450  # measured: at most 414, for D3
_MOST_FUNCTIONS = 300


@dataclass(frozen=True, slots=True)
class _Part:
    """g (A.p)...(B.p) and dQ/dp of it; its rate at the higher degree, and at the lower one."""

    value: Expr
    slopes: Vector
    above: Expr
    below: Sequence[Expr]  # by potential
    degree: int


class KillingIntegrals:
    """The search for one system, one frame and one degree N of 2, 3 and 4."""

    def __init__(
        self,
        noether: Noether,
        equations: SlotEquations,
        frame: KillingFrame,
        degree: int,
        allowed: Allowance,
    ) -> None:
        self.noether = noether
        self.equations = equations
        self.frame = frame
        self.degree = degree
        self.allowed = allowed
        self.unproved = 0  # integrals that are there, without a formula for S
        self.unsolved = 0  # without exact coefficients
        self._still = dict.fromkeys(equations.v, sympy.S.Zero)
        self._rest = noether.system.L.xreplace(self._still)
        w = frame.factor
        self._potentials = [-w * self._rest] if w == 1 else [-w * self._rest, w]
        self._momenta = [dot(row, equations.v) for row in equations.mass]

    # -- the linear equations ---------------------------------------------------------------

    def found(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Those that are no combinations of products of the known ones."""
        parts = [*self._leading(), *(self._lower() if self.degree > 2 else ())]
        if len(parts) > _MOST_UNKNOWNS:
            raise TooMuchWork
        parts.reverse()  # the simplest last: each solution has one that no other has
        columns = [
            [part.above, *(x for rate in part.below for x in self._closed(rate))] for part in parts
        ]
        if not any(map(any, columns)):
            return []  # products of momenta
        values = [self._compared(part.value) for part in parts]
        products = [self._compared(Q) for Q in self._products(known)]
        variables = (self.equations.t, *self.equations.q, *self.equations.v)
        more = [e for rows in (values, products) for row in rows for e in row]
        relation = Relation(columns, variables, self.allowed, more)
        relations = relation.beyond(values, products)
        self.unsolved = relation.unsolved
        found = [self._proved(list(c.values()), [parts[i] for i in c]) for c in relations]
        self.unproved = found.count(None)
        return [charge for charge in found if charge is not None]

    def _leading(self) -> Iterator[_Part]:
        """(A.p)...(D.p) of degree N."""
        for fields in self.frame.products(self.degree):
            value, slopes, pushed = self._moved(fields)
            zero = sympy.S.Zero
            above, below = (zero, pushed) if self.degree == 2 else (pushed[0], [zero])
            yield _Part(value, slopes, above, below, self.degree)

    def _lower(self) -> Iterator[_Part]:
        """g (A.p)...(B.p) of degree N - 2."""
        degree = self.degree - 2
        for fields in combinations_with_replacement(self.frame.spanning, degree):
            value, slopes, [pushed] = self._moved(fields)
            drift = self._drift(value)
            for g in self._functions():
                above = self.equations.convected(g) * value + g * drift
                yield _Part(g * value, tuple(g * x for x in slopes), above, [g * pushed], degree)

    def _drift(self, value: Expr) -> Expr:
        """The rate under T alone, which is 0 for Killing vectors."""
        v, accelerations = self.equations.v, self.frame.accelerations
        if not accelerations:
            return sympy.S.Zero
        slopes = [derivative(value, x) for x in v]
        return self.equations.convected(value) + dot(slopes, accelerations)

    def _moved(self, fields: Sequence[Vector]) -> tuple[Expr, Vector, list[Expr]]:
        """(A.p)(B.p)..., dQ/dp of it and what each f adds to its rate: -(A.grad f)(B.p)... - ..."""
        p = [dot(A, self._momenta) for A in fields]
        others = [sympy.Mul(*p[:k], *p[k + 1 :]) for k in range(len(p))]
        slopes = tuple(dot(others, column) for column in zip(*fields, strict=True))
        pushed = [
            -dot([dot(A, self._gradient(f)) for A in fields], others) for f in self._potentials
        ]
        return sympy.Mul(*p), slopes, pushed

    def _gradient(self, f: Expr) -> list[Expr]:
        return [derivative(f, x) for x in self.equations.q]

    def _functions(self) -> list[Expr]:
        """Terms of V and of its slopes along the fields times monomials, the shortest first."""
        q = self.equations.q
        curved = bool(self.frame.accelerations)
        gradient = self._gradient(self._rest)
        slopes = gradient if curved else [dot(A, gradient) for A in self.frame.spanning]
        terms = [term for each in (self._rest, *slopes) for term in bare_terms(each, q)]
        degrees = (2,) if len(q) == 2 or curved else (3, 1) if self.degree == 3 else (1,)
        for highest in degrees:
            monomials = self._monomials(highest)
            made = dict.fromkeys(a * b for a in dict.fromkeys(terms) for b in monomials)
            if len(made) * len(q) < _MOST_FUNCTIONS:
                break
        return sorted(made, key=lambda e: (sympy.count_ops(e), str(e)))

    def _monomials(self, degree: int) -> list[Expr]:
        """In X up to this degree."""
        factors = combinations_with_replacement([sympy.S.One, *self.frame.X], degree)
        return [sympy.Mul(*each) for each in factors]

    def _closed(self, rate: Expr) -> list[Expr]:
        """What must vanish: the rate for N = 3, the curl of the slopes of S for even N."""
        if self.degree == 3:
            return [rate]
        pairs = combinations(zip(self.equations.q, self._slopes_of(rate), strict=True), 2)
        return [derivative(f, y) - derivative(g, x) for (x, f), (y, g) in pairs]

    def _slopes_of(self, rate: Expr) -> list[Expr]:
        """-dS/dq by the rate in p = M q', M = w M0."""
        return [derivative(rate, v) / self.frame.factor for v in self.equations.v]

    def _products(self, known: Sequence[NoetherCharge]) -> list[Expr]:
        """Integrals of degrees N - 2 to N that follow from the known ones, without their S."""
        fixed = [c.charge for c in known if self.equations.t not in c.charge.free_symbols]
        v = self.equations.v
        degrees = {Q: sympy.Poly(Q, *v).total_degree() for Q in fixed}
        made = [
            sympy.Mul(*chosen)
            for count in range(1, self.degree + 1)
            for chosen in combinations_with_replacement(fixed, count)
            if 0 <= self.degree - sum(map(degrees.__getitem__, chosen)) <= 2
        ]
        return [Q - Q.xreplace(self._still) for Q in made]

    def _compared(self, Q: Expr) -> list[Expr]:
        """Q for N > 2; else what vanishes for f(q) H, as S[w] H and H itself have it."""
        if self.degree > 2:
            return [Q]
        slopes = [derivative(Q, v) for v in self.equations.v]
        pairs = combinations(zip(slopes, self._momenta, strict=True), 2)
        return [x * b - y * a for (x, a), (y, b) in pairs]

    # -- the charge -------------------------------------------------------------------------

    def _proved(self, factors: Sequence[Expr], parts: Sequence[_Part]) -> NoetherCharge | None:
        """The integral with exact coefficients, where dQ/dt is 0 on the motion exactly."""
        system, v = self.noether.system, self.equations.v
        c = scaled(factors, frozenset(system.parameters))
        found = [
            self._scalar(dot(c, rates), f)
            for f, rates in zip(
                self._potentials, zip(*(p.below for p in parts), strict=True), strict=True
            )
        ]
        if None in found:
            return None
        S, shift = (*found, sympy.S.Zero)[:2]
        moving = dot(c, [part.value for part in parts]) - shift * self.noether.energy.function
        eta = tuple(
            dot(c, column) - shift * rate
            for *column, rate in zip(*(part.slopes for part in parts), v, strict=True)
        )
        # p.eta - Q, with p.q' - H = L and the p - M q' of terms of L that change nothing
        gauge = dot(c, [(part.degree - 1) * part.value for part in parts]) - shift * system.L - S
        linear = [derivative(system.L, rate).xreplace(self._still) for rate in v]
        gauge += dot(linear, [e + shift * rate for e, rate in zip(eta, v, strict=True)])
        return integral_of(self.noether, eta, self._collected(moving) + S, gauge)

    def _scalar(self, rate: Expr, f: Expr) -> Expr | None:
        """S with dS/dt = -rate."""
        if self.degree == 3:
            return sympy.S.Zero
        system = self.noether.system
        force = [-x for x in self._slopes_of(rate)]
        if self.degree == 4:
            found = with_gradient(force, self._products_of_terms, system.q, self.allowed)
            sought = found is None and (len(force) == 2 or self.frame.accelerations)
            return boundary_term(simplify(-rate), system) if sought else found
        return potential([*map(expanded, force)], self._shapes(f), system, self.allowed)

    @property
    def _products_of_terms(self) -> list[Expr]:
        """Of two terms of V."""
        terms = [term for term in bare_terms(self._rest, self.equations.q) if term != 1]
        return products_of_two(terms)

    def _shapes(self, f: Expr) -> list[Expr]:
        """Terms of f times monomials in X, and these over roots in f: x/r of Kepler's problem."""
        q = self.equations.q
        monomials = self._monomials(2)
        made = [a * b for a in bare_terms(f, q) if a != 1 for b in (*monomials, *q)]
        made += [sympy.fraction(a)[0] for a in bare_terms(f, q)]  # Liouville's f(u) + g(v)
        made += [m / root for root in roots_in(f, q) for m in monomials]
        terms = {term for each in (*made, *monomials) for term in bare_terms(each, q)}
        sums = [x for x in self.frame.X if x.is_Add]  # z/r of xi - eta, before z/r + 1
        axes = [a * x for a in bare_terms(f, q) if a != 1 for x in sums]
        return axes + sorted((m for m in terms if m != 1), key=sympy.default_sort_key)

    def _collected(self, whole: Expr) -> Expr:
        """One of second degree by the products of the velocities."""
        if self.degree > 2:
            return whole
        pairs = combinations_with_replacement(self.equations.v, 2)
        terms = (simplify(whole.diff(x, y)) * x * y / (2 if x == y else 1) for x, y in pairs)
        return sympy.Add(*terms, simplify(whole.xreplace(self._still)))
