"""Formulas with abbreviations for the parts that recur in them, on the nodes of a graph."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

from lagcli.expression import Expression, operation_count
from lagcli.graph.nodes import Call, Node, Sum, Symbol, mask_of
from lagcli.graph.sharing import GraphWriter, in_order_of_use, repeated
from lagcli.notation.naming import PART_STEMS, Names, free_stem
from lagcli.record import record

#: More abbreviations than this fill more than a page; a chain of six links on a cart has 74.
MOST_NAMES = 100
#: Operations of all of them; the same chain has 900.
MOST_OPERATIONS = 2_000


@record(kw_only=True)
class Written:
    """Trees, and the abbreviations that they use in order."""

    values: tuple[Expression, ...]
    where: Mapping[str, Expression]


def abbreviated(
    named: Mapping[Symbol, Node],
    values: Sequence[Node],
    order: Sequence[str],
    labels: PartLabels,
    varying: int,
) -> Written | None:
    """The values and the abbreviations that they use, in order; None for more than a page."""
    needed = _needed(named, values)
    roots = [*needed.values(), *values]
    where: dict[str, Expression] = {}
    writer, shared = GraphWriter(order), repeated(roots) | labels.known
    labels.take(symbol.name for symbol in named)
    definitions = [(symbol.name, node) for symbol, node in needed.items()]
    for name, root in [*definitions, *(("", value) for value in values)]:
        for node in in_order_of_use([root]):
            if node in shared and node not in writer.names and not (name and node is root):
                label = labels(node)
                where[label] = writer.tree(node)
                writer.name(node, label, leading=not node.mask & varying)
        if name:
            where[name] = writer.tree(root)
    trees = tuple(map(writer.tree, values))
    count = sum(map(operation_count, (*where.values(), *trees)))
    if len(where) > MOST_NAMES or count > MOST_OPERATIONS:
        return None
    return Written(values=trees, where=where)


def _needed(named: Mapping[Symbol, Node], values: Sequence[Node]) -> dict[Symbol, Node]:
    """The names that the values use, directly or through others."""
    mask = mask_of(values)
    kept: list[Symbol] = []
    for symbol in reversed(list(named)):
        if symbol.mask & mask:
            mask |= named[symbol].mask
            kept.append(symbol)
    return {symbol: named[symbol] for symbol in reversed(kept)}


class PartLabels:
    """Names by what is named: s12 = sin(θ1 − θ2), m23 = m2 + m3, else k1, k2, …

    A part that was named keeps its name.
    """

    def __init__(self, taken: Collection[str]) -> None:
        self._taken = Names(taken)
        self._stem = free_stem(PART_STEMS, taken)
        self._of: dict[Node, str] = {}
        self._count = 0

    @property
    def known(self) -> set[Node]:
        """What has a name."""
        return set(self._of)

    def take(self, names: Iterable[str]) -> None:
        """Give no part one of these names."""
        self._taken.add(*names)

    def __call__(self, node: Node) -> str:
        """The name of a part."""
        known = self._of.get(node)
        if known is None:
            known = self._of[node] = self._new(_label(node))
        return known

    def _new(self, wanted: str) -> str:
        if not wanted or wanted in self._taken:
            self._count += 1
            wanted = f"{self._stem}{self._count}"
        self._taken.add(wanted)
        return wanted


def _label(node: Node) -> str:
    match node:
        case Call(function="sin" | "cos" as function, arguments=(angle,)):
            indices = _indices(angle)
            return function[0] + indices if indices else ""
        case Sum(constant=constant, terms=terms) if not constant:
            parts = [_stem(term) for term, number in terms if number == 1]
            stems = {stem for stem, _ in parts}
            if len(stems) == 1 and len(parts) == len(terms) and all(i for _, i in parts):
                return stems.pop() + "".join(index for _, index in parts)
    return ""


def _indices(angle: Node) -> str:
    """12 of θ1 - θ2, 1 of θ1."""
    if isinstance(angle, Symbol):
        return _stem(angle)[1]
    if not isinstance(angle, Sum) or angle.constant or len(angle.terms) != 2:
        return ""
    (a, one), (b, other) = angle.terms
    first, second = _stem(a), _stem(b)
    alike = first[0] == second[0] and first[0] and one == 1 and other == -1
    return first[1] + second[1] if alike and first[1] and second[1] else ""


def _stem(node: Node) -> tuple[str, str]:
    """(theta, 1) of theta1 and of theta_1."""
    if not isinstance(node, Symbol) or node.primes:
        return "", ""
    stem = node.name.rstrip("0123456789")
    return stem.rstrip("_"), node.name[len(stem) :]
