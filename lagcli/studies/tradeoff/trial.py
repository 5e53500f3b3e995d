"""One run in a fresh process: `python -m lagcli.studies.tradeoff.trial`, JSON in, JSON out.

What is measured is the processor's time, so that other processes do not count: that of the
integration, and that of everything from the start of Python to the last number.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from time import process_time
from typing import TYPE_CHECKING, Any

from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.numerics.hybrid.request import RunRequest
    from lagcli.numerics.hybrid.run import Run
    from lagcli.numerics.hybrid.setup import Setup
    from lagcli.problem_data import Problem

#: A short integration is timed repeatedly, up to these seconds and runs.
_SECONDS, _AGAIN = 0.05, 5
#: The longest step of a single run is this part of the span: nothing is guarded against.
_PARTS = 10.0
#: The least accuracy that a single run, which claims none, is given.
_LEAST = 1e-14
#: The name of a run that is proved, beside those of the methods.
PROOF = "proof"
#: Significant digits of the numbers that are compared.
DIGITS = 50


@record(kw_only=True)
class Given:
    """What a trial is to do.

    Attributes
    ----------
    name, text, settings, state
        The problem: its name in messages, its file, `--set` and `--at`.
    until, samples
        The span, and how often the motion is looked at.
    method
        Its name; `auto` and `proof` with an accuracy only.
    tolerance, accuracy
        A single run with this local tolerance, or a run with its certificate.
    limit
        Seconds of processor time.
    whole
        Integrate the model as it stands in the file, nothing cut from it.
    """

    name: str
    text: str
    settings: tuple[str, ...]
    until: float
    samples: int
    project: bool
    method: str
    tolerance: float | None
    accuracy: float | None
    limit: float
    whole: bool = False
    state: tuple[str, ...] = ()


class LimitReached(Exception):
    """The limit is reached."""


def until(end: float) -> Callable[[float], None]:
    """A progress of a run that ends it at a processor time."""

    def ticked(_: float) -> None:
        if process_time() > end:
            raise LimitReached

    return ticked


def trial(given: Given) -> dict[str, Any]:
    """Run, and say what it cost and what came of it.

    Returns
    -------
    dict
        `total`, `integration` (seconds), `evaluations`, `steps`, `drift`, `residual`,
        `rows` (numbers as text), `method`; with an accuracy `reached` too; or `why` alone,
        a sentence on why there is no result.
    """
    from lagcli.numerics.equations.refusal import Refusal

    ticked = until(given.limit)
    try:
        problem, request = request_of(given)
        if given.tolerance is None:
            return _claimed(problem, request, ticked, proved=given.method == PROOF)
        return _single(problem, request, given, ticked)
    except LimitReached:
        return {"why": f"takes more than {given.limit:g} s", "long": True}
    except Refusal as refusal:
        return {"why": str(refusal)}


def request_of(given: Given) -> tuple[Problem, RunRequest]:
    """The problem, and the request for its coordinates and velocities."""
    from lagcli.numerics.hybrid.request import RunRequest
    from lagcli.pipeline import Request, read, with_lagrangian
    from lagcli.reader.columns import usual_columns

    values = Request(settings=given.settings, state=given.state)
    problem = read(given.name, given.text.encode(), values).problem
    assert problem is not None  # it has been read before
    problem = with_lagrangian(problem)
    request = RunRequest(
        until=given.until,
        accuracy=given.accuracy or min(0.1, max(_LEAST, 100 * (given.tolerance or 0.0))),
        samples=given.samples,
        columns=tuple(usual_columns(problem)),
        project=given.project,
        method="auto" if given.method == PROOF else given.method,
        whole=given.whole,
        furthest=False,
    )
    return problem, request


def _single(
    problem: Problem, request: RunRequest, given: Given, ticked: Callable[[float], None]
) -> dict[str, Any]:
    from lagcli.numerics.certified.methods import METHODS
    from lagcli.numerics.certified.prepared import RunOrder
    from lagcli.numerics.certified.ready_setup import ready_setup
    from lagcli.numerics.integrators.steps import Tolerance

    setup, modes = ready_setup(problem, request)
    made = METHODS[given.method].prepare(setup, modes)
    if isinstance(made, str):
        return {"why": made, "unsuited": True}
    assert given.tolerance is not None
    tolerance = max(given.tolerance, made.finest)
    n, longest = len(setup.equations.q), request.until / _PARTS

    def once() -> tuple[Run, float]:
        bound = Tolerance(tolerance, n, request.until, longest, None, made.floor)
        before = process_time()
        return made.run(
            RunOrder(bound=bound, times=setup.times, progress=ticked)
        ), process_time() - before

    with made.precision():
        run, integration = once()
        rows = run.rows()
        total = process_time()
        for _ in range(_AGAIN - 1):
            if max(integration, process_time() - total) > _SECONDS:
                break
            integration = min(integration, once()[1])
        if run.stop is not None:
            from lagcli.numerics.certified.certificate import why_stopped

            why = why_stopped(modes.first.motion, run.stop)
            return {"why": f"stops at t = {run.stop.t:.6g}: {why}"}
        return {
            "total": total,
            "integration": integration,
            "evaluations": run.evaluations,
            "steps": run.steps,
            "drift": _drift(run, rows, len(request.columns)),
            "residual": _residual(run),
            "method": run.method_name,
            "rows": _texts(rows_shown(setup, run, rows)),
        }


def _drift(run: Run, rows: list[list[Any]], first: int) -> float | None:
    """The largest change of a charge, relative to the sum of its terms."""
    from lagcli.numerics.certified.drift import changes
    from lagcli.numerics.certified.scales import relative

    return max(
        (
            relative(max(map(abs, found)), scale)
            for j in range(len(rows[0]) - first)
            for _, found, scale in changes(run, j, [row[first + j] for row in rows])
        ),
        default=None,
    )


def _residual(run: Run) -> float | None:
    """The largest residual of a constraint or of its rate, relative to its terms."""
    surfaces = [phase.surface for phase in run.phases if phase.surface is not None]
    return max((x for surface in surfaces for x in surface.residuals), default=None)


def _claimed(
    problem: Problem, request: RunRequest, ticked: Callable[[float], None], *, proved: bool
) -> dict[str, Any]:
    """A run that states its accuracy: proved, or with a certificate."""
    if proved:
        from lagcli.numerics.rigorous import prove

        proof = prove(problem, request, ticked)
        result, rows = proof.as_result(), proof.rows
    else:
        from lagcli.numerics.certified.simulate import simulate

        result = simulate(problem, request, ticked)
        rows = result.rows
    total = process_time()
    held = result.certificate
    residuals = [x or 0.0 for pair in held.constraints.values() for x in pair]
    return {
        "total": total,
        "integration": None,
        "evaluations": result.evaluations or None,
        "steps": result.steps,
        "drift": max(held.charges.values(), default=None),
        "residual": max(residuals, default=None),
        "method": result.method,
        "reached": held.reached,
        "rows": _texts(rows),
    }


def rows_shown(setup: Setup, run: Run, rows: Sequence[Sequence[Any]]) -> list[Sequence[Any]]:
    """The requested columns, at the requested times."""
    count = len(setup.request.columns)
    return [
        row[:count]
        for mark, row in zip(run.marks, rows, strict=True)
        if mark.sample >= 0 and mark.sample % setup.every == 0
    ]


def decimal_of(value: Any) -> Decimal | None:
    """Every digit: a double is a sum of powers of two, and written as that number."""
    if value is None or isinstance(value, float):
        return None if value is None else Decimal(value)
    return Decimal(value.mid().str(DIGITS, radius=False))


def _texts(rows: Sequence[Sequence[Any]]) -> list[list[str | None]]:
    return [[None if x is None else str(decimal_of(x)) for x in row] for row in rows]


def main() -> None:
    """Read from standard input, write to standard output."""
    from lagcli.sparing import collect_rarely

    collect_rarely()
    given: Mapping[str, Any] = json.load(sys.stdin)
    made = Given(**{**given, **{name: tuple(given[name]) for name in ("settings", "state")}})
    json.dump(trial(made), sys.stdout)


if __name__ == "__main__":
    main()
