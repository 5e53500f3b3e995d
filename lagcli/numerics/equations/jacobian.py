"""The derivatives of the accelerations by the state: exact, from the graph."""

from __future__ import annotations

from collections.abc import Callable

from lagcli.graph.derivative import partial
from lagcli.numerics.equations.motion import Motion

Matrix = list[list[float]]

#: Exact derivatives of more coordinates than this are longer than what they save.
_EXACT = 12
_STEP = 6e-6  # of difference quotients: the cube root of rounding


def jacobian(motion: Motion) -> Callable[..., tuple[Matrix, Matrix]]:
    """A function of the state that gives da/dq and da/dq', both (n, n).

    Where a pivot of the elimination vanishes, friction holds, or there are many
    coordinates, by central differences.
    """
    n = motion.n

    def differences(*state: float) -> tuple[float, ...]:
        rows: list[list[float]] = [[] for _ in range(n)]
        for j in range(1, 2 * n + 1):
            step = _STEP * max(1.0, abs(state[j]))
            above, below = (
                motion.accelerations(*state[:j], state[j] + s, *state[j + 1 :])
                for s in (step, -step)
            )
            for row, a, b in zip(rows, above, below, strict=True):
                row.append((a - b) / (2 * step))
        return tuple(x for row in rows for x in row)

    plain = differences
    eliminated = motion.equations.eliminated
    if eliminated is not None and n <= _EXACT and not motion.stuck:
        e = motion.equations
        roots, _ = eliminated.motion(e.forcing, e.bias)
        rules = [partial(e.graph, x) for x in (*e.q, *e.qdot)]
        plain = motion.function(
            [rule(root) for root in roots for rule in rules],
            guards=eliminated.guards,
            otherwise=differences,
            frozen=True,
        )

    def blocks(*state: float) -> tuple[Matrix, Matrix]:
        values = plain(*state)
        rows = [values[2 * n * i : 2 * n * (i + 1)] for i in range(n)]
        return [list(row[:n]) for row in rows], [list(row[n:]) for row in rows]

    return blocks
