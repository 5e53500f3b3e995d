"""The motion solved: accelerations, multipliers, constraint forces, each verified.

    [ M  -A^T ] [ q''    ]   [ forcing ]
    [ A    0  ] [ lambda ] = [ -bias   ]

Redundant rows of A are left out by rank; then q'' and the total constraint force
A^T lambda are still unique, and a multiplier is determined when no combination of rows
that vanishes has a part in it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import cached_property
from itertools import combinations

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra import Shapes, dot, is_zero, left_nullspace, nullspace, simplify, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.entry import Field
from lagcli.algebra.ideal import Ideal
from lagcli.algebra.linear import LinearSolution
from lagcli.algebra.numeric import DIGITS
from lagcli.algebra.row_rank import independent_rows
from lagcli.algebra.signs import sign
from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.expression import ZERO
from lagcli.mechanics.by_multipliers import by_multipliers
from lagcli.mechanics.constraints import Constraints
from lagcli.mechanics.euler_lagrange import EulerLagrange
from lagcli.mechanics.motion_at_states import MotionAtStates
from lagcli.mechanics.states import Contradiction, RandomStates
from lagcli.mechanics.system import System
from lagcli.mechanics.verify import Verifier, ZeroVerdict
from lagcli.record import record
from lagcli.statements.answers import Verification

#: Beyond this many unknowns a symbolic solution is no longer readable: matrix form only.
READABLE_UNKNOWNS = 12
#: Minors of gradients that are looked at where no state was found: 3 of 6 coordinates.
_MOST_MINORS = 20


def _quoted(names: Iterable[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)


@record
class SolvedMotion:
    """The solved system.

    Attributes
    ----------
    accelerations : tuple of Expr
        q'' by coordinate, free of accelerations and multipliers.
    multipliers : tuple of Expr or None
        By constraint; None where redundancy leaves it undetermined.
    independent : tuple of Expr
        One valid choice of all multipliers (0 for the redundant ones), so that
        A^T lambda is the total constraint force.
    verified : how the solution was checked by substitution.
    """

    accelerations: tuple[Expr, ...]
    multipliers: tuple[Expr | None, ...]
    independent: tuple[Expr, ...]
    verified: Verification


class Dynamics:
    """The equations of a system with its constraints, and their solution."""

    def __init__(self, system: System) -> None:
        self.system = system
        self.constraints = Constraints(system)
        self.lagrange = EulerLagrange(system)
        self.states = RandomStates(system, self.constraints)
        self.verifier = Verifier(self.constraints, self.states)

    # -- rank ---------------------------------------------------------------------------

    @cached_property
    def independent_constraints(self) -> tuple[int, ...]:
        """Indices of the constraints that are not implied by earlier ones.

        Raises
        ------
        ProblemError
            When the constraints contradict each other.
        """
        if not self.constraints.equations:
            return ()
        try:
            self.states.take(1)
        except Contradiction as contradiction:
            raise self._contradiction(contradiction.index) from None
        assert self.states.elimination is not None
        return self.states.elimination.independent

    @property
    def independent_rows(self) -> list[tuple[Expr, ...]]:
        """Their rows of A: of (z - x^2) (y - 2) = 0 beside z = x^2 the row is 0 on the surface."""
        return [self.constraints.jacobian[k] for k in self.independent_constraints]

    def _contradiction(self, index: int) -> ProblemError:
        """What is wrong where no state was found at which all constraints hold.

        Only what is proved is called a contradiction.
        """
        index = next(iter(self._without_zero), max(index, 0))
        constraint = self.system.problem.constraints[index]
        others = [c.name for c in self.system.problem.constraints if c is not constraint]
        with_what = " with " + _quoted(others) if others else ""
        above = sympy.numer(sympy.together(self.constraints.equations[index].f))
        if index in self._without_zero:
            message = f"constraint '{constraint.name}' cannot be satisfied"
            hint = "it holds nowhere"
        elif any(power > 1 for _, power in sympy.factor_list(above)[1]):
            message = f"the derivatives of constraint '{constraint.name}' vanish where it holds"
            hint = "write it without the power"
        elif self._contradict:
            message = f"constraint '{constraint.name}' cannot be satisfied{with_what}"
            hint = "they contradict each other"
        elif len(names := self._dependent_where_all_hold) == 1:
            message = (
                f"the derivatives of constraint '{names[0]}' vanish where all constraints hold"
            )
            hint = "write it without a power or a factor, or leave it out where the others imply it"
        elif names:
            message = f"constraints {_quoted(names)} hold together only where they touch"
            hint = "their derivatives depend on each other there: write the place itself, as x = 0"
        else:
            message = f"no state was found at which constraint '{constraint.name}' holds{with_what}"
            hint = "check the signs and the numbers in it"
        if constraint.equation.right == ZERO and not constraint.equation.right.span.line:
            hint += ": without '=' it means = 0"
        return ProblemError(
            self.system.problem.source, (Diagnostic(message, constraint.equation.span, hint),)
        )

    @cached_property
    def _without_zero(self) -> Sequence[int]:
        """Constraints that hold nowhere, as 1 + x² = 0."""
        equations = enumerate(self.constraints.equations)
        return [k for k, e in equations if e.holonomic and sign(e.f) in (1, -1)]

    @property
    def _contradict(self) -> bool:
        """Whether the constraints are seen to hold nowhere together, for general parameters.

        1 is in the ideal of their forms and of those on the velocities, a . q' + b.
        """
        equations = self.constraints.equations
        forms = [e.f for e in equations if e.holonomic]
        moving = [dot(e.row, self.system.qdot) + e.drift for e in equations]
        return self._exclude(forms) or self._exclude([*forms, *moving], *self.system.qdot)

    @property
    def _dependent_where_all_hold(self) -> Sequence[str]:
        """The fewest constraints with dependent gradients wherever all hold, none if not seen.

        z (z - x) = 0 has the gradient 0 where x = 0 holds beside it; a sphere and a tangent plane
        have parallel ones.  A minor vanishes where all hold if 1 is in their ideal with 1 - w a
        (Rabinowitsch).
        """
        equations, w = self.constraints.equations, sympy.Dummy("w")
        forms = [e.f for e in equations]
        if len(forms) < 2 or not all(e.holonomic for e in equations):
            return ()
        for size in range(1, len(forms) + 1):
            for chosen in combinations(equations, size):
                minors = self._minors([e.row for e in chosen])
                if minors and all(self._exclude([*forms, 1 - w * a], w) for a in minors):
                    return [e.name for e in chosen]
        return ()

    def _minors(self, rows: Sequence[Sequence[Expr]]) -> list[Expr]:
        """Those that are not 0 of the largest minors of some rows, none if there are too many."""
        used = [j for j in range(len(self.system.q)) if any(row[j] != 0 for row in rows)]
        if math.comb(len(used), len(rows)) > _MOST_MINORS:
            return []
        every = [
            determinant([[row[j] for j in at] for row in rows])
            for at in combinations(used, len(rows))
        ]
        return [] if None in every else [a for a in map(simplify, filter(None, every)) if a != 0]

    def _exclude(self, forms: Sequence[Expr], *more: Symbol) -> bool:
        """Whether the forms are seen to have no common zero, for general parameters."""
        field = Field(forms)
        try:
            above = [field(form).numerator for form in forms]
        except ZeroDivisionError:
            return False
        ranked = [
            number for number, generator in enumerate(field.generators)
            if not free_of(generator.expression, [*more, *self.system.q])
        ]  # fmt: skip
        return Ideal(field, above, ranked).is_whole

    @property
    def redundant(self) -> tuple[str, ...]:
        """The constraints that earlier ones imply."""
        kept = set(self.independent_constraints)
        return tuple(e.name for i, e in enumerate(self.constraints.equations) if i not in kept)

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        return len(self.system.q) - len(self.independent_constraints)

    @cached_property
    def degenerate(self) -> tuple[int, ...]:
        """Coordinates along which the Hessian of L is singular (a null vector has a part)."""
        try:
            kernel = nullspace(self.lagrange.mass_matrix)
        except ArithmeticError:  # entries too long: nothing is known of them
            return ()
        return tuple(
            i
            for i in range(len(self.system.q))
            if any(is_zero(vector[i]) is not True for vector in kernel)
        )

    @cached_property
    def undetermined(self) -> tuple[int, ...]:
        """The degenerate coordinates, where constraints do not determine q'' either.

        A massless link has no part in the kinetic energy; M and A together determine its motion.
        """
        return () if self._determined_by_constraints else self.degenerate

    @property
    def _determined_by_constraints(self) -> bool:
        """Whether [[M, -A^T], [A, 0]] has full rank at a random state, dependent rows left out."""
        if not self.independent_constraints:
            return False
        with mpmath.workdps(DIGITS):
            square = self._at_states.rows(self.states.take(1)[0])
            return not independent_rows(square, mpf(10) ** -25).dependent

    @cached_property
    def contradiction(self) -> Expr | None:
        """A number, not 0, that the equations of motion demand to be 0: there is no motion."""
        if self.constraints.equations:
            return None
        for vector in nullspace(self.lagrange.mass_matrix):
            parts = zip(vector, self.lagrange.forcing, strict=True)
            left = simplify(sympy.Add(*(-v * f for v, f in parts)))
            if left != 0 and free_of(left, (*self.system.q, *self.system.qdot, self.system.t)):
                return left
        return None

    @cached_property
    def shapes(self) -> Shapes:
        """The readable forms on the constraint surface."""
        return Shapes(self.system.order, self.constraints.relations)

    # -- solution -------------------------------------------------------------------------

    @cached_property
    def motion(self) -> SolvedMotion | None:
        """The verified solution; None where the system is singular or too large."""
        kept, n, solution = self.independent_constraints, len(self.system.q), self._solution
        if solution is None or solution.singular:
            return None
        chosen = [sympy.S.Zero] * len(self.constraints)
        for k, value in zip(kept, solution.values[n:], strict=True):
            chosen[k] = value
        found, equations = tuple(solution.values[:n]), self.constraints.equations
        accelerations = by_multipliers(self.lagrange, equations, found, chosen, self.shapes)
        verified = self._verified(accelerations, tuple(chosen))
        if verified is None:
            return None
        undetermined = self._undetermined
        multipliers = tuple(None if k in undetermined else value for k, value in enumerate(chosen))
        return SolvedMotion(accelerations, multipliers, tuple(chosen), verified)

    @property
    def singular(self) -> bool:
        """Whether the linear equations for q'' and the multipliers are known to be singular."""
        return self._solution is not None and self._solution.singular

    @cached_property
    def _solution(self) -> LinearSolution | None:
        """q'' and the multipliers of independent constraints; None where they are too many."""
        if len(self.system.q) + len(self.independent_constraints) > READABLE_UNKNOWNS:
            return None
        matrix, right = self._bordered
        return solve_linear(matrix, right, shapes=self.shapes)

    @property
    def _bordered(self) -> tuple[list[list[Expr]], list[Expr]]:
        """[[M, -A^T], [A, 0]] and (forcing, -bias), dependent rows left out."""
        rows = [self.constraints.equations[k] for k in self.independent_constraints]
        none = [sympy.S.Zero] * len(rows)
        M = self.lagrange.mass_matrix
        matrix = [[*line, *(-e.row[i] for e in rows)] for i, line in enumerate(M)]
        matrix += [[*e.row, *none] for e in rows]
        return matrix, [*self.lagrange.forcing, *(-e.bias for e in rows)]

    @property
    def without_reactions(self) -> bool:
        """Whether velocity constraints hold by themselves: each multiplier is 0 on the motion."""
        on_velocities = not any(e.holonomic for e in self.constraints.equations)
        known = () if self.motion is None else self.motion.multipliers
        return on_velocities and bool(known) and all(value == 0 for value in known)

    @cached_property
    def determined_multipliers(self) -> tuple[tuple[Expr | None, ...], Verification | None]:
        """Those that the equations determine though q'' is not, and how that was verified."""
        nothing = (None,) * len(self.constraints), None
        if self.motion is not None or not self.constraints.equations:
            return nothing
        matrix, right = self._bordered
        if len(right) > READABLE_UNKNOWNS or self.redundant or not self.undetermined:
            return nothing
        from lagcli.mechanics.partly_determined import determined_unknowns

        state = self.states.take(1)[0]
        found = determined_unknowns(matrix, right, state, self.verifier, self.shapes)
        if found is None:
            return nothing
        return tuple(found[0][len(self.system.q) :]), found[1].how

    @cached_property
    def _undetermined(self) -> frozenset[int]:
        """Constraints that take part in a combination of rows that vanishes."""
        if not self.redundant:
            return frozenset()
        relations = self.constraints.relations
        vectors = left_nullspace(self.constraints.jacobian, relations)
        return frozenset(
            k
            for vector in vectors
            for k, entry in enumerate(vector)
            if is_zero(entry, relations) is not True
        )

    def _verified(
        self, accelerations: tuple[Expr, ...], multipliers: tuple[Expr, ...]
    ) -> Verification | None:
        """Substitute back: M q'' - forcing - A^T lambda = 0 and A q'' + bias = 0."""
        equations = self.constraints.equations
        pairs = zip(self.lagrange.mass_matrix, self.lagrange.forcing, strict=True)
        residuals = [
            dot(row, accelerations) - force - dot((e.row[i] for e in equations), multipliers)
            for i, (row, force) in enumerate(pairs)
        ]
        residuals += [dot(e.row, accelerations) + e.bias for e in equations]
        verdict = self.verifier.all_zero(residuals)
        return verdict.how if verdict.holds is True else None

    @cached_property
    def constraint_forces(self) -> tuple[tuple[Expr, ...] | None, ...]:
        """lambda_k a_kj by constraint and coordinate; None where lambda_k is undetermined."""
        if self.motion is None:
            return (None,) * len(self.constraints)
        return tuple(
            None
            if value is None
            else tuple(self.shapes.combination([value], [a]) for a in equation.row)
            for equation, value in zip(
                self.constraints.equations, self.motion.multipliers, strict=True
            )
        )

    @cached_property
    def total_constraint_force(self) -> tuple[Expr, ...] | None:
        """sum_k lambda_k a_kj, unique also where single multipliers are not."""
        if self.motion is None:
            return None
        equations = self.constraints.equations
        return tuple(
            self.shapes.combination(self.motion.independent, [e.row[j] for e in equations])
            for j in range(len(self.system.q))
        )

    # -- on the motion ----------------------------------------------------------------------

    def rate_on_motion(self, rate: Expr) -> Expr | None:
        """Like `on_motion`, for a rate, in which the constraints act only by their total force.

        Then one valid choice of the multipliers gives the value also where redundancy leaves
        the single ones undetermined.
        """
        if self.motion is None:
            return self.on_motion(rate)
        chosen = zip(self.constraints.equations, self.motion.independent, strict=True)
        return self.on_motion(rate.xreplace({e.multiplier: value for e, value in chosen}))

    def vanishes_on_motion(self, rate: Expr) -> ZeroVerdict:
        """Whether a rate is 0 on the motion, in numbers where the motion has no formulas."""
        on_motion = self.rate_on_motion(rate)
        if on_motion is not None:
            return self.verifier.is_zero(on_motion)
        if self.undetermined:
            return ZeroVerdict(None, None)
        holds = self.verifier.vanishes_at_random_states([rate], self._at_states.along)
        return ZeroVerdict(holds, None if holds is None else "50 digits" if holds else "exact")

    @cached_property
    def _at_states(self) -> MotionAtStates:
        """The motion in numbers, where the equations determine it."""
        rows = [self.constraints.equations[k] for k in self.independent_constraints]
        return MotionAtStates(self.lagrange, rows)

    def on_motion(self, expression: Expr) -> Expr | None:
        """The expression with accelerations and multipliers replaced by their solution."""
        present = expression.free_symbols
        if not present & {*self.system.qddot, *self.system.multipliers}:
            return expression
        values: dict[Expr, Expr] = {}
        multipliers = self.determined_multipliers[0]
        if self.motion is not None:
            values.update(zip(self.system.qddot, self.motion.accelerations, strict=True))
            multipliers = self.motion.multipliers
        for equation, value in zip(self.constraints.equations, multipliers, strict=True):
            if value is not None:
                values[equation.multiplier] = value
        replaced = expression.xreplace(values)
        unknown = {*self.system.qddot, *self.system.multipliers}
        return None if replaced.free_symbols & unknown else replaced
