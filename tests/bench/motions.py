"""The systems on which motions are timed: T and V as text, the state at t = 0, the span.

Rates are written with a prime, as in a problem file.
"""

from __future__ import annotations

from typing import NamedTuple


class System(NamedTuple):
    """One system; the same T and V go to every program."""

    coordinates: list[str]
    kinetic: str
    potential: str
    q: list[float]
    v: list[float]
    until: float
    accuracy: float

    def problem(self) -> str:
        """As a problem file."""
        given = [f"{name}: {x!r}" for name, x in zip(self.coordinates, self.q, strict=True)]
        given += [f"{name}': {x!r}" for name, x in zip(self.coordinates, self.v, strict=True)]
        lagrangian = f"{self.kinetic} - ({self.potential})"
        return (
            f"coordinates: [{', '.join(self.coordinates)}]\n"
            f'L: "{lagrangian}"\n'
            f"initial: {{{', '.join(given)}}}\n"
        )


def _chain(n: int) -> System:
    each = range(1, n + 1)
    kinetic, potential = [], []
    for i in each:
        speeds = [" + ".join(f"{f}(a{k})*a{k}'" for k in range(1, i + 1)) for f in ("cos", "sin")]
        kinetic += [f"({speed})^2/2" for speed in speeds]
        potential.append("9.81*(" + "".join(f" - cos(a{k})" for k in range(1, i + 1)) + ")")
    names = [f"a{k}" for k in each]
    start = [0.3 * (-1) ** k + 0.05 * k for k in each]
    return System(names, " + ".join(kinetic), " + ".join(potential), start, [0.0] * n, 5.0, 1e-6)


def _pleiades() -> System:
    """Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, section II.10."""
    x, y = [3, 3, -1, -3, 2, -2, 2], [3, -3, 2, 0, 0, -4, 4]
    u, w = [0, 0, 0, 0, 0, 1.75, -1.5], [0, 0, 0, -1.25, 1, 0, 0]
    each = range(1, 8)
    names = [f"{c}{i}" for c in "xy" for i in each]
    kinetic = " + ".join(f"{i}*(x{i}'^2 + y{i}'^2)/2" for i in each)
    potential = " ".join(
        f"- {i * j}/sqrt((x{i} - x{j})^2 + (y{i} - y{j})^2)" for i in each for j in range(1, i)
    )
    floats = [list(map(float, part)) for part in (x + y, u + w)]
    return System(names, kinetic, potential, *floats, 3.0, 1e-6)


_DOUBLE = "a'^2 + b'^2/2 + a'*b'*cos(a - b)"
_TOP = "(p'^2 + f'^2*sin(p)^2)/2 + (s' + f'*cos(p))^2/4"

SYSTEMS: dict[str, System] = {
    "plane pendulum": System(["a"], "a'^2/2", "-9.81*cos(a)", [1.0], [0.0], 20.0, 1e-9),
    "double pendulum": System(
        ["a", "b"], _DOUBLE, "-9.81*(2*cos(a) + cos(b))", [1.0, 2.0], [0.0, 0.0], 5.0, 1e-9
    ),
    "spherical pendulum": System(
        ["p", "f"], "(p'^2 + sin(p)^2*f'^2)/2", "-9.81*cos(p)", [1.0, 0.0], [0.0, 1.0], 20.0, 1e-9
    ),
    "Kepler, 100 orbits": System(
        *(["x", "y"], "(x'^2 + y'^2)/2", "-1/sqrt(x^2 + y^2)"),
        *([0.1, 0.0], [0.0, 4.358898943540674], 628.3185307179587, 1e-6),
    ),
    "heavy top": System(
        ["p", "f", "s"], _TOP, "2*cos(p)", [0.5, 0.0, 0.0], [0.0, 0.5, 10.0], 20.0, 1e-9
    ),
    "stiff spring pendulum": System(
        *(["r", "a"], "(r'^2 + r^2*a'^2)/2", "-9.81*r*cos(a) + 50000000*(r - 1)^2"),
        *([1.0, 1.0], [0.0, 0.0], 10.0, 1e-9),
    ),
    "Pleiades": _pleiades(),
    "chain of 10": _chain(10),
}


class Held(NamedTuple):
    """A system of a problem file, which may have constraints; every program reads that file."""

    path: str
    until: float
    accuracy: float
    #: parameters that the file leaves open
    values: dict[str, str] = {}  # noqa: RUF012 - never changed
    #: where the file has points instead
    energies: dict[str, str] = {"T": "0", "V": "0"}  # noqa: RUF012
    #: by which Baumgarte's method pulls scripts back onto the constraints, in 1/time
    stabilized: float = 10.0
    #: a constraint that the others imply: scripts leave it out, or they would break down
    implied: str = ""


HELD: dict[str, Held] = {
    "spherical pendulum, Cartesian": Held(
        *("problems/classics/spherical-pendulum-cartesian.yaml", 20.0, 1e-9),
        values={"m": "1", "g": "9.81", "l": "1", "v0": "1"},
        energies={"T": "m*(x'^2 + y'^2 + z'^2)/2", "V": "0"},
    ),
    "A01, simple pendulum": Held(
        *("problems/benchmarks/simple-pendulum.yaml", 10.0, 1e-9),
        energies={"T": "m*(x'^2 + y'^2)/2", "V": "0"},
    ),
    "A02, N four-bar": Held("tests/benchmarks/n-four-bar.yaml", 2.0, 1e-6),
    "A03, Andrews' squeezer": Held(
        "tests/benchmarks/andrews-squeezer.yaml", 0.03, 1e-6, stabilized=1000.0
    ),
    "A04, Bricard": Held("tests/benchmarks/bricard.yaml", 2.0, 1e-6, implied="hinge_z"),
    "A05, flyball governor": Held("tests/benchmarks/flyball-governor.yaml", 2.0, 1e-6),
}
