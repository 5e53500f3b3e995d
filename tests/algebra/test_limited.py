"""Work that ends, by what is counted."""

from __future__ import annotations

import pytest
import sympy as sp

from lagcli.platform.effort import EFFORT, OutOfWork, work_done
from lagcli.platform.limited import limited, limited_to

x, y, z = sp.symbols("x y z", real=True)


def endless() -> None:
    """SymPy's work, by one who takes every exception for a formula without a value."""
    n = 0
    while True:
        n += 1
        try:
            sp.expand((x + n * y + z) ** 12)
        except Exception:  # noqa: BLE001
            continue


def test_what_counts_its_work_is_stopped() -> None:
    with pytest.raises(OutOfWork):
        limited(endless, 100_000, 1e9)


def test_what_counts_nothing_is_stopped_by_the_time_of_the_processor() -> None:
    def idle() -> None:
        while True:
            sum(range(1000))

    with pytest.raises(OutOfWork):
        limited(idle, 1e9, 0.3)


def test_too_much_work_is_too_much_even_when_it_has_ended_meanwhile() -> None:
    def quick() -> int:
        EFFORT.fractions += 1000
        return 1

    with pytest.raises(OutOfWork):
        limited(quick, 900, 1e9)
    assert limited(quick, 1100, 1e9) == 1


def test_a_share_is_one_of_what_is_left_around_it() -> None:
    def quick(units: int) -> int:
        EFFORT.fractions += units
        return units

    def around() -> int:
        first = quick(500)
        with pytest.raises(OutOfWork):
            limited_to(0.5, lambda: quick(400))
        return first + limited_to(0.8, lambda: quick(60))

    assert limited(around, 1000, 1e9) == 560
    assert limited_to(0.5, lambda: quick(10_000)) == 10_000  # nothing is around it


@pytest.mark.long
def test_one_who_swallows_the_exception_gets_it_again() -> None:
    swallowed = []

    def stubborn() -> None:
        while len(swallowed) < 2:
            try:
                endless()
            except OutOfWork:
                swallowed.append(True)

    with pytest.raises(OutOfWork):
        limited(stubborn, 10_000, 1e9)
    assert len(swallowed) == 2


def test_an_exception_of_the_call_is_its_own() -> None:
    def broken() -> None:
        raise ZeroDivisionError("of a test")

    with pytest.raises(ZeroDivisionError, match="of a test"):
        limited(broken, 1e9, 1e9)


def test_the_work_of_sympy_counts() -> None:
    before = work_done()
    sp.expand((x + 3 * y - z) ** 9)
    assert work_done() > before
