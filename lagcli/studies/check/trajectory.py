"""`expect: trajectory`: the known motion against a run that is finer than the tolerance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from lagcli.expression import Expression, Name
from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.equations.parameter_formulas import numbers_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.result import Result
from lagcli.numerics.rigorous import prove
from lagcli.problem_data import Known, KnownRow, Problem, Trajectory
from lagcli.reader.columns import Column
from lagcli.studies.check.findings import CheckOutcome, Finding

_TOLERANCE = 1e-9
_FINER = 0.1  # so that the error of the run is small beside what is allowed
#: Where formulas of t are compared, both ends included.
_PLACES = 21
#: Times that differ by less are one sample.
_SAME_TIME = 1e-12

#: The columns by their names, at each time.
Rows = Mapping[float, Mapping[str, float | None]]
Found = Iterator[Finding | None]


class TrajectoryCheck:
    """Every number of the known motion compared with the run.

    A number agrees within the tolerance, relative to the largest magnitude of its column and
    absolute below 1: what is written as 0 has no scale.  A time agrees relative to the end.

    Yields a finding for each column and each event that does not agree, None for the others.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.known: Trajectory | None = problem.expect.trajectory

    def __iter__(self) -> Found:
        """The findings: formulas, numbers at times, events."""
        if self.known is None:
            return
        try:
            yield from self._compared(self.known)
        except Refusal as refusal:
            yield self._finding(CheckOutcome.UNDECIDED, (), f"no numbers: {refusal}")

    def _compared(self, known: Trajectory) -> Found:
        until, tolerance, stated = self._numbers(known)
        if until is None:
            message = "when does it end? give until, here or under simulation"
            yield self._finding(CheckOutcome.UNDECIDED, (), message)
            return
        places = [until * k / (_PLACES - 1) for k in range(_PLACES)] if known.formulas else []
        times = _merged([0.0, *places, *stated, until])
        result = self._run(known, until, tolerance, times)
        if not result.certificate.reached:
            yield self._finding(CheckOutcome.UNDECIDED, (), result.refusal)
            return
        rows = _by_time(result)
        for formula in known.formulas:
            yield self._formula(formula, rows, tolerance)
        for place, (row, t) in enumerate(zip(known.rows, stated, strict=True)):
            at = min(rows, key=lambda other: abs(other - t))
            path = ("at", str(place))
            if abs(at - t) > _SAME_TIME * until:
                message = f"the run ends at t = {max(rows)!r}, before t = {t!r}"
                yield self._finding(CheckOutcome.WRONG, path, message)
                continue
            yield from self._values(path, row, rows[at], tolerance, rows)
        for place, expected in enumerate(known.events):
            yield from self._event(place, expected, result, tolerance, until)

    def _numbers(self, known: Trajectory) -> tuple[float | None, float, list[float]]:
        """The end, the tolerance, and the times of the rows."""
        times = [row.t for row in known.rows if row.t is not None]
        stated = [value for (value,) in map(self._value, times)]
        end = known.until or self.problem.simulation.until
        ends = stated if end is None else [*stated, self._value(end)[0]]
        until: float | None = max(ends) if ends else None
        given = known.tolerance
        return until, _TOLERANCE if given is None else self._value(given)[0], stated

    def _value(self, formula: Expression) -> tuple[float, ...]:
        return numbers_of(self.problem, [formula])[0]

    def _run(
        self, known: Trajectory, until: float, tolerance: float, times: Sequence[float]
    ) -> Result:
        rows = [value for row in (*known.rows, *known.events) for value in row.values]
        columns = {"t": Column("t", None)}
        for each in (*known.formulas, *rows):
            if each.column != Name("t"):
                columns[each.name] = Column(each.name, each.column)
        request = RunRequest(
            until=until,
            accuracy=tolerance * _FINER,
            samples=len(times),
            times=tuple(times),
            columns=tuple(columns.values()),
            furthest=False,
        )
        if known.rigorous:
            return prove(self.problem, request).as_result()
        return simulate(self.problem, request)

    # -- comparisons -----------------------------------------------------------------------------

    def _formula(self, known: Known, rows: Rows, tolerance: float) -> Finding | None:
        name = known.name
        times = list(rows)
        for t, (expected,) in zip(
            times, numbers_of(self.problem, [known.value], times), strict=True
        ):
            finding = self._number((name,), name, rows[t][name], expected, tolerance, rows, t)
            if finding is not None:
                return finding
        return None

    def _values(
        self,
        path: tuple[str, ...],
        row: KnownRow,
        found: Mapping[str, float | None],
        tolerance: float,
        rows: Rows,
        event: str = "",
    ) -> Found:
        for known in row.values:
            name = known.name
            [expected] = self._value(known.value)
            yield self._number(path, name, found.get(name), expected, tolerance, rows, event)

    def _number(
        self,
        path: tuple[str, ...],
        name: str,
        found: float | None,
        expected: float,
        tolerance: float,
        rows: Rows,
        when: float | str,
    ) -> Finding | None:
        scale = max([1.0, abs(expected), *(abs(row.get(name) or 0.0) for row in rows.values())])
        if found is not None and abs(found - expected) <= tolerance * scale:
            return None
        at = f"t = {when!r}" if isinstance(when, float) else when
        value = "not defined" if found is None else repr(found)
        message = f"expected {name} = {expected!r}{' at ' + at if at else ''}, computed {value}"
        return self._finding(CheckOutcome.WRONG, path, message)

    def _event(
        self, place: int, expected: KnownRow, result: Result, tolerance: float, until: float
    ) -> Found:
        path = ("events", str(place))
        if place >= len(result.events):
            yield self._finding(
                CheckOutcome.WRONG, path, f"there are {len(result.events)} events only"
            )
            return
        event = result.events[place]
        computed = f"{event.what} of {event.name} at t = {event.t!r}"
        same = expected.event in {None, event.name} and expected.what in {None, event.what}
        if not same:
            wanted = " of ".join(word for word in (expected.what, expected.event) if word)
            yield self._finding(CheckOutcome.WRONG, path, f"expected {wanted}, computed {computed}")
            return
        if expected.t is not None:
            [t] = self._value(expected.t)
            if abs(event.t - t) > tolerance * max(1.0, until):
                yield self._finding(
                    CheckOutcome.WRONG, path, f"expected t = {t!r}, computed {computed}"
                )
                return
        yield None
        rows = _by_time(result)
        yield from self._values(path, expected, event.before, tolerance, rows, computed)

    def _finding(self, outcome: CheckOutcome, path: tuple[str, ...], message: str) -> Finding:
        whole = ("trajectory", *path)
        return Finding(outcome, ".".join(whole), message, self.problem.expect.span(whole))


def _by_time(result: Result) -> Rows:
    return {row[0] or 0.0: dict(zip(result.columns, row, strict=True)) for row in result.rows}


def _merged(times: Sequence[float]) -> list[float]:
    """In order, those that are nearly the same once."""
    kept: list[float] = []
    end = max(times)
    for t in sorted(times):
        if not kept or t - kept[-1] > _SAME_TIME * end:
            kept.append(t)
    return kept
