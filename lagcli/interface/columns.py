"""Columns of numbers by name: for NumPy, pandas and Arrow."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any


class Columns:
    """A table; an item is a column.

    Attributes
    ----------
    columns : tuple of str
    rows : tuple of tuples of float
        None where a column is not defined.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[float | None, ...], ...]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __getitem__(self, column: str) -> list[float | None]:
        if column not in self.columns:
            raise KeyError(f"no column {column!r}: there are {', '.join(self.columns)}")
        place = self.columns.index(column)
        return [row[place] for row in self.rows]

    def to_dict(self) -> dict[str, list[float | None]]:
        """Columns by name."""
        return {name: self[name] for name in self.columns}

    def to_numpy(self) -> Any:
        """An array of shape (rows, columns); nan where a column is not defined."""
        import numpy as np

        return np.array(self.rows, dtype=float)

    def to_pandas(self) -> Any:
        """A pandas table."""
        import pandas as pd

        return pd.DataFrame(self.to_numpy(), columns=list(self.columns))

    def to_arrow(self) -> Any:
        """An Arrow table."""
        import pyarrow as pa

        return pa.table(self.to_dict())
