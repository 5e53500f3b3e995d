"""The energy function, when it is conserved, and when it is the total energy.

    h(q, q', t) = sum_j q_j' dL/dq_j' - L
    dh/dt = -dL/dt + sum_j (Q_j - dD/dq_j') q_j' - sum_k lambda_k b_k

so h is conserved when L does not depend on t explicitly, the applied forces do no work
and no constraint moves.  It is T + V when T is homogeneous of degree two in the
velocities and V does not depend on them.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., section 2.7.
Landau, Lifshitz, *Mechanics*, 3rd ed., section 6.
"""

from __future__ import annotations

from functools import cached_property

import sympy
from sympy import Expr

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.answers import Verification
from lagcli.mechanics.dynamics import Dynamics
from lagcli.record import record


@record
class Power:
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
        return sympy.Add(
            *(v * p for v, p in zip(system.qdot, self.dynamics.lagrange.momenta, strict=True)),
            -system.L,
        )

    @cached_property
    def powers(self) -> tuple[Power, ...]:
        """The terms of dh/dt that do not vanish identically."""
        system = self.dynamics.system
        forces = sympy.Add(*(f * v for f, v in zip(system.forces, system.qdot, strict=True)))
        drag = sympy.Add(*(v * system.D.diff(v) for v in system.qdot))
        causes = [
            Power(
                "the time in L",
                "depends explicitly on the time",
                -system.L.diff(system.t),
                of_lagrangian=True,
            ),
            Power("the applied forces", "the applied forces do work", forces),
            Power("the dissipation", "the dissipation takes energy", -drag),
            *(
                Power(
                    f"the moving constraint '{e.name}'",
                    f"the constraint '{e.name}' moves and does work",
                    -e.multiplier * e.drift,
                )
                for e in self.dynamics.constraints.equations
            ),
        ]
        return tuple(p for p in causes if is_zero(p.value) is not True)

    @cached_property
    def rate(self) -> Expr | None:
        """dh/dt on the motion, simplified; None where the multipliers were not found."""
        total = sympy.Add(*(power.value for power in self.powers))
        on_motion = self.dynamics.rate_on_motion(total)
        return None if on_motion is None else self.dynamics.simplified(on_motion)

    @cached_property
    def _verdict(self) -> tuple[bool | None, Verification | None]:
        if not self.powers:
            return True, "exact"
        if self.rate is None:
            return None, None
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
        """h, as T + V where it is that."""
        system = self.dynamics.system
        if self.is_total_energy and system.T is not None and system.V is not None:
            return system.T + system.V
        return self.function

    @property
    def reason(self) -> str:
        """Why h is (not) conserved and is (not) T + V, in a sentence."""
        return f"{self._why_conserved}; {self._why_total}"

    @property
    def _why_conserved(self) -> str:
        if self.conserved is None:
            return "whether it is conserved was not decided"
        if not self.conserved:
            deeds = (f"L {p.deed}" if p.of_lagrangian else p.deed for p in self.powers)
            return "not conserved: " + ", ".join(deeds)
        if not self.powers:
            return "conserved: no explicit time in L, no force that does work, no moving constraint"
        return (
            "conserved: on the motion the powers cancel ("
            + ", ".join(power.cause for power in self.powers)
            + ")"
        )

    @property
    def _why_total(self) -> str:
        system = self.dynamics.system
        if system.T is None or system.V is None:
            given = "L" if system.H is None else "H"
            return f"only {given} is given, so T + V is not known"
        if self.is_total_energy:
            return "it is T + V"
        reasons = []
        if not free_of(system.V, system.qdot):
            reasons.append("V depends on the velocities")
        degree_two = sympy.Add(*(v * system.T.diff(v) for v in system.qdot)) - 2 * system.T
        if is_zero(degree_two) is not True:
            reasons.append("T is not homogeneous of degree two in the velocities")
        return "it is not T + V" + (": " + " and ".join(reasons) if reasons else "")
