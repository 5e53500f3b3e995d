"""Constant coefficients with which given vectors of functions add up to zero."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import derivative, dot
from lagcli.mechanics.discovery.exact import ExactSolver
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import (
    PRIME,
    NoPoint,
    independent,
    kernel_modulo,
    pivot_columns,
)
from lagcli.mechanics.discovery.tree import Tree

Vector = Sequence[Expr]


class Relation:
    """Vectors of functions of some variables over the field of the constants.

    Parameters
    ----------
    vectors
        Each of the same length.
    variables
        All other symbols are constants.
    more
        Other functions, of which `tree` has values too.
    """

    def __init__(
        self,
        vectors: Sequence[Sequence[Expr]],
        variables: Sequence[Symbol],
        allowed: Allowance,
        more: Sequence[Expr] = (),
    ) -> None:
        self.vectors = [list(v) for v in vectors]
        self.unsolved = 0  # combinations that `beyond` knows modulo the prime only
        self.tree = Tree([*more, *(e for v in self.vectors for e in v)], variables, allowed)

    def rows(self, count: int) -> list[list[int]]:
        """At least this number of rows of values, modulo a prime; columns are the vectors."""
        return self.tree.rows(self.vectors, count)

    def independent(self) -> list[int]:
        """The vectors that are no combinations of earlier ones."""
        return pivot_columns(self.rows(len(self.vectors) + 8))

    def kernel(self, components: int = 1) -> list[dict[int, int]]:
        """A basis of the relations modulo the prime: each has one vector that no other has.

        The rows are drawn for a rank of this number of components of the vectors.
        """
        width = len(self.vectors)
        return kernel_modulo(self.rows((width + 8) * components), width)[1]

    def beyond(
        self,
        values: Sequence[Sequence[Expr]],
        known: Sequence[Sequence[Expr]] = (),
        components: int = 0,
    ) -> list[dict[int, Expr]]:
        """Those that make combinations of `values` beyond the known functions and earlier ones."""
        kernel = self.kernel(components or len(self.vectors[0]))[::-1]
        count = (len(known) + len(kernel) + 8) * len(values[0])  # components may be dependent
        table = self.tree.rows([*known, *values], count)
        found = [self.exact(vector) for vector in independent(table, len(known), kernel)]
        self.unsolved = found.count(None)
        return [c for c in found if c is not None]

    def exact(self, vector: dict[int, int]) -> dict[int, Expr] | None:
        """The coefficients of one of them; None where they were not found."""
        return self._solver.of(vector, self.vectors.__getitem__)

    @cached_property
    def _solver(self) -> ExactSolver:
        return ExactSolver(self.tree.points)

    def all(self) -> Iterator[dict[int, Expr]]:
        """Those of the basis whose coefficients were found."""
        return (c for vector in self.kernel() if (c := self.exact(vector)) is not None)

    def of_last(self) -> list[Expr] | None:
        """c with sum c_k vector_k + (last vector) = 0, or None; checked by the caller."""
        last = len(self.vectors) - 1
        try:
            vector = next((v for v in self.kernel() if last in v), None)
            if vector is not None and not self._holds(vector):
                # one component tells all, as the slope by t beside those by x, y and z
                kernel = self.kernel(len(self.vectors[0]))
                vector = next((v for v in kernel if last in v), None)
            known = None if vector is None else self.exact(vector)
        except (NoPoint, ZeroDivisionError):
            return None
        if not known or known[last] == 0:
            return None
        return [known.get(i, sympy.S.Zero) / known[last] for i in range(last)]

    def _holds(self, vector: dict[int, int]) -> bool:
        """Whether the combination vanishes at a new point as well."""
        rows = self.rows(1)
        return not any(sum(c * row[k] for k, c in vector.items()) % PRIME for row in rows)


def with_gradient(
    slopes: Vector, candidates: Vector, variables: Sequence[Symbol], allowed: Allowance
) -> Expr | None:
    """The combination of the candidates with these derivatives by the variables, if any."""
    columns = [[derivative(c, x) for x in variables] for c in candidates]
    values = Relation([*columns, [-f for f in slopes]], variables, allowed).of_last()
    return None if values is None else dot(candidates, values)
