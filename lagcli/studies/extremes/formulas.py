"""The formulas that `solve` prints of a problem, and each without its cancellation."""

from __future__ import annotations

from collections.abc import Iterator

from lagcli.expression import Expression, operation_count
from lagcli.graph.nodes import Graph
from lagcli.graph.reading import GraphReader
from lagcli.graph.sharing import operations, written_out
from lagcli.graph.stable import Stable
from lagcli.pipeline import Request, derive, state
from lagcli.problem_data import Problem
from lagcli.statements.answers import AccelerationsSection, ChargesSection, MultipliersSection
from lagcli.studies.extremes.case import CaseFormula, Group

#: Longer formulas are not looked at.
_LONGEST = 20_000


def printed_formulas(problem: Problem) -> tuple[CaseFormula, ...]:
    """Accelerations, multipliers and conserved charges in terms of the parameters."""
    request = Request(sections=("accelerations", "multipliers", "charges"))
    sections = state(derive(problem), request).sections
    rewrite = _Rewriting(problem)
    return tuple(
        CaseFormula(group=group, name=name, printed=tree, rewritten=rewrite(tree))
        for group, name, tree in _printed(list(sections.values()))
        if operation_count(tree) <= _LONGEST
    )


def _printed(sections: list[object]) -> Iterator[tuple[Group, str, Expression]]:
    for section in sections:
        match section:
            case AccelerationsSection(accelerations=found):
                yield from (("accelerations", f"{q}''", tree) for q, tree in (found or {}).items())
            case MultipliersSection(multipliers=multipliers):
                for each in multipliers.values():
                    if each.value is not None:
                        yield "multipliers", each.symbol, each.value
            case ChargesSection(charges=charges):
                for charge in charges:
                    if charge.conserved and charge.charge is not None:
                        yield "charges", charge.name, charge.charge


class _Rewriting:
    """A tree in the form that keeps its digits; None where there is nothing to rewrite."""

    def __init__(self, problem: Problem) -> None:
        self.graph = Graph()
        names = tuple(c.name for c in problem.coordinates)
        self.read = GraphReader(self.graph, names, {})
        self.stable = Stable(self.graph)
        self.order = [*(p.name for p in problem.parameters), *names]

    def __call__(self, tree: Expression) -> Expression | None:
        node = self.read(tree)
        better = self.stable(node)
        if better is node or operations([better]) > _LONGEST:
            return None
        [written] = written_out([better], self.order)
        return written
