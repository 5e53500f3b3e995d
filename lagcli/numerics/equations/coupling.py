"""Which coordinates move with which.

u_i needs u_j where M or a constraint couples the two, or where its equation names u_j.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lagcli.graph.nodes import Graph, Node, Symbol, mask_of
from lagcli.mechanics.rates import ConstraintRow


def coupling(
    graph: Graph,
    q: Sequence[Symbol],
    mass: Sequence[Sequence[Node]],
    forcing: Sequence[Node],
    rows: Iterable[ConstraintRow],
) -> tuple[list[int], list[int]]:
    """For each coordinate its mask with its rates, and the mask of what its motion names."""
    masks = [x.mask | graph.symbol(x.name, 1).mask | graph.symbol(x.name, 2).mask for x in q]
    named = [f.mask for f in forcing]
    for i, row in enumerate(mass):
        for j, entry in enumerate(row):
            named[i] |= entry.mask | (masks[j] if entry is not graph.zero else 0)
    for each in rows:
        inside = each.f.mask | each.bias.mask | each.drift.mask
        for entry in each.row:
            inside |= entry.mask
        touched = [i for i, entry in enumerate(each.row) if entry is not graph.zero]
        for i in touched:
            named[i] |= inside
            for j in touched:
                named[i] |= masks[j]
    return masks, named


def needed(masks: Sequence[int], named: Sequence[int], request: Sequence[Node]) -> list[bool]:
    """Which of the coordinates have a part in the request; the first two from `coupling`."""
    wanted = mask_of(request)
    while True:
        more = wanted
        for mask, needs in zip(masks, named, strict=True):
            if mask & wanted:
                more |= needs | mask
        if more == wanted:
            return [bool(mask & wanted) for mask in masks]
        wanted = more


def groups(masks: Sequence[int], named: Sequence[int]) -> list[list[int]]:
    """The coordinates that move without each other, as places; both arguments from `coupling`."""
    found: list[tuple[int, list[int]]] = []
    for i, (own, names) in enumerate(zip(masks, named, strict=True)):
        whole, places = own, [i]
        for mask, others in zip(masks, named, strict=True):
            if others & own or names & mask:
                whole |= mask
        apart = []
        for group in found:
            if group[0] & whole:
                whole, places = whole | group[0], group[1] + places
            else:
                apart.append(group)
        found = [*apart, (whole, places)]
    return sorted(sorted(places) for _, places in found)
