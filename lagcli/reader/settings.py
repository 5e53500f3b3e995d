"""`--set name=value` and `--at x=value`: parameters and the state from the command line."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence
from typing import NoReturn

from lagcli.diagnostics import NOWHERE, Diagnostic, ProblemError, Source
from lagcli.expression import Expression, Name
from lagcli.problem_data import Problem
from lagcli.reader.by_coordinate import state_meant
from lagcli.reader.columns import check_units
from lagcli.reader.constants import value_cycle
from lagcli.reader.expressions import read_expression, read_or_raise
from lagcli.reader.names import name_mistakes
from lagcli.reader.number_units import unit_mistake
from lagcli.reader.positions import Excerpt
from lagcli.reader.scope import VALUES, Scope
from lagcli.reader.suggest import did_you_mean
from lagcli.reader.text import SourceText
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
    start = len(written) + 1

    def refuse(message: str, hint: str, begin: int = 0, end: int = 0) -> NoReturn:
        raise ProblemError(source, (Diagnostic(message, text.span(begin, end), hint),))

    if not equals:
        apart = re.fullmatch(r"\s*([^\W\d]\w*)('*)\s*(?:[: ]\s*(\S+)\s*)?", written)
        hint = "write name=value"
        if apart is not None:
            whole = f"{apart[1]}{apart[2]}={apart[3] or '1'}"
            hint = f"write {option} " + (f'"{whole}"' if apart[2] else whole)
        refuse("an '=' is missing", hint)
    if re.search(r"[,;]\s*[^\W\d]\w*'*\s*=", value):
        each = " ".join(f"{option} {part.strip()}" for part in re.split("[,;]", source.text))
        refuse("one option sets one value", f"write {each}")
    if name not in names:
        known = f"known are {', '.join(names)}" if names else "the file declares none"
        meant = state_meant(name, [x for x in names if kind != "parameter" and x[-1] != "'"])
        hint = f'write {option} "{meant}={value}"' if meant else did_you_mean(name, names) or known
        refuse(f"there is no {kind} '{name}'", hint, 0, len(written))
    if mistake := unit_mistake(value, scope.kinds):
        refuse(*mistake, len(source.text) - len(value.lstrip()), len(source.text))
    offsets = range(start, len(source.text) + 1)
    expression = read_or_raise(Excerpt(value, text, offsets), read_expression)
    mistakes = [*name_mistakes(expression, scope, VALUES, f"the value of '{name}'")]
    if mistakes:
        raise ProblemError(source, tuple(mistakes))
    check_units(problem, source, expression, name)
    return name, expression


def _placeless(value: Expression) -> Expression:
    """The value without its places: they are not those of the file."""
    return replace(rebuilt(value, _placeless), span=NOWHERE)
