"""The same reports as text, JSON, JUnit's XML and GitHub's commands."""

from __future__ import annotations

import json
from xml.etree import ElementTree  # noqa: ICN001

import pytest

from lagcli.diagnostics import Diagnostic, Source, Span
from lagcli.studies.check import CheckOutcome, Finding, Report
from lagcli.studies.check.reports import FORMS

PLACE = Span(12, 3, 12, 8)
REPORTS = [
    Report(Source("good.yaml", ""), checks=7),
    Report(
        Source("a,b: 100%.yaml", ""),
        checks=2,
        findings=(
            Finding(CheckOutcome.WRONG, "accelerations.x", "expected <g>\x1b[0m & co", PLACE),
        ),
    ),
    Report(
        Source("late.yaml", ""), findings=(Finding(CheckOutcome.TOO_LONG, "time", "took long"),)
    ),
    Report(
        Source("bad.yaml", "T: x'\n"),
        diagnostics=(Diagnostic("no coordinates", Span(1, 1, 1, 2), "add some"),),
    ),
]


def made(form):
    return "".join(FORMS[form](REPORTS))


def test_text_names_file_line_and_column():
    assert made("text") == (
        "passed  good.yaml  (7 checks)\n"
        "FAILED  a,b: 100%.yaml  (wrong)\n"
        "    a,b: 100%.yaml:12:3: wrong: accelerations.x\n"
        "        expected <g>␛[0m & co\n"
        "FAILED  late.yaml  (took too long)\n"
        "    late.yaml: took too long: time\n"
        "        took long\n"
        "FAILED  bad.yaml  (invalid file)\n"
        "    bad.yaml:1:1: error: no coordinates\n"
        "        1 | T: x'\n"
        "          | ^ add some\n"
        "4 problems, 9 checks: 1 passed, 1 wrong, 1 took too long, 1 invalid file\n"
    )


def test_json_has_every_finding():
    value = json.loads(made("json"))
    assert value["summary"] == {
        "passed": 1, "wrong": 1, "undecided": 0, "took too long": 1, "broken": 0,
        "invalid file": 1,
    }  # fmt: skip
    assert value["problems"][1]["findings"][0]["line"] == 12
    assert value["problems"][2]["findings"][0]["line"] is None
    assert value["problems"][3]["diagnostics"][0]["hint"] == "add some"


def test_junit_is_xml_and_counts():
    suite = ElementTree.fromstring(made("junit"))
    assert {key: suite.get(key) for key in ("tests", "failures", "errors")} == {
        "tests": "4", "failures": "2", "errors": "1",
    }  # fmt: skip
    good, wrong, late, bad = suite
    assert len(good) == 0
    assert wrong.get("name") == "a,b: 100%.yaml"
    assert wrong[0].tag == "failure"
    assert "12:3: wrong: accelerations.x: expected <g>" in wrong[0].text
    assert late[0].get("type") == "took too long"
    assert bad[0].tag == "error"


def test_github_marks_the_line_and_escapes_what_it_must():
    lines = made("github").splitlines()
    assert lines[0] == (
        "::error file=a%2Cb%3A 100%25.yaml,line=12,col=3,endLine=12,endColumn=8,"
        "title=wrong%3A accelerations.x::expected <g>␛[0m & co"
    )
    assert lines[1] == "::error file=late.yaml,title=took too long%3A time::took long"
    assert lines[2].endswith("::no coordinates (add some)")
    assert lines[3] == "4 problems checked, 3 not passed"


@pytest.mark.parametrize("form", FORMS)
def test_no_report_talks_to_the_terminal(form):
    assert "\x1b" not in made(form)


def test_sarif_has_each_finding_at_its_place():
    """The parts of the standard that readers need: rules, levels, regions, escaped names."""
    log = json.loads(made("sarif"))
    [one] = log["runs"]
    rules = {rule["id"] for rule in one["tool"]["driver"]["rules"]}
    found = [(each["ruleId"], each["level"]) for each in one["results"]]
    assert found == [("wrong", "error"), ("took-too-long", "error"), ("invalid-file", "error")]
    assert {rule for rule, _ in found} <= rules
    [place] = one["results"][0]["locations"]
    assert place["physicalLocation"] == {
        "artifactLocation": {"uri": "a%2Cb%3A%20100%25.yaml"},
        "region": {"startLine": 12, "startColumn": 3, "endLine": 12, "endColumn": 8},
    }
    assert "region" not in one["results"][1]["locations"][0]["physicalLocation"]
    assert "\x1b" not in one["results"][0]["message"]["text"]
