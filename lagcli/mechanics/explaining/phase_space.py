"""The steps on steady motions and on phase space: what is asked once the equations are known."""

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
from lagcli.expression import ZERO, Expression, Name, Negative, Number, Power, Product
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.words import Part, listed, names, says, shows
from lagcli.motions import HamiltonJacobiSection, SteadyMotion, SteadySection
from lagcli.phase_space import BracketsSection
from lagcli.wording import POTENTIAL, conditions, place_rows, steady_stability

_SQUARED = Power(Name("omega"), Number(Fraction(2)))

# -- steady motions ------------------------------------------------------------------------------


def steady(_: Teller, section: Section) -> Iterator[Block]:
    """Where the other coordinates rest while the cyclic ones turn, and what a push does there."""
    found = cast(SteadySection, section)
    if found.eliminated:
        yield says(
            "The constraints give ",
            names(found.eliminated, 1),
            " by the other velocities. With these put in, the rates of the other velocities "
            "depend on few of the coordinates. In a steady motion these rest and the velocities "
            "are constant, so that their rates vanish:",
        )
        yield from _steady_states(found)
        return
    yield says(
        "In a steady motion the coordinates that are not cyclic rest, and the cyclic ones have "
        "constant velocities. In the Routhian's equations all velocities and accelerations are "
        "then 0, and what is left is that the derivatives of ",
        POTENTIAL,
        " vanish, with the momenta of the cyclic coordinates as constants:",
    )
    yield from _steady_states(found)


def _steady_states(found: SteadySection) -> Iterator[Block]:
    wanted = dict.fromkeys(found.conditions.values())
    yield Equations(tuple(Row(ZERO, each) for each in wanted if each != ZERO or len(wanted) == 1))
    if found.motions is None:
        yield says(f"They were not solved: {found.reason}.")
        return
    if not found.motions:
        yield says("They have no solution: there is no steady motion.")
    for number, motion in enumerate(found.motions, 1):
        yield Heading(f"Steady motion {number}", 2)
        yield from _motion(motion)
    if not found.complete:
        yield says("There may be others.")


def _motion(motion: SteadyMotion) -> Iterator[Block]:
    if motion.rolling:
        yield from _rolling(motion)
        return
    if motion.free:
        yield says("For any value of ", _free(motion), ",")
    if motion.at or motion.on is not None:
        yield Equations(place_rows(motion.at, motion.on))
    rates = {n: rate for n, rate in (motion.rates or {}).items() if rate != Name(n, 1)}
    if rates:
        yield says("The cyclic coordinates then turn with")
        yield Equations(tuple(Row(Name(name, 1), rate) for name, rate in rates.items()))
    momenta = {n: p for n, p in motion.momenta.items() if p != Name(f"p_{n}")}
    if momenta:
        yield says("and the momenta are" if rates else "The momenta are")
        yield Equations(tuple(Row(Name(f"p_{name}"), p) for name, p in momenta.items()))
    if motion.where:
        yield says("It is possible where ", conditions(motion.where), ".")
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
            "Linearised about it, the equations have as many roots 0 as there are neighbouring "
            "steady motions; the others have the squared frequency below."
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
        "Displaced a little, with the momenta unchanged, the coordinates obey to first order ",
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
    yield says("The momenta are the derivatives of ", teller.letters.L, " by the velocities:")
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
        "Solved for the velocities and put into the sum of momentum times velocity less ",
        teller.letters.L,
        ", they give",
    )
    yield shows(H, teller.readable.as_written(function))
    yield says("Its derivative by a momentum is the velocity,")
    yield Equations(tuple(Row(Name(q, 1), pair.q) for q, pair in found.equations.items()))
    yield says("and that by a coordinate, with its sign turned, the rate of the momentum:")
    yield Equations(tuple(Row(Name(f"p_{q}", 1), pair.p) for q, pair in found.equations.items()))


def brackets(_: Teller, section: Section) -> Iterator[Block]:
    """{A, B} = sum of dA/dq dB/dp - dA/dp dB/dq."""
    found = cast(BracketsSection, section)
    yield says(
        "The Poisson bracket of two functions is the sum, over the coordinates, of the derivative "
        "of the first by the coordinate times that of the second by its momentum, less the same "
        "with coordinate and momentum exchanged. That of a coordinate and its momentum is 1."
    )
    if not found.brackets and not found.reason:
        yield says("The file names no functions to take it of.")
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
        yield says("Put in, this gives")
        yield Equations(tuple(rows))
    if found.rates:
        yield says("The bracket with H and the derivative by t make the rate on the motion:")
        yield Equations(tuple(Row(Name(name, 1), rate) for name, rate in found.rates.items()))


def hamilton_jacobi(_: Teller, section: Section) -> Iterator[Block]:
    """From H(q, dS/dq) = E to the parts of S, one coordinate at a time."""
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
        *("In the Hamiltonian each momentum is the derivative of ", S, " by its coordinate. "),
        *(H, " does not contain the time, so ", S, " = ", Negative(Product((E, Name("t"))))),
        *(" + ", W, ", and ", W, " obeys"),
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
    yield says(
        *("Levi-Civita's condition holds for every pair of coordinates, so ", W, " is a sum of "),
        "functions of one coordinate each. What depends on one coordinate only is constant; "
        "the constants are ",
        *(names(found.constants), "."),
    )
    if found.equations:
        yield Equations(tuple(Row(ZERO, each) for each in found.equations.values()))
    cyclic = [name for name in found.derivatives if name not in found.equations]
    if cyclic:
        yield says("Of a cyclic coordinate ", W, " has the constant momentum times the coordinate.")
    if found.equations:
        yield says("Each of these is quadratic in its momentum. With the root of either sign")
    for name in found.equations:
        yield from _part(found, name)
    yield says("The derivatives of ", S, " by the constants are constant as well: by ", E,
               " this is the motion in time, by the others the path.")  # fmt: skip


def _by_forces_of_time(found: HamiltonJacobiSection, rate: Expression) -> Iterator[Block]:
    assert found.hamiltonian is not None
    assert found.derivatives is not None
    S, f, H = Label("S"), Label("f"), Label("H")
    yield says(
        *("In the Hamiltonian each momentum is the derivative of ", S, " by its coordinate, "),
        *("and the derivative of ", S, " by the time is ", Negative(Name("H")), ", with"),
    )
    yield shows(H, found.hamiltonian)
    yield says(
        *(H, " is linear in the coordinates, with factors that depend on the time alone: so is "),
        *(S, ", with the momenta as factors, and a function ", f, " of the time. "),
        "The terms with a coordinate give the rate of its momentum, which is the force on it. "
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
    yield says("The derivatives of ", S, " by the constants are constant as well: this is the "
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
        yield says("Where ", where, ",")
        yield shows(W, each.function)
