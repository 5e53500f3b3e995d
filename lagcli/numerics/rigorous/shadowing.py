r"""Shadowing: an exact motion that stays at rows for longer than the file's own can be followed.

Points y_0 .. y_N follow one another by steps with small errors.  For states in a box about y_k,
the flow over a step obeys

    phi_k(y_k + Q_k x) in y_(k+1) + Q_(k+1) (d_k + R_k x),        |x| <= b,

with Q_k orthogonal and R_k upper triangular up to the radii of its enclosure: one QR decomposition
after another, whose diagonal has the growth of errors, the fastest first.  A motion through
y_k + Q_k x_k for all k is a fixed point of the map that gives, with g = d_k + R_k x_k,

    x_(k+1),i  the value  g_i                             where errors do not grow,  x_0,i = 0;
    x_k,i      the value  x_k,i + (x_(k+1),i - g_i)/r_i   where they do,             x_N,i = 0,

r_i the middle of the diagonal.  Where boxes |x_k,i| <= rho_k,i <= b contain the bounds of their
images there is one, by Brouwer's theorem.

References
----------
S.-N. Chow, K. Palmer, "On the numerical computation of orbits of dynamical systems: the
one-dimensional case", J. Complexity 8 (1992) 398.
B. Coomes, H. Koçak, K. Palmer, "Rigorous computational shadowing of orbits of ordinary
differential equations", Numer. Math. 69 (1995) 401.
P. Zgliczyński, M. Gidea, "Covering relations for multidimensional dynamical systems", J.
Differential Equations 202 (2004) 32.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.rigorous.enclosure import NotEnclosed, ShortSteps
from lagcli.numerics.rigorous.modes import ProofMode
from lagcli.numerics.rigorous.piece import Piece
from lagcli.numerics.rigorous.proof import ProofAttempt
from lagcli.numerics.rigorous.sets import LohnerSet, orthonormal
from lagcli.record import record

#: b beside the largest component at the beginning is 2 to minus this part of the bits.
_TRIAL = 0.65
#: Bounds in doubles are widened by more than they round, in each step.
_WIDER = 1 + 1e-9
#: Below the diagonal of R is only its radius: rounds, and what is taken for its part in the next.
_SWEEPS, _ROOM = 12, 1.1
#: Q beside K, and the error of a step beside the usual one, which makes it shorter: what is left of
#: the flow couples the axes in every step, by 4e-12 of a double pendulum instead of 2e-5.
_FLOW_ORDER, _FINER = 0.7, 2.0**-30


@record
class SplitStep:
    """A step with its contracting and expanding directions apart: d and R.

    Attributes
    ----------
    defect : arb_mat
        Shape (n, 1).
    map : arb_mat
        Shape (n, n).
    """

    defect: Any
    map: Any


class Shadowing(ProofAttempt):
    """A shadow of one pseudo-orbit, at a given precision."""

    def _go(self) -> None:
        t, start, mode, _ = self._begin()
        if self.setup.equations.rows or mode.watched:
            message = "a motion with constraints, contacts or switches is not shadowed"
            raise Refusal(message, mistake=False)
        trial = max(1.0, *(abs(float(x)) for x in start.middle)) * 2.0 ** (-_TRIAL * self.bits)
        box = _around_zero(start, [trial] * len(start.middle))
        links: list[SplitStep] = []
        pieces: dict[int, Piece] = {}
        ended: NotEnclosed | None = None
        try:
            self._follow(t, box, mode, links, pieces)
        except NotEnclosed as reason:
            ended = reason
        if ended is not None and not links:
            raise ended
        radii = bounds(links)
        if not (max(map(max, radii)) <= trial and hold(links, radii)):
            raise ShortSteps("no motion was found near the computed one")
        offsets = [float(x.rad()) + y for x, y in zip(start.box, radii[0], strict=True)]
        self.within = _WIDER * max(offsets)  # Q_0 = 1
        for k, piece in pieces.items():
            self.rows.over(_near(piece, radii[k]), mode, None)
        if ended is not None:
            raise ended

    def _follow(
        self,
        t: Any,
        here: LohnerSet,
        mode: ProofMode,
        links: list[SplitStep],
        pieces: dict[int, Piece],
    ) -> None:
        """All steps, and those in which rows are."""
        times, row = self.rows.times, 0
        last = times[-1].upper()
        mode.enclosures.flow_order = round(_FLOW_ORDER * self.order)
        mode.enclosures.target *= _FINER
        while row < len(times):
            piece = mode.enclosures.step(t, here, last)
            while row < len(times) and not times[row] > piece.end:
                pieces[len(links)] = piece
                row += 1
            link, here = _linked(piece)
            links.append(link)
            self._count(piece, mode)
            t = piece.end


def _linked(piece: Piece) -> tuple[SplitStep, LohnerSet]:
    """d and R of a step, and the box about the next point."""
    found = piece.middle(piece.end)
    points = [x.mid() for x in found]
    turned = piece.derivative(piece.end) * piece.start.frame
    frame, inverse = orthonormal(turned, range(len(points)))
    column = type(frame)(len(points), 1, [x - y for x, y in zip(found, points, strict=True)])
    link = SplitStep(inverse * column, inverse * turned)
    return link, LohnerSet(points, frame, piece.start.radii)


def _around_zero(start: LohnerSet, radii: Sequence[float]) -> LohnerSet:
    """The box |x_i| <= radius_i in the axes of a set."""
    ball, matrix = type(start.middle[0]), type(start.frame)
    column = matrix(len(radii), 1, [ball(0, x) for x in radii])
    return LohnerSet(start.middle, start.frame, column)


def _near(piece: Piece, radii: Sequence[float]) -> Piece:
    """The same step from a smaller box."""
    start = _around_zero(piece.start, radii)
    return Piece(piece.begin, piece.end, piece.centre, piece.flow, start)


def bounds(links: Sequence[SplitStep]) -> list[list[float]]:
    """rho_k of every point, shape (N + 1, n), which `hold` is to confirm."""
    n = links[0].map.nrows()
    defects = [[float(x.abs_upper()) for x in link.defect.entries()] for link in links]
    maps = [[[float(x.abs_upper()) for x in row] for row in link.map.tolist()] for link in links]
    found = [[0.0] * n for _ in range(len(links) + 1)]
    for _ in range(_SWEEPS):
        before = [[_ROOM * x for x in row] for row in found]
        for i in reversed(range(n)):
            rests = [
                d[i] + sum(row[i][j] * (rho[j] if j > i else old[j]) for j in range(n) if j != i)
                for d, row, rho, old in zip(defects, maps, found, before, strict=False)
            ]
            diagonal = [row[i][i] for row in maps]
            if _grows(diagonal):
                for k in reversed(range(len(links))):
                    own = float(links[k].map[i, i].rad()) * before[k][i]
                    found[k][i] = _WIDER * (found[k + 1][i] + rests[k] + own) / diagonal[k]
            else:
                for k, rest in enumerate(rests):
                    found[k + 1][i] = _WIDER * (diagonal[k] * found[k][i] + rest)
        if all(
            x <= y
            for row, old in zip(found, before, strict=True)
            for x, y in zip(row, old, strict=True)
        ):
            break
    return found


def _grows(diagonal: Sequence[float]) -> bool:
    """Whether errors along an axis become larger forwards than backwards."""
    total = least = largest = forwards = backwards = 0.0
    for x in diagonal:
        total += math.log(x)
        least, largest = min(least, total), max(largest, total)
        forwards, backwards = max(forwards, total - least), max(backwards, largest - total)
    return forwards > backwards


def hold(links: Sequence[SplitStep], radii: Sequence[Sequence[float]]) -> bool:
    """Whether the boxes contain their images, with outward rounding."""
    return all(
        _holds(links, radii, i, _grows([float(link.map[i, i].mid()) for link in links]))
        for i in range(len(radii[0]))
    )


def _holds(
    links: Sequence[SplitStep], radii: Sequence[Sequence[float]], i: int, backwards: bool
) -> bool:
    """Whether they do along one axis."""
    for link, rho, following in zip(links, radii, radii[1:], strict=False):
        row = [link.map[i, j] for j in range(len(rho))]
        middle = row[i].mid()
        if backwards:
            row[i] = row[i] - middle
        image = link.defect[i, 0].abs_upper()
        for x, y in zip(row, rho, strict=True):
            image = (image + x.abs_upper() * y).upper()
        if backwards and not (image + following[i]).upper() <= (middle * rho[i]).lower():
            return False
        if not backwards and not image <= following[i]:
            return False
    return True
