"""The nonholonomic momentum equation: symmetries that give a momentum but no constant.

Let X_a be symmetries of L and of the constraint distribution.  A combination
xi = sum c_a(q) X_a(q) that is an admissible displacement has the momentum J = p . xi, and
since the constraint forces do no work along it,

    dJ/dt = sum_a (dc_a/dt) p . X_a,

which is 0 where the c_a are constants (a horizontal symmetry).  Where dJ/dt = J ds/dt for a
function s(q), exp(-s) J is conserved.

References
----------
Bloch, *Nonholonomic Mechanics and Control*, 2nd ed., section 5.5.
Bloch, Krishnaprasad, Marsden, Murray, Arch. Rational Mech. Anal. 136 (1996) 21, theorem 4.5.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy

from lagcli.algebra import dot, is_zero, nullspace, rank, simplify
from lagcli.mechanics.discovery.admissible import Vector, primitive
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.scaling import scaled
from lagcli.mechanics.discovery.surface import relations_on_surface
from lagcli.mechanics.noether import Noether, NoetherCharge, Transformation
from lagcli.mechanics.total_derivative import boundary_term

_MOST_SYMMETRIES = 15  # measured: at most 15
_FEW_FIELDS = 3  # measured: at most 3


@dataclass(frozen=True, slots=True)
class Momenta:
    """Momenta along admissible symmetries: those that are constant, and the others."""

    conserved: list[NoetherCharge]
    changing: list[NoetherCharge]


class MomentumEquations:
    """The momenta of one system with velocity constraints.

    Parameters
    ----------
    noether
        Of a system whose position constraints are all solved for a coordinate.
    symmetries
        Of L without its constraints.
    fields
        That span the admissible displacements.
    """

    def __init__(
        self,
        noether: Noether,
        symmetries: Sequence[Transformation],
        fields: Sequence[Vector],
        allowed: Allowance,
    ) -> None:
        self.noether = noether
        self.system = noether.system
        self.allowed = allowed
        self.fields = fields
        dynamics = noether.dynamics
        self.relations = dynamics.constraints.relations
        self.rows = [
            dynamics.constraints.equations[k].row for k in dynamics.independent_constraints
        ]
        self.symmetries = [
            x.changes
            for x in symmetries
            if x.displaces_without([self.system.t]) and is_zero(noether.change_of_action(x)) is True
        ]

    def found(self, constant: Sequence[Vector]) -> Momenta:
        """Momenta along admissible symmetries that complete those along the given fields.

        Parameters
        ----------
        constant
            Fields along which the momentum is conserved.
        """
        conserved: list[NoetherCharge] = []
        changing: list[NoetherCharge] = []
        kept: list[Vector] = []
        for field in constant:
            if rank([*kept, field], self.relations) > len(kept):
                kept.append(field)
        whole = len(kept) == self.noether.dynamics.degrees_of_freedom
        if whole and len(self.fields) > _FEW_FIELDS:
            return Momenta([], [])
        for field in self._sections(self._of_the_constraints()):
            self.allowed.check()
            if rank([*kept, field], self.relations) == len(kept):
                # no new direction, but perhaps a constant after all
                if field in self.fields and len(self.fields) <= _FEW_FIELDS:
                    integrated = self._integrated(self._momentum(field))
                    conserved += [] if integrated is None else [integrated]
                continue
            kept.append(field)
            momentum = self._momentum(field)
            if momentum.conserved is True:
                conserved.append(momentum)
                continue
            integrated = self._integrated(momentum)
            if integrated is not None:
                conserved.append(integrated)
            elif momentum.conserved is False and momentum.rate is not None:
                changing.append(momentum)
        return Momenta(conserved, changing)

    def _of_the_constraints(self) -> list[Vector]:
        """Combinations of the symmetries of L that keep the distribution: A [X, e] = 0."""
        if not 0 < len(self.symmetries) <= _MOST_SYMMETRIES:
            return []
        q = self.system.q
        vectors = []
        for X in self.symmetries:
            self.allowed.check()
            vector = []
            for e in self.fields:
                bracket = [
                    sympy.Add(*(x * f.diff(s) - y * g.diff(s)
                                for x, y, s in zip(X, e, q, strict=True)))
                    for f, g in zip(e, X, strict=True)
                ]  # fmt: skip
                vector += [dot(row, bracket) for row in self.rows]
            vectors.append(vector)
        return [
            tuple(
                sympy.Add(*(c * self.symmetries[k][j] for k, c in combination.items()))
                for j in range(len(q))
            )
            for combination in relations_on_surface(vectors, self.noether.dynamics, self.allowed)
        ]

    def _sections(self, generators: Sequence[Vector]) -> list[Vector]:
        """Admissible combinations with coefficients that depend on q, the simplest first."""
        if not generators:
            return []
        across = [[simplify(dot(row, X)) for X in generators] for row in self.rows]
        orbit = rank(generators, self.relations)
        found = [e for e in self.fields if rank([*generators, e], self.relations) == orbit]
        for coefficients in nullspace(across, self.relations):
            field = primitive(
                [
                    sympy.Add(*(c * X[j] for c, X in zip(coefficients, generators, strict=True)))
                    for j in range(len(self.system.q))
                ]
            )
            if any(x != 0 for x in field):
                found.append(scaled(field, set(self.system.parameters)))
        q = set(self.system.q)
        # the fewest coordinates first, then the shortest
        return sorted(
            found,
            key=lambda f: (
                len(sympy.Tuple(*f).free_symbols & q), sum(sympy.count_ops(x) for x in f), str(f)
            ),
        )  # fmt: skip

    def _momentum(self, field: Vector) -> NoetherCharge:
        return self.noether.charge(
            "", "discovered", Transformation(field, sympy.S.Zero), sympy.S.Zero
        )

    def _integrated(self, momentum: NoetherCharge) -> NoetherCharge | None:
        """exp(-s) J where dJ/dt = J ds/dt."""
        if momentum.rate is None:
            return None
        J = simplify(momentum.charge, self.relations)
        ratio = simplify(momentum.rate / J, self.relations)
        v = self.system.qdot
        if any(set(ratio.diff(x).free_symbols) & set(v) for x in v):
            return None
        s = boundary_term(ratio, self.system)
        if s is None:
            return None
        factor = simplify(sympy.exp(-s))
        field = tuple(simplify(factor * x) for x in momentum.transformation.changes)
        charge = self._momentum(field)
        return charge if charge.conserved is True and charge.verified == "exact" else None
