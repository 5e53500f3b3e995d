"""Values of a parameter at which there are more charges: these are constant there, and so many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from random import Random

from flint import arb

from lagcli.formatters.grammar import to_grammar
from lagcli.statements.answers import SpecialValue
from lagcli.verification.claims.canonical_samples import nearby
from lagcli.verification.comparison import ComparisonVerdict, compare, is_zero
from lagcli.verification.examination import LOOKED_AT, Examination
from lagcli.verification.linear import Unclear, rank
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State, onto_constraints, with_other_orders

#: States of a special value beyond those that a rank needs.
_MORE = 4
_SCALES = 8


def holds(
    x: Examination, special: SpecialValue, known: Sequence[int], listed: Sequence[SpecialValue]
) -> bool:
    """Whether the charges that are listed with a value are constant there, and new ones.

    With two values those of one of them, if it is listed, are known.
    """
    what = f"the special value {special.parameter} = {to_grammar(special.value)}"
    places = x.places(what, [*special.values.values(), *special.charges.values()])
    if places is None:
        return False
    number = len(special.values)
    charges = places[number:]
    values_ = dict(zip(special.values, places[:number], strict=True))
    there = list(islice(_there(x, values_), LOOKED_AT))
    if not there and x.states():
        x.refute(what, "the parameter has another sign, or no value there")
        return False
    first = next((s for s in there if all(s.at(p).is_finite() for p in charges)), None)
    if first is None:
        x.unchecked.append(what)
        return True
    if special.given:
        known = [*known, *(place for each in listed for place in _of_one(x, each, first))]
    everything = [*(p for p in known if first.at(p).is_finite()), *charges]
    tried, values = 0, []
    for state in nearby(first, 4 * (len(everything) + _MORE)):
        found = [state.at(place) for place in everything]
        try:
            rates = [state.laws.rate(place) for place in charges]
        except Unclear:
            continue
        if not all(each.is_finite() for each in (*found, *rates)):
            continue
        verdicts = {compare(rate, arb(0)) for rate in rates}
        if ComparisonVerdict.DIFFERENT in verdicts:
            x.refute(what, "a charge that is listed with it is not constant there")
            return False
        if verdicts - {ComparisonVerdict.EQUAL}:
            continue
        tried += 1
        values.append([*found, arb(1)])
        if tried == len(everything) + _MORE:
            complete = len(everything) == len(known) + len(charges)
            return not complete or _counted(x, what, special, values)
    x.unchecked.append(what)
    return True


def _of_one(x: Examination, one: SpecialValue, state: State) -> Sequence[int]:
    """The charges of a case of one parameter, if the state has its value."""
    what = f"the special value {one.parameter} = {to_grammar(one.value)}"
    places = None if one.given else x.places(what, [one.value, *one.charges.values()])
    if places is None or not is_zero(state.at(places[0]) - state.environment[one.parameter, 0]):
        return ()
    return places[1:]


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


def _there(x: Examination, values: Mapping[str, int]) -> Iterator[State]:
    """States with the values on the constraints, where their signs are those of the parameters."""
    signs = {p.name: p.assume for p in x.problem.parameters}
    for environment in _with_other_parameters(x):
        at = x.reference.values(environment)
        numbers = {name: at(value) for name, value in values.items()}
        wrong = any(
            (signs[name] == "positive" and x <= 0) or (signs[name] == "negative" and x >= 0)
            for name, x in numbers.items()
        )
        if all(x.is_finite() for x in numbers.values()) and not wrong:
            known = {**environment, **{(name, 0): x.mid() for name, x in numbers.items()}}
            if onto_constraints(x.reference, known):
                yield State(x.reference, known)


def _with_other_parameters(x: Examination) -> Iterator[Environment]:
    """States, then the same with parameters of other orders: w^2/4 - w0^2 is to be positive."""
    random, problem = Random(4), x.problem
    yield from (state.environment for state in x.states(LOOKED_AT))
    for _ in range(1, _SCALES):
        for state in x.states(LOOKED_AT):
            yield with_other_orders(problem, state.environment, random)
