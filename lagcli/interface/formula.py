"""One formula of an answer: as text, as LaTeX, as SymPy, as a function of arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from lagcli.expression import Expression, Name, walk

if TYPE_CHECKING:
    from lagcli.problem_data import Problem


class Formula:
    """A formula of the answer to a problem.

    `print` shows it as the terminal does, a notebook as mathematics.

    Parameters
    ----------
    expression : Expression
        The tree as it is printed.
    problem : Problem
        Its names: coordinates, parameters, functions and their symbols.
    """

    def __init__(self, expression: Expression, problem: Problem) -> None:
        self.expression = expression
        self._problem = problem

    @property
    def grammar(self) -> str:
        """The formula as the problem format writes it, such as `g*sin(alpha)/2`."""
        from lagcli.formatters.grammar import to_grammar

        return to_grammar(self.expression)

    def __str__(self) -> str:
        from lagcli.formatters.layout import joined
        from lagcli.formatters.unicode import UnicodePrinter

        return joined(UnicodePrinter().show(self.expression))

    def __repr__(self) -> str:
        return f"Formula({self.grammar!r})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Formula) and other.expression == self.expression

    def __hash__(self) -> int:
        return hash(self.grammar)

    def to_latex(self) -> str:
        """LaTeX for mathematics mode, with the symbols that the file gives."""
        from lagcli.formatters.latex_math import LatexPrinter
        from lagcli.formatters.latex_names import LatexNames
        from lagcli.formatters.layout import joined
        from lagcli.notation.given_formulas import symbols_of

        names = [one.name for one in self._problem.coordinates]
        printer = LatexPrinter(LatexNames(names, symbols_of(self._problem)))
        return joined(printer.show(self.expression).pieces)

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {self.to_latex()}$"

    def _repr_html_(self) -> str:
        from lagcli.formatters.mathml import MathmlPrinter

        return f"<math displaystyle='true'>{MathmlPrinter().show(self.expression)}</math>"

    _repr_markdown_ = _repr_latex_  # what Quarto takes inside a sentence

    def to_sympy(self) -> Any:
        """A SymPy expression: coordinates are functions of t, velocities their derivatives.

        Parameters, momenta and multipliers are symbols with the assumptions of the file.
        """
        from lagcli.interface.sympy_form import Dynamic

        return Dynamic(self._problem)(self.expression)

    @cached_property
    def arguments(self) -> tuple[str, ...]:
        """The names in the formula: t, coordinates and velocities, then the others."""
        names = {str(node) for node in walk(self.expression) if isinstance(node, Name)}
        names.discard("pi")
        states = [
            one.name + "'" * primes for primes in range(3) for one in self._problem.coordinates
        ]
        first = [name for name in ("t", *states) if name in names]
        given = [one.name for one in self._problem.parameters if one.name in names]
        return (*first, *given, *sorted(names - {*first, *given}))

    def to_numpy(
        self, arguments: Sequence[str] | None = None, values: Mapping[str, float] | None = None
    ) -> Callable[..., Any]:
        """A function of numbers or NumPy arrays.

        Parameters
        ----------
        arguments : sequence of str, optional
            The order of its arguments, such as `["theta", "theta'"]`; `self.arguments`
            without those that have a value.
        values : mapping of str to float, optional
            Numbers for names; parameters that are no argument take those of the file.

        Raises
        ------
        ValueError
            When a name of the formula is no argument and has no value.

        Examples
        --------
        >>> from lagcli.interface import loads, solve
        >>> spring = loads("{coordinates: [x], parameters: [k], T: x'^2/2, V: k*x^2/2}")
        >>> float(solve(spring, ["accelerations"]).accelerations["x"].to_numpy(["x", "k"])(2, 3))
        -6.0
        """
        from lagcli.interface.array_function import numeric_function

        return numeric_function(
            self.expression, self.arguments, self._problem, arguments, dict(values or {})
        )
