"""Real forces: against textbooks, against their virtual work, against Newton's second law."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from random import Random

import pytest
import sympy
from sympy import Expr

from lagcli import load
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.statements import Statements
from lagcli.reader import parse_text
from lagcli.statements.answers import Answers
from lagcli.statements.forces import ForcesSection

from .derived import derive, same

LIBRARY = Path(__file__).parents[2] / "problems"
WITH_POINTS = sorted(
    path
    for path in LIBRARY.rglob("*.yaml")
    if {"points:", "constraints:"} <= {line.split(" ")[0] for line in path.read_text().split("\n")}
    and path.stem != "triangle-of-points"  # six seconds to solve, and rods again
)


@cache
def library(path: Path) -> tuple[Derivation, ForcesSection]:
    derivation = Derivation(load(path))
    return derivation, answered(derivation)[0]


def answered(derivation: Derivation) -> tuple[ForcesSection, Answers]:
    answers = Statements(derivation).answers(["forces"])
    section = answers.sections["forces"]
    assert isinstance(section, ForcesSection)
    return section, answers


@pytest.mark.long
@pytest.mark.parametrize("path", WITH_POINTS, ids=lambda path: path.stem)
def test_the_forces_of_the_library_do_the_work_of_their_multipliers(path: Path):
    """sum F e . dr/dq + torque = lambda df/dq at states on the constraints, and |e| = 1."""
    derivation, section = library(path)
    dynamics, build = derivation.dynamics, derivation.system.build
    if section.forces is None:
        assert "unique" in section.reason
        return
    positions = {p.name: p.position for p in derivation.system.particles}
    assert section.forces
    for equation, force in zip(
        dynamics.constraints.equations, dynamics.constraint_forces, strict=True
    ):
        mine = [f for f in section.forces if f.constraint == equation.name and f.force is not None]
        torques = section.torques.get(equation.name, {})
        for j, q in enumerate(derivation.system.q):
            work = build(torques[q.name]) if q.name in torques else sympy.S.Zero
            for each in mine:
                vector = [build(each.force) * build(e) for e in each.direction]
                parts = zip(vector, positions[each.point], strict=True)
                work += sympy.Add(*(part * x.diff(q) for part, x in parts))
            assert dynamics.verifier.is_zero(work - force[j]).holds is True
        for each in mine:
            square = sympy.Add(*(build(e) ** 2 for e in each.direction))
            assert dynamics.verifier.is_zero(square - 1).holds is True


@pytest.mark.parametrize("path", WITH_POINTS, ids=lambda path: path.stem)
def test_directions_point_where_they_are_said_to(path: Path):
    """e . (r_k - r) has the sign of the word at random states."""
    derivation, section = library(path)
    system = derivation.system
    positions: dict[str, tuple[Expr, ...]] = {p.name: p.position for p in system.particles}
    for force in section.forces or ():
        name = force.towards if force.towards is not None else force.away_from
        if name is None:
            continue
        here = positions[force.point]
        there = positions.get(name, (sympy.S.Zero,) * len(here))
        inner = sympy.Add(
            *(
                system.build(e) * (b - a)
                for e, a, b in zip(force.direction, here, there, strict=True)
            )
        )
        for state in derivation.dynamics.states.take(3):
            value = inner.subs(state).evalf()
            assert (value > 0) == (force.towards is not None)


PENDULUM = """
coordinates: {x: {}, y: {}}
parameters: {m: {assume: positive}, g: {assume: positive}, l: {assume: positive}}
points: {bob: {position: [x, y], mass: m}}
V: m*g*y
constraints: {rod: {equation: x^2 + y^2 = l^2, acts_as: tension}}
"""


def test_the_tension_of_a_pendulum_is_a_pull_whichever_way_the_rod_is_written():
    """m v^2/l + m g cos(theta) with cos(theta) = -y/l (Taylor, section 7.10, method)."""
    expected = "m*(x'^2 + y'^2)/l - m*g*y/l"
    for equation in ("x^2 + y^2 = l^2", "l^2 = x^2 + y^2", "x^2 + y^2 - l^2", "l = sqrt(x^2+y^2)"):
        derivation = derive(PENDULUM.replace("x^2 + y^2 = l^2", equation))
        section, answers = answered(derivation)
        assert section.forces is not None
        [rod] = section.forces
        assert rod.towards == ""
        assert rod.force is not None
        difference = derivation.system.build(rod.force) - _built(derivation, expected)
        assert derivation.dynamics.verifier.is_zero(difference).holds
        assert answers.complete


def _built(derivation: Derivation, text: str) -> Expr:
    return derivation.system.build(parse_text(text))


def test_a_force_points_to_a_support_that_is_given():
    text = PENDULUM.replace("x^2 + y^2 = l^2", "x^2 + (y - 2*l)^2 = l^2").replace(
        "points: {", "points: {support: {position: [0, 2*l], mass: 1}, "
    )
    section, _ = answered(derive(text))
    assert section.forces is not None
    assert [(f.point, f.towards) for f in section.forces] == [("bob", "support")]


def test_a_tension_that_its_condition_lets_only_push_is_told():
    one_sided = "rod: {equation: x^2 + y^2 = l^2, multiplier: S, holds_while: S >= 0,"
    _, answers = answered(derive(PENDULUM.replace("rod: {equation: x^2 + y^2 = l^2,", one_sided)))
    assert "lets it push away from the origin only" in answers.warnings[0]
    pulling = one_sided.replace("S >= 0", "S <= 0")
    _, answers = answered(derive(PENDULUM.replace("rod: {equation: x^2 + y^2 = l^2,", pulling)))
    assert answers.warnings == ()


ROLLING = """
coordinates: {x: {}, y: {}, phi: {}}
parameters: {m: {assume: positive}, g: {assume: positive}, R: {assume: positive}, a: {}, I: {assume: positive}}
points: {body: {position: [x, y], mass: m}}
T: m*(x'^2 + y'^2)/2 + I*phi'^2/2
V: m*g*(y*cos(a) - x*sin(a))
constraints:
  floor: {equation: y = R, multiplier: N, holds_while: N >= 0}
  rolling: {equation: x = R*phi, acts_as: friction}
"""


@pytest.mark.parametrize(
    ("inertia", "ratio"), [("m*R^2/2", "1/3"), ("m*R^2", "1/2"), ("2*m*R^2/5", "2/7")]
)
def test_the_friction_that_rolling_down_an_incline_needs(inertia: str, ratio: str):
    """Cylinder, hoop, ball: a force k/(1 + k) m g sin(a) along the plane, m g cos(a) across."""
    derivation = derive(ROLLING.replace("I*phi", f"({inertia})*phi"))
    section, answers = answered(derivation)
    [needed] = section.friction_needed
    assert (needed.normal, needed.frictions) == ("floor", ("rolling",))
    assert same(derivation, derivation.system.build(needed.coefficient), f"abs(tan(a))*{ratio}")
    assert answers.complete


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("  floor: {equation: y = R, multiplier: N, holds_while: N >= 0}\n", "  floor: y = R\n",
         "no normal force acts on the same points"),
        ("V: m*g*(y*cos(a) - x*sin(a))", "V: 0", "the normal force is 0"),
        ("  rolling", "  lid: {equation: y - R = 0, acts_as: normal}\n  rolling",
         "several normal forces are at right angles to it: floor, lid"),
    ],
)  # fmt: skip
def test_a_coefficient_that_is_not_determined_is_not_given(before: str, after: str, reason: str):
    section, answers = answered(derive(ROLLING.replace(before, after)))
    [needed] = section.friction_needed
    assert needed.coefficient is None
    assert reason in needed.reason
    assert not answers.complete
    assert any(reason in warning for warning in answers.warnings)


def test_a_torque_is_no_force_on_a_point():
    section, _ = answered(derive(ROLLING))
    assert [*section.torques] == ["rolling"]
    assert to_grammar(section.torques["rolling"]["phi"]).count("R")


def test_forces_without_points_are_not_guessed():
    section, answers = answered(
        derive(ROLLING.replace("points: {body: {position: [x, y], mass: m}}\n", ""))
    )
    assert section.forces is None
    assert "no `points`" in section.reason
    assert not answers.complete


def test_more_components_than_coordinates_are_not_unique():
    text = PENDULUM.replace("{x: {}, y: {}}", "{x: {}}").replace("[x, y]", "[x, x^2]")
    text = text.replace("V: m*g*y", "V: 0").replace("x^2 + y^2 = l^2", "x = l")
    section, answers = answered(derive(text))
    assert section.forces is None
    assert "not unique" in section.reason
    assert not answers.complete


@pytest.mark.parametrize(
    ("body", "stated"),
    [("0", True), ("I*theta'^2/2", True), ("M*x'^2/2", False), ("M*x'*theta'*cos(theta)", False)],
)
def test_no_force_is_stated_on_a_point_that_carries_a_body_along(body: str, stated: bool):
    """The friction of a rolling disc acts on the disc, not on a bead that sits on it."""
    text = (
        "coordinates: [x, theta]\nparameters: [m, M, I, R, b]\n"
        "points: {bead: {position: [x + b*cos(theta), b*sin(theta)], mass: m}}\n"
        "T: m*(x'^2 - 2*b*x'*theta'*sin(theta) + b^2*theta'^2)/2 + %s\n"
        "constraints: {rolling: x' = R*theta'}\n"
    )
    if "I" in body:  # a body that turns about the point itself
        text = text.replace("x + b*cos(theta), b*sin(theta)", "x").replace(
            "(x'^2 - 2*b*x'*theta'*sin(theta) + b^2*theta'^2)", "x'^2"
        )
    section, _ = answered(derive(text % body))
    assert (section.forces is not None) is stated


@pytest.mark.parametrize(
    ("attributes", "coefficient", "where"),
    [
        ("{}", "abs(tan(a))", []),
        ("{value: 0.4}", "tan(a)", ["tan(a)"]),
        ("{value: -0.4}", "-tan(a)", ["-tan(a)"]),
    ],
    ids=["unknown", "up", "down"],
)
def test_the_values_of_the_file_decide_a_modulus(attributes, coefficient, where):
    derivation = derive(f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}, a: {attributes}}}
points: {{block: {{position: [x, y], mass: m}}}}
V: m*g*(y*cos(a) - x*sin(a))
constraints:
  incline: {{equation: y = 0, multiplier: N, holds_while: N >= 0}}
  grip: {{equation: x = 0, acts_as: friction}}
""")
    [needed] = answered(derivation)[0].friction_needed
    assert to_grammar(needed.coefficient) == coefficient
    assert [to_grammar(each) for each in needed.where] == where


@pytest.mark.parametrize("seed", range(3))
def test_no_force_is_stated_across_a_line_on_which_a_bead_slides(seed: int):
    """The rod between beads on two wires pushes across these too, but the wires take it up."""
    rng = Random(seed)
    offset, height, slope = rng.sample(range(1, 6), 3)
    text = f"""
coordinates: [x, y]
parameters: [m, M, l, g]
points:
  A: {{position: [{slope}*x, {height}], mass: m}}
  B: {{position: [{offset}, y - x^{rng.choice([0, 2])}], mass: M}}
V: M*g*y
constraints: {{rod: "({slope}*x - {offset})^2 + (y - {height})^2 = l^2"}}
"""
    section = Statements(derive(text)).answers(["constraint_forces"]).sections["constraint_forces"]
    on = section.on_points["rod"]
    assert on["A"][1] is None
    assert on["B"][0] is None
    assert on["A"][0] is not None
    assert on["B"][1] is not None
