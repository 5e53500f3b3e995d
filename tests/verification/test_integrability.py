"""A constraint that is called integrable, or nonholonomic, and is not, is noticed."""

from __future__ import annotations

import pytest

from lagcli.pipeline import _statements as statements
from lagcli.pipeline import derive
from lagcli.reader import read_problem
from lagcli.record import replace
from lagcli.verification import verified

HEAD = (
    "coordinates: [x, y, z]\nparameters: {a: {assume: positive}, b: {assume: positive}}\n"
    "T: (x'^2 + y'^2 + z'^2)/2\nV: a*z\nconstraints:\n"
)

KINDS = [
    ("  c: z' = y*x'", "nonholonomic"),
    ("  c: x'*sin(z) = y'*cos(z)", "nonholonomic"),
    ("  c: z' = a*x' + b*y' + t*x'", "nonholonomic"),
    ("  c: z' = y*x' + x*y'", "integrable"),
    ("  c: x*y' - y*x' = 0", "integrable"),
    ("  c: exp(x)*(z' - a*x') = b*exp(x)", "integrable"),
    ("  c: z' = y*x'\n  d: y' = a*x'", "integrable"),
    ("  c: z' = t*x' + x", "integrable"),
]


@pytest.mark.parametrize(("constraints", "kind"), KINDS)
def test_the_other_kind_is_refuted(constraints: str, kind: str) -> None:
    problem = read_problem("t.yaml", (HEAD + constraints + "\n").encode()).checked()
    answers = statements(derive(problem)).answers(["multipliers"])
    section = answers.sections["multipliers"]
    assert section.multipliers["c"].kind == kind
    assert verified(problem, answers) is answers
    other = "integrable" if kind == "nonholonomic" else "nonholonomic"
    turned = {name: replace(each, kind=other) for name, each in section.multipliers.items()}
    false = replace(section, multipliers=turned)
    found = verified(problem, replace(answers, sections={"multipliers": false}))
    assert not found.complete
    assert found.sections["multipliers"].multipliers["c"].kind is None
