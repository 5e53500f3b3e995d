"""The shape of the printed formulas against the rules of textbooks, counted over the library.

    python tests/bench/form.py [--list] [KEPT.json]     # KEPT.json: as `printed.py keep` writes it

What the file writes itself, in its energies, constraints or known answers, is never counted.
"""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from lagcli import load
from lagcli.algebra.entry import Field
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    children,
    walk,
)
from lagcli.problem_data import Problem
from lagcli.reader.expressions import parse_text
from tests.bench.exchange import built, canonical, not_exchanged, rational
from tests.bench.measure import ROOT, Row
from tests.bench.printed import COUNTED, formulas, library, solved

#: What is to hold of the library; None: reported only.
BARS: dict[str, float | None] = {
    "nested fractions": 0,
    "rows over different denominators": 0,
    "sums that end with their number": 0,
    "differences turned round": 0,
    "half-integer powers of a letter": 0,
    "% beyond 1.15 of the book's tokens": 3,
    "exchanged bodies, not exchanged answers": 0,
}
_MORE = Fraction(115, 100)


# -- one formula by itself -----------------------------------------------------------------


def outside_functions(node: Expression) -> Iterator[Expression]:
    """The node and its parts, not those inside a function, a root or an exponent."""
    stack = [node]
    while stack:
        top = stack.pop()
        yield top
        if isinstance(top, Power):
            stack.append(top.base)
        elif not isinstance(top, (Call, PartialCall)):
            stack.extend(children(top))


def _has_fraction(node: Expression) -> bool:
    return any(
        isinstance(part, Quotient) or (isinstance(part, Number) and part.value.denominator != 1)
        for part in outside_functions(node)
    )


def nested_fractions(node: Expression) -> Iterator[Expression]:
    """Fractions in a denominator, or in a sum over a sum."""
    for part in walk(node):
        if isinstance(part, Quotient):
            above, below = part.numerator, part.denominator
            holds_sum = any(isinstance(p, Sum) for p in outside_functions(below))
            if _has_fraction(below):  # of 2 (1 − 2 M/r) the bracket may be the file's
                yield from filter(_has_fraction, _factors(below))
            elif holds_sum:
                yield from (f for f in _factors(above) if isinstance(f, Sum) and _has_fraction(f))


def ends_with_number(node: Expression) -> Iterator[Expression]:
    """Sums whose last term is a number, but for exponents: r^(n - 2)."""
    exponents = {id(p) for q in walk(node) if isinstance(q, Power) for p in walk(q.exponent)}
    for part in walk(node):
        if isinstance(part, Sum) and id(part) not in exponents:
            last = part.terms[-1]
            last = last.operand if isinstance(last, Negative) else last
            if not any(isinstance(p, Name) for p in walk(last)):
                yield part


def half_powers(node: Expression) -> Iterator[Expression]:
    """x^(3/2) of a letter."""
    for part in walk(node):
        if isinstance(part, Power) and isinstance(part.base, Name):
            value = rational(part.exponent)
            if value is not None and value.denominator == 2:
                yield part


def differences(node: Expression) -> Iterator[tuple[Expression, Expression]]:
    """(a, b) of every a - b."""
    for part in walk(node):
        if isinstance(part, Sum) and len(part.terms) == 2:
            first, second = part.terms
            if isinstance(second, Negative) and not isinstance(first, Negative):
                yield first, second.operand
            elif isinstance(first, Negative) and not isinstance(second, Negative):
                yield second, first.operand


def tokens(node: Expression) -> int:
    """Letters, numbers, functions and the signs between them, without brackets."""
    count = 0
    for part in walk(node):
        match part:
            case Sum(terms=parts) | Product(factors=parts):
                count += len(parts) - 1
            case Negative() | Quotient() | Power():
                count += 1
            case _:
                count += 1
    minus = sum(
        isinstance(t, Negative) for p in walk(node) if isinstance(p, Sum) for t in p.terms[1:]
    )
    return count - minus


# -- what the file writes -------------------------------------------------------------------


class Given:
    """The formulas of a file: its physics, and the known answers of its source."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        parts = {
            name: getattr(problem, name)
            for name in (
                "definitions", "points", "kinetic", "potential", "lagrangian", "hamiltonian",
                "forces", "dissipation", "symmetries", "initial", "constraints",
            )
        }  # fmt: skip
        own = [node for _, node in formulas(parts)]
        own += [s for c in problem.constraints for s in (c.equation.left, c.equation.right)]
        self.book = [node for _, node in formulas({"expect": problem.expect})]
        self.shapes = {canonical(p)[1] for node in (*own, *self.book) for p in walk(node)}
        self.differences = {
            (canonical(a), canonical(b)) for node in own for a, b in differences(node)
        }

    def writes(self, node: Expression) -> bool:
        """Whether the file has this part, up to order."""
        return canonical(node)[1] in self.shapes

    def turned(self, node: Expression) -> Iterator[Expression]:
        """Differences b - a of which the file has a - b only."""
        for a, b in differences(node):
            one, other = canonical(a), canonical(b)
            if (other, one) in self.differences and (one, other) not in self.differences:
                yield Sum((a, Negative(b)))


# -- the rows of one answer ------------------------------------------------------------------


def _factors(node: Expression) -> Iterator[Expression]:
    match node:
        case Negative(operand=inner) | Power(base=inner):
            yield from _factors(inner)
        case Product(factors=factors):
            for each in factors:
                yield from _factors(each)
        case _:
            yield node


def sums_below(node: Expression) -> set[Expression]:
    """The sums among the factors of the denominators."""
    return {
        factor
        for part in outside_functions(node)
        if isinstance(part, Quotient)
        for factor in _factors(part.denominator)
        if isinstance(factor, Sum)
    }


def unlike_denominators(rows: Iterable[Expression]) -> list[tuple[Expression, Expression]]:
    """Pairs of sums below that are the same up to a factor, and are not written the same."""
    found: dict[tuple, Expression] = {}
    for row in rows:
        for each in sums_below(row):
            found.setdefault(canonical(each)[1], each)
    return [(a, b) for a, b in combinations(found.values(), 2) if _monomial_ratio(a, b)]


def _monomial_ratio(a: Expression, b: Expression) -> bool:
    try:
        one, other = (built(x) for x in (a, b))
        field = Field([one, other])
        ratio = field(one) / field(other)
    except (ZeroDivisionError, TypeError, KeyError, AttributeError):
        return False
    return len(ratio.numerator) == 1 == len(ratio.denominator)


# -- the book -----------------------------------------------------------------------------------


def expanded(node: Expression, definitions: Mapping[str, Expression]) -> Expression:
    """The book's formula with the file's definitions written out."""
    from lagcli.rewriting import rebuilt

    if isinstance(node, Name) and node.name in definitions and node.primes == 0:
        return expanded(definitions[node.name], definitions)
    return rebuilt(node, lambda part: expanded(part, definitions))


def of_book(problem: Problem) -> dict[str, Expression]:
    """The formulas of the source, by the path of ours."""
    expect = problem.expect
    found = {f"/accelerations/accelerations/{n}": e for n, e in expect.accelerations.items()}
    found |= {f"/multipliers/multipliers/{n}/value": e for n, e in expect.multipliers.items()}
    found |= {f"/momenta/momenta/{n}": e for n, e in expect.momenta.items()}
    if expect.energy is not None:
        found["/energy/function"] = expect.energy
    if expect.hamiltonian is not None:
        found["/hamiltonian/hamiltonian"] = expect.hamiltonian
    return {path: expanded(node, problem.definitions) for path, node in found.items()}


# -- the report -----------------------------------------------------------------------------------


def report(path: Path, found: Mapping[str, Expression]) -> dict[str, list[tuple[str, str]]]:
    """The rules that the formulas of one file break: rule -> (path, what)."""
    from lagcli.formatters.grammar import to_grammar

    problem = load(path)
    given = Given(problem)
    counted = {p: n for p, n in found.items() if is_counted(p)}
    broken: dict[str, list[tuple[str, str]]] = {rule: [] for rule in BARS}
    single: dict[str, Callable[[Expression], Iterator[Expression]]] = {
        "nested fractions": nested_fractions,
        "sums that end with their number": ends_with_number,
        "half-integer powers of a letter": half_powers,
    }
    for key, node in counted.items():
        for rule, find in single.items():
            bad = [part for part in find(node) if not given.writes(part)]
            if bad:
                broken[rule].append((key, to_grammar(bad[0])))
        turned = list(given.turned(node))
        if turned:
            broken["differences turned round"].append((key, to_grammar(turned[0])))
    rows = [n for p, n in counted.items() if p.split("/")[1] in ("accelerations", "multipliers")]
    for a, b in unlike_denominators(rows):
        broken["rows over different denominators"].append(
            ("", f"{to_grammar(a)}  |  {to_grammar(b)}")
        )
    for key, book in of_book(problem).items():
        if key in counted and tokens(counted[key]) > _MORE * tokens(book):
            broken["% beyond 1.15 of the book's tokens"].append(
                (key, f"{to_grammar(counted[key])}   BOOK {to_grammar(book)}")
            )
    for key in not_exchanged(problem, found):
        broken["exchanged bodies, not exchanged answers"].append((key, to_grammar(found[key])))
    return broken


def is_counted(path: str) -> bool:
    """Whether a formula is one of those that the report counts."""
    section, *rest = path.split("/")[1:]
    if section == "charges":
        return rest[-1] == "charge"
    return section in COUNTED


def books(path: Path, found: Mapping[str, Expression]) -> int:
    """How many formulas of a file can be compared with its source."""
    return sum(key in found for key in of_book(load(path)))


def rows(found: Mapping[Path, Mapping[str, Expression]], *, listed: bool = False) -> Iterator[Row]:
    """The rows of the report."""
    totals: Counter[str] = Counter()
    compared = counted = 0
    for path, printed in found.items():
        compared += books(path, printed)
        counted += sum(map(is_counted, printed))
        for rule, cases in report(path, printed).items():
            totals[rule] += len(cases)
            for key, what in cases if listed else ():
                print(f"{rule}: {path.relative_to(ROOT)} {key}\n    {what}")
    for rule, bar in BARS.items():
        value: float = totals[rule]
        note = f"of {counted} formulas"
        if rule.startswith("%"):
            note = f"{totals[rule]} of {compared} formulas"
            value = 100 * value / max(compared, 1)
        yield Row(rule, value, "", bar, note=note)


def of_library() -> dict[Path, dict[str, Expression]]:
    """Every counted formula of the library."""
    sections = ("lagrangian", "equations", *COUNTED)
    return {path: solved(path, sections) for path in library()}


def of_kept(kept: Path) -> dict[Path, dict[str, Expression]]:
    """The same out of a file of `printed.py keep`."""
    data = json.loads(kept.read_text("utf-8"))
    return {
        ROOT / file: {
            key: parse_text(text)
            for key, text in entry["formulas"].items()
            if is_counted(key) or key.startswith(("/lagrangian/", "/equations/"))
        }
        for file, entry in data.items()
        if "error" not in entry["formulas"]
    }


def main(arguments: Sequence[str]) -> int:
    """Count and show; 1 where a bar is missed."""
    from tests.bench.measure import show

    listed = "--list" in arguments
    kept = [Path(a) for a in arguments if a != "--list"]
    found = of_kept(kept[0]) if kept else of_library()
    held = True
    for row in rows(found, listed=listed):
        show(row)
        held = held and row.holds
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
