"""What a textbook calls the charge of a transformation."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, count, permutations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.build import free_of
from lagcli.mechanics.discovery.cartesian import Cartesian
from lagcli.mechanics.discovery.kinds import Kinds
from lagcli.mechanics.noether import NoetherCharge

AXES = {"xy": "z", "yz": "x", "xz": "y"}
MOVING = "_moving"


@dataclass(frozen=True, slots=True)
class Naming:
    """Names by the shape of tau and xi."""

    t: Symbol
    q: tuple[Symbol, ...]
    kinds: Kinds
    cartesian: Cartesian | None = None

    def of_point(self, xi: Sequence[Expr], tau: Expr) -> str:
        """The name of a point symmetry, or an empty text."""
        moved = {x: e for x, e in zip(self.q, xi, strict=True) if e != 0}
        if tau != 0:
            return self._of_time(tau, moved)
        components = self._displacement(xi)
        if along := self._carried(components):
            timed = self.t in sympy.Tuple(*along.values()).free_symbols
            return self._translation_in_time(along) if timed else self._translation(along)
        if turned := self._turned(components, xi):
            return f"L_{turned[0]}"
        if all(not (e.free_symbols & {self.t, *self.q}) for e in moved.values()):
            return self._translation(moved)
        if not any(e.free_symbols & set(self.q) for e in moved.values()):
            return self._translation_in_time(moved)
        if self.t not in sympy.Tuple(*moved.values()).free_symbols:
            return "dilation" if self._stretches(moved) else self._rotation(moved)
        centred = {x: e - self._drift(e) for x, e in moved.items()}
        drifts = centred != moved and self.t not in sympy.Tuple(*centred.values()).free_symbols
        name = self._rotation({x: e for x, e in centred.items() if e != 0}) if drifts else ""
        return name and f"{name}{MOVING}"  # about a point that moves, as in crossed fields

    def _displacement(self, xi: Sequence[Expr]) -> dict[str, Expr]:
        """The Cartesian components, where angles hide them and nothing else moves."""
        found = self.cartesian
        if found is None or not self.kinds.angles:
            return {}
        if any(e != 0 for x, e in zip(self.q, xi, strict=True) if x not in found.q):
            return {}
        return dict(zip(found.names, found.moved(self.q, xi), strict=True))

    def _carried(self, components: Mapping[str, Expr]) -> dict[Symbol, Expr]:
        """Those of what moves all places alike, without the ones that are 0; else none."""
        if not sympy.Tuple(*components.values()).free_symbols.isdisjoint(self.q):
            return {}
        named = components.items()
        return {Symbol(name, real=True): change for name, change in named if change != 0}

    def _turned(
        self, components: Mapping[str, Expr], xi: Sequence[Expr]
    ) -> tuple[str, Expr] | None:
        """The axis of a rotation about the origin, with its rate, unless it moves one angle."""
        if self.cartesian is None or set(components) != set(AXES.values()):
            return None
        if sum(e != 0 for e in xi) < 2:
            return None
        X = dict(zip(self.cartesian.names, self.cartesian.X, strict=True))
        for axis, y, z in ("xyz", "yzx", "zxy"):
            rate = simplify(components[z] / X[y]) if components[axis] == 0 else sympy.S.Zero
            fixed = rate != 0 and free_of(rate, [self.t, *self.q])
            if fixed and is_zero(components[y] + rate * X[z]) is True:
                return axis, rate
        return None

    def _drift(self, change: Expr) -> Expr:
        """The part of a displacement that is the same at all places."""
        return change.as_independent(*self.q, as_Add=True)[0]

    def _stretches(self, moved: Mapping[Symbol, Expr]) -> bool:
        """Whether all lengths grow alike: an isometry of hyperbolic space."""
        return set(moved) == set(self.kinds.lengths) and all(e == x for x, e in moved.items())

    def _shrinks(self, moved: Mapping[Symbol, Expr]) -> bool:
        """Whether all lengths that move do so at one rate."""
        rates = {sympy.cancel(e / x) for x, e in moved.items()}
        return len(rates) == 1 and rates.pop().free_symbols.isdisjoint({self.t, *self.q})

    def of_damping(self, charge: Expr) -> str:
        """Of a symmetry that shrinks the lengths in time: exp(c t) (p^2/2m + c x p/2 + V)."""
        rate = sympy.cancel(simplify(charge.diff(self.t) / charge))
        if rate == 0 or rate.free_symbols & {self.t, *self.q}:
            return ""  # the energy of an expanding universe
        return "damped_energy" if rate.is_positive else "energy_exp"

    def _of_time(self, tau: Expr, moved: Mapping[Symbol, Expr]) -> str:
        inside = tau.free_symbols & set(self.q)
        if inside:
            [x, *others] = inside
            if others or set(moved) != {x} or tau.diff(x).free_symbols & {self.t, x}:
                return ""
            slope = moved[x].diff(self.t)
            return f"boost_{x}" if slope != 0 and not slope.free_symbols & {self.t, x} else ""
        if self.t not in tau.free_symbols:
            steady = set(self.q).isdisjoint(sympy.Tuple(*moved.values()).free_symbols)
            named = "moving_energy" if steady else "damped_energy" if self._shrinks(moved) else ""
            return named if moved else "energy"
        if self._grows(tau):  # exp(2 c t/m) T under a drag
            return "conformal_exp" if moved else "damped_energy"
        turns = self._turning(tau)
        if len(turns) == 1:
            return f"conformal_{turns.pop().func.__name__}"
        degree = sympy.degree(tau, self.t) if tau.is_polynomial(self.t) else 0
        return {1: "dilation", 2: "conformal"}.get(degree, "")

    def _translation(self, moved: Mapping[Symbol, Expr]) -> str:
        if len(moved) == 1:
            return f"p_{next(iter(moved)).name}"
        return f"momentum{self._direction(moved)}" if moved else ""

    def _turning(self, *changes: Expr) -> set[Expr]:
        """The sines and cosines of the time: cos(ω t), not the cos(α) of a slope."""
        return {f for f in sympy.Tuple(*changes).atoms(sympy.sin, sympy.cos) if f.has(self.t)}

    def _grows(self, change: Expr) -> bool:
        """Whether it is c exp(lambda t)."""
        rate = sympy.cancel(change.diff(self.t) / change)
        return bool(rate != 0) and rate.free_symbols.isdisjoint({self.t, *self.q})

    def _direction(self, moved: Mapping[Symbol, Expr]) -> str:
        """Of all particles, of all along one axis, or of the named coordinates."""
        letters = {_bare(x.name) for x in moved}
        others = {_bare(x.name) for x in self.q}
        if len(letters) == 1 and len(others) > 1:
            return f"_{letters.pop()}"
        return "" if len(moved) == len(self.q) else "_" + "_".join(x.name for x in moved)

    def _translation_in_time(self, moved: Mapping[Symbol, Expr]) -> str:
        axis = f"_{next(iter(moved)).name}" if len(moved) == 1 else self._direction(moved)
        alike, first = _equal(moved), next(iter(moved.values()))
        if all((e / self.t).diff(self.t) == 0 for e in moved.values()):
            return f"boost{axis}"
        if self._grows(first) and self._is_steady(moved, first):
            return f"translation{axis}_exp" if alike else "mode_exp"
        turns = self._turning(*moved.values())
        if len(turns) == len(moved) == 2 and len({turn.args[0] for turn in turns}) == 1:
            # a circle: (cos Omega t, -sin Omega t)
            each = [self._turning(e) for e in moved.values()]
            return f"gyration_{each[0].pop().func.__name__}" if [*map(len, each)] == [1, 1] else ""
        if len(turns) != 1:
            return ""
        [turn] = turns  # the same for all coordinates: one amplitude of a mode
        word = turn.func.__name__
        if alike:
            return f"translation{axis}_{word}"
        return f"mode_{word}" if self._is_steady(moved, turn) else ""

    def _is_steady(self, moved: Mapping[Symbol, Expr], function: Expr) -> bool:
        """Whether all displacements are constants times the function of time."""
        return all(not sympy.cancel(e / function).has(self.t) for e in moved.values())

    def _rotation(self, moved: Mapping[Symbol, Expr]) -> str:
        if name := self._rotation_of_body(moved):
            return name
        if set(moved) & set(self.kinds.angles) or not moved:
            return self._rotation_of_sphere(moved)
        planes = set()
        for x, e in moved.items():
            partners = e.free_symbols & set(self.q)
            if len(partners) != 1 or e.diff(*partners).free_symbols & set(self.q):
                return ""
            [y] = partners
            if y not in moved or moved[y].free_symbols & set(self.q) != {x} or x == y:
                return ""
            if sympy.sign(e.diff(y)) == sympy.sign(moved[y].diff(x)):
                return ""  # hyperbolic: x' = y and y' = x keep x² - y²
            planes.add("".join(sorted((_bare(x.name), _bare(y.name)))))
        slopes = {x: e.diff(*(e.free_symbols & set(self.q))) for x, e in moved.items()}
        whole = _equal({x: abs(slope) for x, slope in slopes.items()})
        if len(planes) == 1 and whole:
            [plane] = planes
            if plane in AXES and (len(moved) == 2) == (len(self.q) <= 3):
                return f"L_{AXES[plane]}"
        if len(moved) == 2:
            one, other = moved
            kind = "angular_momentum" if whole else "rotation"  # m_1 m_2 (x y' - y x')
            return f"{kind}_{one.name}_{other.name}"
        return "angular_momentum" if whole and len(moved) == len(self.q) else ""

    def _rotation_of_body(self, moved: Mapping[Symbol, Expr]) -> str:
        """Of two of x, y and z, and of the angles of a body with them."""
        places = {x: e for x, e in moved.items() if x.name in "xyz" and abs(e) in map(abs, moved)}
        turned = {x: e for x, e in moved.items() if x not in places}
        angles = {x for x in self.kinds.angles if x.name not in "xyz"}  # in a screw z moves, too
        if len(places) != 2 or not turned or not {*turned} <= angles:
            return ""
        (x, one), (y, other) = places.items()
        inside = sympy.Tuple(*turned.values()).free_symbols
        if (one, other) not in ((y, -x), (-y, x)) or inside & {x, y}:
            return ""
        return f"L_{AXES[''.join(sorted((x.name, y.name)))]}"

    def of_relative(self, charge: Expr, xi: Sequence[Expr], v: Sequence[Symbol]) -> str:
        """L of two particles about their centre of mass: linear in p, of differences alone.

        With one change for each of x1, x2, y1, y2 and no t, it is c (x y' - y x').
        """
        moved = [x for x, e in zip(self.q, xi, strict=True) if e != 0]
        if len(moved) != 4 or self.t in charge.free_symbols:
            return ""
        rates = dict(zip(self.q, v, strict=True))
        one, others = moved[0], moved[1:]

        def by_difference(x: Symbol, y: Symbol) -> bool:
            return all(
                sympy.expand(charge.diff(a) + charge.diff(b)) == 0
                for a, b in ((x, y), (rates[x], rates[y]))
            )

        partner = next((x for x in others if by_difference(one, x)), None)
        pair = [x for x in others if x != partner]
        if partner is None or not by_difference(*pair):
            return ""
        other = pair[0]
        slope = sympy.expand(charge.diff(one, rates[other]))
        turning = sympy.expand(slope + charge.diff(other, rates[one])) == 0
        if slope == 0 or slope.free_symbols & {*self.q, *v} or not turning:
            return ""
        if charge.diff(one, rates[one]) != 0 or charge.diff(other, rates[other]) != 0:
            return ""
        same = _bare(one.name) == _bare(partner.name) and _bare(pair[0].name) == _bare(pair[1].name)
        plane = "".join(sorted((_bare(one.name), _bare(other.name))))
        return (
            f"L_{AXES[plane]}_relative" if same and plane in AXES else "angular_momentum_relative"
        )

    def of_mode(self, eta: Sequence[Expr]) -> str:
        """The energy of one normal mode, or of coordinates that move alone."""
        moved = {x.name: e for x, e in zip(self.q, eta, strict=True) if e != 0}
        alone = len(moved) == 1 or all(e.is_Symbol for e in moved.values())
        return f"energy_{'_'.join(moved)}" if alone else "energy_mode"

    def _rotation_of_sphere(self, moved: Mapping[Symbol, Expr]) -> str:
        """L_x: dtheta = -sin phi; L_y: dtheta = cos phi, for latitudes and longitudes.

        For Euler's angles phi counts to the line of nodes: dtheta = cos phi and sin phi.
        About the body's own axes it is cos psi and -sin psi: L_1, L_2.
        """
        if tilt := self._tilt(moved):
            about_x = tilt.has(sympy.cos)
            if self._is_of_body(tilt, moved):
                return "L_1" if about_x else "L_2"
            return "L_x" if about_x else "L_y"
        phi = Symbol("#phi", real=True)
        tilts = {moved[theta].xreplace({x: phi}) for theta, x in self._spheres(moved)}
        for name, f in (("L_x", sympy.sin(phi)), ("L_y", sympy.cos(phi))):
            if tilts in ({f}, {-f}):
                return name
        return ""

    def _spheres(self, moved: Mapping[Symbol, Expr]) -> list[tuple[Symbol, Symbol]]:
        """Each latitude with its longitude, where these are what moves."""
        latitudes = [x for x in moved if x in self.kinds.latitudes]
        others = [x for x in moved if x not in latitudes]
        pairs = [(x, y) for x in latitudes for y in others if moved[x].free_symbols == {y}]
        whole = {x for pair in pairs for x in pair} == {*moved} <= {*self.kinds.angles}
        return pairs if whole and len(pairs) == len(latitudes) == len(others) else []

    def _tilt(self, moved: Mapping[Symbol, Expr]) -> Expr | None:
        """dtheta of a rotation of a body about a horizontal axis through its fixed point.

        dphi = dtheta,phi cot theta and dpsi = -dtheta,phi/sin theta: Goldstein, Poole, Safko,
        3rd ed., chapter 4, derivation 15, solved for the rates where omega is e_x or e_y.
        """
        if len(moved) != 3 or not set(moved) <= set(self.kinds.angles):
            return None
        for theta, phi, psi in permutations(moved):
            tilt = moved[theta]
            if abs(tilt) in (abs(sympy.sin(phi)), abs(sympy.cos(phi))):
                slope = tilt.diff(phi)
                rest = moved[phi] - slope * sympy.cot(theta), moved[psi] + slope / sympy.sin(theta)
                if all(is_zero(e) is True for e in rest):
                    return tilt
        return None

    def _is_of_body(self, tilt: Expr, moved: Mapping[Symbol, Expr]) -> bool:
        """Whether its angle is that of the rotation about the body's own axis.

        That one occurs in T, or its inertia is constant; of a sphere, whose T has both angles
        alike, it is the one that is not called phi, or the later one.
        """
        [angle] = tilt.free_symbols
        pair = [x for x in self.q if moved.get(x, tilt) != tilt]
        named = next((x for x in pair if x.name == "phi"), pair[0])
        return bool(next((x for x in pair if x in self.kinds.precessing), named) != angle)

    def orientation(self, name: str, charge: NoetherCharge) -> Expr:
        """The sign that turns a charge into the textbook's: L_y = z p_x - x p_z."""
        xi = charge.transformation.changes
        moved = {x: change for x, change in zip(self.q, xi, strict=True) if change != 0}
        components = self._displacement(xi)
        if charge.transformation.time == 0 and (along := self._carried(components)):
            first = next(iter(along.values()))
            rate = first.as_independent(self.t, as_Add=False)[0]
            if len(along) == 1:
                return 1 / rate
            return sympy.S.NegativeOne if first.could_extract_minus_sign() else sympy.S.One
        if name.startswith("L_") and name.endswith("_relative"):
            one, *_, other = sorted(moved, key=lambda x: x.name)
            slope = moved[other].diff(one)  # of y_2 by x_1: the other particle's is opposite
            backward = not slope.could_extract_minus_sign()
            return sympy.S.NegativeOne if backward != (name[2] == "y") else sympy.S.One
        plain = not moved and self.t not in charge.transformation.time.free_symbols
        if name in ("moving_energy", "damped_energy", "energy_exp") and not plain:
            return sympy.S.NegativeOne  # p.xi - h tau: the textbook's is h
        name = name.removesuffix(MOVING)
        if name not in ("L_x", "L_y", "L_z", "L_1", "L_2"):
            return sympy.S.One
        if turned := self._turned(components, xi):
            return 1 / turned[1]
        if tilt := self._tilt(moved):
            right = bool(tilt.could_extract_minus_sign()) == (name == "L_2")
        elif spheres := self._spheres(moved):
            at = dict.fromkeys(moved, sympy.pi / 4)  # -cot(theta), or -tan of a latitude
            right = bool(moved[spheres[0][1]].xreplace(at).is_negative)
        else:
            one, other = {"L_x": ("y", "z"), "L_y": ("z", "x"), "L_z": ("x", "y")}[name]
            slopes = (
                e.diff(x) for y, e in moved.items() for x in self.q
                if _bare(y.name) == other and _bare(x.name) == one and x in e.free_symbols
            )  # fmt: skip
            slope = next(slopes, sympy.S.One)
            right = not slope.could_extract_minus_sign()
        return sympy.S.One if right else sympy.S.NegativeOne


def _bare(name: str) -> str:
    """A name without the number of its particle."""
    return re.sub(r"_?\d+$", "", name) or name


def _equal(moved: Mapping[Symbol, Expr]) -> bool:
    return len(set(moved.values())) == 1


def own_name(name: str) -> str:
    """That of a charge elsewhere; nothing for charge_1, a mere number."""
    return "" if name.startswith("charge_") else name


def distinct(names: Sequence[str]) -> list[str]:
    """Each name once: mode_cos and mode_cos_2; what has none is charge_1, charge_2 and so on."""
    result: list[str] = []
    for name in names:
        numbered = (f"{name or 'charge'}_{k}" for k in count(2 if name else 1))
        free = (each for each in chain([name] if name else [], numbered) if each not in result)
        result.append(next(free))
    return result
