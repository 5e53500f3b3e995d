"""Values of a parameter at which there are more charges: these are constant there, and so many."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from flint import arb

from lagcli.formatters.grammar import to_grammar
from lagcli.statements.answers import SpecialValue
from lagcli.verification.claims.canonical_samples import nearby
from lagcli.verification.comparison import is_zero
from lagcli.verification.examination import LOOKED_AT, Examination
from lagcli.verification.linear import Unclear, rank
from lagcli.verification.states import State, onto_constraints

#: States of a special value beyond those that a rank needs.
_MORE = 4


def holds(x: Examination, special: SpecialValue, known: Sequence[int]) -> bool:
    """Whether the charges that are listed with a value are constant there, and new ones."""
    what = f"the special value {special.parameter} = {to_grammar(special.value)}"
    places = x.places(what, [special.value, *special.charges.values()])
    if places is None:
        return False
    value, *charges = places
    there = list(_on_constraints(_there(x, special.parameter, value)))
    if not there and x.states():
        x.refute(what, "the parameter has another sign, or no value there")
        return False
    first = next((s for s in there if all(s.at(p).is_finite() for p in charges)), None)
    if first is None:
        x.unchecked.append(what)
        return True
    everything = [*(p for p in known if first.at(p).is_finite()), *charges]
    tried, values = 0, []
    for state in _on_constraints(nearby(first, 4 * (len(everything) + _MORE))):
        found = [state.at(place) for place in everything]
        try:
            rates = [state.laws.rate(place) for place in charges]
        except Unclear:
            continue
        if not all(each.is_finite() for each in (*found, *rates)):
            continue
        if not all(map(is_zero, rates)):
            x.refute(what, "a charge that is listed with it is not constant there")
            return False
        tried += 1
        values.append([*found, arb(1)])
        if tried == len(everything) + _MORE:
            complete = len(everything) == len(known) + len(charges)
            return not complete or _counted(x, what, special, values)
    x.unchecked.append(what)
    return True


def _counted(
    x: Examination, what: str, special: SpecialValue, values: Sequence[Sequence[arb]]
) -> bool:
    """Whether there are as many as are said, and each of the new ones is one more.

    A charge of the general case may be a function of the others here, and not be counted:
    m y'^2/2 where p_y is conserved.
    """
    try:
        count = rank(values, len(values[0])) - 1
    except Unclear:
        return True
    if count < special.number:
        x.refute(what, f"{count} charges are known there, not {special.number}")
        return False
    return True


def _on_constraints(states: Iterable[State]) -> Iterator[State]:
    for state in states:
        environment = dict(state.environment)
        if onto_constraints(state.reference, environment):
            yield State(state.reference, environment)


def _there(x: Examination, parameter: str, value: int) -> Iterator[State]:
    """States with the value, where its sign is that of the parameter."""
    [sign] = (p.assume for p in x.problem.parameters if p.name == parameter)
    for state in x.states(LOOKED_AT):
        number = state.at(value)
        wrong = (sign == "positive" and number <= 0) or (sign == "negative" and number >= 0)
        if number.is_finite() and not wrong:
            yield State(x.reference, {**state.environment, (parameter, 0): number.mid()})
