"""Names and units at the axes: `theta'` in rad/s is θ̇ (rad/s), in every writer's notation."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property

from lagcli.dimensions.demands import LAGRANGIAN
from lagcli.dimensions.forms import TIME
from lagcli.dimensions.inference import Inference, gives_units
from lagcli.dimensions.terms import Reader
from lagcli.expression import Call, Expression, Name, name_nodes, walk
from lagcli.formatters.latex_math import LatexPrinter
from lagcli.formatters.latex_names import LatexNames
from lagcli.formatters.layout import joined
from lagcli.formatters.unicode import AsciiPrinter, UnicodePrinter
from lagcli.formatters.units import latex_unit, unicode_unit
from lagcli.notation.given_formulas import symbols_of
from lagcli.pictures.drawing import Axis, DrawnName, Item, Panel, words
from lagcli.problem_data import JACOBI_FUNCTION, Problem
from lagcli.reader.columns import Column
from lagcli.units import Unit, read_unit

#: A formula that is longer is called by what the user wrote.
_LONGEST = 60


class Labels:
    """What stands at the axes and in the keys of the pictures of one problem."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        quantities = (*problem.coordinates, *problem.parameters)
        self._units = {q.name: q.unit for q in quantities if q.unit}
        names = [c.name for c in problem.coordinates]
        self._latex = LatexPrinter(LatexNames(names, symbols_of(problem)))

    def of(self, expression: Expression | None, name: str = "") -> DrawnName:
        """A column without its unit; None is the time."""
        if expression is None:
            return DrawnName(plain="t", ascii="t", tex="$t$")
        if expression == JACOBI_FUNCTION or name == "energy":
            return words("energy")
        shown = joined(UnicodePrinter().show(expression))
        if len(shown) > _LONGEST or any(
            n.name == JACOBI_FUNCTION.name for n in name_nodes(expression)
        ):
            return words(name)
        return DrawnName(
            plain=shown,
            ascii=joined(AsciiPrinter().show(expression)),
            tex=f"${self._latex.show(expression).text}$",
        )

    def unit(self, expression: Expression | None) -> Unit | None:
        """The unit of a column; None where the file determines none, or for a number."""
        if self._inference is None:
            return None
        if expression is None:
            return self._inference.unit(TIME)
        given = self._units.get(expression.name) if isinstance(expression, Name) else None
        if isinstance(expression, Name) and given:
            return self._rate(read_unit(given), expression.primes)
        found = self._reader.demand(self._reader.terms(expression, given_number=True))
        unit = None if found is None else self._inference.unit(found)
        return unit if unit is not None and _is_written(unit) else None

    def _rate(self, unit: Unit, primes: int) -> Unit:
        """The unit divided by the time, once for each derivative."""
        assert self._inference is not None
        time = self._inference.unit(TIME)
        powers = dict(unit.factors)
        for name, power in time.factors if time else ():
            powers[name] = powers.get(name, Fraction(0)) - primes * power
        return Unit(tuple((n, p) for n, p in powers.items() if p), unit.number)

    def axis_over(self, shown: Column, span: tuple[float, float]) -> Axis:
        """The axis of a column over a range; an angle is marked as one."""
        name, expression = shown
        return Axis(
            label=self.axis(expression, name), low=span[0], high=span[1],
            angle=self.is_angle(expression),
        )  # fmt: skip

    def panel(
        self, columns: Sequence[Column], spans: Sequence[tuple[float, float]], items: Sequence[Item]
    ) -> Panel:
        """One column over another."""
        x, y = map(self.axis_over, columns, spans)
        return Panel(x=x, y=y, items=tuple(items))

    def axis(self, expression: Expression | None, name: str = "") -> DrawnName:
        """A column with its unit in brackets behind it."""
        return with_unit(self.of(expression, name), self.unit(expression))

    def is_angle(self, expression: Expression | None) -> bool:
        """Whether a column is a coordinate that turns: its unit, or the functions it stands in."""
        if not isinstance(expression, Name) or expression.primes:
            return False
        coordinate = next((c for c in self.problem.coordinates if c.name == expression.name), None)
        if coordinate is None:
            return False
        return coordinate.unit == "rad" or (
            not coordinate.unit and coordinate.name in self._turning
        )

    @cached_property
    def _turning(self) -> frozenset[str]:
        """The names that stand by themselves, or with others, in sines and cosines."""
        found: set[str] = set()
        for formula in self.problem.formulas:
            for node in walk(formula):
                if isinstance(node, Call) and node.function in {"sin", "cos", "tan"}:
                    found.update(n.name for n in name_nodes(node) if not n.primes)
        return frozenset(found)

    @cached_property
    def _inference(self) -> Inference | None:
        return Inference(self.problem) if gives_units(self.problem) else None

    @cached_property
    def _reader(self) -> Reader:
        assert self._inference is not None
        names = {**self._inference.demands.names, JACOBI_FUNCTION.name: LAGRANGIAN}
        names.setdefault("energy", LAGRANGIAN)
        return Reader(names)


def with_unit(label: DrawnName, unit: Unit | None) -> DrawnName:
    """A label and, in brackets, its unit."""
    if unit is None:
        return label
    return DrawnName(
        plain=f"{label.plain} ({unicode_unit(unit)})",
        ascii=f"{label.ascii} ({unit})",
        tex=f"{label.tex} (${latex_unit(unit)[0]}$)",
    )


def _is_written(unit: Unit) -> bool:
    """Not for numbers, nor for what a file with few units would have: `s^(2/3)`."""
    return (
        unit.number == 1 and bool(unit.factors) and all(p.denominator == 1 for _, p in unit.factors)
    )
