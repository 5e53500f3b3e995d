"""Integrals of second degree of L = T - V from Killing vectors, where T is simple up to a factor.

With T = w(q) T0 and p the momenta, T0 = w T is a form in p whose Killing vectors A, B are known;
w = 1 where T has constant curvature.  Since H w = T0 + U, U = w V,

    Q = sum c_AB (A.p)(B.p) + S[U] - H S[w],
    S[f],i = sum c_AB ((A.grad f) B_i + (B.grad f) A_i),

is constant where both right sides have no curl: linear equations for constants c_AB.  Where w = 1
in a flat space these are all integrals of second degree, as the equations of Bertrand and
Darboux state it for the plane; else they are those of Liouville, Koenigs and their kind.

References
----------
Thompson, J. Math. Phys. 27 (1986) 2693 (Killing tensors in spaces of constant curvature).
Hietarinta, Grammaticos, Dorizzi, Ramani, Phys. Rev. Lett. 53 (1984) 1707 (exchange of H and w).
Perelomov, *Integrable Systems of Classical Mechanics and Lie Algebras*, vol. I, section 2.2.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.hidden import (
    QuadraticIntegrals,
    Slots,
    expanded,
    integral_of,
    is_gyroscopic,
)
from lagcli.mechanics.discovery.isometries import Isometries, Vector
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import independent, kernel_modulo
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.scaling import bare_terms, scaled
from lagcli.mechanics.discovery.slots import Slot, SlotEquations, combined
from lagcli.mechanics.discovery.tree import Tree
from lagcli.mechanics.noether import Noether, NoetherCharge

_COORDINATES = (2, 3)


@dataclass(frozen=True, slots=True)
class KillingFrame:
    """Killing vectors of T0, those among them that span the space, and its coordinates X.

    Attributes
    ----------
    mass
        Of T0.
    factor
        w of T = w T0.
    squares
        Killing tensors A B where the vectors themselves are not elementary.
    """

    fields: Sequence[Vector]
    spanning: Sequence[Vector]
    X: Sequence[Expr]
    mass: Sequence[Sequence[Expr]]
    factor: Expr = sympy.S.One
    squares: Sequence[tuple[Vector, Vector]] = ()

    @classmethod
    def of(cls, equations: SlotEquations, isometries: Isometries | None) -> KillingFrame | None:
        """For constant M, or constant curvature, where the forces are those of a V(q)."""
        mass = equations.mass
        entries = sympy.Tuple(*(m for row in mass for m in row))
        fixed = free_of(sympy.Tuple(entries, *equations.forcing), [equations.t])
        if not fixed or is_gyroscopic(equations):
            return None
        if free_of(entries, [*equations.q, *equations.v]):
            shifts = _units(len(equations.q))
            return cls([*shifts, *_rotations(equations)], shifts, equations.q, mass)
        if isometries is None or not isometries.functions:
            return None
        spanning = isometries.translations or isometries.rotations
        return cls(isometries.fields, spanning, isometries.functions, mass)

    @classmethod
    def without_factor(
        cls, equations: SlotEquations, w: Expr, allowed: Allowance
    ) -> KillingFrame | None:
        """For T = w T0 with T0 of constant curvature, or a sum of squares of own coordinates."""
        rows = (tuple(simplify(m / w) for m in row) for row in equations.mass)
        given = replace(equations, mass=tuple(rows))
        curved = Isometries(given, sympy.S.Zero, allowed) if Isometries.apply(given) else None
        frame = cls.of(given, curved) or cls._of_squares(given)
        return None if frame is None else replace(frame, factor=w)

    @classmethod
    def _of_squares(cls, equations: SlotEquations) -> KillingFrame | None:
        """p_i^2/g_ii for T0 = sum g_ii(q_i) q_i'^2/2."""
        mass, units = equations.mass, _units(len(equations.q))
        own = (m.free_symbols & set(equations.q) <= ({x} if i == k else set())
               for k, (x, row) in enumerate(zip(equations.q, mass, strict=True))
               for i, m in enumerate(row))  # fmt: skip
        off = any(m != 0 for k, row in enumerate(mass) for i, m in enumerate(row) if i != k)
        if off or not all(own) or is_gyroscopic(equations):
            return None
        squares = [(e, tuple(x / mass[k][k] for x in e)) for k, e in enumerate(units)]
        return cls((), (), equations.q, mass, squares=squares)

    @property
    def products(self) -> list[tuple[Vector, Vector]]:
        """Killing tensors as products A B."""
        return [*self.squares] or list(combinations_with_replacement(self.fields, 2))


def _units(n: int) -> list[Vector]:
    return [tuple(sympy.Integer(i == k) for i in range(n)) for k in range(n)]


def _rotations(equations: SlotEquations) -> list[Vector]:
    """X_i e_k - X_k e_i, X = M q."""
    X = [dot(row, equations.q) for row in equations.mass]
    found = []
    for i, k in combinations(range(len(X)), 2):
        field: list[Expr] = [sympy.S.Zero] * len(X)
        field[i], field[k] = -X[k], X[i]
        found.append(tuple(field))
    return found


def common_factors(equations: SlotEquations) -> list[Expr]:
    """w: the factors with coordinates that all components have in common, and sums among them."""
    if len(equations.q) not in _COORDINATES:
        return []
    entries = [sympy.factor(m) for row in equations.mass for m in row if m != 0]
    shared = set.intersection(*(set(sympy.Mul.make_args(e)) for e in entries))
    moving = [f for f in shared if not free_of(f, equations.q)]
    found = (sympy.Mul(*moving), sympy.Mul(*(f for f in moving if f.as_base_exp()[0].is_Add)))
    return [w for w in dict.fromkeys(found) if w != 1]


class KillingIntegrals(QuadraticIntegrals):
    """The integrals of second degree of a system without gyroscopic terms, from one frame.

    Parameters
    ----------
    symmetries
        Killing vectors that V admits: their products, which are nothing new, stand alone.
    """

    def __init__(
        self,
        noether: Noether,
        equations: SlotEquations,
        kinds: Kinds,
        allowed: Allowance,
        frame: KillingFrame,
        symmetries: Sequence[Vector] = (),
    ) -> None:
        super().__init__(noether, equations, kinds, allowed)
        self.frame = frame
        if symmetries:
            frame = replace(frame, fields=self._basis([*symmetries, *frame.fields]))
        self.pairs = [self._product(A, B) for A, B in frame.products]
        U = -frame.factor * noether.system.L.xreplace(self._still)
        self._scalars = (U,) if frame.factor == 1 else (U, frame.factor)
        self._gradients = [
            [self._gradient(A, B, f) for A, B in frame.products] for f in self._scalars
        ]

    def _basis(self, fields: Sequence[Vector]) -> list[Vector]:
        """The first of the fields that are independent: symmetries such as L about a centre."""
        return [fields[k] for k in Relation(fields, self.equations.q, self.allowed).independent()]

    def _product(self, A: Vector, B: Vector) -> Slot:
        """u = A (B.p) + B (A.p), the multipliers of (A.p)(B.p)."""
        a, b = (dot(X, self.momenta) for X in (A, B))
        return Slot(("product",), tuple(x * b + y * a for x, y in zip(A, B, strict=True)))

    def _gradient(self, A: Vector, B: Vector, f: Expr) -> list[Expr]:
        """(A.grad f) B_i + (B.grad f) A_i."""
        slopes = [f.diff(x) for x in self.equations.q]
        a, b = (dot(X, slopes) for X in (A, B))
        low = [[dot(X, row) for row in self.frame.mass] for X in (A, B)]
        return [a * y + b * x for x, y in zip(*low, strict=True)]

    def found(self, known: Sequence[NoetherCharge]) -> list[tuple[Slots, NoetherCharge]]:
        """Those that are no combinations of products of the known ones."""
        q, v = self.equations.q, self.equations.v
        if self.frame.factor == 1 and free_of(self._scalars[0], q):
            return []  # products of momenta
        curls = [
            [
                S[k].diff(q[i]) - S[i].diff(q[k])
                for S in each
                for i, k in combinations(range(len(q)), 2)
            ]
            for each in zip(*self._gradients, strict=True)
        ]
        products = [self._across(eta) for eta in self._products(known)]
        multipliers = [self._across(slot.vector) for slot in self.pairs]
        everything = [e for rows in (curls, products, multipliers) for row in rows for e in row]
        tree = Tree(everything, (self.equations.t, *q, *v), self.allowed)
        _, kernel = kernel_modulo(tree.rows(curls, len(curls) + 8), len(curls))
        kernel.reverse()
        rows = tree.rows([*products, *multipliers], len(products) + 8 + len(curls))
        new = independent(rows, len(products), kernel)
        return [each for vector in new for each in self._proved(tree, curls, vector)]

    def _across(self, eta: Sequence[Expr]) -> list[Expr]:
        """What is 0 for f(q) q', as S[w] H and H itself have it."""
        pairs = combinations(zip(eta, self.equations.v, strict=True), 2)
        return [x * b - y * a for (x, a), (y, b) in pairs]

    def _proved(
        self, tree: Tree, curls: Sequence[Sequence[Expr]], vector: dict[int, int]
    ) -> Iterator[tuple[Slots, NoetherCharge]]:
        """The integral with exact coefficients."""
        known = ExactSolver(tree.points).of(vector, curls.__getitem__)
        if known is None:
            return
        factors = scaled(list(known.values()), self.constants)
        potentials = []
        for f, gradients in zip(self._scalars, self._gradients, strict=True):
            rows = zip(*(gradients[k] for k in known), strict=True)
            potentials.append(
                self._potential([expanded(dot(factors, row)) for row in rows], self._shapes(f))
            )
        functions = [(self.pairs[k], c) for k, c in zip(known, factors, strict=True)]
        charge = None if None in potentials else self._with(functions, *potentials)
        if charge is not None:
            yield functions, charge

    def _with(self, functions: Slots, S: Expr, shift: Expr = sympy.S.Zero) -> NoetherCharge | None:
        """Q = sum c (A.p)(B.p) + S - H shift."""
        v, system = self.equations.v, self.noether.system
        eta = combined(functions, len(v))
        second, _ = self._kinetic(functions)
        whole = second - shift * self.noether.energy.function
        if shift != 0:
            whole = self._by_velocities(whole) + simplify(whole.xreplace(self._still) + S) - S
        eta = tuple(x - shift * y for x, y in zip(eta, v, strict=True))
        return integral_of(self.noether, eta, whole + S, second - S - shift * system.L)

    def _kinetic(self, functions: Slots) -> tuple[Expr, Expr]:
        """sum c (A.p)(B.p)."""
        return self._by_velocities(super()._kinetic(functions)[0]), sympy.S.Zero

    def _by_velocities(self, whole: Expr) -> Expr:
        """The terms of second degree, by the products of the velocities."""
        pairs = combinations_with_replacement(self.equations.v, 2)
        terms = (simplify(whole.diff(x, y)) * x * y / (2 if x == y else 1) for x, y in pairs)
        return sympy.Add(*terms)

    def _shapes(self, f: Expr) -> list[Expr]:
        """Terms of f times monomials in X."""
        X, q = self.frame.X, self.equations.q
        monomials = [sympy.S.One, *X, *(x * y for x, y in combinations_with_replacement(X, 2))]
        made = [a * b for a in bare_terms(f, q) if a != 1 for b in (*monomials, *q)]
        terms = {term for each in (*made, *monomials) for term in bare_terms(each, q)}
        return sorted((m for m in terms if m != 1), key=sympy.default_sort_key)
