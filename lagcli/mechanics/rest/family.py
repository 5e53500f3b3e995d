"""Equilibria that are not isolated: what ties their coordinates, and what holds near all of them.

A relation g(q) = 0 is solved for one coordinate to expand the motion about it; what was found is
then written in all coordinates again.  As the two signs of a root are conjugate, it holds on
the other branch as well.
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
        power = _root_of(self.root)[0]
        return [] if power is None else [power.base]

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
        power, factor, shift = _root_of(self.root)
        if power is None:
            return expression

        coordinates = power.free_symbols & {*self.coordinates}

        def plain(node: Expr) -> Expr:
            ratio = simplify(node.base / power.base)
            if ratio.free_symbols & coordinates:
                return node
            return ratio**node.exp * ((self.unknown - shift) / factor) ** (node.exp / power.exp)

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
