"""Every problem of the library compiles as LaTeX, answers and explanation, none too wide."""

from __future__ import annotations

from pathlib import Path

import pytest

from lagcli.formatters import explaining
from lagcli.formatters.display_width import display_width
from lagcli.formatters.latex import render
from lagcli.formatters.options import Options
from lagcli.mechanics.from_hamiltonian import NoLagrangian
from lagcli.pipeline import derive, explain, load, solve

from .test_latex import compiled, needs_latex

LIBRARY = Path(__file__).parents[2] / "problems"
FOLDERS = sorted({path.parent for path in LIBRARY.rglob("*.yaml")})

pytestmark = needs_latex


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_a_folder_of_the_library_compiles(folder, tmp_path):
    answers = [solve(load(path)) for path in sorted(folder.glob("*.yaml"))]
    compiled(render(answers, Options(standalone=True)), tmp_path)


def has_lagrangian(problem):
    """There is nothing to tell from an H whose velocities do not determine the momenta."""
    try:
        return derive(problem).problem is not None
    except NoLagrangian:
        return False


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_the_explanations_of_a_folder_compile(folder, tmp_path):
    problems = [load(path) for path in sorted(folder.glob("*.yaml"))]
    told = [explain(derive(problem)) for problem in problems if has_lagrangian(problem)]
    compiled(explaining.render(told, "latex", Options(standalone=True)), tmp_path)
    for line in explaining.render(told, "text", Options(width=80)).splitlines():
        assert display_width(line) <= 80, line
    for format_name in ("markdown", "html", "json"):
        assert explaining.render(told, format_name, Options())


FURTHER = {
    "central/kepler": ("canonical", "discovered", "algebra"),
    "hamiltonian/oscillator-by-generating-function": ("canonical",),
    "rolling/disk-on-incline-with-contact": ("forces", "model", "dimensions"),
}


def test_the_further_steps_of_an_explanation_compile(tmp_path):
    told = [explain(derive(load(LIBRARY / f"{name}.yaml")), also) for name, also in FURTHER.items()]
    compiled(explaining.render(told, "latex", Options(standalone=True)), tmp_path)
