"""H as a textbook writes it: kinetic and potential energy apart, p - q A in its square.

    H = (p - b) . M^-1 (p - b)/2 - L(q, 0, t),    b = dL/dq' at q' = 0

Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., equations 8.24 to 8.27.  A bracket
over everything may take fewer operations, but nobody recognises the energies in it.
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from lagcli.algebra import simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression, Name, has_nested_fraction, operation_count
from lagcli.mechanics.hamiltonian import Hamiltonian
from lagcli.mechanics.readable import Readable
from lagcli.rewriting import rebuilt

#: How many times the operations of one bracket over all the energies apart may take: 1.6 for
#: a block on a movable wedge, the widest of 52 systems of textbooks that was worth it.
_APART = 1.75


def hamiltonian_form(hamiltonian: Hamiltonian, readable: Readable) -> Expression | None:
    """The tree of H; None where it was not found.

    Raises
    ------
    ArithmeticError
        Where the inverse of M grew too long.
    """
    function = hamiltonian.function
    if function is None:
        return None
    whole = readable.as_written(function)
    if not hamiltonian.legendre.is_quadratic:
        return whole
    least = min(_apart(hamiltonian, readable), key=_length, default=whole)
    return least if operation_count(least) <= _APART * operation_count(whole) else whole


def _length(node: Expression) -> tuple[bool, int]:
    return has_nested_fraction(node), operation_count(node)


def _apart(hamiltonian: Hamiltonian, readable: Readable) -> Iterator[Expression]:
    """The energies apart: with p - b in squares, and by degree in the momenta."""
    system, velocities = hamiltonian.system, hamiltonian.velocities
    assert velocities is not None
    at_rest = dict.fromkeys(system.qdot, sympy.S.Zero)
    shifts = [p.xreplace(at_rest) for p in hamiltonian.dynamics.lagrange.momenta]
    still = -system.L.xreplace(at_rest)
    writer = Writer(system.order)
    moved = {p: p + b for p, b in zip(system.momenta, shifts, strict=True)}
    kinetic = sympy.Add(
        *(p * v.xreplace(moved) / 2 for p, v in zip(system.momenta, velocities, strict=True))
    )
    squares = readable.as_written(simplify(kinetic))
    rest = readable.by_terms(still, as_given=True)
    if all(b == 0 for b in shifts):
        yield writer.sum([squares, rest])
        return
    differences: dict[Expression, Expression] = {
        Name(p.name): readable.as_written(p - b)
        for p, b in zip(system.momenta, shifts, strict=True)
        if b != 0
    }

    def put(node: Expression) -> Expression:
        return differences[node] if node in differences else rebuilt(node, put)

    yield writer.sum([put(squares), rest])
    assert hamiltonian.function is not None
    none = dict.fromkeys(system.momenta, sympy.S.Zero)
    without = hamiltonian.function.xreplace(none)
    quadratic = simplify(kinetic)
    linear = simplify(hamiltonian.function - quadratic - without)
    if free_of(without, system.momenta):
        parts = (readable.as_written(quadratic), readable.as_written(linear))
        yield writer.sum([*parts, readable.by_terms(simplify(without))])
