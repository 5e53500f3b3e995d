"""The sign that a sum has at random states; for the shape of a formula, never for a claim."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from random import Random

from lagcli.evaluation import evaluated
from lagcli.expression import Expression, Name, walk

_STATES = 24
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    name: getattr(math, name) for name in "sqrt exp log sin cos tan sinh cosh tanh".split()
} | {"abs": abs}


def sign_at_random(node: Expression, positive: Iterable[str]) -> int:
    """1 or -1 where the formula has this sign at all random states, else 0.

    Parameters
    ----------
    node
        The formula.
    positive
        The names that are positive; others are of either sign.
    """
    names = {part for part in walk(node) if isinstance(part, Name) and part.name != "pi"}
    known, draw = frozenset(positive), Random(len(names))
    signs = set()
    for _ in range(_STATES):
        values = {"pi": math.pi} | {
            str(name): draw.uniform(0.1, 2) if name.name in known and not name.primes
            else draw.uniform(-2, 2)
            for name in sorted(names, key=str)
        }  # fmt: skip
        try:
            signs.add(math.copysign(1, evaluated(node, values, _FUNCTIONS)))
        except (ArithmeticError, ValueError, KeyError, TypeError):
            return 0
        if len(signs) > 1:
            return 0
    return int(signs.pop())
