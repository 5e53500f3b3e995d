"""The value of an expression tree at a moment of a motion, with all derivatives."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from mpmath import mp, mpf

from lagcli import expression
from lagcli.expression import (
    Call,
    Diff,
    Expression,
    Name,
    Negative,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
)

from .functions import ELEMENTARY, StandIn, integral
from .jets import Jet, Number, OutsideDomain, coefficient, family, infinitesimal, power


@dataclass(frozen=True)
class Setting:
    """What does not move: coordinate names, definitions, stand-ins of the functions."""

    coordinates: tuple[str, ...]
    definitions: Mapping[str, Expression]
    functions: Mapping[str, StandIn]


@dataclass(frozen=True)
class Moment:
    """The time, q and its time derivatives (q, q', q'', ...), and the named constants.

    A derivative beyond those given is 0; `extra` holds parameters, multipliers, momenta.
    """

    t: Number
    chain: tuple[tuple[Number, ...], ...]
    extra: Mapping[str, Number] = field(default_factory=dict)

    def shifted(self, level: int, steps: Mapping[int, Number]) -> Moment:
        """With steps added to some components of the level-th derivative of q."""
        row = tuple(x + steps[i] if i in steps else x for i, x in enumerate(self.chain[level]))
        return replace(self, chain=(*self.chain[:level], row, *self.chain[level + 1 :]))

    def after(self, step: Jet) -> Moment:
        """An infinitesimal time later: every derivative moves by the next one."""
        still = tuple(mpf(0) for _ in self.chain[0])
        following = (*self.chain[1:], still)
        chain = tuple(
            tuple(x + step * v for x, v in zip(now, then, strict=True))
            for now, then in zip(self.chain, following, strict=True)
        )
        return replace(self, t=step + self.t, chain=chain)


def evaluate(node: Expression, setting: Setting, moment: Moment) -> Number:
    """The value of an expression; a jet where the moment holds jets."""

    def value(part: Expression) -> Number:
        return evaluate(part, setting, moment)

    match node:
        case expression.Number(value=fraction):
            return mpf(fraction.numerator) / fraction.denominator
        case Name(name=name, primes=primes):
            return _named(name, primes, setting, moment)
        case Negative(operand=operand):
            return -value(operand)
        case Sum(terms=terms):
            total = value(terms[0])
            for term in terms[1:]:
                total = total + value(term)
            return total
        case Product(factors=factors):
            product = value(factors[0])
            for factor in factors[1:]:
                product = product * value(factor)
            return product
        case Quotient(numerator=numerator, denominator=denominator):
            return value(numerator) * power(value(denominator), mpf(-1))
        case Power(base=base, exponent=exponent):
            return _power(value(base), value(exponent))
        case Call(function="integral", arguments=[integrand, Name(name=name), start, end]):

            def at(x: Number) -> Number:
                there = replace(moment, extra={**moment.extra, name: x})
                return evaluate(integrand, setting, there)

            return integral(at, value(start), value(end))
        case Call(function=function, arguments=arguments, primes=primes):
            values = [value(argument) for argument in arguments]
            if function in setting.functions:
                return setting.functions[function](values, (0,) * primes)
            return ELEMENTARY[function](*values)
        case PartialCall(function=function, indices=indices, arguments=arguments):
            values = [value(argument) for argument in arguments]
            return setting.functions[function](values, [i - 1 for i in indices])
        case Diff(operand=operand, variable=variable):
            return _partial(operand, variable, setting, moment)
    raise TypeError(f"{type(node).__name__} has no value")


def _power(base: Number, exponent: Number) -> Number:
    if not isinstance(exponent, Jet):
        return power(base, exponent)
    return ELEMENTARY["exp"](exponent * ELEMENTARY["log"](base))


def _named(name: str, primes: int, setting: Setting, moment: Moment) -> Number:
    if name in moment.extra and not primes:
        return moment.extra[name]
    if name in setting.coordinates:
        return moment.chain[primes][setting.coordinates.index(name)]
    if name in setting.definitions:
        if not primes:
            return evaluate(setting.definitions[name], setting, moment)
        with family() as later:
            then = moment.after(infinitesimal(later))
            return coefficient(_named(name, primes - 1, setting, then), later)
    if name == "t":
        return moment.t
    if name == "pi":
        return +mp.pi
    raise KeyError(name + "'" * primes)


def _partial(operand: Expression, variable: Name, setting: Setting, moment: Moment) -> Number:
    with family() as nearby:
        e = infinitesimal(nearby)
        if variable.name in setting.coordinates:
            index = setting.coordinates.index(variable.name)
            there = moment.shifted(variable.primes, {index: e})
        elif variable.name == "t":
            there = replace(moment, t=moment.t + e)
        else:
            extra = {**moment.extra, variable.name: moment.extra[variable.name] + e}
            there = replace(moment, extra=extra)
        return coefficient(evaluate(operand, setting, there), nearby)


__all__ = ["Moment", "OutsideDomain", "Setting", "evaluate"]
