"""The sections of a system too large for simplified formulas, from its structure.

Formulas are written out as the structure has them while they are not too long; what would
need the motion solved, or would fill books, is null with a line that says so.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from lagcli.answers import (
    AccelerationsSection,
    CanonicalSection,
    Charge,
    ChargesSection,
    ConstraintForcesSection,
    ConstraintKind,
    EnergySection,
    EquationsSection,
    EquilibriaSection,
    HamiltonianSection,
    LagrangeEquation,
    LagrangianSection,
    MatrixFormSection,
    ModesSection,
    MomentaSection,
    Multiplier,
    MultipliersSection,
    Section,
)
from lagcli.expression import ZERO, Expression
from lagcli.graph.nodes import Node
from lagcli.graph.sharing import operations, with_shared_parts, written_out
from lagcli.mechanics.large_charges import LargeCharge, LargeCharges
from lagcli.mechanics.matrix_form import MatrixForm
from lagcli.mechanics.stating import Stating
from lagcli.problem import Rewrite, Where
from lagcli.questions import FindSection, Ranges, Rewritten, Solutions

#: A section whose formulas show more operations than this is not written out.
WRITTEN_OPERATIONS = 100_000

_WHY = "the system is too large for formulas"


class LargeStatements(Stating):
    """The sections of one large system."""

    def __init__(self, form: MatrixForm) -> None:
        super().__init__(form.problem, _WHY)
        self.form = form
        self.charges = LargeCharges(form)
        names = (*self.problem.parameters, *self.problem.coordinates)
        self.order = tuple(quantity.name for quantity in names)

    @property
    def makers(self) -> Mapping[str, Callable[[], Section]]:
        """What makes each section, by its name."""
        return {
            "lagrangian": self._lagrangian,
            "equations": self._equations,
            "matrix_form": self._matrix_form,
            "accelerations": self._accelerations,
            "multipliers": self._multipliers,
            "constraint_forces": self._constraint_forces,
            "momenta": self._momenta,
            "energy": self._energy,
            "hamiltonian": self._hamiltonian,
            "canonical_equations": self._canonical_equations,
            "charges": self._charges,
            "find": self._find,
            "equilibria": self._equilibria,
            "modes": self._modes,
        }

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates less the rank of all constraints on the velocities."""
        return self.form.degrees_of_freedom

    def _written(self, what: str, nodes: Sequence[Node]) -> tuple[Expression, ...] | None:
        """The nodes written out; None with a warning where that would be too long."""
        count = operations(nodes)
        if count <= WRITTEN_OPERATIONS:
            return written_out(nodes, self.order)
        self.complete = False
        self.warnings.append(
            f"{what} written out would show {count:,} operations; --show matrix_form gives the "
            "equations of motion with their common parts named"
        )
        return None

    # -- what is written out ------------------------------------------------------------------

    def _lagrangian(self) -> LagrangianSection:
        found = self._written("the Lagrangian", [self.form.written_lagrangian])
        return LagrangianSection(lagrangian=None if found is None else found[0])

    def _equations(self) -> EquationsSection:
        """M q'' - (L_q - …) = Q - dD/dq' + A^T lambda."""
        form, graph = self.form, self.form.graph
        forces = [graph.symbol(c.multiplier) for c in self.problem.constraints]
        left = [
            graph.sum(
                [
                    *(graph.product(m, a) for m, a in zip(row, form.qddot, strict=True)),
                    graph.scaled(inertial, -1),
                ]
            )
            for row, inertial in zip(form.mass_matrix, form.inertial, strict=True)
        ]
        right = [
            graph.sum(
                [
                    applied,
                    *(
                        graph.product(row.row[i], force)
                        for row, force in zip(form.constraints, forces, strict=True)
                    ),
                ]
            )
            for i, applied in enumerate(form.applied_forces)
        ]
        found = self._written("the equations", [*left, *right, *(r.f for r in form.constraints)])
        if found is None:
            return EquationsSection(equations=None)
        n = len(form.q)
        return EquationsSection(
            equations=tuple(
                LagrangeEquation(coordinate=q.name, left=one, right=other)
                for q, one, other in zip(form.q, found[:n], found[n : 2 * n], strict=True)
            ),
            constraints={
                c.name: (f, ZERO)
                for c, f in zip(self.problem.constraints, found[2 * n :], strict=True)
            },
        )

    def _matrix_form(self) -> MatrixFormSection:
        form, n, m = self.form, len(self.form.q), len(self.form.constraints)
        found = with_shared_parts(form.entries, self.order, self._taken)
        self._reserved |= found.named.keys()
        entries = iter(found.roots)

        def rows(count: int, width: int) -> tuple[tuple[Expression, ...], ...]:
            return tuple(tuple(next(entries) for _ in range(width)) for _ in range(count))

        mass_matrix, [forcing] = rows(n, n), rows(1, n)
        jacobian, [bias] = rows(m, n), rows(1, m)
        return MatrixFormSection(
            mass_matrix=mass_matrix,
            constraint_jacobian=jacobian,
            forcing=forcing,
            constraint_bias=bias,
            shared=found.named,
        )

    def _matrix_form_of_problem(self) -> MatrixForm:
        return self.form

    def _momenta(self) -> MomentaSection:
        names = [q.name for q in self.form.q]
        found = self._written("the momenta", self.form.momenta)
        return MomentaSection(
            momenta=None if found is None else dict(zip(names, found, strict=True)),
            cyclic=tuple(names[i] for i in self.charges.cyclic),
        )

    def _energy(self) -> EnergySection:
        charges = self.charges
        found = self._written("the energy", [charges.energy])
        return EnergySection(
            function=None if found is None else found[0],
            conserved=charges.energy_conserved,
            is_total_energy=charges.is_total_energy,
            reason=charges.energy_reason,
        )

    def _charges(self) -> ChargesSection:
        charges = self.charges.charges
        undecided = [f"'{charge.name}'" for charge in charges if charge.conserved is None]
        if undecided:
            self._missing(f"whether conserved: {', '.join(undecided)}")
        return ChargesSection(charges=tuple(map(self._charge, charges)))

    def _charge(self, charge: LargeCharge) -> Charge:
        what = f"the charge '{charge.name}'"
        shown = self._written(what, [charge.charge])
        rate = None if charge.rate is None else self._written(f"the rate of {what}", [charge.rate])
        gauge = None if charge.gauge is None else self._written(what, [charge.gauge])
        changes = written_out(tuple(charge.changes.values()), self.order)
        return Charge(
            name=charge.name,
            source=charge.source,
            transformation=dict(zip(charge.changes, changes, strict=True)),
            gauge=None if gauge is None else gauge[0],
            conserved=charge.conserved,
            charge=None if shown is None else shown[0],
            rate=None if rate is None else rate[0],
            verified=charge.verified,
            broken_by=charge.broken_by,
        )

    # -- what is not found ----------------------------------------------------------------------

    def _accelerations(self) -> AccelerationsSection:
        found = self._abbreviated_accelerations()
        if found is None:
            self._unsolved(_WHY)
        return found or AccelerationsSection(accelerations=None)

    def _multipliers(self) -> MultipliersSection:
        kinds: list[ConstraintKind | None] = [
            "holonomic" if row.holonomic else None for row in self.form.constraints
        ]
        solved = self._abbreviated_multipliers(kinds)
        if solved is not None:
            return solved
        self._unsolved(_WHY)
        form, kept = self.form, set(self.form.independent)
        constraints = self.problem.constraints
        redundant = tuple(c.name for k, c in enumerate(constraints) if k not in kept)
        self._note_redundant(redundant)
        return MultipliersSection(
            multipliers={
                c.name: Multiplier(
                    symbol=c.multiplier, value=None, kind="holonomic" if row.holonomic else None
                )
                for c, row in zip(constraints, form.constraints, strict=True)
            },
            redundant=redundant,
        )

    def _constraint_forces(self) -> ConstraintForcesSection:
        if self.problem.constraints:
            found = self._abbreviated_forces()
            if found is not None:
                return found
            self._unsolved(_WHY)
        return ConstraintForcesSection(
            forces={c.name: None for c in self.problem.constraints}, total=None
        )

    def _hamiltonian(self) -> HamiltonianSection:
        found = self._abbreviated_hamiltonian()
        if found is not None:
            return found
        self._missing("the Hamiltonian")
        return HamiltonianSection(hamiltonian=None, reason=_WHY)

    def _canonical_equations(self) -> CanonicalSection:
        self._missing("the canonical equations")
        return CanonicalSection(equations=None, reason=_WHY)

    def _find(self) -> FindSection:
        for question in self.problem.find:
            self._missing(f"the answer to '{question.name}'")
        return FindSection(
            answers={
                question.name: Solutions(unknown=str(question.unknown), solutions=None, note=_WHY)
                if isinstance(question, Where)
                else Rewritten(value=None, note=_WHY)
                if isinstance(question, Rewrite)
                else Ranges(unknown=str(question.unknown), ranges=None, note=_WHY)
                for question in self.problem.find
            }
        )

    def _equilibria(self) -> EquilibriaSection:
        self._missing("the equilibria")
        return EquilibriaSection(equilibria=None, reason=_WHY)

    def _modes(self) -> ModesSection:
        self._missing("the normal modes")
        return ModesSection(modes=None, reason=_WHY)
