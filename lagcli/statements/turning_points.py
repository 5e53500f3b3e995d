"""Sentences on the turning points of one coordinate, and on what must hold there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from lagcli.document import Block, Paragraph, equations_of
from lagcli.expression import Name, length
from lagcli.notation.letters import names_in
from lagcli.statements.motions import OneFreedom
from lagcli.statements.plus_minus import single
from lagcli.statements.wording import Part, conditions, listed, repeating, with_capital

_MOST_TO_READ = 20


def turning_contacts(motion: OneFreedom) -> Iterator[Paragraph]:
    """For which energies one-sided contacts hold at the turning points."""
    different = {*motion.turning_where}
    demands, hold = _demands(motion)
    sides = [side for where in different for each in where for side in (each.left, each.right)]
    if any(length(side) > _MOST_TO_READ for side in sides):
        E = Name(motion.constant)
        yield Paragraph(("It depends on ", E, " whether ", *demands, f"{hold} there."))
        return
    if len(different) == 1 and different != {()}:
        where = motion.turning_where[0]
        with_energy = all(motion.constant in names_in(each) for each in where)
        end = " or at equality." if with_energy and not motion.signed else "."
        lead = with_capital(demands)
        yield Paragraph((*lead, f"{hold} there for ", *conditions(where), end))
    if len(different) < 2:
        return
    for root, where in zip(motion.turning_points or (), motion.turning_where, strict=True):
        if where:
            place = ("At ", Name(motion.coordinate), " = ", root)
            yield Paragraph((*place, " ", *demands, f"{hold} for ", *conditions(where), "."))


def while_contacts_last(motion: OneFreedom) -> list[Part]:
    """That one-sided contacts and the signs of what was eliminated limit the motion."""
    if not (motion.one_sided or motion.signed):
        return []
    demands, hold = _demands(motion)
    return [" as long as ", *demands, hold]


def turning_points(motion: OneFreedom, lead: Sequence[Part]) -> Iterator[Block]:
    """Those listed, after which of the roots of U_eff = E they are, and where they repeat."""
    parts: list[Part] = ["real and positive" if motion.positive else "real"]
    if motion.leaves_out:
        demands, hold = _demands(motion)
        parts += [" and ", *demands, hold]
    yield Paragraph((*lead, *parts, ":"))
    roots = motion.turning_points or ()
    yield equations_of((Name(motion.coordinate), root) for root in single(roots))
    if motion.turning_period is not None:
        yield Paragraph(tuple(repeating({motion.coordinate: motion.turning_period})))


def _demands(motion: OneFreedom) -> tuple[list[Part], str]:
    """What must hold at a turning point, and the verb."""
    several = len(motion.signed) > 1
    signed: list[Part] = [f"the assumed sign{'s' * several} of ", *listed(motion.signed)]
    if motion.one_sided:
        contacts = f"the one-sided constraint{'s' * (motion.one_sided > 1)}"
        alone = motion.one_sided == 1 and not motion.signed
        verb = " holds" if alone else " hold"
        return [contacts, *([" and ", *signed] * bool(motion.signed))], verb
    return signed, " hold" if several else " holds"
