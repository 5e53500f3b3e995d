"""Counts of charges under constraints: gradients and brackets on the surface.

With the constraints phi_a(q, p) = 0, both f = 0 and f' = 0 of each, Dirac's bracket is

    {f, g}_D = {f, g} - {f, phi_a} C^-1_ab {phi_b, g},    C_ab = {phi_a, phi_b}

(P. A. M. Dirac, *Lectures on Quantum Mechanics* (1964), lecture 2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import islice

from flint import arb

from lagcli.verification.claims.algebra import Counted, rank_of
from lagcli.verification.claims.canonical_samples import CanonicalSample, around_states
from lagcli.verification.examination import LOOKED_AT, STATES, Examination
from lagcli.verification.linear import Unclear, dot, rank, solve
from lagcli.verification.states import State


class OnConstraints(CanonicalSample):
    """A state on the constraints, with the functions in front of the forms phi_a."""

    def __init__(self, state: State, functions: Sequence[int]) -> None:
        rows = state.reference.rows
        forms = [row.value for row in rows if row.holonomic] + [row.velocity for row in rows]
        super().__init__(state, [*functions, *forms])
        self.forms = range(len(functions), len(functions) + len(forms))

    @property
    def regular(self) -> bool:
        """Whether the momenta determine the velocities without the constraints."""
        laws = self.state.laws
        return rank(laws.mass_matrix, laws.size) == laws.size

    @cached_property
    def _between_forms(self) -> list[list[arb]]:
        """C, of which all brackets at this state have the inverse."""
        poisson = super().bracket
        return [[poisson(a, b) for b in self.forms] for a in self.forms]

    def bracket(self, i: int, j: int) -> arb:
        """Dirac's."""
        return self.terms(i, j)[0]

    def terms(self, i: int, j: int) -> tuple[arb, arb]:
        """{f_i, f_j}_D, and the size of what it is the sum of.

        Raises
        ------
        Unclear
            Where the constraints depend on each other.
        """
        poisson, forms = super().bracket, self.forms
        inner = solve(self._between_forms, [poisson(a, j) for a in forms], len(forms)).x
        outer = [poisson(i, a) for a in forms]
        sizes = (abs(a * b) for a, b in zip(outer, inner, strict=True))
        return poisson(i, j) - dot(outer, inner), sum(sizes, arb(0))


class OnSurface(Counted):
    """A section beside what states on the constraints say."""

    samples: Sequence[OnConstraints]

    @classmethod
    def sampled(cls, x: Examination, places: Sequence[int]) -> Sequence[OnConstraints]:
        """Samples of the charges and of the constraints."""
        return list(islice(_samples(x, places), STATES))

    @property
    def forms(self) -> range:
        """The numbers of the constraints among the functions."""
        return self.samples[0].forms

    @property
    def freedom(self) -> int:
        """The dimension of the surface of the positions."""
        holonomic = sum(row.holonomic for row in self.x.reference.rows)
        return len(self.x.reference.names) - self._rank(self.forms[:holonomic])

    @property
    def states(self) -> int:
        """The dimension of the surface of the states."""
        return 2 * len(self.x.reference.names) - self._rank(self.forms)

    def _rank(self, which: Iterable[int]) -> int:
        chosen = list(which)
        return max(rank_of(s, chosen) for s in self.samples)

    def _rank_of_values(self) -> int:
        return self.count  # the samples do not share their parameters

    def _rank_of_slopes(self, which: Iterable[int]) -> int:
        return self._rank([*which, *self.forms]) - self._rank(self.forms)

    def _commute(self, i: int, j: int) -> bool:
        return all(self._vanishes(s, i, j) for s in self.samples)

    def _vanishes(self, s: OnConstraints, i: int, j: int) -> bool:
        try:
            whole, terms = s.terms(i, j)
        except Unclear:
            return False
        return bool(abs(whole).mid() < 1e-9 * (1 + terms.mid()))

    def _around(self, count: int) -> Iterator[Sequence[OnConstraints]]:
        """Where the charges and 1 are independent on the constraints, and M and C are regular."""
        for around in around_states(self.x, self.places, count, OnConstraints):
            rows = [[*s.values[: self.count], arb(1)] for s in around]
            with suppress(Unclear):
                independent = rank(rows, self.count + 1) == self.count + 1
                if independent and around[0].regular and around[0].terms(0, 0):
                    yield around


def _samples(x: Examination, functions: Sequence[int]) -> Iterator[OnConstraints]:
    for state in x.states(LOOKED_AT):
        with suppress(Unclear):
            sample = OnConstraints(state, functions)
            if sample.finite:
                yield sample
