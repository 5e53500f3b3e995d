"""Whether an equilibrium is stable, as far as that can be proved.

Lagrange and Dirichlet: where V_eff = -L(q, q' = 0) has a strict minimum on the constraint
surface, the equilibrium is stable, also with gyroscopic terms and dissipation.  Without
gyroscopic terms a negative eigenvalue of K makes it unstable; so does, always, det K < 0.
The roots W of det(K - W M) are all real for symmetric K and M > 0, so the number of
negative ones shows in the signs of the coefficients (Descartes).

Kelvin, Tait and Chetaev: with dissipation that is complete (the symmetric part of C > 0) it is
asymptotically stable where K > 0, and unstable where K has a negative eigenvalue, whatever the
gyroscopic terms.  Where the dissipation is not complete, or the forces have no potential, the
criterion of Hurwitz decides.  Without dissipation gyroscopic terms may hold what is no minimum:
then only the spectrum is known, which is stability to first order.

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 23.  Arnold, *Mathematical Methods of
Classical Mechanics*, 2nd ed., section 22.  Chetaev, *The Stability of Motion*, chapter V.
Merkin, *Introduction to the Theory of Stability*, chapter 6.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sympy import Expr, Pow, Symbol, count_ops

from lagcli.algebra import simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.signs import sign
from lagcli.mechanics.oscillations.characteristic import Characteristic, determinant, determinant_in
from lagcli.mechanics.oscillations.evenness import even
from lagcli.mechanics.oscillations.feeding import cannot_feed
from lagcli.mechanics.oscillations.hurwitz import hurwitz_conditions
from lagcli.mechanics.oscillations.linearization import Linearization
from lagcli.mechanics.reduction.readable import is_positive, weak_sign
from lagcli.mechanics.reduction.spectrum import real_and_distinct
from lagcli.record import record

_MAY_FEED = "a force that is not linear, or has no potential, may feed energy"
#: What the file leaves open, and how it would say it.
NOT_DEFINITE = (
    "the kinetic energy is not known to be positive definite (say which parameters are: "
    "{assume: positive})"
)


@record
class Stability:
    """The verdict with its reason.

    Attributes
    ----------
    asymptotic
        Whether it is asymptotically stable, where it is stable.
    minimum, spectrum, hurwitz
        What must be positive for a minimum of V, for frequencies that are real and distinct,
        for roots that all have negative real parts; empty: it is always so.  None: not asked
        for, never so, or not decided.
    """

    stable: bool | None
    reason: str
    asymptotic: bool = False
    minimum: tuple[Expr, ...] | None = None
    spectrum: tuple[Expr, ...] | None = None
    hurwitz: tuple[Expr, ...] | None = None


def stability(linear: Linearization, characteristic: Characteristic) -> Stability:
    """The stability of the equilibrium that was linearised about."""
    if not linear.M:
        return Stability(None, "every displacement is excluded by the constraints")
    if not linear.regular:
        return Stability(None, "the mass matrix is singular there")
    powers = characteristic.in_s
    if powers is None or len(powers) != 2 * len(linear.M) + 1:
        return Stability(None, "the characteristic polynomial was not found")
    positive = linear.point.positive
    if not _same_on_branches(linear, powers):
        return Stability(None, "the motion near it differs along the family")
    # det K / det M, the product of the roots s of det(s² M + s C + K)
    constant = simplify(powers[0] / powers[-1])
    if linear.nonholonomic:
        if sign(constant, positive) == -1:
            return Stability(False, "a root of the characteristic polynomial is positive")
        return Stability(None, "the linearised forces have no potential on the surface")
    if not positive_definite(linear.M, positive):
        return Stability(None, NOT_DEFINITE)
    if not linear.has_potential:
        return _by_roots(linear, powers)
    complete = linear.damped and positive_definite(linear.damping, positive)
    if not complete and not cannot_feed(linear.system):
        return _by_roots(linear, powers) if linear.damped else Stability(None, _MAY_FEED)
    decided = complete or not linear.gyroscopic
    open_: list[tuple[Expr, ...]] = []
    for indicators in (_squares(linear, characteristic), _symmetric_functions(linear)):
        if indicators is None:
            continue
        signs = [sign(e, positive) for e in indicators]
        neutral = signs.count(0)
        if all(s in (0, 1) for s in signs) and _last_are_zero(signs):
            return _minimum(linear, neutral, powers, complete=complete)
        if -1 in signs and decided:
            return _no_minimum(linear)
        if not neutral and -1 not in signs:
            undecided = zip(indicators, signs, strict=True)
            open_.append(tuple(e for e, s in undecided if s is None))
    if sign(constant, positive) == -1:
        return Stability(False, "det K < 0: a root of the characteristic polynomial is positive")
    if open_ and decided:
        return Stability(None, "", complete, minimum=min(open_, key=_length))
    if not decided and sign(constant, positive) != 0:
        found = _by_roots(linear, powers)
        minimum = min(open_, key=_length) if open_ and found.hurwitz is None else None
        return replace(found, minimum=minimum)
    return Stability(None, "V_eff is not known to have a minimum there")


def _no_minimum(linear: Linearization) -> Stability:
    if not linear.gyroscopic:
        lead = "" if linear.damped else ": a squared frequency is negative"
        return Stability(False, f"V has no minimum there{lead}")
    return Stability(
        False,
        "V_eff has no minimum there, and all motions are damped (Kelvin, Tait and Chetaev)",
    )


def _by_roots(linear: Linearization, powers: Sequence[Expr]) -> Stability:
    """The verdict by the roots of the characteristic polynomial."""
    positive = linear.point.positive
    # det(s² M + s C + K) is even in s
    even = all(c == 0 for c in powers[1::2])
    conditions = real_and_distinct(linear) if even else hurwitz_conditions(powers)
    if conditions is None:
        return Stability(None, "the roots have no simple criterion")
    signs = [sign(e, positive) for e in conditions]
    if -1 in signs:
        return Stability(False, "a root of the characteristic polynomial has a positive real part")
    if 0 in signs or any(weak_sign(e, positive) == -1 for e in conditions):
        return Stability(None, "to first order it is at the limit of stability")
    open_ = tuple(e for e, s in zip(conditions, signs, strict=True) if s is None)
    if even:
        return Stability(None, "", spectrum=open_)
    if not open_:
        return Stability(True, "all roots have negative real parts (Hurwitz)", asymptotic=True)
    return Stability(None, "", asymptotic=True, hurwitz=open_)


def _last_are_zero(signs: list[int | None]) -> bool:
    """W may vanish in any place, e_j only from some j on."""
    return True if signs.count(0) == 0 else set(signs[-signs.count(0) :]) == {0}


def _length(expressions: tuple[Expr, ...]) -> int:
    return sum(int(count_ops(e)) for e in expressions)


def _minimum(
    linear: Linearization, neutral: int, powers: Sequence[Expr], *, complete: bool
) -> Stability:
    free = linear.point.free
    if neutral == 0:
        lead = "V has a strict minimum there"
        if complete:
            why = f"{lead}, and all motions are damped (Kelvin, Tait and Chetaev)"
            return Stability(True, why, asymptotic=True)
        if linear.damped and _by_roots(linear, powers).stable:
            why = f"{lead}, and the damping reaches all motions (Hurwitz)"
            return Stability(True, why, asymptotic=True)
        return Stability(True, f"{lead} (Lagrange and Dirichlet)")
    if neutral == len(linear.M):
        return Stability(None, "neutral: no force to first order")
    if neutral > len(free):
        return Stability(None, "neutral to first order in some direction")
    if not _even(linear):
        return Stability(None, "V has a minimum across the family, perhaps not evenly along it")
    return Stability(True, "V has a strict minimum across the family (Lagrange and Dirichlet)")


def _same_on_branches(linear: Linearization, powers: Sequence[Expr]) -> bool:
    """Whether no formula has the root by which one branch of a family was written."""
    if linear.point.family is None:
        return True
    rates = [simplify(power / powers[-1]) for power in powers]
    roots = {
        power
        for e in (*rates, *(e for row in (*linear.M, *linear.C) for e in row))
        for power in e.atoms(Pow)
        if not power.exp.is_Integer
    }
    return all(free_of(root, linear.system.q) for root in roots)


def _even(linear: Linearization) -> bool:
    point, dynamics = linear.point, linear.dynamics
    known = point.family
    return even(
        point.values if known is None else known.given,
        point.free,
        linear.forces_at_rest,
        [e.f for e in dynamics.constraints.equations if e.holonomic],
        linear.system.q,
        None if known is None else known.relation,
    )


def _squares(linear: Linearization, characteristic: Characteristic) -> list[Expr] | None:
    """The roots W, those that vanish last; None with velocity terms or without closed form."""
    factors = characteristic.squares
    if linear.damped or linear.gyroscopic or factors is None:
        return None
    squares: list[Expr] = []
    for roots, multiplicity, _ in factors:
        if roots is None:
            return None
        squares += [simplify(root) for root in roots] * multiplicity
    return sorted(squares, key=lambda W: W == 0)


def _symmetric_functions(linear: Linearization) -> list[Expr] | None:
    """e_1, …, e_n of the W_i: det(K + W M) = det M (W + W_1) … (W + W_n).

    The W_i are real, so all are positive just where all e_j are.
    """
    n = len(linear.M)
    W = Symbol("#W", real=True)
    matrix = [[W * linear.M[i][j] + linear.K[i][j] for j in range(n)] for i in range(n)]
    powers = determinant_in(W, matrix)
    if powers is None:
        return None
    return [simplify(power / powers[-1]) for power in powers[-2::-1]]


def positive_definite(matrix: list[list[Expr]], positive: tuple[Expr, ...]) -> bool:
    """Sylvester: all leading minors are positive."""
    for k in range(1, len(matrix) + 1):
        block = [row[:k] for row in matrix[:k]]
        minor = determinant(block)
        if minor is None or not is_positive(minor, positive):
            return False
    return True
