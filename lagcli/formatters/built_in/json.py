"""The machine's view: a stable contract, every expression in the problem format's grammar.

One object for one file, an array for several.  The keys and their order are those of the
manual's page on output; a section that was not requested has no key.
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.formatters.json_values import HEAD, SCHEMA, Object, fields_of, plain, written
from lagcli.formatters.options import Options
from lagcli.statements.answers import Answers
from lagcli.statements.registry import in_order


def render(answers: Sequence[Answers], options: Options) -> str:
    """JSON for machines: a stable contract."""
    return written([to_object(each) for each in answers], options)


def to_object(answers: Answers) -> Object:
    """Put the answers to one file into a JSON object."""
    result: Object = {"schema": SCHEMA, **fields_of(answers, HEAD)}
    for each in in_order((*answers.sections, *answers.absent)):
        if each.name not in answers.sections:
            result[each.name] = None
        elif each.json is not None:
            result |= each.json(answers.sections[each.name])
        else:
            content = each.content or each.name
            result[each.name] = plain(getattr(answers.sections[each.name], content))
    if answers.where:
        result["where"] = plain(answers.where)
    return result | {"warnings": answers.warnings}
