"""Canonical transformations tested, their generating functions, the new Hamiltonian."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import (
    Block,
    Bracket,
    Equations,
    Formula,
    Heading,
    Label,
    Paragraph,
    Row,
    equations_of,
)
from lagcli.expression import Expression, Name, Number
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object, fields_of
from lagcli.problem_data import ExpectCanonical
from lagcli.reader.phase_space import FUNCTION
from lagcli.reader.schema_parts import FORMULA as EXPRESSION
from lagcli.reader.shapes import YES, Shape, formula, of_known, one_of, record_of
from lagcli.sections._expected import expected_of
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.phase_space import (
    ExaminedTransformation,
    GeneratingFunction,
    TransformationsSection,
)

if TYPE_CHECKING:
    from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.nodes import DocumentNode
    from lagcli.studies.check.expectations import Expectations, Found

_CHECKED = {"exact": "checked exactly", "50 digits": "checked at random states to 50 digits"}
_ONE = Number(Fraction(1))


def derive(statements: Statements | PhaseSpaceStatements) -> TransformationsSection:
    """Each transformation of the file, tested by its brackets."""
    from lagcli.mechanics.canonical.statement import PhaseSpace

    phase = PhaseSpace(statements.derivation)
    return statements.noted((phase.transformations(), phase.missing))


def blocks(section: TransformationsSection, _: Answers) -> Iterator[Block]:
    """Say of each transformation whether it is canonical, what generates it, and K."""
    if not section.transformations:
        yield Paragraph(("The file gives no transformation.",))
    for each in section.transformations:
        yield Heading(each.name, 2)
        yield equations_of((Name(name), f) for name, f in each.variables.items())
        yield Paragraph(tuple(_verdict(each)))
        if each.failing:
            yield equations_of(
                (Bracket(Name(f.left), Name(f.right)), f.value) for f in each.failing
            )
        if each.generator is not None:
            yield from _generator(each.generator, each)
        if each.hamiltonian is not None:
            how = each.hamiltonian_verified
            checked = "" if how is None else f", {_CHECKED[how]}"
            yield Paragraph((f"The Hamiltonian in the new variables{each.branch}{checked}:",))
            yield Equations((Row(Label("K"), each.hamiltonian),))
        elif each.reason:
            yield Paragraph((f"The new Hamiltonian was not found: {each.reason}.",))


def _verdict(each: ExaminedTransformation) -> list[str | Formula]:
    checked = "" if each.verified is None else f", {_CHECKED[each.verified]}"
    match each.kind:
        case "canonical":
            return [f"Canonical: the fundamental brackets are preserved{checked}."]
        case "extended canonical":
            assert each.valence is not None
            lead = "In general not canonical" if each.in_general else "Not canonical"
            return [
                f"{lead}, but extended canonical with the valence ",
                each.valence,
                f": each new bracket is that times the old one{checked}.",
            ]
        case "not canonical":
            values = {f.expected for f in each.failing}
            wanted: list[str | Formula] = ["what they should be"]
            if len(values) == 1 and all(isinstance(value, Number) for value in values):
                wanted = [values.pop()]
            one = len(each.failing) == 1
            if each.in_general:
                these = "this bracket" if one else "these brackets"
                return [f"In general not canonical: {these} need not be ", *wanted, "."]
            these = "this bracket is" if one else "these brackets are"
            return [f"Not canonical: {these} not ", *wanted, "."]
        case None:
            return ["Whether it is canonical is undecided."]


def _generator(generator: GeneratingFunction, each: ExaminedTransformation) -> Iterator[Block]:
    if generator.kind == "F":
        scale: list[str | Formula] = []
        if each.valence is not None and each.valence != _ONE:
            scale = [each.valence, " times "]
        yield Paragraph(
            ("At constant time, ", *scale, "the sum of p dq minus the sum of P dQ is dF with")
        )
        yield Equations((Row(Label("F"), generator.function),))
        return
    label = Label("F", (generator.kind[1],))
    yield Equations((Row(label, generator.function),))
    if generator.generates:
        yield Paragraph((label, " generates it: each of its derivatives was checked."))
    elif generator.generates is None:
        yield Paragraph(("Whether ", label, " generates it is undecided."))
    else:
        yield Paragraph((label, " does not generate it: its derivatives would make equal"))
        yield equations_of((left, right) for left, right in generator.failing)


def json(section: TransformationsSection) -> Object:
    """The verdict on each transformation."""
    return {"canonical": [_transformation(each) for each in section.transformations]}


def _transformation(each: ExaminedTransformation) -> Object:
    shown = fields_of(each, "name variables kind valence failing generator hamiltonian reason")
    if (found := each.generator) is not None:
        failing = [f"{to_grammar(left)} = {to_grammar(right)}" for left, right in found.failing]
        shown["generator"] = fields_of(found, "kind function generates") | {"failing": failing}
    return shown


def compare(
    check: Expectations, section: TransformationsSection, expected: Mapping[str, ExpectCanonical]
) -> Found:
    """The kind, the valence, the generating function, the new Hamiltonian."""
    found = {each.name: each for each in section.transformations}
    for name, wanted in expected.items():
        each, path = found[name], ["canonical", name]
        if wanted.kind is not None:
            yield check.same([*path, "kind"], each.kind, wanted.kind)
        if wanted.generates is not None:
            generates = None if each.generator is None else each.generator.generates
            yield check.same([*path, "generates"], generates, wanted.generates)
        if wanted.valence is not None:
            yield check.compare([*path, "valence"], each.valence, wanted.valence, check.free)
        if wanted.hamiltonian is not None:
            path = [*path, "hamiltonian"]
            yield check.compare(path, each.hamiltonian, wanted.hamiltonian, check.free)


def _read_hamiltonian(
    reader: ExpectReader, node: DocumentNode, path: tuple[str, ...]
) -> Expression:
    """A function of the new variables."""
    new = reader.transformations[path[1]].coordinates
    with reader.file.scope.also(new, "coordinate"):
        return reader.file.expression(node, "the expected new Hamiltonian", FUNCTION)


_EXPECTED = of_known(
    "transformation",
    attrgetter("transformations"),
    record_of(
        ExpectCanonical,
        "the expected '{}'",
        kind=one_of(("canonical", "extended canonical", "not canonical")),
        valence=formula("the expected valence", FUNCTION),
        generates=YES,
        hamiltonian=Shape(EXPRESSION, _read_hamiltonian),
    ),
)
SECTION = declared(
    globals(),
    heading="Canonical transformations",
    order=130,
    phase_space=derive,
    by_default=attrgetter("canonical_transformations"),
    explained=Explained(
        title="Canonical transformations", blocks=step("transformations:transformations"), order=80
    ),
    expected=(expected_of("canonical", _EXPECTED, compare),),
)
