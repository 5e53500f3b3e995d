"""`lagcli plot`: files that are the same each time, text that fits, sentences for what is wrong."""

import re
import sys
import zlib

import pytest

from lagcli.cli.run import run
from lagcli.formatters.display_width import display_width

PENDULUM = "problems/pendulums/plane-pendulum.yaml"
BALL = "problems/impact/bouncing-ball.yaml"
KEPLER = "problems/central/kepler.yaml"
KINDS = ["series", "phase", "path", "potential", "drift", "error"]


@pytest.fixture
def plot(capsysbinary):
    def call(*arguments):
        status = run(["plot", *map(str, arguments)])
        shown = capsysbinary.readouterr()
        return int(status), shown.out.decode(), shown.err.decode()

    return call


@pytest.mark.long
@pytest.mark.parametrize(
    ("kind", "ending"),
    [*((kind, "svg") for kind in KINDS), ("series", "pdf"), ("phase", "pdf"), ("series", "png")],
)
def test_the_same_picture_has_the_same_bytes(kind, ending, plot, tmp_path):
    files = [tmp_path / f"{name}.{ending}" for name in "ab"]
    for file in files:
        wanted = ("--kind", kind, "--until", 2, "--samples", 50)
        assert plot(PENDULUM, *wanted, "-o", file) == (0, "", "")
    first, second = (file.read_bytes() for file in files)
    assert first == second
    assert not re.search(rb"CreationDate|<dc:date>|tIME", first)


@pytest.mark.long
def test_a_pdf_has_its_fonts_and_an_svg_needs_none(plot, tmp_path):
    plot(PENDULUM, "-o", tmp_path / "a.pdf", "--until", 2)
    plot(PENDULUM, "-o", tmp_path / "a.svg", "--until", 2)
    assert b"/FontFile2" in (tmp_path / "a.pdf").read_bytes()
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert "<text" not in svg
    assert "font-family" not in svg


def test_a_dark_picture_has_a_dark_page(plot, tmp_path):
    plot(PENDULUM, "-o", tmp_path / "a.svg", "--until", 2, "--dark")
    svg = (tmp_path / "a.svg").read_text("utf-8")
    assert "#121212" in svg
    assert "#ffffff" not in svg


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("letters", [(), ("--ascii",)])
def test_a_picture_in_characters_fits(kind, letters, plot):
    status, shown, said = plot(PENDULUM, "--kind", kind, "--until", 5, *letters)
    assert (status, said) == (0, "")
    lines = shown.splitlines()
    assert max(map(display_width, lines)) <= 80
    assert len(lines) <= 45
    assert lines[0] == "Plane pendulum"
    assert "\x1b" not in shown
    assert shown.isascii() == bool(letters)
    assert any(0x2800 < ord(c) < 0x2900 for c in shown) == (not letters)


@pytest.mark.long
def test_without_an_end_the_portrait_is_drawn(plot, tmp_path):
    text = "coordinates: [x]\nT: x'^2/2\nV: x^4/4 - x^2/2\n"
    (tmp_path / "well.yaml").write_text(text)
    status, shown, _ = plot(tmp_path / "well.yaml")
    assert status == 0
    assert "separatrix" in shown
    assert "motion" not in shown
    status, _, said = plot(tmp_path / "well.yaml", "--kind", "series")
    assert status == 2
    assert "when does it end? give --until T" in said


def test_where_no_portrait_can_be_drawn_the_end_is_asked_for(plot, tmp_path):
    file = tmp_path / "spring.yaml"
    file.write_text("coordinates: [x, y]\nT: (x'^2 + y'^2)/2\nV: x^2 + y^2 + x*y\n")
    status, _, error = plot(file)
    assert status == 2
    assert "when does it end? give --until T, or simulation: {until: T}" in error
    assert "energy levels" not in error
    assert "energy levels" in plot(file, "--kind", "phase")[2]


def test_impacts_are_marked_and_break_the_velocity(plot):
    status, shown, _ = plot(BALL, "--until", 3, "--show", "y,y'")
    assert status == 0
    assert "floor: impact" in shown
    assert "floor: comes to rest" in shown


@pytest.mark.long
def test_the_end_of_the_certificate_is_drawn_and_nothing_beyond(plot, tmp_path):
    text = "coordinates: [x]\nT: x'^2/2\nL: \nV: x^3\ninitial: {x: -1}\n".replace("L: \n", "")
    (tmp_path / "fall.yaml").write_text(text)
    status, shown, said = plot(tmp_path / "fall.yaml", "--until", 10)
    assert status == 1
    assert "┃ end of the certificate" in shown
    assert "singularity" not in shown
    assert "-1e" not in shown.replace("\N{MINUS SIGN}", "-")  # 3e8 at the end would hide the rest
    status, _, said = plot(tmp_path / "fall.yaml", "--until", 10, "-o", tmp_path / "a.svg")
    assert status == 1
    assert said.count("\n") == 1  # no warning beside the reason
    assert "░" in shown
    assert "grows without bound" in said


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([PENDULUM, "--kind", "phases"], "--kind: unknown name 'phases': did you mean 'phase'?"),
        ([PENDULUM, "-o", "a.jpg"], "'.jpg' is not one of .svg, .pdf, .png"),
        ([PENDULUM, "-o", "picture"], "the ending says the form, one of .svg, .pdf, .png"),
        ([PENDULUM, "-o", "no/such/a.svg"], "there is no directory 'no/such'"),
        ([PENDULUM, "--show", "thet"], "did you mean 'theta'?"),
        ([PENDULUM, "--until", "soon"], "soon"),
        (["problems/hoop.yaml", "--kind", "path", "--until", "1"], "a path in space needs two"),
        ([PENDULUM, "--kind", "phase", "--show", "theta,theta',energy"], "and 3 are given"),
        ([KEPLER, "--kind", "phase"], "x, y are left"),
        ([KEPLER, "--kind", "poincare", "--section", "z"], "unknown name 'z'"),
        ([KEPLER, "--kind", "poincare", "--section", "x = "], "--section"),
        (["problems/pendulums/pendulum-with-rod.yaml", "--kind", "path", "--until", "1"], "points"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_is_a_sentence(arguments, sentence, plot):
    status, shown, said = plot(*arguments)
    assert (status, shown) == (2, "")
    assert sentence in said
    assert "Traceback" not in said


def test_without_matplotlib_the_extra_is_named(plot, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    status, _, said = plot(PENDULUM, "-o", "a.svg")
    assert status == 2
    assert (
        said == "lagcli: error: -o a.svg needs the package matplotlib: pip install 'lagcli[plot]'\n"
    )
    assert plot(PENDULUM, "--until", 1)[0] == 0


@pytest.mark.long
def test_a_title_is_never_a_formula(plot, tmp_path):
    text = 'title: "costs $5 and $6_x, 摆, \\u001b[31m"\ncoordinates: [x]\nT: x\'^2\nV: x^2\n'
    (tmp_path / "a.yaml").write_text(text, "utf-8")
    wanted = ("--until", 1, "--at", "x=1")
    assert plot(tmp_path / "a.yaml", *wanted, "-o", tmp_path / "a.png") == (0, "", "")
    status, shown, _ = plot(tmp_path / "a.yaml", *wanted)
    assert status == 0
    assert "\x1b" not in shown


def test_the_error_stays_below_the_bound_of_the_certificate():
    from lagcli import load
    from lagcli.numerics.hybrid.request import RunRequest
    from lagcli.pictures.drawing import Curve, Rule
    from lagcli.pictures.error import error
    from lagcli.pictures.run import short
    from lagcli.reader.columns import usual_columns

    problem = load(KEPLER)
    columns = tuple(usual_columns(problem))
    picture, _ = error(problem, RunRequest(until=30.0, accuracy=1e-7, samples=201, columns=columns))
    items = picture.panels[0].items
    largest = [i.pieces[-1][-1][1] for i in items if isinstance(i, Curve)]
    bound = min(i.at for i in items if isinstance(i, Rule) and i.of == "y")
    assert len(largest) == 4
    assert 1e-17 < max(largest) <= bound <= 1e-7, short(bound)


def test_streams_of_a_pdf_are_whole(plot, tmp_path):
    plot(PENDULUM, "-o", tmp_path / "a.pdf", "--until", 2)
    data = (tmp_path / "a.pdf").read_bytes()
    streams = re.findall(rb"/FlateDecode.*?stream\r?\n(.*?)\r?\nendstream", data, re.DOTALL)
    assert streams
    assert all(zlib.decompressobj().decompress(stream) for stream in streams)
