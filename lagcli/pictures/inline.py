"""Pictures and animations within a page of HTML: nothing of them lies outside of it.

An image says in words what it shows.  An animation stands in a frame of its own, so that several
share a page.
"""

from __future__ import annotations

import html
from base64 import b64encode

from lagcli.formatters.plain import harmless
from lagcli.pictures.drawing import DrawnName, Panel, Picture
from lagcli.pictures.figure import to_bytes
from lagcli.pictures.page import to_html
from lagcli.pictures.scene import Scene

_STYLE = "max-width: 100%; height: auto"
#: The frame is as high as what is in it.
_FRAME = (
    '<iframe title="{title}" srcdoc="{page}" style="width: 100%; height: 36rem; border: 0" '
    'onload="const page = this.contentDocument.documentElement; new ResizeObserver(() => '
    "{{ this.style.height = page.offsetHeight + 8 + 'px'; }}).observe(page)\">"
    "</iframe>\n"
)


def image(picture: Picture, *, both: bool = False) -> str:
    """The picture as an element of HTML.

    Parameters
    ----------
    picture
        Drawn by Matplotlib.
    both
        With a second one on a dark page, which the browser takes where its user prefers that.
    """
    shown = f'<img src="{_address(picture)}" alt="{_quoted(in_words(picture))}" style="{_STYLE}">'
    if not both:
        return f"{shown}\n"
    dark = _address(picture, dark=True)
    shown = shown.replace("height:", "min-width: 34rem; height:")  # legible on a phone
    return (
        '<div style="overflow-x: auto" tabindex="0"><picture>'
        f'<source media="(prefers-color-scheme: dark)" srcset="{dark}">{shown}</picture></div>\n'
    )


def frame(scene: Scene) -> str:
    """The animation as an element of HTML."""
    page = html.escape(to_html(scene, embedded=True), quote=True)
    return _FRAME.format(title=_quoted(f"Animation: {scene.title}"), page=page)


def in_words(picture: Picture) -> str:
    """What the axes and the key of a picture say."""
    return f"{picture.title}: " + "; ".join(map(_panel_in_words, picture.panels))


def _panel_in_words(panel: Panel) -> str:
    x, y = panel.x, panel.y
    return f"{_span(y.label, y.low, y.high)}, over {_span(x.label, x.low, x.high)}"


def _span(label: DrawnName, low: float, high: float) -> str:
    return f"{label.plain} from {low:.3g} to {high:.3g}"


def _address(picture: Picture, *, dark: bool = False) -> str:
    data = b64encode(to_bytes(picture, "svg", dark=dark)).decode()
    return f"data:image/svg+xml;base64,{data}"


def _quoted(text: str) -> str:
    return html.escape(harmless(text), quote=True)
