"""A problem and a request as nodes: columns, conditions, charges; the rows of its runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any

from lagcli.graph.nodes import Node
from lagcli.numerics.equations.columns import Reading
from lagcli.numerics.equations.contact import OneSided, one_sided, with_contacts
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Cut
from lagcli.problem_data import Problem, charge_of
from lagcli.record import record

#: The least number of intervals at which two runs are compared.
_COMPARED = 100
_GOLDEN = 0.6180339887498949


@record(kw_only=True)
class Setup:
    """One problem with its columns and conditions as nodes.

    Attributes
    ----------
    problem, request
        As given; of `whole` the contacts are among the constraints.
    equations, reading
        Of what is integrated, and how columns are read there.
    given : frozenset of int
        The constraints that act at the beginning, whatever the contacts do.
    contacts : mapping of int to OneSided
        By the place of the constraint.
    nodes : tuple of Node
        The columns.
    stop : Node or None
        Where it changes its sign the run stops.
    margins, gaps : mapping of int to Node
        Of constraints that hold while it is positive; of contacts that can be open.
    charges : mapping of str to Node
        What may be conserved; `candidates` are those of the file, which need not be.
    start : (q, q')
        The state at t = 0, once it is found.
    notes : tuple of str
        Warnings of the result.
    cut : Cut or None
        What the model was cut by.
    """

    problem: Problem
    request: RunRequest
    whole: Problem
    equations: EquationsOfMotion
    reading: Reading
    given: frozenset[int]
    contacts: Mapping[int, OneSided]
    nodes: tuple[Node, ...]
    stop: Node | None
    margins: Mapping[int, Node]
    gaps: Mapping[int, Node]
    charges: Mapping[str, Node]
    candidates: tuple[str, ...]
    start: tuple[list[float], list[float]] = ([], [])
    notes: tuple[str, ...] = ()
    cut: Cut | None = None

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

    @property
    def every(self) -> int:
        """The requested rows are those at multiples of this."""
        return max(1, -(-_COMPARED // (self.request.samples - 1)))

    @property
    def times(self) -> list[float]:
        """The rows, and between them what two runs are compared at as well."""
        request = self.request
        return [*_grid(request.until, request.samples, request.times, self.every)]

    @property
    def rows_at(self) -> list[float]:
        """The times of the requested rows."""
        return self.times[:: self.every]

    def written_times(self, arithmetic: Any) -> list[Any]:
        """The times of the requested rows in balls: 0.1 and pi/3 are not doubles."""
        request, ball = self.request, arithmetic.ball
        if request.times:
            return [ball(t) for t in request.times]
        end, count = ball(request.until), request.samples - 1
        if request.end is not None:
            [end] = straight_line((), [self.equations.form.read(request.end)], {}, arithmetic)()
        return [end * k / count for k in range(count + 1)]

    @property
    def goes_on(self) -> bool:
        """Whether the motion may go on in another mode than the first."""
        return bool(self.gaps) or any(c.on_loss == "release" for c in self.problem.constraints)


def setup_of(problem: Problem, request: RunRequest) -> Setup:
    """A problem and a request as nodes; its state at t = 0 is still to be found.

    Raises
    ------
    Refusal
        When a column is not defined.
    """
    whole = with_contacts(problem)
    equations = EquationsOfMotion(whole)
    reading = Reading(equations)
    contacts = one_sided(whole, len(problem.constraints))
    try:
        charges = dict(equations.holding(frozenset()).evident_charges)
        return Setup(
            problem=problem,
            request=request,
            whole=whole,
            equations=equations,
            reading=reading,
            given=frozenset(range(len(problem.constraints))),
            contacts=contacts,
            nodes=tuple(
                equations.t if column.expression is None else reading(column.expression)
                for column in request.columns
            ),
            stop=None if request.stop_when is None else reading(request.stop_when),
            margins={
                k: equations.graph.difference(*map(reading, c.holds_while.larger_first))
                for k, c in enumerate(whole.constraints)
                if c.holds_while is not None
            },
            gaps=_gaps(equations, contacts),
            candidates=_with_candidates(charges, problem, reading),
            charges=charges,
        )
    except ArithmeticError as error:
        raise Refusal(f"a column is not defined: {error}") from None


def _gaps(equations: EquationsOfMotion, contacts: Mapping[int, OneSided]) -> dict[int, Node]:
    """Of the contacts that can be open."""
    gaps = {}
    for k, contact in contacts.items():
        position = equations.constraints[k].position
        if not contact.stops and position is not None:
            gaps[k] = equations.graph.scaled(position, contact.sign)
    return gaps


def _with_candidates(
    charges: dict[str, Node], problem: Problem, reading: Reading
) -> tuple[str, ...]:
    """The names of the candidates' charges, which are added to the charges."""
    names = []
    for symmetry in problem.symmetries:
        name = symmetry.name
        while name in charges:
            name += "*"
        charges[name] = reading(charge_of(symmetry))
        names.append(name)
    return tuple(names)


@lru_cache(maxsize=4)
def _grid(until: float, samples: int, given: Sequence[float], every: int) -> tuple[float, ...]:
    """The times of rows, given or evenly spread, each followed by those in between."""
    # out of step with whatever the requested rows are in step with
    parts = [(k + (_GOLDEN * k % 1.0 - 0.5 if k else 0.0)) / every for k in range(every)]
    if given:
        return *(a + (b - a) * part for a, b in pairwise(given) for part in parts), until
    count = samples - 1
    return *(until * (k + part) / count for k in range(count) for part in parts), until
