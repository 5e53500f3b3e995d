"""Angles in degrees are warned of where they stand as radians; numbers of radians are not."""

import random

import pytest

from lagcli.reader import read_problem

FILE = """coordinates: [s, theta]
parameters: {{m: 1, g: 9.81, l: 2, alpha: {alpha}, k: 45}}
T: m*(s'^2 + l^2*theta'^2)/2
V: m*g*s*{slope} - m*g*l*cos(theta - alpha) + k*s^2/2
initial: {{theta: {theta}, s: 30}}
"""


def warned(alpha="0.5", slope="sin(0.5)", theta="1"):
    text = FILE.format(alpha=alpha, slope=slope, theta=theta)
    found = read_problem("p.yaml", text.encode()).diagnostics
    assert not any(each.is_error for each in found)
    return [(each.span.line, each.hint) for each in found]


@pytest.mark.parametrize("seed", range(6))
def test_degrees_are_named_where_they_stand(seed):
    draw = random.Random(seed)
    n = draw.choice([15, 20, 30, 45, 60, 90, 120, 180])
    wave = draw.choice(["sin", "cos", "tan"])
    hint = f"angles are in radians: write {n}*pi/180"
    assert warned(alpha=n) == [(2, hint)]
    assert warned(theta=-n) == [(5, hint.replace("write ", "write -"))]
    assert warned(slope=f"{wave}({n})") == [(4, hint.replace(f"{n}*pi/180", f"{wave}({n}*pi/180)"))]
    assert warned(alpha=f"{n}*pi/180", theta=f"{n}*pi/180", slope=f"{wave}({n}*pi/180)") == []


@pytest.mark.parametrize("number", ["0.5", "6.28", "3", "100*pi", "12.345", "k/100"])
def test_radians_are_taken_as_they_are(number):
    assert warned(alpha=number, theta=number, slope=f"sin({number})") == []
