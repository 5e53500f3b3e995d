"""Systems of which something false was once printed, or nothing, judged as the random ones are."""

from __future__ import annotations

import pytest

from .run import judged
from .system import System

M = {"m": "positive", "k": "positive", "g": "positive", "b": None}

MENDED = {
    "no radius at which exp(2 r) vanishes": System(
        coordinates={"r": "positive", "phi": None},
        parameters=M,
        L="m*r'^2/2 + m*exp(2*r)*phi'^2/2 - k*r^4",
        sections=("reduction", "steady_motions"),
    ),
    "y = b x and (1 + y^2) x' = sin(z) y' leave neither x' nor y', and p_y is 0 by them alone": System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2",
        constraints={"c1": "(1 + y^2)*x' = sin(z)*y'", "c2": "y = b*x"},
    ),
    "all that has mass is held: the energy is 0 by the constraint, and y has no motion": System(
        coordinates=dict.fromkeys("xy"),
        parameters={**M, "l": "positive"},
        T="m*(x'*cos(x) + y'*cos(y))^2/2",
        constraints={"c1": "sin(x) + sin(y) = l/9"},
    ),
    "a parallelogram whose third link has no mass": System(
        coordinates=dict.fromkeys("abc"),
        parameters=dict.fromkeys(("m", "l", "d", "g"), "positive"),
        points={
            "A": (["l*cos(a)", "l*sin(a)"], "m"),
            "B": (["l*cos(a) + d*cos(a + b)", "l*sin(a) + d*sin(a + b)"], "m"),
        },
        V="m*g*(2*l*sin(a) + d*sin(a + b))",
        constraints={
            "cx": "l*cos(a) + d*cos(a + b) - l*cos(c) = d",
            "cy": "l*sin(a) + d*sin(a + b) - l*sin(c) = 0",
        },
    ),
    "a driven chain whose last link has no mass: its constraints leave nothing with inertia free": System(
        coordinates=dict.fromkeys("abc"),
        parameters=dict.fromkeys(("m", "l", "d", "g", "w"), "positive"),
        points={"A": (["l*cos(a) + d*cos(a + b)", "l*sin(a) + d*sin(a + b)"], "m")},
        V="m*g*(l*sin(a) + d*sin(a + b))",
        constraints={
            "cx": "l*cos(a) + d*cos(a + b) + l*cos(a + b + c) = d",
            "cy": "l*sin(a) + d*sin(a + b) + l*sin(a + b + c) = 0",
            "motor": "a = w*t",
        },
    ),
    "y = a x twice: one multiplier is not determined": System(
        coordinates=dict.fromkeys("xy"),
        parameters={**M, "a": "positive"},
        T="m*(x'^2 + y'^2)/2",
        V="k*y",
        constraints={"c1": "y = a*x", "c2": "3*y - 3*a*x = 0"},
    ),
    "no circle at r = 0, and none is missing": System(
        coordinates={"r": "positive"},
        parameters={**M, "a": "positive", "w": "positive"},
        T="m*(r'^2*(1 + a^2*r^2) + r^2*w^2)/2",
        V="m*g*a*r^2/2",
        sections=("equilibria", "steady_motions"),
    ),
    "cos x = sin y has two branches, and x + y is constant on one": System(
        coordinates=dict.fromkeys("xy"),
        parameters=M,
        T="m*(x'^2 + y'^2)/2 + m*x'*y'/2",
        V="k*cos(y) + g*x",
        constraints={"c1": "cos(x) = sin(y)"},
    ),
    "x x' + y y' = 0 and x y' = y x' leave no velocity, and p of a rotation stays 0": System(
        coordinates=dict.fromkeys("xy"),
        parameters=M,
        T="m*(x'^2 + y'^2)/2 + m*x^2*y'^2/2",
        V="g*(x + y)",
        constraints={"c1": "x*x' + y*y' = 0", "c2": "x*y' = y*x'"},
        symmetries={"r": {"x": "-y", "y": "x"}},
        known={"conserved": {"r": True}},
    ),
    "|x| = y has no state at its corner; along x = -y nothing pushes": System(
        coordinates=dict.fromkeys("xy"),
        parameters=M,
        T="m*(x'^2 + y'^2)/2",
        V="g*(x - y)",
        constraints={"c1": "abs(x) = y"},
        symmetries={"s": {"x": "1", "y": "1"}},
        known={"conserved": {"s": True}},
    ),
    "two constraints of two factors, of rank 1 on x = z and of rank 2 elsewhere": System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2 + m*x^2*y'^2/2",
        constraints={"c1": "(x - z)*y = 0", "c2": "(z - b)*(z - x)*(x + 2*z) = 0"},
        symmetries={"s": {"x": "1", "y": "3"}},
    ),
    "x' + y' is all that L knows, and x + y = b t leaves no force": System(
        coordinates=dict.fromkeys("xy"),
        parameters=M,
        L="m*(x' + y')^2/2 - k*(x + y)^2/2",
        constraints={"c1": "x + y = b*t"},
    ),
    "|x| in V has no linear part at 0, and no frequency": System(
        coordinates=dict.fromkeys("xy"),
        parameters=M,
        L="m*(x'^2 + y'^2)/2 - (k*abs(x) + y^2) + b*(x*y' - y*x')",
        sections=("equilibria", "modes"),
        known={"search": True},
    ),
    "a gauge that is 0 where exp(x - y) = 1": System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2 + m*x^2*y'^2/2",
        constraints={"c1": "exp(x - y) = 1"},
        symmetries={"r": {"x": "-y", "y": "x"}},
    ),
    "y = z and y' = z z' leave nothing of y' + z', and its charge is 0": System(
        coordinates=dict.fromkeys("xyzu"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2 + u'^2)/2 + m*y^2*z'^2/2",
        V="k*y^2 + g*sin(y) + k*x*cos(t)",
        constraints={"c0": "(y - z)*(1 + y^2) = 0", "c1": "y' = z*z'"},
        symmetries={"s": {"y": "-2", "z": "-2"}, "r": {"y": "-z", "z": "y"}},
    ),
    "x^2 + y^2 = l^2 and y (x - a y) = 0 leave no motion of x and y": System(
        coordinates=dict.fromkeys("xyz"),
        parameters={**M, "l": "positive", "a": None},
        T="m*(x'^2 + y'^2 + z'^2)/2",
        V="k*(x^2 + 2*y^2)/2 + g*x",
        constraints={"c0": "x^2 + y^2 - l^2 = 0", "c1": "y*(x - a*y) = 0"},
        symmetries={"r": {"x": "-y", "y": "x"}, "s": {"x": "1", "y": "3"}},
    ),
    "a gauge with sqrt(1 + x^2 + y^2) is sought with an end": System(
        coordinates=dict.fromkeys("xy"),
        parameters=M,
        definitions={"X": "x + 2*y^3/3"},
        L="m*(X'^2 + y'^2)/2 - k/(X^2 + y^2) + 2*(x*x' + y*y')/sqrt(1 + x^2 + y^2)",
        symmetries={"s": {"x": "X - 2*y^3", "y": "y", "t": "2*t"}},
        sections=("charges",),
        known={"conserved": {"s": True}},
    ),
}


@pytest.mark.long
@pytest.mark.parametrize("name", MENDED)
def test_once_wrong(name: str) -> None:
    assert judged(MENDED[name]) == []


@pytest.mark.long
def test_a_corner_of_two_constraints_is_no_state() -> None:
    """z^2 = z y and sin(z) (z - 2 y) = 0 meet Newton's method where y and z are 0."""
    corner = System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2",
        V="k*z*y + g*sin(y)",
        constraints={"c0": "z^2 - z*y = 0", "c1": "sin(z)*(z - 2*y) = 0"},
    )
    assert [each for each in judged(corner) if each.verdict == "crash"] == []


@pytest.mark.long
@pytest.mark.parametrize("factor", ["exp(t)", "1 + b*t^2", "2 + cos(t)", "g*t"])
def test_one_coordinate_is_a_multiple_of_another_that_changes(factor: str) -> None:
    """y'/a is not x' where y = a(t) x."""
    tied = System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2",
        V="k*z*x + g*sin(x)",
        constraints={"c1": f"x*({factor}) = y"},
    )
    assert judged(tied) == []


@pytest.mark.long
@pytest.mark.parametrize("factor", ["m", "g", "3"])
@pytest.mark.parametrize(
    "turning", ["x*cos(k*t) + y*sin(k*t) = g", "x*exp(b*t) - y = m", "x^2 + y^2 = g"]
)
def test_a_constraint_is_given_again_in_a_sum(turning: str, factor: str) -> None:
    """Of f + c (z - b x) = 0, f = 0 and z = b x the two short ones are used."""
    left, right = turning.split(" = ")
    again = System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2",
        V="k/(1 + 2*z^2)",
        constraints={
            "c0": turning,
            "c1": f"({left} - {right}) + {factor}*(z - b*x) = 0",
            "c2": "z - b*x = 0",
        },
    )
    assert judged(again) == []


@pytest.mark.long
def test_a_rank_in_doubt_in_double_precision_hides_no_long_answer() -> None:
    """c1 is (1 + z^2) times c2, on which x^2 + y^2 = (k + b t)^2."""
    held = System(
        coordinates=dict.fromkeys("xyz"),
        parameters=M,
        T="m*(x'^2 + y'^2 + z'^2)/2",
        V="k*cos(z) + g*x",
        constraints={
            "c0": "z - x*y = 0",
            "c1": "(1 + z^2)*(x^2 + y^2 - (k + b*t)^2) = 0",
            "c2": "x^2 + y^2 - (k + b*t)^2 = 0",
        },
    )
    assert judged(held) == []
