"""What each section says, in words and equations; how it is set is the formatters' affair."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from lagcli.answers import (
    SECTIONS,
    AccelerationsSection,
    AlgebraSection,
    Answers,
    CanonicalSection,
    ChargesSection,
    ConstraintForcesSection,
    DimensionsSection,
    EnergySection,
    EquationsSection,
    EquilibriaSection,
    HamiltonianSection,
    LagrangianSection,
    MatrixFormSection,
    ModelSection,
    ModesSection,
    MomentaSection,
    MultipliersSection,
    ReductionSection,
    Section,
    Verification,
)
from lagcli.document import (
    Block,
    Document,
    Equations,
    Formula,
    Heading,
    Label,
    Matrix,
    Paragraph,
    Row,
)
from lagcli.expression import Expression, Name, walk
from lagcli.forces import ForcesSection
from lagcli.formatters.canonical import bracket_blocks, transformation_blocks
from lagcli.formatters.dimensions import dimension_blocks
from lagcli.formatters.findings import (
    charge_blocks,
    equilibrium_blocks,
    find_blocks,
    mode_blocks,
)
from lagcli.formatters.forces import force_blocks
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.reductions import reduction_blocks
from lagcli.formatters.separation import hamilton_jacobi_blocks
from lagcli.formatters.steady import steady_blocks
from lagcli.letters import names_in, settled
from lagcli.motions import HamiltonJacobiSection, SteadySection
from lagcli.phase_space import (
    BracketsSection,
    TransformationsSection,
)
from lagcli.questions import FindSection
from lagcli.rewriting import rewritten

_HEADINGS = {
    "lagrangian": "Lagrangian",
    "equations": "Equations of motion",
    "matrix_form": "Matrix form",
    "accelerations": "Accelerations",
    "multipliers": "Multipliers",
    "constraint_forces": "Constraint forces",
    "forces": "Forces",
    "momenta": "Momenta",
    "energy": "Energy",
    "hamiltonian": "Hamiltonian",
    "canonical_equations": "Canonical equations",
    "brackets": "Poisson brackets",
    "canonical": "Canonical transformations",
    "charges": "Symmetries and conserved quantities",
    "discovered": "Discovered symmetries",
    "algebra": "Algebra of symmetries",
    "find": "Questions",
    "equilibria": "Equilibria",
    "modes": "Normal modes",
    "reduction": "Reduction",
    "steady_motions": "Steady motions",
    "hamilton_jacobi": "Hamilton-Jacobi",
    "model": "Model",
    "dimensions": "Dimensions",
}

_CHECKED = {
    "exact": "exactly",
    "50 digits": "at random states to 50 digits",
}


def to_document(answers: Answers) -> Document:
    """Word the answers to one file, section by section."""
    blocks: list[Block] = [_system(answers)]
    first = _first_abbreviated(answers)
    for name in SECTIONS:
        if name in answers.sections:
            if name == first:
                blocks.append(Heading("Abbreviations"))
                blocks.append(_by_name(answers.where))
            blocks.append(Heading(_HEADINGS[name]))
            blocks.extend(section_blocks(answers.sections[name], answers))
        elif name in answers.absent:
            blocks += [Heading(_HEADINGS[name]), Paragraph(("Not found: see the warnings.",))]
    if answers.warnings:
        blocks.append(Heading("Warnings"))
        blocks.extend(Paragraph((warning,)) for warning in answers.warnings)
    page = Document(answers.title, tuple(blocks), answers.coordinates, answers.symbols)
    given = {*answers.coordinates, *answers.parameters, *answers.multipliers}
    return settled(page, given | names_in(answers.sections) - set(answers.where))


def _first_abbreviated(answers: Answers) -> str:
    """The first section whose formulas use an abbreviation: they are listed before it."""
    if not answers.where:
        return ""
    found: list[bool] = []

    def look(node: Expression) -> Expression:
        found.append(any(isinstance(p, Name) and p.name in answers.where for p in walk(node)))
        return node

    for name in SECTIONS:
        if name in answers.sections:
            rewritten(answers.sections[name], look)
            if any(found):
                return name
    return ""


def section_blocks(section: Section, answers: Answers) -> Iterable[Block]:
    """Word the blocks of one section, without its heading."""
    match section:
        case LagrangianSection(lagrangian=None):
            return [_not_found()]
        case LagrangianSection(lagrangian=Expression() as lagrangian):
            return [_equation(Label("L"), lagrangian)]
        case EquationsSection():
            return _equations(section)
        case MatrixFormSection():
            return _matrix_form(section, answers)
        case AccelerationsSection():
            return _accelerations(section)
        case MultipliersSection():
            return _multipliers(section)
        case ConstraintForcesSection():
            return _constraint_forces(section)
        case ForcesSection():
            return force_blocks(section)
        case MomentaSection():
            return _momenta(section)
        case EnergySection():
            return _energy(section)
        case HamiltonianSection(hamiltonian=None, reason=reason):
            return [_not_found(reason)]
        case HamiltonianSection(hamiltonian=Expression() as hamiltonian):
            return [_equation(Label("H"), hamiltonian)]
        case CanonicalSection():
            return _canonical(section)
        case BracketsSection():
            return bracket_blocks(section)
        case TransformationsSection():
            return transformation_blocks(section)
        case ChargesSection():
            return charge_blocks(section)
        case AlgebraSection():
            return _algebra(section)
        case FindSection():
            return find_blocks(section)
        case EquilibriaSection():
            return equilibrium_blocks(section)
        case ModesSection():
            return mode_blocks(section)
        case ReductionSection():
            return reduction_blocks(section)
        case SteadySection():
            return steady_blocks(section)
        case HamiltonJacobiSection():
            return hamilton_jacobi_blocks(section)
        case ModelSection():
            return _model(section)
        case DimensionsSection():
            return dimension_blocks(section)
        case _:
            raise TypeError(f"{type(section).__name__} has no wording")


def _system(answers: Answers) -> Paragraph:
    count = answers.degrees_of_freedom
    freedom = f"{count} degree{'' if count == 1 else 's'} of freedom."
    parts = ["Coordinates ", *_listed(answers.coordinates)]
    if answers.parameters:
        parts += ["; parameters ", *_listed(answers.parameters)]
    return Paragraph((*parts, "; ", freedom))


def _equations(section: EquationsSection) -> Iterator[Block]:
    if section.equations is None:
        yield _not_found()
        return
    yield Equations(tuple(Row(each.left, each.right) for each in section.equations))
    if section.constraints:
        yield Paragraph(("with the constraints",))
        yield Equations(
            tuple(Row(left, right, name) for name, (left, right) in section.constraints.items())
        )


def _matrix_form(section: MatrixFormSection, answers: Answers) -> Iterator[Block]:
    if not section.mass_matrix:
        yield _not_found()
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
        yield _by_name(section.shared)


def _column(label: Label, entries: tuple[Expression, ...], names: tuple[str, ...]) -> Matrix:
    return Matrix(label, tuple((entry,) for entry in entries), names, ())


def _accelerations(section: AccelerationsSection) -> Iterator[Block]:
    if section.accelerations is None:
        yield _not_found()
    else:
        yield _by_name(section.accelerations, primes=2)
        yield from _checked(section.verified)
    if not section.regular:
        yield Paragraph(
            ("The Lagrangian is singular; degenerate: ", *_listed(section.degenerate), ".")
        )


def _multipliers(section: MultipliersSection) -> Iterator[Block]:
    found = []
    for constraint, each in section.multipliers.items():
        note = f"{constraint}: {each.kind}"
        if each.value is not None:
            found.append(Row(Name(each.symbol), each.value, note))
        else:
            undetermined = "redundant, so not determined"
            why = undetermined if section.redundant else "not found"
            yield Paragraph((Name(each.symbol), f" ({note}): {why}."))
    if found:
        yield Equations(tuple(found))
    elif not section.multipliers:
        yield Paragraph(("There are no constraints.",))
    if section.redundant:
        yield Paragraph(("Redundant: " + ", ".join(section.redundant) + ".",))
    for level in ("exact", "50 digits"):
        symbols = [each.symbol for each in section.multipliers.values() if each.verified == level]
        all_alike = len(symbols) == len(found)
        if symbols:
            yield from _checked(level, () if all_alike else symbols)


def _constraint_forces(section: ConstraintForcesSection) -> Iterator[Block]:
    if not section.forces:
        yield Paragraph(("There are no constraints.",))
    for constraint, forces in section.forces.items():
        yield Heading(constraint, 2)
        if forces is None or None in forces.values():
            yield Paragraph(("Not determined.",))
        else:
            yield _forces({name: each for name, each in forces.items() if each is not None})
        for point, components in section.on_points.get(constraint, {}).items():
            axes = "xyz" if len(components) > 1 else "x"
            rows = zip(axes, components, strict=False)
            yield Equations(
                tuple(
                    Row(Label("F", (point, axis)), part, "force on the point")
                    for axis, part in rows
                )
            )
    if section.total is not None and len(section.forces) > 1:
        yield Heading("All constraints together", 2)
        yield _forces(section.total)


def _forces(forces: Mapping[str, Expression]) -> Equations:
    return Equations(tuple(Row(Label("Q", (name,)), force) for name, force in forces.items()))


def _momenta(section: MomentaSection) -> Iterator[Block]:
    if section.momenta is None:
        yield _not_found()
    else:
        yield _by_name({f"p_{name}": momentum for name, momentum in section.momenta.items()})
    if section.cyclic:
        yield Paragraph(("Cyclic: ", *_listed(section.cyclic), "."))


def _energy(section: EnergySection) -> Iterator[Block]:
    yield _not_found() if section.function is None else _equation(Label("h"), section.function)
    conserved = {True: "Conserved.", False: "Not conserved.", None: "Conservation undecided."}
    total = {
        True: " It equals T + V.",
        False: " It does not equal T + V.",
        None: "",
    }
    words = conserved[section.conserved] + total[section.is_total_energy]
    reason = section.reason.strip().rstrip(".")
    if reason.startswith(
        ("conserved", "not conserved", "whether it is conserved")
    ):  # it says all of that, and why
        yield Paragraph((f"{reason[0].upper()}{reason[1:]}.",))
    else:
        yield Paragraph((f"{words} {reason}.".replace(" .", ""),))


def _canonical(section: CanonicalSection) -> Iterator[Block]:
    if section.equations is None:
        yield _not_found(section.reason)
        return
    rows = []
    for name, pair in section.equations.items():
        rows += [Row(Name(name, 1), pair.q), Row(Name(f"p_{name}", 1), pair.p)]
    yield Equations(tuple(rows))


def _algebra(section: AlgebraSection) -> Iterator[Block]:
    named = f", {section.name}" if section.name else ""
    integrable = {
        True: "The motion is integrable.",
        None: "Whether the motion is integrable is undecided.",
    }
    yield Paragraph((f"Searched: {section.ansatz}.",))
    number = section.independent
    charges = f"{number} independent conserved quantit{'y' if number == 1 else 'ies'}"
    if number is None:
        charges = "the number of independent conserved quantities is not known"
    if section.in_involution is not None:
        charges += f", {section.in_involution} in involution"
    counts = "" if section.dimension_counts == "charges" else f" of the {section.dimension_counts}"
    yield Paragraph((f"Dimension {section.dimension}{counts}{named}; {charges}.",))
    yield Paragraph((integrable[section.integrable],))
    for case in section.special:
        where = f"{case.parameter} = {to_grammar(case.value)}"
        yield Heading(
            f"Where {where}: {case.number} symmetr{'y' if case.number == 1 else 'ies'}, of "
            f"which new",
            2,
        )
        yield _by_name(case.charges)


def _model(section: ModelSection) -> Iterator[Block]:
    if section.kept is None:
        yield _not_found()
        return
    yield Paragraph(("Integrated: ", *_listed(section.kept), "."))
    if section.eliminated:
        yield Paragraph(("Eliminated:",))
        yield _by_name(section.eliminated)
    if section.ignorable:
        yield Paragraph(("Ignorable: ", *_listed(section.ignorable), "."))
    if section.dropped:
        yield Paragraph(("Without influence: ", *_listed(section.dropped), "."))
    for name, reason in section.reason.items():
        yield Paragraph((Name(name), f": {reason}."))


def _checked(level: Verification | None, symbols: Iterable[str] = ()) -> Iterator[Paragraph]:
    if level is not None:
        names = _listed(tuple(symbols))
        head = (*names, " substituted") if names else ("Substituted",)
        yield Paragraph((*head, f" into the equations of motion: verified {_CHECKED[level]}."))


def _not_found(reason: str = "") -> Paragraph:
    return Paragraph((f"Not found{': ' + reason if reason else '.'}",))


def _equation(left: Formula, right: Expression) -> Equations:
    return Equations((Row(left, right),))


def _by_name(expressions: Mapping[str, Expression], primes: int = 0) -> Equations:
    return Equations(tuple(Row(Name(name, primes), each) for name, each in expressions.items()))


def _listed(names: tuple[str, ...]) -> list[str | Formula]:
    parts: list[str | Formula] = []
    for name in names:
        parts += [", ", Name(name)] if parts else [Name(name)]
    return parts
