"""What a process that is all lagcli's own can leave out, and a library cannot."""

from __future__ import annotations

import gc
import sys
from importlib import import_module
from types import ModuleType
from typing import Any

_TENSORS = "sympy.tensor.tensor"


def spare_tensors() -> None:
    """Put off SymPy's tensors until one is made, which here is never.

    The first sum of any SymPy process imports them, to ask whether a term is a tensor;
    with them come the permutation groups and all rotations of the Platonic solids, a
    tenth of SymPy's own start-up.  Until somebody asks for more than these two classes,
    no tensor can exist, and two empty classes answer the question rightly.
    """
    if _TENSORS not in sys.modules:
        sys.modules[_TENSORS] = _Tensors(_TENSORS)


class _Tensors(ModuleType):
    """In the place of SymPy's module; gives way to it at the first use of anything else."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.TensExpr = type("TensExpr", (), {})  # no object is one
        self.TensAdd = type("TensAdd", (), {})  # so none of these is made

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # the import system asks for these
            raise AttributeError(name)
        if sys.modules.get(_TENSORS) is self:
            del sys.modules[_TENSORS]
        real = import_module(_TENSORS)
        self.__dict__.update(real.__dict__)  # for whoever holds this one
        return getattr(real, name)


def collect_rarely() -> None:
    """Look for garbage after 200 000 new objects, not after each 700.

    What a start-up makes, SymPy's included, is less and lives to the end; the collector
    would walk over it again and again, a tenth of the time.
    """
    gc.set_threshold(200_000, 10, 10)


def keep_what_is_there() -> None:
    """Never look for garbage in what is there now: modules, which live to the end.

    Processes that are forked then share that memory, which no collector touches.
    """
    gc.freeze()
