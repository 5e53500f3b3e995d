"""The Lie algebra of the discovered symmetries, and special values of the parameters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from lagcli.document import Block, Paragraph
from lagcli.expression import Expression
from lagcli.formatters.json_values import Object, fields_of
from lagcli.notation.letters import names_in, with_names
from lagcli.platform.effort import OutOfWork
from lagcli.platform.limited import limited_to
from lagcli.problem_data import ExpectAlgebra, ExpectSpecial
from lagcli.reader.scope import CONSTANTS
from lagcli.reader.shapes import (
    CHARGE,
    COUNT,
    WORD,
    YES,
    by_name,
    equation,
    formula,
    list_of,
    record_of,
)
from lagcli.record import replace
from lagcli.sections._expected import expected_of, judged
from lagcli.statements.answers import AlgebraSection, Answers, SpecialValue
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.motions import Above
from lagcli.statements.wording import conditions, rows_by_name, values_of, where_real, with_powers

if TYPE_CHECKING:
    from lagcli.mechanics.discovery.special import SpecialCase
    from lagcli.mechanics.statements import Statements

_SHARE = 0.8  # of the work that is left, for the Hamilton-Jacobi equation
#: Names of algebras that are the same for frequencies that are not real.
_AS_WELL = ("R^", "R with", "Heisenberg", "Galilei")


def derive(statements: Statements) -> AlgebraSection | None:
    """From the brackets of the generators; None where one is missing."""
    from lagcli.mechanics.discovery.summary import algebra_section, summary

    discovery = statements.derivation.discovery
    listed = (*discovery.charges, *discovery.momentum_equations)
    missing = discovery.unproved
    if not missing:
        found = summary(discovery)  # before the special values, which take the work that is left
        if not listed and not statements.derivation.special_cases:
            missing = "; ".join(discovery.stopped)
    if missing:
        statements.lacks("the algebra of all symmetries", missing)
        return None
    special = tuple(_special(statements, case) for case in statements.derivation.special_cases)
    section = algebra_section(discovery, found, lambda: _separates(statements))
    return replace(section, special=special, named_where=_named_where(statements, found.name))


def _special(statements: Statements, case: SpecialCase) -> SpecialValue:
    from lagcli.mechanics.discovery.reality import finite_where, real_where

    system, values = statements.system, [case.value, *(v for _, v in case.given)]
    charges = {c.name: statements.by_terms(c.charge) for c in case.charges}
    bounds = [b for charge in case.charges for b in real_where(charge, system, values)]
    return SpecialValue(
        parameter=case.parameter.name,
        value=statements.as_written(case.value),
        number=case.number,
        degree=case.degree,
        charges=charges,
        given={p.name: statements.as_written(value) for p, value in case.given},
        where=tuple(dict.fromkeys([*finite_where(charges.values(), system, values), *bounds])),
    )


def _named_where(statements: Statements, name: str | None) -> tuple[Above, ...]:
    """Where the charges are real, if the algebra of their real and imaginary parts is another.

    That of exp(±a t) for cos(a t) and sin(a t): a rotation becomes a hyperbolic one.
    """
    from lagcli.mechanics.discovery.reality import real_where

    if name is None or name.startswith(_AS_WELL) or "sl(2,R)" in name:
        return ()
    charges = statements.derivation.discovery.charges
    found = [each for c in charges for each in real_where(c, statements.derivation.system)]
    return tuple(each for each in dict.fromkeys(found) if "t" not in names_in(each))


def _separates(statements: Statements) -> bool:
    """Whether a complete integral of the Hamilton-Jacobi equation was found."""
    from lagcli.mechanics.reduction.separation import Separation

    separation = Separation(statements.derivation)
    try:
        found = limited_to(_SHARE, lambda: separation.driven or separation.separated)
    except OutOfWork:
        return False
    return found is not None and len(found.constants) == len(separation.system.q)


def blocks(section: AlgebraSection, answers: Answers) -> Iterator[Block]:
    """The ansatz, the algebra, whether the motion is integrable, and the special values."""
    named = [", ", *with_powers(section.name)] if section.name else []
    yield Paragraph(("Searched: ", *with_names(section.ansatz, answers.coordinates), "."))
    if section.is_prescribed:
        return
    number = section.independent
    charges = f"{number} independent conserved quantit{'y' if number == 1 else 'ies'}"
    if number is None:
        charges = "the number of independent conserved quantities is not known"
    if section.in_involution is not None:
        charges += f", {section.in_involution} in involution"
    counts = "" if section.dimension_counts == "charges" else f" of the {section.dimension_counts}"
    counts += ", modulo constants" if section.with_constants and not section.name else ""
    where = [" where ", *conditions(section.named_where)] if section.named_where else []
    lead = f"Dimension {section.dimension}{counts}"
    yield Paragraph((lead, *named, *where, f"; {charges}."))
    verdict = "The motion is integrable."
    if section.integrable is None:
        verdict = "Whether the motion is integrable is undecided."
    elif section.separates:
        verdict = "The Hamilton-Jacobi equation separates: the motion is integrable."
    elif section.determines == "state":
        verdict = "The motion is integrable: these give the state at every time."
    elif section.determines == "orbit":
        verdict = "The motion is integrable: these give the orbit, and a quadrature the time."
    yield Paragraph((verdict,))
    for cases in _alike(section.special):
        number = cases[0].number
        where = [
            part for k, case in enumerate(cases) for part in (" or " * bool(k), *values_of(case))
        ]
        plural = "y" if number == 1 else "ies"
        yield Paragraph(("Where ", *where, f": {number} symmetr{plural}, of which new"))
        yield rows_by_name(cases[0].charges)
        yield from where_real(cases[0].where, several=True)


def _alike(special: Sequence[SpecialValue]) -> list[list[SpecialValue]]:
    """The values of parameters at which there are the same symmetries."""
    found: dict[tuple[int, tuple[Expression, ...]], list[SpecialValue]] = {}
    for case in special:
        found.setdefault((case.number, tuple(case.charges.values())), []).append(case)
    return list(found.values())


def json(section: AlgebraSection) -> Object:
    """The counts, the verdict and the special values."""
    names = "ansatz dimension dimension_counts name independent in_involution integrable special"
    return {"algebra": fields_of(section, names)}


_SPECIAL = record_of(
    ExpectSpecial,
    "a special value",
    {"where": "a special value needs 'where', such as where: n = -1"},
    where=equation("the special value", CONSTANTS),
    charges=COUNT,
    discovered=by_name(formula("the expected charge '{}'", CHARGE)),
)
_EXPECTED = record_of(
    ExpectAlgebra,
    "'algebra'",
    dimension=COUNT,
    independent=COUNT,
    in_involution=COUNT,
    name=WORD,
    integrable=YES,
    special=list_of(_SPECIAL, "write [] where there are none"),
)
SECTION = declared(
    globals(),
    heading="Algebra of symmetries",
    order=160,
    explained=Explained(
        title="The algebra of the symmetries", blocks=step("symmetries:algebra"), order=110
    ),
    expected=(expected_of("algebra", _EXPECTED, judged("algebra:expected_algebra")),),
)
