"""What terms have in common: a product of atoms, a bracket that occurs twice."""

from __future__ import annotations

from math import gcd
from typing import TypeAlias

from lagcli.algebra.shaping.atoms import Exponent, Term, multiply

Integers: TypeAlias = dict[Term, int]


def common_brackets(halves: list[tuple[Integers, Integers]]) -> list[tuple[Integers, Integers]]:
    """a*K and every b*K among the other terms, apart from the rest: (a + b)*K + rest.

    The one that saves most; none where no K occurs twice.
    """
    best: list[tuple[Integers, Integers]] = []
    most = 0
    for some, others in halves:
        size = len(some)
        if size < 2 or (size + len(others)) // size * (size - 1) <= most + size - 1:
            continue
        _, _, kernel = content(some, spread=False)
        first, *_ = kernel
        inverse = tuple((atom, -exponent) for atom, exponent in first)
        left, taken = dict(others), dict(some)
        for term, value in others.items():
            if value % kernel[first] or term not in left:
                continue
            factor, number = multiply(term, inverse), value // kernel[first]
            if all(left.get(multiply(factor, t)) == number * c for t, c in kernel.items()):
                for each in kernel:
                    whole = multiply(factor, each)
                    taken[whole] = left.pop(whole)
        saved = (len(taken) // size - 1) * (size - 1)
        if left and saved > most:
            best, most = [(taken, left)], saved
    return best


def content(terms: Integers, spread: bool) -> tuple[Term, int, Integers]:
    """A common product of atoms, a common number, and what is left of the terms."""
    shared: dict[int, list[Exponent]] = {}
    for term in terms:
        for atom, exponent in term:
            if atom in shared:
                shared[atom].append(exponent)
            else:
                shared[atom] = [exponent]
    common: list[tuple[int, Exponent]] = []
    for atom, exponents in shared.items():
        everywhere = len(exponents) == len(terms)
        low = min(exponents)
        if low > 0:
            if everywhere:
                common.append((atom, low))
        elif not spread:
            common.append((atom, low))
        elif everywhere and max(exponents) < 0:
            common.append((atom, max(exponents)))
    number = gcd(*terms.values())
    if not common and number == 1:
        return (), 1, terms
    common.sort()
    inverse = tuple((atom, -exponent) for atom, exponent in common)
    inner = {multiply(term, inverse): value // number for term, value in terms.items()}
    return tuple(common), number, inner
