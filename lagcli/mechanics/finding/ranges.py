"""For which values of a parameter p a condition lasts, or a place is reached.

The answer can change only at special values of p: where the condition, or w of u'^2 = w(u),
vanishes at the start, where two of their roots meet, or one goes to infinity.  These are
solved for exactly; between two neighbouring ones, and at each, one motion decides, at 90
digits.  This is cylindrical algebraic decomposition of the half-plane (u, p).

Other parameters are put in as numbers.  The answer holds for all of them where scalings make
every one 1, or where the special values keep their order by the signs of their differences.

References
----------
Collins, "Quantifier elimination for real closed fields by cylindrical algebraic
decomposition", Lecture Notes in Computer Science 33 (1975) 134.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.numeric import FINE_DIGITS, Evaluator
from lagcli.mechanics.finding.special_values import SpecialValues
from lagcli.mechanics.parameter_values import random_parameter
from lagcli.platform.effort import EFFORT, Work
from lagcli.record import record

_DRAWS = 6
_TRIES = 200  # a region that takes a fiftieth of the values is missed once in 50 times
_OF_MOTION = 10_000  # units of work: w(u) and its roots at 90 digits
_SAME = mpf(10) ** -30
_GIVE = "; --set gives them numbers"

Values = Mapping[Symbol, mpf]
#: The numbers of the special values at both ends, and whether each belongs to it.
Cell = tuple[int | None, int | None, bool, bool]


@record
class Bounds:
    """One interval of p; a bound that is None is that of its domain."""

    lower: Expr | None
    upper: Expr | None
    lower_included: bool
    upper_included: bool


class Undecided(Exception):
    """The answer could not be decided; the text says why."""


def ranges(
    special: SpecialValues,
    others: Sequence[Symbol],
    verdict: Callable[[Values], bool | None],
    work: Work,
    *,
    scaled: bool,
) -> list[Bounds]:
    """The values of p with which the verdict is true.

    Parameters
    ----------
    special
        The values of p at which the answer may change.
    others
        All parameters but p.
    verdict
        The answer for numbers in place of all parameters, None where they do not decide.
    work
        Undecided when none is left.
    scaled
        Whether one choice of the others stands for all.

    Raises
    ------
    Undecided
        With the reason.
    """
    source = random.Random("lagcli ranges")
    cells = _Cells(special, _draw(special, others, source, 0), verdict, work)
    pattern = cells.true_ones()
    ordered = bool(cells.order) and special.are_ordered(cells.order)
    if others and not scaled and not ordered:
        names = ", ".join(other.name for other in others)
        for k in range(1, _DRAWS):
            more = _Cells(special, _draw(special, others, source, k), verdict, work)
            if more.true_ones() != pattern:
                raise Undecided(f"which values of {special.p} these are depends on {names}{_GIVE}")
        why = f"which values of {special.p} these are was not proved for all {names}"
        raise Undecided(why + _GIVE)
    return [
        Bounds(
            None if low is None else special.roots[low],
            None if high is None else special.roots[high],
            low_included,
            high_included,
        )
        for low, high, low_included, high_included in pattern
    ]


def _draw(
    special: SpecialValues, others: Sequence[Symbol], source: random.Random, number: int
) -> Values:
    """Values of the others, with what is known to be positive.

    Raises
    ------
    Undecided
        Where none were found.
    """
    for _ in range(_TRIES):
        draw = {other: random_parameter(source, other, wide=number % 2 == 1) for other in others}
        if all(_is_positive(each, draw) for each in special.positive):
            return draw
    raise Undecided("no values of the parameters were found at which the motion can begin")


def _is_positive(expression: Expr, draw: Values) -> bool:
    if not expression.free_symbols <= draw.keys():
        return True
    [value] = Evaluator([expression], FINE_DIGITS)(draw)
    return isinstance(value, mpf) and bool(value > 0)


class _Cells:
    """The special values for one choice of the others, and what holds at and between them."""

    def __init__(
        self,
        special: SpecialValues,
        draw: Values,
        verdict: Callable[[Values], bool | None],
        work: Work,
    ) -> None:
        self.special = special
        self.draw = draw
        self.verdict = verdict
        self.work = work
        self.points: list[mpf] = []
        self.order: list[list[int]] = []
        for value, index in special.sorted_numbers(draw):
            if self.points and abs(value - self.points[-1]) < _SAME * (1 + abs(value)):
                self.order[-1].append(index)
            else:
                self.points.append(value)
                self.order.append([index])

    def true_ones(self) -> list[Cell]:
        """The longest intervals in which the verdict is true."""
        with mpmath.workdps(FINE_DIGITS):
            low, high = self.special.domain()
            samples = self._samples(low, high)
            truths = [self._decided(sample) for sample in samples]
            self._ends(low, high, truths)
        cells: list[Cell] = []
        begun: tuple[int | None, bool] | None = None
        # an interval, a point, an interval, …, an interval
        for k, true in enumerate([*truths, False]):
            point = None if k < 1 else self.order[(k - 1) // 2][0] if k < len(truths) else None
            is_point = k % 2 == 1
            if true and begun is None:
                begun = (point, is_point)
            elif not true and begun is not None:
                cells.append((begun[0], point, begun[1], not is_point and point is not None))
                begun = None
        return cells

    def _ends(self, low: mpf | None, high: mpf | None, truths: Sequence[bool]) -> None:
        """The ends of the domain that belong to it are like what is beside them."""
        p = self.special.p
        inclusive = [] if p.is_positive or low is None or self.special.angle else [(low, truths[0])]
        inclusive += [] if p.is_negative or high is None else [(high, truths[-1])]
        for end, beside in inclusive:
            if self._decided(end) is not beside:
                raise Undecided(f"{p} = {mpmath.nstr(end, 6)} is a case of its own")

    def _samples(self, low: mpf | None, high: mpf | None) -> list[mpf]:
        points = self.points
        if not points:
            return [_between(low, high)]
        samples = [_between(low, points[0]), points[0]]
        for one, other in pairwise(points):
            samples += [(one + other) / 2, other]
        return [*samples, _between(points[-1], high)]

    def _decided(self, sample: mpf) -> bool:
        if self.work.over:
            raise Undecided("it would take too much work")
        EFFORT.done += _OF_MOTION
        found = self.verdict({**self.draw, self.special.p: sample})
        if found is None:
            number = mpmath.nstr(sample, 6)
            raise Undecided(f"the motion with {self.special.p} = {number} could not be followed")
        return found


def _between(low: mpf | None, high: mpf | None) -> mpf:
    if low is None:
        return mpf(1) if high is None else high - abs(high) - 1
    return low + abs(low) + 1 if high is None else (low + high) / 2
