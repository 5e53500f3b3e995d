"""Symmetries as transformations: a continuous one is told its change, a discrete one has none."""

from __future__ import annotations

import random
import re

import pytest

from tests.reader.test_habits import messages, text

FILE = {
    "coordinates": "[x, y]",
    "parameters": "{m: 1, k: 2}",
    "T": "m*(x'^2 + y'^2)/2",
    "V": "k*(x^2 + y^2)/2",
}
DISCRETE = ["x {} -x", "x {} -x, y {} -y", "y {} 1 - y", "x {} y, y {} x", "t {} -t", "x {} k - x"]
#: Transformations with a parameter, and their changes per unit of it.
CONTINUOUS = [
    ("x {} x + eps", "{x: 1}"),
    ("x {} x - eps*y, y {} y + eps*x", "{x: -y, y: x}"),
    ("t {} t + a", "{t: 1}"),
    ("x {} x + v*t", "{x: t}"),
    ("x {} x*cos(a) - y*sin(a), y {} x*sin(a) + y*cos(a)", "{x: -y, y: x}"),
]
SHAPES = ["{{name: {}}}", "{{name: {{{}}}}}", "{{name: [{}]}}", "{{name: '{}'}}", "\n  name: {}",
          "[{}]", "{{{}}}", "{}"]  # fmt: skip


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("given", DISCRETE)
def test_a_transformation_without_a_parameter_has_no_charge(shape, given):
    arrow = random.Random(given + shape).choice(["->", "→", "=>"])
    written = shape.format(given.replace("{}", arrow))
    [found] = messages(text(**FILE, symmetries=written))
    assert found.endswith("leave it out: conserved quantities belong to continuous symmetries")


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("given", "change"), CONTINUOUS)
def test_a_transformation_with_a_parameter_is_told_its_change(shape, given, change):
    arrow = random.Random(given + shape).choice(["->", "→", "=>"])
    written = shape.format(given.replace("{}", arrow))
    [found] = messages(text(**FILE, symmetries=written))
    assert change in found.partition("; write ")[2]


@pytest.mark.parametrize("word", ["mirror", "Reflection", "parity", "inversion"])
@pytest.mark.parametrize("shape", ["{}", "[{}]", "{{{}: yes}}", "{{{}: x}}"])
def test_a_reflection_in_a_word_has_no_charge(word, shape):
    [found] = messages(text(**FILE, symmetries=shape.format(word)))
    assert "continuous symmetries" in found


def test_pairs_of_coordinates_are_read_as_their_transformations():
    [found] = messages(text(**FILE, symmetries="{p: '(x, y) -> (-x, -y)'}"))
    assert "continuous symmetries" in found
    [found] = messages(text(**FILE, symmetries="{p: '(x, y) -> (x + s*y, y - s*x)'}"))
    assert found.endswith("write {x: y, y: -x}")


@pytest.mark.parametrize("symmetry", ["boost: {x: t}", "rise: {x: t, y: 2*t}"])
@pytest.mark.parametrize("gauge", ["m*x", "2*m*y + k"])
def test_a_gauge_beside_its_symmetry_belongs_in_it(symmetry, gauge):
    [found] = messages(text(**FILE, symmetries=f"{{{symmetry}, gauge: {gauge}}}"))
    right = f"{symmetry[:-1]}, gauge: {gauge}}}"
    assert found.endswith(f"leave it out, and write {right}")
    assert messages(text(**FILE, symmetries=f"{{{right}}}")) == []


@pytest.mark.parametrize("step", ["k", "- k", "m*k", "- 2*k + m", "1"])
@pytest.mark.parametrize("name", ["x", "y", "t"])
def test_the_change_is_not_the_new_place(name, step):
    sign = "" if step[0] == "-" else "+ "
    [found] = messages(text(**FILE, symmetries=f"{{shift: {{{name}: {name} {sign}{step}}}}}"))
    assert f"; write {step.replace('- ', '-', 1)}: a symmetry has the change" in found


@pytest.mark.parametrize("change", ["{x: x}", "{x: x + y}", "{x: 2*x + k}", "{x: k}", "{x: y - k}"])
def test_other_changes_are_read(change):
    assert messages(text(**FILE, symmetries=f"{{name: {change}}}")) == []


PARTIALS = ["d/d{}", "∂_{}", "∂/∂{}", "d_{}", "∂{}", "(d/d{})"]
#: Generators, of which the partial derivatives are drawn, and their changes.
GENERATORS = [
    ("x*<y> - y*<x>", "{x: -y, y: x}"),
    ("-y*<x> + x*<y>", "{x: -y, y: x}"),
    ("y <x> - x <y>", "{x: y, y: -x}"),
    ("<x> + <y>", "{x: 1, y: 1}"),
    ("-2*(x + y)*<x>", "{x: -2*(x + y)}"),
    ("k*<t> + m*x*<x> - y*<x>", "{t: k, x: m*x - y}"),
]


@pytest.mark.parametrize("partial", PARTIALS)
@pytest.mark.parametrize(("given", "change"), GENERATORS)
def test_a_generator_is_told_by_its_components(partial, given, change):
    written = re.sub("<(.)>", lambda found: partial.format(found[1]), given)
    [found] = messages(text(**FILE, symmetries=f"{{rotation: {written}}}"))
    assert found.endswith(f"; write {change}")
    assert messages(text(**FILE, symmetries=f"{{rotation: {change}}}")) == []
    for shape in ("[{}]", "{}"):
        [found] = messages(text(**FILE, symmetries=shape.format(written)))
        assert found.endswith(f"{{shift: {change}}}")


def test_a_parameter_is_not_a_derivative():
    file = FILE | {"parameters": "{m: 1, k: 2, d_x: 1}"}
    [found] = messages(text(**file, symmetries="{rotation: y*d_x}"))
    assert found.endswith("as in {x: -y, y: x}")


@pytest.mark.parametrize("given", ["x*y", "x^2 + y", "y*d/dz", "x*d/dx*d/dy", "(x + y)/2"])
def test_no_other_symmetry_is_proposed_for_a_formula(given):
    [found] = messages(text(**FILE, symmetries=f"{{rotation: {given}}}"))
    assert found.endswith("; write coordinate: change, as in {x: -y, y: x}")
    [found] = messages(text(**FILE, symmetries=f"[{given}]"))
    assert found.endswith("write name: {coordinate: change}, as in rotation: {x: -y, y: x}")


@pytest.mark.parametrize(
    "names", [("x1", "x2"), ("x_a", "x_b", "x_c"), ("phi1", "phi2"), ("q1", "q2")]
)
@pytest.mark.parametrize(
    "shape", ["{}", "[{}]", "{{{}: yes}}", "{{{}: }}", "{{{}: {{}}}}", "{{{}: [{names}]}}"]
)
def test_a_translation_moves_all_bodies(names, shape):
    listed = ", ".join(names)
    squares = " + ".join(f"m*{x}'^2/2" for x in names)
    file = {"coordinates": f"[{listed}]", "T": squares, "V": f"k*({names[0]} - {names[1]})^2/2"}
    word = "rotation" if names[0] == "phi1" else "translation"
    given = shape.format(word, names=listed)
    [found] = messages(text(**FILE | file, symmetries=given))
    assert found.endswith(f"{{{', '.join(f'{x}: 1' for x in names)}}}{'}' * (':' not in given)}")


@pytest.mark.parametrize("word", ["translation", "boost"])
def test_a_translation_is_along_one_axis(word):
    file = FILE | {
        "V": "k*(x1 - x2)^2",
        "coordinates": "[x1, y1, x2, y2]",
        "T": "m*(x1'^2 + y1'^2 + x2'^2 + y2'^2)/2",
    }
    change = "t" if word == "boost" else "1"
    [found] = messages(text(**file, symmetries=f"[{word}]"))
    assert found.endswith(f"write {{{word}: {{x1: {change}, x2: {change}}}}}")


def test_a_matrix_is_not_read_as_a_list_of_changes():
    [found] = messages(text(**FILE, symmetries="{rotation: [[0, -1], [1, 0]]}"))
    assert found.endswith("write {x: -y, y: x}")
    [found] = messages(text(**FILE, symmetries="{squeeze: [[0, 1], [1, 0]]}"))
    assert found.endswith("write coordinate: change, as in {x: -y, y: x}")
