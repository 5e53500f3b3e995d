"""Keys of the problem that are indented into the section or the heading above them."""

from __future__ import annotations

import re
from collections.abc import Callable

from lagcli.diagnostics import Diagnostic
from lagcli.expression import FUNCTIONS
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.friction_meant import friction_meant
from lagcli.reader.habits import (
    KEYS,
    MAPS,
    is_constant,
    key_meant,
    letters,
    meanings,
    spellings,
    unit_behind,
)
from lagcli.reader.headings import SAID
from lagcli.reader.misshapen import source_of
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, names_in
from lagcli.reader.regex import regex
from lagcli.reader.text import also_in_lines
from lagcli.record import replace

#: `U(r)`.
CALLED = regex(r"(\w+)\(\s*([^\W\d][\w, ]*?)\s*\)")
_ENERGIES = frozenset("TVLH")
_RELATION = regex("[=<>]")
#: What the entries of a section have that are not recognized by its emptiness.
_ATTRIBUTES = {
    "coordinates": {*SAID},
    "parameters": {*SAID, "value", "integer"},
    "points": {"position", "mass", "force"},
    "constraints": {"equation", "multiplier", "holds_while", "on_loss", "restitution", "acts_as"},
    "contacts": {"gap", "restitution", "multiplier"},
}
Entry = tuple[Scalar, DocumentNode]
#: Sections whose entries are called by names of the user's, never by these keys.
_SECTIONS = frozenset(
    "coordinates parameters points constraints contacts forces symmetries initial find".split()
)


def lifted(root: Mapping) -> tuple[Mapping, list[Diagnostic]]:
    """The problem with such entries as keys of its own, and a mistake at each of them.

    An energy has a formula of coordinates: `T: 2` is a parameter, `H: x = y` a constraint, and
    the T of a coordinate T its own.  What is a key already is none.
    """
    root, mistakes = _with_sections(root)
    given = {key.label for key, _ in root.entries}
    coordinates = [name for key, node in root.entries if key.label == "coordinates"
                   for name in names_in(node)]  # fmt: skip
    mentions = re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, coordinates)) or '(?!)'})(?!\w)")

    def is_misplaced(key: Scalar, value: DocumentNode) -> bool:
        if key.in_flow or key.label in given:
            return False
        if key.label in _ENERGIES:
            formula = "" if key.label in coordinates else getattr(value, "value", "")
            return mentions.search(formula) is not None and not _RELATION.search(formula)
        return key.label in MAPS and isinstance(value, Mapping | Sequence)

    entries: list[tuple[Scalar, DocumentNode]] = []
    for key, node in root.entries:
        whole = node.entries if isinstance(node, Mapping) and key.label not in KEYS else []
        meant = [key_meant(each.label, KEYS) for each, _ in whole]
        if whole and all(each in {*KEYS} - given for each in meant):
            given_there = [(each.label, value) for each, value in whole]
            whole = [
                (replace(each, value=f"{other}"), value)
                for (each, value), other in zip(whole, meant, strict=True)
            ]
            message = f"unknown key '{key.label}' in the problem"
            laws = [friction_meant(key, value, coordinates) for key, value in given_there]
            lines = ", ".join(
                law.partition(": its")[0].removeprefix("write ")
                or f"{each.label}: {source_of(value)}"
                for law, (each, value) in zip(laws, whole, strict=True)
            )
            hint = f"leave it out, and begin lines with {lines}"
            mistakes.append(Diagnostic(message, key.span, hint))
            entries += whole
            continue
        inner = node.entries if isinstance(node, Mapping) and key.label in _SECTIONS else []
        moved = [entry for entry in inner if is_misplaced(*entry)]
        for each, _ in moved:
            message = f"'{each.label}' stands inside of '{key.label}'"
            hint = f"begin its line where '{key.label}' begins"
            mistakes.append(Diagnostic(message, each.span, hint))
        if moved and isinstance(node, Mapping):
            node = replace(node, entries=[entry for entry in inner if entry not in moved])
        entries += [(key, node), *moved]
    root = replace(root, entries=entries)
    for section in ("parameters", "functions"):
        root, formulas = _with_definitions(root, section, {*coordinates})
        mistakes += formulas
    return root, mistakes


def _with_sections(root: Mapping) -> tuple[Mapping, list[Diagnostic]]:
    """The problem with entries that begin where their section or name does inside of it."""
    root, mistakes = _gathered(root, _is_of, "begin the line with blanks")
    entries = []
    for section, node in root.entries:
        attributes = _ATTRIBUTES.get(section.label, set())
        if attributes and isinstance(node, Mapping):

            def is_attribute(
                _: Entry, entry: Entry, *, is_open: bool, known: set[str] = attributes
            ) -> bool:
                return is_open and entry[0].label in known and not entry[0].in_flow

            node, found = _gathered(node, is_attribute, "begin the line with more blanks")
            mistakes += found
        entries.append((section, node))
    return replace(root, entries=entries), mistakes


def _gathered(
    whole: Mapping, belongs: Callable[..., bool], hint: str
) -> tuple[Mapping, list[Diagnostic]]:
    """The map with entries inside of the one above that they belong to, as mistakes."""
    entries: list[Entry] = []
    moved: dict[str, list[Entry]] = {}
    rules: dict[str, str] = {}
    for key, value in whole.entries:
        head, node = entries[-1] if entries else (key, key)
        inner = node.pairs
        is_open = node.is_empty or head.label in moved
        if entries and belongs((head, node), (key, value), is_open=is_open):
            if head.label not in moved and inner:
                rules[head.label] = f"begin the line where '{inner[0][0].label}' begins"
            moved.setdefault(head.label, []).append((key, value))
            start = node.start if inner else key.start
            entries[-1] = (head, Mapping(key.text, start, value.end, [*inner, (key, value)]))
        else:
            entries.append((key, value))
    mistakes = []
    for above, found in moved.items():
        text = whole.text.source.text
        ends = (k.end if v.is_empty else v.start + len(text[v.start : v.end].rstrip())
                for k, v in found)  # fmt: skip
        lines = [x for (key, _), end in zip(found, ends, strict=True)
                 for x in range(key.span.line, whole.text.position(end)[0] + 1)]  # fmt: skip
        names = ", ".join(f"'{key.label}'" for key, _ in found)
        message = f"{names} stand{'s' * (not found[1:])} below '{above}', but not in it"
        rule = rules.get(above, hint) + also_in_lines(lines[1:])
        mistakes.append(Diagnostic(message, found[0][0].span, rule))
    return (replace(whole, entries=entries) if moved else whole), mistakes


def _is_of(above: Entry, entry: Entry, *, is_open: bool) -> bool:
    """Whether an entry belongs to the section above it, which is empty or has others like it."""
    (head, node), (key, value) = above, entry
    if head.label not in MAPS:
        return False
    word, text = key.label, key.text.source.text
    written = value.value if isinstance(value, Scalar) else ""
    if key.in_flow or not (is_open or (isinstance(node, Mapping) and text[node.start] != "{")):
        return False
    if word in KEYS:  # H: 3, where H is a parameter
        used = re.search(rf"(?<![\w']){word}(?![\w':(])", text)
        return is_open and word in _ENERGIES and is_constant("x", written) and used is not None
    known = KEYS if is_open else (*KEYS, *meanings("parts"))
    if len(word) > 2 and key_meant(word, known) is not None:
        return False
    if is_open:
        return True
    if head.label == "initial":
        names = {each.label.rstrip("'") for each, _ in node.pairs}
        return word.rstrip("'") in names and is_constant("x", written)
    advice = {**spellings("advice", "problem"), **spellings("advice", "simulation")}
    if not word.isidentifier() or (word[1:] and letters(word) in advice):
        return False
    inner = {each.label for each, _ in value.pairs}
    is_number = head.label == "parameters" and is_constant(word, written)
    return is_number or (bool(inner) and inner <= _ATTRIBUTES.get(head.label, set()))


def _with_definitions(
    root: Mapping, section: str, coordinates: set[str]
) -> tuple[Mapping, list[Diagnostic]]:
    """The problem with formulas among its parameters or functions as definitions; one mistake."""
    sections = {key.label: node for key, node in root.entries}
    node, definitions = sections.get(section), sections.get("definitions")
    known = {*coordinates, "t", *names_in(sections.get("parameters"))}
    found = [
        entry for key, value in (node.pairs if node else ())
        if (entry := _formula_of(key, value, section, coordinates, known))
    ]  # fmt: skip
    given = definitions.pairs if definitions else []
    if not (found and isinstance(node, Mapping)) or (definitions is not None and not given):
        return root, []
    keys = [key for key, _ in found]
    named = [f"{key.label}: {source_of(value)}" for key, value in found]
    names = ", ".join(key.label for key in keys)
    what = "it has a formula" if section == "functions" else "it changes with time"
    if keys[1:]:
        what = what.replace("it has", "they have").replace("it changes", "they change")
    listed = f"are not {section}" if keys[1:] else f"is not a {section[:-1]}"
    message = f"{names} {listed}: {what}"
    uses_given = {*re.findall(r"\w+", f"{named}")} & {key.label for key, _ in given}
    hint = in_section("definitions", named, section, len(node.entries), is_given=bool(given))
    hint = hint.replace("begin ", "end ", 1) if uses_given else hint
    starts = {key.start for key in keys}
    rest = replace(node, entries=[each for each in node.entries if each[0].start not in starts])
    others = [each for each in root.entries if each[1] not in (node, definitions)]
    key = next(key for key, value in root.entries if value is node)
    formulas = replace(node, entries=[*given, *found] if uses_given else [*found, *given])
    entries = [*others, (key, rest), (replace(key, value="definitions"), formulas)]
    return replace(root, entries=entries), [Diagnostic(message, keys[0].span, hint)]


def _formula_of(
    key: Scalar, node: DocumentNode, section: str, coordinates: set[str], known: set[str]
) -> tuple[Scalar, DocumentNode] | None:
    """The name of a parameter or function with its formula; None where it has none.

    A formula of a parameter has coordinates or the time, that of `U(r)` no others than `r`.
    """
    inner = {each.label: value for each, value in node.pairs}
    value = inner.get("value", node) if section == "parameters" else node
    text = value.value if isinstance(value, Scalar) else ""
    called = CALLED.fullmatch(key.label)
    key = replace(key, value=called[1]) if called else key
    moves = {*re.findall(r"[^\W\d]\w*", text)} & {*coordinates, "t"}
    is_name = key.label.isidentifier() and key.label not in coordinates
    is_formula = re.search(r"[-+*/^(']", text) and (section == "functions" or (moves and is_name))
    if not is_formula or formula_or_none(text) is None:
        return None
    if section == "parameters":
        return None if unit_behind(text.replace("*", " ", 1)) else (key, value)  # 9.81*m/s^2
    is_open = called and not {*re.split(r"\s*,\s*", called[2])} <= known
    listed = re.fullmatch(r"(\w*)\(\s*[\w, ]+?\s*\)", text)  # U: U(r)
    return None if is_open or (listed and listed[1] not in FUNCTIONS) else (key, value)


def in_section(name: str, moved: list[str], other: str, entries: int, *, is_given: bool) -> str:
    """How some entries of another section are written in this one, which may be given.

    A section that would be empty without them is left out.
    """
    is_all = len(moved) == entries
    gone = f"leave {other if is_all else 'them' if moved[1:] else 'it'} out, and"
    if is_given:
        return f"{gone} begin {name} with {' and '.join(moved)}"
    place = f"in place of {other}" if is_all else f"{gone} on a line of its own"
    return f"{place} write {name}: {{{', '.join(moved)}}}"
