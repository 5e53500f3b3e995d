"""The whole way of a problem: text -> problem -> derivation -> statements -> output.

This is the one module that knows every stage.  No stage reaches back, and each is
imported when it is come to.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

from lagcli.diagnostics import Diagnostic, ProblemError, Source

if TYPE_CHECKING:
    from os import PathLike

    from lagcli.answers import Answers
    from lagcli.expression import Expression
    from lagcli.formatters import Options
    from lagcli.mechanics.derivation import Derivation
    from lagcli.problem import Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """What is wanted of a problem.

    Attributes
    ----------
    sections : tuple of str or None
        Out of `lagcli.answers.SECTIONS`; None for the usual ones.
    values : mapping of str to Expression
        Parameter -> what is put in for it before anything is derived.
    numeric : bool
        Put in the values of the file as well, and give decimal numbers.
    """

    sections: tuple[str, ...] | None = None
    values: Mapping[str, Expression] = field(default_factory=dict)
    numeric: bool = False


@dataclass(frozen=True, slots=True)
class Read:
    """What came of one file: a problem, or none and the diagnostics that say why."""

    source: Source
    problem: Problem | None
    diagnostics: tuple[Diagnostic, ...]


def read(name: str, data: bytes, request: Request | None = None) -> Read:
    """Text -> problem, with the values of the request put in.

    Parameters
    ----------
    name
        The file's name in diagnostics; `-` is standard input.
    data
        The file's bytes.
    request
        What is wanted of it; only `values` and `numeric` matter here.
    """
    from lagcli.reader import read_problem

    reading = read_problem(name, data)
    problem, request = reading.problem, request or Request()
    if problem is None or not (request.values or request.numeric):
        return Read(reading.source, problem, reading.diagnostics)
    from lagcli.values import values_of_file, with_values

    own = values_of_file(problem) if request.numeric else {}
    problem, mistakes = with_values(problem, {**own, **request.values})
    diagnostics = (*reading.diagnostics, *mistakes)
    return Read(reading.source, None if mistakes else problem, diagnostics)


def derive(problem: Problem) -> Derivation:
    """Problem -> derivation; its parts are worked out when they are asked for."""
    from lagcli.mechanics.derivation import Derivation

    return Derivation(problem)


def state(derivation: Derivation, request: Request) -> Answers:
    """Derivation -> statements: the sections that are wanted.

    Raises
    ------
    ProblemError
        When the derivation finds that the problem cannot be meant: contradictory
        constraints, a constraint that is not linear in the velocities.
    """
    from lagcli.mechanics.statements import Statements

    answers = Statements(derivation).answers(request.sections)
    if not request.numeric:
        return answers
    from lagcli.decimals import with_decimals
    from lagcli.rewriting import rewritten

    return replace(answers, sections=rewritten(answers.sections, with_decimals))


def render(answers: Sequence[Answers], format_name: str, options: Options) -> str:
    """Statements -> output.

    Raises
    ------
    LookupError
        When there is no such format.
    """
    from lagcli.formatters.registry import UnknownFormatter, find_formatter

    formatter = find_formatter(format_name)
    if isinstance(formatter, UnknownFormatter):
        raise LookupError(formatter.message)
    return formatter(answers, options)


# -- for programs that use lagcli as a library ------------------------------------------


def load(path: str | PathLike[str]) -> Problem:
    """Read a problem file.

    Raises
    ------
    OSError
        When the file cannot be read.
    ProblemError
        When it is no problem; carries every diagnostic.

    Examples
    --------
    >>> problem = load("problems/hoop.yaml")  # doctest: +SKIP
    """
    found = read(str(path), Path(path).read_bytes())
    if found.problem is None:
        raise ProblemError(found.source, found.diagnostics)
    return found.problem


def solve(problem: Problem, sections: Sequence[str] | None = None) -> Answers:
    """Derive and state what the sections say of a problem, each answer verified.

    Parameters
    ----------
    problem
        As `load` gives it.
    sections
        Out of `lagcli.answers.SECTIONS`; the usual ones when None.

    Raises
    ------
    ProblemError
        When the constraints cannot be used.

    Examples
    --------
    >>> answers = solve(load("problems/hoop.yaml"), ["accelerations"])  # doctest: +SKIP
    """
    wanted = None if sections is None else tuple(sections)
    return state(derive(problem), Request(sections=wanted))
