"""One slip in a good file is one mistake, at its line, with a hint: no cascade."""

from __future__ import annotations

import random
import re
from functools import cache

import pytest

from lagcli.library import entries
from lagcli.reader import read_problem


@cache
def good_files():
    """The library without its known answers."""
    found = {}
    for entry in entries():
        text = entry.path.read_text("utf-8").partition("\nexpect:")[0] + "\n"
        if not read_problem(entry.name, text.encode()).diagnostics:
            found[entry.name] = text
    return found


def errors(text):
    return [each for each in read_problem("p", text.encode()).diagnostics if each.is_error]


def drawn(draw, pattern):
    """A file and a place of the pattern in it."""
    while True:
        text = good_files()[draw.choice([*good_files()])]
        found = [*re.finditer(pattern, text, re.MULTILINE)]
        if found:
            return text, draw.choice(found)


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("section", ["points", "constraints", "find"])
def test_a_missing_line_of_a_section_is_named(seed, section):
    draw = random.Random(seed)
    text, line = drawn(draw, rf"^{section}:\n(?=  \w+:)")
    found = errors(text[: line.start()] + text[line.end() :])
    assert found
    if section != "find" or ": {where" in text or ": {value" in text:
        assert len(found) == 1, [each.message for each in found]
        assert found[0].hint == f"a line '{section}:' is missing above it"
        assert found[0].span.line == text[: line.start()].count("\n") + 1


@pytest.mark.parametrize("seed", range(25))
def test_a_colon_of_a_map_in_braces(seed):
    draw = random.Random(seed)
    text, place = drawn(draw, r"(?<=\{)(\w+'*): (?=[\w.-]+[,}])|(?<=, )(\w+'*): (?=[\w.-]+[,}])")
    wrong = draw.choice([";", "=", " :", ":"])
    changed = text[: place.end() - 2] + wrong + text[place.end() :]
    found = errors(changed)
    assert len(found) == 1, [each.message for each in found]
    assert found[0].span.line == text[: place.start()].count("\n") + 1
    assert f"write {place[1] or place[2]}: " in found[0].hint


@pytest.mark.parametrize("seed", range(25))
def test_a_coordinate_with_another_name_is_one_mistake_for_each_place_of_its_use(seed):
    draw = random.Random(seed)
    text, place = drawn(draw, r"^  (\w+): \{unit: \w+")
    name = place[1]
    renamed = f"{name}{draw.choice(['x', 'qq', 'zz'])}"
    changed = text[: place.start(1)] + renamed + text[place.end(1) :]
    used = [each for each in errors(changed) if f"'{name}'" in each.message]
    assert len(used) <= 1 or all(f"'{renamed}'" in each.hint for each in used)


@pytest.mark.parametrize("seed", range(12))
def test_a_wrong_unit_that_alone_explains_all_is_named(seed):
    draw = random.Random(seed)
    while True:
        text, place = drawn(draw, r"^  (\w+): \{unit: (m|kg|rad)\}$")
        unit = {"m": "kg", "kg": "s", "rad": "A"}[place[2]]
        found = errors(text[: place.start(2)] + unit + text[place.end(2) :])
        if found and "does not fit the terms" in found[0].message:
            break
    [only] = found
    assert only.message == f"the unit of '{place[1]}' does not fit the terms of the file"
    put_in = text[: place.start(2)] + only.hint.removeprefix("write ") + text[place.end(2) :]
    assert errors(put_in) == []
    assert only.span.line == text[: place.start()].count("\n") + 1


@pytest.mark.parametrize("seed", range(12))
def test_a_prime_that_alone_explains_all_is_named(seed):
    draw = random.Random(seed)
    while True:
        text, place = drawn(draw, r"^(?:T|L|  \w+): .*?\b(\w+)'(?!')")
        changed = text[: place.end() - 1] + text[place.end() :]
        found = errors(changed)
        if found and " stands where " in found[0].message:
            break
    [only] = found
    line, column = only.span.line, only.span.column
    lines = changed.split("\n")
    better = only.hint.removeprefix("write ")
    end = only.span.end_column - 1
    lines[line - 1] = lines[line - 1][: column - 1] + better + lines[line - 1][end:]
    assert errors("\n".join(lines)) == []


def test_the_same_keys_twice_in_a_map_are_one_mistake():
    text = (
        "coordinates: [x]\nH: p_x^2/2\ncanonical_transformations:\n"
        "  a:\n    Q: p_x\n    p_Q: -x\n    Q: x\n    p_Q: p_x\n"
    )
    assert len(errors(text)) == 1


@pytest.mark.parametrize("seed", range(15))
def test_a_missing_colon_behind_an_attribute(seed):
    draw = random.Random(seed)
    text, place = drawn(draw, r"(?<=[{ ])(mass|where|value|for): (?=[^{},\[\]\"]+[,}])")
    found = errors(text[: place.end() - 2] + " " + text[place.end() :])
    assert len(found) == 1, [each.message for each in found]
    assert found[0].message == f"': ' is missing behind '{place[1]}'"


def test_names_of_a_section_whose_line_is_missing_are_not_told():
    text = (
        "coordinates: [x]\nparameters: {m: 1, w: 2}\npoints:\n  P: {position: [x], mass: m}\n"
        "  motor: x = w*t\nfind:\n  push: {value: lambda_motor, in_terms_of: [x]}\n"
    )
    [only] = errors(text)
    assert only.hint == "a line 'constraints:' is missing above it"


def proposed(hint):
    """The formulas that a hint says to write."""
    return [part.partition("write ")[2] for part in hint.split("; ")]


@pytest.mark.parametrize("seed", range(20))
def test_one_habit_in_several_entries_is_one_mistake(seed):
    draw = random.Random(seed)
    names = draw.sample(["x", "y", "z", "u", "w"], draw.choice([2, 3]))
    unit = draw.sample(["kg", "m", "N/m", "s"], len(names))
    values = [draw.choice(["1", "0.5", "12"]) for _ in names]
    entries_, hints = draw.choice(
        [
            (
                f"parameters: {{{', '.join(f'k_{x}: {v} {u}' for x, v, u in zip(names, values, unit, strict=True))}}}",
                [f"{{value: {v}, unit: {u}}}" for v, u in zip(values, unit, strict=True)],
            ),
            (
                f"initial: {{{', '.join(f'{x}(0): {v}' for x, v in zip(names, values, strict=True))}}}",
                names,
            ),
            (
                f"initial: {{{', '.join(f'{x}: {v} deg' for x, v in zip(names, values, strict=True))}}}",
                [f"{v}*pi/180" for v in values],
            ),
        ]
    )
    kinetic = " + ".join(f"{x}'^2" for x in names)
    found = errors(f"coordinates: [{', '.join(names)}]\nT: {kinetic}\n{entries_}\n")
    assert len(found) == 1, [each.message for each in found]
    assert proposed(found[0].hint) == list(dict.fromkeys(hints))


def test_of_many_entries_three_are_shown_with_their_lines():
    lines = "".join(f"  {name}: {place} kg\n" for place, name in enumerate("abcde", start=1))
    [found] = errors(f"coordinates: [x]\nT: x'^2\nparameters:\n{lines}")
    assert found.span.line == 4
    assert found.hint == (
        "write {value: 1, unit: kg}; in line 5 write {value: 2, unit: kg}; "
        "in line 6 write {value: 3, unit: kg}; and so on"
    )


def test_two_slips_of_one_section_stay_two():
    found = errors("coordinates: [x]\nT: x'^2\nsimulation: {untill: 3, acuracy: 1e-9}\n")
    assert [each.hint for each in found] == ["did you mean 'until'?", "did you mean 'accuracy'?"]


@pytest.mark.parametrize("seed", range(60))
def test_two_exchanged_neighbours_of_a_formula(seed):
    draw = random.Random(seed)
    formula = draw.choice(["-m*g*l*cos(theta)", "k*sqrt(x^2 + l^2)", "m*(g*x - 2*k*x^2)/2"])
    places = [
        k for k in range(len(formula) - 1)
        if {*formula[k : k + 2]} & {*"()^"} and not set(formula[k : k + 2]) & {*" 0123456789"}
    ]  # fmt: skip
    at = draw.choice(places)
    wrong = formula[:at] + formula[at + 1] + formula[at] + formula[at + 2 :]
    begin = "coordinates: [x, theta]\nparameters: [m, g, l, k]\nT: x'^2 + theta'^2\nV: "
    assert not errors(begin + formula + "\n")
    found = errors(f"{begin}{wrong}\n")
    if found and found[0].hint.startswith("did you mean") and "*" in found[0].hint:
        proposal = found[0].hint.removeprefix("did you mean ").removesuffix("?")
        assert not errors(f"{begin}{proposal}\n")
        assert len(found) == 1


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("-m*g*l*co(stheta)", "-m*g*l*cos(theta)"),
        ("-m*g*l*cost(heta)", "-m*g*l*cos(theta)"),
        ("m*x^'2/2", "m*x'^2/2"),
        ("k*x2^/2", "k*x^2/2"),
    ],
)
def test_exchanged_neighbours_are_put_back(wrong, right):
    begin = "coordinates: [x, theta]\nparameters: [m, g, l, k]\nT: x'^2 + theta'^2\nV: "
    [found] = errors(f"{begin}{wrong}\n")
    assert found.hint == f"did you mean {right}?"


@pytest.mark.parametrize(
    ("coordinates", "wrong", "right"),
    [
        ("[x, theta]", "v = omega*R", "x' = theta'*R"),
        ("[phi, u]", "v = R*ω", "u' = R*phi'"),
        ("[x, theta]", "omega = v/R", "theta' = x'/R"),
    ],
)
def test_letters_of_velocities_in_a_rolling_constraint(coordinates, wrong, right):
    begin = f"coordinates: {coordinates}\nparameters: [R]\n"
    kinetic = " + ".join(f"{x}'^2" for x in re.findall(r"\w+", coordinates))
    [found] = errors(f"{begin}T: {kinetic}\nconstraints:\n  rolling: {wrong}\n")
    assert found.hint == f"write {right}"


@pytest.mark.parametrize("seed", range(12))
def test_the_term_that_lacks_its_primes_is_written_out(seed):
    draw = random.Random(seed)
    while True:
        text, place = drawn(draw, r"^(?:T|L): .*'.*$")
        term = place[0].replace("'", "") if draw.random() < 0.5 else place[0].replace("'", "", 1)
        changed = text[: place.start()] + term + text[place.end() :]
        found = errors(changed)
        if len(found) == 1 and " is missing; " in found[0].hint and ": a" in found[0].hint:
            break
    [only] = found
    lines = changed.split("\n")
    row, begin, end = only.span.line - 1, only.span.column - 1, only.span.end_column - 1
    whole = only.hint.removeprefix("write ").partition(": a")[0]
    lines[row] = lines[row][:begin] + whole + lines[row][end:]
    assert errors("\n".join(lines)) == []


@pytest.mark.parametrize("seed", range(25))
def test_a_key_that_is_indented_into_the_section_above_it(seed):
    draw = random.Random(seed)
    sections = "parameters|points|constraints|contacts|forces|symmetries|initial|find"
    above = rf"^({sections}):\n(?:  .*\n)+"
    text, place = drawn(draw, rf"{above}(?=(?:[TVL]|{sections}):.*\n)")
    rest = text[place.end() :]
    block = re.match(r".*\n(?:  .*\n)*", rest)
    assert block is not None
    moved = re.sub(r"^", "  ", block[0].rstrip("\n"), flags=re.MULTILINE) + "\n"
    found = errors(text[: place.end()] + moved + rest[block.end() :])
    assert len(found) == 1, [each.message for each in found]
    key = block[0].partition(":")[0]
    assert found[0].message == f"'{key}' stands inside of '{place[1]}'"
    assert found[0].hint == f"begin its line where '{place[1]}' begins"
    assert found[0].span.line == text[: place.end()].count("\n") + 1


def test_a_parameter_may_be_called_like_an_energy():
    assert not errors(
        "coordinates: [x]\nT: x'^2\nparameters:\n  V: 2\n  L: 3*V\nforces: {x: V*L*x}\n"
    )


@pytest.mark.parametrize("name", "TVLH")
def test_a_constraint_and_a_coordinate_may_be_called_like_an_energy(name):
    energy = "L" if name in "TVH" else "T"
    tied = f"coordinates: [x, y]\n{energy}: x'^2 + y'^2\nconstraints:\n  {name}: x' = y*y'\n"
    assert not errors(tied)
    pushed = f"coordinates: [{name}]\n{energy}: {name}'^2\nforces:\n  {name}: -2*{name}'\n"
    assert not errors(pushed)


SLIPS = [
    # L beside T and V: what is to be left out has no other mistakes
    ("T: m*x'^2/2\nV: k*x^2/2\nL: T - U\n", 6, "leave out L: it is T - V"),
    # two names for one entry
    ("T: (a + b)*x'^2/2\nV: k*x^2\nparameters:\n  a, b: {assume: positive}\n  k: 1\n", 7,
     "write a: {assume: positive}, and on a line of its own b: {assume: positive}"),
    # a product without stars, all of it names of the file
    ("T: J*x'^2/2\nV: k*x^2\nparameters:\n  k: 1\n  m: 1\n  l: 1\n  J: 1/3 m l^2\n", 10,
     "did you mean 1/3*m*l^2?"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "line", "hint"), SLIPS)
def test_it_is_one_mistake_with_what_would_be_right(written, line, hint):
    begin = "title: a\ncoordinates: [x]\n"
    declared = "parameters: {m: 1, k: 2}\n" if "parameters" not in written else ""
    [only] = errors(begin + declared + written)
    assert only.hint.replace("FILE", "p") == hint
    assert only.span.line == line - ("parameters" in written)


@pytest.mark.parametrize("dash", "−–")
def test_a_dash_of_a_text_is_a_minus(dash):
    text = f"coordinates: [x]\nT: x'^2/2\nV: {dash}3*x {dash} x^2\n"
    assert not read_problem("p", text.encode()).diagnostics
