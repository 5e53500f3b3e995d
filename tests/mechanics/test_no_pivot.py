"""L of first degree in the velocities: a length, whose parameter is free, so q'' is not determined."""

import pytest

from lagcli.mechanics.statements import Statements

from .derived import derive


@pytest.mark.parametrize(
    "length",
    ["sqrt(x'^2 + y'^2)", "sqrt(x'^2*(1 + x^2) + 2*y'^2)", "x*sqrt(x'^2 - y'^2)", "y*x'^2/y'"],
)
def test_the_parameter_of_a_length_is_free(length):
    """The Hessian has the null vector q' (Euler), which no elimination may divide by."""
    statements = Statements(derive(f'coordinates: {{x: {{}}, y: {{}}}}\nL: "{length}"\n'))
    section = statements.answers(["accelerations"]).sections["accelerations"]
    assert section.accelerations is None
    assert not section.regular
    assert section.degenerate == ("x", "y")
