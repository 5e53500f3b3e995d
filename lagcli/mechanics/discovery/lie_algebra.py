"""The name of a Lie algebra of small dimension from its structure constants.

The dimension, the centre, the derived algebra and the signature of the Killing form
kappa_ab = sum C_ac^d C_bd^c decide.  Where brackets of the generators are constants that no
shift Q -> Q + const removes, the algebra is a central extension: the generators span it only
modulo constants, and with the constant 1 its dimension is one more.  The name says so.

References
----------
Fulton, Harris, *Representation Theory*, chapters 9 and 10.
Niederer, Helv. Phys. Acta 45 (1972) 802 (the Schroedinger algebra of free motion).
Levy-Leblond, *Group Theory and its Applications* II (1971) 221 (Galilei).
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import chain

import mpmath
from mpmath import mpf

from lagcli.algebra.numeric import DIGITS
from lagcli.algebra.row_rank import nullspace, rank
from lagcli.mechanics.discovery.brackets import Structure, Vector

_SMALL = mpf(10) ** -12  # measured: zeros are below 4e-38, others above 4e-1
_OF_BLOCK = mpf(10) ** -8  # an eigenvalue 0 of a Jordan block of 3 is 1e-17
#: What stands after the name of an algebra that contains the constants beside its generators.
MODULO_CONSTANTS = ", modulo constants"
#: Algebras with a centre that the constants make up: dimensions 2 d + 1 of h(d), and so on.
_EXTENDED = ("Heisenberg", "Galilei", "oscillator algebra")
_SEMISIMPLE = {
    (3, 0, 3): "so(3)",
    (3, 2, 1): "sl(2,R)",
    (6, 0, 6): "so(4)",
    (6, 3, 3): "so(3,1)",
    (6, 4, 2): "so(2,2)",
    (6, 2, 4): "so(3) + sl(2,R)",
    (8, 0, 8): "su(3)",
    (10, 0, 10): "so(5)",
    (10, 4, 6): "so(4,1)",
    (10, 6, 4): "so(3,2)",
}


def name_of(structure: Structure) -> str | None:
    """The name of the algebra, None where it is none of the known ones."""
    with mpmath.workdps(DIGITS):
        if structure.by_energy is None:
            name = _name(structure.constants, structure.central)
            return _with_centre(name, structure)
        if _changes_elsewhere(structure):
            return None
        names = [_name(_at_energy(structure, E), structure.central) for E in (-1, 0, 1)]
        where = ("where the energy is negative", "where it is 0", "where it is positive")
        if names[0] is None:
            return None
        if len(set(names)) == 1:
            return names[0]
        return ", ".join(f"{name} {at}" for name, at in zip(names, where, strict=True) if name)


def _with_centre(name: str | None, structure: Structure) -> str | None:
    """The name, with a note where the constants belong to the algebra, and no charge in it."""
    if name is None or not any(word in name for word in _EXTENDED):
        return name
    return f"{name}{MODULO_CONSTANTS}" if has_constants(structure) else name


def has_constants(structure: Structure) -> bool:
    """Whether the constants belong to the algebra: no shift of the charges removes them."""
    return not _are_shifts(structure.constants, structure.central)


def _changes_elsewhere(structure: Structure) -> bool:
    """Whether c + e E is among the coefficients: such a one changes its sign at E = -c/e."""
    assert structure.by_energy is not None
    both = zip(structure.constants, structure.by_energy, strict=True)
    rows = (row for a, b in both for row in zip(a, b, strict=True))
    return any(c != 0 != e for row in rows for c, e in zip(*row, strict=True))


def _at_energy(structure: Structure, value: int) -> list[list[Vector]]:
    assert structure.by_energy is not None
    return [
        [[x + value * y for x, y in zip(c, e, strict=True)] for c, e in zip(a, b, strict=True)]
        for a, b in zip(structure.constants, structure.by_energy, strict=True)
    ]


def _name(C: list[list[Vector]], central: Sequence[Vector]) -> str | None:
    n = len(C)
    if n == 0:
        return None
    if _are_shifts(C, central):
        central = [[mpf(0)] * n for _ in range(n)]
    extended = any(abs(x) > _SMALL for row in central for x in row)
    products = [C[a][b] for a in range(n) for b in range(a)]
    derived = rank(products)
    if derived == 0:
        pairs = rank(list(central)) // 2 if extended else 0
        if pairs == 0:
            return _abelian(n)
        rest = n - 2 * pairs
        return f"Heisenberg h({pairs})" + (f" + {_abelian(rest)}" if rest else "")
    whole = _whole(C, n, derived, extended=extended)
    if whole is not None:
        return whole
    centre = _centre(C, central)
    alone = _beyond(products, centre)
    if alone:
        inner = _name(*_without(C, central, alone))
        return None if inner is None else f"{inner} + {_abelian(len(alone))}"
    if len(centre) == 1 and not extended:  # a charge in place of the constants, as p_z
        return _name(*_extension(C, centre[0]))
    return _direct_sum(C, central) or _with_translations(C, central)


def _with_translations(C: list[list[Vector]], central: Sequence[Vector]) -> str | None:
    """What acts on an ideal h(d), which commutes but for constants K without a null vector.

    With v_s in it that has the constants of s, {v_s, x} = K_sx, s - v_s acts without any, and these
    close: their brackets have none either, and K has no null vector.
    """
    for ideal in _commuting(C, [a for a in range(len(C)) if _squares_to_0(C, a)]):
        others = [a for a in range(len(C)) if a not in ideal]
        inside = all(abs(C[a][s][c]) < _SMALL for a in ideal for s in range(len(C)) for c in others)
        if (
            not ideal
            or not inside
            or rank([[central[a][b] for b in ideal] for a in ideal]) < len(ideal)
        ):
            continue
        form = mpmath.matrix([[central[a][b] for b in ideal] for a in ideal])
        rows = [mpmath.matrix([central[s][b] for b in ideal]) for s in others]
        shifts = [mpmath.lu_solve(form.T, row) for row in rows]
        inner = [
            [central[s][r] - (shifts[i].T * form * shifts[k])[0] for k, r in enumerate(others)]
            for i, s in enumerate(others)
        ]
        acting = _name([[[C[a][b][c] for c in others] for b in others] for a in others], inner)
        if acting is not None and not any(word in acting for word in _EXTENDED):
            return f"{acting} with Heisenberg h({len(ideal) // 2})"
    return None


def _squares_to_0(C: list[list[Vector]], a: int) -> bool:
    """Whether {a, {a, b}} is a constant for all b: translations do nothing to what they give."""
    n = len(C)
    return all(
        abs(mpmath.fsum(C[a][b][c] * C[a][c][d] for c in range(n))) < _SMALL
        for b in range(n) for d in range(n)
    )  # fmt: skip


def _commuting(C: list[list[Vector]], chosen: list[int], most: int = 16) -> list[list[int]]:
    """Sets of these basis vectors that commute, the largest first."""
    found: list[list[int]] = []
    left = [chosen]
    while left and most:
        most -= 1
        part = left.pop(0)
        pair = next(
            ((a, b) for a in part for b in part if any(abs(x) > _SMALL for x in C[a][b])), None
        )
        if pair is None:
            found.append(part)
        else:
            left += [[x for x in part if x != gone] for gone in pair]
    return sorted(found, key=len, reverse=True)


def _direct_sum(C: list[list[Vector]], central: Sequence[Vector]) -> str | None:
    """Ideals that the basis vectors fall into, the largest first, with the constants in it.

    Those with constants have one centre: h(1) beside h(1) is h(2), not h(1) + h(1) with two.
    """
    parts = _ideals(C, central)
    extended = [p for p in parts if not _are_shifts(*_restricted(C, central, p))]
    parts = [p for p in parts if p not in extended]
    parts = [sorted(chain(*extended)), *parts] if extended else parts
    if len(parts) < 2:
        return None
    found = []
    for part in sorted(parts, key=len, reverse=True):  # of equal ones that with constants first
        name = _name(*_restricted(C, central, part))
        if name is None:
            return None
        found.append(name)
    return " + ".join(found)


def _ideals(C: list[list[Vector]], central: Sequence[Vector]) -> list[list[int]]:
    """Basis vectors that brackets connect, also brackets that are constants."""
    n = len(C)
    label = list(range(n))
    for a in range(n):
        for b in range(a):
            joined = [c for c in range(n) if C[a][b][c]]
            if joined or central[a][b]:
                old = {label[k] for k in (a, b, *joined)}
                label = [label[a] if x in old else x for x in label]
    return [[i for i in range(n) if label[i] == x] for x in dict.fromkeys(label)]


def _are_shifts(C: list[list[Vector]], central: Sequence[Vector]) -> bool:
    """Whether Q -> Q + const removes the constants: K_ab = sum C_ab^c s_c."""
    pairs = [(a, b) for a in range(len(C)) for b in range(a)]
    rows = [C[a][b] for a, b in pairs]
    return rank(rows) == rank([[*C[a][b], central[a][b]] for a, b in pairs])


def _abelian(n: int) -> str:
    return "R" if n == 1 else f"R^{n}"


def _whole(C: list[list[Vector]], n: int, derived: int, *, extended: bool) -> str | None:
    """An algebra that is known as a whole."""
    plus, minus = _signature(C)
    if plus + minus == n:
        return _SEMISIMPLE.get((n, plus, minus))
    if not _is_unimodular(C):  # all that follow are
        return None
    if n == 3 and derived == 2:
        if extended:
            kinds = {(0, 1): "oscillator algebra", (1, 0): "oscillator algebra (hyperbolic)"}
        else:
            kinds = {(0, 1): "e(2)", (1, 0): "Poincaré iso(1,1)"}
        return kinds.get((plus, minus))
    if n == 8 and (plus, minus, derived) == (3, 1, 7) and extended and _nullity(C) == 2:
        return "sl(2,R) + so(1,1) with Heisenberg h(2)"
    for d in range(1, 5):
        turns = d * (d - 1) // 2
        turned = turns if d > 2 else 0  # so(2) is no bracket
        perfect = derived == n and d > 1 and not extended and _has_abelian_radical(C)
        found = (n, plus, minus, derived)
        schroedinger = (3 + turns + 2 * d, 2, 1 + turns, 3 + turned + 2 * d)
        if extended and found == schroedinger and _nullity(C) == 1 + d // 2:
            rotations = f" + so({d})" if d > 1 else ""
            return f"Schrödinger sch({d}): sl(2,R){rotations} with Heisenberg h({d})"
        # brackets give the momenta; with rotations the boosts too
        products = 2 * d + turned if d > 1 else 1
        if extended and found == (1 + turns + 2 * d, 0, turns, products):
            return f"Galilei in {d} dimension{'s' if d > 1 else ''}"
        if extended and found == (13, 0, 6, 12):
            return "Galilei in 3 dimensions + so(3)"  # two bodies: L_rel beside L
        if perfect and n == turns + 2 * d + 1 and (plus, minus) == (d, turns):
            return f"Poincaré iso({d},1)"
        if perfect and d > 2 and n == turns + d and (plus, minus) == (0, turns):
            return f"e({d})"
    return None


def _nullity(C: list[list[Vector]]) -> int:
    """How often ad_x has the eigenvalue 0, for a general x of the derived algebra.

    Of sl(2,R) that acts on all of h(d), the ranks of sl(2,R) and of the rotations; where it acts on
    a part alone, the rest comes to it.
    """
    n, source = len(C), random.Random("derived")
    weights = {(a, b): mpf(source.randint(-9, 9)) for a in range(n) for b in range(a)}
    x = [mpmath.fsum(w * C[a][b][c] for (a, b), w in weights.items()) for c in range(n)]
    ad = mpmath.matrix(
        [[mpmath.fsum(x[a] * C[a][b][c] for a in range(n)) for b in range(n)] for c in range(n)]
    )
    try:
        sizes = [abs(z) for z in mpmath.eig(ad, left=False, right=False)]
    except RuntimeError:  # mpmath's iteration did not end: no name
        return -1
    return sum(size < _OF_BLOCK * max(sizes) for size in sizes)


def _is_unimodular(C: list[list[Vector]]) -> bool:
    """Whether tr ad_a = sum_b C_ab^b vanishes: iso(1,1) has it, a dilation of p and h has not."""
    return all(abs(mpmath.fsum(row[b][b] for b in range(len(C)))) < _SMALL for row in C)


def _killing_form(C: list[list[Vector]]) -> mpmath.matrix:
    n = len(C)
    form = mpmath.matrix(n, n)
    for a in range(n):
        for b in range(a + 1):
            total = mpf(0)
            for c in range(n):
                for d in range(n):
                    if C[a][c][d] and C[b][d][c]:
                        total += C[a][c][d] * C[b][d][c]
            form[a, b] = form[b, a] = total
    return form


def _has_abelian_radical(C: list[list[Vector]]) -> bool:
    """Whether what the Killing form of a perfect algebra does not see commutes.

    It is the radical: R^3 of iso(2,1), but h(1) of sch(1) with its centre, of the same signature.
    """
    n, radical = range(len(C)), nullspace(_killing_form(C).tolist())
    return all(
        abs(mpmath.fsum(x[a] * y[b] * C[a][b][c] for a in n for b in n)) < _SMALL
        for x in radical for y in radical for c in n
    )  # fmt: skip


def _signature(C: list[list[Vector]]) -> tuple[int, int]:
    """How many positive and negative eigenvalues the Killing form has."""
    values = mpmath.eigsy(_killing_form(C), eigvals_only=True)
    scale = max((abs(x) for x in values), default=mpf(1)) or mpf(1)
    return (
        sum(1 for x in values if x > _SMALL * scale),
        sum(1 for x in values if x < -_SMALL * scale),
    )


def _centre(C: list[list[Vector]], central: Sequence[Vector]) -> list[Vector]:
    """A basis of what commutes with all, the basis vectors of the algebra among it first."""
    n = range(len(C))
    rows = [[C[a][b][c] for a in n] for b in n for c in n] + [[central[a][b] for a in n] for b in n]
    units = [[mpf(int(i == a)) for i in n] for a in n]
    own = [u for a, u in enumerate(units) if not any(row[a] for row in rows)]
    return _beyond([], [*own, *nullspace(rows)])


def _beyond(given: Sequence[Vector], vectors: Sequence[Vector]) -> list[Vector]:
    """The first of the vectors that are independent of each other and of the given ones."""
    found: list[Vector] = []
    base = rank(list(given))
    for vector in vectors:
        if rank([*given, *found, vector]) > base + len(found):
            found.append(vector)
    return found


def _without(
    C: list[list[Vector]], central: Sequence[Vector], centre: Sequence[Vector]
) -> tuple[list[list[Vector]], list[Vector]]:
    """The quotient by a part of the centre, in basis vectors of the algebra."""
    kept, parts = _by_centre(C, centre)
    inner = [[row[: len(kept)] for row in rows] for rows in parts]
    return inner, [[central[a][b] for b in kept] for a in kept]


def _extension(C: list[list[Vector]], z: Vector) -> tuple[list[list[Vector]], list[Vector]]:
    """The quotient by z, with what the brackets have of z in place of the constants."""
    kept, parts = _by_centre(C, [z])
    inner = [[row[: len(kept)] for row in rows] for rows in parts]
    return inner, [[row[-1] for row in rows] for rows in parts]


def _by_centre(
    C: list[list[Vector]], centre: Sequence[Vector]
) -> tuple[list[int], list[list[Vector]]]:
    """Basis vectors that with those of the centre are a basis, and the brackets in it."""
    units = [[mpf(int(i == a)) for i in range(len(C))] for a in range(len(C))]
    rest = _beyond(centre, units)
    kept = [units.index(unit) for unit in rest]
    inverse = mpmath.matrix([*rest, *centre]).T ** -1

    def parts(bracket: Vector) -> Vector:
        return [x if abs(x) > _SMALL else mpf(0) for x in inverse * mpmath.matrix(bracket)]

    return kept, [[parts(C[a][b]) for b in kept] for a in kept]


def _restricted(
    C: list[list[Vector]], central: Sequence[Vector], kept: Sequence[int]
) -> tuple[list[list[Vector]], list[Vector]]:
    return (
        [[[C[a][b][c] for c in kept] for b in kept] for a in kept],
        [[central[a][b] for b in kept] for a in kept],
    )
