"""Commas that cut a formula in two.

In `{a: atan2(y, x)}` YAML ends the value at the comma and reads on with a key `x)`.  The
open parenthesis gives that away: the pieces are joined again, and one mistake is reported
instead of several that nobody would understand.
"""

from __future__ import annotations

import re

from lagcli.diagnostics import Diagnostic
from lagcli.reader.habits import unit_behind
from lagcli.reader.misshapen import as_list, ranged
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence


def mend_commas(node: DocumentNode) -> list[Diagnostic]:
    """Join the pieces of formulas in a list `[ ]` or a map `{ }`; report each."""
    match node:
        case Mapping():
            node.entries = _with_whole_keys(node.entries)
            values = [value for _, value in node.entries]
            nothing = [value.is_empty for value in values]
            keys: list[DocumentNode] = [key for key, _ in node.entries]
            keep, mistakes = _mend(values, keys, nothing)
            node.entries = [entry for entry, kept in zip(node.entries, keep, strict=True) if kept]
        case Sequence():
            keep, mistakes = _mend(node.items, node.items, [True] * len(node.items))
            node.items = [item for item, kept in zip(node.items, keep, strict=True) if kept]
        case _:
            return []
    return mistakes


def _with_whole_keys(
    entries: list[tuple[Scalar, DocumentNode]],
) -> list[tuple[Scalar, DocumentNode]]:
    """The entries with one key `U(r, t)` for the two into which the comma cuts it."""
    whole: list[tuple[Scalar, DocumentNode]] = []
    for key, value in entries:
        begun, nothing = whole[-1] if whole else (key, value)
        if whole and nothing.is_empty and _unclosed(begun) > 0 and not key.style:
            begun.end = key.end
            begun.value = begun.text.source.text[begun.start : key.end]
            whole[-1] = (begun, value)
        else:
            whole.append((key, value))
    return whole


def _mend(
    values: list[DocumentNode], rest: list[DocumentNode], may_follow: list[bool]
) -> tuple[list[bool], list[Diagnostic]]:
    """Which entries to keep, when those that finish an earlier formula are dropped.

    `rest[i]` is the text that continues a formula when entry i is a piece of one.
    """
    keep = [True] * len(values)
    mistakes = []
    i = 0
    while i < len(values):
        open_ = _unclosed(values[i])
        last = i
        while open_ > 0 and last + 1 < len(values) and may_follow[last + 1]:
            piece = rest[last + 1]
            if not isinstance(piece, Scalar) or piece.style:
                break
            open_ += _unclosed(piece)
            last += 1
        if last > i and open_ == 0:
            from lagcli.reader.foreign.vectors import components

            first = values[i]
            end = rest[last].end
            whole = first.text.source.text[first.start : end]
            one = " ".join(whole.split())
            hint = quoted = f'write "{one}"'
            if as_list(one) != f"[{one}]":
                hint = f"write {as_list(one)}"
            if pair := re.fullmatch(r"\(\s*['\"](\w+)['\"]\s*,\s*([\d.]+)\s*\)", one):
                hint = f"write {pair[1]}: {pair[2]}, with braces {{ }} around all"
            with_unit = re.fullmatch(r"\(\s*([-\d.]+)\s*,\s*([^,()]+)\)", one)
            if with_unit and unit_behind(f"1 {with_unit[2].strip()}"):
                hint = f"write {{value: {with_unit[1]}, unit: {with_unit[2].strip()}}}"
            if hint == quoted and (parts := components(one, ())):
                hint = f"write [{', '.join(parts)}]"
            elif hint == quoted and re.search(r"(?:[-+*]|^)\s*\([^()]*(?:\([^()]*\)[^()]*)*,", one):
                hint = "a vector is a list of its components, as in [x, y]"
            message = "inside { } and [ ] a comma ends the value"
            if isinstance(first, Scalar):
                first.value, first.end, first.broken = one, end, True
            key = re.search(r"([\w']+)\s*:\s*$", first.text.source.text[: first.start])
            hint = (ranged(key[1], first) if key else "") or hint
            mistakes.append(Diagnostic(message, first.text.span(first.start, end), hint))
            keep[i + 1 : last + 1] = [False] * (last - i)
        i = last + 1
    return keep, mistakes


def _unclosed(node: DocumentNode) -> int:
    if isinstance(node, Scalar) and not node.style and not node.anchored:
        return node.value.count("(") - node.value.count(")")
    return 0
