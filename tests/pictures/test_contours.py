"""Level lines of functions whose lines are known."""

import random
from math import hypot, isnan, nan

import pytest

from lagcli.pictures.contours import Contours, grid, quiet, roots


@pytest.mark.parametrize("seed", range(5))
def test_the_lines_of_a_random_ellipse_are_closed_and_exact(seed):
    random.seed(seed)
    a, b, x0, y0 = (random.uniform(0.5, 2) for _ in range(4))
    lines = Contours(
        lambda x, y: ((x - x0) / a) ** 2 + ((y - y0) / b) ** 2, grid(-3, 5, 60), grid(-3, 5, 47)
    )
    [line] = lines.at(1.0)
    assert line[0] == line[-1]
    assert all(abs(((x - x0) / a) ** 2 + ((y - y0) / b) ** 2 - 1) < 1e-12 for x, y in line)
    assert len(line) > 30


def test_lines_that_leave_the_rectangle_end_at_its_edges():
    lines = Contours(lambda x, y: x * y, grid(-1, 1, 40), grid(-1, 1, 40)).at(0.3)
    assert len(lines) == 2
    for line in lines:
        ends = [max(abs(x), abs(y)) for x, y in (line[0], line[-1])]
        assert ends == pytest.approx([1, 1])


def test_through_a_saddle_the_lines_do_not_stray():
    lines = Contours(lambda x, y: x * x - y * y, grid(-1, 1, 41), grid(-1, 1, 41)).at(0.0)
    points = [point for line in lines for point in line]
    assert all(abs(abs(x) - abs(y)) < 1e-9 for x, y in points)
    assert max(hypot(*p) for p in points) == pytest.approx(2**0.5)


def test_where_the_function_is_not_defined_there_is_no_line():
    f = quiet(lambda x, y: y * y - 1 / x)
    lines = Contours(f, grid(-1, 1, 41), grid(-3, 3, 41)).at(0.0)
    assert lines
    assert all(x > 0 for line in lines for x, _ in line)
    assert isnan(f(0.0, 1.0))


def test_roots_are_told_from_poles():
    assert roots(quiet(lambda x: 1 / x), grid(-1, 1, 10)) == []
    assert roots(lambda x: x - 0.3, grid(-1, 1, 10)) == pytest.approx([0.3], abs=1e-15)
    assert roots(lambda x: 0.3 - x, grid(-1, 1, 10)) == pytest.approx([0.3], abs=1e-15)
    assert roots(lambda _: nan, grid(-1, 1, 10)) == []
