"""What the README shows is what happens."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import lagcli
from lagcli.pipeline import read
from tests.cli.transcript import answer

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(language):
    return [body for name, body in BLOCK.findall(README.read_text("utf-8")) if name == language]


def test_commands_answer_as_shown(monkeypatch, capsysbinary):
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("COLUMNS", "80")
    text = README.read_text("utf-8")
    found = text
    for block in blocks("console"):
        commands = re.findall(r"^\$ (.*)$", block, re.MULTILINE)
        shown = "\n\n".join(f"$ {c}\n{answer(c, capsysbinary)}".strip() for c in commands)
        found = found.replace(f"```console\n{block}```", f"```console\n{shown}\n```")
    if os.environ.get("LAGCLI_UPDATE"):
        README.write_text(found, "utf-8")
    assert found == text


def test_the_problem_of_the_picture_is_one():
    problem = next(body for body in blocks("yaml") if body.startswith("title:"))
    assert read("README.md", problem.encode()).diagnostics == ()


def test_the_lines_of_python_run(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    code = next(body for body in blocks("python") if "import lagcli" in body)
    exec(code, {})
    assert "Quotient" in capsys.readouterr().out


def test_every_section_and_key_is_explained():
    from lagcli.answers import SECTIONS
    from lagcli.reader.problem_file import KEYS

    text = README.read_text("utf-8")
    assert [name for name in (*SECTIONS, *KEYS) if f"`{name}`" not in text] == []


def test_the_changes_tell_of_this_version():
    assert f"### {lagcli.__version__}\n" in README.read_text("utf-8")


@pytest.fixture
def plug_in(tmp_path):
    """A package like the README's, as an installer leaves it."""
    code = next(body for body in blocks("python") if body.startswith('"""charges.py'))
    declared = next(body for body in blocks("toml") if "lagcli.formatters" in body)
    (tmp_path / "charges.py").write_text(code, "utf-8")
    info = tmp_path / "lagcli_charges-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: lagcli-charges\nVersion: 1.0\n")
    points = declared.replace('project.entry-points."lagcli.formatters"', "lagcli.formatters")
    (info / "entry_points.txt").write_text(points.replace('"', ""))
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}

    def run(*arguments):
        return subprocess.run(
            [sys.executable, "-m", "lagcli", *arguments],
            cwd=ROOT, env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip

    return run


def test_the_formatter_of_another_package_is_listed_and_used(plug_in):
    listed = plug_in("formats").stdout.splitlines()
    assert "charges   The names of the conserved charges. (from lagcli-charges)" in listed
    solved = plug_in("solve", "problems/hoop.yaml", "--show", "charges", "-f", "charges")
    assert solved.stderr == ""
    assert solved.stdout == (
        "Hoop rolling down an incline: slide\nHoop rolling down an incline: energy\n"
    )
