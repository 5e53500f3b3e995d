"""The velocities from the momenta: p_j = dL/dq_j'(q, q', t) solved for q'.

The velocities fall into blocks that the Hessian of L does not couple, and each block is
inverted by itself: by linear algebra where its momenta are linear; where all that is not
linear in it is one function of the velocities (the radical of a relativistic L, the square
of a speed), by linear algebra and then for that function; and one velocity by inverting
its momentum.  An inverse counts when it leads back to the velocities at random states.
The way back, q_j' = dH/dp_j solved for p, is the same with the parts exchanged.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 8.1 and 8.4.
Landau, Lifshitz, *The Classical Theory of Fields*, 4th ed., sections 9 and 16.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import chain
from typing import Any

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Pow, Symbol

from lagcli.algebra import is_zero, rank, simplify, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.equations import solve_for
from lagcli.algebra.jumps import is_continuous
from lagcli.algebra.numeric import DIGITS, Evaluator
from lagcli.algebra.positivity import deciding
from lagcli.algebra.signs import sign
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.states import Contradiction, State, is_real
from lagcli.record import record

Block = tuple[int, ...]
#: States at which, and values of v with which, a change of sign of the Hessian is looked for.
_STATES, _SIZES = 6, 48


@record
class Auxiliary:
    """s = f(q, v)^(1/n), and what it is in the images."""

    symbol: Symbol
    function: Expr
    n: int
    root: Expr

    def put_into(self, expression: Expr) -> Expr:
        """The expression with s^n for f, so that no root of a root arises later."""
        return _with_root(expression, self.function, self.symbol, self.n)


@record
class Inverse:
    """The variables of a block, which may contain the auxiliary quantity."""

    values: tuple[Expr, ...]
    auxiliary: Auxiliary | None = None

    @property
    def explicit(self) -> tuple[Expr, ...]:
        """The variables in coordinates, images and t alone."""
        if self.auxiliary is None:
            return self.values
        known = {self.auxiliary.symbol: self.auxiliary.root}
        return tuple(v.xreplace(known) for v in self.values)


class Inversion:
    """The variables v from a gradient w_j = dF/dv_j(q, v, t), inverted block by block.

    Parameters
    ----------
    function, gradient, hessian
        F, dF/dv_j and d2F/dv_i dv_j in the variables.
    variables, images
        The symbols v and w.
    states
        So many random states that give q, v, t and the parameters numbers.
    """

    def __init__(
        self,
        function: Expr,
        gradient: Sequence[Expr],
        hessian: Sequence[Sequence[Expr]],
        variables: Sequence[Symbol],
        images: Sequence[Symbol],
        states: Callable[[int], Sequence[State]],
    ) -> None:
        self.function = function
        self.gradient = gradient
        self.variables = variables
        self.images = images
        self._given_hessian = hessian
        self._states = states

    @cached_property
    def is_singular(self) -> bool:
        """Whether the gradient does not determine the variables at any state."""
        return rank(self._hessian) < len(self.variables)

    @cached_property
    def inverted(self) -> tuple[Expr, ...] | None:
        """v by place; None where the gradient was not inverted."""
        if self._inverse is None:
            return None
        found = {j: v for block, x in self._inverse for j, v in zip(block, x.explicit, strict=True)}
        return tuple(simplify(found[j]) for j in range(len(found)))

    def put_into(self, expression: Expr) -> Expr:
        """An expression in v as one in w; the gradient must have been inverted."""
        assert self._inverse is not None
        return self.with_images(expression, self._inverse)

    def with_images(self, expression: Expr, inverses: Sequence[tuple[Block, Inverse]]) -> Expr:
        """An expression with the variables of some blocks replaced by their images."""
        flow: dict[Expr, Expr] = {}
        roots: dict[Expr, Expr] = {}
        for block, inverse in inverses:
            flow.update(zip((self.variables[j] for j in block), inverse.values, strict=True))
            if inverse.auxiliary is not None:
                expression = inverse.auxiliary.put_into(expression)
                roots[inverse.auxiliary.symbol] = inverse.auxiliary.root
        undone = _undone(expression.xreplace(flow), self.images)
        return simplify(simplify(undone).xreplace(roots))

    def inverse_of(self, block: Block) -> Inverse | None:
        """The variables of a block by their images and the other variables."""
        candidates = (
            x for x in self._inverses(block) if not any(v.has(sympy.I) for v in x.explicit)
        )
        return next((x for x in candidates if self._inverts(block, x.explicit)), None)

    @cached_property
    def _inverse(self) -> list[tuple[Block, Inverse]] | None:
        if self.is_singular:
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
        """Whether the Hessian is free of the variables."""
        return all(free_of(entry, self.variables) for row in self._hessian for entry in row)

    @cached_property
    def folds(self) -> bool:
        """Whether det d2F/dv2 takes both signs as v varies, at every random state.

        Between them it is 0 or infinite, and more than one v has the same gradient.
        """
        if self.is_quadratic:
            return False
        source, size = random.Random(11), len(self.variables)
        whole = Evaluator([self.function, *self.gradient, *chain(*self._hessian)], DIGITS)
        try:
            states = self._states(_STATES)
        except Contradiction:
            return False
        with mpmath.workdps(DIGITS):
            for state in states:
                found = set()
                for k in range(_SIZES):
                    moved = {
                        v: source.uniform(-1, 1) * mpf(2) ** (k % 8 - 3) for v in self.variables
                    }
                    values = whole.where_defined({**state, **moved})
                    if values is None or not all(map(is_real, values)):
                        continue
                    found.add(_clear_sign(values[1 + size :], size))
                if not {1, -1} <= found:
                    return False
        return True

    @cached_property
    def _hessian(self) -> list[list[Expr]]:
        return [[simplify(entry) for entry in row] for row in self._given_hessian]

    @cached_property
    def _blocks(self) -> list[Block]:
        """The sets of variables that the Hessian couples."""
        if self.is_quadratic:
            return [tuple(range(len(self.gradient)))]  # one linear system
        rows = enumerate(self._hessian)
        return coupled({i, *(j for j, entry in enumerate(row) if entry != 0)} for i, row in rows)

    def _inverses(self, block: Block) -> Iterator[Inverse]:
        momenta = [self.gradient[j] for j in block]
        variables = [self.variables[j] for j in block]
        if bent := {u for p in momenta for u in _bends(p) if not free_of(u, variables)}:
            if len(block) == len(bent) == 1:
                inverses = _odd_inverses(momenta[0], variables[0], self.images[block[0]], *bent)
                yield from (Inverse((v,)) for v in inverses)
            return
        linear = self._linear(block, momenta)
        if linear is not None:
            yield Inverse(linear)
            return
        yield from self._through(sympy.exp, sympy.log, block, momenta)
        yield from self._through(sympy.log, sympy.exp, block, momenta)
        yield from self._through_one_function(block, momenta)
        if len(block) == 1:
            for root in _real_inverses(momenta[0], variables[0], self.images[block[0]]):
                yield Inverse((root,))

    def _linear(self, block: Block, momenta: list[Expr]) -> tuple[Expr, ...] | None:
        """Solve w = M v + N for v."""
        images = [self.images[j] for j in block]
        return _linear_in([self.variables[j] for j in block], momenta, images)

    def _through(
        self, function: type[Expr], inverse: type[Expr], block: Block, momenta: list[Expr]
    ) -> Iterator[Inverse]:
        """With E_k = exp(a_k v + b_k) the images are linear in v and E: solve, then take logs."""
        variables, images = ([each[j] for j in block] for each in (self.variables, self.images))
        powers = {e for p in momenta for e in p.atoms(function) if not free_of(e, variables)}
        flow = {e: sympy.Dummy() for e in sorted(powers, key=sympy.default_sort_key)}
        replaced = [p.xreplace(flow) for p in momenta]
        outside = [v for v in variables if any(not free_of(p, [v]) for p in replaced)]
        if not flow or len(outside) + len(flow) != len(block):
            return
        found = _linear_in([*outside, *flow.values()], replaced, images)
        if found is None:
            return
        values = dict(zip(outside, found, strict=False))
        rest = [v for v in variables if v not in values]
        inside = [e.args[0].xreplace(values) for e in flow]
        others = _linear_in(rest, inside, [inverse(x) for x in found[len(outside) :]])
        if others is not None:
            values |= zip(rest, others, strict=True)
            yield Inverse(tuple(values[v] for v in variables))

    def _through_one_function(self, block: Block, momenta: list[Expr]) -> Iterator[Inverse]:
        """With s = f(q, v)^(1/n) the images are linear in v: solve, then s^n = f for s."""
        variables = [self.variables[j] for j in block]
        s = Symbol(f"s#{block[0]}", positive=True)  # no name of a file has a #
        functions = {
            power.base
            for momentum in momenta
            for power in _powers(momentum)
            if isinstance(power.base, sympy.Add) and not free_of(power.base, variables)
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
            linear = self._linear(block, replaced)
            if linear is None:
                continue
            closure = function.xreplace(dict(zip(variables, linear, strict=True))) - s**n
            for root in _positive_roots(closure, s):
                yield Inverse(linear, Auxiliary(s, function, n, root))

    def _inverts(self, block: Block, found: tuple[Expr, ...]) -> bool:
        """Whether v(q, dF/dv) = v at random states."""
        images = [self.images[j] for j in block]
        gradient = Evaluator([self.gradient[j] for j in block], DIGITS + 10)
        inverse = Evaluator(list(found), DIGITS + 10)
        try:
            states = self._states(3)
        except Contradiction:
            return False
        with mpmath.workdps(DIGITS + 10):
            for state in states:
                full = dict(state)
                full.update(zip(images, gradient(state), strict=True))
                values = inverse.where_defined(full)
                if values is None or any(
                    abs(value - state[self.variables[j]]) > mpf(10) ** -(DIGITS - 15)
                    for j, value in zip(block, values, strict=True)
                ):
                    return False
        return True


class LegendreTransform(Inversion):
    """q'(q, p, t) of a system."""

    def __init__(self, dynamics: Dynamics) -> None:
        lagrange, system = dynamics.lagrange, dynamics.system
        super().__init__(
            system.L,
            lagrange.momenta,
            lagrange.mass_matrix,
            system.qdot,
            system.momenta,
            dynamics.states.take,
        )


def _clear_sign(entries: Sequence[Any], n: int) -> int:
    """Of the determinant of n rows with these entries; 0 where it is not seen."""
    real = [mpmath.re(entry) for entry in entries]
    value = mpmath.det(mpmath.matrix([real[k * n : (k + 1) * n] for k in range(n)]))
    scale = max(map(abs, real)) ** n
    return 0 if abs(value) <= mpf(10) ** -(DIGITS // 2) * scale else 1 if value > 0 else -1


def coupled(links: Iterable[set[int]]) -> list[Block]:
    """The blocks of what is linked, directly or through others."""
    blocks: list[set[int]] = []
    for link in links:
        apart = [block for block in blocks if not block & link]
        blocks = [*apart, link.union(*(block for block in blocks if block & link))]
    return [tuple(sorted(block)) for block in blocks]


def _linear_in(
    unknowns: Sequence[Expr], left: Sequence[Expr], right: Sequence[Expr]
) -> tuple[Expr, ...] | None:
    """The unknowns from left = right; None where they are not linear in it or not determined."""
    matrix = [[each.diff(x) for x in unknowns] for each in left]
    if not all(free_of(entry, unknowns) for row in matrix for entry in row):
        return None
    at_zero = dict.fromkeys(unknowns, sympy.S.Zero)
    rest = [b - a.xreplace(at_zero) for a, b in zip(left, right, strict=True)]
    solution = solve_linear(matrix, rest)
    return None if solution is None or solution.singular else tuple(solution.values)


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
        first = -1 if above.could_extract_minus_sign() else 1  # no quotient of imaginary roots
        signed = [(sign * above) ** power / (sign * below) ** power for sign in (first, -first)]
        return [root for root in signed if not root.has(sympy.I)]
    return _by_radicals(polynomial)


def _undone(expression: Expr, images: Sequence[Symbol]) -> Expr:
    """With asinh(sinh(x)) = x, and sign(p)^2 = 1, which is met where p may be 0 in |p| alone."""
    ones = {f(sympy.sign(p)): sympy.S.One for p in images for f in (sympy.Abs, lambda s: s**2)}
    return expression.xreplace(ones).replace(
        lambda node: isinstance(node, sympy.asinh) and isinstance(node.args[0], sympy.sinh),
        lambda node: node.args[0].args[0],
    )


def _real_inverses(momentum: Expr, v: Symbol, p: Symbol) -> list[Expr]:
    """The v with momentum(v) = p by polynomial roots or inverse functions."""
    numerator = sympy.numer(sympy.together(momentum - p))
    if numerator.is_polynomial(v):
        polynomial = sympy.Poly(numerator, v)
        terms = [m[0] for m in polynomial.monoms()]
        if sorted(terms) == [0, max(terms)] and max(terms) % 2 == 1:
            # a v^n = c with n odd: the real root carries the sign
            n = max(terms)
            ratio = -polynomial.coeff_monomial(1) / polynomial.coeff_monomial(v**n)
            return [sympy.sign(ratio) * sympy.Abs(ratio) ** sympy.Rational(1, n)]
        return _by_radicals(polynomial)
    if momentum.has(sympy.sinh, sympy.cosh):  # SymPy would write logarithms
        known = solve_for(momentum - p, v)
        if known is not None:
            return list(known.values)
    try:
        roots = sympy.solve(momentum - p, v)
    except (NotImplementedError, ValueError):
        return []
    return [x for x in roots if isinstance(x, Expr) and not x.has(sympy.Piecewise)]


def _by_radicals(polynomial: sympy.Poly) -> list[Expr]:
    """The roots up to the fourth degree, without those that SymPy has by cases."""
    found = sympy.roots(polynomial) if polynomial.degree() <= 4 else ()
    return [x for x in found if not x.has(sympy.Piecewise)]


def _bends(formula: Expr) -> set[Expr]:
    """Where it has kinks or jumps."""
    return {f.args[0] for f in formula.atoms(sympy.Abs, sympy.sign)}


def _odd_inverses(momentum: Expr, v: Symbol, p: Symbol, u: Expr) -> list[Expr]:
    """The same of a continuous odd function of u = a v + b: v = (sign(p) u(|p|) - b)/a."""
    slope, size = u.diff(v), sympy.Dummy("size", positive=True)
    if not free_of(slope, [v]) or not is_continuous(momentum):
        return []
    start = u.xreplace({v: sympy.S.Zero})
    forwards, backwards = (momentum.xreplace({v: (s * size - start) / slope}) for s in (1, -1))
    if is_zero(forwards + backwards) is not True:
        return []
    roots = _real_inverses(simplify(forwards), size, p)
    return [(sympy.sign(p) * x.xreplace({p: sympy.Abs(p)}) - start) / slope for x in roots]


def bending(hessian: Sequence[Sequence[Expr]], variables: Sequence[Symbol]) -> Expr | None:
    """What the sign of the determinant follows, a polynomial in the variables; None of others.

    Where it is 0 two branches of the transform meet.
    """
    whole = determinant(hessian)
    rest = sympy.S.One if whole is None else simplify(whole)
    bends = rest.is_polynomial(*variables) and not free_of(rest, variables)
    return deciding(rest) if bends else None


def at_rest_against_far(expression: Expr, variables: Sequence[Symbol]) -> list[Expr]:
    """Its value at rest times its sign far away along a variable: it takes both signs below 0.

    Of odd degree it has both signs far away.
    """
    still = expression.xreplace(dict.fromkeys(variables, sympy.S.Zero))
    found = []
    for v in variables:
        alone = expression.xreplace({u: sympy.S.Zero for u in variables if u != v})
        if alone.is_polynomial(v) and not free_of(alone, [v]):
            poly = sympy.Poly(alone, v)
            far = sign(poly.LC())
            found += [sympy.S.NegativeOne if poly.degree() % 2 else far * still] if far else []
    return found
