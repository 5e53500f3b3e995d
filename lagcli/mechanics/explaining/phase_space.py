"""The steps on steady motions and on phase space."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import cast

from lagcli.answers import CanonicalSection, Section
from lagcli.document import (
    Block,
    Bracket,
    Equations,
    Heading,
    Integral,
    Label,
    Matrix,
    Row,
)
from lagcli.expression import ZERO, Diff, Expression, Name, Negative, Number, Power, Product
from lagcli.mechanics.explaining.given_momenta import two_rates
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import Part, difference, listed, names, says, shows
from lagcli.motions import HamiltonJacobiSection, SteadyMotion, SteadySection
from lagcli.phase_space import BracketsSection
from lagcli.wording import POTENTIAL, conditions, place_rows, steady_stability

_SQUARED = Power(Name("omega"), Number(Fraction(2)))

_BALANCED = {
    (): "vanish",
    ("forces",): "balance the other forces",
    ("constraints",): "vanish along every displacement that the constraints allow",
    ("forces", "constraints"): "balance the other forces along every displacement that the "
    "constraints allow",
}

# -- steady motions ------------------------------------------------------------------------------


def steady(teller: Teller, section: Section) -> Iterator[Block]:
    """The relative equilibria: cyclic velocities constant, the other coordinates at rest."""
    found = cast(SteadySection, section)
    if found.eliminated:
        yield says(
            "The constraints give ",
            names(found.eliminated, 1),
            " in terms of the other velocities. With these substituted, the accelerations of the "
            "other coordinates depend on few of the coordinates. In a steady motion these few are "
            "constant and so are the velocities, and the accelerations vanish:",
        )
        yield from _steady_states(teller, found)
        return
    if found.motions and not any(motion.momenta for motion in found.motions):
        yield says(
            "No momentum of a cyclic coordinate is constant, so the steady motions "
            "are the equilibria:"
        )
        yield from _steady_states(teller, found)
        return
    yield says(
        "In a steady motion the coordinates that are not cyclic are constant, and the cyclic ones "
        "have constant velocities. All velocities and accelerations in the Routhian's "
        "equations are "
        "then 0, so the derivatives of ",
        POTENTIAL,
        f" {_BALANCED[found.acting]}, with the momenta of the cyclic coordinates as constants:",
    )
    yield from _steady_states(teller, found)


def _steady_states(teller: Teller, found: SteadySection) -> Iterator[Block]:
    wanted = dict.fromkeys(found.conditions.values())
    yield Equations(tuple(Row(ZERO, each) for each in wanted if each != ZERO or len(wanted) == 1))
    if found.motions is None:
        yield says(f"These were not solved: {found.reason}.")
        return
    if not found.motions:
        yield says("These have no solution: there is no steady motion.")
    for number, motion in enumerate(found.motions, 1):
        yield Heading(f"Steady motion {number}", 2)
        yield from _motion(teller, motion)
    if not found.complete:
        yield says("There may be others.")


def _motion(teller: Teller, motion: SteadyMotion) -> Iterator[Block]:
    if motion.rolling:
        yield from _rolling(motion)
        return
    if motion.free:
        yield says("For any value of ", _free(motion), ",")
    if motion.at or motion.on is not None:
        yield Equations(place_rows(motion.at, motion.on))
    rates = {n: rate for n, rate in (motion.rates or {}).items() if rate != Name(n, 1)}
    if rates:
        yield says("The velocities of the cyclic coordinates are then")
        yield Equations(tuple(Row(Name(name, 1), rate) for name, rate in rates.items()))
    momenta = {n: p for n, p in motion.momenta.items() if p != Name(f"p_{n}")}
    if momenta:
        yield says("and the momenta are" if rates else "The momenta are")
        yield Equations(tuple(Row(Name(f"p_{name}"), p) for name, p in momenta.items()))
        yield from two_rates(teller, motion)
    if motion.mirrored:
        yield says("The same holds with the opposite signs of all these.")
    if motion.where:
        yield says("It is possible for ", conditions(motion.where), ".")
    if motion.mass:
        yield from _displaced(motion)
    yield says(steady_stability(motion))


def _free(motion: SteadyMotion) -> list[Part]:
    return listed([Name(name.rstrip("'"), 1 if name.endswith("'") else 0) for name in motion.free])


def _rolling(motion: SteadyMotion) -> Iterator[Block]:
    if motion.free:
        yield says("This holds for any value of ", _free(motion), " with")
    places = [Row(Name(name), value) for name, value in motion.at.items()]
    rates = {n: rate for n, rate in (motion.rates or {}).items() if rate != Name(n, 1)}
    yield Equations((*places, *(Row(Name(name, 1), rate) for name, rate in rates.items())))
    if motion.frequencies_squared:
        yield says(
            "The linearised equations have the root 0, of the dimension of the family of steady "
            "motions; the other roots have the squared frequency below."
        )
    yield says(steady_stability(motion))
    if motion.frequencies_squared:
        yield Equations(tuple(Row(_SQUARED, s) for s in motion.frequencies_squared))


def _displaced(motion: SteadyMotion) -> Iterator[Block]:
    """M x'' + C x' + K x = 0 and the squares of the frequencies."""
    M, C, K = (Label(letter, matrix=True) for letter in "MCK")
    turning = any(entry != ZERO for row in motion.velocity for entry in row)
    velocities: list[Part] = [C, " · velocities + "] if turning else []
    yield says(
        "Small displacements at unchanged momenta obey to first order ",
        *(M, " · accelerations + ", *velocities, K, " · displacements = 0 with"),
    )
    tags = tuple(str(n) for n in range(1, len(motion.mass) + 1))
    for letter, entries in (("M", motion.mass), ("C", motion.velocity), ("K", motion.stiffness)):
        label = Label(letter, matrix=True)
        if any(entry != ZERO for row in entries for entry in row):
            yield (
                shows(label, entries[0][0])
                if len(entries) == 1
                else Matrix(label, entries, tags, tags)
            )
    squares = dict.fromkeys(motion.frequencies_squared)
    if squares:
        yield says("The squares of the frequencies are the roots of the determinant:")
        yield Equations(tuple(Row(_SQUARED, s) for s in squares))


# -- phase space ---------------------------------------------------------------------------------


def canonical_equations(teller: Teller, section: Section) -> Iterator[Block]:
    """The Legendre transform, and Hamilton's equations."""
    found = cast(CanonicalSection, section)
    derivation = teller.derivation
    yield says(
        "The momenta are the derivatives of ", teller.letters.L, " with respect to the velocities:"
    )
    momenta = teller.dynamics.lagrange.momenta
    yield Equations(
        tuple(
            Row(Name(f"p_{name}"), teller.readable.as_written(p))
            for name, p in zip(teller.system.names, momenta, strict=True)
        )
    )
    H = teller.letters.free("H")
    function = derivation.hamiltonian.function
    if function is None or found.equations is None:
        yield says(f"There is no Hamiltonian: {found.reason or derivation.hamiltonian.reason}.")
        return
    yield says(
        "Solved for the velocities, and substituted into the sum of momentum times velocity minus ",
        teller.letters.L,
        ", they give",
    )
    yield shows(H, teller.readable.as_written(function))
    yield says("The velocities are its derivatives with respect to the momenta,")
    yield Equations(tuple(Row(Name(q, 1), pair.q) for q, pair in found.equations.items()))
    yield says(*_momentum_rates(teller))
    yield Equations(tuple(Row(Name(f"p_{q}", 1), pair.p) for q, pair in found.equations.items()))


def _momentum_rates(teller: Teller) -> list[Part]:
    """-dH/dq + Q - dD/dq' + lambda a."""
    more = ["the applied forces"] * (teller.forced or teller.damped)
    more += ["the forces of the constraints"] * bool(teller.dynamics.constraints.equations)
    added = f", plus {' and '.join(more)}" if more else ""
    return [f"and the rates of the momenta minus those with respect to the coordinates{added}:"]


def brackets(_: Teller, section: Section) -> Iterator[Block]:
    """{A, B} = sum of dA/dq dB/dp - dA/dp dB/dq."""
    found = cast(BracketsSection, section)
    A, B, q, p = Name("A"), Name("B"), Name("q_j"), Name("p_j")
    first, second = Product((Diff(A, q), Diff(B, p))), Product((Diff(A, p), Diff(B, q)))
    yield says(
        "The Poisson bracket ", Bracket(A, B), " is the sum of ", difference(first, second),
        " over all coordinates, so that a coordinate and its momentum have the bracket 1.",
    )  # fmt: skip
    if not found.brackets and not found.reason:
        yield says("The file names no functions.")
    if found.observables:
        yield Equations(tuple(Row(Name(name), value) for name, value in found.observables.items()))
    if found.reason:
        yield says(f"Not found: {found.reason}.")
    rows = []
    for each in found.brackets:
        value = each.named if each.named is not None else each.value
        if value is not None:
            rows.append(Row(Bracket(each.left, each.right), value))
    if rows:
        yield says("For the functions of the file")
        yield Equations(tuple(rows))
    if found.rates:
        yield says(
            "The rates on the motion are the brackets with H plus the partial "
            "derivatives with "
            "respect to t:"
        )
        yield Equations(tuple(Row(Name(name, 1), rate) for name, rate in found.rates.items()))


def hamilton_jacobi(_: Teller, section: Section) -> Iterator[Block]:
    """From H(q, dS/dq) = E to the parts of S, coordinate by coordinate."""
    found = cast(HamiltonJacobiSection, section)
    if found.hamiltonian is None:
        yield says(f"The equation was not found: {found.reason}.")
        return
    S, E = Label("S"), Name(found.energy)
    if found.time_rate is not None:
        yield from _by_forces_of_time(found, found.time_rate)
        return
    H, W = Label("H"), Label("W")
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
                   "condition holds for every pair of coordinates. It fails for ",
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
            "functions of one coordinate each. The terms with one coordinate are constant; the "
            "constants of separation are ",
            *(names(found.constants), "."),
        )
    if found.equations:
        yield Equations(tuple(Row(ZERO, each) for each in found.equations.values()))
    cyclic = [name for name in found.derivatives if name not in found.equations]
    if cyclic:
        yield says("A cyclic coordinate contributes its constant momentum times itself to ", W, ".")
    if found.equations:
        each = "Each of these" if len(found.equations) > 1 else "This"
        yield says(f"{each} is solved for its momentum, with a square root of either sign:")
    for name in found.equations:
        yield from _part(found, name)
    if len(found.constants) == 1:
        yield says("The derivative of ", S, " with respect to ", E,
                   " is constant, which gives the motion in time.")  # fmt: skip
        return
    yield says(
        *("The derivatives of ", S, " with respect to the constants are constant: that with "),
        *("respect to ", E, " gives the motion in time, the others the path."),
    )


def _by_forces_of_time(found: HamiltonJacobiSection, rate: Expression) -> Iterator[Block]:
    assert found.hamiltonian is not None
    assert found.derivatives is not None
    if not found.constants:
        yield says("The constraints leave no coordinate, so there is nothing to separate.")
        return
    S, f, H = Label("S"), Label("f"), Label("H")
    yield says(
        *(
            "Each momentum in the Hamiltonian is the derivative of ",
            S,
            " with respect to its coordinate, ",
        ),
        *("and that with respect to t is ", Negative(Name("H")), ", with"),
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
