"""A random system: its file, and what is known of it by construction."""

from __future__ import annotations

from dataclasses import dataclass, field

MAIN = (
    "lagrangian", "equations", "matrix_form", "accelerations", "multipliers",
    "constraint_forces", "momenta", "energy", "charges",
)  # fmt: skip
CANONICAL = ("hamiltonian", "canonical_equations")
REST = ("equilibria", "modes")


@dataclass(kw_only=True)
class System:
    """The parts of a file as text, and under `known` what its answers must be.

    `known` may hold `conserved` (symmetry -> bool), `constraint_kinds`, `frequencies_squared`
    (formulas, with the equilibrium `at`), `equilibria` (a list of places), `complete`,
    `discovered` (formulas that must be among the charges), `valid` (False: to be refused),
    `answers` (to `find`, each a list of formulas).
    """

    kind: str = ""
    seed: int = 0
    coordinates: dict[str, str | None]
    parameters: dict[str, str | None] = field(default_factory=dict)
    values: dict[str, str] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    functions: dict[str, list[str]] = field(default_factory=dict)
    definitions: dict[str, str] = field(default_factory=dict)
    points: dict[str, tuple[list[str], str]] = field(default_factory=dict)
    T: str | None = None
    V: str | None = None
    L: str | None = None
    H: str | None = None
    forces: dict[str, str] = field(default_factory=dict)
    dissipation: str | None = None
    constraints: dict[str, str] = field(default_factory=dict)
    symmetries: dict[str, dict[str, str]] = field(default_factory=dict)
    observables: dict[str, str] = field(default_factory=dict)
    canonical: dict[str, dict[str, str]] = field(default_factory=dict)
    more: str = ""
    sections: tuple[str, ...] = MAIN
    known: dict = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The file."""
        lines = ["coordinates:", *_attributed(self.coordinates, {}, self.units)]
        if self.parameters:
            lines += ["parameters:", *_attributed(self.parameters, self.values, self.units)]
        if self.functions:
            lines += ["functions:"]
            lines += [f"  {name}: [{', '.join(of)}]" for name, of in self.functions.items()]
        lines += _block("definitions", self.definitions)
        if self.points:
            lines += ["points:"]
        for name, (position, mass) in self.points.items():
            where = ", ".join(f'"{each}"' for each in position)
            lines += [f'  {name}: {{position: [{where}], mass: "{mass}"}}']
        for key in ("T", "V", "L", "H", "dissipation"):
            if getattr(self, key) is not None:
                lines += [f'{key}: "{getattr(self, key)}"']
        lines += _block("forces", self.forces)
        lines += _block("constraints", self.constraints)
        lines += _maps("symmetries", self.symmetries)
        lines += _block("observables", self.observables)
        lines += _maps("canonical_transformations", self.canonical)
        return "\n".join(lines) + "\n" + self.more


def _block(key, entries):
    return [f"{key}:", *(f'  {name}: "{value}"' for name, value in entries.items())] * bool(entries)


def _maps(key, entries):
    lines = [f"{key}:"] * bool(entries)
    for name, values in entries.items():
        inside = ", ".join(f'{key}: "{value}"' for key, value in values.items())
        lines.append(f"  {name}: {{{inside}}}")
    return lines


def _attributed(entries, values, units):
    lines = []
    for name, assume in entries.items():
        given = {"assume": assume, "value": values.get(name), "unit": units.get(name)}
        inside = ", ".join(f"{key}: {value}" for key, value in given.items() if value)
        lines.append(f"  {name}: {{{inside}}}" if inside else f"  {name}:")
    return lines
