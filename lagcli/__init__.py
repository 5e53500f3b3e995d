"""Lagrangian mechanics: from a problem in YAML to equations, multipliers and charges."""

from __future__ import annotations

TYPE_CHECKING = False  # what `typing` has, without the time that it takes to load
if TYPE_CHECKING:
    from lagcli.interface import (
        Account,
        Formula,
        Motion,
        Problem,
        ProblemError,
        Refusal,
        Report,
        Solution,
        Sweep,
        check,
        explain,
        load,
        loads,
        problem,
        simulate,
        solve,
        sweep,
    )
    from lagcli.interface.magic import load_ipython_extension

__version__ = "0.1.0"
__all__ = [
    "Account", "Formula", "Motion", "Problem", "ProblemError", "Refusal", "Report", "Solution",
    "Sweep", "__version__", "check", "explain", "load", "load_ipython_extension", "loads",
    "problem", "simulate", "solve", "sweep",
]  # fmt: skip


def __getattr__(name: str) -> object:
    """A public name, loaded when it is first used: `import lagcli` costs nothing."""
    if name == "load_ipython_extension":
        from lagcli.interface.magic import load_ipython_extension

        return load_ipython_extension
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from lagcli import interface

    return getattr(interface, name)


def __dir__() -> list[str]:
    return sorted(__all__)
