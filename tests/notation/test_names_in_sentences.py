"""Names of the file in sentences are set as in formulas; words that look like names are not."""

from __future__ import annotations

import pytest

from lagcli.expression import Name
from lagcli.notation.letters import sentence, with_names
from lagcli.reader.expressions import formula_or_none, parse_text


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("there is one at theta = 0", ("there is one at ", Name("theta"), " = 0")),
        (
            "with u' = -0.3, theta' = 2",
            ("with ", Name("u", 1), " = -0.3, ", Name("theta", 1), " = 2"),
        ),
        ("a minimum where a = 2", ("a minimum where ", Name("a"), " = 2")),
        ("the rate of 'theta' has no formula", ("the rate of 'theta' has no formula",)),
        ("where theta2 > a", ("where ", Name("theta2"), " > a")),
        ("atheta and theta_3 stay", ("atheta and theta_3 stay",)),
        ("theta(t) is given", ("theta(t) is given",)),
        ("where theta - 2*u^2 = 0", ("where ", parse_text("theta - 2*u^2"), " = 0")),
        ("or sin(theta) = 0: a rest", ("or ", parse_text("sin(theta)"), " = 0: a rest")),
        ("(u' + 1)/theta2, not x - u", (parse_text("(u' + 1)/theta2"), ", not x - u")),
        ("a theta-like a - 0.3", ("a ", Name("theta"), "-like a - 0.3")),
        ("U(theta - u) is given", ("U(", parse_text("theta - u"), ") is given")),
    ],
)
def test_what_is_a_name(text, parts):
    assert with_names(text, ["a", "u", "theta", "theta2"], formula_or_none) == parts


def test_without_names_nothing_is_changed():
    assert with_names("theta = 0", []) == ("theta = 0",)


@pytest.mark.parametrize("letter", "LHVT")
def test_a_letter_of_the_file_with_a_value_is_no_quantity_of_ours(letter):
    told = f"there is one with {letter} = 1.2, {letter}' = 3"
    assert sentence(told, [letter]) == told
    assert sentence(f"{letter} has a minimum", [letter]).startswith("the ")
