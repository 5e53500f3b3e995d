"""NPZ by its specification (NEP 1) and Parquet by pyarrow: the same numbers as in JSON."""

import ast
import io
import json
import math
import struct
import sys
import zipfile

import pytest
from pyarrow import parquet

from lagcli.cli.run import run

PROBLEM = "{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}"
#: its last column is not defined from t = 2 on
COMMAND = ("--until", "4", "--samples", "5", "--show", "x,x',x/2,sqrt(2 - t)/1")


@pytest.fixture
def answer(tmp_path):
    """The bytes of a form."""
    problem = tmp_path / "p.yaml"
    problem.write_text(PROBLEM)

    def of(form):
        path = tmp_path / f"out.{form}"
        assert run(["simulate", str(problem), *COMMAND, "-f", form, "-o", str(path)]) == 0
        return path.read_bytes()

    return of


def array_of(data):
    """NEP 1: magic, version, length of the header, header, numbers."""
    assert data[:8] == b"\x93NUMPY\x01\x00"
    [length] = struct.unpack("<H", data[8:10])
    assert (10 + length) % 64 == 0
    header = ast.literal_eval(data[10 : 10 + length].decode("latin1"))
    assert header["descr"] == "<f8"
    assert header["fortran_order"] is False
    [count] = header["shape"]
    return struct.unpack(f"<{count}d", data[10 + length :])


def test_npz_holds_each_column_and_the_certificate(answer):
    document = json.loads(answer("json"))
    with zipfile.ZipFile(io.BytesIO(answer("npz"))) as archive:
        assert archive.testzip() is None
        found = {name: archive.read(name) for name in archive.namelist()}
    certificate = json.loads(found.pop("certificate.json"))
    assert certificate == {k: v for k, v in document.items() if k != "rows"}
    assert list(found) == [f"{name}.npy" for name in document["columns"]]
    for j, data in enumerate(found.values()):
        for value, row in zip(array_of(data), document["rows"], strict=True):
            assert math.isnan(value) if row[j] is None else value == row[j]


def test_npz_is_the_same_each_time(answer):
    assert answer("npz") == answer("npz")


@pytest.mark.long
def test_parquet_holds_the_same(answer):
    document = json.loads(answer("json"))
    table = parquet.read_table(io.BytesIO(answer("parquet")))
    assert table.column_names == document["columns"]
    rows = [list(row.values()) for row in table.to_pylist()]
    assert rows == document["rows"]
    certificate = json.loads(table.schema.metadata[b"lagcli"])["certificate"]
    assert certificate == document["certificate"]


def test_parquet_without_its_package(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    problem = tmp_path / "p.yaml"
    problem.write_text(PROBLEM)
    assert (
        run(["simulate", str(problem), *COMMAND, "-f", "parquet", "-o", str(tmp_path / "o")]) == 2
    )
    assert "pip install 'lagcli[parquet]'" in capsys.readouterr().err
    assert not (tmp_path / "o").exists()
