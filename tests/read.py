"""The problems of the library, read once for all tests of a process."""

from functools import cache
from pathlib import Path

from lagcli.problem_data import Problem
from lagcli.reader import read_problem

LIBRARY = Path(__file__).parents[1] / "problems"


@cache
def library() -> dict[Path, Problem]:
    """Every problem by its file."""
    return {
        path: read_problem(path.name, path.read_bytes()).checked()
        for path in sorted(LIBRARY.rglob("*.yaml"))
    }
