"""The formats of a result, by their names."""

from __future__ import annotations

from collections.abc import Callable

from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.tables.writing import to_csv, to_json, to_table


def _npz(result: Result) -> bytes:
    from lagcli.numerics.tables.columnar import to_npz

    return to_npz(result)


def _parquet(result: Result) -> bytes:
    from lagcli.numerics.tables.columnar import to_parquet

    return to_parquet(result)


WRITERS: dict[str, Callable[[Result], bytes]] = {
    "table": lambda result: to_table(result).encode(),
    "json": lambda result: to_json(result).encode(),
    "csv": lambda result: to_csv(result).encode(),
    "npz": _npz,
    "parquet": _parquet,
}
