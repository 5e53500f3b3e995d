"""The parts of Hamilton's principal function for machines."""

from __future__ import annotations

from collections.abc import Mapping

from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object
from lagcli.motions import Above, HamiltonJacobiSection


def of_action(section: HamiltonJacobiSection) -> Object:
    """Give the value of the key `hamilton_jacobi`."""
    return {
        "hamiltonian": _string(section.hamiltonian),
        "separable": section.separable,
        "obstacle": section.obstacle or None,
        "constants": section.constants,
        "equations": _by_name(section.equations),
        "derivatives": None if section.derivatives is None else _by_name(section.derivatives),
        "functions": _by_name(section.functions),
        "cases": {
            name: [
                {"function": to_grammar(each.function), "where": [above(a) for a in each.where]}
                for each in forms
            ]
            for name, forms in section.cases.items()
        },
        **_timed(section),
        "reason": section.reason,
    }


def _timed(section: HamiltonJacobiSection) -> Object:
    if section.time_rate is None:
        return {}
    return {
        "time_rate": _string(section.time_rate),
        "of_time": _string(section.of_time),
        "integrals": _by_name(section.integrals),
    }


def above(inequality: Above) -> str:
    """Write an inequality."""
    return f"{to_grammar(inequality.left)} > {to_grammar(inequality.right)}"


def _string(expression: Expression | None) -> str | None:
    return None if expression is None else to_grammar(expression)


def _by_name(expressions: Mapping[str, Expression]) -> dict[str, str]:
    return {name: to_grammar(expression) for name, expression in expressions.items()}
