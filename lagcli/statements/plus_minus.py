"""Mirror images and pairs of roots once: x = ±a, y = ∓b, and (a ± sqrt(b))/c."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Protocol, TypeVar

from lagcli.expression import (
    ZERO,
    Call,
    Expression,
    Negative,
    PlusMinus,
    Power,
    Product,
    Quotient,
    Sum,
    children,
    walk,
)
from lagcli.notation.likeness import signed_key
from lagcli.notation.ordering import negative_of
from lagcli.record import replace
from lagcli.rewriting import rebuilt
from lagcli.statements.answers import ModesOfFrequency
from lagcli.statements.motions import SteadyMotion

Rest = TypeVar("Rest")
Value = TypeVar("Value")
State = Mapping[str, Expression]


class _At(Protocol):
    @property
    def at(self) -> State: ...


Item = TypeVar("Item", bound=_At)


def put_together(
    items: Iterable[Value], both: Callable[[Value, Value], Value | None]
) -> list[Value]:
    """The items, each as one with the first before it with which `both` makes one."""
    found: list[Value] = []
    for item in items:
        for place, other in enumerate(found):
            if (one := both(other, item)) is not None:
                found[place] = one
                break
        else:
            found.append(item)
    return found


def pairs(states: Iterable[tuple[State, Rest]]) -> list[tuple[State, Rest]]:
    """The states, those that differ in a sign and have the same rest as one."""
    return put_together(states, _one_state)


def _one_state(one: tuple[State, Rest], other: tuple[State, Rest]) -> tuple[State, Rest] | None:
    (at, rest), (there, its_rest) = one, other
    if its_rest != rest or list(there) != list(at):
        return None
    both = joined(tuple(at.values()), tuple(there.values()))
    return None if both is None else (dict(zip(at, both, strict=True)), rest)


def once(items: Iterable[Item]) -> list[Item]:
    """The items, those that differ in the sign of what they are `at` as one."""
    found = pairs((item.at, replace(item, at={})) for item in items)
    return [replace(item, at=at) for at, item in found]


def single(values: Iterable[Expression]) -> list[Expression]:
    """The values, two that differ in a sign as one."""
    return [at["x"] for at, _ in pairs(({"x": value}, None) for value in values)]


def unlike(values: Iterable[Expression]) -> list[Expression]:
    """The values that vanish together, of opposite ones the first."""
    found: dict[object, Expression] = {}
    for value in values:
        found.setdefault(signed_key(value)[1], value)
    return [value for value in found.values() if value != ZERO]


def is_pair(at: State) -> bool:
    """Whether two states are shown as one."""
    return any(map(_has_both, at.values()))


def _has_both(node: Expression) -> bool:
    return any(isinstance(part, PlusMinus) for part in walk(node))


def steady_in_pairs(motions: Iterable[SteadyMotion]) -> list[SteadyMotion]:
    """The steady motions, two that differ in the sign of a root as one with ±."""
    return put_together(motions, _one_motion)


def _one_motion(one: SteadyMotion, other: SteadyMotion) -> SteadyMotion | None:
    named = [(m.at, m.rates or {}, m.momenta) for m in (one, other)]
    like = {"at": one.at, "rates": one.rates, "momenta": one.momenta}
    if replace(other, **like) != one or [*map(list, named[0])] != [*map(list, named[1])]:
        return None
    rows = [[value for part in parts for value in part.values()] for parts in named]
    both = joined(*rows)
    if both is None:
        return None
    values = iter(both)
    at, rates, momenta = ({name: next(values) for name in part} for part in named[0])
    return replace(one, at=at, rates=rates if one.rates is not None else None, momenta=momenta)


def mirror_images(motions: Iterable[SteadyMotion]) -> list[list[SteadyMotion]]:
    """The motions, those together that differ in their place alone, or in the sign of C, too.

    Those with the C of the first come first.
    """
    groups: dict[object, list[SteadyMotion]] = {}
    for number, motion in enumerate(motions):
        rest, entries = replace(motion, at={}, velocity=()), _turning(motion)
        lead = next((sign for sign, _ in entries if sign), 1)
        like = (repr(rest), tuple(motion.at), tuple((s * lead, repr(key)) for s, key in entries))
        groups.setdefault(number if motion.rolling else like, []).append(motion)
    return [
        sorted(group, key=lambda each, first=group[0]: not turns_alike(each, first))  # type: ignore[misc]
        for group in groups.values()
    ]


def _turning(motion: SteadyMotion) -> list[tuple[int, object]]:
    """The signs of the entries of C, and what they are up to it."""
    entries = [x for row in motion.velocity for x in row]
    return [(0, None) if x == ZERO else signed_key(x) for x in entries]


def turns_alike(one: SteadyMotion, other: SteadyMotion) -> bool:
    """Whether C is the same at both, and not of opposite signs."""
    return _turning(one) == _turning(other)


def modes_in_pairs(modes: Iterable[ModesOfFrequency]) -> list[ModesOfFrequency]:
    """The modes about one equilibrium, two that differ in the sign of a root as one with ±."""
    return put_together(modes, _one_mode)


def _one_mode(one: ModesOfFrequency, other: ModesOfFrequency) -> ModesOfFrequency | None:
    root = "frequency_squared" if one.frequency is None else "frequency"
    rates = [each.decay for each in (one, other)]
    open_sign = one.open_sign or other.open_sign
    names = ("frequency", "frequency_squared", "shape", "decay", "open_sign")
    like = {name: getattr(one, name) for name in names}
    roots, shapes = (getattr(one, root), getattr(other, root)), (one.shape or {}, other.shape or {})
    if replace(other, **like) != one or None in roots or list(shapes[0]) != list(shapes[1]):
        return None
    if (None in rates) != (rates == [None, None]):
        return None
    first, second = (
        (value, *([rate] if rate else []), *shape.values())
        for value, rate, shape in zip(roots, rates, shapes, strict=True)
    )
    both = joined(first, second)
    if both is None:
        return None
    decay = both.pop(1) if one.decay is not None else None
    shape = one.shape and dict(zip(one.shape, both[1:], strict=True))
    return replace(one, **{root: both[0]}, shape=shape, decay=decay, open_sign=open_sign)


def joined(one: Sequence[Expression], other: Sequence[Expression]) -> list[Expression] | None:
    """Both rows of formulas as one; None where they differ in more than one sign each."""
    if any(map(_has_both, one)) or one == other:
        return None
    both = [_both(a, b) for a, b in zip(one, other, strict=True)]
    whole = [each for each in both if each is not None]
    if len(whole) < len(both):
        return None
    first = next(p for node in whole for p in walk(node) if isinstance(p, PlusMinus))
    return [_turned(node) for node in whole] if first.minus_above else whole


def _both(a: Expression, b: Expression) -> Expression | None:
    """One formula for two that differ in a sign; a's sign is the upper one."""
    if a == b:
        return a
    (sign, key), (its_sign, its_key) = signed_key(a), signed_key(b)
    if key == its_key and sign == -its_sign:
        minus = isinstance(a, Negative)
        return PlusMinus(b if minus else a, minus_above=minus)
    if key == its_key:
        return a
    match a, b:
        case (Negative(), _) | (_, Negative()) if not (_inward(a) is a and _inward(b) is b):
            return _both(_inward(a), _inward(b))
        case Sum(terms=one), Sum(terms=other) if len(one) == len(other):
            return _sum(one, other)
        case (Product() | Quotient() | Power() | Negative() | Call(), _) if _alike(a, b):
            parts = [_both(x, y) for x, y in zip(children(a), children(b), strict=True)]
            different = iter(parts)
            return None if None in parts else rebuilt(a, lambda _: next(different) or a)
        case _:
            return None


def _inward(node: Expression) -> Expression:
    """(b − a) g/c for −(a − b) g/c; the node where no bracket takes its sign."""
    match node:
        case Negative(operand=Sum() as inner):
            return negative_of(inner)
        case Negative(operand=Quotient(numerator=above, denominator=below)):
            turned = _inward(Negative(above))
            return node if isinstance(turned, Negative) else Quotient(turned, below)
        case Negative(operand=Product(factors=(*first, Sum() as last))):
            return Product((*first, _inward(Negative(last))))
        case _:
            return node


def _alike(a: Expression, b: Expression) -> bool:
    same = type(a) is type(b) and len(children(a)) == len(children(b))
    return same and getattr(a, "function", "") == getattr(b, "function", "")


def _sum(one: Sequence[Expression], other: Sequence[Expression]) -> Expression | None:
    """a + b and a - b, in whatever order the terms stand."""
    keys, its_keys = set(map(signed_key, one)), set(map(signed_key, other))
    left = [term for term in other if signed_key(term) not in keys]
    differ = [place for place, term in enumerate(one) if signed_key(term) not in its_keys]
    if not differ or len(left) != len(differ):
        return None
    terms = list(one)
    for place, its in zip(differ, left, strict=True):
        both = _both(one[place], its)
        if both is None:
            return None
        terms[place] = both
    if isinstance(terms[0], PlusMinus) and len(differ) == 1:
        terms[:2] = terms[1::-1]
    return Sum(tuple(terms))


def _turned(node: Expression) -> Expression:
    if isinstance(node, PlusMinus):
        return PlusMinus(node.operand, minus_above=not node.minus_above)
    return rebuilt(node, _turned)
