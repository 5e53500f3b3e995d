"""Values by coordinate, a state or forces, that are written in another shape than a map."""

from __future__ import annotations

import re
from collections.abc import Container
from collections.abc import Set as AbstractSet

from lagcli.reader.assignments import assigned
from lagcli.reader.foreign.vector_products import along_z, vector_product
from lagcli.reader.foreign.words import Vocabulary, momentum_meant, rate_meant
from lagcli.reader.misshapen import as_list, behind_words, is_sentence, source_of
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.regex import regex
from lagcli.reader.scope import Scope

#: A state that is 0.
_AT_REST = regex(
    r"^(?:\w+\.)?zeros\b|\b(?:rest|equilibrium|standard|default|Ruhe|repos)\b", re.IGNORECASE
)


def _pairs(given: list[tuple[str, str]], *, braces: bool = True) -> str:
    """`write {x: 1, x': 0}`."""
    inner = ", ".join(f"{name}: {value}" for name, value in given)
    return f"write {{{inner}}}" if braces else f"write {inner}"


def by_name(node: DocumentNode, scope: Scope) -> str:
    """How a list or a text of values is written as a map by coordinate."""
    if isinstance(node, Mapping):
        return ""
    names = scope.coordinates or ["x"]
    if isinstance(node, Scalar) and _AT_REST.search(node.value) and "=" not in node.value:
        number = re.search(r"\d+(?:\.\d+)?", node.value)
        begin = f"write {{{names[0]}: {number[0]}}}" if number else "leave it out"
        return f"{begin}: what is not given is 0"
    listed = (
        (_of_maps(node, names) or _of_equations(node, names)) if isinstance(node, Sequence) else []
    )
    if listed:
        return _pairs(listed)
    known = scope.kinds.keys()
    law = re.sub(r"^\s*[FQ]\w*\s*=\s*", "", node.value) if isinstance(node, Scalar) else ""
    if axes := of_vectors(law, names, known):
        alone = along_z(law, known)
        condition = f": {alone} is taken along z" if alone and names[2:] else ""
        return _pairs([*zip(names, axes, strict=True)]) + condition
    written = node.written.strip("[] \n")
    written = behind_words(written, scope.kinds)
    stated = [(coordinate_meant(name.removesuffix("''"), names), value)
              for name, value in assigned(written)]  # fmt: skip
    if stated and (stated[1:] or isinstance(node, Sequence) or stated[0][0] in names):
        return _pairs(stated, braces=len(stated) > 1 or isinstance(node, Sequence))
    values = [] if is_sentence(written, scope.kinds) else _values(node, scope)
    if not values:
        return _pairs([(name, "…") for name in (*names, *(f"{name}'" for name in names))])
    if len(values) % 2 == 0 and {*values[::2]} <= {*names}:  # [x, -c*x']
        return _pairs([*zip(values[::2], values[1::2], strict=True)])
    if len(values) == 2 * len(names):
        names += [f"{name}'" for name in names]
    values = [each.rpartition("=")[2].strip() or "…" for each in values]
    moving = [name for name in names if re.search(rf"(?<!\w){name}'", values[0])]
    if len(values) == len(moving) == 1:  # -c*x' is the force along x
        names = moving
    fits = len(values) == len(names)
    return _pairs([*zip(names, values if fits else ["…"] * len(names), strict=False)], braces=False)


def of_vectors(text: str, names: list[str], known: AbstractSet[str]) -> list[str]:
    """The Cartesian components of `q*(v × B)`, `-c*v` and `-c*|v|*v`; empty for others."""
    found = vector_product(text, (*names,), known) or _along_velocity(text, names, known)
    return found if len(found) == len(names) else []


def _along_velocity(text: str, names: list[str], known: Container[str]) -> list[str]:
    from lagcli.reader.foreign.translation import translated
    from lagcli.reader.foreign.words import UnclearText

    rest = re.sub(r"\|v\||\w+\(\s*v\s*\)", "", text)
    factors = re.findall(r"(?<![\w.])(?:\\vec\s*)?\{?v\}?(?![\w'(^*²]|\s*\*\*|\s*\^)", rest)
    if "v" in known or not names[1:] or not {*names} <= {*"xyz"} or len(factors) != 1:
        return []
    if re.search(r"[×=,]|[\w)]\s*[-+]", text):
        return []
    words = frozenset({*re.findall(r"[^\W\d]\w*", text)} - {"v", "vec", "abs", "norm"})
    found = []
    for x in names:
        one = re.sub(r"(?<![\w.|(])(?:\\vec\s*)?\{?v\}?(?![\w'|)])", f"{x}'", text)
        try:
            found.append(translated(one, Vocabulary((*names,), words)))
        except UnclearText:
            return []
    return found


def _of_maps(node: Sequence, names: list[str]) -> list[tuple[str, str]]:
    """`x` and `-c*x'` for each `{coordinate: x, expression: -c*x'}`; empty for other lists."""
    found = []
    for item in node.items:
        parts = [source_of(v) for _, v in item.entries] if isinstance(item, Mapping) else []
        along = [part for part in parts if part in names]
        others = [part for part in parts if part not in names]
        if len(parts) != 2 or len(along) != 1:
            return []
        found.append((along[0], others[0]))
    return found


def _of_equations(node: Sequence, names: list[str]) -> list[tuple[str, str]]:
    """`x` and 1 for each `x(0) = 1`, `x'` and 0 for `dx/dt(0) = 0`; empty for other lists."""
    found = []
    for item in node.items:
        written = item.value if isinstance(item, Scalar) else ""
        left, sign, right = written.partition("=")
        meant = state_meant(left.strip(), names) if sign else ""
        if not meant or not right.strip():
            return []
        found.append((meant.removesuffix("''"), right.strip()))
    return found


def _values(node: DocumentNode, scope: Scope) -> list[str]:
    """The values in a list, or in a text that is one."""
    values = node.texts
    if isinstance(node, Scalar):
        [text] = values = [behind_words(each, scope.kinds) for each in values]
        one = as_list(node.value)
        if one != f"[{node.value.strip()}]":
            values = one[1:-1].split(", ")
        elif listed := re.search(r"\(\[(.*)\]\)$", text):
            values = listed[1].split(",")
    return [part.strip() for each in values for part in each.split(";")]


def coordinate_meant(name: str, coordinates: list[str]) -> str:
    """The coordinate of a force that is called `F`, `F_x` or `Q_x`; the velocity v."""
    name = re.sub("[’′]", "'", name.replace("″", "''"))
    bare = re.sub(r"^[FQf]_?", "", name)
    if bare in coordinates:
        return bare
    if not bare and len(coordinates) == 1:
        return coordinates[0]
    if momentum := momentum_meant(name, coordinates):
        return momentum
    if bare.isdigit() and 0 < int(bare) <= len(coordinates):
        by_index = (x for x in coordinates if re.search(rf"\D{bare}$", x))
        return next(by_index, coordinates[int(bare) - 1])
    rate = rate_meant(name, Vocabulary(tuple(coordinates), frozenset()))
    return rate[0] + "'" * rate[1] if rate else name


def state_meant(word: str, coordinates: list[str]) -> str:
    """`x'` for dx/dt, v, xdot, v0 and x'(0), `x` for x0 and x(t=0); nothing for other words."""
    from lagcli.reader.foreign.translation import translated
    from lagcli.reader.foreign.words import UnclearText

    spoken = re.sub(r"\s+(?:dot|prime|punkt|point)$", "_dot", word)
    plain = re.sub(r"(?:\(\s*(?:t\s*=\s*)?0\s*\)|_?0)('*)$", r"\1", spoken)
    try:
        meant = translated(plain, Vocabulary(tuple(coordinates), frozenset()))
    except UnclearText:
        return ""
    return meant if meant.rstrip("'") in coordinates else ""
