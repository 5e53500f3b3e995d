"""Sections by name: the built-in ones, and those that other packages bring.

A built-in section is a module of `lagcli.sections` with a `SECTION`; another package declares
one as an entry point of the group `lagcli.sections`.  A built-in name is resolved without
looking at what is installed: that is quick, and nobody else can take it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, cast

from lagcli.platform.plug_ins import plug_ins
from lagcli.platform.rooms import modules_in
from lagcli.statements.declaration import Declaration, Expected

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

GROUP = "lagcli.sections"


class BrokenSection(LookupError):
    """A plug-in that does not load."""


_FOLDER = Path(__file__).parents[1] / "sections"


def find_section(name: str) -> Declaration:
    """Find the section of that name; of the built-in ones only its own module is imported.

    Raises
    ------
    LookupError
        When there is none; `BrokenSection` when a plug-in does not load.
    """
    if name in _rooms():
        return _built_in(name)
    for point in _plug_ins():
        if point.name == name:
            return _loaded(point)
    raise LookupError(f"there is no section {name!r}")


def is_built_in(name: str) -> bool:
    """Whether a section comes with lagcli."""
    return name in _rooms()


def section_names() -> list[str]:
    """The names of all sections in alphabetical order; nothing of a section is imported."""
    return sorted({*_rooms(), *(point.name for point in _plug_ins())})


def built_in() -> list[Declaration]:
    """The built-in sections in the order in which they are printed."""
    return _sorted(map(_built_in, _rooms()))


def every_section() -> list[Declaration]:
    """All sections in their order, those of other packages among them."""
    return _sorted((*map(_built_in, _rooms()), *_loadable()))


def in_order(names: Iterable[str] | None = None) -> list[Declaration]:
    """The sections of these names (all of them) in the order in which they are printed.

    Names of no section are left out.
    """
    if names is None:
        return every_section()
    return _sorted(each for name in dict.fromkeys(names) for each in _found(name))


def explained_in_order(names: Iterable[str] | None = None) -> list[Declaration]:
    """Those of the named sections (of all) with a step in an explanation, in the order of steps."""
    named = every_section() if names is None else in_order(names)
    explained = ((each, each.explained) for each in named)
    ordered = [(step.order or each.order, each) for each, step in explained if step is not None]
    return [each for _, each in sorted(ordered, key=lambda pair: (pair[0], pair[1].name))]


def expected_keys(plug_ins: bool) -> list[str]:
    """The keys of `expect` that belong to a section."""
    declared = every_section() if plug_ins else built_in()
    return [expected.key for each in declared for expected in each.expected]


def find_expected(key: str) -> tuple[Declaration, Expected]:
    """The section that a key of `expect` belongs to.

    Raises
    ------
    LookupError
        When there is none.
    """
    for sections in (built_in, every_section):
        for declared in sections():
            for expected in declared.expected:
                if expected.key == key:
                    return declared, expected
    raise LookupError(f"nothing is expected under {key!r}")


@cache
def _rooms() -> frozenset[str]:
    """The names of the built-in sections: those of their modules."""
    return frozenset(modules_in(_FOLDER))


def _built_in(name: str) -> Declaration:
    return cast(Declaration, import_module(f"{GROUP}.{name}").SECTION)


def _found(name: str) -> Iterator[Declaration]:
    try:
        yield find_section(name)
    except LookupError:
        return


def _sorted(declared: Iterable[Declaration]) -> list[Declaration]:
    return sorted(declared, key=lambda each: (each.order, each.name))


# -- those of other packages ----------------------------------------------------------------


def _plug_ins() -> list[EntryPoint]:
    """The sections of other packages under names that no built-in one has."""
    return [point for point in plug_ins(GROUP) if point.name not in _rooms()]


def _loadable() -> Iterator[Declaration]:
    """The sections of other packages, one for each name, without those that do not load."""
    for point in {point.name: point for point in reversed(_plug_ins())}.values():
        try:
            yield _loaded(point)
        except LookupError:
            continue


def _loaded(point: EntryPoint) -> Declaration:
    try:
        declared = point.load()
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
        raise BrokenSection(f"the section {point.name!r} does not load: {reason}") from error
    if not isinstance(declared, Declaration) or declared.name != point.name:
        raise BrokenSection(f"the section {point.name!r} is not a declaration of that name")
    return declared
