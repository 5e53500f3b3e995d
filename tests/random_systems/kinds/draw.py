"""What the kinds draw from: coefficients, potentials, maps of the plane, gauges."""

from __future__ import annotations

from random import Random

POSITIVE = "positive"


def number(rng: Random, top: int = 4) -> str:
    """A small rational, not 0."""
    top_, bottom = rng.randint(1, top), rng.choice([1, 1, 1, 2, 3])
    return rng.choice(["", "", "-"]) + (str(top_) if bottom == 1 else f"{top_}/{bottom}")


def whole(rng: Random, top: int = 3) -> int:
    """A small integer, not 0."""
    return rng.choice([-1, 1]) * rng.randint(1, top)


def kinetic(names, mass="m", off: str = "") -> str:
    """m (x'^2 + ...)/2 and more."""
    return f"{mass}*({' + '.join(name + chr(39) + '^2' for name in names)})/2{off}"


def polynomial(rng: Random, names, degree: int = 3, terms: int = 3) -> str:
    """A sum of monomials in the names."""
    parts = []
    for _ in range(rng.randint(1, terms)):
        factors = [rng.choice(names) for _ in range(rng.randint(1, degree))]
        parts.append(f"({number(rng)})*" + "*".join(factors))
    return " + ".join(parts)


def potential(rng: Random, names) -> str:
    """Any V of the coordinates, with k and g for parameters."""
    x, y = rng.choice(names), rng.choice(names)
    return rng.choice(
        [
            f"k*({polynomial(rng, names)})",
            f"k*({x}^2 + 2*{y}^2)/2 + g*{x}",
            f"g*({whole(rng)}*{x} + {y})",
            f"k*cos({x}) + g*{y}",
            f"k*{x}*{y} + g*sin({y})",
            f"k*exp({x}/2) + g*{y}^2",
            f"k/(1 + {x}^2 + {y}^2)",
            "0",
        ]
    )


def parameters(*names, free=()) -> dict[str, str | None]:
    """Positive ones, and some of any sign."""
    return dict.fromkeys(names, POSITIVE) | dict.fromkeys(free)


def plane_map(rng: Random, x: str, y: str):
    """New coordinates x, y of the plane.

    Returns
    -------
    X, Y, back, assumed
        The Cartesian ones as formulas; `back(xi_X, xi_Y)`, the components of a vector along
        x, y; what is assumed of x and y.
    """
    a, n = number(rng), rng.randint(2, 3)
    free = {x: None, y: None}
    some = {
        "linear": (
            f"2*{x} + {y}",
            f"{x} - 3*{y}",
            lambda X, Y: (f"(3*({X}) + ({Y}))/7", f"(({X}) - 2*({Y}))/7"),
            free,
        ),
        "shear": (
            f"{x} + ({a})*{y}^{n}",
            y,
            lambda X, Y: (f"({X}) - ({a})*{n}*{y}^{n - 1}*({Y})", f"({Y})"),
            free,
        ),
        "wave": (
            f"{x} + ({a})*sin({y})",
            y,
            lambda X, Y: (f"({X}) - ({a})*cos({y})*({Y})", f"({Y})"),
            free,
        ),
        "polar": (
            f"{x}*cos({y})",
            f"{x}*sin({y})",
            lambda X, Y: (
                f"cos({y})*({X}) + sin({y})*({Y})",
                f"(cos({y})*({Y}) - sin({y})*({X}))/{x}",
            ),
            {x: POSITIVE, y: None},
        ),
        "exponential": (
            f"exp({x})",
            f"{y}*exp({x})",
            lambda X, Y: (f"({X})*exp(-{x})", f"(({Y}) - {y}*({X}))*exp(-{x})"),
            free,
        ),
        "parabolic": (
            f"({x}^2 - {y}^2)/2",
            f"{x}*{y}",
            lambda X, Y: (
                f"({x}*({X}) + {y}*({Y}))/({x}^2 + {y}^2)",
                f"({x}*({Y}) - {y}*({X}))/({x}^2 + {y}^2)",
            ),
            free,
        ),
        "cubic": (
            f"{x}^3",
            f"{y} + {x}",
            lambda X, Y: (f"({X})/(3*{x}^2)", f"({Y}) - ({X})/(3*{x}^2)"),
            {x: POSITIVE, y: None},
        ),
        "inverse": (
            f"1/{x}",
            f"{y}/{x}",
            lambda X, Y: (f"-{x}^2*({X})", f"{x}*({Y}) - {x}*{y}*({X})"),
            {x: POSITIVE, y: None},
        ),
        "hyperbolic": (
            f"sinh({x})",
            f"{y} + cosh({x})",
            lambda X, Y: (f"({X})/cosh({x})", f"({Y}) - tanh({x})*({X})"),
            free,
        ),
    }
    return some[rng.choice(sorted(some))]


def gauge(rng: Random, x: str, y: str) -> tuple[str, str]:
    """G and dG/dt, written out."""
    a = number(rng)
    some = [
        (f"{x}^2*{y}", f"2*{x}*{y}*{x}' + {x}^2*{y}'"),
        (f"sin({x}*{y})", f"cos({x}*{y})*({x}'*{y} + {x}*{y}')"),
        (f"exp(-{x}^2)", f"-2*{x}*exp(-{x}^2)*{x}'"),
        (f"atan({x} + {y})", f"({x}' + {y}')/(1 + ({x} + {y})^2)"),
        (f"{x}*log(1 + {y}^2)", f"{x}'*log(1 + {y}^2) + 2*{x}*{y}*{y}'/(1 + {y}^2)"),
        (f"t*{x}*{y}", f"{x}*{y} + t*({x}'*{y} + {x}*{y}')"),
        (f"sqrt(1 + {x}^2 + {y}^2)", f"({x}*{x}' + {y}*{y}')/sqrt(1 + {x}^2 + {y}^2)"),
        (f"exp({x})*cos(t)", f"exp({x})*(cos(t)*{x}' - sin(t))"),
        (f"{x}/(1 + {y}^2)", f"{x}'/(1 + {y}^2) - 2*{x}*{y}*{y}'/(1 + {y}^2)^2"),
        (f"{y}^3*t^2", f"3*{y}^2*{y}'*t^2 + 2*{y}^3*t"),
        (f"cos({x})*sin({y})", f"cos({x})*cos({y})*{y}' - sin({x})*sin({y})*{x}'"),
        (f"{x}^4/4", f"{x}^3*{x}'"),
    ]
    G, rate = rng.choice(some)
    return f"({a})*({G})", f"({a})*({rate})"
