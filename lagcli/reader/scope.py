"""The names of a problem and where each of them may be used."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

from lagcli.diagnostics import Span
from lagcli.expression import RESERVED
from lagcli.reader.habits import name_meant

Kind = Literal[
    "coordinate", "parameter", "function", "definition", "multiplier", "contact force", "observable"
]

#: The derivative order of what depends on no coordinate.
CONSTANT = -1


class Role(NamedTuple):
    """What an expression may contain, by the place at which it stands.

    `order` is the highest time derivative of a coordinate: 0 the coordinate itself, 1 the
    velocity, 2 the acceleration, -1 none at all.
    """

    order: int = 1
    why: str = ""  # the reason, for whoever wrote a higher derivative
    time: bool = True
    parameters: bool = True
    definitions: bool = True
    multipliers: bool = False
    momenta: bool = False
    contact_forces: bool = False
    observables: bool = False
    integrals: bool = False  # integral(f, x, a, b), as it may stand in an answer
    driven: bool = False  # t stands in the formula: an unknown omega is a constant


#: Terms of the Lagrangian, forces, definitions, constraints, transformations.
STATE = Role(why="it may depend on coordinates, velocities and t")
POSITION = Role(order=0, why="a position depends on coordinates and t only")
MASS = Role(order=0, why="a mass does not depend on velocities")
CONSTANTS = Role(order=CONSTANT, time=False, why="it is made of numbers and parameters")
VALUES = Role(
    order=CONSTANT,
    time=False,
    definitions=False,
    why="only numbers and parameters can stand here; formulas stand under 'definitions'",
)
INITIAL = VALUES._replace(
    why="only numbers and parameters can stand here; leave out what follows from a constraint"
)
NUMBERS = Role(
    order=CONSTANT,
    time=False,
    parameters=False,
    definitions=False,
    why="only a number can stand here, as in 10 or 1e-9",
)
QUESTION = Role(order=2, why="no law needs a third derivative", multipliers=True, momenta=True)
#: A column of a numerical run.
ALONG = QUESTION._replace(contact_forces=True)
#: An answer holds what is left when accelerations and multipliers have been eliminated.
ANSWER = Role(order=1, why="an answer is free of accelerations", integrals=True)
EQUATION = Role(order=2, why="the equations of motion are of second order", multipliers=True)
PHASE_SPACE = Role(order=0, why="a Hamiltonian has momenta p_x, no velocities", momenta=True)
MOTION = Role(order=CONSTANT, why="a trajectory depends on t and parameters")


class Growth(NamedTuple):
    """Levels of exponentials, and the degree in whatever has a name or is a call."""

    exponentials: int = 0
    degree: float = 0


SMALL = Growth()


@dataclass(slots=True, eq=False, repr=False)
class Definition:
    """What the scope knows of a definition."""

    place: int  # its rank in the file: earlier definitions may be used, later ones may not
    order: int = CONSTANT  # the highest time derivative of a coordinate in it
    time: bool = False  # whether t is in it
    growth: Growth = SMALL


@dataclass(slots=True, eq=False, repr=False)
class Scope:
    """The declared names."""

    kinds: dict[str, Kind] = field(default_factory=dict)
    spans: dict[str, Span] = field(default_factory=dict)
    arguments: dict[str, list[str]] = field(default_factory=dict)  # of the declared functions
    definitions: dict[str, Definition] = field(default_factory=dict)
    #: names that could not be declared: what is unknown afterwards may be one of them
    refused: list[str] = field(default_factory=list)

    #: coordinates to which a constraint gives a value
    held: set[str] = field(default_factory=set)

    #: the texts of values and definitions by their names
    formulas: dict[str, str] = field(default_factory=dict)

    #: the texts of T, V and H
    energies: dict[str, str] = field(default_factory=dict)

    #: what is written for a component of a point, `bob.x`, which has no name
    components: dict[str, str] = field(default_factory=dict)

    def of_kind(self, kind: Kind) -> Iterator[str]:
        """The names of one kind, in the order of their declaration."""
        return (name for name, other in self.kinds.items() if other == kind)

    @property
    def coordinates(self) -> list[str]:
        """The coordinates, in the order of their declaration."""
        return [*self.of_kind("coordinate")]

    def may_be(self, name: str) -> bool:
        """Whether a name that is unknown may be one that could not be declared.

        Beside L an energy V is another mistake, and hides no name but its own.
        """
        return name in self.refused or not {*self.refused} <= {"L", "T", "V"}

    @property
    def free(self) -> list[str]:
        """The coordinates to which no constraint gives a value; all where each has one."""
        return [x for x in self.coordinates if x not in self.held] or self.coordinates

    @contextmanager
    def also(self, names: Iterable[str], kind: Kind) -> Iterator[None]:
        """Let names stand in expressions that mean something there only, where they are free."""
        names = [n for n in dict.fromkeys(names) if n not in self.kinds and name_mistake(n) is None]
        self.kinds.update(dict.fromkeys(names, kind))
        try:
            yield
        finally:
            for name in names:
                del self.kinds[name]

    def coordinate_of_momentum(self, name: str) -> str | None:
        """`x` for `p_x`, when x is a coordinate."""
        coordinate = name.removeprefix("p_")
        known = name != coordinate and self.kinds.get(coordinate) == "coordinate"
        return coordinate if known else None

    @property
    def moving(self) -> tuple[str, ...]:
        """The definitions that depend on coordinates or on the time."""
        return tuple(n for n, one in self.definitions.items() if one.order > CONSTANT or one.time)

    def usable(self, role: Role) -> list[str]:
        """The names that may stand in an expression, for suggestions."""
        allowed: dict[Kind, bool] = {
            "coordinate": role.order >= 0,
            "parameter": role.parameters,
            "function": True,
            "definition": role.definitions,
            "multiplier": role.multipliers,
            "contact force": role.contact_forces,
            "observable": role.observables,
        }
        names = [name for name, kind in self.kinds.items() if allowed[kind]]
        if role.momenta:
            names += [f"p_{name}" for name in self.coordinates]
        return [*names, "pi", *(["t"] if role.time else [])]


def name_mistake(name: str, *, one: bool = False) -> tuple[str, str] | None:
    """Why `name` cannot be declared, and what to do; None when it can.

    `one` says that it is a single name, whatever blanks are in it.
    """
    if name in RESERVED:
        meaning = {"t": "the time", "pi": "the number", "diff": "the partial derivative"}
        meant = meaning.get(name, "a function")
        hint = f"choose another name: {name}_1"
        hint = f"leave it out, or {hint}" if name in meaning else hint
        return f"'{name}' is {meant} and cannot be declared", hint
    if quoted := re.fullmatch(r"[‘'’](\w+)['’‘]", name):
        return f"'{name}' is not a name", f"leave out the quotes: write {quoted[1]}"
    if not set("=>→(") & set(name) and any(prime in name for prime in "'’′″‴"):
        return f"'{name}' is not a name", "declare it without primes; x' is the velocity of x"
    if not name:
        return "a name is missing", ""
    if "\N{COMBINING DOT ABOVE}" in (bare := unicodedata.normalize("NFD", name)) and len(bare) == 2:
        return f"'{name}' is not a name", f"write {bare[0]}; its velocity is {bare[0]}'"
    if name[0].isdigit():
        better = name.lstrip("0123456789") + name[: -len(name.lstrip("0123456789"))]
        hint = "a name does not begin with a digit"
        return f"'{name}' is not a name", f"{hint}: write {better}" if better else hint
    if not all(each == "_" or each.isalpha() or each.isdecimal() for each in name):
        better = name_meant(name, one=one) or (
            "every name in full" if set(name) <= {".", "…"} else ""
        )
        if better and re.fullmatch(r"\w+\([\w, ]+\)", name):
            better += ", without arguments, also where it is used"
        message = f"'{name}' is not a name: a name has letters, digits and underscores"
        return message, f"write {better}" if better else ""
    return None
