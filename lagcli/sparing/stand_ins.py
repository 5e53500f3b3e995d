"""Names that SymPy's core asks for on its way, and hardly ever uses.

The first sum of a process asks whether a term is a tensor, the first product whether a
factor is a matrix, the first derivative whether it is taken by an array; the factorials
know polynomials, and sines symmetric ones.  A stand-in answers `isinstance` with no as
long as the real class is not imported, for then no object is one; called, asked for an
attribute or inherited from it imports the real thing and hands it on.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import Any

from lagcli.sparing.packages import import_matrices

#: Until the end of the process, or their first use.
_STANDING = {
    "sympy.tensor.tensor": "TensExpr TensAdd",
    "sympy.tensor.array.ndim_array": "NDimArray",
    "sympy.calculus.accumulationbounds": "AccumBounds AccumulationBounds",
    "sympy.matrices.matrixbase": "MatrixBase",
    "sympy.matrices.expressions.matexpr": "MatrixExpr",
    "sympy.concrete.products": "Product",
    "sympy.concrete.summations": "Sum",
    "sympy.integrals.integrals": "Integral",
    "sympy.functions.special.polynomials": "chebyshevt chebyshevu",
    "sympy.assumptions.ask": "ask Q",
    "sympy.polys.numberfields.minpoly": "minimal_polynomial minpoly",
}
#: While SymPy's functions are imported, which take these names along.
_PASSING = {
    "sympy.polys.polytools": "Poly cancel",
    "sympy.polys.specialpolys": "symmetric_poly",
    "sympy.polys.appellseqs": "bernoulli_poly euler_poly genocchi_poly",
    "sympy.ntheory.partitions_": "_partition _partition_rec",
    "sympy.ntheory.residue_ntheory": "binomial_mod",
    "sympy.ntheory.factor_": (
        "factorint _divisor_sigma is_carmichael find_carmichael_numbers_in_range "
        "find_first_n_carmichaels multiplicity perfect_power factorrat trailing"
    ),
}
_FUNCTIONS = ("exponential", "trigonometric", "hyperbolic", "complexes", "integers", "piecewise")
#: Only these are given stand-ins, whoever else asks wants the real thing.
_ASKERS = ("sympy.core", "sympy.functions", "sympy.assumptions.wrapper")
#: `evalf` finds its ways in a table by class, made when the first number is asked for.
_IN_TABLE = ("sympy.concrete.products", "sympy.concrete.summations", "sympy.integrals.integrals")


def stand_in() -> None:
    """Put the stand-ins in the places of their modules."""
    for name, names in _STANDING.items():
        sys.modules[name] = _Module(name, names.split())


def import_functions() -> None:
    """Import the elementary functions without the number theory behind some others."""
    import_module("sympy.core")
    import_module("sympy.ntheory.generate")
    for name, names in _PASSING.items():
        sys.modules[name] = _Module(name, names.split())
    for name in _FUNCTIONS:
        import_module(f"sympy.functions.elementary.{name}")
    for name in _PASSING:
        if isinstance(sys.modules[name], _Module):
            del sys.modules[name]


class _Module(ModuleType):
    """In the place of a module; gives way to it at the first use."""

    def __init__(self, name: str, names: list[str]) -> None:
        super().__init__(name)
        self.__dict__["_stand_ins"] = {each: StandIn(self, each) for each in names}

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # the import system asks for these
            raise AttributeError(name)
        stand_ins = self.__dict__["_stand_ins"]
        if name in stand_ins and _asker().startswith(_ASKERS):
            return stand_ins[name]
        return getattr(self._real(), name)

    def _real(self) -> ModuleType:
        name = self.__name__
        if sys.modules.get(name) is not self:
            return import_module(name)
        del sys.modules[name]
        if name.startswith("sympy.matrices."):
            import_matrices()
        real = import_module(name)
        package, _, last = name.rpartition(".")
        if sys.modules[package].__dict__.get(last) is self:
            setattr(sys.modules[package], last, real)
        self.__dict__.update(real.__dict__)  # for whoever holds this one
        if name in _IN_TABLE:
            from sympy.core import evalf

            evalf.evalf_table.clear()
        return real


def _asker() -> str:
    """The module that asks, not counting those of this package."""
    frame = sys._getframe(2)  # noqa: SLF001 - as `warnings` and `logging` find their callers
    while frame.f_globals["__name__"].startswith(("lagcli.sparing", "importlib")) and frame.f_back:
        frame = frame.f_back
    return str(frame.f_globals["__name__"])


class StandIn:
    """A class or function of a module that is not imported yet."""

    stands_in = True

    def __init__(self, module: _Module, name: str) -> None:
        self._module, self._name = module, name

    @property
    def _real(self) -> Any:
        return getattr(self._module._real(), self._name)  # noqa: SLF001 - the two are one

    @property
    def _is_there(self) -> bool:
        return sys.modules.get(self._module.__name__) not in (None, self._module)

    def __call__(self, *args: Any, **options: Any) -> Any:
        """What the real one gives."""
        return self._real(*args, **options)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self._real, name)

    def __instancecheck__(self, instance: object) -> bool:
        return self._is_there and isinstance(instance, self._real)

    def __subclasscheck__(self, subclass: type) -> bool:
        return self._is_there and issubclass(subclass, self._real)

    def __mro_entries__(self, bases: tuple[Any, ...]) -> tuple[type, ...]:
        del bases
        return (self._real,)
