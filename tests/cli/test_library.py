"""Problems by name, first problems from templates, formats by the ending of a file."""

from __future__ import annotations

import json
import re
import subprocess
import sys

import pytest

from lagcli.cli.run import run
from lagcli.library import NotInLibrary, entries, files_named, find_problem
from lagcli.pipeline import read
from lagcli.templates import TEMPLATES, template


@pytest.fixture
def shown(capsysbinary, tmp_path, monkeypatch):
    """Runs a command in an empty directory: exit status, standard output and error."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        status = run(arguments)
        streams = capsysbinary.readouterr()
        return status, streams.out.decode(), streams.err.decode()

    return call


def test_every_problem_is_found_by_its_folder_and_name():
    assert all(find_problem(entry.name) == entry.path for entry in entries())
    assert len(entries()) >= 251


def test_the_folders_of_the_library_are_found_as_in_the_repository(shown):
    assert files_named("problems/") == [str(entry.path) for entry in entries()]
    status, out, _ = shown("check", "problems/benchmarks")
    assert (status, out.splitlines()[-1].split(",")[0]) == (0, "1 problem")
    assert shown("check", "problems/none")[0] == 2


def test_a_problem_is_found_by_its_name_alone_unless_two_have_it():
    assert find_problem("kepler") == find_problem("problems/central/kepler.yaml")
    with pytest.raises(NotInLibrary, match="hamilton-jacobi/henon-heiles or particles/henon"):
        find_problem("henon-heiles")


@pytest.mark.long
@pytest.mark.parametrize("command", ["solve", "explain", "check"])
def test_commands_take_names_in_an_empty_directory(command, shown):
    assert shown(command, "atwood")[0] == 0


def test_a_file_of_that_name_comes_before_the_library(shown, tmp_path):
    (tmp_path / "kepler").write_text("coordinates: [x]\nT: x'^2/2\n")
    assert shown("solve", "kepler")[1].startswith("kepler\n")


def test_a_misspelled_name_is_answered_with_the_nearest(shown):
    status, _, told = shown("solve", "keppler")
    assert (status, "did you mean 'kepler'?" in told) == (2, True)


def test_a_missing_path_is_only_that(shown):
    assert shown("solve", "keppler.yaml")[2] == "keppler.yaml: error: no such file or directory\n"


def test_a_misspelled_path_is_answered_with_the_nearest_file_beside_it(shown, tmp_path):
    (tmp_path / "pendulum.yml").write_text("coordinates: [x]\nT: x'^2/2\n")
    for wrong in ("pendulum.yaml", "pendlum.yml", "Pendulum.yml"):
        told = shown("solve", str(tmp_path / wrong))[2]
        assert told.endswith(f"did you mean '{tmp_path / 'pendulum.yml'}'?\n")


def test_the_list_has_a_line_for_each_problem_with_the_words(shown):
    status, listed, _ = shown("list", "pendulum", "CONICAL")
    assert status == 0
    assert all("onical" in line and "endulum" in line.casefold() for line in listed.splitlines())
    assert shown("list", "no-such-word")[0] == 1


def test_a_problem_that_is_shown_can_be_solved(shown, tmp_path):
    _, text, _ = shown("show", "kepler")
    assert text.encode() == find_problem("kepler").read_bytes()
    assert shown("show", "nothing-like-it")[0] == 2


@pytest.mark.long
@pytest.mark.parametrize("name", TEMPLATES)
def test_a_template_is_a_problem_that_is_solved_and_simulated(name, shown):
    assert shown("new", f"my-{name}", "--template", name)[0] == 0
    assert shown("solve", f"my-{name}.yaml")[0::2] == (0, "")
    assert shown("simulate", f"my-{name}.yaml", "--samples", "2")[0::2] == (0, "")


@pytest.mark.parametrize("title", ["a: b", "it's", "{x}", "θ", "1 - ", "", "#"])
def test_any_title_makes_a_readable_file(title, shown, tmp_path):
    assert shown("new", f"{title}x")[0] == 0
    [path] = tmp_path.glob("*.yaml")
    assert read(path.name, path.read_bytes()).diagnostics == ()


def test_a_file_that_exists_is_not_overwritten(shown, tmp_path):
    shown("new", "swing")
    before = (tmp_path / "swing.yaml").read_bytes()
    assert shown("new", "swing", "-t", "driven")[0] == 2
    assert (tmp_path / "swing.yaml").read_bytes() == before


def test_an_unknown_template_is_answered_with_the_nearest(shown, tmp_path):
    status, _, told = shown("new", "x", "-t", "pendulm")
    assert (status, "did you mean 'pendulum'" in told, list(tmp_path.iterdir())) == (2, True, [])


def test_templates_have_units_throughout():
    for name in TEMPLATES:
        problem = read(name, template(name).replace("{title}", "x").encode()).problem
        assert all(one.unit for one in (*problem.coordinates, *problem.parameters))


ENDINGS = {"tex": "\\", "json": "{", "md": "# ", "html": "<", "txt": "Hoop"}


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_ending_of_the_output_chooses_the_format(ending, shown, tmp_path):
    assert shown("solve", "hoop", "--show", "momenta", "-o", f"out.{ending}")[0] == 0
    assert (tmp_path / f"out.{ending}").read_text().lstrip().startswith(ENDINGS[ending])


@pytest.mark.parametrize(
    "command",
    ["solve hoop", "explain hoop", "simulate hoop", "sweep hoop --vary x=1,2", "plot hoop",
     "animate hoop", "export hoop", "tradeoff hoop", "extremes hoop", "help solve", "schema"],
)  # fmt: skip
def test_an_ending_that_no_format_has_is_an_error_with_those_that_are_known(
    command, shown, tmp_path
):
    status, _, told = shown(*command.split(), "-o", "out.xyz")
    assert (status, list(tmp_path.iterdir())) == (2, [])
    assert re.search(r"'\.xyz' is not one of \.\w+", told)


@pytest.mark.parametrize(
    ("command", "begins"),
    [("help solve -o a.html", "<!DOCTYPE"), ("help -o a.1", ".TH LAGCLI"),
     ("export kepler -o a.jl", "# Kepler"), ("export kepler -o a.py", '"""Kepler')],
)  # fmt: skip
def test_the_manual_and_code_follow_the_ending(command, begins, shown, tmp_path):
    assert shown(*command.split())[0] == 0
    assert next(tmp_path.iterdir()).read_text().startswith(begins)


def test_code_needs_a_language(shown):
    status, _, told = shown("export", "kepler")
    assert (status, "--to: give one of python" in told) == (2, True)


@pytest.mark.parametrize(
    ("command", "requires"),
    [("solve hoop -f latex -o a.json", "json"), ("explain hoop -f text -o a.json", "json"),
     ("simulate kepler -f csv -o a.json", "json"), ("tradeoff kepler -f csv -o a.json", "json"),
     ("export kepler --to c -o a.jl", "julia"), ("help solve -f html -o a.md", "markdown")],
)  # fmt: skip
def test_an_ending_that_disagrees_with_the_format_is_an_error(command, requires, shown, tmp_path):
    status, _, told = shown(*command.split())
    assert (status, list(tmp_path.iterdir())) == (2, [])
    assert f"requires {requires}, but --" in told


def test_a_folder_is_solved_file_by_file(shown, tmp_path):
    for name in "ab":
        (tmp_path / f"{name}.yaml").write_text(f"title: {name}\ncoordinates: [x]\nT: x'^2/2\n")
    status, text, _ = shown("solve", ".", "--show", "momenta", "-f", "json")
    assert (status, [one["title"] for one in json.loads(text)]) == (0, ["a", "b"])


def test_several_runs_make_an_array_or_a_file_each(shown, tmp_path):
    run_both = ("simulate", "plane-pendulum", "kepler", "--until", "1", "--samples", "2")
    tables = json.loads(shown(*run_both, "-f", "json")[1])
    assert [table["columns"][1] for table in tables] == ["theta", "x"]
    assert shown(*run_both, "-f", "csv")[0] == 2
    (tmp_path / "runs").mkdir()
    assert shown(*run_both, "-f", "csv", "-o", "runs")[0] == 0
    assert sorted(path.name for path in (tmp_path / "runs").iterdir()) == [
        "kepler.csv", "plane-pendulum.csv",
    ]  # fmt: skip


@pytest.mark.long
def test_check_reads_standard_input():
    done = subprocess.run(
        [sys.executable, "-m", "lagcli", "check", "-"],
        input=find_problem("hoop").read_bytes(), capture_output=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout.startswith(b"passed  -  (")) == (0, True)


def test_the_version_is_an_option_and_a_command(shown):
    assert shown("--version") == shown("version")


def test_the_man_page_has_every_command_and_no_stray_request(shown):
    from lagcli.cli.app import COMMANDS

    _, page, _ = shown("help", "-f", "man")
    assert all(f".SS lagcli {name}\n" in page for name in COMMANDS)
    requests = {line.split()[0] for line in page.splitlines() if line.startswith((".", "'"))}
    assert requests <= {".TH", ".SH", ".SS", ".PP", ".TP", ".nf", ".fi", ".B"}


def test_the_wheel_carries_the_library():
    import tomllib
    from pathlib import Path

    settings = tomllib.loads((Path(__file__).parents[2] / "pyproject.toml").read_text())
    wheel = settings["tool"]["hatch"]["build"]["targets"]["wheel"]
    assert wheel["force-include"] == {"problems": "lagcli/problems"}
