"""Whether the initial state of the file lies on its constraints, as a numerical run wants it."""

from __future__ import annotations

from lagcli.diagnostics import Diagnostic
from lagcli.problem import Problem


def initial_mistakes(problem: Problem) -> tuple[Diagnostic, ...]:
    """What a run would refuse of `initial`; nothing where values of parameters are missing."""
    if not (problem.initial and problem.constraints):
        return ()
    from lagcli.numerics.arithmetic import Doubles
    from lagcli.numerics.constants import constants_of
    from lagcli.numerics.contact import with_contacts
    from lagcli.numerics.equations import Equations
    from lagcli.numerics.motion import Motion
    from lagcli.numerics.refusal import Refusal
    from lagcli.numerics.start import OffConstraints, initial_state

    try:
        e = Equations(with_contacts(problem))
        if problem.contacts:
            e = e.holding(frozenset(range(len(problem.constraints))))
        entries = [entry for row in (*e.mass, *e.rows) for entry in row]
        given = map(e.form.read, problem.initial.values())
        needed = [*entries, *e.bias, *e.positions, *e.rates, *given]
        initial_state(Motion(e, constants_of(e, needed, Doubles()), Doubles()))
    except OffConstraints as refusal:
        return refusal.diagnostics
    except Refusal:
        return ()
    return ()
