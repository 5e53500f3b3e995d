"""The model of a run that shows every coordinate: what is integrated, what is done without.

Where the file can be run it is the requested run; where values are missing, the
structure, with every parameter some number that is not 0.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from itertools import compress
from typing import Any

from lagcli.expression import Name
from lagcli.graph.derivative import partial
from lagcli.graph.nodes import Node, Symbol, mask_of, with_values
from lagcli.graph.sharing import written_out
from lagcli.mechanics.identities import vanish
from lagcli.numerics.certified.ready_setup import ready_setup
from lagcli.numerics.equations.arithmetic import Doubles, UndefinedFunction
from lagcli.numerics.equations.constants import constants_of
from lagcli.numerics.equations.contact import with_contacts
from lagcli.numerics.equations.coupling import coupling, groups
from lagcli.numerics.equations.equations import EquationsOfMotion
from lagcli.numerics.equations.reduced_model import MOST, Reduction, cut
from lagcli.numerics.equations.refusal import Refusal
from lagcli.numerics.hybrid.request import RunRequest
from lagcli.problem_data import Problem
from lagcli.reader.columns import Column
from lagcli.statements.answers import ModelSection

_GIVEN = "the constraint '{}' determines it; a run that outputs its multiplier keeps both"
_INITIAL = "only the initial state depends on it"
_OWN_STEPS = "a long run gives each independent subsystem its own steps"
_IGNORABLE = "its momentum is conserved, but its velocity is needed, so it is integrated"


def model_section(problem: Problem) -> ModelSection:
    """What of the model is kept, eliminated, ignorable and dropped, and why.

    Raises
    ------
    Refusal
        Where the equations cannot be made without the algebra.
    """
    return _Model(problem).section()


class _Model:
    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.equations = e = EquationsOfMotion(with_contacts(problem))
        self.constants = self._numbers()
        names = {name.name for name in problem.initial}
        given = frozenset(j for j, symbol in enumerate(e.q) if symbol.name in names)
        self.barrier = self._barrier()
        #: what could be solved, and what is
        self.possible = Reduction(e, self.constants, given)
        self.reduction = self.possible if self._is_cut(given) else Reduction(e, {}, given, 0)

    def _numbers(self) -> Mapping[Symbol, Any]:
        e = self.equations
        with suppress(Refusal):
            return constants_of(e, self._dynamics, Doubles())
        names = [p.name for p in e.problem.parameters]
        return dict(zip(map(e.graph.symbol, names), _numbers(len(names)), strict=True))

    @property
    def _dynamics(self) -> list[Node]:
        e = self.equations
        return [*e.dynamics, *e.positions, *e.rates]

    def _barrier(self) -> str:
        """Why nothing at all is eliminated."""
        if any(c.holds_while is not None for c in self.equations.problem.constraints):
            return "nothing is eliminated from a model with a contact that may open"
        if self.equations.kinks:
            return "nothing is eliminated from equations with abs or sign"
        if len(self.equations.q) > MOST:
            return f"nothing is eliminated from more than {MOST} coordinates"
        return ""

    def _is_cut(self, given: frozenset[int]) -> bool:
        if self.barrier or not self.possible.solved:
            return False
        e = self.equations
        columns = [Column("t", None)]
        columns += [Column(q.name, Name(q.name, k)) for k in (0, 1) for q in e.q]
        request = RunRequest(until=1.0, accuracy=1e-9, samples=2, columns=tuple(columns))
        with suppress(Refusal):
            return ready_setup(self.problem, request)[0].cut is not None
        try:
            return cut(e, self.constants, [*e.q, *e.qdot], given) is not None
        except (ArithmeticError, UndefinedFunction):
            return False

    # -- what is said ----------------------------------------------------------------------------

    def section(self) -> ModelSection:
        e, solved = self.equations, self.reduction.solved
        formulas = written_out(
            [each.formula for each in solved],
            [*(p.name for p in self.problem.parameters), *(q.name for q in e.q)],
        )
        order = sorted(range(len(solved)), key=lambda i: solved[i].coordinate)
        kept = tuple(e.q[j].name for j in self.reduction.kept)
        ignorable = tuple(e.q[j].name for j in self.reduction.kept if self._is_ignorable(j))
        idle = dict(self._without_influence())
        reason = {
            **{
                e.q[solved[i].coordinate].name: _GIVEN.format(e.declared[solved[i].constraint].name)
                for i in order
            },
            **dict(self._held()),
            **dict(self._subsystems()),
            **idle,
        }
        for name in ignorable:
            reason[name] = f"{reason[name]}; {_IGNORABLE}" if name in reason else _IGNORABLE
        return ModelSection(
            kept=kept,
            eliminated={e.q[solved[i].coordinate].name: formulas[i] for i in order},
            ignorable=ignorable,
            dropped=tuple(name for name, why in idle.items() if why != _INITIAL),
            reason=reason,
        )

    def _held(self) -> Iterator[tuple[str, str]]:
        """The constraints that stay, by their names."""
        e = self.equations
        done = {each.constraint for each in self.reduction.solved}
        possible = {each.constraint for each in self.possible.solved}
        left = self.possible.rows()
        for k, declared in enumerate(e.declared):
            if k in done:
                continue
            if self.barrier:
                why = self.barrier
            elif k in left and vanish([*left[k].row, left[k].drift], e.form):
                yield declared.name, "kept with its multiplier, though it follows from the others"
                continue
            elif e.constraints[k].position is None:
                why = "it contains velocities"
            elif k in possible:
                why = "eliminating a coordinate with it would save no work"
            else:
                why = "it is not linear with a constant coefficient in a coordinate that is left"
            yield declared.name, f"kept with its multiplier: {why}"

    def _subsystems(self) -> Iterator[tuple[str, str]]:
        """The coordinates that move without some of the others."""
        e, reduction = self.equations, self.reduction
        if self.barrier or len(reduction.kept) < 2:
            return
        mass, forcing = reduction.matrices()
        rows = reduction.rows()
        left = [e.q[j] for j in reduction.kept]
        names = [q.name for q in left]
        parts = groups(*coupling(e.graph, left, mass, forcing, rows.values()))
        own = f", and {_OWN_STEPS}" if len(parts) > 1 else ""
        for j, name in zip(reduction.kept, names, strict=True):
            wanted = reduction.needed(mass, forcing, rows, [e.q[j], e.qdot[j]])
            others = [other for other in compress(names, wanted) if other != name]
            if len(others) + 1 < len(names):
                named = ", ".join(f"`{other}`" for other in others)
                depends = f"on {named} only" if others else "on no other coordinate"
                yield (
                    name,
                    f"its motion depends {depends}; a run that outputs less omits the others{own}",
                )

    def _is_ignorable(self, j: int) -> bool:
        """Whether neither L, nor a force, nor a constraint depends on it, with what is solved.

        So its momentum is conserved, and nothing depends on its value.
        """
        e, reduction = self.equations, self.reduction
        q, zero = e.q[j], e.graph.zero
        moved = [j, *(s.coordinate for s in reduction.solved if s.formula.mask & q.mask)]
        if any(e.form.applied_forces[i] is not zero for i in moved):
            return False
        place, rows = reduction.kept.index(j), reduction.rows().values()
        if any(row.row[place] is not zero for row in rows):
            return False
        nodes = [reduction.put(node) for node in (e.lagrangian, *e.form.applied_forces)]
        nodes += [node for row in rows for node in (row.drift, *row.row)]
        return vanish([partial(e.graph, q)(node) for node in nodes], e.form) is True

    def _without_influence(self) -> Iterator[tuple[str, str]]:
        """The parameters that no equation of motion names, not even through others' values."""
        e, problem = self.equations, self.problem
        read = e.form.read
        impacts = [read(c.restitution) for c in e.problem.constraints if c.restitution]
        limits = [c.holds_while for c in e.problem.constraints if c.holds_while]
        conditions = [read(side) for limit in limits for side in (limit.left, limit.right)]
        named = {e.graph.symbol(name): read(formula) for name, formula in problem.named.items()}
        values = {**e.parameter_values, **named}
        mask = with_values(mask_of([*self._dynamics, *impacts, *conditions]), values)
        starts = with_values(mask_of(read(x) for x in problem.initial.values()), values)
        for parameter in problem.parameters:
            symbol = e.graph.symbol(parameter.name)
            if not symbol.mask & mask:
                started = symbol.mask & starts
                yield parameter.name, _INITIAL if started else "no equation of motion depends on it"


def _numbers(count: int) -> list[float]:
    """Numbers between 1 and 2 in no relation to each other."""
    return [1 + math.sqrt(2) * (1 + i) ** 1.5 % 1 for i in range(count)]
