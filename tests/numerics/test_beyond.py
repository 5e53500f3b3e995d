"""`--beyond`: rows that are not certified stand apart from those that are, in every format."""

import csv
import io
import json
import math
import random

import pytest

from lagcli.numerics.tables.columnar import to_npz
from lagcli.numerics.tables.writing import to_csv, to_json, to_table

from .running import simulated

FALLING = "{coordinates: [x], L: x'^2/2 + (%r)^2*x^2/2, initial: {x: 1, x': -(%r)}}"


@pytest.fixture(params=range(4), scope="module")
def lost(request):
    """x = exp(-k t) over a span at whose end doubles know nothing of it."""
    k = round(random.Random(request.param).uniform(0.3, 4), 3)
    asked = {"accuracy": 1e-9, "samples": 11, "show": "x", "method": "taylor64"}
    plain = simulated(FALLING % (k, k), 80 / k, **asked)
    return k, plain, simulated(FALLING % (k, k), 80 / k, **asked, beyond=True)


@pytest.mark.long
def test_the_certified_rows_are_those_without_it(lost):
    k, plain, result = lost
    assert plain.beyond is None
    assert (plain.rows, plain.certificate) == (result.rows, result.certificate)
    assert all(x == pytest.approx(math.exp(-k * t), abs=1e-9) for t, x in result.rows)


@pytest.mark.long
def test_the_rows_beyond_end_with_the_span(lost):
    k, _, result = lost
    times = [row[0] for row in result.beyond]
    step, until = 8 / k, result.certificate.holds_until
    expected = [step * i for i in range(11) if step * i > until]
    assert times == pytest.approx(expected)
    assert any(abs(x - math.exp(-k * t)) > 1e-9 for t, x in result.beyond)


@pytest.mark.first_quick
def test_json_has_a_list_of_its_own(lost):
    _, plain, result = lost
    found = json.loads(to_json(result))
    assert found["rows"] == [list(row) for row in result.rows]
    assert found["beyond_rows"] == [list(row) for row in result.beyond]
    assert found["certificate"]["reached"] is False
    assert "beyond_rows" not in json.loads(to_json(plain))


def test_csv_has_a_column(lost):
    _, plain, result = lost
    rows = list(csv.reader(io.StringIO(to_csv(result))))
    assert rows[0] == ["t", "x", "certified"]
    count = len(result.rows)
    assert [float(row[2]) for row in rows[1:]] == [1.0] * count + [0.0] * len(result.beyond)
    assert to_csv(plain).startswith("t,x\n")


def test_npz_has_an_array(lost):
    import numpy as np

    _, _, result = lost
    arrays = np.load(io.BytesIO(to_npz(result)))
    assert arrays["certified"].sum() == len(result.rows)
    assert len(arrays["x"]) == len(result.rows) + len(result.beyond)


def test_a_table_marks_each_of_them(lost):
    _, plain, result = lost
    lines = to_table(result).splitlines()
    assert sum(line.endswith("  ~") for line in lines) == len(result.beyond)
    assert any(line.startswith("~ after t =") and "not certified" in line for line in lines)
    assert "~" not in to_table(plain)


def test_where_all_is_certified_nothing_is_beyond():
    text = "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}"
    result = simulated(text, 1, show="x", beyond=True)
    assert result.certificate.reached
    assert result.beyond == ()
    assert "~" not in to_table(result)
    assert json.loads(to_json(result))["beyond_rows"] == []
