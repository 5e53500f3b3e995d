"""The rows of a sweep as CSV, JSON, NPZ, Parquet or text."""

from __future__ import annotations

import json
from collections.abc import Callable

from lagcli.numerics.tables.columnar import table_as_npz, table_as_parquet
from lagcli.numerics.tables.writing import aligned, as_csv
from lagcli.record import record

#: What stands behind the columns of each row: whether the accuracy holds to the end, until
#: when it holds, and the largest error.
KNOWN = ("reached", "holds_until", "error")


@record
class Table:
    """A sweep.

    Attributes
    ----------
    columns : tuple of str
        What was varied, the columns of a motion, and `KNOWN`.
    rows : tuple of tuples
    varied : tuple of str
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[float | None, ...], ...]
    varied: tuple[str, ...]

    @property
    def complete(self) -> bool:
        """Whether every motion reached its accuracy."""
        place = self.columns.index("reached")
        return all(row[place] == 1.0 for row in self.rows)


def _csv(table: Table) -> bytes:
    return as_csv(table.columns, table.rows).encode()


def _json(table: Table) -> bytes:
    content = {
        "schema": 1,
        "varied": list(table.varied),
        "columns": list(table.columns),
        "rows": [list(row) for row in table.rows],
    }
    return (json.dumps(content, ensure_ascii=False, allow_nan=False) + "\n").encode()


def _text(table: Table) -> bytes:
    cells = [list(table.columns)]
    cells += [["" if x is None else f"{x:.10g}" for x in row] for row in table.rows]
    return "".join(f"{line}\n" for line in aligned(cells)).encode()


WRITERS: dict[str, Callable[[Table], bytes]] = {
    "table": _text,
    "json": _json,
    "csv": _csv,
    "npz": lambda table: table_as_npz(
        table.columns, table.rows, "varied.json", json.dumps(list(table.varied))
    ),
    "parquet": lambda table: table_as_parquet(
        table.columns, table.rows, json.dumps({"varied": list(table.varied)})
    ),
}
