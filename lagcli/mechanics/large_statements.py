"""The sections of a system too large for simplified formulas, from its structure.

Formulas are written out as the structure has them while they are not too long; what would
need the motion solved, or would fill books, is null with a line that says so.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from lagcli.expression import Expression
from lagcli.graph.nodes import Node
from lagcli.graph.sharing import operations, written_out
from lagcli.mechanics.large_charges import LargeCharges
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.mechanics.stating import Stating
from lagcli.statements.answers import Section
from lagcli.statements.declaration import Declaration

#: A section whose formulas show more operations than this is not written out.
WRITTEN_OPERATIONS = 100_000

_WHY = "the system is too large for formulas"


class LargeStatements(Stating):
    """The sections of one large system."""

    def __init__(self, form: MatrixForm) -> None:
        super().__init__(form.problem, _WHY)
        self.form = form
        self.charges = LargeCharges(form)
        names = (*self.problem.parameters, *self.problem.coordinates)
        self.order = tuple(quantity.name for quantity in names)

    def maker(self, declared: Declaration) -> Callable[[Any], Section] | None:
        """The derivation of a section from the structure, if it has one."""
        return declared.large

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        return self.form.degrees_of_freedom

    def written(self, what: str, nodes: Sequence[Node]) -> tuple[Expression, ...] | None:
        """The nodes written out; None with a warning where that would be too long."""
        count = operations(nodes)
        if count <= WRITTEN_OPERATIONS:
            return written_out(nodes, self.order)
        self.complete = False
        self.warnings.append(
            f"{what} written out would show {count:,} operations; --show matrix_form gives the "
            "equations of motion with their common parts named"
        )
        return None

    def written_out(self, nodes: Mapping[str, Node]) -> dict[str, Expression]:
        """The nodes written out, however long."""
        return dict(zip(nodes, written_out(tuple(nodes.values()), self.order), strict=True))

    def _matrix_form_of_problem(self) -> MatrixForm:
        return self.form
