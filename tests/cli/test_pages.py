"""Pages of solve and explain: LaTeX on choice, PDF, HTML with the motion."""

from __future__ import annotations

import re
import shutil
import subprocess

import pytest

from lagcli.cli.run import run

SWING = """
title: Swing
coordinates: [phi]
parameters: {l: {assume: positive, value: 1}, g: 9.81}
T: l^2*phi'^2/2
V: -g*l*cos(phi)
points: {bob: {position: [l*sin(phi), -l*cos(phi)]}}
initial: {phi: 1}
simulation: {until: 2}
"""


@pytest.fixture
def shown(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "swing.yaml").write_text(SWING)
    (tmp_path / "free.yaml").write_text("title: Free\ncoordinates: [x]\nT: x'^2/2\n")

    def call(*arguments):
        status = run(arguments)
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return call


def test_equations_of_latex_have_labels_by_section_and_symbol(shown):
    _, page, _ = shown("solve", "swing.yaml", "free.yaml", "-f", "latex", "--latex", "labels")
    labels = re.findall(r"\\label{([^}]*)}", page)
    assert {"eq:accelerations:phi", "eq:equations-of-motion:1", "eq:momenta:p_phi"} <= {*labels}
    assert len(labels) == len({*labels})
    assert "align*" not in page


def test_labels_have_the_prefix_of_the_user(shown):
    words = "labels=swing,equation,varphi"
    _, page, _ = shown("explain", "swing.yaml", "-f", "latex", "--latex", words)
    assert r"\begin{equation}\label{swing:" in page
    assert "align" not in page
    assert not re.search(r"\\phi\b", page)
    assert r"\ddot{\varphi}" in page


@pytest.mark.parametrize(
    ("words", "message"),
    [("lables", "did you mean 'labels'"), ("labels=}{", "letters, digits"), ("varphi=x", "takes")],
)
def test_a_wrong_word_is_an_error(words, message, shown):
    status, page, told = shown("solve", "swing.yaml", "-f", "latex", "--latex", words)
    assert (status, page) == (2, "")
    assert message in told
    assert shown("solve", "swing.yaml", "--latex", "labels")[0] == 2


@pytest.mark.long
@pytest.mark.latex
@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is missing")
@pytest.mark.parametrize("words", ["align", "labels", "equation", "labels,equation,vartheta"])
def test_a_pdf_is_made_of_any_choice_and_twice_the_same(words, shown, tmp_path):
    name = "double-pendulum"
    for file in ("one.pdf", "two.pdf"):
        assert shown("explain", name, "--latex", words, "-o", file)[0::2] == (0, "")
    assert (tmp_path / "one.pdf").read_bytes().startswith(b"%PDF-")
    assert (tmp_path / "one.pdf").read_bytes() == (tmp_path / "two.pdf").read_bytes()


def test_without_latex_a_pdf_says_what_to_install(shown, monkeypatch, tmp_path):
    monkeypatch.setattr("shutil.which", lambda _: None)
    status, _, told = shown("solve", "swing.yaml", "-o", "swing.pdf")
    assert (status, "apt-get install texlive-latex-base" in told) == (2, True)
    assert not (tmp_path / "swing.pdf").exists()


def test_what_latex_complains_of_is_one_line(shown, monkeypatch):
    failed = subprocess.CompletedProcess([], 1, b"This is pdfTeX\n! Undefined control sequence.\n")
    monkeypatch.setattr("lagcli.cli.pdf._engine", lambda: "/usr/bin/pdflatex")
    monkeypatch.setattr("subprocess.run", lambda *_, **__: failed)
    status, _, told = shown("solve", "swing.yaml", "-o", "swing.pdf")
    assert (status, told) == (2, "lagcli: error: pdflatex stopped: Undefined control sequence.\n")


def test_html_in_a_file_is_a_whole_page_and_in_a_pipe_a_fragment(shown, tmp_path):
    _, fragment, _ = shown("solve", "swing.yaml", "-f", "html")
    shown("solve", "swing.yaml", "-o", "swing.html")
    whole = (tmp_path / "swing.html").read_text("utf-8")
    assert fragment.startswith("<article>")
    assert whole.startswith("<!DOCTYPE html>")
    assert '<meta charset="utf-8">' in whole
    assert fragment in whole


@pytest.mark.long
@pytest.mark.parametrize("command", ["solve", "explain"])
def test_a_page_with_motion_has_plot_and_animation_and_no_address(command, shown, tmp_path):
    files = ("swing.yaml", "free.yaml")
    status, _, told = shown(command, *files, "--with-motion", "-o", "page.html")
    page = (tmp_path / "page.html").read_text("utf-8")
    assert status == 0
    assert told == "free.yaml: no motion: the file gives no end: simulation: {until: T}\n"
    assert page.count("<h2>Motion</h2>") == page.count("<iframe ") == 1
    assert page.index("<iframe") < page.index("<h1>Free</h1>")
    assert 'media="(prefers-color-scheme: dark)"' in page
    assert not re.search(r"""(?:src|href|srcset)=["'](?!data:)""", page)


def test_a_motion_needs_html(shown):
    assert shown("solve", "swing.yaml", "--with-motion")[0] == 2
