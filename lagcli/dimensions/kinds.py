"""What a dimension is called: an energy, a force, a moment of inertia."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

from lagcli.dimensions.forms import Form
from lagcli.dimensions.system import dimension_of
from lagcli.units import read_unit

_KINDS = {
    "1": ("a number", "numbers"),
    "m": ("a length", "lengths"),
    "s": ("a time", "times"),
    "kg": ("a mass", "masses"),
    "m^2": ("an area", "areas"),
    "m^3": ("a volume", "volumes"),
    "m/s": ("a velocity", "velocities"),
    "m/s^2": ("an acceleration", "accelerations"),
    "1/s": ("a frequency", "frequencies"),
    "1/s^2": ("a squared frequency", "squared frequencies"),
    "1/m": ("an inverse length", "inverse lengths"),
    "kg m/s": ("a momentum", "momenta"),
    "J s": ("an angular momentum", "angular momenta"),
    "kg m^2": ("a moment of inertia", "moments of inertia"),
    "N": ("a force", "forces"),
    "J": ("an energy", "energies"),
    "W": ("a power", "powers"),
    "N/m": ("a stiffness", "stiffnesses"),
    "kg/s": ("a damping coefficient", "damping coefficients"),
    "kg/m^3": ("a density", "densities"),
    "Pa": ("a pressure", "pressures"),
    "C": ("a charge", "charges"),
    "A": ("a current", "currents"),
    "V": ("a voltage", "voltages"),
    "V/m": ("an electric field", "electric fields"),
    "T": ("a magnetic field", "magnetic fields"),
}


def kind(form: Form, *, several: bool = False) -> str:
    """`an energy` or `energies`; empty where the dimension has no name."""
    found = _by_dimension().get(frozenset(form.items()))
    return found[several] if found else ""


@cache
def _by_dimension() -> dict[frozenset[tuple[object, Fraction]], tuple[str, str]]:
    return {
        frozenset(dimension_of(read_unit(unit)).items()): names for unit, names in _KINDS.items()
    }
