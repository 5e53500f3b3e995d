"""Published multibody benchmarks: they derive, run with a certificate, and meet what is known."""

from pathlib import Path

import pytest

from lagcli import load
from lagcli.evaluation import value_of
from lagcli.expression import operation_count
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.studies.check.trajectory import TrajectoryCheck
from tests.solved import solve

from .running import last, simulated

FOLDER = Path(__file__).parents[1] / "benchmarks"
FILES = sorted(path.stem for path in FOLDER.glob("*.yaml"))


def test_the_folder_is_there():
    assert FILES == [
        "andrews-squeezer", "bricard", "car-axis", "flyball-governor", "n-four-bar",
    ]  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("name", FILES)
def test_the_matrix_form_is_written(name):
    problem = load(FOLDER / f"{name}.yaml")
    section = solve(problem, ["matrix_form"]).sections["matrix_form"]
    assert len(section.mass_matrix) == len(section.forcing) == len(problem.coordinates)
    assert len(section.constraint_jacobian) == len(problem.constraints)
    freedom = {"flyball-governor": 4, "car-axis": 2}.get(name, 1)
    assert MatrixForm(problem).degrees_of_freedom == freedom


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name in FILES if name != "bricard"])
def test_the_known_motion_is_met(name):
    findings = list(TrajectoryCheck(load(FOLDER / f"{name}.yaml")))
    assert findings
    assert [found for found in findings if found is not None] == []


@pytest.mark.long
def test_the_row_of_four_bars_is_the_pendulum_that_its_cranks_are():
    """T = 3 psi'^2/2, V = 7 g sin(psi)/2; flat at t = 0.49, where loops could fold."""
    minimal = "{coordinates: [psi], parameters: {g: 9.81}, L: 3*psi'^2/2 - 7*g*sin(psi)/2, "
    minimal += "initial: {psi: pi/2, psi': -1}}"
    known = simulated(minimal, 0.9, 1e-11, "cos(psi),sin(psi)", samples=4)
    text = (FOLDER / "n-four-bar.yaml").read_text("utf-8")
    result = simulated(text, 0.9, 1e-9, "x0,y0", samples=4)
    assert result.certificate.reached
    for row, other in zip(result.rows, known.rows, strict=True):
        assert row == pytest.approx(other, abs=1e-9)


def test_andrews_angles_are_those_of_the_test_set_to_ten_digits():
    problem = load(FOLDER / "andrews-squeezer.yaml")
    row = problem.expect.trajectory.rows[-1]
    known = {each.name: value_of(each.value) for each in row.values}
    result = simulated((FOLDER / "andrews-squeezer.yaml").read_text("utf-8"), 0.03, 1e-11)
    assert result.certificate.reached
    for name in ("beta", "theta", "gamma", "phi", "delta", "omega", "epsilon"):
        assert last(result, name) == pytest.approx(known[name], rel=1e-10, abs=1e-10)


@pytest.mark.long
def test_the_force_of_a_spring_between_moving_points_is_read_as_one_force():
    """(r - L0)(xr - xb)/r with the end (xb, yb) of the spring on a circle."""
    problem = load(FOLDER / "car-axis.yaml")
    equations = solve(problem, ["equations"]).sections["equations"].equations
    assert [operation_count(each.left) < 60 for each in equations] == [True] * 4


def test_bricard_moves_along_its_known_relation_in_spite_of_redundant_constraints():
    """cos a + cos b + cos a cos b = 0 for hinges across each other (Chen, You, Tarnai 2005)."""
    show = "q0,q2,q4,q1,q3,cos(q0)+cos(q1)+cos(q0)*cos(q1),energy"
    text = (FOLDER / "bricard.yaml").read_text("utf-8")
    result = simulated(text, 1.0, 1e-6, show, samples=5)
    assert result.certificate.reached
    assert max(held for held, _ in result.certificate.constraints.values()) < 1e-12
    for _, a, c, e, b, d, relation, energy in result.rows:
        assert (c, e, d) == pytest.approx((a, a, b), abs=1e-6)
        assert relation == pytest.approx(0, abs=1e-9)
        assert energy == pytest.approx(-3 * 9.81, rel=1e-9)
    assert abs(result.rows[-1][1] - result.rows[0][1]) > 0.5
