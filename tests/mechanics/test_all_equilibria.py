"""All critical points of trigonometric polynomials, |f| and sign f; random members.

What is found is compared with Newton's method from many starts, which shares nothing with it.
"""

from __future__ import annotations

import math
import random
from itertools import pairwise

import pytest
import sympy
from sympy import Rational, cos, expand, lambdify, pi, sin, symbols

from lagcli.algebra.equations import solve_for
from lagcli.algebra.systems import solve_system
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.oscillations.small_oscillations import equilibria, modes
from lagcli.mechanics.rest.equilibria import RestPoints
from lagcli.mechanics.steady.statement import steady_motions
from lagcli.statements.answers import EquilibriaSection

from .derived import derive


def _found(V: str):
    d = derive(f"coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: \"{V}\"")
    rest = RestPoints(d.dynamics)
    points = [tuple(float(p.values[q]) for q in d.system.q) for p in rest.points or ()]
    return points, rest.complete


def _turned(u: float) -> float:
    return (u + math.pi - 1e-6) % (2 * math.pi) - math.pi + 1e-6


def _by_newton(V: str, source: random.Random) -> list[tuple[float, float]]:
    """Critical points on the torus, by differences of V."""
    f = eval(f"lambda x, y: {V.replace('^', '**')}", {"sin": math.sin, "cos": math.cos})
    h = 1e-4

    def slopes(x, y):
        return (f(x + h, y) - f(x - h, y)) / (2 * h), (f(x, y + h) - f(x, y - h)) / (2 * h)

    found: list[tuple[float, float]] = []
    for _ in range(150):
        x, y = source.uniform(-math.pi, math.pi), source.uniform(-math.pi, math.pi)
        for _ in range(40):
            a, b = slopes(x, y)
            (ax, bx), (ay, by) = (
                [(p - m) / (2 * h) for p, m in zip(slopes(*up), slopes(*down), strict=True)]
                for up, down in (((x + h, y), (x - h, y)), ((x, y + h), (x, y - h)))
            )
            determinant = ax * by - ay * bx
            if abs(determinant) < 1e-2:
                break
            x, y = x - (a * by - b * ay) / determinant, y - (ax * b - bx * a) / determinant
        if abs(determinant) > 1e-2 and max(map(abs, slopes(x, y))) < 1e-6:
            point = _turned(x), _turned(y)
            if all(math.dist(point, other) > 1e-2 for other in found):
                found.append(point)
    return found


WAVES = ("cos(x)", "cos(y)", "sin(x)", "sin(y)", "cos(x + y)", "cos(x - y)", "sin(x + y)",
         "cos(2*x)", "cos(x)*cos(y)", "sin(x)*sin(y)")  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("seed", range(12))
def test_all_critical_points_of_a_trigonometric_polynomial(seed):
    source = random.Random(seed)
    waves = source.sample(WAVES, 3)
    V = " + ".join(f"{source.choice((1, 2, 3))}*{wave}" for wave in waves)
    points, complete = _found(V)
    if complete:
        turned = [(_turned(x), _turned(y)) for x, y in points]
        for point in _by_newton(V, source):
            assert any(math.dist(point, other) < 1e-3 for other in turned), (V, point, turned)


def test_both_minima_of_three_cosines():
    points, complete = _found("cos(x) + cos(y) + cos(x + y)")
    assert complete
    third = 2 * math.pi / 3
    for sign in (1, -1):
        assert any(math.dist((sign * third,) * 2, point) < 1e-12 for point in points)


@pytest.mark.parametrize("seed", range(6))
def test_a_phase_moves_the_critical_points(seed):
    """a cos n (x - d) + b cos 2 n (x - d) + c cos (y - e): found at d and e, and all of them."""
    source = random.Random(seed)
    n, d, e = source.randint(1, 2), source.randint(1, 3), source.randint(1, 3)
    a, b, c = (source.choice((-3, -1, 1, 2, 4)) for _ in range(3))
    V = f"{a}*cos({n}*(x - {d})) + {b}*cos({2 * n}*x - {2 * n * d}) + {c}*cos(y - {e})"
    points, complete = _found(V)
    turned = [(_turned(x), _turned(y)) for x, y in points]
    assert complete
    for point in [(_turned(d), _turned(e)), *_by_newton(V, source)]:
        assert any(math.dist(point, other) < 1e-3 for other in turned), (V, point, turned)


def test_a_phase_that_is_a_parameter():
    """V = -k cos n (y - a) has its equilibria at n (y - a) = 0, pi, ..., whatever n and a."""
    k, n, a, y = symbols("k n a y", real=True)
    solved = solve_system([k * n * sin(n * (y - a))], [y])
    assert solved.complete
    assert {each.values[y] for each in solved.solutions} >= {a, a + pi / n}


@pytest.mark.parametrize(
    ("V", "expected"),
    [
        ("x*abs(x)", {0}),
        ("abs(x)", {0}),
        ("x^2*sign(x)", {0}),
        ("abs(x^2 - 1)", {0, 1, -1}),
        ("(x - 2)*abs(x - 2)", {2}),
        ("abs(x)^3 - 3*x", {1}),
        ("x^2 - 2*abs(x)", {0, 1, -1}),
        ("x^2 - 2*x*sign(x - 3)", {-1}),
    ],
)
def test_moduli_and_signs(V, expected):
    points, complete = _found(f"{V} + y^2")
    assert complete
    assert {round(x, 9) for x, _ in points} == expected


def test_others_are_announced():
    """x sin x has infinitely many; what is listed is not all, and the answers say so."""
    from lagcli.mechanics.statements import Statements

    d = derive("coordinates: [x]\nT: x'^2/2\nV: x*sin(x)")
    answers = Statements(d).answers(["equilibria"])
    assert any("not listed" in warning for warning in answers.warnings)


@pytest.mark.parametrize("seed", range(8))
def test_a_minimum_at_a_kink_is_not_denied(seed):
    """a |x - b| + c x + k y²: the convex V has its minimum at the kink where |c| < a."""
    source = random.Random(seed)
    a = source.randint(1, 5)
    c = source.choice([c for c in range(-7, 8) if abs(c) != a])
    b, k = source.randint(-2, 2), source.randint(1, 3)
    points, complete = _found(f"{a}*abs(x - {b}) + {c}*x + {k}*y^2")
    if abs(c) > a:
        assert (points, complete) == ([], True)
    else:
        assert points or not complete


def test_what_the_others_solve_is_quoted():
    from lagcli.mechanics.statements import Statements

    d = derive("coordinates: [x]\nT: x'^2/2\nV: x*sin(x)")
    section = Statements(d).answers(["equilibria"]).sections["equilibria"]
    assert isinstance(section, EquilibriaSection)
    assert [to_grammar(each) for each in section.open] == ["x*cos(x) + sin(x)"]


@pytest.mark.parametrize("seed", range(6))
def test_a_translation_of_all_coordinates_takes_no_equilibrium_away(seed):
    """V(x, y) with x = a - r c and y = b - s c has the equilibria of V(x, y), with c free."""
    source = random.Random(seed)
    waves = [*source.sample(WAVES[:4], 2), source.choice(("cos(x + y)", "cos(x - y)"))]
    V = " + ".join(waves)
    r, s = source.choice((1, -1, 2)), source.choice((1, -1, 2))
    points, complete = _found(V)
    moved = V.replace("x", "(a - R*c)").replace("y", "(b - S*c)")
    moved = moved.replace("R", str(r)).replace("S", str(s))
    d = derive(f"coordinates: [a, b, c]\nT: (a'^2 + b'^2 + c'^2)/2\nV: \"{moved}\"")
    rest = RestPoints(d.dynamics)
    a, b, c = d.system.q
    found = []
    for place in rest.points or ():
        values = {x: place.values.get(x, x) for x in d.system.q}
        differences = values[a] - r * values[c], values[b] - s * values[c]
        found.append(tuple(float(each.subs(c, 0)) for each in differences))
    assert rest.complete or not complete
    if complete:
        turned = [(_turned(x), _turned(y)) for x, y in found]
        for x, y in points:
            point = _turned(x), _turned(y)
            assert any(math.dist(point, other) < 1e-9 for other in turned), (V, point)


def test_three_like_rotors_have_two_states_in_which_all_angles_differ():
    d = derive("coordinates: [a, b, c]\nT: (a'^2 + b'^2 + c'^2)/2\n"
               "V: -(cos(a - b) + cos(b - c) + cos(c - a))")  # fmt: skip
    rest = RestPoints(d.dynamics)
    assert rest.complete
    a, b, c = d.system.q
    places = {tuple(p.values[x] - c for x in (a, b)) for p in rest.points or ()}
    third = 2 * pi / 3
    assert places == {(0, 0), (0, pi), (pi, 0), (pi, pi), (third, -third), (-third, third)}


@pytest.mark.parametrize("power", ["1/2", "-1/2", "3/2", "-3/2", "-5/2"])
def test_two_like_centres_balance_half_way_alone(power):
    """f^p = g^p only where f = g, both being positive."""
    k = Rational(power)
    x, y = symbols("x y", real=True)
    f, g = ((x + s) ** 2 + y**2 + 1 for s in (1, -1))
    found = solve_system([f**k - g**k, y**2 - 4], (x, y))
    assert found.complete
    assert {(each.values[x], each.values[y]) for each in found.solutions} == {(0, 2), (0, -2)}


@pytest.mark.parametrize("seed", range(4))
def test_where_a_slope_is_infinite_there_is_no_equilibrium(seed):
    """In a bowl z = -sqrt(c - k x² - n y²) the lowest point is the only one, the rim is none."""
    source = random.Random(seed)
    c = source.choice(["l^2", "4*l^2", "(l + a)^2"])
    k, n = source.choice(["1", "a^2/l^2"]), source.choice(["1", "2", "b^2/l^2"])
    across = f" - {n}*y^2" if source.random() < 0.5 else ""
    text = f"""
coordinates: {"[x, y]" if across else "[x]"}
parameters: {{m: POSITIVE, g: POSITIVE, l: POSITIVE, a: POSITIVE, b: POSITIVE}}
T: m*(x'^2{" + y'^2" if across else ""})/2
V: -m*g*sqrt({c} - {k}*x^2{across})
"""
    rest = RestPoints(derive(text.replace("POSITIVE", "{assume: positive}")).dynamics)
    assert rest.points is not None
    assert [set(point.values.values()) for point in rest.points] == [{0}]
    assert rest.complete


@pytest.mark.parametrize("seed", range(6))
def test_roots_of_a_polynomial_in_one_wave_of_a_phase(seed):
    """a cos² n (x - d) + b cos n (x - d) + c = 0: every sign change within a turn, and no other."""
    source = random.Random(seed)
    n, d = source.randint(1, 4), source.choice((0, 1, Rational(1, 2), pi / 3))
    a, b, c = (
        source.choice((0, 1, 2)),
        source.choice((-3, -1, 1)),
        Rational(source.randint(-2, 2), 3),
    )
    x = symbols("x", real=True)
    wave = source.choice((cos, sin))(expand(n * (x - d)))
    equation = a * wave**2 + b * wave + c
    found = solve_for(equation, x)
    assert found is not None
    places = {round(_turned(float(each)), 9) for each in found.values if each.is_real}
    value = lambdify(x, equation, "math")
    assert all(abs(value(each)) < 1e-6 for each in places)
    grid = [-math.pi + (k + 0.37) * math.pi / 500 for k in range(1001)]
    changes = [u for u, v in pairwise(grid) if value(u) * value(v) < 0]
    for u in changes:
        step = math.pi / 500
        assert any(abs(_turned(each - u - step / 2)) < step for each in places), (equation, u)


def test_a_sine_within_a_sine_has_the_period_of_the_inner_one():
    """Two pendulums and a torsion spring: theta_2 = theta_1 + m g l sin(theta_1)/k in a sine."""
    text = """
coordinates: [theta_1, theta_2]
parameters: {m: POSITIVE, g: POSITIVE, l: POSITIVE, k: POSITIVE}
T: m*l^2*(theta_1'^2 + theta_2'^2)/2
V: -m*g*l*(cos(theta_1) + cos(theta_2)) + k*(theta_1 - theta_2)^2/2
"""
    rest = RestPoints(derive(text.replace("POSITIVE", "{assume: positive}")).dynamics)
    assert rest.points is not None
    assert {0} in [set(point.values.values()) for point in rest.points]


@pytest.mark.parametrize("seed", range(4))
def test_the_time_cancels_in_a_frame_that_turns(seed):
    """A bead on a hoop about a point at the distance b, by its position in the laboratory.

    m r² θ'' = -m r b w² sin(θ - a): only the two points on the line of the centres.
    """
    source = random.Random(seed)
    a, axis = source.choice(("0", "pi/3")), source.choice(("z", "-z"))
    out, across = (f"(b*{f}(w*t) + r*{f}(w*t + theta - {a}))" for f in ("cos", "sin"))
    d = derive(
        "coordinates: {theta: }\nparameters: {m: {assume: positive}, r: {assume: positive}, "
        f"b: {{assume: positive}}, w: }}\npoints:\n  bead: {{position: [{out}, {across}, 0], "
        f"mass: m}}\n".replace("w*t", f"{'-' if axis == '-z' else ''}w*t")
    )
    rest = RestPoints(d.dynamics)
    assert rest.complete
    expected = {_turned(x + (math.pi / 3 if a != "0" else 0)) for x in (0, math.pi)}
    found = {_turned(float(p.values[d.system.q[0]])) for p in rest.points or ()}
    assert {round(x, 9) for x in found} == {round(x, 9) for x in expected}


@pytest.mark.parametrize("seed", range(8))
def test_a_wave_of_two_unknowns_is_solved_after_the_other_equation(seed):
    """wave(n y - k x) = c and a polynomial in x: y = (k x + arc)/n, where a is any parameter."""
    source = random.Random(seed)
    x, y = symbols("x y", real=True)
    a = symbols("a", positive=True)
    n, k, c = source.choice((1, 1, 2)), source.choice((1, -2, 3)), source.choice((0, 0, 1))
    wave = source.choice((sin, cos))(n * y - k * x) - Rational(c, 2)
    found = solve_system([wave, source.choice((x**2 - a**2, x**3 - a**2 * x))], [x, y])
    assert found.complete
    for value in (0.3, 1.1, 2.7):
        numbers = [
            {s: float(v.subs(a, value)) for s, v in each.values.items()} for each in found.solutions
        ]
        for place in sorted({each[x] for each in numbers}):
            own = {round(_turned(each[y]), 6) for each in numbers if each[x] == place}
            equation = lambdify(y, wave.subs(x, place), "math")
            grid = [-math.pi + (j + 0.37) * math.pi / 500 for j in range(1001)]
            assert all(abs(equation(each)) < 1e-5 for each in own)
            assert len(own) == sum(equation(u) * equation(v) < 0 for u, v in pairwise(grid))


@pytest.mark.parametrize("wave", ["sin(x/2)", "cos(x)", "sin(x)"])
def test_an_open_power_may_rest_where_its_base_vanishes(wave):
    """(V^n)' = n V^(n - 1) V': for n > 1 the places with V = 0 are equilibria, too."""
    d = derive(
        "coordinates: [x]\nparameters: {k: {assume: positive}, n: {assume: positive}}\n"
        f"T: x'^2/2\nV: k*{wave}^n"
    )
    rest = RestPoints(d.dynamics)
    assert rest.points
    assert not rest.complete


@pytest.mark.parametrize(
    "V",
    ["m*g*z + k/(n*z^n)", "k*z^(2*n) - m*z^n", "m*z*l^n - k*(l^2 + z^2)^(n + 1)/l", "g*z - k*z^n"],
)
def test_forces_with_open_exponents_balance_at_a_power_of_their_ratio(V):
    """A z^p = B z^q with p - q not 0: every sign change of V' on a grid, and no other place."""
    d = derive(
        "coordinates: {z: {assume: positive}}\nparameters: {m: {assume: positive}, g: {assume: "
        "positive}, k: {assume: positive}, l: {assume: positive}, n: {assume: positive}}\n"
        f"T: m*z'^2/2\nV: {V}"
    )
    rest = RestPoints(d.dynamics)
    [z], values = d.system.q, {"m": 1.3, "g": 0.7, "k": 0.4, "l": 0.9, "n": 2.5}
    numbers = {s: values[s.name] for s in d.system.L.free_symbols if s.name in values}
    slope = lambdify(z, d.system.L.diff(z).subs(numbers), "math")
    grid = [0.01 * 1.02**k for k in range(400)]
    changes = [u for u, v in pairwise(grid) if slope(u) * slope(v) < 0]
    found = [p.values[z].subs(numbers) for p in rest.points or ()]
    real = [float(x) for x in found if x.is_real]
    assert all(abs(slope(x)) < 1e-9 for x in real)
    assert len(real) == len(changes) or not rest.complete


@pytest.mark.parametrize("seed", range(4))
def test_a_body_that_rolls_rests_where_its_height_does(seed):
    """The heading is no condition: the constraints are solved for x' and y', whatever it is."""
    source = random.Random(seed)
    turn, power, radius = source.choice(["phi", "2*phi", "phi + 1"]), source.choice([1, 2]), "R"
    blade = [f"x'*cos({turn}) + y'*sin({turn})", f"-x'*sin({turn}) + y'*cos({turn})"]
    rolls = [f"{radius}*psi' + {radius}*phi'*cos(theta)", f"{radius}*theta'*sin(theta)^{power}"]
    source.shuffle(rolls)
    d = derive(
        "coordinates: [x, y, theta, phi, psi]\n"
        "parameters: {m: {assume: positive}, g: {assume: positive}, R: {assume: positive}}\n"
        "T: m*(x'^2 + y'^2 + R^2*(theta'^2 + phi'^2 + psi'^2))/2\nV: m*g*R*sin(theta)\n"
        f'constraints: {{a: "{blade[0]} + {rolls[0]}", b: "{blade[1]} + {rolls[1]}"}}'
    )
    rest = RestPoints(d.dynamics)
    assert rest.complete or not rest.points
    places = {str(value) for p in rest.points or () for value in p.values.values()}
    assert rest.complete
    assert places == {"pi/2", "-pi/2"}
    assert all(len(p.values) == 1 for p in rest.points or ())


@pytest.mark.parametrize("inertia", ["1 + q^2", "1 + p^2*sin(q)^2", "2 + sin(q)", "1 + p^2"])
def test_one_turn_is_not_all_where_the_inertia_counts_the_turns(inertia):
    """V = -cos(q) is stationary at q = n pi, which are two places where M is the same after a turn."""
    d = derive(f"coordinates: [q, p]\nL: ({inertia})*q'^2/2 + p'^2/2 + cos(q) - p^2/2")
    rest = RestPoints(d.dynamics)
    assert len(rest.points or ()) == 2
    assert rest.complete == (inertia != "1 + q^2")


@pytest.mark.parametrize("seed", range(3))
def test_two_pendulums_on_a_spring_rest_upright_too(seed):
    source = random.Random(seed)
    m, M, k = (source.randint(1, 5) for _ in range(3))
    d = derive(
        "coordinates: [a, b]\n"
        f"L: {m}*a'^2/2 + {M}*b'^2/2 + {m}*cos(a) + {M}*cos(b) - {k}*(b - a)^2/2"
    )
    rest = RestPoints(d.dynamics)
    places = {tuple(map(str, p.values.values())) for p in rest.points or ()}
    assert places == {("0", "0"), ("pi", "pi")}
    assert not rest.complete


@pytest.mark.parametrize(
    ("V", "count", "complete"),
    [("m*r*sin(u) + k*u^2/2", 2, False), ("m*cos(u) + k*u^4 + r^2", 1, False)],
)
def test_an_angle_in_a_spring_may_rest_after_further_turns(V, count, complete):
    """A beam that a torsion spring holds: sin(u) = 0 at each half turn, with another r."""
    d = derive(f"coordinates: [r, u]\nparameters: [m, k]\nL: r'^2/2 + (1 + r^2)*u'^2/2 - ({V})")
    rest = RestPoints(d.dynamics)
    assert len(rest.points or ()) >= count
    assert rest.complete is complete


def test_an_angle_that_a_force_of_its_own_gives_is_listed_once():
    """A cart with the feedback p theta below an upright rod."""
    d = derive(
        "coordinates: [x, theta]\nparameters: {p: {assume: positive}}\n"
        "L: x'^2 + theta'^2/2 + x'*theta'*cos(theta) - cos(theta)\nforces: {x: p*theta}"
    )
    rest = RestPoints(d.dynamics)
    assert [str(p.values) for p in rest.points or ()] == ["{theta: 0}"]
    assert rest.complete


@pytest.mark.parametrize("curve", ["a*cos(x/a)", "x^2/a + a*cos(x/a)", "a*cos(x/a)*exp(-x^2/a^2)"])
def test_an_evident_place_on_a_curve_is_that_of_its_coordinate(curve):
    """m g F'(x) + k x = 0 has no closed solution but x = 0, with y = F(0)."""
    letters = "".join(f"{name}: {{assume: positive}}, " for name in "mgka")
    held = derive(
        f"coordinates: [x, y]\nparameters: {{{letters}}}\nT: m*(x'^2 + y'^2)/2\n"
        f'V: m*g*y + k*x^2/2\nconstraints: {{c: "y = {curve}"}}\n'
    )
    free = derive(
        f'coordinates: [x]\nparameters: {{{letters}}}\nT: m*x\'^2/2\nV: "m*g*({curve}) + k*x^2/2"\n'
    )
    rest = RestPoints(held.dynamics)
    [found], [alone] = rest.points, RestPoints(free.dynamics).points
    assert {q.name: str(v) for q, v in found.values.items()} == {"x": "0", "y": "a"}
    assert list(alone.values.values()) == [0]
    assert not rest.complete


@pytest.mark.parametrize("n", [2, 4, 5])
@pytest.mark.parametrize("seed", range(2))
def test_an_angle_of_which_a_part_is_felt_has_more_than_one_turn(n, seed):
    """V of cos(x/n) has the period 2 pi n; the minima and maxima are counted on a grid."""
    source = random.Random(f"turns {n} {seed}")
    a, b = source.choice([-3, -2, 2, 3]), source.choice([-1, 1])
    points, complete = _found(f"{a}*cos(x/{n}) + {b}*cos(3*x/{n}) + y^2")

    def slope(x: float) -> float:
        return -a * math.sin(x / n) - 3 * b * math.sin(3 * x / n)

    grid = [n * math.pi * (-1 + 2 * (k + 0.5) / 4000) for k in range(4000)]
    changes = sum(slope(x) * slope(y) < 0 for x, y in pairwise([*grid, grid[0]]))
    assert complete
    assert len(points) == changes
    assert all(abs(slope(x)) < 1e-9 and -n * math.pi < x <= n * math.pi + 1e-9 for x, _ in points)


def test_a_half_angle_that_is_squared_has_one_turn():
    points, complete = _found("sin(x/2)^2 + abs(sin(x/2))^3 + y^2")
    assert complete
    assert sorted(round(x, 9) for x, _ in points) == [0, round(math.pi, 9)]


@pytest.mark.parametrize(
    "constraints",
    ["{a: (x - y)^2 + z^2 = 1, b: x*y*z + z^3 = k}", "{a: x^2 + y^2 = 1, b: z^2 + x*z = 1 + k^2}"],
)
@pytest.mark.parametrize(("force", "everywhere"), [("0", True), ("x*y'", True), ("-x^2", False)])
def test_without_a_force_every_position_is_an_equilibrium(constraints, force, everywhere):
    """Statics: a body that no force acts on rests where it is put; gyroscopic ones need motion."""
    dynamics = derive(
        "coordinates: [x, y, z]\nparameters: {m: {assume: positive}, k: {assume: positive}}\n"
        f"L: m*(x'^2 + y'^2 + z'^2)/2 + {force}\nconstraints: {constraints}\n"
    ).dynamics
    section = equilibria(dynamics)
    assert section.everywhere is everywhere
    assert section.reason.startswith("no force acts at rest") is everywhere
    assert modes(dynamics).reason.startswith("no force acts at rest") is everywhere


@pytest.mark.parametrize(
    ("cyclic", "moving", "reason"),
    [("", "", "no force acts at rest"), (", u", " + u'^2", "no force acts then")],
)
def test_where_every_position_is_an_equilibrium_every_one_is_steady(cyclic, moving, reason):
    """The steady motions do not say that none was found where all are."""
    section, missing = steady_motions(
        derive(
            f"coordinates: [x, y, z{cyclic}]\nparameters: {{k: {{assume: positive}}}}\n"
            f"L: (x'^2 + y'^2 + z'^2{moving})/2\n"
            "constraints: {a: (x - y)^2 + z^2 = 1, b: x*y*z + z^3 = k}\n"
        )
    )
    assert section.everywhere
    assert section.reason.startswith(reason)
    assert not missing


def test_where_contacts_are_open_or_closed_every_position_is_one_without_a_force():
    dynamics = derive("""
coordinates: [x, y, z]
parameters: {m: {assume: positive}}
T: m*(x'^2 + y'^2 + z'^2)/2
constraints: {a: "x^2*y + y^3 + x = 2", b: {equation: "x*z + z^3 + y = 0", multiplier: N, holds_while: N >= 0}}
""").dynamics
    assert equilibria(dynamics).everywhere


@pytest.mark.parametrize("seed", range(6))
def test_nothing_is_left_open_where_conditions_without_sines_give_all_angles(seed):
    """A chain with springs at its hinges whose last rod a follower force presses.

    Sum the moments: hinge after hinge, none is bent, whatever angles sin(a - b) could have.
    """
    draw = random.Random(seed)
    n = draw.randint(2, 3)
    q = [f"a{k}" for k in range(1, n + 1)]
    bends = [f"({b} - {a})^2" for a, b in pairwise(q)]
    springs = " + ".join(f"{draw.randint(1, 3)}*c*{x}" for x in [f"{q[0]}^2", *bends])
    squares = " + ".join(f"{x}'^2" for x in q)
    loads = ", ".join(f"{x}: P*sin({x} - {q[-1]})" for x in q[:-1])
    text = (
        f"coordinates: {{{', '.join(f'{x}: {{unit: rad}}' for x in q)}}}\n"
        "parameters: {c: {assume: positive}, P: {assume: positive}}\n"
        f"T: ({squares})/2\nV: ({springs})/2\nforces: {{{loads}}}\n"
    )
    rest = RestPoints(derive(text).dynamics)
    assert [[p.values[x] for x in rest.system.q] for p in rest.points] == [[0] * n]
    assert rest.complete
    alone = text.replace(loads, f"{q[0]}: P*sin({q[0]})")  # c a = P sin a: several for a great P
    rest = RestPoints(derive(alone).dynamics)
    assert not (rest.points and rest.complete)


@pytest.mark.parametrize(
    ("V", "complete"),
    [
        ("exp(-x)*sin(x)", False),
        ("exp(-x/5)*(2*sin(x) + cos(x))", False),
        ("exp(-cos(x))*sin(x)", True),
        ("exp(-sin(2*x))*cos(2*x)", True),
        ("cos(x) + cos(sqrt(2)*x)/50", False),
    ],
)
def test_a_coordinate_that_counts_its_turns_rests_in_more_than_one(V, complete):
    """Where the forces differ from one turn to the next, one turn is not all."""
    rest = RestPoints(derive(f"coordinates: [x]\nT: x'^2/2\nV: {V}\n").dynamics)
    assert rest.points is None or rest.complete is complete


@pytest.mark.parametrize("seed", range(8))
def test_half_angles_beside_whole_ones_have_two_turns(seed):
    """All roots of V' within 4 pi, counted by the changes of its sign."""
    draw = random.Random(seed)
    a, b = draw.randint(1, 5), draw.randint(1, 5)
    half, whole = draw.choice(("cos", "sin")), draw.choice(("cos", "sin"))
    V = f"{a}*{half}(x/2) + {b}*{whole}(x)"
    rest = RestPoints(derive(f"coordinates: [x]\nT: x'^2/2\nV: {V}\n").dynamics)
    x = symbols("x", real=True)
    slope = lambdify(x, (a * {"cos": cos, "sin": sin}[half](x / 2)
                         + b * {"cos": cos, "sin": sin}[whole](x)).diff(x))  # fmt: skip
    grid = [4 * math.pi * k / 20011 + 0.001 for k in range(20012)]
    signs = [slope(u) > 0 for u in grid]
    assert rest.complete
    found = [float(p.values[rest.system.q[0]]) for p in rest.points]
    assert len({round(u % (4 * math.pi), 6) for u in found}) == len(found)
    assert len(found) == sum(m != n for m, n in pairwise(signs))
    assert all(abs(slope(u)) < 1e-9 for u in found)


@pytest.mark.parametrize("coordinate", ["x: {}", "x: {assume: nonnegative}"])
@pytest.mark.parametrize("exponent", ["n", "2*n", "2*n + 1", "n + 3"])
def test_a_power_with_an_open_exponent_may_vanish_with_its_base(coordinate, exponent):
    """V = x^n has its only place of rest at 0; nothing says that there is none."""
    rest = RestPoints(
        derive(
            f"coordinates: {{{coordinate}}}\n"
            "parameters: {n: {assume: positive, integer: true}}\n"
            f"T: x'^2/2\nV: x^({exponent})\n"
        ).dynamics
    )
    places = [float(p.values[rest.system.q[0]]) for p in rest.points or ()]
    assert places == [0] or not (rest.complete and rest.points is not None)


@pytest.mark.parametrize("seed", range(4))
def test_a_chain_of_exponential_springs_rests_at_equal_forces_and_nowhere_else(seed):
    """V = sum a_i exp(u_i - u_j) around a ring is convex, so that its equilibria are one line:
    a_1 exp(u_1 - u_2) = a_2 exp(u_2 - u_3) = …; Toda, *Theory of Nonlinear Lattices*."""
    given = random.Random(seed)
    n, rate = given.choice([2, 3]), given.randint(1, 3)
    a = [given.randint(1, 9) for _ in range(n)]
    names = given.sample("uvwxyz", n)
    ring = " + ".join(f"{a[k]}*exp({rate}*({names[k]} - {names[(k + 1) % n]}))" for k in range(n))
    T = " + ".join(f"{x}'^2/2" for x in names)
    section = equilibria(
        derive(f'{{coordinates: [{", ".join(names)}], T: "{T}", V: "{ring}"}}').dynamics
    )
    [found] = section.equilibria
    assert section.complete
    [free] = found.free
    at = {name: float(sympy.sympify(to_grammar(found.at[name]).replace("^", "**"), locals={free: 0}))
          if name != free else 0.0 for name in names}  # fmt: skip
    pulls = [a[k] * math.exp(rate * (at[names[k]] - at[names[(k + 1) % n]])) for k in range(n)]
    assert pulls == pytest.approx([pulls[0]] * n)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("length", ["1", "b"])
def test_products_of_sines_with_a_constant_force_are_solved_by_a_double_angle(seed, length):
    """V = k f(x) g(x) + a x: V' is a sine of 2 x and a constant; all its zeros in one period."""
    draw = random.Random(seed)
    f, g = draw.choice(("cos", "sin")), draw.choice(("cos", "sin"))
    k, a = draw.randint(2, 5), draw.randint(1, 3)
    V = f"{k}*c*{f}(x/{length})*{g}(x/{length}) + {a}*c*x/({length}*4)"
    rest = RestPoints(
        derive(
            "coordinates: [x]\nparameters: {b: {assume: positive}, c: {assume: positive}}\n"
            f"T: x'^2/2\nV: {V}\n"
        ).dynamics
    )
    assert rest.complete
    [x] = rest.system.q
    known = {p: {"b": 0.7, "c": 1}[p.name] for p in rest.system.parameters}
    scale = 0.7 if length == "b" else 1
    found = [float(p.values[x].subs(known)) / scale for p in rest.points]
    u = symbols("u", real=True)
    slope = lambdify(u, (k * {"cos": cos, "sin": sin}[f](u) * {"cos": cos, "sin": sin}[g](u)
                         + Rational(a, 4) * u).diff(u))  # fmt: skip
    assert all(abs(slope(value)) < 1e-9 for value in found)
    grid = [math.pi * n / 9973 + 0.0003 for n in range(9974)]
    zeros = sum((slope(s) > 0) != (slope(t) > 0) for s, t in pairwise(grid))
    classes = {round(math.sin(2 * v), 6) + 10 * round(math.cos(2 * v), 6) for v in found}
    assert len(classes) == zeros
