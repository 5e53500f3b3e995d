"""Numbers that cannot be: of parameters, masses, coefficients of restitution, ends of runs.

Values are followed exactly where they are rational; others are looked at when they are used.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from fractions import Fraction
from functools import partial

from lagcli.diagnostics import NOWHERE, Diagnostic
from lagcli.expression import (
    ONE,
    ZERO,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    folded,
    name_nodes,
    terms_of,
    walk,
)
from lagcli.problem_data import Problem
from lagcli.reader.constants import rational_value
from lagcli.reader.counted_twice import counted_twice
from lagcli.reader.degrees_meant import degrees_meant
from lagcli.reader.file_reader import FileReader
from lagcli.reader.foreign.words import Vocabulary, momentum_meant, rate_meant
from lagcli.reader.friction_slips import friction_slips, opposite
from lagcli.reader.habits import is_angle
from lagcli.reader.misshapen import FRICTION, as_rayleigh
from lagcli.reader.momenta_meant import has_velocity
from lagcli.reader.names import derivative_order
from lagcli.reader.plain_sign import plain_sign
from lagcli.reader.text import SourceText
from lagcli.rewriting import expressions_in

_ODD = frozenset("sin tan sinh tanh asin atan asinh atanh sign".split())
_EVEN = frozenset("abs cos cosh sec".split())
_warning = partial(Diagnostic, severity="warning")
_SIGNS = {"positive": 1, "negative": -1}


def slips(problem: Problem) -> list[Diagnostic]:
    """Warnings of what is legitimate, and mostly a slip: no inertia, energies of the wrong sign."""
    signs = _signs(problem, _known(problem), 1)
    kinetic, lost = problem.kinetic, problem.dissipation
    found = [] if kinetic is None else _without_inertia(problem, kinetic)
    if kinetic is not None and _parity(kinetic, problem.definitions) == -1:
        hint = "a kinetic energy is of second degree in them, as in m*x'^2/2"
        found.append(_warning("T changes its sign with the velocities", kinetic.span, hint))
    elif kinetic is not None and plain_sign(kinetic, signs, problem.definitions) == -1:
        hint = "a kinetic energy is positive, as in m*x'^2/2"
        found.append(_warning("T is negative", kinetic.span, hint))
    found += [] if kinetic is None else _turned_terms(kinetic)
    found += _terms_in_both(problem)
    if lost is not None and not problem.definitions and _parity(lost, {}) != -1:
        names = {x.name for x in problem.coordinates}
        found += _without_square("the dissipation", lost, names, "c*{0}'^2/2")
    if lost is not None and plain_sign(lost, signs, problem.definitions) == -1:
        whole = opposite(lost, SourceText.of(problem.source))
        hint = f"it drives the motion: write {whole}" if whole else FRICTION
        found.append(_warning("the dissipation is negative", lost.span, hint))
    found += _new_places(problem)
    found += _one_sided_sums(problem)
    found += _masses_beside(problem)
    for term in terms_of(problem.potential or ZERO):
        known = all(node.primes or node.name in signs for node in name_nodes(term))
        if known and has_velocity(term):
            message = "a term of V with velocities and constants alone has no effect on the motion"
            found.append(_warning(message, term.span, FRICTION))
    coordinates = tuple(x.name for x in problem.coordinates)
    found += degrees_meant(problem, _known(problem))
    found += friction_slips(problem.forces, coordinates, signs, problem.source)
    with suppress(KeyError, ArithmeticError, ValueError, TypeError):  # U(r), roots below 0
        found += counted_twice(problem)
    energies = (problem.kinetic, problem.potential, problem.lagrangian, problem.hamiltonian)
    roots = (n for formula in energies if formula is not None for n in walk(formula))
    for node in roots:
        above = node.numerator if isinstance(node, Quotient) else ZERO
        last = above.factors[-1] if isinstance(above, Product) else above
        if isinstance(last, Power) and last.exponent == Number(Fraction(1)):
            hint = "a root is sqrt(x), or x^(1/2) with parentheses"
            found.append(_warning("a power of 1 is the base itself", last.span, hint))
    return found


def _new_places(problem: Problem) -> Iterator[Diagnostic]:
    """A warning for the change x + a of x, which is its new place: the change is a."""
    constants = {one.name for one in problem.parameters}
    text = SourceText.of(problem.source)
    for one in problem.symmetries:
        for x, change in (*one.changes.items(), ("t", one.time or ZERO)):
            rest = [term for term in terms_of(change) if term != Name(x)]
            is_one_less = len(rest) + 1 == len(terms_of(change))
            if rest and is_one_less and {node.name for node in name_nodes(*rest)} <= constants:
                step = text.written_sum(term.span for term in rest)
                message = f"'{one.name}' changes {x} by {text.written(change.span)}"
                hint = f"write {step}: a symmetry has the change, not the new {x}"
                yield _warning(message, change.span, hint)


def _one_sided_sums(problem: Problem) -> Iterator[Diagnostic]:
    """A warning for a constraint x + y without '=', beside a length that is in no formula."""
    used = {node.name for node in name_nodes(*expressions_in(problem))}
    idle = [x.name for x in problem.parameters if x.name not in {*used, *problem.named}]
    places = {x.name for x in problem.coordinates}
    for one in problem.constraints if len(idle) == 1 and idle[0][0] in "lLdDrR" else ():
        left, is_zero = one.equation.left, one.equation.right.span == NOWHERE
        if is_zero and left.span != NOWHERE and {x.name for x in name_nodes(left)} <= places:
            written = SourceText.of(problem.source).written(left.span)
            message = f"the constraint '{one.name}' is {written} = 0, {idle[0]} is in no formula"
            yield _warning(message, left.span, f"did you mean {written} = {idle[0]}?")


def _masses_beside(problem: Problem) -> Iterator[Diagnostic]:
    """A warning for points whose mass is in none of the terms of T, or of L."""
    energy, name, whole = "T", "kinetic energy", problem.kinetic
    if whole is None:
        energy, name, whole = "L", "energy", problem.lagrangian
    if whole is None:
        return
    values = {one.name: one.value for one in problem.parameters if one.value is not None}
    meaning = {**values, **problem.definitions, **problem.named}

    def names_in(formula: Expression) -> set[str]:
        names, left = set[str](), {node.name for node in name_nodes(formula)}
        while left:
            names |= left
            inner = name_nodes(*(meaning[name] for name in left if name in meaning))
            left = {node.name for node in inner} - names
        return names

    known = names_in(whole)
    for point in problem.points:
        mass = set() if point.mass is None else names_in(point.mass)
        if point.mass is not None and mass and not mass & known:
            message = f"the mass of '{point.name}' is not in {energy}, which is all of the {name}"
            hint = f"add the {name} of '{point.name}' to {energy}, or leave out its mass"
            yield _warning(message, point.mass.span, hint)


def _terms_in_both(problem: Problem) -> Iterator[Diagnostic]:
    """A warning for a term of positions in T that V has as well, with either sign."""
    moving = {x.name for x in problem.coordinates}
    potential = terms_of(problem.potential or ZERO)
    for term in terms_of(problem.kinetic or ZERO):
        names = [*name_nodes(term)]
        if not {x.name for x in names} & moving or any(x.primes for x in names):
            continue
        negative = term.operand if isinstance(term, Negative) else Negative(term)
        if term in potential:
            message = "V has this term of T as well, so that L = T - V has none of it"
        elif negative in potential:
            message = "V has this term of T as well, so that L = T - V has it twice"
        else:
            continue
        yield _warning(message, term.span, "leave it out of T: it is an energy of positions")


def _turned_terms(kinetic: Expression) -> Iterator[Diagnostic]:
    """A warning for r'^2 - r^2*phi'^2: in polar coordinates the squares are added.

    Other coordinates may have a metric with both signs.
    """
    for node in walk(kinetic):
        terms = node.terms if isinstance(node, Sum) else ()
        radii = {x.name for x in map(_base_of_square, terms) if x is not None and x.primes == 1}
        for term in terms:
            inner = term.operand if isinstance(term, Negative) else ZERO
            factors = inner.factors if isinstance(inner, Product) else ()
            squares = [x for x in map(_base_of_square, factors) if x is not None]
            is_length = any(x.name in radii and not x.primes for x in squares)
            if is_length and any(is_angle(x.name) and x.primes == 1 for x in squares):
                hint = "write '+' before it: in polar coordinates the squares are added"
                yield _warning("a term of T is negative", term.span, hint)


def _base_of_square(node: Expression) -> Name | None:
    match node:
        case Power(base=Name() as base, exponent=Number(value=power)) if power == 2:
            return base
    return None


def _signs(problem: Problem, known: Mapping[str, Fraction], other: int) -> dict[str, int]:
    """Of the parameters; `other` where nothing is known."""
    signs = {p.name: _SIGNS.get(p.assume, other) for p in problem.parameters}
    return signs | {name: (value > 0) - (value < 0) for name, value in known.items()}


def _without_inertia(problem: Problem, kinetic: Expression) -> list[Diagnostic]:
    """A warning for each coordinate that T forgets, unless a constraint or contact holds it."""
    equations = [one.equation for one in problem.constraints]
    equations += [one.equation for one in problem.contacts]
    elsewhere = [side for equation in equations for side in (equation.left, equation.right)]
    elsewhere += problem.definitions.values()
    held = {name.name for formula in elsewhere for name in name_nodes(formula)}
    moving = {name.name for name in name_nodes(kinetic) if name.primes}
    missing = "the coordinate '{0}' is missing in T: {0}' does not occur there".format
    idle = [one for one in problem.coordinates if one.name not in moving | held]
    found = []
    for one in idle:
        others = tuple(x.name for x in problem.coordinates if x is not one)
        if rate := rate_meant(one.name, Vocabulary(others, frozenset())):
            message = f"'{one.name}' is a coordinate of its own here, not the velocity of {rate[0]}"
            velocity = rate[0] + "'" * rate[1]
            hint = f"leave it out, and write {velocity}"
            return [_warning(message, one.span, hint)]
        found.append(
            _warning(missing(one.name), one.span, f"no inertia: its velocity is {one.name}'")
        )
    if not problem.definitions and _parity(kinetic, {}) != -1:
        coordinates = {x.name for x in problem.coordinates}
        found += _without_square("T", kinetic, coordinates, "m*{0}'^2/2")
    return found


def _without_square(
    key: str, formula: Expression, coordinates: set[str], usual: str
) -> Iterator[Diagnostic]:
    """A warning for each velocity that is linear, as in `x'^2 + y'`, or beside others alone.

    Where the others are 0, a T of `m*x'*y'` is 0 for any value of it, and negative close by.
    """
    products = [{*name_nodes(one)} for one in walk(formula) if isinstance(one, Product)]
    places = {Name(x) for x in coordinates}
    first = {node.name: node for node in reversed(name_nodes(formula)) if node.primes}
    for name, node in sorted(first.items()):
        degree = folded(formula, partial(_degree_alone, name)) or 0
        is_mixed = any(node in each and places & each for each in products)
        if degree < 1 + (not is_mixed) and (key == "T" or degree):
            where = "without its square" if degree else "in products with other velocities alone"
            hint = f"the square of {name}' is missing, as in {usual.format(name)}"
            yield _warning(f"{key} has {name}' {where}", node.span, hint)


def _degree_alone(name: str, node: Expression, parts: list[float | None]) -> float | None:
    """The degree in a velocity where all others are 0; None where the formula is 0.

    Functions and roots are of second degree, as in sqrt(x'^2 + y'^2).
    """
    degrees = [each for each in parts if each is not None]
    match node:
        case Name(primes=primes) if primes:
            return 1 if node.name == name else None
        case Sum():
            return max(degrees, default=None)
        case Product() | Power() | Quotient() | Negative() if None in parts[:1] or (
            isinstance(node, Product) and None in parts
        ):
            return None
        case Power(exponent=Number(value=power)) if power.denominator == 1 and power > 0:
            return degrees[0] * float(power)
        case Call() | Power():
            return 2 * float(any(degrees))
        case _:
            return sum(degrees)


def check_values(file: FileReader, problem: Problem) -> None:
    """Values that break an assumption, negative masses, restitution that is not in 0 to 1, runs."""
    _check_run(file, problem)
    _check_dissipation(file, problem)
    _check_potential(file, problem)
    _check_momenta(file, problem)
    known = _known(problem)
    for parameter in problem.parameters:
        value = known.get(parameter.name)
        if value is None or parameter.value is None:
            continue
        mistake = parameter.mistake_of(value)
        if mistake is not None:
            hint = "correct the value, or what is assumed"
            file.error(mistake, parameter.value.span, hint)
    _check_masses(file, problem, known)
    striking = {one.name: one.restitution for one in problem.constraints}
    striking |= {one.name: one.restitution for one in problem.contacts}
    for name, formula in striking.items():
        value = None if formula is None else rational_value(formula, known)
        if formula is not None and value is not None and not 0 <= value <= 1:
            message = f"the restitution of '{name}' lies between 0 and 1, and is {value}"
            hint = "1 loses no energy, after 0 nothing rebounds"
            file.error(message, formula.span, hint)


def run_number(formula: Expression) -> float:
    """The value of an end or an accuracy; nan, which neither takes, where it is none."""
    from lagcli.evaluation import value_of

    try:
        return float(value_of(formula) or 0)
    except (ArithmeticError, ValueError):
        return math.nan


def run_mistake(name: str, value: float) -> str:
    """What is wrong with an end or an accuracy; empty where nothing is."""
    is_end = name == "until"
    sentence = "the end must be a time after 0" if is_end else "it lies between 0 and 1"
    if 0 < value < (math.inf if is_end else 1):
        return ""
    if name == "accuracy" and 3 <= value < 300 and value == int(value):
        return f"{sentence}, not {value:g}: write 1e-{value:g} for {value:g} digits"
    return sentence + (f", not {value:g}" if math.isfinite(value) else ", and a double")


def _check_run(file: FileReader, problem: Problem) -> None:
    """The defaults of a run, which `simulate` and the studies go by."""
    defaults = problem.simulation
    for name, formula in (("until", defaults.until), ("accuracy", defaults.accuracy)):
        if formula is not None and (mistake := run_mistake(name, run_number(formula))):
            usual = {"until": "such as until: 10", "accuracy": "such as accuracy: 1e-9"}
            hint = "" if "write" in mistake else usual[name]
            file.error(f"'{name}': {mistake}", formula.span, hint)


def _check_dissipation(file: FileReader, problem: Problem) -> None:
    """Rayleigh's function takes energy at the rate Σ q' ∂D/∂q'; no odd one does so both ways.

    Source: Goldstein, Poole, Safko, Classical Mechanics, 3rd edition, section 1.5.
    """
    formula = problem.dissipation
    if formula is None or formula == ZERO:
        return
    if derivative_order(formula, file.scope) < 1:
        law, coordinates = SourceText.of(problem.source).written(formula.span), problem.coordinates
        is_factor = len(coordinates) == 1 and not isinstance(formula, Sum | Negative)
        hint = f"write {law}*{coordinates[0].name}'^2/2: {FRICTION}" if is_factor else FRICTION
        file.error("the dissipation contains no velocity", formula.span, hint)
    elif _parity(formula, problem.definitions) == -1:
        message = "the dissipation changes its sign with the velocities"
        whole = as_rayleigh(SourceText.of(problem.source).written(formula.span))
        power, force = _odd_meant(formula, problem)
        hint = f"write {power}: its force is opposite to the velocity" if power else force
        file.error(message, formula.span, f"write {whole}: {FRICTION}" if whole else hint)


def _odd_meant(formula: Expression, problem: Problem) -> tuple[str, str]:
    """What is odd in the velocities as Rayleigh's function, or empty, and as a law of a force.

    c q'^3/3 is divided as c |q'|^3/3 is, whose force is -c q' |q'|.
    """
    law = SourceText.of(problem.source).written(formula.span)
    rates = {node.name for node in name_nodes(formula) if node.primes}
    calls = {node.function for node in walk(formula) if isinstance(node, Call)}
    parts = map(int, re.findall(r"/\s*(\d+)(?![\d.])", law))
    is_power = calls <= {"abs"} and any(part & part - 1 for part in parts)
    power = re.sub(r"(?<!\w)(?<!abs\()[^\W\d]\w*'(?!')", r"abs(\g<0>)", law) if is_power else ""
    force = law if law[0] == "-" else opposite(formula, SourceText.of(problem.source))
    is_one = len(rates) == 1 and rates <= {one.name for one in problem.coordinates}
    hint = f"a law of a force: write forces: {{{''.join(rates)}: {force}}}"
    return power, hint if is_one and force else FRICTION


def _check_momenta(file: FileReader, problem: Problem) -> None:
    """H has momenta p_q: a coordinate p beside q is another one, with a momentum p_p."""
    names = [one.name for one in problem.coordinates]
    used = {one.name for one in name_nodes(problem.hamiltonian or ZERO)}
    for one in problem.coordinates:
        moved = momentum_meant(one.name, [name for name in names if name != one.name])
        if moved and one.name in used and f"p_{moved}" not in used:
            message = f"'{one.name}' is a coordinate of its own here, not the momentum of {moved}"
            file.error(message, one.span, f"leave it out: the momentum of {moved} is p_{moved}")


def _check_potential(file: FileReader, problem: Problem) -> None:
    """V is linear in velocities in a magnetic field, and has r'^2/r in Weber's electrodynamics.

    Another term with velocities is meant as friction, and acts as a negative kinetic energy.
    """
    terms = terms_of(problem.potential or ZERO)
    wrong = [each for each in terms if not isinstance(each, Negative) and _is_misplaced(file, each)]
    if not wrong:
        return
    written = SourceText.of(problem.source).written_sum
    rest = written(term.span for term in terms if term not in wrong)
    moved = written(term.span for term in wrong)
    sums = [node for term in wrong for node in walk(term) if isinstance(node, Sum)]
    power, force = _odd_meant(wrong[0], problem) if not wrong[1:] else ("", FRICTION)
    if any(len({*map(has_velocity, each.terms)}) > 1 for each in sums):
        hint = FRICTION
    elif _parity(wrong[0], problem.definitions) == -1 and not power:
        hint = force
    else:
        given = f"{written([problem.dissipation.span])} + " if problem.dissipation else ""
        hint = f"friction has no potential: write dissipation: {given}{power or moved}"
        hint += f", and V: {rest}" if rest else " in place of V"
    file.error("a term of V is not linear in the velocities", wrong[0].span, hint)


def _is_misplaced(file: FileReader, term: Expression) -> bool:
    """Whether a term is not linear in velocities, and contains no coordinate."""

    def degree(node: Expression, parts: list[float]) -> float:
        match node:
            case Name():
                return float(derivative_order(node, file.scope) > 0)
            case Sum():
                return max(parts)
            case Power(exponent=Number(value=power)):
                return parts[0] * float(power)
            case Call(function=function):
                return 2 * max(parts) if function in _EVEN else max(parts)
            case _:
                return sum(parts)

    above: Expression = term
    below: Expression = ONE
    if isinstance(term, Quotient):
        above, below = term.numerator, term.denominator
    factors = above.factors if isinstance(above, Product) else (above,)
    inner = [part for factor in factors if isinstance(factor, Sum) for part in factor.terms]
    plain = [factor for factor in factors if not isinstance(factor, Sum)]
    outer = [name for factor in (*plain, below) for name in name_nodes(factor)]
    at_a_place = any(derivative_order(name, file.scope) == 0 for name in outer)
    of_a_sum = any(_is_misplaced(file, part) for part in inner)
    return not at_a_place and (of_a_sum or (not inner and folded(term, degree) > 1))


def _parity(formula: Expression, definitions: Mapping[str, Expression]) -> int:
    """1 or -1 for what is even or odd under q' → -q', 0 where that is not plain to see."""

    def parity(node: Expression, parts: list[int]) -> int:
        match node:
            case Name(name=name, primes=primes):
                held = definitions.get(name)
                return (1 if held is None else _parity(held, definitions)) * (1 - 2 * (primes % 2))
            case Sum():
                return parts[0] if len(set(parts)) == 1 else 0
            case Product() | Quotient() | Negative():
                return math.prod(parts)
            case Power(exponent=Number(value=power)) if power.denominator == 1:
                return int(parts[0] ** abs(power))
            case Call(function=function) if function in _ODD or (function in _EVEN and parts[0]):
                return parts[0] if function in _ODD else 1
            case _:
                return int(all(part == 1 for part in parts))

    return folded(formula, parity)


def _check_masses(file: FileReader, problem: Problem, known: Mapping[str, Fraction]) -> None:
    """A mass is not negative, in numbers or for all parameters with their signs."""
    signs = _signs(problem, known, 0)
    for point in problem.points:
        mass = point.mass
        if mass is None:
            continue
        value = rational_value(mass, known)
        if (plain_sign(mass, signs, problem.definitions) if value is None else value) < 0:
            message = f"the mass of '{point.name}' is negative"
            file.error(message, mass.span, "write it without its sign")


def _known(problem: Problem) -> dict[str, Fraction]:
    """The values that are rational numbers, those of others by them."""
    left = {p.name: p.value for p in problem.parameters if p.value is not None}
    known: dict[str, Fraction] = {}
    while True:
        found = {name: rational_value(value, known) for name, value in left.items()}
        new = {name: value for name, value in found.items() if value is not None}
        if not new:
            return known
        known |= new
        left = {name: value for name, value in left.items() if name not in new}
