"""Integrals of rational functions times the root of a quadratic.

With Q = a + b u + c u^2 and v = u - p, Q = A + B v + c v^2, all that occurs is

    int sqrt(Q) du = (2 c u + b)/(4 c) sqrt(Q) + (4 a c - b^2)/(8 c) J,
    int u sqrt(Q) du = Q^(3/2)/(3 c) - b/(2 c) int sqrt(Q) du,
    int sqrt(Q)/v du = sqrt(Q) + A K + B/2 J,
    int sqrt(Q)/v^2 du = -sqrt(Q)/v + B/2 K + c J,
    int sqrt(Q)/(u^2 - P) du = c J + (a + c P) int dt/((a + c P) t^2 - P),  b = 0,  t = u/sqrt(Q)

    J = int du/sqrt(Q)     = -atan((c u + b/2)/(k sqrt(Q)))/k,  c = -k^2
                           = log|c u + b/2 + k sqrt(Q)|/k,      c = k^2
    K = int du/(v sqrt(Q)) = atan((A + B v/2)/(l sqrt(Q)))/l,   A = -l^2
                           = -log|(A + B v/2 + l sqrt(Q))/v|/l, A = l^2

These are even in k and l, so that a root of either sign may be taken.

References
----------
Gradshteyn, Ryzhik, *Table of Integrals, Series, and Products*, 7th ed., section 2.26.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy
from sympy import Abs, Expr, S, Symbol

from lagcli.algebra import simplify
from lagcli.mechanics.reduction.known_signs import KnownSigns

#: sqrt(Q) within a formula.
ROOT = Symbol("#R", positive=True)
#: (what stands before, the kind, its pole p or the square P)
Part = tuple[Expr, str, Expr]


class Integrals:
    """The integrals of the module's table for one Q."""

    def __init__(self, Q: sympy.Poly, known: KnownSigns) -> None:
        self.u, self.known = Q.gen, known
        self.a, self.b, self.c = (Q.coeff_monomial(self.u**n) for n in range(3))

    def of(self, parts: Sequence[Part]) -> tuple[Expr, ...]:
        """The terms of the sum of the parts, all of whose signs are known."""
        collected: dict[Expr, Expr] = {}
        for factor, kind, p in parts:
            for term, coefficient in self._integral(kind, p):
                collected[term] = collected.get(term, S.Zero) + factor * coefficient
        simple = {term: simplify(c) for term, c in collected.items()}
        return tuple(c * term for term, c in simple.items() if c != 0)

    def sign(self, expression: Expr) -> int | None:
        """The sign of what decides."""
        return 0 if expression == 0 else self.known.sign(expression)

    def deciding(self, parts: Sequence[Part]) -> Iterator[Expr]:
        """What decides by its sign which form an integral has."""
        yield self.c
        for _, kind, p in parts:
            if kind.startswith("1/v"):
                yield self._at(p)
            elif kind == "pair":
                yield self._at_square(p)
                yield p

    def _at(self, p: Expr) -> Expr:
        return simplify(self.a + self.b * p + self.c * p**2)

    def _at_square(self, P: Expr) -> Expr:
        return simplify(self.a + self.c * P)

    def _integral(self, kind: str, p: Expr) -> list[tuple[Expr, Expr]]:
        """The terms (function, coefficient) of one integral."""
        a, b, c, u = self.a, self.b, self.c, self.u
        if kind == "1" and c == 0:
            return [(ROOT**3, 2 / (3 * b))]
        if kind == "1":
            return [
                ((2 * c * u + b) * ROOT, 1 / (4 * c)),
                *_times(self._J(), (4 * a * c - b**2) / (8 * c)),
            ]
        if kind == "u" and c == 0:
            return [(ROOT**5, 2 / (5 * b**2)), (ROOT**3, -2 * a / (3 * b**2))]
        if kind == "u":
            return [(ROOT**3, 1 / (3 * c)), *_times(self._integral("1", p), -b / (2 * c))]
        if kind == "pair":
            D = self._at_square(p)
            return [*_times(self._J(), c), *_times(self._T(D, p), D)]
        v, A, B = u - p, self._at(p), simplify(b + 2 * c * p)
        if kind == "1/v^1":
            return [(ROOT, S.One), *_times(self._K(v, A, B), A), *_times(self._J(), B / 2)]
        return [(ROOT / v, -S.One), *_times(self._K(v, A, B), B / 2), *_times(self._J(), c)]

    def _J(self) -> list[tuple[Expr, Expr]]:
        b, c, u = self.b, self.c, self.u
        if c == 0:
            return [(ROOT, 2 / b)]
        above = c * u + b / 2
        if self.sign(c) == -1:
            k = root_of(-c)
            return [(sympy.atan(simplify(-above / k) / ROOT), 1 / k)]
        k = root_of(c)
        return [(sympy.log(above + k * ROOT), 1 / k)]

    def _K(self, v: Expr, A: Expr, B: Expr) -> list[tuple[Expr, Expr]]:
        if A == 0:
            return [(ROOT / v, -2 / B)]
        above = sympy.expand(A + B * v / 2)
        if self.sign(A) == -1:
            length = root_of(-A)
            return [(sympy.atan(simplify(above / length) / ROOT), 1 / length)]
        length = root_of(A)
        return [(sympy.log((above + length * ROOT) / v), -1 / length)]

    def _T(self, D: Expr, P: Expr) -> list[tuple[Expr, Expr]]:
        """int dt/(D t² - P), t = u/sqrt(Q)."""
        if D == 0:
            return [(self.u / ROOT, -1 / P)]
        first, second = self.sign(D) or 1, self.sign(P) or 1
        s, p = root_of(first * D), root_of(second * P)
        if first != second:
            return [(sympy.atan(simplify(s / p) * self.u / ROOT), first / (s * p))]
        return [(sympy.log((s * self.u - p * ROOT) / (s * self.u + p * ROOT)), first / (2 * s * p))]


def _times(terms: Sequence[tuple[Expr, Expr]], factor: Expr) -> list[tuple[Expr, Expr]]:
    return [(term, factor * coefficient) for term, coefficient in terms]


def root_of(expression: Expr) -> Expr:
    """A square root, of either sign where the radicand is a square."""
    return sympy.sqrt(simplify(expression)).replace(Abs, lambda inside: inside)
