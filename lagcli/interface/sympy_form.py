"""Formulas as SymPy expressions for other programs, and as functions of NumPy arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import sympy

from lagcli.algebra.build import TIME, Builder, symbol
from lagcli.expression import Call, Expression, Name, walk
from lagcli.rewriting import rebuilt
from lagcli.values import numbers_of_parameters

if TYPE_CHECKING:
    from lagcli.interface.formula import Formula
    from lagcli.problem import Problem


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


def numeric_function(
    formula: Formula,
    problem: Problem,
    arguments: Sequence[str] | None,
    values: Mapping[str, float],
) -> Callable[..., Any]:
    """A NumPy function of a formula; see `Formula.to_numpy`.

    Raises
    ------
    ValueError
        When a name has neither a place among the arguments nor a value.
    """
    if arguments is None:
        arguments = [name for name in formula.arguments if name not in values]
        known: dict[str, Any] = dict(values)
    else:
        known = {**numbers_of_parameters(problem), **values}
    missing = [name for name in formula.arguments if name not in {*arguments, *known}]
    if missing:
        raise ValueError(f"no argument and no value: {', '.join(missing)}")
    called = {node.function for node in walk(formula.expression) if isinstance(node, Call)}
    if called & set(problem.functions):
        names = ", ".join(sorted(called & set(problem.functions)))
        raise ValueError(f"left unspecified by the file, so without numbers: {names}")
    places = {name: f"a{k}" for k, name in enumerate(formula.arguments)}
    symbols = {name: sympy.Symbol(place, real=True) for name, place in places.items()}
    build = Builder({each.name: each for each in symbols.values()}, {}, _no_derivative)
    expression = build(_placed(formula.expression, places))
    given = {symbols[name]: known[name] for name in places if name not in arguments}
    order = [symbols.get(name, sympy.Dummy()) for name in arguments]
    found: Callable[..., Any] = sympy.lambdify(
        order, expression.subs(given), modules="numpy", cse=True
    )
    return found


def _placed(node: Expression, places: Mapping[str, str]) -> Expression:
    """The tree with each name and its primes as one name."""
    if isinstance(node, Name):
        return Name(places.get(str(node), node.name))
    return rebuilt(node, lambda part: _placed(part, places))


def _no_derivative(value: Any) -> Any:
    raise TypeError(f"{value} has no derivative here")
