"""What a course sets: rings of equal springs, two angles, gauges of a field, passing ranks."""

from __future__ import annotations

from itertools import combinations
from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import kinetic, parameters


def equal_springs(rng: Random) -> System:
    """Equal masses in a ring or each bound to each: degenerate frequencies, zero ones too."""
    names = "xyzu"[: rng.randint(3, 4)]
    ring = list(zip(names, names[1:] + names[0], strict=True))
    pairs = rng.choice([ring, list(combinations(names, 2))])
    own, between = rng.randint(0, 2), rng.randint(1, 4)
    springs = [f"{between}*k*({a} - {b})^2/2" for a, b in pairs]
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k"),
        T=kinetic(names),
        V=" + ".join([*springs, *(f"{own}*k*{a}^2/2" for a in names if own)]),
        sections=("equilibria", "modes"),
    )


def two_angles(rng: Random) -> System:
    """All places of rest of a trigonometric polynomial in two angles."""
    a, b, c = (rng.choice((-1, 1)) * rng.randint(1, 4) for _ in range(3))
    coupling = rng.choice(["cos(x - y)", "cos(x)*cos(y)", "sin(x)*sin(y)", "sin(x - y)"])
    return System(
        coordinates=dict.fromkeys("xy"),
        parameters=parameters("m", "g"),
        T=kinetic("xy"),
        V=f"g*(({a})*cos(x) + ({b})*cos(y) + ({c})*{coupling})",
        sections=("equilibria",),
        known={"search": True},
    )


def field_gauges(rng: Random) -> System:
    """A charge in magnetic fields, in one of several gauges, and what may be conserved."""
    field = rng.choice(
        ["x*y'", "-y*x'", "(x*y' - y*x')/2 + t*z' + z", "(x + sin(x))*y'", "t*x*y'",
         "(x^2 + y^2)*(x*y' - y*x')/4"]
    )  # fmt: skip
    V = rng.choice(["0", "q*g*x", "q*g*y*t", "k*(x^2 + y^2)/2", "k*z^2/2 - q*g*y"])
    return System(
        coordinates=dict.fromkeys("xyz"),
        parameters=parameters("m", "k", "g", "q", free=("b",)),
        L=f"{kinetic('xyz')} + q*b*({field}) - ({V})",
        symmetries={
            **{f"along_{name}": {name: "1"} for name in "xyz"},
            "turn": {"x": "-y", "y": "x"},
            "later": {"t": "1"},
            "boost": {"z": "t"},
        },
        sections=MAIN + CANONICAL,
    )


def passing_ranks(rng: Random) -> System:
    """Three constraints, one of which the others imply, everywhere or at a place alone."""
    a = rng.randint(1, 4)
    three = rng.choice(
        [("x^2 + y^2 = l^2", f"z = {a}*x", f"z^2 + {a**2}*y^2 = {a**2}*l^2"),
         ("x = y", "z = u", "x*z = y*u"), ("x*y = l^2", "u = 0", "z*(1 + u^2) = x*y"),
         ("x + y + z = l", f"z = {a}*u", f"x + y + {a}*u = l")]
    )  # fmt: skip
    return System(
        coordinates=dict.fromkeys("xyzu"),
        parameters=parameters("m", "k", "g", "l"),
        T=kinetic("xyzu"),
        V=rng.choice(["g*z", "k*x*u", "k*(x^2 + z^2)/2 + g*y"]),
        constraints=dict(zip(("c1", "c2", "c3"), three, strict=True)),
    )


KINDS = {each.__name__: each for each in (equal_springs, two_angles, field_gauges, passing_ranks)}
