"""The LaTeX of every problem of the library compiles, no line more than 10pt too wide."""

from __future__ import annotations

from pathlib import Path

import pytest

from lagcli.formatters.latex import render
from lagcli.formatters.options import Options
from lagcli.pipeline import load, solve

from .test_latex import compiled, needs_latex

LIBRARY = Path(__file__).parents[2] / "problems"
FOLDERS = sorted({path.parent for path in LIBRARY.rglob("*.yaml")})

pytestmark = needs_latex


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_a_folder_of_the_library_compiles(folder, tmp_path):
    answers = [solve(load(path)) for path in sorted(folder.glob("*.yaml"))]
    compiled(render(answers, Options(standalone=True)), tmp_path)
