"""Operations of the printed accelerations and multipliers, over the library.

    python tests/bench/operations.py [PATH…] [--simplify FILE] [--limit SECONDS]

Against the textbook's form where `expect` holds one, and, with --simplify, against what
sympy.simplify makes of the LUsolve solution of the same system; that is slow, so FILE keeps it
(JSON: path -> [[name, operations], …]) and only what is missing there is worked out.
"""

from __future__ import annotations

import argparse
import json
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import sympy

from lagcli.algebra import to_expression
from lagcli.expression import Expression, operation_count
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.statements import Statements
from lagcli.pipeline import load
from lagcli.problem import Problem

ROOT = Path(__file__).parents[2]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("paths", nargs="*", type=Path, default=[ROOT / "problems"])
    parser.add_argument("--simplify", type=Path, metavar="FILE")
    parser.add_argument("--limit", type=float, default=12, help="CPU seconds per simplify")
    arguments = parser.parse_args()
    known = {}
    if arguments.simplify and arguments.simplify.exists():
        known = json.loads(arguments.simplify.read_text())
    against_book, against_simplify = Score("expect"), Score("sympy.simplify")
    for path in _files(arguments.paths):
        problem = load(path)
        key = str(path.resolve().relative_to(ROOT)) if path.is_absolute() else str(path)
        derivation = Derivation(problem)
        printed = dict(_printed(derivation))
        for name, node in _expected(problem):
            against_book.add(key, name, printed.get(name), operation_count(node))
        if arguments.simplify:
            if key not in known:
                known[key] = list(_simplified(derivation, arguments.limit))
                arguments.simplify.write_text(json.dumps(known))
            for name, count, *_ in known[key]:
                against_simplify.add(key, name, printed.get(name), count)
    against_book.report()
    if arguments.simplify:
        against_simplify.report()


class Score:
    """How often a printed formula has at most as many operations as the other."""

    def __init__(self, what: str) -> None:
        self.what = what
        self.total = 0
        self.longer: list[tuple[int, int, str]] = []
        self.unfinished = 0

    def add(self, path: str, name: str, printed: Expression | None, other: int | None) -> None:
        if printed is None:
            return
        self.total += 1
        count = operation_count(printed)
        if other is None:
            self.unfinished += 1
        elif count > other:
            self.longer.append((count, other, f"{path} {name} = {to_grammar(printed)}"))

    def report(self) -> None:
        held = self.total - len(self.longer)
        print(f"{self.what}: {held} of {self.total} formulas have no more operations "
              f"({100 * held / max(self.total, 1):.1f} %); "
              f"{self.unfinished} without a count there")  # fmt: skip
        for count, other, where in sorted(self.longer, key=lambda row: row[1] - row[0]):
            print(f"  {count:4} > {other:4}  {where}")


def _files(paths: list[Path]) -> Iterator[Path]:
    for path in paths:
        yield from sorted(path.rglob("*.yaml")) if path.is_dir() else [path]


def _printed(derivation: Derivation) -> Iterator[tuple[str, Expression]]:
    sections: Any = Statements(derivation).answers(["accelerations", "multipliers"]).sections
    yield from (sections["accelerations"].accelerations or {}).items()
    for name, multiplier in sections["multipliers"].multipliers.items():
        if multiplier.value is not None:
            yield name, multiplier.value


def _expected(problem: Problem) -> Iterator[tuple[str, Expression]]:
    yield from problem.expect.accelerations.items()
    yield from problem.expect.multipliers.items()


class _Late(Exception):
    pass


def _simplified(derivation: Derivation, limit: float) -> Iterator[tuple[str, int | None]]:
    dynamics = derivation.dynamics
    rows = [dynamics.constraints.equations[k] for k in dynamics.independent_constraints]
    names = [*dynamics.system.names, *(e.name for e in rows)]
    matrix = [
        [*row, *(-e.row[i] for e in rows)] for i, row in enumerate(dynamics.lagrange.mass_matrix)
    ] + [[*e.row, *([0] * len(rows))] for e in rows]
    right = [*dynamics.lagrange.forcing, *(-e.bias for e in rows)]
    try:
        with _Limit(2 * limit):
            solution = list(sympy.Matrix(matrix).LUsolve(sympy.Matrix(right)))
    except (_Late, ValueError):
        yield from ((name, None) for name in names)
        return
    for name, value in zip(names, solution, strict=True):
        try:
            with _Limit(limit):
                yield name, operation_count(to_expression(sympy.simplify(value)))
        except (_Late, TypeError):
            yield name, None


class _Limit:
    """Ends what takes more CPU seconds."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds

    def __enter__(self) -> None:
        signal.signal(signal.SIGVTALRM, self._raise)
        signal.setitimer(signal.ITIMER_VIRTUAL, self.seconds)

    def __exit__(self, *_: object) -> None:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)

    def _raise(self, *_: object) -> None:
        raise _Late


if __name__ == "__main__":
    main()
