"""The steps that are told when asked for: rest, small oscillations, reduction, questions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import cast

from sympy import Expr

from lagcli.algebra import is_zero
from lagcli.answers import EquilibriaSection, ModesSection, ReductionSection, Section
from lagcli.document import Block, Equations, Heading, Label, Matrix, Row
from lagcli.explanation import Step
from lagcli.expression import ZERO, Expression, Name, Number, Power, Product
from lagcli.mechanics.explaining import phase_space, quantities, symmetries
from lagcli.mechanics.explaining.questions import questions
from lagcli.mechanics.explaining.real_forces import real_forces
from lagcli.mechanics.explaining.teller import Teller
from lagcli.mechanics.explaining.transformations import transformations
from lagcli.mechanics.explaining.words import Part, names, says, shows
from lagcli.mechanics.statements import Statements
from lagcli.mechanics.stating import Stating
from lagcli.wording import POTENTIAL, place_rows, stability
from lagcli.wording import conditions as inequalities

Others = Mapping[str, Callable[[Stating], Section]]

_SQUARE = Number(Fraction(2))


def further(teller: Teller, also: Sequence[str], others: Others) -> tuple[list[Step], list[str]]:
    """The steps of these sections, and what was not found on the way.

    `others` makes sections that are none of mechanics.
    """
    statements = Statements(teller.derivation)
    statements.others.update({name: partial(make, statements) for name, make in others.items()})
    told = []
    for name in also:
        title, tell = _TOLD[name]
        section = statements.answers([name]).sections[name]
        told.append(Step(title, tuple(tell(teller, section))))
    return told, list(dict.fromkeys(statements.warnings))


# -- rest ----------------------------------------------------------------------------------------


def _rest(teller: Teller, section: Section) -> Iterator[Block]:
    from lagcli.mechanics.oscillations.equilibria import RestPoints

    states = cast(EquilibriaSection, section)
    found = states.equilibria
    rest = RestPoints(teller.dynamics)
    constrained = bool(teller.dynamics.constraints.equations)
    yield says(
        "At rest all velocities and accelerations are 0. What is left of Lagrange's equations is "
        "that the forces balance"
        + (", along every displacement that the constraints allow" if constrained else "")
        + ". These must vanish:"
    )
    conditions = [teller.readable.as_written(e) for e in rest.equations]
    yield Equations(tuple(Row(ZERO, condition) for condition in conditions))
    if found is None:
        yield says(f"They were not solved: {states.reason}.")
        return
    if not found:
        yield says("They have no solution: there is no state of rest.")
    for number, each in enumerate(found, 1):
        yield Heading(f"State of rest {number}", 2)
        yield _state(each.at, each.on)
        if each.free:
            yield says(names(each.free), " is free." if len(each.free) == 1 else " are free.")
        if each.where:
            yield says("It exists where ", *inequalities(each.where), ".")
        yield says(stability(each.verdict, each.free, each.on))
    if not states.complete:
        yield says("There may be others.")


def _state(
    at: Mapping[str, Expression], on: tuple[Expression, Expression] | None = None
) -> Equations:
    return Equations(place_rows(at, on))


def _oscillations(teller: Teller, section: Section) -> Iterator[Block]:
    from lagcli.mechanics.oscillations.small_oscillations import SmallOscillations

    known = cast(ModesSection, section)
    found = known.modes
    if not found:
        yield says(f"There is none to be told of: {known.reason}.")
        return
    oscillations = SmallOscillations(teller.dynamics)
    for at, on in {
        (tuple(mode.at.items()), mode.on): (mode.at, mode.on) for mode in found
    }.values():
        places = [
            p
            for p in oscillations.places or ()
            if (oscillations.equilibrium(p).at, oscillations.equilibrium(p).on) == (at, on)
        ]
        yield says("To first order in the displacements from the state of rest")
        yield _state(at, on)
        yield from _linear(teller, *places[0].matrices)
        for mode in found:
            if (mode.at, mode.on) != (at, on):
                continue
            square = Power(Name("omega"), _SQUARE)
            value = mode.frequency if mode.frequency is not None else mode.frequency_squared
            if value is not None:
                left: Expression = Name("omega") if mode.frequency is not None else square
                yield shows(left, value)
            shapes = [] if mode.shape is None else [mode.shape, *mode.more_shapes]
            for number, shape in enumerate(shapes if len(mode.shape or ()) > 1 else ()):
                yield says(
                    "and, as the frequency is a multiple root, independently of these"
                    if number
                    else "Then the displacements are in the ratio"
                )
                yield Equations(tuple(Row(Label("a", (q,)), part) for q, part in shape.items()))


def _linear(
    teller: Teller,
    mass: Sequence[Sequence[Expr]],
    velocity: Sequence[Sequence[Expr]],
    stiffness: Sequence[Sequence[Expr]],
) -> Iterator[Block]:
    """M x'' + C x' + K x = 0, and the condition for a frequency."""
    moving = any(is_zero(entry) is not True for row in velocity for entry in row)
    M, C, K = (Label(letter, matrix=True) for letter in "MCK")
    parts: list[Part] = ["the equations of motion are ", M, " · accelerations + "]
    parts += [C, " · velocities + "] if moving else []
    yield says(*parts, K, " · displacements = 0 with")
    tags = tuple(str(n) for n in range(1, len(mass) + 1))
    for letter, entries in (("M", mass), ("C", velocity), ("K", stiffness)):
        if letter == "C" and not moving:
            continue
        trees = tuple(tuple(map(teller.readable.as_written, row)) for row in entries)
        if len(trees) == 1:
            yield shows(Label(letter, matrix=True), trees[0][0])
        else:
            yield Matrix(Label(letter, matrix=True), trees, tags, tags)
    if teller.dynamics.constraints.equations:
        yield says("taken along the displacements that the constraints allow.")
    omega, s = Name("omega"), Name("s")
    form: list[Part] = [K, " − ", Power(omega, _SQUARE), " ", M]
    if moving:
        form = [K, " + ", s, " ", C, " + ", Power(s, _SQUARE), " ", M, " with ", s, " = i ", omega]
    yield says(
        "An oscillation with the angular frequency ",
        omega,
        " needs the determinant of ",
        form,
        " to vanish. So",
    )


# -- reduction -----------------------------------------------------------------------------------


def _reduction(teller: Teller, section: Section) -> Iterator[Block]:
    reduced = cast(ReductionSection, section)
    letters = teller.letters
    R = letters.free("R")
    cyclic = list(reduced.momenta)
    if cyclic:
        one = len(cyclic) == 1
        yield says(names(cyclic), " is cyclic. Constant is" if one else " are cyclic. Constant are")
        yield Equations(
            tuple(Row(Name(f"p_{name}"), value) for name, value in reduced.momenta.items())
        )
    else:
        yield says("No coordinate is cyclic, so there is nothing to take out.")
    if reduced.routhian is None:
        yield says(f"The reduction was not found: {reduced.reason}.")
        return
    if reduced.reconstruction:
        yield says("Solved for the velocities, as if the momenta were given:")
        yield Equations(
            tuple(Row(Name(name, 1), value) for name, value in reduced.reconstruction.items())
        )
        momentum = Product((Name(f"p_{cyclic[0]}"), Name(cyclic[0], 1)))
        what: list[Part] = (
            [momentum] if len(cyclic) == 1 else ["the sum of ", momentum, " and its like"]
        )
        yield says(
            letters.L,
            " less ",
            what,
            ", with these put in, is the Routhian, the Lagrangian of the other coordinates:",
        )
        yield shows(R, reduced.routhian)
    if reduced.effective_potential is not None:
        yield says(
            "What it has without velocities is the effective potential, with its sign turned:"
        )
        yield shows(POTENTIAL, reduced.effective_potential)
    if reduced.equations:
        yield says("Lagrange's equations with it:")
        yield Equations(tuple(Row(each.left, each.right) for each in reduced.equations))
    yield from _one_freedom(reduced)


def _one_freedom(reduced: ReductionSection) -> Iterator[Block]:
    motion = reduced.one_freedom
    if motion is None:
        return
    q, E = Name(motion.coordinate), Name(motion.constant)
    yield says("One coordinate is left, ", q, ", and its energy is conserved:")
    yield shows(E, motion.energy)
    yield says("It turns where its velocity is 0, ", POTENTIAL, " = ", E, ":"
               if motion.turning_points else ".")  # fmt: skip
    if motion.turning_points:
        yield Equations(tuple(Row(q, root) for root in motion.turning_points))
    for each in motion.periods:
        if each.at:
            yield says("Between turning points on both sides of the minimum of ", POTENTIAL, " at")
            yield _state(each.at)
        elif each.root_of is not None:
            yield says("About the minimum of ", POTENTIAL, ", where this vanishes,")
            yield shows(ZERO, each.root_of)
        words: list[Part] = []
        if each.amplitude:
            a = Name(each.amplitude)
            words = [", with half their distance ", a, " and up to higher powers of ", a]
        elif each.order:
            words = [f", the same for all amplitudes up to their power {each.order}"]
        if each.root_of is not None:
            yield says("the period of small oscillations is")
        else:
            words = words or [", for small oscillations"]
            yield says("the period is twice the time from one to the other", *words, ":")
        yield shows(Label("T", ("period",)), each.period)


_TOLD: Mapping[str, tuple[str, Callable[[Teller, Section], Iterator[Block]]]] = {
    "find": ("The questions", questions),
    "equilibria": ("States of rest", _rest),
    "modes": ("Small oscillations", _oscillations),
    "reduction": ("The reduction", _reduction),
    "steady_motions": ("Steady motions", phase_space.steady),
    "canonical_equations": ("The canonical equations", phase_space.canonical_equations),
    "brackets": ("Poisson brackets", phase_space.brackets),
    "canonical": ("Canonical transformations", transformations),
    "hamilton_jacobi": ("The equation of Hamilton and Jacobi", phase_space.hamilton_jacobi),
    "discovered": ("Symmetries that nobody asked about", symmetries.discovered),
    "algebra": ("The algebra of the charges", symmetries.algebra),
    "forces": ("The real forces", real_forces),
    "model": ("The model of a numerical run", quantities.model),
    "dimensions": ("The units", quantities.dimensions),
}
