"""What of the equations a step may pass over unseen.

A polynomial in the coordinates, a sine of them, is seen wherever its series is worked out.
exp(-((x - 5)/w)^2) is not: far away it and all its derivatives are nothing beside the rest, so
that every run passes through the wall in the same way.  Neither is a pole, the step of a tanh,
a high power.  Each of these is watched by the argument on which it depends, whose own series
says how far that may go within the step: see `compiled.unseen` for the rules.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

from lagcli.graph.nodes import Call, Graph, Node, Product, Sum, ancestry
from lagcli.numerics.compiled.layout import DIVIDES, FLAT, GROWS, HIGH, JUMPS, TURNS
from lagcli.record import record, replace

#: Powers up to this are seen: no series is shorter.
_SEEN = 8


@record
class Narrow:
    """Something that may be passed over.

    Attributes
    ----------
    kind : int
        DIVIDES: singular where the argument is 0; GROWS: its exponential; FLAT: its tanh, or
        one over its cosh; HIGH: a power of it; TURNS: its sine; JUMPS: its sign or abs.
    argument : Node
        What it depends on.
    whole : Node or None
        What is regular though the argument is 0, if its own series says so.
    power : int
        Of what is HIGH.
    """

    kind: int
    argument: Node
    whole: Node | None = None
    power: int = 0

    @property
    def nodes(self) -> tuple[Node, ...]:
        """What the series of which are looked at."""
        return (self.argument,) if self.whole is None else (self.argument, self.whole)

    def entry(self, row: Callable[[Node], int]) -> list[int]:
        """Kind, rows and power, as `compiled.unseen` reads them."""
        argument = row(self.argument)
        whole = argument if self.whole is None else row(self.whole)
        power = int(self.whole is not None) if self.kind == DIVIDES else self.power
        return [self.kind, argument, whole, power]


def narrow_parts(
    graph: Graph, roots: Sequence[Node], mask: int, *, turning: bool = False
) -> list[Narrow]:
    """What may be passed over in some formulas.

    Parameters
    ----------
    graph
        Of the formulas.
    roots
        The formulas.
    mask
        The symbols that vary along the motion.
    turning
        Whether sines count, too, of what is looked at in a few places of a step only.
    """
    found: dict[Narrow, None] = {}
    if turning:
        waves = [node for node in ancestry(roots) if isinstance(node, Call)]
        found = {
            Narrow(TURNS, node.arguments[0]): None
            for node in waves
            if node.function in {"sin", "cos"} and node.arguments[0].mask & mask
        }
    varying = [node for node in ancestry(roots) if node.mask & mask]
    together = _together(graph, varying)
    for node in varying:
        for each in _parts_of(graph, node):
            if each.argument.mask & mask:
                whole = together.get((each.whole, each.argument), each.whole)
                found.setdefault(replace(each, whole=whole))
    return list(found)


def _together(graph: Graph, nodes: Sequence[Node]) -> dict[tuple[Node | None, Node], Node]:
    """The terms of a sum that one base divides, which may be regular together: (term, base)."""
    found: dict[tuple[Node | None, Node], Node] = {}
    for node in nodes:
        terms = node.terms if isinstance(node, Sum) else ()
        divided: dict[Node, list[tuple[Node, Fraction]]] = {}
        for term, number in terms:
            for base, exponent in term.factors if isinstance(term, Product) else ():
                if exponent < 0:
                    divided.setdefault(base, []).append((term, number))
        for base, pairs in divided.items():
            for term, _ in pairs:
                found[term, base] = graph.combination(pairs)
    return found


def _parts_of(graph: Graph, node: Node) -> Iterator[Narrow]:
    match node:
        case Product(factors=factors):
            for base, exponent in factors:
                yield from _of_power(node, base, exponent)
        case Call(function="^", arguments=(base, exponent)):
            yield Narrow(DIVIDES, base)
            yield Narrow(GROWS, graph.product(exponent, graph.call("log", (base,))))
        case Call(function="atan2", arguments=(y, x)):
            yield Narrow(DIVIDES, graph.sum([graph.product(y, y), graph.product(x, x)]))
        case Call(function=name, arguments=(x,), indices=()):
            yield from _of_function(graph, name, x)


def _of_power(node: Product, base: Node, exponent: Fraction) -> Iterator[Narrow]:
    whole = exponent.denominator == 1
    if whole and exponent < 0 and isinstance(base, Call) and base.function == "cosh":
        yield Narrow(FLAT, base.arguments[0])
    elif whole and isinstance(base, Call) and base.function == "exp":
        return
    elif not whole or exponent < 0:
        yield Narrow(DIVIDES, base, node if whole else None)
    elif exponent > _SEEN:
        yield Narrow(HIGH, base, node, int(exponent))


def _of_function(graph: Graph, name: str, x: Node) -> Iterator[Narrow]:
    one, square = graph.one, graph.product(x, x)
    match name:
        case "exp":
            yield Narrow(GROWS, x)
        case "tanh":
            yield Narrow(FLAT, x)
        case "tan" | "sec":
            yield Narrow(DIVIDES, graph.call("cos", (x,)))
        case "cot" | "csc":
            yield Narrow(DIVIDES, graph.call("sin", (x,)))
        case "log":
            yield Narrow(DIVIDES, x)
        case "asin" | "acos" | "atanh":
            yield Narrow(DIVIDES, graph.difference(one, square))
        case "atan" | "asinh":
            yield Narrow(DIVIDES, graph.sum([one, square]))
        case "acosh":
            yield Narrow(DIVIDES, graph.difference(square, one))
        case "abs" | "sign":
            yield Narrow(JUMPS, x)
