"""`lagcli simulate` as a process: the forms of its output, its status, its imports."""

import csv
import io
import json
import math
import subprocess
import sys

import pytest

from .running import ROOT

PENDULUM = str(ROOT / "problems/pendulums/pendulum-cartesian.yaml")


def run(*arguments, stdin=None, command="simulate"):
    done = subprocess.run(
        [sys.executable, "-m", "lagcli", command, *arguments],
        capture_output=True, text=True, input=stdin, check=False, cwd=ROOT,
    )  # fmt: skip
    assert "Traceback" not in done.stderr
    return done


def test_json_is_the_contract():
    show = "x,x',lambda_rod,rod.x,energy"
    done = run(PENDULUM, "--until", "2", "--samples", "5", "--show", show, "-f", "json")
    assert done.returncode == 0
    document = json.loads(done.stdout)
    assert list(document) == [
        "schema", "columns", "rows", "certificate", "method", "events", "model", "warnings",
    ]  # fmt: skip
    assert document["columns"] == ["t", *show.split(",")]
    assert [row[0] for row in document["rows"]] == [0.0, 0.5, 1.0, 1.5, 2.0]
    held = document["certificate"]
    assert held["reached"] is True
    assert held["holds_until"] == 2.0
    assert set(held["constraints"]["rod"]) == {"residual", "rate_residual"}
    assert set(document["method"]) == {"name", "reason", "steps", "evaluations"}


def test_a_comma_in_a_name_parts_no_column_of_a_proof():
    done = run(PENDULUM, "--until", "0.1", "--samples", "2", "-f", "csv", "--rigorous", "--show",
               "atan2(y, x)")  # fmt: skip
    header, *rows = csv.reader(io.StringIO(done.stdout))
    assert header == ["t", "t (radius)", "atan2(y, x)", "atan2(y, x) (radius)"]
    assert [len(row) for row in rows] == [4, 4]


@pytest.mark.long
def test_csv_holds_every_digit():
    done = run(PENDULUM, "--until", "1", "--samples", "3", "-f", "csv", "--show", "x,atan2(y, x)")
    header, *rows = csv.reader(io.StringIO(done.stdout))
    assert header == ["t", "x", "atan2(y, x)"]
    assert len(rows) == 3
    assert len(rows[-1][1]) > 12


@pytest.mark.long
def test_the_same_input_gives_the_same_bytes():
    assert run(PENDULUM, "--samples", "3").stdout == run(PENDULUM, "--samples", "3").stdout


@pytest.mark.long
def test_written_whole_to_a_file(tmp_path):
    path = tmp_path / "run.json"
    assert run(PENDULUM, "--until", "1", "-f", "json", "-o", str(path)).returncode == 0
    assert len(json.loads(path.read_text())["rows"]) == 101


@pytest.mark.long
def test_groups_of_columns():
    done = run(PENDULUM, "--until", "1", "--samples", "2", "-f", "csv", "--show",
               "accelerations,multipliers,constraint_forces,momenta")  # fmt: skip
    assert done.stdout.splitlines()[0] == "t,x'',y'',lambda_rod,rod.x,rod.y,p_x,p_y"


@pytest.mark.long
@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["--until", "-1"], "--until"),
        (["--until", "x"], "unknown name 'x'"),
        (["--accuracy", "0"], "--accuracy"),
        (["--show", "tetha"], "unknown name 'tetha'"),
        (["--show", "x +"], "error"),
        (["--show", "rod.xx"], "did you mean 'rod.x'"),
        (["--show", "roation,zz"], "did you mean 'rotation'"),
        (["--show", "roation,zz"], "unknown name 'zz'"),
        (["--show", "velocites"], "did you mean 'velocities'"),
        (["--format", "jsn"], "json"),
        (["--method", "euler"], "--method"),
        (["--set", "q=1"], "no parameter 'q'"),
        (["--set", "m=-1"], "'m' is positive"),
        (["--set", "g=1/0"], "divi"),
        (["--output", "/nowhere/at/all"], "no directory"),
        (["--stop-when", "zz"], "unknown name 'zz'"),
    ],
)
def test_mistakes_of_the_command_line(arguments, word):
    done = run(PENDULUM, *arguments)
    assert done.returncode == 2
    assert word in done.stderr
    assert done.stdout == ""


@pytest.mark.parametrize("command", ["simulate", "solve", "check"])
def test_mistakes_of_the_file_are_shown_where_they_stand(command):
    text = "coordinates: [x]\nT: x'^2/2\nsimulation: {until: -1, accuracy: 2}\n"
    done = run("-", stdin=text, command=command)
    told = done.stdout + done.stderr
    assert done.returncode == 2
    assert ":3:21: error: 'until': the end must be a time after 0, not -1\n" in told
    assert ":3:35: error: 'accuracy': it lies between 0 and 1, not 2\n" in told


@pytest.mark.long
def test_missing_values_are_named_with_their_places():
    done = run(
        "-", "--until", "1", stdin="coordinates: [x]\nparameters: [k, m]\nL: m*x'^2/2 - k*x^2\n"
    )
    assert done.returncode == 2
    assert "-:2:14: error: the parameters 'k' and 'm' have no values" in done.stderr
    assert "parameters: {k: 1, m: 1}, or with --set k=… --set m=…" in done.stderr
    assert done.stderr.count("error:") == 1


@pytest.mark.long
def test_an_accuracy_that_is_not_reached_is_status_1():
    done = run(
        "-",
        "--until",
        "2",
        "-f",
        "json",
        stdin="{coordinates: [r], L: r'^2/2 + 1/r, initial: {r: 1}}",
    )
    assert done.returncode == 1
    document = json.loads(done.stdout)
    assert document["certificate"]["reached"] is False
    assert document["certificate"]["holds_until"] == document["rows"][-1][0]
    assert 1.11 < document["rows"][-1][0] < 1.110720734540
    assert max(document["certificate"]["global_error"].values()) <= 1e-9
    assert "stops at t = 1.11072073454" in done.stderr


@pytest.mark.long
def test_a_pendulum_needs_no_algebra():
    code = (
        "import sys; from lagcli.cli.run import run; run(sys.argv[1:]);"
        "print([m for m in ('sympy', 'numpy', 'scipy', 'mpmath', 'flint', 'rich') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "simulate", PENDULUM, "--samples", "2"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.splitlines()[-1] == "[]"


@pytest.mark.long
def test_another_state_is_begun_with():
    """The oscillator from x = 2, x' = 3: 2 cos t + 3 sin t."""
    text = "coordinates: [x]\nT: x'^2/2\nV: x^2/2\ninitial: {x: 1}\n"
    options = ("--until", "3", "--samples", "2", "-f", "json", "--show", "x")
    done = run("-", *options, "--at", "x=2", "--at", "x'=3", stdin=text)
    assert done.returncode == 0
    last = json.loads(done.stdout)["rows"][-1][1]
    assert last == pytest.approx(2 * math.cos(3) + 3 * math.sin(3), abs=1e-9)
    wrong = run("-", *options, "--at", "y=2", "--at", "x", stdin=text)
    assert (wrong.returncode, wrong.stdout) == (2, "")
    assert "--at y=2: there is no coordinate or velocity 'y'" in wrong.stderr
    assert "--at x: an '=' is missing" in wrong.stderr
