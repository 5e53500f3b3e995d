"""What lies between the places at which a run looks: found, or the run ends there.

The references are integrals: of a force over the time, of 1/v over the path.
"""

import random
from fractions import Fraction

import mpmath
import pytest

from lagcli.graph.bounded import bounded
from lagcli.graph.nodes import Graph
from lagcli.numerics.compiled.layout import DIVIDES, FLAT, GROWS, HIGH, JUMPS
from lagcli.numerics.compiled.narrow import narrow_parts
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.straight_line import straight_line
from tests.marks import mostly_long
from tests.numerics.running import column, last, simulated

BY_TIME = """
coordinates: [x]
T: x'^2/2
forces: {{x: "{force}"}}
initial: {{x: 0, x': 0}}
"""
BY_PLACE = """
coordinates: [x]
T: x'^2/2
V: "{potential}"
initial: {{x: 0, x': 1}}
"""
ACCURACIES = (1e-6, 1e-9, 1e-12)
UNTIL = 10


def drawn(seed, low=-6, high=-2):
    """A height, a place and a width, as they are written."""
    draw = random.Random(seed)
    width = f"{draw.uniform(1, 9.9):.3g}e{draw.randint(low, high - 1)}"
    return f"{draw.uniform(0.05, 0.2):.4g}", f"{draw.uniform(3, 6):.5g}", width


def around(place, width):
    """The place, and others on both sides of it, ever farther away."""
    c, w = mpmath.mpf(place), mpmath.mpf(width)
    return [c, *(c + s * w * mpmath.mpf(2) ** j / 8 for j in range(60) for s in (1, -1))]


def integral(f, end, places):
    ends = sorted({mpmath.mpf(0), end, *(p for p in places if 0 < p < end)})
    return mpmath.quad(f, ends)


def held(result, name, true):
    """Whether a claim of the last row holds with the bound that is printed; a row has doubles."""
    certificate = result.certificate
    if not certificate.reached:
        return bool(result.refusal)
    scale = certificate.scales[result.columns.index(name)]
    rounding = 1e-16 + 2.0**-53 * abs(true)
    return abs(last(result, name) - true) <= certificate.global_error[name] * scale + rounding


PULSES = {
    "exp(-((t - {c})/{w})^2)/{w}": lambda u: mpmath.exp(-(u**2)),
    "{h}/{w}/(1 + ((t - {c})/{w})^2)": lambda u: 1 / (1 + u**2),
    "{h}*tanh((t - {c})/{w})/{w}": mpmath.tanh,
    "{h}/cosh((t - {c})/{w})^2/{w}": lambda u: mpmath.sech(u) ** 2,
    "{h}/cosh((t - {c})/{w})/{w}": mpmath.sech,
    "{h}*exp((t - {c})/{w})/(1 + exp((t - {c})/{w}))^2/{w}": lambda u: mpmath.sech(u / 2) ** 2 / 4,
}


@pytest.mark.first_quick
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("text", PULSES)
def test_a_pulse_in_time_is_not_stepped_over(text, seed):
    h, c, w = drawn(f"{text} {seed}", -9 if text.startswith("exp") else -6)
    mpmath.mp.dps = 25
    factor = mpmath.mpf(h) if "{h}" in text else mpmath.mpf(1)
    width = mpmath.mpf(w)

    def force(t):
        return factor * PULSES[text]((t - mpmath.mpf(c)) / width) / width

    places = around(c, w)
    end = mpmath.mpf(UNTIL)
    speed = integral(force, end, places)
    place = integral(lambda t: (end - t) * force(t), end, places)
    for accuracy in ACCURACIES:
        file = BY_TIME.format(force=text.format(h=h, c=c, w=w))
        result = simulated(file, UNTIL, accuracy)
        assert result.certificate.reached
        assert held(result, "x'", speed)
        assert held(result, "x", place)


HILLS = {
    "{h}*exp(-((x - {c})/{w})^2)": lambda u: mpmath.exp(-(u**2)),
    "{h}/(1 + ((x - {c})/{w})^2)": lambda u: 1 / (1 + u**2),
    "{h}*(x - {c})^2/((x - {c})^2 + {w}^2)": lambda u: u**2 / (1 + u**2),
    "{h}*tanh((x - {c})/{w})": mpmath.tanh,
    "{h}*atan((x - {c})/{w})/2": lambda u: mpmath.atan(u) / 2,
    "{h}/cosh((x - {c})/{w})^2": lambda u: mpmath.sech(u) ** 2,
}


@pytest.mark.long
@pytest.mark.parametrize("text", mostly_long(HILLS, "{h}*(x - {c})^2/((x - {c})^2 + {w}^2)"))
def test_a_hill_is_not_stepped_over(text):
    h, c, w = drawn(text)
    mpmath.mp.dps = 25

    def potential(x):
        return mpmath.mpf(h) * HILLS[text]((x - mpmath.mpf(c)) / mpmath.mpf(w))

    energy = mpmath.mpf(1) / 2 + potential(0)

    def speed(x):
        return mpmath.sqrt(2 * (energy - potential(x)))

    x = mpmath.mpf(UNTIL)
    for _ in range(20):  # Newton, for the time at which it comes to x
        x += (UNTIL - integral(lambda y: 1 / speed(y), x, around(c, w))) * speed(x)
    for accuracy in ACCURACIES:
        file = BY_PLACE.format(potential=text.format(h=h, c=c, w=w))
        result = simulated(file, UNTIL, accuracy)
        assert result.certificate.reached
        assert held(result, "x", x)
        assert held(result, "x'", speed(x))


@pytest.mark.parametrize("width", ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6"])
def test_a_wall_is_not_passed_through(width):
    file = BY_PLACE.format(potential=f"exp(-((x - 5)/{width})^2)")
    result = simulated(file, UNTIL, 1e-9, samples=11)
    assert result.certificate.reached
    assert max(column(result, "x")) < 5
    assert last(result, "x'") == pytest.approx(-1, abs=1e-9)


@pytest.mark.parametrize("place", [-1000.0, -2.0, 0.5, 3.0, 1000.0])
def test_quotients_of_exponentials_are_those_of_doubles_or_beyond(place):
    graph = Graph()
    x = graph.symbol("x")
    e, two = (graph.call("exp", (graph.scaled(x, k),)) for k in (3, -6))
    below = graph.sum([graph.constant(2), e, graph.product(x, two)])
    cosh, sinh = (graph.call(name, (x,)) for name in ("cosh", "sinh"))
    formulas = [
        graph.quotient(e, graph.product(below, below)),
        graph.monomial([(cosh, Fraction(-3)), (sinh, Fraction(1))]),
        graph.monomial([(below, Fraction(-1, 2)), (two, Fraction(1))]) if place > 0 else graph.one,
        graph.quotient(graph.difference(two, e), graph.sum([e, two])),
    ]
    mpmath.mp.dps = 30
    u = mpmath.mpf(place)
    s, a, b = 2 + mpmath.exp(3 * u) + u * mpmath.exp(-6 * u), mpmath.exp(3 * u), mpmath.exp(-6 * u)
    true = [
        a / s**2,
        mpmath.sinh(u) / mpmath.cosh(u) ** 3,
        b / mpmath.sqrt(s) if place > 0 else 1,
        (b - a) / (a + b),
    ]
    found = straight_line([x], bounded(graph, formulas), {}, Doubles())(place)
    for value, exact in zip(found, true, strict=True):
        assert value == pytest.approx(float(exact), rel=1e-12, abs=1e-300)


def test_a_force_of_1e12_on_a_relativistic_particle():
    """x = (sqrt(1 + F^2 t^2) - 1)/F: 1 - v^2 falls to 1e-24."""
    file = """
coordinates: [x]
L: "-sqrt(1 - x'^2) + 1e12*x"
initial: {x: 0, x': 0}
"""
    result = simulated(file, 1, 1e-6)
    assert result.certificate.reached
    assert abs(last(result, "x") - (1 - 1e-12)) <= result.certificate.global_error["x"]


@pytest.mark.parametrize(
    ("formula", "kind"),
    [
        ("exp", GROWS),
        ("tanh", FLAT),
        ("sign", JUMPS),
        ("tan", DIVIDES),
        ("log", DIVIDES),
        ("acos", DIVIDES),
    ],
)
def test_functions_that_may_be_narrow(formula, kind):
    graph = Graph()
    x = graph.symbol("x")
    [found] = narrow_parts(graph, [graph.call(formula, (x,))], x.mask)
    assert found.kind == kind


def test_powers_that_may_be_narrow():
    graph = Graph()
    x, k = graph.symbol("x"), graph.symbol("k")
    of = graph.constant
    assert not narrow_parts(graph, [graph.power(x, of(4)), graph.power(k, of(-1))], x.mask)
    [high] = narrow_parts(graph, [graph.power(x, of(200))], x.mask)
    assert (high.kind, high.power) == (HIGH, 200)
    [pole] = narrow_parts(graph, [graph.power(x, of(-2))], x.mask)
    assert (pole.kind, pole.argument) == (DIVIDES, x)


def test_what_is_divided_by_0_is_passed_where_it_is_regular():
    result = simulated(BY_PLACE.format(potential="-sin(x - 3)/(x - 3)/4"), UNTIL, 1e-9)
    assert result.certificate.reached


@pytest.mark.parametrize("method", mostly_long(["dop853", "radau5", "taylor"], "dop853", "taylor"))
def test_methods_whose_steps_come_without_series_pass_over_nothing(method):
    h, c, w = drawn(method, -4, -2)
    mpmath.mp.dps = 25
    width = mpmath.mpf(w)

    def force(t):
        return mpmath.mpf(h) * mpmath.exp(-(((t - mpmath.mpf(c)) / width) ** 2)) / width

    speed = integral(force, mpmath.mpf(UNTIL), around(c, w))
    file = BY_TIME.format(force=f"{h}*exp(-((t - {c})/{w})^2)/{w}")
    result = simulated(file, UNTIL, 1e-6, method=method)
    assert result.certificate.reached
    assert held(result, "x'", speed)


BUMP = """
coordinates: [x, y]
T: (x'^2 + y'^2)/2
contacts: {{bump: {{gap: "y - {gap} >= 0"}}}}
initial: {{x: 0, y: 0.9, x': 1}}
"""


@pytest.mark.parametrize("width", ["1e-2", "1e-4", "1e-6"])
@pytest.mark.parametrize(
    ("gap", "reach"),
    [
        ("exp(-((x - 5)/{w})^2)", (-mpmath.log(0.9)) ** 0.5),
        ("1/(1 + ((x - 5)/{w})^2)", 1 / 3),
        ("1/cosh((x - 5)/{w})", mpmath.acosh(1 / 0.9)),
    ],
)
def test_a_narrow_bump_of_a_contact_is_met(gap, reach, width):
    result = simulated(BUMP.format(gap=gap.format(w=width)), UNTIL, 1e-9)
    [event] = result.events
    assert event.what == "contact closes"
    assert abs(event.t - (5 - reach * float(width))) <= 1e-13 + event.error


def test_a_gap_that_nearly_closes_again_and_again():
    free = BY_PLACE.format(potential="0")
    comb = 'contacts: {{comb: {{gap: "{h} + sin(300*x) >= 0"}}}}'
    assert not simulated(free + comb.format(h=1.0001), UNTIL, 1e-9).events
    [event] = simulated(free + comb.format(h=0.9999), UNTIL, 1e-9).events
    assert event.t == pytest.approx((mpmath.pi + mpmath.asin(0.9999)) / 300, rel=1e-9)


@pytest.mark.parametrize(
    ("width", "whole"), [("1e-2", False), ("1e-3", False), ("1e-5", False), ("1e-2", True)]
)
def test_a_bead_climbs_a_steep_step_of_its_wire(width, whole):
    """v^2/2 + g y: behind the step of 0.02 the speed is sqrt(1 - 0.04 g), reduced model or not."""
    text = (
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, V: 9.81*y, initial: {x: 0, x': 1}, "
        f"constraints: {{wire: 'y = 0.01*tanh((x - 2)/{width})'}}}}"
    )
    result = simulated(text, 4, 1e-9, whole=whole)
    assert result.certificate.reached, result.refusal
    assert held(result, "x'", mpmath.sqrt(1 - mpmath.mpf("0.04") * mpmath.mpf("9.81")))
