"""Formulas as SymPy expressions for other programs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import sympy

from lagcli.algebra.build import TIME, Builder, symbol
from lagcli.expression import Expression, Name, walk

if TYPE_CHECKING:
    from lagcli.problem_data import Problem


class Dynamic:
    """Turns trees into SymPy with coordinates as functions of time.

    Parameters
    ----------
    problem
        Gives the coordinates, the assumptions and the unspecified functions.
    """

    def __init__(self, problem: Problem) -> None:
        self._names: dict[str, Any] = {
            one.name: sympy.Function(one.name, real=True)(TIME) for one in problem.coordinates
        }
        for one in problem.parameters:
            self._names[one.name] = symbol(one.name, one.assume, integer=one.integer)
        self._functions = {name: len(given) for name, given in problem.functions.items()}

    def __call__(self, expression: Expression) -> Any:
        """The SymPy expression of a tree."""
        names = dict(self._names)
        for node in walk(expression):
            if isinstance(node, Name) and node.name not in names:
                names[node.name] = symbol(node.name)
        build = Builder(names, self._functions, lambda value: value.diff(TIME))
        return build(expression)
