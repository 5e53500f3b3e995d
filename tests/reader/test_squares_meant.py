"""A velocity whose square was forgotten in a sum of squares is warned of."""

import random

import pytest

from tests.reader.test_habits import messages, text

MOVING = {"coordinates": "[x, y, phi]", "parameters": "[m, l, c, v]", "V": None}
FULL = "m*(x'^2 + y'^2)/2 + m*l^2*phi'^2/2"


@pytest.mark.parametrize("seed", range(12))
def test_a_velocity_without_its_square_is_warned_of(seed):
    draw = random.Random(seed)
    name = draw.choice(["x", "y", "phi"])
    if draw.random() < 0.5:
        energies, key = {"T": FULL.replace(f"{name}'^2", f"{name}'")}, "T"
    else:
        lost = "c*(x'^2 + y'^2)/2 + c*l^2*phi'^2/2".replace(f"{name}'^2", f"{name}'")
        energies, key = {"T": FULL, "dissipation": lost}, "the dissipation"
    [found] = messages(text(**MOVING | energies))
    assert found.startswith(
        f"{key} has {name}' without its square; the square of {name}' is missing"
    )


@pytest.mark.parametrize(
    "kinetic",
    ["m*((x' + v)^2 + y'^2)/2 + l*phi'^2", "m*(x'^2 + 2*v*x' + v^2 + y'^2 + phi'^2)/2",
     "m*(x'*x' + y'^2 + phi'^2)", "m*(x'^2 + y'^2)/2 + m*c^2*(1 - sqrt(1 - phi'^2/c^2))",
     "m*(x' - y')^2 + m*(y' + phi')^2 + m*x'^2",
     "m*(x'^2 + y'^2 + 2*l*x'*phi'*cos(phi) + l^2*phi'^2)/2"],
)  # fmt: skip
def test_squares_in_other_forms_are_found(kinetic):
    assert not any("square of" in each for each in messages(text(**MOVING | {"T": kinetic})))
