"""The whole way of a problem: text -> problem -> derivation -> statements -> output.

This is the one module that knows every stage.  No stage reaches back, and each is
imported when it is come to.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar
from unicodedata import normalize

from lagcli.diagnostics import NOWHERE, Diagnostic, ProblemError, Source
from lagcli.record import record, replace

if TYPE_CHECKING:
    from lagcli.document import Sentence
    from lagcli.formatters import Options
    from lagcli.mechanics.derivation import Derivation
    from lagcli.mechanics.stating import Stating
    from lagcli.notation.likeness import Key
    from lagcli.notation.manner import Manner
    from lagcli.problem_data import Problem
    from lagcli.statements.answers import Answers, Section
    from lagcli.statements.explanation import Explanation

#: Off only where the cost of verification is measured.
VERIFYING = True

Made = TypeVar("Made")


@record(kw_only=True)
class Request:
    """What is wanted of a problem.

    Attributes
    ----------
    sections : tuple of str or None
        Names of sections; None for the usual ones.
    settings : tuple of str
        Each `name=value`: what is put in for a parameter before anything is derived.
    state : tuple of str
        Each `x=value` or `x'=value`: what is put in for the state at t = 0.
    numeric : bool
        Put in the values of the file as well, and give decimal numbers.
    expand : bool
        Write the abbreviations of long answers out.
    abbreviate : bool
        Name what recurs in formulas of more than three lines; a system too large for formulas
        has abbreviations in any case.
    named : bool
        Keep definitions of the file by their names: mu for m1 m2/(m1 + m2), r for sqrt(x² + y²).
    """

    sections: tuple[str, ...] | None = None
    settings: tuple[str, ...] = ()
    state: tuple[str, ...] = ()
    numeric: bool = False
    expand: bool = False
    abbreviate: bool = False
    named: bool = False


@record
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
        What is wanted of it; `sections` do not matter here.
    """
    from lagcli.reader import read_problem

    reading, request = read_problem(name, data), request or Request()
    problem = reading.problem
    if problem is None or not (request.settings or request.state or request.numeric):
        return Read(reading.source, problem, reading.diagnostics)
    problem, mistakes = _with_values(problem, request)
    diagnostics = (*reading.diagnostics, *mistakes)
    return Read(reading.source, None if mistakes else problem, diagnostics)


def _with_values(problem: Problem, request: Request) -> tuple[Problem, list[Diagnostic]]:
    from lagcli.reader.settings import set_parameters, set_state
    from lagcli.values import parameters_with_values, with_values_of

    mistakes: list[Diagnostic] = []
    names: dict[str, None] = {}
    given = [("--set", set_parameters, setting) for setting in request.settings]
    given += [("--at", set_state, setting) for setting in request.state]
    for option, put_in, setting in given:
        try:
            problem = put_in(problem, [setting])
        except ProblemError as error:
            mistakes += [
                replace(found, message=f"{option} {setting}: {found.message}", span=NOWHERE)
                for found in error.diagnostics
            ]
        else:
            if option == "--set":
                names[normalize("NFC", setting.partition("=")[0].strip())] = None
    if request.numeric:
        names.update(dict.fromkeys(parameters_with_values(problem)))
    if mistakes:
        return problem, mistakes
    changed, wrong = with_values_of(problem, names)
    return changed, list(wrong)


def derive(problem: Problem, *, named: bool = False) -> Derivation:
    """Problem -> derivation; its parts are worked out at their first use.

    `named` makes parameters of definitions of constants.
    """
    from lagcli.mechanics.derivation import Derivation

    if named and problem.definitions:
        from lagcli.mechanics.named_definitions import with_named_constants

        problem = with_named_constants(problem)
    return Derivation(problem)


def state(derivation: Derivation, request: Request) -> Answers:
    """Derivation -> statements: the sections that are wanted.

    Raises
    ------
    ProblemError
        When the derivation finds that the problem cannot be meant: contradictory
        constraints, a constraint that is not linear in the velocities.
    TimeoutError
        When the equations take more work than they are allowed.
    """
    from lagcli.notation.manner import Manner
    from lagcli.rewriting import rewritten
    from lagcli.verification import verified

    answers = _ended(lambda: _statements(derivation)).answers(request.sections)
    if request.expand:
        from lagcli.abbreviations import written_out

        answers = written_out(answers)
    if request.named and derivation.given.definitions:
        answers = _with_roots(derivation.given, answers)
    manner = Manner(derivation.given)
    sections: dict[str, Section] = {}
    for name, section in answers.sections.items():
        sections[name] = _section_in_manner(manner, section)
        if one_way := manner.both_ways(sections[name]):
            sections[name] = _section_in_manner(manner, section, one_way)
    answers = replace(
        answers,
        sections=_with_words(derivation.given, sections),
        where=rewritten(answers.where, manner),
    )
    if request.abbreviate and not request.expand:
        from lagcli.abbreviations import abbreviated
        from lagcli.notation.given_formulas import names_of

        answers = abbreviated(answers, names_of(derivation.given))
    if VERIFYING:
        unverified = _with_charges(derivation, answers)
        problem = derivation.given if derivation.no_lagrangian else derivation.problem
        answers = _without_charges(request, _ended(lambda: verified(problem, unverified)))
    names = (*answers.coordinates, *answers.parameters, *answers.multipliers)
    answers = replace(answers, warnings=_with_formulas(answers.warnings, names))
    if not request.numeric:
        return _with_given_decimals(derivation.given, request, answers)
    from lagcli.notation.decimals import with_decimals

    return replace(
        answers,
        sections=rewritten(answers.sections, with_decimals),
        where=rewritten(answers.where, with_decimals),
    )


def _with_formulas(sentences: Sequence[str], names: Collection[str]) -> tuple[Sentence, ...]:
    """Sentences of the derivation, of which pages set the names and the formulas."""
    from lagcli.document import Sentence
    from lagcli.notation.letters import with_names
    from lagcli.reader.expressions import formula_or_none

    return tuple(Sentence.of(one, with_names(one, names, formula_or_none)) for one in sentences)


def _section_in_manner(
    manner: Manner, section: Section, one_way: Mapping[Key, int] | None = None
) -> Section:
    """A section as the file would write it; `one_way` as `Manner.both_ways` gives it."""
    from lagcli.rewriting import parts_in, rewritten
    from lagcli.statements.answers import CanonicalSection
    from lagcli.statements.motions import Above

    manner.anew(one_way)
    for each in parts_in(section, Above):
        manner.expect(each.left, each.right)
    if isinstance(section, CanonicalSection):  # the brackets of q' occur in p' as they are
        rewritten(tuple(pair.q for pair in (section.equations or {}).values()), manner)
    return rewritten(section, manner)


def _with_roots(problem: Problem, answers: Answers) -> Answers:
    """With r for sqrt(x² + y²) and mu for m1 m2/(m1 + m2), where the file defines them so."""
    from lagcli.mechanics.named_definitions import by_names
    from lagcli.notation.letters import names_in

    sections = by_names(problem, answers.sections)
    if sections is answers.sections:
        return answers
    used = names_in(sections)
    named = {name: node for name, node in problem.definitions.items() if name in used}
    return replace(answers, sections=sections, named={**answers.named, **named})


def _with_charges(derivation: Derivation, answers: Answers) -> Answers:
    """With the discovered charges, of which the algebra is made, where they are not wanted."""
    if "algebra" not in answers.sections or "discovered" in answers.sections:
        return answers
    charges = _ended(lambda: _statements(derivation)).answers(("discovered",)).sections
    return replace(answers, sections={**answers.sections, **charges})


def _without_charges(request: Request, answers: Answers) -> Answers:
    if "discovered" in (request.sections or ()):
        return answers
    sections = {name: each for name, each in answers.sections.items() if name != "discovered"}
    return replace(answers, sections=sections)


def _with_words(problem: Problem, sections: Mapping[str, Section]) -> Mapping[str, Section]:
    """The reason of the energy without the letters that mean something else in the file."""
    from lagcli.notation.given_formulas import names_of
    from lagcli.notation.letters import sentence
    from lagcli.statements.answers import EnergySection

    energy = sections.get("energy")
    if not isinstance(energy, EnergySection):
        return sections
    reason = sentence(energy.reason, names_of(problem))
    return {**sections, "energy": replace(energy, reason=reason)}


def _with_given_decimals(problem: Problem, request: Request, answers: Answers) -> Answers:
    """981/500 as 1.962, where 9.81 was given."""
    from lagcli.notation.given_formulas import decimals_of

    given = decimals_of(problem, request.settings)
    if not given:
        return answers
    from lagcli.notation.decimals import GivenDecimals
    from lagcli.rewriting import rewritten

    write = GivenDecimals(given)
    return replace(
        answers, sections=rewritten(answers.sections, write), where=rewritten(answers.where, write)
    )


def with_lagrangian(problem: Problem) -> Problem:
    """The problem with the Lagrangian that follows from the H it gives, if it gives one.

    Raises
    ------
    ProblemError
        When that H has no Lagrangian.
    """
    if problem.hamiltonian is None:
        return problem
    from lagcli.mechanics.from_hamiltonian import with_lagrangian as transformed

    return transformed(problem)


def explain(
    derivation: Derivation, also: Sequence[str] = (), *, named: bool = False
) -> Explanation:
    """Derivation -> its account, step by step, and the requested further steps.

    `named` keeps r for sqrt(x² + y²), where the file defines r so.

    Raises
    ------
    ProblemError
        When the derivation finds that the problem cannot be meant.
    """
    if derivation.no_lagrangian:
        from lagcli.mechanics.explaining.from_hamiltonian import explanation_from_hamiltonian

        return _ended(lambda: explanation_from_hamiltonian(derivation, also))
    large = derivation.large_form
    if large is not None:
        from lagcli.mechanics.explaining.large import explanation_of_large

        return _in_the_manner(derivation, _confirmed(derivation, explanation_of_large(large), ()))
    from lagcli.mechanics.explaining.explain import explanation

    account = _ended(lambda: explanation(derivation, also), 1 + bool(also))
    if named and derivation.given.definitions:
        from lagcli.mechanics.named_definitions import steps_by_names

        account = replace(account, steps=steps_by_names(derivation.given, account.steps))
    return _in_the_manner(derivation, _confirmed(derivation, account, also))


#: The sections whose answers a step of an explanation derives.
_STEPS: Mapping[str, tuple[str, ...]] = {
    "The Lagrangian": ("lagrangian",),
    "Lagrange's equations": ("equations",),
    "The multipliers are eliminated": ("accelerations", "multipliers"),
    "The accelerations": ("accelerations",),
    "The verification": ("accelerations", "multipliers"),
    "What the multipliers mean": ("multipliers", "constraint_forces"),
    "The energy": ("energy",),
    "Conserved quantities": ("charges",),
}
_UNCONFIRMED = "This step is left out: its result was not confirmed at random states."


def _confirmed(derivation: Derivation, account: Explanation, also: Sequence[str]) -> Explanation:
    """The explanation without the steps whose answers are not confirmed in numbers."""
    from lagcli.document import Paragraph
    from lagcli.statements.explanation import ExplanationStep
    from lagcli.statements.registry import find_section
    from lagcli.verification import verified

    further = {
        one.title: (name,) for name in also if (one := find_section(name).explained) is not None
    }
    steps = {**_STEPS, **further}
    titles = [step.title for step in account.steps]
    names = tuple(dict.fromkeys(name for title in titles for name in steps.get(title, ())))
    if not VERIFYING or not names or derivation.no_lagrangian:
        return account
    derived = _with_charges(derivation, _ended(lambda: _statements(derivation)).answers(names))
    sound = _ended(lambda: verified(derivation.problem, derived))
    wrong = {name for name in names if sound.sections.get(name) != derived.sections.get(name)}
    if not wrong:
        return account
    left_out = (Paragraph((_UNCONFIRMED,)),)
    return replace(
        account,
        steps=tuple(
            ExplanationStep(step.title, left_out) if wrong & {*steps.get(step.title, ())} else step
            for step in account.steps
        ),
        warnings=(*account.warnings, *(w for w in sound.warnings if w not in derived.warnings)),
        complete=False,
    )


def _ended(work: Callable[[], Made], times: int = 1) -> Made:
    """What the work makes, if that takes no more than (some times) what a section is allowed.

    Raises
    ------
    TimeoutError
        If it does.
    """
    from lagcli.mechanics.stating import SECONDS, TOO_MUCH, UNITS
    from lagcli.platform.effort import OutOfWork
    from lagcli.platform.limited import limited

    try:
        return limited(work, times * UNITS, times * SECONDS)
    except OutOfWork:
        raise TimeoutError(TOO_MUCH) from None


def _in_the_manner(derivation: Derivation, account: Explanation) -> Explanation:
    """The explanation with its formulas as the file writes its own, and no letter twice."""
    from lagcli.abbreviations import in_steps
    from lagcli.notation.given_formulas import names_of
    from lagcli.notation.letters import names_in, sentence, settled
    from lagcli.notation.manner import Manner
    from lagcli.notation.relations import without_minuses
    from lagcli.rewriting import rewritten

    taken = names_of(derivation.given)
    manner = Manner(derivation.given)
    steps = rewritten(account.steps, manner)
    if one_way := manner.both_ways(steps):
        manner.anew(one_way)
        steps = rewritten(account.steps, manner)
    turned = (replace(each, blocks=without_minuses(each.blocks)) for each in steps)
    account = replace(account, steps=tuple(turned))
    if derivation.large_form is None:
        account = in_steps(account, taken)
    names = (*account.coordinates, *names_in(account.steps))
    said = _with_formulas([sentence(warning, taken) for warning in account.warnings], names)
    return replace(account, steps=settled(account.steps, taken), warnings=said)


def _statements(derivation: Derivation) -> Stating:
    if derivation.no_lagrangian:
        from lagcli.mechanics.phase_space_statements import PhaseSpaceStatements

        return PhaseSpaceStatements(derivation)
    large = derivation.large_form
    if large is not None:
        from lagcli.mechanics.large_statements import LargeStatements

        return LargeStatements(large)
    from lagcli.mechanics.statements import Statements

    return Statements(derivation)


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
        raise LookupError(formatter.message)  # noqa: TRY004 - a name, not a type
    return formatter(answers, options)
