"""A section of another package is in everything that the built-in ones are in."""

from __future__ import annotations

import json
import sys

import pytest

import tests.test_manual as manual
from lagcli.cli.run import run
from lagcli.statements.registry import built_in, every_section, find_section

DAMPED = """\
title: Damped oscillator
coordinates: [x]
parameters: {m: {assume: positive}, k: {assume: positive}, c: {assume: positive}}
T: m*x'^2/2
V: k*x^2/2
dissipation: c*x'^2/2
expect: {power: -c*x'^2}
"""


@pytest.fixture
def call(tmp_path, monkeypatch, capsysbinary):
    """Run a command beside the package of the manual: exit status, standard output and error."""
    package = tmp_path / "package"
    package.mkdir()
    manual.install("power", "lagcli.sections", package)
    monkeypatch.syspath_prepend(package)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "damped.yaml").write_text(DAMPED)

    def called(*arguments):
        status = run(arguments)
        shown = capsysbinary.readouterr()
        return status, shown.out.decode(), shown.err.decode()

    yield called
    sys.modules.pop("power", None)


def test_it_is_listed_after_the_energy(call):
    names = [each.name for each in every_section()]
    assert names[names.index("energy") + 1] == "power"
    assert "energy, power, hamiltonian" in " ".join(call("solve", "--help")[1].split())
    assert "power" in call("explain", "--help")[1]
    schema = json.loads(call("schema", "problem")[1])
    assert "power" in schema["properties"]["expect"]["allOf"][0]["properties"]


@pytest.mark.parametrize(
    ("form", "shown"),
    [("text", "P = −c ẋ²"), ("latex", r"P &= -c \dot{x}^{2}"), ("html", "<mi>P</mi>"),
     ("markdown", "## Power of the applied forces"), ("json", '"power": "-c*x\'^2"')],
)  # fmt: skip
def test_it_is_in_every_format(call, form, shown):
    status, out, err = call("solve", "damped.yaml", "--show", "energy,power", "-f", form)
    assert (status, err) == (0, "")
    assert shown in out


def test_it_has_its_place_on_the_page_and_is_not_shown_unasked(call):
    _, page, _ = call("solve", "damped.yaml", "--show", "hamiltonian,power,energy")
    headings = ["Energy", "Power of the applied forces", "Hamiltonian"]
    assert sorted(headings, key=page.index) == headings
    assert "Power" not in call("solve", "damped.yaml")[1]


def test_it_is_explained(call):
    assert "The applied forces work at the rate" in call(
        "explain", "damped.yaml", "--also", "power"
    )[1]  # fmt: skip


def test_its_expectation_is_read_and_compared(call, tmp_path):
    assert call("check", "damped.yaml", "-j", "1")[0] == 0
    (tmp_path / "damped.yaml").write_text(DAMPED.replace("-c*x", "c*x"))
    status, out, _ = call("check", "damped.yaml", "-j", "1")
    assert (status, "expected c*x'^2, derived -c*x'^2" in out) == (1, True)
    (tmp_path / "damped.yaml").write_text(DAMPED.replace("-c*x", "-c*y"))
    assert call("check", "damped.yaml", "-j", "1")[0] == 2


def test_a_plug_in_that_does_not_load_says_so_where_it_is_asked_for(call, tmp_path):
    (tmp_path / "package" / "power.py").write_text("import nowhere")
    status, _, told = call("solve", "damped.yaml", "--show", "power")
    assert status == 2
    assert "the section 'power' does not load: ModuleNotFoundError" in told


def test_every_built_in_section_is_found_by_its_name():
    assert all(find_section(each.name) is each for each in built_in())
    orders = [each.order for each in built_in()]
    assert orders == sorted(set(orders))
