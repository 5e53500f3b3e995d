"""Rest and steady motions beside walls that may move, and under motors along constraints."""

from __future__ import annotations

import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.pipeline import explain

from .derived import derive
from .test_explanation import words

_UP = "{assume: positive}"


@pytest.mark.parametrize("seed", range(4))
def test_a_motor_against_drag_turns_what_rolls_at_a_constant_rate(seed):
    """The power of the motor is that of the drags: τ Ω = (a R² + b) Ω²."""
    source = random.Random(seed)
    R, a, b = (source.randint(1, 5) for _ in range(3))
    first, second = source.sample(["x", "th"], 2)
    text = (
        f"{{coordinates: [{first}, {second}], parameters: {{tau: {_UP}}}, "
        f"T: x'^2/2 + th'^2, constraints: {{r: x = {R}*th}}, "
        f"forces: {{x: -{a}*x', th: tau - {b}*th'}}}}"
    )
    section, _ = steady_motions(derive(text))
    [motion] = section.motions or ()
    [(name, rate)] = (motion.rates or {}).items()
    slow, by = a * R**2 + b, R if name == "x" else 1
    expected = {f"tau/{slow}", "tau"} if by == 1 else {f"{by}*tau/{slow}", f"tau/{slow // by}"}
    assert to_grammar(rate) in expected
    assert motion.verdict.asymptotic


@pytest.mark.parametrize("seed", range(4))
def test_at_a_minimum_a_wall_that_is_touched_only_is_no_danger(seed):
    source = random.Random(seed)
    a, b, s = source.randint(1, 5), source.randint(1, 5), source.choice([-1, 1])
    text = (
        f"{{coordinates: [x, y], T: x'^2 + x'*y'/2 + y'^2, V: {a}*x^2 + {s}*x*y + {b}*y^4 + y^2, "
        "contacts: {w: {gap: x >= 0, restitution: 1/2}}}"
    )
    found = equilibria(derive(text).dynamics).equilibria or ()
    assert [e.verdict.stable for e in found] == [True]


def test_beside_a_saddle_it_stays_undecided():
    text = (
        "{coordinates: [x, y], T: x'^2 + y'^2, V: x^2 - y^2 - y^3*x, "
        "contacts: {w: {gap: x >= 0, restitution: 1/2}}}"
    )
    found = equilibria(derive(text).dynamics).equilibria or ()
    touching = [e.verdict.stable for e in found if e.touching]
    assert touching
    assert True not in touching


@pytest.mark.parametrize("side", ["y >= 0", "x >= 0"])
def test_a_slope_may_lie_flat(side):
    """On y = 0 a body rests where sin(a) = 0: it is not that sin(a) and cos(a) must vanish."""
    text = (
        f"{{coordinates: [x, y], parameters: {{g: {_UP}, a: {{}}}}, T: (x'^2 + y'^2)/2, "
        f"V: g*(y*cos(a) - x*sin(a)), contacts: {{w: {{gap: {side}, restitution: 0}}}}}}"
    )
    told = words(explain(derive(text), ["equilibria", "steady_motions"]), "Equilibria")
    assert "unless" not in told
    assert equilibria(derive(text).dynamics).unless is None
    section, _ = steady_motions(derive(text))
    assert section.unless == ()


def test_the_period_beside_a_wall_that_moves_is_left_out():
    text = (
        "{coordinates: [x], parameters: {w: {}}, T: x'^2/2, V: x^2/2, "
        "contacts: {w1: {gap: x >= sin(w*t), restitution: 1}}}"
    )
    told = explain(derive(text), ["reduction"])
    assert words(told, "The reduction")
    assert told.warnings == ()
