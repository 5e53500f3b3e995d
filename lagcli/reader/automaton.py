"""The parser's tables at work, without lark: importing lark takes longer than any parse.

An LALR(1) automaton under a lexer that is one regular expression.

References
----------
Aho, Lam, Sethi, Ullman, *Compilers*, 2nd ed., algorithm 4.44.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

END = "$END"


class Token(str):  # noqa: SLOT000 - a text has no room for slots
    """A piece of the text, with its kind and its place."""

    type: str
    start_pos: int
    end_pos: int


class Unexpected(Exception):
    """The text is not of the language.

    Attributes
    ----------
    place : int
        Where: that of a character that begins no token, or of a token; the length of the text
        where it ends too early.
    token : Token or None
        The token that cannot stand there.
    """

    def __init__(self, place: int, token: Token | None = None) -> None:
        super().__init__(place)
        self.place, self.token = place, token


class Automaton:
    """A parser that builds while it reads.

    Parameters
    ----------
    tables
        `pattern` and `ignored` of the lexer; `rules` as (origin, name of the callback,
        length, places of the parts that are kept, those of them that are lists to be put in
        their place, whether a single one stands for itself); a rule without a name is a list;
        `states`: by symbol the next state, or a rule as -1 - its number; `starts` and
        `ends`: the states of each start symbol.
    builder
        Its methods are the callbacks.
    look
        Looks at the tokens before the parser does.
    """

    def __init__(
        self,
        tables: Mapping[str, Any],
        builder: object,
        look: Callable[[Iterator[Any]], Iterator[Any]],
    ) -> None:
        self._match = re.compile(tables["pattern"]).match
        self._ignored = tables["ignored"]
        self._rules = [
            (origin, getattr(builder, name) if name else list, *rest)
            for origin, name, *rest in tables["rules"]
        ]
        self._states = tables["states"]
        self._starts, self._ends = tables["starts"], tables["ends"]
        self._look = look

    def parse(self, text: str, start: str) -> Any:
        """What the builder makes of a text; `Unexpected` where it is not of the language."""
        states: list[int] = [self._starts[start]]
        values: list[Any] = []
        for token in self._look(self.tokens(text)):
            if not self._reduced(states, values, token.type):
                raise Unexpected(token.start_pos, token)
            states.append(self._states[states[-1]][token.type])
            values.append(token)
        if not self._reduced(states, values, END, self._ends[start]):
            raise Unexpected(len(text))
        return values[-1]

    def _reduced(
        self, states: list[int], values: list[Any], symbol: str, end: int | None = None
    ) -> bool:
        """Apply rules until the symbol is to be taken, or the end has come; False: neither can."""
        while True:
            action = self._states[states[-1]].get(symbol)
            if action is None:
                return False
            if action >= 0:
                return True
            origin, callback, length, kept, spliced, single = self._rules[-1 - action]
            parts = values[len(values) - length :]
            del values[len(values) - length :], states[len(states) - length :]
            children: list[Any] = []
            for place in kept:
                children += parts[place] if place in spliced else [parts[place]]
            whole = children[0] if single and len(children) == 1 else callback(children)
            values.append(whole)
            states.append(self._states[states[-1]][origin])
            if states[-1] == end:
                return True

    def tokens(self, text: str) -> Iterator[Token]:
        """The tokens; `Unexpected` at a character that begins none."""
        place, match = 0, self._match
        while place < len(text):
            found = match(text, place)
            if found is None or found.end() == place:
                raise Unexpected(place)
            kind = str(found.lastgroup)
            if kind not in self._ignored:
                token = Token(found.group())
                token.type, token.start_pos, token.end_pos = kind, place, found.end()
                yield token
            place = found.end()
