"""A motion proved: bits and order raised until the enclosures are as thin as asked for."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

from lagcli.numerics.certified.simulate import Simulation
from lagcli.numerics.equations.arithmetic import Balls
from lagcli.numerics.equations.columns import Values
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.start import refined_state
from lagcli.numerics.hybrid.request import Asked
from lagcli.numerics.rigorous.enclosure import Enclosures, NotEnclosed
from lagcli.numerics.rigorous.sets import around
from lagcli.problem_data import Problem
from lagcli.record import record

#: Bits of the first attempt and of the last.
_BITS, _MOST_BITS = 80, 640
#: Steps of one attempt.
_STEPS = 5_000
#: More bits go on where the last doubling has reached so much farther.
_GAIN = 1.01
#: Bits between the working precision and what the remainder of a step may be.
_SPARE = 0
#: A constraint's residual at the beginning, beside its terms, in bits below the precision.
_RESIDUAL = 24

Progress = Callable[[float], None]
Enclosure = tuple[Any, ...]


@record(kw_only=True)
class Proof:
    """What was proved.

    Attributes
    ----------
    columns : tuple of str
    rows : tuple of tuples of arb
        Each ball contains the exact value at that time.
    accuracy, reached, holds_until
        As of a certificate; here they are proved.
    bits, order, steps : int
        Of the successful attempt.
    assumed : tuple of str
        What the proof stands on.
    refusal : str
        Why the rows end early; empty where they do not.
    """

    columns: tuple[str, ...]
    rows: tuple[Enclosure, ...]
    accuracy: float
    reached: bool
    holds_until: float
    bits: int
    order: int
    steps: int
    assumed: tuple[str, ...]
    refusal: str = ""


def prove(problem: Problem, asked: Asked, progress: Progress | None = None) -> Proof:
    """Enclose a motion.

    Parameters
    ----------
    problem : Problem
        With values for its parameters and an initial state: exact numbers, as they are written.
    asked : Asked
        Span, accuracy and columns.
    progress : function, optional
        Told which part of the span is enclosed.

    Returns
    -------
    Proof
        Its rows end where the enclosures are wider than the accuracy.

    Raises
    ------
    Refusal
        When the motion is of a kind that is not enclosed: contacts, switching functions.
    """
    simulation = _simulation(problem, asked)
    best: Proof | None = None
    bits = _BITS
    while bits <= _MOST_BITS:
        with _precision(bits):
            found = _attempt(simulation, bits, progress)
        gained = best is None or found.holds_until > _GAIN * best.holds_until
        best = found if best is None or found.holds_until >= best.holds_until else best
        if found.reached or not gained:
            break
        bits *= 2
    assert best is not None
    return best


def _simulation(problem: Problem, asked: Asked) -> Simulation:
    """What is integrated, where it can be enclosed."""
    whole = Simulation(problem, asked)
    if problem.contacts or any(one.holds_while is not None for one in problem.constraints):
        raise Refusal("contacts are not enclosed: --rigorous is for motions without them",
                      mistake=False)  # fmt: skip
    if whole.equations.kinks:
        message = "abs and sign are not enclosed: --rigorous is for smooth motions"
        raise Refusal(message, mistake=False)
    if asked.stop_when is not None:
        raise Refusal("--stop-when is not enclosed", mistake=False)
    integrated, _ = whole.ready()
    return integrated


def _attempt(simulation: Simulation, bits: int, progress: Progress | None) -> Proof:
    """One proof at a given precision, with the order that suits it."""
    asked = simulation.asked
    arithmetic = Balls()
    constants = constants_of(simulation.equations, simulation.all_nodes, arithmetic)
    motion = Motion(simulation.equations, constants, arithmetic)
    state, assumed = _start(simulation, motion, bits)
    order = int(0.36 * bits)
    enclosures = Enclosures(motion, order, 2.0 ** -(bits - _SPARE))
    values = Values(motion, simulation.reading, simulation.nodes)
    ball = arithmetic.ball
    times = [arithmetic.number(Fraction(t)) for t in _times(asked)]
    rows: list[Enclosure] = []
    refusal = ""

    def take(x: Sequence[Any], t: Any) -> None:
        n = motion.n
        rows.append(tuple(values(t, list(x[:n]), list(x[n:]))))

    try:
        take(state, ball(0))
        waiting = 1
        for piece in enclosures.pieces(around(state), ball(0), times[-1]):
            while waiting < len(times) and times[waiting] <= piece.end:
                take(piece.at(times[waiting]), times[waiting])
                waiting += 1
            if progress is not None:
                progress(float(piece.end) / asked.until)
            if enclosures.steps > _STEPS:
                refusal = f"more than {_STEPS} steps"
                break
    except NotEnclosed as reason:
        refusal = str(reason)
    except (ArithmeticError, ValueError, OverflowError) as reason:
        refusal = f"the equations are not defined on the enclosure: {reason}"
    good = _good(rows, asked.accuracy)
    reached = good == len(times)
    if not reached and not refusal:
        refusal = f"the enclosures are wider than the accuracy {asked.accuracy:g}"
    holds = float(times[good - 1]) if good else 0.0
    return Proof(
        columns=tuple(column.name for column in asked.columns),
        rows=tuple(rows[:good]),
        accuracy=asked.accuracy,
        reached=reached,
        holds_until=holds,
        bits=bits,
        order=order,
        steps=enclosures.steps,
        assumed=assumed,
        refusal="" if reached else f"proved until t = {holds:g}: {refusal}",
    )


def _times(asked: Asked) -> list[float]:
    """The rows as exact doubles, both ends included."""
    if asked.times:
        return [*asked.times]
    count = asked.samples - 1
    return [asked.until * k / count for k in range(count)] + [asked.until]


def _start(simulation: Simulation, motion: Motion, bits: int) -> tuple[list[Any], tuple[str, ...]]:
    """The exact initial state as balls, and what is assumed of it.

    Raises
    ------
    Refusal
        When the state that the file gives does not satisfy the constraints exactly.
    """
    q, v = refined_state(motion, None, *simulation.start, anew=True)
    state = [*q, *v]
    assumed = ["the file as it is written", "the interval arithmetic of python-flint"]
    equations = motion.equations
    if equations.rows:
        nodes = [*equations.positions, *equations.rates]
        residuals = motion.function(nodes)(motion.arithmetic.number(Fraction(0)), *state)
        bound = 2.0 ** -(bits - _RESIDUAL)
        if not all(abs(r) < bound for r in residuals):
            message = (
                "the initial state is not given exactly on the constraints: write every "
                "coordinate and velocity under `initial`, as exact numbers or roots"
            )
            raise Refusal(message, mistake=False)
        assumed.append(f"the initial state satisfies the constraints, whose residuals are below "
                       f"{bound:.0e}")  # fmt: skip
    return state, tuple(assumed)


def _good(rows: Sequence[Enclosure], accuracy: float) -> int:
    """How many rows are as thin as asked for, beside the largest magnitude of their column.

    A column whose enclosures all contain 0 is compared with the largest of the others.
    """
    scales: list[float] = []
    for good, row in enumerate(rows):
        sizes = [0.0 if x is None else float(abs(x).lower()) for x in row]
        scales = [max(pair) for pair in zip(sizes, scales or sizes, strict=True)]
        largest = max(scales[1:], default=0.0) or 1.0
        for x, scale in zip(row[1:], scales[1:], strict=True):
            if x is not None and not (
                x.is_finite() and _radius(x) <= accuracy * (scale or largest)
            ):
                return good
    return len(rows)


def _radius(x: Any) -> float:
    found = float(x.rad())
    return found if math.isfinite(found) else math.inf


@contextmanager
def _precision(bits: int) -> Any:
    from flint import ctx

    usual, ctx.prec = ctx.prec, bits
    try:
        yield
    finally:
        ctx.prec = usual
