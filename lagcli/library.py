"""The library of problems that travels with the package, found by name.

A problem is called by the name of its file (`kepler`), with its folder where two files share
a name (`canonical/bead-on-rotating-hoop`), or as in the repository
(`problems/central/kepler.yaml`).
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from lagcli.record import record

_TITLE = re.compile(rb"^title:[ \t]*(?P<text>.+?)[ \t]*$", re.MULTILINE)
SUFFIXES = (".yaml", ".yml")
_HEAD = 2048  # bytes; the title stands in the first lines


class NotInLibrary(OSError):
    """A name that is neither a file nor a problem of the library."""

    def __init__(self, name: str, hint: str) -> None:
        sentence = "no such file or directory"
        if "." not in name and not name.endswith("/"):  # what is meant as a name, not as a path
            sentence += f", and no problem of the library: {hint}"
        elif near := _near_file(Path(name)):
            sentence += f": did you mean '{near}'?"
        super().__init__(2, sentence, name)


@record
class LibraryEntry:
    """One problem of the library.

    Attributes
    ----------
    name : str
        Its folder and the name of its file, `central/kepler`.
    path : Path
        Its file.
    """

    name: str
    path: Path

    @property
    def title(self) -> str:
        """The title that the file gives, or its name."""
        with self.path.open("rb") as file:
            found = _TITLE.search(file.read(_HEAD))
        text = found["text"].decode("utf-8", "replace") if found else self.name
        return text.strip("\"'")


def files_in(place: Path) -> list[str]:
    """The problem files under a folder, in order.

    Raises
    ------
    FileNotFoundError
        When there is none.
    """
    found = sorted(file for file in place.rglob("*") if file.suffix in SUFFIXES and file.is_file())
    if not found:
        raise FileNotFoundError(2, "no problem (*.yaml) in this folder", str(place))
    return [str(file) for file in found]


@cache
def folder() -> Path | None:
    """Where the problems are: beside an installed package, or in the repository."""
    here = Path(__file__).resolve().parent
    places = (here / "problems", here.parent / "problems")
    return next((place for place in places if place.is_dir()), None)


@cache
def entries() -> tuple[LibraryEntry, ...]:
    """Every problem, in the order of the names."""
    place = folder()
    if place is None:
        return ()
    found = sorted(place.rglob("*.yaml"))
    return tuple(
        LibraryEntry(path.relative_to(place).with_suffix("").as_posix(), path) for path in found
    )


def find_problem(name: str) -> Path:
    """The file of a problem of the library.

    Raises
    ------
    NotInLibrary
        When no problem, or more than one, has the name; the message names what is near.
    """
    wanted = name.removeprefix("problems/").removesuffix(".yaml")
    every = entries()
    named = [one for one in every if wanted in (one.name, one.name.rpartition("/")[2])]
    exact = [one for one in named if one.name == wanted]
    if len(exact or named) == 1:
        return (exact or named)[0].path
    if named:
        raise NotInLibrary(name, "give " + " or ".join(one.name for one in named))
    here = [name + suffix for suffix in SUFFIXES if Path(name + suffix).is_file()]
    raise NotInLibrary(name, f"did you mean '{here[0]}'?" if here else _near(wanted, every))


def files_named(name: str) -> list[str]:
    """The files of a folder of the library (`problems/rigid`), or of one problem of it.

    Raises
    ------
    NotInLibrary
        When there is neither.
    """
    top, *below = Path(name).parts or ("",)
    place = folder()
    if place and top == "problems" and (within := place.joinpath(*below)).is_dir():
        return files_in(within)
    return [str(find_problem(name))]


def _near_file(wanted: Path) -> str:
    """The problem file in the same folder that is spelled nearly like this one."""
    from difflib import get_close_matches

    beside = wanted.parent.iterdir() if wanted.parent.is_dir() else iter(())
    files = {each.stem: each.name for each in beside if each.suffix in SUFFIXES}
    close = get_close_matches(wanted.stem, files, n=1, cutoff=0.7)
    return str(wanted.with_name(files[close[0]])) if close else ""


def _near(wanted: str, every: tuple[LibraryEntry, ...]) -> str:
    from difflib import get_close_matches

    if re.fullmatch(r"[^\W\d]\w*'*=\S+", wanted):
        return f"a value is set by an option of its own: --set {wanted}"
    short = [one.name.rpartition("/")[2] for one in every]
    close = get_close_matches(wanted.rpartition("/")[2], short, n=1)
    return f"did you mean '{close[0]}'?" if close else "lagcli list names them"
