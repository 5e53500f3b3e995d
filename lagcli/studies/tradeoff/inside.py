"""The trades inside the model and its numbers, read off the runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from lagcli.numerics.certified.methods import METHODS
from lagcli.record import field, record
from lagcli.studies.tradeoff.front import ACCURACIES, COSTS, RunPoint, cheapest

if TYPE_CHECKING:
    from lagcli.studies.tradeoff.study import Study


@record(kw_only=True)
class Trade:
    """One alternative: what it is, what it costs in words, and in numbers."""

    name: str
    sentence: str
    numbers: Mapping[str, float] = field(default_factory=dict)


def trades(study: Study) -> list[Trade]:
    """Those that the runs say something of."""
    found = (_cut(study), _compiled(study), _digits(study), _proof(study))
    return [trade for trade in found if trade is not None]


def _with(study: Study, wanted: Callable[[tuple[str, ...]], bool]) -> list[RunPoint]:
    return [point for point in study.points if wanted(METHODS[point.method].properties)]


def _cut(study: Study) -> Trade | None:
    """Solved constraints and idle coordinates against multipliers, by the same method."""
    cost = COSTS["integration"]
    for accuracy in reversed(ACCURACIES):
        full = cheapest(study.whole, accuracy, cost)
        if full is None:
            continue
        same = [point for point in study.points if point.method == full.method]
        if (ratio := _ratio(full, cheapest(same, accuracy, cost))) is not None:
            return Trade(
                name="minimal coordinates against multipliers",
                sentence=f"at {accuracy:.0e} {full.method} integrates\n  the model of the "
                f"requested columns {ratio:.3g} times faster than the one of the file",
                numbers={"accuracy": accuracy, "faster": ratio},
            )
    return None


def _ratio(slow: RunPoint | None, fast: RunPoint | None) -> float | None:
    """How many times longer one integrates than the other; None where either is missing."""
    if slow is None or fast is None or not slow.integration or not fast.integration:
        return None
    return slow.integration / fast.integration


def _compiled(study: Study) -> Trade | None:
    """At the finest of the accuracies that both reach in doubles."""
    ours = _with(study, lambda words: "compiled" in words)
    theirs = _with(study, lambda words: "compiled" not in words and "any precision" not in words)
    cost = COSTS["integration"]
    for accuracy in reversed(ACCURACIES):
        fast, slow = cheapest(ours, accuracy, cost), cheapest(theirs, accuracy, cost)
        ratio = _ratio(slow, fast)
        if fast is None or slow is None or ratio is None:
            continue
        later = _preparation(fast) - _preparation(slow)
        sentence = (
            f"at {accuracy:.0e} {fast.method} integrates {ratio:.3g} times faster than "
            f"{slow.method},\n  and is ready {abs(later) * 1e3:.0f} ms "
            f"{'later' if later > 0 else 'earlier'}"
        )
        return Trade(
            name="compiled against interpreted",
            sentence=sentence,
            numbers={"accuracy": accuracy, "faster": ratio, "later": later},
        )
    return None


def _preparation(point: RunPoint) -> float:
    """What is done before the integration."""
    return (point.total or 0.0) - (point.integration or 0.0)


def _digits(study: Study) -> Trade | None:
    """How far doubles go, and what more digits take for the same and for more."""
    doubles = _with(study, lambda words: "any precision" not in words)
    more = _with(study, lambda words: "any precision" in words)
    reached = [point.error for point in doubles if point.error is not None]
    beyond = [point.error for point in more if point.error is not None]
    if not reached or not beyond:
        return None
    cost = COSTS["integration"]
    least, exact = min(reached), max(min(beyond), study.resolved)
    ratio = _ratio(cheapest(more, 10 * least, cost), cheapest(doubles, 10 * least, cost))
    if ratio is None:
        return None
    return Trade(
        name="digits",
        sentence=f"the hardware's numbers reach {least:.1e}; carried in software\n  the same costs "
        f"{ratio:.3g} times as much to integrate, and goes on to {exact:.1e}",
        numbers={"hardware_error": least, "software_error": exact, "slower": ratio},
    )


def _proof(study: Study) -> Trade | None:
    """What a proof costs beside a certificate and a plain run, each a whole process."""
    proved = study.proved
    if proved is None:
        return None
    if not proved.reached or proved.total is None or proved.accuracy is None:
        return Trade(name="proof", sentence=f"none: {proved.why or 'the accuracy is not reached'}")
    numbers = {"accuracy": proved.accuracy, "proof": proved.total}
    sentence = f"at {proved.accuracy:.0e} a proof takes {proved.total:.2g} s"
    certified = [p for p in study.certified if p.accuracy == proved.accuracy and p.reached]
    for name, points in (("certificate", certified), ("plain run", study.points)):
        best = cheapest(points, proved.accuracy, COSTS["total"])
        if best is not None and best.total is not None:
            numbers[name.replace(" ", "_")] = best.total
            sentence += f", a {name} {best.total:.2g} s"
    return Trade(name="proof", sentence=sentence, numbers=numbers)
