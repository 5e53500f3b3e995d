"""The energy function, when it is conserved, and when it is the total energy.

    h(q, q', t) = sum_j q_j' dL/dq_j' - L
    dh/dt = -dL/dt + sum_j (Q_j - dD/dq_j') q_j' - sum_k lambda_k b_k

so h is conserved when L does not depend on t explicitly, the applied forces do no work
and no constraint moves.  By Euler's theorem on homogeneous functions

    T = T_0 + T_1 + T_2,  V = V_0 + V_1   =>   h = T_2 - T_0 + V_0

by degree in the velocities: h equals T + V when T = T_2 and V = V_0, and where the
coordinates follow a prescribed motion (T_0, T_1 not 0) T + V may change while h does not.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 2.7.
Landau, Lifshitz, *Mechanics*, 3rd ed., section 6.
"""

from __future__ import annotations

from functools import cached_property

import sympy
from sympy import Expr

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.impacts import when_constant
from lagcli.record import record
from lagcli.statements.answers import Verification
from lagcli.statements.wording import CONSERVED, constraints_named, enumerated


@record
class EnergyRate:
    """One contribution to dh/dt, what it is due to, and what that does in a sentence."""

    cause: str
    deed: str  # a sentence; of the Lagrangian, without its letter
    value: Expr
    of_lagrangian: bool = False


class EnergyFunction:
    """The Jacobi function of a system and its rate on the motion."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics

    @cached_property
    def function(self) -> Expr:
        """h = sum q' p - L."""
        system = self.dynamics.system
        return dot(system.qdot, self.dynamics.lagrange.momenta) - system.L

    @cached_property
    def powers(self) -> tuple[EnergyRate, ...]:
        """The terms of dh/dt that do not vanish identically."""
        system = self.dynamics.system
        forces = dot(system.forces, system.qdot)
        drag = sympy.Add(*map(self._along_velocities, sympy.Add.make_args(system.D)))
        moving = [
            e
            for e in self.dynamics.constraints.equations
            if is_zero(e.multiplier * e.drift) is not True
        ]
        do = "move and do" if len(moving) > 1 else "moves and does"
        named = [e.name for e in moving]
        causes = [
            EnergyRate(
                "the explicit time dependence of L",
                "depends on t explicitly",
                -system.L.diff(system.t),
                of_lagrangian=True,
            ),
            EnergyRate("the applied forces", "the applied forces do work", forces),
            EnergyRate("the dissipation", "the dissipation takes energy", -drag),
            EnergyRate(
                constraints_named("the moving constraint", named),
                f"{constraints_named('the constraint', named)} {do} work",
                -sympy.Add(*(e.multiplier * e.drift for e in moving)),
            ),
        ]
        return tuple(p for p in causes if is_zero(p.value) is not True)

    @cached_property
    def rate(self) -> Expr | None:
        """dh/dt on the motion, simplified; None where it was not found."""
        if not self.dynamics.system.is_continuous:
            return None
        total = sympy.Add(*(power.value for power in self.powers))
        on_motion = self.dynamics.rate_on_motion(total)
        return None if on_motion is None else self.dynamics.shapes.simplify(on_motion)

    @cached_property
    def _verdict(self) -> tuple[bool | None, Verification | None]:
        if not self.powers and self.dynamics.system.is_continuous:
            return True, "exact"
        if not self.dynamics.system.is_continuous:
            return None, None
        if self.rate is None:
            total = sympy.Add(*(power.value for power in self.powers))
            verdict = self.dynamics.vanishes_on_motion(total)
        else:
            verdict = self.dynamics.verifier.is_zero(self.rate)
        return verdict.holds, verdict.how

    @property
    def conserved(self) -> bool | None:
        """Whether dh/dt = 0 on the motion; None where undecided."""
        return self._verdict[0]

    @property
    def verified(self) -> Verification | None:
        """How that was decided."""
        return self._verdict[1]

    @cached_property
    def is_total_energy(self) -> bool | None:
        """Whether h = T + V; None when only L is given."""
        system = self.dynamics.system
        if system.T is None or system.V is None:
            return None
        return self.dynamics.verifier.is_zero(self.function - system.T - system.V).holds

    @property
    def readable_function(self) -> Expr:
        """h as T + V where it is that, and by the terms of L: (n - 1) times one of degree n."""
        system = self.dynamics.system
        if self.is_total_energy and system.T is not None and system.V is not None:
            return system.T + system.V
        return sympy.Add(*map(self._from_term, sympy.Add.make_args(system.L)))

    def _from_term(self, term: Expr) -> Expr:
        """sum v dA/dv - A of a term A of L, part by part where its bracket has several degrees."""
        v = self.dynamics.system.qdot
        moving = [f for f in sympy.Mul.make_args(term) if not free_of(f, v)]
        if len(moving) == 1 and (bracket := moving[0]).is_Add:
            rest = term / bracket
            by_degree: dict[Expr, Expr] = {}
            for part in bracket.args:
                change = self._along_velocities(part)
                degree = simplify(change / part)
                by_degree[degree] = by_degree.get(degree, sympy.S.Zero) + part
            if len(by_degree) > 1 and all(degree.is_Integer for degree in by_degree):
                return sympy.Add(*((n - 1) * rest * part for n, part in by_degree.items()))
        return self._along_velocities(term) - term

    def _along_velocities(self, term: Expr) -> Expr:
        """sum v dA/dv, written n A of a term A of degree n (Euler)."""
        if free_of(term, self.dynamics.system.qdot):
            return sympy.S.Zero
        rate = sympy.Add(*(v * term.diff(v) for v in self.dynamics.system.qdot))
        degree = next((n for n in (1, 2) if is_zero(rate - n * term) is True), None)
        return rate if degree is None else degree * term

    @cached_property
    def quadratic(self) -> bool:
        """Whether T = T_2, homogeneous of degree two in the velocities."""
        T, v = self.dynamics.system.T, self.dynamics.system.qdot
        assert T is not None
        return is_zero(sympy.Add(*(x * T.diff(x) for x in v)) - 2 * T) is True

    @cached_property
    def static_potential(self) -> Expr | None:
        """V_0 where T = T_2 and V = V_0 + V_1 with V_1 not 0, so that h = T + V_0; else None."""
        system = self.dynamics.system
        if system.V is None or free_of(system.V, system.qdot) or not self.quadratic:
            return None
        still = system.V.xreplace(dict.fromkeys(system.qdot, sympy.S.Zero))
        linear = sympy.Add(*(v * system.V.diff(v) for v in system.qdot))
        return still if is_zero(system.V - still - linear) is True else None

    @cached_property
    def driven(self) -> bool:
        """Whether T = T_2 + T_1 + T_0 and not T_2 alone, V = V_0: a motion is prescribed in T."""
        system = self.dynamics.system
        if self.is_total_energy is not False or system.V is None or self.quadratic:
            return False
        entries = [m for row in self.dynamics.lagrange.mass_matrix for m in row]
        return free_of(system.V, system.qdot) and all(free_of(m, system.qdot) for m in entries)

    @cached_property
    def total_rate(self) -> Expr | None:
        """d(T + V)/dt on the motion, simplified; 0 where that is proved, None where unknown."""
        system = self.dynamics.system
        if system.T is None or system.V is None:
            return None
        rate = self.dynamics.rate_on_motion(system.total_derivative(system.T + system.V))
        if rate is None:
            return None
        holds = self.dynamics.verifier.is_zero(rate).holds
        return (
            None
            if holds is None
            else sympy.S.Zero
            if holds
            else self.dynamics.shapes.simplify(rate)
        )

    @property
    def reason(self) -> str:
        """Why h is (not) conserved and equals T + V or not, in a sentence."""
        return f"{self._why_conserved}; {self._why_total}"

    @cached_property
    def when_constant(self) -> str:
        """When h is constant, where the file has contacts; empty without."""
        system = self.dynamics.system
        return when_constant(system, [sympy.S.Zero] * len(system.q), sympy.S.One)

    @property
    def _why_conserved(self) -> str:
        if self.conserved is None:
            return "whether it is conserved was not decided"
        if not self.conserved:
            deeds = (f"L {p.deed}" if p.of_lagrangian else p.deed for p in self.powers)
            return f"not conserved: {enumerated(list(deeds))}"
        when = self.when_constant
        conserved = f"conserved {when}" if when else "conserved"
        if not self.powers:
            return f"{conserved}: {CONSERVED}"
        causes = enumerated([power.cause for power in self.powers])
        together = "cancel" if len(self.powers) > 1 else "vanish"
        return f"{conserved}: on the motion the effects of {causes} {together}"

    @property
    def _why_total(self) -> str:
        system = self.dynamics.system
        if system.T is None or system.V is None:
            given = "L" if system.H is None else "H"
            return f"only {given} is given, so T + V is not known"
        if self.is_total_energy:
            return "it equals T + V"
        if self.static_potential is not None:
            return "it equals T plus V without its terms linear in the velocities"
        reasons = []
        if not free_of(system.V, system.qdot):
            reasons.append("V depends on the velocities")
        if not self.quadratic:
            reasons.append("T is not homogeneous of degree two in the velocities")
        words = "it does not equal T + V" + (": " + " and ".join(reasons) if reasons else "")
        changing = self.conserved and self.driven and self.total_rate not in {None, sympy.S.Zero}
        return f"{words}; T + V is not conserved" if changing else words
