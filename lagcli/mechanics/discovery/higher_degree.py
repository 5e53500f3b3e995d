"""First integrals of third and fourth degree in the velocities, of L = T - V.

With Killing vectors A of T, d/dt A.p = -A.grad V, so that of

    Q = sum c_A..D (A.p)...(D.p) + sum g(q) (A.p)...(B.p) + S(q),

with N factors in the first sum and N - 2 in the second, the rate has the degrees N - 1 and N - 3
in the velocities.  The first vanishes; so does the second for N = 3, where there is no S.  For
N = 4 it is -dS/dt, so it has no curl.  All is linear in the constants c and in the functions g,
which are sought among the terms of V and of A.grad V times monomials.

References
----------
Hietarinta, Phys. Rep. 147 (1987) 87, sections 3 and 4 (Holt, Fokas and Lagerstrom, Toda; 1:16).
Henon, Phys. Rev. B 9 (1974) 1921 (Toda's lattice).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.hidden import integral_of
from lagcli.mechanics.discovery.isometries import Vector
from lagcli.mechanics.discovery.killing import KillingFrame
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import independent, kernel_modulo
from lagcli.mechanics.discovery.scaling import bare_terms, scaled
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.discovery.tree import Tree
from lagcli.mechanics.noether import Noether, NoetherCharge
from lagcli.mechanics.total_derivative import boundary_term

#: The degrees that are searched, by the number of coordinates.
DEGREES = {2: (3, 4), 3: (3,)}
_MOST_UNKNOWNS = 400


@dataclass(frozen=True, slots=True)
class _Part:
    """g (A.p)...(B.p), and what it adds to the rate at the two degrees."""

    value: Expr
    above: Expr
    below: Expr


class HigherIntegrals:
    """The search for one system and one degree N, 3 or 4."""

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
        self._still = dict.fromkeys(equations.v, sympy.S.Zero)
        self._rest = noether.system.L.xreplace(self._still)
        self._slopes = [self._rest.diff(x) for x in equations.q]  # -grad V
        self._momenta = [dot(row, equations.v) for row in equations.mass]

    # -- the linear equations ---------------------------------------------------------------

    def found(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Those that are no combinations of products of the known ones."""
        parts = [*self._leading(), *self._lower()]
        if len(parts) > _MOST_UNKNOWNS:
            return []
        parts.reverse()  # the simplest last: each solution has one that no other has
        columns = [[part.above, *self._closed(part.below)] for part in parts]
        values = [[part.value] for part in parts]
        products = [[value] for value in self._products(known)]
        everything = [e for rows in (columns, values, products) for row in rows for e in row]
        variables = (self.equations.t, *self.equations.q, *self.equations.v)
        tree = Tree(everything, variables, self.allowed)
        points = len(columns) + 10  # the first condition alone may have the whole rank
        rows = tree.rows(columns, points * len(columns[0]))
        kernel = kernel_modulo(rows, len(columns))[1]
        kernel.reverse()
        table = tree.rows([*products, *values], len(products) + len(kernel) + 8)
        exact = ExactSolver(tree.points)
        found: list[NoetherCharge] = []
        for vector in independent(table, len(products), kernel):
            factors = exact.of(vector, columns.__getitem__)
            if factors is not None:
                found += self._proved(list(factors.values()), [parts[i] for i in factors])
        return found

    def _leading(self) -> Iterator[_Part]:
        """(A.p)...(D.p) of degree N."""
        for fields in combinations_with_replacement(self.frame.fields, self.degree):
            value, pushed = self._moved(fields)
            yield _Part(value, pushed, sympy.S.Zero)

    def _lower(self) -> Iterator[_Part]:
        """g (A.p)...(B.p) of degree N - 2."""
        for fields in combinations_with_replacement(self.frame.spanning, self.degree - 2):
            value, pushed = self._moved(fields)
            for g in self._functions():
                yield _Part(g * value, self.equations.convected(g) * value, g * pushed)

    def _moved(self, fields: Sequence[Vector]) -> tuple[Expr, Expr]:
        """(A.p)(B.p)... and what V adds to its rate: -(A.grad V)(B.p)... - ..."""
        p = [dot(A, self._momenta) for A in fields]
        push = [dot(A, self._slopes) for A in fields]
        rate = sympy.Add(*(sympy.Mul(f, *p[:k], *p[k + 1 :]) for k, f in enumerate(push)))
        return sympy.Mul(*p), rate

    def _functions(self) -> list[Expr]:
        """Terms of V and of its slopes along the fields times monomials, the shortest first."""
        q, X = self.equations.q, self.frame.X
        monomials = [sympy.S.One, *X]
        if len(q) == 2:
            monomials += [x * y for x, y in combinations_with_replacement(X, 2)]
        slopes = [dot(A, self._slopes) for A in self.frame.spanning]
        terms = [term for each in (self._rest, *slopes) for term in bare_terms(each, q)]
        made = dict.fromkeys(a * b for a in dict.fromkeys(terms) for b in monomials)
        return sorted(made, key=lambda e: (sympy.count_ops(e), str(e)))

    def _closed(self, below: Expr) -> list[Expr]:
        """What must vanish: the rest for N = 3, the curl of the slopes of S for N = 4."""
        if self.degree == 3:
            return [below]
        slopes = [below.diff(v) for v in self.equations.v]
        pairs = combinations(zip(self.equations.q, slopes, strict=True), 2)
        return [f.diff(y) - g.diff(x) for (x, f), (y, g) in pairs]

    def _products(self, known: Sequence[NoetherCharge]) -> list[Expr]:
        """Integrals of degree N, N - 2, ... that follow from the known ones, without their S."""
        fixed = [c.charge for c in known if self.equations.t not in c.charge.free_symbols]
        degrees = {Q: self._degree_of(Q) for Q in fixed}
        made = [
            sympy.Mul(*chosen)
            for count in range(1, self.degree + 1)
            for chosen in combinations_with_replacement(fixed, count)
            if sum(map(degrees.__getitem__, chosen)) in (self.degree, self.degree - 2)
        ]
        return [Q - Q.xreplace(self._still) for Q in made]

    def _degree_of(self, charge: Expr) -> int:
        """In the velocities."""
        return int(sympy.Poly(charge, *self.equations.v).total_degree())

    # -- the charge -------------------------------------------------------------------------

    def _proved(self, factors: Sequence[Expr], parts: Sequence[_Part]) -> Iterator[NoetherCharge]:
        """The integral with exact coefficients, where dQ/dt is 0 on the motion exactly."""
        system = self.noether.system
        chosen = list(zip(scaled(factors, frozenset(system.parameters)), parts, strict=True))
        rate = sympy.Add(*(c * part.below for c, part in chosen))
        S = sympy.S.Zero if self.degree == 3 else boundary_term(simplify(-rate), system)
        if S is None:
            return
        whole = sympy.Add(S, *(c * part.value for c, part in chosen))
        inverse = sympy.Matrix([list(row) for row in self.equations.mass]).inv(method="ADJ")
        slopes = [whole.diff(v) for v in self.equations.v]
        eta = tuple(dot(inverse.row(i), slopes) for i in range(len(slopes)))  # dQ/dp
        gauge = dot(eta, self.noether.dynamics.lagrange.momenta) - whole
        charge = integral_of(self.noether, eta, whole, gauge)
        if charge is not None:
            yield charge
