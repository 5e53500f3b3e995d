"""Energy and Noether's charges of a large system, on its graph.

The formulas are those of `energy` and `noether`; what the motion would have to be solved
for stays undecided here.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node
from lagcli.mechanics.identities import vanish
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.problem_data import Symmetry
from lagcli.record import record
from lagcli.statements.answers import ChargeSource, Verification
from lagcli.statements.wording import CHANGE_OF_L, CONSERVED, constraints_named, enumerated

_NOT_SOLVED = "the system is too large to solve the motion in formulas"


@record
class LargeCharge:
    """As `NoetherCharge`, with nodes."""

    name: str
    source: ChargeSource
    changes: Mapping[str, Node]
    gauge: Node | None
    charge: Node
    conserved: bool | None
    rate: Node | None
    verified: Verification | None
    broken_by: str


class LargeCharges:
    """Momenta, energy and charges from a matrix form."""

    def __init__(self, form: MatrixForm) -> None:
        self.form = form
        self.graph = form.graph

    def _vanishes(self, *nodes: Node) -> bool | None:
        return vanish(nodes, self.form)

    @cached_property
    def cyclic(self) -> tuple[int, ...]:
        """Coordinates that do not occur in L."""
        mask = self.form.written_lagrangian.mask
        return tuple(i for i, q in enumerate(self.form.q) if not q.mask & mask)

    # -- energy ---------------------------------------------------------------------------

    @cached_property
    def energy(self) -> Node:
        """h = sum q' p - L, as T + V where it is that."""
        form, graph = self.form, self.graph
        if self.is_total_energy:
            assert form.kinetic is not None
            assert form.potential is not None
            T, *_ = form.collected_lagrangian
            T = T if T is not form.written_lagrangian else form.expand_rates(form.kinetic)
            return graph.sum([T, form.expand_rates(form.potential)])
        return self._jacobi

    @cached_property
    def _jacobi(self) -> Node:
        form, graph = self.form, self.graph
        products = [graph.product(v, p) for v, p in zip(form.qdot, form.momenta, strict=True)]
        return graph.difference(graph.sum(products), form.written_lagrangian)

    @cached_property
    def is_total_energy(self) -> bool | None:
        """Whether h = T + V; None when only L is given."""
        form, graph = self.form, self.graph
        if form.kinetic is None or form.potential is None:
            return None
        total = form.expand_rates(graph.sum([form.kinetic, form.potential]))
        return self._vanishes(graph.difference(self._jacobi, total))

    @cached_property
    def powers(self) -> list[str]:
        """What changes h, in words; a constraint by its drift."""
        form, graph = self.form, self.graph
        applied = zip(form.applied_forces, form.qdot, strict=True)
        powers = {
            "L depends on t explicitly": partial(graph, form.t)(form.written_lagrangian),
            "the applied forces do work": graph.sum(graph.product(f, v) for f, v in applied),
        }
        moving = [
            constraint.name
            for constraint, row in zip(form.problem.constraints, form.constraints, strict=True)
            if self._vanishes(row.drift) is not True
        ]
        found = [cause for cause, power in powers.items() if self._vanishes(power) is not True]
        do = "move and do" if len(moving) > 1 else "moves and does"
        return found + [f"{constraints_named('the constraint', moving)} {do} work"] * bool(moving)

    @cached_property
    def energy_conserved(self) -> bool | None:
        """Whether dh/dt = 0 on the motion; None where that takes the solved motion."""
        if not self.powers:
            return True
        return None if self.form.constraints else False

    @property
    def energy_reason(self) -> str:
        """Why h is (not) conserved and is (not) T + V."""
        causes = enumerated(self.powers)
        conserved = {
            True: f"conserved: {CONSERVED}",
            False: f"not conserved: {causes}",
            None: f"whether it is conserved was not decided ({causes}): {_NOT_SOLVED}",
        }[self.energy_conserved]
        total = {
            True: "it equals T + V",
            False: "it differs from T + V",
            None: "it was not compared with T + V",
        }[self.is_total_energy]
        return f"{conserved}; {total}"

    # -- charges ----------------------------------------------------------------------------

    @cached_property
    def charges(self) -> tuple[LargeCharge, ...]:
        """Candidates in the order of the file, then cyclic coordinates, then the energy."""
        form, graph = self.form, self.graph
        candidates = [self._candidate(symmetry) for symmetry in form.problem.symmetries]
        cyclic = [
            self._judged(
                f"p_{form.q[i].name}", "cyclic", {form.q[i].name: graph.one}, graph.zero, graph.zero
            )
            for i in self.cyclic
        ]
        rate = graph.zero if self.energy_conserved else None
        energy = LargeCharge(
            "energy",
            "time",
            {"t": graph.one},
            graph.zero,
            self.energy,
            self.energy_conserved,
            rate,
            "50 digits" if self.energy_conserved is not None else None,
            "" if self.energy_conserved is not False else enumerated(self.powers),
        )
        return (*candidates, *cyclic, energy)

    def _candidate(self, symmetry: Symmetry) -> LargeCharge:
        """K = sum [L_q Dq + p (d(Dq)/dt - q' d(Dt)/dt)] + L_t Dt + L d(Dt)/dt."""
        form, graph, rate = self.form, self.graph, self.form.read.total_derivative
        changes = {name: form.read(change) for name, change in symmetry.changes.items()}
        time = graph.zero if symmetry.time is None else form.read(symmetry.time)
        lagrangian, stretch = form.written_lagrangian, rate(time)
        terms = [
            graph.product(partial(graph, form.t)(lagrangian), time),
            graph.product(lagrangian, stretch),
        ]
        for q, v, p in zip(form.q, form.qdot, form.momenta, strict=True):
            change = changes.get(q.name, graph.zero)
            along = graph.difference(rate(change), graph.product(v, stretch))
            terms += [graph.product(partial(graph, q)(lagrangian), change), graph.product(p, along)]
        gauge = None if symmetry.gauge is None else form.read(symmetry.gauge)
        if symmetry.time is not None:
            changes["t"] = time
        return self._judged(symmetry.name, "candidate", changes, gauge, graph.sum(terms))

    def _judged(
        self,
        name: str,
        source: ChargeSource,
        changes: Mapping[str, Node],
        gauge: Node | None,
        change: Node,
    ) -> LargeCharge:
        form, graph = self.form, self.graph
        time = changes.get("t", graph.zero)
        eta = [
            graph.difference(changes.get(q.name, graph.zero), graph.product(v, time))
            for q, v in zip(form.q, form.qdot, strict=True)
        ]
        boundary = graph.zero if gauge is None else gauge
        charge = graph.sum(
            [
                *(graph.product(p, e) for p, e in zip(form.momenta, eta, strict=True)),
                graph.product(form.written_lagrangian, time),
                graph.scaled(boundary, -1),
            ]
        )
        causes = {
            CHANGE_OF_L: graph.difference(change, form.read.total_derivative(boundary)),
            "the applied forces": graph.sum(
                graph.product(f, e) for f, e in zip(form.applied_forces, eta, strict=True)
            ),
        }
        across = [
            graph.sum(
                [
                    *(
                        graph.product(a, changes[q.name])
                        for a, q in zip(row.row, form.q, strict=True)
                        if q.name in changes
                    ),
                    graph.product(row.drift, time),
                ]
            )
            for row in form.constraints
        ]
        breaking = [cause for cause, part in causes.items() if self._vanishes(part) is not True]
        if not breaking and all(self._vanishes(part) is True for part in across):
            gauge = boundary
            conserved, rate = True, graph.zero
        elif form.constraints or (gauge is None and CHANGE_OF_L in breaking):
            conserved, rate = None, None  # the motion, or a boundary term, may make it 0
        else:
            rate = graph.sum(causes[cause] for cause in breaking)
            conserved = None if rate.mask & form.acceleration_mask else False
            rate = rate if conserved is False else None
        broken_by = enumerated(breaking) if conserved is False else ""
        how: Verification | None = None if conserved is None else "50 digits"
        return LargeCharge(name, source, changes, gauge, charge, conserved, rate, how, broken_by)
