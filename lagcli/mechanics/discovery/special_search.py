"""The search for special values of the parameters, and the whole search again at each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.algebra.place import NO_VALUE
from lagcli.diagnostics import ProblemError
from lagcli.mechanics.discovery.ansatz import TimeFunctions, affine, point_unknowns, products_of_two
from lagcli.mechanics.discovery.discovery import Discovery
from lagcli.mechanics.discovery.hidden import QuadraticIntegrals
from lagcli.mechanics.discovery.limits import Allowance, TooMuchWork
from lagcli.mechanics.discovery.listing import shown, times
from lagcli.mechanics.discovery.modular import NoPoint
from lagcli.mechanics.discovery.names import Naming, distinct, own_name
from lagcli.mechanics.discovery.pivots import Pivots
from lagcli.mechanics.discovery.search import Search
from lagcli.mechanics.discovery.slots import point_slots
from lagcli.mechanics.discovery.special import (
    SpecialCase,
    Value,
    beside,
    both_missing,
    both_vanish,
    candidates,
    damped_powers,
    equal_inertias,
    exchanged,
    is_reflected,
    linear_force,
    missing,
    new_charges,
    powers_of_length,
    problem_at,
    rates_of_driving,
    resonant_waves,
    special_curvature,
    special_inertia,
    special_powers,
    steady_in_another_time,
)
from lagcli.mechanics.noether import NoetherCharge
from lagcli.platform.effort import OutOfWork
from lagcli.platform.limited import limited_to
from lagcli.problem_data import Problem
from lagcli.record import replace

_MOST_FREEDOM = 6  # measured: up to 5
_UNITS = 64_000_000  # three frequencies: 13 values take 64 million
_FOR_PIVOTS = 0.3  # of these
_SHARE = 0.8  # of what its section has left
_MOST_UNKNOWNS = 150  # measured: up to 378
_MOST_TIMED = 200  # of integrals with the time: 180 in space, linear in t
_MOST_VALUES = 16  # measured: at most 5
_MOST_PAIRS = 20  # measured: up to 31
_RATIOS = (1, 2, 3)
_MOST_OPERATIONS = 20  # measured: at most 2
_NOT_ALL = "not all special values of the parameters were tried"


def special_cases(
    discovery: Discovery, search: Callable[[Problem], Discovery]
) -> tuple[SpecialCase, ...]:
    """One parameter at a time, then two; `search` makes the same search for another problem."""
    searched = discovery.unconstrained or discovery
    system = searched.system
    if discovery.unsearched or discovery.is_prescribed:
        return ()
    if not (system.q and system.parameters):
        return ()
    if searched.dynamics.degrees_of_freedom > _MOST_FREEDOM:
        discovery.words.append(_NOT_ALL)
        return ()
    allowed = Allowance(_UNITS)
    variables = (system.t, *discovery.system.q, *discovery.system.qdot)
    found: list[SpecialCase] = []
    searches: list[tuple[SpecialCase, Discovery]] = []
    at_one: dict[Value, Discovery] = {}

    def choices() -> Iterator[tuple[Value, ...]]:
        """One value at a time, then two, those last of which one was tried in vain.

        Beside each that is 0 or was found other parameters have the values sought there, or are 0.
        """
        values, together = _to_try(searched, discovery, allowed)
        yield from ((value,) for value in values[:_MOST_VALUES])
        alone = {(case.parameter, case.value) for case in found}
        again = {v: there for v, there in at_one.items() if v[1] == 0 or v in alone}
        pairs: list[tuple[Value, Value]] = []
        for value, there in again.items():
            pairs += beside(value, _to_try(there.unconstrained or there, there, allowed)[0])
            discovery.words.extend({_NOT_ALL} & {*there.words})
        pairs += together
        for value in (*again, *(v for v in at_one if v not in again)):
            pairs += beside(value, missing(system.parameters))
        pairs = list({frozenset(pair): pair for pair in pairs}.values())
        pairs.sort(key=lambda pair: len({*pair} & at_one.keys() - again.keys()))
        yield from pairs[:_MOST_PAIRS]
        if len(values) > _MOST_VALUES or len(pairs) > _MOST_PAIRS:
            discovery.words.append(_NOT_ALL)

    def look() -> None:
        for choice in choices():
            if any(sympy.count_ops(value) > _MOST_OPERATIONS for _, value in choice):
                discovery.words.append(_NOT_ALL)
                continue
            there = _at(discovery, choice, search)
            allowed.check()
            if there is not None and {*there.stopped} - {*discovery.stopped}:
                discovery.words.append(_NOT_ALL)
                continue  # their number would be too small
            if there is None:
                continue
            if len(choice) == 1:
                at_one[choice[0]] = there
            held = [(case, each) for case, each in searches if _holds(case, choice)]
            if not all(_has_more(there, each) for each in (discovery, *(e for _, e in held))):
                continue
            printed = [*discovery.charges, *(c for case, _ in held for c in case.charges)]
            roots = _radicands(there.charges, variables)
            known = [
                part for c in printed
                for part in _real_parts(_at_values(c.charge, choice, variables, roots), c.charge)
                if not part.has(*NO_VALUE)  # divided by what is 0 there
            ]  # fmt: skip
            try:
                new = new_charges(known, there.charges, there.dynamics, allowed)
                charges = _beyond_products(known, new, there, allowed)
            except (NoPoint, ZeroDivisionError):
                discovery.words.append(_NOT_ALL)
                continue
            charges = _named_apart(charges, there, discovery)
            if charges:
                number, given = len(there.charges), tuple(choice[1:])
                found.append(SpecialCase(*choice[0], number, charges, there.degree, given))
                searches.append((found[-1], there))

    try:
        limited_to(_SHARE, look)
    except (NoPoint, TooMuchWork, OutOfWork):
        discovery.words.append(_NOT_ALL)
    listed = dict.fromkeys((case.parameter, case.value) for case in found)
    for p, value in listed:
        if (
            value.free_symbols
            and (p, -value) not in listed
            and is_reflected(searched.dynamics, (p, value))
        ):
            discovery.words.append(f"of {p} and -{p}, which a reflection exchanges, one is named")
    if searched.degree > 2:  # the values come from the searches up to second degree
        discovery.words.append(_NOT_ALL)
    return tuple(found)


def _to_try(
    searched: Discovery, discovery: Discovery, allowed: Allowance
) -> tuple[list[Value], list[tuple[Value, Value]]]:
    """Single values, and pairs of them."""
    system, equations = searched.system, searched.equations
    if searched.dynamics.constraints.equations:
        discovery.words.append(_NOT_ALL)
        values = exchanged(discovery.dynamics)
        constraints = discovery.dynamics.constraints
        polynomial = all(e.f.is_polynomial(*system.q) for e in constraints.equations if e.holonomic)
        if constraints.nonholonomic or polynomial:  # the motion of a linkage is long to derive
            values += [*missing(system.parameters), *equal_inertias(system)]
        return values, []
    factors, pairs = _factors(searched, allowed)
    discovery.words += [_NOT_ALL] if _NOT_ALL in searched.words else []
    together = both_vanish(pairs, factors, system.parameters)
    moving = searched.of_spacetime or equations
    inertia = special_inertia(moving)
    at_rest = system.L.xreplace(dict.fromkeys(system.qdot, sympy.S.Zero))
    factors += [*special_powers(equations), *inertia]
    if searched.isometries is None and searched.spacetime is None:
        factors += special_curvature(moving)
    factors += rates_of_driving(system.L, system.t)
    factors += steady_in_another_time(equations, at_rest)
    if searched.isometries is not None:
        factors += resonant_waves(searched.isometries.functions, at_rest, system.q)
        if len(system.q) == 1 and searched.canonical:
            along = searched.isometries.functions[0], at_rest, system.q[0]
            factors += [*powers_of_length(*along), *linear_force(*along)]
    if any(
        system.t in p.base.free_symbols and p.exp.free_symbols for p in system.L.atoms(sympy.Pow)
    ):
        discovery.words.append(_NOT_ALL)  # t^n: functions of time with other powers
    in_time = searched.time_functions
    if len(system.q) == 1 or in_time.suggested or in_time.lacking or _NOT_ALL in searched.words:
        factors += system.parameters  # a term less: linear, with functions of time
    # without charges with these functions of time only those of a frame may be alike
    ratios = _RATIOS if _is_timed(searched) else (1,)
    values = candidates(searched.dynamics, factors, searched.time_functions.exponents, ratios)
    both = inertia if searched.quadratic_mass else system.parameters
    together += both_missing(values, both, system, at_rest)
    if searched.accelerations:
        values += damped_powers(searched.accelerations, system)
    return values, together


def _holds(case: SpecialCase, choice: Sequence[Value]) -> bool:
    """Whether the values chosen are among those of a case of one parameter."""
    relation = (case.parameter - case.value).xreplace(dict(choice))
    return not case.given and is_zero(relation) is True


def _beyond_products(
    known: Sequence[Expr], new: Sequence[NoetherCharge], there: Discovery, allowed: Allowance
) -> tuple[NoetherCharge, ...]:
    """Without those that follow from the known ones and products of two of them; P² is not new.

    Products of what depends on the time stay: the integrals of commensurate modes are such.
    """
    if all(c in there.point_charges for c in new) or there.dynamics.constraints.equations:
        return tuple(new)
    lasting = [sympy.S.One, *(c for c in known if there.system.t not in c.free_symbols)]
    old = [*known, *products_of_two(lasting)]
    beyond = new_charges(old, new, there.dynamics, allowed)
    return tuple(
        c for c in new
        if c in there.point_charges or c in beyond
        or new_charges(old, [c], there.dynamics, allowed)  # by itself, not with other new ones
    )  # fmt: skip


def _named_apart(
    charges: Sequence[NoetherCharge], there: Discovery, here: Discovery
) -> tuple[NoetherCharge, ...]:
    """None has the name of another one that is conserved for all values.

    Which angle of a top turns it about its own axis shows in T for all values, and not at C = A.
    """
    taken, all_names = [c.name for c in here.charges], {c.name for c in there.charges}
    charges = [_named_as(c, here.listing.naming) if c.name in taken else c for c in charges]
    own = []
    for c in charges:
        stem, _, number = c.name.rpartition("_")  # mode_2 beside a mode
        name = stem if number.isdigit() and stem in all_names else c.name
        own.append(own_name(name))
    names = distinct([*taken, *own])[len(taken) :]
    return tuple(replace(c, name=name) for c, name in zip(charges, names, strict=True))


def _named_as(charge: NoetherCharge, naming: Naming) -> NoetherCharge:
    """With the name and the sign that it has among others, if any."""
    given = charge.transformation
    name = shown(naming.of_point(given.changes, given.time), charge)
    if not name or name == charge.name:
        return charge
    return replace(times(charge, naming.orientation(name, charge)), name=name)


def _has_more(there: Discovery, here: Discovery) -> bool:
    """More charges up to some degree: L_z in place of one of second, that in place of fourth."""
    more, less = _degrees(there), _degrees(here)
    return any(sum(x <= d for x in more) > sum(x <= d for x in less) for d in {*more})


def _degrees(found: Discovery) -> list[int]:
    """Those of integrals in the velocities, where they are polynomials; 1 of point symmetries."""
    v = found.system.qdot
    hidden = (c.charge for c in found.hidden_charges if c.charge.is_polynomial(*v))
    degrees = [int(sympy.Poly(charge, *v).total_degree()) for charge in hidden]
    return degrees + [1] * (len(found.charges) - len(degrees))


def _at_values(
    charge: Expr, values: Sequence[Value], moving: Sequence[Symbol], roots: Mapping[Expr, Expr]
) -> Expr:
    """With either sign of a frequency: sqrt(c) is |sqrt(a) - sqrt(b)| at its square.

    Beside the roots of the given radicands those of the opposite ones are imaginary.
    """
    there = charge.xreplace(dict(values))
    there = there.xreplace({x: x.args[0] for x in there.atoms(sympy.Abs) if free_of(x, moving)})
    opposite = {
        p: (sympy.I * roots[sympy.expand(-p.base)]) ** (2 * p.exp)
        for p in _roots_in(there, moving)
        if sympy.expand(-p.base) in roots
    }
    return there.xreplace(opposite)


def _roots_in(charge: Expr, moving: Sequence[Symbol]) -> set[Expr]:
    """Square roots of constants of either sign."""
    return {
        p for p in charge.atoms(sympy.Pow)
        if p.exp.is_Rational and p.exp.q == 2 and p.base.is_Add and free_of(p.base, moving)
    }  # fmt: skip


def _radicands(charges: Sequence[NoetherCharge], moving: Sequence[Symbol]) -> dict[Expr, Expr]:
    """Each with its root, of products of two as well: sqrt(w^2 - c^2) is a product of two."""
    single = {p.base for c in charges for p in _roots_in(c.charge, moving)}
    pairs = {sympy.expand(a * b): sympy.sqrt(a) * sympy.sqrt(b) for a, b in combinations(single, 2)}
    return pairs | {sympy.expand(r): sympy.sqrt(r) for r in single}


def _real_parts(charge: Expr, given: Expr) -> list[Expr]:
    """Both are conserved: exp(a t) with a^2 < 0 at the value has a cosine and a sine.

    The cosine of an imaginary argument is one of exponentials, as the search there has them.
    """
    parts: Sequence[Expr] = (charge,)
    if charge.has(sympy.I):
        names = {p: sympy.Dummy(real=True) for p in _roots_in(charge, ())}
        back = {name: p for p, name in names.items()}
        whole = charge.xreplace(names).expand(complex=True)
        parts = [part.xreplace(back) for part in whole.as_real_imag()]
    waves = (sympy.sinh, sympy.cosh)
    return [
        part.xreplace({f: f.rewrite(sympy.exp) for f in part.atoms(*waves) - given.atoms(*waves)})
        for part in parts
        if part != 0
    ]


def _is_timed(discovery: Discovery) -> bool:
    """Whether any charge has a sine, cosine or exponential of time."""
    t = discovery.system.t
    return any(
        t in f.free_symbols
        for c in discovery.charges
        for f in c.charge.atoms(sympy.sin, sympy.cos, sympy.exp)
    )


def _at(
    discovery: Discovery, values: Sequence[Value], search: Callable[[Problem], Discovery]
) -> Discovery | None:
    """The same search with values in place of parameters."""
    problem: Problem | None = discovery.system.problem
    for parameter, value in values:
        problem = problem and problem_at(problem, parameter, value)
    try:
        return None if problem is None else search(problem)
    except (ProblemError, ZeroDivisionError):
        return None


def _factors(
    discovery: Discovery, allowed: Allowance
) -> tuple[list[Expr], list[tuple[Expr, Expr]]]:
    """Of the search for point symmetries, and of that for integrals of second degree.

    Of both also pairs that have to vanish together.
    """
    part = allowed.part(_FOR_PIVOTS)
    found: dict[Expr, None] = {}
    pairs: list[tuple[Expr, Expr]] = []
    try:
        for search in _searches(discovery, part):
            if search is None:
                discovery.words.append(_NOT_ALL)
            else:
                pivots = Pivots(search, part)
                found |= dict.fromkeys(pivots.factors())
                pairs += pivots.pairs()
    except (NoPoint, TooMuchWork, ZeroDivisionError):
        discovery.words.append(_NOT_ALL)
    return list(found), [pair for pair in pairs if not found.keys() & set(pair)]


def _searches(discovery: Discovery, allowed: Allowance) -> Iterator[Search | None]:
    """With powers of t alone: other functions of time depend on the parameters themselves.

    None for one with too many unknowns.
    """
    equations, found = discovery.equations, discovery.coordinate_kinds
    t, isometries = equations.t, discovery.isometries
    slots = point_slots(equations)
    for powers in ((sympy.S.One, t, t**2), (sympy.S.One,)):
        times = TimeFunctions(powers, powers, ())
        if isometries is not None:
            yield isometries.search(times, allowed)
            break
        unknowns = point_unknowns(
            slots, times, affine(found), time_with_space=not discovery.quadratic_mass
        )
        few = len(unknowns) <= _MOST_UNKNOWNS
        yield Search(equations, slots, unknowns, allowed) if few else None
        if few:
            break
    if len(equations.q) < 2 or not discovery.quadratic_mass or not discovery.canonical:
        return
    integrals = QuadraticIntegrals(
        discovery.noether, equations, discovery.centred_kinds, allowed, discovery.isometries
    )
    if integrals.size and t not in discovery.equations_symbols:
        yield integrals.search(()) if integrals.size <= _MOST_UNKNOWNS else None
    for highest in (2, 1):  # t suffices without time in the equations: with Q, dQ/dt of t^2 is one
        own = tuple(t**k for k in range(highest + 1))
        timed = discovery.timed(TimeFunctions(own, own, ()), allowed)
        if timed is None or not timed.functions:
            return
        few = timed.size <= _MOST_TIMED
        if few or highest == 1:
            yield timed.search(()) if few else None
            return
