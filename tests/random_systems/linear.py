"""Linear systems whose rank is found by complete pivoting."""

from __future__ import annotations

from mpmath import mp, mpf

SMALL = mpf(10) ** -14


def solve(rows, right):
    """Solve rows x = right.

    Returns
    -------
    x, kernel, consistent
        One solution (0 along what is free), a basis of the kernel, whether there is one at all.
    """
    m, n = len(rows), len(rows[0]) if rows else 0
    table = [[*row, value] for row, value in zip(rows, right, strict=True)]
    for row in table:
        size = max((abs(each) for each in row[:n]), default=mpf(0))
        if size > SMALL:
            row[:] = [each / size for each in row]
    pivots = []
    for step in range(min(m, n)):
        used = [column for _, column in pivots]
        best, i, j = max(
            ((abs(table[i][j]), i, j) for i in range(step, m) for j in range(n) if j not in used),
            default=(mpf(0), 0, 0),
        )
        if best < SMALL:
            break
        table[step], table[i] = table[i], table[step]
        table[step] = [each / table[step][j] for each in table[step]]
        for k in range(m):
            if k != step and table[k][j]:
                factor = table[k][j]
                table[k] = [a - factor * b for a, b in zip(table[k], table[step], strict=True)]
        pivots.append((step, j))
    consistent = all(abs(row[n]) < mpf(10) ** -10 for row in table[len(pivots) :])
    x = [mpf(0)] * n
    for i, j in pivots:
        x[j] = table[i][n]
    return x, _kernel(table, pivots, n), consistent


def _kernel(table, pivots, n):
    used = {column for _, column in pivots}
    basis = []
    for free in (j for j in range(n) if j not in used):
        vector = [mpf(0)] * n
        vector[free] = mpf(1)
        for i, j in pivots:
            vector[j] = -table[i][free]
        basis.append(vector)
    return basis


def rank(rows):
    """The rank of a matrix."""
    if not rows:
        return 0
    return len(rows[0]) - len(solve(rows, [mpf(0)] * len(rows))[1])


def least(rows, right, weight=0):
    """The shortest x with rows x = right (as nearly as can be), by normal equations A A^T y.

    With a weight w, the x of the least |rows x - right|^2 + w |x|^2 (Levenberg, Marquardt).
    """
    gram = [[dot(a, b) + (weight if a is b else 0) for b in rows] for a in rows]
    y, _, _ = solve(gram, right)
    return [sum(y[i] * rows[i][j] for i in range(len(rows))) for j in range(len(rows[0]))]


def dot(a, b):
    """The scalar product."""
    return sum((x * y for x, y in zip(a, b, strict=True)), mpf(0))


def times(rows, x):
    """A matrix times a vector."""
    return [dot(row, x) for row in rows]


def transposed(rows):
    """The transpose."""
    return [list(column) for column in zip(*rows, strict=True)]


def product(a, b):
    """A product of matrices."""
    columns = transposed(b)
    return [[dot(row, column) for column in columns] for row in a]


def eigenvalues(rows):
    """All eigenvalues, complex."""
    return mp.eig(mp.matrix(rows), left=False, right=False) if rows else []
