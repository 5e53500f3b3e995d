"""Nodes before what is made of them, without recursion."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator

from lagcli.graph.nodes import Node


def parts_first(
    root: Node, done: Container[Node], parts: Callable[[Node], Iterable[Node]]
) -> Iterator[Node]:
    """The nodes that a root needs, each after its own; the caller adds each to those done.

    Parameters
    ----------
    root
        The node that comes last.
    done
        What is not needed again.
    parts
        What a node needs.
    """
    stack = [root]
    while stack:
        node = stack[-1]
        missing = [] if node in done else [p for p in parts(node) if p not in done]
        if missing:
            stack.extend(missing)
            continue
        stack.pop()
        if node not in done:
            yield node
