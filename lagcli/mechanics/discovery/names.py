"""What a textbook calls the charge of a transformation."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy
from sympy import Expr, Symbol

_AXES = {"xy": "z", "yz": "x", "xz": "y"}


@dataclass(frozen=True, slots=True)
class Naming:
    """Names by the shape of tau and xi."""

    t: Symbol
    q: tuple[Symbol, ...]
    angles: frozenset[Symbol]

    def of_point(self, xi: Sequence[Expr], tau: Expr) -> str:
        """The name of a point symmetry, or an empty text."""
        moved = {x: e for x, e in zip(self.q, xi, strict=True) if e != 0}
        if tau != 0:
            return self._of_time(tau, moved)
        if all(not (e.free_symbols & {self.t, *self.q}) for e in moved.values()):
            return self._translation(moved)
        if not any(e.free_symbols & set(self.q) for e in moved.values()):
            return self._translation_in_time(moved)
        if self.t not in sympy.Tuple(*moved.values()).free_symbols:
            return self._rotation(moved)
        return ""

    def _of_time(self, tau: Expr, moved: Mapping[Symbol, Expr]) -> str:
        inside = tau.free_symbols & set(self.q)
        if inside:
            [*axes] = inside
            single = len(axes) == 1 and set(moved) == set(axes)
            return f"boost_{axes[0]}" if single and self.t in moved[axes[0]].free_symbols else ""
        if self.t not in tau.free_symbols:
            return "" if moved else "energy"
        if tau.has(sympy.sin, sympy.cos, sympy.exp, sympy.sinh, sympy.cosh):
            for function, word in ((sympy.sin, "sin"), (sympy.cos, "cos")):
                if len(tau.atoms(sympy.sin, sympy.cos)) == 1 and tau.has(function):
                    return f"conformal_{word}"
            return ""
        return {1: "dilation", 2: "conformal"}.get(sympy.degree(tau, self.t), "")

    def _translation(self, moved: Mapping[Symbol, Expr]) -> str:
        if len(moved) == 1:
            return f"p_{next(iter(moved)).name}"
        return f"momentum{self._direction(moved)}" if _equal(moved) else ""

    def _direction(self, moved: Mapping[Symbol, Expr]) -> str:
        letters = {_bare(x.name) for x in moved}
        others = {_bare(x.name) for x in self.q}
        return f"_{letters.pop()}" if len(letters) == 1 and len(others) > 1 else ""

    def _translation_in_time(self, moved: Mapping[Symbol, Expr]) -> str:
        axis = f"_{next(iter(moved)).name}" if len(moved) == 1 else self._direction(moved)
        if _equal(moved):
            [function] = {sympy.simplify(e / next(iter(moved.values()))) for e in moved.values()}
            function = next(iter(moved.values()))
            if function.diff(self.t, 2) == 0:
                return f"boost{axis}"
            for each, word in ((sympy.sin, "sin"), (sympy.cos, "cos")):
                if len(function.atoms(sympy.sin, sympy.cos)) == 1 and function.has(each):
                    return f"translation{axis}_{word}"
        return ""

    def _rotation(self, moved: Mapping[Symbol, Expr]) -> str:
        if set(moved) & self.angles or not moved:
            return ""
        planes = set()
        for x, e in moved.items():
            partners = e.free_symbols & set(self.q)
            if len(partners) != 1 or e.diff(*partners).free_symbols & set(self.q):
                return ""
            [y] = partners
            if y not in moved or moved[y].free_symbols & set(self.q) != {x} or x == y:
                return ""
            planes.add("".join(sorted((_bare(x.name), _bare(y.name)))))
        whole = len(moved) == 2 or _equal({x: abs(e.diff(*(e.free_symbols & set(self.q))))
                                           for x, e in moved.items()})  # fmt: skip
        if len(planes) == 1 and whole:
            [plane] = planes
            if plane in _AXES and (len(moved) == 2) == (len(self.q) <= 3):
                return f"L_{_AXES[plane]}"
        if len(moved) == 2:
            one, other = moved
            return f"angular_momentum_{one.name}_{other.name}"
        return ""


def _bare(name: str) -> str:
    """A name without the number of its particle."""
    return re.sub(r"_?\d+$", "", name) or name


def _equal(moved: Mapping[Symbol, Expr]) -> bool:
    return len(set(moved.values())) == 1


def distinct(names: Sequence[str]) -> list[str]:
    """Each name once; what has none, or one that is taken, is numbered."""
    taken: set[str] = set()
    result = []
    count = 0
    for name in names:
        while not name or name in taken:
            count += 1
            name = f"charge_{count}"
        taken.add(name)
        result.append(name)
    return result
