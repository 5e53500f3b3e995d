"""What a process that is all lagcli's own can leave out, and a library cannot.

`import sympy` imports four hundred modules, of which a derivation uses some hundred and
fifty: two thirds of its time are matrices, integrals, sets of solutions, geometry, plots.
A process that derives one small system spends most of its life there.  So SymPy's packages
hand out their names when these are used, and whatever is used is SymPy's own.  `lagcli solve
hoop` then takes 1.3 times the processor time of `import sympy`, and 1.5 times without.
"""

from __future__ import annotations

import gc
import os

__all__ = ["collect_rarely", "keep_what_is_there", "spare_sympy"]


def spare_sympy() -> None:
    """Import of SymPy what a derivation needs, the rest when it is first used.

    Nothing is spared with `LAGCLI_WHOLE_SYMPY` set, with SymPy imported already, or with a
    version that this was not made for: all works as well, and starts more slowly.
    """
    from lagcli.sparing.packages import known_sympy, serve_names_lazily, serve_singletons_lazily
    from lagcli.sparing.recognition import recognise_without_importing

    if not os.environ.get("LAGCLI_WHOLE_SYMPY") and known_sympy():
        serve_names_lazily()
        recognise_without_importing()
        serve_singletons_lazily()


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
