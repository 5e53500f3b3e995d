"""All runs of a problem: every method over its tolerances, and with its certificate."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from lagcli.numerics.certified.method_entry import MethodEntry
from lagcli.numerics.certified.methods import METHODS
from lagcli.record import record, replace
from lagcli.studies.tradeoff.front import (
    ACCURACIES,
    COSTS,
    AccuracyVerdict,
    RunPoint,
    front,
    verdict,
)
from lagcli.studies.tradeoff.reference import ReferenceMotion, numbers, reference
from lagcli.studies.tradeoff.trial import PROOF, Given, request_of

#: Local tolerances; those below the rounding of doubles are for methods with more digits.
_TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16)
_FINER = (1e-20, 1e-24)
#: A tolerance 100 times finer that gains less than this has met rounding.
_GAIN = 0.5
#: Errors at which more exact arithmetic, and no smaller step, is what is missing.
_ROUNDED = 1e-9
#: Accuracy of the run that is proved.
_PROVED = 1e-9
#: Wall time that a process is given for each second of its processor time.
_PATIENCE = 20.0

#: Runs that take the limit of one are this many at most: what is left of the table stays empty.
_RUNS = 20

#: Called before each run: how many are made, of how many.
Progress = Callable[[int, int], None]
#: Called with each run when it is made.
RunPrinter = Callable[[RunPoint], None]


@record(kw_only=True)
class Study:
    """What came of it.

    Attributes
    ----------
    name, until, samples
        The problem, its span, and how often the motion was looked at.
    reference
        What the errors are against.
    points
        Single runs.
    certified
        Runs with their certificates, those of `auto` among them.
    whole
        Runs of one method without anything cut from the model; none where nothing is.
    proved
        A run with enclosures, for the accuracy 1e-9.
    unsuited
        Method -> why it is not for this problem.
    cost
        What the front is a front of.
    """

    name: str
    until: float
    samples: int
    reference: ReferenceMotion
    points: tuple[RunPoint, ...]
    certified: tuple[RunPoint, ...]
    whole: tuple[RunPoint, ...] = ()
    proved: RunPoint | None = None
    unsuited: Mapping[str, str]
    cost: str

    @property
    def resolved(self) -> float:
        """Errors below this are those of the reference."""
        return self.reference.bound

    @property
    def front(self) -> set[RunPoint]:
        """The single runs that pay."""
        return front(self.points, COSTS[self.cost], self.resolved)

    @property
    def verdicts(self) -> tuple[AccuracyVerdict, ...]:
        """The cheapest for each accuracy."""
        return tuple(verdict(self.certified, accuracy) for accuracy in ACCURACIES)

    @property
    def broken(self) -> tuple[RunPoint, ...]:
        """Runs whose certificate promises more than is true."""
        return tuple(
            point
            for point in self.certified
            if point.reached
            and point.error is not None
            and point.accuracy is not None
            and point.error > point.accuracy + self.resolved
        )


def study(
    given: Given,
    methods: Sequence[str] = tuple(METHODS),
    *,
    cost: str = "total",
    repeat: int = 1,
    progress: Progress | None = None,
    run_printer: RunPrinter | None = None,
) -> Study:
    """Make all runs, each in a process of its own.

    Parameters
    ----------
    given
        The problem, its span and the limit of each run; method and tolerance do not matter.
    methods
        Their names.
    cost
        A name out of `COSTS`.
    repeat
        How often each run is made; the shortest times count.
    progress, run_printer
        Called for each run, before and after.

    Raises
    ------
    Refusal
        When there is nothing to run, or no reference.
    """
    methods = [name for name in METHODS if name in methods]
    problem, request = request_of(given)
    if progress is not None:
        progress(0, 1)
    known = reference(problem, request, 3 * given.limit)  # more than what is measured against it
    maker = _RunMaker(given, known, repeat, (progress, run_printer), methods)
    points: list[RunPoint] = []
    unsuited: dict[str, str] = {}
    for name in methods:
        for point in maker.sweep(METHODS[name]):
            if point.why and point.error is None and maker.unsuited:
                unsuited[name] = point.why
            else:
                points.append(point)
    suited = [name for name in methods if name not in unsuited]
    whole: list[RunPoint] = []
    if known.cut and suited:
        whole = list(maker.sweep(METHODS[suited[0]], whole=True))
    certified = [
        maker.certified(name, accuracy) for accuracy in ACCURACIES for name in ("auto", *suited)
    ]
    return Study(
        name=given.name,
        until=given.until,
        samples=given.samples,
        reference=known,
        points=tuple(points),
        certified=tuple(certified),
        whole=tuple(whole),
        proved=maker.certified(PROOF, _PROVED),
        unsuited=unsuited,
        cost=cost,
    )


class _RunMaker:
    """Makes runs, and counts them."""

    def __init__(
        self,
        given: Given,
        known: ReferenceMotion,
        repeat: int,
        listeners: tuple[Progress | None, RunPrinter | None],
        methods: Sequence[str],
    ) -> None:
        self.given, self.known, self.repeat = given, known, repeat
        self.progress, self.run_printer = listeners
        self.made = 0
        self.total = len(methods) * len(_TOLERANCES) + len(ACCURACIES) * (1 + len(methods)) + 1
        self.unsuited = False
        self._spent = 0.0  # seconds of processor time
        self._ended = ""  # why no more runs are made
        self._too_long: dict[str, float] = {}  # the accuracy that took too long

    def sweep(self, entry: MethodEntry, *, whole: bool = False) -> Iterator[RunPoint]:
        """One method over its tolerances, until more of them say nothing."""
        finer = _FINER if "any precision" in entry.properties else ()
        last: RunPoint | None = None
        begun = self.made
        for tolerance in (*_TOLERANCES, *finer):
            point = self._point(
                replace(self.given, method=entry.name, tolerance=tolerance, whole=whole)
            )
            yield point
            if self.unsuited or point.error is None:
                break
            if point.error <= self.known.bound or (last and _has_met_rounding(last, point)):
                break
            last = point
        self.made = begun + len(_TOLERANCES)

    def certified(self, name: str, accuracy: float) -> RunPoint:
        """One run with its certificate; none where a looser one took too long."""
        request = replace(self.given, method=name, tolerance=None, accuracy=accuracy)
        if accuracy < self._too_long.get(name, 0.0):
            self.made += 1
            return RunPoint(
                method=name, accuracy=accuracy, why=f"takes more than {self.given.limit:g} s"
            )
        point = self._point(request)
        if point.error is None and point.why.startswith("takes more"):
            self._too_long[name] = accuracy
        return point

    def _point(self, given: Given) -> RunPoint:
        if self.progress is not None:
            self.progress(self.made, self.total)
        self.made += 1
        point = self._run(given)
        if self.run_printer is not None:
            self.run_printer(point)
        return point

    def _run(self, given: Given) -> RunPoint:
        request = RunPoint(method=given.method, tolerance=given.tolerance, accuracy=given.accuracy)
        self.unsuited, most = False, _RUNS * given.limit
        if self._ended:
            return replace(request, why=f"not made: {self._ended}")
        try:
            found = [answer(given)]
            while len(found) < self.repeat and "why" not in found[0]:
                found.append(answer(given))
        except KeyboardInterrupt:  # the table shows what there is
            self._ended = "interrupted"
            return replace(request, why=self._ended)
        first = found[0]
        self._spent += sum(given.limit if x.get("long") else x.get("total", 0.0) for x in found)
        if self._spent > most:
            self._ended = f"the runs before took {most:g} s"
        self.unsuited = bool(first.get("unsuited"))
        good = [each for each in found if "why" not in each]
        if not good:
            return replace(request, why=first["why"])
        integrations = [x["integration"] for x in good if x["integration"] is not None]
        complete = len(first["rows"]) == len(self.known.rows)
        return replace(
            request,
            taken=first["method"],
            error=self.known.error(numbers(first["rows"])) if complete else None,
            total=min(each["total"] for each in good),
            integration=min(integrations, default=None),
            evaluations=first["evaluations"],
            steps=first["steps"],
            drift=first["drift"],
            residual=first["residual"],
            reached=bool(first.get("reached")),
            why="" if complete else "the accuracy is not reached until the end",
        )


def _has_met_rounding(last: RunPoint, point: RunPoint) -> bool:
    """Whether a finer tolerance has changed the steps and gained nothing."""
    assert last.error is not None
    assert point.error is not None
    changed = point.evaluations != last.evaluations
    return changed and point.error > _GAIN * last.error and last.error < _ROUNDED


def answer(given: Given) -> dict[str, Any]:
    """What a process says of its run."""
    request = {name: getattr(given, name) for name in Given.__annotations__}
    try:
        done = subprocess.run(
            [sys.executable, "-m", "lagcli.studies.tradeoff.trial"],
            input=json.dumps(request),
            capture_output=True,
            text=True,
            check=False,
            timeout=_PATIENCE * given.limit,
        )
    except subprocess.TimeoutExpired:
        return {"why": f"takes more than {given.limit:g} s", "long": True}
    if done.returncode:
        last = done.stderr.strip().splitlines() or ["it ended without a word"]
        return {"why": f"the process failed: {last[-1]}"}
    found: dict[str, Any] = json.loads(done.stdout)
    return found
