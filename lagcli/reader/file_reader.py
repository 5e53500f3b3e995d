"""What every section of the file needs: the text, the names, and a place for mistakes."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Collection, Container, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, NamedTuple, TypeVar

from lagcli.diagnostics import Diagnostic, Span
from lagcli.expression import ZERO, Equation, Expression, Name
from lagcli.problem_data import Inequality
from lagcli.reader.assignments import assigned
from lagcli.reader.by_coordinate import state_meant
from lagcli.reader.expressions import read_comparison, read_equation, read_expression, sides_of
from lagcli.reader.friction_meant import friction_meant
from lagcli.reader.growth import growth
from lagcli.reader.habits import KEYS, LISTS, MAPS, habits, key_meant
from lagcli.reader.headings import SECTIONS, section_meant
from lagcli.reader.limits import MISTAKES
from lagcli.reader.misshapen import (
    ALREADY_FOUND,
    WITHOUT_HYPHENS,
    as_flow,
    as_items,
    as_list,
    as_map,
    as_text,
    by_its_name,
    entries_of,
    is_found,
    name_in,
    named_formulas,
    one_sum,
    ranged,
    source_of,
    texts_of,
    with_state,
)
from lagcli.reader.names import name_mistakes
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, kind
from lagcli.reader.number_units import in_digits, unit_in_formula
from lagcli.reader.positions import Excerpt
from lagcli.reader.regex import regex
from lagcli.reader.scope import INITIAL, NUMBERS, VALUES, Kind, Role, Scope, name_mistake
from lagcli.reader.sign_meant import sign_meant
from lagcli.reader.suggest import closest, did_you_mean
from lagcli.reader.text import Mistake
from lagcli.reader.unknown_keys import unknown_key

_T = TypeVar("_T")
_Formula = TypeVar("_Formula", "Expression", "Equation", "Inequality")

#: What stands for an expression that could not be read; the file is refused anyway.
UNREADABLE = ZERO
#: Places where a number stands, without its unit.
_NUMERIC = (VALUES, INITIAL)
#: The words for it, and what they mean.
YES_OR_NO = {"yes": True, "no": False, "true": True, "false": False}
_WORDS = frozenset({"none", "null", *YES_OR_NO})
_FREQUENCIES = "write [sqrt(g/l)]"
_RELATION = regex("[=<>≤≥]")
#: The sections in which an entry of a map that has no colon is no equation.
_ASSIGNABLE = frozenset({"initial", "forces", "definitions", "simulation"})
#: Sections whose entries have names of the user's, which stand in no formula.
_OF_FREE_NAMES = frozenset("brackets contacts find points symmetries".split())
_NO_EQUATION = Equation(ZERO, ZERO)


class Required(NamedTuple):
    """A key that a map must have; where its absence is shown, and what to write."""

    key: str
    span: Span
    hint: str


@dataclass(slots=True, eq=False, repr=False)
class FileReader:
    """The mistakes found so far and the names declared so far."""

    scope: Scope = field(default_factory=Scope)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    #: the keys of the problem that the file has
    sections: frozenset[str] = frozenset()
    text: str = ""

    def error(
        self,
        message: str,
        span: Span,
        hint: str = "",
        related: tuple[tuple[Span, str], ...] = (),
        refused: str | None = None,
    ) -> None:
        """Note a mistake, and the name that is not declared for it; after very many, forget it."""
        if not self.is_full:
            self.diagnostics.append(Diagnostic(message, span, hint, related=related))
        if refused is not None:
            self.scope.refused.append(refused)

    @property
    def is_full(self) -> bool:
        """Whether there are more mistakes than anybody will read."""
        return len(self.diagnostics) >= MISTAKES

    def _check_names(
        self, expression: Expression, role: Role, what: str, before: int | None = None
    ) -> None:
        mistakes = name_mistakes(expression, self.scope, role, what, before)
        self.diagnostics += islice(mistakes, max(0, MISTAKES - len(self.diagnostics)))
        _, wrong = growth(expression, self.scope)
        self.diagnostics += [] if wrong is None else [wrong]

    # Shapes.

    def of_section(
        self,
        entries: Iterable[tuple[Scalar, DocumentNode]],
        section: str,
        attributes: tuple[str, ...],
    ) -> list[tuple[Scalar, DocumentNode]]:
        """The entries up to the first of another section, whose line is missing: a mistake."""
        kept: list[tuple[Scalar, DocumentNode]] = []
        for key, value in entries:
            other = section_meant(value, attributes, self.scope.coordinates)
            if kept and other and other not in {section, *self.sections} and not key.in_flow:
                message = f"'{key.label}' does not belong to {section}"
                self.error(message, key.span, f"a line '{other}:' is missing above it", refused="")
                break
            kept.append((key, value))
        return kept

    def entries(
        self, node: DocumentNode, what: str, hint: str = ""
    ) -> Iterator[tuple[Scalar, DocumentNode]]:
        """The entries of a map; a mistake when it is none."""
        if isinstance(node, Mapping):
            is_contact = re.search("[<>≤≥]", "".join(texts_of(node))) is not None
            of_relations = "contacts" if is_contact else "constraints"
            if texts_of(node) and what in {of_relations, "symmetries"}:
                self.error(f"each of {what} has a name", node.span, hint, refused="")
                return
            yield from self._with_decimals(node, what)
        else:
            word = node.value.casefold() if isinstance(node, Scalar) else ""
            is_word = word in _WORDS or word in habits()["nothing"]
            items = node.parts
            are_maps = bool(items) and all(isinstance(x, Mapping) for x in items)
            is_word |= (node.is_empty and what in KEYS) or (
                isinstance(node, Sequence) and not items
            )
            if is_word and not what.startswith("the symmetry"):
                hint = "leave out the key"
            if named := by_its_name(node):
                hint = f"write {{{named}}}"
            elif are_maps and ("…" in hint or not hint.startswith("write {")):
                inner = ", ".join(map(entries_of, items))
                is_flow = node.text.source.text[node.start] == "["
                hint = f"write {{{inner}}}" if is_flow else WITHOUT_HYPHENS
            labels = {key.label for key, _ in items[0].pairs} if items else set()
            if labels and labels <= SECTIONS.keys():
                hint = f"each has a name: write name: {{{entries_of(items[0])}}}, without '-'"
            given = named_formulas(node) if what in _OF_FREE_NAMES else {}
            if given and hint.startswith("write ") and not given.keys() & self.scope.kinds.keys():
                hint = f"write {as_flow(given)}"
            # behind its key a map has braces: forces: {x: -c*x'}
            hint = re.sub(r"^write ([^{}]+: [^{}]+)$", r"write {\1}", hint)
            self.error(f"{what} must be a map, not {kind(node)}", node.span, hint)
            if what in MAPS:
                self.scope.refused.append("")  # whatever was to be declared

    def _with_decimals(self, node: Mapping, what: str) -> Iterator[tuple[Scalar, DocumentNode]]:
        """The entries of a map; a mistake at `{g: 9,81}`, and at the quotes of `{'x: 1, x': 0}`.

        Another one is a map without colons, `{x = 1, x' = 0}`.
        """
        labels = [key.label if value.is_empty else "" for key, value in node.entries]
        parts = [part for label in labels for part in label.split(";")]  # {x = 1; x' = 0}
        given = [f"{name}: {value}" for part in parts for name, value in assigned(part)]
        if what in _ASSIGNABLE and given and len(given) == len(parts):
            first = node.entries[0][0]
            message = f"': ' is missing behind '{given[0].partition(':')[0]}'"
            whole = f"{{{', '.join(given)}}}" if given[1:] else given[0]
            self.error(message, first.span, f"write {whole}")
            return
        before = ""
        text = node.text.source.text
        written = text[node.start : node.end]
        if written[:1] == "{" and re.search(r"\d,\d+\s*;", written):
            whole = re.sub(r"(\d),(?=\d)", r"\1.", written).replace(";", ",")
            hint = f"a decimal point is written '.': write {whole}"
            self.error("a comma ends a value", node.span, hint, refused="")
            return
        for key, value in node.entries:
            is_digits = re.fullmatch(r"\d+(?:\s*[^\W\d].*)?", key.label)  # 5 kg of {m: 0,5 kg}
            is_part = key.in_flow and is_digits and value.is_empty
            if is_part and before[-1:].isdigit() and before.partition(":")[0] not in LISTS:
                hint = f"a decimal point is written '.': write {before}.{key.label}"
                self.error("a comma ends a value", key.span, hint)
            elif key.style and re.search(r"\w'*: ", key.label):
                whole = text[node.start : key.start] + text[key.start + 1 : node.end]
                self.error("a quote begins within the map", key.span, f"write {whole}")
            else:
                yield key, value
            before = f"{key.label}: {source_of(value)}"

    def named(
        self, node: DocumentNode, what: str, attributes: tuple[str, ...], hint: str
    ) -> Iterator[tuple[Scalar, DocumentNode]]:
        """The entries of a map by name; a mistake where the attributes of one stand beside it.

        The first attribute may be a name: equation: x = y.
        """
        entries = list(self.entries(node, what, hint))
        beside = [
            key for key, value in entries
            if key.label in attributes[1:] and isinstance(value, Scalar) and value.value
            and (key.label == "holds_while" or not _RELATION.search(value.value))
        ]  # fmt: skip
        if not beside:
            yield from entries
            return
        own = [key for key, _ in entries if key.label not in attributes]
        inner = [(attributes[0] if key in own else key.label, value) for key, value in entries]
        given = ", ".join(
            f"{key}: {as_items(value) if key in LISTS else source_of(value)}"
            for key, value in inner
        )
        message = f"'{beside[0].label}' stands inside the braces of one entry of {what}"
        whole = f"write {own[0].label if own else 'name'}: {{{given}}}"
        several = len(own) > 1 or any(isinstance(value, Mapping) for _, value in entries)
        self.error(message, beside[0].span, "" if several else whole)
        if attributes[0] not in LISTS:  # else no text can be an entry
            yield from ((k, v) for k, v in entries if k in own and isinstance(v, Scalar))

    def items(
        self, node: DocumentNode, what: str, hint: str = "", keys: Container[str] | None = None
    ) -> list[DocumentNode]:
        """The items of a list, maps where `keys` are theirs; a mistake when it is none."""
        if isinstance(node, Sequence):
            return node.items
        if isinstance(node, Scalar):
            if node.broken:
                return []
            if hint == _FREQUENCIES and (given := re.fullmatch(r"([^=]+)=([^=]+)", node.value)):
                value = given[2].strip()
                squared = re.search(r"(?:\^|\*\*)\s*2\s*$|²\s*$", given[1])
                hint = f"write [sqrt({value})]" if squared else f"write [{value}]"
            elif node.value.strip() and (not hint or hint.startswith("write [")):
                hint = f"write {as_list(node.value)}"
        elif isinstance(node, Mapping) and keys is not None:
            maps = [v for k, v in node.entries if isinstance(v, Mapping) and k.label not in keys]
            whole = maps if len(maps) == len(node.entries) else [node]
            alone = {k.label for k, v in node.entries if isinstance(v, Scalar)}
            others = {k.label for k, _ in node.entries} - (alone & {*self.scope.coordinates})
            if not hint or maps == whole or all(k in keys for k in others):
                hint = f"write [{', '.join(map(source_of, whole))}]"
        elif isinstance(node, Mapping) and hint in {"", "write [one, another]", _FREQUENCIES}:
            rates = [state_meant(key.label, self.scope.coordinates) for key, _ in node.entries]
            left = (f"{each} = " * each.endswith("''") for each in rates)
            inner = (source_of(k if v.is_empty else v) for k, v in node.entries)
            listed_ = (side + each for side, each in zip(left, inner, strict=True))
            hint = f"write [{', '.join(listed_)}]"
        self.error(f"{what} must be a list, not {kind(node)}", node.span, hint)
        return []

    def scalar(self, node: DocumentNode, what: str) -> Scalar | None:
        """A text that is not empty."""
        if not isinstance(node, Scalar):
            texts = node.listed
            is_prose = what in {"'title'", "'description'", "'source'"} and texts
            hint = f"write {', '.join(texts)}" if is_prose else as_text(node)
            self.error(f"{what} must be a text, not {kind(node)}", node.span, hint)
            return None
        if node.broken:
            return None
        if not node.value.strip():
            is_constraint = what.startswith("the constraint")
            hint = "write left = right" if is_constraint else "write it, or leave out its key"
            self.error(f"{what} is empty", node.span, hint)
            return None
        return node

    def word(
        self, node: DocumentNode, what: str, known: Collection[str], meant: str = ""
    ) -> str | None:
        """One of some words; a mistake when it is another, which may be what is `meant`."""
        text = self.scalar(node, what)
        word = "" if text is None else " ".join(text.value.split())
        if text is None or word in known:
            return word or None
        *others, last = known
        hint = did_you_mean(word, known) or f"write {', '.join(others)} or {last}"
        hint = f"write {meant}" if meant else hint
        self.error(f"{what} has no value '{word}'", text.span, hint)
        return None

    def yes_or_no(self, node: DocumentNode, name: str) -> bool | None:
        """Yes or no; None where it is neither."""
        return YES_OR_NO.get(self.word(node, f"'{name}'", YES_OR_NO) or "")

    def attributes(
        self, node: DocumentNode, what: str, known: Iterable[str], required: Required | None = None
    ) -> dict[str, tuple[Scalar, DocumentNode]]:
        """The entries of a map with known keys; a mistake at each other one.

        Where the required key is lacking, that is the mistake, and the only one.
        """
        found = {}
        names = tuple(known)
        is_map = isinstance(node, Mapping)
        as_one = "" if is_map else as_map(node, names, self.scope.free)
        if what.startswith("the question"):
            name, moving = what.split("'")[1], self.scope.coordinates
            if is_found(name, moving) or is_found(f"{name} = {source_of(node)}", moving):
                as_one = ALREADY_FOUND
        entries = list(self.entries(node, what, with_state(as_one, what, node, is_key=False)))
        given = {key.label for key, _ in entries}
        if required is not None and isinstance(node, Mapping):
            near = {key_meant(label, names) or closest(label, names) for label in given}
            if required.key in LISTS and required.key not in given | near:
                for key, value in entries:
                    wrong = unknown_key(key, value, what, names, node, self.scope)
                    is_free = key.label not in names and wrong.hint.startswith("known are ")
                    if isinstance(value, Sequence) and is_free:  # xyz: [x, y]
                        self.error(wrong.message, key.span, f"the key is {required.key}")
                        key.value = required.key
                        given.add(required.key)
                        break
            if required.key not in given | near:
                self.error(f"{what} has no {required.key}", required.span, required.hint)
                return {}
        for key, value in self._without_split_lists(entries, names):
            if key.label in names:
                found[key.label] = (key, value)
            else:
                assert isinstance(node, Mapping)
                wrong = unknown_key(key, value, what, names, node, self.scope)
                self.error(wrong.message, key.span, with_state(wrong.hint, what, value))
                if wrong.meant and wrong.meant not in given:
                    found[wrong.meant] = (key, value)  # what is in it is read on
        return found

    def _without_split_lists(
        self, entries: list[tuple[Scalar, DocumentNode]], names: tuple[str, ...]
    ) -> list[tuple[Scalar, DocumentNode]]:
        """The entries; a mistake at `position: x, y` and `assume: real, positive` in braces.

        The comma ends the value there.
        """
        kept: list[tuple[Scalar, DocumentNode]] = []
        split: dict[str, list[str]] = {}
        for key, value in entries:
            empty = isinstance(value, Scalar) and value.is_empty and key.in_flow
            last = kept[-1][0].label if kept and isinstance(kept[-1][1], Scalar) else ""
            if empty and key.label not in names and last in {*LISTS, "assume"}:
                split.setdefault(last, []).append(key.label)
            else:
                kept.append((key, value))
        for name, rest in split.items():
            [value] = [v for k, v in kept if k.label == name]
            listed = ", ".join([source_of(value), *rest])
            meant = f"[{listed}]" if name in LISTS else sign_meant(listed)
            hint = f"write {name}: {meant}" if meant else ""
            wrong = "must be a list" if name in LISTS else "is one word"
            self.error(f"'{name}' {wrong}", value.span, hint)
            kept = [(k, v) for k, v in kept if k.label != name]
        return kept

    # Formulas.

    def expression(
        self, node: DocumentNode, what: str, role: Role, before: int | None = None
    ) -> Expression:
        """A formula whose names are all known and allowed in its role."""
        alone = node.value.strip() if isinstance(node, Scalar) else ""
        is_open = role in {*_NUMERIC, NUMBERS} and alone not in self.scope.kinds
        names = {*self.scope.kinds} - {what.split("'")[1] if what.startswith("the value") else ""}
        number = in_digits(alone, names) if is_open else alone
        units = "unit" in self.text
        wrong = unit_in_formula(number, what, self.scope.kinds, role in _NUMERIC, units)
        is_varied = is_open and what.startswith(("the value of", "the initial"))
        if is_varied and (several := ranged(name_in(what), node)):
            wrong = f"{what} is one number", several
        if number != alone and not wrong:
            wrong = "a value is one number in digits", f"write {number}"
        if wrong:
            self.error(wrong[0], node.span, wrong[1])
            return UNREADABLE
        return self._formula(node, what, role, read_expression, before) or UNREADABLE

    def _say_in_all(
        self, node: DocumentNode, what: str, role: Role, read: Callable[[Excerpt], Any], before: int
    ) -> None:
        """The whole formula in the first hint of a list of mistakes, where it was understood."""
        found = self.diagnostics[before:]
        if found and not self.is_full and isinstance(node, Scalar):
            from lagcli.reader.repair import unmoved, with_whole

            whole = with_whole(found, node, what, self.scope, role, read)
            whole = unmoved(found, node, what, self.scope, r"\w+") if whole == found else whole
            self.diagnostics[before:] = whole

    def equation(self, node: DocumentNode, what: str, role: Role) -> Equation:
        """`left = right`, or an expression that is 0."""
        return self._formula(node, what, role, read_equation) or _NO_EQUATION

    def comparison(self, node: DocumentNode, what: str, role: Role) -> Inequality | None:
        """One inequality, or None."""
        return self._formula(node, what, role, read_comparison)

    def _formula(
        self,
        node: DocumentNode,
        what: str,
        role: Role,
        read: Callable[[Excerpt], _Formula],
        before: int | None = None,
    ) -> _Formula | None:
        """A formula or relation that could be read; its names are checked."""
        mistakes = len(self.diagnostics)
        found = self._read(node, what, read)
        for side in () if found is None else sides_of(found):
            self._check_names(side, role, what, before)
        self._say_in_all(node, what, role, read, mistakes)
        return found

    def name(self, node: DocumentNode, what: str, role: Role) -> Name | None:
        """A single name with its primes, such as `x'`."""
        mistakes = len(self.diagnostics)
        expression = self._read(node, what, read_expression)
        if isinstance(expression, Name):
            self._check_names(expression, role, what)
        elif expression is not None:
            self.error(f"{what} must be a name", node.span)
        self._say_in_all(node, what, role, read_expression, mistakes)
        right = len(self.diagnostics) == mistakes
        return expression if right and isinstance(expression, Name) else None

    def _read(self, node: DocumentNode, what: str, read: Callable[[Excerpt], _T]) -> _T | None:
        if not isinstance(node, Scalar):
            hint = one_sum(node, what)
            if what == "dissipation":
                hint = friction_meant(what, node, self.scope.coordinates)
                hint = hint.replace("dissipation: ", "")
                hint = hint.replace("write f", "these are forces: write f")
                hint = hint or "one function for all coordinates, such as c*x'^2/2"
            self.error(f"{what} must be an expression, not {kind(node)}", node.span, hint)
            return None
        if self.is_full or self.scalar(node, what) is None:
            return None
        foreign = any(
            each in node.value for each in self.scope.refused if each and name_mistake(each)
        )
        try:
            return read(node.excerpt())
        except Mistake as error:
            if not foreign:  # a name that was refused where it was declared
                self.diagnostics += error.diagnostics
            return None

    # Names.

    def declare(self, name: str, kind: Kind, span: Span, *, one: bool = False) -> bool:
        """Enter a name into the scope; a mistake when it is none, or taken."""
        wrong = name_mistake(name, one=one)
        if wrong is not None:
            self.error(wrong[0], span, wrong[1], refused=name)
            return False
        if name in self.scope.kinds:
            taken = self.scope.kinds[name]
            related = ((self.scope.spans[name], f"first declared here, as a {taken}"),)
            hint = "leave out one of them" if taken == kind else "give one of them another name"
            message = f"'{name}' is declared twice"
            if taken == "coordinate" and kind == "parameter":
                hint = f"leave it out of the coordinates: {name}' occurs nowhere"
                other = "leave it out here, or give one of them another name"
                hint = other if self._has_rate(name) else hint
            if kind in ("multiplier", "contact force"):
                message = f"'{name}', its {kind}, is declared twice"
                hint += ", this one by the key multiplier"
            self.error(message, span, hint, related)
            return False
        self.scope.kinds[name] = kind
        self.scope.spans[name] = span
        return True

    def _has_rate(self, coordinate: str) -> bool:
        """Whether the file may contain the velocity or the momentum of a coordinate."""
        x = re.escape(unicodedata.normalize("NFD", coordinate))
        form = (
            rf"(?<!\w)(?:[pvd]_?|d?dot_?|\\d?dot\W*|(?:Derivative|diff|D)\(){x}(?!\w)"
            rf"|(?<!\w){x}(?:['’′`\u0307\u0308]|\(t|_?(?:dd?|d?dot)(?!\w))"
        )
        implied = self.sections & {"points", "definitions", "H"}
        return bool(implied or re.search(form, unicodedata.normalize("NFD", self.text)))
