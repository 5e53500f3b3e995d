"""The page of the answers to one file: each section as it is worded; how it is set comes later."""

from __future__ import annotations

from lagcli.document import Block, Document, Heading, Paragraph
from lagcli.expression import Expression, Name, walk
from lagcli.notation.letters import names_in, settled
from lagcli.notation.naming import Names
from lagcli.rewriting import rewritten
from lagcli.statements.answers import Answers
from lagcli.statements.declaration import Declaration
from lagcli.statements.registry import in_order
from lagcli.statements.wording import listed, rows_by_name


def to_document(answers: Answers) -> Document:
    """Word the answers to one file, section by section."""
    blocks: list[Block] = [_system(answers)]
    declared = in_order((*answers.sections, *answers.absent))
    first = _first_abbreviated(answers, declared)
    for each in declared:
        if each.name in answers.sections:
            if each.name == first:
                blocks.append(Heading("Abbreviations"))
                blocks.append(rows_by_name(answers.where))
            blocks.append(Heading(each.heading))
            blocks.extend(each.blocks(answers.sections[each.name], answers))
        else:
            blocks += [Heading(each.heading), Paragraph(("Not found: see the warnings.",))]
    if answers.warnings:
        blocks.append(Heading("Warnings"))
        blocks.extend(Paragraph((warning,)) for warning in answers.warnings)
    page = Document(answers.title, tuple(blocks), answers.coordinates, answers.symbols)
    given = (*answers.coordinates, *answers.parameters, *answers.multipliers)
    used = names_in(answers.sections) - set(answers.where)
    return settled(page, Names((*given, *answers.symbols.values(), *used)))


def _first_abbreviated(answers: Answers, declared: list[Declaration]) -> str:
    """The first section whose formulas use an abbreviation: they are listed before it."""
    if not answers.where:
        return ""
    found: list[bool] = []

    def look(node: Expression) -> Expression:
        found.append(any(isinstance(p, Name) and p.name in answers.where for p in walk(node)))
        return node

    for each in declared:
        if each.name in answers.sections:
            rewritten(answers.sections[each.name], look)
            if any(found):
                return each.name
    return ""


def _system(answers: Answers) -> Paragraph:
    count = answers.degrees_of_freedom
    freedom = f"{count} degree{'' if count == 1 else 's'} of freedom."
    parts = ["Coordinates ", *listed(answers.coordinates)]
    if answers.parameters:
        parts += ["; parameters ", *listed(answers.parameters)]
    return Paragraph((*parts, "; ", freedom))
