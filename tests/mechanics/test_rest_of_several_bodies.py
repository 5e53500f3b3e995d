"""Rest where bodies push each other, in bowls, and under a common factor that grows with time."""

import math
import random
from itertools import product

import pytest
import sympy

from lagcli.formatters.built_in.json import to_object
from lagcli.reader import read_problem
from tests.solved import solve


def answer(text):
    return to_object(solve(read_problem("test.yaml", text.encode()).checked(), ("equilibria",)))


def equilibria(text):
    return answer(text)["equilibria"]


@pytest.mark.long
@pytest.mark.parametrize("seed", range(3))
def test_inner_forces_cannot_hold_what_falls(seed):
    """The sum of all forces is the outer one (Newton's third law): none, or none unless g = 0."""
    source = random.Random(seed)
    power, shift = source.choice((2, 4)), source.choice(("l", "2*l"))
    inner = f"k*(sqrt((x1 - x2)^2 + (y1 - y2)^2) - {shift})^{power}/2"
    for assumed in ("{assume: positive}", ""):
        found = answer(f"""
coordinates: [x1, y1, x2, y2]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}, l: {{assume: positive}}, g: {assumed}}}
T: m*(x1'^2 + y1'^2 + x2'^2 + y2'^2)/2
V: {inner} + m*g*(y1 + y2)
""")
        assert found["equilibria"] == []
        assert not found["warnings"]


@pytest.mark.long
@pytest.mark.parametrize("power", [1, 2, 3])
@pytest.mark.parametrize("part", [1, 2])
def test_where_the_potential_is_infinite_nothing_rests(power, part):
    """Like charges on a ring rest opposite to each other, and not in one place."""
    found = equilibria(f"""
coordinates: [a, b]
parameters: {{m: {{assume: positive}}, e: {{assume: positive}}}}
T: m*(a'^2 + b'^2)/2
V: e^2/abs(sin((a - b)/{part}))^{power}
""")
    places = {each["at"]["a"] for each in found}
    assert places == ({"b + pi"} if part == 2 else {"b - pi/2", "b + pi/2"})


@pytest.mark.parametrize("seed", range(4))
def test_a_bowl_has_one_place_of_rest(seed):
    """As in minimal coordinates: V = m g (p x^2 + r y^2)/2 has one minimum and nothing else."""
    source = random.Random(seed)
    p, r = source.choice(("1/a", "2/a", "1/(3*a)")), source.choice(("1/a", "4/a"))
    found = answer(
        f"""
coordinates: [x, y, z]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}, a: {{assume: positive}}}}
T: m*(x'^2 + y'^2 + z'^2)/2
V: m*g*z
constraints: {{bowl: "{source.choice(("2*z", "z + z"))} = {p}*x^2 + {r}*y^2"}}
"""
    )
    assert [each["at"] for each in found["equilibria"]] == [{"x": "0", "y": "0", "z": "0"}]
    assert not found["warnings"]


def within_a_turn(angle):
    return round(angle - 2 * math.pi * round(angle / (2 * math.pi) - 1e-9), 6) + 0.0


@pytest.mark.parametrize(
    ("outer", "inner"),
    [
        ("-cos(a) - cos(b)", "2*sin((a - b)/2)^2"),  # beads on a hoop, joined by a spring
        ("-cos(a) - cos(b)", "-cos(a + b)"),
        ("cos(a) - cos(b)", "sin((a + b)/2)^2*2"),
        ("sin(a) + sin(b)", "-cos(a - b)"),
    ],
)
def test_two_bodies_on_a_ring_rest_where_each_force_vanishes(outer, inner):
    """All critical points of V on the torus, by Newton's method from a grid."""
    text = "coordinates: [a, b]\nT: (a'^2 + b'^2)/2\nV: {}".format
    found = answer(text(f"{outer} + 3*({inner})"))
    a, b = sympy.symbols("a b", real=True)
    V = sympy.sympify(f"{outer} + 3*({inner})".replace("^", "**"), {"a": a, "b": b})
    gradient = [V.diff(x) for x in (a, b)]
    slopes = sympy.lambdify((a, b), gradient, "math")
    hessian = sympy.lambdify((a, b), sympy.hessian(V, (a, b)).tolist(), "math")
    places = set()
    for start in product(range(-9, 10), repeat=2):
        x, y = (s * math.pi / 9 + 0.02 for s in start)
        for _ in range(40):
            (p, q), ((d, e), (_, h)) = slopes(x, y), hessian(x, y)
            whole = d * h - e * e or 1e-9
            x, y = x - (h * p - e * q) / whole, y - (d * q - e * p) / whole
        if math.hypot(*slopes(x, y)) < 1e-9:
            places.add(tuple(map(within_a_turn, (x, y))))
    named = {
        tuple(within_a_turn(float(sympy.sympify(each["at"][name]))) for name in "ab")
        for each in found["equilibria"]
    }
    assert not found["warnings"]
    assert named == places


@pytest.mark.parametrize("power", ["n", "2*n", "n/2"])
def test_half_an_angle_below_an_open_exponent_is_not_doubled(power):
    """V = k sin(x/2)^p has p sin(x/2)^(p - 1) cos(x/2): a maximum at pi, whatever p > 0."""
    found = equilibria(f"""
coordinates: [x]
parameters: {{m: {{assume: positive}}, k: {{assume: positive}}, n: {{assume: positive}}}}
T: m*x'^2/2
V: k*sin(x/2)^({power})
""")
    assert [each["stable"] for each in found if each["at"]["x"] == "pi"] == [False]


@pytest.mark.parametrize("growth", ["exp(c*t)", "exp(2*c*t)"])
def test_a_factor_that_grows_is_linear_friction(growth):
    """L = exp(c t) (T - V) is T - V with the friction c dT/dq' (Caldirola 1941, Kanai 1948)."""
    parameters = "{m: {assume: positive}, k: {assume: positive}, c: {assume: positive}}"
    factor = growth.removeprefix("exp(").removesuffix("*t)")
    grown = equilibria(f"""
coordinates: [x]
parameters: {parameters}
L: {growth}*(m*x'^2/2 - k*x^2/2)
""")
    damped = equilibria(f"""
coordinates: [x]
parameters: {parameters}
T: m*x'^2/2
V: k*x^2/2
dissipation: {factor}*m*x'^2/2
""")
    for one, other in zip(grown, damped, strict=True):
        assert one["at"] == other["at"] == {"x": "0"}
        assert one["stable"] is other["stable"] is True
        assert one["asymptotic"] is other["asymptotic"] is True


@pytest.mark.parametrize("factors", [["k"], ["k", "b"], ["k", "b", "c"]])
def test_what_makes_it_unstable_is_one_condition(factors):
    """V = -(k b c)^2 x^2/2 has a maximum only where no factor is 0."""
    hill = "*".join(f"{name}^2" for name in factors)
    found = equilibria(f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}, {": , ".join(factors)}: }}
T: m*(x'^2 + y'^2)/2
V: -{hill}*x^2/2 + g*y^2/2
""")
    [condition] = found[0]["unstable"]
    assert all(name in condition for name in factors)


@pytest.mark.long
def test_an_angle_of_rest_is_an_arc_sine_or_its_supplement():
    """R x (M + m) g sin(alpha) = -m g b sin(phi) of a wheel with a load on an incline."""
    found = equilibria("""
coordinates: [x, phi]
parameters: {M: {assume: positive}, m: {assume: positive}, R: {assume: positive}, b: {assume: positive}, g: {assume: positive}, alpha: }
points:
  hub: {position: [x*cos(alpha), -x*sin(alpha)], mass: M}
  load: {position: [x*cos(alpha) + b*sin(phi), -x*sin(alpha) + b*cos(phi)], mass: m}
V: -M*g*x*sin(alpha) + m*g*(b*cos(phi) - x*sin(alpha))
constraints: {rolling: x = R*phi}
""")
    angle = "asin((M + m)*R*sin(alpha)/(m*b))"
    stable = {each["at"]["phi"]: each["stable"] for each in found}
    assert stable == {f"-{angle}": False, f"pi + {angle}": True}  # the load above, and below


@pytest.mark.parametrize("sign", ["-", "+"])
def test_a_sum_of_two_angles_is_one_angle(sign):
    """The mass matrix of two links is definite: m l^2 l'^2 (M + m sin(x - y)^2) > 0."""
    [found] = equilibria(f"""
coordinates: [x, y]
parameters: {{M: {{assume: positive}}, m: {{assume: positive}}, k: {{assume: positive}}}}
T: (M + m)*x'^2/2 + m*y'^2/2 + m*x'*y'*cos(x {sign} y)
V: k*(x^2 + y^2)/2
""")
    assert found["at"] == {"x": "0", "y": "0"}
    assert found["stable"] is True


@pytest.mark.long
@pytest.mark.parametrize(
    ("a", "b", "coupling"),
    [(1, 3, "4*sin(x - y)"), (2, -1, "3*sin(x + y)"), (1, 2, "4*sin(x - y)")],
)
def test_places_on_a_torus_are_all_there(a, b, coupling):
    """Morse: on a torus the minima and maxima of V are as many as its saddles."""
    V = f"{a}*cos(x) + {b}*cos(y) - {coupling}"
    found = equilibria(f"""
coordinates: [x, y]
parameters: {{m: {{assume: positive}}, g: {{assume: positive}}}}
T: m*(x'^2 + y'^2)/2
V: g*({V})
""")
    x, y = sympy.symbols("x y")
    formula = sympy.sympify(V)
    signs = []
    for each in found:
        at = {s: sympy.sympify(each["at"][str(s)]).evalf(30) for s in (x, y)}
        assert all(abs(formula.diff(s).evalf(subs=at)) < 1e-12 for s in (x, y))
        definite = sympy.hessian(formula, (x, y)).det().evalf(subs=at) > 0
        lowest = formula.diff(x, 2).evalf(subs=at) > 0
        signs.append(1 if definite else -1)
        assert each["stable"] is bool(definite and lowest)
    assert len(signs) >= 4
    assert sum(signs) == 0
