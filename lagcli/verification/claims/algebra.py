"""The Lie algebra of the listed charges: counts, structure constants, invariants of its name.

The brackets of the charges are fitted by combinations of them and of 1 at random states with the
same parameters, and tried at others.  A name stands for what a basis does not change: dimensions of
the algebra and of the derived one, and the signature of the Killing form tr(ad_a ad_b).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import islice, pairwise
from typing import NamedTuple

from flint import arb, arb_mat

from lagcli.record import replace
from lagcli.statements.answers import AlgebraSection, ChargesSection
from lagcli.verification.claims.canonical_samples import CanonicalSample, around_states, samples
from lagcli.verification.claims.special_values import holds
from lagcli.verification.examination import Examination
from lagcli.verification.linear import Unclear, dot, rank, size

_MOST = 21  # charges
_SMALL = 1e-12
_NO_COEFFICIENT = 1e-25  # measured: zeros are below 2e-35
#: Choices of the parameters at which the name is tried.
_PARAMETERS = 12


class Signature(NamedTuple):
    """What a basis does not change: dimensions, signs of the eigenvalues of the Killing form."""

    dimension: int
    positive: int
    negative: int
    derived: int  # its dimension, with the constants in it
    #: What a name leaves open: whether R turns or stretches h(d), and how much of it.
    more_eigenvalues: int = 0
    more_derived: int = 0


_KNOWN = {
    "so(3)": Signature(3, 0, 3, 3), "sl(2,R)": Signature(3, 2, 1, 3),
    "so(4)": Signature(6, 0, 6, 6), "so(3,1)": Signature(6, 3, 3, 6),
    "so(2,2)": Signature(6, 4, 2, 6), "su(3)": Signature(8, 0, 8, 8),
    "so(5)": Signature(10, 0, 10, 10), "so(4,1)": Signature(10, 4, 6, 10),
    "so(3,2)": Signature(10, 6, 4, 10), "e(2)": Signature(3, 0, 1, 2),
    "R": Signature(1, 0, 0, 0), "so(2)": Signature(1, 0, 1, 0), "so(1,1)": Signature(1, 1, 0, 0),
    "Poincaré iso(1,1)": Signature(3, 1, 0, 2), "oscillator algebra": Signature(4, 0, 1, 3),
    "oscillator algebra (hyperbolic)": Signature(4, 1, 0, 3),
}  # fmt: skip
_MODULO_CONSTANTS = ", modulo constants"
#: Energies for which a name says that it is that of the algebra.
_AT = {"the energy is negative": -1, "it is 0": 0, "it is positive": 1}
_OVER_ENERGY = "the energy and "


def conserved(x: Examination, listed: ChargesSection) -> tuple[list[int], int]:
    """The steps of the charges, none where they are too many, and how many are of points."""
    constant = [c for c in listed.charges if c.conserved]  # a momentum equation counts as none
    known = [c.charge for c in constant if c.charge is not None]
    places = x.places("the algebra", known)
    if places is None or len(known) > _MOST or x.reference.large:
        return [], 0
    points = sum(not any(map(x.has_velocities, c.transformation.values())) for c in constant)
    return places, points


class Counted:
    """A section beside what the samples say."""

    @classmethod
    def sampled(cls, x: Examination, places: Sequence[int]) -> Sequence[CanonicalSample]:
        """As many samples as the counts need, none where they are not found."""
        count = 2 * len(places) + 6
        found = samples(x, places, count)
        return found if len(found) == count else ()

    def __init__(
        self,
        x: Examination,
        section: AlgebraSection,
        found: Sequence[CanonicalSample],
        places: Sequence[int],
        points: int,
    ) -> None:
        self.x, self.section, self.samples = x, section, found
        self.places, self.count, self.points = places, len(places), points

    def examined(self) -> AlgebraSection | None:
        """The section without what does not hold."""
        section, x = self.section, self.x
        if section.dimension not in {self.count, self.points}:
            x.refute("the dimension of the algebra", f"{self.count} charges are listed")
            return None
        if section.number != self.count:
            x.refute("the number of charges of the algebra", f"{self.count} are listed")
            return None
        if self._rank_of_values() < self.count:
            x.refute("the dimension of the algebra", "the listed charges depend on each other")
            return None
        independent = self._rank_of_slopes(range(self.count))
        given_up = "brackets were not worked out" in section.ansatz  # then it is at least 1
        if independent != section.independent and not given_up:
            why = f"{independent} are independent, not {section.independent}"
            x.refute("the number of independent charges", why)
            return None
        if section.determines and not self._suffice(section.determines):
            what = f"that the charges give the {section.determines}"
            x.refute(what, f"a state has {self.states} dimensions")
            section = replace(section, determines="", integrable=None)
        if section.name is not None and not self._has_name(section.name):
            x.refute(f"that the algebra is {section.name}", "its structure constants are others")
            section = replace(section, name=None)
        if section.in_involution is not None and not self._in_involution(section.in_involution):
            x.refute("the number of charges in involution", "their brackets say otherwise")
            section = replace(section, in_involution=None, integrable=None)
        special = tuple(s for s in section.special if holds(x, s, self.places, section.special))
        return replace(section, special=special)

    # -- counts ---------------------------------------------------------------------------------

    @property
    def freedom(self) -> int:
        """The number of degrees of freedom."""
        return len(self.x.reference.names)

    @property
    def states(self) -> int:
        """The dimension of the space of states."""
        return 2 * self.freedom

    def _rank_of_values(self) -> int:
        """Of the charges and 1, without the 1."""
        rows = [[*s.values, arb(1)] for s in self.samples]
        return _rank(rows, self.count + 1) - 1

    def _rank_of_slopes(self, which: Iterable[int]) -> int:
        return max(rank_of(s, which) for s in self.samples[:3])

    def _in_involution(self, claimed: int) -> bool:
        """Whether at most `claimed` charges are in involution, n of them where integrable."""
        n, section = self.freedom, self.section
        by_them = section.integrable and not (section.separates or section.determines)
        if claimed > n or (by_them and claimed < n):
            return False
        fixed = self._fixed()
        commuting = {(i, j) for i in fixed for j in fixed if self._commute(i, j)}
        return self._largest([], fixed, commuting) <= claimed

    def _suffice(self, what: str) -> bool:
        """Whether there are as many as a state has dimensions, or one less without t: an orbit."""
        if what == "state":
            return self._rank_of_slopes(range(self.count)) == self.states
        return self._rank_of_slopes(self._fixed()) == self.states - 1

    def _fixed(self) -> list[int]:
        t = self.x.reference.time
        return [k for k, place in enumerate(self.places) if self._still(place, t)]

    def _still(self, place: int, t: int) -> bool:
        """Whether a charge does not contain the time."""
        slopes = (s.state.at.gradient(place).get(t, arb(0)) for s in self.samples[:2])
        return all(size(slope) < _SMALL for slope in slopes)

    def _commute(self, i: int, j: int) -> bool:
        return all(size(s.bracket(i, j)) < _SMALL for s in self.samples[:3])

    def _largest(self, chosen: list[int], left: list[int], commuting: set[tuple[int, int]]) -> int:
        """The largest number of independent charges in involution, by trying."""
        best = self._rank_of_slopes(chosen) if chosen else 0
        for place, k in enumerate(left):
            rest = [j for j in left[place + 1 :] if (k, j) in commuting]
            if best < len(chosen) + 1 + len(rest):
                best = max(best, self._largest([*chosen, k], rest, commuting))
        return best

    # -- structure ------------------------------------------------------------------------------

    def _has_name(self, name: str) -> bool:
        """Whether the algebra has the signature that the name stands for.

        For several choices of the parameters: their signs may change that.
        """
        expected = signatures_of(name)
        size_ = self.section.dimension
        columns = size_ + 1 if None in expected else 2 * size_ + 1
        around = islice(self._around(columns + 4), _PARAMETERS)
        return bool(expected) and all(_has(each, size_, columns, expected) for each in around)

    def _around(self, count: int) -> Iterator[Sequence[CanonicalSample]]:
        """So many samples for each of several choices of the parameters."""
        return around_states(self.x, self.places, count, CanonicalSample)


def algebra(
    x: Examination,
    section: AlgebraSection,
    listed: ChargesSection,
    counted: type[Counted] = Counted,
) -> AlgebraSection | None:
    """Every number and the name; None where a number is wrong."""
    places, points = conserved(x, listed)
    if not places:
        return section
    found = counted.sampled(x, places)
    if not found:
        x.unchecked.append("the algebra of the conserved quantities")
        return section
    return counted(x, section, found, places, points).examined()


def _has(
    around: Sequence[CanonicalSample],
    size_: int,
    columns: int,
    expected: Mapping[int | None, Signature],
) -> bool:
    if len(around) < columns + 4:
        return True
    structure = _structure(around, size_, columns)
    return structure is not None and all(
        _has_signature(structure(energy or 0), signature) for energy, signature in expected.items()
    )


def _has_signature(brackets: Sequence[Sequence[Sequence[arb]]], expected: Signature) -> bool:
    constants = [[row[:-1] for row in rows] for rows in brackets]
    plus, minus = signs([[_trace(one, other) for other in constants] for one in constants])
    beyond = (plus - expected.positive, minus - expected.negative)
    highest = expected.derived + expected.more_derived
    products = [row for number, rows in enumerate(brackets) for row in rows[:number]]
    return (
        len(constants) == expected.dimension
        and min(beyond) >= 0
        and sum(beyond) <= expected.more_eigenvalues
        and _rank(products, expected.dimension + 1) in {-1, *range(expected.derived, highest + 1)}
    )


def signs(form: Sequence[Sequence[arb]]) -> tuple[int, int]:
    """How many eigenvalues of a symmetric matrix are positive and negative: Descartes' rule.

    All roots of its characteristic polynomial are real, so that the changes of sign count them.
    """
    scale = max([1e-9, *(size(x) for row in form for x in row)])
    rows = [[x.mid() / scale for x in row] for row in form]
    given = [float(c.mid()) for c in arb_mat(rows).charpoly().coeffs()]
    kept = [(k, c) for k, c in enumerate(given) if abs(c) > _NO_COEFFICIENT]
    plus = sum(a * b < 0 for (_, a), (_, b) in pairwise(kept))
    return plus, len(form) - kept[0][0] - plus


def _structure(
    around: Sequence[CanonicalSample], count: int, columns: int
) -> Callable[[int], list[list[list[arb]]]] | None:
    """C, by the energy E, with {Q_a, Q_b} = sum_c C_abc Q_c + C_ab1; None where there is none.

    C = A + E B where there are columns for the E Q_c.
    """

    def row(s: CanonicalSample) -> list[arb]:
        Q = s.values[:count]
        return [*Q, arb(1), *(s.state.laws.energy * each for each in Q)][:columns]

    fitted, tried = around[:columns], around[columns:]
    pairs = [(a, b) for a in range(count) for b in range(a)]
    right = arb_mat([[s.bracket(a, b) for a, b in pairs] or [arb(0)] for s in fitted])
    try:
        solution = arb_mat(list(map(row, fitted))).solve(right)
    except ZeroDivisionError:
        return None
    found = {}
    for column, (a, b) in enumerate(pairs):
        fit = (solution[place, column].mid() for place in range(columns))
        found[a, b] = [c if size(c) > _SMALL else arb(0) for c in fit]
        for s in tried:
            value = dot(found[a, b], row(s))
            if size(value - s.bracket(a, b)) > 1e-9 * (1 + size(value)):
                return None

    numbers = range(count if columns > count + 1 else 0)
    of_energy = [
        c for c in numbers
        if all(size(s.values[c] - s.state.laws.energy) < _SMALL for s in tried)
    ]  # fmt: skip

    def constants(energy: int) -> list[list[list[arb]]]:
        whole = [[[arb(0)] * (count + 1) for _ in range(count)] for _ in range(count)]
        for (a, b), given in found.items():
            rates = [*(given[count + 1 :] or [arb(0)] * count), arb(0)]
            bracket = [c + energy * rate for c, rate in zip(given, rates, strict=False)]
            for c in of_energy:  # it is a constant there
                bracket[count] += energy * bracket[c]
                bracket[c] = arb(0)
            whole[a][b] = bracket
            whole[b][a] = [-c for c in bracket]
        return whole

    return constants


def _trace(one: Sequence[Sequence[arb]], other: Sequence[Sequence[arb]]) -> arb:
    """tr(ad_a ad_b)."""
    rows, columns = one, list(zip(*other, strict=True))
    return sum((dot(row, column) for row, column in zip(rows, columns, strict=True)), arb(0))


def rank_of(sample: CanonicalSample, which: Iterable[int]) -> int:
    """The number of independent gradients of these functions."""
    return _rank([sample.gradients[i] for i in which], len(sample.gradients[0]))


def _rank(rows: Sequence[Sequence[arb]], columns: int) -> int:
    try:
        return rank(rows, columns)
    except Unclear:
        return -1


def signatures_of(name: str) -> dict[int | None, Signature]:
    """That of a name, or those at the energies -1, 0, 1 that it tells apart; none if unknown.

    The centre of an algebra with constants is one of the charges, or the constant 1.
    """
    found = {}
    for part in name.removesuffix(_MODULO_CONSTANTS).removeprefix(_OVER_ENERGY).split(", "):
        algebra_, _, where = part.partition(" where ")
        signature = signature_of(f"{algebra_} + R" if name.startswith(_OVER_ENERGY) else algebra_)
        if signature is None:
            return {}
        dimension = signature.dimension - name.endswith(_MODULO_CONSTANTS)
        found[_AT.get(where)] = signature._replace(dimension=dimension)
    return found


def signature_of(name: str) -> Signature | None:
    """Of a name, a direct sum, or what acts on a Heisenberg algebra; None if it is not known."""
    acting = re.fullmatch(
        r"(?:Schrödinger sch\(\d\): )?(.*) with Heisenberg h\((\d+)\)(?: \+ (.*))?", name
    )
    parts = (acting[3] if acting else name) or "R^0"
    known = [*map(_one, parts.split(" + "))]
    if acting:
        d, all_of_it = int(acting[2]), name.startswith("Schrödinger")
        derived = (1 + 2 * d, 0, 0) if all_of_it else (1, 0, 2 * d)
        known += [Signature(2 * d + 1, 0, 0, *derived), *map(_acting, acting[1].split(" + "))]
    if None in known:
        return None
    return Signature(*map(sum, zip(*known, strict=True)))


def _acting(name: str) -> Signature | None:
    found = _one(name)
    if found is None or not name.startswith("R"):
        return found
    return found._replace(more_eigenvalues=found.dimension)


def _one(name: str) -> Signature | None:
    if name in _KNOWN:
        return _KNOWN[name]
    found = re.fullmatch(r"(Heisenberg h\(|e\(|Galilei in |Poincaré iso\()(\d+)\D.*|R\^(\d+)", name)
    if found is None:
        return None
    if found[3]:
        return Signature(int(found[3]), 0, 0, 0)
    d = int(found[2])
    turns = d * (d - 1) // 2
    turned = turns if d > 2 else 0  # so(2) is no bracket
    boosted = d if d > 1 else 0  # rotations give boosts
    return {
        "Heisenberg h(": Signature(2 * d + 1, 0, 0, 1),
        "e(": Signature(turns + d, 0, turns, turned + d),
        "Galilei in ": Signature(2 + turns + 2 * d, 0, turns, turned + boosted + d + 1),
        "Poincaré iso(": Signature(turns + 2 * d + 1, d, turns, turns + 2 * d + 1),
    }.get(found[1])
