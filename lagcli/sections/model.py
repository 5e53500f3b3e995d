"""What a numerical run integrates, what it eliminates or leaves out, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from lagcli.document import Block, Paragraph
from lagcli.expression import Name
from lagcli.formatters.json_values import Object, plain
from lagcli.statements.answers import Answers, ModelSection
from lagcli.statements.declaration import Explained, declared, step
from lagcli.statements.wording import listed, not_found, rows_by_name, with_names

if TYPE_CHECKING:
    from lagcli.mechanics.stating import Stating


def derive(statements: Stating) -> ModelSection:
    """What a run keeps and drops, as `simulate` would."""
    from lagcli.numerics.certified.model import model_section
    from lagcli.numerics.equations.refusal import Refusal

    try:
        return model_section(statements.problem)
    except Refusal as refusal:
        statements.lacks("the model of a numerical run", str(refusal))
        return ModelSection(kept=None)


def blocks(section: ModelSection, _: Answers) -> Iterator[Block]:
    """What is integrated, what is eliminated, what has no influence, and why."""
    if section.kept is None:
        yield not_found()
        return
    yield Paragraph(("Integrated: ", *listed(section.kept), "."))
    if section.eliminated:
        yield Paragraph(("Eliminated:",))
        yield rows_by_name(section.eliminated)
    if section.ignorable:
        yield Paragraph(("Ignorable: ", *listed(section.ignorable), "."))
    if section.dropped:
        yield Paragraph(("Without influence: ", *listed(section.dropped), "."))
    for name, reason in section.reason.items():
        yield Paragraph((Name(name), ": ", *with_names(reason), "."))


def json(section: ModelSection) -> Object:
    """Null where there is no such model."""
    if section.kept is None:
        return {"model": None}
    reason = {name: why.replace("`", "") for name, why in section.reason.items()}
    return {"model": {**plain(section), "reason": reason}}


SECTION = declared(
    globals(),
    heading="Model",
    order=230,
    large=derive,
    explained=Explained(
        title="The model of a numerical run", blocks=step("quantities:model"), order=130
    ),
)
