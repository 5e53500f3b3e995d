"""The page of the answers to one file: each section as it is worded; how it is set comes later."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from lagcli.document import Block, Document, Heading, Paragraph
from lagcli.expression import Expression
from lagcli.notation.letters import names_in, settled, with_names
from lagcli.notation.naming import Names
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Declaration
from lagcli.statements.registry import in_order
from lagcli.statements.wording import listed, rows_by_name


def to_document(answers: Answers) -> Document:
    """Word the answers to one file, section by section."""
    given = (*answers.coordinates, *answers.parameters, *answers.multipliers)
    blocks: list[Block] = [_system(answers)]
    declared = in_order((*answers.sections, *answers.absent))
    worded = [(Heading(each.heading), *_worded(each, answers)) for each in declared]
    where = _used(answers.where, names_in(worded)) if answers.where else {}
    listed_at = next(
        (section for section in worded if where and names_in(section) & set(where)), ()
    )
    if named := _used(answers.named, names_in(worded) | names_in(where)) if answers.named else {}:
        blocks += [Heading("Definitions"), rows_by_name(named)]
    for section in worded:
        if section is listed_at:
            blocks += [Heading("Abbreviations"), rows_by_name(where)]
        blocks += section
    if answers.warnings:
        blocks.append(Heading("Warnings"))
        blocks.extend(Paragraph(with_names(warning, given)) for warning in answers.warnings)
    page = Document(answers.title, tuple(blocks), answers.coordinates, answers.symbols)
    used = names_in(answers.sections) - set(answers.where)
    return settled(page, Names((*given, *answers.symbols.values(), *used)))


def _worded(section: Declaration, answers: Answers) -> Iterable[Block]:
    if section.name not in answers.sections:
        return [Paragraph(("Not found: see the warnings.",))]
    return section.blocks(answers.sections[section.name], answers)


def _used(where: Mapping[str, Expression], names: set[str]) -> dict[str, Expression]:
    """The abbreviations that are read: some stand for what JSON has and a page leaves out."""
    for name in reversed(tuple(where)):
        if name in names:
            names = names | names_in(where[name])
    return {name: value for name, value in where.items() if name in names}


def _system(answers: Answers) -> Paragraph:
    count = answers.degrees_of_freedom
    parts = ["Coordinates ", *listed(answers.coordinates)]
    if answers.parameters:
        parts += ["; parameters ", *listed(answers.parameters)]
    if count is not None:
        parts += [f"; {count} degree{'' if count == 1 else 's'} of freedom"]
    return Paragraph((*parts, "."))
