"""The order of each method, and that the generated functions are the equations of motion."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest

from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.hybrid.run import Run
from lagcli.numerics.integrators.dop853 import Dop853
from lagcli.numerics.integrators.steps import Step, Stretch, Tolerance
from lagcli.numerics.integrators.tableau_853 import DENSE, ERROR_3, ERROR_5, NODES, STAGES
from lagcli.pipeline import with_lagrangian
from tests.oracle.reference import Reference
from tests.oracle.states import random_states
from tests.read import library

from .running import problem_of, simulated


def motion_of(text):
    equations = EquationsOfMotion(problem_of(text))
    nodes = [*(x for row in equations.mass for x in row), *equations.forcing]
    return Motion(equations, constants_of(equations, nodes, Doubles()), Doubles())


@pytest.mark.parametrize("stage", STAGES)
def test_the_rows_of_the_tableau_sum_to_the_nodes(stage):
    assert math.fsum(STAGES[stage].values()) == pytest.approx(NODES[stage], abs=1e-14)


@pytest.mark.parametrize("power", range(8))
def test_the_weights_integrate_polynomials_of_degree_7(power):
    total = math.fsum(b * NODES[k] ** power for k, b in STAGES[13].items())
    assert total == pytest.approx(1 / (power + 1), abs=1e-14)


def test_the_embedded_weights_are_differences():
    for row in (ERROR_5, ERROR_3, *DENSE):
        assert set(row) <= set(range(1, 17))
    assert math.fsum(ERROR_5.values()) == pytest.approx(0, abs=1e-14)


def test_dop853_has_order_8_and_its_dense_output_7():
    """Halving the step of x'' = -x, x(0) = 1 divides the error by 2^8, within the step by 2^8 (local)."""
    motion = motion_of("{coordinates: [x], L: x'^2/2 - x^4/4, initial: {x: 1}}")

    def errors(count):
        h = 2.0 / count
        tolerance = Tolerance(1e10, 1, 2.0, h)  # the longest step is always taken
        method, inside = Dop853(motion, None), []
        q = v = None
        fine = {}
        for step in method.steps(Stretch([1.0], [0.0], 2.0), tolerance):
            q, v = step.q, step.v
            inside.append((step.start + 0.3 * step.h, step.inside(step.start + 0.3 * step.h)[0][0]))
        return q[0], v[0], inside, fine

    exact = errors(256)
    first, second = errors(8), errors(16)
    ratio = abs(first[0] - exact[0]) / abs(second[0] - exact[0])
    assert 7.2 < math.log2(ratio) < 9.3


def test_taylor_takes_the_order_of_its_tolerance():
    from lagcli.numerics.integrators.taylor import order_for

    assert order_for(1e-16) == 20
    assert order_for(1e-30) == 36


#: Problems with nothing unspecified: the others have no numbers.
LIBRARY = [path for path, problem in library().items() if not problem.functions]


@pytest.mark.long
@pytest.mark.parametrize("path", LIBRARY, ids=lambda p: p.stem)
def test_accelerations_are_those_of_the_definitions(path):
    """Against jets and a numeric KKT system that share no code with the graph."""
    problem = with_lagrangian(problem_of(path.read_text("utf-8")))
    states = random_states(Reference(problem), 2)
    equations = EquationsOfMotion(with_lagrangian(problem))
    for state in states:
        if not state.regular:
            continue
        moment = state.moment
        constants = {
            equations.graph.symbol(name): float(value) for name, value in moment.extra.items()
        }
        motion = Motion(equations, constants, Doubles())
        t, q, v = float(moment.t), *([float(x) for x in row] for row in moment.chain[:2])
        motion.set_signs(t, q, v)
        expected = [float(a) for a in state.accelerations]
        assert list(motion.accelerations(t, *q, *v)) == pytest.approx(expected, rel=1e-8, abs=1e-8)
        found = motion.accelerations_and_multipliers(t, *q, *v)[motion.n :]
        for k, value in enumerate(found):
            if state.motion.determined(motion.n + k):
                assert value == pytest.approx(float(state.multipliers[k]), rel=1e-8, abs=1e-8)
            else:
                assert value is None


def test_numbers_are_exact_until_they_are_doubles():
    assert Doubles().number(Fraction(1, 3)) == 1 / 3


def test_a_probe_where_nothing_is_defined_is_a_defect():
    def inside(_):
        raise ValueError

    run = object.__new__(Run)
    run._probes = 0
    run._probe(Step(0.0, 1.0, 1.0, [0.0], [0.0], inside))
    assert run.defect == math.inf


def test_a_step_that_is_not_taken_leaves_nothing_in_the_scales():
    """A stiff spring on which the first step is a thousand times too long."""
    motion = motion_of("""{coordinates: [r, a], parameters: {k: 1e4, g: 9.81}, initial: {r: 1.01},
      T: (r'^2 + r^2*a'^2)/2, V: k*(r - 1)^2/2 - g*r*cos(a)}""")
    tolerance = Tolerance(1e-4, 2, 5.0, 0.5)
    steps = list(Dop853(motion, None).steps(Stretch([1.01, 0.5], [0.0, 0.0], 5.0), tolerance))
    assert steps[-1].end == 5.0
    assert tolerance.peaks == pytest.approx([1.01, 0.51, 1.0, 1.6], rel=0.2)


def _entries(rng, n):
    return np.array([[rng.choice((0, 1, 2, -3)) for _ in range(n)] for _ in range(n)])


@pytest.mark.parametrize("seed", range(8))
def test_kinetic_energies_with_no_square_of_a_rate_run_in_any_precision(seed):
    """T = q'^T M q'/2 with 0 on the diagonal of M, V = b q: q = v t - M^-1 b t^2/2."""
    rng = random.Random(seed)
    n = rng.choice((2, 4))
    matrix = np.zeros((n, n), dtype=int)
    while abs(np.linalg.det(matrix)) < 0.5:
        upper = np.triu(_entries(rng, n), 1)
        matrix = upper + upper.T
    forces, speeds = [rng.randint(-5, 5) for _ in range(n)], [rng.randint(-3, 3) for _ in range(n)]
    names = "abcd"[:n]
    kinetic = "+".join(
        f"({matrix[i, j]})*{names[i]}'*{names[j]}'" for i in range(n) for j in range(i)
    )
    potential = "+".join(f"({f})*{q}" for f, q in zip(forces, names, strict=True))
    start = ", ".join(f"{q}: 0, {q}': {v}" for q, v in zip(names, speeds, strict=True))
    text = (
        f"{{coordinates: [{', '.join(names)}], T: {kinetic}, V: {potential}, initial: {{{start}}}}}"
    )
    found = simulated(text, 2.0, accuracy=1e-15)
    expected = 2 * np.array(speeds) - 2 * np.linalg.solve(matrix, forces)
    assert found.certificate.reached
    np.testing.assert_allclose(found.rows[-1][1 : 1 + n], expected, rtol=1e-12, atol=1e-12)
