"""The picture of a sweep: every certified row is where its values say, nothing else is drawn."""

from __future__ import annotations

import math

import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.pictures.drawing import CannotDraw, Cells, Curve, Marks
from lagcli.pictures.ensemble import Motions, ensemble
from lagcli.reader.columns import Column
from lagcli.reader.expressions import parse_text

BEGINNING = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF"}


@pytest.fixture(scope="module")
def pendulum():
    return lagcli.load("plane-pendulum")


def column(name):
    return Column(name, None if name == "t" else parse_text(name))


def motions(varied, rows, right=None, *, is_grid=True, along=False, shown=("t", "theta")):
    return Motions(
        varied=varied, is_grid=is_grid, columns=[column(name) for name in shown], rows=rows,
        are_right=right or [True] * len(rows), along=along,
    )  # fmt: skip


def test_one_quantity_is_a_curve_that_breaks_where_the_accuracy_is_not_reached(pendulum):
    rows = [[x, 1.0, x * x] for x in (1.0, 2.0, 3.0, 4.0)]
    picture = ensemble(pendulum, motions(["l"], rows, [True, True, False, True]))
    [panel] = picture.panels
    [curve] = panel.items
    assert isinstance(curve, Curve)
    assert curve.pieces == (((1.0, 1.0), (2.0, 4.0)), ((4.0, 16.0),))
    assert picture.notes == ("At t = 1 s.", "1 of 4 rows do not reach the accuracy")
    assert panel.x.label.plain == "l (m)"


def test_two_quantities_are_a_map_whose_axes_are_the_initial_values(pendulum):
    xs, ys = (0.5, 1.0, 2.0), (-1.0, 0.0, 3.0)
    rows = [[x, y, 1.0, 10 * x + y] for x in xs for y in ys]
    [panel] = ensemble(pendulum, motions(["theta", "theta'"], rows)).panels
    [cells] = panel.items
    assert isinstance(cells, Cells)
    assert cells.x == (0.25, 0.75, 1.5, 2.5)
    assert (panel.x.low, panel.x.high) == (0.25, 2.5)
    assert cells.y == (-1.5, -0.5, 1.5, 4.5)
    assert cells.values == tuple(tuple(10 * x + y for x in xs) for y in ys)
    assert panel.x.label.plain == "θ(0) (rad)"
    assert panel.y.label.plain == "θ̇(0) (rad/s)"


@pytest.mark.parametrize("along", [True, False])
def test_random_draws_and_whole_motions_are_dots(pendulum, along):
    rows = [[0.5, 0.0, 1.0], [0.5, 1.0, 2.0]]
    found = ensemble(pendulum, motions(["theta"], rows, is_grid=along, along=along))
    [marks] = found.panels[0].items
    assert isinstance(marks, Marks)
    assert marks.points == ((0.5, 1.0), (0.5, 2.0))
    assert found.notes == ()  # each at its own time


def test_equal_ratios_have_a_logarithmic_axis(pendulum):
    rows = [[10.0**k, 1.0, k] for k in range(-2, 3)]
    [panel] = ensemble(pendulum, motions(["l"], rows)).panels
    assert panel.x.logarithmic
    rows = [[10.0**k, y, 1.0, k] for k in range(-2, 3) for y in (1.0, 2.0)]
    [panel] = ensemble(pendulum, motions(["l", "theta"], rows)).panels
    assert panel.items[0].x == pytest.approx([10.0 ** (k - 0.5) for k in range(-2, 4)])


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (motions(["m", "l", "theta"], [[1.0, 1.0, 1.0, 1.0, 1.0]]), "one or two quantities"),
        (motions(["l"], [[1.0, 1.0, 2.0]], [False]), "no row reaches the accuracy"),
        (motions(["l"], [[1.0, 1.0]], shown=("t",)), "one to 6 columns"),
    ],
)
def test_what_cannot_be_drawn_is_said(pendulum, given, said):
    with pytest.raises(CannotDraw, match=said):
        ensemble(pendulum, given)


@pytest.mark.long
@pytest.mark.parametrize("ending", BEGINNING)
def test_the_ending_of_the_output_draws(tmp_path, ending):
    path = tmp_path / f"map{ending}"
    grid = ("--vary", "theta=-1:1:4", "--vary", "theta'=-1:1:3")
    arguments = ["sweep", "plane-pendulum", *grid, "--until", "1", "--show", "theta,sign(theta)"]
    assert run([*arguments, "-o", str(path)]) == 0
    first = path.read_bytes()
    assert first.startswith(BEGINNING[ending])
    assert run([*arguments, "-o", str(path)]) == 0
    assert path.read_bytes() == first


def test_a_picture_goes_to_a_file(capsys):
    assert run(["sweep", "plane-pendulum", "--vary", "theta=1,2", "-f", "svg"]) == 2
    assert "-o sweep.svg" in capsys.readouterr().err


def test_the_basins_of_two_wells_are_exchanged_by_the_mirror():
    """V = x^4/4 - x^2/2 is even: the motion from (-x, -v) is the mirror image."""
    wells = lagcli.loads(
        "coordinates: [x]\nparameters: {c: 0.3}\nT: x'^2/2\nV: x^4/4 - x^2/2\ndissipation: c*x'^2/2\n"
    )
    grid = {"x": "-1.9:1.9:6", "x'": "-1.9:1.9:6"}
    table = lagcli.sweep(wells, grid, 25, accuracy=1e-6, show="sign(x)")
    ends = dict(zip(zip(table["x(0)"], table["x'(0)"], strict=True), table["sign(x)"], strict=True))
    assert len(ends) == 36
    assert {abs(end) for end in ends.values()} == {1.0}
    close = {(round(x, 9), round(v, 9)): end for (x, v), end in ends.items()}
    assert all(close[-x, -v] == -end for (x, v), end in close.items())
    assert math.isclose(sum(close.values()), 0)
