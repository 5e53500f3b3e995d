"""From the text of a module to addresses of functions, by LLVM.

The library of llvmlite is used by its C interface: importing `llvmlite.binding` costs
60 ms, loading its library 10.  That interface is llvmlite's own and changes with its
releases, so it is used with the releases named here and with no other.
"""

from __future__ import annotations

import ctypes
import os
import sys
from base64 import b64decode, b64encode
from collections.abc import Callable, Sequence
from ctypes import POINTER, byref, c_bool, c_char_p, c_int, c_size_t, c_uint64, c_void_p
from functools import cache
from hashlib import sha256
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any

from lagcli.platform.cache import Cache, KeptAnswer, folder

#: Releases of llvmlite whose C interface is the one declared below.
_RELEASES = ("0.50.",)
_LIBRARIES = {"linux": "libllvmlite.so", "darwin": "libllvmlite.dylib", "win32": "llvmlite.dll"}

_TEXT = POINTER(c_char_p)
_INTERFACE: dict[str, tuple[Any, list[Any]]] = {
    "InitializeNativeTarget": (None, []),
    "InitializeNativeAsmPrinter": (None, []),
    "LinkInMCJIT": (None, []),
    "GetGlobalContext": (c_void_p, []),
    "ParseAssembly": (c_void_p, [c_void_p, c_char_p, _TEXT]),
    "GetProcessTriple": (None, [_TEXT]),
    "GetHostCPUName": (None, [_TEXT]),
    "GetHostCPUFeatures": (c_int, [_TEXT]),
    "GetTargetFromTriple": (c_void_p, [c_char_p, _TEXT]),
    "CreateTargetMachine": (
        c_void_p,
        # target, triple, cpu, features, level, relocation, code model, print, jit, abi
        [c_void_p, *[c_char_p] * 3, c_int, *[c_char_p] * 2, c_int, c_int, c_char_p],
    ),
    "CreatePipelineTuningOptions": (c_void_p, []),
    "CreatePassBuilder": (c_void_p, [c_void_p, c_void_p]),
    "CreateNewModulePassManager": (c_void_p, []),
    "RunNewModulePassManager": (None, [c_void_p, c_void_p, c_void_p]),
    "module_AddAlwaysInlinerPass": (None, [c_void_p]),
    "module_AddSROAPass": (None, [c_void_p]),
    "module_AddSimplifyCFGPass": (None, [c_void_p]),
    "module_AddInstCombinePass": (None, [c_void_p]),
    "module_AddNewGVNPass": (None, [c_void_p]),
    "TargetMachineEmitToMemory": (c_void_p, [c_void_p, c_void_p, c_int, _TEXT]),
    "GetBufferStart": (c_void_p, [c_void_p]),
    "GetBufferSize": (c_size_t, [c_void_p]),
    "DisposeMemoryBuffer": (None, [c_void_p]),
    "CreateObjectFile": (c_void_p, [c_char_p, c_size_t]),
    "MCJITAddObjectFile": (None, [c_void_p, c_void_p]),
    "CreateMCJITCompiler": (c_void_p, [c_void_p, c_void_p, c_bool, _TEXT]),
    "FinalizeObject": (None, [c_void_p]),
    "GetFunctionAddress": (c_uint64, [c_void_p, c_char_p]),
}

#: What LLVM calls for numbers of 128 bits: operations of libgcc, functions of libm.
_QUADRUPLE = (
    "addtf3 subtf3 multf3 divtf3 eqtf2 netf2 lttf2 letf2 gttf2 getf2 unordtf2 "
    "extenddftf2 trunctfdf2 floatditf fixtfdi floatsitf floatunsitf"
).split()
_FUNCTIONS = (
    "sqrt sin cos sinh cosh tanh exp log pow asin acos atan asinh acosh atanh atan2"
).split()

#: What is done before code is made, by the time that the whole takes: mem2reg and little else.
_PASSES = ("AlwaysInliner", "SROA", "InstCombine", "SimplifyCFG")
_CODE_LEVEL = 2
_HOW = (_RELEASES, _PASSES, _CODE_LEVEL)


class NoCompiler(Exception):
    """There is no compiler here; why, in words."""


class Engine:
    """The compiler of this machine.

    Raises
    ------
    NoCompiler
        Where llvmlite is missing, or is a release that is not known.
    """

    def __init__(self) -> None:
        self._library = _library()
        for name in ("InitializeNativeTarget", "InitializeNativeAsmPrinter", "LinkInMCJIT"):
            self._call(name)
        self._triple = self._told("GetProcessTriple")
        #: whether there are numbers of 80 bits, and `long double` is such a number
        self.extended = self._triple.startswith(b"x86_64-") and sys.platform != "win32"
        self._has_quadruple: bool | None = None
        self._cpu = self._told("GetHostCPUName"), self._told("GetHostCPUFeatures")
        self._modules: dict[str, Compiled] = {}
        self._folder = None if os.environ.get("LAGCLI_NO_CACHE") else folder(os.environ)

    @property
    def quadruple(self) -> bool:
        """Whether the C library computes with numbers of 128 bits."""
        if self._has_quadruple is None:
            self._has_quadruple = self.extended and sys.platform == "linux" and _knows_quadruple()
        return self._has_quadruple

    def compiled(
        self, source: bytes, text: Callable[[], str], *, quickly: bool = False
    ) -> Compiled:
        """The functions of a module, which an earlier run may have made already.

        Parameters
        ----------
        source
            All that the text of the module is made of.
        text
            The module in LLVM's language.
        quickly
            Make the code in a fifth of the time; its values stay in memory.  Where the better
            code is kept already, that is taken.

        Raises
        ------
        NoCompiler
            Where the module cannot be compiled here.
        """
        for lesser in (False, True) if quickly else (False,):
            key = self._key(source, quickly=lesser)
            found = self._known(key)
            if found is not None:
                return found
        code = self._code(text(), *(((), 0) if quickly else (_PASSES, _CODE_LEVEL)))
        if self._folder:
            Cache(self._folder).keep(key, KeptAnswer(0, b64encode(code).decode()))
        self._modules[key] = self._loaded(code)
        return self._modules[key]

    def _known(self, key: str) -> Compiled | None:
        """A module that is loaded, or kept on disk."""
        if key not in self._modules and self._folder:
            entry = Cache(self._folder).find(key)
            if entry is not None and entry.text is not None:
                self._modules[key] = self._loaded(b64decode(entry.text))
        return self._modules.get(key)

    def _key(self, source: bytes, *, quickly: bool) -> str:
        whole = b"\0".join((*self._cpu, self._triple, repr((_HOW, quickly)).encode(), source))
        return sha256(whole).hexdigest()

    def _code(self, text: str, names: Sequence[str], level: int) -> bytes:
        """Machine code as an object file."""
        machine, module, error = self._machine(level), self._module(text), c_char_p()
        builder = self._call(
            "CreatePassBuilder", machine, self._call("CreatePipelineTuningOptions")
        )
        passes = self._call("CreateNewModulePassManager")
        for name in names:
            self._call(f"module_Add{name}Pass", passes)
        self._call("RunNewModulePassManager", passes, module, builder)
        buffer = self._call("TargetMachineEmitToMemory", machine, module, 1, byref(error))
        if not buffer:
            raise NoCompiler(f"llvmlite makes no code here: {(error.value or b'').decode()}")
        start, size = self._call("GetBufferStart", buffer), self._call("GetBufferSize", buffer)
        code = ctypes.string_at(start, size)
        self._call("DisposeMemoryBuffer", buffer)
        return code

    def _loaded(self, code: bytes) -> Compiled:
        """An object file in memory, linked to the C library."""
        error = c_char_p()
        arm = b"aarch64" in self._triple or b"arm64" in self._triple
        engine = self._call(
            "CreateMCJITCompiler", self._module(""), self._machine(), arm, byref(error)
        )
        if not engine:
            raise NoCompiler(f"llvmlite runs no code here: {(error.value or b'').decode()}")
        self._call("MCJITAddObjectFile", engine, self._call("CreateObjectFile", code, len(code)))
        self._call("FinalizeObject", engine)
        return Compiled(lambda name: self._call("GetFunctionAddress", engine, name.encode()))

    def _module(self, text: str) -> Any:
        error = c_char_p()
        context = self._call("GetGlobalContext")
        module = self._call("ParseAssembly", context, text.encode(), byref(error))
        if not module or error.value:
            raise NoCompiler(f"llvmlite does not take the code: {(error.value or b'').decode()}")
        return module

    def _machine(self, level: int = _CODE_LEVEL) -> Any:
        """A machine of its own for each module, which takes it over."""
        error = c_char_p()
        target = self._call("GetTargetFromTriple", self._triple, byref(error))
        machine = target and self._call(
            *("CreateTargetMachine", target, self._triple, *self._cpu, level),
            *(b"default", b"jitdefault", 0, 1, b""),
        )
        if not machine:
            raise NoCompiler("llvmlite does not know this machine")
        return machine

    def _call(self, name: str, *arguments: Any) -> Any:
        function = getattr(self._library, f"LLVMPY_{name}")
        function.restype, function.argtypes = _INTERFACE[name]
        return function(*arguments)

    def _told(self, name: str) -> bytes:
        text = c_char_p()
        self._call(name, byref(text))
        return text.value or b""


class Compiled:
    """Functions by their names; they stay in memory as long as the process."""

    def __init__(self, address: Callable[[str], int]) -> None:
        self.address = address

    def function(self, name: str, result: Any, *arguments: Any) -> Any:
        """A function with the C types of its result and arguments."""
        return ctypes.CFUNCTYPE(result, *arguments)(self.address(name))


@cache
def engine() -> Engine:
    """The one engine of this process."""
    return Engine()


def _library() -> ctypes.CDLL:
    spec = PathFinder.find_spec("llvmlite")
    if spec is None or not spec.submodule_search_locations:
        raise NoCompiler("llvmlite is not installed")
    folder = Path(next(iter(spec.submodule_search_locations)))
    if not any(_release(folder).startswith(known) for known in _RELEASES):
        raise NoCompiler(f"llvmlite is not one of the releases {', '.join(_RELEASES)}")
    try:
        return ctypes.CDLL(str(folder / "binding" / _LIBRARIES[sys.platform]))
    except (OSError, KeyError) as error:
        raise NoCompiler(f"llvmlite cannot be loaded: {error}") from None


def _knows_quadruple() -> bool:
    """Load what the operations with 128 bits are calls of; False where a function is missing."""
    try:
        operations = ctypes.CDLL("libgcc_s.so.1", mode=ctypes.RTLD_GLOBAL)
        functions = ctypes.CDLL("libm.so.6", mode=ctypes.RTLD_GLOBAL)
    except OSError:
        return False
    return all(hasattr(operations, f"__{name}") for name in _QUADRUPLE) and all(
        hasattr(functions, f"{name}f128") for name in _FUNCTIONS
    )


def _release(folder: Path) -> str:
    """The release of an installed llvmlite, by the name of the folder that tells of it."""
    for path in folder.parent.glob("llvmlite-*.dist-info"):
        return path.name.removeprefix("llvmlite-")
    return ""
