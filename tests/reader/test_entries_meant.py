"""Entries under other words: what they are told to be is read as the same answer, or value."""

import random
import re
from fractions import Fraction

import pytest

from lagcli.reader import read_problem
from lagcli.values import off_constraints
from tests.reader.test_habits import messages, text

BEGIN = "coordinates: [x, theta]\nparameters: {m: 1, k: 2}\nT: m*(x'^2 + theta'^2)/2\n"
#: How others write the first and the second derivative.
FIRST = ("{0}_dot", "{0}dot", "d{0}", "v_{0}", "{0}'")
SECOND = ("{0}_ddot", "{0}ddot", "dd{0}", "{0}dd", "a_{0}", "{0}''")


def read(written, name="p.yaml"):
    return read_problem(name, (BEGIN + written).encode())


def only_hint(written):
    [only] = read(written).diagnostics
    return only.hint


@pytest.mark.parametrize("seed", range(4))
def test_accelerations_and_momenta_as_keys_of_the_answers(seed):
    draw = random.Random(seed)
    value = f"{draw.randrange(2, 9)}*k"
    for x in ("x", "theta"):
        second = draw.choice(SECOND).format(x)
        hint = only_hint(f"expect:\n  {second}: {value}\n")
        assert read(f"expect: {{{hint.removeprefix('write ')}}}\n").checked().expect.accelerations
        assert hint == f"write accelerations: {{{x}: {value}}}"
        momentum = draw.choice((f"p_{x}", f"p{x}"))
        assert only_hint(f"expect: {{{momentum}: {value}}}\n") == f"write momenta: {{{x}: {value}}}"
        assert only_hint(f"expect: {{accelerations: {{{second}: {value}}}}}\n") in {
            f"write {x}", f"did you mean '{x}'?"
        }  # fmt: skip


@pytest.mark.parametrize("form", SECOND)
def test_several_accelerations_are_one_answer(form):
    x, theta = form.format("x"), form.format("theta")
    whole = only_hint(f"expect:\n  {x}: 3\n  {theta}: 4\n")
    assert whole == "write accelerations: {x: 3, theta: 4}"
    equations = only_hint(f"expect: {{equations: {{{x}: 3, {theta}: 4}}}}\n")
    assert equations == "write [x'' = 3, theta'' = 4]"


@pytest.mark.parametrize("form", SECOND)
def test_an_acceleration_is_no_state(form):
    assert only_hint(f"initial: {{{form.format('theta')}: 3}}\n").startswith(
        "leave it out: a state"
    )
    assert only_hint(f"{form.format('x')}: 0\n").startswith("the equations of motion are derived")


@pytest.mark.parametrize("form", FIRST)
def test_a_velocity_is_no_part_of_an_equilibrium(form):
    given = f"{{theta: 0, {form.format('x')}: 0}}"
    hint = only_hint(f"expect: {{equilibria: [{{at: {given}}}]}}\n")
    assert hint == "leave it out: an equilibrium is given by its coordinates"


@pytest.mark.parametrize(
    "given",
    [
        "trajectory: {at: {t: 1, x: 3}}",
        "trajectory: {events: {t: 1, x: 3}}",
        "equilibria: {at: {x: 0}, stable: yes}",
        "equilibria: {one: {at: {x: 0}}, other: {at: {x: 1}}}",
        "steady_motions: {at: {x: 0}}",
        "algebra: {special: {where: k = 1, charges: 3}}",
    ],
)
def test_a_map_in_the_place_of_a_list_of_maps_is_an_item_of_it(given):
    line = f"expect: {{{given}}}\n"
    [only] = read(line).diagnostics
    begin, end = only.span.column - 1, only.span.end_column - 1
    whole = f"{line[:begin]}{only.hint.removeprefix('write ')}{line[end:]}"
    assert read(whole).checked()


@pytest.mark.parametrize("given", ["{stable: 0, unstable: 1}", "{x: [0, 1]}", "0"])
def test_what_is_no_item_of_a_list_is_shown_an_example(given):
    hint = only_hint(f"expect: {{equilibria: {given}}}\n")
    assert hint == "a list of places, as in [{at: {x: 0}, stable: yes}]"


@pytest.mark.parametrize("more", ["", ", stable: yes"])
def test_places_of_two_items_are_not_one(more):
    items = ", ".join(f"{{x: {place}{more}}}" for place in (0, 1))
    hint = only_hint(f"expect: {{equilibria: [{items}]}}\n")
    assert hint == "write at: {x: 0}; write at: {x: 1}"


def test_a_row_by_its_time_keeps_the_time():
    hint = only_hint("expect: {trajectory: {at: {1: {x: 3}, 2: {x: 4}}}}\n")
    assert hint == "write [{t: 1, x: 3}, {t: 2, x: 4}]"


@pytest.mark.parametrize(
    ("section", "item", "entry"),
    [
        ("observables", "own = x*p_x", "own: x*p_x"),
        ("contacts", "own = x >= 0", "own: x >= 0"),
        ("symmetries", "own = theta + e", "own: {theta: 1}"),
        ("find", "own = x where x'=0", "own: {where: x'=0, for: x}"),
    ],
)
def test_an_item_keeps_the_name_that_it_has(section, item, entry):
    assert only_hint(f"{section}:\n  - {item}\n") == f"write {{{entry}}}"


@pytest.mark.parametrize("use", ["k*F", "F + F'", "-F"])
def test_a_formula_among_the_functions_is_one_mistake(use):
    written = f"functions: {{F: m*sin(k*t)}}\nforces: {{x: {use}}}\n"
    hint = only_hint(written)
    assert hint.endswith("write definitions: {F: m*sin(k*t)}")
    assert read(f"{hint.partition('write ')[2]}\nforces: {{x: {use}}}\n").checked()


def test_each_key_is_said_with_its_place():
    points = "points:\n  left: {r: [x], mass: m}\n  right: {position: [theta], m: m}\n"
    [only] = read(points).diagnostics
    assert only.message == "unknown keys 'r' in the point 'left', 'm' in the point 'right'"
    assert only.hint == "the key is position; in line 6 it is mass"


@pytest.mark.parametrize("seed", range(4))
def test_several_values_are_a_command_with_the_numbers_of_the_file(seed):
    draw = random.Random(seed)
    first, step, steps = draw.randrange(9), draw.choice([0.5, 0.1, 0.25, 2]), draw.randrange(2, 9)
    last = round(first + step * steps, 10)
    given = BEGIN.replace("k: 2", f"k: {{value: {first}:{step}:{last}}}")
    [only] = read_problem("own.yaml", given.encode()).diagnostics
    run = f"lagcli sweep own.yaml --vary k={first}:{last}:{steps + 1}"
    assert only.hint == f"write {first}; several are run by {run}"
    values = [str(draw.randrange(1, 9)) for _ in range(3)]
    swept = only_hint(f"sweep: {{k: [{', '.join(values)}]}}\n")
    assert swept.endswith(f"lagcli sweep p.yaml --vary k={','.join(values)}")


@pytest.mark.parametrize("name", ["x", "x'"])
@pytest.mark.parametrize(
    ("given", "first", "varied"),
    [
        ("0:0.5:2", "0", "0:2:5"), ("1 to 3", "1", "1:3:3"), ("[1, 2, 4]", "1", "1,2,4"),
        ("linspace(0, 3, 10)", "0", "0:3:10"), ("np.linspace(1, 2, 5)", "1", "1:2:5"),
    ],
)  # fmt: skip
def test_several_initial_states_are_a_command(name, given, first, varied):
    option = f"{name}={varied}" if name == "x" else f'"{name}={varied}"'
    hint = f"write {first}; several are run by lagcli sweep p.yaml --vary {option}"
    assert only_hint(f"initial: {{{name}: {given}}}\n") == hint


@pytest.mark.parametrize("seed", range(4))
def test_a_number_of_turns_is_exact(seed):
    number = random.Random(seed).randrange(1, 999)
    given = f"parameters: {{m: {{unit: kg, value: 1}}, W: {{unit: rpm, value: {number}}}}}\n"
    written = f"coordinates: {{x: {{unit: m}}}}\n{given}T: m*(x'^2 + W^2*x^2)/2\n"
    [only] = read_problem("p.yaml", written.encode()).diagnostics
    unit, value = re.fullmatch(r"write unit: (.*), value: (.*)", only.hint).groups()
    above, below = re.fullmatch(r"(?:(\d+)\*)?pi(?:/(\d+))?", value).groups(default="1")
    assert (unit, Fraction(int(above), int(below))) == ("rad/s", Fraction(number * 2, 60))


@pytest.mark.parametrize("word", ["inputs", "actuators", "controls", "motors"])
def test_what_drives_along_coordinates_are_forces(word):
    assert only_hint(f"{word}: {{x: k*m}}") == "the key is forces"


@pytest.mark.parametrize("word", ["xyz", "origin", "end_point"])
def test_the_only_list_of_a_point_is_its_position(word):
    assert only_hint(f"points:\n  P: {{{word}: [x, x*theta], mass: m}}\n") == "the key is position"


@pytest.mark.parametrize("given", ["velocity: [x', 0]", "force: [k, 0]", "polar: [x, theta]"])
def test_a_list_that_is_something_else_is_no_position(given):
    assert "has no position" in read(f"points:\n  P: {{{given}}}\n").diagnostics[0].message


@pytest.mark.parametrize("forms", [("A[0]", "A[1]"), ("A[1]", "A[2]"), ("A[[1]]", "A[[2]]"),
                                   ("A.x", "A.y")])  # fmt: skip
def test_a_component_of_a_vector_has_its_name(forms):
    one, other = forms
    names = "definitions: {A_x: -k*theta, A_y: k*x}\n"
    hint = only_hint(f"{names}V: {one}*x + k*{other}*theta\n")
    assert hint == "write A_x*x + k*A_y*theta"


def test_an_index_that_may_be_of_two_components_is_not_taken_for_one():
    assert "write" not in only_hint("definitions: {A_x: k*x, A_y: k*theta}\nV: A[1]*x\n")[:5]


@pytest.mark.parametrize("value", ["3", "{value: 3}"])
@pytest.mark.parametrize("letter", ["r", "mu"])
def test_an_index_in_braces_belongs_to_the_name(letter, value):
    written = f"coordinates: [x]\nparameters:\n  {letter}_{{1}}: {value}\nT: x'^2/2\n"
    [only] = read_problem("p.yaml", written.encode()).diagnostics
    assert only.hint == f"write {letter}_1"


SEVERAL = [
    ("constraints", "roll: x' = k and theta' = m", "T: x'^2 + theta'^2\n"),
    ("contacts", "walls: 0 <= x <= k", "T: x'^2 + theta'^2\n"),
    ("contacts", "walls: {gap: 0 <= x <= k, restitution: 1}", "T: x'^2 + theta'^2\n"),
    ("definitions", "v: [x', k*theta']", "T: v_x^2 + v_y^2\n"),
    ("parameters", "R: [3, 4]", "T: R_1*x'^2 + R_2*theta'^2\n"),
]


@pytest.mark.parametrize(("section", "entry", "energy"), SEVERAL)
def test_several_entries_for_one_are_lines_of_a_block_and_entries_of_braces(section, entry, energy):
    begin = f"coordinates: [x, theta]\n{energy}"
    begin += "" if section == "parameters" else "parameters: {m: 1, k: 2}\n"

    def errors(written):
        return read_problem("p.yaml", f"{begin}{section}:{written}".encode()).diagnostics

    def proposed(written):
        [only] = errors(written)
        return re.sub(r"^.*(?:name|components): |^write |; several.*", "", only.hint)

    lines = re.split(", and on a line of its own ", proposed(f"\n  {entry}\n"))
    assert len(lines) == 2
    assert not errors("".join(f"\n  {each}" for each in lines))
    assert not errors(f" {{{proposed(f' {{{entry}}}')}}}")


@pytest.mark.parametrize("seed", range(6))
def test_an_entry_of_a_section_that_the_file_has_goes_there(seed):
    draw = random.Random(seed)
    name, value, rate = draw.choice(["gamma", "w0", "w1"]), draw.randrange(2, 9), draw.choice("xy")
    begin = "coordinates: [x, y]\nT: m*(x'^2 + y'^2)/2\n"
    for given, wrong, entry in (
        ("parameters: {m: 1}", f"{name}: {value}", f"{name}: {value}"),
        ("parameters: {m: 1}\ninitial: {x: 1}", f"v_y: {value}", f"y': {value}"),
        ("parameters: {m: 1}\nforces: {x: -m}", f"F_y: {value}*m", f"y: {value}*m"),
        ("parameters: {m: 1}\nforces: {x: -m}", f"F_x: m*{rate}", f"x: -m + m*{rate}"),
    ):
        block = re.sub(r": \{(\w+)", r":\n  \1", given).replace("}", "")
        text = f"{begin}{wrong}\n{block}\n"
        [only] = read_problem("p.yaml", text.encode()).diagnostics
        section = block.split("\n")[-2]
        assert only.hint.endswith(f"{section} write {entry}")
        line = block.split("\n")[-1] + "\n"
        typed = re.sub(rf"  {entry.partition(':')[0]}:.*\n|$", "", line) + f"  {entry}\n"
        mended = f"{begin}{block}\n".replace(line, typed)
        assert read_problem("p.yaml", mended.encode()).checked()
        text = f"{begin}{wrong}\n{given}\n"
        [only] = read_problem("p.yaml", text.encode()).diagnostics
        whole = only.hint.partition("write all as ")[2]
        key = whole.partition(":")[0]
        mended = re.sub(rf"^{key}: .*", whole, f"{begin}{given}\n", flags=re.MULTILINE)
        assert entry in whole
        assert read_problem("p.yaml", mended.encode()).checked()


def test_names_of_a_list_stay_beside_an_entry_with_a_value():
    begin = "coordinates: [x]\nparameters: [m, k]\nT: m*x'^2/2\nV: k*x^2/2\n"
    [only] = read_problem("p.yaml", f"{begin}c: 3\n".encode()).diagnostics
    assert only.hint.endswith("write all as parameters: {m, k, c: 3}")


def test_the_force_on_a_point_has_the_key_force():
    points = "points: {P: {position: [x, theta], mass: m, F: [k, 0]}}\n"
    assert only_hint(points) == "the key is force"
    assert read(points.replace("F:", "force:")).diagnostics == ()


def test_a_coordinate_is_not_a_parameter_as_well():
    both = BEGIN.replace("k: 2", "k: 2, theta: {unit: rad}").encode()
    [found] = read_problem("p.yaml", both).diagnostics
    assert (found.message, found.hint[:17]) == ("'theta' is declared twice", "leave it out here")


def test_an_integer_has_an_attribute_of_its_own():
    written = BEGIN.replace("k: 2", "n: {assume: integer}")
    [found] = read_problem("p.yaml", written.encode()).diagnostics
    assert found.hint == "in place of assume write integer: yes"
    assert read_problem(
        "p.yaml", written.replace("assume: integer", "integer: yes").encode()
    ).problem


@pytest.mark.parametrize("comment", ["# k' is stiff", "# with k' and m"])
def test_a_name_that_is_none_is_not_looked_for_in_comments(comment):
    written = f"{comment}\n" + BEGIN.replace("k: 2", "k: 2, k': 3") + "V: k*x^2 + k'*theta^2 # k'\n"
    [found] = read_problem("p.yaml", written.encode()).diagnostics
    assert found.hint == "write k2: a prime is a velocity"
    assert [place.line for place, _ in found.related] == [5]


def test_a_start_inside_of_a_wall_is_shown_where_it_is_written():
    contact = "contacts: {wall: {gap: x >= k, restitution: 0.5}}\ninitial: {theta: 0, x: 1}\n"
    [found] = off_constraints(read(contact).checked())
    assert (found.span.line, found.span.column) == (5, 24)
    assert found.hint == "start where x >= k: write x: k"


BEAD = """coordinates: [theta]
parameters: {{m: {{assume: positive}}, l: {{assume: positive}}{}}}
T: {}
"""


@pytest.mark.parametrize("taken", [[], ["u"], ["v"], ["u", "v"], ["u", "w", "u_1"]])
def test_each_total_derivative_has_a_definition_of_its_own_name(taken):
    declared = "".join(f", {name}: {{}}" for name in taken)
    energy = "m*((l*sin(theta))'^2 + d(l*cos(theta))/dt*(l*cos(theta))')/2"
    [found] = messages(BEAD.format(declared, energy))
    first, second = [each for each in ("u", "v", "w", "u_1", "u_2") if each not in taken][:2]
    given = f"definitions: {{{first}: l*sin(theta), {second}: l*cos(theta)}}"
    assert found.endswith(f"{given} and here m*({first}'^2 + {second}'*{second}')/2")
    better = found.partition(" and here ")[2]
    assert messages(BEAD.format(declared, better) + f"{given}\n") == []


def test_a_definition_beside_others_is_added_to_them():
    energy = "m*(u'^2 + (l*cos(theta))'^2)/2\ndefinitions: {u: l*sin(theta)}"
    [found] = messages(BEAD.format("", energy))
    assert found.endswith("under definitions v: l*cos(theta) and here m*(u'^2 + v'^2)/2")


@pytest.mark.parametrize(("left", "right"), ["[]", "()"])
def test_a_factor_before_a_list_multiplies_each_component(left, right):
    position = f'"l*{left}sin(x), -cos(x){right}"'
    points = f"{{bob: {{position: {position}, mass: m}}}}"
    [found] = messages(text(T=None, V=None, parameters="{m: 1, l: 2}", points=points))
    assert found.endswith("; write [l*sin(x), -l*cos(x)]")


@pytest.mark.parametrize(("force", "name"), [("5 N", "F"), ("-5 N", "-F"), ("2.5 J", "E")])
@pytest.mark.parametrize("taken", ["", "F: {unit: N}, "])
def test_a_force_with_a_unit_is_declared_where_the_file_has_units(force, name, taken):
    letter = name.lstrip("-")
    given = f"{{{taken.replace('F', letter)}m: {{unit: kg}}}}"
    file = {"coordinates": "{x: {unit: m}}", "parameters": given, "T": "m*x'^2/2", "V": None}
    [found] = messages(text(**file, forces=f"{{x: {force}}}"))
    name += "_0" * bool(taken)
    value, unit = force.lstrip("-").split()
    declared = f"{name.lstrip('-')}: {{unit: {unit}, value: {value}}}"
    assert found.endswith(f"declare {declared} under parameters, and write {name}")
    [found] = messages(text(**file, forces="{x: 2.5 kN}"))
    assert "write 2.5 with kN, 2500 with" in found


def test_a_contact_in_a_list_is_given_a_name():
    for item in ("gap: x >= 0\n    restitution: 0.7", "restitution: 0.7\n    gap: x >= 0"):
        [found] = messages(text(contacts=f"\n  - {item}"))
        inner = item.replace("\n    ", ", ")
        assert found.endswith(f"write name: {{{inner}}}, without '-'")


def test_energies_in_an_observable_are_underlined_as_one():
    written = text(observables="{E: T + V}")
    [found] = read_problem("p.yaml", written.encode()).diagnostics
    line = written.split("\n")[found.span.line - 1]
    assert line[found.span.column - 1 : found.span.end_column - 1] == "T + V"


@pytest.mark.parametrize(("rest", "lost"), [("", "it"), (" - c*x'", "-m_a*x''")])
def test_an_added_mass_belongs_to_the_kinetic_energy(rest, lost):
    forces = f"{{x: -m_a*x''{rest}}}"
    [found] = messages(text(parameters="{m: 1, k: 2, m_a: 1, c: 1}", forces=forces))
    assert found.endswith(f"leave {lost} out here and add m_a*x'^2/2 to T")


def test_an_energy_that_is_not_read_is_not_missing():
    [found] = messages(text(T="m*x'^2/2 + ...\n   m*x'^2/2"))
    assert found.startswith("'.' has no meaning")


@pytest.mark.parametrize("seed", range(12))
def test_an_attribute_without_its_colon_or_its_braces(seed):
    draw = random.Random(seed)
    name, text = draw.choice(
        [("assume", "positive"), ("assume", "nonzero"), ("unit", "N/m"), ("value", "4")]
    )
    equals, brace = draw.choice(["", "= "]), draw.choice(["{%s}", "%s"])
    whole = f"{{{name}: {text}}}"
    for written in (brace % f"{name} {equals}{text}", f"{name}: {text}"):
        given = f"coordinates: [x]\nparameters:\n  m: 1\n  k: {written}\nT: m*x'^2/2\nV: k*x^2/2\n"
        [only] = read_problem("p.yaml", given.encode()).diagnostics
        proposed = only.hint.removeprefix("write ").removeprefix("k: ")
        assert proposed in {whole, whole[1:-1]}
        pasted = given.replace(written, whole)
        assert read_problem("p.yaml", pasted.encode()).diagnostics == ()


@pytest.mark.parametrize(
    "words",
    ["real, positive", "positive, real", "nonnegative, nonzero", "positive, constant, real"],
)
def test_assumptions_with_commas_are_one_word(words):
    given = f"coordinates: [x]\nparameters: {{m: 1, k: {{assume: {words}, unit: N/m}}}}\nT: m*x'^2/2\nV: k*x^2/2\n"
    [only] = read_problem("p.yaml", given.encode()).diagnostics
    assert only.hint == "write assume: positive"
    alone = given.replace(f"assume: {words}", "positive")
    [only] = read_problem("p.yaml", alone.encode()).diagnostics
    assert only.hint == "write assume: positive"


@pytest.mark.parametrize("law", ["k*(left - right)^2/2", "k*left"])
def test_a_point_in_a_formula_is_not_a_parameter(law):
    begin = (
        "coordinates: [u, w]\nparameters: [m, k]\npoints:\n  left: {position: [u, 0], mass: m}\n"
    )
    text = f"{begin}  right: {{position: [w, k], mass: m}}\nV: {law}\n"
    hints = [each.hint for each in read_problem("p.yaml", text.encode()).diagnostics]
    assert any(each.startswith("a vector, whose components are u, 0") for each in hints)
    assert not any("parameters" in each for each in hints)


@pytest.mark.parametrize("word", ["tol", "toler"])
def test_a_key_of_a_trajectory_cut_short_is_not_a_column(word):
    hint = only_hint(f"expect: {{trajectory: {{x: 1, {word}: 1e-6}}}}\n")
    assert hint == "the key is tolerance"


def test_events_by_names_are_not_made_to_columns():
    hint = only_hint("expect: {trajectory: {events: {zero: 1}, until: 5}}\n")
    assert hint == "a list of rows, as in [{t: 1, what: impact}]"


@pytest.mark.parametrize("sign", ["=", "==", "!="])
def test_a_gap_has_another_sign(sign):
    hint = only_hint(f"contacts: {{wall: {{gap: x {sign} k, restitution: 0.5}}}}\n")
    assert hint == "write x >= k"


@pytest.mark.parametrize(
    ("given", "hint"),
    [
        ("trails: yes", "a list of points, as in [bob, ball]"),
        ("trails: bob", "write [bob]"),
        ("rods: {rod: [bob, ball]}", "write [[bob, ball]]"),
        ("rods: {bob: ball}", "write [[bob, ball]]"),
        ("springs: [[[0, 0], bob]]", "write picture: {places: {O: [0, 0]}, springs: [[O, bob]]}"),
    ],
)
def test_a_picture_is_of_the_points_of_the_file(given, hint):
    begin = "coordinates: [u, w]\nparameters: [m]\npoints:\n  bob: {position: [u, 0], mass: m}\n"
    text = f"{begin}  ball: {{position: [w, 1], mass: m}}\nV: 0\npicture: {{{given}}}\n"
    [found] = read_problem("p.yaml", text.encode()).diagnostics
    assert found.hint == hint
    if hint.startswith("write ["):
        text = f"{text.partition('picture')[0]}picture: {{{given.partition(':')[0]}: {hint[6:]}}}\n"
        assert read_problem("p.yaml", text.encode()).diagnostics == ()


def test_a_transformation_in_one_text_is_a_map():
    begin = (
        "coordinates: [x]\nparameters: [m]\nH: p_x^2/(2*m)\ncanonical_transformations:\n  swap: "
    )
    [found] = read_problem("p.yaml", f"{begin}Q = p_x, p_Q = -x\n".encode()).diagnostics
    assert found.hint == "write swap: {Q: p_x, p_Q: -x}"
    assert read_problem("p.yaml", f"{begin}{found.hint[12:]}\n".encode()).diagnostics == ()
