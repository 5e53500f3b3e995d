"""Regular expressions that are compiled at their first use: most are for hints alone."""

from __future__ import annotations

import re
from typing import cast


class _Pattern:
    """Looks like the compiled pattern, which takes its place."""

    def __init__(self, source: str, flags: int) -> None:
        self._source, self._flags = source, flags

    def __getattr__(self, name: str) -> object:
        value = getattr(re.compile(self._source, self._flags), name)
        self.__dict__[name] = value
        return value


def outside(text: str) -> str:
    """What stands outside of all parentheses."""
    while (outer := re.sub(r"\([^()]*\)", "", text)) != text:
        text = outer
    return text


def balanced(text: str) -> bool:
    """Whether each parenthesis is closed that is opened, and no other."""
    return not {"(", ")"} & {*outside(text)}


def regex(source: str, flags: int = 0) -> re.Pattern[str]:
    """The pattern, not compiled yet."""
    return cast("re.Pattern[str]", _Pattern(source, flags))
