"""Random systems with numbers, as text: every kind of force, constraint and coordinate."""

from __future__ import annotations

import random
from collections.abc import Callable
from fractions import Fraction

Source = random.Random
Matrix = list[list[Fraction]]


def _number(source: Source, least: int = -9, most: int = 9) -> Fraction:
    return Fraction(source.randint(least, most), source.choice((2, 3, 4, 5)))


def _symmetric(source: Source, n: int) -> Matrix:
    half = [[_number(source) for _ in range(n)] for _ in range(n)]
    return [[half[min(i, j)][max(i, j)] for j in range(n)] for i in range(n)]


def _positive(source: Source, n: int, rank: int | None = None) -> Matrix:
    """B^T B with B of this rank, and the unit matrix added where it is full."""
    rows = [[_number(source, -3, 3) for _ in range(n)] for _ in range(rank or n)]
    one = Fraction(0 if rank else 1)
    return [[sum((r[i] * r[j] for r in rows), one * (i == j)) for j in range(n)] for i in range(n)]


def _form(matrix: Matrix, left: list[str], right: list[str]) -> str:
    parts = [
        f"({entry})*{a}*{b}"
        for a, row in zip(left, matrix, strict=True)
        for b, entry in zip(right, row, strict=True)
        if entry
    ]
    return " + ".join(parts) or "0"


def _names(n: int) -> tuple[list[str], list[str]]:
    q = ["x", "y", "z"][:n]
    return q, [name + "'" for name in q]


def linear(source: Source) -> str:
    """Springs of either sign, gyroscopic terms, dampers, follower forces."""
    n = source.randint(1, 3)
    q, v = _names(n)
    T, V = _form(_positive(source, n), v, v), _form(_symmetric(source, n), q, q)
    if source.random() < 0.5:
        V = _form(_positive(source, n), q, q)
    L = f"({T})/2 - ({V})/2"
    if n > 1 and source.random() < 0.5:
        L += f" + {_number(source)}*(x*y' - y*x')"
    text = f"coordinates: [{', '.join(q)}]\nL: {L}\n"
    if source.random() < 0.5:
        rank = source.choice((None, 1)) if n > 1 else None
        text += f"dissipation: ({_form(_positive(source, n, rank), v, v)})/2\n"
    if n > 1 and source.random() < 0.3:
        text += f"forces: {{x: {_number(source)}*y, y: {_number(source)}*x}}\n"
    return text


def polynomial(source: Source) -> str:
    """One or two coordinates in a potential of fourth degree, drag of third or van der Pol's."""
    V = " + ".join(f"({_number(source)})*x^{k}" for k in range(2, 4)) + " + x^4/4"
    force = source.choice(("0", "-x'^3", "x'^3", "(1 - x^2)*x'", "-2*(1 + x^2)*x'", "-x'*abs(x')"))
    return f"coordinates: [x]\nT: (1 + x^2)*x'^2/2\nV: {V}\nforces: {{x: {force}}}\n"


def pendulums(source: Source) -> str:
    """A double pendulum with springs, dampers and a couple, on a turning axis or not."""
    m, w, k, b = (_number(source, 1, 9) for _ in range(4))
    damped = source.choice(("0", f"{b}*a'^2", f"{b}*(a'^2 + (b' - a')^2)"))
    turning = source.choice(("0", f"{w}^2*sin(a)^2/2"))
    return (
        "coordinates: [a, b]\n"
        f"T: (1 + {m})*a'^2/2 + {m}*b'^2/2 + {m}*a'*b'*cos(a - b)\n"
        f"V: -(1 + {m})*cos(a) - {m}*cos(b) + {k}*(1 - cos(a - b)) - {turning}\n"
        f"dissipation: ({damped})/2\n"
    )


def hoop(source: Source) -> str:
    """A bead on a hoop that turns, with friction and a force along it."""
    w, b, F = (_number(source, 1, 9) for _ in range(3))
    friction = source.choice(("0", f"-{b}*a'", "-a'^3", f"{b}*a'"))
    push = source.choice(("0", f"{F}", f"{F}*cos(a)"))
    return (
        f"coordinates: [a]\nT: (a'^2 + {w}^2*sin(a)^2)/2\nV: -cos(a)\n"
        f"forces: {{a: {friction} + {push}/20}}\n"
    )


def surface(source: Source) -> str:
    """A bead on z = f(x, y), with its multiplier or without."""
    f = f"({_form(_symmetric(source, 2), ['x', 'y'], ['x', 'y'])})/2 + x^3/3"
    drag = source.choice(("0", "x'^2 + y'^2", "x'^2"))
    head = f"coordinates: [x, y, z]\nT: (x'^2 + y'^2 + z'^2)/2\nV: z\ndissipation: {drag}\n"
    return head + f"constraints: {{surface: z = {f}}}\n"


def central(source: Source) -> str:
    """A power law, an oblate disk, a spherical pendulum: orbits and circles."""
    n = source.choice((-3, -2, -1, 1, 2, 3, 4))
    k = source.choice((1, 1, -1)) * (1 if n > 0 else -1)
    wall = source.choice(("0", "z^2", "z^2*r", "-z^2/4"))
    if source.random() < 0.5:
        T, V, q = "(r'^2 + r^2*phi'^2)/2", f"{k}*r^({n})", "phi: {}"
    else:
        T, V = "(r'^2 + r^2*phi'^2 + z'^2)/2", f"{k}*r^({n}) + {wall}"
        q = "phi: {}, z: {}"
    return f"coordinates: {{r: {{assume: positive}}, {q}}}\nT: {T}\nV: {V}\n"


def rolling(source: Source) -> str:
    """Constraints on velocities that cannot be integrated, with springs and dampers."""
    a, b = _number(source, 1, 9), _number(source, -5, 5)
    V = f"({_form(_positive(source, 3) if source.random() < 0.6 else _symmetric(source, 3), *[['x', 'y', 'z']] * 2)})/2"
    if source.random() < 0.3:
        V = f"({_form(_symmetric(source, 2), *[['x', 'y']] * 2)})/2"
    drag = source.choice(("0", "x'^2 + y'^2 + z'^2", "x'^2"))
    return (
        "coordinates: [x, y, z]\n"
        f"T: (x'^2 + {a}*y'^2 + z'^2)/2\nV: {V}\ndissipation: {drag}\n"
        f"constraints: {{blade: z' = y*x' + {b}*y'}}\n"
    )


def contact(source: Source) -> str:
    """Springs beside a wall or a floor that is struck."""
    k, c, g = _number(source, 1, 9), _number(source), _number(source)
    e = source.choice(("0", "1/2", "1"))
    b = source.choice(("0", "x'^2", "x'^2 + y'^2"))
    return (
        "coordinates: [x, y]\nT: (x'^2 + y'^2)/2\n"
        f"V: {k}*(x - {c})^2/2 + ({g})*y + y^2/2 + x^2*y/5\ndissipation: {b}\n"
        f"contacts: {{wall: {{gap: x + y/3 >= 0, restitution: {e}}}}}\n"
    ).replace("- -", "+ ")


def friction(source: Source) -> str:
    """Dry friction in one of two coordinates, or between them."""
    k, c, f = _number(source, 1, 9), _number(source), _number(source, 1, 4)
    K = source.choice((1, 2, -1))
    if source.random() < 0.5:
        forces = f"{{x: -{f}*sign(x')}}"
    else:
        forces = f"{{x: -{f}*sign(x' - y'), y: {f}*sign(x' - y')}}"
    return (
        f"coordinates: [x, y]\nT: (x'^2 + 2*y'^2)/2\n"
        f"V: {k}*x^2/2 + {K}*(y - {c})^2/2 + x*y/5\nforces: {forces}\n"
    ).replace("- -", "+ ")


def turning(source: Source) -> str:
    """A particle in a turning frame, in a trap or on a saddle, with drag in the frame or outside."""
    w, a, b = _number(source, 1, 9), _number(source), _number(source)
    d = _number(source, 1, 3)
    drag = source.choice(("0", f"{d}*(x'^2 + y'^2)/2", f"{d}*((x' - {w}*y)^2 + (y' + {w}*x)^2)/2"))
    cubic = source.choice(("0", "(x^2 + y^2)^2"))
    return (
        f"coordinates: [x, y]\nT: ((x' - {w}*y)^2 + (y' + {w}*x)^2)/2\n"
        f"V: ({a})*x^2/2 + ({b})*y^2/2 + {cubic}\ndissipation: {drag}\n"
    )


KINDS: tuple[Callable[[Source], str], ...] = (
    linear, polynomial, pendulums, hoop, surface, central, rolling, contact, friction, turning,
)  # fmt: skip


def system(seed: int) -> str:
    """The text of one random system; the kinds take turns."""
    text = KINDS[seed % len(KINDS)](random.Random(f"system {seed}"))
    undamped = ("dissipation: 0\n", "dissipation: (0)/2\n")
    return "".join(line for line in text.splitlines(keepends=True) if line not in undamped)
