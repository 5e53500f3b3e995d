"""The plot is XML, and says what the table says."""

import math
from decimal import Decimal
from xml.etree import ElementTree as ET

import pytest

from lagcli.record import replace
from lagcli.studies.tradeoff.front import RunPoint
from lagcli.studies.tradeoff.plot import to_svg
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


@pytest.mark.parametrize("cost", ["total", "integration", "evaluations"])
def test_a_line_for_each_method_and_a_mark_for_each_run(cost):
    root = ET.fromstring(to_svg(study_of(cost=cost)))
    lines = {line.get("id"): line.get("points").split() for line in root.iter(f"{SVG}polyline")}
    assert {name: len(points) for name, points in lines.items()} == {"dop853": 3, "taylor": 2}
    marks = [c for c in root.iter(f"{SVG}circle") if c.get("fill") != "none"]
    assert len(marks) == len(POINTS)
    texts = list(root.iter(f"{SVG}text"))
    words = ["".join(text.itertext()) for text in texts if text.get("fill")]
    assert words.count("dop853") == 1
    # what is read is drawn after its halo, in renderers without paint-order too
    drawn = [text.get("stroke") for text in texts if text.text == "dop853"]
    assert drawn == ["white", None]
    assert "dop853: order 8, explicit" in words
    assert "a <b> & c.yaml: what accuracy costs" in words


def test_the_places_are_logarithms():
    root = ET.fromstring(to_svg(study_of()))
    [line] = [x for x in root.iter(f"{SVG}polyline") if x.get("id") == "dop853"]
    (x0, y0), (x1, y1), (x2, y2) = [map(float, p.split(",")) for p in line.get("points").split()]
    assert x0 < x1 < x2  # more exact to the right
    assert (x2 - x1) / (x1 - x0) == pytest.approx(3 / 4, rel=1e-2)
    assert y1 - y0 == pytest.approx(y2 - y1, rel=1e-2)  # each costs twice as much
    assert y2 < y1 < y0  # dearer is higher


def test_rings_are_the_front():
    study = study_of()
    root = ET.fromstring(to_svg(study))
    rings = [c for c in root.iter(f"{SVG}circle") if c.get("fill") == "none"]
    assert len(rings) == len(study.front) == 4
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
    ET.fromstring(to_svg(still))


def test_one_run_alone_is_drawn():
    ET.fromstring(to_svg(study_of(points=POINTS[:1])))


def test_nothing_to_draw_is_an_error():
    with pytest.raises(ValueError, match="no run"):
        to_svg(study_of(points=(LOST,)))


def test_a_run_without_a_result_is_told_everywhere():
    study = study_of(points=(*POINTS, LOST))
    assert "taylor at 1e-24: takes more than 10 s" in to_text(study)
    assert '"why": "takes more than 10 s"' in to_json(study)
    assert to_csv(study).splitlines()[-1].endswith("takes more than 10 s")
    assert "taylor80 is not for this problem: made up" in to_text(study)


def test_text_has_at_most_80_columns():
    assert max(map(len, to_text(study_of(points=(*POINTS, LOST))).splitlines())) <= 80


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
