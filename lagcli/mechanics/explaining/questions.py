"""How the questions of the file are answered."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from lagcli.document import Block, Equations, Heading, Row, equations_of
from lagcli.expression import ZERO, Expression, Name
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, difference, listed, says, shows
from lagcli.mechanics.finding.along_the_motion import AlongTheMotion
from lagcli.problem_data import Lasting, Question, Reaching, Rewrite, Where
from lagcli.statements.answers import Section
from lagcli.statements.questions import (
    Answer,
    FindSection,
    Proved,
    Range,
    Ranges,
    Rewritten,
    Solutions,
)
from lagcli.statements.wording import remark

_COMPARISONS = {"<": " < ", "<=": " ≤ ", ">": " > ", ">=": " ≥ "}


def questions(explainer: Explainer, section: Section) -> Iterator[Block]:
    """Each question, the substitutions, and its answer."""
    answers = cast(FindSection, section).answers
    if not answers:
        yield says("The file has no questions.")
        return
    along = AlongTheMotion(explainer.dynamics, explainer.derivation.noether)
    yield from _known(explainer, along)
    for question in explainer.problem.find:
        yield Heading(question.name, 2)
        yield says(*_asked(question))
        yield from _on_the_way(explainer, along, question)
        is_open = (
            isinstance(question, Where) and question.unknown.name not in explainer.system.names
        )
        yield from _answer(answers[question.name], is_open=is_open or along.initial is None)


def _known(explainer: Explainer, along: AlongTheMotion) -> Iterator[Block]:
    equations = explainer.dynamics.constraints.equations
    constraints, are = ("constraints", "are") if len(equations) > 1 else ("constraint", "is")
    solved = "solved accelerations" + " and multipliers" * bool(equations)
    if along.initial is None:
        used = f"only the {solved}" + f" and the {constraints}" * bool(equations)
        yield says(f"The file gives no initial state, so {used} are used.")
        return
    laws = dict.fromkeys(along.tree(law) for law in along.level_set.laws)
    kept = (
        "and every conserved quantity keeps its initial value. So these are 0 on the motion:"
        if laws
        else "but no conserved quantity is known."
    )
    put_in = f"The {solved} are substituted" + f", the {constraints} {are} used" * bool(equations)
    yield says(f"{put_in}, {kept}")
    yield equations_of((ZERO, law) for law in laws)


def _asked(question: Question) -> list[Part]:
    match question:
        case Where(equation=equation, unknown=unknown):
            return ["For which ", unknown, " is ", equation.left, " = ", equation.right, "?"]
        case Rewrite(value=value, in_terms_of=terms):
            wanted = listed(terms) if terms else ["the parameters"]
            return ["What is ", value, " in terms of ", *wanted, " alone?"]
        case Lasting(condition=condition, unknown=unknown):
            comparison = _COMPARISONS[condition.comparison]
            holds: list[Part] = [condition.left, comparison, condition.right]
            return ["For which ", unknown, " is ", *holds, " at all times?"]
        case Reaching(coordinate=coordinate, value=value, unknown=unknown):
            return ["For which ", unknown, " does ", coordinate, " reach ", value, "?"]


def _on_the_way(explainer: Explainer, along: AlongTheMotion, question: Question) -> Iterator[Block]:
    """The quantity of the question on the motion, and the squared velocity, by one coordinate."""
    system = explainer.system
    if isinstance(question, Rewrite):
        return
    if isinstance(question, Reaching):
        sides: tuple[Expression, ...] = ()
        candidates = [system.symbol_of(question.coordinate.name)]
    else:
        asked = question.equation if isinstance(question, Where) else question.condition
        sides = (asked.left, asked.right)
        named = system.symbol_of(str(question.unknown))
        candidates = [named] if named in system.q else list(system.q)
    for u in candidates:
        rate = system.symbol_of(u.name + "'")
        square = along.rewritten(rate**2, [u]) if along.initial is not None else None
        formula = given = None
        if sides:
            given = system.build(sides[0]) - system.build(sides[1])
            formula = along.rewritten(given, [u])
        if square is None or square == 0 or (sides and formula is None):
            continue
        yield says("In terms of ", Name(u.name), " alone:")
        rows = [Row(along.tree(rate**2), along.tree(square))]
        if formula is not None and formula != given:
            rows.append(Row(_difference(sides), along.tree(formula)))
        yield Equations(tuple(rows))
        return


def _difference(sides: tuple[Expression, ...]) -> Expression:
    return sides[0] if sides[1] == ZERO else difference(sides[0], sides[1])


def _answer(answer: Answer, *, is_open: bool) -> Iterator[Block]:
    match answer:
        case Rewritten(values=tuple(values), subject=subject) if values:
            yield says("Its square is determined. It is one of")
            left = Name("value") if subject is None else subject
            yield equations_of((left, value) for value in values)
        case Ranges(ranges=None, proved=Proved(sentence=sentence)):
            yield says(sentence)
        case Solutions(solutions=None) | Rewritten(value=None) | Ranges(ranges=None):
            yield says(f"This was not found: {answer.note or 'there is no closed form'}.")
            return
        case Solutions(unknown=unknown, solutions=tuple(roots)):
            left = Name(unknown.rstrip("'"), len(unknown) - len(unknown.rstrip("'")))
            if roots:
                yield says("The solution is" if is_open else "Of its roots the motion reaches")
                yield equations_of((left, root) for root in roots)
            else:
                yield says("The motion reaches none of its roots.")
        case Rewritten(value=value, subject=subject) if value is not None:
            yield says("It is")
            yield shows(Name("value") if subject is None else subject, value)
        case Ranges(unknown=unknown, ranges=tuple(ranges)):
            at_the_start = "" if is_open else ", or a root coincides with the initial state"
            yield says(
                "The answer can change only at values of ",
                Name(unknown),
                f" for which two roots along the motion coincide{at_the_start}. One motion was "
                "examined at each of these values and one between neighbours. The condition "
                "holds for ",
                *_ranges(unknown, ranges),
                ".",
            )
    yield from remark(answer)


def _ranges(unknown: str, ranges: tuple[Range, ...]) -> list[Part]:
    if not ranges:
        return ["no value"]
    parts: list[Part] = []
    for each in ranges:
        parts += [" and for "] if parts else []
        bounds: list[Part] = []
        below, above = (" ≤ " if closed else " < " for closed in
                        (each.lower_included, each.upper_included))  # fmt: skip
        if each.lower is not None and each.upper is not None:
            bounds = [each.lower, below, Name(unknown), above, each.upper]
        elif each.lower is not None:
            bounds = [Name(unknown), " ≥ " if each.lower_included else " > ", each.lower]
        elif each.upper is not None:
            bounds = [Name(unknown), above, each.upper]
        parts += bounds or ["every value"]
    return parts
