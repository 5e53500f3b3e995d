"""The section `functions`: what is left unspecified."""

from __future__ import annotations

import re

from lagcli.expression import FUNCTIONS
from lagcli.reader.clauses import written_out
from lagcli.reader.file_reader import FileReader
from lagcli.reader.misplaced import CALLED
from lagcli.reader.misshapen import as_flow, named_formulas
from lagcli.reader.nodes import DocumentNode, Sequence
from lagcli.reader.scope import name_mistake

_FORMULA = "a formula, without arguments, stands under definitions"


def read_functions(file: FileReader, node: DocumentNode) -> dict[str, tuple[str, ...]]:
    """The functions left unspecified; the names of their arguments only document."""
    functions = {}
    items = node.texts
    called = [found.groups() for each in items for found in CALLED.finditer(each)]
    first = next(iter(file.scope.coordinates), "r")
    variables: dict[str, str] = dict(CALLED.findall(file.text))
    alone = [(each, first) for each in items if each.isidentifier()]
    named = ", ".join(map("{0[0]}: [{0[1]}]".format, called or alone or [("U", "r")]))
    hint = f"write {{{named}}}"
    if formulas := named_formulas(node):
        hint = f"{_FORMULA}: write definitions: {as_flow(formulas)}"
    for key, value in file.entries(node, "functions", hint):
        call = CALLED.fullmatch(key.label)
        name = call[1] if call else key.label
        if not file.declare(name, "function", key.span):
            continue
        what, given = f"the arguments of '{name}'", getattr(value, "value", "")
        if call or given:
            within = re.fullmatch(r"(\w*)\(\s*([\w, ]+?)\s*\)", given)
            if within and within[1] not in FUNCTIONS:  # U: U(r)
                given = within[2]
            hint = f"write {name}: [{call[2]}]" if call else f"write [{given}]"
            is_list = re.fullmatch(r"(?!\d)[\w\s,]*", given)
            if given not in {"", call[2]} if call else not is_list:
                hint = f"{_FORMULA}: write definitions: {{{name}: {given}}}"
                lines = written_out(file.text, name, call[2], given) if call else ""
                gone = "functions" if len(node.pairs) == 1 else "it"
                hint = f"write its formula out, and leave {gone} out: {lines}" if lines else hint
            file.error(f"{what} must be a list", (key if call else value).span, hint)
            names = call[2] if call else "" if hint.startswith(_FORMULA) else given
            file.scope.arguments[name] = re.split(r"\s*,\s*", names)
            continue
        listed = f"write {name}: [{variables.get(name, first)}]" * value.is_empty
        arguments = [file.scalar(item, f"an argument of '{key.label}'")
                     for item in file.items(value, what, listed)]  # fmt: skip
        for argument in arguments:
            wrong = argument and name_mistake(argument.label)
            if argument and wrong and argument.label != "t":
                is_formula = re.search(r"[-+*/^(]", argument.label)
                within = re.fullmatch(rf"{key.label}\(([\w, ]+)\)", argument.label)
                hint = f"write r, and {key.label}({argument.label}) where it is used"
                hint = f"write {within[1]}" if within else hint
                file.error(wrong[0], argument.span, hint if is_formula else wrong[1])
        if not arguments and isinstance(value, Sequence):
            file.error(f"'{key.label}' has no argument", value.span, "declare a parameter")
        functions[key.label] = tuple(argument.label for argument in arguments if argument)
        if arguments:
            file.scope.arguments[key.label] = [*functions[key.label]]
    return functions
