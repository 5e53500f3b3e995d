"""Many coordinates under many constraints: one matrix of both, factored in a loop."""

import math
from fractions import Fraction

import mpmath
import pytest

from lagcli.numerics.compiled import layout
from lagcli.numerics.compiled.machine import Machine
from lagcli.numerics.compiled.numbers import DOUBLE
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.null_space import held_motion
from lagcli.numerics.equations.regular import regular_motion
from lagcli.numerics.hybrid.compiled_taylor import CompiledTaylor
from lagcli.numerics.integrators.steps import Tolerance

from .running import column, last, problem_of, simulated

#: The rings of the initial points: how many, the first number, the longitude's offset, the
#: latitude as parts of pi.
RINGS = [
    (3, 1, "1/13", "3/8"),
    (7, 1, "1/29", "1/8"),
    (6, 1, "1/7", "-2/15"),
    (4, 0, "1/17", "-3/10"),
]


def fekete():
    """Points on a sphere that repel each other, damped (IVP test set, release 2.4, II-5)."""
    points = range(1, 21)
    start, k = [], 0
    for count, first, offset, latitude in RINGS:
        for i in range(first, first + count):
            k += 1
            a, b = f"2*pi*{i}/{count} + pi*({offset})", f"pi*({latitude})"
            start.append(f"x{k}: cos({a})*cos({b}), y{k}: sin({a})*cos({b}), z{k}: sin({b})")
    names = [f"{x}{i}" for i in points for x in "xyz"]
    distances = [
        f"log((x{i} - x{j})^2 + (y{i} - y{j})^2 + (z{i} - z{j})^2)/2"
        for i in points
        for j in points[i:]
    ]
    return f"""
coordinates: [{", ".join(names)}]
T: ({" + ".join(f"{name}'^2" for name in names)})/2
V: -({" + ".join(distances)})
dissipation: ({" + ".join(f"{name}'^2" for name in names)})/4
constraints: {{{", ".join(f"s{i}: x{i}^2 + y{i}^2 + z{i}^2 = 1" for i in points)}}}
initial: {{{", ".join(start)}}}
"""


@pytest.mark.long
def test_the_fekete_points_are_those_of_the_test_set():
    """Its reference solution at t = 1000, from RADAU5 at 1e-12; the multipliers are -19/4."""
    show = "x1,y1,z1,x11,y11,z11,x20,y20,z20,lambda_s1,lambda_s20"
    result = simulated(fekete(), 1000, 1e-9, show)
    assert result.certificate.reached
    assert result.method == "taylor64"
    known = [-0.4070263380333202, 0.3463758772791802, 0.8451942450030429]
    known += [0.1464175087914331, 0.9380871635228875, -0.3139337298744656]
    known += [0.2414481766969039, -0.3416456818373135, -0.9082846503446250, -4.75, -4.75]
    assert result.rows[-1][1:] == pytest.approx(known, abs=1e-11)
    assert max(max(pair) for pair in result.certificate.constraints.values()) <= 1e-12


def closed_chain(n):
    """Links in the plane between two points 6 n/10 apart, by their angles from the vertical."""
    angles = [f"a{i}" for i in range(n)]
    alpha = math.asin(0.6)
    speeds = [
        (" + ".join(f"cos({a})*{a}'" for a in angles[: k + 1]), angles[: k + 1]) for k in range(n)
    ]
    kinetic = " + ".join(
        f"(({x})^2 + ({' + '.join(f'sin({a})*{a}' + chr(39) for a in named)})^2)/2"
        for x, named in speeds
    )
    height = " + ".join(f"{n - k}*cos(a{k})" for k in range(n))
    start = ", ".join(f"a{k}: {alpha if k < n // 2 else math.pi - alpha!r}" for k in range(n))
    return f"""
coordinates: [{", ".join(angles)}]
T: {kinetic}
V: -981/100*({height})
constraints:
  across: {" + ".join(f"sin({a})" for a in angles)} = {6 * n}/10
  up: {" + ".join(f"cos({a})" for a in angles)} = 0
initial: {{{start}, a0': 1, a1': -1}}
"""


@pytest.mark.long
def test_the_loop_gives_the_accelerations_that_the_null_space_gives():
    n = 26
    equations = EquationsOfMotion(problem_of(closed_chain(n)))
    assert equations.eliminated is None
    nodes = [*equations.forcing, *(entry for row in equations.mass for entry in row)]
    motion = Motion(equations, constants_of(equations, nodes, Doubles()), Doubles())
    q, v = [0.1 * k for k in range(n)], [0.3 - 0.05 * k for k in range(n)]
    values = motion.matrices(0.0, *q, *v)
    mass = [values[i * n : (i + 1) * n] for i in range(n)]
    forcing, rest = values[n * n : n * n + n], values[n * n + n :]
    rows, bias = [rest[:n], rest[n : 2 * n]], rest[2 * n :]
    known = held_motion(mass, list(forcing), rows, list(bias))
    assert motion.accelerations(0.0, *q, *v) == pytest.approx(known.accelerations, rel=1e-9)
    assert motion.held(0.0, *q, *v).multipliers == pytest.approx(known.multipliers, rel=1e-9)
    method = CompiledTaylor(Machine(motion, DOUBLE), None)
    state = method._prepare(q, v, 1.0, Tolerance(1e-12, n, 1.0, 1.0))
    assert method._expand(state) == layout.MORE
    unit = method._rows[2 * n * layout.STRIDE + 1]
    found = [method._rows[(n + j) * layout.STRIDE + 1] / unit for j in range(n)]
    assert found == pytest.approx(known.accelerations, rel=1e-9)


@pytest.mark.long
@pytest.mark.parametrize("n", [6, 26])
def test_a_closed_chain_keeps_its_energy_and_its_ends(n):
    result = simulated(closed_chain(n), 1, 1e-9, "a0,energy", samples=5)
    assert result.certificate.reached
    assert result.method == "taylor64"
    energy = column(result, "energy")
    assert energy == pytest.approx([energy[0]] * 5, rel=1e-12)
    assert max(max(pair) for pair in result.certificate.constraints.values()) <= 1e-12


@pytest.mark.long
def test_numbers_of_80_bits_go_through_the_same_loop():
    text = closed_chain(6)
    more = simulated(text, 1, 5e-14, "a0,a3")
    assert (more.method, more.certificate.reached) == ("taylor80", True)
    assert last(simulated(text, 1, 1e-10, "a0,a3"), "a0") == pytest.approx(
        last(more, "a0"), abs=1e-10
    )


def test_a_matrix_of_numbers_is_solved_as_lu_solves_it():
    n, m = 5, 2
    mass = [[1 / (1 + i + j) + 2 * (i == j) for j in range(n)] for i in range(n)]
    rows = [[math.sin(1 + i + 3 * j) for j in range(n)] for i in range(m)]
    forcing, bias = [math.cos(j) for j in range(n)], [0.5, -2.0]
    columns = [list(column) for column in zip(*rows, strict=True)]
    whole = [[*row, *column] for row, column in zip(mass, columns, strict=True)]
    whole += [[*row, *[0.0] * m] for row in rows]
    known = mpmath.lu_solve(mpmath.matrix(whole), mpmath.matrix([*forcing, *(-c for c in bias)]))
    found = regular_motion(mass, forcing, rows, bias)
    assert found is not None
    assert found[0] == pytest.approx([float(x) for x in known[:n]], rel=1e-12)
    assert found[1] == pytest.approx([-float(x) for x in known[n:]], rel=1e-12)


@pytest.mark.parametrize("weights", [(1, 0), (Fraction(1, 3), Fraction(2, 7))])
def test_a_row_that_follows_from_others_has_no_such_answer(weights):
    one, two = [1.0, 0.0, 2.0], [0.0, 1.0, 1.0]
    third = [
        float(weights[0] * Fraction(a) + weights[1] * Fraction(b))
        for a, b in zip(one, two, strict=True)
    ]
    mass = [[2.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 3.0]]
    assert regular_motion(mass, [1.0, 2.0, 3.0], [one, two, third], [0.0, 0.0, 0.0]) is None


@pytest.mark.long
def test_three_parallel_rods_of_which_one_is_redundant_on_the_motion_only():
    """The platform does not turn: it moves as one pendulum; its angle is nothing but rounding."""
    platform = """
coordinates: [x, y, th]
T: (x'^2+y'^2)/2 + th'^2/24
V: "9.81*y"
constraints:
  a: (x - cos(th)/2)^2 + (y - sin(th)/2)^2 = 1
  b: (x + cos(th)/2 - 1)^2 + (y + sin(th)/2)^2 = 1
  c: (x - 0.5)^2 + y^2 = 1
initial: {x: 1.1, y: -0.8, th: 0, x': 0, y': 0, th': 0}
"""
    pendulum = """
coordinates: [u]
T: u'^2/2
V: "-9.81*cos(u)"
initial: {u: atan(3/4), u': 0}
"""
    found, plane = simulated(platform, 3, 1e-9), simulated(pendulum, 3, 1e-12)
    assert found.certificate.reached
    assert last(found, "x") == pytest.approx(0.5 + math.sin(last(plane, "u")), abs=2e-9)
