"""`make gallery`: a page of every problem of the library, and a list of them with pictures.

    python tests/gallery.py FOLDER [WORD...]

Each page is `lagcli explain --with-motion`; what has no motion has formulas alone.
"""

from __future__ import annotations

import html
import sys
from collections.abc import Iterator
from itertools import groupby
from multiprocessing import Pool
from pathlib import Path
from typing import NamedTuple

import lagcli
from lagcli.diagnostics import ProblemError
from lagcli.formatters import Options
from lagcli.formatters.explaining import render
from lagcli.formatters.mathml import MathmlPrinter
from lagcli.library import LibraryEntry, entries
from lagcli.mechanics.derivation import Derivation
from lagcli.numerics.equations.refusal import Refusal
from lagcli.pictures.drawing import CannotDraw
from lagcli.pipeline import Request, derive, explain, state
from lagcli.pipeline import render as render_answers
from lagcli.statements.explanation import Explanation

_KINDS = ("path", "series")
_STYLE = """
:root { color-scheme: light dark; }
body { margin: 2rem auto; max-width: 76rem; padding: 0 1rem; font-family: system-ui, sans-serif; }
ul { display: grid; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); gap: 1rem;
  padding: 0; list-style: none; }
li { border: 1px solid #8886; border-radius: 6px; overflow: hidden; }
a { display: block; padding: 0.7rem; color: inherit; text-decoration: none; }
a:hover, a:focus-visible { outline: 3px solid #0072B2; outline-offset: -3px; }
img, span { display: block; width: 100%; height: 11rem; object-fit: contain; }
span { overflow: hidden; align-content: center; }
h2 { margin: 2rem 0 0.7rem; }
"""


class Card(NamedTuple):
    """What the list has of a problem: its picture, or else T, L or H."""

    name: str
    title: str
    shown: str


def made(name: str, derivation: Derivation, told: Explanation | None, folder: Path) -> Card:
    """Write the page and the picture of a problem; of an H alone its equations are the page."""
    problem = derivation.given
    page = folder / f"{name}.html"
    page.parent.mkdir(parents=True, exist_ok=True)
    below, picture = moved(problem)
    options = Options(standalone=True, below=(below,))
    text = render([told], "html", options) if told else equations(derivation, options)
    page.write_text(text, "utf-8")
    return Card(name, problem.title, shown(name, problem, picture, folder))


def shown(name, problem, picture, folder: Path) -> str:
    """The picture of a problem, for a light and for a dark page, or its formula."""
    if picture is None:
        formula = problem.lagrangian or problem.hamiltonian or problem.kinetic or problem.potential
        return f"<span><math>{MathmlPrinter().show(formula)}</math></span>" if formula else ""
    picture.save(folder / f"{name}.svg")
    picture.save(folder / f"{name}-dark.svg", dark=True)
    return (
        f"<picture><source media='(prefers-color-scheme: dark)' srcset='{name}-dark.svg'>"
        f"<img src='{name}.svg' alt='' loading='lazy'></picture>"
    )


def explained(derivation: Derivation) -> Explanation | None:
    """There is nothing to tell from an H whose velocities do not determine the momenta."""
    return None if derivation.no_lagrangian else explain(derivation)


def equations(derivation: Derivation, options: Options) -> str:
    request = Request(sections=("hamiltonian", "canonical_equations"))
    return render_answers([state(derivation, request)], "html", options)


def moved(problem):
    """The motion as HTML, and a picture of it."""
    from lagcli.cli.motion_on_page import motion_below

    below, _ = motion_below(problem)
    if not below:
        return "", None
    motion = lagcli.simulate(problem, samples=601)
    for kind in _KINDS:
        try:
            return below, motion.plot(kind)
        except (CannotDraw, ProblemError, Refusal):
            continue
    return below, None


def listed(cards: list[Card]) -> Iterator[str]:
    """The page with all problems, by their folders."""
    yield "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>"
    yield "<meta name='viewport' content='width=device-width, initial-scale=1'>"
    yield f"<title>Problems of lagcli</title>\n<style>{_STYLE}</style>\n</head>\n<body>"
    yield f"<h1>{len(cards)} problems of lagcli</h1>"
    for topic, group in groupby(cards, lambda card: card.name.rpartition("/")[0]):
        yield f"<h2>{html.escape(topic or 'first')}</h2>\n<ul>"
        for card in group:
            yield f"<li><a href='{card.name}.html'>{card.shown}{html.escape(card.title)}</a></li>"
        yield "</ul>"
    yield "</body>\n</html>"


def write_list(cards: list[Card], folder: Path) -> None:
    """Write the page that shows them all."""
    folder.mkdir(exist_ok=True)
    (folder / "index.html").write_text("\n".join(listed(cards)) + "\n", "utf-8")


def _one(work: tuple[LibraryEntry, Path]) -> Card | str:
    """The card, or what went wrong: not every exception finds its way out of a process."""
    entry, folder = work
    try:
        derivation = derive(lagcli.load(entry.path))
        return made(entry.name, derivation, explained(derivation), folder)
    except Exception as error:  # noqa: BLE001 - one page less, and its reason
        return f"{entry.name}: {type(error).__name__}: {error}"


def main(folder: Path, words: list[str]) -> int:
    """Make the pages of the problems whose name has one of the words; how many failed."""
    chosen = [e for e in entries() if not words or any(word in e.name for word in words)]
    cards = []
    with Pool(maxtasksperchild=10) as pool:
        for card in pool.imap(_one, [(entry, folder) for entry in chosen]):
            if isinstance(card, Card):
                cards.append(card)
            print(card.name if isinstance(card, Card) else card, flush=True)
    write_list(cards, folder)
    return len(chosen) - len(cards)


if __name__ == "__main__":
    sys.exit(min(main(Path(sys.argv[1]), sys.argv[2:]), 1))
