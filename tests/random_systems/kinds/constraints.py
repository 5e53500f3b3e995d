"""Constraints: common factors, branches, time, redundancy, disguises, drift, no mass."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import kinetic, number, parameters, potential, whole


def _line(rng: Random, x, y):
    return f"{whole(rng)}*{x} + {whole(rng)}*{y}"


def _surface(rng: Random, x="x", y="y", z="z"):
    """A holonomic constraint with a gradient nearly everywhere."""
    return rng.choice(
        [
            f"{x} - {whole(rng)}*{y}",
            f"{x}^2 + {y}^2 - l^2",
            f"{y} - a*{x}^2",
            f"{z} - {x}*{y}",
            f"{x}^2 + {y}^2 + {z}^2 - l^2",
            f"{z} - a*sin({x})",
            f"{x}*{y} - l^2",
            f"{x}^2/4 + {y}^2 - l^2",
            f"{z} - {x}^2 + {y}^2",
            f"{z} - sqrt(l^2 + {x}^2)",
        ]
    )


def _three(rng: Random, constraints, **more) -> System:
    names = more.pop("names", ("x", "y", "z"))
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", "w", free=("a", "b")),
        T=kinetic(names),
        V=potential(rng, names),
        constraints=constraints,
        **more,
    )


def common_factor(rng: Random) -> System:
    """f g = 0 with f never 0, or with f that may vanish, and the same for velocities."""
    never = rng.choice(["(1 + x^2)", "exp(y)", "(2 + cos(x))", "(l^2 + y^2)", "cosh(x)", "l"])
    may = rng.choice(["y", "x", "(x - y)", "(y - l)", "sin(x)", "x*y", "(x^2 - y^2)", "y^2"])
    if rng.random() < 0.5:
        inner = rng.choice(["x' + x*y'", "x' - b*y'", "x' - y*z'", "x*y' - y*x'", "x' - z*y' + b"])
        return _three(rng, {"c1": f"{rng.choice([never, may])}*({inner}) = 0"})
    return _three(rng, {"c1": f"{never}*({_surface(rng)}) = 0"})


def branches(rng: Random) -> System:
    """One equation with several branches."""
    one = rng.choice(
        [
            f"y*({_line(rng, 'x', 'y')}) = 0",
            "x^2 = y^2",
            f"({_line(rng, 'x', 'y')})*({_line(rng, 'y', 'x')} - l) = 0",
            "x*y = 0",
            f"(x^2 + y^2 - l^2)*({_line(rng, 'x', 'y')} - 3*l) = 0",
            "sin(x - y) = 0",
            "x^3 = x*y^2",
            "x^2 - 3*x*y + 2*y^2 = 0",
            "cos(x) = cos(y)",
            "x*y*(x - y) = 0",
            "(x - l)*(y - l) = 0",
        ]
    )
    names = rng.choice([("x", "y"), ("x", "y", "z")])
    made = _three(rng, {"c1": one}, names=names)
    if rng.random() < 0.3:
        made.symmetries = {"s": {"x": str(whole(rng)), "y": str(whole(rng))}}
    return made


def timed(rng: Random) -> System:
    """Constraints that depend on the time."""
    one = rng.choice(
        [
            "x = a*cos(w*t)",
            "x*sin(w*t) = y*cos(w*t)",
            "x^2 + y^2 = (l + b*t)^2",
            "x^2 + y^2 + z^2 = l^2*(1 + t^2)",
            "y = a*x^2 + b*t^2/2",
            "(x - a*sin(w*t))^2 + y^2 = l^2",
            "z = a*x*t + y",
            "x' = w*y*t",
            "x' - y'*tan(w*t/9) = b",
            "x*exp(t) = y",
            "t*x + y = l",
            "x' + t*y' + y = 0",
        ]
    )
    more = {"c2": rng.choice(["z = b*x", "z = a*t", "x + y + z = l", "z' = x'*t"])}
    made = _three(rng, {"c1": one} | (more if rng.random() < 0.4 else {}))
    made.sections = MAIN + (CANONICAL if rng.random() < 0.3 else ())
    return made


def redundant(rng: Random) -> System:
    """Constraints that follow from others, everywhere or on their surface only."""
    c1, c2 = (
        rng.choice(["x + y - l", "x^2 + y^2 - l^2", "y - a*x^2", "x*y - l^2"]),
        rng.choice(["z - b*x", "z - x*y", "x - 2*z", "z - a*y^2"]),
    )
    u, v = number(rng), number(rng)
    third = rng.choice(
        [
            f"({u})*({c1}) + ({v})*({c2})",
            f"({c1})*(1 + ({c2})) + ({c2})",
            f"({c1})*(1 + x^2) - ({v})*({c2})",
            f"({c1})*exp(y) + ({c2})*cosh(x)",
            f"({c2})*(2 + sin(x))",
            f"({c1})*(1 + z*({c1}))",
        ]
    )
    made = _three(rng, {"c1": f"{c1} = 0", "c2": f"{c2} = 0", "c3": f"{third} = 0"})
    if rng.random() < 0.3:
        made.constraints = {
            "c1": "x^2 + y^2 = l^2",
            "c2": f"({u})*(x*x' + y*y') = 0",
        }
        made.known["constraint_kinds"] = {"c2": "integrable"}
    return made


def disguised(rng: Random) -> System:
    """df/dt times an integrating factor: integrable."""
    f = rng.choice(
        [
            ("x*y + z", "x'*y + x*y' + z'"),
            ("x^2 + y^2", "x*x' + y*y'"),
            ("z - sin(x)*y", "z' - cos(x)*y*x' - sin(x)*y'"),
            ("x*exp(y)", "x' + x*y'"),
            ("y/x", "x*y' - y*x'"),
            ("x^2 + y^2 + z^2", "x*x' + y*y' + z*z'"),
            ("x - a*y - w*t", "x' - a*y' - w"),
            ("log(x) - y*t", "x'/x - y'*t - y"),
            ("x*y*z", "x'*y*z + x*y'*z + x*y*z'"),
        ]
    )[1]
    factor = rng.choice(["1", "(1 + x^2)", "exp(z)", "(2 + cos(y))", "m", "(1 + y^2 + z^2)", "x"])
    made = _three(rng, {"c1": f"{factor}*({f}) = 0"})
    made.coordinates["x"] = "positive"
    made.known["constraint_kinds"] = {"c1": "integrable"}
    return made


def nonholonomic(rng: Random) -> System:
    """Knives, rolling and drift."""
    one, kind = rng.choice(
        [
            ("x'*sin(z) = y'*cos(z)", "nonholonomic"),
            ("x'*sin(z) - y'*cos(z) = a*z'", "nonholonomic"),
            ("x' = y*z'", "nonholonomic"),
            ("x' = y*z' + b", "nonholonomic"),
            ("x' - y*z' = w*t", "nonholonomic"),
            ("z' = x*y' - y*x'", "nonholonomic"),
            ("z' = (x*y' - y*x')*a + w", "nonholonomic"),
            ("x' + w*y = z'*y", "nonholonomic"),
            ("x'*cos(z) + y'*sin(z) = l*w", "nonholonomic"),
            ("(1 + y^2)*x' = sin(z)*y'", "nonholonomic"),
            ("x' = exp(y)*z'", "nonholonomic"),
        ]
    )
    more = rng.choice([{}, {}, {"c2": "y' = a*z'"}, {"c2": "y = b*x"}])
    made = _three(rng, {"c1": one} | more)
    if not more:
        made.known["constraint_kinds"] = {"c1": kind}
    if rng.random() < 0.4:
        made.symmetries = {"s": {rng.choice("xyz"): "1"}, "r": {"x": "-y", "y": "x", "z": "1"}}
    return made


def massless(rng: Random) -> System:
    """Coordinates without kinetic energy that constraints determine."""
    names = ("x", "y", "z", "u")[: rng.choice([2, 3, 4])]
    heavy = names[: rng.randint(1, len(names) - 1)]
    light = names[len(heavy) :]
    constraints = {}
    for k, name in enumerate(light):
        of = rng.choice(heavy)
        constraints[f"c{k}"] = rng.choice(
            [
                f"{name} = a*{of}",
                f"{name} - {of}^2 = l",
                f"{name} = sin({of})",
                f"{name} + {of} = l + b*t",
                f"{name}^3 + {name} = {of}",
                f"{name}' = {of}*{heavy[0]}'",
                f"{name}*{of} = l^2",
            ]
        )
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", free=("a", "b")),
        T=kinetic(heavy),
        V=potential(rng, names),
        constraints=constraints,
    )


def broken_cyclic(rng: Random) -> System:
    """Cyclic coordinates that a constraint or a force couples."""
    made = System(
        coordinates={"r": "positive", "phi": None, "z": None},
        parameters=parameters("m", "k", "g", "l", "w", free=("a", "b")),
        T="m*(r'^2 + r^2*phi'^2 + z'^2)/2",
        V=rng.choice(["0", "k*r^2/2", "g*z", "k/r", "g*z + k*r^2"]),
    )
    made.constraints = rng.choice(
        [
            {"c1": "z = a*phi"},
            {"c1": "phi = w*t"},
            {"c1": "z = a*r^2"},
            {"c1": "r = l*exp(a*phi)"},
            {"c1": "z' = a*r*phi'"},
            {"c1": "r' = b*phi'"},
            {"c1": "r = l", "c2": "z = b*sin(phi)"},
            {"c1": "phi' = w + a*z'"},
        ]
    )
    if rng.random() < 0.3:
        made.forces = {rng.choice(["phi", "z"]): rng.choice(["b", "-b*phi'", "a*r", "-k*z'"])}
    made.symmetries = {"turn": {"phi": "1"}, "screw": {"phi": "1", "z": "a"}, "up": {"z": "1"}}
    return made


def linkages(rng: Random) -> System:
    """Particles on rods, in Cartesian coordinates, with one rod too many at times."""
    pairs = [("x1", "y1"), ("x2", "y2")]
    constraints = {"c1": "x1^2 + y1^2 = l^2", "c2": "(x2 - x1)^2 + (y2 - y1)^2 = l^2"}
    extra = rng.choice([{}, {"c3": "y2 = 0"}, {"c3": "x2 = b*t"}, {"c3": "x1 + x2 = a"}, {}])
    names = [name for pair in pairs for name in pair]
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "M", "g", "l", "k", free=("a", "b")),
        points={"A": (["x1", "y1"], "m"), "B": (["x2", "y2"], "M")},
        V=rng.choice(["m*g*y1 + M*g*y2", "0", "k*(x1 - x2)^2/2", "k*x1*y2"]),
        constraints=constraints | extra,
    )
    if rng.random() < 0.5:
        made.symmetries = {"turn": {"x1": "-y1", "y1": "x1", "x2": "-y2", "y2": "x2"}}
    return made


KINDS = {
    function.__name__: function
    for function in (
        common_factor, branches, timed, redundant, disguised, nonholonomic, massless,
        broken_cyclic, linkages,
    )
}  # fmt: skip
