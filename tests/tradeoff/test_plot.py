"""The plot is XML, and says what the table says."""

import math
from decimal import Decimal
from xml.etree import ElementTree as ET

import pytest

from lagcli.pictures.drawing import CannotDraw, Curve, Marks
from lagcli.pictures.figure import to_bytes
from lagcli.pictures.ticks import ticks
from lagcli.record import replace
from lagcli.studies.tradeoff.front import RunPoint
from lagcli.studies.tradeoff.plot import picture_of
from lagcli.studies.tradeoff.reference import ReferenceMotion, difference
from lagcli.studies.tradeoff.study import Study
from lagcli.studies.tradeoff.writing import to_csv, to_json, to_text

SVG = "{http://www.w3.org/2000/svg}"
POINTS = tuple(
    RunPoint(method=name, taken=name, tolerance=t, error=e, total=c, integration=c / 10,
          evaluations=100)
    for name, t, e, c in (
        ("dop853", 1e-4, 1e-5, 0.1), ("dop853", 1e-8, 1e-9, 0.2), ("dop853", 1e-12, 1e-12, 0.4),
        ("taylor", 1e-8, 1e-9, 0.5), ("taylor", 1e-20, 1e-20, 0.9),
    )
)  # fmt: skip
LOST = RunPoint(method="taylor", tolerance=1e-24, why="takes more than 10 s")


def study_of(points=POINTS, name="a <b> & c.yaml", cost="total"):
    known = ReferenceMotion(rows=((Decimal(0),),), bound=1e-25, kind="made up", seconds=0.1)
    return Study(
        name=name, until=1.0, samples=1, reference=known, points=points, certified=(),
        unsuited={"taylor80": "made up"}, cost=cost,
    )  # fmt: skip


def parts(study):
    [panel] = picture_of(study).panels
    curves = [item for item in panel.items if isinstance(item, Curve)]
    dots, rings = (
        [item for item in panel.items if isinstance(item, Marks) and item.role == role]
        for role in ("stable", "start")
    )
    return panel, curves, dots, rings


@pytest.mark.parametrize("cost", ["total", "integration", "evaluations"])
def test_a_line_for_each_method_and_a_mark_for_each_run(cost):
    study = study_of(cost=cost)
    _, curves, dots, _ = parts(study)
    assert [len(curve.pieces[0]) for curve in curves] == [3, 2]
    assert sum(len(each.points) for each in dots) == len(POINTS)
    words = [curve.label.plain for curve in curves]
    assert words[0] == "dop853: order 8, explicit"
    assert words[1].startswith("taylor: any order")
    svg = to_bytes(picture_of(study), "svg")
    assert ET.fromstring(svg).tag == f"{SVG}svg"
    assert picture_of(study).title == "a <b> & c.yaml: what accuracy costs until t = 1"


def test_the_places_are_the_errors_and_costs():
    panel, [curve, _], _, _ = parts(study_of())
    assert curve.pieces == (((1e-5, 0.1), (1e-9, 0.2), (1e-12, 0.4)),)
    for axis in (panel.x, panel.y):
        assert axis.logarithmic
    assert panel.x.low < 1e-20 < 1e-5 < panel.x.high
    assert panel.y.low < 0.1 < 0.9 < panel.y.high


def test_an_axis_of_less_than_two_decades_has_1_2_and_5():
    panel, *_ = parts(study_of())
    assert [tick.label.plain for tick in ticks(panel.y)] == ["0.1", "0.2", "0.5", "1"]


def test_rings_are_the_front():
    study = study_of()
    *_, [rings] = parts(study)
    assert len(rings.points) == len(study.front) == 4
    starred = [line for line in to_text(study).splitlines() if line.startswith("* ")]
    assert len(starred) == 4 + 1  # and what the star means


def test_no_error_at_all_is_0():
    """Of a particle at rest."""
    rest = RunPoint(method="dop853", taken="dop853", tolerance=1e-4, error=0.0, total=0.1)
    study = study_of(points=(rest,))
    still = replace(study, reference=replace(study.reference, bound=0.0))
    assert "error at most 0, made" in to_text(still)
    [row] = [line for line in to_text(still).splitlines() if "dop853" in line]
    assert row.split()[:4] == ["*", "dop853", "1e-04", "0"]
    [curve] = parts(still)[1]
    assert curve.pieces == (((1e-200, 0.1),),)
    assert to_bytes(picture_of(still), "svg")


def test_one_run_alone_is_drawn():
    assert to_bytes(picture_of(study_of(points=POINTS[:1])), "svg")


def test_nothing_to_draw_is_an_error():
    with pytest.raises(CannotDraw, match="no run"):
        picture_of(study_of(points=(LOST,)))


def test_a_run_without_a_result_is_told_everywhere():
    study = study_of(points=(*POINTS, LOST))
    assert "taylor at 1e-24: takes more than 10 s" in to_text(study)
    assert '"why": "takes more than 10 s"' in to_json(study)
    assert to_csv(study).splitlines()[-1].endswith("takes more than 10 s")
    assert "taylor80 is not for this problem: made up" in to_text(study)


def test_text_has_at_most_80_columns():
    lost = replace(LOST, why="it takes more than 10 s, which " + "is more than it may take " * 4)
    study = study_of(points=(*POINTS, lost), name="a/long/path/" * 4 + "to/a/problem.yaml")
    study = replace(study, unsuited={"yoshida8": "it does not separate: " + "it needs M " * 12})
    assert max(map(len, to_text(study).splitlines())) <= 80


def test_the_difference_is_relative_to_the_peak():
    rows = decimals((0, 200, 0), (2, 100, 300))
    assert difference(rows, decimals((0, 200, 0), (2, 101, 300))) == pytest.approx(1 / 200)
    assert difference(rows, decimals((0, 200, "-0.3"), (2, 100, 300))) == pytest.approx(1e-3)
    assert difference(rows, rows[:1]) == math.inf


def test_a_velocity_counts_beside_its_coordinate_and_rounding_beside_its_kind():
    """|x|/t = 100 is more than x' = 2; y is nothing but rounding beside x."""
    rows = decimals((0, 200, 0, 2, 0), (2, 100, "1e-17", 1, 0))
    assert difference(rows, decimals((0, 200, 0, 2, 0), (2, 100, "1e-17", 2, 0))) == 1e-2
    assert difference(rows, decimals((0, 200, 0, 2, 0), (2, 100, "2e-15", 1, 0))) < 1e-16


def decimals(*rows):
    return tuple(tuple(map(Decimal, row)) for row in rows)
