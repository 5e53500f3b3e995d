"""Forms of L: singular, branches of functions, forces, H, linear terms, frames."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import gauge, kinetic, parameters, potential, whole


def singular(rng: Random) -> System:
    """Lagrangians whose Hessian is singular; at times the motion is determined all the same."""
    L = rng.choice(
        [
            "m*x'^2/2 + y*x' - k*x^2/2",
            "m*(x' + y')^2/2 - k*(x + y)^2/2",
            "m*(x' - a*y')^2/2 - k*x^2/2 - g*y^2/2",
            "x*y' - y*x' - k*(x^2 + y^2)/2",
            "m*x'^2/2 - k*(x - y)^2/2",
            "m*x'^2/2 + y*(x - a) - g*y^2",
            "m*(x'*cos(y) + y'*sin(x))^2/2",
            "m*x'^2*y/2 - k*x",
            "x'*y^2 - k*x^2*y",
            "m*(x*y' - y*x')^2/2 - k*x",
        ]
    )
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", free=("a", "b")),
        L=L,
        sections=MAIN + CANONICAL,
    )
    if rng.random() < 0.4:
        made.constraints = {"c1": rng.choice(["y = a*x", "x*y = 1", "y = sin(x)", "x + y = b*t"])}
    return made


def kinks(rng: Random) -> System:
    """abs, sign, roots of squares, arcs of their functions."""
    u = rng.choice(["x", "y", "x + y", "x - 2*y", "x*y"])
    f = rng.choice(
        [
            "abs({u})", "abs({u})^3", "({u})*abs({u})", "sqrt(({u})^2)", "acos(cos({u}))",
            "asin(sin({u}))", "atan(tan({u}))", "({u})^2*sign({u})", "atan2(y, x)",
            "abs(sin({u}))", "sqrt(({u})^2 + abs(x))", "log(abs({u}))", "abs({u} - 1/7)",
            "sign({u})*x", "sqrt(1 - cos({u})^2)", "abs(x)*abs(y)", "((({u})^2)^(3/2))",
            "exp(log(1 + ({u})^2)/2)", "acosh(cosh({u}))", "atan(x/y)", "sqrt(x^2*y^2)",
            "sqrt(x^2 + 2*x*y + y^2)", "abs(x^2 - y^2)", "sqrt((1 + sin({u}))^2)",
        ]
    ).format(u=u)  # fmt: skip
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", free=("a", "b")),
        T=kinetic(("x", "y")),
        V=f"a*{f} + k*y^2/2",
        sections=MAIN + CANONICAL,
    )
    where = rng.random()
    if where < 0.25:
        made.V, made.forces = "k*x^2/2", {"x": f"b*{f}", "y": "-b*abs(y')*y'"}
    elif where < 0.4:
        made.T = f"m*(x'^2 + y'^2)/2 + m*(x'^2*({f})^2)/2"
        made.V = "k*x^2/2"
    elif where < 0.5:
        made.V, made.constraints = (
            "k*x^2/2",
            {"c1": rng.choice(["y = abs(x)", "abs(x) + abs(y) = 2"])},
        )
    if rng.random() < 0.3:
        made.symmetries = {"s": {"x": "1", "y": "-1"}}
    return made


def damped(rng: Random) -> System:
    """Dissipation and forces of the velocity."""
    names = ("x", "y")
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "c", "w", free=("a", "b")),
        T=rng.choice([kinetic(names), "m*(x'^2 + x^2*y'^2)/2", "m*(x'^2 + y'^2 + x'*y'*cos(x))/2"]),
        V=potential(rng, names),
        sections=MAIN + CANONICAL,
    )
    made.dissipation = rng.choice(
        [
            None,
            "c*x'^2/2",
            "c*(x' - y')^2/2",
            "c*(x'^2 + y'^2)^2",
            "c*x^2*y'^2/2",
            "c*sqrt(1 + x'^2)",
        ]
    )
    made.forces = rng.choice(
        [
            {},
            {"x": "b*y'", "y": "-b*x'"},
            {"x": "-a*x'*sqrt(x'^2 + y'^2)"},
            {"y": "b*cos(w*t)"},
            {"x": "-k*y", "y": "k*x"},
            {"x": "a*x*y' + b*t"},
        ]
    )
    if rng.random() < 0.3:
        made.constraints = {
            "c1": rng.choice(["y = a*x", "x^2 + y^2 = 4", "x' = a*x*y'", "y = x^2"])
        }
    made.symmetries = {"s": {rng.choice(names): "1"}, "turn": {"x": "-y", "y": "x"}}
    return made


def hamiltonians(rng: Random) -> System:
    """A file that gives H."""
    kinetic_ = rng.choice(
        [
            "(p_x^2 + p_y^2)/(2*m)",
            "p_x^2/(2*m) + p_y^2/(2*m*(1 + x^2))",
            "((p_x - b*y)^2 + (p_y + b*x)^2)/(2*m)",
            "(p_x^2 + p_x*p_y + p_y^2)/(2*m)",
            "p_x^2/(2*m) + p_y^2/(2*m) + w*(x*p_y - y*p_x)",
            "c*sqrt(m^2*c^2 + p_x^2 + p_y^2)",
            "exp(x)*p_x^2/(2*m) + p_y^2/(2*m)",
            "p_x^2/(2*m*exp(b*t)) + p_y^2/m",
            "p_x*p_y/m",
            "(p_x + t*p_y)^2/(2*m) + p_y^2/(2*m)",
            "cosh(p_x) + p_y^2/(2*m)",
            "p_x^2/(2*m) + exp(p_y)",
        ]
    )
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", "c", "w", free=("a", "b")),
        H=f"{kinetic_} + {potential(rng, ('x', 'y'))}",
        sections=MAIN + CANONICAL,
    )


def gyroscopic(rng: Random) -> System:
    """Terms linear in the velocities."""
    A = rng.choice(
        [
            "b*(x*y' - y*x')", "a*x*y'", "a*y^2*x' + b*x", "b*sin(x)*y'", "a*exp(y)*x' + b*t*y'",
            "a*(x^2*y' - y^2*x')", "b*(x*y' - y*x')/(x^2 + y^2)", "a*x'*y + b*x'*x^2",
        ]
    )  # fmt: skip
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", free=("a", "b")),
        L=f"m*(x'^2 + y'^2)/2 + {A} + {gauge(rng, 'x', 'y')[1]} - ({potential(rng, ('x', 'y'))})",
        symmetries={"s": {"x": "1"}, "up": {"y": "1"}, "turn": {"x": "-y", "y": "x"}},
        sections=MAIN + CANONICAL,
    )


def rotating(rng: Random) -> System:
    """Turning frames and driven points of support."""
    X, Y = rng.choice(
        [
            ("x*cos(w*t) - y*sin(w*t)", "x*sin(w*t) + y*cos(w*t)"),
            ("a*cos(w*t) + l*sin(x)", "a*sin(w*t) - l*cos(x) + y*0"),
            ("x*cos(w*t)", "x*sin(w*t) + y"),
            ("x*cos(y + w*t)", "x*sin(y + w*t)"),
            ("x + b*t^2/2", "y + a*sin(w*t)"),
            ("x*exp(b*t)", "y*exp(-b*t)"),
        ]
    )
    names = ("x",) if "y*0" in Y else ("x", "y")
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", "w", free=("a", "b")),
        points={"P": ([X, Y.replace(" + y*0", "")], "m")},
        V=potential(rng, names) if rng.random() < 0.7 else f"m*g*({Y})",
        sections=MAIN + CANONICAL,
    )
    made.V = made.V.replace(" + y*0", "")
    return made


def central(rng: Random) -> System:
    """Central forces in several coordinates."""
    V = rng.choice(
        ["-k/{r}", "k*{r}^2/2", "k*log({r})", "-k*exp(-{r}/b^2)/{r}", "k*{r}^a", "k/{r}^2"]
    )
    where = rng.choice(["polar", "cartesian", "spherical", "cylindrical"])
    made = System(coordinates={}, parameters=parameters("m", "k", free=("a", "b")))
    made.sections = MAIN + CANONICAL
    r = "sqrt(x^2 + y^2 + z^2)"
    if where == "polar":
        made.coordinates, r = {"r": "positive", "phi": None}, "r"
        made.T, made.symmetries = "m*(r'^2 + r^2*phi'^2)/2", {"s": {"phi": "1"}}
        if rng.random() < 0.3:
            made.symmetries = {"s": {"phi": str(whole(rng))}}
    elif where == "cartesian":
        made.coordinates = dict.fromkeys("xyz")
        made.T, made.symmetries = kinetic("xyz"), {"s": {"y": "-z", "z": "y"}}
    elif where == "cylindrical":
        made.coordinates, r = {"r": "positive", "phi": None, "z": None}, "sqrt(r^2 + z^2)"
        made.T = "m*(r'^2 + r^2*phi'^2 + z'^2)/2"
        made.symmetries = {"s": {"r": "-z*cos(phi)", "z": "r*cos(phi)", "phi": "z*sin(phi)/r"}}
    else:
        made.coordinates, r = {"r": "positive", "theta": "positive", "phi": None}, "r"
        made.T = "m*(r'^2 + r^2*theta'^2 + r^2*sin(theta)^2*phi'^2)/2"
        made.symmetries = {"s": {"theta": "sin(phi)", "phi": "cos(phi)*cot(theta)"}}
    made.V = V.format(r=r)
    made.known["conserved"] = {"s": True}
    return made


KINDS = {
    function.__name__: function
    for function in (singular, kinks, damped, hamiltonians, gyroscopic, rotating, central)
}
