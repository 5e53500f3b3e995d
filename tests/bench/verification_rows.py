"""What the verification adds to the CPU of a cold `solve`, with it and without, in one run."""

from __future__ import annotations

import statistics
import sys
from collections.abc import Iterator, Sequence

from tests.bench.measure import Row, cost

#: The command as it is, and without the verification.
_MAIN = (
    "import sys, lagcli.pipeline as p; p.VERIFYING = {verifying}; "
    "sys.argv[0] = 'lagcli'; from lagcli.cli import main; main()"
)
RUNS = 3
BAR = 0.15


def rows(files: Sequence[str]) -> Iterator[Row]:
    """The median share over the files, each the least of some runs."""
    shares = [_share(file) for file in files]
    note = f"{len(files)} problems, at most {max(shares):.2f}"
    yield Row("verification, share of a solve", statistics.median(shares), "", BAR, note=note)


def _share(file: str) -> float:
    whole, bare = (min(_cpu(file, on) for _ in range(RUNS)) for on in (True, False))
    return whole / bare - 1


def _cpu(file: str, verifying: bool) -> float:
    command = [sys.executable, "-c", _MAIN.format(verifying=verifying)]
    return cost([*command, "solve", "--no-cache", "-f", "json", file], good=(0, 1)).cpu
