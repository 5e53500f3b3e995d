"""What the process of a command line can leave out, and the process of a library cannot."""

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

    class TensExpr:
        """No object is one."""

    class TensAdd:
        """Made only of terms that are tensors."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # the import system asks for these
            raise AttributeError(name)
        if sys.modules.get(_TENSORS) is self:
            del sys.modules[_TENSORS]
        return getattr(import_module(_TENSORS), name)


def keep_what_is_there() -> None:
    """Start to collect garbage, but never look for it in what the start-up has made.

    `lagcli.cli.run` has put the collector to rest: during imports it walks again and
    again over classes that live to the end, a tenth of SymPy's start-up.
    """
    gc.freeze()
    gc.set_threshold(50_000, 20, 20)
    gc.enable()
