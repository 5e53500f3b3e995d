"""Records: frozen values with named fields, as frozen dataclasses with slots are.

`dataclasses` writes and compiles six functions for each class, 0.5 ms a class, and lagcli
has over a hundred of them: more start-up than Python's own.  Here all classes share the
same functions, and making one costs 0.03 ms.  What `dataclasses` knows (`field`, `fields`,
`replace`, `is_dataclass`) works with records as well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import MISSING, Field, FrozenInstanceError, field, make_dataclass
from operator import attrgetter
from typing import Any, NamedTuple, TypeVar, dataclass_transform, overload

__all__ = ["field", "field_names", "record", "replace"]

Class = TypeVar("Class")
Value = TypeVar("Value")


class _RecordField(NamedTuple):
    """One field of a record."""

    name: str
    default: Any
    factory: Any
    compare: bool
    show: bool
    kw_only: bool


@overload
def record(cls: type[Class], /) -> type[Class]: ...
@overload
def record(
    *, kw_only: bool = False, order: bool = False
) -> Callable[[type[Class]], type[Class]]: ...
@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def record(cls: type | None = None, /, *, kw_only: bool = False, order: bool = False) -> Any:
    """Make a frozen class with slots of its annotations, as `dataclasses.dataclass` would.

    Parameters
    ----------
    cls
        A class whose bases, if any, are records.
    kw_only
        Its fields are given by name only.
    order
        Its values are sorted as the tuples of their fields.
    """
    if cls is None:
        return lambda given: _made(given, kw_only, order)
    return _made(cls, kw_only, order)


def _made(cls: type, kw_only: bool, order: bool) -> type:
    namespace = dict(cls.__dict__)
    own = tuple(namespace.get("__annotations__", ()))
    parts = {part.name: part for base in cls.__bases__ for part in getattr(base, "_parts", ())}
    for name in own:
        parts[name] = _part(name, namespace.pop(name, MISSING), kw_only)
    namespace.pop("__dict__", None)
    namespace.pop("__weakref__", None)
    # By name only comes last, whatever the order in which the fields stand.
    ordered = tuple(sorted(parts.values(), key=lambda part: part.kw_only))
    slots = (*own, "_hashed")
    namespace["__slots__"] = tuple(n for n in slots if not hasattr(cls.__base__, n))
    namespace["__match_args__"] = tuple(part.name for part in ordered if not part.kw_only)
    namespace["_parts"] = ordered
    namespace["_compared"] = _getter([part.name for part in ordered if part.compare])
    namespace.setdefault("__repr__", _repr)
    namespace.update(_SHARED)
    if order:
        namespace.update(_ORDER)
    made = type(cls)(cls.__name__, cls.__bases__, namespace)
    made.__init__ = _initializer(made, ordered)  # type: ignore[misc]
    return made


def _part(name: str, given: Any, kw_only: bool) -> _RecordField:
    if not isinstance(given, Field):
        return _RecordField(name, given, MISSING, compare=True, show=True, kw_only=kw_only)
    by_name = kw_only if given.kw_only is MISSING else given.kw_only
    return _RecordField(
        name, given.default, given.default_factory, given.compare, given.repr, by_name
    )


def _getter(names: list[str]) -> staticmethod[[Any], Any]:
    return staticmethod(attrgetter(*names) if names else lambda _: ())


def _initializer(cls: type, parts: tuple[_RecordField, ...]) -> Callable[..., None]:
    """The `__init__` of a class: no text is compiled, so none could be taken over."""
    setters = tuple(getattr(cls, part.name).__set__ for part in parts)
    places = tuple((part, put) for part, put in zip(parts, setters, strict=True))
    positional = sum(not part.kw_only for part in parts)
    #: plain[k]: what is put in after k positional arguments, where that is known beforehand
    plain = tuple(_defaults(places[count:]) for count in range(positional + 1))

    def __init__(self: Any, *given: Any, **named: Any) -> None:  # noqa: N807
        count = len(given)
        if count > positional:
            mistake = f"takes {positional} positional arguments but {count} were given"
            raise TypeError(f"{cls.__name__}() {mistake}")
        for put, value in zip(setters, given):  # noqa: B905 - the rest follows
            put(self, value)
        rest = plain[count]
        if rest is not None and not named:
            for put, value in rest:
                put(self, value)
            return
        for (name, default, factory, *_), put in places[count:]:
            if name in named:
                put(self, named.pop(name))
            elif default is not MISSING:
                put(self, default)
            elif factory is not MISSING:
                put(self, factory())
            else:
                raise TypeError(f"{cls.__name__}() missing the argument {name!r}")
        if named:
            raise TypeError(f"{cls.__name__}() got an unexpected argument {next(iter(named))!r}")

    return __init__


def _defaults(places: tuple[tuple[_RecordField, Any], ...]) -> tuple[tuple[Any, Any], ...] | None:
    """The settings and their defaults, None where one has none or makes it anew."""
    if any(part.default is MISSING for part, _ in places):
        return None
    return tuple((put, part.default) for part, put in places)


def field_names(value: object) -> tuple[str, ...]:
    """The names of the fields of a record or of a dataclass; none of anything else."""
    parts = getattr(type(value), "_parts", None)
    if parts is not None:
        return tuple(part.name for part in parts)
    return tuple(getattr(type(value), "__dataclass_fields__", ()))


def replace(value: Value, /, **changes: Any) -> Value:
    """The same record, or dataclass, with other values of some fields."""
    kept = {name: getattr(value, name) for name in field_names(value) if name not in changes}
    return type(value)(**kept, **changes)


# -- the methods that all records share ---------------------------------------------------


def _repr(self: Any) -> str:
    shown = (f"{part.name}={getattr(self, part.name)!r}" for part in self._parts if part.show)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _eq(self: Any, other: Any) -> Any:
    if other.__class__ is not self.__class__:
        return NotImplemented
    return self._compared(self) == self._compared(other)


def _hash(self: Any) -> int:
    try:
        known: int = self._hashed
    except AttributeError:
        known = hash(self._compared(self))
        object.__setattr__(self, "_hashed", known)
    return known


def _setattr(self: Any, name: str, value: object) -> None:  # noqa: ARG001
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _delattr(self: Any, name: str) -> None:  # noqa: ARG001
    raise FrozenInstanceError(f"cannot delete field {name!r}")


def _getstate(self: Any) -> list[Any]:
    return [getattr(self, part.name) for part in self._parts]


def _setstate(self: Any, state: list[Any]) -> None:
    for part, value in zip(self._parts, state, strict=True):
        object.__setattr__(self, part.name, value)


def _less(self: Any, other: Any) -> Any:
    if other.__class__ is not self.__class__:
        return NotImplemented
    return self._compared(self) < self._compared(other)


def _less_or_equal(self: Any, other: Any) -> Any:
    if other.__class__ is not self.__class__:
        return NotImplemented
    return self._compared(self) <= self._compared(other)


class _DataclassFields:
    """What `dataclasses` asks of a class; made when it asks."""

    def __get__(self, _: object, cls: Any) -> dict[str, Field[Any]]:
        twin = make_dataclass(cls.__name__, _described(cls._parts))
        made: dict[str, Field[Any]] = twin.__dataclass_fields__  # type: ignore[attr-defined]
        cls.__dataclass_fields__ = made
        return made


def _described(parts: tuple[_RecordField, ...]) -> Iterator[tuple[str, Any, Any]]:
    for name, default, factory, compare, show, kw_only in parts:
        given = {"default": default} if factory is MISSING else {"default_factory": factory}
        yield name, Any, field(**given, compare=compare, repr=show, kw_only=kw_only)


_SHARED = {
    "__eq__": _eq,
    "__hash__": _hash,
    "__setattr__": _setattr,
    "__delattr__": _delattr,
    "__getstate__": _getstate,
    "__setstate__": _setstate,
    "__dataclass_fields__": _DataclassFields(),
}
_ORDER = {"__lt__": _less, "__le__": _less_or_equal}
