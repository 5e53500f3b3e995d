"""The exact initial state in balls: what the file gives, and what the constraints add to it.

Coordinates that the file leaves out obey f(q, 0) = 0, velocities A q' + b = 0.  Near the state in
doubles the root is enclosed by Krawczyk's operator

    K(X) = x - Y f(x) + (1 - Y J(X)) (X - x):

K(X) inside X proves that there is one root in X, and that it lies in K(X).

References
----------
R. Moore, R. Kearfott, M. Cloud, *Introduction to Interval Analysis* (2009), section 8.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node, Symbol
from lagcli.graph.substitution import Substitution
from lagcli.numerics.certified.ready_setup import ready_setup
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import given_values
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.setup import Setup
from lagcli.pivoting import reduced
from lagcli.problem_data import Problem
from lagcli.record import replace

#: What a given state may leave of a constraint: then it is taken to satisfy it.
_RESIDUAL = 2.0**-56
#: Radius of the first X, beside the largest component; pivots below a part of the largest are 0.
_AROUND, _NO_PIVOT = 1e-10, 1e-9
_KRAWCZYK = 12


def initial_state(
    motion: Motion, start: tuple[Sequence[float], Sequence[float]]
) -> tuple[list[Any], list[str]]:
    """The state at t = 0, and what is assumed of it.

    Parameters
    ----------
    motion : Motion
        In balls.
    start : q, q'
        The same state in doubles.

    Raises
    ------
    Refusal
        When no state on the constraints is proved to be there.
    """
    equations = motion.equations
    number = motion.arithmetic.number
    symbols = (*equations.q, *equations.qdot)
    doubles = dict(zip(symbols, (*start[0], *start[1]), strict=True))
    state = given_values(motion, motion.equations.problem.initial)
    assumed: list[str] = []
    for kind, rows in ((equations.q, equations.positions), (equations.qdot, equations.rates)):
        unknown = [s for s in kind if s not in state]
        state |= {s: number(Fraction(doubles[s])) for s in unknown}
        used = _solve(motion, symbols, state, unknown, rows)
        rest = [row for k, row in enumerate(rows) if k not in used]
        assumed += vanishing(motion, [state.get(s, number(Fraction(0))) for s in symbols], rest)
    return [state[s] for s in symbols], list(dict.fromkeys(assumed))


def vanishing(motion: Motion, state: Sequence[Any], nodes: Sequence[Node]) -> list[str]:
    """What is assumed for nodes to be 0 at the beginning.

    Raises
    ------
    Refusal
        Where one of them is not.
    """
    equations = motion.equations
    graph, read = equations.graph, equations.form.read
    given = {graph.symbol(x.name, x.primes): read(y) for x, y in equations.problem.initial.items()}
    known = Substitution(graph, {**given, equations.t: graph.zero})
    rows = [node for node in nodes if known(node) is not graph.zero]
    found = motion.function(rows)(motion.arithmetic.number(Fraction(0)), *state) if rows else ()
    if not all(abs(r) < _RESIDUAL for r in found):
        message = "the initial state is not on the constraints as exactly as a proof needs it"
        raise Refusal(message, mistake=False)
    if all(r.is_zero() for r in found):
        return []
    return [f"the initial state, whose residuals are below {_RESIDUAL:.0e}, is on the constraints"]


def _solve(
    motion: Motion,
    symbols: Sequence[Symbol],
    state: dict[Symbol, Any],
    unknown: Sequence[Symbol],
    rows: Sequence[Node],
) -> set[int]:
    """Put the roots in for the unknowns that rows determine; which rows."""
    from flint import arb, arb_mat

    if not unknown:
        return set()
    zero = motion.arithmetic.number(Fraction(0))
    slopes = [partial(motion.equations.graph, s)(row) for row in rows for s in unknown]
    residual, jacobian = motion.function(rows), motion.function(slopes)

    def at(function: Any) -> Any:
        return function(zero, *(state.get(s, zero) for s in symbols))

    width = len(unknown)
    values = [float(x) for x in at(jacobian)]
    matrix = [values[i * width : (i + 1) * width] for i in range(len(rows))]
    # columns of zeros come last
    weights = [1.0 if float(state[s]) else _NO_PIVOT**0.5 for s in unknown]
    least = _NO_PIVOT * max((abs(x) for x in values), default=0.0)
    pivots = reduced(matrix, width, least, weights)
    free = [unknown[j] for j in range(width) if j not in {j for _, j in pivots}]
    if any(not state[s].is_zero() for s in free):
        message = f"the file does not determine the initial value of {free[0]} exactly"
        raise Refusal(message, mistake=False)
    n = len(pivots)
    if not n:
        return set()
    chosen = [unknown[j] for _, j in pivots]

    def square(all_slopes: Sequence[Any]) -> Any:
        return arb_mat(n, n, [all_slopes[i * width + j] for i, _ in pivots for _, j in pivots])

    inverse = square(at(jacobian)).mid().inv().mid()
    middle = [state[s].mid() for s in chosen]
    largest = max(1.0, *(abs(float(x)) for x in middle))
    box = [x + arb(0, _AROUND * largest) for x in middle]
    proved = False
    for _ in range(_KRAWCZYK):
        state |= dict(zip(chosen, middle, strict=True))
        values = at(residual)
        step = inverse * arb_mat(n, 1, [values[i] for i, _ in pivots])
        state |= dict(zip(chosen, box, strict=True))
        identity = arb_mat(n, n, 1)
        spread = (identity - inverse * square(at(jacobian))) * arb_mat(
            n, 1, [x - m for x, m in zip(box, middle, strict=True)]
        )
        found = [m - step[i, 0] + spread[i, 0] for i, m in enumerate(middle)]
        proved = proved or all(x.contains_interior(y) for x, y in zip(box, found, strict=True))
        if not proved:
            raise Refusal(
                "no initial state on the constraints is proved to be there", mistake=False
            )
        box = [x.intersection(y) for x, y in zip(box, found, strict=True)]
        middle = [x.mid() for x in box]
    state |= dict(zip(chosen, box, strict=True))
    return {i for i, _ in pivots}


def setup_of(problem: Problem, request: RunRequest) -> tuple[Setup, frozenset[int]]:
    """What is integrated, and the constraints that the others imply at the beginning."""
    setup, modes = ready_setup(problem, request)
    symbols = (*setup.equations.q, *setup.equations.qdot)
    given = {(name.name, name.primes) for name in problem.initial}
    values = zip(symbols, (*setup.start[0], *setup.start[1]), strict=True)
    if any(x and (s.name, s.primes) not in given for s, x in values):
        # what a constraint gives is enclosed with that constraint
        setup, modes = ready_setup(problem, replace(request, whole=True))
    implied: frozenset[int] = frozenset()
    if setup.equations.rows:
        first = modes.first
        q, v = setup.start
        kept = first.motion.independent(0.0, *q, *v)
        if kept is not None:
            implied = frozenset(
                k for k, place in first.equations.place.items() if place not in kept
            )
    multipliers = setup.reading.multipliers
    if implied and any(node.mask & s.mask for node in setup.nodes for s in multipliers):
        message = "with constraints that others imply the multipliers are not determined"
        raise Refusal(message, mistake=False)
    return setup, implied
