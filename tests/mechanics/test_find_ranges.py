"""For which values something lasts or is reached: textbooks, and runs on both sides of a bound."""

from __future__ import annotations

from pathlib import Path

import pytest

from lagcli.formatters.grammar import to_grammar
from lagcli.statements.questions import Ranges
from tests.numerics.running import column, simulated

from .formulas import formula, normal
from .questions import answers

LIBRARY = Path(__file__).parents[2] / "problems"


def found(text: str, name: str = "asked") -> list[list[tuple[str, object]]] | None:
    answer = answers(text)[name]
    assert isinstance(answer, Ranges)
    if answer.ranges is None:
        return None
    return [[(how, normal(bound)) for how, bound in each.bounds] for each in answer.ranges]


def why(text: str, name: str = "asked") -> str:
    return answers(text)[name].note


def bounds(*ranges: list[str]) -> list[list[tuple[str, object]]]:
    """`<= a` as a pair of the comparison and the normal form of a."""
    return [[(b.split(" ")[0], formula(b.split(" ", 1)[1])) for b in each] for each in ranges]


LOOP = """
coordinates: {r: POSITIVE, theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, v0: ASSUMED}
T: m*(r'^2 + r^2*theta'^2)/2
V: -m*g*r*cos(theta)
constraints: {track: {equation: R = r, multiplier: N, holds_while: N >= 0}}
initial: {r: R, theta: 0, theta': v0/R}
find: {asked: QUESTION}
"""
ALWAYS = "{always: N >= 0, for: v0}"
LOW, HIGH = "sqrt(2*g*R)", "sqrt(5*g*R)"


def loop(question: str = ALWAYS, assumed: str = "POSITIVE") -> str:
    return LOOP.replace("QUESTION", question).replace("ASSUMED", assumed)


def test_a_loop_is_kept_by_slow_and_by_fast_cars():
    assert found(loop()) == bounds([f"<= {LOW}"], [f">= {HIGH}"])


def test_a_strict_condition_leaves_out_what_only_touches():
    assert found(loop("{always: N > 0, for: v0}")) == bounds([f"< {LOW}"], [f"> {HIGH}"])


def test_a_speed_of_either_sign_has_both_signs_in_the_answer():
    assert found(loop(assumed="{}")) == bounds(
        [f"<= -{HIGH}"], [f">= -{LOW}", f"<= {LOW}"], [f">= {HIGH}"]
    )


def test_the_top_is_reached_only_with_contact():
    assert found(loop("{reaches: theta = pi, for: v0}")) == bounds([f">= {HIGH}"])
    assert "whole turns" in why(loop("{reaches: theta = pi, for: v0}"))


def test_the_loop_in_cartesian_coordinates_is_the_same():
    text = """
coordinates: {x: {}, y: {}}
parameters: {m: POSITIVE, g: POSITIVE, R: POSITIVE, v0: POSITIVE}
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {track: {equation: R^2 = x^2 + y^2, multiplier: N, holds_while: N >= 0}}
initial: {x: 0, y: -R, x': v0, y': 0}
find: {asked: {always: N >= 0, for: v0}}
"""
    assert found(text) == bounds([f"<= {LOW}"], [f">= {HIGH}"])


def test_any_parameter_may_be_asked_for():
    """m drops out, so any mass would do where one would."""
    assert found(loop("{always: N >= 0, for: R}")) == bounds(["<= v0^2/(5*g)"], [">= v0^2/(2*g)"])
    assert why(loop("{always: N >= 0, for: m}")).startswith("which values of m these are depends")


PENDULUM = """
coordinates: {theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, w: POSITIVE}
T: m*l^2*theta'^2/2
V: -m*g*l*cos(theta)
initial: {theta: 0, theta': w}
find:
  top: {reaches: theta = pi, for: w}
  side: {reaches: theta = pi/2, for: w}
  moves: {always: theta'^2 > 0, for: w}
"""


def test_a_separatrix_takes_an_infinite_time():
    """Landau and Lifshitz, section 11: at w^2 = 4 g/l the top is not reached, nor is rest."""
    assert found(PENDULUM, "top") == bounds(["> 2*sqrt(g/l)"])
    assert found(PENDULUM, "side") == bounds([">= sqrt(2*g/l)"])
    assert found(PENDULUM, "moves") == bounds([">= 2*sqrt(g/l)"])


THROW = """
coordinates: {y: {}}
parameters: {m: POSITIVE, g: POSITIVE, h: POSITIVE, v: {}}
T: m*y'^2/2
V: m*g*y
initial: {y: 0, y': v}
find:
  up: {reaches: y = h, for: v}
  down: {reaches: y = -h, for: v}
  below: {always: y <= h, for: v}
"""


def test_a_stone_thrown_up_comes_to_a_height_and_a_stone_always_falls():
    assert found(THROW, "up") == bounds([">= sqrt(2*g*h)"])
    assert found(THROW, "down") == [[]]
    assert found(THROW, "below") == bounds(["<= sqrt(2*g*h)"])


def test_a_ball_that_rolls_needs_an_order_of_its_special_values():
    """(5 + k)/(1 + k) > 2/(1 + k) for every k > 0, so both ranges stand for all inertias."""
    text = (LIBRARY / "contact/ball-rolling-in-loop.yaml").read_text()
    assert found(text, "kept") == bounds(
        ["<= sqrt(2*g*d/(1 + k))"], [">= sqrt((5 + k)*g*d/(1 + k))"]
    )


CONE = """
coordinates: {theta: {}}
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, a: POSITIVE, w: POSITIVE}
T: m*l^2*theta'^2/2
V: 0
constraints: {turned: theta = w*t}
find: {asked: {always: m*g*sin(a) >= m*l*theta'^2*sin(a)*cos(a), for: w}}
"""


def test_what_depends_on_another_parameter_is_refused_and_decided_by_its_value():
    """A cone of more than a right angle never lets go."""
    assert found(CONE) is None
    assert "depends on" in why(CONE)
    assert "--set" in why(CONE)
    assert found(CONE.replace("cos(a)", "cos(pi/3)").replace("sin(a)", "1")) == bounds(
        ["<= sqrt(2*g/l)"]
    )


@pytest.mark.long
def test_the_values_of_the_file_decide_where_symbols_do_not():
    text = """
coordinates: {x: {}, y: {}}
parameters:
  m: {assume: positive, value: 1}
  g: {assume: positive, value: 10}
  h: {assume: positive, value: 1/10}
  k: {assume: positive, value: 1}
  v: POSITIVE
T: m*(x'^2 + y'^2)/2
V: m*g*y
constraints: {road: {equation: ROAD, multiplier: N, holds_while: N >= 0}}
initial: {x: 0, y: h, x': v}
find: {asked: {always: N >= 0, for: v}}
"""
    bell = text.replace("ROAD", "y = h/(1 + k^2*x^2)")
    assert found(bell) == bounds(["<= 5*sqrt(2)"])  # y'' = -2 h k^2 at the top
    assert why(bell) == "for the values of the file"
    # g + y'' x'^2 is g (1 - c)(1 + h^2 k^2 (1 - c)) at v^2 = g/(h k^2), c = cos(k x): never below 0
    wave = text.replace("ROAD", "y = h*cos(k*x)")
    assert found(wave) == bounds(["<= sqrt(g)/(k*sqrt(h))"])


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (PENDULUM.replace("initial: {theta: 0, theta': w}", ""), "`initial`"),
        (PENDULUM.replace("cos(theta)", "exp(theta)").replace("pi/2", "1/2"), "no rational function"),
        (PENDULUM.replace("w: POSITIVE", "w: {assume: positive, integer: true}"), "an integer"),
        (PENDULUM.replace("cos(theta)", "cos(theta/2)"), "is no angle"),
    ],
)  # fmt: skip
def test_what_cannot_be_decided_is_told(text: str, reason: str):
    assert found(text, "side") is None
    assert reason in why(text, "side")


def test_a_coordinate_that_is_never_negative_ends_the_motion_there():
    text = THROW.replace("y: {}", "y: {assume: nonnegative}").replace("y: 0", "y: h")
    assert found(text.replace("y = h", "y = 2*h"), "up") == bounds([">= sqrt(2*g*h)"])
    assert found(text, "down") == []


def test_no_value_and_every_value():
    ball = loop().replace("-m*g*r*cos", "m*g*r*cos").replace("R = r", "r = R")
    assert found(ball) == []
    assert found(ball.replace("N >= 0, for", "N <= 1000*m*g + m*v0^2/R, for")) == [[]]


# -- runs of the motion itself on both sides of each bound -------------------------------------

SIDES = [
    ("car-in-loop", "v0", ["v0 = 4.40", "v0 = 7.02"], ["v0 = 4.46", "v0 = 6.98"]),
    ("ball-rolling-in-loop", "v0", ["v0 = 3.72", "v0 = 6.17"], ["v0 = 3.78", "v0 = 6.13"]),
    ("car-over-hump", "v0", ["v0 = 15.6"], ["v0 = 15.7"]),
    ("conical-pendulum-on-cone", "w", ["w = 3.72"], ["w = 3.73"]),
    ("stone-on-string-released", "theta0", ["theta0 = 1.56"], ["theta0 = 1.59"]),
    ("block-on-shaking-table-kept", "w", ["w = 9.89"], ["w = 9.92"]),
]


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "unknown", "kept", "lost"), SIDES, ids=[side[0] for side in SIDES]
)
def test_a_run_keeps_the_contact_inside_and_loses_it_outside(
    name: str, unknown: str, kept: list[str], lost: list[str]
):
    text = (LIBRARY / "contact" / f"{name}.yaml").read_text()
    parameters = text.split("\nfind:")[0]
    [answer] = [
        a for a in answers(text).values() if isinstance(a, Ranges) and a.unknown == unknown
    ][:1]
    numbers = {p.split(":")[0].strip(): p for p in parameters.splitlines() if "value:" in p}
    values = {
        each: eval(line.split("value:")[1].split("}")[0].split(",")[0])
        for each, line in numbers.items()
    }
    plain = parameters + "\n"
    for setting, expected in [*((s, True) for s in kept), *((s, False) for s in lost)]:
        number = float(setting.split("=")[1])
        inside = any(
            all(_holds(number, how, to_grammar(bound), values) for how, bound in each.bounds)
            for each in answer.ranges or ()
        )
        run = simulated(plain, 6.0, settings=(setting,), samples=3)
        leaves = [event for event in run.events if event.what == "contact lost"]
        assert inside is expected
        assert (not leaves) is expected


def _holds(number: float, how: str, bound: str, values: dict[str, float]) -> bool:
    from math import pi, sqrt

    value = eval(bound.replace("^", "**"), {"sqrt": sqrt, "pi": pi, **values})
    return number <= value if how in ("<=", "<") else number >= value


def test_a_run_comes_to_the_top_only_above_the_bound():
    text = (LIBRARY / "pendulums/pendulum-over-the-top.yaml").read_text().split("\nfind:")[0] + "\n"
    for setting, over in (("w0 = 6.26", False), ("w0 = 6.27", True)):  # 2 sqrt(9.81) = 6.264
        run = simulated(text, 8.0, settings=(setting,), samples=161, show="theta")
        assert (max(column(run, "theta")) > 3.2) is over


@pytest.mark.parametrize("asked", ["k", "m"])
@pytest.mark.parametrize("place", ["2", "a", "1 + a"])
def test_a_parameter_on_which_the_motion_does_not_depend_decides_nothing(asked: str, place: str):
    """Thrown up, a height h > 0 is reached where v0^2 >= 2 g h, whatever m and k."""
    text = f"""
coordinates: [x]
parameters: {{m: POSITIVE, k: POSITIVE, g: POSITIVE, a: POSITIVE, v0: POSITIVE}}
T: m*x'^2/2
V: m*g*x
initial: {{x: 0, x': v0}}
find:
  asked: {{reaches: x = {place}, for: {asked}}}
  speed: {{reaches: x = {place}, for: v0}}
"""
    answer = answers(text)["asked"]
    assert isinstance(answer, Ranges)
    assert answer.ranges is None
    if place != "1 + a":
        assert found(text, "speed") == bounds([f">= sqrt(2*g*{place})"])


@pytest.mark.parametrize(
    ("height", "squared"), [("2", "g*R"), ("3", "4*g*R/3"), ("3/2", "2*g*R/3")]
)
def test_what_is_thrown_up_and_falls_into_the_centre_reaches_no_more(height, squared):
    """v² = 2 g R² (1/R - 1/r); a slower body falls back, where r' is infinite at r = 0."""
    text = f"""
coordinates: {{r: POSITIVE}}
parameters: {{m: POSITIVE, g: POSITIVE, R: POSITIVE, v0: POSITIVE}}
T: m*r'^2/2
V: -m*g*R^2/r
initial: {{r: R, r': v0}}
find: {{asked: {{reaches: r = {height}*R, for: v0}}}}
"""
    assert found(text) == bounds([f">= sqrt({squared})"])


@pytest.mark.parametrize("length", ["l - d", "l - 2*d"])
def test_a_length_that_may_be_negative_is_undecided(length):
    """A pendulum caught by a peg: for d > l there is no circle."""
    text = LOOP.replace("R: POSITIVE, v0: ASSUMED", "l: POSITIVE, d: POSITIVE").replace(
        "R = r", f"{length} = r"
    )
    text = text.replace(
        "r: R, theta: 0, theta': v0/R", f"r: {length}, theta: 0, theta': sqrt(2*g*l)/({length})"
    )
    assert "could not be followed" in why(text.replace("QUESTION", "{reaches: theta = pi, for: d}"))


@pytest.mark.parametrize(
    ("asked", "holds"), [("N >= 0", True), ("N > 0", True), ("N < 0", False), ("N <= -m*g", False)]
)
def test_what_all_states_share_needs_no_motion(asked, holds):
    """A bead in a bowl z = r²/(2 a) that turns: N = m a (r'² + w² r² + a g)/(r² + a²) > 0."""
    text = f"""
coordinates: {{r: {{}}, z: {{}}}}
parameters: {{m: POSITIVE, g: POSITIVE, w: POSITIVE, a: POSITIVE, v: POSITIVE}}
T: m*(r'^2 + r^2*w^2 + z'^2)/2
V: m*g*z
constraints: {{bowl: {{equation: z = r^2/(2*a), multiplier: N}}}}
initial: {{r: 0, r': v}}
find: {{asked: {{always: "{asked}", for: w}}}}
"""
    assert found(text) == ([[]] if holds else [])
