"""Charges: the formula, whether it is conserved, and its rate.

For Delta q = Dq, Delta t = Dt and the boundary term G (Noether 1918; Hill, Rev. Mod. Phys. 23
(1951) 253):

    Q = sum_j dL/dq_j' (Dq_j - q_j' Dt) + L Dt - G.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from flint import arb

from lagcli.expression import ONE, ZERO
from lagcli.record import replace
from lagcli.statements.answers import Charge, ChargesSection
from lagcli.verification.claims.boundary import boundary_term, closed_on_surface
from lagcli.verification.claims.rest import conditions
from lagcli.verification.comparison import is_zero
from lagcli.verification.examination import BRANCHED, Examination
from lagcli.verification.linear import Unclear, dot, rank
from lagcli.verification.states import State
from lagcli.verification.sweeps import column


def charges(x: Examination, section: ChargesSection) -> ChargesSection:
    """Each charge of a section."""
    checked = tuple(_charge(x, charge) for charge in section.charges)
    if section.sought and not any(charge.source == "discovered" for charge in checked):
        _evident_are_listed(x, checked, with_rates=not section.discovered)
    return section if checked == section.charges else replace(section, charges=checked)


def _evident_are_listed(x: Examination, charges: Sequence[Charge], *, with_rates: bool) -> None:
    """Note a momentum of a cyclic coordinate, or the energy, that depends on none of these.

    Those that are not conserved have their rates among the charges of the file, not among those
    that a search finds.
    """
    reference = x.reference
    states = x.states(BRANCHED) if reference.rows else x.states()
    if not states or reference.large or reference.of_phase_space or not x.regular:
        return
    for what, place in _evident(x, states):
        lasts = all(is_zero(s.laws.rate(place)) for s in states)
        if not (lasts or with_rates):
            continue
        # one that is undecided is listed with its sentence
        stated = (c for c in charges if c.conserved is not False or not lasts)
        listed = [c.charge for c in stated if c.charge is not None]
        known = [each for charge in listed for each in x.places("", [charge]) or ()]
        if _is_independent(x, place, known):
            is_so = "conserved" if lasts else "left out with its rate"
            x.refute("that all evident charges are listed", f"{what} is {is_so}")


def _evident(x: Examination, states: Sequence[State]) -> Iterator[tuple[str, int]]:
    """p_j where L does not contain q_j, nor jumps with it, and the energy function."""
    reference, program = x.reference, x.reference.program
    steps = (program.steps[place] for place in program.order([reference.lagrangian]))
    jumping = program.symbols([s.parts[0] for s in steps if (s.kind, s.what) == ("call", "sign")])
    for name, q, p in zip(reference.names, reference.q, reference.momenta, strict=True):
        slope = reference.by(reference.lagrangian, q)
        if (name, 0) not in jumping and all(is_zero(s.at(slope)) for s in states):
            yield f"p_{name}", p
    yield "the energy function", reference.energy


def _is_independent(x: Examination, place: int, known: Sequence[int]) -> bool:
    """Whether a quantity is no function of others and of the constraints, seen by gradients."""
    reference, state = x.reference, x.states()[0]
    forms = [form for row in reference.rows for form in (row.value, row.velocity)]
    symbols = [*reference.q, *reference.v, reference.time]
    rows = [column(state.at.gradient(each), symbols) for each in (*known, *forms)]
    own = column(state.at.gradient(place), symbols)
    try:
        return rank([*rows, own], len(symbols)) > rank(rows, len(symbols))
    except Unclear:
        return False


def _charge(x: Examination, charge: Charge) -> Charge:
    charge = _as_given(x, charge)
    if charge.trivial:
        return charge if _is_trivial(x, charge) else _without(charge)
    if charge.charge is None:
        if charge.gauge is not None:  # then Q is known
            x.refute(f"the charge '{charge.name}'", "its formula is not given")
        lasts = not charge.conserved or closed_on_surface(x, charge)
        return charge if lasts else _without(charge)
    what = f"the charge '{charge.name}'"
    places = x.places(what, [charge.charge])
    tried = len(x.unchecked)
    if places is None or not _is_noethers(x, what, charge) or not boundary_term(x, charge):
        return _without(charge)
    if not (_is_real_where(x, charge, places[0]) and _is_as_named(x, charge, places[0])):
        return _without(charge)
    rate = _rate(x, charge, places[0])
    if rate is None:
        x.unchecked.append(what)
    elif charge.conserved is not None:
        claim = f"that '{charge.name}' is {'' if charge.conserved else 'not '}conserved"
        if not x.constant(claim, charge.conserved, rate):
            return _without(charge)
        known = charge.rate
        if known is not None and not x.holds(f"the rate of '{charge.name}'", known, rate):
            return replace(charge, rate=None, conserved=None, verified=None, broken_by="")
    return charge if len(x.unchecked) == tried else replace(charge, verified=None)


def _is_trivial(x: Examination, charge: Charge) -> bool:
    """Whether Noether's Q depends on the constraints alone."""
    Q = _noether(x, charge)
    if Q is not None and x.states() and _is_independent(x, Q, []):
        x.refute(f"that the charge of '{charge.name}' is constant", "it changes between states")
        return False
    return Q is not None


def _is_real_where(x: Examination, charge: Charge, place: int) -> bool:
    """Whether the printed conditions hold wherever it is real; ln t has a domain of its own."""
    what = f"where the charge '{charge.name}' is real"
    above = conditions(x, what, charge.where)
    for s in x.states(BRANCHED) if above else ():
        if s.at(place).is_finite() and not all(s.at(condition) > 0 for condition in above):
            x.refute(what, "it is real elsewhere, too")
            return False
    return True


def _is_as_named(x: Examination, charge: Charge, place: int) -> bool:
    """Whether what is called p_q is dL/dq', with this sign."""
    momenta = dict(zip(x.reference.names, x.reference.momenta, strict=True))
    p = momenta.get(charge.name.removeprefix("p_")) if charge.source == "cyclic" else None
    what = f"the momentum '{charge.name}'"
    return p is None or x.decide(what, lambda s: ([s.at(place)], [s.at(p)]))


def _without(charge: Charge) -> Charge:
    return replace(
        charge,
        trivial=False,
        gauge=None,
        charge=None,
        rate=None,
        conserved=None,
        verified=None,
        broken_by="its printed form was not confirmed at random states",
    )


def _as_given(x: Examination, charge: Charge) -> Charge:
    """A candidate's transformation is that of the file."""
    given = [each for each in x.problem.symmetries if each.name == charge.name]
    if charge.source != "candidate" or not given:
        return charge
    asked = {**given[0].changes, **({} if given[0].time is None else {"t": given[0].time})}
    names = (*x.reference.names, "t")
    places = [x.reference.place(asked.get(name, ZERO)) for name in names]
    printed = [charge.transformation.get(name, ZERO) for name in names]
    what = f"the transformation of '{charge.name}'"
    if x.hold(what, printed, lambda s: [s.at(place) for place in places]):
        return charge
    return _without(replace(charge, transformation=asked))


def _is_noethers(x: Examination, what: str, charge: Charge) -> bool:
    """Whether Q is that of the transformation and of the boundary term."""
    assert charge.charge is not None
    if not charge.transformation:
        if charge.source in {"cyclic", "time"}:
            x.refute(what, "its transformation is left out")
        return charge.source not in {"cyclic", "time"}
    Q = _noether(x, charge)
    return Q is not None and x.holds(what, charge.charge, lambda s: s.at(Q))


def _sign(charge: Charge) -> int:
    """The energy is listed with Q = +h for Dt = 1."""
    shift = dict(charge.transformation) == {"t": ONE}
    return -1 if shift and charge.source in {"time", "discovered"} else 1


def _noether(x: Examination, charge: Charge) -> int | None:
    """The step of Q; None where what is printed cannot be read back."""
    program, changed = x.reference.program, change_in_form(x, charge)
    gauge = x.places(f"the charge '{charge.name}'", [charge.gauge or ZERO])
    if changed is None or gauge is None:
        return None
    work = map(program.product, x.reference.momenta, changed[0])
    stretch = program.product(x.reference.lagrangian, changed[1])
    Q = program.sum(*work, stretch, program.negative(gauge[0]))
    return Q if _sign(charge) > 0 else program.negative(Q)


def change_in_form(x: Examination, charge: Charge) -> tuple[list[int], int] | None:
    """The steps of Dq_j - q_j' Dt, and that of Dt."""
    program, names = x.reference.program, (*x.reference.names, "t")
    printed = [charge.transformation.get(n, ZERO) for n in names]
    places = x.places(f"the charge '{charge.name}'", printed)
    if places is None:
        return None
    *changes, time = places
    back = [program.negative(program.product(v, time)) for v in x.reference.v]
    return list(map(program.sum, changes, back)), time


def _rate(x: Examination, charge: Charge, place: int) -> Callable[[State], arb] | None:
    """dQ/dt on the motion; where q'' is not determined, what is left of it for any q''.

    None where constraints do not determine q'' either.
    """
    if x.regular:
        return lambda s: s.laws.rate(place)
    changed = change_in_form(x, charge)
    if x.reference.rows or not charge.transformation or changed is None:
        return None
    sign = _sign(charge)

    def off_the_motion(s: State) -> arb:
        """dQ/dt - sum_j (d/dt(dL/dq_j') - dL/dq_j - Q_j) (Dq_j - q_j' Dt)."""
        return s.loose.rate(place) - sign * dot(s.loose.residuals, list(map(s.at, changed[0])))

    return off_the_motion
