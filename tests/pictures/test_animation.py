"""`lagcli animate`: scenes of motions that are known, pages that need nothing else."""

import html.parser
import json
import math
import re
import shutil

import pytest

from lagcli import load
from lagcli.cli.run import run
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pictures.drawing import CannotDraw
from lagcli.pictures.page import to_html
from lagcli.pictures.scene import scene
from lagcli.problem_data import Scenery
from lagcli.reader.columns import Column
from lagcli.record import replace
from tests.pictures.problems import problem_of

DOUBLE = "problems/pendulums/double-pendulum.yaml"
BALL = "problems/impact/bouncing-ball.yaml"
SPHERE = "problems/contact/mass-sliding-off-sphere.yaml"
SPRING = """
coordinates: {x: {unit: m}}
parameters: {m: {unit: kg, value: 1}, k: {unit: N/m, value: 4}, F: {unit: N, value: 1}}
points: {cart: {position: [x, 0], mass: m, force: [-k*x/4, F]}}
V: k*x^2/2
initial: {x: 1}
"""


def made(problem, until=2.0, **wanted):
    asked = RunRequest(until=until, accuracy=1e-9, samples=41, columns=(Column("t", None),))
    return scene(problem, asked, **wanted)[0]


def links(found):
    return {(link.first, link.second, link.kind) for link in found.links}


class Elements(html.parser.HTMLParser):
    """The elements of a page with their attributes, and that each is closed."""

    VOID = frozenset(("meta", "input", "br", "link", "img"))

    def __init__(self):
        super().__init__()
        self.found, self.open = [], []

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_a_double_pendulum_has_a_rod_between_its_bobs():
    problem = load(DOUBLE)
    drawn = {("O", "bob1", "rod"), ("bob1", "bob2", "rod")}
    assert links(made(problem)) == drawn
    found = made(replace(problem, picture=Scenery()))
    assert links(found) == {("bob1", "bob2", "rod"), ("origin", "bob1", "line")}
    first, second = (body.places for body in found.bodies)
    lengths = [math.dist(p, q) for p, q in zip(first, second, strict=True)]
    assert max(lengths) - min(lengths) < 1e-9
    assert found.times[0] == 0
    assert found.times[-1] == 2


def test_points_that_move_together_are_not_joined():
    text = "coordinates: [x1, y1, x2, y2]\nT: x1'^2 + y1'^2 + x2'^2 + y2'^2\n"
    together = "initial: {x1: 0, x2: 1, x1': 1, x2': 1}\n"
    assert links(made(problem_of(text + together))) == set()
    assert [body.name for body in made(problem_of(text + together)).bodies] == ["x1, y1", "x2, y2"]


def test_the_picture_of_the_file_is_drawn():
    text = SPRING + "picture: {places: {wall: [-2, sin(t)]}, springs: [[wall, cart]], trails: []}\n"
    found = made(problem_of(text))
    assert links(found) == {("wall", "cart", "spring")}
    t = found.times[20]
    assert found.places["wall"][20] == pytest.approx((-2, math.sin(t)))
    assert found.bodies[0].places[20] == pytest.approx((math.cos(math.sqrt(5) * t), 0))
    assert not found.bodies[0].trail


def test_an_arrow_is_the_force_that_the_file_applies():
    found = made(problem_of(SPRING), forces=True)
    [arrow] = found.vectors
    places = found.bodies[0].places
    assert (arrow.name, arrow.on) == ("applied force", "cart")
    for force, place in zip(arrow.values, places, strict=True):
        assert force == pytest.approx((-place[0], 1))
    assert made(problem_of(SPRING)).vectors == ()


def test_an_arrow_is_the_force_of_the_constraint():
    problem = load("problems/pendulums/pendulum-cartesian.yaml")
    found = made(problem, until=1.0, forces=True)
    [arrow] = found.vectors
    values = {p.name: float(p.value.value) for p in problem.parameters}
    m, g, length = (values[name] for name in "mgl")
    (x0, y0), *_ = found.bodies[0].places
    for force, (x, y) in zip(arrow.values, found.bodies[0].places, strict=True):
        square = 2 * g * (y0 - y)  # from rest
        tension = m * (square - g * y) / length
        assert force == pytest.approx((-tension * x / length, -tension * y / length), abs=1e-7)
    assert x0 != 0


def test_the_surface_of_a_contact_is_where_its_gap_closes():
    found = made(load(SPHERE), until=0.5)
    points = [point for line in found.surfaces["surface"] for point in line]
    assert len(points) > 50
    assert all(math.hypot(*point) == pytest.approx(1) for point in points)
    floor = made(load(BALL), until=3.0)
    assert all(
        y == pytest.approx(0, abs=1e-12) for line in floor.surfaces["floor"] for _, y in line
    )
    assert len(floor.happenings) > 5
    assert not floor.closed["floor"][0]
    assert floor.closed["floor"][-1]


@pytest.mark.parametrize(
    "text",
    ["coordinates: [theta]\nT: theta'^2\nV: cos(theta)", "coordinates: [r, psi]\nT: r'^2 + psi'^2"],
)
def test_without_places_the_file_is_told_what_to_add(text):
    with pytest.raises(CannotDraw, match=r"no points; add them, for example points: \{P: \{pos"):
        made(problem_of(text))


@pytest.mark.long
@pytest.mark.parametrize("path", [DOUBLE, BALL, SPHERE, "problems/classics/particle-on-helix.yaml"])
def test_a_page_is_whole_and_needs_no_network(path, tmp_path, capsys):
    at = ["--until", "1", "--samples", "30"]
    given = {
        "m": "1", "g": "9.81", "R": "1", "a": "1", "b": "1", "h": "1", "k": "1", "c": "1",
    }  # fmt: skip
    names = [p.name for p in load(path).parameters if p.value is None]
    settings = [word for name in names for word in ("--set", f"{name}={given[name]}")]
    file = tmp_path / "a.html"
    assert run(["animate", path, *at, *settings, "-o", str(file)]) == 0
    assert capsys.readouterr().err == ""
    text = file.read_text("utf-8")
    page = Elements()
    page.feed(text)
    assert page.open == []
    assert all(not {"src", "href", "srcset"} & attributes.keys() for _, attributes in page.found)
    assert not re.search(r"@import|url\(|fetch\(|XMLHttp", text)
    assert "default-src 'none'" in text
    ids = {attributes["id"] for _, attributes in page.found if "id" in attributes}
    assert {"stage", "play", "time", "speed", "trails", "clock"} <= ids
    data = re.search(r'<script id="scene" type="application/json">(.*?)</script>', text, re.DOTALL)
    scene_data = json.loads(data[1])
    assert len(scene_data["bodies"][0]["places"]) == len(scene_data["times"])
    assert run(["animate", path, *at, *settings, "-o", str(tmp_path / "b.html")]) == 0
    assert (tmp_path / "b.html").read_bytes() == file.read_bytes()


def test_a_title_cannot_leave_its_element():
    title = "</script><script>alert(1)</script>"
    text = to_html(made(problem_of(f'title: "{title}"\n{SPRING}')))
    assert "<script>alert" not in text
    assert text.count("</script>") == 2


def test_impacts_that_read_alike_are_listed_once():
    page = to_html(made(load(BALL), until=4.0))
    listed = re.findall(r'data-t="[^"]+">(.*?)</button>', page)
    assert len(listed) == len(set(listed)) > 10
    assert re.search(r"And \d+ more", page)


def test_the_end_of_the_certificate_is_stated():
    text = "coordinates: [x]\nT: x'^2/2\nV: x^3\ninitial: {x: -1}\n"
    assert "The certificate ends at t = " in to_html(made(problem_of(text), until=10.0))
    assert "The certificate ends" not in to_html(made(problem_of(text), until=0.5))


@pytest.mark.long
@pytest.mark.parametrize("words", [(), ("--dark",)])
def test_a_gif_is_the_same_each_time(words, tmp_path):
    files = [tmp_path / f"{name}.gif" for name in "ab"]
    for file in files:
        wanted = ["--until", "0.2", "--samples", "20", *words]
        assert run(["animate", BALL, *wanted, "-o", str(file)]) == 0
    first, second = (file.read_bytes() for file in files)
    assert first.startswith(b"GIF89a")
    assert first == second


def test_without_ffmpeg_an_mp4_is_refused(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(shutil, "which", lambda _: None)
    assert run(["animate", BALL, "-o", str(tmp_path / "a.mp4")]) == 2
    assert "needs the program ffmpeg" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("picture", "sentence"),
    [
        ("{rods: [[cart, wal]], places: {wall: [0, 0]}}", "there is no point 'wal'"),
        ("{rods: [[cart]]}", "one of the rods joins 1 points, it joins two"),
        ("{rods: [cart]}", "one of the rods must be a list"),
        ("{springs: cart}", "springs must be a list"),
        ("{places: {wall: [0]}}", "the place 'wall' has 1 components, the points have 2"),
        ("{places: {cart: [0, 0]}}", "the place 'cart' has the name of a point"),
        ("{places: {wall: [x', 0]}}", "a position depends on coordinates and t only"),
        ("{trails: [x]}", "there is no point 'x'"),
        ("{rod: [[cart, cart]]}", "did you mean 'rods'?"),
    ],
)
def test_a_picture_that_cannot_be_meant_is_a_mistake_of_the_file(picture, sentence):
    from lagcli.pipeline import read

    found = read("a.yaml", f"{SPRING}picture: {picture}\n".encode())
    assert found.problem is None
    assert any(sentence in f"{d.message} {d.hint}" for d in found.diagnostics), found.diagnostics
    assert all(d.span.line > 1 for d in found.diagnostics)
