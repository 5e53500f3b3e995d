"""The sections that say how the system moves: definitions, points, T, V, L, forces."""

from __future__ import annotations

import re

from lagcli.diagnostics import Span
from lagcli.expression import Expression
from lagcli.problem_data import Point, Problem
from lagcli.reader.bodies_meant import NO_ROTATION, of_bodies
from lagcli.reader.by_coordinate import by_name, coordinate_meant, of_vectors
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.file_reader import FileReader, Required
from lagcli.reader.foreign.words import polar_speed
from lagcli.reader.growth import growth
from lagcli.reader.habits import KEYS, colon_advice, is_angle, is_constant, key_meant
from lagcli.reader.headings import forces_without_headings, without_headings
from lagcli.reader.limits import DEGREE, EXPONENTIAL_LEVELS
from lagcli.reader.misshapen import as_flow, as_list, by_key, named_formulas, source_of
from lagcli.reader.names import depends_on_time, derivative_order
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, names_in
from lagcli.reader.regex import regex
from lagcli.reader.scope import MASS, POSITION, STATE, Definition, Growth, Kind, Role
from lagcli.reader.suggest import did_you_mean
from lagcli.reader.text import as_sum
from lagcli.record import replace

_CARTESIAN = "write [x, y], in polar coordinates [r*cos(phi), r*sin(phi)]"
#: A unit vector of polar coordinates.
_POLAR = regex(
    r"(?<!\w)(?:e_?|\\hat\s*\{?\\?|\\vec\s*\{?e\}?_\{?\\?)(?:r|rho|phi|varphi|theta|[ρφϕθ])(?!\w)\}?"
    r"|[rρφϕθ]\u0302|(?<!\w)(?:r|rho|phi|theta)_?hat(?!\w)"
)
#: `-grad(V)`, a force with a potential.
_GRADIENT = regex(
    r"\s*-\s*(?:grad|gradient|nabla|∇|\\nabla)\s*(?:\((?P<whole>.*)\)|\s+(?P<name>\w+)|(?<=∇)\w+)\s*"
)
_POINT_ATTRIBUTES = ("position", "mass", "force")
_RADII = frozenset("r rho R radius distance ρ".split())


def check_energies(file: FileReader, entries: dict[str, tuple[Scalar, DocumentNode]]) -> None:
    """The kinetic energy comes from one place: L, or H, or T, or the masses of the points."""
    given = {key: name for key, (name, _) in entries.items()}
    texts = {key: node.value for key, (_, node) in entries.items() if isinstance(node, Scalar)}
    file.scope.energies = {key: text for key, text in texts.items() if key in {"T", "V", "H"}}
    for whole, others in (("L", "TV"), ("H", "LTV")):
        both = [key for key in others if whole in given and key in given]
        if both:
            message = f"{', '.join([whole, *both[:-1]])} and {both[-1]} are given"
            hint = "give L, or H" if "L" in both else f"give {whole}, or T and V"
            at = both[0]
            if both[1:] and "L" not in both:
                at = whole
                hint = "leave out L: it is T - V" if whole == "L" else "leave out H: it is derived"
            if whole == "L" and both == ["V"] and {"L", "V"} <= {*texts}:
                full = f"{texts['L']} - ({texts['V']})"
                hint = f"L is T - V: leave out V if L has it, or else put it in, L: {full}"
            if whole == "H" and both == ["V"]:
                hint = "leave it out where H has its formula, or give T and V"
            rest = (key for key in (whole, *both) if key != at)
            related = tuple((given[key].span, f"{key} is given here") for key in rest)
            file.error(message, given[at].span, hint, related)
            if whole != "H" or both != ["V"]:  # H: p^2/(2*m) + V has other mistakes
                file.scope.refused += both  # as in L: T - V
            if at == whole:  # what is to be left out has no other mistakes
                file.scope.refused += re.findall(r"[^\W\d]\w*", texts.get(whole, ""))


def check_masses(file: FileReader, problem: Problem, span: Span) -> None:
    """Without T and L, the points give the kinetic energy, and every one needs a mass."""
    given = problem.kinetic, problem.lagrangian, problem.hamiltonian
    if any(formula is not None for formula in given) or file.scope.refused:
        return
    if not problem.points:
        usual = _usual_energy(file)
        hint = f"give T{usual}, or points with masses, or L, or H"
        file.error("there is no kinetic energy", span, hint)
    for point in problem.points:
        if point.mass is None:
            message = f"the point '{point.name}' has no mass, and there is no T"
            hint = "give its mass, or T, or L"
            orders = [derivative_order(axis, file.scope) for axis in point.position]
            if orders and max(orders) < 0:
                written = [file.scope.components[f"{point.name}.{axis}"]
                           for axis, _ in zip("xyz", point.position, strict=False)]  # fmt: skip
                axes = ", ".join(written)
                place = f"{{places: {{{point.name}: [{axes}]}}}}"
                hint = f"what does not move has no mass and stands under picture: {place}"
            file.error(message, point.span, hint)


def _usual_energy(file: FileReader) -> str:
    """`, as in T: m*x'^2/2`; nothing where the kinetic energy may have mixed terms."""
    coordinates = file.scope.coordinates
    known = {*file.scope.of_kind("parameter")}
    turning = [x for x in coordinates if is_angle(x)]
    squares = polar_speed((*coordinates,)) if coordinates else ""
    if turning and not squares and coordinates[1:]:
        return ""

    if squares:
        return f", as in T: {_mass_of(file, '')}/2*({squares})"
    if turning:
        [angle] = turning
        inertia = next((x for x in ("I", "J", "Theta") if x in known), "")
        length = next((x for x in ("l", "L", "ℓ", "R", "r", "a", "b", "d") if x in known), "")
        inertia = inertia or (f"{_mass_of(file, angle)}*{length}^2" if length else "I")
        return f", as in T: {inertia}*{angle}'^2/2"
    whole = " + ".join(f"{_mass_of(file, x)}*{x}'^2/2" for x in coordinates)
    return f", as in T: {whole}" if whole else ""


def check_momenta(file: FileReader) -> None:
    """`p_x` is the momentum of the coordinate x and cannot be declared."""
    for name, span in file.scope.spans.items():
        coordinate = file.scope.coordinate_of_momentum(name)
        if coordinate is not None:
            related = ((file.scope.spans[coordinate], "the coordinate"),)
            message = f"'{name}' is the momentum of the coordinate '{coordinate}'"
            is_coordinate = file.scope.kinds[name] == "coordinate"
            hint = "leave it out: momenta are known" if is_coordinate else "choose another name"
            file.error(message, span, hint, related)


def declare_definitions(file: FileReader, node: DocumentNode) -> list[tuple[Scalar, DocumentNode]]:
    """Enter the definitions into the scope in the order of the file."""
    declared: list[tuple[Scalar, DocumentNode]] = []
    hint = "write d: expression"
    if isinstance(node, Scalar | Sequence):
        lines = [node] if isinstance(node, Scalar) else node.items
        written = [each.value for each in lines if isinstance(each, Scalar)]
        hint = colon_advice(written[0]) if written else hint
        if len(several := named_formulas(node)) > 1:
            hint = f"write {as_flow(several)}"
    vectors = [key for key, value in node.pairs if isinstance(value, Sequence)]
    if (found := without_headings(node, ("x", "y", "z"))) and found[0] not in vectors:
        message = f"'{found[0].label}' in definitions is not a formula"
        file.error(message, found[0].span, found[1], refused="")
        return []
    entries = file.entries(node, "definitions", hint)
    for key, value in file.of_section(entries, "definitions", ()):
        if square := re.fullmatch(r"(\w+?)\s*(?:(?:\^|\*\*)\s*2|²)", key.label):
            hint = f"write {square[1]}: sqrt({source_of(value)})"
            file.error(f"'{key.label}' is not a name", key.span, hint, refused=square[1])
            continue
        if relation := _relation(file, key, value):
            hint = f"a relation of coordinates: write constraints: {{{key.label}: {relation}}}"
            file.error(f"'{key.label}' is a coordinate, not a definition", key.span, hint)
        elif file.declare(key.label, "definition", key.span):
            file.scope.definitions[key.label] = Definition(place=len(declared))
            declared.append((key, value))
    return declared


def _relation(file: FileReader, key: Scalar, value: DocumentNode) -> str:
    """`x = R*phi` for the definition R*phi of a coordinate x; nothing for others."""
    x, law = key.label, source_of(value)
    is_coordinate = file.scope.kinds.get(x) == "coordinate" and "H" not in file.sections
    is_other = isinstance(value, Scalar) and not re.search(rf"'|\b{re.escape(x)}\b", law)
    return f"{x} = {law}" if is_coordinate and is_other else ""


def read_definitions(
    file: FileReader, declared: list[tuple[Scalar, DocumentNode]]
) -> dict[str, Expression]:
    """The definitions; the scope learns which derivatives each contains."""
    definitions = {}
    for place, (key, value) in enumerate(declared):
        what = f"the definition of '{key.label}'"
        parts = value.parts
        for axis, _ in zip("xyz", parts, strict=False):  # a vector
            file.scope.components[f"{key.label}.{axis}"] = f"{key.label}_{axis}"
        mistakes = len(file.diagnostics)
        expression = file.expression(value, what, STATE, before=place)
        file.scope.formulas[key.label] = getattr(value, "value", "")
        if file.diagnostics[mistakes:] and isinstance(value, Scalar):
            _say_components(file, key.label, value, mistakes)
        definitions[key.label] = expression
        known = file.scope.definitions[key.label]
        known.order = min(derivative_order(expression, file.scope), STATE.order)
        known.time = depends_on_time(expression, file.scope)
        found, _ = growth(expression, file.scope)
        known.growth = Growth(
            min(found.exponentials, EXPONENTIAL_LEVELS), min(found.degree, DEGREE)
        )
    return definitions


def _say_components(file: FileReader, name: str, node: Scalar, mistakes: int) -> None:
    """One mistake, and components to use, for the text of a vector: `B/2*(-y, x, 0)`."""
    from lagcli.reader.foreign.vectors import components

    written = components(re.sub(r"^\s*\((.*)\)\s*$", r"<\1>", node.value), file.scope.kinds)
    if not written[1:]:
        return
    named = [(f"{name}_{axis}", each) for axis, each in zip("xyz", written, strict=False)]
    file.scope.components.update({f"{name}.{each[-1]}": each for each, _ in named})
    hint = f"a vector is written by its components: {', '.join(map(': '.join, named))}"
    del file.diagnostics[mistakes:]
    file.error(f"the definition of '{name}' must be an expression, not a vector", node.span, hint)


def read_points(file: FileReader, node: DocumentNode) -> tuple[Point, ...]:
    """The particles."""
    points = []
    listed = node.listed
    name = listed[0] if listed and listed[0].isidentifier() else "name"
    hint = f"write {name}: {{position: [x, y], mass: m}}"
    places = [each for each in node.parts if isinstance(each, Sequence)]
    if places and len(places) == len(node.parts):
        named_ = (
            f"P{k}: {{position: {source_of(each)}, mass: m}}" for k, each in enumerate(places, 1)
        )
        hint = f"write {{{', '.join(named_)}}}"
    file.scope.refused += [] if isinstance(node, Mapping) else ["points"]
    named = file.named(node, "points", _POINT_ATTRIBUTES, hint)
    entries = file.of_section(named, "points", _POINT_ATTRIBUTES)
    for place, (key, value) in enumerate(entries):
        what = f"the point '{key.label}'"
        rest = [k.label for k, v in entries[place + 1 :] if isinstance(v, Scalar) and v.is_empty]
        if isinstance(value, Scalar) and rest and key.in_flow:  # {ball: x, y}
            whole = f"[{', '.join([value.value, *rest])}]"
            if value.value[:1] == "(":  # {ball: (x, y), m}
                whole = f"{as_list(value.value)}, mass: {rest[0]}"
            hint = f"write {{position: {whole}}}"
            file.error(f"{what} must be a map, not a text", value.span, hint, refused="points")
            break
        labels = {*names_in(value)}
        by_axes = [] if "position" in labels else _by_axes(by_key(value))
        usual = ["r*cos(phi)", "r*sin(phi)"] if "polar" in labels else ["x", "y"]
        whole = f"position: [{', '.join(by_axes or usual)}]"
        if by_axes and (rest_of := _without_axes(value)):
            whole = f"{key.label}: {{{whole}, {rest_of}}}"
        required = Required("position", key.span, f"write {whole}")
        if by_axes and labels & _RADII:  # r is not the position
            file.error(f"{what} has no position", key.span, required.hint, refused="points")
            continue
        axes = value.parts
        is_bare = all(isinstance(axis, Scalar) and "=" not in axis.value for axis in axes)
        found = {}
        if axes and is_bare and file.sections <= {*KEYS} - {"T", "L", "H"}:  # [x, y]
            hint = f"write {{position: {source_of(value)}, mass: {_mass_of(file, key.label)}}}"
            file.error(f"{what} must be a map, not a list", value.span, hint)
        else:
            before = len(file.diagnostics)
            found = file.attributes(value, what, _POINT_ATTRIBUTES, required)
            file.diagnostics[before:] = [
                replace(x, hint=of_bodies(file, entries) or x.hint)
                if x.hint.startswith(NO_ROTATION) else x
                for x in file.diagnostics[before:]
            ]  # fmt: skip
        attributes = {name: attribute for name, (_, attribute) in found.items()}
        if "position" not in attributes:
            file.scope.refused.append("points")
            given = value.pairs
            items = value.parts
            axes_given = ((axis.label, at) for axis, at in given)
            for axis_, at in (*axes_given, *zip("xyz", items, strict=False)):
                if axis_ in {"x", "y", "z"} and isinstance(at, Scalar):
                    file.scope.components[f"{key.label}.{axis_}"] = at.value
            continue
        position = _position(file, attributes["position"], key.label)
        mass = force = None
        if "mass" in attributes:
            mass = file.expression(attributes["mass"], f"the mass of '{key.label}'", MASS)
        if "force" in attributes:
            force = _force(file, attributes["force"], key.label, len(position))
        points.append(
            Point(name=key.label, position=position, mass=mass, force=force, span=key.span)
        )
    return tuple(points)


def _mass_of(file: FileReader, name: str) -> str:
    """The parameter that is most probably the mass of a point: `m_A` of A, m2 of P2, else m."""
    masses = [x for x in file.scope.of_kind("parameter") if re.fullmatch(r"(?!mu)[mM]_?\w?", x)]
    own = [x for x in masses if x[1:] and re.search(rf"{x[1:].strip('_')}$", name)]
    return (*own, *(x for x in masses if not x[1:]), *masses, "m")[0]


def _by_axes(given: dict[str, str], length: int = 0) -> list[str]:
    """The Cartesian components in `{x: x, y: 0, mass: m}` and `{r: r, phi: phi, mass: m}`."""
    radii = [re.sub(r"^(.*\S\s*[-+].*)$", r"(\1)", v) for k, v in given.items() if k in _RADII]
    angles = {key: value for key, value in given.items() if is_angle(key)}
    tilt = next((key for key in angles if key in {"theta", "θ"}), "")
    if len(radii) == 1 and 1 <= len(angles) <= 1 + bool(tilt):
        sine = f"*sin({angles.pop(tilt)})" if angles.keys() > {tilt} else ""
        [turn] = angles.values()
        height = [radii[0] + sine.replace("sin", "cos")] if sine else []
        height = height or [each for key, each in given.items() if key == "z"]
        return [f"{radii[0]}{sine}*cos({turn})", f"{radii[0]}{sine}*sin({turn})", *height]
    axes = {key.casefold(): each for key, each in given.items() if key.casefold() in {*"xyz"}}
    size = length or max(("xyz".index(axis) + 1 for axis in axes), default=0)
    return [axes.get(axis, "0") for axis in "xyz"[:size]] if axes else []


def _of_polar(written: list[str], kinds: dict[str, Kind]) -> list[str]:
    """`r*cos(phi)`, `r*sin(phi)` for `r`, `phi`, a length and angles that move; or nothing."""
    first, *rest = written or [""]
    angles = [each for each in rest if is_angle(each) and kinds.get(each) == "coordinate"]
    is_length = kinds.get(first) == "parameter" or first in _RADII & kinds.keys()
    is_polar = is_length and angles and {*rest} <= {*angles, "z"}
    return _by_axes({"r": first} | {each: each for each in rest}) if is_polar else []


def _without_axes(node: DocumentNode) -> str:
    """`mass: m` for `{x: x, y: 0, m: m}`."""
    others = ((key, value) for key, value in by_key(node).items() if key not in _RADII)
    given = ((key_meant(key, _POINT_ATTRIBUTES), value) for key, value in others)
    return ", ".join(f"{meant}: {value}" for meant, value in given if meant)


def read_components(
    file: FileReader, node: DocumentNode, what: str, hint: str, length: int = 0
) -> list[DocumentNode]:
    """The components of a vector; a mistake where it is written otherwise than as a list.

    The `length` is that of the position, or 0.
    """
    from lagcli.reader.foreign.vectors import components, of_listed, with_commas

    known = file.scope.kinds
    along = _POLAR.search(" ".join(node.texts))
    if along and along[0] not in known:
        message = f"{what} has Cartesian components, not one along '{along[0]}'"
        file.error(message, node.span, _CARTESIAN)
        return []
    if isinstance(node, Scalar) and not node.is_empty:
        hint = f"write {as_list(node.value if len(node.value) <= 40 else '…')}"
        alone = re.sub(r"^\s*\w+\s*=(?!=)\s*", "", node.value)
        if written := components(alone, known, length):
            file.error(f"{what} must be a list, not a text", node.span, _listed(written))
            return []
        apart = with_commas(alone, file.scope.coordinates)
        if apart and (not length or apart.count(",") == length - 1):
            file.error(f"{what} must be a list, not a text", node.span, apart)
            return []
        if length > 1 and "," not in node.value:
            axes = ", ".join(["0"] * (length - 1) + [node.value.strip()])
            hint = "one component for each of the position's"
            hint += f", as in [{axes}]" * (formula_or_none(node.value) is not None)
    elif isinstance(node, Mapping) and all(value.is_empty for _, value in node.entries):
        parts = [key.label for key, _ in node.entries] or ["x", "y"]
        apart = "" if parts[1:] else with_commas(parts[0], file.scope.coordinates)
        hint = apart or _listed(parts)
    elif isinstance(node, Mapping) and (axes_ := _by_axes(by_key(node), length)):
        hint = _listed(axes_)
    elif isinstance(node, Sequence):
        texts = node.listed
        if len(texts) == len(node.items) and (written := of_listed(texts, known)):
            message = f"{what} is a list of components, without unit vectors"
            file.error(message, node.span, _listed(written))
            return []
        is_one = len(texts) == len(node.items) == 1 != length
        if is_one and (apart := with_commas(texts[0], file.scope.coordinates)):
            one = "; with blanks on both sides of its sign it is one" * (" -" in apart)
            file.error(f"{what} has no commas", node.span, apart + one)
            return []
    return file.items(node, what, hint)


def _listed(parts: list[str]) -> str:
    return f"write [{', '.join(parts)}]"


def _position(file: FileReader, node: DocumentNode, name: str) -> tuple[Expression, ...]:
    what = f"the position of '{name}'"
    before = len(file.diagnostics)
    items = read_components(file, node, what, _CARTESIAN)
    if not items or not all(isinstance(item, Scalar) for item in items):
        file.scope.refused.append("points")
    if isinstance(node, Sequence) and not 1 <= len(items) <= 3 and len(file.diagnostics) == before:
        message = f"{what} has {len(items)} components, it may have 1 to 3"
        file.error(message, node.span, _CARTESIAN)
    written = [item.value if isinstance(item, Scalar) else "" for item in items]
    file.scope.components |= {
        f"{name}.{x}": each for x, each in zip("xyz", written, strict=False) if each
    }
    if axes := _of_polar(written, file.scope.kinds):
        message = f"{what} has Cartesian components, not an angle"
        file.error(message, node.span, _listed(axes))
    return tuple(file.expression(item, what, POSITION) for item in items)


def _force(file: FileReader, node: DocumentNode, name: str, length: int) -> tuple[Expression, ...]:
    what = f"the force on '{name}'"
    before = len(file.diagnostics)
    axes = [file.scope.components.get(f"{name}.{axis}", "") for axis in "xyz"[:length]]
    is_cartesian = axes == file.scope.coordinates
    law = node.value if is_cartesian and isinstance(node, Scalar) else ""
    if written := of_vectors(law, axes, file.scope.kinds.keys()):
        file.error(f"{what} must be a list, not a text", node.span, _listed(written))
        return ()
    items = read_components(file, node, what, "one component for each of the position's", length)
    if isinstance(node, Sequence) and 0 < length != len(items) and len(file.diagnostics) == before:
        message = f"{what} has {len(items)} components, its position has {length}"
        file.error(message, node.span, "one component for each of the position's")
    return tuple(file.expression(item, what, STATE) for item in items)


def _is_name_of(label: str, file: FileReader) -> bool:
    """Whether a word is the name of a force, and not of a coordinate in another spelling."""
    coordinates = file.scope.coordinates
    meant = coordinate_meant(label.rstrip("'"), coordinates).rstrip("'")
    is_known = label in coordinates or meant in coordinates
    return not (is_known or did_you_mean(label, coordinates) or file.scope.refused)


def _of_friction(name: str, law: str, x: str) -> str:
    """`-mu*m*g*sign(x')` for the constant friction `-mu*m*g`; other laws as they are."""
    is_friction = re.search(r"friction|reib|frott|rozam|attrit", name.casefold())
    return f"{law}*sign({x}')" if is_friction and "'" not in law else law


def _on_points(node: DocumentNode, file: FileReader) -> str:
    """`points: {P: {position: [x, 0], force: [F, 0]}}` for `[(P, F*N.x)]`; nothing for others."""
    from lagcli.reader.foreign.vectors import components

    found = []
    for item in node.parts:
        name, _, law = re.sub(r"^[\[(](.*)[\])]$", r"\1", source_of(item)).partition(",")
        places = file.scope.components
        size = sum(f"{name}.{axis}" in places for axis in "xyz")
        force = components(law.strip(), file.scope.kinds, size) if size else []
        if len(force) != size or not force:
            return ""
        found.append(f"in {name} write force: [{', '.join(force)}]")
    return "; ".join(found)


def read_by_coordinate(
    file: FileReader, node: DocumentNode, section: str, what: str, role: Role = STATE
) -> dict[str, Expression]:
    """A map coordinate → expression."""
    found = {}
    coordinates = file.scope.coordinates
    hint = by_name(node, file.scope)
    if section == "forces" and isinstance(node, Scalar) and (of := _GRADIENT.fullmatch(node.value)):
        potential = of["whole"] or of["name"]
        hint = "leave it out: the force of V is found"
        hint += f"; write V: {potential}" if "V" not in file.sections else ""
    if section == "forces" and (on_points := _on_points(node, file)):
        inner = {each.span for each in node.parts}
        file.diagnostics[:] = [each for each in file.diagnostics if each.span not in inner]
        file.error("a force on a point stands in that point", node.span, on_points)
        return {}
    entries = list(file.entries(node, section, hint))
    if whole := forces_without_headings(node, coordinates):
        [heading, *_] = [key for key, value in entries if not isinstance(value, Scalar)]
        message = f"'{heading.label}' in {section} is not a coordinate"
        file.error(message, heading.span, whole)
        return {}
    named = [key for key, _ in entries if len(key.label) > 2 and _is_name_of(key.label, file)]
    values = {source_of(value) for _, value in entries}
    is_other = values & {*coordinates} or (named and all(is_constant("x", x) for x in values))
    named = [] if is_other else named
    if section == "forces" and len(coordinates) == 1 and named and len(entries) > 1:
        laws = (_of_friction(key.label, source_of(value), coordinates[0]) for key, value in entries)
        total = as_sum(laws)
        message = f"'{named[0].label}' in forces is not a coordinate"
        file.error(message, named[0].span, f"write {coordinates[0]}: {total}")
        return {}
    for key, value in entries:
        if file.scope.kinds.get(key.label) != "coordinate":
            along, prime, _ = coordinate_meant(key.label, coordinates).partition("'")
            hint = f"write {along}" if along in coordinates else ""
            hint = f"leave it out: {role.why}" if hint and prime and role.order == 0 else hint
            hint = hint or did_you_mean(key.label, coordinates)
            pointed = ", or as 'force' of a point" if section == "forces" else ""
            moved = [x for x in coordinates if re.search(rf"(?<!\w){x}'", source_of(value))]
            if section == "forces" and len(moved) == 1 and not hint:
                terms = [source_of(v) for k, v in entries if k.label in (moved[0], key.label)]
                hint = f"write {moved[0]}: {as_sum(terms)}"
            if f"{key.label}.x" in file.scope.components and section == "forces":
                whole = f"{key.label}: {{position: …, force: {source_of(value)}}}"
                hint = f"a force on a point stands there: {whole}"
            if section == "forces" and len(coordinates) == 1 and not hint and key in named:
                hint = f"write {coordinates[0]}" if isinstance(value, Scalar) else ""
            hint = hint or f"it is given along a coordinate: {', '.join(coordinates)}{pointed}"
            if not file.scope.refused:
                file.error(f"'{key.label}' in {section} is not a coordinate", key.span, hint)
                continue
        found[key.label] = file.expression(value, what.format(key.label), role)
    return found
