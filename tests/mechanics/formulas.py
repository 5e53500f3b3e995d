"""Formulas as texts, compared as mathematics, with every name positive."""

from __future__ import annotations

from sympy import Expr, Symbol

from lagcli.algebra import Field
from lagcli.algebra.build import Builder
from lagcli.expression import Expression, Name, walk
from lagcli.reader import parse_text


def normal(tree: Expression | None) -> Expr | None:
    """The normal form of a tree."""
    if tree is None:
        return None
    names = {n.name: Symbol(n.name, positive=True) for n in walk(tree) if isinstance(n, Name)}
    built = Builder(names, {}, lambda e: e)(tree)
    field = Field([built])
    return field.to_sympy(field(built))


def formula(text: str) -> Expr | None:
    """The normal form of a text."""
    return normal(parse_text(text))


def formulas(*texts: str) -> list[Expr | None]:
    """The normal forms of texts, in order."""
    return [formula(text) for text in texts]
