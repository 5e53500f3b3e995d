"""The section `expect`: the known answers."""

from __future__ import annotations

from typing import Any

from lagcli.diagnostics import Span
from lagcli.expression import Expression
from lagcli.problem_data import Constraint, Contact, Expect, Inequality, Problem
from lagcli.reader.assignments import assigned, pieces
from lagcli.reader.columns import named_columns
from lagcli.reader.dynamics import read_by_coordinate
from lagcli.reader.file_reader import FileReader
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.scope import ANSWER, Role
from lagcli.reader.suggest import did_you_mean
from lagcli.reader.trajectory import TrajectoryReader
from lagcli.statements.registry import expected_keys, find_expected

#: The fields of `Expect` that are no answers of one section.
_FIELDS = frozenset(Expect.__annotations__) - {"others", "ranges", "spans"}
#: Letters of conserved quantities.
_LETTERS = {
    **dict.fromkeys("EHhW", "energy"),
    **dict.fromkeys(("L", "l", "L_z", "l_z", "Lz"), "rotation"),
}


def _known_as(name: str, known: list[str]) -> str:
    """`energy` for E, where it is known; other names as they are."""
    meant = _LETTERS.get(name, name)
    return meant if meant in known else name


class ExpectReader:
    """Reads the section key by key, and remembers where each expectation stands.

    What may stand under the key of a section of the answers, that section declares.
    """

    def __init__(self, file: FileReader, problem: Problem) -> None:
        self.file = file
        self.problem = problem
        self.constraints = [constraint.name for constraint in problem.constraints]
        holding: tuple[Constraint | Contact, ...] = (*problem.constraints, *problem.contacts)
        self.holding = [each.name for each in holding]
        self.columns = named_columns(file.scope, holding, problem.symmetries)
        self.symmetries = [symmetry.name for symmetry in problem.symmetries]
        self.brackets = [bracket.name for bracket in problem.brackets]
        self.transformations = {each.name: each for each in problem.canonical_transformations}
        self.points = [point.name for point in problem.points]
        self.questions = {question.name: question for question in problem.find}
        self.ranges: dict[str, tuple[tuple[Inequality, ...], ...]] = {}
        self.spans: dict[tuple[str, ...], Span] = {}

    def read(self, node: DocumentNode) -> Expect:
        """The whole section."""
        if isinstance(node, Mapping) and not node.entries:
            return Expect()  # no section need be known
        known = {"degrees_of_freedom", "trajectory", *expected_keys(False)}
        is_unusual = any(key.label not in known for key, _ in node.pairs)
        keys = ("degrees_of_freedom", *expected_keys(is_unusual), "trajectory")
        found = self.file.attributes(node, "expect", keys)
        values: dict[str, Any] = {}
        others: dict[str, Any] = {}
        for name, (key, value) in found.items():
            self.spans[(name,)] = key.span
            (values if name in _FIELDS else others)[name] = self._value(name, value)
        return Expect(**values, ranges=self.ranges, others=others, spans=self.spans)

    def _value(self, name: str, node: DocumentNode) -> Any:
        match name:
            case "degrees_of_freedom":
                return self.count(node, name)
            case "trajectory":
                reader = TrajectoryReader(self.file, self.holding, self.columns, self.spans)
                return reader.read(node)
            case _:
                return find_expected(name)[1].read(self, node)

    # -- what several sections have in common ----------------------------------------------

    def count(self, node: DocumentNode, name: str) -> int | None:
        """A whole number, 0 or more."""
        if isinstance(node, Mapping | Sequence):
            message = f"'{name}' is a whole number, 0 or more"
            self.file.error(message, node.span, f"write {len(node.parts) + len(node.pairs)}")
            return None
        text = self.file.scalar(node, f"'{name}'")
        if text is None:
            return None
        value = text.value.strip()
        if not (value.isascii() and value.isdigit() and len(value) < 10):
            hint = "write it in digits, as in 1"
            self.file.error(f"'{name}' is a whole number, 0 or more", text.span, hint)
            return None
        return int(value)

    def by_coordinate(
        self, node: DocumentNode, section: str, what: str, role: Role = ANSWER
    ) -> dict[str, Expression]:
        """A map from coordinates to formulas."""
        self.note(node, section)
        return read_by_coordinate(self.file, node, section, what, role)

    def note(self, node: DocumentNode, *path: str) -> None:
        """Remember where the entries of a map stand."""
        for key, _ in node.pairs:
            self.spans[(*path, key.label)] = key.span

    def known(
        self, node: DocumentNode, path: tuple[str, ...], known: list[str], what: str
    ) -> list[tuple[Scalar, DocumentNode]]:
        """The entries whose keys exist in the problem; a mistake at each other one."""
        good = []
        written = node.value.strip() if isinstance(node, Scalar) else "…"
        hint = f"write {known[0] if len(known) == 1 else 'name'}: {written}"
        if len(known) > 1:
            hint = f"write {{name: {written}}}; known are {', '.join(known[:10])}"
        items = node.listed
        told = items or pieces(written, ",;")
        named = [(_known_as(x, known), value) for each in told for x, value in assigned(each)]
        if len(named) == len(told):
            hint = f"write {{{', '.join(map(': '.join, named))}}}"
        elif items and len(items) <= len(known):
            pairs = ", ".join(f"{name}: {item}" for name, item in zip(known, items, strict=False))
            hint = f"write {{{pairs}}}"
        for key, value in self.file.entries(node, f"'{' of '.join(path)}'", hint):
            self.spans[(*path, key.label)] = key.span
            if key.label in known:
                good.append((key, value))
                continue
            meant = _known_as(key.label, known)
            hint = did_you_mean(key.label, known) or f"known are {', '.join(known[:10])}"
            hint = f"write {meant}" if meant in known else hint
            hint = hint if known else f"the problem has no {what}: it is declared first"
            self.file.error(f"there is no {what} '{key.label}'", key.span, hint)
        return good
