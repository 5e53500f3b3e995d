"""Straight-line programs: expression trees as steps, each step once, with rules to differentiate.

A step is a sum, a product, a function of earlier steps, a number or a symbol.  Nothing is
simplified: a program evaluates a formula as it is written.  Derivatives are those of
automatic differentiation, from the partial derivatives of single steps; see A. Griewank,
A. Walther, *Evaluating Derivatives*, 2nd ed. (SIAM, 2008), chapters 2 and 3.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from fractions import Fraction
from typing import Literal, NamedTuple

from lagcli import expression as tree
from lagcli.expression import FUNCTIONS, Expression

Kind = Literal["number", "symbol", "sum", "product", "power", "call", "unspecified", "integral"]
#: A name with its primes.
Key = tuple[str, int]


class ProgramStep(NamedTuple):
    """One operation on earlier steps; `what` is the number, key, exponent or function."""

    kind: Kind
    what: object
    parts: tuple[int, ...] = ()


class VerificationProgram:
    """The steps of all formulas of one problem.

    Parameters
    ----------
    coordinates
        Their names: q has the rate q', q' the rate q''.
    functions
        The names that a file leaves unspecified.
    definitions
        Name -> tree; a prime on one is its total time derivative.
    """

    def __init__(
        self,
        coordinates: tuple[str, ...],
        functions: Iterable[str],
        definitions: Mapping[str, Expression],
    ) -> None:
        self.coordinates = frozenset(coordinates)
        self.functions = frozenset(functions)
        self.definitions = dict(definitions)
        self.steps: list[ProgramStep] = []
        self._place: dict[ProgramStep, int] = {}
        self._trees: dict[int, tuple[Expression, int]] = {}
        self._named: dict[str, int] = {}
        self._slopes: dict[int, list[tuple[int, int]]] = {}
        self._rates: dict[int, int] = {}
        self.zero = self.number(Fraction(0))
        self.one = self.number(Fraction(1))

    # -- steps ------------------------------------------------------------------------------

    def step(self, kind: Kind, what: object, parts: tuple[int, ...] = ()) -> int:
        """The place of a step, made once."""
        made = ProgramStep(kind, what, parts)
        place = self._place.get(made)
        if place is None:
            place = self._place[made] = len(self.steps)
            self.steps.append(made)
        return place

    def number(self, value: Fraction) -> int:
        """A rational number."""
        return self.step("number", value)

    def symbol(self, name: str, primes: int = 0) -> int:
        """A quantity that the environment gives."""
        return self.step("symbol", (name, primes))

    def sum(self, *parts: int) -> int:
        """a + b + …; zeros are left out."""
        kept = tuple(part for part in parts if part != self.zero)
        if len(kept) < 2:
            return kept[0] if kept else self.zero
        return self.step("sum", None, kept)

    def product(self, a: int, b: int) -> int:
        """a b; a factor 0 or 1 needs no step."""
        if self.zero in {a, b}:
            return self.zero
        if a == self.one:
            return b
        return a if b == self.one else self.step("product", None, (a, b))

    def negative(self, a: int) -> int:
        """-a."""
        return self.product(self.number(Fraction(-1)), a)

    def power(self, a: int, exponent: Fraction) -> int:
        """a^r with a rational r."""
        if exponent == 1:
            return a
        return self.product(a, a) if exponent == 2 else self.step("power", exponent, (a,))

    def call(self, function: str, *parts: int) -> int:
        """A function of the grammar."""
        return self.step("call", function, parts)

    # -- trees to steps -----------------------------------------------------------------------

    def of(self, node: Expression) -> int:
        """The step that has the value of a tree."""
        known = self._trees.get(id(node))
        if known is None:
            known = self._trees[id(node)] = node, self._of(node)
        return known[1]

    def _of(self, node: Expression) -> int:
        match node:
            case tree.Number(value=value):
                return self.number(value)
            case tree.Name(name=name, primes=primes):
                return self._name(name, primes)
            case tree.Negative(operand=operand):
                return self.negative(self.of(operand))
            case tree.Sum(terms=terms):
                return self.step("sum", None, tuple(map(self.of, terms)))
            case tree.Product(factors=factors):
                return self._product([self.of(factor) for factor in factors])
            case tree.Quotient(numerator=above, denominator=below):
                return self.product(self.of(above), self.power(self.of(below), Fraction(-1)))
            case tree.Power(base=base, exponent=exponent):
                return self._power(self.of(base), self.of(exponent))
            case tree.Call(function="integral") if "integral" not in self.functions:
                return self._integral(node.arguments)
            case tree.Call(function=function, arguments=arguments, primes=primes):
                parts = tuple(map(self.of, arguments))
                if function in self.functions:
                    return self.step("unspecified", (function, (0,) * primes), parts)
                if function not in FUNCTIONS:
                    raise KeyError(function)
                return self.call(function, *parts)
            case tree.PartialCall(function=function, indices=indices, arguments=arguments):
                by = tuple(sorted(index - 1 for index in indices))
                return self.step("unspecified", (function, by), tuple(map(self.of, arguments)))
            case tree.Diff(operand=operand, variable=variable):
                symbol = self.symbol(variable.name, variable.primes)
                return self.derivative(self.of(operand), {symbol: self.one})
        raise TypeError(f"{type(node).__name__} has no value")

    def _integral(self, arguments: tuple[Expression, ...]) -> int:
        """`integral(f, x, a, b)`; inside, x is a symbol that nothing else is."""
        integrand, variable, start, end = arguments
        assert isinstance(variable, tree.Name)
        inner = self.symbol(f"{variable.name}~", variable.primes)
        with self.standing_for(variable.name, inner):
            inside = self.of(integrand)
        return self._integral_of(inner, inside, self.of(start), self.of(end))

    def _integral_of(self, inner: int, inside: int, start: int, end: int) -> int:
        """The integral of a step by a symbol."""
        if inside == self.zero:
            return self.zero
        outer = [p for p in self.order([inside]) if self.steps[p].kind == "symbol" and p != inner]
        return self.step("integral", (inner, inside), (start, end, *outer))

    def define(self, name: str, place: int) -> None:
        """Let a name stand for a step."""
        self._named[name] = place

    @contextmanager
    def standing_for(self, name: str, place: int) -> Iterator[None]:
        """Let a name stand for a step meanwhile: the variable of an integral."""
        before = self._named.get(name)
        self._named[name] = place
        yield
        del self._named[name]
        if before is not None:
            self._named[name] = before

    def _name(self, name: str, primes: int) -> int:
        if name in self._named:
            place = self._named[name]
        elif name in self.definitions:
            place = self.of(self.definitions[name])
        else:
            return self.symbol(name, primes)
        for _ in range(primes):
            place = self.rate(place)
        return place

    def _product(self, parts: list[int]) -> int:
        place = parts[0]
        for part in parts[1:]:
            place = self.product(place, part)
        return place

    def _power(self, base: int, exponent: int) -> int:
        constant = self.constant(exponent)
        if constant is not None:
            return self.power(base, constant)
        return self.call("exp", self.product(exponent, self.call("log", base)))

    def constant(self, place: int) -> Fraction | None:
        """The value of a step made of rational numbers alone."""
        kind, what, parts = self.steps[place]
        if kind == "number":
            assert isinstance(what, Fraction)
            return what
        if kind not in {"sum", "product", "power"}:
            return None
        values = [self.constant(part) for part in parts]
        if any(value is None for value in values):
            return None
        numbers = [value for value in values if value is not None]
        if kind == "sum":
            return sum(numbers, Fraction(0))
        if kind == "product":
            return numbers[0] * numbers[1]
        assert isinstance(what, Fraction)
        whole = what.denominator == 1 and (numbers[0] != 0 or what > 0)
        return numbers[0] ** int(what) if whole else None

    # -- derivatives ----------------------------------------------------------------------------

    def slopes(self, place: int) -> list[tuple[int, int]]:
        """The partial derivatives of a step: (part, step of the derivative by it)."""
        found = self._slopes.get(place)
        if found is None:
            found = self._slopes[place] = self._make_slopes(place)
        return found

    def _make_slopes(self, place: int) -> list[tuple[int, int]]:
        kind, what, parts = self.steps[place]
        match kind:
            case "sum":
                return [(part, self.one) for part in parts]
            case "product":
                a, b = parts
                return [(a, b), (b, a)]
            case "power":
                assert isinstance(what, Fraction)
                lower = self.power(parts[0], what - 1)
                return [(parts[0], self.product(self.number(what), lower))]
            case "unspecified":
                name, by = what  # type: ignore[misc]
                return [
                    (part, self.step("unspecified", (name, tuple(sorted((*by, k)))), parts))  # type: ignore[has-type]
                    for k, part in enumerate(parts)
                ]
            case "call":
                return list(zip(parts, _SLOPES[str(what)](self, place, *parts), strict=True))
            case "integral":
                return self._slopes_of_integral(place)
            case _:
                return []

    def _slopes_of_integral(self, place: int) -> list[tuple[int, int]]:
        """d of the integral of f from a to b = f(b) db - f(a) da + the integral of df (Leibniz)."""
        _, what, (start, end, *outer) = self.steps[place]
        inner, inside = what  # type: ignore[misc]
        found = [
            (start, self.negative(self._substituted(inside, inner, start))),  # type: ignore[has-type]
            (end, self._substituted(inside, inner, end)),  # type: ignore[has-type]
        ]
        for symbol in outer:
            slope = self.derivative(inside, self.seeds(inside, symbol))  # type: ignore[has-type]
            found.append((symbol, self._integral_of(inner, slope, start, end)))  # type: ignore[has-type]
        return found

    def _substituted(self, root: int, old: int, new: int) -> int:
        """The step with one step in the place of another."""
        known = {old: new}
        for place in self.order([root]):
            if place not in known:
                kind, what, parts = self.steps[place]
                moved = tuple(known[part] for part in parts)
                known[place] = place if moved == parts else self.step(kind, what, moved)
        return known[root]

    def seeds(self, root: int, symbol: int) -> dict[int, int]:
        """1 for one symbol, 0 for the other ones that a step needs."""
        places = self.order([root])
        found = {p: self.zero for p in places if not self.steps[p].parts}
        return {**found, symbol: self.one}

    def derivative(self, place: int, seeds: Mapping[int, int]) -> int:
        """The step of sum_s (d/ds) * seeds[s], the symbols s given by their steps."""
        known = dict(seeds)
        for each in self.order([place]):
            if each not in known:
                terms = [
                    self.product(slope, known[part])
                    for part, slope in self.slopes(each)
                    if known[part] != self.zero
                ]
                known[each] = self.sum(*terms)
        return known[place]

    def rate(self, place: int) -> int:
        """The total time derivative."""
        if place not in self._rates:
            seeds = {}
            for each in self.order([place]):
                if self.steps[each].kind == "symbol":
                    name, primes = self.steps[each].what  # type: ignore[misc]
                    if name == "t":  # type: ignore[has-type]
                        seeds[each] = self.one
                    elif name in self.coordinates:  # type: ignore[has-type]
                        seeds[each] = self.symbol(name, primes + 1)  # type: ignore[has-type]
            self._rates[place] = self.derivative(place, seeds)
        return self._rates[place]

    def order(self, roots: Iterable[int]) -> list[int]:
        """The steps that the roots need, each after its parts."""
        seen: set[int] = set()
        stack = list(roots)
        while stack:
            place = stack.pop()
            if place not in seen:
                seen.add(place)
                stack.extend(self.steps[place].parts)
        return sorted(seen)  # parts are made first

    def symbols(self, roots: Iterable[int]) -> set[Key]:
        """The names, with their primes, that the roots need."""
        kinds = (self.steps[place] for place in self.order(roots))
        return {each.what for each in kinds if each.kind == "symbol"}  # type: ignore[misc]


Slopes = Callable[..., tuple[int, ...]]


def _over(sign: int, square: int, exponent: Fraction) -> Slopes:
    """±(1 + square x^2)^exponent."""

    def slope(p: VerificationProgram, _: int, x: int) -> tuple[int, ...]:
        inner = p.sum(p.one, p.product(p.number(Fraction(square)), p.product(x, x)))
        return (p.product(p.number(Fraction(sign)), p.power(inner, exponent)),)

    return slope


def _atan2(p: VerificationProgram, _: int, y: int, x: int) -> tuple[int, int]:
    """d atan2(y, x) = (x dy - y dx)/(x^2 + y^2)."""
    over = p.power(p.sum(p.product(x, x), p.product(y, y)), Fraction(-1))
    return p.product(x, over), p.product(p.negative(y), over)


def _acosh(p: VerificationProgram, _: int, x: int) -> tuple[int, ...]:
    return (p.power(p.sum(p.product(x, x), p.number(Fraction(-1))), Fraction(-1, 2)),)


_HALF = Fraction(-1, 2)
_SQUARE = Fraction(-2)
_SLOPES: dict[str, Slopes] = {
    "sqrt": lambda p, z, _: (p.product(p.number(Fraction(1, 2)), p.power(z, Fraction(-1))),),
    "exp": lambda _p, z, _: (z,),
    "log": lambda p, _, x: (p.power(x, Fraction(-1)),),
    "abs": lambda p, _, x: (p.call("sign", x),),
    "sign": lambda p, _, _x: (p.call("flat", _x),),
    "flat": lambda p, _, _x: (p.call("flat", _x),),
    "sin": lambda p, _, x: (p.call("cos", x),),
    "cos": lambda p, _, x: (p.negative(p.call("sin", x)),),
    "tan": lambda p, _, x: (p.power(p.call("cos", x), _SQUARE),),
    "cot": lambda p, _, x: (p.negative(p.power(p.call("sin", x), _SQUARE)),),
    "sec": lambda p, z, x: (p.product(z, p.call("tan", x)),),
    "csc": lambda p, z, x: (p.negative(p.product(z, p.call("cot", x))),),
    "asin": _over(1, -1, _HALF),
    "acos": _over(-1, -1, _HALF),
    "atan": _over(1, 1, Fraction(-1)),
    "atan2": _atan2,
    "sinh": lambda p, _, x: (p.call("cosh", x),),
    "cosh": lambda p, _, x: (p.call("sinh", x),),
    "tanh": lambda p, _, x: (p.power(p.call("cosh", x), _SQUARE),),
    "asinh": _over(1, 1, _HALF),
    "acosh": _acosh,
    "atanh": _over(1, -1, Fraction(-1)),
}
