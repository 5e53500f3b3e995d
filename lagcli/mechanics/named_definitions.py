"""Definitions that answers keep by their names: mu = m1 m2/(m1 + m2), r = sqrt(x² + y²)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import chain, combinations
from math import prod

from sympy import Expr, S

from lagcli.algebra.build import Builder, symbol
from lagcli.algebra.generic_rank import has_full_rank
from lagcli.algebra.signs import sign
from lagcli.document import Block, Equations
from lagcli.expression import (
    ONE,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    power_of,
    product_of,
    quotient_of,
    walk,
)
from lagcli.notation.factors import cancelled, half_of, parts_of, whole_power
from lagcli.notation.given_formulas import is_constant
from lagcli.notation.likeness import Monomial, Polynomial, multiplied_out
from lagcli.problem_data import Assumption, Parameter, Problem
from lagcli.record import replace
from lagcli.rewriting import Value, expressions_in, rebuilt, rewritten
from lagcli.statements.explanation import ExplanationStep

_ASIDE = ("source", "definitions", "parameters", "coordinates", "functions", "expect", "named",
          "simulation", "picture")  # fmt: skip
_ONE = Fraction(1)
_MOST = 5  # definitions of constants among which those to be kept are looked for
_SIGNS: dict[int | None, Assumption] = {1: "positive", -1: "negative"}


def with_named_constants(problem: Problem) -> Problem:
    """The problem with definitions of constants as parameters, where that loses nothing.

    What they are made of occurs nowhere else, and they are independent of each other: their
    values are then as arbitrary as those of parameters.
    """
    constants = [name for name in problem.definitions if is_constant(problem, name)]
    if not constants or len(constants) > _MOST:
        return problem
    sizes = range(len(constants), 0, -1)
    for chosen in chain(*(combinations(constants, size) for size in sizes)):
        used = _used(problem, chosen)
        kept = [name for name in chosen if name in used]
        values = _values(problem, kept) if kept else None
        if values and _are_free(values, used):
            return _with_parameters(problem, values)
    return problem


def _is_mass(problem: Problem, name: str) -> bool:
    """Whether a definition is that of a reduced or a total mass."""
    whole = walk(_without(problem, Name(name), {}))
    names = [name, *(part.name for part in whole if isinstance(part, Name))]
    return all(each[0] in "mM" for each in names)


def _used(problem: Problem, chosen: tuple[str, ...]) -> set[str]:
    """The names in the formulas of the file, the other definitions written out."""
    fields = (n for n in type(problem).__dataclass_fields__ if n not in _ASIDE)
    left = [node for n in fields for node in expressions_in(getattr(problem, n))]
    found: set[str] = set()
    while left:
        for part in walk(left.pop()):
            if isinstance(part, Name) and part.name not in found:
                found.add(part.name)
                if part.name in problem.definitions and part.name not in chosen:
                    left.append(problem.definitions[part.name])
    return found


def _values(problem: Problem, names: list[str]) -> dict[str, Expr] | None:
    parameters = {p.name: symbol(p.name, p.assume, integer=p.integer) for p in problem.parameters}
    arities = {name: len(args) for name, args in problem.functions.items()}
    build = Builder(parameters, arities, lambda _: S.Zero, lambda _: ValueError())
    try:
        for name, formula in problem.definitions.items():
            if is_constant(problem, name):
                build.names[name] = build(formula)
    except (ArithmeticError, ValueError):
        return None
    return {name: build.names[name] for name in names}


def _are_free(values: Mapping[str, Expr], used: set[str]) -> bool:
    """Whether nothing else holds their parameters, and no equation holds between them."""
    parameters = sorted({s for value in values.values() for s in value.free_symbols}, key=str)
    if any(s.name in used for s in parameters):
        return False
    return has_full_rank([[value.diff(s) for value in values.values()] for s in parameters])


def _with_parameters(problem: Problem, values: Mapping[str, Expr]) -> Problem:
    made = [
        Parameter(name=name, assume=_SIGNS.get(sign(value), "real"))
        for name, value in values.items()
    ]
    left = {n: node for n, node in problem.definitions.items() if n not in values}
    named = {n: _without(problem, problem.definitions[n], values) for n in values}
    return replace(problem, parameters=(*made, *problem.parameters), definitions=left, named=named)


def _without(problem: Problem, node: Expression, kept: Mapping[str, Expr]) -> Expression:
    """The definition, those that are not kept written out."""
    if isinstance(node, Name) and node.name in problem.definitions and node.name not in kept:
        return _without(problem, problem.definitions[node.name], kept)
    return rebuilt(node, lambda part: _without(problem, part, kept))


class NamedRoots:
    """r for sqrt(x² + y²), r^3 for (x² + y²)^(3/2), where the file defines r so."""

    def __init__(self, problem: Problem) -> None:
        self._found: list[tuple[Polynomial, str]] = []
        fixed = {q.name for q in (*problem.parameters, *problem.coordinates)}
        for name, node in problem.definitions.items():
            names = [part for part in walk(node) if isinstance(part, Name)]
            if not isinstance(node, Call) or node.function != "sqrt":
                continue
            value = multiplied_out(node.arguments[0])
            if value and len(value) > 1 and all(n.name in fixed and not n.primes for n in names):
                self._found.append((value, name))

    def __bool__(self) -> bool:
        return bool(self._found)

    def __call__(self, node: Expression) -> Expression:
        """The formula with the names, but for the definition itself."""
        return rebuilt(node, self._within)

    def _within(self, node: Expression) -> Expression:
        match node:
            case Call(function="sqrt", arguments=(inner,)) if name := self._name(inner):
                return Name(name)
            case Power(base=base, exponent=exponent) if name := self._name(base):
                power = half_of(exponent)
                if power is None and isinstance(exponent, Number):
                    power = exponent.value
                if power is not None:
                    return Power(Name(name), Number(2 * power))
            case Quotient(numerator=above, denominator=below):
                return Quotient(self._within(above), self._below(below))
        return rebuilt(node, self._within)

    def _below(self, node: Expression) -> Expression:
        """m r² for m (x² + y²), which is divided by."""
        name = self._name(node) if isinstance(node, Sum) else ""
        if name:
            return Power(Name(name), Number(Fraction(2)))
        return rebuilt(node, self._below) if isinstance(node, Product) else self._within(node)

    def _name(self, node: Expression) -> str:
        value = multiplied_out(node)
        return next((name for known, name in self._found if known == value), "")


class NamedConstants:
    """mu for m1 m2/(m1 + m2), M for m1 + m2, where m1, m2 occur elsewhere, too.

    Definitions of masses, and others that the physics of the file uses.  The derivation has them
    written out.  A term is looked at as a whole, so that the reciprocal and powers are found:
    (m1 + m2) p²/(2 m1 m2) is p²/(2 mu).
    """

    def __init__(self, problem: Problem) -> None:
        self._fractions: dict[str, tuple[Fraction, Mapping[Key, int]]] = {}
        self._divisors: dict[str, Expression] = {}
        self._sums: list[tuple[Polynomial, str]] = []
        constants = [name for name in problem.definitions if is_constant(problem, name)]
        used = _used(problem, tuple(constants))
        for name in constants:
            if name not in used and not _is_mass(problem, name):
                continue
            whole = _without(problem, Name(name), {})
            number, powers = _powers_of(whole)
            if len(powers) > 1 and any(len(key) > 1 for key in powers):
                self._fractions[name] = number, powers
                _, _, below = _parts_of(whole)
                if len(below) == 1 and _is_positive(problem, below[0]):
                    self._divisors[name] = below[0]
            elif isinstance(whole, Sum) and (value := multiplied_out(whole)) and len(value) > 1:
                self._sums.append((value, name))

    def __bool__(self) -> bool:
        return bool(self._fractions or self._sums)

    def __call__(self, node: Expression) -> Expression:
        """The formula with the names."""
        return self._with_sums(self._with_fractions(node))

    def _with_fractions(self, node: Expression) -> Expression:
        node = rebuilt(node, self._with_fractions)
        if isinstance(node, (Product, Quotient, Sum)):
            if isinstance(node, Quotient):
                node = self._cancelled(node)
            for name, (number, powers) in self._fractions.items():
                whole = _with_fraction(node, name, number, powers)
                node = node if whole is None else whole
        if isinstance(node, Call) and node.function == "sqrt":
            return self._root(node)
        return node

    def _cancelled(self, node: Quotient) -> Expression:
        """sqrt(p² + mu k) for M sqrt(p² + mu k)/M, and mu for 1/(1/mu)."""
        minus, above, below = parts_of(node)
        bases = [{base for base, _ in map(whole_power, side)} for side in (above, below)]
        if not bases[0].isdisjoint(bases[1] & {*self._divisors.values()}):
            above, below = cancelled(above, below)
        elif not isinstance(node.denominator, Quotient):
            return node
        whole = quotient_of([f for f in above if f != ONE] or [ONE], below)
        return Negative(whole) if minus else whole

    def _root(self, node: Call) -> Expression:
        """M sqrt(p² + mu k) for sqrt(M (M p² + m1 m2 k)), M = m1 + m2 > 0."""
        for name, divisor in self._divisors.items():
            minus, above, below = parts_of(node.arguments[0])
            _, key = _key(divisor)
            count, kept = 0, list[Expression]()
            for factor in above:
                base, exponent = whole_power(factor)
                found = _homogeneous(base, name, *self._fractions[name], key)
                if _key(base) == (_ONE, key):
                    count += exponent
                elif found is not None and exponent == 1:
                    count += found[0]
                    kept.append(found[1])
                else:
                    kept.append(factor)
            if count and count % 2 == 0 and len(kept) and not minus:
                root = Call("sqrt", (quotient_of(kept, below),))
                return product_of((power_of(divisor, count // 2), root))
        return node

    def _with_sums(self, node: Expression) -> Expression:
        if isinstance(node, Sum) and self._sums:
            value = multiplied_out(node)
            if name := next((name for known, name in self._sums if known == value), ""):
                return Name(name)
        return rebuilt(node, self._with_sums)


def by_names(problem: Problem, found: Value) -> Value:
    """Statements with r for sqrt(x² + y²) and mu for m1 m2/(m1 + m2), as the file defines them."""
    for names in NamedRoots(problem), NamedConstants(problem):
        found = rewritten(found, names) if names else found
    return found


def steps_by_names(
    problem: Problem, steps: tuple[ExplanationStep, ...]
) -> tuple[ExplanationStep, ...]:
    """Steps of an explanation, as `by_names`; the definitions themselves stay written out."""
    return tuple(
        replace(new, blocks=tuple(map(_not_by_itself, old.blocks, new.blocks)))
        for old, new in zip(steps, by_names(problem, steps), strict=True)
    )


def _not_by_itself(old: Block, new: Block) -> Block:
    """The block with `old` rows, mu = m1 m2/(m1 + m2), for new ones that say mu = mu."""
    if not isinstance(old, Equations) or not isinstance(new, Equations):
        return new
    rows = zip(old.rows, new.rows, strict=True)
    return Equations(tuple(a if b.left == b.right else b for a, b in rows))


#: The terms of a base without their common number.
Key = frozenset[tuple[Monomial, Fraction]]


def _powers_of(node: Expression) -> tuple[Fraction, dict[Key, int]]:
    """The number and the exponents of the bases of a product or quotient."""
    minus, above, below = _parts_of(node)
    number, powers = Fraction(-1 if minus else 1), dict[Key, int]()
    for sign_, factors in (1, above), (-1, below):
        for base, exponent in map(whole_power, factors):
            content, key = _key(base)
            number *= content ** (sign_ * exponent)
            if key:
                powers[key] = powers.get(key, 0) + sign_ * exponent
    return number, {key: exponent for key, exponent in powers.items() if exponent}


def _parts_of(node: Expression) -> tuple[bool, list[Expression], list[Expression]]:
    """As `parts_of`, with (m1 + m2)/(m1 m2) for the factor 1/m1 + 1/m2."""
    minus, above, below = parts_of(node)
    found: list[list[Expression]] = [[], []]
    for side, factors in enumerate((above, below)):
        for factor in factors:
            sums, under = _over_letters(factor)
            found[side].append(sums)
            found[1 - side] += under
    return minus, found[0], found[1]


def _over_letters(node: Expression) -> tuple[Expression, list[Expression]]:
    """A sum of fractions as a sum and the letters below it; anything else as it is."""
    if not isinstance(node, Sum):
        return node, []
    terms = [parts_of(term) for term in node.terms]
    under = list(dict.fromkeys(factor for _, _, below in terms for factor in below))
    if not under or not all(isinstance(each, Name) for each in under):
        return node, []
    whole = [
        product_of((*above, *(u for u in under if u not in below))) for _, above, below in terms
    ]
    signs = (minus for minus, _, _ in terms)
    return Sum(tuple(Negative(w) if m else w for m, w in zip(signs, whole, strict=True))), under


def _key(base: Expression) -> tuple[Fraction, Key]:
    """The number before a base and the base without it; no base of a number."""
    terms = multiplied_out(base)
    if not terms or frozenset() in terms:
        known = terms and len(terms) == 1
        return (terms[frozenset()], frozenset()) if known and terms else (_ONE, _alone(base))
    content = min((c for c in terms.values()), key=abs) if len(terms) > 1 else _ONE
    if len(terms) == 1:
        (content,) = terms.values()
    return content, frozenset((term, c / content) for term, c in terms.items())


def _is_positive(problem: Problem, node: Expression) -> bool:
    """Whether each term of a sum is positive, and no number stands before the sum."""
    positive = {p.name for p in problem.parameters if p.assume == "positive"}
    names = {part.name for part in walk(node) if isinstance(part, Name)}
    terms = multiplied_out(node) or {}
    return names <= positive and all(c > 0 for c in terms.values()) and _key(node)[0] == 1


def _homogeneous(
    node: Expression, name: str, number: Fraction, powers: Mapping[Key, int], divisor: Key
) -> tuple[int, Expression] | None:
    """n and p² + mu k for M^n (p² + mu k), where n factors of each term are M or m1 m2."""
    if not isinstance(node, Sum) or powers.get(divisor) != -1:
        return None
    over = {key: exponent for key, exponent in powers.items() if key != divisor}
    if not over or min(over.values()) < 0:
        return None
    counts = []
    for term in node.terms:
        _, there = _powers_of(term)
        counts.append((min(there.get(k, 0) // e for k, e in over.items()), there.get(divisor, 0)))
    n = sum(counts[0])
    if n < 1 or any(min(c) < 0 or sum(c) != n for c in counts) or len(set(counts)) == 1:
        return None
    terms = [
        _with_power(
            term, name, i, {k: i * e for k, e in over.items()} | {divisor: n - i}, number**-i
        )
        for term, (i, _) in zip(node.terms, counts, strict=True)
    ]
    return n, Sum(tuple(terms))


def _alone(base: Expression) -> Key:
    return frozenset({(frozenset({(repr(base), 1)}), _ONE)})


def _with_fraction(
    node: Expression, name: str, number: Fraction, powers: Mapping[Key, int]
) -> Expression | None:
    """The term with name^k for (number · product of powers)^k; None where it does not occur."""
    _, there = _powers_of(node)
    ratios = [Fraction(there.get(key, 0), exponent) for key, exponent in powers.items()]
    if not (all(r >= 1 for r in ratios) or all(r <= -1 for r in ratios)):
        return None
    k = int(min(ratios, key=abs))  # towards 0
    return _with_power(node, name, k, {b: k * e for b, e in powers.items()}, number**-k)


def _with_power(
    node: Expression, name: str, k: int, left: dict[Key, int], count: Fraction
) -> Expression:
    """The term without the powers `left`, times the number `count` and name^k."""
    minus, above, below = _parts_of(node)
    count = -count if minus else count
    kept: list[list[Expression]] = [[], []]
    for side, sign_, factors in (0, 1, above), (1, -1, below):
        for factor in factors:
            base, exponent = whole_power(factor)
            content, key = _key(base)
            if not left.get(key, 0) * sign_ > 0:
                kept[side].append(factor)
                continue
            taken = min(exponent, left[key] * sign_)
            left[key] -= taken * sign_
            count *= content ** (sign_ * taken)
            if exponent > taken:
                kept[side].append(power_of(base, exponent - taken))
    if k:
        kept[0 if k > 0 else 1].insert(0, power_of(Name(name), abs(k)))
    numbers = [prod((f.value for f in side if isinstance(f, Number)), start=_ONE) for side in kept]
    count *= numbers[0] / numbers[1]
    for side, value in enumerate((abs(count.numerator), count.denominator)):
        rest_ = [f for f in kept[side] if not isinstance(f, Number)]
        kept[side] = [Number(Fraction(value)), *rest_] if value != 1 else rest_
    found = quotient_of(kept[0] or [ONE], kept[1])
    return Negative(found) if count < 0 else found
