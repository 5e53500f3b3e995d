"""The shapes in which the formulas of one system are read."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from sympy import Add, Expr, Mul, S, Symbol, expand_mul

from lagcli.algebra import shape, simplify, terms
from lagcli.algebra.build import free_of
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.relations import Relations
from lagcli.algebra.terms import is_flat
from lagcli.algebra.writing import Writer
from lagcli.expression import ZERO, Expression, Name, Power, Product, Sum, operation_count, walk
from lagcli.mechanics.dynamics import Dynamics
from lagcli.notation.given_formulas import is_constant
from lagcli.rewriting import put_in

#: How many times as long as the shortest shape V may be as the file has it, and where it has
#: letters of its own for functions of the coordinates, such as heights, which are put in: the
#: heights of two pendulums are 1.17 times as long as what they make, m g (s - k h) is 1.11 times.
_GIVEN, _PUT_IN = 1.6, 1.14
#: How many times as long as the shortest shape the terms one by one may be.
_BY_TERMS = 1.25
#: How many times as long -dT/dq and -dV/dq apart may be.
_APART = 1.25


class Readable:
    """Trees of SymPy expressions, ordered as the system orders its names."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = system = dynamics.system
        fast = (*system.qdot, *system.qddot, *system.multipliers)
        self._leading = frozenset(symbol.name for symbol in fast)
        problem = system.problem
        letters = (n.name for n in walk(problem.potential or ZERO) if isinstance(n, Name))
        put_in = any(x in problem.definitions and not is_constant(problem, x) for x in letters)
        self._given = _PUT_IN if put_in else _GIVEN

    def as_written(self, expression: Expr) -> Expression:
        """The shortest shape, without using the constraints."""
        return shape(expression, self.system.order)

    def by_terms(self, expression: Expr, *, as_given: bool = False) -> Expression:
        """Term by term in velocities, accelerations, multipliers, as L and h are read."""
        given = self._given if as_given else 0
        return terms(expression, self.system.order, self._leading, as_given=given)

    def linear(self, expression: Expr) -> Expression:
        """Term by term, or with the parameters that all terms share before a bracket."""
        by_terms, short = self.by_terms(expression), self.as_written(expression)
        shorter = is_flat(short) and operation_count(short) < operation_count(by_terms)
        return short if shorter and self._is_of_rates(short) else by_terms

    def _is_of_rates(self, node: Expression) -> bool:
        """Whether no coordinate stands before a bracket, and no mass of all of T remains in it.

        But r² (m φ' + q B/2), R² (m φ' + q B/2).
        """
        factors = node.factors if isinstance(node, Product) else ()
        bases = [f.base if isinstance(f, Power) else f for f in factors]
        if any(isinstance(b, Name) and str(b) in self.system.names for b in bases):
            return False
        within = {
            str(p) for b in bases if isinstance(b, Sum) for p in walk(b) if isinstance(p, Name)
        }
        return not within & self._masses

    @cached_property
    def _masses(self) -> frozenset[str]:
        """The parameters by which all terms of second degree in the velocities are multiplied."""
        entries = [simplify(m) for row in self.dynamics.lagrange.mass_matrix for m in row if m != 0]
        shared = [{f.name for f in Mul.make_args(m) if f.is_Symbol} for m in entries]
        names = frozenset.intersection(*map(frozenset, shared)) if shared else frozenset()
        return names - {*self.system.names}

    def rate(self, moving: Expr, rest: Expr, shifts: Mapping[Symbol, Expr]) -> Expression:
        """p' as -dT/dq and -dV/dq, apart where that is not long; `rest` is dL/dq at rest.

        With p − b for a momentum p = m x' + b where that is no longer: U − R (p − K θ)/L.
        """
        plain = self._energies_apart(moving, rest)
        if not shifts or moving == 0:
            return plain
        moved = {p: p + b for p, b in shifts.items()}
        brackets: dict[Expression, Expression] = {
            Name(p.name): self.as_written(p - b) for p, b in shifts.items()
        }
        by_velocities = self._energies_apart(simplify(moving.xreplace(moved)), rest)
        shown = put_in(by_velocities, brackets)
        return shown if operation_count(shown) <= operation_count(plain) else plain

    def _energies_apart(self, moving: Expr, rest: Expr) -> Expression:
        together = self._rate(moving + rest)
        momenta = (*self.system.momenta, *self.system.multipliers)
        still = moving.xreplace(dict.fromkeys(momenta, S.Zero))
        if still != 0:
            moving, rest = simplify(moving - still), rest + still
        if moving == 0 or rest == 0 or still.has(*NO_VALUE):
            return together
        apart = Writer(self.system.order).sum([self._rate(moving), self._by_momenta(rest)])
        count, least = operation_count(apart), operation_count(together)
        if count <= least or (count <= _APART * least and not self._cancel(moving, rest)):
            return apart
        return together

    @staticmethod
    def _cancel(moving: Expr, rest: Expr) -> bool:
        """Whether a term of one is minus one of the other: k x (1 - m c²/sqrt(…)) - k x."""
        parts = (set(map(simplify, Add.make_args(expand_mul(e)))) for e in (-moving, rest))
        return not set.isdisjoint(*parts)

    def _rate(self, expression: Expr) -> Expression:
        """The shortest shape, or term by term in the momenta where that is not long."""
        by_terms = self._by_momenta(expression)
        short = self.as_written(expression)
        longer = operation_count(by_terms) > _BY_TERMS * operation_count(short)
        return short if longer else by_terms

    def _by_momenta(self, expression: Expr) -> Expression:
        return terms(expression, self.system.order, {p.name for p in self.system.momenta})

    def on_surface(self, expression: Expr, own: str = "") -> Expression:
        """The shortest shape, with the constraints used, by the coordinate `own` where it may be.

        With x = a phi either may stand: -a² k x/(M a² + I) for x'', -a² k phi/(...) for phi''.
        """
        tree, relations = self.dynamics.shapes.shape(expression), self._relations
        for values in self._multiples:
            other = expression.xreplace(values)
            if other == expression or not free_of(other, values):
                continue
            found = self.as_written(other)
            before = self.as_written(
                expression if relations is None else relations.substitute(expression)
            )
            has_own = [any(p == Name(own) for p in walk(each)) for each in (tree, found)]
            if has_own == [False, True] or (
                has_own[0] == has_own[1] and operation_count(found) < operation_count(before)
            ):
                tree = found
        return tree

    @property
    def _relations(self) -> Relations | None:
        return self.dynamics.constraints.relations

    @cached_property
    def _multiples(self) -> list[dict[Expr, Expr]]:
        """{phi: x/a, phi': (x/a)'} of each relation x = a phi of two coordinates, a(t) too."""
        relations, found = self._relations, []
        rates = dict(zip(self.system.q, self.system.qdot, strict=True))
        for q, value in ({} if relations is None else relations.solved).items():
            factor, other = value.as_independent(*rates, as_Add=False)
            if q in rates and other in rates and factor.is_nonzero:
                value = q / factor
                found.append({other: value, rates[other]: self.system.total_derivative(value)})
        return found
