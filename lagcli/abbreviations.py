"""Abbreviations of long answers: names for what recurs in them, and those written out again.

Where a formula would fill more than some three lines, a denominator that the rows share is named
Δ, sines and cosines of differences s12 and c12, other sums k1, k2, …, in a formula of two lines
only what it has twice.  Beside changes Δx it is χ1, χ2, … for Δ.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from fractions import Fraction

from lagcli.document import Block, Equations, Label, Paragraph, Row
from lagcli.expression import (
    Call,
    Expression,
    Name,
    Negative,
    PartialCall,
    Power,
    Product,
    Quotient,
    Sum,
    all_negative,
    children,
    operation_count,
    opposite,
    postorder,
    walk,
    without_minus,
)
from lagcli.notation.letters import names_in
from lagcli.notation.likeness import (
    EVEN,
    ODD,
    Monomial,
    SignedNumbers,
    multiplied_out,
    parity,
)
from lagcli.notation.naming import PART_STEMS, Names, free_stem
from lagcli.notation.ordering import positive_first
from lagcli.record import replace
from lagcli.rewriting import expressions_in, parts_in, rebuilt, rewritten, substituted
from lagcli.statements.answers import Answers, Charge
from lagcli.statements.explanation import Explanation
from lagcli.statements.registry import in_order

#: Operations beyond which a formula is not written out: it would fill some thirty pages.
MOST_OPERATIONS = 100_000
#: Operations of three lines of 80 columns.
LONG = 65
_TWO_LINES = 36
#: What is named has as many operations, or two thirds of them where it occurs often.
_WORTH = 8
_OFTEN = 3
#: What has no more operations with the names in it has none of its own.
_HARDLY = 2
#: Occurrences from which a long root is named: in three pairs of results.
_ROOTS = 6
#: Occurrences from which a sine or cosine of a difference is named.
_CIRCULAR = 4
_MOST_NAMES = 12
#: The steps of an explanation up to the equations of motion.
_DERIVATION = 3


def abbreviated(answers: Answers, taken: Collection[str]) -> Answers:
    """The answers with names for what recurs in long formulas, and in sections of some length."""
    given = [
        each.name
        for each in in_order(answers.sections)
        if each.abbreviated and _has_lines(answers.sections[each.name])
    ]
    names = None if answers.where else _found([answers.sections[name] for name in given], taken)
    if names is None:
        return answers
    sections = {
        name: rewritten(section, names) if name in given else section
        for name, section in answers.sections.items()
    }
    return replace(answers, sections=sections, where=names.where)


def _has_lines(section: object) -> bool:
    """Whether a formula fills more than two lines, or has a root that others have, too."""
    trees = [*expressions_in(section)]
    return any(operation_count(tree) > _TWO_LINES for tree in trees) or bool(_long_roots(trees))


def in_steps(explanation: Explanation, taken: Collection[str]) -> Explanation:
    """The explanation with such names in its results, each listed where it first occurs.

    The system, L and the equations of motion are derived from each other as they are written.
    """
    derived = explanation.steps[_DERIVATION:]
    names = _found(derived, taken)
    if names is None:
        return explanation
    steps, left = [*explanation.steps[:_DERIVATION]], dict(names.where)
    for step in derived:
        step = replace(step, blocks=tuple(names.in_block(block) for block in step.blocks))
        used = names_in(step.blocks)
        for name, node in reversed(names.where.items()):  # each after those that it uses
            used |= names_in(node) if name in used else set()
        rows = tuple(Row(Name(name), left.pop(name)) for name in [*left] if name in used)
        word = "abbreviations" if len(rows) > 1 else "abbreviation"
        listed = (Paragraph((f"With the {word}",)), Equations(rows)) if rows else ()
        steps.append(replace(step, blocks=(*listed, *step.blocks)))
    return replace(explanation, steps=tuple(steps))


def _found(parts: Sequence[object], taken: Collection[str]) -> _Abbreviations | None:
    """The names for formulas of which one is long; None where nothing is worth a name."""
    trees = [*dict.fromkeys(tree for part in parts for tree in expressions_in(part))]
    if not any(operation_count(tree) > LONG for tree in trees) and not _long_roots(trees):
        return None
    names = _Abbreviations(trees, taken, changes=any(map(_has_changes, parts)))
    return names if names.where else None


def _has_changes(part: object) -> bool:
    """Whether Δx is the change of a coordinate there, so that Δ is no denominator."""
    labels, charges = parts_in(part, Label), parts_in(part, Charge)
    return any(each.change for each in labels) or any(each.transformation for each in charges)


def _long_roots(trees: Sequence[Expression]) -> set[Call]:
    """The long roots that stand in several results, as sqrt(b) of a ± sqrt(b) in each."""
    roots = Counter(
        p for t in trees for p in walk(t) if isinstance(p, Call) and p.function == "sqrt"
    )
    return {r for r, n in roots.items() if n >= _ROOTS and operation_count(r) >= 2 * _WORTH}


class _Abbreviations:
    """The names chosen for some formulas, the one that saves most first."""

    def __init__(
        self, trees: Sequence[Expression], taken: Collection[str], *, changes: bool
    ) -> None:
        self._taken = Names(taken)
        self._alike = SignedNumbers()
        self._labels: dict[str, tuple[int, int]] = {}  # what is named, as it was when chosen
        self._wholes: dict[str, Expression] = {}
        self._chosen: dict[str, Expression] = {}
        self._trees = list(trees)
        self._long = [operation_count(tree) > _TWO_LINES for tree in trees]
        self._beside: set[str] = set()  # what other rows of a block have
        self._stem = free_stem(PART_STEMS, taken)
        # of denominators beside Δx
        others = [stem for stem in ("chi", "xi", "zeta") if stem != self._stem]
        self._denominators = free_stem(others, taken) if changes else "Delta"
        self._numbered: dict[str, list[str]] = {self._stem: [], self._denominators: []}
        while len(self._chosen) < _MOST_NAMES and (best := self._best()) is not None:
            self._take(best)
        self._short = self._left_out()
        found = dict(self._ordered())
        self._final: dict[str, str] = {}
        for labels in self._numbered.values():
            counted = (name for name in found if name in labels)
            self._final.update(zip(counted, labels, strict=False))
        self.where = {self._final.get(n, n): self._renamed(node) for n, node in found.items()}

    def __call__(self, node: Expression) -> Expression:
        """The formula with the names."""
        long = operation_count(node) > _TWO_LINES
        for label in self._labels:  # as they were chosen
            node = self._with_name(node, label) if self._is_for(label, node, long) else node
        return self._renamed(substituted(node, self._short))

    def in_block(self, block: Block) -> Block:
        """The block with the names; one that a row of it has is known again in the others."""
        trees = [*expressions_in(block)]
        self._beside = {label for tree in trees for label in self._labels_of(tree)}
        named = rewritten(block, self)
        self._beside = set()
        return named

    def _labels_of(self, tree: Expression) -> Iterator[str]:
        long = operation_count(tree) > _TWO_LINES
        for label in self._labels:
            if self._is_for(label, tree, long):
                named = self._with_name(tree, label)
                yield from [label] if named is not tree else []
                tree = named

    def _is_for(self, label: str, tree: Expression, long: bool) -> bool:
        """Whether a formula has this name: V = 2 k a² (1 − cos θ)² − m a k1 is not known again."""
        if long or label not in self._numbered[self._stem]:
            return True
        which = self._labels[label][1]
        if label in self._beside:
            return self._alike(tree)[1] != which
        return sum(self._alike(part)[1] == which for part in walk(tree)) > 1

    def _with_name(self, node: Expression, label: str) -> Expression:
        """The formula with a name for what is the same up to its sign and the order of terms."""
        sign, which = self._alike(node)
        if (its := self._labels[label])[1] == which and not isinstance(node, Negative):
            return Name(label) if sign == its[0] else Negative(Name(label))
        if isinstance(node, (Name, PartialCall)) or not children(node):
            return node
        found = rebuilt(node, lambda part: self._with_name(part, label))
        if isinstance(found, Sum):
            found = _with_part_named(found, label, self._wholes[label])
        return node if found is node else _with_sign_before(found)

    def _renamed(self, node: Expression) -> Expression:
        """k1, k2, … and Δ, Δ2, … in the order in which they are listed."""
        if isinstance(node, Name):
            return Name(self._final.get(node.name, node.name), node.primes)
        found = rebuilt(node, self._renamed)
        return self._in_order(found) if isinstance(found, Product) else found

    def _in_order(self, node: Product) -> Product:
        """k1 k2 t, not t k2 k1."""
        place = {name: k for k, name in enumerate((*self._final.values(), "t"))}
        named = [f for f in node.factors if isinstance(f, Name) and f.name in place]
        ordered = iter(sorted(named, key=lambda f: place[f.name]))
        return Product(tuple(next(ordered) if f in named else f for f in node.factors))

    def _best(self) -> Expression | None:
        below = self._below()
        shapes: dict[int, Counter[Expression]] = {}
        for tree, long in zip(
            (*self._trees, *self._chosen.values()),
            (*self._long, *[True] * len(self._chosen)),
            strict=True,
        ):
            inside = [p for p in walk(tree) if isinstance(p, (Sum, Call))]
            times = Counter(self._alike(p)[1] for p in inside)
            for p in inside:
                which = self._alike(p)[1]
                if long or times[which] > 1 or which in below or _circular_name(p):
                    shapes.setdefault(which, Counter())[p] += 1
        counts = {which: found.total() for which, found in shapes.items()}
        first = {which: next(iter(found)) for which, found in shapes.items()}
        for tree in self._trees:  # a result is no abbreviation of itself
            counts.pop(self._alike(tree)[1], None)
            if isinstance(tree, Quotient) and operation_count(tree) <= _TWO_LINES:
                counts.pop(self._alike(tree.numerator)[1], None)
        roots = _long_roots(self._trees)
        for which, part in first.items():  # an angle has no name of its own
            if which in counts and isinstance(part, Call) and part not in roots:
                for angle in part.arguments:
                    if (inner := self._alike(angle)[1]) in counts:
                        counts[inner] -= counts[which]
        savings = {
            which: (count - 1) * operation_count(first[which])
            for which, count in counts.items()
            if count > 1 and _is_worth(first[which], count, which in below)
        }
        best = max(savings, key=lambda which: savings[which], default=None)
        return None if best is None else shapes[best].most_common(1)[0][0]

    def _below(self) -> set[int]:
        """What is named Δ: denominators, and the radicand of all results."""
        found = {self._alike(f)[1] for tree in self._trees for f in _sums_below(tree)}
        return found | {self._alike(root.arguments[0])[1] for root in _long_roots(self._trees)}

    def _take(self, whole: Expression) -> None:
        its = self._alike(whole)
        below = its[1] in self._below()
        circular, stem = _circular_name(whole), self._denominators if below else self._stem
        label = self._new(circular or (stem if stem == "Delta" else f"{stem}1"))
        if not circular:
            self._numbered[stem].append(label)
        self._labels[label] = its
        self._wholes[label] = whole
        self._trees = [
            self._with_name(tree, label) if self._is_for(label, tree, long) else tree
            for tree, long in zip(self._trees, self._long, strict=True)
        ]
        self._chosen = {name: self._with_name(node, label) for name, node in self._chosen.items()}
        self._chosen[label] = whole

    def _new(self, wanted: str) -> str:
        stem = wanted.rstrip("0123456789")
        number = 1 if stem == wanted else int(wanted[len(stem) :])
        while wanted in self._taken:
            number += 1
            wanted = f"{stem}{number}"
        self._taken.add(wanted)
        return wanted

    def _left_out(self) -> dict[str, Expression]:
        """What is hardly longer than a name with the names in it, as a + √Δ: written out again.

        And the other name where two are the same multiplied out.
        """
        short: dict[str, Expression] = {}
        same: dict[frozenset[tuple[Monomial, Fraction]], str] = {}
        for name in [*self._chosen]:
            node: Expression = substituted(self._chosen[name], short)
            if operation_count(node) > _HARDLY or isinstance(node, Call):
                terms = multiplied_out(self._whole(node))
                known = name if terms is None else same.setdefault(frozenset(terms.items()), name)
                if known == name:
                    continue
                node = Name(known)
            short = {n: substituted(x, {name: node}) for n, x in short.items()} | {name: node}
            del self._chosen[name]
        self._chosen = {name: substituted(node, short) for name, node in self._chosen.items()}
        self._trees = [substituted(tree, short) for tree in self._trees]
        return short

    def _whole(self, node: Expression) -> Expression:
        """What is named, without names."""
        inner = {part.name for part in walk(node) if isinstance(part, Name)} & {*self._wholes}
        return substituted(node, {n: self._whole(self._wholes[n]) for n in inner})

    def _ordered(self) -> Iterator[tuple[str, Expression]]:
        """The names as they occur in the formulas, each after those that it uses."""
        done: set[str] = set()

        def listed(node: Expression) -> Iterator[tuple[str, Expression]]:
            for part in walk(node):
                name = part.name if isinstance(part, Name) else ""
                if name in self._chosen and name not in done:
                    done.add(name)
                    yield from listed(self._chosen[name])
                    yield name, self._chosen[name]

        for tree in self._trees:
            yield from listed(tree)


def _is_worth(part: Expression, count: int, below: bool) -> bool:
    if isinstance(part, Call):
        return count >= _CIRCULAR and bool(_circular_name(part))
    size = operation_count(part)
    return (below and size > 2) or size >= _WORTH or (count >= _OFTEN and 3 * size > 2 * _WORTH)


def _with_part_named(node: Sum, label: str, whole: Expression) -> Expression:
    """Δ + a √Δ for b² − 4 c + a √Δ, where Δ is b² − 4 c."""
    if not isinstance(whole, Sum) or len(whole.terms) >= len(node.terms):
        return node
    for named, terms in (
        (Name(label), whole.terms),
        (Negative(Name(label)), tuple(map(opposite, whole.terms))),
    ):
        places = [node.terms.index(term) for term in terms if term in node.terms]
        if len({*places}) == len(terms):
            kept = [
                named if k == min(places) else t
                for k, t in enumerate(node.terms)
                if k == min(places) or k not in places
            ]
            return Sum((*kept,))
    return node


def _circular_name(node: Expression) -> str:
    """s12 of sin(θ1 − θ2), c12 of cos(θ1 − θ2)."""
    match node:
        case Call(
            function="sin" | "cos" as function,
            arguments=(Sum(terms=(Name(name=a, primes=0), Negative(operand=Name(name=b)))),),
        ):
            one, other = a.rstrip("0123456789"), b.rstrip("0123456789")
            if one == other and one != a and other != b:
                return function[0] + a[len(one) :] + b[len(other) :]
    return ""


def _sums_below(node: Expression) -> Iterator[Expression]:
    """The sums among the factors of denominators."""
    for part in walk(node):
        if isinstance(part, Quotient):
            factors = (
                part.denominator.factors
                if isinstance(part.denominator, Product)
                else (part.denominator,)
            )
            for factor in factors:
                base = factor.base if isinstance(factor, Power) else factor
                if isinstance(base, Sum):
                    yield base


def _with_sign_before(node: Expression) -> Expression:
    """The formula with the sign of a part that was named with the other one before it."""
    match node:
        case Negative(operand=Negative(operand=inner)):
            return inner
        case Product(factors=factors) if any(map(all_negative, factors)):
            bare = Product(tuple(map(without_minus, factors)))
            return Negative(bare) if sum(map(all_negative, factors)) % 2 else bare
        case Quotient(numerator=above, denominator=below) if all_negative(above):
            return opposite(_with_sign_before(Quotient(without_minus(above), below)))
        case Quotient(numerator=above, denominator=below) if all_negative(below):
            return Negative(Quotient(above, without_minus(below)))
        case Power(base=Negative(operand=base), exponent=exponent) if parity(exponent) is not None:
            power = Power(base, exponent)
            return Negative(power) if parity(exponent) else power
        case Call(function=function, arguments=(Negative(operand=inner),)) if function in EVEN:
            return Call(function, (inner,))
        case Call(function=function, arguments=(Negative(operand=inner),)) if function in ODD:
            return Negative(Call(function, (inner,)))
        case Sum(terms=terms):
            return Sum(tuple(positive_first(terms)))
        case _:
            return node


# -- written out again ------------------------------------------------------------------------


def written_out(answers: Answers) -> Answers:
    """The answers without abbreviations; with them and a warning where that would fill books."""
    if not answers.where:
        return answers
    sizes: dict[str, int] = {}
    for name, node in answers.where.items():
        sizes[name] = _size(node, sizes)
    total = sum(_size(tree, sizes) for s in answers.sections.values() for tree in expressions_in(s))
    if total > MOST_OPERATIONS:
        sentence = f"written out, the formulas would show {total:,} operations: abbreviated"
        return replace(answers, warnings=(*answers.warnings, sentence))
    whole: dict[str, Expression] = {}
    for name, node in answers.where.items():
        whole[name] = substituted(node, whole)
    sections = substituted(answers.sections, whole)
    return replace(answers, sections=sections, where={})


def _size(node: Expression, sizes: Mapping[str, int]) -> int:
    """The operations of a formula that is written out."""
    return sum(
        sizes.get(part.name, 0) if isinstance(part, Name) else max(len(children(part)) - 1, 1)
        for part in postorder(node)
    )
