"""Rest at kinks of the potential and under static friction is examined, not taken on trust."""

from __future__ import annotations

import pytest

from lagcli.pipeline import _statements as statements
from lagcli.pipeline import derive
from lagcli.reader import parse_text, read_problem
from lagcli.record import replace
from lagcli.statements.motions import Above
from lagcli.verification import verified

KINDS = [
    "L: m*x'^2/2 - k*abs(x) + c*x",
    "L: m*x'^2/2 - k*abs(sin(x)) + c*sin(x)/2",
    "L: m*(x'^2 + y'^2)/2 - k*(abs(x) + abs(y)) + c*x - c*y",
    "L: m*(x'^2 + y'^2)/2 - k*abs(x - y) + c*(x - y) - m*(x + y)^2",
    "L: m*x'^2/2 - c*x\nforces: {x: -k*sign(x')}",
    "L: m*x'^2/2 - c*x^2/2\nforces: {x: -k*sign(x')}",
    "L: m*(x'^2 + y'^2)/2 - c*(x - y)^2/2\nforces: {x: -k*sign(x')}",
]


@pytest.mark.parametrize("kind", KINDS)
def test_what_holds_a_body_at_rest_is_tried_beside_it(kind: str) -> None:
    coordinates = "[x, y]" if "y'" in kind else "[x]"
    text = (
        f"coordinates: {coordinates}\nparameters: {{m: {{assume: positive}}, "
        f"k: {{assume: positive}}, c: {{assume: positive}}}}\n{kind}\n"
    )
    problem = read_problem("t.yaml", text.encode()).checked()
    answers = statements(derive(problem)).answers(("equilibria",))
    assert verified(problem, answers) is answers
    section = answers.sections["equilibria"]
    held = [e for e in section.equilibria if e.sticking or e.kinked]
    assert held
    free_of_conditions = (Above(parse_text("c"), parse_text("0")),)
    moved = [
        replace(e, where=free_of_conditions)
        if e.where
        else replace(e, at={**e.at, "x": parse_text("1/3")})
        for e in held
    ]
    found = verified(problem, replace(answers, sections={
        "equilibria": replace(section, equilibria=tuple(moved))}))  # fmt: skip
    assert found.sections["equilibria"].equilibria is None
    assert "does not hold it there" in found.warnings[-1]
