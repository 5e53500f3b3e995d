"""A system too large for simplified formulas: what it is, and how it is solved, if on a page."""

from __future__ import annotations

from collections.abc import Iterator

from lagcli.document import Block, Equations, Items, Row, equations_of
from lagcli.expression import Diff, Name, Product, Rate
from lagcli.graph.sharing import operations
from lagcli.mechanics.closed_form import ClosedForm, ClosedSolution
from lagcli.mechanics.explaining.words import (
    Letters,
    Part,
    counted,
    difference,
    explained,
    matrix_law,
    names,
    says,
)
from lagcli.mechanics.large_charges import LargeCharges
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.notation.given_formulas import names_of
from lagcli.statements.explanation import Explanation, ExplanationStep
from lagcli.statements.wording import capitalized

UNSOLVED = "the accelerations and multipliers were not solved in closed form"


def explanation_of_large(form: MatrixForm) -> Explanation:
    """What follows for a large system from its structure."""
    charges = LargeCharges(form)
    solution = ClosedForm(form, names_of(form.problem)).motion
    account = {
        "The system": _system(form),
        "Lagrange's equations": _equations(form, solved=solution is not None),
    }
    if solution is not None:
        account["The accelerations"] = _solved(form, solution)
    account["The energy"] = _energy(form, charges)
    steps = [ExplanationStep(title, tuple(blocks)) for title, blocks in account.items()]
    missing = (UNSOLVED,) if solution is None else ()
    return explained(form.problem, form.degrees_of_freedom, steps, missing)


def _system(form: MatrixForm) -> Iterator[Block]:
    coordinates = [q.name for q in form.problem.coordinates]
    yield says("The coordinates ", names(coordinates), " describe the configuration.")
    free, rank = form.degrees_of_freedom, len(form.independent)
    freedom = f"the system has {counted(free, 'degree')} of freedom."
    if not form.constraints:
        yield says(f"No constraint is stated: {freedom}")
        return
    yield says(
        f"{counted(len(form.constraints), 'constraint').capitalize()} "
        f"{'restricts' if len(form.constraints) == 1 else 'restrict'} the motion:"
    )
    items: list[tuple[Part, ...]] = []
    for constraint, row in zip(form.problem.constraints, form.constraints, strict=True):
        kind = "without velocities, holonomic" if row.holonomic else "on the velocities"
        items.append((f"'{constraint.name}': {kind}",))
    yield Items(tuple(items))
    yield says(
        f"{counted(len(coordinates), 'velocity', 'velocities').capitalize()} minus "
        f"{counted(rank, 'independent condition')} on them: {freedom}"
    )


def _solved(form: MatrixForm, solution: ClosedSolution) -> Iterator[Block]:
    yield says(
        "Gauss's elimination solves them, row by row and then backwards. Each of its steps is an "
        "abbreviation that uses earlier ones only:"
    )
    yield equations_of((Name(name), node) for name, node in solution.where.items())
    yield says("With these,")
    accelerations = zip(form.q, solution.accelerations, strict=True)
    multipliers = zip(form.problem.constraints, solution.multipliers, strict=True)
    yield Equations(
        (
            *(Row(Name(q.name, 2), value) for q, value in accelerations),
            *(Row(Name(c.multiplier), value) for c, value in multipliers),
        )
    )
    yield says("Substituted into the equations of motion: verified at a random state to 50 digits.")


def _equations(form: MatrixForm, *, solved: bool) -> Iterator[Block]:
    letters = Letters(form.problem)
    constrained = bool(form.constraints)
    left = difference(Rate(Diff(letters.L, letters.velocity)), Diff(letters.L, letters.q))
    yield says(
        "For each coordinate ",
        letters.q,
        ", Lagrange's equation has ",
        left,
        " on its left side and the other generalized forces on its right side",
        ", with those of the constraints and their multipliers" if constrained else "",
        ". These equations are linear in the accelerations: ",
        *matrix_law(constrained=constrained),
        ".",
    )
    count = operations(form.entries)
    if solved:
        yield says(
            f"With common subexpressions shared, the entries take {count:,} operations: "
            "lagcli solve --show matrix_form prints them."
        )
        return
    yield says(
        f"With common subexpressions shared, the entries take {count:,} operations. A solution in "
        "formulas would not be readable, so the system stays in this matrix form, to be solved "
        "numerically: lagcli solve --show matrix_form prints the entries, lagcli simulate computes "
        "the motion."
    )


def _energy(form: MatrixForm, charges: LargeCharges) -> Iterator[Block]:
    letters = Letters(form.problem)
    yield says(
        "The energy function ",
        letters.h,
        " is the sum of ",
        Product((letters.velocity, Diff(letters.L, letters.velocity))),
        " over all coordinates, minus ",
        letters.L,
        f". {capitalized(charges.energy_reason)}.",
    )
    cyclic = [form.q[i].name for i in charges.cyclic]
    if cyclic:
        yield says(
            names(cyclic),
            " does not occur in " if len(cyclic) == 1 else " do not occur in ",
            letters.L,
            ": the momentum " if len(cyclic) == 1 else ": the momenta ",
            names(f"p_{name}" for name in cyclic),
            " changes only by the other generalized forces."
            if len(cyclic) == 1
            else " change only by the other generalized forces.",
        )
