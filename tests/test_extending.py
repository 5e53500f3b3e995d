"""The recipes of the manual that change lagcli itself, each carried out in a copy of it."""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.test_manual import EXTENDING, ROOT, blocks


def changed(text: str, old: list[str], new: list[str]) -> str:
    before, after = "\n".join(old), "\n".join(new)
    assert text.count(before) == 1, before
    return text.replace(before, after)


def carry_out(recipe: str, folder: Path) -> None:
    """Change the files under a folder as a recipe says: lines with -, +, or neither."""
    for part in recipe.split("+++ ")[1:]:
        name, *lines = part.rstrip("\n").split("\n")
        old = [line[1:] for line in lines if line[0] in " -"]
        new = [line[1:] for line in lines if line[0] in " +"]
        path = folder / name
        path.write_text(changed(path.read_text("utf-8"), old, new), "utf-8")


@pytest.fixture
def call(tmp_path):
    """Run a command of a copy of lagcli that a recipe has changed."""

    def called(file: str, problem: str, *arguments: str):
        shutil.copytree(ROOT / "lagcli", tmp_path / "lagcli", dirs_exist_ok=True)
        [recipe] = [body for body in blocks("diff", EXTENDING) if file in body]
        carry_out(recipe, tmp_path)
        (tmp_path / "p.yaml").write_text(problem)
        return subprocess.run(
            [sys.executable, "-m", "lagcli", *arguments, "p.yaml"],
            cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path), "LAGCLI_NO_CACHE": "1"},
            capture_output=True, text=True, check=False,
        )  # fmt: skip

    return called


def test_a_diagnostic(call):
    points = "  a: {position: [2*x], mass: 2}\n  b: {position: [2*x], mass: 3}\n"
    problem = f"coordinates: [x]\npoints:\n{points}"
    done = call("value_checks.py", problem, "solve")
    assert (done.returncode, "p.yaml:4:3: error" in done.stderr) == (2, True)
    assert "the point 'b' is where another one is" in done.stderr


@pytest.mark.long
def test_a_simplification_rule(call):
    problem = "coordinates: [x]\nT: x'^2/2\nV: asinh(sinh(x))^2/2\n"
    done = call("algebra/build.py", problem, "solve", "-f", "json")
    assert done.stderr == ""
    assert '"accelerations": {\n    "x": "-x"\n  }' in done.stdout


@pytest.mark.long
def test_a_kind_of_constraint(call):
    problem = (
        "coordinates: [x, y]\nparameters: [v]\nT: (x'^2 + y'^2)/2\n"
        "constraints: {moving: x = v*t, resting: y = 1}\n"
    )
    done = call("constraints.py", problem, "solve", "--show", "multipliers")
    assert (done.returncode, done.stderr) == (0, "")
    assert "(moving: rheonomic)" in done.stdout
    assert "(resting: holonomic)" in done.stdout


@pytest.fixture
def with_module(tmp_path):
    """A copy of lagcli with a module more, and its command."""

    def added(name: str, problem: str):
        shutil.copytree(ROOT / "lagcli", tmp_path / "lagcli")
        file = Path(name).name
        [module] = [body for body in blocks("python", EXTENDING) if body.startswith(f'"""{file}')]
        (tmp_path / name).write_text(module, "utf-8")
        (tmp_path / "p.yaml").write_text(problem)

        def call(*arguments: str):
            return subprocess.run(
                [sys.executable, "-m", "lagcli", *arguments],
                cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(tmp_path), "LAGCLI_NO_CACHE": "1"},
                capture_output=True, text=True, check=False,
            )  # fmt: skip

        return call

    return added


@pytest.mark.long
def test_a_built_in_formatter(with_module):
    call = with_module("lagcli/formatters/built_in/charges.py", "coordinates: [x]\nT: x'^2/2\n")
    done = call("solve", "p.yaml", "-f", "charges", "--show", "charges")
    assert (done.returncode, done.stderr) == (0, "")
    assert "p_x\n" in done.stdout
    assert "charges   The names of the conserved charges.\n" in call("formats").stdout


@pytest.mark.long
def test_a_method(with_module):
    call = with_module(
        "lagcli/numerics/certified/methods/verlet2.py",
        "coordinates: [x]\nT: x'^2/2\nV: x^2/2\ninitial: {x: 1}\n",
    )
    done = call(
        "simulate", "p.yaml", "--method", "verlet2", "--until", "3", "--samples", "4",
        "--accuracy", "1e-4", "-f", "json",
    )  # fmt: skip
    found = json.loads(done.stdout)
    assert (done.returncode, done.stderr, found["method"]["name"]) == (0, "", "verlet2")
    assert found["certificate"]["reached"]
    assert [row[1] for row in found["rows"]] == pytest.approx([*map(math.cos, range(4))], abs=1e-4)
    assert "verlet2" in call("schema").stdout
    assert "verlet2" in call("simulate", "p.yaml", "--until", "3", "--method", "none").stderr
