"""L of a problem that gives H, in numbers: q' = dH/dp by Newton's method, L = p q' - H.

The iteration is run on jets: with the Hessian at the real point kept, every pass adds one
order of the infinitesimals to the momenta.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from mpmath import mp, mpf

from .evaluate import Moment
from .jets import Jet, Number, OutsideDomain, coefficient, family, infinitesimal, real_part
from .linear import solve

Momenta = list[Number]
Hamiltonian = Callable[[Moment], Number]

#: From several sides: the relativistic momenta are far from m v near the speed of light.
STARTS = ("0", "1", "-1", "3", "-3")
PASSES = 60


class Inverse:
    """The transform of one H; the last point solved is kept, for it is asked for many times."""

    def __init__(self, hamiltonian: Hamiltonian, names: Sequence[str]) -> None:
        self.hamiltonian = hamiltonian
        self.names = tuple(names)
        self._solved: tuple[Moment, list[mpf], list[list[mpf]]] | None = None

    def lagrangian(self, moment: Moment) -> Number:
        """The value of L, a jet where the moment holds jets."""
        p = self.momenta(moment)
        work: Number = mpf(0)
        for a, v in zip(p, moment.chain[1], strict=True):
            work = work + a * v
        return work - self.hamiltonian(_with(moment, self.names, p))

    def momenta(self, moment: Moment) -> Momenta:
        """The p at which dH/dp is the moment's q'.

        Raises
        ------
        OutsideDomain
            Where no p was found, or the second derivatives of H by them are singular there.
        """
        still = _real(moment)
        if self._solved is None or self._solved[0] != still:
            self._solved = (still, *self._real_momenta(still))
        _, real, inverse = self._solved
        p: Momenta = [*real]
        for _ in range(_order(moment)):
            lacking = _velocities_lacking(self.hamiltonian, self.names, moment, p)
            p = _corrected(p, inverse, lacking)
        return p

    def _real_momenta(self, still: Moment) -> tuple[list[mpf], list[list[mpf]]]:
        near = [self._solved[1]] if self._solved else []
        for start in [*near, *([mpf(s)] * len(self.names) for s in STARTS)]:
            p: Momenta = [*start]
            try:
                for _ in range(PASSES):
                    lacking, inverse = _lacking(self.hamiltonian, self.names, still, p)
                    p = _corrected(p, inverse, lacking)
                    if max(abs(real_part(x)) for x in lacking) < mpf(10) ** (5 - mp.dps):
                        return [real_part(a) for a in p], inverse
            except (OutsideDomain, ZeroDivisionError):
                continue
        raise OutsideDomain("no momenta have these velocities")


def _lacking(
    hamiltonian: Hamiltonian, names: Sequence[str], moment: Moment, p: Momenta
) -> tuple[Momenta, list[list[mpf]]]:
    """q' - dH/dp, and the inverse of d2H/dp2."""
    size = len(names)
    with family() as nearby:
        steps = [a + infinitesimal(nearby, j) for j, a in enumerate(p)]
        lacking = _velocities_lacking(hamiltonian, names, moment, steps)
        hessian = [[-real_part(coefficient(x, nearby, j)) for j in range(size)] for x in lacking]
    columns = []
    for j in range(size):
        unit = [mpf(i == j) for i in range(size)]
        column = solve(hessian, unit, size)
        if column.kernel:
            raise OutsideDomain("the second derivatives of H by the momenta are singular")
        columns.append(column.x)
    return [real_part(x) for x in lacking], [list(row) for row in zip(*columns, strict=True)]


def _velocities_lacking(
    hamiltonian: Hamiltonian, names: Sequence[str], moment: Moment, p: Momenta
) -> Momenta:
    with family() as nearby:
        steps = [a + infinitesimal(nearby, j) for j, a in enumerate(p)]
        value = hamiltonian(_with(moment, names, steps))
        return [v - coefficient(value, nearby, j) for j, v in enumerate(moment.chain[1])]


def _corrected(p: Momenta, inverse: list[list[mpf]], lacking: Momenta) -> Momenta:
    after = []
    for a, row in zip(p, inverse, strict=True):
        for x, entry in zip(lacking, row, strict=True):
            a = a + x * entry
        after.append(a)
    return after


def _with(moment: Moment, names: Sequence[str], p: Sequence[Number]) -> Moment:
    named = {f"p_{name}": value for name, value in zip(names, p, strict=True)}
    return replace(moment, extra={**moment.extra, **named})


def _real(moment: Moment) -> Moment:
    return Moment(
        real_part(moment.t),
        tuple(tuple(map(real_part, row)) for row in moment.chain),
        {name: real_part(x) for name, x in moment.extra.items()},
    )


def _order(moment: Moment) -> int:
    """How many families of infinitesimals the moment holds."""
    numbers = [moment.t, *(x for row in moment.chain for x in row), *moment.extra.values()]
    mask = 0
    for x in numbers:
        if isinstance(x, Jet):
            for part in x.parts:
                mask |= part
    return mask.bit_count()
