"""Numbers in place of parameters: `--set` and the values that a file gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from difflib import get_close_matches

from lagcli.decimals import Constant, value_of
from lagcli.diagnostics import Diagnostic
from lagcli.expression import Diff, Expression, Name, Power, Quotient, walk
from lagcli.problem import Parameter, Problem, Question, Rewrite, Where
from lagcli.rewriting import rebuilt, rewritten

Values = Mapping[str, Expression]


def values_of_file(problem: Problem) -> dict[str, Expression]:
    """The values that the file gives, but for parameters that a `find` solves for."""
    unknown = {q.unknown.name for q in problem.find if isinstance(q, Where)}
    return {
        parameter.name: parameter.value
        for parameter in problem.parameters
        if parameter.value is not None and parameter.name not in unknown
    }


def with_values(problem: Problem, values: Values) -> tuple[Problem, tuple[Diagnostic, ...]]:
    """Put values in for parameters, which are then no longer parameters of the problem.

    Parameters
    ----------
    values
        Parameter -> a number, or an expression of other parameters.

    Returns
    -------
    problem, diagnostics
        The problem is unchanged when there are diagnostics.
    """
    mistakes = [*_wrong_names(problem, values)]
    resolved: dict[str, Expression] = {}
    if not mistakes:
        mistakes += _resolve(values, resolved)
    if not mistakes:
        mistakes += _wrong_numbers(problem, resolved)
    if mistakes or not values:
        return problem, tuple(mistakes)
    put_in = _substitution(resolved)
    remaining = tuple(p for p in problem.parameters if p.name not in resolved)
    questions = tuple(_question(question, resolved, put_in) for question in problem.find)
    changed = rewritten(replace(problem, parameters=remaining, find=()), put_in)
    changed = replace(changed, find=questions)
    return changed, tuple(_undefined(problem, changed))


def _substitution(values: Values) -> Callable[[Expression], Expression]:
    def put_in(node: Expression) -> Expression:
        if isinstance(node, Name):
            return values.get(node.name, node)
        return rebuilt(node, put_in)

    return put_in


def _question(
    question: Question, values: Values, put_in: Callable[[Expression], Expression]
) -> Question:
    """The question with values in it; what it is put in terms of keeps only names."""
    if isinstance(question, Rewrite):
        names = tuple(n for n in question.in_terms_of if n.name not in values)
        return replace(question, value=put_in(question.value), in_terms_of=names)
    return replace(question, equation=rewritten(question.equation, put_in))


def _wrong_names(problem: Problem, values: Values) -> list[Diagnostic]:
    parameters = [p.name for p in problem.parameters]
    coordinates = {c.name for c in problem.coordinates}
    unknowns = {q.unknown.name for q in problem.find if isinstance(q, Where)}
    variables = _differentiated_by(problem)
    mistakes = []
    for name, value in values.items():
        if name not in parameters:
            what = "a coordinate, not a parameter" if name in coordinates else "no parameter"
            mistakes.append(_mistake(f"'{name}' is {what}", name, parameters))
        elif name in unknowns:
            mistakes.append(Diagnostic(f"'{name}' has no value to set: a `find` solves for it"))
        elif name in variables:
            mistakes.append(Diagnostic(f"'{name}' has no value to set: a `diff` is taken by it"))
        used = {n.name: n for n in walk(value) if isinstance(n, Name) and n.name != "pi"}
        mistakes += [
            _mistake(f"the value of '{name}' uses '{other}', which is no parameter", str(n), parameters)
            for other, n in used.items()
            if other not in parameters or n.primes
        ]
    return mistakes


def _mistake(message: str, word: str, known: list[str]) -> Diagnostic:
    close = get_close_matches(word, known, n=1)
    hint = f"did you mean '{close[0]}'?" if close else f"parameters: {', '.join(known) or 'none'}"
    return Diagnostic(message, hint=hint)


def _differentiated_by(problem: Problem) -> set[str]:
    names: set[str] = set()

    def look(node: Expression) -> Expression:
        names.update(part.variable.name for part in walk(node) if isinstance(part, Diff))
        return node

    rewritten(problem, look)
    return names


def _resolve(values: Values, resolved: dict[str, Expression]) -> list[Diagnostic]:
    """Fill `resolved` with the values in terms of parameters that have none."""
    open_names: list[str] = []
    cycles: list[Diagnostic] = []

    def resolve(node: Expression) -> Expression:
        if not isinstance(node, Name) or node.name not in values:
            return node if isinstance(node, Name) else rebuilt(node, resolve)
        name = node.name
        if name in open_names:
            if not cycles:
                circle = " -> ".join([*open_names[open_names.index(name) :], name])
                cycles.append(Diagnostic(f"the values go in a circle: {circle}"))
            return node
        if name not in resolved:
            open_names.append(name)
            resolved[name] = resolve(values[name])
            open_names.pop()
        return resolved[name]

    for name in values:
        resolve(Name(name))
    return cycles


_BREAKS: dict[str, Callable[[Constant], bool]] = {
    "positive": lambda value: value <= 0,
    "nonnegative": lambda value: value < 0,
    "nonzero": lambda value: value == 0,
    "negative": lambda value: value >= 0,
    "real": lambda _: False,
}


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
    if _BREAKS[parameter.assume](value):
        return Diagnostic(f"'{parameter.name}' is {parameter.assume}, and its value is not")
    if parameter.integer and value != int(value):
        return Diagnostic(f"'{parameter.name}' is an integer, and its value is not")
    return None


def _undefined(before: Problem, after: Problem) -> list[Diagnostic]:
    """Divisions by zero that the values have made; the file alone has none of them."""
    places: list[Expression] = []

    def look(node: Expression) -> Expression:
        for part in walk(node):
            match part:
                case Quotient(denominator=below) if _is_zero(below):
                    places.append(below)
                case Power(base=base, exponent=exponent) if _is_zero(base):
                    places.extend([base] if _is_negative(exponent) else [])
                case _:
                    pass
        return node

    rewritten(replace(after, expect=before.expect), look)
    return [Diagnostic("with these values something is divided by zero", places[0].span)] if (
        places
    ) else []


def _is_zero(node: Expression) -> bool:
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
