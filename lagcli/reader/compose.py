"""Text to nodes, from the events of the YAML parser.

Events need no recursion and construct nothing: a tag is an error, an alias is a
reference to the node it names, and what the aliases expand to is counted.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, NoReturn

import yaml

from lagcli.diagnostics import Diagnostic, Span
from lagcli.reader.expressions import signed_terms
from lagcli.reader.flow import mend_commas
from lagcli.reader.headings import SECTIONS, is_said
from lagcli.reader.limits import EXPANDED_SIZE, YAML_LEVELS
from lagcli.reader.misshapen import by_key, source_of, with_entries
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, lines_of, names_in
from lagcli.reader.regex import regex
from lagcli.reader.text import Mistake, SourceText, as_sum

#: Keys that stand beside the equation of a constraint.
_BESIDE_EQUATION = ("multiplier", "holds_while", "on_loss", "acts_as", "lambda")
#: An entry of a map in braces that YAML reads as a key: `t; 1`, `mass= m`, `t :1`, `x 1`, `y x`.
_WITHOUT_COLON = regex(
    r"(?P<key>[^\W\d]\w*'*)(?:\s*[;=](?!>)\s*|\s*:(?=\S)|\s+(?=[.\d])|\s+(?=[-\w.+*/^'()]+$))"
    r"(?P<value>[^:;]+)"
)
_ATTRIBUTE = regex(r"(?P<key>\w+)\s+(?:=\s*)?(?P<value>[^=:;\s][^:;]*)")
_PROSE = frozenset({"title", "source", "description", "symbol"})
#: Braces that belong to a text, as in `\sqrt{k}`; YAML would end a text in a list there.
_INNER = regex(r"(?<=[\w^\ue001])\{[^{},:#\n\[\]]*\}")
_HIDDEN = str.maketrans("{}", "\ue000\ue001")
_SHOWN = str.maketrans("\ue000\ue001", "{}")
_TAKEN = regex("[\ue000\ue001]")
_WITH_BRACES = "inside { } and [ ] a text with braces stands in quotes"
#: Of one such group in another, or behind another.
_DEEPEST = 8
#: Blanks that cannot indent.
BLANKS = "\t\u00a0\u2000-\u200b\u202f\u205f\u3000"
_INDENTED = regex(rf"^ *([{BLANKS}])\s*(?:- |[^\W\d][\w']*:(?:\s|$))", re.MULTILINE)
_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def compose(text: SourceText) -> tuple[DocumentNode, list[Diagnostic]]:
    """The one document of a file, and mistakes after which the rest of it can still be read.

    These are duplicate keys, tags, commas that cut a formula in two.  `Mistake` when there is no
    document, more than one, or none that YAML can read.
    """
    if not text.source.text.isascii() and (found := _INDENTED.search(text.source.text)):
        message = f"the blank U+{ord(found[1]):04X} cannot indent"
        raise Mistake(Diagnostic(message, text.span(*found.span(1)), "indent with spaces"))
    composer = _Composer(text)
    try:
        for event in yaml.parse(composer.hidden, Loader=_LOADER):
            composer.take(event)
    except yaml.YAMLError as error:
        from lagcli.reader.yaml_errors import explain

        raise Mistake(explain(error, text)) from None
    if composer.root is None:
        hint = "a problem has 'coordinates' at least"
        raise Mistake(Diagnostic("the file is empty", text.span(0, 0), hint))
    return composer.root, composer.diagnostics


def without_wrong_texts(mistakes: list[Diagnostic]) -> list[Diagnostic]:
    """The mistakes, but for a text that lacks quotes and would be wrong in quotes too."""
    spans = [each.span for each in mistakes if each.message != _WITH_BRACES]
    return [one for one in mistakes if one.message != _WITH_BRACES or not any(
        one.span.line == other.line and one.span.column <= other.column < one.span.end_column
        for other in spans)]  # fmt: skip


def _one_of(first_key: Scalar, first: DocumentNode, key: Scalar, second: DocumentNode) -> str:
    """What to do where a key is given twice: entries go into one map, two formulas into a sum."""
    hint, above = "leave out one of them", lines_of(first_key, first)
    parts = [_parts(each) for each in (first, second)]
    for one, other, lines in ((1, 0, lines_of(key, second)), (0, 1, above)):
        if parts[one] and parts[one] <= parts[other]:
            what = "terms" if isinstance(first, Scalar) else "entries"
            return f"leave out {lines}: the other has all of its {what}"
    values = [each.value for each in (first, second) if isinstance(each, Scalar)]
    names = [{name for name, _ in each} for each in parts]
    if not values and all(names) and not names[0] & names[1]:
        whole = with_entries(source_of(first), source_of(second)[1:-1])
        there = f"leave it out, and in {above} write all as {key.label}: {whole}"
        return there if whole else f"leave it out, and write its entries below {above}"
    if len(values) == 2 and all("=" in each for each in values):
        return f"{hint}, or give it another name"
    is_sum = len(values) == 2 and all(re.search(r"[*'^(]", each) for each in values)
    if is_sum and not parts[0] & parts[1]:
        total = as_sum(values)
        return f"{hint}; for the sum leave out the first one and write {key.label}: {total}"
    return hint


def _parts(node: DocumentNode) -> set[tuple[object, str]]:
    """The entries of a map, the names of a list, and the terms of a formula with their signs."""
    if not isinstance(node, Scalar):
        return {*(by_key(node) or dict.fromkeys(names_in(node), "")).items()}
    return {*signed_terms(node.value)}


@dataclass(slots=True, eq=False, repr=False)
class _Open:
    """A list or map whose end has not come yet."""

    start: int
    anchor: str | None
    is_map: bool
    is_flow: bool
    children: list[DocumentNode] = field(default_factory=list)


class _Composer:
    """Builds the tree as the events come."""

    def __init__(self, text: SourceText) -> None:
        self.text = text
        self.hidden = text.source.text  # with other characters for such braces
        is_latex = re.search(r"\\[A-Za-z]", self.hidden) and not _TAKEN.search(self.hidden)
        for _ in range(_DEEPEST if is_latex else 0):
            self.hidden = _INNER.sub(lambda found: found[0].translate(_HIDDEN), self.hidden)
        self._shown = _SHOWN if is_latex else {}
        self.root: DocumentNode | None = None
        self.diagnostics: list[Diagnostic] = []
        self._stack: list[_Open] = []
        self._anchors: dict[str, DocumentNode | None] = {}  # None while its node is still open
        self._documents = 0

    def take(self, event: Any) -> None:
        """Use the next event."""
        start, end = event.start_mark.index, event.end_mark.index
        match event:
            case yaml.DocumentStartEvent():
                self._documents += 1
                if self._documents > 1:
                    parts = (self.text.source.text[:start], self.text.source.text[start:])
                    one, other = ({*re.findall(r"^\w+(?=:)", each, re.MULTILINE)} for each in parts)
                    hint = "put it into a file of its own" if one & other else "leave out '---'"
                    hint += ": one problem, one file"
                    self._stop(start, end, "a second document begins here", hint)
            case yaml.ScalarEvent():
                broken, value = self._has_tag(event), event.value.translate(self._shown)
                if self._in_flow and not event.style and value != event.value:
                    quoted = value.replace("\\", r"\\").replace('"', r"\"")
                    self._report(start, end, _WITH_BRACES, f'write "{quoted}"')
                node = Scalar(
                    self.text, start, end, value, event.style or "", self._in_flow,
                    size=1 + len(value), anchored=event.anchor is not None, broken=broken,
                )  # fmt: skip
                self._add(node, event.anchor)
            case yaml.AliasEvent():
                self._add(self._alias(event.anchor, start, end), None)
            case yaml.CollectionStartEvent():
                self._has_tag(event)
                self._open(event, start, end)
            case yaml.CollectionEndEvent():
                self._close(end)

    @property
    def _in_flow(self) -> bool:
        return bool(self._stack) and self._stack[-1].is_flow

    @property
    def _above(self) -> str:
        """The key whose value comes next."""
        above = self._stack[-1].children[-1:] if self._stack else []
        return "".join(getattr(each, "value", "") for each in above)

    def _open(self, event: Any, start: int, end: int) -> None:
        if len(self._stack) >= YAML_LEVELS:
            self._stop(start, end, f"lists and maps more than {YAML_LEVELS} levels deep")
        if event.anchor is not None:
            self._anchors[event.anchor] = None
        is_map = isinstance(event, yaml.MappingStartEvent)
        self._stack.append(_Open(start, event.anchor, is_map, bool(event.flow_style)))

    def _close(self, end: int) -> None:
        done = self._stack.pop()
        node: DocumentNode
        size = 1 + sum(child.size for child in done.children)
        if size > EXPANDED_SIZE:
            message = f"the aliases expand to more than {EXPANDED_SIZE >> 20} MiB"
            self._stop(done.start, done.start + 1, message)
        anchored = done.anchor is not None
        if done.is_map:
            entries = self._entries(self._with_colons(done.children))
            node = Mapping(self.text, done.start, end, entries, size=size, anchored=anchored)
        else:
            items = done.children
            node = Sequence(self.text, done.start, end, items, size=size, anchored=anchored)
        if done.is_flow:
            self.diagnostics += mend_commas(node)
        self._add(node, done.anchor)

    def _split(self, children: list[DocumentNode], place: int) -> re.Match[str] | None:
        """The key and the value in a key of a map in braces that has none; None for others."""
        key, value = children[place], children[place + 1]
        if not (isinstance(key, Scalar) and key.in_flow and not key.style and value.is_empty):
            return None
        found = _ATTRIBUTE.fullmatch(key.value)
        if found is not None and is_said(*found.groups()):
            return found
        found = _WITHOUT_COLON.fullmatch(key.value)
        if found is None or not re.match(r"\s+[^\d.;:=\s]", key.value[found.end("key") :]):
            return found
        others = [*children[:place], *children[place + 2 :]]
        written = [self.text.source.text[one.start : one.end] for one in others]
        words = re.findall(r"\w+", " ".join(written))
        return found if {*words} & {*re.findall(r"\w+", key.value)} else None  # not: at rest

    def _with_colons(self, children: list[DocumentNode]) -> list[DocumentNode]:
        """Keys and values, with `t; 1` and `mass:m` as what they are meant to be; a mistake."""
        keys, values = children[::2], children[1::2]
        found = [self._split(children, place) for place in range(0, len(children), 2)]
        is_text = any(isinstance(key, Scalar) and key.value in _PROSE for key in keys)
        others = any(not value.is_empty for value in values)
        if is_text:  # of which a comma cuts off words
            found = [each if each and is_said(*each.groups()) else None for each in found]
        if not any(found) or not (others or (len(keys) == 1 and self._above != "constraints")):
            return children  # all alike: reported where names are declared
        mended: list[DocumentNode] = []
        for key, value, split in zip(keys, values, found, strict=True):
            if split is None or not isinstance(key, Scalar):
                mended += [key, value]
                continue
            equations = [each for each in values if isinstance(each, Scalar) and "=" in each.value]
            if equations and "=" in key.value and split["key"] not in SECTIONS:
                beside = {*_BESIDE_EQUATION} & {getattr(each, "label", "") for each in keys}
                name = "equation" if beside else "name"
                message = f"the equation '{key.value}' has no {'key' if beside else 'name'}"
                self._report(key.start, key.end, message, f"write {name}: {key.value}")
                value = Scalar(self.text, key.start, key.end, key.value, "", True)
                mended += [Scalar(self.text, key.start, key.start, name, "", True), value]
                continue
            hint = f"write {split['key']}: {split['value']}"
            self._report(key.start, key.end, f"': ' is missing behind '{split['key']}'", hint)
            at = key.start + split.start("value")
            value = Scalar(self.text, at, key.end, split["value"], "", True, broken=True)
            mended += [Scalar(self.text, key.start, at, split["key"], "", True), value]
        return mended

    def _entries(self, children: list[DocumentNode]) -> list[tuple[Scalar, DocumentNode]]:
        entries: dict[str, tuple[Scalar, DocumentNode]] = {}
        twice = 0
        for key, value in zip(children[::2], children[1::2], strict=True):
            if not isinstance(key, Scalar):
                hint = "a map has one pair of braces, a placeholder is no value: write key: value"
                self._report(key.start, key.end, "a key must be a text", hint)
            elif key.label == "<<":
                message = "the merge key '<<' is not part of the format"
                self._report(key.start, key.end, message, "write what it stands for")
            elif key.label in entries:
                if key.in_flow and key.label.isdigit() and value.is_empty:
                    continue  # the second 5 of {m: 1,5, k: 2,5}
                twice += 1
                if twice > 1:  # a second group of the same keys
                    continue
                first, first_value = entries[key.label]
                related = ((first.span, "first given here"),)
                message = f"the key '{key.label}' is given twice"
                hint = _one_of(*entries[key.label], key, value)
                labels = [getattr(each, "label", "") for each in children[::2]]
                is_open = self._above == "initial" and hint.endswith("them")
                if is_open and key.label[-1:] != "'" and f"{key.label}'" not in labels:
                    hint = f"the key is {key.label}'"
                self._report(key.start, key.end, message, hint, related)
                if isinstance(first_value, Sequence):
                    first_value.items.extend([*value.parts, *(each for each, _ in value.pairs)])
                elif isinstance(first_value, Mapping):
                    given = {*names_in(first_value)}
                    first_value.entries.extend(x for x in value.pairs if x[0].label not in given)
            else:
                entries[key.label] = (key, value)
        return list(entries.values())

    def _add(self, node: DocumentNode, anchor: str | None) -> None:
        if anchor is not None:
            self._anchors[anchor] = node
        if self._stack:
            self._stack[-1].children.append(node)
        else:
            self.root = node

    def _alias(self, anchor: str | None, start: int, end: int) -> DocumentNode:
        if anchor is None or anchor not in self._anchors:
            self._stop(start, end, f"no anchor '&{anchor}' stands before this alias")
        node = self._anchors[anchor]
        if node is None:
            self._stop(start, end, f"the alias '*{anchor}' stands inside of what it names")
        return node

    def _has_tag(self, event: Any) -> bool:
        """Whether a node has a tag; that is noted as a mistake."""
        if event.tag is None or event.tag in {"!", "tag:yaml.org,2002:str"}:
            return False
        start, end = event.start_mark.index, event.end_mark.index
        written = self.text.source.text[start:end].split(maxsplit=1)
        width = len(written[0]) if written else 1
        self._report(start, start + width, "tags are not part of the format", hint="leave it out")
        return True

    def _report(
        self,
        start: int,
        end: int,
        message: str,
        hint: str = "",
        related: tuple[tuple[Span, str], ...] = (),
    ) -> None:
        span = self.text.span(start, end)
        self.diagnostics.append(Diagnostic(message, span, hint, related=related))

    def _stop(self, start: int, end: int, message: str, hint: str = "") -> NoReturn:
        raise Mistake(Diagnostic(message, self.text.span(start, end), hint))
