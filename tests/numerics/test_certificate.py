"""The certificate holds: the true error is at most what was asked for, or it is refused."""

from random import Random

import mpmath
import pytest

from lagcli import load
from lagcli.diagnostics import ProblemError
from lagcli.pipeline import with_lagrangian
from tests.marks import one_of
from tests.read import library

from .running import ROOT, simulated

SPAN = 4.0


def runnable(problem):
    return (
        bool(problem.initial)
        and not problem.functions
        and all(p.value is not None for p in problem.parameters)
        and has_lagrangian(problem)
    )


def has_lagrangian(problem):
    try:
        with_lagrangian(problem)
    except ProblemError:
        return False
    return True


def goes_on(problem):
    return bool(problem.contacts) or any(c.on_loss == "release" for c in problem.constraints)


LIBRARY = [path for path, problem in library().items() if runnable(problem)]


#: A rod that bounces ever more often, a block that slips: of all methods in doubles the bound of
#: one is more than 1e-9 and of the other more than 1e-13.
MORE_BITS = {"rod-strikes-floor": 1e-11, "block-on-belt": 1e-13}


@pytest.mark.parametrize("path", one_of(2, LIBRARY), ids=lambda p: p.stem)
def test_the_true_error_is_at_most_the_one_asked_for(path):
    """Against power series with 30 digits, a method that has nothing in common but the equations.

    Contacts close in up to 80 bits: there it is another method, beside `expect: trajectory`.
    """
    text, span = path.read_text("utf-8"), SPAN
    if path.stem in MORE_BITS:
        true = simulated(text, span, MORE_BITS[path.stem], samples=9, method="taylor80")
    elif goes_on(load(path)):
        # eight times what two runs of DOP853 differ by at its finest tolerances
        true = simulated(text, span, 8e-10, samples=9, method="dop853")
    else:
        true = simulated(text, span, 1e-13, samples=9, digits=30, method="taylor")
    assert true.certificate.reached
    for accuracy in (1e-3, 1e-6, 1e-9):
        result = simulated(text, span, accuracy, samples=9)
        assert result.certificate.reached
        assert len(result.rows) == len(true.rows)
        for j in range(1, len(result.columns)):
            pairs = [(row[j], other[j]) for row, other in zip(result.rows, true.rows, strict=True)]
            peak = max(abs(b) for _, b in pairs)
            scale = peak if peak > 1e-9 else 1.0
            assert max(abs(a - b) for a, b in pairs) <= accuracy * scale
        for residuals in result.certificate.constraints.values():
            assert max(x or 0 for x in residuals) <= 1e-12


@pytest.mark.long
def test_a_rod_that_bounces_many_times_is_followed_to_the_end_at_1e_6():
    text = (ROOT / "problems/impact/rod-strikes-floor.yaml").read_text("utf-8")
    true = simulated(text, SPAN, 1e-7, samples=9, method="dop853")
    result = simulated(text, SPAN, 1e-6, samples=9)
    assert true.certificate.reached
    assert result.certificate.reached
    assert len(result.rows) == len(true.rows)
    for row, other in zip(result.rows, true.rows, strict=True):
        assert row == pytest.approx(other, rel=1e-6, abs=1e-6)


DOUBLE = """
coordinates: [a, b]
L: a'^2 + b'^2/2 + a'*b'*cos(a - b) + 2*cos(a) + cos(b)
initial: {a: 3, b: 3}
"""


@pytest.mark.long
def test_chaos_is_refused_past_its_horizon_and_right_before():
    result = simulated(DOUBLE, 400, 1e-6, samples=401)
    assert not result.certificate.reached
    until = result.certificate.holds_until
    assert 5 < until < 200
    assert result.rows[-1][0] <= until
    assert "it holds until" in result.refusal
    true = simulated(DOUBLE, 10, 1e-9, digits=30, method="taylor")
    assert result.rows[10] == pytest.approx(true.rows[-1], abs=1e-6 * 20)


def test_the_certificate_says_how_it_was_estimated():
    held = simulated(DOUBLE, 5).certificate
    assert "runs with local tolerances" in held.estimated_by
    assert held.charges["energy"] < 1e-9
    assert set(held.global_error) == {"a", "b", "a'", "b'"}


ORBITS = """
coordinates: [x, y]
L: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)
initial: {x: 0.1, y: 0, x': 0, y': 4.358898943540674}
"""


@pytest.mark.long
def test_an_accuracy_that_is_lost_on_the_way_is_not_said_to_hold_to_the_end():
    """x' errs at each perihelion, more than at the end: 80 bits miss 1e-12 by a factor of 2."""
    until = 628.3185307179587
    result = simulated(ORBITS, until, 1e-12, samples=11, method="taylor80")
    if result.certificate.reached:
        pytest.skip("more bits than usual")
    assert 0 < result.certificate.holds_until < until
    assert result.rows[-1][0] == result.certificate.holds_until


PENDULUM = "coordinates: [a]\nL: a'^2/2 + cos(a)\ninitial: {{a: {}}}\n"
LONGER = """
coordinates: [a]
parameters: {{g: 9.81, l: 1.3}}
L: l^2*a'^2/2 + g*l*cos(a)
initial: {{a: {}, a': {}}}
"""
ROUNDED = [
    *(("taylor64", 1e-12, 40, PENDULUM.format(a)) for a in ("0.3", "1.1", "1.9", "2.6", "3")),
    ("dop853", 1e-13, 8, LONGER.format("2.5799", "0.5159")),
    ("dop853", 1e-13, 8, LONGER.format("2.8813", "0.8957")),
]


@pytest.mark.long
@pytest.mark.parametrize(("method", "accuracy", "until", "text"), ROUNDED)
def test_a_bound_at_the_rounding_of_doubles_holds(method, accuracy, until, text):
    """Two runs that differ by chance: against 34 digits, row by row."""
    found = simulated(text, until, accuracy, samples=21, method=method)
    true = simulated(text, until, 1e-20, samples=21, method="taylor128")
    if true.method != "taylor128":
        pytest.skip("no numbers of 128 bits")
    assert found.certificate.estimated_by.partition(" times")[0] in {"8", "20", "up to 60"}
    held = found.certificate.global_error
    for j, name in enumerate(found.columns[1:], 1):
        scale = max(1.0, *(abs(row[j]) for row in found.rows))
        pairs = zip(found.rows, true.rows, strict=False)
        errors = [abs(a[j] - b[j]) for a, b in pairs if abs(a[0] - b[0]) < 1e-12]
        assert max(errors) <= (held[name] + 2.0**-53) * scale


@pytest.mark.parametrize("seed", range(3))
def test_the_rounding_of_the_time_in_a_fast_drive_is_in_the_bound(seed):
    """x'' = A sin(w t): x' = A (1 - cos(w t))/w, x = A (t - sin(w t)/w)/w."""
    random = Random(seed)
    a, w = round(random.uniform(0.1, 5), 3), round(random.uniform(500, 5000), 2)
    text = f"{{coordinates: [x], T: x'^2/2, forces: {{x: {a}*sin({w}*t)}}, initial: {{x: 0}}}}"
    found = simulated(text, 10, 1e-9, samples=21)
    held, scales = found.certificate.global_error, found.certificate.scales
    mpmath.mp.dps = 30
    a, w = mpmath.mpf(str(a)), mpmath.mpf(str(w))
    for t, x, v in found.rows:
        true = a * (t - mpmath.sin(w * t) / w) / w, a * (1 - mpmath.cos(w * t)) / w
        assert abs(x - true[0]) <= (held["x"] + 2.0**-53) * scales[1]
        assert abs(v - true[1]) <= (held["x'"] + 2.0**-53) * scales[2]


def test_what_stands_in_abs_may_be_negative_at_first():
    """x'' = log(2 - t) from rest at 0: x(1) = 1/4, by parts."""
    text = "{coordinates: [x], T: x'^2/2, forces: {x: log(abs(t - 2))}, initial: {x: 0}}"
    [row] = simulated(text, 1, 1e-9).rows[1:]
    assert row[1] == pytest.approx(0.25, abs=1e-9)
