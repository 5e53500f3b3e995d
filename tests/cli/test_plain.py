"""What is read without click means what click makes of it; all else is left to click."""

from __future__ import annotations

import subprocess
import sys

import pytest

from lagcli.cli import plain, simulating
from lagcli.cli.app import application, load_command

PLAIN = [
    "simulate a.yaml",
    "simulate a.yaml --until 2*pi --accuracy 1e-6 --samples 11",
    "simulate --until 5 a.yaml -f json -o out.json",
    "simulate --set g=9.81 a.yaml --set l=2 --show x,y --show energy",
    "simulate a.yaml --format csv --output out.csv --project --whole-model",
    "simulate a.yaml --precision 30 --method taylor --stop-when x-1",
    "simulate a.yaml --samples 007",
]
NOT_PLAIN = [
    "simulate",
    "simulate --help",
    "simulate a.yaml b.yaml",
    "simulate -",
    "simulate a.yaml --samples 1",
    "simulate a.yaml --samples 1e3",
    "simulate a.yaml --samples " + "9" * 5000,
    "simulate a.yaml --precision 19",
    "simulate a.yaml --unt 5",
    "simulate a.yaml --until",
    "simulate a.yaml --until -5",
    "simulate a.yaml --until=5",
    "simulate a.yaml -fjson",
    "simulate a.yaml --until 5 --until 6",
    "simulate a.yaml --project --project",
    "simulate a.yaml -o -",
    "simulate -- a.yaml",
    "solve a.yaml",
    "--help",
]


@pytest.fixture
def wishes(monkeypatch):
    found = []

    def simulate_file(wish):
        found.append(wish)
        return simulating.Status.WELL

    monkeypatch.setattr(simulating, "simulate_file", simulate_file)
    return found


@pytest.mark.parametrize("line", PLAIN)
def test_it_means_what_click_makes_of_it(line, wishes):
    assert plain.run_plainly(line.split()) == simulating.Status.WELL
    application().main(args=line.split(), prog_name="lagcli", standalone_mode=False)
    assert wishes[0] == wishes[1]


@pytest.mark.parametrize("line", NOT_PLAIN)
def test_what_is_not_plain_is_left_to_click(line, wishes):
    assert plain.run_plainly(line.split()) is None
    assert plain.run_plainly(["simulate", ""]) is None
    assert not wishes


def test_completion_is_left_to_click(monkeypatch):
    monkeypatch.setenv("_LAGCLI_COMPLETE", "complete_bash")
    assert plain.run_plainly(["simulate", "a.yaml"]) is None


def test_every_option_of_the_command_is_known():
    options = {o: p for p in load_command("simulate").params for o in p.opts if o[0] == "-"}
    assert options.keys() == {*plain.VALUES, *plain.LISTS, *plain.FLAGS}
    for name, option in options.items():
        assert option.multiple == (name in plain.LISTS)
        assert option.is_flag == (name in plain.FLAGS)


def test_a_plain_run_imports_no_click(tmp_path):
    file = tmp_path / "spring.yaml"
    file.write_text("{coordinates: [x], L: x'^2/2 - x^2/2, initial: {x: 1}}")
    code = "import sys; from lagcli.cli.run import run; run(sys.argv[1:])"
    code += "; print({'click', 'typer', 'rich'} & set(sys.modules), file=sys.stderr)"
    arguments = ["simulate", str(file), "--until", "1", "--accuracy", "1e-6"]
    command = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == "set()\n"
    assert "0.5403" in done.stdout
