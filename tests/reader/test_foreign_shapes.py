"""Sections in the shapes of other programs: one mistake, whose hint can be put in its place."""

from __future__ import annotations

import math
import random
import re

import pytest

from lagcli.expression import FUNCTIONS
from lagcli.reader import read_problem
from lagcli.reader.foreign.vectors import components
from tests.reader.test_habits import messages, text

PENDULUM = {
    "coordinates": "[theta]",
    "parameters": "{m: 1, l: 2, g: 9.81}",
    "T": None,
    "V": "-m*g*l*cos(theta)",
}


def mistakes_of(written):
    return read_problem("p.yaml", written.encode()).diagnostics


def only_mistake(written):
    found = mistakes_of(written)
    assert len(found) == 1, [each.message for each in found]
    return found[0]


def put_in(written):
    """The file with what the hint of its only mistake proposes in the place of the mistake."""
    mistake = only_mistake(written)
    proposed = re.search(r"(?:write|as in|mean) ([^?]*)\??$", mistake.hint)
    assert proposed is not None, mistake.hint
    lines = written.split("\n")
    line = lines[mistake.span.line - 1]
    assert mistake.span.line == mistake.span.end_line
    before, after = line[: mistake.span.column - 1], line[mistake.span.end_column - 1 :]
    lines[mistake.span.line - 1] = before + proposed[1] + after
    return "\n".join(lines)


X, Y = ["l*sin(theta)", "x + l*cos(theta)", "l", "2*l*theta"], ["-l*cos(theta)", "3*l", "l*theta"]
NOTATIONS = [
    lambda x, y: f"({x})*N.x + ({y})*N.y",
    lambda x, y: f"({x}) i + ({y}) j",
    lambda x, y: f"({x})*i + ({y})*j",
    lambda x, y: f"({x})*ihat + ({y})*jhat",
    lambda x, y: f"e_x*({x}) + e_y*({y})",
    lambda x, y: rf"({x}) \hat{{x}} + ({y}) \hat{{y}}",
    lambda x, y: f"<{x}, {y}>",
    lambda x, y: f"({x}, {y})",
    lambda x, y: f"np.array([{x}, {y}])",
    lambda x, y: f"Matrix([[{x}], [{y}]])",
    lambda x, y: f"Vector({x}, {y})",
    lambda x, y: rf"\begin{{pmatrix}} {x} \\ {y} \end{{pmatrix}}",
]


@pytest.mark.parametrize("notation", NOTATIONS)
def test_a_vector_is_told_its_components(notation):
    draw = random.Random(NOTATIONS.index(notation))
    for _ in range(3):
        x, y = draw.choice(X).replace("x", "theta"), draw.choice(Y)
        written = text(**PENDULUM, points=f"\n  bob:\n    mass: m\n    position: {notation(x, y)}")
        mended = read_problem("p.yaml", put_in(written).encode())
        assert mended.diagnostics == ()
        listed = text(**PENDULUM, points=f"\n  bob:\n    mass: m\n    position: [{x}, {y}]")
        right = read_problem("p.yaml", listed.encode()).problem
        values = [[str(each) for each in problem.points[0].position]
                  for problem in (mended.problem, right)]  # fmt: skip
        assert values[0] == values[1]


@pytest.mark.parametrize(
    ("written", "axes"),
    [
        ("l*sin(theta) -l*cos(theta)", ["l*sin(theta)", "-l*cos(theta)"]),
        ("(l*sin(theta) -l*cos(theta))", ["l*sin(theta)", "-l*cos(theta)"]),
        ("{l*sin(theta) -l*cos(theta)}", ["l*sin(theta)", "-l*cos(theta)"]),
        ("l + l*sin(theta) -l*theta", ["l + l*sin(theta)", "-l*theta"]),
        ("0 -l*cos(theta) -theta", ["0", "-l*cos(theta)", "-theta"]),
        ("theta l*cos(theta)", ["theta", "l*cos(theta)"]),
        ("l*theta - l*cos(theta)", ["l*theta - l*cos(theta)"]),
    ],
)
def test_blanks_between_components_become_commas(written, axes):
    mended = put_in(text(**PENDULUM, points=f"\n  bob:\n    mass: m\n    position: {written}"))
    assert mended.endswith(f"position: [{', '.join(axes)}]\n")
    assert mistakes_of(mended) == ()


@pytest.mark.parametrize(
    "written", ["l sin(theta) -l cos(theta)", "l sin(theta)", "l + theta l -l"]
)
def test_a_blank_that_may_be_a_product_is_not_taken_for_a_comma(written):
    points = f"\n  bob:\n    mass: m\n    position: {written}"
    hint = only_mistake(text(**PENDULUM, points=points)).hint
    assert hint == "a comma stands between components, as in [x, y]"


@pytest.mark.parametrize("name", ["a", "m*g", "k*(a + 1)"])
def test_a_factor_before_a_vector_multiplies_each_component(name):
    assert components(f"{name}*(x, -y, 0)", {"k"}) == [f"{name}*x", f"-{name}*y", "0"]
    assert components(f"{name}*(x + 1, y)", {"k"}) == [f"{name}*(x + 1)", f"{name}*y"]


@pytest.mark.parametrize(
    "formula", ["k*x", "atan2(y, x)", "m*atan2(y, x)", "k*(a)*atan2(y, x)", "a + b*(x, y)", "x + y"]
)
def test_a_formula_is_no_vector(formula):
    assert components(formula, {"k", "x", "y"}, 2) == []


def test_components_with_unit_vectors_are_one_mistake():
    written = text(**PENDULUM, points="{bob: {mass: m, position: [l*sin(theta) i, 2*l j]}}")
    assert put_in(written).count("[l*sin(theta), 2*l]") == 1


@pytest.mark.parametrize(
    ("force", "hint"),
    [("-m*g", "as in [0, -m*g]"), ("{y: -m*g}", "write [0, -m*g]"), ("-m*g*j", "write [0, -m*g]"),
     ("m*g*(1, -1)", "write [m*g*1, -m*g*1]"), ("m*g down", "write [0, -m*g]"),
     ("-m*g downwards", "write [0, -m*g]"), ("m*g (nach unten)", "write [0, -m*g]"),
     ("vertically up m*g", "write [0, m*g]"), ("m*g + l to the left", "write [-(m*g + l), 0]"),
     ("l to the right", "write [l, 0]"), ("m*g north", "for each of the position's")],
)  # fmt: skip
def test_a_force_on_a_point_has_the_components_of_its_position(force, hint):
    points = f"\n  bob:\n    mass: m\n    position: [l*theta, 0]\n    force: {force}"
    assert only_mistake(text(**PENDULUM, points=points)).hint.endswith(hint)


@pytest.mark.parametrize(
    ("place", "meant"),
    [
        ("r: l, theta: theta", "[l*cos(theta), l*sin(theta)]"),
        ("radius: l + g, angle: theta", "[(l + g)*cos(theta), (l + g)*sin(theta)]"),
        ("rho: l, phi: theta, z: g", "[l*cos(theta), l*sin(theta), g]"),
        (
            "r: l, theta: g, phi: theta",
            "[l*sin(g)*cos(theta), l*sin(g)*sin(theta), l*cos(g)]",
        ),
        ("x: l*theta, z: g", "[l*theta, 0, g]"),
    ],
)
@pytest.mark.parametrize("mass", ["mass", "m"])
def test_a_place_by_its_coordinates_is_one_mistake(place, meant, mass):
    points = f"\n  bob: {{{place}, {mass}: m}}"
    hint = only_mistake(text(**PENDULUM, points=points)).hint
    assert hint == f"write bob: {{position: {meant}, mass: m}}"
    within = f"\n  bob: {{position: {{{place}}}, mass: m}}"
    assert only_mistake(text(**PENDULUM, points=within)).hint == f"write {meant}"


@pytest.mark.parametrize("seed", range(8))
def test_names_below_a_heading_are_told_without_it(seed):
    draw = random.Random(seed)
    word = draw.choice(["masses", "cartesian", "body_1", "Geometry"])
    names = draw.sample(["x", "y", "phi", "q_1", "s"], draw.randrange(2, 4))
    listed = f"[{', '.join(names)}]"
    kinetic = " + ".join(f"{name}'^2" for name in names)
    written = text(coordinates=f"\n  {word}: {listed}", T=kinetic, V=None, parameters=None)
    assert only_mistake(written).hint == f"write {listed}"
    valued = ", ".join(f"{name}: {draw.randrange(1, 9)}" for name in names)
    written = text(parameters=f"\n  m: 1\n  {word}: {{{valued}}}", T="m*x'^2", V=None)
    if "x" not in names:
        assert only_mistake(written).hint == f"write {{m: 1, {valued}}}"


@pytest.mark.parametrize("unit", ["kg", "N/m", "[1, kg]", "[m]", "{units: kg}", "{min: 0}"])
def test_what_is_no_heading_is_not_taken_for_one(unit):
    assert "names stand below it" not in messages(text(parameters=f"{{m: {unit}, k: 2}}"))[0]


@pytest.mark.parametrize("seed", range(8))
def test_a_state_below_headings_is_told_without_them(seed):
    draw = random.Random(seed)
    x, y, u, v = (str(draw.randrange(9)) for _ in range(4))
    place, rate = draw.choice([("positions", "velocities"), ("q", "qdot"), ("pos", "vel_rates")])
    system = {"coordinates": "[x, y]", "T": "m*(x'^2 + y'^2)/2"}
    shapes = [
        f"\n  {place}: {{x: {x}, y: {y}}}\n  {rate}: {{x: {u}, y: {v}}}",
        f"\n  {place}: [{x}, {y}]\n  {rate}: [{u}, {v}]",
        f"\n  {place}: {{x: {x}, y: {y}}}\n  {rate}: {{x': {u}, y': {v}}}",
    ]
    for shape in shapes:
        hint = only_mistake(text(**system, initial=shape)).hint
        assert hint == f"write {{x: {x}, y: {y}, x': {u}, y': {v}}}"
    by_name = f"\n  x: {{value: {x}, velocity: {u}}}\n  y: {{value: {y}, velocity: {v}}}"
    hint = only_mistake(text(**system, initial=by_name)).hint
    assert hint == f"write {{x: {x}, x': {u}, y: {y}, y': {v}}}"


def test_forces_by_their_causes_are_told_as_sums():
    forces = "{weight: {x: -m*g}, drag: {x: -k*x'}}"
    assert only_mistake(text(forces=forces)).hint == "write {x: -m*g - k*x'}"


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("form", ["{}dot", "{}_dot", "{}.dot", "{}.diff(t)", "d{}/dt", "v_{}"])
def test_a_definition_has_velocities_in_other_notations_too(form, order):
    names = ["y_1", "h"][:order]
    definitions = "{" + ", ".join(f"{name}: k*sin(x)^{i + 1}" for i, name in enumerate(names)) + "}"
    kinetic = " + ".join(f"m*{form.format(name)}^2" for name in names)
    if "/" in form:
        kinetic = kinetic.replace("d", "(d").replace("dt", "dt)").replace("(dt)", "dt)")
    hint = only_mistake(text(definitions=definitions, T=f'"{kinetic}"')).hint
    assert hint == "write " + " + ".join(f"m*{name}'^2" for name in names)


@pytest.mark.parametrize("seed", range(8))
def test_numbers_of_other_tongues_and_programs(seed):
    draw = random.Random(seed)
    whole, part = draw.randrange(1000, 9_999_999), draw.randrange(100)
    english = f"{whole:,}.{part:02}"
    german = english.translate(str.maketrans(",.", ".,"))
    for written in (english, german):
        hint = only_mistake(text(parameters=f"\n  m: {written}\n  k: 2")).hint
        assert hint == f"write {whole}.{part:02}"
    power = draw.randrange(-30, 30)
    hint = only_mistake(text(parameters=f"{{m: 1, k: {part}*^{power}}}")).hint
    assert hint == f"write {part}e{power}"


@pytest.mark.parametrize("key", ["initial", "points", "forces", "constraints", "symmetries"])
@pytest.mark.parametrize("around", ["simulation", "picture"])
def test_a_key_of_the_problem_within_another_is_told_where_it_stands(around, key):
    within = only_mistake(text(**{around: f"{{{key}: {{x: 1}}}}"}))
    assert within.hint == f"a key of the problem: write {key}: {{x: 1}} on a line of its own"


def test_unknown_keys_with_one_advice_are_one_mistake():
    found = only_mistake(text(coordinates="{x: {min: 0, max: 1}}"))
    assert found.message == "unknown keys 'min', 'max' in the coordinate 'x'"
    assert len(read_problem("p", text(foo="[]", bar="[]").encode()).diagnostics) == 2


HINTS = [
    (text(coordinates="polar", T="m*r'^2"), "write their names, as in [r, phi]"),
    (text(coordinates="plane polar", T="m*r'^2"), "[r, phi]"),
    (text(T=None, V=None, L="{T: m*x'^2/2, V: k*x^2}"), "T and V begin lines of their own"),
    (text(T=None, V=None, L="{kinetic: m*x'^2/2, potential: k*x^2}"), "T and V begin lines"),
    (text(H="T + V"), "leave out H"),
    (text(initial="{p_x: 1}"), "not momenta: write x': 1/m"),
    (text(initial="{x: 1, energy: 3}"), "give x'"),
    (text(initial="np.zeros(2)"), "what is not given is 0"),
    (text(simulation="{until: x = 0}"), '--stop-when "x"'),
    (text(simulation="{until: x > 5}"), '--stop-when "x - 5"'),
    (text(events="{landing: x = 0}"), '--stop-when "x"'),
    (text(events="{top: {when: x' <= g + k}}"), """--stop-when "x' - (g + k)\""""),
    (text(event="x' = 0"), """--stop-when "x'\""""),
    (text(stop_when="x - 2 == k"), '--stop-when "x - 2 - k"'),
    (text(simulation="{terminate: x = 3}"), '--stop-when "x - 3"'),
    (text(simulation="{until: t = 5}"), "write 5"),
    (text(contacts="{floor: {gap: x, restitution: fully inelastic}}"), "write 0"),
    (text(contacts="{floor: {gap: x, restitution: elastic}}"), "write 1"),
    (text(contacts="{floor: {gap: x, mu: 0.1}}"), "a contact has no friction"),
    (text(symmetries="rotation", coordinates="[r, phi]", T="m*(r'^2 + phi'^2)", V="k*r"),
     "write {rotation: {phi: 1}}"),
    (text(symmetries="time translation"), "write {time_translation: {t: 1}}"),
    (text(stiffness="100 N/m", V="stiffness*x^2/2"), "g: 9.81, stiffness: {value: 100, unit: N/m}}"),
    (text(parameters="{m: mass of the bob, k: constant of the spring}"), "and so for k"),
    (text(T="m*x'^2/2 (* kinetic *)"), "a comment begins with '#'"),
    (text(**PENDULUM | {"T": "m*theta'^2", "V": "-m*g*l*COS(THETA)"}), "-m*g*l*cos(theta)?"),
    (text(parameters="[m, k_0]", V="k₀x²"), "write k_0*x^2"),
    (text(coordinates="[q(1), q(2)]", T="q(1)'^2 + q(2)'^2", V=None), "write [q_1, q_2]"),
    (text(parameters="{m -> 1, k -> 2}"), "write {m: 1, k: 2}"),
    (text(points="{P: {position: [x], mass: m, velocity: [x']}}"), "follows from the position"),
    (text(picture="{rods: [O, P]}"), "write [[O, P]]"),
    (text(picture="{rods: {O: P}}"), "write [[O, P]]"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint"), HINTS)
def test_a_shape_gets_one_mistake_with_the_hint_that_helps(written, hint):
    found = messages(written)  # the second is what the first hides
    assert len(found) <= 2
    assert any(hint in each for each in found)


PHASE = "coordinates: [x]\nH: p_x^2/2 + x^2/2\nobservables: {A: x^2, B: p_x^2}\n"


@pytest.mark.parametrize("shape", ['"{A, B}"', "[A, B]", '"[A, B]"', '"(A, B)"'])
def test_a_bracket_without_its_name_is_told_it(shape):
    found = only_mistake(f"{PHASE}brackets: {shape}\n")
    assert found.hint == "write {name: [A, B]}"
    mended = f"{PHASE}brackets: {found.hint.removeprefix('write ')}\n"
    assert read_problem("p", mended.encode()).diagnostics == ()


@pytest.mark.parametrize(
    ("shape", "hint"),
    [
        ("{Q: p_q, P: -q}", "write name: {Q: p_q, p_Q: -q}"),
        ("{swap: {Q: p_q, P: -q}}", "write p_Q"),
        ("{swap: {Q: p_q, p_P: -q}}", "write p_Q"),
        ("{swap: {Q: p_q}}", "write swap: {Q: p_q, p_Q: -q}"),
        ("{swap: {R: q^2}}", "as in swap: {R: p_q, p_R: -q}"),
        ("[Q]", "write name: {Q: p_q, p_Q: -q}"),
    ],
)
def test_a_transformation_is_told_in_the_names_of_the_file(shape, hint):
    phase = PHASE.replace("x", "q")
    assert only_mistake(f"{phase}canonical_transformations: {shape}\n").hint == hint


def test_several_new_momenta_are_named_after_their_coordinates():
    phase = "coordinates: [q, s]\nH: p_q^2/2 + p_s^2/2\n"
    new = "{Q2: s, Q1: p_q, P1: -q, P2: p_s}"
    found = only_mistake(f"{phase}canonical_transformations: {{swap: {new}}}\n")
    assert found.hint == "write p_Q1; for 'P2' write p_Q2"
    found = only_mistake(f"{phase}canonical_transformations: {{swap: {{Q: q, p_Q: p_q}}}}\n")
    assert found.hint == "as in swap: {Q_1: p_q, p_Q_1: -q, Q_2: p_s, p_Q_2: -s}"


@pytest.mark.parametrize("name", ["theta", "q", "s_1"])
def test_an_example_has_the_coordinate_of_the_file(name):
    written = f"coordinates: [{name}]\nT: {name}'^2/2\nmomenta: [p]\n"
    assert only_mistake(written).hint == f"leave out the key: momenta are named p_{name}"
    assert "p_x" in only_mistake(written + "title: along x\n").hint


@pytest.mark.parametrize("name", ["omega", "w_0", "Ω"])
@pytest.mark.parametrize("formula", ["sqrt(k/m)", "k*x", "x'/2"])
def test_a_formula_with_a_name_that_others_use_stands_under_definitions(name, formula):
    hint = only_mistake(text(V=f"m*{name}*x^2/2", **{name: formula})).hint
    assert (
        hint
        == f"a formula with a name stands under definitions: write definitions: {{{name}: {formula}}}"
    )
    mended = text(V=f"m*{name}*x^2/2", definitions=f'{{{name}: "{formula}"}}')
    assert messages(mended) == []
    unused = only_mistake(text(Zeta_1=formula))
    assert "definitions:" not in unused.hint


@pytest.mark.parametrize("seed", range(6))
def test_a_number_with_its_unit_behind_a_comma(seed):
    draw = random.Random(seed)
    number, unit = draw.choice(["1", "2.5", "1e3"]), draw.choice(["kg", "N/m", "m/s^2", "rad"])
    comma = draw.choice([", ", "; ", " ", ""])
    mistake = only_mistake(text(parameters=f"\n  m: {number}{comma}{unit}\n  k: 2"))
    assert mistake.hint == f"write {{value: {number}, unit: {unit}}}"


@pytest.mark.parametrize("number", range(1, 13))
def test_a_factorial_is_a_number(number):
    product = 1
    for factor in range(1, number + 1):
        product *= factor
    assert only_mistake(text(V=f"k*x^4/{number}!")).hint == f"write k*x^4/{product}"
    assert only_mistake(text(V="k*x!")).hint == "there is no factorial"


@pytest.mark.parametrize("bars", ["|r|", "||r||", r"|\vec{r}|", r"\|\mathbf{r}\|"])
@pytest.mark.parametrize("axes", ["xy", "xyz"])
def test_the_length_of_a_position_is_written_by_its_components(bars, axes):
    kinetic = " + ".join(f"{axis}'^2" for axis in axes)
    squares = " + ".join(f"{axis}^2" for axis in axes)
    coordinates = f"[{', '.join(axes)}]"
    hint = only_mistake(text(coordinates=coordinates, T=f"m*({kinetic})/2", V=f"-k/{bars}")).hint
    assert hint == f"write -k/sqrt({squares})"
    coordinates = f"[{', '.join(axes)}, r]"
    read = text(coordinates=coordinates, T=f"m*({kinetic} + r'^2)/2", V="-k/|r|")
    assert only_mistake(read).hint == "write -k/abs(r)"


@pytest.mark.parametrize("angle", ["phi", "theta", "φ"])
@pytest.mark.parametrize("radius", ["r", "rho", "s"])
@pytest.mark.parametrize("before", ["v", "v_"])
def test_the_speed_along_an_angle_is_no_angular_velocity(angle, radius, before):
    polar = text(
        coordinates=f"[{radius}, {angle}]", T=f"m*({radius}'^2 + {before}{angle}^2)", V=None
    )
    hint = only_mistake(polar).hint
    assert hint == f"the speed along {angle} is {radius}*{angle}'"
    alone = text(coordinates=f"[{angle}]", T=f"m*{before}{angle}^2/2", V=None)
    assert only_mistake(alone).hint == f"write m*{angle}'^2/2"


@pytest.mark.parametrize("form", ["{}dot", "{}_dot", "d{}", "v_{}", "{}_t"])
@pytest.mark.parametrize("name", ["x", "theta", "q_1"])
def test_a_velocity_among_the_coordinates_is_pointed_out_once(form, name):
    rate = form.format(name)
    written = text(coordinates=f"[{name}, {rate}]", T=f"m*{rate}^2/2", V=f"k*{name}^2")
    assert only_mistake(written).hint == f"leave it out, and write {name}'"
    moving = text(coordinates=f"[{name}, {rate}]", T=f"m*({name}'^2 + {rate}'^2)/2", V=None)
    assert messages(moving) == []


@pytest.mark.parametrize("parameter", ["eps", "ε", "s", "delta"])
def test_a_change_without_its_small_parameter(parameter):
    plane = {"coordinates": "[x, y]", "T": "m*(x'^2 + y'^2)/2"}
    written = f"{{turn: {{x: {parameter}*(-y), y: {parameter} * x}}}}"
    assert only_mistake(text(**plane, symmetries=written)).hint == (
        "write {x: -y, y: x}: the change per unit of the parameter"
    )
    alone = f"{{shift: {{x: {parameter}}}}}"
    assert only_mistake(text(**plane, symmetries=alone)).hint.startswith("write {x: 1}: ")
    declared = text(**plane, parameters=f"[m, k, {parameter}]", symmetries=alone)
    assert messages(declared) == []


@pytest.mark.parametrize("seed", range(6))
def test_coordinates_with_numbers_have_their_state_under_initial(seed):
    draw = random.Random(seed)
    names = draw.sample(["x", "y", "phi", "q_1", "s"], draw.randrange(2, 4))
    given = ", ".join(f"{name}: {draw.choice(['0', '0.5', '-1'])}" for name in names)
    kinetic = " + ".join(f"{name}'^2" for name in names)
    found = only_mistake(text(coordinates=f"{{{given}}}", T=kinetic, V=None, parameters=None))
    assert found.hint == f"write [{', '.join(names)}], and below it initial: {{{given}}}"


ANSWERS = [
    (text(expect="{modes: omega^2 = k/m}"), "write [sqrt(k/m)]"),
    (text(expect="{modes: omega = sqrt(k/m)}"), "write [sqrt(k/m)]"),
    (text(expect="{equilibria: [{at: {x: 0}, stable: unstable}]}"), "write no"),
    (text(expect="{equilibria: [{at: {x: 0}, stable: stable}]}"), "write yes"),
    (text(expect="{equilibria: [0, 1]}"), "write {at: {x: 0}}"),
    (text(expect="{trajectory: x(t) = cos(t)}"), "write {x: cos(t)}"),
    (text(U="m*x"), "it is one sum: write V: k*x^2/2 + m*x"),
    (text(initial="at rest"), "what is not given is 0"),
    (text(initial="{x(0): 1, x(10): 0}"), "that at t = 0"),
    (text(forces="{x: cos(k*T)}"), "the time is t"),
    (text(V="m*<x>"), "group with parentheses ( ), without '<' and '>'"),
    (text(V="k*x^2 > 0"), "(1 + sign(x))/2 is 1 for x > 0"),
    (text(V="-m*g.r"), "by its components"),
    (text(T="m*[x' k]*[x' k]"), "by its components"),
    (text(T="m/2*sum_i x_i'^2"), "write each term"),
    (text(T="m*x'^2/2 (kinetic energy)"), "a comment begins with '#'"),
    (text(constraints="{rope: x = const}"), "a constant has a name and a value"),
    (text(points="{O: {position: [0]}, P: {position: [x], mass: m}}", T=None), "{places: {O: [0]}}"),
    (text(points="{P: {position: [x*e_r], mass: m}}"), "[r*cos(phi), r*sin(phi)]"),
    (text(points="{P: {position: 'x \\hat{r}', mass: m}}"), "[r*cos(phi), r*sin(phi)]"),
    (text(simulation="{times: [0, 1, 5]}"), "the key is until; a motion begins at t = 0: write 5"),
    (text(observables="{A: x*x' + x'^2}"), "has momenta p_x, no velocities"),
    (text(functions="{U(x): k*x^2}", V="U"), "write definitions: {U: k*x^2}"),
    (text(find="{a: what is the largest x?}"), "{where: x' = 0, for: x}"),
    (text(coordinates="{x: {mass: m}}"), "a constant stands under parameters"),
    (text(parameters="{m: {real: True}, k: 2}"), "every quantity is real"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint"), ANSWERS)
def test_an_answer_or_a_state_in_other_words(written, hint):
    assert hint in messages(written)[-1]
    assert len(messages(written)) == (2 if "x(10)" in written else 1)


#: Functions of other programs, by Python's own.
WRITTEN_OUT = {
    "sech": lambda x: 1 / math.cosh(x),
    "csch": lambda x: 1 / math.sinh(x),
    "coth": lambda x: 1 / math.tanh(x),
    "lg": math.log10,
    "log10": math.log10,
    "ld": math.log2,
    "log1p": math.log1p,
    "expm1": math.expm1,
    "exp2": lambda x: 2**x,
    "acot": lambda x: math.pi / 2 - math.atan(x),
    "acoth": lambda x: math.log((x + 1) / (x - 1)) / 2,
    "asec": lambda x: math.acos(1 / x),
    "acsc": lambda x: math.asin(1 / x),
    "versin": lambda x: 2 * math.sin(x / 2) ** 2,
    "cube": lambda x: x * x * x,
    "cbrt": lambda x: math.exp(math.log(x) / 3),
    "inv": lambda x: 1 / x,
}


@pytest.mark.parametrize("function", WRITTEN_OUT)
@pytest.mark.parametrize("seed", range(3))
def test_a_function_of_other_programs_is_written_out_with_its_values(function, seed):
    draw = random.Random(seed)
    argument, factor = (
        draw.choice(["x", "x + 1", "k*x", "x/2 + 2"]),
        draw.choice(["k*", "1 - ", ""]),
    )
    power = draw.choice(["", "^2"])
    hint = only_mistake(text(V=f"{factor}{function}({argument}){power}")).hint
    written = re.sub(r"^(?:write|did you mean) |\?$", "", hint).replace("^", "**")
    names = {name: getattr(math, name, None) for name in FUNCTIONS} | {"log": math.log}
    x, k = draw.uniform(1.5, 3), draw.uniform(1, 2)
    value = eval(written, {**names, "x": x, "k": k})
    inner = eval(argument, {"x": x, "k": k})
    expected = eval(
        f"{factor}value{power}".replace("^", "**"), {"k": k, "value": WRITTEN_OUT[function](inner)}
    )
    assert value == pytest.approx(expected)


@pytest.mark.parametrize("seed", range(8))
def test_a_number_with_a_unit_that_is_none_of_the_si_is_told_in_both(seed):
    draw = random.Random(seed)
    unit, factor, base = draw.choice(
        [("km/h", 1 / 3.6, "m/s"), ("cm", 0.01, "m"), ("mm/s", 1e-3, "m/s"), ("km", 1e3, "m")]
    )
    number = draw.randrange(1, 200)
    hint = only_mistake(text(initial=f"{{x: {number} {unit}}}")).hint
    told = re.fullmatch(rf"numbers are .*: write {number} with {unit}, (\S+) with {base}", hint)
    assert told is not None
    assert float(told[1]) == pytest.approx(number * factor, rel=1e-5)
    assert only_mistake(text(initial=f"{{x: {number} {base}}}")).hint.startswith(f"write {number}:")


@pytest.mark.parametrize("comparison", ["<", "<=", "≤"])
@pytest.mark.parametrize(("low", "high"), [("-1", "1"), ("0", "k"), ("-k/2", "2*k")])
def test_a_range_for_a_contact_is_two_contacts(comparison, low, high):
    hint = only_mistake(
        text(contacts=f'{{walls: "{low} {comparison} x {comparison} {high}"}}')
    ).hint
    lower, upper = re.fullmatch(r"write lower: (.*), upper: (.*)", hint).groups()
    assert messages(text(contacts=f'{{lower: "{lower}", upper: "{upper}"}}')) == []
    assert (lower, upper) == (f"x >= {low}", f"x <= {high}")


@pytest.mark.parametrize("form", ["{1}_{0}", "{0}_{1}", "{0}.{1}"])
@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_component_of_a_point_has_several_names(form, axis):
    point = "{bob: {mass: m, position: [l*sin(theta), -l*cos(theta)]}}"
    written = text(**PENDULUM | {"V": f"m*g*{form.format('bob', axis)}"}, points=point)
    component = {"x": "l*sin(theta)", "y": "-l*cos(theta)"}[axis]
    assert only_mistake(written).hint == f"write m*g*({component})"


OTHERS = [
    (text(T="m*x'squared/2"), "m*x'^2/2"),
    (text(V="k*x squared/2"), "k*x^2/2"),
    (text(V="k*x cubed"), "k*x^3"),
    (text(V="k*arc sin(x)"), "k*asin(x)"),
    (text(V="k*(1 - e(-x))"), "write k*(1 - exp(-x))"),
    (text(V="k*(1 - exp^(-k*x))"), "write k*(1 - exp(-k*x))"),
    (text(coordinates="[x_i]", T="m*x_i'^2", V="k*(x_{i+1} - x_i)^2"), "every name in full"),
    (text(T="KineticEnergy(m, x')"), "or write its formula"),
    (text(parameters="[m, k, μ]", V="µ*x"), "with the letter Greek small letter mu"),
    (text(constraints="\n  two: x = k, x = m"), "two_1: x = k, and on a line of its own two_2: x = m"),
    (text(symmetries="{turn: {dx: 1}}"), "write x, whose change it is"),
    (text(functions="{U: [sqrt(x^2)]}", V="U(x)"), "write r, and U(sqrt(x^2)) where it is used"),
    (text(definitions="\n  - y: k*x", T="m*y'^2/2"), "leave out the '-' before each key"),
    (text(points="{P: {position: [x], mass: m, forces: [k*x]}}"), "did you mean 'force'?"),
    (text(expect="{degrees_of_freedom: [x]}"), "write 1"),
    (text(find="{a: {where: m*x'' = -k*x, for: x''}}"), "accelerations are found"),
    (text(observables="[angular momentum]"), "write {A: x*p_x}"),
    (text(unit_system="SI"), "leave it out: a unit stands with its name, m: {unit: kg}"),
    (text(damping_ratio="0.05"), "dissipation: c*x'^2/2"),
    ("Energy\n" + text(), "a comment begins with '#': # Energy"),
    (text() + "Energies of the bob\nfind: {}\n", "a comment begins with '#': # Energies of the bob"),
    ("Mass on a spring\n" + text(), "write title: Mass on a spring"),
    ("# Exercise 3\n\nMass on a spring, week 4\n" + text(), "write title: Mass on a spring, week 4"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint"), OTHERS)
def test_what_is_written_in_words_or_by_other_rules(written, hint):
    [only] = messages(written)
    assert hint in only


@pytest.mark.parametrize("seed", range(6))
def test_a_name_with_several_values_is_several_names(seed):
    draw = random.Random(seed)
    values = [str(draw.randrange(1, 9)) for _ in range(draw.randrange(2, 5))]
    first, *rest = (f"m_{place}: {value}" for place, value in enumerate(values, start=1))
    lines = "lines of their own" if rest[1:] else "a line of its own"
    written = f"{first}, and on {lines} {' and '.join(rest)}"
    by_place = ", ".join(f"{place}: {value}" for place, value in enumerate(values, start=1))
    for given in (f"[{', '.join(values)}]", f"{{{by_place}}}"):
        found, *used = mistakes_of(
            text(parameters=f"\n  m: {given}\n  k: 2", T="m[1]*x'^2", V="m_2*x")
        )
        assert [each.hint for each in used] in (["write m_1*x'^2"], [])
        assert found.hint.partition(";")[0] == f"write {written}"


@pytest.mark.parametrize(
    "remark", ["kinetic energy of the block", "energy of the spring", "Energie der Feder"]
)
@pytest.mark.parametrize("between", [" ", " - ", " – "])
def test_a_remark_behind_a_formula_is_one_mistake(remark, between):
    assert only_mistake(text(V=f"k*x^2/2{between}{remark}")).hint == "a comment begins with '#'"


def test_words_that_are_names_are_no_remark():
    written = text(
        parameters="{mass: 1, gravity: 2, height: 3}", T="x'^2", V="2 mass gravity height"
    )
    assert only_mistake(written).hint == "did you mean 2*mass*gravity*height?"


FINITE = [
    ("x*cos({0}) - y*sin({0})", "x*sin({0}) + y*cos({0})", "-y", "x"),
    ("x*cosh({0}) + y*sinh({0})", "x*sinh({0}) + y*cosh({0})", "y", "x"),
    ("x*exp({0})", "y/exp({0})", "x", "-y"),
    ("{0}*x", "{0}^(3/2)*y", "x", "3/2*y"),
    ("x/(1 - {0}*x)", "y + 3*{0}*t*x", "x*x", "3*t*x"),
    ("x - {0}*t", "y + {0}", "-t", "1"),
]


@pytest.mark.parametrize("name", ["alpha", "v", "ε"])
@pytest.mark.parametrize(("one", "other", "x", "y"), FINITE)
def test_a_finite_change_is_told_its_small_one(one, other, x, y, name):
    plane = {"coordinates": "[x, y]", "T": "m*(x'^2 + y'^2)/2"}
    one, other = one.format(name), other.format(name)
    finite = f"{{turn: {{x: '{one}', y: '{other}'}}}}"
    whole = f"write {{x: {x}, y: {y}}}: the change per unit of the parameter"
    assert only_mistake(text(**plane, symmetries=finite)).hint == whole
    known = text(**plane, parameters=f"[m, k, {name}]", symmetries=finite)
    assert all("not the new y" in each for each in messages(known))
    moved = text(**plane, symmetries=f"{{turn: 'x -> {one}, y -> {other}'}}")
    assert only_mistake(moved).hint == f"write {{x: {x}, y: {y}}}"


FURTHER = [
    (text(initial="{x0: [1; 0]}"), "write {x: 1, x': 0}"),
    (text(experiment="{until: 10}"), "the key is simulation"),
    (text(forces="|\n  x: -k*x\n"), "write {x: -k*x}"),
    (text(V="piecewise(x < 0, k*x^2/2, 0)"), "write (k*x^2/2)*(1 - sign(x))/2"),
    (text(V="k*cosd(x)"), "write k*cos(x*pi/180)"),
    (text(find="{w: 'solve(det(K - w^2*M) = 0, w)'}"), "equilibria, frequencies and charges are found"),
    (text(forces="{friction: -k*sign(x')*m}"), "write x"),
    (text(points="\n  bob: [x, 0], mass = m"), "write bob: {position: [x, 0], mass: m}"),
    (text(points="{b: {position: '0 0 -0.5', mass: m}}", T=None), "write [0, 0, -0.5]"),
    (text(find="x' where x = 3"), "write {name: {where: x = 3, for: x'}}"),
    (text(find="[k such that x = 0, 'solve x = 0 for m']"),
     "write {q1: {where: x = 0, for: k}, q2: {where: x = 0, for: m}}"),
    (text(find="{a: {at: {x: k}}}"), "write a: {where: x = k, for: x}"),
    (text(constraints="['rod: x = k*t']"), "write {rod: x = k*t}"),
    (text(forces="['x: -k*x']"), "write {x: -k*x}"),
    (text(expect="{x: -k*x/m}"), "write accelerations: {x: -k*x/m}"),
    (text(expect="{x: 0}"), "write equilibria: [{at: {x: 0}}]"),
    (text(expect="{trajectory: {at: {x: 3}}}"), "write [{t: …, x: 3}]"),
    (text(expect="{trajectory: {at: [{x: 3}]}}"), "write {t: …, x: 3}"),
    (text(sweep="{parameter: k, from: 1, to: 5}"), "lagcli sweep p.yaml --vary k=1:5:COUNT"),
    (text(sweep="{k: {start: 0, stop: 1, step: 0.1}}"), "--vary k=0:1:11"),
    (text(parameters="{m: 1, k: {value: > 0}}"), "k: {assume: positive}"),
    (text(parameters="\n  m: 1\n  k:\n    value: > 0"), "write assume: positive"),
    (text(V="k*ATAN2(x, m)"), "write atan2(y, x)"),
    (text(V="k*LOG(x)"), "log(x)/log(10) the LOG of a spreadsheet"),
    (text(points="{b: {position: [x -k*sin(x)], mass: m}}"), "write [x, -k*sin(x)]"),
    (text(points="{b: {position: [x, 0], mass: m, force: [-k*x -m]}}"), "write [-k*x, -m]"),
    (text(accelerations="\n  x: -k*x/m"), "write expect: {accelerations: {x: -k*x/m}}"),
    (text(modes="\n  - sqrt(k/m)"), "write expect: {modes: [sqrt(k/m)]}"),
    (text(expect="{accelerations: x'' = -k*x/m}"), "write {x: -k*x/m}"),
    (text(expect="{charges: E = m*x'^2/2 + k*x^2/2}"), "write {energy: m*x'^2/2 + k*x^2/2}"),
    (text(expect="{charges: [H = m*x'^2/2, p_x = m*x']}"), "write {energy: m*x'^2/2, p_x: m*x'}"),
    (text(expect="{charges: {E: m*x'^2/2}}"), "write energy"),
    (text(T="p²/2m"), "write m*x'^2/2, or give H: p_x^2/(2*m) + V"),
    (text(V="|\n  k*x\n  k*x^2"), "begin the second line with its sign"),
    (text(initial="[[0, 1], [0, 2]]"), "write {x: …, x': …}"),
    (text(coordinates="[x, y]", T="m*(x'^2 + y'^2)", initial="{x: 1, y: x}"), "leave out what follows"),
    (text(simulation="{until: ten seconds}"), "write it in digits"),
    (text(points="{P: {position: [t, x, x, 0], mass: m}}"), "write [x, y]"),
    (text(functions="[W]", V="W(x)"), "write {W: [x]}"),
    (text(forces="{x: -k*x(t - m)}"), "there are no delays"),
    (text(forces="{x: -dV/dx}"), "what an energy contributes is derived"),
    (text(forces="{x: -dF/dx}"), "write diff(F, x)"),
    (text(symmetries="{boost: {x: t, gauge: yes}}"), "leave it out: it is found"),
    (text(constraints="{c: x = 1}", find="{a: {where: N = 0, for: x}}"), "the constraint: write lambda_c"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint"), FURTHER)
def test_further_habits_get_one_mistake(written, hint):
    [only] = messages(written)
    assert hint in only


@pytest.mark.parametrize("bars", ["|{}|", "||{}||", r"|\vec{{{}}}|"])
@pytest.mark.parametrize("between", ["{}1", "{}_1"])
def test_the_distance_of_two_bodies_is_written_by_its_components(bars, between):
    names = [between.format(axis) for axis in "xy"]
    names += [name.replace("1", "2") for name in names]
    x1, y1, x2, y2 = names
    kinetic = " + ".join(f"{name}'^2" for name in names)
    plane = {"coordinates": f"[{', '.join(names)}]", "T": f"m*({kinetic})/2"}
    if "vec" not in bars:
        hint = only_mistake(text(**plane, V=f"-k/{bars.format('r1 - r2')}")).hint
        assert hint == f"write -k/sqrt(({x1} - {x2})^2 + ({y1} - {y2})^2)"
        assert messages(text(**plane, V=hint.removeprefix("write "))) == []
    alone = only_mistake(
        text(**plane, V=f"-k/{bars.format('r')}".replace("r}|", "r}_2|").replace("r|", "r2|"))
    ).hint
    assert alone == f"write -k/sqrt({x2}^2 + {y2}^2)"


@pytest.mark.parametrize("unit", ["N", "J", "kg", "Hz", "N/m", "N s/m", "m/s^2"])
def test_a_quantity_within_a_formula_stays_without_its_unit(unit):
    found = only_mistake(text(V=f"k*x - 5 {unit}*x", parameters="{k: 1, M: 1}", T="M*x'^2"))
    assert found.hint == "write k*x - 5*x: numbers are in the units of the file"


@pytest.mark.parametrize("unit", ["kN", "mm"])
def test_a_quantity_that_would_be_converted_is_a_parameter(unit):
    hint = only_mistake(text(V=f"5 {unit} * x", parameters="{k: 1, M: 1}", T="M*x'^2")).hint
    assert re.fullmatch(rf"write all as .*{{k: 1, M: 1, \w: {{value: 5, unit: {unit}}}}}", hint)


@pytest.mark.parametrize("name", ["exp", "sin", "diff", "pi"])
def test_a_name_that_cannot_be_declared_is_told_once(name):
    found = only_mistake(text(parameters=f"{{m: 1, {name}: 2}}", V=f"x^2*{name}"))
    assert f"choose another name: {name}_1" in found.hint


LAST = [
    (text(initial="{x dot: 1}"), "write x'"),
    (text(initial="{x': 10 °/s}"), "write 10*pi/180"),
    (text(parameters="{m: 1, k: 2, t: 0}"), "leave it out, or choose another name"),
    (text(constraints="\n  a: x = 1\n  a: x^2 = 1"), "or give it another name"),
    (text(simulation="{until: -3}"), "such as until: 10"),
    (text(symmetries="{s: {x: 1}}", V=None, expect="{charges: [m*x']}"), "write {s: m*x'}"),
    (text(find="\n  - where: x' = 0\n    for: x"), "write name: {where: x' = 0, for: x}"),
    (text(constraints="\n  - equation: x = 1\n    multiplier: N"), "write name: {equation: x = 1, multiplier: N}"),
    (text(picture="{bodies: [P]}"), "the points are drawn by themselves"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint"), LAST)
def test_names_and_numbers_of_other_forms(written, hint):
    [only] = messages(written)
    assert hint in only


@pytest.mark.parametrize("name", ["x", "theta", "q_1"])
@pytest.mark.parametrize("form", ["{},t", "{}_{{,t}}", "{}_,t"])
def test_a_comma_derivative_by_the_time_is_a_velocity(name, form):
    written = text(coordinates=f"[{name}]", T=f"m*{form.format(name)}^2/2", V=None)
    assert only_mistake(written).hint == f"write m*{name}'^2/2"


@pytest.mark.parametrize("formula", ["atan2({0},t)", "atan2(k, {0},t)"])
def test_an_argument_is_no_derivative(formula):
    found = messages(text(V=formula.format("x")))
    assert not any("x'" in each for each in found)


@pytest.mark.parametrize("seed", range(6))
def test_decimal_commas_in_braces_are_one_mistake(seed):
    draw = random.Random(seed)
    digit = draw.randrange(1, 10)
    other = draw.choice([digit, draw.randrange(1, 10)])
    [found] = read_problem(
        "p", text(parameters=f"{{m: 1,{digit}, k: 2,{other}}}").encode()
    ).diagnostics
    assert found.hint.startswith(f"a decimal point is written '.': write m: 1.{digit}")
    assert digit == other or found.hint.endswith(f"; write k: 2.{other}")


@pytest.mark.parametrize("number", ["1", "2.5"])
@pytest.mark.parametrize("unit", ["kg", "m/s^2", "N m"])
@pytest.mark.parametrize("brackets", ["[{}]", "({})"])
def test_a_unit_in_brackets_before_its_number(number, unit, brackets):
    written = f'{{m: "{brackets.format(unit)} {number}", k: 2}}'
    assert only_mistake(text(parameters=written)).hint == f"write {{value: {number}, unit: {unit}}}"


@pytest.mark.parametrize(
    ("written", "hint"),
    [
        (
            text(contacts="{floor: x >= 0}", restitution="0.8"),
            "{floor: {gap: x >= 0, restitution: 0.8}}",
        ),
        (text(simulation="{until: 1, n: 100}"), "lagcli simulate p.yaml --samples 100"),
        (text(parameters="\n  m:\n    - 1\n    - kg\n  k: 2"), "write {value: 1, unit: kg}"),
        (text(points="\n  P: position [x, 0], mass m"), "write {position: [x, 0], mass: m}"),
        (text(simulation="{accuracy: machine precision}"), "write it in digits, as in 1e-9"),
        ("coordinates: [x]\nparameters\n  m: 1\nT: x'^2\n", "write parameters: with its entries"),
        (text(find="{top: x where x' = 0}"), "write {where: x' = 0, for: x}"),
        (text(expect="{L: m*x'^2/2}"), "given by the file"),
        ("problem = {\n  'coordinates': ['x'],\n  'T': \"x'^2\"\n}\n", "leave out 'problem ='"),
    ],
)
def test_the_last_of_other_places(written, hint):
    [only] = messages(written)
    assert hint in only


@pytest.mark.parametrize(
    ("changed", "hint"),
    [({"forces": "k*cos(gt) - k*θdot"}, "write {theta: k*cos(g*t) - k*theta'}"),
     ({"constraints": "theta == 1"}, "write {name: theta = 1}"),
     ({"initial": "theta = 30°"}, "write {theta: 30*pi/180}"),
     ({"points": "\n  bob: (l*sinθ, -l*cosθ)"}, "write {position: [l*sin(theta), -l*cos(theta)]}"),
     ({"points": "\n  bob: (l*sin(theta), -l)\n  mass: m"},
      "write bob: {position: [l*sin(theta), -l], mass: m}")],
)  # fmt: skip
def test_a_hint_has_no_mistake_of_its_own(changed, hint):
    written = text(**(PENDULUM | {"T": "m*l^2*theta'^2/2", "parameters": "{m: 1, l: 2, g: 9, k: 1}"}
                      | changed))  # fmt: skip
    assert only_mistake(written).hint == hint


def test_what_a_hint_says_of_a_name_that_is_declared_nowhere_is_kept():
    written = text(**PENDULUM | {"T": "m*l^2*theta'^2/2", "forces": "F*cos(theta)"})
    assert messages(written)[0].endswith("write {theta: F*cos(theta)}")


@pytest.mark.parametrize(
    ("lines", "hint"),
    [("x(0): 1\nx'(0): 0\n", "{x: 1, x': 0}"), ("x0: 2\nv0: -1\n", "{x: 2, x': -1}"),
     ("x: 1\nxdot: 2\n", "{x: 1, x': 2}"), ("x(t=0): pi/2\n", "{x: pi/2}"), ("x0: 30°\n", "{x: 30*pi/180}")],
)  # fmt: skip
def test_a_state_outside_of_initial_is_one_mistake(lines, hint):
    mistake = only_mistake(text() + lines)
    assert mistake.hint.endswith(f"write initial: {hint}")
    assert read_problem("p.yaml", f"{text()}initial: {hint}\n".encode()).diagnostics == ()


def test_a_constant_that_a_formula_uses_is_no_state():
    assert "g: 9.81, x0: 2}" in messages(text(V="k*(x - x0)^2/2") + "x0: 2\n")[0]


@pytest.mark.parametrize(
    ("kinetic", "names"),
    [("m*(x'^2 + y'^2)/2", "x, y"), ("m*(r'^2 + r^2*phi'^2)/2", "r, phi"),
     (r"m*\dot{\theta}^2/2", "theta"), ("m*(xdot^2 + y_dot^2)/2", "x, y"), ("m*v^2/2", "x")],
)  # fmt: skip
def test_coordinates_that_are_not_declared_are_named_by_their_velocities(kinetic, names):
    found = messages(f"title: Kepler's problem\nparameters: [m]\nT: {kinetic}\n")
    assert found[0] == f"the problem has no coordinates; write coordinates: [{names}]"


DRIVEN = [
    (text(forces="{x: k cos(w t)}"), "did you mean k*cos(w*t)?", "w"),
    (text(V="k*(x - v t)^2/2"), "did you mean k*(x - v*t)^2/2?", "v"),
    (text(constraints="{c: x = v t}"), "did you mean x = v*t?", "v"),
    (text(**PENDULUM | {"V": "m*g*l*theta*heaviside(t)*sin(omega*t)"}),
     "write m*g*l*theta*((1 + sign(t))/2)*sin(omega*t)", "omega"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "hint", "name"), DRIVEN)
def test_a_rate_beside_the_time_is_a_constant(written, hint, name):
    found = {each.hint for each in read_problem("p.yaml", written.encode()).diagnostics}
    assert hint in found
    assert any(each.startswith("declare it: ") and each.count(name) for each in found - {hint})
