"""Whatever the formulas of a file are, every section ends with an answer or with a sentence."""

from __future__ import annotations

import json
import random

import jsonschema
import pytest

from lagcli.evaluation import FUNCTIONS, evaluated
from lagcli.expression import Expression
from lagcli.formatters import Options
from lagcli.formatters.schema import answers_schema
from lagcli.mechanics import stating
from lagcli.mechanics.statements import Statements
from lagcli.pipeline import Request, derive, read, render, state
from lagcli.platform.effort import EFFORT
from lagcli.reader import parse_text
from lagcli.record import replace
from lagcli.sections import energy, equilibria
from lagcli.statements.answers import Answers
from lagcli.statements.registry import built_in

HEAD = """
coordinates: [x, y]
parameters: {m: {assume: positive}, k: {assume: positive}, c: {assume: positive}}
T: m*(x'^2 + y'^2)/2
"""
#: Everything but what searches, and what begins with the same search for equilibria.
SLOW = {"discovered", "algebra", "modes", "steady_motions"}
QUICK = [s for s in (each.name for each in built_in()) if s not in SLOW]


def answers(text: str, sections: list[str]) -> Answers:
    problem = read("test.yaml", text.encode()).problem
    assert problem is not None
    return state(derive(problem), Request(sections=tuple(sections)))


def assert_sound(found: Answers) -> None:
    """No section failed by a mistake of lagcli, and all that is printed can be read back."""
    assert not [w for w in found.warnings if "bug" in w]
    for name in ("text", "latex", "markdown", "html"):
        assert "Dirac" not in render([found], name, Options())
    printed = json.loads(render([found], "json", Options()))
    for value in (printed.get("accelerations") or {}).values():
        parse_text(value)
    assert "Dirac" not in json.dumps(printed)


def potential(source: random.Random) -> str:
    """Terms with signs, absolute values, roots and e of one and two coordinates."""
    argument = source.choice(["x", "y", "x - y", "x - c", "sin(x)", "x^2 - c^2"])
    other = source.choice(["x", "y", "x + 2*y"])
    shapes = [
        "k*abs({a})",
        "k*({a})^2*sign({a})",
        "k*({a})*sign({a})",
        "k*abs({a})^3",
        "k*exp(1)*({a})^2",
        "k*exp(abs({a}))",
        "k*sqrt(c^2 + ({a})^2)",
        "k*abs({a})*abs({b})",
        "k*abs(abs({a}) - c)",
        "k*sign({a})",
        "k*sqrt(abs({a}))",
    ]
    return " + ".join(term.format(a=argument, b=other) for term in source.sample(shapes, 2))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(4))
def test_signs_and_absolute_values_in_the_potential_break_no_section(seed: int) -> None:
    source = random.Random(f"signs {seed}")
    assert_sound(answers(f"{HEAD}V: {potential(source)}\n", QUICK))


@pytest.mark.parametrize(
    "argument", ["x/(2 + sin(y))", "log(cos(x)^2)", "x^c", "asin(sin(x))", "atanh(tanh(x)/2)"]
)
def test_what_sympy_does_not_know_to_be_real_breaks_no_section(argument: str) -> None:
    """d|u|/dx is sign(u) du/dx; SymPy leaves re(u), or the derivative of the sign."""
    text = f"{HEAD}V: k*abs({argument}) + ({argument})*sign({argument})\n"
    found = answers(text, ["equations", "accelerations", "energy", "charges", "reduction"])
    assert_sound(found)
    assert not any(f in render([found], "json", Options()) for f in ("re(", "im("))
    assert found.sections["accelerations"].accelerations  # type: ignore[attr-defined]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_signs_and_absolute_values_in_constraints_break_no_section(seed: int) -> None:
    source = random.Random(f"wedges {seed}")
    side = source.choice(["k*abs(x)", "k*x*sign(x)", "abs(x - c)", "sqrt(abs(x))", "abs(x)^3"])
    text = f"{HEAD}V: m*c*y\nconstraints:\n  wedge: {source.choice(['y', '2*y'])} = {side}\n"
    assert_sound(answers(text, QUICK))


@pytest.mark.long
@pytest.mark.parametrize(
    ("given", "held"),
    [
        ("k*abs(x)", 1), ("k*x^2*sign(x)", 1), ("k*sign(x)", 0), ("k*y", 2),
        ("k*y^2*sign(y/x)", 0), ("k*y*x^2*sign(x/y)", 1), ("k*x*sign(x/(2 + sin(y)))", 1),
    ],
)  # fmt: skip
def test_what_jumps_on_the_motion_is_not_called_conserved(given: str, held: int) -> None:
    """m x' + k t sign(x) is constant only until x = 0 is crossed; nothing is, past a step."""
    text = f"{HEAD}V: {given}\nsymmetries: {{s: {{x: 1}}}}\n"
    found = answers(text, ["charges", "discovered"]).sections
    every = [*found["charges"].charges, *found["discovered"].charges]  # type: ignore[attr-defined]
    conserved = [c for c in every if c.conserved]
    assert len(conserved) >= held
    assert not [c.name for c in conserved if jumps(c.charge)]
    assert held or not conserved


@pytest.mark.parametrize("side", ["sign(y)", "sign(x/y)", "sign(y/(2 + sin(x)))", "sign(y)^2"])
@pytest.mark.parametrize("given", ["k*x^2*", "k*"])
def test_a_coordinate_that_makes_l_jump_is_not_cyclic(given: str, side: str) -> None:
    """dL/dy is 0 beside the jump; the Routhian would still hold y."""
    sections = ["charges", "energy", "equilibria", "reduction", "steady_motions"]
    found = answers(f"{HEAD}V: {given}{side}\n", sections)
    assert_sound(found)
    assert not any("bug of lagcli" in warning for warning in found.warnings)
    assert "y" not in found.sections["reduction"].momenta  # type: ignore[attr-defined]


def jumps(charge: Expression) -> bool:
    """Whether it has another value beyond x = 0, as k t sign(x) has but not x^2 sign(x)."""
    others = {"y": 0.3, "x'": 0.7, "y'": -0.4, "m": 1.1, "k": 1.3, "c": 0.6, "t": 0.9}
    sides = [evaluated(charge, {**others, "x": x}, FUNCTIONS) for x in (1e-9, -1e-9)]
    return bool(abs(sides[0] - sides[1]) > 1e-6)


@pytest.mark.long
@pytest.mark.parametrize("links", [4, 5])
@pytest.mark.parametrize("cart", [False, True])
def test_a_chain_too_long_for_closed_accelerations_says_so(links: int, cart: bool) -> None:
    angles = [f"a{i}" for i in range(links)]
    x = ["x"] if cart else []
    lines = [f"coordinates: [{', '.join([*x, *angles])}]", "parameters: [m, l, g, M]", "points:"]
    across, up = "x" if cart else "0", "0"
    for i, angle in enumerate(angles):
        across, up = f"{across} + l*sin({angle})", f"{up} - l*cos({angle})"
        lines.append(f"  p{i}: {{position: ['{across}', '{up}'], mass: m}}")
    if cart:
        lines.append("  cart: {position: [x, 0], mass: M}")
    lines.append("V: -m*g*l*(" + " + ".join(f"cos({a})" for a in angles) + ")")
    found = answers("\n".join(lines), ["accelerations", "energy"])
    section = found.sections["accelerations"]
    assert section.regular  # type: ignore[attr-defined]
    assert not section.degenerate  # type: ignore[attr-defined]
    assert found.sections["energy"].conserved  # type: ignore[attr-defined]
    if section.accelerations is None:  # type: ignore[attr-defined]
        assert not found.complete
        assert "not solved in closed form" in found.warnings[0]


def test_a_section_that_is_broken_leaves_the_others(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(_self: Statements) -> None:
        raise ZeroDivisionError("of a test")

    monkeypatch.setattr(energy, "SECTION", replace(energy.SECTION, derive=broken))
    found = answers(f"{HEAD}V: k*x^2/2\n", ["momenta", "energy", "charges"])
    assert list(found.sections) == ["momenta", "charges"]
    assert (found.absent, found.complete) == (("energy",), False)
    assert len(found.warnings) == 1
    assert found.warnings[0].startswith(
        "the section 'energy' could not be found: this is a bug of lagcli (ZeroDivisionError: "
    )
    printed = json.loads(render([found], "json", Options()))
    assert printed["energy"] is None
    jsonschema.validate(printed, answers_schema())
    assert "Energy\n  Not found: see the warnings." in render([found], "text", Options())


def test_a_section_that_takes_too_much_work_is_null(monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(_self: Statements) -> None:
        while True:
            EFFORT.fractions += 1

    monkeypatch.setattr(equilibria, "SECTION", replace(equilibria.SECTION, derive=endless))
    monkeypatch.setattr(stating, "UNITS", 100_000)
    found = answers(f"{HEAD}V: k*x^2/2\n", ["momenta", "equilibria"])
    assert (list(found.sections), found.absent) == (["momenta"], ("equilibria",))
    assert found.warnings == (
        "the section 'equilibria' could not be found: it takes more work than it is allowed",
    )


@pytest.mark.long
@pytest.mark.parametrize("power", [201, 1000, 50_000])
def test_a_high_power_ends_the_search_for_special_values_with_a_sentence(power: int) -> None:
    found = answers(f"{HEAD}V: k*x^{power} + c*y^2\n", ["algebra"])
    assert not [w for w in found.warnings if "bug" in w]


@pytest.mark.long
@pytest.mark.parametrize("force", ["-c*sign(x')", "-c*x'*abs(x')", "-c*sign(x' + y')*abs(y')"])
@pytest.mark.parametrize("side", ["y = 0", "y = x", "x^2 + y^2 = c^2"])
def test_signs_of_velocities_on_a_constraint_break_no_section(force: str, side: str) -> None:
    text = f"{HEAD}V: k*y\nforces: {{x: {force}}}\nconstraints: {{surface: {side}}}\n"
    assert_sound(answers(text, ["discovered"]))


#: Files of the library in which one sign, power or prime was mistaken.
NOT_AT_REST = """
coordinates: [x, y]
parameters: {m: {assume: positive}, q: {assume: nonzero}}
L: m/(x'^2 + y'^2)/2 + q*(x*y' - y*x')/2
"""
NO_INERTIA = """
coordinates: [theta]
parameters: {m: {assume: positive}, g: {assume: positive}}
T: m*theta^2/2
V: -m*g*cos(theta)
"""
INVERSE_RATE = """
coordinates: {theta: {}, phi: {}}
parameters: {m: {assume: positive}, g: {assume: positive}}
T: m*(theta'^2 + sin(theta)^2/phi'^2)/2
V: -m*g*cos(theta)
"""
FOURTH_POWER = """
coordinates: {x: {}, theta: {}, phi: {}}
parameters: {m: {assume: positive}, g: {assume: positive}}
T: m*(x'^2 + theta'^2 + phi'^4*sin(theta)^2)/2
V: m*g*sin(theta)
"""


@pytest.mark.parametrize("text", [NOT_AT_REST, NO_INERTIA, INVERSE_RATE, FOURTH_POWER])
def test_a_mistaken_kinetic_energy_breaks_no_section(text: str) -> None:
    assert_sound(answers(text, [*QUICK, "modes", "steady_motions"]))
