"""One system in other coordinates: the same charges, algebra and verdict.

The charts are drawn at random: turned, stretched and moved axes, polar coordinates about another
axis, parabolic ones, a moved origin of time.  What is concluded belongs to the system (Arnold,
*Mathematical Methods of Classical Mechanics*, 2nd ed., section 12), so it does not change.
"""

import random
import zlib

import pytest

from lagcli.mechanics.discovery.summary import summary

from .derived import derive

POS = "{assume: positive}"
T = "m*(x'^2 + y'^2)/2"
R = "sqrt(x^2 + y^2)"
TRIPLES = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (-7, 24, 25)]

PLANE = {
    "free": T,
    "projectile": f"{T} - m*k*y",
    "Kepler": f"{T} + k/{R}",
    "Kepler and the inverse square": f"{T} + k/{R} - b/(x^2 + y^2)",
    "oscillator": f"{T} - k*(x^2 + y^2)/2",
    "two frequencies": f"{T} - k*x^2/2 - b*y^2/2",
    "magnetic field": f"{T} + b*(x*y' - y*x')/2",
    "inverse square": f"{T} - k/(x^2 + y^2)",
    "Stark": f"{T} + k/{R} + b*y",
    "of fourth degree": f"{T} - k*(x^2 + y^2)^2",
    "inverse square of one": f"{T} - k/x^2 - b*y^3",
    "oscillator and inverse square of one": f"{T} - m*k^2*x^2/2 - b/x^2 - m*y^4",
    "turning frame": "m*((x' - k*y)^2 + (y' + k*x)^2)/2",
    "Kepler in a turning frame": f"m*((x' - b*y)^2 + (y' + b*x)^2)/2 + k/{R}",
    "Kepler that fades": f"{T} + k/((1 + b*t)*{R})",
    "oscillator that fades": f"{T} - k*(x^2 + y^2)/(2*(1 + t)^4)",
}


def turned(source):
    """Axes that are turned, stretched, and one of them perhaps reflected."""
    a, b, c = source.choice(TRIPLES)
    p, q = source.randint(1, 5), source.randint(1, 5)
    sign = source.choice("+-")
    return "[u, v]", f"({a}*{p}*u - {b}*{q}*v)/{c}", f"{sign}({b}*{p}*u + {a}*{q}*v)/{c}"


def polar(source):
    """r and phi, counted from a random axis."""
    a, b, c = source.choice(TRIPLES)
    x, y = f"({a}*cos(phi) - {b}*sin(phi))/{c}", f"({b}*cos(phi) + {a}*sin(phi))/{c}"
    return f"{{r: {POS}, phi: {{}}}}", f"r*{x}", f"r*{y}"


def parabolic(source):
    """X = (u^2 - v^2)/2 and u v, either of them x."""
    factor = source.choice(["", "2*", "3*"])
    pair = [f"{factor}(u^2 - v^2)/2", f"{factor}u*v"]
    source.shuffle(pair)
    return (f"{{u: {POS}, v: {POS}}}", *pair)


def concluded(L, coordinates, x="", y=""):
    definitions = f", definitions: {{x: {x}, y: {y}}}" if x else ""
    parameters = ", ".join(f"{p}: {POS}" for p in "mkb")
    text = (f"{{coordinates: {coordinates}, parameters: {{{parameters}}}{definitions}, "
            f'L: "{L}"}}')  # fmt: skip
    discovery = derive(text).discovery
    assert discovery.stopped == []
    found = summary(discovery)
    return (len(discovery.charges), found.dimension, found.name, found.independent,
            found.in_involution, found.integrable)  # fmt: skip


def drawn(name, chart):
    return chart(random.Random(zlib.crc32(f"{name} {chart.__name__}".encode())))


@pytest.mark.long
@pytest.mark.parametrize("chart", [turned, polar, parabolic])
@pytest.mark.parametrize("name", PLANE)
def test_what_is_concluded_is_the_same_in_other_coordinates(name, chart):
    L = PLANE[name]
    assert concluded(L, *drawn(name, chart)) == concluded(L, "[x, y]")


@pytest.mark.long
@pytest.mark.parametrize("L", [
    "m*x'^2/2 - k*x^2/2 + b*x*cos(k*(t + 1/3))", "m*x'^2/2 + b*x*(t + 2)",
    "m*x'^2/2 - k*(x - b*(t - 5)^2)^2/2", "m*(t + 7)^2*x'^2/2",
    "x'^2/2 - 3*x^2/(32*(t + b)^2)",
])  # fmt: skip
def test_a_linear_equation_has_five_from_any_origin_of_time(L):
    number, dimension, name, *_ = concluded(L, "[x]")
    assert (number, dimension, name.split(":")[0]) == (5, 5, "Schrödinger sch(1)")


@pytest.mark.long
@pytest.mark.parametrize("L", ["m*x'^2/(2*x^2)", "m*x^2*x'^2/2 - k*x^4/8", "m*exp(2*x)*x'^2/2"])
def test_one_coordinate_is_flat_with_any_inertia(L):
    number, dimension, name, *_ = concluded(L, f"{{x: {POS}}}")
    assert (number, dimension, name.split(":")[0]) == (5, 5, "Schrödinger sch(1)")
