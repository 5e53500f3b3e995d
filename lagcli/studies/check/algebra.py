"""What is expected of the discovered symmetries' algebra against what was derived."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from lagcli.expression import Equation
from lagcli.formatters.grammar import equation_to_grammar, to_grammar
from lagcli.mechanics.verify import disjunction
from lagcli.problem_data import ExpectAlgebra, ExpectSpecial
from lagcli.rewriting import substituted
from lagcli.statements.answers import AlgebraSection, SpecialValue
from lagcli.studies.check.comparison import Comparison
from lagcli.studies.check.findings import Judged
from lagcli.values import Values

if TYPE_CHECKING:
    from lagcli.studies.check.expectations import Expectations

_PATH = ["algebra"]


def expected_algebra(
    check: Expectations, found: AlgebraSection, wanted: ExpectAlgebra
) -> Iterator[Judged]:
    """Every expectation of the section with its verdict."""
    yield from _plain(wanted, found)
    if wanted.special is not None:
        yield from _special(wanted.special, found, check.comparison)


def _plain(wanted: ExpectAlgebra, found: AlgebraSection) -> Iterator[Judged]:
    for key in ("dimension", "name", "independent", "in_involution", "integrable"):
        expected, derived = getattr(wanted, key), getattr(found, key)
        if expected is None:
            continue
        verdict = None if derived is None and key != "name" else derived == expected
        if key == "name" and found.name is not None:
            verdict = expected in {found.name, found.name.removesuffix(", modulo constants")}
        yield [*_PATH, key], verdict, _word(expected), _word(derived)


def _word(value: str | int | bool | None) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "none" if value is None else str(value)


def _special(
    wanted: Sequence[ExpectSpecial], found: AlgebraSection, comparison: Comparison
) -> Iterator[Judged]:
    """Each is found, and none but these; undecided where not all were sought."""
    left = list(found.special)
    missing = None if "not all special values" in found.ansatz else False
    for place, each in enumerate(wanted):
        path = [*_PATH, "special", str(place)]
        case = next((c for c in left if _holds(each.where, c, comparison)), None)
        shown = "" if each.where is None else equation_to_grammar(each.where)
        yield path, True if case is not None else missing, shown, _listed(found.special)
        if case is not None:
            left.remove(case)
            yield from _of_case(path, each, case, comparison)
    yield [*_PATH, "special"], not left, "no other special value", _listed(left)


def _listed(cases: Sequence[SpecialValue]) -> str:
    shown = (
        " and ".join(f"{name} = {to_grammar(x)}" for name, x in c.values.items()) for c in cases
    )
    return ", ".join(shown) or "none"


def _holds(relation: Equation | None, case: SpecialValue, comparison: Comparison) -> bool:
    """Whether a relation, which does not hold at all values, holds at this one."""
    if relation is None or comparison.equal(relation.left, relation.right) is not False:
        return False
    left, right = substituted((relation.left, relation.right), _values(case))
    return comparison.equal(left, right) is True


def _values(case: SpecialValue) -> Values:
    return case.values


def _of_case(
    path: list[str], wanted: ExpectSpecial, case: SpecialValue, comparison: Comparison
) -> Iterator[Judged]:
    if wanted.charges is not None:
        verdict = wanted.charges == case.number
        yield [*path, "charges"], verdict, str(wanted.charges), str(case.number)
    for name, charge in wanted.discovered.items():
        [expected] = substituted((charge,), _values(case))
        verdicts = [comparison.same_charge(c, expected) for c in case.charges.values()]
        same = disjunction(verdicts)
        shown = ", ".join(map(to_grammar, case.charges.values())) or "none"
        yield [*path, "discovered", name], same, to_grammar(expected), shown
