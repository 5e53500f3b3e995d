"""The notebooks of the manual: each cell runs, and what it shows is shown as in Jupyter."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from IPython.core.interactiveshell import InteractiveShell

import lagcli

SLOW = ("phase-space", "equilibria", "motions")
NOTEBOOKS = sorted((Path(lagcli.__file__).parent / "manual" / "notebooks").glob("*.ipynb"))


@pytest.fixture
def shell():
    made = InteractiveShell.instance()
    made.reset(new_session=False)
    yield made
    InteractiveShell.clear_instance()


def cells(path):
    for cell in json.loads(path.read_text("utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            yield "".join(cell["source"])


@pytest.mark.first_quick
@pytest.mark.parametrize(
    "path",
    [
        path if path.stem not in SLOW else pytest.param(path, marks=pytest.mark.long)
        for path in NOTEBOOKS
    ],
    ids=lambda path: path.stem,
)
def test_every_cell_runs_and_shows_what_it_ends_with(path, shell, capsys):
    shown = 0
    for code in cells(path):
        outcome = shell.run_cell(code, store_history=False)
        outcome.raise_error()
        if outcome.result is not None:
            forms, _ = shell.display_formatter.format(outcome.result)
            shown += any(kind in forms for kind in ("text/html", "text/latex"))
    assert shown
    capsys.readouterr()


def test_a_mistake_in_a_cell_is_shown_at_its_place(shell, capsys):
    shell.run_cell("%load_ext lagcli").raise_error()
    outcome = shell.run_cell("%%lagcli\ncoordinates: [x]\nT: y'^2/2")
    assert outcome.result is None
    assert "error: unknown name 'y' in T" in capsys.readouterr().out


def test_there_is_a_notebook_for_each_topic_and_the_page_lists_them():
    page = (Path(lagcli.__file__).parent / "manual" / "python.md").read_text("utf-8")
    assert [path.name for path in NOTEBOOKS if f"(notebooks/{path.name})" not in page] == []
