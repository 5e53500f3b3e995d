"""Equal sums of products of atoms for one polynomial, by the trigonometric identities."""

from __future__ import annotations

from lagcli.algebra.entry import Field
from lagcli.algebra.ring import Monomial, Poly
from lagcli.algebra.roots import substitute_square
from lagcli.algebra.shaping.atoms import Atoms, Terms, multiply
from lagcli.algebra.shaping.trigonometry import Trigonometry

LONG = 60  # terms of a polynomial that gets one bracketing only
_MAX_REWRITTEN = 400  # measured: at most 80
_EXPANSIONS = 3  # that are bracketed, the shortest ones

_CIRCULAR = ("cos", "sin")
_QUADRATIC = ("cos", "cosh")


class Expansions:
    """The sums that are worth bracketing, the shortest first."""

    def __init__(self, field: Field, atoms: Atoms) -> None:
        self.field = field
        self.atoms = atoms
        self.trigonometry = Trigonometry(field, atoms)

    def of(self, poly: Poly, *, below: bool = False) -> list[Terms]:
        """Equal sums of products of atoms, which differ in the trigonometric functions.

        Below a fraction there is one with sin² x for cos 2x among them.
        """
        generators = self.field.generators
        used = self.field.ring.used(poly)
        plain = self.atoms.terms(poly)
        periodic = any(generators[g].kind in (*_QUADRATIC, "sin", "sinh") for g in used)
        if not periodic or len(poly) > _MAX_REWRITTEN:
            return [plain]
        found = [plain]
        by_rest = self._by_rest(poly)
        choices: list[list[Terms]] = []
        for rest, inner in by_rest:
            own = self.field.ring.build(inner)
            swapped = self._swapped(own)
            if len(swapped) < len(own):  # 1 - cos² is sin²: I1 sin² + I3 cos²
                own = swapped
            forms = [self.atoms.terms(own), self.atoms.terms(swapped)]
            rewritten = self.trigonometry.rewritten(inner, squared=below)
            forms.extend(rewritten or [forms[0], forms[0]])
            forms.append(min(forms, key=self._weight))
            outer = self.atoms.term(rest)
            choices.append([{multiply(outer, t): v for t, v in f.items()} for f in forms])
        width = max(len(c) for c in choices)
        for position in range(width):
            merged: Terms = {}
            for forms in choices:
                for term, value in forms[min(position, len(forms) - 1)].items():
                    merged[term] = merged.get(term, 0) + value
            merged = {t: v for t, v in merged.items() if v}
            if merged not in found:
                found.append(merged)
        found.sort(key=self._weight)
        return found[: _EXPANSIONS if len(poly) <= LONG else 1]

    def _weight(self, terms: Terms) -> int:
        """Roughly the operations of a sum of products."""
        costs = self.atoms.costs
        return sum(
            1 + (v.numerator < 0) + (abs(v) != 1) + sum(1 + costs[a] + (e != 1) for a, e in t)
            for t, v in terms.items()
        )

    def _by_rest(self, poly: Poly) -> list[tuple[Monomial, tuple[tuple[Monomial, int], ...]]]:
        """The trigonometric polynomial that stands by each other monomial."""
        generators = self.field.generators
        groups: dict[Monomial, list[tuple[Monomial, int]]] = {}
        for monomial, coefficient in self.field.ring.terms(poly):
            inside = tuple(p for p in monomial if generators[p[0]].kind in _CIRCULAR)
            outside = tuple(p for p in monomial if generators[p[0]].kind not in _CIRCULAR)
            groups.setdefault(outside, []).append((inside, coefficient))
        return [(rest, tuple(inner)) for rest, inner in groups.items()]

    def _swapped(self, poly: Poly) -> Poly:
        """The polynomial with cos² = 1 - sin² where that makes it shorter."""
        ring = self.field.ring
        for index in ring.used(poly):
            generator = self.field.generators[index]
            if generator.kind not in _QUADRATIC or ring.degree(poly, index) < 2:
                continue
            square = ring.generator(generator.partner) ** 2
            value = ring.one - square if generator.kind == "cos" else ring.one + square
            other = substitute_square(self.field, poly, index, value)
            if len(other) <= len(poly):
                poly = other
        return poly
