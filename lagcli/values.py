"""Numbers in place of parameters: `--set` and the values that a file gives."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TypeVar

from lagcli.diagnostics import Diagnostic
from lagcli.evaluation import Constant, value_of
from lagcli.expression import (
    ZERO,
    Diff,
    Expression,
    Name,
    Negative,
    Power,
    Product,
    Quotient,
    terms_of,
    walk,
)
from lagcli.notation.decimals import number
from lagcli.problem_data import Parameter, Problem, Question, Rewrite
from lagcli.record import replace
from lagcli.rewriting import expressions_in, rebuilt, substituted

#: Beside the terms of a constraint, a residual that is rounding.
_ROUNDED = 1e-9

Values = Mapping[str, Expression]
Value = TypeVar("Value")


def parameters_with_values(problem: Problem) -> tuple[str, ...]:
    """Those that have a value, but for the ones that a `find` solves for."""
    unknown = {q.unknown.name for q in problem.find if not isinstance(q, Rewrite)}
    return tuple(
        parameter.name
        for parameter in problem.parameters
        if parameter.value is not None and parameter.name not in unknown
    )


def with_values_of(
    problem: Problem, names: Collection[str]
) -> tuple[Problem, tuple[Diagnostic, ...]]:
    """Put the values of some parameters in, which are then no longer parameters.

    Parameters
    ----------
    problem
        Its values go in no circle, as the reader sees to.
    names
        Parameters that have a value: a number, or an expression of other parameters.

    Returns
    -------
    problem, diagnostics
        The diagnostics say which values cannot be put in.
    """
    values = _resolved({p.name: p.value for p in problem.parameters if p.name in names and p.value})
    mistakes = [*_unknowns(problem, names), *_wrong_numbers(problem, values)]
    if mistakes or not values:
        return problem, tuple(mistakes)
    remaining = tuple(p for p in problem.parameters if p.name not in values)
    questions = tuple(_question(question, values) for question in problem.find)
    changed = substituted(replace(problem, parameters=remaining, find=()), values)
    changed = replace(changed, find=questions)
    return changed, tuple(_undefined(problem, changed))


def numbers_of_parameters(problem: Problem) -> dict[str, float]:
    """The parameters whose value is a number once the others are put in."""
    formulas = _resolved({p.name: p.value for p in problem.parameters if p.value is not None})
    found = {name: value_of(formula) for name, formula in formulas.items()}
    return {name: float(value) for name, value in found.items() if value is not None}


def off_constraints(problem: Problem) -> list[Diagnostic]:
    """Warnings of the constraints that `initial`, with all that is in them, does not satisfy."""
    formulas: dict[str, Expression] = {p.name: p.value for p in problem.parameters if p.value}
    formulas |= {**problem.definitions, "t": ZERO}
    formulas |= {str(name): value for name, value in problem.initial.items()}
    numbers: dict[str, Constant | None] = {}

    def put_in(node: Expression) -> Expression:
        if not isinstance(node, Name):
            return rebuilt(node, put_in)
        name = str(node)
        if name in formulas and name not in numbers:
            numbers[name] = value_of(put_in(formulas[name]))
        known = numbers.get(name)
        return node if known is None else number(known)

    found = []
    for one in problem.constraints:
        try:
            sides = [put_in(side) for side in (one.equation.left, one.equation.right)]
            left, right = value_of(sides[0]), value_of(sides[1])
            parts = [value_of(term) for side in sides for term in terms_of(side)]
        except (ArithmeticError, ValueError):
            continue
        sizes = [abs(float(part)) for part in parts if part is not None]
        if left is None or right is None:
            continue
        difference = float(left) - float(right)
        if abs(difference) <= _ROUNDED * sum(sizes):
            continue
        found.append(
            Diagnostic(
                f"the initial state does not satisfy the constraint '{one.name}'",
                one.equation.span,
                f"with the values of the file, left - right is {difference:.6g}",
                severity="warning",
            )
        )
    return found


def _question(question: Question, values: Values) -> Question:
    """The question with values in it; what it is put in terms of keeps only names."""
    changed = substituted(question, values)
    if isinstance(question, Rewrite) and isinstance(changed, Rewrite):
        names = tuple(n for n in question.in_terms_of if n.name not in values)
        return replace(changed, in_terms_of=names)
    return changed


def _unknowns(problem: Problem, names: Collection[str]) -> list[Diagnostic]:
    """Parameters that must stay names."""
    solved_for = {q.unknown.name for q in problem.find if not isinstance(q, Rewrite)}
    variables = _differentiated_by(problem)
    return [
        Diagnostic(f"'{name}' can have no value here: {why}")
        for name in names
        for names_of, why in (
            (solved_for, "a `find` solves for it"),
            (variables, "a `diff` is taken by it"),
        )
        if name in names_of
    ]


def _differentiated_by(problem: Problem) -> set[str]:
    parts = (part for tree in expressions_in(problem) for part in walk(tree))
    return {part.variable.name for part in parts if isinstance(part, Diff)}


def _resolved(values: Values) -> dict[str, Expression]:
    """The values in terms of parameters that are not among them."""
    resolved: dict[str, Expression] = {}

    def resolve(node: Expression) -> Expression:
        if not isinstance(node, Name):
            return rebuilt(node, resolve)
        if node.name in values and node.name not in resolved:
            resolved[node.name] = resolve(values[node.name])
        return resolved.get(node.name, node)

    for name in values:
        resolve(Name(name))
    return resolved


def _wrong_numbers(problem: Problem, values: Values) -> list[Diagnostic]:
    parameters = {p.name: p for p in problem.parameters}
    found = (_wrong_number(parameters[name], value) for name, value in values.items())
    return [mistake for mistake in found if mistake is not None]


def _wrong_number(parameter: Parameter, formula: Expression) -> Diagnostic | None:
    try:
        value = value_of(formula)
    except (ArithmeticError, ValueError):
        return Diagnostic(f"the value of '{parameter.name}' is not a real number")
    if value is None:
        return None
    mistake = parameter.mistake_of(value)
    return None if mistake is None else Diagnostic(mistake)


def _undefined(before: Problem, after: Problem) -> list[Diagnostic]:
    """Divisions by zero that the values have made; the file alone has none of them."""
    trees = expressions_in(replace(after, expect=before.expect))
    spans = sorted({part.span for tree in trees for part in walk(tree) if _divides_by_zero(part)})
    return [Diagnostic("with these values something is divided by zero", span) for span in spans]


def _divides_by_zero(node: Expression) -> bool:
    match node:
        case Quotient(denominator=below):
            return _is_zero(below)
        case Power(base=base, exponent=exponent):
            return _is_zero(base) and _is_negative(exponent)
    return False


def _is_zero(node: Expression) -> bool:
    match node:
        case Product(factors=factors):
            return any(map(_is_zero, factors))
        case Quotient(numerator=above):
            return _is_zero(above)
        case Negative(operand=operand):
            return _is_zero(operand)
        case _:
            pass
    try:
        return value_of(node) == 0
    except (ArithmeticError, ValueError):
        return False


def _is_negative(node: Expression) -> bool:
    try:
        value = value_of(node)
    except (ArithmeticError, ValueError):
        return False
    return value is not None and value < 0
