"""Rolling, edges of the coordinates and turning points, as textbooks set them."""

from __future__ import annotations

import math
import random

import mpmath
import pytest
import sympy

from lagcli.algebra.opening import by_distances
from lagcli.document import Equations, Label
from lagcli.formatters.grammar import to_grammar
from lagcli.pipeline import Request, state
from lagcli.sections.reduction import blocks

from .derived import derive
from .test_textbook_answers import number, section

DISK = """
coordinates: [x, y, theta, phi, psi]
parameters: {{m: {{assume: positive}}, R: {{assume: positive}}, A: {{assume: positive}}, C: {{assume: positive}}, g: {{assume: positive}}}}
T: m*(x'^2 + y'^2 + R^2*cos(theta)^2*theta'^2)/2 + A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2
V: m*g*R*sin(theta)
constraints:
  along: x'*cos({turned}) + y'*sin({turned}) + {along}
  across: y'*cos({turned}) - x'*sin({turned}) + {across}
"""
SLIPS = "R*(psi' + phi'*cos(theta))", "R*sin(theta)*theta'"


def disk(turned):
    """The axes of the two conditions turned by any angle from the line of nodes."""
    along, across = SLIPS
    gone = f"(phi - ({turned}))"
    return DISK.format(
        turned=turned,
        along=f"{along}*cos{gone} - {across}*sin{gone}",
        across=f"{along}*sin{gone} + {across}*cos{gone}",
    )


@pytest.mark.long
@pytest.mark.parametrize("turned", ["phi", "0", "phi/2"])
def test_a_disk_rolls_upright_however_its_constraints_are_written(turned):
    """Neimark and Fufaev, chapter VI: stable for C (C + m R^2) psi'^2 > A m g R, rolling
    straight on, and for (A + m R^2) phi'^2 > m g R, spinning on the spot.
    """
    found = section(f"title: t\n{disk(turned)}", "steady_motions")
    assert found.complete
    m, R, A, C, g, w = 1.3, 0.7, 0.2, 0.5, 9.8, 1.7
    given = {
        "cot": mpmath.cot,
        "m": m,
        "R": R,
        "A": A,
        "C": C,
        "g": g,
        "psi_d": w,
        "phi_d": w,
        "theta": math.pi / 2,
    }
    squares = {
        round(float(number(square, **given)), 9)
        for motion in found.motions
        for square in motion.frequencies_squared
    }
    straight = (C * (m * R**2 + C) * w**2 - m * g * R * A) / (A * (m * R**2 + A))
    spinning = w**2 - m * g * R / (m * R**2 + A)
    assert {round(straight, 9), round(spinning, 9)} <= squares


# -- the edge of what coordinates describe -------------------------------------------------------

RISES = ("a*x^2", "a*x^4 + x^2/3", "a*(1 - cos(x))", "a*x^2/(1 + x^2)")


@pytest.mark.parametrize("track", RISES)
def test_a_bob_that_hangs_from_a_support_without_mass_is_not_said_never_to_rest(track):
    """Goldstein, Poole and Safko, 3rd ed., derivation 19 of chapter 8: there M is singular."""
    found = section(
        "title: t\ncoordinates: [x, theta]\nparameters: {m: {assume: positive}, g: {assume: positive},"
        " l: {assume: positive}, a: {assume: positive}}\n"
        f"points: {{bob: {{position: [x + l*sin(theta), {track} - l*cos(theta)], mass: m}}}}\n"
        f"V: m*g*({track} - l*cos(theta))\n",
        "equilibria",
    )
    assert found.equilibria is None or not found.complete
    assert found.equilibria or "edge" in found.reason


@pytest.mark.parametrize(("V", "complete"), [("m*g*a*cos(u)", True), ("-m*g*a*cos(u)", False)])
def test_at_the_cusp_of_a_cycloid_only_a_force_into_it_is_undecided(V, complete):
    found = section(
        "title: t\ncoordinates: [u]\nparameters: {m: {assume: positive}, g: {assume: positive}, "
        f"a: {{assume: positive}}}}\nT: m*a^2*(1 - cos(u))*u'^2\nV: {V}\n",
        "equilibria",
    )
    assert [to_grammar(each.at["u"]) for each in found.equilibria] == ["pi"]
    assert found.complete is complete


# -- turning points ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("coordinate", "T", "V", "period"),
    [
        ("y", "m*y'^2/2", "m*a*y", False),  # a body thrown up
        ("y: {assume: positive}", "m*y'^2/2", "m*a/y", False),  # repelled
        ("y", "m*y'^2/2", "m*a*y^2", True),
        ("y", "m*y'^2/2", "-m*a*cos(y)", True),
    ],
)
def test_a_motion_that_turns_back_once_has_no_period(coordinate, T, V, period):
    """Landau and Lifshitz, 3rd ed., section 11: two turning points bound a finite motion."""
    attributes = coordinate if ":" in coordinate else f"{coordinate}: "
    text = (
        f"title: t\ncoordinates: {{{attributes}}}\nparameters: {{m: {{assume: positive}}, "
        f"a: {{assume: positive}}}}\nT: {T}\nV: {V}\n"
    )
    answers = state(derive(text), Request(sections=("reduction",)))
    shown = blocks(answers.sections["reduction"], answers)
    rows = [row.left for block in shown if isinstance(block, Equations) for row in block.rows]
    assert any(isinstance(left, Label) and left.letter == "T" for left in rows) is period


# -- distances -----------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(4))
def test_the_distance_of_two_planets_is_solved_for(seed):
    """k/x^2 = (y cos - x)/r^3: a solution of it is one of a branch."""
    draw = random.Random(seed)
    x, y, f, k = sympy.symbols("x y f k", real=True)
    square = x**2 + y**2 - 2 * x * y * sympy.cos(f)
    equation = -k / x**2 + (y * sympy.cos(f) - x) / square ** sympy.Rational(3, 2)
    state = {x: draw.uniform(0.5, 1), y: draw.uniform(1.5, 3), f: draw.uniform(-0.5, 0.5)}
    state[k] = sympy.solve(equation.xreplace(state), k)[0]
    branches = by_distances([equation], [x, y, f])
    assert any(
        all(abs(e.evalf(30, subs=state)) < 1e-9 for e in branch.equations)
        and all(p.evalf(30, subs=state) > 0 for p in branch.positive)
        for branch in branches
    )
