"""Systems of which something false was once printed, or nothing, judged as the random ones are."""

from __future__ import annotations

import pytest

from .run import judged
from .system import System

M = {"m": "positive", "k": "positive", "g": "positive", "b": None}

MENDED = {
    "no radius at which exp(2 r) vanishes": System(
        coordinates={"r": "positive", "phi": None},
        parameters=M,
        L="m*r'^2/2 + m*exp(2*r)*phi'^2/2 - k*r^4",
        sections=("reduction", "steady_motions"),
    ),
}


@pytest.mark.parametrize("name", MENDED)
def test_once_wrong(name: str) -> None:
    assert judged(MENDED[name]) == []
