"""A scene as one HTML page that needs nothing else: no network, no other file.

The controls are those of the browser, so keyboards and screen readers know them; what is seen
is also said, in a caption, in a list of events and in a table of places.
"""

from __future__ import annotations

import html
import json
import math
from pathlib import Path
from typing import Any

from lagcli.formatters.plain import harmless
from lagcli.pictures.scene import Place, Scene

#: Digits of a place beside the size of the picture: half a pixel of 10,000.
_DIGITS = 5
_ROWS = 11
_EVENTS = 40
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"


def to_html(scene: Scene, *, embedded: bool = False) -> str:
    """The page; the same scene gives the same bytes.

    Parameters
    ----------
    scene
        What is shown.
    embedded
        In a frame of another page, which has the title already.
    """
    first, last = scene.times[0], scene.times[-1]
    return _part("animation.html").format(
        kind=' class="embedded"' if embedded else "",
        policy=_POLICY,
        title=_shown(scene.title),
        style=_part("animation.css"),
        caption=_shown(_caption(scene)),
        first=_number(first),
        last=_number(last),
        step=_number((last - first) / 1000 or 1.0),
        more=_more(scene),
        early=_early(scene),
        key=_key(scene),
        events=_events(scene),
        table=_table(scene),
        notes=_shown(" ".join(scene.notes)),
        data=_data(scene),
        script=_part("animation.js"),
    )


def _part(name: str) -> str:
    return Path(__file__).with_name(name).read_text("utf-8")


def _shown(text: str) -> str:
    return html.escape(harmless(text))


def _number(value: float) -> str:
    return f"{value:.12g}"


def _time(scene: Scene, t: float) -> str:
    return f"t = {t:.4g}{' ' + scene.unit if scene.unit else ''}"


def _caption(scene: Scene) -> str:
    """What is to be seen, in a sentence or two."""
    names = ", ".join(body.name for body in scene.bodies)
    many = "Points" if len(scene.bodies) > 1 else "The point"
    seen = {1: f"along {scene.axes}", 2: f"in the plane of {', '.join(scene.axes)}", 3: "in space"}
    start, end = _time(scene, scene.times[0]), _time(scene, scene.times[-1])
    words = [f"{many} {names} {seen[len(scene.axes)]}, from {start} to {end}."]
    kinds = {link.kind for link in scene.links}
    if "line" in kinds:
        words.append("A thin line joins the origin to what stays at the same distance from it.")
    if "rod" in kinds:
        words.append("Thick lines are rods.")
    return " ".join(words)


def _more(scene: Scene) -> str:
    parts = []
    if scene.vectors:
        parts.append('<label><input id="forces" type="checkbox" checked> Forces</label>\n')
    if len(scene.axes) == 3:
        parts.append(
            '<label>View <input id="turn" type="range" min="-180" max="180" step="5" value="-60" '
            'aria-label="Direction of the view in degrees"></label>\n'
        )
    return "".join(parts)


def _early(scene: Scene) -> str:
    if scene.certain >= scene.until * (1 - 1e-12):
        return ""
    text = f"The certificate ends at {_time(scene, scene.certain)}: nothing is shown beyond."
    return f'<p class="early">{_shown(text)}</p>\n'


def _key(scene: Scene) -> str:
    """The colours, and the state of each contact."""
    many = len(scene.bodies)
    items = [_entry("swatch", k, body.name) for k, body in enumerate(scene.bodies)]
    items += [
        _entry("swatch arrow", many + k, f"{vector.name} on {vector.on}")
        for k, vector in enumerate(scene.vectors)
    ]
    items += [
        f'<li>{_shown(name)}: <span id="contact-{_shown(name)}"></span></li>'
        for name in scene.closed
    ]
    return f'<ul class="key" aria-label="Key">{"".join(items)}</ul>\n'


def _entry(shape: str, colour: int, name: str) -> str:
    paint = f"background:var(--c{colour % 6})"
    return f'<li><span class="{shape}" style="{paint}"></span>{_shown(name)}</li>'


def _events(scene: Scene) -> str:
    if not scene.happenings:
        return ""
    first: dict[str, float] = {}  # of the last impacts of a ball, which read alike
    for each in scene.happenings:
        first.setdefault(f"{_shown(_time(scene, each.t))}: {_shown(each.text)}", each.t)
    shown = [*first.items()][:_EVENTS]
    items = "".join(
        f'<li><button type="button" data-t="{_number(t)}">{text}</button></li>' for text, t in shown
    )
    rest = len(scene.happenings) - len(shown)
    more = f"<p>And {rest} more.</p>\n" if rest else ""
    return f'<h2>Events</h2>\n<ol class="events">{items}</ol>\n{more}'


def _table(scene: Scene) -> str:
    """The places at a few times, for whoever does not see the picture."""
    unit = f" ({scene.unit})" if scene.unit else ""
    length = f" ({scene.length})" if scene.length else ""
    head = "".join(
        f'<th scope="col">{_shown(f"{body.name} {axis}{length}")}</th>'
        for body in scene.bodies
        for axis in scene.axes
    )
    count = len(scene.times)
    rows = sorted({round(k * (count - 1) / (_ROWS - 1)) for k in range(_ROWS)})
    lines = []
    for i in rows:
        cells = "".join(
            f"<td>{_cell(value)}</td>" for body in scene.bodies for value in body.places[i]
        )
        lines.append(f'<tr><th scope="row">{scene.times[i]:.4g}</th>{cells}</tr>\n')
    return (
        f'<table>\n<thead><tr><th scope="col">t{_shown(unit)}</th>{head}</tr></thead>\n'
        f"<tbody>\n{''.join(lines)}</tbody>\n</table>\n"
    )


def _cell(value: float) -> str:
    return f"{value:.4g}".replace("-", "\N{MINUS SIGN}")


# -- the data ------------------------------------------------------------------------------------


def _data(scene: Scene) -> str:
    """The scene as JSON that cannot end its element."""
    width = max(high - low for low, high in zip(scene.low, scene.high, strict=True))
    places = max(0, _DIGITS - math.floor(math.log10(width)))
    strongest = max(
        (abs(x) for vector in scene.vectors for place in vector.values for x in place or ()),
        default=1.0,
    )
    digits = max(0, _DIGITS - math.floor(math.log10(strongest or 1.0)))
    document: dict[str, Any] = {
        "axes": scene.axes,
        "length": scene.length,
        "unit": scene.unit,
        "times": [float(_number(t)) for t in scene.times],
        "low": list(scene.low),
        "high": list(scene.high),
        "bodies": [
            {"name": body.name, "radius": round(body.radius, 5), "trail": body.trail,
             "places": [_rounded(place, places) for place in body.places]}
            for body in scene.bodies
        ],
        "places": {
            name: [_rounded(place, places) for place in many] for name, many in scene.places.items()
        },
        "links": [{"first": x.first, "second": x.second, "kind": x.kind} for x in scene.links],
        "vectors": [
            {"on": vector.on,
             "values": [None if v is None else _rounded(v, digits) for v in vector.values]}
            for vector in scene.vectors
        ],
        "surfaces": {
            name: [[_rounded(point, places) for point in line] for line in lines]
            for name, lines in scene.surfaces.items()
        },
        "closed": {name: list(map(int, acts)) for name, acts in scene.closed.items()},
    }  # fmt: skip
    text = json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _rounded(place: Place | tuple[float, float], digits: int) -> list[float]:
    return [round(value, digits) + 0.0 for value in place]
