"""Whether certificates are true: the error of runs that claim an accuracy, and how many claim it.

    python -m tests.bench.certificate [--workers N] [--limit SECONDS] [--keep FILE] [--started]
        [PATH]...

Every problem of the library, the benchmarks and the systems of `motions` that has an initial
state is run by `simulate` at 1e-3, 1e-6, 1e-9 and 1e-12, each run in a process of its own, and
compared with a reference of more digits than doubles (or the exact solution that the file gives;
or, where neither is possible, the best that can be certified in doubles by another method).
Parameters without a value are given one; with `--started` so are the initial states of the
other problems.  A motion that an event ends is looked at up to the event.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli.diagnostics import ProblemError
from lagcli.evaluation import value_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pipeline import Request, read
from lagcli.problem_data import Problem
from lagcli.record import replace
from lagcli.studies.tradeoff.front import ACCURACIES
from lagcli.studies.tradeoff.reference import ReferenceMotion, numbers, reference
from lagcli.studies.tradeoff.study import answer
from lagcli.studies.tradeoff.trial import Given, request_of
from tests.bench.measure import ROOT, Row, show
from tests.bench.motions import SYSTEMS

_UNTIL, _SAMPLES = 10.0, 11
#: Motions whose neighbours part exponentially: there an accuracy may be out of reach.
CHAOTIC = {
    "double pendulum", "chain of 10", "Pleiades",
    "problems/pendulums/double-pendulum.yaml",
    "problems/pendulums/double-pendulum-equal.yaml",
    "problems/chains/triple-pendulum.yaml",
    "problems/chains/cartesian-double-pendulum.yaml",
    "problems/classics/swinging-atwood-machine.yaml",
    "problems/forces/double-pendulum-pushed.yaml",
    "problems/particles/henon-heiles.yaml",
    "problems/particles/restricted-three-body.yaml",
}  # fmt: skip

#: What doubles are compared with where there is nothing better.
_OTHER, _GOOD = "dop853", 1e-11
#: Values that are usual.
_SET = {"g": 9.81, "c": 3.1}
#: A motion that ends by itself is looked at for this part of its time.
_BEFORE_END = 0.99

#: What a run came to: accuracy -> reached, error, until when, method, seconds, why.
Found = dict[str, Any]


def givens(paths: Sequence[str], limit: float, *, started: bool = False) -> Iterator[Given]:
    """The problems that can be run; all of them without paths, or those without a state."""
    files = [ROOT / path for path in paths]
    if not paths:
        files = [
            p for name in ("problems", "tests/benchmarks") for p in (ROOT / name).rglob("*.yaml")
        ]
    for path in sorted(files):
        text = path.read_text("utf-8")
        problem = read(str(path), text.encode(), Request()).problem
        if problem is None or bool(problem.initial) == started:
            continue
        until = problem.simulation.until
        end = None if until is None else value_of(until)
        made = _given(str(path.relative_to(ROOT)), text, float(end or _UNTIL), limit)
        yield replace(made, **_values(problem))
    if not paths and not started:
        for name, system in SYSTEMS.items():
            yield _given(name, system.problem(), system.until, limit)


def _given(name: str, text: str, until: float, limit: float) -> Given:
    return Given(
        name=name, text=text, settings=(), state=(), until=until, samples=_SAMPLES, project=False,
        method="auto", tolerance=None, accuracy=ACCURACIES[0], limit=limit,
    )  # fmt: skip


def _values(problem: Problem) -> dict[str, Any]:
    """Numbers for what has none in the file, no two alike."""
    lacking = [p.name for p in problem.parameters if p.value is None]
    settings = [f"{name}={_SET.get(name, 0.7 + 0.13 * k)}" for k, name in enumerate(lacking)]
    found: dict[str, Any] = {"settings": tuple(settings)}
    if not problem.initial:
        names = [q.name for q in problem.coordinates]
        state = [f"{name}={0.3 + 0.11 * k}" for k, name in enumerate(names)]
        state += [f"{name}'={0.4 - 0.17 * k}" for k, name in enumerate(names)]
        found |= {"state": tuple(state), "project": True}
    return found


def examined(given: Given) -> Found:
    """All accuracies of one problem against its reference."""
    found: Found = {"name": given.name, "until": given.until, "runs": {}}
    settled = Request(settings=given.settings, state=given.state)
    checked = read(given.name, given.text.encode(), settled)
    if checked.problem is None:
        return {**found, "why": "; ".join(each.message for each in checked.diagnostics)}
    first = answer(given)
    end = float(first["rows"][-1][0]) if first.get("reached") else given.until
    if end < given.until:
        given = replace(given, until=_BEFORE_END * end)
        found["until"] = given.until
    try:
        problem, request = request_of(given)
        known = _known(problem, request, 3 * given.limit)
    except (Refusal, ProblemError) as refusal:
        return {**found, "why": str(refusal)}
    found |= {"reference": known.kind, "bound": known.bound}
    for accuracy in ACCURACIES:
        told = answer(replace(given, accuracy=accuracy))
        found["runs"][f"{accuracy:.0e}"] = judged(told, accuracy, known)
    return found


def _known(problem: Problem, request: RunRequest, limit: float) -> ReferenceMotion:
    """A reference, if it is good enough by a method that `auto` does not begin with."""
    try:
        found = reference(problem, replace(request, method=_OTHER), limit)
    except Refusal:
        return reference(problem, request, limit)
    return found if found.bound <= _GOOD else reference(problem, request, limit)


def judged(told: Mapping[str, Any], accuracy: float, known: ReferenceMotion) -> Found:
    if "why" in told:
        return {"reached": False, "why": told["why"], "holds": True}
    rows = numbers(told["rows"])
    # what is shown of a run that does not come to the end is claimed as well
    shown = {row[0]: row for row in rows}
    error = known.error([shown.get(row[0], row) for row in known.rows])
    return {
        "reached": told["reached"],
        "error": error,
        "holds": error <= accuracy + known.bound,
        "until": float(rows[-1][0] or 0) if rows else 0.0,
        "method": told["method"],
        "seconds": told["total"],
        "residual": told["residual"],
    }


def rows(found: Sequence[Found]) -> Iterator[Row]:
    """The bars: claims that hold, and claims on motions that are not chaotic."""
    known = [each for each in found if each["runs"]]
    runs = [(each, key, run) for each in known for key, run in each["runs"].items()]
    false = [f"{each['name']} at {key}" for each, key, run in runs if not run["holds"]]
    share = 100 * (1 - len(false) / len(runs)) if runs else 0.0
    note = f"{len(known)} problems, {len(runs)} runs" + "".join(f"; {each}" for each in false)
    yield Row("certificates that are true", share, "%", 100, at_least=True, note=note)
    regular = [(each, key, run) for each, key, run in runs if each["name"] not in CHAOTIC]
    for accuracy in (*(f"{a:.0e}" for a in ACCURACIES), ""):
        request = [run for _, key, run in regular if accuracy in ("", key)]
        claimed = sum(run["reached"] for run in request)
        what = f"claimed, not chaotic, {accuracy or 'all'}"
        share = 100 * claimed / len(request) if request else 0.0
        yield Row(what, share, "%", None if accuracy else 95, at_least=True, note=f"{len(request)}")
    residuals = [run.get("residual") or 0.0 for _, _, run in runs]
    worst = max(residuals, default=0.0)
    yield Row("constraint residual", worst * 1e12, "e-12", 1.0, note="the largest of all runs")


def study(request: Iterator[Given], workers: int, keep: Path | None) -> list[Found]:
    """Examine the problems, told as they come; what is kept is not examined again."""
    found = [json.loads(line) for line in keep.read_text().splitlines()] if _is_there(keep) else []
    done = {each["name"] for each in found}
    left = [given for given in request if given.name not in done]
    with ProcessPoolExecutor(workers) as pool:
        for each in pool.map(examined, left):
            found.append(each)
            _tell(each)
            if keep is not None:
                with keep.open("a") as file:
                    file.write(json.dumps(each) + "\n")
    return found


def _is_there(keep: Path | None) -> bool:
    return keep is not None and keep.exists()


def _tell(each: Found) -> None:
    """One line: for each accuracy the error, or why there is no claim."""
    if not each["runs"]:
        print(f"{each['name']}: not run: {each['why']}", flush=True)
        return
    parts = []
    for key, run in each["runs"].items():
        error = "-" if run.get("error") is None else f"{run['error']:.0e}"
        mark = "" if run["reached"] else f" until {run.get('until', 0):g} only"
        parts.append(f"{key}: {error}{mark}{'' if run['holds'] else ' FALSE'}")
    print(f"{each['name']}: {', '.join(parts)}", flush=True)


def main() -> int:
    """Examine, tell, and give the bars."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("paths", nargs="*", help="problem files, from the root; all without")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--limit", type=float, default=20, help="CPU seconds of each run")
    parser.add_argument("--keep", type=Path, help="a file that results are added to")
    parser.add_argument("--started", action="store_true", help="problems without a state, in one")
    request = parser.parse_args()
    given = givens(request.paths, request.limit, started=request.started)
    found = study(given, request.workers, request.keep)
    measured = list(rows(found))
    for row in measured:
        show(row)
    return 0 if all(row.holds for row in measured) else 1


if __name__ == "__main__":
    sys.exit(main())
