"""Ensembles: the same numbers as one run each, in order, and nothing lost when killed."""

from __future__ import annotations

import csv
import io
import json
import math
import os
import random
import signal
import subprocess
import sys
import time
import types

import pytest

import lagcli
from lagcli.cli.run import run
from lagcli.studies.sweep import WrongPlan, plan_of
from lagcli.studies.sweep.journal import Journal


def table(*arguments, capture):
    status = run(["sweep", *arguments, "-f", "csv"])
    rows = list(csv.DictReader(io.StringIO(capture.readouterr().out.decode())))
    return status, [{key: float(value) for key, value in row.items() if value} for row in rows]


@pytest.mark.long
def test_each_row_is_what_simulate_gives(capsysbinary):
    status, rows = table(
        "plane-pendulum", "--vary", "theta=0.3,1.7", "--vary", "l=0.5,2", "--until", "3",
        "--show", "theta,energy", capture=capsysbinary,
    )  # fmt: skip
    assert status == 0
    pendulum = lagcli.load("plane-pendulum")
    for row, (length, angle) in zip(
        rows, [(length, a) for length in (0.5, 2.0) for a in (0.3, 1.7)], strict=True
    ):
        alone = lagcli.simulate(
            pendulum,
            3,
            samples=2,
            show=["theta", "energy"],
            values={"l": length},
            at={"theta": angle},
        )
        assert row["energy"] == pytest.approx(alone["energy"][-1], rel=1e-12)
        assert row["error"] < 1e-9


def test_the_period_grows_with_the_amplitude_as_the_elliptic_integral_says(capsysbinary):
    """After one period K(sin(a/2)) 4/w the pendulum is at its turning point again."""
    for amplitude in (0.5, 1.5, 2.5):
        x, y = 1.0, math.cos(amplitude / 2)  # arithmetic-geometric mean
        while abs(x - y) > 1e-15:
            x, y = (x + y) / 2, math.sqrt(x * y)
        period = 2 * math.pi / x * math.sqrt(1 / 9.81)
        status, [row] = table(
            "plane-pendulum", "--vary", f"theta={amplitude}", "--set", "g=9.81", "--set", "l=1",
            "--until", repr(period), capture=capsysbinary,
        )  # fmt: skip
        assert status == 0
        assert row["theta'"] == pytest.approx(0, abs=1e-8)


def test_the_time_of_an_event_is_a_column(capsysbinary):
    """The pendulum at rest at an angle passes the vertical after a quarter of its period."""
    status, rows = table(
        "plane-pendulum", "--vary", "theta=0.5,1,2", "--until", "10",
        "--stop-when", "theta", "--show", "t", capture=capsysbinary,
    )  # fmt: skip
    assert status == 0
    for row in rows:
        x, y = 1.0, math.cos(row["theta(0)"] / 2)
        while abs(x - y) > 1e-15:
            x, y = (x + y) / 2, math.sqrt(x * y)
        quarter = math.pi / 2 / x * math.sqrt(1 / 9.81)
        assert row["t"] == pytest.approx(quarter, rel=1e-12)
        assert 0 < row["error"] < 1e-15


def test_rows_at_times_are_those_of_runs_to_these_times(capsysbinary):
    status, rows = table(
        "plane-pendulum", "--vary", "theta=0.5,2", "--times", "1,2.5,3",
        "--show", "theta", capture=capsysbinary,
    )  # fmt: skip
    assert status == 0
    assert [row["t"] for row in rows] == [1, 2.5, 3] * 2
    pendulum = lagcli.load("plane-pendulum")
    found = lagcli.sweep(pendulum, {"theta": [0.5, 2]}, times=[1, 2.5, 3], show=["theta"])
    assert [row["theta"] for row in rows] == list(found["theta"])
    alone = lagcli.simulate(pendulum, 2.5, samples=2, show=["theta"], at={"theta": 2})
    assert rows[4]["theta"] == pytest.approx(alone["theta"][-1], rel=1e-12)


def test_along_gives_every_row(capsysbinary):
    _, rows = table(
        "plane-pendulum", "--vary", "theta=1,2", "--until", "1", "--samples", "5", "--along",
        capture=capsysbinary,
    )  # fmt: skip
    assert [row["t"] for row in rows] == [0, 0.25, 0.5, 0.75, 1] * 2


@pytest.mark.long
def test_random_draws_are_those_of_the_seed(capsysbinary):
    arguments = ("kepler", "--random", "5", "--vary", "y'=0.9:1.2", "--until", "2",
                 "--show", "x,energy")  # fmt: skip
    first, again, other = (
        table(*arguments, "--seed", seed, capture=capsysbinary)[1] for seed in ("7", "7", "8")
    )
    assert first == again != other
    assert first[0]["energy"] != first[1]["energy"]


def test_constraints_and_contacts_are_run_one_by_one(tmp_path, capsysbinary):
    path = tmp_path / "ball.yaml"
    path.write_text(
        "coordinates: [y]\nparameters: {g: 10}\nT: y'^2/2\nV: g*y\n"
        "contacts: {floor: {gap: y >= 0, restitution: 1}}\ninitial: {y: 1}\n"
    )
    _, rows = table(str(path), "--vary", "y=0.7,1.2", "--until", "1", capture=capsysbinary)
    for height, row in zip((0.7, 1.2), rows, strict=True):
        fall = math.sqrt(2 * height / 10)  # then up with the speed g*fall
        after = (1 - fall) % (2 * fall)
        if after > 1e-6:
            assert row["y"] == pytest.approx(10 * fall * after - 5 * after**2, abs=1e-8)
        assert row["reached"] == 1


def test_a_member_that_cannot_be_run_is_a_row_without_numbers(capsysbinary):
    status, rows = table("kepler", "--vary", "x=0,1", "--until", "1", capture=capsysbinary)
    assert (status, [row["reached"] for row in rows]) == (1, [0, 1])


@pytest.mark.long
@pytest.mark.parametrize("form", ["json", "npz", "parquet"])
def test_every_format_has_the_same_numbers(form, tmp_path, capsysbinary):
    out = tmp_path / f"out.{form}"
    arguments = ["plane-pendulum", "--vary", "theta=0.1:1:4", "--until", "1"]
    assert run(["sweep", *arguments, "-o", str(out)]) == 0
    _, rows = table(*arguments, capture=capsysbinary)
    expected = [row["theta'"] for row in rows]
    if form == "json":
        content = json.loads(out.read_text())
        place = content["columns"].index("theta'")
        found = [row[place] for row in content["rows"]]
    elif form == "npz":
        import numpy as np

        found = list(np.load(out)["theta'"])
    else:
        from pyarrow import parquet

        found = parquet.read_table(out)["theta'"].to_pylist()
    assert found == expected
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"out.{form}"]


MISTAKES = [
    (["--vary", "tetha=1"], "did you mean 'theta'"),
    (["--vary", "theta"], "write NAME=FIRST:LAST:COUNT"),
    (["--vary", "theta=1:2"], "FIRST:LAST:COUNT"),
    (["--vary", "theta=1..2"], "FIRST:LAST:COUNT"),
    (["--vary", "theta=1:2:x"], "whole number"),
    (["--vary", "theta=1:2:0"], "whole number"),
    (["--vary", "theta=0:2:5:log"], "above 0"),
    (["--vary", "theta=a"], "unknown name"),
    (["--vary", "theta=1/0"], "division by zero"),
    (["--vary", "theta=1", "--vary", "theta=2"], "varied twice"),
    (["--vary", "theta=1:2:3", "--random", "4"], "draws between two ends"),
    (["--vary", "theta=1:2:10000", "--vary", "l=1:2:10000"], "too many"),
    ([], "what varies?"),
    (["--vary", "theta=1", "--times", "2,1"], "times increase"),
    (["--vary", "theta=1", "--times", "0:2:3"], "after 0"),
    (["--vary", "theta=1", "--times", "1:2"], "FIRST:LAST:COUNT"),
]


@pytest.mark.parametrize(("options", "piece"), MISTAKES)
def test_a_wrong_plan_is_answered_before_anything_runs(options, piece, capsysbinary):
    assert run(["sweep", "plane-pendulum", *options]) == 2
    assert piece in capsysbinary.readouterr().err.decode()


def test_all_mistakes_of_a_plan_come_at_once():
    with pytest.raises(WrongPlan) as caught:
        plan_of(lagcli.load("plane-pendulum"), ["x=1", "theta=1:2", "l="], None, 0)
    assert len(caught.value.lines) == 3


@pytest.mark.parametrize("seed", range(20))
def test_a_journal_that_is_cut_off_anywhere_keeps_what_is_whole(seed, tmp_path):
    draw = random.Random(seed)
    path = tmp_path / "out.csv"
    chunks = {k: [[draw.random(), None]] for k in range(8)}
    with Journal(path, "abc") as journal:
        for k, rows in chunks.items():
            journal.keep(k, rows)
    data = journal.path.read_bytes()
    journal.path.write_bytes(data[: draw.randrange(len(data))] + draw.choice([b"", b"\x00{"]))
    with Journal(path, "abc") as again:
        assert all(chunks[k] == rows for k, rows in again.done.items())
        again.keep(99, [[1.0]])
    with Journal(path, "abc") as third:
        assert third.done == again.done
    with Journal(path, "other") as fourth:
        assert fourth.done == {}


@pytest.mark.long
def test_a_sweep_that_is_killed_goes_on_to_the_same_bytes(tmp_path):
    command = [sys.executable, "-m", "lagcli", "sweep", "double-pendulum-equal",
               "--vary", "phi1=0.1:2:400", "--until", "5"]  # fmt: skip
    environment = {**os.environ, "LAGCLI_NO_CACHE": ""}
    whole, cut = tmp_path / "whole.csv", tmp_path / "cut.csv"
    subprocess.run([*command, "-o", str(whole)], check=True, env=environment)
    draw = random.Random(3)
    for _ in range(6):
        process = subprocess.Popen(
            [*command, "-o", str(cut)], env=environment, start_new_session=True
        )
        time.sleep(draw.uniform(0.1, 1.5))
        with_group = os.getpgid(process.pid)
        os.killpg(with_group, signal.SIGKILL)
        process.wait()
        if cut.exists():
            break
    subprocess.run([*command, "-o", str(cut)], check=True, env=environment)
    assert cut.read_bytes() == whole.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cut.csv", "whole.csv"]


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_no_process_outlives_a_sweep_that_is_killed(tmp_path):
    command = [sys.executable, "-m", "lagcli", "sweep", "double-pendulum-equal", "-j", "3"]
    command += ["--vary", "phi1=0.1:2:4000", "--until", "50", "-o", str(tmp_path / "cut.csv")]
    with subprocess.Popen(command, stderr=subprocess.PIPE) as process:
        time.sleep(4)  # they have begun, and are far from the end
        assert process.poll() is None
        process.kill()
        process.communicate(timeout=60)  # to the end of the pipe, which all of them hold


@pytest.mark.long
@pytest.mark.parametrize("platform", ["darwin", "win32"])
def test_processes_that_are_started_anew_give_the_same_bytes(platform, tmp_path, monkeypatch):
    """As on macOS and Windows, where nothing is forked."""
    arguments = ["sweep", "plane-pendulum", "--vary", "theta=0.5:2:4", "--until", "2", "-j", "2"]
    assert run([*arguments, "-o", str(tmp_path / "forked.csv")]) == 0
    there = types.SimpleNamespace(platform=platform)
    monkeypatch.setattr("lagcli.studies.sweep.workers.sys", there)
    assert run([*arguments, "-o", str(tmp_path / "anew.csv")]) == 0
    assert (tmp_path / "anew.csv").read_bytes() == (tmp_path / "forked.csv").read_bytes()
