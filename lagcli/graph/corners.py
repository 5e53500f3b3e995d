"""What has a corner or a jump, by `abs` and `sign`, whose changes a motion stops at.

    (u^2)^(k/2) = |u|^k = u^k, or u^k sign(u) for odd k: u/|u| = sign(u)
    atan2(y, x) = 2 sign(x) atan(y/(r + |x|)) + (1 - sign(x)) sign(y) pi/2,    r^2 = x^2 + y^2
    sqrt(a - a cos u) = sqrt(2 a) |sin(u/2)|,    sqrt(1 - sin^2 u) = |cos u|,    and so on
    asin(s) = 2 atan(s/(1 + sqrt(1 - s^2))),    1 - sin^2n u = cos^2 u (1 + ... + sin^(2n - 2) u)
    atan(tan u) = sign(cos u) asin(sin u)

On each side of x = 0, y = 0 and cos u = 0 all are smooth; the phases are those of the half angle.

References
----------
NIST Digital Library of Mathematical Functions, 4.23(iv) (the phase by the arctangent).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, ancestry, factors_of, split
from lagcli.graph.rewriting import rewritten
from lagcli.graph.stable import Stable

_HALF = Fraction(1, 2)


def with_corners(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same formulas with their corners and jumps as such."""
    if not any(_corner(graph, node) is not node for node in ancestry(roots)):
        return list(roots)
    return rewritten(graph, roots, _corner)


def _corner(graph: Graph, node: Node) -> Node:
    match node:
        case Product() if (parts := _without_poles(graph, node)) is not None:
            return _corner(graph, graph.monomial(parts))
        case Product(factors=factors) if any(e.denominator == 2 for _, e in factors):
            found = [_absolute(graph, *pair) for pair in factors]
            if all(part is None for part in found):
                return node
            pairs = [
                each for part, pair in zip(found, factors, strict=True) for each in (part or [pair])
            ]
            return graph.monomial(_halved(graph, pairs))
        case Call(function="atan2", arguments=(y, x), indices=()):
            return _phase(graph, y, x)
        case Call(function="asin", arguments=(argument,)):
            match factors_of(argument):
                case ((Call(function="sin" | "cos") as sine, n),) if n.denominator == 1 and n > 0:
                    return _folded(graph, sine, int(n))
        case Call(function="acos", arguments=(x,)):
            complement = graph.call("asin", (x,))
            [angle] = rewritten(graph, [complement], _corner)
            quarter = graph.scaled(graph.symbol("pi"), _HALF)
            return node if angle is complement else graph.difference(quarter, angle)
        case Call(function="atan", arguments=(Call(function="tan", arguments=(u,)),)):
            side = graph.call("sign", (graph.call("cos", (u,)),))
            return graph.product(side, _folded(graph, graph.call("sin", (u,))))
    return node


def _folded(graph: Graph, sine: Node, n: int = 1) -> Node:
    """asin(sin^n u) and asin(cos^n u), waves of triangles for n = 1."""
    assert isinstance(sine, Call)
    other = graph.call("cos" if sine.function == "sin" else "sin", sine.arguments)
    squares = graph.sum(graph.monomial([(sine, Fraction(2 * j))]) for j in range(n))
    root = graph.monomial([(graph.call("abs", (other,)), Fraction(1)), (squares, _HALF)])
    power = graph.monomial([(sine, Fraction(n))])
    below = graph.sum([graph.one, root])
    return graph.scaled(graph.call("atan", (graph.quotient(power, below),)), 2)


def _absolute(graph: Graph, base: Node, exponent: Fraction) -> list[tuple[Node, Fraction]] | None:
    """The factors of (c u^2 w^4 ...)^(k/2), with |u|^k for u^2; None without a square."""
    if exponent.denominator != 2:
        return None
    number, square = split(Stable(graph)(base) if isinstance(base, Sum) else base)
    factors = factors_of(square)
    even = {u for u, e in factors if e.denominator == 1 and e % 2 == 0}
    is_square = len(even) == len(factors)
    if isinstance(base, Sum):  # in (c - v)(c + v)/c^2 the sign of c is no corner
        is_square = any(isinstance(u, Call) for u in even)
    if number < 0 or not is_square:
        return None
    found = [(graph.constant(number), exponent)]
    for u, power in factors:
        found += _power(graph, u, power * exponent) if u in even else [(u, power * exponent)]
    return found


def _without_poles(graph: Graph, node: Product) -> list[tuple[Node, Fraction]] | None:
    """The factors with u^k sign(u) for |u|^k where u divides it, or it divides u; else None."""
    factors = [*_leaves(node, Fraction(1))]
    found, changed = [], False
    for base, exponent in factors:
        u = base.arguments[0] if isinstance(base, Call) and base.function == "abs" else None
        own = {each for each, _ in _leaves(split(u)[1], exponent)} if u else {}
        is_pole = any(each in own and power * exponent < 0 for each, power in factors)
        if u and is_pole and exponent.denominator == 1:
            found += _power(graph, u, exponent)
            changed = True
        else:
            found.append((base, exponent))
    return found if changed else None


def _leaves(node: Node, exponent: Fraction) -> Iterator[tuple[Node, Fraction]]:
    """The factors of a product and of the products in it."""
    if isinstance(node, Product) and exponent.denominator == 1:  # (u^2)^(1/2) is not u
        for base, power in node.factors:
            yield from _leaves(base, power * exponent)
    else:
        yield node, exponent


def _power(graph: Graph, u: Node, exponent: Fraction) -> list[tuple[Node, Fraction]]:
    """|u|^k, which is sign(u) u^k for odd k: u sign(u)/u has no pole left."""
    side = [] if exponent % 2 == 0 else [(graph.call("sign", (u,)), Fraction(1))]
    return [(u, exponent), *side]


def _halved(graph: Graph, pairs: list[tuple[Node, Fraction]]) -> Iterator[tuple[Node, Fraction]]:
    """With sin u = 2 sin(u/2) cos(u/2), and sinh u, where a half one divides: no pole is left."""
    divisors = {base for base, exponent in pairs if exponent < 0}
    for base, exponent in pairs:
        match base:
            case Call(function="sin" | "sinh" as name, arguments=(u,)) if exponent > 0:
                half = (graph.scaled(u, _HALF),)
                parts = [graph.call(each, half) for each in (name, name.replace("sin", "cos"))]
                if divisors & {*parts}:
                    yield graph.constant(2), exponent
                    yield from ((part, exponent) for part in parts)
                    continue
        yield base, exponent


def _phase(graph: Graph, y: Node, x: Node) -> Node:
    size = graph.call("abs", (x,))
    side, above = graph.call("sign", (x,)), graph.call("sign", (y,))
    squares = graph.sum([graph.product(x, x), graph.product(y, y)])
    radius = graph.monomial(((squares, _HALF),))
    half = graph.call("atan", (graph.quotient(y, graph.sum([radius, size])),))
    back = graph.product(graph.difference(graph.one, side), above, graph.symbol("pi"))
    return graph.sum([graph.scaled(graph.product(side, half), 2), graph.scaled(back, _HALF)])
