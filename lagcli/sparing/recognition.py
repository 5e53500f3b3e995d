"""Classes that SymPy names only to recognise their objects, and functions that it seldom calls.

Each sum is searched for tensors, each product for matrices, each sine for an interval below it,
and the table of numerical methods has a row for integrals.  As long as nobody has imported
tensors there are none, so an empty class does.  It is handed to those functions alone, and
makes an object of the real class when it is called; whoever else asks imports the module.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module
from itertools import count
from types import FrameType, ModuleType
from typing import Any

#: Where those classes and functions are; those of packages come by `stand_in_for`.
_MODULES = (
    "sympy.calculus.accumulationbounds",
    "sympy.concrete.products",
    "sympy.concrete.summations",
    "sympy.functions.special.polynomials",
    "sympy.integrals.integrals",
    "sympy.matrices.expressions.matexpr",
    "sympy.matrices.matrixbase",
    "sympy.sets.setexpr",
    "sympy.tensor.tensor",
)
_OF_PACKAGES = frozenset("AccumBounds Array MatrixExpr NDimArray minimal_polynomial".split())
#: What asks for them, to recognise an object or for a case that seldom comes.
_ASKING = frozenset(
    "__new__ flatten eval count_ops _derivative_dispatch _eval_derivative_n_times "
    "_create_evalf_table _eval_is_extended_positive_negative".split()
)
_ASKING_IN = ("sympy.core.", "sympy.functions.elementary.")
#: The imports cost as much as so many stand-ins: 56 ms for all, 3.5 µs for each.
_MOST_ASKINGS = 16_000
_asked = count()
#: By the place of the function's code, which stays where it is.
_suffice: dict[int, bool] = {}


def recognise_without_importing() -> None:
    """Put modules in place that are imported when one asks who needs more."""
    for name in _MODULES:
        sys.modules.setdefault(name, _Unread(name))


def stand_in_for(package: str, name: str, module: str, asking: FrameType | None) -> Any:
    """The stand-in of a name of a package; None where the frame that asks needs the real one.

    `module` is where the name comes from.
    """
    unread = isinstance(sys.modules.get(module), _Unread | None)
    if unread and name in _OF_PACKAGES and _suffices(asking):
        return _stand_in(package, name)
    return None


class _StandIn(type):
    """The class of classes that have no object and are made on a call."""

    def __call__(cls, *arguments: Any, **options: Any) -> Any:
        return getattr(import_module(cls.__module__), cls.__name__)(*arguments, **options)


@cache
def _stand_in(module: str, name: str) -> Any:
    return _StandIn(name, (), {"__module__": module})


def _suffices(asking: FrameType | None) -> bool:
    """Whether a stand-in is enough for the function that imports a name just now."""
    while asking is not None and "importlib" in asking.f_code.co_filename:
        asking = asking.f_back
    if asking is None or next(_asked) >= _MOST_ASKINGS:
        return False
    known = _suffice.get(id(asking.f_code))
    if known is None:
        inside = asking.f_globals["__name__"].startswith(_ASKING_IN)
        known = _suffice[id(asking.f_code)] = inside and asking.f_code.co_name in _ASKING
    return known


class _Unread(ModuleType):
    """A module that nobody has imported yet."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if sys.modules.get(self.__name__) is self:
            if _suffices(sys._getframe(1)):  # noqa: SLF001
                return _stand_in(self.__name__, name)
            del sys.modules[self.__name__]
            _give_numerical_methods(import_module(self.__name__))
        return getattr(sys.modules[self.__name__], name)


def _give_numerical_methods(module: ModuleType) -> None:
    """Move the rows of stand-ins in SymPy's table of numerical methods to the real classes."""
    table = getattr(sys.modules.get("sympy.core.evalf"), "evalf_table", {})
    for each in [c for c in table if isinstance(c, _StandIn) and c.__module__ == module.__name__]:
        table[getattr(module, each.__name__)] = table.pop(each)
