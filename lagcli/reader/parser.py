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

from lagcli.reader.automaton import Automaton
from lagcli.reader.builder import FormulaBuilder
from lagcli.reader.nesting import check_nesting

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from lark import Lark
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
def automaton() -> Automaton | None:
    """The parser for right texts; None where its tables are of another grammar."""
    tables = _tables()
    if tables.get("grammar") != _grammar() or "automaton" not in tables:
        return None
    return Automaton(tables["automaton"], FormulaBuilder(), check_nesting)


@cache
def parser() -> Lark:
    """The parser that knows what is wrong, ready to build nodes."""
    import lark

    tables = _tables()
    if tables.get("lark") != lark.__version__ or tables.get("grammar") != _grammar():
        return make_parser()
    data, memo = _with_whole_keys(tables["data"]), _with_whole_keys(tables["memo"])
    # The public `Lark.load` reads a pickle, which could run code; this is its other half.
    load: Callable[..., Lark] = lark.Lark._load_from_dict  # noqa: SLF001
    return load(data, memo, transformer=FormulaBuilder(), postlex=Nesting())


def make_parser() -> Lark:
    """The parser, with tables made from the grammar."""
    from lark import Lark

    return Lark(
        _grammar(),
        parser="lalr",
        lexer="basic",
        start=["expression", "equation", "comparison"],
        maybe_placeholders=False,
        transformer=FormulaBuilder(),
        postlex=Nesting(),
    )


def make_tables() -> str:
    """The text of `grammar.json`."""
    import lark
    from lark.grammar import Rule
    from lark.lexer import TerminalDef

    made = make_parser()
    data, memo = made.memo_serialize([TerminalDef, Rule])
    for key in ("transformer", "postlex"):
        data["options"][key] = None
    tables = {"lark": lark.__version__, "grammar": _grammar(), "data": data, "memo": memo}
    tables["automaton"] = _automaton_tables(made)
    return json.dumps(tables, separators=(",", ":"), sort_keys=True) + "\n"


def _automaton_tables(made: Lark) -> dict[str, Any]:
    """What `Automaton` needs, out of lark's parser."""
    from lark.parsers.lalr_analysis import Shift

    table: Any = made.parser.parser._parse_table  # noqa: SLF001
    lexer: Any = made._build_lexer()  # noqa: SLF001
    rules = list(dict.fromkeys(made.rules))
    number = {rule: place for place, rule in enumerate(rules)}
    # states as lark has numbered them, with no gaps
    place_of = {state: place for place, state in enumerate(table.states)}
    states = [
        {
            str(symbol): place_of[what] if action is Shift else -1 - number[what]
            for symbol, (action, what) in actions.items()
        }
        for actions in table.states.values()
    ]
    return {
        "pattern": "|".join(f"(?P<{t.name}>{t.pattern.to_regexp()})" for t in lexer.terminals),
        "ignored": sorted(lexer.ignore_types),
        "rules": [_rule(rule) for rule in rules],
        "states": states,
        "starts": {name: place_of[state] for name, state in table.start_states.items()},
        "ends": {name: place_of[state] for name, state in table.end_states.items()},
    }


def _rule(rule: Any) -> list[Any]:
    """A rule as `Automaton` knows it; lark's lists, such as `("," total)*`, begin with `_`."""
    origin, parts = str(rule.origin.name), list(enumerate(rule.expansion))
    single = bool(rule.options.expand1 and not rule.alias)
    name = "" if origin.startswith("_") else rule.alias or origin
    if single and not hasattr(FormulaBuilder, name):
        name = ""  # it is always one part, which stands for itself
    return [
        origin,
        name,
        len(parts),
        [k for k, part in parts if not getattr(part, "filter_out", False)],
        [k for k, part in parts if not part.is_term and part.name.startswith("_")],
        single,
    ]


@cache
def _tables() -> dict[str, Any]:
    try:
        found: dict[str, Any] = json.loads(TABLES.read_bytes())
    except (OSError, ValueError):
        return {}
    return found


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
