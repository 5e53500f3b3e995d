"""Equilibria with one-sided contacts and dry friction, against what the books say and by hand."""

from __future__ import annotations

import random

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.statements.stability import holding

from .derived import derive
from .formulas import formula, normal
from .test_sentences import said


def found(text: str):
    states = equilibria(derive(text.replace("POSITIVE", "{assume: positive}")).dynamics).equilibria
    assert states is not None
    return states


def places(text: str, name: str) -> list[str]:
    return [to_grammar(each.at[name]) if name in each.at else "free" for each in found(text)]


def conditions(each) -> set[str]:
    return {f"{to_grammar(a.left)} > {to_grammar(a.right)}" for a in each.where}


SPHERE = """
coordinates: {r: POSITIVE, theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE}
T: m*(r'^2 + r^2*theta'^2)/2
V: m*g*r*cos(theta)
constraints:
  surface: {equation: r = R, multiplier: N, holds_while: N SIGN 0}
"""


@pytest.mark.parametrize(("sign", "place", "stable"), [(">=", "0", False), ("<=", "pi", True)])
def test_a_surface_does_not_pull(sign, place, stable):
    """On top of a sphere, and at the bottom of a bowl; the other place needs a pull."""
    text = SPHERE.replace("SIGN", sign)
    assert places(text, "theta") == [place]
    assert [each.verdict.stable for each in found(text)] == [stable]
    section, _ = steady_motions(derive(text.replace("POSITIVE", "{assume: positive}")))
    assert [to_grammar(m.at["theta"]) for m in section.motions or ()] == [place]


@pytest.mark.parametrize("seed", range(4))
def test_conditions_that_a_parameter_makes_void(seed):
    """F = k times something, in all coordinates: at k = 0 no force acts."""
    source = random.Random(f"void {seed}")
    p, q, r = source.randint(1, 3), source.randint(1, 2), source.randint(3, 5)
    a = source.choice([f"(x - {p}*c)^2 + {q}*x*y", f"{q}*cos(x) - {p}*c^2", f"{p}*(x^2 - c^2)^2"])
    b = f"{r}*(y - c)^2"
    file = "coordinates: [x, y]\nparameters: {{k: , c: , g: POSITIVE}}\nT: (x'^2 + y'^2)/2\nV: {}"
    states = {
        of: equilibria(derive(file.format(V).replace("POSITIVE", "{assume: positive}")).dynamics)
        for of, V in {"all": f"k*({a}) + k*({b})", "not all": f"k*({a}) + k*({b}) + g*x^2"}.items()
    }
    assert [*map(to_grammar, states["all"].void)] == ["k"]
    assert states["not all"].void == ()


@pytest.mark.parametrize(
    ("shape", "degenerate"),
    [
        ("(k - c)*x^2/2 + g*y^2", "k - c"),
        ("k*x^2 - k*cos(y) + c*(y - 1)^4*x^2", None),
        ("k*c*x^4 + g*cosh(y)", "k*c"),
        ("k*x^2*y^2 + g*(x^2 + y^2)", None),
        ("k*(x - g)^2 + c*(y - g)^2", "k*c"),
    ],
)
def test_a_condition_that_a_parameter_makes_void(shape, degenerate):
    """Where one of several holds everywhere, more than the listed positions may be at rest."""
    text = (
        "coordinates: [x, y]\nparameters: {k: , c: , g: {assume: positive}}\n"
        f"T: (x'^2 + y'^2)/2\nV: {shape}\n"
    )
    states = equilibria(derive(text).dynamics)
    found = {normal(e) for e in states.degenerate}
    assert found == {formula(e) for e in (degenerate or "").split(";") if e}
    told = said(text, "Equilibria", "equilibria")
    assert ("there may be more than are listed" in told) is (degenerate is not None)


@pytest.mark.parametrize(("force", "void"), [("0", ["W"]), ("k*x*W", ["W"]), ("k*x", [])])
def test_a_drive_that_a_parameter_switches_off(force, void):
    """A body on a turning table: at W = 0 the table rests and, without a force, everything on it."""
    text = f"""
coordinates: [x, y, u, v]
parameters: [m, k, W]
T: m*(x'^2 + y'^2 + u'^2 + v'^2)/2
forces: {{x: "{force}"}}
constraints: {{a: x' - u' = -W*y, b: y' - v' = W*x}}
"""
    states = equilibria(derive(text).dynamics)
    assert [*map(to_grammar, states.void)] == void


@pytest.mark.parametrize(("kind", "told"), [("tension", "Taut"), ("normal", "In contact")])
def test_a_string_hangs_down(kind, told):
    text = f"""
coordinates: [x, y]
parameters: {{m: POSITIVE, g: POSITIVE, l: POSITIVE}}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints:
  string:
    equation: x^2 + y^2 = l^2
    multiplier: S
    holds_while: S <= 0
    on_loss: release
    acts_as: {kind}
"""
    assert places(text, "y") == ["-l"]
    [rest] = found(text)
    assert rest.touching == ("string",)
    assert holding(rest) == f"{told}: string. "


def test_a_ball_rests_on_the_floor_of_its_contact():
    ball = """
coordinates: [x, y]
parameters: {m: POSITIVE, g: POSITIVE, k: POSITIVE, e: {assume: nonnegative}}
T: m*(x'^2 + y'^2)/2
V: m*g*y + k*x^2/2
contacts:
  floor: {gap: y >= 0, restitution: e}
"""
    [rest] = found(ball)
    assert {name: to_grammar(v) for name, v in rest.at.items()} == {"x": "0", "y": "0"}
    assert rest.touching == ("floor",)
    assert rest.verdict.stable is True
    assert rest.verdict.asymptotic is False
    assert found(ball.replace("m*g*y", "-m*g*y")) == ()


@pytest.mark.parametrize("seed", range(6))
def test_a_spring_beside_a_wall(seed):
    """x rests at c where that is not in the wall, else at the wall, pressed with k |c - w|."""
    source = random.Random(seed)
    wall, k = source.randint(-4, 4), source.randint(1, 5)
    centre = wall + source.choice([-3, -2, -1, 1, 2, 3])
    text = f"""
coordinates: [x]
T: x'^2/2
V: {k}*(x - {centre})^2/2
contacts:
  wall: {{gap: x >= {wall}, restitution: 1/2}}
""".replace("- -", "+ ")
    [rest] = found(text)
    assert to_grammar(rest.at["x"]) == str(max(centre, wall))
    assert rest.touching == (("wall",) if centre < wall else ())
    assert rest.verdict.stable is True


def test_dry_friction_holds_a_block_on_an_incline():
    """Where mu > tan(alpha) every place is one of rest."""
    [rest] = found("""
coordinates: [x]
parameters: {m: POSITIVE, g: POSITIVE, alpha: POSITIVE, mu: POSITIVE}
T: m*x'^2/2
V: m*g*x*sin(alpha)
forces: {x: -mu*m*g*cos(alpha)*sign(x')}
""")
    assert rest.free == ("x",)
    assert rest.sticking
    assert "mu*cos(alpha) > sin(alpha)" in conditions(rest)
    assert rest.verdict.stable is True


def test_dry_friction_holds_a_spring_within_its_bounds():
    [rest] = found("""
coordinates: [x]
parameters: {m: POSITIVE, g: POSITIVE, k: POSITIVE, mu: POSITIVE}
T: m*x'^2/2
V: k*x^2/2
forces: {x: -mu*m*g*sign(x')}
""")
    assert rest.free == ("x",)
    assert len(rest.where) == 2


@pytest.mark.parametrize(
    "drag",
    [
        "dissipation: c*abs(x')^3/3",
        "forces: {x: -c*x'^2*sign(x')}",
        "forces: {x: -c*x'*abs(x')}",
    ],
)
def test_quadratic_drag_holds_nothing_at_rest(drag):
    """Its force is 0 at rest, however it is written: rest is where the spring is not stretched."""
    [rest] = found(
        "coordinates: [x]\nparameters: {m: POSITIVE, k: POSITIVE, c: POSITIVE}\n"
        f"T: m*x'^2/2\nV: k*x^2/2\n{drag}\n"
    )
    assert (to_grammar(rest.at["x"]), rest.sticking, rest.where) == ("0", False, ())
    assert rest.verdict.stable is True


def test_friction_beside_quadratic_drag_holds_as_it_does_without():
    [rest] = found(
        "coordinates: [x]\nparameters: {k: POSITIVE, c: POSITIVE, f: POSITIVE}\n"
        "T: x'^2/2\nV: k*x^2/2\nforces: {x: -(f + c*x'^2)*sign(x')}\n"
    )
    assert rest.sticking
    for x in (-2.0, -0.5, 0.0, 0.9, 3.0):
        at = {"x": x, "k": 2.0, "f": 1.5}
        inside = all(number(each.left, at) > number(each.right, at) for each in rest.where)
        assert inside == (2.0 * abs(x) < 1.5)


@pytest.mark.parametrize("seed", range(6))
def test_friction_in_one_of_two_coordinates(seed):
    """One block sticks, the other hangs on a spring between: it rests where its spring balances."""
    source = random.Random(seed)
    k, K, f, F = (source.randint(1, 6) for _ in range(4))
    [rest] = found(f"""
coordinates: [x, y]
T: x'^2/2 + y'^2/2
V: {k}*x^2/2 + {K}*(y - x)^2/2 - {F}*y
forces: {{x: -{f}*sign(x')}}
""")
    # K (y - x) = F, and |F - k x| <= f
    for x in (-3.0, -1.0, 0.0, 0.7, 1.5, 4.0):
        at = {"x": x, "y": x + F / K}
        inside = all(number(each.left, at) > number(each.right, at) for each in rest.where)
        assert inside == (abs(F - k * x) < f)
    assert rest.verdict.stable is True


def number(tree, at: dict[str, float]) -> float:
    value = normal(tree)
    assert value is not None
    return float(value.subs({s: at[s.name] for s in value.free_symbols}))


@pytest.mark.parametrize("stiffness", ["-w^2*sin(b)^2", "a - b", "a^2 - b", "-(a - b)^2"])
def test_a_place_exists_where_what_it_is_divided_by_is_not_0(stiffness):
    """Of V = K q²/2 - F q, K = 0 has no equilibrium, so no stability to speak of, either."""
    text = f"""
coordinates: [q]
parameters: {{m: {{assume: positive}}, w: {{assume: positive}}, a: , b: , F: }}
T: m*q'^2/2
V: ({stiffness})*q^2/2 - F*q
"""
    [place] = found(text)
    assert len(place.where) == 1
    known = stiffness.startswith("-")
    assert place.verdict.stable is (False if known else None)
    assert bool(place.verdict.minimum) is not known


@pytest.mark.parametrize(("pull", "number"), [("F", 1), ("2*F", 1), ("F", 3)])
def test_a_place_whose_conditions_contradict_each_other_is_none(pull, number):
    """A spring under tension on a line (Landau, section 21): k l > F and F > 2 k l never hold."""
    text = f"""
coordinates: [x]
parameters: {{m: POSITIVE, k: POSITIVE, l: POSITIVE, F: POSITIVE}}
T: m*x'^2/2
V: {number}*k*(sqrt(l^2 + x^2) - l + {pull}/k)^2/2
"""
    assert places(text, "x") == ["0"]
    assert found(text)[0].verdict.stable


@pytest.mark.parametrize("seed", range(4))
def test_no_rest_is_stated_where_the_potential_jumps(seed):
    """V = k u² - c sign(u): beside u = 0 it is lower on one side, though V' = 0 is there."""
    source = random.Random(seed)
    u, c = source.choice(["x", "x - 1", "2*x + 3"]), source.choice([-2, 1, 3])
    text = "coordinates: [x]\nparameters: {k: {assume: positive}}\nL: x'^2/2 - k*U^2 + STEP\n"
    text = text.replace("U", f"({u})")
    jumping = derive(text.replace("STEP", f"{c}*sign({u})"))
    assert equilibria(jumping.dynamics).equilibria is None
    bent = derive(text.replace("STEP", f"{c}*({u})^3*sign({u})"))
    assert next(iter(equilibria(bent.dynamics).equilibria)).verdict.stable is True
    apart = derive(text.replace("STEP", f"{c}*sign(x - 9)"))
    assert [e.verdict.stable for e in equilibria(apart.dynamics).equilibria] == [True]
