"""Recipes of the manual for other programs are run as they stand there."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from IPython.core.interactiveshell import InteractiveShell

import lagcli
from lagcli.cli.run import run

PAGE = (Path(lagcli.__file__).parent / "manual" / "pages.md").read_text("utf-8")
ROOT = Path(lagcli.__file__).parents[1]


def pandoc():
    """The program, or the one that the package pypandoc_binary brings."""
    try:
        from pypandoc import get_pandoc_path

        return get_pandoc_path()
    except (ImportError, OSError):
        return shutil.which("pandoc")


@pytest.mark.skipif(pandoc() is None, reason="pandoc is missing")
def test_pandoc_makes_a_page_of_word_with_every_formula(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "problems").symlink_to(ROOT / "problems")
    recipe = re.search(r"```sh\n(lagcli explain .*\npandoc .*)\n```", PAGE)[1]
    ours, theirs = map(shlex.split, recipe.splitlines())
    assert run(ours[1:]) == 0
    made = subprocess.run([pandoc(), *theirs[1:]], capture_output=True, text=True, check=True)
    assert made.stderr == ""
    with zipfile.ZipFile("hoop.docx") as word:
        text = word.read("word/document.xml").decode()
    markdown = Path("hoop.md").read_text("utf-8")
    displays = markdown.count("$$") // 2
    assert text.count("<m:oMathPara>") == displays > 10
    assert "$" not in re.sub(r"<[^>]*>", "", text)


@pytest.mark.long
@pytest.mark.skipif(pandoc() is None, reason="pandoc is missing")
@pytest.mark.parametrize("name", ["hoop", "double-pendulum", "rolling-hoop", "lagrange-points"])
def test_pandoc_reads_every_formula_of_markdown(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(["solve", name, "-o", "page.md"]) == 0
    made = subprocess.run(
        [pandoc(), "page.md", "--from", "markdown+tex_math_dollars", "--to", "html", "--mathml"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert made.stderr == ""  # it names what it cannot read
    assert "<math" in made.stdout


def test_the_cells_of_the_quarto_document_run_and_show_mathematics():
    document = re.search(r"````text\n(.*?)````", PAGE, re.DOTALL)[1]
    shell = InteractiveShell.instance()
    try:
        cells = re.findall(r"```{python}\n(.*?)```", document, re.DOTALL)
        inline = re.findall(r"`{python} ([^`]+)`", document)
        for code in (*cells, *inline):
            outcome = shell.run_cell(code)
            outcome.raise_error()
            forms, _ = shell.display_formatter.format(outcome.result)
            assert "$" in forms["text/markdown"]  # for a sentence, LaTeX and Word
            assert code in inline or "<math" in forms["text/html"]
    finally:
        InteractiveShell.clear_instance()
    assert document.startswith("---\ntitle: ")


@pytest.mark.long
def test_the_gallery_has_a_page_of_each_problem_and_a_list(tmp_path):
    from tests.gallery import main

    assert main(tmp_path / "gallery", ["plane-pendulum", "central/kepler", "ray-of-light"]) == 0
    index = (tmp_path / "gallery" / "index.html").read_text("utf-8")
    addresses = re.findall(r"(?:href|src|srcset)='([^']+)'", index)
    assert "pendulums/plane-pendulum.svg" in addresses
    assert [a for a in addresses if not (tmp_path / "gallery" / a).is_file()] == []
    assert "<h2>central</h2>" in index
