"""What the doubles make of a file is in the claim: parameters, initial values, frequencies."""

from fractions import Fraction
from math import sin, ulp
from random import Random

import pytest

from lagcli.numerics.certified.perturbed_twin import BesideDoubles, clocked

from .running import last, simulated

DRAW = Random(16)
FALLS = [(f"{DRAW.uniform(0.7, 0.8):.3f}", f"{DRAW.uniform(0.5, 2):.3f}") for _ in range(2)]
METHODS = ["auto", "taylor64", "dop853", "yoshida8"]
OSCILLATOR = """
coordinates: [x]
parameters: {{k: {k}, c: {c}}}
T: x'^2/2
V: (k - c)*x^2/2
initial: {{x: 1, x': 0}}
"""


def cosine(frequency_squared, times):
    """cos(w t) with 40 digits."""
    from mpmath import cos, mpf, sqrt, workdps

    with workdps(40):
        frequency = sqrt(mpf(frequency_squared.numerator) / frequency_squared.denominator)
        return [float(cos(frequency * mpf(t))) for t in times]


def held(result, frequency_squared):
    """The true error, and whether it is what is claimed."""
    times = [row[0] for row in result.rows]
    true = cosine(frequency_squared, times)
    worst = max(abs(row[1] - x) for row, x in zip(result.rows, true, strict=True))
    claimed = result.certificate.global_error["x"]
    return worst <= claimed + 2.0**-53


@pytest.mark.long
@pytest.mark.parametrize("method", METHODS)
def test_parameters_that_are_almost_the_same_are_no_better_than_their_rounding(method):
    """k - c = 0.1 of two that are rounded at 1e-10: no run with doubles knows x to 1e-9."""
    text = OSCILLATOR.format(k="1000000.1", c="1000000")
    result = simulated(text, 100, 1e-9, samples=101, method=method)
    assert held(result, Fraction(1, 10))
    if method != "auto":
        assert not result.certificate.reached


def test_a_looser_claim_takes_them_into_account():
    text = OSCILLATOR.format(k="1000000.1", c="1000000")
    result = simulated(text, 100, 1e-6, samples=101, method="dop853")
    assert result.certificate.reached
    assert held(result, Fraction(1, 10))
    assert result.certificate.global_error["x"] > 3e-9


@pytest.mark.parametrize("accuracy", [1e-10, 1e-12])
def test_a_frequency_is_known_to_a_rounding_only(accuracy):
    """Both runs have the same k/m: what it is rounded by is in neither's difference."""
    text = "coordinates: [x]\nT: 3*x'^2/20\nV: 7*x^2/20\ninitial: {x: 1, x': 0}\n"
    result = simulated(text, 1e4, accuracy, samples=101)
    assert result.certificate.reached
    assert held(result, Fraction(7, 3))


def test_other_numbers_lie_beyond_the_nearest_on_the_side_of_the_rational():
    number = BesideDoubles(exact=False).number
    for value in (Fraction(1, 10), Fraction(7, 3), Fraction(-98, 10), Fraction(1, 3)):
        near, other = float(value), number(value)
        missed = value - Fraction(near)
        assert (other > near) == (missed > 0)
        assert 1 <= abs(other - near) / ulp(near) <= 8
        assert abs(Fraction(other) - Fraction(near)) >= 2 * abs(missed)
    for value in (Fraction(0), Fraction(3, 4), Fraction(-2)):
        assert number(value) == value


def test_those_that_are_doubles_move_too_where_it_is_asked_but_counts():
    number = BesideDoubles(exact=True).number
    assert number(Fraction(3)) == 3
    for value in (Fraction(3, 4), Fraction(-1000), Fraction(1, 1 << 40)):
        assert 2 <= abs(number(value) - value) / Fraction(ulp(float(value))) <= 8


#: c is a double and 1e-8 above b^2/a, which is none: what is left of it is rounded by 5e-9.
NEARLY_SINGULAR = """
coordinates: [x, y]
parameters: {a: 3, b: 1, c: 0.3333333432674407958984375}
T: (a*x'^2 + 2*b*x'*y' + c*y'^2)/2
V: x^2 + y
initial: {x: 1, y: 0}
"""


@pytest.mark.long
@pytest.mark.parametrize("method", ["auto", "dop853"])
def test_what_an_elimination_rounds_alike_in_both_runs_is_in_the_claim(method):
    """x'' = (b - 2 c x)/D, y'' = (2 b x - a)/D with D = a c - b^2: harmonic in x."""
    from mpmath import cos, mpf, sqrt, workdps

    result = simulated(NEARLY_SINGULAR, 0.001, 1e-9, samples=11, method=method)
    c, claimed = Fraction("0.3333333432674407958984375"), result.certificate.global_error["x"]
    assert result.certificate.reached == (method == "auto")
    with workdps(40):
        c = mpf(c.numerator) / c.denominator
        middle, frequency = 1 / (2 * c), sqrt(2 * c / (3 * c - 1))
        for t, x, *_ in result.rows:
            true = middle + (1 - middle) * cos(frequency * mpf(t))
            assert abs(x - true) <= claimed + 2.0**-53


def test_the_clock_is_fast_or_slow_but_at_the_end():
    times = [0.0, 0.1, 7.0]
    assert clocked(times, 1) == [0.0, 0.1 * (1 + 2.0**-52), 7.0]
    assert clocked(times, -1) == [0.0, 0.1 * (1 - 2.0**-52), 7.0]


@pytest.mark.parametrize(("height", "strength"), [("0.854", "0.655"), ("0.702", "1.771"), *FALLS])
def test_a_fall_feels_its_height_and_the_clock_alike(height, strength):
    """t = sqrt(h^3/(8 k)) (s + sin s), x = h (1 + cos s)/2: h and the clock may cancel."""
    from mpmath import cos, findroot, mpf, sin, sqrt, workdps

    text = f"{{coordinates: [x], T: x'^2/2, V: -{strength}/x, initial: {{x: {height}}}}}"
    result = simulated(text, 5, 1e-13, samples=17)
    bounds = list(result.certificate.global_error.values())
    t, *row = result.rows[-1]
    with workdps(40):
        h, k = mpf(height), mpf(strength)
        unit = sqrt(h**3 / (8 * k))
        s = findroot(lambda s: unit * (s + sin(s)) - mpf(t), 2.4, tol=1e-70)
        x = h * (1 + cos(s)) / 2
        true = x, -sqrt(2 * k * (1 / x - 1 / h))
        assert t > 0.9 * unit * mpf("3.1416")
        for a, b, bound, scale in zip(
            true, row, bounds, result.certificate.scales[1:], strict=True
        ):
            assert abs(a - b) <= bound * scale + abs(b) * 2.0**-53


@pytest.mark.long
def test_a_slope_of_pi_less_a_little_feels_the_rounding_of_pi():
    """x = sin(pi - 1e-9) t^2/2: in doubles sin errs by 1.2e-7 of itself."""
    text = "{coordinates: [x], parameters: {a: pi - 1e-9}, L: x'^2/2 + sin(a)*x, initial: {x: 0}}"
    result = simulated(text, 1, 1e-9)
    if result.certificate.reached:
        assert last(result, "x") == pytest.approx(sin(1e-9) / 2, rel=1e-9)
    assert not simulated(text, 1, 1e-9, method="dop853").certificate.reached
