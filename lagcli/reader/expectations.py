"""The section `expect`: the known answers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lagcli.problem import (
    NOT_CONSERVED,
    BracketQuestion,
    Constraint,
    Contact,
    Expect,
    ExpectAlgebra,
    ExpectCanonical,
    ExpectEquilibrium,
    ExpectHamiltonJacobi,
    ExpectReduction,
    ExpectSteady,
    Inequality,
    Lasting,
    Point,
    Question,
    Reaching,
    Symmetry,
    Trajectory,
    Transformation,
)
from lagcli.reader.columns import named_columns
from lagcli.reader.dynamics import read_by_coordinate
from lagcli.reader.expected_algebra import read_algebra, read_count
from lagcli.reader.expected_ranges import read_ranges
from lagcli.reader.expected_reduction import (
    read_equilibria,
    read_hamilton_jacobi,
    read_reduction,
    read_steady_motions,
)
from lagcli.reader.nodes import Node, Scalar, Sequence
from lagcli.reader.phase_space import read_expected_brackets, read_expected_canonical
from lagcli.reader.scope import CONSTANTS, EQUATION, PHASE_SPACE, STATE, Role
from lagcli.reader.suggest import did_you_mean
from lagcli.reader.trajectory import TrajectoryReader

if TYPE_CHECKING:
    from lagcli.diagnostics import Span
    from lagcli.expression import Equation, Expression
    from lagcli.reader.sections import Sections

KEYS = (
    "degrees_of_freedom", "equations", "accelerations", "multipliers", "constraint_forces",
    "forces", "friction_needed", "momenta", "hamiltonian", "energy", "charges", "discovered",
    "equilibria", "modes", "find", "trajectory", "reduction", "steady_motions", "hamilton_jacobi",
    "brackets", "canonical", "algebra",
)  # fmt: skip

#: An answer holds what is left when accelerations and multipliers have been eliminated.
_ANSWER = Role(order=1, why="an answer is free of accelerations", integrals=True)


class ExpectReader:
    """Reads the section key by key, and remembers where each expectation stands."""

    def __init__(
        self,
        sections: Sections,
        constraints: tuple[Constraint, ...],
        contacts: tuple[Contact, ...],
        symmetries: tuple[Symmetry, ...],
        find: tuple[Question, ...],
        points: tuple[Point, ...],
        brackets: tuple[BracketQuestion, ...],
        transformations: tuple[Transformation, ...],
    ) -> None:
        self.sections = sections
        self.constraints = [constraint.name for constraint in constraints]
        self.holding = [*self.constraints, *(contact.name for contact in contacts)]
        self.columns = named_columns(sections.scope, (*constraints, *contacts), symmetries)
        self.symmetries = [symmetry.name for symmetry in symmetries]
        self.brackets = [bracket.name for bracket in brackets]
        self.transformations = transformations
        self.points = [point.name for point in points]
        self.questions = {question.name: question for question in find}
        self.ranges: dict[str, tuple[tuple[Inequality, ...], ...]] = {}
        self.spans: dict[tuple[str, ...], Span] = {}

    def read(self, node: Node) -> Expect:
        """The whole section."""
        found = self.sections.attributes(node, "expect", KEYS)
        values: dict[str, Any] = {}
        for name, (key, value) in found.items():
            self.spans[(name,)] = key.span
            values[name] = getattr(self, f"_{name}")(value)
        return Expect(**values, ranges=self.ranges, spans=self.spans)

    def _degrees_of_freedom(self, node: Node) -> int | None:
        return read_count(self.sections, node, "degrees_of_freedom")

    def _equations(self, node: Node) -> tuple[Equation, ...]:
        equations = []
        for place, item in enumerate(self.sections.items(node, "'equations'")):
            self.spans["equations", str(place)] = item.span
            equations.append(self.sections.equation(item, "an expected equation", EQUATION))
        return tuple(equations)

    def _accelerations(self, node: Node) -> dict[str, Expression]:
        return self._by_coordinate(node, "accelerations", "the expected acceleration of '{}'")

    def _momenta(self, node: Node) -> dict[str, Expression]:
        return self._by_coordinate(node, "momenta", "the expected momentum of '{}'")

    def _trajectory(self, node: Node) -> Trajectory:
        return TrajectoryReader(self.sections, self.holding, self.columns, self.spans).read(node)

    def _multipliers(self, node: Node) -> dict[str, Expression]:
        found = {}
        for key, value in self._known(node, "multipliers", self.constraints, "constraint"):
            what = f"the expected multiplier of '{key.label}'"
            found[key.label] = self.sections.expression(value, what, _ANSWER)
        return found

    def _constraint_forces(self, node: Node) -> dict[str, dict[str, Expression]]:
        found = {}
        for key, value in self._known(node, "constraint_forces", self.constraints, "constraint"):
            what = f"the expected force of '{key.label}' along '{{}}'"  # no braces in a name
            forces = read_by_coordinate(self.sections, value, f"'{key.label}'", what, _ANSWER)
            found[key.label] = forces
            self._note(value, "constraint_forces", key.label)
        return found

    def _forces(self, node: Node) -> dict[str, dict[str, Expression | tuple[Expression, ...]]]:
        """By constraint and point: the signed force, or a list of components."""
        found: dict[str, dict[str, Expression | tuple[Expression, ...]]] = {}
        for key, value in self._known(node, "forces", self.constraints, "constraint"):
            by_point = found[key.label] = {}
            for point, force in self._known(value, f"forces of {key.label}", self.points, "point"):
                self.spans["forces", key.label, point.label] = point.span
                what = f"the expected force of '{key.label}' on '{point.label}'"
                by_point[point.label] = (
                    tuple(self.sections.expression(item, what, _ANSWER) for item in force.items)
                    if isinstance(force, Sequence)
                    else self.sections.expression(force, what, _ANSWER)
                )
        return found

    def _friction_needed(self, node: Node) -> dict[str, Expression]:
        what = "the expected coefficient of friction at '{}'"
        known = self._known(node, "friction_needed", self.constraints, "constraint")
        return {
            key.label: self.sections.expression(value, what.format(key.label), _ANSWER)
            for key, value in known
        }

    def _hamiltonian(self, node: Node) -> Expression:
        return self.sections.expression(node, "the expected Hamiltonian", PHASE_SPACE)

    def _energy(self, node: Node) -> Expression:
        return self.sections.expression(node, "the expected energy", STATE)

    def _charges(self, node: Node) -> dict[str, Expression | str]:
        momenta = [f"p_{name}" for name in self.sections.scope.of_kind("coordinate")]
        known = [*self.symmetries, "energy", *momenta]
        entries = self._known(node, "charges", known, "charge")
        return {key.label: self._charge(key, value) for key, value in entries}

    def _charge(self, key: Scalar, value: Node) -> Expression | str:
        if isinstance(value, Scalar) and " ".join(value.value.split()) == NOT_CONSERVED:
            return NOT_CONSERVED
        return self.sections.expression(value, f"the expected charge '{key.label}'", _ANSWER)

    def _discovered(self, node: Node) -> dict[str, Expression | str]:
        """Charges under any names: nobody listed their symmetries."""
        self._note(node, "discovered")
        entries = self.sections.entries(node, "'discovered'")
        return {key.label: self._charge(key, value) for key, value in entries}

    def _algebra(self, node: Node) -> ExpectAlgebra:
        return read_algebra(self.sections, node, self.spans)

    def _modes(self, node: Node) -> tuple[Expression, ...]:
        modes = []
        for place, item in enumerate(self.sections.items(node, "'modes'", "write [sqrt(g/l)]")):
            self.spans["modes", str(place)] = item.span
            modes.append(self.sections.expression(item, "an expected frequency", CONSTANTS))
        return tuple(modes)

    def _find(self, node: Node) -> dict[str, tuple[Expression, ...]]:
        found = {}
        for key, value in self._known(node, "find", list(self.questions), "question"):
            items = value.items if isinstance(value, Sequence) else [value]
            what = f"the expected answer to '{key.label}'"
            question = self.questions[key.label]
            if isinstance(question, Lasting | Reaching):
                read = read_ranges(self.sections, items, question.unknown, what)
                self.ranges[key.label] = read
                continue
            found[key.label] = tuple(
                self.sections.expression(item, what, _ANSWER) for item in items
            )
        return found

    def _reduction(self, node: Node) -> ExpectReduction:
        return read_reduction(self.sections, node, self.spans)

    def _equilibria(self, node: Node) -> tuple[ExpectEquilibrium, ...]:
        return read_equilibria(self.sections, node, self.spans)

    def _steady_motions(self, node: Node) -> tuple[ExpectSteady, ...]:
        return read_steady_motions(self.sections, node, self.spans)

    def _hamilton_jacobi(self, node: Node) -> ExpectHamiltonJacobi:
        return read_hamilton_jacobi(self.sections, node, self.spans)

    def _brackets(self, node: Node) -> dict[str, Expression]:
        known = self._known(node, "brackets", self.brackets, "bracket")
        return read_expected_brackets(self.sections, known)

    def _canonical(self, node: Node) -> dict[str, ExpectCanonical]:
        names = [each.name for each in self.transformations]
        known = self._known(node, "canonical", names, "transformation")
        return read_expected_canonical(self.sections, known, self.transformations, self.spans)

    def _by_coordinate(self, node: Node, section: str, what: str) -> dict[str, Expression]:
        self._note(node, section)
        return read_by_coordinate(self.sections, node, section, what, _ANSWER)

    def _note(self, node: Node, *path: str) -> None:
        for key, _ in getattr(node, "entries", ()):
            self.spans[(*path, key.label)] = key.span

    def _known(
        self, node: Node, section: str, known: list[str], what: str
    ) -> list[tuple[Scalar, Node]]:
        """The entries whose keys exist in the problem; a mistake at each other one."""
        good = []
        for key, value in self.sections.entries(node, f"'{section}'"):
            self.spans[section, key.label] = key.span
            if key.label in known:
                good.append((key, value))
                continue
            names = ", ".join(known[:10])
            hint = did_you_mean(key.label, known) or (f"known are {names}" if known else "")
            self.sections.error(f"there is no {what} '{key.label}'", key.span, hint)
        return good
