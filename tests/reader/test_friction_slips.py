"""A force that drives, or that brakes another motion, is warned of; laws of books are not."""

import math
import random
import re

import pytest

from lagcli.reader import read_problem

FILE = (
    "coordinates: [x, y]\nparameters: {{m: 1, c: 0.1, mu: 0.2, q: 1, B: 2, k: 1}}\n"
    "T: m*(x'^2 + y'^2)/2\nforces: {{x: {}, y: {}}}\n"
)


def warned(along_x, along_y):
    found = read_problem("p.yaml", FILE.format(along_x, along_y).encode()).diagnostics
    assert not any(each.is_error for each in found)
    return [each.message for each in found]


@pytest.mark.parametrize(
    ("along_x", "along_y"),
    [("-c*x'", "-c*y'"), ("-mu*sign(x')", "-c*abs(y')*y'"), ("q*B*y'", "-q*B*x'"),
     ("-c*(x' - y')", "c*(x' - y')"), ("mu*(1 - x^2)*x'", "0"), ("mu*x' - c*x'^3", "0"),
     ("-k*y'", "0"), ("c*x'^2", "0"), ("-2*m*B*y'", "2*m*B*x'")],
)  # fmt: skip
def test_a_law_of_a_book_is_accepted(along_x, along_y):
    assert warned(along_x, along_y) == []


@pytest.mark.parametrize("law", ["c*x'", "mu*m*sign(x')", "c*abs(x')*x'", "k*x + c*x'^3"])
def test_a_force_that_has_the_sign_of_its_velocity_drives(law):
    [only] = warned(law, "0")
    assert only == "this force along x drives the motion: it has the sign of x'"


@pytest.mark.parametrize(("along_x", "along_y"), [("-c*y'", "-c*x'"), ("-c*y'^3", "-mu*sign(x')")])
def test_frictions_of_exchanged_velocities_are_each_named(along_x, along_y):
    x, y = warned(along_x, along_y)
    assert x == "this force along x is against the velocity y'"
    assert y == "this force along y is against the velocity x'"


IN_V = (
    "coordinates: [x, y, r]\nparameters: [m, c, k, q, B, g]\nT: m*(x'^2 + y'^2 + r'^2)/2\nV: {}\n"
)


def told(potential):
    found = read_problem("p.yaml", IN_V.format(potential).encode()).diagnostics
    return [(each.severity, each.hint) for each in found]


@pytest.mark.parametrize(
    "potential",
    [
        "k*x^2/2",
        "q*B*y*x'",
        "q*B*(x*y' - y*x')/2 + m*g*x",
        "k/r*(1 + r'^2/(2*c^2))",
        "k*(1 - r'^2/(2*c^2))/r",
        "k*(1 - r'^2/(2*c^2))/(r + k)",
        "k*x*(1 + y'^2/c^2)",
        "c*r^2*x'^2/2",
        "q*sin(k*t)*x'",
    ],
)
def test_a_potential_may_have_velocities(potential):
    assert told(potential) == []


@pytest.mark.parametrize(
    ("potential", "hint"),
    [
        ("k*x^2/2 + c*x'^2/2", "write dissipation: c*x'^2/2, and V: k*x^2/2"),
        ("k*x + c*(x' - y')^2/2 + m*g*y", "dissipation: c*(x' - y')^2/2, and V: k*x + m*g*y"),
        ("k*m*g*abs(x')", "write dissipation: k*m*g*abs(x') in place of V"),
        ("k*x^2/2 + c*x'*abs(x')", "write forces: {x: -c*x'*abs(x')}"),
        ("(k*x^2 + c*x'^2)/2", "is written dissipation: c*x'^2/2"),
    ],
)
def test_friction_has_no_potential(potential, hint):
    [(severity, given)] = told(potential)
    assert severity == "error"
    assert hint in given


@pytest.mark.parametrize("potential", ["c*x'", "k*x^2 - c*(x' + y')", "c*m*y'/2"])
def test_a_constant_rate_in_V_is_without_effect(potential):
    [(severity, hint)] = told(potential)
    assert severity == "warning"
    assert "dissipation" in hint


KEYS = [
    ("friction: mu", "forces: {x: -mu*N*sign(x')}, with the normal force N written out"),
    ("friction: 0.3", "forces: {x: -0.3*N*sign(x')}, with the normal force N written out"),
    ("dry_friction: 0.3*m*g", "forces: {x: -0.3*m*g*sign(x')}"),
    ("friction: {mu: 0.3}", "forces: {x: -0.3*N*sign(x')}"),
    ("friction: {x: -c*x'}", "forces: {x: -c*x'}"),
    ("friction: c", "dissipation: c*x'^2/2: its force is -c*x'"),
    ("drag: -c*|v|*v", "forces: {x: -c*abs(x')*x'}"),
    ("drag: c*x'^2", "forces: {x: -c*x'*abs(x')}"),
    ("dampers: {shock: c*x'}", "dissipation: c*x'^2/2"),
    ("dashpots: [c*x', -k*xdot]", "dissipation: c*x'^2/2 + k*x'^2/2"),
    ("dampers:\n  one:\n    force: -c*x'", "dissipation: c*x'^2/2"),
    ("damping: {c: 0.3}", "dissipation: 0.3*x'^2/2: its force is -0.3*x'"),
    ("shock_absorber: {c1: c*x'^2/2}", "dissipation: c*x'^2/2"),
]


@pytest.mark.parametrize(("written", "hint"), KEYS)
def test_friction_under_another_key_is_told_where_it_stands(written, hint):
    text = f"coordinates: [x]\nparameters: [m, c, k, mu, g]\nT: m*x'^2/2\n{written}\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert only.hint.startswith(f"write {hint}")


def test_a_word_for_friction_that_a_formula_uses_is_a_constant():
    text = "coordinates: [x]\nT: x'^2/2\nforces: {x: -friction*x'}\nfriction: 0.3\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    assert only.hint == "constants stand under parameters: write parameters: {friction: 0.3}"


@pytest.mark.parametrize("seed", range(8))
def test_dry_friction_without_the_sign_of_its_velocity(seed):
    draw = random.Random(seed)
    mu, normal = draw.choice(["mu", "mu_k", "mu1"]), draw.choice(["m*g", "m*g*cos(a)", "N", "N/2"])
    law, other = f"-{mu}*{normal}", draw.choice(["", " + F", " - k*x"])
    begin = (
        f"coordinates: [x]\nparameters: {{m: 1, g: 9.81, N: 2, a: 0.5, F: 3, k: 2, {mu}: 0.1}}\n"
        "T: m*x'^2/2\nforces: {x: "
    )

    def hints(force):
        return [each.hint for each in read_problem("p", f"{begin}{force}}}\n".encode()).diagnostics]

    assert hints(law + other) == [f"write {law}*sign(x')"]
    for right in (f"{law}*sign(x'){other}", f"{law}{other} - k*x'", f"-{mu}*k*x", f"-{mu}/x^2"):
        assert hints(right) == []


@pytest.mark.parametrize(
    ("law", "meant"),
    [
        ("-c*x'^2/2", "c*x'^2/2"),
        ("-c*x'^2/2 - k*y'^2/2", "c*x'^2/2 + k*y'^2/2"),
        ("-(c*x'^2 + k*(x' - y')^2)/2", "(c*x'^2 + k*(x' - y')^2)/2"),
    ],
)
def test_a_negative_dissipation_is_shown_with_the_other_sign(law, meant):
    begin = (
        "coordinates: [x, y]\nparameters: {m: 1, c: 2, k: 3}\nT: m*(x'^2 + y'^2)/2\ndissipation: "
    )
    [told] = read_problem("p", f"{begin}{law}\n".encode()).diagnostics
    assert told.hint == f"it drives the motion: write {meant}"
    assert read_problem("p", f"{begin}{meant}\n".encode()).diagnostics == ()


@pytest.mark.parametrize("law", ["0.1", "c", "c/2", "2*c"])
def test_a_coefficient_is_no_dissipation(law):
    text = f"coordinates: [x]\nparameters: {{m: 1, c: 2}}\nT: m*x'^2/2\ndissipation: {law}\n"
    [told] = read_problem("p", text.encode()).diagnostics
    assert told.hint.startswith(f"write {law}*x'^2/2: ")
    right = text.replace(f": {law}\n", f": {law}*x'^2/2\n")
    assert read_problem("p", right.encode()).diagnostics == ()


def value(formula, rate):
    names = {"abs": abs, "tanh": math.tanh, "c": 2, "m": 3, "k": 5, "v": rate}
    return eval(formula.replace("x'", "v").replace("^", "**"), names)


@pytest.mark.parametrize("section", ["dissipation: ", "V: k*x + "])
@pytest.mark.parametrize("law", [
    "c*x'^3/3", "c*m*x'^5/5", "x'^3*c/6", "c*abs(x')^2*x'/3", "x'*abs(x')/3*c",
    "c*x'*abs(x')", "c*x'^3", "k*x'^5/2", "c*x'^2*tanh(x'/3)", "x'^3/m",
])  # fmt: skip
def test_an_odd_function_of_a_velocity_is_written_such_that_it_brakes(section, law):
    text = f"coordinates: [x]\nparameters: [m, c, k]\nT: m*x'^2/2\n{section}{law}\n"
    [only] = read_problem("p.yaml", text.encode()).diagnostics
    where, given = re.search(
        r"(?:write |dissipation: )?(dissipation|forces)?(?:: \{x: )?([^:,{}]*\w'[^:,{}]*)",
        only.hint,
    ).groups()
    for rate in (-2, -1, 1, 2):
        found = value(given, rate)
        assert abs(found) == pytest.approx(abs(value(law, rate)))
        assert found * rate < 0 if where == "forces" else found > 0
    assert (where == "forces") == ("/3*" not in law and not re.search("/[356]$", law))
