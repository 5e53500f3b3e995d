"""Every certified run of the library lies in the proved enclosure."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import lagcli
from lagcli.interface.motion import request_of
from lagcli.numerics.rigorous import prove

PROBLEMS = Path(__file__).parents[2] / "problems"
#: What doubles round on the way to the table.
ROUNDING = 1e-15


def with_runs():
    """The files that say until when they run."""
    for path in sorted(PROBLEMS.rglob("*.yaml")):
        if "\nsimulation:" in path.read_text(encoding="utf-8"):
            yield pytest.param(path, id=path.stem)


@pytest.mark.long
@pytest.mark.parametrize("path", list(with_runs()))
def test_the_certified_run_lies_in_the_proved_enclosure(path):
    problem = lagcli.load(path)
    asked = request_of(problem, accuracy=1e-9, samples=6)
    proof = prove(problem, asked)
    assert proof.reached, proof.refusal
    motion = lagcli.simulate(problem, asked.until, accuracy=1e-9, samples=6)
    scales = [max(abs(x) for x in motion[name]) or 1.0 for name in motion.columns]
    bounds = [motion.certificate.global_error.get(name, 0.0) for name in motion.columns]
    for balls, row in zip(proof.rows, motion.rows, strict=False):
        for ball, x, scale, bound in zip(balls, row, scales, bounds, strict=True):
            if ball is not None and x is not None:
                assert float(abs(ball - x).lower()) <= (bound + ROUNDING) * scale
    assert happened(proof) == happened(motion)


def happened(found):
    """The events, without the last impacts before rest, of which each ends with some others."""
    names = [(event.name, event.what) for event in found.events]
    return names[:8] + names[-1:] if "comes to rest" in {what for _, what in names} else names


@pytest.mark.long
def test_in_80_bits_before_a_collision_the_bound_holds():
    """-0.03/r^3 draws it into the centre; the tolerance is some 18 roundings there."""
    problem = lagcli.loads(
        "{coordinates: [x, y], T: (x'^2 + y'^2)/2, initial: {x: 1, y': 0.8}, "
        "V: '-1/sqrt(x^2 + y^2) - 0.03/(x^2 + y^2)^(3/2)'}"
    )
    motion = lagcli.simulate(problem, 20, accuracy=1e-14, samples=17)
    assert not motion.certificate.reached
    end = motion.rows[-1][0]
    proof = prove(problem, request_of(problem, until=end, times=[0.0, end], accuracy=1e-9))
    scales, bounds = motion.certificate.scales[1:], motion.certificate.global_error.values()
    assert proof.reached
    for ball, x, scale, bound in zip(
        proof.rows[-1][1:], motion.rows[-1][1:], scales, bounds, strict=True
    ):
        assert float(abs(ball - x).lower()) <= bound * scale + math.ulp(x) / 2
