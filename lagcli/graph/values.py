"""Numbers for nodes: a plan in which each node is worked out once, run at many points."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from lagcli.evaluation import FUNCTIONS
from lagcli.graph.nodes import Call, Constant, Node, Product, Sum, Symbol, ancestry

#: f(arguments, indices) for a function that the file leaves unspecified
Concrete = Callable[[Sequence[Any], Sequence[int]], Any]


class Floats:
    """Double precision."""

    functions: Mapping[str, Callable[..., Any]] = FUNCTIONS

    def number(self, value: Fraction) -> float:
        """A rational."""
        return float(value)


class Digits:
    """As many digits as mpmath works with."""

    def __init__(self) -> None:
        import mpmath

        self._mp = mpmath
        self.functions: Mapping[str, Callable[..., Any]] = {
            **{n: getattr(mpmath, {"abs": "fabs"}.get(n, n)) for n in FUNCTIONS},
            "power": self._power,
            "pi": lambda: +mpmath.pi,
        }

    def number(self, value: Fraction) -> Any:
        """A rational."""
        return self._mp.mpf(value.numerator) / value.denominator

    def _power(self, base: Any, exponent: Any) -> Any:
        result = base ** (int(exponent) if exponent == int(exponent) else exponent)
        if isinstance(result, self._mp.mpc):
            raise ValueError("a power that is not real")  # noqa: TRY004 - as math.pow
        return result


class Program:
    """The values of nodes as a list of steps, the one thing that is compiled from a graph.

    Parameters
    ----------
    roots
        What is wanted.
    arithmetic
        `Floats()` or `Digits()`.
    functions
        Name -> what stands for a function that is left unspecified.
    """

    def __init__(
        self,
        roots: Sequence[Node],
        arithmetic: Floats | Digits,
        functions: Mapping[str, Concrete] | None = None,
    ) -> None:
        self._functions = functions or {}
        self._arithmetic = arithmetic
        nodes = ancestry(roots)
        self._place = {node: place for place, node in enumerate(nodes)}
        self._start: list[Any] = [None] * len(nodes)
        self._symbols: list[tuple[str, int]] = []
        self._steps: list[tuple[int, Callable[[list[Any]], Any]]] = []
        for place, node in enumerate(nodes):
            if isinstance(node, Constant):
                self._start[place] = arithmetic.number(node.value)
            elif isinstance(node, Symbol):
                if node.name == "pi":
                    self._start[place] = arithmetic.functions["pi"]()
                else:
                    self._symbols.append((str(node), place))
            else:
                self._steps.append((place, self._step(node)))
        self._roots = [self._place[root] for root in roots]

    def __call__(self, values: Mapping[str, Any]) -> list[Any]:
        """The values at a point, given by names: `x`, `x'`.

        Raises
        ------
        ArithmeticError, ValueError
            Where a part is not defined or not real.
        """
        slots = self._start.copy()
        for name, place in self._symbols:
            slots[place] = values[name]
        for place, step in self._steps:
            slots[place] = step(slots)
        return [slots[place] for place in self._roots]

    def _step(self, node: Node) -> Callable[[list[Any]], Any]:
        match node:
            case Sum():
                return self._sum(node)
            case Product():
                return self._product(node)
            case Call():
                return self._call(node)
        raise TypeError(f"no node: {node!r}")

    def _sum(self, node: Sum) -> Callable[[list[Any]], Any]:
        number = self._arithmetic.number
        constant = number(node.constant) if node.constant else 0
        plain = [self._place[term] for term, c in node.terms if c == 1]
        scaled = [(self._place[term], number(c)) for term, c in node.terms if c != 1]
        if not scaled:
            return lambda v: sum([v[i] for i in plain], constant)
        return lambda v: sum([v[i] * c for i, c in scaled], sum([v[i] for i in plain], constant))

    def _product(self, node: Product) -> Callable[[list[Any]], Any]:
        plain = [self._place[base] for base, e in node.factors if e == 1]
        raised = [(self._place[base], e) for base, e in node.factors if e != 1]
        if not raised:
            return lambda v: math.prod([v[i] for i in plain])
        power, number = self._arithmetic.functions["power"], self._arithmetic.number
        powers = [(place, number(e)) for place, e in raised]
        return lambda v: (
            math.prod([v[i] for i in plain]) * math.prod([power(v[i], e) for i, e in powers])
        )

    def _call(self, node: Call) -> Callable[[list[Any]], Any]:
        places = [self._place[argument] for argument in node.arguments]
        if node.function == "^":
            base, exponent = places
            power = self._arithmetic.functions["power"]
            return lambda v: power(v[base], v[exponent])
        concrete = self._functions.get(node.function)
        if concrete is not None:
            indices = node.indices
            return lambda v: concrete([v[i] for i in places], indices)
        function = self._arithmetic.functions[node.function]
        if len(places) == 1:
            place = places[0]
            return lambda v: function(v[place])
        return lambda v: function(*[v[i] for i in places])
