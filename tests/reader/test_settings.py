"""`--set name=value`."""

from fractions import Fraction

import pytest

from lagcli.diagnostics import ProblemError
from lagcli.expression import Name, Number
from lagcli.reader import read_problem, set_parameters

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
        ("m=m", 3, "needs itself"),
        ("m=", 3, "empty"),
    ],
)
def test_a_wrong_setting_has_a_place(setting, column, piece):
    with pytest.raises(ProblemError) as caught:
        set_parameters(PROBLEM, [setting])
    (mistake,) = caught.value.diagnostics
    assert mistake.span.column == column
    assert piece in mistake.message + mistake.hint
