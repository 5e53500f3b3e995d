"""Which members of a family run before a commit, and which in `make check-all`."""

from collections.abc import Iterable

import pytest


def mostly_long(values: Iterable[object], *ordinary: object) -> list[object]:
    """Parameters that are `long` but for some, which stand for their kind before a commit."""
    return [v if v in ordinary else pytest.param(v, marks=pytest.mark.long) for v in values]


def one_of(number: int, values: Iterable[object]) -> list[object]:
    """Parameters of which every so many is `long`, and the others are left to `-m hours`."""
    marks = {True: pytest.mark.long, False: pytest.mark.hours}
    return [pytest.param(v, marks=marks[k % number == 0]) for k, v in enumerate(values)]
