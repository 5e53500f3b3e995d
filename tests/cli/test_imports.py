"""What starts quickly stays quick: nothing heavy is imported before it is needed."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

HEAVY = ("sympy", "numpy", "matplotlib", "mpmath", "flint", "lark", "yaml", "rich", "pydantic")

PROBE = """
import sys
from lagcli.cli.run import run
status = run(sys.argv[1:])
sys.stdout.flush()
sys.stderr.write(",".join(name for name in {heavy!r} if name in sys.modules))
sys.exit(status)
"""


def imported(*arguments, **environment):
    done = subprocess.run(
        [sys.executable, "-c", PROBE.format(heavy=HEAVY), *arguments],
        capture_output=True,
        env={**os.environ, **environment},
        check=False,
    )
    return done.returncode, done.stderr.decode()


@pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        ["solve", "--help"],
        ["check", "--help"],
        ["plot", "--help"],
        ["animate", "--help"],
        ["formats"],
        ["version"],
    ],
    ids=" ".join,
)
def test_answers_without_heavy_imports(arguments):
    assert imported(*arguments) == (0, "")


@pytest.mark.parametrize("words", ["lagcli so", "lagcli solve --show char", "lagcli solve -f js"])
def test_completion_without_heavy_imports(words):
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "lagcli"],
        capture_output=True,
        text=True,
        check=False,
        env={
            **os.environ,
            "_LAGCLI_COMPLETE": "complete_bash",
            "COMP_WORDS": words,
            "COMP_CWORD": str(len(words.split()) - 1),
        },
    )
    modules = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
    assert done.stdout.strip() in {"solve", "charges", "json"}
    assert modules.isdisjoint(HEAVY)


def test_importing_lagcli_imports_nothing_else():
    code = "import sys, lagcli; print([m for m in sys.modules if m.startswith('lagcli.')])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_each_command_says_in_help_what_the_table_says():
    import importlib

    from lagcli.cli.app import COMMANDS

    for name, summary in COMMANDS.items():
        function = getattr(importlib.import_module(f"lagcli.cli.{name}"), name)
        first = function.__doc__.partition("\n")[0]
        assert first.removesuffix(".").startswith(summary.removesuffix("."))


def test_the_help_is_one_screen(capsys):
    from lagcli.cli.app import COMMANDS
    from lagcli.cli.run import run

    assert run(["--help"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) < 24  # the prompt has the last line
    assert max(map(len, lines)) <= 80
    shown = " ".join(lines)
    assert [name for name in COMMANDS if name not in shown] == []


def test_the_help_of_each_command_is_one_screen(capsys, monkeypatch):
    from lagcli.cli.app import COMMANDS
    from lagcli.cli.run import run

    monkeypatch.setenv("COLUMNS", "80")
    for name in COMMANDS:
        assert run([name, "--help"]) == 0
        lines = capsys.readouterr().out.splitlines()
        assert (len(lines) <= 48, max(map(len, lines)) <= 80) == (True, True), name


def test_the_help_names_every_section():
    from lagcli.statements.registry import built_in

    done = subprocess.run(
        [sys.executable, "-m", "lagcli", "solve", "--help"],
        capture_output=True,
        text=True,
        check=True,
    )
    words = done.stdout.replace(",", " ").replace(".", " ").split()
    assert [each.name for each in built_in() if each.name not in words] == []
