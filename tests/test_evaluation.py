"""Where something ends to hold, found by halving."""

from random import Random

import pytest
from mpmath import mpf

from lagcli.evaluation import bisected


@pytest.mark.parametrize("seed", range(5))
def test_a_root_is_enclosed_by_neighbouring_doubles_from_either_side(seed: int) -> None:
    number = Random(seed).uniform(0.1, 9.0)
    below, above = bisected(lambda x: x * x < number, 0.0, 10.0, 2000)
    assert below**2 < number <= above**2
    assert (above - below) / above < 3e-16
    assert bisected(lambda x: x * x >= number, 10.0, 0.0, 2000) == (above, below)


def test_each_halving_halves() -> None:
    inside, outside = bisected(lambda x: x < mpf(1) / 3, mpf(0), mpf(1), 20)
    assert inside < mpf(1) / 3 <= outside
    assert outside - inside == mpf(1) / 2**20
