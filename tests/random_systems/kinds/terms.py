"""Roots of the velocity, masses that grow, units, names, maps of the plane."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import kinetic, number, parameters, plane_map, polynomial, potential


def relativistic(rng: Random) -> System:
    """Roots of the velocity."""
    names = rng.choice([("x",), ("x", "y")])
    square = " + ".join(f"{name}'^2" for name in names)
    if names == ("x", "y") and rng.random() < 0.4:
        square = "x'^2 + (1 + x^2)*y'^2"
    V = rng.choice(["k*x^2/2", "g*x", "0", f"k*({polynomial(rng, names, 2)})"])
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "c", free=("b",)),
        L=f"-m*c^2*sqrt(1 - ({square})/c^2) - ({V})" + rng.choice(["", "", f" + b*x*{names[-1]}'"]),
        symmetries={"s": {"x": "1"}},
        sections=MAIN + CANONICAL,
        known={"slow": "0.12"},
    )


def growing_mass(rng: Random) -> System:
    """Masses and springs that depend on the time."""
    f = rng.choice(["exp(b*t)", "(1 + t)", "(1 + a^2*t^2)", "(2 + cos(w*t))", "t^2", "1/(1 + t)"])
    names = rng.choice([("x",), ("x", "y")])
    made = System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "w", free=("a", "b")),
        L=f"{f}*({kinetic(names)} - ({potential(rng, names)}))",
        sections=MAIN + CANONICAL,
    )
    if rng.random() < 0.5:
        made.L = (
            f"exp(b*t)*(m*x'^2/2 - k*x^2/2){'' if names == ('x',) else ' + m*y' + chr(39) + '^2/2'}"
        )
        made.symmetries = {"s": {"t": "1", "x": "-b*x/2"}}
        made.known["conserved"] = {"s": names == ("x",) or None}
        if names != ("x",):
            made.known = {"conserved": {"s": True}}
    return made


def units(rng: Random) -> System:
    """Decimals, values and units."""
    c = rng.choice(["0.5", "1.25", "0.1", "2.", "1e-1", "0.333", "12.5e-2"])
    made = System(
        coordinates={"x": None, "theta": None},
        parameters={
            "m": "positive",
            "M": "positive",
            "l": "positive",
            "g": "positive",
            "k": "positive",
        },
        units={"x": "m", "theta": "rad", "m": "kg", "M": "kg", "l": "m", "g": "m/s^2", "k": "N/m"},
        values={"M": rng.choice(["3*m", "2.5*m"])} if rng.random() < 0.3 else {},
        T=f"M*x'^2/2 + {c}*m*(x'^2 + l^2*theta'^2 + 2*l*x'*theta'*cos(theta))",
        V=f"-{c}*m*g*l*cos(theta)" + rng.choice(["", " + k*x^2/2", f" + {c}*k*x^2"]),
        sections=MAIN + CANONICAL,
    )
    made.parameters["M"] = "positive"
    if rng.random() < 0.4:
        made.constraints = {"c1": rng.choice(["x = l*theta", f"x = {c}*l*sin(theta)", "x = l"])}
    made.symmetries = {"s": {"x": "l"}}
    return made


def names(rng: Random) -> System:
    """Names that mean something to other programs, and long ones."""
    pool = ["I", "E", "S", "N", "Q", "O", "C", "lambda", "beta", "gamma", "zeta", "e", "i", "pi_1",
            "GF", "oo", "zoo", "nan", "true", "None", "print", "D", "d", "Ω", "λ", "φ", "theta_1",
            "x1", "x_1", "alpha_beta_gamma", "the_position_of_the_first_body", "H", "T_", "V_",
            "Q1", "p", "q", "h", "delta", "Delta_t", "f", "in_", "and_", "s1", "s2", "u"]  # fmt: skip
    rng.shuffle(pool)
    x, y, m, k, g = pool[:5]
    made = System(
        coordinates={x: None, y: None},
        parameters={m: "positive", k: "positive", g: None},
        T=f"{m}*({x}'^2 + {y}'^2)/2 + {m}*{x}'*{y}'*cos({x})/3",
        V=f"{k}*{x}^2/2 + {g}*{x}*{y} + {k}*cos({y})",
        sections=MAIN + CANONICAL,
    )
    if rng.random() < 0.5:
        made.constraints = {
            pool[5]: rng.choice([f"{y} = {g}*{x}", f"{x}^2 + {y}^2 = 1", f"{x}' = {y}*{y}'"])
        }
    if rng.random() < 0.3:
        made.functions = {pool[6]: ["u"]}
        made.V += f" + {pool[6]}({x} - {y})"
    made.symmetries = {pool[7]: {x: "1", y: "1"}}
    return made


def curved(rng: Random) -> System:
    """Points on maps of the plane, with forces of every sort: formulas of some length."""
    X, Y, _, assumed = plane_map(rng, "x", "y")
    return System(
        coordinates=assumed,
        parameters=parameters("m", "k", "g", free=("a", "b")),
        points={"P": ([X, Y], "m"), "Q1": (["x", "y"], "2*m")}
        if rng.random() < 0.4
        else {"P": ([X, Y], "m")},
        V=potential(rng, ("x", "y")),
        forces=rng.choice([{}, {"x": f"a*x' + ({number(rng)})*y"}, {"y": "b*t*x'"}]),
        sections=MAIN + CANONICAL,
    )


KINDS = {
    function.__name__: function for function in (relativistic, growing_mass, units, names, curved)
}
