"""The sections `coordinates` and `parameters`: what has a name."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import Literal, TypedDict, cast

from lagcli.diagnostics import Span
from lagcli.expression import FUNCTIONS
from lagcli.notation.greek import BY_NAME as GREEK
from lagcli.problem_data import Assumption, Coordinate, Parameter
from lagcli.reader.assignments import assigned
from lagcli.reader.constants import value_cycle
from lagcli.reader.file_reader import FileReader
from lagcli.reader.habits import advised, is_constant, is_open, name_meant, unit_behind
from lagcli.reader.headings import SAID, is_said, without_headings
from lagcli.reader.listed_names import as_names
from lagcli.reader.misshapen import by_its_name, entries_of, source_of, swept
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, kind
from lagcli.reader.number_units import in_digits, in_unit, wrong_unit
from lagcli.reader.regex import regex
from lagcli.reader.scope import VALUES, name_mistake
from lagcli.reader.sign_meant import ASSUMPTIONS, NEUTRAL, integer_meant, sign_meant
from lagcli.reader.suggest import closest, did_you_mean
from lagcli.record import replace


class _Said(TypedDict, total=False):
    """The attributes that coordinates and parameters share."""

    unit: str
    unit_span: Span
    symbol: str
    description: str
    assume: Assumption


_PARAMETER_ATTRIBUTES = (*SAID, "integer", "value")
_ATTRIBUTE = regex(r"(assume|unit|value(?=[\s=]+[-\d.]))\s+(?:=\s*)?([^=]+)")
#: A number with words behind it.
_NUMBER_WITH_WORDS = regex(
    r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)(?:\s*[(:;,]|\s+[-–—]|\s)\s*"
    r"([^\W\d_]{3,}(?:[ -][^\W\d_]+)*)\s*\)?\s*"
)
_WORDS = regex(r"[^\W\d_]{4,}(?: [^\W\d_]+)*")
#: `G M` and `G*M` before a value, the name GM.
_PRODUCT = regex(r"^[^\W\d](?:[ *][^\W\d])+(?=\s*[=:])")
_ONE_NAME = regex(r"write (\w+)(?:, without .*)?")
_ASSUMED = ("assume", "value")


def read_coordinates(file: FileReader, node: DocumentNode) -> tuple[Coordinate, ...]:
    """The generalized coordinates, in order; each is declared in the scope."""
    coordinates = []
    for key, value in declared(file, node, "coordinates"):
        attributes = _attributes(file, value, key, "coordinate", SAID)
        coordinates.append(Coordinate(name=key.label, span=key.span, **_said(file, attributes)))
    if isinstance(node, Mapping | Sequence) and not (node.parts or node.pairs):
        names = ", ".join(_moving(node.text.source.text)) or "x"
        hint = f"write coordinates: [{names}]"
        file.error("the problem has no coordinates", node.span, hint, refused="")
    return tuple(coordinates)


def _moving(text: str) -> list[str]:
    """The names with primes, dots or momenta in the energies, in their order there."""
    if energy := re.search(r"^H:(.*)$", text, re.MULTILINE):
        momenta = re.findall(r"(?<!\w)p(?:_(\w+)|([qrxyz]\d?|theta|phi|psi)(?!\w))", energy[1])
        alone = re.findall(r"(?<!\w)(?:[qxr]|theta|phi)(?!\w)", energy[1])
        stem = re.search(r"(?<!\w)([qx]_?)1(?!\w)", energy[1])
        names = ("".join(each) for each in momenta)
        names = (f"{stem[1] if stem else 'q_'}{x}" if x.isdigit() else x for x in names)
        return [*dict.fromkeys(names)] or alone[:1]
    lines = re.findall(r"^(?:[TLV]|definitions|constraints|  +\w+):(.*)$", text, re.MULTILINE)
    rates = re.findall(
        r"([^\W\d]\w*)'+(?![\w'(])|\\dot\s*\{?\\?(\w+)|([^\W\d_]+)_?dot\b", "\n".join(lines)
    )
    return [*dict.fromkeys("".join(each) for each in rates)]


def read_parameters(
    file: FileReader, entries: list[tuple[Scalar, DocumentNode | None]]
) -> tuple[Parameter, ...]:
    """The parameters with their values, which may use each other without a cycle."""
    parameters = []
    described: list[tuple[Scalar, Scalar]] = []
    for key, node in entries:
        attributes: dict[str, DocumentNode] = {}
        if node is not None and (bare := _in_order(node)):
            file.error(f"the attributes of '{key.label}' have names", node.span, bare)
            continue
        if indexed := _indexed(key.label, node):
            file.error(f"'{key.label}' has several values", key.span, indexed)
            file.scope.refused += ["", f"{key.label}["]
            continue
        if isinstance(node, Scalar) and not node.is_empty:
            attributes = {"value": node}
        else:
            attributes = _attributes(file, node, key, "parameter", _PARAMETER_ATTRIBUTES)
        value, before = None, len(file.diagnostics)
        given = attributes.get("value")
        bare = getattr(given, "value", "(")
        is_free = bare not in file.scope.kinds and bare[:1] not in {"(", "["}
        sign = sign_meant(bare) if is_free else ""
        if is_free and (said_ := integer_meant(bare) or f"assume: {sign}" * bool(sign)):
            rest = (f", {k}: {source_of(v)}" for k, v in attributes.items() if k not in _ASSUMED)
            hint = f"write {key.label}: {{{said_}{''.join(rest)}}}"
            file.error(f"an assumption stands under 'assume' of '{key.label}'", key.span, hint)
        elif is_free and is_open(bare):
            hint = f"leave out what is not known: write {key.label}:"
            file.error(f"'{bare}' is not a value", attributes["value"].span, hint)
        elif given is not None and (pair := _in_order(given)):
            file.error(f"the value of '{key.label}' is a number alone", given.span, pair)
        elif isinstance(given, Scalar) and is_described(given.value, file.scope.kinds):
            described.append((key, given))
        elif isinstance(given, Scalar) and (both := _with_words(given.value, file.scope.kinds)):
            file.error(f"the value of '{key.label}' is a number alone", given.span, both)
        elif isinstance(given, Scalar) and "unit" in attributes and (
            other := in_unit(given.value, source_of(attributes["unit"]))
        ):  # fmt: skip
            file.error(other[0], given.span, other[1])
        elif "value" in attributes:
            what = f"the value of '{key.label}'"
            value = file.expression(attributes["value"], what, VALUES)
            file.scope.formulas[key.label] = getattr(given, "value", "")
        if isinstance(node, Mapping):
            found_ = file.diagnostics[before:]
            file.diagnostics[before:] = [replace(x, hint=_in_map(x.hint)) for x in found_]
        integer = "integer" in attributes and file.yes_or_no(attributes["integer"], "integer")
        said = _said(file, attributes)
        parameters.append(
            Parameter(name=key.label, span=key.span, value=value, integer=bool(integer), **said)
        )
    if described:
        key, first = described[0]
        others = ", ".join(each.label for each, _ in described[1:])
        hint = f"write {{description: {source_of(first)}}}"
        hint = hint if first is dict(entries)[key] else _in_map(hint)
        message = f"the value of '{key.label}' is a text, not a number"
        file.error(message, first.span, f"{hint}, and so for {others}" if others else hint)
    values = {one.name: one.value for one in parameters if one.value is not None}
    if cycle := value_cycle(values):  # directly or through others
        file.error(cycle[1], values[cycle[0]].span)
    return tuple(parameters)


def _in_map(hint: str) -> str:
    """`write value: 1, unit: m` for `write {value: 1, unit: m}`, where braces stand already."""
    return re.sub(r"write \{((?:value|unit|assume|description): [^{}]*)\}", r"write \1", hint)


def _in_order(node: DocumentNode | None) -> str:
    """`write {value: 1, unit: m}` for `{1, m}` and `[1, m]`; nothing for others."""
    entries = node.pairs if node else []
    parts = node.items if isinstance(node, Sequence) else [k for k, v in entries if v.is_empty]
    written = [each.value for each in parts if isinstance(each, Scalar)]
    is_pair = (
        len(written) == len(entries or parts) == 2 and unit_behind(" ".join(written)) == written[1]
    )
    return f"write {{value: {written[0]}, unit: {written[1]}}}" if is_pair else ""


def _indexed(name: str, node: DocumentNode | None) -> str:
    """How `m: [1, 2]` and `m: {1: 3, 2: 4}` are written by names; nothing for other values."""
    given: list[tuple[str, DocumentNode]] = []
    if isinstance(node, Mapping):
        given = [(key.label, value) for key, value in node.entries]
    elif isinstance(node, Sequence):
        given = [(str(place), value) for place, value in enumerate(node.items, start=1)]
    if node is None or len(given) < 2 or not all(index.isdigit() for index, _ in given):
        return ""
    if not all(isinstance(value, Scalar) and is_constant("x", value.value) for _, value in given):
        return ""
    bare = re.findall(rf"(?<![\w.]){re.escape(name)}(?![\w\[{{(])", given[0][1].text.source.text)
    if isinstance(node, Sequence) and bare[1:]:  # the name itself stands in formulas
        return f"write {name}: {source_of(given[0][1])}; {swept(name, node)}"
    written = ", ".join(f"{name}_{index}: {source_of(value)}" for index, value in given)
    return f"write {written}" + f"; {swept(name, node)}" * isinstance(node, Sequence)


def _with_words(text: str, known: Collection[str]) -> str:
    """`write {value: 1, description: mass of the bob}` for `1 (mass of the bob)`."""
    found = _NUMBER_WITH_WORDS.fullmatch(text)
    if found is None or unit_behind(text) or found[2].split()[0] in known:
        return ""
    return f"write {{value: {found[1]}, description: {found[2].strip()}}}"


def is_described(text: str, known: Collection[str]) -> bool:
    """Whether a value is words, such as `mass of the bob`, and no name of the file is in it."""
    words = re.split(r"[ ,.-]+", text.strip())
    if any(word in known or not word.isalpha() for word in words) or in_digits(text) != text:
        return False
    if advised("constants", text):
        return False
    longest = max(words, key=len)
    if len(words) > 1:
        return len(longest) > 3 and longest not in FUNCTIONS
    is_name = longest in GREEK or is_open(longest) or closest(longest, [*ASSUMPTIONS, *known])
    return len(longest) > 3 and longest.islower() and longest not in FUNCTIONS and not is_name


def declared(
    file: FileReader, node: DocumentNode, section: Literal["coordinates", "parameters"]
) -> Iterator[tuple[Scalar, DocumentNode | None]]:
    """The names of a list or of a map's keys, as far as they could be declared."""
    kind_: Literal["coordinate", "parameter"] = (
        "coordinate" if section == "coordinates" else "parameter"
    )
    entries: list[tuple[Scalar, DocumentNode | None]]
    if given := _pairs(node, section):
        named = [(name, value) for name, _, value in (x.partition(": ") for x in given.split(", "))]
        listed = ", ".join(name for name, _ in named)
        state = f"write [{listed}], and below it initial: {{{given}}}"
        if all(_WORDS.fullmatch(value) and not is_open(value) for _, value in named):
            described = (f"{name}: {{description: {value}}}" for name, value in named)
            state = given = ", ".join(described)
        hint = state if section == "coordinates" and "{" not in given else f"write {{{given}}}"
        coordinates = "coordinates have no values; their state is initial"
        message = coordinates if hint is state else f"{section} with more than names are a map"
        file.error(message, node.span, hint, refused="")
        return
    numbered = node.pairs
    if numbered and all(key.label.isdigit() for key, _ in numbered):
        listed = ", ".join(source_of(value) for _, value in numbered)
        file.error(f"{section} have names, not numbers", node.span, f"write [{listed}]", refused="")
        return
    attributes = _PARAMETER_ATTRIBUTES if section == "parameters" else SAID
    if found := without_headings(node, attributes):
        message = f"'{found[0].label}' is not a name of {section}: names stand below it"
        file.error(message, found[0].span, found[1], refused="")
        return
    if isinstance(node, Mapping):
        own = file.of_section(file.entries(node, section), section, attributes)
        entries = _without_attributes(file, own)
    elif isinstance(node, Sequence):
        names = [file.scalar(item, "a name") for item in node.items]
        entries = [(name, None) for name in names if name is not None]
        file.scope.refused += [""] * (len(names) - len(entries))
    elif isinstance(node, Scalar) and not node.is_empty:
        file.error(f"{section} must be a list or a map", node.span, as_names(node.value))
        file.scope.refused += ["", *re.findall(r"[^\W\d]\w*", node.value)]
        return
    else:
        hint = "such as [x, y]" if section == "coordinates" else "such as [m, g]"
        file.error(f"{section} must be a list or a map, not {kind(node)}", node.span, hint)
        file.scope.refused.append("")  # whatever was to be declared
        return
    if isinstance(node, Sequence) and (renamed := _renamed([key for key, _ in entries])):
        first, hint = renamed
        file.error(f"'{first.label}' is not a name", first.span, hint)
        file.scope.refused += [key.label for key, _ in entries]
        return
    labels = [key.label for key, _ in entries]
    moving = _moving(file.text) if section == "coordinates" else []
    absent = [x for x in moving if x not in labels]
    for place, (key, value) in enumerate(entries):
        if len(absent) == 1 and key.label in labels[:place]:  # [x1, x1]
            file.error(f"'{key.label}' is declared twice", key.span, f"write {absent[0]}")
            key.value = absent[0]
        if broken := re.fullmatch(r"(\w+)(?<!_)\s*([=:]?)\s*(\{.*)", key.label):
            whole = f"{broken[1]}: {broken[3]}: {'' if value is None else source_of(value)}"
            missing = "blank" if broken[2] == ":" else "':'"
            message = f"a {missing} is missing behind '{broken[1]}'"
            file.error(message, key.span, f"write {whole}", refused=broken[1])
        elif several := _listed(key.label):
            given = "" if value is None else source_of(value)
            hint = f"write {', '.join(f'{name}: {given}'.rstrip() for name in several)}"
            file.error("each name has a line of its own", key.span, hint)
            file.scope.refused += several
        elif section == "parameters" and (better := _without_primes(file, key)):
            hint = f"write {better}: a prime is a velocity"
            file.error(f"'{key.label}' is not a name", key.span, hint, refused=key.label)
        elif with_unit := _with_unit(key, value):
            message = f"the unit in '{key.label}' is not a part of its name"
            file.error(message, key.span, with_unit, refused=key.label)
        elif value is not None and (said := _ATTRIBUTE.fullmatch(source_of(value))) and (
            said[1] in attributes and is_said(*said.groups())
        ):  # fmt: skip
            hint = f"write {{{said[1]}: {said[2]}}}"
            message = "a map on the line of its key stands in braces"
            file.error(message, value.span, hint, refused=key.label)
        elif file.declare(key.label, kind_, key.span, one=value is not None and not value.is_empty):
            yield key, value


def _listed(label: str) -> tuple[str, ...]:
    """The names of `m1, m2`, where there are several."""
    names = tuple(map(str.strip, label.split(",")))
    return names if names[1:] and all(map(str.isidentifier, names)) else ()


def _without_attributes(
    file: FileReader, entries: list[tuple[Scalar, DocumentNode]]
) -> list[tuple[Scalar, DocumentNode | None]]:
    """The entries; a mistake where `unit: kg` stands beside `m: 2`, and not in it."""
    kept: list[tuple[Scalar, DocumentNode | None]] = []
    loose: dict[int, list[tuple[Scalar, str]]] = {}
    for key, value in entries:
        written = source_of(value) if key.label in SAID else ""
        is_attribute = bool(written) and not is_constant("x", written)
        if key.label == "assume":
            is_attribute = isinstance(value, Mapping) or written in ASSUMPTIONS
        elif key.label == "unit":
            is_attribute = unit_behind(f"1 {written}") == written
        if written and is_attribute:
            own = entries_of(value) or f"{key.label}: {written}"
            loose.setdefault(len(kept), []).append((key, own))
        else:
            kept.append((key, value))
    for place, parts in loose.items():
        name, node = (kept[place - 1][0].label, kept[place - 1][1]) if place else ("name", None)
        given = entries_of(node) or (
            f"value: {source_of(node)}" if isinstance(node, Scalar) else ""
        )
        inner = ", ".join(filter(None, (given, *(x for _, x in parts if x not in given))))
        file.scope.refused += [] if place else [""]
        message = f"'{parts[0][0].label}' is an attribute, not a name"
        file.error(message, parts[0][0].span, f"write all as {name}: {{{inner}}}")
    return kept


def _renamed(names: list[Scalar]) -> tuple[Scalar, str] | None:
    """The first of several names that are none, and the whole list; None for fewer."""
    mistakes = [(each, name_mistake(each.label)) for each in names]
    wrong = [(each, mistake[1]) for each, mistake in mistakes if mistake is not None]
    better = {each.label: found[1] for each, hint in wrong if (found := _ONE_NAME.fullmatch(hint))}
    if len(wrong) < 2 or len(better) < len(wrong):
        return None
    tail = wrong[0][1].partition(", without")
    listed = ", ".join(better.get(each.label, each.label) for each in names)
    return wrong[0][0], f"write [{listed}]{tail[1]}{tail[2]}"


def _without_primes(file: FileReader, key: Scalar) -> str:
    """A name that is free, `m2` for `m'`; nothing for the velocity of a coordinate."""
    found = re.fullmatch(r"([^\W\d]\w*?)['’′″]+", key.label)
    if found is None or found[1] in file.scope.coordinates:
        return ""
    words = {*re.findall(r"\w+", key.text.source.text)}
    return next(x for k in range(2, len(words) + 3) if (x := f"{found[1]}{k}") not in words)


def _with_unit(key: Scalar, value: DocumentNode | None) -> str:
    """`write m: {value: 2, unit: kg}` for `m [kg]: 2`; nothing for other names."""
    found = re.fullmatch(r"(\w+)\s*[\[(]([^\])]+)[\])]", key.label)
    if found is None or not unit_behind(f"1 {found[2]}"):
        return ""
    given = f"value: {value.value}, " if isinstance(value, Scalar) and value.value else ""
    return f"write {found[1]}: {{{given}unit: {found[2]}}}"


def _pairs(node: DocumentNode, section: str) -> str:
    """`m: 1, k: 2` for `[m = 1, k = 2]`, `{m 1, k 2}` and a list of maps; else nothing."""
    given: list[tuple[str, str]] = []
    source: list[str] = []
    if node.text.source.text.startswith("[", node.start) and (named := by_its_name(node)):
        return named if "{" in named else ""
    if isinstance(node, Mapping) and all(value.is_empty for _, value in node.entries):
        source = "，".join(key.label for key, _ in node.entries).split("，")
        given = [one for label in source for one in assigned(label)]
        given = given if all(re.match(r"[\d.]", value) for _, value in given) else []
    elif isinstance(node, Mapping) and len(node.entries) > 1 and section == "coordinates":
        numbers = [v for _, v in node.entries if isinstance(v, Scalar)]
        if len(numbers) == len(node.entries) and all(is_constant("x", v.value) for v in numbers):
            return entries_of(node)
    elif isinstance(node, Sequence) and not any(map(_has_attributes, node.items)):
        source = [item.written for item in node.items]
        source = [re.sub(r"^\[(\w+),\s*([^,\]]+)\]$", r"\1: \2", text) for text in source]
        source = [_PRODUCT.sub(lambda m: re.sub("[ *]", "", m[0]), text) for text in source]
        source = [_with_sign(text) for text in source]  # r > 0
        is_map = section == "parameters" or any("{assume" in text for text in source)
        alone = {text: [(text, "")] for text in source if is_map and text.isidentifier()}
        named_ = (text for text in source if text[:1] not in {"{", "["})
        given = [one for text in named_ for one in assigned(text) or alone.get(text, [])]
        given = [] if any(re.search(r"\(['\"]", value) for _, value in given) else given
    if len(given) != len(source) or not any(value for _, value in given):
        return ""
    return ", ".join(f"{name}: {value}" if value else name for name, value in given)


def _with_sign(text: str) -> str:
    """`r: {assume: positive}` for `r > 0`; other texts as they are."""
    meant = name_meant(text) if re.search("[<>!≥≠]", text) else ""
    return meant if "{assume" in meant else text


def _has_attributes(node: DocumentNode) -> bool:
    """Whether an item is a name with attributes on lines of their own."""
    inner = [value for _, value in node.entries] if isinstance(node, Mapping) else []
    return any(
        isinstance(each, Mapping) and each.text.source.text[each.start] != "{" for each in inner
    )


def _attributes(
    file: FileReader, node: DocumentNode | None, key: Scalar, what: str, known: tuple[str, ...]
) -> dict[str, DocumentNode]:
    if node is None or node.is_empty:
        return {}
    found = file.attributes(node, f"the {what} '{key.label}'", known)
    return {name: value for name, (_, value) in found.items()}


def _said(file: FileReader, attributes: dict[str, DocumentNode]) -> _Said:
    """The attributes that coordinates and parameters share."""
    said: _Said = {}
    if "unit" in attributes and (text := file.scalar(attributes["unit"], "'unit'")):
        said["unit"], said["unit_span"] = text.value, text.span
        wrong = wrong_unit(text, attributes.get("value"))
        file.diagnostics += [wrong] if wrong else []
    if "symbol" in attributes and (text := file.scalar(attributes["symbol"], "'symbol'")):
        said["symbol"] = text.value
        from lagcli.reader.latex_symbol import check_symbol

        check_symbol(file, text)
    prose = attributes.get("description")
    if prose is not None and (text := file.scalar(prose, "'description'")):
        said["description"] = text.value
    if "assume" in attributes:
        given = attributes["assume"]
        sign = sign_meant(getattr(given, "value", source_of(given)))
        if not isinstance(given, Scalar) and sign:
            file.error(f"'assume' must be a text, not {kind(given)}", given.span, f"write {sign}")
            return said
        text = file.scalar(given, "'assume'")
        if text is not None and text.value in ASSUMPTIONS:
            said["assume"] = cast("Assumption", text.value)
        elif text is not None:
            meant = [a for a in ASSUMPTIONS if a.startswith(text.value)][:1]
            is_below = re.search(r"\bnot?\b|nonpos|non[- _]pos|\bor\b", text.value)
            hint = "" if is_below else did_you_mean(text.value, ASSUMPTIONS)
            hint = f"write {sign}" if sign else hint
            if whole := integer_meant(text.value):
                hint = f"in place of assume write {whole}"
            elif not sign and {*text.value.casefold().split()} <= NEUTRAL:
                hint = "leave it out"
            hint = hint or f"write {''.join(meant) or 'one of ' + ', '.join(ASSUMPTIONS)}"
            file.error(f"unknown assumption '{text.value}'", text.span, hint)
    return said
