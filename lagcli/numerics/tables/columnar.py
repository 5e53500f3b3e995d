"""The result as arrays for other programs: NPZ and Parquet.

Both hold one array of doubles for each column, under its name, with nan (in Parquet null)
where a column is not defined, and the certificate as JSON: the member `certificate.json`
of an NPZ, the key `lagcli` of a Parquet file's metadata.

References
----------
NumPy Enhancement Proposal 1, "A simple file format for NumPy arrays", version 1.0.
"""

from __future__ import annotations

import io
import math
import sys
from array import array
from collections.abc import Sequence
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.tables.writing import document_of, to_text, with_column_certified

Columns = Sequence[str]
Rows = Sequence[Sequence[float | None]]

_ALIGNED = 64  # bytes, as the .npy format asks
#: A ZIP's earliest date: the same result gives the same bytes.
_NO_DATE = (1980, 1, 1, 0, 0, 0)


class NoParquet(Exception):
    """The package that writes Parquet is not installed."""


def to_npz(result: Result) -> bytes:
    """What `numpy.load` reads: data["theta'"] is a column."""
    return table_as_npz(*with_column_certified(result), "certificate.json", _certificate(result))


def table_as_npz(columns: Columns, rows: Rows, name: str, attached: str) -> bytes:
    """A table of doubles as NPZ, with a text under the name of a further member."""
    file = io.BytesIO()
    with ZipFile(file, "w") as archive:
        for j, column in enumerate(columns):
            _add(archive, f"{column}.npy", _npy([row[j] for row in rows]))
        _add(archive, name, attached.encode())
    return file.getvalue()


def _add(archive: ZipFile, name: str, data: bytes) -> None:
    entry = ZipInfo(name, _NO_DATE)
    entry.compress_type = ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    archive.writestr(entry, data)


def _npy(values: Sequence[float | None]) -> bytes:
    """One array of little-endian doubles: magic, version, length of the header, header, data."""
    header = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({len(values)},), }}"
    before = len(b"\x93NUMPY") + 4
    header += " " * (-(before + len(header) + 1) % _ALIGNED) + "\n"
    data = array("d", (math.nan if x is None else x for x in values))
    if sys.byteorder == "big":
        data.byteswap()
    length = len(header).to_bytes(2, "little")
    return b"\x93NUMPY\x01\x00" + length + header.encode("latin1") + data.tobytes()


def to_parquet(result: Result) -> bytes:
    """The result as Parquet, with its certificate.

    Raises
    ------
    NoParquet
        Without pyarrow.
    """
    return table_as_parquet(*with_column_certified(result), _certificate(result))


def table_as_parquet(columns: Columns, rows: Rows, attached: str) -> bytes:
    """A table of doubles as Parquet, with a text under the key `lagcli` of its metadata.

    Raises
    ------
    NoParquet
        Without pyarrow.
    """
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise NoParquet from None
    arrays = {
        name: pa.array([row[j] for row in rows], pa.float64()) for j, name in enumerate(columns)
    }
    table = pa.table(arrays).replace_schema_metadata({"lagcli": attached})
    sink = io.BytesIO()
    parquet.write_table(table, sink)
    return sink.getvalue()


def _certificate(result: Result) -> str:
    """Everything that the JSON form says but for the rows."""
    document = document_of(result)
    for name in ("rows", "beyond_rows"):
        document.pop(name, None)
    return to_text(document)
