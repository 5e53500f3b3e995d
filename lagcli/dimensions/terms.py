"""The dimension of a formula, and what each part of it demands of the others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction

from lagcli.diagnostics import NOWHERE, Span
from lagcli.dimensions.forms import NUMBER, TIME, Form, Key, minus, plus, times, unknown, unknowns
from lagcli.expression import (
    Call,
    Diff,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    folded,
    terms_of,
    walk,
)
from lagcli.record import field, record

#: Functions of a number whose value is a number.
_OF_NUMBERS = frozenset(
    "exp sin cos tan cot sec csc asin acos atan sinh cosh tanh asinh acosh atanh".split()
)


@record
class Term:
    """A part of a formula with its dimension."""

    node: Expression
    form: Form


@record(kw_only=True)
class Group:
    """Terms that must all have one dimension.

    Attributes
    ----------
    expected
        That dimension, where it follows from the place; `subject` says what must have it, as
        in "the argument of sin".
    usual
        The one that a term is likely to have.
    is_force
        Whether they are generalized forces: what has the unit of an energy is a torque then.
    """

    terms: tuple[Term, ...]
    expected: Form | None = None
    subject: str = ""
    usual: Form | None = None
    is_force: bool = False
    span: Span = field(default=NOWHERE, compare=False)

    @property
    def representative(self) -> Form:
        """What the terms are compared with: what is expected, or the first known majority."""
        for form in (self.expected, self.usual):
            if form is not None:
                return form
        return representative([term.form for term in self.terms])


def representative(forms: Sequence[Form]) -> Form:
    """The dimension of most of those that are known, the earlier one where there are as many."""
    known = [form for form in forms if not unknowns(form)] or forms
    alike: dict[frozenset[tuple[Key, Fraction]], list[Form]] = {}
    for form in known:
        alike.setdefault(frozenset(form.items()), []).append(form)
    return max(alike.values(), key=len)[0]


class Reader:
    """Reads formulas; the groups that they demand gather.

    Parameters
    ----------
    names
        The dimensions of coordinates, parameters, multipliers, momenta, `t` and `pi`.
    """

    def __init__(self, names: dict[str, Form]) -> None:
        self.names = names
        self.groups: list[Group] = []
        self.powers: dict[Power, Form] = {}  # with an unknown exponent; and the base's dimension

    def terms(self, expression: Expression, *, given_number: bool = False) -> list[Term]:
        """The terms of the outermost sum, without zeros.

        With `given_number`, a term without names is a number in the unit of the whole and is
        left out.
        """
        found = []
        for node in terms_of(expression):
            form = self.form(node)
            if form is None or (given_number and not _has_names(node)):
                continue
            found.append(Term(node, form))
        return found

    def demand(
        self,
        terms: Iterable[Term],
        expected: Form | None = None,
        subject: str = "",
        *,
        is_force: bool = False,
    ) -> Form | None:
        """Enter a group; the dimension that its terms have."""
        parts = tuple(terms)
        if not parts:
            return None
        alone = [part.form for part in parts if isinstance(bare(part.node), Name)]
        has_numbers = not all(_has_names(part.node) for part in parts)
        group = Group(
            terms=parts,
            expected=expected,
            subject=subject,
            usual=representative(alone) if alone and has_numbers else None,  # x of x - 1
            span=parts[0].node.span.to(parts[-1].node.span),
            is_force=is_force,
        )
        if len(parts) > 1 or expected is not None:
            self.groups.append(group)
        return group.representative

    def form(self, expression: Expression) -> Form | None:
        """The dimension of a formula; None of 0, which has any."""
        nodes = list(walk(expression))
        numbers = dict(item for node in nodes for item in _must_be_numbers(node))
        found: dict[int, Form | None] = {}
        for node in reversed(nodes):  # parts before the whole
            found[id(node)] = self._form(node, found, numbers.get(id(node), ""))
        return found[id(expression)]

    def _form(self, node: Expression, found: dict[int, Form | None], number: str) -> Form | None:
        match node:
            case Number(value=value):
                return NUMBER if value else None
            case Name():
                return self._name(node)
            case Negative(operand=operand):
                return found[id(operand)]
            case Sum(terms=parts):
                forms = [(part, found[id(part)]) for part in parts]
                terms = [Term(part, form) for part, form in forms if form is not None]
                return self.demand(terms, NUMBER if number else None, number)
            case Product(factors=parts):
                return _product([found[id(part)] for part in parts])
            case Quotient(numerator=above, denominator=below):
                return _product([found[id(above)], times(found[id(below)] or NUMBER, _MINUS)])
            case Power():
                return self._power(node, found)
            case Call():
                return self._call(node, found)
            case PartialCall(function=name, indices=indices, arguments=arguments):
                self._arguments(name, arguments, found)
                slopes = [unknown("argument", name, index) for index in indices]
                return self._divided(unknown("function", name), slopes)
            case Diff(operand=operand, variable=variable):
                whole, by = found[id(operand)], self._name(variable)
                return None if whole is None else minus(whole, by)
            case _:
                raise TypeError(f"{type(node).__name__} has no dimension")

    def _name(self, node: Name) -> Form:
        return plus(self.names.get(node.name, NUMBER), TIME, -node.primes)

    def _power(self, node: Power, found: dict[int, Form | None]) -> Form | None:
        base = found[id(node.base)]
        self._number(node.exponent, found[id(node.exponent)], _EXPONENT)
        if base is None:
            return None
        number = _constant(node.exponent)
        if number is not None:
            return times(base, number)
        if not base:
            return NUMBER
        self.powers[node] = base
        return unknown("power", node)

    def _call(self, node: Call, found: dict[int, Form | None]) -> Form | None:
        name, arguments = node.function, node.arguments
        forms = [found[id(argument)] for argument in arguments]
        if name in {"sqrt", "abs"}:
            form = forms[0]
            return times(form, Fraction(1, 2)) if form is not None and name == "sqrt" else form
        if name in {"sign", "log"}:  # the logarithm of a length is one up to a constant
            return NUMBER
        if name == "atan2":
            parts = zip(arguments, forms, strict=True)
            self.demand(Term(part, form) for part, form in parts if form is not None)
            return NUMBER
        if name in _OF_NUMBERS:
            self._number(arguments[0], forms[0], _argument_of(name))
            return NUMBER
        self._arguments(name, arguments, found)
        slopes = [unknown("argument", name, 1)] * node.primes
        return self._divided(unknown("function", name), slopes)

    def _number(self, node: Expression, form: Form | None, subject: str) -> None:
        """Demand a number, but of a sum, which has demanded it of its terms."""
        if form is not None and not isinstance(node, Sum):
            self.demand([Term(node, form)], NUMBER, subject)

    def _arguments(
        self, name: str, arguments: Sequence[Expression], found: dict[int, Form | None]
    ) -> None:
        for index, argument in enumerate(arguments, 1):
            form = found[id(argument)]
            if form is not None:
                self.demand([Term(argument, form)], unknown("argument", name, index),
                            f"an argument of {name}")  # fmt: skip

    @staticmethod
    def _divided(form: Form, slopes: Iterable[Form]) -> Form:
        for slope in slopes:
            form = minus(form, slope)
        return form


def bare(node: Expression) -> Expression:
    """A term without its sign."""
    return node.operand if isinstance(node, Negative) else node


_MINUS = Fraction(-1)


_EXPONENT = "an exponent"


def _argument_of(function: str) -> str:
    return f"the argument of {function}"


def _must_be_numbers(node: Expression) -> Iterator[tuple[int, str]]:
    """The parts of a node that must be numbers, and what they are."""
    match node:
        case Call(function=name, arguments=(argument,)) if name in _OF_NUMBERS:
            yield id(argument), _argument_of(name)
        case Power(exponent=exponent):
            yield id(exponent), _EXPONENT
        case _:
            pass


def _has_names(node: Expression) -> bool:
    return any(isinstance(part, Name) and part.name != "pi" for part in walk(node))


def _product(forms: Iterable[Form | None]) -> Form | None:
    total = NUMBER
    for form in forms:
        if form is None:
            return None
        total = plus(total, form)
    return total


def _constant(node: Expression) -> Fraction | None:
    """A rational number that is written out: `2`, `-1/2`, `(3 - 1)/2`."""
    return folded(node, _number)


def _number(node: Expression, parts: list[Fraction | None]) -> Fraction | None:
    known = [part for part in parts if part is not None]
    match node:
        case Number(value=value):
            return value
        case _ if len(known) < len(parts):
            return None
        case Negative():
            return -known[0]
        case Quotient():
            return known[0] / known[1] if known[1] else None
        case Sum():
            return sum(known, Fraction(0))
        case _:
            return None
