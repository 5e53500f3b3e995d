"""The numbers of the parameters: a value may be a formula of other parameters."""

from __future__ import annotations

from typing import Any

from lagcli.diagnostics import Diagnostic
from lagcli.graph.nodes import Node, Symbol, mask_of, with_values
from lagcli.numerics.equations.arithmetic import Arithmetic
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.equations.straight_line import straight_line
from lagcli.problem_data import Parameter


def constants_of(
    equations: EquationsOfMotion, wanted: list[Node], arithmetic: Arithmetic
) -> dict[Symbol, Any]:
    """The values of the parameters that occur in nodes, and of those that these need.

    Raises
    ------
    Refusal
        With all parameters that have no value, or one that cannot be.
    """
    graph, formulas = equations.graph, equations.parameter_values
    parameters = {graph.symbol(p.name): p for p in equations.problem.parameters}
    mask = with_values(mask_of(wanted), formulas)
    needed = {s: p for s, p in parameters.items() if s.mask & mask}
    missing = [p for s, p in needed.items() if s not in formulas]
    if missing:
        raise Refusal((_missing(missing),))
    values: dict[Symbol, Any] = {}
    while len(values) < len(needed):
        known = mask_of(values)
        for symbol, parameter in needed.items():
            if symbol not in values and not formulas[symbol].mask & ~known:
                values[symbol] = _value(formulas[symbol], parameter, values, arithmetic)
    return values


def _missing(parameters: list[Parameter]) -> Diagnostic:
    names = [parameter.name for parameter in parameters]
    options = " ".join(f"--set {name}=…" for name in names)
    if len(names) == 1:
        message, hint = f"the parameter '{names[0]}' has no value", "give it one here, or with"
    else:
        listed = f"{', '.join(map(repr, names[:-1]))} and {names[-1]!r}"
        message = f"the parameters {listed} have no values"
        values = ", ".join(f"{name}: 1" for name in names)
        hint = f"give them some here, as in parameters: {{{values}}}, or with"
    return Diagnostic(message, parameters[0].span, f"{hint} {options}")


def _value(
    formula: Node, parameter: Parameter, values: dict[Symbol, Any], arithmetic: Arithmetic
) -> Any:
    span = parameter.value.span if parameter.value is not None else parameter.span
    try:
        [value] = straight_line((), [formula], values, arithmetic)()
        good = abs(value) < float("inf")
    except (ArithmeticError, ValueError):
        good = False
    if not good:
        message = f"the value of '{parameter.name}' is not a real number"
        raise Refusal((Diagnostic(message, span),))
    mistake = parameter.mistake_of(float(value))
    if mistake is not None:
        raise Refusal((Diagnostic(mistake, span),))
    return value
