"""Equilibria at kinks of the potential: |x| + x/2 has a minimum at 0, where its force jumps.

The force takes every value between those on the two sides of u = 0 (Clarke's generalized
gradient), so that sign(u) = s with some s from -1 to 1 is to be solved for there.

References
----------
Clarke, *Optimization and Nonsmooth Analysis*, section 2.3.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.algebra.systems import solve_system
from lagcli.algebra.vanishing_factors import divisors


def at_kinks(
    forces: Sequence[Expr],
    equations: Sequence[Expr],
    coordinates: Sequence[Symbol],
    known: Sequence[Mapping[Symbol, Expr]],
) -> bool:
    """Whether there may be equilibria where a force jumps, beside the known ones.

    Parameters
    ----------
    forces
        At rest.
    equations
        What vanishes at an equilibrium.
    coordinates
        The unknowns.
    known
        The equilibria at which they do, sign(0) being 0.
    """
    jumps = {jump.args[0] for force in forces for jump in force.atoms(sympy.sign)}
    moving = [u for u in jumps if u.free_symbols & {*coordinates}]
    return any(_may_rest(u, equations, coordinates, known) for u in sorted(moving, key=str))


def at_cusps(potential: Expr, coordinates: Sequence[Symbol]) -> bool:
    """Whether V may have a minimum where a root or an arc in it has no derivative.

    Such as sqrt(x² + y²), and acos(cos(x)).  None is where V falls on all sides of it, as
    (sqrt(x² + y²) - l)² does.
    """
    return any(
        not free_of(node, coordinates) and _rises_from_an_edge(potential, node)
        for node in potential.atoms(sympy.Pow, sympy.asin, sympy.acos)
    )


def _rises_from_an_edge(potential: Expr, node: Expr) -> bool:
    inside = node.args[0] if node.is_Pow else 1 - node.args[0] ** 2
    if (node.is_Pow and node.exp != sympy.S.Half) or sign(inside) == 1:
        return False
    size = sympy.Dummy("size", positive=True)
    slope = potential.xreplace({node: size}).diff(size)
    return not node.is_Pow or sign(slope.xreplace({size: sympy.S.Zero})) != -1


def _may_rest(
    u: Expr,
    equations: Sequence[Expr],
    coordinates: Sequence[Symbol],
    known: Sequence[Mapping[Symbol, Expr]],
) -> bool:
    if any(is_zero(u.xreplace(dict(values))) is True for values in known):
        return False
    if any({u, -u} & divisors(e) for e in equations):  # no value where u = 0
        return False
    s = sympy.Dummy("s", real=True)
    there = {sympy.sign(u): s, sympy.Abs(u): s * u}
    solved = solve_system([u, *(e.xreplace(there) for e in equations)], [*coordinates, s])
    if not solved.complete:
        return True
    between = (each.values.get(s, sympy.S.Zero) for each in solved.solutions)
    return any(sign(1 - x**2) != -1 for x in between)
