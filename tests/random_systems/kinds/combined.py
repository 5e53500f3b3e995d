"""Combinations: moving constraints with factors twice over, maps that move, steep H, questions."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import gauge, kinetic, number, parameters, potential


def moving_factors(rng: Random) -> System:
    """A factor before a moving constraint, the constraint again in another form, forces, drag."""
    f, df = rng.choice(
        [
            ("x - a*y - b*t", "x' - a*y' - b"),
            ("x^2 + y^2 - (l + b*t)^2", "x*x' + y*y' - b*(l + b*t)"),
            ("y - a*x^2 - b*t^2", "y' - 2*a*x*x' - 2*b*t"),
            ("z - x*cos(w*t)", "z' - x'*cos(w*t) + w*x*sin(w*t)"),
            ("x*exp(b*t) - y", "(x' + b*x)*exp(b*t) - y'"),
            ("x*y - l^2*(1 + t^2)", "x'*y + x*y' - 2*l^2*t"),
            ("abs(x) - l - y^2", "sign(x)*x' - 2*y*y'"),
        ]
    )
    never = rng.choice(["(1 + z^2)", "exp(x*t)", "(2 + cos(t))", "cosh(y)", "sqrt(1 + t^2)"])
    may = rng.choice(["z", "(z - x)", "(z^2 - l^2)", "sin(z)", "t", "(y - 2*l)"])
    constraints = [f"{never}*({rng.choice([f, df])}) = 0"]
    more = rng.choice(["", "twice", "other", "both", "factor"])
    if more in {"twice", "both"}:
        constraints.append(f"({number(rng)})*({f}) = 0")
    if more in {"other", "both"}:
        constraints.append(rng.choice(["z = b*y", "z' = x*y'", "z' - y*x' = w*t"]))
    if more == "factor":
        constraints = [f"{may}*({f}) = 0"]
    rng.shuffle(constraints)
    made = System(
        coordinates=dict.fromkeys("xyz"),
        parameters=parameters("m", "k", "g", "l", "w", "c", free=("a", "b")),
        T=kinetic("xyz"),
        V=potential(rng, "xyz"),
        constraints={f"c{i}": text for i, text in enumerate(constraints)},
        symmetries={"s": {"x": "a", "y": "1"}, "up": {"z": "1"}},
    )
    made.dissipation = rng.choice([None, "c*z'^2/2", "c*(x' - y')^2/2"])
    made.forces = rng.choice([{}, {}, {"z": "b*x'"}, {"x": "b*y'", "y": "-b*x'"}, {"z": "k*t"}])
    return made


def moving_maps(rng: Random) -> System:
    """Symmetries carried to turning, stretching and accelerated coordinates, with a gauge."""
    V, vectors = rng.choice(
        [
            ("k*Y^2", [("1", "0"), ("t", "0")]),
            ("k*(X^2 + Y^2)/2", [("-Y", "X"), ("cos(sqrt(k/m)*t)", "0")]),
            ("m*g*X", [("1", "0"), ("0", "t"), ("t", "0")]),
            ("k*(X - Y)^4", [("1", "1"), ("t", "t")]),
            ("-k/sqrt(X^2 + Y^2)", [("-Y", "X")]),
            ("0", [("t", "0"), ("-Y", "X"), ("t", "1")]),
        ]
    )
    X, Y, back = rng.choice(
        [
            ("x*cos(w*t) - y*sin(w*t)", "x*sin(w*t) + y*cos(w*t)",
             lambda X, Y: (f"cos(w*t)*({X}) + sin(w*t)*({Y})", f"cos(w*t)*({Y}) - sin(w*t)*({X})")),
            ("x*exp(b*t)", "y*exp(-b*t)",
             lambda X, Y: (f"exp(-b*t)*({X})", f"exp(b*t)*({Y})")),
            ("x + a*t^2/2", "y - b*t", lambda X, Y: (X, Y)),
            ("x + b*t*y", "y", lambda X, Y: (f"({X}) - b*t*({Y})", Y)),
            ("x*(1 + t^2)", "y + x*t",
             lambda X, Y: (f"({X})/(1 + t^2)", f"({Y}) - t*({X})/(1 + t^2)")),
        ]
    )  # fmt: skip
    kept = rng.random() < 0.7
    first, second = rng.choice(vectors)
    if not kept:
        first, second = f"({first}) + Y^2", f"({second}) + X*Y"
    x, y = back(first, second)
    return System(
        coordinates=dict.fromkeys("xy"),
        parameters=parameters("m", "k", "g", "w", free=("a", "b")),
        definitions={"X": X, "Y": Y},
        L=f"m*(X'^2 + Y'^2)/2 - ({V}) + {gauge(rng, 'x', 'y')[1]}",
        symmetries={"s": {"x": x, "y": y}},
        known={"conserved": {"s": kept}},
    )


def corners_held(rng: Random) -> System:
    """abs and sign in V, in forces and in constraints together."""
    constraint = rng.choice(
        ["y = abs(x)", "abs(y) = a*x^2", "y = x*abs(x)", "abs(x) + y = b*t", "x'*abs(y) = y'",
         "sqrt((x - y)^2) = l", "abs(x - y)*x' = b*y'", "sign(x)*y = x^2", "abs(x)*abs(y) = l^2",
         "y*abs(y) = x", "abs(x + y) = l"]
    )  # fmt: skip
    names = rng.choice(["xy", "xyz"])
    V = rng.choice(
        [
            "k*abs(x)",
            "k*x*abs(x)",
            "g*y + k*abs(x)^3",
            "k*x*abs(y)",
            "g*abs(x - 3*y)",
            "g*abs(x - y)",
        ]
    )
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", "c", free=("a", "b")),
        T=kinetic(names),
        V=V,
        constraints={"c1": constraint},
        symmetries={"s": {"x": "1", "y": "1"}, "d": {"x": "x", "y": "y"}},
    )
    made.forces = rng.choice([{}, {"x": "-c*x'*abs(x')"}, {"y": "b*sign(x)"}])
    if constraint == "y = abs(x)" and V == "g*abs(x - y)":
        made.V = "g*abs(x - 2*y)"  # else it stays at its corner, where x > 0
    return made


def steep_hamiltonians(rng: Random) -> System:
    """H whose p is not linear in the velocity, with candidates."""
    T = rng.choice(
        [
            "c*sqrt(m^2*c^2 + (p_x - b*y)^2 + p_y^2)",
            "sqrt(1 + p_x^2/x^2 + p_y^2)",
            "m*c^2*cosh(p_x/(m*c)) + p_y^2/(2*m)",
            "exp(p_x) + exp(p_y - p_x)",
            "exp(p_x + p_y) + p_x^2/(2*m)",
            "p_x^2/(2*m) + sqrt(1 + p_y^2)",
            "(p_x^2 + p_y^2)/(2*m) + abs(p_x)^3/3",
            "x^2*p_x^2/(2*m) + exp(p_y)",
        ]
    )
    names = rng.choice([("x",), ("x", "y")])
    return System(
        coordinates={"x": "positive", "y": None},
        parameters=parameters("m", "k", "g", "c", "w", free=("a", "b")),
        H=f"{T} + {potential(rng, names)}",
        symmetries={"s": {"y": "1"}, "t": {"t": "1"}},
        sections=MAIN + CANONICAL,
        known={"slow": "0.3"},
    )


def held_and_dragged(rng: Random) -> System:
    """Applied forces and a Rayleigh function with constraints: what works, what is conserved."""
    constraint = rng.choice(
        [
            {"c1": "x^2 + y^2 = l^2"}, {"c1": "y = a*x^2"}, {"c1": "z' = x*y' - y*x'"},
            {"c1": "x' = a*z'", "c2": "y = b*z"}, {"c1": "x'*sin(z) = y'*cos(z)"},
            {"c1": "x + y + z = w*t"}, {"c1": "y' = w*z + x'"},
        ]
    )  # fmt: skip
    made = System(
        coordinates=dict.fromkeys("xyz"),
        parameters=parameters("m", "M", "k", "g", "l", "w", "c", free=("a", "b")),
        T=rng.choice([kinetic("xyz"), "m*(x'^2 + y'^2)/2 + M*l^2*z'^2/2 + m*x'*z'/9"]),
        V=rng.choice(["0", "m*g*z", "k*(x^2 + y^2)/2", "m*g*y"]),
        constraints=constraint,
        symmetries={"turn": {"x": "-y", "y": "x"}, "up": {"z": "1"}, "screw": {"z": "b", "y": "1"}},
        sections=(*MAIN, "hamiltonian", "canonical_equations"),
    )
    made.forces = rng.choice(
        [{}, {"x": "-b*y", "y": "b*x"}, {"x": "b*y'", "y": "-b*x'"}, {"z": "-a*z'^3"}, {"z": "b"}]
    )
    made.dissipation = rng.choice([None, "c*z'^2/2", "c*(x*y' - y*x')^2/2", "c*(x'^2 + y'^2)^2/4"])
    return made


def questions(rng: Random) -> System:
    """Values that the conserved charges and `initial` give, and equations to be solved."""
    m = rng.choice(["m", "(2*m)", "(m + M)"])
    n, d = rng.randint(1, 9), rng.randint(10, 19)
    kind = rng.choice(["potential", "curve", "sphere", "orbit", "turn", "swing", "fall"])
    made = System(coordinates={}, parameters=parameters("m", "M", "k", "g", "R", "u"))
    if kind == "potential":
        f = rng.choice(["x^2", "x^4", "exp(-{x})", "cos(x)", "x^3 - x", "1/(1 + x^2)", "x*sin(x)"])
        f = f.replace("{x}", "x")
        made.coordinates, made.T, made.V = {"x": None}, f"{m}*x'^2/2", f"k*({f})"
        at = f.replace("x^", "R^").replace("(x)", "(R)").replace("- x", "- R").replace("x*", "R*")
        at = at.replace("exp(-x)", "exp(-R)")
        made.more = (
            f"initial: {{x: R, x': {n}*u}}\nfind: {{a: {{value: x'^2, in_terms_of: [x]}}}}\n"
        )
        made.known["answers"] = {"a": [f"{n * n}*u^2 + 2*k*(({at}) - ({f}))/{m}"]}
    elif kind == "curve":
        made.coordinates, made.T = {"x": None, "y": None}, f"{m}*(x'^2 + y'^2)/2"
        made.V, made.constraints = f"{m}*g*y", {"c": "y = k*x^2"}
        made.more = (
            f"initial: {{x: 0, x': {n}*u}}\nfind: {{a: {{value: lambda_c, in_terms_of: [x]}}}}\n"
        )
        square = f"({n * n}*u^2 - 2*g*k*x^2)/(1 + 4*k^2*x^2)"
        made.known["answers"] = {"a": [f"{m}*(g + 2*k*({square}))/(1 + 4*k^2*x^2)"]}
    elif kind == "sphere":
        made.coordinates, made.constraints = {"r": "positive", "th": None}, {"c": "r = R"}
        made.T, made.V = f"{m}*(r'^2 + r^2*th'^2)/2", f"{m}*g*r*cos(th)"
        made.more = (
            f"initial: {{r: R, th: 0, th': sqrt({n}*g/({d}*R))}}\n"
            "find: {a: {where: lambda_c = 0, for: th}, b: {value: th'^2, in_terms_of: [th]}}\n"
        )
        made.known["answers"] = {
            "a": [f"acos((2 + {n}/{d})/3)", f"-acos((2 + {n}/{d})/3)"],
            "b": [f"{n}*g/({d}*R) + 2*g*(1 - cos(th))/R"],
        }
    elif kind == "orbit":
        made.coordinates = {"r": "positive", "phi": None}
        made.T, made.V = f"{m}*(r'^2 + r^2*phi'^2)/2", rng.choice(["-k/r", "k*r^2/2", "k*log(r)"])
        made.more = (
            f"initial: {{r: R, phi: 0, r': 0, phi': {n}*u}}\n"
            "find: {a: {value: phi', in_terms_of: [r]}, b: {value: r'^2, in_terms_of: [r]}}\n"
        )
        at = made.V.replace("r", "R")
        kinetic_ = f"{n * n}*u^2*R^2*(1 - R^2/r^2)"
        made.known["answers"] = {
            "a": [f"{n}*u*R^2/r^2"], "b": [f"{kinetic_} + 2*(({at}) - ({made.V}))/{m}"]
        }  # fmt: skip
    elif kind == "turn":
        made.coordinates, made.T, made.V = {"x": None}, f"{m}*x'^2/2", f"k*x^2/2 + {n}*u*x"
        made.more = "initial: {x: R, x': 0}\nfind: {a: {where: x' = 0, for: x}}\n"
        made.known["answers"] = {"a": ["R", f"-R - {2 * n}*u/k"]}
    elif kind == "swing":
        made.coordinates, made.constraints = {"r": "positive", "th": None}, {"c": "r = R"}
        made.T, made.V = f"{m}*(r'^2 + r^2*th'^2)/2", f"-{m}*g*r*cos(th)"
        made.more = (
            f"initial: {{r: R, th: acos({n}/{d})}}\n"
            "find: {a: {value: lambda_c, in_terms_of: [th]}}\n"
        )
        made.known["answers"] = {"a": [f"-{m}*g*(3*cos(th) - {2 * n}/{d})"]}
    else:
        made.coordinates, made.T, made.V = {"x": None}, f"{m}*x'^2/2", f"{m}*g*x"
        made.more = f"initial: {{x: R, x': {n}*u}}\nfind: {{a: {{where: x' = 0, for: x}}}}\n"
        made.known["answers"] = {"a": [f"R + {n * n}*u^2/(2*g)"]}
    made.sections = ("accelerations", "charges", "find")
    if rng.random() < 0.5:
        made.units = {"m": "kg", "M": "kg", "g": "m/s^2"} | dict.fromkeys(
            {"R", "x", "y", "r"} & {*made.coordinates, "R"}, "m"
        )
        made.units |= {name: "rad" for name in ("th", "phi") if name in made.coordinates}
        if kind not in {"potential", "orbit"}:
            made.units |= {"k": {"curve": "1/m"}.get(kind, "N/m")}
        made.units |= {"u": {"turn": "N", "orbit": "1/s"}.get(kind, "m/s")}
        if kind in {"potential", "orbit"}:
            made.units = {}
    return made


KINDS = {
    function.__name__: function
    for function in (
        moving_factors, moving_maps, corners_held, steep_hamiltonians, held_and_dragged, questions,
    )
}  # fmt: skip
