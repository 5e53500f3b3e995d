"""The key `picture`: what an animation draws beside the points."""

from __future__ import annotations

import re

from lagcli.expression import Expression
from lagcli.problem_data import Point, Scenery
from lagcli.reader.dynamics import read_components
from lagcli.reader.file_reader import FileReader
from lagcli.reader.misshapen import source_of
from lagcli.reader.nodes import DocumentNode, Mapping, Scalar, Sequence
from lagcli.reader.scope import POSITION
from lagcli.reader.suggest import did_you_mean

#: What `picture` may hold.
KEYS = ("places", "rods", "springs", "trails")


def read_scenery(file: FileReader, node: DocumentNode, points: tuple[Point, ...]) -> Scenery:
    """Places, what joins them to the points, and which points leave a trail."""
    given = file.attributes(node, "picture", KEYS)
    places: dict[str, tuple[Expression, ...]] = {}
    if "places" in given:
        places = _places(file, given["places"][1], points)
    names = [*(point.name for point in points), *places]

    def pairs(key: str) -> tuple[tuple[str, str], ...]:
        return _pairs(file, given[key][1], key, names) if key in given else ()

    trails = None
    if "trails" in given:
        known, node = [point.name for point in points], given["trails"][1]
        are_points = isinstance(node, Scalar) and {*re.findall(r"\w+", node.value)} <= {*known}
        hint = "write [bob]" if are_points else f"a list of points, as in [{', '.join(known)}]"
        listed = file.items(node, "trails", hint)
        trails = tuple(n for item in listed if (n := _name(file, item, "trails", known)))
    return Scenery(places=places, rods=pairs("rods"), springs=pairs("springs"), trails=trails)


def _places(
    file: FileReader, node: DocumentNode, points: tuple[Point, ...]
) -> dict[str, tuple[Expression, ...]]:
    found = {}
    taken = {point.name for point in points}
    size = len(points[0].position) if points else None
    for key, value in file.entries(node, "places", "write O: [0, 0]"):
        what = f"the place '{key.label}'"
        if key.label in taken:
            file.error(f"{what} has the name of a point", key.span)
        items = read_components(file, value, what, "write [x, y]", size or 0)
        if size and items and len(items) != size:
            file.error(f"{what} has {len(items)} components, the points have {size}", value.span)
        found[key.label] = tuple(file.expression(item, what, POSITION) for item in items)
    return found


def _pairs(
    file: FileReader, node: DocumentNode, key: str, names: list[str]
) -> tuple[tuple[str, str], ...]:
    found = []
    inner = node.parts
    if len(inner) == 1 and any(isinstance(each, Sequence) for each in inner[0].parts):
        inner = inner[0].parts  # [[[0, 0], bob]]
    ends_alone = [each.value for each in inner if isinstance(each, Scalar)]
    joined = [re.split(r"\s*[-–—~]+>?\s*|\s+(?:to\s+)?", each) for each in ends_alone]
    are_pairs = all(len(each) == 2 for each in joined)
    if inner and len(ends_alone) == len(inner) and (are_pairs or len(inner) == 2):
        ends_meant = joined if are_pairs else [ends_alone]
        hint = f"write [{', '.join(f'[{one}, {other}]' for one, other in ends_meant)}]"
        file.error(f"{key} is a list of pairs", node.span, hint)
        return ()
    placed = [each for each in inner if isinstance(each, Sequence) and _is_place(each)]
    if len(inner) == 2 and len(placed) == len(ends_alone) == 1:  # [[0, 0], bob]
        place = source_of(placed[0])
        whole = f"picture: {{places: {{O: {place}}}, {key}: [[O, {ends_alone[0]}]]}}"
        file.error(f"{key} join points and places by their names", node.span, f"write {whole}")
        return ()
    hint = "a list of pairs, as in [[O, bob], [bob, ball]]"
    if isinstance(node, Mapping):
        pairs = (source_of(v) if isinstance(v, Sequence) else f"[{k.label}, {source_of(v)}]"
                 for k, v in node.entries)  # fmt: skip
        hint = f"write [{', '.join(pairs)}]"
    for item in file.items(node, key, hint):
        ends = file.items(item, f"one of the {key}", "write two names: [O, bob]")
        if ends and len(ends) != 2:
            file.error(f"one of the {key} joins {len(ends)} points, it joins two", item.span)
            continue
        pair = [_name(file, end, key, names) for end in ends]
        if len(pair) == 2 and pair[0] and pair[1]:
            found.append((pair[0], pair[1]))
    return tuple(found)


def _is_place(node: Sequence) -> bool:
    """Whether a list has numbers, not names."""
    numbers = node.listed
    return len(numbers) == len(node.items) and all(re.fullmatch(r"-?[\d.]+", x) for x in numbers)


def _name(file: FileReader, node: DocumentNode, what: str, names: list[str]) -> str:
    """The name of a point or a place; empty where there is none of it."""
    scalar = file.scalar(node, f"a name in {what}")
    if scalar is None:
        return ""
    name = scalar.value.strip()
    if name in names:
        return name
    fixed = f"a fixed place stands beside it: places: {{{name}: [0, 0]}}"
    known = f"there are {', '.join(names)}; {fixed}" if names else fixed
    hint = did_you_mean(name, names) or known
    if not file.scope.refused:
        file.error(f"{what}: there is no point '{name}'", scalar.span, hint)
    return ""
