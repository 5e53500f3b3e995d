"""Mistakes that another one of the same file must not hide, and hints that name the whole text."""

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
    assert told[0].hint == "did you mean 'p_x'?"
