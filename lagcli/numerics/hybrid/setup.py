"""A problem and a request as nodes: columns, conditions, charges; the rows of its runs."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from functools import lru_cache
from itertools import pairwise
from typing import Any, Self

from lagcli.graph.nodes import Node
from lagcli.numerics.equations.columns import Reading
from lagcli.numerics.equations.contact import one_sided, with_contacts
from lagcli.numerics.equations.equations import Equations
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.numerics.hybrid.request import Progress, RunRequest
from lagcli.numerics.hybrid.result import Cut
from lagcli.problem_data import Problem, charge_of
from lagcli.reader.columns import Column

#: The least number of intervals at which two runs are compared.
_COMPARED = 100
_GOLDEN = 0.6180339887498949
#: Intervals that are compared between two rows where the accuracy is lost.
_CLOSER = 64


class Setup:
    """One problem with its columns and conditions as nodes."""

    def __init__(self, problem: Problem, request: RunRequest, progress: Progress = None) -> None:
        self.problem, self.request, self.progress = problem, request, progress
        #: with the contacts among the constraints
        self.whole = with_contacts(problem)
        self.equations = equations = Equations(self.whole)
        self.reading = Reading(equations)
        #: the constraints that act at the beginning, whatever the contacts do
        self.given = frozenset(range(len(problem.constraints)))
        self.contacts = one_sided(self.whole, len(problem.constraints))
        try:
            self.stop = None if request.stop_when is None else self.reading(request.stop_when)
            self.nodes = [self._column(column) for column in request.columns]
            self.margins = {
                k: self._margin(c.holds_while)
                for k, c in enumerate(self.whole.constraints)
                if c.holds_while is not None
            }
            self.gaps = self._gaps()
            self.charges = dict(equations.holding(frozenset()).evident_charges)
            self.candidates = self._candidates()
        except ArithmeticError as error:
            raise Refusal(f"a column is not defined: {error}") from None
        #: the requested rows are those at multiples of this
        self.every = _parts_of_rows(request)
        self.notes: list[str] = []
        #: what the model was cut by
        self.cut: Cut | None = None
        #: the state at t = 0, once it is found
        self.start: tuple[list[float], list[float]] = [], []
        self.begin()

    def begin(self) -> None:
        """Nothing has been run."""
        self.times = self._times()
        #: how many of the times are the requested ones, and what lies between them
        self.regular = len(self.times)
        self.finished = 0
        #: whether a run was so long that doubles were left for numbers of more bits
        self.is_long = False
        #: of one run with more digits than doubles, where it is an attempt
        self.most_steps: int | None = None
        #: what is said beside the reason for the method
        self.remark = ""
        #: the rows of the run over the whole span, certified or not, where they are requested
        self.whole_span: list[tuple[float | None, ...]] = []

    def _column(self, column: Column) -> Node:
        if column.expression is None:
            return self.equations.t
        return self.reading(column.expression)

    def _times(self) -> list[float]:
        """The rows, and between them what two runs are compared at as well."""
        return [*_grid(self.request.until, self.request.samples, self.request.times, self.every)]

    def _gaps(self) -> dict[int, Node]:
        """Of the contacts that can be open."""
        e = self.equations
        gaps = {}
        for k, contact in self.contacts.items():
            position = e.constraints[k].position
            if not contact.stops and position is not None:
                gaps[k] = e.graph.scaled(position, contact.sign)
        return gaps

    def _candidates(self) -> list[str]:
        """The names of the candidates' charges, which are added to the charges."""
        names = []
        for symmetry in self.problem.symmetries:
            name = symmetry.name
            while name in self.charges:
                name += "*"
            self.charges[name] = self.reading(charge_of(symmetry))
            names.append(name)
        return names

    def _margin(self, condition: Any) -> Node:
        return self.equations.graph.difference(*map(self.reading, condition.larger_first))

    @property
    def all_nodes(self) -> list[Node]:
        """Everything that is given a number: its parameters need values."""
        e = self.equations
        initial = [e.form.read(value) for value in self.problem.initial.values()]
        return [
            *e.dynamics,
            *e.positions,
            *e.rates,
            *initial,
            *self.nodes,
            *self.margins.values(),
            *self.gaps.values(),
            *self.charges.values(),
            *([self.stop] if self.stop is not None else []),
            *(e.form.read(c.restitution) for c in self.contacts.values() if c.restitution),
        ]

    def over(self, request: RunRequest) -> Self:
        """The same motion from the same state with other rows."""
        other = copy(self)
        other.request = request
        other.every = _parts_of_rows(request)
        other.begin()
        other.finished = self.finished
        return other

    @property
    def rows_at(self) -> list[float]:
        """The times of the requested rows."""
        return self._times()[:: self.every]

    def written_times(self, arithmetic: Any) -> list[Any]:
        """The times of the requested rows in balls: 0.1 and pi/3 are not doubles."""
        request, ball = self.request, arithmetic.ball
        if request.times:
            return [ball(t) for t in request.times]
        end, count = ball(request.until), request.samples - 1
        if request.end is not None:
            [end] = straight_line((), [self.equations.form.read(request.end)], {}, arithmetic)()
        return [end * k / count for k in range(count + 1)]

    def look_between(self, good: float, bad: float) -> None:
        """Rows as they were up to a time, then many up to another."""
        kept = [t for t in self.times if t <= good]
        self.regular = len(kept)
        step = (bad - good) / _CLOSER
        self.times = [*kept, *(good + step * k for k in range(1, _CLOSER)), bad]
        if bad < self.request.until:
            self.times.append(self.request.until)

    @property
    def goes_on(self) -> bool:
        """Whether the motion may go on in another mode than the first."""
        return bool(self.gaps) or any(c.on_loss == "release" for c in self.problem.constraints)


def _parts_of_rows(request: RunRequest) -> int:
    """Into how many intervals of comparison that between two rows is divided."""
    return max(1, -(-_COMPARED // (request.samples - 1)))


@lru_cache(maxsize=4)
def _grid(until: float, samples: int, given: Sequence[float], every: int) -> tuple[float, ...]:
    """The times of rows, given or evenly spread, each followed by those in between."""
    # out of step with whatever the requested rows are in step with
    parts = [(k + (_GOLDEN * k % 1.0 - 0.5 if k else 0.0)) / every for k in range(every)]
    if given:
        return *(a + (b - a) * part for a, b in pairwise(given) for part in parts), until
    count = samples - 1
    return *(until * (k + part) / count for k in range(count) for part in parts), until
