"""The sections `initial`, `find` and `simulation`."""

from __future__ import annotations

import re

from lagcli.expression import ZERO, Expression, Name, name_nodes
from lagcli.problem_data import (
    METHODS,
    Lasting,
    Question,
    Reaching,
    Rewrite,
    SimulationDefaults,
    Where,
)
from lagcli.reader.by_coordinate import by_name, state_meant
from lagcli.reader.expressions import formula_or_none
from lagcli.reader.file_reader import FileReader
from lagcli.reader.foreign.words import momentum_meant
from lagcli.reader.habits import advised, is_angle, key_meant, meanings, name_meant
from lagcli.reader.headings import PLACE, RATE, state_of_launch, state_without_headings
from lagcli.reader.misshapen import (
    ALREADY_FOUND,
    FOUND,
    WITHOUT_HYPHENS,
    as_map,
    by_key,
    difference,
    entries_of,
    is_found,
    range_end,
    source_of,
)
from lagcli.reader.names import derivative_order
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.number_units import run_mistake, unit_mistake, with_radians
from lagcli.reader.regex import regex
from lagcli.reader.scope import INITIAL, NUMBERS, POSITION, QUESTION, Role, Scope
from lagcli.reader.suggest import closest, did_you_mean

_QUESTION_ATTRIBUTES = ("where", "for", "value", "in_terms_of", "always", "reaches")
#: The two keys of a question: what it is about, and what is wanted.
_FORMS = {"where": "for", "always": "for", "reaches": "for", "value": "in_terms_of"}
_NO_ACCELERATION = "leave it out: a state has x and x'"
_SIMULATION_ATTRIBUTES = ("until", "accuracy", "method")

_RELATION = regex("[=<>≤≥]")
#: The words and letters of an unknown, xmax as x and max.
_PART = regex(r"[^\W_\d]+?(?=m(?:ax|in)(?![a-z]))|[^\W_\d]+'*|\d+")
_EXTREME = regex(
    "(?i:max|min|(?:max|min)im(?:um|al)|turn(?:ing)?|points?|top|end|final|f|eq|of|the|value|0"
    "|largest|smallest|greatest|highest|lowest|height|distance|amplitude)"
)
#: An event for an end: `x = 0`, `y < 0`.
_ENDS = regex(r"([^<>=≤≥]+)(?:[<>=]=?|≤|≥)([^<>=≤≥]+)")

#: What a question can be answered for.
_UNKNOWN = Role(
    order=1, why="a question is about a coordinate, a velocity, a parameter or the time"
)
_VARIABLE = Role(order=1, momenta=True, why="velocities are removed, accelerations never needed")


def read_initial(file: FileReader, node: DocumentNode) -> dict[Name, Expression]:
    """The state at t = 0, by coordinate and by velocity."""
    initial: dict[Name, Expression] = {}
    coordinates = file.scope.coordinates
    hint = by_name(node, file.scope)
    for value in re.findall(r": ([\d.]+ ?[^\W\d][^,{}]*)", hint if hint[:6] == "write " else ""):
        of_unit = unit_mistake(value)
        if of_unit and " with " in of_unit[1]:  # x(0) = 10 cm
            braces = re.sub(r"^write ([^{}]*)$", r"write {\1}", hint)
            hint = f"{braces}; {of_unit[1]}"
    entries = list(file.entries(node, "initial", hint))
    headings = [
        key for key, value in entries
        if not isinstance(value, Scalar)
        or (value.value.startswith("(") and key.label.rstrip("'") not in coordinates)
    ]  # fmt: skip
    if headings and (whole := state_without_headings(node, coordinates)):
        message = f"'{headings[0].label}' in initial has no number"
        file.error(message, headings[0].span, whole)
        return {}
    if whole := state_of_launch(node, coordinates):
        file.error("a state has velocities, no speed with an angle", node.span, whole)
        return {}
    for key, value in entries:
        what = f"the initial '{key.label}'"
        name = _state_name(file, key, value, coordinates, by_key(node))
        if name is None:
            continue
        before, written = len(file.diagnostics), source_of(value)
        expression = file.expression(value, what, INITIAL)
        if file.diagnostics[before:] and (said := advised("given", f"{name}: {written}")):
            del file.diagnostics[before:]
            file.error(f"{what} is a number", value.span, said)
        if name in initial:
            file.error(f"the initial '{name}' is given twice", key.span)
        initial[name] = expression
    return initial


def _state_name(
    file: FileReader,
    key: Scalar,
    value: DocumentNode,
    coordinates: list[str],
    state: dict[str, str],
) -> Name | None:
    letters = key.label.rstrip("'’′″")
    if letters not in coordinates and file.scope.refused:
        return None
    if letters not in coordinates:
        meant = state_meant(key.label, coordinates)
        if meant.endswith("''"):
            file.error(f"{meant} in initial is an acceleration", key.span, _NO_ACCELERATION)
            return None
        hint = f"write {meant}" if meant else did_you_mean(letters, coordinates)
        if meant.endswith("'") and not re.search(r"[0\s]", key.label):
            hint = f"the velocity of {meant[:-1]} is {meant}"
        rates = ", ".join(f"{x}'" for x in coordinates)
        hint = hint or f"known are {', '.join(coordinates)} and velocities: {rates}"
        is_rate = RATE.search(key.label) is not None
        if not meant and (is_rate or PLACE.match(key.label)):
            turns = re.search(r"ang|áng|wink|угл|угол", key.label, re.IGNORECASE) is not None
            along = [x for x in coordinates if is_angle(x) == turns] or coordinates
            number = source_of(value) if len(along) == 1 else "…"
            turned = with_radians(number, most=6.3)
            number = turned if is_angle(along[0]) and not is_rate else number
            if not turns or along[0] not in {*"xyzrs"}:
                hint = f"write {along[0]}{chr(39) * is_rate}: {number or '…'}"
        if re.search(r"[=→>]", key.label):
            hint = f"write {name_meant(key.label)}"
        if momentum := momentum_meant(letters, coordinates):
            from lagcli.reader.momenta_meant import rate_of

            law, number = rate_of(momentum, file.text), source_of(value)
            rule = "it is ∂H/∂p_{0}" if "H" in file.sections else "its momentum is ∂L/∂{0}'"
            rate = _put_in(law, {**state, f"p_{momentum}": number}) if number != "0" else "0"
            is_known = not {*coordinates} & {*re.findall(r"\w+", rate)} and formula_or_none(rate)
            given = f"write {momentum}': {rate}" if is_known else f"give {momentum}' = {law}"
            hint = "a state has velocities, not momenta: "
            hint += given if law else f"give {momentum}': {rule.format(momentum)}"
        if part := key_meant(key.label, _SIMULATION_ATTRIBUTES):
            inner = f"{part}: {source_of(value)}"
            hint = f"an end of the run stands under simulation: write simulation: {{{inner}}}"
        said = advised("state", key.label).replace("VELOCITY", f"{coordinates[0]}'")
        hint = said or hint
        if (kind := file.scope.kinds.get(letters)) == "definition":
            hint = "leave it out: it follows from its definition"
        elif kind == "parameter":
            entry = f"{letters}: {source_of(value)}"
            hint = f"constants stand under parameters: write parameters: {{{entry}}}"
        file.error(f"'{key.label}' in initial is not a coordinate", key.span, hint)
        return None
    primes = sum(2 if prime == "″" else 1 for prime in key.label[len(letters) :])
    if primes > 1:
        file.error(f"{key.label} in initial is an acceleration", key.span, _NO_ACCELERATION)
        return None
    return Name(letters, primes)


def read_find(file: FileReader, node: DocumentNode) -> tuple[Question, ...]:
    """The questions."""
    questions: list[Question] = []
    unknown = next(iter(file.scope.free), "x")
    hint = f"write {{name: {{where: {unknown}' = 0, for: {unknown}}}}}"
    moving = file.scope.coordinates
    texts = [each for each in (node.parts or [node]) if isinstance(each, Scalar)]
    words = [each.value for each in texts]
    if words and all(is_found(word, moving) for word in words):
        hint = ALREADY_FOUND
    elif words and not any("=" in word for word in words):
        also = ALREADY_FOUND.replace("out: ", "out: equations, ").replace("w ", "w equations,")
        hint = f"{also}; or {hint}" if "initial" in file.sections else also
    elif words:
        names = [f"q{place}" for place, _ in enumerate(texts, 1)] if texts[1:] else ["name"]
        wholes = (as_map(each, _QUESTION_ATTRIBUTES, file.scope.free) for each in texts)
        pairs = zip(names, wholes, strict=True)
        hint = f"write {{{', '.join(f'{x}: {y}' for x, y in pairs)}}}".replace(": write {", ": {")
    entries = (node.parts or [node])[0].pairs
    if entries and isinstance(node, Sequence):
        hint = WITHOUT_HYPHENS
    if _is_one(entries):
        own = [key.label for key, _ in entries if key.label not in _QUESTION_ATTRIBUTES]
        meant = _meant(entries, file.scope)
        whole = f"{own[0] if len(own) == 1 else 'name'}: {_braced(meant)}"
        hint = f"write {{{whole}}}"
        if isinstance(node, Mapping):
            message = "a question has a name, and its keys stand in braces"
            file.error(message, node.span, f"write {whole}")
            return ()
    readers = {"where": _where, "always": _lasting, "reaches": _reaching, "value": _rewrite}
    for key, value in file.entries(node, "find", hint):
        what = f"the question '{key.label}'"
        entries = value.pairs
        given = [part.label for part, _ in entries]
        forms = [form for form in _FORMS.items() if {*form} == {*given}]
        if {source_of(part) for _, part in entries} & (FOUND - file.scope.kinds.keys()):
            file.error(f"{what} has an answer already", key.span, ALREADY_FOUND)
            continue
        if given and not forms and not any(map(str.isdigit, given)):  # 9,81
            meant = _meant(entries, file.scope)
            names = [f"'{each}'" for each in given if each not in _QUESTION_ATTRIBUTES]
            wrong = [f"{what} has no '{each}'" for each in meant if each not in given]
            wrong += [f"{what} has other keys than {' and '.join(meant)}"]
            unknown = f"unknown key{'s' * bool(names[1:])} {', '.join(names)} in {what}"
            whole = f"write {key.label}: {_braced(meant)}"
            file.error(unknown if names else wrong[0], key.span, whole)
            continue
        found = file.attributes(value, what, _QUESTION_ATTRIBUTES)
        if not given and isinstance(value, Mapping):
            file.error(f"{what} is empty", key.span, hint)
        for about, wanted in forms if found.keys() >= {*given} else ():
            questions += readers[about](file, key, found[about][1], found[wanted][1])
    return tuple(questions)


def _is_one(entries: list[tuple[Scalar, DocumentNode]]) -> bool:
    """Whether entries are the parts of one question, not questions by their names."""
    given = {key.label: source_of(each) for key, each in entries if not isinstance(each, Mapping)}
    is_pair = len(given) == 2 == 1 + sum(map(bool, map(_RELATION.search, given.values())))
    return len(given) == len(entries) and (is_pair or any(map(given.get, _QUESTION_ATTRIBUTES)))


def _braced(question: dict[str, str]) -> str:
    """A question in one line; a text with commas in quotes."""
    parts = (
        f"{key}: " + re.sub(r"^(?![\[\"]).*,.*$", r'"\g<0>"', x) for key, x in question.items()
    )
    return f"{{{', '.join(parts)}}}"


def _meant(entries: list[tuple[Scalar, DocumentNode]], scope: Scope) -> dict[str, str]:
    """`where: N = 0` and `for: theta` for a question with other keys, by what stands there.

    A relation is what it is about, and a name beside it what is wanted; without a relation it is a
    formula in other terms.  What is not given is an example.
    """
    parts: list[tuple[str, str]] = []
    for key, value in entries:
        label, written = key.label, source_of(value)
        if isinstance(value, Mapping) and len(value.entries) == 1:  # at: {x: 3}
            written = entries_of(value).replace(": ", " = ", 1)
        written = re.sub(r"^(['\"])(.*)\1$", r"\2", written)
        if label in _QUESTION_ATTRIBUTES and not written:
            continue
        is_name = label not in _QUESTION_ATTRIBUTES and label.rstrip("'") in scope.kinds
        if _RELATION.search(label) or not written or (is_name and _RELATION.search(written)):
            texts = re.split(r"\s(?:where|when|if|at|for)\s", f"{label} where {written}")
            parts += [("", each.strip()) for each in texts if each.strip()]  # N = 0: theta
        else:
            parts.append(("where", f"{label} = {written}") if is_name else (label, written))
    laws = [x for x in parts if _RELATION.search(x[1])]
    if not any(key_meant(label, ("in_terms_of",)) for label, _ in parts):
        laws += [x for x in parts if _FORMS.get(x[0]) == "for"]
    label, law = laws[0] if laws else ("", "")
    free = [*scope.free, "x"]
    unknown = next((x for x in free if x in re.findall(r"\w+", law)), free[0])
    rest = [x for x in parts if x not in laws[:1]] or [("for", unknown)]
    rest.sort(key=lambda x: x[0] != "for")
    words = re.findall(r"[^\W\d]\w*'?", " ".join(text for _, text in rest))
    kinds = {name: scope.kinds.get(name.rstrip("'")) for name in words}
    name = next((x for x, kind in kinds.items() if kind in {"coordinate", "parameter"}), "")
    if not laws and [text for _, text in rest] == [name] and _rank(rest[0]) > 1:  # solve: theta
        return {"where": f"{name if kinds[name] == 'coordinate' else unknown}' = 0", "for": name}
    if not laws or (any(kinds.values()) and not name):
        formula = min(rest, key=_rank)
        formula = ("", f"{unknown}'") if _rank(formula) > 2 else formula
        others = [text.strip("[]{} ") for _, text in rest if text != formula[1]]
        terms = ", ".join(text for text in others if text and not text.isdigit()) or unknown
        return {"value": formula[1], "in_terms_of": f"[{terms}]"}
    about = closest(label, ("always", "reaches"), 0.7)
    is_bound = re.search("[<>≤≥]", law) and kinds.get(name) == "parameter"
    about = about or ("always" if is_bound else "where")
    if about == "where":
        law = re.sub(r"\s*(?:[<>]=?|[≤≥]|==?)\s*", " = ", law)
    elif kinds.get(name) != "parameter":
        name = next(scope.of_kind("parameter"), "m")
    return {about: law, "for": name or next((x for key, x in rest if key == "for"), unknown)}


def _rank(part: tuple[str, str]) -> int:
    """0 for the key `value`, 1 for other formulas, 2 for names, 3 for the terms of a formula."""
    label, text = part
    meant = key_meant(label, ("value", "in_terms_of"))
    if meant or label == "for" or text[:1] == "[":
        return 0 if meant == "value" else 3
    return 2 if text.rstrip("'").isidentifier() else 1


def _unknown(file: FileReader, node: DocumentNode) -> Name | None:
    """The name behind `for`; a mistake with the x of `x_max`, `max(x)` and `the largest x`."""
    before = len(file.diagnostics)
    name = file.name(node, "'for'", _UNKNOWN)
    words = _PART.findall(node.value) if isinstance(node, Scalar) else []
    named = [each for each in words if each.rstrip("'") in file.scope.coordinates]
    others = [each for each in words if each not in named]
    meant = named or (file.scope.free if others else [])
    if name is None and len(meant) == 1 and all(map(_EXTREME.fullmatch, others)):
        del file.diagnostics[before:]
        message = f"'{source_of(node)}' is not a name of the file in 'for'"
        file.error(message, node.span, f"write {meant[0]}")
    return name


def _where(
    file: FileReader, key: Scalar, where: DocumentNode, unknown: DocumentNode
) -> list[Question]:
    equation = file.equation(where, f"the question '{key.label}'", QUESTION)
    if isinstance(unknown, Scalar) and unknown.value.strip().endswith("''"):
        hint = "leave the question out: accelerations are found"
        message = f"the acceleration {unknown.value.strip()} cannot stand in 'for'"
        file.error(message, unknown.span, hint)
        return []
    name = _unknown(file, unknown)
    if name is None:
        return []
    is_free = name.name == "t" or file.scope.kinds.get(name.name) in {"coordinate", "parameter"}
    if not is_free and not file.scope.refused:
        known = ", ".join(file.scope.coordinates)
        message = f"'{name}' is not a coordinate, a velocity, a parameter or the time"
        file.error(message, name.span, f"coordinates are {known}")
    return [Where(name=key.label, equation=equation, unknown=name, span=key.span)]


def _lasting(
    file: FileReader, key: Scalar, condition: DocumentNode, unknown: DocumentNode
) -> list[Question]:
    inequality = file.comparison(condition, f"the question '{key.label}'", QUESTION)
    name = _parameter(file, unknown)
    if name is None or inequality is None:
        return []
    return [Lasting(name=key.label, condition=inequality, unknown=name, span=key.span)]


def _reaching(
    file: FileReader, key: Scalar, place: DocumentNode, unknown: DocumentNode
) -> list[Question]:
    what = f"the question '{key.label}'"
    angles = [x for x in file.scope.free if is_angle(x)]
    along = (angles or file.scope.free or ["x"])[0]
    example = f"as in reaches: {along} = {'pi' if angles else '1'}"
    words = place.value if isinstance(place, Scalar) else ""
    if re.fullmatch(r"[\w ]+", words) and not {*words.split()} & {"is", "equals"}:
        file.error("a place is an equation of a coordinate", place.span, example)
        return []
    before = len(file.diagnostics)
    equation = file.equation(place, what, POSITION)
    name = _parameter(file, unknown)
    if name is None or len(file.diagnostics) > before:
        return []
    left = equation.left
    if not isinstance(left, Name) or file.scope.kinds.get(left.name) != "coordinate":
        file.error("'reaches' is about a coordinate alone", place.span, example)
        return []
    if derivative_order(equation.right, file.scope) >= 0:
        file.error("the place that is reached has no coordinate", place.span, example)
        return []
    return [
        Reaching(name=key.label, coordinate=left, value=equation.right, unknown=name, span=key.span)
    ]


def _parameter(file: FileReader, node: DocumentNode) -> Name | None:
    name = _unknown(file, node)
    if name is not None and file.scope.kinds.get(name.name) != "parameter":
        message = f"'{name}' is not a parameter"
        file.error(message, node.span, "a condition for all times is solved for a parameter")
        return None
    return name


def _rewrite(
    file: FileReader, key: Scalar, value: DocumentNode, terms: DocumentNode
) -> list[Question]:
    expression = file.expression(value, f"the question '{key.label}'", QUESTION)
    names = [file.name(item, "an item of 'in_terms_of'", _VARIABLE)
             for item in file.items(terms, "'in_terms_of'", "write [x]")]  # fmt: skip
    known = tuple(name for name in names if name is not None)
    return [Rewrite(name=key.label, value=expression, in_terms_of=known, span=key.span)]


def read_simulation(file: FileReader, node: DocumentNode) -> SimulationDefaults:
    """The defaults of the numerical run."""
    found = file.attributes(node, "simulation", _SIMULATION_ATTRIBUTES)
    until, accuracy = (_number(file, found[key][1], f"'{key}'") if key in found else None
                       for key in ("until", "accuracy"))  # fmt: skip
    method = None
    if "method" in found:
        node = found["method"][1]
        meant = meanings("methods").get(getattr(node, "value", "").strip().casefold(), "")
        method = file.word(node, "'method'", METHODS, meant)
    return SimulationDefaults(until=until, accuracy=accuracy, method=method)


def _number(file: FileReader, node: DocumentNode, what: str) -> Expression:
    wrong = _number_meant(node.value, what) if isinstance(node, Scalar) else None
    whole = _put_in(_put_in(source_of(node), file.scope.formulas), file.scope.formulas)
    names = {each.name for each in name_nodes(formula_or_none(whole) or Name("?"))}
    if wrong is None and whole != source_of(node) and names <= {"pi"}:  # 2*pi*sqrt(m/k)
        wrong = f"{what} is a number", f"write {whole}"
    if wrong is None:
        return file.expression(node, what, NUMBERS)
    file.error(wrong[0], node.span, wrong[1])
    return ZERO


def _put_in(text: str, values: dict[str, str]) -> str:
    """The text with values in the place of names."""

    def value_of(found: re.Match[str]) -> str:
        value = values.get(found[0], found[0])
        return value if found[0] == text or re.fullmatch(r"[\w.]+", value) else f"({value})"

    return re.sub(r"(?<![\w.])[^\W\d]\w*", value_of, text)


def _number_meant(text: str, what: str) -> tuple[str, str] | None:
    """What is wrong with the text of an end or an accuracy, and what to write; None for numbers."""
    word = text.strip()
    if what == "'until'" and (end := range_end(text)):
        return "'until' is one time, no range", f"a motion begins at t = 0: write {end}"
    if what == "'until'" and (ends := _ENDS.fullmatch(text)):
        stop = f'lagcli simulate FILE --stop-when "{difference(text)}" ends there'
        only = ends[1].strip() in {"t", "time"}
        return "'until' is a time", f"write {ends[2].strip() if only else f'a time; {stop}'}"
    if re.fullmatch(r"(?i:[-+.]*(?:inf|infinity|oo|∞|forever|unendlich|infini))", word):
        return f"{what} is a number", "there is no infinity: write 10"
    if re.fullmatch(r"[^\W\d]{3,}(?:\s+[^\W\d]+)+", word):
        usual = "1e-9" if "accuracy" in what else "10"
        return f"{what} is a number", f"write it in digits, as in {usual}"
    return run_mistake(text, what)
