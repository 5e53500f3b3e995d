"""The motions of single coordinates, each found once for all questions of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from sympy import Symbol

from lagcli.mechanics.finding.along_the_motion import AlongTheMotion

if TYPE_CHECKING:
    from lagcli.mechanics.finding.passing import Passing


class Passings(dict[Symbol, "Passing"]):
    """The motion of each coordinate that a question has asked for."""

    def __init__(self, along: AlongTheMotion) -> None:
        super().__init__()
        self.along = along

    def __missing__(self, u: Symbol) -> Passing:
        from lagcli.mechanics.finding.passing import Passing

        return self.setdefault(u, Passing(self.along, u))
