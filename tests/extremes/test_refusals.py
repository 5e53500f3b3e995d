"""What has no motion is refused, with the reason and the right exit status."""

import pytest

PLANE = "T: (x'^2 + y'^2)/2\nV: y\n"


@pytest.mark.parametrize(
    ("text", "status", "word"),
    [
        ("{coordinates: [x, y], L: x*y' - x^2 - y^2, initial: {x: 1}}", 1, "mass matrix"),
        ("{coordinates: [x, y], L: (x'^2+y'^2)/2 + 1/abs(x-y)}", 1, "divided by zero"),
        ("{coordinates: [x], L: x'^2/2 + exp(x), initial: {x: 1000}}", 1, "beyond all bounds"),
        ("{coordinates: [x], L: x'^2/2 + log(x), initial: {x: 0}}", 1, "divided by zero"),
        ("{coordinates: [x], L: x'^2/2 - sqrt(x - 1), initial: {x: 0}}", 1, "no real value"),
        ("{coordinates: [x], parameters: {m: {assume: positive, value: 0}}, L: m*x'^2/2}", 2, "'m'"),
        ("{coordinates: [x], functions: {U: [x]}, L: x'^2/2 - U(x)}", 2, "unspecified"),
        ("{coordinates: [x], parameters: [k], L: x'^2/2 - k*x^2}", 2, "'k' has no value"),
        ("{coordinates: [x], L: x'^2/2, initial: {x: log(-1)}}", 2, "not a real number"),
    ],
)  # fmt: skip
def test_refused(simulate, text, status, word):
    run = simulate(text, 1)
    assert run.status == status
    assert word in run.err
    assert run.out == ""


@pytest.mark.long
def test_constraints_that_contradict_each_other(lagcli, simulate):
    text = (
        "coordinates: [x, y]\n" + PLANE + "constraints: {one: x^2 + y^2 = 1, two: x^2 + y^2 = 2}\n"
        "initial: {x: 1, y: 0}\n"
    )
    run = simulate(text, 1)
    assert run.status == 2
    assert "'two'" in run.err
    assert "contradict" in run.err
    solved = lagcli("solve", text)
    assert solved.status in {1, 2}
    assert "contradict" in solved.err


@pytest.mark.parametrize(
    ("state", "what"),
    [("{x: 1.1, y: 0, x': 0, y': 0}", "satisfy"), ("{x: 1, y: 0, x': 1, y': 1}", "move along")],
)
def test_a_state_off_the_constraint(simulate, state, what):
    text = (
        "coordinates: [x, y]\n" + PLANE + f"constraints: {{rod: x^2 + y^2 = 1}}\ninitial: {state}\n"
    )
    refused = simulate(text, 1)
    assert refused.status == 2
    assert f"does not {what} the constraint 'rod'" in refused.err
    assert "--project" in refused.err
    taken = simulate(text, 1, "--project", show="x^2 + y^2,x*x' + y*y'")
    assert taken.status == 0
    assert taken.rows[0]["x^2 + y^2"] == pytest.approx(1, abs=1e-12)
    assert taken.rows[0]["x*x' + y*y'"] == pytest.approx(0, abs=1e-12)


def test_series_are_not_divided_by_zero(simulate):
    """A massless joint, held by its rods: doubles solve it, series stop with their reason."""
    text = """
coordinates: [x, y, u, v]
parameters: {m: 0}
T: m*(x'^2 + y'^2)/2 + (u'^2 + v'^2)/2
V: m*y + v
constraints: {first: x^2 + y^2 = 1, second: (u - x)^2 + (v - y)^2 = 1}
initial: {x: 1, y: 0, u: 1, v: -1}
"""
    run = simulate(text, 1, "--method", "taylor")
    assert run.status == 1
    assert run.err
    assert "bug" not in run.err
