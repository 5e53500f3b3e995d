"""lagcli from Python: what a program or a notebook gets."""

from __future__ import annotations

import json
import math
import subprocess
import sys

import pytest
import sympy
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

import lagcli
from lagcli.library import entries

PENDULUM = """
title: Pendulum
coordinates: [theta]
parameters: {m: {assume: positive, value: 2}, l: {assume: positive, value: 1/2}, g: 9.81}
T: m*l^2*theta'^2/2
V: -m*g*l*cos(theta)
initial: {theta: 1}
simulation: {until: 2}
"""


@pytest.fixture
def pendulum():
    return lagcli.loads(PENDULUM)


def test_load_takes_a_path_or_a_name(tmp_path):
    file = tmp_path / "p.yaml"
    file.write_text(PENDULUM)
    assert lagcli.load(file).title == "Pendulum"
    assert (
        lagcli.load("kepler").title
        == lagcli.load(entries()[0].path.parents[1] / "central/kepler.yaml").title
    )
    with pytest.raises(OSError, match="did you mean 'kepler'"):
        lagcli.load("keppler")


def test_a_dictionary_is_a_problem_like_its_text(pendulum):
    parts = {
        "coordinates": ["theta"],
        "parameters": {"m": {"assume": "positive", "value": 2}, "l": {"assume": "positive", "value": 0.5}, "g": 9.81},
        "T": "m*l^2*theta'^2/2", "V": "-m*g*l*cos(theta)", "initial": {"theta": 1},
        "simulation": {"until": 2},
    }  # fmt: skip
    there, here = (
        lagcli.solve(each, ["accelerations"]) for each in (pendulum, lagcli.problem(parts))
    )
    assert there.accelerations["theta"] == here.accelerations["theta"]


def test_a_problem_shows_itself_in_one_line(pendulum):
    assert repr(pendulum) == "<Problem 'Pendulum' with the coordinates theta>"
    assert lagcli.loads("coordinates: [x]\nT: x'^2").title == "problem"


def test_a_mistake_is_an_exception_that_shows_the_place():
    with pytest.raises(lagcli.ProblemError) as caught:
        lagcli.loads("coordinates: [x]\nT: y'^2/2\nV: k*x")
    assert "<text>:2:4: error: unknown name 'y' in T" in str(caught.value)
    assert len(caught.value.diagnostics) == 2


def test_formulas_agree_with_sympys_own_derivation(pendulum):
    found = lagcli.solve(pendulum, ["accelerations"]).accelerations["theta"].to_sympy()
    theta = dynamicsymbols("theta", real=True)
    time = dynamicsymbols._t
    m, l = sympy.symbols("m l", positive=True)  # noqa: E741
    g = sympy.Symbol("g", real=True)
    lagrangian = m * l**2 * theta.diff(time) ** 2 / 2 + m * g * l * sympy.cos(theta)
    method = LagrangesMethod(lagrangian, [theta])
    method.form_lagranges_equations()
    ours = found.subs(sympy.Symbol("t", real=True), time)
    assert sympy.simplify(ours - method.rhs()[1]) == 0


def test_a_formula_is_text_latex_and_a_function_of_arrays(pendulum):
    import numpy as np

    formula = lagcli.solve(pendulum, ["accelerations"]).accelerations["theta"]
    assert (str(formula), formula.grammar) == ("−g sin(θ)/l", "-g*sin(theta)/l")
    assert formula._repr_latex_().startswith(r"$\displaystyle")
    assert formula._repr_html_().startswith("<math displaystyle='true'><mrow><mo>−</mo><mfrac>")
    assert formula.arguments == ("theta", "l", "g")
    angles = np.linspace(-1, 1, 5)
    np.testing.assert_allclose(formula.to_numpy(["theta"])(angles), -9.81 / 0.5 * np.sin(angles))
    np.testing.assert_allclose(
        formula.to_numpy(values={"g": 1.0})(angles, 2.0), -np.sin(angles) / 2
    )


def test_a_function_needs_a_number_for_every_name():
    free = lagcli.loads("{coordinates: [x], parameters: [k], T: x'^2/2, V: k*x^2/2}")
    formula = lagcli.solve(free, ["accelerations"]).accelerations["x"]
    with pytest.raises(ValueError, match="no argument and no value: k"):
        formula.to_numpy(["x"])
    unknown = lagcli.loads("{coordinates: [x], functions: {U: [x]}, T: x'^2/2, V: U(x)}")
    with pytest.raises(ValueError, match="unspecified"):
        lagcli.solve(unknown, ["accelerations"]).accelerations["x"].to_numpy()


def test_sections_are_attributes_and_items(pendulum):
    solution = lagcli.solve(pendulum, ["charges", "energy", "momenta"])
    assert list(solution) == ["momenta", "energy", "charges"]
    assert solution.charges["energy"].conserved is True
    assert solution["momenta"]["theta"].grammar == "m*l^2*theta'"
    assert solution.sections["energy"].is_total_energy is True
    with pytest.raises(AttributeError, match="available are momenta, energy, charges"):
        _ = solution.accelerations
    with pytest.raises(ValueError, match="did you mean 'accelerations'"):
        lagcli.solve(pendulum, ["acceleration"])


def test_pages_are_those_of_the_command_line(pendulum):
    solution = lagcli.solve(pendulum)
    assert json.loads(solution.to_json())["accelerations"] == {"theta": "-g*sin(theta)/l"}
    assert "<math" in solution._repr_html_()
    assert "θ̈ = −g sin(θ)/l" in str(solution)
    assert str(solution.momenta).startswith("Momenta\n")


def test_values_are_put_in_before_the_derivation(pendulum):
    solution = lagcli.solve(pendulum, ["accelerations"], values={"l": 2, "g": "10"})
    assert solution.accelerations["theta"].grammar == "-5*sin(theta)"
    with pytest.raises(lagcli.ProblemError, match="known are m, l, g"):
        lagcli.solve(pendulum, values={"ll": 2})


def test_a_motion_has_columns_events_and_a_certificate(pendulum):
    motion = lagcli.simulate(pendulum, samples=5, show=["theta", "energy"], values={"g": 9.81})
    assert motion.columns == ("t", "theta", "energy")
    assert motion["t"] == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert motion.certificate.reached
    energy = -2 * 9.81 * 0.5 * math.cos(1)
    assert motion["energy"] == pytest.approx([energy] * 5, rel=1e-12)
    with pytest.raises(KeyError, match="there are t, theta, energy"):
        _ = motion["x"]


def test_a_motion_becomes_tables(pendulum):
    motion = lagcli.simulate(pendulum, samples=3)
    assert motion.to_arrow().column_names == ["t", "theta", "theta'"]
    assert motion.to_pandas().index.name == "t"
    assert motion.to_numpy().shape == (3, 3)
    assert motion.to_csv().startswith("t,theta,theta'\n")
    assert "<table>" in motion._repr_html_()


def test_a_run_that_cannot_reach_its_accuracy_says_why():
    motion = lagcli.simulate(lagcli.load("kepler"), 50, samples=11, at={"y'": 0})  # it falls in
    assert motion.refusal
    assert not motion.certificate.reached


@pytest.mark.parametrize(
    ("until", "message"), [(None, "give until=T"), (-1, "after 0, not -1"), ("x", "unknown name")]
)
def test_a_wrong_end_is_a_mistake(until, message):
    free = lagcli.loads("{coordinates: [x], T: x'^2/2, initial: {x': 1}}")
    with pytest.raises(lagcli.ProblemError, match=message):
        lagcli.simulate(free, until)


def test_an_explanation_and_a_check():
    account = lagcli.explain(lagcli.load("hoop"))
    assert account.complete
    assert "1. " in str(account)
    assert account.to_latex().strip()
    report = lagcli.check("hoop")
    assert report.passed
    assert repr(report).startswith("passed  ")


def test_functions_are_not_hidden_by_modules_of_their_names():
    code = "import lagcli.studies.check, lagcli.studies.sweep, lagcli; lagcli.load; assert callable(lagcli.check) and callable(lagcli.problem)"
    subprocess.run([sys.executable, "-c", code], check=True)


class Shell:
    """What the magic needs of IPython."""

    def __init__(self):
        self.names, self.magics = {}, {}

    def register_magic_function(self, function, kind, name):
        self.magics[kind, name] = function

    def push(self, names):
        self.names |= names


def test_the_cell_magic_answers_and_keeps_the_problem(capsys):
    shell = Shell()
    lagcli.load_ipython_extension(shell)
    magic = shell.magics["cell", "lagcli"]
    assert list(magic("solve accelerations,energy --name p", PENDULUM)) == [
        "accelerations",
        "energy",
    ]
    assert shell.names["p"].title == "Pendulum"
    assert magic("simulate theta", PENDULUM).columns == ("t", "theta")
    assert magic("explain", PENDULUM).complete
    assert magic("", "coordinates: [y]\nT: x'") is None
    assert "error: unknown name" in capsys.readouterr().out


def test_a_motion_shows_as_a_plot_above_its_rows(pendulum):
    motion = lagcli.simulate(pendulum, samples=21)
    shown = motion._repr_html_()
    assert '<img src="data:image/svg+xml;base64,' in shown
    assert 'alt="Pendulum: θ from ' in shown
    assert shown.index("<img") < shown.index("<summary>21 rows</summary>")
    picture = motion.plot().picture
    curve = picture.panels[0].items[0]
    assert [y for _, y in curve.pieces[0]] == motion["theta"]
    assert motion._repr_png_() == motion.plot()._repr_png_()  # for paper


def test_a_name_or_a_path_does_for_a_problem():
    kepler = lagcli.load("kepler")
    assert (
        lagcli.solve("kepler", ["energy"]).to_text() == lagcli.solve(kepler, ["energy"]).to_text()
    )
    assert lagcli.simulate("kepler", 1).rows == lagcli.simulate(kepler, 1).rows
    assert lagcli.explain("hoop").complete
    assert lagcli.check("hoop").passed
    assert lagcli.check(lagcli.load("hoop")).passed
    with pytest.raises(OSError, match="did you mean 'hoop'"):
        lagcli.solve("hooop")


def test_a_plot_and_an_animation_are_files_by_their_endings(pendulum, tmp_path):
    motion = lagcli.simulate(pendulum, samples=21)
    for ending, start in (("svg", b"<?xml"), ("pdf", b"%PDF"), ("png", b"\x89PNG")):
        file = tmp_path / f"p.{ending}"
        motion.plot("phase").save(file)
        assert file.read_bytes().startswith(start)
    with pytest.raises(ValueError, match=r"one of \.svg, \.pdf, \.png"):
        motion.plot().save(tmp_path / "p.jpg")
    with pytest.raises(ValueError, match="the kinds are series, phase"):
        motion.plot("phases")
    ball = lagcli.simulate(lagcli.load("bouncing-ball"), 2, samples=21).animate()
    ball.save(tmp_path / "ball.html")
    assert (tmp_path / "ball.html").read_text("utf-8") == ball.to_html()
    assert "<iframe" in ball._repr_html_()


def test_a_motion_without_matplotlib_shows_its_rows(pendulum, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    shown = lagcli.simulate(pendulum, samples=3)._repr_html_()
    assert "<img" not in shown
    assert "<table>" in shown
    assert lagcli.simulate(pendulum, samples=3)._repr_png_() is None


def test_a_sweep_is_a_table_of_the_motions_one_by_one(pendulum):
    table = lagcli.sweep(pendulum, {"m": [1, 2], "theta": "0.5:1:2"}, show=["theta"])
    assert table.varied == ("m", "theta(0)")
    assert table.complete
    alone = [
        lagcli.simulate(pendulum, show=["theta"], values={"m": m}, at={"theta": a})["theta"][-1]
        for m in (1, 2)
        for a in (0.5, 1.0)
    ]
    assert table["theta"] == pytest.approx(alone, rel=1e-9)
    assert json.loads(table.to_json())["varied"] == ["m", "theta(0)"]
    with pytest.raises(lagcli.ProblemError, match="did you mean 'theta'"):
        lagcli.sweep(pendulum, {"tetha": "0:1:2"})


def test_latex_has_labels_on_choice(pendulum):
    solution = lagcli.solve(pendulum, ["accelerations"])
    assert r"\label" not in solution.to_latex()
    page = solution.to_latex(labels="swing", separate=True, variants=["vartheta"])
    assert r"\begin{equation}\label{swing:accelerations:theta}" in page
    assert r"\ddot{\vartheta}" in page
    assert r"\label{eq:" in lagcli.explain(pendulum).to_latex(labels="eq")


@pytest.mark.parametrize("accuracy", [2, 1, 0, -1e-6, "1.5"])
def test_an_accuracy_lies_between_0_and_1(accuracy) -> None:
    problem = lagcli.loads("{coordinates: [x], T: x'^2/2, V: x^2/2, initial: {x: 1}}")
    with pytest.raises(lagcli.ProblemError, match="it lies between 0 and 1"):
        lagcli.simulate(problem, until=1, accuracy=accuracy)


def test_a_run_that_cannot_be_made_is_a_refusal_of_the_public_interface():
    text = "coordinates: [x]\nparameters: [m]\nT: m*x'^2/2\ninitial: {x: 1}\n"
    with pytest.raises(lagcli.Refusal, match="'m' has no value"):
        lagcli.simulate(lagcli.loads(text), until=1)


def test_sections_may_be_one_text():
    found = lagcli.solve("plane-pendulum", "accelerations, energy")
    assert str(found) == str(lagcli.solve("plane-pendulum", ["accelerations", "energy"]))
    with pytest.raises(ValueError, match="unknown section 'acceleration'"):
        lagcli.solve("plane-pendulum", "acceleration")
