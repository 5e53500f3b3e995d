"""Values that conserved quantities determine up to their sign: a velocity by the place."""

from __future__ import annotations

import random

import pytest

from lagcli.algebra import is_zero
from lagcli.mechanics.statements import Statements
from lagcli.statements.questions import Rewritten
from tests.mechanics.derived import derive

HEAD = """
coordinates: [x]
parameters: {m: {assume: positive}, k: {assume: positive}, a: {assume: positive}}
T: m*x'^2/2
"""


def answer(text: str) -> Rewritten:
    found = Statements(derive(text)).answers(["find"]).sections["find"]
    return found.answers["v"]  # type: ignore[attr-defined,no-any-return]


@pytest.mark.parametrize("seed", range(6))
def test_the_velocity_by_the_place_is_either_root_of_energy(seed: int) -> None:
    """x' = ±sqrt(2 (V(a) - V(x))/m) from rest at a, times any function of the place."""
    source = random.Random(f"sign {seed}")
    V = source.choice(["k*x^2/2", "-k*cos(x)", "k*x^4", "-k/x", "k*exp(x)", "k*x"])
    factor = source.choice(["1", "m", "x^2 + a^2", "1/(x^2 + 1)"])
    text = (
        f"{HEAD}V: {V}\ninitial: {{x: a}}\n"
        f'find: {{v: {{value: "({factor})*x\'", in_terms_of: [x]}}}}\n'
    )
    found, derivation = answer(text), derive(text)
    assert found.value is None
    assert len(found.values) == 2
    build, x = derivation.system.build, derivation.system.q[0]
    here = derivation.system.V
    lost = here.xreplace({x: build.names["a"]}) - here
    one, other = (build(value) for value in found.values)
    weight = derivation.system.build(derivation.given.find[0].value) / derivation.system.qdot[0]
    assert is_zero(one**2 - weight**2 * 2 * lost / build.names["m"]) is True
    assert is_zero(one + other) is True


@pytest.mark.parametrize(("value", "by"), [("x' + x'^2", "x"), ("x'", "k"), ("x'^3 + x", "x")])
def test_what_is_not_determined_up_to_its_sign_is_not_found(value: str, by: str) -> None:
    question = f'{{v: {{value: "{value}", in_terms_of: [{by}]}}}}'
    found = answer(f"{HEAD}V: k*x^2/2\ninitial: {{x: a}}\nfind: {question}\n")
    assert (found.value, found.values) == (None, ())
    assert "no formula of it in" in found.note


def test_a_square_is_found_as_before() -> None:
    text = (
        f'{HEAD}V: k*x^2/2\ninitial: {{x: a}}\nfind: {{v: {{value: "x\'^2", in_terms_of: [x]}}}}\n'
    )
    found = answer(text)
    assert found.value is not None
    assert found.values == ()
