"""Bodies that turn, given as points with a moment of inertia: their kinetic energy written out."""

from __future__ import annotations

import re

from lagcli.reader.file_reader import FileReader
from lagcli.reader.habits import is_angle, letters, spellings
from lagcli.reader.misshapen import source_of
from lagcli.reader.nodes import DocumentNode, Scalar

#: What is said of a moment of inertia.
NO_ROTATION = "a point does not turn"


def of_bodies(file: FileReader, points: list[tuple[Scalar, DocumentNode]]) -> str:
    """`write T: m*(x_A'^2 + y_A'^2)/2 + J*phi'^2/2` for points with inertia, each of one angle."""
    coordinates = file.scope.coordinates
    defined: dict[str, str] = {}
    terms, turning = [], []
    for key, value in points:
        parts = {k.label: v for k, v in value.pairs}
        axes = [source_of(each) for each in getattr(parts.get("position"), "items", ())]
        words = [{*re.findall(r"\w+", each)} for each in axes]
        angles = [x for x in coordinates if is_angle(x) or re.search(rf"[ns]\({x}\)", f"{axes}")]
        own = [x for x in angles if x in set().union(*words)] or angles
        squares = []
        for axis, written, names in zip("xyz", axes, words, strict=False):
            if {file.scope.kinds.get(x) for x in names} & {"coordinate", "definition"}:
                name = written if written in coordinates else f"{axis}_{key.label}"
                defined |= {name: written} if name != written else {}
                squares.append(f"{name}'^2")
        if "mass" in parts and squares:
            mass, square = source_of(parts["mass"]), " + ".join(squares)
            mass = f"({mass})" if re.search("[-+]", mass) else mass
            squared = f"({square})" if squares[1:] else square
            terms.append((mass, "", f"{mass}*{squared}/2"))
        inertia = [source_of(v) for k, v in parts.items() if _turns(k)]
        turning += [(each, f"{own[0]}'", f"{each}*{own[0]}'^2/2") for each in inertia[: len(own)]]
        if (inertia and len(own) != 1) or {*defined} & file.scope.kinds.keys():
            return ""
    given = file.scope.energies.get("T", "")
    missing = [term for factor, rate, term in (*terms, *turning)
               if not given or (rate not in given if re.search(r"\W", factor)
                                else not re.search(rf"(?<!\w){factor}(?!\w)", given))]  # fmt: skip
    if not missing:
        return "leave it out: T has it"
    energy = " + ".join([*([given] if given else []), *missing])
    used = {name: axis for name, axis in defined.items() if f"{name}'" in energy}
    formulas = ", ".join(f"{name}: {axis}" for name, axis in used.items())
    if not formulas:
        return f"leave it out, and write T: {energy}"
    where = f"definitions: {{{formulas}}}"
    where = f"in definitions {formulas}" if "definitions" in file.sections else where
    return f"leave it out, write T: {energy}, and on a line of its own {where}"


def _turns(key: str) -> bool:
    """Whether a key of a point is a word for its moment of inertia."""
    return spellings("advice", "point").get(letters(key), "").startswith(NO_ROTATION)
