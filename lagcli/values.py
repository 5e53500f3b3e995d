"""Numbers in place of parameters: `--set` and the values that a file gives."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping
from fractions import Fraction
from functools import partial
from typing import TypeVar

from lagcli.diagnostics import Diagnostic
from lagcli.evaluation import Constant, value_of
from lagcli.expression import (
    ZERO,
    Diff,
    Equation,
    Expression,
    Name,
    Negative,
    Power,
    Product,
    Quotient,
    name_nodes,
    terms_of,
    walk,
)
from lagcli.notation.decimals import number
from lagcli.problem_data import Contact, Parameter, Problem, Question, Rewrite
from lagcli.record import replace
from lagcli.rewriting import expressions_in, rebuilt, substituted

#: Beside the terms of a constraint, a residual that is rounding.
_ROUNDED = 1e-9
#: Of a value in a difference quotient, its least size, and steps to a root.
_DIFFERENCE, _FLAT, _NEWTON = 2.0**-12, 1e-6, 20
#: Of the time in a difference quotient.
_STEP = Fraction(1, 10**4)

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
    """Warnings of what `initial`, with all that is in it, does not satisfy.

    These are the constraints, those without velocities also by their derivative by the time, and
    the gaps of contacts.
    """
    given: dict[str, Expression] = {p.name: p.value for p in problem.parameters if p.value}
    given |= {**problem.definitions, "t": ZERO}
    given |= {str(name): value for name, value in problem.initial.items()}
    found: list[Diagnostic | None] = []
    for one in problem.constraints:
        message = f"the initial state does not satisfy the constraint '{one.name}'"
        off = _residual(one.equation, given)
        if off is not None and abs(off[0]) > _ROUNDED * off[1]:
            difference = f"with the values of the file, left - right is {off[0]:.6g}"
            found.append(
                _off(problem, message, one.equation, difference, given, off[0], rate=False)
            )
        elif off is not None and (rate := _rate(problem, one.equation, given)):
            message = f"the initial velocities do not satisfy the constraint '{one.name}'"
            difference = f"left - right changes at the rate {rate:.6g}"
            found.append(_off(problem, message, one.equation, difference, given, rate, rate=True))
    found += (_apart(problem, each, given) for each in problem.contacts)
    return [each for each in found if each is not None]


def _apart(problem: Problem, contact: Contact, given: Values) -> Diagnostic | None:
    """The warning of a negative gap, with the gap turned round where that one is not negative."""
    off, at = _residual(contact.equation, given), contact.equation.span
    if off is None or off[0] >= -_ROUNDED * off[1]:
        return None
    message = f"the gap of '{contact.name}' is negative in the initial state: {off[0]:.6g}"
    hint = "a gap is positive where the bodies are apart"
    line = problem.source.text.split("\n")[at.line - 1][at.column - 1 : at.end_column - 1]
    written = re.fullmatch(r"(\w+) *- *(\w+) *>=? *(.+)", line)
    turned = Equation(Negative(contact.equation.left), contact.equation.right)
    apart = _residual(turned, given)
    if written and apart is not None and apart[0] >= 0:
        hint = f"write {written[2]} - {written[1]} >= {written[3]}: {hint}"
    elif re.search(r"<=? *0$|^0 *>=?", line):
        hint = f"write {line.translate(str.maketrans('<>', '><'))}: {hint}"  # y <= 0
    elif isinstance(contact.equation.left, Name) and contact.equation.left in problem.initial:
        at = problem.initial[contact.equation.left].span  # y >= R
        right = line.rpartition("=")[2].rpartition(">")[2].strip()
        hint = f"start where {line}: write {contact.equation.left}: {right}"
    return Diagnostic(message, at, hint, severity="warning")


def _residual(equation: Equation, given: Values) -> tuple[float, float] | None:
    """The left minus the right side, and the size of their terms; None where one has no value."""
    numbers: dict[str, Constant | None] = {}

    def put_in(node: Expression) -> Expression:
        if not isinstance(node, Name):
            return rebuilt(node, put_in)
        name = str(node)
        if name in given and name not in numbers:
            numbers[name] = value_of(put_in(given[name]))
        known = numbers.get(name)
        return node if known is None else number(known)

    try:
        sides = [put_in(side) for side in (equation.left, equation.right)]
        left, right = value_of(sides[0]), value_of(sides[1])
        parts = [value_of(term) for side in sides for term in terms_of(side)]
    except (ArithmeticError, ValueError):
        return None
    if left is None or right is None:
        return None
    return float(left) - float(right), sum(abs(float(each)) for each in parts if each is not None)


def _rate(problem: Problem, equation: Equation, given: Values) -> float:
    """The derivative of left - right by the time, 0 where it is rounding or not known.

    It is a difference quotient along the velocities, which must all be given.
    """
    names = [one for side in (equation.left, equation.right) for one in name_nodes(side)]
    moving = {one.name for one in names} & {one.name for one in problem.coordinates}
    values = {x: value_of(given.get(x, ZERO)) for name in moving for x in (name, f"{name}'")}
    is_known = all(x in given and value is not None for x, value in values.items())
    if not is_known or any(one.primes or one.name in problem.definitions for one in names):
        return 0.0
    ends = []
    for step in (_STEP, -_STEP):
        state = {x: _exact(values[x]) + step * _exact(values[f"{x}'"]) for x in moving}
        put = {x: number(value) for x, value in {**state, "t": step}.items()}
        ends.append(_residual(equation, {**given, **put}))
    if ends[0] is None or ends[1] is None:
        return 0.0
    rate = (ends[0][0] - ends[1][0]) / float(2 * _STEP)
    size = sum(abs(float(_exact(values[f"{x}'"]))) for x in moving)
    return rate if abs(rate) > 1e-4 * size else 0.0


def _exact(value: Constant | None) -> Fraction:
    return Fraction(value or 0)


def _off(
    problem: Problem,
    message: str,
    equation: Equation,
    difference: str,
    given: Values,
    off: float,
    *,
    rate: bool,
) -> Diagnostic:
    """The warning at the last entry of `initial` with which the difference, or its rate, is 0."""

    def difference_at(name: str, value: float) -> float:
        changed = {**given, name: number(Fraction(value))}
        if rate:
            return _rate(problem, equation, changed)
        found = _residual(equation, changed)
        return math.nan if found is None else found[0]

    digits = 6 if rate else 12
    for entry, formula in reversed([*problem.initial.items()]):
        name, before = str(entry), value_of(given[str(entry)])
        if before is None or (rate and not entry.primes):
            continue
        value, steps = _root(partial(difference_at, name), float(before), off)
        if steps:
            more = ", or leave it out" if rate or steps == 1 else ""
            written = f"{round(value, digits) + 0:.{digits}g}"
            hint = f"{difference}: write {name}: {written}{more}"
            return Diagnostic(message, formula.span, hint, severity="warning")
    return Diagnostic(message, equation.span, difference, severity="warning")


def _root(function: Callable[[float], float], start: float, off: float) -> tuple[float, int]:
    """Where a function is 0 by Newton's method, and the number of its steps, 0 without a root."""
    value, left = start, off
    for step in range(1, _NEWTON):
        slope = (function(value + _DIFFERENCE) - function(value - _DIFFERENCE)) / (2 * _DIFFERENCE)
        if not abs(slope) > _FLAT:
            break
        value -= left / slope
        left = function(value)
        if abs(left) <= _ROUNDED * abs(off):
            return value, step
    return start, 0


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
