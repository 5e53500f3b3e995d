"""Rows of long runs: integration alone against heyoka, constraints kept, charges kept.

For integration alone both programs get the loosest tolerance at which the true error at the
end is 1e-9, lagcli without its certificate; compilation is not counted.

    LAGCLI_PEERS=/path/to/python    a Python that has heyoka
    python tests/bench/long_rows.py [--kepler] [SYSTEM]...
"""

from __future__ import annotations

import json
import math
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli.studies.tradeoff.study import answer
from lagcli.studies.tradeoff.trial import Given
from tests.bench.measure import HERE, LAGCLI, ROOT, Row, cost, show
from tests.bench.motion_rows import error_of, peers
from tests.bench.motions import SYSTEMS, System

#: Spans at which integration is what counts; no span of a chaotic motion at 1e-9 is long.
SPANS = {
    "plane pendulum": 20000.0,
    "spherical pendulum": 10000.0,
    "Kepler, 100 orbits": 628.3185307179587,
    "heavy top": 5000.0,
    "stiff spring pendulum": 100.0,
}
_BAR, _ACCURACY, _LIMIT = 1.5, 1e-9, 120
_TOLERANCES = [10.0**-k for k in range(8, 19)]
#: What holds a surface for long: file, span, accuracy.
_HELD = (
    ("problems/benchmarks/simple-pendulum.yaml", "2000", "1e-6"),
    ("problems/pendulums/pendulum-cartesian.yaml", "1e4", "1e-6"),
    ("tests/benchmarks/n-four-bar.yaml", "10", "1e-6"),
    ("tests/benchmarks/andrews-squeezer.yaml", "0.03", "1e-9"),
    ("tests/benchmarks/bricard.yaml", "10", "1e-6"),
)
_KEPLER = """\
coordinates: [x, y]
L: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)
symmetries: {rotation: {x: -y, y: x}}
initial: {x: 0.1, y: 0, x': 0, y': 4.358898943540674}
"""
_PERIODS, _TOLERANCE, _LONG = 1_000_000, 1e-18, 1200


def rows(runs: int, names: Sequence[str] = ()) -> Iterator[Row]:
    """Integration alone, as a part of heyoka's."""
    python = peers("heyoka")
    for name in names or SPANS:
        what = f"integrate {name}, against heyoka"
        if python is None:
            yield Row(what, None, "x", note="heyoka is not installed")
            continue
        system = SYSTEMS[name]._replace(until=SPANS[name], accuracy=_ACCURACY)
        yield _alone(what, name, system, python, runs)


def _alone(what: str, name: str, system: System, python: str, runs: int) -> Row:
    truth = json.loads(_simulated(system))
    columns = list(zip(*truth["rows"], strict=True))[1:]
    scales = [max(1.0, *map(abs, column)) for column in columns]
    true = [column[-1] for column in columns]
    resolved = max(truth["certificate"]["global_error"].values())
    ours = _ours(system, true, scales, runs)
    theirs = _theirs(name, system, python, true, scales, runs)
    if ours is None or not theirs:
        who = "lagcli" if ours is None else "heyoka"
        value = None if ours is None else 0.0
        note = f"{who} does not reach 1e-9; the reference is known to {resolved:.0e}"
        return Row(what, value, "x", _BAR, note=note)
    note = f"{ours * 1e3:.2f} ms against {theirs * 1e3:.2f} ms over t = {system.until:g}"
    return Row(what, ours / theirs, "x", _BAR, note=note)


def _simulated(system: System) -> bytes:
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(system.problem())
        file.flush()
        options = ["--until", repr(system.until), "--accuracy", "1e-11", "-f", "json"]
        command = [*LAGCLI, "simulate", file.name, *options, "--method", "taylor80"]
        return cost(command, good=(0, 1)).out


def _ours(
    system: System, true: Sequence[float], scales: Sequence[float], runs: int
) -> float | None:
    """Seconds of the cheapest compiled run that is good enough."""
    best: float | None = None
    for method in ("taylor64", "taylor80"):
        for tolerance in _TOLERANCES:
            given = Given(
                name="bench", text=system.problem(), settings=(), state=(), until=system.until, samples=101,
                project=False, method=method, tolerance=tolerance, accuracy=None, limit=_LIMIT,
            )  # fmt: skip
            found = answer(given)
            if "why" in found:
                continue
            end = [float(x) for x in found["rows"][-1][1:]]
            if error_of(end, true, scales) <= system.accuracy:
                again = [answer(given)["integration"] for _ in range(runs - 1)]
                seconds = min([found["integration"], *again])
                best = seconds if best is None else min(best, seconds)
                break
        if best is not None:
            break
    return best


def _theirs(
    name: str,
    system: System,
    python: str,
    true: Sequence[float],
    scales: Sequence[float],
    runs: int,
) -> float | None:
    script = [python, str(HERE / "peers" / "with_heyoka.py"), name]
    for tolerance in _TOLERANCES:
        command = [*script, f"{tolerance:.0e}", repr(system.until)]
        run = cost(command, limit=_LIMIT)
        if run.status or error_of(json.loads(run.out)["end"], true, scales) > system.accuracy:
            continue
        outs = [run, *(cost(command) for _ in range(runs - 1))]
        return min(float(json.loads(each.out)["run"]) for each in outs)
    return None


def held_rows() -> Iterator[Row]:
    """The largest residual of a constraint along long runs."""
    for path, until, accuracy in _HELD:
        options = ["--until", until, "--accuracy", accuracy, "--whole-model", "-f", "json"]
        run = cost([*LAGCLI, "simulate", str(ROOT / path), *options], good=(0, 1))
        found = json.loads(run.out)["certificate"]["constraints"].values()
        worst = max(abs(each[key] or 0.0) for each in found for key in each)
        what = f"residual, {Path(path).stem}"
        yield Row(what, worst * 1e12, "e-12", 1.0, note=f"{worst:.1e} until t = {until}")


def kepler_row() -> Row:
    """Energy and angular momentum of e = 0.9 over 1e6 periods; some three minutes."""
    given = Given(
        name="Kepler", text=_KEPLER, settings=(), until=2 * math.pi * _PERIODS, samples=101,
        project=False, method="taylor80", tolerance=_TOLERANCE, accuracy=None, limit=_LONG,
    )  # fmt: skip
    found = answer(given)
    note = f"{found['steps']:,} steps in {found['integration']:.0f} s"
    drift = found["drift"]
    return Row("charges over 1e6 periods, e = 0.9", drift * 1e12, "e-12", 1.0, note=note)


def main() -> None:
    """Show the rows."""
    names = [word for word in sys.argv[1:] if not word.startswith("-")]
    if "--kepler" in sys.argv[1:]:
        show(kepler_row())
        return
    for row in rows(3, names):
        show(row)
    if not names:
        for row in held_rows():
            show(row)


if __name__ == "__main__":
    main()
