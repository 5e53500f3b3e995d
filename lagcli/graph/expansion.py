"""Formulas multiplied out, where they become shorter by that.

Points of a rigid link make M = m l² (cos² + sin²): constant, as no product of its factors shows.
Those of two links make m l1 l2 (cos a cos b + sin a sin b), which is m l1 l2 cos(a - b).
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

from lagcli.graph.nodes import Call, Constant, Graph, Node, Product, Sum, ancestry

#: base -> exponent, as a set
Monomial = frozenset[tuple[Node, Fraction]]
Polynomial = dict[Monomial, Fraction]

_ONE: Monomial = frozenset()
_LINEAR = Fraction(1)
_UNIT: Polynomial = {_ONE: Fraction(1)}
#: A longer one stays as it is: no pair of its terms is met by chance.
_TERMS = 60


class TooLong(Exception):
    """Written out, a formula has more terms or products than pay."""


class Expansion:
    """Multiplies out formulas of one graph."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    def __call__(self, node: Node) -> Node:
        """The shorter of the node and of what it is when multiplied out."""
        try:
            found = self._collected(self._polynomial(node))
        except TooLong:
            return node
        return min(node, found, key=lambda each: len(ancestry([each])))

    def _polynomial(self, node: Node) -> Polynomial:
        match node:
            case Constant():
                return {_ONE: node.value}
            case Sum():
                return self._sum(node)
            case Product():
                found = _UNIT
                for base, exponent in node.factors:
                    whole = exponent.denominator == 1 and exponent > 0
                    if whole and isinstance(base, Sum | Product):
                        for _ in range(int(exponent)):
                            found = _product(found, self._polynomial(base))
                    else:
                        found = _product(found, _power(base, exponent))
                return found
        return _power(node, Fraction(1))

    def _sum(self, node: Sum) -> Polynomial:
        found: Polynomial = {_ONE: node.constant}
        for term, number in node.terms:
            for monomial, factor in self._polynomial(term).items():
                found[monomial] = found.get(monomial, 0) + number * factor
        return found

    def _collected(self, polynomial: Polynomial) -> Node:
        """As a sum, without even powers of cosines."""
        found: Polynomial = {}
        for monomial, number in polynomial.items():
            for other, factor in self._in_sines(monomial).items():
                found[other] = found.get(other, 0) + number * factor
        graph, joined = self.graph, self._in_differences(found)
        return graph.combination((graph.monomial(m), c) for m, c in joined.items())

    def _in_sines(self, monomial: Monomial) -> Polynomial:
        found = _UNIT
        for base, exponent in monomial:
            if isinstance(base, Call) and base.function == "cos" and exponent >= 2:
                sine = self.graph.call("sin", base.arguments)
                for _ in range(int(exponent // 2)):
                    found = _product(found, {_ONE: Fraction(1), **_power(sine, Fraction(2), -1)})
                exponent %= 2
            found = _product(found, _power(base, exponent) if exponent else _UNIT)
        return found

    def _in_differences(self, polynomial: Polynomial) -> Polynomial:
        """cos a cos b ± sin a sin b = cos(a ∓ b), sin a cos b ± cos a sin b = sin(a ± b)."""
        graph, found = self.graph, dict(polynomial)
        for monomial in polynomial:
            for one, other in combinations(_turns(monomial), 2):
                if other.function == "sin":
                    continue  # these are met with their cosines
                rest = monomial - {(one, _LINEAR), (other, _LINEAR)}
                partner = rest | {(self._quarter(x), _LINEAR) for x in (one, other)}
                number, second = found.get(monomial), found.get(partner)
                if partner == monomial or not number or not second or abs(second) != abs(number):
                    continue
                del found[monomial], found[partner]
                sign = second / number if one.function == "sin" else -second / number
                (a,), (b,) = one.arguments, other.arguments
                angle = graph.combination(((a, _LINEAR), (b, sign)))
                turned = self._polynomial(graph.call(one.function, (angle,)))
                for each, factor in _product({rest: number}, turned).items():
                    found[each] = found.get(each, Fraction(0)) + factor
                break
        return found

    def _quarter(self, call: Call) -> Node:
        """The cosine of a sine's angle, or the sine of a cosine's."""
        return self.graph.call("cos" if call.function == "sin" else "sin", call.arguments)


def _turns(monomial: Monomial) -> list[Call]:
    """The sines and cosines among the factors, the sines first."""
    found = [base for base, exponent in monomial if exponent == _LINEAR and isinstance(base, Call)]
    found = [each for each in found if each.function in {"sin", "cos"}]
    return sorted(found, key=lambda each: (each.function == "cos", each.index))


def _power(base: Node, exponent: Fraction, factor: int = 1) -> Polynomial:
    return {frozenset({(base, exponent)}): Fraction(factor)}


def _product(left: Polynomial, right: Polynomial) -> Polynomial:
    if len(left) * len(right) > _TERMS:
        raise TooLong
    found: Polynomial = {}
    for a, x in left.items():
        for b, y in right.items():
            monomial = _joined(dict(a), b)
            found[monomial] = found.get(monomial, 0) + x * y
    return found


def _joined(exponents: dict[Node, Fraction], others: Monomial) -> Monomial:
    for base, exponent in others:
        exponents[base] = exponents.get(base, Fraction(0)) + exponent
    return frozenset(pair for pair in exponents.items() if pair[1])
