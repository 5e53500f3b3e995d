"""Whether a node vanishes identically, decided by its value at random points.

At 50 digits a formula that is not 0 is not 0 there either, but for a chance that nobody
will see (Schwartz, J. ACM 27 (1980) 701).
"""

from __future__ import annotations

import random
from collections.abc import Sequence

from lagcli.graph.nodes import Constant, Node, Symbol, ancestry
from lagcli.graph.values import Digits, Program
from lagcli.mechanics.matrix_form import MatrixForm

_DIGITS = 50  # those of algebra.numeric, which would load SymPy
_POINTS = 2  # two: one may lie on a root
_ATTEMPTS = 8  # of which two are real where half of the states are


def vanish(nodes: Sequence[Node], form: MatrixForm, digits: int = _DIGITS) -> bool | None:
    """Whether all of the nodes are 0 for all values of their symbols; None: no value found."""
    if any(isinstance(node, Constant) and node.value for node in nodes):
        return False
    open_nodes = [node for node in nodes if not isinstance(node, Constant)]
    if not open_nodes:
        return True
    import mpmath

    quantities = (*form.problem.parameters, *form.problem.coordinates)
    negative = {q.name for q in quantities if q.assume == "negative"}
    with mpmath.workdps(_DIGITS + 15):
        scales = [part for node in open_nodes for part in node.parts]
        program = Program([*open_nodes, *scales], Digits(), form.functions)
        names = [
            n.name + "'" * n.primes
            for n in ancestry(open_nodes)
            if isinstance(n, Symbol) and n.mask
        ]
        source = random.Random("lagcli")
        found = 0
        for _ in range(_ATTEMPTS):
            point = {n: mpmath.mpf(source.randint(3001, 13007)) / 10007 for n in names}
            point |= {n: -x for n, x in point.items() if n in negative}
            try:
                values = program(point)
            except (ArithmeticError, ValueError):
                continue
            size = 1 + max((abs(value) for value in values[len(open_nodes) :]), default=0)
            if any(abs(v) > size * mpmath.mpf(10) ** -digits for v in values[: len(open_nodes)]):
                return False
            found += 1
            if found == _POINTS:
                return True
    return None
