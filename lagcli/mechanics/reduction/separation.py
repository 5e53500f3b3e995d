"""Hamilton-Jacobi by separation in the coordinates that are given.

    H(q, dW/dq) = E,   S = -E t + sum W_i(q_i)

has a complete integral of that form just where (Levi-Civita), for all i < j,

    H^i H^j H_ij + H_i H_j H^ij - H_i H^j H^i_j - H^i H_j H_i^j = 0,

lower indices for d/dq, upper ones for d/dp.  The W_i are found one coordinate at a time: a
multiplier u(q_k)/g^kk parts mu (H - E) into A(q_k, p_k) + B(the others), which are constant
each.  What is found is put back: H(q, W') = E exactly.

References
----------
Levi-Civita, Math. Ann. 59 (1904) 383.
Landau, Lifshitz, *Mechanics*, 3rd ed., section 48.
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 10.4 and 10.5.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import combinations

import sympy
from sympy import Add, Expr, S, Symbol
from sympy.core.function import AppliedUndef

from lagcli.algebra import Field, is_zero, simplify
from lagcli.algebra.build import free_of, symbol
from lagcli.algebra.factors import factors_of
from lagcli.algebra.numeric import zero_at_random
from lagcli.algebra.ring import Monomial
from lagcli.algebra.signs import sign
from lagcli.mechanics.constraints import Constraints
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.minimal import minimal
from lagcli.mechanics.reduction.driven import Driven, driven
from lagcli.mechanics.reduction.known_signs import KnownSigns
from lagcli.notation.given_formulas import names_of
from lagcli.notation.naming import free
from lagcli.record import record

#: More coordinates than this are not tried.
MOST = 6
#: What the constants of separation are called: the first with which no name of the file clashes.
LETTERS = ("alpha", "beta", "gamma", "constant")
ON_TIME = "H depends on the time and is not linear in the coordinates"
_REFERENCES = (S.Zero, S.One, S(2), S(3))


@record
class Separated:
    """The separated equations `equations[j] = 0` and what W_j' they give, by coordinate."""

    equations: dict[int, Expr]
    derivatives: dict[int, Expr]
    constants: tuple[Symbol, ...]


def levi_civita(
    H: Expr, q: Sequence[Symbol], p: Sequence[Symbol]
) -> tuple[bool | None, tuple[int, int] | None]:
    """Levi-Civita's condition on an H(q, p) without t.

    Returns
    -------
    separates : bool or None
        Whether the Hamilton-Jacobi equation separates in these coordinates; None: undecided.
    obstacle : tuple of int or None
        The first pair of coordinates at which the condition fails.

    References
    ----------
    Levi-Civita, Math. Ann. 59 (1904) 383.
    """
    open_ = False
    for i, j in combinations(range(len(q)), 2):
        condition = _condition(H, (q[i], q[j]), (p[i], p[j]))
        # of a double pendulum in space its normal form takes minutes
        holds = zero_at_random(condition) is not False and is_zero(condition)
        if holds is False:
            return False, (i, j)
        open_ = open_ or holds is None
    return (None if open_ else True), None


def _condition(H: Expr, q: Sequence[Symbol], p: Sequence[Symbol]) -> Expr:
    """H^i H^j H_ij + H_i H_j H^ij - H_i H^j H^i_j - H^i H_j H_i^j of two coordinates."""
    di, dj, ui, uj = (H.diff(x) for x in (*q, *p))
    return Add(
        ui * uj * di.diff(q[1]), di * dj * ui.diff(p[1]),
        -di * uj * ui.diff(q[1]), -ui * dj * di.diff(p[1]),
    )  # fmt: skip


def nonzero_for_all_parameters(expression: Expr, state: Sequence[Symbol]) -> bool:
    """Whether an expression is no 0 in the state, whatever values the parameters have.

    So it is where a monomial in functions of the state alone has a coefficient of one sign;
    of r^n + r^2 this is not known, nor of n (n - 2) r^n, nor with functions left open.
    """
    if expression.has(AppliedUndef):
        return False
    field = Field([expression])
    numerator = field(expression).numerator
    entered = [generator.expression for generator in field.generators]
    of_state = {k for k, e in enumerate(entered) if not free_of(e, state)}
    if any(not e.free_symbols <= {*state} for e in (entered[k] for k in of_state)):
        return False
    coefficients: dict[Monomial, list[tuple[Monomial, int]]] = {}
    for monomial, number in field.ring.terms(numerator):
        moving = tuple(pair for pair in monomial if pair[0] in of_state)
        constant = tuple(pair for pair in monomial if pair[0] not in of_state)
        coefficients.setdefault(moving, []).append((constant, number))
    values = (field.polynomial(field.ring.build(terms)) for terms in coefficients.values())
    return any(sign(field.to_sympy(value)) in {1, -1} for value in values)


def _why_constrained(constraints: Constraints) -> str:
    """Why constraints leave no H of independent coordinates without t."""
    quick = sum(kind != "holonomic" for kind in constraints.kinds.values())
    if quick:
        return f"there {'is a constraint' if quick == 1 else 'are constraints'} on the velocities"
    moving = sum(is_zero(e.drift) is not True for e in constraints.equations)
    if moving:
        depend = "a constraint depends" if moving == 1 else "constraints depend"
        return f"{depend} explicitly on the time"
    if len(constraints.equations) == 1:
        return "the constraint is not solved for a coordinate"
    return "the constraints are not solved for coordinates"


class Separation:
    """The separation of one Hamiltonian.

    Attributes
    ----------
    reason
        Why there is no answer, in a sentence; empty otherwise.
    """

    def __init__(self, derivation: Derivation) -> None:
        self.derivation = minimal(derivation)
        self.system = self.derivation.system
        self.reason = ""
        self._used = used = names_of(derivation.given)
        used.add(*self.system.order)
        self.E = symbol(free(used, "E", "h", "E_0", "h_0"))
        self._letter = next(
            x for x in LETTERS if not any(f"{x}_{n}" in used for n in range(1, MOST))
        )
        self._alphas: list[Symbol] = []

    @cached_property
    def hamiltonian(self) -> Expr | None:
        """H(q, p); None with a reason where there is none of that kind."""
        dynamics, system = self.derivation.dynamics, self.system
        if dynamics.constraints.equations:
            self.reason = _why_constrained(dynamics.constraints)
        elif not system.q:
            self.reason = "the constraints leave no coordinate"
        elif any(is_zero(force) is not True for force in system.applied_forces):
            self.reason = "a force that is not in L acts"
        elif len(system.q) > MOST:
            self.reason = f"more than {MOST} coordinates are not tried"
        elif self.derivation.hamiltonian.function is None:
            self.reason = self.derivation.hamiltonian.reason
        elif is_zero(self.derivation.hamiltonian.function.diff(system.t)) is not True:
            self.reason = ON_TIME
        return None if self.reason else self.derivation.hamiltonian.function

    @cached_property
    def driven(self) -> Driven | None:
        """The complete integral where H depends on the time by forces F(t) alone."""
        if self.hamiltonian is not None or self.reason != ON_TIME:
            return None
        H = self.derivation.hamiltonian.function
        assert H is not None
        return driven(H, self.system, lambda n: symbol(f"{self._letter}_{n}"), self._used)

    @cached_property
    def obstacle(self) -> tuple[int, int] | None:
        """The first pair of coordinates at which Levi-Civita's test fails."""
        return self._tested[1]

    @cached_property
    def in_general(self) -> bool:
        """Whether it does not separate, but may for special values of the parameters."""
        if self.hamiltonian is None or self.obstacle is None:
            return False
        q, p = ([x[j] for j in self.obstacle] for x in (self.system.q, self.system.momenta))
        failing = _condition(self.hamiltonian, q, p)
        state = (*self.system.q, *self.system.momenta)
        return not nonzero_for_all_parameters(failing, state)

    @property
    def separable(self) -> bool | None:
        """Whether the variables separate in these coordinates; None where undecided."""
        return self._tested[0]

    @cached_property
    def _tested(self) -> tuple[bool | None, tuple[int, int] | None]:
        H = self.hamiltonian
        return (None, None) if H is None else levi_civita(H, self.system.q, self.system.momenta)

    @cached_property
    def positive(self) -> tuple[Expr, ...]:
        """The constants that are positive wherever all W' are real."""
        found: list[Expr] = []
        separated = self.separated
        if separated is None:
            return ()
        for _ in range(2):
            for constant in (self.E, *self._alphas):
                for root in separated.derivatives.values():
                    squared = root**2 if isinstance(root, sympy.Pow) else None
                    if squared is None or constant in found:
                        continue
                    if KnownSigns(squared, found).sign(constant) == 1:
                        found.append(constant)
        return tuple(found)

    # -- the separated equations ------------------------------------------------------------------

    @cached_property
    def separated(self) -> Separated | None:
        """The parts of a complete integral, proved by substitution; None with a reason."""
        H = self.hamiltonian
        if H is None or self.separable is False:
            return None
        q, p = self.system.q, self.system.momenta
        cyclic = [j for j in range(len(q)) if is_zero(H.diff(q[j])) is True]
        others = [j for j in range(len(q)) if j not in cyclic]
        momenta = tuple(p[j] for j in cyclic)
        if not others:  # the energy is a function of the constants p
            return Separated({}, dict(zip(cyclic, momenta, strict=True)), momenta)
        F = _without_root(simplify(H - self.E), p)
        equations = self._parted(F, others)
        if equations is None:
            self.reason = "the separated equations were not found"
            return None
        derivatives: dict[int, Expr] = {j: p[j] for j in cyclic}
        for j, equation in equations.items():
            solved = _solved(equation, p[j])
            if solved is None:
                self.reason = f"the equation of {q[j].name} is not quadratic in its momentum"
                return None
            derivatives[j] = solved
        put_in = {p[j]: value for j, value in derivatives.items()}
        if is_zero(F.xreplace(put_in)) is not True:
            self.reason = "the separated equations could not be verified by substitution"
            return None
        return Separated(equations, derivatives, (self.E, *momenta, *self._alphas))

    def _parted(self, F: Expr, coordinates: list[int]) -> dict[int, Expr] | None:
        """The equations of single coordinates that together are F = 0."""
        if len(coordinates) == 1:
            return {coordinates[0]: F}
        for k in coordinates:
            rest = [j for j in coordinates if j != k]
            multiplier = self._multiplier(F, k, rest)
            parts = None if multiplier is None else self._split(simplify(multiplier * F), k, rest)
            if parts is None:
                continue
            one, others = parts
            alpha = symbol(f"{self._letter}_{len(self._alphas) + 1}")
            # the part that the energy is not in is +alpha
            sign = -1 if free_of(others, [self.E]) else 1
            self._alphas.append(alpha)
            below = self._parted(simplify(others + sign * alpha), rest)
            if below is not None:
                return {k: simplify(one - sign * alpha), **below}
            self._alphas.pop()
        return None

    def _multiplier(self, F: Expr, k: int, rest: Sequence[int]) -> Expr | None:
        """u(q_k)/g^kk with u g^jj/g^kk free of q_k, without a constant factor."""
        q, p = self.system.q, self.system.momenta
        own = simplify(F.diff(p[k], 2))
        if own == 0 or not free_of(own, p):
            return None
        for j in rest:
            other = simplify(F.diff(p[j], 2))
            if other == 0 or not free_of(other, p):
                continue
            factor, scale = S.One, S.One
            for part, power in factors_of(other / own):
                if free_of(part, q):
                    scale *= part**power
                elif free_of(part, [q[i] for i in range(len(q)) if i != k]):
                    factor *= part**-power
                elif not free_of(part, [q[k]]):
                    return None
            return 2 * factor / (own * scale)
        return None

    def _split(self, G: Expr, k: int, rest: Sequence[int]) -> tuple[Expr, Expr] | None:
        """(A(q_k, p_k), B(the others)) with A + B = G."""
        q, p = self.system.q, self.system.momenta
        own, theirs = (q[k], p[k]), tuple(x for j in rest for x in (q[j], p[j]))
        if any(is_zero(G.diff(x, y)) is not True for x in own for y in theirs):
            return None
        for terms in (Add.make_args(sympy.expand(G)), _terms(G)):
            one = [term for term in terms if free_of(term, theirs)]
            others = [term for term in terms if not free_of(term, theirs)]
            if free_of(Add(*others), own):
                return Add(*one), Add(*others)
        for value in _REFERENCES:
            try:
                first = simplify(G.subs([(x, value if x in q else S.Zero) for x in theirs]))
            except ZeroDivisionError:
                continue
            if first.has(sympy.zoo, sympy.nan, sympy.oo):
                continue
            second = simplify(G - first)
            if free_of(second, own):
                return first, second
        return None


def _without_root(F: Expr, momenta: Sequence[Symbol]) -> Expr:
    """A + C sqrt(B) = 0 as C² B - A² = 0, for a relativistic energy; F where there is none.

    sqrt(B) = -A/C is the energy of motion, which is not negative on any motion.
    """
    roots = [
        power
        for power in F.atoms(sympy.Pow)
        if power.exp.is_Rational and power.exp.q == 2 and not free_of(power.base, momenta)
    ]
    if {power.exp for power in roots} != {S.Half} or len({power.base for power in roots}) != 1:
        return F
    root = sympy.Dummy(positive=True)
    plain = F.xreplace({roots[0]: root})
    A, C = plain.xreplace({root: S.Zero}), plain.diff(root)
    if not free_of(C, [root, *momenta]) or not free_of(A, momenta):
        return F
    return simplify(C**2 * roots[0].base - A**2)


def _terms(expression: Expr) -> list[Expr]:
    """The terms of the numerator, each over the denominator and cancelled."""
    field = Field([expression])
    element = field(expression)
    below = field.polynomial(element.denominator)
    ring = field.ring
    return [
        field.to_sympy(field.polynomial(ring.build([term])) / below)
        for term in ring.terms(element.numerator)
    ]


def _solved(equation: Expr, p: Symbol) -> Expr | None:
    """The p with equation(p) = 0, with the positive root; None where it is not quadratic."""
    a, b = simplify(equation.diff(p, 2)), simplify(equation.diff(p).xreplace({p: S.Zero}))
    c = equation.xreplace({p: S.Zero})
    if not free_of(a, [p]) or is_zero(equation - a * p**2 / 2 - b * p - c) is not True:
        return None
    if a == 0:
        return None if b == 0 else simplify(-c / b)
    # a p²/2 + b p + c = 0
    if b == 0:
        return sympy.sqrt(simplify(-2 * c / a))
    middle = simplify(b / a)
    return sympy.sqrt(simplify(middle**2 - 2 * c / a)) - middle
