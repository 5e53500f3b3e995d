"""U_eff as it is read: squares of the momenta over what they are divided by, then the rest.

Landau, Lifshitz, *Mechanics*, 3rd ed., section 35, problem 1: for the heavy top
(M_z - M_3 cos)^2/(2 I_1 sin^2) + M_3^2/(2 I_3) + mu g l cos.
"""

from __future__ import annotations

from collections.abc import Sequence

from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, shape, simplify, terms
from lagcli.algebra.build import free_of
from lagcli.algebra.leaves import Translator
from lagcli.algebra.place import NO_VALUE
from lagcli.algebra.writing import Writer
from lagcli.expression import Expression, operation_count
from lagcli.mechanics.derivation import Derivation
from lagcli.mechanics.readable import Readable

#: Operations by which a potential as given may exceed another form and is left as it is.
_LONGER = 1


def without_momenta(derivation: Derivation) -> Expression:
    """V_eff, the terms of h without velocities, as they stand in h."""
    still = dict.fromkeys(derivation.system.qdot, S.Zero)
    function = derivation.energy.readable_function.xreplace(still)
    return Readable(derivation.dynamics).by_terms(function, as_given=True)


def effective_potential(
    expression: Expr, momenta: Sequence[Symbol], order: Sequence[str], given_V: Expr | None = None
) -> Expression:
    """The shorter of the sum over monomials in the momenta and the sum of squares.

    What has no momenta is left as `given_V`, the potential of the file, has it.
    """
    static = expression.xreplace(dict.fromkeys(momenta, S.Zero))
    if static.has(*NO_VALUE):
        return shape(expression, order)
    given = terms(static, order, ())
    if given_V is not None and is_zero(given_V - static) is True:
        given = _as_given(given_V, order)
    if not momenta:
        return given
    plain = terms(expression, order, {p.name for p in momenta})
    squares = _squares(expression, momenta)
    if squares is None:
        return plain
    writer = Writer(order)
    forms = []
    for *quadratic, rest in squares:
        parts = [shape(each, order) for each in quadratic]
        linear = not free_of(rest, momenta)
        moved = linear or rest != static
        parts.append(terms(rest, order, {p.name for p in momenta}) if moved else given)
        written = writer.sum(parts)
        longer = operation_count(written) - operation_count(plain)
        forms += [written] if longer <= (0 if moved else _LONGER) else []
    return min(forms, key=operation_count, default=plain)


def _as_given(potential: Expr, order: Sequence[str]) -> Expression:
    """A potential as the file has it, unless another form is shorter by more than a little."""
    found, given = terms(potential, order, ()), Translator(Writer(order)).tree(potential)
    return given if operation_count(given) <= operation_count(found) + _LONGER else found


def _squares(expression: Expr, momenta: Sequence[Symbol]) -> list[list[Expr]] | None:
    """[k_1 (p_1 + …)²/2, …, what is of lower degree in p]; None without a quadratic form.

    And with what is linear in p in the squares, (p - q A)², where there is such.
    """
    second = [[simplify(expression.diff(a, b)) for b in momenta] for a in momenta]
    if not momenta or any(not free_of(entry, momenta) for row in second for entry in row):
        return None
    at_rest = dict.fromkeys(momenta, S.Zero)
    first = [simplify(expression.diff(p).xreplace(at_rest)) for p in momenta]
    shifts = [[S.Zero] * len(momenta)] + ([first] if any(first) else [])
    found = [_completed(expression, momenta, second, shift) for shift in shifts]
    return [each for each in found if each is not None] or None


def _completed(
    expression: Expr,
    momenta: Sequence[Symbol],
    second: Sequence[Sequence[Expr]],
    first: Sequence[Expr],
) -> list[Expr] | None:
    """The squares of p S p/2 + c p one after the other, and the rest."""
    rest, found = expression, []
    for i in range(len(momenta)):
        pivot = second[i][i]
        if is_zero(pivot) is not False:
            return None
        along = [simplify(entry / pivot) for entry in second[i]]
        shift = simplify(first[i] / pivot)
        linear = sum((c * q for c, q in zip(along[i:], momenta[i:], strict=True)), shift)
        square = pivot * linear**2 / 2
        found.append(square)
        rest -= square
        first = [simplify(c - pivot * a * shift) for c, a in zip(first, along, strict=True)]
        second = [
            [simplify(second[a][b] - pivot * along[a] * along[b]) for b in range(len(momenta))]
            for a in range(len(momenta))
        ]
    return [*found, simplify(rest)]
