"""The initial state: what the file gives at t = 0, what the constraints add, else 0.

The positions come first, from f(q, 0) = 0, then the velocities, from A q' + b = 0.  A
value that no equation determines is 0.  Two values that satisfy the constraints equally
well, as y = +-sqrt(l^2 - x^2), determine nothing: then the file must say which.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mpmath
from mpmath import mpf
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.entry import Field
from lagcli.algebra.linear import nullspace
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.polynomial_roots import polynomial_roots
from lagcli.diagnostics import Diagnostic, ProblemError, Span
from lagcli.expression import Name
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.parameter_values import parameter_values
from lagcli.record import record

_SMALL = mpf(10) ** -20


@record
class InitialState:
    """q and q' at t = 0 as formulas in the parameters.

    `only_at_values` tells that it satisfies the constraints for the parameter values of
    the file and not for all others.
    """

    values: Mapping[Symbol, Expr]
    only_at_values: bool = False

    def at(self, expression: Expr, t: Symbol) -> Expr:
        """The value of a function of q, q' and t in this state."""
        return expression.xreplace({**self.values, t: S.Zero})


def initial_state(dynamics: Dynamics) -> InitialState:
    """The state at t = 0.

    Raises
    ------
    ProblemError
        When no state with the given values satisfies the constraints, or when several do.
    """
    return _StateCompletion(dynamics).state()


class _StateCompletion:
    """Fills in what the file leaves out, equation by equation, and then by several together."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = system = dynamics.system
        self.given = {
            system.symbol_of(str(name)): system.build(value)
            for name, value in system.problem.initial.items()
        }
        self.values: dict[Symbol, Expr] = {system.t: S.Zero, **self.given}
        self.only_at_values = False

    def state(self) -> InitialState:
        equations = self.dynamics.constraints.equations
        holonomic = [(e, e.f) for e in equations if e.holonomic]
        forms = zip(equations, self.dynamics.constraints.velocity_forms, strict=True)
        self._complete(self.system.q, holonomic)
        self._complete(self.system.qdot, list(forms))
        del self.values[self.system.t]
        return InitialState(self.values, self.only_at_values)

    def _complete(
        self, unknowns: Sequence[Symbol], equations: Sequence[tuple[ConstraintEquation, Expr]]
    ) -> None:
        """Solve for the unknowns that are left out; the first undetermined one becomes 0."""
        left_out = [s for s in unknowns if s not in self.values]
        while True:
            self._propagate(left_out, equations)
            open_ = [s for s in left_out if s not in self.values]
            if not open_:
                break
            self.values.update(self._together(open_, equations) or {open_[0]: S.Zero})
        for constraint, equation in equations:
            self._must_hold(constraint, equation)

    def _together(
        self, unknowns: Sequence[Symbol], equations: Sequence[tuple[ConstraintEquation, Expr]]
    ) -> dict[Symbol, Expr]:
        """What the equations that are linear in the unknowns determine jointly.

        The solutions are the vectors (x, 1) of the nullspace of [A, c] for A x + c = 0.
        """
        none = dict.fromkeys(unknowns, S.Zero)
        rows = []
        for _, equation in equations:
            rest = equation.xreplace(self.values)
            row = [rest.diff(s) for s in unknowns]
            if any(row) and all(free_of(entry, unknowns) for entry in row):
                rows.append([*row, rest.xreplace(none)])
        vectors = nullspace(rows) if rows else []
        solutions = [v for v in vectors if is_zero(v[-1]) is not True]
        if not solutions:
            return {}
        one, *others = ([x / v[-1] for x in v] for v in solutions)
        open_ways = [
            *(v for v in vectors if is_zero(v[-1]) is True),
            *([x - y for x, y in zip(v, one, strict=True)] for v in others),
        ]
        return {
            s: simplify(one[k])
            for k, s in enumerate(unknowns)
            if all(is_zero(way[k]) is True for way in open_ways)
        }

    def _propagate(
        self, left_out: Sequence[Symbol], equations: Sequence[tuple[ConstraintEquation, Expr]]
    ) -> None:
        """Use each equation that has one unknown left, until nothing new follows."""
        progress = True
        while progress:
            progress = False
            for constraint, equation in equations:
                rest = equation.xreplace(self.values)
                unknown = [s for s in left_out if s not in self.values and s in rest.free_symbols]
                if len(unknown) == 1:
                    value = self._solve(rest, unknown[0], constraint)
                    if value is not None:
                        self.values[unknown[0]] = value
                        progress = True

    def _solve(
        self, equation: Expr, unknown: Symbol, constraint: ConstraintEquation
    ) -> Expr | None:
        """The value that the equation determines; None where it leaves the value open."""
        field = Field([equation])
        element, number = field(equation), field.number_of(unknown)
        if number is None or element.is_zero() or number not in field.ring.used(element.numerator):
            return None
        hidden = any(
            unknown in field.generators[g].expression.free_symbols
            for g in field.ring.used(element.numerator)
            if g != number
        )
        roots = None if hidden else polynomial_roots(field, element.numerator, number)
        if roots is None:
            at_zero = equation.xreplace({unknown: S.Zero})
            if is_zero(at_zero) is True:
                return S.Zero
            raise self._error(
                f"the initial value of '{unknown}' does not follow from constraint "
                f"'{constraint.name}' in closed form",
                f"give {unknown} in `initial`",
                [constraint],
            )
        allowed = [r for r in roots if not _excluded(r, unknown)]
        distinct: list[Expr] = []
        for root in map(simplify, allowed):
            if not any(is_zero(root - other) is True for other in distinct):
                distinct.append(root)
        if len(distinct) == 1:
            return distinct[0]
        if not distinct:
            raise self._no_state(constraint)
        raise self._error(
            f"the initial state leaves several values of '{unknown}': "
            + ", ".join(map(str, distinct)),
            f"give {unknown} in `initial`",
            [constraint],
        )

    # -- checks ----------------------------------------------------------------------------

    def _must_hold(self, constraint: ConstraintEquation, equation: Expr) -> None:
        rest = equation.xreplace(self.values)
        if is_zero(rest) is True:
            return
        values = parameter_values(self.system)
        if not rest.free_symbols <= values.keys():
            # no numbers to decide by: only an identity can be relied on
            if is_zero(rest) is False and not rest.free_symbols:
                raise self._no_state(constraint)
            self.only_at_values = True
            return
        with mpmath.workdps(DIGITS):
            [number] = Evaluator([rest])(values)
            if not abs(number) < _SMALL:
                raise self._no_state(constraint)
        self.only_at_values = True

    def _no_state(self, constraint: ConstraintEquation) -> ProblemError:
        return self._error(
            f"the initial state does not satisfy constraint '{constraint.name}'",
            "values that are left out follow from the constraints where these determine them",
            [constraint],
        )

    def _error(
        self, message: str, hint: str, constraints: Sequence[ConstraintEquation]
    ) -> ProblemError:
        problem = self.system.problem
        related = tuple(
            (c.equation.span, f"constraint '{c.name}'")
            for c in problem.constraints
            if any(c.name == e.name for e in constraints)
        )
        diagnostic = Diagnostic(message, self._span(constraints), hint, related=related)
        return ProblemError(problem.source, (diagnostic,))

    def _span(self, constraints: Sequence[ConstraintEquation]) -> Span:
        """The last given value that the constraints speak of, else the constraint itself."""
        symbols = {
            s for e in constraints for s in (e.f.free_symbols | set().union(*map(_free, e.row)))
        }
        problem = self.system.problem
        named: dict[Name, Span] = {
            name: value.span
            for name, value in problem.initial.items()
            if self.system.symbol_of(str(name)) in symbols
        }
        if named:
            return list(named.values())[-1]
        return next(c.equation.span for c in problem.constraints if c.name == constraints[0].name)


def _free(expression: Expr) -> set[Symbol]:
    return set(expression.free_symbols)


def _excluded(value: Expr, unknown: Symbol) -> bool:
    """Whether the value is not real, or of a sign that the unknown cannot have."""
    return bool(
        value.is_real is False
        or (unknown.is_positive and (value.is_positive is False))
        or (unknown.is_nonnegative and value.is_negative)
        or (unknown.is_negative and (value.is_negative is False))
        or (unknown.is_nonzero and value.is_zero)
    )
