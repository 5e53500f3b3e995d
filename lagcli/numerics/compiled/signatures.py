"""The types of the functions that are translated, as their annotations say them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

#: name -> (type of the result, types of the arguments)
Signature = tuple[str, tuple[str, ...]]

_KINDS = {
    "float": "real",
    "int": "i64",
    "Reals": "ptr",
    "Ints": "ints",
    "DoubleCells": "doubles",
    "None": "void",
}


def signature_of(function: ast.FunctionDef) -> Signature:
    """The types of the result and of the arguments."""
    kinds = tuple(_KINDS[ast.unparse(a.annotation)] for a in function.args.args if a.annotation)
    return (_KINDS[ast.unparse(function.returns or ast.Constant(None))], kinds)


def functions_of(source: str) -> Iterator[tuple[str, Signature]]:
    """The names and types of a module's functions."""
    for node in ast.parse(source).body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, signature_of(node)
