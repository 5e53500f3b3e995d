"""What `auto` costs beside the best method: total CPU time of fresh processes, certificates included.

Each system runs over three spans at 1e-3, 1e-6, 1e-9 and 1e-12; the best is the cheapest method
whose certificate says that the accuracy was reached.  What takes longer than `auto` is ended.
All that is compiled is compiled anew (`LAGCLI_NO_CACHE`), or with `--kept` taken from what
earlier runs have compiled.

    python tests/bench/auto_rows.py [--kept] [--runs N] [SYSTEM]...
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli.numerics.certified.methods import METHODS
from lagcli.record import replace
from lagcli.studies.tradeoff.front import ACCURACIES
from lagcli.studies.tradeoff.study import answer
from lagcli.studies.tradeoff.trial import Given
from tests.bench.measure import ROOT, Row, show
from tests.bench.motions import SYSTEMS

#: Constrained systems: file, span, values.
FILES: dict[str, tuple[str, float, tuple[str, ...]]] = {
    "spherical pendulum, Cartesian": (
        "problems/classics/spherical-pendulum-cartesian.yaml",
        20.0,
        ("m=1", "g=9.81", "l=1", "v0=1"),
    ),
    "A01, simple pendulum": ("problems/benchmarks/simple-pendulum.yaml", 10.0, ()),
    "A02, N four-bar": ("tests/benchmarks/n-four-bar.yaml", 10.0, ()),
    "A03, Andrews' squeezer": ("tests/benchmarks/andrews-squeezer.yaml", 0.03, ()),
    "A04, Bricard": ("tests/benchmarks/bricard.yaml", 10.0, ()),
    "A05, flyball governor": ("tests/benchmarks/flyball-governor.yaml", 10.0, ()),
}
_PARTS = (0.05, 1.0, 5.0)
_BAR, _SHARE = 1.5, 90.0
#: CPU seconds of a run; that of another than `auto` is at least the first, whatever `auto` took.
_LEAST, _LIMIT = 0.2, 20.0


def rows(runs: int, names: Sequence[str] = (), *, kept: bool = False) -> Iterator[Row]:
    """The ratio for each system, span and accuracy, and the share that is within the bar."""
    os.environ["LAGCLI_NO_CACHE"] = "" if kept else "1"
    ratios: list[float] = []
    for name in names or (*SYSTEMS, *FILES):
        for part in _PARTS:
            for accuracy in ACCURACIES:
                row = _row(name, part, accuracy, runs)
                yield row
                if row.value is not None:
                    ratios.append(row.value)
    good = sum(ratio <= _BAR for ratio in ratios)
    how = "code kept" if kept else "code compiled anew"
    share = 100 * good / len(ratios) if ratios else None
    note = f"{good} of {len(ratios)}, {how}"
    yield Row("auto within 1.5 of the best", share, "%", _SHARE, at_least=True, note=note)


def _row(name: str, part: float, accuracy: float, runs: int) -> Row:
    if name in FILES:
        path, until, settings = FILES[name]
        text = (ROOT / path).read_text("utf-8")
    else:
        text, until, settings = SYSTEMS[name].problem(), SYSTEMS[name].until, ()
    given = Given(
        name=name,
        text=text,
        settings=settings,
        state=(),
        until=part * until,
        samples=101,
        project=False,
        method="auto",
        tolerance=None,
        accuracy=accuracy,
        limit=_LIMIT,
    )
    what = f"  {name}, t = {given.until:g}, {accuracy:.0e}"
    taken, auto = _taken(given)
    limit = _LIMIT if auto is None else max(_LEAST, auto)
    others = {method: replace(given, method=method, limit=limit) for method in METHODS}
    known = {
        method: seconds
        for method, other in others.items()
        if (seconds := _taken(other)[1]) is not None
    }
    if not known:
        told = "no method reaches it" if auto is None else f"{auto:.3f} s by {taken}, alone"
        return Row(what, None if auto is None else 1.0, "x", note=told)
    best = min(known, key=known.__getitem__)
    if auto is None:
        return Row(what, 99.0, "x", note=f"not reached; {known[best]:.3f} s by {best}")
    again = replace(others[best], limit=_LIMIT)
    for _ in range(runs - 1):
        auto = min(auto, _taken(given)[1] or auto)
        known[best] = min(known[best], _taken(again)[1] or auto)
    note = f"{auto:.3f} s by {taken}, {known[best]:.3f} s by {best}"
    return Row(what, auto / known[best], "x", note=note)


def _taken(given: Given) -> tuple[str, float | None]:
    """The method that answers, and the time; None where the accuracy is not reached."""
    found = answer(given)
    return found.get("method", ""), found["total"] if found.get("reached") else None


def main() -> None:
    """Show the rows."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kept", action="store_true", help="take what earlier runs compiled")
    parser.add_argument(
        "--runs", type=int, default=2, help="of auto and the best: the shortest counts"
    )
    parser.add_argument("names", nargs="*", metavar="SYSTEM")
    arguments = parser.parse_args()
    for row in rows(arguments.runs, arguments.names, kept=arguments.kept):
        show(row)


if __name__ == "__main__":
    main()
