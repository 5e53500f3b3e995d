"""Implicit curves, steep friction, moving kinetic energies, V of velocities, quartic Lagrangians."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import CANONICAL, MAIN, System

from .draw import gauge, kinetic, number, parameters, polynomial, potential, whole


def tied_branches(rng: Random) -> System:
    """A coordinate without inertia that an implicit equation gives, on one of its branches."""
    a, n = number(rng), rng.choice([2, 3])
    curve = rng.choice(
        ["u^3 + u = x", "u^2 = 1 + x^2", "exp(u) + u = x", "u + sin(u)/2 = x", "u^2*x = l",
         "cosh(u) = 2 + x^2", "u^2 + x*u = l", "u*abs(u) = l + x^2", f"x^2 + u^{n} = {n}*l",
         f"tan(u) = x + ({a})*y", "sin(u) = x/(2*l + x^2)", "(u - x)*(u - 2*x - l) = l^2",
         "log(u^2) = y", "u^4 - 2*u^2 = x^2 + l"]
    )  # fmt: skip
    made = System(
        coordinates=dict.fromkeys("xyu"),
        parameters=parameters("m", "k", "g", "l", free=("a", "b")),
        T=kinetic("xy") + rng.choice(["", " + m*u'^2/3", " + m*u^2*y'^2/2"]),
        V=rng.choice(["k*u^2/2", "g*u + k*x^2", "k*x*u", "g*y + k*cos(u)"]),
        constraints={"c1": curve},
        symmetries={"s": {"y": "1"}, "e": {"t": "1"}},
    )
    if rng.random() < 0.4:
        made.constraints["c2"] = rng.choice(["y = a*u", "y' = u*x'", "y^2 = l^2 + u^2"])
    return made


def steep_dissipation(rng: Random) -> System:
    """Dissipation functions that are not quadratic, on charts and along constraints."""
    made = System(
        coordinates={"x": "positive", "y": None},
        parameters=parameters("m", "k", "g", "c", "l", free=("a", "b")),
        T=rng.choice([kinetic("xy"), "m*(x'^2 + x^2*y'^2)/2", "m*(x'^2 + exp(y)*y'^2)/2"]),
        V=rng.choice(["g*x", "k*x^2/2 + g*x*y", "k*cos(y)", "k/x", "0"]),
        dissipation=rng.choice(
            ["c*abs(x')^3/3", "c*(x'^2 + x^2*y'^2)^(3/2)/3", "c*x'^4/4 + c*y'^2", "c*cosh(y')",
             "c*abs(x' - a*y')", "c*sqrt(l^2 + x'^2 + y'^2)", "c*x*abs(y')^3", "c*(x' + y')^4",
             "c*log(1 + y'^2)", "c*x^2*x'^2*y'^2"]
        ),
        symmetries={"s": {"y": "1"}, "e": {"t": "1"}},
    )  # fmt: skip
    if rng.random() < 0.4:
        made.constraints = {"c1": rng.choice(["x = l + y^2", "x' = x*y'", "x = l*exp(y)"])}
    return made


def timed_kinetic(rng: Random) -> System:
    """Masses and charts that change with the time, dG/dt added to L, y cyclic but for it."""
    f = rng.choice(["(1 + a^2*t^2)", "exp(2*b*t)", "(2 + sin(w*t))", "1/(1 + t^2)", "cosh(t)"])
    _, rate = gauge(rng, "x", "y")
    V = rng.choice(["k*x^2/2", "k*cos(x - w*t)", f"{f}*k*x", "k*x^4*exp(-b*t)", "0"])
    broken = rng.choice(["", "", " - g*y", " - k*y^2*t"])
    return System(
        coordinates=dict.fromkeys("xy"),
        parameters=parameters("m", "k", "g", "w", free=("a", "b")),
        L=f"m*(x'^2 + {f}*y'^2)/2 + m*b*t*x' - ({V}){broken} + {rate}",
        symmetries={"s": {"y": "1"}, "e": {"t": "1"}},
        sections=MAIN + CANONICAL,
        known={"conserved": {"s": broken in ("", " - g*y")}},
    )


def velocity_potentials(rng: Random) -> System:
    """V with velocities: Weber's force, magnetic terms, rotating frames."""
    return System(
        coordinates={"x": "positive", "y": None},
        parameters=parameters("m", "k", "g", "c", "w", free=("a", "b")),
        T=rng.choice([kinetic("xy"), "m*(x'^2 + x^2*y'^2)/2"]),
        V=rng.choice(
            ["k*(1 - x'^2/(2*c^2))/x", "b*x*y' + k*x^2/2", "k*x^2/2 - m*w*(x*y' - y*x')",
             "b*x^2*y'/2 + k/x", "k*x*(1 + y'^2/c^2)", "a*t*x' + g*y", "k*cos(y)*x'",
             f"({number(rng)})*x*y*x' + k*y^2", "b*sin(w*t)*x*y'", "-k*x'*y'/c + g*x"]
        ),
        symmetries={"s": {"y": "1"}, "e": {"t": "1"}},
        constraints={"c1": rng.choice(["y = a*x", "x*y' = c"])} if rng.random() < 0.25 else {},
        sections=MAIN + CANONICAL,
    )  # fmt: skip


def quartic_velocities(rng: Random) -> System:
    """L of higher degree in the velocities, whose momenta have several inverses."""
    names = rng.choice(["x", "xy"])
    b = f"({abs(whole(rng))}*k)"
    more = rng.choice(
        [f"{b}*x'^4/4", f"{b}*x^2*x'^4", f"-{b}*x'^4/4", f"{b}*x'^3", f"{b}*(x'^2 - c^2)^2",
         f"{b}*exp(x'/c)", f"{b}*x'^2*{names[-1]}'^2", f"{b}*sqrt(1 + x'^4)"]
    )  # fmt: skip
    V = rng.choice(["g*x", f"g*({polynomial(rng, names, 3)})", potential(rng, names)])
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k", "g", "c", free=("a",)),
        L=f"{kinetic(names)} + {more} - ({V})",
        symmetries={"s": {names[-1]: "1"}, "e": {"t": "1"}},
        sections=MAIN,
    )


KINDS = {
    function.__name__: function
    for function in (
        tied_branches,
        steep_dissipation,
        timed_kinetic,
        velocity_potentials,
        quartic_velocities,
    )
}
