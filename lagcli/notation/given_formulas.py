"""The formulas of a file: the order of its letters in a product (m g l), and its decimals."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import combinations

from lagcli.expression import (
    Expression,
    Name,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    walk,
)
from lagcli.notation.naming import Names
from lagcli.notation.ordering import bases
from lagcli.problem_data import Problem
from lagcli.rewriting import expressions_in

_PARTS = (
    "definitions", "points", "kinetic", "potential", "lagrangian", "hamiltonian", "forces",
    "dissipation", "symmetries", "observables", "initial", "find",
)  # fmt: skip

_DECIMAL = re.compile(r"(?<![\w.])(\d+\.\d*|\.\d+)(?![\w.])")


def given(problem: Problem) -> Iterator[Expression]:
    """The formulas of the file that say what the system is."""
    for name in _PARTS:
        yield from expressions_in(getattr(problem, name))
    for constraint in problem.constraints:
        left, right = constraint.equation.left, constraint.equation.right
        yield from (left, right)


def order_of_names(problem: Problem) -> tuple[str, ...]:
    """Parameters, t, coordinates, momenta, velocities, accelerations, multipliers."""
    q = [coordinate.name for coordinate in problem.coordinates]
    fast = (spelled.format(name) for spelled in ("p_{}", "{}'", "{}''") for name in q)
    multipliers = (constraint.multiplier for constraint in problem.constraints)
    return (*order_of_parameters(problem), "t", *q, *fast, *multipliers)


def order_of_parameters(problem: Problem) -> list[str]:
    """The parameters, each before those that it precedes in the first product of both.

    Where products do not decide, or contradict each other, as they are declared, but g before all
    that is no mass.
    """
    names = [parameter.name for parameter in problem.parameters]
    constants = {
        name: {part.name for part in walk(node) if isinstance(part, Name)}
        for name, node in problem.definitions.items()
        if is_constant(problem, name)
    }
    for name, made_of in constants.items():  # mu before m1 and m2, others after what they are of
        places = [k for k, other in enumerate(names) if other in made_of]
        names.insert(places[0] if name[0] in "mM" else places[-1] + 1, name)
    masses = {name for name in names if name[0] in "mM"}  # g (m1 x1 + m2 x2), but m1 g
    before: set[tuple[str, str]] = set()
    products = (p for node in given(problem) for p in walk(node) if isinstance(p, Product))
    for inner, row in (pair for product in products for pair in enumerate(_multiplied(product))):
        letters = dict.fromkeys(name for name in row if name in names)
        pairs = (pair for pair in combinations(letters, 2) if pair[::-1] not in before)
        before.update((a, b) for a, b in pairs if not inner or a != "g" or b not in masses)
    names = _behind_masses(names, masses, before, _divisors(problem))
    weight = names.index("g") if "g" in names else 0
    lead = [k for k, name in enumerate(names[:weight]) if name in masses]
    if lead:
        names.insert(lead[-1] + 1, names.pop(weight))
    before |= {(a, c) for c, made_of in constants.items() for a, b in before
               if b in made_of and a not in made_of and (c, a) not in before}  # fmt: skip
    ordered: dict[str, None] = {}
    begun: set[str] = set()

    def place(name: str) -> None:
        if name not in begun:
            begun.add(name)
            for other in names:
                if (other, name) in before:
                    place(other)
            ordered[name] = None

    for name in names:
        place(name)
    return list(ordered)


def _divisors(problem: Problem) -> set[str]:
    """The names that formulas are divided by, R of I/R², and that stand above no other ones."""
    below, above = set[str](), set[str]()
    for node in given(problem):
        for part in walk(node):
            if isinstance(part, Quotient):
                below.update(_letters(part.denominator))
                above.update(_letters(part.numerator))
    return below - above


def _behind_masses(
    names: list[str], masses: set[str], before: set[tuple[str, str]], divisors: set[str]
) -> list[str]:
    """The names with those that follow one mass in a product behind all masses: m g R with M R².

    So does R of I/R².
    """
    ahead = {a for a, b in before if b in masses} | masses | {"g"}
    follow = ({b for a, b in before if a in masses} | divisors) - ahead
    last = max((k for k, name in enumerate(names) if name in masses), default=-1)
    early = [name for name in names[: last + 1] if name in follow]
    kept = [name for name in names[: last + 1] if name not in follow]
    return [*kept, *early, *names[last + 1 :]]


def _letters(node: Expression) -> Iterator[str]:
    """The names among the factors of a product, from left to right."""
    return (base.name for base in bases(node) if isinstance(base, Name))


def _multiplied(node: Product) -> Iterator[list[str]]:
    """The names that it multiplies, also into a sum or its square: k, r and k, l of k (r − l)²."""
    yield [*_letters(node)]
    for factor in node.factors:
        for term in _terms_inside(factor):
            parts = (term if part is factor else part for part in node.factors)
            yield [name for part in parts for name in _letters(part)]


def _terms_inside(factor: Expression) -> Iterator[Expression]:
    """The terms of a sum, of its square, and of such squares in it."""
    base = factor.base if isinstance(factor, Power) else factor
    for term in base.terms if isinstance(base, Sum) else ():
        inner = [*_terms_inside(term)] if isinstance(term, Power) else []
        yield from inner or [term]


def is_constant(problem: Problem, name: str) -> bool:
    """Whether a definition holds parameters and no variables."""
    names = {part.name for part in walk(problem.definitions[name]) if isinstance(part, Name)}
    parameters = {p.name for p in problem.parameters}
    known = all(n in parameters or (n in problem.definitions and is_constant(problem, n))
                for n in names - {"pi"})  # fmt: skip
    return known and bool(names - {"pi"})


def decimals_of(problem: Problem, settings: Iterable[str] = ()) -> list[Fraction]:
    """The values that the formulas of the file, or settings, write with a decimal point."""
    lines = problem.source.text.splitlines()
    found = []
    state = set(map(id, expressions_in(problem.initial)))
    for node in given(problem):
        for part in walk(node):
            if id(node) in state:
                break
            if isinstance(part, Number) and part.value.denominator != 1 and part.span.line:
                place = part.span
                written = lines[place.line - 1 : place.line]
                if any("." in line[place.column - 1 : place.end_column - 1] for line in written):
                    found.append(part.value)
    for setting in settings:
        value = setting.partition("=")[2]
        found += [Fraction(text) for text in _DECIMAL.findall(value)]
    return [value for value in found if value.denominator != 1]


def symbols_of(problem: Problem) -> dict[str, str]:
    """The LaTeX of the names for which the file gives a `symbol`."""
    return {q.name: q.symbol for q in (*problem.coordinates, *problem.parameters) if q.symbol}


def names_of(problem: Problem) -> Names:
    """Every name that the file gives a meaning."""
    quantities = (*problem.coordinates, *problem.parameters)
    return Names(
        (
            *(q.name for q in quantities),
            *symbols_of(problem).values(),
            *problem.definitions,
            *problem.functions,
            *(c.multiplier for c in problem.constraints),
            *(c.multiplier for c in problem.contacts),
            "t",
            "pi",
        )
    )
