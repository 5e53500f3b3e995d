"""What the README and the manual show is what happens."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from lagcli.cli.app import COMMANDS, load_command
from lagcli.manual import ORDER, find_page, pages
from lagcli.pipeline import read
from tests.cli.transcript import answer

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
EXTENDING = ROOT / "lagcli" / "manual" / "extending.md"
PAGES = [README, *sorted((ROOT / "lagcli" / "manual").glob("*.md"))]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


LINK = re.compile(r"\]\((?!https?:)([^)#]+)(?:#[^)]*)?\)")


def blocks(language, page=README):
    return [body for name, body in BLOCK.findall(page.read_text("utf-8")) if name == language]


@pytest.fixture
def at_home(monkeypatch):
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("COLUMNS", "80")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_answer_as_shown(page, at_home, capsysbinary):
    text = page.read_text("utf-8")
    found = text
    for block in blocks("console", page):
        commands = re.findall(r"^\$ (.*)$", block, re.MULTILINE)
        shown = "\n\n".join(f"$ {c}\n{answer(c, capsysbinary)}".strip() for c in commands)
        found = found.replace(f"```console\n{block}```", f"```console\n{shown}\n```")
    if os.environ.get("LAGCLI_UPDATE"):
        page.write_text(found, "utf-8")
    assert found == text


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_links_lead_to_pages(page):
    missing = [
        to for to in LINK.findall(page.read_text("utf-8")) if not (page.parent / to).exists()
    ]
    assert missing == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_problems_of_a_page_are_problems(page):
    for body in blocks("yaml", page):
        if body.startswith("title:"):
            assert read(page.name, body.encode()).diagnostics == ()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_lines_of_python_run(page, at_home, capsys):
    for body in blocks("python", page):
        if "import lagcli" in body:
            exec(body, {})
            assert capsys.readouterr().out


def table_of(page, head, rows):
    """The table below a head in a page of the manual, which is made of declarations."""
    path = ROOT / "lagcli" / "manual" / page
    text = path.read_text("utf-8")
    above, below, shown = re.search(rf"({head}.*\n)(\| --- .*\n)((?:\|.*\n)*)", text).groups()
    if os.environ.get("LAGCLI_UPDATE"):
        path.write_text(text.replace(above + below + shown, above + below + rows), "utf-8")
    return shown


def test_the_methods_are_listed_as_they_declare_themselves():
    from lagcli.numerics.certified.methods import METHODS

    rows = "".join(f"| `{each.name}` | {each.reason} |\n" for each in METHODS.values())
    assert table_of("simulate.md", r"\| method \|", rows) == rows


def test_the_sections_are_listed_as_their_modules_describe_them():
    from lagcli.statements.declaration import never
    from lagcli.statements.registry import built_in

    def row(each):
        summary = import_module(f"lagcli.sections.{each.name}").__doc__.splitlines()[0]
        dot = "" if each.by_default is never else "· "
        return f"| {dot}| `{each.name}` | {summary.removesuffix('.')} |\n"

    rows = "".join(map(row, built_in()))
    assert table_of("solve.md", r"\| \| section \|", rows) == rows


def test_every_page_of_the_manual_is_found_by_its_name_and_topics():
    for page in pages():
        assert find_page(page.name) == page
        assert all(find_page(topic) is not None for topic in page.topics)
    assert {page.name for page in pages()} == set(ORDER)
    assert f"({Path('lagcli/manual')}/" in README.read_text("utf-8")


def test_every_command_section_and_key_has_a_page():
    from lagcli.reader.habits import KEYS
    from lagcli.statements.registry import built_in

    text = "".join(page.text for page in pages())
    assert [
        name for name in (*(each.name for each in built_in()), *KEYS) if f"`{name}`" not in text
    ] == []
    assert [name for name in COMMANDS if f"lagcli {name}" not in text] == []


def test_every_option_has_a_place_in_the_manual():
    text = README.read_text("utf-8") + "".join(page.text for page in pages())
    options = {word for name in COMMANDS for p in load_command(name).params for word in p.opts}
    assert sorted(word for word in options if word.startswith("--") and word not in text) == []


def test_the_readme_is_short():
    assert len(README.read_bytes()) <= 8192


def install(name, group, folder):
    """A package like the manual's, as an installer leaves it."""
    code = next(body for body in blocks("python", EXTENDING) if body.startswith(f'"""{name}.py'))
    declared = next(body for body in blocks("toml", EXTENDING) if group in body)
    (folder / f"{name}.py").write_text(code, "utf-8")
    info = folder / f"lagcli_{name}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: lagcli-{name}\nVersion: 1.0\n")
    points = declared.replace(f'project.entry-points."{group}"', group)
    (info / "entry_points.txt").write_text(points.replace('"', ""))


@pytest.fixture
def plug_in(tmp_path):
    install("charges", "lagcli.formatters", tmp_path)
    environment = {**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}

    def run(*arguments):
        return subprocess.run(
            [sys.executable, "-m", "lagcli", *arguments],
            cwd=ROOT, env=environment, capture_output=True, text=True, check=False,
        )  # fmt: skip

    return run


@pytest.mark.long
def test_the_formatter_of_another_package_is_listed_and_used(plug_in):
    listed = plug_in("formats").stdout.splitlines()
    assert "charges   The names of the conserved charges. (from lagcli-charges)" in listed
    solved = plug_in("solve", "problems/hoop.yaml", "--show", "charges", "-f", "charges")
    assert solved.stderr == ""
    assert solved.stdout == (
        "Hoop rolling down an incline: slide\nHoop rolling down an incline: energy\n"
    )
