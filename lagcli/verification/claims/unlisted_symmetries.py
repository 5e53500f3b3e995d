"""Symmetries that are not listed: the determining equations in numbers.

For eta = sum c_k f_k(q, q', t) at constant t the change of the action K is linear in the c_k,
and Euler's operator of K vanishes identically for a symmetry (`boundary`): at random q, q', …
that is a linear system for the c_k, whose solutions the listed charges span: with
eta_j = Delta q_j - q_j' Delta t, and Q eta' + Q' eta of the product of two charges.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from random import Random

from flint import arb, arb_mat, ctx

from lagcli.statements.answers import ChargesSection
from lagcli.verification.claims.boundary import change_of_action, euler_operator
from lagcli.verification.claims.charges import change_in_form
from lagcli.verification.claims.near import LinearMotion
from lagcli.verification.examination import PRECISIONS, Examination
from lagcli.verification.linear import Unclear, dot, rank, size, solve
from lagcli.verification.phase_points import Environment
from lagcli.verification.states import State

#: More coordinates make too many functions: 3 (n^2 + n + 1) of them, n (n + 1)^2 (n + 2)/4.
_MOST = 3
#: Entries and squared rates of a linear motion that differ by less are the same.
_SAME = 1e-20
_CIRCULAR = {"sin", "cos", "tan", "cot", "sec", "csc"}
_LENGTHS = {None, "m"}
#: One function of the search: the steps of eta by coordinate.
Change = list[int]


def symmetries_are_listed(x: Examination, section: ChargesSection) -> bool:
    """Whether no other is affine in lengths and to t^2, or linear in p; noted if not."""
    reference, size = x.reference, len(x.reference.names)
    if size > _MOST or reference.pushed or reference.rows or x.problem.functions or not x.regular:
        return True
    listed = _listed(x, section)
    if not x.states() or listed is None:
        return True
    for what, changes, spanned in (
        ("symmetries are point transformations", _of_points(x), [c for c, _ in listed]),
        ("integrals are of second degree", _of_second_degree(x), _with_products(x, listed)),
    ):
        try:
            other = _search(x, changes, spanned) if changes else 0
        except Unclear:
            continue
        if other:
            x.refute(f"that no other {what}", f"more than are listed: {other}")
            return False
    return True


def _listed(x: Examination, section: ChargesSection) -> list[tuple[Change, int]] | None:
    """eta and Q of each; None where one cannot be read."""
    found = []
    for each in section.charges:
        if each.transformation and each.charge is not None:
            changed, charge = change_in_form(x, each), x.places("", [each.charge])
            if changed is None or charge is None:
                return None
            found.append((changed[0], charge[0]))
    return found


def _with_products(x: Examination, listed: Sequence[tuple[Change, int]]) -> list[Change]:
    """Those listed and the products of two that are of first degree and without t."""
    program, reference = x.reference.program, x.reference
    moving = {*reference.v, reference.time}
    first = [each for each in listed if moving.isdisjoint(program.order(each[0]))]
    products = [
        [
            program.sum(program.product(Q, b), program.product(R, a))
            for a, b in zip(one, other, strict=True)
        ]
        for (one, Q), (other, R) in combinations_with_replacement(first, 2)
    ]
    return [*(change for change, _ in listed), *products]


def _search(x: Examination, changes: Sequence[Change], listed: Sequence[Change]) -> int:
    """The number of symmetries that the listed ones do not span."""
    zero, size = x.reference.program.zero, len(x.reference.names)
    residuals = [euler_operator(x, change_of_action(x, change, zero)) for change in changes]
    rows = []
    for known in _jets(x, len(changes) // size + 3):
        at = x.reference.values(known)
        rows += [[at(each[i]) for each in residuals] for i in range(size)]
    kernel = solve(rows, [arb(0)] * len(rows), len(changes)).kernel
    count = (len(kernel) + len(listed)) // size + 3
    places = [x.reference.values(jet) for jet in _jets(x, count)]

    def seen(change: Change) -> list[arb]:
        return [at(place) for at in places for place in change]

    columns = [seen(change) for change in changes]
    found = [[dot(vector, entries) for entries in zip(*columns, strict=True)] for vector in kernel]
    spanned = [seen(each) for each in listed]
    width = len(columns[0])
    return rank([*spanned, *found], width) - rank(spanned, width)


def _of_points(x: Examination) -> list[Change]:
    """1, t, t^2 times 1 and the coordinates that are lengths, for each coordinate and for t.

    Besides cos(w t) and sin(w t) for each; cos(2 w t) and sin(2 w t) as t^2.
    """
    program, reference = x.reference.program, x.reference
    t = reference.time
    powers = [program.one, t, program.product(t, t)]
    found = [[program.product(T, v) for v in reference.v] for T in powers]
    exponentials, doubled = _exponentials(x)
    found += [[program.product(T, v) for v in reference.v] for T in doubled]
    for j in range(len(reference.names)):
        for T in (*powers, *doubled):
            made = [program.product(T, g) for g in (program.one, *_lengths(x))]
            found += [_only(x, j, f) for f in made]
        found += [_only(x, j, T) for T in exponentials]
    return found


def _exponentials(x: Examination) -> tuple[list[int], list[int]]:
    """cos(w t) and sin(w t), or exp(r t) and exp(-r t), of the motions of q'' = K q, and of 2 t."""
    program, t = x.reference.program, x.reference.time
    found: tuple[list[int], list[int]] = [], []
    with ctx.workprec(PRECISIONS[1]):
        here = dict(x.states()[0].environment)
        near, other = (LinearMotion(x, each) for each in (here, _jet(x, here, Random(4))))
        if not (near.regular and other.regular):  # faster than light, for instance
            return found
        K, L = near.slopes[0], other.slopes[0]
        same = all(
            size(a - b) < _SAME
            for p, q in zip(K, L, strict=True)
            for a, b in zip(p, q, strict=True)
        )
        if not (near.still and other.still and same):
            return found
        roots = [z.real for z in arb_mat(K).mid().eig(algorithm="approx", nonstop=True)]
        for k, square in enumerate(roots):
            if size(square) < _SAME or any(size(square - r) < _SAME for r in roots[:k]):
                continue
            mantissa, exponent = abs(square).sqrt().mid().man_exp()
            rate = program.number(Fraction(int(mantissa)) * Fraction(2) ** int(exponent))
            once = program.product(rate, t)
            for turn, functions in zip((once, program.sum(once, once)), found, strict=True):
                if square > 0:
                    functions += [program.call("exp", f) for f in (turn, program.negative(turn))]
                else:
                    functions += [program.call("cos", turn), program.call("sin", turn)]
    return found


def _of_second_degree(x: Examination) -> list[Change]:
    """eta_i = f p_j, eta_j = f p_i, with f up to second degree in lengths; none for L of t."""
    program, reference = x.reference.program, x.reference
    if reference.by(reference.lagrangian, reference.time) != program.zero:
        return []
    momenta = reference.momenta
    factors = [program.one, *_lengths(x)]
    functions = [program.product(a, b) for a, b in combinations_with_replacement(factors, 2)]
    found = []
    for i, j in combinations_with_replacement(range(len(momenta)), 2):
        for f in functions:
            change = _only(x, i, program.product(f, momenta[j]))
            change[j] = program.product(f, momenta[i])
            found.append(change)
    return found


def _only(x: Examination, j: int, step: int) -> Change:
    """Of one coordinate."""
    return [step if i == j else x.reference.program.zero for i in range(len(x.reference.names))]


def _lengths(x: Examination) -> list[int]:
    return [q for q in x.reference.q if _is_length(x, q)]


def _is_length(x: Examination, q: int) -> bool:
    """Whether the coordinate is in no circular function, and its inertia is constant."""
    program, reference = x.reference.program, x.reference
    j = reference.q.index(q)
    if x.problem.coordinates[j].unit not in _LENGTHS:
        return False
    for place in program.order([reference.lagrangian]):
        step = program.steps[place]
        if step.kind == "call" and step.what in _CIRCULAR and q in program.order([place]):
            return False
    state = x.states()[0]
    own = state.laws.mass_matrix[j]
    moved = State(reference, _jet(x, dict(state.environment), Random(3)))
    return all((a - b).contains(0) for a, b in zip(own, moved.laws.mass_matrix[j], strict=True))


def _jets(x: Examination, count: int) -> list[Environment]:
    """Random t, q, q', … with the parameters of one state."""
    first, random = dict(x.states()[0].environment), Random(29)
    return [_jet(x, first, random) for _ in range(count)]


def _jet(x: Examination, known: Environment, random: Random) -> Environment:
    there = dict(known)
    there["t", 0] = arb(random.randint(200, 1800)) / 1024
    for name in x.reference.names:
        there[name, 0] = known[name, 0] * (1 + arb(random.randint(-400, 400)) / 1024)
        for primes in range(1, 6):
            there[name, primes] = arb(random.randint(-1500, 1500)) / 1024
    return there
