"""The steps on the discovered symmetries and on their algebra."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import cast

from sympy import (
    Add,
    Expr,
    Matrix,
    N,
    Poly,
    Rational,
    S,
    Symbol,
    cos,
    cosh,
    exp,
    expand,
    sin,
    sinh,
)

from lagcli.algebra import dot, is_zero, shape, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.signs import sign
from lagcli.algebra.vanishing_factors import may_vanish
from lagcli.document import Block, Bracket, Equations, Heading, Label, Row, equations_of
from lagcli.expression import ZERO, Expression, Name, sum_of, walk
from lagcli.mechanics.canonical.poisson import poisson
from lagcli.mechanics.discovery.isometries import THEY_ARE
from lagcli.mechanics.discovery.lie_algebra import MODULO_CONSTANTS
from lagcli.mechanics.discovery.limits import TooMuchWork
from lagcli.mechanics.discovery.reality import real_where
from lagcli.mechanics.explaining.conservation import noether_words
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, constraints_allow, listed, says
from lagcli.mechanics.rest.rest_conditions import given_formulas
from lagcli.notation.letters import with_names
from lagcli.notation.ordering import positive_first
from lagcli.statements.answers import (
    AlgebraSection,
    Charge,
    ChargesSection,
    Section,
    SpecialValue,
)
from lagcli.statements.wording import (
    PRESCRIBED,
    conditions,
    values_of,
    where_real,
    with_powers,
)

#: A table of brackets of more charges than these is not read.
_MOST = 7

_CHECKED = {"exact": "exactly", "50 digits": "at random states to 50 digits"}


def discovered(explainer: Explainer, section: Section) -> Iterator[Block]:
    """The ansatz, the condition, and each conserved quantity with its check."""
    found = cast(ChargesSection, section).charges
    discovery = explainer.derivation.discovery
    letters = explainer.letters
    if discovery.is_prescribed:
        yield says(f"None is sought: {PRESCRIBED}.")
        return
    constraints = explainer.constraints
    beside: list[Part] = (
        [] if discovery.canonical else [" plus the work of the forces that are not in ", letters.L]
    )
    yield says(
        "A symmetry is a change of the coordinates and the time under which the action "
        "changes only "
        "by a boundary term. The search uses an ansatz with unknown coefficients: ",
        *with_names(discovery.ansatz, explainer.system.names),
        ".",
    )
    if discovery.cartesian:
        factors = discovery.cartesian_lead == THEY_ARE  # else only multiples of them are said
        shown = [X if factors else X.as_coeff_Mul()[1] for X in discovery.cartesian]
        named = [part for X in shown for part in (", ", explainer.readable.as_written(X))]
        yield says(discovery.cartesian_lead, *named[1:], ".")
    yield says(
        "For a point transformation the Euler-Lagrange expression of the change of ",
        letters.L,
        *beside,
        " must vanish identically" + f" on the {constraints}" * bool(constraints) + ", "
        "which holds for total time derivatives" + " and only for them" * (not constraints) + ". "
        "For a constant of the motion the time derivative on the motion must vanish. Both "
        "conditions are linear in the unknown coefficients and are "
        "solved exactly.",
    )
    if not found:
        if discovery.stopped:
            yield says("No symmetry was found and proved, and the search was not complete.")
        else:
            they = "For general values of the parameters they" if _given(explainer) else "They"
            yield says(f"{they} have only the solution 0: within this ansatz there is no symmetry.")
        return
    charges = [each for each in found if each.source != "momentum equation"]
    if charges:
        timed = any("t" in each.transformation for each in charges)
        gauge = any(each.gauge not in {None, ZERO} for each in charges)
        law = noether_words(explainer, with_gauge=gauge, with_time=timed)[:-1]
        G, L = letters.G, letters.L
        rate: list[Part] = [", where the total time derivative of ", G, " is the change of ", L]
        boundary = [*rate, *_with_work(explainer)] if gauge else []
        yield says(*law, *boundary, ".")
        levels = {each.verified for each in charges if each.verified}
        how = f"; this was checked {_CHECKED[levels.pop()]}" if len(levels) == 1 else ""
        moving = len(charges) < len(found)
        without: list[Part] = [" without a rate ", Name(letters.Q.name, 1)] if moving else []
        yield says(
            "The time derivative of each ", letters.Q, " below", *without,
            f" is 0 on the motion{how}. Nothing outside of the ansatz was searched.",
        )  # fmt: skip
    for charge in found:
        yield from _charge(explainer, charge)


def _with_work(explainer: Explainer) -> list[Part]:
    """What the rate of G contains beside dL: forces that are not in L, constraints that move."""
    equations = explainer.dynamics.constraints.equations
    working: list[Part | list[Part]] = []
    if not explainer.derivation.discovery.canonical:
        working.append(["the forces that are not in ", explainer.letters.L])
    if any(is_zero(e.drift) is not True for e in equations):
        working.append(f"the {explainer.constraints}")
    return [" plus the work of ", *listed(working)] if working else []


def _charge(explainer: Explainer, charge: Charge) -> Iterator[Block]:
    letters = explainer.letters
    yield Heading("", 2, letters.free(charge.name))
    moves = charge.source == "momentum equation"
    rows = [Row(Label(name, change=True), by) for name, by in charge.transformation.items()]
    of_constraint = not charge.transformation and not moves
    if charge.gauge is not None and charge.gauge != ZERO and not of_constraint:
        rows.append(Row(letters.G, charge.gauge))
    energy = charge.name == "energy" and set(charge.transformation) == {"t"}
    if charge.charge is not None:
        rows.append(Row(letters.Q, charge.charge))
    if moves and charge.rate is not None:
        rows.append(Row(Name(letters.Q.name, 1), charge.rate))
    yield Equations(tuple(rows))
    if of_constraint:
        several = sum(not e.holonomic for e in explainer.dynamics.constraints.equations) > 1
        of = "velocity constraints" if several else "a velocity constraint"
        yield says(f"It is the integral of {of}, not of a symmetry.")
    if energy:
        yield says("It is listed with the sign of the energy, opposite to that of the theorem.")
    if moves:
        allowed = constraints_allow(len(explainer.dynamics.constraints.equations))
        yield says(
            f"{allowed.capitalize()} this displacement, a "
            "combination of symmetries whose factors "
            "depend on the configuration. The momentum is not constant: it has this rate."
        )
    elif any(_quick(change) for change in charge.transformation.values()):
        yield says("The change depends on the velocities, so this is not a point transformation.")
    yield from where_real(charge.where)


def _quick(change: Expression) -> bool:
    return any(isinstance(node, Name) and node.primes for node in walk(change))


# -- the algebra ---------------------------------------------------------------------------------


def algebra(explainer: Explainer, section: Section) -> Iterator[Block]:
    """Brackets of the conserved quantities, their algebra, and Liouville's count."""
    found = cast(AlgebraSection, section)
    charges = explainer.derivation.discovery.charges
    if found.is_prescribed:
        yield says(f"No symmetry was sought: {PRESCRIBED}.")
        return
    if not charges:
        ansatz = with_names(found.ansatz, explainer.system.names)
        yield says("No symmetry was found and proved. Searched: ", *ansatz, ".")
        yield from _at_special_values(explainer, found)
        return
    if found.in_involution is None:
        yield says(*_no_brackets(explainer))
    yield from _brackets(explainer, found)
    yield from _in_general(explainer)
    yield from _dimension(found)
    number, n = found.independent, explainer.dynamics.degrees_of_freedom
    if found.number > 1 and number is not None:
        yield says(
            f"Of the {found.number} conserved quantities {number} {'is' if number == 1 else 'are'} "
            f"functionally independent: the rank of their gradients in phase space is {number}."
        )
    if found.determines == "state":
        yield says(
            f"A state has {number} dimensions, so the constant values of these {number} give the "
            "state at every time, without a further integration: the motion is integrable."
        )
    elif found.determines and number is not None:
        yield says(
            "Nothing depends on the time explicitly, and a state has one dimension more than there "
            "are such constants without it: their values leave a curve of states, along which a "
            "quadrature gives the time. The motion is integrable."
        )
    elif found.in_involution is not None:
        yield says(*_integrability(found, n))
    yield from _at_special_values(explainer, found)


def _in_general(explainer: Explainer) -> Iterator[Block]:
    """That special values of the parameters are left out."""
    if len(explainer.derivation.discovery.charges) > 1 and _is_special_somewhere(explainer):
        yield says("The following is for general values of the parameters.")


def _is_special_somewhere(explainer: Explainer) -> bool:
    """Whether there may be values at which charges vanish or coincide, or brackets vanish.

    A parameter of what is given may be 0, or a root or a rate, as a of sin(a t), or all
    coefficients of a charge.
    """
    system, charges = explainer.system, explainer.derivation.discovery.charges
    moving = (system.t, *system.q, *system.qdot)
    return any(sign(p) not in (1, -1) for p in _given(explainer)) or any(
        real_where(each, system)
        or any(_rates(each.charge, system.t))
        or all(sign(c) not in (1, -1) for c in _coefficients(each.charge, moving))
        for each in charges
    )


def _given(explainer: Explainer) -> set[Symbol]:
    """The parameters of what is given."""
    formulas = given_formulas(explainer.dynamics)
    return {p for e in formulas for p in e.free_symbols} & {*explainer.system.parameters}


def _coefficients(formula: Expr, moving: Sequence[Symbol]) -> list[Expr]:
    """Those of the different functions of the moving quantities that it is a sum of."""
    found: dict[Expr, Expr] = {}
    for term in Add.make_args(expand(formula)):
        constant, function = term.as_independent(*moving, as_Add=False)
        found[function] = found.get(function, S.Zero) + constant
    return [simplify(c) for c in found.values()]


def _rates(formula: Expr, t: Symbol) -> Iterator[Expr]:
    """Factors of w in functions of w t that may vanish."""
    for node in formula.atoms(exp, sin, cos, sinh, cosh):
        yield from may_vanish(node.args[0].diff(t))


def _at_special_values(explainer: Explainer, found: AlgebraSection) -> Iterator[Block]:
    """What there is beside the symmetries for all values, for some of the parameters."""
    if any("special values" in note for note in explainer.derivation.discovery.words):
        yield says("Not all special values of the parameters were tried.")
    if found.special:
        lead = "More symmetries" if found.number else "Symmetries"
        yield Heading(f"{lead} for special values of the parameters", 2)
    alike: dict[object, list[SpecialValue]] = {}
    degree = explainer.derivation.discovery.degree
    for case in found.special:
        alike.setdefault((case.number, tuple(case.charges.items()), case.where), []).append(case)
    for case, *others in alike.values():
        one = len(case.charges) == 1
        many = f"{case.number} {'symmetry' if case.number == 1 else 'symmetries'}"
        new = "this is no linear combination" if one else "these are no linear combinations"
        beside = f", of which {new} of those above" if found.number else ""
        at = [*values_of(case), *(part for each in others for part in (" or ", *values_of(each)))]
        less = f", up to degree {case.degree}," if case.degree < degree else ""
        yield says("For ", *at, f" the same search{less} finds {many}{beside}:")
        free = explainer.letters.free
        yield equations_of((free(name), value) for name, value in case.charges.items())
        yield from where_real(case.where, several=not one)


def _no_brackets(explainer: Explainer) -> list[Part]:
    """Why the conserved quantities are not compared by Poisson brackets."""
    kinds = explainer.dynamics.constraints.kinds.values()
    if any(kind != "holonomic" for kind in kinds):
        return ["Under velocity constraints no Poisson brackets are taken."]
    if not explainer.derivation.discovery.canonical:
        L = explainer.letters.L
        return ["Forces that are not in ", L, " act, so no Poisson brackets are taken."]
    return ["How many of the conserved quantities are in involution was not worked out."]


def _dimension(found: AlgebraSection) -> Iterator[Block]:
    """What the dimension counts, and the name of the algebra."""
    kind = "symmetries" if found.dimension_counts == "charges" else "point symmetries"
    if not found.name:
        if found.in_involution is not None:
            counted = f"is {found.dimension}"
            if found.with_constants:
                counted += f" modulo constants and {found.dimension + 1} with them"
            yield says(
                f"The dimension of the {kind} found {counted}. Their algebra is not "
                "one of those with a name here."
            )
        yield from _without_time(found, [])
        return
    name = found.name.removesuffix(MODULO_CONSTANTS)
    where = [" where ", *conditions(found.named_where)] if found.named_where else []
    if name == found.name:
        lead = f"The algebra of the {kind} found has dimension {found.dimension}: "
    else:
        lead = (
            f"Constants occur among the brackets. The algebra of the {kind} found has dimension "
            f"{found.dimension} modulo constants and {found.dimension + 1} with them: "
        )
    yield says(lead, *with_powers(name), where, ".")
    yield from _without_time(found, where)


def _without_time(found: AlgebraSection, where: list[Part]) -> Iterator[Block]:
    """The algebra of the charges that do not depend on t, where it has a name of its own."""
    if found.autonomous is not None:
        number, name = found.autonomous
        close = f"The {number} conserved quantities that do not depend on t close under the bracket"
        yield says(f"{close}: ", *with_powers(name.removesuffix(MODULO_CONSTANTS)), where, ".")


def _integrability(found: AlgebraSection, n: int) -> list[Part]:
    """Liouville: n independent integrals in involution reduce the motion to quadratures."""
    count = found.in_involution
    if found.separates:
        constants = f"{n} independent constants" if n > 1 else "one constant"
        why = f"The Hamilton-Jacobi equation separates with {constants}"
        why += " in involution" if n > 1 else ""
        return [f"{why}: the motion is integrable by quadratures (Liouville)."]
    law = (
        "By Liouville's theorem the motion is integrable by quadratures with as many independent "
        "constants, whose brackets with each other vanish, as degrees of freedom. "
    )
    if found.by_functions:
        law += (
            "Among the functions of k independent constants, with brackets that are such functions "
            "and of rank r, there are k − r/2 of them (Nekhoroshev; Mishchenko and Fomenko). "
        )
    here = f"Here their number is {count}, with {n} degree{'s' * (n != 1)} of freedom"
    verdict = ": it is integrable." if found.integrable else ", which does not decide it."
    return [law, here + verdict]


def _brackets(explainer: Explainer, found: AlgebraSection) -> Iterator[Block]:
    """{A, B} by multiples of the charges, where the Legendre transform is to be had."""
    discovery, hamiltonian = explainer.derivation.discovery, explainer.derivation.hamiltonian
    charges, closed = discovery.charges, found.closed
    no_constants = found.name and not found.name.endswith(MODULO_CONSTANTS)
    of_them = "of them" if no_constants else "of them and of constants"
    free = not explainer.dynamics.constraints.equations and discovery.canonical
    if not free or len(charges) < 2 or hamiltonian.velocities is None:
        return
    if len(charges) > _MOST:
        if closed:
            yield says(
                f"The Poisson brackets of the {len(charges)} conserved quantities with each "
                f"other are linear combinations {of_them}."
            )
        return
    known = {
        explainer.letters.free(each.name).name: hamiltonian.in_phase_space(each.charge)
        for each in charges
    }
    t = explainer.system.t
    if any(f.subs(t, S.Zero).has(*NO_VALUE) for f in known.values()):
        later = Symbol(t.name, positive=True)  # ln t and 1/t have no value at 0
        known, t = {name: f.subs(t, later) for name, f in known.items()}, later
    moving = (*explainer.system.q, *explainer.system.momenta, t)
    rows, commuting, other, apart = [], 0, 0, True
    for one, two in combinations(known, 2):
        value = poisson(known[one], known[two], explainer.system)
        if is_zero(value) is True:
            commuting += 1
            continue
        try:
            multiple = _multiple(explainer, value, known, t)
            if multiple is None and closed:
                multiple = _combination(explainer, value, known, t)
        except TooMuchWork:
            multiple = None
        if multiple is None:
            other += 1
            apart = apart and not any(_may_be_multiple(value, f, moving) for f in known.values())
            continue
        written = _by_charges(multiple, [*known], explainer.system.order)
        rows.append(Row(Bracket(Name(one), Name(two)), written))
    if not rows and not other:
        two = "The Poisson bracket of the two conserved quantities vanishes."
        all_ = "All Poisson brackets of the conserved quantities with each other vanish."
        yield says(two if commuting == 1 else all_)
        return
    if rows:
        yield says("The conserved quantities have the Poisson brackets")
        yield Equations(tuple(rows))
    if other:
        several = other > 1
        verb = "are" if several else "is"
        if closed:
            what = f"{verb} {'' if several else 'a '}linear combination{'s' * several} {of_them}"
        elif apart:
            what = f"{verb} neither 0 nor a multiple of one of them"
        else:
            what = f"{'were' if several else 'was'} not found to be 0 or a multiple of one of them"
        yield says(f"{other} other bracket{'s' * several} {what}.")
    if commuting:
        yield says("All others are 0.")


def _by_charges(value: Expr, names: Sequence[str], order: Sequence[str]) -> Expression:
    """Charge by charge: (1 − 4 k) Q₁ + Q₂."""
    polynomial = Poly(value, *(Symbol(name, real=True) for name in names))
    parts = (simplify(c) * Poly({m: 1}, *polynomial.gens).as_expr() for m, c in polynomial.terms())
    return sum_of(positive_first([shape(part, (*order, *names)) for part in parts]))


def _may_be_multiple(value: Expr, f: Expr, moving: Sequence[Symbol]) -> bool:
    """Whether value/f agrees at two random states, as it does where it is constant."""
    source = random.Random("multiple")
    fixed = sorted((value.free_symbols | f.free_symbols) - {*moving}, key=str)
    at = {x: Rational(source.randint(10, 99), 31) for x in fixed}
    one, two = (
        N((value / f).subs(at | {x: Rational(source.randint(10, 99), 31) for x in moving}), 30)
        for _ in range(2)
    )
    return not (one - two).is_number or bool(abs(one - two) <= abs(one) * S(10) ** -20)


def _multiple(
    explainer: Explainer, value: Expr, known: Mapping[str, Expr], t: Symbol
) -> Expr | None:
    """The bracket as a constant, or a constant times a charge, or that times the energy."""
    system = explainer.system
    moving = (*system.q, *system.momenta, t)
    if free_of(value, moving):
        return value
    energy = known.get("energy")
    for scaled in (False, True):
        for name, f in known.items():
            if scaled and energy is None:
                continue
            divisor = f * energy if scaled and energy is not None else f
            ratio = simplify(value / divisor)
            if free_of(ratio, moving):
                product = ratio * Symbol(name, real=True)
                return product * Symbol("energy", real=True) if scaled else product
    return None


def _combination(
    explainer: Explainer, value: Expr, known: Mapping[str, Expr], t: Symbol
) -> Expr | None:
    """The bracket as the sum of two charges or one with constant factors, and a constant.

    Constants of the motion that depend linearly on each other at one time do so always.
    """
    system = explainer.system
    source = random.Random("combination")
    variables = (*system.q, *system.momenta)
    time = S.One if t.is_positive else S.Zero
    states = [
        {t: time, **{x: Rational(source.randint(10, 99), 31) for x in variables}} for _ in range(3)
    ]
    for names in combinations(known, 2):
        rows = Matrix([[*(known[name].subs(at) for name in names), 1] for at in states])
        if is_zero(rows.det()) is not False:
            continue
        factors = [simplify(c) for c in rows.LUsolve(Matrix([value.subs(at) for at in states]))]
        left = value - dot(factors, [*(known[name] for name in names), S.One])
        if is_zero(left) is True:
            return dot(factors, [*(Symbol(name, real=True) for name in names), S.One])
    return None
