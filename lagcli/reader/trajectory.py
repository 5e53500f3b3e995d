"""`expect: trajectory`: the known motion, as formulas of t, numbers at times, and events."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.diagnostics import Span
from lagcli.expression import Expression
from lagcli.problem_data import Known, KnownRow, Trajectory
from lagcli.reader.assignments import assigned
from lagcli.reader.file_reader import FileReader
from lagcli.reader.misshapen import entries_of
from lagcli.reader.nodes import DocumentNode, Scalar, names_in
from lagcli.reader.nodes import Mapping as Map
from lagcli.reader.scope import ALONG, CONSTANTS, MOTION, Role
from lagcli.reader.suggest import did_you_mean
from lagcli.record import record

_KEYS = ("until", "tolerance", "rigorous", "at", "events")
_ENERGY = "energy"

#: What can happen to a contact or constraint, as the answer of a run calls it.
HAPPENINGS = (
    "contact lost", "contact closes", "impact", "comes to rest", "touches", "sticks", "slips",
)  # fmt: skip


@record
class TrajectoryReader:
    """Reads the section; events are about `contacts`, `named` columns are no expressions.

    The places of the expectations are added to `spans`.
    """

    file: FileReader
    contacts: list[str]
    named: Mapping[str, Expression]
    spans: dict[tuple[str, ...], Span]

    def read(self, node: DocumentNode) -> Trajectory:
        """The whole section; a column is an expression along the motion."""
        with self.file.scope.also([_ENERGY], "multiplier"):
            return self._read(node)

    def _read(self, node: DocumentNode) -> Trajectory:
        parts: dict[str, DocumentNode] = {}
        formulas = []
        given = assigned(getattr(node, "value", "")) or [("x", "cos(t)")]
        hint = f"write {', '.join(map(': '.join, given))}"
        for key, value in self.file.entries(node, "'trajectory'", hint):
            self.spans["trajectory", key.label] = key.span
            meant = [each for each in _KEYS if len(key.label) > 2 and each.startswith(key.label)]
            if key.label in _KEYS:
                parts[key.label] = value
            elif meant and key.label not in {*self.file.scope.kinds}:  # tol
                message = f"unknown key '{key.label}' in 'trajectory'"
                self.file.error(message, key.span, f"the key is {meant[0]}")
            else:
                formulas.append(self._known(key, value, MOTION))
        words = ("t", "name", "what")
        rigorous = "rigorous" in parts and self.file.yes_or_no(parts["rigorous"], "rigorous")
        events = self._rows(parts["events"], "events", words) if "events" in parts else ()
        return Trajectory(
            formulas=tuple(formulas),
            rows=tuple(self._rows(parts["at"], "at", ("t",))) if "at" in parts else (),
            events=tuple(events),
            until=self._number(parts, "until"),
            tolerance=self._number(parts, "tolerance"),
            rigorous=bool(rigorous),
        )

    def _number(self, parts: dict[str, DocumentNode], key: str) -> Expression | None:
        if key not in parts:
            return None
        return self.file.expression(parts[key], f"'{key}'", CONSTANTS)

    def _known(self, key: Scalar, value: DocumentNode, role: Role) -> Known:
        what = f"the expected '{key.label}'"
        column = self.named.get(key.label)
        if column is None:
            column = self.file.expression(key, "a column", ALONG)
        return Known(key.label, column, self.file.expression(value, what, role))

    def _rows(self, node: DocumentNode, section: str, words: tuple[str, ...]) -> list[KnownRow]:
        """Maps of columns, with words that say when."""
        rows = []
        given = node.entries if section == "at" and isinstance(node, Map) else []
        by_time = [f"{{t: {k.label}, {entries_of(v)}}}" for k, v in given if isinstance(v, Map)]
        if given and "t" not in {key.label for key, _ in given}:  # {x: 3}
            by_time = by_time or [f"{{t: …, {entries_of(node)}}}"]
        hint, keys = f"write [{', '.join(by_time)}]" * bool(by_time), None if by_time else words
        if section == "events" and not {*words} & {*names_in(node)}:
            hint = "a list of rows, as in [{t: 1, what: impact}]"
        for place, item in enumerate(self.file.items(node, f"'{section}'", hint, keys)):
            self.spans["trajectory", section, str(place)] = item.span
            found: dict[str, Scalar] = {}
            known: list[Known] = []
            time: Expression | None = None
            for key, value in self.file.entries(item, f"a row of '{section}'"):
                if key.label == "t":
                    time = self.file.expression(value, "the time", CONSTANTS)
                elif key.label in words:
                    text = self.file.scalar(value, f"'{key.label}'")
                    if text is not None:
                        found[key.label] = text
                else:
                    known.append(self._known(key, value, CONSTANTS))
            if section == "at" and time is None and isinstance(item, Map):
                hint = f"write {{t: …, {entries_of(item)}}}"
                self.file.error("a row of 'at' has no time", item.span, hint)
            rows.append(
                KnownRow(
                    t=time,
                    event=self._word(found.get("name"), self.contacts, "contact"),
                    what=self._word(found.get("what"), HAPPENINGS, "event"),
                    values=tuple(known),
                    span=item.span,
                )
            )
        return rows

    def _word(
        self, text: Scalar | None, known: list[str] | tuple[str, ...], what: str
    ) -> str | None:
        if text is None:
            return None
        word = " ".join(text.label.split())
        if word not in known:
            hint = did_you_mean(word, known) or f"known are {', '.join(known)}"
            self.file.error(f"there is no {what} '{word}'", text.span, hint)
        return word
