"""Entries below a heading that the format does not have, such as `{masses: {m: 1, M: 2}}`."""

from __future__ import annotations

import re
from collections.abc import Collection

from lagcli.notation.greek import BY_NAME as GREEK
from lagcli.reader.habits import is_constant, is_unit, number_and_unit, spellings, unit_behind
from lagcli.reader.misshapen import as_flow, by_key, inner_of, source_of
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, names_in
from lagcli.reader.number_units import with_radians
from lagcli.reader.regex import regex
from lagcli.reader.sign_meant import ASSUMPTIONS, sign_meant
from lagcli.reader.text import as_sum

#: A value of Python, `float = 1.0`, and a map without its braces.
_NO_EQUATION = regex(
    r"(?:assume|unit|value|float|int|double|[Rr]eal|Integer|complex|[Nn]umber)\b|.*[:{]"
)
#: Words for velocities and for places.
RATE = regex(r"veloc|speed|rate|dot|geschw|vitesse|prędk|скорост|^v$", re.IGNORECASE)
PLACE = regex(
    r"(?:initial_?|start_?|anfangs|init_?)?(?:pos|posi[cçtz]|place|displ|angle|angul|ángul|winkel|auslenk|ort$|lage$|полож|угол)",
    re.IGNORECASE,
)
#: What a system of coordinates is called, and its coordinates.
SYSTEMS = {
    "polar": "[r, phi]",
    "cartesian": "[x, y, z]",
    "spherical": "[r, theta, phi]",
    "cylindrical": "[r, phi, z]",
    "generalized": "[q_1, q_2]",
}
_SPEED = regex("(?i:(?:(?:initial|launch)[_ ])?(?:speed|velocity)|v_?0?)")
_SLOPE = regex(
    "(?i:(?:(?:initial|launch)[_ ])?(?:angle|direction|elevation|inclination|winkel)"
    "|alpha|theta|phi|beta|α|θ|φ)_?0?(?:_?deg(?:rees)?)?"
)
#: The section that an attribute belongs to.
SECTIONS = {
    **dict.fromkeys(("value", "integer"), "parameters"),
    **dict.fromkeys(("position", "mass", "force"), "points"),
    **dict.fromkeys(("equation", "multiplier", "holds_while", "on_loss", "acts_as"), "constraints"),
    **dict.fromkeys(("gap", "restitution"), "contacts"),
    **dict.fromkeys(("where", "for", "in_terms_of", "always", "reaches"), "find"),
}
#: The attributes of whatever has a name.
SAID = ("unit", "symbol", "description", "assume")


def is_said(word: str, text: str) -> bool:
    """Whether a word and the text behind it are an attribute and its value: assume positive."""
    if word == "assume":
        return bool(sign_meant(text))
    return word in SECTIONS or (word == "unit" and is_unit(text))


def section_meant(
    value: DocumentNode, attributes: tuple[str, ...], coordinates: Collection[str]
) -> str:
    """The section that an entry belongs to by its attributes, where these are not its own."""
    if isinstance(value, Scalar):
        is_relation = re.search(r"[^<>]=", value.value) and not _NO_EQUATION.match(value.value)
        return "constraints" if is_relation else ""
    labels = [key.label for key, _ in value.entries] if isinstance(value, Mapping) else []
    if labels and {*labels} <= {*coordinates, "t", "gauge"}:
        return "symmetries"
    sections = {SECTIONS.get(each, "") for each in labels if each not in attributes}
    if "find" in sections:  # whose attribute value parameters have, too
        return "find"
    return sections.pop() if len(sections) == 1 else ""


def system_meant(word: str) -> str:
    """`[r, phi]` for `polar` and `plane polar`; nothing for other words."""
    found = re.fullmatch(r"(?:\w+[- ])*(\w+?)(?:[- ]coordinates)?", word.strip().casefold())
    return SYSTEMS.get(found[1], "") if found else ""


def without_headings(node: DocumentNode, attributes: tuple[str, ...]) -> tuple[Scalar, str] | None:
    """The first heading of names in a map, and the names without headings; None without one.

    A heading has a list of names, or a map of other keys than the `attributes` of a name, which
    are those of all names where they stand beside it.  It may be what is assumed of its names.
    """
    entries = node.pairs
    headings = [key for key, value in entries if _is_heading(key, value, attributes)]
    if not headings:
        return None
    parts: list[str] = []
    is_shared = {*attributes} - {*"xyz"}
    shared = {key.label: source_of(value) for key, value in entries if key.label in is_shared}
    for key, value in entries:
        assumed = "".join({*ASSUMPTIONS} & {*key.label.casefold().split("_")})
        said = ({"assume": assumed} if assumed else {}) | shared
        inner = dict(value.entries) if isinstance(value, Mapping) else dict.fromkeys(_names(value))
        if key not in headings:
            inner, said = {key: value} if key.label not in shared else {}, {}
        for name, each in inner.items():
            label = name if isinstance(name, str) else name.label
            given = inner_of(each, "value") | said
            alone = "" if each is None else source_of(each)
            parts.append(f"{label}: {as_flow(given) if said else alone}".removesuffix(": "))
    whole = ", ".join(parts)
    brackets = "{%s}" if ": " in whole else "[%s]"
    return headings[0], f"write {brackets % whole}"


def _is_heading(key: Scalar, node: DocumentNode, attributes: tuple[str, ...]) -> bool:
    if isinstance(node, Mapping):
        labels = {key.label.casefold() for key, _ in node.entries}
        inner = [value for _, value in node.entries]
        are_names = bool(labels) and all(map(str.isidentifier, labels))
        foreign = {"type", "kind", "axis", *(each for each in spellings("bounds") if each[2:])}
        of_others = labels & {*attributes, *SECTIONS, *foreign}
        return are_names and not of_others and not _mean(labels, inner)
    is_assumed, names = key.label in ASSUMPTIONS, _names(node)
    if isinstance(node, Scalar):
        return is_assumed and not is_constant("x", node.value) and bool(names)
    are_units = all(unit_behind(f"1 {name}") for name in names)
    return _are_names(node) and (is_assumed or not are_units)


def _names(node: DocumentNode) -> list[str]:
    """The names in a list, or in a text of names alone."""
    if isinstance(node, Scalar):
        return (
            [*map(str.strip, node.value.split(","))] if re.fullmatch(r"[\w, ]+", node.value) else []
        )
    return names_in(node)


def _mean(labels: set[str], inner: list[DocumentNode]) -> bool:
    """Whether keys may be attributes in other words, not names: units, min, default."""
    words = [each for each in labels if len(each) > 2 and each.isalpha() and each.islower()]
    words = [each for each in words if each not in GREEK]
    words += [each for each in labels if labels <= spellings("bounds").keys()]
    return bool(words) and not any(isinstance(each, Mapping) or _are_names(each) for each in inner)


def _are_names(node: DocumentNode) -> bool:
    items = node.parts
    return bool(items) and all(isinstance(x, Scalar) and x.value.isidentifier() for x in items)


def state_without_headings(node: DocumentNode, coordinates: list[str]) -> str:
    """`{x: 1, x': 0}` for `{positions: {x: 1}, velocities: {x: 0}}`, `{x: {value: 1, rate: 0}}`."""
    parts = []
    for heading, value in node.pairs:
        rate = "'" if RATE.search(heading.label) else ""
        listed = re.fullmatch(r"\((.*,.*)\)", value.value) if isinstance(value, Scalar) else None
        given = listed[1].split(",") if listed else [*map(source_of, value.parts)]
        given = re.split(r"\s*;\s*|\s+", given[0]) if len(given) == 1 else given  # [1; 0]
        known = [*coordinates, *(f"{x}'" for x in coordinates if len(given) > len(coordinates))]
        if heading.label.rstrip("'") in coordinates and isinstance(value, Sequence):
            return ""
        if given and len(given) == len(known):
            pairs = zip(known, given, strict=True)
            parts += [f"{name}{rate}: {each.strip()}" for name, each in pairs]
        elif isinstance(value, Scalar):
            parts.append(f"{heading.label}: {source_of(value)}")
        elif number := _number_of(value):
            parts.append(f"{heading.label}: {number}")
        elif isinstance(value, Mapping):
            for key, each in value.entries:
                name, prime = key.label.rstrip("'"), rate or "'" * key.label.endswith("'")
                if name not in coordinates:
                    name, prime = heading.label, "'" if RATE.search(key.label) else ""
                parts.append(f"{name}{prime}: {source_of(each)}")
    names = {part.partition(":")[0].rstrip("'") for part in parts}
    return f"write {{{', '.join(parts)}}}" if names and names <= {*coordinates} else ""


def state_of_launch(node: DocumentNode, coordinates: list[str]) -> str:
    """`{x': v*cos(a), y': v*sin(a)}` for `{speed: v, angle: a}` in a plane; nothing for others."""
    entries = node.pairs
    given = {key.label: _number_of(value) or source_of(value) for key, value in entries}
    speed, angle = ([each for each in given if word.fullmatch(each)] for word in (_SPEED, _SLOPE))
    axes = [x for x in coordinates if x in {"x", "y", "z"}]
    if {*speed, *angle} & {*coordinates} or (len(speed), len(angle), len(axes)) != (1, 1, 2):
        return ""
    size, slope = given.pop(speed[0]), given.pop(angle[0])
    size = number_and_unit(size)[0] if number_and_unit(size)[1] else size
    size = f"({size})" if re.search(r"\S\s*[-+]", size) else size
    slope = with_radians(slope, most=1.6)
    given |= {f"{axes[0]}'": f"{size}*cos({slope})", f"{axes[1]}'": f"{size}*sin({slope})"}
    return f"write {{{', '.join(map('{0[0]}: {0[1]}'.format, given.items()))}}}"


def _number_of(node: DocumentNode) -> str:
    """`20*pi/180` for `{value: 20, unit: deg}`; nothing for others."""
    given = by_key(node)
    if "value" not in given or not {*given} <= {"value", "unit", "units"}:
        return ""
    unit = given.get("unit", given.get("units", ""))
    return given["value"] + "*pi/180" * (unit in {"deg", "°", "degree", "degrees"})


def forces_without_headings(node: DocumentNode, coordinates: Collection[str]) -> str:
    """`{y: -m*g - c*y'}` for `{weight: {y: -m*g}, drag: {y: -c*y'}}`; nothing for others."""
    entries = node.pairs
    known = {*coordinates}
    sums: dict[str, list[str]] = {}
    for heading, value in entries:
        terms = [(key.label, each) for key, each in value.pairs]
        if isinstance(value, Sequence) and len(value.items) == len(known):
            terms = [*zip(coordinates, value.items, strict=True)]
        elif heading.label in known:
            terms = [(heading.label, value)] if isinstance(value, Scalar) else []
        if not terms:
            return ""
        for x, each in terms:
            sums.setdefault(x, []).append(getattr(each, "value", "") or source_of(each))
    if not {*sums} <= known or all(heading.label in known for heading, _ in entries):
        return ""
    whole = [f"{x}: {as_sum(terms)}" for x, terms in sums.items()]
    return f"write {{{', '.join(whole)}}}"
