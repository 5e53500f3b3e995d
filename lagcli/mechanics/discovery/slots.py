"""When is a combination of the equations of motion a total derivative?

With the equations Delta_j = sum_k M_jk q_k'' - forcing_j = 0 and multipliers eta_j(t, q, q'),

    F = sum_j eta_j Delta_j = sum_i a_i q_i'' + b,   a_i = sum_j eta_j M_ji,
                                                    b   = - sum_j eta_j forcing_j,

is dQ/dt of some Q(t, q, q') exactly when the Euler operator annihilates F, which for such an
F is (subscripts are derivatives, D = d/dt + sum q' d/dq)

    (1)  a_i,v_k = a_k,v_i
    (2)  a_i,q_k + a_k,q_i + D a_k,v_i - b,v_i v_k = 0
    (3)  D s_i = b,q_i,      s_i = b,v_i - D a_i,

and then dQ/dv_i = a_i, dQ/dq_i = s_i.  For the equations of a Lagrangian the multipliers are
the characteristics eta_j = xi_j - q_j' tau of its symmetries up to a boundary term, which
takes no part (Noether); for other equations they are their integrating factors.  All is
linear in eta.

A *slot* is a fixed vector u(t, q, q'), and eta = sum over slots of f(t, q) u with unknown
functions f.  For f u the conditions hold f, its gradient, Df and D^2 f beside expressions
in u that are worked out once:

    (1)  f (a_i,v_k - a_k,v_i)
    (2)  f [a_i,q_k + a_k,q_i + D a_k,v_i - b,v_i v_k] + f,q_k a_i + f,q_i a_k + Df a_k,v_i
    (3)  f [D b,v_i - D^2 a_i - b,q_i] + Df [b,v_i - 2 D a_i] - D^2 f a_i - f,q_i b

References
----------
Olver, *Applications of Lie Groups to Differential Equations*, 2nd ed., sections 4.3 and 5.4.
Anco, Bluman, Eur. J. Appl. Math. 13 (2002) 545 (multipliers).
Prince, Eliezer, J. Phys. A 14 (1981) 587 (Kepler's problem).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import derivative, dot, simplify
from lagcli.algebra.linear import unit_vectors

Vector = tuple[Expr, ...]

#: (index of the jet of f, expression): jets are f, f,q_1 … f,q_n, Df, D^2 f.
Condition = list[tuple[int, Expr]]


@dataclass(frozen=True, slots=True)
class SlotEquations:
    """M q'' = forcing, with the symbols it is written in."""

    t: Symbol
    q: tuple[Symbol, ...]
    v: tuple[Symbol, ...]
    mass: tuple[tuple[Expr, ...], ...]
    forcing: tuple[Expr, ...]

    def convected(self, expression: Expr) -> Expr:
        """D = d/dt + sum v d/dq."""
        slopes = [derivative(expression, q) for q in self.q]
        return derivative(expression, self.t) + dot(self.v, slopes)


@dataclass(frozen=True, slots=True)
class Slot:
    """A vector u with what it is called: ("xi", j), ("tau",) or ("pair", i, j)."""

    kind: tuple[str | int, ...]
    vector: tuple[Expr, ...]

    def a(self, equations: SlotEquations) -> tuple[Expr, ...]:
        """a_i = sum_j u_j M_ji."""
        return tuple(dot(self.vector, column) for column in zip(*equations.mass, strict=True))

    def b(self, equations: SlotEquations) -> Expr:
        """b = -sum_j u_j forcing_j."""
        return -dot(self.vector, equations.forcing)

    def conditions(self, equations: SlotEquations) -> list[Condition]:
        """The conditions (1), (2), (3), in an order that is the same for all slots."""
        q, v, D = equations.q, equations.v, equations.convected
        n = len(q)
        rate, second = n + 1, n + 2  # Df and D^2 f among the jets
        a, b = self.a(equations), self.b(equations)
        by_v = [[derivative(a[k], v[i]) for i in range(n)] for k in range(n)]  # a_k,v_i
        b_v = [derivative(b, x) for x in v]
        Da = [D(x) for x in a]
        conditions: list[Condition] = [
            [(0, by_v[i][k] - by_v[k][i])] for i in range(n) for k in range(i)
        ]
        for i in range(n):
            for k in range(i + 1):
                inner = derivative(a[i], q[k]) + derivative(a[k], q[i])
                inner += D(by_v[k][i]) - derivative(b_v[i], v[k])
                conditions.append([(0, inner), (1 + k, a[i]), (1 + i, a[k]), (rate, by_v[k][i])])
        for i in range(n):
            inner = D(b_v[i]) - D(Da[i]) - derivative(b, q[i])
            conditions.append(
                [(0, inner), (rate, b_v[i] - 2 * Da[i]), (second, -a[i]), (1 + i, -b)]
            )
        return conditions


def point_slots(equations: SlotEquations) -> list[Slot]:
    """u = -q' for tau and the unit vectors for xi: the point transformations."""
    rates = Slot(("tau",), tuple(-v for v in equations.v))
    return [rates, *linear_slots(unit_vectors(len(equations.q)))]


def linear_slots(units: Sequence[Vector]) -> list[Slot]:
    """u = E_a: f is the displacement along it."""
    return [Slot(("xi", a), unit) for a, unit in enumerate(units)]


def quadratic_slots(equations: SlotEquations, units: Sequence[Vector] = ()) -> list[Slot]:
    """u = P_a E_b + P_b E_a (P_a E_a for a = b): f is K^ab of Q = K^ab P_a P_b / 2.

    P_a = E_a.p with p = M q'; the E_a are the unit vectors where no others are given.
    """
    units = units or [slot.vector for slot in point_slots(equations)[1:]]
    p = [dot(row, equations.v) for row in equations.mass]
    P = [simplify(dot(unit, p)) for unit in units]
    slots = []
    for a, E in enumerate(units):
        for b, F in enumerate(units[: a + 1]):
            both = (P[b] * x + (P[a] * y if a != b else 0) for x, y in zip(E, F, strict=True))
            slots.append(Slot(("pair", b, a), tuple(both)))
    return slots


def combined(slots: Sequence[tuple[Slot, Expr]], n: int) -> tuple[Expr, ...]:
    """eta = sum of f u."""
    return tuple(sympy.Add(*(f * slot.vector[j] for slot, f in slots)) for j in range(n))
