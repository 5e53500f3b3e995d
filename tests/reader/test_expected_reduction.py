"""Mistakes in the expectations of reduction, steady motions and Hamilton-Jacobi."""

from __future__ import annotations

import pytest

from lagcli.reader import read_problem

HEAD = (
    "coordinates: {r: {assume: positive}, phi: {}}\nparameters: [m]\nL: m*(r'^2 + r^2*phi'^2)/2\n"
)


def mistakes(expect: str) -> list[str]:
    found = read_problem("test.yaml", (HEAD + f"expect: {expect}\n").encode())
    return [each.message for each in found.diagnostics]


@pytest.mark.parametrize(
    ("expect", "message"),
    [
        ("{reduction: {routian: 1}}", "unknown key 'routian' in 'reduction'"),
        ("{reduction: {turning_points: E/m}}", "'turning_points' must be a list, not a text"),
        (
            "{reduction: {reconstruction: {psi: 1}}}",
            "'psi' in 'reconstruction' is not a coordinate",
        ),
        ("{reduction: {period: a*tau}}", "unknown name 'tau' in the expected period"),
        ("{steady_motions: {at: {r: 1}}}", "'steady_motions' must be a list, not a map"),
        ("{steady_motions: [{stable: m >= 1}]}", "a condition of stability has > or <"),
        ("{hamilton_jacobi: {separable: maybe}}", "'separable' has no value 'maybe'"),
        ("{hamilton_jacobi: {functions: {s: E}}}", "'s' in 'functions' is not a coordinate"),
        (
            "{hamilton_jacobi: {functions: {r: beta_1*r}}}",
            "unknown name 'beta_1' in the expected part W of the action by 'r'",
        ),
        ("{equilibria: {at: {r: 1}}}", "'equilibria' must be a list, not a map"),
        ("{equilibria: [{place: {r: 1}}]}", "unknown key 'place' in an equilibrium"),
        ("{equilibria: [{at: {r: 1}, stable: m >= 1}]}", "a condition of stability has > or <"),
        ("{energy: E}", "unknown name 'E' in the expected energy"),
    ],
)
def test_each_mistake_is_named(expect, message):
    assert message in mistakes(expect)


def test_the_constants_of_the_answers_may_stand_there():
    assert not mistakes(
        "{reduction: {turning_points: [p_phi/sqrt(2*m*E)], period: a}, "
        "steady_motions: [{rates: {phi: phi'}, stable: [m > 0, 1 < m]}], "
        "hamilton_jacobi: {separable: yes, derivatives: {r: sqrt(alpha_1 + E)}, functions: {r: E*r}}}"
    )


def test_a_name_of_the_file_stays_what_it_is():
    text = HEAD.replace("[m]", "[m, E]") + "expect: {reduction: {turning_points: [E, h]}}\n"
    assert not read_problem("test.yaml", text.encode()).diagnostics
