"""Definitions that answers keep by their names: mu = m1 m2/(m1 + m2), r = sqrt(x² + y²)."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain, combinations

from sympy import Expr, S

from lagcli.algebra.build import Builder, symbol
from lagcli.algebra.generic_rank import has_full_rank
from lagcli.algebra.signs import sign
from lagcli.expression import Call, Expression, Name, Number, Power, walk
from lagcli.notation.factors import half_of
from lagcli.notation.likeness import Polynomial, multiplied_out
from lagcli.problem_data import Assumption, Parameter, Problem
from lagcli.record import replace
from lagcli.rewriting import expressions_in, rebuilt

_ASIDE = ("source", "definitions", "parameters", "coordinates", "functions", "expect", "named",
          "simulation", "picture")  # fmt: skip
_MOST = 5  # definitions of constants among which those to be kept are looked for
_SIGNS: dict[int | None, Assumption] = {1: "positive", -1: "negative"}


def with_named_constants(problem: Problem) -> Problem:
    """The problem with definitions of constants as parameters, where that loses nothing.

    What they are made of occurs nowhere else, and they are independent of each other: their
    values are then as arbitrary as those of parameters.
    """
    constants = [name for name in problem.definitions if _is_constant(problem, name)]
    if not constants or len(constants) > _MOST:
        return problem
    sizes = range(len(constants), 0, -1)
    for chosen in chain(*(combinations(constants, size) for size in sizes)):
        used = _used(problem, chosen)
        kept = [name for name in chosen if name in used]
        values = _values(problem, kept) if kept else None
        if values and _are_free(values, used):
            return _with_parameters(problem, values)
    return problem


def _is_constant(problem: Problem, name: str) -> bool:
    """Whether a definition holds parameters and no variables."""
    names = {part.name for part in walk(problem.definitions[name]) if isinstance(part, Name)}
    parameters = {p.name for p in problem.parameters}
    known = all(n in parameters or (n in problem.definitions and _is_constant(problem, n))
                for n in names - {"pi"})  # fmt: skip
    return known and bool(names - {"pi"})


def _used(problem: Problem, chosen: tuple[str, ...]) -> set[str]:
    """The names in the formulas of the file, the other definitions written out."""
    fields = (n for n in type(problem).__dataclass_fields__ if n not in _ASIDE)
    left = [node for n in fields for node in expressions_in(getattr(problem, n))]
    found: set[str] = set()
    while left:
        for part in walk(left.pop()):
            if isinstance(part, Name) and part.name not in found:
                found.add(part.name)
                if part.name in problem.definitions and part.name not in chosen:
                    left.append(problem.definitions[part.name])
    return found


def _values(problem: Problem, names: list[str]) -> dict[str, Expr] | None:
    parameters = {p.name: symbol(p.name, p.assume, integer=p.integer) for p in problem.parameters}
    arities = {name: len(args) for name, args in problem.functions.items()}
    build = Builder(parameters, arities, lambda _: S.Zero, lambda _: ValueError())
    try:
        for name, formula in problem.definitions.items():
            if _is_constant(problem, name):
                build.names[name] = build(formula)
    except (ArithmeticError, ValueError):
        return None
    return {name: build.names[name] for name in names}


def _are_free(values: Mapping[str, Expr], used: set[str]) -> bool:
    """Whether nothing else holds their parameters, and no equation holds between them."""
    parameters = sorted({s for value in values.values() for s in value.free_symbols}, key=str)
    if any(s.name in used for s in parameters):
        return False
    return has_full_rank([[value.diff(s) for value in values.values()] for s in parameters])


def _with_parameters(problem: Problem, values: Mapping[str, Expr]) -> Problem:
    made = [
        Parameter(name=name, assume=_SIGNS.get(sign(value), "real"))
        for name, value in values.items()
    ]
    left = {n: node for n, node in problem.definitions.items() if n not in values}
    named = {n: _without(problem, problem.definitions[n], values) for n in values}
    return replace(problem, parameters=(*made, *problem.parameters), definitions=left, named=named)


def _without(problem: Problem, node: Expression, kept: Mapping[str, Expr]) -> Expression:
    """The definition, those that are not kept written out."""
    if isinstance(node, Name) and node.name in problem.definitions and node.name not in kept:
        return _without(problem, problem.definitions[node.name], kept)
    return rebuilt(node, lambda part: _without(problem, part, kept))


class NamedRoots:
    """r for sqrt(x² + y²), r^3 for (x² + y²)^(3/2), where the file defines r so."""

    def __init__(self, problem: Problem) -> None:
        self._found: list[tuple[Polynomial, str]] = []
        fixed = {q.name for q in (*problem.parameters, *problem.coordinates)}
        for name, node in problem.definitions.items():
            names = [part for part in walk(node) if isinstance(part, Name)]
            if not isinstance(node, Call) or node.function != "sqrt":
                continue
            value = multiplied_out(node.arguments[0])
            if value and len(value) > 1 and all(n.name in fixed and not n.primes for n in names):
                self._found.append((value, name))

    def __bool__(self) -> bool:
        return bool(self._found)

    def __call__(self, node: Expression) -> Expression:
        """The formula with the names, but for the definition itself."""
        return rebuilt(node, self._within)

    def _within(self, node: Expression) -> Expression:
        match node:
            case Call(function="sqrt", arguments=(inner,)) if name := self._name(inner):
                return Name(name)
            case Power(base=base, exponent=exponent) if (half := half_of(exponent)) is not None:
                if name := self._name(base):
                    return Power(Name(name), Number(2 * half))
        return rebuilt(node, self._within)

    def _name(self, node: Expression) -> str:
        value = multiplied_out(node)
        return next((name for known, name in self._found if known == value), "")

    def named(self, problem: Problem, used: set[str]) -> dict[str, Expression]:
        """The definitions whose names are used."""
        return {name: problem.definitions[name] for _, name in self._found if name in used}
