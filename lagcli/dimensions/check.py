"""Terms whose dimension does not fit, and units that do not go together, as diagnostics."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import chain, combinations, islice
from math import isclose, pi, prod

from lagcli.diagnostics import NOWHERE, Diagnostic, Severity, Span
from lagcli.dimensions.demands import LAGRANGIAN
from lagcli.dimensions.forms import ENERGY, TIME, Form, minus, plus, times, unknowns
from lagcli.dimensions.inference import Inference, gives_units, quantities
from lagcli.dimensions.kinds import kind
from lagcli.dimensions.system import Incoherent, dimension_of, meaning_of
from lagcli.dimensions.terms import Group, Reader, Term, bare, representative
from lagcli.dimensions.usual import is_usual
from lagcli.expression import Expression, Name, Negative, Number, walk
from lagcli.problem_data import JACOBI_FUNCTION, Problem, Quantity
from lagcli.record import replace
from lagcli.units import read_unit

#: What T may be: an energy, or one by mass or by moment of inertia, which then are 1.
_ENERGIES: tuple[Form, ...] = (ENERGY, {"m": Fraction(2), "s": Fraction(-2)}, {"s": Fraction(-2)})
#: A term longer than this is quoted by its beginning.
_QUOTED = 40
_NAMES_IN_HINT = 5
#: Of a half turn: the largest denominator of an angle in units of pi.
_DEGREES = 180
#: Letters for a quantity by its unit.
_LETTERS = {
    "s": ["t_1", "tau"],
    "1/s": ["omega", "gamma"],
    "m": ["a", "h"],
    "1/m": ["k"],
    "N": ["F"],
}
#: Wrong units that are looked for at once, and the sets of them that are tried.
_MOST_UNITS, _MOST_SETS = 3, 60


def check_dimensions(problem: Problem, limit: int) -> list[Diagnostic]:
    """The first `limit` terms with a wrong dimension; none where the file gives no units."""
    if not gives_units(problem):
        return []
    checker = _Checker(Inference(problem))
    found = checker.incoherent()
    if any(quantity.unit and form for quantity, form in checker.given()):
        found = chain(found, checker.odd_terms(), checker.no_energy())
    return list(dict.fromkeys(islice(found, limit)))


def energies_in(problem: Problem) -> int:
    """The number of terms of T and V, or of L, that are energies."""
    inference = Inference(problem)
    energies = inference.demands.energies
    terms = () if energies is None else energies.terms
    return [inference.form(term.form) for term in terms].count(ENERGY)


def wrong_units(problem: Problem, first: Diagnostic) -> list[Diagnostic]:
    """The fewest units without which every term fits, with those that then follow for them.

    A unit that is the usual one of its letter, as m/s^2 of g, is not a wrong one.

    Parameters
    ----------
    problem
        A problem with terms that do not fit.
    first
        The first of its mistakes.

    Returns
    -------
    list of Diagnostic
        One for each unit; empty where none explain the mistakes, or several sets do.
    """
    suspected = [q for q in quantities(problem) if q.unit and not is_usual(q.name, q.unit)]
    for size in range(1, _MOST_UNITS + 1):
        sets = islice(combinations(suspected, size), _MOST_SETS)
        found = [units for chosen in sets if (units := _units_that_fit(problem, chosen))]
        better = [each for each in found if all(is_usual(q.name, unit) for q, unit in each)]
        best = better or found
        if best:
            return [_wrong_unit(*each, first) for each in best[0]] if len(best) == 1 else []
    return []


def _units_that_fit(
    problem: Problem, chosen: Sequence[Quantity]
) -> list[tuple[Quantity, str]] | None:
    """The units that follow for some quantities with which every term fits; None without them."""
    names = {each.name for each in chosen}
    changed = replace(
        problem,
        coordinates=tuple(
            replace(q, unit=None) if q.name in names else q for q in problem.coordinates
        ),
        parameters=tuple(
            replace(q, unit=None) if q.name in names else q for q in problem.parameters
        ),
    )
    inference = Inference(changed)
    checker = _Checker(inference)
    if any(chain(checker.incoherent(), checker.odd_terms(), checker.no_energy())):
        return None
    units = [inference.unit(inference.demands.names[each.name]) for each in chosen]
    pairs = [(one, str(unit)) for one, unit in zip(chosen, units, strict=True) if unit is not None]
    if any("^(" in unit or unit.startswith("10^") for _, unit in pairs):
        return None  # nobody measures in m^(1/2), or in 10^-3 kg m: a term is wrong
    given = [read_unit(one.unit or "") for one in chosen]
    if any(x and dimension_of(x) == dimension_of(y) for x, y in zip(units, given, strict=True)):
        return None  # N m and g cm^2/s^2: the numbers would have to change as well
    return pairs if len(pairs) == len(chosen) else None


def _wrong_unit(quantity: Quantity, unit: str, first: Diagnostic) -> Diagnostic:
    message = f"the unit of '{quantity.name}' does not fit the terms of the file"
    related = ((first.span, first.message),)
    return Diagnostic(message, quantity.unit_span, f"write {unit}", related=related)


def check_formula(
    problem: Problem, formula: Expression, text: str, quantity: str = ""
) -> list[Diagnostic]:
    """What does not fit in a formula beside the file; none where the file gives no units.

    Parameters
    ----------
    problem
        A problem whose own terms fit.
    formula
        It may hold whatever the problem has a name for; numbers have the unit of their sum.
    text
        What the formula's spans point into.
    quantity
        The coordinate, velocity (x') or parameter whose value the formula is.
    """
    if not gives_units(problem) or check_dimensions(problem, 1):
        return []
    inference = Inference(problem)
    names = {**inference.demands.names, JACOBI_FUNCTION.name: LAGRANGIAN}
    names.setdefault("energy", LAGRANGIAN)
    reader = Reader(names)
    name = quantity.rstrip("'")
    expected = plus(names[name], TIME, len(name) - len(quantity)) if quantity else None
    subject = f"the value of '{quantity}'" if quantity else ""
    reader.demand(reader.terms(formula, given_number=True), expected, subject)
    checker = _Checker(inference, text)
    return list(dict.fromkeys(checker.odd_terms(reader.groups)))


class _Checker:
    """Words what an inference could not reconcile."""

    def __init__(self, inference: Inference, text: str | None = None) -> None:
        self.inference = inference
        self.problem = inference.problem
        self._declared: dict[tuple[str, str], str] = {}  # by unit and value, for hints
        self._lines = (self.problem.source.text if text is None else text).split("\n")

    def given(self) -> Iterator[tuple[Quantity, Form]]:
        names = self.inference.demands.names
        return ((quantity, names[quantity.name]) for quantity in quantities(self.problem))

    # Terms.

    def odd_terms(self, groups: Sequence[Group] | None = None) -> Iterator[Diagnostic]:
        """The odd ones of each group, of all that the file demands without others."""
        for group in self.inference.demands.groups if groups is None else groups:
            forms = [self.inference.form(term.form) for term in group.terms]
            reference = self._reference(group, forms)
            alike = [t for t, form in zip(group.terms, forms, strict=True) if form == reference]
            for term, form in zip(group.terms, forms, strict=True):
                if form != reference:
                    yield self._odd(group, term, form, alike, reference)

    def _reference(self, group: Group, forms: Sequence[Form]) -> Form:
        if group.expected is not None:
            return self.inference.form(group.expected)
        if group.usual in forms and group.usual is not None:
            return group.usual
        return representative(forms)

    def _odd(
        self, group: Group, term: Term, form: Form, alike: Sequence[Term], reference: Form
    ) -> Diagnostic:
        quoted = self._quoted(term.node)
        if unknowns(form) or unknowns(reference):
            other = group.subject or (self._quoted(alike[0].node) if alike else "the other terms")
            message = f"{quoted} differs from {other} by {self._factor(minus(form, reference))}"
        elif group.subject:
            torque = group.is_force and reference == ENERGY
            needed = "a torque (N m)" if torque else self._named(reference)
            message = f"{quoted} is {self._named(form)}, {group.subject} must be {needed}"
        elif len(alike) == 1:
            other = self._quoted(alike[0].node)
            message = f"{quoted} is {self._named(form)} where {other} is {self._named(reference)}"
        else:
            others = self._named(reference, several=True)
            message = f"{quoted} is {self._named(form)} where the other terms are {others}"
        nodes = [term.node, *(each.node for each in alike[:1])]
        advice = self._with_a_unit(term.node, minus(reference, form), is_argument=not reference)
        advice = advice or self._advice(term.node, form, reference)
        related = tuple(self._inferred(nodes))
        return Diagnostic(message, bare(term.node).span, advice, related=related)

    def _with_a_unit(self, node: Expression, missing: Form, *, is_argument: bool) -> str:
        """The 1 of `t - 1`, and the 2 of `sin(2*t)`, as a parameter with a unit."""
        number = re.match(r"([\d.]+)(?:\s*\*\s*(?=[^\W\d]))?", text := self._quoted(node)[1:-1])
        rest = text[number.end() :] if number else text
        is_rate = is_argument and re.fullmatch(r"[^\W\d]\w*", rest)
        if unknowns(missing) or not (is_rate or (number and not rest)):
            return ""
        unit = str(self.inference.system.unit(missing))
        value, taken = number[1] if number else "1", {*self.inference.demands.names}
        taken |= {*self._declared.values()} - {self._declared.get((unit, value), "")}
        names = (x + index for index in ("", "_0", "_1") for x in _LETTERS.get(unit, ["c"]))
        name = next((each for each in names if each not in taken), "c_2")
        self._declared[unit, value] = name
        given = f"{name}: {{unit: {unit}, value: {value}}}"
        return f"declare {given} under parameters, and write {name}{'*' * bool(rest)}{rest}"

    def no_energy(self) -> Iterator[Diagnostic]:
        """T and V, or L, whose terms agree, but on something that is no energy."""
        energies = self.inference.demands.energies
        forms = [] if energies is None else [self.inference.form(t.form) for t in energies.terms]
        if energies is None or any(form != forms[0] for form in forms):
            return
        node, form = energies.terms[0].node, forms[0]
        if unknowns(form) or form in _ENERGIES:
            return
        advice = self._advice(node, form, ENERGY)
        named, energy = self._named(form), self._named(ENERGY)
        if self.problem.lagrangian is None:
            letter = "T" if self.problem.hamiltonian is None else "H"
            message = f"{self._quoted(node)} is {named}, {letter} must be {energy}"
            yield Diagnostic(message, bare(node).span, advice)
        else:  # the length of a path has the same extremals as an energy
            message = f"L is usually {energy}, {self._quoted(node)} is {named}"
            yield Diagnostic(message, bare(node).span, advice, "warning")

    # Words.

    def _quoted(self, node: Expression) -> str:
        span = bare(node).span
        if span.line < 1:
            return "a term"
        last = span.end_line - 1
        lines = self._lines[span.line - 1 : last + 1]
        lines[-1] = lines[-1][: span.end_column - 1]
        lines[0] = lines[0][span.column - 1 :]
        text = " ".join(" ".join(lines).split())
        return f"'{text if len(text) <= _QUOTED else text[: _QUOTED - 1] + '…'}'"

    def _named(self, form: Form, *, several: bool = False) -> str:
        """`an energy (J)`, or the unit alone."""
        if not form:
            return kind(form, several=several)
        unit = self.inference.system.unit(form)
        name = kind(form, several=several)
        return f"{name} ({unit})" if name else f"in {unit}"

    def _advice(self, node: Expression, form: Form, reference: Form) -> str:
        """What is missing or too many, and in what units the term's names are."""
        parts = []
        ratio = minus(reference, form)
        if not unknowns(ratio):
            parts.append(self._missing(ratio))
        units = {q.name: q.unit for q in quantities(self.problem)}
        used = dict.fromkeys(part.name for part in walk(node) if isinstance(part, Name))
        known = [f"{name} in {units[name]}" for name in used if units.get(name)]
        if 0 < len(known) <= _NAMES_IN_HINT:
            parts.append(", ".join(known))
        return "; ".join(parts)

    def _missing(self, ratio: Form) -> str:
        """`a length (m) is missing`, `a time (s) too many`."""
        inverse = times(ratio, Fraction(-1))
        divides = all(exponent < 0 for exponent in ratio.values())
        if kind(ratio) and not divides:
            return f"{self._named(ratio)} is missing"
        if kind(inverse):
            return f"{self._named(inverse)} too many"
        return f"{self._factor(ratio)} is missing"

    def _factor(self, ratio: Form) -> str:
        name = self._named(ratio)
        return name if kind(ratio) else f"a factor {name}"

    def _inferred(self, nodes: Sequence[Expression]) -> Iterator[tuple[Span, str]]:
        """Where the units of the names without one come from."""
        names = self.inference.demands.names
        used = dict.fromkeys(n.name for node in nodes for n in walk(node) if isinstance(n, Name))
        for name in used:
            for key in unknowns(names.get(name, {})):
                unit = self.inference.unit(names[name])
                if (
                    unit is not None
                    and key[0] in {"coordinate", "parameter"}
                    and key in self.inference.relations.origins
                ):
                    origin = self.inference.relations.origins[key]
                    yield origin, f"'{name}' has no unit; from this it is in {unit}"

    # Units.

    def incoherent(self) -> Iterator[Diagnostic]:
        """Units with a factor between them; an error where the file has numbers."""
        has_numbers = bool(self.problem.initial) or any(
            parameter.value is not None for parameter in self.problem.parameters
        )
        severity: Severity = "error" if has_numbers else "warning"
        for found in self.inference.system.incoherent:
            message, hint = self._incoherence(found)
            related = (
                ()
                if found.other is None or found.other.span == NOWHERE
                else ((found.other.span, f"'{found.other.name}' is here"),)
            )
            yield Diagnostic(message, found.named.span, hint, severity, related)

    def _incoherence(self, found: Incoherent) -> tuple[str, str]:
        name, factor = found.named.name, f"{found.factor:.6g}"
        if found.other is not None:
            other = found.other.name
            what = f"'{name}' together with '{other}': numbers would be off by a factor of {factor}"
            hint = self._converted(found, other) or f"give all of them in {other}, or all in {name}"
            return what, hint
        dimension = dimension_of(read_unit(name))
        base = str(self.inference.system.unit(dimension)) if dimension else "rad"
        what = f"'{name}' is {factor} {base}: numbers would be off by that factor"
        return what, self._converted(found, base) or f"write {base}"

    def _converted(self, found: Incoherent, better: str) -> str:
        """`write unit: m, value: 0.8` for 80 cm; nothing where it has no number."""
        name = found.named.name
        quantity = next(q for q in quantities(self.problem) if q.unit_span == found.named.span)
        given = {"value": getattr(quantity, "value", None)} | {
            f"initial {each}": value for each, value in self.problem.initial.items()
            if each.name == quantity.name
        }  # fmt: skip
        numbers = {key: bare(node) for key, node in given.items() if node is not None}
        system, written = self.inference.system, quantity.unit or ""
        unit = read_unit(written)
        if better.isalpha() and name in dict(unit.factors):
            factor = found.factor ** float(dict(unit.factors)[name])
            better = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", better, written)
        else:
            form = dimension_of(unit)
            factor = prod(meaning_of(n).factor ** float(power) for n, power in unit.factors)
            factor /= system.factor({str(base): power for base, power in form.items()})
            better = str(system.unit(form))
        turns = Fraction(factor / pi).limit_denominator(_DEGREES)
        if not isclose(turns * pi, factor, rel_tol=1e-12):
            turns = Fraction(0)
        elif better.startswith("1/"):  # a rate of an angle
            better = f"rad{better[1:]}"
        if not numbers or better == written:
            return ""
        whole = [f"unit: {better}"]
        for key, number in numbers.items():
            if not isinstance(number, Number):
                return ""
            sign = "-" * isinstance(given[key], Negative)
            value = f"{float(number.value) * factor:.10g}"
            if exact := Fraction(number.value) * turns:
                times_ = f"{exact.numerator}*" * (exact.numerator > 1)
                value = f"{times_}pi" + f"/{exact.denominator}" * (exact.denominator > 1)
            whole.append(f"{key}: {sign}{value}")
        return f"write {', '.join(whole)}"
