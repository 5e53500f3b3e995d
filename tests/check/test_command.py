"""`lagcli check` from the paths to the exit status."""

from __future__ import annotations

import json

import pytest

from lagcli.cli.run import run

GOOD = "coordinates: [x]\nparameters: [m]\nT: m*x'^2/2\nexpect: {accelerations: {x: 0}}\n"
WRONG = GOOD.replace("{x: 0}", "{x: 1}")
BAD = "coordinates: [x]\nT: q'^2\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "deep" / "er").mkdir(parents=True)
    (tmp_path / "deep" / "b.yaml").write_text(GOOD)
    (tmp_path / "deep" / "er" / "a.yml").write_text(GOOD)
    (tmp_path / "deep" / "notes.txt").write_text("no problem")
    return tmp_path


def check(capsysbinary, *arguments):
    status = run(["check", *arguments])
    shown = capsysbinary.readouterr()
    return status, shown.out.decode(), shown.err.decode()


def test_folders_are_searched_and_all_well_is_0(folder, capsysbinary):
    status, out, err = check(capsysbinary, "deep", "deep/b.yaml")
    assert out == (
        "passed  deep/b.yaml  (4 checks)\npassed  deep/er/a.yml  (4 checks)\n"
        "2 problems, 8 checks: 2 passed\n"
    )
    assert (status, err) == (0, "")


def test_a_wrong_answer_is_1_and_a_file_that_is_none_is_2(folder, capsysbinary):
    (folder / "wrong.yaml").write_text(WRONG)
    status, out, _ = check(capsysbinary, ".", "-f", "json", "-j", "2")
    assert status == 1
    assert [each["outcome"] for each in json.loads(out)["problems"]] == [
        "passed",
        "passed",
        "wrong",
    ]
    (folder / "bad.yaml").write_text(BAD)
    assert check(capsysbinary, ".")[0] == 2


def test_nothing_to_check_is_2(folder, capsysbinary):
    (folder / "empty").mkdir()
    status, out, err = check(capsysbinary, "empty", "nowhere", "deep")
    assert (status, out) == (2, "")
    assert err == (
        "empty: error: no problem (*.yaml) in this folder\n"
        "nowhere: error: no such file or directory, and no problem of the library: "
        "lagcli list names them\n"
    )
