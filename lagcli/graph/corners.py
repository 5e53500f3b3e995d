"""What has a corner or a jump, by `abs` and `sign`, whose changes a motion stops at.

    (u^2)^(k/2) = |u|^k = u^k, or u^k sign(u) for odd k
    atan2(y, x) = 2 sign(x) atan(y/(r + |x|)) + (1 - sign(x)) sign(y) pi/2,    r^2 = x^2 + y^2
    asin(sin u) = 2 atan(sin u/(1 + |cos u|)),    atan(tan u) = sign(cos u) asin(sin u)

On each side of x = 0, y = 0 and cos u = 0 all are smooth; the phases are those of the half angle.

References
----------
NIST Digital Library of Mathematical Functions, 4.23(iv) (the phase by the arctangent).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, ancestry
from lagcli.graph.rewriting import rewritten

_HALF = Fraction(1, 2)


def with_corners(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same formulas with their corners and jumps as such."""
    if not any(_corner(graph, node) is not node for node in ancestry(roots)):
        return list(roots)
    return rewritten(graph, roots, _corner)


def _corner(graph: Graph, node: Node) -> Node:
    match node:
        case Product(factors=factors) if any(_is_root_of_square(*pair) for pair in factors):
            return graph.product(*(_absolute(graph, *pair) for pair in factors))
        case Call(function="atan2", arguments=(y, x), indices=()):
            return _phase(graph, y, x)
        case Call(function="asin", arguments=(Call(function="sin" | "cos") as sine,)):
            return _folded(graph, sine)
        case Call(function="acos", arguments=(x,)):
            complement = graph.call("asin", (x,))
            [angle] = rewritten(graph, [complement], _corner)
            quarter = graph.scaled(graph.symbol("pi"), _HALF)
            return node if angle is complement else graph.difference(quarter, angle)
        case Call(function="atan", arguments=(Call(function="tan", arguments=(u,)),)):
            side = graph.call("sign", (graph.call("cos", (u,)),))
            return graph.product(side, _folded(graph, graph.call("sin", (u,))))
    return node


def _folded(graph: Graph, sine: Node) -> Node:
    """asin(sin u) and asin(cos u): waves of triangles."""
    assert isinstance(sine, Call)
    other = graph.call("cos" if sine.function == "sin" else "sin", sine.arguments)
    beside = graph.sum([graph.one, graph.call("abs", (other,))])
    return graph.scaled(graph.call("atan", (graph.quotient(sine, beside),)), 2)


def _is_root_of_square(base: Node, exponent: Fraction) -> bool:
    """(u^2 w^4 ...)^(k/2)."""
    return (
        exponent.denominator == 2
        and isinstance(base, Product)
        and all(power.denominator == 1 and power % 2 == 0 for _, power in base.factors)
    )


def _absolute(graph: Graph, base: Node, exponent: Fraction) -> Node:
    if not _is_root_of_square(base, exponent):
        return graph.monomial(((base, exponent),))
    assert isinstance(base, Product)
    return graph.monomial(
        pair for factor, power in base.factors for pair in _power(graph, factor, power * exponent)
    )


def _power(graph: Graph, u: Node, exponent: Fraction) -> list[tuple[Node, Fraction]]:
    """|u|^k, which is sign(u) u^k for odd k: u sign(u)/u has no pole left."""
    side = [] if exponent % 2 == 0 else [(graph.call("sign", (u,)), Fraction(1))]
    return [(u, exponent), *side]


def _phase(graph: Graph, y: Node, x: Node) -> Node:
    size = graph.call("abs", (x,))
    side, above = graph.call("sign", (x,)), graph.call("sign", (y,))
    squares = graph.sum([graph.product(x, x), graph.product(y, y)])
    radius = graph.monomial(((squares, _HALF),))
    half = graph.call("atan", (graph.quotient(y, graph.sum([radius, size])),))
    back = graph.product(graph.difference(graph.one, side), above, graph.symbol("pi"))
    return graph.sum([graph.scaled(graph.product(side, half), 2), graph.scaled(back, _HALF)])
