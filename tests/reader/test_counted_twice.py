"""A force that follows from V as well is warned of: it acts twice."""

import random

import pytest

from lagcli.reader import read_problem

#: A term of V, and its force along x and y.
TERMS = {
    "m*g*y": ("0", "-m*g"),
    "k*x^2/2": ("-k*x", "0"),
    "c*(x^2 + y^2)/2": ("-c*x", "-c*y"),
    "-m*g*cos(x/l)": ("-m*g/l*sin(x/l)", "0"),
    "k/sqrt(x^2 + y^2)": ("k*x/(x^2 + y^2)^(3/2)", "k*y/(x^2 + y^2)^(3/2)"),
    "-k*x*sin(t)": ("k*sin(t)", "0"),
}
HEAD = "coordinates: [x, y]\nparameters: [m, g, k, l, c]\n"


def warned(text):
    found = read_problem("p.yaml", text.encode()).diagnostics
    assert not any(each.is_error for each in found)
    return [each.hint for each in found if "acts twice" in each.message]


@pytest.mark.parametrize("seed", range(16))
def test_a_force_of_a_term_of_v_acts_twice(seed):
    draw = random.Random(seed)
    terms = draw.sample([*TERMS], draw.randrange(1, 4))
    doubled = terms[0]
    x, y = TERMS[doubled]
    potential = " + ".join(draw.sample(terms, len(terms))).replace("+ -", "- ")
    doubled = doubled.removeprefix("-")
    more = draw.choice(["", " - c*x'"])
    if draw.random() < 0.5:
        text = f"points: {{P: {{position: [x, y], mass: m, force: [{x}, {y}]}}}}\n"
    else:
        given = {name: law for name, law in (("x", x), ("y", y)) if law != "0"}
        forces = ", ".join(f"{name}: {law}{more}" for name, law in given.items())
        text = f"T: m*(x'^2 + y'^2)/2\nforces: {{{forces}}}\n"
    found = warned(f"{HEAD}{text}V: {potential}\n")
    assert found
    assert all(each.partition(", or ")[2].removeprefix("-").startswith(doubled) for each in found)


def test_the_weight_of_a_bob_is_that_of_its_angle():
    bob = "position: [l*sin(theta), -l*cos(theta)], mass: m, force: [0, -m*g]"
    head = f"coordinates: [theta]\nparameters: [m, g, l]\npoints: {{bob: {{{bob}}}}}\n"
    assert warned(head + "V: -m*g*l*cos(theta)\n") == ["leave it out, or -m*g*l*cos(theta) in V"]
    assert warned(head + "V: -2*m*g*l*cos(theta)\n") == []
    assert warned(head) == []


@pytest.mark.parametrize("force", ["m*g", "-m*g/2", "-m*g*sin(t)", "-m*g*l/c", "-c*y'", "0"])
def test_another_force_is_not_warned_of(force):
    rest = f"T: m*(x'^2 + y'^2)/2\nV: m*g*y + k*x^2/2\nforces: {{y: {force}}}\n"
    assert warned(HEAD + rest) == []


@pytest.mark.parametrize("potential", ["U(x)", "k*(-x)^(3/2)", "k*log(-x)", "k/(x - x)", "k*x^l"])
def test_a_potential_without_numbers_is_not_compared(potential):
    rest = f"functions: {{U: [x]}}\nT: m*(x'^2 + y'^2)/2\nV: {potential}\nforces: {{x: -k*x}}\n"
    assert warned(HEAD + rest) == []
