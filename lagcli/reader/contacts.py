"""The section `contacts`: what a body may strike, rest on and leave in a numerical run."""

from __future__ import annotations

import re
from typing import NamedTuple

from lagcli.expression import ZERO, Equation, Expression
from lagcli.problem_data import Contact
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.file_reader import FileReader, Required
from lagcli.reader.habits import comparisons_in, is_angle, key_meant, name_meant
from lagcli.reader.misshapen import as_flow, by_key, is_sentence, source_of, texts_of
from lagcli.reader.names import derivative_order
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar
from lagcli.reader.regex import regex
from lagcli.reader.scope import POSITION, VALUES, Kind, name_mistake

RESTITUTION = "restitution"
_ATTRIBUTES = ("gap", RESTITUTION, "multiplier")
#: The coefficients of kinds of impact.
_COEFFICIENTS = {
    **dict.fromkeys(["elastic", "yes", "true"], 1),
    **dict.fromkeys(["inelastic", "plastic", "none", "no", "false", "sticks"], 0),
}
#: `y .ge. 0` and `y >= 0`.
_INEQUALITY = regex(r"[<>≤≥]|\.(?i:[gl][et])\.")
#: `|x| <= l` and `abs(x) <= l`.
_AROUND = regex(r"(?:\|([^<>|]+)\||abs\(([^<>]+)\))\s*<=\s*([^<>]+)")
_HINT = "write floor: {gap: y >= 0, restitution: 0.8}"


class Declared(NamedTuple):
    """A contact or constraint whose multiplier has its name, and what is not read yet."""

    key: Scalar
    multiplier: str
    attributes: dict[str, DocumentNode]


def declared(
    file: FileReader, key: Scalar, value: DocumentNode, kind: Kind, known: tuple[str, ...]
) -> Declared | None:
    """Enter the multiplier into the scope; None where the name is not valid.

    The value is a map with the `known` attributes, or the first of them alone.
    """
    what = "contact" if known == _ATTRIBUTES else "constraint"
    if side := _with_its_side(file, key, value, known):
        message = f"the name '{key.label}' of a {what} is not its left side"
        file.error(message, key.span, side, refused=f"lambda_{key.label}")
        return None
    if name_mistake(f"a{key.label}") is not None or not key.label:  # lambda_<name> must be a name
        message = f"'{key.label}' is not a valid name for a {what}"
        if re.search("[=<>≤≥]", key.label):
            rule = f"write name: {key.label}"
            file.error(message, key.span, rule)
            return None
        rule = "a name has letters, digits and underscores"
        if isinstance(value, Scalar) and re.search(r"[-+*/^]", key.label):
            rule = f"write name: {key.label} = {value.value}"
        elif better := name_meant(key.label, one=True):
            rule = f"write {better}"
        file.error(message, key.span, rule)
        return None
    if isinstance(value, Scalar) and (law := _law_of_words(file, key.label, value.value, what)):
        span = key.span if value.is_empty else value.span
        law = f"{key.label}: {law}" if value.is_empty and what == "constraint" else law
        file.error(f"the {what} '{key.label}' has no formula", span, f"write {law}")
        return None
    multiplier, place = f"lambda_{key.label}", key.span
    attributes = {known[0]: value}
    if isinstance(value, Mapping):
        what = f"the {what} '{key.label}'"
        required = Required(known[0], key.span, _hint(file, key, value, known))
        found = file.attributes(value, what, known, required)
        attributes = {name: attribute for name, (_, attribute) in found.items()}
        if not attributes:
            file.scope.refused.append("")
        if "multiplier" in attributes:
            text = file.scalar(attributes["multiplier"], "'multiplier'")
            label = "" if text is None else text.label
            law = source_of(attributes.get("equation", value))
            sides = re.fullmatch("([^=<>{]+?)(?: *= *([^=<>{]+))?", law)
            # right = left has the other sign
            if sides and label[:1] == "-" and label[1:].isidentifier():
                meant = {"equation": f"{sides[2] or 0} = {sides[1]}", "multiplier": label[1:]}
                given = by_key(value) | meant
                hint = f"write {as_flow(given)}"
                file.error(f"the multiplier '{label}' is not a name", value.span, hint)
                file.scope.refused.append(label[1:])
                return Declared(key, multiplier, attributes)
            if text is not None:
                multiplier, place = text.label, text.span
    file.declare(multiplier, kind, place)
    return Declared(key, multiplier, attributes)


def _with_its_side(
    file: FileReader, key: Scalar, value: DocumentNode, known: tuple[str, ...]
) -> str:
    """`write y: y = -x*tan(a)` for `y: -x*tan(a)`, which would mean -x*tan(a) = 0; else nothing."""
    x, sign = key.label.removesuffix("'"), ">=" if known == _ATTRIBUTES else "="
    given = by_key(value)
    law = given.get(known[0]) or (value.value if isinstance(value, Scalar) else "")
    words = {*re.findall(r"[^\W\d]\w*", law)}
    is_relation = x in words or re.search("[=<>≤≥]", law)
    if file.scope.kinds.get(x) != "coordinate" or is_relation or formula_or_none(law) is None:
        return ""
    is_known = words & {*file.scope.kinds} or not words
    whole = f"{x}{chr(39) * (chr(39) in key.label + law)} {sign} {law}"  # x' = R*theta'
    inner = ", ".join(map(": ".join, (given | {known[0]: whole}).items()))
    return f"write {x}: {f'{{{inner}}}' if given else whole}" if is_known else ""


def _law_of_words(file: FileReader, name: str, text: str, what: str) -> str:
    """`floor: {gap: y >= 0}` for `floor: true` and `ball: floor`, `x' = R*theta'` for rolling.

    Nothing where the file has no such coordinates, or the text is a formula.
    """
    is_word = text.replace("_", "").isalpha() and len(text) > 3 and text not in file.scope.kinds
    is_true = text.casefold() in {"", "true", "yes", "on"}
    coordinates = file.scope.coordinates
    if what == "contact" and (is_true or is_word):
        is_place = re.fullmatch("(?i:floor|ground|table|boden|sol|wall|ceiling)", name)
        place = name if is_true or is_place else text
        wall = re.search("wall|wand|side", place, re.IGNORECASE)
        along = [x for x in (("x",) if wall else ("y", "z", "h")) if x in coordinates]
        along = along or (coordinates if len(coordinates) == 1 else [])
        above = re.search("ceil|top|roof|lid", place, re.IGNORECASE)
        heights = [x for x in "hHLlabd" if x in file.scope.of_kind("parameter")]
        edge = f"<= {(*heights, '…')[0]}" if above else ">= 0"
        return f"{place}: {{gap: {along[0]} {edge}}}" if along else ""
    rolls = re.search(r"roll|slip|rutsch|gliss", f"{name} {text}", re.IGNORECASE)
    angles = [x for x in coordinates if is_angle(x)]
    lengths = [x for x in coordinates if x not in angles]
    radii = [x for x in ("R", "r", "a", "b", "radius") if x in file.scope.of_kind("parameter")]
    words = is_true or re.fullmatch(r"[^\W\d_]{2,}(?:[ _-][^\W\d_]{2,})*", text)
    if not rolls or not words or (len(angles), len(lengths), len(radii)) != (1, 1, 1):
        return ""
    return f"{lengths[0]}' = {radii[0]}*{angles[0]}'"


def _hint(file: FileReader, key: Scalar, value: Mapping, known: tuple[str, ...]) -> str:
    """`write floor: {gap: y >= 0, restitution: e}` for `floor: {y: 0, restitution: e}`.

    The equation of a constraint may have another key: `write hoop: {equation: r = R}`.
    """
    coordinates = {*file.scope.coordinates}
    sign = ">=" if known == _ATTRIBUTES else "="
    given = by_key(value)
    laws = [f"{k} {sign} {v}" for k, v in given.items() if k.rstrip("'") in coordinates]
    if sign == "=":
        formulas = (v for k, v in given.items() if k not in known)
        formulas = (v for v in formulas if re.search("^[^<>]*[-+*/^=][^<>]*$", v))
        laws += [v if "=" in v else f"{v} = 0" for v in formulas]
    elif gaps := [v for k, v in given.items() if k not in known and _INEQUALITY.search(v)]:
        inner = {k: v for k, v in given.items() if k in known}
        return f"write {contacts_for(key.label, gaps, inner)}"
    if not laws:
        return _HINT if sign == ">=" else f"write {key.label}: {{equation: left = right}}"
    rest = (f", {k}: {v}" for k, v in given.items() if k in known)
    return f"write {key.label}: {{{known[0]}: {laws[0]}{''.join(rest)}}}"


def declare_contacts(file: FileReader, node: DocumentNode, constraints: set[str]) -> list[Declared]:
    """Enter the multipliers into the scope; a constraint's name is taken."""
    contacts = []
    gaps = [each for each in texts_of(node) if _INEQUALITY.search(each)]
    listed = f"write {{{contacts_for('c' if gaps[1:] else 'floor', gaps, {})}}}" if gaps else _HINT
    for key, value in file.named(node, "contacts", _ATTRIBUTES, listed):
        if key.label in constraints:
            file.error(f"'{key.label}' is a constraint already", key.span)
        elif one := declared(file, key, value, "contact force", _ATTRIBUTES):
            contacts.append(one)
    return contacts


def read_contacts(file: FileReader, given: list[Declared]) -> tuple[Contact, ...]:
    """The contacts, the larger side of each gap on the left."""
    contacts = []
    for one in given:
        if "gap" not in one.attributes:
            continue
        what = f"the contact '{one.key.label}'"
        gap = _gap(file, one, what)
        restitution = None
        if RESTITUTION in one.attributes:
            restitution = read_restitution(file, one.attributes[RESTITUTION], what)
        contacts.append(
            Contact(
                name=one.key.label,
                equation=gap,
                multiplier=one.multiplier,
                restitution=restitution,
                span=one.key.span,
            )
        )
    return tuple(contacts)


def contacts_for(name: str, gaps: list[str], attributes: dict[str, str]) -> str:
    """`lower: {gap: x >= 0, restitution: e}, upper: …` for two sides, also those of `|x| <= l`."""
    plain = (re.sub("[<≤]=?", "<=", re.sub("[>≥]=?", ">=", each)) for each in gaps)
    sides = [
        side for each in plain for side in _AROUND.sub(r"\1\2 >= -\3\n\1\2 <= \3", each).split("\n")
    ]
    parts = [re.split(r"\s*([<>]=)\s*", side.strip()) for side in sides]
    names = [f"{name}_{place}" for place, _ in enumerate(parts, 1)] if parts[1:] else [name]
    if [each[1:2] for each in parts] == [[">="], ["<="]] and parts[0][0] == parts[1][0]:
        names = ["lower", "upper"]
    rest = "".join(f", {key}: {each}" for key, each in attributes.items()
                   if key != "multiplier" or not parts[1:])  # fmt: skip
    wholes = (f"{{gap: {' '.join(each)}{rest}}}" if rest else " ".join(each) for each in parts)
    return ", ".join(map("{}: {}".format, names, wholes))


def _gap(file: FileReader, one: Declared, what: str) -> Equation:
    """`y >= 0`, `y <= h`, or an expression that is not negative."""
    before, node = len(file.diagnostics), one.attributes["gap"]
    parts = comparisons_in(node.value) if isinstance(node, Scalar) else []
    if parts[1:] and all(map(_INEQUALITY.search, parts)):
        rest = {name: source_of(x) for name, x in one.attributes.items() if name != "gap"}
        hint = f"write {contacts_for(one.key.label, parts, rest)}"
        file.error("two statements in one", one.key.span, hint)
        gap = Equation(ZERO, ZERO, span=node.span)
    elif isinstance(node, Scalar) and _INEQUALITY.search(node.value):
        found = file.comparison(node, what, POSITION)
        left, right = (found.left, found.right) if found is not None else (ZERO, ZERO)
        if found is not None and found.comparison[0] == "<":
            left, right = right, left
        gap = Equation(left, right, span=node.span)
    elif isinstance(node, Scalar) and "=" in node.value:
        hint = f"write {re.sub('!?=+', '>=', node.value.strip())}"
        if is_sentence(node.value.partition("=")[0], file.scope.kinds):
            hint = "write {gap: y >= 0, restitution: 0.8}"
        file.error(f"{what} is an inequality", node.span, hint)
        return Equation(ZERO, ZERO, span=node.span)
    else:
        gap = Equation(file.expression(node, what, POSITION), ZERO, span=node.span)
    if len(file.diagnostics) == before and not file.scope.refused:
        orders = [derivative_order(side, file.scope) for side in (gap.left, gap.right)]
        if max(orders) < 0:
            hint = "as in floor: y >= 0"
            if key_meant(what.split("'")[1], ("restitution",)) and isinstance(node, Scalar):
                hint = f"it stands with its gap: floor: {{gap: y >= 0, restitution: {node.value}}}"
            file.error(f"{what} contains no coordinate", node.span, hint)
    return gap


def read_restitution(file: FileReader, node: DocumentNode, what: str) -> Expression:
    """Newton's coefficient: a number or a formula of parameters."""
    word = node.value.strip() if isinstance(node, Scalar) else ""
    kind = re.sub(
        r"^(?:perfectly|fully|totally|completely)[ _-]|[ _-](?:impact|collision)$", "", word
    )
    if kind in _COEFFICIENTS and word not in file.scope.kinds:
        message = f"the restitution of {what} is a number from 0 to 1"
        file.error(message, node.span, f"write {_COEFFICIENTS[kind]}")
        return ZERO
    return file.expression(node, f"the restitution of {what}", VALUES)
