"""Noether's theorem: from a transformation to a conserved charge, or to what breaks it.

A transformation q -> q + e Dq(q, q', t), t -> t + e Dt(q, q', t) changes the action by
the integral of

    K = sum_j [ dL/dq_j Dq_j + dL/dq_j' (d(Dq_j)/dt - q_j' d(Dt)/dt) ]
        + dL/dt Dt + L d(Dt)/dt,

Dq being the change at the transformed time.  Where K = dG/dt for a boundary term
G(q, q', t), the charge and its rate on the motion are

    Q     = sum_j dL/dq_j' (Dq_j - q_j' Dt) + L Dt - G,
    dQ/dt = K - dG/dt + sum_j (Q_j - dD/dq_j' + sum_k lambda_k a_kj) (Dq_j - q_j' Dt),

the last line because d/dt(dL/dq') - dL/dq is what acts on the system beside L.

References
----------
Noether, Nachr. Ges. Wiss. Goettingen (1918) 235, sections 1 and 2.
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 13.7.
Hill, Rev. Mod. Phys. 23 (1951) 253 (the boundary term).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of, without_jumps
from lagcli.algebra.jumps import is_continuous
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.energy import EnergyFunction
from lagcli.mechanics.gauge import Gauge, GaugeSearch
from lagcli.mechanics.translations import constant_nullspace
from lagcli.problem_data import Symmetry
from lagcli.record import record, replace
from lagcli.statements.answers import ChargeSource, Verification
from lagcli.statements.wording import CHANGE_OF_L, constraints_named, enumerated

_NO_GAUGE_KNOWN = "no gauge was found, and whether there is one was not decided"
_JUMPS = "it, or L, may jump where the argument of a sign is 0"
_OTHER_GAUGE = "the gauge that the file gives (without it the right one is found)"


@record
class Transformation:
    """Delta q by coordinate, in order, and Delta t."""

    changes: tuple[Expr, ...]
    time: Expr

    def displaces_without(self, symbols: Iterable[Symbol]) -> bool:
        """Whether it leaves the time, and moves the coordinates by no function of the symbols."""
        return self.time == 0 and all(free_of(x, symbols) for x in self.changes)


@record
class NoetherCharge:
    """A transformation with its boundary term, charge and rate.

    `gauge` is None where K is no total derivative; the charge is then that of G = 0.  It is
    None, too, where a gauge exists, or may exist, and was not found: the charge is then not
    `complete`, since it lacks that gauge, unless it is conserved without it.
    `conserved` and `rate` are None where the motion was not solved and the rate needs it.
    """

    name: str
    source: ChargeSource
    transformation: Transformation
    gauge: Expr | None
    charge: Expr
    conserved: bool | None
    rate: Expr | None
    verified: Verification | None
    broken_by: str
    complete: bool = True


class Noether:
    """The charges of the candidates of the file and of the evident symmetries."""

    def __init__(self, dynamics: Dynamics, energy: EnergyFunction) -> None:
        self.dynamics = dynamics
        self.system = dynamics.system
        self.energy = energy

    @cached_property
    def charges(self) -> tuple[NoetherCharge, ...]:
        """Candidates in the order of the file, then cyclic coordinates, then the energy."""
        candidates = [self._candidate(symmetry) for symmetry in self.system.problem.symmetries]
        evident = [
            charge
            for charge in (*self.cyclic_momenta, self._energy_charge())
            if not self.is_trivial(charge)
            and not any(self._same_charge(charge, candidate) for candidate in candidates)
        ]
        return (*candidates, *evident)

    def is_trivial(self, charge: NoetherCharge) -> bool:
        """Whether a charge is conserved by the constraints alone, whatever the motion is."""
        if not (charge.complete and charge.conserved):
            return False
        on_surface = self.dynamics.shapes.simplify(charge.charge)
        moving = {*self.system.q, *self.system.qdot, self.system.t}
        return not on_surface.free_symbols & moving or self.dynamics.verifier.is_fixed(
            charge.charge
        )

    @cached_property
    def cyclic(self) -> tuple[int, ...]:
        """Coordinates that do not occur in L, nor make it jump."""
        L = self.system.L
        jumps = simplify(L).atoms(sympy.sign) if L.has(sympy.sign) else ()
        return tuple(
            j
            for j, force in enumerate(self.dynamics.lagrange.lagrangian_forces)
            if is_zero(force) is True and all(free_of(u, [self.system.q[j]]) for u in jumps)
        )

    # -- candidates ---------------------------------------------------------------------

    def _candidate(self, symmetry: Symmetry) -> NoetherCharge:
        build, zero = self.system.build, sympy.S.Zero
        transformation = Transformation(
            tuple(
                build(symmetry.changes[name]) if name in symmetry.changes else zero
                for name in self.system.names
            ),
            zero if symmetry.time is None else build(symmetry.time),
        )
        given = None if symmetry.gauge is None else build(symmetry.gauge)
        return self.charge(symmetry.name, "candidate", transformation, given)

    def charge(
        self,
        name: str,
        source: ChargeSource,
        transformation: Transformation,
        gauge: Expr | None = None,
    ) -> NoetherCharge:
        """The charge of a transformation; a boundary term that is not given is sought."""
        change = simplify(self.change_of_action(transformation))
        if gauge is None:
            found = self._gauge(change, transformation)
            return self._judged(name, source, transformation, found.term, change, found.exists)
        judged = self._judged(name, source, transformation, gauge, change)
        if CHANGE_OF_L in judged.broken_by and self._gauge(change, transformation).exists:
            broken_by = judged.broken_by.replace(CHANGE_OF_L, _OTHER_GAUGE)
            return replace(judged, broken_by=broken_by)
        return judged

    def change_of_action(self, transformation: Transformation) -> Expr:
        """K, the change of L dt per dt and unit of the small parameter."""
        system, lagrange = self.system, self.dynamics.lagrange
        stretch = system.total_derivative(transformation.time)
        return sympy.Add(
            *(
                force * change + momentum * (system.total_derivative(change) - v * stretch)
                for force, momentum, change, v in zip(
                    lagrange.lagrangian_forces,
                    lagrange.momenta,
                    transformation.changes,
                    system.qdot,
                    strict=True,
                )
            ),
            without_jumps(system.L.diff(system.t)) * transformation.time,
            system.L * stretch,
        )

    def _gauge(self, change: Expr, transformation: Transformation) -> Gauge:
        """G with dG/dt = K, or whether there is one."""
        system = self.system
        still = dict.fromkeys(system.qdot, sympy.S.Zero)
        momenta = (p.xreplace(still) for p in self.dynamics.lagrange.momenta)
        parts = [p * by for p, by in zip(momenta, transformation.changes, strict=True)]
        guess = sympy.Add(*parts, system.L.xreplace(still) * transformation.time)
        return GaugeSearch(self.dynamics).of(change, guess)

    def _judged(
        self,
        name: str,
        source: ChargeSource,
        transformation: Transformation,
        gauge: Expr | None,
        change: Expr,
        exists: bool | None = True,
    ) -> NoetherCharge:
        boundary = sympy.S.Zero if gauge is None else gauge
        contributions = self._contributions(transformation, boundary, change)
        complete = gauge is not None or exists is False
        if not complete:  # conserved without G, too, where the forces' work is -K
            complete = bool(self._rate(list(contributions.values()))[1])
            if exists and not complete:
                contributions.pop(CHANGE_OF_L, None)  # K = dG/dt, whatever G is
        system = self.system
        along = dot(self.dynamics.lagrange.momenta, self.characteristic(transformation))
        charge = along + system.L * transformation.time - boundary
        rate, conserved, verified = self._rate(list(contributions.values()))
        if conserved and not (system.is_continuous and is_continuous(charge)):
            # constant only between the places where it jumps
            rate, conserved, verified, broken_by = None, None, None, _JUMPS
        else:
            causes = [] if conserved is not False else self._not_vanishing(contributions)
            broken_by = enumerated(causes)
        if gauge is None and exists is None and conserved is False:
            rate = conserved = verified = None
            broken_by = _NO_GAUGE_KNOWN
        verdict = (conserved, rate, verified, broken_by)
        return NoetherCharge(name, source, transformation, gauge, charge, *verdict, complete)

    def characteristic(self, transformation: Transformation) -> tuple[Expr, ...]:
        """Dq_j - q_j' Dt, the change in form."""
        return tuple(
            change - v * transformation.time
            for change, v in zip(transformation.changes, self.system.qdot, strict=True)
        )

    def _contributions(
        self, transformation: Transformation, boundary: Expr, change: Expr
    ) -> dict[str | ConstraintEquation, Expr]:
        """The terms of dQ/dt by cause, those that vanish identically left out."""
        system, dynamics = self.system, self.dynamics
        eta = self.characteristic(transformation)
        parts: dict[str | ConstraintEquation, Expr] = {
            CHANGE_OF_L: change - system.total_derivative(boundary),
            "the applied forces": dot(system.forces, eta),
            "the dissipation": -dot(map(system.D.diff, system.qdot), eta),
        }
        for equation in dynamics.constraints.equations:
            # a . (Dq - q' Dt) = a . Dq + b Dt on the motion
            across = dot(equation.row, transformation.changes)
            across += equation.drift * transformation.time
            if is_zero(across, dynamics.constraints.relations) is not True:
                parts[equation] = equation.multiplier * across
        return {cause: part for cause, part in parts.items() if is_zero(part) is not True}

    def _rate(
        self, contributions: list[Expr]
    ) -> tuple[Expr | None, bool | None, Verification | None]:
        if not contributions:
            return sympy.S.Zero, True, "exact"
        total = sympy.Add(*contributions)
        on_motion = self.dynamics.rate_on_motion(total)
        if on_motion is None:
            verdict = self.dynamics.vanishes_on_motion(total)
            return sympy.S.Zero if verdict.holds else None, verdict.holds, verdict.how
        rate = self.dynamics.shapes.simplify(on_motion)
        verdict = self.dynamics.verifier.is_zero(rate)
        if verdict.holds is True:
            return sympy.S.Zero, True, verdict.how
        return rate, verdict.holds, verdict.how

    def applies(self, charge: NoetherCharge) -> bool | None:
        """Whether the hypothesis of Noether's theorem holds for a transformation and its gauge.

        The change of L minus dG/dt, plus the work of all forces along Dq - q' Dt, vanishes on the
        motion.  None where that was not decided.
        """
        boundary = sympy.S.Zero if charge.gauge is None else charge.gauge
        change = self.change_of_action(charge.transformation)
        works = self._contributions(charge.transformation, boundary, change)
        return self._rate(list(works.values()))[1]

    def working(self, charge: NoetherCharge) -> tuple[str, ...]:
        """The forces that do work along a transformation: Q . (Dq - q' Dt) is not 0."""
        change, boundary = sympy.S.Zero, sympy.S.Zero
        works = self._contributions(charge.transformation, boundary, change)
        return tuple(self._not_vanishing(works))

    def _not_vanishing(self, contributions: Mapping[str | ConstraintEquation, Expr]) -> list[str]:
        """The causes, in words, of what is not 0 on the motion."""
        causes = [
            cause
            for cause, part in contributions.items()
            if self.dynamics.vanishes_on_motion(part).holds is not True
        ]
        constraints = [cause.name for cause in causes if not isinstance(cause, str)]
        words = [constraints_named("the constraint", constraints)] * bool(constraints)
        return [*(cause for cause in causes if isinstance(cause, str)), *words]

    # -- evident symmetries ---------------------------------------------------------------

    @cached_property
    def cyclic_momenta(self) -> list[NoetherCharge]:
        """p_q of each cyclic coordinate: the translation Dq = 1."""
        zero, one = sympy.S.Zero, sympy.S.One
        n = len(self.system.q)
        return [
            self._judged(
                "p_" + self.system.names[j],
                "cyclic",
                Transformation(tuple(one if i == j else zero for i in range(n)), zero),
                zero,
                zero,
            )
            for j in self.cyclic
        ]

    def _energy_charge(self) -> NoetherCharge:
        """The energy function h, of the translation Dt = 1 (Q = -h by the formula)."""
        energy = self.energy
        causes = [p.cause for p in energy.powers] if energy.conserved is False else []
        return NoetherCharge(
            "energy",
            "time",
            Transformation((sympy.S.Zero,) * len(self.system.q), sympy.S.One),
            sympy.S.Zero,
            energy.function,
            energy.conserved,
            sympy.S.Zero if energy.conserved else energy.rate,
            energy.verified,
            enumerated(causes) if self.system.is_continuous else _JUMPS,
        )

    def _same_charge(self, evident: NoetherCharge, candidate: NoetherCharge) -> bool:
        """Whether the candidate's charge is a constant multiple of the evident one's."""
        if evident.conserved is not candidate.conserved:
            return False
        moved = [i for i, c in enumerate(evident.transformation.changes) if c != 0]
        given = candidate.transformation
        factor = given.changes[moved[0]] if moved else -given.time  # Q = -h for Dt = 1
        if factor == 0 or factor.free_symbols - set(self.system.parameters):
            return False
        return is_zero(candidate.charge - factor * evident.charge) is True

    # -- all that is conserved -------------------------------------------------------------

    @cached_property
    def joint_translations(self) -> tuple[NoetherCharge, ...]:
        """Charges of translations of several coordinates, of which none alone is a symmetry.

        sum_j c_j (dL/dq_j, Q_j - dD/dq_j', a_kj) = 0 with constant c: the total momentum
        of block and wedge, of masses that attract each other.
        """
        system, zero = self.system, sympy.S.Zero
        alone = {c.transformation.changes for c in self.cyclic_momenta if c.conserved}
        basis = range(len(system.q))
        unit = [tuple(sympy.S(int(i == j)) for j in basis) for i in basis]
        moved = [j for j, changes in enumerate(unit) if changes not in alone]
        if len(moved) < 2:
            return ()
        work = [
            self.dynamics.lagrange.lagrangian_forces,
            tuple(Q - system.D.diff(v) for Q, v in zip(system.forces, system.qdot, strict=True)),
            *self.dynamics.independent_rows,
        ]
        rows = [[row[j] for j in moved] for row in work]
        found = []
        for vector in constant_nullspace(rows, (*system.q, *system.qdot, system.t)):
            changes = dict(zip(moved, vector, strict=True))
            transformation = Transformation(
                tuple(changes.get(j, zero) for j in range(len(unit))), zero
            )
            found.append(self._judged("", "cyclic", transformation, zero, zero))
        return tuple(charge for charge in found if charge.conserved)

    @cached_property
    def turning_energy(self) -> NoetherCharge | None:
        """The charge of Dt = 1 with a steady translation: the energy in a turning frame.

        c_t dL/dt + sum_j c_j dL/dq_j = 0 and c_t b_k + sum_j c_j a_kj = 0 with constant c:
        h - w p_phi where phi = w t, or where a field turns with w (Jacobi's integral).
        """
        system, zero = self.system, sympy.S.Zero
        acted_on = any(is_zero(Q) is not True for Q in (*system.forces, system.D))
        if self.energy.conserved is not False or acted_on:
            return None
        rows = [[without_jumps(system.L.diff(system.t)), *self.dynamics.lagrange.lagrangian_forces]]
        equations = self.dynamics.constraints.equations
        kept = (equations[k] for k in self.dynamics.independent_constraints)
        rows += [[e.drift, *e.row] for e in kept]
        variables = (*system.q, *system.qdot, system.t)
        steady = (v for v in constant_nullspace(rows, variables) if is_zero(v[0]) is False)
        for vector in steady:
            changes = tuple(c / vector[0] for c in vector[1:])
            charge = self._judged("", "time", Transformation(changes, sympy.S.One), zero, zero)
            return charge if charge.conserved else None
        return None

    def conserved_quantities(self) -> tuple[Expr, ...]:
        """Functions of q, q', t that are constant along the motion."""
        evident = [charge for charge in self.charges if charge.conserved and charge.complete]
        joint = [
            charge
            for charge in self.joint_translations
            if not any(self._same_charge(charge, other) for other in evident)
        ]
        turning = [self.turning_energy] if self.turning_energy is not None else []
        return tuple(charge.charge for charge in (*evident, *joint, *turning))
