"""SymPy's packages, which import a submodule when one of its names is used.

The `__init__.py` of such a package is a list of `from .module import names`.  It is read
instead of run: PEP 562 in a package that was written before it.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from functools import cache
from importlib import import_module
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import resolve_name, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from lagcli.sparing.recognition import stand_in_for

if TYPE_CHECKING:
    from importlib.abc import Loader
else:  # importing it takes longer than it has use
    Loader = object

#: The versions whose start this was tried on.
_VERSIONS = ("1.14.",)
#: These do something, in an order that matters.
_RUN = frozenset(
    f"sympy.{name}" for name in "core external utilities parsing physics plotting".split()
)
#: Its modules import each other in circles, and come well out of it in its own order only.
_ONE_PIECE = "sympy.matrices"
_IMPORT = re.compile(r"^from (\S+) import (\([^)]*\)|[^\n(]*)", re.MULTILINE)
_ALIAS = re.compile(r"^(\w+) = ([A-Za-z]\w*)(?:\.(\w+))?$", re.MULTILINE)
_COMMENT = re.compile(r"#[^\n]*")
_VERSION = re.compile(r"""^__version__ = ["']([^"']+)""", re.MULTILINE)


@cache
def known_sympy() -> bool:
    """Whether SymPy is not imported yet, and of a version that is known here."""
    if "sympy" in sys.modules:
        return False
    spec = PathFinder.find_spec("sympy")
    if spec is None or spec.origin is None:
        return False
    return _version(Path(spec.origin)).startswith(_VERSIONS)


def _version(init: Path) -> str:
    """The version of the SymPy whose `__init__.py` this is."""
    found = _VERSION.search((init.parent / "release.py").read_text(encoding="utf-8"))
    return found[1] if found else ""


def serve_names_lazily() -> None:
    """Let SymPy's packages be found as lazy ones."""
    sys.meta_path.insert(0, _Finder())


class _Finder:
    def find_spec(self, fullname: str, path: Any, target: Any = None) -> ModuleSpec | None:
        del target
        parts = fullname.split(".")
        if parts[0] != "sympy" or ".".join(parts[:2]) in _RUN:
            return None
        found = PathFinder.find_spec(fullname, path)
        if found is None or found.origin is None or found.submodule_search_locations is None:
            return None
        return spec_from_file_location(
            fullname,
            found.origin,
            loader=_Loader(Path(found.origin)),
            submodule_search_locations=list(found.submodule_search_locations),
        )


class _Loader(Loader):
    def __init__(self, path: Path) -> None:
        self.path = path

    def create_module(self, spec: ModuleSpec) -> _LazyPackage:
        return _LazyPackage(spec.name, self.path)

    def exec_module(self, module: ModuleType) -> None:
        """Nothing is run; SymPy's own start does two things beside importing."""
        if module.__name__ == "sympy":
            module.__dict__["__version__"] = _version(self.path)
            module.__dict__["SYMPY_DEBUG"] = False


class _LazyPackage(ModuleType):
    """A package that knows where its names are."""

    def __init__(self, name: str, path: Path) -> None:
        super().__init__(name)
        text = _COMMENT.sub("", path.read_text(encoding="utf-8")).replace("\\\n", "")
        places, aliases = _names(name, text)
        self.__dict__.update(_places=places, _aliases=aliases, __all__=[*places, *aliases])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        base, _ = self.__dict__["_aliases"].get(name, (name, ""))
        module, _ = self.__dict__["_places"].get(base, ("", ""))
        stand_in = stand_in_for(self.__name__, name, module, sys._getframe(1))  # noqa: SLF001
        if stand_in is not None:
            return stand_in
        value = self.__dict__[name] = self._found(name)
        return value

    def _found(self, name: str) -> Any:
        aliases: Mapping[str, tuple[str, str]] = self.__dict__["_aliases"]
        if name in aliases:
            base, attribute = aliases[name]
            value = getattr(self, base)
            return getattr(value, attribute) if attribute else value
        places: Mapping[str, tuple[str, str]] = self.__dict__["_places"]
        if name not in places:
            try:
                return import_module(f"{self.__name__}.{name}")
            except ModuleNotFoundError:
                message = f"module {self.__name__!r} has no attribute {name!r}"
                raise AttributeError(message) from None
        module, original = places[name]
        if f"{module}.".startswith(f"{_ONE_PIECE}.") and module not in sys.modules:
            _import_matrices()
        if module == self.__name__:  # from . import original
            return import_module(f"{module}.{original}")
        return getattr(import_module(module), original)

    def __setattr__(self, name: str, value: Any) -> None:
        """`sympy.series.series` is the function, though its module has the same name."""
        if isinstance(value, ModuleType) and name in self.__dict__["_places"]:
            return
        super().__setattr__(name, value)


#: Where SymPy makes what it has one of, and no module asks for by its place: `S.Reals`.
_SINGLETONS = {
    **dict.fromkeys(
        "Complexes Integers Naturals Naturals0 Rationals Reals".split(), "sympy.sets.fancysets"
    ),
    **dict.fromkeys("EmptySet UniversalSet".split(), "sympy.sets.sets"),
    "EmptySequence": "sympy.series.sequences",
    "IdentityFunction": "sympy.functions.elementary.miscellaneous",
}


def serve_singletons_lazily() -> None:
    """Let `S` import the module of a name that it does not know yet."""
    registry = type(import_module("sympy.core.singleton").S)
    known = registry.__getattr__

    def served(self: Any, name: str) -> Any:
        if name in _SINGLETONS:
            import_module(_SINGLETONS[name])  # which registers it, or has used it already
        found = vars(type(self)).get(name)
        return known(self, name) if found is None else found

    registry.__getattr__ = served


def _import_matrices() -> None:
    """Import SymPy's matrices as SymPy does, before any one of them is used."""
    for module, _ in import_module(_ONE_PIECE).__dict__["_places"].values():
        import_module(module)


def _names(package: str, text: str) -> tuple[dict[str, tuple[str, str]], dict[str, Any]]:
    """name -> (module, its name there), and name -> (other name, attribute of it or '')."""
    places = {}
    for module, names in _IMPORT.findall(text):
        base = resolve_name(module, package)
        for each in names.strip("()").replace("\n", " ").split(","):
            original, _, new = each.strip().partition(" as ")
            if original.isidentifier():
                places[new.strip() or original] = (base, original)
    aliases = {
        name: (base, attribute)
        for name, base, attribute in _ALIAS.findall(text)
        if name not in places
    }
    return places, aliases
