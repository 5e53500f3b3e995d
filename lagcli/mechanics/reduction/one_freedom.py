"""One degree of freedom: energy, turning points, time and period as integrals.

With E = M(q) q'^2/2 + U_eff(q) constant,

    t = integral of dq sqrt(M / (2 (E - U_eff))),    T = 2 x that between the turning points,

which are the roots of U_eff(q) = E.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 11.
"""

from __future__ import annotations

from functools import cached_property

import sympy
from mpmath import mpf
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of, symbol
from lagcli.algebra.equations import solve_for
from lagcli.algebra.numeric import FINE_DIGITS, Evaluator
from lagcli.algebra.place import at
from lagcli.algebra.positivity import sign_of, weak_sign
from lagcli.algebra.real_roots import not_negative_where_real
from lagcli.algebra.signs import sign
from lagcli.algebra.translates import least_period, one_of_each
from lagcli.algebra.vanishing_factors import may_vanish, squares_divided_by
from lagcli.mechanics.inequalities import contradictory
from lagcli.mechanics.parameter_values import admissible_values
from lagcli.mechanics.reduction.routh import Routh
from lagcli.mechanics.reduction.steady_contacts import SteadyContacts
from lagcli.notation.given_formulas import names_of
from lagcli.notation.naming import free

_ZERO = mpf(10) ** -(FINE_DIGITS - 15)
_TRIED = 24
_BOUNDED = (sympy.acos, sympy.asin)


#: What the constant energy is called: the first name that the problem does not use.
ENERGY = ("E", "h", "E_0", "h_0")


class ReducedFreedom:
    """The remaining coordinate q of a reduction with M(q), U_eff(q) and the constant E."""

    def __init__(self, routh: Routh) -> None:
        assert routh.reduced is not None
        self.system = routh.reduced.system
        self.dynamics = routh.reduced.dynamics
        self.q: Symbol = self.system.q[0]
        self.mass: Expr = simplify(self.dynamics.lagrange.mass_matrix[0][0])
        self.potential: Expr = routh.effective_potential
        self.quadratic = routh.quadratic
        self.E: Symbol = symbol(free_name(routh, ENERGY))
        self.contacts = SteadyContacts(routh)

    @cached_property
    def why_not_conserved(self) -> str:
        """Why E is no constant of the motion; empty where it is one."""
        system = self.system
        if is_zero(system.L.diff(system.t)) is not True:
            return "R depends explicitly on the time"
        if not system.is_continuous:
            return "R may jump, with an impulse that is not in the equations"
        if is_zero(system.applied_forces[0]) is not True:
            return "a force that is not in L acts"
        return ""

    @cached_property
    def negative(self) -> bool:
        """Whether the kinetic energy is: the motion then is about the maxima of U_eff."""
        return sign(self.mass) == -1

    @cached_property
    def energy(self) -> Expr:
        """M q'^2/2 + U_eff; q' dR/dq' - R of another R."""
        [v] = self.system.qdot
        if self.quadratic:
            return self.mass * v**2 / 2 + self.potential
        return simplify(v * self.system.L.diff(v) - self.system.L)

    @cached_property
    def pace(self) -> Expr | None:
        """(dt/dq)^2 where R is not quadratic in q': E solved for its one root, then for q'."""
        [v] = self.system.qdot
        powers = {
            p for p in self.energy.atoms(sympy.Pow) if p.exp.is_Rational and not free_of(p, [v])
        }
        roots = [p for p in powers if not p.exp.is_Integer]
        if len({p.base for p in roots}) != 1 or any(p.exp.q != 2 for p in roots):
            return None
        root = sympy.Dummy(positive=True)
        energy = self.energy.xreplace({p: root**p.exp.p for p in roots})
        solved = solve_for(energy - self.E, root) if free_of(energy, [v]) else None
        if solved is None or len(solved.values) != 1:
            return None
        velocities = solve_for(roots[0].base - solved.values[0] ** 2, v)
        squares = {simplify(x**2) for x in velocities.values} if velocities else set()
        return simplify(1 / squares.pop()) if len(squares) == 1 else None

    @property
    def turning_points(self) -> tuple[Expr, ...] | None:
        """The roots of U_eff = E, each by substitution; None without a closed form.

        Those at which a one-sided contact would have to pull are left out.
        """
        return None if self._roots is None else tuple(self._reached)

    @property
    def leaves_out(self) -> bool:
        """Whether there are roots at which a one-sided contact would have to pull."""
        return len(self._roots or ()) > len(self._reached)

    @cached_property
    def length(self) -> Expr | None:
        """The period of the coordinate where that is no angle: one root of each is listed."""
        period = least_period([self.potential, self.mass], self.q)
        return None if period is None or period.is_number else period

    @property
    def finite_where(self) -> list[Expr]:
        """What must be positive, besides for real roots, for no turning point to be at infinity.

        And the only one of a coordinate that is positive, where it is no root: −k/E.
        """
        found, points = set[Expr](), self.turning_points or ()
        if self.q.is_positive and len(points) == 1 and not [*not_negative_where_real(points[0])]:
            return [] if sign_of(points[0], ()) == 1 else [points[0]]
        for root in points:
            real = [*not_negative_where_real(root)]
            powers = (p for p in root.atoms(sympy.Pow) if p.exp.is_Integer and p.exp.is_negative)
            found |= {p.base for p in powers if sign_of(p.base**2, real) != 1}
            found |= self._value_where(root)
        return [d**2 for d in sorted(found, key=sympy.default_sort_key)]

    def _value_where(self, root: Expr) -> set[Expr]:
        """Parameters whose value 0 takes a root to where U_eff is 0/0: p in p^2/sin^2 q = E."""
        below = (at(d, {self.q: root}) for d in squares_divided_by([self.potential]))
        found = {f for value in below if value != 0 for f in may_vanish(simplify(value))}
        return {f for f in found if free_of(f, [self.E])}

    @property
    def turning_where(self) -> tuple[tuple[Expr, ...], ...]:
        """What must be positive for the one-sided contacts to hold at each turning point."""
        return tuple(self._reached.values())

    @property
    def bounds(self) -> list[Expr]:
        """What is positive between the `turning_energies`."""
        return [x for low, high in self.turning_energies for x in (self.E - low, high - self.E)]

    @cached_property
    def _reached(self) -> dict[Expr, tuple[Expr, ...]]:
        bounds, reached = self.bounds, {}
        for root in self._roots or ():
            where = self.contacts.where_pressed({self.q: root})
            if where is None:
                continue
            real = [*not_negative_where_real(root)]  # d + sqrt(2 E/k) > 0 needs no condition
            signs = {each: sign_of(each, real) for each in where}
            open_ = tuple(each for each, known in signs.items() if known != 1)
            excluded = -1 in signs.values() or (open_ and contradictory((*open_, *bounds)))
            if not excluded:
                reached[root] = open_
        return reached

    @cached_property
    def _roots(self) -> tuple[Expr, ...] | None:
        excess = self.potential - self.E
        if free_of(self.potential, [self.q]):
            return ()
        values = self._on_both_sides(excess) if excess.has(sympy.Abs(self.q)) else None
        found = solve_for(excess, self.q) if values is None else None
        if values is None and found is None:
            return None
        roots = [simplify(root) for root in values or (found.values if found else ())]
        period = least_period([self.potential, self.mass], self.q)
        roots = roots if period is None else one_of_each(roots, period)
        roots = [
            root for k, root in enumerate(roots)
            if not (self._excluded(root) or any(simplify(root - x) == 0 for x in roots[:k]))
        ]  # fmt: skip
        return tuple(roots) if all(self._is_root(root, excess) for root in roots) else None

    def _on_both_sides(self, excess: Expr) -> list[Expr] | None:
        """The roots of a potential with |q|, those of q > 0 and of q < 0."""
        size, roots = sympy.Dummy("q", positive=True), list[Expr]()
        for side in (-1, 1):
            found = solve_for(excess.xreplace({self.q: side * size}), size)
            if found is None:
                return None
            for root in found.values:
                if root.has(sympy.sign(self.E)):  # (E/A)^(1/3) is positive where E is
                    above = sympy.Dummy(positive=True)
                    root = simplify(root.xreplace({self.E: above})).xreplace({above: self.E})
                roots += [side * root] if weak_sign(root) != -1 else []
        return roots

    @cached_property
    def turning_energies(self) -> tuple[tuple[Expr, Expr], ...]:
        """The range of E for which acos and asin in all turning points are real.

        -1 <= (E - b)/a <= 1 just for b - |a| <= E <= b + |a|, 0 <= sqrt((E - b)/a) <= 1 for
        E between b and b + a.
        """
        if self.negative:  # what does not turn back has a smaller E
            return ()
        arguments = {f.args[0] for root in self._roots or () for f in root.atoms(*_BOUNDED)}
        ranges: dict[tuple[Expr, Expr], None] = {}
        for argument in arguments:
            least = -1
            if any(not free_of(p, [self.E]) and p.exp == S.Half for p in argument.atoms(sympy.Pow)):
                argument, least = simplify(argument**2), 0
            slope = simplify(argument.diff(self.E))
            direction = sign(slope)
            if not free_of(slope, [self.E]) or direction not in (1, -1):
                return ()
            start = simplify(-(argument - self.E * slope) / slope)
            ends = [simplify(start + end / slope) for end in (least, 1)]
            ranges[*(ends if direction == 1 else reversed(ends))] = None
        return tuple(ranges) if len(ranges) == 1 else ()

    def _excluded(self, root: Expr) -> bool:
        """Whether the assumptions rule the value out: it has the wrong sign, or is nowhere real."""
        if self.q.is_nonnegative and weak_sign(root) == -1:
            return True
        real = [*not_negative_where_real(root)]
        if any(sign_of(each, [x for x in real if x != each]) == -1 for each in real):
            return True  # sqrt(-k - sqrt(k² + 4 b E))
        return bool(self.q.is_nonzero and root.is_zero)

    def _is_root(self, root: Expr, excess: Expr) -> bool:
        """Exactly, or at 60 digits at admissible parameters where the root is real."""
        residual = at(excess, {self.q: root})
        if is_zero(residual) is True:
            return True
        evaluate = Evaluator([residual, root], FINE_DIGITS)
        tested = 0
        for values in admissible_values(self.system, _TRIED):
            found = evaluate.where_defined({**values, self.E: mpf(7) / 11})
            if found is not None and isinstance(found[1], mpf):
                tested += 1
                if abs(found[0]) > _ZERO:
                    return False
        return tested > 0


def free_name(routh: Routh, choices: tuple[str, ...]) -> str:
    """The first name that the problem does not use."""
    assert routh.reduced is not None
    used = names_of(routh.full.problem)
    used.add(*routh.reduced.system.order)
    return free(used, *choices)
