"""Phase space, reduction, forces on points, and mixtures of everything."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import kinetic, number, parameters, potential, whole


def phase_space(rng: Random) -> System:
    """Observables and transformations, canonical or nearly so."""
    u, v = number(rng), number(rng)
    one = {
        "swap": {"Q": "p_x", "p_Q": "-x"},
        "point": {"Q": "x^3 + x", "p_Q": "p_x/(3*x^2 + 1)"},
        "scaled": {"Q": f"({u})*x", "p_Q": f"({v})*p_x"},
        "shifted": {"Q": f"x - ({u})*t", "p_Q": f"p_x - m*({u})"},
        "gauged": {"Q": "x", "p_Q": f"p_x + ({u})*x^2 + b*t"},
        "turned": {"Q": "x*cos(w*t) - p_x*sin(w*t)/m", "p_Q": "p_x*cos(w*t) + m*x*sin(w*t)"},
        "logs": {"Q": "log(abs(p_x))", "p_Q": "-x*p_x"},
        "none": {"Q": "x*p_x", "p_Q": "p_x"},
        "mixed": {"Q": "(x + p_x)/sqrt(2)", "p_Q": "(p_x - x)/sqrt(2)"},
        "grown": {"Q": "x*exp(b*t)", "p_Q": "p_x*exp(-b*t)"},
        "inverse": {"Q": "1/x", "p_Q": "-x^2*p_x"},
        "sheared": {"Q": f"x + ({u})*p_x", "p_Q": "p_x"},
    }
    names = rng.sample(sorted(one), 2)
    still = {"R": "y", "p_R": "p_y"}
    chosen = {name: one[name] | still for name in names}
    if rng.random() < 0.5:
        chosen["both"] = {
            "Q": "x + y", "R": "x - y", "p_Q": "(p_x + p_y)/2", "p_R": "(p_x - p_y)/2",
        }  # fmt: skip
        if rng.random() < 0.4:
            chosen["both"]["p_R"] = "(p_y - p_x)/2"
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", "w", free=("b",)),
        observables={
            "A": rng.choice(["x*p_y - y*p_x", "x*p_x", "p_x^2 + x^2", "sin(x)*p_y", "exp(y)*p_x"]),
            "B": rng.choice(
                ["p_x^2/m + k*x^2", "t*p_x - m*x", "A^2 + y", "x*y*p_x", "log(1 + A^2)"]
            ),
        },
        canonical=chosen,
        sections=("hamiltonian", "canonical_equations", "brackets", "canonical"),
    )
    if rng.random() < 0.5:
        made.H = rng.choice(
            ["(p_x^2 + p_y^2)/(2*m) + k*x^2/2", "p_x*p_y/m + k*x*y", "p_x^2/2 + (1 + x^2)*p_y^2/2"]
        )
    else:
        made.T, made.V = kinetic("xy"), potential(rng, ("x", "y"))
    return made


def ignorable(rng: Random) -> System:
    """Cyclic coordinates: the Routhian, steady motions, Hamilton and Jacobi."""
    A = rng.choice(["m", "m*(1 + r^2)", "m*r^2", "m*exp(r)", "m/r^2"])
    B = rng.choice(
        ["m*r^2", "m*(b^2 + r^2)", "m*sin(r)^2", "m*exp(2*r)", "m*cosh(r)^2", "m/(1 + r^2)"]
    )
    C = rng.choice(["0", "0", "m*r", "m*b*cos(r)"])
    D = rng.choice(["0", "0", "b*r^2", "b*cos(r)", "b*r"])
    V = rng.choice(["-k/r", "k*r^2/2", "k*r", "-k*cos(r)", "k*log(r)", "k*r^4", "-k/r + g*r", "0"])
    made = System(
        coordinates={"r": "positive", "phi": None},
        parameters=parameters("m", "k", "g", free=("b",)),
        L=f"({A})*r'^2/2 + ({B})*phi'^2/2 + ({C})*r'*phi' + ({D})*phi' - ({V})",
        sections=("accelerations", "momenta", "charges", "reduction", "steady_motions",
                  "hamilton_jacobi"),
    )  # fmt: skip
    if C != "0":
        made.L = made.L.replace(f"({B})*phi'^2/2", f"({B} + 2*m*(1 + r^2))*phi'^2/2")
    if rng.random() < 0.35:
        made.coordinates["z"] = None
        made.L += rng.choice([" + m*z'^2/2", " + m*(z' + b*phi')^2/2", " + m*z'^2/2 - k*z^2/2"])
    return made


def on_points(rng: Random) -> System:
    """Constraint forces on particles and bodies."""
    surface = rng.choice(
        [
            {"c1": "x^2 + y^2 = l^2"},
            {"c1": "y = a*x^2"},
            {"c1": "x*sin(b) + y*cos(b) = 0"},
            {"c1": "sqrt(x^2 + y^2) = l"},
            {"c1": "x = l*th", "c2": "y = 0"},
            {"c1": "y = l", "c2": "x' = l*th'"},
            {"c1": "x = l*cos(th)", "c2": "y = l*sin(th)"},
            {"c1": "y = a*sin(x)", "c2": "th = x"},
            {"c1": "x^2 + y^2 = (l + a*t)^2"},
            {"c1": "y = x*tan(w*t/5)"},
        ]
    )
    turning = any("th" in text for text in surface.values())
    made = System(
        coordinates={"x": None, "y": None} | ({"th": None} if turning else {}),
        parameters=parameters("m", "g", "l", "w", "J", free=("a", "b")),
        points={"P": (["x", "y"], "m")},
        T="m*(x'^2 + y'^2)/2" + (" + J*th'^2/2" if turning else ""),
        V="m*g*y",
        constraints=surface,
        sections=(*MAIN, "forces"),
    )
    if rng.random() < 0.3:
        made.forces = {"x": rng.choice(["-w*x'", "a*t", "b*y"])}
    return made


def mixtures(rng: Random) -> System:
    """A little of everything."""
    n = rng.choice([2, 3, 3, 4])
    names = ["x", "y", "z", "u"][:n]
    x, y = rng.sample(names, 2)
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "M", "k", "g", "l", "w", free=("a", "b")),
        functions={"U": ["s"]},
        T=kinetic(names) + rng.choice(
            ["", f" + M*({x}' + {y}')^2/2", f" + M*({x}'*cos({y}) + l*{y}')^2/2",
             f" + M*{x}^2*{y}'^2/2", f" + M*(b + {x}*{y}')^2/2"]
        ),
        V=potential(rng, names) + rng.choice(["", "", f" + U({x} - {y})", " + k*x*cos(w*t)"]),
        sections=MAIN + (CANONICAL if n < 4 and rng.random() < 0.4 else ()),
    )  # fmt: skip
    some = [
        f"{x} = a*{y}", f"{x}' = {y}*{y}'", f"{x} + {y} = l + b*t", f"{x}^2 + {y}^2 = l^2",
        f"({x} - {y})*(1 + {x}^2) = 0", f"{x}' = b*{y}'", f"{x}*{y}' + {y}*{x}' = 0",
        f"{x}' - {y}*{names[-1]}' = a", f"{x} = sin({y})", f"exp({x}) = {y} + 3", f"{x}*{y} = l^2",
        f"{x}^2 - {x}*{y} = 0", f"sin({x})*({x} - 2*{y}) = 0",
    ]  # fmt: skip
    for k in range(rng.choice([0, 0, 1, 1, 2]) if n > 2 else rng.choice([0, 1])):
        made.constraints[f"c{k}"] = some.pop(rng.randrange(len(some)))
    if rng.random() < 0.3:
        made.forces = {x: rng.choice([f"-b*{y}'", f"a*{x}'*{y}", "k*cos(w*t)", f"-k*{y}"])}
    if rng.random() < 0.3:
        made.dissipation = rng.choice([f"k*{x}'^2/2", f"k*({x}' - {y}')^2/2", f"g*{x}^2*{y}'^2"])
    made.symmetries = {
        "s": {x: str(whole(rng)), y: str(whole(rng))},
        "r": {x: f"-{y}", y: x},
        "d": rng.choice([{x: x, "t": "2*t"}, {x: "t"}, {x: f"{y}^2"}, {"t": "1", x: "b"}]),
    }
    return made


KINDS = {function.__name__: function for function in (phase_space, ignorable, on_points, mixtures)}
