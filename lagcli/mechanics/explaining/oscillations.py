"""The step on small oscillations: the matrices, the determinant, frequencies and amplitudes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from typing import TYPE_CHECKING, cast

import sympy
from sympy import Expr, S, Symbol

from lagcli.algebra import is_zero, nullspace, shape, simplify
from lagcli.algebra.build import free_of
from lagcli.algebra.determinants import determinant
from lagcli.algebra.factors import factors_of
from lagcli.algebra.signs import sign
from lagcli.algebra.vanishing_factors import squares_divided_by
from lagcli.document import Block, Equations, Label, Paragraph, Row, equations_of, vanishing
from lagcli.expression import (
    ZERO,
    Call,
    Expression,
    Name,
    Number,
    Power,
    operation_count,
    power_of,
    product_of,
    sum_of,
)
from lagcli.mechanics.conditions import above
from lagcli.mechanics.conditions import conditions as above_zero
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, difference, displacements, says, shows
from lagcli.mechanics.rest.singular import AtPole
from lagcli.mechanics.stability.near import Near
from lagcli.statements.answers import ModesOfFrequency, ModesSection, Section
from lagcli.statements.plus_minus import modes_in_pairs
from lagcli.statements.wording import (
    conditions,
    in_any_direction,
    linear_equations,
    place_rows,
    real_and_positive,
)

if TYPE_CHECKING:
    from lagcli.mechanics.oscillations.small_oscillations import Place

_SQUARE = Number(Fraction(2))
#: A characteristic polynomial of more operations is not printed.
_LONG = 120
_KEPT = "; terms of higher order keep it near the equilibrium."


def oscillations(explainer: Explainer, section: Section) -> Iterator[Block]:
    """One equilibrium after another."""
    from lagcli.mechanics.oscillations.small_oscillations import SmallOscillations

    known = cast(ModesSection, section)
    found = known.modes
    if not found:
        lead = "They were not found" if found is None else "There are no normal modes"
        yield says(f"{lead}: {known.reason}.")
        yield from _forced(explainer)
        return
    small = SmallOscillations(explainer.dynamics)
    by_place = {(tuple(mode.at.items()), mode.on): (mode.at, mode.on) for mode in found}
    alike: dict[tuple[Block, ...], list[tuple[Row, ...]]] = {}
    for at, on in by_place.values():
        place = next(
            p
            for p in small.places or ()
            if (small.equilibrium(p).at, small.equilibrium(p).on) == (at, on)
        )
        here = [mode for mode in found if (mode.at, mode.on) == (at, on)]
        alike.setdefault(tuple(_near(explainer, place, here)), []).append(place_rows(at, on))
    for blocks, places in alike.items():
        for k, rows in enumerate(sorted(places, key=lambda each: not each)):
            lead = "and from" if k else "To first order in the displacements from"
            if rows:
                yield says(f"{lead} the equilibrium")
                yield Equations(rows)
            else:
                blocks = (says(f"{lead} rest ", cast(Paragraph, blocks[0]).parts), *blocks[1:])
        yield from blocks


def _forced(explainer: Explainer) -> Iterator[Block]:
    """One solution of linear equations with a drive, and its amplitude where that is one wave."""
    from lagcli.mechanics.oscillations.forced import amplitude, forced

    found = forced(explainer.derivation)
    if found is None:
        return
    order, t = explainer.system.order, explainer.system.t
    yield says("The equations of motion are linear, with terms that depend on the time alone. A "
               "solution, by undetermined coefficients, is")  # fmt: skip
    yield Equations(tuple(Row(Name(q.name), shape(x, order)) for q, x in found.items()))
    where = above_zero(squares_divided_by(found.values()), order, ())
    if where:
        yield says("for ", *conditions(where), ".")
    size = amplitude(list(found.values()), t)
    if size is not None:
        yield says("Its amplitude is")
        yield shows(explainer.letters.free("a"), shape(size, order))
    yield says("Every other motion differs from it by a solution of the equations without these "
               "terms.")  # fmt: skip


def _near(explainer: Explainer, place: Place, modes: Sequence[ModesOfFrequency]) -> Iterator[Block]:
    """The linear equations and their solutions."""
    yield from _linear(explainer, place)
    if place.characteristic.in_square is None:
        yield from _damped(explainer, modes, place)
    else:
        yield from _undamped(explainer, modes, place)


def _moving(velocity: Sequence[Sequence[Expr]]) -> bool:
    return any(is_zero(entry) is not True for row in velocity for entry in row)


def _linear(explainer: Explainer, place: Place) -> Iterator[Block]:
    """M x'' + C x' + K x = 0."""
    write = explainer.readable.as_written
    matrices = ([[write(e) for e in row] for row in matrix] for matrix in place.matrices)
    yield from linear_equations("the equations of motion are ", *matrices)
    near, entries = place.near, (e for m in place.matrices for row in m for e in row)
    where = above_zero(squares_divided_by(entries), near.system.order, place.point.positive)
    equations = [each.name for each in explainer.dynamics.constraints.equations]
    lost = [name for name in place.held.open if name in equations]
    names = near.system.names
    pole = (names[near.radius], names[near.around]) if isinstance(near, AtPole) else None
    contacts = {contact.name for contact in explainer.problem.contacts}
    closed = [name for name in place.held.touching if name in contacts]
    free = [q.name for q in near.independent]
    number = len(equations) - len(lost)
    yield from displacements(number, free, where, closed=closed, lost=lost, pole=pole)


# -- without damping -----------------------------------------------------------------------------


def _undamped(
    explainer: Explainer, modes: Sequence[ModesOfFrequency], place: Place
) -> Iterator[Block]:
    """det(K - omega^2 M) = 0, or det(K + s C + s^2 M) = 0 in s^2 = -omega^2 alone."""
    omega, s = explainer.letters.free("omega"), explainer.letters.free("s")
    M, C, K = (Label(letter, matrix=True) for letter in "MCK")
    form: list[Part] = [K, " − ", Power(omega, _SQUARE), " ", M]
    if _moving(place.matrices[1]):
        form = [K, " + ", s, " ", C, " + ", Power(s, _SQUARE), " ", M, " with ", s, " = i ", omega]
    if all(mode.frequency is None and mode.frequency_squared is None for mode in modes):
        yield says("The squared frequencies are the roots of the determinant of ", form,
                   ", for which no closed form was found.")  # fmt: skip
        return
    yield says("An oscillation with the angular frequency ", omega,
               " needs the determinant of ", form, " to vanish. The roots are")  # fmt: skip
    growing = modes_in_pairs(_with_growing_amplitudes(modes, place))
    for mode in modes_in_pairs(modes):
        yield from _mode(explainer, mode, omega, place)
        if mode in growing:
            yield says(*_growing(explainer, mode, place))


def _with_growing_amplitudes(
    modes: Sequence[ModesOfFrequency], place: Place
) -> list[ModesOfFrequency]:
    """Those of a multiple ω that is not 0 and has a Jordan block."""
    near = Near(place.near, place.characteristic)
    return [
        mode
        for mode, each in zip(modes, place.modes, strict=True)
        if each.frequency is not None and each.square is not None and each.multiplicity > 1
        and each.square != 0 and not near.semisimple(each.square, each.multiplicity)
    ]  # fmt: skip


def _growing(explainer: Explainer, mode: ModesOfFrequency, place: Place) -> list[Part]:
    squares = [each.square for each in place.modes if each.multiplicity == mode.multiplicity]
    weak = {f for W in squares if W is not None and W != 0 for f, _ in factors_of(W)}
    where = _not_zero(explainer, [f for f in weak if sign(f) not in (1, -1)], place)
    power = "the time" if mode.multiplicity == 2 else "a power of the time"
    rest = f"the amplitudes of other displacements grow in proportion to {power}"
    return [*_fewer(where), f"to first order {rest}."]


def _mode(
    explainer: Explainer, mode: ModesOfFrequency, omega: Name, place: Place
) -> Iterator[Block]:
    value = mode.frequency if mode.frequency is not None else mode.frequency_squared
    if value is None and mode.negative:
        yield says("No other root is real and positive: the amplitudes of some displacements grow.")
        return
    if value is None:
        count = mode.multiplicity
        roots = "one root" if count == 1 else f"{count} roots"
        yield says(f"and {roots} without a closed form.")
        return
    yield shows(omega if mode.frequency is not None else Power(omega, _SQUARE), value)
    shapes = [] if mode.shape is None else [mode.shape, *mode.more_shapes]
    for number, each in enumerate(shapes if len(mode.shape or ()) > 1 else ()):
        again = "and independently of these, as the root is multiple,"
        yield says(again if number else "with the amplitudes in the ratio")
        yield _amplitudes(each)
    yield from in_any_direction(mode)
    if mode.shaped_where:
        yield says("for ", *conditions(mode.shaped_where), ".")
    if mode.negative:
        yield says("This is negative: the displacement does not oscillate, it grows exponentially.")
    elif mode.frequency is None or mode.open_sign:
        yield says(f"It oscillates only where this is {real_and_positive(value)}.")
    if value == ZERO:
        if 0 < len(shapes) < mode.multiplicity:
            yield says(*_with_fewer_shapes(explainer, place))
        else:
            yield says(*_without_oscillation(explainer, mode, place))


def _with_fewer_shapes(explainer: Explainer, place: Place) -> list[Part]:
    """Of a root 0 that has a Jordan block, where what all of K is a multiple of is not 0."""
    entries = [x for row in place.near.K for x in row if is_zero(x) is not True]
    factors = [{f for f, _ in factors_of(x)} for x in entries]
    common = set.intersection(*factors) if factors else set()
    where = _not_zero(explainer, [f for f in common if sign(f) not in (1, -1)], place)
    rest = "to first order other displacements grow in proportion to a higher power of the time."
    return [*_fewer(where), rest]


def _not_zero(explainer: Explainer, factors: Sequence[Expr], place: Place) -> list[Part]:
    """Where none of these vanishes; empty where that is known."""
    squares = [f**2 for f in sorted(factors, key=str)]
    return [*conditions(above_zero(squares, explainer.system.order, place.point.positive))]


def _fewer(where: Sequence[Part]) -> list[Part]:
    parts: list[Part] = ["The root is multiple", ", and where " if where else " and has"]
    return [*parts, *where, *([" it has"] if where else []), " fewer independent shapes: "]


def _no_more_roots(explainer: Explainer, place: Place) -> list[Part]:
    """Where 0 is no root of a higher multiplicity."""
    lowest = next((c for c in place.characteristic.in_s or [] if c != 0), S.One)
    weak = [f for f, _ in factors_of(lowest) if sign(f) not in (1, -1)]
    return _not_zero(explainer, weak, place)


def _keeps_rank(K: Sequence[Sequence[Expr]]) -> bool:
    """Whether a principal minor of the order of the rank has one sign for all parameters."""
    n = len(K)
    blocks = combinations(range(n), n - len(nullspace(K)))
    minors = (determinant([[K[i][j] for j in block] for i in block]) for block in blocks)
    return any(minor is not None and sign(minor) in (1, -1) for minor in minors)


def _without_oscillation(explainer: Explainer, mode: ModesOfFrequency, place: Place) -> list[Part]:
    """What a root 0 is: each is two roots s = 0, and a null vector of K stays displaced."""
    staying = len(nullspace(place.near.K))
    lead = "To first order this is not an oscillation"
    if staying == mode.multiplicity:
        kept = place.verdict.stable is True and Near(place.near).dimension == 0
        moving, K = _moving(place.matrices[1]), place.near.K
        varies = moving and (_no_more_roots(explainer, place) or not _keeps_rank(K))
        only = [" in general"] * bool(varies)
        return [f"{lead} but", *only, f" a uniform drift{_KEPT if kept else '.'}"]
    if staying == 2 * mode.multiplicity:
        where = _no_more_roots(explainer, place)
        among: list[Part] = ["where ", *where, " "] if where else []
        return [f"{lead}: ", *among, "what is displaced stays displaced."]
    return [f"{lead}: displacements stay, or grow in proportion to the time."]


def _amplitudes(shape: Mapping[str, Expression]) -> Equations:
    return equations_of((Label("a", (q,)), part) for q, part in shape.items())


# -- with damping --------------------------------------------------------------------------------


def _damped(
    explainer: Explainer, modes: Sequence[ModesOfFrequency], place: Place
) -> Iterator[Block]:
    """det(K + s C + s^2 M) = 0 with odd powers of s."""
    s = explainer.letters.free("s")
    M, C, K = (Label(letter, matrix=True) for letter in "MCK")
    form: list[Part] = [K, " + ", s, " ", C, " + ", Power(s, _SQUARE), " ", M]
    yield says("A motion proportional to exp(", s, " t) needs the determinant of ", form,
               " to vanish.")  # fmt: skip
    if len(place.linear.M) == 1:
        M, C, K = (matrix[0][0] for matrix in place.matrices)
        yield from _one(explainer, modes, M, C, K)
        return
    powers = place.characteristic.in_s
    if powers is None:
        return
    symbol, order = Symbol(s.name, real=True), (*explainer.system.order, s.name)
    whole = simplify(sympy.Add(*(c * symbol**k for k, c in enumerate(powers))))
    factors = []
    found = ((f, k) for f, k in factors_of(whole) if not free_of(f, [symbol]))
    for factor, power in sorted(found, key=lambda pair: pair[0] != symbol):
        falling = sympy.Poly(factor, symbol).terms()
        written = sum_of(shape(c * symbol**k, order) for (k,), c in falling)
        factors.append(power_of(written, power))
    written = product_of(factors)
    if operation_count(written) <= _LONG:
        yield says("This gives")
        yield vanishing((written,))
    some = any(mode.is_open for mode in modes)
    lead = "Among its roots are " if some else "Its roots are "
    for mode in modes_in_pairs(modes):
        if mode.decay is not None and mode.frequency is not None:
            yield from _decaying(explainer, lead, mode.decay, mode.frequency)
            lead = "and "
        if mode.exponents:
            yield says(lead.strip())
            yield equations_of((s, exponent) for exponent in dict.fromkeys(mode.exponents))
            lead = "and "
    if some:
        known = any(mode.exponents or mode.decay is not None for mode in modes)
        yield says(f"No closed form was found for {'the others' if known else 'its roots'}.")
    yield from _where_real(explainer, modes)


def _where_real(explainer: Explainer, modes: Sequence[ModesOfFrequency]) -> Iterator[Block]:
    if any(mode.decay is not None and mode.open_sign for mode in modes):
        yield says("It oscillates only where ", explainer.letters.free("omega"),
                   " is real and positive.")  # fmt: skip


def _decaying(
    explainer: Explainer, lead: str, decay: Expression, frequency: Expression
) -> Iterator[Block]:
    s, omega, delta = (explainer.letters.free(name) for name in ("s", "omega", "delta"))
    if decay == ZERO:
        yield says(lead, s, " = ±i ", omega, " with")
        yield shows(omega, frequency)
        return
    yield says(lead, s, " = −", delta, " ± i ", omega, " with")
    yield Equations((Row(delta, decay), Row(omega, frequency)))


def _one(
    explainer: Explainer, modes: Sequence[ModesOfFrequency], M: Expr, C: Expr, K: Expr
) -> Iterator[Block]:
    """s = -delta +- i sqrt(K/M - delta^2) with delta = C/(2 M), and its three cases."""
    free, write = explainer.letters.free, explainer.readable.as_written
    s, omega, delta = free("s"), free("omega"), free("delta")
    rate, square = simplify(C / (2 * M)), simplify(K / M)
    if square == 0:
        yield says("Its roots are 0 and")
        yield shows(s, write(-2 * rate))
        return
    frequency: Expression = Call("sqrt", (difference(write(square), write(rate**2)),))
    frequency = next((m.frequency for m in modes if m.decay and m.frequency), frequency)
    yield from _decaying(explainer, "Its roots are ", write(rate), frequency)
    signs = [sign(x) for x in (M, C, K)]
    if signs not in ([1, 1, 1], [1, -1, 1]):
        yield from _where_real(explainer, modes)
        return
    falls = signs[1] == 1
    verb, kind = ("decays", "decaying") if falls else ("grows", "growing")
    end = [f" ({each} damping)" * falls for each in ("weak", "critical", "strong")]
    weak: list[Part] = ["the displacement oscillates with the frequency ", omega,
                        f" and {verb} as exp(−", delta, f" t){end[0]}. "]  # fmt: skip
    critical: list[Part] = ["it is exp(−", delta, f" t) times a linear function of t{end[1]}. "]
    strong: list[Part] = [f"it is a sum of two {kind} exponentials{end[2]}."]
    rest = 4 * M * K - C**2
    known, compared = sign(rest), above(rest, explainer.system.order)
    if known is not None or compared is None:
        yield says("Here ", *(strong if known == -1 else critical if known == 0 else weak))
        return
    more, less = compared.left, compared.right
    yield says("For ", less, " < ", more, " ", *weak, "For ", less, " = ", more, " ", *critical,
               "For ", less, " > ", more, " ", *strong)  # fmt: skip
