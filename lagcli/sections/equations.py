"""d/dt(∂L/∂q') − ∂L/∂q = Q + Σ λ ∂f/∂q, one for each coordinate, and the constraints."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from lagcli.document import Block, equations_of
from lagcli.expression import ZERO, Equation, Expression, Name, operation_count, walk
from lagcli.formatters.grammar import equation_to_grammar, to_grammar
from lagcli.formatters.json_values import FORMULA, TEXT, Object, list_or_null, record_of
from lagcli.reader.scope import EQUATION
from lagcli.reader.shapes import equation, list_of
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers, EquationsSection, LagrangeEquation
from lagcli.statements.declaration import always, declared
from lagcli.statements.wording import not_found, with_constraints

if TYPE_CHECKING:
    from lagcli.mechanics.constraints import ConstraintEquation
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.studies.check.expectations import Expectations, Found


def derive(statements: Statements) -> EquationsSection:
    """d/dt(dL/dq') - dL/dq = Q - dD/dq' + sum lambda df/dq."""
    from sympy import Add

    system, dynamics = statements.system, statements.dynamics
    constraints = dynamics.constraints.equations
    sides = zip(system.names, dynamics.lagrange.left_sides, system.applied_forces, strict=True)
    equations = tuple(
        LagrangeEquation(
            coordinate=name,
            left=statements.by_terms(left),
            right=statements.by_terms(Add(force, *(e.multiplier * e.row[j] for e in constraints)))
            if constraints
            else statements.readable.linear(force),
        )
        for j, (name, left, force) in enumerate(sides)
    )
    return EquationsSection(
        equations=equations, constraints={e.name: _as_given(statements, e) for e in constraints}
    )


def _as_given(
    statements: Statements, constraint: ConstraintEquation
) -> tuple[Expression, Expression]:
    """The equation of the file, unless there is a shorter way to write its function."""
    from lagcli.algebra.writing import Writer

    short = statements.as_written(constraint.f)
    writer = Writer(statements.system.order)
    for each in statements.problem.constraints:
        if each.name != constraint.name:
            continue
        left, right = (writer.sum([side]) for side in (each.equation.left, each.equation.right))
        given = writer.sum([left, writer.negative(right)])
        if operation_count(given) <= operation_count(short) + 1 and _is_of(
            constraint, given, statements
        ):
            return left, right
    return short, ZERO


def _is_of(constraint: ConstraintEquation, given: Expression, statements: Statements) -> bool:
    """Whether an expression of the file is the function of a constraint, in its own names."""
    names = {symbol.name for symbol in constraint.f.free_symbols}
    if any(isinstance(n, Name) and str(n) not in names and n.name != "pi" for n in walk(given)):
        return False
    difference = statements.system.build(given) - constraint.f
    return bool(difference == 0 or difference.expand() == 0)


def large(statements: LargeStatements) -> EquationsSection:
    """M q'' - (L_q - …) = Q - dD/dq' + A^T lambda."""
    form, graph = statements.form, statements.form.graph
    constraints = statements.problem.constraints
    forces = [graph.symbol(c.multiplier) for c in constraints]
    left = [
        graph.sum(
            [
                *(graph.product(m, a) for m, a in zip(row, form.qddot, strict=True)),
                graph.scaled(inertial, -1),
            ]
        )
        for row, inertial in zip(form.mass_matrix, form.inertial, strict=True)
    ]
    right = [
        graph.sum(
            [
                applied,
                *(
                    graph.product(row.row[i], force)
                    for row, force in zip(form.constraints, forces, strict=True)
                ),
            ]
        )
        for i, applied in enumerate(form.applied_forces)
    ]
    found = statements.written("the equations", [*left, *right, *(r.f for r in form.constraints)])
    if found is None:
        return EquationsSection(equations=None)
    n = len(form.q)
    return EquationsSection(
        equations=tuple(
            LagrangeEquation(coordinate=q.name, left=one, right=other)
            for q, one, other in zip(form.q, found[:n], found[n : 2 * n], strict=True)
        ),
        constraints={c.name: (f, ZERO) for c, f in zip(constraints, found[2 * n :], strict=True)},
    )


def blocks(section: EquationsSection, _: Answers) -> Iterator[Block]:
    """An equation for each coordinate, then the constraints."""
    if section.equations is None:
        yield not_found()
        return
    yield equations_of((each.left, each.right) for each in section.equations)
    yield from with_constraints(section.constraints)


def equation_json(equation: LagrangeEquation) -> Object:
    """One equation with its coordinate."""
    sides = f"{to_grammar(equation.left)} = {to_grammar(equation.right)}"
    return {"coordinate": equation.coordinate, "equation": sides}


def json(section: EquationsSection) -> Object:
    """The equations without the constraints, which are the file's."""
    return {"equations": list_or_null(section.equations, equation_json)}


def compare(check: Expectations, _: object, expected: Sequence[Equation]) -> Found:
    """Each follows from the derived equations."""
    from lagcli.studies.check.following import follows

    for place, each in enumerate(expected):
        path, text = ["equations", str(place)], equation_to_grammar(each)
        verdict = follows(check.derivation, each, check.comparison)
        if verdict is None:
            yield check.undecided(
                path, f"nobody could decide whether {text} follows from the derived equations"
            )
        elif verdict:
            yield None
        else:
            yield check.wrong(path, f"{text} does not follow from the derived equations")


_EXPECTED = list_of(equation("an expected equation", EQUATION))
SECTION = declared(
    globals(),
    heading="Equations of motion",
    order=20,
    schema={
        "type": ["array", "null"],
        "items": record_of(coordinate=TEXT, equation=FORMULA),
    },
    by_default=always,
    expected=(expected_of("equations", _EXPECTED, compare),),
)
