"""Machine code: its recurrences against FLINT's series, its runs against runs in Python."""

import math
from fractions import Fraction
from itertools import pairwise

import pytest

from lagcli.numerics.certified import machine_code
from lagcli.numerics.compiled import layout
from lagcli.numerics.compiled.engine import NoCompiler, engine
from lagcli.numerics.compiled.language import translated
from lagcli.numerics.compiled.machine import Machine
from lagcli.numerics.compiled.numbers import DOUBLE, EXTENDED, QUADRUPLE
from lagcli.numerics.equations.arithmetic import Balls, Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.hybrid.compiled_taylor import CompiledTaylor
from lagcli.numerics.integrators.steps import Tolerance
from lagcli.numerics.integrators.taylor import Taylor

from .running import column, last, problem_of, simulated

FORCES = [
    "x*y", "x^2", "y^3", "x^7", "x/y", "1/y", "y/(x*y + 2)", "y^(1/2)", "y^(3/2)", "y^(-3/2)",
    "1/y^2", "1/(2*y)^4", "y^(1/3)", "(2*y)^0.7", "y^x",
    "sin(x)", "cos(x)", "sin(x)*cos(x)", "tan(x)", "cot(y)", "sec(x)", "csc(y)", "exp(x)", "log(y)",
    "atan(x)", "asin(x/3)", "acos(x/3)", "sinh(x)", "cosh(x)", "tanh(x)", "asinh(x)", "acosh(2*y)",
    "atanh(x/3)", "atan2(x, y)", "atan2(-y, x)", "sqrt(x^2 + y^2)", "-3*x + 2", "t*x", "sin(t)",
    "x'*y'", "exp(-x'^2)", "abs(x)*x", "sign(y)*x^2",
]  # fmt: skip


def chain(n):
    """A chain of n links that hangs: M is full, and depends on all angles."""
    speeds = [
        " + ".join(f"{f}(a{k})*a{k}'" for k in range(1, i + 1))
        for i in range(1, n + 1)
        for f in ("cos", "sin")
    ]
    kinetic = " + ".join(f"({speed})^2/2" for speed in speeds)
    potential = " + ".join(f"{n + 1 - k}*cos(a{k})" for k in range(1, n + 1))
    names = [f"a{k}" for k in range(1, n + 1)]
    start = ", ".join(f"{name}: {(-1) ** k * 0.3 + 0.02 * k}" for k, name in enumerate(names))
    return (
        f"{{coordinates: [{', '.join(names)}], L: {kinetic} + {potential}, initial: {{{start}}}}}"
    )


def motions(text):
    equations = EquationsOfMotion(problem_of(text))
    nodes = [*(entry for row in equations.mass for entry in row), *equations.forcing]
    return [
        Motion(equations, constants_of(equations, nodes, numbers), numbers)
        for numbers in (Doubles(), Balls())
    ]


@pytest.mark.long
@pytest.mark.parametrize("force", [*FORCES, chain(6)])
def test_the_recurrences_give_the_series_that_flint_gives(force):
    from flint import ctx

    usual, ctx.prec = ctx.prec, 160
    try:
        plain, balls = motions(
            force
            if "coordinates" in force
            else f"coordinates: [x, y]\nL: x'^2/2 + y'^2/2\n"
            f'forces:\n  x: "{force}"\n  y: cos(x) - y^3\n'
        )
        q, v = (given * (plain.n // 2) for given in ([0.75, 1.25], [0.5, -0.375]))
        exact = Taylor(balls, None)._coefficients(
            0.0, *([balls.arithmetic.ball(x) for x in s] for s in (q, v)), 30
        )
        kinds = [(DOUBLE, plain)]
        if engine().extended and not plain.kinks:
            kinds.append((EXTENDED, balls))
        if engine().quadruple and not plain.kinks:
            kinds.append((QUADRUPLE, balls))
        for numbers, motion in kinds:
            method = CompiledTaylor(Machine(motion, numbers), None)
            if motion.kinks:
                motion.set_signs(0.0, q, v)
            for i, sign in enumerate(motion.signs):
                method._signs[i] = sign
            state = method._prepare(q, v, 1.0, Tolerance(1e-16, plain.n, 1.0, 1.0))
            assert method._expand(state) == layout.MORE
            unit = float(method._rows[2 * plain.n * layout.STRIDE + 1])
            assert math.frexp(unit)[0] == 0.5
            for j, coefficients in enumerate(exact):
                found = method._rows[j * layout.STRIDE : j * layout.STRIDE + method.order + 1]
                for k in range(method.order + 1):
                    true = float(coefficients[k]) * unit**k
                    # sums of terms that cancel: relative to the growth of the whole series
                    size = max(abs(float(c[k])) for c in exact)
                    bound = 4e4 * numbers.rounding * max(abs(true), max(size, 1e-3) * unit**k)
                    if numbers is not DOUBLE:
                        bound = max(bound, 2e-16 * abs(true))  # read as a double
                    assert abs(float(found[k]) - true) <= bound, (j, k)
    finally:
        ctx.prec = usual


@pytest.mark.parametrize("force", ["1/(x^2 + y^2)^1.5*x", "sin(x)*exp(-y)", "atan(x/y) + y/x"])
def test_small_terms_from_doubles_are_as_good_as_80_bits(force):
    """Each term of a step against FLINT's, in units of the rounding of 80 bits."""
    from flint import ctx

    if not engine().extended:
        pytest.skip("no numbers of 80 bits")
    usual, ctx.prec = ctx.prec, 160
    try:
        plain, balls = motions(
            f"coordinates: [x, y]\nL: x'^2/2 + y'^2/2\nforces:\n  x: {force}\n  y: cos(x) - y^3\n"
        )
        method = CompiledTaylor(Machine(balls, EXTENDED, Machine(plain, DOUBLE)), None)
        q, v = [0.75, 1.25], [0.5, -0.375]
        exact = Taylor(balls, None)._coefficients(
            0.0, *([balls.arithmetic.ball(x) for x in s] for s in (q, v)), 30
        )
        state = method._prepare(q, v, 1.0, Tolerance(1e-18, 2, 1.0, 1.0))
        for _ in range(2):  # the first time all is exact
            assert method._expand(state) == layout.MORE
        assert 2 < method._counts[layout.EXACT] < method.order
        unit, h = (float(x) for x in (method._rows[4 * layout.STRIDE + 1], method._facts[layout.H]))
        found = EXTENDED.parts(method._rows, len(method._rows))
        for j, coefficients in enumerate(exact):
            terms = [float(c) * h**k for k, c in enumerate(coefficients[: method.order + 1])]
            for k, c in enumerate(coefficients[: method.order + 1]):
                term = balls.arithmetic.ball(found[j * layout.STRIDE + k]) / unit**k
                error = abs(float(term - c)) * h**k
                assert error <= 16 * EXTENDED.rounding * max(map(abs, terms)), (j, k)
    finally:
        ctx.prec = usual


@pytest.mark.long
def test_a_long_chain_is_compiled_as_a_matrix():
    """The first coefficient against the elimination with numbers; then the energy."""
    text = chain(26)
    motion, _ = motions(text)
    method = CompiledTaylor(Machine(motion, DOUBLE), None)
    q, v = [0.1 * k for k in range(26)], [0.3 - 0.05 * k for k in range(26)]
    state = method._prepare(q, v, 1.0, Tolerance(1e-12, 26, 1.0, 1.0))
    assert method._expand(state) == layout.MORE
    unit = method._rows[52 * layout.STRIDE + 1]
    found = [method._rows[(26 + j) * layout.STRIDE + 1] / unit for j in range(26)]
    assert found == pytest.approx(motion.accelerations(0.0, *q, *v), rel=1e-11, abs=1e-11)
    result = simulated(text, 0.5, 1e-9)
    assert result.method == "taylor64"
    assert result.certificate.charges["energy"] <= 1e-12


@pytest.mark.parametrize("pivot", [2.0, 1e-12, 0.0])
def test_the_factorization_solves_or_tells_that_a_pivot_vanishes(pivot):
    """M = L D L^T by hand: rows of L (1), (1/2, 1), (1/4, 1, 1), and D = (4, 1, pivot)."""
    import ctypes

    from lagcli.numerics.compiled.machine import _sums, pointer

    sums = _sums(DOUBLE)
    pointers = [ctypes.c_void_p] * 3
    factor = sums.function("factor", ctypes.c_int64, *pointers[:2], ctypes.c_int64)
    solve = sums.function("solve", None, *pointers, ctypes.c_int64)
    matrix = DOUBLE.array([4, 0, 0, 2, 2, 0, 1, 1.5, 1.25 + pivot])
    first, x = (ctypes.c_int64 * 3)(), DOUBLE.array([11, 10.5, 7.75 + 3 * pivot])
    fine = factor(pointer(matrix), pointer(first), 3)
    assert fine == (pivot > 1e-10)
    if fine:
        solve(pointer(matrix), pointer(first), pointer(x), 3)
        assert list(x) == pytest.approx([1, 2, 3], rel=1e-15)


def test_thirty_masses_on_springs_in_their_slowest_mode():
    """x_j = sin(j a) cos(w t) with a = pi/31, w = 2 sin(a/2); Goldstein, Classical Mechanics,
    3rd ed., section 13.1 (the discrete chain)."""
    n, a = 30, math.pi / 31
    names = [f"x{j}" for j in range(1, n + 1)]
    ends = ["0", *names, "0"]
    kinetic = " + ".join(f"{name}'^2/2" for name in names)
    springs = " - ".join(f"({y} - {x})^2/2" for x, y in pairwise(ends))
    start = ", ".join(f"{name}: sin({j}*pi/31)" for j, name in enumerate(names, 1))
    text = f"{{coordinates: [{', '.join(names)}], L: {kinetic} - {springs}, initial: {{{start}}}}}"
    result = simulated(text, 50, 1e-10)
    assert result.method == "taylor64"
    for j, name in enumerate(names, 1):
        true = math.sin(j * a) * math.cos(2 * math.sin(a / 2) * 50)
        assert last(result, name) == pytest.approx(true, abs=1e-10)


@pytest.mark.parametrize(
    "value", [0.0, 1.0, -1.5, 1e-300, Fraction(1, 10), Fraction(-981, 100), 3e200]
)
def test_numbers_of_80_bits_are_rounded_once(value):
    [(fraction, power)] = EXTENDED.parts(EXTENDED.array([value]), 1)
    back = fraction * Fraction(2) ** power
    assert abs(back - Fraction(value)) <= abs(Fraction(value)) * Fraction(2) ** -64
    if isinstance(value, float):
        assert back == Fraction(value)


def test_the_language_means_what_python_means():
    import ctypes

    source = """
def f(a: Reals, n: int) -> float:
    total = 0.0
    for i in range(n):
        if a[i] > 0 and not i == 1:
            total += a[i] * i
        elif i == 3:
            break
        else:
            total -= 1
    for i in range(n - 1, -1, -1):
        a[i] = max(a[i], total, 0.5)
    k = 0
    while k < 3:
        k += 1
    return fma(total, 2.0, a[0] / 9) / (7 // 2) - 4 * total / k + a[0] * (7 - 7 // k)
"""
    code = engine().compiled(source.encode(), lambda: translated(source, DOUBLE, {}))
    compiled = code.function("f", ctypes.c_double, ctypes.c_void_p, ctypes.c_int64)
    values = [3.0, 2.0, 5.0, -1.0, 7.0]
    array = DOUBLE.array(values)
    found = compiled(ctypes.addressof(array), 5)

    # by hand: i=0: +0; i=1: -1; i=2: +10; i=3: stop; then 19/3 - 12 + 9*5
    assert found == pytest.approx(19 / 3 + 33, rel=1e-15)
    assert list(array) == [9.0] * 5


KEPLER = """
coordinates: [x, y]
L: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)
initial: {x: 1/10, y: 0, x': 0, y': sqrt(19)}
"""


@pytest.mark.long
@pytest.mark.parametrize("accuracy", [1e-3, 1e-6, 1e-9, 1e-12])
def test_kepler_returns_after_100_periods(accuracy):
    """e = 0.9: at 200 pi the state is the initial one, with r'' = -100 and y' = sqrt(19)."""
    from flint import arb, ctx

    until, usual = 200 * math.pi, ctx.prec
    ctx.prec = 128
    late = float(arb(until) - 200 * arb.pi())
    ctx.prec = usual
    result = simulated(KEPLER, until, accuracy)
    assert result.certificate.reached
    # at 1e-9 one rounding of the initial velocity is already a third of what is allowed
    usual = {1e-9: ("taylor64", "taylor80"), 1e-12: ("taylor80", "taylor128")}
    assert result.method in usual.get(accuracy, ("taylor64",))
    speed = math.sqrt(19)
    for name, true in (("x", 0.1), ("y", late * speed), ("x'", -100 * late), ("y'", speed)):
        scale = max(1.0, *map(abs, column(result, name)))
        assert abs(last(result, name) - true) <= accuracy * scale
    assert result.certificate.charges["energy"] <= max(1e-12, 1e-6 * accuracy)


@pytest.mark.long
def test_charges_over_many_periods():
    """1e6 periods are to cost 1e-12 at most: 2000 cost a five hundredth of it."""
    if not engine().extended:
        pytest.skip("no numbers of 80 bits")
    text = KEPLER + "symmetries: {rotation: {x: -y, y: x}}\n"
    held = simulated(text, 4000 * math.pi, 1e-8, method="taylor80").certificate
    assert held.reached
    assert held.charges["energy"] <= 2e-15
    assert held.charges["rotation"] <= 2e-15


def test_over_many_steps_auto_takes_more_bits_than_doubles(monkeypatch):
    if not engine().extended:
        pytest.skip("no numbers of 80 bits")
    monkeypatch.setattr(machine_code, "LONG", 400)
    result = simulated(KEPLER, 20 * math.pi, 1e-3)
    assert result.certificate.reached
    assert result.method == "taylor80"
    assert "steps the rounding of doubles adds up" in result.reason
    assert simulated(KEPLER, 2 * math.pi, 1e-3).method == "taylor64"


SPRING = """
coordinates: [r, a]
parameters: {k: {value: 10^8}}
L: (r'^2 + r^2*a'^2)/2 + 9.81*r*cos(a) - k/2*(r - 1)^2
initial: {r: 1, a: 1}
"""
TWICE = """
coordinates: [x, y]
L: (x'^2 + y'^2)/2 - y
constraints: {first: x^2 + y^2 = 1, again: 2*x^2 + 2*y^2 = 2}
initial: {x: 1, y: 0}
"""


@pytest.mark.long
def test_a_stiff_spring_against_many_digits():
    true = simulated(SPRING, 0.25, 1e-14, digits=30, method="taylor")
    for accuracy in (1e-6, 1e-12):
        found = simulated(SPRING, 0.25, accuracy)
        assert found.certificate.reached
        assert found.rows[-1] == pytest.approx(true.rows[-1], rel=accuracy, abs=accuracy)


@pytest.mark.parametrize("power", [-60, -30, 30, 60])
@pytest.mark.parametrize("accuracy", [1e-9, 1e-12])
def test_the_unit_of_time_does_not_matter(power, accuracy):
    """x'' = -w^2 x with w = 10^30 and the like: the terms w^k of the series are no doubles."""
    until = 20 * 10.0**-power
    text = f"{{coordinates: [x], L: x'^2/2 - 10^({2 * power})*x^2/2, initial: {{x: 1, x': 0}}}}"
    for method in ("taylor64", "taylor80"):
        result = simulated(text, until, accuracy, method=method)
        assert result.certificate.reached
        assert last(result, "x") == pytest.approx(math.cos(until * 10.0**power), abs=accuracy)


def test_a_constraint_that_the_others_imply_is_left_to_them():
    result = simulated(TWICE, 5, 1e-8)
    once = simulated(TWICE.replace(", again: 2*x^2 + 2*y^2 = 2", ""), 5, 1e-8)
    assert result.certificate.reached
    assert result.method == "taylor64"
    assert result.rows[-1] == pytest.approx(once.rows[-1], abs=2e-8)
    assert result.certificate.constraints.keys() == {"first", "again"}
    assert all(max(found) <= 1e-12 for found in result.certificate.constraints.values())


def test_a_constraint_that_the_others_imply_at_first_only_is_not_left_out():
    """A circle and its tangent: the point cannot move."""
    again = "2*x^2 + 2*y^2 = 2"
    result = simulated(TWICE.replace(again, "x = 1"), 5, 1e-8)
    assert "not taylor64: a constraint that the others imply at first" in result.reason
    assert not result.certificate.reached
    assert [row[1:3] for row in result.rows] == [(1, 0)]


@pytest.mark.parametrize("method", ["taylor64", "taylor80", "dop853"])
def test_the_methods_agree(method):
    text = "{coordinates: [x], L: x'^2/2 + cos(x), initial: {x: 1.5}}"
    true = simulated(text, 20, 1e-13, samples=5, digits=30, method="taylor")
    found = simulated(text, 20, 1e-11, samples=5, method=method)
    assert found.method == method
    for row, other in zip(found.rows, true.rows, strict=True):
        assert row == pytest.approx(other, abs=1e-11)


def test_without_llvmlite_it_runs_in_python(monkeypatch):
    from lagcli.numerics.compiled import machine

    def missing():
        raise NoCompiler("llvmlite is not installed")

    monkeypatch.setattr(machine, "engine", missing)
    result = simulated("{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}", 1, 1e-6)
    assert result.method == "dop853"
    assert result.reason.endswith("; not taylor64: llvmlite is not installed")


@pytest.mark.parametrize(
    "text", [KEPLER, chain(4), TWICE.replace(", again: 2*x^2 + 2*y^2 = 2", "")]
)
def test_better_code_gives_the_same_numbers(monkeypatch, text):
    """From the beginning, after some steps, and never."""
    from lagcli.numerics.compiled import machine
    from lagcli.numerics.hybrid import compiled_taylor

    found = []
    monkeypatch.setattr(compiled_taylor, "_FIRST", 3)
    for limit in (0.0, 3e4, math.inf):
        monkeypatch.setattr(machine, "LONG_RUN", limit)
        monkeypatch.setattr(machine, "_IMPROVED", set())
        found.append(simulated(text, 5, 1e-9).rows)
    assert found[0] == found[1] == found[2]


def test_better_code_is_made_for_a_long_run(monkeypatch):
    from lagcli.numerics.compiled import machine

    monkeypatch.setattr(machine, "_IMPROVED", set())
    motion, _ = motions(KEPLER)
    made = Machine(motion, DOUBLE)
    assert made.is_quick
    made.improve(100, 20)
    assert made.is_quick
    made.improve(10**6, 20)
    assert not made.is_quick
    assert not Machine(motion, DOUBLE).is_quick


def test_better_code_is_made_for_many_runs(monkeypatch):
    from lagcli.numerics.compiled import machine

    monkeypatch.setattr(machine, "_IMPROVED", set())
    motion, _ = motions(KEPLER)
    made = Machine(motion, DOUBLE)
    made.spent = made.work(10**6, 20)
    made.improve(1, 20)
    assert not made.is_quick


def test_a_run_takes_up_where_a_call_of_the_loop_ends(monkeypatch):
    from lagcli.numerics.hybrid import compiled_taylor

    whole = simulated(KEPLER, 10, 1e-9, samples=11)
    monkeypatch.setattr(compiled_taylor, "_CALL", 7)
    assert simulated(KEPLER, 10, 1e-9, samples=11).rows == whole.rows


@pytest.mark.long
def test_a_long_run_is_not_cut_short():
    """The steps of a run in Python end at 200,000; these are 5,000 periods of Kepler at e = 0.9."""
    result = simulated(KEPLER, 10_000 * math.pi, 1e-6)
    assert result.certificate.reached
    assert result.steps > 200_000
    assert result.certificate.charges["energy"] < 1e-11
