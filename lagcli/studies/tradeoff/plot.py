"""The work-precision plot as SVG: error against cost, both logarithmic, a line for a method."""

from __future__ import annotations

import math
from collections.abc import Sequence
from xml.sax.saxutils import escape

from lagcli.numerics.certified.methods import METHODS
from lagcli.studies.tradeoff.front import COSTS, RunPoint
from lagcli.studies.tradeoff.study import Study

_WIDTH, _HEIGHT = 840.0, 560.0
_LEFT, _RIGHT, _TOP = 86.0, 110.0, 64.0
_LEGEND_ROW, _AXIS = 18.0, 54.0
_LABEL_GAP = 14.0

#: Colours that are told apart by all eyes: Okabe, Ito, "Color universal design" (2008).
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#333333", "#8B6914")
_DASHES = ("", "7 3", "2 3", "9 3 2 3")
_HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
    'width="{width:g}" height="{height:g}" font-family="sans-serif" font-size="12">'
)
_TITLES = {
    "total": ("processor time of a fresh process", "s"),
    "integration": ("processor time of the integration", "s"),
    "evaluations": ("evaluations of the accelerations", ""),
}


class _Scale:
    """A logarithmic axis over whole decades, or parts of one."""

    def __init__(self, values: Sequence[float], begin: float, end: float) -> None:
        low, high = math.log10(min(values)), math.log10(max(values))
        room = max(0.05 * (high - low), 0.05)
        self.low, self.high = low - room, high + room
        self.begin, self.end = begin, end

    def __call__(self, value: float) -> float:
        part = (math.log10(value) - self.low) / (self.high - self.low)
        return self.begin + part * (self.end - self.begin)

    def ticks(self) -> list[float]:
        """Powers of ten, not too many; within less than two decades 1, 2 and 5 of each."""
        first, last = math.ceil(self.low), math.floor(self.high)
        if last - first < 2:
            steps = [m * 10.0**k for k in range(first - 1, last + 1) for m in (1, 2, 5)]
            return [x for x in steps if self.low <= math.log10(x) <= self.high]
        every = max(1, math.ceil((last - first + 1) / 10))
        return [10.0**k for k in range(first, last + 1) if k % every == 0]


def to_svg(study: Study) -> str:
    """The plot; errors grow smaller to the right, costs higher upwards.

    Raises
    ------
    ValueError
        When no run has a result.
    """
    cost = COSTS[study.cost]
    lines: dict[str, list[tuple[float, float, RunPoint]]] = {}
    for point in study.points:
        paid = cost(point)
        if point.error is not None and paid is not None and point.error < math.inf:
            error = max(point.error, study.resolved, 1e-300)
            lines.setdefault(point.method, []).append((error, max(paid, 1e-9), point))
    if not lines:
        raise ValueError("no run has a result")
    every = [each for line in lines.values() for each in line]
    bottom = _HEIGHT - _AXIS - _LEGEND_ROW * len(lines)
    x = _Scale([error for error, _, _ in every], _WIDTH - _RIGHT, _LEFT)
    y = _Scale([paid for _, paid, _ in every], bottom, _TOP)
    title, unit = _TITLES[study.cost]
    parts = [
        _HEAD.format(width=_WIDTH, height=_HEIGHT),
        f"<title>{escape(study.name)}: work and precision</title>",
        f'<rect width="{_WIDTH:g}" height="{_HEIGHT:g}" fill="white"/>',
        _text(_LEFT, 24, f"{_short(study.name)}: what accuracy costs", size=16),
        _text(_LEFT, 44, f"until t = {study.until:g}; rings: nothing is both as exact and cheaper",
              colour="#555"),
        *_axes(x, y, bottom, f"{title}{f' ({unit})' if unit else ''}"),
    ]  # fmt: skip
    front = study.front
    parts += ["<g>"]
    for place, (name, line) in enumerate(lines.items()):
        parts += _line(place, name, [(x(e), y(p), point in front) for e, p, point in line])
    parts += ["</g>", *_labels({name: (x(line[-1][0]), y(line[-1][1]))
                                for name, line in lines.items()}),
              *_legend(list(lines), bottom + _AXIS), "</svg>"]  # fmt: skip
    return "\n".join(parts) + "\n"


def _axes(x: _Scale, y: _Scale, bottom: float, title: str) -> list[str]:
    right = _WIDTH - _RIGHT
    parts = ['<g stroke="#ddd" stroke-width="1">']
    parts += [_segment(x(tick), _TOP, x(tick), bottom) for tick in x.ticks()]
    parts += [_segment(_LEFT, y(tick), right, y(tick)) for tick in y.ticks()]
    frame = f'x="{_LEFT:g}" y="{_TOP:g}" width="{right - _LEFT:g}" height="{bottom - _TOP:g}"'
    parts += ["</g>", f'<rect {frame} fill="none" stroke="#333"/>']
    parts += [
        _text(x(tick), bottom + 17, _power(tick), anchor="middle", markup=True)
        for tick in x.ticks()
    ]
    parts += [
        _text(_LEFT - 8, y(tick) + 4, _power(tick), anchor="end", markup=True) for tick in y.ticks()
    ]
    middle = (_TOP + bottom) / 2
    parts += [
        _text((_LEFT + right) / 2, bottom + 36, "true error, more exact to the right",
              anchor="middle"),
        f'<g transform="rotate(-90 20 {middle:g})">{_text(20, middle, title, anchor="middle")}</g>',
    ]  # fmt: skip
    return parts


def _line(place: int, name: str, points: Sequence[tuple[float, float, bool]]) -> list[str]:
    colour, dash = _style(place)
    path = " ".join(f"{a:.1f},{b:.1f}" for a, b, _ in points)
    style = f' stroke-dasharray="{dash}"' if dash else ""
    paint = f'fill="none" stroke="{colour}" stroke-width="1.8"{style}'
    parts = [f'<polyline id="{escape(name)}" points="{path}" {paint}/>']
    for a, b, pays in points:
        parts.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>')
        if pays:
            parts.append(
                f'<circle cx="{a:.1f}" cy="{b:.1f}" r="6" fill="none" stroke="{colour}" '
                'stroke-width="1.5"/>'
            )
    return parts


def _labels(ends: dict[str, tuple[float, float]]) -> list[str]:
    """The names at the ends of the lines, moved apart where they would cover each other."""
    order = {name: place for place, name in enumerate(ends)}
    taken: list[tuple[float, float]] = []
    parts = []
    for name, (a, b) in sorted(ends.items(), key=lambda each: each[1][1]):
        height = b
        while any(abs(height - h) < _LABEL_GAP and abs(a - c) < 70 for c, h in taken):
            height += 2
        taken.append((a, height))
        colour, _ = _style(order[name])
        parts.append(_text(a + 11, height + 4, name, colour=colour, weight="bold"))
    return parts


def _legend(names: Sequence[str], top: float) -> list[str]:
    parts = []
    for place, name in enumerate(names):
        entry, (colour, dash) = METHODS[name], _style(place)
        height = top + _LEGEND_ROW * place
        style = f' stroke-dasharray="{dash}"' if dash else ""
        order = "any order" if entry.order is None else f"order {entry.order}"
        parts.append(
            f'<line x1="{_LEFT:g}" y1="{height:g}" x2="{_LEFT + 34:g}" y2="{height:g}" '
            f'stroke="{colour}" stroke-width="2.5"{style}/>'
        )
        told = ", ".join((order, *entry.properties))
        parts.append(_text(_LEFT + 42, height + 4, f"{name}: {told}"))
    return parts


def _style(place: int) -> tuple[str, str]:
    return _COLOURS[place % len(_COLOURS)], _DASHES[place // 2 % len(_DASHES)]


def _segment(a: float, b: float, c: float, d: float) -> str:
    return f'<line x1="{a:.1f}" y1="{b:.1f}" x2="{c:.1f}" y2="{d:.1f}"/>'


def _text(
    a: float,
    b: float,
    words: str,
    *,
    size: float = 12,
    anchor: str = "start",
    colour: str = "#222",
    weight: str = "normal",
    markup: bool = False,
) -> str:
    place = f'<text x="{a:.1f}" y="{b:.1f}" font-size="{size:g}" text-anchor="{anchor}"'
    end = f' font-weight="{weight}">{words if markup else escape(words)}</text>'
    # the halo stands by itself: not every renderer knows paint-order
    halo = f'{place} stroke="white" stroke-width="3"{end}' if weight == "bold" else ""
    return f'{halo}{place} fill="{colour}"{end}'


def _power(value: float) -> str:
    """10 with its exponent raised, or a plain number between powers."""
    exponent = round(math.log10(value))
    if not math.isclose(value, 10.0**exponent):
        return f"{value:g}"
    if -3 <= exponent <= 3:
        return f"{value:g}"
    return f'10<tspan dy="-5" font-size="9">{exponent}</tspan>'


def _short(name: str) -> str:
    return name if len(name) <= 60 else "…" + name[-59:]
