"""Functions on phase space: `observables`, `brackets`, `canonical_transformations`."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from typing import Any

from lagcli.diagnostics import Diagnostic, Span
from lagcli.expression import Expression, Name, walk
from lagcli.problem_data import BracketQuestion, CanonicalTransformation, Symmetry
from lagcli.reader.assignments import assigned
from lagcli.reader.file_reader import FileReader
from lagcli.reader.misshapen import FOUND, as_flow, by_key, named_formulas, source_of
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.regex import regex
from lagcli.reader.scope import PHASE_SPACE, name_mistake
from lagcli.record import replace

FUNCTION = PHASE_SPACE._replace(why="a function on phase space has momenta p_x, no velocities")
BRACKETED = FUNCTION._replace(observables=True)
_KINDS = {
    "F1": "coordinates and new coordinates",
    "F2": "coordinates and new momenta",
    "F3": "momenta and new coordinates",
    "F4": "momenta and new momenta",
}
#: What others call a generating function.
_GENERATING = frozenset("F G S W generating generating_function".split())
_FOUND = "leave it out: momenta, energy and charges are found"

#: `{A, B}`, also with its index and its value: `\\{A, B\\}_{PB} = C`.
_PAIR = regex(
    r"\s*(?:\\?\{|[(\[])?\s*([^,{}]+?)\s*,\s*([^,{}]+?)\s*"
    r"(?:(?:\\?\}|[)\]])(?:_\{?\w+\}?)?)?\s*(?:=.*)?"
)
#: What a bracket calls the Hamiltonian, where the file has no such name.
HAMILTONIAN = "H"


def read_observables(file: FileReader, node: DocumentNode) -> dict[str, Expression]:
    """Functions of q, p and t, each of which may use earlier ones."""
    found = {}
    words = [*map(str.strip, node.texts)]
    formulas = [each for each in words if re.search(r"[-+*/^(]|^\w+$", each)]
    product = "x*p_y - y*p_x" if {"x", "y"} <= file.scope.kinds.keys() else "x*p_x"
    named = named_formulas(node) or dict(zip("ABCDEF", formulas or [product], strict=False))
    hint = f"write {', '.join(map(': '.join, named.items()))}"
    hint = _FOUND if words and {*words} <= FOUND else hint
    for key, value in file.entries(node, "observables", hint):
        what = f"the observable '{key.label}'"
        expression = file.expression(value, what, BRACKETED)
        if not _is_momentum(file, key) and file.declare(key.label, "observable", key.span):
            found[key.label] = expression
    return found


def mend_velocities(file: FileReader, node: DocumentNode, kinetic: Expression) -> None:
    """Make the velocities in each observable one mistake, with momenta in the hint."""
    for key, value in node.pairs:
        if isinstance(value, Scalar) and (parts := _components(file, value, kinetic)):
            named = zip("xyz", parts, strict=False)
            listed = ", ".join(f"{key.label}_{axis}: {part}" for axis, part in named)
            hint = f"a vector is written by its components: {listed}"
            hint = f"write {parts[0]}" if not parts[1:] else hint
            wrong = Diagnostic(f"'{key.label}' is a product of vectors", value.span, hint)
            kept = [each for each in file.diagnostics if not _is_inside(each, value.span)]
            file.diagnostics[:] = [*kept, wrong]
            continue
        place = f" cannot stand in the observable '{key.label}'"
        found = [each for each in file.diagnostics if each.message.endswith(place)]
        if not isinstance(value, Scalar) or not found:
            continue
        from lagcli.reader.momenta_meant import with_momenta

        if whole := with_momenta(value.value, kinetic, value.text):
            mended = replace(found[0], hint=f"write {whole}: {FUNCTION.why}")
            kept = [each for each in file.diagnostics if each not in found[1:]]
            file.diagnostics[:] = [mended if each is found[0] else each for each in kept]


def _components(file: FileReader, node: Scalar, kinetic: Expression) -> list[str]:
    """The components of `m*(r × v)` on phase space; nothing for other texts."""
    from lagcli.reader.foreign.vector_products import vector_product
    from lagcli.reader.momenta_meant import with_momenta

    coordinates = (*file.scope.coordinates,)
    found = vector_product(node.value, coordinates, file.scope.kinds.keys())
    found = [with_momenta(each, kinetic, node.text) if "'" in each else each for each in found]
    return found if all(found) else []


def _is_inside(mistake: Diagnostic, span: Span) -> bool:
    return span.line <= mistake.span.line <= span.end_line and (
        mistake.span.column >= span.column or mistake.span.line > span.line
    )


def _is_momentum(file: FileReader, key: Scalar) -> bool:
    coordinate = file.scope.coordinate_of_momentum(key.label)
    if coordinate is not None:
        message = f"'{key.label}' is the momentum of the coordinate '{coordinate}'"
        file.error(message, key.span, "choose another name")
    return coordinate is not None


def read_brackets(
    file: FileReader, node: DocumentNode, symmetries: Iterable[Symmetry]
) -> tuple[BracketQuestion, ...]:
    """Pairs of functions; the charges of symmetries and H may stand in them by name."""
    found = []
    hint = "write name: [x, p_x]"
    if (pair := _pair(node)) and not isinstance(node, Mapping):
        file.error("brackets have names", node.span, f"write {{name: [{', '.join(pair)}]}}")
        return ()
    if isinstance(node, Sequence) and node.items and (pair := _pair(node.items[0])):
        hint = f"write name: [{', '.join(pair)}]"
    names = [HAMILTONIAN, *(symmetry.name for symmetry in symmetries)]
    with file.scope.also(names, "observable"):
        for key, value in file.entries(node, "brackets", hint):
            what = f"the bracket '{key.label}'"
            if (pair := _pair(value)) and not isinstance(value, Sequence):
                file.error(f"{what} is a list", value.span, f"write [{', '.join(pair)}]")
                continue
            items = file.items(value, what, hint)
            if isinstance(value, Sequence) and len(items) != 2:
                named = [source_of(item) for item in items]
                other = next(x for x in (HAMILTONIAN, "p_x") if x not in named[:1])
                pair = [named[0], *named[1:2]] if named[1:] else [*named, other]
                as_ = "write" if named[2:] == ["t"] else "a bracket has two functions, as in"
                fitting = f"{as_} [{', '.join(pair)}]" if named else hint
                plural = "s" * (len(items) != 1)
                message = f"{what} has {len(items)} function{plural}, not 2"
                file.error(message, value.span, fitting)
            read = [file.expression(item, what, BRACKETED) for item in items]
            if len(read) == 2:
                left, right = read
                found.append(BracketQuestion(name=key.label, left=left, right=right, span=key.span))
    return tuple(found)


def _pair(node: DocumentNode) -> list[str]:
    """The two functions of `[A, B]`, `{A, B}` and the text `"{A, B}"`; else nothing."""
    given: list[DocumentNode] = []
    if isinstance(node, Sequence):
        given = node.items
    elif isinstance(node, Mapping) and all(value.is_empty for _, value in node.entries):
        given = [key for key, _ in node.entries]
    elif isinstance(node, Scalar):
        within = _PAIR.fullmatch(node.value)
        return [*within.groups()] if within else []
    names = [each.value for each in given if isinstance(each, Scalar)]
    return names if len(names) == len(given) == 2 else []


def read_transformations(
    file: FileReader, node: DocumentNode
) -> tuple[CanonicalTransformation, ...]:
    """New variables in the old ones, with a generating function or without."""
    entries = list(file.entries(node, "canonical_transformations", _example(file, "name", {})))
    if entries and all(isinstance(value, Scalar) for _, value in entries):
        message = f"'{entries[0][0].label}' is a new variable, not the name of a transformation"
        names = _new_momenta([key.label for key, _ in entries])
        inner = (f"{names.get(key, key)}: {each}" for key, each in by_key(node).items())
        hint = f"write name: {{{', '.join(inner)}}}"
        if parts := dict(assigned(source_of(entries[0][1]))):  # swap: Q = p_x, p_Q = -x
            hint = f"write {entries[0][0].label}: {as_flow(parts)}"
            message = f"the transformation '{entries[0][0].label}' is a map, not a text"
        file.error(message, entries[0][0].span, hint)
        return ()
    return tuple(_transformation(file, key, value) for key, value in entries)


def _new_momenta(labels: list[str]) -> dict[str, str]:
    """`p_Q` for the `P` beside `Q`, `p_Q1` for the `P1` beside `Q1`; nothing where one is left."""
    momenta = [
        each for each in labels if re.fullmatch(r"P(_\w+|\d*)|p_\w+", each)
        and f"p_{each}" not in labels and each.removeprefix("p_") not in {*labels} - {each}
    ]  # fmt: skip
    new = [x for x in labels if x not in {*momenta, *_KINDS} and f"p_{x}" not in labels]
    new = [x for x in new if not x.startswith("p_")]
    pairs = zip(momenta, new, strict=True) if len(momenta) == len(new) else ()
    return {p: f"p_{next((x for x in new if x[1:] == p[1:]), q)}" for p, q in pairs}


def _example(file: FileReader, name: str, given: dict[str, str]) -> str:
    """`write swap: {Q: p_q, p_Q: -q}` in the names of the file; `as in` for another one."""
    old = file.scope.coordinates or ["x"]
    new = [*dict.fromkeys(each.removeprefix("p_") for each in given if each not in _KINDS)]
    if len(new) != len(old):
        new = [f"Q_{k}" for k, _ in enumerate(old, 1)] if old[1:] else ["Q"]
    pairs = zip(new, old, strict=True)
    whole = {key: each for Q, q in pairs for key, each in ((Q, f"p_{q}"), (f"p_{Q}", f"-{q}"))}
    begin = "write" if given.items() <= whole.items() else "as in"
    return f"{begin} {name}: {as_flow(whole)}"


def _transformation(file: FileReader, key: Scalar, node: DocumentNode) -> CanonicalTransformation:
    what = f"the transformation '{key.label}'"
    example = _example(file, key.label, by_key(node))
    entries = list(file.entries(node, what, example.replace(f" {key.label}: ", " ", 1)))
    if not isinstance(node, Mapping):
        return CanonicalTransformation(name=key.label, coordinates={}, momenta={}, span=key.span)
    for name, value in entries:
        if name.label in _GENERATING and f"p_{name.label}" not in by_key(node):
            used = {*re.findall(r"(?<!\w)p_(\w+)", source_of(value))}
            old = used & {*file.scope.coordinates}
            meant = f"F{1 + bool(used - old) + 2 * bool(old)}"
            file.error(f"'{name.label}' is not a new variable", name.span, f"the key is {meant}")
            name.value = meant
    names = _new_momenta([name.label for name, _ in entries])
    for name, _ in entries:
        if name.label in names:
            message = f"'{name.label}' is not the name of a new momentum"
            file.error(message, name.span, f"write {names[name.label]}")
    labels = {names.get(name.label, name.label) for name, _ in entries} - _KINDS.keys()
    coordinates: dict[str, Expression] = {}
    momenta: dict[str, Expression] = {}
    generating: list[tuple[Scalar, DocumentNode]] = []
    is_complete = True
    for name, value in entries:
        label = names.get(name.label, name.label)
        if label in _KINDS:
            generating.append((name, value))
            continue
        expression = file.expression(value, f"the new variable '{name.label}'", FUNCTION)
        rest = label.removeprefix("p_")
        if rest != label and rest in labels:
            momenta[rest] = expression
            continue
        before = len(file.diagnostics)
        _check_new(file, name, what, labels, example)
        is_complete &= len(file.diagnostics) == before
        coordinates[label] = expression
    number = len(file.scope.coordinates)
    if is_complete and len(coordinates) != number and not file.scope.refused:
        counted = f"{len(coordinates) or 'no'} new coordinate{'s' * (len(coordinates) != 1)}"
        file.error(f"{what} has {counted}, the file has {number}", key.span, example)
    given: dict[str, Any] = {}
    with file.scope.also(coordinates, "coordinate"):
        for place, (name, value) in enumerate(generating):
            if place:
                file.error(f"{what} has two generating functions", name.span, "give one")
            given = {
                "kind": name.label,
                "generating": _generating(file, name.label, value, coordinates),
            }
    return CanonicalTransformation(
        name=key.label, coordinates=coordinates, momenta=momenta, span=key.span, **given
    )


def _check_new(
    file: FileReader, name: Scalar, what: str, labels: Collection[str], example: str
) -> None:
    """A new coordinate needs a name of its own, and its momentum, with the prefix p_."""
    label, scope = name.label, file.scope
    wrong = name_mistake(label)
    taken = next((n for n in (label, f"p_{label}") if n in scope.kinds), None)
    if wrong is not None:
        file.error(wrong[0], name.span, wrong[1])
    elif label.startswith("p_") and scope.coordinate_of_momentum(label) is None:
        coordinate = label.removeprefix("p_")
        message = f"{what} has a momentum '{label}' and no coordinate '{coordinate}'"
        file.error(message, name.span, example)
    elif taken is not None or scope.coordinate_of_momentum(label) is not None:
        kind = scope.kinds.get(taken or "", "momentum")
        message = f"the new variable '{taken or label}' is a {kind} of the file already"
        file.error(message, name.span, "choose another name")
    elif f"p_{label}" not in labels:
        message = f"the momentum 'p_{label}' of '{label}' is missing in {what}"
        file.error(message, name.span, example)


def _generating(file: FileReader, kind: str, node: DocumentNode, new: Iterable[str]) -> Expression:
    """F, in the variables of its kind."""
    expression = file.expression(node, kind, FUNCTION)
    new = set(new)
    old = set(file.scope.coordinates) - new
    forbidden = {f"p_{n}" for n in old} if kind in ("F1", "F2") else set(old)
    forbidden |= {f"p_{n}" for n in new} if kind in ("F1", "F3") else new
    for part in walk(expression):
        if isinstance(part, Name) and part.name in forbidden:
            hint = f"{kind} is a function of {_KINDS[kind]}"
            file.error(f"'{part.name}' cannot stand in {kind}", part.span, hint)
    return expression
