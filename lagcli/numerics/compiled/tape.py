"""Nodes as a tape: operations of one or two operands, each with a recurrence for its series.

What depends on constants only is a number and no operation.  A multiple of an operation is
that operation with a factor, so no product is spent on parameters.

Whole powers are products, so that a base may be 0; other powers, which are real for a
positive base only, have a recurrence of their own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from lagcli.graph.nodes import Call, Node, Product, Sum, Symbol, ancestry
from lagcli.numerics.equations.arithmetic import Arithmetic, UndefinedFunction
from lagcli.numerics.equations.straight_line import straight_line

#: Powers higher than this are not written as products.
_HIGHEST = 4096


class NoSeries(Exception):
    """A function that has no recurrence here."""


class Op(NamedTuple):
    """An operation.

    Attributes
    ----------
    name : str
        `input`, `sum`, `product`, `quotient`, `power`, `root`, `exp`, `sin` (whose
        cosine follows it, `other`), `sinh` likewise, `tanh`, `primitive`, `angle`,
        `sign`, `side`, `signed`, `abs`, `sign_of`.
    operands : tuple of int
        Places on the tape.
    numbers : tuple
        The constant and the factors of a sum, the exponent of a power, the numerator of
        a quotient with one operand.
    word : str
        The function that gives the value itself, of a primitive.
    """

    name: str
    operands: tuple[int, ...] = ()
    numbers: tuple[Any, ...] = ()
    word: str = ""


class Scaled(NamedTuple):
    """factor * operation; a number where there is no operation."""

    factor: Any
    place: int | None


class Tape:
    """The operations for some nodes.

    Parameters
    ----------
    inputs
        The symbols that vary: the first operations.
    nodes
        What is wanted.
    constants, arithmetic
        As for `straight_line`.
    frozen
        Arguments of abs and sign whose sign is given -> its place in the list of signs.

    Attributes
    ----------
    ops : list of Op
    values : dict of Node to Scaled
        Every node wanted, and all that it is made of.

    Raises
    ------
    NoSeries
        For a function without a recurrence.
    ArithmeticError, ValueError
        Where a part that depends on constants only is not defined.
    """

    def __init__(
        self,
        inputs: Sequence[Symbol],
        nodes: Sequence[Node],
        constants: Mapping[Symbol, Any],
        arithmetic: Arithmetic,
        frozen: Mapping[Node, int] | None = None,
    ) -> None:
        self.ops: list[Op] = []
        self.values: dict[Node, Scaled] = {}
        self._known: dict[Op, int] = {}
        self._frozen = frozen or {}
        self._arithmetic = arithmetic
        self._one = arithmetic.number(Fraction(1))
        self._power = arithmetic.functions["power"]
        mask = 0
        for symbol in inputs:
            mask |= symbol.mask
            self.values[symbol] = Scaled(self._one, self._made(Op("input", (), (len(self.ops),))))
        every = ancestry(nodes)
        steady = [node for node in every if not node.mask & mask]
        numbers = straight_line((), steady, constants, arithmetic)()
        for node, number in zip(steady, numbers, strict=True):
            self.values[node] = Scaled(number, None)
        for node in every:
            if node not in self.values:
                self.values[node] = self._value(node)

    def _value(self, node: Node) -> Scaled:
        match node:
            case Sum():
                return self._sum(node)
            case Product(factors=factors):
                return self._product(factors)
            case Call(function="^", arguments=(base, exponent)):
                logarithm = self._function("log", self.values[base])
                return self._function("exp", self._times(logarithm, self.values[exponent]))
            case Call(function=name, arguments=(x,), indices=()) if x in self._frozen:
                return self._branch(name, self.values[x], self._frozen[x])
            case Call(function=name, arguments=(x,), indices=()):
                return self._function(name, self.values[x])
            case Call(function="atan2", arguments=(y, x), indices=()):
                return self._angle(self.values[y], self.values[x])
            case Call(function=name):
                raise UndefinedFunction(name)
            case Symbol(name=name):
                raise KeyError(name)
        raise TypeError(f"no node: {node!r}")

    # -- sums and products -----------------------------------------------------------------------

    def _sum(self, node: Sum) -> Scaled:
        number = self._arithmetic.number
        constant = number(node.constant)
        terms: list[tuple[int, Any]] = []
        for term, coefficient in node.terms:
            factor, place = self.values[term]
            if coefficient != 1:
                factor = factor * number(coefficient)
            if place is None:
                constant = constant + factor
            else:
                terms.append((place, factor))
        if len(terms) == 1 and constant == 0:
            return Scaled(terms[0][1], terms[0][0])
        return self._combination(constant, terms)

    def _combination(self, constant: Any, terms: Sequence[tuple[int, Any]]) -> Scaled:
        places, factors = zip(*terms, strict=True)
        return self._scaled(Op("sum", places, (constant, *factors)))

    def _product(self, factors: Sequence[tuple[Node, Fraction]]) -> Scaled:
        above = below = Scaled(self._one, None)
        for base, exponent in factors:
            value = self.values[base]
            if value.place is None:
                power = self._power(value.factor, self._arithmetic.number(exponent))
                above = Scaled(above.factor * power, above.place)
            elif exponent.denominator == 1 and abs(exponent) <= _HIGHEST:
                whole = self._whole(value, abs(int(exponent)))
                if exponent > 0:
                    above = self._times(above, whole)
                else:
                    below = self._times(below, whole)
            else:
                above = self._times(above, self._raised(value, exponent))
        return self._over(above, below)

    def _times(self, left: Scaled, right: Scaled) -> Scaled:
        factor = left.factor * right.factor
        if left.place is None or right.place is None:
            return Scaled(factor, right.place if left.place is None else left.place)
        pair = tuple(sorted((left.place, right.place)))
        return Scaled(factor, self._made(Op("product", pair)))

    def _over(self, above: Scaled, below: Scaled) -> Scaled:
        if below.place is None:
            return Scaled(above.factor / below.factor, above.place)
        operands = (below.place,) if above.place is None else (above.place, below.place)
        return Scaled(above.factor / below.factor, self._made(Op("quotient", operands)))

    def _whole(self, base: Scaled, exponent: int) -> Scaled:
        """A power as products, by squares."""
        result: Scaled | None = None
        while exponent:
            if exponent & 1:
                result = base if result is None else self._times(result, base)
            exponent >>= 1
            if exponent:
                base = self._times(base, base)
        return result or Scaled(self._one, None)

    def _raised(self, base: Scaled, exponent: Fraction) -> Scaled:
        """A power that is no whole one; a positive factor comes out of it."""
        place = self._row(base.place)
        number = self._arithmetic.number(exponent)
        factor = self._one
        if base.factor > 0:
            factor = self._power(base.factor, number)
        else:
            place = self.place_of(base)
        if exponent == Fraction(1, 2):
            return Scaled(factor, self._made(Op("root", (place,))))
        return Scaled(factor, self._made(Op("power", (place,), (number,))))

    # -- functions -------------------------------------------------------------------------------

    def _function(self, name: str, x: Scaled) -> Scaled:
        if x.place is None:  # a frozen argument of constants only does not occur
            return Scaled(self._arithmetic.functions[name](x.factor), None)
        row = self.place_of(x)
        here = Scaled(self._one, row)
        match name:
            case "exp" | "tanh" | "side":
                return self._scaled(Op(name, (row,)))
            case "sin" | "cos" | "sinh" | "cosh":
                kind = "sinh" if name.endswith("h") else "sin"
                first = self._made(Op(kind, (row,)))
                second = self._made(Op("other", (first,)))
                return Scaled(self._one, second if name.startswith("cos") else first)
            case "tan":
                return self._over(self._function("sin", x), self._function("cos", x))
            case "cot":
                return self._over(self._function("cos", x), self._function("sin", x))
            case "sec" | "csc":
                below = self._function("cos" if name == "sec" else "sin", x)
                return self._over(Scaled(self._one, None), below)
            case "log":
                return self._primitive("log", here, row)
            case "atan" | "atanh":
                return self._primitive(name, here, self._squared(row, 1 if name == "atan" else -1))
            case "asin" | "acos" | "asinh":
                rest = self._squared(row, 1 if name == "asinh" else -1)
                below = Scaled(self._one, self._made(Op("root", (rest,))))
                if name == "acos":
                    below = Scaled(-self._one, below.place)
                return self._primitive(name, here, self.place_of(below))
            case "acosh":
                one = -self._one
                inner = self.place_of(self._combination(one, [(self._square(row), self._one)]))
                return self._primitive(name, here, self._made(Op("root", (inner,))))
            case "abs" | "sign":
                return self._scaled(Op(name + "_of", (row,)))
        raise NoSeries(name)

    def _branch(self, name: str, x: Scaled, sign: int) -> Scaled:
        """abs or sign where the sign of x is given; any other function as it is."""
        if name == "sign":
            return self._scaled(Op("sign", (), (sign,)))
        if name == "abs":
            return Scaled(x.factor, self._made(Op("signed", (self._row(x.place),), (sign,))))
        return self._function(name, x)

    def _square(self, row: int) -> int:
        return self._made(Op("product", (row, row)))

    def _squared(self, row: int, sign: int) -> int:
        """1 + x^2 or 1 - x^2."""
        factor = self._one if sign > 0 else -self._one
        return self.place_of(self._combination(self._one, [(self._square(row), factor)]))

    def _primitive(self, word: str, x: Scaled, below: int) -> Scaled:
        """y with y' = x' / u."""
        return self._scaled(Op("primitive", (self._row(x.place), below), (), word))

    def _angle(self, y: Scaled, x: Scaled) -> Scaled:
        """atan2: its rate is (x y' - y x') / (x^2 + y^2)."""
        above, beside = self.place_of(y), self.place_of(x)
        squares = [(self._square(above), self._one), (self._square(beside), self._one)]
        below = self.place_of(self._combination(self._arithmetic.number(Fraction(0)), squares))
        return self._scaled(Op("angle", (above, beside, below)))

    # -- places ----------------------------------------------------------------------------------

    def place_of(self, value: Scaled) -> int:
        """A place that is the value itself, with no factor; it may be a new one."""
        if value.place is not None and value.factor == 1:
            return value.place
        zero = self._arithmetic.number(Fraction(0))
        if value.place is None:
            return self._made(Op("sum", (), (value.factor,)))
        return self._made(Op("sum", (value.place,), (zero, value.factor)))

    @staticmethod
    def _row(place: int | None) -> int:
        assert place is not None
        return place

    def _scaled(self, op: Op) -> Scaled:
        return Scaled(self._one, self._made(op))

    def _made(self, op: Op) -> int:
        """The place of an operation, which is done once."""
        key = op
        if any(not isinstance(x, (int, float)) for x in op.numbers):  # balls are not compared
            key = op._replace(numbers=tuple(str(x) for x in op.numbers))
        place = self._known.get(key)
        if place is None:
            place = self._known[key] = len(self.ops)
            self.ops.append(op)
        return place
