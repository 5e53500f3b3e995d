"""The conserved charges of a mode: those that are evident, and the candidates of the file.

A candidate's charge is p Delta q - h Delta t - gauge.  Whether it is conserved is tested on
numbers: its rate along the motion, at random states on the constraints, beside the terms
that the rate is the sum of.  A gauge that the file leaves out is not searched for.

The change of a charge is measured against what it is the sum of: m x y' - m y x' against
|m x y'| + |m y x'|, in whatever units, whether it is 0 or not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from random import Random
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Constant, Graph, Node, Product, Sum, Symbol
from lagcli.numerics.equations.arithmetic import Doubles
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.motion import Motion
from lagcli.numerics.equations.surface import Surface
from lagcli.numerics.hybrid.mark import Mark
from lagcli.numerics.hybrid.setup import Setup

_ATTEMPTS, _ENOUGH = 40, 6
_ZERO = 1e-9
_SPREAD = 0.4
_PROJECTIONS, _ON_SURFACE = 8, _ZERO**1.25
_LOOKS = 8


def conserved_charges(setup: Setup, motion: Motion) -> set[str]:
    """The names of those charges of a setup that are conserved in one mode's motion."""
    equations = motion.equations
    found = set(equations.evident_charges) & set(setup.charges)
    request = [name for name in setup.candidates if name in setup.charges]
    if not request:
        return found
    graph = equations.graph
    solved = setup.reading.accelerations
    rates = [
        *((equations.t, graph.one),),
        *zip(equations.q, equations.qdot, strict=True),
        *zip(equations.qdot, solved, strict=True),
    ]
    terms = [
        graph.product(partial(graph, x)(setup.charges[name]), rate)
        for name in request
        for x, rate in rates
    ]
    function = motion.function(terms, solved)
    signs = list(motion.signs)
    good, left = 0, set(request)
    for t, q, v in _states(setup, motion):
        try:
            if motion.kinks:
                motion.set_signs(t, q, v)
            values = [float(x) for x in function(t, *q, *v, *motion.accelerations(t, *q, *v))]
        except (ArithmeticError, ValueError):
            continue
        for place, name in enumerate(request):
            part = values[place * len(rates) : (place + 1) * len(rates)]
            if not abs(sum(part)) <= _ZERO * sum(map(abs, part)):
                left.discard(name)
        good += 1
        if good == _ENOUGH or not left:
            break
    motion.signs[:] = signs
    return found | left if good == _ENOUGH else found


def _states(setup: Setup, motion: Motion) -> Iterator[tuple[float, list[float], list[float]]]:
    """Random states near the initial one, on the constraints; the same ones in every run."""
    q0, v0 = setup.start
    number = Random(20011).random
    for _ in range(_ATTEMPTS):
        t = setup.request.until * number()
        q = [x + _SPREAD * (2 * number() - 1) * (abs(x) or 1.0) for x in q0]
        v = [x + _SPREAD * (2 * number() - 1) * max(abs(x), 1.0) for x in v0]
        if motion.equations.rows:
            state = Surface(motion).nearest(t, q, v, _PROJECTIONS, _ON_SURFACE)
            if state is None:
                continue
            q, v = state
        if all(c.allows(x) for c, x in zip(setup.problem.coordinates, q, strict=True)):
            yield t, q, v


def size(graph: Graph, node: Node, known: dict[Node, Node] | None = None) -> Node:
    """The sum of the absolute values of a formula's terms, those of its factors among them.

    `known` has those of the nodes met before.
    """
    known = {} if known is None else known
    if node not in known:
        known[node] = _size(graph, node, known)
    return known[node]


def _size(graph: Graph, node: Node, known: dict[Node, Node]) -> Node:
    match node:
        case Constant(value=value):
            return graph.constant(abs(value))
        case Sum(constant=constant, terms=terms):
            sizes = [(size(graph, term, known), abs(c)) for term, c in terms]
            return graph.combination([*sizes, (graph.one, abs(constant))])
        case Product(factors=factors):
            return graph.monomial(
                (size(graph, base, known) if e > 0 else graph.call("abs", (base,)), e)
                for base, e in factors
            )
        case _:
            return graph.call("abs", (node,))


class Sizes:
    """What the charges of a mode are measured against.

    Parameters
    ----------
    equations
        Their graph and state.
    charges
        The formulas.
    constants
        The values of the parameters.
    """

    def __init__(
        self, equations: EquationsOfMotion, charges: Sequence[Node], constants: Mapping[Symbol, Any]
    ) -> None:
        self._charges = len(charges)
        known: dict[Node, Node] = {}
        sizes = [size(equations.graph, each, known) for each in charges]
        doubles = {symbol: float(value) for symbol, value in constants.items()}
        motion = Motion(equations, doubles, Doubles())
        self._sizes = motion.function(sizes)
        self._last: tuple[Sequence[Mark], list[int], list[float]] | None = None

    def largest(self, marks: Sequence[Mark], places: Sequence[int]) -> list[float]:
        """Of each charge the largest at some of the rows of a phase."""
        looks = [*places[:: max(1, len(places) // _LOOKS)], places[-1]]
        if self._last is None or self._last[0] is not marks or self._last[1] != looks:
            self._last = marks, looks, self._largest(marks, looks)
        return self._last[2]

    def _largest(self, marks: Sequence[Mark], places: Sequence[int]) -> list[float]:
        found = [0.0] * self._charges
        for place in places:
            mark = marks[place]
            try:
                now = self._sizes(*map(float, (mark.t, *mark.q, *mark.v)))
            except (ArithmeticError, ValueError):
                continue
            found = [max(pair) for pair in zip(found, now, strict=True)]
        return found
