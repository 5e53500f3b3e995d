"""The boundary term G of a transformation: K = dG/dt, or the proof that there is none.

Closed forms are tried first, of K and of K - dG0/dt with

    G0 = sum_j p_j(q, 0, t) Dq_j + L(q, 0, t) Dt,

which is all of G where L has a term a(q) . q' of its own: the change of a one-form along a
vector field is d(a . Dq) + i(Dq) da (Cartan).  Euler's operator decides whether a G exists.
With constraints K is taken on the motion, and a G exists where the one-form K dt is closed on
the vectors that the constraints allow.

References
----------
Frankel, *The Geometry of Physics*, 3rd ed., section 4.3 (Cartan's formula).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, nullspace, simplify
from lagcli.algebra.build import TIME
from lagcli.mechanics.constraints import exterior_derivative
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.total_derivative import boundary_integral, boundary_term, euler_operator
from lagcli.record import record


@record
class Gauge:
    """`exists` is None where that was not decided; `term` is None where no G was found."""

    exists: bool | None
    term: Expr | None


class GaugeSearch:
    """The boundary terms of transformations of one system."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = dynamics.system

    def of(self, change: Expr, guess: Expr) -> Gauge:
        """G with dG/dt = change, identically or else with the constraints used.

        Parameters
        ----------
        change
            K.
        guess
            G0, a part that G may have.
        """
        if is_zero(change) is True:
            return Gauge(True, sympy.S.Zero)
        identically = self._closed(change, guess, rules=False)
        exists = True if identically is not None else self._is_total_derivative(change)
        if identically is None and exists:
            identically = self._closed(change, guess, rules=True) or self._integral(change, guess)
        if exists or not self.dynamics.constraints.equations:
            return Gauge(exists, identically)
        return self._on_motion(change, guess)

    def _closed(self, change: Expr, guess: Expr, *, rules: bool) -> Expr | None:
        found = boundary_term(change, self.system, rules=rules)
        if found is not None or is_zero(guess) is True:
            return found
        rest = boundary_term(self._less(change, guess), self.system, rules=rules)
        return None if rest is None else simplify(guess + rest)

    def _integral(self, change: Expr, guess: Expr) -> Expr | None:
        term = boundary_integral(self._less(change, guess), self.system)
        return None if term is None else simplify(guess) + term

    def _less(self, change: Expr, guess: Expr) -> Expr:
        return simplify(change - self.system.total_derivative(guess))

    def _is_total_derivative(self, change: Expr) -> bool | None:
        """Whether Euler's operator annihilates K, by the normal form or at 50 digits."""
        identically_zero = self.dynamics.verifier.identically_zero
        verdicts = [identically_zero(part) for part in euler_operator(change, self.system)]
        return False if False in verdicts else None if None in verdicts else True

    # -- with constraints -------------------------------------------------------------------

    def _on_motion(self, change: Expr, guess: Expr) -> Gauge:
        for given, part in ((change, sympy.S.Zero), (self._less(change, guess), guess)):
            on_motion = self.dynamics.rate_on_motion(given)
            if on_motion is None:
                return Gauge(None, None)
            found = boundary_term(self.dynamics.simplified(on_motion), self.system)
            if found is not None:
                return Gauge(True, part + found)
        on_motion = self.dynamics.rate_on_motion(change)
        assert on_motion is not None
        return Gauge(self._closed_on_surface(on_motion), None)

    def _closed_on_surface(self, change: Expr) -> bool | None:
        """Whether K dt is a closed one-form on the allowed vectors; None where it is none."""
        system, zero = self.system, self.dynamics.verifier.is_zero
        still = dict.fromkeys(system.qdot, sympy.S.Zero)
        slopes = [change.diff(v) for v in system.qdot]
        curved = [slope.diff(v) for slope in slopes for v in system.qdot]
        if any(zero(second).holds is not True for second in curved):
            return self._never_linear(change)
        form = [*(slope.xreplace(still) for slope in slopes), change.xreplace(still)]
        verdicts = [zero(each).holds for each in self._exterior(form)]
        return False if False in verdicts else None

    def _never_linear(self, change: Expr) -> bool | None:
        """A K that is not linear in the allowed velocities is no dG(q, t)/dt: false, or open."""
        kernel = nullspace([list(e.row) for e in self.dynamics.constraints.equations])
        velocities = self.system.qdot
        for pair in combinations_with_replacement(kernel, 2):
            along = change
            for u in pair:
                along = sympy.Add(*(c * along.diff(v) for c, v in zip(u, velocities, strict=True)))
            if self.dynamics.verifier.is_zero(along).holds is False:
                return False
        return None

    def _exterior(self, form: list[Expr]) -> Iterator[Expr]:
        variables = [*self.system.q, TIME]
        rows = [[*e.row, e.drift] for e in self.dynamics.constraints.equations]
        for u, v in combinations([list(x) for x in nullspace(rows)], 2):
            yield exterior_derivative(form, variables, u, v)
