"""What velocities the structure of a problem is made of, and what its constraints ask of them."""

from __future__ import annotations

from lagcli.graph.nodes import Node, Symbol
from lagcli.record import record


@record
class VelocityRate:
    """A velocity w in L: that of a point or definition, or q' itself."""

    symbol: Symbol
    jacobian: dict[int, Node]  # i -> dw/dq_i'
    bias: Node  # dw/dt with q'' = 0


@record
class ConstraintRow:
    """f = 0, and a . q' + b = 0, and a . q'' + bias = 0."""

    f: Node
    holonomic: bool  # written without velocities
    row: tuple[Node, ...]  # a
    drift: Node  # b
    bias: Node

    @property
    def position(self) -> Node | None:
        """f where it is a condition on the positions."""
        return self.f if self.holonomic else None
