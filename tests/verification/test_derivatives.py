"""The derivatives of the programs against finite differences in 400 bits."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from flint import arb, ctx

from lagcli.expression import FUNCTIONS
from lagcli.reader import parse_text
from lagcli.verification.functions import Instance
from lagcli.verification.program import VerificationProgram
from lagcli.verification.sweeps import StepValues

STEP = arb(2) ** -60
POINT = {"x": 0.31, "y": 0.73}
FORMULAS = [
    *(f"{name}(x*y + {1 if name == 'acosh' else 0})" for name, n in FUNCTIONS.items() if n == 1),
    "atan2(x, y) + atan2(-y, x - 1)",
    "(x + 2*y)^(5/3)*y^-2",
    "x^y*(1 + x)^(y/2)",
    "U(x*y)*U''(x) + diff(Phi, 1, 2)(x, y^2)",
    "diff(x^3*y^2, x)*sin(x)",
    "w'*w",
]


@pytest.fixture(autouse=True)
def precision() -> Iterator[None]:
    with ctx.workprec(400):
        yield


def made(text: str) -> tuple[VerificationProgram, int]:
    program = VerificationProgram(("x", "y"), ("U", "Phi"), {"w": parse_text("x*sin(y)")})
    return program, program.of(parse_text(text))


def values(program: VerificationProgram, shift: dict[str, arb]) -> StepValues:
    at = {(name, 0): arb(value) + shift.get(name, 0) for name, value in POINT.items()}
    at |= {("x", 1): arb(0.4), ("y", 1): arb(-0.7)}
    return StepValues(program, {"U": Instance("U", 1), "Phi": Instance("Phi", 2)}, at)


@pytest.mark.parametrize("text", FORMULAS)
def test_first_and_second_derivatives(text: str) -> None:
    program, f = made(text.replace("acosh(x*y + 1)", "acosh(x*y + 2)"))
    symbols = [program.symbol(name) for name in POINT]
    here = values(program, {})
    gradient = here.gradient(f)
    for name, symbol in zip(POINT, symbols, strict=True):
        after, before = (values(program, {name: sign * STEP}) for sign in (1, -1))
        slope = (after(f) - before(f)) / (2 * STEP)
        assert abs(gradient.get(symbol, arb(0)) - slope) < 1e-30
        assert abs(here.rates([f], {symbol: arb(1)}).get(f, arb(0)) - slope) < 1e-30
        along = here.gradient_rates(f, gradient, {symbol: arb(1)})
        for other in symbols:
            ahead, behind = (at.gradient(f).get(other, arb(0)) for at in (after, before))
            assert abs(along.get(other, arb(0)) - (ahead - behind) / (2 * STEP)) < 1e-30


def test_a_prime_on_a_definition_is_its_rate() -> None:
    program, rate = made("w'")
    _, expected = made("x'*sin(y) + x*y'*cos(y)")
    at = values(program, {})
    assert at(rate).overlaps(at(program.of(parse_text("x'*sin(y) + x*y'*cos(y)"))))
    assert expected


@pytest.mark.parametrize("text", ["sqrt(-x)", "log(x - 1)", "(-x)^(1/3)", "1/(x - x)", "asin(2)"])
def test_no_real_value_is_none(text: str) -> None:
    program, f = made(text)
    assert not values(program, {})(f).is_finite()
