"""The steps of an explanation for a machine.

Formulas are strings in the grammar of the problem format; inside a sentence they stand
between backticks.  `d/dt(...)`, which a file writes as a prime, is the one addition.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.document import Block, Equations, Formula, Heading, Items, Label, Matrix, Paragraph
from lagcli.expression import Expression
from lagcli.formatters.grammar import to_grammar
from lagcli.formatters.json_values import HEAD, SCHEMA, Object, fields_of, written
from lagcli.formatters.options import Options
from lagcli.notation.letters import in_ascii
from lagcli.statements.explanation import Explanation


def render(explanations: Sequence[Explanation], options: Options) -> str:
    """Print one object for one file, an array for several."""
    return written([_object(each) for each in explanations], options)


def _object(explanation: Explanation) -> Object:
    return {
        "schema": SCHEMA,
        **fields_of(explanation, HEAD),
        "steps": [
            {"title": step.title, "content": [_block(block) for block in step.blocks]}
            for step in explanation.steps
        ],
        "warnings": explanation.warnings,
    }


def _block(block: Block) -> Object:
    match block:
        case Heading(text=text, formula=formula):
            if formula is None:
                return {"heading": text}
            return {"heading": _sentence([text, " ", formula]) if text else _formula(formula)}
        case Paragraph(parts=parts):
            return {"text": _sentence(parts)}
        case Items(items=items):
            return {"items": [_sentence(parts) for parts in items]}
        case Equations(rows=rows):
            return {
                "equations": [
                    {"left": _formula(row.left), "right": _formula(row.right)}
                    | ({"note": row.note} if row.note else {})
                    for row in rows
                ]
            }
        case Matrix(label=label, entries=entries):
            shown = [[to_grammar(entry) for entry in row] for row in entries]
            return {"matrix": _formula(label), "entries": shown}


def _sentence(parts: Sequence[str | Formula]) -> str:
    return "".join(part if isinstance(part, str) else f"`{_formula(part)}`" for part in parts)


def _formula(formula: Formula) -> str:
    if isinstance(formula, Label):
        letter = f"Delta_{formula.letter}" if formula.change else in_ascii(formula.letter)
        return "_".join((letter, *formula.index))
    return to_grammar(formula) if isinstance(formula, Expression) else str(formula)
