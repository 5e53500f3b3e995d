"""What discovery takes, whole process: systems of known algebra, then the whole library."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tests.bench.measure import LAGCLI, Row, cost
from tests.mechanics.test_discovery import KNOWN

#: CPU seconds: of a system whose algebra is known, and of any other.
KNOWN_BAR, BAR = 10, 30


def rows(paths: Sequence[str]) -> Iterator[Row]:
    """The slowest of each, and how many of the library say that they stopped."""
    known = {f"problems/{name}.yaml" for name in KNOWN}
    taken, stopped = {}, 0
    for path in sorted({*known, *paths}):
        used = cost(_discover(path, "discovered,algebra"), limit=4 * BAR)
        taken[path] = used.cpu if used.answered else float("inf")
        stopped += b"too much work" in used.out + used.mistakes.encode()
    for what, bar, of in (
        ("discovery, known algebras", KNOWN_BAR, known),
        ("discovery, library", BAR, set(taken)),
    ):
        slowest = sorted(of, key=lambda path: -taken[path])[:3]
        note = ", ".join(f"{path.removeprefix('problems/')} {taken[path]:.1f}" for path in slowest)
        yield Row(f"{what}, slowest of {len(of)}", taken[slowest[0]], "s CPU", bar, note=note)
    yield Row("discovery, told to have stopped", stopped, "problems")


def _discover(path: str, sections: str) -> list[str]:
    return [*LAGCLI, "solve", path, "--no-cache", "--format", "json", "--show", sections]
