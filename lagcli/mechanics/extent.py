"""How large a system is: readable by simplified formulas, or by its structure only."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lagcli.problem_data import Problem

if TYPE_CHECKING:
    from lagcli.mechanics.matrix_form import MatrixForm

#: Up to this number of unknowns q'' and lambda a system is small, whatever its entries.
SMALL_UNKNOWNS = 3
#: Beyond this number of unknowns it is large, whatever its entries.
LARGE_UNKNOWNS = 24
#: Operations of all entries of M, forcing, A and bias: a chain of five has 800, of six 1200,
#: and simplifying the entries of one more takes as long as everything else together.
READABLE_OPERATIONS = 1000


def large_form(problem: Problem) -> MatrixForm | None:
    """The matrix form from the structure, where the system is too large for simplified formulas.

    None also where the structure does not tell what the problem means.
    """
    unknowns = len(problem.coordinates) + len(problem.constraints)
    if unknowns <= SMALL_UNKNOWNS:
        return None
    from lagcli.graph.sharing import operations
    from lagcli.mechanics.matrix_form import MatrixForm, NotStructural

    form = MatrixForm(problem)
    try:
        if unknowns > LARGE_UNKNOWNS or operations(form.entries) > READABLE_OPERATIONS:
            form.independent  # noqa: B018 - large, if the constraints can be used
            return form
    except (NotStructural, ArithmeticError, ValueError):
        pass
    return None
