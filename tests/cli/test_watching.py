"""`lagcli solve --watch`, as a process whose file is edited beside it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

from lagcli.cli.run import run

SPRING = "title: Spring\ncoordinates: [x]\nparameters: [m, k]\nT: m*x'^2/2\nV: {}\n"


@pytest.fixture
def watched(tmp_path):
    file = tmp_path / "spring.yaml"
    file.write_text(SPRING.format("k*x^2/2"))
    process = subprocess.Popen(
        [sys.executable, "-m", "lagcli", "solve", file.name, "--show", "accelerations", "--watch"],
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        encoding="utf-8", env={**os.environ, "PYTHONUTF8": "1"},
    )  # fmt: skip
    yield file, process
    process.kill()
    process.wait()
    process.stdout.close()


def until(process, words):
    """Read to a line with the words; where the process ends before, there is none."""
    for line in process.stdout:
        if words in line:
            return line.strip()
    raise AssertionError(words)


@pytest.mark.long
def test_the_answer_comes_again_and_mistakes_are_watched_on(watched):
    file, process = watched
    assert until(process, "ẍ =") == "ẍ = −k x/m"
    file.write_text(SPRING.format("k*x^4/4"))
    assert until(process, "ẍ =") == "ẍ = −k x³/m"
    file.write_text(SPRING.format("q*x^2/2"))
    assert "unknown name 'q' in V" in until(process, "error")
    other = file.with_suffix(".new")  # as an editor saves
    other.write_text(SPRING.format("k*x"))
    other.replace(file)
    assert until(process, "ẍ =") == "ẍ = −k/m"
    process.send_signal(signal.SIGINT)
    rest, _ = process.communicate()
    assert process.returncode == 130
    assert "Traceback" not in rest


def test_standard_input_cannot_be_watched(capsys):
    assert run(["solve", "-", "--watch"]) == 2
    assert "--watch needs a file" in capsys.readouterr().err
