"""What has no real value is refused with its place, and never printed."""

from __future__ import annotations

import pytest

from lagcli.diagnostics import ProblemError
from lagcli.pipeline import Request, read

from .derived import derive

HEAD = "coordinates: [x]\nparameters: {k: {assume: positive}, a: }\nT: x'^2/2\nV: "


@pytest.mark.parametrize(
    ("potential", "column"),
    [
        ("x + sqrt(-1)*x", 8),
        ("sqrt(-k)*x", 4),
        ("x^2 + (1 - 2)^(1/2)*x", 10),
        ("x*log(3 - pi)", 6),
        ("asin(2)*x", 4),
    ],
)
def test_a_formula_without_a_real_value_is_refused(potential: str, column: int) -> None:
    with pytest.raises(ProblemError) as refused:
        _ = derive(HEAD + potential).system.L
    (mistake,) = refused.value.diagnostics
    assert "no real value" in mistake.message
    assert (mistake.span.line, mistake.span.column) == (4, column)


def test_a_real_value_is_kept() -> None:
    assert derive(HEAD + "sqrt(a)*x + sqrt(pi - 3)*x^2 + log(a) + asin(1/2)*x").system.L


def test_a_division_by_zero_is_shown_where_it_stands() -> None:
    text = HEAD + "x + x^2/a"
    found = read("f", text.encode(), Request(settings=("a=0",)))
    (mistake,) = found.diagnostics
    assert (mistake.span.line, mistake.span.column) == (4, 8)
