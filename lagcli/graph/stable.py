"""Differences that lose digits in floating point, written so that they do not.

    1 - cos x = 2 sin^2(x/2)            1 + cos x = 2 cos^2(x/2)
    cosh x - 1 = 2 sinh^2(x/2)          exp x - 1 = 2 exp(x/2) sinh(x/2)
    sqrt(1 + z) - 1 = z/(1 + sqrt(1 + z))
    1/sqrt(1 + z) - 1 = -z/(sqrt(1 + z) + 1 + z)
    1 - cos^2 x = sin^2 x               1 - sin^2 x = cos^2 x
    cosh^2 x - 1 = sinh^2 x
    cos x - cos y = -2 sin((x + y)/2) sin((x - y)/2)
    sin x - sin y = 2 cos((x + y)/2) sin((x - y)/2)
    1 - v^2/c^2 = (c - v)(c + v)/c^2

also with a common factor and beside other terms, as in m g l - m g l cos x + T; the last
one alone.

References
----------
Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., section 1.7.
Goldberg, "What every computer scientist should know about floating-point arithmetic",
ACM Computing Surveys 23 (1991), section 1.4.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import isqrt

from lagcli.graph.bounded import bounded
from lagcli.graph.nodes import (
    Call,
    Constant,
    Graph,
    Node,
    Product,
    Sum,
    Symbol,
    ancestry,
    factors_of,
)

_NONE, _UNIT, _HALF, _TWO = Fraction(0), Fraction(1), Fraction(1, 2), Fraction(2)

_FUNCTION = 10
_LONG = 300  # nodes

#: f^2 - 1 = -g^2, or g^2 for cosh.
_OTHER = {"cos": "sin", "sin": "cos", "cosh": "sinh"}


class Stable:
    """Nodes in a form that keeps its digits, each rewritten once."""

    def __init__(self, graph: Graph, kept: frozenset[str] = frozenset()) -> None:
        """Calls of the functions `kept` stay as they are, with what stands in them."""
        self.graph, self._kept = graph, kept
        self._known: dict[Node, Node] = {}

    def __call__(self, root: Node) -> Node:
        """The node, equal as mathematics."""
        known = self._known
        if root not in known:
            for node in ancestry([root]):
                if node not in known:
                    known[node] = self._rebuilt(node)
        return known[root]

    def _rebuilt(self, node: Node) -> Node:
        match node:
            case Sum():
                return self._sum(node)
            case Call(function=name) if name in self._kept:
                return node
            case _:
                return self.graph.rebuilt(node, self._known)

    def _sum(self, node: Sum) -> Node:
        graph, known = self.graph, self._known
        terms = dict(node.terms)
        if node.constant:
            terms[graph.one] = node.constant
        squares = self._squares(terms)
        if squares is not None:
            return squares
        done: list[tuple[Node, Fraction]] = []
        self._join_angles(terms, done)
        for term in list(terms):
            for function, rest in _splits(graph, term):
                # c A f and d A with d = -c or c: c A (f - 1) or c A (f + 1)
                if term not in terms or abs(terms.get(rest, 0)) != abs(terms[term]):
                    continue
                coefficient, other = terms[term], terms[rest]
                joined = self._joined(function, other == -coefficient)
                if joined is not None:
                    del terms[term], terms[rest]
                    done.append((graph.product(known.get(rest, rest), joined), coefficient))
        done += [(known.get(term, term), c) for term, c in terms.items()]
        return graph.combination(done)

    def _joined(self, node: Node, minus: bool) -> Node | None:
        """f - 1 or f + 1 without cancellation; None where there is no rule."""
        graph = self.graph
        match node:
            case Call(function="cos" | "cosh" as function, arguments=(x,)):
                half = graph.scaled(self._known[x], _HALF)
                odd = "sin" if function == "cos" else "sinh"
                inner = graph.call(odd if minus else function, (half,))
                sign = -1 if minus and function == "cos" else 1
                return graph.scaled(graph.monomial([(inner, _TWO)]), 2 * sign)
            case Call(function="exp", arguments=(x,)) if minus:
                half = graph.scaled(self._known[x], _HALF)
                return graph.scaled(
                    graph.product(graph.call("exp", (half,)), graph.call("sinh", (half,))), 2
                )
            case Product(
                factors=((Call(function="cos" | "sin" | "cosh" as name, arguments=(x,)), two),)
            ):
                if two != _TWO or not minus:
                    return None
                square = graph.monomial([(graph.call(_OTHER[name], (self._known[x],)), _TWO)])
                return graph.scaled(square, 1 if name == "cosh" else -1)
            case Product(factors=((Sum(constant=one) as base, exponent),)) if (
                minus and one == 1 and abs(exponent) == _HALF
            ):
                whole = self._known[base]
                small = self(graph.combination(base.terms))
                root = graph.monomial([(whole, _HALF)])
                if exponent > 0:
                    return graph.quotient(small, graph.sum([graph.one, root]))
                return graph.scaled(graph.quotient(small, graph.sum([root, whole])), -1)
        return None

    def _join_angles(self, terms: dict[Node, Fraction], done: list[tuple[Node, Fraction]]) -> None:
        """Take c A cos x and -c A cos y out of the terms, and put in what they are together."""
        graph = self.graph
        seen: dict[tuple[str, Node, Fraction], tuple[Node, Node]] = {}
        for term, coefficient in list(terms.items()):
            for function, rest in _splits(graph, term):
                match function:
                    case Call(function="cos" | "sin" as name, arguments=(x,)):
                        partner = seen.get((name, rest, -coefficient))
                        if term not in terms or partner is None or partner[0] not in terms:
                            seen.setdefault((name, rest, coefficient), (term, x))
                            continue
                        other, y = partner
                        done.append((self._difference(name, y, x, rest), -coefficient))
                        del terms[term], terms[other]
                    case _:
                        pass

    def _difference(self, function: str, x: Node, y: Node, rest: Node) -> Node:
        """(f(x) - f(y)) times the rest."""
        graph = self.graph
        inner = [
            self(graph.combination([*_terms(graph, x, _HALF), *_terms(graph, y, sign * _HALF)]))
            for sign in (1, -1)
        ]
        first = graph.call("sin" if function == "cos" else "cos", (inner[0],))
        whole = graph.product(self._known.get(rest, rest), first, graph.call("sin", (inner[1],)))
        return graph.scaled(whole, -2 if function == "cos" else 2)

    def _squares(self, terms: dict[Node, Fraction]) -> Node | None:
        """k (a x)^2 - k (b y)^2 of two names, or of one and 1, by its factors; None for others."""
        if len(terms) != 2:
            return None
        graph = self.graph
        (first, p), (second, q) = terms.items()
        roots = [_square_root(node) for node in (first, second)]
        ratio = _rational_root(-q / p)
        if None in roots or ratio is None:
            return None
        one, two = (dict(root or {}) for root in roots)
        bases = [*one, *(base for base in two if base not in one)]
        common = [(base, min(one.get(base, _NONE), two.get(base, _NONE))) for base in bases]
        left, right = (
            [(base, e) for base, least in common if (e := root.get(base, _NONE) - least)]
            for root in (one, two)
        )
        if not all(map(_is_a_name, (left, right))) or not (left or right):
            return None
        x, y = graph.monomial(left), graph.scaled(graph.monomial(right), ratio)
        apart = graph.difference(x, y) if p > 0 else graph.difference(y, x)
        factors = [(apart, _UNIT), (graph.sum([x, y]), _UNIT)]
        factors += [(self._known[base], 2 * e) for base, e in common if e]
        return graph.scaled(graph.monomial(factors), abs(p))


def stable_dynamics(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """Equations of motion in stable form, where that is no longer than the plain one.

    What stands in abs and sign, the kinks of the motion, is left alone, and so are long
    equations, where to look for it costs more than a twentieth of a run.
    """
    roots = bounded(graph, roots)
    if len(ancestry(roots)) > _LONG:
        return list(roots)
    stable = Stable(graph, kept=frozenset({"abs", "sign"}))
    found = [stable(root) for root in roots]
    return found if _length(found) <= _length(roots) else list(roots)


def _length(roots: Sequence[Node]) -> int:
    """The operations; a function is as long as some ten of them."""
    total = 0
    for node in ancestry(roots):
        match node:
            case Sum(terms=terms):
                total += len(terms)
            case Product(factors=factors):
                total += sum(1 if e.denominator == 1 else _FUNCTION for _, e in factors)
            case Call():
                total += _FUNCTION
    return total


def _terms(graph: Graph, node: Node, factor: Fraction) -> list[tuple[Node, Fraction]]:
    """The terms of a multiple, so that equal ones meet."""
    if isinstance(node, Sum):
        terms = [(term, factor * c) for term, c in node.terms]
        return [*terms, (graph.one, factor * node.constant)]
    return [(node, factor)]


def _square_root(node: Node) -> list[tuple[Node, Fraction]] | None:
    """The factors of the root of a monomial with even exponents."""
    factors = () if isinstance(node, Constant) else factors_of(node)
    if any(exponent % 2 for _, exponent in factors):
        return None
    return [(base, exponent / 2) for base, exponent in factors]


def _rational_root(value: Fraction) -> Fraction | None:
    if value <= 0:
        return None
    root = Fraction(isqrt(value.numerator), isqrt(value.denominator))
    return root if root * root == value else None


def _is_a_name(factors: list[tuple[Node, Fraction]]) -> bool:
    """Nothing, or one name: its value is no rounded product."""
    return not factors or (
        len(factors) == 1 and isinstance(factors[0][0], Symbol) and factors[0][1] == 1
    )


def _splits(graph: Graph, term: Node) -> Iterator[tuple[Node, Node]]:
    """Each way to write a term as f times the rest, f a function or a root."""
    factors = factors_of(term)
    for place, (base, exponent) in enumerate(factors):
        if not (isinstance(base, Call) or abs(exponent) == _HALF):
            continue
        rest = graph.monomial([*factors[:place], *factors[place + 1 :]])
        yield graph.monomial([(base, exponent)]), rest
