"""`check` wants the initial state on the constraints, as far as the file's decimals tell."""

from __future__ import annotations

import pytest

from lagcli.pipeline import read
from lagcli.studies.check.initial import initial_mistakes

PENDULUM = """
coordinates: [x, y]
parameters: {{m: 1, g: 9.81, l: 1}}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {{rod: x^2 + y^2 = l^2}}
initial: {initial}
"""


@pytest.mark.parametrize(
    ("initial", "right"),
    [
        ("{x: 0.6, y: -0.8}", True),
        ("{x: 0.7071, y: -0.7071}", True),  # sqrt(1/2) rounded
        ("{x: 0.7071, y: -0.7071, x': 2, y': 2}", True),
        ("{x: 0.7071, y: -0.7074}", False),
        ("{x: 0.7, y: -0.7}", False),  # one decimal is no rounded number
        ("{x: 1, y: 1}", False),
        ("{x: sqrt(1/2), y: -0.7072}", False),
        ("{x: 0.7071, y: -0.7071, x': 2, y': 1}", False),
    ],
)
def test_a_state_on_the_constraints_but_for_its_last_decimal_is_right(initial: str, right: bool):
    problem = read("pendulum.yaml", PENDULUM.format(initial=initial).encode()).problem
    assert problem is not None
    assert (not initial_mistakes(problem)) is right
