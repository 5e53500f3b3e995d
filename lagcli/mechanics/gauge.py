"""The boundary term G of a transformation: K = dG/dt, or the proof that none exists.

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

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, nullspace, simplify
from lagcli.algebra.build import TIME, free_of, without_jumps
from lagcli.algebra.jumps import is_continuous
from lagcli.mechanics.constraints import ConstraintEquation, exterior_derivative
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.total_derivative import boundary_integral, boundary_term, euler_operator
from lagcli.mechanics.verify import conjunction
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
        found = self._found(change, guess)
        if found.term is None or is_continuous(found.term) or not self.system.is_continuous:
            return found
        return _across_kinks(found.term, (*self.system.q, self.system.t)) or found

    def _found(self, change: Expr, guess: Expr) -> Gauge:
        identically = self._closed(change, guess, rules=False)
        exists = True if identically is not None else self._is_total_derivative(change)
        if identically is None and exists:
            identically = self._closed(change, guess, rules=True) or self._integral(change, guess)
        if exists or not self.dynamics.constraints.equations:
            return Gauge(exists, identically)
        if not self.dynamics.degrees_of_freedom:
            return Gauge(False, None)  # any K is dG/dt where nothing is free: Q is judged as it is
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
        parts = euler_operator(change, self.system)
        return conjunction(map(self.dynamics.verifier.identically_zero, parts))

    # -- with constraints -------------------------------------------------------------------

    def _on_motion(self, change: Expr, guess: Expr) -> Gauge:
        for given, part in ((change, sympy.S.Zero), (self._less(change, guess), guess)):
            on_motion = self.dynamics.rate_on_motion(given)
            if on_motion is None:
                return Gauge(None, None)
            if self.dynamics.verifier.is_zero(on_motion).holds:
                return Gauge(True, part)
            found = boundary_term(self.dynamics.shapes.simplify(on_motion), self.system)
            if found is not None:
                return Gauge(True, part + found)
        on_motion = self.dynamics.rate_on_motion(change)
        assert on_motion is not None
        return Gauge(self._closed_on_surface(self.dynamics.shapes.simplify(on_motion)), None)

    def _closed_on_surface(self, change: Expr) -> bool | None:
        """Whether K dt is a closed one-form on the allowed vectors; None where it is none.

        Where all constraints are integrable, it is then dG on each of their surfaces (Poincare).
        """
        form = self._one_form(change)
        if not isinstance(form, list):
            return form
        zero = self.dynamics.verifier.is_zero
        verdicts = {zero(each).holds for each in self._exterior(form)}
        if False in verdicts or None in verdicts:
            return False if False in verdicts else None
        return None if self.dynamics.constraints.nonholonomic else True

    def _one_form(self, change: Expr) -> list[Expr] | bool | None:
        """The one-form that K dt is for the velocities w + sum c_i u_i that are allowed.

        K = K_0 + s . v + v . H v/2 is linear in the c_i where u_i . H u_j = 0, and is then
        (s + H w) . v + K_0 - w . H w/2 for them.  False where it is not linear; None: undecided.
        """
        velocities, zero = self.system.qdot, sympy.S.Zero
        still = dict.fromkeys(velocities, zero)
        slopes = [change.diff(v) for v in velocities]
        H = [[slope.diff(v) for v in velocities] for slope in slopes]
        free, shift = self._allowed
        for u, v in combinations_with_replacement(free, 2):
            holds = self.dynamics.verifier.is_zero(_product(u, H, v)).holds
            if holds is not True:
                return holds
        if any(entry.free_symbols & {*velocities} for row in H for entry in row):
            return None
        bent = [_product([sympy.S.One], [row], shift) for row in H]
        at_rest = [slope.xreplace(still) + each for slope, each in zip(slopes, bent, strict=True)]
        return [*at_rest, change.xreplace(still) - _product(shift, H, shift) / 2]

    @property
    def _allowed(self) -> tuple[list[list[Expr]], list[Expr]]:
        """Vectors u with A u = 0, and one w with A w + b = 0."""
        kernel = [list(v) for v in nullspace([[*e.row, e.drift] for e in self._independent])]
        shifts = [v for v in kernel if v[-1] != 0]
        free = [v[:-1] for v in kernel if v[-1] == 0]
        first, *others = [[x / v[-1] for x in v[:-1]] for v in shifts]
        free += [[x - y for x, y in zip(v, first, strict=True)] for v in others]
        return free, first

    @property
    def _independent(self) -> list[ConstraintEquation]:
        equations = self.dynamics.constraints.equations
        return [equations[k] for k in self.dynamics.independent_constraints]

    def _exterior(self, form: list[Expr]) -> Iterator[Expr]:
        variables = [*self.system.q, TIME]
        rows = [[*e.row, e.drift] for e in self._independent]
        for u, v in combinations([list(x) for x in nullspace(rows)], 2):
            yield exterior_derivative(form, variables, u, v)


def _across_kinks(term: Expr, moving: Sequence[Symbol]) -> Gauge | None:
    """What is left of a term that jumps where u = 0; None: not decided.

    On either side G is fixed up to a constant: of -F t sign(x), which is G for the force of F |x|,
    the jump 2 F t is none, and no continuous G exists.  That of sign(x) is.
    """
    for step in sorted(term.atoms(sympy.sign), key=str):
        u = step.args[0]
        linear = [q for q in moving[:-1] if free_of(u.diff(q), moving) and u.diff(q) != 0]
        if not linear:
            return None
        there = {linear[0]: simplify(linear[0] - u / u.diff(linear[0]))}
        one, other = (term.xreplace({step: side}) for side in (sympy.S.One, sympy.S.NegativeOne))
        jump = simplify((one - other).xreplace({sympy.Abs(u): sympy.S.Zero}).xreplace(there))
        if any(is_zero(without_jumps(jump.diff(x))) is False for x in moving):
            return Gauge(False, None)
        if not free_of(jump, moving):
            return None
        term = simplify(term - jump * step / 2)
    return Gauge(True, term) if is_continuous(term) else None


def _product(left: Sequence[Expr], matrix: Sequence[Sequence[Expr]], right: Sequence[Expr]) -> Expr:
    """left . matrix right."""
    return sympy.Add(
        *(
            x * entry * y
            for x, row in zip(left, matrix, strict=True)
            for entry, y in zip(row, right, strict=True)
        )
    )
