"""Logarithms of ratios, which the algebra has as differences: ln(b/a) for ln b − ln a."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import combinations

from lagcli.expression import Call, Expression, Negative, Quotient, Sum, quotient_of, sum_of, walk
from lagcli.notation.factors import parts_of

#: Numerator and denominator.
Ratio = tuple[Expression, Expression]


def ratios_in(formulas: Iterable[Expression]) -> frozenset[Ratio]:
    """The ratios of which formulas have the logarithm."""
    found: set[Ratio] = set()
    for part in (part for node in formulas for part in walk(node)):
        match part:
            case Call(function="log", arguments=(Quotient(numerator=above, denominator=below),)):
                found.add((above, below))
    return frozenset(found)


def with_ratios(node: Sum, known: Collection[Ratio]) -> Expression:
    """c ln(b/a) for c ln b − c ln a, which way round the ratio is known."""
    for one, other in combinations(node.terms, 2):
        (less, a, rest), (minus, b, beside) = map(_parted, (one, other))
        if a is None or b is None or rest != beside or less == minus:
            continue
        above, below = (b, a) if less else (a, b)
        turned = (below, above) in known
        ratio = Quotient(below, above) if turned else Quotient(above, below)
        factors, under = rest
        whole = quotient_of([*factors, Call("log", (ratio,))], list(under))
        joined = Negative(whole) if turned else whole
        terms = (joined if t is one else t for t in node.terms if t is not other)
        left = sum_of(terms)
        return with_ratios(left, known) if isinstance(left, Sum) else left
    return node


def _parted(
    term: Expression,
) -> tuple[bool, Expression | None, tuple[tuple[Expression, ...], tuple[Expression, ...]]]:
    """The sign, the argument of the one logarithm, and the other factors above and below."""
    minus, above, below = parts_of(term)
    logs = [f for f in above if isinstance(f, Call) and f.function == "log" and not f.primes]
    others = tuple(f for f in above if f not in logs)
    return minus, logs[0].arguments[0] if len(logs) == 1 else None, (others, tuple(below))
