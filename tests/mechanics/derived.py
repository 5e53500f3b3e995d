"""A derivation from the YAML of a test, and answers as the grammar writes them."""

from __future__ import annotations

from lagcli.algebra import is_zero, shape
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.noether import NoetherCharge
from lagcli.reader import parse_text, read_problem


def derive(text: str) -> Derivation:
    return Derivation(read_problem("test.yaml", text.encode()).checked())


def charge(derivation: Derivation, name: str) -> NoetherCharge:
    return next(c for c in derivation.noether.charges if c.name == name)


def same(derivation: Derivation, expression: object, expected: str) -> bool:
    """Whether a SymPy expression equals a formula of the grammar identically."""
    return is_zero(expression - derivation.system.build(parse_text(expected))) is True  # type: ignore[operator]


def printed(derivation: Derivation, expression: object) -> str:
    return to_grammar(shape(expression, derivation.system.order))  # type: ignore[arg-type]
