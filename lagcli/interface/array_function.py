"""Formulas as functions of numbers and NumPy arrays, evaluated node by node."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from lagcli.evaluation import evaluated
from lagcli.expression import Call, Expression, walk
from lagcli.values import numbers_of_parameters

if TYPE_CHECKING:
    from lagcli.problem_data import Problem

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{
        name: getattr(np, name)
        for name in "sqrt exp log abs sign sin cos tan sinh cosh tanh".split()
    },
    "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2,
    "asinh": np.arcsinh, "acosh": np.arccosh, "atanh": np.arctanh,
    "cot": lambda x: 1 / np.tan(x), "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x),
}  # fmt: skip


def numeric_function(
    expression: Expression,
    names: Sequence[str],
    problem: Problem,
    arguments: Sequence[str] | None,
    values: Mapping[str, float],
) -> Callable[..., Any]:
    """A NumPy function of an expression in these names; see `Formula.to_numpy`.

    Raises
    ------
    ValueError
        When a name has neither a place among the arguments nor a value.
    """
    if arguments is None:
        arguments = [name for name in names if name not in values]
        known: dict[str, Any] = dict(values)
    else:
        known = {**numbers_of_parameters(problem), **values}
    missing = [name for name in names if name not in {*arguments, *known}]
    if missing:
        raise ValueError(f"no argument and no value: {', '.join(missing)}")
    called = {node.function for node in walk(expression) if isinstance(node, Call)}
    if called - set(_FUNCTIONS):
        unspecified = ", ".join(sorted(called - set(_FUNCTIONS)))
        raise ValueError(f"left unspecified by the file, so without numbers: {unspecified}")
    names_of_arguments = tuple(arguments)

    def function(*given: Any) -> Any:
        if len(given) != len(names_of_arguments):
            raise TypeError(f"the arguments are {', '.join(names_of_arguments)}")
        values = known | dict(zip(names_of_arguments, given, strict=True)) | {"pi": np.pi}
        return evaluated(expression, values, _FUNCTIONS)

    return function
