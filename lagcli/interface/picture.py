"""Pictures of a motion as values: shown by a notebook, printed, or written to a file."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from lagcli.pictures.drawing import Picture

if TYPE_CHECKING:
    from lagcli.pictures.scene import Scene


class Plot:
    """A picture: `print` draws it with characters, a notebook with lines.

    Attributes
    ----------
    title : str
    refusal : str
        Why it ends early; empty when it does not.
    """

    def __init__(self, picture: Picture, refusal: str) -> None:
        self.picture = picture
        self.title = picture.title
        self.refusal = refusal

    def to_svg(self, *, dark: bool = False) -> str:
        """The picture as SVG; needs Matplotlib."""
        from lagcli.pictures.figure import to_bytes

        return to_bytes(self.picture, "svg", dark=dark).decode()

    def to_html(self) -> str:
        """An image of HTML, with what it shows in words."""
        from lagcli.pictures.inline import image

        return image(self.picture)

    def save(self, path: str | PathLike[str], *, dark: bool = False) -> None:
        """Write a file; its ending is `.svg`, `.pdf` or `.png`.

        Raises
        ------
        ValueError
            When the ending is another.
        """
        from lagcli.pictures.figure import FORMATS, to_bytes

        kind = _ending(path, FORMATS)
        Path(path).write_bytes(to_bytes(self.picture, kind, dark=dark))

    def __str__(self) -> str:
        from lagcli.pictures.terminal import Terminal, to_text

        return to_text(self.picture, Terminal(width=80, unicode=True, colour=False)).rstrip("\n")

    def __repr__(self) -> str:
        return f"<Plot of {self.title!r}>"

    def _repr_html_(self) -> str:
        return self.to_html()

    def _repr_png_(self) -> bytes:
        from lagcli.pictures.figure import to_bytes

        return to_bytes(self.picture, "png")


class Animation:
    """A motion that plays: in a notebook, or as a page, a GIF or an MP4.

    Attributes
    ----------
    title : str
    refusal : str
        Why it ends early; empty when it does not.
    """

    def __init__(self, scene: Scene, refusal: str) -> None:
        self._scene = scene
        self.title = scene.title
        self.refusal = refusal

    def to_html(self) -> str:
        """A whole page, which needs no network."""
        from lagcli.pictures.page import to_html

        return to_html(self._scene)

    def save(self, path: str | PathLike[str], *, dark: bool = False) -> None:
        """Write a file; its ending is `.html`, `.gif` or `.mp4`.

        Raises
        ------
        ValueError
            When the ending is another.
        """
        from lagcli.pictures.film import to_film

        kind = _ending(path, ("html", "gif", "mp4"))
        data = self.to_html().encode() if kind == "html" else to_film(self._scene, kind, dark=dark)
        Path(path).write_bytes(data)

    def __repr__(self) -> str:
        return f"<Animation of {self.title!r}>"

    def to_frame(self) -> str:
        """The page as a part of another page."""
        from lagcli.pictures.inline import frame

        return frame(self._scene)

    def _repr_html_(self) -> str:
        return self.to_frame()


def _ending(path: str | PathLike[str], known: tuple[str, ...]) -> str:
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in known:
        endings = ", ".join(f".{each}" for each in known)
        raise ValueError(f"{path}: the ending says what is written: one of {endings}")
    return kind
