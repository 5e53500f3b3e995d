"""Equations of motion, matrix form, accelerations, multipliers and constraint forces."""

from __future__ import annotations

from flint import arb

from lagcli.record import replace
from lagcli.statements.answers import (
    AccelerationsSection,
    EquationsSection,
    LagrangianSection,
    MatrixFormSection,
    Multiplier,
    MultipliersSection,
)
from lagcli.verification.claims.integrability import refuted_kinds
from lagcli.verification.examination import Examination
from lagcli.verification.linear import dot
from lagcli.verification.states import State


def lagrangian(x: Examination, section: LagrangianSection) -> LagrangianSection:
    """L."""
    L = section.lagrangian
    if L is None or x.holds("the Lagrangian", L, lambda s: s.laws.lagrangian):
        return section
    return replace(section, lagrangian=None)


def equations(x: Examination, section: EquationsSection) -> EquationsSection:
    """left - right = d/dt(dL/dq') - dL/dq - Q - sum lambda a for any q'' and lambda."""
    if section.equations is None:
        return section
    sides = [(each.left, each.right) for each in section.equations]
    if not x.differ_by("the equations of motion", sides, lambda s: s.loose.residuals):
        section = replace(section, equations=None)
    for row in x.reference.rows:
        name = row.constraint.name
        if name in section.constraints:
            sides = [section.constraints[name]]
            what = f"the equation of the constraint '{name}'"
            if not x.differ_by(what, sides, lambda s, f=row.value: [s.loose.at(f)]):  # type: ignore[misc]
                kept = {n: e for n, e in section.constraints.items() if n != name}
                section = replace(section, constraints=kept)
    return section


def matrix_form(x: Examination, section: MatrixFormSection) -> MatrixFormSection:
    """M, A, forcing and bias, each entry: M and A by their products with a random vector."""
    x.define("the matrix form", section.shared)
    rows = [*section.mass_matrix, *section.constraint_jacobian]
    entries = [entry for row in rows for entry in row]
    other = [*section.forcing, *section.constraint_bias]
    places = x.places("the matrix form", [*entries, *other])
    if places is None:
        return replace(section, mass_matrix=())
    width = len(section.forcing)

    def products(s: State) -> tuple[list[arb], list[arb]]:
        values = [s.at(place) for place in places]
        matrix = [values[k : k + width] for k in range(0, len(entries), width)]
        w = s.loose.accelerations
        laws = s.laws
        pull = [i - d for i, d in zip(laws.inertia(w), laws.drift, strict=True)]
        forcing = [f - d for f, d in zip(laws.applied, laws.drift, strict=True)]
        true = [*pull, *(dot(a, w) for a in laws.jacobian), *forcing, *laws.bias]
        return [*(dot(row, w) for row in matrix), *values[len(entries) :]], true

    if x.decide("the matrix form", products):
        return section
    return replace(section, mass_matrix=())


def accelerations(x: Examination, section: AccelerationsSection) -> AccelerationsSection:
    """q'' by coordinate, and whether the equations determine them."""
    if section.accelerations is None:
        return _regularity(x, section)
    for j, name in enumerate(x.reference.names):
        what = f"the acceleration of {name}"
        if not x.determined(what, lambda s, j=j: s.laws.motion.determined(j)):  # type: ignore[misc]
            return replace(section, accelerations=None, verified=None)
        q = section.accelerations[name]
        if not x.holds(what, q, lambda s, j=j: s.laws.accelerations[j]):  # type: ignore[misc]
            return replace(section, accelerations=None, verified=None)
    return section


def _regularity(x: Examination, section: AccelerationsSection) -> AccelerationsSection:
    """That the equations do not determine the accelerations, where that is claimed."""
    states = x.states()
    if section.regular or x.reference.large or not states or not x.regular:
        return section
    x.refute("that the equations do not determine the accelerations", "they do at random states")
    return replace(section, regular=True, degenerate=())


def multipliers(x: Examination, section: MultipliersSection) -> MultipliersSection:
    """Lambda by constraint."""
    size = len(x.reference.names)
    found: dict[str, Multiplier] = dict(section.multipliers)
    for k, row in enumerate(x.reference.rows):
        name = row.constraint.name
        each = found[name]
        if each.value is None:
            continue
        what = f"the multiplier {each.symbol}"
        holds = x.determined(
            what,
            lambda s, k=k: s.laws.motion.determined(size + k),  # type: ignore[misc]
        ) and x.holds(what, each.value, lambda s, k=k: s.laws.multipliers[k])  # type: ignore[misc]
        if not holds:
            found[name] = replace(each, value=None, verified=None)
    for name in refuted_kinds(x, section):
        x.refute(
            f"whether the constraint '{name}' is integrable",
            "the derivatives of its form say otherwise",
        )
        found[name] = replace(found[name], kind=None)
    return replace(section, multipliers=found)
