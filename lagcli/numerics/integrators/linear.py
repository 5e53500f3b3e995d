"""Small dense linear systems of real or complex numbers: P M = L U.

References
----------
Golub, Van Loan, *Matrix Computations*, 4th ed., section 3.4.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any


class Factors:
    """A square matrix, factored with the exchange of rows.

    Raises
    ------
    ZeroDivisionError
        When it is singular.
    """

    def __init__(self, matrix: Sequence[Sequence[Any]]) -> None:
        rows = [list(row) for row in matrix]
        n = len(rows)
        self._order = list(range(n))
        for k in range(n):
            best = max(range(k, n), key=lambda i: abs(rows[i][k]))
            if best != k:
                rows[k], rows[best] = rows[best], rows[k]
                order = self._order
                order[k], order[best] = order[best], order[k]
            pivot = rows[k]
            inverse = 1 / pivot[k]
            for i in range(k + 1, n):
                row = rows[i]
                if row[k]:
                    factor = row[k] * inverse
                    row[k] = factor
                    for j in range(k + 1, n):
                        row[j] -= factor * pivot[j]
        self._rows = rows

    def solve(self, right: Sequence[Any]) -> list[Any]:
        """x of M x = right."""
        rows, n = self._rows, len(self._rows)
        x = [right[place] for place in self._order]
        for i in range(1, n):
            row = rows[i]
            for j in range(i):
                x[i] -= row[j] * x[j]
        for i in reversed(range(n)):
            row = rows[i]
            for j in range(i + 1, n):
                x[i] -= row[j] * x[j]
            x[i] /= row[i]
        return x
