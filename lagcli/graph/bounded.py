"""Quotients that stay finite though what is divided, or divides, is no double any more.

    S = sum of m_i exp(k_i u) = exp(P) S',    P = max(k_i u),    S' = sum of m_i exp(k_i u - P)

    cosh u = (exp(u) + exp(-u))/2,    sinh^a u / cosh^b u = tanh^a u / cosh^(b - a) u

A negative power of S is one of S' times an exponential, which takes up those beside it:
exp(u)/(1 + exp(u))^2 at u = 1000 is exp(-1000)/(exp(-1000) + 1)^2.  Which k_i u is the
largest follows from `side(u)`, the sign of u at the beginning of a step.  It is a constant
there, since both forms are equal as mathematics.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, ancestry, split
from lagcli.graph.rewriting import rewritten

_NONE, _UNIT, _HALF = Fraction(0), Fraction(1), Fraction(1, 2)
_GROWS = {"exp", "cosh"}
#: u -> k: the power of exp(u) that a factor or a term has.
Rates = dict[Node, Fraction]


def bounded(graph: Graph, roots: Sequence[Node]) -> list[Node]:
    """The same formulas without quotients of functions that are no doubles."""
    if not any(isinstance(node, Call) and node.function in _GROWS for node in ancestry(roots)):
        return list(roots)
    return rewritten(graph, roots, _quotient)


def _quotient(graph: Graph, node: Node) -> Node:
    """A product in which no denominator grows beyond all bounds."""
    if not isinstance(node, Product):
        return node
    exponents = _by_tanh(graph, _factors(node))
    sums = {base: _terms(graph, base) for base in exponents}
    dividing = {u for base, (u, _) in sums.items() if u and exponents[base] < 0}
    if not dividing:
        return node
    taken: list[tuple[Node, Fraction]] = []
    growth: dict[Node, tuple[Fraction, Fraction]] = dict.fromkeys(dividing, (_NONE, _NONE))
    for base, exponent in exponents.items():
        u, terms = sums[base]
        if u not in dividing:
            taken.append((base, exponent))
            continue
        rates = [rate for _, rate in terms]
        mean, half = (max(rates) + min(rates)) / 2, (max(rates) - min(rates)) / 2
        growth[u] = growth[u][0] + exponent * mean, growth[u][1] + exponent * half
        rest = [graph.product(m, _exponential(graph, u, k - mean, -half)) for m, k in terms]
        taken.append((graph.sum(rest), exponent))
    whole = [(_exponential(graph, u, *rates), _UNIT) for u, rates in growth.items()]
    return graph.monomial([*taken, *whole])


def _factors(node: Product) -> dict[Node, Fraction]:
    """The bases of a product, those of products within it too, and their exponents."""
    found: dict[Node, Fraction] = {}
    for base, exponent in node.factors:
        inner = _factors(base) if isinstance(base, Product) and exponent == 1 else {base: _UNIT}
        for factor, power in inner.items():
            found[factor] = found.get(factor, _NONE) + power * exponent
    return found


def _by_tanh(graph: Graph, exponents: dict[Node, Fraction]) -> dict[Node, Fraction]:
    """The factors, sinh over cosh as tanh."""
    for base, exponent in list(exponents.items()):
        if isinstance(base, Call) and base.function == "cosh" and exponent < 0:
            sinh, tanh = (graph.call(name, base.arguments) for name in ("sinh", "tanh"))
            if 0 < exponents.get(sinh, _NONE) <= -exponent:
                above = exponents.pop(sinh)
                exponents[tanh] = exponents.get(tanh, _NONE) + above
                exponents[base] = exponent + above
    return {base: exponent for base, exponent in exponents.items() if exponent}


def _terms(graph: Graph, base: Node) -> tuple[Node | None, list[tuple[Node, Fraction]]]:
    """A factor as sum of m exp(k u): u, and the m with their k; None where there is not one u."""
    found: list[tuple[Node, Rates]] = []
    if isinstance(base, Call) and base.function == "cosh":
        k, u = _argument(graph, base)
        found = [(graph.constant(_HALF), {u: sign * k}) for sign in (1, -1)]
    elif isinstance(base, Sum):
        found = [(graph.constant(base.constant), {})] if base.constant else []
        for term, number in base.terms:
            rest, rates = _without_exponential(graph, term)
            found.append((graph.scaled(rest, number), rates))
    else:
        found = [_without_exponential(graph, base)]
    arguments = {u for _, rates in found for u in rates}
    if len(arguments) != 1:
        return None, []
    [u] = arguments
    return u, [(m, rates.get(u, _NONE)) for m, rates in found]


def _without_exponential(graph: Graph, term: Node) -> tuple[Node, Rates]:
    """A term m exp(k u) as m and u -> k."""
    factors = dict(term.factors) if isinstance(term, Product) else {term: _UNIT}
    for base, exponent in factors.items():
        if isinstance(base, Call) and base.function == "exp":
            k, u = _argument(graph, base)
            rest = ((other, power) for other, power in factors.items() if other is not base)
            return graph.monomial(rest), {u: k * exponent}
    return term, {}


def _argument(graph: Graph, call: Node) -> tuple[Fraction, Node]:
    """The argument of a call as k u, in which u is the same for all its multiples."""
    [x] = call.arguments  # type: ignore[attr-defined]
    factor, rest = split(x)
    if isinstance(rest, Sum):
        first = rest.terms[0][1]
        return factor * first, graph.scaled(rest, 1 / first)
    return factor, rest


def _exponential(graph: Graph, u: Node, rate: Fraction, half: Fraction) -> Node:
    """exp((rate + half side(u)) u)."""
    if not half:
        return graph.call("exp", (graph.scaled(u, rate),)) if rate else graph.one
    power = graph.combination([(graph.one, rate), (graph.call("side", (u,)), half)])
    return graph.call("exp", (graph.product(power, u),))
