"""Rows of single commands: start-up, a solve cold and from the cache, the library's check."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence

from tests.bench.measure import IMPORT_SYMPY, IMPORT_TYPER, LAGCLI, ROOT, Row, cost

HOOP = "problems/hoop.yaml"


def rows(runs: int) -> Iterator[Row]:
    """What is told without algebra against `import typer`, the hoop against `import sympy`."""
    for words in ("--help", "solve --help", "formats"):
        yield _ratio(f"lagcli {words}", [*LAGCLI, *words.split()], IMPORT_TYPER, 2.0, runs)
    asked = {"_LAGCLI_COMPLETE": "complete_bash", "COMP_WORDS": "lagcli so", "COMP_CWORD": "1"}
    completion = ["env", *(f"{name}={value}" for name, value in asked.items()), *LAGCLI]
    yield _ratio("completion of 'lagcli so'", completion, IMPORT_TYPER, 2.0, runs)
    solve = [*LAGCLI, "solve", HOOP]
    yield _ratio("lagcli solve hoop", [*solve, "--no-cache"], IMPORT_SYMPY, 1.4, runs)
    cost(solve)  # the first of them fills the cache
    yield _ratio("the same again, from the cache", solve, IMPORT_SYMPY, 0.4, runs)


def _ratio(what: str, command: Sequence[str], other: Sequence[str], bar: float, runs: int) -> Row:
    """Both in turn, so that they see the same load; the least is what one takes undisturbed."""
    pairs = [(cost(command), cost(other)) for _ in range(runs)]
    cpu, other_cpu = (min(c.cpu for c in side) for side in zip(*pairs, strict=True))
    wall, other_wall = (min(c.wall for c in side) for side in zip(*pairs, strict=True))
    note = f"{cpu:.3f} s CPU; on the wall {wall / other_wall:.2f} x"
    return Row(what, cpu / other_cpu, f"x {other[-1]}", bar, note=note)


def check_row(paths: Sequence[str]) -> Row:
    """The library's check on two cores: seconds on the wall for each problem."""
    count = sum(
        len(list((ROOT / path).rglob("*.yaml"))) if (ROOT / path).is_dir() else 1 for path in paths
    )
    load = os.getloadavg()[0]
    used = cost([*LAGCLI, "check", *paths, "--jobs", "2"], good=(0, 1))
    note = f"{count} problems; CPU on two cores {used.cpu / 2 / count:.3f} s; load {load:.1f}"
    return Row("lagcli check, each problem", used.wall / count, "s", 0.25, note=note)
