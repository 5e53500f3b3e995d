"""Whether the Hamilton-Jacobi equation separates in the coordinates given, and S."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Formula, Integral, Label, Paragraph, Row, equations_of
from lagcli.expression import ZERO, Expression, Name, Negative, Product
from lagcli.formatters.json_values import Object, fields_of
from lagcli.problem_data import ExpectHamiltonJacobi
from lagcli.reader.shapes import YES, by_coordinate, record_of, with_constants
from lagcli.sections._expected import expected_of, judged
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.motions import ActionPart, HamiltonJacobiSection
from lagcli.statements.wording import conditions, listed, not_found

if TYPE_CHECKING:
    from lagcli.mechanics.statements import Statements

_NAMED = {
    True: "It separates in these coordinates",
    False: "It does not separate in these coordinates",
    None: "Whether it separates in these coordinates is undecided",
}


def derive(statements: Statements) -> HamiltonJacobiSection:
    """By separation in the coordinates given, or for forces of the time alone."""
    from lagcli.mechanics.reduction.separation_statement import hamilton_jacobi

    return statements.noted(hamilton_jacobi(statements.derivation))


def blocks(section: HamiltonJacobiSection, _: Answers) -> Iterator[Block]:
    """Say the equation, whether it separates, and the parts of S."""
    if section.hamiltonian is None:
        yield not_found(f"{section.reason}.")
        return
    if section.time_rate is not None:
        yield from _driven(section, section.time_rate)
        return
    words = " with respect to its coordinate:"
    yield Paragraph(("With each momentum the derivative of ", Label("S"), words))
    yield Equations((Row(Name(section.energy), section.hamiltonian),))
    parts: list[str | Formula] = [_NAMED[section.separable]]
    if section.obstacle:
        first, second = section.obstacle
        parts += [
            " in general" if section.in_general else "",
            ": Levi-Civita's condition fails for ",
            Name(first),
            " and ",
            Name(second),
        ]
    elif section.separable:
        parts += [" (Levi-Civita's condition holds)"]
    yield Paragraph((*parts, "."))
    if section.derivatives is None:
        if section.reason:
            yield not_found(f"{section.reason}.")
        return
    yield from _solution(section)


def _driven(section: HamiltonJacobiSection, rate: Expression) -> Iterator[Block]:
    """S = sum p_i(t) q_i + f(t), where the forces depend on the time alone."""
    assert section.hamiltonian is not None
    assert section.derivatives is not None
    S, H, t = Label("S"), Label("H"), Name("t")
    words = " with respect to its coordinate, "
    lead = ("Each momentum is the derivative of ", S, words, H)
    yield Paragraph((*lead, " is minus that with respect to ", t, ":"))
    yield Equations((Row(Label("H"), section.hamiltonian),))
    words = " is linear in the coordinates:"
    yield Paragraph(("The forces depend on the time alone, so ", S, words))
    action: list[str | Formula] = [Label("S"), " = "]
    rows = []
    for name, momentum in section.derivatives.items():
        action += [*([" + "] if len(action) > 2 else []), Product((Name(f"p_{name}"), Name(name)))]
        rows.append(Row(Name(f"p_{name}"), momentum))
    f = Label("f")
    yield Paragraph((*action, " + ", f, "; verified exactly by substitution into the equation."))
    rows = [row for row in rows if row.left != row.right]
    rows += [Row(Name(name), Integral(force, "t")) for name, force in section.integrals.items()]
    rows.append(Row(f, Integral(rate, "t")))
    if section.of_time is not None:
        rows.append(Row(f, section.of_time))
    yield Equations(tuple(rows))
    yield _constants(section)


def _constants(section: HamiltonJacobiSection) -> Paragraph:
    return Paragraph(("Constants: " if section.constants else "", *listed(section.constants), "."))


def _solution(section: HamiltonJacobiSection) -> Iterator[Block]:
    assert section.derivatives is not None
    if section.equations:
        yield Paragraph(("The separated equations:",))
        yield equations_of((ZERO, each) for each in section.equations.values())
    action: list[str | Formula] = [
        Label("S"),
        " = ",
        Negative(Product((Name(section.energy), Name("t")))),
    ]
    rows = []
    cases: list[tuple[str, ActionPart]] = []
    for name, derivative in section.derivatives.items():
        if name in section.equations:
            action += [" + ", Label("W", (name,))]
            rows.append(Row(Label("W", (name,)), Integral(derivative, name)))
            if name in section.functions:
                rows.append(Row(Label("W", (name,)), section.functions[name]))
            cases += [(name, each) for each in section.cases.get(name, ())]
        else:
            action += [" + ", Product((derivative, Name(name)))]
    checked = "each root with either sign; verified exactly by substitution into the equation."
    yield Paragraph((*action, f", {checked}"))
    if rows:
        yield Equations(tuple(rows))
    for name, each in cases:
        yield Paragraph(("Where ", *conditions(each.where), ","))
        yield Equations((Row(Label("W", (name,)), each.function),))
    if section.constants:
        yield _constants(section)


def json(section: HamiltonJacobiSection) -> Object:
    """The equation, its test, and the parts of S."""
    before = fields_of(section, "hamiltonian separable")
    names = "constants equations derivatives functions cases"
    if section.time_rate is not None:
        names += " time_rate of_time integrals"
    after = fields_of(section, f"{names} reason")
    return {
        "hamilton_jacobi": {
            **before,
            "obstacle": section.obstacle or None,
            "in_general": section.in_general,
            **after,
        }
    }


_EXPECTED = with_constants(
    record_of(
        ExpectHamiltonJacobi,
        "'hamilton_jacobi'",
        separable=YES,
        derivatives=by_coordinate("the expected derivative of W by '{}'"),
        functions=by_coordinate("the expected part W of the action by '{}'"),
    )
)
SECTION = declared(
    globals(),
    heading="Hamilton-Jacobi",
    order=220,
    explained=Explained(
        title="The Hamilton-Jacobi equation", blocks=step("phase_space:hamilton_jacobi"), order=90
    ),
    expected=(expected_of("hamilton_jacobi", _EXPECTED, judged("reductions:hamilton_jacobi")),),
)
