"""Hamilton-Jacobi with explicit time, where every coordinate is pushed by a force of time alone.

    H = A(p, t) - sum F_i(t) q_i,   dS/dt + H(dS/dq, t) = 0

has the complete integral S = sum (alpha_i + I_i) q_i - int A(alpha + I, t) dt with
I_i = int F_i dt.

References
----------
Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., chapter 10, exercise 8.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

from sympy import Add, Expr, S, Symbol

from lagcli.algebra import is_zero, simplify
from lagcli.algebra.antiderivative import antiderivative
from lagcli.algebra.build import free_of, symbol
from lagcli.mechanics.system import System
from lagcli.notation.naming import free
from lagcli.record import record


@record
class Driven:
    """S = sum momenta[j] q_j + of_time.

    Attributes
    ----------
    momenta
        dS/dq_j, functions of the time.
    constants
        alpha_j of a coordinate that is pushed, p_j of one that is not.
    integrals
        I = int F dt with no closed form, by its symbol; `momenta` and `rate` contain it.
    rate
        The derivative of `of_time`.
    of_time
        None where it has no closed form.
    """

    momenta: tuple[Expr, ...]
    constants: tuple[Symbol, ...]
    integrals: dict[Symbol, Expr]
    rate: Expr
    of_time: Expr | None


def driven(
    H: Expr, system: System, alpha: Callable[[int], Symbol], taken: Collection[str]
) -> Driven | None:
    """The complete integral, put back into the equation; None where H is not of that form."""
    q, p, t = system.q, system.momenta, system.t
    forces = [simplify(-H.diff(x)) for x in q]
    if not all(free_of(force, (*q, *p)) for force in forces):
        return None
    integrals: dict[Symbol, Expr] = {}
    constants: list[Symbol] = []
    momenta: list[Expr] = []
    for j, force in enumerate(forces):
        pushed = is_zero(force) is not True
        constants.append(alpha(1 + sum(c not in p for c in constants)) if pushed else p[j])
        impulse = antiderivative(force, t) if pushed else S.Zero
        if impulse is None:
            impulse = symbol(free(taken, f"I_{q[j].name}"))
            integrals[impulse] = force
        momenta.append(constants[j] + impulse)
    rest = simplify(Add(H, *(x * force for x, force in zip(q, forces, strict=True))))
    if not free_of(rest, q):
        return None
    rate = simplify(-rest.xreplace(dict(zip(p, momenta, strict=True))))
    closed = None if integrals else antiderivative(rate, t)
    found = Driven(tuple(momenta), tuple(constants), integrals, rate, closed)
    return found if _solves(found, H, system) else None


def _solves(found: Driven, H: Expr, system: System) -> bool:
    """Whether dS/dt + H(q, dS/dq, t) = 0, with dI/dt = F."""
    put_in = dict(zip(system.momenta, found.momenta, strict=True))
    rate = found.rate if found.of_time is None else found.of_time.diff(system.t)
    terms = [rate, H.xreplace(put_in)]
    for x, momentum in zip(system.q, found.momenta, strict=True):
        slope = momentum.diff(system.t)
        slope += Add(*(momentum.diff(i) * force for i, force in found.integrals.items()))
        terms.append(x * slope)
    return is_zero(Add(*terms)) is True
