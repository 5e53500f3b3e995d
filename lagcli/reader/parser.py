"""The parser of the grammar beside this file, and how its tables are made.

Making the tables takes most of the time of reading a small problem, so they are kept in
`grammar.json`.  After a change of the grammar lark, which only this needs, makes them anew:

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
    from lark import Lark

GRAMMAR = Path(__file__).with_name("grammar.lark")
TABLES = Path(__file__).with_name("grammar.json")


@cache
def automaton() -> Automaton:
    """The parser, ready to build nodes."""
    return Automaton(json.loads(TABLES.read_bytes())["automaton"], FormulaBuilder(), check_nesting)


def make_parser() -> Lark:
    """Lark's parser, with tables made from the grammar."""
    from lark import Lark

    return Lark(
        GRAMMAR.read_text("utf-8"),
        parser="lalr",
        lexer="basic",
        start=["expression", "equation", "comparison"],
        maybe_placeholders=False,
        transformer=FormulaBuilder(),
    )


def make_tables() -> str:
    """The text of `grammar.json`: the grammar, and what `Automaton` needs of lark's parser."""
    from lark.parsers.lalr_analysis import Shift

    made = make_parser()
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
    tables = {
        "pattern": "|".join(f"(?P<{t.name}>{t.pattern.to_regexp()})" for t in lexer.terminals),
        "ignored": sorted(lexer.ignore_types),
        "rules": [_rule(rule) for rule in rules],
        "states": states,
        "starts": {name: place_of[state] for name, state in table.start_states.items()},
        "ends": {name: place_of[state] for name, state in table.end_states.items()},
    }
    whole = {"grammar": GRAMMAR.read_text("utf-8"), "automaton": tables}
    return json.dumps(whole, separators=(",", ":"), sort_keys=True) + "\n"


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


if __name__ == "__main__":
    TABLES.write_text(make_tables(), "utf-8")
