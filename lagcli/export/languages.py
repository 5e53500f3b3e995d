"""The languages by name, each with the ending of its files and what writes one.

Formulas are printed by SymPy's code printers; Modelica, which has none, by its plain one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from lagcli.export import c, fortran, julia, mathematica, matlab, modelica, python, sympy_matrices
from lagcli.export.routines import Code

Writer = Callable[[Code], Iterator[str]]

LANGUAGES: dict[str, tuple[str, Writer]] = {
    "python": (".py", python.write),
    "c": (".c", c.write),
    "julia": (".jl", julia.write),
    "fortran": (".f90", fortran.write),
    "matlab": (".m", matlab.write),
    "modelica": (".mo", modelica.write),
    "sympy": (".py", sympy_matrices.write),
    "mathematica": (".wl", mathematica.write),
}


def render(code: Code, language: str) -> str:
    """The file of a problem in a language.

    Raises
    ------
    NoCode
        When the language needs solved accelerations and there are none.
    KeyError
        When there is no such language.
    """
    return "\n".join(LANGUAGES[language][1](code)) + "\n"
