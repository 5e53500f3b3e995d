"""The velocities from the momenta: p_j = dL/dq_j'(q, q', t) solved for q'.

The velocities fall into blocks that the Hessian of L does not couple, and each block is
inverted by itself: by linear algebra where its momenta are linear; where all that is not
linear in it is one function of the velocities (the radical of a relativistic L, the square
of a speed), by linear algebra and then for that function; and one velocity by inverting
its momentum.  An inverse counts when it leads back to the velocities at random states.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 8.1 and 8.4.
Landau, Lifshitz, *The Classical Theory of Fields*, 4th ed., sections 9 and 16.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Pow, Symbol

from lagcli.algebra import simplify, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.states import DIGITS, Contradiction

Block = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Auxiliary:
    """s = f(q, q')^(1/n), and what it is in the momenta."""

    symbol: Symbol
    function: Expr
    n: int
    root: Expr

    def put_into(self, expression: Expr) -> Expr:
        """The expression with s^n for f, so that no root of a root arises later."""
        return _with_root(expression, self.function, self.symbol, self.n)


@dataclass(frozen=True, slots=True)
class Inverse:
    """The velocities of a block, which may contain the auxiliary quantity."""

    velocities: tuple[Expr, ...]
    auxiliary: Auxiliary | None = None

    @property
    def explicit(self) -> tuple[Expr, ...]:
        """The velocities in coordinates, momenta and t alone."""
        if self.auxiliary is None:
            return self.velocities
        known = {self.auxiliary.symbol: self.auxiliary.root}
        return tuple(v.xreplace(known) for v in self.velocities)


class LegendreTransform:
    """q'(q, p, t) of a system."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        self.system = dynamics.system
        self.momenta = dynamics.lagrange.momenta

    @cached_property
    def velocities(self) -> tuple[Expr, ...] | None:
        """q' by coordinate; None where the momenta were not inverted."""
        if self._inverse is None:
            return None
        found = {j: v for block, x in self._inverse for j, v in zip(block, x.explicit, strict=True)}
        return tuple(simplify(found[j]) for j in range(len(found)))

    def in_phase_space(self, expression: Expr) -> Expr:
        """An expression in q, q', t as one in q, p, t; the momenta must have been inverted."""
        assert self._inverse is not None
        return self.with_momenta(expression, self._inverse)

    def with_momenta(self, expression: Expr, inverses: Sequence[tuple[Block, Inverse]]) -> Expr:
        """An expression with the velocities of some blocks replaced by their momenta."""
        flow: dict[Expr, Expr] = {}
        roots: dict[Expr, Expr] = {}
        for block, inverse in inverses:
            flow.update(zip((self.system.qdot[j] for j in block), inverse.velocities, strict=True))
            if inverse.auxiliary is not None:
                expression = inverse.auxiliary.put_into(expression)
                roots[inverse.auxiliary.symbol] = inverse.auxiliary.root
        return simplify(simplify(expression.xreplace(flow)).xreplace(roots))

    def inverse_of(self, block: Block) -> Inverse | None:
        """The velocities of a block by its momenta and the other velocities."""
        candidates = self._inverses(block)
        return next((x for x in candidates if self._inverts(block, x.explicit)), None)

    @cached_property
    def _inverse(self) -> list[tuple[Block, Inverse]] | None:
        if self.dynamics.degenerate:
            return None
        found = []
        for block in self._blocks:
            inverse = self.inverse_of(block)
            if inverse is None:
                return None
            found.append((block, inverse))
        return found

    @cached_property
    def is_quadratic(self) -> bool:
        """Whether the Hessian of L is free of velocities."""
        return all(free_of(entry, self.system.qdot) for row in self._hessian for entry in row)

    @cached_property
    def _hessian(self) -> list[list[Expr]]:
        return [[simplify(entry) for entry in row] for row in self.dynamics.lagrange.mass_matrix]

    @cached_property
    def _blocks(self) -> list[Block]:
        """The sets of velocities that the Hessian couples."""
        if self.is_quadratic:
            return [tuple(range(len(self.momenta)))]  # one linear system
        blocks: list[set[int]] = []
        for i, row in enumerate(self._hessian):
            joined = {i} | {j for j, entry in enumerate(row) if entry != 0}
            apart = [block for block in blocks if not block & joined]
            blocks = [*apart, joined.union(*(block for block in blocks if block & joined))]
        return [tuple(sorted(block)) for block in blocks]

    def _inverses(self, block: Block) -> Iterator[Inverse]:
        momenta = [self.momenta[j] for j in block]
        qdot = [self.system.qdot[j] for j in block]
        if all(free_of(p.diff(v), qdot) for p in momenta for v in qdot) or self.is_quadratic:
            linear = self._linear(block, momenta)
            if linear is not None:
                yield Inverse(linear)
            return
        yield from self._through_one_function(block, momenta)
        if len(block) == 1:
            for root in _real_inverses(momenta[0], qdot[0], self.system.momenta[block[0]]):
                yield Inverse((root,))

    def _linear(self, block: Block, momenta: list[Expr]) -> tuple[Expr, ...] | None:
        """Solve p = M q' + N for q'."""
        qdot = [self.system.qdot[j] for j in block]
        at_rest = dict.fromkeys(qdot, sympy.S.Zero)
        matrix = [[momentum.diff(v) for v in qdot] for momentum in momenta]
        right = [
            self.system.momenta[j] - momentum.xreplace(at_rest)
            for j, momentum in zip(block, momenta, strict=True)
        ]
        solution = solve_linear(matrix, right, None)
        return None if solution is None or solution.singular else tuple(solution.values)

    def _through_one_function(self, block: Block, momenta: list[Expr]) -> Iterator[Inverse]:
        """With s = f(q, q')^(1/n) the momenta are linear in q': solve, then s^n = f for s."""
        qdot = [self.system.qdot[j] for j in block]
        s = Symbol(f"s#{block[0]}", positive=True)  # no name of a file has a #
        functions = {
            power.base
            for momentum in momenta
            for power in _powers(momentum)
            if isinstance(power.base, sympy.Add) and not free_of(power.base, qdot)
        }
        for function in sorted(functions, key=sympy.default_sort_key):
            roots = [
                power.exp.q
                for momentum in momenta
                for power in _powers(momentum)
                if power.base == function
            ]
            n = max(roots)
            if any(n % q for q in roots):
                continue
            replaced = [_with_root(momentum, function, s, n) for momentum in momenta]
            if any(not free_of(m.diff(v), qdot) for m in replaced for v in qdot):
                continue
            linear = self._linear(block, replaced)
            if linear is None:
                continue
            closure = function.xreplace(dict(zip(qdot, linear, strict=True))) - s**n
            for root in _positive_roots(closure, s):
                yield Inverse(linear, Auxiliary(s, function, n, root))

    def _inverts(self, block: Block, velocities: tuple[Expr, ...]) -> bool:
        """Whether q'(q, dL/dq') = q' at random states."""
        system = self.system
        symbols = [system.momenta[j] for j in block]
        momenta = Evaluator([self.momenta[j] for j in block], DIGITS + 10)
        inverse = Evaluator(list(velocities), DIGITS + 10)
        try:
            states = self.dynamics.states.take(3)
        except Contradiction:
            return False
        with mpmath.workdps(DIGITS + 10):
            for state in states:
                full = dict(state)
                full.update(zip(symbols, momenta(state), strict=True))
                try:
                    found = inverse(full)
                except (ArithmeticError, ValueError):
                    return False
                if any(
                    abs(value - state[system.qdot[j]]) > mpf(10) ** -(DIGITS - 15)
                    for j, value in zip(block, found, strict=True)
                ):
                    return False
        return True


def _powers(expression: Expr) -> Iterator[Pow]:
    """The powers with rational exponents; a sum that is a factor is its own first power."""
    for part in sympy.preorder_traversal(expression):
        if isinstance(part, Pow) and part.exp.is_Rational:
            yield part
        elif isinstance(part, sympy.Mul):
            yield from (
                Pow(factor, 1, evaluate=False)
                for factor in part.args
                if isinstance(factor, sympy.Add)
            )


def _with_root(expression: Expr, function: Expr, s: Symbol, n: int) -> Expr:
    """The expression with f = s^n put in for every power of f."""
    return expression.replace(
        lambda e: isinstance(e, Pow) and e.base == function and e.exp.is_Rational,
        lambda e: s ** (n * e.exp),
    ).xreplace({function: s**n})


def _positive_roots(closure: Expr, s: Symbol) -> list[Expr]:
    """The roots of a polynomial in s that SymPy gives in radicals."""
    numerator = sympy.numer(sympy.together(closure))
    if not numerator.is_polynomial(s):
        return []
    polynomial = sympy.Poly(numerator, s)
    terms = sorted(m[0] for m in polynomial.monoms())
    if len(terms) == 2:  # a s^n + b s^k = 0: the positive root of s^(n - k) = -b / a
        low, high = terms
        ratio = -polynomial.coeff_monomial(s**low) / polynomial.coeff_monomial(s**high)
        above, below = simplify(ratio).as_numer_denom()
        power = sympy.Rational(1, high - low)
        return [(sign * above) ** power / (sign * below) ** power for sign in (1, -1)]
    return list(sympy.roots(polynomial)) if polynomial.degree() <= 4 else []


def _real_inverses(momentum: Expr, v: Symbol, p: Symbol) -> list[Expr]:
    """The v with momentum(v) = p that SymPy's polynomial roots or inverse functions give."""
    numerator = sympy.numer(sympy.together(momentum - p))
    if numerator.is_polynomial(v):
        polynomial = sympy.Poly(numerator, v)
        terms = [m[0] for m in polynomial.monoms()]
        if sorted(terms) == [0, max(terms)] and max(terms) % 2 == 1:
            # a v^n = c with n odd: the real root carries the sign
            n = max(terms)
            ratio = -polynomial.coeff_monomial(1) / polynomial.coeff_monomial(v**n)
            return [sympy.sign(ratio) * sympy.Abs(ratio) ** sympy.Rational(1, n)]
        return list(sympy.roots(polynomial)) if polynomial.degree() <= 4 else []
    try:
        return [root for root in sympy.solve(momentum - p, v) if isinstance(root, Expr)]
    except (NotImplementedError, ValueError):
        return []
