"""The section `symmetries`: what each candidate changes, per unit of its parameter."""

from __future__ import annotations

import re

from lagcli.expression import Expression
from lagcli.problem_data import Symmetry
from lagcli.reader.expressions import formula_or_none, signed_terms
from lagcli.reader.file_reader import FileReader
from lagcli.reader.habits import is_angle, name_meant
from lagcli.reader.misshapen import as_flow, as_list, by_key, source_of, texts_of
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar
from lagcli.reader.regex import regex
from lagcli.reader.scope import STATE
from lagcli.reader.small_changes import is_discrete, moved, small_change
from lagcli.reader.suggest import did_you_mean

_REFLECTION = regex(r"(?:mirror|parity|reflection|inversion|spiegelung)", re.IGNORECASE)
_CONTINUOUS = "leave it out: conserved quantities belong to continuous symmetries"
_CHANGE = "write coordinate: change, as in {x: -y, y: x}"
#: `d/dx`, `∂/∂x`, `∂_x` and `d_x`.
_PARTIAL = regex(r"(?:(?<!\w)d(?:\s*/\s*d\s*|_)|∂(?:\s*/\s*∂\s*|_?)|\\partial\s*_?)([^\W\d]\w*)")
_WORDS = frozenset("yes no true false True False none None null auto".split())


def read_symmetries(file: FileReader, node: DocumentNode) -> tuple[Symmetry, ...]:
    """The candidate symmetries."""
    texts = texts_of(node)
    if texts and all(_is_discrete(file, each) for each in texts):
        file.error("a symmetry has a parameter", node.span, _CONTINUOUS)
        return ()
    entries: list[tuple[Scalar, DocumentNode]] = []
    for key, value in file.entries(node, "symmetries", _listed(file, texts)):
        if key.in_flow and value.is_empty and moved(key.label) and entries:
            name, before = entries[-1]  # {rotation: x -> x - eps*y, y -> y + eps*x}
            said = f"{source_of(before)}, {key.label}"
            value = Scalar(key.text, before.start, key.end, said, "", True)
            entries[-1] = (name, value)
        elif key.label == "gauge" and isinstance(value, Scalar) and entries:
            name, before = entries[-1]
            parts = by_key(before) | {key.label: source_of(value)}
            hint = f"leave it out, and write {name.label}: {as_flow(parts)}"
            file.error("the gauge stands inside of its symmetry", key.span, hint)
        else:
            entries.append((key, value))
    return tuple(_symmetry(file, key, value) for key, value in entries)


def _symmetry(file: FileReader, key: Scalar, value: DocumentNode) -> Symmetry:
    what = f"the symmetry '{key.label}'"
    coordinates = file.scope.coordinates
    before = len(file.diagnostics)
    usual = _usual_change(key.label, coordinates) or _shift(_alike(coordinates))
    changes: dict[str, Expression] = {}
    for name, change in _entries(file, key, value, usual):
        if name.label == "gauge" and isinstance(change, Scalar) and change.value in _WORDS:
            file.error("'gauge' is a formula", change.span, "leave it out: it is found")
        elif name.label in {*coordinates, "t", "gauge"}:
            changes[name.label] = file.expression(change, what, STATE)
        elif not file.scope.refused:  # else it may be one of those that could not be declared
            hint = _name_meant(key.label, name.label, coordinates)
            if isinstance(change, Mapping):
                hint = f"write {key.label}: {source_of(change)}"
            else:
                file.expression(change, what, STATE)
            span = key.span if hint.startswith(f"write {key.label}: ") else name.span
            file.error(f"'{name.label}' in {what} is not a coordinate", span, hint)
    time, gauge = changes.pop("t", None), changes.pop("gauge", None)
    is_said = len(file.diagnostics) > before or file.scope.refused
    if gauge is not None and time is None and not changes and not is_said:
        message = f"{what} changes neither a coordinate nor t"
        file.error(message, key.span, f"write {key.label}: {usual}")
    return Symmetry(name=key.label, changes=changes, time=time, gauge=gauge, span=key.span)


def _entries(
    file: FileReader, key: Scalar, value: DocumentNode, usual: str
) -> list[tuple[Scalar, DocumentNode]]:
    """The changes by name; none and a mistake where the value is a transformation or no map.

    The `usual` ones are proposed where it names none.
    """
    what = f"the symmetry '{key.label}'"
    coordinates = file.scope.coordinates
    is_map = isinstance(value, Mapping) and not texts_of(value)
    said = "" if is_map else ", ".join(texts_of(value))
    said = key.label if value.is_empty and moved(key.label) else said
    if getattr(value, "broken", False) and not moved(said):
        return []  # reported already
    if said and (_REFLECTION.match(key.label) or _is_discrete(file, said)):
        file.error(f"{what} has no parameter", value.span, _CONTINUOUS)
        return []
    if isinstance(value, Mapping) and is_map:
        if not value.entries:
            file.error(f"{what} changes nothing", value.span, f"write {usual}")
        if small := _changes_meant(file, value):
            hint = f"write {small}: the change per unit of the parameter"
            file.error(f"{what} contains its parameter", value.span, hint)
            return []
        return [*file.entries(value, what)]
    changed = [name for name in re.findall(r"\w+", said) if name in {*coordinates, "t"}]
    rates = any(f"{x}'" in said for x in coordinates) and not re.search("[=>→,]", said)
    is_charge = rates and re.search(rf"(?<!\w)(?:{'|'.join(coordinates)})(?![\w'])", said)
    if is_charge and not _usual_change(key.label, coordinates):  # x*y' - y*x'
        place = f"observables: {{{key.label}: {said}}}"
        hint = f"a formula of velocities stands under observables: write {place}"
        file.error(f"{what} must be a map, not a formula", value.span, hint)
        return []
    if changed and "time" not in key.label and not is_charge:
        is_formula = re.search(r"[*/^∂]", said) or (changed[1:] and re.search("[-+]", said))
        usual = "" if is_formula and not rates else _shift(changed)
    items = [*map(source_of, value.parts)]
    if not all(isinstance(each, Scalar) for each in value.parts):  # [[0, -1], [1, 0]]
        usual = _usual_change(key.label, coordinates)
    elif len(items) == len(coordinates) and not {*items} <= {*coordinates}:  # [-y, x]
        usual = f"{{{', '.join(map('{}: {}'.format, coordinates, items))}}}"
    meant = _changes_meant(file, said) or _generated(file, said) or usual
    hint = f"write {'shift: ' * (said == key.label)}{meant}"
    hint = hint if meant else _CHANGE
    if isinstance(value, Mapping) or said == key.label:
        span = key.span if said == key.label else value.span
        file.error(f"{what} must be a map, not a transformation", span, hint)
        return []
    return [*file.entries(value, what, hint)]


def _shift(names: list[str], change: str = "1") -> str:
    return as_flow(dict.fromkeys(names or ["x"], change))


def _alike(coordinates: list[str]) -> list[str]:
    """The coordinates with the letters of the first, which a translation changes: x1 and x2."""
    letters = [re.sub(r"(?<=.)(?:_.*|\d+)$", "", x) for x in coordinates]
    return [x for x, each in zip(coordinates, letters, strict=True) if each == letters[0]]


def _generated(file: FileReader, text: str) -> str:
    """`{x: -y, y: x}` for the generator `x*d/dy - y*d/dx`; nothing for other texts."""
    known = file.scope.kinds
    names = {x for x in (*file.scope.coordinates, "t") if f"d_{x}" not in known}
    changes: dict[str, str] = {}
    marked = _PARTIAL.sub(r"(partial_\1)", re.sub(r"(?<=[\w)])\s+(?=\(?[d∂\\])", "*", text))
    for is_minus, term in signed_terms(marked):
        found = re.fullmatch(r"(?:(.*)\*)?\(*partial_(\w+)\)*", term)
        factor, x = (found[1] or "1", found[2]) if found else ("", "")
        if x not in names or "partial_" in factor or formula_or_none(factor) is None:
            return ""
        sign = " - " if is_minus else " + "
        changes[x] = (changes[x] + sign if x in changes else "-" * is_minus) + factor.strip()
    return as_flow({x: changes[x] for x in sorted(changes)}) if changes else ""


def _listed(file: FileReader, texts: list[str]) -> str:
    """How a list of coordinates, of words or of transformations is written by names."""
    coordinates = file.scope.coordinates
    whole = ", ".join(texts)
    named = [each for each in re.findall(r"\w+", whole) if each in {*coordinates, "t"}]
    if named and as_list(whole) == f"[{', '.join(named)}]":
        shifts = [f"{x if named[1:] else 'shift'}: {_shift([x])}" for x in named]
        return f"write {{{', '.join(shifts)}}}"
    found: dict[str, str] = {}
    for text in [whole] if _changes_meant(file, whole) else texts:
        if change := _changes_meant(file, text) or _generated(file, text):  # phi -> phi + const
            found[f"shift_{len(found) + 1}" if found else "shift"] = change
        elif change := _usual_change(text, coordinates):
            found[name_meant(text, one=True) or text] = change
    if not found and re.search(r"[*/^∂]", whole) and "'" not in whole:
        return "write name: {coordinate: change}, as in rotation: {x: -y, y: x}"
    found = found or {"shift": _shift(_alike(coordinates))}
    return f"write {{{', '.join(map('{0[0]}: {0[1]}'.format, found.items()))}}}"


def _usual_change(word: str, coordinates: list[str]) -> str:
    """What a rotation, a shift in time or a boost changes; nothing for other words."""
    if "time" in word or word in {"t", "energy"}:
        return "{t: 1}"
    if "boost" in word.casefold() or "galil" in word.casefold():
        return _shift(_alike(coordinates), "t")
    if re.search("trans|shift|homogen", word.casefold()):
        return _shift(_alike(coordinates))
    if "rot" not in word.casefold() or not coordinates:
        return ""
    angles = _alike([name for name in reversed(coordinates) if is_angle(name)])
    if len(coordinates) == 1 or (angles and not {"x", "y"} <= {*coordinates}):
        return _shift(angles[::-1] or coordinates)
    return "{{{0}: -{1}, {1}: {0}}}".format(*coordinates)


def _name_meant(symmetry: str, name: str, coordinates: list[str]) -> str:
    """What is written for a name of a symmetry that is not a coordinate."""
    known = [*coordinates, "t", "gauge"]
    bare = re.sub(r"^(?:\\?[dD]elta[_ ]?|d|δ|Δ) ?(?=.)", "", name)
    if bare in {*coordinates, "t"}:
        return f"write {bare}, whose change it is"
    if hint := did_you_mean(name, known):
        return hint
    if is_angle(name) and (usual := _usual_change(symmetry, coordinates)):
        return f"write {symmetry}: {usual}"
    return f"known are {', '.join(coordinates)}, t and gauge"


def _finite(given: Mapping | str) -> dict[str, str]:
    """What each coordinate becomes, or its change with the parameter as a factor."""
    if isinstance(given, str):
        return moved(given)
    parts = ((key.label, value) for key, value in given.entries)
    return {x: value.value for x, value in parts if isinstance(value, Scalar)}


def _changes_meant(file: FileReader, given: Mapping | str) -> str:
    """`{x: -y, y: x}` for a finite rotation and for `x -> x - eps*y, y -> y + eps*x`."""
    names = file.scope.coordinates
    declared = isinstance(given, str)
    return small_change(_finite(given), names, {*file.scope.kinds}, declared=declared)


def _is_discrete(file: FileReader, text: str) -> bool:
    """Whether a transformation is a reflection, or another one without a parameter."""
    names = file.scope.coordinates
    is_word = _REFLECTION.match(text) is not None
    return is_word or is_discrete(moved(text), names, {*file.scope.kinds})
