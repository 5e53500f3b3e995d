"""Sines, exponentials and symbolic powers of sums: one generator for each base argument.

An argument is split into rational multiples of base arguments, theta/2 + 2*Omega*t into
(1/2, theta) and (2, Omega*t).  The functions of k_1 a_1 + k_2 a_2 + … follow from those
of the a_i by the addition theorems, so equal functions always get equal normal forms.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import cached_property, reduce
from math import gcd, lcm

import sympy
from sympy import Expr, Rational

from lagcli.algebra.field import Element, Generator
from lagcli.algebra.generators import ExpressionField

#: Beyond these, an argument is a base argument of its own.
MAX_MULTIPLE = 10
#: Of exponentials, whose powers are one term each: exp(12 c t/5) with a unit of c t/5.
_MAX_POWER = 60
MAX_PARTS = 10  # measured: at most 3

_INVERSE = (
    sympy.log, sympy.asin, sympy.acos, sympy.atan, sympy.atan2,
    sympy.asinh, sympy.acosh, sympy.atanh,
)  # fmt: skip


def split(field: ExpressionField, argument: Expr) -> list[tuple[Fraction, Expr]]:
    """The argument as a sum of rational multiples of base arguments (1 for a number)."""
    if argument.is_Symbol:
        return [(Fraction(1), argument)]
    element = field(argument)
    ring = field.ring
    content = int(element.denominator.content())
    below = element.denominator / content
    terms = list(ring.terms(element.numerator))
    if len(terms) > MAX_PARTS:
        sign = 1 if terms[0][1] > 0 else -1
        return [(Fraction(sign), field.to_sympy(element) * sign)]
    parts = []
    for monomial, coefficient in terms:
        base = field.element(ring.build([(monomial, 1)]), below)
        parts.append((Fraction(coefficient, content), field.to_sympy(base)))
    return parts


class Multiples:
    """The base arguments of one kind of function and the fraction each comes in.

    Parameters
    ----------
    kind
        circular, hyperbolic, exp or power.
    """

    def __init__(self, field: ExpressionField, kind: str, base: Expr | None = None) -> None:
        self.field = field
        self.kind = kind
        self.base = base  # of a power
        self.most = _MAX_POWER if kind in ("exp", "power") else MAX_MULTIPLE
        self._unit: dict[Expr, Fraction] = {}  # base argument -> N: the generator is of argument/N
        self._generators: dict[tuple[Expr, Fraction], int] = {}
        self._prepared: list[dict[Expr, Fraction]] = []  # multiples by base argument

    def prepare(self, argument: Expr) -> None:
        """Note the fractions of an argument, before generators are made."""
        parts = split(self.field, argument)
        self._prepared.append({base: multiple for multiple, base in parts})
        for multiple, base in parts:
            unit = self._unit.get(base, Fraction(1))
            self._unit[base] = Fraction(lcm(unit.numerator, multiple.denominator))

    def has(self, argument: Expr) -> bool:
        """Whether multiples of a part of the argument were prepared."""
        return any(base in self._unit for _, base in split(self.field, argument))

    @cached_property
    def _together(self) -> list[tuple[Expr, dict[Expr, Fraction]]]:
        """Sums of base arguments that stand in one ratio wherever they were prepared: a r - a b.

        Of angles where no single ones will be wanted.  With -x where exp(-x) was prepared.
        """
        groups: dict[tuple[Fraction, ...], dict[Expr, Fraction]] = {}
        for base in self._unit if self.kind != "circular" or self.field.alone else ():
            if base is sympy.pi and self.kind == "circular":
                continue
            column = [each.get(base, Fraction(0)) for each in self._prepared]
            first = next((value for value in column if value), Fraction(1))
            groups.setdefault(tuple(value / first for value in column), {})[base] = first
        found = []
        for (leader, first), *others in (group.items() for group in groups.values()):
            ratios = {leader: Fraction(1), **{base: ratio / first for base, ratio in others}}
            whole = sympy.Add(*(Rational(ratio) * base for base, ratio in ratios.items()))
            if self._is_turned(leader, whole):
                whole, ratios = -whole, {base: -ratio for base, ratio in ratios.items()}
            if others or whole != leader:
                self._unit[whole] = self._unit[leader]
                found.append((whole, ratios))
        return found

    def _is_turned(self, leader: Expr, whole: Expr) -> bool:
        """Whether the generator is of -whole: exp(-x) of what decays, cosh as SymPy has it."""
        if self.kind in ("hyperbolic", "circular"):
            return bool(whole.could_extract_minus_sign())
        return sum(each.get(leader, Fraction(0)) for each in self._prepared) < 0

    @cached_property
    def _scales(self) -> dict[Expr, int]:
        """3 for Omega t where 3 Omega t and 6 Omega t are all that occurs."""
        if self.kind != "circular" or not self.field.closed:
            return {}
        found: dict[Expr, int] = {}
        for each in self._prepared:
            for multiple, base in self._joined((value, base) for base, value in each.items()):
                whole = multiple * self._unit.get(base, Fraction(1))
                found[base] = gcd(found.get(base, 0), whole.numerator)
        return {base: scale for base, scale in found.items() if scale > 1}

    def _joined(self, parts: Iterable[tuple[Fraction, Expr]]) -> list[tuple[Fraction, Expr]]:
        """The parts, those of each such sum as a multiple of it."""
        left = {base: multiple for multiple, base in parts}
        found = []
        for whole, ratios in self._together:
            multiples = {left.get(base, Fraction(0)) / ratio for base, ratio in ratios.items()}
            if len(multiples) > 1:
                self.field.doubtful = True
            elif multiple := multiples.pop():
                found.append((multiple, whole))
                left = {base: value for base, value in left.items() if base not in ratios}
        return [*found, *((multiple, base) for base, multiple in left.items())]

    def parts(self, parts: Iterable[tuple[Fraction, Expr]]) -> Iterator[tuple[int, int]]:
        """(k, g) for each part: it is k times the argument of generator g."""
        for multiple, base in self._joined(parts):
            unit = self._unit.setdefault(base, Fraction(multiple.denominator))
            unit /= self._scales.get(base, 1)
            scaled = multiple * unit
            if scaled.denominator != 1:
                unit = Fraction(lcm(unit.numerator, multiple.denominator))
                scaled = multiple * unit
                self.field.doubtful = True
                self._unit[base] = unit
            multiplier = scaled.numerator
            part = base / Rational(unit)
            if abs(multiplier) > self.most:
                self.field.doubtful = True
                part, multiplier = abs(multiplier) * part, 1 if multiplier > 0 else -1
                yield multiplier, self._generator(part, Fraction(1))
            else:
                yield multiplier, self._generator(base, unit)

    def _generator(self, base: Expr, unit: Fraction) -> int:
        key = (base, unit)
        if key not in self._generators:
            argument = base / Rational(unit)
            if not argument.free_symbols or argument.has(*_INVERSE):
                self.field.doubtful = True
            self._generators[key] = self._create(argument)
        return self._generators[key]

    def _create(self, argument: Expr) -> int:
        field = self.field
        if self.kind == "exp":
            return field.add_generator(
                Generator("exp", sympy.exp(argument), argument, nonnegative=True)
            )
        if self.kind == "power":
            assert self.base is not None
            value = sympy.Pow(self.base, argument)
            positive = bool(self.base.is_positive)
            return field.add_generator(Generator("power", value, argument, nonnegative=positive))
        circular = self.kind == "circular"
        names = ("cos", "sin") if circular else ("cosh", "sinh")
        functions = (sympy.cos, sympy.sin) if circular else (sympy.cosh, sympy.sinh)
        index = len(field.generators)
        field.add_generator(
            Generator(names[0], functions[0](argument), argument, index + 1,
                      nonnegative=not circular)
        )  # fmt: skip
        field.add_generator(Generator(names[1], functions[1](argument), argument, index))
        ring = field.ring
        square = ring.generator(index) ** 2
        # sin² = 1 − cos², sinh² = cosh² − 1
        ring.rule(index + 1, 2, ring.one - square if circular else square - ring.one)
        return index

    def pair(self, argument: Expr) -> tuple[Element, Element]:
        """(cos, sin) or (cosh, sinh) of the argument."""
        field = self.field
        cosine, sine = field.rational(1), field.rational(0)
        parts = split(field, argument)
        if sum(abs(multiple) for multiple, _ in parts) > self.most:
            # expanded, it would be longer than anyone wants to see
            field.doubtful = True
            number = parts[0][0]
            parts = [(Fraction(1 if number > 0 else -1), argument if number > 0 else -argument)]
        for position, (multiple, base) in enumerate(parts):
            if base is sympy.pi and self.kind == "circular":
                value = multiple.numerator * base / multiple.denominator
                exact = sympy.cos(value), sympy.sin(value)
                if not exact[0].has(sympy.cos, sympy.sin):
                    cosine, sine = field(exact[0]), field(exact[1])
                    del parts[position]
                    break
        for multiplier, index in self.parts(parts):
            c, s = self._multiple(index, abs(multiplier))
            if multiplier < 0:
                s = -s
            cosine, sine = self._of_sum((cosine, sine), (c, s))
        return cosine, sine

    def _multiple(self, index: int, count: int) -> tuple[Element, Element]:
        """Both functions of `count` times the argument of the generator."""
        once = self.field.generator(index), self.field.generator(index + 1)
        return reduce(self._of_sum, [once] * count)

    def _of_sum(
        self, a: tuple[Element, Element], b: tuple[Element, Element]
    ) -> tuple[Element, Element]:
        """cos(a + b) = cos a cos b ∓ sin a sin b, sin(a + b) = sin a cos b + cos a sin b."""
        (cosine, sine), (c, s) = a, b
        product = sine * s
        turned = -product if self.kind == "circular" else product
        return cosine * c + turned, sine * c + cosine * s

    def power(self, argument: Expr) -> Element:
        """The exponential of the argument, or the base raised to it."""
        field = self.field
        result = field.rational(1)
        for multiplier, index in self.parts(split(field, argument)):
            result = result * field.generator(index) ** multiplier
        return result
