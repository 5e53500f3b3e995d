"""The phase portrait of one degree of freedom whose energy is not conserved: motions.

Through the edges of the window motions enter; from each saddle its unstable manifold runs out, and
its stable one is the unstable one of the motion with time reversed, t -> -t: L(q, -q'),
Q(q, -q'), and -D(q, -q').  All are runs with their certificates.

References
----------
Strogatz, *Nonlinear Dynamics and Chaos*, 2nd ed., section 6.4.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from lagcli.expression import Expression, Name, Negative, signed
from lagcli.graph.nodes import mask_of
from lagcli.numerics.equations.contact import with_contacts
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.pictures.contours import grid, quiet, roots
from lagcli.pictures.drawing import CannotDraw, Curve, Drawn, Item, Picture, equilibria, words
from lagcli.pictures.labels import Labels
from lagcli.pictures.run import PicturedRun, run_with
from lagcli.pictures.starts import begun
from lagcli.pictures.turning import all_wrapped, is_periodic
from lagcli.problem_data import Expect, Problem
from lagcli.reader.columns import Column, phase_columns
from lagcli.record import record, replace
from lagcli.rewriting import rebuilt, rewritten

#: Motions that enter through each edge, their accuracy and their rows.
_EDGE, _ACCURACY, _ROWS = 6, 1e-6, 301
#: A motion is followed for this multiple of the time of the quickest equilibrium.
_LONG = 12.0
#: How near to a saddle its manifolds begin, in widths of the window.
_NEAR = 1e-4
_ROOM, _FASTEST = 0.6, 0.85
_STEP = 1e-5
_PLACES = 1201


@record(kw_only=True)
class Rest:
    """An equilibrium q with the eigenvalues l of l^2 = a_q + a_v l, None where complex."""

    q: float
    stable: bool
    eigenvalues: tuple[float, float] | None

    @property
    def saddle(self) -> bool:
        """Whether one eigenvalue is positive and the other negative."""
        return self.eigenvalues is not None and self.eigenvalues[0] < 0 < self.eigenvalues[1]


class Flow:
    """q'' = a(q, q') with its window and its equilibria.

    Raises
    ------
    CannotDraw
        Where there is more than one coordinate, or the time is in the equations.
    """

    def __init__(self, problem: Problem, labels: Labels) -> None:
        self.problem, self.labels = problem, labels
        e = EquationsOfMotion(with_contacts(problem))
        name = e.q[0].name
        mask = mask_of((*(x for row in e.mass for x in row), *e.forcing))
        if len(e.q) != 1 or e.rows or mask & e.t.mask:
            raise CannotDraw(
                "the energy is not conserved, and the equations are not those of one coordinate "
                f"without the time: --kind phase --show {name} draws the motion by itself, --kind "
                "poincare cuts it"
            )
        motion, q, _ = begun(e)
        self.acceleration = quiet(lambda q, v: float(motion.accelerations(0.0, q, v)[0]))
        self.start = float(q[0])
        self.name = Name(name)
        self.turns = labels.is_angle(self.name) and is_periodic(lambda x: self.acceleration(x, 0.0))

    def rests(self) -> list[Rest]:
        """The equilibria near the motion."""
        far = 20 * (abs(self.start) or 1.0)
        places = (
            grid(-1.01 * math.pi, 1.01 * math.pi, _PLACES) if self.turns
            else grid(-far, far, _PLACES - 1)
        )  # fmt: skip
        found = [self._rest(x) for x in roots(lambda x: self.acceleration(x, 0.0), places)]
        return [rest for rest in found if self.turns or abs(rest.q) <= far / 2]

    def _rest(self, q: float) -> Rest:
        a, h = self.acceleration, _STEP
        by_q = (a(q + h, 0.0) - a(q - h, 0.0)) / (2 * h)
        by_v = (a(q, h) - a(q, -h)) / (2 * h)
        square = by_v * by_v / 4 + by_q
        pair = None
        if square >= 0:
            root = math.sqrt(square)
            pair = (by_v / 2 - root, by_v / 2 + root)
        return Rest(q=q, stable=by_q < 0 and by_v <= h, eigenvalues=pair)


def flow(problem: Problem, request: RunRequest, progress: Progress = None) -> Drawn:
    """The portrait, with the motion of the file where that has an end."""
    labels = Labels(problem)
    made = Flow(problem, labels)
    rests = made.rests()
    columns = phase_columns(made.name.name)
    run = run_with(problem, request, columns, progress) if request.until > 0 else None
    (low, high), fastest, time = _window(made, rests, run)
    items: list[Item] = []
    label = words("motions")
    for line in _entering(made, (low, high), fastest, time, columns):
        items.append(Curve(pieces=line, role="level", label=label if not items else None))
    for rest in rests:
        if rest.saddle:
            items += _manifolds(made, rest, high - low, time, columns)
    if run is not None:
        items += run.in_the_plane(turns=made.turns)
    stable, unstable = ([rest.q for rest in rests if rest.stable == kind] for kind in (True, False))
    items += equilibria((("stable", stable, 2), ("unstable", unstable, 1)), (low, high))
    panel = labels.panel(columns, ((low, high), (-fastest, fastest)), items)
    notes = run.notes() if run is not None else ()
    picture = Picture(title=problem.title, panels=(panel,), notes=notes)
    return picture, run.result.refusal if run is not None else ""


def _window(
    made: Flow, rests: list[Rest], run: PicturedRun | None
) -> tuple[tuple[float, float], float, float]:
    """The range of q, the largest q' and how long a motion is followed."""
    seen = [] if run is None else run.values(1)
    a = made.acceleration
    if made.turns:
        low, high = -math.pi, math.pi
    else:
        shown = [*(rest.q for rest in rests), *seen, made.start]
        width = (max(shown) - min(shown)) or abs(made.start) or 1.0
        low, high = min(shown) - _ROOM * width, max(shown) + _ROOM * width
    slopes = [abs(a(rest.q + _STEP, 0.0) - a(rest.q - _STEP, 0.0)) / (2 * _STEP) for rest in rests]
    frequency = math.sqrt(max([*slopes, 0.0])) or 1.0
    fastest = _FASTEST * frequency * (high - low) / 2
    if run is not None:
        fastest = max(fastest, 1.1 * max(map(abs, run.values(2)), default=0.0))
    return (low, high), fastest, _LONG / frequency


def _entering(
    made: Flow, span: tuple[float, float], fastest: float, time: float, columns: list[Column]
) -> Iterator[tuple[tuple[tuple[float, float], ...], ...]]:
    """Motions from the edges of the window into it."""
    low, high = span
    for k in range(_EDGE):
        part = (k + 0.5) / _EDGE
        starts = [(low, part * fastest), (high, -part * fastest)]
        starts += [(low + part * (high - low), side * fastest) for side in (-1, 1)]
        for q, v in starts:
            inward = made.acceleration(q, v) * v < 0 or abs(v) < fastest
            line = _line(made.problem, made, (q, v), time, columns) if inward else ()
            if line:
                yield line


def _manifolds(
    made: Flow, rest: Rest, width: float, time: float, columns: list[Column]
) -> Iterator[Item]:
    """What leaves a saddle, and what comes to it: the same with the time reversed."""
    assert rest.eigenvalues is not None
    back, out = rest.eigenvalues
    label = words("to and from the saddle")
    for problem, rate, sign in (
        (made.problem, out, 1),
        (reversed_in_time(made.problem), -back, -1),
    ):
        long = time + math.log(1 / _NEAR) / rate
        for side in (-1, 1):
            step = side * _NEAR * width
            line = _line(problem, made, (rest.q + step, step * rate), long, columns, sign)
            if line:
                yield Curve(pieces=line, role="separatrix", colour=1, label=label)


def _line(
    problem: Problem,
    made: Flow,
    start: tuple[float, float],
    time: float,
    columns: list[Column],
    sign: int = 1,
) -> tuple[tuple[tuple[float, float], ...], ...]:
    """A motion from a state; none where it cannot be run."""
    q, v = start
    initial = {made.name: signed(q), Name(made.name.name, 1): signed(v)}
    request = RunRequest(until=time, accuracy=_ACCURACY, samples=_ROWS, columns=())
    try:
        run = run_with(replace(problem, initial=initial), request, columns)
    except Refusal:
        return ()
    pieces = run.curve(1, 2)
    lines = all_wrapped(pieces) if made.turns else pieces
    return tuple(tuple((x, sign * y) for x, y in line) for line in lines)


def reversed_in_time(problem: Problem) -> Problem:
    """The problem whose motions are those of another, backwards: q(-t)."""
    bare = replace(
        problem, expect=Expect(), find=(), symmetries=(), observables={}, brackets=(),
        canonical_transformations=(), initial={},
    )  # fmt: skip

    def turned(node: Expression) -> Expression:
        if isinstance(node, Name) and node.primes % 2:
            return Negative(node)
        return rebuilt(node, turned)

    found = rewritten(bare, turned)
    if found.dissipation is None:
        return found
    return replace(found, dissipation=Negative(found.dissipation))
