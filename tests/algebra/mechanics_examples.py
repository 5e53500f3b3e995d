"""Formulas of mechanics, derived here with SymPy alone and left as they come."""

from __future__ import annotations

from functools import cache
from itertools import combinations

import sympy as sp
from sympy import Expr, Symbol, cos, diff, exp, sin, sqrt

from lagcli.algebra.build import unspecified


def real(names: str) -> list[Symbol]:
    return [Symbol(n, real=True) for n in names.split()]


def positive(names: str) -> list[Symbol]:
    return [Symbol(n, positive=True) for n in names.split()]


t = Symbol("t", real=True)
m, m1, m2, m3, M, length, l1, l2, g, k, R, c, I1, I3, a, b, r0 = positive(
    "m m1 m2 m3 M l l1 l2 g k R c I1 I3 a b r0"
)
alpha, Omega, F, q0, B = real("alpha Omega F q0 B")


class System:
    """Lagrange's equations of one Lagrangian, by the book and without simplification."""

    def __init__(self, names: str, assume: dict[str, str] | None = None) -> None:
        kinds = assume or {}
        self.names = names.split()
        self.q = [Symbol(n, **{kinds.get(n, "real"): True}) for n in self.names]
        self.v = [Symbol(n + "'", real=True) for n in self.names]
        self.w = [Symbol(n + "''", real=True) for n in self.names]

    def rate(self, f: Expr) -> Expr:
        pairs = [*zip(self.q, self.v, strict=True), *zip(self.v, self.w, strict=True)]
        return f.diff(t) + sum((f.diff(x) * y for x, y in pairs), sp.S.Zero)

    def equations(self, L: Expr) -> list[Expr]:
        return [self.rate(L.diff(v)) - L.diff(q) for q, v in zip(self.q, self.v, strict=True)]

    def accelerations(self, L: Expr, forces: list[Expr] | None = None) -> list[Expr]:
        equations = self.equations(L)
        forces = forces or [sp.S.Zero] * len(self.q)
        matrix = sp.Matrix([[e.diff(w) for w in self.w] for e in equations])
        at_rest = dict.fromkeys(self.w, 0)
        right = sp.Matrix([f - e.xreplace(at_rest) for e, f in zip(equations, forces, strict=True)])
        return list(matrix.LUsolve(right))

    def energy(self, L: Expr) -> Expr:
        return sum((v * L.diff(v) for v in self.v), sp.S.Zero) - L

    def kinetic(self, mass: Expr, position: list[Expr]) -> Expr:
        return mass * sum((self.rate(x) ** 2 for x in position), sp.S.Zero) / 2


@cache
def examples() -> dict[str, Expr]:
    """Name -> formula as it comes out of the derivation."""
    found: dict[str, Expr] = {}

    def add(name: str, values: list[Expr] | Expr) -> None:
        for i, value in enumerate(values if isinstance(values, list) else [values]):
            found[f"{name}_{i}" if isinstance(values, list) else name] = value

    def particle(s: System, *bodies: tuple[Expr, list[Expr]]) -> Expr:
        return sum((s.kinetic(mass, where) for mass, where in bodies), sp.S.Zero)

    s = System("theta1 theta2")
    (u, v), (du, dv) = s.q, s.v
    x1, y1 = l1 * sin(u), -l1 * cos(u)
    x2, y2 = x1 + l2 * sin(v), y1 - l2 * cos(v)
    L = particle(s, (m1, [x1, y1]), (m2, [x2, y2])) - m1 * g * y1 - m2 * g * y2
    add("double_pendulum", s.accelerations(L))
    add("double_pendulum_momentum", [L.diff(x) for x in s.v])
    add("double_pendulum_energy", s.energy(L))

    s = System("x theta")
    (x, th), (dx, dth) = s.q, s.v
    bob = [x + length * sin(th), -length * cos(th)]
    L = particle(s, (M, [x]), (m, bob)) - m * g * bob[1]
    add("cart_pole", s.accelerations(L, [F, sp.S.Zero]))
    add("cart_pole_momentum", [L.diff(y) for y in s.v])

    s = System("theta phi")
    (th, ph), (dth, dph) = s.q, s.v
    where = [length * sin(th) * cos(ph), length * sin(th) * sin(ph), -length * cos(th)]
    L = particle(s, (m, where)) - m * g * where[2]
    add("spherical_pendulum", s.accelerations(L))
    add("spherical_pendulum_energy", s.energy(L))
    add("spherical_pendulum_momentum", L.diff(dph))

    s = System("theta phi psi")
    (th, ph, ps), (dth, dph, dps) = s.q, s.v
    w1 = dph * sin(th) * sin(ps) + dth * cos(ps)
    w2 = dph * sin(th) * cos(ps) - dth * sin(ps)
    w3 = dph * cos(th) + dps
    L = I1 * (w1**2 + w2**2) / 2 + I3 * w3**2 / 2 - M * g * length * cos(th)
    add("heavy_top", s.accelerations(L))
    add("heavy_top_momentum", [L.diff(y) for y in s.v])
    add("heavy_top_energy", s.energy(L))

    s = System("r phi", {"r": "positive"})
    (r, ph), (dr, dph) = s.q, s.v
    L = m * (dr**2 + r**2 * dph**2) / 2 + k / r
    add("kepler", s.accelerations(L))
    add("kepler_energy", s.energy(L))
    L = particle(s, (m, [r * cos(ph), r * sin(ph)])) - unspecified("U", 1)(r)
    add("central", s.accelerations(L))
    L = particle(s, (m, [r * sin(alpha) * cos(ph), r * sin(alpha) * sin(ph), r * cos(alpha)]))
    add("cone", s.accelerations(L - m * g * r * cos(alpha)))

    s = System("x y")
    (x, y), (dx, dy) = s.q, s.v
    L = m * (dx**2 + dy**2) / 2 + k / sqrt(x**2 + y**2)
    add("kepler_cartesian", s.accelerations(L))
    add("kepler_cartesian_energy_rate", s.rate(s.energy(L)))
    L = m * (dx**2 + dy**2) / 2 - unspecified("U", 1)(sqrt(x**2 + y**2))
    add("central_cartesian", s.accelerations(L))
    L = -m * c**2 * sqrt(1 - (dx**2 + dy**2) / c**2) - unspecified("V", 2)(x, y)
    add("relativistic", s.accelerations(L))
    add("relativistic_momentum", L.diff(dx))
    add("relativistic_energy", s.energy(L))
    L = m * (dx**2 + dy**2) / 2 + q0 * B * (x * dy - y * dx) / 2 - k * (x**2 + y**2) / 2
    add("magnetic", s.accelerations(L))
    L = m * ((dx - Omega * y) ** 2 + (dy + Omega * x) ** 2) / 2 - k * (x**2 + y**2) / 2
    add("rotating_frame", s.accelerations(L))

    s = System("r theta", {"r": "positive"})
    (r, th), (dr, dth) = s.q, s.v
    L = (
        particle(s, (m, [r * sin(th), -r * cos(th)]))
        + m * g * r * cos(th)
        - k * (r - length) ** 2 / 2
    )
    add("spring_pendulum", s.accelerations(L))

    s = System("theta")
    (th,), (dth,) = s.q, s.v
    where = [R * (th - sin(th)), R * (1 + cos(th))]
    add("cycloid", s.accelerations(particle(s, (m, where)) - m * g * where[1]))
    where = [R * sin(th) * cos(Omega * t), R * sin(th) * sin(Omega * t), -R * cos(th)]
    add("hoop_rotating", s.accelerations(particle(s, (m, where)) - m * g * where[2]))
    where = [a * cos(Omega * t) + length * sin(th), a * sin(Omega * t) - length * cos(th)]
    add("driven_pendulum", s.accelerations(particle(s, (m, where)) - m * g * where[1]))

    s = System("x s")
    (x, y), (dx, dy) = s.q, s.v
    where = [x + y * cos(alpha), -y * sin(alpha)]
    L = particle(s, (M, [x]), (m, where)) - m * g * where[1]
    add("wedge", s.accelerations(L))

    s = System("x y z")
    (x, y, z), (dx, dy, dz) = s.q, s.v
    L = (
        m1 * dx**2 / 2
        + m2 * dy**2 / 2
        + m3 * dz**2 / 2
        - k * (x - y) ** 2 / 2
        - k * (y - z) ** 2 / 2
    )
    add("chain_of_masses", s.accelerations(L))
    distances = [sqrt((p - q) ** 2) for p, q in combinations((x, y, z), 2)]
    L = m * (dx**2 + dy**2 + dz**2) / 2 - sum(exp(-d) for d in distances)
    add("toda", [diff(L, p) for p in s.q])

    s = System("theta1 theta2")
    (u, v), (du, dv) = s.q, s.v
    L = (
        m * length**2 * (du**2 + dv**2) / 2
        + m * g * length * (cos(u) + cos(v))
        - k * a**2 * (sin(u) - sin(v)) ** 2 / 2
    )
    add("coupled_pendulums", s.accelerations(L))

    s = System("x phi")
    (x, ph), (dx, dph) = s.q, s.v
    where = [x - R * sin(ph), R - R * cos(ph)]
    add(
        "bead_in_sliding_hoop",
        s.accelerations(particle(s, (M, [x]), (m, where)) - m * g * where[1]),
    )

    s = System("x")
    (x,), (dx,) = s.q, s.v
    height = a * x**2 / 2
    add("parabola", s.accelerations(particle(s, (m, [x, height])) - m * g * height))
    height = a * sp.cosh(x / a)
    add("catenary", s.accelerations(particle(s, (m, [x, height])) - m * g * height))

    s = System("theta phi")
    (th, ph), (dth, dph) = s.q, s.v
    L = particle(s, (m, [(a + b * cos(th)) * cos(ph), (a + b * cos(th)) * sin(ph), b * sin(th)]))
    add("torus", s.accelerations(L))

    s = System("x y theta")
    (x, y, th), (dx, dy, dth) = s.q, s.v
    w = M * g * sin(alpha) / (M + I1 / R**2)
    add("disk", [w, w / R, -I1 * w / R**2, M * g * sin(alpha) - M * w])
    add(
        "kinetic_com",
        particle(s, (m, [x + length * cos(th), y + length * sin(th)])) + I1 * dth**2 / 2,
    )

    (p1, p2) = real("p_theta1 p_theta2")
    d = u - v
    add(
        "double_pendulum_hamiltonian",
        (m2 * l2**2 * p1**2 + (m1 + m2) * l1**2 * p2**2 - 2 * m2 * l1 * l2 * p1 * p2 * cos(d))
        / (2 * m2 * l1**2 * l2**2 * (m1 + m2 * sin(d) ** 2))
        - (m1 + m2) * g * l1 * cos(u)
        - m2 * g * l2 * cos(v),
    )
    pr, pph = real("p_r p_phi")
    r = positive("r")[0]
    add("kepler_hamiltonian", pr**2 / (2 * m) + pph**2 / (2 * m * r**2) - k / r)
    add(
        "frequencies", [sqrt(g / length), sqrt(k / m + g / length), sqrt(2) * sqrt(k) / sqrt(m) / 2]
    )
    return found
