"""`--set name=value` and `--at x=value`: parameters and the state from the command line."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence

from lagcli.diagnostics import NOWHERE, Diagnostic, ProblemError, Source
from lagcli.expression import Expression, Name
from lagcli.problem_data import Problem
from lagcli.reader.by_coordinate import state_meant
from lagcli.reader.constants import value_cycle
from lagcli.reader.expressions import read_expression
from lagcli.reader.names import name_mistakes
from lagcli.reader.number_units import unit_mistake
from lagcli.reader.positions import Excerpt
from lagcli.reader.scope import VALUES, Scope
from lagcli.reader.suggest import did_you_mean
from lagcli.reader.text import Mistake, SourceText
from lagcli.record import replace
from lagcli.rewriting import rebuilt

#: The primes of a velocity, as they may be typed.
_PRIMES = str.maketrans("’′", "''")


def set_parameters(problem: Problem, settings: Iterable[str]) -> Problem:
    """The problem with other values of its parameters, each `name=value`.

    Raises
    ------
    ProblemError
        At the first setting that names no parameter, or has no value.
    """
    scope = Scope(kinds={one.name: "parameter" for one in problem.parameters})
    values = {one.name: one.value for one in problem.parameters if one.value is not None}
    for setting in settings:
        source = Source(f"--set {setting}", setting)
        name, value = _read(problem, source, scope, tuple(scope.kinds), "parameter")
        values[name] = _placeless(value)
        cycle = value_cycle(values)
        if cycle is not None:
            raise ProblemError(source, (Diagnostic(cycle[1], value.span),))
    return problem.with_values(values)


def set_state(problem: Problem, settings: Iterable[str]) -> Problem:
    """The problem with another state at t = 0, `x=value` or `x'=value`; the rest stays as it was.

    Raises
    ------
    ProblemError
        At the first setting that names no coordinate or velocity, or has no value.
    """
    scope = Scope(kinds={one.name: "parameter" for one in problem.parameters})
    names = [Name(one.name, primes) for one in problem.coordinates for primes in (0, 1)]
    state = {str(name): name for name in names}
    initial = dict(problem.initial)
    for setting in settings:
        source = Source(f"--at {setting}", setting)
        name, value = _read(problem, source, scope, tuple(state), "coordinate or velocity")
        initial[state[name]] = _placeless(value)
    return replace(problem, initial=initial)


def _read(
    problem: Problem, source: Source, scope: Scope, names: Sequence[str], kind: str
) -> tuple[str, Expression]:
    """The name and the value of one setting; names are those of that kind."""
    text, option = SourceText.of(source), source.name.split()[0]
    written, equals, value = source.text.partition("=")
    name = unicodedata.normalize("NFC", written.strip()).translate(_PRIMES)
    if not equals:
        apart = re.fullmatch(r"\s*([^\W\d]\w*)('*)\s*(?:[: ]\s*(\S+)\s*)?", written)
        hint = "write name=value"
        if apart is not None:
            whole = f"{apart[1]}{apart[2]}={apart[3] or '1'}"
            hint = f"write {option} " + (f'"{whole}"' if apart[2] else whole)
        raise ProblemError(source, (Diagnostic("an '=' is missing", text.span(0, 0), hint),))
    if re.search(r"[,;]\s*[^\W\d]\w*'*\s*=", value):
        each = " ".join(f"{option} {part.strip()}" for part in re.split("[,;]", source.text))
        message = "one option sets one value"
        raise ProblemError(source, (Diagnostic(message, text.span(0, 0), f"write {each}"),))
    if name not in names:
        known = f"known are {', '.join(names)}" if names else "the file declares none"
        meant = state_meant(name, [x for x in names if kind != "parameter" and x[-1] != "'"])
        hint = f'write {option} "{meant}={value}"' if meant else did_you_mean(name, names) or known
        message = f"there is no {kind} '{name}'"
        raise ProblemError(source, (Diagnostic(message, text.span(0, len(written)), hint),))
    start = len(written) + 1
    offsets = range(start, len(source.text) + 1)
    if mistake := unit_mistake(value, scope.kinds):
        span = text.span(len(source.text) - len(value.lstrip()), len(source.text))
        raise ProblemError(source, (Diagnostic(mistake[0], span, mistake[1]),))
    try:
        expression = read_expression(Excerpt(value, text, offsets))
    except Mistake as error:
        raise ProblemError(source, error.diagnostics) from None
    what = f"the value of '{name}'"
    mistakes = tuple(name_mistakes(expression, scope, VALUES, what))
    if mistakes:
        raise ProblemError(source, mistakes)
    if any(one.unit is not None for one in (*problem.coordinates, *problem.parameters)):
        _check_unit(problem, source, name, expression)
    return name, expression


def _placeless(value: Expression) -> Expression:
    """The value without its places: they are not those of the file."""
    return replace(rebuilt(value, _placeless), span=NOWHERE)


def _check_unit(problem: Problem, source: Source, name: str, value: Expression) -> None:
    """A value has the unit of its parameter; a number alone has it anyway."""
    from lagcli.dimensions.check import check_formula

    mistakes = check_formula(problem, value, source.text, name)
    if mistakes:
        raise ProblemError(source, tuple(mistakes))
