"""The parser of the grammar beside this file, from tables that are made in advance.

Making the tables takes most of the time of reading a small problem, so they are kept in
`grammar.json`.  They belong to one version of lark and to one text of the grammar; for
any other they are made anew.  After a change of the grammar:

    python -m lagcli.reader.parser
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import lark
from lark import Lark

from lagcli.reader.builder import Builder
from lagcli.reader.nesting import check_nesting

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from lark.lexer import Token

GRAMMAR = Path(__file__).with_name("grammar.lark")
TABLES = Path(__file__).with_name("grammar.json")


class Nesting:
    """Looks at the tokens before the parser does."""

    always_accept = ()

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        """Pass the tokens on, until they nest too deep."""
        return check_nesting(stream)


@cache
def parser() -> Lark:
    """The parser, ready to build nodes."""
    try:
        tables = json.loads(TABLES.read_bytes())
    except (OSError, ValueError):
        tables = {}
    if tables.get("lark") != lark.__version__ or tables.get("grammar") != _grammar():
        return make_parser()
    data, memo = _with_whole_keys(tables["data"]), _with_whole_keys(tables["memo"])
    # The public `Lark.load` reads a pickle, which could run code; this is its other half.
    load: Callable[..., Lark] = Lark._load_from_dict  # noqa: SLF001
    return load(data, memo, transformer=Builder(), postlex=Nesting())


def make_parser() -> Lark:
    """The parser, with tables made from the grammar."""
    return Lark(
        _grammar(),
        parser="lalr",
        lexer="basic",
        start=["expression", "equation", "comparison"],
        maybe_placeholders=False,
        transformer=Builder(),
        postlex=Nesting(),
    )


def make_tables() -> str:
    """The text of `grammar.json`."""
    from lark.grammar import Rule
    from lark.lexer import TerminalDef

    data, memo = make_parser().memo_serialize([TerminalDef, Rule])
    for key in ("transformer", "postlex"):
        data["options"][key] = None
    tables = {"lark": lark.__version__, "grammar": _grammar(), "data": data, "memo": memo}
    return json.dumps(tables, separators=(",", ":"), sort_keys=True) + "\n"


def _grammar() -> str:
    return GRAMMAR.read_text("utf-8")


def _with_whole_keys(table: Any) -> Any:
    """Undo what JSON does to a map of numbers: its keys come back as texts."""
    if isinstance(table, dict):
        return {int(key) if key.isdigit() else key: _with_whole_keys(value)
                for key, value in table.items()}  # fmt: skip
    if isinstance(table, list):
        return [_with_whole_keys(value) for value in table]
    return table


if __name__ == "__main__":
    TABLES.write_text(make_tables(), "utf-8")
