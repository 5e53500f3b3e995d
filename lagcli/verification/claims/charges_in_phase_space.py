"""The conserved quantities of a file's symmetries as functions on phase space, from L alone.

Noether's Q = sum_j p_j Dq_j - h Dt - G has a boundary term with dG/dt = K, the change of the
action.  Where the file does not give G, its derivatives follow from those of K with respect to
q' and q'':

    dG/dq_j' = dK/dq_j'',    dG/dq_j = dK/dq_j' - d/dt dK/dq_j''.

They determine the brackets of Q; the value of Q is determined up to a constant only.
"""

from __future__ import annotations

from functools import cached_property

from flint import arb

from lagcli.expression import ZERO
from lagcli.problem_data import Symmetry
from lagcli.verification.claims.boundary import change_of_action, is_total_derivative, vanish
from lagcli.verification.claims.canonical_samples import slopes_in_phase_space
from lagcli.verification.examination import Examination
from lagcli.verification.phase_points import Slopes
from lagcli.verification.states import State
from lagcli.verification.sweeps import column

_NO_VALUE = arb("nan")


class ChargeOfSymmetry:
    """Q of one symmetry of the file.

    Parameters
    ----------
    x
        The examination, of a problem with a Lagrangian.
    symmetry
        Delta q, Delta t and, where it is given, G.
    """

    def __init__(self, x: Examination, symmetry: Symmetry) -> None:
        self.x, self.symmetry = x, symmetry
        reference, program = x.reference, x.reference.program
        self._changes = [
            reference.place(symmetry.changes.get(name, ZERO)) for name in reference.names
        ]
        self._time = reference.place(symmetry.time or ZERO)
        terms = [*map(program.product, reference.momenta, self._changes)]
        terms.append(program.negative(program.product(reference.energy, self._time)))
        if symmetry.gauge is not None:
            terms.append(program.negative(reference.place(symmetry.gauge)))
        self._place = program.sum(*terms)  # Q, or Q + G
        self._at: dict[State, tuple[arb, Slopes]] = {}

    @cached_property
    def _boundary(self) -> tuple[list[int], list[int]] | None:
        """The steps of dG/dq and dG/dq'; None where they do not follow from L.

        Where K is not a total derivative, G is 0, unless it exists on the constraints alone.
        """
        x, reference, program = self.x, self.x.reference, self.x.reference.program
        nothing = [program.zero] * len(reference.names)
        if self.symmetry.gauge is not None:
            return nothing, nothing
        change = change_of_action(x, self._changes, self._time)
        if vanish(x, [change]):
            return nothing, nothing
        if not is_total_derivative(x, change):
            return None if reference.rows else (nothing, nothing)
        by_v = [reference.by(change, a) for a in reference.a]
        by_q = [
            program.sum(reference.by(change, v), program.negative(program.rate(bend)))
            for v, bend in zip(reference.v, by_v, strict=True)
        ]
        return by_q, by_v

    @property
    def known(self) -> bool:
        """Whether its derivatives follow from L."""
        return self._boundary is not None

    def at(self, s: State) -> tuple[arb, Slopes]:
        """Q and its derivatives with respect to q and p; Q has no value where only dG is known."""
        if s not in self._at:
            self._at[s] = self._at_state(s)
        return self._at[s]

    def _at_state(self, s: State) -> tuple[arb, Slopes]:
        assert self._boundary is not None
        reference = self.x.reference
        found = s.at.gradient(self._place)
        by = [
            [a - s.loose.at(b) for a, b in zip(column(found, symbols), steps, strict=True)]
            for symbols, steps in zip((reference.q, reference.v), self._boundary, strict=True)
        ]
        zero = reference.program.zero
        known = all(step == zero for steps in self._boundary for step in steps)
        value = s.at(self._place) if known else _NO_VALUE
        return value, slopes_in_phase_space(s, [(by[0], by[1])])[0]
