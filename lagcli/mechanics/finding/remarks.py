"""What is remarked on an answer: words with formulas among them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from sympy import Expr

from lagcli.expression import Expression

Remark = str | tuple[str | Expr, ...]


def in_words(remarks: Iterable[Remark]) -> str:
    """All remarks as plain text, each once, their formulas in the grammar."""
    return "; ".join(dict.fromkeys(_plain(remark) for remark in remarks if remark))


def as_parts(
    remarks: Iterable[Remark], tree: Callable[[Expr], Expression]
) -> tuple[str | Expression, ...]:
    """The same with the formulas as trees; empty without remarks."""
    parts: list[str | Expression] = []
    for remark in dict.fromkeys(each for each in remarks if each):
        parts += ["; "] if parts else []
        parts += _trees((remark,) if isinstance(remark, str) else remark, tree)
    return tuple(parts)


def _plain(remark: Remark) -> str:
    parts = (remark,) if isinstance(remark, str) else remark
    return "".join(str(part).replace("**", "^") for part in parts)


def _trees(
    parts: Iterable[str | Expr], tree: Callable[[Expr], Expression]
) -> Iterator[str | Expression]:
    for part in parts:
        yield part if isinstance(part, str) else tree(part)
