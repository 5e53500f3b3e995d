"""Rest on plateaus of potentials with kinks: everywhere between two of them, and nowhere else."""

from __future__ import annotations

import random

import pytest

from lagcli.evaluation import evaluated
from lagcli.mechanics.statements import Statements
from lagcli.reader import read_problem
from lagcli.statements.motions import Above
from tests.mechanics.derived import derive
from tests.solved import solve


def sign(x: float) -> int:
    return (x > 0) - (x < 0)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(6))
def test_rest_is_where_the_slopes_cancel(seed: int) -> None:
    """V = c k (|x - a| + |x + b|): its slope is c k (sign(x - a) + sign(x + b))."""
    source = random.Random(f"plateau {seed}")
    c = source.choice(("1", "2", "3/2", "m"))
    text = (
        "coordinates: [x]\nparameters: {m: {assume: positive}, k: {assume: positive}, a: {assume: positive}, "
        f"b: {{assume: positive}}}}\nT: x'^2/2\nV: {c}*k*abs(x - a) + {c}*k*abs(x + b)\n"
    )
    section = Statements(derive(text)).answers(["equilibria"]).sections["equilibria"]
    families = [each for each in section.equilibria if each.free]  # type: ignore[attr-defined]
    for _ in range(40):
        a, b, x = source.uniform(0.2, 2), source.uniform(0.2, 2), source.uniform(-4, 4)
        known = {"a": a, "b": b, "k": 1.0, "x": x}
        listed = any(
            all(evaluated(c.left, known, {}) > evaluated(c.right, known, {}) for c in each.where)
            for each in families
        )
        assert listed == (sign(x - a) + sign(x + b) == 0), (text, known)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_plateaus_apart_are_confirmed_wherever_they_are(seed: int) -> None:
    """V = |x - a| - |x - b| is constant for x < a and for x > b, far from all that is drawn."""
    source = random.Random(f"apart {seed}")
    a = source.randint(20, 60) * source.choice((-1, 1))
    b = a + source.randint(1, 9)
    text = f"coordinates: [x]\nT: x'^2/2\nV: abs(x - ({a})) - abs(x - ({b}))\n"
    problem = read_problem("test.yaml", text.encode()).checked()
    section = solve(problem, ["equilibria"]).sections["equilibria"]
    families = section.equilibria  # type: ignore[attr-defined]
    assert len(families) == 2
    for x in (a - 1.0, b + 1.0):
        [each] = (e for e in families if all(_holds(c, x) for c in e.where))
        assert not any(_holds(c, (a + b) / 2) for c in each.where)


def _holds(condition: Above, x: float) -> bool:
    return evaluated(condition.left, {"x": x}, {}) > evaluated(condition.right, {"x": x}, {})
