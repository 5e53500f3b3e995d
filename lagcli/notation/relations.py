"""Relations to 0 without a minus before the side that is not 0.

    0 = −a is 0 = a,  −a > 0 is a < 0

A page is written in the manner of its file when it is complete, which may turn b − a into −(a − b).
"""

from __future__ import annotations

from collections.abc import Sequence

from lagcli.document import Block, Equations, Formula, Paragraph, Row
from lagcli.expression import ZERO, Negative
from lagcli.record import replace

_TURNED = {" > ": " < ", " < ": " > "}


def without_minuses(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """The blocks, each relation to 0 turned where all of its other side has a minus."""
    return tuple(map(_block, blocks))


def _block(block: Block) -> Block:
    match block:
        case Equations(rows=rows):
            return Equations(tuple(map(_row, rows)))
        case Paragraph(parts=parts):
            return Paragraph(_sentence(parts))
    return block


def _row(row: Row) -> Row:
    match row:
        case Row(left=left, right=Negative(operand=right)) if left == ZERO:
            return replace(row, right=right)
    return row


def _sentence(parts: tuple[str | Formula, ...]) -> tuple[str | Formula, ...]:
    found = list(parts)
    for k in range(len(found) - 2):
        match found[k : k + 3]:
            case [Negative(operand=left), str(sign), right] if right == ZERO and sign in _TURNED:
                found[k : k + 2] = [left, _TURNED[sign]]
    return tuple(found)
