"""An explanation in a format: a page of numbered steps, or their list for a machine."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

from lagcli.document import Block, Document, Heading, Paragraph
from lagcli.formatters.options import Options
from lagcli.notation.letters import names_in, with_names
from lagcli.statements.explanation import Explanation

#: The formats that set pages; `json` lists the steps.
PAGES = ("text", "latex", "markdown", "html")
FORMATS = (*PAGES, "json")


def render(explanations: Sequence[Explanation], format_name: str, options: Options) -> str:
    """Print the explanations, one file after another.

    Raises
    ------
    LookupError
        When the format is none of `FORMATS`.
    """
    if format_name == "json":
        from lagcli.formatters import json_explanation

        return json_explanation.render(explanations, options)
    if format_name not in PAGES:
        raise LookupError(f"an explanation has the formats {', '.join(FORMATS)}")
    documents = [to_document(each) for each in explanations]
    page: str = import_module(f"lagcli.formatters.built_in.{format_name}").pages(documents, options)
    return page


def to_document(explanation: Explanation) -> Document:
    """Set the steps under one another, numbered."""
    blocks: list[Block] = []
    for number, step in enumerate(explanation.steps, 1):
        blocks += [Heading(f"{number}. {step.title}"), *step.blocks]
    if explanation.warnings:
        blocks.append(Heading("Warnings"))
        names = (*explanation.coordinates, *names_in(explanation.steps))
        blocks += [Paragraph(with_names(warning, names)) for warning in explanation.warnings]
    return Document(
        explanation.title, tuple(blocks), explanation.coordinates, explanation.symbols, prose=True
    )
