"""L = p q' - H of a file that gives H, in numbers: dH/dp = q' solved by Newton's method."""

from __future__ import annotations

from mpmath import mpf

from . import linear
from .grammar import Undefined, read

STEP = mpf(10) ** -12


class Legendre:
    """L as a function of a table of names, near the momenta of the state that was begun with."""

    def __init__(self, text: str, coordinates) -> None:
        self.H, self.coordinates = read(text), list(coordinates)
        self._begun = [[mpf(0)] * len(self.coordinates)]

    def begin(self, names, p):
        """The velocities of momenta p, from which the next ones are sought."""
        self._begun.append(list(p))
        return self._velocities(names, p)

    def _at(self, names, p):
        return self.H(names | {f"p_{q}": x for q, x in zip(self.coordinates, p, strict=True)})

    def _velocities(self, names, p):
        found = []
        for i in range(len(p)):
            up, down = list(p), list(p)
            up[i], down[i] = p[i] + STEP, p[i] - STEP
            found.append((self._at(names, up) - self._at(names, down)) / (2 * STEP))
        return found

    def __call__(self, names):
        """L there, by Newton's method from the momenta of some state."""
        for start in reversed(self._begun):
            value = self._from(start, names)
            if value is not None:
                return value
        raise Undefined("no momenta")

    def _from(self, start, names):
        p, v = list(start), [names[q + "'"] for q in self.coordinates]
        for _ in range(14):
            off = [a - b for a, b in zip(self._velocities(names, p), v, strict=True)]
            if max(map(abs, off)) < mpf(10) ** -40:
                return linear.dot(p, v) - self._at(names, p)
            columns = []
            for i in range(len(p)):
                up, down = list(p), list(p)
                up[i], down[i] = p[i] + mpf(10) ** -9, p[i] - mpf(10) ** -9
                pairs = zip(self._velocities(names, up), self._velocities(names, down), strict=True)
                columns.append([(a - b) / mpf(10) ** -9 / 2 for a, b in pairs])
            step, _, _ = linear.solve(linear.transposed(columns), off)
            p = [a - b for a, b in zip(p, step, strict=True)]
        return None
