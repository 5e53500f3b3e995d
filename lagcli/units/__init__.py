"""Units: what a file writes, what it means, and how one is printed."""

from lagcli.units.reading import UnitMistake, read_unit
from lagcli.units.unit import DIMENSIONLESS, Unit

__all__ = ["DIMENSIONLESS", "Unit", "UnitMistake", "read_unit"]
