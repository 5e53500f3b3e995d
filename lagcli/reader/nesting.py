"""How deep an expression nests, counted on its tokens before anything is built."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lagcli.reader.automaton import Token
from lagcli.reader.builder import mistake, span_of
from lagcli.reader.limits import CALL_LEVELS, NESTING_LEVELS

_OPERATORS = frozenset(
    {"_PLUS", "MINUS", "STAR", "SLASH", "_POWER", "EQUAL", "COMPARISON", "COMMA"}
)


@dataclass(slots=True, eq=False, repr=False)
class _Level:
    """What is pending inside one pair of parentheses."""

    call: bool = False  # the parentheses of a function
    powers: int = 0  # of a^b^c and --a, until the factor ends
    divisions: int = 0  # of a/b/c, until the term ends

    @property
    def extra(self) -> int:
        """Levels beyond the parentheses: the first of a chain is free, `-(x^2)/3` is flat."""
        return max(0, self.powers - 1) + max(0, self.divisions - 1)


def check_nesting(tokens: Iterator[Token]) -> Iterator[Token]:
    """Pass the tokens on; `Mistake` at the one that nests deeper than the limit."""
    levels = [_Level()]
    extra = 0  # of the levels around the innermost
    previous = None
    for token in tokens:
        here = levels[-1]
        begins = previous is None or previous == "LPAR" or previous in _OPERATORS
        match token.type:
            case "LPAR":
                extra += here.extra
                levels.append(_Level(call=previous == "NAME"))
                if sum(level.call for level in levels) > CALL_LEVELS:
                    raise mistake(
                        f"more than {CALL_LEVELS} functions inside each other",
                        span_of(token),
                        f"the limit is {CALL_LEVELS} levels",
                    )
            case "RPAR" if len(levels) > 1:
                levels.pop()
                extra -= levels[-1].extra
            case "_POWER":
                here.powers += 1
            case "MINUS" | "_PLUS" if begins:
                here.powers += 1
            case "STAR":
                here.powers = 0
            case "SLASH":
                here.powers = 0
                here.divisions += 1
            case "MINUS" | "_PLUS" | "COMMA" | "EQUAL" | "COMPARISON":
                here.powers = here.divisions = 0
        if len(levels) - 1 + extra + levels[-1].extra > NESTING_LEVELS:
            raise mistake(
                f"more than {NESTING_LEVELS} levels of parentheses, powers, signs or divisions",
                span_of(token),
                f"the limit is {NESTING_LEVELS} levels",
            )
        previous = token.type
        yield token
