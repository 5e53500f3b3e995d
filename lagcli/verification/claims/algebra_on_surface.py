"""Counts of charges under constraints: gradients and brackets on the surface.

With the constraints phi_a(q, p) = 0, both f = 0 and f' = 0 of each, Dirac's bracket is

    {f, g}_D = {f, g} - {f, phi_a} C^-1_ab {phi_b, g},    C_ab = {phi_a, phi_b}

(P. A. M. Dirac, *Lectures on Quantum Mechanics* (1964), lecture 2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from itertools import islice

from flint import arb

from lagcli.verification.claims.algebra import Counted, rank_of
from lagcli.verification.claims.canonical_samples import CanonicalSample
from lagcli.verification.examination import LOOKED_AT, STATES, Examination
from lagcli.verification.linear import Unclear, dot, solve


class OnSurface(Counted):
    """A section beside what states on the constraints say."""

    @classmethod
    def sampled(cls, x: Examination, places: Sequence[int]) -> Sequence[CanonicalSample]:
        """Samples of the charges and of the constraints."""
        rows = x.reference.rows
        forms = [row.value for row in rows if row.holonomic] + [row.velocity for row in rows]
        return list(islice(_samples(x, [*places, *forms]), STATES))

    @property
    def forms(self) -> range:
        """The numbers of the constraints among the functions."""
        return range(self.count, len(self.samples[0].slopes))

    @property
    def freedom(self) -> int:
        """The dimension of the surface of the positions."""
        holonomic = sum(row.holonomic for row in self.x.reference.rows)
        return len(self.x.reference.names) - self._rank(self.forms[:holonomic])

    def _rank(self, which: Iterable[int]) -> int:
        chosen = list(which)
        return max(rank_of(s, chosen) for s in self.samples)

    def _rank_of_values(self) -> int:
        return self.count  # the samples do not share their parameters

    def _rank_of_slopes(self, which: Iterable[int]) -> int:
        return self._rank([*which, *self.forms]) - self._rank(self.forms)

    def _commute(self, i: int, j: int) -> bool:
        return all(self._vanishes(s, i, j) for s in self.samples)

    def _vanishes(self, s: CanonicalSample, i: int, j: int) -> bool:
        C = [[s.bracket(a, b) for b in self.forms] for a in self.forms]
        try:
            inner = solve(C, [s.bracket(a, j) for a in self.forms], len(self.forms)).x
        except Unclear:
            return False
        outer = [s.bracket(i, a) for a in self.forms]
        terms = [abs(a * b) for a, b in zip(outer, inner, strict=True)]
        whole = s.bracket(i, j) - dot(outer, inner)
        return bool(abs(whole).mid() < 1e-9 * (1 + sum(terms, arb(0)).mid()))

    def _has_name(self, name: str) -> bool:
        del name
        return True


def _samples(x: Examination, functions: Sequence[int]) -> Iterator[CanonicalSample]:
    for state in x.states(LOOKED_AT):
        with suppress(Unclear):
            sample = CanonicalSample(state, functions)
            if sample.finite:
                yield sample
