"""Which runs pay: the Pareto front, and the cheapest for an accuracy."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from lagcli.record import field, record

#: Accuracies for which the cheapest method is named.
ACCURACIES = (1e-3, 1e-6, 1e-9, 1e-12)
#: A choice this much dearer than the cheapest is as good as it.
AS_GOOD = 1.5


@record(kw_only=True)
class RunPoint:
    """One run.

    Attributes
    ----------
    method
        As requested.
    tolerance, accuracy
        The local tolerance of a single run, or what a run with its certificate was to reach.
    taken
        The method that made the run: `auto` takes one.
    error
        Against the reference; None where there is no result, for which `why` has a reason.
    total, integration
        Seconds of processor time: of a fresh process to its last number, of the run alone.
    drift, residual
        The largest change of a conserved charge and the largest residual of a constraint or
        its rate, both relative; None without any.
    reached
        Whether the certificate says that the accuracy was.
    """

    method: str
    tolerance: float | None = None
    accuracy: float | None = None
    taken: str = ""
    error: float | None = None
    total: float | None = None
    integration: float | None = None
    evaluations: int = 0
    steps: int = 0
    drift: float | None = None
    residual: float | None = None
    reached: bool = False
    why: str = field(default="")


#: What a point costs; None where it has no such number.
Cost = Callable[[RunPoint], float | None]

COSTS: dict[str, Cost] = {
    "total": lambda point: point.total,
    "integration": lambda point: point.integration,
    "evaluations": lambda point: float(point.evaluations),
}


def front(points: Iterable[RunPoint], cost: Cost, resolved: float = 0.0) -> set[RunPoint]:
    """The points that no other beats in one of error and cost without losing in the other.

    Parameters
    ----------
    points
        Those without a result take no part.
    cost
        What is paid.
    resolved
        Errors below this cannot be distinguished.

    Returns
    -------
    set of Point
    """
    known = [
        (max(point.error, resolved), paid, place, point)
        for place, point in enumerate(points)
        if point.error is not None and (paid := cost(point)) is not None
    ]
    found: set[RunPoint] = set()
    least = float("inf")
    for _, paid, _, point in sorted(known, key=lambda each: each[:3]):
        if paid < least:  # all that are at least as exact cost more
            least = paid
            found.add(point)
    return found


def cheapest(points: Sequence[RunPoint], accuracy: float, cost: Cost) -> RunPoint | None:
    """The cheapest point with at most this error."""
    good = [
        (paid, place)
        for place, point in enumerate(points)
        if point.error is not None and point.error <= accuracy and (paid := cost(point)) is not None
    ]
    return points[min(good)[1]] if good else None


@record(kw_only=True)
class AccuracyVerdict:
    """For one accuracy: the cheapest run that is certified, and that of `auto` if it is."""

    accuracy: float
    best: RunPoint | None
    auto: RunPoint | None

    @property
    def ratio(self) -> float | None:
        """What `auto` costs, in units of the cheapest; None where either is missing."""
        if self.best is None or self.auto is None:
            return None
        if self.best.total is None or self.auto.total is None:
            return None
        return self.auto.total / self.best.total

    @property
    def agrees(self) -> bool:
        """Whether `auto` takes the cheapest, or one that costs hardly more."""
        if self.best is None or self.auto is None:
            return False
        same = self.auto.taken == self.best.taken
        return same or (self.ratio is not None and self.ratio <= AS_GOOD)


def verdict(points: Sequence[RunPoint], accuracy: float) -> AccuracyVerdict:
    """Of the runs with a certificate for this accuracy."""
    request = [point for point in points if point.accuracy == accuracy]
    named = [point for point in request if point.method != "auto" and point.reached]
    chosen = [point for point in request if point.method == "auto" and point.reached]
    return AccuracyVerdict(
        accuracy=accuracy,
        best=cheapest(named, accuracy, COSTS["total"]),
        auto=chosen[0] if chosen else None,
    )
