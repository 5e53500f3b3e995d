"""The Routhian without the cyclic coordinates, U_eff, turning points and the period."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import (
    Block,
    Equations,
    Formula,
    Heading,
    Integral,
    Label,
    Paragraph,
    Row,
    equations_of,
    vanishing,
)
from lagcli.expression import (
    Expression,
    Name,
    Negative,
    Sum,
    operation_count,
    opposite,
    terms_of,
    walk,
)
from lagcli.formatters.json_values import Object, fields_of
from lagcli.notation.letters import own
from lagcli.notation.likeness import signed_key
from lagcli.problem_data import ExpectReduction
from lagcli.reader.shapes import by_coordinate, formula, formulas, record_of, with_constants
from lagcli.rewriting import put_in
from lagcli.sections._expected import expected_of, judged
from lagcli.sections.equations import equation_json
from lagcli.statements.answers import Answers, ReductionSection
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.motions import OneFreedom, PeriodSeries
from lagcli.statements.plus_minus import once
from lagcli.statements.turning_points import turning_contacts, turning_points
from lagcli.statements.wording import (
    POTENTIALS,
    capitalized,
    conditions,
    irreducible,
    naming_potential,
    none_cyclic,
    state_blocks,
    used_to_eliminate,
    with_constraints,
)

if TYPE_CHECKING:
    from lagcli.mechanics.statements import Statements

#: Operations of a rate that is written out.
_ONE_LINE = 16


def derive(statements: Statements) -> ReductionSection:
    """Routh's reduction, and the quadrature of one remaining freedom."""
    from lagcli.mechanics.reduction.statement import reduction

    return statements.noted(reduction(statements.derivation))


def blocks(section: ReductionSection, _: Answers) -> Iterator[Block]:
    """Say the Routhian, what it is made of, and the motion that is left."""
    if section.eliminated:
        yield Paragraph((*used_to_eliminate(section.eliminated), "."))
    for name, each in section.irreducible.items():
        yield Paragraph(tuple(irreducible(name, each, own("L"))))
    if section.momenta:
        yield Paragraph(("Constant, since the coordinates are cyclic:",))
        yield Equations(
            tuple(
                Row(Name(f"p_{name}"), value, section.when.get(name, ""))
                for name, value in section.momenta.items()
            )
        )
    elif section.irreducible:
        yield Paragraph(("The Routhian is the Lagrangian.",))
    else:
        yield Paragraph((f"{none_cyclic(section.eliminated)}: the Routhian is the Lagrangian.",))
    if section.routhian is None:
        yield Paragraph((f"Not found: {section.reason}.",))
        return
    if section.momenta:
        words = "The Routhian, the Lagrangian minus the products of these momenta and velocities:"
        yield Paragraph((words,))
    rows, given = [], not (section.momenta or section.eliminated)  # R is the L of the file
    if not given:
        rows.append(Row(Label("R"), section.routhian))
    if section.effective_potential is not None and not (given and section.potential == "V"):
        rows.append(Row(POTENTIALS[section.potential], section.effective_potential))
    if rows:
        yield Equations(tuple(rows))
    yield from _gyroscopic(section)
    if section.momenta or section.eliminated:  # else they are those of the file
        s = "s" * (len(section.equations) > 1)
        yield Paragraph((f"Its equation{s} of motion:",))
        yield equations_of((each.left, each.right) for each in section.equations)
        yield from with_constraints(section.constraints)
    if section.reconstruction:
        yield Paragraph(("The cyclic coordinates follow from",))
        yield equations_of((Name(name, 1), value) for name, value in section.reconstruction.items())
    if section.one_freedom is not None:
        yield Heading("One degree of freedom", 2)
        yield from _one_freedom(section.one_freedom, section)


def _gyroscopic(section: ReductionSection) -> Iterator[Block]:
    if not section.gyroscopic:
        return
    changing = "forces as their factors change with the time"
    effects = ["gyroscopic forces"] * section.gyroscopic_forces
    effects += [changing] * section.gyroscopic_change
    effect = " and ".join(effects) or "no force, since their sum is a total derivative"
    yield Paragraph((f"The terms linear in the velocities give {effect}; their factors are",))
    yield equations_of((Label("g", (name,)), value) for name, value in section.gyroscopic.items())


def _one_freedom(motion: OneFreedom, section: ReductionSection) -> Iterator[Block]:
    constant = Name(motion.constant)
    potential = POTENTIALS[section.potential]
    yield Equations((Row(constant, motion.energy, f"conserved {motion.when}".rstrip()),))
    if motion.turning_points is None:
        yield Paragraph(("The turning points are the roots of ", potential, " = ", constant, "."))
    elif motion.turning_points:
        yield from turning_points(motion, ("Turning points, where these are ",))
        if motion.turning_finite:
            yield Paragraph(("for ", *conditions(motion.turning_finite), "."))
        for lower, upper in motion.turning_energies:
            yield Paragraph(("They are real for ", lower, " ≤ ", constant, " ≤ ", upper, "."))
        yield from turning_contacts(motion)
    else:
        yield Paragraph(("There are no turning points.",))
    several = motion.turning_points is None or len(motion.turning_points) > 1
    turns_back = several and motion.oscillates
    rate = _by_potential(motion, section)
    bound = Row(Label("T"), Integral(rate, motion.coordinate, times=2))
    yield Paragraph(("Time, and period between two turning points:" if turns_back else "Time:",))
    time = Row(Name("t"), Integral(rate, motion.coordinate))
    yield Equations((time, bound) if turns_back else (time,))
    for period in once(motion.periods):
        yield from _period(period, motion.coordinate, potential)
    if motion.reason:
        yield Paragraph(naming_potential(f"{capitalized(motion.reason)}."))


def _by_potential(motion: OneFreedom, section: ReductionSection) -> Expression:
    """dt/dq with E − U_eff as in Landau and Lifshitz, section 11, where that is not short."""
    potential = section.effective_potential
    if potential is None or operation_count(motion.rate) <= _ONE_LINE:
        return motion.rate
    excess = {signed_key(t) for t in map(opposite, terms_of(potential))}
    excess.add(signed_key(Name(motion.constant)))
    named = Sum((Name(motion.constant), Negative(own(section.potential))))
    found: dict[Expression, Expression] = {
        part: named
        for part in walk(motion.rate)
        if isinstance(part, Sum) and set(map(signed_key, part.terms)) == excess
    }
    return put_in(motion.rate, found)


def _period(period: PeriodSeries, coordinate: str, potential: Formula) -> Iterator[Block]:
    if period.root_of is not None:
        q = Name(coordinate)
        yield Paragraph(
            ("Small oscillations about any ", q, " where ", potential, " has a minimum:")
        )
        yield vanishing((period.root_of,))
    elif period.amplitude:
        yield from state_blocks(period.at, "Oscillations about ")
        yield Paragraph((Name(period.amplitude), " is half the distance of the turning points:"))
    else:
        small = "" if period.order else "small "
        yield from state_blocks(period.at, f"{small}oscillations about ".capitalize())
    note = f"to order {period.order}" if period.order else ""
    if note and not period.amplitude:
        note = f"independent of the amplitude{'' if period.isochronous else f' {note}'}"
    yield Equations((Row(Label("T"), period.period, note),))
    if period.where:
        yield Paragraph(("where ", *conditions(period.where), "."))
    if period.by_energy is not None:
        yield Equations((Row(Label("T"), period.by_energy, "at every amplitude"),))
        if period.energies:
            yield Paragraph(("where ", *conditions(period.energies), "."))


def json(section: ReductionSection) -> Object:
    """Null where there is no Routhian."""
    return {"reduction": None if section.routhian is None else _reduced(section)}


def _reduced(section: ReductionSection) -> Object:
    return {
        **fields_of(section, "momenta routhian"),
        "equations": [equation_json(each) for each in section.equations],
        **fields_of(section, "reconstruction effective_potential gyroscopic"),
        "one_freedom": _one_freedom_json(section.one_freedom),
    }


def _one_freedom_json(motion: OneFreedom | None) -> Object | None:
    if motion is None:
        return None
    return {
        **fields_of(motion, "coordinate constant energy turning_points rate"),
        "periods": [_period_json(each) for each in motion.periods],
        "reason": motion.reason,
    }


def _period_json(period: PeriodSeries) -> Object:
    place = fields_of(period, "at" if period.root_of is None else "root_of")
    amplitude = {"amplitude": period.amplitude or None}
    by_energy = fields_of(period, "by_energy energies") if period.by_energy is not None else {}
    return place | amplitude | fields_of(period, "order isochronous period where") | by_energy


_EXPECTED = with_constants(
    record_of(
        ExpectReduction,
        "'reduction'",
        routhian=formula("the expected routhian"),
        effective_potential=formula("the expected effective potential"),
        reconstruction=by_coordinate("the expected velocity of '{}'"),
        turning_points=formulas("the expected turning points"),
        period=formula("the expected period"),
    )
)
SECTION = declared(
    globals(),
    heading="Reduction",
    order=200,
    explained=Explained(title="The reduction", blocks=step("reduction:reduction"), order=40),
    abbreviated=True,
    expected=(expected_of("reduction", _EXPECTED, judged("reductions:reduction")),),
)
