"""How a value of another shape is written as the map, the list or the sum that it should be."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable
from fractions import Fraction
from typing import get_args

from lagcli.notation.greek import BY_NAME as GREEK
from lagcli.problem_data import Assumption
from lagcli.reader.assignments import assigned, pieces
from lagcli.reader.foreign.cases import without_cases
from lagcli.reader.habits import (
    CASE,
    MAPS,
    habits,
    is_constant,
    key_meant,
    number_and_unit,
    unit_behind,
)
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, kind, names_in
from lagcli.reader.number_units import unit_mistake
from lagcli.reader.regex import outside, regex
from lagcli.reader.suggest import closest
from lagcli.reader.text import numbered

#: What is found without a question.
FOUND = frozenset(
    "frequency frequencies period equilibrium equilibria modes "
    "energy momentum momenta charges".split()
)

ALREADY_FOUND = (
    "leave it out: equilibria, frequencies and charges are found by "
    "lagcli solve FILE --show equilibria,modes,charges"
)
#: A frequency or a period with its formula.
_FOUND_LAW = regex(r"\s*(?:omega|ω|f|nu|ν|T|period|frequency)(?:_?\w)?\s*=[^=]*[^=\s]")
#: A longer section is not repeated.
_LONGEST = 80
FRICTION = "a friction force -c*x' is written dissipation: c*x'^2/2"
WITHOUT_HYPHENS = "leave out the '-' before each key"
#: `0:0.1:1`, also without the step.
RANGE = regex(
    r"\s*[\[(]?\s*(-?[\d.]*\d)\s*(?:\.\.+|…|to|bis|:|–)\s*(?:(-?[\d.]*\d)\s*:\s*)?"
    r"(-?[\d.]*\d)\s*[\])]?\s*"
)
_SPACED = regex(
    r"\s*(?:np\.|numpy\.)?linspace\(\s*(-?[\d.]*\d)\s*,\s*(-?[\d.]*\d)\s*"
    r"(?:,\s*(?:\w+\s*=\s*)?(\d+)\s*)?\)\s*"
)
_EQUATION = regex(r"\s*(?:\w+\.)?(?:Eq|Equality|Equal)\s*[(\[](.*)[)\]]\s*")
_RELATION = regex(r"([^\s=<>≤≥:,{[][^=<>≤≥:,{[]*?)\s*[=<>≤≥]+\s*([^=<>≤≥:,\]}]*[^\s=<>≤≥:,\]}])")
#: A velocity, or a difference of some.
_LINEAR = regex(r"\w+'|\(\s*-?\w+'(?:\s*[-+]\s*\w+')*\s*\)")
#: At least two words.
_WORDS = regex(r"[^\W\d_]+(?:[ ,]+[^\W\d_]+)+[.,: ]*")
#: Words of relations: y is 0, N is positive.
_OF_RELATIONS = frozenset(
    "is equals equal to positive nonnegative greater larger less than".split()
)
#: Words before a formula: the force of `a harmonic force F0*cos(w*t)`.
_BEFORE_FORMULA = regex(r"\s*((?:[^\W\d_]+[ ,:]+)+)(?=[\w.]+'*\s*[*/^(])")


def is_found(text: str, coordinates: Container[str]) -> bool:
    """Whether a text asks for what is found without a question: `period`, `omega = sqrt(g/l)`."""
    moves = any(each in coordinates for each in re.findall(r"[^\W\d]\w*", text))
    return text in FOUND or (_FOUND_LAW.fullmatch(text) is not None and not moves)


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


def as_equation(text: str) -> str:
    """`a = b` for `Eq(a, b)`; other texts as they are."""
    found = _EQUATION.fullmatch(text)
    sides = pieces(found[1], ",") if found else []
    return " = ".join(map(str.strip, sides)) if len(sides) == 2 else text


def named_formulas(node: DocumentNode) -> dict[str, str]:
    """`x*y` by `a` for each `a = x*y` in a text or a list; empty for others."""
    lines = [each for each in node.texts if "=" in each and not re.search("[-=]>|[→:]", each)]
    pairs = assigned("; ".join(re.sub(r"(?<=')=", "＝", each) for each in lines))  # where x'=0
    return {name: value.replace("＝", "=") for name, value in pairs}


def as_list(written: str) -> str:
    """`[x, y]` for `x, y`, for `(x, y)` and for `{x, y}`."""
    if re.fullmatch(r"\[[^\[\]]*\]", written.strip()):
        return written.strip()
    within = re.fullmatch(r"\s*[({](.*)[)}]\s*", written, re.DOTALL)
    outer = outside(within[1] if within else "")
    is_tuple = within is not None and "," in outer and not {"(", ")"} & {*outer}
    return f"[{within[1] if within and is_tuple else written.strip()}]"


def as_rayleigh(forces: str) -> str:
    """`c*x'^2/2 + k*(y' - z')^2/2` for the sum `-c*x' - k*(y' - z')`; nothing for other texts.

    Each term is linear in one velocity, or in a difference of velocities.  A half without a minus
    is that of the function.
    """
    found = []
    law = re.sub(r"(?<=[\w)])\s+(?=[\w(])", "*", re.sub(r"^\s*[FQ]\w*\s*=", "", forces))
    for term in map(str.strip, pieces(law.strip(" -+−"), "-+−")):
        factors = pieces(term, "*/")
        moving = [each.strip() for each in factors if "'" in each]
        if len(moving) != 1 or not _LINEAR.fullmatch(moving[0]):
            return ""
        at = term.index(moving[0]) + len(moving[0])
        if term[: at - len(moving[0])].rstrip().endswith("/"):
            return ""
        has_half = re.search(r"^(?:1/2|0\.5)(?!\d)|/\s*2$", term) and not re.search("[-−]", law)
        found.append(f"{term[:at]}^2{term[at:]}{'' if has_half else '/2'}")
    return " + ".join(found)


def texts_of(node: DocumentNode) -> list[str]:
    """The texts of a list; the lines of a text where each is a relation, else the whole of it.

    Of a map those that have no name: `{x = 1, y = 2}`.
    """
    found: list[str] = []
    if isinstance(node, Mapping) and all(value.is_empty for _, value in node.entries):
        found = [key.value for key, _ in node.entries]
        return found if all(re.search("[=<>≤≥→↦⇒]", each) for each in found) else []
    for each in node.parts or [node]:
        if isinstance(each, Scalar):
            lines = each.written.split("\n")
            are_relations = not each.style and all(re.search("[=<>≤≥]", line) for line in lines)
            found += [line.strip() for line in lines] if are_relations else [each.value]
    return found


def as_items(node: DocumentNode) -> str:
    """What the file has there, with brackets."""
    return source_of(node) if isinstance(node, Sequence) else as_list(source_of(node))


def one_sum(node: DocumentNode, what: str) -> str:
    """`write a + b` for the list `[a, b]` and the map `{spring: a, weight: b}`."""
    terms = node.parts
    inner = [key.label for key, _ in node.entries] if isinstance(node, Mapping) else []
    if what in {"L", "H"} and {key_meant(word, ("T", "V")) for word in inner} == {"T", "V"}:
        return f"leave out '{what}': T and V begin lines of their own"
    if isinstance(node, Mapping):
        pairs = [(value, key) for key, value in node.entries]
        terms = [k if isinstance(v, Scalar) and v.is_empty else v for v, k in pairs]
    if "value" in inner and {*inner} <= {"value", "unit", "description"}:
        return f"write {source_of(terms[inner.index('value')])}"
    written = [term.value.strip() for term in terms if isinstance(term, Scalar)]
    if what.startswith("the initial") and len(written) == 2:
        name, with_unit = what.split("'")[1], unit_mistake(" ".join(written))
        return with_unit[1] if with_unit else "write {0}: {1}, {0}': {2}".format(name, *written)
    if what in {"'for'", "'holds_while'"} or what.startswith("the question"):
        return f"one alone: write {written[0]}" if written else ""
    if any(re.search(r"\bif\b|[<>]", term) for term in (*written, *inner)):
        cases = [re.sub(r",?\s*(?:otherwise|else)\b:?", "", each).strip() for each in written]
        whole = without_cases(" else ".join(cases)) if len(cases) == 2 else ""
        return f"write {whole}" if "sign(" in whole else CASE
    if what.startswith(("the value of", "the initial")) and written:
        return f"write {written[0]}; {swept(name_in(what), node)}"
    if what.startswith("the definition of") and written and {*inner} <= {"x", "y", "z"}:
        name = what.split("'")[1]
        pairs_ = zip(inner or "xyz", written, strict=False)
        parts = (f"{name}_{axis}: {each}" for axis, each in pairs_)
        return f"a vector is written by its components: {', '.join(parts)}"
    if what.startswith("the constraint") and isinstance(node, Sequence) and written[1:]:
        return f"each equation has its own name: {numbered(what.split(chr(39))[1], written)}"
    if what == "'until'" and written:
        return f"a motion begins at t = 0: write {written[-1].split()[-1]}"
    return f"write {' + '.join(written)}" if written and len(written) == len(terms) else ""


def difference(text: str) -> str:
    """`y - 1` for `y = 1`, `y` for `{landing: y <= 0}`; nothing without a relation."""
    found = _RELATION.search(text)
    left, right = found.groups() if found else ("", "0")
    right = f"({right})" if re.search(r"[-+]", right) else right
    return left if right == "0" else f"{left} - {right}"


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
    written = as_equation(node.written).strip()
    written = re.sub(r"^(['\"])(.*)\1$", r"\2", written)
    known = [*coordinates]
    present = [x for x in known if x in re.findall(r"\w+", written)]
    unknown = next(iter([*present, *known]), "x")
    if names[0] == "unit" and (advice := _as_attributes(node, written, names)):
        return advice
    if names[0] == "where" and (written in FOUND or re.search(r"\bdet\(|\beig", written)):
        return ALREADY_FOUND
    if names[0] == "position" and isinstance(node, Scalar):
        entries = re.sub(r"(?:^|(?<=, ))(position|mass|force) +", r"\1: ", written)
        if re.match(r"(position|mass) ", written):
            return f"write {{{entries}}}"
        if parts := dict(assigned(written)):
            axes = [parts[axis] for axis in "xyz" if axis in parts]
            mass = parts.get("mass") or parts.get("m") or ""
            if axes:
                return f"write {{position: [{', '.join(axes)}]{f', mass: {mass}' * bool(mass)}}}"
        if not present and written.isidentifier():  # ball: m
            return f"write {{position: [x, y], mass: {written}}}"
        from lagcli.reader.foreign.vectors import with_commas

        if apart := with_commas(written, known):
            return re.sub(r"\[.*\]", r"{position: \g<0>}", apart)
    if names[0] == "until" and (end := range_end(re.split(r"[,;]", written)[0])):
        return f"write {{until: {end}}}"
    for key, kinds, form, advice in habits()["maps"]:
        found = re.fullmatch(form, written or "…") if kind(node) in kinds else None
        if found and names[0] == key:
            return f"write {found.expand(advice).replace('UNKNOWN', unknown)}"
    if names[0] == "at":
        place = written if len(known) == 1 and isinstance(node, Scalar) else "0"
        return f"write {{at: {{{unknown}: {place or '0'}}}}}"
    if (words := written.split(None, 1)) and words[0] in names and words[1:]:
        return f"write {{{words[0]}: {words[1].lstrip('=: ')}}}"
    return f"it has the keys {', '.join(names)}"


def with_state(hint: str, what: str, value: DocumentNode, *, is_key: bool = True) -> str:
    """The hint of a value that belongs to the initial state of a coordinate, with that state."""
    is_rate = hint.startswith("leave it out: the velocity of x is")
    if not is_rate and not hint.startswith("a state stands under initial"):
        return hint
    parts = [value] if isinstance(value, Scalar) else getattr(value, "items", [])
    numbers = [source_of(each) for each in parts]
    if not what.startswith("the coordinate") or not all(is_constant("x", n) for n in numbers):
        return hint
    name = what.split("'")[1]
    rates = [name, f"{name}'"][is_rate:]
    state = ", ".join(map("{}: {}".format, rates, numbers))
    written = ": write" if is_key else ", as in"
    return f"a state stands under initial{written} initial: {{{state}}}" if state else hint


def _as_attributes(node: DocumentNode, written: str, names: tuple[str, ...]) -> str:
    """How a text or a list is written as the attributes of a coordinate or a parameter."""
    if isinstance(node, Scalar):
        if written in get_args(Assumption):
            return f"write {{assume: {written}}}"
        if unit := number_and_unit(f"1 {written}")[1]:
            return f"write {{unit: {unit}}}"
        if is_constant("x", written):
            return "a state stands under initial, as in initial: {x: 1}"
        if "value" in names:
            return ""
        return "write {unit: rad}" if written == "angle" else f"write {{description: {written}}}"
    if not isinstance(node, Sequence):
        return ""
    listed = node.listed
    if unit_behind(f"1 {', '.join(listed)}"):
        return f"write {{unit: {listed[0]}}}"
    if "value" not in names:
        return "a coordinate has no range: leave it out"
    units = [each for each in listed if unit_behind(f"1 {each}")]
    numbers = [each for each in listed if is_constant("x", each)]
    words = [each for each in listed if each not in {*units, *numbers}]
    if len(units) == 1 and (len(listed) == 2 or (len(words) == len(numbers) == 1)):
        number = (numbers or words)[0]
        said = f", description: {words[-1]}" if listed[2:] else ""
        return f"write {{value: {number}, unit: {units[0]}{said}}}"
    return f"one value each, with a name of its own; {swept('name', node)}"


def values_of(node: DocumentNode) -> str:
    """`1,2,3` for a list of values, `0:1:5` for a range in five steps; nothing for others."""
    if isinstance(node, Sequence):
        return ",".join(map(source_of, node.items))
    given = by_key(node)
    ends = [x for key, x in given.items() if is_constant("x", x) and key != "step"]
    if 2 <= len(ends) <= 3 and "step" not in given:  # {from: 1, to: 5, number: 9}
        return ":".join([*ends, "COUNT"][:3])
    written = ":".join([*ends[:1], given.get("step", ""), *ends[1:]])
    return values_in(node.value if isinstance(node, Scalar) else written)


def values_in(text: str) -> str:
    """`1,2,3` for `1, 2, 3`, `0:1:5` for a range, also `1, 5`; nothing for others."""
    if spaced := _SPACED.fullmatch(text):
        return f"{spaced[1]}:{spaced[2]}:{spaced[3] or 'COUNT'}"
    found = RANGE.fullmatch(text.replace(",", ":") if text.count(",") == 1 else text)
    if found is None:
        values = [each.strip() for each in text.split(",")]
        return ",".join(values) if values[1:] and all(is_constant("x", x) for x in values) else ""
    first, *middle, last = (each for each in found.groups() if each)
    if not middle:
        count = int(last) - int(first) + 1 if (first + last).lstrip("-").isdigit() else 0
        return f"{first}:{last}:{count if count > 2 else 'COUNT'}"
    steps = (Fraction(last) - Fraction(first)) / (Fraction(middle[0]) or -1)
    if steps.denominator == 1 and steps > 0:
        return f"{first}:{last}:{steps + 1}"
    return f"{first}:{middle[0]}:{last}"


def name_in(what: str) -> str:
    """`x'` of "the initial 'x''"."""
    return what.split("'", 1)[1][:-1]


def swept(name: str, values: DocumentNode) -> str:
    """How a parameter or a part of the initial state is given several values."""
    varied = f"{name}={values_of(values)}"
    varied = f'"{varied}"' if "'" in name else varied
    return f"several are run by lagcli sweep FILE --vary {varied}"


def ranged(name: str, node: DocumentNode) -> str:
    """`write 0; several are run by ...` for `0:5`, `0 to 5`, `linspace(0, 5, 11)`; or nothing."""
    text = node.value if isinstance(node, Scalar) else ""
    found = RANGE.fullmatch(text) or _SPACED.fullmatch(text)
    return f"write {found[1]}; {swept(name, node)}" if found else ""


def key_by_shape(value: DocumentNode, problem: Mapping) -> str | None:
    """The key of a problem whose value this can be alone, whatever the word for it.

    A list of names is that of the coordinates, or else of the parameters; numbers by name are
    the initial state where the names are those of coordinates, and values of parameters else.
    """
    others = ((key.label, node) for key, node in problem.entries if node is not value)
    keys = tuple(MAPS)
    given = {key_meant(label, keys) or closest(label, keys, 0.8) or label: v for label, v in others}
    if isinstance(value, Sequence) and value.items:
        names = value.listed
        if len(names) == len(value.items) and all(map(str.isidentifier, names)):
            return next((key for key in ("coordinates", "parameters") if key not in given), None)
    if isinstance(value, Mapping) and value.entries:
        numbers = [isinstance(v, Scalar) and is_constant("x", v.value) for _, v in value.entries]
        known = names_in(given.get("coordinates"))
        changed = [k.label for _, v in value.entries for k, _ in v.pairs]
        if changed and {*changed} <= {*known, "t", "gauge"}:
            return None if "symmetries" in given else "symmetries"
        if all(numbers):
            stated = all(key.label.rstrip("'") in known for key, _ in value.entries)
            key = "initial" if stated else "parameters"
            return None if key in given else key
        text = value.text.source.text
        rest = text[: value.start] + text[value.end :]
        used = (re.search(rf"(?<!\w){re.escape(k.label)}(?!\w)", rest) for k, _ in value.entries)
        are_formulas = all(isinstance(v, Scalar) and "=" not in v.value for _, v in value.entries)
        return "definitions" if are_formulas and all(used) and "definitions" not in given else None
    return None


def as_text(node: DocumentNode) -> str:
    """How a list or a map is written as the text that it should be, or as an entry of a map."""
    inner = node.parts
    entries = node.pairs
    first = (*inner, *(key for key, _ in entries))[:1]
    if not (first and isinstance(first[0], Scalar)):
        return ""
    written = [(_attribute(key.label), source_of(value)) for key, value in entries]
    if len(entries) == 1 and written[0][0] in {"name", "id"}:
        return f"write {written[0][1]}"
    if len(entries) < 2:
        inner_ = entries_of(entries[0][1]) if entries else ""
        return f"write {first[0].value}" + (f": {{{inner_}}}, without '-'" if inner_ else "")
    name, value = written[0]
    said = [f"{key}: {each}" for key, each in written[1:]]
    if name in {"name", "id"}:
        name = value
    elif value:
        said = [f"value: {value}", *said]
    return f"write {name}: {{{', '.join(said)}}}, without '-'"


def _attribute(word: str) -> str:
    """`unit` for units and Einheit, `mass` for m; other words as they are."""
    known = ("value", "unit", "symbol", "description", "assume", "position", "mass", "force")
    return key_meant(word, known) or key_meant(word.removesuffix("s"), known) or word


def by_its_name(node: DocumentNode) -> str:
    """`bob: {mass: m}, rod: {mass: M}` for a list of maps that have their names inside.

    Texts in quotes may have them, too: `["rod: x = l"]`.
    """
    items = node.parts or [node]
    texts = [each.value for each in items if isinstance(each, Scalar)]
    lines = "\n".join(texts).strip().split("\n")
    if len(texts) == len(items) and all(re.match(r"[^\W\d]\w*'*: ", each) for each in lines):
        return ", ".join(lines)
    each = [item.entries for item in items if isinstance(item, Mapping)]
    if len(each) < len(items) or not all({"name", "id"} & {k.label for k, _ in e} for e in each):
        return ""
    whole = map(as_text, items)
    return ", ".join(one.removeprefix("write ").removesuffix(", without '-'") for one in whole)


def entries_of(node: DocumentNode | None) -> str:
    """The entries of a map in one line, as between braces."""
    return ", ".join(map(": ".join, by_key(node).items()))


def by_key(node: DocumentNode | None) -> dict[str, str]:
    """What the file has at each key of a map; empty for other nodes."""
    return {key.label: source_of(value) for key, value in (node.pairs if node else ())}


def inner_of(node: DocumentNode | None, first: str) -> dict[str, str]:
    """The attributes of an entry, of which the `first` may stand alone."""
    is_bare = not isinstance(node, Mapping) and node is not None and not node.is_empty
    return {first: source_of(node)} if is_bare and node is not None else by_key(node)


def as_flow(parts: dict[str, str]) -> str:
    """`{value: 1, unit: kg}`."""
    return f"{{{', '.join(map(': '.join, parts.items()))}}}"


def with_entries(given: str, added: str) -> str:
    """`{m, k: 2}` for the section `[m]` and the entry `k: 2`; nothing for a long one or none."""
    inner = " ".join(given[1:-1].split()).rstrip(", ")
    entries = pieces(f"{inner}, {added}" if inner else added, ",")
    parts = {each.partition(":")[0].strip(): each.strip() for each in entries}
    begin, end = "{}" if given[:1] == "{" or ":" in added else "[]"
    whole = f"{begin}{', '.join(parts.values())}{end}"
    is_short = given[:1] in {"{", "["} and "#" not in given and len(whole) <= _LONGEST
    return whole if is_short else ""


def source_of(node: DocumentNode) -> str:
    """What the file has there, in one line: a map in braces, a list in brackets."""
    written = " ".join(node.written.split())
    if isinstance(node, Mapping) and node.entries and written[0] != "{":
        return f"{{{entries_of(node)}}}"
    if isinstance(node, Sequence) and node.items and written[0] != "[":
        return f"[{', '.join(map(source_of, node.items))}]"
    return written
