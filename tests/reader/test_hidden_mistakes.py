"""Mistakes that another one of the same file must not hide, and hints that name the whole text."""

import random

import pytest

from lagcli.reader import read_problem


def found(written):
    return read_problem("p.yaml", written.encode()).diagnostics


@pytest.mark.parametrize("wrong", ["Sqrt(1 - x'^2)", "sqroot(1 - x'^2)", "m*x'^2*kk"])
def test_an_energy_too_many_hides_no_unknown_name(wrong):
    told = found(f"coordinates: [x]\nparameters: [m, k]\nL: -m*{wrong}\nV: k*x\n")
    assert [each.span.line for each in told] == [3, 4]


@pytest.mark.parametrize("other", ["observables: {E: px^2}", "find: {h: {value: px}}"])
def test_an_unknown_name_is_shown_where_it_stands_first(other):
    told = found(f"coordinates: [x]\nparameters: [m, k]\nH: px^2/(2*m) + k*x^2\n{other}\n")
    assert told[0].span.line == 3
    assert told[0].hint.startswith("did you mean 'p_x'?")


def hints(written):
    return [each.hint for each in found(written)]


@pytest.mark.parametrize(
    ("masses", "name", "meant"),
    [("m, k", "A", "m"), ("m1, m2", "P2", "m2"), ("M, m_A", "A", "m_A")],
)
def test_a_position_without_a_mass_is_one_mistake(masses, name, meant):
    told = hints(f"coordinates: [x, y]\nparameters: [{masses}]\npoints: {{{name}: [x, y]}}\n")
    assert told == [f"write {{position: [x, y], mass: {meant}}}"]


def test_values_of_coordinates_are_one_state():
    begin = "coordinates: {x: {value: 1}, y: {value: 2}}\nT: (x'^2 + y'^2)/2\n"
    [hint] = hints(begin)
    assert hint.endswith("write initial: {x: 1, y: 2}")


@pytest.mark.parametrize(("side", "meant"), [("R*q", "R*q'"), ("R*q + 2*R*q", "R*q'")])
def test_a_rolling_condition_lacks_a_prime(side, meant):
    told = hints(
        "coordinates: {x: {unit: m}, q: {unit: rad}}\nparameters: {m: {unit: kg}, R: {unit: m}}\n"
        f"T: m*(x'^2 + R^2*q'^2)/2\nconstraints: {{rolling: x' = {side}}}\n"
    )
    assert told[0].startswith(f"write {meant}") == ("+" not in side)


@pytest.mark.parametrize(
    ("symmetry", "meant"),
    [
        ("rotation: m*(x*y' - y*x')", "write {x: -y, y: x}"),
        ("J: m*(x*y' - y*x')", "write observables: {J: x*p_y - y*p_x}"),
        ("momentum: m*x'", "write {x: 1}"),
    ],
)
def test_a_charge_is_no_symmetry(symmetry, meant):
    begin = "coordinates: [x, y]\nparameters: [m]\nT: m*(x'^2 + y'^2)/2\n"
    [hint] = hints(f"{begin}symmetries: {{{symmetry}}}\n")
    assert hint.endswith(meant)


@pytest.mark.parametrize(
    ("law", "meant"), [("d*sign(x')", ": -d*sign(x')"), ("-c*x'", ": c*x'"), ("k*x+d*x'", ": -d*x'"),
                       ("k*x - (c*x')", ", as in -c*x'")]
)  # fmt: skip
def test_friction_with_the_wrong_sign_is_told_its_own_formula(law, meant):
    begin = "coordinates: [x]\nparameters: {k: 1, c: -1, d: 2}\nT: x'^2\n"
    assert hints(f"{begin}forces: {{x: {law}}}\n") == [f"friction is opposite to it{meant}"]


def test_a_multiplier_with_a_sign_is_that_of_the_exchanged_equation():
    begin = "coordinates: [r]\nparameters: [R]\nT: r'^2\nconstraints: {hoop: "
    given = "{equation: r = R, multiplier: -N, holds_while: N >= 0}"
    meant = "{equation: R = r, multiplier: N, holds_while: N >= 0}"
    assert hints(f"{begin}{given}}}\n") == [f"write {meant}"]
    assert hints(f"{begin}{meant}}}\n") == []


@pytest.mark.parametrize(
    ("second", "meant"),
    [
        ("  m: 1\n  k: 2\n", "leave out lines 2 to 3: "),
        ("  m: 1\n", "leave out lines 4 to 5: "),
        ("  k: 2\n", "leave it out, and in lines 2 to 3 write all as parameters: {m: 1, k: 2}"),
        ("  m: 2\n  k: 2\n", "leave out one of them"),
    ],
)
def test_a_section_given_twice_hides_no_name_and_is_one_mistake(second, meant):
    told = found(
        f"coordinates: [x]\nparameters:\n  m: 1\nparameters:\n{second}"
        f"T: m*x'^2/2\nV: {'k' if 'k' in second else 'm'}*x^2/2\n"
    )
    assert [each.message for each in told] == ["the key 'parameters' is given twice"]
    assert told[0].hint.startswith(meant)


ONE_OF = "leave out one of them"
SUM = "for the sum leave out the first one and write V:"


@pytest.mark.parametrize(
    ("one", "other", "meant"),
    [
        ("m*x", "k*x^2/2", f"{ONE_OF}; {SUM} m*x + k*x^2/2"),
        ("m*x", "-k*x^2/2", f"{ONE_OF}; {SUM} m*x - k*x^2/2"),
        ("m*x", "k*x^2/2 - m*x", f"{ONE_OF}; {SUM} m*x + k*x^2/2 - m*x"),
        ("m*x + m*x^4", "m*x - k*x^2/2", ONE_OF),
        ("m*x", "m*x + k*x^2/2", "leave out line 4: the other has all of its terms"),
        ("k*x^2/2 - m*x", "-m*x", "leave out line 5: the other has all of its terms"),
        ("m*x", "m*x", "leave out line 5: the other has all of its terms"),
    ],
)
def test_terms_of_two_energies_are_counted_once(one, other, meant):
    [told] = found(
        f"coordinates: [x]\nparameters: {{m: 1, k: 2}}\nT: m*x'^2/2\nV: {one}\nV: {other}\n"
    )
    assert told.hint == meant


SECTIONS = {
    "coordinates": ["x", "y"],
    "parameters": ["m", "k: 2", "l: {value: 1, unit: m}"],
    "forces": ["x: -k*x'", "y: -m*k"],
    "constraints": ["rod: x^2 + y^2 = l^2", "line: {equation: y = x, multiplier: N}"],
    "initial": ["x: 1", "x': 0", "y: 2"],
    "points": ["P: {position: [x, 0], mass: m}", "Q: {position: [0, y], mass: k}"],
}


@pytest.mark.parametrize("seed", range(12))
def test_entries_of_a_section_given_twice_stand_together(seed):
    draw = random.Random(seed)
    twice = draw.choice([*SECTIONS])
    given = {**SECTIONS, "coordinates": ["x: {unit: m}", "y"]} if seed % 2 else SECTIONS
    whole = {key: f"{{{', '.join(each)}}}" for key, each in given.items()}
    listed = [key for key, each in given.items() if not any(": " in x for x in each)]
    whole |= {key: f"[{', '.join(given[key])}]" for key in listed}
    rest = draw.randrange(1, len(given[twice]))
    form = "[%s]" if twice in listed else "{%s}"
    first, second = (form % ", ".join(each) for each in (given[twice][:rest], given[twice][rest:]))
    lines = {**whole, twice: first}
    text = "".join(f"{key}: {each}\n" for key, each in lines.items())
    [told] = found(f"{text}T: m*(x'^2 + y'^2)/2\n{twice}: {second}\n")
    number = [*lines].index(twice) + 1
    there = f"leave it out, and in line {number} write all as {twice}: "
    assert told.hint == there + whole[twice]


@pytest.mark.parametrize("seed", range(8))
def test_a_name_that_is_there_twice_is_the_one_that_is_missing(seed):
    draw = random.Random(seed)
    x, y = draw.sample(["x", "y", "x1", "x2", "theta", "phi"], 2)
    begin = f"coordinates: [{x}, {{}}]\nparameters: [m]\nT: m*({x}'^2 + {y}'^2)/2\ninitial: {{{{"
    start = f"{x}: {draw.randrange(3)}, {{}}: {draw.randrange(3, 6)}, {y}: 1}}}}\n"
    assert hints(begin.format(x) + start.format(f"{x}'")) == [f"write {y}"]
    assert hints(begin.format(y) + start.format(x)) == [f"the key is {x}'"]
    assert hints(begin.format(y) + start.format(f"{x}'")) == []


@pytest.mark.parametrize("x", ["x", "s", "z"])
@pytest.mark.parametrize(("word", "law"), [("v", "v/R"), ("v", "2*v^2/R"), ("{}dot", "R*{}dot")])
def test_a_velocity_among_the_parameters_may_be_that_of_the_coordinate(x, word, law):
    word, law = word.format(x), law.format(x)
    text = f"coordinates: [{x}]\nparameters: {{m: 1, R: 2, w: {law}}}\nT: m*{x}'^2/2 + m*w^2\n"
    [told] = hints(text)
    assert told.endswith(f", or, if it is {x}', write w under 'definitions' with {x}' for {word}")
    right = law.replace(word, f"{x}'")
    moved = text.replace(f", w: {law}", "") + f"definitions: {{w: {right}}}\n"
    assert hints(moved) == []


@pytest.mark.parametrize("indent", ["  ", "   ", "    "])
@pytest.mark.parametrize("section", ["coordinates", "parameters", "initial"])
def test_a_line_begins_where_the_others_of_its_section_begin(section, indent):
    entries = {
        "coordinates": ["x", "y"],
        "parameters": ["m: 1", "k: 2"],
        "initial": ["x: 1", "x': 0"],
    }
    entries["coordinates"] = ["x: {unit: m}", "y: {unit: m}"]
    lines = "".join(
        f"{key}:\n{indent}{first}\n{indent * (key != section)}{second}\n"
        for key, (first, second) in entries.items()
    )
    [told] = hints(f"{lines}T: m*(x'^2 + y'^2)/2\n")
    assert told == f"begin the line where '{entries[section][0][0]}' begins"


@pytest.mark.parametrize(
    ("formulas", "definitions", "meant"),
    [
        (
            "X: x + m, Y: x*m",
            "",
            "them out, and on a line of its own write definitions: {X: x + m, Y: x*m}",
        ),
        ("X: x' + m", "{Y: X*m}", "it out, and begin definitions with X: x' + m"),
        ("X: {value: Y + x}", "{Y: x*m}", "it out, and end definitions with X: Y + x"),
        (
            "X: m*cos(t), Y: 2",
            "",
            "it out, and on a line of its own write definitions: {X: m*cos(t)}",
        ),
    ],
)
def test_formulas_of_coordinates_among_the_parameters_are_one_mistake(formulas, definitions, meant):
    defined = f"definitions: {definitions}\n" * bool(definitions)
    told = hints(
        f"coordinates: [x]\nparameters: {{m: 1, {formulas}}}\n{defined}"
        "T: m*(x'^2 + X'^2)/2\nV: m*Y^2/2\n".replace("X'", "x'" if "x'" in formulas else "X'")
    )
    assert told == [f"leave {meant}"]


@pytest.mark.parametrize(
    ("clause", "meant"),
    [
        ("with h = x^2", "begin a line with definitions: {h: x^2}"),
        (
            ", where h = x^2 and g = 9.81",
            "begin a line with definitions: {h: x^2}, and put g: 9.81",
        ),
        ("mit h = 3*k*x, u = x/k", "begin a line with definitions: {h: 3*k*x, u: x/k}"),
        ("(wobei h = 2)", "put h: 2 under parameters"),
    ],
)
def test_names_that_a_formula_explains_are_told_once(clause, meant):
    begin = "coordinates: [x]\nparameters: {k: 2}\nT: x'^2/2\n"
    [hint] = hints(f"{begin}V: k*h {clause}\nforces: {{x: -h}}\n")
    assert hint.startswith(meant)
    assert hint.endswith(f"leave out '{clause}'")


@pytest.mark.parametrize(
    ("given", "meant"),
    [("[p_x, H, t]", "write [p_x, H]"), ("[x]", "a bracket has two functions, as in [x, H]"),
     ("[H]", "a bracket has two functions, as in [H, p_x]")],
)  # fmt: skip
def test_a_bracket_keeps_its_own_functions(given, meant):
    told = hints(f"coordinates: [x]\nH: p_x^2/2\nbrackets: {{a: {given}}}\n")
    assert told == [meant]


@pytest.mark.parametrize(
    ("kinetic", "meant"),
    [
        ("T: x'^2/2", "leave it out of the coordinates: r' occurs nowhere"),
        ("T: x'^2/2 + r'^2/2", "leave it out here, or give one of them another name"),
        ("T: x'^2/2 + r\u0307^2/2", "leave it out here, or give one of them another name"),
        (
            "points: {P: {position: [x, r], mass: 1}}",
            "leave it out here, or give one of them another name",
        ),
    ],
)
def test_a_parameter_among_the_coordinates_is_left_out_where_it_has_no_rate(kinetic, meant):
    told = hints(f"coordinates: [x, r]\nparameters: {{r: 2}}\n{kinetic}\nV: x^2/2\n")
    assert meant in told


def test_a_renamed_name_is_told_with_all_of_its_lines():
    told = hints(
        "coordinates: [beta]\nT: theta'^2/2\nV: cos(theta)\n"
        "forces: {beta: -beta'}\ninitial: {theta: 1}\n"
    )
    assert told == ["did you mean 'beta'? also in lines 3 and 5"]


def test_a_picture_hides_no_unit():
    told = found(
        "coordinates: {x: {unit: m}}\nparameters: {l: {unit: cm, value: 30}}\nT: x'^2/2\n"
        "initial: {x: l}\npicture: {springs: [[O, P]]}\n"
    )
    assert [each.span.line for each in told if each.is_error] == [2, 5]


def test_a_vector_hides_no_other_one():
    told = found(
        "coordinates: [x, y]\ndefinitions:\n  A: [-y, x]\n  v: [x', y']\nL: v^2/2 + dot(v, A)\n"
    )
    vectors = "a vector is written by its components:"
    [hint] = [each.hint for each in told]
    assert hint == (
        f"{vectors} A_x: -y, and on a line of its own A_y: x; "
        f"in line 4 {vectors} v_x: x', and on a line of its own v_y: y'; "
        "in line 5 write (x'^2 + y'^2)/2 + (x'*A_x + y'*A_y)"
    )


@pytest.mark.parametrize("form", ["[{}]", "({})", "{{x: x', y: y'}}"])
@pytest.mark.parametrize(("energy", "meant"), [("m*v^2/2", "m*(x'^2 + y'^2)/2"), ("m*x'^2", "")])
def test_a_vector_is_one_mistake_with_the_energy_of_its_square(form, energy, meant):
    vector = form.format("x', y'")
    [hint] = hints(
        f"coordinates: [x, y]\nparameters: [m]\ndefinitions:\n  v: {vector}\nL: {energy} + m*y'\n"
    )
    lines, _, law = hint.partition("; in line 5 write ")
    assert lines == (
        "a vector is written by its components: v_x: x', and on a line of its own v_y: y'"
    )
    assert law == (f"{meant} + m*y'" if meant else "")


FUNCTIONS = [
    ("U(x): k*x^2", "", "in place of functions write definitions: {U: k*x^2}; in line 6 write U"),
    ("U(x, t): k*x", "", "in place of functions write definitions: {U: k*x}; in line 6 write U"),
    ("U: k*x^2", "", "in place of functions write definitions: {U: k*x^2}; in line 6 write U"),
    (
        "U(x): k*x^2",
        "\n  W: [x]",
        "leave it out, and on a line of its own write definitions: {U: k*x^2}; in line 7 write U",
    ),
    (
        "U(s): k*s^2",
        "",
        "write its formula out, and leave functions out: in line 6 write V: (k*x^2)",
    ),
]


@pytest.mark.parametrize(("entry", "others", "meant"), FUNCTIONS)
def test_a_function_with_a_formula_is_one_mistake(entry, others, meant):
    call = "U(x, t)" if ", t" in entry else "U(x)"
    begin = "coordinates: [x]\nparameters: [m, k]\n"
    energies = f"T: m*x'^2/2\nV: {call}\n"
    assert hints(f"{begin}functions:\n  {entry}{others}\n{energies}") == [meant]


@pytest.mark.parametrize(
    ("polar", "cartesian"),
    [
        ("r, phi", "r*cos(phi), r*sin(phi)"),
        ("l, theta", "l*cos(theta), l*sin(theta)"),
        ("r, phi, z", "r*cos(phi), r*sin(phi), z"),
        ("r, theta, phi", "r*sin(theta)*cos(phi), r*sin(theta)*sin(phi), r*cos(theta)"),
        ("l, theta, phi", "l*sin(theta)*cos(phi), l*sin(theta)*sin(phi), l*cos(theta)"),
        ("x, phi", ""),  # no length
        ("l, x, z", ""),
        ("r, alpha", ""),  # a constant
        ("l", ""),
    ],
)
@pytest.mark.parametrize("unit", ["", "unit: m"])
def test_the_position_of_a_point_is_cartesian(polar, cartesian, unit):
    length = f"{{{unit}}}"
    given = (
        f"coordinates: {{x: {length}, r: {length}, z: {length}, theta: {{}}, phi: {{}}}}\n"
        f"parameters: {{m: {{}}, l: {length}, alpha: {{}}}}\nL: 0*m\n"
        f"points: {{P: {{position: [{polar}], mass: m}}}}\n"
    )
    told = hints(given)
    assert told == [f"write [{cartesian}]"] if cartesian else not any("cos" in x for x in told)
    assert not cartesian or not hints(given.replace(f"[{polar}]", f"[{cartesian}]"))
