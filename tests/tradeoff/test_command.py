"""`lagcli tradeoff` as a process."""

import csv
import io
import json
import subprocess
import sys
from xml.etree import ElementTree as ET

import pytest

OSCILLATOR = """
coordinates: [x]
parameters: {w: 2}
T: x'^2/2
V: w^2*x^2/2
initial: {x: 1}
simulation: {until: 3}
expect: {trajectory: {x: EXPECTED}}
"""


def run(*arguments, stdin=None):
    done = subprocess.run(
        [sys.executable, "-m", "lagcli", "tradeoff", *arguments],
        capture_output=True, text=True, input=stdin, check=False,
    )  # fmt: skip
    assert "Traceback" not in done.stderr
    return done


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    plot = tmp_path_factory.mktemp("plot") / "o.svg"
    text = OSCILLATOR.replace("EXPECTED", "cos(w*t)")
    done = run("-", "-f", "json", "--methods", "dop853,taylor", "--plot", str(plot), stdin=text)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout), plot.read_text()


@pytest.mark.long
def test_errors_are_against_the_exact_solution(made):
    document, _ = made
    assert document["reference"]["kind"].startswith("the exact solution")
    assert document["reference"]["error_bound"] < 1e-35
    errors = [each["error"] for each in document["runs"] if each["method"] == "taylor"]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 1e-20


@pytest.mark.long
def test_certificates_keep_their_promise_and_auto_is_judged(made):
    document, _ = made
    for each in document["certified"]:
        if each["reached"]:
            assert each["error"] <= each["accuracy"]
    assert [each["accuracy"] for each in document["cheapest"]] == [1e-3, 1e-6, 1e-9, 1e-12]
    assert all(each["auto"] for each in document["cheapest"])
    assert {trade["name"] for trade in document["trades"]} == {"digits", "proof"}


@pytest.mark.long
def test_the_plot_is_a_picture(made):
    _, plot = made
    assert ET.fromstring(plot).tag == "{http://www.w3.org/2000/svg}svg"


@pytest.mark.long
def test_a_wrong_formula_is_no_reference():
    text = OSCILLATOR.replace("EXPECTED", "cos(3*t)")
    done = run("-", "-f", "json", "--methods", "dop853", stdin=text)
    document = json.loads(done.stdout)
    assert "does not follow" in document["warnings"][0]
    assert document["reference"]["kind"].startswith("power series")


@pytest.mark.long
def test_kinks_have_no_power_series():
    text = "coordinates: [x]\nT: x'^2/2\nV: abs(x)\ninitial: {x: 1}\n"
    done = run("-", "--until", "2", "-f", "csv", "--methods", "dop853,taylor", stdin=text)
    assert done.returncode == 0
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    assert {row["method"] for row in rows if row["kind"] == "single"} == {"dop853"}


@pytest.mark.long
@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--until", "-1"], "must be a time after 0"),
        (["-f", "jsn"], "did you mean 'json'"),
        (["--cost", "money"], "there are total, integration, evaluations"),
        (["--methods", "dop85"], "did you mean 'dop853'"),
        (["--plot", "x.gif"], "is not one of .svg, .pdf, .png"),
        (["--plot", "nowhere/x.svg"], "there is no directory"),
        (["--set", "q=1"], "q"),
    ],
)
def test_bad_options(arguments, told):
    done = run("-", *arguments, stdin=OSCILLATOR.replace("EXPECTED", "cos(w*t)"))
    assert done.returncode == 2
    assert told in done.stderr
    assert done.stdout == ""


def test_all_mistakes_at_once(tmp_path):
    done = run(str(tmp_path / "none.yaml"), "-f", "jsn", "--cost", "money")
    assert done.returncode == 2
    assert all(word in done.stderr for word in ("jsn", "money", "none.yaml"))


def test_no_end_is_told():
    done = run("-", stdin="coordinates: [x]\nT: x'^2/2\ninitial: {x: 1}\n")
    assert done.returncode == 2
    assert "when does it end?" in done.stderr


def test_no_values_is_told():
    done = run("-", "--until", "1", stdin="coordinates: [x]\nparameters: [m]\nT: m*x'^2/2\n")
    assert done.returncode == 2
    assert "the parameter 'm' has no value" in done.stderr


@pytest.mark.long
def test_a_cut_model_is_weighed_against_the_whole():
    text = """
coordinates: [x, y]
T: x'^2/2 + y'^2
V: 3*x^2/2 + y^4/2
constraints: {rope: x + y = 1}
initial: {x: 0.5}
"""
    done = run("-", "--until", "2", "-f", "json", "--methods", "dop853", stdin=text)
    assert done.returncode == 0
    document = json.loads(done.stdout)
    [trade] = [each for each in document["trades"] if each["name"].startswith("minimal")]
    assert trade["faster"] > 1
    assert all(each["residual"] is None for each in document["runs"])


@pytest.mark.long
def test_from_another_state_the_files_solution_is_not_the_reference():
    """From x = 2 the motion is 2 cos(w t), not the cos(w t) that the file expects of its own."""
    text = OSCILLATOR.replace("EXPECTED", "cos(w*t)")
    done = run("-", "-f", "json", "--methods", "dop853", "--at", "x=2", stdin=text)
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    assert not document["reference"]["kind"].startswith("the exact solution")
    assert min(each["error"] for each in document["runs"]) < 1e-11
