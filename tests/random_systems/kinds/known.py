"""Systems whose answers are known from how they are made, and constraints of several factors."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import gauge, kinetic, number, parameters, plane_map, potential, whole


def _factor(rng: Random, names) -> str:
    x, y = rng.sample(list(names), 2)
    a = whole(rng)
    return rng.choice(
        [
            x, f"({x} - {y})", f"({x} - {a}*{y})", f"({x} - l)", f"({x}^2 - l^2)",
            f"({x}^2 + {y}^2 - l^2)", f"({y} - {x}^2)", f"({x} + {a}*{y})", f"(1 + {x}^2)",
            f"({x} - a*{y})", f"exp({y})", f"({x} - 2*l)",
        ]
    )  # fmt: skip


def factored_pairs(rng: Random) -> System:
    """Two constraints that have several factors each: the rank differs from branch to branch."""
    names = rng.choice(["xy", "xyz", "xyz", "xyzu"])
    constraints = {
        f"c{i}": "*".join(_factor(rng, names) for _ in range(rng.choice([1, 2, 2, 2, 3]))) + " = 0"
        for i in range(2)
    }
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "l", free=("a", "b")),
        T=rng.choice([kinetic(names), kinetic(names) + " + m*x^2*y'^2/2"]),
        V=potential(rng, names),
        constraints=constraints,
        symmetries={"r": {"x": "-y", "y": "x"}, "s": {"x": "1", "y": str(whole(rng))}},
    )


def timed_redundant(rng: Random) -> System:
    """Moving constraints, one of them twice: with a factor, differentiated, or combined."""
    f, df = rng.choice(
        [
            ("x - a*y - b*t", "x' - a*y' - b"),
            ("x^2 + y^2 - (l + b*t)^2", "x*x' + y*y' - b*(l + b*t)"),
            ("y - a*x^2 - sin(w*t)", "y' - 2*a*x*x' - w*cos(w*t)"),
            ("x*cos(w*t) + y*sin(w*t) - l", "(x' + w*y)*cos(w*t) + (y' - w*x)*sin(w*t)"),
            ("x*y - l^2*exp(t)", "x'*y + x*y' - l^2*exp(t)"),
        ]
    )
    other = rng.choice(["z - b*x", "z - x*y", "z - a*t", "x + z - l*t"])
    factor = rng.choice(["(1 + z^2)", "exp(x)", "(2 + cos(t))", "m", number(rng)])
    twice = rng.choice(
        [f"{factor}*({df})", f"{factor}*({f})", f"({f}) + {factor}*({other})", f"({df})*{factor}"]
    )
    constraints = [f"{f} = 0", f"{other} = 0", f"{twice} = 0"]
    rng.shuffle(constraints)
    return System(
        coordinates=dict.fromkeys("xyz"),
        parameters=parameters("m", "k", "g", "l", "w", free=("a", "b")),
        T=kinetic("xyz"),
        V=potential(rng, "xyz"),
        constraints={f"c{i}": text for i, text in enumerate(constraints)},
    )


def gauged_transport(rng: Random) -> System:
    """A field that is invariant, in other coordinates, with dG/dt added to L and a gauge to find."""
    X, Y, back, assumed = plane_map(rng, "u", "v")
    V, symmetry, kept = rng.choice(
        [
            ("k*Y^2/2", ("1", "0"), True),
            ("k*(X^2 + Y^2)/2", ("-Y", "X"), True),
            ("g*X + k*Y^2", ("1", "0"), True),  # a uniform force: gauge -g t
            ("g*X", ("t", "0"), True),
            ("k*(X - Y)^2", ("1", "1"), True),
            ("k*X*Y", ("1", "0"), False),
            ("k*X^2*Y", ("-Y", "X"), False),
            ("k*X^2/2 + g*Y", ("0", "t"), True),
        ]
    )
    field = rng.choice(["0", "0", "b*(X*Y' - Y*X')"])
    if field != "0" and symmetry[1 if symmetry[0] == "t" else 0] == "0" and "t" in symmetry:
        field = "0"  # a boost is none in a magnetic field
    _, dG = gauge(rng, "u", "v")
    return System(
        coordinates=assumed,
        parameters=parameters("m", "k", "g", free=("b",)),
        definitions={"X": X, "Y": Y},
        L=f"m*(X'^2 + Y'^2)/2 - ({V}) + {field} + {dG}",
        symmetries={"s": dict(zip("uv", back(*symmetry), strict=True))},
        sections=("equations", "momenta", "energy", "charges"),
        known={"conserved": {"s": kept}},
    )


def open_functions(rng: Random) -> System:
    """Unspecified functions in T, V, fields, constraints and candidates."""
    T = rng.choice(
        [kinetic("xy"), "m*(x'^2 + U(x)^2*y'^2)/2", "m*(x'^2 + y'^2)/2 + m*U(y)*x'*y'/9",
         "m*(1 + U'(x)^2)*x'^2/2 + m*y'^2/2"]
    )  # fmt: skip
    V = rng.choice(
        ["U(x)", "W(x, y)", "U(x - y)", "U(x^2 + y^2)", "W(x, t)", "y*U(x)", "U(U(x)) + g*y"]
    )
    field = rng.choice(
        ["0", "0", "U(x)*y'", "diff(W, 1)(x, y)*x' + diff(W, 2)(x, y)*y'", "t*U(x)*x'"]
    )
    made = System(
        coordinates=dict.fromkeys("xy"),
        parameters=parameters("m", "k", "g", "l", free=("a", "b")),
        functions={"U": ["s"], "W": ["u", "s"]},
        L=f"{T} - ({V}) + {field}",
        symmetries={
            "s": rng.choice([{"x": "1", "y": "1"}, {"y": "1"}, {"x": "-y", "y": "x"}]),
            "h": {"x": rng.choice(["U(x)", "t", "U(t)", "exp(a*t)"])},
        },
        sections=MAIN + (CANONICAL if rng.random() < 0.5 else ()),
    )
    if rng.random() < 0.4:
        made.constraints = {
            "c1": rng.choice(["y = U(x)", "x' = U(y)*y'", "U(x) + y = b*t", "y = x*U(t)"])
        }
    return made


def transformed_hamiltonian(rng: Random) -> System:
    """A free particle, an oscillator or a fall, by its H after a canonical point transformation."""
    V = rng.choice(["0", "k*(X^2 + Y^2)/2", "g*X", "k*X^2/2 + g*Y", "k*(X - Y)^2/2"])
    X, Y, momenta = rng.choice(
        [
            ("u + v", "u - v", ("(p_u + p_v)/2", "(p_u - p_v)/2")),
            ("2*u", "v + 3*u", ("(p_u - 3*p_v)/2", "p_v")),
            ("u", "v - a*u^2", ("p_u + 2*a*u*p_v", "p_v")),
            ("u + sin(v)", "v", ("p_u", "p_v - cos(v)*p_u")),
            ("u", "v + b*t", ("p_u", "p_v")),
        ]
    )
    G = rng.choice([("0", "0"), ("v", "u"), ("2*u", "0"), ("cos(u)", "0")])  # dG/du, dG/dv
    P = [p.replace("p_u", f"(p_u - {G[0]})").replace("p_v", f"(p_v - {G[1]})") for p in momenta]
    drift = f" - b*(p_v - {G[1]})" if "t" in Y else ""
    potential_ = V.replace("X", f"({X})").replace("Y", f"({Y})")
    return System(
        coordinates=dict.fromkeys("uv"),
        parameters=parameters("m", "k", "g", free=("a", "b")),
        H=f"(({P[0]})^2 + ({P[1]})^2)/(2*m) + {potential_}{drift}",
        sections=MAIN + CANONICAL,
    )


def bound_modes(rng: Random) -> System:
    """Oscillators of known frequencies, one coordinate tied to them by a constraint that is level."""
    k1, k2 = rng.sample([1, 2, 3, 5, 7], 2)
    a, b = whole(rng), whole(rng)
    tie = rng.choice([f"{a}*u + {b}*v", f"{a}*u + u*v", f"sin(u) + {b}*v", f"{b}*v + v^3"])
    curve = rng.choice([f"z = {tie}", f"z - ({tie}) = 0", f"exp(z - ({tie})) = 1"])
    made = System(
        coordinates=dict.fromkeys("uvz"),
        parameters=parameters("m", "k"),
        T="m*(u'^2 + v'^2)/2",
        V=f"k*({k1}*u^2 + {k2}*v^2)/2",
        constraints={"c1": curve},
        sections=("equilibria", "modes"),
    )
    made.known = {
        "equilibria": [{"u": "0", "v": "0", "z": "0"}],
        "at": {"u": "0", "v": "0", "z": "0"},
        "frequencies_squared": [f"{k1}*k/m", f"{k2}*k/m"],
    }
    return made


KINDS = {
    function.__name__: function
    for function in (
        factored_pairs, timed_redundant, gauged_transport, open_functions,
        transformed_hamiltonian, bound_modes,
    )
}  # fmt: skip
