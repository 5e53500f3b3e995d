"""Whether Q(q, p, t), P(q, p, t) is canonical, its generating function and the new Hamiltonian.

It is canonical when {Q_i, Q_j} = {P_i, P_j} = 0 and {Q_i, P_j} = delta_ij, extended canonical
with valence c when {Q_i, P_j} = c delta_ij with a constant c.  Then

    c sum p dq - sum P dQ = dF   (at constant t),    K = c H + dF/dt,

    F1(q, Q, t):  c p = dF1/dq,   P = -dF1/dQ        F2(q, P, t):  c p = dF2/dq,   Q = dF2/dP
    F3(p, Q, t):  c q = -dF3/dp,  P = -dF3/dQ        F4(p, P, t):  c q = -dF4/dp,  Q = dF4/dP

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., sections 9.1 (table 9.1), 9.4, 9.5.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of, symbol
from lagcli.algebra.signs import sign
from lagcli.mechanics.canonical.inverse import candidates
from lagcli.mechanics.canonical.poisson import poisson
from lagcli.mechanics.phase_states import PhaseStates
from lagcli.mechanics.system import System
from lagcli.mechanics.verify import conjunction
from lagcli.problem_data import CanonicalTransformation
from lagcli.record import record
from lagcli.statements.answers import Verification

#: States at which K is tested where the normal form does not decide.
_EVERYWHERE = 12


@record
class TestedBracket:
    """{left, right} = value, where `expected` should stand; the names are the new ones."""

    left: str
    right: str
    value: Expr
    expected: Expr


@record
class GeneratedRelation:
    """`left` = `right`, a derivative of the generating function, and whether it holds."""

    left: Expr
    right: Expr
    holds: bool | None


class CanonicalTest:
    """One transformation of the phase space of a system.

    Attributes
    ----------
    old : tuple of Symbol
        q_1, …, p_1, …
    new : tuple of Symbol
        Q_1, …, P_1, …
    functions : tuple of Expr
        The new variables in the old ones.
    """

    def __init__(self, system: System, given: CanonicalTransformation) -> None:
        self.system = system
        self.given = given
        self.old = (*system.q, *system.momenta)
        names = tuple(given.coordinates)
        self.Q = tuple(symbol(name) for name in names)
        self.P = tuple(symbol(f"p_{name}") for name in names)
        self.new: tuple[Symbol, ...] = (*self.Q, *self.P)
        self.functions = tuple(
            system.build(each)
            for each in (*given.coordinates.values(), *(given.momenta[name] for name in names))
        )
        self.states = PhaseStates(system, self.functions)

    @cached_property
    def put_in(self) -> Mapping[Expr, Expr]:
        """New variable -> its function of the old ones."""
        return dict(zip(self.new, self.functions, strict=True))

    # -- brackets -----------------------------------------------------------------------------

    @cached_property
    def brackets(self) -> tuple[tuple[int, int, Expr], ...]:
        """(i, j, {new_i, new_j}) for i < j."""
        count = len(self.new)
        return tuple(
            (i, j, poisson(self.functions[i], self.functions[j], self.system))
            for i in range(count)
            for j in range(i + 1, count)
        )

    @cached_property
    def valence(self) -> Expr:
        """c: the bracket of the first pair where it is a constant that is not 0, 1 otherwise."""
        n = len(self.Q)
        first = next(value for i, j, value in self.brackets if (i, j) == (0, n))
        constant = free_of(first, [*self.old, self.system.t]) and not first.is_zero
        return first if constant else sympy.S.One

    @cached_property
    def _verdicts(self) -> tuple[tuple[TestedBracket, bool | None, Verification | None], ...]:
        n, found = len(self.Q), []
        for i, j, value in self.brackets:
            expected = self.valence if j == i + n else sympy.S.Zero
            verdict, how = self.states.vanishes(value - expected)
            bracket = TestedBracket(self.new[i].name, self.new[j].name, value, expected)
            found.append((bracket, verdict, how))
        return tuple(found)

    @property
    def preserves(self) -> bool | None:
        """Whether all brackets are as they must be, for the valence."""
        return conjunction(verdict for _, verdict, _ in self._verdicts)

    @property
    def failing(self) -> tuple[TestedBracket, ...]:
        """The brackets that are not what a canonical transformation has."""
        return tuple(bracket for bracket, verdict, _ in self._verdicts if verdict is False)

    @property
    def in_general(self) -> bool:
        """Whether values of the parameters may make it canonical, though it is not for others."""
        off = [bracket.value - bracket.expected for bracket in self.failing]
        off += [] if self.failing else [self.valence - 1]
        parameters = {*self.system.parameters}
        return bool(parameters) and all(
            not simplify(each).free_symbols.isdisjoint(parameters) and sign(each) not in (1, -1)
            for each in off
        )

    @property
    def verified(self) -> Verification:
        """How the brackets were decided."""
        alike = all(how == "exact" for _, _, how in self._verdicts)
        return "exact" if alike else "50 digits"

    # -- the generating function ------------------------------------------------------------------

    @cached_property
    def generating(self) -> Expr | None:
        """The generating function of the file, in its own variables."""
        if self.given.generating is None:
            return None
        names = {s.name: s for s in self.new}
        return self.system.build.knowing(names)(self.given.generating)

    @cached_property
    def relations(self) -> tuple[GeneratedRelation, ...]:
        """What the derivatives of the given generating function should be, in the old variables."""
        F, c = self.generating, self.valence
        if F is None:
            return ()
        olds, news, kept, made = {
            "F1": (self.system.q, self.Q, self.system.momenta, self.P),
            "F2": (self.system.q, self.P, self.system.momenta, self.Q),
            "F3": (self.system.momenta, self.Q, self.system.q, self.P),
            "F4": (self.system.momenta, self.P, self.system.q, self.Q),
        }[self.given.kind]
        of_old = 1 if olds == self.system.q else -1
        of_new = 1 if news == self.P else -1
        pairs = [(c * k, of_old * F.diff(v)) for k, v in zip(kept, olds, strict=True)]
        pairs += [(m, of_new * F.diff(v)) for m, v in zip(made, news, strict=True)]
        return tuple(
            GeneratedRelation(
                left,
                simplify(right.xreplace(self.put_in)),
                self.states.vanishes((left - right).xreplace(self.put_in))[0],
            )
            for left, right in pairs
        )

    @property
    def generates(self) -> bool | None:
        """Whether the given function generates the transformation."""
        return conjunction(relation.holds for relation in self.relations)

    @cached_property
    def action_form(self) -> Expr | None:
        """F(q, p, t) with c sum p dq - sum P dQ = dF; None where no integral was found."""
        n = len(self.Q)
        Q, P = self.functions[:n], self.functions[n:]
        old_momenta = (*(self.valence * p for p in self.system.momenta), *([sympy.S.Zero] * n))
        return self._integral(
            [
                p - sympy.Add(*(b * a.diff(v) for a, b in zip(Q, P, strict=True)))
                for p, v in zip(old_momenta, self.old, strict=True)
            ]
        )

    def _integral(self, gradient: list[Expr]) -> Expr | None:
        """The function of the old variables with this gradient, each step verified."""
        total: Expr = sympy.S.Zero
        for slope, variable in zip(gradient, self.old, strict=True):
            part = antiderivative(simplify(slope - total.diff(variable)), variable)
            if part is None:
                return None
            total += part
        total = simplify(total)
        exact = (
            self.states.vanishes(total.diff(variable) - slope)[0]
            for slope, variable in zip(gradient, self.old, strict=True)
        )
        return total if all(verdict is True for verdict in exact) else None

    # -- the new Hamiltonian --------------------------------------------------------------------

    @cached_property
    def explicit_part(self) -> Expr | None:
        """dF/dt in the old variables, up to a function of t: K - c H.

        It has the derivatives dQ_i/dt by P_i and -dP_i/dt by Q_i.
        """
        t, n = self.system.t, len(self.Q)
        if all(free_of(f, [t]) for f in self.functions):
            return sympy.S.Zero
        if self.generating is not None and self.generates:
            return simplify(self.generating.diff(t).xreplace(self.put_in))
        Q, P = self.functions[:n], self.functions[n:]
        return self._integral(
            [
                sympy.Add(
                    *(
                        a.diff(t) * b.diff(v) - b.diff(t) * a.diff(v)
                        for a, b in zip(Q, P, strict=True)
                    )
                )
                for v in self.old
            ]
        )

    def new_hamiltonian(self, hamiltonian: Expr) -> tuple[Expr, Verification] | None:
        """K(Q, P, t), put back into the old variables; None where that was not reached.

        Without a generating function of the file, F is chosen so that no term of K depends on
        the time alone.
        """
        if self.explicit_part is None:
            return None
        old = simplify(self.valence * hamiltonian + self.explicit_part)
        found = [
            (K, K.xreplace(self.put_in) - old)
            for each in self._in_new_variables(old)
            for K in self._without_signs(each)
        ]
        for K, difference in found:
            if is_zero(difference) is True:
                return self._without_time(K), "exact"
        # an inverse of a sine or cosine is one of a branch, which no normal form decides
        states = PhaseStates(self.system, (old, *self.functions), reach=3.0)
        for K, difference in found:
            if states.is_zero_at_states(difference, _EVERYWHERE):
                return self._without_time(K), "50 digits"
        return None

    def _without_time(self, K: Expr) -> Expr:
        """K less its terms of the time alone, which no canonical equation has."""
        if self.generating is not None or free_of(K, [self.system.t]):
            return K
        parts = sympy.Add.make_args(sympy.expand(K))
        alone = [x for x in parts if free_of(x, self.new) and not free_of(x, [self.system.t])]
        return simplify(K - sympy.Add(*alone)) if alone else K

    def _without_signs(self, K: Expr) -> Iterator[Expr]:
        """K, before it K with v for |v|, which may be what the other branches have in common."""
        signs: dict[Expr, Expr] = {sympy.Abs(v): v for v in self.new}
        if K.has(*signs):
            yield simplify(K.xreplace(signs))
        yield K

    def _in_new_variables(self, function: Expr) -> Iterator[Expr]:
        if free_of(function, self.old):
            yield function
            return
        equations = list(zip(self.functions, self.new, strict=True))
        for inverse in candidates(equations, self.old):
            K = simplify(function.xreplace(dict(inverse)))
            if free_of(K, self.old):
                yield K
