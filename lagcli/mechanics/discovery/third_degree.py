"""First integrals of third degree in the velocities, of L = T - V in Cartesian coordinates.

With Killing vectors A of the constant mass matrix M, d/dt A.p = -A.grad V, so

    Q = sum c_ABC (A.p)(B.p)(C.p) + b_j(q) q_j'

is constant where the terms of second degree and those without velocities vanish:

    (b_i,j + b_j,i)/2 = sum c_ABC (A.grad V B_i C_j + two more, symmetric in i, j),
    b . M^-1 grad V = 0.

The b_j are sought among the terms of V and of grad V times monomials.

References
----------
Hietarinta, Phys. Rep. 147 (1987) 87, section 3 (Holt, Fokas and Lagerstrom, Toda).
Henon, Phys. Rev. B 9 (1974) 1921 (Toda's lattice).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.hidden import is_gyroscopic
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import PRIME, kernel_modulo, pivot_columns
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.discovery.tree import Tree
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation

_COORDINATES = (2, 3)
_MOST_UNKNOWNS = 400

Vector = tuple[Expr, ...]


class CubicIntegrals:
    """The search for one system.

    Parameters
    ----------
    noether, equations
        Of a system to which they `apply`.
    """

    def __init__(self, noether: Noether, equations: SlotEquations, allowed: Allowance) -> None:
        self.noether = noether
        self.equations = equations
        self.allowed = allowed
        still = dict.fromkeys(equations.v, sympy.S.Zero)
        self._rest = noether.system.L.xreplace(still)
        self._slopes = [-self._rest.diff(x) for x in equations.q]  # grad V
        fields = [*self._translations(), *self._rotations()]
        self._triples = list(combinations_with_replacement(fields, 3))
        self._functions = self._of_potential()

    @staticmethod
    def applies(equations: SlotEquations) -> bool:
        """Whether T is that of Cartesian coordinates, and the forces are those of a V(q)."""
        entries = sympy.Tuple(*(m for row in equations.mass for m in row))
        moving = [equations.t, *equations.q, *equations.v]
        forces = sympy.Tuple(*equations.forcing)
        fixed = free_of(entries, moving) and free_of(forces, [equations.t])
        return len(equations.q) in _COORDINATES and fixed and not is_gyroscopic(equations)

    def _translations(self) -> list[Vector]:
        n = range(len(self.equations.q))
        return [tuple(sympy.Integer(i == k) for i in n) for k in n]

    def _rotations(self) -> list[Vector]:
        """X_i e_k - X_k e_i, X = M q."""
        X = [_along(row, self.equations.q) for row in self.equations.mass]
        found = []
        for i, k in combinations(range(len(X)), 2):
            field: list[Expr] = [sympy.S.Zero] * len(X)
            field[i], field[k] = -X[k], X[i]
            found.append(tuple(field))
        return found

    def _of_potential(self) -> list[Expr]:
        """Terms of V and of its gradient times monomials."""
        q = self.equations.q
        monomials = [sympy.S.One, *q]
        if len(q) == 2:
            monomials += [x * y for x, y in combinations_with_replacement(q, 2)]
        terms = [
            term.as_independent(*q, as_Add=False)[1]
            for each in (self._rest, *self._slopes)
            for term in sympy.Add.make_args(sympy.expand(each))
        ]
        made = [a * b for a in dict.fromkeys(terms) for b in monomials]
        return sorted(dict.fromkeys(made), key=lambda e: (sympy.count_ops(e), str(e)))

    # -- the linear equations ---------------------------------------------------------------

    def found(self, known: Sequence[NoetherCharge]) -> list[NoetherCharge]:
        """Those that are no combinations of products of the known ones."""
        parts = [*self._parts_of_triples(), *self._parts_of_functions()]
        if len(parts) > _MOST_UNKNOWNS:
            return []
        parts.reverse()  # the simplest last: each solution has one that no other has
        columns = [condition for _, condition in parts]
        values = [[value] for value, _ in parts]
        products = [[value] for value in self._products(known)]
        everything = [e for rows in (columns, values, products) for row in rows for e in row]
        variables = (self.equations.t, *self.equations.q, *self.equations.v)
        tree = Tree(everything, variables, self.allowed)
        kernel = kernel_modulo(tree.rows(columns, len(columns) + 10), len(columns))[1]
        kernel.reverse()
        if not kernel:
            return []
        start = len(products)
        table = [
            [*row[:start], *(
                sum(c * row[start + k] for k, c in vector.items()) % PRIME for vector in kernel
            )]
            for row in tree.rows([*products, *values], start + len(kernel) + 8)
        ]  # fmt: skip
        exact = ExactSolver(tree.points)
        found: list[NoetherCharge] = []
        for k in pivot_columns(table):
            if k >= start:
                indices = sorted(kernel[k - start])
                numbers = [kernel[k - start][i] for i in indices]
                factors = exact.recognized(numbers) or exact.solved([columns[i] for i in indices])
                found += self._proved(factors, [parts[i][0] for i in indices])
        return found

    def _parts_of_triples(self) -> Iterator[tuple[Expr, list[Expr]]]:
        """(A.p)(B.p)(C.p) and what it adds to the conditions."""
        mass, v = self.equations.mass, self.equations.v
        for triple in self._triples:
            low = [[_along(X, row) for row in mass] for X in triple]
            value = sympy.Mul(*(_along(each, v) for each in low))
            push = [_along(X, self._slopes) for X in triple]
            conditions = [
                -sympy.Add(*(
                    push[a] * (low[b][i] * low[c][k] + low[b][k] * low[c][i]) / 2
                    for a, b, c in ((0, 1, 2), (1, 0, 2), (2, 0, 1))
                ))
                for i, k in self._pairs
            ]  # fmt: skip
            yield value, [*conditions, sympy.S.Zero]

    def _parts_of_functions(self) -> Iterator[tuple[Expr, list[Expr]]]:
        """g(q) q_j' and what it adds."""
        q, v = self.equations.q, self.equations.v
        inverse = sympy.Matrix([list(row) for row in self.equations.mass]).inv(method="ADJ")
        for j in range(len(q)):
            push = _along([inverse[j, k] for k in range(len(q))], self._slopes)
            for g in self._functions:
                slopes = [g.diff(x) for x in q]
                conditions = [
                    (int(k == j) * slopes[i] + int(i == j) * slopes[k]) / 2 for i, k in self._pairs
                ]
                yield g * v[j], [*conditions, -g * push]

    @property
    def _pairs(self) -> list[tuple[int, int]]:
        return list(combinations_with_replacement(range(len(self.equations.q)), 2))

    def _products(self, known: Sequence[NoetherCharge]) -> list[Expr]:
        """Integrals of first and third degree that follow from the known ones."""
        fixed = [c for c in known if self.equations.t not in c.charge.free_symbols]
        v = set(self.equations.v)
        linear = [
            c.charge for c in fixed
            if c.transformation.time == 0
            and not sympy.Tuple(*c.transformation.changes).free_symbols & v
        ]  # fmt: skip
        second = [c.charge for c in fixed if c.charge not in linear]
        return [
            *linear,
            *(a * b for a in linear for b in second),
            *(a * b * c for a, b, c in combinations_with_replacement(linear, 3)),
        ]

    # -- the charge -------------------------------------------------------------------------

    def _proved(
        self, factors: Sequence[Expr] | None, values: Sequence[Expr]
    ) -> Iterator[NoetherCharge]:
        """The integral with exact coefficients, where dQ/dt is 0 on the motion exactly."""
        if factors is None:
            return
        constants = frozenset(self.noether.system.parameters)
        factors = scaled(factors, constants)
        whole = sympy.Add(*(c * x for c, x in zip(factors, values, strict=True)))
        lagrange = self.noether.dynamics.lagrange
        inverse = sympy.Matrix([list(row) for row in self.equations.mass]).inv(method="ADJ")
        slopes = [whole.diff(v) for v in self.equations.v]
        n = range(len(slopes))
        eta = tuple(_along([inverse[i, k] for k in n], slopes) for i in n)  # dQ/dp
        along = _along(eta, lagrange.left_sides)
        if is_zero(self.noether.system.total_derivative(whole) - along) is not True:
            return
        yield NoetherCharge(
            "",
            "discovered",
            Transformation(eta, sympy.S.Zero),
            _along(eta, lagrange.momenta) - whole,
            whole,
            conserved=True,
            rate=sympy.S.Zero,
            verified="exact",
            broken_by="",
        )


def _along(field: Sequence[Expr], other: Sequence[Expr]) -> Expr:
    return sympy.Add(*(x * y for x, y in zip(field, other, strict=True)))
