"""Names that SymPy's core asks for on its way, and hardly ever uses.

The first sum of a process asks whether a term is a tensor, the first product whether a
factor is a matrix, the first derivative whether it is taken by an array; the factorials
know polynomials, and sines symmetric ones.  A stand-in answers `isinstance` with no as
long as the real class is not imported, for then no object is one; called, asked for an
attribute or inherited from it imports the real thing and hands it on.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib import import_module
from types import ModuleType
from typing import Any

from lagcli.sparing.packages import LazyPackage, import_matrices

#: Until the end of the process, or their first use.
_STANDING = {
    "sympy.tensor.tensor": "TensExpr TensAdd",
    "sympy.tensor.array.ndim_array": "NDimArray",
    "sympy.tensor.array.dense_ndim_array": "ImmutableDenseNDimArray",
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
    _give_way(_PASSING)  # the functions keep what they took along


def give_way() -> None:
    """Let whoever asks from now on import the real thing."""
    _give_way(_STANDING)
    evalf = sys.modules.get("sympy.core.evalf")
    if evalf is not None:
        evalf.evalf_table.clear()


def _give_way(names: Iterable[str]) -> None:
    modules = [sys.modules.pop(n) for n in names if isinstance(sys.modules.get(n), _Module)]
    for module in modules:
        for each in vars(module).values():
            if isinstance(each, StandIn):
                each.left = True
    for package in [m for m in sys.modules.values() if isinstance(m, LazyPackage)]:
        for name, value in list(vars(package).items()):
            if isinstance(value, StandIn) or any(value is m for m in modules):
                package.__dict__.pop(name, None)


class _Module(ModuleType):
    """In the place of a module; all of them give way when more is used."""

    def __init__(self, name: str, names: list[str]) -> None:
        super().__init__(name)
        for each in names:
            self.__dict__[each] = StandIn(name, each)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # the import system asks for these
            raise AttributeError(name)
        return getattr(_real(self.__name__), name)


def _real(name: str) -> ModuleType:
    """The module, imported now if nobody has used it yet."""
    if isinstance(sys.modules.get(name), _Module):
        if name in _STANDING:
            give_way()
        else:
            _give_way([name])
    if name.startswith("sympy.matrices."):
        import_matrices()
    return import_module(name)


class StandIn:
    """A class or function of a module that is not imported yet."""

    def __init__(self, module: str, name: str) -> None:
        self.place = (module, name)
        self.left = False

    @property
    def real_thing(self) -> Any:
        """What it stands for."""
        module, name = self.place
        return getattr(_real(module), name)

    def __call__(self, *args: Any, **options: Any) -> Any:
        """What the real one gives."""
        return self.real_thing(*args, **options)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self.real_thing, name)

    def __instancecheck__(self, instance: object) -> bool:
        return self.left and isinstance(instance, self.real_thing)

    def __subclasscheck__(self, subclass: type) -> bool:
        return self.left and issubclass(subclass, self.real_thing)

    def __mro_entries__(self, bases: tuple[Any, ...]) -> tuple[type, ...]:
        del bases
        return (self.real_thing,)
