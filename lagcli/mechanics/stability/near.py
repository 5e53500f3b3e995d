"""The motion near an equilibrium or a steady motion, as the theorems on stability ask for it."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import Field, dot, nullspace, rank, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant, determinant_in
from lagcli.algebra.place import at
from lagcli.algebra.polynomial_roots import factors_by_coefficients
from lagcli.algebra.positivity import is_positive, sign_of, weak_sign
from lagcli.mechanics.rest.characteristic import Characteristic
from lagcli.mechanics.rest.linearization import Linearization
from lagcli.mechanics.stability.evenness import even
from lagcli.mechanics.stability.hurwitz import hurwitz_conditions
from lagcli.mechanics.stability.spectrum import real_and_distinct
from lagcli.record import record

#: What the file leaves open, and how it would say it.
NOT_DEFINITE = "the kinetic energy is not known to be positive definite"
_DECLARED = " (a parameter is declared positive by {assume: positive})"
_INDEFINITE = "the kinetic energy is not positive definite"


@record
class Hypotheses:
    """What the theorems of Lagrange and Dirichlet and of Routh ask for beside the minimum."""

    energy_never_grows: bool
    definite: bool
    indefinite: bool = False
    declared: bool = True  # no parameter of the kinetic energy is left of any sign

    @property
    def lacking(self) -> str:
        """The hypothesis that is not known to hold; empty where all do."""
        if not self.energy_never_grows:
            return "a force may feed energy"
        if not self.definite:
            return (
                _INDEFINITE if self.indefinite else NOT_DEFINITE + _DECLARED * (not self.declared)
            )
        return ""


class Near:
    """M x'' + C x' + K x = 0 and what is known beyond first order."""

    def __init__(self, linear: Linearization, characteristic: Characteristic | None = None) -> None:
        self.linear = linear
        self.characteristic = characteristic or Characteristic(linear)

    @cached_property
    def positive(self) -> tuple[Expr, ...]:
        """What is positive there: by the conditions of existence, and the minors of M."""
        if not self._definite_where_regular:
            return tuple(self.linear.point.positive)
        open_ = [m for m in self._minors if sign_of(m, ()) is None]
        return (*self.linear.point.positive, *open_)

    @cached_property
    def _minors(self) -> list[Expr]:
        """The leading minors of M, all positive just where it is definite."""
        M = self.linear.M
        minors = (determinant([row[:k] for row in M[:k]]) for k in range(1, len(M) + 1))
        return [m for m in minors if m is not None]

    @cached_property
    def _definite_where_regular(self) -> bool:
        """Whether M is regular there, and its leading minors are positive nearly everywhere.

        Then M is nowhere less than semidefinite, and definite where it is regular, along
        constraints and for a Routhian, too.
        """
        if not self.linear.regular:
            return False
        system, everywhere = self.linear.system, self.linear.dynamics.lagrange.mass_matrix
        static = system.V is not None and free_of(system.V, system.qdot)
        if static and system.T is not None and system.T.is_nonnegative:  # a sum of squares
            return True
        return positive_definite(everywhere, (), beside_zeros=True)

    def signs(self, expressions: Sequence[Expr]) -> list[int | None]:
        """The sign of each; None where it depends on values."""
        return [sign_of(e, self.positive) for e in expressions]

    # -- the characteristic polynomial -------------------------------------------------------------

    @cached_property
    def powers(self) -> list[Expr] | None:
        """The coefficients of det(s² M + s C + K) by powers of s, over the leading one."""
        powers = self.characteristic.in_s
        if powers is None or len(powers) != 2 * len(self.linear.M) + 1:
            return None
        return [simplify(c / powers[-1]) for c in powers]

    @property
    def zeros(self) -> int:
        """How many roots s are 0."""
        assert self.powers is not None
        return next(k for k, c in enumerate(self.powers) if c != 0)

    @property
    def others(self) -> list[Expr]:
        """The polynomial without its roots 0."""
        assert self.powers is not None
        return self.powers[self.zeros :]

    @property
    def even(self) -> bool:
        """Whether with s also -s is a root."""
        return all(c == 0 for c in self.others[1::2])

    @cached_property
    def conditions(self) -> list[Expr] | None:
        """What must be positive of the roots that are not 0; None: too long.

        For imaginary and distinct ones where with s also -s is a root, else for negative real
        parts.
        """
        if len(self.others) == 1:
            return []
        if self.even and self._restored and len(self._minors) == len(self.linear.M):
            return [m for m in self._minors if sign_of(m, ()) != 1]
        return real_and_distinct(self.linear) if self.even else hurwitz_conditions(self.others)

    @property
    def _restored(self) -> bool:
        """Whether linear equations M x'' + K x = 0 have a definite K: M then decides alone."""
        linear = self.linear
        symmetric = linear.has_potential and not (linear.damped or linear.gyroscopic)
        return linear.exact and symmetric and positive_definite(linear.K, self.positive)

    @cached_property
    def squares(self) -> list[Expr] | None:
        """The roots W = -s², those that vanish last; None without a closed form."""
        factors = self.characteristic.squares
        if factors is None or any(roots is None for roots, _, _ in factors):
            return None
        found: list[Expr] = []
        for roots, multiplicity, _ in factors:
            found += [simplify(root) for root in roots or ()] * multiplicity
        return sorted(found, key=lambda W: W == 0)

    # -- the potential -----------------------------------------------------------------------------

    @cached_property
    def restoring(self) -> Linearization:
        """The motion without the velocity constraints that cannot be integrated.

        These do no work: energy theorems are about the displacements without them.
        """
        linear = self.linear
        if not linear.nonholonomic:
            return linear
        return Linearization(linear.rest, linear.point, released=True)

    @cached_property
    def has_energy(self) -> bool:
        """Whether the energy function cannot grow, and has the potential that K belongs to."""
        return (
            self.linear.rest.energy_never_grows
            and (not self.linear.nonholonomic or self.restoring.balanced)
            and self.restoring.has_potential
        )

    @cached_property
    def inertia_is_definite(self) -> bool:
        """Sylvester: all leading minors of M are positive, there or nearly everywhere."""
        there = positive_definite(self.restoring.M, self.positive)
        return there or self._definite_where_regular

    @cached_property
    def _inertia_is_indefinite(self) -> bool:
        """Whether M surely has a negative eigenvalue: a diagonal entry or a minor says so."""
        M = self.restoring.M
        minors = [determinant([row[:k] for row in M[:k]]) for k in range(1, len(M) + 1)]
        return any(
            x is not None and sign_of(x, self.positive) in wrong
            for x, wrong in [*((M[i][i], (-1,)) for i in range(len(M))), (minors[-1], (-1,))]
        )

    @cached_property
    def hypotheses(self) -> Hypotheses:
        """Of the theorems on a minimum of the potential."""
        definite = self.inertia_is_definite
        parameters = {s for row in self.restoring.M for e in row for s in e.free_symbols}
        declared = all(s.is_positive for s in parameters - {*self.linear.system.q})
        indefinite = not definite and self._inertia_is_indefinite
        return Hypotheses(self.has_energy, definite, indefinite, declared)

    @cached_property
    def curvatures(self) -> list[list[Expr]]:
        """Lists of what is positive just where V has a minimum of second order.

        The W of det(K - W M) where they have a closed form, their symmetric functions e_1, …, e_n
        by factors of det(K + W M) = det M (W + W_1) … (W + W_n), and a K that is diagonal.
        """
        linear = self.restoring
        found: list[list[Expr]] = []
        if not (linear.damped or linear.gyroscopic) and linear is self.linear and self.squares:
            found.append(self.squares)
        n, W = len(linear.M), Symbol("#W", real=True)
        M, K = linear.M, linear.K
        powers = determinant_in(W, [[W * M[i][j] + K[i][j] for j in range(n)] for i in range(n)])
        if powers is not None and len(powers) > n:
            found.append([simplify(power / powers[-1]) for power in powers[-2::-1]])
            found.append(_symmetric_functions(powers, W))
        return [*found, self.diagonal] if self.diagonal else found

    @cached_property
    def diagonal(self) -> list[Expr]:
        """The entries of a K that is diagonal, those that vanish last; empty for any other."""
        K = self.restoring.K
        n = len(K)
        if any(K[i][j] != 0 for i in range(n) for j in range(n) if i != j):
            return []
        return sorted((K[i][i] for i in range(n)), key=lambda k: k == 0)

    @property
    def kinetic_energy_stays(self) -> bool:
        """Whether, where all rest, that of the velocities which constraints allow never grows."""
        return self.has_energy and positive_definite(self.linear.M, self.positive)

    # -- velocity terms ----------------------------------------------------------------------------

    @cached_property
    def complete(self) -> bool:
        """Complete dissipation: the symmetric part of C is positive definite."""
        linear = self.linear
        return linear.damped and positive_definite(linear.damping, self.positive)

    @cached_property
    def decays(self) -> bool:
        """Whether forces take energy out of every motion, to first order or beyond it (LaSalle)."""
        linear = self.linear
        return self.complete or (not linear.nonholonomic and linear.rest.energy_always_shrinks)

    @cached_property
    def potential_decides(self) -> bool:
        """Whether it is unstable where K has a negative eigenvalue: see `lyapunov`."""
        symmetric = self.linear.has_potential and self.restoring is self.linear
        held = self.linear.gyroscopic and not self.complete
        return symmetric and not held and self.inertia_is_definite

    # -- families ----------------------------------------------------------------------------------

    @cached_property
    def _tangents(self) -> list[list[Expr]]:
        """dq along the equilibria near it, at the same values of everything else."""
        values, q = self.linear.point.values, self.linear.system.q
        if not all(free_of(value, q) for x, value in values.items() if x not in q):
            return []  # a family in which momenta change from place to place
        found = []
        for s in self.linear.point.free:
            steps = {x: at(values[x].diff(s), values) for x in q if x in values}
            found.append([S.One if x == s else steps.get(x, S.Zero) for x in q])
        return found

    def _excluded(self, rows: Sequence[Sequence[Expr]]) -> int:
        """How many of these displacements constraints with these gradients exclude."""
        if not (rows and self._tangents):
            return 0
        return rank([[dot(row, dq) for dq in self._tangents] for row in rows])

    @cached_property
    def dimension(self) -> int:
        """Of the equilibria that it can be displaced to."""
        return len(self._tangents) - self._excluded(self.linear.rows)

    @cached_property
    def dimension_released(self) -> int:
        """The same without the velocity constraints that cannot be integrated."""
        return len(self._tangents) - self._excluded(self.restoring.rows)

    @property
    def rests_everywhere(self) -> bool:
        """Whether every displacement leads to an equilibrium.

        So also where it leads to another surface of integrable velocity constraints.  At given
        momenta of cyclic coordinates it is not so at all others.
        """
        values, q, dynamics = self.linear.point.values, self.linear.system.q, self.linear.dynamics
        if not set(values) <= set(q):
            return False
        equations = [e for e in dynamics.constraints.equations if e.holonomic]
        rows = [[at(a, values) for a in e.row] for e in equations]
        return len(self._tangents) - self._excluded(rows) == len(q) - (rank(rows) if rows else 0)

    @cached_property
    def as_many_equilibria(self) -> bool:
        """Whether the equilibria near it are a manifold with a dimension for each root 0."""
        velocity = sum(kind != "holonomic" for kind in self._kinds_of_independent())
        return self.zeros == self.dimension and self._excluded(self.linear.rows) == velocity

    def _kinds_of_independent(self) -> list[str]:
        constraints, dynamics = self.linear.dynamics.constraints, self.linear.dynamics
        return [
            "holonomic" if constraints.equations[k].holonomic else "velocity"
            for k in dynamics.independent_constraints
        ]

    @cached_property
    def is_even(self) -> bool:
        """Whether V has its minimum across the family evenly along it."""
        linear, known = self.linear, self.linear.point.family
        equations = linear.dynamics.constraints.equations
        kept = [equations[k] for k in linear.dynamics.independent_constraints]
        return even(
            linear.point.values if known is None else known.given,
            linear.point.free,
            linear.forces_at_rest,
            [e.f for e in kept if e.holonomic],
            linear.system.q,
            None if known is None else known.relation,
        )

    @cached_property
    def same_on_branches(self) -> bool:
        """Whether no formula has the root by which one branch of a family was written."""
        if self.linear.point.family is None or self.powers is None:
            return True
        entries = [e for m in (self.linear.M, self.linear.C) for row in m for e in row]
        roots = {
            power
            for e in (*self.powers, *entries)
            for power in e.atoms(sympy.Pow)
            if not power.exp.is_Integer
        }
        return all(free_of(root, self.linear.system.q) for root in roots)

    @cached_property
    def semisimple_zeros(self) -> bool:
        """Whether no displacement drifts away: as many null vectors of K as roots 0."""
        return len(nullspace(self.linear.K)) == self.zeros

    @cached_property
    def drifts_along_family(self) -> bool:
        """Whether the roots 0 only carry it along the equilibria, at a small constant velocity.

        The solutions a + b t, with K b = 0 and C b + K a = 0, are then as many as the roots 0.
        """
        K = self.linear.K
        return self.dimension == len(nullspace(K)) and len(self._slow_motions) == self.zeros

    @cached_property
    def _slow_motions(self) -> list[list[Expr]]:
        """The pairs (a, b) of the solutions a + b t: K b = 0 and C b + K a = 0."""
        C, K = self.linear.C, self.linear.K
        rows = [[*k, *c] for k, c in zip(K, C, strict=True)]
        rows += [[*([S.Zero] * len(k)), *k] for k in K]
        return nullspace(rows)

    @property
    def drifting(self) -> tuple[Symbol, ...]:
        """The coordinates that a slow motion a + b t carries away."""
        basis, q = self.linear.basis, self.linear.system.q
        rates = [motion[len(basis) :] for motion in self._slow_motions]
        moved = [
            [sympy.Add(*(x * column[j] for x, column in zip(b, basis, strict=True))) for b in rates]
            for j in range(len(q))
        ]
        return tuple(s for s, each in zip(q, moved, strict=True) if any(simplify(x) for x in each))

    def semisimple(self, W: Expr, multiplicity: int) -> bool:
        """Whether the root has as many modes: the null space of K - W M + i ω C."""
        M, C, K = self.linear.M, self.linear.C, self.linear.K
        n, omega = len(M), sympy.sqrt(W)
        block = [[simplify(K[i][j] - W * M[i][j]) for j in range(n)] for i in range(n)]
        if not self.linear.gyroscopic:
            return len(nullspace(block)) == multiplicity
        turned = [[simplify(omega * C[i][j]) for j in range(n)] for i in range(n)]
        real = [[*block[i], *(-x for x in turned[i])] for i in range(n)]
        real += [[*turned[i], *block[i]] for i in range(n)]
        return len(nullspace(real)) == 2 * multiplicity


def _symmetric_functions(powers: Sequence[Expr], W: Symbol) -> list[Expr]:
    """e_1, e_2, … of the W_i of each factor of (W + W_1) (W + W_2) …, those that vanish last."""
    whole = sympy.Add(*(c * W**k for k, c in enumerate(powers)))
    field = Field([whole])
    number = field.number_of(W)
    assert number is not None
    factors = factors_by_coefficients(field, field(whole).numerator, number)
    factors.sort(key=lambda factor: factor[0][0].is_zero())  # W itself, of what is neutral
    return [
        simplify(field.to_sympy(c / a[-1])) for a, many in factors for _ in range(many)
        for c in a[-2::-1]
    ]  # fmt: skip


def positive_definite(
    matrix: Sequence[Sequence[Expr]], positive: Sequence[Expr], *, beside_zeros: bool = False
) -> bool:
    """Sylvester: all leading minors are positive, or are so wherever they are not 0."""
    for k in range(1, len(matrix) + 1):
        minor = determinant([list(row[:k]) for row in matrix[:k]])
        if minor is None or minor == 0:
            return False
        if not is_positive(minor, positive) and not (
            beside_zeros and weak_sign(minor, positive) == 1
        ):
            return False
    return True
