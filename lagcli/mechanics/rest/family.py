"""Equilibria that are not isolated: what ties their coordinates, and what holds near all of them.

A relation g(q) = 0 is solved for one coordinate to expand the motion about it; what was found is
then written in all coordinates again.  As the two signs of a root are conjugate, it holds on
the other branch as well: of x = sqrt(u), and of theta = asin(u) with sqrt(1 - u^2) for cos(theta).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import Field, is_zero, simplify
from lagcli.algebra.equations import solve_for
from lagcli.algebra.field import common_denominator
from lagcli.algebra.signs import sign
from lagcli.record import record

#: What is squared in the other function of an inverse u, and that function of the unknown.
_OF_INVERSE = {
    sympy.asin: lambda u, x: (1 - u**2, sympy.cos(x)),
    sympy.acos: lambda u, x: (1 - u**2, sympy.sin(x)),
    sympy.atan: lambda u, x: (1 + u**2, 1 / sympy.cos(x)),
}


@record
class Family:
    """The equilibria with relation = 0 and the values `given`, and unknown = root on a branch.

    The `coordinates` are those of the system.
    """

    relation: Expr
    given: Mapping[Symbol, Expr]
    unknown: Symbol
    root: Expr
    coordinates: Sequence[Symbol]

    @property
    def tied(self) -> frozenset[Symbol]:
        """What the relation ties, coordinates and parameters."""
        return frozenset(self.relation.free_symbols)

    @property
    def radicands(self) -> list[Expr]:
        """What is positive where the branch is real."""
        surd = self._surd
        return [] if surd is None else [surd[0].base]

    @property
    def _surd(self) -> tuple[Expr, Expr] | None:
        """The power of the branch, and what it is on the whole family."""
        root, whole = self.root, self.unknown
        inverse = root.atoms(*_OF_INVERSE)
        if len(inverse) == 1:
            [node] = inverse
            start, end = (root.xreplace({node: value}) for value in (S.Zero, S.One))
            angle = (self.unknown - start) / (end - start)
            squared, whole = _OF_INVERSE[node.func](node.args[0], angle)
            root = simplify(sympy.sqrt(simplify(squared)))
        power, factor, shift = _root_of(root)
        return None if power is None else (power, (whole - shift) / factor)

    def displacement(self, parts: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """A displacement on the branch in all coordinates, without denominators."""
        back = [self.written_back(part) for part in parts]
        if any(part is None for part in back):
            return None
        field = Field(back)
        elements = [field(part) for part in back]
        common = field.polynomial(common_denominator(field, elements))
        whole = [each * common for each in elements]
        return tuple(simplify(field.to_sympy(each)) for each in whole)

    def written_back(self, expression: Expr) -> Expr | None:
        """The formula on the branch as one on the whole family; None where that was not found."""
        surd = self._surd
        if surd is None:
            return expression
        power, whole = surd
        coordinates = power.free_symbols & {*self.coordinates}

        def plain(node: Expr) -> Expr:
            ratio = simplify(node.base / power.base)
            if ratio.free_symbols & coordinates:
                return node
            return ratio**node.exp * whole ** (node.exp / power.exp)

        def is_root(node: Expr) -> bool:
            found = node.is_Pow and not node.exp.is_Integer
            return found and (node.base == power.base or node.base.has(*coordinates))

        back = simplify(expression.replace(is_root, plain))
        if any(map(is_root, sympy.preorder_traversal(back))):
            return None
        other = {self.unknown: self.root}
        same = is_zero(back.xreplace(other) - expression) is True
        return back if same else None


def family(relation: Expr, given: Mapping[Symbol, Expr], q: Sequence[Symbol]) -> Family | None:
    """A family with a branch; None where the relation has no closed solution."""
    for unknown in q:
        found = solve_for(relation, unknown) if unknown in relation.free_symbols else None
        if found is not None and found.values:
            return Family(relation, given, unknown, simplify(found.values[0]), q)
    return None


def exists_where(relation: Expr, q: Sequence[Symbol]) -> tuple[Expr, ...] | None:
    """What must be positive for x^2 + y^2 = c to have points; None where it has none.

    Of other relations nothing is said.
    """
    tied = [s for s in q if s in relation.free_symbols]
    constant = relation.xreplace(dict.fromkeys(tied, S.Zero))
    terms = sympy.Add.make_args(sympy.expand(relation - constant))
    signs = {sign(term / s**2) for term in terms for s in tied if term.has(s)}
    if len(terms) != len(tied) or len(signs) != 1 or not signs <= {1, -1}:
        return ()
    room = simplify(-constant * signs.pop())
    known = sign(room)
    return None if known in (0, -1) else () if known == 1 else (room,)


def _root_of(root: Expr) -> tuple[Expr | None, Expr, Expr]:
    """The power, factor and shift in root = shift + factor * power."""
    shift, term = S.Zero, root
    if root.is_Add:
        term = next((each for each in root.args if _powers(each)), root)
        shift = root - term
    powers = _powers(term)
    return (powers[0], term / powers[0], shift) if powers else (None, term, shift)


def _powers(term: Expr) -> list[Expr]:
    parts = sympy.Mul.make_args(term)
    return [part for part in parts if part.is_Pow and not part.exp.is_Integer]
