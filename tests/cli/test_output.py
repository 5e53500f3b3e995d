"""`--output` writes the whole file or none of it."""

from __future__ import annotations

import json
import os
import stat
import sys
from pathlib import Path

import pytest

from lagcli.cli.files import write_output
from lagcli.cli.run import run
from tests.cli.conftest import FILES

SOLVE = ["solve", str(FILES / "pendulum.yaml"), "--show", "momenta", "-f", "json"]


def test_output_is_what_would_be_printed(tmp_path, capsysbinary):
    assert run([*SOLVE, "-o", str(tmp_path / "answer.json")]) == 0
    assert capsysbinary.readouterr().out == b""
    run(SOLVE)
    assert (tmp_path / "answer.json").read_bytes() == capsysbinary.readouterr().out


def test_a_write_that_fails_leaves_the_old_file_and_nothing_beside_it(tmp_path, monkeypatch):
    path = tmp_path / "answer.json"
    path.write_text("old")

    def full(_handle):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        write_output(path, b"new")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_that_is_wrong_leaves_the_old_output(tmp_path):
    path = tmp_path / "answer.json"
    path.write_text("old")
    assert run(["solve", str(FILES / "wrong.yaml"), "-o", str(path)]) == 2
    assert path.read_text() == "old"


def test_several_files_make_one_output(tmp_path):
    path = tmp_path / "answers.json"
    files = [str(FILES / "pendulum.yaml"), str(FILES / "atwood.yaml")]
    assert run(["solve", *files, "--show", "momenta", "-f", "json", "-o", str(path)]) == 0
    titles = [each["title"] for each in json.loads(path.read_text())]
    assert titles == ["Pendulum", "Atwood's machine"]


@pytest.mark.skipif(sys.platform == "win32", reason="permissions are others there")
def test_a_new_file_has_the_usual_permissions_and_an_old_one_keeps_its_own(tmp_path):
    path = tmp_path / "answer"
    mask = os.umask(0o027)
    try:
        write_output(path, b"new")
        assert stat.S_IMODE(path.stat().st_mode) == 0o640
        path.chmod(0o600)
        write_output(path, b"newer")
        assert stat.S_IMODE(path.stat().st_mode) == 0o600
    finally:
        os.umask(mask)


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "target").write_text("old")
    (tmp_path / "link").symlink_to(tmp_path / "target")
    write_output(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "target").read_text() == "new"


def test_what_is_no_file_is_written_as_it_is():
    write_output(Path(os.devnull), b"new")
    assert not Path(os.devnull).is_file()


@pytest.mark.parametrize("command", [SOLVE, ["simulate", str(FILES / "pendulum.yaml")]])
def test_links_in_a_circle_are_no_place_and_stay(tmp_path, capsys, command):
    one, other = tmp_path / "one", tmp_path / "other"
    one.symlink_to(other)
    other.symlink_to(one)
    numbers = [] if command is SOLVE else ["--until", "1", "--set", "m=1"]
    assert run([*command, *numbers, "-o", str(one)]) == 2
    assert capsys.readouterr().err.endswith("one: error: too many levels of symbolic links\n")
    assert one.is_symlink()
    assert other.is_symlink()


def test_a_name_that_no_file_may_have_is_told(tmp_path, capsys):
    assert run([*SOLVE, "-o", str(tmp_path / ("a" * 300))]) == 2
    assert capsys.readouterr().err.endswith("a: error: file name too long\n")


@pytest.mark.parametrize("link", ["itself", "symbolic", "hard", "through a folder"])
@pytest.mark.parametrize("command", ["solve", "explain", "simulate", "extremes", "tradeoff"])
def test_the_problem_is_not_replaced_by_its_answer(command, link, tmp_path, capsysbinary):
    problem = tmp_path / "problem.json"
    problem.write_bytes((FILES / "pendulum.yaml").read_bytes())
    output = tmp_path / "answer.json"
    if link == "itself":
        output = problem
    elif link == "symbolic":
        output.symlink_to(problem)
    elif link == "hard":
        output.hardlink_to(problem)
    else:
        (tmp_path / "folder").mkdir()
        output = tmp_path / "folder" / ".." / "problem.json"
    assert run([command, str(problem), "-o", str(output)]) == 2
    assert b"is the problem itself" in capsysbinary.readouterr().err
    assert problem.read_bytes() == (FILES / "pendulum.yaml").read_bytes()


@pytest.mark.parametrize("command", [["solve"], ["explain"], ["export", "--to", "c"]])
def test_the_problem_on_standard_input_is_not_replaced(
    command, tmp_path, capsysbinary, monkeypatch
):
    problem = tmp_path / "problem"
    problem.write_bytes((FILES / "pendulum.yaml").read_bytes())
    with problem.open() as standard_input:
        monkeypatch.setattr("sys.stdin", standard_input)
        assert run([*command, "-", "-o", str(problem)]) == 2
    assert b"is the problem itself" in capsysbinary.readouterr().err
    assert problem.read_bytes() == (FILES / "pendulum.yaml").read_bytes()


def test_what_is_not_a_problem_is_named(tmp_path, capsys):
    (tmp_path / "empty").mkdir()
    (tmp_path / "program.yaml").write_bytes(b"\x7fELF\0\1\xc0")
    for name, said in (("empty", "no problem (*.yaml)"), ("program.yaml", "not a text file")):
        assert run(["solve", str(tmp_path / name)]) == 2
        assert said in capsys.readouterr().err
