"""First integrals of second degree in the velocities: Killing tensors with their potentials.

    Q = sum_{i<=j} f_ij p_i p_j (f_ii p_i^2 / 2) + sum_j f_j p_j + S(q),    p = M q'.

The multipliers dQ/dp_j do not contain S, so the same linear search finds them; S follows
from its gradient.  Products of integrals of first degree, and the energy, are left out:
what is kept is independent of them, linearly over the constants.

References
----------
Eisenhart, Ann. Math. 35 (1934) 284 (Staeckel systems and Killing tensors).
Fradkin, Am. J. Phys. 33 (1965) 207; Goldstein, Am. J. Phys. 43 (1975) 737.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import Field, dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.ansatz import (
    ordered,
    products_of_two,
    quadratic,
    quadratic_unknowns,
    up_to_second_degree,
)
from lagcli.mechanics.discovery.isometries import Isometries
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import independent
from lagcli.mechanics.discovery.products import integral_of, products_of
from lagcli.mechanics.discovery.relation import with_gradient
from lagcli.mechanics.discovery.scaling import bare_sums, bare_terms, scaled
from lagcli.mechanics.discovery.search import Search, SlotSolution
from lagcli.mechanics.discovery.slots import (
    Slot,
    SlotEquations,
    combined,
    linear_slots,
    point_slots,
    quadratic_slots,
)
from lagcli.mechanics.noether import Noether, NoetherCharge
from lagcli.mechanics.system import System
from lagcli.mechanics.total_derivative import boundary_term

MOST_UNKNOWNS = 480
_MOST_OF_FIELD = 24  # a monopole has 19; a dipole with 31 takes 12 s and has no more integrals

Slots = Sequence[tuple[Slot, Expr]]
Vector = tuple[Expr, ...]


class QuadraticIntegrals:
    """The integrals of second degree of equations M(q) q'' = forcing without time in them.

    K^ab and f^a are components along the `isometries` of a T of constant curvature, which are
    grad X_a where it is flat, else along the coordinates.
    """

    def __init__(
        self,
        noether: Noether,
        equations: SlotEquations,
        kinds: Kinds,
        allowed: Allowance,
        isometries: Isometries | None = None,
    ) -> None:
        self.noether = noether
        self.equations = equations
        self.allowed = allowed
        self.unproved = 0  # integrals that are there, without a formula for S
        self.constants = frozenset(noether.system.parameters)
        n = len(equations.q)
        units: Sequence[Vector] = ()
        if isometries is not None:
            units = isometries.translations or isometries.rotations
        self.curved = isometries is not None and not isometries.flat
        self.own = None if isometries is None else isometries.functions
        self.X = self.own or equations.q
        self.pairs = quadratic_slots(equations, units)
        self.shifts = linear_slots(units) if units else point_slots(equations)[1:]
        self.linear = self.shifts if is_gyroscopic(equations) else []
        slots = len(self.pairs) + len(self.linear)
        self.times: tuple[Expr, ...] = (sympy.S.One,)
        self._still = dict.fromkeys(equations.v, sympy.S.Zero)
        self.functions = self.spaces(kinds, MOST_UNKNOWNS // slots)
        if not self.functions and n * (n + 1) // 2 <= MOST_UNKNOWNS:
            self.functions = [sympy.S.One]
        self.of_field = self._of_field(units) if self.linear else []

    def spaces(self, kinds: Kinds, most: int) -> list[Expr]:
        """A bounded number of functions of the coordinates."""
        if self.curved:
            return [sympy.S.One]  # all Killing tensors are made of the isometries
        return quadratic(kinds, most) if self.own is None else up_to_second_degree(self.X, most)

    @property
    def size(self) -> int:
        """The number of unknowns, but for the terms of a field."""
        return len(self.functions) * len(self.times) * (len(self.pairs) + len(self.linear))

    @property
    def words(self) -> str:
        """The functions f."""
        if self.curved:
            return "from Killing vectors of T, with the terms of the field in their linear part"
        return "coefficients up to second degree in the coordinates"

    def found(self, known: Sequence[NoetherCharge]) -> list[tuple[Slots, NoetherCharge]]:
        """The integrals that are no combinations of products of the known ones."""
        products = self._products(known)
        search = self.search(products)
        kernel = search.kernel()
        kernel.reverse()  # the simplest first
        multipliers = [
            [sympy.Mul(u.time, u.space, x, evaluate=False) for x in search.slots[u.slot].vector]
            for u in search.unknowns
        ]
        count = len(products) + len(kernel) + len(self.equations.q)
        new = independent(search.tree.rows([*products, *multipliers], count), len(products), kernel)
        charges = []
        for solution in search.solutions(new):
            functions = self._scaled(search, solution)
            charge = self._charge(functions)
            if charge is not None:
                charges.append((functions, charge))
            elif self._slopes(combined(functions, len(self.equations.q)))[1] == 0:
                self.unproved += 1  # that of a drift has S = s(q) + c t, and is no such integral
        return charges

    def search(self, products: Sequence[tuple[Expr, ...]]) -> Search:
        """The linear system, in a field where the products are known."""
        slots = [*self.pairs, *self.linear]
        pairs, linear = range(len(self.pairs)), range(len(self.pairs), len(slots))
        unknowns = ordered([
            *quadratic_unknowns(pairs, self.functions, self.times),
            *quadratic_unknowns(linear, [*self.functions, *self.of_field], self.times),
        ])  # fmt: skip
        vectors = [slot.vector for slot in slots]
        more = [e for v in (*vectors, *products) for e in v]
        return Search(self.equations, slots, unknowns, self.allowed, more)

    def _products(self, known: Sequence[NoetherCharge]) -> list[tuple[Expr, ...]]:
        """The multipliers of the known integrals and of products of those of first degree."""
        t = self.equations.t
        entries = (*self.equations.forcing, *(m for row in self.equations.mass for m in row))
        timed = len(self.times) > 1 or not free_of(sympy.Tuple(*entries), [t])
        fixed = [c for c in known if timed or t not in c.charge.free_symbols]
        eta = {id(c): self.noether.characteristic(c.transformation) for c in fixed}
        linear = [c for c in fixed if c.transformation.displaces_without(self.equations.v)]
        return products_of(fixed, linear, eta)

    def _scaled(self, search: Search, solution: SlotSolution) -> Slots:
        parts = search.combination(solution)
        values = scaled([f for _, f in parts], self.constants)
        return [(slot, value) for (slot, _), value in zip(parts, values, strict=True)]

    def _of_field(self, units: Sequence[Vector]) -> list[Expr]:
        """Terms of what multiplies the velocities in the forces, along the units, times monomials.

        That of a monopole is x_k/r^3, and the linear part of its integrals x_k/r = x_k r^2/r^3.
        Along the rotations of a curved space it is x_k/r, as it stands in the linear part.
        """
        v = self.equations.v
        field = [[f.diff(x).xreplace(self._still) for x in v] for f in self.equations.forcing]
        if units:
            field = [[dot(E, [dot(row, F) for row in field]) for F in units] for E in units]
        entries = [simplify(s) for row in field for s in row]
        pairs = products_of_two(self.X)
        for parts in (bare_terms, bare_sums):  # in curvilinear coordinates x_k is a sum
            terms = dict.fromkeys(t for s in entries for t in parts(s, self.equations.q))
            monomials = [] if self.curved else [*self.X, *pairs]
            if [*terms] == [sympy.S.One] and monomials:  # K^ab A_b of a uniform field, A = B x/2
                monomials += dict.fromkeys(x * pair for x in self.X for pair in pairs)
            made = dict.fromkeys(t * m for t in terms for m in (sympy.S.One, *monomials))
            if len(made) <= _MOST_OF_FIELD:
                return list(made)
        return []

    # -- the charge -------------------------------------------------------------------------

    def _charge(self, functions: Slots) -> NoetherCharge | None:
        eta = combined(functions, len(self.equations.q))
        second, first = self._kinetic(functions)
        scalar = self._scalar(functions, eta, second + first)
        if scalar is None:
            return None
        # p = M q' + A: sum p_j eta_j = 2 (second degree) + (first degree) + A . eta
        at_rest = [p.xreplace(self._still) for p in self.noether.dynamics.lagrange.momenta]
        gauge = second - scalar + dot(at_rest, eta)
        return integral_of(self.noether, eta, second + first + scalar, gauge)

    def _scalar(self, functions: Slots, eta: Sequence[Expr], _: Expr, /) -> Expr | None:
        """S(q) from its gradient."""
        force, _ = self._slopes(eta)
        system = self.noether.system
        return potential(force, self._candidates(functions), system, self.allowed)

    def _slopes(self, eta: Sequence[Expr]) -> tuple[list[Expr], Expr]:
        """The gradient of S, and dS/dt at fixed q: dQ/dt = 0 to first degree in q'."""
        equations = self.equations
        slot = Slot(("whole",), tuple(eta))
        a, b = slot.a(equations), slot.b(equations)
        gradient = [
            expanded((b.diff(v) - equations.convected(x)).xreplace(self._still))
            for v, x in zip(equations.v, a, strict=True)
        ]
        return gradient, expanded(b.xreplace(self._still))

    def _kinetic(self, functions: Slots) -> tuple[Expr, Expr]:
        """sum f p_i p_j and f p_i^2/2, and sum f p_j, with p = M q'."""
        second, first = [], []
        for slot, f in functions:
            along = dot(slot.vector, self.momenta)
            if slot.kind[0] == "xi":
                first.append(f * along)
            else:
                second.append(f * along / 2)
        return sympy.Add(*second), sympy.Add(*first)

    @property
    def momenta(self) -> list[Expr]:
        """p = M q'."""
        return [dot(row, self.equations.v) for row in self.equations.mass]

    def _of_rest(self) -> set[Expr]:
        """The terms of L at rest without their constant factors."""
        q = self.equations.q
        rest = self.noether.system.L.xreplace(self._still)
        return set(bare_terms(rest, q)) - {sympy.S.One}

    def _candidates(self, functions: Slots) -> list[Expr]:
        """Products of the terms of L at rest with monomials and with the functions f."""
        q = self.equations.q
        terms = self._of_rest()
        monomials = [sympy.S.One, *self.X, *products_of_two(self.X)]
        inside = {t for _, f in functions for t in bare_terms(f, q)}
        roots = sorted(
            roots_in(sympy.Tuple(*terms), q), key=sympy.default_sort_key
        )  # such as r in b sqrt(r + x)/r
        made = [a * b for b in terms for a in (*monomials, *roots, *sorted(inside, key=str))]
        made += [m for m in monomials if m != 1] + [
            x / root for root in roots for x in (*self.X, root**2)
        ]
        turns = {
            sympy.Mul(*(x for x in sympy.Mul.make_args(f) if x.has(sympy.sin, sympy.cos)))
            for f in inside
        } - {sympy.S.One}
        made += [a * b * x for b in terms for a in monomials[: 1 + len(q)] for x in turns]
        axes = {a * x for a in terms for x in self.own or ()}  # x/r, before a shorter x/r + 1
        moving = {m for m in made if not free_of(m, q)}
        return sorted(moving, key=lambda m: (m not in axes, _length(m)))


def potential(
    force: Sequence[Expr], candidates: Sequence[Expr], system: System, allowed: Allowance
) -> Expr | None:
    """S(q) with the gradient `force`, as a combination of the candidates if it is one."""
    q = system.q
    if all(f == 0 for f in force):
        return sympy.S.Zero
    found = with_gradient(force, candidates, q, allowed)
    return boundary_term(simplify(dot(force, system.qdot)), system) if found is None else found


def roots_in(expression: Expr, q: Sequence[Symbol]) -> set[Expr]:
    """The roots of functions of the coordinates that occur in it, to the power of one."""
    return {
        power.base ** sympy.Rational(1, power.exp.q)
        for power in expression.atoms(sympy.Pow)
        if power.exp.is_Rational and power.exp.q > 1 and not free_of(power.base, q)
    }


def _length(expression: Expr) -> tuple[int, str]:
    """Shorter ones first: they are the ones that are used where several would do."""
    return sympy.count_ops(expression), str(expression)


def is_gyroscopic(equations: SlotEquations) -> bool:
    """Whether the forces have terms of first degree in the velocities."""
    still = dict.fromkeys(equations.v, sympy.S.Zero)
    return any(
        is_zero(f.diff(v).xreplace(still)) is not True
        for f in equations.forcing
        for v in equations.v
    )


def expanded(expression: Expr) -> Expr:
    """One fraction of expanded polynomials: quicker to have than the shortest shape."""
    field = Field([expression])
    return field.to_sympy(field(expression))
