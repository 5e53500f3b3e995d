"""A constraint that is called integrable, or a coordinate ignorable, and is not, is noticed."""

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


@pytest.mark.parametrize(
    ("physics", "ignorable", "other"),
    [
        ("T: (x'^2 + y'^2)/2\nV: a*y", "x", "y"),
        ("T: (x'^2 + y'^2 + z'^2)/2\nV: a*z\nconstraints: {c: z = b*x}", "y", "x"),
        ("T: (x'^2 + y'^2)/2 + z'^2\nV: a*sin(z)\nforces: {x: -b*x'}", "y", "z"),
        ("T: (1 + x^2)*y'^2/2 + x'^2/2\nV: a*x^2", "y", "x"),
    ],
)
def test_a_coordinate_whose_momentum_changes_is_not_ignorable(
    physics: str, ignorable: str, other: str
) -> None:
    names = "x, y, z" if "z" in physics else "x, y"
    file = (
        f"coordinates: [{names}]\nparameters: {{a: {{assume: positive}}, b: {{assume: positive}}}}\n"
        + physics
    )
    problem = read_problem("t.yaml", file.encode()).checked()
    answers = statements(derive(problem)).answers(["model"])
    section = replace(answers.sections["model"], ignorable=(ignorable,))
    assert verified(problem, replace(answers, sections={"model": section})).complete
    section = replace(section, ignorable=(ignorable, other))
    found = verified(problem, replace(answers, sections={"model": section}))
    assert found.sections["model"].kept is None
