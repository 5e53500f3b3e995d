"""The Legendre transform, the Hamiltonian and the canonical equations.

    H(q, p, t) = sum_j p_j q_j' - L,    q_j' = dH/dp_j,
    p_j' = -dH/dq_j + Q_j - dD/dq_j' + sum_k lambda_k a_kj

with the velocities solved from p_j = dL/dq_j': by linear algebra where L is quadratic in
them; otherwise through the radical of a relativistic L, or one velocity at a time.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 8.1 and 8.4.
Landau, Lifshitz, *The Classical Theory of Fields*, 4th ed., sections 9 and 16.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

import mpmath
import sympy
from mpmath import mpf
from sympy import Expr, Pow, Symbol

from lagcli.algebra import simplify, solve_linear
from lagcli.algebra.build import free_of
from lagcli.algebra.numeric import Evaluator
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.energy import EnergyFunction
from lagcli.mechanics.states import DIGITS, Contradiction


class Hamiltonian:
    """The Hamiltonian form of a system in all its coordinates."""

    def __init__(self, dynamics: Dynamics, energy: EnergyFunction) -> None:
        self.dynamics = dynamics
        self.energy = energy
        self.system = dynamics.system

    @cached_property
    def velocities(self) -> tuple[Expr, ...] | None:
        """q'(q, p, t), verified by substitution of p = dL/dq'; None where not inverted."""
        for solution in self._solutions():
            if self._inverts(solution):
                return solution
        return None

    @cached_property
    def function(self) -> Expr | None:
        """H(q, p, t); None where the Legendre transform was not inverted."""
        if self.velocities is None:
            return None
        system = self.system
        flow = dict(zip(system.qdot, self.velocities, strict=True))
        if self._is_quadratic:
            # H = (p - N) . q' / 2 - L(q' = 0), with N = dL/dq' at q' = 0
            at_rest = dict.fromkeys(system.qdot, sympy.S.Zero)
            momenta = self.dynamics.lagrange.momenta
            kinetic = sympy.Add(
                *(
                    (p - momentum.xreplace(at_rest)) * velocity / 2
                    for p, momentum, velocity in zip(
                        system.momenta, momenta, self.velocities, strict=True
                    )
                )
            )
            return simplify(kinetic - system.L.xreplace(at_rest))
        pv = sympy.Add(*(p * v for p, v in zip(system.momenta, self.velocities, strict=True)))
        return simplify(pv - system.L.xreplace(flow))

    @property
    def reason(self) -> str:
        """Why there is no Hamiltonian, or an empty text."""
        if self.velocities is not None:
            return ""
        if self.dynamics.degenerate:
            return "the Hessian of L is singular: the momenta do not determine the velocities"
        return "p = dL/dq' could not be solved for the velocities in closed form"

    @cached_property
    def canonical_equations(self) -> tuple[tuple[Expr, Expr], ...] | None:
        """(q_j', p_j') by coordinate, with multipliers, forces and dissipation."""
        if self.function is None or self.velocities is None:
            return None
        system, h = self.system, self.function
        flow = dict(zip(system.qdot, self.velocities, strict=True))
        pairs = []
        for j, (q, p) in enumerate(zip(system.q, system.momenta, strict=True)):
            force = system.applied_forces[j].xreplace(flow)
            constraint = sympy.Add(
                *(e.multiplier * e.row[j] for e in self.dynamics.constraints.equations)
            )
            if self._is_quadratic:
                pairs.append((simplify(h.diff(p)), simplify(-h.diff(q) + force + constraint)))
                continue
            # dH/dp = q'(q, p) and -dH/dq = dL/dq, which spares a derivative of roots and signs
            slope = system.L.diff(q).xreplace(flow)
            pairs.append((self.velocities[j], simplify(slope + force + constraint)))
        return tuple(pairs)

    # -- the inversion ------------------------------------------------------------------

    @cached_property
    def _is_quadratic(self) -> bool:
        return all(
            free_of(entry, self.system.qdot)
            for row in self.dynamics.lagrange.mass_matrix
            for entry in map(simplify, row)
        )

    def _solutions(self) -> Iterator[tuple[Expr, ...]]:
        if self.dynamics.degenerate:
            return
        if self._is_quadratic:
            solution = self._linear_solution(self.dynamics.lagrange.momenta)
            if solution is not None:
                yield solution
            return
        yield from self._through_radical()
        yield from self._one_by_one()

    def _linear_solution(self, momenta: tuple[Expr, ...]) -> tuple[Expr, ...] | None:
        """Solve p = M q' + N for q'."""
        system = self.system
        at_rest = dict.fromkeys(system.qdot, sympy.S.Zero)
        matrix = [[momentum.diff(v) for v in system.qdot] for momentum in momenta]
        right = [
            p - momentum.xreplace(at_rest)
            for p, momentum in zip(system.momenta, momenta, strict=True)
        ]
        solution = solve_linear(matrix, right, None)
        if solution is None or solution.singular:
            return None
        return tuple(solution.values)

    def _through_radical(self) -> Iterator[tuple[Expr, ...]]:
        """With s = sqrt(g(q, q')) the momenta are linear in q': solve, then s^2 = g for s."""
        radicals = {
            power.base
            for power in self.system.L.atoms(Pow)
            if not free_of(power.base, self.system.qdot)
            and power.exp.is_Rational
            and power.exp.q == 2
        }
        if len(radicals) != 1:
            return
        radicand = radicals.pop()
        s = Symbol("s", positive=True)
        momenta = tuple(
            momentum.replace(
                lambda e: isinstance(e, Pow) and e.base == radicand and e.exp.is_Rational,
                lambda e: s ** (2 * e.exp),
            )
            for momentum in self.dynamics.lagrange.momenta
        )
        if any(not free_of(m.diff(v), self.system.qdot) for m in momenta for v in self.system.qdot):
            return
        linear = self._linear_solution(momenta)
        if linear is None:
            return
        closure = radicand.xreplace(dict(zip(self.system.qdot, linear, strict=True))) - s**2
        numerator = sympy.numer(sympy.together(closure))
        polynomial = sympy.Poly(numerator, s)
        if polynomial.degree() > 4:
            return
        for root in sympy.roots(polynomial):
            yield tuple(v.xreplace({s: simplify(root)}) for v in linear)

    def _one_by_one(self) -> Iterator[tuple[Expr, ...]]:
        """Each momentum has only its own velocity in it: invert one polynomial at a time."""
        system = self.system
        chosen: list[list[Expr]] = []
        for momentum, v, p in zip(
            self.dynamics.lagrange.momenta, system.qdot, system.momenta, strict=True
        ):
            if momentum.free_symbols & (set(system.qdot) - {v}):
                return
            roots = _real_inverses(momentum, v, p)
            if not roots:
                return
            chosen.append(roots)
        if len(chosen) == 1:
            for root in chosen[0]:
                yield (root,)
        else:
            yield tuple(roots[0] for roots in chosen)

    def _inverts(self, velocities: tuple[Expr, ...]) -> bool:
        """Whether q'(q, dL/dq') = q' at random states."""
        system = self.system
        momenta = Evaluator(list(self.dynamics.lagrange.momenta), DIGITS + 10)
        inverse = Evaluator(list(velocities), DIGITS + 10)
        try:
            states = self.dynamics.states.take(3)
        except Contradiction:
            return False
        with mpmath.workdps(DIGITS + 10):
            for state in states:
                full = dict(state)
                full.update(zip(system.momenta, momenta(state), strict=True))
                try:
                    found = inverse(full)
                except (ArithmeticError, ValueError):
                    return False
                if any(
                    abs(value - state[v]) > mpf(10) ** -(DIGITS - 15)
                    for value, v in zip(found, system.qdot, strict=True)
                ):
                    return False
        return True


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
        if polynomial.degree() <= 4:
            return list(sympy.roots(polynomial))
        return []
    try:
        return [root for root in sympy.solve(momentum - p, v) if isinstance(root, Expr)]
    except (NotImplementedError, ValueError):
        return []
