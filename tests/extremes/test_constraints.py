"""Constraints that are redundant, become dependent, or are lost."""

import json
import math
from random import Random

import mpmath
import pytest
from mpmath import mp, mpf

TWICE = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
V: y
constraints: {rod: x^2 + y^2 = 1, again: %s}
initial: {x: sqrt(3)/2, y: -1/2}
"""


@pytest.mark.parametrize("again", ["x^2 + y^2 = 1", "2*x^2 + 2*y^2 = 2"])
def test_a_constraint_twice(simulate, again):
    """The plane pendulum; neither multiplier is told, for they are not determined."""
    until = mpmath.nstr(4 * mpmath.ellipk(mpf(1) / 4), 17)
    run = simulate(TWICE % again, until, show="atan2(x, -y),lambda_rod")
    assert run.status == 0
    assert run.last["atan2(x, -y)"] == pytest.approx(float(mp.pi / 3), abs=1e-9)
    assert run.last["lambda_rod"] is None
    assert "lambda_rod is not determined: redundant constraints" in run.warnings


LINKAGE = """
coordinates: [x, y, u, v]
T: (x'^2 + y'^2 + u'^2 + v'^2)/2
constraints:
  crank: x^2 + y^2 = 1
  rocker: (u - 2)^2 + v^2 = 1
  coupler: (u - x)^2 + (v - y)^2 = 4
initial:
  {x: cos(1), y: sin(1), u: 2 + cos(1), v: sin(1), x': -sin(1), y': cos(1), u': -sin(1), v': cos(1)}
"""


@pytest.mark.parametrize("accuracy", [1e-6, 1e-9])
def test_a_four_bar_linkage_through_its_flat_positions(simulate, accuracy):
    """The parallelogram turns evenly; flat at t = pi - 1 and 2 pi - 1, it could fold there."""
    run = simulate(LINKAGE, 8, accuracy=accuracy, samples=9)
    assert run.status == 0
    assert run.held["holds_until"] == 8
    assert len(run.rows) == 9
    for row in run.rows:
        assert row["x"] == pytest.approx(float(mp.cos(1 + row["t"])), abs=accuracy)
        assert row["u"] == pytest.approx(float(2 + mp.cos(1 + row["t"])), abs=accuracy)


@pytest.mark.long
def test_a_coupler_too_long_by_1e_15_turns_the_motion_at_the_flat_position(simulate):
    """It is never flat: the cranks go on as those of an antiparallelogram.

    Of sides 1 and 2, tan(b/2) = -3 tan(a/2) for the angles of its cranks.
    """
    text = LINKAGE.replace("(v - y)^2 = 4", "(v - y)^2 = (2 + 1e-15)^2")
    text = text.replace("u: 2 + cos(1)", "u: 2 + cos(1) + 1e-15")
    run = simulate(text, 2.5, accuracy=1e-6, samples=2, show="x,y,u,v,energy")
    assert run.status == 0
    x, y, u, v = (run.last[name] for name in "xyuv")
    assert v / (u - 1) == pytest.approx(-3 * y / (1 + x), rel=1e-6)
    assert run.last["energy"] == pytest.approx(1, abs=1e-9)


SLIDER_CRANK = """
coordinates: [a, b, x]
definitions: {u: cos(a) + cos(b)/2, v: sin(a) - sin(b)/2}
T: a'^2/2 + b'^2/24 + (u'^2 + v'^2)/2 + x'^2/2
constraints: {stroke: cos(a) + cos(b) = x, height: sin(a) = sin(b)}
initial: {a: 0.9, b: 0.9, a': %s, b': %s, x: 2*cos(0.9), x': -2*%s*sin(0.9)}
"""


@pytest.mark.long
@pytest.mark.parametrize(
    ("rate", "options"), [("1", ["--precision", "30"]), ("1", []), ("1e-3", [])]
)
def test_a_slider_crank_with_equal_arms_stays_on_its_branch(simulate, rate, options):
    """Flat at a = b = pi/2 it could leave its slider in the middle.

    With a = b one freedom is left, of constant T = I a'^2/2, where I = 13/12 + (9 sin(a)^2 +
    cos(a)^2)/4 + 4 sin(a)^2.
    """
    until = 4 / float(rate)
    run = simulate(SLIDER_CRANK.replace("%s", rate), until, *options, samples=9)
    assert run.status == 0
    rows = run.rows

    def inertia(a):
        return 13 / 12 + (9 * mp.sin(a) ** 2 + mp.cos(a) ** 2) / 4 + 4 * mp.sin(a) ** 2

    first = mp.sqrt(inertia(mpf("0.9"))) * mpf(rate)
    time = mpmath.quad(lambda a: mp.sqrt(inertia(a)), [mpf("0.9"), 2, 4, rows[-1]["a"]]) / first
    assert float(time) == pytest.approx(until, rel=1e-8)
    for row in rows:
        assert row["b"] == pytest.approx(row["a"], abs=1e-8)
        assert row["x"] == pytest.approx(2 * math.cos(row["a"]), abs=1e-8)


CRANK = """
coordinates: [a, b, x]
T: {J}*a'^2/2 + {K}*b'^2/2 + {m}*x'^2/2
V: {g}*(sin(a) + sin(b)/2)
constraints: {{c1: x = {r}*cos(a) + {r}*cos(b), c2: "{r}*sin(a) = {r}*sin(b)"}}
initial: {{a: {a}, b: {a}, x: 2*{r}*cos({a}), a': {w}, b': {w}, x': -2*{r}*sin({a})*{w}}}
"""
RHOMBUS = """
coordinates: [a, b]
T: {J}*a'^2/2 + {K}*b'^2/2
V: {g}*sin(a)
constraints: {{bar: "(1 + cos(b) - cos(a))^2 + (sin(b) - sin(a))^2 = 1"}}
initial: {{a: {a}, b: {a}, a': {w}, b': {w}}}
"""


@pytest.mark.long
@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("text", [CRANK, RHOMBUS])
def test_rows_are_on_the_branch_along_which_the_velocity_is_continuous(simulate, text, seed):
    """Equal angles stay equal through every flat position, however few rows are asked for."""
    random = Random(seed)
    given = {name: round(random.uniform(0.3, 2), 3) for name in "JKmgrw"}
    given |= {"a": round(random.uniform(-1.4, 1.4), 3), "g": round(random.uniform(0, 0.3), 3)}
    accuracy, until = random.choice((1e-3, 1e-6, 1e-9)), 8 / given["w"]
    run = simulate(text.format(**given), until, accuracy=accuracy, samples=random.choice((2, 5)))
    for row in run.rows:
        assert row["a"] == pytest.approx(row["b"], abs=10 * accuracy)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_where_branches_touch_the_rows_end(simulate, seed):
    """Of two parabolas through 0 with one tangent neither is distinguished there."""
    k = round(Random(seed).uniform(0.5, 2), 3)
    text = f"""
coordinates: [x, y]
T: x'^2/2 + y'^2/2
constraints: {{c: "(y - {k}*x^2)*(y + x^2) = 0"}}
initial: {{x: -1, y: {k}, x': 1, y': {-2 * k}}}
"""
    run = simulate(text, 6, accuracy=1e-6, samples=61)
    assert run.status == 1
    assert run.held["holds_until"] < 1
    assert run.last["x"] < 1e-6


@pytest.mark.long
def test_a_double_parallelogram_moves_in_spite_of_gruebler(lagcli, simulate):
    """Three equal cranks on one coupler: by count it is rigid, yet it is a pendulum."""
    text = """
coordinates: [a, x, y, u, v]
T: (x'^2 + y'^2)/2 + (u'^2 + v'^2)/2 + a'^2/2
V: y + v - cos(a)
constraints:
  first_x: x = 1 + sin(a)
  first_y: y = -cos(a)
  second_x: u = 2 + sin(a)
  second_y: v = -cos(a)
  coupler: (u - x)^2 + (v - y)^2 = 1
initial: {a: 1, x: 1 + sin(1), y: -cos(1), u: 2 + sin(1), v: -cos(1)}
"""
    until = mpmath.nstr(4 * mpmath.ellipk(mp.sin(0.5) ** 2), 17)
    run = simulate(text, until)
    assert run.status == 0
    assert run.last["a"] == pytest.approx(1, abs=1e-9)
    solved = lagcli("solve", text, "--show", "equations")
    assert "1 degree of freedom" in solved.out


SPHERE = """
coordinates: {r: {assume: positive}, th: {assume: nonnegative}}
L: (r'^2 + r^2*th'^2)/2 - r*cos(th)
constraints: {surface: {equation: r = 1, multiplier: N, holds_while: N >= 0}}
initial: {r: 1, th: %s, th': %s}
"""


@pytest.mark.parametrize("start", ["1e-8", "1e-3"])
def test_sliding_off_a_sphere(simulate, start):
    """cos(th) = 2 cos(th0)/3: 48.189685104221 degrees from rest at the top."""
    run = simulate(SPHERE % (start, 0), 40, "--precision", 40, show="th*180/pi")
    exact = float(mp.acos(2 * mp.cos(mpf(start)) / 3) * 180 / mp.pi)
    if start == "1e-8":
        assert exact == pytest.approx(48.189685104221, abs=1e-12)
    assert run.events[0]["what"] == "contact lost"
    assert run.last["th*180/pi"] == pytest.approx(exact, abs=1e-6)


def test_a_string_that_goes_slack(simulate):
    """v0^2 = 4 g l: the tension 2 + 3 cos(th) vanishes at acos(-2/3)."""
    text = """
coordinates: {r: {assume: positive}, th: {}}
L: (r'^2 + r^2*th'^2)/2 + r*cos(th)
constraints: {string: {equation: r = 1, multiplier: S, holds_while: S <= 0}}
initial: {r: 1, th: 0, th': 2}
"""
    run = simulate(text, 10)
    assert run.events[0]["what"] == "contact lost"
    assert run.last["th"] == pytest.approx(2.300523983022, abs=1e-9)


TOP = """
coordinates: [ph, th, ps]
parameters: {I: 1, J: %s}
T: I*(th'^2 + sin(th)^2*ph'^2)/2 + J*(ps' + ph'*cos(th))^2/2
V: %s
initial: %s
"""


def test_a_top_rises_to_gimbal_lock(simulate):
    """p_phi = p_psi = 3/2: 1 - cos(th) = (7/8) sech(k t)^2, k^2 = 7/16, which only tends to 0."""
    state = "{th: acos(1/8), th': 0, ph': 1.5/(1 + 1/8), ps': 3 - 1.5/9}"
    run = simulate(TOP % ("1/2", "cos(th)", state), 5, show="1 - cos(th)", accuracy=1e-8)
    exact = mpf(7) / 8 * mp.sech(5 * mp.sqrt(7) / 4) ** 2
    assert run.status == 0
    assert run.last["1 - cos(th)"] == pytest.approx(float(exact), abs=1e-8)


def test_upright_the_euler_angles_are_refused(simulate):
    run = simulate(TOP % ("1/2", "cos(th)", "{th: 0, ps': 5}"), 1)
    assert run.status == 1
    assert "mass matrix" in run.err


def test_a_free_top_next_to_gimbal_lock(simulate):
    """The axis turns at the rate 1 about L, tilted by 1/2: it meets the vertical at t = pi.

    cos(th) = cos(1/2)^2 - sin(1/2)^2 cos(t); 1.4e-3 before it the mass matrix is nearly singular.
    """
    state = "{th: 1, th': 0, ph': 1/(2*cos(1/2)), ps': 2*cos(1/2) - cos(1)/(2*cos(1/2))}"
    run = simulate(TOP % ("1/2", 0, state), "pi - 3e-3", show="cos(th)", accuracy=1e-8)
    assert run.status == 0
    exact = mp.cos(0.5) ** 2 + mp.sin(0.5) ** 2 * mp.cos(mpf("3e-3"))
    assert run.last["cos(th)"] == pytest.approx(float(exact), abs=1e-8)


@pytest.mark.long
def test_a_free_top_through_gimbal_lock_is_refused(simulate):
    """Its axis is vertical at t = pi, where sin(th)^2 is 0: told, and what is told is so."""
    state = "{th: 1, th': 0, ph': 1/(2*cos(1/2)), ps': 2*cos(1/2) - cos(1)/(2*cos(1/2))}"
    run = simulate(TOP % ("1/2", 0, state), 4, show="cos(th)", accuracy=1e-8, samples=41)
    assert run.status == 1
    assert "the mass matrix is singular, as with Euler angles upright" in run.err
    assert 3 < run.held["holds_until"] < math.pi
    for row in run.rows:
        exact = mp.cos(0.5) ** 2 - mp.sin(0.5) ** 2 * mp.cos(row["t"])
        assert row["cos(th)"] == pytest.approx(float(exact), abs=1e-8)


@pytest.mark.long
@pytest.mark.parametrize(("spin", "stable"), [("4 - 1e-6", False), ("4 + 1e-6", True)])
def test_the_threshold_of_the_sleeping_top(lagcli, spin, stable):
    """I1 = 1, I3 = 1/2: upright it is stable where I3^2 w^2 > 4 I1 m g l, w > 4."""
    text = f"""
coordinates: [ph, th, ps]
parameters: {{w: {spin}}}
T: (th'^2 + sin(th)^2*ph'^2)/2 + (ps' + ph'*cos(th))^2/4
V: cos(th)
initial: {{th: 1e-5, ph': w/(2*(1 + cos(1e-5))), ps': w - w*cos(1e-5)/(2*(1 + cos(1e-5)))}}
"""
    options = ["--until", "4000", "--accuracy", "1e-6", "--samples", "401"]
    run = lagcli("simulate", text, "-f", "json", "--show", "th*1e5", "--precision", "30", *options)
    rows = json.loads(run.out)["rows"]
    assert run.status == 0
    assert (max(row[1] for row in rows) < 1.01) == stable
    with mp.workdps(30):  # th'' = (1 - w^2/16) th, less than 1 % from the linear motion
        square = 1 - (4 + mpf("1e-6") * (1 if stable else -1)) ** 2 / 16
        exact = mp.re(mp.cosh(4000 * mp.sqrt(mp.mpc(square))))
    assert rows[-1][1] == pytest.approx(float(exact), rel=0.01)


def test_a_top_with_vanishing_inertia(simulate):
    """J = 1e-12: a spherical pendulum; the cone ph'^2 = 1/cos(pi - th) is kept."""
    state = "{th: pi - 1, ph': 1/sqrt(cos(1)), ps': 1}"
    run = simulate(TOP % ("1e-12", "cos(th)", state), 10, show="th,ph")
    assert run.status == 0
    assert run.last["th"] == pytest.approx(float(mp.pi - 1), abs=1e-9)
    assert run.last["ph"] == pytest.approx(float(10 / mp.sqrt(mp.cos(1))), abs=1e-9)


def test_a_top_without_inertia_about_its_axis_is_refused(simulate):
    run = simulate(TOP % (0, "cos(th)", "{th: 2, ph': 1}"), 1)
    assert run.status == 1
    assert "mass matrix" in run.err
