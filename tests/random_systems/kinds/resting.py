"""Equilibria and small oscillations that are known by construction."""

from __future__ import annotations

from random import Random

from tests.random_systems.system import REST, System

from .draw import kinetic, number, parameters, whole

SECTIONS = ("accelerations", "energy", *REST)


def _matrix(rng: Random, n):
    """A random integer matrix that can be inverted: a triangle times a triangle."""
    low = [
        [1 if i == j else rng.randint(-1, 1) if i > j else 0 for j in range(n)] for i in range(n)
    ]
    up = [[1 if i == j else rng.randint(-1, 1) if i < j else 0 for j in range(n)] for i in range(n)]
    return [[sum(low[i][k] * up[k][j] for k in range(n)) for j in range(n)] for i in range(n)]


def modes_linear(rng: Random) -> System:
    """Free oscillators under a linear map: the frequencies are those of the oscillators."""
    n = rng.choice([2, 2, 3])
    names = ("x", "y", "z")[:n]
    S = _matrix(rng, n)
    forms = ["(" + " + ".join(f"({S[i][j]})*{names[j]}" for j in range(n)) + ")" for i in range(n)]
    rates = [form.replace("x", "x'").replace("y", "y'").replace("z", "z'") for form in forms]
    squares = [rng.choice(["1", "2", "3", "4", "3/2", "1/4"]) for _ in range(n)]
    if rng.random() < 0.3:
        squares[1] = squares[0]
    return System(
        coordinates=dict.fromkeys(names),
        parameters=parameters("m", "k"),
        T="m*(" + " + ".join(f"{rate}^2" for rate in rates) + ")/2",
        V="k*(" + " + ".join(f"({w})*{f}^2" for w, f in zip(squares, forms, strict=True)) + ")/2",
        sections=SECTIONS,
        known={
            "at": dict.fromkeys(names, "0"),
            "equilibria": [dict.fromkeys(names, "0")],
            "frequencies_squared": [f"({w})*k/m" for w in squares],
        },
    )


def modes_bent(rng: Random) -> System:
    """The same under a map that is not linear, with the identity at the origin."""
    a, b = number(rng), number(rng)
    X, Y = rng.choice(
        [
            (f"x + ({a})*y^2", f"y + ({b})*x*y"),
            ("sin(x)", f"y + ({a})*x^2"),
            (f"x*exp({a}*y)".replace("--", "+"), f"y + ({b})*x^3"),
            ("tan(x)", f"y - ({a})*x^2"),
            ("sinh(x)", f"y + ({b})*sinh(x)^2"),
            ("x", f"y + ({a})*(cos(x) - 1)"),
        ]
    )
    first, second = rng.choice(["1", "2", "3/2"]), rng.choice(["1", "3", "5/2", "4"])
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k"),
        definitions={"X": X, "Y": Y},
        T="m*(X'^2 + Y'^2)/2",
        V=f"k*(({first})*X^2 + ({second})*Y^2)/2",
        sections=SECTIONS,
        known={
            "at": {"x": "0", "y": "0"},
            "equilibria": [{"x": "0", "y": "0"}],
            "frequencies_squared": [f"({first})*k/m", f"({second})*k/m"],
        },
    )


def roots_of_V(rng: Random) -> System:
    """V' is a product of known factors."""
    roots = sorted(rng.sample(range(-3, 4), rng.randint(1, 3)))
    c = number(rng)
    # V = c int prod (x - r): its coefficients by hand
    coefficients = [1]
    for root in roots:
        shifted = [*coefficients, 0]
        for i, each in enumerate(coefficients):
            shifted[i + 1] -= root * each
        coefficients = shifted
    top = len(coefficients)
    V = " + ".join(f"({each})*x^{top - i}/{top - i}" for i, each in enumerate(coefficients))
    y = rng.choice(["k*y^2/2", "k*(y - x)^2/2", "k*(y + x^2)^2/2", "-k*y^2/2"])
    rest_y = {"k*(y - x)^2/2": str, "k*(y + x^2)^2/2": lambda r: f"-{r * r}"}
    made = System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "c"),
        T=rng.choice(
            [kinetic("xy"), "m*(x'^2 + y'^2 + x'*y'*cos(x))/2", "m*(1 + x^2)*x'^2/2 + m*y'^2"]
        ),
        V=f"k*({c})*({V}) + {y}",
        sections=SECTIONS,
    )
    made.dissipation = rng.choice([None, None, "c*x'^2/2", "c*(x'^2 + y'^2)/2"])
    made.known["equilibria"] = [{"x": str(r), "y": rest_y.get(y, lambda _: "0")(r)} for r in roots]
    return made


def turning(rng: Random) -> System:
    """Trigonometric potentials, hoops, pendulums in fields."""
    V, T = rng.choice(
        [
            ("k*cos(x) + g*cos(y)", None),
            ("k*(cos(x) + cos(y) + cos(x + y))", None),
            ("-g*cos(x) - k*cos(x - y)", None),
            ("k*sin(x)^2 + g*cos(y)", None),
            ("g*cos(x) + k*cos(2*x)/3 + y^2", None),
            ("-m*g*cos(x) + k*y^2/2", "m*(x'^2 + sin(x)^2*w^2 + y'^2)/2"),
            ("k*sin(x)*sin(y)", None),
            ("k*(cos(x) - cos(y))", None),
            ("g*sin(x) + k*(y - x)^2/2", None),
            ("k*x*sin(x) + y^2", None),
            ("-k*cos(x)*cos(y) + g*sin(x)", None),
        ]
    )
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", "w"),
        T=T or kinetic("xy"),
        V=V,
        sections=SECTIONS,
        known={"search": True},
    )


def polynomial_rest(rng: Random) -> System:
    """Potentials of low degree, of several roots, with friction and gyroscopic terms."""
    V = rng.choice(
        [
            "k*(x^2 - 1)^2/4 + g*y^2/2",
            "k*x^2*y^2/2 + g*(x^2 + y^2)/2",
            "k*(x^2 + y^2)^2/4 - g*(x^2 + y^2)/2",
            "k*x^3/3 - g*x + y^2",
            "k*(x^2 + y^2)/2 + a*(x^2*y - y^3/3)",
            "k*x^4/4 - a*x^2/2 + k*y^2",
            "x*abs(x)*k + y^2",
            "k*abs(x) + y^2",
            "k*(x*y - 1)^2/2 + g*(x - y)^2/2",
            "-k*x^2/2 - k*y^2/2",
            "k*exp(x) - g*x + y^2/2",
            "k*x^2 + a*x*y + g*y^2",
            "k/x + g*x + y^2",
            "k*(x - y)^2/2",
            "k*(x^4 + y^4)/4",
            "k*x^2*y^2",
        ]
    )
    made = System(
        coordinates={"x": "positive" if "/x" in V else None, "y": None},
        parameters=parameters("m", "k", "g", "c", free=("a", "b")),
        L=f"m*(x'^2 + y'^2)/2 - ({V})",
        sections=SECTIONS,
        known={"search": True},
    )
    if rng.random() < 0.3:
        made.L += " + b*(x*y' - y*x')"
    if rng.random() < 0.3:
        made.dissipation = rng.choice(["c*x'^2/2", "c*(x'^2 + y'^2)/2", "-c*y'^2/2"])
    return made


def held_rest(rng: Random) -> System:
    """Equilibria on a curve or a surface."""
    constraint, V = rng.choice(
        [
            ("x^2 + y^2 = l^2", "m*g*y"),
            ("x^2 + y^2 = l^2", "m*g*y + k*x^2/2"),
            ("y = a*x^2", "m*g*y"),
            ("y = cos(x)", "m*g*y"),
            ("y = x^3 - 3*x", "m*g*y"),
            ("x*y = 1", "m*g*(x + y)"),
            ("x + y = l", "k*x^2/2 + g*y^2/2"),
            ("x^2/4 + y^2 = l^2", "k*(x^2 + y^2)/2"),
            ("y = x^2 - 1", "k*(x^2 + y^2)/2"),
            ("x^2 + y^2 = l^2", "k*x*y"),
        ]
    )
    return System(
        coordinates={"x": None, "y": None},
        parameters=parameters("m", "k", "g", "l", free=("a",)),
        T=kinetic("xy", off=""),
        V=V + rng.choice(["", "", f" + {abs(whole(rng))}*k*y^2/10"]),
        constraints={"c1": constraint},
        sections=SECTIONS,
        known={"search": True},
    )


KINDS = {
    function.__name__: function
    for function in (modes_linear, modes_bent, roots_of_V, turning, polynomial_rest, held_rest)
}
