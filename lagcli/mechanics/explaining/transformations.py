"""The step on canonical transformations: brackets, generating function, new Hamiltonian."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from sympy import Expr, Symbol

from lagcli.algebra import shape
from lagcli.document import Block, Bracket, Equations, Formula, Heading, Label, Row, equations_of
from lagcli.expression import Diff, Expression, Name, Negative, Number, Product, walk
from lagcli.mechanics.canonical.transformation import CanonicalTest
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import says, shows
from lagcli.notation.letters import own
from lagcli.statements.answers import Section
from lagcli.statements.phase_space import ExaminedTransformation, TransformationsSection

_CHECKED = {
    "exact": "exactly",
    "50 digits": "at random states to 50 digits",
    None: "",
}
#: What F1 to F4 depend on, and which of the others its derivatives give with which sign.
_VARIABLES = {
    "F1": "the old and the new coordinates",
    "F2": "the old coordinates and the new momenta",
    "F3": "the old momenta and the new coordinates",
    "F4": "the old and the new momenta",
}
_LAWS = {
    "F1": "Its derivatives with respect to the old coordinates are the old momenta, those with "
    "respect to the new coordinates are minus the new momenta",
    "F2": "Its derivatives with respect to the old coordinates are the old momenta, those with "
    "respect to the new momenta are the new coordinates",
    "F3": "Its derivatives with respect to the old momenta are minus the old coordinates, "
    "those with "
    "respect to the new coordinates are minus the new momenta",
    "F4": "Its derivatives with respect to the old momenta are minus the old coordinates, "
    "those with "
    "respect to the new momenta are the new coordinates",
}


def transformations(explainer: Explainer, section: Section) -> Iterator[Block]:
    """Each transformation of the file: is it canonical, what generates it, what is K."""
    found = cast(TransformationsSection, section).transformations
    if not found:
        yield says("The file gives no transformation of phase space.")
        return
    yield says(
        "A transformation is canonical when the Poisson brackets of the new variables are "
        "those of the "
        "old ones: 1 between a coordinate and its own momentum, 0 between all others. Then "
        "Hamilton's "
        "equations keep their form for every Hamiltonian."
    )
    given = {each.name: each for each in explainer.derivation.given.canonical_transformations}
    system = explainer.derivation.hamiltonian.system
    for each in found:
        yield Heading(each.name, 2)
        yield from _transformation(CanonicalTest(system, given[each.name]), each)


def _transformation(test: CanonicalTest, each: ExaminedTransformation) -> Iterator[Block]:
    yield says("The new variables are")
    yield equations_of((Name(name), f) for name, f in each.variables.items())
    yield from _brackets(test, each)
    if each.kind is None:
        yield says("Whether it is canonical was not decided.")
        return
    if each.generator is not None and each.generator.kind == "F":
        yield says("So the sum of p dq minus the sum of P dQ, ",
                   *_scaled(each), "at constant time, is the total differential of")  # fmt: skip
        yield shows(Label("F"), each.generator.function)
    elif each.generator is not None:
        yield from _given_function(test, each)
    if each.kind != "not canonical":
        yield from _new_hamiltonian(test, each)


def _scaled(each: ExaminedTransformation) -> list[str | Formula]:
    """The first sum stands times the valence."""
    if each.kind != "extended canonical" or each.valence is None:
        return []
    return ["the first times ", each.valence, ", "]


def _brackets(test: CanonicalTest, each: ExaminedTransformation) -> Iterator[Block]:
    """The derivatives where there are only four, then the brackets."""
    old, names = test.old, [s.name for s in test.new]
    n = len(names) // 2
    if n == 1:
        yield says("Their derivatives with respect to the old ones are")
        yield equations_of(
            (Diff(Name(name), Name(by.name)), _written(test, f.diff(by)))
            for name, f in zip(names, test.functions, strict=True)
            for by in old
        )
        yield says("so the first times the last minus the second times the third is")
    else:
        yield says("Their Poisson brackets in the old variables are")
    failing = {(f.left, f.right): f for f in each.failing}
    rows = []
    for i, j, value in test.brackets:
        pair = names[i], names[j]
        wrong = failing.get(pair)
        if wrong is not None:
            rows.append(Row(Bracket(*map(Name, pair)), wrong.value, _should(wrong.expected)))
        elif j == i + n:
            right = each.valence if each.valence is not None else _written(test, value)
            rows.append(Row(Bracket(*map(Name, pair)), right))
    yield Equations(tuple(rows))
    others = "" if n == 1 else " All others are 0." if not failing else " The others are right."
    how = f" It was checked {_CHECKED[each.verified]}." if each.verified else ""
    if each.kind == "canonical":
        yield says(f"as required.{others} The transformation is canonical.{how}")
    elif each.kind == "extended canonical":
        assert each.valence is not None
        pairs = "" if n == 1 else f", and the same for every pair.{others} It is"
        but = "in general" if each.in_general else "but"
        yield says(f"This is a constant, {but} not 1{pairs or ','} the valence of the "
                   "transformation: Hamilton's equations keep their form with the Hamiltonian "
                   f"multiplied by the valence (extended canonical).{how}")  # fmt: skip
    elif each.kind == "not canonical":
        so = "So in general" if each.in_general else "So"
        yield says(f"{others} {so} the transformation is not canonical.".lstrip())


def _should(expected: Expression) -> str:
    """The value that the bracket should have, as a note."""
    if isinstance(expected, Number) and expected.value.denominator == 1:
        return f"should be {expected.value.numerator}"
    return "should be that of the first pair"


def _given_function(test: CanonicalTest, each: ExaminedTransformation) -> Iterator[Block]:
    """The function of the file, its derivatives, and whether they agree."""
    generator = each.generator
    F = test.generating
    assert generator is not None
    assert F is not None
    scaled = each.kind == "extended canonical"
    label = Label("F", (generator.kind[1],))
    yield says("The file gives a generating function of ", _VARIABLES[generator.kind], ":")
    yield shows(label, generator.function)
    yield says(_LAWS[generator.kind], ", the old ones times the valence:" if scaled else ":")
    yield Equations(tuple(_derivatives(test, each)))
    if generator.generates:
        yield says("With the new variables substituted, each of these is an identity in the "
                   "old ones: ",
                   label, " generates the transformation.")  # fmt: skip
    elif generator.generates is None:
        yield says("Whether these hold with the new variables substituted was not decided.")
    else:
        yield says("With the new variables substituted, these should be equal and are not:")
        yield equations_of((left, right) for left, right in generator.failing)
        yield says("So ", label, " does not generate the transformation.")


def _derivatives(test: CanonicalTest, each: ExaminedTransformation) -> Iterator[Row]:
    F, kind = test.generating, test.given.kind
    assert F is not None
    q, p = test.system.q, test.system.momenta
    pairs: list[tuple[tuple[Symbol, ...], tuple[Symbol, ...], int, bool]] = {
        "F1": [(p, q, 1, True), (test.P, test.Q, -1, False)],
        "F2": [(p, q, 1, True), (test.Q, test.P, 1, False)],
        "F3": [(q, p, -1, True), (test.P, test.Q, -1, False)],
        "F4": [(q, p, -1, True), (test.Q, test.P, 1, False)],
    }[kind]
    for lefts, variables, sign, old in pairs:
        for left, variable in zip(lefts, variables, strict=True):
            name: Expression = Name(left.name)
            if old and each.kind == "extended canonical" and each.valence is not None:
                name = Product((each.valence, name))
            yield Row(name, _written(test, sign * F.diff(variable)))


def _new_hamiltonian(test: CanonicalTest, each: ExaminedTransformation) -> Iterator[Block]:
    K = Label("K")
    if each.hamiltonian is None:
        yield says(f"The Hamiltonian in the new variables was not found: {each.reason}.")
        return
    scale: list[str | Formula] = []
    if each.kind == "extended canonical" and each.valence is not None:
        scale = [" times ", each.valence]
    given = [*test.functions, *(() if test.generating is None else (test.generating,))]
    timed = any(f.has(test.system.t) for f in given)
    yield says("The transformation, solved for the old variables, is substituted into ", Label("H"),
               *scale, *(_explicit(each) if timed else ()),
               f". That is the new Hamiltonian{each.branch},")  # fmt: skip
    yield shows(K, each.hamiltonian)
    left, new = _names(each.hamiltonian), (*test.Q, *test.P)
    if timed and "t" not in left and not left.isdisjoint(name.name for name in new):
        yield says("It does not depend on t explicitly, so ", K, " is constant.")
    for name, partner in zip(new, (*test.P, *test.Q), strict=True):
        if name.name not in left:
            yield says(Name(name.name), " does not occur in it, so ", Name(partner.name),
                       " is constant.")  # fmt: skip


def _explicit(each: ExaminedTransformation) -> tuple[str | Formula, ...]:
    """What is added where the transformation depends on the time."""
    if each.generator is not None and each.generator.kind != "F":
        return (", plus the partial derivative of ", Label("F", (each.generator.kind[1],)),
                " with respect to t")  # fmt: skip
    P, Q, t = own("P"), own("Q"), Name("t")
    return (
        *(", plus a function of ", P, ", ", Q, " and t, determined up to a function of t, whose "),
        *("derivatives with respect to ", P, " and ", Q, " are "),
        *(Diff(Q, t), " and ", Negative(Diff(P, t)), " at constant q and p"),
    )


def _names(tree: Expression) -> set[str]:
    return {node.name for node in walk(tree) if isinstance(node, Name)}


def _written(test: CanonicalTest, expression: Expr) -> Expression:
    return shape(expression, (*test.system.order, *(s.name for s in test.new)))
