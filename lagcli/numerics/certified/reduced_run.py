"""A simulation of the cut model: the same columns and charges by fewer coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from itertools import compress
from typing import TypeVar

from lagcli.graph.nodes import Node, mask_of
from lagcli.graph.sharing import written_out
from lagcli.numerics.equations.columns import Reading
from lagcli.numerics.equations.reduced_model import CutEquations, Reduction, cut
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.result import Cut, EliminatedCoordinate
from lagcli.numerics.hybrid.setup import Setup

AnySetup = TypeVar("AnySetup", bound=Setup)


def cut_simulation(
    simulation: AnySetup, modes: Modes, q: Sequence[float], v: Sequence[float]
) -> AnySetup | None:
    """The simulation of the request, with its initial state; None where nothing is spared.

    Contacts, and multipliers of constraints that would go, keep the model whole.
    """
    e = simulation.equations
    if simulation.margins or simulation.contacts or simulation.gaps or e.kinks:
        return None
    request = [*simulation.nodes, *([simulation.stop] if simulation.stop is not None else [])]
    multipliers = simulation.reading.multipliers
    if any(node.mask & symbol.mask for node in request for symbol in multipliers):
        return None
    names = {name.name for name in simulation.problem.initial}
    given = frozenset(j for j, symbol in enumerate(e.q) if symbol.name in names)
    try:
        found = cut(e, modes.constants, request, given)
    except ArithmeticError:
        return None
    if found is None or not _starts_exactly(simulation, found[0], q, v):
        return None
    return _reduced(simulation, *found, modes.first.conserved, q, v)


def _starts_exactly(
    simulation: Setup, equations: CutEquations, q: Sequence[float], v: Sequence[float]
) -> bool:
    """Whether the file gives what is left of the initial state, as far as it is not 0.

    What followed from the constraints is a double, however many digits are carried.
    """
    given = {(name.name, name.primes) for name in simulation.problem.initial}
    return all(
        not value or (simulation.equations.q[j].name, primes) in given
        for j in equations.coordinates
        for primes, value in ((0, q[j]), (1, v[j]))
    )


def _reduced(
    simulation: AnySetup,
    equations: CutEquations,
    reduction: Reduction,
    conserved: Sequence[bool],
    q: Sequence[float],
    v: Sequence[float],
) -> AnySetup:
    whole, put = simulation.equations, reduction.put
    left = mask_of((*equations.state, *(equations.graph.symbol(x.name, 2) for x in equations.q)))
    everything = mask_of((*whole.state, *simulation.reading.accelerations))

    def known(node: Node) -> bool:
        return not node.mask & everything & ~left

    reduced = copy(simulation)
    reduced.equations = equations
    reduced.reading = Reading(equations)
    reduced.given = frozenset(equations.place)
    reduced.nodes = [put(node) for node in simulation.nodes]
    reduced.stop = None if simulation.stop is None else put(simulation.stop)
    charges = {
        name: put(simulation.charges[name]) for name in compress(simulation.charges, conserved)
    }
    reduced.charges = {name: node for name, node in charges.items() if known(node)}
    reduced.candidates = []
    equations.evident_charges = reduced.charges
    reduced.start = ([q[j] for j in equations.coordinates], [v[j] for j in equations.coordinates])
    problem = simulation.problem
    names = [symbol.name for symbol in whole.q]
    order = [*(p.name for p in problem.parameters), *names]
    formulas = written_out([each.formula for each in reduction.solved], order)
    write = simulation.request.written
    solved = [
        EliminatedCoordinate(
            names[each.coordinate], whole.declared[each.constraint].name, write(formula)
        )
        for each, formula in zip(reduction.solved, formulas, strict=True)
    ]
    kept = set(equations.coordinates)
    left_over = [names[j] for j in equations.coordinates]
    reduced.cut = Cut(
        kept=tuple(left_over),
        eliminated=tuple(solved),
        dropped=tuple(names[j] for j in reduction.kept if j not in kept),
        ignorable=tuple(name for name in left_over if f"p_{name}" in reduced.charges),
    )
    return reduced
