"""Constraints: their rows A and b, their kind, and the one sign of the multipliers.

The convention of the whole program, for f = left - right as the file writes it:

    d/dt(dL/dq_j') - dL/dq_j = Q_j + sum_k lambda_k a_kj,

with a_kj = df_k/dq_j for a holonomic constraint f_k(q, t) = 0 and a_kj the coefficient
of q_j' for a velocity constraint sum_j a_kj q_j' + b_k = 0.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 1.3 and 2.4.
Frobenius' theorem: Frankel, *The Geometry of Physics*, 3rd ed., section 6.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import Relations, dot, is_zero, nullspace, rank, simplify
from lagcli.algebra.build import free_of, without_jumps
from lagcli.diagnostics import Diagnostic, ProblemError
from lagcli.mechanics.branches import restricting, vanishing_factors, without_time_alone
from lagcli.mechanics.system import System
from lagcli.problem_data import Constraint
from lagcli.record import record
from lagcli.statements.answers import ConstraintKind


@record
class ConstraintEquation:
    """One constraint as formulas: f = 0, and a . q' + b = 0, and a . q'' + bias = 0."""

    name: str
    multiplier: Symbol
    f: Expr
    holonomic: bool  # written without velocities
    row: tuple[Expr, ...]  # a_j
    drift: Expr  # b
    bias: Expr


class Constraints:
    """All constraints of a system, in the order of the file."""

    def __init__(self, system: System) -> None:
        self.system = system
        diagnostics: list[Diagnostic] = []
        self.equations = tuple(
            equation
            for constraint in system.problem.constraints
            if (equation := self._equation(constraint, diagnostics)) is not None
        )
        if diagnostics:
            raise ProblemError(system.problem.source, tuple(diagnostics))

    def __len__(self) -> int:
        return len(self.equations)

    def _equation(
        self, constraint: Constraint, diagnostics: list[Diagnostic]
    ) -> ConstraintEquation | None:
        system = self.system
        f = system.build(constraint.equation.left) - system.build(constraint.equation.right)
        multiplier = system.symbol_of(constraint.multiplier)
        velocities = set(system.qdot)
        holonomic = free_of(f, velocities)
        if holonomic:
            row = tuple(without_jumps(f.diff(q)) for q in system.q)
            drift = without_jumps(f.diff(system.t))
        else:
            row = tuple(f.diff(v) for v in system.qdot)
            curved = [
                v
                for v in system.qdot
                for entry in row
                if not free_of(entry, [v]) and is_zero(entry.diff(v)) is not True
            ]
            if curved:
                diagnostics.append(
                    Diagnostic(
                        f"constraint '{constraint.name}' is not linear in the velocities",
                        constraint.equation.span,
                        f"a velocity constraint has the form a*{curved[0]} + b = 0; "
                        "multiply a quotient out, or give the constraint that it comes from",
                    )
                )
                return None
            at_rest = dict.fromkeys(velocities, sympy.S.Zero)
            row = tuple(entry.xreplace(at_rest) for entry in row)
            drift = f.xreplace(at_rest)
        if all(is_zero(entry) is True for entry in row):
            diagnostics.append(
                Diagnostic(
                    f"constraint '{constraint.name}' does not restrict the motion: "
                    "no coordinate is left in it",
                    constraint.equation.span,
                    "it is an identity, or a condition on the parameters or the time",
                )
            )
            return None
        # d/dt(a . q' + b) with q'' = 0 leaves the bias
        still = dict.fromkeys(system.qddot, sympy.S.Zero)
        bias = system.total_derivative(dot(row, system.qdot) + drift).xreplace(still)
        return ConstraintEquation(constraint.name, multiplier, f, holonomic, row, drift, bias)

    @cached_property
    def branches(self) -> dict[str, tuple[Expr, ...]]:
        """Of each constraint that several factors fulfil: the factors, each 0 somewhere.

        y (x - 2 y) = 0 is the union of two surfaces; y (x' + x y') = 0 restricts nothing at y = 0.
        """
        forms = {e.name: e.f if e.holonomic else self._velocity_form(e) for e in self.equations}
        moving = {*self.system.q, *self.system.qdot}
        found = {name: vanishing_factors(form, moving) for name, form in forms.items()}
        return {name: factors for name, factors in found.items() if len(factors) > 1}

    def follows(self, factor: Expr, equation: ConstraintEquation) -> bool:
        """Whether the other constraints, those of one factor, make this factor of one vanish.

        z = x^2 leaves (z - x^2) (y - 2) = 0 no other surface.
        """
        whole = [e for e in self.equations if e is not equation and e.name not in self.branches]
        forms = [e.f for e in whole if e.holonomic] + list(map(self._velocity_form, whole))
        moving = (*self.system.q, *self.system.qdot, self.system.t)
        return bool(forms) and is_zero(factor, Relations(forms, moving=moving)) is True

    def _velocity_form(self, equation: ConstraintEquation) -> Expr:
        return dot(equation.row, self.system.qdot) + equation.drift

    # -- matrices ---------------------------------------------------------------------

    @property
    def jacobian(self) -> tuple[tuple[Expr, ...], ...]:
        """A, one row for each constraint, shape (m, n)."""
        return tuple(equation.row for equation in self.equations)

    @property
    def velocity_forms(self) -> tuple[Expr, ...]:
        """A q' + b, which vanish on the motion."""
        return tuple(map(self._velocity_form, self.equations))

    @property
    def moving(self) -> bool:
        """Whether a constraint drives the velocities: b is not 0 in A q' + b = 0."""
        return any(e.drift != 0 for e in self.equations)

    @cached_property
    def relations(self) -> Relations | None:
        """What holds on the motion: f = 0 for the holonomic ones, A q' + b = 0 for all."""
        if not self.equations:
            return None
        system = self.system
        still = (*system.q, *system.qdot)
        positions, velocities = [], []
        for e, form in zip(self.equations, self.velocity_forms, strict=True):
            if e.holonomic:
                positions.append(without_time_alone(e.f, system.t, still))
                changed = positions[-1] is not e.f
                velocities.append(system.total_derivative(positions[-1]) if changed else form)
            else:
                rest = restricting(self.branches.get(e.name, (form,)), system.qdot)
                velocities.append(without_time_alone(rest, system.t, still))
        return Relations([*positions, *velocities], moving=(*still, system.t))

    # -- integrability ----------------------------------------------------------------

    @cached_property
    def kinds(self) -> dict[str, ConstraintKind]:
        """Of each constraint: holonomic, integrable in disguise, or nonholonomic."""
        kinds: dict[str, ConstraintKind] = {}
        integrable_span: list[list[Expr]] | None = None
        for equation in self.equations:
            if equation.holonomic:
                kinds[equation.name] = "holonomic"
                continue
            if integrable_span is None:
                integrable_span = self.integrable_forms()
            form = [*equation.row, equation.drift]
            within = rank([*integrable_span, form]) == len(integrable_span)
            kinds[equation.name] = "integrable" if within else "nonholonomic"
        return kinds

    @property
    def nonholonomic(self) -> bool:
        """Whether one of them cannot be integrated."""
        return "nonholonomic" in self.kinds.values()

    def is_integrable_alone(self, equation: ConstraintEquation) -> bool:
        """Whether a relation between the coordinates follows from this one without the others."""
        return bool(self._last_derived([[*equation.row, equation.drift]]))

    @cached_property
    def relations_of_several(self) -> int:
        """How many relations between the coordinates only combinations of constraints give."""
        kinds = self.kinds
        if "nonholonomic" not in kinds.values():
            return 0
        own = [[*e.row, e.drift] for e in self.equations if kinds[e.name] != "nonholonomic"]
        return len(self.integrable_forms()) - (rank(own) if own else 0)

    def integrable_forms(self) -> list[list[Expr]]:
        """The last derived system of all constraints."""
        return self._last_derived([[*e.row, e.drift] for e in self.equations])

    def _last_derived(self, rows: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
        """The last derived system of the Pfaffian system {a dq + b dt}: its integrable part.

        The derived system I' of I holds the forms w in I with dw = 0 mod I, which is a
        linear condition on the coefficients c_k of w = sum c_k w_k, since
        d(c w) = dc ^ w + c dw.  Iterated until it stays, it is the largest integrable
        subsystem (Frobenius).
        """
        variables = [*self.system.q, self.system.t]
        forms = _independent(rows)
        while forms:
            kernel = [list(v) for v in nullspace(forms)]
            columns = [
                [exterior_derivative(form, variables, u, v) for form in forms]
                for u, v in combinations(kernel, 2)
            ]
            columns = [column for column in columns if any(is_zero(c) is not True for c in column)]
            if not columns:
                return forms
            coefficients = nullspace(columns)
            forms = [
                [
                    simplify(sympy.Add(*(c * w[i] for c, w in zip(cs, forms, strict=True))))
                    for i in range(len(variables))
                ]
                for cs in coefficients
            ]
        return forms


def _independent(rows: Sequence[Sequence[Expr]]) -> list[list[Expr]]:
    """The rows that are not combinations of earlier ones."""
    kept: list[list[Expr]] = []
    for row in rows:
        if rank([*kept, list(row)]) > len(kept):
            kept.append(list(row))
    return kept


def exterior_derivative(
    form: Sequence[Expr], variables: Sequence[Symbol], u: Sequence[Expr], v: Sequence[Expr]
) -> Expr:
    """dw(u, v) = sum_ij (dw_j/dx_i) (u_i v_j - u_j v_i)."""
    return sympy.Add(
        *(
            component.diff(x) * (u[i] * v[j] - u[j] * v[i])
            for j, component in enumerate(form)
            for i, x in enumerate(variables)
            if i != j and not free_of(component, [x])
        )
    )
