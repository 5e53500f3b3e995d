"""The machine's view: a stable contract, every expression in the problem format's grammar.

One object for one file, an array for several.  The keys and their order are those of the
manual's page on output; a section that was not asked for has no key.
"""

from __future__ import annotations

import json
from collections.abc import Sequence

from lagcli.formatters.json_values import SCHEMA, Object, Value, by_name
from lagcli.formatters.options import Options
from lagcli.statements.answers import Answers
from lagcli.statements.registry import in_order


def render(answers: Sequence[Answers], options: Options) -> str:
    """JSON for machines: a stable contract."""
    objects = [to_object(each) for each in answers]
    value: Value = objects[0] if len(objects) == 1 and not options.several else objects
    return json.dumps(value, indent=2, ensure_ascii=False) + "\n"


def to_object(answers: Answers) -> Object:
    """Put the answers to one file into a JSON object."""
    result: Object = {
        "schema": SCHEMA,
        "title": answers.title,
        "coordinates": answers.coordinates,
        "parameters": answers.parameters,
        "degrees_of_freedom": answers.degrees_of_freedom,
    }
    for each in in_order((*answers.sections, *answers.absent)):
        if each.name in answers.sections:
            result |= each.json(answers.sections[each.name])
        else:
            result[each.name] = None
    if answers.where:
        result["where"] = by_name(answers.where)
    return result | {"warnings": answers.warnings}
