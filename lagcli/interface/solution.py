"""The answers to one problem: by section, as text, as mathematics, as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from lagcli.expression import Expression
from lagcli.interface.formula import Formula
from lagcli.interface.rendered import Rendered
from lagcli.problem_data import Problem
from lagcli.record import field_names, replace
from lagcli.statements.answers import Answers
from lagcli.statements.registry import find_section, in_order

if TYPE_CHECKING:
    from lagcli.formatters import Options


class Solution(Rendered):
    """What `solve` answers.

    A section is an attribute (`solution.accelerations`) or an item
    (`solution["accelerations"]`); one that was not requested is not there.

    Attributes
    ----------
    title : str
    degrees_of_freedom : int or None
    warnings : tuple of str
        Which answers are missing, and why.
    complete : bool
        Whether every requested answer was found.
    """

    def __init__(self, answers: Answers, problem: Problem) -> None:
        self._answers = answers
        self._problem = problem
        self.title = answers.title
        self.degrees_of_freedom = answers.degrees_of_freedom
        self.warnings = answers.warnings
        self.complete = answers.complete

    @property
    def sections(self) -> dict[str, SolutionPart]:
        """Every requested section, in order."""
        return {name: self[name] for name in self}

    def __iter__(self) -> Iterator[str]:
        return (each.name for each in in_order(self._answers.sections))

    def __len__(self) -> int:
        return len(self._answers.sections)

    def __contains__(self, name: object) -> bool:
        return name in self._answers.sections

    def __getitem__(self, name: str) -> SolutionPart:
        if name not in self._answers.sections:
            known = ", ".join(self)
            raise KeyError(f"no section {name!r} was requested: available are {known}")
        one = replace(self._answers, sections={name: self._answers.sections[name]}, warnings=())
        return SolutionPart(self._answers.sections[name], self._problem, name, one)

    def __getattr__(self, name: str) -> SolutionPart:
        if name.startswith("_") or name not in self._answers.sections:
            raise AttributeError(
                f"no section {name!r} was requested: available are {', '.join(self)}"
            )
        return self[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def __repr__(self) -> str:
        return f"<Solution of {self.title!r}: {', '.join(self)}>"

    def _render(self, format_name: str, options: Options) -> str:
        return _printed(self._answers, format_name, options)


class SolutionPart:
    """A section or a part of it: names lead to its values, formulas are `Formula`.

    A section whose content has the section's own name is that content: the item "x" of
    `solution.accelerations` is x''.  A list of named things, such as charges, is indexed by
    name or by place.
    """

    def __init__(
        self, value: Any, problem: Problem, name: str = "", page: Answers | None = None
    ) -> None:
        self._value = value
        self._problem = problem
        self._page = page
        content = find_section(name).content or name if name else ""
        self._content = getattr(value, content, None) if name else None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or not hasattr(self._value, name):
            fields = ", ".join(self.__dir__())
            raise AttributeError(f"no {name!r} here: there are {fields}")
        return wrapped(getattr(self._value, name), self._problem)

    def __dir__(self) -> list[str]:
        return [name for name in dir(self._value) if not name.startswith("_")]

    def __getitem__(self, key: Any) -> Any:
        content = self._content
        if isinstance(content, Sequence) and isinstance(key, str):
            named = {_name_of(each): each for each in content}
            if key not in named:
                raise KeyError(f"no {key!r}: there are {', '.join(named)}")
            return wrapped(named[key], self._problem)
        if not isinstance(content, (Mapping, Sequence)):
            raise TypeError("this section has no items")
        return wrapped(content[key], self._problem)

    def __iter__(self) -> Iterator[Any]:
        if isinstance(self._content, Mapping):
            return iter(self._content)
        return iter([wrapped(each, self._problem) for each in self._content or ()])

    def __len__(self) -> int:
        return len(self._content or ())

    def keys(self) -> list[str]:
        """The names of its items."""
        if isinstance(self._content, Mapping):
            return list(self._content)
        return [_name_of(each) for each in self._content or ()]

    def items(self) -> list[tuple[str, Any]]:
        """Names and values."""
        return [(key, self[key]) for key in self.keys()]

    def __str__(self) -> str:
        if self._page is not None:
            return _printed(self._page, "text").split("\n\n", 1)[-1].rstrip("\n")
        return repr(self)

    def __repr__(self) -> str:
        shown = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.__dir__())
        return f"{type(self._value).__name__}({shown})"

    def _repr_html_(self) -> str | None:
        return None if self._page is None else _printed(self._page, "html")

    def _repr_markdown_(self) -> str | None:
        return None if self._page is None else _printed(self._page, "markdown")


def wrapped(value: Any, problem: Problem) -> Any:
    """A value of the answers for a user: formulas as `Formula`, records as `SolutionPart`."""
    match value:
        case Expression():
            return Formula(value, problem)
        case Mapping():
            return {key: wrapped(each, problem) for key, each in value.items()}
        case tuple() | list():
            return tuple(wrapped(each, problem) for each in value)
        case _ if field_names(value):
            return SolutionPart(value, problem)
        case _:
            return value


def _name_of(value: Any) -> str:
    """The name of one of several charges or equations."""
    return str(getattr(value, "name", getattr(value, "coordinate", "")))


def _printed(answers: Answers, format_name: str, options: Options | None = None) -> str:
    from lagcli.formatters import Options
    from lagcli.pipeline import render

    return render([answers], format_name, options or Options(width=80))
