"""Whether an equilibrium is stable, as far as that can be proved.

Lagrange and Dirichlet: where V_eff = -L(q, q' = 0) has a strict minimum on the constraint
surface, the equilibrium is stable, also with gyroscopic terms and dissipation.  Without
gyroscopic terms a negative eigenvalue of K makes it unstable; so does, always, det K < 0.
The roots W of det(K - W M) are all real for symmetric K and M > 0, so the number of
negative ones shows in the signs of the coefficients (Descartes).

References
----------
Landau, Lifshitz, *Mechanics*, 3rd ed., section 23.  Arnold, *Mathematical Methods of
Classical Mechanics*, 2nd ed., section 22.  Chetaev, *The Stability of Motion*, chapter V.
"""

from __future__ import annotations

from sympy import Expr, Symbol, count_ops

from lagcli.algebra import simplify
from lagcli.algebra.signs import sign
from lagcli.mechanics.oscillations.characteristic import Characteristic, determinant, determinant_in
from lagcli.mechanics.oscillations.linearization import Linearization
from lagcli.record import record


@record
class Stability:
    """The verdict with its reason; `where` are the signs that decide when they are open."""

    stable: bool | None
    reason: str
    where: tuple[Expr, ...] = ()


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
    # det K / det M, the product of the roots s of det(s² M + s C + K)
    constant = simplify(powers[0] / powers[-1])
    if linear.nonholonomic or not linear.has_potential:
        if sign(constant, positive) == -1:
            return Stability(False, "a root of the characteristic polynomial is positive")
        return Stability(None, "the linearised forces have no potential on the surface")
    if not _positive_definite(linear.M, positive):
        return Stability(None, "the kinetic energy is not known to be positive definite")
    open_: list[tuple[Expr, ...]] = []
    for indicators in (_squares(linear, characteristic), _symmetric_functions(linear)):
        if indicators is None:
            continue
        signs = [sign(e, positive) for e in indicators]
        neutral = signs.count(0)
        if all(s in (0, 1) for s in signs) and _last_are_zero(signs):
            return _minimum(linear, neutral)
        if -1 in signs and not linear.damped and not linear.gyroscopic:
            return Stability(False, "V has no minimum there: a squared frequency is negative")
        if not neutral and -1 not in signs:
            undecided = zip(indicators, signs, strict=True)
            open_.append(tuple(e for e, s in undecided if s is None))
    if sign(constant, positive) == -1:
        return Stability(False, "det K < 0: a root of the characteristic polynomial is positive")
    if linear.gyroscopic or not open_:
        return Stability(None, "V_eff is not known to have a minimum there")
    return Stability(None, "it depends on the parameters", min(open_, key=_length))


def _last_are_zero(signs: list[int | None]) -> bool:
    """W may vanish in any place, e_j only from some j on."""
    return True if signs.count(0) == 0 else set(signs[-signs.count(0) :]) == {0}


def _length(expressions: tuple[Expr, ...]) -> int:
    return sum(int(count_ops(e)) for e in expressions)


def _minimum(linear: Linearization, neutral: int) -> Stability:
    free = linear.point.free
    if neutral == 0:
        return Stability(True, "V has a strict minimum there (Lagrange and Dirichlet)")
    if neutral == len(linear.M):
        return Stability(None, "neutral: no force to first order")
    if neutral > len(free):
        return Stability(None, "neutral to first order in some direction")
    names = ", ".join(q.name for q in free)
    return Stability(True, f"V has a strict minimum there up to displacements of {names}")


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


def _positive_definite(matrix: list[list[Expr]], positive: tuple[Expr, ...]) -> bool:
    """Sylvester: all leading minors are positive."""
    for k in range(1, len(matrix) + 1):
        block = [row[:k] for row in matrix[:k]]
        minor = determinant(block)
        if minor is None or sign(minor, positive) != 1:
            return False
    return True
