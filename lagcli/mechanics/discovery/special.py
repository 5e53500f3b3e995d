"""Values of the parameters at which there are more charges, and which these are.

They are the roots of the factors on which the rank of the linear systems falls (`pivots`): equal
masses, the exponents of power laws, the frequency of a frame.  Where the functions of time of
the ansatz depend on each other, at frequencies in the ratio 1, 2 or 3, the rank tells nothing:
these are tried too, and the exponents at which a power makes the equations linear.  Under
constraints equal values are tried of parameters that change places with two coordinates.  At each
value the whole search is made anew, and what is found there is compared with what is found
everywhere.

References
----------
Jauch, Hill, Phys. Rev. 57 (1940) 641 (commensurate oscillators).
Bertrand, C. R. Acad. Sci. 77 (1873) 849 (r^2 and 1/r).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero, simplify, to_expression
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import solve_for
from lagcli.algebra.signs import sign
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.discovery.spectrum import Exponent
from lagcli.mechanics.discovery.surface import independent_on_surface
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System
from lagcli.problem_data import Problem
from lagcli.values import with_values_of

_RATIOS = (1, 2, 3)

Value = tuple[Symbol, Expr]


@dataclass(frozen=True, slots=True)
class SpecialCase:
    """A parameter's value, how many charges there are then, and those that come with it.

    With it the others that are `given` have their values.  The search there was up to a `degree`
    in the velocities.
    """

    parameter: Symbol
    value: Expr
    number: int
    charges: tuple[NoetherCharge, ...]
    degree: int
    given: tuple[Value, ...] = ()


def candidates(
    system: System, factors: Sequence[Expr], exponents: Sequence[Exponent]
) -> list[Value]:
    """Each once: roots of the factors, and frequencies that are commensurate."""
    found: dict[Value, None] = {}
    for factor in factors:
        found |= dict.fromkeys(_solved(factor, system.parameters))
    found |= dict.fromkeys(_commensurate(system.parameters, exponents))
    # of two signs the positive one: the other is the same system reflected
    return [
        (parameter, value)
        for parameter, value in found
        if not (
            value.free_symbols and value.could_extract_minus_sign() and (parameter, -value) in found
        )
    ]


def both_vanish(
    pairs: Sequence[tuple[Expr, Expr]], alone: Sequence[Expr], parameters: Sequence[Symbol]
) -> list[tuple[Value, Value]]:
    """Values of two parameters at which two factors vanish, and none that does it `alone`."""
    each = {frozenset(pair): pair for pair in _both_vanish(pairs, parameters)}
    return [
        pair for pair in each.values()
        if not any(is_zero(f.xreplace(dict(pair))) is True for f in alone)
    ]  # fmt: skip


def _both_vanish(
    pairs: Sequence[tuple[Expr, Expr]], parameters: Sequence[Symbol]
) -> Iterator[tuple[Value, Value]]:
    """The value of each without the other in it."""
    for one, other in pairs:
        for parameter, value in _solved(one, parameters):
            left = [p for p in parameters if p != parameter]
            for second, there in _solved(other.xreplace({parameter: value}), left):
                first = simplify(value.xreplace({second: there}))
                if _admissible(parameter, first):
                    yield (second, there), (parameter, first)


def problem_at(problem: Problem, parameter: Symbol, value: Expr) -> Problem | None:
    """The problem with the value put in, bare of candidates, questions and expectations."""
    given = {parameter.name: to_expression(value)}
    changed, mistakes = with_values_of(problem.with_values(given).bare, given)
    return None if mistakes else changed


def new_charges(
    known: Sequence[Expr], found: Sequence[NoetherCharge], dynamics: Dynamics, allowed: Allowance
) -> tuple[NoetherCharge, ...]:
    """Those that are no combinations of the known ones, over the constants, on the constraints."""
    system, charges = dynamics.system, [*known, *(c.charge for c in found)]
    try:
        if dynamics.constraints.equations:
            kept = independent_on_surface(charges, dynamics, allowed)
        else:
            variables = (system.t, *system.q, *system.qdot)
            kept = Relation([[x] for x in charges], variables, allowed).independent()
    except (NoPoint, ZeroDivisionError):
        return ()
    return tuple(found[k - len(known)] for k in kept if k >= len(known))


def exchanged(dynamics: Dynamics) -> list[Value]:
    """b = a where L and the constraints stay the same as a and b, x and y change places."""
    system = dynamics.system
    if any(kind != "holonomic" for kind in dynamics.constraints.kinds.values()):
        return []
    if any(is_zero(f) is not True for f in system.applied_forces):
        return []
    formulas = [system.L, *(e.f for e in dynamics.constraints.equations)]
    moving = [list(pair) for pair in zip(system.q, system.qdot, strict=True)]
    found: list[Value] = []
    for a, b in combinations(system.parameters, 2):
        for one, other in combinations(moving, 2):
            places = list(zip([a, *one], [b, *other], strict=True))
            swap = {x: y for pair in places for x, y in (pair, pair[::-1])}
            turned = [f.xreplace(swap) for f in formulas]
            if all(is_zero(f - g) is True for f, g in zip(formulas, turned, strict=True)):
                found.append((b, a))
                break
    return [(b, a) for b, a in found if _admissible(b, a)]


def special_powers(equations: SlotEquations) -> list[Expr]:
    """What vanishes where powers of coordinates are what others are not.

    One in the forcing is constant or of degree one, so that the equation may be linear; one in the
    inertia is a square, so that it may be that of a circle, or two are equal, and may turn into
    each other (Kasner's metrics).
    """
    q, inertia = equations.q, [m for row in equations.mass for m in row]
    squares = _open_exponents(inertia, q)
    return [
        *(e - k for e in _open_exponents(equations.forcing, q) for k in (0, 1)),
        *(e - 2 for e in squares),
        *(e - f for e, f in combinations(squares, 2)),
    ]


def _open_exponents(formulas: Sequence[Expr], q: Sequence[Symbol]) -> list[Expr]:
    """Those with parameters, of powers of coordinates."""
    powers = {p for f in formulas for p in f.atoms(sympy.Pow)}
    found = {p.exp for p in powers if p.exp.free_symbols and not free_of(p.base, q)}
    return sorted(found, key=sympy.default_sort_key)


def damped_powers(accelerations: Sequence[Expr], system: System) -> Iterator[Value]:
    """Where x'' + c x' + a x = b x^n has an integral that grows as exp of time.

    (n + 3)^2 a = 2 (n + 1) c^2, as 9 a = 2 c^2 for n = 3 (Leach, J. Math. Phys. 26 (1985) 2510).
    Beside x^2 and a force f there are two positions of rest, about which +-a, a^2 - 4 b f = a'^2.
    """
    q, found = system.q, dict[Value, None]()
    terms = [term for each in accelerations for term in sympy.Add.make_args(sympy.expand(each))]
    degrees = {sympy.Poly(term, *q).total_degree() for term in terms if term.is_polynomial(*q)}
    for x, u, acceleration in zip(q, system.qdot, accelerations, strict=True):
        others = dict.fromkeys({*q, *system.qdot} - {x, u}, sympy.S.Zero)
        own = sympy.expand(acceleration.xreplace(others))
        drag, force = own.coeff(u), own.coeff(u, 0)
        if drag == 0 or not free_of(drag, [system.t, x, u]) or not force.is_polynomial(x):
            continue
        constant, linear, square = (force.coeff(x, k) for k in range(3))
        for n in sorted(degree for degree in degrees if degree > 1):
            critical = sympy.Rational(2 * (n + 1), (n + 3) ** 2) * drag**2
            if n == 2 and free_of(force, [system.t]):
                relation = linear**2 - 4 * square * constant - critical**2
            elif constant == 0 and free_of(linear, [system.t]):
                relation = linear + critical
            else:
                continue
            for factor, _ in sympy.factor_list(sympy.numer(sympy.together(relation)))[1]:
                found |= dict.fromkeys(_solved(factor, system.parameters))
    yield from found


def rates_of_driving(L: Expr, t: Symbol) -> list[Expr]:
    """What vanishes where a sine, cosine or exponential of time in L is constant."""
    waves = {f for f in L.atoms(sympy.sin, sympy.cos, sympy.exp) if t in f.free_symbols}
    rates = {sympy.numer(sympy.together(f.args[0].diff(t))) for f in waves}
    return sorted((rate for rate in rates if rate.free_symbols), key=sympy.default_sort_key)


def resonant_waves(functions: Sequence[Expr], rest: Expr, q: Sequence[Symbol]) -> Iterator[Expr]:
    """What vanishes where cos(c q) of flat coordinates, or a product of two, is a wave of L.

    The ansatz takes both for independent: r cos(c theta) beside cos(theta) in a swinging Atwood
    machine, where 4 c^2 = 1 at M = 3 m.
    """
    own, given = (_wave_numbers(each, q) for each in (functions, (rest,)))
    for x, c in own:
        for d in (d for y, d in given if y == x and not (c / d).is_number):
            yield from (sympy.numer(sympy.together(k**2 * c**2 - d**2)) for k in (1, 2))


def _wave_numbers(formulas: Sequence[Expr], q: Sequence[Symbol]) -> list[tuple[Symbol, Expr]]:
    """The c of sin(c x + ...) and cos(c x + ...), by x."""
    arguments = {f.args[0] for each in formulas for f in each.atoms(sympy.sin, sympy.cos)}
    found = [(x, argument.diff(x)) for argument in sorted(arguments, key=str) for x in q]
    return list(dict.fromkeys((x, c) for x, c in found if c != 0 and free_of(c, q)))


# -- candidates ---------------------------------------------------------------------------


def _commensurate(parameters: Sequence[Symbol], exponents: Sequence[Exponent]) -> Iterator[Value]:
    """f = r g or g = r f for two frequencies: r^2 (f^2 + g^2)^2 = (1 + r^2)^2 f^2 g^2.

    Of two roots of one polynomial the sum and the product have no roots in them.
    """
    squares = list(dict.fromkeys(_squares(exponents)))
    for ratio in _RATIOS:
        for one, other in combinations(squares, 2):
            total, product = simplify(one + other), simplify(one * other)
            relation = ratio**2 * total**2 - (1 + ratio**2) ** 2 * product
            condition = sympy.expand(sympy.numer(sympy.together(relation)))
            if condition.is_number:  # the ratio of the frequencies has no parameter in it
                continue
            for factor, _ in sympy.factor_list(condition)[1]:
                if sign(factor) not in (1, -1):
                    yield from _solved(factor, parameters)


def _squares(exponents: Sequence[Exponent]) -> Iterator[Expr]:
    """Of frequencies; where exp(a t) and exp(-a t) stand for sine and cosine, -a^2."""
    for one in exponents:
        if one.growth == 0:
            yield sympy.expand(one.frequency**2)
        elif one.frequency == 0 and any(
            other.frequency == 0 and sympy.expand(one.growth + other.growth) == 0
            for other in exponents
        ):
            yield sympy.expand(-(one.growth**2))


def _solved(relation: Expr, parameters: Sequence[Symbol]) -> Iterator[Value]:
    """The admissible values of the last parameter that has some without roots, or else some."""
    found: list[tuple[Symbol, list[Expr]]] = []
    for parameter in reversed(parameters):
        if parameter in relation.free_symbols:
            roots = solve_for(relation, parameter)
            if roots is not None:
                found.append((parameter, [simplify(x) for x in roots.values]))
    found.sort(key=lambda solved: not all(map(_is_rational, solved[1])))
    for parameter, values in found[:1]:
        for value in values:
            if not value.has(sympy.I) and _admissible(parameter, value):
                yield parameter, value


def _is_rational(value: Expr) -> bool:
    return not any(p.exp.is_Rational and p.exp.q > 1 for p in value.atoms(sympy.Pow))


def _admissible(parameter: Symbol, value: Expr) -> bool:
    """Whether the assumptions on the parameter leave the value."""
    if value == 0:
        return not (parameter.is_nonzero or parameter.is_positive)
    if parameter.is_integer and value.is_integer is False:
        return False
    return not (parameter.is_positive and (value.is_negative or value.could_extract_minus_sign()))
