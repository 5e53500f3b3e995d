"""Two steady motions whose rates are the roots of one quadratic equation.

phi' = −q B/(2 m) ± sqrt(q² B²/(4 m²) + U'(r)/(m r)), with its square under the root as in
Landau, Lifshitz, *The Classical Theory of Fields*, 4th ed., problem of section 21.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from itertools import combinations

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import simplify
from lagcli.expression import Call, Expression, Name, sum_of
from lagcli.record import replace
from lagcli.rewriting import put_in
from lagcli.statements.motions import SteadyMotion

_ROOT = "#root"

#: The rates and the momenta of a motion, by the names of their coordinates.
Turning = dict[str, dict[str, Expr]]


def with_roots_alike(
    stated: Sequence[SteadyMotion],
    found: Sequence[Turning | None],
    parameters: Collection[Symbol],
    shape: Callable[[Expr], Expression],
) -> tuple[SteadyMotion, ...]:
    """The motions, those of one equation with its root written alike, where it is a short one.

    Which of the two has the root with a plus does not matter: both have the same verdict.
    """
    motions = list(stated)
    for i, j in combinations(range(len(motions)), 2):
        one, other = found[i], found[j]
        if one is None or other is None or one == other:
            continue
        like = {"rates": motions[i].rates, "momenta": motions[i].momenta}
        if replace(motions[j], **like) != motions[i]:
            continue
        shown = _shown(one, other, parameters, shape)
        if shown is not None:
            motions[i], motions[j] = (
                replace(motions[k], rates=each["rates"], momenta=each["momenta"])
                for k, each in zip((i, j), shown, strict=True)
            )
    return tuple(motions)


def _shown(
    one: Turning,
    other: Turning,
    parameters: Collection[Symbol],
    shape: Callable[[Expr], Expression],
) -> list[dict[str, dict[str, Expression]]] | None:
    halves = {n: simplify((rate - other["rates"][n]) / 2) for n, rate in one["rates"].items()}
    name = next((n for n, half in halves.items() if half != 0), None)
    if name is None:
        return None
    half, middle = halves[name], simplify((one["rates"][name] + other["rates"][name]) / 2)
    square, rest = simplify(half**2), simplify(half**2 - middle**2)
    # (I3 w ± sqrt(I3² w² − 4 I1 m g l cos θ))/(2 I1 cos θ) has a middle that varies
    if middle == 0 or not middle.free_symbols <= set(parameters) or rest == 0:
        return None
    if _has_root(square) or isinstance(rest.expand(), sympy.Add) or _has_root(middle):
        return None
    mark, root = Symbol(_ROOT, real=True), sum_of((shape(middle**2), shape(rest)))
    put: dict[Expression, Expression] = {Name(_ROOT): Call("sqrt", (root,))}
    shown: list[dict[str, dict[str, Expression]]] = [{}, {}]
    for kind, values in one.items():
        for each in shown:
            each[kind] = {}
        for n, value in values.items():
            centre = simplify((value + other[kind][n]) / 2)
            slope = simplify((value - other[kind][n]) / (2 * half))
            if _has_root(centre) or _has_root(slope):
                return None
            for side, each in zip((1, -1), shown, strict=True):
                each[kind][n] = put_in(shape(centre + side * slope * mark), put)
    return shown


def _has_root(value: Expr) -> bool:
    return any(p.exp.is_Rational and p.exp.q == 2 for p in value.atoms(sympy.Pow)) or value.has(
        sympy.Abs, S.NaN
    )
