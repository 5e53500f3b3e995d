"""Every problem of the library that has numbers is drawn, without a warning."""

import pytest

from lagcli import load
from lagcli.formatters.display_width import display_width
from lagcli.library import entries
from lagcli.numerics.equations.parameter_formulas import numbers_of
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.pictures.drawing import CannotDraw
from lagcli.pictures.figure import to_bytes
from lagcli.pictures.kinds import PictureRequest, picture_of
from lagcli.pictures.page import to_html
from lagcli.pictures.scene import scene
from lagcli.pictures.terminal import Terminal, to_text
from lagcli.pipeline import with_lagrangian
from lagcli.problem_data import METHODS
from lagcli.reader.columns import usual_columns
from tests.marks import one_of

KINDS = ("series", "phase", "path", "potential", "poincare", "drift", "error")
#: Impacts, friction, rods, charges, constraints.
SAMPLE = ("bouncing-ball", "damped-oscillator", "double-pendulum", "kepler", "hoop")
_END = 3.0


def with_numbers():
    for entry in entries():
        text = entry.path.read_text("utf-8")
        if "\nsimulation:" in text or "\ninitial:" in text:
            yield entry


def drawn(path, *, written):
    """The kinds that were drawn; None where a parameter has no number."""
    problem = with_lagrangian(load(path))
    if any(parameter.value is None for parameter in problem.parameters):
        return None
    end = problem.simulation.until
    until = _END if end is None else numbers_of(problem, [end])[0][0]
    columns = tuple(usual_columns(problem))
    method = problem.simulation.method or "auto"
    assert method in METHODS
    asked = RunRequest(until=until, accuracy=1e-6, samples=101, columns=columns, method=method)
    made = []
    for kind in KINDS:
        try:
            picture, _ = picture_of(problem, asked, PictureRequest(kind=kind))
        except (CannotDraw, Refusal):
            continue
        made.append(kind)
        look(picture, written=written)
    try:
        page = to_html(scene(problem, asked)[0])
    except (CannotDraw, Refusal):
        return made
    assert "NaN" not in page
    return [*made, "animation"]


def look(picture, *, written):
    for unicode in (True, False):
        text = to_text(picture, Terminal(width=80, unicode=unicode))
        assert max(map(display_width, text.splitlines())) <= 80
        assert unicode or text.isascii()
    if written:
        assert to_bytes(picture, "svg").startswith(b"<?xml")


@pytest.mark.long
@pytest.mark.parametrize("name", SAMPLE)
def test_a_sample_of_the_library_is_drawn(name):
    entry = next(e for e in entries() if e.path.stem == name)
    assert "series" in drawn(entry.path, written=name == "hoop")


@pytest.mark.parametrize("entry", one_of(3, with_numbers()), ids=lambda entry: entry.name)
def test_every_problem_with_a_run_is_drawn(entry):
    made = drawn(entry.path, written=True)
    assert made is None or "series" in made or "phase" in made
