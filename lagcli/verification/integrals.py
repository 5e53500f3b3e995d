"""Integrals as steps: `integral(f, x, a, b)`, its derivatives by Leibniz's rule, its value.

d/dy of the integral from a to b of f dx = f(b) db/dy - f(a) da/dy + the integral of df/dy.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from flint import arb

from lagcli.expression import Expression, Name

if TYPE_CHECKING:
    from collections.abc import Callable

    from lagcli.verification.program import VerificationProgram

_NODES = 60  # of Gauss's rule on each panel: exp(-x^2) from 0 to 4 to 1e-40
_PANELS = 4


def integral(program: VerificationProgram, node: tuple[Expression, ...]) -> int:
    """The step of an integral; inside, its variable is a symbol that nothing else is."""
    integrand, variable, start, end = node
    assert isinstance(variable, Name)
    inner = program.symbol(f"{variable.name}~", variable.primes)
    with program.standing_for(variable.name, inner):
        inside = program.of(integrand)
    return step(program, inner, inside, program.of(start), program.of(end))


def step(program: VerificationProgram, inner: int, inside: int, start: int, end: int) -> int:
    """The step of the integral of a step by a symbol."""
    if inside == program.zero:
        return program.zero
    outer = [
        place
        for place in program.order([inside])
        if program.steps[place].kind == "symbol" and place != inner
    ]
    return program.step("integral", (inner, inside), (start, end, *outer))


def slopes(program: VerificationProgram, place: int) -> list[tuple[int, int]]:
    """The partial derivatives of an integral by its limits and by what stands inside."""
    _, what, (start, end, *outer) = program.steps[place]
    inner, inside = what  # type: ignore[misc]
    found = [
        (start, program.negative(substituted(program, inside, inner, start))),  # type: ignore[has-type]
        (end, substituted(program, inside, inner, end)),  # type: ignore[has-type]
    ]
    for symbol in outer:
        slope = program.derivative(inside, program.seeds(inside, symbol))  # type: ignore[has-type]
        found.append((symbol, step(program, inner, slope, start, end)))  # type: ignore[has-type]
    return found


def substituted(program: VerificationProgram, root: int, old: int, new: int) -> int:
    """The step with one step in the place of another."""
    known = {old: new}
    for place in program.order([root]):
        if place not in known:
            kind, what, parts = program.steps[place]
            moved = tuple(known[part] for part in parts)
            known[place] = place if moved == parts else program.step(kind, what, moved)
    return known[root]


def quadrature(f: Callable[[arb], arb], start: arb, end: arb) -> arb:
    """The integral of f by Gauss's rule on panels."""
    total, width = arb(0), (end - start) / _PANELS
    for panel in range(_PANELS):
        middle = start + width * (2 * panel + 1) / 2
        for x, weight in _rule():
            total = total + weight * f(middle + width * x / 2)
    return total * width / 2


@cache
def _rule() -> list[tuple[arb, arb]]:
    return [arb.legendre_p_root(_NODES, k, True) for k in range(_NODES)]
