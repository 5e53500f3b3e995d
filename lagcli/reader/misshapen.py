"""How a value of another shape is written as the map, the list or the sum that it should be."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable
from typing import get_args

from lagcli.notation.greek import BY_NAME as GREEK
from lagcli.problem_data import Assumption
from lagcli.reader.habits import CASE, MAPS, is_constant, key_meant, unit_behind
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.number_units import unit_mistake

#: What is found without a question.
FOUND = frozenset(
    "frequency frequencies period equilibrium equilibria modes energy momentum charges".split()
)

SEVERAL = "one value each, with a name of its own; several are run by lagcli sweep --vary"
ALREADY_FOUND = "leave it out: equilibria, frequencies and charges are found"
WITHOUT_HYPHENS = "leave out the '-' before each key"


#: At least two words.
_WORDS = re.compile(r"[^\W\d_]+(?:[ ,]+[^\W\d_]+)+[.,: ]*")
#: Words of relations: y is 0, N is positive.
_OF_RELATIONS = frozenset(
    "is equals equal to positive nonnegative greater larger less than".split()
)
#: Words before a formula: the force of `a harmonic force F0*cos(w*t)`.
_BEFORE_FORMULA = re.compile(r"\s*((?:[^\W\d_]+[ ,:]+)+)(?=[\w.]+'*\s*[*/^(])")


def is_sentence(text: str, known: Container[str]) -> bool:
    """Whether a text is words, more of them unknown than known, and not letters of quantities."""
    words = [each for each in re.findall(r"\w+", text) if each not in _OF_RELATIONS]
    strange = [each for each in words if each not in known and each not in GREEK]
    is_long = max(map(len, strange), default=0) >= 5
    return _WORDS.fullmatch(text.strip()) is not None and is_long and 2 * len(strange) > len(words)


def behind_words(text: str, known: Container[str]) -> str:
    """The formula without the words before it."""
    found = _BEFORE_FORMULA.match(text)
    return text[found.end() :] if found and is_sentence(found[1], known) else text


def as_list(written: str) -> str:
    """`[x, y]` for `x, y` and for `(x, y)`."""
    within = re.fullmatch(r"\s*\((.*)\)\s*", written, re.DOTALL)
    outer = within[1] if within else ""
    while (inner := re.sub(r"\([^()]*\)", "", outer)) != outer:
        outer = inner
    is_tuple = within is not None and "," in outer and not {"(", ")"} & {*outer}
    return f"[{within[1] if within and is_tuple else written.strip()}]"


def one_sum(node: DocumentNode, what: str) -> str:
    """`write a + b` for the list `[a, b]` and the map `{spring: a, weight: b}`."""
    terms = node.items if isinstance(node, Sequence) else []
    inner = [key.label for key, _ in node.entries] if isinstance(node, Mapping) else []
    if what in {"L", "H"} and {key_meant(word, ("T", "V")) for word in inner} == {"T", "V"}:
        return f"leave out '{what}': T and V begin lines of their own"
    if isinstance(node, Mapping):
        pairs = [(value, key) for key, value in node.entries]
        terms = [k if isinstance(v, Scalar) and v.is_empty else v for v, k in pairs]
    written = [term.value.strip() for term in terms if isinstance(term, Scalar)]
    if what.startswith("the initial") and len(written) == 2:
        name, with_unit = what.split("'")[1], unit_mistake(" ".join(written))
        return with_unit[1] if with_unit else "write {0}: {1}, {0}': {2}".format(name, *written)
    if any(re.search(r"\bif\b|[<>]", term) for term in (*written, *inner)):
        return CASE
    if what.startswith("the value of"):
        return SEVERAL
    if what.startswith("the definition of") and isinstance(node, Sequence) and written:
        name = what.split("'")[1]
        parts = (f"{name}_{axis}: {each}" for axis, each in zip("xyz", written, strict=False))
        return f"a vector is written by its components: {', '.join(parts)}"
    if what == "'until'" and written:
        return f"a motion begins at t = 0: write {written[-1].split()[-1]}"
    return f"write {' + '.join(written)}" if written and len(written) == len(terms) else ""


def range_end(written: str) -> str:
    """The 10 of `0..10`, `(0, 10)`, `0:0.1:10`, `0 to 10 s`; nothing for one number."""
    number = r"(\d+(?:\.\d+)?(?:e-?\d+)?)"
    between = rf"0(?:\.0*)?\s*(?:\.\.+|…|[:,;–]|-|to|until|bis|\s)\s*(?:{number}\s*[:,;]\s*)?"
    written = re.sub(
        r"^(?:\w+\.)?(?:linspace|arange|range|tspan)\(\s*(.*)\)$", r"\1", written.strip()
    )
    if spaced := re.fullmatch(r"0(?:\.0*)?\s*,\s*([\d.]+)\s*(?:,.*)?", written):
        return spaced[1]
    found = re.fullmatch(
        rf"[(\[]?\s*{between}{number}\s*(?:s|sec|seconds)?\s*[)\]]?", written.strip()
    )
    return found[2] if found else ""


def as_map(node: DocumentNode, names: tuple[str, ...], coordinates: Iterable[str] = ()) -> str:
    """How a text or a list is written as the map that it should be."""
    written = node.text.source.text[node.start : node.end].strip()
    names_given = [*coordinates]
    present = [x for x in names_given if x in re.findall(r"\w+", written)]
    unknown = next(iter([*present, *names_given]), "x")
    question = re.fullmatch(r"[\"']?(?:solve\s+)?(.*=.*\S)\s+for\s+(\w+'*)[\"']?", written)
    if isinstance(node, Scalar) and names[0] == "where" and question:
        return f"write {{where: {question[1]}, for: {question[2]}}}"
    asked = re.fullmatch(r"[\"']?(\w+'*)\s+(?:where|when|if|at)\s+(.*=.*\S)[\"']?", written)
    if isinstance(node, Scalar) and names[0] == "where" and asked:
        return f"write {{where: {asked[2]}, for: {asked[1]}}}"
    if isinstance(node, Scalar) and names[0] == "where" and "=" in written:
        return f"write {{where: {written}, for: {unknown}}}"
    if isinstance(node, Scalar) and written in get_args(Assumption) and "assume" in names:
        return f"write {{assume: {written}}}"
    if isinstance(node, Scalar) and unit_behind(f"1 {written}") == written and "unit" in names:
        return f"write {{unit: {written}}}"
    if names[0] == "at":
        within = re.fullmatch(r"\{?\s*(\w+)\s*[:=]\s*([^=:]+?)\s*\}?", written)
        if within:
            return f"write {{at: {{{within[1]}: {within[2]}}}}}"
        place = written if len(names_given) == 1 and isinstance(node, Scalar) else "0"
        return f"write {{at: {{{unknown}: {place or '0'}}}}}"
    if isinstance(node, Sequence) and names[0] == "unit" and unit_behind(f"1 {written[1:-1]}"):
        return f"write {{unit: {written[1:-1]}}}"
    if isinstance(node, Sequence) and names[0] == "unit" and "value" not in names:
        return "a coordinate has no range: leave it out"
    if isinstance(node, Sequence) and "value" in names:
        inner = written[1:-1]
        if not written.startswith("["):
            inner = ", ".join(each.value for each in node.items if isinstance(each, Scalar))
        number, _, unit = (each.strip() for each in inner.partition(","))
        if unit_behind(f"1 {number}"):
            number, unit = unit, number
        if unit and unit_behind(f"1 {unit}"):
            return f"write {{value: {number}, unit: {unit}}}"
        return SEVERAL
    if isinstance(node, Scalar) and names[0] == "unit" and is_constant("x", written):
        return "a state stands under initial, as in initial: {x: 1}"
    if isinstance(node, Scalar) and names[0] == "unit" and written == "angle":
        return "write {unit: rad}"
    if isinstance(node, Scalar) and names[0] == "unit" and "value" not in names:
        return f"write {{description: {written}}}"
    if isinstance(node, Scalar) and names[0] == "where" and written in FOUND:
        return ALREADY_FOUND
    if isinstance(node, Scalar) and names[0] == "where" and len(written.split()) > 2:
        return f"write a question as {{where: {unknown}' = 0, for: {unknown}}}"
    if isinstance(node, Scalar) and names[0] == "where":
        return f"write {{value: {written or '…'}, in_terms_of: [{unknown}]}}"
    if (
        isinstance(node, Sequence)
        and names[0] == "until"
        and isinstance(node.items[-1:], list)
        and all(isinstance(each, Scalar) for each in node.items)
    ):
        return f"write {{until: {written.strip('[]').split(',')[-1].strip()}}}"
    if (
        isinstance(node, Scalar)
        and names[0] == "position"
        and re.match(r"(position|mass) ", written)
    ):
        entries = re.sub(r"(?:^|(?<=, ))(position|mass|force) +", r"\1: ", written)
        return f"write {{{entries}}}"
    is_position = isinstance(node, Scalar) and names[0] == "position" and written
    if is_position and not present and written.isidentifier():  # ball: m
        return f"write {{position: [x, y], mass: {written}}}"
    if is_position:
        within = re.fullmatch(r"\((.*)\)", written)
        return f"write {{position: [{within[1] if within else written}]}}"
    if (words := written.split(None, 1)) and words[0] in names and words[1:]:
        return f"write {{{words[0]}: {words[1].lstrip('=: ')}}}"
    if "accelerations" in names and (
        known := re.fullmatch(r"([^\W\d]\w*)(''|\(t\)|)\s*=\s*(.+)", written)
    ):
        key = "accelerations" if known[2] == "''" else "trajectory"
        return f"write {{{key}: {{{known[1]}: {known[3]}}}}}"
    if names[0] == "until" and (known := re.match(r"(\d[\d.]*)\s*(?:s|sec|seconds?)\b", written)):
        return f"write {{until: {known[1]}}}"
    if isinstance(node, Sequence) and all(isinstance(each, Mapping) for each in node.items):
        return WITHOUT_HYPHENS
    if names[0] == "until" and isinstance(node, Scalar) and not re.search(r"\d", written):
        return "write {until: 10}, with the time of the end"
    fits = {"until": Scalar, "position": Sequence}.get(names[0])
    if fits and isinstance(node, fits) and written:
        return f"write {{{names[0]}: {written}}}"
    return f"it has the keys {', '.join(names)}"


def key_by_shape(value: DocumentNode, problem: Mapping) -> str | None:
    """The key of a problem whose value this can be alone, whatever the word for it.

    A list of names is that of the coordinates, or else of the parameters; numbers by name are
    the initial state where the names are those of coordinates, and values of parameters else.
    """
    others = ((key.label, node) for key, node in problem.entries if node is not value)
    given = {key_meant(label, tuple(MAPS)) or label: node for label, node in others}
    if isinstance(value, Sequence) and value.items:
        names = [each.value for each in value.items if isinstance(each, Scalar)]
        if len(names) == len(value.items) and all(map(str.isidentifier, names)):
            return next((key for key in ("coordinates", "parameters") if key not in given), None)
    if isinstance(value, Mapping) and value.entries:
        numbers = [isinstance(v, Scalar) and is_constant("x", v.value) for _, v in value.entries]
        if all(numbers):
            listed = given.get("coordinates")
            known = [each.value for each in getattr(listed, "items", ())]
            known += [key.label for key, _ in getattr(listed, "entries", ())]
            stated = all(key.label.rstrip("'") in known for key, _ in value.entries)
            key = "initial" if stated else "parameters"
            return None if key in given else key
    return None


def as_text(node: DocumentNode) -> str:
    """How a list or a map is written as the text that it should be, or as an entry of a map."""
    inner = node.items if isinstance(node, Sequence) else []
    entries = node.entries if isinstance(node, Mapping) else []
    first = (*inner, *(key for key, _ in entries))[:1]
    if not (first and isinstance(first[0], Scalar)):
        return ""
    written = [(key.label, source_of(value)) for key, value in entries]
    if len(entries) < 2:
        return f"write {first[0].value}"
    name, value = written[0]
    said = [f"{key}: {each}" for key, each in written[1:]]
    if name in {"name", "id"}:
        name = value
    elif value:
        said = [f"value: {value}", *said]
    return f"write {name}: {{{', '.join(said)}}}, without '-'"


def by_its_name(node: Sequence) -> str:
    """`bob: {mass: m}` for the first of a list of maps that have their names inside."""
    first = node.items[0] if node.items else None
    is_named = isinstance(first, Mapping) and {"name", "id"} & {
        key.label for key, _ in first.entries
    }
    return (
        as_text(first).removeprefix("write ").removesuffix(", without '-'")
        if is_named and first
        else ""
    )


def source_of(node: DocumentNode) -> str:
    """What the file has there, in one line."""
    return " ".join(node.text.source.text[node.start : node.end].split())
