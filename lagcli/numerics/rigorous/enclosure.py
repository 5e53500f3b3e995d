r"""Steps of an interval Taylor method with Lohner's sets, computed with outward rounding.

Let x' = f(t, x), x = (q, v), and let c_k(X) be balls that contain the k-th Taylor coefficients of
every solution that starts in X.  A step of length h from the set X goes in three parts.

1. An a-priori enclosure of high order: if

       Y = sum_{k<=K} c_k(X) [0, h]^k + c_{K+1}(Y0) [0, h]^(K+1)

   lies in the interior of Y0, every solution from X exists on [0, h] and stays in Y.
2. The set is m + B r, m a point, B an orthogonal matrix of points, r a box.  By the mean value
   theorem x(h) lies in

       sum_{k<=K} c_k(m) h^k + c_{K+1}(Y) h^(K+1) + (S B) r,

   S an enclosure of the derivative of the flow over X, from Phi' = J(t, x(t)) Phi, Phi(0) = 1.
3. B is turned by the QR decomposition of S B, which keeps the wrapping of boxes away.

References
----------
R. Lohner, "Enclosing the solutions of ordinary initial and boundary value problems", in
Computerarithmetic (Teubner, 1987), 255.
N. Nedialkov, K. Jackson, G. Corliss, "Validated solutions of initial value problems for
ordinary differential equations", Appl. Math. Comput. 105 (1999) 21, sections 5 and 6.
F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", IEEE
Trans. Comput. 66 (2017) 1281.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from lagcli.graph.derivative import partial
from lagcli.numerics.equations.motion import Motion
from lagcli.record import record

#: Of the length at which the last coefficients say that the remainder is small enough.
_FIRST_TRY = 0.7
#: The trial box is wider than the range of the polynomial by this part.
_WIDER = 0.1
#: Boxes over a step are wide: their coefficients need no more bits.
_BOX_BITS = 64
#: A remainder may be this multiple of the target, which is reached on smooth stretches.
_REMAINDER = 1e3
#: The derivative of the flow multiplies radii only.
_FLOW_ORDER = 8
_SHORTER, _HALVINGS = 0.75, 80
#: A step that is a smaller part of the span comes to a singularity, or to a set grown too wide.
_SHORTEST = 1e-7


class NotEnclosed(Exception):
    """Why no enclosure was found from here on."""


@record
class Piece:
    """The motion over one step, from the set at its beginning.

    Attributes
    ----------
    begin, end : arb
        The times, exact.
    centre : list of list of arb
        c_0 .. c_K of each component, from the middle of the set.
    remainder : list of arb
        c_{K+1} over the step.
    flow : list of arb_mat
        The coefficients of Phi; the last holds over the step.
    frame : arb_mat
        B.
    radii : arb_mat
        r, a column.
    """

    begin: Any
    end: Any
    centre: list[list[Any]]
    remainder: list[Any]
    flow: list[Any]
    frame: Any
    radii: Any

    def middle(self, t: Any) -> list[Any]:
        """Where the middle of the set goes, with the remainder."""
        s = t - self.begin
        return [
            _horner([*coefficients, rest], s)
            for coefficients, rest in zip(self.centre, self.remainder, strict=True)
        ]

    def turned(self, t: Any) -> Any:
        """S B at a time of the step."""
        s = t - self.begin
        total = self.flow[-1]
        for matrix in reversed(self.flow[:-1]):
            total = matrix + total * s
        return total * self.frame

    def at(self, t: Any) -> list[Any]:
        """An enclosure of (q, v) at a time of the step, which is an exact ball."""
        spread = self.turned(t) * self.radii
        return [x + spread[i, 0] for i, x in enumerate(self.middle(t))]


class Enclosures:
    """The steps of one proof.

    Parameters
    ----------
    motion : Motion
        In balls, with exact parameters.
    order : int
        K.
    target : float
        What the remainder of a step may be, relative to the largest component.
    """

    def __init__(self, motion: Motion, order: int, target: float) -> None:
        from flint import arb, arb_mat, arb_series, ctx

        self.motion, self.order, self.target = motion, order, target
        self._ball, self._matrix, self._series, self._context = arb, arb_mat, arb_series, ctx
        self.steps = 0
        equations = motion.equations
        eliminated = equations.eliminated
        if eliminated is None:
            raise NotEnclosed("the accelerations have no formula of their own")
        roots, _ = eliminated.motion(equations.forcing, equations.bias)
        symbols = (*equations.q, *equations.qdot)
        self._accelerations = motion.function(roots)
        slopes = [partial(equations.graph, x) for x in symbols]
        self._jacobian = motion.function([slope(a) for a in roots for slope in slopes])
        mask = 0
        for symbol in equations.qdot:
            mask |= symbol.mask
        #: coefficients that one evaluation gives
        self._gain = 1 if any(a.mask & mask for a in roots) else 2

    def pieces(self, state: Sequence[Any], until: Any) -> Iterator[Piece]:
        """Steps from t = 0 to the end, each enclosed.

        Raises
        ------
        NotEnclosed
            Where a step finds no enclosure.
        """
        n = len(state)
        t, frame = self._ball(0), _identity(self._matrix, n)
        middle = [x.mid() for x in state]
        radii = self._matrix(n, 1, [x - m for x, m in zip(state, middle, strict=True)])
        before = None
        while not t >= until:
            piece = self._step(t, middle, frame, radii, until, before)
            yield piece
            self.steps += 1
            before = float(piece.end - piece.begin)
            t = piece.end
            middle, frame, radii = self._set(piece)

    def _set(self, piece: Piece) -> tuple[list[Any], Any, Any]:
        """The set at the end of a step: its middle, its frame and its radii."""
        ends = piece.middle(piece.end)
        middle = [x.mid() for x in ends]
        n = len(ends)
        rest = self._matrix(n, 1, [x - m for x, m in zip(ends, middle, strict=True)])
        turned = piece.turned(piece.end)
        frame = _orthogonal(turned, piece.radii, self._matrix)
        inverse = frame.inv()
        return middle, frame, (inverse * turned) * piece.radii + inverse * rest

    def _step(
        self,
        t: Any,
        middle: Sequence[Any],
        frame: Any,
        radii: Any,
        until: Any,
        before: float | None,
    ) -> Piece:
        centre = self._coefficients(t, middle, self.order)
        spread = frame * radii
        whole = [x + spread[i, 0] for i, x in enumerate(middle)]
        if not all(c.is_finite() for each in centre for c in each):
            raise NotEnclosed("the equations are not defined at every point of the enclosure")
        h = self._length(centre)
        if before is not None:
            h = min(h, 1.1 * before)
        for _ in range(_HALVINGS):
            if h < _SHORTEST * float(until):
                break
            end = until if t + 1.05 * h >= until else self._ball(float(t + h))
            found = self._remainder(t, end, centre, whole)
            if found is not None:
                remainder, box, times = found
                flow = self._flow(t, whole, box, times, float(end - t))
                if flow is not None:
                    return Piece(t, end, centre, remainder, flow, frame, radii)
            h *= _SHORTER
        raise NotEnclosed(
            "no enclosure was found over any step: the set has grown too wide, or the motion "
            "comes to a singularity"
        )

    def _coefficients(self, t: Any, x: Sequence[Any], order: int) -> list[list[Any]]:
        """c_0 .. c_order of q and v, where q' = v and v' is the acceleration."""
        n, series, context, ball = self.motion.n, self._series, self._context, self._ball
        q, v = [[c] for c in x[:n]], [[c] for c in x[n:]]
        usual = context.cap
        try:
            while len(v[0]) <= order:
                known = len(v[0]) + self._gain - 1
                for c, rate in zip(q, v, strict=True):
                    c.append(rate[-1] / len(rate))
                context.cap = known
                time = series([t, 1][:known])
                places, rates = [series(c[:known]) for c in q], [series(c) for c in v]
                found = [
                    a if isinstance(a, series) else series([a])
                    for a in self._accelerations(time, *places, *rates)
                ]
                for _ in range(self._gain):
                    k = len(v[0])
                    for c, rate, a in zip(q, v, found, strict=True):
                        if len(c) < k + 1:
                            c.append(rate[k - 1] / k)
                        rate.append(a[k - 1] / ball(k))
        finally:
            context.cap = usual
        return [c[: order + 1] for c in (*q, *v)]

    def _length(self, series: Sequence[Sequence[Any]]) -> float:
        """A length at which the term after the last is about the target."""
        scale = max((float(abs(each[0])) for each in series), default=1.0) or 1.0
        shortest = float("inf")
        for each in series:
            for k in (self.order, self.order - 1):
                last = float(abs(each[k]))
                if last > 0.0:
                    shortest = min(shortest, (self.target * scale / last) ** (1.0 / k))
        return _FIRST_TRY * shortest if shortest < float("inf") else 1.0

    def _remainder(
        self, t: Any, end: Any, centre: Sequence[Sequence[Any]], whole: Sequence[Any]
    ) -> tuple[list[Any], list[Any], Any] | None:
        """c_{K+1} over the step, the box that holds the motion, and the times; or None."""
        ball, context = self._ball, self._context
        h = float(end - t) * (1 + 1e-12)
        usual, context.prec = context.prec, _BOX_BITS
        try:
            span = ball(h / 2, h / 2)  # contains [0, h]
            offset = [x - c[0] for x, c in zip(whole, centre, strict=True)]
            # the solutions from the whole set stay near that of its middle
            spread = [_horner(c, span) + 4 * o for c, o in zip(centre, offset, strict=True)]
            box = [_widened(each, ball) for each in spread]
            times = ball(float(t) + h / 2, h / 2 * (1 + 1e-9) + 1e-15 * abs(float(t)))
            coefficients = self._coefficients(t, whole, min(_FLOW_ORDER, self.order))
            wide = self._coefficients(times, box, self.order + 1)
            last = [each[-1] for each in wide]
            low = len(coefficients[0])
            # existence: the polynomial of low order over the whole set, its remainder over the box
            inside = [_horner([*c, w[low]], span) for c, w in zip(coefficients, wide, strict=True)]
            if not all(
                b.is_finite() and b.contains_interior(y) for b, y in zip(box, inside, strict=True)
            ):
                return None
            scale = max((float(abs(each[0])) for each in centre), default=1.0) or 1.0
            power = h ** (self.order + 1)
            largest = max(float(abs(rest).upper()) for rest in last)
            if not largest * power <= _REMAINDER * self.target * scale:
                return None
        finally:
            context.prec = usual
        return last, box, times

    def _flow(
        self, t: Any, whole: Sequence[Any], box: Sequence[Any], times: Any, h: float
    ) -> list[Any] | None:
        """The Taylor coefficients of Phi over the set, the last over the step."""
        context, matrix = self._context, self._matrix
        n = len(whole)
        order = _FLOW_ORDER
        usual, context.prec = context.prec, _BOX_BITS
        try:
            over = self._matrices(times, box, order)
            bound = max(sum(float(abs(over[0][i, j]).upper()) for j in range(n)) for i in range(n))
            grown = bound * h
            if not grown < 5:
                return None
            # |Phi - 1| <= exp(|J| h) - 1 over the step
            slack = 1.5 ** int(grown / 0.4 + 1) - 1
            around = matrix(n, n, [
                self._ball(1.0 if i == j else 0.0, slack) for i in range(n) for j in range(n)
            ])  # fmt: skip
            wide = _variational(over, around, order)
            narrow = _variational(self._matrices(t, whole, order), _identity(matrix, n), order)
        finally:
            context.prec = usual
        found = [*narrow[:order], wide[order]]
        finite = all(m[i, j].is_finite() for m in found for i in range(n) for j in range(n))
        return found if finite else None

    def _matrices(self, t: Any, x: Sequence[Any], order: int) -> list[Any]:
        """The Taylor coefficients of J along the solutions from x."""
        n, series, context = self.motion.n, self._series, self._context
        coefficients = self._coefficients(t, x, order)
        usual, context.cap = context.cap, order
        try:
            time = series([t, 1])
            entries = [
                a if isinstance(a, series) else series([a])
                for a in self._jacobian(time, *(series(c[:order]) for c in coefficients))
            ]
        finally:
            context.cap = usual
        found = []
        for k in range(order):
            top = [1 if k == 0 and j == i + n else 0 for i in range(n) for j in range(2 * n)]
            found.append(self._matrix(2 * n, 2 * n, [*top, *(a[k] for a in entries)]))
        return found


def _variational(jacobian: Sequence[Any], start: Any, order: int) -> list[Any]:
    """Phi_{k+1} = sum_j J_j Phi_{k-j} / (k + 1)."""
    found = [start]
    for k in range(order):
        total = jacobian[0] * found[k]
        for j in range(1, k + 1):
            total += jacobian[j] * found[k - j]
        found.append(total / (k + 1))
    return found


def _horner(coefficients: Sequence[Any], s: Any) -> Any:
    value = coefficients[-1]
    for c in reversed(coefficients[:-1]):
        value = c + value * s
    return value


def _widened(around: Any, ball: Any) -> Any:
    """A ball around another, with room for the remainder."""
    size = float(abs(around.mid()))
    return ball(float(around.mid()), float(around.rad()) * (1 + _WIDER) + 1e-13 * size + 1e-16)


def _identity(matrix: Any, n: int) -> Any:
    return matrix(n, n, [int(i == j) for i in range(n) for j in range(n)])


def _orthogonal(turned: Any, radii: Any, matrix: Any) -> Any:
    """An orthogonal matrix of points along the longest sides of the set: Gram and Schmidt.

    It need not be exact: whatever it is, its inverse is enclosed.
    """
    n = turned.nrows()
    columns = [[float(turned[i, j].mid()) for i in range(n)] for j in range(n)]
    lengths = [
        float(abs(radii[j, 0]).upper()) * sum(x * x for x in columns[j]) ** 0.5 for j in range(n)
    ]
    frame: list[list[float]] = []
    units = [[float(i == k) for i in range(n)] for k in range(n)]
    for candidate in [*(columns[j] for j in sorted(range(n), key=lambda j: -lengths[j])), *units]:
        before = _norm(candidate)
        for other in (*frame, *frame):  # twice is enough
            along = sum(a * b for a, b in zip(candidate, other, strict=True))
            candidate = [a - along * b for a, b in zip(candidate, other, strict=True)]
        after = _norm(candidate)
        if len(frame) < n and after > 1e-8 * before:  # else the direction is there already
            frame.append([x / after for x in candidate])
    return matrix(n, n, [frame[j][i] for i in range(n) for j in range(n)])


def _norm(x: Sequence[float]) -> float:
    return math.sqrt(sum(a * a for a in x))
