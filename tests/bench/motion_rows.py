"""Rows of `lagcli simulate` against scripts with SciPy, CasADi and heyoka.

Each script is given the loosest tolerance at which its true error is the accuracy that is
asked of lagcli; times are the CPU times of fresh processes, the certificate included.

    LAGCLI_PEERS=/path/to/python    a Python that has sympy, scipy, casadi and heyoka
    python tests/bench/motion_rows.py [SYSTEM]...
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.bench.measure import HERE, LAGCLI, ROOT, Row, cost, show
from tests.bench.motions import HELD, SYSTEMS, Held, System

#: script -> the most that lagcli may take, as a part of it
BARS = {"scipy": 0.4, "heyoka": 1.0, "casadi": 2.5}
_LIMIT = 60  # CPU seconds of a script
_TOLERANCES = [10.0**-k for k in range(4, 16)]


def rows(runs: int, names: Sequence[str] = ()) -> Iterator[Row]:
    """For each system (or those named) and each script, the ratio of the total times."""
    for name in names or (*SYSTEMS, *HELD):
        with tempfile.TemporaryDirectory() as folder:
            if name in HELD:
                held = HELD[name]
                given, written = ROOT / held.path, Path(folder) / "problem.json"
                # other programs read JSON: their Python need not have YAML
                written.write_text(json.dumps(yaml.safe_load(given.read_text("utf-8"))), "utf-8")
                settings = [f"--set={key}={value}" for key, value in held.values.items()]
                command = [*LAGCLI, "simulate", str(given), *settings]
                yield from _system(name, held, command, str(written), runs)
            else:
                file = Path(folder) / "problem.yaml"
                file.write_text(SYSTEMS[name].problem(), "utf-8")
                yield from _system(name, SYSTEMS[name], [*LAGCLI, "simulate", str(file)], "", runs)


def _system(
    name: str, system: System | Held, command: Sequence[str], written: str, runs: int
) -> Iterator[Row]:
    command = [*command, "--until", repr(system.until), "-f", "json"]
    finest = system.accuracy * 1e-3
    best = json.loads(cost([*command, "--accuracy", repr(finest)], good=(0, 1)).out)
    scales = [max(1.0, *map(abs, column)) for column in list(zip(*best["rows"], strict=True))[1:]]
    true = best["rows"][-1][1:]
    ours = [*command, "--accuracy", repr(system.accuracy)]
    found = json.loads(cost(ours, good=(0, 1)).out)
    error = error_of(found["rows"][-1][1:], true, scales)
    own = min(cost(ours, good=(0, 1)).cpu for _ in range(runs))
    note = f"{own:.3f} s, error {error:.0e} of {system.accuracy:.0e}, {found['method']['name']}"
    yield Row(f"simulate {name}", error / system.accuracy, "of the accuracy", 1.0, note=note)
    for peer, bar in BARS.items():
        python = peers(peer)
        what = f"simulate {name}, total against {peer}"
        if python is None:
            yield Row(what, None, "x", note=f"{peer} is not installed")
            continue
        script = [python, str(HERE / "peers" / f"with_{peer}.py"), name]
        if written:
            script = [python, str(HERE / "peers" / "held.py"), peer, name, written]
        tuned = _tuned(script, system, true, scales)
        if tuned is None:
            yield Row(what, 0.0, "x", bar, note="it does not reach the accuracy")
            continue
        runs_of = [cost(tuned) for _ in range(runs)]
        theirs = min(run.cpu for run in runs_of)
        alone = min(json.loads(run.out)["run"] for run in runs_of)
        told = f"{theirs:.3f} s at {tuned[-1]}, {alone * 1e3:.1f} ms of it integration"
        yield Row(what, own / theirs, "x", bar, note=told)


def _tuned(
    script: Sequence[str], system: System | Held, true: Sequence[float], scales: Sequence[float]
) -> list[str] | None:
    """The script with the loosest tolerance that reaches the accuracy."""
    for tolerance in _TOLERANCES:
        command = [*script, f"{tolerance:.0e}"]
        run = cost(command, limit=_LIMIT)
        if run.status:
            if run.cpu > _LIMIT - 1:
                return None
            continue
        if error_of(json.loads(run.out)["end"], true, scales) <= system.accuracy:
            return command
    return None


def error_of(found: Sequence[float], true: Sequence[float], scales: Sequence[float]) -> float:
    return max(abs(a - b) / s for a, b, s in zip(found, true, scales, strict=True))


@cache
def peers(package: str) -> str | None:
    """The Python that has a package."""
    for python in (os.environ.get("LAGCLI_PEERS"), sys.executable):
        if python and not cost([python, "-c", f"import {package}"], good=range(256)).status:
            return python
    return None


if __name__ == "__main__":
    for row in rows(3, sys.argv[1:]):
        show(row)
