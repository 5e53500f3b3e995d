"""The study as a picture: the true error of each run against what it cost."""

from __future__ import annotations

import math
from collections.abc import Sequence

from lagcli.numerics.certified.methods import METHODS
from lagcli.pictures.drawing import (
    Axis,
    CannotDraw,
    Curve,
    Item,
    Marks,
    Panel,
    Picture,
    Point,
    extent,
    words,
)
from lagcli.studies.tradeoff.front import COSTS
from lagcli.studies.tradeoff.study import Study

#: Errors and costs below these are drawn at them.
_LEAST_ERROR, _LEAST_COST = 1e-200, 1e-9
_TITLES = {
    "total": "processor time of a fresh process (s)",
    "integration": "processor time of the integration (s)",
    "evaluations": "evaluations of the accelerations",
}
_FRONT = "nothing is both as exact and cheaper"


def picture_of(study: Study) -> Picture:
    """One curve for each method, a dot for each run, a ring for each on the front.

    Raises
    ------
    CannotDraw
        When no run has a result.
    """
    cost, front = COSTS[study.cost], study.front
    curves: dict[str, list[Point]] = {}
    rings: list[Point] = []
    for point in study.points:
        paid = cost(point)
        if point.error is not None and paid is not None and point.error < math.inf:
            at = max(point.error, study.resolved, _LEAST_ERROR), max(paid, _LEAST_COST)
            curves.setdefault(point.method, []).append(at)
            rings += [at] if point in front else []
    if not curves:
        raise CannotDraw("no run has a result")
    items: list[Item] = []
    for k, (name, line) in enumerate(curves.items()):
        items.append(
            Curve(pieces=(tuple(line),), role="series", colour=k, label=words(_told(name)))
        )
        items.append(Marks(points=tuple(line), role="stable", colour=k))
    items.append(Marks(points=tuple(rings), role="start", label=words(_FRONT)))
    errors, costs = zip(*(at for line in curves.values() for at in line), strict=True)
    panel = Panel(
        x=_axis("true error", errors), y=_axis(_TITLES[study.cost], costs), items=tuple(items)
    )
    return Picture(title=f"{study.name}: what accuracy costs until t = {study.until:g}",
                   panels=(panel,))  # fmt: skip


def _axis(label: str, values: Sequence[float]) -> Axis:
    low, high = extent([math.log10(value) for value in values])
    return Axis(label=words(label), low=10**low, high=10**high, logarithmic=True)


def _told(name: str) -> str:
    entry = METHODS[name]
    order = "any order" if entry.order is None else f"order {entry.order}"
    return ", ".join((f"{name}: {order}", *entry.properties))
