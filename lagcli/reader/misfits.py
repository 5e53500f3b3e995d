"""Terms whose dimension does not fit, and the other text of a term with which all of them fit."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice

from lagcli.diagnostics import Diagnostic, Source
from lagcli.expression import ZERO, Negative, terms_of
from lagcli.problem_data import Problem
from lagcli.reader.habits import is_angle
from lagcli.reader.limits import MISTAKES
from lagcli.reader.text import SourceText
from lagcli.record import replace

#: Where a stretch of the file begins and ends, and what fits there.
_Place = tuple[int, int, str]
#: Characters that are read again to try another text at some places: 100 places of a file of 2,000.
#: With 100 places of any file one of 5,000 wrong terms took 35 s.
_TRIED = 200_000
#: Terms that are mended one by one.
_MOST = 3
Reading = Callable[[Source], tuple[Problem | None, list[Diagnostic]]]


def dimension_mistakes(problem: Problem, read: Reading | None) -> list[Diagnostic]:
    """The terms that do not fit, or the one place that explains several of them.

    Where nothing reads a text, no other text of a term is tried.
    """
    if all(quantity.unit is None for quantity in (*problem.coordinates, *problem.parameters)):
        return []
    from lagcli.dimensions.check import check_dimensions, energies_in, wrong_units

    found = check_dimensions(problem, MISTAKES)
    if read is None or not any(each.is_error for each in found):
        return found
    text = SourceText.of(problem.source)
    usual = _with_usual_units(problem)
    if is_usual := energies_in(usual) >= energies_in(problem):
        problem, found = usual, check_dimensions(usual, MISTAKES)

    def left(place: _Place) -> list[str] | None:
        """The terms that do not fit with another text there; None where it is not read."""
        start, end, better = place
        changed = problem.source.text[:start] + better + problem.source.text[end:]
        other, mistakes = read(Source(problem.source.name, changed))
        if other is None or mistakes != check_dimensions(other, MISTAKES):
            return None
        return _terms(check_dimensions(_with_usual_units(other) if is_usual else other, MISTAKES))

    def fitting(places: list[_Place], remaining: list[str], most: int = 1) -> list[_Place]:
        """The places with which these terms are left; none where they are more, or very many."""
        found = (each for each in places if left(each) == remaining)
        few = [] if len(places) * len(text.source.text) > _TRIED else [*islice(found, most + 1)]
        return few if len(few) <= most else []

    def factor(mistake: Diagnostic, places: list[_Place], remaining: list[str]) -> list[_Place]:
        term = text.written(mistake.span)
        within = [each for each in places if each[0] < each[1]]
        groups, most = [_squares(places, term, problem), within, places], 2
        if _is_energy(mistake):
            moving = {each.name for each in problem.coordinates} | {*problem.definitions}
            if not _words(term) & moving:
                groups, most = _with_coordinate(problem, text, mistake), 1
            if "'" in term:  # m*phi'^2/2 of m*l^2*phi'^2/2
                begin = text.offsets(mistake.span)[0]
                quantities = (*problem.coordinates, *problem.parameters)
                others = (each.name for each in quantities if each.name not in _words(term))
                groups.append([(begin, begin, f"{other}^2*") for other in others])
        return next((found for each in groups if (found := fitting(each, remaining, most))), [])

    primes = _other_primes(problem, text, found)
    begin, stop = text.offsets(found[0].span)
    within = [each for each in primes if begin <= each[0] and each[1] <= stop]
    # x' = R*theta: a prime more on one side fits as one less on the other does
    places = fitting(primes, []) or ([] if found[1:] else fitting(within, []))
    units = wrong_units(problem, found[0])
    if units[1:] and not places:
        return units
    unit = units[0] if units else None
    is_name = unit is not None and text.source.text[begin:stop] == unit.message.split("'")[1]
    if unit is not None and not places and _is_usual(unit) and not is_name:
        return units
    if not found[1:]:
        if places:
            return [_with_term(problem, found[0], places)]
        places = factor(found[0], _other_factors(problem, text, found[0]), [])
        return [_with_term(problem, found[0], places, unit)]
    related = ((found[0].span, found[0].message),)
    causes = [
        Diagnostic(f"{text.source.text[start:end]} stands where {better} fits",
                   text.span(start, end), f"write {better}", related=related)
        for start, end, better in places
    ]  # fmt: skip
    known = causes if unit is None else [*causes, unit]
    if len(known) == 1:
        return known
    for number, each in enumerate(found[:_MOST]):
        others = _terms([*found[:number], *found[number + 1 :]])
        term = text.written(each.span)
        is_bare = not any(re.search(rf"\b{one.name}\b", term) for one in problem.parameters)
        factors = _other_factors(problem, text, each)
        powers = [place for place in factors if is_bare or place[0] != place[1]]
        found[number] = _with_term(problem, each, factor(each, powers, others))
    return found


def _terms(mistakes: list[Diagnostic]) -> list[str]:
    """The terms that mistakes are about."""
    return sorted(each.message.partition(" is ")[0] for each in mistakes)


def _with_usual_units(problem: Problem) -> Problem:
    """The problem with lengths and angles for the coordinates that have no unit."""
    kept = tuple(
        one if one.unit is not None else replace(one, unit="rad" if is_angle(one.name) else "m")
        for one in problem.coordinates
    )
    return replace(problem, coordinates=kept)


def _with_term(
    problem: Problem, mistake: Diagnostic, places: list[_Place], unit: Diagnostic | None = None
) -> Diagnostic:
    """The mistake with its term, in one way or two, or with the unit, as it fits.

    A unit that the quantity has in most books comes before another term, any other one after.
    """
    if mistake.hint.startswith(("write ", "give ", "declare ")):  # of units and numbers
        return mistake
    text, written = SourceText.of(problem.source), problem.source.text
    begin, stop = text.offsets(mistake.span)
    fitting = " or ".join(
        written[begin:first] + better + written[last:stop]
        for first, last, better in places
        if begin <= first <= last <= stop
    )
    if unit is not None and (not fitting or _is_usual(unit)):
        given = written[slice(*text.offsets(unit.span))]
        quantity = unit.message.split("'")[1]
        better = unit.hint.removeprefix("write ")
        is_torque = better == "J" and "must be a torque" in mistake.message
        fitting = f"{'N m' if is_torque else better} for the unit {given} of {quantity}"
    potential = problem.potential or ZERO
    subtracted = [x for x in terms_of(potential) if isinstance(x, Negative)]
    if fitting.endswith("^2/2") and mistake.span in {each.operand.span for each in subtracted}:
        sign = written.rindex("-", 0, begin)  # -k*x, the force of a spring
        others = "+ " * (text.offsets(potential.span)[0] < sign)
        hint = f"write {others}{fitting}: V is minus the integral of the force"
        message = mistake.message.replace("'", "'-", 1)
        return replace(mistake, message=message, span=text.span(sign, stop), hint=hint)
    return replace(mistake, hint=f"write {fitting}: {mistake.hint}") if fitting else mistake


def _is_usual(unit: Diagnostic) -> bool:
    """Whether the unit in a hint is the usual one of its quantity, as m/s^2 of g."""
    from lagcli.dimensions.usual import is_usual

    return is_usual(unit.message.split("'")[1], unit.hint.removeprefix("write "))


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
    factor = re.compile(  # of one that contains others: (x - y), (l1*(x - y))
        rf"(?<![\w.'^])(?=(?P<base>(?:{names})'*(?![\w('])|\((?:[^()]|\([^()]*\))*\))"
        r"(?P<rest>(?:\s*(?:\^|\*\*)\s*(?P<power>\d+))?)(?![\w.^]))"
    )
    term = text.source.text[start:end]
    has_arm = _is_energy(mistake) or "a torque (N m)" in mistake.message
    moving = [one for one in problem.coordinates if has_arm and one.unit != "rad"]
    others = [x.name for x in (*problem.parameters, *moving) if x.name not in _words(term)]
    places = [(start, start, f"{other}*") for other in others]
    for each in factor.finditer(text.source.text, start, end):
        power, base = int(each["power"] or 1), each["base"]
        begin, stop = each.start(), each.end("rest")
        before, rest = text.source.text[start:begin], text.source.text[stop:end]
        is_plain = _is_energy(mistake) and not re.search(r"[^\w\s*]|(?<!\w)\d", before + rest)
        if power == 1 and is_plain and _words(base) & {x.name for x in problem.coordinates}:
            places.append((begin, end, f"{base}^2{rest}/2"))  # k*x of k*x^2/2
        else:
            places.append((begin, stop, f"{base}^{power + 1}"))
        if power > 1:
            places.append((begin, stop, f"{base}^{power - 1}" if power > 2 else base))
        elif times := re.search(r"\s*(?<!\*)\*\s*$", before):
            places.append((begin - len(times[0]), stop, ""))
        else:
            times = re.match(r"\s*\*\s*", rest)
            places.append((begin, stop + len(times[0]), "") if times else (begin, stop, "1"))
    return places


def _with_coordinate(problem: Problem, text: SourceText, mistake: Diagnostic) -> list[list[_Place]]:
    """The places of a coordinate more behind constants, as in m*g*y, and of its square: k*x^2/2."""
    start, end = text.offsets(mistake.span)
    half = re.search(r"\s*/\s*2\s*$|$", text.source.text[start:end])
    at = start + half.start() if half else end
    powers = ("", "^2") if at < end else ("",)
    return [[(at, at, f"*{x.name}{power}") for x in problem.coordinates] for power in powers]


def _is_energy(mistake: Diagnostic) -> bool:
    """Whether the term is to be an energy."""
    return re.search(r"(?:an energy|energies) \(J\)$", mistake.message) is not None


def _words(term: str) -> set[str]:
    return {*re.findall(r"[^\W\d]\w*", term)}


def _squares(places: list[_Place], term: str, problem: Problem) -> list[_Place]:
    """Those of a square of coordinates, where the term is a half: k*x^2/2, not k*l*x/2."""
    names = {each.name for each in problem.coordinates}
    if not re.search(r"/\s*2(?![\w.^])|(?<![\w.])0?\.5(?!\d)", term):
        return []
    return [x for x in places if x[2].endswith("^2") and names & _words(x[2])]
