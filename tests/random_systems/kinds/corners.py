"""Corners: constraints that degenerate, odd candidates, powers and functions, attributes, flat rest."""

from __future__ import annotations

import itertools
from random import Random

from tests.random_systems.system import CANONICAL, MAIN, REST, System

from .draw import kinetic, parameters, potential


def corner_constraints(rng: Random) -> System:
    """Repeated, fixing, piecewise, dependent on parameters, with a rank that changes."""
    constraints, valid = rng.choice(
        [
            (["(x - y)^3 = 0"], None),
            (["(x - a*y)^2 = 0"], None),
            (["x^2 = l^2"], True),
            (["x^4 = y^4"], True),
            (["abs(x) = y"], True),
            (["sqrt(x^2 + y^2) = abs(x) + l/2"], True),
            (["x = l", "y = b*t^2"], True),
            (["a*x + b*y = l", "b*x + a*y = 0"], True),
            (["x' = a*y' + b", "y' = w"], True),
            (["x = l", "x = 2*l"], False),
            (["x = w*t", "x = 2*w*t"], False),
            (["x' = w", "x = l"], False),
            (["x^2 + y^2 = l^2", "x = 2*l"], False),
            (["x^2 + y^2 = l^2", "x = l/2"], True),
            (["x^2 + y^2 = l^2", "x*y = 0"], True),
            (["x^2 + y^2 + l^2 = 0"], False),
            (["exp(x - y) = 1"], True),
            (["log(x^2) = log(y^2)"], True),
            (["atan2(y, x) = 1/2"], True),
            (["x/y = a"], True),
            (["(x - y)/(x + y) = b"], True),
            (["sin(x + y) = 1/2"], True),
            (["cos(x) = sin(y)"], True),
            (["x*x' + y*y' = 0", "x*y' = y*x'"], True),
            (["x' + y' = 0", "x - y = l"], True),
            (["sin(x)*x' = sin(y)*y'"], True),
            (["(x^2 + y^2)*(x' - y') = 0"], True),
            (["y'*x^2 = 0"], True),
            (["x*y*(x' - 2*y') = 0"], True),
            (["x^2*y = x*y^2"], True),
            (["max_*x = y"], True),
            (["x^2 + y^2 = l^2", "x' = -w*y"], True),
            (["tan(x) = tan(y)"], True),
            (["x*y' - y*x' = (x^2 + y^2)*w"], True),
        ]
    )
    extra = rng.random() < 0.4
    names = ("x", "y", "z") if extra else ("x", "y")
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", "w", "max_", free=("a", "b")),
        T=rng.choice(
            [kinetic(names), kinetic(names) + " + m*x'*y'/2", kinetic(names) + " + m*x^2*y'^2/2"]
        ),
        V=potential(rng, names),
        constraints={f"c{i}": text for i, text in enumerate(constraints)},
        symmetries={"r": {"x": "-y", "y": "x"}, "s": {"x": "1", "y": "1"}},
    )
    if valid is False:
        made.known["valid"] = False
    return made


def corner_symmetries(rng: Random) -> System:
    """Velocities in the candidate, Delta t, gauges that are given, right or wrong."""
    L, change, conserved = rng.choice(
        [
            ("m*x'^2/2 - k*x^2/2", {"x": "x'"}, True),
            ("m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2", {"x": "y'", "y": "x'"}, True),
            ("m*(x'^2 + y'^2)/2 + k/sqrt(x^2 + y^2)", {"x": "-y*y'", "y": "2*x*y' - y*x'"}, True),
            ("m*(x'^2 + y'^2)/2 + k/sqrt(x^2 + y^2)", {"x": "-y*y'", "y": "x*y' - y*x'"}, False),
            ("m*x'^2/2", {"t": "t^2", "x": "t*x"}, True),
            ("m*x'^2/2 - k/x^2", {"t": "t^2", "x": "t*x"}, True),
            ("m*x'^2/2 - k/x^3", {"t": "t^2", "x": "t*x"}, False),
            ("m*x'^2/2 - m*g*x", {"x": "t", "gauge": "m*x - m*g*t^2/2"}, True),
            ("m*x'^2/2 - m*g*x", {"x": "t", "gauge": "m*x + m*g*t^2/2"}, False),
            ("m*x'^2/2 - m*g*x", {"x": "1", "gauge": "-m*g*t"}, True),
            ("m*x'^2/2 - m*g*x", {"x": "1", "gauge": "m*g*t"}, False),
            ("exp(b*t)*m*x'^2/2", {"x": "exp(-b*t)"}, None),
            ("m*x'^2/2 - k*x^2/2 + a*x*cos(w*t)", {"x": "cos(sqrt(k/m)*t)"}, True),
            ("-m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2)", {"t": "x/c^2", "x": "t"}, True),
            ("-m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2)", {"t": "x/c", "x": "t"}, False),
            ("m*x'^2/2 + a*x'*cosh(x)*y + a*sinh(x)*y'", {"y": "1"}, None),
            ("m*(x'^2 + y'^2)/2 + a*(x*y' - y*x')", {"x": "1"}, True),
            ("m*(x'^2 + y'^2)/2 + a*x^2*y'", {"x": "1"}, False),
            ("m*(x'^2 + y'^2)/2 + a*x^2*y'", {"y": "1"}, True),
            ("m*x'^2/(2*x^2) - k*log(x^2)", {"x": "x"}, True),
            ("m*x'^2*y'/2", {"t": "2*t", "x": "x"}, None),
            ("m*(x'^2 + y'^2)/2 - k*(x - y - w*t)^2/2", {"x": "w", "t": "1"}, True),
            ("m*(x'^2 + y'^2)/2 - k*(x - y - w*t)^2/2", {"y": "w", "t": "1"}, False),
            ("m*(x'^2 + y'^2)/2 - k*x*cos(w*t) - k*y*sin(w*t)", {"x": "-w*y", "y": "w*x", "t": "1"}, True),
            ("m*(x'^2 + y'^2)/2 - k*x*cos(w*t) + k*y*sin(w*t)", {"x": "-w*y", "y": "w*x", "t": "1"}, False),
            ("m*t^2*x'^2/2 - m*t^2*x^6/6", {"t": "t", "x": "-x/2"}, True),
            ("m*x'^2/2 + x'*exp(-x^2)/(1 + x^4)", {"x": "1"}, True),
            ("m*(x'^2 + y'^2)/2 + (x*y' - y*x')/(x^2 + y^2)", {"x": "1"}, True),
            ("m*(x'^2 + y'^2)/2 + x'*exp(x*y)*y + y'*x*exp(x*y)", {"x": "sin(y)", "y": "0*x"}, False),
        ]
    )  # fmt: skip
    names = ("x", "y") if "y" in L else ("x",)
    made = System(
        coordinates={name: "positive" if name == "x" and "/x" in L else None for name in names},
        parameters=parameters("m", "k", "g", "w", "c", free=("a", "b")),
        L=L,
        symmetries={"s": change},
        sections=MAIN,
        known={"slow": 0.2 if "sqrt(1 -" in L else 1},
    )
    if conserved is not None:
        made.known["conserved"] = {"s": conserved}
    return made


def corner_functions(rng: Random) -> System:
    """Symbolic powers, nested functions, functions of velocities and of the time."""
    V = rng.choice(
        [
            "k*abs(x)^a", "k*(x^2)^a", "k*(1 + x^2)^(1/3)", "k*exp(-x^2/2)*cos(y)", "k*log(cosh(x))",
            "k*sqrt(x^2 + y^2 + l^2 - 2*l*x*cos(y))", "k*atan2(y, x)^2", "k*asin(x/9)", "k*sinh(x)/y",
            "k*sqrt(1 + sqrt(1 + x^2))", "U(x*y)", "W(x, U(y))", "U(U(x))", "k*x*U'(y)", "W(x - y, x + y)",
            "diff(x^2*y, x)*k", "k*sec(x/3) + csc(2 + y/9)", "k*acosh(2 + x^2)", "k*exp(a*log(2 + x^2))",
            "k*2^x", "k*pi^y", "k*(2 + x)^(y/9)*0 + k*x^3", "k*cot(1 + x/9)", "k*tan(x/5)*tanh(y)",
            "k*abs(x*y)", "k*sqrt(x^4 + 2*x^2*y^2 + y^4)", "k*cos(x)^2 + k*sin(x)^2 + g*y",
            "k*sin(x)*cos(x)*tan(x)", "k*atanh(x/20)", "k*asinh(x + y)", "W(t, x)", "k*(x/abs(x))*y",
            "k*exp(exp(x/9))", "k*sign(x)*sqrt(abs(x))", "k*cos(acos(x/9))", "k*sin(2*asin(x/9))",
            "k*tan(atan(x)/2)", "k*cos(2*atan2(y, x))*(x^2 + y^2)", "k*log(x^2*y^2)", "k*(x^2*y^4)^(1/2)",
        ]
    )  # fmt: skip
    T = rng.choice(
        [kinetic("xy"), "m*(x'^2 + y'^2 + a*x'*y'/5)/2", "m*cosh(x'^2 + y'^2)/2",
         "m*(x'^4 + y'^2)/2", "m*(x'^2*(1 + y^2) + y'^2)/2", "m*(x'^2 + y'^2)^2/4",
         "m*exp(x')+ m*y'^2/2", "m*(U'(x)^2 + 1)*x'^2/2 + m*y'^2/2"]
    )  # fmt: skip
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", "l", free=("a", "b")),
        functions={"U": ["s"], "W": ["u", "s"]},
        T=T,
        V=V,
        sections=MAIN
        + (
            CANONICAL
            if "cosh(x'" not in T and "x')" not in T and "^4" not in T and ")^2/4" not in T
            else ()
        ),
    )


def corner_attributes(rng: Random) -> System:
    """Assumptions of every kind, values, definitions in chains, several particles."""
    made = System(
        coordinates={"x": rng.choice([None, "positive", "negative"]), "y": rng.choice([None, "nonzero"])},
        parameters={
            "m": "positive", "k": rng.choice([None, "negative", "nonzero", "nonnegative"]),
            "c": rng.choice([None, "negative"]), "n": None, "l": "positive",
        },
        values={"n": rng.choice(["2", "3", "1/2", "-1"])} if rng.random() < 0.5 else {},
        definitions={
            "s": rng.choice(["x + y^2", "sqrt(x^2 + l^2)", "x*y", "x'*y"]),
            "u": rng.choice(["s^2 + x", "s*y", "diff(s, x)*y", "cos(s)"]),
        },
        T=rng.choice(["m*(x'^2 + y'^2)/2", "m*(1 + u^2)*(x'^2 + y'^2)/2", "m*(x'^2 + y'^2 + x'*y')/2"]),
        V=rng.choice(["k*s", "k*u", "c*sqrt(k^2*x^2)", "k*sqrt(x^2)", "c*x^n", "k*abs(c*x) + u", "k*sqrt(c^2)*u"]),
        sections=MAIN + (CANONICAL if rng.random() < 0.3 else ()),
    )  # fmt: skip
    if "x'" in made.definitions["s"] and ("u" in made.T or "s" in made.V or "u" in made.V):
        made.definitions["s"] = "x - y"
    if made.values.get("n") == "1/2" or ("n" not in made.values and "x^n" in made.V):
        made.coordinates["x"] = "positive"
    if made.coordinates["x"] == "negative":
        made.coordinates["x"] = "negative"
    return made


def corner_rest(rng: Random) -> System:
    """Flat and bent places, saddles of higher order, rings, several of them under conditions."""
    V = rng.choice(
        [
            "k*x^4 + g*y^2", "-k*x^4 + g*y^2", "k*x^3 + g*y^2", "k*x^4 - g*x^2*y + c*y^2",
            "k*x^4 - 3*k*x^2*y + k*y^2", "k*x^2*y^2 + g*y^4", "k*(x^2 + y^2 - 1)^2", "a*x^2/2 + k*x^4/4 + y^2",
            "a*x^2/2 + b*y^2/2", "a*cos(x) + k*y^2", "k*(1 - cos(x)) + a*x + y^2*g", "k*x^6 + g*y^4",
            "k*x^2 + y^2*g + k*x*y^2", "k*(x - y)^4", "k*sin(x)^4 + y^2", "-g*cos(x) + k*sin(x)^2/2 + y^2",
            "k*exp(-x^2) + y^2", "k*x*exp(-x) + y^2", "g*log(1 + x^2) - a*x + y^2", "k*x^2 - g*cos(x) + y^2",
            "k*(x^2 - y)^2 + g*x^2", "-k/sqrt(1 + x^2 + y^2)", "k*(x + y) ", "0", "k*x^2*(1 + y^2)",
            "k*(x^3 - 3*x*y^2)", "k*atan(x)^2 + y^2", "k*tanh(x)^2 + g*y^2", "k*(x^2 + y^2) + a*x*y",
        ]
    )  # fmt: skip
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", "c", "w", free=("a", "b")),
        L=rng.choice(
            ["m*(x'^2 + y'^2)/2", "m*((1 + x^2)*x'^2 + y'^2)/2", "m*(x'^2 + y'^2)/2 + m*w^2*x^2/2"]
        ) + f" - ({V})",
        sections=("energy", *REST),
        known={"search": "^4" not in V and V != "0" and "(x - y)" not in V},
    )  # fmt: skip
    if rng.random() < 0.25:
        made.dissipation = rng.choice(["c*x'^2/2", "c*(x'^2 + y'^2)/2", "-c*x'^2/2"])
    if rng.random() < 0.2:
        made.forces = rng.choice(
            [{"x": "-b*y", "y": "b*x"}, {"x": "b"}, {"x": "b*x'"}, {"y": "-c*y'^3"}]
        )
    if rng.random() < 0.2:
        made.L += " + b*(x*y' - y*x')"
    return made


def crowds(rng: Random) -> System:
    """Four to six coordinates: chains, networks of springs, rods."""
    n = rng.randint(4, 6)
    names = [f"q{i}" for i in range(1, n + 1)]
    links = "".join(f" + k*({b} - {a})^2/2" for a, b in itertools.pairwise(names))
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", free=("a", "b")),
        T=kinetic(names)
        + rng.choice(["", " + m*q1'*q2'*cos(q1 - q2)", f" + m*(q1' + {names[-1]}')^2/2"]),
        V="0" + links + rng.choice(["", " + g*q1", " + k*q1^2/2", " + g*cos(q2)", " + k*q1*q2*q3"]),
        symmetries={"all": dict.fromkeys(names, "1")},
    )
    for i in range(rng.choice([0, 1, 2])):
        u, v, w = rng.sample(names, 3)
        made.constraints[f"c{i}"] = rng.choice(
            [
                f"{u} + {v} = 2*{w}",
                f"{u} - {v} = l",
                f"{u}' = {v}*{w}'",
                f"{u} = a*{v}^2",
                f"{u}^2 + {v}^2 = l^2",
            ]
        )
    if rng.random() < 0.3:
        made.dissipation = f"b^2*({names[0]}' - {names[1]}')^2/2"
    return made


KINDS = {
    function.__name__: function
    for function in (
        corner_constraints, corner_symmetries, corner_functions, corner_attributes, corner_rest, crowds,
    )
}  # fmt: skip
