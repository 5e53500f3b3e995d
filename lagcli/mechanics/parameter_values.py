"""Numbers for the parameters: those of the file, else admissible ones."""

from __future__ import annotations

import random

import mpmath
from mpmath import mpf
from sympy import Expr, Symbol

from lagcli.algebra.numeric import FINE_DIGITS, Evaluator, with_assumed_sign
from lagcli.mechanics.system import System


def parameter_values(system: System) -> dict[Symbol, mpf]:
    """The values that the file gives, by parameter; those without one are left out.

    A value may be a formula of other parameters, in any order.
    """
    values = exact_values(system)
    return dict(zip(values, Evaluator(list(values.values()), FINE_DIGITS)({}), strict=True))


def exact_values(system: System) -> dict[Symbol, Expr]:
    """The values of the file as exact numbers, by parameter; those without one left out."""
    formulas = {
        symbol: system.build(parameter.value)
        for symbol, parameter in zip(system.parameters, system.problem.parameters, strict=True)
        if parameter.value is not None
    }
    for _ in formulas:
        formulas = {symbol: formula.xreplace(formulas) for symbol, formula in formulas.items()}
    return {symbol: value for symbol, value in formulas.items() if not value.free_symbols}


def admissible_values(system: System, count: int) -> list[dict[Symbol, mpf]]:
    """Values for all parameters: the file's where it gives all of them, else random ones.

    Random values obey the assumptions of the file and are the same in every run.
    """
    given = parameter_values(system)
    if len(given) == len(system.parameters):
        return [given]
    source = random.Random("lagcli parameters")
    return [
        {p: given.get(p, random_parameter(source, p, wide=k % 2 == 1)) for p in system.parameters}
        for k in range(count)
    ]


def random_parameter(source: random.Random, parameter: Symbol, *, wide: bool) -> mpf:
    """A number that the assumptions of the file allow, the same in every run."""
    if parameter.is_integer:
        return mpf(source.randint(1, 5))
    # 1/20 to 20, or 1/2 to 2, evenly on a logarithmic scale, never a nice number
    size = 30011 if wide else 7001
    with mpmath.workdps(FINE_DIGITS):
        magnitude = mpmath.exp(mpf(source.randint(-size, size)) / 10007)
    return with_assumed_sign(source, parameter, magnitude)
