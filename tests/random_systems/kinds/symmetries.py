"""Symmetries carried to new coordinates, with a random gauge; near misses; unspecified functions."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import MAIN, System

from .draw import gauge, kinetic, number, parameters, plane_map, whole

FORMS = ("k*{u}", "k*{u}^2/2", "k*cos({u})", "k*exp({u})", "k/(1 + {u}^2)", "k*{u}^3 - b*{u}")
OF_RADIUS = ("k*{u}/2", "k*{u}^2", "-k/sqrt({u})", "k*log({u})", "k/{u}", "k*exp(-{u})")


def _plain(rng: Random):
    """V and vectors (xi_X, xi_Y, tau) of X, Y under which the action stays as it is."""
    a, b = whole(rng), whole(rng)
    choice = rng.randint(0, 6)
    if choice == 0:
        V = rng.choice(FORMS).format(u=f"({b}*X - ({a})*Y)")
        return V, [(str(a), str(b), "0")]
    if choice == 1:
        return rng.choice(OF_RADIUS).format(u="(X^2 + Y^2)"), [("-Y", "X", "0")]
    if choice == 2:
        return "m*g*X + k*Y^2", [("1", "0", "0"), ("t", "0", "0")]
    if choice == 3:
        return "0", [("t", str(a), "0"), ("-Y", "X", "0"), ("X", "Y", "2*t"), ("t*X", "t*Y", "t^2")]
    if choice == 4:
        return "k/(X^2 + Y^2)", [("X", "Y", "2*t"), ("t*X", "t*Y", "t^2"), ("-Y", "X", "0")]
    if choice == 5:
        return "m*w^2*(X^2 + Y^2)/2", [
            ("cos(w*t)", "0", "0"), ("0", "sin(w*t)", "0"), ("-Y", "X", "0"),
        ]  # fmt: skip
    return "m*g*X", [("1", "0", "0"), ("0", "1", "0"), ("0", "t", "0")]


def _carried(rng: Random, V, vectors, *, explicit: bool) -> System:
    """The system in new coordinates x, y with dG/dt added."""
    X, Y, back, assumed = plane_map(rng, "x", "y")
    _, rate = gauge(rng, "x", "y") if rng.random() < 0.7 else ("0", "0")
    made = System(
        coordinates=assumed,
        parameters=parameters("m", "k", "g", "w", free=("b",)),
        definitions={"X": X, "Y": Y},
        L=f"m*(X'^2 + Y'^2)/2 - ({V}) + {rate}",
    )
    for i, (first, second, tau) in enumerate(vectors):
        x, y = back(first, second)
        change = {"x": x, "y": y} | ({"t": tau} if tau != "0" else {})
        made.symmetries[f"s{i}"] = {
            name: _put_in(text, X, Y) if explicit else text for name, text in change.items()
        }
    return made


def _put_in(text, X, Y):
    return text.replace("X", f"({X})").replace("Y", f"({Y})")


def transported(rng: Random) -> System:
    """Conserved by construction."""
    V, vectors = _plain(rng)
    chosen = rng.sample(vectors, rng.randint(1, min(2, len(vectors))))
    made = _carried(rng, V, chosen, explicit=rng.random() < 0.5)
    made.known["conserved"] = dict.fromkeys(made.symmetries, True)
    return made


def near_miss(rng: Random) -> System:
    """A term in V, a factor in the vector or a force that breaks it: not conserved."""
    V, vectors = _plain(rng)
    how = rng.choice(["vector", "force", "potential"])
    first, second, tau = rng.choice(vectors)
    if how == "vector" and tau == "0":
        first, second = f"({first}) + Y^2", f"({second}) + X*Y"
    if how == "potential" or (how == "vector" and tau != "0"):
        V = f"{V} + k*X^3*Y + k*X*Y^2*(X - 2*Y) + k*Y^3"
    made = _carried(rng, V, [(first, second, tau)], explicit=rng.random() < 0.5)
    if how == "force":
        made.forces = {"x": "k*x*y'", "y": "-k*x*x' + g*x^2"}
    made.known["conserved"] = {"s0": False}
    return made


def one_dimension(rng: Random) -> System:
    """L = m x'^2/2 + x' F(x) under displacements xi(x): the gauge is a quadrature."""
    F = rng.choice(
        ["x*exp(-x^2)", "cos(x)", "x^3", "atan(x)", "x^2*sin(x)", "exp(x)*cos(x)", "1/(1 + x^2)",
         "sqrt(1 + x^2)", "log(1 + x^2)", "tanh(x)", "exp(-x^2)", "sin(x)/(2 + cos(x))"]
    )  # fmt: skip
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", free=("a", "b")),
        L=f"m*(x'^2 + y'^2)/2 + a*x'*({F}) + b*y'*x*0",
        symmetries={"shift": {"x": "1"}, "along": {"x": "1", "y": str(whole(rng))}},
    )
    made.L = f"m*(x'^2 + y'^2)/2 + a*x'*({F})"
    made.known["conserved"] = {"shift": True, "along": True}
    if rng.random() < 0.4:
        made.L += " - k*x*y"
        made.known["conserved"] = {"shift": False, "along": False}
    return made


def unspecified(rng: Random) -> System:
    """Functions that are left open."""
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", free=("a", "b")),
        functions={"U": ["u"], "F": ["s"], "W": ["u", "s"]},
        T=kinetic(("x", "y")),
    )
    a, b = whole(rng), whole(rng)
    turn = {"x": "-y", "y": "x"}
    along = {"x": str(a), "y": str(b)}
    V, symmetry, conserved = rng.choice(
        [
            ("U(x^2 + y^2)", turn, True),
            ("U(sqrt(x^2 + y^2))", turn, True),
            (f"U({b}*x - ({a})*y)", along, True),
            (f"W({b}*x - ({a})*y, t)", along, True),
            (f"U({b}*x - ({a})*y) - m*F(t)*({a}*x + ({b})*y)", along, None),
            ("W(x^2 + y^2, t)", turn, True),
            ("W(x, y)", turn, False),
            ("U(x) + F(y)", along, False),
            ("U(x*y)", {"x": "x", "y": "-y"}, False),
            (f"W(x + y, x - y) + {number(rng)}*x", along, False),
        ]
    )
    made.V, made.symmetries = V, {"s": symmetry}
    if rng.random() < 0.4:
        made.T = None
        made.L = f"m*(x'^2 + y'^2)/2 - ({V}) + " + rng.choice(
            ["x'*U'(x)", "F(t)*0 + y'*F(y)", "x'*U(y) + x*y'*U'(y)", "2*x*F'(x^2)*x'"]
        )
        made.V = None
    if conserved is not None:
        made.known["conserved"] = {"s": conserved}
    made.sections = MAIN + (("hamiltonian", "canonical_equations") if rng.random() < 0.5 else ())
    return made


def found_alone(rng: Random) -> System:
    """Charges that nobody asked about, in linear or polar coordinates."""
    a, b = whole(rng), whole(rng)
    V, charges = rng.choice(
        [
            ("k*(x^2 + y^2)/2", ["x*y' - y*x'", "m*x'^2/2 + k*x^2/2"]),
            ("-k/sqrt(x^2 + y^2)", ["x*y' - y*x'", "y'*(x*y' - y*x') - k*x/(m*sqrt(x^2 + y^2))"]),
            (f"k*({b}*x - ({a})*y)^2", [f"({a})*x' + ({b})*y'"]),
            ("m*g*y", ["x'", "y' + g*t", "x'*t - x"]),
            ("k*x^2/2", ["y'", "y - t*y'"]),
            ("k/(x^2 + y^2)", ["x*y' - y*x'"]),
            ("k*(4*x^2 + y^2)/2", ["m*y'^2 + k*y^2", "m*x'^2 + 4*k*x^2"]),
            ("k*x^4", ["y'"]),
        ]
    )
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g"),
        T=kinetic(("x", "y")),
        V=V,
        sections=("accelerations", "charges", "energy", "discovered"),
        known={"discovered": charges},
    )


KINDS = {
    function.__name__: function
    for function in (transported, near_miss, one_dimension, unspecified, found_alone)
}
