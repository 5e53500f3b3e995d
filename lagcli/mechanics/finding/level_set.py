"""The states that share constraints and conserved quantities with the initial state.

    f(q, t) = 0,  A q' + b = 0,  Q_k(q, q', t) = Q_k(initial state)

A velocity constraint that is a derivative in disguise, dF/dt = 0, adds F = F(initial).
The motion stays in this set, so an identity that holds on it holds along the motion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.numeric import FINE_DIGITS, Evaluator
from lagcli.algebra.row_rank import independent_rows, least_norm_solution
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.initial import InitialState
from lagcli.mechanics.noether import Noether
from lagcli.mechanics.states import Contradiction, State
from lagcli.mechanics.total_derivative import boundary_term

_NEWTON_STEPS = 140  # at a double root, as of v^2 = 0, each step halves the distance
_PATIENCE = 8  # steps within which what is left must halve
_ON_IT = mpf(10) ** -52
_TRIES = 12


class LevelSet:
    """Relations along the motion from one initial state (constraints only, without one)."""

    def __init__(self, dynamics: Dynamics, noether: Noether, initial: InitialState | None) -> None:
        self.dynamics = dynamics
        self.noether = noether
        self.system = dynamics.system
        self.initial = initial

    @cached_property
    def constraints(self) -> tuple[Expr, ...]:
        """f and A q' + b."""
        constraints = self.dynamics.constraints
        positions = [e.f for e in constraints.equations if e.holonomic]
        return (*positions, *constraints.velocity_forms)

    @cached_property
    def laws(self) -> tuple[Expr, ...]:
        """Q - Q(initial), those without explicit time first."""
        if self.initial is None:
            return ()
        laws = self._since_start(
            [
                *self._integrals_of_constraints(),
                *self.noether.conserved_quantities(),
                *self._integrals_of_accelerations(),
            ]
        )
        laws += self._since_start(self._integrals_of_laws(laws))
        return tuple(sorted(laws, key=lambda law: not free_of(law, [self.system.t])))

    def _integrals_of_constraints(self) -> list[Expr]:
        """F with dF/dt = A q' + b, for velocity constraints that are derivatives."""
        constraints = self.dynamics.constraints
        found = [
            boundary_term(form, self.system)
            for equation, form in zip(
                constraints.equations, constraints.velocity_forms, strict=True
            )
            if not equation.holonomic
        ]
        return [F for F in found if F is not None]

    def _integrals_of_accelerations(self) -> list[Expr]:
        """q' - B where q'' = dB/dt: y' + g t of a fall, x' + k x of a drag -m k x'."""
        system, found = self.system, []
        if not self._are_lasting:
            return []
        for acceleration, rate in zip(system.qddot, system.qdot, strict=True):
            formula = self.dynamics.on_motion(acceleration)
            if formula is None or formula == 0:
                continue
            velocity = boundary_term(formula, system, rules=False)
            if velocity is not None:
                found.append(rate - velocity)
        return found

    def _integrals_of_laws(self, laws: Sequence[Expr]) -> list[Expr]:
        """F(q, t) with dF/dt = Q - Q(initial): where the centre of mass is."""
        velocities = self.system.qdot
        linear = [
            law
            for law in laws
            if not free_of(law, velocities)
            and all(free_of(law.diff(v), velocities) for v in velocities)
        ]
        found = [boundary_term(law, self.system) for law in linear]
        timed = self._are_lasting
        return [F for F in found if F is not None and (timed or free_of(F, [self.system.t]))]

    @property
    def _are_lasting(self) -> bool:
        """Whether the same equations hold at all times: no impact, no contact that is lost."""
        problem = self.system.problem
        return not problem.contacts and all(c.holds_while is None for c in problem.constraints)

    def _since_start(self, quantities: Sequence[Expr]) -> list[Expr]:
        """Q - Q(initial), where that says something."""
        assert self.initial is not None
        laws = [
            quantity - simplify(self.initial.at(quantity, self.system.t)) for quantity in quantities
        ]
        return [law for law in laws if law.is_finite is not False and is_zero(law) is not True]

    @cached_property
    def relations(self) -> tuple[Expr, ...]:
        """All of them, each 0 on the motion."""
        return (*self.constraints, *self.laws)

    # -- states on it ----------------------------------------------------------------------

    def states(self, count: int, values: Mapping[Symbol, mpf] | None = None) -> list[State]:
        """Up to `count` real states of the set at 50 digits, fewer where none were found.

        Parameters
        ----------
        values
            Numbers for parameters (and the time); random ones for those without.
        """
        found: list[State] = []
        for taken in range(1, _TRIES + 1):
            try:
                state = dict(self.dynamics.states.take(taken)[-1])
            except Contradiction:
                break
            state.update(values or {})
            if self._newton(state):
                found.append(state)
                if len(found) == count:
                    break
        return found

    @cached_property
    def _unknowns(self) -> tuple[Symbol, ...]:
        return (*self.system.q, *self.system.qdot)

    @cached_property
    def _plan(self) -> Evaluator:
        rows = [r.diff(x) for r in self.relations for x in self._unknowns]
        return Evaluator([*self.relations, *rows], FINE_DIGITS)

    def _newton(self, state: State) -> bool:
        """Move q and q' onto the set by steps of least norm."""
        if not self.relations:
            return True
        with mpmath.workdps(FINE_DIGITS):
            sizes: list[mpf] = []
            for _ in range(_NEWTON_STEPS):
                try:
                    flat = self._plan(state)
                    if not all(isinstance(x, mpf) and mpmath.isfinite(x) for x in flat):
                        return False
                    step = self._step(flat)
                except (ArithmeticError, ValueError):
                    return False
                if step is None:
                    return True
                sizes.append(max(map(abs, flat[: len(self.relations)])))
                if len(sizes) > _PATIENCE and sizes[-1] > sizes[-_PATIENCE] / 2:
                    return False
                longest = max(map(abs, step))
                if longest == 0:
                    return False
                shrink = min(mpf(1), 1 / longest)
                for x, delta in zip(self._unknowns, step, strict=True):
                    state[x] += shrink * delta
        return False

    def _step(self, flat: Sequence[mpf]) -> list[mpf] | None:
        """The Newton step; None where the state is on the set already."""
        m, n = len(self.relations), len(self._unknowns)
        values = flat[:m]
        rows = [flat[m + i * n : m + (i + 1) * n] for i in range(m)]
        scale = [max(mpf(1), *map(abs, row)) for row in rows]
        if all(abs(v) < _ON_IT * s for v, s in zip(values, scale, strict=True)):
            return None
        kept = independent_rows(rows, mpf(10) ** -15).independent
        if not kept:
            return [mpf(0)] * n
        return least_norm_solution([rows[i] for i in kept], [-values[i] for i in kept])
