"""Point symmetries that are not listed: the determining equations in numbers.

For Delta q = sum c_k f_k(q, t), Delta t = sum c_k T_k(t) the change of the action K is linear in
the c_k, and Euler's operator of K vanishes identically for a symmetry (`boundary`): at random
q, q', q'' that is a linear system for the c_k, whose solutions the listed transformations span.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from flint import arb

from lagcli.expression import ZERO
from lagcli.statements.answers import ChargesSection
from lagcli.verification.claims.boundary import change_of_action, euler_operator
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, dot, rank, solve
from lagcli.verification.states import Environment, State

#: More coordinates make too many functions: 3 (n^2 + n + 1) of them.
_MOST = 3
_CIRCULAR = {"sin", "cos", "tan", "cot", "sec", "csc"}
_LENGTHS = {None, "m"}
#: One function of the search: the steps of Delta q by coordinate, and of Delta t.
Change = tuple[list[int], int]


def no_other_point_symmetry(x: Examination, section: ChargesSection) -> None:
    """Note where the listed transformations are not all, affine in lengths and to t^2."""
    given = x.problem
    pushed = given.forces or given.dissipation or any(p.force for p in given.points)
    size = len(x.reference.names)
    if size > _MOST or pushed or x.reference.rows or given.functions or not x.regular:
        return
    names = (*x.reference.names, "t")
    listed = [
        x.places("", [charge.transformation.get(n, ZERO) for n in names])
        for charge in section.charges
        if charge.transformation
    ]
    if not x.states() or None in listed:
        return
    try:
        other = _search(x, [each for each in listed if each is not None])
    except Unclear:
        return
    if other:
        x.refute("that no other symmetries are point transformations", f"there is {other} more")


def _search(x: Examination, listed: Sequence[Sequence[int]]) -> int:
    """The number of symmetries that the listed ones do not span."""
    changes = _basis(x)
    residuals = [euler_operator(x, change_of_action(x, *change)) for change in changes]
    size = len(x.reference.names)
    rows = []
    for known in _jets(x, len(changes) // size + 3):
        at = x.reference.values(known)
        rows += [[at(each[i]) for each in residuals] for i in range(size)]
    kernel = solve(rows, [arb(0)] * len(rows), len(changes)).kernel
    places = [x.reference.values(jet) for jet in _jets(x, len(changes) + 3)]

    def seen(change: Change) -> list[arb]:
        return [at(place) for at in places for place in (*change[0], change[1])]

    columns = [seen(change) for change in changes]
    found = [[dot(vector, entries) for entries in zip(*columns, strict=True)] for vector in kernel]
    spanned = [seen((list(each[:-1]), each[-1])) for each in listed]
    width = len(columns[0])
    return rank([*spanned, *found], width) - rank(spanned, width)


def _basis(x: Examination) -> list[Change]:
    """1, t, t^2 times 1 and the coordinates that are lengths, for each coordinate and for t."""
    program, reference = x.reference.program, x.reference
    t = reference.time
    powers = [program.one, t, program.product(t, t)]
    none = [program.zero] * len(reference.names)
    functions = [program.one, *(q for q in reference.q if _is_length(x, q))]
    found: list[Change] = [(none, T) for T in powers]
    for j in range(len(reference.names)):
        for T in powers:
            made = [program.product(T, g) for g in functions]
            found += [([*none[:j], f, *none[j + 1 :]], program.zero) for f in made]
    return found


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
    """Random t, q, q', q'' with the parameters of one state."""
    first, random = dict(x.states()[0].environment), Random(29)
    return [_jet(x, first, random) for _ in range(count)]


def _jet(x: Examination, known: Environment, random: Random) -> Environment:
    there = dict(known)
    there["t", 0] = arb(random.randint(200, 1800)) / 1024
    for name in x.reference.names:
        there[name, 0] = known[name, 0] * (1 + arb(random.randint(-400, 400)) / 1024)
        for primes in (1, 2):
            there[name, primes] = arb(random.randint(-1500, 1500)) / 1024
    return there
