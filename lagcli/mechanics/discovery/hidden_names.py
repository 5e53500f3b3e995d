"""What a textbook calls an integral of second degree in the velocities, and its usual factor.

runge_lenz   A = p x L - m k r/|r|, whose part without velocities is m r V
fradkin_xy   p_x p_y + m k x y of an oscillator
energy_x     p_x^2/(2 m) + V_x of one separated coordinate
dilation_x, conformal_x    those of the inverse square, in one separated coordinate

By the terms of second degree alone, where other potentials act beside the central one:

runge_lenz     p x L + ... with Kepler's m k r/|r| (Stark, Hartmann)
L_z_squared    L_z^2 + ..., L_squared (Smorodinsky and Winternitz)
L_z_p_y        L_z p_y + ..., as of an oscillator with frequencies 1:2
p_x_p_y        p_x p_y + ..., of a potential that separates along x + y and x - y
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import dot, is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.cartesian import Cartesian
from lagcli.mechanics.discovery.names import AXES
from lagcli.mechanics.discovery.slots import Slot, SlotEquations
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System


class HiddenNames:
    """Names by the shape of the Killing tensor and of the part without velocities."""

    def __init__(self, system: System, equations: SlotEquations, axes: Cartesian | None) -> None:
        self.t = equations.t
        self.q = equations.q
        self.v = equations.v
        self.mass = equations.mass
        rest = dict.fromkeys(equations.v, sympy.S.Zero)
        self._rest = rest
        _, self.V = (-system.L.xreplace(rest)).as_independent(*self.q, as_Add=True)
        self._cartesian = axes
        self.axes = self._axes()
        self._tensors = list(self._known_tensors())

    def of(self, functions: Sequence[tuple[Slot, Expr]], charge: NoetherCharge) -> tuple[str, Expr]:
        """The name, empty for none, and the factor that makes the charge the textbook's.

        What is linear in the velocities, too, as in a turning frame, is no energy of a coordinate.
        """
        name, factor = self._named(functions, charge)
        back = dict(zip(self.v, (-v for v in self.v), strict=True))
        Q = charge.charge
        odd = name.startswith("energy") and is_zero(Q - Q.xreplace(back)) is not True
        return ("", sympy.S.One) if odd else (name, factor)

    def _named(
        self, functions: Sequence[tuple[Slot, Expr]], charge: NoetherCharge
    ) -> tuple[str, Expr]:
        if any(self.t in f.free_symbols for _, f in functions):
            return self._timed(functions)
        if functions and all(not (f.free_symbols & set(self.q)) for _, f in functions):
            name, factor = self._constant_tensor(functions)
            if name:
                return name, factor
        S = charge.charge.xreplace(self._rest)
        parts = sympy.Add.make_args(sympy.expand(self.V))  # of MICZ's potential that in 1/r
        for name, x in self.axes:
            ratios = (self._constant_ratio(S, x * part) for part in parts)
            ratio = next((r for r in ratios if r is not None), None)
            if ratio is not None:
                mass = sympy.S.One if self._cartesian is None else self._cartesian.mass
                return f"runge_lenz_{name}", mass / ratio
        return self._of_tensor(charge.charge)

    def _of_tensor(self, Q: Expr) -> tuple[str, Expr]:
        """The name by the terms of second degree, of which the others follow."""
        if self._cartesian is None:
            return "", sympy.S.One
        pairs = combinations_with_replacement(self.v, 2)
        leading = sympy.Add(*(Q.diff(u, w) * u * w / (2 if u == w else 1) for u, w in pairs))
        for name, known in self._tensors:
            ratio = self._constant_ratio(leading, known)
            if ratio is not None:
                m = self._cartesian.mass
                return name, (m / 2 if name.startswith("energy") else m**2) / ratio
        return "", sympy.S.One

    def _known_tensors(self) -> Iterator[tuple[str, Expr]]:
        """Products of components of p and L, with m = 1."""
        if self._cartesian is None or not set(self._cartesian.names) <= set("xyz"):
            return
        names, X = self._cartesian.names, self._cartesian.X
        elastic = self._constant_ratio(self.V, self._cartesian.radius**2) is not None
        n, v = range(len(X)), self._cartesian.moved(self.q, self.v)
        L = {(i, k): X[i] * v[k] - X[k] * v[i] for i in n for k in n}
        for i, k in combinations(n, 2):
            x, y = sorted((names[i], names[k]))
            yield f"L_{AXES[x + y]}_squared", L[i, k] ** 2
            mixed = f"fradkin_{x}{y}" if elastic else f"p_{x}_p_{y}"
            yield mixed, v[i] * v[k]
        if len(X) == 3:
            yield "L_squared", sympy.Add(*(L[pair] ** 2 for pair in combinations(n, 2)))
        kepler = any(self._attracts(part) for part in sympy.Add.make_args(sympy.expand(self.V)))
        for i in n:
            known = sympy.Add(*(v[k] * L[i, k] for k in n))
            if kepler:
                yield f"runge_lenz_{names[i]}", known
            elif set(names) == {"x", "y"}:
                yield f"L_z_p_{names[1 - i]}", known if names[i] == "x" else -known
            yield f"energy_{names[i]}", v[i] ** 2

    def _attracts(self, part: Expr) -> bool:
        """Whether a term of V is c/r."""
        return self._cartesian is not None and (
            self._constant_ratio(part, 1 / self._cartesian.radius) is not None
        )

    def _timed(self, functions: Sequence[tuple[Slot, Expr]]) -> tuple[str, Expr]:
        """The dilation and the conformal integral of one separated coordinate, with p_x^2."""
        pairs = [(slot, f) for slot, f in functions if slot.kind[0] == "pair"]
        if len(pairs) != 1:
            return "", sympy.S.One
        [(slot, f)] = pairs
        x, factor = self._along(slot)
        if not x or f.free_symbols & set(self.q):
            return "", sympy.S.One
        if f.has(sympy.sin) != f.has(sympy.cos):
            return f"conformal_{x}_{'sin' if f.has(sympy.sin) else 'cos'}", factor
        degree = sympy.degree(f, self.t) if f.is_polynomial(self.t) else 0
        return {1: f"dilation_{x}", 2: f"conformal_{x}"}.get(degree, ""), factor

    def _along(self, slot: Slot) -> tuple[str, Expr]:
        """The Cartesian x of the slot, empty where it is none, and the factor that leaves p_x^2."""
        square = dot(slot.vector, [dot(row, self.v) for row in self.mass])
        if self._cartesian is not None:
            rates = self._cartesian.moved(self.q, self.v)
            for name, rate in zip(self._cartesian.names, rates, strict=True):
                ratio = self._constant_ratio(square, rate**2)
                if ratio is not None:
                    return name, self._cartesian.mass**2 / ratio
        own = [x for x, part in zip(self.q, slot.vector, strict=True) if part != 0]
        alone = slot.kind[1] == slot.kind[2] and len(own) == 1
        return own[0].name if alone and free_of(square, self.q) else "", sympy.S.One

    def _constant_tensor(self, functions: Sequence[tuple[Slot, Expr]]) -> tuple[str, Expr]:
        nothing = ("", sympy.S.One)
        if len(functions) != 1 or functions[0][0].kind[0] != "pair":
            return nothing
        i, j = int(functions[0][0].kind[1]), int(functions[0][0].kind[2])
        x, y = self.q[i], self.q[j]
        mixed = [self.V.diff(x, z) for z in self.q if z != x]
        if any(is_zero(e) is not True for e in mixed):
            return nothing
        if i == j:
            inertia = self.mass[i][i]
            diagonal = all(is_zero(m) for k, m in enumerate(self.mass[i]) if k != i)
            constant = not (inertia.free_symbols & set(self.q))
            factor = 1 / (inertia * functions[0][1])
            return (f"energy_{x.name}", factor) if diagonal and constant else nothing
        bound = all(
            is_zero(self.V.diff(z, 2)) is False and is_zero(self.V.diff(z, 3)) is True
            for z in (x, y)
        )
        short = len(x.name + y.name) == 2
        joined = f"{x.name}{y.name}" if short else f"{x.name}_{y.name}"
        return (f"fradkin_{joined}", sympy.S.One) if bound else nothing

    def _constant_ratio(self, above: Expr, below: Expr) -> Expr | None:
        """above/below where that is constant and not 0."""
        if above == 0 or below == 0:
            return None
        state = (*self.v, *self.q)
        x = next((x for x in state if x in below.free_symbols), None)
        slope = above.diff(x) * below - above * below.diff(x) if x is not None else above
        if is_zero(slope) is not True:
            return None
        ratio = simplify(above / below)
        return None if ratio.free_symbols & set(state) or ratio == 0 else ratio

    def _axes(self) -> Sequence[tuple[str, Expr]]:
        """Cartesian coordinates, with their names, where V is a function of r alone.

        In a curved space x, y and z of the file are as good.
        """
        found, V = self._cartesian, self.V
        own, names, X = self.q, tuple(x.name for x in self.q), self.q
        if found is not None:
            own, names, X = found.q, found.names, found.X
        elif not {*names} <= {*"xyz"}:
            return ()
        if len(X) < 2 or is_zero(V) is True:
            return ()
        square = sympy.Add(*(x**2 for x in X))
        slopes = [(V.diff(q), square.diff(q)) for q in own]
        central = all(is_zero(a * d - b * c) is True for (a, b), (c, d) in combinations(slopes, 2))
        return list(zip(names, X, strict=True)) if central else ()
