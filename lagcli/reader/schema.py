"""The problem format as a JSON Schema (draft 7), for editors that complete and underline.

Every scalar of the format is text to the reader, and a number or a boolean to other readers
of YAML, so an expression may be any of them.  What a schema cannot say (names that are not
declared, formulas that are wrong) the reader says.

`problem.schema.json` is the schema but for the names that the program knows: they are put into
its empty lists here, and what `expect` may have follows from the file.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import get_args

from lagcli.expression import RESERVED
from lagcli.problem_data import METHODS, Assumption
from lagcli.reader.schema_parts import Schema
from lagcli.reader.trajectory import HAPPENINGS
from lagcli.statements.registry import every_section


def problem_schema() -> Schema:
    """The schema of a problem file."""
    text = Path(__file__).with_name("problem.schema.json").read_text("utf-8")
    schema: Schema = json.loads(text)
    parts, definitions = schema["properties"], schema["definitions"]
    definitions["declared"]["allOf"][1]["not"]["enum"] = sorted(RESERVED)
    for declared in (definitions["coordinate"]["anyOf"][1], definitions["parameter"]["anyOf"][2]):
        declared["properties"]["assume"]["enum"] = list(get_args(Assumption))
    parts["simulation"]["allOf"][0]["properties"]["method"]["enum"] = list(METHODS)
    expect = parts["expect"]["allOf"][0]
    event = expect["properties"]["trajectory"]["properties"]["events"]["items"]
    event["properties"]["what"]["enum"] = list(HAPPENINGS)
    found = {one.key: dict(one.schema) for each in every_section() for one in each.expected}
    count, trajectory = expect["properties"].values()
    expect["properties"] = {"degrees_of_freedom": count, **found, "trajectory": trajectory}
    return schema
