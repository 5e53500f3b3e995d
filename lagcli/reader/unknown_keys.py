"""A key that a section does not have: what was meant, and what to write instead."""

from __future__ import annotations

import re
from typing import NamedTuple, get_args

from lagcli.problem_data import ForceKind
from lagcli.reader.by_coordinate import coordinate_meant, state_meant
from lagcli.reader.equations_meant import energies_of
from lagcli.reader.foreign.words import momentum_meant
from lagcli.reader.friction_meant import friction_meant
from lagcli.reader.habits import (
    DERIVED,
    KEYS,
    MAPS,
    advised,
    is_constant,
    key_meant,
    key_of_stem,
    letters,
    meanings,
    name_meant,
    number_and_unit,
    spellings,
)
from lagcli.reader.headings import SAID, SECTIONS
from lagcli.reader.misshapen import (
    ALREADY_FOUND,
    FOUND,
    as_flow,
    by_key,
    difference,
    entries_of,
    inner_of,
    key_by_shape,
    range_end,
    source_of,
    texts_of,
    values_in,
    values_of,
)
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence, lines_of, names_in
from lagcli.reader.potential_meant import GRAVITY, potential_meant
from lagcli.reader.regex import regex
from lagcli.reader.scope import Scope
from lagcli.reader.sign_meant import ASSUMPTIONS, range_meant, signs_of
from lagcli.reader.suggest import closest, did_you_mean
from lagcli.reader.text import as_sum

#: The likeness of a key and its misspelling: another word of as many letters is less like it.
_NEAR = 0.7
#: That of a key and its slip of a letter.
_SLIP = 0.8
_PROBLEM = "the problem"
_WISHES = frozenset({"yes", "true", "True", "on", "all", "find", "?"})
#: The words that only one key has.
_WORDS = {"assume": {*ASSUMPTIONS} - {"real"}, "acts_as": get_args(ForceKind)}
_NOT = frozenset({"no", "false", "off", "0"})
#: The number of a state.
_STATE = regex(r"(?:[-+*/\d.() ]|pi|e(?=[-+\d]))+")
_OF_ENERGY = frozenset("T V L H forces dissipation points".split())
_DEFINED = "a formula with a name stands under definitions"
_MANUAL = "leave it out, or see lagcli help problem-format"


class UnknownKey(NamedTuple):
    """The sentence on a key, its advice, and the key of the section that was meant."""

    message: str
    hint: str
    meant: str | None = None


def unknown_key(
    key: Scalar,
    value: DocumentNode,
    what: str,
    names: tuple[str, ...],
    around: Mapping,
    scope: Scope,
) -> UnknownKey:
    """What is wrong with a key of the map `around`, which is that of a section with keys `names`.

    A name that cannot be declared for this key is noted as refused.
    """
    word, written = key.label, value.value if isinstance(value, Scalar) else ""
    if broken := re.fullmatch(r"(\w+)(?<!_)\s*([\[{].*)", word):
        hint = f"write {broken[1]}: {broken[2]}: {source_of(value)}"
        return UnknownKey(f"a ':' is missing behind '{broken[1]}'", hint)
    along = _coordinates(around) if what == _PROBLEM else []
    meant, hint = _meant(word, written, what, names)
    friction = friction_meant(word, value, along)
    if friction and is_constant(word, written) and _is_named(key, value, around):
        meant, hint = None, _of_constant(word, written)
    elif friction:
        is_key = friction == f"write dissipation: {written}"
        meant, hint = ("dissipation", "the key is dissipation") if is_key else (None, friction)
    elif what == _PROBLEM:
        meant, hint = _meant_of_problem(key, value, around, meant, hint, scope)
    elif not hint or hint.startswith("did you mean"):
        answer = _answer_meant(word, written, scope) if what == "expect" else ""
        if what == "simulation" and written and (state := state_meant(word, scope.coordinates)):
            answer = f"where it begins is said in initial: write initial: {{{state}: {written}}}"
        hint = answer or _outer(key, value, names) or hint
    given = {each.label for each, _ in around.entries}
    bound = spellings("bounds").get(letters(word))
    if "assume" in names and bound is not None:
        meant, hint = None, range_meant(bound, value, what, given)
    law = word if value.is_empty else written
    if "equation" in given and "holds_while" in {*names} - given and re.search("[<>≤≥]", law):
        meant, hint = "holds_while", "the key is holds_while"
        if law is word:
            meant, hint = None, f"write holds_while: {law}"
    if meant in given and hint == f"the key is {meant}":
        hint = f"the key is {meant}, which is given already: its entries stand there"
        hint = f"leave it out: {meant} is given already" if written else hint
    if "at" in names and word in scope.coordinates:
        hint = f"write at: {{{word}: {written}}}"
    if not hint and isinstance(value, Mapping) and value.entries:
        inner = [(key_meant(each.label, names), source_of(part)) for each, part in value.entries]
        lines = ", ".join(f"{each}: {part}" for each, part in inner)
        hint = f"leave it out, and begin lines with {lines}" if all(k for k, _ in inner) else ""
    if "=" in word and not meant and not re.search("initial: {|holds_while", hint):
        defined = re.fullmatch(r"([TVLH])\s*:?=\s*(.+)", word)
        hint = f"write {': '.join(defined.groups()) if defined else name_meant(word)}"
    elif key.in_flow and value.is_empty and not hint.startswith("write "):
        hint = "inside { } a comma ends the value: put a text with commas in quotes"
    if "parameters" in names and is_constant(word, written):
        scope.refused.append(word)
    if isinstance(value, Mapping | Sequence):
        given_there = source_of(value)
        if "until: …" in hint:
            given_there = range_end(given_there) or given_there
        hint = hint.replace(": …}", f": {given_there}}}")
    if gap := difference(source_of(value)):
        hint = hint.replace('--stop-when "x - 1"', f'--stop-when "{gap}"')
    if hint.startswith("did you mean"):
        meant = meant or closest(word, names, _NEAR)
    known = f"known are {', '.join(names)}" if names != KEYS else _MANUAL
    hint = hint or known
    return UnknownKey(f"unknown key '{word}' in {what}", hint, meant)


def _meant(word: str, written: str, what: str, names: tuple[str, ...]) -> tuple[str | None, str]:
    """The key that a word stands for, and the hint; the advice for the word where it has none."""
    is_time = word == "t" and "'" not in written
    other = "" if is_time else word.casefold()  # the time is not T
    alike = [name for name in names if name.casefold() == other]
    meant = alike[0] if len(alike) == 1 else key_meant(word, names)
    if named := [key for key, words in _WORDS.items() if written in words and key in names]:
        return named[0], f"the key is {named[0]}"
    advice = _advice(word, written, what, names)
    is_word = written in _WISHES or (meant == "value" and not re.search(r"\d", written))
    if meant and not (advice and is_word):
        return meant, f"the key is {meant}"
    if advice:
        return None, advice
    stem = key_of_stem(word, names)
    if stem not in {None, "dissipation", closest(word, names, _NEAR)}:
        return stem, f"the key is {stem}"
    return None, did_you_mean(word, names, _NEAR) or did_you_mean(
        word.removesuffix("s"), names, _NEAR
    )


def _meant_of_problem(
    key: Scalar, value: DocumentNode, around: Mapping, meant: str | None, hint: str, scope: Scope
) -> tuple[str | None, str]:
    """The same for a key of the problem, whose value and neighbours tell what it is."""
    word, written = key.label, value.value if isinstance(value, Scalar) else ""
    if meanings("commands").get(word, word) == "sweep" and (options := _varied(value)):
        return None, f"a command, not a key: lagcli sweep FILE {options}"
    signals = names_in(value) if re.match("(?i)input|control", word) else []
    if isinstance(value, Sequence) and signals and all(map(str.isidentifier, signals)):
        scope.refused += signals
        listed, called = (", ".join(x + end for x in signals) for end in (": [t]", "(t)"))
        return None, f"functions of the time: write functions: {{{listed}}}, and {called} in forces"
    if isinstance(value, Sequence) and hint.startswith("option"):  # outputs: [x, xdot]
        shown = [state_meant(source_of(x), _coordinates(around)) for x in value.items]
        command = f'an option, not a key: lagcli simulate FILE --show "{",".join(shown)}"'
        return None, command if all(shown) and shown else hint
    given = {k.label: v for k, v in around.entries}
    solved = word.casefold() == "accelerations"
    if (hint == DERIVED or solved) and not given.keys() & _OF_ENERGY:
        constants, laws = names_in(given.get("parameters")), by_key(value).items()
        equations = texts_of(value) or [f"{q}'' = {x}" if solved else x for q, x in laws]
        energies = energies_of(equations, _coordinates(around), constants)
        return None, f"the equations of motion are derived: write {energies}" if energies else hint
    if whole := _of_each(word, value, around):
        return None, whole
    is_state = written and "stop-when" not in hint
    if is_state and (state := _state_meant(key, written, around)):
        return None, state
    if written and (force := _force_meant(word, written, around)):
        return None, f"forces stand by coordinate: write forces: {{{force}}}"
    if form := _quadratic_form(word, value, _coordinates(around)):
        return None, form
    numbers = [v.value for _, v in value.pairs if isinstance(v, Scalar)]
    has_parameters = "parameters" in {each.label for each, _ in around.entries}
    all_numbers = numbers and all(is_constant("x", each) for each in numbers)
    if meant == "points" and has_parameters and all_numbers:
        return None, f"constants stand under parameters: write parameters: {{{entries_of(value)}}}"
    shape = None if f"{word}s" in KEYS else key_by_shape(value, around)
    near = meant or closest(word, KEYS)
    is_list = isinstance(value, Sequence) or shape == "parameters"
    is_slip = bool(closest(word, KEYS, _SLIP))
    if isinstance(value, Sequence) and shape and hint.startswith("write expect"):  # dof: [x, y]
        meant, hint = shape, f"the key is {shape}"
    is_open = not hint or hint[:8] == "did you " or (near in MAPS - {shape} and is_list)
    if shape and not is_slip and near != word.casefold() and is_open:
        meant, hint = shape, f"the key is {shape}"
    if energy_ := potential_meant(word, value, around, _coordinates(around)):
        return None, energy_
    if hint.startswith("constants stand") and (letter := _letter_used(word, around)):
        hint = hint.replace(f"{{{word}:", f"{{{letter}:")
    above = [k.label for k, _ in around.entries if k.start < key.start][-1:]
    if not hint and " " in word and above and above[0] in {"title", "source", "description"}:
        return None, f"it goes on with '{above[0]}': put the whole text in quotes"
    parts = {k.label: v.value.strip() for k, v in around.entries if isinstance(v, Scalar)}
    energy = meant if meant in {"T", "V"} and written else None
    if energy is None and letters(word) not in spellings("advice", "problem"):
        numbered = re.match(r"[TV](?=\d|_)", word)  # V2, V_spring
        energy = numbered[0] if numbered else None
    if energy in parts:
        return meant, f"it is one sum: write {energy}: {parts[energy]} + {written}"
    if energy and energy != word and meant is None:  # V1 and V2
        terms = [parts[each] for each in parts if re.match(rf"{energy}(?=\d|_)", each)]
        return None, f"it is one sum: write {energy}: {as_sum(terms)}"
    relation, named = re.search(r"[<>≤≥]|(?<![<>])=", written), {*_coordinates(around)}
    left, _, right = written.partition("=")
    if not hint and relation and left.strip().isidentifier() and left.strip() not in named:
        return None, f"{_DEFINED}: write definitions: {{{left.strip()}: {right.strip()}}}"
    if not hint and relation and set(re.findall(r"\w+", written)) & named:
        section = "constraints" if relation[0] == "=" else "contacts"
        return None, f"it stands under {section}: write {section}: {{{word}: {written}}}"
    is_other = not hint or (meant != word and word.casefold() == (meant or "").casefold())
    if is_other and _is_used(key, value, around):
        scope.refused.append(word)
        return None, f"{_DEFINED}: write definitions: {{{word}: {written}}}"
    return meant, hint


def _varied(value: DocumentNode) -> str:
    """`--vary e=0.5,0.9` for `{e: [0.5, 0.9]}` and `{parameter: e, values: [0.5, 0.9]}`."""
    parts = {key.label: node for key, node in value.pairs}
    ranges = {name: values_of(node) for name, node in parts.items()}
    written = source_of(value).strip("[]")
    if one := re.fullmatch(r"([^\W\d]\w*)\s*(?:[,=:]|in|from|over|\s)\s*(.*)", written):
        ranges = {one[1]: values_in(one[2].strip("[]{}"))}
    named = [x for x in map(source_of, parts.values()) if x.isidentifier()]
    given = [each for each in ranges.values() if each] or [values_of(value)]
    if len(named) == len(given) == 1:
        ranges = {named[0]: given[0]}
    is_clear = ranges and all(ranges.values())
    return " ".join(f"--vary {name}={each}" for name, each in ranges.items()) if is_clear else ""


#: The attribute of the entries of a section that may stand alone.
_FIRST = {"coordinates": "unit", "parameters": "value", "points": "position", "contacts": "gap",
          "constraints": "equation"}  # fmt: skip


def _of_each(word: str, value: DocumentNode, around: Mapping) -> str:
    """`in line 1 write points: {A: {position: [x], mass: m}}` for `masses: {A: m}` beside points.

    One value is that of the only name, values in a list are those of the names in order.  Nothing
    where the entries are not all names of sections that have the attribute.
    """
    known = (*SECTIONS, *SAID)
    attribute = key_meant(word, known) or key_meant(word.removesuffix("s"), known)
    attribute = "mass" if word == "masses" else attribute or ""
    given = signs_of(value) if attribute == "assume" else by_key(value)
    values = [*given.values()] or [source_of(each) for each in (value.parts or [value])]
    if attribute == "multiplier" and not all(x.isidentifier() and x not in _WISHES for x in values):
        return ""  # its formula
    named = [SECTIONS.get(attribute, "contacts")]
    named = ["coordinates", "parameters"] if attribute in SAID else named
    parts, left = [], {*given}
    sections = ((key, node) for key, node in around.entries)
    for key, node in (each for each in sections if each[0].label in {*named} & _FIRST.keys()):
        inner: dict[str, dict[str, str]] = {name: {} for name in names_in(node)}
        for name_, each in node.pairs:
            inner[name_.label] = inner_of(each, _FIRST[key.label])
        is_in_order = len(values) == 1 or not given
        if len(named) == 1 and is_in_order and len(values) == len(inner):
            given = dict(zip(inner, values, strict=True))
            left = {*given}
        for name in left & {*inner}:
            inner[name][attribute] = given[name]
        whole = as_flow({name: as_flow(each) for name, each in inner.items()})
        here = f"in {lines_of(key, node)} write {key.label}: {whole}"
        parts += [here] * bool(left & {*inner})
        left -= {*inner}
    if attribute == "multiplier" and (left or not parts):
        return f"write constraints: {{name: {{equation: left = right, multiplier: {values[0]}}}}}"
    whole = " and ".join(parts) if given and attribute and not left else ""
    return f"leave it out, and {whole}" if whole else ""


def _coordinates(around: Mapping) -> list[str]:
    """The names of the coordinates of a problem."""
    given = (node for each, node in around.entries if each.label == "coordinates")
    return names_in(next(given, None))


def _answer_meant(word: str, written: str, scope: Scope) -> str:
    """`write accelerations: {x: -g}` for an answer `x_ddot: -g`; nothing for others."""
    coordinates = scope.coordinates
    meant = state_meant(word, coordinates)
    if meant.endswith("''"):
        return f"write accelerations: {{{meant[:-2]}: {written}}}"
    if momentum := momentum_meant(word, coordinates):
        return f"write momenta: {{{momentum}: {written}}}"
    if not meant or not written:
        return ""
    if re.search(r"(?<!\w)t(?![\w(])", written):
        return f"write trajectory: {{{meant}: {written}}}"
    if word not in coordinates:
        return ""
    place = f"equilibria: [{{at: {{{word}: {written}}}}}]"
    why = f"the acceleration {word}'' stands there by its coordinate"
    other = f"write accelerations: {{{word}: {written}}}: {why}"
    return f"write {place}" if _STATE.fullmatch(written) else other


def _state_meant(key: Scalar, written: str, around: Mapping) -> str:
    """`write initial: {x: 1}` for an entry `x(0): 1`; nothing for others."""
    coordinates = _coordinates(around)
    rest = _elsewhere(key, key.end, around)
    rate, _, value = written.partition("=")  # velocity: x' = 3
    label, written = (rate.strip(), value.strip()) if "'" in rate else (key.label, written)
    is_used = label not in coordinates and re.search(rf"(?<!\w){re.escape(label)}(?!\w)", rest)
    meant = state_meant(label, coordinates) if "'" in label or not is_used else ""
    number = re.sub(r"([\d.]+)\s*°", r"\1*pi/180", written)
    if meant.endswith("''"):
        return DERIVED
    state = f"the state at t = 0 stands under initial: write initial: {{{meant}: {number}}}"
    return state if meant and _STATE.fullmatch(number) else ""


def _force_meant(word: str, written: str, around: Mapping) -> str:
    """`x: -c*x'` for an entry `F_x: -c*x'`, `q2: F` for `Q2: F`; nothing for others."""
    coordinates = _coordinates(around)
    along = coordinate_meant(word, coordinates) if re.match(r"[QF]_?\w", word) else ""
    return f"{along}: {written}" if along in coordinates and not is_constant(word, written) else ""


#: The function of whose second derivatives a matrix consists.
_MATRICES = {"m": "T", "mass": "T", "inertia": "T", "k": "V", "stiffness": "V", "c": "dissipation",
             "d": "dissipation", "damping": "dissipation"}  # fmt: skip


def _quadratic_form(word: str, value: DocumentNode, coordinates: list[str]) -> str:
    """`write T: (m*x1'^2 + m*x2'^2)/2` for a mass matrix; nothing for other keys."""
    key = _MATRICES.get(re.sub(r"[_ ]?matrix$", "", word.casefold()), "")
    rows = [each.items for each in value.parts if isinstance(each, Sequence)]
    size = len(coordinates)
    if not key or not size or [len(row) for row in rows] != [size] * size:
        return ""
    prime = "'" * (key != "V")
    terms = []
    for i, x in enumerate(coordinates):
        for j, y in enumerate(coordinates[i:], start=i):
            entry = source_of(rows[i][j])
            entry = f"({entry})" if re.search(r"\S\s*[-+]", entry) else entry
            sign, size_ = entry[: entry[0] == "-"], entry.removeprefix("-")
            pair = f"{x}{prime}^2" if i == j else f"{x}{prime}*{y}{prime}"
            if entry != "0":
                terms.append(f"{sign}{'2*' * (i != j)}{size_}*{pair}")
    return f"write {key}: ({as_sum(terms)})/2" if terms else ""


def _letter_used(word: str, around: Mapping) -> str:
    """The g of the formulas for `gravity: 9.81`, where nothing declares it; else nothing."""
    letter = {"stiffness": "k", "spring_constant": "k"}.get(word, word[:1])
    text = around.text.source.text
    used = re.search(rf"^[TVL]:.*(?<!\w){letter}(?![\w'])", text, re.MULTILINE)
    declared = re.search(rf"^(?![TVL]:).*(?<!\w){letter}(?!\w)", text, re.MULTILINE)
    is_word = len(word) > 3 and not re.search(rf"^[TVL]:.*(?<!\w){word}(?!\w)", text, re.MULTILINE)
    return letter if is_word and used and not declared else ""


def _outer(key: Scalar, value: DocumentNode, names: tuple[str, ...]) -> str:
    """The advice for a key of the problem that stands in one of its sections."""
    known = {*names, *(f"{name}s" for name in names), *(name.rstrip("s") for name in names)}
    outer = key_meant(key.label, KEYS) if len(key.label) > 2 and key.label not in known else None
    if outer not in {key.label, "initial", "parameters"}:
        return ""
    return f"a key of the problem: write {outer}: {source_of(value)} on a line of its own"


def _elsewhere(key: Scalar, end: int, around: Mapping) -> str:
    """The text of the file without an entry."""
    text = around.text.source.text
    return text[: key.start] + text[end:]


def _is_named(key: Scalar, value: DocumentNode, around: Mapping) -> bool:
    """Whether the word for a key stands in other formulas of the file."""
    form = rf"[-+*/^(=:]\s*{re.escape(key.label)}(?!\w|\s*:)"
    return re.search(form, _elsewhere(key, value.end, around)) is not None


def _is_used(key: Scalar, value: DocumentNode, around: Mapping) -> bool:
    """Whether an entry is the formula of a name that stands in other formulas of the file."""
    if not re.fullmatch(r"[^\W\d]\w*", key.label) or not isinstance(value, Scalar):
        return False
    used = rf"(?<![\w.])d?{key.label}(?:[²³]|dot|_dot|(?!\w|\s*[:,\]])|(?=/dt))"
    is_formula = re.search(r"[-−+*/^(√]|[^\W\d]\s[^\W\d]", value.value) and "=" not in value.value
    return bool(is_formula) and re.search(used, _elsewhere(key, value.end, around)) is not None


def _counted(advice: str, word: str, value: str) -> str:
    """The advice with the number of samples of the file, which a rate is not."""
    is_count = value.isdigit() and word not in {"fps", "interval"}
    return advice.replace("VALUE", value if is_count else "100")


def _advice(word: str, value: str, what: str, known: tuple[str, ...]) -> str:
    """What to write instead of a key with its value; nothing where that is unclear."""
    section = what.removeprefix("the ").partition(" ")[0]
    if word in ASSUMPTIONS and word != "real" and "assume" in known:
        return "leave it out" if value.casefold() in _NOT else f"write assume: {word}"
    of_run = word == "method" and meanings("methods").get(value.casefold(), "")
    advice = spellings("advice", section).get(letters(word))
    if advice and not of_run:
        name = value if value.isidentifier() else "N"
        return _counted(advice.replace("{word}", word).replace("{name}", name), word, value)
    return _advice_in_problem(word, value.strip()) if section == "problem" else ""


def _advice_in_problem(word: str, value: str) -> str:
    if said := advised("entries", f"{word}: {value}"):
        return said
    spelled = re.sub("[- ]", "_", word.casefold())
    key = meanings("keys").get(spelled, spelled if spelled in meanings("parts") else word)
    part = meanings("parts").get(key)
    if key == "until" and re.search("[=<>≤≥]", value):
        return f'an event is an option: lagcli simulate FILE --stop-when "{difference(value)}"'
    if part == "expect" and key in FOUND and re.search(r"=", value):
        return ALREADY_FOUND
    if key == "until":
        value = range_end(value) or value
    if len(word) > 1 and (advice := spellings("advice", "simulation").get(letters(word))):
        return _counted(advice, word, value)
    if part == "expect" and value in _WISHES:
        return f"an option, not a key: lagcli solve FILE --show {key}"
    if part:
        return f"write {part}: {{{key}: {value or '…'}}}"
    if is_constant(word, value):
        return _of_constant(word, value)
    if word.casefold() in {*GRAVITY, "field"}:
        return "it has a potential energy: write V: m*g*y"
    return ""


def _of_constant(word: str, value: str) -> str:
    number, unit = number_and_unit(value)
    given = f"{{value: {number}, unit: {unit}}}" if unit else number
    return f"constants stand under parameters: write parameters: {{{word}: {given}}}"
