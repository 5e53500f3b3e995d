"""Integrals of second degree of L = T - V where T has constant curvature.

There a Killing tensor is a sum of products of Killing vectors A, B, and d/dt A.p = -A.grad V, so

    Q = sum c_AB (A.p)(B.p) + S(q),    S,i = sum c_AB ((A.grad V) B_i + (B.grad V) A_i),

which has a solution S where the right side has no curl: linear equations for constants c_AB.
In a flat space these are all integrals of second degree there are, as the equations of
Bertrand and Darboux state it for the plane.

References
----------
Thompson, J. Math. Phys. 27 (1986) 2693 (Killing tensors in spaces of constant curvature).
Perelomov, *Integrable Systems of Classical Mechanics and Lie Algebras*, vol. I, section 2.2.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.hidden import QuadraticIntegrals, Slots, expanded
from lagcli.mechanics.discovery.isometries import Isometries, Vector
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.modular import independent, kernel_modulo
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import bare_terms, scaled
from lagcli.mechanics.discovery.slots import Slot
from lagcli.mechanics.discovery.tree import Tree
from lagcli.mechanics.noether import Noether, NoetherCharge


class KillingIntegrals(QuadraticIntegrals):
    """All integrals of second degree of a system without gyroscopic terms.

    Parameters
    ----------
    symmetries
        Killing vectors that V admits: their products, which are nothing new, stand alone.
    """

    def __init__(
        self,
        noether: Noether,
        isometries: Isometries,
        kinds: Kinds,
        symmetries: Sequence[Vector],
    ) -> None:
        super().__init__(noether, isometries.equations, kinds, isometries.allowed)
        self.isometries = isometries
        basis = self._basis([*symmetries, *isometries.fields])
        self._fields = list(combinations_with_replacement(basis, 2))
        self.pairs = [self._product(A, B) for A, B in self._fields]
        # at rest the forces are -grad V
        self._slopes_of_V = [-f.xreplace(self._still) for f in self.equations.forcing]
        self._gradients = [self._gradient(A, B) for A, B in self._fields]

    def _basis(self, fields: Sequence[Vector]) -> list[Vector]:
        """The first of the fields that are independent: symmetries such as L about a centre."""
        return [fields[k] for k in Relation(fields, self.equations.q, self.allowed).independent()]

    def _product(self, A: Vector, B: Vector) -> Slot:
        """u = A (B.p) + B (A.p), the multipliers of (A.p)(B.p)."""
        a, b = (dot(X, self.momenta) for X in (A, B))
        return Slot(("product",), tuple(x * b + y * a for x, y in zip(A, B, strict=True)))

    def _gradient(self, A: Vector, B: Vector) -> list[Expr]:
        """(A.grad V) B_i + (B.grad V) A_i."""
        a, b = (dot(X, self._slopes_of_V) for X in (A, B))
        low = [[dot(X, row) for row in self.equations.mass] for X in (A, B)]
        return [a * y + b * x for x, y in zip(*low, strict=True)]

    def found(self, known: Sequence[NoetherCharge]) -> list[tuple[Slots, NoetherCharge]]:
        """Those that are no combinations of products of the known ones."""
        if all(slope == 0 for slope in self._slopes_of_V):
            return []  # products of momenta
        q = self.equations.q
        curls = [
            [w[k].diff(q[i]) - w[i].diff(q[k]) for i, k in combinations(range(len(q)), 2)]
            for w in self._gradients
        ]
        products = self._products(known)
        multipliers = [slot.vector for slot in self.pairs]
        everything = [e for rows in (curls, products, multipliers) for row in rows for e in row]
        tree = Tree(everything, (self.equations.t, *q, *self.equations.v), self.allowed)
        _, kernel = kernel_modulo(tree.rows(curls, len(curls) + 8), len(curls))
        kernel.reverse()
        rows = tree.rows([*products, *multipliers], len(products) + 8 + len(curls))
        new = independent(rows, len(products), kernel)
        return [each for vector in new for each in self._proved(tree, curls, vector)]

    def _proved(
        self, tree: Tree, curls: Sequence[Sequence[Expr]], vector: dict[int, int]
    ) -> Iterator[tuple[Slots, NoetherCharge]]:
        """The integral with exact coefficients."""
        known = ExactSolver(tree.points).of(vector, curls.__getitem__)
        if known is None:
            return
        factors = scaled(list(known.values()), self.constants)
        gradients = [self._gradients[k] for k in known]
        self._force = [expanded(dot(factors, each)) for each in zip(*gradients, strict=True)]
        functions = [(self.pairs[k], c) for k, c in zip(known, factors, strict=True)]
        charge = self._charge(functions)
        if charge is not None:
            yield functions, charge

    def _kinetic(self, functions: Slots) -> tuple[Expr, Expr]:
        """sum c (A.p)(B.p), by the products of the velocities."""
        whole, v = super()._kinetic(functions)[0], self.equations.v
        pairs = combinations_with_replacement(v, 2)
        terms = (simplify(whole.diff(x, y)) * x * y / (2 if x == y else 1) for x, y in pairs)
        return sympy.Add(*terms), sympy.S.Zero

    def _scalar(self, functions: Slots, eta: Sequence[Expr], _: Expr, /) -> Expr | None:
        """S from its gradient."""
        del eta
        return self._potential(self._force, functions)

    def _candidates(self, functions: Slots) -> list[Expr]:
        """Terms of V times monomials in the X_a."""
        del functions
        X = self.isometries.functions
        monomials = [sympy.S.One, *X, *(x * y for x, y in combinations_with_replacement(X, 2))]
        made = [a * b for a in self._of_rest() for b in (*monomials, *self.equations.q)]
        terms = {
            term for each in (*made, *monomials) for term in bare_terms(each, self.equations.q)
        }
        return sorted((m for m in terms if m != 1), key=sympy.default_sort_key)
