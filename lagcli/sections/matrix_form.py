"""M q'' = forcing + Aᵀλ with A q'' + bias = 0: the form for large systems."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import Block, Formula, Label, Matrix, Paragraph
from lagcli.expression import Expression
from lagcli.formatters.json_values import FORMULA, Object, Schema, map_of, plain, record_of
from lagcli.statements.answers import Answers, MatrixFormSection
from lagcli.statements.declaration import declared
from lagcli.statements.wording import not_found, rows_by_name

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements


def derive(statements: Statements) -> MatrixFormSection:
    """The entries as they are derived, each simplified."""
    lagrange = statements.dynamics.lagrange
    constraints = statements.dynamics.constraints
    write = statements.as_written
    return MatrixFormSection(
        mass_matrix=tuple(tuple(map(write, row)) for row in lagrange.mass_matrix),
        constraint_jacobian=tuple(tuple(map(write, row)) for row in constraints.jacobian),
        forcing=tuple(map(write, lagrange.forcing)),
        constraint_bias=tuple(write(e.bias) for e in constraints.equations),
    )


def large(statements: LargeStatements) -> MatrixFormSection:
    """The entries with their shared parts named."""
    from lagcli.graph.sharing import with_shared_parts

    form = statements.form
    n, m = len(form.q), len(form.constraints)
    found = with_shared_parts(form.entries, statements.order, statements.taken)
    statements.reserved |= found.named.keys()
    entries = iter(found.roots)

    def rows(count: int, width: int) -> tuple[tuple[Expression, ...], ...]:
        return tuple(tuple(next(entries) for _ in range(width)) for _ in range(count))

    mass_matrix, [forcing] = rows(n, n), rows(1, n)
    jacobian, [bias] = rows(m, n), rows(1, m)
    return MatrixFormSection(
        mass_matrix=mass_matrix,
        constraint_jacobian=jacobian,
        forcing=forcing,
        constraint_bias=bias,
        shared=found.named,
    )


def blocks(section: MatrixFormSection, answers: Answers) -> Iterator[Block]:
    """The form in symbols, then each matrix, then the shared parts."""
    if not section.mass_matrix:
        yield not_found()
        return
    mass, jacobian = Label("M", matrix=True), Label("A", matrix=True)
    forcing, bias = Label("F", matrix=True), Label("b", matrix=True)
    constrained = bool(section.constraint_jacobian)
    parts: list[str | Formula] = [mass, " · accelerations = ", forcing]
    if constrained:
        parts += [" + ", jacobian, " transposed · multipliers, and "]
        parts += [jacobian, " · accelerations + ", bias, " = 0"]
    yield Paragraph((*parts, "."))
    coordinates = answers.coordinates
    yield Matrix(mass, section.mass_matrix, coordinates, coordinates)
    yield _column(forcing, section.forcing, coordinates)
    if constrained:
        constraints = tuple(answers.multipliers.values())
        if len(constraints) != len(section.constraint_jacobian):
            constraints = tuple(str(i) for i, _ in enumerate(section.constraint_jacobian, 1))
        yield Matrix(jacobian, section.constraint_jacobian, constraints, coordinates)
        yield _column(bias, section.constraint_bias, constraints)
    if section.shared:
        yield Paragraph(("where",))
        yield rows_by_name(section.shared)


def _column(label: Label, entries: tuple[Expression, ...], names: tuple[str, ...]) -> Matrix:
    return Matrix(label, tuple((entry,) for entry in entries), names, ())


def json(section: MatrixFormSection) -> Object:
    """Null where the form is not given."""
    return {"matrix_form": plain(section) if section.mass_matrix else None}


_COLUMN: Schema = {"type": "array", "items": FORMULA}
_MATRIX: Schema = {"type": "array", "items": _COLUMN}

SECTION = declared(
    globals(),
    heading="Matrix form",
    order=30,
    schema=record_of(
        mass_matrix=_MATRIX,
        constraint_jacobian=_MATRIX,
        forcing=_COLUMN,
        constraint_bias=_COLUMN,
        shared=map_of(FORMULA, null=False),
    ),
)
