"""The answers to the questions of the file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING

from lagcli.document import Block, Equations, Formula, Heading, Label, Paragraph, Row, equations_of
from lagcli.expression import Expression, Name
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import Object, fields_of, list_or_null
from lagcli.problem_data import (
    Expect,
    Inequality,
    Lasting,
    Problem,
    Question,
    Reaching,
    Rewrite,
    Where,
)
from lagcli.reader.nodes import DocumentNode
from lagcli.reader.nodes import Sequence as ListNode
from lagcli.reader.schema_parts import ONE_OR_MORE
from lagcli.reader.schema_parts import map_of as names_to
from lagcli.reader.scope import ANSWER, CONSTANTS
from lagcli.record import replace
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Expected, Explained, declared, step
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

if TYPE_CHECKING:
    from lagcli.mechanics.large_statements import LargeStatements
    from lagcli.mechanics.statements import Statements
    from lagcli.reader.expectations import ExpectReader
    from lagcli.reader.file_reader import FileReader
    from lagcli.studies.check.expectations import Expectations, Found
    from lagcli.studies.check.findings import Finding

_SIGNS = {">=": " ≥ ", ">": " > ", "<=": " ≤ ", "<": " < "}
_TURNED = {">=": " ≤ ", ">": " < "}


def derive(statements: Statements) -> FindSection:
    """From the solved motion and what is conserved."""
    from lagcli.mechanics.finding.find import answer_questions

    section = _with_proofs(
        statements.problem, answer_questions(statements.dynamics, statements.derivation.noether)
    )
    return statements.noted((section, section.unanswered))


def _with_proofs(problem: Problem, section: FindSection) -> FindSection:
    """Where algebra gives no ranges, the answer for the values of the file."""
    answers = dict(section.answers)
    for question in problem.find:
        answer = answers[question.name]
        if isinstance(question, Lasting | Reaching) and isinstance(answer, Ranges):
            if answer.ranges is not None:
                continue
            from lagcli.studies.proved_answer import proved_answer

            found = proved_answer(problem, question)
            if isinstance(found, Proved):
                note = f"for which {answer.unknown} it is so was not found: {answer.note}"
                answers[question.name] = replace(answer, proved=found, note=note)
            elif found:
                answers[question.name] = replace(answer, note=f"{answer.note}; no proof: {found}")
    return FindSection(answers=answers)


def large(statements: LargeStatements) -> FindSection:
    """None is answered."""
    questions = statements.problem.find
    for question in questions:
        statements.lacks(f"the answer to '{question.name}'")
    return FindSection(answers={q.name: _unanswered(q, statements.why_missing) for q in questions})


def _unanswered(question: Question, why: str) -> Answer:
    if isinstance(question, Where):
        return Solutions(unknown=str(question.unknown), solutions=None, note=why)
    if isinstance(question, Rewrite):
        return Rewritten(value=None, note=why)
    return Ranges(unknown=str(question.unknown), ranges=None, note=why)


def blocks(section: FindSection, _: Answers) -> Iterator[Block]:
    """Say each question of the file with its answer."""
    if not section.answers:
        yield Paragraph(("The file asks none (under find).",))
    for name, answer in section.answers.items():
        yield Heading(name, 2)
        match answer:
            case Ranges(ranges=None, proved=Proved(sentence=sentence)):
                yield Paragraph((sentence,))
            case Solutions(solutions=None) | Ranges(ranges=None):
                yield Paragraph(("Not found.",))
            case Rewritten(value=None, values=()):
                yield Paragraph(("Not found.",))
            case Rewritten(values=tuple(values), subject=subject) if values:
                left = Label(name) if subject is None else subject
                yield equations_of((left, value) for value in values)
            case Solutions(solutions=()):
                yield Paragraph(("There is no solution that the motion can reach.",))
            case Solutions(unknown=unknown, solutions=tuple(solutions)):
                variable = unknown.rstrip("'")
                left = Name(variable, len(unknown) - len(variable))
                yield equations_of((left, root) for root in solutions)
            case Rewritten(value=value, subject=subject) if value is not None:
                yield Equations((Row(Label(name) if subject is None else subject, value),))
            case Ranges(unknown=unknown, ranges=tuple(ranges)):
                yield Paragraph(_ranges(unknown, ranges))
        yield from remark(answer)


def _ranges(unknown: str, ranges: Sequence[Range]) -> tuple[str | Formula, ...]:
    """`a < v ≤ b, or v ≥ c`."""
    if not ranges:
        return ("For no value of ", Name(unknown), ".")
    parts: list[str | Formula] = []
    for range_ in ranges:
        bounds = range_.bounds
        parts += [", or "] if parts else []
        if not bounds:
            return ("For every value of ", Name(unknown), ".")
        if range_.lower == range_.upper:
            bounds = [("=", bounds[0][1])]
        if len(bounds) == 2:
            parts += [bounds[0][1], _TURNED[bounds[0][0]]]
        how, bound = bounds[-1]
        parts += [Name(unknown), _SIGNS.get(how, " = "), bound]
    return (*parts, ".")


def json(section: FindSection) -> Object:
    """The answers by question."""
    return {"find": {name: _answer(answer) for name, answer in section.answers.items()}}


def _answer(answer: Answer) -> Object:
    match answer:
        case Solutions():
            return fields_of(answer, "solutions")
        case Ranges(unknown=unknown, ranges=ranges, proved=proved):
            found = {"ranges": list_or_null(ranges, lambda each: _range(unknown, each))}
            return (
                found
                if proved is None
                else {**found, "proved": fields_of(proved, "holds until at sentence")}
            )
        case Rewritten():
            return fields_of(answer, "value values" if answer.values else "value")


def _range(unknown: str, range_: Range) -> list[str]:
    return [f"{unknown} {how} {to_grammar(bound)}" for how, bound in range_.bounds]


def read(reader: ExpectReader, node: DocumentNode) -> dict[str, tuple[Expression, ...]]:
    """The answers by question; ranges are kept beside them."""
    found = {}
    for key, value in reader.known(node, ("find",), list(reader.questions), "question"):
        items = value.items if isinstance(value, ListNode) else [value]
        what = f"the expected answer to '{key.label}'"
        question = reader.questions[key.label]
        if isinstance(question, Lasting | Reaching):
            reader.ranges[key.label] = tuple(
                _bounds(reader.file, item, question.unknown, what) for item in items
            )
            continue
        found[key.label] = tuple(reader.file.expression(item, what, ANSWER) for item in items)
    return found


def _bounds(
    file: FileReader, node: DocumentNode, unknown: Name, what: str
) -> tuple[Inequality, ...]:
    """One range: `v <= a`, or a list of bounds, `[v > b, v < c]`."""
    found = []
    for each in node.items if isinstance(node, ListNode) else [node]:
        bound = file.comparison(each, what, CONSTANTS)
        if bound is not None and bound.left != unknown:
            file.error(f"{what} is a bound of {unknown}", each.span, f"write {unknown} >= 0")
        elif bound is not None:
            found.append(bound)
    return tuple(found)


def compare(
    check: Expectations, section: FindSection, expected: Mapping[str, Sequence[Expression]]
) -> Found:
    """Each answer is the same, as a set where there are several; so is each range."""
    for name, wanted in expected.items():
        yield _compared(check, ["find", name], section.answers.get(name), wanted)
    for name, bounds in check.expect.ranges.items():
        answer = section.answers[name]
        assert isinstance(answer, Ranges)
        yield _compared_ranges(check, ["find", name], answer, bounds)


def _compared(
    check: Expectations, path: list[str], answer: Answer | None, expected: Sequence[Expression]
) -> Finding | None:
    found: Sequence[Expression] | None = None
    if isinstance(answer, Solutions):
        if answer.solutions is None:
            return check.undecided(path, answer.note or "no answer")
        found = answer.solutions
    elif isinstance(answer, Rewritten) and answer.values:
        found = answer.values
    if found is None:
        value = answer.value if isinstance(answer, Rewritten) else None
        return check.compare(path, value, expected[0])
    verdict = check.comparison.same_set(found, expected)
    return check.judge(path, verdict, check.listed(expected), check.listed(found))


def _compared_ranges(
    check: Expectations, path: list[str], answer: Ranges, expected: Sequence[Sequence[Inequality]]
) -> Finding | None:
    from lagcli.studies.check.ranges import in_words, same_ranges

    if answer.ranges is None:
        return check.undecided(path, answer.note)
    verdict = same_ranges(answer.ranges, expected, check.comparison.equal)
    wanted = [[(each.comparison, each.right) for each in bounds] for bounds in expected]
    return check.judge(path, verdict, in_words(wanted), in_words([r.bounds for r in answer.ranges]))


def expects(expect: Expect) -> bool:
    """Whether the file states an answer."""
    return bool(expect.find or expect.ranges)


SECTION = declared(
    globals(),
    heading="Questions",
    order=170,
    by_default=attrgetter("find"),
    explained=Explained(title="Questions", blocks=step("questions:questions"), order=10),
    content="answers",
    abbreviated=True,
    expected=(
        Expected(
            key="find", schema=names_to(ONE_OR_MORE), read=read, compare=compare, wanted=expects
        ),
    ),
)
