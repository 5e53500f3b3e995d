"""Terms whose dimension does not fit, and the other text of a term with which all of them fit."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagcli.diagnostics import Diagnostic, Source
from lagcli.problem_data import Problem
from lagcli.reader.habits import is_angle
from lagcli.reader.limits import MISTAKES
from lagcli.reader.text import SourceText
from lagcli.record import replace

#: Where a stretch of the file begins and ends, and what fits there.
_Place = tuple[int, int, str]
#: Places of a file at which another text is tried; each takes a reading of the file.
_TRIALS = 100
Reading = Callable[[Source], tuple[Problem | None, list[Diagnostic]]]


def dimension_mistakes(problem: Problem, read: Reading | None) -> list[Diagnostic]:
    """The terms that do not fit, or the one place that explains several of them.

    Parameters
    ----------
    problem
        A problem without other mistakes.
    read
        The problem that a text writes, and its mistakes; None where no other text is tried.
    """
    if all(quantity.unit is None for quantity in (*problem.coordinates, *problem.parameters)):
        return []
    from lagcli.dimensions.check import check_dimensions, energies_in, one_wrong_unit

    found = check_dimensions(problem, MISTAKES)
    if read is None or not any(each.is_error for each in found):
        return found
    text = SourceText.of(problem.source)
    usual = _with_usual_units(problem)
    if is_usual := energies_in(usual) >= energies_in(problem):
        problem, found = usual, check_dimensions(usual, MISTAKES)

    def fits(place: _Place) -> bool:
        start, end, better = place
        changed = problem.source.text[:start] + better + problem.source.text[end:]
        other, mistakes = read(Source(problem.source.name, changed))
        if mistakes or other is None:
            return False
        return not is_usual or not check_dimensions(_with_usual_units(other), 1)

    place = _only(fits, _other_primes(problem, text, found))
    if not found[1:]:
        if place is not None:
            return [_with_term(found[0], place, text)]
        factor = _only(fits, _other_factors(problem, text, found[0]))
        return [_with_term(found[0], factor, text, one_wrong_unit(problem, found[0]))]
    unit = one_wrong_unit(problem, found[0])
    causes = [] if place is None else [_prime_elsewhere(found[0], place, text)]
    known = causes if unit is None else [*causes, unit]
    return known if len(known) == 1 else found


def _with_usual_units(problem: Problem) -> Problem:
    """The problem with lengths and angles for the coordinates that have no unit."""
    kept = tuple(
        one if one.unit is not None else replace(one, unit="rad" if is_angle(one.name) else "m")
        for one in problem.coordinates
    )
    return replace(problem, coordinates=kept)


def _prime_elsewhere(first: Diagnostic, place: _Place, text: SourceText) -> Diagnostic:
    """The one place that explains several terms that do not fit."""
    start, end, better = place
    message = f"{text.source.text[start:end]} stands where {better} fits"
    related = ((first.span, first.message),)
    return Diagnostic(message, text.span(start, end), f"write {better}", related=related)


def _with_term(
    mistake: Diagnostic, place: _Place | None, text: SourceText, unit: Diagnostic | None = None
) -> Diagnostic:
    """The mistake with its term or the unit as they fit in the hint."""
    begin, stop = text.offsets(mistake.span)
    written = text.source.text
    fitting = []
    if place is not None and begin <= place[0] <= place[1] <= stop:
        fitting.append(written[begin : place[0]] + place[2] + written[place[1] : stop])
    if unit is not None:
        given = written[slice(*text.offsets(unit.span))]
        quantity = unit.message.split("'")[1]
        fitting.append(f"{unit.hint.removeprefix('write ')} for the unit {given} of {quantity}")
    if not fitting:
        return mistake
    return replace(mistake, hint=f"write {', or '.join(fitting)}: {mistake.hint}")


def _other_primes(problem: Problem, text: SourceText, mistakes: list[Diagnostic]) -> list[_Place]:
    """The places of a prime more or less: one name, or a term all of whose coordinates lack it."""
    written = text.source.text
    names = "|".join(re.escape(each.name) for each in problem.coordinates)
    name = re.compile(rf"(?<![\w.'])(?:{names})(?![\w(])('?)")

    ends = [*text.line_starts[1:], len(written)]
    lines = dict.fromkeys([*(each.span.line - 1 for each in mistakes), *range(len(ends))])
    places = [
        (place.start(), place.end(), place[0][:-1] if place[1] else f"{place[0]}'")
        for line in lines
        for place in name.finditer(written, text.line_starts[line], ends[line])
        if place[1] or not written.startswith("V:", text.line_starts[line])
    ]
    for each in mistakes:
        start, end = text.offsets(each.span)
        whole, count = name.subn(lambda m: m[0] + "'" * (not m[1]), written[start:end])
        places += [(start, end, whole)] if count > 1 else []
    return places


def _other_factors(problem: Problem, text: SourceText, mistake: Diagnostic) -> list[_Place]:
    """The places of a factor more in a term, and of a power of one more or less."""
    quantities = (*problem.coordinates, *problem.parameters)
    names = "|".join(re.escape(each.name) for each in quantities)
    start, end = text.offsets(mistake.span)
    factor = re.compile(
        rf"(?<![\w.'^])(?:{names})'*(?![\w('])(?:\s*(?:\^|\*\*)\s*(\d+))?(?![\w.^])"
    )
    term = text.source.text[start:end]
    others = (one.name for one in problem.parameters if not re.search(rf"\b{one.name}\b", term))
    places = [(start, start, f"{other}*") for other in others]
    for each in factor.finditer(text.source.text, start, end):
        power = int(each[1] or 1)
        base = re.match(r"\w+'*", each[0])
        for other in (power + 1, power - 1):
            better = f"{base[0] if base else ''}{f'^{other}' if other > 1 else ''}"
            places.append((each.start(), each.end(), better if other else "1"))
    return places


def _only(fits: Callable[[_Place], bool], places: list[_Place]) -> _Place | None:
    """The only place with which every term fits; None for none, several, or very many places."""
    found = [] if places[_TRIALS:] else list(islice(filter(fits, places), 2))
    return found[0] if len(found) == 1 else None
