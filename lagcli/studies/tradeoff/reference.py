"""The motion better than any of the methods: the exact one, or two runs in many digits.

Power series with enough digits that two runs, one with more digits and a finer tolerance
than the other, agree far below what doubles can resolve; twice their difference is the
bound.  Where the file knows the motion (`expect: trajectory`) its formulas are taken,
after a look at whether the motion computed follows them.
"""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Context, Decimal, localcontext
from time import process_time
from typing import TYPE_CHECKING, Any

from lagcli.numerics.certified.prepared import Prepared, RunOrder
from lagcli.numerics.certified.ready_setup import ready_setup
from lagcli.numerics.certified.scales import relative
from lagcli.numerics.certified.simulate import simulate
from lagcli.numerics.equations.coupling import coupling, groups
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.modes import Modes
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.numerics.hybrid.setup import Setup
from lagcli.numerics.integrators.steps import Tolerance, component_scales
from lagcli.record import record, replace
from lagcli.studies.tradeoff.trial import DIGITS, LimitReached, decimal_of, rows_shown, until

if TYPE_CHECKING:
    from lagcli.problem_data import Problem

#: Digits of the better run, and the local tolerance of both.
_LADDER = ((34, 1e-22, 1e-25), (52, 1e-36, 1e-40), (90, 1e-70, 1e-75))
_BETWEEN = 8  # digits fewer in the other run
_GOOD = 1e-17
#: The accuracy of a run in doubles, where nothing better is possible.
_DOUBLES = (1e-12, 1e-10, 1e-8, 1e-6)
#: A formula further from the motion than this is not its solution.
_FOLLOWS = 1e-6
_EXACT_DIGITS = 40

Rows = tuple[tuple[Decimal | None, ...], ...]
Scales = Sequence[float] | None


@record(kw_only=True)
class ReferenceMotion:
    """The motion at the samples.

    Attributes
    ----------
    rows
        t, the coordinates, the velocities.
    bound
        Of the error, relative to the scale of the column.
    kind
        How it is known.
    seconds
        What it took.
    scales
        What the errors of the columns are relative to.
    cut
        Whether a run integrates less than the file has, or parts that move without each other.
    warnings
        What was noticed on the way.
    """

    rows: Rows
    bound: float
    kind: str
    seconds: float
    scales: Scales = None
    cut: bool = False
    warnings: tuple[str, ...] = ()

    def error(self, rows: Sequence[Sequence[Decimal | None]]) -> float:
        """The largest error of other rows at the same times."""
        return difference(self.rows, rows, self.scales)


def difference(
    rows: Rows, others: Sequence[Sequence[Decimal | None]], scales: Scales = None
) -> float:
    """The largest difference, each column relative to its scale.

    Without scales, to its peak in the rows; one that is nothing but rounding, beside those of its
    kind: the coordinates, and the velocities.
    """
    if len(rows) != len(others):
        return float("inf")
    with localcontext(Context(prec=DIGITS)):
        peaks, apart = [], []
        for one, other in zip(zip(*rows, strict=True), zip(*others, strict=True), strict=True):
            pairs = [
                (a, b) for a, b in zip(one, other, strict=True) if a is not None and b is not None
            ]
            peaks.append(max((abs(a) for a, _ in pairs), default=Decimal(0)))
            apart.append(max((abs(a - b) for a, b in pairs), default=Decimal(0)))
    if scales is None:
        until, *state = peaks
        scales = [float(until), *component_scales(state, float(until) or 1.0)]
    return max(relative(float(d), scale) for d, scale in zip(apart, scales, strict=True))


def numbers(rows: Sequence[Sequence[str | None]]) -> Rows:
    """Numbers that were sent as text."""
    return tuple(tuple(None if x is None else Decimal(x) for x in row) for row in rows)


def reference(problem: Problem, request: RunRequest, limit: float) -> ReferenceMotion:
    """The motion, as well as it can be known within a time.

    Parameters
    ----------
    problem
        With its values and an initial state.
    request
        Span and samples.
    limit
        Seconds of processor time for each run.

    Raises
    ------
    Refusal
        When there is nothing to run, or nothing is known of the motion well enough.
    """
    begun = process_time()
    # of the model as it stands in the file: what was cut from it is checked too
    setup, modes = ready_setup(problem, replace(request, whole=True))
    less, _ = ready_setup(problem, request)
    e = less.equations
    parts = groups(*coupling(e.graph, e.q, e.mass, e.forcing, e.constraints))
    cut = len(e.q) < len(setup.equations.q) or len(parts) > 1
    warnings: list[str] = []
    found = _exact(setup, modes, warnings) or _precise(setup, modes, limit, warnings)
    if found is None:
        found = _doubles(problem, request, limit)
    seconds = process_time() - begun
    return replace(found, seconds=seconds, cut=cut, warnings=tuple(warnings))


# -- many digits ---------------------------------------------------------------------------------


def _precise(
    setup: Setup, modes: Modes, limit: float, warnings: list[str]
) -> ReferenceMotion | None:
    from lagcli.numerics.certified.precise import prepared

    best: ReferenceMotion | None = None
    for digits, coarse, fine in _LADDER:
        runs = []
        for carried, tolerance in ((digits - _BETWEEN, coarse), (digits, fine)):
            made = prepared(setup, modes, carried)
            if isinstance(made, str):
                warnings.append(f"no reference with more digits than doubles: {made}")
                return None
            found = _run(setup, made, tolerance, limit)
            if found is None:
                return best
            rows, scales = found
            runs.append(rows)
        bound = 2 * difference(runs[1], runs[0], scales)
        kind = (
            f"power series with {digits} digits; bound: twice the difference to a run with "
            f"{digits - _BETWEEN}"
        )
        best = ReferenceMotion(rows=runs[1], bound=bound, kind=kind, seconds=0.0, scales=scales)
        if bound <= _GOOD:
            return best
    return best if best is not None and best.bound < _FOLLOWS else None


def precise_rows(problem: Problem, request: RunRequest, digits: int, limit: float) -> Rows | None:
    """The rows by power series with this number of digits; None where that is not possible in time.

    One run, without a bound on its error: it confirms what another method has found.

    Raises
    ------
    Refusal
        When there is nothing to run.
    """
    from lagcli.numerics.certified.precise import prepared

    setup, modes = ready_setup(problem, replace(request, whole=True))
    made = prepared(setup, modes, digits)
    if isinstance(made, str):
        return None
    found = _run(setup, made, 10.0 ** (_BETWEEN - digits), limit)
    return None if found is None else found[0]


def _run(
    setup: Setup, made: Prepared, tolerance: float, limit: float
) -> tuple[Rows, list[float]] | None:
    """The rows of one run, and the scales; None where it stops or takes too long."""
    ticked = until(process_time() + limit)
    request, n = setup.request, len(setup.equations.q)
    with made.precision():
        longest = request.until / made.longest[0]
        bound = Tolerance(tolerance, n, request.until, longest, None, made.floor)
        try:
            run = made.run(RunOrder(bound=bound, times=setup.times, progress=ticked))
        except LimitReached:
            return None
        if run.stop is not None:
            return None
        rows = _decimals(rows_shown(setup, run, run.rows()))
    return rows, [request.until, *component_scales(run.peaks, request.until)]


def _decimals(rows: Sequence[Sequence[Any]]) -> Rows:
    return tuple(tuple(map(decimal_of, row)) for row in rows)


# -- the formulas of the file --------------------------------------------------------------------


def _exact(setup: Setup, modes: Modes, warnings: list[str]) -> ReferenceMotion | None:
    """`expect: trajectory`, where it gives every coordinate."""
    from lagcli.expression import Name
    from lagcli.graph.derivative import partial
    from lagcli.numerics.certified.precise import precision
    from lagcli.numerics.equations.arithmetic import Balls
    from lagcli.numerics.equations.constants import constants_of
    from lagcli.numerics.equations.straight_line import straight_line

    known = setup.problem.expect.trajectory
    if known is None:
        return None
    e, read = setup.equations, setup.reading
    formulas = {each.column: read(each.value) for each in known.formulas}
    names = [Name(q.name) for q in e.q]
    if any(name not in formulas for name in names):
        return None
    rate = partial(e.graph, e.t)
    positions = [formulas[name] for name in names]
    nodes = [e.t, *positions, *map(rate, positions)]
    try:
        with precision(_EXACT_DIGITS):
            arithmetic = Balls()
            constants = constants_of(e, nodes, arithmetic)
            at = straight_line((e.t,), nodes, constants, arithmetic)
            times = [arithmetic.ball(t) for t in setup.rows_at]
            found = [at(t) for t in times]
            bound = max((float(x.rad()) for row in found for x in row), default=0.0)
            rows = _decimals(found)
    except (ArithmeticError, ValueError, Refusal) as error:
        warnings.append(f"the formulas of `expect: trajectory` have no numbers: {error}")
        return None
    from lagcli.numerics.certified.methods import METHODS

    made = METHODS["dop853"].prepare(setup, modes)
    assert not isinstance(made, str)
    near = _run(setup, made, 1e-12, float("inf"))
    if near is None or not difference(rows, *near) <= _FOLLOWS:
        warnings.append("the motion does not follow the formulas of `expect: trajectory`")
        return None
    kind = f"the exact solution of the file, in {_EXACT_DIGITS} digits"
    return ReferenceMotion(rows=rows, bound=bound, kind=kind, seconds=0.0, scales=near[1])


# -- doubles -------------------------------------------------------------------------------------


def _doubles(problem: Problem, request: RunRequest, limit: float) -> ReferenceMotion:
    """The best that can be certified in doubles; its bound is no better than that."""
    last = ""
    for accuracy in _DOUBLES:
        ticked = until(process_time() + limit)
        try:
            result = simulate(problem, replace(request, accuracy=accuracy), ticked)
        except LimitReached:
            last = f"it takes more than {limit:g} s"
            continue
        last = result.refusal
        if result.certificate.reached:
            break
    else:
        raise Refusal(f"no reference to measure against: {last}", mistake=False)
    bound = max(result.certificate.global_error.values())
    kind, scales = f"{result.method} with its certificate", result.certificate.scales
    return ReferenceMotion(
        rows=_decimals(result.rows), bound=bound, kind=kind, seconds=0.0, scales=scales
    )
