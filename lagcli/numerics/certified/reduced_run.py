"""The setup of the cut model: the same columns and charges by fewer coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import compress

from lagcli.graph.nodes import Node, mask_of
from lagcli.graph.sharing import written_out
from lagcli.numerics.equations.columns import Reading
from lagcli.numerics.equations.reduced_model import CutEquations, Reduction, cut
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.result import Cut, EliminatedCoordinate
from lagcli.numerics.hybrid.setup import Setup
from lagcli.record import replace


def cut_setup(setup: Setup, modes: Modes) -> Setup | None:
    """The same request of the cut model; None where nothing is spared.

    Contacts, and multipliers of constraints that would go, keep the model whole.
    """
    e = setup.equations
    if setup.margins or setup.contacts or setup.gaps or e.kinks:
        return None
    request = [*setup.nodes, *([setup.stop] if setup.stop is not None else [])]
    multipliers = setup.reading.multipliers
    if any(node.mask & symbol.mask for node in request for symbol in multipliers):
        return None
    names = {name.name for name in setup.problem.initial}
    given = frozenset(j for j, symbol in enumerate(e.q) if symbol.name in names)
    try:
        found = cut(e, modes.constants, request, given)
    except ArithmeticError:
        return None
    if found is None or not _starts_exactly(setup, found[0]):
        return None
    return _reduced(setup, *found, modes.first.conserved)


def _starts_exactly(setup: Setup, equations: CutEquations) -> bool:
    """Whether the file gives what is left of the initial state, as far as it is not 0.

    What followed from the constraints is a double, however many digits are carried.
    """
    given, (q, v) = {(name.name, name.primes) for name in setup.problem.initial}, setup.start
    return all(
        not value or (setup.equations.q[j].name, primes) in given
        for j in equations.coordinates
        for primes, value in ((0, q[j]), (1, v[j]))
    )


def _reduced(
    setup: Setup, equations: CutEquations, reduction: Reduction, conserved: Sequence[bool]
) -> Setup:
    whole, put, (q, v) = setup.equations, reduction.put, setup.start
    left = mask_of((*equations.state, *(equations.graph.symbol(x.name, 2) for x in equations.q)))
    everything = mask_of((*whole.state, *setup.reading.accelerations))

    def known(node: Node) -> bool:
        return not node.mask & everything & ~left

    charges = {name: put(setup.charges[name]) for name in compress(setup.charges, conserved)}
    charges = {name: node for name, node in charges.items() if known(node)}
    equations.evident_charges = charges
    problem = setup.problem
    names = [symbol.name for symbol in whole.q]
    order = [*(p.name for p in problem.parameters), *names]
    formulas = written_out([each.formula for each in reduction.solved], order)
    write = setup.request.written
    solved = [
        EliminatedCoordinate(
            names[each.coordinate], whole.declared[each.constraint].name, write(formula)
        )
        for each, formula in zip(reduction.solved, formulas, strict=True)
    ]
    kept = set(equations.coordinates)
    left_over = [names[j] for j in equations.coordinates]
    return replace(
        setup,
        equations=equations,
        reading=Reading(equations),
        given=frozenset(equations.place),
        nodes=tuple(map(put, setup.nodes)),
        stop=None if setup.stop is None else put(setup.stop),
        charges=charges,
        candidates=(),
        start=([q[j] for j in equations.coordinates], [v[j] for j in equations.coordinates]),
        cut=Cut(
            kept=tuple(left_over),
            eliminated=tuple(solved),
            dropped=tuple(names[j] for j in reduction.kept if j not in kept),
            ignorable=tuple(name for name in left_over if f"p_{name}" in charges),
        ),
    )
