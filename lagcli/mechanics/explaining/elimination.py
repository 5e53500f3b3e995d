"""The fourth step: the accelerations, and the multipliers eliminated on the way.

q'' = M^-1 (F + A^T lambda),    A q'' + b = 0,
A M^-1 A^T lambda = -b - A M^-1 F
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy
from sympy import Expr

from lagcli.algebra import dot, is_zero, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.document import Block, Equations, Label, Matrix, Row
from lagcli.expression import ZERO, Expression, Name, operation_count
from lagcli.mechanics.constraints import ConstraintEquation
from lagcli.mechanics.dynamics import SolvedMotion
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import matrix_law, names, quoted, says

#: A matrix is set when its entries show no more operations than this together.
_SHOWN = 80
#: Most coordinates for which accelerations in terms of the multipliers are worked out; any number
#: where M is diagonal.
_COUPLED = 3
#: Formulas on the way that show more operations than this are not written down.
_ON_THE_WAY = 200
#: Most operations of a formula within a sentence.
_INLINE = 5


def elimination(explainer: Explainer) -> Iterator[Block]:
    """From the equations to q'' and the multipliers."""
    motion = explainer.dynamics.motion
    if motion is None:
        yield from _unsolved(explainer)
    elif explainer.dynamics.constraints.equations:
        yield from _with_multipliers(explainer, motion)
    else:
        yield from _free(explainer, motion)


def _unsolved(explainer: Explainer) -> Iterator[Block]:
    degenerate = [explainer.system.names[i] for i in explainer.dynamics.undetermined]
    if degenerate:
        yield says(
            "The equations are linear in the accelerations, but the matrix of their coefficients "
            "(the second derivatives of ",
            explainer.letters.L,
            " with respect to the velocities) has no inverse along ",
            names(degenerate),
            ": the Lagrangian is singular, and the equations do not determine the accelerations.",
        )
        demanded = explainer.dynamics.contradiction
        if demanded is not None:
            yield says("They imply")
            yield Equations((Row(explainer.readable.as_written(demanded), ZERO),))
            yield says("which is false: this Lagrangian has no motion.")
        return
    yield says(
        "The equations are linear in the accelerations and multipliers, but too many for a "
        "readable "
        "solution. They stay in matrix form, to be solved numerically: ",
        *matrix_law(constrained=bool(explainer.dynamics.constraints.equations)),
        ". lagcli solve --show matrix_form prints its entries.",
    )


# -- without constraints ----------------------------------------------------------------------


def _free(explainer: Explainer, motion: SolvedMotion) -> Iterator[Block]:
    n = len(explainer.system.names)
    M = explainer.dynamics.lagrange.mass_matrix
    finite = ", where that is not 0," * _may_vanish(explainer, [M[j][j] for j in range(n)])
    if n == 1:
        coefficient = explainer.readable.as_written(M[0][0])
        acceleration = explainer.accelerations[0]
        if operation_count(coefficient) == 0:
            yield says("Solved for ", acceleration, ":")
        elif operation_count(coefficient) <= _INLINE:
            yield says(
                "The equation is linear in ", acceleration, ". Divided by its coefficient ",
                coefficient, f"{finite} it reads",
            )  # fmt: skip
        else:
            yield says("The equation is linear in ", acceleration,
                       f". Divided by its coefficient{finite} it reads")  # fmt: skip
    elif _diagonal(M):
        yield says(
            "Each equation contains only one acceleration. Divided by its "
            f"coefficient{finite} it reads"
        )
    else:
        yield says(
            "The equations are linear in the accelerations and coupled: ",
            *matrix_law(constrained=False),
        )
        yield from _matrices(explainer, [])
        yield says("The coefficients are the second derivatives of ", explainer.letters.L,
                   " with respect to the velocities. The solution is")  # fmt: skip
    yield Equations(tuple(_accelerations(explainer, motion)))


def _may_vanish(explainer: Explainer, coefficients: Sequence[Expr]) -> bool:
    """Whether one that depends on the state may be 0, as at the pole of a sphere."""
    system = explainer.system
    state = (*system.q, *system.qdot, system.t)
    moving = [c for c in coefficients if not free_of(c, state)]
    return any(sign(c) is None and sign(c**2) != 1 for c in moving)


def _diagonal(M: Sequence[Sequence[Expr]]) -> bool:
    return all(
        is_zero(entry) is True for i, row in enumerate(M) for j, entry in enumerate(row) if i != j
    )


def _accelerations(explainer: Explainer, motion: SolvedMotion) -> Iterator[Row]:
    for name, value in zip(explainer.accelerations, motion.accelerations, strict=True):
        yield Row(name, explainer.readable.on_surface(value))


def _matrices(explainer: Explainer, kept: Sequence[ConstraintEquation]) -> Iterator[Block]:
    """M, F, A and b, where they are not too long."""
    lagrange, write = explainer.dynamics.lagrange, explainer.readable.as_written
    coordinates = explainer.system.names
    rows = tuple(e.name for e in kept)
    shown = [
        ("M", [[write(x) for x in row] for row in lagrange.mass_matrix], coordinates, coordinates),
        ("F", [[write(x)] for x in lagrange.forcing], coordinates, ()),
    ]
    if kept:
        shown += [
            ("A", [[write(x) for x in e.row] for e in kept], rows, coordinates),
            ("b", [[write(e.bias)] for e in kept], rows, ()),
        ]
    for letter, entries, row_names, column_names in shown:
        label = Label(letter, matrix=True)
        if sum(operation_count(x) for row in entries for x in row) <= _SHOWN:
            yield Matrix(label, tuple(map(tuple, entries)), row_names, column_names)
        else:
            yield says("The entries of ", label, " are too long to be printed here.")


# -- with constraints -------------------------------------------------------------------------


def _with_multipliers(explainer: Explainer, motion: SolvedMotion) -> Iterator[Block]:
    dynamics = explainer.dynamics
    kept = [dynamics.constraints.equations[k] for k in dynamics.independent_constraints]
    unknowns = len(explainer.system.names) + len(kept)
    yield says(
        "With the multiplier there is one unknown more than equations of motion. The missing "
        "equation comes from the constraint: it holds at all times, and so do its time "
        "derivatives, "
        "which contain the accelerations:"
        if len(kept) == 1
        else "With the multipliers there are more unknowns than equations of motion. The missing "
        "equations come from the constraints: they hold at all times, and so do their time "
        "derivatives, which contain the accelerations:"
    )
    yield Equations(tuple(_derivatives(explainer, kept)))
    if dynamics.redundant:
        one = len(dynamics.redundant) == 1
        yield says(
            f"({quoted(dynamics.redundant)} {'is' if one else 'are'} implied by the others, so "
            f"{'its multiplier' if one else 'their multipliers'} can be set to 0: the "
            f"accelerations do "
            "not depend on that choice.)"
        )
    yield says(
        f"Together these are {unknowns} equations, linear in the {unknowns} unknown accelerations "
        f"and multipliers."
    )
    steps = _eliminated(explainer, motion, kept)
    if steps is None:
        yield says("In matrix form, ", *matrix_law(constrained=True), " with")
        yield from _matrices(explainer, kept)
        if dynamics.degenerate:
            yield says(
                Label("M", matrix=True),
                " alone has no inverse (",
                names(explainer.system.names[i] for i in dynamics.degenerate),
                "), but together with the constraints the system has a unique solution. It is",
            )
        else:
            yield says("The solution, simplified with the constraints, is")
    else:
        yield from steps
    yield from _solution(explainer, motion)


def _derivatives(explainer: Explainer, kept: Sequence[ConstraintEquation]) -> Iterator[Row]:
    system, by_terms = explainer.system, explainer.readable.by_terms
    for equation in kept:
        still = dot(equation.row, system.qdot) + equation.drift
        twice = dot(equation.row, system.qddot) + equation.bias
        if equation.holonomic:
            yield Row(by_terms(still), ZERO, f"{equation.name}, differentiated once")
            yield Row(by_terms(twice), ZERO, f"{equation.name}, differentiated twice")
        else:
            yield Row(by_terms(twice), ZERO, f"{equation.name}, differentiated once")


def _eliminated(
    explainer: Explainer, motion: SolvedMotion, kept: Sequence[ConstraintEquation]
) -> list[Block] | None:
    """The accelerations by the multipliers, and these by the constraints; None: too long."""
    by_multipliers = _by_multipliers(explainer, kept)
    if by_multipliers is None:
        return None
    conditions = [dot(e.row, by_multipliers) + e.bias for e in kept]
    if not _agree(explainer, motion, by_multipliers, conditions):
        return None
    by_terms = explainer.readable.by_terms
    solved = [by_terms(each) for each in by_multipliers]
    rows = [_condition(explainer, e, each) for e, each in zip(kept, conditions, strict=True)]
    formulas = [*solved, *(row.left for row in rows), *(row.right for row in rows)]
    if any(operation_count(x) > _ON_THE_WAY for x in formulas if isinstance(x, Expression)):
        return None
    one = len(kept) == 1
    symbols = names(e.multiplier.name for e in kept)
    left = "They leave a condition" if one else "They leave conditions"
    return [
        says(
            "First Lagrange's equations are solved for the accelerations in terms of ",
            symbols,
            ":",
        ),
        Equations(tuple(map(Row, explainer.accelerations, solved))),
        says(
            "These are substituted into the differentiated "
            f"{'constraint' if one else 'constraints'}. {left} on ",
            symbols,
            ":",
        ),
        Equations(tuple(rows)),
        says(f"The solution, simplified with the {'constraint' if one else 'constraints'}, is"),
    ]


def _by_multipliers(explainer: Explainer, kept: Sequence[ConstraintEquation]) -> list[Expr] | None:
    """q'' = M^-1 (F + A^T lambda)."""
    lagrange = explainer.dynamics.lagrange
    M = lagrange.mass_matrix
    right = [
        sympy.Add(force, *(e.multiplier * e.row[i] for e in kept))
        for i, force in enumerate(lagrange.forcing)
    ]
    if explainer.dynamics.degenerate:
        return None
    if _diagonal(M):
        return [force / M[i][i] for i, force in enumerate(right)]
    if len(right) > _COUPLED:
        return None
    solution = solve_linear(M, right)
    return None if solution is None or solution.singular else list(solution.values)


def _agree(
    explainer: Explainer,
    motion: SolvedMotion,
    by_multipliers: Sequence[Expr],
    conditions: Sequence[Expr],
) -> bool:
    """Whether the formulas on the way hold for the solution that is printed."""
    chosen: dict[Expr, Expr] = {
        e.multiplier: value
        for e, value in zip(
            explainer.dynamics.constraints.equations, motion.independent, strict=True
        )
    }
    differences = [
        formula.xreplace(chosen) - value
        for formula, value in zip(by_multipliers, motion.accelerations, strict=True)
    ]
    rest = [condition.xreplace(chosen) for condition in conditions]
    return explainer.dynamics.verifier.all_zero([*differences, *rest]).holds is True


def _condition(explainer: Explainer, equation: ConstraintEquation, condition: Expr) -> Row:
    """What multiplies the multipliers on the left, the rest on the right."""
    without = dict.fromkeys(explainer.system.multipliers, sympy.S.Zero)
    rest = condition.xreplace(without)
    by_terms = explainer.readable.by_terms
    return Row(by_terms(condition - rest), by_terms(-rest), equation.name)


def _solution(explainer: Explainer, motion: SolvedMotion) -> Iterator[Block]:
    equations = explainer.dynamics.constraints.equations
    rows, unknown = [], []
    for equation, value in zip(equations, motion.multipliers, strict=True):
        if value is None:
            unknown.append(equation.multiplier.name)
        else:
            shown = explainer.readable.on_surface(value)
            rows.append(Row(Name(equation.multiplier.name), shown))
    rows += _accelerations(explainer, motion)
    yield Equations(tuple(rows))
    if unknown:
        yield says(
            names(unknown),
            " are" if len(unknown) > 1 else " is",
            " not unique, because the constraints are redundant: only the sum of their forces is.",
        )
