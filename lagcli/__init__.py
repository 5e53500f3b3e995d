"""Lagrangian mechanics: from a problem in YAML to equations, multipliers and charges."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lagcli.mechanics.derivation import Derivation
    from lagcli.pipeline import load, solve
    from lagcli.problem import Problem

__version__ = "0.1.0"
__all__ = ["Derivation", "Problem", "__version__", "load", "solve"]

#: Where each public name lives: loaded when first used, so `import lagcli` costs nothing.
_HOMES = {
    "Derivation": "lagcli.mechanics.derivation",
    "Problem": "lagcli.problem",
    "load": "lagcli.pipeline",
    "solve": "lagcli.pipeline",
}


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
