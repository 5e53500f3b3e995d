"""A problem file to a checked `Problem`, with every mistake of the file at once."""

from __future__ import annotations

import re
from functools import partial
from pathlib import PurePath

from lagcli.diagnostics import Diagnostic, ProblemError, Source, Span
from lagcli.expression import Expression, name_nodes
from lagcli.problem_data import Problem
from lagcli.reader.compose import compose, without_wrong_texts
from lagcli.reader.contacts import declare_contacts, read_contacts
from lagcli.reader.dynamics import (
    check_energies,
    check_masses,
    check_momenta,
    declare_definitions,
    read_by_coordinate,
    read_definitions,
    read_points,
)
from lagcli.reader.expectations import ExpectReader
from lagcli.reader.file_reader import FileReader
from lagcli.reader.functions import read_functions
from lagcli.reader.habits import KEYS, colon_advice, key_meant
from lagcli.reader.misfits import dimension_mistakes
from lagcli.reader.misplaced import lifted
from lagcli.reader.names import derivative_order
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, kind
from lagcli.reader.phase_space import (
    mend_velocities,
    read_brackets,
    read_observables,
    read_transformations,
)
from lagcli.reader.quantities import declared, read_coordinates, read_parameters
from lagcli.reader.questions import read_find, read_initial, read_simulation
from lagcli.reader.regex import regex
from lagcli.reader.restrictions import check_multipliers, declare_constraints, read_constraints
from lagcli.reader.scenery import read_scenery
from lagcli.reader.scope import PHASE_SPACE, STATE, Role
from lagcli.reader.symmetries import read_symmetries
from lagcli.reader.text import Mistake, SourceText, decode
from lagcli.reader.undeclared import once, undeclared_velocity
from lagcli.reader.value_checks import check_values, slips
from lagcli.record import record, replace

#: A name that begins with x.
_X = regex(r"(?<![^\W\d_])x")
#: The sections without whose names no formula is checked.
_OF_NAMES = frozenset({"coordinates", "parameters", "functions", "definitions"})


@record
class ProblemReading:
    """What came of a file: the problem, unless a diagnostic is an error."""

    source: Source
    problem: Problem | None
    diagnostics: tuple[Diagnostic, ...] = ()

    def checked(self) -> Problem:
        """The problem; `ProblemError` with all diagnostics, when there is none."""
        if self.problem is None:
            raise ProblemError(self.source, self.diagnostics)
        return self.problem


def read_problem(source_name: str, data: bytes) -> ProblemReading:
    """The problem of a file and the diagnostics, sorted by their place; `-` is standard input."""
    source, diagnostics = decode(source_name, data)
    if diagnostics:
        return ProblemReading(source, None, tuple(diagnostics))
    reading = _read_lines(source)
    if reading.problem is not None:
        return reading
    from lagcli.reader.foreign_lines import without_foreign_lines

    wrong, texts = without_foreign_lines(source.text)
    if not wrong:
        from lagcli.reader.edits import as_typed

        found = tuple(as_typed(each, source) for each in reading.diagnostics)
        return replace(reading, diagnostics=found)
    others = (_read_lines(replace(source, text=text)).diagnostics for text in texts)
    errors = ([each for each in found if each.is_error] for found in others)
    both = (*wrong, *min(errors, key=len))
    return ProblemReading(source, None, tuple(sorted(both, key=lambda each: each.span)))


def _read_lines(source: Source) -> ProblemReading:
    """The problem and the diagnostics, also where a line is not YAML."""
    try:
        return _read_source(source)
    except Mistake as error:
        from lagcli.reader.line_repair import all_mistakes

        found = all_mistakes(
            source.text, error.diagnostics, _mistakes, partial(_mistakes, alone=False)
        )
        return ProblemReading(source, None, found)


def _mistakes(source: Source, *, alone: bool = True) -> tuple[bool, tuple[Diagnostic, ...]]:
    """Whether YAML reads a text, and its mistakes; with `alone` also those that others hide."""
    try:
        return True, _read_source(source, alone=alone).diagnostics
    except Mistake as error:
        return False, error.diagnostics


def _read_source(source: Source, *, alone: bool = True) -> ProblemReading:
    """The problem that a text writes; `Mistake` where it is not YAML.

    With `alone` the one cause of several terms that do not fit is reported, where there is one.
    """
    root, problem, mistakes = _composed(source, alone=alone)
    entries = root.pairs
    meant = [(key_meant(key.label, KEYS), value) for key, value in entries]
    if alone and problem is None:
        from lagcli.reader.mended import mended

        lines = [(v.span.line, v.span.end_line) for key, v in meant if key in _OF_NAMES]
        mistakes = mended(
            source,
            lambda text: _composed(text, alone=False),
            lambda text: _composed(text, alone=True),
            lambda each: any(first <= each.span.line <= last for first, last in lines),
        )
    sections = [(key.span.line, key.label) for key, _ in entries]
    parameters = (source.text[v.start : v.end] for key, v in meant if key == "parameters")
    found = once(mistakes, sections, next(parameters, ""))
    if re.fullmatch(r"[^\s<>:]+\.ya?ml", source.name):  # a command can be typed as it stands
        command = re.compile(r"(?<=lagcli )(\w+) FILE\b")
        found = tuple(
            replace(each, hint=command.sub(lambda m: f"{m[1]} {source.name}", each.hint))
            for each in found
        )
    has_errors = any(diagnostic.is_error for diagnostic in found)
    return ProblemReading(source, None if has_errors else problem, found)


def _composed(
    source: Source, *, alone: bool
) -> tuple[DocumentNode, Problem | None, list[Diagnostic]]:
    """The document of a text, the problem that it writes, and all of its mistakes."""
    root, diagnostics = compose(SourceText.of(source))
    file = FileReader(diagnostics=diagnostics, text=source.text)
    problem = _read(file, source, root)
    found = without_wrong_texts(file.diagnostics)
    file.diagnostics[:] = found if _X.search(source.text) else _in_own_names(found, file.scope.free)
    drawn = [v.span for k, v in root.pairs if k.label == "picture"]
    others = [each for each in file.diagnostics
              if not any(one.line <= each.span.line <= one.end_line for one in drawn)]  # fmt: skip
    has_errors = any(each.is_error for each in file.diagnostics)
    if problem is not None and not others:  # what is drawn has no dimension
        file.diagnostics += dimension_mistakes(
            problem, (lambda text: _composed(text, alone=False)[1:]) if alone else None
        ) or (slips(problem) if not has_errors else [])
    problem = None if has_errors else problem
    return root, problem, file.diagnostics


def _in_own_names(found: list[Diagnostic], coordinates: list[str]) -> list[Diagnostic]:
    """The mistakes with `p_q` and `-q` for the `p_x` and `-x` of an example, where x is unknown."""
    mended = []
    for each in found:
        words = {*re.findall(r"[^\W\d]\w*", each.hint.replace("p_", ""))}
        own = next((q for q in coordinates if q not in words and not words & {"y", "z"}), "x")
        hint = re.sub(r"(?<!\w)(p_)?x(?!\w)", rf"\g<1>{own}", each.hint)
        mended.append(replace(each, hint=hint))
    return mended


def _read(file: FileReader, source: Source, root: DocumentNode) -> Problem | None:
    """Declare every name, then read every formula."""
    span = Span(1, 1, 1, 1)
    if kind(root) == "nothing" or (isinstance(root, Mapping) and not root.entries):
        file.error("the problem is empty", span, "write coordinates: [x]")
        return None
    message = f"a problem must be a map of keys, not {kind(root)}"
    if isinstance(root, Scalar):
        line = root.text.source.text.lstrip().split("\n")[0]
        raise Mistake(Diagnostic(message, span, colon_advice(line)))
    if not isinstance(root, Mapping):
        file.error(message, span, "leave out the '-' before each key")
        return None
    inner = [value for _, value in root.entries]
    if all("coordinates" in {k.label for k, _ in x.pairs} for x in inner):
        key = root.entries[0][0]
        message = f"the problem stands under '{key.label}'"
        hint = "its keys begin the lines; the name is title: …"
        hint = f"each problem has a file of its own: {hint}" if inner[1:] else hint
        file.error(message, key.span, hint)
        return None
    root, moved = lifted(root)
    file.diagnostics += moved
    file.sections = frozenset(key.label for key, _ in root.entries)
    given = file.attributes(root, "the problem", KEYS)

    def section(key: str) -> DocumentNode:
        """The node at a key, or a map without entries."""
        return given[key][1] if key in given else Mapping(root.text, 0, 0, [])

    def formula(key: str, role: Role = STATE) -> Expression | None:
        return file.expression(given[key][1], key, role) if key in given else None

    def text(key: str) -> str | None:
        scalar = file.scalar(given[key][1], f"'{key}'") if key in given else None
        return scalar.value.strip() if scalar else None

    coordinates = read_coordinates(file, section("coordinates"))
    parameters = [*declared(file, section("parameters"), "parameters")]
    functions = read_functions(file, section("functions"))
    definitions = declare_definitions(file, section("definitions"))
    constraints = declare_constraints(file, section("constraints"))
    names = {one.key.label for one in constraints}
    contacts = declare_contacts(file, section("contacts"), names)
    check_momenta(file)
    check_energies(file, given)
    check_multipliers(
        file, [v for k, (_, v) in given.items() if k in "TVL" and isinstance(v, Scalar)]
    )

    parameters_read = read_parameters(file, parameters)
    definitions_read = read_definitions(file, definitions)
    points = read_points(file, section("points"))
    constraints_read = read_constraints(file, constraints)
    symmetries = read_symmetries(file, section("symmetries"))
    questions = read_find(file, section("find"))
    contacts_read = read_contacts(file, contacts)
    observables = read_observables(file, section("observables"))
    brackets = read_brackets(file, section("brackets"), symmetries)
    transformations = read_transformations(file, section("canonical_transformations"))
    problem = Problem(
        source=source,
        title=text("title") or _stem(source.name),
        reference=text("source"),
        description=text("description"),
        coordinates=coordinates,
        parameters=parameters_read,
        functions=functions,
        definitions=definitions_read,
        points=points,
        kinetic=formula("T"),
        potential=formula("V"),
        lagrangian=formula("L"),
        hamiltonian=formula("H", PHASE_SPACE),
        forces=read_by_coordinate(file, section("forces"), "forces", "the force along '{}'"),
        dissipation=formula("dissipation"),
        constraints=constraints_read,
        contacts=contacts_read,
        symmetries=symmetries,
        observables=observables,
        brackets=brackets,
        canonical_transformations=transformations,
        initial=read_initial(file, section("initial")),
        find=questions,
        simulation=read_simulation(file, section("simulation")),
        picture=read_scenery(file, section("picture"), points),
    )
    potential = problem.potential
    at_rest = potential is None or derivative_order(potential, file.scope) < 1
    if file.diagnostics and problem.kinetic is not None and at_rest:
        mend_velocities(file, section("observables"), problem.kinetic)
    _rename(file, problem)
    problem = replace(problem, expect=ExpectReader(file, problem).read(section("expect")))
    if len(given) == len(root.entries):  # else the energy may be there under another key
        check_masses(file, problem, section("points").span)
    if not file.diagnostics:
        check_values(file, problem)
    return problem


def _rename(file: FileReader, problem: Problem) -> None:
    """Take the only unknown velocity for that of the only coordinate that nothing contains."""
    used = {part.name for part in name_nodes(*problem.formulas)}
    unused = [x for x in file.scope.coordinates if x not in used]
    moving = {name for each in file.diagnostics if (name := undeclared_velocity(each))}
    if len(unused) == len(moving) == 1:
        begin = f"unknown name '{moving.pop()}' in "
        file.diagnostics[:] = [
            replace(each, hint=f"did you mean '{unused[0]}'?")
            if each.message.startswith(begin) else each for each in file.diagnostics
        ]  # fmt: skip


def _stem(name: str) -> str:
    return "problem" if name == "-" or name.startswith("<") else PurePath(name).stem
