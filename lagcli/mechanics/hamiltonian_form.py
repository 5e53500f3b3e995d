"""H as a textbook writes it: kinetic and potential energy apart, p - q A in its square.

    H = (p - b) . M^-1 (p - b)/2 - L(q, 0, t),    b = dL/dq' at q' = 0

Goldstein, Poole, Safko, *Classical Mechanics*, 3rd ed., equations 8.24 to 8.27.  A bracket
over everything may take fewer operations, but nobody recognises the energies in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

import sympy
from sympy import Expr, Symbol

from lagcli.algebra import shape, simplify, terms
from lagcli.algebra.build import free_of
from lagcli.algebra.cancellation import cancelled
from lagcli.algebra.entry import Field
from lagcli.algebra.signs import sign
from lagcli.algebra.writing import Writer
from lagcli.expression import (
    Expression,
    Name,
    Power,
    Quotient,
    Sum,
    factors_of,
    has_nested_fraction,
    length,
    operation_count,
    sum_of,
    terms_of,
    walk,
)
from lagcli.mechanics.hamiltonian import GivenHamiltonian, Hamiltonian
from lagcli.mechanics.legendre import coupled
from lagcli.mechanics.readable import Readable
from lagcli.rewriting import put_in

#: How many times the operations of one bracket over all the energies apart may take: 1.6 for
#: a block on a movable wedge, the most that was worth it in 52 systems of textbooks.
_APART = 1.75
#: Operations that one fraction may have more than several with the same momenta: H of two coils,
#: (L (p1² + p2²) - 2 M p1 p2)/(2 (L² - M²)), has one.
_SEVERAL = 2
#: Operations up to which it is sought: two links with general masses have 30, and a double
#: pendulum in space has hundreds, whose sums would take all of the work that is allowed.
_SHORT = 60
#: Stands for a potential energy beside which the kinetic one is shaped.
_OTHER = Symbol("#V", real=True)


def hamiltonian_form(
    hamiltonian: Hamiltonian | GivenHamiltonian, readable: Readable
) -> Expression | None:
    """The tree of H, as the file has it if it gives H; None where it was not found.

    Raises
    ------
    ArithmeticError
        Where the inverse of M grew too long.
    """
    function = hamiltonian.function
    if function is None:
        return None
    whole = readable.as_written(function)
    if isinstance(hamiltonian, GivenHamiltonian) or not hamiltonian.legendre.is_quadratic:
        return whole
    least = min(
        _apart(hamiltonian, readable),
        key=lambda form: (
            has_nested_fraction(form),
            length(form) + _spread(form, hamiltonian) + _above_and_below(form, hamiltonian),
        ),
        default=whole,
    )
    return least if operation_count(least) <= _APART * operation_count(whole) else whole


def _apart(hamiltonian: Hamiltonian, readable: Readable) -> Iterator[Expression]:
    """The energies apart: with p - b in squares, and by degree in the momenta."""
    system, velocities = hamiltonian.system, hamiltonian.velocities
    assert velocities is not None
    at_rest = dict.fromkeys(system.qdot, sympy.S.Zero)
    shifts = [p.xreplace(at_rest) for p in hamiltonian.dynamics.lagrange.momenta]
    writer = Writer(system.order)
    moved = {p: p + b for p, b in zip(system.momenta, shifts, strict=True)}
    flow = [simplify(v.xreplace(moved)) for v in velocities]
    rest = readable.by_terms(-system.L.xreplace(at_rest), as_given=True)
    differences: dict[Expression, Expression] = {
        Name(p.name): readable.as_written(p - b)
        for p, b in zip(system.momenta, shifts, strict=True)
        if b != 0
    }

    kinetic = list(_kinetic(system.momenta, flow, readable))
    for form in kinetic:
        yield writer.sum([put_in(form, differences), rest])
    assert hamiltonian.function is not None
    without = hamiltonian.function.xreplace(dict.fromkeys(system.momenta, sympy.S.Zero))
    if not differences or not free_of(without, system.momenta):
        return
    quadratic = sympy.Add(*(p * v / 2 for p, v in zip(system.momenta, flow, strict=True)))
    linear = readable.as_written(simplify(hamiltonian.function - quadratic - without))
    for form in kinetic:
        yield writer.sum([form, linear, readable.by_terms(simplify(without))])


def _kinetic(
    momenta: Sequence[Symbol], flow: Sequence[Expr], readable: Readable
) -> Iterator[Expression]:
    """p . M^-1 p/2 as it is shortest, also beside other terms, and block by block of M."""
    halves = [p * v / 2 for p, v in zip(momenta, flow, strict=True)]
    whole = simplify(sympy.Add(*halves))
    first = readable.as_written(whole)
    yield first
    if operation_count(first) <= _SHORT:
        yield _over_one(whole, momenta, readable.system.order)
    beside = readable.as_written(sympy.Add(*halves) + _OTHER)
    if isinstance(beside, Sum) and (mark := Name(_OTHER.name)) in beside.terms:
        yield sum_of(term for term in beside.terms if term != mark)
    blocks = list(_blocks(momenta, flow))
    if len(blocks) > 1:
        sums = (sympy.Add(*(halves[j] for j in block)) for block in blocks)
        yield Writer(readable.system.order).sum([readable.as_written(simplify(s)) for s in sums])
    yield from _squares(momenta, flow, readable)


def _squares(
    momenta: Sequence[Symbol], flow: Sequence[Expr], readable: Readable
) -> Iterator[Expression]:
    """p_1²/(2 m_1) + p_2²/(2 m_2) + (p_x − b_1 p_1 − b_2 p_2)²/(2 m): one coordinate couples them.

    The last square is v²/(2 ∂v/∂p_x) with the velocity v of this coordinate, after Lagrange.
    """
    slopes = [[simplify(v.diff(p)) for p in momenta] for v in flow]
    for k, row in enumerate(slopes):
        others = [j for j in range(len(momenta)) if j != k]
        if len(others) < 2 or any(row[j] == 0 for j in others):
            continue
        left = {
            (i, j): simplify(slopes[i][j] - row[i] * row[j] / row[k])
            for i in others
            for j in others
            if i <= j
        }
        if all(left[i, j] == 0 for i, j in left if i != j):
            single = [readable.as_written(left[j, j] * momenta[j] ** 2 / 2) for j in others]
            above, _ = _above_below(flow[k])
            above *= sign(simplify(above.diff(momenta[k]))) or 1
            mass = readable.as_written(simplify(2 * row[k] * above**2 / flow[k] ** 2))
            whole = terms(above, readable.system.order, {p.name for p in momenta}), Fraction(2)
            writer = Writer(readable.system.order)
            yield writer.sum([*single, writer.product(Fraction(1), [whole, (mass, Fraction(-1))])])


def _spread(form: Expression, hamiltonian: Hamiltonian) -> int:
    """What it costs that a momentum is in several fractions."""
    found = [{n.name for n in walk(t) if isinstance(n, Name)} for t in terms_of(form)]
    counts = (sum(p.name in names for names in found) for p in hamiltonian.system.momenta)
    return _SEVERAL * any(count > 1 for count in counts)


def _above_and_below(form: Expression, hamiltonian: Hamiltonian) -> int:
    """What (r² p_r² + (p_phi - b)²)/(2 m r²) costs, where each momentum has a mass of its own.

    So does (m2 p1² + m1 p2²)/(2 m1 m2 l²), of momenta that are not coupled.
    """
    coordinates = {q.name for q in hamiltonian.system.q}
    momenta = {p.name for p in hamiltonian.system.momenta}
    for part in walk(form):
        if not isinstance(part, Quotient):
            continue
        below = {f.base if isinstance(f, Power) else f for f in factors_of(part.denominator)}
        names = [
            {n.name for n in walk(t) if isinstance(n, Name)} & momenta
            for t in terms_of(part.numerator)
        ]
        apart = all(len(each) == 1 for each in names)
        letters = {f for f in below if isinstance(f, Name) and (apart or f.name in coordinates)}
        monomial = not any(isinstance(f, Sum) for f in below)
        for term in terms_of(part.numerator) if monomial else ():
            factors = {f.base if isinstance(f, Power) else f for f in factors_of(term)}
            if letters & factors and any(
                isinstance(f, Name) and f.name in momenta for f in factors
            ):
                return _SEVERAL + 1
    return 0


def _over_one(kinetic: Expr, momenta: Sequence[Symbol], order: Sequence[str]) -> Expression:
    """(L (p1² + p2²) - 2 M p1 p2)/(2 (L² - M²)): its monomials over the determinant of M."""
    above, below = _above_below(kinetic)
    over = terms(above, order, {p.name for p in momenta}), Fraction(1)
    return Writer(order).product(Fraction(1), [over, (shape(below, order), Fraction(-1))])


def _above_below(expression: Expr) -> tuple[Expr, Expr]:
    field = Field([expression])
    element = cancelled(field, field(expression))
    above, below = (
        field.polynomial_to_sympy(field.ring.lift(poly))
        for poly in (element.numerator, element.denominator)
    )
    return above, below


def _blocks(momenta: Sequence[Symbol], flow: Sequence[Expr]) -> Iterator[list[int]]:
    """The momenta that M^-1 couples; those apart that have the same mass are together."""
    links = ({i, *(j for j, p in enumerate(momenta) if v.has(p))} for i, v in enumerate(flow))
    alike: dict[object, list[int]] = {}
    for block in coupled(links):
        first, *more = block
        key = first if more else simplify(flow[first] / momenta[first])
        alike.setdefault(key, []).extend(block)
    yield from alike.values()
