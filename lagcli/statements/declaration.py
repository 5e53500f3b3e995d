"""The declaration of a section: everything that lagcli knows of it follows from here.

The order on the page, the names after `--show` and `--also`, the completion, the JSON and its
schema, the key of `expect` with its comparison: all of them read the declarations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, cast

from lagcli.record import record

if TYPE_CHECKING:
    from lagcli.document import Block

Schema = Mapping[str, Any]


def never(_: Any) -> bool:
    """Shown only on request."""
    return False


def always(_: Any) -> bool:
    """Shown without a request."""
    return True


def step(place: str) -> Callable[[Any, Any], Iterable[Block]]:
    """The function `module:name` of `lagcli.mechanics.explaining`, imported when it is called."""
    module, _, name = place.partition(":")

    def blocks(explainer: Any, statement: Any) -> Iterable[Block]:
        found = import_module(f"lagcli.mechanics.explaining.{module}")
        return cast("Iterable[Block]", getattr(found, name)(explainer, statement))

    return blocks


@record(kw_only=True)
class Explained:
    """The step of `lagcli explain --also` on a section.

    Attributes
    ----------
    title : str
        The heading of the step.
    blocks : function (explainer, statement) -> blocks
        The sentences and formulas; `explainer` is that of `mechanics.explaining.explainer`.
    order : int
        The place among the further steps; that of the section where it is 0.
    """

    title: str
    blocks: Callable[[Any, Any], Iterable[Block]]
    order: int = 0


@record(kw_only=True)
class Expected:
    """What `expect` may state of a section, and how it is compared.

    Attributes
    ----------
    key : str
        The key in `expect`.
    schema : mapping
        JSON Schema of its value, with the definitions of `lagcli.reader.schema`.
    read : function (reader, node) -> value
        Reads the value; `reader` is a `lagcli.reader.expectations.ExpectReader`.
    compare : function (check, statement, value) -> findings
        Compares; `check` is a `lagcli.studies.check.expectations.Expectations`.  Yields a finding
        for each expectation that does not hold, None for each that does.
    wanted : function (expect) -> bool, or None
        Whether a file expects something; None: where the value is neither None nor empty.
    """

    key: str
    schema: Schema
    read: Callable[[Any, Any], Any]
    compare: Callable[[Any, Any, Any], Iterator[Any]]
    wanted: Callable[[Any], bool] | None = None

    def is_in(self, expect: Any) -> bool:
        """Whether the `expect` of a file has this key."""
        return bool(expect.of(self.key)) if self.wanted is None else self.wanted(expect)


@record(kw_only=True)
class Declaration:
    """One section of the answers.

    A statement is the section's own record of plain values and expressions, or None where
    there is none.

    Attributes
    ----------
    name : str
        As after `--show`, and its key in the answers.
    heading : str
        Its heading on a page.
    order : int
        Its place: sections are printed in ascending order.
    derive : function (statements) -> statement
        The derivation, from `lagcli.mechanics.statements.Statements`.
    blocks : function (statement, answers) -> blocks
        Its wording as blocks of `lagcli.document`.
    json : function (statement) -> mapping, or None
        Its keys in the JSON; None: one key, its content.
    schema : mapping or None
        JSON Schema of its own key.
    large, phase_space : function (statements) -> statement, or None
        The derivation for a system too large for simplified formulas, and for an H that gives
        no Lagrangian; None where the section is missing there.
    by_default : function (problem) -> bool
        Whether it is shown without a request.
    explained : Explained or None
        Its step in an explanation.
    expected : tuple of Expected
        Its keys in `expect`.
    content : str
        The field of the statement that `solution.<name>[...]` indexes; the name where empty.
    abbreviated : bool
        Whether long formulas of it get names for recurring parts.
    """

    name: str
    heading: str
    order: int
    derive: Callable[[Any], Any]
    blocks: Callable[[Any, Any], Iterable[Block]]
    json: Callable[[Any], Mapping[str, Any]] | None = None
    schema: Schema | None = None
    large: Callable[[Any], Any] | None = None
    phase_space: Callable[[Any], Any] | None = None
    by_default: Callable[[Any], bool] = never
    explained: Explained | None = None
    expected: tuple[Expected, ...] = ()
    content: str = ""
    abbreviated: bool = False


#: The functions that a module of a section names as the fields of a declaration.
_FUNCTIONS = ("derive", "blocks", "json", "large", "phase_space")


def declared(module: Mapping[str, Any], **others: Any) -> Declaration:
    """The section of a module, under its name and with its functions of the names of the fields."""
    found = {name: module[name] for name in _FUNCTIONS if name in module}
    return Declaration(**{"name": module["__name__"].rpartition(".")[2], **found, **others})
