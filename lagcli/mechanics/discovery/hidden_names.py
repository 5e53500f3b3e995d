"""What a textbook calls an integral of second degree in the velocities, and its usual factor.

runge_lenz   A = p x L - m k r/|r|, whose part without velocities is m r V
fradkin_xy   p_x p_y + m k x y of an oscillator
energy_x     p_x^2/(2 m) + V_x of one separated coordinate
dilation_x, conformal_x    those of the inverse square, in one separated coordinate

By the terms of second degree alone, where other potentials act beside the central one:

runge_lenz     p x L + ... with Kepler's m k r/|r| (Stark, Hartmann)
L_z_squared    L_z^2 + ..., L_squared (Smorodinsky and Winternitz)
L_z_p_y        L_z p_y + ..., as of an oscillator with frequencies 1:2
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, combinations_with_replacement

import sympy
from sympy import Expr

from lagcli.algebra import is_zero, simplify
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.discovery.names import AXES
from lagcli.mechanics.discovery.slots import Slot, SlotEquations
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System


class HiddenNames:
    """Names by the shape of the Killing tensor and of the part without velocities."""

    def __init__(self, system: System, equations: SlotEquations, kinds: Kinds) -> None:
        self.t = equations.t
        self.q = equations.q
        self.v = equations.v
        self.mass = equations.mass
        rest = dict.fromkeys(equations.v, sympy.S.Zero)
        self._rest = rest
        self.V = -system.L.xreplace(rest)
        self.axes = list(self._axes(kinds))
        self._tensors = list(self._known_tensors(kinds))

    def of(self, functions: Sequence[tuple[Slot, Expr]], charge: NoetherCharge) -> tuple[str, Expr]:
        """The name, empty for none, and the factor that makes the charge the textbook's."""
        if any(self.t in f.free_symbols for _, f in functions):
            return self._timed(functions), sympy.S.One
        if functions and all(not (f.free_symbols & set(self.q)) for _, f in functions):
            return self._constant_tensor(functions)
        S = charge.charge.xreplace(self._rest)
        parts = sympy.Add.make_args(sympy.expand(self.V))  # of MICZ's potential that in 1/r
        for name, x in self.axes:
            ratios = (self._constant_ratio(S, x * part) for part in parts)
            ratio = next((r for r in ratios if r is not None), None)
            if ratio is not None:
                return f"runge_lenz_{name}", sympy.S.NegativeOne if ratio < 0 else sympy.S.One
        return self._of_tensor(charge.charge)

    def _of_tensor(self, Q: Expr) -> tuple[str, Expr]:
        """The name by the terms of second degree, of which the others follow."""
        if not self._tensors:
            return "", sympy.S.One
        pairs = combinations_with_replacement(self.v, 2)
        leading = sympy.Add(*(Q.diff(u, w) * u * w / (2 if u == w else 1) for u, w in pairs))
        for name, known in self._tensors:
            ratio = sympy.cancel(leading / known)
            if ratio.free_symbols.isdisjoint({*self.q, *self.v}):
                return name, sympy.Integer(-1 if ratio.could_extract_minus_sign() else 1)
        return "", sympy.S.One

    def _known_tensors(self, kinds: Kinds) -> Iterator[tuple[str, Expr]]:
        """Products of momenta and angular momenta, in Cartesian coordinates of one mass."""
        n, names = range(len(self.q)), [x.name for x in self.q]
        cartesian = len(kinds.lengths) == len(self.q) and set(names) <= set("xyz")
        if not (cartesian and self._has_one_mass):
            return
        L = {(i, k): self.q[i] * self.v[k] - self.q[k] * self.v[i] for i in n for k in n}
        for i, k in combinations(n, 2):
            yield f"L_{AXES[''.join(sorted(names[i] + names[k]))]}_squared", L[i, k] ** 2
        if len(self.q) == 3:
            yield "L_squared", sympy.Add(*(L[pair] ** 2 for pair in combinations(n, 2)))
        kepler = any(self._attracts(part) for part in sympy.Add.make_args(sympy.expand(self.V)))
        for i in n:
            known = sympy.Add(*(self.v[k] * L[i, k] for k in n))
            if kepler:
                yield f"runge_lenz_{names[i]}", known
            elif len(self.q) == 2 and set(names) == {"x", "y"}:
                yield f"L_z_p_{names[1 - i]}", known if names[i] == "x" else -known

    @property
    def _has_one_mass(self) -> bool:
        """Whether T is m v^2/2."""
        n, m = range(len(self.q)), self.mass[0][0]
        return all(self.mass[i][k] == (m if i == k else 0) for i in n for k in n)

    def _attracts(self, part: Expr) -> bool:
        """Whether a term of V is c/r."""
        r = sympy.sqrt(sympy.Add(*(x**2 for x in self.q)))
        return self._constant_ratio(part, 1 / r) is not None

    def _timed(self, functions: Sequence[tuple[Slot, Expr]]) -> str:
        """The dilation and the conformal integral of one separated coordinate."""
        pairs = [(slot.kind[1:], f) for slot, f in functions if slot.kind[0] == "pair"]
        if len(pairs) != 1:
            return ""
        [((i, j), f)] = pairs
        if i != j or f.free_symbols & set(self.q):
            return ""
        x = self.q[int(i)].name
        if f.has(sympy.sin) != f.has(sympy.cos):
            return f"conformal_{x}_{'sin' if f.has(sympy.sin) else 'cos'}"
        degree = sympy.degree(f, self.t) if f.is_polynomial(self.t) else 0
        return {1: f"dilation_{x}", 2: f"conformal_{x}"}.get(degree, "")

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

    def _constant_ratio(self, above: Expr, below: Expr) -> int | None:
        """The sign of above/below where that is constant and not 0."""
        if above == 0 or below == 0:
            return None
        x = next((x for x in self.q if x in below.free_symbols), None)
        slope = above.diff(x) * below - above * below.diff(x) if x is not None else above
        if is_zero(slope) is not True:
            return None
        ratio = simplify(above / below)
        if ratio.free_symbols & set(self.q) or ratio == 0:
            return None
        return -1 if ratio.could_extract_minus_sign() else 1

    def _axes(self, kinds: Kinds) -> Iterator[tuple[str, Expr]]:
        """Cartesian coordinates of a central V: those given, or those of r and its angles."""
        if is_zero(self.V) is True:
            return
        if len(kinds.lengths) == len(self.q):
            if not self._has_one_mass:
                return
            from_centre = [x - kinds.centre.get(x, 0) for x in self.q]
            if self._is_central(from_centre):
                yield from ((x.name, y) for x, y in zip(self.q, from_centre, strict=True))
            return
        if len(kinds.radii) != 1 or any(y in self.V.free_symbols for y in kinds.angles):
            return
        [r] = kinds.radii
        if len(kinds.angles) == 1:
            [phi] = kinds.angles
            yield "x", r * sympy.cos(phi)
            yield "y", r * sympy.sin(phi)
        elif len(kinds.latitudes) == 1 and len(kinds.angles) == 2:
            [(theta, pole)] = kinds.latitudes.items()
            [phi] = [y for y in kinds.angles if y != theta]
            yield "x", r * pole * sympy.cos(phi)
            yield "y", r * pole * sympy.sin(phi)
            yield "z", r * (sympy.sin if pole.func is sympy.cos else sympy.cos)(theta)

    def _is_central(self, r: Sequence[Expr]) -> bool:
        return len(r) > 1 and all(
            is_zero(self.V.diff(x) * r[i] - self.V.diff(y) * r[k]) is True
            for k, x in enumerate(self.q)
            for i, y in enumerate(self.q[:k])
        )
