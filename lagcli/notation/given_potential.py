"""V of a file, found again in its answers.

Its terms stay apart where the algebra has brought some together.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import inf

from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Power,
    Sum,
    operation_count,
    opposite,
    quotient_of,
    sum_of,
    terms_of,
    walk,
)
from lagcli.notation.factors import parts_of
from lagcli.notation.given_sums import (
    arranged_within,
    differ_in_parameters,
    has_like_terms,
    is_tidy,
    leaves,
)
from lagcli.notation.likeness import Monomial, multiplied_out
from lagcli.notation.ordering import Ordering
from lagcli.rewriting import put_in

#: How many times as long the potential of the file may be.
_LIMIT = 2


class GivenPotential:
    """V as the file writes it, within L, H and U_eff.

    Parameters
    ----------
    potential
        Of the file; its terms stay apart where the algebra has brought some together.
    ordering
        Of the factors of a product.
    """

    def __init__(self, potential: Expression | None, ordering: Ordering) -> None:
        like = isinstance(potential, Sum) and (
            has_like_terms(potential) or differ_in_parameters(potential, ordering)
        )
        own = None if like else potential
        value = own and multiplied_out(own)
        self._value = value if own and value and _is_tidy_inside(own) else None
        self._limit = inf if own is not None and _keeps_squares(own) else _LIMIT
        self._node = None if potential is None else arranged_within(potential, ordering)

    def __call__(self, node: Expression) -> Expression:
        """The formula with V or −V for all that has neither velocities nor momenta; E − V."""
        inside: dict[Expression, Expression] = {
            part: shown
            for root in walk(node)
            if isinstance(root, Call) and root.function == "sqrt"
            for part in walk(root)
            if isinstance(part, Sum) and (shown := self._with_potential(part)) is not part
        }
        return self._with_potential(put_in(node, inside) if inside else node)

    def _with_potential(self, node: Expression) -> Expression:
        if self._value is None or self._node is None or not leaves(self._node) <= leaves(node):
            return node
        given, terms, own = self._node, terms_of(node), leaves(self._node)
        still = [t for t in terms if t in own or not isinstance(t, Name)]
        still = [t for t in still if not any(map(_is_fast, walk(t)))]
        parts = [(t, multiplied_out(t)) for t in still]
        ours = [t for t, out in parts if out and out.keys() <= self._value.keys()]
        others = [t for t, out in parts if out is None or not out.keys() & self._value.keys()]
        shown = Sum((*ours,)) if len(ours) > 1 else ours[0] if ours else None
        value = None if shown is None else multiplied_out(shown)
        if shown is None or value is None or len(value) != len(self._value):
            return node
        first = terms.index(still[0])
        apart = others and [*terms[first : first + len(still)]] != still
        if apart or len(ours) + len(others) < len(still):  # (k − m w²) x²
            return node
        ratios = {
            c / self._value[term] if term in self._value else None for term, c in value.items()
        }
        if ratios not in ({Fraction(1)}, {Fraction(-1)}):
            return node
        if self._limit * operation_count(shown) < operation_count(given):
            return node
        signed = terms_of(given) if ratios == {Fraction(1)} else map(opposite, terms_of(given))
        together = [*signed]
        behind = ratios == {Fraction(-1)} or isinstance(together[0], Negative)  # T0 − V, V − T0
        late = behind and others and not isinstance(others[0], Negative)
        together = [*others, *together] if late else [*together, *others]
        before, after = terms[:first], [t for t in terms[first:] if t not in still]
        found = (*before, *together, *after)
        worse = isinstance(found[0], Negative) and not isinstance(terms[0], Negative)
        return node if worse else sum_of(found)


def _keeps_squares(node: Expression) -> bool:
    """Whether there are squared brackets of which every product stays when multiplied out.

    Of q1² + q2² + (q1 − q2)² nothing is gained by it, and the symmetry is lost;
    (x + y)² + (x − y)² is 2 x² + 2 y².
    """
    if not any(isinstance(p, Power) and isinstance(p.base, Sum) for p in walk(node)):
        return False
    whole = multiplied_out(node) or {}
    return all(m in whole for term in terms_of(node) for m in _products(term))


def _products(node: Expression) -> Iterator[Monomial]:
    """The products in each squared bracket of a term, before they are added to others."""
    _, above, below = parts_of(node)
    for place, factor in enumerate(above):
        if isinstance(factor, Sum):
            for term in factor.terms:
                rest = [term if k == place else f for k, f in enumerate(above)]
                yield from _products(quotient_of(rest, below))
            return
    yield from multiplied_out(quotient_of(above, below)) or {}


def _is_tidy_inside(node: Expression) -> bool:
    """Whether it is tidy behind other terms, where it may begin with a minus."""
    first, *rest = terms_of(node)
    return is_tidy(Sum((opposite(first), *rest)) if rest and isinstance(first, Negative) else node)


def _is_fast(node: Expression) -> bool:
    return isinstance(node, Name) and (node.primes > 0 or node.name.startswith("p_"))
