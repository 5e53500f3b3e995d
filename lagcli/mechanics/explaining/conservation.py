"""The last steps: the energy function and the momenta, each with its reason."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from lagcli.algebra import is_zero
from lagcli.algebra.build import free_of
from lagcli.algebra.decimals import written
from lagcli.document import Block, Equations, Heading, Label, Row
from lagcli.expression import Diff, Name, Negative, Product, Rate, Sum, sum_of
from lagcli.mechanics.explaining.explainer import Explainer
from lagcli.mechanics.explaining.words import Part, listed, says, shows
from lagcli.mechanics.impacts import when_constant
from lagcli.mechanics.noether import NoetherCharge
from lagcli.mechanics.rest.exceptions import Vanishing
from lagcli.mechanics.total_derivative import euler_operator
from lagcli.statements.wording import CHANGE_OF_L, TRIVIAL, capitalized, enumerated, exceptions


def energy(explainer: Explainer) -> Iterator[Block]:
    """The energy function h, whether it equals T + V, whether it is conserved."""
    function, letters = explainer.derivation.energy, explainer.letters
    momentum = Diff(letters.L, letters.velocity)
    product = Product((letters.velocity, momentum))
    yield says(
        "The energy function is the sum of " if letters.several else "The energy function is ",
        product,
        " over all coordinates, minus " if letters.several else ", minus ",
        letters.L,
        ":",
    )
    yield shows(letters.h, explainer.readable.by_terms(function.readable_function, as_given=True))
    yield says(*_total(explainer))
    yield from _rate(explainer)
    if _has_hamiltonian(explainer):
        yield says(
            "The Hamiltonian is ",
            letters.h,
            " as a function of the coordinates and momenta, so the same holds for it.",
        )


def _has_hamiltonian(explainer: Explainer) -> bool:
    """Whether the momenta determine the velocities."""
    hamiltonian = explainer.derivation.hamiltonian
    return not explainer.dynamics.degenerate and hamiltonian.fold is None


def _total(explainer: Explainer) -> list[Part]:
    """Whether h equals T + V, and why."""
    system, letters = explainer.system, explainer.letters
    function = explainer.derivation.energy
    h, T, V = letters.h, letters.T, letters.V
    if system.T is None or system.V is None:
        given = letters.L if system.H is None else letters.free("H")
        return ["Only ", given, " is given, so it is not compared with ", T, " + ", V, "."]
    plain = free_of(system.V, system.qdot)
    if function.is_total_energy:
        if is_zero(system.V) is True:
            return [V, " is 0 and ", h, " equals ", T, "."]
        if not (plain and function.quadratic):
            return [h, " equals ", T, " + ", V, "."]
        return [
            T, " is homogeneous of degree two in the velocities and ", V, " contains none, so ", h,
            " is the total energy ", T, " + ", V, ".",
        ]  # fmt: skip
    if function.static_potential is not None:
        return ["The terms of ", V, " linear in the velocities drop out: ", h, " equals ", T,
                " plus the rest of ", V, "."]  # fmt: skip
    reasons: list[Part] = []
    if not function.quadratic:
        reasons += [T, " is not homogeneous of degree two in the velocities"]
    if not plain:
        reasons += [" and " if reasons else "", V, " contains velocities"]
    undecided = function.is_total_energy is None
    verdict: list[Part] = ["whether ", h, " equals "] if undecided else [
        "so " if reasons else "", h, " does not equal "]  # fmt: skip
    difference = function.function - system.T - system.V
    end = [" was not decided."] if undecided else [*_unless(explainer, difference), "."]
    return [*reasons, ", " if reasons else "", *verdict, *_both(explainer), *end]


def _both(explainer: Explainer) -> list[Part]:
    """T + V, and T where V is 0."""
    alone = explainer.system.V is not None and is_zero(explainer.system.V) is True
    letters = explainer.letters
    return [letters.T] if alone else [letters.T, " + ", letters.V]


def _rate(explainer: Explainer) -> Iterator[Block]:
    function, letters = explainer.derivation.energy, explainer.letters
    h = letters.h
    if not function.powers:
        yield says(*_unchanged(explainer), " So ", h, *_conserved(explainer), ".")
        yield from _work_of_drive(explainer)
        return
    changes = listed(
        [
            *((letters.L, " ", p.deed) for p in function.powers if p.of_lagrangian),
            *(p.deed for p in function.powers if not p.of_lagrangian),
        ]
    )
    total = sympy.Add(*(power.value for power in function.powers))
    because = [] if function.conserved else ["It can change because ", *changes, ". "]
    yield says(*because, "Its rate is")
    yield shows(Name(h.name, 1), explainer.readable.by_terms(total, as_given=True))
    if function.conserved is None:
        yield says("Whether this vanishes on the motion was not decided.")
    elif function.conserved:
        yield says("On the motion this is 0, so ", h, *_conserved(explainer), ".")
        yield from _work_of_drive(explainer)
    else:
        rate = function.rate
        if rate is not None and not total.free_symbols.isdisjoint(explainer.system.multipliers):
            yield says("With the values of the multipliers it is")
            yield shows(Name(h.name, 1), explainer.readable.on_surface(rate))
        special = _unless(explainer, total if rate is None else rate)
        yield says("This is not 0 on every motion: ", h, " is not conserved", *special, ".")


def _unless(explainer: Explainer, *rates: sympy.Expr) -> list[Part]:
    """The values of the parameters for which rates vanish; in general, where others may."""
    system = explainer.system
    if not any(rates):
        return []
    moving = sorted({s for r in rates for s in r.free_symbols} - {*system.parameters}, key=str)
    vanishing = Vanishing(rates, moving, explainer.dynamics.lagrange.mass_matrix)
    if not vanishing.is_void_only_there:
        return [" in general"]
    void = vanishing.void
    return exceptions([written(sympy.Mul(*void), system.order)] if void else [])


def _unchanged(explainer: Explainer) -> list[Part]:
    """Why dh/dt has no terms: dL/dt = 0, Q . q' = 0, and b = 0 for every constraint."""
    clauses: list[Part | list[Part]] = [[explainer.letters.L, " does not depend on t explicitly"]]
    clauses += ["the applied forces do no work"] if explainer.forced else []
    if constraints := len(explainer.dynamics.constraints.equations):
        clauses += [f"the constraint{' does' if constraints == 1 else 's do'} no work"]
    return [*listed(clauses), "."]


def _conserved(explainer: Explainer) -> list[Part]:
    function = explainer.derivation.energy
    named = "" if function.is_total_energy else ", Jacobi's integral,"
    when = f" {function.when_constant}" if function.when_constant else ""
    return [f"{named} is conserved{when}"]


def _work_of_drive(explainer: Explainer) -> Iterator[Block]:
    """d(T + V)/dt, where h is conserved and differs from T + V."""
    function, letters = explainer.derivation.energy, explainer.letters
    rate = function.total_rate
    if not function.driven or rate is None:
        return
    both = _both(explainer)
    if rate == 0:
        yield says(*both, " is conserved as well.")
        return
    drive = ": the prescribed motion does work on the system. The rate is"
    yield says(*both, " is not conserved", *_unless(explainer, rate), drive)
    total = letters.T if len(both) == 1 else Sum((letters.T, letters.V))
    yield shows(Rate(total), explainer.readable.on_surface(rate))


def charges(explainer: Explainer) -> Iterator[Block]:
    """Momenta of cyclic coordinates, and the conserved quantities of the candidates."""
    for charge in explainer.derivation.noether.charges:
        if charge.source == "cyclic":
            yield from _cyclic(explainer, charge)
        elif charge.source == "candidate":
            yield from _candidate(explainer, charge)


def _cyclic(explainer: Explainer, charge: NoetherCharge) -> Iterator[Block]:
    system, letters = explainer.system, explainer.letters
    index = list(charge.transformation.changes).index(sympy.S.One)
    name = system.names[index]
    q, v, p = Name(name), Name(name, 1), Name(f"p_{name}")
    right = sympy.Add(
        system.applied_forces[index],
        *(e.multiplier * e.row[index] for e in explainer.dynamics.constraints.equations),
    )
    nothing = is_zero(right) is True
    yield Heading("The momentum of", 2, q)
    yield says(
        q,
        " does not occur in ",
        letters.L,
        ", so by Lagrange's equation for it the momentum ",
        Diff(letters.L, v),
        " changes only by the forces along ",
        q,
        ", of which there are none:" if nothing and charge.conserved else ". Its rate is",
    )
    if not nothing:
        yield shows(Name(p.name, 1), explainer.readable.by_terms(right))
    if charge.conserved is None:
        yield says("Whether that vanishes on the motion was not decided.")
        return
    if charge.conserved:
        if not nothing:
            yield says("which is 0 on the motion. So this is conserved:")
    else:
        rate = charge.rate
        if rate is not None and not right.free_symbols.isdisjoint(explainer.system.multipliers):
            yield says("and with the values of the multipliers")
            yield shows(Name(p.name, 1), explainer.readable.on_surface(rate))
        special = _unless(explainer, right if rate is None else rate)
        yield says("so it is not conserved", *special, ":")
    yield shows(p, explainer.readable.linear(charge.charge), _stays(charge))
    if charge.conserved:
        yield from _struck(explainer, charge)


def _acting(explainer: Explainer) -> str:
    """Applied forces and constraints, as the subject of a sentence."""
    forces = ["the applied forces"] * explainer.forced + ["the dissipation"] * explainer.damped
    forces += [explainer.constraint_forces] * bool(explainer.constraints)
    if not forces:
        return ""
    several = len(forces) > 1 or forces[0].startswith(("the applied", "the forces"))
    words = enumerated(forces)
    return f"{capitalized(words)} {'do' if several else 'does'}"


def _work(explainer: Explainer, charge: NoetherCharge, *, with_gauge: bool) -> Iterator[Block]:
    """What forces do along a transformation whose Q is constant."""
    working = explainer.derivation.noether.working(charge)
    if not working:
        acting = _acting(explainer)
        if acting:
            yield says(acting, " no work along this transformation.")
        return
    words = enumerated(working)
    several = len(working) > 1 or words.startswith(("the applied", "the constraints"))
    do = "do" if several else "does"
    lead = f"{capitalized(words)} {do} work along this transformation, which together "
    letters = explainer.letters
    total: list[Part] = ["the total time derivative of ", letters.G] if with_gauge else ["0"]
    yield says(lead, "with the change of ", letters.L, " is ", *total, ".")


def _struck(explainer: Explainer, charge: NoetherCharge) -> Iterator[Block]:
    change = charge.transformation
    when = when_constant(explainer.system, change.changes, change.time, charge.gauge)
    if when:
        yield says(f"This holds {when}.")


def _stays(charge: NoetherCharge) -> str:
    return "constant" if charge.conserved else "not conserved"


def _candidate(explainer: Explainer, charge: NoetherCharge) -> Iterator[Block]:
    letters, write = explainer.letters, explainer.readable.as_written
    change = charge.transformation
    yield Heading("", 2, Name(charge.name))
    yield says("The transformation of the file is")
    named = [*zip(explainer.system.names, change.changes, strict=True), ("t", change.time)]
    rows = [Row(Label(name, change=True), write(by)) for name, by in named if by != 0]
    yield Equations(tuple(rows))
    gauge = charge.gauge
    changed = explainer.derivation.noether.change_of_action(change)
    boundary = sympy.S.Zero if gauge is None else gauge
    same = is_zero(changed - explainer.system.total_derivative(boundary)) is True
    working = explainer.derivation.noether.working(charge) if charge.conserved else []
    without_formula = not charge.complete and charge.conserved is not None
    if working and gauge is not None and not same:
        yield from _with_work(explainer, gauge, enumerated(working), is_zero(changed) is True)
    elif without_formula:
        yield says(
            "Under it the action changes by the total time derivative of a boundary term ",
            letters.G,
            ", for which no formula was found.",
        )
    elif gauge is None:
        yield says(
            "Under it the action changes, and no boundary term was found whose total time "
            "derivative equals the change."
        )
    elif is_zero(gauge) is True and same:
        of_what: list[Part] = [] if charge.conserved else [" of ", letters.L]
        yield says("Under it the action does not change: it is a symmetry", *of_what, ".")
    elif is_zero(gauge) is True and charge.conserved:
        yield says("Under it the action does not change on the motion.")
    elif is_zero(gauge) is True:
        yield says("Under it the action changes; the boundary term that the file gives is 0.")
    elif gauge is not None:
        on_motion = "" if same else " on the motion" if charge.conserved else " and something more"
        yield says(
            "Under it the action changes by more than the total time derivative of"
            if on_motion.startswith(" and")
            else f"Under it the action changes only by a boundary term,{on_motion} the total time "
            "derivative of"
        )
        yield shows(letters.G, write(gauge))
    applies = charge.conserved is not False
    with_gauge, with_time = without_formula or bool(boundary != 0), change.time != 0
    yield says(*noether_words(explainer, applies, with_gauge=with_gauge, with_time=with_time))
    Q = explainer.readable.by_terms(charge.charge)
    if without_formula:
        Q = sum_of([Q, Negative(letters.G)])
    yield shows(letters.Q, Q, _stays(charge) if charge.conserved is not None else "")
    if explainer.derivation.noether.is_trivial(charge):
        yield says(TRIVIAL)
        return
    if charge.conserved is None:
        why = f": {charge.broken_by}" if charge.broken_by else ""
        yield says(f"Whether it is conserved was not decided{why}.")
    elif charge.conserved:
        if not working or same:
            yield from _work(explainer, charge, with_gauge=with_gauge)
        yield from _struck(explainer, charge)
    else:
        special = [] if charge.rate is None else _unless(explainer, charge.rate)
        total: list[Part] = []
        if not special and charge.broken_by == CHANGE_OF_L:
            total = _unless(explainer, *euler_operator(changed, explainer.system))
        yield says("It is not conserved", *special, f", because of {charge.broken_by}", *total, ":")
        if charge.rate is not None:
            yield shows(Name(letters.Q.name, 1), explainer.readable.on_surface(charge.rate))


def _with_work(
    explainer: Explainer, gauge: sympy.Expr, working: str, unchanged: bool
) -> Iterator[Block]:
    """The change of L and the work of other forces, whose sum is the rate of G on the motion."""
    letters = explainer.letters
    none = is_zero(gauge) is True
    if unchanged:
        lead = f"Under it the action does not change. The work of {working} along it is"
    else:
        lead = f"Under it the action changes. Together with the work of {working} this is"
    yield says(
        f"{lead} {'0 on the motion.' if none else 'on the motion the total time derivative of'}"
    )
    if not none:
        yield shows(letters.G, explainer.readable.as_written(gauge))


def noether_words(
    explainer: Explainer, applies: bool = True, *, with_gauge: bool, with_time: bool
) -> list[Part]:
    """What Q is made of, by Noether's theorem, or all the same where it does not apply."""
    letters = explainer.letters
    momentum = Diff(letters.L, letters.velocity)
    change, delay = Label(letters.q.name, change=True), Label("t", change=True)
    several = letters.several
    gives = "gives " if applies else "does not apply; its expression is "
    parts: list[Part] = ["Noether's theorem ", gives, "the sum of " if several else "", momentum]
    if with_time:
        parts += [" times (", change, " − ", letters.velocity, " ", delay, ")"]
    else:
        parts += [" times ", change]
    if several:
        parts.append(" over all coordinates")
    if with_time:
        parts += [", plus ", letters.L, " ", delay]
    if with_gauge:
        parts += [", minus ", letters.G]
    return [*parts, ":"]
