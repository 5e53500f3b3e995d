"""`--set name=value`."""

from fractions import Fraction

import pytest

from lagcli.diagnostics import NOWHERE, ProblemError
from lagcli.expression import Name, Number, walk
from lagcli.reader import read_problem, set_parameters, set_state
from lagcli.reader.columns import read_number

PROBLEM = read_problem("f.yaml", b"coordinates: [x]\nparameters: [m, g]\nT: x'^2\n").checked()


def test_numbers_and_other_parameters_are_values():
    problem = set_parameters(PROBLEM, ["m=0.1", "g = m"])
    assert [one.value for one in problem.parameters] == [Number(Fraction(1, 10)), Name("m")]
    assert PROBLEM.parameters[0].value is None


@pytest.mark.parametrize(
    ("setting", "column", "piece"),
    [
        ("m", 1, "'=' is missing"),
        ("q=1", 1, "no parameter 'q'"),
        ("m=x", 3, "unknown name 'x'"),
        ("m = 2g", 5, "2*g"),
        ("m = 2 kg", 5, "write 2: numbers are in the units of the file"),
        ("m=m", 3, "needs itself"),
        ("m=", 3, "empty"),
        ("m=1, g=2", 1, "write --set m=1 --set g=2"),
        ("m=1;g=m/2", 1, "write --set m=1 --set g=m/2"),
    ],
)
def test_a_wrong_setting_has_a_place(setting, column, piece):
    with pytest.raises(ProblemError) as caught:
        set_parameters(PROBLEM, [setting])
    (mistake,) = caught.value.diagnostics
    assert mistake.span.column == column
    assert piece in mistake.message + mistake.hint


@pytest.mark.parametrize(
    ("text", "advice"), [("3 s", "write 3"), ("2min", "2*60"), ("30°", "30*pi/180")]
)
def test_a_number_of_an_option_has_no_unit(text, advice):
    with pytest.raises(ProblemError) as caught:
        read_number(text, "--until")
    assert advice in caught.value.diagnostics[0].hint


def test_a_state_is_put_in_for_that_of_the_file():
    """What is not named stays; a velocity may be typed with any prime."""
    text = b"coordinates: [x, y]\nparameters: [m]\nT: m*(x'^2 + y'^2)\ninitial: {x: 1, y': 2}\n"
    problem = set_state(read_problem("f.yaml", text).checked(), ["x = 2*m", "y’=3", "x'=-1"])
    state = {str(name): value for name, value in problem.initial.items()}
    assert state["y'"] == Number(Fraction(3))
    assert set(state) == {"x", "y'", "x'"}
    assert Name("m") in walk(state["x"])


@pytest.mark.parametrize(
    ("setting", "column", "piece"),
    [
        ("x", 1, "'=' is missing"),
        ("m=1", 1, "no coordinate or velocity 'm'"),
        ("x''=1", 1, "no coordinate or velocity 'x'''"),
        ("x=x", 3, "unknown name 'x'"),
        ("x=", 3, "empty"),
    ],
)
def test_a_wrong_state_has_a_place(setting, column, piece):
    with pytest.raises(ProblemError) as caught:
        set_state(PROBLEM, [setting])
    (mistake,) = caught.value.diagnostics
    assert mistake.span.column == column
    assert piece in mistake.message + mistake.hint


def test_a_state_has_the_units_of_its_coordinates():
    text = (
        b"coordinates: {x: {unit: m}}\nparameters: {m: {unit: kg}, v: {unit: m/s}}\nT: m*x'^2/2\n"
    )
    problem = read_problem("f.yaml", text).checked()
    assert set_state(problem, ["x'=v", "x=1"]).initial
    with pytest.raises(ProblemError) as caught:
        set_state(problem, ["x=v"])
    assert "m/s" in caught.value.diagnostics[0].message


def test_a_value_from_the_command_line_has_no_place_in_the_file():
    text = "coordinates: {x: {assume: positive}}\nparameters: {m: 1}\nT: m*x'^2/2\n"
    problem = read_problem("f", text.encode()).checked()
    changed = set_state(set_parameters(problem, ["m=2/(1 + 2)"]), ["x=-1"])
    values = [changed.parameters[0].value, *changed.initial.values()]
    assert {node.span for value in values for node in walk(value)} == {NOWHERE}


@pytest.mark.parametrize(
    ("until", "meant"),
    [
        ("2*pi*sqrt(m/k)", "2*pi*sqrt(1/9)"),
        ("m", "1"),
        ("3*P", "3*(2*pi*sqrt(1/9))"),
        ("2*pi/w", "2*pi/(sqrt(9/1))"),
        ("n*m", ""),  # n has no value
    ],
)
def test_the_end_of_a_run_is_shown_in_numbers(until, meant):
    text = (
        "coordinates: [x]\nparameters: {m: 1, k: 9, w: sqrt(k/m), n: }\nT: m*x'^2/2\n"
        "definitions: {P: 2*pi*sqrt(m/k)}\nsimulation: {until: %s}\n"
    )
    [told] = read_problem("p.yaml", (text % until).encode()).diagnostics
    assert told.hint == (f"write {meant}" if meant else told.hint)
    assert "write" not in told.hint or meant
    assert not meant or read_problem("p.yaml", (text % meant).encode()).diagnostics == ()


@pytest.mark.parametrize(
    ("key", "state"),
    [("x", "x"), ("x0", "x"), ("x(0)", "x"), ("v0", "x'"), ("x'(0)", "x'"), ("x_dot", "x'")],
)
def test_a_state_among_the_settings_of_a_run_stands_under_initial(key, state):
    text = f'coordinates: [x]\nparameters: [m]\nT: m*x\'^2/2\nsimulation: {{"{key}": 0.1}}\n'
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert only.hint.endswith(f"write initial: {{{state}: 0.1}}")


@pytest.mark.parametrize(("word", "method"), [("RK4", "dop853"), ("radau", "radau5")])
def test_a_method_alone_stands_under_simulation(word, method):
    text = f"coordinates: [x]\nparameters: [m]\nT: m*x'^2/2\nmethod: {word}\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert only.hint == f"write simulation: {{method: {method}}}"
