"""Shadows of computed motions, against shooting with hand-made power series in 200 bits."""

from __future__ import annotations

import json

import pytest
from flint import arb, arb_mat, arb_series, ctx

import lagcli
from lagcli.cli.run import run
from lagcli.interface.motion import request_of
from lagcli.numerics.rigorous import Shadowing, prove
from lagcli.numerics.rigorous.shadowing import SplitStep, bounds, hold

#: Errors grow as exp(2 t): in 80 bits the motion of the file itself is lost after t = 28.
SHAKEN = "{coordinates: [x], L: x'^2/2 + 20*cos(x)*cos(3*t), initial: {x: 1}}"
ORDER, STEP = 52, 1 / 16


def shadow(until, samples):
    problem = lagcli.loads(SHAKEN)
    return prove(problem, request_of(problem, until=until, accuracy=1e-9, samples=samples), None,
                 Shadowing)  # fmt: skip


def positions(x, until, every):
    """x at multiples of a time, of x'' = -20 sin x cos 3t from rest."""
    v, found = arb(0), [x]
    for k in range(round(until / STEP)):
        time = arb_series([3 * k * STEP, 3])
        series = [x, v]
        while len(series) < ORDER:
            ctx.cap = len(series)
            force = -20 * arb_series(series).sin() * time.cos()
            rates = [force[j] for j in range(len(series))]
            series = [x, v, *(a / ((j + 1) * (j + 2)) for j, a in enumerate(rates))]
        x = sum((c * arb(STEP) ** j for j, c in enumerate(series)), arb(0)).mid()
        v = sum((j * c * arb(STEP) ** (j - 1) for j, c in enumerate(series) if j), arb(0)).mid()
        if (k + 1) * STEP % every == 0:
            found.append(x)
    return found


@pytest.fixture
def many_bits():
    cap = ctx.cap
    with ctx.workprec(200):
        yield
    ctx.cap = cap


@pytest.mark.long
def test_a_motion_that_shooting_finds_is_where_the_shadow_says(many_bits):
    """The start that leads to one row after the other is that of a motion near all rows."""
    until, every = 36.0, 9.0
    found = shadow(until, 5)
    assert found.reached
    assert found.within < 1e-12
    rows = [row[1].mid() for row in found.rows]
    own = positions(arb(1), until, every)
    assert abs(own[-1] - rows[-1]) > 1e-3  # the file's own motion is elsewhere by then
    start, change = arb(1), arb(2) ** -140
    for k in range(1, len(rows)):
        x, nearby = (positions(s, k * every, every)[k] for s in (start, start + change))
        start = (start - (x - rows[k]) * change / (nearby - x)).mid()
    assert abs(start - 1) < found.within
    for x, row in zip(positions(start, until, every), rows, strict=True):
        assert abs(x - row) < 1e-9


def test_boxes_hold_for_a_saddle_and_not_where_axes_are_mixed():
    """x -> 2 x, y -> y/2 with errors of 1e-20: bounds are 1e-20 and 2e-20."""
    saddle = SplitStep(arb_mat(2, 1, [arb(0, 1e-20)] * 2), arb_mat(2, 2, [2, 0, 0, 0.5]))
    links = [saddle] * 50
    radii = bounds(links)
    assert hold(links, radii)
    assert max(rho[0] for rho in radii) == pytest.approx(1e-20, rel=1e-6)
    assert max(rho[1] for rho in radii) == pytest.approx(2e-20, rel=1e-6)
    assert not hold(links, [[x / 2 for x in rho] for rho in radii])
    mixed = SplitStep(saddle.defect, arb_mat(2, 2, [2, 1, 1, 0.5]))
    assert not hold([mixed] * 50, bounds([mixed] * 50))


def test_the_boxes_are_about_the_initial_values_of_the_file():
    found = shadow(2, 3)
    assert found.rows[0][1].contains(1)
    assert found.rows[0][2].contains(0)
    assert float(found.rows[0][1].rad()) <= 2 * found.within


def test_json_says_how_near_the_start_is(capsysbinary, tmp_path):
    path = tmp_path / "shaken.yaml"
    path.write_text(SHAKEN, encoding="utf-8")
    options = ["--until", "2", "--samples", "3", "--shadow", "-f", "json"]
    assert run(["simulate", str(path), *options]) == 0
    content = json.loads(capsysbinary.readouterr().out)
    assert content["certificate"]["kind"] == "shadow"
    assert 0 < content["certificate"]["initial_within"] < 1e-15
    assert content["certificate"]["reached"]


def test_a_motion_with_contacts_is_refused(capsysbinary):
    assert run(["simulate", "bouncing-ball", "--until", "1", "--shadow"]) == 1
    assert b"is not shadowed" in capsysbinary.readouterr().err
