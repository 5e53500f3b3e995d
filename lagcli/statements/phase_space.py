"""Statements on phase space: Poisson brackets and canonical transformations."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from lagcli.expression import Call, Expression, walk
from lagcli.record import record


@record(kw_only=True)
class PoissonBracket:
    """{left, right} with {q, p} = 1; `value` in q, p, t, `named` by observables if it is one."""

    name: str
    left: Expression
    right: Expression
    value: Expression | None
    named: Expression | None = None


@record(kw_only=True)
class BracketsSection:
    """Observables in q, p, t, their brackets, and dA/dt = {A, H} + the derivative by t.

    `rates` are on the motion without constraints, forces and dissipation, None where the
    file has some or there is no H.
    """

    observables: Mapping[str, Expression]
    brackets: tuple[PoissonBracket, ...]
    rates: Mapping[str, Expression] | None
    reason: str = ""


@record(kw_only=True)
class FailingBracket:
    """{left, right} of new variables, which is `value` and should be `expected`."""

    left: str
    right: str
    value: Expression
    expected: Expression


@record(kw_only=True)
class GeneratingFunction:
    """F1 to F4 as given, or (`kind` "F") F(q, p, t) with c p dq - P dQ = dF as found.

    `failing` are the relations left = right that its derivatives do not obey.
    """

    kind: Literal["F1", "F2", "F3", "F4", "F"]
    function: Expression
    generates: bool | None
    failing: tuple[tuple[Expression, Expression], ...] = ()


@record(kw_only=True)
class ExaminedTransformation:
    """New variables by name, the kind, the valence c, and K in the new variables.

    `kind` None: undecided.  `hamiltonian` None: not found, for the `reason`, or there is none
    because the transformation is not canonical.  `in_general`: it may be canonical for some values
    of the parameters, where it is not for others.
    """

    name: str
    variables: Mapping[str, Expression]
    kind: Literal["canonical", "extended canonical", "not canonical"] | None
    valence: Expression | None
    verified: Literal["exact", "50 digits"] | None
    failing: tuple[FailingBracket, ...] = ()
    in_general: bool = False
    generator: GeneratingFunction | None = None
    hamiltonian: Expression | None = None
    hamiltonian_verified: Literal["exact", "50 digits"] | None = None
    reason: str = ""

    @property
    def branch(self) -> str:
        """To which values of many-valued functions `hamiltonian` belongs, in words."""
        tree = () if self.hamiltonian is None else walk(self.hamiltonian)
        called = {node.function for node in tree if isinstance(node, Call)}
        many = not called.isdisjoint(("asin", "acos", "atan", "atan2", "acosh"))
        return " for the principal values of inverse functions" if many else ""


@record(kw_only=True)
class TransformationsSection:
    """The transformations of the file, tested."""

    transformations: tuple[ExaminedTransformation, ...]
