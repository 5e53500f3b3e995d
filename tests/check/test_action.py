"""The action of `.github/actions/check`: its steps are run as a workflow would run them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
ACTION = ROOT / ".github" / "actions" / "check"
LOADED = yaml.safe_load((ACTION / "action.yml").read_text("utf-8"))

WRONG = """title: Spring
coordinates: [x]
parameters: [m, k]
T: m*x'^2/2
V: k*x^2/2
expect:
  accelerations: {x: k*x/m}
"""


@pytest.fixture
def step(tmp_path):
    """The last step with the inputs of a workflow: its status, output and variables."""
    (tmp_path / "a folder").mkdir()
    (tmp_path / "a folder" / "wrong.yaml").write_text(WRONG)
    (tmp_path / "right.yaml").write_text(WRONG.replace("{x: k", "{x: -k"))

    def run(**inputs):
        inputs = {name: given["default"] for name, given in LOADED["inputs"].items()} | inputs
        last = LOADED["runs"]["steps"][-1]
        given = {
            name: value.replace("${{ inputs.", "").replace(" }}", "")
            for name, value in last["env"].items()
        }
        environment = {
            **os.environ,
            **{name: inputs[key] for name, key in given.items()},
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
            "GITHUB_OUTPUT": str(tmp_path / "outputs"),
        }
        done = subprocess.run(
            [shutil.which("bash"), "-eo", "pipefail", "-c", last["run"]],
            cwd=tmp_path, env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert done.stderr == ""
        return done.returncode, done.stdout

    return run


def test_a_wrong_answer_is_an_annotation_at_its_line(step):
    status, shown = step(paths="a folder\nright.yaml\n", arguments="-j 1")
    assert status == 1
    assert "::error file=a folder/wrong.yaml,line=7" in shown
    assert step(paths="right.yaml")[0] == 0


def test_the_report_for_code_scanning_is_a_file(step, tmp_path):
    assert step(paths="a folder", format="sarif", arguments="-j 1 --timeout 100")[0] == 1
    assert (tmp_path / "outputs").read_text() == "report=lagcli.sarif\n"
    found = json.loads((tmp_path / "lagcli.sarif").read_text("utf-8"))["runs"][0]["results"]
    assert [each["level"] for each in found] == ["error"]


@pytest.mark.long
def test_a_shard_leaves_the_rest_to_others(step):
    shown = [step(paths=".", shard=f"{k}/2", arguments="-j 1")[0] for k in (1, 2)]
    assert sorted(shown) == [0, 1]


def test_what_is_installed_is_this_package():
    install = LOADED["runs"]["steps"][1]["run"]
    place = install.split('"')[1].replace("$GITHUB_ACTION_PATH", str(ACTION)).removesuffix("[fast]")
    assert (Path(place).resolve() / "pyproject.toml").samefile(ROOT / "pyproject.toml")
    assert LOADED["runs"]["using"] == "composite"
