"""A scene as GIF or MP4, drawn by Matplotlib: 25 pictures a second, as long as the page plays."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from lagcli.numerics.hybrid.request import Progress
from lagcli.pictures.drawing import CannotDraw
from lagcli.pictures.figure import settings
from lagcli.pictures.palette import DARK, LIGHT, Style
from lagcli.pictures.scene import Place, Scene

#: Pictures a second; a GIF has fewer, whose delays are hundredths of a second.
_RATES = {"mp4": 25, "gif": 20}
#: A film is as long as the motion where that is this many seconds, or else the second.
_LONGEST, _USUAL = 30.0, 10.0
_SHORTEST = 2.0
_WIDTH, _RESOLUTION = 5.6, 100
_VIEW = (math.radians(-60), math.radians(20))
_COILS = 9


def to_film(scene: Scene, kind: str, *, dark: bool = False, progress: Progress = None) -> bytes:
    """The film as the bytes of its file.

    Parameters
    ----------
    scene
        What is shown.
    kind
        `gif` or `mp4`; this needs ffmpeg.
    dark
        Light on dark.
    progress
        Called with the part that is drawn.

    Raises
    ------
    CannotDraw
        Where ffmpeg fails.
    """
    style = DARK if dark else LIGHT
    with settings(style):
        drawing = _Drawing(scene, style)
        times = _times(scene, _RATES[kind])
        if kind == "gif":
            return _gif(drawing.at(t) for t in _told(times, progress))
        return _mp4(drawing, times, progress)


def _times(scene: Scene, rate: int) -> list[float]:
    first, last = scene.times[0], scene.times[-1]
    span = last - first
    real = scene.unit == "s" and _SHORTEST <= span <= _LONGEST
    count = max(2, round(rate * (span if real else _USUAL)))
    return [first + span * k / (count - 1) for k in range(count)]


def _told(times: Sequence[float], progress: Progress) -> Iterator[float]:
    for k, t in enumerate(times):
        if progress is not None:
            progress(k / len(times))
        yield t


def _gif(pictures: Iterable[Any]) -> bytes:
    """One palette for all pictures, without dithering: what rests does not flicker."""
    from PIL import Image

    images = [Image.fromarray(picture).convert("RGB") for picture in pictures]
    palette = images[len(images) // 2].quantize(64, dither=Image.Dither.NONE)
    frames = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    into = BytesIO()
    frames[0].save(
        into, "GIF", save_all=True, append_images=frames[1:], duration=1000 // _RATES["gif"], loop=0
    )
    return into.getvalue()


def _mp4(drawing: _Drawing, times: Sequence[float], progress: Progress) -> bytes:
    from subprocess import CalledProcessError

    from matplotlib.animation import FFMpegWriter

    exact = "-fflags +bitexact -flags:v +bitexact -pix_fmt yuv420p -threads 1".split()
    writer: Any = FFMpegWriter(fps=_RATES["mp4"], codec="h264", extra_args=exact)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        try:
            with writer.saving(drawing.figure, str(path), _RESOLUTION):
                for t in _told(times, progress):
                    drawing.move(t)
                    writer.grab_frame()
        except (CalledProcessError, OSError) as error:
            raise CannotDraw(f"ffmpeg did not write the film: {error}") from None
        return path.read_bytes()


class _Drawing:
    """The figure, whose parts are moved from picture to picture."""

    def __init__(self, scene: Scene, style: Style) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        self.scene, self.style = scene, style
        corners = [self._flat(p) for p in _box(scene.low, scene.high)]
        (left, right), (bottom, top) = (
            (min(values), max(values)) for values in zip(*corners, strict=True)
        )
        self.across = right - left
        height = min(max(_WIDTH * (top - bottom) / self.across, 1.6), 7.0)
        # even numbers of pixels: h264 has no others
        self.figure: Any = Figure(figsize=(_WIDTH, round((height + 0.6) * 50) / 50))
        self.canvas: Any = FigureCanvasAgg(self.figure)
        self.figure.set_dpi(_RESOLUTION)
        part = 0.6 / (height + 0.6)
        self.ax: Any = self.figure.add_axes((0.02, 0.02, 0.96, 0.98 - part))
        self.ax.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
        self.ax.set_axis_off()
        title = scene.title if len(scene.title) <= 60 else scene.title[:59] + "…"
        self.figure.text(0.5, 1 - part / 2, title.replace("$", r"\$"), ha="center", fontsize=11)
        self.clock: Any = self.figure.text(0.03, 0.03, "", fontsize=10, color=style.second)
        self._parts()

    def _parts(self) -> None:
        ax, style, scene = self.ax, self.style, self.scene
        for lines in scene.surfaces.values():
            for line in lines:
                ax.plot(*zip(*line, strict=True), color=style.second, linewidth=2)
        look = {
            "rod": {"color": style.ink, "linewidth": 3, "solid_capstyle": "round"},
            "spring": {"color": style.ink, "linewidth": 1.4},
            "line": {"color": style.second, "linewidth": 0.9},
        }
        self.trails = [
            ax.plot([], [], color=self.style.colour(k), linewidth=1.2, alpha=0.6)[0]
            for k in range(len(scene.bodies))
        ]
        self.links = [(link, ax.plot([], [], **look[link.kind])[0]) for link in scene.links]
        self.places = [
            (name, ax.plot([], [], "o", mfc=style.paper, mec=style.ink, markersize=6)[0])
            for name in scene.places
        ]
        points = _WIDTH * 72 * 2  # of a radius beside the width, as a diameter in points
        colour = self.style.colour
        self.bodies = [
            ax.plot([], [], "o", color=colour(k), markersize=body.radius * points, zorder=5)[0]
            for k, body in enumerate(scene.bodies)
        ]
        strongest = max(
            (math.hypot(*v) for vector in scene.vectors for v in vector.values if v), default=1.0
        )
        self.pull = 0.28 * self.across / (strongest or 1.0)
        self.arrows = [
            ax.annotate(
                "", (0, 0), (0, 0), zorder=6,
                arrowprops={"arrowstyle": "-|>", "linewidth": 1.8,
                            "color": self.style.colour(len(scene.bodies) + k)},
            )
            for k in range(len(scene.vectors))
        ]  # fmt: skip

    def _flat(self, place: Place) -> tuple[float, float]:
        """As the page projects it."""
        axes = self.scene.axes
        if len(axes) == 1:
            return (place[0], 0.0) if axes == "x" else (0.0, place[0])
        if len(axes) == 2:
            return place[0], place[1]
        (a, b), (x, y, z) = _VIEW, place
        depth = math.cos(a) * x + math.sin(a) * y
        return -math.sin(a) * x + math.cos(a) * y, -math.sin(b) * depth + math.cos(b) * z

    def at(self, t: float) -> Any:
        """The picture at a time, as an array of pixels."""
        import numpy as np

        self.move(t)
        self.canvas.draw()
        return np.asarray(self.canvas.buffer_rgba())[..., :3].copy()

    def move(self, t: float) -> None:
        """Everything to where it is at a time."""
        scene = self.scene
        times = scene.times
        i = min(max(bisect_right(times, t) - 1, 0), len(times) - 2)
        width = times[i + 1] - times[i]
        part = min(1.0, max(0.0, (t - times[i]) / width)) if width else 0.0
        here = {body.name: _between(body.places, i, part) for body in scene.bodies}
        here |= {name: _between(many, i, part) for name, many in scene.places.items()}
        for body, sign, trail in zip(scene.bodies, self.bodies, self.trails, strict=True):
            sign.set_data(*_columns([self._flat(here[body.name])]))
            if body.trail:
                passed = [*body.places[: i + 1], here[body.name]]
                trail.set_data(*_columns(list(map(self._flat, passed))))
        for name, sign in self.places:
            sign.set_data(*_columns([self._flat(here[name])]))
        for link, line in self.links:
            ends = self._flat(here[link.first]), self._flat(here[link.second])
            coils = _spring(*ends, 0.012 * self.across)
            line.set_data(*_columns(coils if link.kind == "spring" else list(ends)))
        for vector, arrow in zip(scene.vectors, self.arrows, strict=True):
            value = vector.values[i]
            arrow.set_visible(value is not None)
            if value is not None:
                start = here[vector.on]
                end = tuple(x + self.pull * f for x, f in zip(start, value, strict=True))
                arrow.set_position(self._flat(start))
                arrow.xy = self._flat(end)
        unit = f" {scene.unit}" if scene.unit else ""
        self.clock.set_text(f"t = {t:.2f}{unit}")


def _box(low: Place, high: Place) -> list[Place]:
    """The corners of what is shown."""
    corners: list[Place] = [()]
    for a, b in zip(low, high, strict=True):
        corners = [(*corner, x) for corner in corners for x in (a, b)]
    if len(low) > 1:
        return corners
    middle, half = (low[0] + high[0]) / 2, (high[0] - low[0]) / 2
    return [(middle - half,), (middle + half,)]


def _between(places: Sequence[Place], i: int, part: float) -> Place:
    if i + 1 >= len(places):
        return places[i]
    return tuple(a + part * (b - a) for a, b in zip(places[i], places[i + 1], strict=True))


def _columns(points: Sequence[tuple[float, float]]) -> tuple[list[float], list[float]]:
    return [x for x, _ in points], [y for _, y in points]


def _spring(
    a: tuple[float, float], b: tuple[float, float], wide: float
) -> list[tuple[float, float]]:
    """A zigzag between two points."""
    (x, y), (u, v) = a, b
    length = math.hypot(u - x, v - y) or 1.0
    across, up = -(v - y) / length, (u - x) / length
    points = [a]
    for k in range(2 * _COILS + 1):
        part = 0.12 + 0.76 * k / (2 * _COILS)
        side = 0.0 if k in {0, 2 * _COILS} else wide if k % 2 else -wide
        points.append((x + part * (u - x) + side * across, y + part * (v - y) + side * up))
    return [*points, b]
