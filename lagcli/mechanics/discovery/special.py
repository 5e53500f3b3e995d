"""Values of the parameters at which there are more charges, and which these are.

They are the roots of the factors on which the rank of the linear systems falls (`pivots`): equal
masses, the exponents of power laws, the frequency of a frame.  Where the functions of time of
the ansatz depend on each other, at frequencies in the ratio 1, 2 or 3, the rank tells nothing:
these are tried too, and what makes an equation linear, a curvature constant, or the system one
without time.  Under constraints equal values are tried of parameters that change places with two
coordinates.  At each value the whole search is made anew, and what is found there is compared
with what is found everywhere.

References
----------
Jauch, Hill, Phys. Rev. 57 (1940) 641 (commensurate oscillators).
Bertrand, C. R. Acad. Sci. 77 (1873) 849 (r^2 and 1/r).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import dot, is_zero, simplify, to_expression
from lagcli.algebra.build import free_of
from lagcli.algebra.equations import solve_for
from lagcli.algebra.signs import sign
from lagcli.mechanics.discovery.limits import Allowance
from lagcli.mechanics.discovery.metric import Metric
from lagcli.mechanics.discovery.relation import Relation
from lagcli.mechanics.discovery.slots import SlotEquations
from lagcli.mechanics.discovery.spectrum import Exponent, has_roots
from lagcli.mechanics.discovery.surface import independent_on_surface
from lagcli.mechanics.dynamics import Dynamics
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.system import System
from lagcli.problem_data import Problem
from lagcli.values import with_values_of

_MOST_CURVED = 3  # coordinates

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
    dynamics: Dynamics,
    factors: Sequence[Expr],
    exponents: Sequence[Exponent],
    ratios: Sequence[int],
) -> list[Value]:
    """Each once: roots of the factors, and exponents with frequencies in these ratios."""
    parameters, found = dynamics.system.parameters, dict[Value, None]()
    for factor in factors:
        found |= dict.fromkeys(_solved(factor, parameters))
    found |= dict.fromkeys(_commensurate(parameters, exponents, ratios))
    return [
        (parameter, value)
        for parameter, value in found
        if not (value.free_symbols and value.could_extract_minus_sign())
        or (parameter, -value) not in found
        or not is_reflected(dynamics, (parameter, value))
    ]


def is_reflected(dynamics: Dynamics, value: Value) -> bool:
    """Whether -p for p is the same system with some axes, or the time, turned round.

    False where the parameter may not have the other sign.
    """
    system, (parameter, there) = dynamics.system, value
    if not _admissible(parameter, -there):
        return False
    formulas = [system.L, *system.applied_forces]
    held = [e.f for e in dynamics.constraints.equations]
    for time, *axes in product((1, -1), repeat=1 + len(system.q)):
        moving = zip(axes, system.q, system.qdot, strict=True)
        images = {x: y for s, q, v in moving for x, y in ((q, s * q), (v, s * time * v))}
        images |= {system.t: time * system.t, parameter: -parameter}
        if all(
            is_zero(s * f.xreplace(images) - f) is True
            for s, f in zip((1, *axes), formulas, strict=True)
        ) and all(any(is_zero(f.xreplace(images) - s * f) is True for s in (1, -1)) for f in held):
            return True
    return False


def both_vanish(
    pairs: Sequence[tuple[Expr, Expr]], alone: Sequence[Expr], parameters: Sequence[Symbol]
) -> list[tuple[Value, Value]]:
    """Values of two parameters at which two factors vanish, and none that does it `alone`."""
    each = {frozenset(pair): pair for pair in _both_vanish(pairs, parameters)}
    return [
        pair for pair in each.values()
        if not any(is_zero(f.xreplace(dict(pair))) is True for f in alone)
    ]  # fmt: skip


def both_missing(
    values: Sequence[Value], inertia: Sequence[Expr], system: System, rest: Expr
) -> list[tuple[Value, Value]]:
    """Two parameters that are 0 together: each was tried, or one is of the inertia.

    Or what is left of L at rest has no coordinates then, and has some where one alone is 0.
    """
    tried = [p for p, value in values if value == 0]

    def is_free(*zeros: Value) -> bool:
        return free_of(rest.xreplace(dict(zeros)), system.q)

    return [
        (p, r)
        for p, r in combinations(missing(system.parameters), 2)
        if {p[0], r[0]} <= {*tried} or {p[0], r[0]} & {*inertia}
        or (is_free(p, r) and not is_free(p) and not is_free(r))
    ]  # fmt: skip


def missing(parameters: Sequence[Symbol]) -> list[Value]:
    """0 for each that may be 0."""
    return [(p, sympy.S.Zero) for p in parameters if _admissible(p, sympy.S.Zero)]


def beside(one: Value, others: Sequence[Value]) -> Iterator[tuple[Value, Value]]:
    """A value and each of the others of another parameter."""
    parameter, value = one
    for other in others:
        there = value.xreplace(dict([other]))
        apart = other[0] != parameter and parameter not in other[1].free_symbols
        if apart and _admissible(parameter, there):
            yield other, (parameter, there)


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
    if not found:
        return ()
    if dynamics.constraints.equations:
        kept = independent_on_surface(charges, dynamics, allowed)
    else:
        variables = (system.t, *system.q, *system.qdot)
        kept = Relation([[x] for x in charges], variables, allowed).independent()
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


def equal_inertias(system: System) -> list[Value]:
    """b = a of (a p^2 + b q^2)/2, as of two moments of a body."""
    still = dict.fromkeys(system.qdot, sympy.S.Zero)
    inertias = [
        p for p in system.parameters
        if (slope := system.L.diff(p)) != 0
        and free_of(slope, [p])
        and is_zero(slope.xreplace(still)) is True
        and not any(slope.diff(v).xreplace(still) for v in system.qdot)
    ]  # fmt: skip
    return [
        (b, a) for a, b in combinations(inertias, 2)
        if a.is_positive == b.is_positive and _admissible(b, a)
    ]  # fmt: skip


def special_powers(equations: SlotEquations) -> list[Expr]:
    """What vanishes where powers of coordinates are what others are not.

    One in the forcing is constant or of degree one, or is so over the inertia of a coordinate
    alone, so that the equation may be linear; one in the inertia is a square, so that it may be
    that of a circle, or two are equal, and may turn into each other (Kasner's metrics).
    """
    q, inertia = equations.q, [m for row in equations.mass for m in row]
    squares, forces = _open_exponents(inertia, q), _open_exponents(equations.forcing, q)
    shared = _by_base(inertia, q[0]) if len(q) == 1 else {}
    alone = [
        e - n - int(base != sympy.E)
        for base, exponents in (_by_base(equations.forcing, q[0]).items() if shared else ())
        for e in exponents for n in shared.get(base, ())
    ]  # fmt: skip
    return [
        *(e - k for e in forces for k in (0, 1)),
        *(each for each in alone if each.free_symbols),
        *(e - 2 for e in squares),
        *(e - f for e, f in combinations(squares, 2)),
    ]


def _by_base(formulas: Sequence[Expr], x: Symbol) -> dict[Expr, list[Expr]]:
    """The exponents of powers of x, 1 + x, ..., and by e the rates of exponentials of x."""
    found: dict[Expr, list[Expr]] = {}
    for term in (t for f in formulas for t in sympy.Add.make_args(sympy.expand_mul(f))):
        for base, exponent in term.as_powers_dict().items():
            rate = exponent.diff(x) if base == sympy.E else exponent
            if rate != 0 and free_of(rate, [x]) and (base == sympy.E or not free_of(base, [x])):
                found.setdefault(base, []).append(rate)
    return found


def special_inertia(equations: SlotEquations) -> list[Expr]:
    """What vanishes where a term of the inertia is missing, or two exponentials in it are alike.

    And where a + b cos(q) is a square.
    """
    inertia = sympy.Tuple(*(m for row in equations.mass for m in row))
    waves = [f for f in inertia.atoms(sympy.exp) if not free_of(f, equations.q)]
    slopes = (simplify(f.args[0].diff(x)) for f in waves for x in equations.q)
    rates = sorted({r for r in slopes if r != 0 and free_of(r, equations.q)}, key=str)
    alike = [r + sign * s for r, s in combinations(rates, 2) for sign in (-1, 1)]
    sums = [f for f in sympy.preorder_traversal(sympy.factor(inertia)) if f.is_Add]
    for wave in sorted(inertia.atoms(sympy.cos, sympy.cosh), key=str):
        for a, b in ((f.coeff(wave, 0), f.coeff(wave)) for f in sums if not free_of(f, [wave])):
            alike += [a - b, a + b] if free_of(sympy.Tuple(a, b), equations.q) else []
    return [*_parameters(inertia, equations), *alike]


def special_curvature(equations: SlotEquations) -> list[Expr]:
    """What vanishes where the curvature of the inertia is constant, which in general it is not."""
    inertia = sympy.Tuple(*(m for row in equations.mass for m in row))
    parameters = _parameters(inertia, equations)
    fixed = free_of(inertia, [equations.t, *equations.v])
    if not (parameters and fixed and 1 < len(equations.q) <= _MOST_CURVED):
        return []
    condition = Metric(equations.q, equations.mass).constant_where(parameters)
    return [factor for factor in _factors(condition) if not factor.atoms(sympy.Function)]


def _factors(relation: Expr) -> list[Expr]:
    """Of its numerator; none of a relation that always holds."""
    above = sympy.expand(sympy.numer(sympy.together(relation)))
    return [] if above.is_number else [factor for factor, _ in sympy.factor_list(above)[1]]


def _parameters(formula: Expr, equations: SlotEquations) -> list[Expr]:
    moving = {equations.t, *equations.q, *equations.v}
    return sorted(formula.free_symbols - moving, key=str)


def _open_exponents(formulas: Sequence[Expr], q: Sequence[Symbol]) -> list[Expr]:
    """Those with parameters, of powers of coordinates; n - 1 of x^n/x as well as n."""
    powers = {p.as_base_exp() for f in formulas for p in f.atoms(sympy.Pow)}
    for term in (term for f in formulas for term in sympy.Add.make_args(sympy.expand(f))):
        powers |= {*term.as_powers_dict().items()}
    found = {e for base, e in powers if e.free_symbols and not free_of(base, q)}
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
        drag, force = own.coeff(u), _by_power(own.coeff(u, 0), x)
        if drag == 0 or not free_of(drag, [system.t, x, u]) or force is None:
            continue
        constant, linear, square = (force.get(sympy.Integer(k), sympy.S.Zero) for k in range(3))
        still = free_of(sympy.Tuple(constant, linear, square), [system.t])
        open_ = [n for n in force if n.free_symbols]
        for n in (*map(sympy.Integer, sorted(k for k in degrees if k > 1)), *open_):
            critical = 2 * (n + 1) * drag**2 / (n + 3) ** 2
            if n == 2 and still:
                relation = linear**2 - 4 * square * constant - critical**2
            elif constant == 0 and still:
                relation = linear + critical
            else:
                continue
            for factor in _factors(relation):
                found |= dict.fromkeys(_solved(factor, system.parameters))
    yield from found


def _by_power(force: Expr, x: Symbol) -> dict[Expr, Expr] | None:
    """The coefficients of x^n by n, which may have parameters; None of another function of x."""
    found: dict[Expr, Expr] = {}
    for term in sympy.Add.make_args(force):
        coefficient, rest = term.as_independent(x, as_Add=False)
        exponent = rest.as_powers_dict().get(x, sympy.S.Zero)
        if not free_of(sympy.powsimp(rest / x**exponent), [x]):
            return None
        found[exponent] = found.get(exponent, sympy.S.Zero) + coefficient
    return found


def rates_of_driving(L: Expr, t: Symbol) -> list[Expr]:
    """What vanishes where a wave of time in L is constant, or a^2 + 2 b t + c t^2 a square."""
    waves = {f for f in L.atoms(sympy.sin, sympy.cos, sympy.exp) if t in f.free_symbols}
    rates = {sympy.numer(sympy.together(f.args[0].diff(t))) for f in waves}
    roots = {p.base for p in L.atoms(sympy.Pow) if not p.exp.is_Integer and p.base.is_polynomial(t)}
    rates |= {sympy.discriminant(base, t) for base in roots if sympy.degree(base, t) == 2}
    return sorted((rate for rate in rates if rate.free_symbols), key=sympy.default_sort_key)


def steady_in_another_time(equations: SlotEquations, rest: Expr) -> Iterator[Expr]:
    """What vanishes where f(t) T - g(t) V, V of degree n, does not change in another time.

    With tau' = 1/f it is T - f g V; with x = tau y and the time -1/tau it is T - f g tau^(n + 2) V
    (Liouville).  For f = t^p exp(r t), one of them 0, tau is t^(1 - p) or exp(-r t).  Without the
    time that is n = -2, which keeps a dilation, in a trap too.
    """
    t, q = equations.t, equations.q
    inertia = {_time_factor(m, t) for row in equations.mass for m in row if m != 0}
    if len(inertia) > 1:
        return
    p, r = inertia.pop() or (None, None)
    for term in sympy.Add.make_args(sympy.expand(rest)):
        s, d = _time_factor(term, t) or (None, None)
        if p is None or s is None or r is None or d is None:
            continue
        n = simplify(dot(q, [term.diff(x) for x in q]) / term)  # Euler
        more = [n + 2] if free_of(n, q) else []
        if r == d == 0:
            yield from (p + s + (1 - p) * k for k in (0, *more))
        elif p == s == 0:
            yield from (r + d - r * k for k in (0, *more))


def _time_factor(term: Expr, t: Symbol) -> tuple[Expr, Expr] | None:
    """p and r of a term that has the factor t^p exp(r t), and is else free of t."""
    factor = sympy.powsimp(term.as_independent(t, as_Add=False)[1])
    rate = simplify(t * factor.diff(t) / factor)
    slope = rate.diff(t)
    found = simplify(rate - t * slope), slope
    return found if free_of(sympy.Tuple(*found), [t]) else None


def resonant_waves(functions: Sequence[Expr], rest: Expr, q: Sequence[Symbol]) -> Iterator[Expr]:
    """What vanishes where cos(c q) of flat coordinates is a wave of L, or one of both its square.

    The ansatz takes both for independent: r cos(c theta) beside cos(theta) in a swinging Atwood
    machine, where 4 c^2 = 1 at M = 3 m, and the half angles of parabolic coordinates.
    """
    own, given = (_wave_numbers(each, q) for each in (functions, (rest,)))
    for x, c in own:
        for d in (d for y, d in given if y == x and not (c / d).is_number):
            for k, m in ((1, 1), (2, 1), (1, 2)):
                yield sympy.numer(sympy.together((k * c) ** 2 - (m * d) ** 2))


def powers_of_length(X: Expr, rest: Expr, x: Symbol) -> Iterator[Expr]:
    """What vanishes where a power of the arc length X has the exponent 0, 1, 2 or -2."""
    for base, exponent in sorted((p.as_base_exp() for p in rest.atoms(sympy.Pow)), key=str):
        degree = simplify(base.diff(x) * X / (base * X.diff(x)))
        if exponent.free_symbols and degree.is_number and degree != 0:
            yield from (degree * exponent - n for n in (0, 1, 2, -2))


def linear_force(X: Expr, rest: Expr, x: Symbol) -> list[Expr]:
    """What vanishes where dV/dX is of first degree in the arc length X."""
    third = rest
    for _ in range(3):
        third = sympy.together(third.diff(x) / X.diff(x))
    above = sympy.numer(third)
    if not above.is_polynomial(x):
        return []
    common = sympy.gcd_list(sympy.Poly(above, x).coeffs())
    return _factors(common)


def _wave_numbers(formulas: Sequence[Expr], q: Sequence[Symbol]) -> list[tuple[Symbol, Expr]]:
    """The c of sin(c x + ...) and cos(c x + ...), by x."""
    arguments = {f.args[0] for each in formulas for f in each.atoms(sympy.sin, sympy.cos)}
    found = [(x, argument.diff(x)) for argument in sorted(arguments, key=str) for x in q]
    return list(dict.fromkeys((x, c) for x, c in found if c != 0 and free_of(c, q)))


# -- candidates ---------------------------------------------------------------------------


def _commensurate(
    parameters: Sequence[Symbol], exponents: Sequence[Exponent], ratios: Sequence[int]
) -> Iterator[Value]:
    """f = R g or g = R f for growths with ratios R, squares of frequencies with R = r^2.

    R (f + g)^2 = (1 + R)^2 f g: of two roots of one polynomial the sum and the product have no
    roots in them.
    """
    squares = list(dict.fromkeys(_squares(exponents)))
    alike = [(f, g) for (p, f), (q, g) in combinations(squares, 2) if is_zero(p - q)]
    growths = (e.growth for e in exponents if e.frequency == 0 and not _opposite(e, exponents))
    real = list(combinations(growths, 2))
    for ratio in ratios:
        for R, pairs in ((ratio**2, alike), (ratio, real)):
            for one, other in pairs:
                total, product = simplify(one + other), simplify(one * other)
                relation = R * total**2 - (1 + R) ** 2 * product
                for factor in _factors(relation):
                    if sign(factor) not in (1, -1):
                        yield from _solved(factor, parameters)


def _squares(exponents: Sequence[Exponent]) -> Iterator[tuple[Expr, Expr]]:
    """Growths and squared frequencies; where exp(a t) and exp(-a t) stand for waves, -a^2."""
    for one in exponents:
        if one.frequency != 0:
            yield one.growth, sympy.expand(one.frequency**2)
        elif _opposite(one, exponents):
            yield sympy.S.Zero, sympy.expand(-(one.growth**2))


def _opposite(one: Exponent, exponents: Sequence[Exponent]) -> bool:
    """Whether the other sign is there too."""
    return any(e.frequency == 0 and sympy.expand(one.growth + e.growth) == 0 for e in exponents)


def _solved(relation: Expr, parameters: Sequence[Symbol]) -> Iterator[Value]:
    """The admissible values of the last parameter that has some without roots, or else some."""
    found: list[tuple[Symbol, list[Expr]]] = []
    for parameter in reversed(parameters):
        if parameter in relation.free_symbols:
            roots = solve_for(relation, parameter)
            if roots is not None:
                found.append((parameter, [simplify(x) for x in roots.values]))
    found.sort(key=lambda solved: any(map(has_roots, solved[1])))
    for parameter, values in found[:1]:
        for value in values:
            if not value.has(sympy.I) and _admissible(parameter, value):
                yield parameter, value


def _admissible(parameter: Symbol, value: Expr) -> bool:
    """Whether the assumptions on the parameter leave the value."""
    if value == 0:
        return not (parameter.is_nonzero or parameter.is_positive)
    if parameter.is_integer and value.is_integer is False:
        return False
    return not (parameter.is_positive and (value.is_negative or value.could_extract_minus_sign()))
