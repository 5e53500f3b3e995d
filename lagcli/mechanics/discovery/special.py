"""Values of the parameters at which there are more charges, and which these are.

Candidates are found, not guessed at random: equal parameters of one kind; 0 where it is
allowed; the values at which one frequency of the linear part is 1, 2 or 3 times another
(commensurate, or as omega = Omega/2 of a rotating frame); the exponents at which a power law
is that of the oscillator, of Kepler's problem or of the inverse square.  At each the whole
search is made anew, and what is found there is compared with what is found everywhere.

References
----------
Jauch, Hill, Phys. Rev. 57 (1940) 641 (commensurate oscillators).
Bertrand, C. R. Acad. Sci. 77 (1873) 849 (r^2 and 1/r).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, permutations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import simplify, to_expression
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import NoPoint, pivot_columns
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.slots import Equations
from lagcli.mechanics.discovery.spectrum import Exponent
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System
from lagcli.problem import Expect, Problem
from lagcli.record import replace
from lagcli.values import with_values_of

_MOST = 8
_RATIOS = (1, 2, 3)
_POWERS = (2, -1, -2)

Value = tuple[Symbol, Expr]


@dataclass(frozen=True, slots=True)
class SpecialCase:
    """A parameter's value, how many charges there are then, and those that come with it."""

    parameter: Symbol
    value: Expr
    number: int
    charges: tuple[NoetherCharge, ...]


def candidates(system: System, equations: Equations, exponents: Sequence[Exponent]) -> list[Value]:
    """At most a few, the simplest first, each once."""
    found = dict.fromkeys(
        (
            *_equal_or_zero(system.parameters, equations),
            *_commensurate(system.parameters, exponents),
            *_power_laws(system),
        )
    )
    return list(found)[:_MOST]


def problem_at(problem: Problem, parameter: Symbol, value: Expr) -> Problem | None:
    """The problem with the value put in, bare of candidates, questions and expectations."""
    given = to_expression(value)
    bare = replace(
        problem,
        parameters=tuple(
            replace(p, value=given) if p.name == parameter.name else p for p in problem.parameters
        ),
        find=(),
        symmetries=(),
        initial={},
        expect=Expect(),
    )
    changed, mistakes = with_values_of(bare, {parameter.name})
    return None if mistakes else changed


def new_charges(
    known: Sequence[Expr],
    found: Sequence[NoetherCharge],
    variables: Sequence[Symbol],
    allowed: Allowance,
) -> tuple[NoetherCharge, ...]:
    """Those that are no combinations of the known ones, over the constants."""
    vectors = [[x] for x in (*known, *(c.charge for c in found))]
    try:
        rows = Relation(vectors, variables, allowed).rows(len(vectors) + 4)
    except (NoPoint, ZeroDivisionError):
        return ()
    return tuple(found[k - len(known)] for k in pivot_columns(rows) if k >= len(known))


# -- candidates ---------------------------------------------------------------------------


def _equal_or_zero(parameters: Sequence[Symbol], equations: Equations) -> Iterator[Value]:
    """b = a for parameters that differ only in their number; c = 0 where that may be."""
    stem = {p: re.sub(r"_?\d+$|_?[a-zA-Z]$", "", p.name) for p in parameters}
    for one, other in combinations(parameters, 2):
        if stem[one] and stem[one] == stem[other] and one.name != stem[one]:
            yield other, one
    inertia = {s for row in equations.mass for m in row for s in m.free_symbols}
    for each in parameters:
        if each not in inertia and not (each.is_nonzero or each.is_integer):
            yield each, sympy.S.Zero


def _commensurate(parameters: Sequence[Symbol], exponents: Sequence[Exponent]) -> Iterator[Value]:
    """f^2 = r^2 g^2 for two frequencies, solved for the last parameter that it can be."""
    swinging = [e.frequency for e in exponents if e.growth == 0 and e.frequency != 0]
    for ratio in _RATIOS:
        for f, g in permutations(swinging, 2):
            relation = sympy.numer(sympy.together(sympy.expand(f**2 - ratio**2 * g**2)))
            for parameter in reversed(parameters):
                value = _solved(relation, parameter)
                if value is not None:
                    yield parameter, value
                    break


def _solved(relation: Expr, parameter: Symbol) -> Expr | None:
    """Of a relation linear or purely quadratic in it."""
    poly = relation.as_poly(parameter)
    if poly is None or poly.degree() not in (1, 2):
        return None
    *_, last = coefficients = poly.all_coeffs()
    if poly.degree() == 2 and coefficients[1] != 0:
        return None
    quotient = simplify(-last / coefficients[0])
    value = quotient if poly.degree() == 1 else simplify(sympy.sqrt(quotient))
    if value.has(sympy.I) or value == 0 or value.is_negative:
        return None
    return None if parameter.is_positive and value.could_extract_minus_sign() else value


def _power_laws(system: System) -> Iterator[Value]:
    """The exponents n at which a power of the coordinates is of degree 2, -1 or -2."""
    scale = Symbol("scale", positive=True)
    larger = {x: scale * x for x in system.q}
    for power in sorted(system.L.atoms(sympy.Pow), key=str):
        base, exponent = power.as_base_exp()
        own = [p for p in system.parameters if p in exponent.free_symbols]
        if len(own) != 1 or not base.free_symbols & set(system.q):
            continue
        degree = simplify(scale * base.xreplace(larger).diff(scale) / base.xreplace(larger))
        slope = exponent.diff(own[0])
        if degree.free_symbols or slope.free_symbols or degree == 0:
            continue
        for wanted in _POWERS:
            value = simplify(own[0] + (wanted / degree - exponent) / slope)
            if not value.free_symbols and not (own[0].is_positive and value.is_negative):
                yield own[0], value
