"""lagcli's printed formulas beside SymPy's and the textbook's: operations and values.

All three are counted in the same symbols, those of the coordinates and parameters, as
`lagcli.expression.operation_count` does.  A file may write its `expect` with names of its own
`definitions` (`mu`, `det`, `R`); lagcli and SymPy cannot print these, so each is written out
wherever it stands, as often as it does.  To count a name as one leaf, or its operations once,
would compare a formula together with a table of abbreviations with a formula that has none,
and a book's form would become shorter by naming more of it.
"""

from __future__ import annotations

import mpmath
import sympy

from lagcli.algebra import to_expression
from lagcli.algebra.numeric import Evaluator
from lagcli.expression import Name, operation_count
from lagcli.formatters.grammar import to_grammar
from lagcli.mechanics.system import System
from lagcli.pipeline import Request, derive, state
from lagcli.rewriting import rebuilt

STATES = 8
DIGITS = 50
EQUAL = mpmath.mpf(10) ** -20


def compared(problem, script, solution, simplified):
    """Every acceleration and multiplier that lagcli prints, with what the others have for it.

    Parameters
    ----------
    script
        The names and the order of SymPy's unknowns.
    solution, simplified
        SymPy's answers in q(t), before and after `sympy.simplify`; None where it took too long,
        and no solution at all where it fails.

    Returns
    -------
    dict
        ``formulas``: by name, the forms and their operations (by one measure, on trees);
        ``agrees``: whether the values are equal at a random state, None without a comparison.
    """
    derivation = derive(problem)
    sections = state(derivation, Request(sections=("accelerations", "multipliers"))).sections
    book = {**expected(problem.expect.accelerations), **expected(problem.expect.multipliers, "~")}
    printed = {**(sections["accelerations"].accelerations or {})}
    for name, multiplier in sections["multipliers"].multipliers.items():
        if multiplier.value is not None:
            printed["~" + name] = multiplier.value
    names = [*script.names, *("~" + name for name in script.constraints)]
    raw = dict(zip(names, solution or (), strict=False))
    simple = dict(zip(names, simplified, strict=False))
    formulas = {}
    for name in names:
        entry = formulas[name] = {}
        if name in printed:
            entry |= told("lagcli", printed[name])
        if simple.get(name) is not None:
            entry |= told("simplify", tree(simple[name].xreplace(script.plain)))
        if name in book:
            entry |= told("book", expanded(book[name], problem.definitions, derivation.system))
    # SymPy writes a sign as cases, which have no value here
    plain = {
        name: raw.get(name) if (x := simple.get(name)) is None or x.has(sympy.Piecewise) else x
        for name in names
    }
    pairs = {
        name: (derivation.system.build(printed[name]), plain[name].xreplace(script.plain))
        for name in names
        if name in printed and plain[name] is not None
    }
    return {"formulas": formulas, "agrees": agree(derivation, pairs)}


def expected(answers, prefix=""):
    return {prefix + name: node for name, node in answers.items()}


def tree(expression):
    try:
        return to_expression(expression)
    except TypeError:
        return None


def told(whose, node):
    if node is None:
        return {}
    return {whose: to_grammar(node), f"{whose}_operations": operation_count(node)}


def expanded(node, definitions, system: System):
    """The formula with every definition written out, as lagcli has to print it."""
    if isinstance(node, Name) and node.name in definitions:
        if node.primes == 0:
            return expanded(definitions[node.name], definitions, system)
        return to_expression(system.build(node))
    return rebuilt(node, lambda part: expanded(part, definitions, system))


def agree(derivation, pairs):
    """Whether both of each pair have the same values at a state that satisfies the constraints."""
    if not pairs:
        return None
    evaluate = Evaluator([x for pair in pairs.values() for x in pair], DIGITS)
    for k in range(STATES):
        try:
            values = evaluate(derivation.dynamics.states.take(k + 1)[k])
        except (ArithmeticError, ValueError):
            continue
        wrong = [
            name
            for name, a, b in zip(pairs, values[::2], values[1::2], strict=True)
            if abs(a - b) > EQUAL * max(1, abs(a), abs(b))
        ]
        return wrong or True
    return None
