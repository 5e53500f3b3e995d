"""The steps on phase space: Hamilton's equations, Poisson brackets, the separation."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from lagcli.algebra.build import free_of
from lagcli.algebra.vanishing_factors import squares_divided_by
from lagcli.document import Block, Bracket, Equations, Integral, Label, Row, equations_of
from lagcli.expression import ZERO, Call, Diff, Expression, Name, Negative, Product, walk
from lagcli.mechanics.conditions import conditions as conditions_of
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, difference, names, says, shows
from lagcli.mechanics.hamiltonian_form import hamiltonian_form
from lagcli.mechanics.reduction.separation import ON_TIME
from lagcli.notation.letters import own
from lagcli.statements.answers import CanonicalSection, Section
from lagcli.statements.motions import HamiltonJacobiSection
from lagcli.statements.phase_space import BracketsSection
from lagcli.statements.wording import conditions, enumerated, fold, used_to_eliminate


def canonical_equations(explainer: Explainer, section: Section) -> Iterator[Block]:
    """The Legendre transform, and Hamilton's equations."""
    found = cast(CanonicalSection, section)
    derivation = explainer.derivation
    yield says(
        "The momenta are the derivatives of ",
        explainer.letters.L,
        " with respect to the velocities:",
    )
    momenta = explainer.dynamics.lagrange.momenta
    yield equations_of(
        (Name(f"p_{name}"), explainer.readable.linear(p))
        for name, p in zip(explainer.system.names, momenta, strict=True)
    )
    H = explainer.letters.free("H")
    function = derivation.hamiltonian.function
    if function is None or found.equations is None:
        none = explainer.dynamics.degenerate or found.fold is not None
        lead = "There is no Hamiltonian" if none else "The Hamiltonian was not found"
        yield says(f"{lead}: {found.reason or derivation.hamiltonian.reason}.")
        yield from fold(found.fold)
        return
    yield says(
        "Solved for the velocities, and substituted into the sum of momentum times velocity minus ",
        explainer.letters.L,
        ", they give",
    )
    yield shows(H, _hamiltonian(explainer) or explainer.readable.as_written(function))
    system = explainer.system
    moving = (system.t, *system.q, *system.momenta)
    divisors = [d for d in squares_divided_by([function]) if free_of(d, moving)]
    if regular := conditions_of(divisors, system.order):
        yield says("for ", *conditions(regular), ".")
    below = derivation.hamiltonian.folds_below
    if below is not None:
        yield says("Where ", explainer.readable.as_written(below), " < 0, the Legendre "
                   "transform has several branches: the momenta do not determine "
                   "the velocities.")  # fmt: skip
    yield says("The velocities are its derivatives with respect to the momenta,")
    yield equations_of((Name(q, 1), pair.q) for q, pair in found.equations.items())
    yield says(*_momentum_rates(explainer))
    yield equations_of((Name(f"p_{q}", 1), pair.p) for q, pair in found.equations.items())


def _hamiltonian(explainer: Explainer) -> Expression | None:
    """H as in the answers and in the Hamilton-Jacobi equation; None where that is too long."""
    try:
        return hamiltonian_form(explainer.derivation.hamiltonian, explainer.readable)
    except ArithmeticError:
        return None


def _momentum_rates(explainer: Explainer) -> list[Part]:
    """-dH/dq + Q - dD/dq' + lambda a."""
    more = ["the applied forces"] * explainer.forced
    more += ["the dissipative forces"] * explainer.damped
    more += [explainer.constraint_forces] * bool(explainer.constraints)
    added = f", plus {enumerated(more)}" if more else ""
    lead = "and the rates of the momenta are minus those with respect to the coordinates"
    return [f"{lead}{added}:"]


def brackets(explainer: Explainer, section: Section) -> Iterator[Block]:
    """{A, B} = sum of dA/dq dB/dp - dA/dp dB/dq."""
    found = cast(BracketsSection, section)
    A, B = map(own, explainer.letters.pair)
    q, p = own("q_j"), own("p_j")
    first, second = Product((Diff(A, q), Diff(B, p))), Product((Diff(A, p), Diff(B, q)))
    yield says(
        "The Poisson bracket ", Bracket(A, B), " is the sum of ", difference(first, second),
        " over all coordinates, so that a coordinate and its momentum have the bracket 1.",
    )  # fmt: skip
    if not found.brackets and not found.reason:
        yield says("The file names no two functions.")
    if found.observables:
        yield equations_of((Name(name), value) for name, value in found.observables.items())
    if found.reason:
        yield says(f"Not found: {found.reason}.")
    rows = []
    for each in found.brackets:
        value = each.named if each.named is not None else each.value
        if value is not None:
            rows.append(Row(Bracket(each.left, each.right), value))
    if rows:
        given = explainer.problem.observables or explainer.problem.brackets
        of = "functions" if given else "Q of the transformations"
        yield says(f"For the {of} of the file")
        yield Equations(tuple(rows))
        yield from _beside(explainer)
    if found.rates:
        yield says(
            "The rates on the motion are the brackets with H plus the partial "
            "derivatives with "
            "respect to t:"
        )
        yield equations_of((Name(name, 1), rate) for name, rate in found.rates.items())


def _beside(explainer: Explainer) -> Iterator[Block]:
    """That Poisson's theorem on two constants is about the motion by H alone."""
    constrained = bool(explainer.problem.constraints)
    forced = any(force != 0 for force in explainer.system.applied_forces)
    act = "Forces of constraints" * constrained + " and others" * (constrained and forced)
    act = act or "Forces" * forced
    if act:
        yield says(
            f"{act} that are not in H act, so the bracket of two constants of the motion need not "
            "be constant (Poisson's theorem is about the motion by H alone)."
        )


def hamilton_jacobi(explainer: Explainer, section: Section) -> Iterator[Block]:
    """From H(q, dS/dq) = E to the parts of S, coordinate by coordinate."""
    found = cast(HamiltonJacobiSection, section)
    if found.hamiltonian is None and found.reason == ON_TIME:
        S, t = Label("S"), Name("t")
        yield says("The sum of H and the derivative of ", S, " with respect to ", t, " is 0, where "
                   "each momentum in H is the derivative of ", S, " with respect to its "
                   f"coordinate. This equation was not solved: {found.reason}.")  # fmt: skip
        return
    if found.hamiltonian is None:
        yield says(f"The equation was not set up: {found.reason}.")
        return
    if found.time_rate is not None and not found.constants:
        yield says("The constraints leave no coordinate, so there is nothing to separate.")
        return
    left = {node.name for node in walk(found.hamiltonian) if isinstance(node, Name)}
    gone = [
        n for n in explainer.system.names if explainer.dynamics.constraints and f"p_{n}" not in left
    ]
    if gone:
        momenta = ", and the momenta are those of the Lagrangian that is left."
        yield says(*used_to_eliminate(gone), momenta)
    if found.time_rate is not None:
        yield from _by_forces_of_time(found, found.time_rate)
        return
    S, E, H, W = Label("S"), Name(found.energy), Label("H"), Label("W")
    yield says(
        *(
            "Each momentum in the Hamiltonian is the derivative of ",
            S,
            " with respect to its coordinate. ",
        ),
        *(H, " does not depend on t explicitly, so ", S, " = ", Negative(Product((E, Name("t"))))),
        *(" + ", W, ", where ", W, " satisfies"),
    )
    yield shows(E, found.hamiltonian)
    if found.obstacle:
        yield says(W, " is a sum of functions of one coordinate each only where Levi-Civita's "
                   "condition holds for every pair of coordinates. ",
                   "In general it" if found.in_general else "It", " fails for ",
                   names(found.obstacle), ": the equation does not separate in these.")  # fmt: skip
        return
    if found.derivatives is None:
        yield says(f"Its separation was not found: {found.reason}.")
        return
    if len(found.derivatives) > 1:
        yield says(
            *(
                "Levi-Civita's condition holds for every pair of coordinates, so ",
                W,
                " is a sum of ",
            ),
            "functions of one coordinate each. The terms that contain the same coordinate are "
            "constant together; the constants of separation are ",
            *(names(found.constants), "."),
        )
    if found.equations and (len(found.derivatives) > 1 or _has_root(found.hamiltonian)):
        if len(found.derivatives) == 1:
            yield says("or, without its root,")
        yield equations_of((ZERO, each) for each in found.equations.values())
    cyclic = [name for name in found.derivatives if name not in found.equations]
    if cyclic:
        yield says("A cyclic coordinate contributes its constant momentum times itself to ", W, ".")
    if found.equations:
        several = len(found.equations) > 1
        lead = "Each of these is solved for its" if several else "This is solved for the"
        yield says(f"{lead} momentum, with a square root of either sign:")
    for name in found.equations:
        yield from _part(found, name)
    if found.energy not in found.constants:
        yield says("The derivatives of ", S, " with respect to the constants, of which ", E,
                   " is a function, are constant: this is the motion.")  # fmt: skip
        return
    if len(found.constants) == 1:
        yield says("The derivative of ", S, " with respect to ", E,
                   " is constant, which gives the motion in time.")  # fmt: skip
        return
    yield says(
        *("The derivatives of ", S, " with respect to the constants are constant: that with "),
        *("respect to ", E, " gives the motion in time, the others the path."),
    )


def _has_root(hamiltonian: Expression) -> bool:
    """Whether momenta stand below a root, as in the relativistic one."""
    roots = (x for x in walk(hamiltonian) if isinstance(x, Call) and x.function == "sqrt")
    return any(isinstance(x, Name) and x.name.startswith("p_") for r in roots for x in walk(r))


def _by_forces_of_time(found: HamiltonJacobiSection, rate: Expression) -> Iterator[Block]:
    assert found.hamiltonian is not None
    assert found.derivatives is not None
    S, f, H = Label("S"), Label("f"), Label("H")
    yield says(
        *(
            "Each momentum in the Hamiltonian is the derivative of ",
            S,
            " with respect to its coordinate, ",
        ),
        *("and that with respect to t is ", Negative(own("H")), ", with"),
    )
    yield shows(H, found.hamiltonian)
    yield says(
        *(H, " is linear in the coordinates, with coefficients that depend on t alone. So is "),
        *(S, ", with the momenta as coefficients, plus a function ", f, " of t. "),
        "The terms with a coordinate give the rate of its momentum, which is the force along it. "
        "Integrated,",
    )
    rows = [Row(Name(f"p_{name}"), p) for name, p in found.derivatives.items()]
    rows += [Row(Name(name), Integral(force, "t")) for name, force in found.integrals.items()]
    yield Equations(tuple(rows))
    plural = "s" if len(found.constants) > 1 else ""
    yield says(
        f"with the constant{plural} ",
        *(names(found.constants), ". The terms without coordinates give"),
    )
    rows = [Row(f, Integral(rate, "t"))]
    rows += [] if found.of_time is None else [Row(f, found.of_time)]
    yield Equations(tuple(rows))
    yield says("The derivatives of ", S, " with respect to the constants are constant: this is the "
               "motion.")  # fmt: skip


def _part(found: HamiltonJacobiSection, name: str) -> Iterator[Block]:
    assert found.derivatives is not None
    W = Label("W", (name,))
    rows = [Row(W, Integral(found.derivatives[name], name))]
    value: Expression | None = found.functions.get(name)
    if value is not None:
        rows.append(Row(W, value))
    yield Equations(tuple(rows))
    for each in found.cases.get(name, ()):
        where: list[Part] = conditions(each.where)
        yield says("For ", where, ",")
        yield shows(W, each.function)
