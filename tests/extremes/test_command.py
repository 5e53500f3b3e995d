"""`lagcli extremes`: its report, its exit status, its limits."""

import csv
import io
import json
import math
import time
from types import SimpleNamespace

import mpmath
import pytest

from lagcli.cli.run import run
from lagcli.pipeline import read
from lagcli.record import replace
from lagcli.studies.extremes import trial as trials
from lagcli.studies.extremes.study import study
from lagcli.studies.extremes.trial import Wanted

PENDULUM = """
coordinates: [th]
parameters: {m: 2, g: 9.81, l: 0.5}
T: m*l^2*th'^2/2
V: m*g*l*(1 - cos(th))
initial: {th: 1}
simulation: {until: 2}
"""


@pytest.fixture
def extremes(tmp_path, capsys):
    def call(text, *options):
        path = tmp_path / "case.yaml"
        path.write_text(text)
        status = run(["extremes", str(path), *options])
        out, err = capsys.readouterr()
        assert "Traceback" not in err
        return SimpleNamespace(status=status, out=out, err=err)

    return call


@pytest.mark.long
def test_a_pendulum(extremes):
    """Everything is right or refused; what is lost at 1e-9 is what mpmath says."""
    found = extremes(PENDULUM, "-f", "json", "--limit", "20")
    assert found.status == 0
    cases = {case["name"]: case for case in json.loads(found.out)["cases"]}
    assert {case["outcome"] for case in cases.values()} == {"right", "refused"}
    refused = [case for case in cases.values() if case["outcome"] == "refused"]
    assert {case["name"] for case in refused} == {"m = 0", "l = 0"}
    assert all("mass matrix" in case["reason"] for case in refused)
    assert all(case["singular"] for case in refused)
    for case in cases.values():
        if case["outcome"] == "right":
            assert case["proved"] or case["kind"] == "spans"
            assert case["error"] <= case["accuracy"] == 1e-9
            assert case["condition"] == 1
    lost = {each["name"]: each for each in cases["th = 1e-9"]["digits_lost"]}
    assert lost["energy"]["printed"] == pytest.approx(53 * math.log10(2))
    assert lost["energy"]["rewritten"] < 1
    assert lost["th''"]["printed"] < 1
    usual = {each["name"]: each for each in cases["as given"]["digits_lost"]}
    with mpmath.workdps(60):
        exact = 2 * mpmath.mpf(9.81) * mpmath.mpf(0.5) * (1 - mpmath.cos(1))
        double = 2 * 9.81 * 0.5 * (1 - math.cos(1))
        relative = float(abs(double / exact - 1)) * 2**53
    assert abs(usual["energy"]["printed"] - max(0, math.log10(relative or 1))) < 0.7


@pytest.mark.long
def test_the_text_fits_a_terminal(extremes):
    found = extremes(PENDULUM, "--cases", "given,angles,zero")
    assert found.status == 0
    lines = found.out.splitlines()
    assert max(map(len, lines[1:])) <= 80  # the path of the file is longer
    row = next(line for line in lines if line.startswith("  th = 1e-9"))
    assert row.split()[-1] == "right"
    assert "16>0." in row
    assert "m = 0: at t = 0 the accelerations are not determined" in found.out
    assert "2*g*l*m*sin(th/2)^2" in found.out.replace("2*m*g*l", "2*g*l*m")
    assert lines[-1] == "7 cases: 5 right, 2 refused; 5 proved"


@pytest.mark.long
def test_csv_has_a_line_for_each_case(extremes):
    found = extremes(PENDULUM, "-f", "csv", "--cases", "th = *,spans", "--limit", "2")
    rows = list(csv.DictReader(io.StringIO(found.out)))
    assert [row["kind"] for row in rows] == ["angles"] * 3 + ["spans"]
    assert float(rows[-1]["until"]) == pytest.approx(100 * float(rows[0]["until"]), rel=1)
    assert float(rows[0]["charges"]) > 15 > float(rows[0]["charges_rewritten"])


@pytest.mark.long
def test_the_speed_of_light(extremes):
    """1 - v^2/c^2 loses digits next to c, (c - v)(c + v) none."""
    text = """
coordinates: [x]
parameters: {m: 1, c: 3}
L: -m*c^2*sqrt(1 - x'^2/c^2)
initial: {x': 1}
simulation: {until: 1}
"""
    found = extremes(text, "-f", "json", "--cases", "light")
    cases = json.loads(found.out)["cases"]
    assert found.status == 0
    assert [case["outcome"] for case in cases] == ["right", "right", "refused"]
    [energy] = [x for x in cases[0]["digits_lost"] if x["name"] == "energy"]
    assert energy["printed"] > energy["rewritten"] + 2
    assert energy["rewritten"] < 1


@pytest.mark.long
def test_parameters_and_state_may_be_missing(extremes):
    text = "coordinates: [x, y]\nparameters: [m, k]\nL: m*(x'^2 + y'^2)/2 - k*x^2*y^2/2\n"
    found = extremes(text, "--cases", "given,ratios")
    assert found.status == 0
    assert "without a value, taken as m = 1.071, k = 0.842" in found.out
    assert "without an initial state" in found.out


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--until", "-1"], "must be a time after 0"),
        (["--until", "q"], "q"),
        (["--accuracy", "2"], "between 0 and 1"),
        (["-f", "jsn"], "did you mean 'json'"),
        (["--cases", "anglse"], "did you mean 'angles'"),
        (["--set", "q=1"], "no parameter 'q'"),
        (["-o", "nowhere/x"], "there is no directory"),
    ],
)
def test_bad_options(extremes, options, told):
    found = extremes(PENDULUM, *options)
    assert found.status == 2
    assert told in found.err
    assert found.out == ""


def test_a_function_without_a_formula_is_refused(extremes):
    found = extremes("{coordinates: [x], functions: {U: [x]}, L: x'^2/2 - U(x)}")
    assert found.status == 2
    assert "unspecified" in found.err


# -- what must not happen ------------------------------------------------------------------------

WANTED = Wanted(until=1.0, accuracy=1e-9, limit=0.5)


def pendulum():
    return read("case.yaml", PENDULUM.encode()).problem


def outcomes(words=("given", "zero")):
    made = study(pendulum(), WANTED, words)
    return made, {case.name: trial for case, trial in made.trials}


@pytest.mark.long
def test_a_wrong_claim_is_found(monkeypatch):
    """A certificate that holds for other numbers."""
    simulate = trials.simulate

    def wrong(problem, asked, progress=None):
        result = simulate(problem, asked, progress)
        rows = tuple((t, *(x + 1e-6 * t for x in row)) for t, *row in result.rows)
        return replace(result, rows=rows)

    monkeypatch.setattr(trials, "simulate", wrong)
    made, found = outcomes()
    assert found["as given"].verdict == "wrong"
    assert "claims 1e-09 and errs by" in found["as given"].reason
    assert found["m = 0"].verdict == "refused"
    assert made.bad == 2  # g = 0 moves as well


@pytest.mark.long
def test_a_failure_and_a_hang_do_not_stop_the_others(monkeypatch):
    """Each is undecided; the process that hangs is ended."""
    simulate = trials.simulate

    def fails(problem, asked, progress=None):
        value = {p.name: p.value for p in problem.parameters}["g"].value
        if not value:
            while True:
                time.sleep(0.1)
        if value > 100:
            raise RuntimeError("broken")
        return simulate(problem, asked, progress)

    monkeypatch.setattr(trials, "simulate", fails)
    made, found = outcomes(("given", "g *", "m = 0"))
    assert found["g times 1e12"].verdict == "undecided"
    assert "RuntimeError: broken" in found["g times 1e12"].reason
    assert found["g = 0"].verdict == "undecided"
    assert "takes more than 0.5 s" in found["g = 0"].reason
    assert found["as given"].verdict == "right"
    assert found["m = 0"].verdict == "refused"
    assert made.bad == 2


@pytest.mark.long
def test_another_state_is_the_given_one(extremes):
    """From rest at the bottom nothing moves; x'' holds no large angle any more."""
    found = extremes(PENDULUM, "-f", "json", "--cases", "given", "--at", "th=0", "--limit", "20")
    assert found.status == 0
    [case] = json.loads(found.out)["cases"]
    assert case["name"] == "as given"
    assert extremes(PENDULUM, "--at", "x=0").status == 2
