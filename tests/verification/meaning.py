"""Where two answer sheets of one problem say different things.

Formulas are compared by their values at random states, lists by what they hold, shapes of
modes up to a factor, charges up to a constant, so that a rewritten or reordered answer is the
same answer.  A difference is `wrong` where the second sheet claims something else, `weaker`
where it claims less and says so: null, undecided, not complete.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from random import Random
from typing import Any, Literal

from mpmath import mp, mpf

#: Prose, which no arithmetic verifies.
PROSE = {"reason", "warnings", "ansatz", "note", "title", "source", "name_of"}
#: Lists whose entries have no order.
SETS = {
    "solutions", "values", "turning_points", "where", "minimum", "hurwitz", "spectrum",
    "unstable", "frequencies_squared", "free", "constants", "cyclic", "indeterminate",
}  # fmt: skip
#: Inequalities that hold together; of `unstable` one of them.
CONDITIONS = {"where", "minimum", "hurwitz", "spectrum", "unstable"}
#: What tells the points of a circle from each other.
_CIRCLE = ("cos", "sin")
#: States at which lists of them are compared: a factor of 2 in one is seen at some of them.
_SEPARATING = 36


@dataclass(frozen=True)
class Difference:
    """Where two sheets differ, and how."""

    path: str
    kind: Literal["wrong", "weaker"]

    def __str__(self) -> str:
        return self.path if self.kind == "wrong" else f"({self.path})"


class Meaning:
    """Two sheets (JSON objects) of one problem.

    Parameters
    ----------
    problem
        What they answer.
    before, after
        The sheets.
    """

    def __init__(self, problem: Any, before: Any, after: Any) -> None:
        self.before, self.after = before, after
        self.problem = problem
        self.values = _Values(problem, [sheet.get("where") or {} for sheet in (before, after)])

    def differences(self) -> list[Difference]:
        """Everything in which the second differs from the first."""
        keys = (self.before.keys() | self.after.keys()) - PROSE - {"where"}
        found: list[Difference] = []
        for key in sorted(keys):
            found += self._differ(key, key, self.before.get(key), self.after.get(key))
        return found

    def _differ(self, path: str, key: str, a: Any, b: Any) -> Iterator[Difference]:
        if a == b:
            return
        if b is None or (key == "unstable" and not b):
            yield Difference(path, "weaker")
        elif key in CONDITIONS and a and b and self.values.hold_together(key, a, b):
            return
        elif isinstance(a, dict) and isinstance(b, dict):
            if not (key == "at" and self._same_place(a, b)):
                yield from self._differ_as_objects(path, a, b)
        elif isinstance(a, list | tuple) and isinstance(b, list | tuple):
            yield from self._differ_as_lists(path, key, list(a), list(b))
        elif not (isinstance(a, str) and isinstance(b, str) and self._same_text(key, a, b)):
            yield Difference(path, "wrong")

    def _differ_as_objects(self, path: str, a: Any, b: Any) -> Iterator[Difference]:
        skipped = set(PROSE)
        a, b = self._settled(a), self._settled(b)
        if path == "hamilton_jacobi":
            ways = list(_renamed(b, b.get("constants") or (), a.get("constants") or ()))
            b = next((each for each in ways if self._same_slopes(a, each)), ways[0])
            if self._same_action(a, b):
                skipped |= {"functions", "cases"}
            elif self._solves(b):
                skipped |= {"functions", "cases", "equations", "derivatives"}
        if path == "hamilton_jacobi/equations" and all(
            n in b and self.values.parallel([a[n], "0"], [b[n], "0"]) for n in a
        ):
            return
        if "amplitude" in a and self._same_to_lower_order(a, b):
            skipped |= {"amplitude", "order", "period"}
        if "charge" in a and a.get("conserved") and b.get("conserved") and (
            self._same_charge(a, b, scaled=path.startswith("discovered"))
        ):  # fmt: skip
            skipped |= {"charge", "gauge", "transformation", "name"}
        for key in sorted((a.keys() | b.keys()) - skipped):
            if key == "shape" and self._parallel(a[key], b.get(key)):
                continue
            default = "0" if path.endswith(("transformation", "shape")) else None
            one, other = a.get(key, default), b.get(key, default)
            if key in {"condition", "on"} and other is None and one is not None:
                yield Difference(f"{path}/{key}", "wrong")  # claimed everywhere
            else:
                yield from self._differ(f"{path}/{key}", key, one, other)

    def _same_place(self, a: Any, b: Any) -> bool:
        """Whether coordinates have the same values, or angles that are whole turns apart."""

        def same(name: str) -> bool:
            same_point = all(
                self.values.equal(f"{f}({a[name]})", f"{f}({b[name]})") for f in _CIRCLE
            )
            return same_point and self.values.recurs(name)

        return a.keys() == b.keys() and all(self.values.equal(a[n], b[n]) or same(n) for n in a)

    def _same_to_lower_order(self, a: Any, b: Any) -> bool:
        """Whether the second series of a period is the beginning of the first one."""
        if b.get("order") is None or b["order"] >= a["order"]:
            return False
        near, far = (
            self.values.gap(*(re.sub(rf"\b{s['amplitude']}\b", step, s["period"]) for s in (a, b)))
            for step in ("(1/4000)", "(1/1000)")
        )
        return near is not None and far is not None and 3 * near * 4 ** b["order"] < far

    def _settled(self, place: Any) -> Any:
        """`stable` where it has a minimum wherever it exists: both conditions are the same.

        What the roots say is left out where the minimum says the same.
        """
        minimum, condition = place.get("minimum"), place.get("condition") or ""
        for key in ("spectrum", "hurwitz"):
            roots = place.get(key)
            if minimum and roots and self.values.hold_together(key, minimum, roots):
                place = {k: v for k, v in place.items() if k != key}
        exists = [*condition.split(" and "), *(place.get("where") or ())]
        if not minimum or any(
            not any(self.values.equal(each, one) for one in exists) for each in minimum
        ):
            return place
        left = {k: v for k, v in place.items() if k not in {"minimum", "unstable"}}
        return {**left, "stable": True}

    def _differ_as_lists(
        self, path: str, key: str, a: list[Any], b: list[Any]
    ) -> Iterator[Difference]:
        if key in SETS or all(isinstance(each, dict) for each in (*a, *b)):
            yield from self._differ_as_sets(path, key, a, b)
        elif len(a) != len(b):
            yield Difference(path, "wrong")
        else:
            for place, (one, other) in enumerate(zip(a, b, strict=True)):
                yield from self._differ(f"{path}/{place}", "", one, other)

    def _differ_as_sets(
        self, path: str, key: str, a: list[Any], b: list[Any]
    ) -> Iterator[Difference]:
        left = list(b)
        alone = []
        for number, one in enumerate(a):
            ways = [
                (list(self._differ(f"{path}/{number}", key, one, other)), other) for other in left
            ]
            best = min(
                ways,
                key=lambda way: (any(d.kind == "wrong" for d in way[0]), len(way[0])),
                default=None,
            )
            if best is not None and not any(d.kind == "wrong" for d in best[0]):
                yield from best[0]
                left.remove(best[1])
            else:
                alone.append(number)
        if path in {"discovered", "charges"}:  # another one with its rate is as true
            left = [each for each in left if not self._has_its_rate(each)]
        if path == "modes":  # of a place that the first sheet calls unstable
            left = [each for each in left if not self.values.oscillates(each)]
        if path == "equilibria":  # a second time, without a verdict
            places = [each.get("at") for each in a]
            left = [
                e
                for e in left
                if e.get("at") not in places
                or e.get("stable") is not None
                or {"minimum", "hurwitz", "spectrum"} & e.keys()
            ]
        if alone or left:
            yield Difference(
                f"{path}: {len(alone)} of {len(a)} missing, {len(left)} others", "wrong"
            )

    # -- formulas ---------------------------------------------------------------------------

    def _same_text(self, key: str, a: str, b: str) -> bool:
        if " and " in a or " and " in b:
            one, other = a.split(" and "), b.split(" and ")
            return len(one) == len(other) and all(
                any(self._same_text(key, x, y) for y in other) for x in one
            )
        if key == "name":
            return _algebra(a) == _algebra(b)
        return self.values.equal(a, b)

    def _has_its_rate(self, charge: Any) -> bool:
        """Whether its rate on the motion is the printed one; a withheld charge claims nothing."""
        Q = charge["charge"]
        if Q is None or charge["conserved"] is None:
            return True
        rate = f"diff({Q}, t)" + "".join(
            f" + diff({Q}, {x})*{x}' + diff({Q}, {x}')*{x}''" for x in self.values.reference.names
        )
        return self.values.equal(charge["rate"] or "0", rate)

    def _same_slopes(self, a: Any, b: Any) -> bool:
        """Whether both have the same W', each with either sign."""
        one, other = (each.get("derivatives") or {} for each in (a, b))
        return one.keys() == other.keys() and all(
            self.values.equal(f"({one[name]})^2", f"({other[name]})^2") for name in one
        )

    def _solves(self, sheet: Any) -> bool:
        """Whether H(q, W') = E, the W' the derivatives of each W, with all constants in them."""
        slopes, constants = sheet.get("derivatives") or {}, sheet.get("constants") or ()
        H = sheet.get("hamiltonian") or ""
        for name, slope in slopes.items():
            if slope.startswith("sqrt(") and re.fullmatch(r"(?:(?!sqrt).)*", slope[1:]):
                H = H.replace(f"p_{name}^2", f"({slope[4:]})")
            H = re.sub(rf"\bp_{name}\b", f"({slope})", H)
        own = all(any(re.search(rf"\b{c}\b", s) for s in slopes.values()) for c in constants)
        return (
            bool(slopes and H)
            and own
            and self.values.equal(H, "E", partly=True)
            and self._same_action(sheet, sheet)
        )

    def _same_action(self, a: Any, b: Any) -> bool:
        """Whether each W that the second gives has the derivative W' of the first."""
        slopes = a.get("derivatives") or {}
        given = [(n, [W]) for n, W in b.get("functions", {}).items()]
        given += [(n, [c["function"] for c in each]) for n, each in b.get("cases", {}).items()]
        return all(
            name in slopes and self.values.equal(f"({slopes[name]})^2", f"diff({W}, {name})^2")
            for name, forms in given
            for W in forms
        )

    def _same_charge(self, a: Any, b: Any, *, scaled: bool) -> bool:
        """Whether two conserved charges differ by what is constant; or are multiples besides."""
        same = self.values.proportional if scaled else self.values.same_rate
        return bool(a["charge"] and b["charge"]) and same(a["charge"], b["charge"])

    def _parallel(self, a: Any, b: Any) -> bool:
        if not a or not b:
            return a == b
        return self.values.parallel([a[n] for n in a], [b.get(n, "0") for n in a])


def _algebra(name: str) -> str:
    """The name without what two right names of one algebra differ in: so(2) is R."""
    return re.sub(r"Schrödinger sch\(\d\): ", "", name).replace("so(2)", "R")


def _renamed(sheet: Any, old: Sequence[str], new: Sequence[str]) -> Iterator[Any]:
    """The sheet with other names for the constants of integration, each with either sign."""
    names = dict(zip(old, new, strict=False))
    pattern = re.compile(r"\b(" + "|".join(map(re.escape, names)) + r")\b")
    if not names:
        yield sheet
    for signs in product(("{}", "(-{})"), repeat=len(names)) if names else ():
        turned = {n: sign.format(names[n]) for n, sign in zip(names, signs, strict=True)}
        text = pattern.sub(lambda m, turned=turned: turned[m[0]], json.dumps(sheet))  # type: ignore[misc]
        yield {**json.loads(text), "constants": [names.get(n, n) for n in old]}


class _Values:
    """The values of formulas of both sheets at random states, by the tests' oracle."""

    def __init__(self, problem: Any, where: Sequence[Mapping[str, str]]) -> None:
        from tests.oracle.examine import with_momenta
        from tests.oracle.reference import Reference
        from tests.oracle.states import random_states

        self.reference = Reference(problem)
        self.where = where
        self._more = 3
        try:
            states = random_states(self.reference, 4)
            self.moments = [with_momenta(self.reference, s) for s in states]
        except AssertionError:
            self.moments = []

    def _widened(self) -> bool:
        """Have three times as many states, where formulas had no value; False at the end."""
        from tests.oracle.examine import with_momenta
        from tests.oracle.states import random_states

        self._more -= 1
        if self._more < 0 or not self.moments:
            return False
        states = random_states(self.reference, 3 * len(self.moments), seed=5)
        self.moments = [with_momenta(self.reference, s) for s in states]
        return True

    def equal(self, a: str, b: str, *, partly: bool = False) -> bool:
        """Whether two formulas, equations or inequalities say the same; `partly`: where both are real."""
        from tests.oracle.examine import agree

        for sign in (">", "<", "=", "!="):
            if f" {sign}" in a and f" {sign}" in b:
                return self._same_relation(sign, a, b)
        known: list[tuple[Any, Any]] = []
        while not known:
            pairs = zip(self._of(a, 0), self._of(b, 1), strict=True)
            known = [pair for pair in pairs if pair != (None, None)]
            known = [pair for pair in known if None not in pair] if partly else known
            if not known and not self._widened():
                return False
        both = [(x, y) for x, y in known if x is not None and y is not None]
        if "diff(" in b:
            return bool(both) and all(agree(x, y) for x, y in both)  # W may be that of a part
        return len(both) == len(known) and all(agree(x, y) for x, y in both)

    def _same_relation(self, sign: str, a: str, b: str) -> bool:
        from tests.oracle.examine import agree

        sides = [[part.strip(" =") for part in each.split(f" {sign}", 1)] for each in (a, b)]
        values = [[self._of(s, which) for s in pair] for which, pair in enumerate(sides)]
        gaps = [
            [None if p is None or q is None else p - q for p, q in zip(*each, strict=True)]
            for each in values
        ]
        known = [(x, y) for x, y in zip(*gaps, strict=True) if x is not None or y is not None]
        if sign == "=":
            return bool(known) and all(
                x is not None
                and y is not None
                and (agree(x, y) or (agree(x, mpf(0)) and agree(y, mpf(0))))
                for x, y in known
            )
        return bool(known) and all(
            x is not None and y is not None and (x > 0) == (y > 0) for x, y in known
        )

    def hold_together(self, key: str, a: Sequence[str], b: Sequence[str]) -> bool:
        """Whether two lists of inequalities are true at the same states."""
        together = any if key == "unstable" else all
        while len(self.moments) < _SEPARATING and self._widened():
            pass
        one, other = (
            [[self._holds(each, which, k) for each in given] for k in range(len(self.moments))]
            for which, given in enumerate((a, b))
        )
        return bool(one) and all(
            together(x) == together(y) for x, y in zip(one, other, strict=True)
        )

    def _holds(self, inequality: str, which: int, number: int) -> bool | None:
        sign = next((s for s in (" > ", " < ", " != ") if s in inequality), None)
        if sign is None:
            return None
        left, right = (self._of(side, which)[number] for side in inequality.split(sign, 1))
        if left is None or right is None:
            return None
        return bool({" > ": left > right, " < ": left < right, " != ": left != right}[sign])

    def gap(self, a: str, b: str) -> Any:
        """How far two formulas are apart at the first state where both have a value."""
        pairs = zip(self._of(a, 0), self._of(b, 1), strict=True)
        return next((abs(x - y) for x, y in pairs if x is not None and y is not None), None)

    def same_rate(self, a: str, b: str) -> bool:
        """Whether the difference of two formulas depends on parameters alone."""
        from tests.oracle.examine import agree

        one, other = self._of(a, 0, moving=True), self._of(b, 1, moving=True)
        gaps = [x - y for x, y in zip(one, other, strict=True) if x is not None and y is not None]
        return bool(gaps) and all(agree(gap, gaps[0]) for gap in gaps)

    def proportional(self, a: str, b: str) -> bool:
        """Whether a formula is another one times and plus what depends on parameters alone."""
        from tests.oracle.examine import agree

        pairs = zip(self._of(a, 0, moving=True), self._of(b, 1, moving=True), strict=True)
        known = [(x, y) for x, y in pairs if x is not None and y is not None]
        gaps = [(x - known[0][0], y - known[0][1]) for x, y in known[1:]]
        moves = bool(gaps) and any(x for x, _ in gaps) and any(y for _, y in gaps)
        return moves and all(agree(p * v, u * q) for p, q in gaps for u, v in gaps)

    def parallel(self, a: Sequence[str], b: Sequence[str]) -> bool:
        """Whether two vectors are multiples of each other."""
        from tests.oracle.examine import agree

        one = list(zip(*(self._of(each, 0) for each in a), strict=True))
        other = list(zip(*(self._of(each, 1) for each in b), strict=True))
        pairs = [(p, q) for p, q in zip(one, other, strict=True) if None not in (*p, *q)]
        return bool(pairs) and all(
            any(q) and agree(p[i] * q[j], p[j] * q[i])
            for p, q in pairs
            for i in range(len(p))
            for j in range(i)
        )

    def recurs(self, name: str) -> bool:
        """Whether L, the forces and what constrains are the same a turn of a coordinate further."""
        from tests.oracle.examine import agree

        reference, problem = self.reference, self.reference.problem
        place = reference.names.index(name)
        bounds = [reference.value(each) for each in (*problem.constraints, *problem.contacts)]

        def felt(moment: Any) -> list[Any]:
            held = [f(moment) for f in bounds]
            return [reference.lagrangian(moment), *reference.applied(moment), *held]

        pairs = ((felt(m), felt(m.shifted(0, {place: 2 * mp.pi}))) for m in self.moments)
        return bool(self.moments) and all(all(map(agree, *each)) for each in pairs)

    def oscillates(self, mode: Any) -> bool:
        """Whether a printed normal mode solves the equations of motion to first order."""
        from lagcli.reader import parse_text
        from tests.oracle.jets import real_part
        from tests.verification.truth import oscillates

        def of(text: str) -> Any:
            return real_part(self.reference.of(parse_text(text))(self.moments[0]))

        try:
            return oscillates(self.reference, self.moments[0], mode, of)
        except Exception:  # noqa: BLE001 - no value, or no shape
            return False

    def _of(self, text: str, which: int, *, moving: bool = False) -> list[Any]:
        """The value at each state, None where there is none."""
        from lagcli.reader import parse_text

        try:
            node = parse_text(text)
        except Exception:  # noqa: BLE001 - not a formula: its text counts
            return [mpf(sum(ord(c) * 7**k for k, c in enumerate(text[:40])))] * len(self.moments)
        moments = self.moments
        if moving and moments:
            moments = [replace(each, extra=moments[0].extra) for each in moments]
        return [self._at(node, number, each, which) for number, each in enumerate(moments)]

    def _at(self, node: Any, number: int, moment: Any, which: int) -> Any:
        from lagcli.expression import Name, walk
        from lagcli.reader import parse_text
        from tests.oracle.jets import real_part

        known = moment
        try:
            for name, text in self.where[which].items():
                value = real_part(self.reference.of(parse_text(text))(known))
                known = replace(known, extra={**known.extra, name: value})
            names = {p.name for p in walk(node) if isinstance(p, Name)}
            free = names - set(self.reference.names) - {"t", "pi"} - set(known.extra)
            extra = {n: mpf(Random(f"{n}{number}").randint(-999, 1999)) / 700 for n in free}
            there = replace(known, extra={**known.extra, **extra})
            return real_part(self.reference.of(node)(there))
        except Exception:  # noqa: BLE001 - no value there
            return None
