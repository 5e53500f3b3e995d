"""More motions for a Poincaré section: states in the section with the energy of the first.

The two columns of the section take the values of a sequence that fills the rectangle around the
first motion evenly; the velocity through the section follows from the energy.

References
----------
Halton, "On the efficiency of certain quasi-random sequences of points", Numer. Math. 2 (1960) 84.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import islice

from lagcli.expression import Name, signed
from lagcli.graph.nodes import Node
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.contact import with_contacts
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.start import initial_state
from lagcli.pictures.contours import first_root, quiet
from lagcli.pictures.drawing import CannotDraw, Point
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column
from lagcli.record import replace

#: How much more than the first motion's rectangle is filled where no energy is the limit.
_WIDER = 1.6
#: Steps in half a width of that rectangle, and how many of them the energy's limit may be away.
_STEPS, _FAR = 20, 400
#: Places that are tried.
_TRIED = 2000
_ROUNDS = 200


def other_starts(
    problem: Problem,
    cut: str | None,
    points: Sequence[Point],
    columns: Sequence[Column],
    count: int,
) -> Iterator[Problem]:
    """The problem with other initial states.

    Parameters
    ----------
    cut
        The coordinate that is 0 in the section; None for one at a period of the time.
    points, columns
        The first motion in the section, and what its axes are.
    count
        How many are wanted.

    Raises
    ------
    CannotDraw
        Where the problem has constraints, or the axes are no coordinate and its velocity.
    """
    first, second = (formula for _, formula in columns)
    simple = (
        isinstance(first, Name)
        and isinstance(second, Name)
        and (second.name, second.primes, first.primes) == (first.name, 1, 0)
        and not problem.constraints
        and not problem.contacts
    )
    if not simple or (cut is None and len(problem.coordinates) > 1):
        raise CannotDraw(
            "--orbits needs a section where one coordinate is 0 (or --section t=T of one "
            "coordinate), whose axes are a coordinate and its velocity, and no constraints"
        )
    assert isinstance(first, Name)
    motion, state = _started(problem)
    rate = Name(first.name, 1)
    through = None if cut is None else _speed(motion, state, cut)

    def start(x: float, y: float) -> dict[Name, float] | None:
        """The state at a place of the section; None where the energy does not allow it."""
        values = {**state, first: x, rate: y}
        if cut is None or through is None:
            return values
        speed = through({**values, Name(cut): 0.0})
        return None if speed is None else {**values, Name(cut): 0.0, Name(cut, 1): speed}

    spans = _spans(points, None if cut is None else start)
    starts = (start(x, y) for x, y in _filling(spans))
    for values in islice((values for values in starts if values is not None), count):
        yield replace(problem, initial={name: signed(x) for name, x in values.items()})


def begun(
    e: EquationsOfMotion, further: Sequence[Node] = ()
) -> tuple[Motion, list[float], list[float]]:
    """The motion in doubles with its state at t = 0; its constants are those of `further` too."""
    initial = [e.form.read(value) for value in e.problem.initial.values()]
    needed = [*(x for row in e.mass for x in row), *e.forcing, *initial, *further]
    motion = Motion(e, constants_of(e, needed, Doubles()), Doubles())
    return motion, *initial_state(motion, e.problem.initial)


def _spans(
    points: Sequence[Point], start: Callable[[float, float], object] | None
) -> list[tuple[float, float]]:
    """The rectangle that is filled: as far as the energy allows, or somewhat around the points."""
    middle = [(min(values) + max(values)) / 2 for values in zip(*points, strict=True)]
    half = [
        (max(values) - min(values)) / 2 or abs(values[0]) or 1.0
        for values in zip(*points, strict=True)
    ]
    spans = []
    for k in (0, 1):
        ends = []
        for side in (-1, 1):
            place, steps = list(middle), 0
            while start is not None and steps < _FAR and start(*place) is not None:
                place[k] += side * half[k] / _STEPS
                steps += 1
            ends.append(place[k] if start is not None else middle[k] + side * _WIDER * half[k])
        spans.append((ends[0], ends[1]))
    return spans


def _filling(spans: Sequence[tuple[float, float]]) -> Iterator[Point]:
    """Places in a rectangle, evenly spread."""
    (left, right), (bottom, top) = spans
    for number in range(1, _TRIED):
        yield (
            left + (right - left) * _inverse(number, 2),
            bottom + (top - bottom) * _inverse(number, 3),
        )


def _inverse(number: int, base: int) -> float:
    """The digits of a number behind the point, the last one first."""
    found, part = 0.0, 1.0
    while number:
        part /= base
        number, digit = divmod(number, base)
        found += digit * part
    return found


def _started(problem: Problem) -> tuple[Motion, dict[Name, float]]:
    """The motion, and its state at t = 0."""
    e = EquationsOfMotion(with_contacts(problem))
    motion, q, v = begun(e, [e.energy])
    names = [Name(s.name, s.primes) for s in (*e.q, *e.qdot)]
    return motion, dict(zip(names, map(float, (*q, *v)), strict=True))


def _speed(
    motion: Motion, state: dict[Name, float], cut: str
) -> Callable[[dict[Name, float]], float | None]:
    """The velocity through the section that gives a state the energy of the first."""
    function = motion.function([motion.equations.energy])
    energy = quiet(lambda *values: float(function(0.0, *values)[0]))
    wanted = energy(*state.values())

    def through(values: dict[Name, float]) -> float | None:
        def excess(v: float) -> float:
            given = {**values, Name(cut, 1): v}
            return energy(*(given[name] for name in state)) - wanted

        return first_root(excess, _ROUNDS) if excess(0.0) < 0 else None

    return through
