"""Weight and springs under keys of their own, which are terms of V."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lagcli.reader.habits import is_angle, is_constant, number_and_unit
from lagcli.reader.misshapen import by_key, source_of
from lagcli.reader.nodes import DocumentNode, Mapping
from lagcli.reader.regex import regex
from lagcli.reader.text import as_sum

GRAVITY = frozenset(
    "gravity gravitation weight gravitational_acceleration gravitational_field gravity_vector "
    "gravity_direction acceleration_of_gravity g_vec g_vector".split()
)
_SPRING = regex(
    r"(?:linear_|torsion(?:al)?_)?(?:springs?|stiffness(?:es)?|elastic(?:ity)?)"
    r"(?:_?(?:constants?|stiffness|rate|coefficients?|force|energy|k))?"
    r"|restoring_force|feder(?:konstante|steifigkeit)?|steifigkeit|raideur|ressort|muelle|molla",
    re.IGNORECASE,
)
_ENERGY = regex(r"[^']*\^\s*2\s*/\s*2|(?:0?\.5|1/2|\(1/2\))\s*\*[^']*\^\s*2")
_SUM = regex(r"\S\s*[-+]")
_COEFFICIENT = r"[\d.]+|[^\W\d]\w{0,2}(?:_\w+)?"


def potential_meant(
    word: str, value: DocumentNode, around: Mapping, coordinates: Sequence[str]
) -> str:
    """`it has a potential energy: write V: …`; nothing where it is not clear what is meant."""
    given = {key.label: node for key, node in around.entries}
    potential = source_of(given["V"]) if "V" in given else ""
    remark = ""
    if _SPRING.fullmatch(word.replace(" ", "_")):
        number, unit = number_and_unit(source_of(value))
        is_free = not re.search(r"(?<!\w)k(?!\w)", around.text.source.text)
        if unit and is_free and len(coordinates) == 1 and not potential:
            whole = f"V: k*{coordinates[0]}^2/2, with k: {{value: {number}, unit: {unit}}}"
            return f"it has a potential energy: write {whole} under parameters"
        terms = _of_springs(value, coordinates)
        named = {*re.findall(r"[^\W\d]\w*", " ".join(terms))} - {*coordinates}
        if potential and named <= {*re.findall(r"\w+", potential)}:
            return f"leave it out: {', '.join(sorted(named))} stands in V" if named else ""
        if not terms and not is_constant(word, source_of(value)):
            return "the energy of a spring stands in V, as in k*(x - l_0)^2/2"
    elif word.casefold() in GRAVITY and not {"L", "H"} & {*given}:
        formulas = potential + " " + (source_of(given["forces"]) if "forces" in given else "")
        if re.search(r"(?<!\w)(?:g|gravity)(?!\w)", formulas):
            return ""
        terms, number = _of_weight(value, given.get("points"), coordinates)
        declared = source_of(given["parameters"]) if "parameters" in given else ""
        is_declared = re.search(r"(?<!\w)g(?=\s*(?:[:,\]=]|$))", declared, re.MULTILINE)
        remark = f", with g: {number} under parameters" if number and not is_declared else ""
        if not terms and coordinates and is_angle(coordinates[0]):
            return f"it has a potential energy, as in V: -m*g*l*cos({coordinates[0]})"
    else:
        return ""
    whole = as_sum(filter(None, (potential, *terms)))
    return f"it has a potential energy: write V: {whole}{remark}" if terms else ""


def _of_springs(value: DocumentNode, coordinates: Sequence[str]) -> list[str]:
    """`k*x^2/2` for the k of the only coordinate, and for each of `{x: k}`; nothing for others."""
    given = [*by_key(value).items()]
    only = coordinates[0] if len(coordinates) == 1 else ""
    terms = []
    for x, law in given or [(only, source_of(value))]:
        found = re.fullmatch(rf"-?\s*({_COEFFICIENT})(?:\s*\*?\s*{re.escape(x)})?", law)
        if not given and _ENERGY.fullmatch(law):
            terms.append(law)
        elif x not in coordinates or found is None or found[1] in coordinates:
            return []
        else:
            terms.append(f"{found[1]}*{x}^2/2")
    return terms


def _of_weight(
    value: DocumentNode, points: DocumentNode | None, coordinates: Sequence[str]
) -> tuple[list[str], str]:
    """The terms of V, `m*g*y` for each body, and the number that g is.

    The field is a vector, whose component is negative along an axis that points upwards, or a
    size, which is downwards.
    """
    field, written = _components(value), source_of(value)
    numbers = re.findall(r"(?<![\w.])\d+(?:\.\d+)?", " ".join(field.values()) or written)
    size = written.lstrip("-") if re.fullmatch(r"-?g\w{0,3}", written) else "g"
    terms = []
    for mass, axes in _bodies(points, coordinates):
        last = list(axes)[-1]
        for axis, component in (field or {last: f"-{size}"}).items():
            height = axes.get(axis, axes[last] if axis == "z" or len(axes) == 1 else "0")
            is_sum = _SUM.search(component) is not None
            sign = "" if component.startswith("-") and not is_sum else "-"
            size, unit = number_and_unit(component if is_sum else component.lstrip("-+ "))
            size = "g" if len(field) == 1 and (unit or re.fullmatch(r"[\d.]+", size)) else size
            if height.startswith("-") and not _SUM.search(height):
                sign, height = "-" * (not sign), height.removeprefix("-")
            factors = (f"({x})" if _SUM.search(x) else x for x in (mass, size, height))
            terms += [sign + "*".join(factors)] if height not in {"0", "0.0"} else []
    return terms, numbers[0] if numbers and any("*g*" in term for term in terms) else ""


def _components(value: DocumentNode) -> dict[str, str]:
    """`{y: -g}` for `[0, -g]`, `(0, -g, 0)` and `{y: -g}`; empty for a size."""
    written = source_of(value)
    listed = re.fullmatch(r"[\[(<](.*,.*)[\])>]", written)
    pairs = dict(zip("xyz", listed[1].split(","), strict=False)) if listed else by_key(value)
    field = {axis: each.strip() for axis, each in pairs.items() if axis in {"x", "y", "z"}}
    return {axis: each for axis, each in field.items() if not re.fullmatch(r"[-+]?0?\.?0*", each)}


def _bodies(
    points: DocumentNode | None, coordinates: Sequence[str]
) -> list[tuple[str, dict[str, str]]]:
    """The masses of the points, with their components by axis; of m itself without points."""
    found = []
    for _, point in points.pairs if points else ():
        parts = {key.label: node for key, node in point.pairs}
        axes = [source_of(each) for each in getattr(parts.get("position"), "items", ())]
        if "mass" in parts and axes:
            found.append((source_of(parts["mass"]), dict(zip("xyz", axes, strict=False))))
    own = {x: x for x in ("x", "y", "z") if x in coordinates}
    other = next(iter(coordinates), "y")
    is_height = not (is_angle(other) or other in {"r", "rho", "ρ"})
    return found or [("m", own or {"y": other})] * bool(own or is_height)
