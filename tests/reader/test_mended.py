"""The hints of a file are followed by the program: what comes of it."""

import re
from pathlib import Path

import pytest

from lagcli.reader import read_problem
from lagcli.reader.mended import mended
from lagcli.reader.problem_file import _composed


def hints(written):
    return [each.hint for each in read_problem("p.yaml", written.encode()).diagnostics]


REST = "T: m*x'^2/2\nV: k*x^2/2\n"


def test_a_mistake_that_another_hides_is_found():
    found = hints("coordinates: x(t)\nparameters: m = 1 kg, k = 2 N/m\nT: m xdot^2/2\nV: k x²/2\n")
    assert found == [
        "write [x]; in line 2 write {m: {value: 1, unit: kg}, k: {value: 2, unit: N/m}}",
        "did you mean m*x'^2/2?",
        "did you mean k*x^2/2?",
    ]


def test_the_mistake_inside_of_a_hint_is_mended_in_it():
    written = f"coordinates: [x]\nparameters: {{m: 1, k: 1, F: 1, omega: 2}}\n{REST}"
    assert hints(f"{written}forces: F*cos(ωt)\n") == ["write {x: F*cos(omega*t)}"]
    assert hints(f"{written}drag: -F*|v|*v\n")[0].endswith("write forces: {x: -F*abs(x')*x'}")


def test_what_goes_with_another_mistake_is_not_reported():
    written = f"coordinates: [x-cart]\nparameters: {{m: 1, k: 1}}\n{REST}".replace("*x", "*x-cart")
    assert hints(written) == ["write x_cart"]


@pytest.mark.parametrize("key", ["h", "gamma", "y_1"])
def test_a_formula_of_a_name_is_put_under_definitions_and_read_there(key):
    written = f"coordinates: [x]\nparameters: {{m: 1, g: 9}}\nT: m*x'^2/2\nV: m*g*{key}\n{key}: 1 − cosx\n"
    [hint] = hints(written)
    assert hint.endswith(f"write definitions: {{{key}: 1 - cos(x)}}")


def test_a_dimension_that_does_not_fit_is_found_behind_another_mistake():
    units = "coordinates: {x: {unit: m}}\nparameters: {m: {value: 1, units: kg}, k: {value: 1, unit: N}}\n"
    found = hints(units + REST)
    assert found[0] == "did you mean 'unit'?"
    assert found[1] == "write N/m"


def test_a_hint_that_leads_to_a_mistake_is_not_followed():
    written = f"coordinates: [x]\nparameters: {{m: 1, k: 1}}\n{REST}find: {{a: {{where: x = 1}}}}\n"
    assert len(hints(written)) == 1


def test_most_first_files_are_read_when_all_hints_are_followed():
    given = Path(__file__).with_name("first_files.txt").read_text("utf-8")
    files = re.findall(r"^=== \w+\n(.*?)^--- expected\n", given, re.DOTALL | re.MULTILINE)
    left = [written for written in files[::8] if _left(written)]
    assert len(left) < len(files[::8]) / 2


def _left(written):
    """Whether mistakes are left in the file that the hints lead to."""
    from lagcli.diagnostics import Source
    from lagcli.reader.text import Mistake

    found = []

    def read(source):
        found.append(_composed(source, alone=False))
        return found[-1]

    try:
        mended(Source("p.yaml", written), read, read, lambda _: False)
    except Mistake:
        return True
    return found[-1][1] is None
