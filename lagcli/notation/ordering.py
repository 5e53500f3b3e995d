"""The order in which a textbook writes factors and terms."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import TypeAlias

from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    children,
    opposite,
    walk,
)

_AFTER_NUMBERS = 10**6  # no file has so many names; measured: 21
#: Terms of a polynomial whose order is seen.
_SEVERAL = 3
#: sin(x)*cos(x), but other functions by name.
_RANK = {"sin": "co", "sinh": "co"}
_CIRCULAR = frozenset(("sin", "cos", "tan", "cot"))

Key: TypeAlias = tuple[object, ...]
Factor: TypeAlias = tuple[Expression, Fraction]  # base and exponent
Flat: TypeAlias = tuple[tuple[int, int | Fraction, str], ...]  # a key whose entries compare
TermKey: TypeAlias = tuple[int, int, int, int, tuple[int, ...], int, Flat]


class Ordering:
    """Sort keys for factors and terms.

    Parameters
    ----------
    names
        Names without primes in the order in which they are to appear in a product:
        parameters, ``t``, coordinates, multipliers.  Others come after these.
    """

    def __init__(self, names: Sequence[str] = ()) -> None:
        self._index = {name: position for position, name in enumerate(names)}
        fast = (i for i, name in enumerate(names) if name.startswith("p_") or name.endswith("'"))
        self._first_fast = next(fast, len(self._index))
        self._first_variable = self._index.get("t", len(self._index))
        self._memo: dict[Expression, Key] = {}
        self._terms: dict[Expression, TermKey] = {}
        self._powers: dict[Factor, Flat] = {}

    def factor(self, node: Expression) -> Key:
        """Numbers, parameters, t, coordinates, velocities, accelerations, sums, functions."""
        key = self._memo.get(node)
        if key is None:
            key = self._memo[node] = self._factor(node)
        return key

    def _factor(self, node: Expression) -> Key:
        match node:
            case Number(value=value):
                return (0, value)
            case Name(name="pi"):
                return (0, _AFTER_NUMBERS)
            case Name(name=name, primes=primes):
                return (1, primes, self._place(node), name)
            case Power(base=Name() as base, exponent=Number(value=value)) if self._is_constant(
                base
            ):
                return (*self._factor(base), 0, -value)  # a⁴ + a² b² + b⁴
            case Power(base=base, exponent=exponent):
                return (*self._factor(base), *self._factor(exponent))
            case Call(function="sqrt"):
                return (2, *self._parts(node))
            case Sum() if self._is_plain(node):
                return (1, 0, self._first(node), "~", *self._parts(node))
            case Call(function=function, primes=primes):
                varies = function in _CIRCULAR and not self._is_constant(node)  # sin α sin θ
                return (4, varies, _RANK.get(function, function), primes, *self._parts(node))
            case PartialCall(function=function, indices=indices):
                return (4, False, function, len(indices), *indices, *self._parts(node))
            case _:
                return (3, *self._parts(node))

    def _place(self, node: Name) -> int:
        return self._index.get(node.name, len(self._index))

    def _first(self, node: Expression) -> int:
        """The place of the first of its letters."""
        return min((self._place(n) for n in walk(node) if isinstance(n, Name)), default=0)

    def _parts(self, node: Expression) -> Key:
        flat: list[object] = []
        for part in children(node):
            flat.extend(self.factor(part))
        return tuple(map(str, flat))

    def rank(self, node: Expression) -> Flat:
        """Where a factor stands in a product: brackets at rest before the velocities.

        (J + m r²) φ'²/2, m g (R + h) cos θ, m l (x' cos θ + l θ'), k (y − b) ((x − a)² + (y − b)²).
        """
        base = node.base if isinstance(node, Power) else node
        match base:
            case Call(function="sqrt", arguments=(inner,)):
                base = inner
            case Call(function="abs", arguments=(Name() as letter,)):
                return self.rank(letter)
        key = self._term(base if isinstance(base, Sum) else node)
        if isinstance(base, Sum) and not any(self._is_fast(part) for part in walk(base)):
            nested = any(isinstance(part, Sum) for term in base.terms for part in walk(term))
            key = (1, 0, _AFTER_NUMBERS, nested, self._first(base), *self._parts(base))
        elif isinstance(base, Name) and not base.primes and self._is_fast(base):
            key = (1, 1, *key[2:])
        return _flat(key)

    def arranged(self, factors: Iterable[Factor]) -> Iterator[Factor]:
        """The factors of a product, (base, exponent), as they follow each other."""
        ranked = sorted(factors, key=self._rank_of_power)
        letters = [self._place(base) for base, _ in ranked if isinstance(base, Name)]
        first = min(letters, default=_AFTER_NUMBERS)
        # (m1 + m2) g l, (2 + sqrt(2)) k, but m g (R + h) and m2 (J + m1 r²)
        numbers = [pair for pair in ranked if isinstance(pair[0], Number)]
        numbers += [pair for pair in ranked if _is_root_of_number(pair[0])]
        leading = [pair for pair in ranked if self._leads(pair[0], first)]
        yield from (*numbers, *leading)
        yield from (pair for pair in ranked if pair not in (*numbers, *leading))

    def with_letters(self, factors: Sequence[Expression]) -> list[Expression]:
        """The factors with the letters among them in their order: m g for g m."""
        bases = [factor.base if isinstance(factor, Power) else factor for factor in factors]
        places = [k for k, base in enumerate(bases) if isinstance(base, Name)]
        ranked = sorted(places, key=lambda k: self.rank(bases[k]))
        moved = {place: factors[k] for place, k in zip(places, ranked, strict=True)}
        return [moved.get(k, factor) for k, factor in enumerate(factors)]

    def _rank_of_power(self, factor: Factor) -> Flat:
        """A root behind all parameters: m1 m2 sqrt(m1 m2), alpha sqrt(D/m), but sqrt(k/m) x."""
        rank = self._powers.get(factor)
        if rank is None:
            rank = self._powers[factor] = self._key_of_power(*factor)
        return rank

    def _key_of_power(self, base: Expression, exponent: Fraction) -> Flat:
        letters = [part for part in walk(base) if isinstance(part, Name)]
        if exponent.denominator == 1 or isinstance(base, (Name, Sum)) or not letters:
            return self.rank(base)
        place = max(self._first_variable - 1, *map(self._place, letters))
        return _flat((1, max(map(self._is_fast, letters)), place, "~"))

    def _leads(self, node: Expression, first: int) -> bool:
        """Whether it is a sum of numbers, or of parameters that begins before the first letter.

        All of its terms do, where they are not letters alone.
        """
        if not isinstance(node, Sum):
            return False
        if not _has_letters(node):
            return True
        if not self._is_plain(node):
            return False
        which = any if all(map(is_letter, node.terms)) else all
        return which(self._first(term) < first for term in node.terms)

    def _is_fast(self, node: Expression) -> bool:
        """Whether it is a velocity, an acceleration, a momentum or a multiplier."""
        return isinstance(node, Name) and (
            node.primes > 0 or self._first_fast <= self._index.get(node.name, -1)
        )

    def term(self, node: Expression) -> TermKey:
        """Accelerations, a number, falling degree in the velocities, then by coordinate.

        So 1 + x², and x² + R² θ² + l²: coordinates in the order of the file, parameters alone
        at the end, single letters first, fractions and functions last: I + m a², l + m g/k,
        M + m cos θ; x'' before x' (y' x'' − x' y'').
        """
        key = self._terms.get(node)
        if key is None:
            key = self._terms[node] = self._key_of_term(node)
        return key

    def _key_of_term(self, node: Expression) -> TermKey:
        accelerations, rates, momenta = _degrees(node)
        velocities = rates + momenta
        roots = [p for p in walk(node) if isinstance(p, Call) and p.function == "sqrt"]
        inside = [p for root in roots for p in walk(root) if isinstance(p, Name)]
        velocities = velocities or any(map(is_rate, inside))
        if len(roots) == 1 and all(f in roots or self.is_parameter(f) for f in bases(node)):
            # c sqrt(p² + m² c²)
            velocities = velocities or any(p.name.startswith("p_") for p in inside)
        variables = tuple(sorted(self._variables(node))) or (len(self._index),)
        number, letters = _is_number(node), _flat(self._letters(node))
        timed = any(part == Name("t") for part in _factor_names(node))
        later = 0
        if variables == (len(self._index),):
            over = _is_over_letters(node) and self._is_constant(node)
            names = [part for part in walk(node) if isinstance(part, Name)]
            single = names and names == [*_last_letter(node)]
            later = 2 if timed or _has_function(node) else -1 if single else int(over)
        fast = velocities if accelerations else -velocities
        moving = -rates if velocities > 1 and momenta else -velocities  # s'² before s' p, before p²
        return (-accelerations, not number, fast, moving, variables, later, letters)

    def sorted(self, terms: Iterable[Expression]) -> list[Expression]:
        """The terms in their order, a polynomial in one variable by its powers."""
        return self.in_powers(self._with_letter_first(sorted(terms, key=self.term)))

    def _with_letter_first(self, terms: list[Expression]) -> list[Expression]:
        """I + m r² where the file has I before m; x² + a², k x + F."""
        if len(terms) < 2 or any(isinstance(term, Negative) for term in terms):
            return terms
        *others, last = terms
        if not is_letter(last) or not self.is_parameter(last):
            return terms
        for each in ([b for b in bases(t) if not isinstance(b, Number)] for t in others):
            if not any(map(self.is_coordinate, each)) or any(map(self._is_fast, each)):
                return terms
            if not self.is_parameter(each[0]) or self._first(last) > self._first(each[0]):
                return terms
        return [last, *others]

    def in_powers(self, terms: list[Expression]) -> list[Expression]:
        """w² + a x + b x², not a x + b x² + w²; r² + 2 a r + 2 a², not 2 a r + r² + 2 a²."""
        names = {part.name for term in terms for part in walk(term) if isinstance(part, Name)}
        moving = [x for x in names if not self.is_parameter(Name(x))]
        powers = _powers(terms, moving[0]) if len(moving) == 1 else None
        if powers is None or len(set(powers)) < max(_SEVERAL, len(terms)) or _is_monotone(powers):
            return terms
        rising = len({sum(_power(term, x) or 0 for x in names) for term in terms}) > 1
        places = sorted(range(len(terms)), key=powers.__getitem__, reverse=not rising)
        return [terms[k] for k in places]

    def _variables(self, node: Expression) -> Iterator[int]:
        """Positions of the coordinates among the factors, of those with the most primes."""
        names = list(_factor_names(node))
        most = max((part.primes for part in names), default=0)
        for part in names:
            index = self._index.get(part.name.removeprefix("p_"), -1)
            if part.primes == most and index > self._first_variable:
                yield index

    def is_parameter(self, node: Expression) -> bool:
        """Whether only numbers and names that are known to be parameters occur."""
        return "t" in self._index and all(
            part.primes == 0
            and self._index.get(part.name, self._first_variable) < self._first_variable
            for part in walk(node)
            if isinstance(part, Name)
        )

    def is_coordinate(self, node: Expression) -> bool:
        """Whether it is a coordinate."""
        place = self._index.get(node.name, -1) if isinstance(node, Name) else -1
        return self._first_variable < place < self._first_fast

    def _is_constant(self, node: Expression) -> bool:
        """Whether only parameters occur."""
        return all(
            part.primes == 0 and self._index.get(part.name, -1) < self._first_variable
            for part in walk(node)
            if isinstance(part, Name)
        )

    def _is_plain(self, node: Expression) -> bool:
        """Whether it is a sum of parameters, without functions of them."""
        return (
            isinstance(node, Sum)
            and self._is_constant(node)
            and not any(isinstance(part, (Call, PartialCall)) for part in walk(node))
        )

    def _letters(self, node: Expression) -> Key:
        """The key of a term with its numbers last: m1 + 2 m2, not 2 m2 + m1."""
        match node:
            case Negative(operand=operand):
                return self._letters(operand)
            case Product(factors=(Number(value=value), *rest)):
                return (*(k for each in rest for k in self.factor(each)), value)
            case Product(factors=(Sum() as first, *rest)) if not _has_letters(first):
                return (*(k for each in rest for k in self.factor(each)), *self.factor(first))
            case Quotient(numerator=numerator, denominator=denominator):
                return (*self._letters(numerator), *self._letters(denominator))
            case _:
                return self._term(node)

    def _term(self, node: Expression) -> Key:
        match node:
            case Negative(operand=operand):
                return self._term(operand)
            case Product(factors=factors):
                flat: list[object] = []
                for each in factors:
                    flat.extend(self.factor(each))
                return tuple(flat)
            case Quotient(numerator=numerator, denominator=denominator):
                return (*self._term(numerator), *self._term(denominator))
            case Number():
                return (9,)  # a constant term comes last
            case _:
                return self.factor(node)


def _is_over_letters(node: Expression) -> bool:
    """Whether it is a fraction with letters below."""
    inner = node.operand if isinstance(node, Negative) else node
    return isinstance(inner, Quotient) and _has_letters(inner.denominator)


def _has_letters(node: Expression) -> bool:
    return any(isinstance(part, Name) for part in walk(node))


def _is_root_of_number(node: Expression) -> bool:
    return isinstance(node, Call) and node.function == "sqrt" and not _has_letters(node)


def positive_first(terms: Sequence[Expression]) -> list[Expression]:
    """The terms with one that has no minus first; of a sum at rest all that follow it.

    x y' − y x' + c, but m2 + m3 − m1, k/m + k/M − W²; b² + 3 a b − a², not 3 a b − a² + b².
    """
    minus = [isinstance(term, Negative) for term in terms]
    if all(minus) or not minus[0]:
        return [*terms]
    rest = not any(map(_moves, terms))
    if rest and len(terms) >= _SEVERAL and not minus[-1] and _are_in_powers(terms):
        return [*terms[::-1]]
    begin = minus.index(False)
    end = begin + 1
    together = rest or all(map(is_letter, terms))
    while together and end < len(terms) and not minus[end]:
        end += 1
    return [*terms[begin:end], *terms[:begin], *terms[end:]]


def _moves(term: Expression) -> bool:
    """Whether a velocity, a momentum, a root or another function is in it."""
    return any(
        isinstance(part, (Call, PartialCall))
        or (isinstance(part, Name) and (part.primes > 0 or part.name.startswith("p_")))
        for part in walk(term)
    )


def _are_in_powers(terms: Sequence[Expression]) -> bool:
    """Whether the powers of a letter rise or fall from each term to the next."""
    names = (part.name for part in walk(terms[-1]) if isinstance(part, Name) and not part.primes)
    found = (_powers(terms, name) for name in names)
    return any(powers is not None and _is_monotone(powers) for powers in found)


def _is_monotone(powers: Sequence[int]) -> bool:
    rises, falls = (all(x < y for x, y in pairwise(p)) for p in (powers, powers[::-1]))
    return rises or falls


def _powers(terms: Sequence[Expression], name: str) -> list[int] | None:
    """The exponents of a letter in the terms; None where it stands anywhere but in powers."""
    found = [_power(term, name) for term in terms]
    return None if None in found else [power for power in found if power is not None]


def _power(term: Expression, name: str) -> int | None:
    match term:
        case Name(name=other):
            return int(name == other and not term.primes)
        case Number():
            return 0
        case Negative(operand=inner):
            return _power(inner, name)
        case Quotient(numerator=above, denominator=Number()):
            return _power(above, name)
        case Power(base=Name() as base, exponent=Number(value=value)) if value.denominator == 1:
            within = _power(base, name)
            return None if within is None else within * value.numerator
        case Product(factors=factors):
            powers = [_power(factor, name) for factor in factors]
            return None if None in powers else sum(p for p in powers if p is not None)
        case _:
            return None


def negative_of(node: Sum) -> Sum:
    """The sum of the terms with their signs changed, a positive one first where there is one."""
    return Sum(tuple(positive_first([*map(opposite, node.terms)])))


def bases(term: Expression) -> Iterator[Expression]:
    """What is multiplied, or raised to a power and multiplied, above the denominator of a term."""
    match term:
        case Negative(operand=inner) | Quotient(numerator=inner) | Power(base=inner):
            yield from bases(inner)
        case Product(factors=factors):
            for factor in factors:
                yield from bases(factor)
        case _:
            yield term


def is_rate(node: Expression, order: int = 1) -> bool:
    """Whether it is a derivative by the time, of this order at least."""
    return isinstance(node, Name) and node.primes >= order


def has_rate(node: Expression) -> bool:
    """Whether there is a velocity or an acceleration in it."""
    return any(map(is_rate, walk(node)))


def accelerates(node: Expression) -> bool:
    """Whether there is an acceleration in it."""
    return any(is_rate(part, 2) for part in walk(node))


def is_letter(node: Expression) -> bool:
    """Whether a term is a letter, perhaps with a number before it."""
    match node:
        case Negative(operand=inner) | Product(factors=(Number(), inner)):
            return is_letter(inner)
        case _:
            return isinstance(node, Name)


def _last_letter(term: Expression) -> Iterator[Name]:
    """The k of (2 + √2) k or k/2; nothing of k²."""
    match term:
        case Negative(operand=inner) | Quotient(numerator=inner, denominator=Number()):
            yield from _last_letter(inner)
        case Product(factors=(*_, Name() as letter)) | (Name() as letter):
            yield letter


def _has_function(node: Expression) -> bool:
    """Whether a function is among the factors of a term."""
    found = (f for f in bases(node) if isinstance(f, (Call, PartialCall)))
    return any(each.function != "sqrt" for each in found)


def _is_number(node: Expression) -> bool:
    match node:
        case Negative(operand=inner):
            return _is_number(inner)
        case Quotient(numerator=above, denominator=below):
            return isinstance(above, Number) and isinstance(below, Number)
        case _:
            return isinstance(node, Number)


def _factor_names(node: Expression) -> Iterator[Name]:
    """The names that are factors, or bases of factors, of a term."""
    match node:
        case Name():
            yield node
        case Power(base=Sum(terms=terms)):  # (x + a)² + y²
            for term in terms:
                yield from _factor_names(term)
        case Sum(terms=terms):  # m (x'² + y'²)
            for part in (name for term in terms for name in _factor_names(term)):
                if part.primes or part.name.startswith("p_"):
                    yield part
        case Negative(operand=inner) | Quotient(numerator=inner) | Power(base=inner):
            yield from _factor_names(inner)
        case Product(factors=factors):
            for factor in factors:
                yield from _factor_names(factor)


def _flat(key: Key) -> Flat:
    """A key whose entries of different types can be compared."""
    return tuple(
        (0, entry, "") if isinstance(entry, (int, Fraction)) else (1, 0, str(entry))
        for entry in key
    )


def _degrees(node: Expression) -> tuple[int, int, int]:
    """The degrees of a term in accelerations, in velocities and in momenta."""
    match node:
        case Name(name=name, primes=primes):
            return int(primes > 1), int(primes == 1), int(name.startswith("p_"))
        case Negative(operand=inner) | Quotient(numerator=inner):
            return _degrees(inner)
        case Product(factors=factors):
            return _over(sum, map(_degrees, factors))
        case Power(base=base, exponent=Number(value=value)):
            return _over(sum, [tuple(int(d * value) for d in _degrees(base))])
        case Sum(terms=terms):
            return _over(max, map(_degrees, terms))
        case _:
            return 0, 0, 0


def _over(
    of: Callable[[Iterable[int]], int], degrees: Iterable[tuple[int, ...]]
) -> tuple[int, int, int]:
    a, v, p = map(of, zip(*degrees, strict=True))
    return a, v, p
