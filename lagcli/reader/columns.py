"""What `simulate --show` and its other options write: expressions of a read problem."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import starmap
from typing import NamedTuple

from lagcli.diagnostics import Diagnostic, ProblemError, Source
from lagcli.expression import Diff, Expression, Name, Negative, Product, Sum, name_nodes
from lagcli.problem_data import JACOBI_FUNCTION, Constraint, Contact, Problem, Symmetry, charge_of
from lagcli.reader.assignments import pieces
from lagcli.reader.expressions import read_expression, read_or_raise
from lagcli.reader.names import depends_on_time, derivative_order, name_mistakes
from lagcli.reader.number_units import run_mistake
from lagcli.reader.positions import Excerpt
from lagcli.reader.scope import ALONG, NUMBERS, Definition, Role, Scope
from lagcli.reader.suggest import did_you_mean


class Column(NamedTuple):
    """A name and what stands under it; None is the time."""

    name: str
    expression: Expression | None


#: Words that stand for several columns.
GROUPS = (
    "coordinates", "velocities", "accelerations", "multipliers", "constraint_forces", "momenta",
    "charges",
)  # fmt: skip
_ENERGY = "energy"


def read_columns(problem: Problem, words: Sequence[str]) -> list[Column]:
    """The columns of `--show a,b,c`, the time first; `ProblemError` at the first that is none."""
    scope = scope_of(problem)
    shown = {"t": Column("t", None)}
    for word in pieces_of(words):
        for column in _columns(problem, scope, word):
            if column.expression is not None and not isinstance(column.expression, Name):
                check_units(problem, Source(f"--show {word}", word), column.expression)
            shown[column.name] = column
    return list(shown.values())


def pieces_of(words: Sequence[str]) -> list[str]:
    """The pieces of `--show a,b,c --show d`."""
    return [piece for text in words for piece in map(str.strip, pieces(text, ","))]


def usual_columns(problem: Problem) -> list[Column]:
    """t, the coordinates and the velocities."""
    names = [Name(c.name, primes) for primes in (0, 1) for c in problem.coordinates]
    return [Column("t", None), *(Column(str(name), name) for name in names)]


def phase_columns(coordinate: str) -> list[Column]:
    """q and q'."""
    return [Column(str(name), name) for name in (Name(coordinate), Name(coordinate, 1))]


def read_along(problem: Problem, text: str, option: str) -> Expression:
    """An expression along the motion, such as that of `--stop-when`."""
    left, equals, right = (each.strip() for each in text.replace("==", "=").partition("="))
    if equals:
        zero = right if re.fullmatch(r"[\w.*/^]*", right) else f"({right})"
        hint = f"write {left if zero in {'', '0'} else f'{left} - {zero}'}"
        mistake = Diagnostic("the function that is 0 is written without '='", hint=hint)
        raise ProblemError(Source(option, ""), (mistake,))
    return _read(text, option, scope_of(problem), ALONG)


def read_number(text: str, option: str) -> Expression:
    """An expression without names, such as `2*pi`."""
    if mistake := run_mistake(text, option):
        raise ProblemError(Source(option, ""), (Diagnostic(mistake[0], hint=mistake[1]),))
    return _read(text, option, Scope(), NUMBERS)


def scope_of(problem: Problem) -> Scope:
    """The names of a problem that has been read, and `energy` where it is free."""
    scope = Scope(arguments={name: [*given] for name, given in problem.functions.items()})
    scope.kinds.update({c.name: "coordinate" for c in problem.coordinates})
    scope.kinds.update({p.name: "parameter" for p in problem.parameters})
    scope.kinds.update(dict.fromkeys(problem.functions, "function"))
    scope.kinds.update({c.multiplier: "multiplier" for c in problem.constraints})
    scope.kinds.update({c.multiplier: "contact force" for c in problem.contacts})
    scope.kinds.update(dict.fromkeys(problem.definitions, "definition"))
    for place, (name, formula) in enumerate(problem.definitions.items()):
        scope.definitions[name] = Definition(
            place, derivative_order(formula, scope), depends_on_time(formula, scope)
        )
    scope.kinds.setdefault(_ENERGY, "multiplier")
    return scope


def _columns(problem: Problem, scope: Scope, word: str) -> Iterator[Column]:
    """What one word of `--show` stands for."""
    if word in GROUPS and word not in scope.kinds:
        yield from _group(problem, word)
        return
    named = named_columns(scope, _holding(problem), problem.symmetries)
    if word in named:
        yield Column(word, named[word])
        return
    try:
        expression = _read(word, "--show", scope, ALONG)
    except ProblemError as error:
        hint = did_you_mean(word, [*named, *GROUPS])
        if not hint or word in scope.kinds:
            raise
        [first, *_] = error.diagnostics
        message = f"there is no column '{word}'"
        raise ProblemError(error.source, (Diagnostic(message, first.span, hint),)) from None
    yield Column(word, None if expression == Name("t") else expression)


def check_units(problem: Problem, source: Source, expression: Expression, name: str = "") -> None:
    """The terms of a column have one unit, where the file gives units; a value that of its name.

    A number alone has it anyway.
    """
    quantities = (*problem.coordinates, *problem.parameters)
    if expression.span.line < 1 or all(each.unit is None for each in quantities):
        return  # made from the file's own, or without units
    from lagcli.dimensions.check import check_formula

    if mistakes := check_formula(problem, expression, source.text, name):
        raise ProblemError(source, tuple(mistakes))


def _group(problem: Problem, word: str) -> Iterator[Column]:
    orders = {"coordinates": 0, "velocities": 1, "accelerations": 2}
    match word:
        case "multipliers":
            yield from (Column(c.multiplier, Name(c.multiplier)) for c in _holding(problem))
        case "constraint_forces":
            yield from starmap(
                Column, named_columns(scope_of(problem), _holding(problem), ()).items()
            )
        case "charges":
            taken = scope_of(problem).kinds.keys() - {_ENERGY}
            yield Column(_ENERGY, JACOBI_FUNCTION)
            for symmetry in problem.symmetries:
                if symmetry.name not in taken | {_ENERGY}:
                    yield Column(symmetry.name, charge_of(symmetry))
        case "momenta":
            yield from (Column(f"p_{c.name}", Name(f"p_{c.name}")) for c in problem.coordinates)
        case _:
            for coordinate in problem.coordinates:
                name = Name(coordinate.name, orders[word])
                yield Column(str(name), name)


def _holding(problem: Problem) -> tuple[Constraint | Contact, ...]:
    """What has a multiplier."""
    return (*problem.constraints, *problem.contacts)


def named_columns(
    scope: Scope, holding: Iterable[Constraint | Contact], symmetries: Iterable[Symmetry]
) -> dict[str, Expression]:
    """What is no expression: `rod.x`, a constraint's force along a coordinate, and charges.

    The force is lambda df/dq, or lambda df/dq' of a velocity constraint.
    """
    found: dict[str, Expression] = {}
    for each in holding:
        f = Sum((each.equation.left, Negative(each.equation.right)))
        primes = max(derivative_order(f, scope), 0)
        for coordinate in scope.coordinates:
            slope = Diff(f, Name(coordinate, primes))
            found[f"{each.name}.{coordinate}"] = Product((Name(each.multiplier), slope))
    for symmetry in symmetries:
        if symmetry.name not in scope.kinds:
            found[symmetry.name] = charge_of(symmetry)
    return found


def _read(text: str, option: str, scope: Scope, role: Role) -> Expression:
    source = Source(f"{option} {text}", text)
    expression = read_or_raise(Excerpt.whole(source), read_expression)
    mistakes = tuple(name_mistakes(expression, scope, role, option))
    if mistakes:
        raise ProblemError(source, mistakes)
    shown = {node.name for node in name_nodes(expression) if node.primes}
    if _ENERGY in shown and scope.kinds[_ENERGY] == "multiplier":
        raise ProblemError(source, (Diagnostic("the energy has no primes", expression.span),))
    return expression
